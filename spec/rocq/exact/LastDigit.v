(** [unit] of src/geom/kernel/exact/filter.rs on IEEE 754 doubles, bit by bit: the greatest power of two that divides some numbers. A sum
    with 1.5 2^52 units of the wanted digits ends where they end. *)
Require Import Reals ZArith Lia Lra Psatz Bool List.
From Flocq Require Import Core BinarySingleNaN Sterbenz.
Require Import StacklessExact.Rounding StacklessExact.Triple StacklessExact.Filter StacklessExact.Quotient StacklessExact.Range
  StacklessExact.Overflow StacklessExact.Division StacklessExact.Certain StacklessExact.Scene.
Open Scope R_scope.

Local Instance prec_53 : Prec_gt_0 53 := eq_refl.
Local Instance emax_1024 : Prec_lt_emax 53 1024 := eq_refl.

(** * The code *)

Section Code.
Open Scope Z_scope.

(** [to_bits]. Of a number m 2^e the first digit is not stored: one less in m is one more in the exponent, which begins at 2^52. *)
Definition bits (x : float) : Z :=
  match x with
  | B754_zero s => if s then 2 ^ 63 else 0
  | B754_infinity s => (if s then 2 ^ 63 else 0) + 2047 * 2 ^ 52
  | B754_nan => 4095 * 2 ^ 51
  | B754_finite s m e _ => (if s then 2 ^ 63 else 0) + ((e + 1074) * 2 ^ 52 + Zpos m)
  end.

(** [from_bits] for a normal number that is not negative. *)
Definition from_bits (n : Z) : float := constant (2 ^ 52 + n mod 2 ^ 52) (n / 2 ^ 52 - 1075).

(** [u64::trailing_zeros]. *)
Fixpoint zeros (p : positive) : Z := match p with xO q => 1 + zeros q | _ => 0 end.
Definition trailing_zeros (n : Z) : Z := match n with Z0 => 64 | Zpos p | Zneg p => zeros p end.

Definition zero : float := B754_zero false.
Definition exponent (x : float) : Z := Z.shiftr (bits x) 52.
Definition fadd (v : fvec) (x : float) : fvec := FVec (plus (fx v) x) (plus (fy v) x) (plus (fz v) x).
Definition fless (v : fvec) (x : float) : fvec := FVec (minus (fx v) x) (minus (fy v) x) (minus (fz v) x).
Definition veq (v w : fvec) : bool := Beqb (fx v) (fx w) && Beqb (fy v) (fy w) && Beqb (fz v) (fz w).

Definition greatest_of (vectors : list fvec) : float :=
  max_element (fold_left (fun greatest v => vmax greatest (vabs v)) vectors (FVec zero zero zero)).

Definition step (shift : float) (found : Z * bool) (v : fvec) : Z * bool :=
  let sum := fadd v shift in
  (Z.lor (fst found) (Z.lor (Z.lor (bits (fx sum)) (bits (fy sum))) (bits (fz sum))), snd found || negb (veq (fless sum shift) v)).

Definition unit (vectors : list fvec) : option Z :=
  let greatest := greatest_of vectors in
  let shift := from_bits (Z.lor (Z.shiftl (exponent greatest + 2) 52) (Z.shiftl 1 51)) in
  let '(digits, is_rounded) := fold_left (step shift) vectors (0, false) in
  if is_rounded then None else Some (exponent greatest - 50 + trailing_zeros digits).
End Code.

(** * Numbers with few digits *)

(** At most b units of 2^g. *)
Definition on (g b : Z) (x : R) : Prop := exists n, x = IZR n * bpow radix2 g /\ (Z.abs n <= b)%Z.
Definition von (g b : Z) (v : vec) : Prop := on g b (vx v) /\ on g b (vy v) /\ on g b (vz v).

