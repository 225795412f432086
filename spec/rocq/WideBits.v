(** Keys and trails of wide trees as numbers: [WIDE-9], [WIDE-11], [WIDE-14], and the machine of a key and a trail. *)

Require Import List NArith Arith Lia Bool Sorted.
Require Machine Bits.
Require Import Wide WideMachine WideLevels WideKeep.
Import ListNotations.
Open Scope N_scope.

Section Numbers.

Variable B : N.

(** The number of slots, which is the number of bits of a group. *)
Definition A : N := 2 ^ B.

(** [WIDE-9] The key of a node: the root's is 1. *)
Fixpoint key (k : path) : N :=
  match k with [] => 1 | s :: k => key k * A + s end.

(** [WIDE-10] The trail: a group for each level, that of the parent lowest. *)
Fixpoint trail (ls : list N) : N :=
  match ls with [] => 0 | g :: ls => trail ls * 2 ^ A + g end.

(** The slots of a path, and the groups of a trail, are in their range. *)
Definition slots_below (k : path) : Prop := Forall (fun s => s < A) k.
Definition groups_below (ls : list N) : Prop := Forall (fun g => g < 2 ^ A) ls.

Lemma A_positive : 0 < A.
Proof. unfold A. apply N.neq_0_lt_0, N.pow_nonzero. lia. Qed.

Lemma pow_positive n : 0 < 2 ^ n.
Proof. apply N.neq_0_lt_0, N.pow_nonzero. lia. Qed.

(** A number above and one below, with a shift back. *)
Lemma shift_back n x y : y < 2 ^ n -> N.shiftr (x * 2 ^ n + y) n = x.
Proof.
  intros H. rewrite N.shiftr_div_pow2. rewrite N.div_add_l by (pose proof (pow_positive n); lia).
  rewrite N.div_small by exact H. lia.
Qed.

Lemma mod_back n x y : y < 2 ^ n -> (x * 2 ^ n + y) mod 2 ^ n = y.
Proof.
  intros H. rewrite N.add_comm, N.mod_add by (pose proof (pow_positive n); lia). now apply N.mod_small.
Qed.

(** ** Keys *)

(** [WIDE-9] The ancestor [n] levels up. *)
Theorem key_ancestor n : forall k, slots_below k -> (n <= length k)%nat -> N.shiftr (key k) (B * N.of_nat n) = key (skipn n k).
Proof.
  induction n as [|n IH]; intros k Hk Hn; [rewrite N.mul_0_r; apply N.shiftr_0_r|].
  destruct k as [|s k]; [simpl in Hn; lia|]. inversion_clear Hk. simpl in Hn.
  replace (B * N.of_nat (S n)) with (B + B * N.of_nat n) by lia. rewrite <- N.shiftr_shiftr. simpl key. unfold A.
  rewrite shift_back by assumption. apply IH; [assumption|lia].
Qed.

Lemma key_parent k s : s < A -> N.shiftr (k * A + s) B = k.
Proof. apply shift_back. Qed.

(** [WIDE-14] A key has one bit and [B] bits a level, and not fewer. *)
Theorem key_bits k : slots_below k -> 2 ^ (B * N.of_nat (length k)) <= key k < 2 ^ (1 + B * N.of_nat (length k)).
Proof.
  induction 1 as [|s k Hs _ IH]; [rewrite N.mul_0_r; simpl; lia|]. simpl length. simpl key.
  replace (B * N.of_nat (S (length k))) with (B + B * N.of_nat (length k)) by lia. rewrite !N.pow_add_r in *. fold A.
  fold A in Hs. pose proof A_positive. change (2 ^ 1) with 2 in *. nia.
Qed.

(** [WIDE-9] The level is the number of bits, less one, divided by [B]. *)
Theorem key_level k : 0 < B -> slots_below k -> N.log2 (key k) / B = N.of_nat (length k).
Proof.
  intros HB Hk. destruct (key_bits k Hk) as [H1 H2]. rewrite N.add_comm, N.add_1_r in H2.
  rewrite (N.log2_unique (key k) (B * N.of_nat (length k))) by (try split; [lia|assumption..]).
  rewrite N.mul_comm. apply N.div_mul. lia.
Qed.

(** [WIDE-9] Nodes and keys belong to each other one to one. *)
Theorem key_injective k : 0 < B -> forall k', slots_below k -> slots_below k' -> key k = key k' -> k = k'.
Proof.
  intros HB k' Hk Hk' E. assert (Hl : length k = length k').
  { apply Nat2N.inj. rewrite <- (key_level k), <- (key_level k') by assumption. now rewrite E. }
  revert k' Hk' Hl E. induction Hk as [|s k Hs _ IH]; intros k' Hk' Hl E;
    destruct Hk' as [|s' k' Hs' Hk']; try discriminate; [reflexivity|].
  simpl in *. injection Hl as Hl. assert (E1 : s = s').
  { rewrite <- (mod_back B (key k) s), <- (mod_back B (key k') s') by assumption. now f_equal. }
  subst s'. f_equal. apply IH; [assumption..|]. pose proof A_positive. nia.
Qed.

(** The way from a key to its node. *)
Fixpoint unkey (fuel : nat) (k : N) : path :=
  match fuel with
  | O => []
  | Datatypes.S fuel => if k <=? 1 then [] else k mod A :: unkey fuel (k / A)
  end.

Definition path_of_key (k : N) : path := unkey (N.to_nat (N.size k)) k.

(** [WIDE-9] There is a way from keys to nodes. *)
Theorem path_of_key_is k : 0 < B -> slots_below k -> path_of_key (key k) = k.
Proof.
  intros HB Hk. assert (G : forall fuel, (length k < fuel)%nat -> unkey fuel (key k) = k).
  { induction Hk as [|s k Hs Hk IH]; intros [|fuel] Hf; simpl in Hf; try lia; [reflexivity|]. simpl.
    destruct (key_bits k Hk) as [H1 _]. pose proof (pow_positive (B * N.of_nat (length k))). pose proof A_positive.
    assert (2 <= A). { unfold A. change 2 with (2 ^ 1) at 1. apply N.pow_le_mono_r; lia. }
    destruct (N.leb_spec (key k * A + s) 1); [nia|]. unfold A at 1 3. f_equal; [now apply (mod_back B)|].
    fold A. rewrite N.div_add_l, N.div_small, N.add_0_r by lia. apply IH. lia. }
  apply G. destruct (key_bits k Hk) as [H1 _]. pose proof (pow_positive (B * N.of_nat (length k))).
  assert (E : key k <> 0) by lia. rewrite N.size_log2 by exact E. apply N.log2_le_pow2 in H1; [|lia]. nia.
Qed.

(** ** Trails *)

(** [WIDE-14] A trail has a group of [A] bits for each level above the node. *)
Theorem trail_bits ls : groups_below ls -> trail ls < 2 ^ (A * N.of_nat (length ls)).
Proof.
  induction 1 as [|g ls Hg _ IH]; [rewrite N.mul_0_r; simpl; lia|]. simpl length. simpl trail.
  replace (A * N.of_nat (S (length ls))) with (A + A * N.of_nat (length ls)) by lia. rewrite N.pow_add_r.
  nia.
Qed.

(** [WIDE-14] So words of [W] bits are enough for as many levels above the node as groups of [A] bits, and for as many as
    groups of [B] bits below the first bit. *)
Theorem word_levels W k ls : slots_below k -> groups_below ls ->
  (A * N.of_nat (length ls) <= W -> trail ls < 2 ^ W) /\ (1 + B * N.of_nat (length k) <= W -> key k < 2 ^ W).
Proof.
  intros Hk Hl. pose proof (trail_bits ls Hl). destruct (key_bits k Hk) as [_ H1].
  split; intros HW; eapply N.lt_le_trans; try eassumption; apply N.pow_le_mono_r; lia.
Qed.

(** The number of trailing zeros, as a number. *)
Definition zeros (t : N) : N := N.of_nat (Machine.ctz t).

Lemma zeros_spec t : t <> 0 -> N.testbit t (zeros t) = true /\ forall i, i < zeros t -> N.testbit t i = false.
Proof.
  intros H. destruct (Bits.ctz_lowest t H) as [H1 H2]. split; [exact H1|]. intros i Hi. rewrite <- (N2Nat.id i).
  apply H2. unfold zeros in Hi. lia.
Qed.

Lemma zeros_unique t n : N.testbit t n = true -> (forall i, i < n -> N.testbit t i = false) -> zeros t = n.
Proof.
  intros H1 H2. assert (H0 : t <> 0) by (intros ->; rewrite N.bits_0 in H1; discriminate).
  destruct (zeros_spec t H0) as [Z1 Z2]. destruct (N.lt_total n (zeros t)) as [H|[H|H]]; [|auto|].
  - rewrite (Z2 n H) in H1. discriminate.
  - rewrite (H2 _ H) in Z1. discriminate.
Qed.

(** The bits of a number above and one below. *)
Lemma bits_below n x y i : y < 2 ^ n -> N.testbit (x * 2 ^ n + y) i = if i <? n then N.testbit y i else N.testbit x (i - n).
Proof.
  intros H. destruct (N.ltb_spec i n) as [Hi|Hi].
  - rewrite <- (mod_back n x y H) at 2. now rewrite N.mod_pow2_bits_low.
  - rewrite <- (shift_back n x y H) at 2. rewrite N.shiftr_spec'. f_equal. lia.
Qed.

Lemma above_range n y i : y < 2 ^ n -> n <= i -> N.testbit y i = false.
Proof. intros H Hi. rewrite <- (N.mod_small _ _ H). now apply N.mod_pow2_bits_high. Qed.

(** Trailing zeros end in the lowest group that is not empty. *)
Lemma zeros_group x g : g <> 0 -> g < 2 ^ A -> zeros (x * 2 ^ A + g) = zeros g /\ zeros g < A.
Proof.
  intros H0 Hg. destruct (zeros_spec g H0) as [Z1 Z2]. assert (Hz : zeros g < A).
  { apply N.nle_gt. intros Hz. rewrite (above_range _ _ _ Hg Hz) in Z1. discriminate. }
  split; [|exact Hz]. apply zeros_unique.
  - rewrite bits_below by exact Hg. apply N.ltb_lt in Hz. now rewrite Hz.
  - intros i Hi. rewrite bits_below by exact Hg. assert (E : i <? A = true) by (apply N.ltb_lt; lia). rewrite E. auto.
Qed.

Lemma zeros_shift x : x <> 0 -> zeros (x * 2 ^ A + 0) = A + zeros x.
Proof.
  intros H0. destruct (zeros_spec x H0) as [Z1 Z2]. pose proof (pow_positive A).
  apply zeros_unique.
  - rewrite bits_below by assumption. destruct (N.ltb_spec (A + zeros x) A); [lia|]. rewrite <- Z1. f_equal. lia.
  - intros i Hi. rewrite bits_below by assumption. destruct (N.ltb_spec i A); [apply N.bits_0|]. apply Z2. lia.
Qed.

(** [WIDE-11] How many levels up the parent's level is from that of the deepest pending set. *)
Definition levels_up (t : N) : N := zeros t / A.

Definition group (t n : N) : N := N.shiftr t (A * n) mod 2 ^ A.

Lemma levels_up_group x g : g <> 0 -> g < 2 ^ A -> levels_up (x * 2 ^ A + g) = 0.
Proof. intros H0 Hg. unfold levels_up. destruct (zeros_group x g H0 Hg) as [-> H]. now apply N.div_small. Qed.

Lemma levels_up_shift x : x <> 0 -> levels_up (x * 2 ^ A + 0) = levels_up x + 1.
Proof.
  intros H0. unfold levels_up. rewrite zeros_shift by exact H0. pose proof A_positive.
  replace (A + zeros x) with (zeros x + 1 * A) by lia. rewrite N.div_add by lia. reflexivity.
Qed.

Lemma shift_level x n : N.shiftr (x * 2 ^ A + 0) (A * (n + 1)) = N.shiftr x (A * n).
Proof.
  replace (A * (n + 1)) with (A + A * n) by lia. rewrite <- N.shiftr_shiftr. rewrite shift_back; [reflexivity|].
  apply pow_positive.
Qed.

Lemma trail_zero ls : trail ls = 0 -> Forall (eq 0) ls.
Proof.
  induction ls as [|g ls IH]; intros H; [constructor|]. simpl in H. pose proof (pow_positive A).
  constructor; [lia|]. apply IH. nia.
Qed.

(** [WIDE-11](1, 2) Of a trail that is not 0, the first [n] groups are empty, the next is not: it is the deepest pending set, [n + 1]
    levels up; and what is above it is the trail there. *)
Theorem trail_back ls : groups_below ls -> trail ls <> 0 ->
  exists zs g rest, ls = zs ++ g :: rest /\ Forall (eq 0) zs /\ g <> 0 /\
    levels_up (trail ls) = N.of_nat (length zs) /\
    group (trail ls) (levels_up (trail ls)) = g /\
    N.shiftr (trail ls) (A * (levels_up (trail ls) + 1)) = trail rest.
Proof.
  induction 1 as [|g ls Hg Hl IH]; [simpl; congruence|]. simpl trail. intros H0.
  destruct (N.eq_dec g 0) as [->|Hn].
  - assert (H1 : trail ls <> 0) by (intros E; rewrite E in H0; simpl in H0; lia).
    destruct (IH H1) as (zs & g & rest & -> & Hz & Hn & E1 & E2 & E3). exists (0 :: zs), g, rest.
    rewrite levels_up_shift by exact H1. split; [reflexivity|]. split; [now constructor|]. split; [exact Hn|].
    split; [rewrite E1; simpl length; lia|]. unfold group in *. rewrite !shift_level. auto.
  - exists [], g, ls. rewrite levels_up_group by assumption. split; [reflexivity|]. split; [constructor|]. split; [exact Hn|].
    split; [reflexivity|]. unfold group. rewrite N.mul_0_r, N.shiftr_0_r. split; [now apply mod_back|].
    rewrite N.add_0_l, N.mul_1_r. now apply shift_back.
Qed.

(** ** The machine of a key and a trail *)

(** A way from keys to nodes. *)
Variable node : N -> path.

(** To the deepest ancestor with pending children, and on from there if these are beyond. [fuel] is for the levels. *)
Fixpoint back_numbers (fuel : nat) (ans : path -> list N) (e : N) (k t : N) : option (N * N) :=
  match fuel with
  | O => None
  | Datatypes.S fuel =>
      if t =? 0 then None
      else
        let n := levels_up t in
        let a := N.shiftr k (B * (n + 1)) in
        let t' := N.shiftr t (A * (n + 1)) in
        match take (trail_keeper B) (ans (node a)) e (group t n) with
        | Some (s, g) => Some (a * A + s, t' * 2 ^ A + g)
        | None => back_numbers fuel ans e a t'
        end
  end.

Definition number_machine : machine := {|
  state := N * N;
  start := (1, 0);
  path_of s := node (fst s);
  age s := s;
  descend r rs e '(k, t) := (k * A + slot B r, t * 2 ^ A + slots_of B rs);
  back ans e '(k, t) := back_numbers (N.to_nat (N.size t)) ans e k t |}.

Definition numbers (s : path * list N) : N * N := (key (fst s), trail (snd s)).

(** A set of slots is a group. *)
Lemma below_bits n x : (forall i, n <= i -> N.testbit x i = false) -> x < 2 ^ n.
Proof.
  intros H. assert (E : x mod 2 ^ n = x).
  { apply N.bits_inj. intros i. destruct (N.lt_ge_cases i n); [now apply N.mod_pow2_bits_low|].
    rewrite N.mod_pow2_bits_high by assumption. symmetry. auto. }
  rewrite <- E. apply N.mod_upper_bound. pose proof (pow_positive n). lia.
Qed.

Lemma slot_below r : slot B r < A.
Proof. unfold slot. apply N.mod_upper_bound. apply N.pow_nonzero. lia. Qed.

Lemma slots_of_below rs : slots_of B rs < 2 ^ A.
Proof.
  apply below_bits. intros i Hi. rewrite slots_spec. destruct (existsb _ rs) eqn:E; [|reflexivity].
  apply existsb_exists in E. destruct E as (r & _ & E). apply N.eqb_eq in E. pose proof (slot_below r). lia.
Qed.

Lemma take_below ans e g s g' : g < 2 ^ A -> take (trail_keeper B) ans e g = Some (s, g') -> s < A /\ g' < 2 ^ A.
Proof.
  intros Hg. simpl. destruct (filter _ ans) as [|r rs]; [discriminate|]. destruct (beyond B e r); [discriminate|].
  intros [= <- <-]. split; [apply slot_below|]. apply below_bits. intros i Hi. rewrite N.clearbit_eqb.
  now rewrite (above_range A g i).
Qed.

Lemma take_nothing ans e : take (trail_keeper B) ans e 0 = None.
Proof. simpl. now rewrite pend_none. Qed.

Lemma size_below t : t < 2 ^ N.of_nat (N.to_nat (N.size t)).
Proof. rewrite N2Nat.id. apply N.size_gt. Qed.

(** The way back on numbers is that of the levels. *)
Lemma back_numbers_spec ans e : (forall k, slots_below k -> node (key k) = k) ->
  forall k ls fuel, slots_below k -> groups_below ls -> length ls = length k -> trail ls < 2 ^ N.of_nat fuel ->
  back_numbers fuel ans e (key k) (trail ls) = option_map numbers (back_levels (trail_keeper B) ans e k ls) /\
  (forall k' ls', back_levels (trail_keeper B) ans e k ls = Some (k', ls') ->
    slots_below k' /\ groups_below ls' /\ length ls' = length k').
Proof.
  intros Hnode. induction k as [|s k IH]; intros [|g ls] fuel Hk Hls Hlen Hf; try discriminate.
  - split; [|discriminate]. destruct fuel; reflexivity.
  - inversion_clear Hk. inversion_clear Hls. injection Hlen as Hlen. cbn [back_levels].
    destruct (N.eq_dec g 0) as [->|Hg].
    + rewrite take_nothing. assert (Hf' : trail ls < 2 ^ N.of_nat fuel).
      { simpl in Hf. pose proof (pow_positive A). nia. }
      destruct (IH ls fuel) as [IH1 IH2]; [assumption..|]. split; [|exact IH2]. rewrite <- IH1.
      destruct fuel as [|fuel]; [reflexivity|]. cbn [back_numbers]. simpl trail. simpl key.
      destruct (N.eqb_spec (trail ls) 0) as [E|E]; [rewrite E; reflexivity|].
      assert (E1 : trail ls * 2 ^ A + 0 =? 0 = false).
      { apply N.eqb_neq. pose proof (pow_positive A). nia. }
      rewrite E1. rewrite levels_up_shift by exact E. set (n := levels_up (trail ls)). unfold group. rewrite !shift_level.
      replace (B * (n + 1 + 1)) with (B + B * (n + 1)) by lia. rewrite <- !(N.shiftr_shiftr _ B), !key_parent by assumption.
      reflexivity.
    + destruct fuel as [|fuel]; [simpl in Hf; pose proof (pow_positive A); nia|]. cbn [back_numbers].
      simpl trail. simpl key.
      assert (E1 : trail ls * 2 ^ A + g =? 0 = false) by (apply N.eqb_neq; lia). rewrite E1.
      rewrite levels_up_group by assumption. unfold group. rewrite N.mul_0_r, N.shiftr_0_r, N.add_0_l, !N.mul_1_r.
      rewrite mod_back, shift_back, !key_parent by assumption. rewrite Hnode by assumption.
      destruct (take (trail_keeper B) (ans k) e g) as [[s' g']|] eqn:Ht.
      * destruct (take_below (ans k) e g s' g') as [Hs' Hg']; [assumption..|].
        split; [reflexivity|]. intros k' ls' [= <- <-].
        split; [now constructor|]. split; [now constructor|]. simpl. now rewrite Hlen.
      * apply IH; try assumption. cbn [trail] in Hf. rewrite Nnat.Nat2N.inj_succ, N.pow_succ_r' in Hf.
        assert (2 <= 2 ^ A). { change 2 with (2 ^ 1) at 1. apply N.pow_le_mono_r; [lia|]. pose proof A_positive. lia. }
        nia.
Qed.

Variable T : wide.
Variable S : search.
Hypothesis F : fair B T S.
Hypothesis nodes : forall k, slots_below k -> node (key k) = k.

(** The numbers stand for levels. *)
Definition stands_for (s : N * N) (k : path) (p : list (path * N)) (h : history) : Prop :=
  exists ls, s = (key k, trail ls) /\ slots_below k /\ groups_below ls /\ length ls = length k /\
    stands B (trail_keeper B) S (trail_holds B S) h k ls p.

Lemma numbers_refine : refines B number_machine T S stands_for.
Proof.
  pose proof (levels_refine B (trail_keeper B) T S (trail_holds B S) F (trail_keeps B T S F)) as L. unfold stands_for.
  split; simpl.
  - exists []. repeat split; constructor.
  - intros s k p h (ls & -> & Hk & _). apply nodes, Hk.
  - intros s k p h (ls & -> & Hk & Hl & Hn & H). exists ls. unfold seen. simpl.
    split; [now destruct (edge S (k :: h) =? edge S h)|]. repeat split; try assumption.
    pose proof (r_seen _ _ _ _ _ L (k, ls) k p h (conj eq_refl H)) as [_ H1]. unfold seen in H1. simpl in H1.
    rewrite map_id in H1. now destruct (edge S (k :: h) =? edge S h).
  - intros s k p h r rs child (ls & -> & Hk & Hl & Hn & H) Ht Ha Hb. exists (slots_of B rs :: ls).
    split; [reflexivity|]. split; [constructor; [apply slot_below|exact Hk]|].
    split; [constructor; [apply slots_of_below|exact Hl]|]. split; [simpl; now rewrite Hn|].
    exact (proj2 (r_descend _ _ _ _ _ L (k, ls) k p h r rs child (conj eq_refl H) Ht Ha Hb)).
  - intros s k a r p h (ls & -> & Hk & Hl & Hn & H) Hb. exists ls. repeat split; try assumption.
    exact (proj2 (r_skip _ _ _ _ _ L (k, ls) k a r p h (conj eq_refl H) Hb)).
  - intros s k a r p h (ls & -> & Hk & Hl & Hn & H) Hb.
    destruct (r_next _ _ _ _ _ L (k, ls) k a r p h (conj eq_refl H) Hb) as ([k' ls'] & Hs & Ek & H'). simpl in *. subst k'.
    destruct (back_numbers_spec (now S h) (edge S h) nodes k ls (N.to_nat (N.size (trail ls)))) as [E1 E2];
      [assumption..|apply size_below|]. rewrite Hs in E1, E2. destruct (E2 _ _ eq_refl) as (H1 & H2 & H3).
    exists (key (slot B r :: a), trail ls'). split; [exact E1|]. exists ls'. auto.
  - intros s k h (ls & -> & Hk & Hl & Hn & H). pose proof (r_done _ _ _ _ _ L (k, ls) k h (conj eq_refl H)) as Hs.
    simpl in Hs. destruct (back_numbers_spec (now S h) (edge S h) nodes k ls (N.to_nat (N.size (trail ls)))) as [E1 _];
      [assumption..|apply size_below|]. now rewrite Hs in E1.
Qed.

(** [WIDE-13, WIDE-11, WIDE-7] A key and a trail, with a way from keys to nodes, have the reference's visits and answer. *)
Theorem wide_numbers_reference fuel : (length (snd (reference B S T)) <= fuel)%nat ->
  run B number_machine T S fuel (start number_machine) [] = Some (reference B S T).
Proof. exact (refines_reference B number_machine T S stands_for F numbers_refine fuel). Qed.

(** [WIDE-14] At a node of level [d] the trail has [A d] bits, and the key [1 + B d]. *)
Theorem wide_numbers_range k t h : reached B number_machine T S (k, t) h ->
  let d := N.of_nat (length (node k)) in t < 2 ^ (A * d) /\ k < 2 ^ (1 + B * d).
Proof.
  intros H. destruct (reached_refines B number_machine T S stands_for numbers_refine _ _ H)
    as (q & p & ls & E & Hk & Hl & Hn & _). injection E as -> ->. rewrite nodes by exact Hk.
  split; [rewrite <- Hn; now apply trail_bits|now apply key_bits].
Qed.

End Numbers.

(** [WIDE-14] For eight children: trails of 8 and 16 levels, and keys of 21, no more. *)
Example eight_children : A 3 = 8 /\ 64 / A 3 = 8 /\ 128 / A 3 = 16 /\ (64 - 1) / 3 = 21.
Proof. repeat split. Qed.
