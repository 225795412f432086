(** Traversals that are put aside and taken up again: [PAUSE-1] to [PAUSE-4] of spec/state.md. *)

Require Import List PArith NArith Lia Bool Arith.
Require Import Tree Machine Register HashedKeys.
Import ListNotations.

(** * Going on *)

Section Resume.

Variable T : tree.
Variable decide : history -> descent.
Variable stop : history -> bool.

(** With enough fuel, whatever is enough. *)
Definition comes_to (go : nat -> option (bool * history)) (x : bool * history) : Prop :=
  exists n, forall f, n <= f -> go f = Some x.

Lemma comes_to_one go x y : comes_to go x -> comes_to go y -> x = y.
Proof.
  intros (n & Hn) (m & Hm). specialize (Hn (n + m) ltac:(lia)). specialize (Hm (n + m) ltac:(lia)). congruence.
Qed.

(** What has been visited stays visited, in the same order. *)
Lemma run_extends C f : forall s h b h', run C T decide stop f s h = Some (b, h') -> exists g, h' = g ++ h.
Proof.
  induction f as [|f IH]; intros s h b h' H; [discriminate|]. cbn in H.
  assert (E : forall s1 h1, step C T decide stop s h = Going s1 h1 -> exists k, h1 = k :: h).
  { intros s1 h1. unfold step, back. destruct (key_of C s) as [k|]; [|discriminate].
    destruct (at_key T k) as [[|]|]; [destruct (stop (k :: h));
      [discriminate|]|destruct (decide (k :: h))|discriminate];
      try (destruct (backtrack C s); [|discriminate]); intros [= _ <-]; eauto. }
  assert (D : forall b1 h1, step C T decide stop s h = Done b1 h1 -> exists k, h1 = k :: h).
  { intros b1 h1. unfold step, back. destruct (key_of C s) as [k|]; [|discriminate].
    destruct (at_key T k) as [[|]|]; [destruct (stop (k :: h)); [intros [= _ <-]; eauto|]
      |destruct (decide (k :: h)); try discriminate|discriminate];
      (destruct (backtrack C s); [discriminate|]); intros [= _ <-]; eauto. }
  destruct (step C T decide stop s h) as [s1 h1|b1 h1|] eqn:Hs; [| |discriminate].
  - destruct (E _ _ eq_refl) as (k & ->). destruct (IH _ _ _ _ H) as (g & ->).
    exists (g ++ [k]). now rewrite <- app_assoc.
  - injection H as -> ->. destruct (D _ _ eq_refl) as (k & ->). now exists [k].
Qed.

Section Cursors.

Variable C : cursor.
Variable R : state C -> positive -> list positive -> Prop.
Hypothesis Ref : refines C T any_descent R.

(** From any state that the loop comes to, running on gives the rest. *)
Lemma reached_goes_on s h : reached C T decide stop s h ->
  comes_to (fun f => run C T decide stop f s h) (reference decide stop T).
Proof.
  intros H. enough (exists m, forall f, run C T decide stop (m + f) (start C) [] =
    run C T decide stop f s h) as (m & Hm).
  { exists (size T). intros f Hf. rewrite <- Hm.
    apply (refines_reference _ _ _ _ _ _ Ref (any_decision decide)). lia. }
  induction H as [|s h s' h' _ (m & Hm) Hs]; [exists 0; reflexivity|].
  exists (S m). intros f. replace (S m + f) with (m + S f) by lia. rewrite Hm. cbn. now rewrite Hs.
Qed.

Lemma after_visit_all s k p h : R s k p -> (forall q, In q p -> exists t, at_key T q = Some t) ->
  comes_to (fun f => after C T decide stop f s h) (visit_all T decide stop p h).
Proof.
  intros HR Hin. destruct p as [|q p].
  - exists 0. intros f _. unfold after. now rewrite (r_done _ _ _ _ Ref _ _ HR).
  - destruct (r_next _ _ _ _ Ref _ _ _ _ HR) as (s' & Hb & HR').
    destruct (refines_visit_all _ _ decide stop _ _ Ref (any_decision decide) p s' q h HR' Hin) as (n & Hn).
    exists n. intros f Hf. unfold after. rewrite Hb. now apply Hn.
