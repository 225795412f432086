(** What is known, in the restart trail, of the way to the present node and of the way that lies before it, where decisions become
    narrower while the search goes on. LaineClosest.v makes its invariant of it. *)

Require Import Arith List PArith NArith Lia Bool.
Require Import Tree Machine Bits Meaning Implicit Words Register HashedKeys Resume Closest LaineMachine LaineEnds.
Import ListNotations.

Section Ways.

Variable W : nat.
Variable T : tree.
Hypothesis carries : height T < W.

Variable hit : Type.
Variable before : hit -> hit -> bool.
Hypothesis before_irreflexive : forall x, before x x = false.
Hypothesis before_transitive : forall x y z, before x y = true -> before y z = true -> before x z = true.
Variable offer : positive -> option hit.

Let best := best hit before T offer.
Let nothing_better := nothing_better hit before offer.

(** What the search answers, by all that it has been asked so far, also on the way down again. *)
Variable decide : history -> descent.

Notation place := (place W).
Notation bit := (bit W).

(** * Subtrees of which nothing is missed *)

Definition safe (h : history) (k : positive) : Prop := forall u, at_key T k = Some u -> nothing_better (best h) u k.

Lemma safe_seen x h k : safe h k -> safe (x :: h) k.
Proof.
  intros H u Hu q o Hq Ho. destruct (H u Hu q o Hq Ho) as (b & Hb & Hob).
  change (best (x :: h)) with (closer hit before (best h) (found_in hit T offer x)). rewrite Hb.
  destruct (found_in hit T offer x) as [y|]; cbn [closer]; [|eauto].
  destruct (before y b) eqn:E; [|eauto]. exists y. split; [reflexivity|]. destruct (before o y) eqn:F; [|reflexivity].
  rewrite (before_transitive _ _ _ F E) in Hob. discriminate.
Qed.

Lemma safe_node h k l r sd : at_key T k = Some (Node l r) -> safe h (child sd k) -> safe h (child (other sd) k) -> safe h k.
Proof.
  intros Hk H1 H2 u Hu q o Hq. assert (H : forall sd, safe h (child sd k)) by (destruct sd; intros [|]; assumption).
  rewrite Hk in Hu. injection Hu as <-. cbn in Hq. apply in_app_or in Hq. destruct Hq as [Hq|Hq].
  - apply (H L l); [exact (at_child T L k l r Hk)|exact Hq].
  - apply (H R r); [exact (at_child T R k l r Hk)|exact Hq].
Qed.

Lemma safe_child h k sd : safe h k -> safe h (child sd k).
Proof.
  intros H u Hu. destruct (at_parent T sd k u Hu) as (l & r & Hk & ->). intros q o Hq. apply (H _ Hk).
  now apply (leaves_child sd l r k).
Qed.

(** A leaf that has just been visited. *)
Lemma safe_leaf h k : at_key T k = Some Leaf -> safe (k :: h) k.
Proof.
  intros Hk u Hu. rewrite Hk in Hu. injection Hu as <-. intros q o [<-|[]] Ho.
  change (best (k :: h)) with (closer hit before (best h) (found_in hit T offer k)).
  assert (E : found_in hit T offer k = Some o) by (unfold found_in; now rewrite Hk). rewrite E.
  destruct (best h) as [b|]; cbn [closer].
  - destruct (before o b) eqn:F; eauto.
  - eauto.
Qed.

(** * What is known of the way to the present node, and of the way that lies before it *)

(** Nothing of this subtree has been visited. *)
Definition unseen (h : history) (k : positive) : Prop := forall x, In x h -> ~ within x k.

Inductive spine (trail : N) (h : history) : positive -> Prop :=
  | spine_root : spine trail h xH
  | spine_safe sd a : spine trail h a -> safe h a -> spine trail h (child sd a)
  | spine_first sd a : spine trail h a -> answer decide a h = Some (Both sd) -> bit trail (child sd a) = false ->
      unseen h (child (other sd) a) -> spine trail h (child sd a)
  | spine_second sd a : spine trail h a -> answer decide a h = Some (Both sd) -> bit trail (child (other sd) a) = true ->
      safe h (child sd a) -> spine trail h (child (other sd) a)
  | spine_only sd a : spine trail h a -> answer decide a h = Some (Only sd) -> bit trail (child sd a) = true ->
      safe h (child (other sd) a) -> spine trail h (child sd a).

