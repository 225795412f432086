(** The second stage of [Exact64], src/geom/kernel/exact/double.rs: double-precision data whose numbers are 0 or between 2^-200 and
    2^200 in magnitude. Misses and hits by the bounds for a triangle; not the distance. *)
Require Import Reals ZArith Lia Lra Psatz Bool.
From Flocq Require Import Core BinarySingleNaN.
Require Import StacklessExact.Rounding StacklessExact.Triple StacklessExact.Filter StacklessExact.Range StacklessExact.Overflow
  StacklessExact.Certain StacklessExact.Scene.
Open Scope R_scope.

Local Instance prec_53 : Prec_gt_0 53 := eq_refl.

(** [is_usual]: USUAL is from 2^-200 to 2^200. *)
Definition is_usual (x : float) : Prop :=
  is_finite x = true /\ (B2R x = 0 \/ bpow radix2 (-200) <= Rabs (B2R x) <= bpow radix2 200).
Definition v_usual (v : fvec) : Prop := is_usual (fx v) /\ is_usual (fy v) /\ is_usual (fz v).

Lemma usual_fits x : is_usual x -> fits 200 x (B2R x).
Proof. intros (F & H). split; [exact F|split; [reflexivity|]]. destruct H as [-> |H]; [rewrite Rabs_R0; apply bpow_ge_0|apply H]. Qed.

(** The last bit of such a number is at 2^-252 or above. *)
Lemma usual_multiple x : is_usual x -> multiple (-252) (B2R x).
Proof.
  intros (F & [-> |[H _]]); [apply multiple_0|]. pose proof (generic_format_B2R 53 1024 x) as G.
  change (SpecFloat.fexp 53 1024) with (FLT_exp (-1074) 53) in G. unfold generic_format in G.
  set (m := Ztrunc _) in G. set (e := cexp _ _ _) in G.
  assert (E : (-252 <= e)%Z).
  { unfold e, cexp, FLT_exp. assert (-199 <= mag radix2 (B2R x))%Z; [|lia]. apply (mag_ge_bpow radix2 _ (-199)). exact H. }
  rewrite G. unfold F2R. simpl Fnum. simpl Fexp. exists (m * 2 ^ (e + 252))%Z.
  rewrite mult_IZR, (IZR_Zpower radix2) by lia. rewrite Rmult_assoc, <- bpow_plus. do 2 f_equal. lia.
Qed.

Lemma v_usual_fits v : v_usual v -> vfits 200 v (real v).
Proof. intros (X & Y & Z). split; [|split]; now apply usual_fits. Qed.
Lemma v_usual_multiple v : v_usual v -> vmultiple (-252) (real v).
Proof. intros (X & Y & Z). repeat split; now apply usual_multiple. Qed.

(** Nothing over- or underflows: every result is finite, is what Filter.v says, and is at most 2^607. [EXACT-7] *)
Theorem usual_determinants v0 v1 v2 o d : v_usual v0 -> v_usual v1 -> v_usual v2 -> v_usual o -> v_usual d ->
  let c := code_of v0 v1 v2 o d in
  let x := determinants_of RX (real v0) (real v1) (real v2) (real o) (real d) in
  fits 605 (f_det c) (det x) /\ fits 605 (f_u c) (edge_u x) /\ fits 605 (f_v c) (edge_v x) /\
  fits 607 (f_w c) (edge_w x) /\ fits 606 (f_t c) (top_t x).
Proof.
  intros H0 H1 H2 Ho Hd. cbv zeta. rewrite <- (determinants_do_not_underflow (-252) ltac:(lia)) by now apply v_usual_multiple.
  apply (code_fits 200); try lia; now apply v_usual_fits.
Qed.

(** The second stage of [Exact64] is right about misses and hits. [EXACT-7] *)
Theorem usual_triangle_is_right v0 v1 v2 o d : v_usual v0 -> v_usual v1 -> v_usual v2 -> v_usual o -> v_usual d ->
  let c := code_of v0 v1 v2 o d in
  let sign := code_sign (scene_d d) (triangle_c v0 o) (triangle_e v0 v1 v2) in
  let truth := determinants_of exactly (real v0) (real v1) (real v2) (real o) (real d) in
  (code_is_miss sign c = true -> ~ meets truth) /\ (code_is_hit sign c = true -> meets truth).