Qed.

End Cursors.

Variables C1 C2 : cursor.
Variable R1 : state C1 -> positive -> list positive -> Prop.
Variable R2 : state C2 -> positive -> list positive -> Prop.
Hypothesis Ref1 : refines C1 T any_descent R1.
Hypothesis Ref2 : refines C2 T any_descent R2.

(** [PAUSE-1] A traversal that is put aside before any visit and taken up again, by itself or by any other, from a
    state that stands for the same node and the same postponed nodes, goes on as if it had not been stopped. *)
Theorem resumes s1 s2 k p h : reached C1 T decide stop s1 h -> R1 s1 k p -> R2 s2 k p ->
  (forall q, In q (k :: p) -> exists t, at_key T q = Some t) ->
  comes_to (fun f => run C2 T decide stop f s2 h) (reference decide stop T).
Proof.
  intros H H1 H2 Hin.
  assert (E : visit_all T decide stop (k :: p) h = reference decide stop T).
  { eapply comes_to_one; [|exact (reached_goes_on C1 R1 Ref1 _ _ H)].
    exact (refines_visit_all _ _ decide stop _ _ Ref1 (any_decision decide) p s1 k h H1 Hin). }
  rewrite <- E. exact (refines_visit_all _ _ decide stop _ _ Ref2 (any_decision decide) p s2 k h H2 Hin).
Qed.

(** [PAUSE-1] The same for one that is put aside after a visit that turns back, as that of a leaf does. *)
Theorem resumes_after s1 s2 k p h : reached C1 T decide stop s1 h -> R1 s1 k p -> R2 s2 k p ->
  (forall q, In q (k :: p) -> exists t, at_key T q = Some t) -> turns_back T decide stop (k :: h) ->
  comes_to (fun f => after C2 T decide stop f s2 (k :: h)) (reference decide stop T).
Proof.
  intros H H1 H2 Hin Hb.
  assert (Hp : forall q, In q p -> exists t, at_key T q = Some t) by (intros; apply Hin; now right).
  assert (E : visit_all T decide stop p (k :: h) = reference decide stop T).
  { eapply comes_to_one; [exact (after_visit_all C1 R1 Ref1 s1 k p (k :: h) H1 Hp)|].
    destruct (reached_goes_on C1 R1 Ref1 _ _ H) as (n & Hn). exists n. intros f Hf. rewrite <- (Hn (S f)) by lia.
    cbn. unfold step. rewrite (r_key _ _ _ _ Ref1 _ _ _ H1). unfold turns_back in Hb. unfold after, back.
    destruct (at_key T k) as [[|]|]; [| |tauto]; rewrite Hb; now destruct (backtrack C1 s1). }
  rewrite <- E. exact (after_visit_all C2 R2 Ref2 s2 k p (k :: h) H2 Hp).
Qed.

End Resume.

(** * From key and trail *)

(** The register of key and trail: the node that comes next. *)
Definition located_register (k : positive) (t : N) : option positive := if N.eqb t 0 then None else Some (next k t).

Definition located (k : positive) (t : N) : hashed_state := Hashed k k t (located_register k t).

Lemma located_holds k t : holds k t (located_register k t).
Proof. unfold located_register. destruct (N.eqb_spec t 0) as [->|H]; [reflexivity|]. now split. Qed.

Lemma located_stack k t p : trail_stack (k, t) k p -> hashed_stack (located k t) k p.
Proof. intros H. exists (k, t). split; [exact H|]. repeat split. apply located_holds. Qed.

Section KeyAndTrail.

Variable T : tree.
Variables Ui Ul : nat.
Variable keep : positive -> N -> bool.
Variable decide : history -> descent.
Variable stop : history -> bool.

Let C := hashed T Ui Ul keep ideal.

