(** [Slabs64] of src/geom/slabs/slabs64.rs: the slab test of a ray in double precision, in the frame of the boxes and from its entry into
    their region. This is about the lanes, on IEEE 754 numbers of single precision; FramedEnds.v has the ends in doubles. *)
Require Import Reals ZArith Lia Lra Psatz Bool List.
From Flocq Require Import Core BinarySingleNaN.
Require Import StacklessExact.Rounding StacklessExact.Planes StacklessExact.Slabs StacklessExact.Steps.
Open Scope R_scope.

Local Instance prec_24 : Prec_gt_0 24 := eq_refl.
Local Instance emax_128 : Prec_lt_emax 24 128 := eq_refl.
Notation float := (binary_float 24 128).
Notation fexp := (FLT_exp (-149) 24).
Notation F := (generic_format radix2 fexp).
Notation R32 := (round radix2 fexp ZnearestE).
Notation u := (unit 24).
Notation eta := (bpow radix2 (-150)).
Notation value := (value 24 128).
Notation nearest := (nearest 24 128).
Notation at_most := (at_most 24 128).
Notation at_least := (at_least 24 128).
Notation minus := (Slabs.minus 24 128 eq_refl eq_refl).
Notation times := (Slabs.times 24 128 eq_refl eq_refl).
Notation lesser := (lesser 24 128).
Notation greater := (greater 24 128).
Notation infinity := (infinity 24 128).
Notation one := (one 24 128 eq_refl eq_refl).

(** * The code *)

(** One axis: the bounds of the origin, those of the magnitude of the direction, whether the ray runs backward, and the planes. *)
Record axis : Type := Axis { o_least : float; o_most : float; slowest : float; fastest : float; backward : bool; lower : float; upper : float }.

Definition recip (d : float) : float := Bdiv mode_NE one d.
(** [MIN_POSITIVE], 2^-126. *)
Definition normal_least : float := number false 8388608 (-149) eq_refl.

(** [for_planes]: origin and reciprocal for the lower and the upper plane. *)
Definition for_planes (a : axis) : (float * float) * (float * float) :=
  let near := Nat.iter 3 Bpred (recip (greater (fastest a) normal_least)) in
  let '(most, far) :=
    if Bleb normal_least (slowest a) then (o_most a, Nat.iter 3 Bsucc (recip (slowest a)))
    else (if backward a then Bsucc (o_most a) else o_most a, infinity) in
  let '(lo, hi) := if backward a then (Bopp far, Bopp near) else (near, far) in
  ((most, lo), (o_least a, hi)).

(** One turn of the loop of [near_and_far], which begins at 0. *)
Definition narrow (ends : float * float) (a : axis) : float * float :=
  let '(near, far) := ends in
  let '((most, lo), (least, hi)) := for_planes a in
  let t1 := times (minus (lower a) most) lo in
  let t2 := times (minus (upper a) least) hi in
  (greater (lesser t2 t1) near, lesser (greater t1 t2) far).
Definition near_and_far (axes : list axis) (tmax : float) : float * float := fold_left narrow axes (B754_zero false, tmax).

(** * Planes *)

Lemma rounded_off x : Rabs x < bpow radix2 (-126) -> Rabs (R32 x - x) <= eta.
Proof.
  intros H. eapply Rle_trans; [apply error_le_half_ulp; typeclasses eauto|]. rewrite (ulp_FLT_small radix2 (-149) 24) by (eapply Rlt_le_trans; [exact H|apply bpow_le; lia]).
  change (bpow radix2 (-149)) with (bpow radix2 (1 + -150)). rewrite bpow_plus. change (bpow radix2 1) with 2. lra.
Qed.

(** What a near distance is at most, and a far distance at least, if the ray is in the slab at t: RN(t), and t but for underflow. *)
Definition near_top (t : R) : R := Rmin (nearest t) (Rmax t (Rmin (t + eta) (bpow radix2 (-126)))).
Definition far_low (t : R) : R := Rmax (nearest t) (if Rlt_bool t (bpow radix2 (-126)) then t - eta else t).

Section Plane.
Variables o d b t : R.
Hypothesis Fo : F o.
Hypothesis Fb : F b.
Hypothesis Fd : F d.
Hypothesis Pd : 0 < d.
Hypothesis Pt : 0 <= t.
Variable i : R.
Hypothesis Hi : R32 (1 / d) = i.
Hypothesis Pi : 0 < i.
Notation pred := (Ulp.pred radix2 fexp).
Notation succ := (Ulp.succ radix2 fexp).

