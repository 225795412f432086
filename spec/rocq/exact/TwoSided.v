(** [TwoSided] of src/geom/slabs/centred.rs, on IEEE 754 numbers of single precision: BOX-5. One reciprocal serves both planes of an
    axis; the distances at the end are moved apart. *)
Require Import Reals ZArith Lia Lra Psatz Bool List.
From Flocq Require Import Core Relative BinarySingleNaN.
Require Import StacklessExact.Rounding StacklessExact.Slabs.
Open Scope R_scope.

Local Instance prec_24 : Prec_gt_0 24 := eq_refl.
Local Instance emax_128 : Prec_lt_emax 24 128 := eq_refl.

(** * The code *)

Notation float := (binary_float 24 128).
Notation minus := (minus 24 128 prec_24 emax_128).
Notation times := (times 24 128 prec_24 emax_128).
Notation lesser := (lesser 24 128).
Notation greater := (greater 24 128).
Notation infinity := (infinity 24 128).
Notation value := (value 24 128).
Notation nearest := (nearest 24 128).
Notation at_most := (at_most 24 128).
Notation at_least := (at_least 24 128).
Notation touches := (touches 24 128).
Notation within := (within 24 128).
Notation fexp := (FLT_exp (-149) 24).
Notation RN := (round radix2 fexp ZnearestE).
Notation M := (bpow radix2 128).
Notation u := (/ 16777216).

(** [Centred::new], one component: the reciprocal, infinity where it is not finite, also of -0. *)
Definition inverse (d : float) : float := let i := Bdiv mode_NE (Bone : float) d in if is_finite i then i else infinity.

(** One turn of the loop of [near_and_far] in mod.rs, with one reciprocal. *)
Definition narrow_by (ends : float * float) (a : axis 24 128) : float * float :=
  let '(near, far) := ends in
  let '(o, d, lo, hi) := a in
  let t1 := times (minus lo o) (inverse d) in
  let t2 := times (minus hi o) (inverse d) in
  (greater (lesser t2 t1) near, lesser (greater t1 t2) far).

(** PADDING: 1 - 3u and 1 + 4u. *)
Definition down : float := binary_normalize 24 128 _ _ mode_NE (2 ^ 24 - 3) (-24) false.
Definition up : float := binary_normalize 24 128 _ _ mode_NE (2 ^ 24 + 4) (-24) false.

(** [Centred::pair] of [TwoSided]. *)
Definition two_sided (axes : list (axis 24 128)) (tmin tmax : float) : float * float :=
  let '(near, far) := fold_left narrow_by axes (tmin, tmax) in (times near down, times far up).

(** What BOX-5 asks of an axis: components that are 0, or normal and below 2, coordinates of at most 2^126, and planes through the
    origin or not too near to it. *)
Definition fair (a : axis 24 128) : Prop :=
  let '(o, d, lo, hi) := a in
  (is_finite d = true /\ (B2R d = 0 \/ bpow radix2 (-126) <= Rabs (B2R d) < 2)) /\
  (is_finite o = true /\ Rabs (B2R o) <= bpow radix2 (128 - 2)) /\
  (is_finite lo = true /\ Rabs (B2R lo) <= bpow radix2 (128 - 2) /\ (B2R lo = B2R o \/ bpow radix2 (-125) <= Rabs (B2R lo - B2R o))) /\
  (is_finite hi = true /\ Rabs (B2R hi) <= bpow radix2 (128 - 2) /\ (B2R hi = B2R o \/ bpow radix2 (-125) <= Rabs (B2R hi - B2R o))).

(** The greatest component is at least 1. *)
Definition dominant (a : axis 24 128) : Prop := let '(o, d, lo, hi) := a in 1 <= Rabs (B2R d).

Lemma prec_6 : (6 <= 24)%Z.
Proof. lia. Qed.
Notation minus_24 := (minus_value 24 128 prec_24 emax_128 2 prec_6 (or_introl eq_refl)).
Notation times_24 := (times_value 24 128 prec_24 emax_128 2 (or_introl eq_refl)).

(** * Three roundings *)

Notation v := (/ 16777217).

Lemma three a b c : Rabs a <= v -> Rabs b <= v -> Rabs c <= v ->
  (1 - v) * (1 - v) * (1 - v) <= (1 + a) * (1 + b) * (1 + c) <= (1 + v) * (1 + v) * (1 + v).
Proof.
  intros A B C. apply Rabs_le_inv in A, B, C.
  split; (apply Rmult_le_compat; [| |apply Rmult_le_compat|]); try lra; apply Rmult_le_pos; lra.
