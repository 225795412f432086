(** One lane of the tests of wide trees: what LaneBoxes.v, LaneRanks.v, LaneNumbers.v and Survivors.v are about is what Operations.v has.
    So LANES-1 to LANES-4 hold of the code, from the ray as it is prepared to the decision: for all finite floats. *)
Require Import Reals ZArith Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN.
Require Import StacklessExact.Rounding StacklessExact.Triple StacklessExact.Filter StacklessExact.Floor StacklessExact.Lanes.
Require StacklessExact.Slabs StacklessExact.LaneBoxes StacklessExact.LaneRanks.
Require Import StacklessExact.LaneNumbers StacklessExact.Survivors.
Require Import StacklessExact.Arithmetic StacklessExact.Operations.
Require StacklessExact.AgreementSlabs StacklessExact.AgreementScene.
Open Scope R_scope.

Local Existing Instances Arithmetic.prec_24 Arithmetic.emax_128 Arithmetic.prec_53 Arithmetic.emax_1024.

Notation finite := BinarySingleNaN.is_finite.
Notation float := (binary_float 24 128).
Notation double := (binary_float 53 1024).

(** * Boxes *)

Section Boxes.
Variables ox oy oz dx dy dz tmin mx my mz mw away sx sy sz sw : float.
Variable reach : double.
Notation axis o d lo hi := ((o, d, lo, hi) : LaneBoxes.axis).

Lemma greatest_agrees : constant f32 16777215 104 = @Bmax_float 24 128 eq_refl eq_refl.
Proof. apply B2SF_inj. vm_compute. reflexivity. Qed.

Lemma near_inverse d : shifted f32 (-2) (over f32 (constant f32 1 0) (plus f32 d (constant f32 0 0))) = LaneBoxes.inverse_near d.
Proof. rewrite AgreementSlabs.one_32. reflexivity. Qed.
(** Of a component of 0 it is +inf, whose next floats are itself. *)
Lemma far_inverse d : (if equal f32 (plus f32 d (constant f32 0 0)) (constant f32 0 0) then infinity f32 else
  shifted f32 2 (over f32 (constant f32 1 0) (plus f32 d (constant f32 0 0)))) = LaneBoxes.inverse_far d.
Proof.
  rewrite AgreementSlabs.one_32. destruct d as [s|s| |s m e H]; [|destruct s; reflexivity|reflexivity|destruct s; reflexivity].
  destruct s; vm_compute; reflexivity.
Qed.

(** [BoxRay::new]. [LANES-1] *)
Theorem box_ray_agrees : exists is_wide, BoxRay_new f32 f64 f64_of_f32 ox oy oz dx dy dz tmin reach mx my mz mw away sx sy sz sw =
  let n := LaneBoxes.inverse_near in let f := LaneBoxes.inverse_far in let b := LaneBoxes.backward in
  (ox, oy, oz, n dx, n dy, n dz, f dx, f dy, f dz, b dx, b dy, b dz, tmin, is_wide).
Proof.
  unfold BoxRay_new. cbv zeta. rewrite !near_inverse, !far_inverse. eexists. reflexivity.
Qed.

(** [BoxRay::enter]: whether the box of a lane is met. [LANES-1, LANES-2] *)
Theorem enter_agrees lx hx ly hy lz hz last : let n := LaneBoxes.inverse_near in let f := LaneBoxes.inverse_far in let b := LaneBoxes.backward in
  BoxRay_enter f32 ox oy oz (n dx) (n dy) (n dz) (f dx) (f dy) (f dz) (b dx) (b dy) (b dz) tmin lx hx ly hy lz hz last =
  LaneBoxes.lane_met (LaneRanks.rank_of 2) (axis ox dx lx hx) (axis oy dy ly hy) (axis oz dz lz hz) tmin last.
Proof. cbv zeta. unfold BoxRay_enter. cbv zeta. rewrite greatest_agrees. reflexivity. Qed.
End Boxes.

(** * Triangles *)

Notation c32 := (Arithmetic.constant f32).
Notation times := (@Bmult 24 128 eq_refl eq_refl mode_NE).