(** On the way down again, to the node at the level with exponent [p]. *)
Inductive ahead (trail : N) (p : nat) (h : history) : positive -> Prop :=
  | ahead_safe k : safe h k -> ahead trail p h k
  | ahead_here k : place k = p -> unseen h k -> ahead trail p h k
  | ahead_first sd a : S (depth a) < W -> answer decide a h = Some (Both sd) -> bit trail (child sd a) = false ->
      unseen h (child (other sd) a) -> ahead trail p h (child sd a) -> ahead trail p h a
  | ahead_second sd a : S (depth a) < W -> answer decide a h = Some (Both sd) -> bit trail (child (other sd) a) = true ->
      safe h (child sd a) -> (place (child sd a) = p -> unseen h (child (other sd) a)) ->
      ahead trail p h (child (other sd) a) -> ahead trail p h a
  | ahead_only sd a : S (depth a) < W -> answer decide a h = Some (Only sd) -> bit trail (child sd a) = true ->
      place (child sd a) <> p -> safe h (child (other sd) a) -> ahead trail p h (child sd a) -> ahead trail p h a.

Lemma answer_seen x a h : x <> a -> answer decide a (x :: h) = answer decide a h.
Proof. intros H. cbn [answer]. now destruct (Pos.eqb_spec x a). Qed.

Lemma unseen_seen x h k : ~ within x k -> unseen h k -> unseen (x :: h) k.
Proof. intros Hx H y [<-|Hy]; auto. Qed.

Lemma child_injective sd a sd' a' : child sd a = child sd' a' -> sd = sd' /\ a = a'.
Proof. destruct sd, sd'; cbn; intros [= ->]; auto. Qed.

Lemma other_child sd a : child (other sd) a <> child sd a.
Proof. now destruct sd. Qed.

(** What is below one child is not below the other. *)
Lemma within_one sd a x : within x (child sd a) -> ~ within x (child (other sd) a).
Proof.
  intros (n & Hn) (m & Hm). pose proof (depth_up n x) as Dn. pose proof (depth_up m x) as Dm.
  rewrite Hn, depth_child in Dn. rewrite Hm, depth_child in Dm. replace m with n in Hm by lia. rewrite Hn in Hm.
  destruct sd; discriminate.
Qed.

Lemma spine_seen trail x h k : within x k -> spine trail h k -> spine trail (x :: h) k.
Proof.
  intros Hx H. induction H as [|sd a H IH Hs|sd a H IH Ha Hb Hu|sd a H IH Ha Hb Hs|sd a H IH Ha Hb Hs]; [constructor|..].
  all: pose proof (within_child _ _ _ Hx) as Hw; specialize (IH Hw).
  all: assert (Hne : x <> a) by (intros ->; apply within_depth in Hx; rewrite depth_child in Hx; lia).
  - now apply spine_safe, safe_seen.
  - apply spine_first; auto; [now rewrite answer_seen|]. apply unseen_seen; [now apply within_one|exact Hu].
  - apply spine_second; auto; [now rewrite answer_seen|now apply safe_seen].
  - apply spine_only; auto; [now rewrite answer_seen|now apply safe_seen].
Qed.

Lemma ahead_seen trail p x h k : depth x < depth k -> ahead trail p h k -> ahead trail p (x :: h) k.
Proof.
  intros Hx H. assert (Hno : forall c, depth x < depth c -> ~ within x c) by (intros c Hc Hw; apply within_depth in Hw; lia).
  induction H as [k Hs|k Hk Hu|sd a Hd Ha Hb Hu H IH|sd a Hd Ha Hb Hs Hu H IH|sd a Hd Ha Hb Hn Hs H IH].
  - now apply ahead_safe, safe_seen.
  - apply ahead_here; [exact Hk|]. apply unseen_seen; auto.
  - assert (x <> a) by (intros ->; lia).
    apply (ahead_first _ _ _ sd); auto; [now rewrite answer_seen|apply unseen_seen; auto; apply Hno|apply IH];
      rewrite depth_child; lia.
  - assert (x <> a) by (intros ->; lia).
    apply (ahead_second _ _ _ sd); auto; [now rewrite answer_seen|now apply safe_seen|
      intros E; apply unseen_seen; auto; apply Hno|apply IH]; rewrite depth_child; lia.
  - assert (x <> a) by (intros ->; lia).
    apply (ahead_only _ _ _ sd); auto; [now rewrite answer_seen|now apply safe_seen|apply IH; rewrite depth_child; lia].
