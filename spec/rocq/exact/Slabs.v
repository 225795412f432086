(** The slab test of src/geom/slabs, on IEEE 754 numbers as Flocq has them: infinities, NaN, both zeros, overflow, gradual
    underflow. Operations, and the order of operands of each comparison, are those of the code (BOX-1). *)
Require Import Reals ZArith Lia Lra Psatz Bool List.
From Flocq Require Import Core BinarySingleNaN.
Require Import StacklessExact.Rounding StacklessExact.Planes.
Open Scope R_scope.

Section Slabs.
Variables prec emax : Z.
Context (prec_pos : Prec_gt_0 prec) (prec_emax : Prec_lt_emax prec emax).
(** How far a reciprocal is moved: STEPS of directed.rs, STRICT_STEPS of slabs64.rs. *)
Variable steps : nat.
Hypothesis prec_6 : (6 <= prec)%Z.
Hypothesis steps_2_3 : steps = 2%nat \/ steps = 3%nat.

Notation float := (binary_float prec emax).
Notation emin := (SpecFloat.emin prec emax).
Notation fexp := (FLT_exp emin prec).
Notation F := (generic_format radix2 fexp).
Notation RN := (round radix2 fexp ZnearestE).
Notation pred := (Ulp.pred radix2 fexp).
Notation succ := (Ulp.succ radix2 fexp).
Notation u := (unit prec).
Notation M := (bpow radix2 emax).

(** * The code *)

Definition zero : float := B754_zero false.
Definition one : float := Bone.
Definition infinity : float := B754_infinity false.
Definition minus (x y : float) : float := Bminus mode_NE x y.
Definition times (x y : float) : float := Bmult mode_NE x y.

(** [lesser] and [greater] of src/geom/slabs/mod.rs, and the comparisons of doubled.rs: b, if either is a NaN. *)
Definition lesser (a b : float) : float := if Bltb a b then a else b.
Definition greater (a b : float) : float := if Bltb b a then a else b.

(** [from_bits(to_bits() + by)]: the next floats in magnitude, whatever the sign. *)
Definition moved (move : float -> float) (i : float) : float :=
  if Bsign i then Bopp (Nat.iter steps move (Bopp i)) else Nat.iter steps move i.

(** One component of [Directed::new] and of [Doubled::new]: the reciprocals for lo and for hi. Adding 0 makes -0 to 0. *)
Definition reciprocal (d : float) : float := Bdiv mode_NE one (Bplus mode_NE d zero).
Definition reciprocals (d : float) : float * float :=
  let is_zero := Beqb (Bplus mode_NE d zero) zero in
  let near := moved Bpred (reciprocal d) in
  let far := if is_zero then infinity else moved Bsucc (reciprocal d) in
  if Bltb (Bplus mode_NE d zero) zero then (far, near) else (near, far).

(** One axis: origin, direction, lower and upper plane. *)
Definition axis : Type := float * float * float * float.

(** One turn of the loop of [near_and_far] in mod.rs, and of [Doubled::pair]. *)
Definition narrow (ends : float * float) (a : axis) : float * float :=
  let '(near, far) := ends in
  let '(o, d, lo, hi) := a in
  let t1 := times (minus lo o) (fst (reciprocals d)) in
  let t2 := times (minus hi o) (snd (reciprocals d)) in
  (greater (lesser t2 t1) near, lesser (greater t1 t2) far).

(** [near_and_far]: over all axes, in their order. *)
Definition near_and_far (axes : list axis) (tmin tmax : float) : float * float := fold_left narrow axes (tmin, tmax).

(** [is_usual] of [Directed::new] for one component, with what [Region] says of the planes: no difference overflows, and no
    reciprocal but that of 0. *)
Definition usual (a : axis) : Prop :=
  let '(o, d, lo, hi) := a in
  is_finite d = true /\ (B2R d = 0 \/ is_finite (reciprocal d) = true) /\
  (is_finite o = true /\ Rabs (B2R o) <= bpow radix2 (emax - 2)) /\
  (is_finite lo = true /\ Rabs (B2R lo) <= bpow radix2 (emax - 2)) /\
  (is_finite hi = true /\ Rabs (B2R hi) <= bpow radix2 (emax - 2)).

(** The ray is in the closed slab at t: exact real numbers. *)
Definition touches (t : R) (a : axis) : Prop :=
  let '(o, d, lo, hi) := a in B2R lo <= B2R o + t * B2R d <= B2R hi.

(** * Floats as numbers *)

(** The value of a number that is not a NaN; infinity stands for 2^emax, which is above all finite floats. *)
Definition value (x : float) : R :=
  match x with B754_infinity true => - M | B754_infinity false => M | x => B2R x end.

(** The value of the float nearest to t >= 0. *)
Definition nearest (t : R) : R := Rmin (RN t) M.

Lemma M_pos : 0 < M.
Proof. apply bpow_gt_0. Qed.

Lemma finite_inside (x : float) : - M < B2R x < M.
Proof. pose proof (abs_B2R_lt_emax prec emax x) as H. apply Rabs_def2 in H. lra. Qed.

Lemma finite_value x : is_finite x = true -> value x = B2R x.
Proof. now destruct x as [| [] | |]. Qed.

Lemma value_inside x : - M <= value x <= M.
Proof. pose proof M_pos. pose proof (finite_inside x). destruct x as [| [] | |]; unfold value; simpl in *; lra. Qed.

