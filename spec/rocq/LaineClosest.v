(** The restart trail where decisions become narrower while the search goes on (spec/DEPARTURES.md, D-16): a search for
    the closest hit finds it. *)

Require Import Arith List PArith NArith Lia Bool.
Require Import Tree Machine Bits Meaning Implicit Words Register HashedKeys Resume Closest LaineMachine LaineEnds LaineWays.
Import ListNotations.

Section Closest.

Variables W K : nat.
Variable T : tree.
Hypothesis carries : height T < W.

Variable hit : Type.
Variable before : hit -> hit -> bool.
Hypothesis before_irreflexive : forall x, before x x = false.
Hypothesis before_transitive : forall x y z, before x y = true -> before y z = true -> before x z = true.
Hypothesis before_total : forall x y, before x y = false -> before y x = false -> x = y.
Variable offer : positive -> option hit.

Let best := best hit before T offer.
Let best_below := best_below hit before offer.
Let nothing_better := nothing_better hit before offer.

(** What the search answers, by all that it has been asked so far, also on the way down again. *)
Variable decide : history -> descent.
(** It drops a child only if nothing below it is better than the best so far. *)
Hypothesis search_culls : culls hit before T offer decide.

(** [LAINE-1] What a node may answer when it is asked again: what it answered before, or narrower. Its second child may
    be dropped, or both; the first alone only after the second has been visited. *)
Definition narrower (k : positive) (h : history) (old new : descent) : Prop :=
  new = old \/ new = Neither \/
  exists sd, old = Both sd /\ (new = Only sd \/ new = Only (other sd) /\ In (child (other sd) k) h).

Hypothesis narrows : forall k h old, answer decide k h = Some old -> narrower k h old (decide (k :: h)).

Notation place := (place W).
Notation bit := (bit W).

(** What LaineWays.v has, for this search. *)
Notation safe := (LaineWays.safe T hit before offer).
Notation spine := (LaineWays.spine W T hit before offer decide).
Notation ahead := (LaineWays.ahead W T hit before offer decide).
Notation spine_root := (LaineWays.spine_root W T hit before offer decide).
Notation spine_safe := (LaineWays.spine_safe W T hit before offer decide).
Notation spine_first := (LaineWays.spine_first W T hit before offer decide).
Notation spine_second := (LaineWays.spine_second W T hit before offer decide).
Notation spine_only := (LaineWays.spine_only W T hit before offer decide).
Notation ahead_safe := (LaineWays.ahead_safe W T hit before offer decide).
Notation ahead_here := (LaineWays.ahead_here W T hit before offer decide).
Notation ahead_first := (LaineWays.ahead_first W T hit before offer decide).
Notation ahead_second := (LaineWays.ahead_second W T hit before offer decide).
Notation ahead_only := (LaineWays.ahead_only W T hit before offer decide).
Notation safe_seen := (LaineWays.safe_seen T hit before before_transitive offer).
Notation safe_node := (LaineWays.safe_node T hit before offer).
Notation safe_child := (LaineWays.safe_child T hit before offer).
Notation safe_leaf := (LaineWays.safe_leaf T hit before before_irreflexive offer).
Notation answer_seen := (LaineWays.answer_seen decide).
Notation within_one := (LaineWays.within_one W T carries).
Notation spine_seen := (LaineWays.spine_seen W T carries hit before before_transitive offer decide).
Notation ahead_seen := (LaineWays.ahead_seen W T carries hit before before_transitive offer decide).
Notation spine_same := (LaineWays.spine_same W T carries hit before offer decide).
Notation ahead_same := (LaineWays.ahead_same W T carries hit before offer decide).
Notation ahead_root := (LaineWays.ahead_root W T carries hit before offer decide).

(** * The invariant *)

(** At a node that is new, or that is passed again. *)
Definition stage (s : laine_state) (h : history) : Prop :=
  let '(Laine k trail _ pop _) := s in
  ((safe h k \/ unseen h k) /\ (forall i, i < place k -> N.testbit trail (N.of_nat i) = false) /\
    (pop = 0%N \/ exists p, pop = pow p /\ place k <= p)) \/
  exists p, pop = pow p /\ p < place k /\ N.testbit trail (N.of_nat p) = true /\
    (forall i, i < p -> N.testbit trail (N.of_nat i) = false) /\ ahead trail p h k.

Definition good (s : laine_state) (h : history) : Prop :=
  shape W T s /\ spine (l_trail s) h (l_node s) /\ stage s h.

