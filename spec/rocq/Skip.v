(** Skip pointers, in the order left before right: Smits 1998. *)

Require Import List PArith NArith.
Require Import Tree Machine Implicit.
Import ListNotations.

(** [SKIP-1] How the pointers are made, parents before children: a left child's is its sibling, a right child's is its
    parent's. None after the last node. *)
Fixpoint skip (k : positive) : option positive :=
  match k with xH => None | xO k => Some (xI k) | xI k => skip k end.

(** A node is all the state. *)
Definition skip_machine : cursor := {|
  state := positive;
  start := xH;
  key_of := Some;
  descend _ k := xO k;
  backtrack := skip |}.

(** What is postponed: the right sibling of each ancestor that is a left child. *)
Fixpoint rights (k : positive) : list positive :=
  match k with xH => [] | xO k => xI k :: rights k | xI k => rights k end.

Lemma skip_is_first k : skip k = hd_error (rights k).
Proof. induction k; auto. Qed.

Lemma rights_of_first k q p : rights k = q :: p -> rights q = p.
Proof. induction k as [k IH|k _|]; cbn; [exact IH|now intros [= <- <-]|discriminate]. Qed.

(** [SKIP-1] The machine of skip pointers has the visits and the answer of a left-first search with tests of nodes, and ends. *)
Theorem skip_machine_reference T accept stop fuel : size T <= fuel ->
  run skip_machine T (node_test accept) stop fuel (start skip_machine) [] = Some (visit_left accept stop T xH []).
Proof.
  rewrite visit_left_is_visit.
  apply (refines_reference skip_machine T _ _ (fun d => d = Both L) (fun (s k : positive) p => s = k /\ rights k = p)).
  - split; cbn.
    + auto.
    + now intros s k p (-> & _).
    + discriminate.
    + intros s k p sd l r (-> & <-) _ [= ->]. auto.
    + intros s k (-> & H). now rewrite skip_is_first, H.
    + intros s k q p (-> & H). exists q. rewrite skip_is_first, H. eauto using rights_of_first.
  - intros h. unfold node_test. destruct (accept h); auto.
Qed.
