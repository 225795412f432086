(** Keys are names of nodes: [KEY-7] of spec/traversal.md. *)

Require Import List PArith NArith.
Require Import Tree Machine.
Import ListNotations.

(** A node by the way to it: the last step first. *)
Definition way := list side.

Fixpoint key_of (p : way) : positive := match p with [] => xH | s :: p => child s (key_of p) end.

(** The node at the end of a way; [None] where the tree has no such way. *)
Fixpoint at_way (T : tree) (p : way) : option tree :=
  match p with
  | [] => Some T
  | s :: p => match at_way T p with Some (Node l r) => Some (subtree s l r) | _ => None end
  end.

(** [KEY-7] A key leads to the node whose key it is. *)
Theorem key_leads T p : at_key T (key_of p) = at_way T p.
Proof. induction p as [|[|] p IH]; cbn; [reflexivity|rewrite IH..]; destruct (at_way T p) as [[|]|]; reflexivity. Qed.

(** [KEY-7] Two nodes have two keys. *)
Theorem key_injective p q : key_of p = key_of q -> p = q.
Proof.
  revert q. induction p as [|[|] p IH]; intros [|[|] q]; cbn; try discriminate; [reflexivity|..]; intros [= E]; f_equal; auto.
Qed.

(** [KEY-7] Every key is that of a node, if the tree reaches so far. *)
Theorem key_surjective k : exists p, key_of p = k.
Proof.
  induction k as [k (p & <-)|k (p & <-)|]; [exists (R :: p)|exists (L :: p)|exists []]; reflexivity.
Qed.

(** [KEY-7] The parent undoes the child. *)
Theorem parent_of_child s k : up 1 (child s k) = k.
Proof. now destruct s. Qed.

(** [KEY-7] The sibling of a child is the other child. *)
Theorem sibling_of_child s k : sibling (child s k) = child (other s) k.
Proof. now destruct s. Qed.
