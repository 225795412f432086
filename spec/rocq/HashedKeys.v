(** The keys that are hashed: exactly those that some search looks up. [HASH-3] of spec/hash.md, for all trees and for
    records of any reach. *)

Require Import List PArith NArith Lia Bool Arith.
Require Import Tree Machine Register.
Import ListNotations.

(** * Levels *)

Lemma up_succ n : forall k, up (S n) k = Pos.div2 (up n k).
Proof. induction n as [|n IH]; intros k; [reflexivity|]. apply (IH (Pos.div2 k)). Qed.

Lemma sibling_sibling k : sibling (sibling k) = k.
Proof. now destruct k. Qed.

Lemma depth_sibling k : depth (sibling k) = depth k.
Proof. now destruct k. Qed.

Lemma depth_up n : forall k, depth (up n k) = depth k - n.
Proof. induction n as [|n IH]; intros k; [cbn; lia|]. cbn [up]. rewrite IH. destruct k; cbn; lia. Qed.

Lemma depth_zero k : depth k = 0 -> k = xH.
Proof. destruct k; cbn; [discriminate|discriminate|reflexivity]. Qed.

Lemma depth_pos k : k <> xH -> 0 < depth k.
Proof. destruct k; cbn; [lia|lia|congruence]. Qed.

(** The side on which a node hangs. *)
Definition side_of (k : positive) : side := match k with xO _ => L | _ => R end.

Lemma child_side k : k <> xH -> child (side_of k) (Pos.div2 k) = k.
Proof. now destruct k. Qed.

Lemma child_other_side k : k <> xH -> child (other (side_of k)) (Pos.div2 k) = sibling k.
Proof. now destruct k. Qed.

Lemma other_other sd : other (other sd) = sd.
Proof. now destruct sd. Qed.

(** The parent of a node of the tree is an inner node, and its sibling is there. *)
Lemma at_parent T k t : at_key T k = Some t -> k <> xH ->
  exists l r, at_key T (Pos.div2 k) = Some (Node l r) /\ exists t', at_key T (sibling k) = Some t'.
Proof.
  destruct k; cbn; [| |congruence]; destruct (at_key T k) as [[|l r]|]; try discriminate; intros _ _; eauto.
Qed.

Lemma at_up T n : forall k t, at_key T k = Some t -> exists t', at_key T (up n k) = Some t'.
Proof.
  induction n as [|n IH]; intros k t Hk; [eauto|]. cbn.
  destruct (Pos.eq_dec k 1) as [->|H1]; [eauto|].
  destruct (at_parent T k t Hk H1) as (l & r & Hp & _). eauto.
Qed.

Lemma at_height T k : forall t, at_key T k = Some t -> height t + depth k <= height T.
Proof.
  induction k as [k IH|k IH|]; intros t Ht; cbn in Ht; [| |injection Ht as ->; cbn; lia];
    destruct (at_key T k) as [[|l r]|]; try discriminate; specialize (IH _ eq_refl); injection Ht as <-;
    cbn [height depth] in *; lia.
Qed.

(** * The set *)

(** [HASH-3] The node [z] is [n] levels below the sibling of [x], and out of the reach of its own record. *)
Definition beyond (T : tree) (Ui Ul : nat) (x z : positive) (n : nat) : Prop :=
  x <> xH /\ up n z = sibling x /\ depth z = n + depth x /\
  match at_key T z with Some Leaf => Ul < n | Some (Node _ _) => Ui < n | None => False end.

Definition hashed_key (T : tree) (Ui Ul : nat) (x : positive) : Prop := exists z n, beyond T Ui Ul x z n.

Section Set_.

Variable T : tree.
Variables Ui Ul : nat.
Variable keep : positive -> N -> bool.

(** Trails end below the root. *)
Lemma fits_ctz k : forall t, fits k t -> t <> 0%N -> ctz t < depth k.
Proof.
  induction k as [k IH|k IH|]; intros [|[p|p|]] Hf Ht; cbn in *; try congruence; try lia;
    specialize (IH (Npos p) Hf ltac:(discriminate)); cbn in IH; lia.
