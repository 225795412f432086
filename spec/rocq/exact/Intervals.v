(** Intervals of doubles: [Add], [Sub] and [Mul] of src/geom/interval.rs. What they give holds all sums, differences and products of
    what the operands hold. In double precision with gradual underflow, without a greatest exponent, so no end is infinite. *)
Require Import Reals ZArith Lia Lra Psatz.
From Flocq Require Import Core.
Require Import StacklessExact.Rounding StacklessExact.Range StacklessExact.Expansion.
Open Scope R_scope.

Local Instance prec_53 : Prec_gt_0 53 := eq_refl.
Notation fexp := (FLT_exp (-1074) 53).
Notation pred := (Ulp.pred radix2 fexp).
Notation succ := (Ulp.succ radix2 fexp).

(** * The code *)

Definition interval : Type := R * R.

(** [Add]: an end is moved if rounding left out something on its side. *)
Definition add_below (a b : R) : R := let '(sum, rest) := two_sum a b in if Rle_bool 0 rest then sum else pred sum.
Definition add_above (a b : R) : R := let '(sum, rest) := two_sum a b in if Rle_bool rest 0 then sum else succ sum.
Definition plus (x y : interval) : interval := (add_below (fst x) (fst y), add_above (snd x) (snd y)).

(** [Neg] and [Sub]. *)
Definition opposite (x : interval) : interval := (- snd x, - fst x).
Definition minus (x y : interval) : interval := plus x (opposite y).

(** [is_zero], and [exact_product]: what [two_product] can tell of numbers that are far from over- and underflow. *)
Definition is_zero (x : interval) : bool := andb (Req_bool (fst x) 0) (Req_bool (snd x) 0).
Definition is_exact (a b : R) : bool :=
  let '(product, rest) := two_product a b in
  andb (andb (andb (Rlt_bool (Rabs a) (bpow radix2 500)) (Rlt_bool (Rabs b) (bpow radix2 500))) (Rlt_bool (bpow radix2 (-900)) (Rabs product)))
    (Req_bool rest 0).

(** [Mul]. *)
Definition times (x y : interval) : interval :=
  let '(a, b) := x in
  let '(c, d) := y in
  if orb (is_zero x) (is_zero y) then (0, 0) else
  if andb (andb (Req_bool a b) (Req_bool c d)) (is_exact a c) then (R64 (a * c), R64 (a * c)) else
  let least := Rmin (Rmin (Rmin (R64 (a * c)) (R64 (a * d))) (R64 (b * c))) (R64 (b * d)) in
  let greatest := Rmax (Rmax (Rmax (R64 (a * c)) (R64 (a * d))) (R64 (b * c))) (R64 (b * d)) in
  (pred least, succ greatest).

(** * What they hold *)

Definition holds (x : interval) (r : R) : Prop := fst x <= r <= snd x.
(** Ends are doubles. *)
Definition proper (x : interval) : Prop := F (fst x) /\ F (snd x).

(** A rounded number, moved down by one, is not above the number. [INST-3] *)
Theorem moved_below x : pred (R64 x) <= x.
Proof. apply pred_round_le_id; typeclasses eauto. Qed.
(** Moved up, it is not below. [INST-3] *)
Theorem moved_above x : x <= succ (R64 x).
Proof. apply succ_round_ge_id; typeclasses eauto. Qed.

Lemma two_sum_total a b : F a -> F b -> fst (two_sum a b) = R64 (a + b) /\ fst (two_sum a b) + snd (two_sum a b) = a + b.
Proof. intros A B. split; [reflexivity|exact (two_sum_is_exact a b A B)]. Qed.

Lemma add_below_is a b : F a -> F b -> F (add_below a b) /\ add_below a b <= a + b.
Proof.
  intros A B. unfold add_below. destruct (two_sum_total a b A B) as [E S]. destruct (two_sum a b) as [sum rest]. cbn [fst snd] in *. subst sum.
  destruct (Rle_bool_spec 0 rest); split; [apply F_R64|lra|apply generic_format_pred; [typeclasses eauto|apply F_R64]|apply moved_below].
Qed.
Lemma add_above_is a b : F a -> F b -> F (add_above a b) /\ a + b <= add_above a b.
Proof.
  intros A B. unfold add_above. destruct (two_sum_total a b A B) as [E S]. destruct (two_sum a b) as [sum rest]. cbn [fst snd] in *. subst sum.
  destruct (Rle_bool_spec rest 0); split; [apply F_R64|lra|apply generic_format_succ; [typeclasses eauto|apply F_R64]|apply moved_above].
Qed.

