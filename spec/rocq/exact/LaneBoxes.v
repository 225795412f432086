(** The boxes of a node: [BoxRay::enter] of src/geom/lanes/boxes.rs, one lane, on IEEE 754 numbers of single precision. Near planes are
    picked by the sign of the direction, so nothing is sorted: BOX-1 as it is written, for all finite directions. *)
Require Import Reals ZArith Lia Lra Psatz Bool List.
From Flocq Require Import Core BinarySingleNaN.
Require Import StacklessExact.Rounding StacklessExact.Planes StacklessExact.Slabs.
Open Scope R_scope.

Local Instance prec_24 : Prec_gt_0 24 := eq_refl.
Notation float := (binary_float 24 128).
Notation fexp := (FLT_exp (-149) 24).
Notation R32 := (round radix2 fexp ZnearestE).
Notation F := (generic_format radix2 fexp).
Notation u := (unit 24).
Notation M := (bpow radix2 128).
Notation value := (value 24 128).
Notation nearest := (nearest 24 128).
Notation at_most := (at_most 24 128).
Notation at_least := (at_least 24 128).
Notation minus := (minus 24 128 eq_refl eq_refl).
Notation times := (times 24 128 eq_refl eq_refl).
Notation zero := (zero 24 128).
Notation infinity := (infinity 24 128).
Notation plus := (@Bplus 24 128 eq_refl eq_refl mode_NE).
Notation over := (@Bdiv 24 128 eq_refl eq_refl mode_NE).
Notation before := (@Bpred 24 128 eq_refl eq_refl).
Notation after := (@Bsucc 24 128 eq_refl eq_refl).
Notation one := (@Bone 24 128 eq_refl eq_refl).
Notation reciprocal := (reciprocal 24 128 eq_refl eq_refl).
Notation lesser := (lesser 24 128).
Notation greater := (greater 24 128).
Notation axis := (axis 24 128).

(** * The code *)

(** The reciprocals for near and for far planes, moved by two floats, and the side. *)
Definition inverse_near (d : float) : float := moved 24 128 2 before (reciprocal d).
Definition inverse_far (d : float) : float := moved 24 128 2 after (reciprocal d).
Definition backward (d : float) : bool := Bltb (plus d zero) zero.

(** [distance] of the near plane and of the far one. *)
Definition near_of (a : axis) : float := let '(o, d, lo, hi) := a in times (minus (if backward d then hi else lo) o) (inverse_near d).
Definition far_of (a : axis) : float := let '(o, d, lo, hi) := a in times (minus (if backward d then lo else hi) o) (inverse_far d).

