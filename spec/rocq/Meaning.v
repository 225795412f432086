(** What the bits of the trail mean: [TRAIL-1], stated by what has been decided and visited so far. *)

Require Import Arith List PArith NArith Lia Bool.
Require Import Tree Machine Bits.
Import ListNotations.

(** [a] is [x] or an ancestor of it. *)
Definition within (x a : positive) : Prop := exists n, up n x = a.

Lemma within_refl x : within x x.
Proof. exists 0. reflexivity. Qed.

Lemma within_child x sd a : within x (child sd a) -> within x a.
Proof. intros (n & Hn). exists (S n). rewrite up_succ, Hn. destruct sd; reflexivity. Qed.

Lemma child_within sd x a : within (child sd x) a -> a = child sd x \/ within x a.
Proof. intros ([|n] & Hn); [left; auto|right]. exists n. rewrite <- Hn. destruct sd; reflexivity. Qed.

(** A node is not within one that is deeper, nor within another one of its depth. *)
Lemma within_depth x a : within x a -> depth a <= depth x /\ (depth a = depth x -> a = x).
Proof.
  intros (n & <-). rewrite depth_up. split; [lia|]. intros Hd. destruct n as [|n]; [reflexivity|].
  assert (depth x = 0) as H0 by lia. destruct x; [discriminate..|]. clear. induction n; auto.
Qed.

Section Meaning.

Variable C : cursor.
Variable T : tree.
Variable decide : history -> descent.
Variable stop : history -> bool.
Variable allowed : positive -> descent -> Prop.
Variable R : state C -> positive -> list positive -> Prop.
Hypothesis Ref : refines C T allowed R.
Hypothesis decisions : forall k h, decide (k :: h) = Neither \/ allowed k (decide (k :: h)).

(** At some visit both children were wanted, and [x] was to come second. *)
Definition postponed (h : history) (x : positive) : Prop :=
  exists later a before l r sd, h = later ++ a :: before /\ at_key T a = Some (Node l r) /\
    decide (a :: before) = Both sd /\ x = child (other sd) a.

(** Postponed by now, and neither visited nor present. *)
Definition waiting (h : history) (k x : positive) : Prop := postponed h x /\ ~ In x (k :: h).

(** What is to come and what has been is apart: no visited node lies below the present or a postponed one, and none of these
    below another. *)
Definition apart (h : history) (ks : list positive) : Prop :=
  (forall y x, In y h -> In x ks -> ~ within y x) /\ ForallOrdPairs (fun x y => ~ within x y /\ ~ within y x) ks.

Lemma apart_head h k ks : apart h (k :: ks) -> forall x, In x ks -> ~ within k x /\ ~ within x k.
Proof. intros (_ & HP) x Hx. inversion HP as [|a l Hf _]; subst. rewrite Forall_forall in Hf. apply Hf, Hx. Qed.

(** Postponing as of a visit: what was, and the second child, where both are wanted. *)
Lemma postponed_cons h k x : postponed (k :: h) x <->
  postponed h x \/ exists l r sd, at_key T k = Some (Node l r) /\ decide (k :: h) = Both sd /\ x = child (other sd) k.
Proof.
  split.
  - intros (later & a & before & l & r & sd & He & Hk & Hd & Hx). destruct later as [|y later];
      simpl in He; injection He as -> ->.
    + right. exists l, r, sd. auto.
    + left. exists later, a, before, l, r, sd. auto.
  - intros [(later & a & before & l & r & sd & -> & H)|(l & r & sd & Hk & Hd & Hx)].
    + exists (k :: later), a, before, l, r, sd. auto.
    + exists [], k, h, l, r, sd. auto.
Qed.

(** Leaving the present subtree keeps things apart. *)
Lemma apart_back h k ks : apart h (k :: ks) -> apart (k :: h) ks.
Proof.
  intros HA. split.
  - intros y x [<-|Hy] Hx; [apply (apart_head _ _ _ HA), Hx|]. apply (proj1 HA); [exact Hy|now right].
  - destruct HA as (_ & HP). inversion HP; auto.
Qed.

(** So does going down, to one child or to both. *)
Lemma apart_only h k ks sd : apart h (k :: ks) -> apart (k :: h) (child sd k :: ks).
Proof.
  intros HA. split.
  - intros y x [<-|Hy] [<-|Hx].
    + intros Hw. apply within_depth in Hw. rewrite depth_child in Hw. lia.
    + apply (apart_head _ _ _ HA), Hx.
    + intros Hw. apply within_child in Hw. revert Hw. apply (proj1 HA); [exact Hy|now left].
    + apply (proj1 HA); [exact Hy|now right].
  - constructor; [|destruct HA as (_ & HP); inversion HP; auto]. rewrite Forall_forall. intros x Hx.
    destruct (apart_head _ _ _ HA x Hx) as (H1 & H2). split.
    + intros [->|Hw]%child_within; [|auto]. apply H2. exists 1. destruct sd; reflexivity.
    + intros Hw%within_child. auto.
