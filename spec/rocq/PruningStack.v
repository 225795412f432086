(** Stacks that leave out postponed nodes: with a mark for each, [stack-disjoint]; with the distance at which each
    begins, [stack-t0], Dammertz 2011. *)

Require Import List PArith NArith Lia Bool Arith.
Require Import Tree Machine Register HashedKeys Resume Disjoint Closest.
Import ListNotations.

(** * With marks *)

Definition marked_stack_descend (d : descent) (m : bool) (s : positive * list (positive * bool)) :=
  let '(k, p) := s in
  match d with
  | Neither => s
  | Only sd => (child sd k, p)
  | Both sd => (child sd k, (child (other sd) k, m) :: p)
  end.

(** Of the postponed nodes, those without a mark are kept, in their order. *)
Definition marked_stack : pruner := {|
  pstate := positive * list (positive * bool);
  pstart := (xH, []);
  pkey s := Some (fst s);
  pdescend := marked_stack_descend;
  pprune s := (fst s, filter (fun q => negb (snd q)) (snd s));
  pback s := match snd s with [] => None | (q, _) :: p => Some (q, p) end |}.

Lemma marked_stack_refines T : prefines T marked_stack (fun s k p => s = (k, p)).
Proof. split; try (intros; subst; reflexivity). intros s k q m p ->. eexists. split; reflexivity. Qed.

(** [STACK-1, ORACLE-2] The stack with marks equals the reference that leaves nodes out, for every search, and ends. *)
Theorem marked_stack_reference T decide mark stop found fuel : size T <= fuel ->
  prun T decide mark stop found marked_stack fuel (pstart marked_stack) [] =
  Some (pruned_reference T decide mark stop found).
Proof. intros H. eapply prefines_reference; [apply marked_stack_refines|exact H]. Qed.

(** * With distances *)

Section Distance.

Variable T : tree.
Variable decide : history -> descent.
Variable stop : history -> bool.
(** Where the second child begins, asked at the descent, and where the search ends by now: by any numbers, whatever they
    mean. *)
Variables begins ends : history -> N.

(** [ORACLE-3] The reference: the second child is not visited if it begins beyond the end of the search, after the
    first. *)
Fixpoint dvisit (t : tree) (k : positive) (h : history) : bool * history :=
  let h := k :: h in
  match t with
  | Leaf => (stop h, h)
  | Node l r =>
      match decide h with
      | Neither => (false, h)
      | Only s => dvisit (subtree s l r) (child s k) h
      | Both s =>
          let b := begins h in
          let '(stopped, h) := dvisit (subtree s l r) (child s k) h in
          if stopped then (true, h) else
          if N.ltb (ends h) b then (false, h) else dvisit (subtree (other s) l r) (child (other s) k) h
      end
  end.

Definition distance_reference : bool * history := dvisit T xH [].

(** A node and the postponed ones, each with the distance at which it begins. *)
Definition distance_state : Type := positive * list (positive * N).

Definition distance_descend (d : descent) (b : N) (s : distance_state) : distance_state :=
  let '(k, p) := s in
  match d with
  | Neither => s
  | Only sd => (child sd k, p)
  | Both sd => (child sd k, (child (other sd) k, b) :: p)
  end.

(** The nodes on top that begin beyond the end. *)
Fixpoint drop_beyond (e : N) (p : list (positive * N)) : list (positive * N) :=
  match p with
  | [] => []
  | (q, b) :: p' => if N.ltb e b then drop_beyond e p' else p
  end.

Definition distance_back (s : distance_state) : option distance_state :=
  match snd s with [] => None | (q, _) :: p => Some (q, p) end.

(** The loop of [traverse_pruned] for a cursor that keeps distances. What comes after a visit is a function, so that the
    extracted program does not run it before the visit. *)
Fixpoint distance_run (fuel : nat) (s : distance_state) (h : history) : option (bool * history) :=
  match fuel with
  | 0 => None
  | S fuel =>
      let '(k, p) := s in
      let h := k :: h in
      let back (_ : unit) := match distance_back (k, drop_beyond (ends h) p) with
        | Some s => distance_run fuel s h | None => Some (false, h) end in
      match at_key T k with
      | None => None
      | Some Leaf => if stop h then Some (true, h) else back tt
      | Some (Node _ _) =>
          match decide h with Neither => back tt | d => distance_run fuel (distance_descend d (begins h) s) h end
      end
  end.