Lemma on_more g b b' x : on g b x -> (b <= b')%Z -> on g b' x.
Proof. intros (n & E & H) L. exists n. split; [exact E|lia]. Qed.
Lemma on_plus g a b x y : on g a x -> on g b y -> on g (a + b) (x + y).
Proof. intros (n & -> & N) (m & -> & M). exists (n + m)%Z. split; [rewrite plus_IZR; ring|lia]. Qed.
Lemma on_minus g a b x y : on g a x -> on g b y -> on g (a + b) (x - y).
Proof. intros (n & -> & N) (m & -> & M). exists (n - m)%Z. split; [rewrite minus_IZR; ring|lia]. Qed.
Lemma on_mult g h a b x y : on g a x -> on h b y -> on (g + h) (a * b) (x * y).
Proof.
  intros (n & -> & N) (m & -> & M). exists (n * m)%Z. split; [rewrite mult_IZR, bpow_plus; ring|]. rewrite Z.abs_mul. nia.
Qed.

(** 53 digits are not rounded. *)
Lemma on_round g b x : on g b x -> (b <= 2 ^ 53)%Z -> (-1074 <= g)%Z -> R64 x = x.
Proof.
  intros (n & -> & N) B G. apply round_generic; [typeclasses eauto|]. destruct (Z.eq_dec (Z.abs n) (2 ^ 53)) as [E|E].
  - assert (F : generic_format radix2 (FLT_exp (-1074) 53) (bpow radix2 (53 + g))) by (apply format_64; lia).
    destruct (Z.abs_or_opp_abs n) as [S|S]; rewrite S, E.
    + change (2 ^ 53)%Z with (Zpower radix2 53). rewrite IZR_Zpower by lia. now rewrite <- bpow_plus.
    + rewrite opp_IZR. change (2 ^ 53)%Z with (Zpower radix2 53). rewrite IZR_Zpower by lia.
      rewrite Ropp_mult_distr_l_reverse, <- bpow_plus. now apply generic_format_opp.
  - apply generic_format_FLT. exists (Float radix2 n g); [reflexivity|simpl; lia|exact G].
Qed.

(** * Bits *)

Lemma zeros_pos p : (0 <= zeros p)%Z.
Proof. induction p as [p _|p IH|]; cbn [zeros]; lia. Qed.

Lemma zeros_divide p : (2 ^ zeros p | Zpos p)%Z.
Proof.
  induction p as [p _|p (k & E)|]; cbn [zeros]; [apply Z.divide_1_l| |apply Z.divide_1_l].
  exists k. rewrite Z.pow_add_r by (pose proof (zeros_pos p); lia). change (Zpos p~0) with (2 * Zpos p)%Z. rewrite E. ring.
Qed.

Lemma trailing_zeros_divide n : (0 <= trailing_zeros n)%Z /\ (2 ^ trailing_zeros n | n)%Z.
Proof.
  destruct n as [|p|p]; cbn [trailing_zeros]; [split; [lia|apply Z.divide_0_r]|..]; (split; [apply zeros_pos|]).
  - apply zeros_divide.
  - apply Z.divide_opp_r. apply zeros_divide.
Qed.

Lemma divide_lor z a b : (0 <= z)%Z -> (2 ^ z | Z.lor a b)%Z -> (2 ^ z | a)%Z /\ (2 ^ z | b)%Z.
Proof.
  intros P. assert (N : (2 ^ z <> 0)%Z) by (apply Z.pow_nonzero; lia).
  rewrite <- !Z.mod_divide by exact N. rewrite <- !Z.land_ones by exact P. rewrite Z.land_lor_distr_l. apply Z.lor_eq_0_iff.
Qed.

