(** [EnclosedSlabs] of src/geom/slabs/enclosed.rs in single precision: the slab test for all rays within bounds. The lower plane of a
    box is reached, if at all, by the ray from the greatest origin in the greatest direction, the upper one by that from the least
    origin in the least direction. On IEEE 754 numbers, as Slabs.v. *)
Require Import Reals ZArith Lia Lra Psatz Bool List.
From Flocq Require Import Core BinarySingleNaN.
Require Import StacklessExact.Rounding StacklessExact.Planes StacklessExact.Slabs.
Open Scope R_scope.

Local Instance prec_24 : Prec_gt_0 24 := eq_refl.
Notation float := (binary_float 24 128).
Notation fexp := (FLT_exp (-149) 24).
Notation R32 := (round radix2 fexp ZnearestE).
Notation u := (unit 24).
Notation value := (value 24 128).
Notation nearest := (nearest 24 128).
Notation at_most := (at_most 24 128).
Notation at_least := (at_least 24 128).
Notation minus := (minus 24 128 eq_refl eq_refl).
Notation times := (times 24 128 eq_refl eq_refl).
Notation lesser := (lesser 24 128).
Notation greater := (greater 24 128).
Notation reciprocal := (reciprocal 24 128 eq_refl eq_refl).
Notation reciprocals := (reciprocals 24 128 eq_refl eq_refl 2).

(** * The code *)

(** One axis: the least and the greatest origin, the least and the greatest direction, the lower and the upper plane. *)
Record within : Type := Within { o_least : float; o_most : float; d_least : float; d_most : float; lower : float; upper : float }.

(** One axis of [lanes], where it is not [None], and of [near_and_far]. [moved(d_most, toward)] for a positive direction and
    [moved(d_most, away)] for a negative one are the reciprocal for lo of Slabs.v; likewise those of [d_least], for hi. *)
Definition narrow (ends : float * float) (a : within) : float * float :=
  let '(near, far) := ends in
  let t1 := times (minus (lower a) (o_most a)) (fst (reciprocals (d_most a))) in
  let t2 := times (minus (upper a) (o_least a)) (snd (reciprocals (d_least a))) in
  (greater (lesser t2 t1) near, lesser (greater t1 t2) far).
Definition near_and_far (axes : list within) (tmin tmax : float) : float * float := fold_left narrow axes (tmin, tmax).

(** What [lanes] and [EnclosedSlabs::of] ask before: coordinates of at most 2^126, and a direction that is exactly 0, or of certain sign
    and with reciprocals that are finite. *)
Definition moderate (x : float) : Prop := is_finite x = true /\ Rabs (B2R x) <= bpow radix2 126.
Definition invertible (d : float) : Prop := is_finite d = true /\ is_finite (reciprocal d) = true.
Definition usual (a : within) : Prop :=
  moderate (o_least a) /\ moderate (o_most a) /\ moderate (lower a) /\ moderate (upper a) /\ is_finite (d_least a) = true /\ is_finite (d_most a) = true /\
  ((B2R (d_least a) = 0 /\ B2R (d_most a) = 0) \/
   (invertible (d_least a) /\ invertible (d_most a) /\ (0 < B2R (d_least a) \/ B2R (d_most a) < 0))).

(** A ray within the bounds, and that it is in the slab at t. *)
Definition is_within (a : within) (o d : R) : Prop := B2R (o_least a) <= o <= B2R (o_most a) /\ B2R (d_least a) <= d <= B2R (d_most a).
Definition touches (a : within) (o d t : R) : Prop := B2R (lower a) <= o + t * d <= B2R (upper a).

(** * One axis *)

Lemma difference_value b o : moderate b -> moderate o -> is_finite (minus b o) = true /\ B2R (minus b o) = R32 (B2R b - B2R o).
Proof. intros [Fb Hb] [Fo Ho]. exact (minus_value 24 128 eq_refl eq_refl 2 ltac:(lia) (or_introl eq_refl) b o Fb Fo Hb Ho). Qed.

Lemma mono x y : x <= y -> R32 x <= R32 y.
Proof. intros. now apply round_le; try typeclasses eauto. Qed.
Lemma at_most_of x y t : is_finite x = true -> is_finite y = true -> 0 <= t -> R32 (B2R x * B2R y) <= R32 t -> at_most (times x y) (nearest t).
Proof. apply (times_at_most 24 128 eq_refl eq_refl 2 (or_introl eq_refl)). Qed.
Lemma at_least_of x y t : is_finite x = true -> is_finite y = true -> R32 t <= R32 (B2R x * B2R y) -> at_least (times x y) (nearest t).
Proof. apply (times_at_least 24 128 eq_refl eq_refl 2 (or_introl eq_refl)). Qed.
Lemma format (x : float) : generic_format radix2 fexp (B2R x).
Proof. exact (B2R_format 24 128 x). Qed.

