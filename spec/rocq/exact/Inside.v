(** Crossings of a ray from a point: [locate] of src/trace/solid.rs and [Crossings] of src/trace/crossings.rs. CLOSED-2, WINDING-1. *)
Require Import Reals ZArith Lia Lra List Bool.
From Flocq Require Import Core.
Require Import StacklessExact.Filter StacklessExact.Parity StacklessExact.Chains StacklessExact.Fans.
Import ListNotations.
Open Scope R_scope.

Definition triangle : Type := vec * vec * vec.
Definition edges_of (t : triangle) : list edge := let '(a, b, c) := t in [(a, b); (b, c); (c, a)].
Definition edges (l : list triangle) : list edge := flat_map edges_of l.
Definition normal (t : triangle) : vec := let '(a, b, c) := t in cross3 (less b a) (less c a).

(** * The code *)

Section Code.
Variables o d : vec.

(** [is_crossing] for a ray from 0 to infinity: by the rule of PARITY-1, and a hit. *)
Definition is_crossing (t : triangle) : bool := let '(a, b, c) := t in let x := determinants_of exactly a b c o d in
  negb (Req_bool (det x) 0) && (edge_sign o d a b =? edge_sign o d b c)%Z && (edge_sign o d b c =? edge_sign o d c a)%Z && Rle_bool 0 (top_t x / det x).
(** [sense]: the sign of d . n. *)
Definition sense (t : triangle) : Z := sign (dot3 d (normal t)).
Definition crossing (t : triangle) : Z := if is_crossing t then sense t else 0%Z.
(** The count for parity, and the sum for the nonzero rule. *)
Definition count (l : list triangle) : Z := sum (fun t => Z.b2z (is_crossing t)) l.
Definition winding (l : list triangle) : Z := sum crossing l.

(** The ray of length 0 from o along d hits. *)
Definition touches (t : triangle) : Prop := let '(a, b, c) := t in let x := determinants_of exactly a b c o d in meets x /\ top_t x / det x = 0.
End Code.

(** [is_on]: along one of the axes. *)
Definition is_on (o : vec) (t : triangle) : Prop := touches o (Vec 1 0 0) t \/ touches o (Vec 0 1 0) t \/ touches o (Vec 0 0 1) t.

(** * The surface *)

(** The closed triangle, if it has an area. *)
Definition contains (t : triangle) (o : vec) : Prop := let '(a, b, c) := t in normal t <> zero /\
  exists u v, 0 <= u /\ 0 <= v /\ 0 <= 1 - u - v /\ o = more a (more (scale u (less b a)) (scale v (less c a))).

Ltac exact_values := unfold exactly, normal, vol in *; cbn [det edge_u edge_v edge_w top_t determinants_of] in *; unfold Filter.dot, Filter.cross, vsub, exactly in *; vectors.

Lemma det_is a b c o d : det (determinants_of exactly a b c o d) = - dot3 d (normal (a, b, c)).
Proof. exact_values. ring. Qed.

Lemma top_is a b c o d : top_t (determinants_of exactly a b c o d) = - vol (less a o) (less b o) (less c o).
Proof. exact_values. ring. Qed.

Lemma touching_is_inside o d t : touches o d t -> contains t o.
Proof.
  destruct t as [[a b] c]. intros ((N & U & V & W) & T). cbn [contains]. set (x := determinants_of exactly a b c o d) in *. split.
  - intros E. apply N. unfold x. rewrite det_is, E. vectors. ring.
  - assert (T0 : top_t x = 0) by (apply Rmult_eq_reg_r with (/ det x); [unfold Rdiv in T; lra|now apply Rinv_neq_0_compat]).
    exists (edge_u x / det x), (edge_v x / det x). repeat split; try assumption.
    + replace (1 - edge_u x / det x - edge_v x / det x) with (edge_w x / det x); [exact W|]. change (edge_w x) with (det x - edge_u x - edge_v x). field. exact N.
    + assert (P : more (scale (det x) o) (scale (top_t x) d) = more (scale (det x) a) (more (scale (edge_u x) (less b a)) (scale (edge_v x) (less c a)))).
      { unfold x. exact_values. f_equal; ring. }
      rewrite T0 in P. destruct o as [o1 o2 o3], a as [a1 a2 a3], b as [b1 b2 b3], c as [c1 c2 c3]. set (u := edge_u x) in *. set (v := edge_v x) in *. set (e := det x) in *. clearbody u v e.
      vectors. injection P as P1 P2 P3. f_equal; (apply Rmult_eq_reg_l with e; [|exact N]); field_simplify_eq; try exact N; lra.