Lemma bounded_is m e : SpecFloat.bounded 53 1024 m e = true -> (Zpos m < 2 ^ 53)%Z /\ ((2 ^ 52 <= Zpos m)%Z \/ e = (-1074)%Z).
Proof.
  intros B. assert (C := canonical_bounded 53 1024 false m e B). simpl cond_Zopp in C.
  unfold canonical in C. simpl Fexp in C. unfold cexp in C.
  change (SpecFloat.fexp 53 1024 (mag radix2 (F2R (Float radix2 (Zpos m) e)))) with
    (Z.max (mag radix2 (F2R (Float radix2 (Zpos m) e)) - 53) (-1074)) in C.
  assert (P : 0 < F2R (Float radix2 (Zpos m) e)) by (apply F2R_gt_0; reflexivity).
  assert (Low : forall n, (0 <= n)%Z -> (2 ^ n <= Zpos m)%Z -> (n + e < mag radix2 (F2R (Float radix2 (Zpos m) e)))%Z).
  { intros n N L. apply mag_gt_bpow. rewrite Rabs_pos_eq by lra. unfold F2R. simpl Fnum. simpl Fexp. rewrite bpow_plus.
    apply Rmult_le_compat_r; [apply bpow_ge_0|]. rewrite <- (IZR_Zpower radix2) by exact N. apply IZR_le. exact L. }
  split.
  - destruct (Z_lt_le_dec (Zpos m) (2 ^ 53)) as [|L]; [assumption|]. specialize (Low 53%Z ltac:(lia) L). lia.
  - destruct (Z_lt_le_dec (Zpos m) (2 ^ 52)) as [S|]; [right|now left].
    assert (mag radix2 (F2R (Float radix2 (Zpos m) e)) <= 52 + e)%Z; [|lia].
    apply mag_le_bpow; [lra|]. rewrite Rabs_pos_eq by lra. unfold F2R. simpl Fnum. simpl Fexp. rewrite bpow_plus.
    apply Rmult_lt_compat_r; [apply bpow_gt_0|]. rewrite <- (IZR_Zpower radix2) by lia. apply IZR_lt. exact S.
Qed.

Lemma exponent_of m e B : exponent (B754_finite false m e B) = (e + 1074 + Zpos m / 2 ^ 52)%Z.
Proof. unfold exponent, bits. rewrite Z.shiftr_div_pow2 by lia. rewrite Z.add_0_l, Z.div_add_l by lia. reflexivity. Qed.

(** The stored exponent tells how great a number is. *)
Lemma exponent_is x : is_finite x = true -> Bsign x = false ->
  (0 <= exponent x)%Z /\ B2R x < bpow radix2 (exponent x - 1022) /\ (exponent x = 0%Z \/ bpow radix2 (exponent x - 1023) <= B2R x).