(** [BOX-8] *)
Theorem near_plane : 0 < pred (pred (pred i)) -> b <= o + t * d -> let y := R32 (R32 (b - o) * pred (pred (pred i))) in
  y <= R32 t /\ y <= Rmax t (Rmin (t + eta) (bpow radix2 (-126))).
Proof.
  intros P3 T y. pose proof (u_8 24 ltac:(lia)) as Hu.
  pose proof (three_down_by (-149) 24 (1 / d) i Hi Pi P3) as D.
  assert (N : y <= R32 t).
  { apply (near_is_not_after (-149) 24 ltac:(lia) o d b t _ Fb Fo Pd Pt); [|exact T]. split; [lra|].
    set (inv := pred (pred (pred i))) in *. apply Rle_trans with ((1 - u) * (inv * (1 + 5 / 2 * u))); [|apply Rmult_le_compat_l; lra].
    replace ((1 - u) * (inv * (1 + 5 / 2 * u))) with (inv * ((1 - u) * (1 + 5 / 2 * u))) by ring. rewrite <- (Rmult_1_r inv) at 1.
    apply Rmult_le_compat_l; nra. }
  split; [exact N|]. destruct (Rle_or_lt (bpow radix2 (-126)) (Rabs (R32 (b - o) * pred (pred (pred i))))) as [H|H].
  - eapply Rle_trans; [|apply Rmax_l].
    apply (three_steps_near (-149) 24 ltac:(lia) o d b t i Fb Fo Pd Pt Hi Pi P3); [now right|exact T].
  - eapply Rle_trans; [|apply Rmax_r]. apply Rmin_glb.
    + pose proof (rounded_off _ H) as E. apply Rabs_le_inv in E. fold y in E.
      assert (R32 (b - o) * pred (pred (pred i)) <= t); [|lra].
      destruct (difference (-149) 24 b o Fb Fo) as (e & He & ->). pose proof (unit_ratio u ltac:(lra)) as R1. apply Rabs_le_inv in He.
      set (inv := pred (pred (pred i))) in *. set (x := b - o) in *.
      destruct (Rle_or_lt x 0) as [Nx|Px]; [assert (0 <= - x * ((1 + e) * inv)) by (repeat apply Rmult_le_pos; lra); lra|].
      assert (Tx : x * (1 / d) <= t). { apply Rmult_le_reg_r with d; [exact Pd|]. field_simplify; unfold x; lra. }
      eapply Rle_trans; [|exact Tx]. rewrite Rmult_assoc. apply Rmult_le_compat_l; [lra|]. eapply Rle_trans; [|exact D].
      rewrite Rmult_comm. apply Rmult_le_compat_l; lra.
    + apply round_le_generic; try typeclasses eauto; [apply generic_format_bpow; unfold FLT_exp; lia|]. apply Rabs_def2 in H. lra.
Qed.

(** [BOX-8] *)
Theorem far_plane : o + t * d <= b -> let y := R32 (R32 (b - o) * succ (succ (succ i))) in
  R32 t <= y /\ (if Rlt_bool t (bpow radix2 (-126)) then t - eta else t) <= y.
Proof.
  intros T y. pose proof (u_8 24 ltac:(lia)) as Hu. pose proof (three_up_by (-149) 24 ltac:(lia) (1 / d) i Hi Pi) as D.
  assert (Py : 0 < 1 / d) by (apply Rdiv_lt_0_compat; lra).
  assert (N : R32 t <= y).
  { apply (far_is_not_before (-149) 24 ltac:(lia) o d b t _ Fb Fo Pd Pt); [|exact T]. eapply Rle_trans; [|exact D]. nra. }
  split; [exact N|]. set (inv := succ (succ (succ i))) in *.
  assert (B : t <= R32 (b - o) * inv).
  { destruct (difference (-149) 24 b o Fb Fo) as (e & He & ->). pose proof (unit_ratio u ltac:(lra)) as R1. apply Rabs_le_inv in He.
    assert (Px : 0 <= b - o) by nra. set (x := b - o) in *.
    assert (Tx : t <= x * (1 / d)). { apply Rmult_le_reg_r with d; [exact Pd|]. field_simplify; unfold x; lra. }
    eapply Rle_trans; [exact Tx|]. rewrite Rmult_assoc. apply Rmult_le_compat_l; [exact Px|].
    apply Rle_trans with ((1 - u) * ((1 + u) * (1 + u) * (1 / d))).
    - rewrite <- Rmult_assoc. rewrite <- (Rmult_1_l (1 / d)) at 1. apply Rmult_le_compat_r; [lra|].
      generalize dependent u. intros v Hv. intros. clear - Hv. nra.
    - apply Rmult_le_compat; [lra|repeat apply Rmult_le_pos; lra|lra|exact D]. }
  destruct (Rle_or_lt (bpow radix2 (-126)) (Rabs (R32 (b - o) * inv))) as [H|H].
  - assert (t <= y). { apply (three_steps_far (-149) 24 ltac:(lia) o d b t i Fb Fo Pd Pt Hi Pi); [now right|exact T]. }
    pose proof (bpow_gt_0 radix2 (-150)). destruct (Rlt_bool _ _); lra.
  - pose proof (rounded_off _ H) as E. apply Rabs_le_inv in E. fold y in E. apply Rabs_def2 in H. rewrite Rlt_bool_true by lra. lra.
