(** [Determinants::are_exact] and [has_exact_det] of src/geom/kernel/exact/filter.rs, and [is_flat_at_sight] of predicates.rs beside it, on
    IEEE 754 doubles: on a coarse grid nothing in EXACT-1 is rounded, and the signs decide. *)
Require Import Reals ZArith Lia Lra Psatz Bool List.
From Flocq Require Import Core BinarySingleNaN.
Require Import StacklessExact.Rounding StacklessExact.Triple StacklessExact.Filter StacklessExact.Quotient StacklessExact.Range
  StacklessExact.Overflow StacklessExact.Division StacklessExact.Certain StacklessExact.Scene StacklessExact.LastDigit.
Open Scope R_scope.

Local Instance prec_53 : Prec_gt_0 53 := eq_refl.

(** * The code *)

Section Code.
Open Scope Z_scope.

Definition are_exact (v0 v1 v2 o d : fvec) : bool :=
  match unit (v0 :: v1 :: v2 :: o :: nil), unit (d :: nil) with
  | Some unit, Some unit_of_d =>
    let direction := Z.max (exponent (scene_d d) + 1 - unit_of_d) 0 in
    let off := Z.max (exponent (triangle_c v0 o) + 1 - unit) 0 in
    let edges := Z.max (exponent (triangle_e v0 v1 v2) + 1 - unit) 0 in
    (direction + edges + Z.max edges off + 5 <=? 53) && (2 * edges + off + 3 <=? 53)
  | _, _ => false
  end.

Definition has_exact_det (v0 v1 v2 d : fvec) : bool :=
  match unit (v0 :: v1 :: v2 :: nil), unit (d :: nil) with
  | Some unit, Some unit_of_d =>
    Z.max (exponent (scene_d d) + 1 - unit_of_d) 0 + 2 * Z.max (exponent (triangle_e v0 v1 v2) + 1 - unit) 0 + 3 <=? 53
  | _, _ => false
  end.

Definition is_flat_at_sight (v0 v1 v2 d : fvec) : bool :=
  let axis d a b c := Beqb d zero && Beqb a b && Beqb a c in
  veq v0 v1 || veq v0 v2 || veq v1 v2 ||
    (axis (fx d) (fx v0) (fx v1) (fx v2) || axis (fy d) (fy v0) (fy v1) (fy v2) || axis (fz d) (fz v0) (fz v1) (fz v2)).
End Code.

Section Exact.
Variables g h : Z.
Hypothesis Hg : (-149 <= g)%Z.
Hypothesis Hh : (-149 <= h)%Z.

(** A difference of such numbers is exact. [EXACT-11](1, 2) *)
Theorem vsub_exact b v w : von g b v -> von g b w -> (b + b <= 2 ^ 53)%Z -> vsub R64 v w = vsub exactly v w.
Proof.
  intros (V1 & V2 & V3) (W1 & W2 & W3) B. unfold vsub, exactly. f_equal; apply (on_round g (b + b)); try lia; now apply on_minus.
Qed.

Lemma two_exact j k a b x y x' y' : (-1074 <= j + k)%Z -> (2 * (a * b) <= 2 ^ 53)%Z -> (0 <= a * b)%Z -> on j a x -> on k b y -> on j a x' -> on k b y' ->
  R64 (R64 (x * y) - R64 (x' * y')) = x * y - x' * y' /\ on (j + k) (2 * (a * b)) (x * y - x' * y').
Proof.
  intros J B P X Y X' Y'. pose proof (on_mult _ _ _ _ _ _ X Y) as M. pose proof (on_mult _ _ _ _ _ _ X' Y') as M'.
  rewrite (on_round _ _ _ M), (on_round _ _ _ M') by lia. pose proof (on_minus _ _ _ _ _ M M') as D.
  replace (a * b + a * b)%Z with (2 * (a * b))%Z in D by lia. split; [apply (on_round _ _ _ D); lia|exact D].
Qed.

Lemma cross_exact j k a b v w : (-1074 <= j + k)%Z -> (2 * (a * b) <= 2 ^ 53)%Z -> (0 <= a * b)%Z -> von j a v -> von k b w ->
  cross R64 v w = cross exactly v w /\ von (j + k) (2 * (a * b)) (cross exactly v w).
