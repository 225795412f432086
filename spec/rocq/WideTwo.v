(** With two slots, the machine of levels is the machine of key and trail of Machine.v: [WIDE-12]. *)

Require Import List NArith Arith Lia Bool Sorted.
Require Tree Machine Bits.
Require Import Wide WideMachine WideLevels WideKeep WideMeaning WideBits WideBinary WideHash.
Import ListNotations.
Open Scope N_scope.

Section Two.

Variable T : Tree.tree.
Variable decide : Tree.history -> Tree.descent.
Variable halt : Tree.history -> bool.

(** A binary tree as a wide one: left is slot 0, right is slot 1. *)
Fixpoint wide_of (t : Tree.tree) : wide :=
  match t with
  | Tree.Leaf => WLeaf
  | Tree.Node l r => Inner (fun s => if s =? 0 then Some (wide_of l) else if s =? 1 then Some (wide_of r) else None)
  end.

Definition bit (sd : Tree.side) : N := match sd with Tree.L => 0 | Tree.R => 1 end.

(** A descent as ranks. *)
Definition ranks (d : Tree.descent) : list N :=
  match d with
  | Tree.Neither => []
  | Tree.Only sd => [bit sd]
  | Tree.Both sd => [bit sd; 2 + bit (Tree.other sd)]
  end.

(** The visits up to the one of [k]. *)
Fixpoint until (k : path) (h : history) : option history :=
  match h with
  | [] => None
  | q :: h' => match until k h' with Some x => Some x | None => if path_eq q k then Some h else None end
  end.

(** A binary search as a wide one: what was decided at a visit is answered again. Nothing is beyond. *)
Definition S : search := {|
  ask k h := match until k h with Some h => ranks (decide (map binary_key h)) | None => [] end;
  stop h := halt (map binary_key h);
  edge h := 2 |}.

Lemma until_more k g h x : until k h = Some x -> until k (g ++ h) = Some x.
Proof. intros H. induction g as [|q g IH]; [exact H|]. simpl. now rewrite IH. Qed.

Lemma until_some k h : exists x, until k (k :: h) = Some x.
Proof. simpl. destruct (until k h) as [x|]; [now exists x|]. destruct (path_eq k k); [eauto|congruence]. Qed.

Lemma until_none k h : ~ In k h -> until k h = None.
Proof.
  induction h as [|q h IH]; intros H; [reflexivity|]. simpl. rewrite IH by (intros Hq; apply H; now right).
  destruct (path_eq q k) as [->|]; [|reflexivity]. destruct H. now left.
Qed.

Lemma until_now k h : ~ In k h -> until k (k :: h) = Some (k :: h).
Proof. intros H. simpl. rewrite until_none by exact H. destruct (path_eq k k); [reflexivity|congruence]. Qed.

(** What was asked is answered again. *)
Lemma ask_again g k h : ask S k (g ++ k :: h) = ask S k (k :: h).
Proof. destruct (until_some k h) as (x & Hx). unfold S, ask. now rewrite (until_more _ g _ _ Hx), Hx. Qed.

Lemma at_wide k : forall w, at_path (wide_of T) k = Some w -> exists t, w = wide_of t.
Proof.
  induction k as [|s k IH]; simpl; intros w H; [injection H as <-; eauto|].
  destruct (at_path (wide_of T) k) as [w'|]; [|discriminate]. destruct (IH w' eq_refl) as ([|l r] & ->); [discriminate|].
  simpl in H. destruct (s =? 0); [injection H as <-; eauto|]. destruct (s =? 1); [injection H as <-; eauto|discriminate].
Qed.

(** The node of a path is that of its key. *)
Lemma at_binary k : Forall (fun s => s < 2) k -> at_path (wide_of T) k = option_map wide_of (Tree.at_key T (binary_key k)).
Proof.
  induction 1 as [|s k Hs _ IH]; [reflexivity|]. simpl. rewrite IH. assert (E : s = 0 \/ s = 1) by lia.
  destruct E as [->| ->]; simpl; destruct (Tree.at_key T (binary_key k)) as [[|l r]|]; reflexivity.