Qed.
End Plane.

(** * Reciprocals *)

Lemma recip_value d : is_finite d = true -> bpow radix2 (-126) <= B2R d ->
  is_finite (recip d) = true /\ B2R (recip d) = R32 (1 / B2R d) /\ bpow radix2 (-128) <= B2R (recip d) <= bpow radix2 126.
Proof.
  intros Fd Hd. assert (Pd : 0 < B2R d) by (eapply Rlt_le_trans; [apply bpow_gt_0|exact Hd]).
  pose proof (finite_inside 24 128 d) as [_ Top]. unfold Rdiv. rewrite Rmult_1_l.
  assert (B : bpow radix2 (-128) <= R32 (/ B2R d) <= bpow radix2 126).
  { split; [apply round_ge_generic|apply round_le_generic]; try typeclasses eauto; try (apply generic_format_bpow; unfold FLT_exp; lia).
    - change (-128)%Z with (- (128))%Z. rewrite bpow_opp. apply Rinv_le; lra.
    - change 126%Z with (- (-126))%Z. rewrite bpow_opp. apply Rinv_le; [apply bpow_gt_0|exact Hd]. }
  unfold recip. generalize (Bdiv_correct 24 128 _ _ mode_NE one d ltac:(lra)).
  change (round_mode mode_NE) with ZnearestE. change (SpecFloat.fexp 24 128) with fexp.
  replace (B2R one) with 1 by (symmetry; apply Bone_correct). unfold Rdiv. rewrite Rmult_1_l. rewrite Rlt_bool_true.
  - intros (V & Fin & _). rewrite V, Fin. split; [apply is_finite_Bone|]. now split.
  - rewrite Rabs_pos_eq by (eapply Rle_trans; [apply bpow_ge_0|apply B]). eapply Rle_lt_trans; [apply B|apply bpow_lt; lia].
Qed.

Notation pred := (Ulp.pred radix2 fexp).
Notation succ := (Ulp.succ radix2 fexp).

Lemma three_down d : is_finite d = true -> bpow radix2 (-126) <= B2R d -> let n := Nat.iter 3 Bpred (recip d) in
  is_finite n = true /\ B2R n = pred (pred (pred (B2R (recip d)))) /\ 0 < B2R n.
Proof.
  intros Fd Hd n. destruct (recip_value d Fd Hd) as (Fi & _ & L & _).
  assert (G : forall e, (-149 <= e)%Z -> F (bpow radix2 e)) by (intros; apply generic_format_bpow; unfold FLT_exp; lia).
  destruct (Bpred_value 24 128 _ _ (recip d) (bpow radix2 (-129)) Fi (G (-129)%Z ltac:(lia)) (bpow_ge_0 _ _)) as (F1 & V1 & L1).
  { eapply Rlt_le_trans; [|exact L]. apply bpow_lt. lia. }
  destruct (Bpred_value 24 128 _ _ (Bpred (recip d)) (bpow radix2 (-130)) F1 (G (-130)%Z ltac:(lia)) (bpow_ge_0 _ _)) as (F2 & V2 & L2).
  { eapply Rlt_le_trans; [|exact L1]. apply bpow_lt. lia. }
  destruct (Bpred_value 24 128 _ _ (Bpred (Bpred (recip d))) (bpow radix2 (-131)) F2 (G (-131)%Z ltac:(lia)) (bpow_ge_0 _ _)) as (F3 & V3 & L3).
  { eapply Rlt_le_trans; [|exact L2]. apply bpow_lt. lia. }
  unfold n. cbn [Nat.iter nat_rect]. split; [exact F3|]. split; [now rewrite V3, V2, V1|].
  eapply Rlt_le_trans; [apply (bpow_gt_0 radix2 (-131))|exact L3].
