(** Key and trail, and the node of each new key from a table: Glassner 1984, and complete trees in level order. *)

Require Import List PArith NArith Lia Bool.
Require Import Tree Machine Bits Register HashedKeys Resume.
Import ListNotations.

Section ByKey.

Variable T : tree.
Variable lookup : positive -> positive.
(** The table is right for the keys that there are. *)
Hypothesis table : forall k u, at_key T k = Some u -> lookup k = k.

(** The node, by its key; its key; the trail. *)
Definition by_key_state : Type := positive * (positive * N).

Definition find (a : positive * N) : by_key_state := (lookup (fst a), a).

Definition by_key_machine : cursor := {|
  state := by_key_state;
  start := (xH, (xH, 0%N));
  key_of s := Some (fst s);
  descend d s := find (trail_descend d (snd s));
  backtrack s := option_map find (trail_backtrack (snd s)) |}.

Definition found (a : positive * N) (b : by_key_state) : Prop :=
  b = (fst a, a) /\ fits (fst a) (snd a) /\ exists u, at_key T (fst a) = Some u.

Lemma find_found k t u : at_key T k = Some u -> fits k t -> found (k, t) (find (k, t)).
Proof. intros Hk Hf. unfold found, find. cbn. rewrite (table k u Hk). eauto. Qed.

Lemma by_key_simulates : simulates T trail_machine by_key_machine any_descent found.
Proof.
  split; cbn.
  - repeat split. now exists T.
  - now intros a b (-> & _).
  - intros [k t] b d k0 l r (-> & Hf & _) [= <-] Hk Hd _. cbn in Hf.
    destruct d as [|sd|sd]; [congruence|..]; apply (find_found _ _ (subtree sd l r)); try apply at_child, Hk;
      now apply fits_child.
  - intros a b (-> & _) H. cbn [snd]. now rewrite H.
  - intros [k t] b [k' t'] (-> & Hf & u & Hu) H. cbn [snd fst] in *. rewrite H. exists (find (k', t')). split; [reflexivity|].
    pose proof (trail_pops k t Hf) as Hp. change (trail_backtrack (k, t) = Some (k', t')) in H. rewrite H in Hp.
    destruct (pending k t) as [|q p] eqn:Hq; [discriminate|]. destruct Hp as (t1 & [= <- <-] & Hf' & _).
    assert (Hin : In k' (k :: siblings k)).
    { right. assert (Hs : forall x, In x (pending k t) -> In x (siblings k)) by
        (clear; revert t; induction k as [k IH|k IH|]; intros t x; cbn; [| |tauto]; destruct (N.odd t); cbn;
          intros H; repeat destruct H as [H|H]; eauto).
      apply Hs. rewrite Hq. now left. }
    destruct (siblings_in_tree T k u Hu k' Hin) as (u' & Hu'). exact (find_found k' t' u' Hu' Hf').
Qed.

(** [GLASSNER-1, COMPLETE-1, HASHONLY-1] Over any table that is right for the keys of the tree's nodes, whatever it gives for
    others, this machine has the reference's visits and answer, and ends. *)
Theorem by_key_reference decide stop fuel : size T <= fuel ->
  run by_key_machine T decide stop fuel (start by_key_machine) [] = Some (reference decide stop T).
Proof.
  eapply refines_reference; [exact (simulates_refines _ _ _ _ _ _ (trail_refines T) by_key_simulates)|apply any_decision].
Qed.

End ByKey.
