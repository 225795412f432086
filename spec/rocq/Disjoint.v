(** Pruning after a hit: the second trail, and why it loses no closest hit. Clauses of spec/state.md. *)

Require Import List PArith NArith Lia Bool Arith.
Require Import Tree Machine Register HashedKeys Resume.
Import ListNotations.

(** * The reference that prunes, and the loop *)

(** A traversal that prunes: descents are marked or not, and at a leaf it may forget marked nodes. *)
Record pruner := Pruner {
  pstate : Type;
  pstart : pstate;
  pkey : pstate -> option positive;
  pdescend : descent -> bool -> pstate -> pstate;
  pprune : pstate -> pstate;
  pback : pstate -> option pstate }.

(** The stack without the marked nodes. *)
Definition unmarked (p : list (positive * bool)) : list (positive * bool) := filter (fun q => negb (snd q)) p.

Lemma unmarked_unmarked p : unmarked (unmarked p) = unmarked p.
Proof. unfold unmarked. induction p as [|[q [|]] p IH]; cbn; [reflexivity|exact IH|now rewrite IH]. Qed.

Section Loop.

Variable T : tree.
Variable decide : history -> descent.
(** Whether the descent is marked, decided with it. *)
Variable mark : history -> bool.
Variable stop : history -> bool.
(** What the search says at a leaf. *)
Variable found : history -> bool.

(** [ORACLE-2] The reference that leaves out nodes: at a marked descent the second child is not visited if at a leaf
    below the first the search has said *found*. Whether it was stopped; whether something was found below; the
    history. *)
Fixpoint pvisit (t : tree) (k : positive) (h : history) : bool * bool * history :=
  let h := k :: h in
  match t with
  | Leaf => (stop h, found h, h)
  | Node l r =>
      match decide h with
      | Neither => (false, false, h)
      | Only s => pvisit (subtree s l r) (child s k) h
      | Both s =>
          let marked := mark h in
          let '(stopped, found1, h) := pvisit (subtree s l r) (child s k) h in
          if stopped then (true, found1, h) else
          if marked && found1 then (false, true, h) else
          let '(stopped, found2, h) := pvisit (subtree (other s) l r) (child (other s) k) h in
          (stopped, found1 || found2, h)
      end
  end.

Definition pruned_reference : bool * history := let '(stopped, _, h) := pvisit T xH [] in (stopped, h).

Variable P : pruner.

(** The loop of [traverse], for a traversal that prunes; at most [fuel] visits. *)
Fixpoint prun (fuel : nat) (s : pstate P) (h : history) : option (bool * history) :=
  match fuel with
  | 0 => None
  | S fuel =>
      let back s h := match pback P s with Some s => prun fuel s h | None => Some (false, h) end in
      match pkey P s with
      | None => None
      | Some k =>
          let h := k :: h in
          match at_key T k with
          | None => None
          | Some Leaf =>
              let s := if found h then pprune P s else s in
              if stop h then Some (true, h) else back s h
          | Some (Node _ _) => match decide h with Neither => back s h | d => prun fuel (pdescend P d (mark h) s) h end
          end
      end
  end.

Definition pafter (fuel : nat) (s : pstate P) (h : history) : option (bool * history) :=
  match pback P s with Some s => prun fuel s h | None => Some (false, h) end.

