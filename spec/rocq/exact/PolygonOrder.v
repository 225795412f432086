(** Polygons whose corners lie in order around them, as a triangle's do and what is cut from it (SPLIT-1), in real numbers. *)
Require Import Reals List Lra.
Import ListNotations.
Open Scope R_scope.

(** * Sequences in order *)

Section Sub.
Context {A : Type}.

(** What is left of a list where some are taken out. *)
Inductive sub : list A -> list A -> Prop :=
| sub_nil l : sub [] l
| sub_skip x s l : sub s l -> sub s (x :: l)
| sub_take x s l : sub s l -> sub (x :: s) (x :: l).

Lemma sub_app s s' l l' : sub s l -> sub s' l' -> sub (s ++ s') (l ++ l').
Proof.
  intros H H'. induction H as [l|x s l H IH|x s l H IH]; cbn.
  - induction l as [|x l IHl]; [exact H'|now apply sub_skip].
  - now apply sub_skip.
  - now apply sub_take.
Qed.

Lemma sub_refl l : sub l l.
Proof. induction l; [apply sub_nil|now apply sub_take]. Qed.
Lemma sub_right s l l' : sub s l' -> sub s (l ++ l').
Proof. intros H. change s with ([] ++ s). apply sub_app; [apply sub_nil|exact H]. Qed.
Lemma sub_left s l l' : sub s l -> sub s (l ++ l').
Proof. intros H. rewrite <- (app_nil_r s). apply sub_app; [exact H|apply sub_nil]. Qed.
Lemma sub_tail x s l : sub (x :: s) l -> sub s l.
Proof.
  remember (x :: s) as r eqn:E. intros H. revert s E. induction H as [|y s' l H IH|y s' l H IH]; intros s E; [discriminate| |].
  - apply sub_skip. now apply IH.
  - injection E as -> ->. now apply sub_skip.
Qed.
Lemma sub_trans s l m : sub s l -> sub l m -> sub s m.
Proof.
  intros H H'. revert s H. induction H' as [m|x l m H' IH|x l m H' IH]; intros s H.
  - inversion H; apply sub_nil.
  - apply sub_skip. now apply IH.
  - inversion H; subst; [apply sub_nil|apply sub_skip; now apply IH|apply sub_take; now apply IH].
Qed.
Lemma sub_none s : sub s [] -> s = [].
Proof. intros H. now inversion H. Qed.

Lemma sub_split e l2 : forall l1 s, sub s (l1 ++ e :: l2) -> sub s (l1 ++ l2) \/ exists s1 s2, s = s1 ++ e :: s2 /\ sub s1 l1 /\ sub s2 l2.
Proof.
  induction l1 as [|x l1 IH]; intros s H; cbn in *.
  - inversion H as [l|y s' l H'|y s' l H']; subst; [left; apply sub_nil|now left|right]. exists [], s'. repeat split; [apply sub_nil|exact H'].
  - inversion H as [l|y s' l H'|y s' l H']; subst; [left; apply sub_nil| |].
    + destruct (IH _ H') as [L|(s1 & s2 & -> & S1 & S2)]; [left; now apply sub_skip|right]. exists s1, s2. repeat split; [now apply sub_skip|exact S2].
    + destruct (IH _ H') as [L|(s1 & s2 & -> & S1 & S2)]; [left; now apply sub_take|right]. exists (x :: s1), s2. repeat split; [now apply sub_take|exact S2].
Qed.
End Sub.

(** * Polygons *)

(** A point of the plane of the triangle, by its weights of the second and third corner. *)
Record place : Type := Place { pv : R; pw : R }.

(** Twice the area of a triangle, with a sign. *)
Definition turn (a b c : place) : R := (pv b - pv a) * (pw c - pw a) - (pw b - pw a) * (pv c - pv a).

(** All corners lie in order around the polygon. Corners may coincide. *)
Definition in_order (l : list place) : Prop := forall a b c, sub [a; b; c] l -> 0 <= turn a b c.

Definition between (a b e : place) : Prop := exists t, 0 <= t <= 1 /\ e = Place (pv a + t * (pv b - pv a)) (pw a + t * (pw b - pw a)).

Lemma between_swap a b e : between a b e -> between b a e.
Proof. intros (t & T & ->). exists (1 - t). split; [lra|]. f_equal; ring. Qed.

Lemma turn_cycle a b c : turn a b c = turn b c a.
Proof. unfold turn. ring. Qed.
Lemma turn_same a b : turn a a b = 0 /\ turn a b b = 0 /\ turn b a b = 0.
Proof. unfold turn. repeat split; ring. Qed.
(** It is linear in a point that moves along an edge. *)
Lemma turn_between a b e x y : between a b e -> 0 <= turn a x y -> 0 <= turn b x y -> 0 <= turn e x y.
Proof.
  intros (t & T & ->) A B. replace (turn _ x y) with ((1 - t) * turn a x y + t * turn b x y) by (unfold turn; cbn [pv pw]; ring).
  apply Rplus_le_le_0_compat; apply Rmult_le_pos; lra.
Qed.

(** A new corner on an edge is in order. [SPLIT-1] *)
Theorem insert_in_order l1 a e b l2 : between a b e -> in_order (l1 ++ a :: b :: l2) -> in_order (l1 ++ a :: e :: b :: l2).
Proof.
  intros E O x y z H. replace (l1 ++ a :: e :: b :: l2) with ((l1 ++ [a]) ++ e :: b :: l2) in H by now rewrite <- app_assoc.
  destruct (sub_split _ _ _ _ H) as [L|(s1 & s2 & Eq & S1 & S2)]; [apply O; now rewrite <- app_assoc in L|].
  assert (Left : forall s, sub s l1 -> sub (s ++ [a]) (l1 ++ [a])) by (intros; apply sub_app; [assumption|apply sub_refl]).
  assert (Whole : forall s s', sub s (l1 ++ [a]) -> sub s' (b :: l2) -> sub (s ++ s') (l1 ++ a :: b :: l2)).
  { intros s s' P Q. replace (l1 ++ a :: b :: l2) with ((l1 ++ [a]) ++ b :: l2) by now rewrite <- app_assoc. now apply sub_app. }
  assert (HasA : sub [a] (l1 ++ [a])) by (apply sub_right, sub_refl). assert (HasB : sub [b] (b :: l2)) by (apply sub_take, sub_nil).
  destruct s1 as [|x1 [|x2 [|x3 s1]]]; cbn in Eq; inversion Eq; subst; clear Eq.
  - apply (turn_between a b); [exact E|exact (O _ _ _ (Whole [a] [y; z] HasA S2))|].
    inversion S2 as [|? ? ? S|? ? ? S]; subst; [apply O, sub_right, sub_skip, sub_take; exact S|]. destruct (turn_same b z) as [-> _]. lra.
  - rewrite turn_cycle. apply (turn_between a b); [exact E| |].
    + rewrite <- turn_cycle. destruct (sub_split _ _ _ _ S1) as [L|([|? [|? ?]] & s2 & Eq & L & R)]; cbn in *; try discriminate.
      * rewrite app_nil_r in L. exact (O _ _ _ (Whole [x1; a] [z] (Left _ L) S2)).
      * inversion Eq; subst. destruct (turn_same a z) as [-> _]. lra.
    + rewrite <- turn_cycle. inversion S2 as [|? ? ? S|? ? ? S]; subst.
      * exact (O _ _ _ (Whole [x1] [b; z] S1 (sub_take _ _ _ S))).
      * destruct (turn_same x1 b) as (_ & -> & _). lra.
  - rewrite <- turn_cycle. apply (turn_between a b); [exact E| |].
    + rewrite turn_cycle. destruct (sub_split _ _ _ _ S1) as [L|([|? [|? [|? ?]]] & s2' & Eq & L & R)]; cbn in *; try discriminate.
      * rewrite app_nil_r in L. exact (O _ _ _ (Whole [x1; x2; a] [] (Left _ L) (sub_nil _))).
      * inversion Eq; subst. apply sub_none in R. discriminate.
      * inversion Eq; subst. match goal with |- context [turn ?p a a] => destruct (turn_same p a) as (_ & -> & _) end. lra.
    + rewrite turn_cycle. exact (O _ _ _ (Whole [x1; x2] [b] S1 HasB)).
  - destruct s1; discriminate.
Qed.

(** Nor does it matter that the last corner comes first too. *)
Lemma close_in_order l a : in_order (l ++ [a]) -> in_order (a :: l ++ [a]).
Proof.
  intros O x y z H. inversion H as [|? ? ? S|? ? ? S]; subst; [now apply O|].
  destruct (sub_split _ _ _ _ S) as [L|([|? [|? [|? ?]]] & s2 & Eq & L & R)]; cbn in *; try discriminate.
  - rewrite app_nil_r in L. rewrite turn_cycle. apply O. exact (sub_app _ _ _ _ L (sub_refl [a])).
  - inversion Eq; subst. apply sub_none in R. discriminate.
  - inversion Eq; subst. match goal with |- context [turn ?p ?q ?p] => destruct (turn_same q p) as (_ & _ & ->) end. lra.
Qed.
Lemma sub_in_order s l : sub s l -> in_order l -> in_order s.
Proof. intros S O a b c H. apply O. exact (sub_trans _ _ _ H S). Qed.
