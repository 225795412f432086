(** Trails of numbers hold what is pending [WIDE-10], and trees with two slots are binary trees [WIDE-12]. *)

Require Import List NArith Arith Lia Bool Sorted.
Require Tree Machine Bits.
Require Import Wide WideMachine WideLevels WideKeep WideMeaning WideBits.
Import ListNotations.
Open Scope N_scope.

(** * The groups of the machine of a key and a trail *)

Section Groups.

Variable B : N.
Variable node : N -> path.
Variable T : wide.
Variable S : search.
Hypothesis F : fair B T S.
Hypothesis nodes : forall k, slots_below B k -> node (key B k) = k.

Let M := number_machine B node.

Definition valid (k : path) (ls : list N) : Prop := slots_below B k /\ groups_below B ls /\ length ls = length k.

(** The machine of numbers comes to the states that the machine of levels comes to. *)
Lemma reached_numbers s h : reached B M T S s h ->
  exists k ls, reached B (trail_machine B) T S (k, ls) h /\ s = (key B k, trail B ls) /\ valid k ls.
Proof.
  induction 1 as [|s h s' h' _ (k & ls & Hr & -> & Hk & Hl & Hn) Hs].
  { exists [], []. repeat split; constructor. }
  pose proof (reached_step B (trail_machine B) T S (k, ls) h) as Hstep.
  assert (E : seen (trail_machine B) S k h (k, ls) = (k, ls)).
  { unfold seen. simpl. destruct (edge S (k :: h) =? edge S h); [reflexivity|]. f_equal. apply map_id. }
  assert (E' : seen M S k h (key B k, trail B ls) = (key B k, trail B ls)).
  { unfold seen. simpl. now destruct (edge S (k :: h) =? edge S h). }
  unfold step in Hs, Hstep. cbv zeta in Hs, Hstep.
  change (path_of M (key B k, trail B ls)) with (node (key B k)) in Hs. rewrite nodes in Hs by exact Hk.
  rewrite E' in Hs. clear E'.
  change (path_of (trail_machine B) (k, ls)) with k in Hstep. rewrite E in Hstep. clear E.
  assert (Hback : go_back M S (key B k, trail B ls) (k :: h) = Going M s' h' ->
      exists k1 ls1, go_back (trail_machine B) S (k, ls) (k :: h) = Going (trail_machine B) (k1, ls1) h' /\
        s' = (key B k1, trail B ls1) /\ valid k1 ls1).
  { unfold go_back. simpl.
    destruct (back_numbers_spec B node (now S (k :: h)) (edge S (k :: h)) nodes k ls (N.to_nat (N.size (trail B ls))))
      as [E1 E2]; [assumption..|apply size_below|]. rewrite E1.
    destruct (back_levels _ _ _ k ls) as [[k1 ls1]|]; simpl; [|discriminate]. intros [= <- <-].
    exists k1, ls1. split; [reflexivity|]. split; [reflexivity|]. apply E2. reflexivity. }
  assert (Hboth : go_back M S (key B k, trail B ls) (k :: h) = Going M s' h' ->
      (forall k1 ls1, go_back (trail_machine B) S (k, ls) (k :: h) = Going (trail_machine B) (k1, ls1) h' ->
        reached B (trail_machine B) T S (k1, ls1) h') ->
      exists k1 ls1, reached B (trail_machine B) T S (k1, ls1) h' /\ s' = (key B k1, trail B ls1) /\ valid k1 ls1).
  { intros Hg Hall. destruct (Hback Hg) as (k1 & ls1 & H1 & H2 & H3). exists k1, ls1. auto. }
  destruct (at_path T k) as [[|child]|] eqn:Ht; [|destruct (ask S k (k :: h)) as [|r rs] eqn:Ha|discriminate].
  - destruct (stop S (k :: h)); [discriminate|]. apply Hboth; [exact Hs|]. intros k1 ls1 H1. exact (Hstep _ _ Hr H1).
  - apply Hboth; [exact Hs|]. intros k1 ls1 H1. exact (Hstep _ _ Hr H1).
  - destruct (beyond B (edge S (k :: h)) r).
    + apply Hboth; [exact Hs|]. intros k1 ls1 H1. exact (Hstep _ _ Hr H1).
    + injection Hs as <- <-. exists (slot B r :: k), (slots_of B rs :: ls).
      split; [exact (Hstep _ _ Hr eq_refl)|]. split; [reflexivity|].
      split; [constructor; [apply slot_below|exact Hk]|]. split; [constructor; [apply slots_of_below|exact Hl]|].
      simpl. now rewrite Hn.
Qed.

(** The groups of a trail. *)
Lemma group_nth ls : groups_below B ls -> forall i, (i < length ls)%nat -> group B (trail B ls) (N.of_nat i) = nth i ls 0.
Proof.
  induction 1 as [|g ls Hg Hl IH]; intros i Hi; [simpl in Hi; lia|]. unfold group in *. destruct i as [|i].
  - rewrite N.mul_0_r, N.shiftr_0_r. simpl. now apply mod_back.
  - simpl in Hi. replace (A B * N.of_nat (Datatypes.S i)) with (A B + A B * N.of_nat i) by lia.
    rewrite <- N.shiftr_shiftr. simpl trail. rewrite shift_back by assumption. apply IH. lia.
Qed.

(** [WIDE-10, WIDE-11] At each visit the groups of the trail are what is pending at each level, and nothing is above them. *)
Theorem trail_meaning k t h : reached B M T S (k, t) h -> exists ls,
  means B T S h (node k) ls /\ length ls = length (node k) /\
  (forall i, (i < length ls)%nat -> group B t (N.of_nat i) = nth i ls 0) /\ t < 2 ^ (A B * N.of_nat (length ls)).
Proof.
  intros H. destruct (reached_numbers _ _ H) as (p & ls & Hr & E & Hk & Hl & Hn). injection E as -> ->.
  rewrite nodes by exact Hk. exists ls. split; [now apply (pending_meaning B T S F)|]. split; [exact Hn|].
  split; [now apply group_nth|now apply trail_bits].
Qed.

End Groups.

(** * Two slots *)

Section Binary.

(** The binary key of a path. *)
Fixpoint binary_key (k : path) : positive :=
  match k with [] => xH | s :: k => Tree.child (if s =? 0 then Tree.L else Tree.R) (binary_key k) end.

(** A bit for each level: whether the group is not empty. *)
Fixpoint binary_trail (ls : list N) : N :=
  match ls with [] => 0 | g :: ls => if g =? 0 then N.double (binary_trail ls) else N.succ_double (binary_trail ls) end.

Lemma two_slots s : s < A 1 -> s = 0 \/ s = 1.
Proof. change (A 1) with 2. lia. Qed.

(** [WIDE-12](1) Keys are those of binary trees. *)
Theorem binary_keys k : slots_below 1 k -> key 1 k = Npos (binary_key k).
Proof.
  induction 1 as [|s k Hs _ IH]; [reflexivity|]. simpl key. simpl binary_key. rewrite IH. change (A 1) with 2.
  destruct (two_slots s Hs) as [->| ->]; simpl; lia.
Qed.

(** Each group is empty, or the sibling's slot alone. *)
Definition alone (k : path) (ls : list N) : Prop := Forall2 (fun s g => s < 2 /\ (g = 0 \/ g = 2 ^ (1 - s))) k ls.

(** [WIDE-12](2) At each visit a group is 0 or the sibling's slot alone. *)
Theorem binary_groups T S k ls h : fair 1 T S -> reached 1 (trail_machine 1) T S (k, ls) h -> alone k ls.
Proof.
  intros F H. apply (pending_meaning 1 T S F) in H. revert ls H. induction k as [|s a IH]; intros [|g ls]; simpl; try contradiction.
  { constructor. }
  intros [(child & h' & h0 & r & _ & _ & Hr & Hs & _ & _ & H3 & _ & H5) Hm]. constructor; [|apply IH, Hm].
  assert (Hs2 : forall x, slot 1 x < 2) by (intros x; apply (slot_below 1)).
  assert (Hbit : N.testbit g s = false) by (rewrite <- Hs; apply H3; [exact Hr|lia]).
  pose proof (Hs2 r) as Hr2. rewrite Hs in Hr2. split; [exact Hr2|].
  destruct (N.testbit g (1 - s)) eqn:E; [right|left]; apply N.bits_inj; intros i.
  - rewrite N.pow2_bits_eqb. destruct (N.eqb_spec (1 - s) i) as [<-|Hi]; [exact E|].
    destruct (N.testbit g i) eqn:Ei; [|reflexivity]. destruct (H5 i Ei) as (x & _ & Hx). pose proof (Hs2 x).
    assert (Hsi : s <> i) by (intros ->; congruence). lia.
  - rewrite N.bits_0. destruct (N.testbit g i) eqn:Ei; [|reflexivity]. destruct (H5 i Ei) as (x & _ & Hx). pose proof (Hs2 x).
    assert (s <> i) by (intros ->; congruence). assert (1 - s <> i) by (intros <-; congruence). lia.
Qed.

Lemma alone_below k ls : alone k ls -> groups_below 1 ls.
Proof.
  induction 1 as [|s g k ls [Hs Hg] _ IH]; constructor; [|exact IH]. change (2 ^ A 1) with 4.
  assert (E : s = 0 \/ s = 1) by lia. destruct Hg as [->| ->]; [lia|]. destruct E as [->| ->]; reflexivity.
Qed.

(** [WIDE-12](3) A bit of the binary trail is set iff the group is not 0. *)
Theorem binary_bits ls : forall i, (i < length ls)%nat ->
  N.testbit (binary_trail ls) (N.of_nat i) = negb (nth i ls 0 =? 0).
Proof.
  induction ls as [|g ls IH]; intros i Hi; [simpl in Hi; lia|]. simpl in Hi. destruct i as [|i].
  - simpl. destruct (g =? 0), (binary_trail ls); reflexivity.
  - rewrite <- Bits.bit_div2. simpl binary_trail. simpl nth. rewrite <- IH by lia. f_equal.
    destruct (g =? 0); apply Machine.div2_double.
Qed.

(** [WIDE-12](4) [n] is that of TRAIL-3. *)
Theorem binary_levels ls : groups_below 1 ls -> trail 1 ls <> 0 ->
  levels_up 1 (trail 1 ls) = N.of_nat (Machine.ctz (binary_trail ls)).
Proof.
  induction 1 as [|g ls Hg Hl IH]; [simpl; congruence|]. simpl trail. simpl binary_trail. intros H0.
  destruct (N.eqb_spec g 0) as [->|Hn].
  - assert (H1 : trail 1 ls <> 0) by (intros E; rewrite E in H0; simpl in H0; lia).
    rewrite levels_up_shift, IH by exact H1. destruct (binary_trail ls) eqn:E; [|simpl; lia].
    (* A trail that is not 0 has a bit. *)
    exfalso. clear - H1 E Hl. revert H1. induction Hl as [|g ls Hg Hl IH]; [simpl; congruence|]. simpl in *. intros H.
    destruct (N.eqb_spec g 0) as [->|]; [|destruct (binary_trail ls); discriminate].
    destruct (N.eq_dec (trail 1 ls) 0) as [Ez|Ez]; [rewrite Ez in H; simpl in H; lia|].
    apply IH; [|exact Ez]. destruct (binary_trail ls); [reflexivity|discriminate].
  - rewrite levels_up_group by assumption. destruct (binary_trail ls); reflexivity.
Qed.

(** The deepest group that is not empty, and its slot: what comes next where nothing is beyond. *)
Fixpoint deepest (k : path) (ls : list N) : option (path * list N) :=
  match k, ls with
  | _ :: a, g :: ls => if g =? 0 then deepest a ls else Some (N.log2 g :: a, 0 :: ls)
  | _, _ => None
  end.

(** [WIDE-12](4) The next node is that of TRAIL-4, and so is the trail. *)
Theorem binary_next k ls : alone k ls ->
  Machine.trail_backtrack (binary_key k, binary_trail ls) =
  option_map (fun s => (binary_key (fst s), binary_trail (snd s))) (deepest k ls).
Proof.
  induction 1 as [|s g k ls [Hs Hg] Hal IH]; [reflexivity|]. simpl deepest. simpl binary_trail.
  assert (E : s = 0 \/ s = 1) by lia. destruct (N.eqb_spec g 0) as [->|Hn].
  - rewrite <- IH. simpl binary_key. destruct (binary_trail ls) as [|p]; [reflexivity|].
    change (N.double (Npos p)) with (Npos (xO p)). rewrite Machine.trail_backtrack_even. f_equal. f_equal.
    destruct E as [->| ->]; reflexivity.
  - destruct Hg as [Hg|Hg]; [contradiction|]. subst g. unfold Machine.trail_backtrack.
    assert (C : Machine.ctz (N.succ_double (binary_trail ls)) = 0%nat) by (destruct (binary_trail ls); reflexivity).
    assert (Z : N.succ_double (binary_trail ls) =? 0 = false) by (destruct (binary_trail ls); reflexivity).
    rewrite Z, C, Bits.shr_0. simpl.
    assert (X : N.lxor (N.succ_double (binary_trail ls)) 1 = N.double (binary_trail ls)) by
      (destruct (binary_trail ls); reflexivity).
    rewrite X. destruct E as [->| ->]; reflexivity.
Qed.

(** [WIDE-12] Where what is pending is not beyond, the machine goes there. *)
Theorem binary_goes ans e : forall k ls k' ls', alone k ls -> deepest k ls = Some (k', ls') ->
  (forall s a g, k' = s :: a -> N.testbit g s = true -> take (trail_keeper 1) (ans a) e g <> None) ->
  back_levels (trail_keeper 1) ans e k ls = Some (k', ls').
Proof.
  induction k as [|s a IH]; intros [|g ls] k' ls' Hal; try discriminate. inversion_clear Hal as [|? ? ? ? [Hs Hg] Hal'].
  cbn [deepest back_levels]. destruct (N.eqb_spec g 0) as [->|Hn]; [rewrite take_nothing; now apply IH|].
  destruct Hg as [Hg|Hg]; [contradiction|]. intros [= <- <-] Ht.
  assert (E : N.log2 g = 1 - s) by (rewrite Hg; apply N.log2_pow2; lia).
  specialize (Ht _ _ g eq_refl). rewrite E in *.
  assert (Hb : N.testbit g (1 - s) = true) by (rewrite Hg; apply N.pow2_bits_true). specialize (Ht Hb).
  destruct (take (trail_keeper 1) (ans a) e g) as [[s' g']|] eqn:Et; [|congruence].
  simpl in Et. destruct (filter (pend 1 g) (ans a)) as [|r rs] eqn:Ef; [discriminate|].
  destruct (beyond 1 e r); [discriminate|]. injection Et as <- <-.
  assert (Hr : In r (filter (pend 1 g) (ans a))) by (rewrite Ef; now left). apply filter_In in Hr. destruct Hr as [_ Hr].
  unfold pend in Hr. rewrite Hg, N.pow2_bits_eqb in Hr. apply N.eqb_eq in Hr. rewrite <- Hr. rewrite Hg.
  f_equal. f_equal. f_equal. apply N.bits_inj. intros i. rewrite N.clearbit_eqb, N.pow2_bits_eqb, N.bits_0.
  now destruct (1 - s =? i).
Qed.

End Binary.
