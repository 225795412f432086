(** Trees of nodes with up to 2^B children, searches that order the children, and the reference: [WIDE-1] to [WIDE-5] of
    spec/wide.md.

    A node is named by its path, from the node up to the root: the first number is the slot in which its parent has it. *)

Require Import List NArith Lia Bool Sorted.
Import ListNotations.
Open Scope N_scope.

(** [WIDE-1] A leaf, or slots of which each holds a child or is empty. *)
Inductive wide := WLeaf | Inner (child : N -> option wide).

Definition path := list N.

(** The paths of the visits so far, the latest first. *)
Definition history := list path.

(** The node of a path; [None] where the tree has no such node. *)
Fixpoint at_path (t : wide) (k : path) : option wide :=
  match k with
  | [] => Some t
  | s :: k => match at_path t k with Some (Inner child) => child s | _ => None end
  end.

(** What a search is: functions of the visits so far, since whatever it learns, it learns by them. [ask k h] are the ranks of the
    wanted children of [k]: asked for the first time [h] begins with [k], asked again it is longer. *)
Record search := Search {
  ask : path -> history -> list N;
  stop : history -> bool;
  edge : history -> N }.

(** Takes each of the ranks in turn, unless it is beyond by then, until the search stops. *)
Section Each.

Variable skip : history -> N -> bool.
Variable go : N -> history -> bool * history.

Fixpoint each (rs : list N) (h : history) : bool * history :=
  match rs with
  | [] => (false, h)
  | r :: rs =>
      if skip h r then each rs h
      else let '(stopped, h) := go r h in if stopped then (true, h) else each rs h
  end.

End Each.

Section Wide.

(** A node has at most two to the [B] children. *)
Variable B : N.

(** [WIDE-2] The slot of a rank is its lowest [B] bits. *)
Definition slot (r : N) : N := r mod 2 ^ B.

(** [WIDE-3] With the lowest [B] bits cleared it is greater than the end. *)
Definition beyond (e r : N) : bool := e <? 2 ^ B * (r / 2 ^ B).

(** What is not beyond. *)
Definition live (e : N) (rs : list N) : list N := filter (fun r => negb (beyond e r)) rs.

(** [WIDE-2, WIDE-3, WIDE-4] Ranks come in their order, a slot has one rank and a child; the end never grows; asked again about a
    node, a search answers the same as far as it is not beyond. *)
Record fair (T : wide) (S : search) : Prop := Fair {
  f_sorted k h : StronglySorted N.lt (ask S k h);
  f_slots k h : NoDup (map slot (ask S k h));
  f_children k h r child : at_path T k = Some (Inner child) -> In r (ask S k h) -> child (slot r) <> None;
  f_edge k h : edge S (k :: h) <= edge S h;
  f_again g k h : live (edge S (g ++ k :: h)) (ask S k (g ++ k :: h)) = live (edge S (g ++ k :: h)) (ask S k (k :: h)) }.

Variable S : search.

(** [WIDE-5] The reference: visits a subtree whose root has path [k]; whether the search has been stopped, and the history. *)
Fixpoint visit (t : wide) (k : path) (h : history) : bool * history :=
  let h := k :: h in
  match t with
  | WLeaf => (stop S h, h)
  | Inner child =>
      each (fun h r => beyond (edge S h) r)
        (fun r h => match child (slot r) with Some t => visit t (slot r :: k) h | None => (false, h) end)
        (ask S k h) h
  end.

Definition reference (T : wide) : bool * history := visit T [] [].

(** * What is beyond *)

Lemma beyond_mono e e' r : e' <= e -> beyond e r = true -> beyond e' r = true.
Proof. unfold beyond. rewrite !N.ltb_lt. lia. Qed.