Qed.

(** They depend on the bits of their levels alone. *)
Lemma spine_same x y h k : depth k < W -> same_above (place k) x y -> spine x h k -> spine y h k.
Proof.
  intros Hd Hxy H. assert (E : forall sd a, depth (child sd a) < W -> same_above (place (child sd a)) x y ->
    (bit y (child sd a) = bit x (child sd a)) /\ depth a < W /\ same_above (place a) x y).
  { intros sd a Hc Hs. rewrite depth_child in Hc. split; [symmetry; apply Hs; lia|]. split; [lia|].
    intros i Hi. apply Hs. rewrite (place_child W sd a Hc) in Hi. lia. }
  induction H as [|sd a H IH Hs|sd a H IH Ha Hb Hu|sd a H IH Ha Hb Hs|sd a H IH Ha Hb Hs]; [constructor|..].
  all: destruct (E _ _ Hd Hxy) as (Eb & Hda & Hsa); specialize (IH Hda Hsa).
  - now apply spine_safe.
  - apply spine_first; auto. now rewrite Eb.
  - apply spine_second; auto. now rewrite Eb.
  - apply spine_only; auto. now rewrite Eb.
Qed.

Lemma ahead_same x y p h k : (forall i, i < place k -> N.testbit x (N.of_nat i) = N.testbit y (N.of_nat i)) ->
  ahead x p h k -> ahead y p h k.
Proof.
  intros Hxy H. assert (E : forall sd a, S (depth a) < W ->
    (forall i, i < place a -> N.testbit x (N.of_nat i) = N.testbit y (N.of_nat i)) ->
    bit y (child sd a) = bit x (child sd a) /\
    forall i, i < place (child sd a) -> N.testbit x (N.of_nat i) = N.testbit y (N.of_nat i)).
  { intros sd a Hd Hs. rewrite (place_child W sd a Hd) in Hs. split; [symmetry; apply Hs; lia|]. intros i Hi. apply Hs. lia. }
  induction H as [k Hs|k Hk Hu|sd a Hd Ha Hb Hu H IH|sd a Hd Ha Hb Hs Hu H IH|sd a Hd Ha Hb Hn Hs H IH].
  - now apply ahead_safe.
  - now apply ahead_here.
  - destruct (E sd a Hd Hxy) as (Eb & Hi). apply (ahead_first _ _ _ sd); auto. now rewrite Eb.
  - destruct (E (other sd) a Hd Hxy) as (Eb & Hi). apply (ahead_second _ _ _ sd); auto. now rewrite Eb.
  - destruct (E sd a Hd Hxy) as (Eb & Hi). apply (ahead_only _ _ _ sd); auto. now rewrite Eb.
Qed.

(** [LAINE-1] What lies before the root, if it lies before a node on the spine. *)
Lemma ahead_root trail p h k : spine trail h k -> p < place k -> ahead trail p h k -> ahead trail p h xH.
Proof.
  intros H. induction H as [|sd a H IH Hs|sd a H IH Ha Hb Hu|sd a H IH Ha Hb Hs|sd a H IH Ha Hb Hs]; intros Hp Hk; [exact Hk|..].
  all: assert (Hd : S (depth a) < W) by (unfold LaineMachine.place in Hp; rewrite depth_child in Hp; lia).
  all: assert (Hpl : forall sd, place a = S (place (child sd a))) by (intros sd'; now apply place_child).
  all: apply IH; [rewrite (Hpl L); unfold LaineMachine.place in *; rewrite !depth_child in *; lia|].
  - now apply ahead_safe.
  - apply (ahead_first _ _ _ sd); auto.
  - apply (ahead_second _ _ _ sd); auto. intros E. exfalso. unfold LaineMachine.place in *. rewrite !depth_child in *. lia.
  - apply (ahead_only _ _ _ sd); auto. lia.
Qed.

End Ways.