Proof.
  intros J B P (V1 & V2 & V3) (W1 & W2 & W3). unfold cross, von, exactly. cbn [vx vy vz].
  rewrite (Rmult_comm (vy w) (vz v)), (Rmult_comm (vz w) (vx v)), (Rmult_comm (vx w) (vy v)).
  destruct (two_exact j k a b (vy v) (vz w) (vz v) (vy w)) as [-> M1]; try assumption.
  destruct (two_exact j k a b (vz v) (vx w) (vx v) (vz w)) as [-> M2]; try assumption.
  destruct (two_exact j k a b (vx v) (vy w) (vy v) (vx w)) as [-> M3]; try assumption. auto.
Qed.

Lemma dot_exact j k a b v w : (-1074 <= j + k)%Z -> (3 * (a * b) <= 2 ^ 53)%Z -> (0 <= a * b)%Z -> von j a v -> von k b w ->
  dot R64 v w = dot exactly v w /\ on (j + k) (3 * (a * b)) (dot exactly v w).
Proof.
  intros J B P (V1 & V2 & V3) (W1 & W2 & W3). unfold dot, exactly.
  pose proof (on_mult _ _ _ _ _ _ V1 W1) as M1. pose proof (on_mult _ _ _ _ _ _ V2 W2) as M2. pose proof (on_mult _ _ _ _ _ _ V3 W3) as M3.
  rewrite (on_round _ _ _ M1), (on_round _ _ _ M2), (on_round _ _ _ M3) by lia.
  pose proof (on_plus _ _ _ _ _ M1 M2) as S. rewrite (on_round _ _ _ S) by lia.
  pose proof (on_plus _ _ _ _ _ S M3) as T. replace (a * b + a * b + a * b)%Z with (3 * (a * b))%Z in T by lia.
  split; [apply (on_round _ _ _ T); lia|exact T].
Qed.

Variables v0 v1 v2 o d : vec.
Variables direction edges off : Z.
Hypothesis Pd : (0 <= direction)%Z.
Hypothesis Pe : (0 <= edges)%Z.
Hypothesis Ps : (0 <= off)%Z.
Hypothesis H0 : von g (2 ^ 51) v0.
Hypothesis H1 : von g (2 ^ 51) v1.
Hypothesis H2 : von g (2 ^ 51) v2.
Hypothesis Hd : von h (2 ^ direction) d.
Hypothesis E1 : von g (2 ^ edges) (vsub exactly v1 v0).
Hypothesis E2 : von g (2 ^ edges) (vsub exactly v2 v0).

Lemma pow_below a b : (0 <= a)%Z -> (a + b <= 53)%Z -> (2 ^ a <= 2 ^ (53 - b))%Z.
Proof. intros A B. apply Z.pow_le_mono_r; lia. Qed.

Lemma det_exact : (direction + 2 * edges + 3 <= 53)%Z ->
  let e1 := vsub R64 v1 v0 in let e2 := vsub R64 v2 v0 in
  dot R64 e1 (cross R64 d e2) = det (determinants_of exactly v0 v1 v2 o d).
Proof.
  intros B. cbv zeta. rewrite !(vsub_exact (2 ^ 51)) by (assumption || lia).
  set (D := (2 ^ direction)%Z) in *. set (E := (2 ^ edges)%Z) in *.
  assert (PD : (0 < D)%Z) by (apply Z.pow_pos_nonneg; lia). assert (PE : (0 < E)%Z) by (apply Z.pow_pos_nonneg; lia).
  assert (A : (D * E * E <= 2 ^ 50)%Z).
  { unfold D, E. rewrite <- !Z.pow_add_r by lia. apply Z.pow_le_mono_r; lia. }
  destruct (cross_exact h g D E d _ ltac:(lia) ltac:(nia) ltac:(nia) Hd E2) as [-> C].
  destruct (dot_exact g (h + g) E (2 * (D * E)) _ _ ltac:(lia) ltac:(nia) ltac:(nia) E1 C) as [-> _]. reflexivity.
Qed.

Hypothesis Ho : von g (2 ^ 51) o.
Hypothesis Hs : von g (2 ^ off) (vsub exactly o v0).

(** If 5 and 3 digits are left for the sums, nothing is rounded. [EXACT-11](3, 4) *)
Theorem nothing_is_rounded : (direction + edges + Z.max edges off + 5 <= 53)%Z -> (2 * edges + off + 3 <= 53)%Z ->
  determinants_of R64 v0 v1 v2 o d = determinants_of exactly v0 v1 v2 o d.