Qed.

Definition most : R := (1 + v) * (1 + v) * (1 + v).
Definition least : R := (1 - v) * (1 - v) * (1 - v).

Lemma ratio_24 : unit 24 / (1 + unit 24) = v.
Proof. change (unit 24) with u. field. Qed.

(** A number that is normal, or 0, is rounded by at most u/(1 + u) of itself. *)
Lemma normal_24 x : x = 0 \/ bpow radix2 (-126) <= Rabs x -> exists e, Rabs e <= v /\ RN x = x * (1 + e).
Proof.
  intros [-> |H].
  - exists 0. rewrite Rabs_R0, round_0 by typeclasses eauto. split; lra.
  - destruct (relative_error_N_FLX'_ex radix2 24 prec_24 (fun z => negb (Z.even z)) x) as (e & He & E).
    exists e. split; [|rewrite (round_FLT_FLX radix2 (-149)) by exact H; exact E].
    unfold u_ro in He. rewrite unit_half in He. rewrite ratio_24 in He. exact He.
Qed.

Lemma difference_24 b o : generic_format radix2 fexp b -> generic_format radix2 fexp o -> exists e, Rabs e <= v /\ RN (b - o) = (b - o) * (1 + e).
Proof. intros B O. destruct (difference (-149) 24 b o B O) as (e & He & E). rewrite ratio_24 in He. now exists e. Qed.

Lemma format_24 (x : float) : generic_format radix2 fexp (B2R x).
Proof. exact (generic_format_B2R 24 128 x). Qed.

Lemma power_24 e : (-149 <= e)%Z -> generic_format radix2 fexp (bpow radix2 e).
Proof. intros. apply generic_format_bpow. unfold FLT_exp. lia. Qed.

(** The reciprocal of a component that is not 0. *)
Lemma inverse_value d : is_finite d = true -> bpow radix2 (-126) <= Rabs (B2R d) < 2 ->
  is_finite (inverse d) = true /\ / 2 <= Rabs (B2R (inverse d)) /\ exists e, Rabs e <= v /\ B2R (inverse d) = / B2R d * (1 + e).
Proof.
  intros Fd [Hd1 Hd2]. assert (P : 0 < Rabs (B2R d)) by (eapply Rlt_le_trans; [apply bpow_gt_0|exact Hd1]).
  assert (N : B2R d <> 0) by (intros Z; rewrite Z, Rabs_R0 in P; lra).
  assert (A : Rabs (1 / B2R d) = / Rabs (B2R d)) by (unfold Rdiv; rewrite Rmult_1_l; apply Rabs_inv).
  assert (L : / 2 <= Rabs (1 / B2R d)) by (rewrite A; apply Rinv_le; lra).
  assert (H : Rabs (1 / B2R d) <= bpow radix2 126).
  { rewrite A. change 126%Z with (- (-126))%Z. rewrite bpow_opp. apply Rinv_le; [apply bpow_gt_0|exact Hd1]. }
  generalize (Bdiv_correct 24 128 _ _ mode_NE (Bone : float) d N). rewrite Bone_correct.
  change (round_mode mode_NE) with ZnearestE. change (SpecFloat.fexp 24 128) with fexp.
  assert (Top : Rabs (RN (1 / B2R d)) <= bpow radix2 126) by (apply abs_round_le_generic; try typeclasses eauto; [now apply power_24|exact H]).
  rewrite Rlt_bool_true by (eapply Rle_lt_trans; [exact Top|now apply bpow_lt]).
  intros (V & F & _). unfold inverse. rewrite F. replace (is_finite (Bone : float)) with true by reflexivity.
  rewrite F. split; [reflexivity|]. rewrite V. split.
  - change (/ 2) with (bpow radix2 (-1)). apply abs_round_ge_generic; try typeclasses eauto; [now apply power_24|exact L].
  - destruct (normal_24 (1 / B2R d)) as (e & He & E).
    + right. eapply Rle_trans; [|exact L]. change (/ 2) with (bpow radix2 (-1)). now apply bpow_le.
    + exists e. split; [exact He|]. rewrite E. unfold Rdiv. ring.
Qed.

(** The distance of one plane: three roundings, cut off at infinity. *)
Lemma plane_value b o d : is_finite b = true -> is_finite o = true -> is_finite d = true ->
  Rabs (B2R b) <= bpow radix2 (128 - 2) -> Rabs (B2R o) <= bpow radix2 (128 - 2) -> bpow radix2 (-126) <= Rabs (B2R d) < 2 ->
  B2R b = B2R o \/ bpow radix2 (-125) <= Rabs (B2R b - B2R o) ->
  is_nan (times (minus b o) (inverse d)) = false /\ exists m, least <= m <= most /\
  value (times (minus b o) (inverse d)) = Rmax (- M) (Rmin ((B2R b - B2R o) * / B2R d * m) M).
Proof.
  intros Fb Fo Fd Hb Ho Hd Far. destruct (inverse_value d Fd Hd) as (Fi & Li & e0 & H0 & Ei).
  destruct (minus_24 b o Fb Fo Hb Ho) as [Fx Ex].
  destruct (times_24 _ _ Fx Fi) as [N V].
  split; [exact N|]. destruct (difference_24 _ _ (format_24 b) (format_24 o)) as (e1 & H1 & E1).
  assert (Norm : B2R (minus b o) * B2R (inverse d) = 0 \/ bpow radix2 (-126) <= Rabs (B2R (minus b o) * B2R (inverse d))).
  { destruct Far as [Z|Far].
    - left. rewrite Ex. change (SpecFloat.emin 24 128) with (-149)%Z. rewrite Z, Rminus_diag_eq, round_0 by (reflexivity || typeclasses eauto). ring.
    - right. rewrite Rabs_mult. change (-126)%Z with (-125 + -1)%Z. rewrite bpow_plus. change (bpow radix2 (-1)) with (/ 2).
      apply Rmult_le_compat; [apply bpow_ge_0|lra| |exact Li]. rewrite Ex.
      apply abs_round_ge_generic; try typeclasses eauto; [now apply power_24|exact Far]. }
  destruct (normal_24 _ Norm) as (e2 & H2 & E2). exists ((1 + e1) * (1 + e0) * (1 + e2)). split; [now apply three|].
  rewrite V. change (SpecFloat.emin 24 128) with (-149)%Z. rewrite E2, Ex. change (SpecFloat.emin 24 128) with (-149)%Z. rewrite E1, Ei.
  do 2 f_equal. ring.
Qed.

Lemma factors : 0 < least <= 1 /\ 1 <= most <= 2 /\ (1 - 3 * u) * most <= 1 /\ 1 <= (1 + 4 * u) * least.
Proof. unfold least, most. lra. Qed.

(** * One axis *)

(** What is known before the last product. *)
Lemma narrow_by_keeps ends a t : fair a -> touches t a -> 0 <= t -> most * t < M ->
  at_most (fst ends) (most * t) -> at_least (snd ends) (least * t) ->
  at_most (fst (narrow_by ends a)) (most * t) /\ at_least (snd (narrow_by ends a)) (least * t).
Proof.
  destruct ends as [near far], a as [[[o d] lo] hi]. simpl fst. simpl snd. destruct factors as (L & G & _ & _).
  intros ((Fd & Hd) & (Fo & Ho) & (Fl & Hl & Nl) & (Fh & Hh & Nh)) T Ht Top Hn Hf. unfold Slabs.touches in T. unfold narrow_by. simpl fst. simpl snd.
  assert (P1 : 0 <= most * t) by (apply Rmult_le_pos; lra). assert (P2 : 0 <= least * t) by (apply Rmult_le_pos; lra).
  assert (MP : 0 < M) by apply bpow_gt_0.
  destruct Hd as [Zd|Hd].
  - (* Along the planes. *)
    rewrite Zd, Rmult_0_r, Rplus_0_r in T.
    assert (Ei : inverse d = infinity).
    { unfold inverse. destruct d as [s|s| |s m e He]; try discriminate.
      - now destruct s.
      - exfalso. simpl in Zd. apply eq_0_F2R in Zd. destruct s; discriminate. }
    rewrite Ei. destruct (minus_24 lo o Fl Fo Hl Ho) as [F1 E1].
    destruct (minus_24 hi o Fh Fo Hh Ho) as [F2 E2].
    assert (S1 : B2R (minus lo o) <= 0) by (rewrite E1; apply RN_le_0; [exact prec_24|lra]).
    assert (S2 : 0 <= B2R (minus hi o)) by (rewrite E2; apply RN_0_le; [exact prec_24|lra]).
    assert (T1 : times (minus lo o) infinity = B754_nan \/ times (minus lo o) infinity = B754_infinity true).
    { unfold Slabs.times. destruct (minus lo o) as [s|s| |s m e He]; try discriminate; [now left|right].
      destruct s; [reflexivity|]. exfalso. apply (Rlt_not_le _ _ (F2R_gt_0 radix2 (Float radix2 (Zpos m) e) eq_refl)). exact S1. }
    assert (T2 : times (minus hi o) infinity = B754_nan \/ times (minus hi o) infinity = infinity).
    { unfold Slabs.times. destruct (minus hi o) as [s|s| |s m e He]; try discriminate; [now left|right].
      destruct s; [|reflexivity]. exfalso. apply (Rlt_not_le _ _ (F2R_lt_0 radix2 (Float radix2 (Zneg m) e) eq_refl)). exact S2. }
    assert (Low : at_most (B754_infinity true) (most * t)) by (split; [reflexivity|change (- M <= most * t); lra]).
    assert (LM : least * t <= most * t) by (apply Rmult_le_compat_r; lra).
    assert (High : at_least infinity (least * t)) by (split; [reflexivity|change (least * t <= M); lra]).
    assert (Ng : greater B754_nan near = near) by (unfold Slabs.greater; now rewrite Bltb_nan_r).
    assert (Nl' : lesser B754_nan far = far) by apply lesser_of_nan.
    destruct T1 as [-> | ->], T2 as [-> | ->].
    + replace (lesser B754_nan B754_nan) with (B754_nan : float) by reflexivity.
      replace (greater B754_nan B754_nan) with (B754_nan : float) by reflexivity. rewrite Ng, Nl'. now split.
    + replace (lesser infinity B754_nan) with (B754_nan : float) by reflexivity.
      replace (greater B754_nan infinity) with infinity by reflexivity. rewrite Ng. split; [exact Hn|now apply lesser_at_least].
    + replace (lesser B754_nan (B754_infinity true)) with (B754_infinity true : float) by reflexivity.
      replace (greater (B754_infinity true) B754_nan) with (B754_nan : float) by reflexivity. rewrite Nl'.
      split; [now apply greater_at_most|exact Hf].
    + replace (lesser infinity (B754_infinity true)) with (B754_infinity true : float) by reflexivity.
      replace (greater (B754_infinity true) infinity) with infinity by reflexivity.
      split; [now apply greater_at_most|now apply lesser_at_least].
  - destruct (plane_value lo o d Fl Fo Fd Hl Ho Hd Nl) as (N1 & m1 & M1 & V1).
    destruct (plane_value hi o d Fh Fo Fd Hh Ho Hd Nh) as (N2 & m2 & M2 & V2).
    set (t1 := times (minus lo o) (inverse d)) in *. set (t2 := times (minus hi o) (inverse d)) in *.
    set (D := B2R d) in *. assert (Nd : D <> 0).
    { intros Z. rewrite Z, Rabs_R0 in Hd. pose proof (bpow_gt_0 radix2 (-126)). lra. }
    (* A plane that is not after t, and one that is not before. *)
    assert (Before : forall x q m, q <= t -> least <= m <= most -> is_nan x = false -> value x = Rmax (- M) (Rmin (q * m) M) -> at_most x (most * t)).
    { intros x q m Hq Hm N V. split; [exact N|]. rewrite V. apply Rmax_lub; [lra|]. eapply Rle_trans; [apply Rmin_l|].
      rewrite (Rmult_comm most). destruct (Rle_or_lt 0 q) as [Q|Q].
      - apply Rmult_le_compat; lra.
      - assert (0 <= - q * m) by (apply Rmult_le_pos; lra). lra. }
    assert (After : forall x q m, t <= q -> least <= m <= most -> is_nan x = false -> value x = Rmax (- M) (Rmin (q * m) M) -> at_least x (least * t)).
    { intros x q m Hq Hm N V. split; [exact N|]. rewrite V. eapply Rle_trans; [|apply Rmax_r]. rewrite (Rmult_comm least).
      apply Rmin_glb; [apply Rmult_le_compat; lra|]. apply Rle_trans with (most * t); [|lra]. rewrite (Rmult_comm most).
      apply Rmult_le_compat_l; lra. }
    assert (Ht' : t = t * D * / D) by (field; exact Nd).
    assert (Near : at_most t1 (most * t) /\ at_least t2 (least * t) \/ at_most t2 (most * t) /\ at_least t1 (least * t)).
    { destruct (Rtotal_order D 0) as [S|[S|S]]; [right|contradiction|left]; split.
      - apply (Before _ _ _) with (3 := N2) (4 := V2); [|exact M2]. rewrite Ht' at 1.
        pose proof (Rinv_lt_0_compat D S). pose proof (Rmult_le_compat_neg_l (/ D) (t * D) (B2R hi - B2R o) ltac:(lra) ltac:(lra)). lra.
      - apply (After _ _ _) with (3 := N1) (4 := V1); [|exact M1]. rewrite Ht' at 1.
        pose proof (Rinv_lt_0_compat D S). pose proof (Rmult_le_compat_neg_l (/ D) (B2R lo - B2R o) (t * D) ltac:(lra) ltac:(lra)). lra.
      - apply (Before _ _ _) with (3 := N1) (4 := V1); [|exact M1]. rewrite Ht' at 1.
        pose proof (Rinv_0_lt_compat D S). pose proof (Rmult_le_compat_l (/ D) (B2R lo - B2R o) (t * D) ltac:(lra) ltac:(lra)). lra.
      - apply (After _ _ _) with (3 := N2) (4 := V2); [|exact M2]. rewrite Ht' at 1.
        pose proof (Rinv_0_lt_compat D S). pose proof (Rmult_le_compat_l (/ D) (t * D) (B2R hi - B2R o) ltac:(lra) ltac:(lra)). lra. }
    split.
    + apply greater_at_most; [|exact Hn]. apply lesser_at_most; auto. tauto.
    + apply lesser_at_least; [|exact Hf]. apply greater_at_least; auto. tauto.
Qed.

(** * The slab test *)

Lemma padding : (is_finite down = true /\ B2R down = 1 - 3 * u) /\ (is_finite up = true /\ B2R up = 1 + 4 * u).
Proof.
  assert (S : forall x : float, SF2R radix2 (B2SF x) = B2R x) by (intros; apply SF2R_B2SF).
  split; (split; [vm_compute; reflexivity|]); rewrite <- S; match goal with |- SF2R _ ?x = _ =>
    let y := eval vm_compute in x in replace x with y by (vm_compute; reflexivity) end; unfold SF2R, F2R; simpl; lra.
Qed.

(** No distance at which the ray touches is beyond 2^127. *)
Lemma not_far a t : fair a -> dominant a -> touches t a -> 0 <= t -> t <= bpow radix2 127.
Proof.
  destruct a as [[[o d] lo] hi]. intros (_ & (_ & Ho) & (_ & Hl & _) & (_ & Hh & _)) D T Ht. unfold dominant in D. unfold Slabs.touches in T.
  change 127%Z with (126 + 1)%Z. rewrite bpow_plus. change (bpow radix2 1) with 2. change (128 - 2)%Z with 126%Z in *. set (b := bpow radix2 126) in *.
  apply Rle_trans with (t * Rabs (B2R d)); [rewrite <- (Rmult_1_r t) at 1; now apply Rmult_le_compat_l|].
  rewrite <- (Rabs_pos_eq t) at 1 by exact Ht. rewrite <- Rabs_mult. set (x := t * B2R d) in *. split_Rabs; lra.
Qed.

(** [BOX-5] as it is coded: where the ray touches a box at t, exactly, near' <= RN(t) <= far', and neither is a NaN. *)
Theorem two_sided_holds axes tmin tmax t : Forall fair axes -> Exists dominant axes -> Forall (touches t) axes -> within t tmin tmax ->
  at_most (fst (two_sided axes tmin tmax)) (nearest t) /\ at_least (snd (two_sided axes tmin tmax)) (nearest t).
Proof.
  intros U D T W. destruct factors as (L & G & KD & KU). assert (MP : 0 < M) by apply bpow_gt_0.
  destruct W as (Fn & Hn & Hf). assert (Ht : 0 <= t) by lra.
  assert (Far : t <= bpow radix2 127).
  { apply Exists_exists in D. destruct D as (a & In & Da). rewrite Forall_forall in U, T. exact (not_far a t (U a In) Da (T a In) Ht). }
  assert (MM : M = 2 * bpow radix2 127) by (change 128%Z with (127 + 1)%Z; rewrite bpow_plus; change (bpow radix2 1) with 2; ring).
  assert (MS : most < 2) by (unfold most; lra).
  assert (Top : most * t < M).
  { rewrite MM. pose proof (bpow_gt_0 radix2 127). apply Rle_lt_trans with (most * bpow radix2 127); [apply Rmult_le_compat_l; lra|].
    apply Rmult_lt_compat_r; lra. }
  assert (Less : least * t <= t) by (rewrite <- (Rmult_1_l t) at 2; apply Rmult_le_compat_r; lra).
  assert (More : t <= most * t) by (rewrite <- (Rmult_1_l t) at 1; apply Rmult_le_compat_r; lra).
  assert (I1 : at_most tmin (most * t)).
  { split; [now destruct tmin|]. rewrite finite_value by exact Fn. lra. }
  assert (I2 : at_least tmax (least * t)).
  { destruct Hf as [-> |[Ff Hf]]; split; [reflexivity|change (least * t <= M); lra|now destruct tmax|]. rewrite finite_value by exact Ff. lra. }
  assert (K : at_most (fst (fold_left narrow_by axes (tmin, tmax))) (most * t) /\ at_least (snd (fold_left narrow_by axes (tmin, tmax))) (least * t)).
  { clear Fn Hn Hf D. change tmin with (fst (tmin, tmax)) in I1. change tmax with (snd (tmin, tmax)) in I2.
    generalize dependent (tmin, tmax). induction axes as [|a axes IH]; intros ends I1 I2; [now split|]. simpl.
    inversion_clear U. inversion_clear T. destruct (narrow_by_keeps ends a t); auto. }
  unfold two_sided. destruct (fold_left narrow_by axes (tmin, tmax)) as [near far]. simpl fst in *. simpl snd in *.
  destruct K as [[N1 V1] [N2 V2]]. destruct padding as [[Fd Vd] [Fu Vu]].
  assert (mono : forall x y, x <= y -> RN x <= RN y) by (intros; apply round_le; typeclasses eauto || assumption).
  assert (NP : 0 <= nearest t) by now apply nearest_pos.
  split.
  - destruct (is_finite near) eqn:F.
    + destruct (times_24 near down F Fd) as [N V]. split; [exact N|]. rewrite V, Vd.
      rewrite finite_value in V1 by exact F. apply Rmax_lub; [lra|]. unfold Slabs.nearest. apply Rle_min_compat_r. apply mono.
      destruct (Rle_or_lt 0 (B2R near)) as [P|P]; [|nra].
      apply Rle_trans with (most * t * (1 - 3 * u)); [apply Rmult_le_compat_r; lra|].
      replace (most * t * (1 - 3 * u)) with ((1 - 3 * u) * most * t) by ring. rewrite <- (Rmult_1_l t) at 2. apply Rmult_le_compat_r; lra.
    + destruct near as [|[]| |]; try discriminate.
      * replace (times (B754_infinity true) down) with (B754_infinity true : float) by (vm_compute; reflexivity). split; [reflexivity|change (- M <= nearest t); lra].
      * exfalso. change (M <= most * t) in V1. lra.
  - destruct (is_finite far) eqn:F.
    + destruct (times_24 far up F Fu) as [N V]. split; [exact N|]. rewrite V, Vu.
      rewrite finite_value in V2 by exact F. eapply Rle_trans; [|apply Rmax_r]. unfold Slabs.nearest. apply Rle_min_compat_r. apply mono.
      apply Rle_trans with (least * t * (1 + 4 * u)); [|apply Rmult_le_compat_r; lra].
      replace (least * t * (1 + 4 * u)) with ((1 + 4 * u) * least * t) by ring. rewrite <- (Rmult_1_l t) at 1. apply Rmult_le_compat_r; lra.
    + destruct far as [|[]| |]; try discriminate.
      * exfalso. change (least * t <= - M) in V2. assert (0 <= least * t) by (apply Rmult_le_pos; lra). lra.
      * replace (times (B754_infinity false) up) with infinity by (vm_compute; reflexivity). split; [reflexivity|]. apply Rmin_r.
Qed.

(** So no box that is touched is skipped. [BOX-5] *)
Theorem two_sided_touched_is_hit x y z tmin tmax t : fair x -> fair y -> fair z -> dominant x \/ dominant y \/ dominant z ->
  touches t x -> touches t y -> touches t z -> within t tmin tmax ->
  let '(near, far) := two_sided (x :: y :: z :: nil) tmin tmax in
  Bleb near far = true /\ (forall best : float, is_nan best = false -> nearest t <= value best -> Bleb near best = true).
Proof.
  intros Ux Uy Uz D Tx Ty Tz W. destruct (two_sided_holds (x :: y :: z :: nil) tmin tmax t) as [[Nn Vn] [Nf Vf]]; auto.
  - destruct D as [D|[D|D]]; auto.
  - destruct (two_sided _ _ _) as [near far]. simpl in *. split.
    + apply Bleb_value; try assumption. lra.
    + intros best Nb Hb. apply Bleb_value; try assumption. lra.
Qed.
