(** The restart trail of a wide tree: how many children are done, a short stack, and the way down again: [WRESTART-1]. *)

Require Import List NArith Lia Bool Sorted.
Require Import Wide WideMachine WideLevels WideKeep.
Import ListNotations.
Open Scope N_scope.

Section Restart.

Variable B : N.
(** How many entries the short stack has. *)
Variable K : nat.

(** The topmost entry that is not beyond, and what is below it. *)
Fixpoint pop_entry (e : N) (p : list (path * N)) : option (path * N * list (path * N)) :=
  match p with
  | [] => None
  | (a, r) :: p => if beyond B e r then pop_entry e p else Some (a, r, p)
  end.

(** The node to which the numbers of the children that are done lead from the root, its own level first, and all that is
    pending. [None] if a level is done: as many children are left as are done, or fewer, or what is left is beyond. *)
Fixpoint down (ans : path -> list N) (e : N) (cs : list nat) : option (path * list (path * N)) :=
  match cs with
  | [] => Some ([], [])
  | c :: cs =>
      match down ans e cs with
      | None => None
      | Some (a, st) =>
          match skipn c (ans a) with
          | [] => None
          | r :: rs => if beyond B e r then None else Some (slot B r :: a, map (pair a) rs ++ st)
          end
      end
  end.

