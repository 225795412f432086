(** [Sum] of src/geom/kernel/exact/sum.rs, and [add_edge] of src/geom/kernel/exact/predicates.rs: the terms add up to the edge function,
    exactly. In double precision with gradual underflow, without a greatest exponent. *)
Require Import Reals ZArith Lia Lra List.
From Flocq Require Import Core Pff2Flocq.
Require Import StacklessExact.Rounding StacklessExact.Range.
Open Scope R_scope.

Local Instance prec_53 : Prec_gt_0 53 := eq_refl.
Notation F := (generic_format radix2 (FLT_exp (-1074) 53)).

(** * The code *)

(** [two_sum]. *)
Definition two_sum (a b : R) : R * R :=
  let sum := R64 (a + b) in
  let b_of_sum := R64 (sum - a) in
  (sum, R64 (R64 (a - R64 (sum - b_of_sum)) + R64 (b - b_of_sum))).

(** [split], by 2^27 + 1. *)
Definition split (a : R) : R * R :=
  let scaled := R64 (134217729 * a) in
  let high := R64 (scaled - R64 (scaled - a)) in
  (high, R64 (a - high)).

(** [two_product]. *)
Definition two_product (a b : R) : R * R :=
  let product := R64 (a * b) in
  let '(a1, a0) := split a in
  let '(b1, b0) := split b in
  (product, R64 (R64 (a0 * b0) - R64 (R64 (R64 (product - R64 (a1 * b1)) - R64 (a0 * b1)) - R64 (a1 * b0)))).

(** [Sum::add]: the terms, from the least on; zeros are left out. *)
Definition kept (x : R) (rest : list R) : list R := if Req_EM_T x 0 then rest else x :: rest.
Fixpoint add (carry : R) (terms : list R) : list R :=
  match terms with
  | nil => kept carry nil
  | term :: others => let '(sum, rest) := two_sum carry term in kept rest (add sum others)
  end.

(** [Sum::add_product]: a b c, where a and b are sums of two. Zeros are skipped. *)
Definition add_part (c : R) (terms : list R) (part : R) : list R :=
  let '(high, low) := two_product part c in add high (add low terms).
Definition add_two (c : R) (terms : list R) (ab : R * R) : list R :=
  if Req_EM_T (fst ab) 0 then terms else if Req_EM_T (snd ab) 0 then terms else
  let '(high, low) := two_product (fst ab) (snd ab) in add_part c (add_part c terms low) high.
Definition add_product (a b : R * R) (c : R) (terms : list R) : list R :=
  if Req_EM_T c 0 then terms else
  fold_left (add_two c) ((fst a, fst b) :: (fst a, snd b) :: (snd a, fst b) :: (snd a, snd b) :: nil) terms.

(** [difference] and [minus]: the exact difference as two numbers. *)
Definition difference (a b : R) : R * R := two_sum a (- b).

(** [add_edge]: adds d . (a x b). *)
Definition pairs : Type := (R * R) * (R * R) * (R * R).
Definition add_axis (ai aj bi bj : R * R) (d : R) (terms : list R) : list R := add_product aj bi (- d) (add_product ai bj d terms).
Definition add_edge (dx dy dz : R) (a b : pairs) (terms : list R) : list R :=
  let '(ax, ay, az) := a in
  let '(bx, by_, bz) := b in
  add_axis ax ay bx by_ dz (add_axis az ax bz bx dy (add_axis ay az by_ bz dx terms)).

(** * It is exact *)

Definition total (terms : list R) : R := fold_right Rplus 0 terms.
Definition pair_sum (p : R * R) : R := fst p + snd p.

Lemma F_R64 x : F (R64 x).
Proof. apply generic_format_round; typeclasses eauto. Qed.

(** Knuth. [EXACT-8] *)
Theorem two_sum_is_exact a b : F a -> F b -> pair_sum (two_sum a b) = a + b.
Proof.
  intros A B. apply (TwoSum_correct (-1074) 53 (fun x => negb (Z.even x))); try assumption; try lia.
  intros x. replace (- (x + 1))%Z with (- x - 1)%Z by lia. rewrite Z.even_sub, Z.even_opp. now destruct (Z.even x).
Qed.

