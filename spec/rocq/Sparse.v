(** Algorithm 4 of J (Barringer & Akenine-Moeller 2013): a counter, and a climb along the references of the nodes.

    A node is modelled by its key, and the references by partial functions of keys: to ask the root for its parent loses the
    traversal. *)

Require Import Arith List PArith NArith Lia Bool.
Require Import Tree Machine Bits Implicit Combined.
Import ListNotations.

Definition parent (k : positive) : option positive := match k with xH => None | xO k | xI k => Some k end.

(** [n] parents up. *)
Fixpoint parents (n : nat) (k : positive) : option positive :=
  match n with 0 => Some k | S n => match parent k with Some q => parents n q | None => None end end.

Lemma parents_up n : forall k, n <= depth k -> parents n k = Some (up n k).
Proof. induction n as [|n IH]; intros k Hn; [reflexivity|]. destruct k; simpl in *; [apply IH; lia..|lia]. Qed.

(** The child that is entered. *)
Definition enter (d : descent) (k : positive) : positive :=
  match d with Neither => k | Only sd | Both sd => child sd k end.

Lemma trail_descend_key d k t : fst (trail_descend d (k, t)) = enter d k.
Proof. destruct d; reflexivity. Qed.

(** A state, or what is left of one after a reference that does not exist. *)
Definition sparse_state : Type := option (positive * N).

Definition sparse_descend (d : descent) (s : sparse_state) : sparse_state :=
  match s with
  | None => None
  | Some (node, index) =>
      let index := N.double index in
      let node := enter d node in
      Some (node, if rejected_one d then index + 1 else index)%N
  end.

(** * As printed *)

(** The loop [while levelIndex & 1 = 0]: the node and the index where it ends. The index is not 0, so its binary digits show
    how often the loop runs. *)
Fixpoint climb_parents (index node : positive) : option (positive * positive) :=
  match index with
  | xO index => match parent node with Some node => climb_parents index node | None => None end
  | _ => Some (node, index)
  end.

Section Printed.

(** [sibling(node)], as the nodes hold it. *)
Variable sibling_of : positive -> positive.

(** [until node = root]; the second [None] is a lost traversal. *)
Definition printed_backtrack (s : sparse_state) : option sparse_state :=
  match s with
  | None => Some None
  | Some (node, index) =>
      match climb_parents (N.succ_pos index) node with
      | None => Some None
      | Some (node, index) =>
          let node := sibling_of node in
          if Pos.eqb node xH then None else Some (Some (node, Npos index))
      end
  end.

Definition sparse_printed : cursor := {|
  state := sparse_state;
  start := Some (xH, 0%N);
  key_of := option_map fst;
  descend := sparse_descend;
  backtrack := printed_backtrack |}.

End Printed.

(** The printed loop climbs as many parents as there are trailing zeros. *)
Lemma climb_parents_is_shift index : forall node, climb_parents index node =
  match parents (ctz_pos index) node with
  | Some node => Some (node, match shr (Npos index) (ctz_pos index) with Npos i => i | N0 => xH end)
  | None => None
  end.
Proof.
  induction index as [i _|i IH|]; intros node; try reflexivity. simpl. destruct (parent node); [|reflexivity].
  rewrite IH, shr_succ. reflexivity.
Qed.

(** What is left when the trailing zeros are shifted out is not 0. *)
Lemma shift_out i : shr (Npos i) (ctz_pos i) <> 0%N.
Proof. induction i as [i _|i IH|]; [discriminate|simpl ctz_pos; rewrite shr_succ; exact IH|discriminate]. Qed.

Lemma climb_parents_leads i node q : parents (ctz_pos i) node = Some q ->
  exists j, climb_parents i node = Some (q, j) /\ Npos j = shr (Npos i) (ctz_pos i).
Proof.
  intros Hp. rewrite climb_parents_is_shift, Hp. pose proof (shift_out i).
  destruct (shr (Npos i) (ctz_pos i)) as [|j]; [contradiction|eauto].
Qed.

