(** Rays within bounds, and what bounds of a distance decide: what Off.v and Intervals.v are about is what Operations.v has, in rounded
    real numbers; and [is_certain] and [is_within] on IEEE numbers. *)
Require Import Reals ZArith Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN.
Require Import StacklessExact.Rounding StacklessExact.Range StacklessExact.Arithmetic StacklessExact.Operations.
Require StacklessExact.Filter StacklessExact.Off StacklessExact.Intervals StacklessExact.Expansion StacklessExact.Slabs.
Open Scope R_scope.

Local Existing Instances Arithmetic.prec_24 Arithmetic.emax_128 Arithmetic.prec_53.

(** * The bounds of the determinants *)

Notation RX := (round radix2 (FLX_exp 53) ZnearestE).
Notation u := (bpow radix2 (-53)).

Lemma exact_constant n e x : (Z.abs n < 2 ^ 53)%Z -> x = IZR n * bpow radix2 e -> RX x = x.
Proof.
  intros H ->. apply round_generic; [typeclasses eauto|]. apply generic_format_FLX. now exists (Float radix2 n e).
Qed.

Lemma unit_is : filter_UNIT (reals RX) = u.
Proof.
  unfold filter_UNIT. cbn [reals over constant]. change (bpow radix2 (-52)) with (bpow radix2 (-53 + 1)). rewrite bpow_plus. change (bpow radix2 1) with 2.
  replace (1 * (bpow radix2 (-53) * 2) / (1 * 2)) with (bpow radix2 (-53)) by field. apply (exact_constant 1 (-53)); [reflexivity|symmetry; apply Rmult_1_l].
Qed.
Lemma factor_is : bounds_QUOTIENT_FACTOR (reals RX) = 5 / 4.
Proof.
  unfold bounds_QUOTIENT_FACTOR. cbn [reals over constant]. change (bpow radix2 0) with 1. change (bpow radix2 2) with 4.
  replace (5 * 1 / (1 * 4)) with (5 / 4) by field. apply (exact_constant 5 (-2)); [reflexivity|change (bpow radix2 (-2)) with (/ 4); field].
Qed.
Lemma integer_is n : constant (reals RX) n 0 = IZR n.
Proof. cbn [reals constant]. simpl. ring. Qed.

(** [Errors::within]. [INST-5] *)
Theorem within_agrees w v d c e : Errors_within (reals RX) w v d c e = (Off.within_sign RX u w v d c e, Off.within_det RX u v d e, Off.within_t RX u w c e).
Proof.
  unfold Errors_within, Errors_new. cbv zeta. rewrite unit_is, factor_is, !integer_is. cbn [reals plus times constant].
  change (bpow radix2 2) with 4. change (bpow radix2 1) with 2. replace (3 * 4) with 12 by ring. replace (3 * 2) with 6 by ring.
  assert (U : forall n, (Z.abs n < 2 ^ 50)%Z -> RX (IZR n * u) = IZR n * u) by (intros; apply (exact_constant n (-53)); [lia|reflexivity]).
  assert (Q : forall n, (Z.abs n < 2 ^ 50)%Z -> RX (IZR n * u * (5 / 4)) = IZR n * u * (5 / 4)).
  { intros n H. apply (exact_constant (n * 5) (-55)); [lia|]. rewrite mult_IZR. change (-55)%Z with (-53 + -2)%Z. rewrite bpow_plus. change (bpow radix2 (-2)) with (/ 4). field. }
  rewrite !U, !Q by reflexivity. reflexivity.
Qed.

(** * Intervals *)

Notation pred := (Ulp.pred radix2 (FLT_exp (-1074) 53)).
Notation succ := (Ulp.succ radix2 (FLT_exp (-1074) 53)).
Notation moving := (stepping (reals R64) pred succ).

Lemma zero_is : constant moving 0 0 = 0.
Proof. apply Rmult_0_l. Qed.

(** [Interval::add]. [INST-3] *)
Theorem interval_add_agrees a b c d : Interval_add moving a b c d = Intervals.plus (a, b) (c, d).
Proof.
  unfold Interval_add, Intervals.plus, Intervals.add_below, Intervals.add_above. rewrite zero_is. reflexivity.
