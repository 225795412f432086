(** Exact sums: a whole number that is added at any place of a register adds that, with all carries, and the order of two registers is
    that of what they hold. The functions are those of src/geom/kernel/exact/accumulator.rs on whole numbers; limbs are below 2^64, the
    lowest first. *)
From Coq Require Import ZArith List Bool Lia.
Import ListNotations.
Open Scope Z_scope.

Definition base := 2 ^ 64.

Definition limb x := 0 <= x < base.

Fixpoint value limbs := match limbs with [] => 0 | x :: rest => x + base * value rest end.

(** [overflowing_add] *)
Definition overflowing x y := ((x + y) mod base, base <=? x + y).

(** One limb, what is added to it, and the carry. *)
Definition step x part carry :=
  let (sum, first) := overflowing x part in
  let (sum, second) := overflowing sum (Z.b2z carry) in
  (sum, first || second).

(** The limbs above, as long as there is a carry; whether one is left. *)
Fixpoint above limbs (carry : bool) :=
  match limbs with
  | [] => ([], carry)
  | x :: rest => if carry then let (sum, carry) := overflowing x 1 in let (rest, carry) := above rest carry in (sum :: rest, carry) else (limbs, false)
  end.

Fixpoint from_here limbs parts carry :=
  match limbs, parts with
  | x :: limbs, part :: parts => let (sum, carry) := step x part carry in let (rest, carry) := from_here limbs parts carry in (sum :: rest, carry)
  | _, _ => above limbs carry
  end.

(** The words of a number times 2^shift. *)
Definition over shift x := Z.shiftr (Z.shiftr x 1) (63 - shift).
Definition left shift x := Z.shiftl x shift mod base.
Definition shifted shift low middle high :=
  [left shift low; Z.lor (left shift middle) (over shift low); Z.lor (left shift high) (over shift middle); over shift high].

Definition add limbs low middle high place :=
  let k := Z.to_nat (place / 64) in
  let (rest, carry) := from_here (skipn k limbs) (shifted (place mod 64) low middle high) false in
  (firstn k limbs ++ rest, carry).

(** [sign]: from the highest limbs down. *)
Fixpoint compare xs ys :=
  match xs, ys with
  | x :: xs, y :: ys => match x ?= y with Eq => compare xs ys | order => order end
  | _, _ => Eq
  end.

(** The three words of a product of numbers below 2^53. *)
Definition product a b c :=
  let low := (a * b) mod base * c in
  let high := (a * b) / base * c + low / base in
  [low mod base; high mod base; high / base].

Lemma value_bound limbs : Forall limb limbs -> 0 <= value limbs < base ^ Z.of_nat (length limbs).
Proof.
  induction 1 as [|x rest Hx _ IH]; [cbn; lia|]. cbn [value length]. rewrite Nat2Z.inj_succ, Z.pow_succ_r by lia.
  unfold limb in Hx. assert (0 < base) by (unfold base; lia). nia.
Qed.

Lemma value_app xs ys : value (xs ++ ys) = value xs + base ^ Z.of_nat (length xs) * value ys.
Proof.
  induction xs as [|x xs IH]; [cbn [app value length]; rewrite Z.pow_0_r; lia|]. cbn [app value length]. rewrite IH, Nat2Z.inj_succ, Z.pow_succ_r by lia. ring.
Qed.

Lemma overflowing_is_right x y : limb x -> limb y -> let (sum, carry) := overflowing x y in limb sum /\ sum + base * Z.b2z carry = x + y.
Proof.
  unfold overflowing, limb. intros Hx Hy. assert (Hb : 0 < base) by (unfold base; lia). split; [now apply Z.mod_pos_bound|].
  destruct (Z.leb_spec base (x + y)) as [H|H]; cbn [Z.b2z].
  - rewrite <- (Z.mod_unique (x + y) base 1 (x + y - base)) by lia. lia.
  - rewrite Z.mod_small by lia. lia.
Qed.

Lemma limb_carry carry : limb (Z.b2z carry).
Proof. destruct carry; unfold limb, base; cbn; lia. Qed.

Lemma step_is_right x part carry : limb x -> limb part ->
  let (sum, out) := step x part carry in limb sum /\ sum + base * Z.b2z out = x + part + Z.b2z carry.
