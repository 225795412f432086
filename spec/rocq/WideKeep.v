(** What is kept of an ancestor: the pending set alone [WIDE-13], with a bit [WIDE-18], or with two ranks [WIDE-17].

    A set of slots is a number: bit [s] is set if slot [s] is in it. *)

Require Import List NArith Lia Bool Sorted.
Require Import Wide WideMachine WideLevels.
Import ListNotations.
Open Scope N_scope.

Section Keep.

Variable B : N.

(** The child of this rank is pending. *)
Definition pend (g r : N) : bool := N.testbit g (slot B r).

(** The set of the slots of some ranks. *)
Definition slots_of (rs : list N) : N := fold_right (fun r g => N.setbit g (slot B r)) 0 rs.

(** * The keepers *)

(** [WIDE-10, WIDE-13] The pending set. The node is asked again, always; if the least pending rank is beyond, all are. *)
Definition trail_keeper : keeper := {|
  level := N;
  keep rs e := slots_of rs;
  worn g := g;
  take ans e g :=
    match filter (pend g) ans with
    | [] => None
    | r :: _ => if beyond B e r then None else Some (slot B r, N.clearbit g (slot B r))
    end |}.

(** Exactly one slot is in the set. *)
Definition single (g : N) : bool := g =? 2 ^ N.log2 g.

(** [WIDE-18] The pending set, without what was beyond when the node was asked, and the bit: the end has changed since then. A
    single pending child comes without a question if it has not. [mark] is what the bit becomes when the node is asked again. *)
Definition word_keeper (mark : bool -> bool) : keeper := {|
  level := N * bool;
  keep rs e := (slots_of (live B e rs), false);
  worn '(g, d) := (g, true);
  take ans e '(g, d) :=
    if g =? 0 then None
    else if negb d && single g then Some (N.log2 g, (0, false))
    else match live B e (filter (pend g) ans) with
      | [] => None
      | r :: rs => Some (slot B r, (slots_of rs, mark d))
      end |}.

(** [WIDE-17] The pending set, and the ranks of the two children that come next, 0 where there is none or it is not known. *)
Definition key_keeper : keeper := {|
  level := N * N * N;
  keep rs e := (slots_of rs, nth 0 rs 0, nth 1 rs 0);
  worn l := l;
  take ans e '(g, r1, r2) :=
    if g =? 0 then None
    else if r1 =? 0 then
      match filter (pend g) ans with
      | [] => None
      | r :: rs => if beyond B e r then None else Some (slot B r, (N.clearbit g (slot B r), nth 0 rs 0, nth 1 rs 0))
      end
    else if beyond B e r1 then None
    else Some (slot B r1, (N.clearbit g (slot B r1), r2, 0)) |}.

(** * Sets of slots *)

Lemma slots_spec rs s : N.testbit (slots_of rs) s = existsb (fun r => slot B r =? s) rs.
Proof.
  induction rs as [|r rs IH]; [apply N.bits_0|]. simpl. rewrite N.setbit_eqb, IH. reflexivity.
Qed.

Lemma slot_inj l x y : NoDup (map (slot B) l) -> In x l -> In y l -> slot B x = slot B y -> x = y.
Proof.
  induction l as [|z l IH]; [intros _ []|]. simpl. rewrite NoDup_cons_iff. intros [Hz Hl] [->|Hx] [->|Hy] E; auto.
  - destruct Hz. rewrite E. now apply in_map.
  - destruct Hz. rewrite <- E. now apply in_map.
Qed.

(** The set of some of the ranks has these and no others. *)
Lemma filter_slots f l : NoDup (map (slot B) l) -> filter (pend (slots_of (filter f l))) l = filter f l.
Proof.
  intros Hn. apply filter_ext_in. intros x Hx. unfold pend. rewrite slots_spec. destruct (f x) eqn:Hf.
  - apply existsb_exists. exists x. rewrite N.eqb_refl. split; [now apply filter_In|reflexivity].
  - destruct (existsb _ _) eqn:E; [|reflexivity]. apply existsb_exists in E. destruct E as (y & Hy & E).
    apply N.eqb_eq in E. apply filter_In in Hy. destruct Hy as [Hy Hfy].
    rewrite (slot_inj l y x) in Hfy by assumption. congruence.
Qed.

(** Without the slot of the first, the others are left. *)
Lemma filter_first f l r rs : NoDup (map (slot B) l) -> filter f l = r :: rs ->
  filter (fun x => f x && negb (slot B r =? slot B x)) l = rs.
