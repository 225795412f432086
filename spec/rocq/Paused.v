(** States that are put aside and taken up as functions: [PAUSE-1], [PAUSE-2] and [PAUSE-5] of spec/state.md. *)

Require Import List PArith NArith Lia Bool Arith.
Require Import Tree Machine Bits Combined Sparse Register HashedKeys Resume Disjoint DisjointHashed Climb ResumePruned.
Import ListNotations.

(** * Without a second trail *)

Section Paused.

Variable T : tree.

(** What is kept is key and trail. *)
Record pausable := Pausable {
  machine : cursor;
  stands : state machine -> positive -> list positive -> Prop;
  put_aside : state machine -> positive * N;
  take_up : positive * N -> state machine;
  p_refines : refines machine T any_descent stands;
  p_put s k p : stands s k p -> trail_stack (put_aside s) k p;
  p_take a k p : trail_stack a k p -> stands (take_up a) k p }.

Variables A B : pausable.
Variable decide : history -> descent.
Variable stop : history -> bool.

(** [PAUSE-1, PAUSE-2] Put aside before any visit and taken up by any machine, the same or another, a traversal goes on with the
    rest of the reference. *)
Theorem put_aside_goes_on s h : reached (machine A) T decide stop s h ->
  comes_to (fun f => run (machine B) T decide stop f (take_up B (put_aside A s)) h) (reference decide stop T).
Proof.
  intros H. destruct (reached_refines _ _ _ _ _ _ (p_refines A) (any_decision decide) _ _ H) as (k & p & Hs & Hin).
  exact (resumes T decide stop _ _ _ _ (p_refines A) (p_refines B) s _ k p h H Hs
    (p_take B _ k p (p_put A s k p Hs)) Hin).
Qed.

(** [PAUSE-1, PAUSE-2] So after a leaf, or any other visit that turns back. *)
Theorem put_aside_goes_on_after s h : reached (machine A) T decide stop s h ->
  turns_back T decide stop (fst (put_aside A s) :: h) ->
  comes_to (fun f => after (machine B) T decide stop f (take_up B (put_aside A s)) (fst (put_aside A s) :: h))
    (reference decide stop T).
Proof.
  intros H. destruct (reached_refines _ _ _ _ _ _ (p_refines A) (any_decision decide) _ _ H) as (k & p & Hs & Hin).
  pose proof (p_put A s k p Hs) as Ha. rewrite (proj1 Ha).
  exact (resumes_after T decide stop _ _ _ _ (p_refines A) (p_refines B) s _ k p h H Hs (p_take B _ k p Ha) Hin).
Qed.

End Paused.

(** The machines that are put aside. *)
Section Machines.

Variable T : tree.
Variables Ui Ul : nat.
Variable keep : positive -> N -> bool.

Definition paused_trail : pausable T := Pausable T trail_machine trail_stack (fun s => s) (fun a => a) (trail_refines T)
  (fun s k p H => H) (fun a k p H => H).