(** A plane that a ray reaches, for the ray that reaches it first, and for the one that leaves it last: for a direction of either sign. The
    ray is at or beyond the lower plane at t, or at or before the upper one. *)
Lemma lower_plane b o d t : moderate b -> moderate o -> invertible d -> B2R d <> 0 -> 0 <= t -> B2R b <= B2R o + t * B2R d ->
  (0 < B2R d -> at_most (times (minus b o) (fst (reciprocals d))) (nearest t)) /\
  (B2R d < 0 -> at_least (times (minus b o) (fst (reciprocals d))) (nearest t)).
Proof.
  intros Hb Ho [Fd Hi] Nd Ht T. destruct (difference_value b o Hb Ho) as [Fx Ex].
  destruct (reciprocals_value 24 128 eq_refl eq_refl 2 ltac:(lia) (or_introl eq_refl) d Fd Nd Hi) as (n & f & Fn & Ff & (Hn & Hf) & S).
  split; intros Sd; (destruct S as [[Sg ->]|[Sg ->]]; [|lra] || (destruct S as [[Sg ->]|[Sg ->]]; [lra|])); cbn [fst].
  - rewrite Rabs_pos_eq in Hn by lra. apply at_most_of; try assumption. rewrite Ex.
    apply (near_is_not_after (-149) 24 ltac:(lia)) with (d := B2R d); auto using format.
  - rewrite Rabs_left in Hf by lra. apply at_least_of; [assumption|now rewrite is_finite_Bopp|]. rewrite Ex, B2R_Bopp.
    fold (distance (-149) 24 (B2R o) (B2R b) (- B2R f)). rewrite mirrored.
    apply (far_is_not_before (-149) 24 ltac:(lia)) with (d := - B2R d); auto using generic_format_opp, format; lra.
Qed.
Lemma upper_plane b o d t : moderate b -> moderate o -> invertible d -> B2R d <> 0 -> 0 <= t -> B2R o + t * B2R d <= B2R b ->
  (0 < B2R d -> at_least (times (minus b o) (snd (reciprocals d))) (nearest t)) /\
  (B2R d < 0 -> at_most (times (minus b o) (snd (reciprocals d))) (nearest t)).
Proof.
  intros Hb Ho [Fd Hi] Nd Ht T. destruct (difference_value b o Hb Ho) as [Fx Ex].
  destruct (reciprocals_value 24 128 eq_refl eq_refl 2 ltac:(lia) (or_introl eq_refl) d Fd Nd Hi) as (n & f & Fn & Ff & (Hn & Hf) & S).
  split; intros Sd; (destruct S as [[Sg ->]|[Sg ->]]; [|lra] || (destruct S as [[Sg ->]|[Sg ->]]; [lra|])); cbn [snd].
  - rewrite Rabs_pos_eq in Hf by lra. apply at_least_of; try assumption. rewrite Ex.
    apply (far_is_not_before (-149) 24 ltac:(lia)) with (d := B2R d); auto using format.
  - rewrite Rabs_left in Hn by lra. apply at_most_of; [assumption|now rewrite is_finite_Bopp|assumption|]. rewrite Ex, B2R_Bopp.
    fold (distance (-149) 24 (B2R o) (B2R b) (- B2R n)). rewrite mirrored.
    apply (near_is_not_after (-149) 24 ltac:(lia)) with (d := - B2R d); auto using generic_format_opp, format; lra.
Qed.

(** One turn of the loop. *)
Lemma narrow_keeps ends a o d t : usual a -> is_within a o d -> touches a o d t -> 0 <= t ->
  at_most (fst ends) (nearest t) -> at_least (snd ends) (nearest t) ->
  at_most (fst (narrow ends a)) (nearest t) /\ at_least (snd (narrow ends a)) (nearest t).