Qed.

Lemma three_up d : is_finite d = true -> bpow radix2 (-126) <= B2R d -> let f := Nat.iter 3 Bsucc (recip d) in
  is_finite f = true /\ B2R f = succ (succ (succ (B2R (recip d)))) /\ 0 < B2R (recip d).
Proof.
  intros Fd Hd f. destruct (recip_value d Fd Hd) as (Fi & _ & L & U).
  assert (G : forall n, (Z.abs n < 2 ^ 24)%Z -> F (IZR n * bpow radix2 124)).
  { intros n Hn. apply generic_format_FLT. exists (Float radix2 n 124); [reflexivity|exact Hn|simpl; lia]. }
  replace (bpow radix2 126) with (4 * bpow radix2 124) in U by (change 126%Z with (2 + 124)%Z; rewrite bpow_plus; reflexivity).
  assert (T : 7 * bpow radix2 124 < bpow radix2 128).
  { change 128%Z with (4 + 124)%Z. rewrite bpow_plus. change (bpow radix2 4) with 16. pose proof (bpow_gt_0 radix2 124). lra. }
  pose proof (bpow_gt_0 radix2 124) as P.
  destruct (Bsucc_value 24 128 _ _ (recip d) (5 * bpow radix2 124) Fi (G 5%Z ltac:(simpl; lia)) ltac:(lra) ltac:(lra)) as (F1 & V1 & U1).
  destruct (Bsucc_value 24 128 _ _ (Bsucc (recip d)) (6 * bpow radix2 124) F1 (G 6%Z ltac:(simpl; lia)) ltac:(lra) ltac:(lra)) as (F2 & V2 & U2).
  destruct (Bsucc_value 24 128 _ _ (Bsucc (Bsucc (recip d))) (7 * bpow radix2 124) F2 (G 7%Z ltac:(simpl; lia)) ltac:(lra) ltac:(lra)) as (F3 & V3 & U3).
  unfold f. cbn [Nat.iter nat_rect]. split; [exact F3|]. split; [now rewrite V3, V2, V1|].
  eapply Rlt_le_trans; [apply (bpow_gt_0 radix2 (-128))|exact L].
Qed.

(** * One axis *)

(** What [Approach::on] and [Region] ask: coordinates of at most 2^126 in the frame; and magnitudes that are in order. *)
Definition moderate (x : float) : Prop := is_finite x = true /\ Rabs (B2R x) <= bpow radix2 126.
Definition usual (a : axis) : Prop :=
  moderate (o_least a) /\ moderate (o_most a) /\ moderate (lower a) /\ moderate (upper a) /\
  is_finite (slowest a) = true /\ is_finite (fastest a) = true /\ 0 <= B2R (slowest a).

(** A ray within the bounds, and that it is in the slab at t. *)
Definition is_within (a : axis) (o d : R) : Prop := B2R (o_least a) <= o <= B2R (o_most a) /\
  (if backward a then d <= 0 else 0 <= d) /\ B2R (slowest a) <= Rabs d <= B2R (fastest a).
Definition touches (a : axis) (o d t : R) : Prop := B2R (lower a) <= o + t * d <= B2R (upper a).

Lemma format (x : float) : F (B2R x).
Proof. exact (B2R_format 24 128 x). Qed.

Lemma difference_value b o : moderate b -> is_finite o = true -> Rabs (B2R o) <= bpow radix2 127 ->
  is_finite (minus b o) = true /\ B2R (minus b o) = R32 (B2R b - B2R o).
Proof.
  intros [Fb Hb] Fo Ho. unfold Slabs.minus. generalize (Bminus_correct 24 128 _ _ mode_NE b o Fb Fo).
  change (round_mode mode_NE) with ZnearestE. change (SpecFloat.fexp 24 128) with fexp. rewrite Rlt_bool_true; [tauto|].
  apply Rle_lt_trans with (3 * bpow radix2 126).
  - apply abs_round_le_generic; [typeclasses eauto|typeclasses eauto| |].
    + apply generic_format_FLT. exists (Float radix2 3 126); [reflexivity|reflexivity|simpl; lia].
    + pose proof (sub_b _ _ _ _ Hb Ho) as S. change 127%Z with (1 + 126)%Z in S. rewrite (bpow_plus _ 1) in S. change (bpow radix2 1) with 2 in S. lra.
  - change 128%Z with (2 + 126)%Z. rewrite (bpow_plus _ 2). change (bpow radix2 2) with 4. pose proof (bpow_gt_0 radix2 126). lra.