(** Dekker and Veltkamp. *)
Lemma dekker a b : F a -> F b -> (a * b = 0 \/ bpow radix2 (-969) <= Rabs (a * b) -> a * b = pair_sum (two_product a b)) /\
  Rabs (a * b - pair_sum (two_product a b)) <= 7 / 2 * bpow radix2 (-1074).
Proof.
  intros A B. pose proof (Dekker radix2 (-1074) 53 (fun x => negb (Z.even x)) ltac:(lia) ltac:(lia) b a B A (or_introl eq_refl)) as D.
  rewrite (Rmult_comm a b).
  match type of D with (_ -> _ = ?s) /\ _ => enough (pair_sum (two_product a b) = s) as -> by exact D end. clear D.
  unfold pair_sum, two_product, split. cbn [fst snd].
  change (bpow radix2 (53 - Z.div2 53)) with (IZR 134217728).
  replace (IZR 134217728 + 1) with 134217729 by lra.
  assert (O : forall x, R64 (- x) = - R64 x) by (intros; apply round_NE_opp).
  rewrite !(Rmult_comm 134217729).
  assert (S : forall x p, R64 (p - R64 (p - x)) = R64 (R64 (x - p) + p)).
  { intros x p. f_equal. replace (x - p) with (- (p - x)) by ring. rewrite O. ring. }
  rewrite !S. rewrite (Rmult_comm a b). f_equal.
  set (hb := R64 (R64 (b - _) + _)). set (ha := R64 (R64 (a - _) + _)). set (tb := R64 (b - hb)). set (ta := R64 (a - ha)). set (r := R64 (b * a)).
  rewrite (Rmult_comm ta tb), (Rmult_comm ha hb), (Rmult_comm ta hb), (Rmult_comm ha tb).
  replace (- r + R64 (hb * ha)) with (- (r - R64 (hb * ha))) by ring. rewrite O.
  replace (- R64 (r - R64 (hb * ha)) + R64 (hb * ta)) with (- (R64 (r - R64 (hb * ha)) - R64 (hb * ta))) by ring. rewrite O.
  match goal with |- context [- ?k + R64 (tb * ha)] => replace (- k + R64 (tb * ha)) with (- (k - R64 (tb * ha))) by ring end. rewrite O.
  f_equal. ring.
Qed.

(** For products that are 0 or far from underflow it is exact. [EXACT-8] *)
Theorem two_product_is_exact a b : F a -> F b -> a * b = 0 \/ bpow radix2 (-969) <= Rabs (a * b) -> pair_sum (two_product a b) = a * b.
Proof. intros A B H. symmetry. now apply dekker. Qed.
(** Of others little is lost. [NEAR-5] *)
Theorem two_product_is_near a b : F a -> F b -> Rabs (a * b - pair_sum (two_product a b)) <= 7 / 2 * bpow radix2 (-1074).
Proof. intros A B. now apply dekker. Qed.

(** What is known of the terms, and of numbers on a grid. *)
Definition good (g : Z) (x : R) : Prop := F x /\ multiple g x.

Lemma kept_total x rest : total (kept x rest) = x + total rest.
Proof. unfold kept. destruct (Req_EM_T x 0) as [-> |]; simpl; [ring|reflexivity]. Qed.

Lemma kept_F x rest : F x -> Forall F rest -> Forall F (kept x rest).
Proof. intros X H. unfold kept. destruct (Req_EM_T x 0); [exact H|now constructor]. Qed.

(** [Sum::add] loses nothing. [EXACT-8] *)
Theorem add_is_exact terms : forall x, F x -> Forall F terms -> total (add x terms) = total terms + x /\ Forall F (add x terms).
Proof.
  induction terms as [|t terms IH]; intros x X T.
  - simpl. rewrite kept_total. split; [simpl; ring|]. now apply kept_F.
  - inversion_clear T as [|? ? Ft Fr]. pose proof (two_sum_is_exact x t X Ft) as E.
    assert (F1 : F (fst (two_sum x t))) by apply F_R64. assert (F2 : F (snd (two_sum x t))) by apply F_R64.
    cbn [add]. unfold pair_sum in E. destruct (two_sum x t) as [sum rest]. simpl fst in *. simpl snd in *.
    destruct (IH sum F1 Fr) as [Es Fs]. rewrite kept_total, Es. split; [simpl; lra|now apply kept_F].
Qed.