Lemma B2R_format (x : float) : F (B2R x).
Proof. exact (generic_format_B2R prec emax x). Qed.

(** A comparison is that of the values. *)
Lemma Bltb_value a b : is_nan a = false -> is_nan b = false -> Bltb a b = Rlt_bool (value a) (value b).
Proof.
  intros Na Nb. pose proof M_pos. destruct (is_finite a) eqn:Fa.
  - destruct (is_finite b) eqn:Fb; [rewrite !finite_value by assumption; now apply Bltb_correct|].
    rewrite (finite_value a Fa). pose proof (finite_inside a).
    destruct b as [| [] | |]; try discriminate; unfold value;
      [rewrite Rlt_bool_false by lra|rewrite Rlt_bool_true by lra]; destruct a as [[]|[]| |[]]; try discriminate; reflexivity.
  - destruct a as [|sa| |]; try discriminate. destruct (is_finite b) eqn:Fb.
    + rewrite (finite_value b Fb). pose proof (finite_inside b).
      destruct sa; unfold value; [rewrite Rlt_bool_true by lra|rewrite Rlt_bool_false by lra];
        destruct b as [[]|[]| |[]]; try discriminate; reflexivity.
    + destruct b as [|sb| |]; try discriminate. destruct sa, sb; unfold value;
        ((rewrite Rlt_bool_true by lra) || (rewrite Rlt_bool_false by lra)); reflexivity.
Qed.

Lemma Bleb_value a b : is_nan a = false -> is_nan b = false -> value a <= value b -> Bleb a b = true.
Proof.
  intros Na Nb H. assert (L : Bltb b a = false) by (rewrite Bltb_value by assumption; apply Rlt_bool_false, H).
  destruct (is_finite a && is_finite b) eqn:E.
  - apply andb_prop in E as [Fa Fb]. rewrite Bleb_correct by assumption. apply Rle_bool_true.
    now rewrite <- !finite_value.
  - unfold Bltb, Bleb, SpecFloat.SFltb, SpecFloat.SFleb in *.
    destruct a as [[]|[]| |[]], b as [[]|[]| |[]]; try discriminate; reflexivity.
Qed.

Lemma Bltb_nan_l b : Bltb (B754_nan : float) b = false.
Proof. now destruct b as [[]|[]| |[]]. Qed.
Lemma Bltb_nan_r a : Bltb a (B754_nan : float) = false.
Proof. now destruct a as [[]|[]| |[]]. Qed.

(** What is known of an end of the interval. *)
Definition at_most (x : float) (v : R) : Prop := is_nan x = false /\ value x <= v.
Definition at_least (x : float) (v : R) : Prop := is_nan x = false /\ v <= value x.

Lemma lesser_at_most a b v : is_nan a = false -> is_nan b = false -> at_most a v \/ at_most b v -> at_most (lesser a b) v.
Proof.
  intros Na Nb H. unfold lesser. rewrite Bltb_value by assumption.
  destruct (Rlt_bool_spec (value a) (value b)); split; try assumption; destruct H as [[_ H]|[_ H]]; lra.
Qed.

(** A NaN for the upper plane leaves the lower one. *)
Lemma lesser_of_nan b : lesser B754_nan b = b.
Proof. unfold lesser. now rewrite Bltb_nan_l. Qed.
Lemma greater_to_nan a : greater a B754_nan = B754_nan.
Proof. unfold greater. now rewrite Bltb_nan_l. Qed.

Lemma greater_at_least a b v : is_nan a = false -> is_nan b = false -> at_least a v \/ at_least b v -> at_least (greater a b) v.
Proof.
  intros Na Nb H. unfold greater. rewrite Bltb_value by assumption.
  destruct (Rlt_bool_spec (value b) (value a)); split; try assumption; destruct H as [[_ H]|[_ H]]; lra.
Qed.

Lemma greater_at_most a b v : at_most a v -> at_most b v -> at_most (greater a b) v.
Proof. intros Ha Hb. unfold greater. now destruct (Bltb b a). Qed.
Lemma lesser_at_least a b v : at_least a v -> at_least b v -> at_least (lesser a b) v.
Proof. intros Ha Hb. unfold lesser. now destruct (Bltb a b). Qed.

Lemma sign_of_R (x : float) : if Bsign x then B2R x <= 0 else 0 <= B2R x.
Proof.
  destruct x as [[]|[]| |[] m e Hm]; simpl; try lra.
  - apply F2R_le_0. simpl. lia.
  - apply F2R_ge_0. simpl. lia.
Qed.

Lemma RN_0_le x : 0 <= x -> 0 <= RN x.
Proof. intros. rewrite <- (round_0 radix2 fexp ZnearestE). now apply round_le; try typeclasses eauto. Qed.
Lemma RN_le_0 x : x <= 0 -> RN x <= 0.
Proof. intros. rewrite <- (round_0 radix2 fexp ZnearestE). now apply round_le; try typeclasses eauto. Qed.

(** A product of finite floats is the rounded one, cut off at infinity. *)
Lemma times_value x y : is_finite x = true -> is_finite y = true ->
  is_nan (times x y) = false /\ value (times x y) = Rmax (- M) (Rmin (RN (B2R x * B2R y)) M).
