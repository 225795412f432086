(** [Errors::of_scene] and [of_triangle] of src/geom/kernel/exact/filter.rs, with [Region::of] of src/geom/region.rs: what they give
    [Errors::new] are bounds of the components as computed. So nothing is left to suppose of the first two stages of [Exact] but
    that corners, origin and direction are finite floats, and that the corners are in the scene's box. *)
Require Import Reals ZArith Lia Lra Psatz Bool.
From Flocq Require Import Core BinarySingleNaN.
Require Import StacklessExact.Rounding StacklessExact.Triple StacklessExact.Filter StacklessExact.Range StacklessExact.Overflow
  StacklessExact.Division StacklessExact.Certain.
Open Scope R_scope.

Local Instance prec_53 : Prec_gt_0 53 := eq_refl.

(** * The code *)

(** The greater number: none is a NaN here, and the sign of a zero does not matter. *)
Definition fmax (x y : float) : float := if Bltb y x then x else y.
Definition vabs (v : fvec) : fvec := FVec (Babs (fx v)) (Babs (fy v)) (Babs (fz v)).
Definition vmax (v w : fvec) : fvec := FVec (fmax (fx v) (fx w)) (fmax (fy v) (fy w)) (fmax (fz v) (fz w)).
Definition max_element (v : fvec) : float := fmax (fmax (fx v) (fy v)) (fz v).

(** [Region::of] a box. That [reach] is found in single precision does not matter: it is one of the numbers. *)
Definition code_reach (lo hi : fvec) : float := max_element (vmax (vabs lo) (vabs hi)).
Definition code_size (lo hi : fvec) : float := max_element (fsub hi lo).

(** [Errors::of_scene], as [Exact::new] calls it: bounds of the components of d, s, e1 and e2. *)
Definition scene_d (d : fvec) : float := max_element (vabs d).
Definition scene_c (lo hi o : fvec) : float := plus (code_reach lo hi) (max_element (vabs o)).
Definition scene_e (lo hi : fvec) : float := code_size lo hi.

(** [Errors::of_triangle]: [greatest]. *)
Definition triangle_c (v0 o : fvec) : float := max_element (vabs (fsub o v0)).
Definition triangle_e (v0 v1 v2 : fvec) : float := fmax (max_element (vabs (fsub v1 v0))) (max_element (vabs (fsub v2 v0))).

(** * Greatest numbers *)

(** A finite float that is on a grid: 2^-149 for single precision. *)
Definition good (g e : Z) (x : float) (r : R) : Prop := fits e x r /\ multiple g r.

Lemma fmax_good g e x y a b : good g e x a -> good g e y b -> good g e (fmax x y) (Rmax a b).
Proof.
  intros [(Fx & <- & Bx) Mx] [(Fy & <- & By) My]. unfold fmax. rewrite Bltb_correct by assumption.
  destruct (Rlt_bool_spec (B2R y) (B2R x)).
  - rewrite Rmax_left by lra. now repeat split.
  - rewrite Rmax_right by lra. now repeat split.
Qed.

Lemma abs_good g e x a : good g e x a -> good g e (Babs x) (Rabs a).
Proof.
  intros [(F & V & B) M]. split; [split; [now rewrite is_finite_Babs|split]|].
  - now rewrite B2R_Babs, V.
  - now rewrite Rabs_Rabsolu.
  - unfold Rabs. destruct (Rcase_abs a); [now apply multiple_opp|exact M].
Qed.

Definition vgood (g e : Z) (v : fvec) (r : vec) : Prop := good g e (fx v) (vx r) /\ good g e (fy v) (vy r) /\ good g e (fz v) (vz r).

(** The greatest component of a vector. *)
Definition most (r : vec) : R := Rmax (Rmax (Rabs (vx r)) (Rabs (vy r))) (Rabs (vz r)).

Lemma most_bounds r : bounded (most r) r.
Proof.
  unfold most. pose proof (Rmax_l (Rmax (Rabs (vx r)) (Rabs (vy r))) (Rabs (vz r))). pose proof (Rmax_r (Rmax (Rabs (vx r)) (Rabs (vy r))) (Rabs (vz r))).
  pose proof (Rmax_l (Rabs (vx r)) (Rabs (vy r))). pose proof (Rmax_r (Rabs (vx r)) (Rabs (vy r))). repeat split; lra.
Qed.

Lemma most_good g e v r : vgood g e v r -> good g e (max_element (vabs v)) (most r).
Proof. intros (X & Y & Z). unfold max_element, vabs, most. cbn [fx fy fz]. repeat apply fmax_good; now apply abs_good. Qed.

Lemma real_good g t v : vfits t v (real v) -> vmultiple g (real v) -> vgood g t v (real v).
Proof. intros (X & Y & Z) (MX & MY & MZ). split; [|split]; now split. Qed.

Lemma difference_good g t v w : (-1022 <= g)%Z -> (0 <= t <= 300)%Z -> vfits t v (real v) -> vfits t w (real w) ->
  vmultiple g (real v) -> vmultiple g (real w) -> vgood g (t + 1) (fsub v w) (vsub R64 (real v) (real w)).
Proof.
  intros Hg Ht Fv Fw V W. pose proof (sub_fits t _ _ _ _ ltac:(lia) Fv Fw) as (X & Y & Z).
  destruct (vsub_same g (real v) (real w) Hg V W) as [E M].
  rewrite <- E in M. destruct M as (MX & MY & MZ). split; [|split]; now split.
Qed.

Lemma single_good v : v_single v -> vgood (-149) 128 v (real v).
Proof. intros S. apply real_good; [now apply v_fits|now apply v_multiple]. Qed.

Lemma sub_good v w : v_single v -> v_single w -> vgood (-149) 129 (fsub v w) (vsub R64 (real v) (real w)).
Proof. intros V W. apply (difference_good (-149) 128); try lia; try (now apply v_fits); now apply v_multiple. Qed.

(** * Bounds *)

(** What Certain.v supposes of bounds. *)
Definition suit (D C E : float) (v0 v1 v2 o d : fvec) : Prop :=
  (is_bound 128 D /\ is_bound 130 C /\ is_bound 129 E) /\ bounded (B2R D) (real d) /\ bounded (B2R C) (vsub R64 (real o) (real v0)) /\
  bounded (B2R E) (vsub R64 (real v1) (real v0)) /\ bounded (B2R E) (vsub R64 (real v2) (real v0)).

Lemma good_bound e e' x r : good (-149) e x r -> (e <= e')%Z -> is_bound e' x.
Proof. intros [F M] H. destruct (fits_more _ _ _ _ F H) as (Fx & <- & B). split; [now repeat split|exact M]. Qed.

