(** [Around::is_settled] of src/trace/nearest.rs: in a search for the nearest triangles, children that may be dropped because all that is below
    them comes after the limit, by rounded distance and then by index. *)
Require Import Reals NArith List Bool Lia Lra.
From Flocq Require Import Core.
Import ListNotations.
Open Scope R_scope.

(** Any rounding that keeps the order. *)
Section Settled.
Variable RN : R -> R.
Hypothesis keeps_order : forall x y, x <= y -> RN x <= RN y.

(** [Limit]: a distance, and an index that is greater than any other while the distance is the radius, or open. *)
Definition limit : Type := R * N.
Definition MAX : N := 2 ^ 32 - 1.
Definition before (a b : limit) : Prop := fst a < fst b \/ (fst a = fst b /\ (snd a < snd b)%N).

(** [is_settled]: the rounded bound of a child's box, and the least index below it. *)
Definition is_settled (near : R) (least : N) (l : limit) : bool :=
  Rlt_bool (fst l) near || (Req_bool near (fst l) && (snd l <? MAX)%N && (snd l <? least)%N).

Lemma settled_is near least l : is_settled near least l = true <-> fst l < near \/ (near = fst l /\ (snd l < MAX)%N /\ (snd l < least)%N).
Proof.
  unfold is_settled. rewrite orb_true_iff, !andb_true_iff, !N.ltb_lt.
  destruct (Rlt_bool_spec (fst l) near), (Req_bool_spec near (fst l)); intuition (try discriminate; lra).
Qed.

(** What is below a settled child comes after the limit. [NEAR-6](2) *)
Theorem settled_comes_after bound least l x j : bound <= x -> (least <= j)%N -> is_settled (RN bound) least l = true -> before l (RN x, j).
Proof.
  intros B L S. apply settled_is in S. apply keeps_order in B. unfold before. cbn [fst snd].
  destruct S as [S|(E & _ & S)]; [left; lra|]. rewrite <- E. destruct (Rle_lt_or_eq_dec _ _ B) as [H|H]; [now left|right].
  split; [exact H|]. eapply N.lt_le_trans; eassumption.
Qed.

(** A settled child stays settled. [NEAR-6] *)
Theorem stays_settled near least l l' : l' = l \/ before l' l -> is_settled near least l = true -> is_settled near least l' = true.
Proof.
  intros [->|B] S; [exact S|]. apply settled_is in S. apply settled_is. destruct B as [B|[E B]]; [left; destruct S as [S|[-> _]]; lra|].
  destruct S as [S|(-> & M & S)]; [left; lra|right]. split; [congruence|]. split; eapply N.lt_trans; eassumption.
Qed.

Lemma before_trans a b c : before a b -> before b c -> before a c.
Proof.
  unfold before. intros [A|[A A']] [B|[B B']]; [left; lra|left; lra|left; lra|]. right. split; [congruence|]. eapply N.lt_trans; eassumption.
Qed.

(** * Searches *)

(** The exact distances of the triangles. *)
Variable distance : N -> R.

Inductive tree : Type := Leaf (items : list N) | Inner (children : list (R * N * tree)).
Inductive below : tree -> N -> Prop :=
  | below_leaf items j : In j items -> below (Leaf items) j
  | below_inner children bound least t j : In (bound, least, t) children -> below t j -> below (Inner children) j.

(** A bound of the distances of all triangles below a child, and the least of their indices. *)
Definition fits (child : R * N * tree) : Prop :=
  let '(bound, least, t) := child in forall j, below t j -> bound <= distance j /\ (least <= j)%N.

(** Nodes ahead, triangles that were measured, and the limit. A search drops settled children, alone or together, goes to the children of a
    node, or measures a triangle; then the limit stays, or one that comes before it replaces it. *)
Definition state : Type := list tree * list N * limit.
Inductive step : state -> state -> Prop :=
  | drops a x bound least t y c seen l : fits (bound, least, t) -> is_settled (RN bound) least l = true ->
      step (a ++ Inner (x ++ (bound, least, t) :: y) :: c, seen, l) (a ++ Inner (x ++ y) :: c, seen, l)
  | opens a children c seen l : step (a ++ Inner children :: c, seen, l) (a ++ map snd children ++ c, seen, l)
  | measures a x j y c seen l l' : l' = l \/ before l' l ->
      step (a ++ Leaf (x ++ j :: y) :: c, seen, l) (a ++ Leaf (x ++ y) :: c, j :: seen, l')
  | leaves a c seen l : step (a ++ Leaf [] :: c, seen, l) (a ++ c, seen, l).
Inductive run : state -> state -> Prop :=
  | stays s : run s s
  | goes s s' s'' : step s s' -> run s' s'' -> run s s''.

(** A triangle is ahead, was measured, or comes after the limit. *)
Definition is_kept (j : N) (s : state) : Prop :=
  let '(ahead, seen, l) := s in (exists t, In t ahead /\ below t j) \/ In j seen \/ before l (RN (distance j), j).

Lemma step_keeps j s s' : step s s' -> is_kept j s -> is_kept j s'.
Proof.
  assert (Other : forall (a c b : list tree) t, (exists r, In r (a ++ t :: c) /\ below r j) -> below t j \/ exists r, In r (a ++ b ++ c) /\ below r j).
  { intros a c b t (r & I & B). rewrite in_app_iff in I. destruct I as [I|[<-|I]]; [right|now left|right]; exists r; rewrite !in_app_iff; tauto. }
  intros St. destruct St as [a x bound least t y c seen l Fit S|a children c seen l|a x i y c seen l l' B|a c seen l]; unfold is_kept;
    intros [H|H]; try tauto.
  - destruct (Other a c [Inner (x ++ y)] _ H) as [K|K]; [|now left]. inversion_clear K as [|? b' l0 t' ? I K'].
    rewrite in_app_iff in I. destruct I as [I|[[= <- <- <-]|I]].
    + left. exists (Inner (x ++ y)). split; [rewrite in_app_iff; cbn; tauto|]. apply below_inner with b' l0 t'; [rewrite in_app_iff; tauto|exact K'].
    + right. right. destruct (Fit j K') as [Bd Ls]. exact (settled_comes_after bound least l (distance j) j Bd Ls S).
    + left. exists (Inner (x ++ y)). split; [rewrite in_app_iff; cbn; tauto|]. apply below_inner with b' l0 t'; [rewrite in_app_iff; tauto|exact K'].
  - destruct (Other a c (map snd children) _ H) as [K|K]; [left|now left]. inversion_clear K as [|? b' l0 t' ? I K'].
    exists t'. split; [|exact K']. rewrite !in_app_iff. right. left. now apply (in_map snd) in I.
  - destruct (Other a c [Leaf (x ++ y)] _ H) as [K|K]; [|now left]. inversion_clear K as [? ? I|]. rewrite in_app_iff in I.
    destruct I as [I|[->|I]]; [left|right; left; now left|left]; exists (Leaf (x ++ y)); (split; [rewrite in_app_iff; cbn; tauto|]);
      constructor; rewrite in_app_iff; tauto.
  - destruct H as [H|H]; [right; left; now right|right; right]. destruct B as [->|B]; [exact H|]. now apply before_trans with l.
  - destruct (Other a c [] _ H) as [K|K]; [|now left]. inversion_clear K as [? ? I|]. destruct I.
Qed.

(** At its end every triangle that was not measured comes after the limit: so none of the nearest is lost. [NEAR-6](2) *)
Theorem nothing_near_is_lost root seen l l' j : below root j -> run ([root], [], l) ([], seen, l') ->
  In j seen \/ before l' (RN (distance j), j).
Proof.
  intros B R. assert (K : is_kept j ([], seen, l')).
  { remember ([root], [], l) as s eqn:E. remember ([], seen, l') as s' eqn:E'. assert (K : is_kept j s) by (subst s; left; exists root; split; [now left|exact B]).
    clear E E'. induction R as [s|s s1 s2 St R IH]; [exact K|]. apply IH. now apply step_keeps with s. }
  destruct K as [(t & [] & _)|K]. exact K.
Qed.
End Settled.