Proof.
  induction l as [|x l IH]; simpl; [discriminate|]. rewrite NoDup_cons_iff. intros [Hx Hl] H.
  destruct (f x) eqn:Hf; simpl.
  - injection H as -> <-. rewrite N.eqb_refl. simpl. apply filter_ext_in. intros y Hy.
    destruct (N.eqb_spec (slot B r) (slot B y)) as [E|]; [|apply andb_true_r].
    destruct Hx. rewrite E. now apply in_map.
  - now apply IH.
Qed.

Lemma filter_cleared g r l : NoDup (map (slot B) l) -> forall rs, filter (pend g) l = r :: rs ->
  filter (pend (N.clearbit g (slot B r))) l = rs.
Proof.
  intros Hn rs H. rewrite <- (filter_first _ _ _ _ Hn H). apply filter_ext. intros x. unfold pend.
  apply N.clearbit_eqb.
Qed.

Lemma filter_rest r rs : NoDup (map (slot B) (r :: rs)) -> filter (pend (slots_of rs)) (r :: rs) = rs.
Proof.
  intros Hn. assert (E : filter (fun x => true && negb (slot B r =? slot B x)) (r :: rs) = rs).
  { apply (filter_first (fun _ => true)); [exact Hn|]. simpl. f_equal. clear. induction rs; simpl; congruence. }
  rewrite <- E at 1. rewrite filter_slots by exact Hn. exact E.
Qed.

Lemma NoDup_filter f l : NoDup (map (slot B) l) -> NoDup (map (slot B) (filter f l)).
Proof.
  induction l as [|x l IH]; [auto|]. simpl. rewrite NoDup_cons_iff. intros [Hx Hl]. destruct (f x); [|auto].
  simpl. constructor; [|auto]. intros H. apply Hx. apply in_map_iff in H. destruct H as (y & E & Hy).
  apply filter_In in Hy. apply in_map_iff. exists y. tauto.
Qed.

Lemma filter_none {X} (f : X -> bool) l : (forall x, f x = false) -> filter f l = [].
Proof. intros H. induction l as [|x l IH]; [reflexivity|]. simpl. now rewrite H. Qed.

Lemma filter_all {X} (f : X -> bool) l : (forall x, In x l -> f x = true) -> filter f l = l.
Proof.
  intros H. induction l as [|x l IH]; [reflexivity|]. simpl. rewrite (H x (or_introl eq_refl)). f_equal. apply IH.
  intros y Hy. apply H. now right.
Qed.

Lemma pend_none l : filter (pend 0) l = [].
Proof. apply filter_none. intros x. apply N.bits_0. Qed.

(** * They are right *)

Variable T : wide.
Variable S : search.
Hypothesis F : fair B T S.

(** [a] was asked about, and [l] was the answer. *)
Definition answered (a : path) (h : history) (l : list N) : Prop := exists g h0, h = g ++ a :: h0 /\ l = ask S a (a :: h0).

(** What is pending of an answer. *)
Definition left_of (e g : N) (l : list N) : list N := live B e (filter (pend g) l).

Lemma answered_first a h : answered a (a :: h) (ask S a (a :: h)).
Proof. exists [], h. auto. Qed.

Lemma answered_seen a h l k : answered a h l -> answered a (k :: h) l.
Proof. intros (g & h0 & -> & ->). exists (k :: g), h0. auto. Qed.

Lemma answered_slots a h l : answered a h l -> NoDup (map (slot B) l).
Proof. intros (g & h0 & _ & ->). apply (f_slots _ _ _ F). Qed.

