(** Sums and products without error: what Expansion.v is about is what Operations.v has, with real numbers that are rounded to double precision. *)
Require Import Reals ZArith.
From Flocq Require Import Core.
Require Import StacklessExact.Rounding StacklessExact.Range StacklessExact.Arithmetic StacklessExact.Operations.
Require StacklessExact.Expansion.
Open Scope R_scope.

Notation rounded := (reals R64).

(** [two_sum]. [NEAR-5] *)
Theorem two_sum_agrees a b : sum_two_sum rounded a b = Expansion.two_sum a b.
Proof. reflexivity. Qed.

(** [split]. [NEAR-5] *)
Theorem split_agrees a : sum_split rounded a = Expansion.split a.
Proof.
  unfold sum_split, Expansion.split. cbn [reals constant times minus].
  replace (IZR 134217729 * bpow radix2 0) with 134217729 by (simpl; ring). reflexivity.
Qed.

(** [two_product]. [NEAR-5] *)
Theorem two_product_agrees a b : sum_two_product rounded a b = Expansion.two_product a b.
Proof. unfold sum_two_product. rewrite !split_agrees. reflexivity. Qed.

(** [minus]: the [difference] of each component. [NEAR-5] *)
Theorem minus_agrees ax ay az bx by_ bz :
  let '(x, x', y, y', z, z') := predicates_minus rounded ax ay az bx by_ bz in
  ((x, x'), (y, y'), (z, z')) = (Expansion.difference ax bx, Expansion.difference ay by_, Expansion.difference az bz).
Proof. reflexivity. Qed.
