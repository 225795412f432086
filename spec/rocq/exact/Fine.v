(** [Fine] of src/geom/fine.rs: numbers of twice the digits of a double, with a radius. [NEAR-5] What sums, differences and products give stands for
    those of all numbers that the operands stand for. In double precision with gradual underflow, without a greatest exponent. *)
Require Import Reals ZArith Lia Lra Psatz.
From Flocq Require Import Core Relative Sterbenz Plus_error Pff2Flocq.
Require Import StacklessExact.Rounding StacklessExact.Range StacklessExact.Expansion.
Require StacklessExact.Intervals.
Open Scope R_scope.

Local Instance prec_53 : Prec_gt_0 53 := eq_refl.
Notation u := (bpow radix2 (-53)).
Notation eta := (bpow radix2 (-1074)).

(** * The code *)

Record fine : Type := Fine { high : R; low : R; radius : R }.

Definition ERROR : R := bpow radix2 (-102).
Definition UNDERFLOW : R := bpow radix2 (-1060).
Definition EXACT : R := bpow radix2 (-900).
Definition UP : R := 1 + bpow radix2 (-48).

Definition new (h l r : R) : fine := let '(h', l') := two_sum h l in Fine h' l' (R64 (r * UP)).
Definition exact (x : R) : fine := Fine x 0 0.
Definition of_two (x : R * R) : fine := Fine (fst x) (snd x) 0.
Definition is_exact (x : fine) : bool := Req_bool (radius x) 0.
Definition is_zero (x : fine) : bool := andb (Req_bool (high x) 0) (is_exact x).
Definition is_within (x : fine) (most : R) : bool := andb (Rle_bool (Rabs (high x)) most) (Rle_bool (radius x) most).
(** Both are doubles. *)
Definition are_doubles (x y : fine) : bool := andb (andb (andb (Req_bool (low x) 0) (Req_bool (low y) 0)) (is_exact x)) (is_exact y).

Definition sign (x : fine) : option R :=
  if orb (is_zero x) (Rlt_bool (R64 (R64 (Rabs (low x) + radius x) * UP)) (Rabs (high x))) then Some (high x) else None.

(** Each end is a sum of two. *)
Definition bounds (x : fine) : (R * R) * (R * R) :=
  let around := Intervals.plus (low x, low x) (- radius x, radius x) in
  (two_sum (high x) (fst around), two_sum (high x) (snd around)).