Proof.
  intros Hx Hp. unfold step. generalize (overflowing_is_right x part Hx Hp). destruct (overflowing x part) as [s first]. intros [Hs Es].
  generalize (overflowing_is_right s (Z.b2z carry) Hs (limb_carry carry)). destruct (overflowing s (Z.b2z carry)) as [s' second]. intros [Hs' Es'].
  split; [easy|]. unfold limb in *. destruct first, second, carry; cbn [orb Z.b2z] in *; lia.
Qed.

Lemma above_is_right limbs : forall carry, Forall limb limbs -> let (new, out) := above limbs carry in
  Forall limb new /\ length new = length limbs /\
  value new + base ^ Z.of_nat (length limbs) * Z.b2z out = value limbs + Z.b2z carry.
Proof.
  induction limbs as [|x rest IH]; intros carry H; [cbn [above value length]; rewrite Z.pow_0_r; split; [constructor|split; [reflexivity|lia]]|].
  inversion_clear H as [|? ? Hx Hr]. cbn [above]. destruct carry.
  2: { cbn [Z.b2z value]. rewrite Z.mul_0_r. split; [now constructor|split; [reflexivity|lia]]. }
  generalize (overflowing_is_right x 1 Hx (limb_carry true)). destruct (overflowing x 1) as [sum carry]. intros [Hs Es].
  specialize (IH carry Hr). destruct (above rest carry) as [new out]. destruct IH as [Hn [Hl E]].
  cbn [value length]. rewrite Nat2Z.inj_succ, Z.pow_succ_r, Hl by lia. split; [now constructor|split; [now rewrite ?Hl|]]. cbn [Z.b2z] in *. nia.
Qed.

Lemma from_here_is_right limbs : forall parts carry, Forall limb limbs -> Forall limb parts -> (length parts <= length limbs)%nat ->
  let (new, out) := from_here limbs parts carry in
  Forall limb new /\ length new = length limbs /\
  value new + base ^ Z.of_nat (length limbs) * Z.b2z out = value limbs + value parts + Z.b2z carry.
Proof.
  induction limbs as [|x limbs IH]; intros parts carry Hl Hp H.
  { destruct parts as [|? ?]; [|cbn in H; lia]. cbn [from_here above value length]. rewrite Z.pow_0_r. split; [constructor|split; [reflexivity|lia]]. }
  destruct parts as [|part parts].
  { cbn [from_here]. generalize (above_is_right (x :: limbs) carry Hl). destruct (above (x :: limbs) carry) as [new out]. cbn [value]. intros [Hn [Hle E]]. split; [exact Hn|split; [exact Hle|lia]]. }
  inversion_clear Hl as [|? ? Hx Hl']. inversion_clear Hp as [|? ? Hpart Hp']. cbn [from_here].
  generalize (step_is_right x part carry Hx Hpart). destruct (step x part carry) as [sum carry']. intros [Hs Es].
  specialize (IH parts carry' Hl' Hp' ltac:(cbn in H; lia)). destruct (from_here limbs parts carry') as [new out]. destruct IH as [Hn [Hle E]].
  cbn [value length]. rewrite Nat2Z.inj_succ, Z.pow_succ_r, Hle by lia. split; [now constructor|split; [reflexivity|]]. nia.
Qed.

Lemma lor_is_sum shift x y : 0 <= shift -> 0 <= y < 2 ^ shift -> Z.lor (left shift x) y = left shift x + y.
Proof.
  intros Hs Hy. unfold left, base. assert (Z.land (Z.shiftl x shift mod 2 ^ 64) y = 0) as H.
  { apply Z.bits_inj'. intros n Hn. rewrite Z.land_spec, Z.bits_0. destruct (Z.lt_ge_cases n shift) as [L|L].
    - destruct (Z.lt_ge_cases n 64); [rewrite Z.mod_pow2_bits_low by lia; now rewrite Z.shiftl_spec_low|].
      now rewrite Z.mod_pow2_bits_high by lia.
    - rewrite <- (Z.mod_small y (2 ^ shift)) by lia. rewrite (Z.mod_pow2_bits_high y) by lia. apply andb_false_r. }
  now rewrite <- Z.lxor_lor, <- Z.add_nocarry_lxor by exact H.
Qed.

Lemma over_is_quotient shift x : 0 <= shift < 64 -> over shift x = x / 2 ^ (64 - shift).
Proof. intros H. unfold over. rewrite Z.shiftr_shiftr by lia. rewrite Z.shiftr_div_pow2 by lia. do 2 f_equal. lia. Qed.

Lemma word_is_split shift x : 0 <= shift < 64 -> limb x ->
  left shift x + base * over shift x = x * 2 ^ shift /\ limb (left shift x) /\ 0 <= over shift x < 2 ^ shift.
Proof.
  intros H Hx. rewrite over_is_quotient by lia. unfold left. rewrite Z.shiftl_mul_pow2 by lia.
  assert (B : base = 2 ^ (64 - shift) * 2 ^ shift) by (unfold base; rewrite <- Z.pow_add_r by lia; f_equal; lia).
  assert (0 < 2 ^ shift /\ 0 < 2 ^ (64 - shift)) as [P Q] by (split; apply Z.pow_pos_nonneg; lia).
  split; [|split].
  - replace (x / 2 ^ (64 - shift)) with (x * 2 ^ shift / base) by (rewrite B; apply Z.div_mul_cancel_r; lia).
    rewrite Z.add_comm. symmetry. apply Z.div_mod. unfold base. lia.
  - apply Z.mod_pos_bound. unfold base. lia.
  - split; [apply Z.div_pos; unfold limb in Hx; lia|]. apply Z.div_lt_upper_bound; [lia|]. rewrite <- B. apply Hx.
Qed.

Lemma shifted_is_right shift low middle high : 0 <= shift < 64 -> limb low -> limb middle -> limb high ->
  Forall limb (shifted shift low middle high) /\
  value (shifted shift low middle high) = (low + base * middle + base * base * high) * 2 ^ shift.
Proof.
  intros H Hl Hm Hh.
  destruct (word_is_split shift low H Hl) as [El [Ll Ol]], (word_is_split shift middle H Hm) as [Em [Lm Om]], (word_is_split shift high H Hh) as [Eh [Lh Oh]].
  unfold shifted. rewrite 2!lor_is_sum by lia. split; [|cbn [value]; nia].
  assert (P : 2 ^ shift <= 2 ^ 63) by (apply Z.pow_le_mono_r; lia).
  (* What is shifted left has no bits below the place. *)
  assert (Room : forall x y, limb x -> 0 <= y < 2 ^ shift -> limb (left shift x + y)).
  { intros x y Hx Hy. destruct (word_is_split shift x H Hx) as [Ex [Lx _]]. split; [unfold limb in Lx; lia|].
    assert (B : base = 2 ^ (64 - shift) * 2 ^ shift) by (unfold base; rewrite <- Z.pow_add_r by lia; f_equal; lia).
    assert (M : left shift x = (x mod 2 ^ (64 - shift)) * 2 ^ shift).
    { unfold left. rewrite Z.shiftl_mul_pow2, B by lia. apply Z.mul_mod_distr_r; apply Z.pow_nonzero; lia. }
    assert (0 <= x mod 2 ^ (64 - shift) < 2 ^ (64 - shift)) by (apply Z.mod_pos_bound, Z.pow_pos_nonneg; lia).
    rewrite M, B. nia. }
  repeat apply Forall_cons; auto. unfold limb, base. lia.
Qed.

(** A number that is added at a place adds that, and what is carried out of the register is told. [EXACT-8] *)
Theorem add_adds limbs low middle high place : Forall limb limbs -> limb low -> limb middle -> limb high -> 0 <= place ->
  (Z.to_nat (place / 64) + 4 <= length limbs)%nat ->
  let (new, out) := add limbs low middle high place in
  Forall limb new /\ length new = length limbs /\
  value new + base ^ Z.of_nat (length limbs) * Z.b2z out = value limbs + (low + base * middle + base * base * high) * 2 ^ place.
Proof.
  intros H Hl Hm Hh Hp Room. unfold add. set (k := Z.to_nat (place / 64)) in *.
  assert (0 <= place mod 64 < 64) as Hs by (apply Z.mod_pos_bound; lia).
  destruct (shifted_is_right (place mod 64) low middle high Hs Hl Hm Hh) as [Hw Ew].
  rewrite <- (firstn_skipn k limbs) in H at 1. apply Forall_app in H as [Hf Hk].
  generalize (from_here_is_right (skipn k limbs) (shifted (place mod 64) low middle high) false Hk Hw). rewrite skipn_length.
  intros E. specialize (E ltac:(cbn [shifted length]; lia)).
  destruct (from_here (skipn k limbs) (shifted (place mod 64) low middle high) false) as [new out]. destruct E as [Hn [Ln E]].
  split; [now apply Forall_app|]. split; [rewrite app_length, firstn_length, Ln; lia|].
  assert (V : forall rest, value (firstn k limbs ++ rest) = value (firstn k limbs) + base ^ Z.of_nat k * value rest)
    by (intros rest; rewrite value_app, firstn_length, Nat.min_l by lia; reflexivity).
  generalize (V (skipn k limbs)). rewrite firstn_skipn. intros ->. rewrite V. clear V.
  assert (Kp : base ^ Z.of_nat k * 2 ^ (place mod 64) = 2 ^ place).
  { unfold base, k. rewrite Z2Nat.id by (apply Z.div_pos; lia). rewrite <- Z.pow_mul_r, <- Z.pow_add_r by (try (apply Z.mul_nonneg_nonneg); try apply Z.div_pos; lia).
    f_equal. symmetry. apply Z.div_mod. lia. }
  replace (base ^ Z.of_nat (length limbs)) with (base ^ Z.of_nat k * base ^ Z.of_nat (length limbs - k)) by (rewrite <- Z.pow_add_r by lia; f_equal; lia).
  rewrite Ew in E. cbn [Z.b2z] in E. rewrite <- Kp. nia.
Qed.

(** So there is no carry out of it, and nothing is lost, while there is room. [EXACT-8] *)
Theorem nothing_is_lost limbs low middle high place : Forall limb limbs -> limb low -> limb middle -> limb high -> 0 <= place ->
  (Z.to_nat (place / 64) + 4 <= length limbs)%nat ->
  value limbs + (low + base * middle + base * base * high) * 2 ^ place < base ^ Z.of_nat (length limbs) ->
  value (fst (add limbs low middle high place)) = value limbs + (low + base * middle + base * base * high) * 2 ^ place.
Proof.
  intros H Hl Hm Hh Hp Room Small. generalize (add_adds limbs low middle high place H Hl Hm Hh Hp Room).
  destruct (add limbs low middle high place) as [new out]. intros [Hn [Ln E]]. cbn [fst].
  destruct (value_bound new Hn) as [Low _]. destruct out; cbn [Z.b2z] in E; lia.
Qed.

Lemma compare_app xs : forall ys x y, length xs = length ys ->
  compare (xs ++ [x]) (ys ++ [y]) = match compare xs ys with Eq => x ?= y | order => order end.
Proof.
  induction xs as [|a xs IH]; intros [|b ys] x y H; try easy; cbn [app compare].
  - now destruct (x ?= y).
  - destruct (a ?= b); try easy. apply IH. now injection H.
Qed.

(** The order from the highest limbs down is that of what they hold. [EXACT-8] *)
Theorem sign_is_right xs : forall ys, Forall limb xs -> Forall limb ys -> length xs = length ys ->
  compare (rev xs) (rev ys) = (value xs ?= value ys).
Proof.
  induction xs as [|x xs IH]; intros [|y ys] Hx Hy L; try easy.
  inversion_clear Hx as [|? ? Lx Hx']. inversion_clear Hy as [|? ? Ly Hy']. injection L as L. cbn [rev value].
  rewrite compare_app by (now rewrite 2!rev_length). rewrite (IH ys Hx' Hy' L). unfold limb in *. symmetry.
  destruct (Z.compare_spec (value xs) (value ys)) as [E|E|E].
  - rewrite E. destruct (Z.compare_spec x y); [apply Z.compare_eq_iff|apply Z.compare_lt_iff|apply Z.compare_gt_iff]; lia.
  - apply Z.compare_lt_iff. nia.
  - apply Z.compare_gt_iff. nia.
Qed.

(** [EXACT-8] *)
Theorem product_is_right a b c : 0 <= a < 2 ^ 53 -> 0 <= b < 2 ^ 53 -> 0 <= c < 2 ^ 53 ->
  Forall limb (product a b c) /\ value (product a b c) = a * b * c.
Proof.
  intros Ha Hb Hc. unfold product. set (low := (a * b) mod base * c). set (high := (a * b) / base * c + low / base).
  assert (P : 0 < base) by (unfold base; lia).
  assert (E : a * b * c = low + base * ((a * b) / base * c)) by (unfold low; rewrite (Z.div_mod (a * b) base) at 1 by lia; ring).
  assert (L : low = base * (low / base) + low mod base) by (apply Z.div_mod; lia).
  assert (H : high = base * (high / base) + high mod base) by (apply Z.div_mod; lia).
  assert (V : value [low mod base; high mod base; high / base] = a * b * c) by (cbn [value]; unfold high in H |- *; nia).
  split; [|exact V]. repeat apply Forall_cons; try (now apply Z.mod_pos_bound). 2: apply Forall_nil.
  assert (N : 0 <= high / base).
  { apply Z.div_pos; [|lia]. unfold high, low. assert (0 <= (a * b) / base) by (apply Z.div_pos; nia). assert (0 <= (a * b) mod base) by (now apply Z.mod_pos_bound).
    assert (0 <= (a * b) mod base * c / base) by (apply Z.div_pos; nia). nia. }
  split; [exact N|]. apply Z.div_lt_upper_bound; [lia|]. cbn [value] in V. generalize (Z.mod_pos_bound low base P), (Z.mod_pos_bound high base P). intros M M'.
  assert (a * b * c < base * base * base) by (assert (a * b < 2 ^ 53 * 2 ^ 53) by nia; assert (a * b * c < 2 ^ 53 * 2 ^ 53 * 2 ^ 53) by nia; unfold base; lia).
  nia.
Qed.
