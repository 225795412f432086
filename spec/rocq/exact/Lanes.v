(** The filter of four triangles: [TriangleRay::survivors] of src/geom/lanes/triangles.rs, one lane, in single precision with gradual
    underflow and without a greatest exponent. LANES-3 is EXACT-5 with another floor; LANES-4 is here. *)
Require Import Reals ZArith Lia Lra Psatz.
From Flocq Require Import Core Relative Mult_error.
Require Import StacklessExact.Rounding StacklessExact.Triple StacklessExact.Filter StacklessExact.Floor.
Open Scope R_scope.

Local Instance prec_24 : Prec_gt_0 24 := eq_refl.

Notation fexp := (FLT_exp (-149) 24).
Notation R32 := (round radix2 fexp ZnearestE).
Notation F := (generic_format radix2 fexp).
Notation u := (/ 16777216).
Notation eta := (bpow radix2 (-150)).

(** [MIN_EDGE]: the least that an edge and a distance from the origin count. *)
Definition least : R := bpow radix2 (-40).

(** * The operations *)

Definition greatest (v : vec) : R := Rmax (Rmax (Rabs (vx v)) (Rabs (vy v))) (Rabs (vz v)).

(** [longest] of block.rs: E'. *)
Definition longest (v0 v1 v2 : vec) : R := Rmax (Rmax (greatest (vsub R32 v1 v0)) (greatest (vsub R32 v2 v0))) least.

(** C' of [with_constants], for scenes with coordinates of at most [reach]. *)
Definition way (o : vec) (reach : R) : R := Rmax (R32 (greatest o + reach)) least.

(** [EDGE], [DETERMINANT] and [DISTANCE]. *)
Notation edge_times := 39.
Notation det_times := 40.
Notation t_times := 44.

(** The two decisions of [survivors]: D, C' and E', and the best distance. The products of the constants and the unit are exact. *)
Definition delta_of (D C E : R) : R := R32 (R32 (R32 (edge_times * u * D) * E) * R32 (R32 (2 * C) + E)).
Definition is_missed (D C E : R) (x : determinants) : Prop :=
  let delta := delta_of D C E in
  Rmin (Rmin (edge_u x) (edge_v x)) (edge_w x) < - delta /\ delta < Rmax (Rmax (edge_u x) (edge_v x)) (edge_w x).

Definition det_off_of (D E : R) : R := R32 (R32 (det_times * u * D) * R32 (E * E)).
Definition t_off_of (C E : R) : R := R32 (R32 (t_times * u * C) * R32 (E * E)).
Definition is_beyond (neg : bool) (D C E best : R) (x : determinants) : Prop :=
  R32 (R32 (Rabs (det x) + det_off_of D E) * best) < R32 (front neg (top_t x) - t_off_of C E).

(** * What the sizes are *)

Lemma least_of_three a b c x : Rmin (Rmin a b) c < x -> a < x \/ b < x \/ c < x.
Proof. unfold Rmin. repeat destruct Rle_dec; auto. Qed.
Lemma greatest_of_three a b c x : x < Rmax (Rmax a b) c -> x < a \/ x < b \/ x < c.
Proof. unfold Rmax. repeat destruct Rle_dec; auto. Qed.

Lemma least_F : F least.
Proof. apply generic_format_bpow. unfold FLT_exp. lia. Qed.

Lemma greatest_b v B : greatest v <= B -> bounded B v.
Proof.
  unfold greatest. intros H. pose proof (Rmax_l (Rmax (Rabs (vx v)) (Rabs (vy v))) (Rabs (vz v))).
  pose proof (Rmax_r (Rmax (Rabs (vx v)) (Rabs (vy v))) (Rabs (vz v))). pose proof (Rmax_l (Rabs (vx v)) (Rabs (vy v))).
  pose proof (Rmax_r (Rabs (vx v)) (Rabs (vy v))). repeat split; lra.
Qed.

Lemma longest_bounds v0 v1 v2 : let E := longest v0 v1 v2 in
  bounded E (vsub R32 v1 v0) /\ bounded E (vsub R32 v2 v0) /\ least <= E.
Proof.
  intros E. pose proof (Rmax_l (Rmax (greatest (vsub R32 v1 v0)) (greatest (vsub R32 v2 v0))) least) as L.
  pose proof (Rmax_l (greatest (vsub R32 v1 v0)) (greatest (vsub R32 v2 v0))) as L1.
  pose proof (Rmax_r (greatest (vsub R32 v1 v0)) (greatest (vsub R32 v2 v0))) as L2.
  split; [|split]; [apply greatest_b|apply greatest_b|apply Rmax_r]; unfold E, longest; lra.
Qed.

(** As rounding keeps the order, no rounded component of s is greater than C'. [LANES-3] *)
Theorem way_is_enough o v reach : bounded reach v -> bounded (way o reach) (vsub R32 o v) /\ least <= way o reach /\ F (way o reach).
Proof.
  intros (B1 & B2 & B3). destruct (greatest_b o _ (Rle_refl _)) as (O1 & O2 & O3).
  assert (P : forall a b, Rabs a <= greatest o -> Rabs b <= reach -> Rabs (R32 (a - b)) <= way o reach).
  { intros a b A B. eapply Rle_trans; [|apply Rmax_l]. rewrite <- round_NE_abs by typeclasses eauto. apply round_le; [typeclasses eauto..|].
    now apply sub_b. }
  split; [repeat split; cbn [vx vy vz vsub]; now apply P|]. split; [apply Rmax_r|].
  unfold way, Rmax. destruct (Rle_dec _ _); [apply least_F|apply F_32].
Qed.

(** * Beyond a distance *)

Lemma nonneg x : 0 <= x -> 0 <= R32 x.
Proof. intros. rewrite <- (round_0 radix2 fexp ZnearestE). now apply round_le; try typeclasses eauto. Qed.

(** The comparison of [is_beyond] before its last roundings, by any bounds: det and T are off by at most [dd] and [dt], and the bounds are
    greater than that by [g] and [h], of which roundings and underflow take a part. *)
Lemma bounds_decide found truth dd dt g h det_off t_off neg best :
  Rabs (det found - det truth) <= dd -> Rabs (top_t found - top_t truth) <= dt -> dd + g <= det_off -> dt + h <= t_off ->
  bpow radix2 24 * eta <= g -> u * Rabs (det truth) <= g * (1 - 2 * u) -> u * Rabs (top_t truth) + (Rabs (det truth) * eta + g * eta) <= h ->
  sign_bit neg (det found) -> det truth <> 0 -> 0 <= top_t truth / det truth -> R32 (top_t truth / det truth) <= best ->
  front neg (top_t found) - t_off <= R32 (Rabs (det found) + det_off) * best.
Proof.
  intros OD OT BD BT Gn Gd Ht' Sg Nz Ht Hb. set (t := top_t truth / det truth) in *.
  assert (Et : top_t truth = t * det truth) by (unfold t; field; exact Nz).
  pose proof (bpow_gt_0 radix2 (-150)) as P_eta. pose proof (Rabs_pos (det truth)) as Pd. pose proof (Rabs_pos (det found)) as Pf.
  assert (Pg : 0 <= g) by (pose proof (bpow_gt_0 radix2 24); assert (0 <= bpow radix2 24 * eta) by (apply Rmult_le_pos; lra); lra).
  assert (Pdd : 0 <= dd) by (eapply Rle_trans; [apply Rabs_pos|exact OD]).
  assert (best_0 : 0 <= best) by (eapply Rle_trans; [|exact Hb]; now apply nonneg).
  assert (Pe : 0 <= Rabs (det truth) * eta) by (apply Rmult_le_pos; lra). assert (Pge : 0 <= g * eta) by (apply Rmult_le_pos; lra).
  assert (PT : 0 <= u * Rabs (top_t truth)) by (pose proof (Rabs_pos (top_t truth)); lra).
  set (a := front neg (det truth)). set (P := t * a).
  assert (Aa : Rabs a = Rabs (det truth)) by (unfold a, front, Triple.front; destruct neg; [apply Rabs_Ropp|reflexivity]).
  assert (AP : Rabs P = Rabs (top_t truth)) by (unfold P; rewrite Et, !Rabs_mult, Aa; reflexivity).
  assert (Tn : front neg (top_t found) <= P + dt).
  { unfold P, a, front, Triple.front. apply Rabs_le_inv in OT. rewrite Et in OT. destruct neg; lra. }
  assert (An : Rabs (det found) = front neg (det found)).
  { unfold front, Triple.front, sign_bit, Triple.sign_bit in *. destruct neg; [rewrite Rabs_left1|rewrite Rabs_pos_eq]; lra. }
  assert (Da : a - dd <= Rabs (det found)).
  { rewrite An. unfold a, front, Triple.front. apply Rabs_le_inv in OD. destruct neg; lra. }
  destruct (Rle_or_lt a 0) as [Ha|Ha].
  { (* The sign of det is wrong. *)
    apply Rle_trans with 0; [assert (P <= 0) by (unfold P; nra); lra|]. apply Rmult_le_pos; [apply nonneg; lra|exact best_0]. }
  assert (Pp : 0 <= P) by (apply Rmult_le_pos; lra). rewrite Rabs_pos_eq in AP by exact Pp. rewrite Rabs_pos_eq in Aa by lra. rewrite <- Aa in *. rewrite <- AP in *.
  assert (L1 : (a + g) * (1 - u) <= R32 (Rabs (det found) + det_off)).
  { assert (Low : a + g <= Rabs (det found) + det_off) by lra. eapply Rle_trans; [|exact (round_le radix2 fexp ZnearestE _ _ Low)]. apply low_normal.
    apply Rle_trans with g; [|lra]. eapply Rle_trans; [|exact Gn]. rewrite <- bpow_plus. now apply bpow_le. }
  assert (L2 : t * (1 - u) - eta <= best) by (pose proof (low_32 t Ht); lra).
  assert (L3 : (a + g) * (1 - u) * (t * (1 - u) - eta) <= R32 (Rabs (det found) + det_off) * best).
  { apply Rle_trans with ((a + g) * (1 - u) * best); [apply Rmult_le_compat_l; [apply Rmult_le_pos; lra|exact L2]|]. now apply Rmult_le_compat_r. }
  eapply Rle_trans; [|exact L3].
  replace ((a + g) * (1 - u) * (t * (1 - u) - eta)) with (P * ((1 - u) * (1 - u)) + g * t * ((1 - u) * (1 - u)) - (1 - u) * (a * eta + g * eta))
    by (unfold P; ring).
  assert (Gt : u * P <= g * t * (1 - 2 * u)).
  { replace (u * P) with (t * (u * a)) by (unfold P; ring). replace (g * t * (1 - 2 * u)) with (t * (g * (1 - 2 * u))) by ring. now apply Rmult_le_compat_l. }
  assert (0 <= g * t) by (now apply Rmult_le_pos). set (gt := g * t) in *. set (ae := a * eta) in *. set (ge := g * eta) in *. clearbody gt ae ge P.
  lra.
Qed.

(** * LANES-3 *)

Section Filters.
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

Variables D C E : R.
Hypothesis HD : bounded D d.
Hypothesis HC : bounded C s.
Hypothesis HE : bounded E e1 /\ bounded E e2.
Hypothesis D_range : bpow radix2 (-20) <= D <= bpow radix2 20.
Hypothesis C_least : least <= C.
Hypothesis E_least : least <= E.

Let Lp : 0 < least := bpow_gt_0 radix2 (-40).
Let PD : 0 < D := Rlt_le_trans _ _ _ (bpow_gt_0 radix2 (-20)) (proj1 D_range).
Let PC : 0 < C := Rlt_le_trans _ _ _ Lp C_least.
Let PE : 0 < E := Rlt_le_trans _ _ _ Lp E_least.
Let P_eta : 0 < eta := bpow_gt_0 radix2 (-150).

Lemma twice : F C -> R32 (2 * C) = 2 * C.
Proof.
  intros FC. apply round_generic; [typeclasses eauto|]. rewrite Rmult_comm. change 2 with (bpow radix2 1).
  apply mult_bpow_exact_FLT; [exact FC|]. assert (-40 < mag radix2 C)%Z.
  { apply mag_gt_bpow. rewrite Rabs_pos_eq by lra. exact C_least. }
  lia.
Qed.

Lemma square_least : bpow radix2 (-80) <= E * E.
Proof.
  change (-80)%Z with (-40 + -40)%Z. rewrite bpow_plus. apply Rmult_le_compat; try exact E_least; apply Rlt_le, Lp.
Qed.

(** What Floor.v asks of the sizes. *)
Lemma sizes_are_floored : E <= E /\ bpow radix2 (-60) <= E /\ bpow radix2 (-120) <= D * (E * E).
Proof.
  split; [apply Rle_refl|]. split; [eapply Rle_trans; [|exact E_least]; apply bpow_le; lia|].
  eapply Rle_trans; [|apply Rmult_le_compat; [apply bpow_ge_0|apply bpow_ge_0|apply D_range|apply square_least]].
  rewrite <- bpow_plus. apply bpow_le; lia.
Qed.

(** A triangle that the miss filter rejects is missed. [LANES-3] *)
Theorem missed_is_right : F C -> is_missed D C E found -> ~ meets truth.
Proof.
  intros FC (L & H). apply single_miss_is_right with (found := found) (D := D) (C := C) (E := E) (E' := E); try assumption;
    [apply D_range|apply sizes_are_floored|].
  unfold delta_of in L, H. rewrite (twice FC) in L, H. fold (delta D C E) in L, H. split; [now apply least_of_three|now apply greatest_of_three].
Qed.

(** * LANES-4 *)

Let S := D * (E * E).
Let y := C * (E * E).

Let PEE : 0 < E * E := Rmult_lt_0_compat _ _ PE PE.
Let PS : 0 < S := Rmult_lt_0_compat _ _ PD PEE.
Let Py : 0 < y := Rmult_lt_0_compat _ _ PC PEE.

(** The least values of the sizes, in units of half of the least number. *)
Lemma sizes : 10000000 * eta <= u * S /\ 60 * eta <= u * y /\ 1000000 * (eta * E) <= u * y /\ 1000000 * (eta * E) <= u * S /\
  1000 * (eta * S) <= u * y.
Proof.
  assert (R : 0 <= bpow radix2 (-20)) by apply bpow_ge_0.
  assert (A : 18014398509481984 * eta = bpow radix2 (-96)) by (change 18014398509481984 with (bpow radix2 54); rewrite <- bpow_plus; reflexivity).
  assert (Ll : 1073741824 * eta = least * least * least) by (change 1073741824 with (bpow radix2 30); unfold least; rewrite <- !bpow_plus; reflexivity).
  pose proof square_least as Q. destruct D_range as [D1 D2].
  assert (H1 : bpow radix2 (-100) <= S).
  { change (-100)%Z with (-20 + -80)%Z. rewrite bpow_plus. apply Rmult_le_compat; try assumption; apply bpow_ge_0. }
  assert (H2 : least * (least * E) <= y).
  { apply Rmult_le_compat; try lra; [apply Rmult_le_pos; lra|]. apply Rmult_le_compat_r; lra. }
  assert (H3 : bpow radix2 (-20) * (least * E) <= S).
  { apply Rmult_le_compat; try lra; [apply Rmult_le_pos; lra|]. apply Rmult_le_compat_r; lra. }
  assert (H4 : eta * S <= eta * bpow radix2 20 * (E * E)).
  { unfold S. rewrite Rmult_assoc. apply Rmult_le_compat_l; [lra|]. apply Rmult_le_compat_r; lra. }
  assert (H5 : least * (E * E) <= y) by (apply Rmult_le_compat_r; lra).
  assert (H6 : least * least * least <= least * (least * E)).
  { rewrite Rmult_assoc. apply Rmult_le_compat_l; [lra|]. apply Rmult_le_compat_l; lra. }
  assert (E1 : bpow radix2 (-100) = 1125899906842624 * eta) by (change 1125899906842624 with (bpow radix2 50); rewrite <- bpow_plus; reflexivity).
  assert (E2 : least * least = 1180591620717411303424 * eta).
  { change 1180591620717411303424 with (bpow radix2 70). unfold least. rewrite <- !bpow_plus. reflexivity. }
  assert (E3 : bpow radix2 (-20) * least = 1237940039285380274899124224 * eta).
  { change 1237940039285380274899124224 with (bpow radix2 90). unfold least. rewrite <- !bpow_plus. reflexivity. }
  assert (E4 : least = 1298074214633706907132624082305024 * eta).
  { change 1298074214633706907132624082305024 with (bpow radix2 110). unfold least. rewrite <- !bpow_plus. reflexivity. }
  assert (E5 : bpow radix2 20 = 1048576) by reflexivity.
  rewrite <- Rmult_assoc in H2, H3. rewrite E2 in H2. rewrite E3 in H3. rewrite E4 in H5. rewrite E5 in H4.
  assert (0 < eta * E) by (apply Rmult_lt_0_compat; lra). assert (0 < eta * (E * E)) by (apply Rmult_lt_0_compat; lra).
  set (eE := eta * E) in *. set (eEE := eta * (E * E)) in *.
  replace (1180591620717411303424 * eta * E) with (1180591620717411303424 * eE) in H2 by (unfold eE; ring).
  replace (1237940039285380274899124224 * eta * E) with (1237940039285380274899124224 * eE) in H3 by (unfold eE; ring).
  replace (1298074214633706907132624082305024 * eta * (E * E)) with (1298074214633706907132624082305024 * eEE) in H5 by (unfold eEE; ring).
  replace (eta * 1048576 * (E * E)) with (1048576 * eEE) in H4 by (unfold eEE; ring).
  rewrite <- Ll in H6. rewrite <- Rmult_assoc, E2 in H6. replace (1180591620717411303424 * eta * E) with (1180591620717411303424 * eE) in H6 by (unfold eE; ring).
  rewrite E1 in H1. repeat split; lra.
Qed.

(** The bounds as evaluated. That of T may underflow. *)
Lemma bound_low c X : 1 <= c <= 64 -> bpow radix2 (-40) <= X -> c * (1 - 4 * u) * (u * (X * (E * E))) - eta <= R32 (R32 (c * u * X) * R32 (E * E)).
Proof.
  intros Hc HX. pose proof square_least as Q.
  assert (L1 : c * u * X * (1 - u) <= R32 (c * u * X)).
  { apply low_normal. apply Rle_trans with (bpow radix2 (-24 + -40)); [now apply bpow_le|]. rewrite bpow_plus.
    change (bpow radix2 (-24)) with u. pose proof (bpow_ge_0 radix2 (-40)). apply Rmult_le_compat; lra. }
  assert (L2 : E * E * (1 - u) <= R32 (E * E)) by (apply low_normal; apply Rle_trans with (bpow radix2 (-80)); [now apply bpow_le|exact Q]).
  assert (PX : 0 < X) by (pose proof (bpow_gt_0 radix2 (-40)); lra).
  assert (PcX : 0 <= c * u * X * (1 - u)) by (repeat apply Rmult_le_pos; lra).
  assert (PEu : 0 <= E * E * (1 - u)) by (apply Rmult_le_pos; lra).
  assert (L3 : (c * u * X * (1 - u)) * (E * E * (1 - u)) <= R32 (c * u * X) * R32 (E * E)) by (apply Rmult_le_compat; assumption).
  eapply Rle_trans; [|apply low_32; eapply Rle_trans; [|exact L3]; apply Rmult_le_pos; assumption].
  set (Z := X * (E * E)). assert (PZ : 0 <= c * Z) by (apply Rmult_le_pos; [lra|]; apply Rmult_le_pos; lra).
  replace (c * u * X * (1 - u) * (E * E * (1 - u))) with (u * (1 - u) * (1 - u) * (c * Z)) in L3 by (unfold Z; ring).
  replace (c * (1 - 4 * u) * (u * Z)) with (u * (1 - 4 * u) * (c * Z)) by ring.
  set (p := R32 (c * u * X) * R32 (E * E)) in *. set (z := c * Z) in *. clearbody p z.
  assert (u * (1 - u) * (1 - u) * z * (1 - u) <= p * (1 - u)) by (apply Rmult_le_compat_r; lra). lra.
Qed.

(** What det and T are off by, underflow included. *)
Lemma det_is_off : Rabs (det found - det truth) <= 301 / 10 * (u * S).
Proof.
  destruct (parts v0 v1 v2 o d F0 F1 F2 Fo found Found D C E HD HC HE) as (rd & ad & _ & _ & _ & _ & (Q & K & A) & _).
  unfold truth. rewrite Q. replace (rd + ad - det (determinants_of exactly v0 v1 v2 o d)) with (rd - det (determinants_of exactly v0 v1 v2 o d) + ad) by ring.
  eapply Rle_trans; [apply add_b; eassumption|]. destruct sizes as (A1 & _ & _ & A2 & _). fold truth.
  replace (D * E * E) with S by (unfold S; ring). replace ((6 * E + 3) * (101 / 100 * eta)) with (606 / 100 * (eta * E) + 303 / 100 * eta) by field.
  set (eE := eta * E) in *. clearbody eE. lra.
Qed.

Lemma t_is_off : Rabs (top_t found - top_t truth) <= 342 / 10 * (u * y).
Proof.
  destruct HE as [B1 B2]. destruct Found as (_ & _ & _ & (_ & N) & _). destruct (N _ _ _ B2 HC B1) as (r & a & Q & K & A).
  pose proof (row_32 _ _ F1 F0) as R1. pose proof (row_32 _ _ F2 F0) as R2. pose proof (row_32 _ _ Fo F0) as R3.
  pose proof HC as (C1 & C2 & C3). pose proof B1 as (X1 & X2 & X3). pose proof B2 as (Y1 & Y2 & Y3).
  pose proof (rows_xyz u ltac:(lra) _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ Y1 Y2 Y3 C1 C2 C3 X1 X2 X3 R2 R3 R1) as W.
  pose proof (add_b _ _ _ _ K W) as T.
  rewrite Q.
  match type of T with Rabs ?e <= ?b => replace (r + a - top_t truth) with (e + a) by (unfold truth, exactly, det3; simpl; unfold dot; simpl; ring);
    replace b with ((34 * u + 62 * (u * u)) * y) in T by (unfold y; ring) end.
  eapply Rle_trans; [apply add_b; eassumption|]. destruct sizes as (_ & A1 & A2 & _ & _).
  replace ((6 * E + 3) * (101 / 100 * eta)) with (606 / 100 * (eta * E) + 303 / 100 * eta) by field.
  set (eE := eta * E) in *. clearbody eE. lra.
Qed.

(** Hadamard: det and T are at most 4 times the sizes. *)
Lemma det_is_small : Rabs (det truth) <= 401 / 100 * S.
Proof.
  pose proof HD as (D1 & D2 & D3). pose proof HE as ((A1 & A2 & A3) & (B1 & B2 & B3)).
  destruct (row_b u _ _ _ _ _ _ E (row_32 _ _ F1 F0) A1 A2 A3) as (T1 & T2 & T3).
  destruct (row_b u _ _ _ _ _ _ E (row_32 _ _ F2 F0) B1 B2 B3) as (R1 & R2 & R3).
  replace (det truth) with (det3 (vx v1 - vx v0) (vy v1 - vy v0) (vz v1 - vz v0) (vx d) (vy d) (vz d)
    (vx v2 - vx v0) (vy v2 - vy v0) (vz v2 - vz v0)) by (unfold truth, exactly, det3; simpl; unfold dot; simpl; ring).
  apply Rle_trans with (4 * (E * (1 + u) * D * (E * (1 + u)))); [apply det3_b; assumption|].
  replace (4 * (E * (1 + u) * D * (E * (1 + u)))) with (4 * ((1 + u) * (1 + u)) * S) by (unfold S; ring).
  apply Rmult_le_compat_r; lra.
Qed.

Lemma t_is_small : Rabs (top_t truth) <= 401 / 100 * y.
Proof.
  pose proof HC as (D1 & D2 & D3). pose proof HE as ((A1 & A2 & A3) & (B1 & B2 & B3)).
  destruct (row_b u _ _ _ _ _ _ E (row_32 _ _ F1 F0) A1 A2 A3) as (T1 & T2 & T3).
  destruct (row_b u _ _ _ _ _ _ E (row_32 _ _ F2 F0) B1 B2 B3) as (R1 & R2 & R3).
  destruct (row_b u _ _ _ _ _ _ C (row_32 _ _ Fo F0) D1 D2 D3) as (S1 & S2 & S3).
  replace (top_t truth) with (det3 (vx v2 - vx v0) (vy v2 - vy v0) (vz v2 - vz v0) (vx o - vx v0) (vy o - vy v0) (vz o - vz v0)
    (vx v1 - vx v0) (vy v1 - vy v0) (vz v1 - vz v0)) by (unfold truth, exactly, det3; simpl; unfold dot; simpl; ring).
  apply Rle_trans with (4 * (E * (1 + u) * (C * (1 + u)) * (E * (1 + u)))); [apply det3_b; assumption|].
  replace (4 * (E * (1 + u) * (C * (1 + u)) * (E * (1 + u)))) with (4 * ((1 + u) * (1 + u) * (1 + u)) * y) by (unfold y; ring).
  apply Rmult_le_compat_r; lra.
Qed.

(** The comparison before its last roundings: these keep the order, so they cost nothing. *)
Lemma not_beyond neg best : sign_bit neg (det found) -> det truth <> 0 -> 0 <= top_t truth / det truth ->
  R32 (top_t truth / det truth) <= best ->
  front neg (top_t found) - t_off_of C E <= R32 (Rabs (det found) + det_off_of D E) * best.
Proof.
  pose proof (bound_low t_times C ltac:(lra) C_least) as BT. fold (t_off_of C E) y in BT.
  assert (BD : det_times * (1 - 4 * u) * (u * S) - eta <= det_off_of D E).
  { apply bound_low; [lra|]. eapply Rle_trans; [|apply D_range]. now apply bpow_le. }
  destruct sizes as (Z1 & Z2 & _ & _ & Z3). pose proof det_is_small as SD. pose proof t_is_small as ST.
  assert (Small : Rabs (det truth) * eta <= 401 / 100 * (eta * S)).
  { replace (401 / 100 * (eta * S)) with (401 / 100 * S * eta) by ring. apply Rmult_le_compat_r; lra. }
  assert (0 <= eta * S) by (apply Rmult_le_pos; lra).
  apply bounds_decide with (dd := 301 / 10 * (u * S)) (dt := 342 / 10 * (u * y)) (g := (det_times - 302 / 10) * (u * S))
    (h := (t_times - 343 / 10) * (u * y)); [exact det_is_off|exact t_is_off|lra|lra|change (bpow radix2 24) with 16777216; lra|lra|].
  replace ((det_times - 302 / 10) * (u * S) * eta) with ((det_times - 302 / 10) * u * (eta * S)) by ring. lra.
Qed.

(** A triangle that the beyond filter rejects has no hit at RN(t) <= best. [LANES-4] *)
Theorem beyond_is_right neg best : sign_bit neg (det found) -> is_beyond neg D C E best found ->
  ~ (det truth <> 0 /\ 0 <= top_t truth / det truth /\ R32 (top_t truth / det truth) <= best).
Proof.
  intros Sg B (Nz & Ht & Hb). pose proof (not_beyond neg best Sg Nz Ht Hb) as H. apply (Rlt_not_le _ _ B).
  apply round_le; [typeclasses eauto..|exact H].
Qed.
End Filters.

(** As [TriangleRay] has it, for a usual ray: D is the greatest component of the direction, C' that for the scene, E' that of the block. A
    lane that is not among the survivors has no hit at RN(t) <= best. [LANES-3, LANES-4] *)
Theorem rejected_is_right v0 v1 v2 o d reach neg best : vformat v0 -> vformat v1 -> vformat v2 -> vformat o -> bounded reach v0 ->
  bpow radix2 (-20) <= greatest d <= bpow radix2 20 ->
  let found := determinants_of R32 v0 v1 v2 o d in
  let truth := determinants_of exactly v0 v1 v2 o d in
  let C := way o reach in
  let E := longest v0 v1 v2 in
  sign_bit neg (det found) -> is_missed (greatest d) C E found \/ is_beyond neg (greatest d) C E best found ->
  ~ (meets truth /\ 0 <= top_t truth / det truth /\ R32 (top_t truth / det truth) <= best).
Proof.
  intros F0 F1 F2 Fo HR HD found truth C E Sg Rj (M & Ht & Hb).
  destruct (longest_bounds v0 v1 v2) as (B1 & B2 & LE). fold E in B1, B2, LE.
  destruct (way_is_enough o v0 reach HR) as (BC & LC & FC). fold C in BC, LC, FC. pose proof (greatest_b d _ (Rle_refl _)) as BD.
  destruct Rj as [Rj|Rj].
  - revert M. eapply missed_is_right; eauto using evaluated_32.
  - apply (beyond_is_right v0 v1 v2 o d F0 F1 F2 Fo found (evaluated_32 _ _ _ _ _) _ C E BD BC (conj B1 B2) HD LC LE neg best Sg Rj). split; [apply M|]. now split.
Qed.