Lemma good_value g e x r : good g e x r -> B2R x = r.
Proof. intros [(_ & V & _) _]. exact V. Qed.

Lemma bounded_more b b' r : bounded b r -> b <= b' -> bounded b' r.
Proof. intros (X & Y & Z) H. repeat split; lra. Qed.

Section Scene.
Variables v0 v1 v2 o d : fvec.
Hypothesis H0 : v_single v0.
Hypothesis H1 : v_single v1.
Hypothesis H2 : v_single v2.
Hypothesis Ho : v_single o.
Hypothesis Hd : v_single d.

(** The bounds for one triangle. [EXACT-6] *)
Theorem triangle_has_bounds : suit (scene_d d) (triangle_c v0 o) (triangle_e v0 v1 v2) v0 v1 v2 o d.
Proof.
  pose proof (most_good _ _ _ _ (single_good _ Hd)) as D. pose proof (most_good _ _ _ _ (sub_good _ _ Ho H0)) as C.
  pose proof (fmax_good _ _ _ _ _ _ (most_good _ _ _ _ (sub_good _ _ H1 H0)) (most_good _ _ _ _ (sub_good _ _ H2 H0))) as E.
  split; [split; [|split]|split; [|split; [|split]]].
  - apply (good_bound _ _ _ _ D). lia.
  - apply (good_bound _ _ _ _ C). lia.
  - apply (good_bound _ _ _ _ E). lia.
  - unfold scene_d. rewrite (good_value _ _ _ _ D). apply most_bounds.
  - unfold triangle_c. rewrite (good_value _ _ _ _ C). apply most_bounds.
  - unfold triangle_e. rewrite (good_value _ _ _ _ E). eapply bounded_more; [apply most_bounds|apply Rmax_l].
  - unfold triangle_e. rewrite (good_value _ _ _ _ E). eapply bounded_more; [apply most_bounds|apply Rmax_r].