Qed.

Lemma apart_both h k ks sd : apart h (k :: ks) -> apart (k :: h) (child sd k :: child (other sd) k :: ks).
Proof.
  intros HA. pose proof (apart_only _ _ _ sd HA) as (A1 & P1). pose proof (apart_only _ _ _ (other sd) HA) as (A2 & P2).
  inversion P1 as [|? ? F1 P]; inversion P2 as [|? ? F2 _]; subst. split.
  - intros y x Hy [<-|Hx]; [apply A1; simpl; auto|apply A2; auto].
  - constructor; [|constructor; assumption]. constructor; [|assumption].
    split; intros Hw; apply within_depth in Hw; rewrite !depth_child in Hw; destruct Hw as (_ & Hw);
      specialize (Hw eq_refl); destruct sd; discriminate.
Qed.

(** At every state that a right cursor comes to, the stack that it stands for holds what waits, and nothing else. *)
Theorem stack_is_what_waits s h : reached C T decide stop s h ->
  exists k p, R s k p /\ apart h (k :: p) /\ forall x, In x p <-> waiting h k x.
Proof.
  induction 1 as [|s h s' h' _ (k & p & HR & HA & HW) Hstep].
  - exists xH, []. split; [apply (r_start _ _ _ _ Ref)|]. split; [split|].
    + intros y x [].
    + repeat constructor.
    + intros x. split; [intros []|]. intros ((later & a & before & l & r & sd & He & _) & _). destruct later; discriminate.
  - pose proof (apart_head _ _ _ HA) as Hhead.
    assert (B : (forall x, postponed (k :: h) x <-> postponed h x) -> back C s (k :: h) = Going s' h' ->
      exists k p, R s' k p /\ apart h' (k :: p) /\ forall x, In x p <-> waiting h' k x).
    { intros Hp. unfold back. destruct (backtrack C s) as [s1|] eqn:Hb; [|discriminate]. intros [= -> <-].
      destruct p as [|q p]; [rewrite (r_done _ _ _ _ Ref _ _ HR) in Hb; discriminate|].
      destruct (r_next _ _ _ _ Ref _ _ _ _ HR) as (s2 & Hb2 & HR2). rewrite Hb in Hb2. injection Hb2 as ->.
      pose proof (apart_back _ _ _ HA) as HA'.
      exists q, p. split; [exact HR2|]. split; [exact HA'|]. intros x. unfold waiting. rewrite Hp. split.
      - intros Hx. destruct (proj1 (HW x) (or_intror Hx)) as (Hx1 & Hx2). split; [exact Hx1|].
        intros [<-|Hin]; [|auto]. apply (apart_head _ _ _ HA' q Hx). apply within_refl.
      - intros (Hx1 & Hx2). destruct (proj2 (HW x)) as [->|]; [|exfalso; apply Hx2; now left|assumption].
        split; [exact Hx1|]. intros Hin. apply Hx2. now right. }
    unfold step in Hstep. rewrite (r_key _ _ _ _ Ref _ _ _ HR) in Hstep.
    assert (Hlow : forall x sd, In x (k :: h) -> x <> child sd k).
    { intros x sd [<-|Hin] He; [apply (f_equal depth) in He; rewrite depth_child in He; lia|]. subst x.
      apply (proj1 HA _ k Hin (or_introl eq_refl)). exists 1. destruct sd; reflexivity. }
    destruct (at_key T k) as [[|l r]|] eqn:Hk; [destruct (stop (k :: h)); [discriminate|]| |discriminate].
    + apply B; [|exact Hstep]. intros x. rewrite postponed_cons, Hk.
      split; [intros [Hx|(? & ? & ? & [=] & _)]; exact Hx|auto].
    + destruct (decide (k :: h)) as [|sd|sd] eqn:Hd.
      * apply B; [|exact Hstep]. intros x. rewrite postponed_cons, Hd.
        split; [intros [Hx|(? & ? & ? & _ & [=] & _)]; exact Hx|auto].
      * injection Hstep as <- <-. assert (A : allowed k (Only sd)) by (destruct (decisions k h); congruence).
        exists (child sd k), p. split; [eapply r_only; eauto|]. pose proof (apart_only _ _ _ sd HA) as HA'.
        split; [exact HA'|]. intros x. unfold waiting. rewrite postponed_cons, Hd. split.
        -- intros Hx. destruct (proj1 (HW x) Hx) as (Hx1 & Hx2). split; [auto|]. intros [<-|Hin]; [|auto].
           apply (apart_head _ _ _ HA' _ Hx). apply within_refl.
        -- intros ([Hx1|(? & ? & ? & _ & [=] & _)] & Hx2). apply HW. split; [exact Hx1|].
           intros Hin. apply Hx2. now right.
      * injection Hstep as <- <-. assert (A : allowed k (Both sd)) by (destruct (decisions k h); congruence).
        exists (child sd k), (child (other sd) k :: p). split; [eapply r_both; eauto|].
        pose proof (apart_both _ _ _ sd HA) as HA'.
        split; [exact HA'|]. intros x. unfold waiting. rewrite postponed_cons, Hd. split.
        -- intros Hx. split.
           ++ destruct Hx as [<-|Hx]; [right; exists l, r, sd; auto|]. left. apply HW, Hx.
           ++ intros [<-|Hin]; [apply (apart_head _ _ _ HA' _ Hx); apply within_refl|].
              destruct Hx as [<-|Hx]; [eapply Hlow; eauto|]. now apply (proj1 (HW x) Hx).
        -- intros ([Hx1|(l' & r' & sd' & _ & [= <-] & ->)] & Hx2); [|now left]. right. apply HW. split; [exact Hx1|].
           intros Hin. apply Hx2. now right.
Qed.

(** A visit is of the present node. *)
Lemma step_visits k s h s' h' : key_of C s = Some k -> step C T decide stop s h = Going s' h' -> h' = k :: h.
Proof.
  unfold step, back. intros ->. destruct (at_key T k) as [[|l r]|]; [destruct (stop (k :: h))|destruct (decide (k :: h))|];
    try discriminate; try (destruct (backtrack C s); [|discriminate]); congruence.
Qed.

(** [ORDER-1] No node is visited twice, so that no decision is asked for twice. *)
Theorem visited_once s h : reached C T decide stop s h -> exists k, key_of C s = Some k /\ NoDup (k :: h).
Proof.
  intros Hr. destruct (stack_is_what_waits s h Hr) as (k & p & HR & (HA & _) & _).
  exists k. pose proof (r_key _ _ _ _ Ref _ _ _ HR) as Hk. split; [exact Hk|]. constructor.
  - intros Hin. apply (HA k k Hin (or_introl eq_refl)), within_refl.
  - clear k p HR HA Hk. induction Hr as [|s h s' h' Hr IH Hstep]; [constructor|].
    destruct (stack_is_what_waits s h Hr) as (k & p & HR & (HA & _) & _).
    rewrite (step_visits k s h s' h' (r_key _ _ _ _ Ref _ _ _ HR) Hstep). constructor; [|exact IH].
    intros Hin. apply (HA k k Hin (or_introl eq_refl)), within_refl.
Qed.

End Meaning.

(** [TRAIL-1](1, 2) At every visit of the machine, bit [i] of the trail is set if and only if the sibling of the ancestor [i] levels
    up is postponed and not yet visited; and no other node is. *)
Theorem trail_meaning T decide stop k t h : reached trail_machine T decide stop (k, t) h ->
  (forall i, N.testbit t (N.of_nat i) = true <-> i < depth k /\ waiting T decide h k (sibling (up i k))) /\
  (forall x, waiting T decide h k x -> exists i, i < depth k /\ x = sibling (up i k)).
Proof.
  intros Hr. destruct (stack_is_what_waits _ _ _ _ _ _ (trail_refines T) (any_decision _) _ _ Hr)
    as (k' & p & (Hk & Hf & Hp) & _ & HW). simpl in *. subst k' p. split.
  - intros i. rewrite <- HW, pending_bits. split.
    + intros Hb. enough (i < depth k) by eauto. apply fits_range in Hf.
      destruct (Nat.lt_ge_cases i (depth k)) as [|Hge]; [assumption|]. exfalso.
      destruct (N.eq_dec t 0) as [->|H0]; [rewrite N.bits_0 in Hb; discriminate|].
      rewrite N.bits_above_log2 in Hb; [discriminate|]. apply N.log2_lt_pow2 in Hf; lia.
    + intros (Hi & j & Hj & Hb & He). replace i with j; [exact Hb|].
      apply (f_equal depth) in He. rewrite !depth_sibling, !depth_up in He. lia.
  - intros x Hx. apply HW, pending_bits in Hx. destruct Hx as (i & Hi & _ & Hx). eauto.
Qed.
