(** LANES-2: what the ranks of boxes are made of; and BOX-3 and BOX-7 for the test of lanes. *)
Require Import Reals ZArith Lia Lra Psatz Bool List.
From Flocq Require Import Core BinarySingleNaN.
Require Import StacklessExact.Rounding StacklessExact.Planes StacklessExact.Slabs StacklessExact.LaneBoxes.
Require StacklessExact.Arithmetic.
Open Scope R_scope.

Local Instance prec_24 : Prec_gt_0 24 := eq_refl.

(** * Bits that are cleared *)

Section Ranks.
(** Two lanes, four or eight: the number of bits. *)
Variable B : Z.
Hypothesis B_range : (0 <= B <= 3)%Z.
Notation coarse := (FLT_exp (B - 149) (24 - B)).
Notation down := (round radix2 coarse Zfloor).

Local Instance coarse_prec : Prec_gt_0 (24 - B).
Proof. unfold Prec_gt_0. lia. Qed.

(** The lowest bits of a float that is not negative are those of its significand; without them, and without the sign. *)
Definition cleared (x : float) : float := Arithmetic.cleared_float 24 128 eq_refl eq_refl B x.

(** It is rounding down to so many bits less. [LANES-2] *)
Theorem cleared_value x : is_finite x = true -> 0 <= B2R x -> is_finite (cleared x) = true /\ B2R (cleared x) = down (B2R x).
Proof.
  intros Fx Hx. destruct x as [s|s| |s m e H]; try discriminate.
  - split; [reflexivity|]. cbn [cleared Arithmetic.cleared_float B2R]. rewrite round_0 by typeclasses eauto. reflexivity.
  - destruct s; [exfalso; revert Hx; apply Rlt_not_le, (F2R_lt_0 radix2 (Float radix2 (Z.neg m) e)); reflexivity|].
    pose proof (canonical_bounded 24 128 false m e H) as Cn. pose proof (bounded_lt_emax 24 128 m e H) as Lt.
    cbn [SpecFloat.cond_Zopp] in Cn. cbn [B2R SpecFloat.cond_Zopp] in *. set (X := F2R (Float radix2 (Z.pos m) e)) in *.
    assert (Xp : 0 < X) by (apply F2R_gt_0; reflexivity).
    assert (Ee : e = FLT_exp (-149) 24 (mag radix2 X)) by exact Cn.
    assert (E : down X = F2R (Float radix2 (Z.shiftl (Z.shiftr (Z.pos m) B) B) e)).
    { unfold round, scaled_mantissa, cexp. replace (coarse (mag radix2 X)) with (e + B)%Z by (rewrite Ee; unfold FLT_exp; lia).
      assert (EX : X * bpow radix2 (- (e + B)) = IZR (Z.pos m) / IZR (2 ^ B)).
      { unfold X, F2R. cbn [Fnum Fexp]. rewrite Rmult_assoc, <- bpow_plus. replace (e + - (e + B))%Z with (- B)%Z by ring.
        rewrite bpow_opp. change (2 ^ B)%Z with (radix2 ^ B)%Z. now rewrite (IZR_Zpower radix2 B) by lia. }
      rewrite EX, Zfloor_div by (apply Z.pow_nonzero; lia). rewrite Z.shiftl_mul_pow2, Z.shiftr_div_pow2 by lia. unfold F2R. cbn [Fnum Fexp].
      rewrite mult_IZR. change (2 ^ B)%Z with (radix2 ^ B)%Z at 3. rewrite (IZR_Zpower radix2 B) by lia. rewrite bpow_plus. ring. }
    assert (L : 0 <= down X <= X).
    { split; [rewrite <- (round_0 radix2 coarse Zfloor); apply round_le; try typeclasses eauto; lra|]. apply (round_DN_pt radix2 coarse). }
    cbn [cleared Arithmetic.cleared_float]. pose proof (binary_normalize_correct 24 128 eq_refl eq_refl mode_NE (Z.shiftl (Z.shiftr (Z.pos m) B) B) e false) as K. cbv zeta in K.
    rewrite <- E in K. rewrite (round_generic radix2 _ _ (down X)) in K.
    + rewrite Rlt_bool_true in K; [|rewrite Rabs_pos_eq by lra; eapply Rle_lt_trans; [apply L|exact Lt]]. destruct K as (K1 & K2 & _). split; assumption.
    + rewrite E. apply generic_format_FLT. exists (Float radix2 (Z.shiftl (Z.shiftr (Z.pos m) B) B) e); cbn [Fnum Fexp]; [reflexivity| |].
      * assert (D : (Z.pos m < 2 ^ 24)%Z).
        { pose proof H as K'. unfold SpecFloat.bounded in K'. apply andb_prop in K' as [K' _]. unfold SpecFloat.canonical_mantissa in K'. apply Zeq_bool_eq in K'.
          rewrite Digits.Zpos_digits2_pos in K'. apply (Digits.Zpower_gt_Zdigits radix2 24 (Z.pos m)). unfold SpecFloat.fexp in K'. lia. }
        rewrite Z.shiftl_mul_pow2, Z.shiftr_div_pow2 by lia. assert (0 < 2 ^ B)%Z by (apply Z.pow_pos_nonneg; lia).
        pose proof (Z.mul_div_le (Z.pos m) (2 ^ B) ltac:(lia)). pose proof (Z.div_pos (Z.pos m) (2 ^ B) ltac:(lia) ltac:(lia)).
        change (Z.pow radix2 24) with (2 ^ 24)%Z. rewrite Z.abs_eq by (apply Z.mul_nonneg_nonneg; lia). lia.
      * rewrite Ee. change (SpecFloat.emin 24 128) with (-149)%Z. unfold FLT_exp. lia.