(** Asked again, as much is left. *)
Lemma left_again a h l g : answered a h l -> left_of (edge S h) g (ask S a h) = left_of (edge S h) g l.
Proof.
  intros (g' & h0 & -> & ->). unfold left_of, live. rewrite !(filter_comm _ (pend g)). f_equal.
  apply (f_again _ _ _ F).
Qed.

Lemma left_cleared e g l r rs : NoDup (map (slot B) l) -> left_of e g l = r :: rs ->
  left_of e (N.clearbit g (slot B r)) l = rs.
Proof.
  unfold left_of, live. rewrite !(filter_comm _ (pend _)). intros Hn H. apply filter_cleared; [|exact H]. now apply NoDup_filter.
Qed.

Lemma left_mono a h l g rs k : answered a h l -> live B (edge S h) rs = left_of (edge S h) g l ->
  live B (edge S (k :: h)) rs = left_of (edge S (k :: h)) g l.
Proof. intros _. apply live_mono. apply (f_edge _ _ _ F). Qed.

Lemma sorted_again a h g : StronglySorted N.lt (filter (pend g) (ask S a h)).
Proof. apply sorted_filter, (f_sorted _ _ _ F). Qed.

(** ** The pending set *)

Definition trail_holds (a : path) (h : history) (g : N) (rs : list N) : Prop :=
  exists l, answered a h l /\ live B (edge S h) rs = left_of (edge S h) g l.

Lemma trail_first a h r rs : ask S a (a :: h) = r :: rs -> trail_holds a (a :: h) (slots_of rs) rs.
Proof.
  intros Ha. exists (ask S a (a :: h)). split; [apply answered_first|]. unfold left_of. rewrite Ha, filter_rest; [reflexivity|].
  rewrite <- Ha. apply (f_slots _ _ _ F).
Qed.

(** [WIDE-13] At each level the child that comes next is the least that is not beyond; none comes if and only if all
    are beyond. *)
Lemma trail_keeps : keeps B trail_keeper T S trail_holds.
Proof.
  split; simpl.
  - intros a h r rs child _ Ha _. eapply trail_first; eauto.
  - intros a h g rs k (l & Hl & H). assert (E : (if edge S (k :: h) =? edge S h then g else g) = g) by
      now destruct (edge S (k :: h) =? edge S h).
    rewrite E. exists l. split; [now apply answered_seen|]. eapply left_mono; eauto.
  - intros a h g rs (l & Hl & H). rewrite H. pose proof (left_again _ _ _ g Hl) as E.
    pose proof (sorted_again a h g) as Hs. unfold left_of in E at 1.
    destruct (filter (pend g) (ask S a h)) as [|r ra]; [rewrite <- E; reflexivity|].
    destruct (beyond B (edge S h) r) eqn:Hb; [rewrite (live_none _ _ _ _ Hs Hb) in E; rewrite <- E; reflexivity|].
    rewrite (live_cons _ _ _ _ Hb) in E. rewrite <- E. eexists. exists (live B (edge S h) ra). split; [reflexivity|].
    assert (D : live B (edge S h) (live B (edge S h) ra) = live B (edge S h) ra) by now apply filter_filter.
    split; [|exact D]. exists l. split; [exact Hl|]. rewrite D. symmetry. apply left_cleared; [|congruence].
    eapply answered_slots; eauto.
Qed.

(** [WIDE-13, WIDE-7] A node, and the pending set of each ancestor, with questions asked again, have the reference's
    visits and answer. *)
Theorem wide_trail_reference fuel : (length (snd (reference B S T)) <= fuel)%nat ->
  run B (level_machine B trail_keeper) T S fuel (start (level_machine B trail_keeper)) [] = Some (reference B S T).
Proof. exact (levels_reference B trail_keeper T S trail_holds F trail_keeps fuel). Qed.

(** ** The pending set and a bit *)

Section Word.

Variable mark : bool -> bool.

(** As long as the bit is not set, what is pending is all that is left. *)
Definition word_holds (a : path) (h : history) (w : N * bool) (rs : list N) : Prop :=
  exists l, answered a h l /\ live B (edge S h) rs = left_of (edge S h) (fst w) l /\
    exists rs', fst w = slots_of rs' /\ (snd w = false -> live B (edge S h) rs = rs').

Lemma live_live e rs : live B e (live B e rs) = live B e rs.
Proof. now apply filter_filter. Qed.

(** A set with one slot is the set of one rank. *)
Lemma single_slot rs : NoDup (map (slot B) rs) -> single (slots_of rs) = true ->
  exists r, rs = [r] /\ N.log2 (slots_of rs) = slot B r.
Proof.
  unfold single. rewrite N.eqb_eq. intros Hn E. set (s := N.log2 (slots_of rs)) in *.
  assert (H : forall r, In r rs -> slot B r = s).
  { intros r Hr. assert (G : N.testbit (slots_of rs) (slot B r) = true).
    { rewrite slots_spec. apply existsb_exists. exists r. split; [exact Hr|apply N.eqb_refl]. }
    rewrite E, N.pow2_bits_eqb in G. apply N.eqb_eq in G. auto. }
  destruct rs as [|r [|r' rs]].
  - discriminate E.
  - exists r. rewrite (H r (or_introl eq_refl)). auto.
  - simpl in Hn. apply NoDup_cons_iff in Hn. destruct Hn as [Hn _]. destruct Hn. left.
    rewrite (H r), (H r'); simpl; auto.
Qed.

(** [WIDE-18, WIDE-19] At each level the child that comes next is the least that is not beyond; none comes if and only if
    all are beyond. *)
Lemma word_keeps : keeps B (word_keeper mark) T S word_holds.
Proof.
  split; simpl.
  - intros a h r rs child _ Ha Hb. pose proof (f_slots _ _ _ F a (a :: h)) as Hn. rewrite Ha in Hn.
    exists (ask S a (a :: h)). split; [apply answered_first|]. rewrite Ha. simpl. split.
    + unfold left_of, live. rewrite filter_comm. simpl. rewrite Hb. simpl negb. cbv iota. fold (live B (edge S (a :: h)) rs).
      symmetry. apply filter_rest. apply (NoDup_filter (fun x => negb (beyond B (edge S (a :: h)) x))) in Hn.
      simpl in Hn. rewrite Hb in Hn. exact Hn.
    + eexists. split; [reflexivity|]. auto.
  - intros a h [g d] rs k (l & Hl & H & rs' & Hg & Hd). simpl in *. exists l. split; [now apply answered_seen|].
    pose proof (left_mono _ _ _ _ _ k Hl H) as Hm. destruct (N.eqb_spec (edge S (k :: h)) (edge S h)) as [E|_]; simpl.
    + split; [exact Hm|]. exists rs'. rewrite E. auto.
    + split; [exact Hm|]. exists rs'. split; [exact Hg|discriminate].
  - intros a h [g d] rs (l & Hl & H & rs' & Hg & Hd). simpl in *.
    pose proof (answered_slots _ _ _ Hl) as Hn.
    destruct (N.eqb_spec g 0) as [->|H0]; [unfold left_of in H; rewrite pend_none in H; simpl in H; now rewrite H|].
    destruct (negb d && single g) eqn:Hs.
    + apply andb_prop in Hs. destruct Hs as [Hs1 Hs]. destruct d; [discriminate|]. rewrite (Hd eq_refl) in *.
      assert (Hn' : NoDup (map (slot B) rs')).
      { rewrite H. unfold left_of, live. now apply NoDup_filter, NoDup_filter. }
      rewrite Hg in Hs. destruct (single_slot rs' Hn' Hs) as (r & -> & Hr). rewrite Hg, Hr.
      exists (0, false), []. split; [reflexivity|]. split; [|reflexivity]. exists l. split; [exact Hl|]. simpl. split.
      * unfold left_of. now rewrite pend_none.
      * exists []. auto.
    + pose proof (left_again _ _ _ g Hl) as E. unfold left_of in E at 1. rewrite E, H.
      destruct (left_of (edge S h) g l) as [|r ra] eqn:El; [reflexivity|].
      exists (slots_of ra, mark d), ra. split; [reflexivity|].
      assert (Hra : live B (edge S h) ra = ra).
      { apply filter_all. intros x Hx. apply (in_cons r) in Hx. rewrite <- El in Hx. now apply filter_In in Hx. }
      split; [|exact Hra]. exists l. split; [exact Hl|]. simpl. rewrite Hra. split.
      * (* Of the answer, the set of the others has the others. *)
        unfold left_of, live in *. rewrite filter_comm in *. set (l' := filter (fun r => negb (beyond B (edge S h) r)) l) in *.
        assert (Hn' : NoDup (map (slot B) l')) by now apply NoDup_filter.
        rewrite <- (filter_first _ _ _ _ Hn' El) at 2. rewrite filter_slots by exact Hn'.
        symmetry. now apply filter_first.
      * exists ra. auto.
Qed.

(** [WIDE-18, WIDE-7] With the bit, and without a question where one child is pending and the end is what it was, the
    machine has the reference's visits and answer. *)
Theorem wide_word_reference fuel : (length (snd (reference B S T)) <= fuel)%nat ->
  run B (level_machine B (word_keeper mark)) T S fuel (start (level_machine B (word_keeper mark))) [] = Some (reference B S T).
Proof. exact (levels_reference B (word_keeper mark) T S word_holds F word_keeps fuel). Qed.

End Word.

(** ** The pending set and two ranks *)

(** The ranks that are kept are the first. *)
Definition known (r1 r2 : N) (rs : list N) : Prop :=
  r1 = 0 \/ exists x, rs = r1 :: x /\ (r2 = 0 \/ exists y, x = r2 :: y).

Lemma known_nth rs : known (nth 0 rs 0) (nth 1 rs 0) rs.
Proof.
  destruct rs as [|r1 [|r2 y]]; simpl; [now left|right; exists []; auto|]. right. exists (r2 :: y). split; [reflexivity|].
  right. now exists y.
Qed.

Definition key_holds (a : path) (h : history) (w : N * N * N) (rs : list N) : Prop :=
  let '(g, r1, r2) := w in
  exists l rs', answered a h l /\ live B (edge S h) rs = left_of (edge S h) g l /\
    StronglySorted N.lt rs' /\ live B (edge S h) rs' = live B (edge S h) rs /\ known r1 r2 rs'.

(** [WIDE-17, WIDE-19] At each level the child that comes next is the least that is not beyond; none comes if and only if
    all are beyond. *)
Lemma key_keeps : keeps B key_keeper T S key_holds.
Proof.
  split; simpl.
  - intros a h r rs child _ Ha Hb. destruct (trail_first _ _ _ _ Ha) as (l & Hl & H). exists l, rs.
    pose proof (f_sorted _ _ _ F a (a :: h)) as Hs. rewrite Ha in Hs. apply StronglySorted_inv in Hs.
    repeat split; try tauto. apply known_nth.
  - intros a h [[g r1] r2] rs k (l & rs' & Hl & H & Hs & Hr & Hk).
    assert (E : (if edge S (k :: h) =? edge S h then (g, r1, r2) else (g, r1, r2)) = (g, r1, r2)) by
      now destruct (edge S (k :: h) =? edge S h).
    rewrite E. exists l, rs'. split; [now apply answered_seen|]. split; [eapply left_mono; eauto|].
    split; [exact Hs|]. split; [|exact Hk]. eapply live_mono; [apply (f_edge _ _ _ F)|exact Hr].
  - intros a h [[g r1] r2] rs (l & rs' & Hl & H & Hs & Hr & Hk). pose proof (answered_slots _ _ _ Hl) as Hn.
    destruct (N.eqb_spec g 0) as [->|H0]; [unfold left_of in H; rewrite pend_none in H; simpl in H; now rewrite H|].
    destruct (N.eqb_spec r1 0) as [->|H1].
    + rewrite H. pose proof (left_again _ _ _ g Hl) as E. pose proof (sorted_again a h g) as Hs'. unfold left_of in E at 1.
      destruct (filter (pend g) (ask S a h)) as [|r ra]; [rewrite <- E; reflexivity|].
      destruct (beyond B (edge S h) r) eqn:Hb; [rewrite (live_none _ _ _ _ Hs' Hb) in E; rewrite <- E; reflexivity|].
      rewrite (live_cons _ _ _ _ Hb) in E. rewrite <- E. eexists. exists (live B (edge S h) ra). split; [reflexivity|].
      split; [|apply live_live]. exists l, ra. split; [exact Hl|]. rewrite live_live. split; [|split; [|split]].
      * symmetry. apply left_cleared; congruence.
      * now apply StronglySorted_inv in Hs'.
      * reflexivity.
      * apply known_nth.
    + destruct Hk as [Hk|(x & -> & Hk)]; [contradiction|]. rewrite <- Hr. destruct (beyond B (edge S h) r1) eqn:Hb.
      * now rewrite (live_none _ _ _ _ Hs Hb).
      * rewrite (live_cons _ _ _ _ Hb) in *. eexists. exists (live B (edge S h) x). split; [reflexivity|].
        split; [|apply live_live]. exists l, x. split; [exact Hl|]. rewrite live_live. split; [|split; [|split]].
        -- symmetry. apply left_cleared; congruence.
        -- now apply StronglySorted_inv in Hs.
        -- reflexivity.
        -- destruct Hk as [->|(y & ->)]; [now left|]. right. exists y. auto.
Qed.

(** [WIDE-17, WIDE-7] With the ranks of the next two children, and a level dropped where the kept rank is beyond, the
    machine has the reference's visits and answer. *)
Theorem wide_key_reference fuel : (length (snd (reference B S T)) <= fuel)%nat ->
  run B (level_machine B key_keeper) T S fuel (start (level_machine B key_keeper)) [] = Some (reference B S T).
Proof. exact (levels_reference B key_keeper T S key_holds F key_keeps fuel). Qed.

End Keep.
