(** The machine of key and trail on words of [W] bits, where shifts lose what leaves the word: [DEPTH-1].

    It is the machine without bound for trees of at most [W - 1] edges of height. For every higher tree there are searches that
    it gets wrong. *)

Require Import Arith List PArith NArith Lia Bool.
Require Import Tree Machine Bits.
Import ListNotations.

Section Words.

Variable W : nat.

(** What a word keeps. *)
Definition word (x : N) : N := (x mod 2 ^ N.of_nat W)%N.

(** The key, and the trail, of the child. *)
Definition word_descend (d : descent) (s : N * N) : N * N :=
  let '(k, t) := s in
  match d with
  | Neither => s
  | Only sd => (word (2 * k + side_bit sd), word (2 * t))
  | Both sd => (word (2 * k + side_bit sd), word (2 * t + 1))
  end.

Definition word_backtrack (s : N * N) : option (N * N) := let '(k, t) := s in if N.eqb t 0 then None else Some (leap k t).

(** Words for key and trail. No node has the key 0. *)
Definition word_machine : cursor := {|
  state := N * N;
  start := (word 1, 0%N);
  key_of s := match fst s with N0 => None | Npos k => Some k end;
  descend := word_descend;
  backtrack := word_backtrack |}.

Lemma word_id x d : d < W -> (x < 2 ^ N.of_nat (S d))%N -> word x = x.
Proof.
  intros Hd Hx. apply N.mod_small. eapply N.lt_le_trans; [exact Hx|]. apply N.pow_le_mono_r; lia.
Qed.

(** A node and what is below it are within the height. *)
Lemma at_key_height T k : forall t, at_key T k = Some t -> depth k + height t <= height T.
Proof.
  induction k as [k IH|k IH|]; intros t Hk; simpl in *; [| |injection Hk as ->; lia].
  all: destruct (at_key T k) as [[|l r]|]; try discriminate; injection Hk as <-; specialize (IH _ eq_refl); simpl in IH; lia.
Qed.

