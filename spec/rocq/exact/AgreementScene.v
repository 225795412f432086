(** The first stage of [Exact] as it runs, from the box of the scene to the two decisions: Region_of, Exact_new, Determinants_of,
    Determinants_is_miss and Determinants_is_hit of Operations.v, for all finite floats of single precision. *)
Require Import Reals ZArith Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN.
Require Import StacklessExact.Rounding StacklessExact.Triple StacklessExact.Filter StacklessExact.Overflow StacklessExact.Division
  StacklessExact.Certain StacklessExact.Scene StacklessExact.Arithmetic StacklessExact.Operations StacklessExact.Agreement.
Open Scope R_scope.

Local Existing Instances Arithmetic.prec_24 Arithmetic.emax_128 Arithmetic.prec_53 Arithmetic.emax_1024.

Notation finite := BinarySingleNaN.is_finite.
Notation single := (binary_float 24 128).
Notation widen := f64_of_f32.

(** * Reading single precision as double *)

Lemma single_format (x : single) : generic_format radix2 (FLT_exp (-149) 24) (B2R x).
Proof. exact (generic_format_B2R 24 128 x). Qed.

Lemma widen_correct (x : single) : finite x = true ->
  finite (widen x) = true /\ B2R (widen x : Overflow.float) = B2R x /\ Bsign (widen x : Overflow.float) = Bsign x.
Proof.
  intros F. destruct x as [s| | |s m e H]; try discriminate F; [repeat split|].
  pose proof (single_format (B754_finite s m e H)) as G. pose proof (abs_B2R_lt_emax 24 128 (B754_finite s m e H)) as B.
  unfold f64_of_f32, convert. set (x := B2R (B754_finite s m e H)) in *.
  pose proof (binary_normalize_correct 53 1024 _ _ mode_NE (cond_Zopp s (Zpos m)) e s) as C. fold x in C.
  change (F2R (Float radix2 (cond_Zopp s (Zpos m)) e)) with x in C. cbv zeta in C.
  assert (R : round radix2 (SpecFloat.fexp 53 1024) (round_mode mode_NE) x = x).
  { apply round_generic; [typeclasses eauto|]. apply FLT_format_generic in G; [|typeclasses eauto]. destruct G as [f Ef Hm He].
    change (SpecFloat.fexp 53 1024) with (FLT_exp (-1074) 53). apply generic_format_FLT. exists f; [exact Ef| |lia].
    eapply Z.lt_trans; [exact Hm|reflexivity]. }
  rewrite R in C. rewrite Rlt_bool_true in C by (eapply Rlt_trans; [exact B|apply bpow_lt; lia]).
  destruct C as (V & Fi & S). split; [exact Fi|split; [exact V|]]. rewrite S. unfold x. simpl B2R. destruct s; simpl.
  - rewrite Rcompare_Lt; [reflexivity|]. apply F2R_lt_0. reflexivity.
  - rewrite Rcompare_Gt; [reflexivity|]. apply F2R_gt_0. reflexivity.
Qed.

Lemma widen_single (x : single) : finite x = true -> is_single (widen x).
Proof.
  intros F. destruct (widen_correct x F) as (F' & V & _). split; [exact F'|split]; rewrite V; [apply single_format|].
  exact (abs_B2R_lt_emax 24 128 x).
Qed.

(** The greater one, and magnitudes. *)
Definition greater (x y : single) : single := if Bltb y x then x else y.

Lemma greater_finite x y : finite x = true -> finite y = true -> finite (greater x y) = true.
Proof. intros. unfold greater. now destruct (Bltb y x). Qed.

Lemma abs_finite (x : single) : finite x = true -> finite (Babs x) = true.
Proof. now rewrite is_finite_Babs. Qed.

Lemma widen_greater x y : finite x = true -> finite y = true -> widen (greater x y) = fmax (widen x) (widen y).
Proof.
  intros X Y. destruct (widen_correct x X) as (X' & VX & _), (widen_correct y Y) as (Y' & VY & _). unfold greater, fmax.
  rewrite !Bltb_correct by assumption. rewrite VX, VY. now destruct (Rlt_bool _ _).
Qed.