(** The greatest component, rounding up to single precision, C', and whether a ray is usual. *)
Definition size (v : fvec) : float := greater (greater (Babs (fx v)) (Babs (fy v))) (Babs (fz v)).
Definition upward (reach : double) : float :=
  let rounded := f32_of_f64 reach in if Bltb (f64_of_f32 rounded : double) reach then Bsucc rounded else rounded.
Definition code_way (o : fvec) (reach : double) : float := greater (@Bplus 24 128 eq_refl eq_refl mode_NE (size o) (upward reach)) (c32 1 (-40)).
Definition is_usual (o d : fvec) (reach : double) : bool :=
  Bleb (c32 1 (-20)) (size d) && Bleb (size d) (c32 1 20) && Bleb (size o) (c32 1 40) && Bleb (upward reach) (c32 1 40).
Definition code_longest (v0 v1 v2 : fvec) : float := block_longest f32 (fx v0) (fy v0) (fz v0) (fx v1) (fy v1) (fz v1) (fx v2) (fy v2) (fz v2).

(** [TriangleRay::new]. [LANES-3, LANES-4] *)
Theorem triangle_ray_agrees o d reach :
  TriangleRay_new f32 f64 f64_of_f32 f32_of_f64 (fx o) (fy o) (fz o) (fx d) (fy d) (fz d) reach =
  let unit := if is_usual o d reach then triangles_UNIT f32 else Slabs.infinity 24 128 in
  (fx o, fy o, fz o, fx d, fy d, fz d, times (times (c32 39 0) unit) (size d), times (times (c32 40 0) unit) (size d),
    times (times (c32 44 0) unit) (code_way o reach), times (c32 1 1) (code_way o reach)).
Proof. reflexivity. Qed.

Lemma edge_constant : times (c32 39 0) (triangles_UNIT f32) = LaneNumbers.constant 39 (-24).
Proof. apply B2SF_inj. vm_compute. reflexivity. Qed.
Lemma det_constant : times (c32 40 0) (triangles_UNIT f32) = LaneNumbers.constant 40 (-24).
Proof. apply B2SF_inj. vm_compute. reflexivity. Qed.
Lemma t_constant : times (c32 44 0) (triangles_UNIT f32) = LaneNumbers.constant 44 (-24).
Proof. apply B2SF_inj. vm_compute. reflexivity. Qed.
Lemma two_constant : c32 1 1 = LaneNumbers.constant 2 0.
Proof. apply B2SF_inj. vm_compute. reflexivity. Qed.

(** [TriangleRay::survivors]: neither filter of LaneNumbers.v rejects it. [LANES-3, LANES-4] *)
Theorem survivors_agree v0 v1 v2 o d (D C E best : float) :
  TriangleRay_survivors f32 (fx o) (fy o) (fz o) (fx d) (fy d) (fz d) (times (LaneNumbers.constant 39 (-24)) D) (times (LaneNumbers.constant 40 (-24)) D)
    (times (LaneNumbers.constant 44 (-24)) C) (times (LaneNumbers.constant 2 0) C)
    (fx v0) (fy v0) (fz v0) (fx v1) (fy v1) (fz v1) (fx v2) (fy v2) (fz v2) E best =
  let c := code_of v0 v1 v2 o d in negb (f_missed D C E c || f_beyond D C E best c).
Proof.
  unfold f_missed, f_beyond, f_delta, TriangleRay_survivors, code_of, fcross, fdot, fsub. cbv zeta. cbn [fx fy fz f_det f_u f_v f_w f_t].
  unfold Slabs.lesser, Slabs.greater. cbn [f32 ieee Arithmetic.num Arithmetic.plus Arithmetic.minus Arithmetic.times Arithmetic.less opposite absolute is_negative].
  reflexivity.
Qed.

Section Triangles.
Variables v0 v1 v2 o d : fvec.
Variable reach : double.
Variable best : float.
Notation D := (size d).
Notation C := (code_way o reach).
Notation E := (code_longest v0 v1 v2).
Let c := code_of v0 v1 v2 o d.

(** [TriangleRay::survivors], with what [new] gives it, for any unit. *)
Definition survives (edge det t twice_c : float) : bool :=
  TriangleRay_survivors f32 (fx o) (fy o) (fz o) (fx d) (fy d) (fz d) edge det t twice_c
    (fx v0) (fy v0) (fz v0) (fx v1) (fy v1) (fz v1) (fx v2) (fy v2) (fz v2) E best.

(** ** A ray that is not usual *)

(** An infinite bound, or none; and numbers that are no less than 0. *)
Definition endless (x : float) : Prop := x = B754_infinity false \/ x = B754_nan.

Lemma endless_times x y : endless x -> Bsign y = false -> endless (times x y).
Proof. intros [-> | ->] S; destruct y as [[]|[]| |[] m e H]; try discriminate; (now left) || (now right). Qed.
Lemma less_endless x y : endless y -> Bltb x (Bopp y) = false.
Proof. intros [-> | ->]; now destruct x as [[]|[]| |[] m e H]. Qed.
Lemma minus_endless x y z : endless y -> Bltb z (@Bminus 24 128 eq_refl eq_refl mode_NE x y) = false.
Proof. intros [-> | ->]; destruct x as [[]|[]| |[] m e H], z as [[]|[]| |[] m' e' H']; reflexivity. Qed.

Lemma greater_sign x y : Bsign x = false -> Bsign y = false -> Bsign (greater x y) = false.
Proof. intros. unfold Slabs.greater. now destruct (Bltb y x). Qed.
Lemma abs_sign (x : float) : Bsign (Babs x) = false.
Proof. now destruct x. Qed.
Lemma size_sign v : Bsign (size v) = false.
Proof. unfold size. repeat apply greater_sign; apply abs_sign. Qed.
Lemma above_sign x k : Bsign k = false -> is_finite_strict k = true -> Bsign (greater x k) = false.
Proof.
  intros K F. unfold Slabs.greater. destruct (Bltb k x) eqn:L; [|exact K].
  destruct k as [| | |[] m e H]; try discriminate. destruct x as [[]|[]| |[] m' e' H']; try reflexivity; discriminate.
Qed.
Lemma way_sign : Bsign C = false.
Proof. apply above_sign; vm_compute; reflexivity. Qed.
Lemma longest_sign : Bsign E = false.
Proof.
  unfold code_longest, block_longest. cbv zeta. match goal with |- Bsign (if less f32 ?k ?x then _ else _) = _ => change (Bsign (greater x k) = false) end.
  apply above_sign; vm_compute; reflexivity.
Qed.

Lemma plus_sign (x y : float) : Bsign x = false -> Bsign y = false -> Bsign (@Bplus 24 128 eq_refl eq_refl mode_NE x y) = false.
Proof.
  intros X Y. destruct (finite x) eqn:Fx; [|destruct x as [|[]| |], y as [[]|[]| |[] my ey Hy]; try discriminate; reflexivity].
  destruct (finite y) eqn:Fy; [|destruct y as [|[]| |], x as [[]|[]| |[] mx ex Hx]; try discriminate; reflexivity].
  pose proof (Slabs.sign_of_R 24 128 2 (or_introl eq_refl) x) as Px. pose proof (Slabs.sign_of_R 24 128 2 (or_introl eq_refl) y) as Py. rewrite X in Px. rewrite Y in Py.
  generalize (Bplus_correct 24 128 eq_refl eq_refl mode_NE x y Fx Fy). destruct (Rlt_bool _ _).
  - intros (_ & _ & ->). rewrite X, Y. destruct (Rcompare_spec (B2R x + B2R y) 0); [lra|reflexivity..].
  - intros (H & _). rewrite X in H. now destruct (Bplus _ _ _) as [|[]| |[]].
Qed.
Lemma times_sign (x y : float) : Bsign x = false -> Bsign y = false -> Bsign (times x y) = false.
Proof.
  intros X Y. generalize (Bmult_correct 24 128 eq_refl eq_refl mode_NE x y). destruct (Rlt_bool _ _); rewrite X, Y.
  - intros (_ & _ & S). destruct (is_nan (times x y)) eqn:N; [now destruct (times x y)|now apply S].
  - cbn. destruct (Bmult _ _ _) as [|[]| |[]]; cbn; intros H; try discriminate; reflexivity.
Qed.

(** Nothing is rejected: every comparison is with an infinity of the wrong sign or a NaN. [LANES-3, LANES-4] *)
Lemma unusual_survives : let k n := times (times (c32 n 0) (Slabs.infinity 24 128)) in
  survives (k 39%Z D) (k 40%Z D) (k 44%Z C) (times (c32 1 1) C) = true.
Proof.
  cbv zeta. assert (K : forall n y, (n = 39 \/ n = 44)%Z -> Bsign y = false -> endless (times (times (c32 n 0) (Slabs.infinity 24 128)) y)).
  { intros n y [-> | ->]; apply endless_times; left; apply B2SF_inj; vm_compute; reflexivity. }
  pose proof longest_sign as Es. pose proof way_sign as Cs. pose proof (size_sign d) as Ds.
  assert (D1 : endless (times (times (times (times (c32 39 0) (Slabs.infinity 24 128)) D) E) (@Bplus 24 128 eq_refl eq_refl mode_NE (times (c32 1 1) C) E))).
  { apply endless_times; [apply endless_times; [apply K; auto|exact Es]|apply plus_sign; [apply times_sign; [vm_compute; reflexivity|exact Cs]|exact Es]]. }
  assert (D2 : endless (times (times (times (c32 44 0) (Slabs.infinity 24 128)) C) (times E E))) by (apply endless_times; [apply K; auto|now apply times_sign]).
  unfold survives, TriangleRay_survivors. cbv zeta.
  cbn [f32 ieee Arithmetic.num less opposite absolute Arithmetic.minus Arithmetic.times Arithmetic.plus] in *.
  rewrite (less_endless _ _ D1), (minus_endless _ _ _ D2). reflexivity.
Qed.

(** ** A usual ray *)

Definition v_finite (v : fvec) : Prop := finite (fx v) = true /\ finite (fy v) = true /\ finite (fz v) = true.

Lemma abs_fits e x a : fits e x a -> fits e (Babs x) (Rabs a).
Proof. intros (F & <- & B). split; [now rewrite is_finite_Babs|split; [now rewrite B2R_Babs|now rewrite Rabs_Rabsolu]]. Qed.
Lemma size_fits e v r : vfits e v r -> fits e (size v) (greatest r).
Proof. intros (X & Y & Z). unfold size, greatest. repeat apply greater_fits; now apply abs_fits. Qed.
Lemma finite_fits v : v_finite v -> vfits 128 v (real v).
Proof. intros (X & Y & Z). split; [|split]; (split; [assumption|split; [reflexivity|apply Rlt_le, abs_B2R_lt_emax]]). Qed.
Lemma greatest_fits e v : v_finite v -> greatest (real v) <= bpow radix2 e -> vfits e v (real v).
Proof.
  intros (X & Y & Z) H. destruct (greatest_b (real v) _ H) as (A & B & G). split; [|split]; (split; [assumption|split; [reflexivity|assumption]]).
Qed.
Lemma power_fits e k : (-149 <= e)%Z -> (e <= k <= 127)%Z -> fits k (c32 1 e) (bpow radix2 e).
Proof.
  intros He Hk. replace (bpow radix2 e) with (IZR 1 * bpow radix2 e) by ring. apply (constant_fits 1 e k); [reflexivity|exact He| |lia].
  rewrite Rmult_1_l, Rabs_pos_eq by apply bpow_ge_0. apply bpow_le. lia.
Qed.

Lemma at_most_value (x y : float) : finite x = true -> finite y = true -> Bleb x y = true -> B2R x <= B2R y.
Proof. intros X Y. rewrite Bleb_correct by assumption. now destruct (Rle_bool_spec (B2R x) (B2R y)). Qed.

(** The reach of the scene, rounded up. *)
Lemma upward_enough : finite reach = true -> 0 <= B2R reach -> Bleb (upward reach) (c32 1 40) = true ->
  finite (upward reach) = true /\ B2R reach <= B2R (upward reach) <= bpow radix2 40.
Proof.
  intros F P L. destruct (power_fits 40 40 ltac:(lia) ltac:(lia)) as (Fk & Vk & _).
  assert (Done : finite (upward reach) = true -> B2R reach <= B2R (upward reach) -> finite (upward reach) = true /\ B2R reach <= B2R (upward reach) <= bpow radix2 40).
  { intros Fu Vu. split; [exact Fu|split; [exact Vu|]]. rewrite <- Vk. now apply at_most_value. }
  assert (N : (finite (f32_of_f64 reach) = true /\ B2R (f32_of_f64 reach : float) = R32 (B2R reach)) \/ f32_of_f64 reach = B754_infinity false).
  { destruct reach as [s| | |s m e H]; try discriminate; [left; split; [reflexivity|cbn; now rewrite round_0 by typeclasses eauto]|].
    unfold f32_of_f64, convert. generalize (binary_normalize_correct 24 128 _ _ mode_NE (cond_Zopp s (Zpos m)) e s). cbv zeta.
    change (F2R (Float radix2 (cond_Zopp s (Z.pos m)) e)) with (B2R (B754_finite s m e H : double)). set (x := B2R (B754_finite s m e H : double)) in *.
    destruct (Rlt_bool _ _); [intros (V & Fi & _); left; split; assumption|]. intros O. right. rewrite Rlt_bool_false in O by exact P. now apply B2SF_inj. }
  unfold upward in *. destruct N as [[Fr Vr]|Inf].
  - destruct (AgreementScene.widen_correct (f32_of_f64 reach) Fr) as (Fw & Vw & _). rewrite Bltb_correct in * by assumption. rewrite Vw, Vr in *.
    destruct (Rlt_bool_spec (R32 (B2R reach)) (B2R reach)) as [Lt|Ge]; [|apply Done; [exact Fr|now rewrite Vr]].
    generalize (Bsucc_correct 24 128 eq_refl eq_refl (f32_of_f64 reach) Fr). rewrite Vr. destruct (Rlt_bool _ _).
    + intros (Vs & Fs & _). apply Done; [exact Fs|]. eapply Rle_trans; [|right; symmetry; exact Vs]. apply succ_round_ge_id; typeclasses eauto.
    + intros I. exfalso. replace (Bsucc (f32_of_f64 reach)) with (B754_infinity false : float) in L by (apply B2SF_inj; symmetry; exact I). revert L. vm_compute. discriminate.
  - exfalso. rewrite Inf in L. destruct reach as [s| | |s m e H]; try discriminate; destruct s; revert L; vm_compute; discriminate.
Qed.

Lemma longest_fits : vfits 40 v0 (real v0) -> vfits 40 v1 (real v1) -> vfits 40 v2 (real v2) -> fits 41 E (longest (real v0) (real v1) (real v2)).
Proof.
  intros H0 H1 H2. destruct (sub_fits 40 _ _ _ _ ltac:(lia) H1 H0) as (X1 & Y1 & Z1). destruct (sub_fits 40 _ _ _ _ ltac:(lia) H2 H0) as (X2 & Y2 & Z2).
  apply abs_fits in X1, Y1, Z1, X2, Y2, Z2. pose proof (greater_fits _ _ _ _ _ X1 X2) as X. pose proof (greater_fits _ _ _ _ _ Y1 Y2) as Y. pose proof (greater_fits _ _ _ _ _ Z1 Z2) as Z.
  pose proof (greater_fits _ _ _ _ _ (greater_fits _ _ _ _ _ (greater_fits _ _ _ _ _ X Y) Z) (power_fits (-40) 41 ltac:(lia) ltac:(lia))) as L.
  unfold longest, greatest, least. cbn [vsub vx vy vz] in *. set (x1 := Rabs (R32 (vx (real v1) - _))) in *. set (y1 := Rabs (R32 (vy (real v1) - _))) in *. set (z1 := Rabs (R32 (vz (real v1) - _))) in *.
  set (x2 := Rabs (R32 (vx (real v2) - _))) in *. set (y2 := Rabs (R32 (vy (real v2) - _))) in *. set (z2 := Rabs (R32 (vz (real v2) - _))) in *.
  replace (Rmax (Rmax (Rmax x1 y1) z1) (Rmax (Rmax x2 y2) z2)) with (Rmax (Rmax (Rmax x1 x2) (Rmax y1 y2)) (Rmax z1 z2)); [exact L|].
  rewrite (Rmax_comm x2 y2), !Rmax_assoc. rewrite <- (Rmax_assoc x1 x2 y1), (Rmax_comm x2 y1), !Rmax_assoc. f_equal.
  rewrite <- !Rmax_assoc. f_equal. f_equal. rewrite !Rmax_assoc, (Rmax_comm z1 y2), (Rmax_comm x2 y2), <- !Rmax_assoc. f_equal. apply Rmax_comm.
Qed.

(** What the code rejects, for all finite floats, usual or not, has no hit with RN(t) <= best. [LANES-3, LANES-4] *)
Theorem rejected_by_code_is_right : v_finite v0 -> v_finite v1 -> v_finite v2 -> v_finite o -> v_finite d -> finite reach = true ->
  bounded (B2R reach) (real v0) -> bounded (B2R reach) (real v1) -> bounded (B2R reach) (real v2) -> is_nan best = false -> 0 <= value best ->
  (let '(_, _, _, _, _, _, edge, det, t, twice_c) := TriangleRay_new f32 f64 f64_of_f32 f32_of_f64 (fx o) (fy o) (fz o) (fx d) (fy d) (fz d) reach in
   survives edge det t twice_c = false) ->
  let truth := determinants_of exactly (real v0) (real v1) (real v2) (real o) (real d) in
  ~ (meets truth /\ 0 <= top_t truth / det truth /\ Slabs.nearest 24 128 (top_t truth / det truth) <= value best).
Proof.
  intros F0 F1 F2 Fo Fd Fr B0 B1 B2 Nb Pb. rewrite triangle_ray_agrees. destruct (is_usual o d reach) eqn:U; cbv iota zeta.
  2: { rewrite unusual_survives. discriminate. }
  rewrite edge_constant, det_constant, t_constant, two_constant. unfold survives. rewrite survivors_agree. intros S. apply negb_false_iff, orb_prop in S.
  unfold is_usual in U. apply andb_prop in U as [U Ur]. apply andb_prop in U as [U Uo]. apply andb_prop in U as [Ul Uh].
  assert (Pr : 0 <= B2R reach) by (destruct B0 as (B & _); pose proof (Rabs_pos (vx (real v0))); lra).
  destruct (upward_enough Fr Pr Ur) as (Fu & Vu & Hu).
  destruct (size_fits 128 d _ (finite_fits d Fd)) as (FD & VD & _). destruct (size_fits 128 o _ (finite_fits o Fo)) as (FO & VO & _).
  destruct (power_fits (-20) 20 ltac:(lia) ltac:(lia)) as (Fl & Vl & _). destruct (power_fits 20 20 ltac:(lia) ltac:(lia)) as (Fh & Vh & _).
  destruct (power_fits 40 40 ltac:(lia) ltac:(lia)) as (Fk & Vk & _).
  apply at_most_value in Ul, Uh, Uo; try assumption. rewrite Vl in Ul. rewrite Vh, VD in Uh. rewrite Vk, VO in Uo.
  assert (Corner : forall v, v_finite v -> bounded (B2R reach) (real v) -> vfits 40 v (real v)).
  { intros v Fv (X & Y & Z). destruct Fv as (P & Q & W). split; [|split]; (split; [assumption|split; [reflexivity|cbn [vx vy vz real] in *; lra]]). }
  pose proof (Corner v0 F0 B0) as H0. pose proof (Corner v1 F1 B1) as H1. pose proof (Corner v2 F2 B2) as H2.
  pose proof (greatest_fits 40 o Fo Uo) as Ho. pose proof (greatest_fits 20 d Fd Uh) as Hd.
  assert (FC : fits 41 C (way (real o) (B2R (upward reach)))).
  { unfold code_way, way. apply greater_fits; [|exact (power_fits (-40) 41 ltac:(lia) ltac:(lia))]. refine (plus_fits 40 _ _ _ _ ltac:(lia) (size_fits 40 o _ Ho) _).
    split; [exact Fu|split; [reflexivity|]]. rewrite Rabs_pos_eq; lra. }
  destruct FC as (FC & VC & _). destruct (longest_fits H0 H1 H2) as (FE & VE & _).
  apply (survivors_are_right v0 v1 v2 o d (B2R (upward reach)) D C E best); try assumption.
  destruct B0 as (X & Y & Z). repeat split; lra.
Qed.
End Triangles.

(** * Boxes, from the ray to the decision *)

(** A lane's test as it is in the code leaves out no box that the ray touches: for all finite rays, in scenes within the reach, where
    [new] does not leave the ray to double precision. [LANES-1, LANES-2] *)
Theorem touched_is_met_by_code ox oy oz dx dy dz tmin mx my mz mw away sx sy sz sw (reach : double) lx hx ly hy lz hz last t :
  let reaches (x : float) := finite x = true /\ Rabs (B2R x) <= B2R reach in let axis o d lo hi := ((o, d, lo, hi) : LaneBoxes.axis) in
  v_finite (FVec ox oy oz) -> v_finite (FVec dx dy dz) -> finite reach = true ->
  reaches lx -> reaches hx -> reaches ly -> reaches hy -> reaches lz -> reaches hz ->
  Slabs.touches 24 128 t (axis ox dx lx hx) -> Slabs.touches 24 128 t (axis oy dy ly hy) -> Slabs.touches 24 128 t (axis oz dz lz hz) ->
  finite tmin = true -> 0 <= B2R tmin <= t -> is_nan last = false -> Slabs.nearest 24 128 t <= value last ->
  let '(ox, oy, oz, nx, ny, nz, fx, fy, fz, bx, by_, bz, tmin, is_wide) := BoxRay_new f32 f64 f64_of_f32 ox oy oz dx dy dz tmin reach mx my mz mw away sx sy sz sw in
  is_wide = false -> BoxRay_enter f32 ox oy oz nx ny nz fx fy fz bx by_ bz tmin lx hx ly hy lz hz last = true.
Proof.
  intros reaches axis Fo (Dx & Dy & Dz) Fr Lx Hx Ly Hy Lz Hz Tx Ty Tz Fm Hm Nl Hl. destruct (power_fits 126 126 ltac:(lia) ltac:(lia)) as (Fk & Vk & _).
  unfold BoxRay_new. cbv zeta. rewrite !near_inverse, !far_inverse. intros W.
  apply orb_false_elim in W as [W Wr]. apply orb_false_elim in W as [W _]. apply negb_false_iff in W.
  apply andb_prop in W as [W _]. apply andb_prop in W as [W Nz]. apply andb_prop in W as [Nx Ny].
  apply andb_prop in Nx as [Nx _], Ny as [Ny _], Nz as [Nz _].
  apply andb_prop in Nx as [Nx _], Ny as [Ny _], Nz as [Nz _].
  change (Bltb (f64_of_f32 (c32 1 126) : double) reach = false) in Wr.
  destruct (AgreementScene.widen_correct _ Fk) as (Fw & Vw & _). rewrite Bltb_correct in Wr by assumption.
  assert (R126 : B2R reach <= bpow radix2 126).
  { rewrite <- Vk. revert Wr. rewrite <- Vw. destruct (Rlt_bool_spec (B2R (f64_of_f32 (c32 1 126) : double)) (B2R reach)); [discriminate|auto]. }
  destruct Fo as (Ox & Oy & Oz). cbn [fx fy fz] in *.
  apply AgreementSlabs.not_above in Nx, Ny, Nz; try assumption.
  assert (P : forall o d lo hi, finite o = true -> Rabs (B2R o) <= bpow radix2 126 -> finite d = true -> reaches lo -> reaches hi -> LaneBoxes.proper (axis o d lo hi)).
  { intros o d lo hi Fo Bo Fd [Fl Bl] [Fh Bh]. split; [exact Fd|]. split; [split; assumption|]. split; (split; [assumption|lra]). }
  etransitivity; [apply (enter_agrees ox oy oz dx dy dz tmin lx hx ly hy lz hz last)|].
  apply (LaneRanks.touched_is_entered 2 ltac:(lia) (axis ox dx lx hx) (axis oy dy ly hy) (axis oz dz lz hz) tmin last t); auto.
Qed.