(** Sums. [INST-3] *)
Theorem plus_holds x y r t : proper x -> proper y -> holds x r -> holds y t -> proper (plus x y) /\ holds (plus x y) (r + t).
Proof.
  intros [A B] [A' B'] [H1 H2] [H3 H4]. destruct (add_below_is _ _ A A') as [L1 L2]. destruct (add_above_is _ _ B B') as [G1 G2].
  split; [split; assumption|]. unfold holds, plus. cbn [fst snd]. lra.
Qed.
(** Differences. [INST-3] *)
Theorem minus_holds x y r t : proper x -> proper y -> holds x r -> holds y t -> proper (minus x y) /\ holds (minus x y) (r - t).
Proof.
  intros X [A B] R [H1 H2]. unfold Rminus. apply plus_holds; [exact X| |exact R|]; split; cbn [opposite fst snd]; try lra; now apply generic_format_opp.
Qed.

(** A sum without a rounding error is one number; so translations keep what is known exactly. [INST-3] *)
Theorem plus_exact a b : F a -> F b -> F (a + b) -> plus (a, a) (b, b) = (a + b, a + b).
Proof.
  intros A B G. unfold plus, add_below, add_above. cbn [fst snd]. destruct (two_sum_total a b A B) as [E S]. destruct (two_sum a b) as [sum rest]. cbn [fst snd] in *.
  rewrite round_generic in E by (typeclasses eauto || exact G). assert (rest = 0) as -> by lra. rewrite Rle_bool_true by lra. now subst sum.
Qed.

(** A product is between those of the ends. *)
Lemma corners a b c d r t : a <= r <= b -> c <= t <= d ->
  Rmin (Rmin (Rmin (a * c) (a * d)) (b * c)) (b * d) <= r * t <= Rmax (Rmax (Rmax (a * c) (a * d)) (b * c)) (b * d).
Proof.
  intros R T.
  assert (Low : forall x, Rmin (Rmin (Rmin (a * c) (a * d)) (b * c)) (b * d) <= x \/ (x < a * c /\ x < a * d /\ x < b * c /\ x < b * d)).
  { intros x. unfold Rmin. repeat destruct Rle_dec; destruct (Rle_or_lt (a * c) x), (Rle_or_lt (a * d) x), (Rle_or_lt (b * c) x), (Rle_or_lt (b * d) x); lra. }
  assert (High : forall x, x <= Rmax (Rmax (Rmax (a * c) (a * d)) (b * c)) (b * d) \/ (a * c < x /\ a * d < x /\ b * c < x /\ b * d < x)).
  { intros x. unfold Rmax. repeat destruct Rle_dec; destruct (Rle_or_lt x (a * c)), (Rle_or_lt x (a * d)), (Rle_or_lt x (b * c)), (Rle_or_lt x (b * d)); lra. }
  (* For a fixed r the product is between those with c and d; and those are between the corners. *)
  assert (Line : forall k x lo hi, lo <= x <= hi -> (k * lo <= k * x <= k * hi) \/ (k * hi <= k * x <= k * lo)).
  { intros k x lo hi H. destruct (Rle_or_lt 0 k); [left|right]; split; nra. }
  destruct (Line r t c d T) as [L|L]; destruct (Line c r a b R) as [L1|L1]; destruct (Line d r a b R) as [L2|L2];
    (split; [destruct (Low (r * t)) as [|N]|destruct (High (r * t)) as [|N]]; lra).
Qed.

Lemma R64_mono x y : x <= y -> R64 x <= R64 y.
Proof. intros. now apply round_le; try typeclasses eauto. Qed.
Lemma R64_min x y : Rmin (R64 x) (R64 y) = R64 (Rmin x y).
Proof. destruct (Rle_or_lt x y); [rewrite !Rmin_left|rewrite !Rmin_right]; try apply R64_mono; lra. Qed.
Lemma R64_max x y : Rmax (R64 x) (R64 y) = R64 (Rmax x y).
Proof. destruct (Rle_or_lt x y); [rewrite !Rmax_right|rewrite !Rmax_left]; try apply R64_mono; lra. Qed.

