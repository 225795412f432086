(** The loop that all traversals share, the textbook stack, and the machine of key and trail.

    A traversal without a stack is a [cursor]: a state and two moves, as in the library. It is right if its state stands for
    a present key and a stack of postponed keys ([refines]); then its loop does exactly what the reference does
    ([refines_reference]). So each algorithm is proved by four small facts about its moves. *)

Require Import List PArith NArith Lia Bool.
Require Import Tree.
Import ListNotations.

(** * Keys *)

(** [KEY-4] The sibling of a node; the root is its own. *)
Definition sibling (k : positive) : positive :=
  match k with xH => xH | xO k => xI k | xI k => xO k end.

(** [KEY-3] The ancestor [n] levels up; the root is its own parent. *)
Fixpoint up (n : nat) (k : positive) : positive :=
  match n with 0 => k | S n => up n (Pos.div2 k) end.

(** Right shift. *)
Definition shr (x : N) (n : nat) : N := N.shiftr x (N.of_nat n).

Fixpoint ctz_pos (p : positive) : nat := match p with xO p => S (ctz_pos p) | _ => 0 end.

(** Count of trailing zeros; of 0 it is never asked. *)
Definition ctz (x : N) : nat := match x with N0 => 0 | Npos p => ctz_pos p end.

(** * Cursors and their loop *)

Record cursor := Cursor {
  state : Type;
  start : state;
  (** The key of the present node, where the state has one at all. *)
  key_of : state -> option positive;
  (** To the first wanted child; the descent is not [Neither]. *)
  descend : descent -> state -> state;
  (** To the most recently postponed node; [None] at the end. *)
  backtrack : state -> option state }.

Section Loop.

Variable C : cursor.
Variable T : tree.
Variable decide : history -> descent.
Variable stop : history -> bool.

(** After a visit: go on, or end (stopped or not); or there is no such node in the tree. *)
Inductive status :=
  | Going (s : state C) (h : history)
  | Done (stopped : bool) (h : history)
  | Lost.

Definition back (s : state C) (h : history) : status :=
  match backtrack C s with Some s => Going s h | None => Done false h end.

(** [TRAVERSE-1] One visit, and the move after it. *)
Definition step (s : state C) (h : history) : status :=
  match key_of C s with
  | None => Lost
  | Some k =>
      let h := k :: h in
      match at_key T k with
      | None => Lost
      | Some Leaf => if stop h then Done true h else back s h
      | Some (Node _ _) => match decide h with Neither => back s h | d => Going (descend C d s) h end
      end
  end.

(** At most [fuel] visits; [None] if they do not suffice, or if a node is not found. *)
Fixpoint run (fuel : nat) (s : state C) (h : history) : option (bool * history) :=
  match fuel with
  | 0 => None
  | S fuel => match step s h with Going s h => run fuel s h | Done b h => Some (b, h) | Lost => None end
  end.

(** What is left to do after the subtree of the present node. *)
Definition after (fuel : nat) (s : state C) (h : history) : option (bool * history) :=
  match backtrack C s with Some s => run fuel s h | None => Some (false, h) end.

(** The states between two steps that the loop comes to. *)
Inductive reached : state C -> history -> Prop :=
  | reached_start : reached (start C) []
  | reached_step s h s' h' : reached s h -> step s h = Going s' h' -> reached s' h'.

(** [R s k p] reads: the state [s] is at the key [k], and [p] is the stack of postponed keys. [allowed] is what may be
    decided at a node. *)