Lemma widen_abs (x : single) : finite x = true -> widen (Babs x) = Babs (widen x : Overflow.float).
Proof.
  intros X. destruct (widen_correct x X) as (X' & V & S). destruct (widen_correct (Babs x) (abs_finite x X)) as (A & VA & SA).
  apply B2R_Bsign_inj; [exact A|now rewrite is_finite_Babs| |].
  - now rewrite VA, !B2R_Babs, V.
  - now rewrite SA, !Bsign_Babs.
Qed.

(** A factor of 1. *)
Lemma times_one (x : Overflow.float) : finite x = true -> times f64 x (Arithmetic.constant f64 1 0) = x.
Proof.
  intros F. assert (One : B2R (Arithmetic.constant f64 1 0 : Overflow.float) = 1 /\ finite (Arithmetic.constant f64 1 0 : Overflow.float) = true).
  { destruct (constant_fits 1 0) as [Fi V]; [reflexivity|lia|]. split; [|exact Fi]. etransitivity; [exact V|]. simpl. ring. }
  destruct One as [V1 F1]. generalize (Bmult_correct 53 1024 _ _ mode_NE x (Arithmetic.constant f64 1 0)). rewrite V1, Rmult_1_r.
  rewrite round_generic; [|typeclasses eauto|apply generic_format_B2R].
  rewrite Rlt_bool_true by apply abs_B2R_lt_emax. rewrite F, F1. intros (V & Fi & S).
  apply B2R_Bsign_inj; [exact Fi|exact F|exact V|].
  etransitivity; [apply S|]. { now destruct (Bmult _ _ _). } replace (Bsign (Arithmetic.constant f64 1 0 : Overflow.float)) with false by reflexivity.
  now destruct (Bsign x).
Qed.

(** * Vectors *)

Record vector : Type := Vector { sx : single; sy : single; sz : single }.
Definition v_finite (v : vector) : Prop := finite (sx v) = true /\ finite (sy v) = true /\ finite (sz v) = true.
Definition wide (v : vector) : fvec := FVec (widen (sx v)) (widen (sy v)) (widen (sz v)).
Definition true_vector (v : vector) : vec := Vec (B2R (sx v)) (B2R (sy v)) (B2R (sz v)).

Lemma wide_single v : v_finite v -> v_single (wide v).
Proof. intros (X & Y & Z). split; [|split]; now apply widen_single. Qed.

Lemma real_wide v : v_finite v -> real (wide v) = true_vector v.
Proof.
  intros (X & Y & Z). unfold real, true_vector, wide. cbn [fx fy fz].
  destruct (widen_correct _ X) as (_ & -> & _), (widen_correct _ Y) as (_ & -> & _), (widen_correct _ Z) as (_ & -> & _). reflexivity.
Qed.

Definition greatest_of (v : vector) : single := greater (greater (Babs (sx v)) (Babs (sy v))) (Babs (sz v)).

Lemma widen_greatest v : v_finite v -> widen (greatest_of v) = max_element (vabs (wide v)).
Proof.
  intros (X & Y & Z). unfold greatest_of, max_element, vabs, wide. cbn [fx fy fz].
  now rewrite !widen_greater, !widen_abs by auto using abs_finite, greater_finite.
Qed.

(** * The functions *)

(** [Region::of]. [EXACT-6] *)
Theorem region_agrees lo hi : v_finite lo -> v_finite hi ->
  Region_of f32 f64 widen (sx lo) (sy lo) (sz lo) (sx hi) (sy hi) (sz hi) = (code_reach (wide lo) (wide hi), code_size (wide lo) (wide hi)).
Proof.
  intros L H. pose proof L as (L1 & L2 & L3). pose proof H as (H1 & H2 & H3).
  assert (Reach : widen (greater (greater (greater (Babs (sx lo)) (Babs (sx hi))) (greater (Babs (sy lo)) (Babs (sy hi))))
    (greater (Babs (sz lo)) (Babs (sz hi)))) = code_reach (wide lo) (wide hi)).
  { unfold code_reach, max_element, vmax, vabs, wide. cbn [fx fy fz].
    now rewrite !widen_greater, !widen_abs by auto using abs_finite, greater_finite. }
  assert (Finite : finite (code_reach (wide lo) (wide hi)) = true).
  { rewrite <- Reach. apply widen_correct. auto 10 using abs_finite, greater_finite. }
  destruct (sub_good _ _ (wide_single _ H) (wide_single _ L)) as (S1 & S2 & S3).
  pose proof (fmax_good _ _ _ _ _ _ (fmax_good _ _ _ _ _ _ S1 S2) S3) as [(Size & _) _].
  unfold Region_of. cbv zeta. f_equal.
  - etransitivity; [apply times_one|exact Reach]. rewrite <- Reach in Finite. exact Finite.
  - apply times_one. exact Size.
Qed.

(** [Exact::new]. [EXACT-6] *)
Theorem exact_new_agrees o d reach size : v_finite o -> v_finite d ->
  Exact_new f32 f64 widen (sx o) (sy o) (sz o) (sx d) (sy d) (sz d) reach size =
  let c := Overflow.plus reach (max_element (vabs (wide o))) in
  (fx (wide o), fy (wide o), fz (wide o), fx (wide d), fy (wide d), fz (wide d),
   code_sign (scene_d (wide d)) c size, code_det (scene_d (wide d)) size, code_t c size).
Proof.
  intros O D. unfold Exact_new, Errors_of_scene. cbv zeta. rewrite errors_agree.
  unfold scene_d. rewrite <- (widen_greatest o O), <- (widen_greatest d D). reflexivity.
Qed.

(** What the first stage says: a miss, a hit. *)
Definition first_stage (lo hi v0 v1 v2 o d : vector) : bool * bool :=
  let '(reach, size) := Region_of f32 f64 widen (sx lo) (sy lo) (sz lo) (sx hi) (sy hi) (sz hi) in
  let '(ox, oy, oz, dx, dy, dz, sign, _, _) := Exact_new f32 f64 widen (sx o) (sy o) (sz o) (sx d) (sy d) (sz d) reach size in
  let '(det, u, v, w, _) := Determinants_of f64 (fx (wide v0)) (fy (wide v0)) (fz (wide v0)) (fx (wide v1)) (fy (wide v1)) (fz (wide v1))
    (fx (wide v2)) (fy (wide v2)) (fz (wide v2)) ox oy oz dx dy dz in
  (Determinants_is_miss f64 det u v w sign, Determinants_is_hit f64 det u v w sign).

Definition between (lo v hi : vector) : Prop :=
  B2R (sx lo) <= B2R (sx v) <= B2R (sx hi) /\ B2R (sy lo) <= B2R (sy v) <= B2R (sy hi) /\ B2R (sz lo) <= B2R (sz v) <= B2R (sz hi).

Lemma between_inside lo v hi : v_finite lo -> v_finite v -> v_finite hi -> between lo v hi -> inside (wide lo) (wide hi) (wide v).
Proof.
  intros (L1 & L2 & L3) (V1 & V2 & V3) (H1 & H2 & H3) (X & Y & Z). unfold inside, wide. cbn [fx fy fz].
  rewrite !(fun x F => proj1 (proj2 (widen_correct x F))) by assumption. now repeat split.
Qed.

(** The code, printed from its source, is right about all finite floats: its miss is one, and its hit is one. [EXACT-6] *)
Theorem first_stage_is_right lo hi v0 v1 v2 o d : v_finite lo -> v_finite hi -> v_finite v0 -> v_finite v1 -> v_finite v2 ->
  v_finite o -> v_finite d -> between lo v0 hi -> between lo v1 hi -> between lo v2 hi ->
  let truth := determinants_of exactly (true_vector v0) (true_vector v1) (true_vector v2) (true_vector o) (true_vector d) in
  let '(is_miss, is_hit) := first_stage lo hi v0 v1 v2 o d in (is_miss = true -> ~ meets truth) /\ (is_hit = true -> meets truth).
Proof.
  intros L H F0 F1 F2 O D B0 B1 B2. cbv zeta. unfold first_stage. rewrite region_agrees by assumption. rewrite exact_new_agrees by assumption.
  cbv beta iota zeta. rewrite determinants_agree. cbv beta iota zeta. rewrite is_miss_agrees, is_hit_agrees.
  pose proof (of_scene_is_right (wide lo) (wide hi) (wide v0) (wide v1) (wide v2) (wide o) (wide d)) as R.
  specialize (R (wide_single _ L) (wide_single _ H) (wide_single _ F0) (wide_single _ F1) (wide_single _ F2) (wide_single _ O) (wide_single _ D)
    (between_inside _ _ _ L F0 H B0) (between_inside _ _ _ L F1 H B1) (between_inside _ _ _ L F2 H B2)).
  destruct R as [Miss Hit]. rewrite !real_wide in Miss, Hit by assumption. split; [exact Miss|]. intros E. exact (proj1 (Hit E)).
Qed.