Proof.
  destruct ends as [near far], a as [ol om dl dm lo hi]. unfold usual, is_within, touches. cbn [fst snd o_least o_most d_least d_most lower upper].
  intros (Hol & Hom & Hl & Hh & Fl & Fm & Sgn) [Bo Bd] [T1 T2] Ht Hn Hf. unfold narrow. cbn [o_least o_most d_least d_most lower upper].
  (* No ray within the bounds is above the one, none below the other. *)
  assert (Up : B2R lo <= B2R om + t * B2R dm) by (assert (t * d <= t * B2R dm) by (apply Rmult_le_compat_l; lra); lra).
  assert (Down : B2R ol + t * B2R dl <= B2R hi) by (assert (t * B2R dl <= t * d) by (apply Rmult_le_compat_l; lra); lra).
  assert (Keep : forall a b, at_most a (nearest t) -> at_least b (nearest t) ->
    (at_most (greater (lesser b a) near) (nearest t) /\ at_least (lesser (greater a b) far) (nearest t)) /\
    (at_most (greater (lesser a b) near) (nearest t) /\ at_least (lesser (greater b a) far) (nearest t))).
  { intros a b [Na Va] [Nb Vb]. split; (split; [apply greater_at_most; [apply lesser_at_most; auto; [left + right]; now split|assumption]|
      apply lesser_at_least; [apply greater_at_least; auto; [left + right]; now split|assumption]]). }
  destruct Sgn as [[Zl Zm]|(Il & Im & Sgn)].
  - (* Along the planes: the reciprocals are a float next to the greatest, and infinity. *)
    rewrite (reciprocals_of_zero 24 128 eq_refl eq_refl 2 dl Fl Zl), (reciprocals_of_zero 24 128 eq_refl eq_refl 2 dm Fm Zm). cbn [fst snd].
    destruct (moved_infinity 24 128 eq_refl eq_refl 2 ltac:(lia) (or_introl eq_refl)) as [Fi Hi]. set (i := Nat.iter 2 _ _) in *.
    destruct (difference_value lo om Hl Hom) as [Fx Ex]. destruct (difference_value hi ol Hh Hol) as [Fy Ey].
    rewrite Zl, Rmult_0_r, Rplus_0_r in Down. rewrite Zm, Rmult_0_r, Rplus_0_r in Up.
    assert (A1 : at_most (times (minus lo om) i) (nearest t)).
    { apply at_most_of; try assumption. apply mono. rewrite Ex. assert (R32 (B2R lo - B2R om) <= 0).
      { rewrite <- (round_0 radix2 fexp ZnearestE). apply mono. lra. }
      assert (0 <= - R32 (B2R lo - B2R om) * B2R i) by (apply Rmult_le_pos; lra). lra. }
    assert (A2 : times (minus hi ol) (Slabs.infinity 24 128) = B754_nan \/ times (minus hi ol) (Slabs.infinity 24 128) = Slabs.infinity 24 128).
    { assert (P : 0 <= B2R (minus hi ol)) by (rewrite Ey, <- (round_0 radix2 fexp ZnearestE); apply mono; lra).
      unfold Slabs.times. destruct (minus hi ol) as [s|s| |s m e He]; try discriminate; [now left|right].
      destruct s; [|reflexivity]. exfalso. apply (Rlt_not_le _ _ (F2R_lt_0 radix2 (Float radix2 (Z.neg m) e) eq_refl)). exact P. }
    destruct A2 as [-> | ->].
    + rewrite lesser_of_nan, greater_to_nan, lesser_of_nan. split; [now apply greater_at_most|assumption].
    + assert (A2 : at_least (Slabs.infinity 24 128) (nearest t)) by (split; [reflexivity|apply Rmin_r]). exact (proj1 (Keep _ _ A1 A2)).
  - destruct Sgn as [P|N].
    + destruct (lower_plane lo om dm t Hl Hom Im ltac:(lra) Ht Up) as [L _]. destruct (upper_plane hi ol dl t Hh Hol Il ltac:(lra) Ht Down) as [H _].
      exact (proj1 (Keep _ _ (L ltac:(lra)) (H ltac:(lra)))).
    + destruct (lower_plane lo om dm t Hl Hom Im ltac:(lra) Ht Up) as [_ L]. destruct (upper_plane hi ol dl t Hh Hol Il ltac:(lra) Ht Down) as [_ H].
      exact (proj2 (Keep _ _ (H ltac:(lra)) (L N))).
Qed.

(** * The test *)

(** No box is skipped that a ray within the bounds touches at a t of its interval, nor is it entered after a distance that is not below
    RN(t): for a direction whose components are 0 or of certain sign, in single precision. [INST-4, SECOND-3] *)
Theorem within_touched_is_hit x y z ox oy oz dx dy dz tmin tmax t : usual x -> usual y -> usual z ->
  is_within x ox dx -> is_within y oy dy -> is_within z oz dz -> touches x ox dx t -> touches y oy dy t -> touches z oz dz t ->
  Slabs.within 24 128 t tmin tmax ->
  let '(near, far) := near_and_far (x :: y :: z :: nil) tmin tmax in
  Bleb near far = true /\
  (forall best : float, is_nan best = false -> nearest t <= value best -> Bleb near best = true).
Proof.
  intros Ux Uy Uz Wx Wy Wz Tx Ty Tz W. destruct (within_ends 24 128 eq_refl t tmin tmax W) as (Ht & Hn & Hf).
  destruct (narrow_keeps (tmin, tmax) x ox dx t Ux Wx Tx Ht Hn Hf) as [N1 F1].
  destruct (narrow_keeps _ y oy dy t Uy Wy Ty Ht N1 F1) as [N2 F2].
  destruct (narrow_keeps _ z oz dz t Uz Wz Tz Ht N2 F2) as [N3 F3].
  unfold near_and_far. cbn [fold_left]. destruct (narrow (narrow (narrow (tmin, tmax) x) y) z) as [near far]. cbn [fst snd] in *.
  destruct N3 as [Nn Vn], F3 as [Nf Vf]. split; [apply Bleb_value; try assumption; lra|].
  intros best Nb Hb. apply Bleb_value; try assumption. lra.
Qed.
