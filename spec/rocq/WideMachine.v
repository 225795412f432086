(** The loop that all traversals of wide trees share, and the sorted stack: [WIDE-7] and [WSTACK-1].

    A traversal is a [machine]: a state and its moves. It is right if its state stands for a present node and a stack of wanted
    children, each with its rank, of which those that are beyond may or may not be there ([refines]). Then its loop does
    exactly what the reference does ([refines_reference]). *)

Require Import List NArith Lia Bool Sorted.
Require Import Wide.
Import ListNotations.
Open Scope N_scope.

Section Machine.

Variable B : N.

Record machine := Machine {
  state : Type;
  start : state;
  (** The path of the present node. *)
  path_of : state -> path;
  (** The end has changed at a visit. *)
  age : state -> state;
  (** To the child of the least rank. The ranks of the other wanted children, and the end. *)
  descend : N -> list N -> N -> state -> state;
  (** To what comes next, [None] at the end of all. What the search answers if a node is asked about again, and the end. *)
  back : (path -> list N) -> N -> state -> option state }.

Section Loop.

Variable M : machine.
Variable T : wide.
Variable S : search.

Inductive status :=
  | Going (s : state M) (h : history)
  | Done (stopped : bool) (h : history)
  | Lost.

(** What a node is answered now. *)
Definition now (h : history) (a : path) : list N := ask S a h.

Definition go_back (s : state M) (h : history) : status :=
  match back M (now h) (edge S h) s with Some s => Going s h | None => Done false h end.

(** The state after the visit of [k]: what it was, or older. *)
Definition seen (k : path) (h : history) (s : state M) : state M :=
  if edge S (k :: h) =? edge S h then s else age M s.

(** One visit, and the move after it. *)
Definition step (s : state M) (h : history) : status :=
  let k := path_of M s in
  let s := seen k h s in
  let h := k :: h in
  match at_path T k with
  | None => Lost
  | Some WLeaf => if stop S h then Done true h else go_back s h
  | Some (Inner _) =>
      match ask S k h with
      | [] => go_back s h
      | r :: rs => if beyond B (edge S h) r then go_back s h else Going (descend M r rs (edge S h) s) h
      end
  end.

(** At most [fuel] visits; [None] if they do not suffice, or if a node is not there. *)
Fixpoint run (fuel : nat) (s : state M) (h : history) : option (bool * history) :=
  match fuel with
  | O => None
  | Datatypes.S fuel => match step s h with Going s h => run fuel s h | Done b h => Some (b, h) | Lost => None end
  end.

(** What is left to do after the subtree of the present node. *)
Definition after (fuel : nat) (s : state M) (h : history) : option (bool * history) :=
  match back M (now h) (edge S h) s with Some s => run fuel s h | None => Some (false, h) end.

(** The states before a visit that the loop comes to. *)
Inductive reached : state M -> history -> Prop :=
  | reached_start : reached (start M) []
  | reached_step s h s' h' : reached s h -> step s h = Going s' h' -> reached s' h'.

Variable R : state M -> path -> list (path * N) -> history -> Prop.

(** [R s k p h] reads: after the visits [h] the state [s] is at the node [k], and [p] is the stack: nodes that were asked about,
    and ranks of their children. *)
Record refines : Prop := Refines {
  r_start : R (start M) [] [] [];
  r_path s k p h : R s k p h -> path_of M s = k;
  r_seen s k p h : R s k p h -> R (seen k h s) k p (k :: h);
  r_descend s k p h r rs child : R s k p (k :: h) -> at_path T k = Some (Inner child) -> ask S k (k :: h) = r :: rs ->
    beyond B (edge S (k :: h)) r = false ->
    R (descend M r rs (edge S (k :: h)) s) (slot B r :: k) (map (pair k) rs ++ p) (k :: h);
  r_skip s k a r p h : R s k ((a, r) :: p) h -> beyond B (edge S h) r = true -> R s k p h;
  r_next s k a r p h : R s k ((a, r) :: p) h -> beyond B (edge S h) r = false ->
    exists s', back M (now h) (edge S h) s = Some s' /\ R s' (slot B r :: a) p h;
  r_done s k h : R s k [] h -> back M (now h) (edge S h) s = None }.