Qed.

Lemma inside_is_touched o d t : contains t o -> dot3 d (normal t) <> 0 -> touches o d t.
Proof.
  destruct t as [[a b] c]. intros (_ & u & v & U & V & W & E) N. unfold touches. set (x := determinants_of exactly a b c o d).
  assert (D : det x <> 0) by (unfold x; rewrite det_is; lra). assert (P : edge_u x = u * det x /\ edge_v x = v * det x /\ top_t x = 0).
  { subst o. unfold x. exact_values. repeat split; ring. }
  destruct P as (Pu & Pv & Pt). assert (Pw : edge_w x = (1 - u - v) * det x) by (change (edge_w x) with (det x - edge_u x - edge_v x); rewrite Pu, Pv; ring).
  assert (Q : forall s, s * det x / det x = s) by (intros; field; exact D). split; [split; [exact D|]|rewrite Pt; unfold Rdiv; ring].
  rewrite Pu, Pv, Pw, !Q. repeat split; assumption.
Qed.

(** A point is on a triangle with an area iff a ray of length 0 from it along one of the three axes hits it. [CLOSED-2](1) *)
Theorem is_on_is_right o t : is_on o t <-> contains t o.
Proof.
  split; [intros [H|[H|H]]; eapply touching_is_inside; exact H|]. intros H. assert (N : normal t <> zero) by (destruct t as [[a b] c]; apply H).
  destruct (Req_dec (vx (normal t)) 0) as [X|X]; [destruct (Req_dec (vy (normal t)) 0) as [Y|Y]; [destruct (Req_dec (vz (normal t)) 0) as [Z|Z]|]|].
  - exfalso. apply N. destruct (normal t). cbn in X, Y, Z. subst. reflexivity.
  - right. right. apply inside_is_touched; [exact H|]. unfold dot3. cbn [vx vy vz]. lra.
  - right. left. apply inside_is_touched; [exact H|]. unfold dot3. cbn [vx vy vz]. lra.
  - left. apply inside_is_touched; [exact H|]. unfold dot3. cbn [vx vy vz]. lra.
Qed.

(** * Small numbers *)

Definition small (P : R -> Prop) : Prop := exists e0, 0 < e0 /\ forall e, 0 < e < e0 -> P e.

Lemma small_true (P : R -> Prop) : (forall e, P e) -> small P.
Proof. intros H. exists 1. split; [lra|auto]. Qed.

Lemma small_and P Q : small P -> small Q -> small (fun e => P e /\ Q e).
Proof.
  intros (a & A & HA) (b & B & HB). exists (Rmin a b). split; [now apply Rmin_glb_lt|]. intros e H. pose proof (Rmin_l a b). pose proof (Rmin_r a b).
  split; [apply HA|apply HB]; lra.
Qed.

Lemma small_imp (P Q : R -> Prop) : (forall e, P e -> Q e) -> small P -> small Q.
Proof. intros H (a & A & HA). exists a. split; [exact A|]. intros e E. apply H. now apply HA. Qed.

Lemma small_all {A} (P : A -> R -> Prop) l : (forall x, In x l -> small (P x)) -> small (fun e => forall x, In x l -> P x e).
Proof.
  induction l as [|x l IH]; intros H; [apply small_true; intros e x []|]. eapply small_imp; [|exact (small_and _ _ (H x (or_introl eq_refl)) (IH (fun y I => H y (or_intror I))))].
  intros e (E & F) y [->|I]; auto.
Qed.

Lemma small_poly l : ~ Forall (fun x => x = 0) l -> small (fun e => poly l e <> 0).
Proof.
  intros N. destruct (small_decides l) as (a & A & H). exists a. split; [exact A|]. intros e E Z. apply N. apply first_sign_0. rewrite <- (H e E). now apply sign_0.
Qed.

(** A direction that is orthogonal to none of these vectors. *)
Lemma some_direction l : (forall v, In v l -> v <> zero) -> exists e, forall v, In v l -> dot3 e v <> 0.
Proof.
  intros H. destruct (small_all (fun v e => dot3 (Vec 1 e (e * e)) v <> 0) l) as (a & A & S).
  - intros v I. specialize (H v I). eapply small_imp; [|apply (small_poly [vx v; vy v; vz v])].
    + intros e E C. apply E. rewrite <- C. unfold dot3. cbn. ring.
    + intros F. apply H. destruct v as [x y z]. inversion_clear F as [|? ? F1 F2]. inversion_clear F2 as [|? ? F3 F4]. inversion_clear F4 as [|? ? F5 _]. cbn in *. subst. reflexivity.
  - exists (Vec 1 (a / 2) (a / 2 * (a / 2))). intros v I. apply (S (a / 2)); [lra|exact I].
