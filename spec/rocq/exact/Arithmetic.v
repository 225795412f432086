(** What Operations.v is made of: arithmetics. It is about any two of them, so that one definition serves IEEE 754 numbers and real
    numbers with any rounding. *)
Require Import Reals ZArith Lia Lra List.
From Flocq Require Import Core BinarySingleNaN.

(** The operations of a format. *)
Record arithmetic : Type := Arithmetic {
  num : Type;
  plus : num -> num -> num;
  minus : num -> num -> num;
  times : num -> num -> num;
  over : num -> num -> num;
  (** The square root. *)
  root : num -> num;
  opposite : num -> num;
  absolute : num -> num;
  less : num -> num -> bool;
  at_most : num -> num -> bool;
  equal : num -> num -> bool;
  is_finite : num -> bool;
  (** Whether the bit of the sign is set. *)
  is_negative : num -> bool;
  (** An integer times a power of two. *)
  constant : Z -> Z -> num;
  infinity : num;
  not_a_number : num;
  (** [from_bits(to_bits() + by)]. *)
  shifted : Z -> num -> num;
  (** The number of which only the bits of the exponent are left. *)
  power : num -> num;
  (** The number without so many of its lowest bits and that of the sign. *)
  cleared : Z -> num -> num;
  (** The next number up and down: [next_up], [next_down]. *)
  after : num -> num;
  before : num -> num
}.

(** * IEEE 754 *)

Section Ieee.
Variables prec emax : Z.
Context (prec_pos : Prec_gt_0 prec) (prec_emax : Prec_lt_emax prec emax).
Notation float := (binary_float prec emax).

(** The next floats in magnitude, whatever the sign. *)
Definition shifted_float (by_ : Z) (x : float) : float :=
  let move := if (by_ <? 0)%Z then @Bpred prec emax prec_pos prec_emax else @Bsucc prec emax prec_pos prec_emax in
  let moved := Nat.iter (Z.abs_nat by_) move in
  if Bsign x then Bopp (moved (Bopp x)) else moved x.

Definition power_float (x : float) : float :=
  match x with
  | B754_finite _ m e _ => if (Zpos (digits2_pos m) =? prec)%Z then binary_normalize prec emax _ _ mode_NE 1 (e + prec - 1) false else B754_zero false
  | B754_zero _ => B754_zero false
  | B754_infinity _ | B754_nan => B754_infinity false
  end.

(** The lowest bits of a number are those of its significand. *)
Definition cleared_float (bits : Z) (x : float) : float :=
  match x with
  | B754_finite _ m e _ => binary_normalize prec emax _ _ mode_NE (Z.shiftl (Z.shiftr (Zpos m) bits) bits) e false
  | B754_zero _ => B754_zero false
  | B754_infinity _ => B754_infinity false
  | B754_nan => B754_nan
  end.

Definition ieee : arithmetic := {|
  num := float;
  plus := Bplus mode_NE;
  minus := Bminus mode_NE;
  times := Bmult mode_NE;
  over := Bdiv mode_NE;
  root := Bsqrt mode_NE;
  opposite := Bopp;
  absolute := Babs;
  less := Bltb;
  at_most := Bleb;
  equal := Beqb;
  is_finite := BinarySingleNaN.is_finite;
  is_negative := Bsign;
  constant n e := binary_normalize prec emax _ _ mode_NE n e false;
  infinity := B754_infinity false;
  not_a_number := B754_nan;
  shifted := shifted_float;
  power := power_float;
  cleared := cleared_float;
  after := Bsucc;
  before := Bpred
|}.
End Ieee.

(** [as] between formats: the nearest number. *)
Definition convert (prec emax prec' emax' : Z) (prec_pos : Prec_gt_0 prec') (prec_emax : Prec_lt_emax prec' emax')
  (x : binary_float prec emax) : binary_float prec' emax' :=
  match x with
  | B754_zero s => B754_zero s
  | B754_infinity s => B754_infinity s
  | B754_nan => B754_nan
  | B754_finite s m e _ => binary_normalize prec' emax' _ _ mode_NE (cond_Zopp s (Zpos m)) e s
  end.

Definition prec_24 : Prec_gt_0 24 := eq_refl.
Definition emax_128 : Prec_lt_emax 24 128 := eq_refl.
Definition prec_53 : Prec_gt_0 53 := eq_refl.
Definition emax_1024 : Prec_lt_emax 53 1024 := eq_refl.
Definition f32 : arithmetic := ieee 24 128 prec_24 emax_128.
Definition f64 : arithmetic := ieee 53 1024 prec_53 emax_1024.
Definition f64_of_f32 : num f32 -> num f64 := convert 24 128 53 1024 prec_53 emax_1024.
Definition f32_of_f64 : num f64 -> num f32 := convert 53 1024 24 128 prec_24 emax_128.

(** * Real numbers, rounded *)

(** Every number is finite, and there are no bits: functions that ask for infinity, give a NaN, or move bits are not about these. *)
Definition reals (RN : R -> R) : arithmetic := {|
  num := R;
  plus x y := RN (x + y)%R;
  minus x y := RN (x - y)%R;
  times x y := RN (x * y)%R;
  over x y := RN (x / y)%R;
  root x := RN (sqrt x);
  opposite := Ropp;
  absolute := Rabs;
  less := Rlt_bool;
  at_most := Rle_bool;
  equal := Req_bool;
  is_finite _ := true;
  is_negative x := Rlt_bool x 0;
  constant n e := (IZR n * bpow radix2 e)%R;
  infinity := 0%R;
  not_a_number := 0%R;
  shifted _ x := x;
  power x := x;
  cleared _ x := x;
  after x := x;
  before x := x
|}.

(** The same with steps to the next number. *)
Definition stepping (a : arithmetic) (down up : num a -> num a) : arithmetic :=
  {| num := num a; plus := plus a; minus := minus a; times := times a; over := over a; root := root a; opposite := opposite a; absolute := absolute a;
     less := less a; at_most := at_most a; equal := equal a; is_finite := is_finite a; is_negative := is_negative a;
     constant := constant a; infinity := infinity a; not_a_number := not_a_number a; shifted := shifted a; power := power a; cleared := cleared a; after := up;
     before := down |}.