Proof.
  destruct x as [s|s| |s m e B]; try discriminate; simpl Bsign; intros _ ->.
  - change (exponent (B754_zero false)) with 0%Z. split; [lia|]. split; [apply bpow_gt_0|now left].
  - rewrite exponent_of. destruct (bounded_is m e B) as [M C]. assert (L : (-1074 <= e)%Z).
    { pose proof B as B'. unfold SpecFloat.bounded in B'. apply andb_prop in B'. destruct B' as [B' _]. apply Zeq_bool_eq in B'.
      unfold SpecFloat.fexp, SpecFloat.emin in B'. lia. }
    unfold B2R, F2R. simpl cond_Zopp. simpl Fnum. simpl Fexp.
    assert (Q : forall n, (0 <= n)%Z -> bpow radix2 (n + e) = IZR (2 ^ n) * bpow radix2 e).
    { intros n N. rewrite bpow_plus. now rewrite <- (IZR_Zpower radix2) by exact N. }
    destruct (Z_lt_le_dec (Zpos m) (2 ^ 52)) as [S|S].
    + rewrite Z.div_small by lia. destruct C as [C|C]; [lia|]. split; [lia|]. split; [|left; lia].
      replace (e + 1074 + 0 - 1022)%Z with (52 + e)%Z by lia. rewrite Q by lia.
      apply Rmult_lt_compat_r; [apply bpow_gt_0|now apply IZR_lt].
    + assert (D : (Zpos m / 2 ^ 52 = 1)%Z) by (symmetry; apply (Z.div_unique _ _ 1 (Zpos m - 2 ^ 52)); lia). rewrite D.
      split; [lia|]. split; [|right].
      * replace (e + 1074 + 1 - 1022)%Z with (53 + e)%Z by lia. rewrite Q by lia.
        apply Rmult_lt_compat_r; [apply bpow_gt_0|now apply IZR_lt].
      * replace (e + 1074 + 1 - 1023)%Z with (52 + e)%Z by lia. rewrite Q by lia.
        apply Rmult_le_compat_r; [apply bpow_ge_0|now apply IZR_le].
Qed.

(** * The last digit *)

Section Sum.
Variable E : Z.
Hypothesis HE : (0 <= E <= 1151)%Z.
Variable shift : float.
Hypothesis Fs : is_finite shift = true.
Hypothesis Vs : B2R shift = IZR (3 * 2 ^ 51) * bpow radix2 (E - 1073).

Lemma power_is n : (0 <= n)%Z -> bpow radix2 (n + (E - 1073)) = IZR (2 ^ n) * bpow radix2 (E - 1073).
Proof. intros N. rewrite bpow_plus. now rewrite <- (IZR_Zpower radix2) by exact N. Qed.

Ltac powers := change (3 * 2 ^ 51)%Z with 6755399441055744%Z in *; change (2 ^ 51)%Z with 2251799813685248%Z in *;
  change (2 ^ 52)%Z with 4503599627370496%Z in *; change (2 ^ 53)%Z with 9007199254740992%Z in *.

(** A number that a sum with 1.5 2^52 units gives back ends where the digits of the sum do. *)
Lemma ends_where_the_sum_does x z : is_finite x = true -> Rabs (B2R x) < bpow radix2 (E - 1022) ->
  Beqb (minus (plus x shift) shift) x = true -> (0 <= z)%Z -> (2 ^ z | bits (plus x shift))%Z -> multiple (E - 1073 + z) (B2R x).
Proof.
  intros Fx Bx Same Pz Dz. set (b := bpow radix2 (E - 1073)) in *. assert (Pb : 0 < b) by apply bpow_gt_0.
  replace (E - 1022)%Z with (51 + (E - 1073))%Z in Bx by lia. rewrite power_is in Bx by lia. fold b in Bx.
  assert (X : fits (E - 1021) x (B2R x)).
  { split; [exact Fx|split; [reflexivity|]]. replace (E - 1021)%Z with (52 + (E - 1073))%Z by lia. rewrite power_is by lia. fold b.
    powers. lra. }
  assert (S : fits (E - 1020) shift (B2R shift)).
  { split; [exact Fs|split; [reflexivity|]]. rewrite Vs. replace (E - 1020)%Z with (53 + (E - 1073))%Z by lia. rewrite power_is by lia. fold b.
    rewrite Rabs_pos_eq; powers; nra. }
  pose proof (plus_fits (E - 1020) x shift _ _ ltac:(lia) (fits_more _ (E - 1020) _ _ X ltac:(lia)) S) as Y.
  apply Rabs_lt_inv in Bx.
  assert (Range : IZR (2 ^ 52) * b < B2R x + B2R shift < IZR (2 ^ 53) * b) by (rewrite Vs; powers; lra).
  pose proof Y as (Fy & Vy & _). set (y := plus x shift) in *.
  assert (RY : IZR (2 ^ 52) * b <= B2R y <= IZR (2 ^ 53) * b).
  { rewrite Vy. unfold b. rewrite <- !power_is by lia. split.
    - apply round_ge_generic; [typeclasses eauto|typeclasses eauto|apply format_64; lia|]. rewrite power_is by lia. fold b. lra.
    - apply round_le_generic; [typeclasses eauto|typeclasses eauto|apply format_64; lia|]. rewrite power_is by lia. fold b. lra. }
  assert (Ex : B2R y - B2R shift = B2R x).
  { assert (Y' : fits (E - 1020 + 1) y (B2R y)) by (rewrite Vy; exact Y).
    pose proof (minus_fits (E - 1019) y shift _ _ ltac:(lia) (fits_more _ (E - 1019) _ _ Y' ltac:(lia))
      (fits_more _ (E - 1019) _ _ S ltac:(lia))) as (Fm & Vm & _).
    rewrite Beqb_correct in Same by assumption. rewrite Vm in Same.
    rewrite round_generic in Same; [destruct (Req_bool_spec (B2R y - B2R shift) (B2R x)); [assumption|discriminate]|typeclasses eauto|].
    apply (sterbenz radix2 (FLT_exp (-1074) 53)); [apply generic_format_B2R|apply generic_format_B2R|].
    rewrite Vs. fold b. powers. lra. }
  assert (R : IZR (2 ^ 52) * b < B2R y < IZR (2 ^ 53) * b) by lra. clear RY Range.
  destruct y as [sy|sy| |sy m e B]; try discriminate; [simpl B2R in R; powers; lra|].
  destruct sy.
  { exfalso. assert (B2R (B754_finite true m e B) < 0) by (apply F2R_lt_0; reflexivity). powers. lra. }
  assert (He : e = (E - 1073)%Z).
  { pose proof (canonical_bounded 53 1024 false m e B) as C. unfold canonical in C. simpl Fexp in C. rewrite C at 1.
    change (F2R (Float radix2 (cond_Zopp false (Zpos m)) e)) with (B2R (B754_finite false m e B)) in C |- *.
    unfold cexp. rewrite (mag_unique radix2 _ (E - 1020)).
    - change (SpecFloat.fexp 53 1024 (E - 1020)) with (Z.max (E - 1020 - 53) (-1074)). lia.
    - replace (E - 1020 - 1)%Z with (52 + (E - 1073))%Z by lia. replace (E - 1020)%Z with (53 + (E - 1073))%Z by lia.
      rewrite !power_is by lia. fold b. rewrite Rabs_pos_eq; [lra|]. powers. lra. }
  assert (Vm : B2R (B754_finite false m e B) = IZR (Zpos m) * b) by (unfold B2R, F2R, b; simpl cond_Zopp; simpl Fnum; simpl Fexp; now rewrite He).
  rewrite Vm in R, Ex. destruct R as [R1 R2]. apply Rmult_lt_reg_r in R1; [|exact Pb]. apply Rmult_lt_reg_r in R2; [|exact Pb].
  apply lt_IZR in R1, R2. unfold bits in Dz. rewrite Z.add_0_l in Dz.
  assert (z <= 51)%Z as Lz.
  { destruct (Z_le_gt_dec z 51) as [|G]; [assumption|exfalso].
    assert (D : (2 ^ 52 | (e + 1074) * 2 ^ 52 + Zpos m)%Z).
    { eapply Z.divide_trans; [|exact Dz]. exists (2 ^ (z - 52))%Z. rewrite <- Z.pow_add_r by lia. f_equal. lia. }
    apply (Z.divide_add_cancel_r (2 ^ 52) ((e + 1074) * 2 ^ 52)) in D; [|apply Z.divide_factor_r]. destruct D as (k & D). powers. lia. }
  assert (D : (2 ^ z | Zpos m - 3 * 2 ^ 51)%Z).
  { assert (P : forall n, (z <= n)%Z -> (2 ^ z | 2 ^ n)%Z).
    { intros n N. exists (2 ^ (n - z))%Z. rewrite <- Z.pow_add_r by lia. f_equal. lia. }
    apply Z.divide_sub_r; [|apply Z.divide_mul_r, P; lia].
    apply (Z.divide_add_cancel_r (2 ^ z) ((e + 1074) * 2 ^ 52)); [apply Z.divide_mul_r, P; lia|exact Dz]. }
  destruct D as (k & D). exists k. rewrite <- Ex, Vs. fold b.
  replace (IZR (Zpos m) * b - IZR (3 * 2 ^ 51) * b) with (IZR (Zpos m - 3 * 2 ^ 51) * b) by (rewrite minus_IZR; ring).
  rewrite D, mult_IZR. change (2 ^ z)%Z with (Zpower radix2 z). rewrite IZR_Zpower by lia. unfold b.
  rewrite Rmult_assoc, <- bpow_plus. do 2 f_equal. lia.
Qed.
End Sum.

Lemma shift_is E : (0 <= E <= 1151)%Z -> let shift := from_bits (Z.lor (Z.shiftl (E + 2) 52) (Z.shiftl 1 51)) in
  is_finite shift = true /\ B2R shift = IZR (3 * 2 ^ 51) * bpow radix2 (E - 1073).
Proof.
  intros HE shift. assert (L : Z.land (Z.shiftl (E + 2) 52) (Z.shiftl 1 51) = 0%Z).
  { apply Z.bits_inj'. intros i Pi. rewrite Z.land_spec, Z.bits_0. destruct (Z_lt_le_dec i 52) as [S|S].
    - now rewrite Z.shiftl_spec_low.
    - rewrite (Z.shiftl_spec_high 1 51 i) by lia. replace 1%Z with (2 ^ 0)%Z by reflexivity.
      rewrite Z.pow2_bits_false by lia. apply andb_false_r. }
  assert (N : Z.lor (Z.shiftl (E + 2) 52) (Z.shiftl 1 51) = ((E + 2) * 2 ^ 52 + 2 ^ 51)%Z).
  { rewrite <- Z.lxor_lor by exact L. rewrite <- Z.add_nocarry_lxor by exact L. now rewrite !Z.shiftl_mul_pow2 by lia. }
  unfold shift, from_bits. rewrite N. rewrite <- (Z.div_unique ((E + 2) * 2 ^ 52 + 2 ^ 51) (2 ^ 52) (E + 2) (2 ^ 51)) by lia.
  rewrite <- (Z.mod_unique ((E + 2) * 2 ^ 52 + 2 ^ 51) (2 ^ 52) (E + 2) (2 ^ 51)) by lia.
  destruct (constant_fits (2 ^ 52 + 2 ^ 51) (E + 2 - 1075)) as [F V]; [reflexivity|lia|].
  split; [exact F|]. rewrite V. f_equal. f_equal. lia.
Qed.

(** * Greatest numbers *)

Definition plain (x : float) : Prop := is_finite x = true /\ Bsign x = false /\ B2R x < bpow radix2 129.

Lemma fmax_plain x y : plain x -> plain y -> plain (fmax x y) /\ B2R x <= B2R (fmax x y) /\ B2R y <= B2R (fmax x y).
Proof.
  intros X Y. unfold fmax. rewrite Bltb_correct by (apply X || apply Y).
  destruct (Rlt_bool_spec (B2R y) (B2R x)); (split; [assumption|lra]).
Qed.

Lemma abs_plain x : is_finite x = true -> Rabs (B2R x) < bpow radix2 129 -> plain (Babs x) /\ Rabs (B2R x) = B2R (Babs x).
Proof.
  intros F B. split; [split; [now rewrite is_finite_Babs|split]|symmetry; apply B2R_Babs].
  - now destruct x.
  - now rewrite B2R_Babs.
Qed.

Lemma single_plain x : is_single x -> plain (Babs x) /\ Rabs (B2R x) = B2R (Babs x).
Proof. intros (F & _ & B). apply abs_plain; [exact F|]. eapply Rlt_trans; [exact B|apply bpow_lt; lia]. Qed.

Definition vplain (v : fvec) : Prop := plain (fx v) /\ plain (fy v) /\ plain (fz v).
Definition below (v w : fvec) : Prop := B2R (fx v) <= B2R (fx w) /\ B2R (fy v) <= B2R (fy w) /\ B2R (fz v) <= B2R (fz w).

Lemma below_trans u v w : below u v -> below v w -> below u w.
Proof. intros (A1 & A2 & A3) (B1 & B2 & B3). repeat split; lra. Qed.

Lemma vmax_plain v w : vplain v -> vplain w -> vplain (vmax v w) /\ below v (vmax v w) /\ below w (vmax v w).
Proof.
  intros (V1 & V2 & V3) (W1 & W2 & W3). destruct (fmax_plain _ _ V1 W1) as (P1 & Q1 & R1).
  destruct (fmax_plain _ _ V2 W2) as (P2 & Q2 & R2). destruct (fmax_plain _ _ V3 W3) as (P3 & Q3 & R3). repeat split; assumption || apply P1 || apply P2 || apply P3.
Qed.

Lemma max_element_plain v : vplain v ->
  plain (max_element v) /\ B2R (fx v) <= B2R (max_element v) /\ B2R (fy v) <= B2R (max_element v) /\ B2R (fz v) <= B2R (max_element v).
Proof.
  intros (V1 & V2 & V3). unfold max_element. destruct (fmax_plain _ _ V1 V2) as (P & L1 & L2). destruct (fmax_plain _ _ P V3) as (Q & L3 & L4).
  split; [exact Q|lra].
Qed.

Lemma greatest_is vectors first : vplain first -> Forall v_single vectors ->
  let r := fold_left (fun greatest v => vmax greatest (vabs v)) vectors first in
  vplain r /\ below first r /\ Forall (fun v => below (vabs v) r) vectors.
Proof.
  intros P H. revert first P. induction H as [|v vectors (X & Y & Z) _ IH]; intros first P r.
  - split; [exact P|]. split; [split; [|split]; apply Rle_refl|constructor].
  - assert (A : vplain (vabs v)) by (split; [|split]; now apply single_plain).
    destruct (vmax_plain _ _ P A) as (Q & L1 & L2). destruct (IH _ Q) as (R & L & T). fold r in R, L, T.
    split; [exact R|]. split; [exact (below_trans _ _ _ L1 L)|]. constructor; [exact (below_trans _ _ _ L2 L)|exact T].
Qed.

(** * The unit *)

Lemma step_is shift vectors found : let r := fold_left (step shift) vectors found in
  (snd r = false -> snd found = false /\ Forall (fun v => veq (fless (fadd v shift) shift) v = true) vectors) /\
  forall z, (0 <= z)%Z -> (2 ^ z | fst r)%Z -> (2 ^ z | fst found)%Z /\
    Forall (fun v => let sum := fadd v shift in (2 ^ z | bits (fx sum))%Z /\ (2 ^ z | bits (fy sum))%Z /\ (2 ^ z | bits (fz sum))%Z) vectors.
Proof.
  revert found. induction vectors as [|v vectors IH]; intros found r; [split; [now split|intros z _ D; now split]|].
  destruct (IH (step shift found v)) as [A B]. fold r in A, B. split.
  - intros H. destruct (A H) as [S F]. unfold step in S. cbn [snd] in S. apply orb_false_iff in S. destruct S as [S S'].
    apply negb_false_iff in S'. split; [exact S|]. now constructor.
  - intros z P D. destruct (B z P D) as [S F]. unfold step in S. cbn [fst] in S.
    apply divide_lor in S; [|exact P]. destruct S as [S S']. apply divide_lor in S'; [|exact P]. destruct S' as [S' S3].
    apply divide_lor in S'; [|exact P]. split; [exact S|]. constructor; [now repeat split|exact F].
Qed.

(** A multiple of 2^k and of 2^-149, and so many digits down to it. *)
Lemma counted k n x : multiple k x -> multiple (-149) x -> Rabs x < bpow radix2 (n + k) -> on (Z.max k (-149)) (2 ^ Z.max n 0) x.
Proof.
  intros K S B. assert (M : multiple (Z.max k (-149)) x) by (destruct (Z.max_spec k (-149)) as [[_ ->]|[_ ->]]; assumption).
  destruct M as (m & E). exists m. split; [exact E|]. rewrite E in B. set (g := Z.max k (-149)) in *.
  rewrite Rabs_mult, (Rabs_pos_eq (bpow radix2 g)) in B by apply bpow_ge_0.
  assert (L : Rabs (IZR m) < bpow radix2 (Z.max n 0)).
  { apply Rmult_lt_reg_r with (bpow radix2 g); [apply bpow_gt_0|]. eapply Rlt_le_trans; [exact B|]. rewrite <- bpow_plus. apply bpow_le. lia. }
  rewrite <- abs_IZR, <- (IZR_Zpower radix2) in L by lia. apply lt_IZR in L. change (Zpower radix2 (Z.max n 0)) with (2 ^ Z.max n 0)%Z in L. lia.
Qed.

Lemma units_divide E vectors most k : (0 <= E <= 1151)%Z -> most < bpow radix2 (E - 1022) -> Forall v_single vectors ->
  Forall (fun v => bounded most (real v)) vectors ->
  (let '(digits, is_rounded) := fold_left (step (from_bits (Z.lor (Z.shiftl (E + 2) 52) (Z.shiftl 1 51)))) vectors (0%Z, false) in
   if is_rounded then None else Some (E - 50 + trailing_zeros digits)%Z) = Some k ->
  Forall (fun v => vmultiple (k - 1023) (real v) /\ von (Z.max (k - 1023) (-149)) (2 ^ 51) (real v)) vectors.
Proof.
  intros HE Most H G. destruct (shift_is E HE) as [Fs Vs]. generalize dependent (from_bits (Z.lor (Z.shiftl (E + 2) 52) (Z.shiftl 1 51))).
  intros shift Fs Vs. pose proof (step_is shift vectors (0%Z, false)) as T. cbv zeta in T. destruct T as [A B].
  destruct (fold_left (step shift) vectors (0%Z, false)) as [digits is_rounded]. cbn [fst snd] in A, B.
  destruct is_rounded; [discriminate|]. intros K. assert (Ek : (k = E - 50 + trailing_zeros digits)%Z) by congruence. clear K.
  destruct (A eq_refl) as [_ Same]. destruct (trailing_zeros_divide digits) as [Pz Dz]. destruct (B _ Pz Dz) as [_ D]. clear A B Dz.
  generalize dependent (trailing_zeros digits). intros z Ek Pz D.
  assert (One : forall x, is_single x -> Rabs (B2R x) <= most -> Beqb (minus (plus x shift) shift) x = true ->
    (2 ^ z | bits (plus x shift))%Z -> multiple (k - 1023) (B2R x) /\ on (Z.max (k - 1023) (-149)) (2 ^ 51) (B2R x)).
  { intros x Sx Gx Ex Dx. assert (Bx : Rabs (B2R x) < bpow radix2 (E - 1022)) by (eapply Rle_lt_trans; eassumption).
    assert (M : multiple (k - 1023) (B2R x)).
    { replace (k - 1023)%Z with (E - 1073 + z)%Z by (clear - Ek; lia). apply (ends_where_the_sum_does E HE shift Fs Vs); try assumption. apply Sx. }
    split; [exact M|]. apply (counted _ 51); [exact M|now apply single_multiple|]. eapply Rlt_le_trans; [exact Bx|]. apply bpow_le. clear - Ek Pz. lia. }
  rewrite Forall_forall in *. intros v I. destruct (H v I) as (X & Y & Z). destruct (G v I) as (G1 & G2 & G3).
  destruct (D v I) as (D1 & D2 & D3). specialize (Same v I). unfold veq in Same. rewrite !andb_true_iff in Same. destruct Same as ((S1 & S2) & S3).
  destruct (One _ X G1 S1 D1), (One _ Y G2 S2 D2), (One _ Z G3 S3 D3). split; (split; [|split]); assumption.
Qed.

(** [unit] finds a power of two that divides all numbers, which then have at most 51 digits. [EXACT-11](1) *)
Theorem unit_divides vectors k : Forall v_single vectors -> unit vectors = Some k ->
  Forall (fun v => vmultiple (k - 1023) (real v) /\ von (Z.max (k - 1023) (-149)) (2 ^ 51) (real v)) vectors.
Proof.
  intros H. unfold unit, greatest_of. assert (Z0 : plain zero) by (split; [reflexivity|split; [reflexivity|apply bpow_gt_0]]).
  assert (V0 : vplain (FVec zero zero zero)) by (split; [|split]; exact Z0).
  pose proof (greatest_is vectors _ V0 H) as T. cbv zeta in T. cbv zeta. destruct T as (P & _ & G).
  destruct (max_element_plain _ P) as (Q & L1 & L2 & L3). clear P V0 Z0.
  generalize dependent (max_element (fold_left (fun greatest v => vmax greatest (vabs v)) vectors (FVec zero zero zero))).
  generalize dependent (fold_left (fun greatest v => vmax greatest (vabs v)) vectors (FVec zero zero zero)).
  intros top G greatest (Fg & Sg & Bg) L1 L2 L3. destruct (exponent_is _ Fg Sg) as (E0 & E1 & E2).
  generalize dependent (exponent greatest). intros E E0 E1 E2. apply (units_divide E) with (most := B2R greatest); try assumption.
  - split; [exact E0|]. destruct E2 as [-> |E2]; [discriminate|]. pose proof (Rle_lt_trans _ _ _ E2 Bg) as L. apply lt_bpow in L. clear - L. lia.
  - rewrite Forall_forall in *. intros v I. destruct (G v I) as (G1 & G2 & G3). cbn [vabs fx fy fz] in G1, G2, G3. rewrite B2R_Babs in G1, G2, G3.
    repeat split; eapply Rle_trans; eassumption.
Qed.