Lemma beyond_le e r r' : r <= r' -> beyond e r = true -> beyond e r' = true.
Proof.
  unfold beyond. rewrite !N.ltb_lt. intros H. assert (H0 : 2 ^ B <> 0) by (apply N.pow_nonzero; lia).
  pose proof (N.div_le_mono r r' (2 ^ B) H0 H). nia.
Qed.

Lemma filter_filter {X} (f g : X -> bool) l : (forall x, f x = true -> g x = true) -> filter f (filter g l) = filter f l.
Proof.
  intros H. induction l as [|x l IH]; [reflexivity|]. simpl. destruct (g x) eqn:E; simpl; rewrite IH; [reflexivity|].
  destruct (f x) eqn:F; [apply H in F; congruence|reflexivity].
Qed.

Lemma filter_comm {X} (f g : X -> bool) l : filter f (filter g l) = filter g (filter f l).
Proof.
  induction l as [|x l IH]; [reflexivity|]. simpl. destruct (g x) eqn:E, (f x) eqn:F; simpl; rewrite ?E, ?F, ?IH; reflexivity.
Qed.

(** What is the same now stays so when the end becomes less. *)
Lemma live_mono e e' rs rs' : e' <= e -> live e rs = live e rs' -> live e' rs = live e' rs'.
Proof.
  intros He H. unfold live in *. assert (F : forall x, negb (beyond e' x) = true -> negb (beyond e x) = true).
  { intros x. rewrite !negb_true_iff. destruct (beyond e x) eqn:E; [|reflexivity].
    rewrite (beyond_mono _ _ _ He E). discriminate. }
  rewrite <- (filter_filter _ _ rs F), <- (filter_filter _ _ rs' F). congruence.
Qed.

(** If the least rank is beyond, all are. *)
Lemma live_none e r rs : StronglySorted N.lt (r :: rs) -> beyond e r = true -> live e (r :: rs) = [].
Proof.
  intros Hs Hb. apply StronglySorted_inv in Hs. destruct Hs as [_ Hs]. simpl. rewrite Hb. simpl.
  induction rs as [|x rs IH]; [reflexivity|]. simpl. inversion_clear Hs.
  rewrite (beyond_le e r x) by (auto; lia). simpl. auto.
Qed.

Lemma live_cons e r rs : beyond e r = false -> live e (r :: rs) = r :: live e rs.
Proof. intros H. simpl. now rewrite H. Qed.

Lemma sorted_filter f rs : StronglySorted N.lt rs -> StronglySorted N.lt (filter f rs).
Proof.
  induction 1 as [|r rs Hs IH Hf]; [constructor|]. simpl. destruct (f r); [|exact IH]. constructor; [exact IH|].
  rewrite Forall_forall in *. intros x Hx. apply filter_In in Hx. apply Hf, Hx.
Qed.

(** The end has not grown over any number of visits. *)
Lemma edge_le T g h : fair T S -> edge S (g ++ h) <= edge S h.
Proof.
  intros HF. induction g as [|k g IH]; [simpl; lia|]. simpl. pose proof (f_edge _ _ HF k (g ++ h)). lia.
Qed.

(** A child that is wanted is there. *)
Lemma at_slot T k h r child : fair T S -> at_path T k = Some (Inner child) -> In r (ask S k h) ->
  exists t, child (slot r) = Some t /\ at_path T (slot r :: k) = Some t.
Proof.
  intros HF Hk Hr. pose proof (f_children _ _ HF _ _ _ _ Hk Hr). simpl. rewrite Hk.
  destruct (child (slot r)) as [t|]; [|congruence]. now exists t.
Qed.

(** Below a leaf, and where there is no node, there is none. *)
Lemma none_below T k : at_path T k = None -> forall b, at_path T (b ++ k) = None.
Proof. intros H b. induction b as [|s b IH]; [exact H|]. simpl. now rewrite IH. Qed.

Lemma none_below_leaf T k s : at_path T k = Some WLeaf -> forall b, at_path T (b ++ s :: k) = None.
Proof. intros H. apply none_below. simpl. now rewrite H. Qed.

End Wide.

(** All nodes of a tree, by the subtrees of its slots. *)
Fixpoint wide_induction (P : wide -> Prop) (leaf : P WLeaf)
  (inner : forall child, (forall s t, child s = Some t -> P t) -> P (Inner child)) (t : wide) : P t :=
  match t with
  | WLeaf => leaf
  | Inner child =>
      inner child (fun s t' (E : child s = Some t') =>
        match child s as o return o = Some t' -> P t' with
        | Some u => fun E => match E in _ = y return match y with Some v => P v | None => True end with
                             | eq_refl => wide_induction P leaf inner u end
        | None => fun E => match E in _ = y return match y with Some v => P v | None => True end with eq_refl => I end
        end E)
  end.