Record refines (allowed : positive -> descent -> Prop) (R : state C -> positive -> list positive -> Prop) : Prop := Refines {
  r_start : R (start C) xH [];
  r_key s k p : R s k p -> key_of C s = Some k;
  r_only s k p sd l r : R s k p -> at_key T k = Some (Node l r) -> allowed k (Only sd) ->
    R (descend C (Only sd) s) (child sd k) p;
  r_both s k p sd l r : R s k p -> at_key T k = Some (Node l r) -> allowed k (Both sd) ->
    R (descend C (Both sd) s) (child sd k) (child (other sd) k :: p);
  r_done s k : R s k [] -> backtrack C s = None;
  r_next s k q p : R s k (q :: p) -> exists s', backtrack C s = Some s' /\ R s' q p }.

Variable allowed : positive -> descent -> Prop.
Variable R : state C -> positive -> list positive -> Prop.
Hypothesis Ref : refines allowed R.
Hypothesis decisions : forall k h, decide (k :: h) = Neither \/ allowed k (decide (k :: h)).

(** A child of a node that is in the tree is there too. *)
Lemma at_child sd k l r : at_key T k = Some (Node l r) -> at_key T (child sd k) = Some (subtree sd l r).
Proof. destruct sd; simpl; intros ->; reflexivity. Qed.

(** The heart: from a state at the root of a subtree, the loop does what [visit] does, in at most as many visits as the
    subtree has nodes, and then has the same stack as before. *)
Lemma run_visit t : forall k s p h, at_key T k = Some t -> R s k p ->
  exists n, n <= size t /\
  match visit decide stop t k h with
  | (true, h') => forall f, run (n + f) s h = Some (true, h')
  | (false, h') => exists s' k', R s' k' p /\ forall f, run (n + f) s h = after f s' h'
  end.
Proof.
  induction t as [|l IHl r IHr]; intros k s p h Hk Hs.
  - exists 1; split; [simpl; lia|]. simpl. unfold step. rewrite (r_key _ _ Ref _ _ _ Hs), Hk.
    destruct (stop (k :: h)); [reflexivity|].
    exists s, k; split; [exact Hs|]. intros f. unfold back, after. destruct (backtrack C s); reflexivity.
  - assert (IH : forall sd k s p h, at_key T k = Some (subtree sd l r) -> R s k p ->
      exists n, n <= size (subtree sd l r) /\
      match visit decide stop (subtree sd l r) k h with
      | (true, h') => forall f, run (n + f) s h = Some (true, h')
      | (false, h') => exists s' k', R s' k' p /\ forall f, run (n + f) s h = after f s' h'
      end) by (intros [|]; assumption).
    clear IHl IHr.
    assert (Hn : forall f h0, run (S f) s h0 = match decide (k :: h0) with
        | Neither => after f s (k :: h0) | d => run f (descend C d s) (k :: h0) end).
    { intros f h0. simpl. unfold step. rewrite (r_key _ _ Ref _ _ _ Hs), Hk.
      destruct (decide (k :: h0)); try reflexivity. unfold back, after. destruct (backtrack C s); reflexivity. }
    simpl visit. destruct (decide (k :: h)) as [|sd|sd] eqn:Hd.
    + exists 1; split; [simpl; lia|]. exists s, k; split; [exact Hs|]. intros f.
      change (1 + f) with (S f). rewrite Hn, Hd. reflexivity.
    + assert (A : allowed k (Only sd)) by (destruct (decisions k h); congruence).
      destruct (IH sd (child sd k) (descend C (Only sd) s) p (k :: h)) as (n & Hle & Hv).
      * apply at_child, Hk.
      * eapply r_only; eauto.
      * exists (S n); split; [destruct sd; simpl in *; lia|].
        destruct (visit decide stop (subtree sd l r) (child sd k) (k :: h)) as [[|] h1].
        -- intros f. change (S n + f) with (S (n + f)). rewrite Hn, Hd. apply Hv.
        -- destruct Hv as (s' & k' & HR & Hv). exists s', k'; split; [exact HR|].
           intros f. change (S n + f) with (S (n + f)). rewrite Hn, Hd. apply Hv.
    + assert (A : allowed k (Both sd)) by (destruct (decisions k h); congruence).
      destruct (IH sd (child sd k) (descend C (Both sd) s) (child (other sd) k :: p) (k :: h)) as (n & Hle & Hv).
      * apply at_child, Hk.
      * eapply r_both; eauto.
      * destruct (visit decide stop (subtree sd l r) (child sd k) (k :: h)) as [[|] h1].
        -- exists (S n); split; [destruct sd; simpl in *; lia|].
           intros f. change (S n + f) with (S (n + f)). rewrite Hn, Hd. apply Hv.
        -- destruct Hv as (s1 & k1 & HR1 & Hv1).
           destruct (r_next _ _ Ref _ _ _ _ HR1) as (s2 & Hb & HR2).
           destruct (IH (other sd) (child (other sd) k) s2 p h1) as (m & Hlm & Hv2).
           ++ apply at_child, Hk.
           ++ exact HR2.
           ++ exists (S (n + m)); split; [destruct sd; simpl in *; lia|].
              assert (E : forall f, run (S (n + m) + f) s h = run (m + f) s2 h1).
              { intros f. change (S (n + m) + f) with (S (n + m + f)). rewrite Hn, Hd.
                replace (n + m + f) with (n + (m + f)) by lia. rewrite Hv1. unfold after. rewrite Hb. reflexivity. }
              destruct (visit decide stop (subtree (other sd) l r) (child (other sd) k) h1) as [[|] h2].
              ** intros f. rewrite E. apply Hv2.
              ** destruct Hv2 as (s3 & k3 & HR3 & Hv3). exists s3, k3; split; [exact HR3|].
                 intros f. rewrite E. apply Hv3.
Qed.

(** The loop of a right cursor ends within as many visits as the tree has nodes, and its answer is the reference's. *)
Theorem refines_reference fuel : size T <= fuel -> run fuel (start C) [] = Some (reference decide stop T).
Proof.
  intros Hf. destruct (run_visit T xH (start C) [] [] eq_refl (r_start _ _ Ref)) as (n & Hn & Hv).
  unfold reference. replace fuel with (n + (fuel - n)) by lia.
  destruct (visit decide stop T xH []) as [[|] h].
  - apply Hv.
  - destruct Hv as (s & k & HR & Hv). rewrite Hv. unfold after. rewrite (r_done _ _ Ref _ _ HR). reflexivity.
Qed.

(** The reference, taken up with a stack of keys: each one's subtree in turn. *)
Fixpoint visit_all (ks : list positive) (h : history) : bool * history :=
  match ks with
  | [] => (false, h)
  | k :: ks =>
      match at_key T k with
      | None => (false, h)
      | Some t => let '(stopped, h) := visit decide stop t k h in if stopped then (true, h) else visit_all ks h
      end
  end.

(** From any state the loop does what the reference does with the stack that the state stands for. *)
Theorem refines_visit_all p : forall s k h, R s k p -> (forall q, In q (k :: p) -> exists t, at_key T q = Some t) ->
  exists n, forall f, n <= f -> run f s h = Some (visit_all (k :: p) h).
Proof.
  induction p as [|q p IH]; intros s k h HR Hin.
  - destruct (Hin k (or_introl eq_refl)) as (t & Ht).
    destruct (run_visit t k s [] h Ht HR) as (n & _ & Hv). exists n. intros f Hf.
    replace f with (n + (f - n)) by lia. simpl. rewrite Ht.
    destruct (visit decide stop t k h) as [[|] h1]; [apply Hv|].
    destruct Hv as (s' & k' & HR' & Hv). rewrite Hv. unfold after. rewrite (r_done _ _ Ref _ _ HR'). reflexivity.
  - destruct (Hin k (or_introl eq_refl)) as (t & Ht).
    destruct (run_visit t k s (q :: p) h Ht HR) as (n & _ & Hv).
    change (visit_all (k :: q :: p) h) with (match at_key T k with None => (false, h)
      | Some t => let '(stopped, h) := visit decide stop t k h in if stopped then (true, h) else visit_all (q :: p) h end).
    rewrite Ht. destruct (visit decide stop t k h) as [[|] h1].
    + exists n. intros f Hf. replace f with (n + (f - n)) by lia. apply Hv.
    + destruct Hv as (s' & k' & HR' & Hv). destruct (r_next _ _ Ref _ _ _ _ HR') as (s2 & Hb & HR2).
      destruct (IH s2 q h1 HR2) as (m & Hm); [intros q' Hq; apply Hin; now right|].
      exists (n + m). intros f Hf. replace f with (n + (f - n)) by lia. rewrite Hv. unfold after. rewrite Hb.
      apply Hm. lia.
Qed.

(** Every state that the loop comes to stands for a key and a stack, and these are nodes of the tree. *)
Theorem reached_refines s h : reached s h ->
  exists k p, R s k p /\ forall q, In q (k :: p) -> exists t, at_key T q = Some t.
Proof.
  induction 1 as [|s h s' h' _ (k & p & HR & Hin) Hstep].
  - exists xH, []. split; [apply (r_start _ _ Ref)|]. intros q [<-|[]]. exists T. reflexivity.
  - assert (B : forall h0, back s h0 = Going s' h' ->
      exists k p, R s' k p /\ forall q, In q (k :: p) -> exists t, at_key T q = Some t).
    { intros h0. unfold back. destruct (backtrack C s) as [s1|] eqn:Hb; [|discriminate]. intros [= -> ->].
      destruct p as [|q p]; [rewrite (r_done _ _ Ref _ _ HR) in Hb; discriminate|].
      destruct (r_next _ _ Ref _ _ _ _ HR) as (s2 & Hb2 & HR2).
      rewrite Hb in Hb2. injection Hb2 as ->. exists q, p. split; [exact HR2|]. intros q' Hq. apply Hin. now right. }
    unfold step in Hstep. rewrite (r_key _ _ Ref _ _ _ HR) in Hstep.
    destruct (at_key T k) as [[|l r]|] eqn:Hk; [destruct (stop (k :: h)); [discriminate|]; eauto| |discriminate].
    destruct (decisions k h) as [Hd|Ha]; [rewrite Hd in Hstep; eauto|].
    destruct (decide (k :: h)) as [|sd|sd] eqn:Hd; [eauto| |]; injection Hstep as <- _.
    + exists (child sd k), p. split; [eapply r_only; eauto|].
      intros q [<-|Hq]; [eauto using at_child|apply Hin; now right].
    + exists (child sd k), (child (other sd) k :: p). split; [eapply r_both; eauto|].
      intros q [<-|[<-|Hq]]; [eauto using at_child..|apply Hin; now right].
Qed.

End Loop.

Arguments Going {C}.
Arguments Done {C}.
Arguments Lost {C}.

Definition any_descent (k : positive) (d : descent) : Prop := True.

Lemma any_decision (decide : history -> descent) k h : decide (k :: h) = Neither \/ any_descent k (decide (k :: h)).
Proof. right. exact I. Qed.

(** A cursor that moves as a right one does, state by state, is right. *)
Record simulates (T : tree) (A B : cursor) (allowed : positive -> descent -> Prop) (S : state A -> state B -> Prop) : Prop := Simulates {
  s_start : S (start A) (start B);
  s_key a b : S a b -> key_of B b = key_of A a;
  s_descend a b d k l r : S a b -> key_of A a = Some k -> at_key T k = Some (Node l r) -> d <> Neither -> allowed k d ->
    S (descend A d a) (descend B d b);
  s_done a b : S a b -> backtrack A a = None -> backtrack B b = None;
  s_next a b a' : S a b -> backtrack A a = Some a' -> exists b', backtrack B b = Some b' /\ S a' b' }.

Theorem simulates_refines T A B allowed R S : refines A T any_descent R -> simulates T A B allowed S ->
  refines B T allowed (fun b k p => exists a, R a k p /\ S a b).
Proof.
  intros [Rs Rk Ro Rb Rd Rn] [Ss Sk Sd Se Sn]. split.
  - eauto.
  - intros b k p (a & HR & HS). rewrite (Sk _ _ HS). eauto.
  - intros b k p sd l r (a & HR & HS) Hk Ha. exists (descend A (Only sd) a). split.
    + eapply Ro; eauto. exact I.
    + eapply Sd; eauto. discriminate.
  - intros b k p sd l r (a & HR & HS) Hk Ha. exists (descend A (Both sd) a). split.
    + eapply Rb; eauto. exact I.
    + eapply Sd; eauto. discriminate.
  - intros b k (a & HR & HS). eauto.
  - intros b k q p (a & HR & HS). destruct (Rn _ _ _ _ HR) as (a' & Ha & HR').
    destruct (Sn _ _ _ HS Ha) as (b' & Hb & HS'). eauto.
Qed.

(** * The textbook traversal *)

Definition stack_descend (d : descent) (s : positive * list positive) :=
  let '(k, p) := s in
  match d with
  | Neither => s
  | Only sd => (child sd k, p)
  | Both sd => (child sd k, child (other sd) k :: p)
  end.

(** A present key and a stack of postponed ones. *)
Definition stack_machine : cursor := {|
  state := positive * list positive;
  start := (xH, []);
  key_of s := Some (fst s);
  descend := stack_descend;
  backtrack s := match snd s with [] => None | q :: p => Some (q, p) end |}.

Lemma stack_refines T : refines stack_machine T any_descent (fun s k p => s = (k, p)).
Proof. split; try (intros; subst; reflexivity). intros s k q p ->. eexists; split; reflexivity. Qed.

(** [STACK-1] The stack machine ends and does what the recursive reference does. *)
Theorem stack_machine_reference T decide stop fuel : size T <= fuel ->
  run stack_machine T decide stop fuel (start stack_machine) [] = Some (reference decide stop T).
Proof. eapply refines_reference; [apply stack_refines|apply any_decision]. Qed.

(** * Key and trail *)

(** [TRAIL-2] The child's trail: one bit more, set if its sibling is postponed. *)
Definition trail_descend (d : descent) (s : positive * N) : positive * N :=
  let '(k, t) := s in
  match d with
  | Neither => s
  | Only sd => (child sd k, N.double t)
  | Both sd => (child sd k, N.succ_double t)
  end.

(** [TRAIL-3, TRAIL-4] As many levels up as the trail has trailing zeros, then to the sibling. *)
Definition trail_backtrack (s : positive * N) : option (positive * N) :=
  let '(k, t) := s in
  if N.eqb t 0 then None else Some (sibling (up (ctz t) k), N.lxor (shr t (ctz t)) 1).

(** The machine of key and trail, on integers without bound. *)
Definition trail_machine : cursor := {|
  state := positive * N;
  start := (xH, 0%N);
  key_of s := Some (fst s);
  descend := trail_descend;
  backtrack := trail_backtrack |}.

(** The stack that key and trail stand for: siblings of ancestors, from below. *)
Fixpoint pending (k : positive) (t : N) : list positive :=
  match k with
  | xH => []
  | xO k' | xI k' => (if N.odd t then [sibling k] else []) ++ pending k' (N.div2 t)
  end.

(** The trail has no bit at the depth of the key or above. *)
Fixpoint fits (k : positive) (t : N) : Prop :=
  match k with xH => t = 0%N | xO k | xI k => fits k (N.div2 t) end.

(** Shifting by one more place. *)
Lemma shr_succ x n : shr x (S n) = shr (N.div2 x) n.
Proof.
  unfold shr. rewrite N.div2_spec, N.shiftr_shiftr. f_equal. lia.
Qed.

(** A bit 0 that is clear is passed over: backtracking from the parent comes to the same. *)
Lemma trail_backtrack_even k p : trail_backtrack (k, Npos (xO p)) = trail_backtrack (Pos.div2 k, Npos p).
Proof. unfold trail_backtrack. simpl. rewrite shr_succ. reflexivity. Qed.

(** Backtracking pops the stack that key and trail stand for. *)
Lemma trail_pops k : forall t, fits k t ->
  match pending k t with
  | [] => trail_backtrack (k, t) = None
  | q :: p => exists t', trail_backtrack (k, t) = Some (q, t') /\ fits q t' /\ pending q t' = p
  end.
Proof.
  induction k as [k IH|k IH|]; intros t Hf; [| |simpl in Hf; subst; reflexivity].
  all: destruct t as [|[p|p|]];
    [apply (IH 0%N Hf)
    |exists (Npos (xO p)); repeat split; exact Hf
    |rewrite trail_backtrack_even; apply (IH (Npos p) Hf)
    |exists 0%N; repeat split; exact Hf].
Qed.

Definition trail_stack (s : positive * N) (k : positive) (p : list positive) : Prop :=
  fst s = k /\ fits k (snd s) /\ pending k (snd s) = p.

Lemma div2_double t : N.div2 (N.double t) = t /\ N.div2 (N.succ_double t) = t.
Proof. destruct t; auto. Qed.

Lemma trail_refines T : refines trail_machine T any_descent trail_stack.
Proof.
  split; unfold trail_stack; simpl.
  - auto.
  - intros s k p (<- & _). reflexivity.
  - intros [k' t] k p sd l r (H1 & Hf & Hp) _ _; simpl in *; subst k' p.
    destruct sd; simpl; rewrite (proj1 (div2_double t)); destruct t; auto.
  - intros [k' t] k p sd l r (H1 & Hf & Hp) _ _; simpl in *; subst k' p.
    destruct sd; simpl; rewrite (proj2 (div2_double t)); destruct t; auto.
  - intros [k' t] k (H1 & Hf & Hp); simpl in *; subst k'. generalize (trail_pops k t Hf). now rewrite Hp.
  - intros [k' t] k q p (H1 & Hf & Hp); simpl in *; subst k'. generalize (trail_pops k t Hf). rewrite Hp.
    intros (t' & Hb & Hf' & Hp'). exists (q, t'). auto.
Qed.

(** [TRAIL-7](1, 2) The machine of key and trail ends within as many visits as the tree has nodes, and its visits and its
    answer are those of the reference: for every tree, every search, also one whose decisions change with time. *)
Theorem trail_machine_reference T decide stop fuel : size T <= fuel ->
  run trail_machine T decide stop fuel (start trail_machine) [] = Some (reference decide stop T).
Proof. eapply refines_reference; [apply trail_refines|apply any_decision]. Qed.