(** What [two_product] says of a product that is not small. *)
Lemma exact_product a b : F a -> F b -> is_exact a b = true -> R64 (a * b) = a * b.
Proof.
  intros A B H. unfold is_exact in H. assert (E : fst (two_product a b) = R64 (a * b)) by (unfold two_product; now destruct (split a), (split b)).
  pose proof (two_product_is_exact a b A B) as T. unfold pair_sum in T. destruct (two_product a b) as [product rest]. cbn [fst snd] in *. subst product.
  apply andb_prop in H as [H Z]. apply andb_prop in H as [_ Big]. revert Z. destruct (Req_bool_spec rest 0) as [->|]; [intros _|discriminate].
  revert Big. destruct (Rlt_bool_spec (bpow radix2 (-900)) (Rabs (R64 (a * b)))) as [L|]; [intros _|discriminate].
  assert (R64 (a * b) + 0 = a * b); [|lra]. apply T. right. apply Rnot_lt_le. intros S. apply (Rlt_not_le _ _ L). rewrite <- round_NE_abs by typeclasses eauto.
  apply round_le_generic; [typeclasses eauto..|apply generic_format_bpow; unfold FLT_exp; lia|].
  apply Rle_trans with (bpow radix2 (-969)); [now apply Rlt_le|now apply bpow_le].
Qed.

(** Products. [INST-3] *)
Theorem times_holds x y r t : proper x -> proper y -> holds x r -> holds y t -> proper (times x y) /\ holds (times x y) (r * t).
Proof.
  destruct x as [a b], y as [c d]. intros [A B] [A' B'] R T. unfold times. cbn [fst snd] in *. unfold holds in *. cbn [fst snd] in *.
  assert (Z : forall l h, is_zero (l, h) = true -> l = 0 /\ h = 0).
  { unfold is_zero. cbn [fst snd]. intros l h. destruct (Req_bool_spec l 0), (Req_bool_spec h 0); easy. }
  destruct (orb _ _) eqn:Zero.
  { split; [split; cbn [fst snd]; apply generic_format_0|]. cbn [fst snd]. apply Bool.orb_prop in Zero as [H|H]; apply Z in H; [replace r with 0 by lra|replace t with 0 by lra]; lra. }
  destruct (andb _ _) eqn:Ex.
  { apply andb_prop in Ex as [Same Ex]. apply andb_prop in Same as [S1 S2]. revert S1 S2. destruct (Req_bool_spec a b) as [<-|]; [|discriminate].
    destruct (Req_bool_spec c d) as [<-|]; [|discriminate]. intros _ _. pose proof (exact_product a c A A' Ex) as E.
    split; [split; apply F_R64|]. cbn [fst snd]. rewrite E. replace r with a by lra. replace t with c by lra. lra. }
  rewrite !R64_min, !R64_max. split; [split; cbn [fst snd]; [apply generic_format_pred|apply generic_format_succ]; try typeclasses eauto; apply F_R64|].
  cbn [fst snd]. destruct (corners a b c d r t R T) as [L H]. split; [eapply Rle_trans; [apply moved_below|exact L]|eapply Rle_trans; [exact H|apply moved_above]].
Qed.

(** A product with 0 is 0: a direction along the planes stays so. [INST-3] *)
Theorem times_zero x : times x (0, 0) = (0, 0).
Proof.
  destruct x as [a b]. unfold times. replace (is_zero (0, 0)) with true; [now rewrite Bool.orb_true_r|]. unfold is_zero. cbn [fst snd]. now rewrite Req_bool_true.
Qed.

(** * Rays *)

(** A component of a point or a direction, in the space of an object: a sum of products with the entries of an inverse map and what is
    added; as [AffineMap::pull_back] has it where it goes by intervals, in any order. *)
Inductive term : Type := Known (x : interval) (r : R) | Sum (a b : term) | Difference (a b : term) | Product (a b : term).
Fixpoint bound (x : term) : interval :=
  match x with Known x _ => x | Sum a b => plus (bound a) (bound b) | Difference a b => minus (bound a) (bound b) | Product a b => times (bound a) (bound b) end.
Fixpoint true_of (x : term) : R :=
  match x with Known _ r => r | Sum a b => true_of a + true_of b | Difference a b => true_of a - true_of b | Product a b => true_of a * true_of b end.
Fixpoint right (x : term) : Prop :=
  match x with Known x r => proper x /\ holds x r | Sum a b | Difference a b | Product a b => right a /\ right b end.

(** Whatever is made of intervals by these operations holds what is made of the numbers: so for the ray of an inner level, if the ray
    around it and the entries of the inverse map are within their bounds; and for a met point o + t d. [INST-3, SECOND-3] *)
Theorem bounds_hold x : right x -> proper (bound x) /\ holds (bound x) (true_of x).
Proof.
  induction x as [x r|a IHa b IHb|a IHa b IHb|a IHa b IHb]; cbn; [auto|intros [A B]; destruct (IHa A), (IHb B)..];
    [now apply plus_holds|now apply minus_holds|now apply times_holds].
Qed.