Proof.
  intros B T. unfold determinants_of. rewrite !(vsub_exact (2 ^ 51)) by (assumption || lia). cbv zeta.
  set (D := (2 ^ direction)%Z) in *. set (E := (2 ^ edges)%Z) in *. set (S := (2 ^ off)%Z) in *.
  assert (PD : (0 < D)%Z) by (apply Z.pow_pos_nonneg; lia). assert (PE : (0 < E)%Z) by (apply Z.pow_pos_nonneg; lia).
  assert (PS : (0 < S)%Z) by (apply Z.pow_pos_nonneg; lia).
  assert (A : (D * E * E <= 2 ^ 48 /\ D * E * S <= 2 ^ 48 /\ E * E * S <= 2 ^ 50)%Z).
  { unfold D, E, S. rewrite <- !Z.pow_add_r by lia. repeat split; apply Z.pow_le_mono_r; lia. }
  destruct A as (A1 & A2 & A3).
  destruct (cross_exact h g D E d _ ltac:(lia) ltac:(nia) ltac:(nia) Hd E2) as [-> P].
  destruct (cross_exact g g S E _ _ ltac:(lia) ltac:(nia) ltac:(nia) Hs E1) as [-> Q].
  destruct (dot_exact g (h + g) E (2 * (D * E)) _ _ ltac:(lia) ltac:(nia) ltac:(nia) E1 P) as [-> Mdet].
  destruct (dot_exact g (h + g) S (2 * (D * E)) _ _ ltac:(lia) ltac:(nia) ltac:(nia) Hs P) as [-> Mu].
  destruct (dot_exact h (g + g) D (2 * (S * E)) _ _ ltac:(lia) ltac:(nia) ltac:(nia) Hd Q) as [-> Mv].
  destruct (dot_exact g (g + g) E (2 * (S * E)) _ _ ltac:(lia) ltac:(nia) ltac:(nia) E2 Q) as [-> _].
  replace (h + (g + g))%Z with (g + (h + g))%Z in Mv by lia.
  pose proof (on_minus _ _ _ _ _ Mdet Mu) as M1. pose proof (on_minus _ _ _ _ _ M1 Mv) as M2.
  rewrite (on_round _ _ _ M1), (on_round _ _ _ M2) by nia. reflexivity.
Qed.
End Exact.

(** * Coarse grids *)

Definition values_are (c : code) (x : determinants) : Prop :=
  (is_finite (f_det c) = true /\ B2R (f_det c) = det x) /\ (is_finite (f_u c) = true /\ B2R (f_u c) = edge_u x) /\
  (is_finite (f_v c) = true /\ B2R (f_v c) = edge_v x) /\ (is_finite (f_w c) = true /\ B2R (f_w c) = edge_w x) /\
  (is_finite (f_t c) = true /\ B2R (f_t c) = top_t x).

(** What the exponent of a greatest component says of all. *)
Lemma below_exponent x r : plain x -> bounded (B2R x) r -> forall n, exponent x = n ->
  Rabs (vx r) < bpow radix2 (n - 1022) /\ Rabs (vy r) < bpow radix2 (n - 1022) /\ Rabs (vz r) < bpow radix2 (n - 1022).
Proof. intros (F & S & _) (B1 & B2 & B3) n <-. destruct (exponent_is x F S) as (_ & L & _). repeat split; lra. Qed.

Lemma counted_vector k n r : vmultiple k r -> vmultiple (-149) r ->
  Rabs (vx r) < bpow radix2 (n + k) /\ Rabs (vy r) < bpow radix2 (n + k) /\ Rabs (vz r) < bpow radix2 (n + k) ->
  von (Z.max k (-149)) (2 ^ Z.max n 0) r.
Proof. intros (K1 & K2 & K3) (S1 & S2 & S3) (B1 & B2 & B3). repeat split; now apply counted. Qed.

Lemma vminus_multiple k v w : vmultiple k v -> vmultiple k w -> vmultiple k (vsub exactly v w).
Proof. intros (V1 & V2 & V3) (W1 & W2 & W3). repeat split; now apply multiple_minus. Qed.

