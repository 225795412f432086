(** What a search for the closest hit may leave out: the outcome is that of the search which leaves out nothing.

    Hits are ordered by any strict total order; for rays, by distance, those at one distance by index. So "the
    closest" is one hit, and "not better" may be an equal one. *)

Require Import List PArith NArith Lia Bool Arith.
Require Import Tree Machine Register HashedKeys Resume Disjoint.
Import ListNotations.

Section Closest.

Variable hit : Type.
Variable before : hit -> hit -> bool.
Hypothesis before_irreflexive : forall x, before x x = false.
Hypothesis before_transitive : forall x y z, before x y = true -> before y z = true -> before x z = true.
Hypothesis before_total : forall x y, before x y = false -> before y x = false -> x = y.

Variable T : tree.
(** The closest hit in a leaf, by its key. *)
Variable offer : positive -> option hit.

(** * The closer of two hits, if there are any *)

Definition closer (a b : option hit) : option hit :=
  match a, b with
  | Some x, Some y => if before y x then b else a
  | None, _ => b
  | _, None => a
  end.

Lemma closer_none a : closer a None = a.
Proof. now destruct a. Qed.

Lemma closer_comm a b : closer a b = closer b a.
Proof.
  destruct a as [x|], b as [y|]; cbn; try reflexivity. destruct (before y x) eqn:E, (before x y) eqn:F; try reflexivity.
  - pose proof (before_transitive _ _ _ E F). rewrite before_irreflexive in H. discriminate.
  - f_equal. auto.
Qed.

(** Not before, and then before: not before. *)
Lemma before_negative x y z : before y x = false -> before z y = false -> before z x = false.
Proof.
  intros E F. destruct (before z x) eqn:G; [|reflexivity]. destruct (before x y) eqn:H.
  - rewrite (before_transitive _ _ _ G H) in F. discriminate.
  - rewrite (before_total _ _ E H) in *. congruence.
Qed.

Lemma closer_assoc a b c : closer a (closer b c) = closer (closer a b) c.
Proof.
  destruct a as [x|], b as [y|], c as [z|]; cbn; try reflexivity; [|now destruct (before y x)].
  destruct (before z y) eqn:E, (before y x) eqn:F; cbn; rewrite ?E, ?F; try reflexivity.
  - now rewrite (before_transitive _ _ _ E F).
  - now rewrite (before_negative x y z F E).
Qed.

Lemma closer_same a : closer a a = a.
Proof. destruct a as [x|]; cbn; [now rewrite before_irreflexive|reflexivity]. Qed.

(** [y] adds nothing to [a]: neither before nor after [a] has become better. *)
Lemma closer_absorbs a b y : closer a y = a -> closer (closer a b) y = closer a b.
Proof. intros H. now rewrite (closer_comm a b), <- closer_assoc, H. Qed.

(** * What a search knows *)

Definition found_in (k : positive) : option hit := match at_key T k with Some Leaf => offer k | _ => None end.

(** The best that has been found, by the visits. *)
Definition best (h : history) : option hit := fold_right (fun k b => closer b (found_in k)) None h.

(** The best of a subtree whose root has key [k]. *)
Fixpoint best_below (t : tree) (k : positive) : option hit :=
  match t with Leaf => offer k | Node l r => closer (best_below l (xO k)) (best_below r (xI k)) end.

(** The keys of its leaves. *)
Fixpoint leaves (t : tree) (k : positive) : list positive :=
  match t with Leaf => [k] | Node l r => leaves l (xO k) ++ leaves r (xI k) end.

(** Nothing in this subtree is better than [b]. *)
Definition nothing_better (b : option hit) (t : tree) (k : positive) : Prop :=
  forall q o, In q (leaves t k) -> offer q = Some o -> exists x, b = Some x /\ before o x = false.

Lemma nothing_better_spec b t : forall k, nothing_better b t k -> closer b (best_below t k) = b.
Proof.
  induction t as [|l IHl r IHr]; intros k H.
  - cbn. destruct (offer k) as [o|] eqn:Ho; [|apply closer_none].
    destruct (H k o (or_introl eq_refl) Ho) as (x & -> & Hx). cbn. now rewrite Hx.
  - cbn. rewrite closer_assoc, IHl, IHr; [reflexivity| |]; intros q o Hq; apply H; apply in_or_app; auto.
Qed.

Lemma best_app g h : best (g ++ h) = closer (best h) (best g).
Proof.
  induction g as [|k g IH]; [symmetry; apply closer_none|].
  change (closer (best (g ++ h)) (found_in k) = closer (best h) (closer (best g) (found_in k))).
  now rewrite IH, closer_assoc.
Qed.

Lemma best_below_node sd l r k :
  best_below (Node l r) k = closer (best_below (subtree sd l r) (child sd k)) (best_below (subtree (other sd) l r)
    (child (other sd) k)).
Proof. destruct sd; [reflexivity|apply closer_comm]. Qed.

Lemma best_inner k h l r : at_key T k = Some (Node l r) -> best (k :: h) = best h.
Proof. intros H. cbn. unfold found_in. rewrite H. apply closer_none. Qed.

(** * The search *)

Variable decide : history -> descent.

(** A search may drop a child only if nothing below it is better than the best so far. *)
Definition culls : Prop := forall k h l r, at_key T k = Some (Node l r) ->
  match decide (k :: h) with
  | Neither => forall sd, nothing_better (best (k :: h)) (subtree sd l r) (child sd k)
  | Only sd => nothing_better (best (k :: h)) (subtree (other sd) l r) (child (other sd) k)
  | Both _ => True
  end.

Hypothesis search_culls : culls.

(** [ORACLE-1] Without pruning: the closest of all. *)
Lemma visit_best t : forall k h, at_key T k = Some t ->
  best (snd (visit decide never t k h)) = closer (best h) (best_below t k) /\ fst (visit decide never t k h) = false.
Proof.
  induction t as [|l IHl r IHr]; intros k h Hk.
  - cbn. unfold found_in. now rewrite Hk.
  - assert (IH : forall sd h, let v := visit decide never (subtree sd l r) (child sd k) h in
      best (snd v) = closer (best h) (best_below (subtree sd l r) (child sd k)) /\ fst v = false).
    { intros sd h'. pose proof (at_child T sd k l r Hk). destruct sd; [apply IHl|apply IHr]; assumption. }
    clear IHl IHr. pose proof (search_culls k h l r Hk) as Hc. cbn [visit]. destruct (decide (k :: h)) as [|sd|sd].
    + cbn [snd fst]. split; [|reflexivity].
      rewrite (best_below_node L), closer_assoc, <- (best_inner k h l r Hk).
      now rewrite (nothing_better_spec _ _ _ (Hc L)), (nothing_better_spec _ _ _ (Hc (other L))).
    + destruct (IH sd (k :: h)) as [Hb Hf]. split; [|exact Hf].
      rewrite Hb, <- (best_inner k h l r Hk), (best_below_node sd), closer_assoc.
      now rewrite closer_absorbs by exact (nothing_better_spec _ _ _ Hc).
    + destruct (IH sd (k :: h)) as [Hb Hf].
      destruct (visit decide never (subtree sd l r) (child sd k) (k :: h)) as [s h1]. cbn [snd fst] in *. subst s.
      destruct (IH (other sd) h1) as [Hb2 Hf2]. split; [|exact Hf2].
      now rewrite Hb2, Hb, (best_inner k h l r Hk), (best_below_node sd), closer_assoc.
Qed.

(** ** From the key of a node alone *)

Lemma best_around k : forall t, at_key T k = Some t ->
  fold_left closer (map (fun q => match at_key T q with Some t => best_below t q | None => None end) (siblings k))
    (best_below t k)
  = best_below T xH.
Proof.
  induction k as [k IH|k IH|]; intros t Ht; cbn in Ht; [| |now injection Ht as ->];
    destruct (at_key T k) as [[|l r]|] eqn:Hk; try discriminate; injection Ht as <-;
    cbn [siblings map fold_left sibling at_key]; rewrite Hk, <- (IH _ eq_refl); f_equal; apply closer_comm.
Qed.

Lemma visit_all_best ks : forall h b, (forall q, In q ks -> exists t, at_key T q = Some t) -> best h = b ->
  best (snd (visit_all T decide never ks h)) =
  fold_left closer (map (fun q => match at_key T q with Some t => best_below t q | None => None end) ks) b.
Proof.
  induction ks as [|k ks IH]; intros h b Hin Hb; [exact Hb|].
  destruct (Hin k (or_introl eq_refl)) as (t & Ht). cbn [visit_all map fold_left]. rewrite Ht.
  destruct (visit_best t k h Ht) as [Hv Hf]. destruct (visit decide never t k h) as [s h1]. cbn [fst snd] in *. subst s.
  apply IH; [intros q Hq; apply Hin; now right|]. now rewrite Hv, Hb.
Qed.

Lemma fold_closer l : forall a b, fold_left closer l (closer a b) = closer a (fold_left closer l b).
Proof. induction l as [|c l IH]; intros a b; [reflexivity|]. cbn. now rewrite <- closer_assoc, IH. Qed.

(** [PAUSE-4, PAUSE-7] A search for the closest hit that starts from any node, or is taken up there from the key alone
    with what it has found so far, ends with the closest of all hits, or with what it knew if that is closer. *)
Theorem key_only_is_closest k t h : at_key T k = Some t ->
  best (snd (visit_all T decide never (k :: siblings k) h)) = closer (best h) (best_below T xH).
Proof.
  intros Hk. rewrite (visit_all_best _ h (best h) (siblings_in_tree T k t Hk) eq_refl). cbn [map fold_left].
  now rewrite Hk, fold_closer, (best_around k t Hk).
Qed.

(** * With pruning *)

Variable mark : history -> bool.
Variable found : history -> bool.

(** [ORDER-3] The second child [c] of a marked descent that has the present leaf below its first. *)
Definition behind (h : history) (c : positive) (tc : tree) : Prop :=
  exists g a h' sd l r k, h = g ++ a :: h' /\ at_key T a = Some (Node l r) /\ decide (a :: h') = Both sd /\
    mark (a :: h') = true /\ head h = Some k /\ In k (leaves (subtree sd l r) (child sd a)) /\
    c = child (other sd) a /\ tc = subtree (other sd) l r.

(** [ORDER-3] If the search says *found*, the best that it knows comes before all that is below these children. *)
Definition found_is_true : Prop := forall h c tc, found h = true -> behind h c tc ->
  forall q o, In q (leaves tc c) -> offer q = Some o -> exists x, best h = Some x /\ before x o = true.

Lemma found_nothing_better h c tc : found_is_true -> found h = true -> behind h c tc -> nothing_better (best h) tc c.
Proof.
  intros H Hf Hb q o Hq Ho. destruct (H h c tc Hf Hb q o Hq Ho) as (x & Hx & Hxo). exists x. split; [exact Hx|].
  destruct (before o x) eqn:E; [|reflexivity]. pose proof (before_transitive _ _ _ Hxo E).
  rewrite before_irreflexive in H0. discriminate.
Qed.

(** [ORDER-2, ORDER-3] It is so if marks are promises, all below the first child strictly before all below the second,
    and the best that the search knows is in the leaf where it says *found*. *)
Theorem marks_are_promises :
  (forall a h l r sd q1 o1 q2 o2, at_key T a = Some (Node l r) -> decide (a :: h) = Both sd -> mark (a :: h) = true ->
    In q1 (leaves (subtree sd l r) (child sd a)) -> offer q1 = Some o1 ->
    In q2 (leaves (subtree (other sd) l r) (child (other sd) a)) -> offer q2 = Some o2 -> before o1 o2 = true) ->
  (forall k h, found (k :: h) = true -> exists x, offer k = Some x /\ best (k :: h) = Some x) ->
  found_is_true.
Proof.
  intros Hm Hf h c tc Hh (g & a & h' & sd & l & r & k & -> & Ha & Hd & Hmark & Hk & Hin & -> & ->) q o Hq Ho.
  destruct (g ++ a :: h') as [|k' h0] eqn:E; [discriminate|]. injection Hk as ->.
  destruct (Hf _ _ Hh) as (x & Hx & Hb). exists x. split; [exact Hb|]. eapply Hm; eauto.
Qed.

Hypothesis promise : found_is_true.

Let pvisit := pvisit decide mark never found.

(** What pruning needs to know of the visits of a subtree: they go on from the history; something was found at one of
    its leaves, if so it says; and the best of all is known in the end. *)
Definition well_pruned (t : tree) (k : positive) (h : history) : Prop :=
  let '(stopped, b, h') := pvisit t k h in
  stopped = false /\
  (exists g, h' = g ++ h) /\
  (b = true -> exists g q h0 g0, h' = g ++ q :: h0 /\ h0 = g0 ++ h /\ found (q :: h0) = true /\ In q (leaves t k)) /\
  best h' = closer (best h) (best_below t k).

Lemma leaves_child sd l r k q : In q (leaves (subtree sd l r) (child sd k)) -> In q (leaves (Node l r) k).
Proof. intros H. cbn. apply in_or_app. destruct sd; auto. Qed.

Lemma pvisit_well_pruned t : forall k h, at_key T k = Some t -> well_pruned t k h.
Proof.
  induction t as [|l IHl r IHr]; intros k h Hk; unfold well_pruned, pvisit.
  - cbn. split; [reflexivity|]. split; [now exists [k]|]. unfold found_in. rewrite Hk. split; [|reflexivity].
    intros Hf. exists [], k, h, []. auto.
  - assert (IH : forall sd h, well_pruned (subtree sd l r) (child sd k) h).
    { intros sd h'. pose proof (at_child T sd k l r Hk). destruct sd; [apply IHl|apply IHr]; assumption. }
    clear IHl IHr. pose proof (search_culls k h l r Hk) as Hc. cbn [Disjoint.pvisit].
    destruct (decide (k :: h)) as [|sd|sd] eqn:Hd.
    + split; [reflexivity|]. split; [now exists [k]|]. split; [discriminate|].
      rewrite (best_below_node L), closer_assoc, <- (best_inner k h l r Hk).
      now rewrite (nothing_better_spec _ _ _ (Hc L)), (nothing_better_spec _ _ _ (Hc (other L))).
    + pose proof (IH sd (k :: h)) as H. unfold well_pruned, pvisit in H.
      destruct (Disjoint.pvisit decide mark never found _ _ _) as [[s b] h1]. destruct H as (Hs & (g & ->) & Hf & Hb).
      split; [exact Hs|]. split; [exists (g ++ [k]); now rewrite <- app_assoc|]. split.
      * intros Hb1. destruct (Hf Hb1) as (g1 & q & h0 & g0 & E & -> & Hq & Hin).
        exists g1, q, (g0 ++ k :: h), (g0 ++ [k]). rewrite <- app_assoc. repeat split; eauto using leaves_child.
      * rewrite Hb, <- (best_inner k h l r Hk), (best_below_node sd), closer_assoc.
        now rewrite closer_absorbs by exact (nothing_better_spec _ _ _ Hc).
    + pose proof (IH sd (k :: h)) as H. unfold well_pruned, pvisit in H.
      destruct (Disjoint.pvisit decide mark never found _ _ _) as [[s b1] h1].
      destruct H as (-> & (g & E1) & Hf & Hb). rewrite (best_inner k h l r Hk) in Hb.
      destruct (mark (k :: h) && b1) eqn:Hm.
      * apply andb_prop in Hm. destruct Hm as [Hm ->]. destruct (Hf eq_refl) as (g1 & q & h0 & g0 & E & -> & Hq & Hin).
        split; [reflexivity|]. split; [exists (g ++ [k]); now rewrite <- app_assoc|]. split.
        -- intros _. exists g1, q, (g0 ++ k :: h), (g0 ++ [k]). rewrite <- app_assoc.
           repeat split; eauto using leaves_child.
        -- rewrite (best_below_node sd), closer_assoc, <- Hb. symmetry. rewrite E, best_app. apply closer_absorbs.
           apply nothing_better_spec, found_nothing_better; [exact promise|exact Hq|].
           exists (q :: g0), k, h, sd, l, r, q. repeat split; assumption.
      * pose proof (IH (other sd) h1) as H. unfold well_pruned, pvisit in H.
        destruct (Disjoint.pvisit decide mark never found (subtree (other sd) l r) _ _) as [[s b2] h2].
        destruct H as (-> & (g2 & E2) & Hf2 & Hb2). split; [reflexivity|].
        split; [exists (g2 ++ g ++ [k]); rewrite E2, E1, <- !app_assoc; reflexivity|]. split.
        -- intros Hor. apply orb_prop in Hor. destruct b2.
           ++ destruct (Hf2 eq_refl) as (g1 & q & h0 & g0 & E & -> & Hq & Hin).
              exists g1, q, (g0 ++ h1), (g0 ++ g ++ [k]). rewrite E1, <- !app_assoc in *. cbn in *.
              repeat split; eauto using leaves_child.
           ++ destruct Hor as [->|]; [|discriminate].
              destruct (Hf eq_refl) as (g1 & q & h0 & g0 & E & -> & Hq & Hin).
              exists (g2 ++ g1), q, (g0 ++ k :: h), (g0 ++ [k]). rewrite E2, E, <- !app_assoc. cbn.
              repeat split; eauto using leaves_child.
        -- now rewrite Hb2, Hb, (best_below_node sd), closer_assoc.
Qed.

(** [ORACLE-2](2) [ORDER-2, ORDER-3] Pruning by marks loses no closest hit: the search that leaves nodes out, the one that
    does not, and so the machine with the second trail, all end with the closest hit of the tree, even if the
    decisions of the two searches are different ones. *)
Theorem pruning_loses_nothing :
  best (snd (pruned_reference T decide mark never found)) = best (snd (reference decide never T)).
Proof.
  pose proof (pvisit_well_pruned T xH [] eq_refl) as H. unfold well_pruned, pvisit in H. unfold pruned_reference.
  destruct (Disjoint.pvisit _ _ _ _ _ _ _) as [[s b] h]. destruct H as (_ & _ & _ & H).
  cbn [snd]. rewrite H. symmetry. apply (visit_best T xH [] eq_refl).
Qed.

(** ** The visits *)

Inductive subsequence : history -> history -> Prop :=
  | sub_nil : subsequence [] []
  | sub_take k a b : subsequence a b -> subsequence (k :: a) (k :: b)
  | sub_skip k a b : subsequence a b -> subsequence a (k :: b).

Lemma sub_app g : forall a b, subsequence a b -> subsequence a (g ++ b).
Proof. induction g; intros; [assumption|]. apply sub_skip. auto. Qed.

Lemma visit_extends t : forall k h, exists g, snd (visit decide never t k h) = g ++ h.
Proof.
  induction t as [|l IHl r IHr]; intros k h; [now exists [k]|].
  assert (IH : forall sd k h, exists g, snd (visit decide never (subtree sd l r) k h) = g ++ h) by (intros [|]; auto).
  cbn [visit]. destruct (decide (k :: h)) as [|sd|sd]; [now exists [k]| |].
  - destruct (IH sd (child sd k) (k :: h)) as (g & ->). exists (g ++ [k]). now rewrite <- app_assoc.
  - destruct (IH sd (child sd k) (k :: h)) as (g & E). destruct (visit decide never (subtree sd l r) _ _) as [s h1].
    cbn in E. subst h1. destruct s; [exists (g ++ [k]); now rewrite <- app_assoc|].
    destruct (IH (other sd) (child (other sd) k) (g ++ k :: h)) as (g2 & ->).
    exists (g2 ++ g ++ [k]). now rewrite <- !app_assoc.
Qed.

(** Decisions depend on the node and on the best that has been found. *)
Hypothesis by_best : forall k h h', best h = best h' -> decide (k :: h) = decide (k :: h').

Lemma pruned_subsequence t : forall k h h', at_key T k = Some t -> best h' = best h -> subsequence h' h ->
  subsequence (snd (pvisit t k h')) (snd (visit decide never t k h)).
Proof.
  unfold pvisit. induction t as [|l IHl r IHr]; intros k h h' Hk Hb Hs; [cbn; now apply sub_take|].
  assert (IH : forall sd h h', best h' = best h -> subsequence h' h ->
    subsequence (snd (Disjoint.pvisit decide mark never found (subtree sd l r) (child sd k) h'))
      (snd (visit decide never (subtree sd l r) (child sd k) h))).
  { intros sd h1 h1'. pose proof (at_child T sd k l r Hk). destruct sd; [apply IHl|apply IHr]; assumption. }
  clear IHl IHr. cbn [Disjoint.pvisit visit]. rewrite (by_best k h' h Hb).
  assert (Hb1 : best (k :: h') = best (k :: h)) by (rewrite !(best_inner k _ l r Hk); exact Hb).
  assert (Hs1 : subsequence (k :: h') (k :: h)) by now apply sub_take.
  destruct (decide (k :: h)) as [|sd|sd]; [exact Hs1|now apply IH|].
  pose proof (IH sd _ _ Hb1 Hs1) as H1.
  pose proof (pvisit_well_pruned _ _ (k :: h') (at_child T sd k l r Hk)) as W. unfold well_pruned, pvisit in W.
  destruct (visit_best _ _ (k :: h) (at_child T sd k l r Hk)) as [V F].
  destruct (Disjoint.pvisit decide mark never found (subtree sd l r) _ _) as [[s1 b1] h1'].
  destruct (visit decide never (subtree sd l r) _ _) as [s1' h1]. cbn [fst snd] in *. subst s1'.
  destruct W as (-> & _ & _ & W). destruct (mark (k :: h') && b1).
  - cbn [snd]. destruct (visit_extends (subtree (other sd) l r) (child (other sd) k) h1) as (g & ->). now apply sub_app.
  - assert (E : best h1' = best h1) by (rewrite W, V, Hb1; reflexivity).
    pose proof (IH (other sd) _ _ E H1) as H2.
    now destruct (Disjoint.pvisit decide mark never found (subtree (other sd) l r) _ _) as [[s2 b2] h2'].
Qed.

(** [ORACLE-2](3) If decisions depend on the best that has been found and on nothing else of the past, the visits of the
    search that prunes are a subsequence of those of the one that does not. *)
Theorem pruned_visits :
  subsequence (snd (pruned_reference T decide mark never found)) (snd (reference decide never T)).
Proof.
  pose proof (pruned_subsequence T xH [] [] eq_refl eq_refl sub_nil) as H. unfold pvisit in H. unfold pruned_reference.
  now destruct (Disjoint.pvisit _ _ _ _ _ _ _) as [[s b] h].
Qed.

End Closest.

(** * What the promise is worth *)

Module Promise.

(** Two leaves, the left one first and marked. The search says *found* at the left one if its hit is the best. *)
Definition T := Node Leaf Leaf.
Definition decide (h : history) := Both L.
Definition mark (h : history) := true.
Definition offer (left right : nat) (k : positive) :=
  match k with 2%positive => Some left | 3%positive => Some right | _ => None end.
Definition closest left right := best nat Nat.ltb T (offer left right).
Definition found (left right : nat) (h : history) :=
  match h, closest left right h with 2%positive :: _, Some x => x =? left | _, _ => false end.
Definition pruned left right := snd (pruned_reference T decide mark never (found left right)).
Definition whole := snd (reference decide never T).

(** [ORDER-2, ORDER-3] Where the promise is kept, the theorem's condition holds, and a visit is saved. *)
Example kept : found_is_true nat Nat.ltb T (offer 1 2) decide mark (found 1 2) /\
  pruned 1 2 = [2; 1]%positive /\ whole = [3; 2; 1]%positive.
Proof.
  split; [|split; reflexivity]. apply marks_are_promises.
  - intros a h l r sd q1 o1 q2 o2 Ha [= <-] _ H1 E1 H2 E2. pose proof (at_height T a _ Ha) as Hh. cbn in Hh.
    assert (E : a = xH) by (apply depth_zero; lia). subst a. injection Ha as <- <-. cbn in H1, H2.
    destruct H1 as [<-|[]], H2 as [<-|[]]. cbn in E1, E2. injection E1 as <-. injection E2 as <-. reflexivity.
  - intros k h. unfold found. fold (closest 1 2).
    destruct k as [|[| |]|], (closest 1 2 (_ :: h)) as [x|]; intros Hx; try discriminate Hx.
    apply Nat.eqb_eq in Hx. subst x. exists 1. auto.
Qed.

(** [ORDER-2] Where it is broken, the closest hit is lost. *)
Example broken : closest 2 1 (pruned 2 1) = Some 2 /\ closest 2 1 whole = Some 1.
Proof. split; reflexivity. Qed.

End Promise.