Qed.

(** What the record of a node in the tree does not reach is in the set: the node itself is the witness. *)
Lemma out_of_reach_is_hashed k t u : fits k t -> t <> 0%N -> reach T Ui Ul k < ctz t -> at_key T k = Some u ->
  hashed_key T Ui Ul (next k t).
Proof.
  intros Hf Hz Hreach Hu. pose proof (fits_ctz k t Hf Hz) as Hd. exists k, (ctz t). unfold next.
  assert (Hx : depth (sibling (up (ctz t) k)) = depth k - ctz t) by (rewrite depth_sibling; apply depth_up).
  repeat split.
  - intros H1. rewrite H1 in Hx. cbn in Hx. lia.
  - now rewrite sibling_sibling.
  - rewrite Hx. lia.
  - unfold reach in Hreach. rewrite Hu in *. now destruct u.
Qed.

(** [HASH-3](1, 2, 4) Sufficient: whatever is looked up, by whatever search and with whatever filling, is in the set. The node
    from which the search turns back is itself out of reach: at level 0 the register would hold the sibling. *)
Theorem hashed_keys_suffice decide stop x : looked_up T Ui Ul keep decide stop x -> hashed_key T Ui Ul x.
Proof.
  intros (s & h & H & _ & Ha).
  destruct (reached_refines _ _ _ _ _ _ (hashed_refines T Ui Ul keep) (any_decision decide) _ _ H)
    as (k & p & ((k' & t) & (Hk' & Hf & _) & Hn & Hk & Ht & Hr) & Hin).
  cbn [fst snd] in *. subst k'. destruct (Hin k (or_introl eq_refl)) as (u & Hu).
  unfold asks in Ha. rewrite Hk, Ht in Ha. unfold trail_backtrack in Ha.
  destruct (N.eqb_spec t 0) as [|Hz]; [discriminate|].
  destruct (filled T Ui Ul s) as [|] eqn:Hfill; [discriminate|]. injection Ha as <-.
  unfold filled in Hfill. rewrite Hn, Ht in Hfill.
  exact (out_of_reach_is_hashed k t u Hf Hz (fill_none T Ui Ul k t _ Hr Hz Hfill) Hu).
Qed.

(** ** Necessary: a search that looks a key of the set up *)

Section Search.

Variables x z : positive.
Variable n : nat.
Hypothesis Hz : beyond T Ui Ul x z n.

(** On the path to [z]: [x] is postponed; single children; at the parent of [z], [z] is postponed; nothing else. *)
Definition decisions (k : positive) : descent :=
  let i := depth z - depth k in
  if i =? 0 then Neither
  else if i =? 1 then Both (other (side_of z))
  else if i =? S n then Both (side_of (sibling x))
  else Only (side_of (up (i - 1) z)).

Let C := hashed T Ui Ul keep ideal.
Let at_ (y : positive) (t : N) (r : option positive) :=
  exists h, reached C T (by_key decisions) never (Hashed y y t r) h.

Lemma positive_levels : 1 <= n.
Proof. destruct Hz as (_ & _ & _ & H). destruct (at_key T z) as [[|]|]; [lia|lia|tauto]. Qed.

Lemma on_path j : j <= depth z -> exists t, at_key T (up j z) = Some t /\
  (j <> 0 -> exists l r, t = Node l r) /\ depth z - depth (up j z) = j.
Proof.
  intros Hj. destruct Hz as (_ & _ & _ & H). destruct (at_key T z) as [t|] eqn:Ht; [|tauto].
  destruct j as [|j]; [exists t; repeat split; [exact Ht|congruence|cbn; lia]|].
  destruct (at_up T j z t Ht) as (t' & Ht'). rewrite up_succ.
  destruct (at_parent T (up j z) t' Ht') as (l & r & Hp & _).
  - intros H1. pose proof (depth_up j z) as Hd. rewrite H1 in Hd. cbn in Hd. lia.
  - exists (Node l r). rewrite Hp, <- up_succ, depth_up. repeat split; [eauto|lia].