Qed.
(** [Interval::neg]. [INST-3] *)
Theorem interval_neg_agrees a b : Interval_neg moving a b = Intervals.opposite (a, b).
Proof. reflexivity. Qed.

(** [middle_and_radius]: all that an interval holds is within the radius of the middle. [INST-5] *)
Theorem middle_and_radius_hold a b x : Expansion.F a -> Expansion.F b -> a <= x <= b ->
  let '(middle, radius) := Interval_middle_and_radius moving a b in Rabs (x - middle) <= radius.
Proof.
  intros A B [L H]. unfold Interval_middle_and_radius. cbv zeta. rewrite zero_is.
  match goal with |- context [plus moving ?p ?q] => set (m := plus moving p q) end. assert (M : Expansion.F m) by apply Expansion.F_R64.
  change (minus moving m a) with (R64 (m - a)). change (minus moving b m) with (R64 (b - m)). set (below := R64 (m - a)). set (above := R64 (b - m)).
  set (radius := if less moving above below then below else above).
  assert (Rb : below <= radius /\ above <= radius).
  { unfold radius. change (less moving above below) with (Rlt_bool above below). destruct (Rlt_bool_spec above below); lra. }
  assert (Fr : Expansion.F radius) by (unfold radius; destruct (less _ _ _); apply Expansion.F_R64).
  assert (Up : forall y, R64 y <= radius -> y <= succ radius).
  { intros y Hy. eapply Rle_trans; [apply (succ_round_ge_id radix2 (FLT_exp (-1074) 53) ZnearestE y)|]. apply succ_le; [typeclasses eauto|apply Expansion.F_R64|exact Fr|exact Hy]. }
  change (Rabs (x - m) <= (if Req_bool radius 0 then 0 else succ radius)). destruct (Req_bool_spec radius 0) as [Z|Z].
  - assert (Zero : forall p q, Expansion.F p -> Expansion.F q -> R64 (p - q) <= 0 -> p - q <= 0).
    { intros p q P Q Hr. destruct (difference (-1074) 53 p q P Q) as (e & He & E). rewrite E in Hr. apply Rnot_lt_le. intros C.
      destruct (unit_small 53 ltac:(lia)) as [U0 U1]. pose proof (unit_ratio _ U0) as S.
      apply Rabs_le_inv in He. assert (0 < (p - q) * (1 + e)) by (apply Rmult_lt_0_compat; lra). lra. }
    pose proof (Zero m a M A ltac:(fold below; lra)). pose proof (Zero b m B M ltac:(fold above; lra)). rewrite Rabs_pos_eq; lra.
  - pose proof (Up (m - a) (proj1 Rb)). pose proof (Up (b - m) (proj2 Rb)). apply Rabs_le. lra.
Qed.

(** [ends_in_single]: the floats are outside. [INST-4] *)
Notation R32 := (round radix2 (FLT_exp (-149) 24) ZnearestE).
Notation pred32 := (Ulp.pred radix2 (FLT_exp (-149) 24)).
Notation succ32 := (Ulp.succ radix2 (FLT_exp (-149) 24)).
Theorem ends_in_single_hold a b :
  let '(low, high) := Interval_ends_in_single (stepping (reals R32) pred32 succ32) moving (fun x => x) R32 a b in low <= a /\ b <= high.
Proof.
  unfold Interval_ends_in_single. cbv zeta. assert (D : forall x, (if less moving x (R32 x) then pred32 (R32 x) else R32 x) <= x).
  { intros x. change (less moving x (R32 x)) with (Rlt_bool x (R32 x)). destruct (Rlt_bool_spec x (R32 x)) as [H|H]; [|exact H]. apply pred_round_le_id; typeclasses eauto. }
  split; [apply D|]. pose proof (D (- b)) as H.
  match goal with |- _ <= ?e => change e with (- (if less moving (- b) (R32 (- b)) then pred32 (R32 (- b)) else R32 (- b))) end. lra.