(** What is left to do after a subtree. *)
Definition distance_after (fuel : nat) (k : positive) (p : list (positive * N)) (h : history) : option (bool * history) :=
  match distance_back (k, drop_beyond (ends h) p) with Some s => distance_run fuel s h | None => Some (false, h) end.

Lemma distance_visit t : forall k p h, at_key T k = Some t -> exists n, n <= size t /\
  match dvisit t k h with
  | (true, h') => forall f, distance_run (n + f) (k, p) h = Some (true, h')
  | (false, h') => exists k', forall f, distance_run (n + f) (k, p) h = distance_after f k' p h'
  end.
Proof.
  induction t as [|l IHl r IHr]; intros k p h Hk.
  - exists 1. split; [cbn; lia|]. cbn [dvisit]. destruct (stop (k :: h)) eqn:Hs; [|exists k]; intros f;
      cbn [Nat.add distance_run]; rewrite Hk, Hs; reflexivity.
  - assert (IH : forall sd p h, exists n, n <= size (subtree sd l r) /\
      match dvisit (subtree sd l r) (child sd k) h with
      | (true, h') => forall f, distance_run (n + f) (child sd k, p) h = Some (true, h')
      | (false, h') => exists k', forall f, distance_run (n + f) (child sd k, p) h = distance_after f k' p h'
      end).
    { intros sd p' h'. pose proof (at_child T sd k l r Hk). destruct sd; [apply IHl|apply IHr]; assumption. }
    clear IHl IHr.
    assert (Hn : forall f, distance_run (S f) (k, p) h = match decide (k :: h) with
      | Neither => distance_after f k p (k :: h) | d => distance_run f (distance_descend d (begins (k :: h)) (k, p)) (k :: h) end).
    { intros f. cbn [distance_run]. now rewrite Hk. }
    cbn [dvisit]. destruct (decide (k :: h)) as [|sd|sd] eqn:Hd; cbn [distance_descend] in Hn.
    + exists 1. split; [cbn; lia|]. exists k. intros f. apply Hn.
    + destruct (IH sd p (k :: h)) as (n & Hle & Hv). exists (S n). split; [destruct sd; cbn in *; lia|].
      destruct (dvisit _ _ _) as [[|] h1]; [intros f; cbn [Nat.add]; rewrite Hn; apply Hv|].
      destruct Hv as (k' & Hv). exists k'. intros f. cbn [Nat.add]. rewrite Hn. apply Hv.
    + set (q := (child (other sd) k, begins (k :: h))) in *.
      destruct (IH sd (q :: p) (k :: h)) as (n & Hle & Hv).
      destruct (dvisit (subtree sd l r) (child sd k) (k :: h)) as [[|] h1].
      * exists (S n). split; [destruct sd; cbn in *; lia|]. intros f. cbn [Nat.add]. rewrite Hn. apply Hv.
      * destruct Hv as (k1 & Hv). unfold distance_after in Hv. subst q. cbn [drop_beyond] in Hv.
        destruct (N.ltb (ends h1) (begins (k :: h))).
        -- exists (S n). split; [destruct sd; cbn in *; lia|]. exists k1. intros f. cbn [Nat.add]. rewrite Hn. apply Hv.
        -- destruct (IH (other sd) p h1) as (m & Hlm & Hv2). exists (S (n + m)). split; [destruct sd; cbn in *; lia|].
           assert (E : forall f, distance_run (S (n + m) + f) (k, p) h = distance_run (m + f) (child (other sd) k, p) h1).
           { intros f. cbn [Nat.add]. rewrite Hn, <- Nat.add_assoc, Hv. reflexivity. }
           destruct (dvisit (subtree (other sd) l r) _ h1) as [[|] h2]; [intros f; rewrite E; apply Hv2|].
           destruct Hv2 as (k2 & Hv2). exists k2. intros f. rewrite E. apply Hv2.
Qed.

(** [STACK-1, ORACLE-3] The stack with distances, which drops from its top what begins beyond the end whenever it turns
    back, equals the reference that asks after each first child, for all distances and ends, and ends. *)
Theorem distance_stack_reference fuel : size T <= fuel -> distance_run fuel (xH, []) [] = Some distance_reference.
Proof.
  intros Hf. destruct (distance_visit T xH [] [] eq_refl) as (n & Hn & Hv). unfold distance_reference.
  replace fuel with (n + (fuel - n)) by lia. destruct (dvisit T xH []) as [[|] h]; [apply Hv|].
  destruct Hv as (k & Hv). now rewrite Hv.
Qed.

End Distance.

(** ** What is lost by it: nothing *)

Section Closest.

Variable hit : Type.
Variable before : hit -> hit -> bool.
Hypothesis before_irreflexive : forall x, before x x = false.
Hypothesis before_transitive : forall x y z, before x y = true -> before y z = true -> before x z = true.
Hypothesis before_total : forall x y, before x y = false -> before y x = false -> x = y.
Variable T : tree.
Variable offer : positive -> option hit.
Variable decide : history -> descent.
Variables begins ends : history -> N.
Hypothesis search_culls : culls hit before T offer decide.

(** Where the second child of a descent begins beyond the end, nothing below it is better than the best so far. *)
Hypothesis honest : forall k h l r sd h1, at_key T k = Some (Node l r) -> decide (k :: h) = Both sd ->
  (ends h1 < begins (k :: h))%N -> nothing_better hit before offer (best hit before T offer h1) (subtree (other sd) l r)
    (child (other sd) k).

Lemma dvisit_best t : forall k h, at_key T k = Some t ->
  let v := dvisit decide never begins ends t k h in
  best hit before T offer (snd v) = closer hit before (best hit before T offer h) (best_below hit before offer t k) /\
  fst v = false.
Proof.
  induction t as [|l IHl r IHr]; intros k h Hk.
  - cbn. unfold found_in. now rewrite Hk.
  - assert (IH : forall sd h, let v := dvisit decide never begins ends (subtree sd l r) (child sd k) h in
      best hit before T offer (snd v) =
        closer hit before (best hit before T offer h) (best_below hit before offer (subtree sd l r) (child sd k)) /\
      fst v = false).
    { intros sd h'. pose proof (at_child T sd k l r Hk). destruct sd; [apply IHl|apply IHr]; assumption. }
    clear IHl IHr. cbv zeta in *. pose proof (search_culls k h l r Hk) as Hc.
    rewrite <- (best_inner hit before T offer k h l r Hk). cbn [dvisit]. destruct (decide (k :: h)) as [|sd|sd] eqn:Hd.
    + split; [|reflexivity]. cbn [snd]. rewrite (best_below_node hit before) with (sd := L) by assumption.
      rewrite closer_assoc by assumption.
      assert (E : forall sd, closer hit before (best hit before T offer (k :: h))
        (best_below hit before offer (subtree sd l r) (child sd k)) = best hit before T offer (k :: h))
        by (intros sd; apply nothing_better_spec; [assumption..|exact (Hc sd)]).
      now rewrite (E L), (E (other L)).
    + destruct (IH sd (k :: h)) as [Hb Hf]. split; [|exact Hf]. rewrite Hb.
      rewrite (best_below_node hit before) with (sd := sd) by assumption. rewrite closer_assoc by assumption.
      rewrite closer_absorbs; try assumption; [reflexivity|]. apply nothing_better_spec; assumption.
    + destruct (IH sd (k :: h)) as [Hb Hf].
      destruct (dvisit decide never begins ends (subtree sd l r) (child sd k) (k :: h)) as [s h1]. cbn [fst snd] in *. subst s.
      rewrite (best_below_node hit before) with (sd := sd) by assumption. rewrite closer_assoc, <- Hb by assumption.
      destruct (N.ltb_spec (ends h1) (begins (k :: h))) as [Hlt|_]; [|apply IH].
      split; [|reflexivity]. cbn [snd]. symmetry. apply nothing_better_spec; try assumption.
      exact (honest k h l r sd h1 Hk Hd Hlt).
Qed.

(** [ORACLE-3] Pruning by distance loses no closest hit, if what begins beyond the end holds nothing better. *)
Theorem distance_loses_nothing :
  best hit before T offer (snd (distance_reference T decide never begins ends)) =
  best hit before T offer (snd (reference decide never T)).
Proof.
  destruct (dvisit_best T xH [] eq_refl) as [H _]. unfold distance_reference. rewrite H.
  destruct (visit_best hit before before_irreflexive before_transitive before_total T offer decide search_culls T xH [] eq_refl)
    as [E _]. symmetry. exact E.
Qed.

End Closest.