Qed.

(** * A crossing is a cover, from the moved origin *)

Definition at_ (m : vec) (t : triangle) : triangle := let '(a, b, c) := t in (less a m, less b m, less c m).
Definition covers_of (x : vec) (t : triangle) : Z := let '(a, b, c) := t in spans a b c x.

Lemma F_is o d a b : F d o a b = vol d (less a o) (less b o).
Proof. reflexivity. Qed.

Lemma volume_moves a b c o e : vol (less a (moved o e)) (less b (moved o e)) (less c (moved o e)) =
  poly [vol (less a o) (less b o) (less c o); - vx (normal (a, b, c)); - vy (normal (a, b, c)); - vz (normal (a, b, c))] e.
Proof. unfold moved. cbn [poly]. exact_values. ring. Qed.

Lemma no_area a b c o : normal (a, b, c) = zero -> vol (less a o) (less b o) (less c o) = 0.
Proof.
  intros N. replace (vol (less a o) (less b o) (less c o)) with (dot3 (less a o) (normal (a, b, c))) by (exact_values; ring). rewrite N. vectors. ring.
Qed.

Lemma sum_of_edges o d a b c : F d o a b + F d o b c + F d o c a = dot3 d (normal (a, b, c)).
Proof. unfold F. exact_values. ring. Qed.

Lemma agree_0 y z w : agree 0 y z w = 0%Z.
Proof. unfold agree. destruct ((0 =? y) && (y =? z) && (z =? w))%Z; reflexivity. Qed.

(** From a point that is not on it, a triangle is crossed with the sense with which it covers the direction of the ray, as seen from the
    origin of PARITY-1. [CLOSED-2, PARITY-1] *)
