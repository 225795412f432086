(** Sums, differences and products of two numbers, as two numbers: those of src/geom/kernel/exact/sum.rs and of [minus] in
    src/geom/kernel/exact/predicates.rs. In double precision with gradual underflow, without a greatest exponent. *)
Require Import Reals ZArith Lia Lra List.
From Flocq Require Import Core Pff2Flocq.
Require Import StacklessExact.Rounding StacklessExact.Range.
Open Scope R_scope.

Local Instance prec_53 : Prec_gt_0 53 := eq_refl.
Notation F := (generic_format radix2 (FLT_exp (-1074) 53)).

(** * The code *)

(** [two_sum]. *)
Definition two_sum (a b : R) : R * R :=
  let sum := R64 (a + b) in
  let b_of_sum := R64 (sum - a) in
  (sum, R64 (R64 (a - R64 (sum - b_of_sum)) + R64 (b - b_of_sum))).

(** [split], by 2^27 + 1. *)
Definition split (a : R) : R * R :=
  let scaled := R64 (134217729 * a) in
  let high := R64 (scaled - R64 (scaled - a)) in
  (high, R64 (a - high)).

(** [two_product]. *)
Definition two_product (a b : R) : R * R :=
  let product := R64 (a * b) in
  let '(a1, a0) := split a in
  let '(b1, b0) := split b in
  (product, R64 (R64 (a0 * b0) - R64 (R64 (R64 (product - R64 (a1 * b1)) - R64 (a0 * b1)) - R64 (a1 * b0)))).

(** [difference] and [minus]: the exact difference as two numbers. *)
Definition difference (a b : R) : R * R := two_sum a (- b).

Definition pairs : Type := (R * R) * (R * R) * (R * R).

(** * They are exact *)

Definition pair_sum (p : R * R) : R := fst p + snd p.

Lemma F_R64 x : F (R64 x).
Proof. apply generic_format_round; typeclasses eauto. Qed.

(** Knuth. [EXACT-8] *)
Theorem two_sum_is_exact a b : F a -> F b -> pair_sum (two_sum a b) = a + b.
Proof.
  intros A B. apply (TwoSum_correct (-1074) 53 (fun x => negb (Z.even x))); try assumption; try lia.
  intros x. replace (- (x + 1))%Z with (- x - 1)%Z by lia. rewrite Z.even_sub, Z.even_opp. now destruct (Z.even x).
Qed.

(** Dekker and Veltkamp. *)
Lemma dekker a b : F a -> F b -> (a * b = 0 \/ bpow radix2 (-969) <= Rabs (a * b) -> a * b = pair_sum (two_product a b)) /\
  Rabs (a * b - pair_sum (two_product a b)) <= 7 / 2 * bpow radix2 (-1074).
Proof.
  intros A B. pose proof (Dekker radix2 (-1074) 53 (fun x => negb (Z.even x)) ltac:(lia) ltac:(lia) b a B A (or_introl eq_refl)) as D.
  rewrite (Rmult_comm a b).
  match type of D with (_ -> _ = ?s) /\ _ => enough (pair_sum (two_product a b) = s) as -> by exact D end. clear D.
  unfold pair_sum, two_product, split. cbn [fst snd].
  change (bpow radix2 (53 - Z.div2 53)) with (IZR 134217728).
  replace (IZR 134217728 + 1) with 134217729 by lra.
  assert (O : forall x, R64 (- x) = - R64 x) by (intros; apply round_NE_opp).
  rewrite !(Rmult_comm 134217729).
  assert (S : forall x p, R64 (p - R64 (p - x)) = R64 (R64 (x - p) + p)).
  { intros x p. f_equal. replace (x - p) with (- (p - x)) by ring. rewrite O. ring. }
  rewrite !S. rewrite (Rmult_comm a b). f_equal.
  set (hb := R64 (R64 (b - _) + _)). set (ha := R64 (R64 (a - _) + _)). set (tb := R64 (b - hb)). set (ta := R64 (a - ha)). set (r := R64 (b * a)).
  rewrite (Rmult_comm ta tb), (Rmult_comm ha hb), (Rmult_comm ta hb), (Rmult_comm ha tb).
  replace (- r + R64 (hb * ha)) with (- (r - R64 (hb * ha))) by ring. rewrite O.
  replace (- R64 (r - R64 (hb * ha)) + R64 (hb * ta)) with (- (R64 (r - R64 (hb * ha)) - R64 (hb * ta))) by ring. rewrite O.
  match goal with |- context [- ?k + R64 (tb * ha)] => replace (- k + R64 (tb * ha)) with (- (k - R64 (tb * ha))) by ring end. rewrite O.
  f_equal. ring.
Qed.

(** For products that are 0 or far from underflow it is exact. [EXACT-8] *)
Theorem two_product_is_exact a b : F a -> F b -> a * b = 0 \/ bpow radix2 (-969) <= Rabs (a * b) -> pair_sum (two_product a b) = a * b.
Proof. intros A B H. symmetry. now apply dekker. Qed.
(** Of others little is lost. [NEAR-5] *)
Theorem two_product_is_near a b : F a -> F b -> Rabs (a * b - pair_sum (two_product a b)) <= 7 / 2 * bpow radix2 (-1074).
Proof. intros A B. now apply dekker. Qed.

Lemma finer g s x : (g <= s)%Z -> multiple s x -> multiple g x.
Proof.
  intros H (n & ->). exists (n * 2 ^ (s - g))%Z. rewrite mult_IZR, (IZR_Zpower radix2) by lia. rewrite Rmult_assoc, <- bpow_plus. do 2 f_equal. lia.
Qed.

Lemma F_multiple x : F x -> multiple (-1074) x.
Proof.
  intros H. apply FLT_format_generic in H; [|typeclasses eauto]. destruct H as [[m e] -> _ He]. cbn in He. apply finer with e; [exact He|]. now exists m.
Qed.

Lemma two_sum_rest a b : F a -> F b -> snd (two_sum a b) = a + b - R64 (a + b).
Proof. intros A B. pose proof (two_sum_is_exact a b A B) as E. unfold pair_sum in E. change (fst (two_sum a b)) with (R64 (a + b)) in E. lra. Qed.