Qed.

Lemma moderate_difference b o : moderate b -> moderate o -> is_finite (minus b o) = true /\ B2R (minus b o) = R32 (B2R b - B2R o).
Proof. intros Hb [Fo Ho]. apply difference_value; auto. eapply Rle_trans; [exact Ho|apply bpow_le; lia]. Qed.

Lemma product_at_most x y t : is_finite x = true -> is_finite y = true -> 0 <= t -> R32 (B2R x * B2R y) <= R32 t ->
  R32 (B2R x * B2R y) <= Rmax t (Rmin (t + eta) (bpow radix2 (-126))) -> at_most (times x y) (near_top t).
Proof.
  intros Fx Fy Ht A B. destruct (times_at_most 24 128 eq_refl eq_refl 3 (or_intror eq_refl) x y t Fx Fy Ht A) as [N V].
  split; [exact N|]. unfold near_top. apply Rmin_glb; [exact V|]. destruct (times_value 24 128 eq_refl eq_refl 3 (or_intror eq_refl) x y Fx Fy) as [_ ->].
  apply Rmax_lub; [|eapply Rle_trans; [apply Rmin_l|exact B]]. eapply Rle_trans; [|apply Rmax_l]. pose proof (bpow_gt_0 radix2 128). lra.
Qed.

Lemma product_at_least x y t : is_finite x = true -> is_finite y = true -> t <= bpow radix2 128 -> R32 t <= R32 (B2R x * B2R y) ->
  (if Rlt_bool t (bpow radix2 (-126)) then t - eta else t) <= R32 (B2R x * B2R y) -> at_least (times x y) (far_low t).
Proof.
  intros Fx Fy Ht A B. destruct (times_at_least 24 128 eq_refl eq_refl 3 (or_intror eq_refl) x y t Fx Fy A) as [N V].
  split; [exact N|]. unfold far_low. apply Rmax_lub; [exact V|]. destruct (times_value 24 128 eq_refl eq_refl 3 (or_intror eq_refl) x y Fx Fy) as [_ ->].
  eapply Rle_trans; [|apply Rmax_r]. apply Rmin_glb; [exact B|].
  pose proof (bpow_gt_0 radix2 (-150)). destruct (Rlt_bool _ _); lra.
Qed.

(** The near plane, ahead, and the far one, of a ray that runs forward; and mirrored. *)
Lemma near_product b o d t : moderate b -> moderate o -> is_finite d = true -> bpow radix2 (-126) <= B2R d -> 0 <= t ->
  let n := Nat.iter 3 Bpred (recip d) in
  (B2R b <= B2R o + t * B2R d -> at_most (times (minus b o) n) (near_top t)) /\
  (B2R o - t * B2R d <= B2R b -> at_most (times (minus b o) (Bopp n)) (near_top t)).
Proof.
  intros Hb Ho Fd Hd Ht n. destruct (recip_value d Fd Hd) as (_ & Vi & Li & _). destruct (three_down d Fd Hd) as (Fn & Vn & Pn). fold n in Fn, Vn, Pn.
  destruct (moderate_difference b o Hb Ho) as [Fx Ex]. assert (Pd : 0 < B2R d) by (eapply Rlt_le_trans; [apply bpow_gt_0|exact Hd]).
  assert (Pi : 0 < B2R (recip d)) by (eapply Rlt_le_trans; [apply bpow_gt_0|exact Li]). rewrite Vn in Pn.
  split; intros T.
  - destruct (near_plane (B2R o) (B2R d) (B2R b) t (format o) (format b) Pd Ht _ (eq_sym Vi) Pi Pn T) as [A B].
    apply product_at_most; try assumption; rewrite Ex, Vn; assumption.
  - destruct (near_plane (- B2R o) (B2R d) (- B2R b) t (generic_format_opp _ _ _ (format o)) (generic_format_opp _ _ _ (format b)) Pd Ht _ (eq_sym Vi) Pi Pn ltac:(lra)) as [A B].
    assert (E : R32 (B2R b - B2R o) * - pred (pred (pred (B2R (recip d)))) = R32 (- B2R b - - B2R o) * pred (pred (pred (B2R (recip d))))).
    { replace (- B2R b - - B2R o) with (- (B2R b - B2R o)) by ring. rewrite round_NE_opp. ring. }
    apply product_at_most; try assumption; [now rewrite is_finite_Bopp|..]; rewrite Ex, B2R_Bopp, Vn, E; assumption.
