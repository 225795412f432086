(** Traversals that prune, put aside and taken up again: [PAUSE-1, PAUSE-2, PAUSE-4] with a second trail. *)

Require Import List PArith NArith Lia Bool Arith.
Require Import Tree Machine Register HashedKeys Resume Disjoint DisjointHashed Closest.
Import ListNotations.

Section ResumePruned.

Variable T : tree.
Variable decide : history -> descent.
Variables mark stop found : history -> bool.

(** The reference that leaves nodes out, taken up with a stack of keys with their marks: the marked ones are left out
    once something has been found. *)
Fixpoint pvisit_all (ks : list (positive * bool)) (b : bool) (h : history) : bool * history :=
  match ks with
  | [] => (false, h)
  | (k, m) :: ks =>
      if m && b then pvisit_all ks b h else
      match at_key T k with
      | None => (false, h)
      | Some t =>
          let '(stopped, b', h) := pvisit decide mark stop found t k h in
          if stopped then (true, h) else pvisit_all ks (b || b') h
      end
  end.

Definition in_tree (p : list (positive * bool)) : Prop := forall q m, In (q, m) p -> exists t, at_key T q = Some t.

Lemma pruned_if_or b b' p : pruned_if b' (pruned_if b p) = pruned_if (b || b') p.
Proof. destruct b, b'; cbn; try reflexivity. apply unmarked_unmarked. Qed.

Section Pruner.

Variable P : pruner.
Variable R : pstate P -> positive -> list (positive * bool) -> Prop.
Hypothesis Ref : prefines T P R.

Let run := prun T decide mark stop found P.
Let after := pafter T decide mark stop found P.

Lemma pafter_visit_all p : in_tree p -> forall b s k h, R s k (pruned_if b p) ->
  comes_to (fun f => after f s h) (pvisit_all p b h).
Proof.
  induction p as [|[q m] p IH]; intros Hin b s k h HR.
  - exists 0. intros f _. unfold after, pafter. rewrite (p_done _ _ _ Ref s k); [reflexivity|]. now destruct b.
  - assert (Hp : in_tree p) by (intros q' m' H; apply (Hin q' m'); now right).
    cbn [pvisit_all]. destruct (m && b) eqn:Hm.
    + apply andb_prop in Hm. destruct Hm as [-> ->]. apply (IH Hp true s k). exact HR.
    + assert (HR' : R s k ((q, m) :: pruned_if b p)).
      { destruct b; [|exact HR]. rewrite andb_true_r in Hm. subst m. exact HR. }
      destruct (p_next _ _ _ Ref _ _ _ _ _ HR') as (s2 & Hb & HR2).
      destruct (Hin q m (or_introl eq_refl)) as (t & Ht). rewrite Ht.
      destruct (prun_visit T decide mark stop found P R Ref t q s2 _ h Ht HR2) as (n & _ & Hv).
      destruct (pvisit decide mark stop found t q h) as [[[|] b'] h1].
      * exists n. intros f Hf. unfold after, pafter. rewrite Hb. replace f with (n + (f - n)) by lia. apply Hv.
      * destruct Hv as (s3 & k3 & HR3 & Hv). rewrite pruned_if_or in HR3.
        destruct (IH Hp (b || b') s3 k3 h1 HR3) as (n2 & Hn2).
        exists (n + n2). intros f Hf. unfold after, pafter. rewrite Hb. replace f with (n + (f - n)) by lia.
        rewrite Hv. apply Hn2. lia.
Qed.

(** From any state the loop does what the reference does with the stack that the state stands for. *)
Lemma prun_visit_all s k p h : R s k p -> in_tree ((k, false) :: p) ->
  comes_to (fun f => run f s h) (pvisit_all ((k, false) :: p) false h).
Proof.
  intros HR Hin. destruct (Hin k false (or_introl eq_refl)) as (t & Ht). cbn. rewrite Ht.
  destruct (prun_visit T decide mark stop found P R Ref t k s p h Ht HR) as (n & _ & Hv).
  destruct (pvisit decide mark stop found t k h) as [[[|] b] h1].
  - exists n. intros f Hf. replace f with (n + (f - n)) by lia. apply Hv.
  - destruct Hv as (s' & k' & HR' & Hv).
    assert (Hp : in_tree p) by (intros q' m' H; apply (Hin q' m'); now right).
    destruct (pafter_visit_all p Hp b s' k' h1 HR') as (n2 & Hn2).
    exists (n + n2). intros f Hf. replace f with (n + (f - n)) by lia. unfold run. rewrite Hv. apply Hn2. lia.
Qed.

(** A state that the loop comes to, after some number of visits. *)
Definition preached (s : pstate P) (h : history) : Prop := exists m, forall f, run (m + f) (pstart P) [] = run f s h.

Lemma preached_goes_on s h : preached s h -> comes_to (fun f => run f s h) (pruned_reference T decide mark stop found).
Proof.
  intros (m & Hm). exists (size T). intros f Hf. rewrite <- Hm. eapply prefines_reference; [exact Ref|lia].
Qed.

End Pruner.

(** [PAUSE-1] A traversal that prunes, put aside before any visit, is taken up by any other that prunes so: what
    counts is the node, the postponed nodes and their marks. *)
Theorem pruned_resumes P1 P2 R1 R2 s1 s2 k p h : prefines T P1 R1 -> prefines T P2 R2 ->
  preached P1 s1 h -> R1 s1 k p -> R2 s2 k p -> in_tree ((k, false) :: p) ->
  comes_to (fun f => prun T decide mark stop found P2 f s2 h) (pruned_reference T decide mark stop found).
Proof.
  intros Ref1 Ref2 H H1 H2 Hin.
  rewrite <- (comes_to_one _ _ _ (prun_visit_all P1 R1 Ref1 s1 k p h H1 Hin) (preached_goes_on P1 R1 Ref1 s1 h H)).
  exact (prun_visit_all P2 R2 Ref2 s2 k p h H2 Hin).
Qed.

(** [PAUSE-2] Key, trail and second trail are enough: Algorithm 1 with its register located goes on with them. *)
Theorem marked_key_and_trail_resume Ui Ul keep lookup k t s h u : (forall x, hashed_key T Ui Ul x -> lookup x = x) ->
  preached marked_machine (Marked k t s) h -> fits k t -> at_key T k = Some u ->
  comes_to (fun f => prun T decide mark stop found (hashed_disjoint T Ui Ul keep lookup) f (located k t, s) h)
    (pruned_reference T decide mark stop found).
Proof.
  intros Hl H Hf Hu.
  apply (pruned_resumes marked_machine (hashed_disjoint T Ui Ul keep lookup) _ _ (Marked k t s) _ k
    (marked_pending k t s) h (marked_refines T)
    (hashed_disjoint_refines T Ui Ul keep lookup Hl) H).
  - repeat split. exact Hf.
  - repeat split; [apply located_holds|now exists u|exact Hf].
  - intros q m Hq. apply (siblings_in_tree T k u Hu). destruct Hq as [[= -> _]|Hq]; [now left|right].
    exact (marked_pending_siblings k t s q m Hq).
Qed.

End ResumePruned.

(** Of a trail of ones over a second trail of 0 nothing is marked. *)
Lemma nothing_marked k : forall t, marked_pending k t 0 = map (fun q => (q, false)) (pending k t).
Proof.
  induction k as [k IH|k IH|]; intros t; [| |reflexivity]; cbn [marked_pending pending]; cbn [N.div2];
    rewrite IH, map_app; now destruct (N.odd t).
Qed.

(** [PAUSE-4] From the key alone, with a trail of ones and a second trail of 0, a search that prunes visits the same
    whole subtrees, each with the pruning of what is below it. *)
Theorem marked_key_only T decide mark stop found k t h : at_key T k = Some t ->
  comes_to (fun f => prun T decide mark stop found marked_machine f (Marked k (all_ones k) 0) h)
    (pvisit_all T decide mark stop found (map (fun q => (q, false)) (k :: siblings k)) false h).
Proof.
  intros Hk. destruct (all_ones_stack k) as (_ & Hf & Hp). cbn [snd] in Hf, Hp.
  refine (prun_visit_all T decide mark stop found marked_machine marked_stack (marked_refines T) _ k _ h _ _).
  - split; [reflexivity|]. split; [exact Hf|]. cbn [m_trail m_marks]. now rewrite nothing_marked, Hp.
  - intros q m Hq. apply (siblings_in_tree T k t Hk). destruct Hq as [[= -> _]|Hq]; [now left|right].
    apply in_map_iff in Hq. destruct Hq as (q' & [= -> _] & Hq). exact Hq.
Qed.

Section Closest.

Variable hit : Type.
Variable before : hit -> hit -> bool.
Hypothesis before_irreflexive : forall x, before x x = false.
Hypothesis before_transitive : forall x y z, before x y = true -> before y z = true -> before x z = true.
Hypothesis before_total : forall x y, before x y = false -> before y x = false -> x = y.
Variable T : tree.
Variable offer : positive -> option hit.
Variable decide : history -> descent.
Hypothesis search_culls : culls hit before T offer decide.
Variables mark found : history -> bool.
Hypothesis promise : found_is_true hit before T offer decide mark found.

(** [PAUSE-4, PAUSE-7] And such a search ends with the closest of all hits too. *)
Theorem marked_key_only_is_closest k t h : at_key T k = Some t ->
  best hit before T offer (snd (pvisit_all T decide mark never found (map (fun q => (q, false))
    (k :: siblings k)) false h)) =
  best hit before T offer (snd (visit_all T decide never (k :: siblings k) h)).
Proof.
  intros Hk. pose proof (siblings_in_tree T k t Hk) as Hin. revert Hin. generalize (k :: siblings k). clear k t Hk.
  intros ks. assert (E : forall h h' b, best hit before T offer h = best hit before T offer h' ->
    (forall q, In q ks -> exists t, at_key T q = Some t) ->
    best hit before T offer (snd (pvisit_all T decide mark never found (map (fun q => (q, false)) ks) b h)) =
    best hit before T offer (snd (visit_all T decide never ks h'))); [|intros; now apply E].
  induction ks as [|k ks IH]; intros h1 h2 b Hb Hin; [exact Hb|].
  destruct (Hin k (or_introl eq_refl)) as (t & Ht). cbn [map pvisit_all visit_all andb]. rewrite Ht.
  pose proof (pvisit_well_pruned hit before before_irreflexive before_transitive before_total T offer decide search_culls
    mark found promise t k h1 Ht) as W. unfold well_pruned in W.
  destruct (visit_best hit before before_irreflexive before_transitive before_total T offer decide search_culls t k h2 Ht)
    as [V F].
  destruct (pvisit decide mark never found t k h1) as [[s1 b1] h1']. destruct (visit decide never t k h2) as [s2 h2'].
  cbn [fst snd] in *. subst s2. destruct W as (-> & _ & _ & W).
  apply IH; [now rewrite W, V, Hb|]. intros q Hq. apply Hin. now right.
Qed.

End Closest.