Lemma scene_d_is d : v_single d -> plain (scene_d d) /\ bounded (B2R (scene_d d)) (real d).
Proof.
  intros (X & Y & Z). assert (P : vplain (vabs d)) by (split; [|split]; now apply single_plain).
  destruct (max_element_plain _ P) as (Q & L1 & L2 & L3). split; [exact Q|]. cbn [vabs fx fy fz] in *. rewrite !B2R_Babs in *. now repeat split.
Qed.

Lemma difference_is v w : v_single v -> v_single w ->
  let x := max_element (vabs (fsub v w)) in plain x /\ bounded (B2R x) (vsub R64 (real v) (real w)).
Proof.
  intros V W x. pose proof (sub_fits 128 _ _ _ _ ltac:(lia) (v_fits _ V) (v_fits _ W)) as ((F1 & V1 & _) & (F2 & V2 & _) & (F3 & V3 & _)).
  pose proof (difference_most _ _ V W) as (B1 & B2 & B3).
  assert (T : widest < bpow radix2 129) by (unfold widest; pose proof (bpow_gt_0 radix2 129); lra).
  assert (P : vplain (vabs (fsub v w))).
  { split; [|split]; apply abs_plain; try assumption; [rewrite V1|rewrite V2|rewrite V3]; lra. }
  destruct (max_element_plain _ P) as (Q & L1 & L2 & L3). fold x in Q, L1, L2, L3. split; [exact Q|].
  cbn [vabs fx fy fz] in L1, L2, L3. rewrite B2R_Babs in L1, L2, L3.
  split; [rewrite <- V1; exact L1|split; [rewrite <- V2; exact L2|rewrite <- V3; exact L3]].
Qed.

Lemma counted_difference v w k x : v_single v -> v_single w -> vmultiple (k - 1023) (real v) -> vmultiple (k - 1023) (real w) ->
  von (Z.max (k - 1023) (-149)) (2 ^ 51) (real v) -> von (Z.max (k - 1023) (-149)) (2 ^ 51) (real w) ->
  plain x -> bounded (B2R x) (vsub R64 (real v) (real w)) ->
  von (Z.max (k - 1023) (-149)) (2 ^ Z.max (exponent x + 1 - k) 0) (vsub exactly (real v) (real w)).
Proof.
  intros Sv Sw Mv Mw Ov Ow Px Bx. rewrite (vsub_exact (Z.max (k - 1023) (-149)) ltac:(lia) (2 ^ 51)) in Bx by (assumption || lia).
  apply counted_vector; [now apply vminus_multiple|apply vminus_multiple; now apply v_multiple|].
  replace (exponent x + 1 - k + (k - 1023))%Z with (exponent x - 1022)%Z by lia. exact (below_exponent x _ Px Bx _ eq_refl).
Qed.

Lemma counted_direction d k : v_single d -> vmultiple (k - 1023) (real d) ->
  von (Z.max (k - 1023) (-149)) (2 ^ Z.max (exponent (scene_d d) + 1 - k) 0) (real d).
Proof.
  intros S M. destruct (scene_d_is d S) as [P B]. apply counted_vector; [exact M|now apply v_multiple|].
  replace (exponent (scene_d d) + 1 - k + (k - 1023))%Z with (exponent (scene_d d) - 1022)%Z by lia. exact (below_exponent _ _ P B _ eq_refl).
Qed.

Ltac listed := repeat (apply Forall_cons; [assumption|]); apply Forall_nil.

Section Single.
Variables v0 v1 v2 o d : fvec.
Hypothesis H0 : v_single v0.
Hypothesis H1 : v_single v1.
Hypothesis H2 : v_single v2.
Hypothesis Hd : v_single d.
Let truth := determinants_of exactly (real v0) (real v1) (real v2) (real o) (real d).

Lemma edges_are_plain : let x := triangle_e v0 v1 v2 in
  plain x /\ bounded (B2R x) (vsub R64 (real v1) (real v0)) /\ bounded (B2R x) (vsub R64 (real v2) (real v0)).
Proof.
  intros x. destruct (difference_is _ _ H1 H0) as [P1 B1]. destruct (difference_is _ _ H2 H0) as [P2 B2].
  destruct (fmax_plain _ _ P1 P2) as (P & L1 & L2). split; [exact P|].
  split; (eapply bounded_more; [eassumption|assumption]).
Qed.