Qed.

Lemma far_product b o d t : moderate b -> moderate o -> is_finite d = true -> bpow radix2 (-126) <= B2R d -> 0 <= t <= bpow radix2 128 ->
  let f := Nat.iter 3 Bsucc (recip d) in
  (B2R o + t * B2R d <= B2R b -> at_least (times (minus b o) f) (far_low t)) /\
  (B2R b <= B2R o - t * B2R d -> at_least (times (minus b o) (Bopp f)) (far_low t)).
Proof.
  intros Hb Ho Fd Hd [Ht Mt] f. destruct (recip_value d Fd Hd) as (_ & Vi & _). destruct (three_up d Fd Hd) as (Ff & Vf & Pi). fold f in Ff, Vf.
  destruct (moderate_difference b o Hb Ho) as [Fx Ex]. assert (Pd : 0 < B2R d) by (eapply Rlt_le_trans; [apply bpow_gt_0|exact Hd]).
  split; intros T.
  - destruct (far_plane (B2R o) (B2R d) (B2R b) t (format o) (format b) Pd Ht _ (eq_sym Vi) Pi T) as [A B].
    apply product_at_least; try assumption; rewrite Ex, Vf; assumption.
  - destruct (far_plane (- B2R o) (B2R d) (- B2R b) t (generic_format_opp _ _ _ (format o)) (generic_format_opp _ _ _ (format b)) Pd Ht _ (eq_sym Vi) Pi ltac:(lra)) as [A B].
    assert (E : R32 (B2R b - B2R o) * - succ (succ (succ (B2R (recip d)))) = R32 (- B2R b - - B2R o) * succ (succ (succ (B2R (recip d))))).
    { replace (- B2R b - - B2R o) with (- (B2R b - B2R o)) by ring. rewrite round_NE_opp. ring. }
    apply product_at_least; try assumption; [now rewrite is_finite_Bopp|..]; rewrite Ex, B2R_Bopp, Vf, E; assumption.
Qed.

Lemma normal_least_value : B2R normal_least = bpow radix2 (-126).
Proof. unfold normal_least, number, B2R, F2R. simpl Fnum. simpl Fexp. change 8388608 with (bpow radix2 23). rewrite <- bpow_plus. reflexivity. Qed.

(** [max] with the least normal number. *)
Lemma at_least_normal d : is_finite d = true -> let m := greater d normal_least in
  is_finite m = true /\ bpow radix2 (-126) <= B2R m /\ B2R d <= B2R m.
Proof.
  intros Fd m. unfold m, Slabs.greater. rewrite Bltb_correct by (assumption || reflexivity). rewrite normal_least_value.
  destruct (Rlt_bool_spec (bpow radix2 (-126)) (B2R d)); [repeat split; [exact Fd|lra|lra]|].
  rewrite normal_least_value. repeat split; [lra|assumption].
Qed.

Lemma infinity_at_least t : t <= bpow radix2 128 -> at_least infinity (far_low t).
Proof.
  intros Ht. split; [reflexivity|]. unfold far_low. apply Rmax_lub; [apply Rmin_r|].
  change (value infinity) with (bpow radix2 128).
  pose proof (bpow_gt_0 radix2 (-150)). destruct (Rlt_bool _ _); lra.
Qed.

