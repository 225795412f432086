(** What is pending, and when: the meaning of the trail of a wide tree, [WIDE-10] and [WIDE-11]. *)

Require Import List NArith Lia Bool Sorted.
Require Import Wide WideMachine WideLevels WideKeep.
Import ListNotations.
Open Scope N_scope.

Section Meaning.

Variable B : N.
Variable T : wide.
Variable S : search.
Hypothesis F : fair B T S.

Definition trail_machine := level_machine B (trail_keeper B).

(** Of the node [a] the traversal is at the child in slot [s], or below it, and [g] is pending. Let [r] be the rank of that child.
    What comes before it had its turn, what comes after it had not; only this is pending, and all of it, unless it is beyond. *)
Definition level_means (h : history) (a : path) (s g : N) : Prop := exists child h' h0 r,
  at_path T a = Some (Inner child) /\ h = h' ++ a :: h0 /\
  let l := ask S a (a :: h0) in
  In r l /\ slot B r = s /\
  (forall x, In x l -> x < r -> In (slot B x :: a) h \/ beyond B (edge S h) x = true) /\
  (forall x, In x l -> r < x -> ~ In (slot B x :: a) h) /\
  (forall x, In x l -> x <= r -> N.testbit g (slot B x) = false) /\
  (forall x, In x l -> r < x -> N.testbit g (slot B x) = true \/ beyond B (edge S h) x = true) /\
  (forall i, N.testbit g i = true -> exists x, In x l /\ slot B x = i).

(** So at each level. *)
Fixpoint means (h : history) (k : path) (ls : list N) : Prop :=
  match k, ls with
  | [], [] => True
  | s :: a, g :: ls => level_means h a s g /\ means h a ls
  | _, _ => False
  end.

(** Parents are visited first. *)
Definition closed (h : history) : Prop := forall s a, In (s :: a) h -> In a h.