Qed.

(** The scene's box, with the corners in it. *)
Variables lo hi : fvec.
Hypothesis Hlo : v_single lo.
Hypothesis Hhi : v_single hi.
Definition inside (v : fvec) : Prop :=
  B2R (fx lo) <= B2R (fx v) <= B2R (fx hi) /\ B2R (fy lo) <= B2R (fy v) <= B2R (fy hi) /\ B2R (fz lo) <= B2R (fz v) <= B2R (fz hi).
Hypothesis I0 : inside v0.
Hypothesis I1 : inside v1.
Hypothesis I2 : inside v2.

Lemma RN_mono x y : x <= y -> R64 x <= R64 y.
Proof. intros. apply round_le; try typeclasses eauto. assumption. Qed.

(** A rounded difference is at most the rounded bound of the exact one. *)
Lemma rounded_most x b : Rabs x <= b -> Rabs (R64 x) <= R64 b.
Proof. intros H. rewrite <- round_NE_abs by typeclasses eauto. now apply RN_mono. Qed.

(** The bounds for all triangles of a scene. [EXACT-6] *)
Theorem scene_has_bounds : suit (scene_d d) (scene_c lo hi o) (scene_e lo hi) v0 v1 v2 o d.
Proof.
  pose proof (most_good _ _ _ _ (single_good _ Hd)) as D. pose proof (most_good _ _ _ _ (single_good _ Ho)) as O.
  destruct (single_good _ Hlo) as (L1 & L2 & L3). destruct (single_good _ Hhi) as (U1 & U2 & U3).
  pose proof (fmax_good _ _ _ _ _ _ (fmax_good _ _ _ _ _ _ (fmax_good _ _ _ _ _ _ (abs_good _ _ _ _ L1) (abs_good _ _ _ _ U1))
    (fmax_good _ _ _ _ _ _ (abs_good _ _ _ _ L2) (abs_good _ _ _ _ U2))) (fmax_good _ _ _ _ _ _ (abs_good _ _ _ _ L3) (abs_good _ _ _ _ U3))) as Reach.
  match type of Reach with good _ _ _ ?r => set (reach := r) in * end.
  change (good (-149) 128 (code_reach lo hi) reach) in Reach.
  destruct (sub_good _ _ Hhi Hlo) as (S1 & S2 & S3). pose proof (fmax_good _ _ _ _ _ _ (fmax_good _ _ _ _ _ _ S1 S2) S3) as Size.
  match type of Size with good _ _ _ ?r => set (size := r) in * end. change (good (-149) 129 (scene_e lo hi) size) in Size.
  assert (C : good (-149) 129 (scene_c lo hi o) (R64 (reach + most (real o)))).
  { destruct Reach as [Fr Mr], O as [Fo Mo]. split; [exact (plus_fits 128 _ _ _ _ ltac:(lia) Fr Fo)|].
    destruct (same (-149) (reach + most (real o)) ltac:(lia)) as [-> M]; [grid|exact M]. }
  assert (Near : forall v, inside v -> bounded reach (real v)).
  { intros v (X & Y & Z). unfold reach. cbn [real vx vy vz] in *.
    assert (One : forall l x h, l <= x <= h -> Rabs x <= Rmax (Rabs l) (Rabs h)).
    { intros l x h H. pose proof (Rmax_l (Rabs l) (Rabs h)). pose proof (Rmax_r (Rabs l) (Rabs h)). split_Rabs; lra. }
    apply One in X, Y, Z. repeat split; cbn [real vx vy vz].
    - eapply Rle_trans; [exact X|]. eapply Rle_trans; [apply Rmax_l|apply Rmax_l].
    - eapply Rle_trans; [exact Y|]. eapply Rle_trans; [apply Rmax_r|apply Rmax_l].
    - eapply Rle_trans; [exact Z|]. apply Rmax_r. }
  assert (Long : forall v w, inside v -> inside w -> bounded size (vsub R64 (real v) (real w))).
  { intros v w (X & Y & Z) (X' & Y' & Z').
    assert (One : forall l h x x', l <= x <= h -> l <= x' <= h -> Rabs (R64 (x - x')) <= R64 (h - l)).
    { intros l h x x' A B. apply rounded_most. split_Rabs; lra. }
    pose proof (One _ _ _ _ X X'). pose proof (One _ _ _ _ Y Y'). pose proof (One _ _ _ _ Z Z').
    unfold size. cbn [vsub real vx vy vz] in *. repeat split; cbn [vsub real vx vy vz].
    - eapply Rle_trans; [eassumption|]. eapply Rle_trans; [apply Rmax_l|apply Rmax_l].
    - eapply Rle_trans; [eassumption|]. eapply Rle_trans; [apply Rmax_r|apply Rmax_l].
    - eapply Rle_trans; [eassumption|]. apply Rmax_r. }
  split; [split; [|split]|split; [|split; [|split]]].
  - apply (good_bound _ _ _ _ D). lia.
  - apply (good_bound _ _ _ _ C). lia.
  - apply (good_bound _ _ _ _ Size). lia.
  - unfold scene_d. rewrite (good_value _ _ _ _ D). apply most_bounds.
  - rewrite (good_value _ _ _ _ C). destruct (Near v0 I0) as (X & Y & Z). destruct (most_bounds (real o)) as (X' & Y' & Z').
    repeat split; cbn [vsub vx vy vz]; apply rounded_most; rewrite Rplus_comm; now apply sub_b.
  - rewrite (good_value _ _ _ _ Size). now apply Long.
  - rewrite (good_value _ _ _ _ Size). now apply Long.
Qed.
End Scene.

(** * The first two stages *)

(** What a stage with these bounds says of a triangle is so: a miss, a hit, its distance and its weights. *)
Definition right (D C E : float) (v0 v1 v2 o d : fvec) : Prop :=
  let c := code_of v0 v1 v2 o d in
  let truth := determinants_of exactly (real v0) (real v1) (real v2) (real o) (real d) in
  let between '(low, high) x := is_finite low = true /\ is_finite high = true /\ B2R low <= x <= B2R high in
  (code_is_miss (code_sign D C E) c = true -> ~ meets truth) /\
  (code_is_hit (code_sign D C E) c = true -> meets truth /\
    between (code_distance (code_t C E) (code_det D E) c) (top_t truth / det truth) /\
    between (code_weight (code_sign D C E) (code_det D E) c (f_u c)) (edge_u truth / det truth) /\
    between (code_weight (code_sign D C E) (code_det D E) c (f_v c)) (edge_v truth / det truth)).

Lemma suits_are_right D C E v0 v1 v2 o d : v_single v0 -> v_single v1 -> v_single v2 -> v_single o -> v_single d ->
  suit D C E v0 v1 v2 o d -> right D C E v0 v1 v2 o d.
Proof.
  intros H0 H1 H2 Ho Hd ((GD & GC & GE) & HD & HC & HE). split.
  - now apply miss_of_code.
  - intros H. split; [now apply hit_of_code with D C E|]. split.
    + exact (distance_of_code v0 v1 v2 o d H0 H1 H2 Ho Hd D C E GD GC GE HD HC HE H).
    + exact (weights_of_code v0 v1 v2 o d H0 H1 H2 Ho Hd D C E GD GC GE HD HC HE H).
Qed.

(** The first stage of [Exact], with bounds for the scene: for all finite floats. [EXACT-6, EXACT-9] *)
Theorem of_scene_is_right lo hi v0 v1 v2 o d : v_single lo -> v_single hi -> v_single v0 -> v_single v1 -> v_single v2 ->
  v_single o -> v_single d -> inside lo hi v0 -> inside lo hi v1 -> inside lo hi v2 ->
  right (scene_d d) (scene_c lo hi o) (scene_e lo hi) v0 v1 v2 o d.
Proof. intros. apply suits_are_right; try assumption. now apply scene_has_bounds. Qed.

(** The second, with bounds for the triangle. [EXACT-6, EXACT-9] *)
Theorem of_triangle_is_right v0 v1 v2 o d : v_single v0 -> v_single v1 -> v_single v2 -> v_single o -> v_single d ->
  right (scene_d d) (triangle_c v0 o) (triangle_e v0 v1 v2) v0 v1 v2 o d.
Proof. intros. apply suits_are_right; try assumption. now apply triangle_has_bounds. Qed.