(** The register is located. *)
Definition paused_hashed : pausable T.
Proof.
  refine (Pausable T (hashed T Ui Ul keep ideal) hashed_stack (fun s => (key s, trail s)) (fun a => located (fst a) (snd a))
    (hashed_refines T Ui Ul keep) _ _).
  - intros s k p ([k' t'] & Ha & _ & -> & -> & _). exact Ha.
  - intros [k' t] k p H. pose proof H as (E & _). cbn in E. subst. apply located_stack, H.
Defined.

Definition paused_afra : pausable T.
Proof.
  refine (Pausable T afra _ (fun s => s) (fun a => a) (simulates_refines _ _ _ _ _ _ (trail_refines T) (afra_simulates T)) _ _).
  - intros s k p (a & Ha & <-). exact Ha.
  - intros a k p H. now exists a.
Defined.

(** Of a traversal that counts, the trail is the counter's complement; the start of the level is at the depth of the node. *)
Definition put_sparse (s : sparse_state) : positive * N :=
  match s with Some (k, c) => (k, counter (S (depth k)) c) | None => (xH, 0%N) end.

Definition take_sparse (a : positive * N) : sparse_state := Some (fst a, counter (S (depth (fst a))) (snd a)).

Definition paused_sparse : pausable T.
Proof.
  refine (Pausable T sparse _ put_sparse take_sparse (simulates_refines _ _ _ _ _ _ (trail_refines T) (sparse_simulates T)) _ _).
  - intros s k p ([k' t] & Ha & Hf & ->). cbn. rewrite combined_is_counter, counter_involutive by exact Hf. exact Ha.
  - intros [k' t] k p H. pose proof H as (E & Hf & _). cbn in E, Hf. subst. exists (k, t). split; [exact H|].
    split; [exact Hf|]. unfold take_sparse. cbn [fst snd]. now rewrite combined_is_counter.
Defined.

(** Where the records reach two levels. *)
Hypothesis reaches : 2 <= Ui /\ 2 <= Ul.

Definition paused_uncle : pausable T.
Proof.
  refine (Pausable T (uncle T Ui Ul keep) _ (fun s => (u_node s, u_trail s))
    (fun a => Uncle (fst a) (snd a) (located_register (fst a) (snd a)))
    (simulates_refines _ _ _ _ _ _ (trail_refines T) (uncle_simulates T Ui Ul keep reaches)) _ _).
  - intros s k p ([k' t] & Ha & -> & -> & _). exact Ha.
  - intros [k' t] k p H. exists (k', t). split; [exact H|]. repeat split. apply located_holds.
Defined.

End Machines.

(** * With a second trail *)

Section Marked.

Variable T : tree.
Variable decide : history -> descent.
Variables mark stop found : history -> bool.

Lemma leaf_step P s k h f : pkey P s = Some k -> at_key T k = Some Leaf -> stop (k :: h) = false ->
  prun T decide mark stop found P (S f) s h =
  pafter T decide mark stop found P f (if found (k :: h) then pprune P s else s) (k :: h).
Proof. intros Hk Hl Hs. cbn. now rewrite Hk, Hl, Hs. Qed.

(** [PAUSE-1] A traversal that prunes, put aside after a leaf, what is found there having ended what it ends, is taken up by any other
    that prunes so. *)
Theorem pruned_resumes_after P1 P2 R1 R2 s1 s2 k p h : prefines T P1 R1 -> prefines T P2 R2 ->
  preached T decide mark stop found P1 s1 h -> R1 s1 k p -> at_key T k = Some Leaf -> stop (k :: h) = false ->
  R2 s2 k (pruned_if (found (k :: h)) p) -> in_tree T p ->
  comes_to (fun f => pafter T decide mark stop found P2 f s2 (k :: h)) (pruned_reference T decide mark stop found).
Proof.
  intros Ref1 Ref2 H H1 Hl Hs H2 Hin.
  pose proof (pafter_visit_all T decide mark stop found P1 R1 Ref1 p Hin (found (k :: h))
    (if found (k :: h) then pprune P1 s1 else s1) k (k :: h)) as E1.
  pose proof (pafter_visit_all T decide mark stop found P2 R2 Ref2 p Hin (found (k :: h)) s2 k (k :: h) H2) as E2.
  replace (pruned_reference T decide mark stop found)
    with (pvisit_all T decide mark stop found p (found (k :: h)) (k :: h)); [exact E2|].
  eapply comes_to_one; [apply E1; destruct (found (k :: h)); [apply (p_prune _ _ _ Ref1); assumption|exact H1]|].
  destruct (preached_goes_on T decide mark stop found P1 R1 Ref1 s1 h H) as (n & Hn). exists n. intros f Hf.
  rewrite <- (leaf_step P1 s1 k h f (p_key _ _ _ Ref1 _ _ _ H1) Hl Hs). apply Hn. lia.
Qed.

(** [PAUSE-2] Key, trail and second trail are enough after a leaf too: of Algorithm 1 the register is located. *)
Theorem marked_key_and_trail_resume_after Ui Ul keep lookup k t s h : (forall x, hashed_key T Ui Ul x -> lookup x = x) ->
  preached T decide mark stop found marked_machine (Marked k t s) h -> fits k t -> at_key T k = Some Leaf -> stop (k :: h) = false ->
  let t' := if found (k :: h) then N.ldiff t s else t in
  comes_to (fun f => pafter T decide mark stop found (hashed_disjoint T Ui Ul keep lookup) f (located k t', s) (k :: h))
    (pruned_reference T decide mark stop found).
Proof.
  intros Hl H Hf Hk Hs t'.
  apply (pruned_resumes_after marked_machine (hashed_disjoint T Ui Ul keep lookup) _ _ (Marked k t s) _ k
    (marked_pending k t s) h (marked_refines T) (hashed_disjoint_refines T Ui Ul keep lookup Hl) H); try assumption.
  - repeat split. exact Hf.
  - unfold t'. destruct (found (k :: h)); cbn [pruned_if].
    + repeat split; [apply located_holds|now exists Leaf|now apply fits_ldiff|apply mask_is_unmarked].
    + repeat split; [apply located_holds|now exists Leaf|exact Hf].
  - intros q m Hq. apply (siblings_in_tree T k Leaf Hk). right. exact (marked_pending_siblings k t s q m Hq).
Qed.

End Marked.

(** * Locating *)

(** [PAUSE-5] The state of a key and a trail; none where the tree has no such key, or the trail a bit above the root. *)
Definition locate (T : tree) (k : positive) (t : N) : option hashed_state :=
  match at_key T k with
  | Some _ => if N.to_nat (N.size t) <=? depth k then Some (located k t) else None
  | None => None
  end.

Lemma size_fits k t : N.to_nat (N.size t) <= depth k <-> fits k t.
Proof.
  rewrite fits_range. destruct (N.eq_dec t 0) as [->|H0].
  - split; [|cbn; lia]. intros _. apply N.neq_0_lt_0, N.pow_nonzero. discriminate.
  - rewrite N.size_log2, N.log2_lt_pow2 by lia. lia.
Qed.

(** [PAUSE-5] A state is located if and only if there is the node, and the trail has no bits above the root: also none that a lower one
    hides. *)
Theorem locate_iff T k t s : locate T k t = Some s <-> (exists u, at_key T k = Some u) /\ fits k t /\ s = located k t.
Proof.
  unfold locate. rewrite <- size_fits. destruct (at_key T k) as [u|].
  - destruct (Nat.leb_spec (N.to_nat (N.size t)) (depth k)).
    + split; [intros [= <-]; eauto|]. now intros (_ & _ & ->).
    + split; [discriminate|]. intros (_ & ? & _). lia.
  - split; [discriminate|]. now intros ((u & [=]) & _).
Qed.

(** [PAUSE-5] Then the nodes are there that it stands for, and the one in its register. *)
Theorem located_in_tree T k t s x : locate T k t = Some s -> register s = Some x -> exists u, at_key T x = Some u.
Proof.
  intros ((u & Hu) & Hf & ->)%locate_iff. unfold located, located_register. cbn.
  destruct (N.eqb_spec t 0) as [|H0]; [discriminate|]. intros [= <-].
  apply (siblings_in_tree T k u Hu). right. clear Hu u. unfold next. revert t Hf H0.
  assert (H : forall n, n < depth k -> In (sibling (up n k)) (siblings k)).
  { induction k as [k IH|k IH|]; intros [|n] Hn; cbn in *; try lia; try (now left); right; apply IH; lia. }
  intros t Hf H0. apply H, ctz_fits; assumption.
Qed.

(** [PAUSE-5] Key 2 with trail 3: bit 1 is above the root, and bit 0 alone would lead on to node 3. *)
Example hidden_bit : let T := Node Leaf Leaf in locate T 2 3 = None /\ locate T 2 1 = Some (Hashed 2 2 1 (Some 3%positive)).
Proof. split; reflexivity. Qed.