Lemma word_simulates T : height T < W -> simulates T trail_machine word_machine any_descent
  (fun a b => let '(k, t) := a in fits k t /\ depth k < W /\ b = (Npos k, t)).
Proof.
  intros HW. split.
  - split; [reflexivity|]. split; [simpl; lia|]. simpl. f_equal. apply (word_id 1 0); simpl; lia.
  - intros [k t] b (_ & _ & ->). reflexivity.
  - intros [k t] b d k0 l r (Hf & Hd & ->) [= <-] Hk _ _.
    apply at_key_height in Hk. simpl in Hk.
    assert (Hkey : forall sd, word (2 * Npos k + side_bit sd) = Npos (child sd k)).
    { intros sd. rewrite child_number. apply (word_id _ (depth (child sd k))); [rewrite depth_child; lia|apply key_range]. }
    assert (Htrail : forall b, word (2 * t + side_bit b) = (2 * t + side_bit b)%N).
    { intros sd. apply (word_id _ (depth k)); [lia|]. apply fits_range in Hf.
      rewrite Nat2N.inj_succ, N.pow_succ_r'. destruct sd; simpl side_bit; lia. }
    assert (H0 : word (2 * t) = N.double t) by (specialize (Htrail L); simpl side_bit in Htrail; rewrite N.add_0_r in Htrail;
      rewrite Htrail; symmetry; apply N.double_spec).
    assert (H1 : word (2 * t + 1) = N.succ_double t) by (rewrite (Htrail R : word (2 * t + 1) = _); symmetry;
      apply N.succ_double_spec).
    destruct d as [|sd|sd]; cbv [descend trail_machine trail_descend word_machine word_descend]; [auto|..].
    all: rewrite Hkey, depth_child; split; [apply fits_child, Hf|split; [lia|f_equal; assumption]].
  - intros [k t] b (_ & _ & ->) Hb. apply backtrack_none in Hb as ->. reflexivity.
  - intros [k t] b [k' t'] (Hf & Hd & ->) Hb. destruct (backtrack_some _ _ _ _ Hb) as (H0 & Ek & _).
    pose proof (trail_pops k t Hf) as Hp. cbv [backtrack trail_machine] in Hb. rewrite Hb in Hp.
    destruct (pending k t) as [|q p]; [discriminate|]. destruct Hp as (t1 & [= <- <-] & Hf' & _).
    destruct (backtrack_is_leap k t Hf H0) as (k1 & t1 & Hb1 & Hl). rewrite Hb in Hb1. injection Hb1 as <- <-.
    exists (Npos k', t'). split; [|split; [exact Hf'|split; [|reflexivity]]].
    + cbv [backtrack word_machine word_backtrack]. rewrite (proj2 (N.eqb_neq t 0) H0), Hl. reflexivity.
    + subst k'. rewrite depth_sibling, depth_up. lia.
Qed.

(** [DEPTH-1] On trees of at most [W - 1] edges of height, words of [W] bits do what integers without bound do. *)
Theorem word_machine_reference T decide stop fuel : height T < W -> size T <= fuel ->
  run word_machine T decide stop fuel (start word_machine) [] = Some (reference decide stop T).
Proof.
  intros HW. apply (refines_reference _ _ _ _ _ _ (simulates_refines _ _ _ _ _ _ (trail_refines T) (word_simulates T HW))).
  apply any_decision.
Qed.

(** * One edge more *)

Definition side_of (k : positive) : side := match k with xI _ => R | _ => L end.

Lemma child_side k : k <> xH -> child (side_of k) (Pos.div2 k) = k.
Proof. destruct k; [reflexivity..|contradiction]. Qed.

(** The search that goes straight to the node [x] and no further: its [n]-th visit is of [x]'s ancestor at depth [n - 1]. *)
Definition straight_to (x : positive) (h : history) : descent :=
  if length h <=? depth x then Only (side_of (up (depth x - length h) x)) else Neither.

(** [x] and its ancestors, the root last. *)
Fixpoint lineage (x : positive) : list positive :=
  match x with xH => [xH] | xO k | xI k => x :: lineage k end.

Lemma lineage_cons x : x <> xH -> lineage x = x :: lineage (Pos.div2 x).
Proof. destruct x; [reflexivity..|contradiction]. Qed.

Lemma lineage_length x : length (lineage x) = S (depth x).
Proof. induction x; simpl; auto. Qed.

Lemma lineage_head x : lineage x = x :: tl (lineage x).
Proof. destruct x; reflexivity. Qed.

(** On the way down there is one child to go to. *)
Lemma straight_step x n : S n <= depth x -> straight_to x (lineage (up (S n) x)) = Only (side_of (up n x)).
Proof.
  intros Hn. unfold straight_to. rewrite lineage_length, depth_up.
  destruct (Nat.leb_spec (S (depth x - S n)) (depth x)); [|lia]. do 3 f_equal. lia.
Qed.

Lemma straight_end x : straight_to x (lineage x) = Neither.
Proof. unfold straight_to. rewrite lineage_length. destruct (Nat.leb_spec (S (depth x)) (depth x)); [lia|reflexivity]. Qed.

(** Ancestors of nodes are inner nodes. *)
Lemma ancestor_inner T x t n : at_key T x = Some t -> S n <= depth x ->
  exists l r, at_key T (up (S n) x) = Some (Node l r).
Proof.
  revert x t. induction n as [|n IH]; intros x t Hx Hn.
  - destruct x; simpl in *; [| |lia]; destruct (at_key T x) as [[|l r]|]; try discriminate; eauto.
  - destruct x as [x|x|]; [| |simpl in Hn; lia]; simpl in Hx.
    all: change (up (S (S n)) _) with (up (S n) x); simpl in Hn; destruct (at_key T x) as [[|l r]|] eqn:Hk; try discriminate;
      eapply IH; eauto; lia.
Qed.

Lemma up_child x n : S n <= depth x -> up n x = child (side_of (up n x)) (up (S n) x).
Proof.
  intros Hn. rewrite up_succ. symmetry. apply child_side. intros E. apply (f_equal depth) in E. rewrite depth_up in E.
  simpl in E. lia.
Qed.

Lemma lineage_up x n : S n <= depth x -> lineage (up n x) = up n x :: lineage (up (S n) x).
Proof.
  intros Hn. rewrite up_succ. apply lineage_cons. intros E. apply (f_equal depth) in E. rewrite depth_up in E.
  simpl in E. lia.
Qed.

(** The reference visits the lineage of [x], and nothing else. *)
Lemma reference_straight T x t stop : at_key T x = Some t -> exists b, reference (straight_to x) stop T = (b, lineage x).
Proof.
  intros Hx.
  assert (H : forall n tn h, n <= depth x -> at_key T (up n x) = Some tn -> up n x :: h = lineage (up n x) ->
    exists b, visit (straight_to x) stop tn (up n x) h = (b, lineage x)).
  { induction n as [|n IH]; intros tn h Hn Ht Hh.
    - destruct tn; simpl visit; simpl up in *; rewrite Hh, ?straight_end; eauto.
    - destruct (ancestor_inner T x t n Hx Hn) as (l & r & E). rewrite Ht in E. injection E as ->.
      cbn [visit]. rewrite Hh, straight_step, <- up_child by exact Hn. apply IH; [lia| |symmetry; apply lineage_up, Hn].
      rewrite (up_child x n Hn) at 1. apply at_child, Ht. }
  destruct (H (depth x) T []) as (b & Hb); [lia|now rewrite up_root|now rewrite up_root|].
  rewrite up_root in Hb. exists b. exact Hb.
Qed.

(** Histories grow at their front. *)
Lemma run_extends C T decide stop fuel : forall s h b h', run C T decide stop fuel s h = Some (b, h') ->
  exists k later, key_of C s = Some k /\ h' = later ++ k :: h.
Proof.
  induction fuel as [|fuel IH]; intros s h b h'; [discriminate|]. simpl. unfold step.
  destruct (key_of C s) as [k|]; [|discriminate].
  assert (B : match back C s (k :: h) with
      Going s h => run C T decide stop fuel s h | Done b h => Some (b, h) | Lost => None end = Some (b, h') ->
    exists k0 later, Some k = Some k0 /\ h' = later ++ k0 :: h).
  { unfold back. destruct (backtrack C s) as [s'|].
    - intros (k' & later & _ & ->)%IH. exists k, (later ++ [k']). rewrite <- app_assoc. auto.
    - intros [= _ <-]. exists k, []. auto. }
  destruct (at_key T k) as [[|l r]|]; [destruct (stop (k :: h)); [intros [= _ <-]; exists k, []; auto|exact B]| |discriminate].
  destruct (decide (k :: h)) as [|sd|sd] eqn:Hd; [exact B|..];
    intros (k' & later & _ & ->)%IH; exists k, (later ++ [k']); rewrite <- app_assoc; auto.
Qed.

(** [DEPTH-1] In every tree that is higher, at each of its nodes at depth [W], words go wrong: the key loses its leading one. *)
Theorem word_machine_fails T x t stop fuel : depth x = W -> at_key T x = Some t ->
  run word_machine T (straight_to x) stop fuel (start word_machine) [] <> Some (reference (straight_to x) stop T).
Proof.
  intros Hd Hx. destruct (reference_straight T x t stop Hx) as (b & ->).
  assert (H : forall n fuel s h, n <= depth x -> s = (word (Npos (up n x)), 0%N) -> up n x :: h = lineage (up n x) ->
    run word_machine T (straight_to x) stop fuel s h <> Some (b, lineage x)).
  { induction n as [|n IH]; intros f s h Hn -> Hh He.
    - destruct (run_extends _ _ _ _ _ _ _ _ _ He) as (k & later & Hk & Hl). simpl up in *. rewrite <- Hh in Hl.
      assert (k <> x).
      { intros ->. pose proof (N.mod_upper_bound (Npos x) (2 ^ N.of_nat W)) as Hu. fold (word (Npos x)) in Hu. simpl in Hk.
        destruct (word (Npos x)) as [|k]; [discriminate|]. injection Hk as ->. pose proof (key_range x). rewrite Hd in *.
        assert (2 ^ N.of_nat W <> 0)%N by (apply N.pow_nonzero; lia). lia. }
      destruct later as [|y later]; [injection Hl as ->; contradiction|].
      injection Hl as _ Hl. apply (f_equal (@length _)) in Hl. rewrite app_length in Hl. simpl in Hl. lia.
    - destruct (ancestor_inner T x t n Hx Hn) as (l & r & Ht).
      assert (Hw : word (Npos (up (S n) x)) = Npos (up (S n) x)).
      { apply (word_id _ (depth (up (S n) x))); [rewrite depth_up; lia|apply key_range]. }
      destruct f as [|f]; [discriminate|]. cbn [run] in He. unfold step in He. cbn [key_of word_machine fst] in He.
      rewrite Hw, Ht, Hh, straight_step in He by exact Hn. revert He. apply IH; [lia| |symmetry; apply lineage_up, Hn].
      cbn [descend word_machine word_descend]. rewrite child_number, <- up_child by exact Hn. reflexivity. }
  apply (H (depth x)); [lia| |]; rewrite up_root; reflexivity.
Qed.

(** The key of a node in a larger tree, of which its tree is one half. *)
Fixpoint graft (sd : side) (k : positive) : positive :=
  match k with xH => child sd xH | xO k => xO (graft sd k) | xI k => xI (graft sd k) end.

Lemma at_graft sd l r k : at_key (Node l r) (graft sd k) = at_key (subtree sd l r) k.
Proof. induction k as [k IH|k IH|]; simpl; [rewrite IH..|destruct sd]; reflexivity. Qed.

Lemma depth_graft sd k : depth (graft sd k) = S (depth k).
Proof. induction k as [k IH|k IH|]; simpl; [auto..|destruct sd; reflexivity]. Qed.

(** A tree has nodes at every depth up to its height. *)
Lemma some_node_at T : forall d, d <= height T -> exists x t, depth x = d /\ at_key T x = Some t.
Proof.
  assert (H0 : forall t, exists x t', depth x = 0 /\ at_key t x = Some t') by (intros t; exists xH, t; auto).
  induction T as [|l IHl r IHr]; intros [|d] Hd; auto; [simpl in Hd; lia|].
  assert (H : forall sd, (exists x t, depth x = d /\ at_key (subtree sd l r) x = Some t) ->
    exists x t, depth x = S d /\ at_key (Node l r) x = Some t).
  { intros sd (x & t & <- & Hx). exists (graft sd x), t. rewrite depth_graft, at_graft. auto. }
  simpl in Hd. destruct (Nat.max_spec (height l) (height r)) as [(_ & E)|(_ & E)]; rewrite E in Hd.
  - apply (H R), IHr. lia.
  - apply (H L), IHl. lia.
Qed.

(** [DEPTH-1] Words of [W] bits are enough for all searches in a tree if and only if it has at most [W - 1] edges of height. *)
Theorem word_machine_iff T :
  (forall decide stop, run word_machine T decide stop (size T) (start word_machine) [] = Some (reference decide stop T))
  <-> height T < W.
Proof.
  split.
  - intros H. destruct (Nat.lt_ge_cases (height T) W) as [|Hge]; [assumption|]. exfalso.
    destruct (some_node_at T W Hge) as (x & t & Hd & Hx).
    apply (word_machine_fails T x t (fun _ => false) (size T) Hd Hx), H.
  - intros HW decide stop. apply word_machine_reference; auto.
Qed.

(** * A trail without a key *)

Definition narrow_descend (d : descent) (s : positive * N) : positive * N :=
  let '(k, t) := s in
  match d with
  | Neither => s
  | Only sd => (child sd k, word (N.double t))
  | Both sd => (child sd k, word (N.succ_double t))
  end.

(** A node, and a trail in a word. *)
Definition narrow_trail : cursor := {|
  state := positive * N;
  start := (xH, 0%N);
  key_of s := Some (fst s);
  descend := narrow_descend;
  backtrack := trail_backtrack |}.

(** [DEPTH-1] A trail without a key carries one level more: as many as the word has bits. *)
Theorem narrow_trail_reference T decide stop fuel : height T <= W -> size T <= fuel ->
  run narrow_trail T decide stop fuel (start narrow_trail) [] = Some (reference decide stop T).
Proof.
  intros HW. assert (S : simulates T trail_machine narrow_trail any_descent (fun a b => fits (fst a) (snd a) /\ b = a)).
  { assert (Hw : forall k t, fits k t -> depth k <= W -> word t = t).
    { intros k t Hf%fits_range Hd. apply N.mod_small. eapply N.lt_le_trans; [exact Hf|]. apply N.pow_le_mono_r; lia. }
    split.
    - split; reflexivity.
    - intros a b (_ & ->). reflexivity.
    - intros [k t] b d k0 l r (Hf & ->) [= <-] Hk _ _. apply at_key_height in Hk. cbn in Hk, Hf.
      assert (Hd : forall sd, depth (child sd k) <= W) by (intros sd; rewrite depth_child; lia).
      destruct d as [|sd|sd]; cbn [descend trail_machine narrow_trail trail_descend narrow_descend fst snd]; [auto|..];
        pose proof (fits_child sd k t Hf) as [Hz Ho]; erewrite Hw by eauto; auto.
    - intros a b (_ & ->) H. exact H.
    - intros [k t] b [k' t'] (Hf & ->) H. exists (k', t'). split; [exact H|]. split; [|reflexivity].
      pose proof (trail_pops k t Hf) as Hp. cbv [backtrack trail_machine] in H. rewrite H in Hp.
      destruct (pending k t); [discriminate|]. destruct Hp as (t1 & [= <- <-] & Hf' & _). exact Hf'. }
  apply (refines_reference _ _ _ _ _ _ (simulates_refines _ _ _ _ _ _ (trail_refines T) S)), any_decision.
Qed.

End Words.

(** [DEPTH-1] A word of 1 bit has lost its way in a tree of height 1: there is no key 0. One bit more is enough. *)
Example word_of_1 : let T := Node Leaf Leaf in let go := straight_to 2%positive in
  run (word_machine 1) T go (fun _ => false) 9 (start (word_machine 1)) [] = None /\
  run (word_machine 2) T go (fun _ => false) 9 (start (word_machine 2)) [] = Some (false, [2; 1]%positive).
Proof. split; reflexivity. Qed.

(** [DEPTH-1] Where what is left of the key is some other node, that one is visited: 3 in place of 7. *)
Example word_of_2 : let T := Node Leaf (Node Leaf Leaf) in let go := straight_to 7%positive in
  run (word_machine 2) T go (fun _ => false) 9 (start (word_machine 2)) [] = Some (false, [3; 3; 1]%positive) /\
  run (word_machine 3) T go (fun _ => false) 9 (start (word_machine 3)) [] = Some (false, [7; 3; 1]%positive).
Proof. split; reflexivity. Qed.

(** [DEPTH-1] 6 in place of 14. *)
Example word_of_3 : let T := Node (Node Leaf Leaf) (Node Leaf (Node Leaf Leaf)) in let go := straight_to 14%positive in
  run (word_machine 3) T go (fun _ => false) 9 (start (word_machine 3)) [] = Some (false, [6; 7; 3; 1]%positive) /\
  run (word_machine 4) T go (fun _ => false) 9 (start (word_machine 4)) [] = Some (false, [14; 7; 3; 1]%positive).
Proof. split; reflexivity. Qed.