(** A determinant that [has_exact_det] admits is the true one, for any origin, and needs no more than corners and direction. [EXACT-11] *)
Theorem has_exact_det_is_right : has_exact_det v0 v1 v2 d = true -> B2R (fdot (fsub v1 v0) (fcross d (fsub v2 v0))) = det truth.
Proof.
  unfold has_exact_det. destruct (unit (v0 :: v1 :: v2 :: nil)) as [k|] eqn:U; [|discriminate].
  destruct (unit (d :: nil)) as [l|] eqn:Ud; [|discriminate]. intros C. apply Z.leb_le in C.
  apply unit_divides in U; [|listed]. apply unit_divides in Ud; [|listed].
  rewrite Forall_forall in U, Ud. destruct (U v0) as [M0 O0]; [simpl; tauto|]. destruct (U v1) as [M1 O1]; [simpl; tauto|].
  destruct (U v2) as [M2 O2]; [simpl; tauto|]. destruct (Ud d) as [Md _]; [simpl; tauto|].
  destruct edges_are_plain as (P & B1 & B2).
  pose proof (counted_difference _ _ _ _ H1 H0 M1 M0 O1 O0 P B1) as E1. pose proof (counted_difference _ _ _ _ H2 H0 M2 M0 O2 O0 P B2) as E2.
  pose proof (counted_direction d l Hd Md) as D.
  assert (V : fits 388 (fdot (fsub v1 v0) (fcross d (fsub v2 v0)))
    (dot R64 (vsub R64 (real v1) (real v0)) (cross R64 (real d) (vsub R64 (real v2) (real v0))))).
  { exact (proj1 (determinants_do_not_overflow v0 v1 v2 v0 d H0 H1 H2 H0 Hd)). }
  destruct V as (_ & -> & _). unfold truth.
  pose proof (det_exact (Z.max (k - 1023) (-149)) (Z.max (l - 1023) (-149)) ltac:(lia) ltac:(lia) (real v0) (real v1) (real v2) (real o) (real d)
    _ _ (Z.le_max_r _ _) (Z.le_max_r _ _) O0 O1 O2 D E1 E2 C) as E. exact E.
Qed.

Hypothesis Ho : v_single o.
Let c := code_of v0 v1 v2 o d.

(** What [are_exact] admits is not rounded: the five results are those of EXACT-1. [EXACT-11](1, 3, 4) *)
Theorem are_exact_is_right : are_exact v0 v1 v2 o d = true -> values_are c truth.
Proof.
  unfold are_exact. destruct (unit (v0 :: v1 :: v2 :: o :: nil)) as [k|] eqn:U; [|discriminate].
  destruct (unit (d :: nil)) as [l|] eqn:Ud; [|discriminate]. intros C. apply andb_prop in C. destruct C as [C1 C2]. apply Z.leb_le in C1, C2.
  apply unit_divides in U; [|listed]. apply unit_divides in Ud; [|listed].
  rewrite Forall_forall in U, Ud. destruct (U v0) as [M0 O0]; [simpl; tauto|]. destruct (U v1) as [M1 O1]; [simpl; tauto|].
  destruct (U v2) as [M2 O2]; [simpl; tauto|]. destruct (U o) as [Mo Oo]; [simpl; tauto|]. destruct (Ud d) as [Md _]; [simpl; tauto|].
  destruct edges_are_plain as (P & B1 & B2). destruct (difference_is _ _ Ho H0) as [Ps Bs].
  pose proof (counted_difference _ _ _ _ H1 H0 M1 M0 O1 O0 P B1) as E1. pose proof (counted_difference _ _ _ _ H2 H0 M2 M0 O2 O0 P B2) as E2.
  pose proof (counted_difference _ _ _ _ Ho H0 Mo M0 Oo O0 Ps Bs) as S. pose proof (counted_direction d l Hd Md) as D.
  pose proof (determinants_do_not_overflow v0 v1 v2 o d H0 H1 H2 Ho Hd) as ((F1 & V1 & _) & (F2 & V2 & _) & (F3 & V3 & _) & (F4 & V4 & _) & (F5 & V5 & _)).
  rewrite (nothing_is_rounded (Z.max (k - 1023) (-149)) (Z.max (l - 1023) (-149)) ltac:(lia) ltac:(lia) (real v0) (real v1) (real v2) (real o) (real d)
    _ _ _ (Z.le_max_r _ _) (Z.le_max_r _ _) (Z.le_max_r _ _) O0 O1 O2 D E1 E2 Oo S C1 C2) in V1, V2, V3, V4, V5.
  repeat split; assumption.