Lemma means_answered h k : forall ls s a, means h k ls -> k = s :: a -> In a h.
Proof.
  intros [|g ls] s a H ->; [destruct H|]. destruct H as [(child & h' & h0 & r & _ & -> & _) _].
  apply in_or_app. right. now left.
Qed.

Lemma not_longer {X} (q : list X) k : (length q < length k)%nat -> q <> k.
Proof. intros H ->. lia. Qed.

(** After the visit of [k] it means the same, for [k] is the child at its level. *)
Lemma level_seen h k a s g : (length (s :: a) <= length k)%nat -> (length (s :: a) = length k -> s :: a = k) ->
  level_means h a s g -> level_means (k :: h) a s g.
Proof.
  intros Hlen Hk (child & h' & h0 & r & Ha & Hh & Hr & Hs & H1 & H2 & H3 & H4 & H5).
  exists child, (k :: h'), h0, r. split; [exact Ha|]. split; [now rewrite Hh|]. cbv zeta.
  assert (Hb : forall x, beyond B (edge S h) x = true -> beyond B (edge S (k :: h)) x = true).
  { intros x. apply beyond_mono. apply (f_edge _ _ _ F). }
  split; [exact Hr|]. split; [exact Hs|]. split; [|split; [|split; [|split]]].
  - intros x Hx Hl. destruct (H1 x Hx Hl); [left; now right|right; auto].
  - intros x Hx Hl [E|Hin]; [|eapply H2; eauto]. subst k.
    assert (E : s :: a = slot B x :: a) by (apply Hk; reflexivity). injection E as E. rewrite E in Hs.
    rewrite (slot_inj B (ask S a (a :: h0)) r x) in Hl; [lia|apply (f_slots _ _ _ F)|assumption..].
  - exact H3.
  - intros x Hx Hl. destruct (H4 x Hx Hl); auto.
  - exact H5.
Qed.

Lemma means_seen h k : forall b a ls, k = b ++ a -> means h a ls -> means (k :: h) a ls.
Proof.
  intros b a. revert b. induction a as [|s a IH]; intros b [|g ls] Hk; simpl; try contradiction; [auto|].
  intros [H1 H2]. split.
  - apply level_seen; [| |exact H1]; rewrite Hk, app_length; simpl; [lia|]. intros E.
    destruct b as [|y b]; [reflexivity|simpl in E; lia].
  - apply (IH (b ++ [s])); [now rewrite <- app_assoc|exact H2].
Qed.

(** The way back keeps it. *)
Lemma means_back h : closed h -> forall k ls k' ls', In k h -> means h k ls ->
  back_levels (trail_keeper B) (now S h) (edge S h) k ls = Some (k', ls') -> means h k' ls' /\ ~ In k' h /\ exists s a, k' = s :: a.
Proof.
  intros Hc. induction k as [|s a IH]; intros [|g ls] k' ls' Hk; try discriminate. cbn [back_levels].
  intros [(child & h' & h0 & r & Ha & Hh & Hr & Hs & H1 & H2 & H3 & H4 & H5) Hm].
  destruct (take (trail_keeper B) (now S h a) (edge S h) g) as [[s1 g1]|] eqn:Ht; [|apply IH; [eauto|exact Hm]].
  intros [= <- <-]. simpl in Ht. unfold now in Ht. pose proof (sorted_again B T S F a h g) as Hsort.
  destruct (filter (pend B g) (ask S a h)) as [|x rs] eqn:Ef; [discriminate|].
  destruct (beyond B (edge S h) x) eqn:Hb; [discriminate|]. injection Ht as <- <-.
  set (l := ask S a (a :: h0)) in *.
  assert (Hlive : live B (edge S h) (ask S a h) = live B (edge S h) l) by (rewrite Hh; apply (f_again _ _ _ F)).
  assert (Hx : In x (filter (pend B g) (ask S a h))) by (rewrite Ef; now left).
  apply filter_In in Hx. destruct Hx as [Hx Hp].
  assert (Hxl : In x l).
  { assert (In x (live B (edge S h) l)) by (rewrite <- Hlive; apply filter_In; now rewrite Hb). now apply filter_In in H. }
  assert (Hrx : r < x).
  { apply N.nle_gt. intros Hle. apply (H3 x Hxl) in Hle. unfold pend in Hp. congruence. }
  assert (Hn : NoDup (map (slot B) l)) by apply (f_slots _ _ _ F).
  (* Nothing is between the two. *)
  assert (Hbetween : forall y, In y l -> y < x -> y <= r).
  { intros y Hy Hyx. apply N.nlt_ge. intros Hry. destruct (beyond B (edge S h) y) eqn:Hyb.
    - rewrite (beyond_le B (edge S h) y x) in Hb; [discriminate|lia|exact Hyb].
    - assert (Hy' : In y (ask S a h)).
      { assert (In y (live B (edge S h) (ask S a h))) by (rewrite Hlive; apply filter_In; now rewrite Hyb).
        now apply filter_In in H. }
      assert (Hyf : In y (x :: rs)).
      { rewrite <- Ef. apply filter_In. split; [exact Hy'|]. unfold pend. destruct (H4 y Hy Hry); congruence. }
      apply StronglySorted_inv in Hsort. destruct Hsort as [_ Hf]. rewrite Forall_forall in Hf.
      destruct Hyf as [->|Hyf]; [lia|]. apply Hf in Hyf. lia. }
  split; [split|].
  - exists child, h', h0, x. split; [exact Ha|]. split; [exact Hh|]. cbv zeta. fold l.
    split; [exact Hxl|]. split; [reflexivity|]. split; [|split; [|split; [|split]]].
    + intros y Hy Hyx. pose proof (Hbetween y Hy Hyx) as Hle. destruct (N.eq_dec y r) as [->|Hne].
      * left. rewrite Hs. exact Hk.
      * apply H1; [exact Hy|lia].
    + intros y Hy Hxy. apply H2; [exact Hy|lia].
    + intros y Hy Hle. rewrite N.clearbit_eqb. destruct (N.eq_dec y x) as [->|Hne].
      * rewrite N.eqb_refl. apply andb_false_r.
      * rewrite H3; [reflexivity|exact Hy|]. apply Hbetween; [exact Hy|lia].
    + intros y Hy Hxy. rewrite N.clearbit_eqb. destruct (H4 y Hy) as [Hg|Hbe]; [lia| |now right]. left. rewrite Hg. simpl.
      destruct (N.eqb_spec (slot B x) (slot B y)) as [E|]; [|reflexivity].
      rewrite (slot_inj B l x y Hn Hxl Hy E) in Hxy. lia.
    + intros i Hi. rewrite N.clearbit_eqb in Hi. apply andb_prop in Hi. apply H5, Hi.
  - exact Hm.
  - split; [apply H2; assumption|eauto].
Qed.

Definition meant (s : path * list N) (h : history) : Prop := means h (fst s) (snd s) /\ ~ In (fst s) h /\ closed h /\ NoDup h.

Lemma reached_meant s h : reached B trail_machine T S s h -> meant s h.
Proof.
  induction 1 as [|[k ls] h s' h' _ (Hm & Hk & Hc & Hn) Hs].
  { split; [exact I|]. split; [intros []|]. split; [intros s a []|constructor]. }
  simpl in Hm, Hk. unfold step in Hs. cbv zeta in Hs. change (path_of trail_machine (k, ls)) with k in Hs.
  assert (E : seen trail_machine S k h (k, ls) = (k, ls)).
  { unfold seen. simpl. destruct (edge S (k :: h) =? edge S h); [reflexivity|]. f_equal. apply map_id. }
  rewrite E in Hs. clear E.
  assert (Hm1 : means (k :: h) k ls) by (now apply (means_seen h k [])).
  assert (Hn1 : NoDup (k :: h)) by now constructor.
  assert (Hc1 : closed (k :: h)).
  { intros s a [->|Hin]; [right; eapply means_answered; eauto|right; eapply Hc; eauto]. }
  assert (Hback : go_back trail_machine S (k, ls) (k :: h) = Going trail_machine s' h' -> meant s' h').
  { unfold go_back. destruct (back trail_machine (now S (k :: h)) (edge S (k :: h)) (k, ls)) as [[k1 ls1]|] eqn:Hb; [|discriminate].
    intros [= <- <-]. simpl in Hb. destruct (means_back (k :: h) Hc1 k ls k1 ls1) as (M1 & M2 & _); [now left|assumption..|].
    split; [exact M1|]. auto. }
  destruct (at_path T k) as [[|child]|] eqn:Ht; [|destruct (ask S k (k :: h)) as [|r rs] eqn:Ha|discriminate].
  - destruct (stop S (k :: h)); [discriminate|auto].
  - auto.
  - destruct (beyond B (edge S (k :: h)) r) eqn:Hb; [auto|]. injection Hs as <- <-.
    assert (Hnew : forall x, ~ In (x :: k) (k :: h)).
    { intros x [E|Hin]; [apply (f_equal (@length N)) in E; simpl in E; lia|]. apply Hk. eapply Hc; eauto. }
    split; [|split; [apply Hnew|auto]]. simpl. split; [|exact Hm1].
    pose proof (f_slots _ _ _ F k (k :: h)) as Hd. pose proof (f_sorted _ _ _ F k (k :: h)) as Hso.
    rewrite Ha in Hd, Hso. apply StronglySorted_inv in Hso. destruct Hso as [_ Hf]. rewrite Forall_forall in Hf.
    exists child, [], h, r. split; [exact Ht|]. split; [reflexivity|]. cbv zeta. rewrite Ha.
    split; [now left|]. split; [reflexivity|]. split; [|split; [|split; [|split]]].
    + intros x [->|Hx] Hl; [lia|]. apply Hf in Hx. lia.
    + intros x _ _. apply Hnew.
    + intros x [<-|Hx] Hl; [|apply Hf in Hx; lia]. rewrite slots_spec.
      destruct (existsb _ rs) eqn:E; [|reflexivity]. apply existsb_exists in E. destruct E as (y & Hy & E).
      apply N.eqb_eq in E. assert (D : y = r) by (apply (slot_inj B (r :: rs)); simpl; auto). subst y. apply Hf in Hy. lia.
    + intros x [->|Hx] Hl; [lia|]. left. rewrite slots_spec. apply existsb_exists. exists x. rewrite N.eqb_refl. auto.
    + intros i Hi. rewrite slots_spec in Hi. apply existsb_exists in Hi. destruct Hi as (x & Hx & E).
      apply N.eqb_eq in E. exists x. split; [now right|exact E].
Qed.

(** [WIDE-10] [WIDE-11](3) At each visit, at each level: the pending set holds the slots of the wanted children that come after the
    one on the path, all but some that are beyond, and no others; these are not visited; those before are visited or beyond.
    So each wanted child is pending once, from the visit of its first sibling until its own visit, or until it is skipped. *)
Theorem pending_meaning k ls h : reached B trail_machine T S (k, ls) h -> means h k ls.
Proof. intros H. apply (reached_meant _ _ H). Qed.

(** [WIDE-5] No node is visited twice. *)
Theorem wide_visited_once k ls h : reached B trail_machine T S (k, ls) h -> NoDup (k :: h).
Proof. intros H. apply reached_meant in H. destruct H as (_ & Hk & _ & Hn). now constructor. Qed.

End Meaning.
