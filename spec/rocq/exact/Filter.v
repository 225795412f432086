(** [Determinants] and [Errors] of src/geom/kernel/exact/filter.rs, operation by operation, with relative errors only (no least
    exponent; Range.v shows that for single-precision data this is double precision). *)
Require Import Reals ZArith Lia Lra Psatz.
From Flocq Require Import Core.
Require Import StacklessExact.Rounding StacklessExact.Triple.
Open Scope R_scope.

(** * The operations, with any rounding *)

Record vec : Type := Vec { vx : R; vy : R; vz : R }.

Section Operations.
Variable RN : R -> R.

(** glam's operators for [DVec3]: [-], [cross], [dot]. *)
Definition vsub (a b : vec) : vec := Vec (RN (vx a - vx b)) (RN (vy a - vy b)) (RN (vz a - vz b)).
Definition cross (a b : vec) : vec :=
  Vec (RN (RN (vy a * vz b) - RN (vy b * vz a))) (RN (RN (vz a * vx b) - RN (vz b * vx a))) (RN (RN (vx a * vy b) - RN (vx b * vy a))).
Definition dot (a b : vec) : R := RN (RN (RN (vx a * vx b) + RN (vy a * vy b)) + RN (vz a * vz b)).

(** [Determinants::of]. Without rounding it is the definition of EXACT-1. *)
Record determinants : Type := Determinants { det : R; edge_u : R; edge_v : R; edge_w : R; top_t : R }.
Definition determinants_of (v0 v1 v2 o d : vec) : determinants :=
  let e1 := vsub v1 v0 in
  let e2 := vsub v2 v0 in
  let s := vsub o v0 in
  let p := cross d e2 in
  let q := cross s e1 in
  let det := dot e1 p in
  let u := dot s p in
  let v := dot d q in
  Determinants det u v (RN (RN (det - u) - v)) (dot e2 q).

(** [Errors::new], from bounds of the components of d, s, e1 and e2. The constants, products of an integer and a power of two, are
    exact. *)
Variable unit : R.
Definition error_sign (d c e : R) : R := RN (RN (78 * unit * RN (d * e)) * RN (c + e)).
Definition error_det (d e : R) : R := RN (31 * unit * (5 / 4) * RN (d * RN (e * e))).
Definition error_t (c e : R) : R := RN (35 * unit * (5 / 4) * RN (c * RN (e * e))).

(** [Determinants::over_determinant]: a numerator, its error, the determinant and its error. *)
Definition over_determinant (numerator error det error_of_det : R) : R * R :=
  let reciprocal := RN (1 / det) in
  let x := RN (numerator * reciprocal) in
  let e := RN (RN (RN (error + RN (Rabs x * error_of_det)) * Rabs reciprocal) + RN (Rabs x * (4 * unit))) in
  (RN (x - e), RN (x + e)).
End Operations.

(** [Determinants::front]: the sign of the determinant as computed, which may be either for a 0. *)
Definition sign_bit := Triple.sign_bit.
Definition front := Triple.front.

(** [Determinants::is_miss] and [is_hit]. *)
Definition is_miss (neg : bool) (sigma : R) (x : determinants) : Prop :=
  front neg (edge_u x) < - sigma \/ front neg (edge_v x) < - sigma \/ front neg (edge_w x) < - sigma.
Definition is_hit (neg : bool) (sigma : R) (x : determinants) : Prop :=
  sigma < front neg (edge_u x) /\ sigma < front neg (edge_v x) /\ sigma < front neg (edge_w x).

(** The line meets the closed triangle: EXACT-1. *)
Definition meets (x : determinants) : Prop := hit (det x) (edge_u x) (edge_v x) (edge_w x).

Definition bounded (B : R) (v : vec) : Prop := Rabs (vx v) <= B /\ Rabs (vy v) <= B /\ Rabs (vz v) <= B.
Definition exactly (x : R) : R := x.

(** * The errors *)

Section Filter.
Variable prec : Z.
Context { prec_pos : Prec_gt_0 prec }.
Hypothesis prec_11 : (11 <= prec)%Z.
Notation RN := (round radix2 (FLX_exp prec) ZnearestE).
Notation u := (Rounding.unit prec).

Let Hu : 0 < u <= / 2048 := Hu prec prec_11.
Let rel := rel prec prec_11.

Lemma triple_fl x y z A B C : bounded A x -> bounded B y -> bounded C z ->
  Rabs (dot RN x (cross RN y z) - det3 (vx x) (vy x) (vz x) (vx y) (vy y) (vz y) (vx z) (vy z) (vz z)) <=
    (22 * u + 49 * (u * u)) * (A * B * C).
Proof.
  destruct x as [x1 x2 x3], y as [y1 y2 y3], z as [z1 z2 z3]. intros (? & ? & ?) (? & ? & ?) (? & ? & ?). unfold dot, cross.
  cbn [vx vy vz] in *. rewrite (Rmult_comm z2 y3), (Rmult_comm z3 y1), (Rmult_comm z1 y2).
  destruct (rel (y2 * z3)) as (m1 & M1 & ->). destruct (rel (y3 * z2)) as (m2 & M2 & ->).
  destruct (rel (y3 * z1)) as (m3 & M3 & ->). destruct (rel (y1 * z3)) as (m4 & M4 & ->).
  destruct (rel (y1 * z2)) as (m5 & M5 & ->). destruct (rel (y2 * z1)) as (m6 & M6 & ->).
  match goal with |- context [RN (?a - ?b)] => destruct (rel (a - b)) as (c1 & C1 & ->) end.
  match goal with |- context [RN (?a - ?b)] => destruct (rel (a - b)) as (c2 & C2 & ->) end.
  match goal with |- context [RN (?a - ?b)] => destruct (rel (a - b)) as (c3 & C3 & ->) end.
  match goal with |- context [RN (x1 * ?a)] => destruct (rel (x1 * a)) as (e1 & E1 & ->) end.
  match goal with |- context [RN (x2 * ?a)] => destruct (rel (x2 * a)) as (e2 & E2 & ->) end.
  match goal with |- context [RN (x3 * ?a)] => destruct (rel (x3 * a)) as (e3 & E3 & ->) end.
  match goal with |- context [RN (RN (?a + ?b) + _)] => destruct (rel (a + b)) as (s1 & S1 & ->) end.
  match goal with |- context [RN (?a + ?b)] => destruct (rel (a + b)) as (s2 & S2 & ->) end.
  apply (triple u Hu); assumption.
Qed.

Lemma rounded x y z : row u (RN x) (RN y) (RN z) x y z.
Proof.
  destruct (back prec prec_11 x) as (a & A & Ha), (back prec prec_11 y) as (b & B & Hb), (back prec prec_11 z) as (c & C & Hc).
  exists a, b, c. repeat split; assumption.
Qed.

Variables v0 v1 v2 o d : vec.
Notation e1 := (vsub RN v1 v0).
Notation e2 := (vsub RN v2 v0).
Notation s := (vsub RN o v0).
Let found := determinants_of RN v0 v1 v2 o d.
Let truth := determinants_of exactly v0 v1 v2 o d.

Variables D C E : R.
Hypothesis HD : bounded D d.
Hypothesis HC : bounded C s.
Hypothesis HE : bounded E e1 /\ bounded E e2.

Let PD : 0 <= D := pos_b _ _ (proj1 HD).
Let PC : 0 <= C := pos_b _ _ (proj1 HC).
Let PE : 0 <= E := pos_b _ _ (proj1 (proj1 HE)).

Definition k := 30 * u + 53 * (u * u).

(** The determinant is off by at most 31 u D E E. [EXACT-4] *)
Theorem det_off : Rabs (det found - det truth) <= k * (D * E * E).
Proof.
  destruct HE as [H1 H2]. pose proof (triple_fl e1 d e2 E D E H1 HD H2) as T.
  destruct HD as (? & ? & ?), H1 as (? & ? & ?), H2 as (? & ? & ?).
  assert (R : Rabs (det3 (vx e1) (vy e1) (vz e1) (vx d) (vy d) (vz d) (vx e2) (vy e2) (vz e2) - det truth) <=
    (8 * u + 4 * (u * u)) * (E * D * E)).
  { replace (det truth) with (det3 (vx v1 - vx v0) (vy v1 - vy v0) (vz v1 - vz v0) (vx d) (vy d) (vz d)
      (vx v2 - vx v0) (vy v2 - vy v0) (vz v2 - vz v0)) by (unfold truth, exactly, det3; simpl; unfold dot; simpl; ring).
    apply (rows_xz u); try assumption; apply rounded. }
  pose proof (add_b _ _ _ _ T R) as S. unfold k.
  match type of S with Rabs ?a <= ?b => replace a with (det found - det truth) in S by (simpl; ring);
    replace b with ((30 * u + 53 * (u * u)) * (D * E * E)) in S by ring end. exact S.
Qed.

(** U is off by at most 31 u D C E. [EXACT-4] *)
Theorem u_off : Rabs (edge_u found - edge_u truth) <= k * (D * C * E).
Proof.
  destruct HE as [H1 H2]. pose proof (triple_fl s d e2 C D E HC HD H2) as T.
  destruct HD as (? & ? & ?), HC as (? & ? & ?), H2 as (? & ? & ?).
  assert (R : Rabs (det3 (vx s) (vy s) (vz s) (vx d) (vy d) (vz d) (vx e2) (vy e2) (vz e2) - edge_u truth) <=
    (8 * u + 4 * (u * u)) * (C * D * E)).
  { replace (edge_u truth) with (det3 (vx o - vx v0) (vy o - vy v0) (vz o - vz v0) (vx d) (vy d) (vz d)
      (vx v2 - vx v0) (vy v2 - vy v0) (vz v2 - vz v0)) by (unfold truth, exactly, det3; simpl; unfold dot; simpl; ring).
    apply (rows_xz u); try assumption; apply rounded. }
  pose proof (add_b _ _ _ _ T R) as S. unfold k.
  match type of S with Rabs ?a <= ?b => replace a with (edge_u found - edge_u truth) in S by (simpl; ring);
    replace b with ((30 * u + 53 * (u * u)) * (D * C * E)) in S by ring end. exact S.
Qed.

(** So is V. [EXACT-4] *)
Theorem v_off : Rabs (edge_v found - edge_v truth) <= k * (D * C * E).
Proof.
  destruct HE as [H1 H2]. pose proof (triple_fl d s e1 D C E HD HC H1) as T.
  destruct HD as (? & ? & ?), HC as (? & ? & ?), H1 as (? & ? & ?).
  assert (R : Rabs (det3 (vx d) (vy d) (vz d) (vx s) (vy s) (vz s) (vx e1) (vy e1) (vz e1) - edge_v truth) <=
    (8 * u + 4 * (u * u)) * (D * C * E)).
  { replace (edge_v truth) with (det3 (vx d) (vy d) (vz d) (vx o - vx v0) (vy o - vy v0) (vz o - vz v0)
      (vx v1 - vx v0) (vy v1 - vy v0) (vz v1 - vz v0)) by (unfold truth, exactly, det3; simpl; unfold dot; simpl; ring).
    apply (rows_yz u); try assumption; apply rounded. }
  pose proof (add_b _ _ _ _ T R) as S. unfold k.
  match type of S with Rabs ?a <= ?b => replace a with (edge_v found - edge_v truth) in S by (simpl; ring);
    replace b with ((30 * u + 53 * (u * u)) * (D * C * E)) in S by ring end. exact S.
Qed.

(** T is off by at most 35 u C E E. [EXACT-4] *)
Theorem t_off : Rabs (top_t found - top_t truth) <= (34 * u + 62 * (u * u)) * (C * E * E).
Proof.
  destruct HE as [H1 H2]. pose proof (triple_fl e2 s e1 E C E H2 HC H1) as T.
  destruct HC as (? & ? & ?), H1 as (? & ? & ?), H2 as (? & ? & ?).
  assert (R : Rabs (det3 (vx e2) (vy e2) (vz e2) (vx s) (vy s) (vz s) (vx e1) (vy e1) (vz e1) - top_t truth) <=
    (12 * u + 13 * (u * u)) * (E * C * E)).
  { replace (top_t truth) with (det3 (vx v2 - vx v0) (vy v2 - vy v0) (vz v2 - vz v0) (vx o - vx v0) (vy o - vy v0) (vz o - vz v0)
      (vx v1 - vx v0) (vy v1 - vy v0) (vz v1 - vz v0)) by (unfold truth, exactly, det3; simpl; unfold dot; simpl; ring).
    apply (rows_xyz u Hu); try assumption; apply rounded. }
  pose proof (add_b _ _ _ _ T R) as S.
  match type of S with Rabs ?a <= ?b => replace a with (top_t found - top_t truth) in S by (simpl; ring);
    replace b with ((34 * u + 62 * (u * u)) * (C * E * E)) in S by ring end. exact S.
Qed.

(** W is off by at most 39 u D E (2C + E). [EXACT-4] *)
Theorem w_off : Rabs (edge_w found - edge_w truth) <= (77 / 2) * u * (D * E * (2 * C + E)).
Proof.
  destruct (rel (det found - edge_u found)) as (w1 & W1 & Ew1).
  destruct (rel ((det found - edge_u found) * (1 + w1) - edge_v found)) as (w2 & W2 & Ew2).
  replace (edge_w found) with (((det found - edge_u found) * (1 + w1) - edge_v found) * (1 + w2)) by (rewrite <- Ew2, <- Ew1; reflexivity).
  replace (edge_w truth) with (det truth - edge_u truth - edge_v truth) by reflexivity.
  pose proof HD as (D1 & D2 & D3). pose proof HC as (C1 & C2 & C3). pose proof HE as ((A1 & A2 & A3) & (B1 & B2 & B3)).
  destruct (row_b u _ _ _ _ _ _ C (rounded (vx o - vx v0) (vy o - vy v0) (vz o - vz v0)) C1 C2 C3) as (S1 & S2 & S3).
  destruct (row_b u _ _ _ _ _ _ E (rounded (vx v1 - vx v0) (vy v1 - vy v0) (vz v1 - vz v0)) A1 A2 A3) as (T1 & T2 & T3).
  destruct (row_b u _ _ _ _ _ _ E (rounded (vx v2 - vx v0) (vy v2 - vy v0) (vz v2 - vz v0)) B1 B2 B3) as (R1 & R2 & R3).
  apply (third u Hu (det found) (edge_u found) (edge_v found) (det truth) (edge_u truth) (edge_v truth) w1 w2 D C E);
    auto using det_off, u_off, v_off.
  - replace (det truth - edge_u truth) with (det3 ((vx v1 - vx v0) - (vx o - vx v0)) ((vy v1 - vy v0) - (vy o - vy v0))
      ((vz v1 - vz v0) - (vz o - vz v0)) (vx d) (vy d) (vz d) (vx v2 - vx v0) (vy v2 - vy v0) (vz v2 - vz v0))
      by (unfold truth, exactly, det3; simpl; unfold dot; simpl; ring).
    replace (4 * ((1 + u) * (1 + u)) * (D * E * (C + E))) with (4 * ((E * (1 + u) + C * (1 + u)) * D * (E * (1 + u)))) by ring.
    apply det3_b; auto; apply sub_b; assumption.
  - replace (edge_v truth) with (det3 (vx d) (vy d) (vz d) (vx o - vx v0) (vy o - vy v0) (vz o - vz v0)
      (vx v1 - vx v0) (vy v1 - vy v0) (vz v1 - vz v0)) by (unfold truth, exactly, det3; simpl; unfold dot; simpl; ring).
    replace (4 * ((1 + u) * (1 + u)) * (D * C * E)) with (4 * (D * (C * (1 + u)) * (E * (1 + u)))) by ring.
    apply det3_b; assumption.
Qed.

(** * The bounds as evaluated *)

Let sigma := error_sign RN u D C E.
Notation below := (below prec prec_11).

(** A product of three as evaluated, with a constant. *)
Lemma sigma_from_below : (1 - 4 * / 2048) * (78 * u * (D * E * (C + E))) <= sigma.
Proof.

  assert (P1 : 0 <= D * E) by (apply Rmult_le_pos; assumption).
  assert (L1 := below (D * E) P1). assert (L2 := below (C + E) ltac:(lra)). unfold sigma, error_sign.
  set (r1 := RN (D * E)) in *. set (r2 := RN (C + E)) in *.
  assert (Zp : 0 <= 1 - u) by lra.
  assert (Q1 : 0 <= r1) by (eapply Rle_trans; [|exact L1]; apply Rmult_le_pos; assumption).
  assert (Q2 : 0 <= r2) by (eapply Rle_trans; [|exact L2]; apply Rmult_le_pos; lra).
  assert (Q0 : 0 <= 78 * u * r1) by (apply Rmult_le_pos; lra).
  assert (L3 := below (78 * u * r1) Q0). set (r3 := RN (78 * u * r1)) in *.
  assert (Q3 : 0 <= r3) by (eapply Rle_trans; [|exact L3]; apply Rmult_le_pos; assumption).
  assert (L4 := below (r3 * r2) (Rmult_le_pos _ _ Q3 Q2)). eapply Rle_trans; [|exact L4].
  set (z := 1 - u) in *. assert (Hz : 1 - / 2048 <= z <= 1) by (unfold z; lra). clearbody r1 r2 r3 z.
  assert (T : 78 * u * (D * E * z) * z * ((C + E) * z) * z <= r3 * r2 * z).
  { apply Rmult_le_compat_r; [lra|]. apply Rmult_le_compat; [repeat apply Rmult_le_pos; lra| |..].
    - apply Rmult_le_pos; lra.
    - eapply Rle_trans; [|exact L3]. apply Rmult_le_compat_r; [lra|]. apply Rmult_le_compat_l; lra.
    - exact L2. }
  eapply Rle_trans; [|exact T].
  assert (Z4 : 1 - 4 * / 2048 <= z * z * z * z).
  { clear - Hz. assert (1 - 2 * / 2048 <= z * z) by nra. assert (z * z <= 1) by nra. nra. }
  replace (78 * u * (D * E * z) * z * ((C + E) * z) * z) with (z * z * z * z * (78 * u * (D * E * (C + E)))) by ring.
  apply Rmult_le_compat_r; [|exact Z4]. repeat apply Rmult_le_pos; lra.
Qed.

Let DCE := D * C * E.
Let DEE := D * E * E.
Let P_DCE : 0 <= DCE. Proof. unfold DCE. repeat apply Rmult_le_pos; assumption. Qed.
Let P_DEE : 0 <= DEE. Proof. unfold DEE. repeat apply Rmult_le_pos; assumption. Qed.

Lemma k_small : 0 <= k <= (30 + 53 / 2048) * u.
Proof. pose proof Hu. unfold k. assert (0 < u * u) by (apply Rmult_lt_0_compat; lra). split; [lra|].
  assert (u * u <= u * / 2048) by (apply Rmult_le_compat_l; lra). lra. Qed.

(** The two parts of σ: an edge function and the determinant. [EXACT-6] *)
Theorem sigma_is_enough : (77 / 2) * u * (D * E * (2 * C + E)) + k * (D * E * E) <= sigma.
Proof.
  pose proof sigma_from_below as S. pose proof k_small as K.
  replace (D * E * (2 * C + E)) with (2 * DCE + DEE) by (unfold DCE, DEE; ring).
  replace (D * E * (C + E)) with (DCE + DEE) in S by (unfold DCE, DEE; ring). fold DEE.
  eapply Rle_trans; [|exact S]. clearbody DCE DEE.
  assert (0 <= u * DCE) by (apply Rmult_le_pos; lra). assert (0 <= u * DEE) by (apply Rmult_le_pos; lra).
  assert (k * DEE <= (30 + 53 / 2048) * u * DEE) by (apply Rmult_le_compat_r; lra). lra.
Qed.

Lemma edges_off : Rabs (edge_u found - edge_u truth) <= (77 / 2) * u * (D * E * (2 * C + E)) /\
  Rabs (edge_v found - edge_v truth) <= (77 / 2) * u * (D * E * (2 * C + E)).
Proof.
  pose proof u_off as U. pose proof v_off as V. pose proof k_small as K.
  replace (D * E * (2 * C + E)) with (2 * DCE + DEE) by (unfold DCE, DEE; ring). fold DCE in U, V.
  assert (k * DCE <= 77 / 2 * u * (2 * DCE + DEE)); [|lra].
  apply Rle_trans with ((30 + 53 / 2048) * u * DCE); [apply Rmult_le_compat_r; lra|].
  assert (0 <= u * DCE) by (apply Rmult_le_pos; lra). assert (0 <= u * DEE) by (apply Rmult_le_pos; lra). lra.
Qed.

(** [Determinants::is_miss] is never wrong, whatever sign the determinant has as computed. [EXACT-6] *)
Theorem is_miss_is_right neg : sign_bit neg (det found) -> is_miss neg sigma found -> ~ meets truth.
Proof.
  pose proof sigma_is_enough as S. destruct edges_off as [EU EV]. pose proof w_off as EW. pose proof det_off as ED.
  intros N [F|[F|F]].
  - apply (miss_is_certain neg (det found) (edge_u found) (det truth) _ _ _ (edge_u truth) _ _ N ED EU); auto; unfold front in F; lra.
  - apply (miss_is_certain neg (det found) (edge_v found) (det truth) _ _ _ (edge_v truth) _ _ N ED EV); auto; unfold front in F; lra.
  - apply (miss_is_certain neg (det found) (edge_w found) (det truth) _ _ _ (edge_w truth) _ _ N ED EW); auto; unfold front in F; lra.
Qed.

(** [Determinants::is_hit] is never wrong. [EXACT-6] *)
Theorem is_hit_is_right neg : is_hit neg sigma found -> meets truth.
Proof.
  pose proof sigma_is_enough as S. destruct edges_off as [EU EV]. pose proof w_off as EW. pose proof k_small.
  assert (0 <= k * (D * E * E)) by (apply Rmult_le_pos; [lra|assumption]).
  intros (U & V & W). apply (hit_is_certain neg (edge_u found) (edge_v found) (edge_w found) _ _ _ _
    ((77 / 2) * u * (D * E * (2 * C + E)))); auto; unfold front in *; lra.
Qed.

End Filter.