Qed.
End Single.

(** * The decision *)

Lemma ratio_sign neg det x : sign_bit neg det -> det <> 0 -> (0 <= front neg x <-> 0 <= x / det).
Proof.
  intros S N. unfold sign_bit, Triple.sign_bit, front, Triple.front in *. destruct neg.
  - assert (det < 0) by lra. assert (I : / det < 0) by now apply Rinv_lt_0_compat. unfold Rdiv. split; intros; nra.
  - assert (0 < det) by lra. assert (I : 0 < / det) by now apply Rinv_0_lt_compat. unfold Rdiv. split; intros; nra.
Qed.

(** [over_determinant] without errors: its ends are finite, and those of Quotient.v. *)
Lemma quotient_without_errors N DET n dt : is_number N n -> is_number DET dt -> within (-447) 390 n ->
  bpow radix2 (-447) <= Rabs dt <= bpow radix2 388 ->
  is_number (fst (code_over N zero DET zero)) (fst (over_determinant RX u n 0 dt 0)) /\
  is_number (snd (code_over N zero DET zero)) (snd (over_determinant RX u n 0 dt 0)).
Proof.
  intros In Idt Wn Wdt. unfold code_over, over_determinant. cbv zeta. cbn [fst snd].
  assert (Pd : 0 < Rabs dt) by (eapply Rlt_le_trans; [apply bpow_gt_0|apply Wdt]).
  assert (Nd : dt <> 0) by (intros Z; rewrite Z, Rabs_R0 in Pd; lra).
  assert (I0 : is_number zero 0) by now split.
  assert (I1 : is_number (constant 1 0) 1).
  { destruct (constant_fits 1 0) as [F V]; [reflexivity|lia|]. split; [exact F|]. rewrite V. simpl. ring. }
  assert (I4 : is_number (constant 4 (-53)) (4 * u)).
  { destruct (constant_fits 4 (-53)) as [F V]; [reflexivity|lia|]. now split. }
  assert (W1 : within (-388) 447 (1 / dt)).
  { right. unfold Rdiv. rewrite Rmult_1_l, Rabs_inv. change (-388)%Z with (- (388))%Z. change 447%Z with (- (-447))%Z. rewrite !(bpow_opp _ _).
    split; apply Rinv_le; try apply Wdt; [exact Pd|apply bpow_gt_0]. }
  destruct (over_is (-388) 447 _ _ _ _ ltac:(lia) ltac:(lia) I1 Idt Nd W1) as [Ir Wr]. set (r := RX (1 / dt)) in *.
  pose proof (within_mult _ _ _ _ _ _ Wn Wr) as W2. simpl Z.add in W2.
  destruct (times_is (-835) 837 _ _ _ _ ltac:(lia) ltac:(lia) In Ir W2) as [Ix Wx]. set (x := RX (n * r)) in *.
  assert (Z : forall y, within (-835) 837 (y * 0)) by (intros; left; ring).
  destruct (times_is (-835) 837 _ _ _ _ ltac:(lia) ltac:(lia) (abs_is _ _ Ix) I0 (Z _)) as [I5 W5].
  assert (E5 : RX (Rabs x * 0) = 0) by (rewrite Rmult_0_r; apply round_0; typeclasses eauto). rewrite E5 in *.
  pose proof (plus_is 0 _ _ _ _ ltac:(lia) I0 I5 ltac:(rewrite Rabs_R0; apply bpow_ge_0) ltac:(rewrite Rabs_R0; apply bpow_ge_0)) as I6.
  assert (E6 : RX (0 + 0) = 0) by (rewrite Rplus_0_r; apply round_0; typeclasses eauto). rewrite E6 in *.
  destruct (times_is (-835) 837 _ _ _ _ ltac:(lia) ltac:(lia) I6 (abs_is _ _ Ir) ltac:(left; ring)) as [I7 _].
  assert (E7 : RX (0 * Rabs r) = 0) by (rewrite Rmult_0_l; apply round_0; typeclasses eauto). rewrite E7 in *.
  assert (W4 : within (-51) (-51) (4 * u)).
  { right. assert (4 * u = bpow radix2 (-51)) as ->; [|rewrite Rabs_pos_eq by apply bpow_ge_0; lra].
    change 4 with (bpow radix2 2). rewrite <- bpow_plus. reflexivity. }
  pose proof (within_mult _ _ _ _ _ _ (within_abs _ _ _ Wx) W4) as W8. simpl Z.add in W8.
  destruct (times_is (-886) 786 _ _ _ _ ltac:(lia) ltac:(lia) (abs_is _ _ Ix) I4 W8) as [I8 W8']. set (g := RX (Rabs x * (4 * u))) in *.
  pose proof (plus_is 786 _ _ _ _ ltac:(lia) I7 I8 ltac:(rewrite Rabs_R0; apply bpow_ge_0) (within_most _ _ _ W8')) as I9.
  assert (W9 : within (-886) 786 (RX (0 + g))) by (rewrite Rplus_0_l; now apply within_RX).
  pose proof (within_most _ _ _ (within_more _ _ (-886) 837 _ W9 ltac:(lia) ltac:(lia))) as Me. pose proof (within_most _ _ _ Wx) as Mx.
  split; [apply (minus_is 837)|apply (plus_is 837)]; assumption || lia.
Qed.

Section Decision.
Variables v0 v1 v2 o d : fvec.
Hypothesis H0 : v_single v0.
Hypothesis H1 : v_single v1.
Hypothesis H2 : v_single v2.
Hypothesis Ho : v_single o.
Hypothesis Hd : v_single d.
Let c := code_of v0 v1 v2 o d.
Let truth := determinants_of exactly (real v0) (real v1) (real v2) (real o) (real d).
Hypothesis coarse : are_exact v0 v1 v2 o d = true.

(** [is_miss] with bounds of 0, or [are_parallel]. *)
Definition is_missed : bool := code_is_miss zero c || Beqb (f_det c) zero.

Lemma not_less x r : is_finite x = true -> B2R x = r -> Bleb (Bopp zero) (code_front c x) = Rle_bool 0 (front (Bsign (f_det c)) r).
Proof.
  intros F <-. rewrite Bleb_correct; [|reflexivity|unfold code_front; destruct (Bsign (f_det c)); [now rewrite is_finite_Bopp|exact F]].
  unfold code_front, front, Triple.front. simpl (B2R (Bopp zero)). destruct (Bsign (f_det c)); [now rewrite B2R_Bopp|reflexivity].
Qed.

(** Whether the line meets the triangle is as computed, and the distance lies between the ends of a quotient without errors. [EXACT-11](4, 5) *)
Theorem coarse_is_decided : (is_missed = true <-> ~ meets truth) /\
  (is_missed = false -> let '(low, high) := code_distance zero zero c in
    is_finite low = true /\ is_finite high = true /\ B2R low <= top_t truth / det truth <= B2R high).
Proof.
  destruct (are_exact_is_right v0 v1 v2 o d H0 H1 H2 Hd Ho coarse) as ((Fd & Vd) & (Fu & Vu) & (Fv & Vv) & (Fw & Vw) & (Ft & Vt)).
  fold c truth in Fd, Vd, Fu, Vu, Fv, Vv, Fw, Vw, Ft, Vt.
  assert (S : sign_bit (Bsign (f_det c)) (det truth)) by (rewrite <- Vd; apply sign_bit_is).
  assert (Par : Beqb (f_det c) zero = Req_bool (det truth) 0) by (rewrite Beqb_correct by (exact Fd || reflexivity); now rewrite Vd).
  assert (Miss : is_missed = false -> det truth <> 0 /\ meets truth).
  { unfold is_missed, code_is_miss. rewrite (not_less _ _ Fu Vu), (not_less _ _ Fv Vv), (not_less _ _ Fw Vw), Par.
    rewrite orb_false_iff, negb_false_iff, !andb_true_iff. intros (((A & B) & C) & N).
    destruct (Req_bool_spec (det truth) 0) as [|N0]; [discriminate|]. split; [exact N0|]. split; [exact N0|].
    repeat split; apply (ratio_sign _ _ _ S N0);
      match goal with H : Rle_bool 0 ?x = true |- 0 <= ?x => revert H; destruct (Rle_bool_spec 0 x); [auto|discriminate] end. }
  split; [split|].
  - unfold is_missed, code_is_miss. rewrite (not_less _ _ Fu Vu), (not_less _ _ Fv Vv), (not_less _ _ Fw Vw), Par.
    intros M (N0 & HU & HV & HW). apply (ratio_sign _ _ _ S N0) in HU, HV, HW.
    rewrite !Rle_bool_true in M by assumption. rewrite Req_bool_false in M by exact N0. discriminate.
  - intros N. destruct is_missed; [reflexivity|]. now destruct N, (Miss eq_refl).
  - intros M. destruct (Miss M) as [N0 _]. clear Miss.
    pose proof (determinants_do_not_overflow v0 v1 v2 o d H0 H1 H2 Ho Hd) as ((_ & Rd & Bd) & _ & _ & _ & (_ & Rt & Bt)).
    fold c in Rd, Rt. rewrite <- Rd, Vd in Bd. rewrite <- Rt, Vt in Bt.
    destruct (determinants_are_multiples _ _ _ _ _ (v_multiple _ H0) (v_multiple _ H1) (v_multiple _ H2) (v_multiple _ Ho) (v_multiple _ Hd)) as (Md & _ & _ & Mt).
    rewrite <- (determinants_do_not_underflow (-149) ltac:(lia)) in Md, Mt by now apply v_multiple. rewrite <- Rd, Vd in Md. rewrite <- Rt, Vt in Mt.
    assert (Wd : bpow radix2 (-447) <= Rabs (det truth) <= bpow radix2 388) by (split; [destruct (multiple_big _ _ Md) as [Z|B]; [contradiction|exact B]|exact Bd]).
    assert (Wt : within (-447) 390 (top_t truth)) by (apply (multiple_within (-447)); [lia|exact Mt|exact Bt]).
    destruct (quotient_without_errors (f_t c) (f_det c) _ _ (conj Ft Vt) (conj Fd Vd) Wt Wd) as [[F1 V1] [F2 V2]].
    pose proof (enclosure 53 ltac:(lia) (det truth) (det truth) (top_t truth) (top_t truth) 0 0 0 0 N0 ltac:(lra)
      ltac:(pose proof (Rabs_pos (det truth)); lra) ltac:(rewrite Rminus_diag_eq, Rabs_R0 by reflexivity; lra) ltac:(rewrite Rminus_diag_eq, Rabs_R0 by reflexivity; lra) ltac:(lra) ltac:(lra)) as Q.
    unfold code_distance. destruct (code_over _ _ _ _) as [low high], (over_determinant _ _ _ _ _ _) as [low' high'].
    cbn [fst snd] in F1, V1, F2, V2. split; [exact F1|split; [exact F2|]]. rewrite V1, V2. exact Q.
Qed.
End Decision.

(** Two corners at one point, or a triangle across an axis and a line in that plane: the line misses, for all finite numbers. [EXACT-11] *)
Theorem flat_at_sight_is_missed v0 v1 v2 o d :
  let is_finite v := is_finite (fx v) = true /\ is_finite (fy v) = true /\ is_finite (fz v) = true in
  is_finite v0 -> is_finite v1 -> is_finite v2 -> is_finite d ->
  is_flat_at_sight v0 v1 v2 d = true -> ~ meets (determinants_of exactly (real v0) (real v1) (real v2) (real o) (real d)).
Proof.
  intros isf (X0 & Y0 & Z0) (X1 & Y1 & Z1) (X2 & Y2 & Z2) (Xd & Yd & Zd) F (N & _). apply N. clear N isf.
  assert (E : forall x y : float, is_finite x = true -> is_finite y = true -> Beqb x y = true -> B2R x = B2R y).
  { intros x y Fx Fy Q. rewrite Beqb_correct in Q by assumption. now destruct (Req_bool_spec (B2R x) (B2R y)). }
  unfold is_flat_at_sight, veq in F. rewrite !orb_true_iff, !andb_true_iff in F.
  cbn [determinants_of det]. unfold dot, exactly. cbn [vsub cross real vx vy vz].
  destruct F as [[[F|F]|F]|[[F|F]|F]]; destruct F as [[Fa Fb] Fc]; apply E in Fa, Fb, Fc; try assumption; try reflexivity;
    first [rewrite <- Fa, <- Fb, <- Fc; ring|change (B2R zero) with 0 in Fa; rewrite Fa, <- Fb, <- Fc; ring].
Qed.