Hypothesis F : fair B T S.
Hypothesis Ref : refines.

(** From a state before the visit of [k], the loop does what the reference does in the subtree of [k]; a visit takes a turn. *)
Definition does (t : wide) : Prop := forall k s p h, at_path T k = Some t -> R s k p h ->
  exists n, match visit B S t k h with
  | (true, h') => length h' = (n + length h)%nat /\ forall f, run (n + f) s h = Some (true, h')
  | (false, h') => length h' = (n + length h)%nat /\ exists s' k', R s' k' p h' /\ forall f, run (n + f) s h = after f s' h'
  end.

(** The children of [k] that are left, from a state that is to go back to them. *)
Lemma each_does child k : at_path T k = Some (Inner child) -> (forall s t, child s = Some t -> does t) ->
  forall rs s k0 p h, (forall r, In r rs -> child (slot B r) <> None) -> R s k0 (map (pair k) rs ++ p) h ->
  exists n, match each (fun h r => beyond B (edge S h) r)
        (fun r h => match child (slot B r) with Some t => visit B S t (slot B r :: k) h | None => (false, h) end) rs h with
  | (true, h') => length h' = (n + length h)%nat /\ forall f, after (n + f) s h = Some (true, h')
  | (false, h') => length h' = (n + length h)%nat /\ exists s' k', R s' k' p h' /\ forall f, after (n + f) s h = after f s' h'
  end.
Proof.
  intros Hk IH. induction rs as [|r rs IHr]; intros s k0 p h Hin HR.
  - exists O. split; [reflexivity|]. exists s, k0. split; [exact HR|reflexivity].
  - simpl in HR. cbn [each]. destruct (beyond B (edge S h) r) eqn:Hb.
    + eapply r_skip in HR; eauto. apply (IHr s k0 p h); [|exact HR]. intros x Hx. apply Hin. now right.
    + destruct (r_next Ref _ _ _ _ _ _ HR Hb) as (s1 & Hs1 & HR1).
      destruct (child (slot B r)) as [t|] eqn:Ht; [|destruct (Hin r (or_introl eq_refl)); exact Ht].
      assert (Hp : at_path T (slot B r :: k) = Some t) by (simpl; now rewrite Hk).
      destruct (IH _ _ Ht _ _ _ _ Hp HR1) as (n & Hn).
      destruct (visit B S t (slot B r :: k) h) as [[|] h1].
      * exists n. destruct Hn as [Hl Hn]. split; [exact Hl|]. intros f. unfold after at 1. rewrite Hs1. apply Hn.
      * destruct Hn as [Hl (s2 & k2 & HR2 & Hn)].
        assert (Hin' : forall x, In x rs -> child (slot B x) <> None) by (intros x Hx; apply Hin; now right).
        destruct (IHr s2 k2 p h1 Hin' HR2) as (m & Hm). exists (n + m)%nat.
        assert (E : forall f, after (n + m + f) s h = after (m + f) s2 h1).
        { intros f. unfold after at 1. rewrite Hs1. rewrite <- PeanoNat.Nat.add_assoc. apply Hn. }
        destruct (each _ _ rs h1) as [[|] h2].
        -- destruct Hm as [Hl2 Hm]. split; [lia|]. intros f. rewrite E. apply Hm.
        -- destruct Hm as [Hl2 (s3 & k3 & HR3 & Hm)]. split; [lia|]. exists s3, k3. split; [exact HR3|].
           intros f. rewrite E. apply Hm.
Qed.

Lemma run_visit t : does t.
Proof.
  induction t as [|child IH] using wide_induction; intros k s p h Hk HR.
  - exists 1%nat. simpl. assert (E : forall f, run (1 + f) s h = if stop S (k :: h) then Some (true, k :: h)
        else after f (seen k h s) (k :: h)).
    { intros f. simpl. unfold step. rewrite (r_path Ref _ _ _ _ HR), Hk. destruct (stop S (k :: h)); [reflexivity|].
      unfold go_back, after. now destruct (back M (now (k :: h)) (edge S (k :: h)) (seen k h s)). }
    simpl in E. destruct (stop S (k :: h)); (split; [reflexivity|]); [exact E|].
    exists (seen k h s), k. split; [apply r_seen; assumption|exact E].
  - pose proof (r_seen Ref _ _ _ _ HR) as HR1.
    assert (E : forall f, run (1 + f) s h = match ask S k (k :: h) with
        | [] => after f (seen k h s) (k :: h)
        | r :: rs => if beyond B (edge S (k :: h)) r then after f (seen k h s) (k :: h)
            else run f (descend M r rs (edge S (k :: h)) (seen k h s)) (k :: h) end).
    { intros f. simpl. unfold step. rewrite (r_path Ref _ _ _ _ HR), Hk. unfold go_back, after.
      destruct (ask S k (k :: h)) as [|r rs]; [now destruct (back M _ _ (seen k h s))|].
      destruct (beyond B (edge S (k :: h)) r); [now destruct (back M _ _ (seen k h s))|reflexivity]. }
    cbn [visit]. set (h1 := k :: h) in *.
    assert (Hch : forall r, In r (ask S k h1) -> child (slot B r) <> None) by (intros r; eapply f_children; eauto).
    assert (Hso : StronglySorted N.lt (ask S k h1)) by apply (f_sorted _ _ _ F).
    destruct (ask S k h1) as [|r rs] eqn:Ha.
    + exists 1%nat. split; [reflexivity|]. exists (seen k h s), k. split; [exact HR1|exact E].
    + destruct (beyond B (edge S h1) r) eqn:Hb.
      * (* All are beyond. *)
        assert (Hnone : each (fun h r => beyond B (edge S h) r) (fun r h => match child (slot B r) with
            | Some t => visit B S t (slot B r :: k) h | None => (false, h) end) (r :: rs) h1 = (false, h1)).
        { assert (Hall : forall x, In x (r :: rs) -> beyond B (edge S h1) x = true).
          { apply StronglySorted_inv in Hso. destruct Hso as [_ Hf]. rewrite Forall_forall in Hf.
            intros x [<-|Hx]; [exact Hb|]. apply (beyond_le B _ r); [|exact Hb]. apply Hf in Hx. lia. }
          clear - Hall. revert Hall. generalize (r :: rs). intros l. induction l as [|x l IH]; intros Hall; [reflexivity|].
          cbn [each]. rewrite (Hall x (or_introl eq_refl)). apply IH. intros y Hy. apply Hall. now right. }
        rewrite Hnone. exists 1%nat. split; [reflexivity|]. exists (seen k h s), k. split; [exact HR1|exact E].
      * cbn [each]. rewrite Hb.
        pose proof (r_descend Ref _ _ _ _ _ _ _ HR1 Hk Ha Hb) as HR2.
        destruct (child (slot B r)) as [t|] eqn:Ht; [|destruct (Hch r (or_introl eq_refl)); exact Ht].
        assert (Hp : at_path T (slot B r :: k) = Some t) by (simpl; now rewrite Hk).
        destruct (IH _ _ Ht _ _ _ _ Hp HR2) as (n & Hn). fold h1 in E, Hn |- *.
        destruct (visit B S t (slot B r :: k) h1) as [[|] h2].
        -- destruct Hn as [Hl Hn]. exists (1 + n)%nat. split; [rewrite Hl; unfold h1; simpl; lia|].
           intros f. rewrite <- PeanoNat.Nat.add_assoc. rewrite E. apply Hn.
        -- destruct Hn as [Hl (s2 & k2 & HR3 & Hn)].
           assert (Hch' : forall x, In x rs -> child (slot B x) <> None) by (intros x Hx; apply Hch; now right).
           destruct (each_does child k Hk IH rs s2 k2 p h2 Hch' HR3) as (m & Hm). exists (1 + (n + m))%nat.
           assert (E2 : forall f, run (1 + (n + m) + f) s h = after (m + f) s2 h2).
           { intros f. rewrite <- PeanoNat.Nat.add_assoc. rewrite E. rewrite <- PeanoNat.Nat.add_assoc. apply Hn. }
           destruct (each _ _ rs h2) as [[|] h3].
           ++ destruct Hm as [Hl2 Hm]. split; [rewrite Hl2, Hl; unfold h1; simpl; lia|]. intros f. rewrite E2. apply Hm.
           ++ destruct Hm as [Hl2 (s3 & k3 & HR4 & Hm)]. split; [rewrite Hl2, Hl; unfold h1; simpl; lia|].
              exists s3, k3. split; [exact HR4|]. intros f. rewrite E2. apply Hm.
Qed.

(** [WIDE-7] The loop of a right machine ends after as many visits as the reference, with its visits and its answer. *)
Theorem refines_reference fuel : (length (snd (reference B S T)) <= fuel)%nat ->
  run fuel (start M) [] = Some (reference B S T).
Proof.
  intros Hf. destruct (run_visit T [] (start M) [] [] eq_refl (r_start Ref)) as (n & Hn).
  unfold reference in *. destruct (visit B S T [] []) as [[|] h]; simpl in Hf.
  - destruct Hn as [Hl Hn]. simpl in Hl. replace fuel with (n + (fuel - n))%nat by lia. apply Hn.
  - destruct Hn as [Hl (s & k & HR & Hn)]. simpl in Hl. replace fuel with (n + (fuel - n))%nat by lia.
    rewrite Hn. unfold after. now rewrite (r_done Ref _ _ _ HR).
Qed.

(** A state that is reached stands for a node and a stack. *)
Theorem reached_refines s h : reached s h -> exists k p, R s k p h.
Proof.
  induction 1 as [|s h s' h' _ (k & p & HR) Hs]; [exists [], []; apply (r_start Ref)|].
  pose proof (r_seen Ref _ _ _ _ HR) as HR1.
  assert (Hback : go_back (seen k h s) (k :: h) = Going s' h' -> exists k p, R s' k p h').
  { unfold go_back. destruct (back M (now (k :: h)) (edge S (k :: h)) (seen k h s)) as [s1|] eqn:Hb; [|discriminate].
    intros [= <- <-]. clear Hs HR. induction p as [|[a r] p IH].
    - rewrite (r_done Ref _ _ _ HR1) in Hb. discriminate.
    - destruct (beyond B (edge S (k :: h)) r) eqn:Hr; [apply IH; eapply r_skip; eauto|].
      destruct (r_next Ref _ _ _ _ _ _ HR1 Hr) as (s2 & Hb2 & HR2). rewrite Hb in Hb2. injection Hb2 as <-. eauto. }
  unfold step in Hs. rewrite (r_path Ref _ _ _ _ HR) in Hs.
  destruct (at_path T k) as [[|child]|] eqn:Hk; [|destruct (ask S k (k :: h)) as [|r rs] eqn:Ha|discriminate].
  - destruct (stop S (k :: h)); [discriminate|auto].
  - auto.
  - destruct (beyond B (edge S (k :: h)) r) eqn:Hb; [auto|]. injection Hs as <- <-.
    eexists. eexists. eapply (r_descend Ref); eauto.
Qed.

End Loop.

Arguments Going {M}.
Arguments Done {M}.
Arguments Lost {M}.

(** What is not beyond of a stack. *)
Definition live_stack (e : N) (p : list (path * N)) : list (path * N) := filter (fun x => negb (beyond B e (snd x))) p.

Lemma live_stack_app e p q : live_stack e (p ++ q) = live_stack e p ++ live_stack e q.
Proof. apply filter_app. Qed.

Lemma live_stack_level e a rs : live_stack e (map (pair a) rs) = map (pair a) (live B e rs).
Proof.
  induction rs as [|r rs IH]; [reflexivity|]. unfold live_stack, live in *. simpl. rewrite IH.
  destruct (beyond B e r); reflexivity.
Qed.

Lemma live_stack_mono e e' p q : e' <= e -> live_stack e p = live_stack e q -> live_stack e' p = live_stack e' q.
Proof.
  intros He H. unfold live_stack in *. set (f e (x : path * N) := negb (beyond B e (snd x))) in *.
  assert (G : forall x, f e' x = true -> f e x = true).
  { intros [a r]. unfold f. rewrite !negb_true_iff. destruct (beyond B e _) eqn:E; [|reflexivity].
    now rewrite (beyond_mono B _ _ _ He E). }
  change (filter (f e') p = filter (f e') q). rewrite <- (filter_filter _ _ p G), <- (filter_filter _ _ q G).
  assert (H' : filter (f e) p = filter (f e) q) by exact H. now rewrite H'.
Qed.

(** * The sorted stack *)

(** The topmost entry that is not beyond. *)
Fixpoint pop (e : N) (p : list (path * N)) : option (path * list (path * N)) :=
  match p with
  | [] => None
  | (a, r) :: p => if beyond B e r then pop e p else Some (slot B r :: a, p)
  end.

(** The present node, and the wanted children that were pushed, each by its parent and its rank. *)
Definition stack_machine : machine := {|
  state := path * list (path * N);
  start := ([], []);
  path_of := fst;
  age s := s;
  descend r rs e '(k, p) := (slot B r :: k, map (pair k) rs ++ p);
  back ans e '(k, p) := pop e p |}.

Lemma pop_live e p : match live_stack e p with
  | [] => pop e p = None
  | (a, r) :: q => exists p', pop e p = Some (slot B r :: a, p') /\ live_stack e p' = q end.
Proof.
  induction p as [|[a r] p IH]; [reflexivity|]. simpl. destruct (beyond B e r); simpl; [exact IH|]. eauto.
Qed.

Lemma stack_refines T S : fair B T S ->
  refines stack_machine T S (fun s k p h => fst s = k /\ live_stack (edge S h) (snd s) = live_stack (edge S h) p).
Proof.
  intros F. split; simpl.
  - auto.
  - intros s k p h [H _]. exact H.
  - intros s k p h [Hk H]. unfold seen. simpl. assert (E : (if edge S (k :: h) =? edge S h then s else s) = s) by
      now destruct (edge S (k :: h) =? edge S h). rewrite E. split; [exact Hk|].
    apply (live_stack_mono (edge S h)); [apply (f_edge _ _ _ F)|exact H].
  - intros [k' q] k p h r rs child [Hk H] _ _ _. simpl in *. subst k'. split; [reflexivity|].
    rewrite !live_stack_app. congruence.
  - intros s k a r p h [Hk H] Hb. split; [exact Hk|]. rewrite H. simpl. now rewrite Hb.
  - intros [k' q] k a r p h [_ H] Hb. simpl in *. rewrite Hb in H. simpl in H. pose proof (pop_live (edge S h) q) as P.
    rewrite H in P. destruct P as (p' & Hp & Hl). exists (slot B r :: a, p'). auto.
  - intros [k' q] k h [_ H]. simpl in *. pose proof (pop_live (edge S h) q) as P. now rewrite H in P.
Qed.

(** [WSTACK-1, WIDE-7] The stack, the greatest rank pushed first, with what is beyond dropped when it is popped. *)
Theorem wide_stack_reference T S fuel : fair B T S -> (length (snd (reference B S T)) <= fuel)%nat ->
  run stack_machine T S fuel (start stack_machine) [] = Some (reference B S T).
Proof. intros F. apply (refines_reference _ _ _ _ F (stack_refines T S F)). Qed.

End Machine.