Definition add (x y : fine) : fine :=
  let '(h, rest) := two_sum (high x) (high y) in
  let '(l, least) := two_sum (low x) (low y) in
  let '(middle, lost) := two_sum rest l in
  let '(h', middle') := two_sum h middle in
  let r := R64 (radius x + radius y) in
  if andb (Req_bool lost 0) (Req_bool least 0) then Fine h' middle' (R64 (r * UP)) else
  new h' (R64 (middle' + least)) (R64 (r + R64 (Rabs h' * ERROR))).

Definition neg (x : fine) : fine := Fine (- high x) (- low x) (radius x).
Definition sub (x y : fine) : fine := add x (neg y).

Definition mul (x y : fine) : fine :=
  if orb (is_zero x) (is_zero y) then Fine 0 0 0 else
  let '(h, rest) := two_product (high x) (high y) in
  if andb (are_doubles x y) (Rlt_bool EXACT (Rabs h)) then Fine h rest 0 else
  let l := R64 (rest + R64 (R64 (high x * low y) + R64 (low x * high y))) in
  let of_radii := R64 (R64 (R64 (Rabs (high x) * radius y) + R64 (Rabs (high y) * radius x)) + R64 (radius x * radius y)) in
  new h l (R64 (R64 (R64 (of_radii * UP) + R64 (Rabs h * ERROR)) + UNDERFLOW)).

(** * What it stands for *)

Definition proper (x : fine) : Prop := F (high x) /\ F (low x) /\ F (radius x) /\ 0 <= radius x /\ Rabs (low x) <= u * Rabs (high x).
Definition holds (x : fine) (r : R) : Prop := Rabs (r - high x - low x) <= radius x.
Definition stands (x : fine) (r : R) : Prop := proper x /\ holds x r.

(** * Roundings *)

Lemma Hu : 0 < u <= / 1048576.
Proof. split; [apply bpow_gt_0|]. change (/ 1048576) with (bpow radix2 (-20)). apply bpow_le. lia. Qed.
Lemma eta_pos : 0 < eta.
Proof. apply bpow_gt_0. Qed.
Lemma F_abs x : F x -> F (Rabs x).
Proof. apply generic_format_abs. Qed.
Lemma F_opp x : F x -> F (- x).
Proof. apply generic_format_opp. Qed.
Lemma R64_id x : F x -> R64 x = x.
Proof. intros. now apply round_generic; [typeclasses eauto|]. Qed.
Lemma R64_le x y : x <= y -> R64 x <= R64 y.
Proof. intros. now apply round_le; [typeclasses eauto..|]. Qed.

(** A sum never suffers from underflow. *)
Lemma sum_off a b : F a -> F b -> Rabs (a + b - R64 (a + b)) <= u * Rabs (a + b) /\ Rabs (a + b - R64 (a + b)) <= u * Rabs (R64 (a + b)).
Proof.
  intros A B. destruct (Rounding.difference (-1074) 53 a (- b) A (F_opp _ B)) as (e & He & E). replace (a - - b) with (a + b) in E by ring.
  pose proof Hu as U. change (Rounding.unit 53) with u in *. rewrite E. set (x := a + b).
  replace (x - x * (1 + e)) with (x * - e) by ring. rewrite !Rabs_mult, Rabs_Ropp.
  assert (V : u / (1 + u) * (1 + u) = u) by (field; lra). set (v := u / (1 + u)) in *.
  assert (P : 0 <= v) by (apply Rmult_le_reg_r with (1 + u); lra). assert (L : v <= u) by nra.
  assert (W : Rabs e <= u * Rabs (1 + e)). { apply Rabs_le_inv in He. rewrite (Rabs_pos_eq (1 + e)) by lra. apply Rabs_le. nra. }
  pose proof (Rabs_pos x). split; nra.
Qed.

(** Any rounding, with underflow. *)
Lemma off x : Rabs (x - R64 x) <= u * Rabs x + / 2 * eta.
Proof.
  destruct (error_N_FLT radix2 (-1074) 53 eq_refl (fun z => negb (Z.even z)) x) as (e & t & He & Ht & _ & ->).
  rewrite unit_half in He. change (Rounding.unit 53) with u in He.
  replace (x - (x * (1 + e) + t)) with (- (x * e + t)) by ring. rewrite Rabs_Ropp. eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_mult.
  pose proof (Rabs_pos x). nra.
Qed.
Lemma product_low x : 0 <= x -> x * (1 - u) - / 2 * eta <= R64 x.
Proof. intros P. pose proof (off x) as H. rewrite (Rabs_pos_eq x) in H by exact P. apply Rabs_le_inv in H. lra. Qed.
Lemma sum_low a b : F a -> F b -> 0 <= a + b -> (a + b) * (1 - u) <= R64 (a + b).
Proof. intros A B P. destruct (sum_off a b A B) as [H _]. rewrite (Rabs_pos_eq (a + b)) in H by exact P. apply Rabs_le_inv in H. lra. Qed.
Lemma R64_pos x : 0 <= x -> 0 <= R64 x.
Proof. intros. rewrite <- (round_0 radix2 (FLT_exp (-1074) 53) ZnearestE). now apply R64_le. Qed.

(** A sum that is below the least normal number is exact. *)
Lemma sum_small a b : F a -> F b -> Rabs (R64 (a + b)) < bpow radix2 (-1022) -> R64 (a + b) = a + b.
Proof.
  intros A B H. apply R64_id. apply (FLT_format_plus_small radix2 (-1074) 53); [assumption..|].
  apply Rnot_lt_le. intros L. apply (Rlt_not_le _ _ H). apply abs_round_ge_generic; [typeclasses eauto..|apply generic_format_bpow; unfold FLT_exp; lia|].
  eapply Rle_trans; [apply bpow_le|apply Rlt_le, L]; lia.
Qed.

(** * Radii *)

Lemma UP_is : UP = 1 + 32 * u.
Proof. unfold UP. change (-48)%Z with (5 + -53)%Z. rewrite bpow_plus. change (bpow radix2 5) with 32. reflexivity. Qed.

Lemma up_grows x : F x -> 0 <= x -> x <= R64 (x * UP).
Proof. intros X P. apply round_ge_generic; [typeclasses eauto..|exact X|]. pose proof Hu. rewrite UP_is. nra. Qed.
Lemma up_much x : bpow radix2 (-1022) <= x -> x * (1 + 16 * u) <= R64 (x * UP).
Proof.
  intros L. pose proof (bpow_gt_0 radix2 (-1022)) as P. pose proof Hu as U. rewrite UP_is.
  assert (E : eta = 2 * (u * bpow radix2 (-1022))).
  { change (-1074)%Z with (1 + (-53 + -1022))%Z. rewrite !bpow_plus. change (bpow radix2 1) with 2. ring. }
  assert (Q : 0 <= x * (1 + 32 * u)) by (apply Rmult_le_pos; lra). pose proof (product_low _ Q) as H. rewrite E in H.
  set (m := bpow radix2 (-1022)) in *. assert (A : u * m <= u * x) by (apply Rmult_le_compat_l; lra).
  assert (B : u * (u * x) <= / 1048576 * (u * x)) by (apply Rmult_le_compat_r; [apply Rmult_le_pos|]; lra).
  assert (0 < u * x) by (apply Rmult_lt_0_compat; lra). lra.
Qed.

(** Some roundings are made up for by 16 u. *)
Lemma made_up x y : 0 <= y -> y * (1 - 8 * u) <= x -> y <= x * (1 + 16 * u).
Proof.
  intros P H. pose proof Hu as U. apply Rle_trans with (y * (1 - 8 * u) * (1 + 16 * u)); [|apply Rmult_le_compat_r; lra].
  assert (A : 0 <= u * (8 - 128 * u)) by (apply Rmult_le_pos; lra). pose proof (Rmult_le_pos _ _ P A). lra.
Qed.
Lemma less_by k x y z : 0 <= k -> 0 <= x -> x * (1 - k * u) <= y -> y * (1 - u) <= z -> x * (1 - (k + 1) * u) <= z.
Proof.
  intros K P H G. pose proof Hu as U. apply Rle_trans with (y * (1 - u)); [|exact G]. apply Rle_trans with (x * (1 - k * u) * (1 - u)); [|apply Rmult_le_compat_r; lra].
  assert (A : 0 <= k * (u * u)) by (apply Rmult_le_pos; [exact K|apply Rmult_le_pos; lra]). pose proof (Rmult_le_pos _ _ P A). lra.
Qed.
Lemma fewer k x : 0 <= x -> k <= 8 -> x * (1 - 8 * u) <= x * (1 - k * u).
Proof. intros P K. pose proof Hu as U. apply Rmult_le_compat_l; [exact P|]. assert (0 <= (8 - k) * u) by (apply Rmult_le_pos; lra). lra. Qed.

(** Two roundings of sums, and three. *)
Lemma up_two a b : F a -> F b -> 0 <= a -> 0 <= b -> a + b <= R64 (R64 (a + b) * UP).
Proof.
  intros A B Pa Pb. assert (P0 : 0 <= a + b) by lra. pose proof (R64_pos _ P0) as P. destruct (Rlt_or_le (R64 (a + b)) (bpow radix2 (-1022))) as [S|L].
  - rewrite <- (sum_small a b) at 1; [|assumption..|now rewrite Rabs_pos_eq]. apply up_grows; [apply F_R64|exact P].
  - eapply Rle_trans; [|apply up_much, L]. apply made_up; [lra|]. pose proof (sum_low a b A B P0) as H. pose proof (fewer 1 _ P0 ltac:(lra)). lra.
Qed.
Lemma up_three a b c : F a -> F b -> F c -> 0 <= a -> 0 <= b -> 0 <= c -> a + b + c <= R64 (R64 (R64 (a + b) + c) * UP).
Proof.
  intros A B C Pa Pb Pc. assert (P0 : 0 <= a + b) by lra. pose proof (R64_pos _ P0) as P. assert (P1 : 0 <= R64 (a + b) + c) by lra. pose proof (R64_pos _ P1) as P'.
  destruct (Rlt_or_le (R64 (R64 (a + b) + c)) (bpow radix2 (-1022))) as [S|L].
  - assert (Ls : R64 (a + b) <= R64 (R64 (a + b) + c)) by (apply round_ge_generic; [typeclasses eauto..|apply F_R64|lra]).
    rewrite <- (sum_small a b) at 1; [|assumption..|rewrite Rabs_pos_eq by exact P; lra].
    rewrite <- (sum_small (R64 (a + b)) c) at 1; [|apply F_R64|assumption|now rewrite Rabs_pos_eq]. apply up_grows; [apply F_R64|exact P'].
  - eapply Rle_trans; [|apply up_much, L]. apply made_up; [lra|]. pose proof (sum_low a b A B P0) as H. pose proof (sum_low _ c (F_R64 _) C P1) as G.
    assert (P2 : 0 <= a + b + c) by lra. eapply Rle_trans; [apply (fewer 2 _ P2); lra|]. replace 2 with (1 + 1) at 1 by ring. eapply less_by; [lra|exact P2| |exact G].
    pose proof Hu as U. assert (0 <= c * u) by (apply Rmult_le_pos; lra). lra.
Qed.

(** * New numbers *)

Lemma two_sum_is a b : F a -> F b -> two_sum a b = (R64 (a + b), a + b - R64 (a + b)).
Proof. intros A B. pose proof (two_sum_rest a b A B) as E. rewrite (surjective_pairing (two_sum a b)), E. reflexivity. Qed.
Lemma rest_F a b : F a -> F b -> F (a + b - R64 (a + b)).
Proof. intros A B. rewrite <- two_sum_rest by assumption. apply F_R64. Qed.

Theorem new_stands h l r x : F h -> F l -> F r -> 0 <= r -> Rabs (x - h - l) <= R64 (r * UP) -> stands (new h l r) x.
Proof.
  intros H L Fr P E. unfold new. rewrite two_sum_is by assumption. split; [repeat split; cbn [high low radius]|].
  - apply F_R64.
  - now apply rest_F.
  - apply F_R64.
  - eapply Rle_trans; [exact P|]. now apply up_grows.
  - apply sum_off; assumption.
  - unfold holds. cbn [high low radius]. replace (x - R64 (h + l) - (h + l - R64 (h + l))) with (x - h - l) by ring. exact E.
Qed.

Lemma exact_stands x : F x -> stands (exact x) x.
Proof.
  intros X. split; [repeat split; cbn; try apply generic_format_0; try lra; try exact X|unfold holds; cbn].
  - rewrite Rabs_R0. pose proof Hu. pose proof (Rabs_pos x). nra.
  - replace (x - x - 0) with 0 by ring. rewrite Rabs_R0. lra.
Qed.

(** What a sum of two doubles is made of. *)
Lemma of_two_stands a b : F a -> F b -> stands (of_two (two_sum a b)) (a + b).
Proof.
  intros A B. rewrite two_sum_is by assumption. split; [repeat split; cbn [of_two fst snd high low radius]|].
  - apply F_R64.
  - now apply rest_F.
  - apply generic_format_0.
  - lra.
  - apply sum_off; assumption.
  - unfold holds. cbn. replace (_ - _ - _) with 0 by ring. rewrite Rabs_R0. lra.
Qed.