Lemma good_start : good (laine_start W) [].
Proof.
  split; [apply shape_start|]. split; [constructor|]. left. split; [right; intros x []|]. split; [|auto].
  intros i _. apply N.bits_0.
Qed.

(** ** Up *)

Lemma rises_safe trail h k c : rises W trail k c -> (exists u, at_key T k = Some u) -> spine trail h k -> safe h k ->
  spine trail h c /\ safe h c.
Proof.
  induction 1 as [k|sd a c Hb H IH]; [auto|]. intros (u & Hu) Hspine Hsafe.
  destruct (at_parent T sd a u Hu) as (l & r & Ha & _).
  assert (Hup : spine trail h a /\ safe h a).
  { inversion Hspine as [E|sd' a' H1 H2 E|sd' a' H1 H2 H3 H4 E|sd' a' H1 H2 H3 H4 E|sd' a' H1 H2 H3 H4 E];
      [destruct sd; discriminate|apply child_injective in E; destruct E as [E1 E2]; subst..].
    - auto.
    - congruence.
    - split; [exact H1|]. apply (safe_node h a l r sd'); auto.
    - split; [exact H1|]. apply (safe_node h a l r sd); auto. }
  destruct Hup. apply IH; eauto.
Qed.

Lemma good_backtrack s h : shape W T s -> spine (l_trail s) h (l_node s) -> safe h (l_node s) ->
  match laine_backtrack W s with None => safe h xH | Some s' => good s' h end.
Proof.
  intros Hshape Hspine Hsafe. pose proof (shape_backtrack W T carries s) as Hback.
  destruct (laine_backtrack W s) as [s'|] eqn:E.
  - destruct (Hback s' Hshape eq_refl) as (Hshape' & _). rewrite (backtrack_is W T carries s Hshape) in E.
    destruct s as [k trail level pop short]. cbn [l_node l_trail l_short] in *.
    destruct Hshape as ((u & Hu) & _ & Ht & Hwait). cbn [l_node l_trail l_short] in *.
    destruct (N.eqb_spec (next_trail W trail k) (pow (W - 1))) as [|Hend]; [discriminate|].
    destruct (rises_end W trail k) as [Hr|(sd & a & Hr & Hb)].
    + exfalso. apply Hend. destruct (rises_next W T carries _ _ _ Hr u Hu) as (-> & _). now apply (next_trail_root W).
    + destruct (rises_next W T carries _ _ _ Hr u Hu) as (En & _ & (u' & Hc)).
      destruct (rises_safe _ _ _ _ Hr (ex_intro _ u Hu) Hspine Hsafe) as (Hsc & Hsafec).
      pose proof (deep W T carries _ _ Hc) as Hdc. rewrite depth_child in Hdc.
      destruct (at_parent _ _ _ _ Hc) as (l & r & Ha & _).
      destruct (carry_ends_at W trail sd a Ht Hdc Hb) as (Hz & Hbq & Hsame & Hlt & _). rewrite <- En in *.
      set (n := next_trail W trail k) in *. set (q := child (other sd) a) in *.
      assert (Hpl : place a = S (place q)) by now apply place_child.
      assert (Hzero : forall i, i < place q -> N.testbit n (N.of_nat i) = false).
      { intros i Hi. apply ctz_lowest; [|lia]. intros E0. rewrite E0 in Hbq. unfold LaineEnds.bit in Hbq.
        rewrite N.bits_0 in Hbq. discriminate. }
      assert (Hafter : spine n h a /\ (safe h a \/ answer decide a h = Some (Both sd) /\ unseen h q)).
      { assert (Hsame' : forall b, spine trail h b -> b = a -> spine n h b).
        { intros b Hsb ->. apply (spine_same trail); [lia| |exact Hsb]. rewrite Hpl. intros i Hi. symmetry. now apply Hsame. }
        inversion Hsc as [E0|sd' a' H1 H2 E0|sd' a' H1 H2 H3 H4 E0|sd' a' H1 H2 H3 H4 E0|sd' a' H1 H2 H3 H4 E0];
          [destruct sd; discriminate|apply child_injective in E0; destruct E0 as [E1 E2]; subst..].
        - split; [now apply Hsame'|auto].
        - split; [now apply Hsame'|auto].
        - congruence.
        - congruence. }
      destruct Hafter as (Hsa & Hor).
      destruct short as [|q0 short].
      * injection E as <-. split; [exact Hshape'|]. split; [constructor|]. right. exists (place q). rewrite Hz.
        split; [reflexivity|]. split; [unfold LaineMachine.place, q; rewrite depth_child; cbn; lia|].
        split; [exact Hbq|]. split; [exact Hzero|]. apply (ahead_root _ _ _ a Hsa); [lia|].
        destruct Hor as [Hor|(Hans & Hun)]; [now apply ahead_safe|].
        apply (ahead_second _ _ _ sd); auto. apply ahead_here; auto.
      * destruct (rises_next W T carries _ _ _ Hr u Hu) as (_ & Ew & _). rewrite Ew, waiting_child, Hb in Hwait.
        destruct Hwait as (rest & Hwait). injection Hwait as <- _. fold q in E. injection E as <-. fold q in Hshape'.
        split; [exact Hshape'|]. cbn [l_trail l_node]. split.
        -- destruct Hor as [Hor|(Hans & Hun)]; [now apply spine_safe|now apply spine_second].
        -- left. rewrite Hz. split; [destruct Hor as [Hor|(Hans & Hun)]; [left; now apply safe_child|auto]|].
           split; [exact Hzero|]. right. now exists (place q).
  - rewrite (backtrack_is W T carries s Hshape) in E.
    destruct s as [k trail level pop short]. cbn [l_node l_trail l_short] in *.
    destruct Hshape as ((u & Hu) & _ & Ht & _). cbn [l_node l_trail] in *.
    destruct (N.eqb_spec (next_trail W trail k) (pow (W - 1))) as [Hend|]; [|destruct short; discriminate].
    destruct (rises_end W trail k) as [Hr|(sd & a & Hr & Hb)];
      [exact (proj2 (rises_safe _ _ _ _ Hr (ex_intro _ u Hu) Hspine Hsafe))|].
    exfalso. destruct (rises_next W T carries _ _ _ Hr u Hu) as (En & _ & (u' & Hc)).
    pose proof (deep W T carries _ _ Hc) as Hdc. rewrite depth_child in Hdc.
    destruct (carry_ends_at W trail sd a Ht Hdc Hb) as (_ & _ & _ & Hlt & _). rewrite <- En in Hlt. lia.
Qed.

(** ** Down *)

Lemma place_other sd k : place (child (other sd) k) = place (child sd k).
Proof. now destruct sd. Qed.

Lemma bit_other trail sd k : bit trail (child (other sd) k) = bit trail (child sd k).
Proof. now destruct sd. Qed.

Lemma other_other sd : other (other sd) = sd.
Proof. now destruct sd. Qed.

(** On the way down again: where the next node lies. *)
Lemma ahead_step trail p h k l r : at_key T k = Some (Node l r) -> S (depth k) < W -> p < place k ->
  N.testbit trail (N.of_nat p) = true -> ahead trail p h k ->
  let d := decide (k :: h) in let h' := k :: h in
  match d with
  | Neither => True
  | Only sd =>
      if place (child sd k) =? p then safe h' k else ahead trail p h' (child sd k)
  | Both sd =>
      if bit trail (child sd k) then
        (safe h k \/ safe h (child sd k)) /\ ahead trail p h' (child (other sd) k) /\
        (place (child sd k) = p -> safe h (child (other sd) k) \/ unseen h (child (other sd) k))
      else (safe h k \/ unseen h (child (other sd) k)) /\ ahead trail p h' (child sd k)
  end.
Proof.
  intros Hk Hd Hp Hbit H d h'. assert (Hsa : forall sd, depth k < depth (child sd k)) by (intros sd; rewrite depth_child; lia).
  pose proof (search_culls k h l r Hk) as Hculls.
  assert (Hcut : forall sd, d = Only sd -> safe h' (child (other sd) k)).
  { intros sd E u Hu. unfold d in E. rewrite E in Hculls. rewrite (at_child T (other sd) k l r Hk) in Hu.
    injection Hu as <-. exact Hculls. }
  inversion H as [k' Hs E|k' Hpl Hu E|sd a _ Ha Hb Hu Hah E|sd a _ Ha Hb Hs Hu Hah E|sd a _ Ha Hb Hn Hs Hah E]; subst.
  - assert (Hall : forall sd, ahead trail p h' (child sd k)) by (intros sd; now apply ahead_safe, safe_seen, safe_child).
    destruct d as [|sd|sd]; [exact I|destruct (_ =? p); [now apply safe_seen|apply Hall]|].
    destruct (bit trail (child sd k)); repeat split; auto. left. now apply safe_child.
  - lia.
  - destruct (narrows k h _ Ha) as [E|[E|(sd' & E1 & [E|(E & Hin)])]]; fold d in E; try injection E1 as <-; rewrite E.
    + rewrite Hb. split; [auto|]. now apply ahead_seen.
    + exact I.
    + destruct (Nat.eqb_spec (place (child sd k)) p) as [Ep|_]; [|now apply ahead_seen].
      unfold LaineEnds.bit in Hb. rewrite Ep in Hb. congruence.
    + destruct (Hu _ Hin (within_refl _)).
  - destruct (narrows k h _ Ha) as [E|[E|(sd' & E1 & [E|(E & Hin)])]]; fold d in E; try injection E1 as <-; rewrite E.
    + rewrite bit_other in Hb. rewrite Hb. split; [auto|]. split; [now apply ahead_seen|auto].
    + exact I.
    + destruct (place (child sd k) =? p); [|now apply ahead_safe, safe_seen].
      apply (safe_node h' k l r sd Hk); [now apply safe_seen|now apply Hcut].
    + rewrite place_other. destruct (Nat.eqb_spec (place (child sd k)) p) as [Ep|_]; [|now apply ahead_seen].
      destruct (Hu Ep _ Hin (within_refl _)).
  - destruct (narrows k h _ Ha) as [E|[E|(sd' & E1 & _)]]; [| |discriminate]; fold d in E; rewrite E.
    + destruct (Nat.eqb_spec (place (child sd k)) p) as [Ep|_]; [contradiction|now apply ahead_seen].
    + exact I.
Qed.

Lemma good_descend s h l r : good s h -> at_key T (l_node s) = Some (Node l r) -> decide (l_node s :: h) <> Neither ->
  match laine_descend K (decide (l_node s :: h)) s with
  | None => safe (l_node s :: h) (l_node s)
  | Some s' => good s' (l_node s :: h)
  end.
Proof.
  destruct s as [k trail level pop short]. cbn [l_node]. intros (Hshape & Hspine & Hstage) Hk Hne.
  pose proof (shape_descend W K T carries (Laine k trail level pop short) (decide (k :: h)) l r) as Hmove.
  cbn [l_node l_trail] in *. set (h' := k :: h) in *.
  assert (Hd : S (depth k) < W).
  { pose proof (deep W T carries (child L k) _ (at_child T L k l r Hk)) as H. now rewrite depth_child in H. }
  assert (Hpl : forall sd, place k = S (place (child sd k))) by (intros sd; now apply place_child).
  assert (Hspine' : spine trail h' k) by (apply spine_seen; [apply within_refl|exact Hspine]).
  assert (Hans : answer decide k h' = Some (decide h')) by (unfold h'; cbn [answer]; now rewrite Pos.eqb_refl).
  assert (Hcut : forall sd, decide h' = Only sd -> safe h' (child (other sd) k)).
  { intros sd E u Hu. pose proof (search_culls k h l r Hk) as Hc. fold h' in Hc. rewrite E in Hc.
    rewrite (at_child T (other sd) k l r Hk) in Hu. injection Hu as <-. exact Hc. }
  assert (Hnot : forall sd, ~ within k (child sd k)) by (intros sd Hw; apply within_depth in Hw; rewrite depth_child in Hw; lia).
  destruct Hshape as (Hat & Hl & Ht & Hs). cbn [l_node l_level l_trail l_short] in *. subst level.
  assert (Hshape : shape W T (Laine k trail (pow (place k)) pop short)) by (split; [exact Hat|repeat split; assumption]).
  assert (Hh : forall sd, N.div2 (pow (place k)) = pow (place (child sd k))) by (intros sd; rewrite (Hpl sd); apply half).
  assert (Hunseen : forall sd, safe h k \/ unseen h k -> safe h' (child sd k) \/ unseen h' (child sd k)).
  { intros sd [H|H]; [left; now apply safe_seen, safe_child|right]. apply unseen_seen; [apply Hnot|].
    intros x Hx Hw. exact (H x Hx (within_child _ _ _ Hw)). }
  assert (Hagain : forall p, p < place k -> N.testbit trail (N.of_nat p) = true -> ahead trail p h k -> _)
    by (intros p H1 H2 H3; exact (ahead_step trail p h k l r Hk Hd H1 H2 H3)).
  cbv zeta in Hagain. fold h' in Hagain.
  destruct (decide h') as [|sd|sd] eqn:Hdec; [easy|..].
  - destruct (laine_descend K (Only sd) _) as [s'|] eqn:E; cbn [laine_descend] in E; rewrite (Hh sd) in E;
      destruct (N.eqb_spec (pow (place (child sd k))) pop) as [Ep|Ep]; try discriminate.
    + injection E as <-. destruct (Hmove _ Hshape Hk eq_refl) as [Hshape' _].
      set (c := child sd k) in *. set (trail' := N.lor trail (pow (place c))) in *.
      split; [exact Hshape'|]. cbn [l_trail l_node]. split.
      * apply spine_only; [|exact Hans|apply lor_bit|now apply Hcut]. apply (spine_same trail); [lia| |exact Hspine'].
        rewrite (Hpl sd). intros i Hi. symmetry. exact (lor_same_above trail (place c) i Hi).
      * destruct Hstage as [(Hsafe & Hzero & Hpop)|(p & -> & Hp & Hbit & Hzero & Hahead)].
        -- left. split; [now apply Hunseen|]. split.
           ++ intros i Hi. unfold trail'. rewrite lor_below_bit by exact Hi. apply Hzero. rewrite (Hpl sd). fold c. lia.
           ++ destruct Hpop as [|(p & -> & Hp)]; [auto|]. right. exists p. split; [reflexivity|].
              rewrite (Hpl sd) in Hp. fold c in Hp. lia.
        -- right. exists p. specialize (Hagain p Hp Hbit Hahead). fold c in Hagain.
           destruct (Nat.eqb_spec (place c) p) as [Ec|Ec]; [subst p; contradiction|].
           assert (p < place c) by (rewrite (Hpl sd) in Hp; fold c in Hp; lia).
           split; [reflexivity|]. split; [assumption|]. unfold trail'. rewrite lor_below_bit by assumption.
           split; [exact Hbit|]. split; [intros i Hi; rewrite lor_below_bit by lia; now apply Hzero|].
           apply (ahead_same trail); [|exact Hagain]. intros i Hi. symmetry. now apply lor_below_bit.
    + destruct Hstage as [(_ & _ & [->|(p & -> & Hp)])|(p & -> & Hp & Hbit & _ & Hahead)].
      * pose proof (pow_pos (place (child sd k))). lia.
      * apply (f_equal ctz) in Ep. rewrite !ctz_pow' in Ep. rewrite (Hpl sd) in Hp. lia.
      * apply (f_equal ctz) in Ep. rewrite !ctz_pow' in Ep. specialize (Hagain p Hp Hbit Hahead).
        now rewrite Ep, Nat.eqb_refl in Hagain.
  - destruct (laine_descend K (Both sd) _) as [s'|] eqn:E; cbn [laine_descend] in E; rewrite (Hh sd) in E;
      rewrite is_set_bit in E; fold (bit trail (child sd k)) in E;
      destruct (bit trail (child sd k)) eqn:Hb; try discriminate;
      injection E as <-; destruct (Hmove _ Hshape Hk eq_refl) as [Hshape' _]; (split; [exact Hshape'|]).
    + destruct Hstage as [(_ & Hzero & _)|(p & -> & Hp & Hbit & Hzero & Hahead)].
      { unfold LaineEnds.bit in Hb. rewrite Hzero in Hb by (rewrite (Hpl sd); lia). discriminate. }
      destruct (Hagain p Hp Hbit Hahead) as (Hs1 & Hs2 & Hs3). cbn [l_node l_trail]. split.
      * destruct Hs1 as [Hs1|Hs1]; [apply spine_safe; [exact Hspine'|now apply safe_seen]|].
        apply spine_second; [exact Hspine'|exact Hans|now rewrite bit_other|now apply safe_seen].
      * destruct (Nat.eq_dec (place (child sd k)) p) as [Ec|Ec].
        -- left. rewrite place_other, Ec. split; [|split; [exact Hzero|right; now exists p]].
           destruct (Hs3 Ec); [left; now apply safe_seen|right; apply unseen_seen; auto].
        -- right. exists p. rewrite place_other. rewrite (Hpl sd) in Hp. repeat split; auto. lia.
    + cbn [l_node l_trail]. destruct Hstage as [(Hsafe & Hzero & Hpop)|(p & -> & Hp & Hbit & Hzero & Hahead)].
      * split.
        -- destruct Hsafe as [Hsafe|Hsafe]; [apply spine_safe; [exact Hspine'|now apply safe_seen]|].
           apply spine_first; [exact Hspine'|exact Hans|exact Hb|]. apply unseen_seen; [apply Hnot|].
           intros x Hx Hw. exact (Hsafe x Hx (within_child _ _ _ Hw)).
        -- left. split; [now apply Hunseen|]. rewrite (Hpl sd) in Hzero, Hpop. split; [intros i Hi; apply Hzero; lia|].
           destruct Hpop as [|(p & -> & Hp)]; [auto|]. right. exists p. split; [reflexivity|lia].
      * destruct (Hagain p Hp Hbit Hahead) as (Hs1 & Hs2). split.
        -- destruct Hs1 as [Hs1|Hs1]; [apply spine_safe; [exact Hspine'|now apply safe_seen]|].
           apply spine_first; [exact Hspine'|exact Hans|exact Hb|]. apply unseen_seen; [apply Hnot|exact Hs1].
        -- right. exists p. assert (p <> place (child sd k)).
           { intros ->. unfold LaineEnds.bit in Hb. congruence. }
           rewrite (Hpl sd) in Hp. repeat split; auto. lia.
Qed.

(** * The theorem *)

Lemma closest_run m : forall s h, good s h -> measure W s < m -> exists h', safe h' xH /\ forall f,
  laine_run W K T decide (fun _ => decide) never true (m + f) s h = Some (false, h').
Proof.
  induction m as [|m IH]; intros s h Hg Hm; [lia|].
  pose proof Hg as (Hshape & Hspine & _). pose proof Hshape as ((u & Hu) & _).
  set (h1 := l_node s :: h).
  assert (Back : safe h1 (l_node s) -> exists h', safe h' xH /\ forall f,
    match laine_backtrack W s with
    | Some s => laine_run W K T decide (fun _ => decide) never true (m + f) s h1
    | None => Some (false, h1)
    end = Some (false, h')).
  { intros Hsafe. pose proof (good_backtrack s h1 Hshape (spine_seen _ _ _ _ (within_refl _) Hspine) Hsafe) as Hb.
    pose proof (shape_backtrack W T carries s) as Hlt. destruct (laine_backtrack W s) as [s'|]; [|now exists h1].
    destruct (Hlt s' Hshape eq_refl) as [_ Hlt']. apply IH; [exact Hb|lia]. }
  cbn [Nat.add laine_run negb]. rewrite andb_false_r, Hu. fold h1. destruct u as [|l r].
  - change (never h1) with false. apply Back. now apply safe_leaf.
  - replace (if restarting s then decide h1 else decide h1) with (decide h1) by now destruct (restarting s).
    pose proof (good_descend s h l r Hg Hu) as Hdown. fold h1 in Hdown.
    pose proof (search_culls (l_node s) h l r Hu) as Hculls. fold h1 in Hculls.
    pose proof (shape_descend W K T carries s (decide h1) l r) as Hlt.
    destruct (decide h1) as [|sd|sd] eqn:Hdec.
    + apply Back. apply (safe_node h1 (l_node s) l r L Hu); intros u' Hu'.
      * rewrite (at_child T L _ l r Hu) in Hu'. injection Hu' as <-. exact (Hculls L).
      * rewrite (at_child T (other L) _ l r Hu) in Hu'. injection Hu' as <-. exact (Hculls R).
    + specialize (Hdown ltac:(discriminate)). destruct (laine_descend K (Only sd) s) as [s'|] eqn:E; [|now apply Back].
      destruct (Hlt s' Hshape Hu eq_refl) as [_ Hlt']. apply IH; [exact Hdown|lia].
    + specialize (Hdown ltac:(discriminate)). destruct (laine_descend K (Both sd) s) as [s'|] eqn:E; [|now apply Back].
      destruct (Hlt s' Hshape Hu eq_refl) as [_ Hlt']. apply IH; [exact Hdown|lia].
Qed.

Lemma best_in_tree h : closer hit before (best_below T xH) (best h) = best_below T xH.
Proof.
  induction h as [|k h IH]; [apply closer_none|].
  change (best (k :: h)) with (closer hit before (best h) (found_in hit T offer k)).
  rewrite closer_assoc, IH by assumption. unfold found_in. destruct (at_key T k) as [[|l r]|] eqn:Hk; [|apply closer_none..].
  pose proof (best_around hit before before_irreflexive before_transitive before_total T offer k Leaf Hk) as H.
  unfold best_below. rewrite <- H. cbn [Closest.best_below].
  rewrite closer_comm, <- fold_closer, closer_same by assumption. reflexivity.
Qed.

(** [LAINE-1] In a search for the closest hit, whose answers become narrower while hits are found, the restart trail may
    pass through finished subtrees again; it ends, and with the closest hit of the tree. *)
Theorem laine_closest : exists n h, best h = best_below T xH /\ forall fuel, n <= fuel ->
  laine_run W K T decide (fun _ => decide) never true fuel (laine_start W) [] = Some (false, h).
Proof.
  destruct (closest_run (S (measure W (laine_start W))) (laine_start W) [] good_start (le_n _)) as (h & Hsafe & Hrun).
  exists (S (measure W (laine_start W))), h. split.
  - rewrite <- (best_in_tree h), closer_comm by assumption. symmetry.
    apply nothing_better_spec; try assumption. exact (Hsafe T eq_refl).
  - intros fuel Hf. replace fuel with (S (measure W (laine_start W)) + (fuel - S (measure W (laine_start W)))) by lia. apply Hrun.
Qed.

End Closest.

(** * What it means to become narrower *)

Module Passed.

(** The hit in the left child of node 3 leaves nothing to be found: of its two children the root then wants the first
    alone. *)
Definition T := Node Leaf (Node Leaf Leaf).
Definition decide (h : history) : descent := match h with [1; 6; _; _; _; _]%positive => Only L | _ => Both L end.
Definition visits K := laine_run 8 K T decide (fun _ => decide) never true 9 (laine_start 8) [].

(** [LAINE-1] Without a short stack the way to node 7 leads once more through node 2 (D-16). *)
Example seen_again : visits 0 = Some (false, [2; 1; 6; 3; 1; 2; 1]%positive) /\
  visits 1 = Some (false, [7; 6; 3; 2; 1]%positive).
Proof. split; reflexivity. Qed.

End Passed.

Module FirstAlone.

(** Two leaves with the hits 1 and 0. The left one is visited first; then the root wants the right one alone. *)
Definition T := Node Leaf Leaf.
Definition offer (k : positive) := match k with 2%positive => Some 1 | 3%positive => Some 0 | _ => None end.
Definition decide (h : history) : descent := match best nat Nat.ltb T offer h with None => Both L | Some _ => Only R end.
Definition visits K := laine_run 8 K T decide (fun _ => decide) never true 9 (laine_start 8) [].

(** [LAINE-1] A first child that is dropped alone, before the second has been visited: at the level where the search
    turned back, the one child that is wanted is taken for the one that is done. The search drops nothing but what is
    done, and loses its closest hit. A short stack hands the second child out without asking again. *)
Example second_lost : culls nat Nat.ltb T offer decide /\
  visits 0 = Some (false, [1; 2; 1]%positive) /\ visits 1 = Some (false, [3; 2; 1]%positive).
Proof.
  split; [|split; reflexivity]. intros k h l r Hk. unfold decide.
  assert (E : k = xH) by (pose proof (at_height T k _ Hk) as Hh; cbn in Hh; apply depth_zero; lia).
  subst k. injection Hk as <- <-. set (b := best nat Nat.ltb T offer (1%positive :: h)).
  assert (Hb : b = None \/ b = Some 0 \/ b = Some 1).
  { subst b. generalize (1%positive :: h). clear. intros h. induction h as [|k h IH]; [now left|].
    change (best nat Nat.ltb T offer (k :: h)) with
      (closer nat Nat.ltb (best nat Nat.ltb T offer h) (found_in nat T offer k)).
    assert (Hf : found_in nat T offer k = None \/ found_in nat T offer k = Some 0 \/ found_in nat T offer k = Some 1).
    { unfold found_in. destruct (at_key T k) as [[|]|]; auto. unfold offer. destruct k as [[| |]|[| |]|]; auto. }
    destruct IH as [->|[-> | ->]], Hf as [->|[-> | ->]]; cbn; auto. }
  destruct Hb as [->|[-> | ->]]; [exact I| |]; intros q o [<-|[]] [= <-]; eexists; (split; [reflexivity|]); reflexivity.
Qed.

End FirstAlone.