(** [PAUSE-2] Key and trail of any state of Algorithm 1 are enough: with its node and its register located, the
    traversal goes on with what is left. *)
Theorem key_and_trail_resume s h : reached C T decide stop s h ->
  comes_to (fun f => run C T decide stop f (located (key s) (trail s)) h) (reference decide stop T).
Proof.
  intros H. destruct (reached_refines _ _ _ _ _ _ (hashed_refines T Ui Ul keep) (any_decision decide) _ _ H)
    as (k & p & Hs & Hin).
  apply (resumes T decide stop C C hashed_stack hashed_stack (hashed_refines T Ui Ul keep) (hashed_refines T Ui Ul keep)
    s _ k p h H Hs); [|exact Hin].
  destruct Hs as ([k' t] & Ha & _ & Hk & Ht & _). cbn [fst snd] in *. rewrite Hk, Ht.
  assert (E : k' = k) by apply Ha. rewrite E in *. now apply located_stack.
Qed.

(** [PAUSE-2] The same after a visit that turns back. *)
Theorem key_and_trail_resume_after s h : reached C T decide stop s h -> turns_back T decide stop (key s :: h) ->
  comes_to (fun f => after C T decide stop f (located (key s) (trail s)) (key s :: h)) (reference decide stop T).
Proof.
  intros H. destruct (reached_refines _ _ _ _ _ _ (hashed_refines T Ui Ul keep) (any_decision decide) _ _ H)
    as (k & p & Hs & Hin).
  pose proof Hs as ([k' t] & Ha & _ & Hk & Ht & _). cbn [fst snd] in *. rewrite Hk, Ht.
  assert (E : k' = k) by apply Ha. rewrite E in *. intros Hb.
  apply (resumes_after T decide stop C C hashed_stack hashed_stack (hashed_refines T Ui Ul keep)
    (hashed_refines T Ui Ul keep) s _ k p h H Hs); [now apply located_stack|exact Hin|exact Hb].
Qed.

(** [PAUSE-3] Where bit 0 of the trail is clear, the register need not come with the state. *)
Theorem register_not_needed k t p h : trail_stack (k, t) k p -> N.odd t = false ->
  (forall q, In q (k :: p) -> exists u, at_key T q = Some u) ->
  comes_to (fun f => run C T decide stop f (Hashed k k t None) h) (visit_all T decide stop (k :: p) h).
Proof.
  intros Ha He Hin. apply (refines_visit_all _ _ decide stop _ _ (hashed_refines T Ui Ul keep)
    (any_decision decide)); [|exact Hin].
  exists (k, t). split; [exact Ha|]. repeat split. exact He.
Qed.

End KeyAndTrail.

(** [PAUSE-3] No record names its node's sibling, however far it reaches. *)
Theorem no_row_has_sibling reach k : k <> xH -> ~ In (sibling k) (row reach k).
Proof.
  intros Hk H. unfold row in H. apply in_map_iff in H. destruct H as (i & E & Hi). apply in_seq in Hi.
  apply (f_equal depth) in E. rewrite !depth_sibling, depth_up in E. pose proof (depth_pos k Hk). lia.
Qed.

(** [PAUSE-3] Without the register, the record of node 6, whose sibling is postponed, and whose uncle is too, leads to
    the uncle with the sibling's key. With the register located, to the sibling. *)
Example sibling_lost : let T := Node Leaf (Node Leaf Leaf) in
  hashed_backtrack T 2 2 ideal (Hashed 6 6 3 None) = Some (Hashed 2 7 2 None) /\
  hashed_backtrack T 2 2 ideal (located 6 3) = Some (Hashed 7 7 2 None).
Proof. split; reflexivity. Qed.

(** [PAUSE-2] The table of [HASH-3] does not find every node: of a tree with three nodes it has none. *)
Example table_without_child : forall x, ~ hashed_key (Node Leaf Leaf) 2 2 x.
Proof.
  intros x H. destruct (hashed_keys_are_nodes _ _ _ _ H) as (H1 & t & _). pose proof H as (z & n & _ & Hu & _ & Hz).
  destruct (at_key (Node Leaf Leaf) z) as [u|] eqn:Hat; [|tauto].
  destruct (at_up _ n z u Hat) as (ts & Hts). rewrite Hu in Hts. apply (hashed_iff_high _ 2 2 x ts H1 Hts) in H.
  assert (Hne : sibling x <> xH) by now destruct x.
  pose proof (at_height _ _ _ Hts) as E. pose proof (depth_pos _ Hne). cbn in H, E. lia.
Qed.

(** * From the key alone *)

(** The siblings of a node and of its ancestors, from below. *)
Fixpoint siblings (k : positive) : list positive :=
  match k with xH => [] | xO k' | xI k' => sibling k :: siblings k' end.

(** The trail of a key alone: a one for each level. *)
Definition all_ones (k : positive) : N := N.pred (2 ^ N.of_nat (depth k)).

Lemma pred_double_power n : N.pred (2 * 2 ^ n) = N.succ_double (N.pred (2 ^ n)).
Proof. assert (2 ^ n <> 0)%N by (apply N.pow_nonzero; discriminate). rewrite N.succ_double_spec. lia. Qed.

Lemma all_ones_stack k : trail_stack (k, all_ones k) k (siblings k).
Proof.
  unfold trail_stack, all_ones. cbn [fst snd]. split; [reflexivity|].
  induction k as [k [IHf IHp]|k [IHf IHp]|]; [| |split; reflexivity];
    cbn [fits pending siblings depth]; rewrite Nat2N.inj_succ, N.pow_succ_r', pred_double_power, (proj2
      (div2_double _));
    (split; [exact IHf|]); rewrite IHp; destruct (N.pred _); reflexivity.
Qed.

Lemma siblings_in_tree T k t : at_key T k = Some t -> forall q, In q (k :: siblings k) ->
  exists t', at_key T q = Some t'.
Proof.
  revert t. induction k as [k IH|k IH|]; intros t Ht q [<-|Hq]; eauto; [| |destruct Hq];
    cbn in Ht; destruct (at_key T k) as [[|l r]|] eqn:Hk; try discriminate; specialize (IH _ eq_refl q);
    (destruct Hq as [<-|Hq]; [cbn; rewrite Hk; eauto|apply IH; now right]).
Qed.

(** [PAUSE-4] From the key alone, with a trail of ones, any right cursor visits the node's subtree, then its
    sibling's, its parent's sibling's and so on: whole subtrees of the reference, without a test of these siblings.
    Here for key and trail, and for Algorithm 1 with its register located. *)
Theorem key_only T decide stop k t h : at_key T k = Some t ->
  comes_to (fun f => run trail_machine T decide stop f (k, all_ones k) h) (visit_all T decide stop (k :: siblings k) h).
Proof.
  intros Hk. apply (refines_visit_all _ _ decide stop _ _ (trail_refines T) (any_decision decide)).
  - apply all_ones_stack.
  - exact (siblings_in_tree T k t Hk).
Qed.

(** [PAUSE-4] The same. *)
Theorem key_only_hashed T Ui Ul keep decide stop k t h : at_key T k = Some t ->
  comes_to (fun f => run (hashed T Ui Ul keep ideal) T decide stop f (located k (all_ones k)) h)
    (visit_all T decide stop (k :: siblings k) h).
Proof.
  intros Hk. apply (refines_visit_all _ _ decide stop _ _ (hashed_refines T Ui Ul keep) (any_decision decide)).
  - apply located_stack, all_ones_stack.
  - exact (siblings_in_tree T k t Hk).
Qed.

(** [PAUSE-4] Departure D-24: put aside before node 3, and taken up from its key, a search sees leaf 2 again. So one
    that counts is wrong. *)
Example seen_again : visit_all (Node Leaf Leaf) (by_key (fun _ => Both L)) never (3 :: siblings 3)%positive [2;
  1]%positive =
  (false, [2; 3; 2; 1]%positive).
Proof. reflexivity. Qed.
