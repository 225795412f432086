(** The first stage in single precision: [ExactFromSingle::misses] of src/geom/kernel/exact/single.rs, with gradual underflow and
    without a greatest exponent. The floor of an edge's size covers what underflow adds: EXACT-5. *)
Require Import Reals ZArith Lia Lra Psatz.
From Flocq Require Import Core Relative.
Require Import StacklessExact.Rounding StacklessExact.Triple StacklessExact.Filter.
Open Scope R_scope.

Local Instance prec_24 : Prec_gt_0 24 := eq_refl.

Notation fexp := (FLT_exp (-149) 24).
Notation R32 := (round radix2 fexp ZnearestE).
Notation F := (generic_format radix2 fexp).
Notation u := (/ 16777216).
(** Half of the least number. *)
Notation eta := (bpow radix2 (-150)).

(** * Operations *)

Lemma unit_24 : unit 24 = u.
Proof. reflexivity. Qed.

Lemma ratio_u : u / (1 + u) <= u.
Proof. lra. Qed.

(** A product: relative error, and what underflow adds. *)
Lemma product_32 x : exists e n, Rabs e <= u /\ Rabs n <= eta /\ R32 x = x * (1 + e) + n.
Proof.
  destruct (relative_error_N_FLT'_ex radix2 (-149) 24 prec_24 (fun z => negb (Z.even z)) x) as (e & n & He & Hn & _ & E).
  exists e, n. split; [|split; [|exact E]].
  - unfold u_ro in He. rewrite unit_half, unit_24 in He. pose proof ratio_u. lra.
  - change (-150)%Z with (-1 + -149)%Z. rewrite bpow_plus. exact Hn.
Qed.

Lemma minus_32 a b : F a -> F b -> exists e, Rabs e <= u / (1 + u) /\ R32 (a - b) = (a - b) * (1 + e).
Proof. intros A B. destruct (difference (-149) 24 a b A B) as (e & He & E). rewrite unit_24 in He. now exists e. Qed.

Lemma less_32 a b : F a -> F b -> exists e, Rabs e <= u /\ R32 (a - b) = (a - b) * (1 + e).
Proof. intros A B. destruct (minus_32 a b A B) as (e & He & E). exists e. split; [pose proof ratio_u; lra|exact E]. Qed.

Lemma plus_32 a b : F a -> F b -> exists e, Rabs e <= u /\ R32 (a + b) = (a + b) * (1 + e).
Proof.
  intros A B. destruct (less_32 a (- b) A (generic_format_opp _ _ _ B)) as (e & He & E). exists e. split; [exact He|].
  now replace (a + b) with (a - - b) by ring.
Qed.

Lemma F_32 x : F (R32 x).
Proof. apply generic_format_round; typeclasses eauto. Qed.

(** A true component is the computed one times 1 + e. *)
Lemma back_32 a b : F a -> F b -> exists e, Rabs e <= u /\ a - b = R32 (a - b) * (1 + e).
Proof.
  intros A B. destruct (minus_32 a b A B) as (e & He & E). apply Rabs_le_inv in He.
  assert (L : 0 < 1 + e) by lra. exists (- e / (1 + e)). split; [|rewrite E; field; lra].
  apply Rabs_le. split; apply Rmult_le_reg_r with (1 + e); try assumption; field_simplify; lra.
Qed.

Definition vformat (v : vec) : Prop := F (vx v) /\ F (vy v) /\ F (vz v).

Lemma row_32 a b : vformat a -> vformat b -> row u (vx (vsub R32 a b)) (vy (vsub R32 a b)) (vz (vsub R32 a b)) (vx a - vx b) (vy a - vy b) (vz a - vz b).
Proof.
  intros (A1 & A2 & A3) (B1 & B2 & B3). destruct (back_32 _ _ A1 B1) as (x & X & Ex), (back_32 _ _ A2 B2) as (y & Y & Ey), (back_32 _ _ A3 B3) as (z & Z & Ez).
  exists x, y, z. repeat split; assumption.
Qed.

(** * Triple products *)

Notation tenth := (101 / 100).

(** A component of a cross product, with what underflow adds. *)
Lemma component_32 a b c d : exists m n e p, Rabs m <= u /\ Rabs n <= u /\ Rabs e <= u /\ Rabs p <= 2 * eta * (1 + u) /\
  R32 (R32 (a * b) - R32 (c * d)) = (a * b * (1 + m) - c * d * (1 + n)) * (1 + e) + p.
Proof.
  destruct (product_32 (a * b)) as (m & p & Hm & Hp & E1). destruct (product_32 (c * d)) as (n & q & Hn & Hq & E2).
  destruct (less_32 (R32 (a * b)) (R32 (c * d)) (F_32 _) (F_32 _)) as (e & He & E). exists m, n, e, ((p - q) * (1 + e)).
  repeat (split; [assumption|]). split.
  - apply Rle_trans with ((eta + eta) * (1 + u)); [|lra]. apply mul_b; [now apply sub_b|]. apply add_b; [rewrite Rabs_R1; lra|exact He].
  - rewrite E, E1, E2. ring.
Qed.

(** A triple product as evaluated, in whatever order: relative errors cost what Triple.v says; underflow adds six products times the row
    outside, and three. *)
Definition is_triple (found : R) (x y z : vec) : Prop := F found /\ forall X Y Z, bounded X x -> bounded Y y -> bounded Z z -> exists r a,
  found = r + a /\
  Rabs (r - det3 (vx x) (vy x) (vz x) (vx y) (vy y) (vz y) (vx z) (vy z) (vz z)) <= (22 * u + 49 * (u * u)) * (X * Y * Z) /\
  Rabs a <= (6 * X + 3) * (tenth * eta).

Lemma triple_32 x y z : is_triple (dot R32 x (cross R32 y z)) x y z.
Proof.
  split; [apply F_32|]. intros X Y Z. destruct x as [x1 x2 x3], y as [y1 y2 y3], z as [z1 z2 z3]. intros (A1 & A2 & A3) (H1 & H2 & H3) (G1 & G2 & G3). unfold dot, cross.
  cbn [vx vy vz] in *. rewrite (Rmult_comm z2 y3), (Rmult_comm z3 y1), (Rmult_comm z1 y2).
  destruct (component_32 y2 z3 y3 z2) as (m1 & m2 & c1 & n1 & M1 & M2 & C1 & N1 & ->).
  destruct (component_32 y3 z1 y1 z3) as (m3 & m4 & c2 & n2 & M3 & M4 & C2 & N2 & ->).
  destruct (component_32 y1 z2 y2 z1) as (m5 & m6 & c3 & n3 & M5 & M6 & C3 & N3 & ->).
  set (p1 := (y2 * z3 * (1 + m1) - y3 * z2 * (1 + m2)) * (1 + c1)). set (p2 := (y3 * z1 * (1 + m3) - y1 * z3 * (1 + m4)) * (1 + c2)).
  set (p3 := (y1 * z2 * (1 + m5) - y2 * z1 * (1 + m6)) * (1 + c3)).
  destruct (product_32 (x1 * (p1 + n1))) as (e1 & k1 & E1 & K1 & Q1). destruct (product_32 (x2 * (p2 + n2))) as (e2 & k2 & E2 & K2 & Q2).
  destruct (product_32 (x3 * (p3 + n3))) as (e3 & k3 & E3 & K3 & Q3).
  destruct (plus_32 (R32 (x1 * (p1 + n1))) (R32 (x2 * (p2 + n2))) (F_32 _) (F_32 _)) as (s1 & S1 & T1).
  destruct (plus_32 (R32 (R32 (x1 * (p1 + n1)) + R32 (x2 * (p2 + n2)))) (R32 (x3 * (p3 + n3))) (F_32 _) (F_32 _)) as (s2 & S2 & T2).
  rewrite T2, T1, Q1, Q2, Q3.
  exists (((x1 * p1 * (1 + e1) + x2 * p2 * (1 + e2)) * (1 + s1) + x3 * p3 * (1 + e3)) * (1 + s2)),
    (((x1 * n1 * (1 + e1) + k1 + (x2 * n2 * (1 + e2) + k2)) * (1 + s1) + (x3 * n3 * (1 + e3) + k3)) * (1 + s2)).
  split; [ring|]. split.
  - apply (triple u ltac:(lra)); assumption.
  - pose proof (pos_b _ _ A1) as PX. pose proof (bpow_gt_0 radix2 (-150)) as PE.
    assert (One : forall e, Rabs e <= u -> Rabs (1 + e) <= 1 + u) by (intros e He; apply add_b; [rewrite Rabs_R1; lra|exact He]).
    assert (T : forall w n e k, Rabs w <= X -> Rabs n <= 2 * eta * (1 + u) -> Rabs e <= u -> Rabs k <= eta ->
      Rabs (w * n * (1 + e) + k) <= X * (2 * eta * (1 + u)) * (1 + u) + eta).
    { intros w n e k Hw Hn He Hk. apply add_b; [|exact Hk]. apply mul_b; [now apply mul_b|now apply One]. }
    set (B := X * (2 * eta * (1 + u)) * (1 + u) + eta) in *.
    assert (PB : 0 <= B) by (unfold B; assert (0 <= X * eta) by (apply Rmult_le_pos; lra); lra).
    apply Rle_trans with (((B + B) * (1 + u) + B) * (1 + u)).
    + apply mul_b; [|now apply One]. apply add_b; [|now apply T]. apply mul_b; [|now apply One]. apply add_b; now apply T.
    + unfold B in *. assert (0 <= X * eta) by (apply Rmult_le_pos; lra). set (xe := X * eta) in *. lra.
Qed.

(** The determinants of a line and a triangle as evaluated. *)
Definition evaluated (v0 v1 v2 o d : vec) (found : determinants) : Prop :=
  let e1 := vsub R32 v1 v0 in let e2 := vsub R32 v2 v0 in let s := vsub R32 o v0 in
  is_triple (det found) e1 d e2 /\ is_triple (edge_u found) s d e2 /\ is_triple (edge_v found) d s e1 /\ is_triple (top_t found) e2 s e1 /\
  edge_w found = R32 (R32 (det found - edge_u found) - edge_v found).

Lemma evaluated_32 v0 v1 v2 o d : evaluated v0 v1 v2 o d (determinants_of R32 v0 v1 v2 o d).
Proof. repeat (split; [apply triple_32|]). reflexivity. Qed.

(** Edge functions that are off by at most delta: where one is certainly negative and one certainly positive, nothing is met. *)
Lemma opposite_is_missed found truth delta :
  Rabs (edge_u found - edge_u truth) <= delta -> Rabs (edge_v found - edge_v truth) <= delta -> Rabs (edge_w found - edge_w truth) <= delta ->
  edge_w truth = det truth - edge_u truth - edge_v truth ->
  edge_u found < - delta \/ edge_v found < - delta \/ edge_w found < - delta ->
  delta < edge_u found \/ delta < edge_v found \/ delta < edge_w found -> ~ meets truth.
Proof.
  intros U V W Q L H M. apply Rabs_le_inv in U, V, W.
  destruct (hit_signs _ _ _ _ M Q) as [S|S]; [destruct L as [L|[L|L]]|destruct H as [H|[H|H]]]; lra.
Qed.

(** * The errors *)

Section Floor.
Variables v0 v1 v2 o d : vec.
Hypothesis F0 : vformat v0.
Hypothesis F1 : vformat v1.
Hypothesis F2 : vformat v2.
Hypothesis Fo : vformat o.
Notation e1 := (vsub R32 v1 v0).
Notation e2 := (vsub R32 v2 v0).
Notation s := (vsub R32 o v0).
Variable found : determinants.
Hypothesis Found : evaluated v0 v1 v2 o d found.
Let truth := determinants_of exactly v0 v1 v2 o d.

(** The sizes, and an edge's size with the floor. *)
Variables D C E E' : R.
Hypothesis HD : bounded D d.
Hypothesis HC : bounded C s.
Hypothesis HE : bounded E e1 /\ bounded E e2.
Hypothesis D_range : bpow radix2 (-20) <= D.
Hypothesis E_floor : E <= E' /\ bpow radix2 (-60) <= E' /\ bpow radix2 (-120) <= D * (E' * E').

(** [bound] of [new], and that of [misses]. *)
Definition delta : R := R32 (R32 (R32 (39 * u * D) * E') * R32 (2 * C + E')).

Let PC : 0 <= C := pos_b _ _ (proj1 HC).
Let PE : 0 <= E := pos_b _ _ (proj1 (proj1 HE)).
Let PD : 0 < D := Rlt_le_trans _ _ _ (bpow_gt_0 radix2 (-20)) D_range.
Let PE' : 0 < E' := Rlt_le_trans _ _ _ (bpow_gt_0 radix2 (-60)) (proj1 (proj2 E_floor)).
Let P_eta : 0 < eta := bpow_gt_0 radix2 (-150).

(** Each value in two parts: with relative errors only, and what underflow adds. *)
Lemma parts : let k := 30 * u + 53 * (u * u) in exists rd ad ru au rv av,
  (det found = rd + ad /\ Rabs (rd - det truth) <= k * (D * E * E) /\ Rabs ad <= (6 * E + 3) * (tenth * eta)) /\
  (edge_u found = ru + au /\ Rabs (ru - edge_u truth) <= k * (D * C * E) /\ Rabs au <= (6 * C + 3) * (tenth * eta)) /\
  (edge_v found = rv + av /\ Rabs (rv - edge_v truth) <= k * (D * C * E) /\ Rabs av <= (6 * D + 3) * (tenth * eta)).
Proof.
  intros k. destruct HE as [B1 B2].
  destruct Found as ((_ & Nd) & (_ & Nu) & (_ & Nv) & _).
  destruct (Nd _ _ _ B1 HD B2) as (rd & ad & Qd & Td & Ud). destruct (Nu _ _ _ HC HD B2) as (ru & au & Qu & Tu & Uu).
  destruct (Nv _ _ _ HD HC B1) as (rv & av & Qv & Tv & Uv). exists rd, ad, ru, au, rv, av.
  pose proof (row_32 _ _ F1 F0) as R1. pose proof (row_32 _ _ F2 F0) as R2. pose proof (row_32 _ _ Fo F0) as R3.
  pose proof HD as (D1 & D2 & D3). pose proof HC as (C1 & C2 & C3). pose proof B1 as (X1 & X2 & X3). pose proof B2 as (Y1 & Y2 & Y3).
  pose proof (rows_xz u _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ X1 X2 X3 D1 D2 D3 Y1 Y2 Y3 R1 R2) as Wd.
  pose proof (rows_xz u _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ C1 C2 C3 D1 D2 D3 Y1 Y2 Y3 R3 R2) as Wu.
  pose proof (rows_yz u _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ D1 D2 D3 C1 C2 C3 X1 X2 X3 R3 R1) as Wv.
  pose proof (add_b _ _ _ _ Td Wd) as Sd. pose proof (add_b _ _ _ _ Tu Wu) as Su. pose proof (add_b _ _ _ _ Tv Wv) as Sv.
  split; [split; [exact Qd|split; [|exact Ud]]|split; [split; [exact Qu|split; [|exact Uu]]|split; [exact Qv|split; [|exact Uv]]]].
  - match type of Sd with Rabs ?a <= ?b => replace (rd - det truth) with a by (unfold truth, exactly, det3; simpl; unfold dot; simpl; ring);
      replace (k * (D * E * E)) with b by (unfold k; ring) end. exact Sd.
  - match type of Su with Rabs ?a <= ?b => replace (ru - edge_u truth) with a by (unfold truth, exactly, det3; simpl; unfold dot; simpl; ring);
      replace (k * (D * C * E)) with b by (unfold k; ring) end. exact Su.
  - match type of Sv with Rabs ?a <= ?b => replace (rv - edge_v truth) with a by (unfold truth, exactly, det3; simpl; unfold dot; simpl; ring);
      replace (k * (D * C * E)) with b by (unfold k; ring) end. exact Sv.
Qed.

(** What underflow adds to W, which is more than what it adds to U and V. *)
Definition under : R := (6 * (C + D + E) + 9) * (102 / 100 * eta).

Lemma errors : let b := 77 / 2 * u * (D * E * (2 * C + E)) + under in
  Rabs (edge_u found - edge_u truth) <= b /\ Rabs (edge_v found - edge_v truth) <= b /\ Rabs (edge_w found - edge_w truth) <= b.
Proof.
  intros b. destruct parts as (rd & ad & ru & au & rv & av & (Qd & Kd & Ad) & (Qu & Ku & Au) & (Qv & Kv & Av)).
  assert (PCe : 0 <= C * eta) by (apply Rmult_le_pos; lra). assert (PEe : 0 <= E * eta) by (apply Rmult_le_pos; lra).
  assert (PDe : 0 <= D * eta) by (apply Rmult_le_pos; lra).
  assert (Un : under = 612 / 100 * (C * eta) + 612 / 100 * (D * eta) + 612 / 100 * (E * eta) + 918 / 100 * eta) by (unfold under; field).
  set (DCE := D * C * E) in *. assert (P1 : 0 <= DCE) by (unfold DCE; repeat apply Rmult_le_pos; lra).
  assert (P2 : 0 <= D * E * E) by (repeat apply Rmult_le_pos; lra).
  assert (Eb : b = 77 / 2 * u * (2 * DCE + D * E * E) + under) by (unfold b, DCE; ring).
  split; [|split].
  - rewrite Qu. replace (ru + au - edge_u truth) with (ru - edge_u truth + au) by ring. eapply Rle_trans; [apply add_b; eassumption|].
    rewrite Eb, Un. set (x := D * E * E) in *. clearbody DCE x. lra.
  - rewrite Qv. replace (rv + av - edge_v truth) with (rv - edge_v truth + av) by ring. eapply Rle_trans; [apply add_b; eassumption|].
    rewrite Eb, Un. set (x := D * E * E) in *. clearbody DCE x. lra.
  - destruct Found as ((Fd & _) & (Fu & _) & (Fv & _) & _ & ->).
    destruct (less_32 (det found) (edge_u found) Fd Fu) as (w1 & W1 & E1). rewrite E1.
    assert (FF : F ((det found - edge_u found) * (1 + w1))) by (rewrite <- E1; apply F_32).
    destruct (less_32 _ (edge_v found) FF Fv) as (w2 & W2 & E2). rewrite E2, Qd, Qu, Qv.
    pose proof HD as (D1 & D2 & D3). pose proof HC as (C1 & C2 & C3). pose proof HE as ((A1 & A2 & A3) & (B1 & B2 & B3)).
    destruct (row_b u _ _ _ _ _ _ C (row_32 _ _ Fo F0) C1 C2 C3) as (S1 & S2 & S3).
    destruct (row_b u _ _ _ _ _ _ E (row_32 _ _ F1 F0) A1 A2 A3) as (T1 & T2 & T3).
    destruct (row_b u _ _ _ _ _ _ E (row_32 _ _ F2 F0) B1 B2 B3) as (R1 & R2 & R3).
    assert (Hu : 0 < u <= / 2048) by lra.
    assert (L1 : Rabs (det truth - edge_u truth) <= 4 * ((1 + u) * (1 + u)) * (D * E * (C + E))).
    { replace (det truth - edge_u truth) with (det3 ((vx v1 - vx v0) - (vx o - vx v0)) ((vy v1 - vy v0) - (vy o - vy v0))
        ((vz v1 - vz v0) - (vz o - vz v0)) (vx d) (vy d) (vz d) (vx v2 - vx v0) (vy v2 - vy v0) (vz v2 - vz v0))
        by (unfold truth, exactly, det3; simpl; unfold dot; simpl; ring).
      replace (4 * ((1 + u) * (1 + u)) * (D * E * (C + E))) with (4 * ((E * (1 + u) + C * (1 + u)) * D * (E * (1 + u)))) by ring.
      apply det3_b; auto; apply sub_b; assumption. }
    assert (L2 : Rabs (edge_v truth) <= 4 * ((1 + u) * (1 + u)) * (D * C * E)).
    { replace (edge_v truth) with (det3 (vx d) (vy d) (vz d) (vx o - vx v0) (vy o - vy v0) (vz o - vz v0)
        (vx v1 - vx v0) (vy v1 - vy v0) (vz v1 - vz v0)) by (unfold truth, exactly, det3; simpl; unfold dot; simpl; ring).
      replace (4 * ((1 + u) * (1 + u)) * (D * C * E)) with (4 * (D * (C * (1 + u)) * (E * (1 + u)))) by ring.
      apply det3_b; assumption. }
    pose proof (third u Hu rd ru rv (det truth) (edge_u truth) (edge_v truth) w1 w2 D C E ltac:(lra) PC PE W1 W2 Kd Ku Kv L1 L2) as W.
    replace (edge_w truth) with (det truth - edge_u truth - edge_v truth) by reflexivity.
    replace (((rd + ad - (ru + au)) * (1 + w1) - (rv + av)) * (1 + w2) - (det truth - edge_u truth - edge_v truth)) with
      ((((rd - ru) * (1 + w1) - rv) * (1 + w2) - (det truth - edge_u truth - edge_v truth)) + ((ad - au) * (1 + w1) - av) * (1 + w2)) by ring.
    unfold b. apply add_b; [exact W|].
    assert (One : forall e, Rabs e <= u -> Rabs (1 + e) <= 1 + u) by (intros e He; apply add_b; [rewrite Rabs_R1; lra|exact He]).
    eapply Rle_trans; [apply mul_b; [apply sub_b; [apply mul_b; [apply sub_b; eassumption|now apply One]|eassumption]|now apply One]|].
    rewrite Un. lra.
Qed.

(** * The bound as evaluated *)

Lemma low_32 x : 0 <= x -> x * (1 - u) - eta <= R32 x.
Proof.
  intros Hx. destruct (product_32 x) as (e & n & He & Hn & ->). apply Rabs_le_inv in He, Hn.
  assert (x * (- u) <= x * e) by (apply Rmult_le_compat_l; lra). lra.
Qed.

Lemma low_normal x : bpow radix2 (-126) <= x -> x * (1 - u) <= R32 x.
Proof.
  intros Hx. assert (P : 0 <= x) by (pose proof (bpow_ge_0 radix2 (-126)); lra).
  rewrite (round_FLT_FLX radix2 (-149)) by (rewrite Rabs_pos_eq by exact P; exact Hx). exact (below 24 ltac:(lia) x P).
Qed.

Lemma delta_from_below : 3899 / 100 * u * (D * E' * (2 * C + E')) - eta <= delta.
Proof.
  pose proof E_floor as (_ & Lo & _). unfold delta.
  assert (L1 : 39 * u * D * (1 - u) <= R32 (39 * u * D)).
  { apply low_normal. apply Rle_trans with (bpow radix2 (-24 + -20)); [now apply bpow_le|]. rewrite bpow_plus.
    change (bpow radix2 (-24)) with u. assert (u * bpow radix2 (-20) <= u * D) by (apply Rmult_le_compat_l; lra). lra. }
  set (r1 := R32 (39 * u * D)) in *. assert (Lr : u * D <= r1) by lra. assert (Puf : 0 < u * D) by (apply Rmult_lt_0_compat; lra).
  assert (L2 : r1 * E' * (1 - u) <= R32 (r1 * E')).
  { apply low_normal. apply Rle_trans with (bpow radix2 (-24 + -20 + -60)); [now apply bpow_le|]. rewrite !bpow_plus.
    change (bpow radix2 (-24)) with u. pose proof (bpow_gt_0 radix2 (-20)). pose proof (bpow_gt_0 radix2 (-60)).
    apply Rmult_le_compat; lra. }
  assert (L3 : (2 * C + E') * (1 - u) <= R32 (2 * C + E')).
  { apply low_normal. apply Rle_trans with (bpow radix2 (-60)); [now apply bpow_le|lra]. }
  set (r2 := R32 (r1 * E')) in *. set (r3 := R32 (2 * C + E')) in *.
  assert (P2 : 0 <= r1 * E') by (apply Rmult_le_pos; lra). assert (P2' : 0 <= r2) by (eapply Rle_trans; [|exact L2]; apply Rmult_le_pos; lra).
  assert (P3 : 0 <= r3) by (eapply Rle_trans; [|exact L3]; apply Rmult_le_pos; lra).
  pose proof (low_32 (r2 * r3) (Rmult_le_pos _ _ P2' P3)) as L4.
  assert (T : 39 * u * D * (1 - u) * E' * (1 - u) * ((2 * C + E') * (1 - u)) <= r2 * r3).
  { apply Rmult_le_compat; [repeat apply Rmult_le_pos; lra|apply Rmult_le_pos; lra| |exact L3]. eapply Rle_trans; [|exact L2].
    apply Rmult_le_compat_r; [lra|]. apply Rmult_le_compat_r; [lra|exact L1]. }
  set (P := D * E' * (2 * C + E')). assert (PP : 0 <= P) by (unfold P; repeat apply Rmult_le_pos; lra).
  replace (39 * u * D * (1 - u) * E' * (1 - u) * ((2 * C + E') * (1 - u))) with (39 * u * ((1 - u) * (1 - u) * (1 - u)) * P) in T by (unfold P; ring).
  assert (39 * u * ((1 - u) * (1 - u) * (1 - u)) * P * (1 - u) <= r2 * r3 * (1 - u)) by (apply Rmult_le_compat_r; lra). lra.
