(** Ancestors by references in the record: [WIDE-15]. *)

Require Import List Arith Lia.
Require Import Wide.
Import ListNotations.

Section Ancestor.

(** The record of a node names its nearest ancestors, so many. *)
Variable a : nat.
Hypothesis a_positive : 0 < a.

(** The [i]-th of them. *)
Definition named (i : nat) (k : path) : path := skipn i k.

(** So many steps to the last of them. *)
Fixpoint strides (n : nat) (k : path) : path := match n with 0 => k | S n => strides n (named a k) end.

Definition whole (m : nat) : nat := (m - 1) / a.
Definition rest (m : nat) : nat := (m - 1) mod a + 1.

Lemma skipn_skipn {X} i : forall j (l : list X), skipn i (skipn j l) = skipn (j + i) l.
Proof.
  intros j. induction j as [|j IH]; intros l; [reflexivity|]. destruct l; [now destruct i|apply IH].
Qed.

Lemma strides_skip n : forall k, strides n k = skipn (a * n) k.
Proof.
  induction n as [|n IH]; intros k; [now rewrite Nat.mul_0_r|]. simpl. rewrite IH. unfold named. rewrite skipn_skipn.
  f_equal. lia.
Qed.

(** [WIDE-15] Steps of [a] levels, and one of the rest, come to the ancestor [m] levels up; the rest is named; and there are no
    steps before it if and only if [m] is at most [a]. *)
Theorem ancestor_by_references m k : 0 < m ->
  named (rest m) (strides (whole m) k) = skipn m k /\ 1 <= rest m <= a /\ (whole m = 0 <-> m <= a).
Proof.
  intros Hm. unfold named, rest, whole. rewrite strides_skip, skipn_skipn.
  pose proof (Nat.div_mod (m - 1) a ltac:(lia)). pose proof (Nat.mod_upper_bound (m - 1) a ltac:(lia)).
  split; [f_equal; lia|]. split; [lia|]. rewrite Nat.div_small_iff by lia. lia.
Qed.

End Ancestor.
