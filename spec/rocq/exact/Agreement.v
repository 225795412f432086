(** The theorems are about the operations that run: each definition of Operations.v, which is printed from the library's source, is the
    one that a theorem is about. *)
Require Import Reals ZArith Lia Lra Bool List.
From Flocq Require Import Core BinarySingleNaN.
Require StacklessExact.Slabs StacklessExact.TwoSided StacklessExact.Expansion.
Require Import StacklessExact.Rounding StacklessExact.Triple StacklessExact.Filter StacklessExact.Arithmetic StacklessExact.Operations.
Require StacklessExact.Overflow StacklessExact.Division StacklessExact.Certain StacklessExact.Scene StacklessExact.Usual.
Import Overflow Division Certain Scene. Import Arithmetic.
Open Scope R_scope.

Local Existing Instances Arithmetic.prec_24 Arithmetic.emax_128 Arithmetic.prec_53 Arithmetic.emax_1024.

(** Both sides written out are the same. *)
Ltac expand := cbv [
  f32 f64 ieee reals num plus minus times over opposite absolute less at_most equal Arithmetic.is_finite is_negative Arithmetic.constant
  Arithmetic.infinity shifted
  Arithmetic.prec_24 Arithmetic.emax_128 Arithmetic.prec_53 Arithmetic.emax_1024
  Overflow.prec_24 Overflow.prec_53 Overflow.emax_1024
  Overflow.plus Overflow.minus Overflow.times Overflow.over Overflow.constant
  fx fy fz fsub fcross fdot f_det f_u f_v f_w f_t code_of vx vy vz vsub cross dot det edge_u edge_v edge_w top_t determinants_of].
Ltac same := intros; expand; reflexivity.

(** * Determinants, in double precision *)

(** [Determinants::of]. [EXACT-6] *)
Theorem determinants_agree v0 v1 v2 o d :
  Determinants_of f64 (fx v0) (fy v0) (fz v0) (fx v1) (fy v1) (fz v1) (fx v2) (fy v2) (fz v2) (fx o) (fy o) (fz o) (fx d) (fy d) (fz d) =
  let c := code_of v0 v1 v2 o d in (f_det c, f_u c, f_v c, f_w c, f_t c).
Proof. unfold Determinants_of. same. Qed.

(** And with any rounding: EXACT-1, where there is none. [EXACT-1, EXACT-4] *)
Theorem rounded_determinants_agree RN v0 v1 v2 o d :
  Determinants_of (reals RN) (vx v0) (vy v0) (vz v0) (vx v1) (vy v1) (vz v1) (vx v2) (vy v2) (vz v2) (vx o) (vy o) (vz o)
    (vx d) (vy d) (vz d) =
  let c := determinants_of RN v0 v1 v2 o d in (det c, edge_u c, edge_v c, edge_w c, top_t c).
Proof. unfold Determinants_of. same. Qed.

(** Constants: products of literals are what the theorems write. *)
Ltac constants := apply B2SF_inj; vm_compute; reflexivity.
Lemma sign_constant : times f64 (constant f64 78 0) (filter_UNIT f64) = constant f64 78 (-53).
Proof. constants. Qed.
Lemma det_constant : times f64 (times f64 (constant f64 31 0) (filter_UNIT f64)) (bounds_QUOTIENT_FACTOR f64) = constant f64 (31 * 5) (-55).
Proof. constants. Qed.
Lemma t_constant : times f64 (times f64 (constant f64 35 0) (filter_UNIT f64)) (bounds_QUOTIENT_FACTOR f64) = constant f64 (35 * 5) (-55).
Proof. constants. Qed.
Lemma quotient_constant : times f64 (constant f64 4 0) (filter_UNIT f64) = constant f64 4 (-53).
Proof. constants. Qed.
Lemma factor_constant : bounds_QUOTIENT_FACTOR f64 = constant f64 5 (-2).
Proof. constants. Qed.

(** [Errors::new]. [EXACT-6, EXACT-9] *)
Theorem errors_agree d c e : Errors_new f64 d c e = (code_sign d c e, code_det d e, code_t c e).
Proof. unfold Errors_new. rewrite sign_constant, det_constant, t_constant. unfold code_sign, code_det, code_t. same. Qed.

(** * Decisions and quotients *)

Section Decisions.
Variable c : code.
Variables sign error_det error_t : Overflow.float.

(** [is_miss]. [EXACT-6] *)
Theorem is_miss_agrees : Determinants_is_miss f64 (f_det c) (f_u c) (f_v c) (f_w c) sign = code_is_miss sign c.
Proof. unfold Determinants_is_miss, code_is_miss, code_front, andb. same. Qed.

(** [is_hit]. [EXACT-6] *)
Theorem is_hit_agrees : Determinants_is_hit f64 (f_det c) (f_u c) (f_v c) (f_w c) sign = code_is_hit sign c.
Proof. unfold Determinants_is_hit, code_is_hit, code_front. same. Qed.

(** [over_determinant]. [EXACT-9] *)
Theorem over_determinant_agrees det numerator error :
  Determinants_over_determinant f64 det numerator error error_det = code_over numerator error det error_det.
Proof. unfold Determinants_over_determinant. rewrite quotient_constant. unfold code_over. same. Qed.

(** [distance]. [EXACT-9] *)
Theorem distance_agrees : Determinants_distance f64 (f_det c) (f_t c) error_det error_t = code_distance error_t error_det c.
Proof. unfold Determinants_distance. rewrite over_determinant_agrees. unfold code_distance. now destruct (code_over _ _ _ _). Qed.

(** [weights]. [EXACT-9] *)
Theorem weights_agree :
  let '(u_low, u_high, v_low, v_high) := Determinants_weights f64 (f_det c) (f_u c) (f_v c) sign error_det in
  (u_low, u_high) = code_weight sign error_det c (f_u c) /\ (v_low, v_high) = code_weight sign error_det c (f_v c).
Proof.
  unfold Determinants_weights, code_weight. rewrite factor_constant, !over_determinant_agrees.
  change (times f64 sign (constant f64 5 (-2))) with (Overflow.times sign (Overflow.constant 5 (-2))).
  destruct (code_over (f_u c) _ _ _), (code_over (f_v c) _ _ _). now split.
Qed.
End Decisions.

(** * Bounds of the components *)

(** [Errors::of_triangle]. [EXACT-6] *)
Theorem triangle_agrees v0 v1 v2 o d :
  Errors_of_triangle f64 (fx v0) (fy v0) (fz v0) (fx v1) (fy v1) (fz v1) (fx v2) (fy v2) (fz v2) (fx o) (fy o) (fz o)
    (fx d) (fy d) (fz d) =
  let c := triangle_c v0 o in let e := triangle_e v0 v1 v2 in (code_sign (scene_d d) c e, code_det (scene_d d) e, code_t c e).
Proof.
  unfold Errors_of_triangle. rewrite errors_agree. unfold scene_d, triangle_c, triangle_e, max_element, fmax, vabs. same.
Qed.