Theorem crossing_is_cover o d t : ~ contains t o -> small (fun e => crossing o d t = covers_of d (at_ (moved o e) t)).
Proof.
  intros Off. destruct t as [[a b] c]. cbn [at_ covers_of]. destruct (same (normal (a, b, c)) zero) eqn:N0.
  { apply same_iff in N0. apply small_true. intros e. unfold spans. rewrite (no_area _ _ _ (moved o e) N0), (proj2 (sign_0 0) eq_refl), agree_0. unfold crossing, is_crossing.
    rewrite det_is, N0. replace (dot3 d zero) with 0 by (vectors; ring). rewrite Ropp_0, Req_bool_true by reflexivity. reflexivity. }
  apply same_false in N0. set (D := vol (less a o) (less b o) (less c o)).
  destruct (small_decides [D; - vx (normal (a, b, c)); - vy (normal (a, b, c)); - vz (normal (a, b, c))]) as (e1 & P1 & H1).
  set (fs := first_sign [D; - vx (normal (a, b, c)); - vy (normal (a, b, c)); - vz (normal (a, b, c))]) in *.
  assert (HD : small (fun e => sign (vol (less a (moved o e)) (less b (moved o e)) (less c (moved o e))) = fs)).
  { exists e1. split; [exact P1|]. intros e E. rewrite volume_moves. now apply H1. }
  assert (Fs : D <> 0 -> fs = sign D) by (intros ND; unfold fs, sign; cbn [first_sign]; destruct (Rlt_dec D 0), (Rlt_dec 0 D); try reflexivity; exfalso; lra).
  eapply small_imp; [|exact (small_and _ _ HD (small_and _ _ (rule_is_move o d a b) (small_and _ _ (rule_is_move o d b c) (rule_is_move o d c a))))].
  intros e (S & Ec & Ea & Eb). unfold spans. rewrite S. rewrite <- !F_is, Ea, Eb, Ec. clear S. unfold crossing, is_crossing, sense, agree.
  pose proof (no_sign_is_0 o d a b c) as NS. cbv zeta. rewrite det_is, top_is in *. fold D. set (n := dot3 d (normal (a, b, c))) in *. fold n in NS.
  destruct (Req_bool_spec (- n) 0) as [Z|NZ]; cbn [negb andb].
  - (* The moved line misses: det is the sum of the edge functions. *)
    assert (Q : n = 0) by lra. pose proof (sum_of_edges (moved o e) d a b c) as Sum. fold n in Sum.
    destruct ((fs =? _) && _ && _)%Z eqn:A; [|reflexivity]. rewrite !andb_true_iff, !Z.eqb_eq in A. destruct A as ((A1 & A2) & A3). rewrite Q in Sum.
    rewrite <- Ea in A1. rewrite <- Ea, <- Eb in A2. rewrite <- Eb, <- Ec in A3. rewrite A1.
    destruct (sign_cases (F d (moved o e) b c)) as [(X & Sx)|[(X & Sx)|(X & Sx)]], (sign_cases (F d (moved o e) c a)) as [(Y & Sy)|[(Y & Sy)|(Y & Sy)]],
      (sign_cases (F d (moved o e) a b)) as [(W & Sw)|[(W & Sw)|(W & Sw)]]; rewrite ?Sx, ?Sy, ?Sw in *; try discriminate; try reflexivity; exfalso; lra.
  - destruct (NS NZ) as (N1 & N2 & N3).
    destruct (edge_sign o d a b =? edge_sign o d b c)%Z eqn:E1; cbn [andb].
    2: { apply Z.eqb_neq in E1. destruct ((fs =? _) && _ && _)%Z eqn:A; [|reflexivity]. rewrite !andb_true_iff, !Z.eqb_eq in A. exfalso. destruct A as ((A1 & A2) & A3). congruence. }
    apply Z.eqb_eq in E1. destruct (edge_sign o d b c =? edge_sign o d c a)%Z eqn:E2; cbn [andb].
    2: { apply Z.eqb_neq in E2. destruct ((fs =? _) && _ && _)%Z eqn:A; [|reflexivity]. rewrite !andb_true_iff, !Z.eqb_eq in A. exfalso. destruct A as ((A1 & A2) & A3). congruence. }
    apply Z.eqb_eq in E2. rewrite E1, <- E2, !Z.eqb_refl, !andb_true_r. set (s := edge_sign o d b c) in *.
    assert (C : crossed o d a b c) by (split; [rewrite det_is; exact NZ|now split]). pose proof (crossed_is_met o d a b c C) as M.
    assert (ND : D <> 0).
    { intros E. apply Off. apply (touching_is_inside o d (a, b, c)). cbn [touches]. split; [exact M|]. rewrite top_is. fold D. rewrite E, Ropp_0. unfold Rdiv. apply Rmult_0_l. }
    rewrite (Fs ND). assert (Sn : sign n = s).
    { pose proof (sum_of_edges (moved o e) d a b c) as Sum. fold n in Sum. rewrite E1 in Ec. rewrite <- E2 in Eb. rewrite <- Sum.
      destruct (sign_cases (F d (moved o e) b c)) as [(X & Sx)|[(X & Sx)|(X & Sx)]], (sign_cases (F d (moved o e) c a)) as [(Y & Sy)|[(Y & Sy)|(Y & Sy)]],
        (sign_cases (F d (moved o e) a b)) as [(W & Sw)|[(W & Sw)|(W & Sw)]]; rewrite ?Sx, ?Sy, ?Sw in *; try congruence;
      destruct (sign_cases (F d (moved o e) a b + F d (moved o e) b c + F d (moved o e) c a)) as [(V & Sv)|[(V & Sv)|(V & Sv)]]; try congruence; exfalso; try lra; congruence. }
    replace (- D / - n) with (D / n) by (field; lra). assert (Nn : n <> 0) by lra. rewrite Sn.
    assert (K : Rle_bool 0 (D / n) = (sign D =? s)%Z).
    { rewrite <- Sn. replace D with (D / n * n) at 2 by (field; exact Nn). set (q := D / n). assert (q <> 0).
      { intros Q. apply ND. replace D with (q * n) by (unfold q; field; exact Nn). rewrite Q. ring. }
      rewrite sign_mul. assert (Z1 : (sign n <> 0)%Z) by (rewrite sign_0; exact Nn).
      destruct (sign_cases q) as [(X & ->)|[(X & ->)|(X & ->)]]; [rewrite Rle_bool_false by lra; symmetry; apply Z.eqb_neq; lia|contradiction|rewrite Rle_bool_true by lra; symmetry; apply Z.eqb_eq; lia]. }
    rewrite K. destruct (Z.eqb_spec (sign D) s) as [-> |]; reflexivity.
Qed.
