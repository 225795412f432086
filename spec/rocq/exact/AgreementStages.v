(** What is left: which rays the tests are for, and the stage in single precision. *)
Require Import Reals ZArith Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Mult_error.
Require Import StacklessExact.Rounding StacklessExact.Triple StacklessExact.Filter StacklessExact.Overflow StacklessExact.Arithmetic
  StacklessExact.Operations.
Require StacklessExact.Floor.
Open Scope R_scope.

Local Existing Instances Arithmetic.prec_24 Arithmetic.emax_128 Arithmetic.prec_53 Arithmetic.emax_1024.

(** * The stage in single precision *)

Notation R32 := Floor.R32.
Notation rounded := (reals R32).

(** The greatest components, in the order of the code. *)
Definition size (v : vec) : R := Rmax (Rmax (Rabs (vx v)) (Rabs (vy v))) (Rabs (vz v)).
Definition size_of_two (v w : vec) : R :=
  Rmax (Rmax (Rmax (Rabs (vx v)) (Rabs (vx w))) (Rmax (Rabs (vy v)) (Rabs (vy w)))) (Rmax (Rabs (vz v)) (Rabs (vz w))).

Lemma size_format a b : Floor.F (size (vsub R32 a b)).
Proof.
  assert (M : forall x y, Floor.F x -> Floor.F y -> Floor.F (Rmax x y)) by (intros x y X Y; unfold Rmax; now destruct (Rle_dec x y)).
  repeat apply M; apply generic_format_abs, Floor.F_32.
Qed.

(** The constant that [ExactFromSingle::new] multiplies the direction's size with. [EXACT-5] *)
Theorem bound_agrees : B2R (times f32 (Arithmetic.constant f32 39 0) (single_UNIT f32) : binary_float 24 128) = 39 * / 16777216.
Proof.
  replace (times f32 (Arithmetic.constant f32 39 0) (single_UNIT f32)) with (Arithmetic.constant f32 39 (-24))
    by (apply B2SF_inj; vm_compute; reflexivity).
  rewrite <- SF2R_B2SF. replace (B2SF _) with (SpecFloat.S754_finite false 10223616 (-42)) by (vm_compute; reflexivity).
  unfold SF2R, F2R. simpl. lra.
Qed.

(** What [misses] computes, with any rounding. *)
Section Misses.
Variable RN : R -> R.
Notation any := (reals RN).

Lemma greater_is x y : (if less any y x then x else y) = Rmax x y.
Proof. cbn [reals less]. case Rlt_bool_spec; intros; [rewrite Rmax_left|rewrite Rmax_right]; lra. Qed.
Lemma lesser_is x y : (if less any x y then x else y) = Rmin x y.
Proof. cbn [reals less]. case Rlt_bool_spec; intros; [rewrite Rmin_left|rewrite Rmin_right]; lra. Qed.

Lemma misses_are v0 v1 v2 o d bound :
  ExactFromSingle_misses any (vx o) (vy o) (vz o) (vx d) (vy d) (vz d) bound
    (vx v0) (vy v0) (vz v0) (vx v1) (vy v1) (vz v1) (vx v2) (vy v2) (vz v2) =
  let x := determinants_of RN v0 v1 v2 o d in
  let e := Rmax (size_of_two (vsub RN v1 v0) (vsub RN v2 v0)) (1 * bpow radix2 (-60)) in
  let delta := RN (RN (bound * e) * RN (RN (1 * bpow radix2 1 * size (vsub RN o v0)) + e)) in
  andb (Rlt_bool (Rmin (Rmin (edge_u x) (edge_v x)) (edge_w x)) (- delta)) (Rlt_bool delta (Rmax (Rmax (edge_u x) (edge_v x)) (edge_w x))).
Proof.
  unfold ExactFromSingle_misses. cbv zeta. rewrite !greater_is, !lesser_is. reflexivity.
Qed.
End Misses.

(** [ExactFromSingle::misses], with the bound that [new] gives it: what it says is what Floor.v supposes. [EXACT-5] *)
Theorem misses_agrees v0 v1 v2 o d D :
  ExactFromSingle_misses rounded (vx o) (vy o) (vz o) (vx d) (vy d) (vz d) (R32 (39 * (/ 16777216) * D))
    (vx v0) (vy v0) (vz v0) (vx v1) (vy v1) (vz v1) (vx v2) (vy v2) (vz v2) = true ->
  Floor.misses (determinants_of R32 v0 v1 v2 o d) D (size (vsub R32 o v0)) (Rmax (size_of_two (vsub R32 v1 v0) (vsub R32 v2 v0)) (bpow radix2 (-60))).
Proof.
  rewrite misses_are. cbv zeta. rewrite !Rmult_1_l. change (bpow radix2 1) with 2.
  set (C := size (vsub R32 o v0)). set (E := Rmax (size_of_two _ _) _). set (x := determinants_of R32 v0 v1 v2 o d).
  assert (Twice : R32 (2 * C) = 2 * C).
  { apply round_generic; [typeclasses eauto|]. rewrite Rmult_comm. change 2 with (bpow radix2 1).
    apply mult_bpow_pos_exact_FLT; [apply size_format|lia]. }
  rewrite Twice. fold (Floor.delta D C E). intros H. apply andb_prop in H as [L H].
  apply ltb_true in L, H. split; fold x.
  - destruct (Rlt_or_le (edge_u x) (- Floor.delta D C E)); [now left|]. destruct (Rlt_or_le (edge_v x) (- Floor.delta D C E)); [now right; left|].
    right; right. revert L. unfold Rmin. repeat destruct (Rle_dec _ _); lra.
  - destruct (Rlt_or_le (Floor.delta D C E) (edge_u x)); [now left|]. destruct (Rlt_or_le (Floor.delta D C E) (edge_v x)); [now right; left|].
    right; right. revert H. unfold Rmax. repeat destruct (Rle_dec _ _); lra.
Qed.