Qed.

(** One step down from a node of the path. *)
Lemma step_down j t r : j < depth z -> at_ (up (S j) z) t r -> forall d, decisions (up (S j) z) = d -> d <> Neither ->
  exists h, reached C T (by_key decisions) never
    (hashed_descend T Ui Ul keep d (Hashed (up (S j) z) (up (S j) z) t r)) h.
Proof.
  intros Hj (h & H) d Hd Hne. destruct (on_path (S j)) as (t' & Ht & Hi & _); [lia|].
  destruct (Hi ltac:(lia)) as (l & rr & ->). eexists. eapply reached_step; [exact H|].
  unfold step. cbn [C hashed key_of node]. rewrite Ht. cbn [by_key]. rewrite Hd. destruct d; [congruence|reflexivity..].
Qed.

Lemma not_root j : j < depth z -> up j z <> xH.
Proof. intros Hj H1. pose proof (depth_up j z) as Hd. rewrite H1 in Hd. cbn in Hd. lia. Qed.

Lemma down_only j t r : j < depth z -> S j <> 1 -> S j <> S n -> at_ (up (S j) z) t r ->
  at_ (up j z) (N.double t) (if keep (up (S j) z) t then fill T Ui Ul (up (S j) z) t r else r).
Proof.
  intros Hj H1 Hn H. destruct (on_path (S j)) as (_ & _ & _ & Hd); [lia|].
  destruct (step_down j t r Hj H (Only (side_of (up j z)))) as (h & H'); [|discriminate|].
  - unfold decisions. rewrite Hd. destruct (Nat.eqb_spec (S j) 0), (Nat.eqb_spec (S j) 1), (Nat.eqb_spec (S j) (S n));
      try lia. now rewrite Nat.sub_1_r.
  - exists h. cbn [hashed_descend] in H'. rewrite up_succ, child_side in H' by (now apply not_root).
    now rewrite up_succ.
Qed.

(** [i] doublings of 1: the trail [i] levels below the sibling of [x]. *)
Definition bit (i : nat) : N := Nat.iter i N.double 1%N.

Lemma bit_spec i : bit i <> 0%N /\ ctz (bit i) = i /\ N.odd (bit i) = (i =? 0).
Proof.
  induction i as [|i (H0 & Hc & _)]; [split; [discriminate|split; reflexivity]|].
  change (bit (S i)) with (N.double (bit i)). destruct (bit i); [congruence|]. cbn in *.
  split; [discriminate|split; [congruence|reflexivity]].
Qed.

Lemma at_parent_of_x : S n <= depth z -> at_ (up (S n) z) 0 None.
Proof.
  intros Hd. enough (forall i, i + S n <= depth z -> at_ (up (depth z - i) z) 0 None) as H.
  { specialize (H (depth z - S n)). replace (depth z - (depth z - S n)) with (S n) in H by lia. apply H. lia. }
  induction i as [|i IH]; intros Hi.
  - rewrite Nat.sub_0_r, (depth_zero (up (depth z) z)) by (rewrite depth_up; lia). exists []. constructor.
  - replace (depth z - i) with (S (depth z - S i)) in IH by lia.
    pose proof (down_only (depth z - S i) 0 None ltac:(lia) ltac:(lia) ltac:(lia) (IH ltac:(lia))) as H.
    unfold fill, named in H. rewrite row_zero in H. now destruct (keep _ 0) in H.
Qed.

Lemma at_sibling_of_x : at_ (up n z) (bit 0) (Some x).
Proof.
  destruct Hz as (H1 & Hs & Hd & _). pose proof positive_levels as Hn. pose proof (depth_pos x H1) as Hx.
  destruct (on_path (S n)) as (_ & _ & _ & Hi); [lia|].
  destruct (step_down n 0 None ltac:(lia) (at_parent_of_x ltac:(lia)) (Both (side_of (sibling x)))) as (h & H);
    [|discriminate|].
  - unfold decisions. rewrite Hi. destruct (Nat.eqb_spec (S n) 0), (Nat.eqb_spec (S n) 1); try lia.
    now rewrite Nat.eqb_refl.
  - exists h. cbn [hashed_descend] in H. rewrite up_succ, Hs in H. rewrite Hs.
    assert (Hne : sibling x <> xH) by now destruct x.
    rewrite child_side, child_other_side, sibling_sibling in H by assumption. exact H.
Qed.

Lemma at_parent_of_z : at_ (up 1 z) (bit (n - 1)) (Some x).
Proof.
  destruct Hz as (H1 & Hs & Hd & _). pose proof positive_levels as Hn. pose proof (depth_pos x H1) as Hx.
  enough (forall i, i < n -> at_ (up (n - i) z) (bit i) (Some x)) as H.
  { specialize (H (n - 1) ltac:(lia)). now replace (n - (n - 1)) with 1 in H by lia. }
  induction i as [|i IH]; intros Hi; [rewrite Nat.sub_0_r; apply at_sibling_of_x|].
  replace (n - i) with (S (n - S i)) in IH by lia.
  pose proof (down_only (n - S i) (bit i) (Some x) ltac:(lia) ltac:(lia) ltac:(lia) (IH ltac:(lia))) as H.
  cbn [fill] in H. now destruct (keep _ _) in H.
Qed.

Lemma z_not_root : z <> xH.
Proof. destruct Hz as (H1 & _ & Hd & _). pose proof (depth_pos x H1). intros ->. cbn in Hd. lia. Qed.

Lemma at_sibling_of_z : at_ (sibling z) (N.succ_double (bit (n - 1))) (Some z).
Proof.
  pose proof z_not_root as H1. pose proof (depth_pos z H1) as Hd.
  destruct (on_path 1) as (_ & _ & _ & Hi); [lia|].
  destruct (step_down 0 _ _ Hd at_parent_of_z (Both (other (side_of z)))) as (h & H); [|discriminate|].
  - unfold decisions. now rewrite Hi.
  - exists h. cbn [hashed_descend up] in H. now rewrite other_other, child_other_side, child_side in H by assumption.
Qed.

Lemma neither_below k : depth k = depth z -> by_key decisions [k] = Neither.
Proof. intros Hd. cbn. unfold decisions. rewrite Hd, Nat.sub_diag. reflexivity. Qed.

Lemma back_at_z : at_ z (bit n) None.
Proof.
  destruct at_sibling_of_z as (h & H). pose proof positive_levels as Hn.
  exists (sibling z :: h). eapply reached_step; [exact H|].
  assert (Hb : hashed_backtrack T Ui Ul ideal (Hashed (sibling z) (sibling z) (N.succ_double (bit (n - 1))) (Some z)) =
    Some (Hashed z z (bit n) None)).
  { unfold hashed_backtrack, trail_backtrack. cbn [key trail].
    replace (bit n) with (N.double (bit (n - 1))) by (destruct n; [lia|]; now rewrite Nat.sub_1_r).
    destruct (bit_spec (n - 1)) as (H0 & _). destruct (bit (n - 1)) as [|p]; [congruence|].
    cbn. rewrite sibling_sibling. reflexivity. }
  destruct Hz as (_ & _ & _ & Ht). destruct (at_key T z) as [t|] eqn:Hat; [|tauto].
  destruct (at_parent T z t Hat z_not_root) as (_ & _ & _ & t' & Hs).
  unfold step, back. cbn [C hashed key_of node backtrack]. rewrite Hs.
  destruct t'; cbn [never]; [now rewrite Hb|].
  change (by_key decisions (sibling z :: h)) with (by_key decisions [sibling z]).
  rewrite neither_below by apply depth_sibling. now rewrite Hb.
Qed.

Lemma search_looks_up : looked_up T Ui Ul keep (by_key decisions) never x.
Proof.
  destruct back_at_z as (h & H). exists (Hashed z z (bit n) None), h. split; [exact H|].
  destruct Hz as (_ & Hs & _ & Ht). destruct (bit_spec n) as (H0 & Hc & Ho). pose proof positive_levels as Hn. split.
  - unfold turns_back. cbn [node]. destruct (at_key T z) as [[|]|]; [reflexivity| |tauto]. now apply neither_below.
  - unfold asks, filled, trail_backtrack. cbn [key trail node register fill]. rewrite (proj2 (N.eqb_neq _ _) H0), Hc.
    unfold named. rewrite row_lowest; [|exact H0|rewrite Ho; now destruct n; [lia|]].
    replace (ctz (bit n) <=? reach T Ui Ul z) with false; [now rewrite Hs, sibling_sibling|].
    symmetry. rewrite Hc. apply Nat.leb_gt. unfold reach. destruct (at_key T z) as [[|]|]; tauto.
Qed.

End Search.

(** [HASH-3](1, 2, 4) Necessary: every key of the set is looked up by some search that does not even change its mind. *)
Theorem hashed_keys_are_needed x : hashed_key T Ui Ul x -> exists decide, looked_up T Ui Ul keep decide never x.
Proof. intros (z & n & Hz). exists (by_key (decisions x z n)). now apply search_looks_up. Qed.

(** [HASH-3](1, 2, 4) The set is what searches look up, exactly. *)
Theorem hashed_keys_are_exact x :
  hashed_key T Ui Ul x <-> exists decide stop, looked_up T Ui Ul keep decide stop x.
Proof.
  split.
  - intros H. destruct (hashed_keys_are_needed x H) as (decide & Hd). eauto.
  - intros (decide & stop & H). eapply hashed_keys_suffice, H.
Qed.

End Set_.

(** [HASH-3, HASHED-1] So Algorithm 1 over a table of this set does what the reference does. *)
Theorem hashed_keys_do T Ui Ul keep decide stop lookup fuel : (forall x, hashed_key T Ui Ul x -> lookup x = x) ->
  size T <= fuel ->
  run (hashed T Ui Ul keep lookup) T decide stop fuel (start (hashed T Ui Ul keep lookup)) [] =
  Some (reference decide stop T).
Proof. intros Hl. apply hashed_reference. intros x Hx. eapply Hl, hashed_keys_suffice, Hx. Qed.

(** * In one number *)

(** [below t n u]: the subtree [u] is [n] levels below the root of [t]. *)
Inductive below : tree -> nat -> tree -> Prop :=
  | below_here t : below t 0 t
  | below_child sd l r n u : below (subtree sd l r) n u -> below (Node l r) (S n) u.

Lemma below_key n : forall T s t u, at_key T s = Some t ->
  (below t n u <-> exists z, up n z = s /\ depth z = n + depth s /\ at_key T z = Some u).
Proof.
  induction n as [|n IH]; intros T s t u Hs; split.
  - inversion 1; subst. exists s. auto.
  - intros (z & <- & _ & Hz). cbn in Hs. replace t with u by congruence. constructor.
  - inversion 1 as [|sd l r m v Hb]; subst. apply (IH T (child sd s)) in Hb; [|now apply at_child].
    destruct Hb as (z & Hu & Hd & Hz). exists z. rewrite up_succ, Hu. split; [now destruct sd|].
    split; [|exact Hz]. rewrite Hd. destruct sd; cbn; lia.
  - intros (z & Hu & Hd & Hz). rewrite up_succ in Hu. pose proof (depth_up n z) as Hc.
    assert (H1 : up n z <> xH) by (intros E; rewrite E in Hc; cbn in Hc; lia).
    destruct (at_up T n z u Hz) as (t' & Ht'). destruct (at_parent T _ _ Ht' H1) as (l & r & Hp & _).
    rewrite Hu, Hs in Hp. injection Hp as ->. apply (below_child (side_of (up n z))).
    pose proof (at_child T (side_of (up n z)) s l r Hs) as Hat. rewrite <- Hu, child_side in Hat by exact H1.
    apply (IH T (up n z) _ _ Hat).
    exists z. repeat split; [lia|exact Hz].
Qed.

Lemma below_height t n u : below t n u -> n + height u <= height t.
Proof. induction 1 as [|[|] l r n u _ IH]; cbn in *; lia. Qed.

Lemma leaf_at_height t : below t (height t) Leaf.
Proof.
  induction t as [|l IHl r IHr]; [constructor|]. cbn [height].
  destruct (Nat.max_dec (height l) (height r)) as [->| ->]; [apply (below_child L)|apply (below_child R)]; assumption.
Qed.

Lemma inner_above_height t : forall n, n < height t -> exists l r, below t n (Node l r).
Proof.
  induction t as [|l IHl r IHr]; intros n Hn; [cbn in Hn; lia|]. destruct n as [|n]; [do 2 eexists; constructor|].
  cbn [height] in Hn. destruct (Nat.max_dec (height l) (height r)) as [E|E];
    [destruct (IHl n) as (l' & r' & H)|destruct (IHr n) as (l' & r' & H)]; try lia; do 2 eexists;
    [apply (below_child L)|apply (below_child R)]; exact H.
Qed.

(** [HASH-3](3, 4) A key is hashed iff its sibling's subtree is at least min(Ui + 2, Ul + 1) levels high, where a leaf is 0
    levels high. *)
Theorem hashed_iff_high T Ui Ul x t : x <> xH -> at_key T (sibling x) = Some t ->
  (hashed_key T Ui Ul x <-> Nat.min (Ui + 2) (Ul + 1) <= height t).
Proof.
  intros H1 Hs. split.
  - intros (z & n & _ & Hu & Hd & Hz). destruct (at_key T z) as [u|] eqn:Hat; [|tauto].
    assert (Hb : below t n u).
    { apply (below_key n T (sibling x) t u Hs). exists z. rewrite depth_sibling. auto. }
    apply below_height in Hb. destruct u; cbn in Hb; lia.
  - assert (H : forall n u, below t n u -> match u with Leaf => Ul < n | _ => Ui < n end -> hashed_key T Ui Ul x).
    { intros n u Hb Hn. apply (below_key n T (sibling x) t u Hs) in Hb. destruct Hb as (z & Hu & Hd & Hz).
      exists z, n. repeat split; [exact H1|exact Hu|now rewrite depth_sibling in Hd|]. rewrite Hz. now destruct u. }
    intros Hh. destruct (Nat.le_gt_cases (Ul + 1) (height t)) as [Hl|Hl].
    + apply (H (height t) Leaf (leaf_at_height t)). lia.
    + destruct (inner_above_height t (Ui + 1)) as (l & r & Hb); [lia|]. apply (H _ _ Hb). lia.
Qed.

(** [HASH-3] The printed rule, an inner grand nephew, is a height of at least 3: so it is exact where
    min(Ui + 2, Ul + 1) = 3, as for (2,2) and (1,2); has keys too many for (2,3), and keys missing for (1,1). *)
Theorem printed_rule t : (exists l r, below t 2 (Node l r)) <-> 3 <= height t.
Proof.
  split; [|intros H; now apply inner_above_height].
  intros (l & r & H). apply below_height in H. cbn in H. lia.
Qed.

(** [HASH-3] A key of a node of the tree other than the root, or of no node: the set has only the former. *)
Theorem hashed_keys_are_nodes T Ui Ul x : hashed_key T Ui Ul x -> x <> xH /\ exists t, at_key T x = Some t.
Proof.
  intros (z & n & H1 & Hu & _ & Hz). split; [exact H1|]. destruct (at_key T z) as [u|] eqn:Hat; [|tauto].
  destruct (at_up T n z u Hat) as (t & Ht). rewrite Hu in Ht.
  destruct (at_parent T (sibling x) t Ht) as (_ & _ & _ & t' & Hs); [now destruct x|].
  rewrite sibling_sibling in Hs. eauto.
Qed.