(** With a magnitude that has no reciprocal, the plane behind an origin that is not before it bounds nothing. *)
Lemma behind_is_infinity b o : moderate b -> moderate o -> B2R b <= B2R o -> times (minus b (Bsucc o)) (Bopp infinity) = infinity.
Proof.
  intros Hb [Fo Ho] T.
  assert (G : F (bpow radix2 127)) by (apply generic_format_bpow; unfold FLT_exp; lia).
  assert (L1 : B2R o < bpow radix2 127).
  { apply Rle_lt_trans with (bpow radix2 126); [apply Rabs_le_inv in Ho; lra|apply bpow_lt; lia]. }
  destruct (Bsucc_value 24 128 _ _ o (bpow radix2 127) Fo G L1 ltac:(apply bpow_lt; lia)) as (Fs & Vs & Us).
  assert (L : B2R o < B2R (Bsucc o)). { rewrite Vs. change (SpecFloat.emin 24 128) with (-149)%Z. destruct (Req_dec (B2R o) 0) as [Z|N]; [|now apply succ_gt_id].
    rewrite Z, succ_0, (ulp_FLT_small radix2 (-149) 24) by (rewrite Rabs_R0; apply bpow_gt_0). apply bpow_gt_0. }
  destruct (difference_value b (Bsucc o) Hb Fs) as [Fx Ex].
  { apply Rabs_le. apply Rabs_le_inv in Ho. assert (bpow radix2 126 < bpow radix2 127) by (apply bpow_lt; lia). lra. }
  assert (N : B2R (minus b (Bsucc o)) < 0).
  { rewrite Ex. destruct (difference (-149) 24 (B2R b) (B2R (Bsucc o)) (format _) (format _)) as (e & He & ->). pose proof (u_8 24 ltac:(lia)) as Hu.
    pose proof (unit_ratio u ltac:(lra)) as R1. apply Rabs_le_inv in He. assert (0 < (B2R (Bsucc o) - B2R b) * (1 + e)) by (apply Rmult_lt_0_compat; lra). lra. }
  unfold Slabs.times. destruct (minus b (Bsucc o)) as [sg|sg| |sg m e B]; try discriminate; [simpl in N; lra|].
  destruct sg; [reflexivity|]. exfalso. assert (0 < B2R (B754_finite false m e B)) by (apply F2R_gt_0; reflexivity). lra.
Qed.

Lemma ahead_is_no_bound b o : moderate b -> moderate o -> B2R o <= B2R b ->
  times (minus b o) infinity = B754_nan \/ times (minus b o) infinity = infinity.
Proof.
  intros Hb Ho T. destruct (moderate_difference b o Hb Ho) as [Fx Ex].
  assert (P : 0 <= B2R (minus b o)) by (rewrite Ex, <- (round_0 radix2 fexp ZnearestE); apply round_le; try typeclasses eauto; lra).
  unfold Slabs.times. destruct (minus b o) as [s|s| |s m e He]; try discriminate; [now left|right].
  destruct s; [|reflexivity]. exfalso. apply (Rlt_not_le _ _ (F2R_lt_0 radix2 (Float radix2 (Z.neg m) e) eq_refl)). exact P.
Qed.

(** One turn of the loop. *)
Lemma narrow_keeps ends a o d t w : usual a -> is_within a o d -> touches a o d t -> 0 <= t <= bpow radix2 128 -> w <= far_low t ->
  at_most (fst ends) (near_top t) -> at_least (snd ends) w ->
  at_most (fst (narrow ends a)) (near_top t) /\ at_least (snd (narrow ends a)) w.