Qed.

Notation greatest_float := (@Bmax_float 24 128 eq_refl eq_refl).

(** near'': of near' and the greatest float the lesser, without these bits. *)
Definition rank_of (near : float) : float := cleared (lesser near greatest_float).

Lemma greatest_value : is_finite (greatest_float : float) = true /\ B2R (greatest_float : float) = M * (1 - u).
Proof.
  assert (E : B2SF (greatest_float : float) = SpecFloat.S754_finite false 16777215 104) by (vm_compute; reflexivity). split.
  - rewrite <- is_finite_SF_B2SF, E. reflexivity.
  - rewrite <- SF2R_B2SF, E. unfold SF2R, F2R. cbn [Fnum Fexp SpecFloat.cond_Zopp]. simpl bpow. lra.
Qed.

Lemma number_below x : is_nan x = false -> 0 <= value x ->
  is_finite (lesser x greatest_float) = true /\ B2R (lesser x greatest_float) = Rmin (value x) (M * (1 - u)).
Proof.
  intros Nx Hx. destruct greatest_value as [Fg Vg]. assert (Ng : is_nan greatest_float = false) by (now destruct greatest_float).
  unfold Slabs.lesser. rewrite (Bltb_value 24 128 x _ Nx Ng), (finite_value 24 128 greatest_float Fg), Vg.
  destruct (Rlt_bool_spec (value x) (M * (1 - u))) as [L|L]; [|rewrite Rmin_right by exact L; auto].
  assert (Fx : is_finite x = true).
  { destruct x as [|[]| |]; try discriminate; auto; unfold Slabs.value in *; pose proof Mp; assert (0 < u) by apply bpow_gt_0; nra. }
  rewrite Rmin_left by lra. rewrite (finite_value 24 128 x Fx). auto.
Qed.

(** near'' is near', at most the greatest float, rounded down. [LANES-2] *)
Theorem rank_value x : is_nan x = false -> 0 <= value x ->
  is_finite (rank_of x) = true /\ value (rank_of x) = down (Rmin (value x) (M * (1 - u))).
Proof.
  intros Nx Hx. destruct (number_below x Nx Hx) as [F1 V1]. assert (0 < u <= / 2) by (split; [apply bpow_gt_0|apply (bpow_le radix2 (-24) (-1)); lia]). pose proof Mp.
  assert (P : 0 <= B2R (lesser x greatest_float)) by (rewrite V1; apply Rmin_glb; [exact Hx|apply Rmult_le_pos; lra]).
  destruct (cleared_value _ F1 P) as [F2 V2]. unfold rank_of. split; [exact F2|]. now rewrite (finite_value 24 128 _ F2), V2, V1.
Qed.

(** So it is finite, not negative and not above near'; and it keeps the order. [LANES-2] *)
Theorem rank_rounds_down : rounds_down rank_of.
Proof.
  intros x Nx Hx. destruct (rank_value x Nx Hx) as [Fr Vr]. split; [exact Fr|]. rewrite Vr. split.
  - rewrite <- (round_0 radix2 coarse Zfloor). apply round_le; [typeclasses eauto..|]. apply Rmin_glb; [exact Hx|].
    assert (0 < u <= / 2) by (split; [apply bpow_gt_0|apply (bpow_le radix2 (-24) (-1)); lia]). pose proof Mp. apply Rmult_le_pos; lra.
  - apply Rle_trans with (Rmin (value x) (M * (1 - u))); [apply (round_DN_pt radix2 coarse (Rmin (value x) (M * (1 - u))))|apply Rmin_l].
Qed.
Theorem rank_keeps_order x y : is_nan x = false -> is_nan y = false -> 0 <= value x <= value y -> value (rank_of x) <= value (rank_of y).
Proof.
  intros Nx Ny [Hx Hy]. destruct (rank_value x Nx Hx) as [_ ->]. destruct (rank_value y Ny ltac:(lra)) as [_ ->].
  apply round_le; [typeclasses eauto..|]. now apply Rle_min_compat_r.
Qed.

(** No box is left out that the ray touches: the test as it is. [LANES-1, LANES-2] *)
Theorem touched_is_entered x y z tmin last t : proper x -> proper y -> proper z ->
  touches 24 128 t x -> touches 24 128 t y -> touches 24 128 t z ->
  is_finite tmin = true -> 0 <= B2R tmin <= t -> is_nan last = false -> nearest t <= value last ->
  lane_met rank_of x y z tmin last = true.
Proof. apply lane_touched_is_met, rank_rounds_down. Qed.

(** * Nested boxes *)

(** Of a far plane: a NaN is dropped, so it is like infinity. *)
Definition effect (x : float) : R := if is_nan x then M else value x.

Lemma value_top (x : float) : value x <= M.
Proof. apply (value_inside 24 128 x). Qed.

Lemma lesser_effect a b : is_nan b = false -> is_nan (lesser a b) = false /\ value (lesser a b) = Rmin (effect a) (value b).
Proof.
  intros Nb. unfold effect. destruct (is_nan a) eqn:Na.
  - destruct a; try discriminate. rewrite lesser_of_nan. split; [exact Nb|]. rewrite Rmin_right; [reflexivity|apply value_top].
  - unfold Slabs.lesser. rewrite Bltb_value by assumption. destruct (Rlt_bool_spec (value a) (value b)); split; try assumption;
      [rewrite Rmin_left|rewrite Rmin_right]; lra.
Qed.

Lemma greater_value a b : is_nan a = false -> is_nan b = false -> is_nan (greater a b) = false /\ value (greater a b) = Rmax (value a) (value b).
Proof.
  intros Na Nb. unfold Slabs.greater. rewrite Bltb_value by assumption. destruct (Rlt_bool_spec (value b) (value a)); split; try assumption;
    [rewrite Rmax_left|rewrite Rmax_right]; lra.
Qed.

(** One slab in another, for one ray. *)
Definition inside (a b : axis) : Prop :=
  let '(o, d, lo, hi) := a in let '(o', d', lo', hi') := b in o = o' /\ d = d' /\ B2R lo' <= B2R lo /\ B2R hi <= B2R hi'.

Lemma product_mono x x' k : is_finite x = true -> is_finite x' = true -> is_finite k = true -> B2R x * B2R k <= B2R x' * B2R k ->
  is_nan (times x k) = false /\ is_nan (times x' k) = false /\ value (times x k) <= value (times x' k).
Proof.
  intros X X' K H. destruct (times_value 24 128 eq_refl eq_refl 2 (or_introl eq_refl) x k X K) as [N1 V1].
  destruct (times_value 24 128 eq_refl eq_refl 2 (or_introl eq_refl) x' k X' K) as [N2 V2]. split; [exact N1|]. split; [exact N2|].
  change (value (times x k) <= value (times x' k)). rewrite V1, V2. apply Rle_max_compat_l, Rle_min_compat_r. apply round_le; [typeclasses eauto..|exact H].
Qed.

(** The near distance of the outer one is not greater, the far one not less. [BOX-3] *)
Theorem axis_nested a b : proper a -> proper b -> inside a b ->
  (is_nan (near_of a) = false /\ is_nan (near_of b) = false /\ value (near_of b) <= value (near_of a)) /\ effect (far_of a) <= effect (far_of b).
Proof.
  destruct a as [[[o d] lo] hi], b as [[[o' d'] lo'] hi']. intros (Fd & Ho & Hl & Hh) (_ & _ & Hl' & Hh') (<- & <- & Il & Ih).
  destruct (difference_value lo o Hl Ho) as [Fx Ex]. destruct (difference_value hi o Hh Ho) as [Fy Ey].
  destruct (difference_value lo' o Hl' Ho) as [Fx' Ex']. destruct (difference_value hi' o Hh' Ho) as [Fy' Ey'].
  assert (Lx : B2R (minus lo' o) <= B2R (minus lo o)) by (rewrite Ex, Ex'; apply round_le; [typeclasses eauto..|lra]).
  assert (Ly : B2R (minus hi o) <= B2R (minus hi' o)) by (rewrite Ey, Ey'; apply round_le; [typeclasses eauto..|lra]).
  destruct (inverses d Fd) as (n & f & Fn & Pn & Hf & Sd & _ & _). unfold near_of, far_of. pose proof Mp as MP.
  assert (Swap : forall P Q R, P /\ Q /\ R -> Q /\ P /\ R) by tauto.
  assert (Vo : value (Bopp infinity) = - M) by reflexivity. assert (Vi : value infinity = M) by reflexivity.
  assert (Ni : is_nan (Bopp infinity) = false /\ is_nan infinity = false) by (split; reflexivity). destruct Ni as [Ni Ni'].
  destruct Sd as [(_ & -> & -> & ->)|(_ & -> & -> & ->)]; cbn iota; split.
  - apply Swap, product_mono; try assumption. apply Rmult_le_compat_r; lra.
  - unfold effect. destruct Hf as [-> |[Ff Pf]].
    + destruct (times_infinity _ Fy) as [(A & -> & _)|[(A & -> & _)|(A & -> & _)]], (times_infinity _ Fy') as [(A' & -> & _)|[(A' & -> & _)|(A' & -> & _)]];
        cbn [is_nan]; rewrite ?Ni, ?Ni', ?Vo, ?Vi; lra.
    + destruct (product_mono (minus hi o) (minus hi' o) f Fy Fy' Ff) as (-> & -> & H); [apply Rmult_le_compat_r; lra|exact H].
  - apply Swap, product_mono; try assumption; [now rewrite is_finite_Bopp|]. rewrite B2R_Bopp.
    assert (B2R (minus hi o) * B2R n <= B2R (minus hi' o) * B2R n) by (apply Rmult_le_compat_r; lra). lra.
  - unfold effect. destruct Hf as [-> |[Ff Pf]].
    + destruct (times_infinity _ Fx) as [(A & _ & ->)|[(A & _ & ->)|(A & _ & ->)]], (times_infinity _ Fx') as [(A' & _ & ->)|[(A' & _ & ->)|(A' & _ & ->)]];
        cbn [is_nan]; rewrite ?Ni, ?Ni', ?Vo, ?Vi; lra.
    + destruct (product_mono (minus lo o) (minus lo' o) (Bopp f) Fx Fx') as (-> & -> & H); [now rewrite is_finite_Bopp| |exact H]. rewrite B2R_Bopp.
      assert (B2R (minus lo' o) * B2R f <= B2R (minus lo o) * B2R f) by (apply Rmult_le_compat_r; lra). lra.
Qed.

Lemma Max a a' b b' : a <= a' -> b <= b' -> Rmax a b <= Rmax a' b'.
Proof. intros. apply Rmax_lub; [eapply Rle_trans; [|apply Rmax_l]|eapply Rle_trans; [|apply Rmax_r]]; assumption. Qed.
Lemma Min a a' b b' : a <= a' -> b <= b' -> Rmin a b <= Rmin a' b'.
Proof. intros. apply Rmin_glb; [eapply Rle_trans; [apply Rmin_l|]|eapply Rle_trans; [apply Rmin_r|]]; assumption. Qed.

Lemma finite_number (x : float) : is_finite x = true -> is_nan x = false.
Proof. now destruct x. Qed.

(** Of three axes: near' of the outer box is not greater, far'' not less, and the ranks are in that order; so the outer box is met if the
    inner one is. [BOX-3, LANES-1] *)
Theorem boxes_nested x y z x' y' z' tmin last : proper x -> proper y -> proper z -> proper x' -> proper y' -> proper z' ->
  inside x x' -> inside y y' -> inside z z' -> is_finite tmin = true -> 0 <= B2R tmin -> is_nan last = false ->
  value (enters x' y' z' tmin) <= value (enters x y z tmin) /\ value (leaves x y z last) <= value (leaves x' y' z' last) /\
  value (rank_of (enters x' y' z' tmin)) <= value (rank_of (enters x y z tmin)) /\
  (lane_met rank_of x y z tmin last = true -> lane_met rank_of x' y' z' tmin last = true).
Proof.
  intros Px Py Pz Px' Py' Pz' Ix Iy Iz Fm Hm Nl.
  destruct (axis_nested x x' Px Px' Ix) as [(Nx & Nx' & Lx) Ex]. destruct (axis_nested y y' Py Py' Iy) as [(Ny & Ny' & Ly) Ey].
  destruct (axis_nested z z' Pz Pz' Iz) as [(Nz & Nz' & Lz) Ez]. assert (Nm : is_nan tmin = false) by (now destruct tmin).
  assert (Hm' : 0 <= value tmin) by (now rewrite finite_value).
  assert (En : forall a b c, is_nan (near_of a) = false -> is_nan (near_of b) = false -> is_nan (near_of c) = false ->
    is_nan (enters a b c tmin) = false /\ value (enters a b c tmin) = Rmax (Rmax (value (near_of a)) (value (near_of b))) (Rmax (value (near_of c)) (value tmin))).
  { intros a b c A Bn Cn. unfold enters. destruct (greater_value _ _ A Bn) as [N1 <-]. destruct (greater_value _ _ Cn Nm) as [N2 <-]. now apply greater_value. }
  assert (Lv : forall a b c, is_nan (leaves a b c last) = false /\
    value (leaves a b c last) = Rmin (effect (far_of a)) (Rmin (effect (far_of b)) (Rmin (effect (far_of c)) (value last)))).
  { intros a b c. unfold leaves. destruct (lesser_effect (far_of c) last Nl) as [N1 <-]. destruct (lesser_effect (far_of b) _ N1) as [N2 <-]. now apply lesser_effect. }
  destruct (En x y z Nx Ny Nz) as [N1 V1]. destruct (En x' y' z' Nx' Ny' Nz') as [N2 V2]. destruct (Lv x y z) as [N3 V3]. destruct (Lv x' y' z') as [N4 V4].
  assert (A : value (enters x' y' z' tmin) <= value (enters x y z tmin)) by (rewrite V1, V2; repeat apply Max; auto using Rle_refl).
  assert (Bv : value (leaves x y z last) <= value (leaves x' y' z' last)) by (rewrite V3, V4; repeat apply Min; auto using Rle_refl).
  assert (P : 0 <= value (enters x' y' z' tmin)) by (rewrite V2; eapply Rle_trans; [exact Hm'|eapply Rle_trans; [apply Rmax_r|apply Rmax_r]]).
  assert (C : value (rank_of (enters x' y' z' tmin)) <= value (rank_of (enters x y z tmin))) by (now apply rank_keeps_order).
  repeat (split; [assumption|]). unfold lane_met. intros H.
  destruct (rank_rounds_down _ N2 P) as (F2 & _). destruct (rank_rounds_down _ N1 ltac:(lra)) as (F1 & _).
  assert (Nr1 := finite_number _ F1). assert (Nr2 := finite_number _ F2).
  apply Bleb_value; [exact Nr2|exact N4|]. destruct (Rle_or_lt (value (rank_of (enters x y z tmin))) (value (leaves x y z last))) as [L|L]; [lra|exfalso].
  assert (T : Bltb (leaves x y z last) (rank_of (enters x y z tmin)) = true) by (rewrite Bltb_value by assumption; now apply Rlt_bool_true).
  revert H T. change (Bleb (rank_of (enters x y z tmin)) (leaves x y z last)) with (match Bcompare (rank_of (enters x y z tmin)) (leaves x y z last) with Some Lt | Some Eq => true | _ => false end).
  change (Bltb (leaves x y z last) (rank_of (enters x y z tmin))) with (match Bcompare (leaves x y z last) (rank_of (enters x y z tmin)) with Some Lt => true | _ => false end).
  rewrite (Bcompare_swap _ _ (rank_of (enters x y z tmin)) (leaves x y z last)). destruct (Bcompare _ _) as [[]|]; discriminate.
Qed.

(** * Empty boxes *)

(** From plus to minus infinity: near_k = +infinity, far_k = -infinity, whatever the ray. [BOX-7, LANES-1] *)
Theorem empty_axis o d : moderate o -> is_finite d = true ->
  near_of (o, d, infinity, Bopp infinity) = infinity /\ far_of (o, d, infinity, Bopp infinity) = Bopp infinity.
Proof.
  intros [Fo _] Fd. destruct (inverses d Fd) as (n & f & Fn & Pn & Hf & Sd & _ & _). unfold near_of, far_of.
  assert (Mi : minus infinity o = infinity /\ minus (Bopp infinity) o = Bopp infinity) by (destruct o; try discriminate; split; reflexivity).
  destruct Mi as [E1 E2].
  assert (T : forall k : float, is_finite k = true -> 0 < B2R k -> times infinity k = infinity /\ times (Bopp infinity) k = Bopp infinity /\
    times infinity (Bopp k) = Bopp infinity /\ times (Bopp infinity) (Bopp k) = infinity).
  { intros k Fk Pk. destruct k as [s|s| |s m e H]; try discriminate; [cbn in Pk; lra|]. destruct s; [|repeat split; reflexivity].
    exfalso. revert Pk. apply Rle_not_lt, Rlt_le, (F2R_lt_0 radix2 (Float radix2 (Z.neg m) e)). reflexivity. }
  assert (T' : times (Bopp infinity) f = Bopp infinity /\ times infinity (Bopp f) = Bopp infinity).
  { destruct Hf as [-> |[Ff Pf]]; [split; reflexivity|]. destruct (T f Ff Pf) as (_ & A & A' & _). auto. }
  destruct (T n Fn Pn) as (T1 & _ & _ & T4).
  destruct Sd as [(_ & -> & -> & ->)|(_ & -> & -> & ->)]; cbn iota; rewrite E1, E2; [split; [exact T1|apply T']|split; [exact T4|apply T']].
Qed.

(** So no empty lane is met, up to any end. [BOX-7, LANES-1] *)
Theorem empty_is_not_met o1 o2 o3 d1 d2 d3 tmin last : moderate o1 -> moderate o2 -> moderate o3 ->
  is_finite d1 = true -> is_finite d2 = true -> is_finite d3 = true -> is_finite tmin = true -> 0 <= B2R tmin -> is_nan last = false ->
  let x := (o1, d1, infinity, Bopp infinity) in let y := (o2, d2, infinity, Bopp infinity) in let z := (o3, d3, infinity, Bopp infinity) in
  enters x y z tmin = infinity /\ leaves x y z last = Bopp infinity /\ lane_met rank_of x y z tmin last = false.
Proof.
  intros H1 H2 H3 D1 D2 D3 Fm Hm Nl x y z. destruct (empty_axis o1 d1 H1 D1) as [A1 B1]. destruct (empty_axis o2 d2 H2 D2) as [A2 B2].
  destruct (empty_axis o3 d3 H3 D3) as [A3 B3].
  assert (E : enters x y z tmin = infinity).
  { unfold enters, x, y, z. rewrite A1, A2, A3. unfold Slabs.greater at 3. destruct tmin as [| | |s m e H]; try discriminate; [reflexivity|]. destruct s; reflexivity. }
  assert (L : leaves x y z last = Bopp infinity).
  { unfold leaves, x, y, z. rewrite B1, B2, B3. unfold Slabs.lesser at 3. destruct last as [s|[]| |s m e H]; try discriminate; try reflexivity. }
  split; [exact E|]. split; [exact L|]. unfold lane_met. rewrite E, L.
  destruct (rank_rounds_down infinity eq_refl) as (Fr & _); [change (value infinity) with M; apply Rlt_le, Mp|].
  destruct (rank_of infinity) as [s|s| |[] m e H]; try discriminate; reflexivity.
Qed.
End Ranks.