Qed.

(** What the floor is for: the bound covers what underflow adds too. *)
Lemma floor_covers : 77 / 2 * u * (D * E * (2 * C + E)) + under <= 3899 / 100 * u * (D * E' * (2 * C + E')) - eta.
Proof.
  pose proof E_floor as (Le & Lo & Sq).
  assert (H1 : D * E * (2 * C + E) <= D * E' * (2 * C + E')).
  { apply Rmult_le_compat; try lra; [apply Rmult_le_pos; lra|]. apply Rmult_le_compat_l; lra. }
  set (a := D * E') in *. assert (La : bpow radix2 (-80) <= a).
  { change (-80)%Z with (-20 + -60)%Z. rewrite bpow_plus. apply Rmult_le_compat; try assumption; apply bpow_ge_0. }
  assert (E80 : bpow radix2 (-80) = 1180591620717411303424 * eta) by (change 1180591620717411303424 with (bpow radix2 70); rewrite <- bpow_plus; reflexivity).
  assert (E120 : bpow radix2 (-120) = 1073741824 * eta) by (change 1073741824 with (bpow radix2 30); rewrite <- bpow_plus; reflexivity).
  assert (E60 : bpow radix2 (-60) * bpow radix2 (-60) = 1073741824 * eta) by (rewrite <- E120, <- bpow_plus; reflexivity).
  replace (D * (E' * E')) with (a * E') in Sq by (unfold a; ring).
  (* C: 2 a C u covers it. E, D and the rest: a E' u does. *)
  assert (HCa : 612 / 100 * (C * eta) <= / 100 * u * (a * (2 * C))).
  { replace (/ 100 * u * (a * (2 * C))) with (/ 100 * u * 2 * a * C) by ring. rewrite (Rmult_comm C), <- Rmult_assoc. apply Rmult_le_compat_r; [exact PC|].
    rewrite E80 in La. lra. }
  assert (HEa : 612 / 100 * (E * eta) <= / 100 * u * (a * E')).
  { apply Rle_trans with (612 / 100 * eta * E'); [assert (E * eta <= E' * eta) by (apply Rmult_le_compat_r; lra); lra|].
    rewrite <- Rmult_assoc. apply Rmult_le_compat_r; [lra|]. rewrite E80 in La. lra. }
  assert (HDa : 612 / 100 * (D * eta) <= 10 / 100 * u * (a * E')).
  { replace (a * E') with (D * (E' * E')) by (unfold a; ring). assert (Q : 1073741824 * eta <= E' * E').
    { rewrite <- E60. apply Rmult_le_compat; try assumption; apply bpow_ge_0. }
    replace (10 / 100 * u * (D * (E' * E'))) with (D * (10 / 100 * u * (E' * E'))) by ring.
    replace (612 / 100 * (D * eta)) with (D * (612 / 100 * eta)) by ring. apply Rmult_le_compat_l; [lra|]. lra. }
  assert (H1a : 1018 / 100 * eta <= 16 / 100 * u * (a * E')) by (rewrite E120 in Sq; lra).
  replace (D * E * (2 * C + E)) with (D * E * (2 * C + E)) by ring. unfold under.
  replace (a * (2 * C + E')) with (a * (2 * C) + a * E') in * by ring.
  assert (0 <= a * (2 * C)) by (apply Rmult_le_pos; [unfold a; apply Rmult_le_pos; lra|lra]). set (x := a * (2 * C)) in *. set (y := a * E') in *.
  set (w := D * E * (2 * C + E)) in *. lra.
Qed.

(** Edge functions are off by at most delta as evaluated, underflow included. [EXACT-5] *)
Theorem floor_is_enough : Rabs (edge_u found - edge_u truth) <= delta /\ Rabs (edge_v found - edge_v truth) <= delta /\
  Rabs (edge_w found - edge_w truth) <= delta.
Proof. pose proof floor_covers. pose proof delta_from_below. destruct errors as (U & V & W). repeat split; lra. Qed.

(** [misses]: one value below -delta, and one above delta. *)
Definition misses : Prop :=
  (edge_u found < - delta \/ edge_v found < - delta \/ edge_w found < - delta) /\
  (delta < edge_u found \/ delta < edge_v found \/ delta < edge_w found).

(** A miss is one. [EXACT-5] *)
Theorem single_miss_is_right : misses -> ~ meets truth.
Proof. destruct floor_is_enough as (U & V & W). intros [L H]. now apply (opposite_is_missed found truth delta U V W eq_refl). Qed.
End Floor.

(** As [ExactFromSingle] has it: a direction of a greatest component from 1 to 2, and a floor of 2^-60. [EXACT-5] *)
Theorem scaled_miss_is_right v0 v1 v2 o d D C E : vformat v0 -> vformat v1 -> vformat v2 -> vformat o ->
  bounded D d -> 1 <= D -> bounded C (vsub R32 o v0) -> bounded E (vsub R32 v1 v0) /\ bounded E (vsub R32 v2 v0) ->
  misses (determinants_of R32 v0 v1 v2 o d) D C (Rmax E (bpow radix2 (-60))) -> ~ meets (determinants_of exactly v0 v1 v2 o d).
Proof.
  intros F0 F1 F2 Fo HD H1 HC HE. pose proof (Rmax_l E (bpow radix2 (-60))) as L. pose proof (Rmax_r E (bpow radix2 (-60))) as R.
  set (E' := Rmax E (bpow radix2 (-60))) in *. apply single_miss_is_right with E; try assumption; [apply evaluated_32| |].
  - apply Rle_trans with 1; [|exact H1]. change 1 with (bpow radix2 0). now apply bpow_le.
  - repeat split; try assumption. change (-120)%Z with (-60 + -60)%Z. rewrite bpow_plus, <- (Rmult_1_l (_ * _)).
    pose proof (bpow_ge_0 radix2 (-60)). apply Rmult_le_compat; try lra; [apply Rmult_le_pos; lra|]. apply Rmult_le_compat; lra.
Qed.