Proof.
  intros H0 H1 H2 Ho Hd. cbv zeta.
  assert (Diff : forall v w, v_usual v -> v_usual w -> vgood (-252) 201 (fsub v w) (vsub R64 (real v) (real w))).
  { intros v w V W. apply (difference_good (-252) 200); try lia; try (now apply v_usual_fits); now apply v_usual_multiple. }
  pose proof (most_good _ _ _ _ (real_good (-252) 200 d (v_usual_fits _ Hd) (v_usual_multiple _ Hd))) as D.
  pose proof (most_good _ _ _ _ (Diff _ _ Ho H0)) as C.
  pose proof (fmax_good _ _ _ _ _ _ (most_good _ _ _ _ (Diff _ _ H1 H0)) (most_good _ _ _ _ (Diff _ _ H2 H0))) as E.
  change (good (-252) 200 (scene_d d) (most (real d))) in D.
  change (good (-252) 201 (triangle_c v0 o) (most (vsub R64 (real o) (real v0)))) in C.
  match type of E with good _ _ _ ?r => set (e := r) in *; change (good (-252) 201 (triangle_e v0 v1 v2) e) in E end.
  assert (VD := good_value _ _ _ _ D). assert (VC := good_value _ _ _ _ C). assert (VE := good_value _ _ _ _ E).
  assert (error : fits 558 (code_sign (scene_d d) (triangle_c v0 o) (triangle_e v0 v1 v2))
    (error_sign R64 u (B2R (scene_d d)) (B2R (triangle_c v0 o)) (B2R (triangle_e v0 v1 v2)))).
  { rewrite VD, VC, VE. destruct D as [D _], C as [C _], E as [E _].
    apply (sign_fits 200); [lia|exact D|exact (fits_more _ 202 _ _ C ltac:(lia))|exact E]. }
  pose proof (code_fits 200 v0 v1 v2 o d _ _ _ _ _ ltac:(lia) (v_usual_fits _ H0) (v_usual_fits _ H1) (v_usual_fits _ H2)
    (v_usual_fits _ Ho) (v_usual_fits _ Hd)) as values. cbv zeta in values.
  assert (GD : multiple (-252) (B2R (scene_d d))) by (rewrite VD; apply D).
  assert (GC : multiple (-252) (B2R (triangle_c v0 o))) by (rewrite VC; apply C).
  assert (GE : multiple (-252) (B2R (triangle_e v0 v1 v2))) by (rewrite VE; apply E).
  assert (HD : bounded (B2R (scene_d d)) (real d)) by (rewrite VD; apply most_bounds).
  assert (HC : bounded (B2R (triangle_c v0 o)) (vsub R64 (real o) (real v0))) by (rewrite VC; apply most_bounds).
  assert (HE : bounded (B2R (triangle_e v0 v1 v2)) (vsub R64 (real v1) (real v0)) /\
    bounded (B2R (triangle_e v0 v1 v2)) (vsub R64 (real v2) (real v0))).
  { rewrite VE. split; (eapply bounded_more; [apply most_bounds|]); [apply Rmax_l|apply Rmax_r]. }
  split.
  - exact (miss_where_it_fits (-252) ltac:(lia) v0 v1 v2 o d (v_usual_multiple _ H0) (v_usual_multiple _ H1) (v_usual_multiple _ H2)
      (v_usual_multiple _ Ho) (v_usual_multiple _ Hd) _ _ _ GD GC GE HD HC HE _ _ _ _ _ _ values error).
  - exact (hit_where_it_fits (-252) ltac:(lia) v0 v1 v2 o d (v_usual_multiple _ H0) (v_usual_multiple _ H1) (v_usual_multiple _ H2)
      (v_usual_multiple _ Ho) (v_usual_multiple _ Hd) _ _ _ GD GC GE HD HC HE _ _ _ _ _ _ values error).
Qed.