Qed.

Lemma ranks_below d r : In r (ranks d) -> r <= 3.
Proof. destruct d as [|[|]|[|]]; simpl; intros H; repeat (destruct H as [<-|H]; [lia|]); destruct H. Qed.

Lemma not_beyond r : r <= 3 -> beyond 1 2 r = false.
Proof. intros H. unfold beyond. apply N.ltb_ge. change (2 ^ 1) with 2. pose proof (N.mul_div_le r 2). nia. Qed.

Lemma ranks_asked k h r : In r (ask S k h) -> r <= 3.
Proof. simpl. destruct (until k h); [apply ranks_below|intros []]. Qed.

Lemma two_fair : fair 1 (wide_of T) S.
Proof.
  split.
  - intros k h. simpl. destruct (until k h) as [x|]; [|constructor].
    destruct (decide (map binary_key x)) as [|[|]|[|]]; repeat constructor.
  - intros k h. simpl. destruct (until k h) as [x|]; [|constructor].
    destruct (decide (map binary_key x)) as [|[|]|[|]]; simpl; repeat constructor; simpl;
      intros H; repeat destruct H as [H|H]; discriminate || contradiction.
  - intros k h r child Hk _. destruct (at_wide k _ Hk) as ([|a b] & E); [discriminate|]. injection E as ->.
    assert (Hs : slot 1 r < 2) by apply (slot_below 1). assert (E : slot 1 r = 0 \/ slot 1 r = 1) by lia.
    destruct E as [->| ->]; discriminate.
  - intros k h. simpl. lia.
  - intros g k h. now rewrite ask_again.
Qed.

Let M := trail_machine 1.

(** Where something is pending, the machine goes to the deepest. *)
Lemma back_deepest h : forall k ls, means 1 (wide_of T) S h k ls -> alone k ls ->
  back_levels (trail_keeper 1) (now S h) (edge S h) k ls = deepest k ls.
