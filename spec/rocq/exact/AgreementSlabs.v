(** The slab tests: what Slabs.v and TwoSided.v are about is what Operations.v has, for both boxes of a pair. *)
Require Import Reals ZArith Lia Lra Bool List.
From Flocq Require Import Core BinarySingleNaN.
Require StacklessExact.Slabs StacklessExact.TwoSided.
Require Import StacklessExact.Arithmetic StacklessExact.Operations.
Open Scope R_scope.

Local Existing Instances Arithmetic.prec_24 Arithmetic.emax_128 Arithmetic.prec_53 Arithmetic.emax_1024.

(** * Constants *)

Lemma zero_32 : constant f32 0 0 = Slabs.zero 24 128.
Proof. reflexivity. Qed.
Lemma zero_64 : constant f64 0 0 = Slabs.zero 53 1024.
Proof. reflexivity. Qed.
Lemma one_32 : constant f32 1 0 = Slabs.one 24 128 prec_24 emax_128.
Proof. apply B2SF_inj. vm_compute. reflexivity. Qed.
Lemma one_64 : constant f64 1 0 = Slabs.one 53 1024 prec_53 emax_1024.
Proof. apply B2SF_inj. vm_compute. reflexivity. Qed.
Lemma down_agrees : Centred_DOWN f32 = TwoSided.down.
Proof. apply B2SF_inj. vm_compute. reflexivity. Qed.
Lemma up_agrees : Centred_UP f32 = TwoSided.up.
Proof. apply B2SF_inj. vm_compute. reflexivity. Qed.

Ltac expand := cbv [
  f32 f64 ieee num plus minus times over opposite absolute less at_most equal Arithmetic.is_finite is_negative Arithmetic.infinity
  shifted shifted_float Z.ltb Z.compare Z.abs_nat Pos.to_nat Pos.iter_op Nat.add Nat.iter nat_rect
  Arithmetic.prec_24 Arithmetic.emax_128 Arithmetic.prec_53 Arithmetic.emax_1024 TwoSided.prec_24 TwoSided.emax_128
  Slabs.minus Slabs.times Slabs.lesser Slabs.greater Slabs.narrow Slabs.near_and_far Slabs.moved Slabs.infinity TwoSided.narrow_by
  fold_left fst snd].

(** * One axis *)

(** A turn of the loop, with any two reciprocals. *)
Definition turn (a : arithmetic) (ends : num a * num a) (axis : num a * num a * num a * num a * num a) : num a * num a :=
  let '(near, far) := ends in
  let '(o, lo, hi, i, j) := axis in
  let t1 := times a (minus a lo o) i in
  let t2 := times a (minus a hi o) j in
  let first := if less a t2 t1 then t2 else t1 in
  let last := if less a t2 t1 then t1 else t2 in
  (if less a near first then first else near, if less a last far then last else far).

Notation reciprocals_32 := (Slabs.reciprocals 24 128 prec_24 emax_128 2).
Notation reciprocals_64 := (Slabs.reciprocals 53 1024 prec_53 emax_1024 3).

Lemma turn_is_narrow ends o d lo hi :
  turn f32 ends (o, lo, hi, fst (reciprocals_32 d), snd (reciprocals_32 d)) = Slabs.narrow 24 128 prec_24 emax_128 2 ends (o, d, lo, hi).
Proof. destruct ends. reflexivity. Qed.

Lemma turn_is_narrow_64 ends o d lo hi :
  turn f64 ends (o, lo, hi, fst (reciprocals_64 d), snd (reciprocals_64 d)) = Slabs.narrow 53 1024 prec_53 emax_1024 3 ends (o, d, lo, hi).
Proof. destruct ends. reflexivity. Qed.

Lemma turn_is_narrow_by ends o d lo hi :
  turn f32 ends (o, lo, hi, TwoSided.inverse d, TwoSided.inverse d) = TwoSided.narrow_by ends (o, d, lo, hi).
Proof. destruct ends. reflexivity. Qed.

(** * Two boxes in four lanes *)

Section Lanes.
Variables ox oy oz ix iy iz jx jy jz tmin tmax : num f32.
(** Planes of two boxes. *)
Variables ax ay az bx by_ bz cx cy cz dx dy dz : num f32.

Theorem lanes_agree :
  let '(near, _, near', _, _, far, _, far') := slabs_near_and_far f32 ax bx cx dx ay by_ cy dy az bz cz dz
    ox ox ox ox oy oy oy oy oz oz oz oz ix jx ix jx iy jy iy jy iz jz iz jz tmin tmax in
  (near, far) = fold_left (turn f32) ((ox, ax, bx, ix, jx) :: (oy, ay, by_, iy, jy) :: (oz, az, bz, iz, jz) :: nil) (tmin, tmax) /\
  (near', far') = fold_left (turn f32) ((ox, cx, dx, ix, jx) :: (oy, cy, dy, iy, jy) :: (oz, cz, dz, iz, jz) :: nil) (tmin, tmax).
Proof. unfold slabs_near_and_far. cbv beta iota zeta delta [turn fold_left]. split; reflexivity. Qed.
End Lanes.
