(** Trees, keys, descents, and the reference traversal: [ORACLE-1] of spec/traversal.md, for all trees.

    A key is a [positive]: its constructors are the path, read from the node up to the root. [xO k] is the left child of
    [k], [xI k] the right one, [xH] the root. *)

Require Import List PArith NArith.
Import ListNotations.

Inductive side := L | R.

Definition other (s : side) := match s with L => R | R => L end.

Inductive tree := Leaf | Node (l r : tree).

Definition child (s : side) (k : positive) : positive := match s with L => xO k | R => xI k end.

Definition subtree (s : side) (l r : tree) : tree := match s with L => l | R => r end.

(** The node of a key; [None] where the tree has no such key. *)
Fixpoint at_key (t : tree) (k : positive) : option tree :=
  match k with
  | xH => Some t
  | xO k => match at_key t k with Some (Node l _) => Some l | _ => None end
  | xI k => match at_key t k with Some (Node _ r) => Some r | _ => None end
  end.

Fixpoint height (t : tree) : nat :=
  match t with Leaf => 0 | Node l r => S (Nat.max (height l) (height r)) end.

Fixpoint size (t : tree) : nat :=
  match t with Leaf => 1 | Node l r => S (size l + size r) end.

(** Depth of a node, in edges. *)
Fixpoint depth (k : positive) : nat := match k with xH => 0 | xO k | xI k => S (depth k) end.

(** What the visit of an inner node decides. *)
Inductive descent := Neither | Only (s : side) | Both (first : side).

Section Reference.

(** Keys of the visits so far, the latest first: the present node is the head. Whatever a visitor knows, it knows from there
    or from the outside; so a decision that is a function of the history is any decision that may change with time. *)
Definition history := list positive.

Variable decide : history -> descent.
(** Whether the search ends at this leaf. *)
Variable stop : history -> bool.

(** Visits a subtree whose root has key [k]; whether the search has been stopped, and the history. *)
Fixpoint visit (t : tree) (k : positive) (h : history) : bool * history :=
  let h := k :: h in
  match t with
  | Leaf => (stop h, h)
  | Node l r =>
      match decide h with
      | Neither => (false, h)
      | Only s => visit (subtree s l r) (child s k) h
      | Both s =>
          let '(stopped, h) := visit (subtree s l r) (child s k) h in
          if stopped then (true, h) else visit (subtree (other s) l r) (child (other s) k) h
      end
  end.

(** The reference, from the root. *)
Definition reference (t : tree) : bool * history := visit t xH [].

End Reference.