Proof.
  intros k ls Hm Hal. destruct (deepest k ls) as [[k' ls']|] eqn:Ed.
  - revert Hm Ed. revert k' ls'. induction Hal as [|s g a ls [Hs Hg] Hal IH]; intros k' ls'; [discriminate|].
    intros Hm Ed. destruct (N.eqb_spec g 0) as [->|Hn].
    + cbn [deepest] in Ed. cbn [back_levels]. rewrite take_nothing. apply IH; [apply Hm|exact Ed].
    + apply binary_goes; [now constructor; [split|]|exact Ed|]. intros s1 a1 g1 Hk1 Hg1. cbn [deepest] in Ed.
      apply N.eqb_neq in Hn. rewrite Hn in Ed. injection Ed as <- <-. injection Hk1 as <- <-.
      destruct Hm as [(child & h' & h0 & r & _ & Hh & _ & _ & _ & _ & _ & _ & H5) _].
      (* The child is among those that were wanted. *)
      destruct Hg as [Hg|Hg]; [rewrite Hg in Hn; discriminate|].
      assert (El : N.log2 g = 1 - s) by (rewrite Hg; apply N.log2_pow2; lia).
      assert (Hbit : N.testbit g (1 - s) = true) by (rewrite Hg; apply N.pow2_bits_true).
      rewrite El in *. destruct (H5 _ Hbit) as (x & Hx & Hxs).
      assert (Hx' : In x (now S h a)) by (unfold now; rewrite Hh, ask_again; exact Hx).
      cbn [take trail_keeper]. destruct (filter (pend 1 g1) (now S h a)) as [|y ys] eqn:Ef.
      * assert (Hf : In x (filter (pend 1 g1) (now S h a))) by (apply filter_In; split; [exact Hx'|unfold pend; now rewrite Hxs]).
        rewrite Ef in Hf. destruct Hf.
      * assert (Hy : In y (filter (pend 1 g1) (now S h a))) by (rewrite Ef; now left). apply filter_In in Hy.
        destruct Hy as [Hy _]. change (edge S h) with 2. rewrite not_beyond by (eapply ranks_asked; exact Hy). discriminate.
  - clear Hm. induction Hal as [|s g a ls [Hs Hg] Hal IH]; [reflexivity|]. cbn [deepest] in Ed. cbn [back_levels].
    destruct (N.eqb_spec g 0) as [->|Hn]; [|discriminate]. rewrite take_nothing. now apply IH.
Qed.

(** [WIDE-12] At each visit the key and the trail are those of the binary machine, after the same visits, for any decisions. *)
Theorem two_slots_are_binary k ls h : reached 1 M (wide_of T) S (k, ls) h ->
  Machine.reached Machine.trail_machine T decide halt (binary_key k, binary_trail ls) (map binary_key h).
Proof.
  intros H. remember (k, ls) as s eqn:E. revert k ls E.
  induction H as [|[k0 ls0] h s' h' Hr IH Hs]; intros k ls E;
    [injection E as <- <-; apply (Machine.reached_start Machine.trail_machine)|].
  subst s'. specialize (IH k0 ls0 eq_refl).
  pose proof (binary_groups (wide_of T) S k0 ls0 h two_fair Hr) as Hal.
  destruct (reached_meant 1 (wide_of T) S two_fair _ _ Hr) as (Hm & Hnew & _ & _). cbn [fst snd] in Hm, Hnew.
  assert (Hm1 : means 1 (wide_of T) S (k0 :: h) k0 ls0) by (now apply (means_seen 1 (wide_of T) S two_fair h k0 [])).
  assert (Hlow : Forall (fun s => s < 2) k0) by (clear - Hal; induction Hal as [|s g k ls [Hs _] _ IH]; constructor; assumption).
  apply (Machine.reached_step _ _ _ _ _ _ _ _ IH).
  unfold step in Hs. cbv zeta in Hs. change (path_of M (k0, ls0)) with k0 in Hs.
  assert (Es : seen M S k0 h (k0, ls0) = (k0, ls0)) by (unfold seen; now rewrite N.eqb_refl).
  rewrite Es, at_binary in Hs by exact Hlow. clear Es.
  unfold Machine.step. change (Machine.key_of Machine.trail_machine (binary_key k0, binary_trail ls0)) with (Some (binary_key k0)).
  cbv iota beta zeta.
  assert (Hback : go_back M S (k0, ls0) (k0 :: h) = Going M (k, ls) h' ->
      Machine.back Machine.trail_machine (binary_key k0, binary_trail ls0) (binary_key k0 :: map binary_key h) =
      @Machine.Going Machine.trail_machine (binary_key k, binary_trail ls) (map binary_key h')).
  { unfold go_back, Machine.back. cbn [back M trail_machine level_machine Machine.backtrack Machine.trail_machine].
    rewrite back_deepest by assumption. rewrite binary_next by exact Hal.
    destruct (deepest k0 ls0) as [[k1 ls1]|]; [|discriminate]. intros [= <- <- <-]. reflexivity. }
  destruct (Tree.at_key T (binary_key k0)) as [[|l r]|]; cbn [option_map wide_of] in Hs; [| |discriminate].
  - change (stop S (k0 :: h)) with (halt (binary_key k0 :: map binary_key h)) in Hs.
    destruct (halt (binary_key k0 :: map binary_key h)); [discriminate|]. now apply Hback.
  - assert (Ea : ask S k0 (k0 :: h) = ranks (decide (binary_key k0 :: map binary_key h))).
    { unfold S, ask. now rewrite until_now. }
    rewrite Ea in Hs. change (edge S (k0 :: h)) with 2 in Hs.
    destruct (decide (binary_key k0 :: map binary_key h)) as [|[|]|[|]]; cbn [ranks bit Tree.other] in Hs; [now apply Hback| | | |];
      rewrite not_beyond in Hs by lia; injection Hs as <- <- <-; reflexivity.
Qed.

End Two.