Lemma sparse_printed_simulates T : simulates T trail_machine (sparse_printed sibling) any_descent
  (fun a b => let '(k, t) := a in fits k t /\ b = Some (k, level_index k t)).
Proof.
  split.
  - repeat split.
  - intros [k t] b (_ & ->). reflexivity.
  - intros [k t] b d k0 l r (Hf & ->) _ _ Hd _.
    destruct (level_index_child d k t Hd) as (k' & t' & He & _ & Hf' & _ & Hi & _).
    pose proof (trail_descend_key d k t) as Hk. cbv [descend trail_machine]. rewrite He in *. simpl in Hk. subst k'.
    split; [auto|]. rewrite Hi. simpl. destruct (rejected_one d); simpl bit; rewrite ?N.add_0_r; reflexivity.
  - intros [k t] b (_ & ->) Hb. destruct (carry_ends k t Hb) as (Hn & _).
    assert (Hs : shr (level_index k t + 1) (ctz (level_index k t + 1)) = 1%N).
    { apply backtrack_none in Hb as ->. rewrite Hn. unfold level_index.
      rewrite counter_overflow, shr_pow, Nat.sub_diag by lia. reflexivity. }
    cbv [backtrack sparse_printed printed_backtrack]. rewrite N.add_1_r, <- N.succ_pos_spec in Hn, Hs. simpl ctz in Hn, Hs.
    rewrite Hn in Hs. destruct (climb_parents_leads (N.succ_pos (level_index k t)) k (up (depth k) k)) as (j & -> & _).
    + rewrite Hn. apply parents_up. lia.
    + rewrite up_root. reflexivity.
  - intros [k t] b [k' t'] (Hf & ->) Hb. destruct (backtrack_some _ _ _ _ Hb) as (H0 & Ek & _).
    destruct (carry_moves k t k' t' Hf Hb) as (Hn & Hf' & Hl & _ & Hc & _).
    pose proof (ctz_fits k t Hf H0) as Hd.
    cbv [backtrack sparse_printed printed_backtrack]. rewrite N.add_1_r, <- N.succ_pos_spec in Hn, Hc. simpl ctz in Hn, Hc.
    destruct (climb_parents_leads (N.succ_pos (level_index k t)) k (up (ctz t) k)) as (j & -> & Hj).
    + rewrite Hn. apply parents_up. lia.
    + subst k'.
      assert (depth (sibling (up (ctz t) k)) <> 0) by (rewrite depth_sibling, depth_up; lia).
      destruct (Pos.eqb_spec (sibling (up (ctz t) k)) 1) as [E|_]; [rewrite E in *; contradiction|].
      eexists. repeat split; [exact Hf'|]. rewrite Hj, Hc. reflexivity.
Qed.

(** [SPARSE-2] Algorithm 4 as printed, where the sibling of the root is the root, has the visits and the answer of the
    reference, and its loop ends at the root. It never asks the root for its parent. *)
Theorem sparse_printed_reference T decide stop fuel : size T <= fuel ->
  run (sparse_printed sibling) T decide stop fuel (start (sparse_printed sibling)) [] = Some (reference decide stop T).
Proof.
  apply (refines_reference _ _ _ _ _ _ (simulates_refines _ _ _ _ _ _ (trail_refines T) (sparse_printed_simulates T))).
  apply any_decision.
Qed.

(** No other node is found in a tree of one leaf. *)
Lemma leaf_alone k : k <> xH -> at_key Leaf k = None.
Proof.
  assert (H : forall k, at_key Leaf k = Some Leaf \/ at_key Leaf k = None).
  { clear. induction k as [k [IH|IH]|k [IH|IH]|]; simpl; rewrite ?IH; auto. }
  intros Hk. destruct k as [k|k|]; [| |contradiction]; simpl; destruct (H k) as [->| ->]; reflexivity.
Qed.

(** [SPARSE-2] Were the root's sibling another node, the loop would not end right even in the tree of one leaf. *)
Theorem sparse_printed_needs_root sibling_of decide fuel : sibling_of xH <> xH ->
  run (sparse_printed sibling_of) Leaf decide (fun _ => false) fuel (start (sparse_printed sibling_of)) [] = None.
Proof.
  intros Hr. assert (E : Pos.eqb (sibling_of xH) xH = false) by (apply Pos.eqb_neq; exact Hr).
  destruct fuel as [|[|fuel]]; [reflexivity|..]; simpl run; unfold step, back; cbn -[Pos.eqb at_key];
    change (at_key Leaf 1) with (Some Leaf); cbn -[Pos.eqb at_key]; rewrite E; [reflexivity|].
  cbv [option_map fst]. rewrite leaf_alone by exact Hr. reflexivity.
Qed.

(** * With the end seen before the climb *)

(** All bits below the first are ones: the increment is a power of two. *)
Definition all_ones (x : N) : bool := N.eqb (N.land x (x + 1)) 0.

(** [levelStart + levelIndex] in one integer, and no climb at the end (spec/DEPARTURES.md, D-9). *)
Definition sparse_backtrack (s : sparse_state) : option sparse_state :=
  match s with
  | None => Some None
  | Some (node, index) =>
      if all_ones index then None
      else
        let index := (index + 1)%N in
        let up := ctz index in
        Some (option_map (fun node => (sibling node, shr index up)) (parents up node))
  end.

Definition sparse : cursor := {|
  state := sparse_state;
  start := Some (xH, 1%N);
  key_of := option_map fst;
  descend := sparse_descend;
  backtrack := sparse_backtrack |}.

(** The combined index is all ones if and only if nothing is left. *)
Lemma all_ones_end k t : fits k t -> all_ones (combined_index k t) = N.eqb t 0.
Proof.
  intros Hf. unfold all_ones. rewrite combined_is_counter by exact Hf. destruct (N.eqb_spec t 0) as [->|H0].
  - rewrite counter_overflow. apply N.eqb_eq. rewrite N.land_comm. apply high_bit_apart.
    apply lxor_below; [|rewrite N.ones_equiv]; assert (2 ^ N.of_nat (S (depth k)) <> 0)%N by (apply N.pow_nonzero; lia); lia.
  - apply N.eqb_neq. rewrite <- combined_is_counter by exact Hf. unfold combined_index.
    assert (Hl : (level_index k t + 1 < level_start k)%N).
    { pose proof (level_index_range k t Hf). destruct (N.eq_dec (level_index k t + 1) (level_start k)) as [E|]; [|lia].
      exfalso. apply H0, (counter_end (depth k)). fold (level_index k t). rewrite N.ones_equiv. unfold level_start in E. lia. }
    rewrite <- N.add_assoc, !high_sum by (try apply level_index_range; assumption). intros E.
    assert (B : forall x, (x < level_start k)%N -> N.testbit (N.lxor (level_start k) x) (N.of_nat (depth k)) = true)
      by (intros x Hx; rewrite N.lxor_spec, (high_bit_clear _ x Hx); unfold level_start; now rewrite N.pow2_bits_true).
    apply (f_equal (fun x => N.testbit x (N.of_nat (depth k)))) in E. rewrite N.land_spec, N.bits_0, !B in E;
      [discriminate|exact Hl|apply level_index_range, Hf].
Qed.

Lemma sparse_simulates T : simulates T trail_machine sparse any_descent
  (fun a b => let '(k, t) := a in fits k t /\ b = Some (k, combined_index k t)).
Proof.
  split.
  - repeat split.
  - intros [k t] b (_ & ->). reflexivity.
  - intros [k t] b d k0 l r (Hf & ->) _ _ Hd _.
    destruct (level_index_child d k t Hd) as (k' & t' & He & _ & Hf' & Hs & Hi & _).
    pose proof (trail_descend_key d k t) as Hk. cbv [descend trail_machine]. rewrite He in *. simpl in Hk. subst k'.
    split; [auto|]. unfold combined_index. rewrite Hs, Hi. simpl. rewrite !N.double_spec.
    destruct (rejected_one d); simpl bit; do 2 f_equal; lia.
  - intros [k t] b (Hf & ->) Hb. cbv [backtrack sparse sparse_backtrack]. rewrite all_ones_end by exact Hf.
    apply backtrack_none in Hb as ->. reflexivity.
  - intros [k t] b [k' t'] (Hf & ->) Hb. destruct (backtrack_some _ _ _ _ Hb) as (H0 & Ek & _).
    cbv [backtrack sparse sparse_backtrack]. rewrite all_ones_end by exact Hf. rewrite (proj2 (N.eqb_neq t 0) H0).
    destruct (combined_moves k t k' t' Hf Hb) as (H1 & H2). destruct (carry_moves k t k' t' Hf Hb) as (Hn & Hf' & _).
    rewrite H2, H1, Hn, parents_up by (pose proof (ctz_fits k t Hf H0); lia).
    subst k'.
    eexists. repeat split. exact Hf'.
Qed.

(** [SPARSE-1] Algorithm 4, with the end seen before the climb, has the visits and the answer of the reference, and ends. *)
Theorem sparse_reference T decide stop fuel : size T <= fuel ->
  run sparse T decide stop fuel (start sparse) [] = Some (reference decide stop T).
Proof.
  apply (refines_reference _ _ _ _ _ _ (simulates_refines _ _ _ _ _ _ (trail_refines T) (sparse_simulates T))).
  apply any_decision.
Qed.