(** The child is done; if so is its level, then the level's node is. *)
Fixpoint restart (ans : path -> list N) (e : N) (cs : list nat) : option (path * list nat * list (path * N)) :=
  match cs with
  | [] => None
  | c :: cs =>
      match down ans e (S c :: cs) with
      | Some (k, st) => Some (k, S c :: cs, firstn K st)
      | None => restart ans e cs
      end
  end.

(** One child more is done. *)
Definition done (cs : list nat) : list nat := match cs with [] => [] | c :: cs => S c :: cs end.

(** The present node, how many children are done at each level from its parent's up, and the short stack: what is pushed
    falls out below. *)
Definition restart_machine : machine := {|
  state := path * list nat * list (path * N);
  start := ([], [], []);
  path_of s := fst (fst s);
  age s := s;
  descend r rs e '(k, cs, st) := (slot B r :: k, O :: cs, firstn K (map (pair k) rs ++ st));
  back ans e '(k, cs, st) :=
    match pop_entry e st with
    | Some (a, r, st) => Some (slot B r :: a, done (skipn (length k - S (length a)) cs), st)
    | None => restart ans e cs
    end |}.

Variable T : wide.
Variable S : search.
Hypothesis F : fair B T S.

(** A child's children do not begin before it. *)
Definition nested : Prop := forall a h r h' r', In r (ask S a h) -> In r' (ask S (slot B r :: a) h') ->
  2 ^ B * (r / 2 ^ B) <= 2 ^ B * (r' / 2 ^ B).

Hypothesis N_nested : nested.

(** The numbers are right: the child on the path is the next one, and those after it are pending. *)
Fixpoint counts (h : history) (k : path) (cs : list nat) (p : list (path * N)) : Prop :=
  match k, cs with
  | [], [] => live_stack B (edge S h) p = []
  | s :: a, c :: cs => exists l r q, answered S a h l /\ nth_error l c = Some r /\ slot B r = s /\ counts h a cs q /\
      live_stack B (edge S h) p = live_stack B (edge S h) (map (pair a) (skipn (Datatypes.S c) l) ++ q)
  | _, _ => False
  end.

Lemma counts_live h k cs p q : live_stack B (edge S h) p = live_stack B (edge S h) q -> counts h k cs p -> counts h k cs q.
Proof.
  intros E. destruct k as [|s a], cs as [|c cs]; simpl; try congruence. intros (l & r & q' & H1 & H2 & H3 & H4 & H5).
  exists l, r, q'. repeat split; try assumption. congruence.
Qed.

Lemma counts_seen k h : forall a cs p, counts h a cs p -> counts (k :: h) a cs p.
Proof.
  pose proof (f_edge _ _ _ F k h) as He. intros a. induction a as [|s a IH]; intros [|c cs] p; simpl; try contradiction.
  - intros H. change [] with (live_stack B (edge S (k :: h)) []). eapply live_stack_mono; eauto.
  - intros (l & r & q & H1 & H2 & H3 & H4 & H5). exists l, r, q. split; [now apply answered_seen|]. split; [exact H2|].
    split; [exact H3|]. split; [now apply IH|]. eapply live_stack_mono; eauto.
Qed.

Lemma answered_sorted a h l : answered S a h l -> StronglySorted N.lt l.
Proof. intros (g & h0 & _ & ->). apply (f_sorted _ _ _ F). Qed.

Lemma sorted_skipn c : forall l, StronglySorted N.lt l -> StronglySorted N.lt (skipn c l).
Proof.
  induction c as [|c IH]; intros [|x l] H; try exact H. simpl. apply IH. now apply StronglySorted_inv in H.
Qed.

(** What is not beyond comes first. *)
Lemma live_skipn e c : forall l, StronglySorted N.lt l -> live B e (skipn c l) = skipn c (live B e l).
Proof.
  induction c as [|c IH]; intros [|x l] H; try reflexivity. destruct (beyond B e x) eqn:Hb.
  - rewrite (live_none B e x l H Hb). simpl. rewrite IH by now apply StronglySorted_inv in H.
    pose proof (live_none B e x l H Hb) as E. simpl in E. rewrite Hb in E. simpl in E. rewrite E. now destruct c.
  - rewrite live_cons by exact Hb. simpl. apply IH. now apply StronglySorted_inv in H.
Qed.

Lemma live_first e l r rs : StronglySorted N.lt l -> live B e l = r :: rs ->
  exists l', l = r :: l' /\ beyond B e r = false /\ live B e l' = rs.
Proof.
  intros H E. destruct l as [|x l]; [discriminate|]. destruct (beyond B e x) eqn:Hb.
  - rewrite (live_none B e x l H Hb) in E. discriminate.
  - rewrite live_cons in E by exact Hb. injection E as -> <-. eauto.
Qed.

(** Asked again, what comes after those that are done is the same. *)
Lemma again a h l c : answered S a h l -> live B (edge S h) (skipn c (ask S a h)) = live B (edge S h) (skipn c l).
Proof.
  intros H. rewrite !live_skipn; [|eapply answered_sorted; eauto|apply (f_sorted _ _ _ F)].
  destruct H as (g & h0 & -> & ->). f_equal. apply (f_again _ _ _ F).
Qed.

Lemma nth_skipn {X} (l : list X) c r : nth_error l c = Some r -> skipn c l = r :: skipn (Datatypes.S c) l.
Proof.
  revert l. induction c as [|c IH]; intros [|x l] H; try discriminate; simpl in *; [congruence|]. now apply IH.
Qed.

Lemma skipn_nth {X} (l : list X) : forall c x l', skipn c l = x :: l' -> nth_error l c = Some x.
Proof.
  induction l as [|y l IH]; intros [|c] x l' E; try discriminate; simpl in *; [congruence|]. eapply IH; eauto.
Qed.

Lemma skipn_rest {X} (l : list X) : forall c x l', skipn c l = x :: l' -> skipn (Datatypes.S c) l = l'.
Proof.
  induction l as [|y l IH]; intros [|c] x l' E; try discriminate; simpl in *; [congruence|]. eapply (IH c); eauto.
Qed.

(** The way down comes to [k] again, with all that is pending, unless all that [k] could want is beyond. *)
Lemma down_spec h : forall k cs p, counts h k cs p -> match down (now S h) (edge S h) cs with
  | Some (k', st) => k' = k /\ live_stack B (edge S h) st = live_stack B (edge S h) p
  | None => forall h' r, In r (ask S k h') -> beyond B (edge S h) r = true end.
Proof.
  induction k as [|s a IH]; intros [|c cs] p; cbn [counts down]; try contradiction; [auto|].
  intros (l & r & q & Hl & Hc & <- & H & Hp). specialize (IH _ _ H).
  assert (Hin : exists h0, In r (ask S a h0)).
  { destruct Hl as (g & h0 & _ & ->). exists (a :: h0). eapply nth_error_In; eauto. }
  destruct Hin as (h0 & Hin).
  assert (Hdead : beyond B (edge S h) r = true -> forall h' x, In x (ask S (slot B r :: a) h') -> beyond B (edge S h) x = true).
  { unfold beyond. intros Hb h' x Hx. pose proof (N_nested _ _ _ _ _ Hin Hx). apply N.ltb_lt in Hb. apply N.ltb_lt. lia. }
  destruct (down (now S h) (edge S h) cs) as [[a' st]|]; [|apply Hdead; eauto].
  destruct IH as [-> Hst]. unfold now. pose proof (again _ _ _ c Hl) as Ha. rewrite (nth_skipn _ _ _ Hc) in Ha.
  pose proof (sorted_skipn c _ (f_sorted _ _ _ F a h)) as Hso.
  pose proof (sorted_skipn c _ (answered_sorted _ _ _ Hl)) as Hsl. rewrite (nth_skipn _ _ _ Hc) in Hsl.
  destruct (beyond B (edge S h) r) eqn:Hb.
  - rewrite (live_none _ _ _ _ Hsl Hb) in Ha. destruct (skipn c (ask S a h)) as [|x rs]; [now apply Hdead|].
    destruct (beyond B (edge S h) x) eqn:Hx; [now apply Hdead|]. rewrite live_cons in Ha by exact Hx. discriminate.
  - rewrite (live_cons _ _ _ _ Hb) in Ha. destruct (live_first _ _ _ _ Hso Ha) as (rs & -> & Hb' & Hrs). rewrite Hb'.
    split; [reflexivity|]. rewrite Hp, !live_stack_app, !live_stack_level. congruence.
Qed.

(** The deepest level that has a child left: as the stack has it. *)
Lemma restart_spec h : forall k cs p, counts h k cs p -> match live_stack B (edge S h) p with
  | [] => restart (now S h) (edge S h) cs = None
  | (a, r) :: q => exists cs' st, restart (now S h) (edge S h) cs = Some (slot B r :: a, cs', firstn K st) /\
      counts h (slot B r :: a) cs' q /\ live_stack B (edge S h) st = live_stack B (edge S h) q end.
Proof.
  induction k as [|s a IH]; intros [|c cs] p; cbn [counts]; try contradiction; [now intros ->|].
  intros (l & r & q & Hl & Hc & Hs & H & Hp). rewrite Hp, live_stack_app, live_stack_level. cbn [restart].
  pose proof (down_spec h _ _ _ H) as Hd. pose proof (again _ _ _ (Datatypes.S c) Hl) as Ha.
  pose proof (sorted_skipn (Datatypes.S c) _ (f_sorted _ _ _ F a h)) as Hso.
  pose proof (sorted_skipn (Datatypes.S c) _ (answered_sorted _ _ _ Hl)) as Hsl.
  destruct (live B (edge S h) (skipn (Datatypes.S c) l)) as [|x xs] eqn:El.
  - (* The level is done. *)
    cbn [map app]. specialize (IH _ _ H).
    assert (E : down (now S h) (edge S h) (Datatypes.S c :: cs) = None).
    { cbn [down]. destruct (down (now S h) (edge S h) cs) as [[a' st]|]; [|reflexivity]. destruct Hd as [-> _]. unfold now at 1.
      destruct (skipn (Datatypes.S c) (ask S a h)) as [|y ys]; [reflexivity|].
      destruct (beyond B (edge S h) y) eqn:Hy; [reflexivity|]. rewrite live_cons in Ha by exact Hy. discriminate. }
    rewrite E. exact IH.
  - cbn [map app]. destruct (live_first _ _ _ _ Hsl El) as (l' & Hl' & Hb & Hxs).
    pose proof (skipn_nth _ _ _ _ Hl') as Hx.
    cbn [down]. destruct (down (now S h) (edge S h) cs) as [[a' st]|].
    + destruct Hd as [-> Hst]. destruct (live_first _ _ _ _ Hso Ha) as (rs & Hrs & Hb' & Hl2). unfold now at 1.
      rewrite Hrs, Hb'. exists (Datatypes.S c :: cs), (map (pair a) rs ++ st). split; [reflexivity|].
      assert (G : live_stack B (edge S h) (map (pair a) rs ++ st) =
          live_stack B (edge S h) (map (pair a) xs ++ live_stack B (edge S h) q)).
      { rewrite !live_stack_app, !live_stack_level, Hst. f_equal.
        - f_equal. rewrite Hl2, <- Hxs. symmetry. now apply filter_filter.
        - symmetry. now apply filter_filter. }
      split; [|exact G]. exists l, x, q. split; [exact Hl|]. split; [exact Hx|]. split; [reflexivity|]. split; [exact H|].
      rewrite (skipn_rest _ _ _ _ Hl'), !live_stack_app, !live_stack_level, Hxs. f_equal; [|now apply filter_filter].
      f_equal. rewrite <- Hxs. now apply filter_filter.
    + exfalso. assert (Hin : exists h0, In x (ask S a h0)).
      { destruct Hl as (g & h0 & _ & ->). exists (a :: h0). eapply nth_error_In; eauto. }
      destruct Hin as (h0 & Hin). rewrite (Hd _ _ Hin) in Hb. discriminate.
Qed.

(** If the short stack has the next child, the levels below it are done, and one child more at its own. *)
Lemma done_spec h : forall k cs p a r q, counts h k cs p -> live_stack B (edge S h) p = (a, r) :: q ->
  counts h (slot B r :: a) (done (skipn (length k - Datatypes.S (length a)) cs)) q.
Proof.
  assert (Hlen : forall k cs p, counts h k cs p -> forall a r, In (a, r) (live_stack B (edge S h) p) -> (length a < length k)%nat).
  { induction k as [|s a IH]; intros [|c cs] p; cbn [counts]; try contradiction; [intros ->; intros a r []|].
    intros (l & r & q & _ & _ & _ & H & Hp) b x. rewrite Hp, live_stack_app, live_stack_level, in_app_iff, in_map_iff.
    simpl. intros [(y & [= <- <-] & _)|Hin]; [lia|]. apply (IH _ _ H) in Hin. lia. }
  induction k as [|s a IH]; intros [|c cs] p b x q Hcs Hq; try (simpl in Hcs; contradiction).
  - simpl in Hcs. congruence.
  - pose proof Hcs as Hall. destruct Hcs as (l & r & q' & Hl & Hc & Hs & H & Hp).
    rewrite Hp, live_stack_app, live_stack_level in Hq.
    pose proof (sorted_skipn (Datatypes.S c) _ (answered_sorted _ _ _ Hl)) as Hsl.
    destruct (live B (edge S h) (skipn (Datatypes.S c) l)) as [|y ys] eqn:El.
    + cbn [map app] in Hq. pose proof (Hlen _ _ _ H b x) as Hb. rewrite Hq in Hb. specialize (Hb (or_introl eq_refl)).
      replace (length (s :: a) - Datatypes.S (length b))%nat with (Datatypes.S (length a - Datatypes.S (length b))) by (simpl; lia).
      cbn [skipn]. eapply IH; eauto.
    + cbn [map app] in Hq. injection Hq as <- <- <-.
      replace (length (s :: a) - Datatypes.S (length a))%nat with O by (simpl; lia). cbn [skipn done].
      destruct (live_first _ _ _ _ Hsl El) as (l' & Hl' & Hb & Hys).
      pose proof (skipn_nth _ _ _ _ Hl') as Hy.
      exists l, y, q'. split; [exact Hl|]. split; [exact Hy|]. split; [reflexivity|]. split; [exact H|].
      rewrite (skipn_rest _ _ _ _ Hl').
      rewrite !live_stack_app, !live_stack_level, <- Hys. f_equal; [|now apply filter_filter]. f_equal. now apply filter_filter.
Qed.

Lemma pop_entry_live e p : match live_stack B e p with
  | [] => pop_entry e p = None
  | (a, r) :: q => exists p', pop_entry e p = Some (a, r, p') /\ live_stack B e p' = q end.
Proof.
  induction p as [|[a r] p IH]; [reflexivity|]. simpl. destruct (beyond B e r); simpl; [exact IH|]. eauto.
Qed.

(** The numbers are right, and the short stack has what comes next, as far as it goes. *)
Definition restarts (s : path * list nat * list (path * N)) (k : path) (p : list (path * N)) (h : history) : Prop :=
  fst (fst s) = k /\ counts h k (snd (fst s)) p /\
  exists q, live_stack B (edge S h) p = live_stack B (edge S h) (snd s ++ q).

Lemma restart_refines : refines B restart_machine T S restarts.
Proof.
  unfold restarts. split; simpl.
  - repeat split. now exists [].
  - intros s k p h [H _]. exact H.
  - intros s k p h (Hk & H & q & Hq). unfold seen. simpl.
    assert (E : (if edge S (k :: h) =? edge S h then s else s) = s) by now destruct (edge S (k :: h) =? edge S h).
    rewrite E. split; [exact Hk|]. split; [now apply counts_seen|]. exists q. eapply live_stack_mono; [|exact Hq].
    apply (f_edge _ _ _ F).
  - intros [[k' cs] st] k p h r rs child (Hk & H & q & Hq) Ht Ha Hb. simpl in *. subst k'. split; [reflexivity|]. split.
    + exists (r :: rs), r, p. split; [rewrite <- Ha; apply answered_first|]. auto.
    + exists (skipn K (map (pair k) rs ++ st) ++ q).
      rewrite app_assoc, firstn_skipn, <- app_assoc, !(live_stack_app _ _ (map (pair k) rs)). now rewrite Hq.
  - intros s k a r p h (Hk & H & q & Hq) Hb. split; [exact Hk|].
    assert (E : live_stack B (edge S h) ((a, r) :: p) = live_stack B (edge S h) p) by (simpl; now rewrite Hb).
    split; [now apply (counts_live h k _ ((a, r) :: p))|]. exists q. exact (eq_trans (eq_sym E) Hq).
  - intros [[k' cs] st] k a r p h (Hk & H & q & Hq) Hb. simpl in *. subst k'.
    assert (E : live_stack B (edge S h) ((a, r) :: p) = (a, r) :: live_stack B (edge S h) p) by (simpl; now rewrite Hb).
    assert (Hi : live_stack B (edge S h) (live_stack B (edge S h) p) = live_stack B (edge S h) p) by now apply filter_filter.
    rewrite live_stack_app in Hq. pose proof (pop_entry_live (edge S h) st) as P.
    destruct (live_stack B (edge S h) st) as [|[a' r'] st'] eqn:Est.
    + rewrite P. pose proof (restart_spec h _ _ _ H) as R. rewrite E in R. destruct R as (cs' & st' & -> & Hc & Hst).
      eexists. split; [reflexivity|]. split; [reflexivity|]. split; [exact (counts_live _ _ _ _ _ Hi Hc)|].
      exists (skipn K st'). simpl. rewrite firstn_skipn. congruence.
    + destruct P as (p' & -> & Hp'). simpl in Hq. rewrite Hb in Hq. simpl in Hq. injection Hq as <- <- Hq.
      eexists. split; [reflexivity|]. split; [reflexivity|].
      split; [exact (counts_live _ _ _ _ _ Hi (done_spec _ _ _ _ _ _ _ H E))|].
      exists q. simpl. rewrite live_stack_app. congruence.
  - intros [[k' cs] st] k h (Hk & H & q & Hq). simpl in *. subst k'. rewrite live_stack_app in Hq.
    pose proof (pop_entry_live (edge S h) st) as P. symmetry in Hq. apply app_eq_nil in Hq. destruct Hq as [Hq _].
    rewrite Hq in P. rewrite P. exact (restart_spec h _ _ _ H).
Qed.

(** [WRESTART-1, WIDE-7] The restart machine has the reference's visits and answer, with a short stack of any length, if a child's
    children do not begin before it. *)
Theorem wide_restart_reference fuel : (length (snd (reference B S T)) <= fuel)%nat ->
  run B restart_machine T S fuel (start restart_machine) [] = Some (reference B S T).
Proof. exact (refines_reference _ _ _ _ _ F restart_refines fuel). Qed.

End Restart.

(** * Children that begin before their parent *)

Module Before.

(** The root has one child, with two leaves. It begins at 8, its leaves at 0 and 2; at the first leaf the end becomes 4. *)
Definition T := Inner (fun s => if s =? 0 then Some (Inner (fun s => if s <? 2 then Some WLeaf else None)) else None).
Definition S := Search (fun k _ => match k with [] => [8] | _ => [0; 3] end) (fun _ => false)
  (fun h => if Nat.ltb (length h) 3 then 8 else 4).

Lemma is_fair : fair 1 T S.
Proof.
  split; simpl; try reflexivity.
  - intros [|s k] _; repeat constructor.
  - intros [|s k] _; repeat constructor; intros H; repeat destruct H as [H|H]; discriminate || contradiction.
  - intros k _ r child Hk Hr.
    assert (E : (k = [] /\ Inner child = T) \/ child = fun s => if s <? 2 then Some WLeaf else None).
    { clear Hr. revert child Hk. induction k as [|s k IH]; simpl; intros child Hk; [left; split; congruence|]. right.
      destruct (at_path T k) as [[|c]|]; try discriminate. destruct (IH c eq_refl) as [[_ E]|E].
      - injection E as ->. destruct (s =? 0); congruence.
      - subst c. destruct (s <? 2); discriminate. }
    destruct E as [[-> E]| ->]; [injection E as ->; destruct Hr as [<-|[]]; discriminate|].
    destruct k as [|s k]; [destruct Hr as [<-|[]]|destruct Hr as [<-|[<-|[]]]]; discriminate.
  - intros k h. destruct (PeanoNat.Nat.ltb_spec (Datatypes.S (length h)) 3), (PeanoNat.Nat.ltb_spec (length h) 3); lia.
Qed.

(** [WRESTART-1] Without that the way down may end at a node that is beyond, and what is below it is lost though it is not. *)
Example lost : fair 1 T S /\ reference 1 S T = (false, [[1; 0]; [0; 0]; [0]; []]) /\
  run 1 (restart_machine 1 0) T S 9 (start (restart_machine 1 0)) [] = Some (false, [[0; 0]; [0]; []]).
Proof. split; [apply is_fair|split; reflexivity]. Qed.

End Before.