Proof.
  intros Fx Fy. pose proof M_pos as MP. unfold times. generalize (Bmult_correct prec emax _ _ mode_NE x y).
  change (round_mode mode_NE) with ZnearestE. change (SpecFloat.fexp prec emax) with fexp.
  set (p := RN (B2R x * B2R y)). destruct (Rlt_bool_spec (Rabs p) M) as [H|H].
  - intros (E & Fin & _). rewrite Fx, Fy in Fin. apply Rabs_def2 in H. split.
    + now destruct (Bmult _ _ _).
    + rewrite finite_value by exact Fin. rewrite E. rewrite Rmin_left, Rmax_right; lra.
  - intros E. simpl in E.
    assert (E' : Bmult mode_NE x y = B754_infinity (xorb (Bsign x) (Bsign y))) by (apply B2SF_inj; rewrite E; reflexivity).
    rewrite E'. split; [reflexivity|].
    pose proof (sign_of_R x) as Sx. pose proof (sign_of_R y) as Sy.
    assert (P : 0 <= B2R x * B2R y -> p = Rabs p) by (intros; symmetry; apply Rabs_pos_eq, RN_0_le; assumption).
    assert (N : B2R x * B2R y <= 0 -> p = - Rabs p).
    { intros. rewrite Rabs_left1; [ring|]. apply RN_le_0; assumption. }
    destruct (Bsign x), (Bsign y); simpl; unfold value.
    + rewrite P by nra. rewrite Rmin_right, Rmax_right; lra.
    + rewrite N by nra. rewrite Rmin_left, Rmax_left; lra.
    + rewrite N by nra. rewrite Rmin_left, Rmax_left; lra.
    + rewrite P by nra. rewrite Rmin_right, Rmax_right; lra.
Qed.

(** A difference does not overflow for coordinates of at most 2^(emax - 2). *)
Lemma minus_value b o : is_finite b = true -> is_finite o = true ->
  Rabs (B2R b) <= bpow radix2 (emax - 2) -> Rabs (B2R o) <= bpow radix2 (emax - 2) ->
  is_finite (minus b o) = true /\ B2R (minus b o) = RN (B2R b - B2R o).
Proof.
  intros Fb Fo Hb Ho. unfold minus. generalize (Bminus_correct prec emax _ _ mode_NE b o Fb Fo).
  change (round_mode mode_NE) with ZnearestE. change (SpecFloat.fexp prec emax) with fexp.
  rewrite Rlt_bool_true; [tauto|].
  apply Rle_lt_trans with (bpow radix2 (emax - 1)); [|apply bpow_lt; lia].
  apply abs_round_le_generic; [typeclasses eauto|typeclasses eauto| |].
  - apply generic_format_bpow. unfold FLT_exp, SpecFloat.emin. pose proof prec_emax as P. unfold Prec_lt_emax in P. lia.
  - replace (emax - 1)%Z with (emax - 2 + 1)%Z by lia. rewrite bpow_plus. change (bpow radix2 1) with 2.
    pose proof (sub_b _ _ _ _ Hb Ho). lra.
Qed.

(** * Reciprocals *)

Lemma format_pow e : (emin <= e)%Z -> F (bpow radix2 e).
Proof. intros. apply generic_format_bpow. unfold FLT_exp. pose proof prec_pos as P. unfold Prec_gt_0 in P. lia. Qed.

Lemma emin_is : emin = (3 - emax - prec)%Z.
Proof. reflexivity. Qed.

(** The floats next below 2^emax. *)
Definition top (k : Z) : R := M - IZR k * bpow radix2 (emax - prec).

Lemma top_format k : (0 <= k <= 4)%Z -> F (top k).
Proof.
  intros Hk. pose proof prec_emax as P. unfold Prec_lt_emax in P.
  assert (E : top k = F2R (Float radix2 (2 ^ prec - k) (emax - prec))).
  { unfold top, F2R. simpl. rewrite minus_IZR, (IZR_Zpower radix2) by lia. rewrite Rmult_minus_distr_r, <- bpow_plus.
    do 2 f_equal. lia. }
  destruct (Z.eq_dec k 0) as [-> |Hk0].
  { unfold top. rewrite Rmult_0_l, Rminus_0_r. apply format_pow. rewrite emin_is. lia. }
  rewrite E. apply generic_format_FLT. exists (Float radix2 (2 ^ prec - k) (emax - prec)); simpl; [reflexivity| |].
  - assert (4 < 2 ^ prec)%Z by (apply Z.lt_le_trans with (2 ^ 6)%Z; [reflexivity|apply Z.pow_le_mono_r; lia]).
    change (Z.pow_pos 2 1) with 2%Z. lia.
  - rewrite emin_is. lia.
Qed.

Lemma top_steps k : top k = top (k + 1) + bpow radix2 (emax - prec).
Proof. unfold top. rewrite plus_IZR. ring. Qed.

(** No finite reciprocal is near the greatest float: d is 2^-emax or less, and then it overflows, or at least the next
    subnormal number, which is 8u of it above. *)
Lemma reciprocal_not_near_top d : F d -> 0 < d -> RN (1 / d) < M -> RN (1 / d) <= top 4.
Proof.
  intros Fd Hd H. pose proof prec_emax as P. unfold Prec_lt_emax in P.
  apply round_le_generic; [typeclasses eauto|typeclasses eauto|apply top_format; lia|].
  assert (B0 : F (bpow radix2 (- emax))) by (apply format_pow; rewrite emin_is; lia).
  assert (L : bpow radix2 (- emax) < d).
  { apply Rnot_le_lt. intros L. apply (Rlt_not_le _ _ H). apply round_ge_generic; [typeclasses eauto|typeclasses eauto| |].
    - replace M with (top 0) by (unfold top; ring). apply top_format. lia.
    - replace M with (/ bpow radix2 (- emax)) by (rewrite <- bpow_opp; f_equal; lia).
      unfold Rdiv. rewrite Rmult_1_l. apply Rinv_le; assumption. }
  assert (S : bpow radix2 (- emax) + bpow radix2 emin <= d).
  { rewrite <- (succ_le_lt radix2 fexp _ d B0 Fd L) || (pose proof (succ_le_lt radix2 fexp _ d B0 Fd L) as S).
    rewrite succ_eq_pos in S by apply bpow_ge_0. rewrite ulp_bpow in S.
    replace (fexp (- emax + 1)) with emin in S; [exact S|]. unfold FLT_exp. rewrite emin_is. lia. }
  set (m := bpow radix2 (- emax)) in *. assert (Hm : 0 < m) by apply bpow_gt_0.
  assert (MM : M * m = 1) by (unfold m; rewrite <- bpow_plus; now replace (emax + - emax)%Z with 0%Z by lia).
  assert (EM : bpow radix2 emin = 8 * u * m).
  { unfold m. change 8 with (bpow radix2 3). rewrite <- !bpow_plus. f_equal. rewrite emin_is. lia. }
  assert (ET : bpow radix2 (emax - prec) = u * M) by (rewrite <- bpow_plus; f_equal; lia).
  assert (Hu : 0 < u <= / 64) by (split; [apply bpow_gt_0|change (/ 64) with (bpow radix2 (-6)); apply bpow_le; lia]).
  unfold top. rewrite ET. rewrite EM in S. pose proof M_pos.
  apply Rmult_le_reg_r with d; [exact Hd|]. unfold Rdiv. rewrite Rmult_1_l, Rinv_l by lra.
  replace (M - 4 * (u * M)) with (M * (1 - 4 * u)) by ring.
  apply Rle_trans with (M * (1 - 4 * u) * (m * (1 + 8 * u))).
  - replace (M * (1 - 4 * u) * (m * (1 + 8 * u))) with (M * m * ((1 - 4 * u) * (1 + 8 * u))) by ring. rewrite MM. nra.
  - apply Rmult_le_compat_l; [|lra]. apply Rmult_le_pos; lra.
Qed.

Lemma Bsucc_value x y : is_finite x = true -> F y -> B2R x < y -> y < M ->
  is_finite (Bsucc x) = true /\ B2R (Bsucc x) = succ (B2R x) /\ B2R (Bsucc x) <= y.
Proof.
  intros Fx Fy H Hy. generalize (Bsucc_correct prec emax _ _ x Fx). change (SpecFloat.fexp prec emax) with fexp.
  assert (L : succ (B2R x) <= y) by (apply succ_le_lt; [typeclasses eauto|apply B2R_format|assumption|assumption]).
  rewrite Rlt_bool_true by lra. intros (E & Fin & _). rewrite E. auto.
Qed.

Lemma Bpred_value x y : is_finite x = true -> F y -> 0 <= y -> y < B2R x ->
  is_finite (Bpred x) = true /\ B2R (Bpred x) = pred (B2R x) /\ y <= B2R (Bpred x).
Proof.
  intros Fx Fy Hy H. generalize (Bpred_correct prec emax _ _ x Fx). change (SpecFloat.fexp prec emax) with fexp.
  assert (L : y <= pred (B2R x)) by (apply pred_ge_gt; [typeclasses eauto|assumption|apply B2R_format|assumption]).
  pose proof M_pos. rewrite Rlt_bool_true by lra. intros (E & Fin & _). rewrite E. auto.
Qed.

(** For d > 0 with a finite reciprocal: both moved ones are finite, and as far off as BOX-2 needs. *)
Lemma moved_reciprocal d i : F d -> 0 < d < M -> is_finite i = true -> B2R i = RN (1 / d) ->
  (is_finite (Nat.iter steps Bpred i) = true /\ 0 <= B2R (Nat.iter steps Bpred i) <= (1 - u) * (1 / d)) /\
  (is_finite (Nat.iter steps Bsucc i) = true /\ (1 + u) * (1 / d) <= B2R (Nat.iter steps Bsucc i)).
Proof.
  intros Fd [Hd HdM] Fi Ei. pose proof prec_emax as P. unfold Prec_lt_emax in P.
  assert (Low : bpow radix2 (- emax) <= B2R i).
  { rewrite Ei. apply round_ge_generic; [typeclasses eauto|typeclasses eauto|apply format_pow; rewrite emin_is; lia|].
    rewrite bpow_opp. unfold Rdiv. rewrite Rmult_1_l. apply Rinv_le; [assumption|lra]. }
  assert (Pos : 0 < B2R i) by (eapply Rlt_le_trans; [apply bpow_gt_0|exact Low]).
  assert (High : B2R i <= top 4).
  { rewrite Ei. apply reciprocal_not_near_top; try assumption. rewrite <- Ei. apply finite_inside. }
  assert (Down : forall k x, (0 <= k <= 2)%Z -> is_finite x = true -> bpow radix2 (- emax - k) <= B2R x ->
    is_finite (Bpred x) = true /\ B2R (Bpred x) = pred (B2R x) /\ bpow radix2 (- emax - (k + 1)) <= B2R (Bpred x)).
  { intros k x Hk Fx Hx. apply Bpred_value; [assumption|apply format_pow; rewrite emin_is; lia|apply bpow_ge_0|].
    eapply Rlt_le_trans; [|exact Hx]. apply bpow_lt. lia. }
  assert (Up : forall k x, (2 <= k <= 4)%Z -> is_finite x = true -> B2R x <= top k ->
    is_finite (Bsucc x) = true /\ B2R (Bsucc x) = succ (B2R x) /\ B2R (Bsucc x) <= top (k - 1)).
  { intros k x Hk Fx Hx. pose proof (bpow_gt_0 radix2 (emax - prec)) as B.
    apply Bsucc_value; [assumption|apply top_format; lia| |].
    - pose proof (top_steps (k - 1)) as T. replace (k - 1 + 1)%Z with k in T by lia. lra.
    - unfold top. assert (1 <= IZR (k - 1)) by (apply IZR_le; lia). nra. }
  destruct (Down 0%Z i ltac:(lia) Fi) as (D1 & E1 & L1); [now rewrite Z.sub_0_r|].
  destruct (Down 1%Z _ ltac:(lia) D1 L1) as (D2 & E2 & L2).
  destruct (Down 2%Z _ ltac:(lia) D2 L2) as (D3 & E3 & L3).
  destruct (Up 4%Z i ltac:(lia) Fi High) as (U1 & G1 & H1).
  destruct (Up 3%Z _ ltac:(lia) U1 H1) as (U2 & G2 & H2).
  destruct (Up 2%Z _ ltac:(lia) U2 H2) as (U3 & G3 & H3).
  rewrite E1 in E2. rewrite G1 in G2.
  assert (N2 : 0 < B2R (Bpred (Bpred i))) by (eapply Rlt_le_trans; [apply bpow_gt_0|exact L2]).
  assert (N3 : 0 < B2R (Bpred (Bpred (Bpred i)))) by (eapply Rlt_le_trans; [apply bpow_gt_0|exact L3]).
  assert (K2 : B2R (Bpred (Bpred i)) <= (1 - u) * (1 / d)).
  { rewrite E2 in *. apply (two_down emin prec); [lia|now symmetry|assumption|assumption]. }
  assert (K3 : (1 + u) * (1 / d) <= B2R (Bsucc (Bsucc i))).
  { rewrite G2. apply (two_up emin prec); [lia|now symmetry|assumption]. }
  assert (I2 : B2R (Bpred (Bpred (Bpred i))) <= B2R (Bpred (Bpred i))) by (rewrite E3; apply pred_le_id).
  assert (I3 : B2R (Bsucc (Bsucc i)) <= B2R (Bsucc (Bsucc (Bsucc i)))) by (rewrite G3; apply succ_ge_id).
  destruct steps_2_3 as [-> | ->]; simpl; (split; split); try assumption; lra.
Qed.

(** The reciprocal of a component that is not 0. *)
Lemma reciprocal_value d : is_finite d = true -> B2R d <> 0 -> is_finite (reciprocal d) = true ->
  B2R (reciprocal d) = RN (1 / B2R d) /\ Bsign (reciprocal d) = Bsign d /\ Bplus mode_NE d zero = d.
Proof.
  intros Fd Hd. assert (Same : Bplus mode_NE d zero = d) by (destruct d as [s| | |]; [now contradict Hd|..]; easy).
  unfold reciprocal. rewrite Same. generalize (Bdiv_correct prec emax _ _ mode_NE one d Hd).
  change (round_mode mode_NE) with ZnearestE. change (SpecFloat.fexp prec emax) with fexp.
  unfold one. rewrite Bone_correct. destruct (Rlt_bool_spec (Rabs (RN (1 / B2R d))) M) as [H|H].
  - intros (E & Fin & S) F. repeat split; try assumption. rewrite S by now destruct (Bdiv _ _ _).
    rewrite Bsign_Bone. now destruct (Bsign d).
  - intros E F. exfalso. simpl in E.
    assert (E' : Bdiv mode_NE Bone d = B754_infinity (xorb (Bsign (Bone : float)) (Bsign d))) by (apply B2SF_inj; rewrite E; reflexivity).
    rewrite E' in F. discriminate.
Qed.

(** Reciprocals of a component of 0, of either sign. *)
Lemma reciprocals_of_zero d : is_finite d = true -> B2R d = 0 -> reciprocals d = (Nat.iter steps Bpred infinity, infinity).
Proof.
  intros Fd Zd.
  assert (Ez : Bplus mode_NE d zero = zero).
  { destruct d as [[]|s| |s m e H]; try discriminate; try reflexivity. exfalso. simpl in Zd.
    apply eq_0_F2R in Zd. destruct s; discriminate. }
  unfold reciprocals, reciprocal. rewrite Ez.
  replace (Bltb zero zero) with false by reflexivity. replace (Beqb zero zero) with true by reflexivity.
  replace (Bdiv mode_NE one zero) with infinity; [reflexivity|].
  unfold one. pose proof (is_finite_strict_Bone prec emax _ _) as S. pose proof (Bsign_Bone prec emax _ _) as S'.
  destruct (Bone : float) as [| | |s m e H]; try discriminate. simpl in S'. now subst s.
Qed.

(** The float below infinity is the greatest. *)
Lemma moved_infinity : is_finite (Nat.iter steps Bpred infinity) = true /\ 0 <= B2R (Nat.iter steps Bpred infinity).
Proof.
  assert (E : Bpred infinity = Bmax_float) by reflexivity.
  assert (V : B2R (Bmax_float : float) = top 1).
  { unfold Bmax_float. rewrite B2R_SF2B. unfold SF2R, F2R. cbn [Fnum Fexp cond_Zopp].
    assert (P : (4 < 2 ^ prec)%Z) by (apply Z.lt_le_trans with (2 ^ 6)%Z; [reflexivity|apply Z.pow_le_mono_r; lia]).
    assert (S : Z.pos (shift_pos (Z.to_pos prec) 1) = (2 ^ prec)%Z).
    { rewrite shift_pos_correct, Z.mul_1_r. change (Z.pow_pos 2 (Z.to_pos prec)) with (2 ^ Z.pos (Z.to_pos prec))%Z.
      now rewrite Z2Pos.id by lia. }
    rewrite Pos2Z.inj_sub by lia. rewrite S.
    unfold top. rewrite minus_IZR, (IZR_Zpower radix2) by lia. rewrite Rmult_minus_distr_r, <- bpow_plus.
    do 2 f_equal. lia. }
  pose proof (bpow_gt_0 radix2 (emax - prec)) as B.
  assert (T3 : 0 <= top 3).
  { unfold top. replace emax with (prec + (emax - prec))%Z at 1 by lia. rewrite bpow_plus.
    assert (3 <= bpow radix2 prec); [|nra]. apply Rle_trans with (bpow radix2 6); [simpl; lra|now apply bpow_le]. }
  assert (Down : forall k x, (1 <= k <= 2)%Z -> is_finite x = true -> top k <= B2R x ->
    is_finite (Bpred x) = true /\ top (k + 1) <= B2R (Bpred x)).
  { intros k x Hk Fx Hx. pose proof (top_steps k) as S.
    assert (top 3 <= top (k + 1)) by (unfold top; assert (IZR (k + 1) <= 3) by (apply IZR_le; lia); nra).
    destruct (Bpred_value x (top (k + 1)) Fx) as (? & _ & ?); auto; [apply top_format; lia|lra|lra]. }
  destruct (Down 1%Z Bmax_float ltac:(lia)) as [F2 H2]; [apply is_finite_SF2B || reflexivity|rewrite V; lra|].
  destruct (Down 2%Z _ ltac:(lia) F2 H2) as [F3 H3].
  pose proof (top_steps 2). simpl in H2, H3.
  destruct steps_2_3 as [-> | ->]; simpl; rewrite E; (split; [assumption|]); change (2 + 1)%Z with 3%Z in *; change (1 + 1)%Z with 2%Z in *; lra.
Qed.

(** Reciprocals of another component, both signs: n for the near plane, f for the far one. *)
Lemma reciprocals_value d : is_finite d = true -> B2R d <> 0 -> is_finite (reciprocal d) = true ->
  exists n f, is_finite n = true /\ is_finite f = true /\
    (0 <= B2R n <= (1 - u) * (1 / Rabs (B2R d)) /\ (1 + u) * (1 / Rabs (B2R d)) <= B2R f) /\
    ((0 < B2R d /\ reciprocals d = (n, f)) \/ (B2R d < 0 /\ reciprocals d = (Bopp f, Bopp n))).
Proof.
  intros Fd Nd Hi. destruct (reciprocal_value d Fd Nd Hi) as (V & S & E). pose proof (finite_inside d) as HM.
  unfold reciprocals. rewrite E. rewrite Bltb_correct, Beqb_correct by (assumption || reflexivity).
  change (B2R zero) with 0. rewrite Req_bool_false by assumption. unfold moved.
  pose proof (sign_of_R d) as Sd. rewrite S.
  destruct (Rtotal_order (B2R d) 0) as [H|[H|H]]; [|contradiction|].
  - rewrite Rlt_bool_true by assumption. destruct (Bsign d); [|lra].
    destruct (moved_reciprocal (- B2R d) (Bopp (reciprocal d))) as [[Fn Hn] [Ff Hf]].
    + apply generic_format_opp, B2R_format.
    + lra.
    + now rewrite is_finite_Bopp.
    + rewrite B2R_Bopp, V, <- round_NE_opp. f_equal. field. lra.
    + exists (Nat.iter steps Bpred (Bopp (reciprocal d))), (Nat.iter steps Bsucc (Bopp (reciprocal d))).
      rewrite Rabs_left by assumption. tauto.
  - rewrite Rlt_bool_false by lra. destruct (Bsign d); [lra|].
    destruct (moved_reciprocal (B2R d) (reciprocal d)) as [[Fn Hn] [Ff Hf]]; try assumption.
    + apply B2R_format.
    + lra.
    + exists (Nat.iter steps Bpred (reciprocal d)), (Nat.iter steps Bsucc (reciprocal d)).
      rewrite Rabs_pos_eq by lra. tauto.
Qed.

(** * One axis *)

Lemma nearest_pos t : 0 <= t -> 0 <= nearest t.
Proof. intros. pose proof M_pos. apply Rmin_glb; [now apply RN_0_le|lra]. Qed.

(** What a product says of the interval. *)
Lemma times_at_most x y t : is_finite x = true -> is_finite y = true -> 0 <= t ->
  RN (B2R x * B2R y) <= RN t -> at_most (times x y) (nearest t).
Proof.
  intros Fx Fy Ht H. destruct (times_value x y Fx Fy) as [N E]. split; [exact N|]. rewrite E.
  pose proof (nearest_pos t Ht). pose proof M_pos. apply Rmax_lub; [lra|]. unfold nearest.
  apply Rle_min_compat_r. exact H.
Qed.

Lemma times_at_least x y t : is_finite x = true -> is_finite y = true ->
  RN t <= RN (B2R x * B2R y) -> at_least (times x y) (nearest t).
Proof.
  intros Fx Fy H. destruct (times_value x y Fx Fy) as [N E]. split; [exact N|]. rewrite E.
  eapply Rle_trans; [|apply Rmax_r]. unfold nearest. apply Rle_min_compat_r. exact H.
Qed.

(** One turn of the loop keeps what is known: near is not after the hit, far not before it. *)
Lemma narrow_keeps ends a t : usual a -> touches t a -> 0 <= t ->
  at_most (fst ends) (nearest t) -> at_least (snd ends) (nearest t) ->
  at_most (fst (narrow ends a)) (nearest t) /\ at_least (snd (narrow ends a)) (nearest t).
Proof.
  destruct ends as [near far], a as [[[o d] lo] hi]. simpl fst. simpl snd.
  intros (Fd & Hi & (Fo & Ho) & (Fl & Hl) & (Fh & Hh)) T Ht Hn Hf.
  destruct (minus_value lo o Fl Fo Hl Ho) as [Flo Elo]. destruct (minus_value hi o Fh Fo Hh Ho) as [Fhi Ehi].
  unfold touches in T. unfold narrow. simpl fst. simpl snd.
  destruct (Req_dec (B2R d) 0) as [Zd|Nd].
  - (* Along the planes: the reciprocals are a float next to the greatest, and infinity. *)
    rewrite (reciprocals_of_zero d Fd Zd). destruct moved_infinity as [Fm Hm]. cbn [fst snd].
    rewrite Zd, Rmult_0_r, Rplus_0_r in T.
    set (near_inverse := Nat.iter steps Bpred infinity) in *.
    assert (T1 : at_most (times (minus lo o) near_inverse) (nearest t)).
    { apply times_at_most; try assumption. rewrite Elo. apply Rle_trans with 0; [|now apply RN_0_le].
      apply (behind emin prec); lra. }
    assert (T2 : times (minus hi o) infinity = B754_nan \/ times (minus hi o) infinity = infinity).
    { assert (0 <= B2R (minus hi o)) by (rewrite Ehi; apply RN_0_le; lra).
      unfold times. destruct (minus hi o) as [s|s| |s m e He]; try discriminate; [now left|right].
      destruct s; [|reflexivity]. exfalso. apply (Rlt_not_le _ _ (F2R_lt_0 radix2 (Float radix2 (Z.neg m) e) eq_refl)). exact H. }
    destruct T2 as [-> | ->].
    + (* The origin is on the upper plane: dropped. *)
      rewrite lesser_of_nan, greater_to_nan, lesser_of_nan. split; [|assumption]. now apply greater_at_most.
    + destruct T1 as [N1 V1]. split.
      * apply greater_at_most; [|assumption]. apply lesser_at_most; [reflexivity|assumption|]. right. now split.
      * apply lesser_at_least; [|assumption]. apply greater_at_least; [assumption|reflexivity|].
        right. split; [reflexivity|]. unfold nearest. apply Rmin_r.
  - destruct Hi as [Hi|Hi]; [contradiction|].
    destruct (reciprocals_value d Fd Nd Hi) as (n & f & Fn & Ff & Hd).
    assert (Sd : (0 < B2R d /\ reciprocals d = (n, f)) \/ (B2R d < 0 /\ reciprocals d = (Bopp f, Bopp n))) by tauto.
    assert (Hnf : 0 <= B2R n <= (1 - u) * (1 / Rabs (B2R d)) /\ (1 + u) * (1 / Rabs (B2R d)) <= B2R f) by tauto.
    clear Hd. destruct Hnf as [Hn' Hf'].
    assert (FR : forall x : float, F (B2R x)) by (intros; apply B2R_format).
    destruct Sd as [[Sd ->]|[Sd ->]]; cbn [fst snd].
    + rewrite Rabs_pos_eq in Hn', Hf' by lra.
      assert (A1 : at_most (times (minus lo o) n) (nearest t)).
      { apply times_at_most; try assumption. rewrite Elo. apply (near_is_not_after emin prec) with (d := B2R d); auto; lia || lra. }
      assert (A2 : at_least (times (minus hi o) f) (nearest t)).
      { apply times_at_least; try assumption. rewrite Ehi. apply (far_is_not_before emin prec) with (d := B2R d); auto; lia || lra. }
      destruct (A1) as [N1 _], A2 as [N2 V2]. split.
      * apply greater_at_most; [|assumption]. apply lesser_at_most; auto.
      * apply lesser_at_least; [|assumption]. apply greater_at_least; auto. right. now split.
    + rewrite Rabs_left in Hn', Hf' by lra.
      assert (A1 : at_most (times (minus hi o) (Bopp n)) (nearest t)).
      { apply times_at_most; [assumption|now rewrite is_finite_Bopp|assumption|]. rewrite Ehi, B2R_Bopp.
        fold (distance emin prec (B2R o) (B2R hi) (- B2R n)). rewrite mirrored.
        apply (near_is_not_after emin prec) with (d := - B2R d); auto using generic_format_opp; lia || lra. }
      assert (A2 : at_least (times (minus lo o) (Bopp f)) (nearest t)).
      { apply times_at_least; [assumption|now rewrite is_finite_Bopp|]. rewrite Elo, B2R_Bopp.
        fold (distance emin prec (B2R o) (B2R lo) (- B2R f)). rewrite mirrored.
        apply (far_is_not_before emin prec) with (d := - B2R d); auto using generic_format_opp; lia || lra. }
      destruct (A1) as [N1 _], A2 as [N2 V2]. split.
      * apply greater_at_most; [|assumption]. apply lesser_at_most; auto.
      * apply lesser_at_least; [|assumption]. apply greater_at_least; auto. left. now split.
Qed.

(** * The slab test *)

(** [BOX-2] for the code, all axes, both signs of a direction, zeros of both signs, subnormal and huge components: where the ray
    touches a box at t, exactly, near' <= RN(t) <= far', and neither is a NaN. *)
Theorem near_and_far_hold axes tmin tmax t : Forall usual axes -> Forall (touches t) axes -> 0 <= t ->
  at_most tmin (nearest t) -> at_least tmax (nearest t) ->
  at_most (fst (near_and_far axes tmin tmax)) (nearest t) /\ at_least (snd (near_and_far axes tmin tmax)) (nearest t).
Proof.
  intros U T Ht Hn Hf. unfold near_and_far. change tmin with (fst (tmin, tmax)) in Hn.
  change tmax with (snd (tmin, tmax)) in Hf. generalize dependent (tmin, tmax).
  induction axes as [|a axes IH]; intros ends Hn Hf; [now split|]. simpl.
  inversion_clear U. inversion_clear T. destruct (narrow_keeps ends a t); auto.
Qed.

(** The ends of a ray's interval, as [Ray] admits them: tmin finite, tmax perhaps infinite. *)
Definition within (t : R) (tmin tmax : float) : Prop :=
  is_finite tmin = true /\ 0 <= B2R tmin <= t /\ (tmax = infinity \/ (is_finite tmax = true /\ t <= B2R tmax)).

Lemma within_ends t tmin tmax : within t tmin tmax -> 0 <= t /\ at_most tmin (nearest t) /\ at_least tmax (nearest t).
Proof.
  intros (Fn & Hn & Hf). split; [lra|]. pose proof (finite_inside tmin).
  assert (mono : forall x y, x <= y -> RN x <= RN y) by (intros; apply round_le; typeclasses eauto || assumption).
  assert (same : forall x : float, RN (B2R x) = B2R x) by (intros; apply round_generic; [typeclasses eauto|apply B2R_format]).
  split.
  - split; [now destruct tmin|]. rewrite finite_value by assumption. apply Rmin_glb; [|lra]. rewrite <- same. apply mono. lra.
  - destruct Hf as [-> |[Ff Hf]]; split; [reflexivity|apply Rmin_r|now destruct tmax|].
    rewrite finite_value by assumption. eapply Rle_trans; [apply Rmin_l|]. rewrite <- same. now apply mono.
Qed.

(** No box that is touched is skipped: the comparison of [Intervals::of_lanes] says that it is hit, and it is not entered after any
    distance that is not below RN(t), such as that of the best hit so far. [BOX-2] *)
Theorem touched_is_hit x y z tmin tmax t :
  usual x -> usual y -> usual z -> touches t x -> touches t y -> touches t z -> within t tmin tmax ->
  let '(near, far) := near_and_far (x :: y :: z :: nil) tmin tmax in
  Bleb near far = true /\
  (forall best : float, is_nan best = false -> nearest t <= value best -> Bleb near best = true).
Proof.
  intros Ux Uy Uz Tx Ty Tz W. destruct (within_ends _ _ _ W) as (Ht & Hn & Hf).
  destruct (near_and_far_hold (x :: y :: z :: nil) tmin tmax t) as [[Nn Vn] [Nf Vf]]; auto.
  destruct (near_and_far _ _ _) as [near far]. simpl in *. split.
  - apply Bleb_value; try assumption. lra.
  - intros best Nb Hb. apply Bleb_value; try assumption. lra.
Qed.
End Slabs.

(** * The two formats *)

(** [Directed]: single precision, two steps. [BOX-2] *)
Theorem directed_touched_is_hit (x y z : axis 24 128) tmin tmax t :
  let usual := usual 24 128 eq_refl eq_refl in
  usual x -> usual y -> usual z -> touches 24 128 t x -> touches 24 128 t y -> touches 24 128 t z ->
  within 24 128 t tmin tmax ->
  let '(near, far) := near_and_far 24 128 eq_refl eq_refl 2 (x :: y :: z :: nil) tmin tmax in
  Bleb near far = true /\
  (forall best : binary_float 24 128, is_nan best = false -> nearest 24 128 t <= value 24 128 best -> Bleb near best = true).
Proof. apply touched_is_hit; [discriminate|now left]. Qed.

(** [Doubled], in double precision: three steps. [BOX-2, BOX-6] *)
Theorem wide_touched_is_hit (x y z : axis 53 1024) tmin tmax t :
  let usual := usual 53 1024 eq_refl eq_refl in
  usual x -> usual y -> usual z -> touches 53 1024 t x -> touches 53 1024 t y -> touches 53 1024 t z ->
  within 53 1024 t tmin tmax ->
  let '(near, far) := near_and_far 53 1024 eq_refl eq_refl 3 (x :: y :: z :: nil) tmin tmax in
  Bleb near far = true /\
  (forall best : binary_float 53 1024, is_nan best = false -> nearest 53 1024 t <= value 53 1024 best -> Bleb near best = true).
Proof. apply touched_is_hit; [discriminate|now right]. Qed.