(** Both parts of a product are on the grid of the product. *)
Lemma product_parts g h a b : (-969 <= g + h)%Z -> good g a -> good h b ->
  pair_sum (two_product a b) = a * b /\ good (g + h) (fst (two_product a b)) /\ good (g + h) (snd (two_product a b)).
Proof.
  intros H [Fa Ma] [Fb Mb]. pose proof (multiple_mult _ _ _ _ Ma Mb) as M.
  assert (E : pair_sum (two_product a b) = a * b).
  { apply two_product_is_exact; try assumption. destruct (multiple_big _ _ M) as [Z|B]; [now left|right].
    eapply Rle_trans; [apply bpow_le, H|exact B]. }
  assert (M1 : multiple (g + h) (fst (two_product a b))).
  { unfold two_product. destruct (split a), (split b). simpl fst. destruct (same (g + h) (a * b) ltac:(lia) M) as [-> M']. exact M'. }
  split; [exact E|split; split; try exact M1].
  - unfold two_product. destruct (split a), (split b). apply F_R64.
  - unfold two_product. destruct (split a), (split b). apply F_R64.
  - replace (snd (two_product a b)) with (a * b - fst (two_product a b)) by (rewrite <- E; unfold pair_sum; ring). now apply multiple_minus.
Qed.

Section Grid.
Variable g : Z.
Hypothesis Hg : (-323 <= g)%Z.

Lemma add_part_total h c terms part : (-969 <= h + g)%Z -> good h part -> good g c -> Forall F terms ->
  total (add_part c terms part) = total terms + part * c /\ Forall F (add_part c terms part).
Proof.
  intros H P C T. destruct (product_parts h g part c H P C) as (E & (F1 & _) & (F2 & _)). unfold add_part, pair_sum in *.
  destruct (two_product part c) as [high low]. simpl fst in *. simpl snd in *.
  destruct (add_is_exact terms low F2 T) as [E1 T1]. destruct (add_is_exact _ high F1 T1) as [E2 T2]. split; [lra|exact T2].
Qed.

Lemma add_two_total c terms ab : good g (fst ab) -> good g (snd ab) -> good g c -> Forall F terms ->
  total (add_two c terms ab) = total terms + fst ab * snd ab * c /\ Forall F (add_two c terms ab).
Proof.
  intros A B C T. unfold add_two. destruct (Req_EM_T (fst ab) 0) as [Z|]; [split; [rewrite Z; ring|exact T]|].
  destruct (Req_EM_T (snd ab) 0) as [Z|]; [split; [rewrite Z; ring|exact T]|].
  destruct (product_parts g g _ _ ltac:(lia) A B) as (E & G1 & G2). unfold pair_sum in E.
  destruct (two_product (fst ab) (snd ab)) as [high low]. simpl fst in *. simpl snd in *.
  destruct (add_part_total (g + g) c terms low ltac:(lia) G2 C T) as [E1 T1].
  destruct (add_part_total (g + g) c _ high ltac:(lia) G1 C T1) as [E2 T2]. split; [|exact T2]. rewrite E2, E1, <- E. ring.
Qed.

Definition pair_good (p : R * R) : Prop := good g (fst p) /\ good g (snd p).

Lemma add_product_total a b c terms : pair_good a -> pair_good b -> good g c -> Forall F terms ->
  total (add_product a b c terms) = total terms + pair_sum a * pair_sum b * c /\ Forall F (add_product a b c terms).
Proof.
  intros [A1 A2] [B1 B2] C T. unfold add_product, pair_sum. destruct (Req_EM_T c 0) as [-> |]; [split; [ring|exact T]|]. cbn [fold_left].
  destruct (add_two_total c terms (fst a, fst b) A1 B1 C T) as [E1 T1]. destruct (add_two_total c _ (fst a, snd b) A1 B2 C T1) as [E2 T2].
  destruct (add_two_total c _ (snd a, fst b) A2 B1 C T2) as [E3 T3]. destruct (add_two_total c _ (snd a, snd b) A2 B2 C T3) as [E4 T4].
  split; [|exact T4]. rewrite E4, E3, E2, E1. simpl. ring.
Qed.

Lemma opp_good x : good g x -> good g (- x).
Proof. intros [X M]. split; [now apply generic_format_opp|now apply multiple_opp]. Qed.

Lemma add_axis_total ai aj bi bj d terms : pair_good ai -> pair_good aj -> pair_good bi -> pair_good bj -> good g d -> Forall F terms ->
  total (add_axis ai aj bi bj d terms) = total terms + d * (pair_sum ai * pair_sum bj - pair_sum aj * pair_sum bi) /\
  Forall F (add_axis ai aj bi bj d terms).
Proof.
  intros Ai Aj Bi Bj D T. unfold add_axis. destruct (add_product_total ai bj d terms Ai Bj D T) as [E1 T1].
  destruct (add_product_total aj bi (- d) _ Aj Bi (opp_good _ D) T1) as [E2 T2]. split; [|exact T2]. rewrite E2, E1. ring.
Qed.

(** [difference]: two numbers that add up to it, on the same grid. *)
Lemma difference_good a b : good g a -> good g b -> pair_sum (difference a b) = a - b /\ pair_good (difference a b).
Proof.
  intros [Fa Ma] [Fb Mb]. pose proof (two_sum_is_exact a (- b) Fa (generic_format_opp _ _ _ Fb)) as E. fold (difference a b) in E.
  assert (M1 : multiple g (fst (difference a b))).
  { unfold difference, two_sum. cbn [fst]. assert (M : multiple g (a + - b)) by (apply multiple_plus; [exact Ma|now apply multiple_opp]).
    destruct (same g (a + - b) ltac:(lia) M) as [-> M']. exact M'. }
  split; [lra|]. split; (split; [apply F_R64|]); [exact M1|].
  replace (snd (difference a b)) with (a - b - fst (difference a b)) by (unfold pair_sum in E; lra).
  apply multiple_minus; [now apply multiple_minus|exact M1].
Qed.

(** The terms of [edge], d . ((a - b) x (b - o)), add up to d . ((a - o) x (b - o)), the edge function of EXACT-2: for all single-precision data, with g = -149,
    and for double-precision data of EXACT-7, with g = -252. [EXACT-8] *)
Theorem edge_is_exact dx dy dz ax ay az bx by_ bz ox oy oz : Forall (good g) (dx :: dy :: dz :: nil) ->
  Forall (good g) (ax :: ay :: az :: nil) -> Forall (good g) (bx :: by_ :: bz :: nil) -> Forall (good g) (ox :: oy :: oz :: nil) ->
  let minus x y z x' y' z' := (difference x x', difference y y', difference z z') in
  total (add_edge dx dy dz (minus ax ay az bx by_ bz) (minus bx by_ bz ox oy oz) nil) =
    dx * ((ay - oy) * (bz - oz) - (az - oz) * (by_ - oy)) + dy * ((az - oz) * (bx - ox) - (ax - ox) * (bz - oz)) +
    dz * ((ax - ox) * (by_ - oy) - (ay - oy) * (bx - ox)).
Proof.
  assert (All : forall x y z, Forall (good g) (x :: y :: z :: nil) -> good g x /\ good g y /\ good g z).
  { intros x y z H. inversion_clear H as [|? ? X H']. inversion_clear H' as [|? ? Y H]. inversion_clear H. split; [assumption|split; assumption]. }
  intros D A B O minus. apply All in D, A, B, O. destruct D as (D1 & D2 & D3), A as (A1 & A2 & A3), B as (B1 & B2 & B3), O as (O1 & O2 & O3).
  destruct (difference_good _ _ A1 B1) as [E1 G1]. destruct (difference_good _ _ A2 B2) as [E2 G2]. destruct (difference_good _ _ A3 B3) as [E3 G3].
  destruct (difference_good _ _ B1 O1) as [K1 L1]. destruct (difference_good _ _ B2 O2) as [K2 L2]. destruct (difference_good _ _ B3 O3) as [K3 L3].
  unfold minus, add_edge.
  destruct (add_axis_total _ _ _ _ dx nil G2 G3 L2 L3 D1 (Forall_nil _)) as [T1 Q1].
  destruct (add_axis_total _ _ _ _ dy _ G3 G1 L3 L1 D2 Q1) as [T2 Q2].
  destruct (add_axis_total _ _ _ _ dz _ G1 G2 L1 L2 D3 Q2) as [T3 _].
  rewrite T3, T2, T1, E1, E2, E3, K1, K2, K3. simpl. ring.
Qed.
End Grid.
