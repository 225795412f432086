(** The exact sums: what Expansion.v is about is what Operations.v has, with real numbers that are rounded to double precision. *)
Require Import Reals ZArith Lia Lra Bool List.
From Flocq Require Import Core.
Require Import StacklessExact.Rounding StacklessExact.Range StacklessExact.Arithmetic StacklessExact.Operations.
Require StacklessExact.Expansion.
Open Scope R_scope.

Notation rounded := (reals R64).

(** [two_sum]. [EXACT-8] *)
Theorem two_sum_agrees a b : sum_two_sum rounded a b = Expansion.two_sum a b.
Proof. reflexivity. Qed.

(** [split]. [EXACT-8] *)
Theorem split_agrees a : sum_split rounded a = Expansion.split a.
Proof.
  unfold sum_split, Expansion.split. cbn [reals constant times minus].
  replace (IZR 134217729 * bpow radix2 0) with 134217729 by (simpl; ring). reflexivity.
Qed.

(** [two_product]. [EXACT-8] *)
Theorem two_product_agrees a b : sum_two_product rounded a b = Expansion.two_product a b.
Proof. unfold sum_two_product. rewrite !split_agrees. reflexivity. Qed.

(** [minus]: the [difference] of each component. [EXACT-8] *)
Theorem minus_agrees ax ay az bx by_ bz :
  let '(x, x', y, y', z, z') := predicates_minus rounded ax ay az bx by_ bz in
  ((x, x'), (y, y'), (z, z')) = (Expansion.difference ax bx, Expansion.difference ay by_, Expansion.difference az bz).
Proof. reflexivity. Qed.

(** A comparison with 0, and the decision of Expansion.v. *)
Lemma is_zero (T : Type) (x : R) (yes no : T) : (if equal rounded x (constant rounded 0 0) then yes else no) = if Req_EM_T x 0 then yes else no.
Proof.
  cbn [reals equal constant]. replace (IZR 0 * bpow radix2 0) with 0 by ring.
  destruct (Req_bool_spec x 0), (Req_EM_T x 0); try reflexivity; contradiction.
Qed.

Lemma is_not_zero (T : Type) (x : R) (yes no : T) :
  (if negb (equal rounded x (constant rounded 0 0)) then yes else no) = if Req_EM_T x 0 then no else yes.
Proof. rewrite <- is_zero. now destruct (equal _ _ _). Qed.

(** [Sum::add_product], with [Sum::add] as Expansion.v has it. [EXACT-8] *)
Theorem add_product_agrees terms a a' b b' c :
  Sum_add_product rounded (list R) (fun terms x => Expansion.add x terms) terms a a' b b' c = Expansion.add_product (a, a') (b, b') c terms.
Proof.
  unfold Sum_add_product, Expansion.add_product, Expansion.add_two, Expansion.add_part. cbn [fold_left fst snd].
  rewrite !two_product_agrees.
  repeat (rewrite ?two_product_agrees; match goal with |- context [Expansion.two_product ?x ?y] => destruct (Expansion.two_product x y) end).
  cbv zeta. rewrite !is_not_zero, is_zero.
  repeat match goal with |- context [Req_EM_T ?x 0] => destruct (Req_EM_T x 0) end; reflexivity.
Qed.

(** [add_edge]. [EXACT-8] *)
Theorem add_edge_agrees dx dy dz ax ax' ay ay' az az' bx bx' by_ by' bz bz' terms :
  predicates_add_edge rounded (list R) (fun terms x => Expansion.add x terms) terms dx dy dz ax ax' ay ay' az az' bx bx' by_ by' bz bz' =
  Expansion.add_edge dx dy dz ((ax, ax'), (ay, ay'), (az, az')) ((bx, bx'), (by_, by'), (bz, bz')) terms.
Proof. unfold predicates_add_edge. cbv zeta. rewrite !add_product_agrees. reflexivity. Qed.