(** near' and far'' of LANES-1. *)
Definition enters (x y z : axis) (tmin : float) : float := greater (greater (near_of x) (near_of y)) (greater (near_of z) tmin).
Definition leaves (x y z : axis) (last : float) : float := lesser (far_of x) (lesser (far_of y) (lesser (far_of z) last)).

(** LANES-2 makes of near' what is not above it, not below 0, and finite. *)
Definition rounds_down (cut : float -> float) : Prop := forall x, is_nan x = false -> 0 <= value x ->
  is_finite (cut x) = true /\ 0 <= value (cut x) <= value x.
Definition lane_met (cut : float -> float) (x y z : axis) (tmin last : float) : bool := Bleb (cut (enters x y z tmin)) (leaves x y z last).

(** Finite numbers, coordinates of at most 2^126. *)
Definition moderate (x : float) : Prop := is_finite x = true /\ Rabs (B2R x) <= bpow radix2 126.
Definition proper (a : axis) : Prop := let '(o, d, lo, hi) := a in is_finite d = true /\ moderate o /\ moderate lo /\ moderate hi.

(** * Reciprocals *)

Lemma Mp : 0 < M.
Proof. apply bpow_gt_0. Qed.

(** Two floats below infinity. *)
Lemma below_infinity : is_finite (Nat.iter 2 before infinity) = true /\ B2R (Nat.iter 2 before infinity) = M * (1 - 2 * u) /\ Bsign (Nat.iter 2 before infinity) = false.
Proof.
  assert (E : B2SF (Nat.iter 2 before infinity) = SpecFloat.S754_finite false 16777214 104) by (vm_compute; reflexivity).
  split; [|split].
  - rewrite <- is_finite_SF_B2SF, E. reflexivity.
  - rewrite <- SF2R_B2SF, E. unfold SF2R, F2R. cbn [Fnum Fexp SpecFloat.cond_Zopp]. simpl bpow. lra.
  - destruct (Nat.iter 2 before infinity); cbn in E; try discriminate. now injection E.
Qed.

(** A reciprocal is that of a number, positive or negative, or infinite. *)
Lemma reciprocal_cases d : is_finite d = true ->
  (B2R d = 0 /\ reciprocal d = infinity /\ backward d = false) \/
  (B2R d <> 0 /\ is_finite (reciprocal d) = true) \/
  (0 < B2R d /\ reciprocal d = infinity /\ backward d = false /\ M * (1 - u) <= 1 / B2R d) \/
  (B2R d < 0 /\ reciprocal d = Bopp infinity /\ backward d = true /\ M * (1 - u) <= 1 / - B2R d).
Proof.
  intros Fd. destruct (Req_dec (B2R d) 0) as [Z|N].
  - left. assert (Ez : plus d zero = zero).
    { destruct d as [[]|s| |s m e H]; try discriminate; try reflexivity. exfalso. simpl in Z. apply eq_0_F2R in Z. destruct s; discriminate. }
    split; [exact Z|]. unfold Slabs.reciprocal, Slabs.one, backward. rewrite Ez. split; reflexivity.
  - right. assert (Same : plus d zero = d) by (destruct d as [s| | |]; [now contradict N|..]; easy).
    unfold Slabs.reciprocal, Slabs.one, backward in *. rewrite Same in *. generalize (Bdiv_correct 24 128 eq_refl eq_refl mode_NE one d N).
    change (round_mode mode_NE) with ZnearestE. change (SpecFloat.fexp 24 128) with fexp. rewrite Bone_correct, Bsign_Bone.
    set (q := over one d). clearbody q. destruct (Rlt_bool_spec (Rabs (R32 (1 / B2R d))) M) as [H|H].
    { intros (_ & Fin & _). left. split; [exact N|]. rewrite Fin. apply is_finite_Bone. }
    intros E. right. assert (E' : q = B754_infinity (Bsign d)) by (apply B2SF_inj; rewrite E; now destruct (Bsign d)).
    assert (Big : forall x, 0 < x -> M <= R32 x -> M * (1 - u) <= x).
    { intros x Hx L. apply Rnot_lt_le. intros L'. assert (T : R32 x <= M * (1 - u)).
      { apply round_le_generic; [typeclasses eauto..| |lra]. replace (M * (1 - u)) with (F2R (Float radix2 16777215 104)) by (unfold F2R; simpl; lra).
        apply generic_format_FLT. exists (Float radix2 16777215 104); simpl; [reflexivity|lia|lia]. }
      pose proof Mp. assert (0 < u) by apply bpow_gt_0. nra. }
    pose proof (sign_of_R 24 128 2 (or_introl eq_refl) d) as Sd. rewrite Bltb_correct by auto. change (B2R zero) with 0.
    destruct (Rtotal_order (B2R d) 0) as [L|[L|L]]; [right|contradiction|left]; (split; [exact L|]).
    + rewrite E'. destruct (Bsign d); [|lra]. split; [reflexivity|]. split; [now apply Rlt_bool_true|]. apply Big; [apply Rdiv_lt_0_compat; lra|].
      replace (1 / - B2R d) with (- (1 / B2R d)) by (field; lra). rewrite round_NE_opp. rewrite Rabs_left1 in H; [exact H|].
      apply (RN_le_0 24 128 eq_refl). assert (0 < 1 / - B2R d) by (apply Rdiv_lt_0_compat; lra). replace (1 / B2R d) with (- (1 / - B2R d)) by (field; lra). lra.
    + rewrite E'. destruct (Bsign d); [lra|]. split; [reflexivity|]. split; [apply Rlt_bool_false; lra|]. apply Big; [apply Rdiv_lt_0_compat; lra|].
      rewrite Rabs_pos_eq in H; [exact H|]. apply (RN_0_le 24 128 eq_refl). apply Rlt_le, Rdiv_lt_0_compat; lra.
Qed.

(** Two floats below a number that is not small. *)
Lemma two_below x : is_finite x = true -> bpow radix2 (-128) <= B2R x -> 0 < B2R (Nat.iter 2 before x).
Proof.
  intros Fx H. assert (P : forall y e, is_finite y = true -> (-149 <= e)%Z -> bpow radix2 (e + 1) <= B2R y -> is_finite (before y) = true /\ bpow radix2 e <= B2R (before y)).
  { intros y e Fy He Hy. destruct (Bpred_value 24 128 eq_refl eq_refl y (bpow radix2 e) Fy) as (A & _ & B); [| |eapply Rlt_le_trans; [|exact Hy]; apply bpow_lt; lia|auto].
    - apply generic_format_bpow. unfold FLT_exp. change (SpecFloat.emin 24 128) with (-149)%Z. lia.
    - apply bpow_ge_0. }
  destruct (P x (-129)%Z Fx ltac:(lia) H) as [F1 H1]. destruct (P (before x) (-130)%Z F1 ltac:(lia) H1) as [_ H2].
  eapply Rlt_le_trans; [|exact H2]. apply bpow_gt_0.
Qed.

(** The reciprocals: that for the near plane is finite, not negative, and too small; that for the far plane is too great, or infinite. Both
    have the sign of the direction. *)
Lemma inverses d : is_finite d = true ->
  exists n f : float, is_finite n = true /\ 0 < B2R n /\
    (f = infinity \/ (is_finite f = true /\ 0 < B2R f)) /\
    ((0 <= B2R d /\ backward d = false /\ inverse_near d = n /\ inverse_far d = f) \/
     (B2R d < 0 /\ backward d = true /\ inverse_near d = Bopp n /\ inverse_far d = Bopp f)) /\
    (B2R d = 0 -> f = infinity) /\
    (B2R d <> 0 -> B2R n <= (1 - u) * (1 / Rabs (B2R d)) /\ (f = infinity \/ (1 + u) * (1 / Rabs (B2R d)) <= B2R f)).
Proof.
  intros Fd. destruct below_infinity as (If & Iv & Is). pose proof Mp as MP. assert (Hu : 0 < u <= / 64) by (split; [apply bpow_gt_0|apply (bpow_le radix2 (-24) (-6)); lia]).
  assert (Ip : 0 < M * (1 - 2 * u)) by (apply Rmult_lt_0_compat; lra).
  destruct (reciprocal_cases d Fd) as [(Z & E & Bk)|[(N & Fr)|[(L & E & Bk & Big)|(L & E & Bk & Big)]]].
  - exists (Nat.iter 2 before infinity), infinity. unfold inverse_near, inverse_far, moved. rewrite E. split; [exact If|]. split; [rewrite Iv; exact Ip|].
    split; [now left|]. split; [left; split; [rewrite Z; lra|]; repeat split; assumption|]. split; [reflexivity|contradiction].
  - destruct (reciprocals_value 24 128 eq_refl eq_refl 2 ltac:(lia) (or_introl eq_refl) d Fd N Fr) as (n & f & Fn & Ff & (Hn & Hf) & H).
    destruct (reciprocal_value 24 128 eq_refl eq_refl d Fd N Fr) as (_ & _ & Same). exists n, f. split; [exact Fn|].
    assert (Pd : 0 < 1 / Rabs (B2R d)) by (apply Rdiv_lt_0_compat; [lra|now apply Rabs_pos_lt]).
    assert (Nz : Beqb (plus d zero) zero = false).
    { rewrite Same, Beqb_correct by auto. now apply Req_bool_false. }
    assert (Pf : 0 < B2R f) by (eapply Rlt_le_trans; [|exact Hf]; apply Rmult_lt_0_compat; lra).
    assert (Pn : 0 < B2R n).
    { destruct (reciprocal_value 24 128 eq_refl eq_refl d Fd N Fr) as (V & Sg & _). pose proof (finite_inside 24 128 d) as In.
      assert (Low : bpow radix2 (-128) <= R32 (1 / Rabs (B2R d))).
      { apply round_ge_generic; [typeclasses eauto..|apply generic_format_bpow; unfold FLT_exp; lia|]. change (-128)%Z with (Z.opp 128). rewrite bpow_opp. unfold Rdiv. rewrite Rmult_1_l.
        apply Rinv_le; [now apply Rabs_pos_lt|]. apply Rabs_le. change (bpow radix2 128) with M. lra. }
      unfold reciprocals in H. rewrite Nz, Same, Bltb_correct in H by auto. change (B2R zero) with 0 in H. unfold moved in H. rewrite Sg in H.
      pose proof (sign_of_R 24 128 2 (or_introl eq_refl) d) as Sd. destruct H as [[L H]|[L H]].
      - rewrite Rlt_bool_false in H by lra. destruct (Bsign d); [lra|]. apply (f_equal fst) in H. cbn [fst] in H. rewrite <- H. apply two_below; [exact Fr|].
        rewrite Rabs_pos_eq in Low by lra. apply (Rle_trans _ _ _ Low), Req_le. symmetry. exact V.
      - rewrite Rlt_bool_true in H by lra. destruct (Bsign d); [|lra]. apply (f_equal (fun both => Bopp (snd both))) in H. cbn [snd] in H. rewrite !Bopp_involutive in H. rewrite <- H. apply two_below; [now rewrite is_finite_Bopp|]. rewrite B2R_Bopp.
        rewrite Rabs_left in Low by lra. apply (Rle_trans _ _ _ Low), Req_le. replace (1 / - B2R d) with (- (1 / B2R d)) by (field; lra).
        rewrite round_NE_opp. f_equal. symmetry. exact V. }
    split; [exact Pn|]. split; [right; auto|]. unfold reciprocals in H. rewrite Nz, Same, Bltb_correct in H by auto.
    change (B2R zero) with 0 in H. split; [|split; [contradiction|intros _; split; [apply Hn|right; exact Hf]]]. unfold inverse_near, inverse_far, backward. rewrite Same, Bltb_correct by auto.
    change (B2R zero) with 0. destruct H as [[L H]|[L H]].
    + rewrite Rlt_bool_false in H |- * by lra. injection H as H1 H2. left. repeat split; auto. lra.
    + rewrite Rlt_bool_true in H |- * by lra. injection H as H1 H2. right. repeat split; auto.
  - exists (Nat.iter 2 before infinity), infinity. unfold inverse_near, inverse_far, moved. rewrite E. split; [exact If|]. split; [rewrite Iv; exact Ip|].
    split; [now left|]. split; [left; split; [lra|]; repeat split; assumption|]. split; [reflexivity|]. intros _. split; [|now left].
    rewrite Iv, Rabs_pos_eq by lra. apply Rle_trans with ((1 - u) * (M * (1 - u))); [|apply Rmult_le_compat_l; lra].
    assert (0 <= M * (u * u)) by (apply Rmult_le_pos; [lra|apply Rmult_le_pos; lra]). lra.
  - exists (Nat.iter 2 before infinity), infinity. unfold inverse_near, inverse_far, moved. rewrite E. split; [exact If|]. split; [rewrite Iv; exact Ip|].
    split; [now left|]. split; [right; split; [exact L|]; repeat split; assumption|]. split; [reflexivity|]. intros _. split; [|now left].
    rewrite Iv, Rabs_left by lra. apply Rle_trans with ((1 - u) * (M * (1 - u))); [|apply Rmult_le_compat_l; lra].
    assert (0 <= M * (u * u)) by (apply Rmult_le_pos; [lra|apply Rmult_le_pos; lra]). lra.
Qed.

(** * One axis *)

Lemma difference_value b o : moderate b -> moderate o -> is_finite (minus b o) = true /\ B2R (minus b o) = R32 (B2R b - B2R o).
Proof. intros [Fb Hb] [Fo Ho]. exact (minus_value 24 128 eq_refl eq_refl 2 ltac:(lia) (or_introl eq_refl) b o Fb Fo Hb Ho). Qed.

(** A number times infinity of either sign. *)
Lemma times_infinity x : is_finite x = true ->
  (B2R x = 0 /\ times x infinity = B754_nan /\ times x (Bopp infinity) = B754_nan) \/
  (0 < B2R x /\ times x infinity = infinity /\ times x (Bopp infinity) = Bopp infinity) \/
  (B2R x < 0 /\ times x infinity = Bopp infinity /\ times x (Bopp infinity) = infinity).
Proof.
  intros Fx. destruct x as [s|s| |s m e H]; try discriminate; [left; auto|right]. destruct s; [right|left]; (split; [|split; reflexivity]).
  - apply (F2R_lt_0 radix2 (Float radix2 (Z.neg m) e)). reflexivity.
  - apply (F2R_gt_0 radix2 (Float radix2 (Z.pos m) e)). reflexivity.
Qed.

Lemma plane_format x : moderate x -> F (B2R x).
Proof. intros _. exact (B2R_format 24 128 x). Qed.

(** Where the ray touches the slab at t: near_k is a number, and at most RN(t); far_k is at least RN(t), or a NaN, which is dropped. *)
Lemma axis_holds a t : proper a -> touches 24 128 t a -> 0 <= t ->
  at_most (near_of a) (nearest t) /\ (is_nan (far_of a) = true \/ at_least (far_of a) (nearest t)).
Proof.
  destruct a as [[[o d] lo] hi]. intros (Fd & Ho & Hl & Hh) T Ht. cbn [touches] in T. unfold Slabs.touches in T.
  destruct (difference_value lo o Hl Ho) as [Fx Ex]. destruct (difference_value hi o Hh Ho) as [Fy Ey].
  pose proof (plane_format _ Hl) as Gl. pose proof (plane_format _ Hh) as Gh. pose proof (plane_format _ Ho) as Go.
  assert (Mono : forall x y, x <= y -> R32 x <= R32 y) by (intros; now apply round_le; try typeclasses eauto).
  assert (R0 : R32 0 = 0) by (apply round_0; typeclasses eauto).
  destruct (inverses d Fd) as (n & f & Fn & Pn & Hf & Sd & Z & Nz). unfold near_of, far_of.
  assert (NearF : forall x y : float, is_finite x = true -> is_finite y = true -> R32 (B2R x * B2R y) <= R32 t -> at_most (times x y) (nearest t)).
  { intros x y X Y H. exact (times_at_most 24 128 eq_refl eq_refl 2 (or_introl eq_refl) x y t X Y Ht H). }
  assert (FarF : forall x y : float, is_finite x = true -> is_finite y = true -> R32 t <= R32 (B2R x * B2R y) -> at_least (times x y) (nearest t)).
  { intros x y X Y H. exact (times_at_least 24 128 eq_refl eq_refl 2 (or_introl eq_refl) x y t X Y H). }
  assert (Inf : at_least infinity (nearest t)) by (split; [reflexivity|apply Rmin_r]).
  destruct Sd as [(Sd & -> & -> & ->)|(Sd & -> & -> & ->)]; cbn iota.
  - destruct (Req_dec (B2R d) 0) as [Zd|Nd].
    + (* Along the planes. *)
      rewrite Zd, Rmult_0_r, Rplus_0_r in T. rewrite (Z Zd). split.
      * apply NearF; try assumption. apply Mono. rewrite Ex. assert (R32 (B2R lo - B2R o) <= 0) by (rewrite <- R0; apply Mono; lra).
        assert (R32 (B2R lo - B2R o) * B2R n <= 0 * B2R n) by (apply Rmult_le_compat_r; lra). lra.
      * assert (0 <= B2R (minus hi o)) by (rewrite Ey, <- R0; apply Mono; lra).
        destruct (times_infinity _ Fy) as [(_ & -> & _)|[(_ & -> & _)|(L & _)]]; [now left|now right|lra].
    + destruct (Nz Nd) as [Hn Hf']. rewrite Rabs_pos_eq in Hn, Hf' by lra. split.
      * apply NearF; try assumption. rewrite Ex. apply (near_is_not_after (-149) 24 ltac:(lia)) with (d := B2R d); auto; lra.
      * destruct Hf as [-> |[Ff Pf]].
        -- assert (0 <= B2R (minus hi o)).
           { rewrite Ey, <- R0. apply Mono. assert (0 <= t * B2R d) by (apply Rmult_le_pos; lra). lra. }
           destruct (times_infinity _ Fy) as [(_ & -> & _)|[(_ & -> & _)|(L & _)]]; [now left|now right|lra].
        -- right. destruct Hf' as [->|Hf']; [discriminate|]. apply FarF; try assumption. rewrite Ey.
           apply (far_is_not_before (-149) 24 ltac:(lia)) with (d := B2R d); auto; lra.
  - assert (Nd : B2R d <> 0) by lra. destruct (Nz Nd) as [Hn Hf']. rewrite Rabs_left in Hn, Hf' by lra. split.
    + apply NearF; [assumption|now rewrite is_finite_Bopp|]. rewrite Ey, B2R_Bopp.
      fold (distance (-149) 24 (B2R o) (B2R hi) (- B2R n)). rewrite mirrored.
      apply (near_is_not_after (-149) 24 ltac:(lia)) with (d := - B2R d); auto using generic_format_opp; lra.
    + destruct Hf as [-> |[Ff Pf]].
      * assert (B2R (minus lo o) <= 0).
        { rewrite Ex, <- R0. apply Mono. assert (0 <= t * - B2R d) by (apply Rmult_le_pos; lra). lra. }
        destruct (times_infinity _ Fx) as [(_ & _ & ->)|[(L & _)|(_ & _ & ->)]]; [now left|lra|now right].
      * right. destruct Hf' as [->|Hf']; [discriminate|]. apply FarF; [assumption|now rewrite is_finite_Bopp|]. rewrite Ex, B2R_Bopp.
        fold (distance (-149) 24 (B2R o) (B2R lo) (- B2R f)). rewrite mirrored.
        apply (far_is_not_before (-149) 24 ltac:(lia)) with (d := - B2R d); auto using generic_format_opp; lra.
Qed.

(** * The test *)

(** What the end is: a number, and far'' is what BOX-1 has, without the axes that are dropped. *)
Lemma lesser_keeps a b v : is_nan a = true \/ at_least a v -> at_least b v -> at_least (lesser a b) v.
Proof.
  intros [N|A] B; [|now apply lesser_at_least]. destruct a; try discriminate. now rewrite lesser_of_nan.
Qed.

(** No box is left out that the exact ray touches at a t within the interval and with RN(t) at most the end: for all finite directions,
    subnormal components and zeros of both signs among them, and coordinates of at most 2^126. [BOX-1, BOX-2, LANES-1] *)
Theorem lane_touched_is_met cut x y z tmin last t : rounds_down cut -> proper x -> proper y -> proper z ->
  touches 24 128 t x -> touches 24 128 t y -> touches 24 128 t z ->
  is_finite tmin = true -> 0 <= B2R tmin <= t -> is_nan last = false -> nearest t <= value last ->
  lane_met cut x y z tmin last = true.
Proof.
  intros Cut Px Py Pz Tx Ty Tz Fm Hm Nl Hl. assert (Ht : 0 <= t) by lra.
  destruct (axis_holds x t Px Tx Ht) as [Nx Fx]. destruct (axis_holds y t Py Ty Ht) as [Ny Fy]. destruct (axis_holds z t Pz Tz Ht) as [Nz Fz].
  assert (Nm : at_most tmin (nearest t)).
  { split; [now destruct tmin|]. rewrite finite_value by assumption. pose proof (finite_inside 24 128 tmin) as In. apply Rmin_glb; [|lra].
    rewrite <- (round_generic radix2 fexp ZnearestE (B2R tmin)) by exact (B2R_format 24 128 tmin). now apply round_le; try typeclasses eauto. }
  assert (En : at_most (enters x y z tmin) (nearest t)) by (unfold enters; repeat apply greater_at_most; assumption).
  assert (Lv : at_least (leaves x y z last) (nearest t)).
  { unfold leaves. apply lesser_keeps; [assumption|]. apply lesser_keeps; [assumption|]. apply lesser_keeps; [assumption|now split]. }
  assert (E0 : 0 <= value (enters x y z tmin)).
  { unfold enters. assert (A : at_least (greater (near_of z) tmin) 0).
    { apply greater_at_least; [apply Nz|apply Nm|]. right. split; [apply Nm|]. rewrite finite_value by assumption. lra. }
    apply greater_at_least; [|apply A|now right]. unfold Slabs.greater. destruct (Bltb _ _); [apply Nx|apply Ny]. }
  destruct En as [Nn Vn], Lv as [Nv Vv]. destruct (Cut _ Nn E0) as (Fc & C0 & C1). unfold lane_met. apply Bleb_value; [now destruct (cut _)|exact Nv|lra].
Qed.