Proof.
  destruct ends as [near far], a as [ol om sl fa back lo hi]. unfold usual, is_within, touches.
  cbn [fst snd o_least o_most slowest fastest backward lower upper].
  intros (Hol & Hom & Hl & Hh & Fs & Ff & Ps) (Bo & Sg & [Bs Bf]) [T1 T2] Ht Hw Hn Hf. unfold narrow, for_planes.
  cbn [o_least o_most slowest fastest backward lower upper].
  destruct (at_least_normal fa Ff) as (Fm & Nm & Lm). set (m := greater fa normal_least) in *. clearbody m.
  assert (Keep : forall a b, at_most a (near_top t) -> at_least b (far_low t) ->
    (at_most (greater (lesser b a) near) (near_top t) /\ at_least (lesser (greater a b) far) w) /\
    (at_most (greater (lesser a b) near) (near_top t) /\ at_least (lesser (greater b a) far) w)).
  { intros a b [Na Va] [Nb Vb]. assert (w <= value b) by lra. split; (split; [apply greater_at_most; [apply lesser_at_most; auto; [left + right]; now split|assumption]|
      apply lesser_at_least; [apply greater_at_least; auto; [left + right]; now split|assumption]]). }
  rewrite Bleb_correct by (exact Fs || reflexivity). rewrite normal_least_value.
  destruct back.
  - rewrite Rabs_left1 in Bs, Bf by exact Sg.
    assert (Near : B2R ol - t * B2R m <= B2R hi) by (assert (t * - d <= t * B2R m) by (apply Rmult_le_compat_l; lra); lra).
    assert (Far : B2R lo <= B2R om - t * B2R sl) by (assert (t * B2R sl <= t * - d) by (apply Rmult_le_compat_l; lra); lra).
    pose proof (proj2 (near_product hi ol m t Hh Hol Fm Nm ltac:(lra)) Near) as N2.
    destruct (Rle_bool_spec (bpow radix2 (-126)) (B2R sl)) as [Ns|_]; cbn [fst snd].
    + apply (Keep _ _ N2). exact (proj2 (far_product lo om sl t Hl Hom Fs Ns Ht) Far).
    + rewrite (behind_is_infinity lo om Hl Hom) by (assert (0 <= t * B2R sl) by (apply Rmult_le_pos; lra); lra).
      apply (Keep _ _ N2). apply infinity_at_least, Ht.
  - rewrite Rabs_pos_eq in Bs, Bf by exact Sg.
    assert (Near : B2R lo <= B2R om + t * B2R m) by (assert (t * d <= t * B2R m) by (apply Rmult_le_compat_l; lra); lra).
    assert (Far : B2R ol + t * B2R sl <= B2R hi) by (assert (t * B2R sl <= t * d) by (apply Rmult_le_compat_l; lra); lra).
    pose proof (proj1 (near_product lo om m t Hl Hom Fm Nm ltac:(lra)) Near) as N1.
    destruct (Rle_bool_spec (bpow radix2 (-126)) (B2R sl)) as [Ns|_]; cbn [fst snd].
    + apply (Keep _ _ N1). exact (proj1 (far_product hi ol sl t Hh Hol Fs Ns Ht) Far).
    + destruct (ahead_is_no_bound hi ol Hh Hol) as [-> | ->]; [assert (0 <= t * B2R sl) by (apply Rmult_le_pos; lra); lra|..].
      * rewrite lesser_of_nan, greater_to_nan, lesser_of_nan. split; [now apply greater_at_most|assumption].
      * apply (Keep _ _ N1). apply infinity_at_least, Ht.
Qed.

(** * The test *)

(** A box that a ray within the bounds touches at t, from its entry on, is hit if the end is at least RN(t). near' is at most RN(t), and at
    most t if nothing underflows; far' is at least all this likewise, as far as the end is. [BOX-8, BOX-9] *)
Theorem framed_touched_is_hit x y z ox oy oz dx dy dz tmax t : usual x -> usual y -> usual z ->
  is_within x ox dx -> is_within y oy dy -> is_within z oz dz -> touches x ox dx t -> touches y oy dy t -> touches z oz dz t ->
  0 <= t <= bpow radix2 128 -> at_least tmax (nearest t) ->
  let '(near, far) := near_and_far (x :: y :: z :: nil) tmax in
  Bleb near far = true /\ at_most near (near_top t) /\ (forall w, w <= far_low t -> at_least tmax w -> at_least far w).
Proof.
  intros Ux Uy Uz Wx Wy Wz Tx Ty Tz Ht Hm.
  assert (P : 0 <= near_top t).
  { unfold near_top. apply Rmin_glb; [apply (nearest_pos 24 128 eq_refl), Ht|]. eapply Rle_trans; [|apply Rmax_l]. apply Ht. }
  assert (Start : at_most (B754_zero false) (near_top t)) by (split; [reflexivity|exact P]).
  assert (Keep : forall w, w <= far_low t -> at_least tmax w -> let '(near, far) := near_and_far (x :: y :: z :: nil) tmax in
    at_most near (near_top t) /\ at_least far w).
  { intros w Lw Hw. destruct (narrow_keeps (B754_zero false, tmax) x ox dx t w Ux Wx Tx Ht Lw Start Hw) as [N1 F1].
    destruct (narrow_keeps _ y oy dy t w Uy Wy Ty Ht Lw N1 F1) as [N2 F2]. destruct (narrow_keeps _ z oz dz t w Uz Wz Tz Ht Lw N2 F2) as [N3 F3].
    unfold near_and_far. cbn [fold_left]. destruct (narrow (narrow (narrow (B754_zero false, tmax) x) y) z). now split. }
  pose proof (Keep (nearest t) ltac:(apply Rmax_l) Hm) as K. destruct (near_and_far _ _) as [near far]. destruct K as [N Fr].
  split; [|split; [exact N|intros w Lw Hw; now apply (Keep w)]].
  destruct N as [Nn Vn], Fr as [Nf Vf]. apply Bleb_value; try assumption. assert (near_top t <= nearest t) by apply Rmin_l. lra.
Qed.