(** The state [s] is at the key [k], and [p] is the stack of postponed keys with their marks. *)
Record prefines (R : pstate P -> positive -> list (positive * bool) -> Prop) : Prop := Prefines {
  p_start : R (pstart P) xH [];
  p_key s k p : R s k p -> pkey P s = Some k;
  p_only s k p sd m l r : R s k p -> at_key T k = Some (Node l r) -> R (pdescend P (Only sd) m s) (child sd k) p;
  p_both s k p sd m l r : R s k p -> at_key T k = Some (Node l r) ->
    R (pdescend P (Both sd) m s) (child sd k) ((child (other sd) k, m) :: p);
  p_prune s k p : R s k p -> at_key T k = Some Leaf -> R (pprune P s) k (unmarked p);
  p_done s k : R s k [] -> pback P s = None;
  p_next s k q m p : R s k ((q, m) :: p) -> exists s', pback P s = Some s' /\ R s' q p }.

Variable R : pstate P -> positive -> list (positive * bool) -> Prop.
Hypothesis Ref : prefines R.

Definition pruned_if (b : bool) (p : list (positive * bool)) := if b then unmarked p else p.

(** From a state at the root of a subtree, the loop does what [pvisit] does, and then has the same stack as before,
    without the marked nodes if something was found. *)
Lemma prun_visit t : forall k s p h, at_key T k = Some t -> R s k p ->
  exists n, n <= size t /\
  match pvisit t k h with
  | (true, _, h') => forall f, prun (n + f) s h = Some (true, h')
  | (false, b, h') => exists s' k', R s' k' (pruned_if b p) /\ forall f, prun (n + f) s h = pafter f s' h'
  end.
Proof.
  induction t as [|l IHl r IHr]; intros k s p h Hk Hs.
  - exists 1; split; [cbn; lia|]. cbn [pvisit].
    assert (HR : R (if found (k :: h) then pprune P s else s) k (pruned_if (found (k :: h)) p)).
    { destruct (found (k :: h)); [apply (p_prune _ Ref); assumption|exact Hs]. }
    assert (E : forall f, prun (1 + f) s h = if stop (k :: h) then Some (true, k :: h)
      else pafter f (if found (k :: h) then pprune P s else s) (k :: h)).
    { intros f. cbn. now rewrite (p_key _ Ref _ _ _ Hs), Hk. }
    destruct (stop (k :: h)); [exact E|]. eauto.
  - assert (IH : forall sd k s p h, at_key T k = Some (subtree sd l r) -> R s k p ->
      exists n, n <= size (subtree sd l r) /\
      match pvisit (subtree sd l r) k h with
      | (true, _, h') => forall f, prun (n + f) s h = Some (true, h')
      | (false, b, h') => exists s' k', R s' k' (pruned_if b p) /\ forall f, prun (n + f) s h = pafter f s' h'
      end) by (intros [|]; assumption).
    clear IHl IHr.
    assert (Hn : forall f, prun (S f) s h = match decide (k :: h) with
        | Neither => pafter f s (k :: h) | d => prun f (pdescend P d (mark (k :: h)) s) (k :: h) end).
    { intros f. cbn. now rewrite (p_key _ Ref _ _ _ Hs), Hk. }
    cbn [pvisit]. destruct (decide (k :: h)) as [|sd|sd] eqn:Hd.
    + exists 1; split; [cbn; lia|]. exists s, k; split; [exact Hs|]. intros f.
      change (1 + f) with (S f). now rewrite Hn.
    + destruct (IH sd (child sd k) (pdescend P (Only sd) (mark (k :: h)) s) p (k :: h)) as (n & Hle & Hv);
        [apply at_child, Hk|eapply p_only; eauto|].
      exists (S n); split; [destruct sd; cbn in *; lia|].
      destruct (pvisit (subtree sd l r) (child sd k) (k :: h)) as [[[|] b] h1].
      * intros f. change (S n + f) with (S (n + f)). rewrite Hn. apply Hv.
      * destruct Hv as (s' & k' & HR & Hv). exists s', k'; split; [exact HR|].
        intros f. change (S n + f) with (S (n + f)). rewrite Hn. apply Hv.
    + set (m := mark (k :: h)).
      destruct (IH sd (child sd k) (pdescend P (Both sd) m s) ((child (other sd) k, m) :: p) (k :: h))
        as (n & Hle & Hv); [apply at_child, Hk|eapply p_both; eauto|].
      destruct (pvisit (subtree sd l r) (child sd k) (k :: h)) as [[[|] b1] h1].
      * exists (S n); split; [destruct sd; cbn in *; lia|].
        intros f. change (S n + f) with (S (n + f)). rewrite Hn. apply Hv.
      * destruct Hv as (s1 & k1 & HR1 & Hv1).
        destruct (m && b1) eqn:Hm.
        -- exists (S n); split; [destruct sd; cbn in *; lia|]. apply andb_prop in Hm. destruct Hm as [Em ->].
           exists s1, k1. split; [cbn in *; now rewrite Em in HR1|].
           intros f. change (S n + f) with (S (n + f)). rewrite Hn. apply Hv1.
        -- assert (HR1' : R s1 k1 ((child (other sd) k, m) :: pruned_if b1 p)).
           { destruct b1; [|exact HR1]. rewrite andb_true_r in Hm. cbn in *. rewrite Hm in *. exact HR1. }
           destruct (p_next _ Ref _ _ _ _ _ HR1') as (s2 & Hb & HR2).
           destruct (IH (other sd) (child (other sd) k) s2 (pruned_if b1 p) h1) as (n2 & Hl2 & Hv2);
             [apply at_child, Hk|exact HR2|].
           exists (S (n + n2)); split; [destruct sd; cbn in *; lia|].
           assert (E : forall f, prun (S (n + n2) + f) s h = prun (n2 + f) s2 h1).
           { intros f. change (S (n + n2) + f) with (S (n + n2 + f)). rewrite Hn.
             replace (n + n2 + f) with (n + (n2 + f)) by lia. rewrite Hv1. unfold pafter. now rewrite Hb. }
           destruct (pvisit (subtree (other sd) l r) (child (other sd) k) h1) as [[[|] b2] h2].
           ++ intros f. rewrite E. apply Hv2.
           ++ destruct Hv2 as (s3 & k3 & HR3 & Hv3). exists s3, k3; split.
              ** destruct b1, b2; cbn in *; try rewrite unmarked_unmarked in HR3; exact HR3.
              ** intros f. rewrite E. apply Hv3.
Qed.

(** [ORACLE-2](1) So the loop of any such traversal ends, with the visits and the answer of the reference that leaves nodes
    out. *)
Theorem prefines_reference fuel : size T <= fuel -> prun fuel (pstart P) [] = Some pruned_reference.
Proof.
  intros Hf. destruct (prun_visit T xH (pstart P) [] [] eq_refl (p_start _ Ref)) as (n & Hn & Hv).
  unfold pruned_reference. replace fuel with (n + (fuel - n)) by lia.
  destruct (pvisit T xH []) as [[[|] b] h]; [apply Hv|].
  destruct Hv as (s & k & HR & Hv). rewrite Hv. unfold pafter. rewrite (p_done _ Ref _ k); [reflexivity|].
  destruct b; exact HR.
Qed.

(** Where nothing is ever found, nothing is left out. *)
Lemma pvisit_plain : (forall h, found h = false) -> forall t k h,
  pvisit t k h = let '(stopped, h) := visit decide stop t k h in (stopped, false, h).
Proof.
  intros Hno. induction t as [|l IHl r IHr]; intros k h; cbn [pvisit visit]; [now rewrite Hno|].
  destruct (decide (k :: h)) as [|[|]|[|]]; cbn; auto.
  - rewrite IHl. destruct (visit decide stop l _ _) as [[|] h1]; [reflexivity|]. rewrite andb_false_r, IHr.
    now destruct (visit decide stop r _ _).
  - rewrite IHr. destruct (visit decide stop r _ _) as [[|] h1]; [reflexivity|]. rewrite andb_false_r, IHl.
    now destruct (visit decide stop l _ _).
Qed.

End Loop.

(** * The second trail *)

(** A bit at the low end. *)
Definition push (b : bool) (s : N) : N := if b then N.succ_double s else N.double s.

(** The stack that key, trail and second trail stand for. *)
Fixpoint marked_pending (k : positive) (t s : N) : list (positive * bool) :=
  match k with
  | xH => []
  | xO k' | xI k' => (if N.odd t then [(sibling k, N.odd s)] else []) ++ marked_pending k' (N.div2 t) (N.div2 s)
  end.

Lemma push_spec b s : N.div2 (push b s) = s /\ N.odd (push b s) = b.
Proof. destruct b, s; auto. Qed.

Lemma marked_child sd k t s b m : marked_pending (child sd k) (push b t) (push m s) =
  (if b then [(child (other sd) k, m)] else []) ++ marked_pending k t s.
Proof.
  destruct sd; cbn [child marked_pending]; rewrite !(proj1 (push_spec _ _)), !(proj2 (push_spec _ _)); reflexivity.
Qed.

Lemma fits_child sd k t b : fits k t -> fits (child sd k) (push b t).
Proof. intros H. destruct sd; cbn; rewrite (proj1 (push_spec _ _)); exact H. Qed.

Lemma div2_ldiff t s : N.div2 (N.ldiff t s) = N.ldiff (N.div2 t) (N.div2 s).
Proof. rewrite !N.div2_spec. apply N.shiftr_ldiff. Qed.

Lemma odd_ldiff t s : N.odd (N.ldiff t s) = N.odd t && negb (N.odd s).
Proof. rewrite <- !N.bit0_odd. apply N.ldiff_spec. Qed.

(** [DISJOINT-2](1, 3) The bits of T that T & ~S loses are those of the marked nodes, all of them, and no others. *)
Theorem mask_is_unmarked k : forall t s, marked_pending k (N.ldiff t s) s = unmarked (marked_pending k t s).
Proof.
  induction k as [k IH|k IH|]; intros t s; [| |reflexivity]; cbn [marked_pending];
    rewrite odd_ldiff, div2_ldiff, IH; destruct (N.odd t), (N.odd s); reflexivity.
Qed.

Lemma fits_ldiff k : forall t s, fits k t -> fits k (N.ldiff t s).
Proof.
  induction k as [k IH|k IH|]; intros t s H; cbn in *; [rewrite div2_ldiff; auto|rewrite div2_ldiff; auto|].
  subst. apply N.ldiff_0_l.
Qed.

(** Backtracking pops the marked stack, if the second trail is shifted with the first. *)
Lemma marked_pops k : forall t s, fits k t ->
  match marked_pending k t s with
  | [] => trail_backtrack (k, t) = None
  | (q, _) :: p => exists t', trail_backtrack (k, t) = Some (q, t') /\ fits q t' /\
    marked_pending q t' (shr s (ctz t)) = p
  end.
Proof.
  induction k as [k IH|k IH|]; intros t s Hf; simpl in Hf.
  1, 2: destruct t as [|[p|p|]]; cbn [marked_pending N.odd N.div2 Pos.div2 app];
    [specialize (IH 0%N (N.div2 s) Hf); destruct (marked_pending k 0 (N.div2 s)) as [|[q m] p];
       [reflexivity|destruct IH as (? & E & _); discriminate E]
    |eexists; split; [reflexivity|]; split; [exact Hf|]; reflexivity
    |rewrite trail_backtrack_even; cbn [Pos.div2]; specialize (IH (Npos p) (N.div2 s) Hf);
       destruct (marked_pending k (Npos p) (N.div2 s)) as [|[q m] p']; [exact IH|]; cbn [ctz ctz_pos];
         rewrite shr_succ; exact IH
    |eexists; split; [reflexivity|]; split; [exact Hf|]; reflexivity].
  subst. reflexivity.
Qed.

(** [DISJOINT-2](2) A traversal that counts, in complements below the depth d, takes c | S. *)
Theorem mask_of_counter c s d : (forall i, d <= i -> N.testbit s i = false)%N ->
  N.lxor (N.lor c s) (N.ones d) = N.ldiff (N.lxor c (N.ones d)) s.
Proof.
  intros Hs. apply N.bits_inj. intros i. rewrite N.lxor_spec, N.lor_spec, N.ldiff_spec, N.lxor_spec.
  destruct (N.lt_ge_cases i d) as [Hi|Hi].
  - rewrite N.ones_spec_low by assumption. now destruct (N.testbit c i), (N.testbit s i).
  - rewrite N.ones_spec_high, Hs by assumption. now destruct (N.testbit c i).
Qed.

(** Key, trail, second trail. *)
Record marked_state := Marked { m_key : positive; m_trail : N; m_marks : N }.

(** [DISJOINT-1, DISJOINT-2] *)
Definition marked_machine : pruner := {|
  pstate := marked_state;
  pstart := Marked 1 0 0;
  pkey x := Some (m_key x);
  pdescend d m x :=
    let '(Marked k t s) := x in
    match d with
    | Neither => x
    | Only sd => Marked (child sd k) (push false t) (push m s)
    | Both sd => Marked (child sd k) (push true t) (push m s)
    end;
  pprune x := let '(Marked k t s) := x in Marked k (N.ldiff t s) s;
  pback x :=
    let '(Marked k t s) := x in
    match trail_backtrack (k, t) with Some (k', t') => Some (Marked k' t' (shr s (ctz t))) | None => None end |}.

Definition marked_stack (x : marked_state) (k : positive) (p : list (positive * bool)) : Prop :=
  m_key x = k /\ fits k (m_trail x) /\ marked_pending k (m_trail x) (m_marks x) = p.

Lemma marked_refines T : prefines T marked_machine marked_stack.
Proof.
  split; unfold marked_stack; cbn [marked_machine pstate pstart pkey pdescend pprune pback].
  - repeat split.
  - intros x k p (<- & _). reflexivity.
  - intros [k' t s] k p sd m l r (E & Hf & Hp) _. cbn in E, Hf, Hp. subst k' p. cbn [m_key m_trail m_marks].
    split; [reflexivity|]. split; [now apply fits_child|apply marked_child].
  - intros [k' t s] k p sd m l r (E & Hf & Hp) _. cbn in E, Hf, Hp. subst k' p.
    split; [reflexivity|]. split; [now apply fits_child|apply marked_child].
  - intros [k' t s] k p (E & Hf & Hp) _. cbn in *. subst k' p. split; [reflexivity|].
    split; [now apply fits_ldiff|apply mask_is_unmarked].
  - intros [k' t s] k (E & Hf & Hp). cbn in *. subst k'. generalize (marked_pops k t s Hf). rewrite Hp.
    intros H. unfold trail_backtrack in H. now rewrite H.
  - intros [k' t s] k q m p (E & Hf & Hp). cbn in E, Hf, Hp. subst k'. generalize (marked_pops k t s Hf). rewrite Hp.
    intros (t' & Hb & Hf' & Hp'). rewrite Hb. eexists; split; [reflexivity|]. auto.
Qed.

(** [DISJOINT-1, DISJOINT-2, ORACLE-2] The machine of key, trail and second trail visits what the reference visits that
    leaves nodes out, and ends: for every tree, every search, and all marks, also those of descents into one child. *)
Theorem marked_machine_reference T decide mark stop found fuel : size T <= fuel ->
  prun T decide mark stop found marked_machine fuel (pstart marked_machine) [] =
  Some (pruned_reference T decide mark stop found).
Proof. intros H. eapply prefines_reference; [apply marked_refines|exact H]. Qed.
