(** A search without an order: [WIDE-6]. *)

Require Import List NArith Lia Bool Sorted.
Require Import Wide WideBits WideHash.
Import ListNotations.
Open Scope N_scope.

(** The ranks: of a leaf its slot, of an inner node its slot above those of all leaves. *)
Definition leaves_first (B : N) (leaves inner : list N) : list N := leaves ++ map (N.add (A B)) inner.

(** [WIDE-6] These are the ranks of a search as any other: they come in their order, leaves before inner nodes, each in the order of
    slots; and nothing is beyond the greatest end. *)
Theorem leaves_first_ranks B leaves inner e :
  StronglySorted N.lt leaves -> StronglySorted N.lt inner -> Forall (fun s => s < A B) (leaves ++ inner) -> A B <= e ->
  let ranks := leaves_first B leaves inner in
  StronglySorted N.lt ranks /\ map (slot B) ranks = leaves ++ inner /\ live B e ranks = ranks.
Proof.
  intros Hl Hi Hb He. unfold leaves_first. apply Forall_app in Hb. destruct Hb as [Bl Bi]. rewrite Forall_forall in Bl, Bi.
  cbv zeta. split; [|split].
  - induction Hl as [|x l Hl IH Hx]; simpl.
    + clear Bi Bl. induction Hi as [|x i Hi IH Hx]; simpl; constructor; [exact IH|]. rewrite Forall_forall in *.
      intros y Hy. apply in_map_iff in Hy. destruct Hy as (z & <- & Hz). apply Hx in Hz. lia.
    + constructor; [apply IH; intros y Hy; apply Bl; now right|]. rewrite Forall_forall in *.
      intros y Hy. apply in_app_or in Hy. destruct Hy as [Hy|Hy]; [now apply Hx|].
      apply in_map_iff in Hy. destruct Hy as (z & <- & _). specialize (Bl x (or_introl eq_refl)). simpl in Bl. lia.
  - rewrite map_app, map_map. f_equal; rewrite <- map_id; apply map_ext_in; intros x Hx.
    + apply slot_small. now apply Bl.
    + apply slot_above. now apply Bi.
  - unfold live. assert (H : forall r, In r (leaves ++ map (N.add (A B)) inner) -> beyond B e r = false).
    { intros r Hr. destruct (beyond B e r) eqn:E; [|reflexivity]. apply (beyond_mono B e (A B)) in E; [|exact He].
      apply in_app_or in Hr. destruct Hr as [Hr|Hr].
      - rewrite not_beyond_small in E by now apply Bl. discriminate.
      - apply in_map_iff in Hr. destruct Hr as (s & <- & Hs). rewrite not_beyond_above in E by now apply Bi. discriminate. }
    induction (leaves ++ map (N.add (A B)) inner) as [|r rs IH]; [reflexivity|]. simpl.
    rewrite (H r (or_introl eq_refl)). simpl. f_equal. apply IH. intros x Hx. apply H. now right.
Qed.