Qed.

(** * What bounds of a distance decide *)

Notation float := (binary_float 24 128).
Notation value := (Slabs.value 24 128).
Notation nearest := (Slabs.nearest 24 128).

(** Bounds of t >= 0 that are rounded to floats. *)
Section Certain.
Variables near far tmin tmax : float.
Variable t : R.
Hypothesis Hn : is_nan near = false /\ value near <= nearest t.
Hypothesis Hf : is_nan far = false /\ nearest t <= value far.
Hypothesis Ht : BinarySingleNaN.is_finite tmin = true.
Hypothesis Hm : is_nan tmax = false.

Lemma less_value (x y : float) : is_nan x = false -> is_nan y = false -> less f32 x y = true -> value x < value y.
Proof. intros X Y H. change (Bltb x y = true) in H. rewrite Slabs.Bltb_value in H by assumption. revert H. now destruct (Rlt_bool_spec (value x) (value y)). Qed.

(** Rounding keeps the order: a rounded distance is beyond a float, or before it, only if the distance is. *)
Lemma value_format (x : float) : generic_format radix2 (FLT_exp (-149) 24) (value x).
Proof.
  destruct x as [s|[]| |s m e B]; unfold Slabs.value; try exact (generic_format_B2R 24 128 _); [apply generic_format_opp|];
    apply generic_format_bpow; unfold FLT_exp; lia.
Qed.
Lemma not_before (x : float) : value x < nearest t -> value x < t.
Proof.
  intros H. apply Rnot_le_lt. intros L. apply (Rlt_not_le _ _ H). eapply Rle_trans; [apply Rmin_l|].
  apply round_le_generic; [typeclasses eauto..|apply value_format|exact L].
Qed.
Lemma not_after (x : float) : nearest t < value x -> t < value x.
Proof.
  intros H. apply Rnot_le_lt. intros L. apply (Rlt_not_le _ _ H). pose proof (Slabs.value_inside 24 128 x) as In.
  apply Rmin_glb; [|lra]. apply round_ge_generic; [typeclasses eauto..|apply value_format|exact L].
Qed.

(** [is_certain]: RN(t) is the float, and t is within the interval. [EXACT-9] *)
Theorem is_certain_is_right : exact_is_certain f32 near far tmin tmax = true -> nearest t = value near /\ value tmin < t < value tmax.
Proof.
  destruct Hn as [Nn Vn], Hf as [Nf Vf]. assert (Nt : is_nan tmin = false) by now destruct tmin.
  unfold exact_is_certain. intros H. apply andb_prop in H as [H L2]. apply andb_prop in H as [E L1]. apply less_value in L1, L2; try assumption.
  assert (Same : value near = value far).
  { change (Beqb near far = true) in E. destruct near as [s|[]| |s m e B], far as [s'|[]| |s' m' e' B']; try discriminate; try reflexivity;
      (rewrite Beqb_correct in E by reflexivity; unfold Slabs.value; match type of E with Req_bool ?p ?q = true => destruct (Req_bool_spec p q); [assumption|discriminate] end). }
  split; [lra|]. split; [apply not_before|apply not_after]; lra.
Qed.

(** [is_within]: what it says of the interval is so. [EXACT-9] *)
Theorem is_within_is_right : match exact_is_within f32 near far tmin tmax with
  | Some true => value tmin < t < value tmax | Some false => t < value tmin \/ value tmax < t | None => True end.
Proof.
  destruct Hn as [Nn Vn], Hf as [Nf Vf]. assert (Nt : is_nan tmin = false) by now destruct tmin.
  unfold exact_is_within. destruct (andb _ _) eqn:A.
  - apply andb_prop in A as [L1 L2]. apply less_value in L1, L2; try assumption. split; [apply not_before|apply not_after]; lra.
  - destruct (orb _ _) eqn:O; [|exact I]. apply orb_prop in O as [L|L]; apply less_value in L; try assumption; [left; apply not_after|right; apply not_before]; lra.
Qed.
End Certain.
