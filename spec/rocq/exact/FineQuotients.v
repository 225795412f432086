(** Quotients of src/geom/fine.rs, and numbers that hold those of two. *)
Require Import Reals ZArith Lia Lra Psatz.
From Flocq Require Import Core Pff2Flocq.
Require Import StacklessExact.Rounding StacklessExact.Range StacklessExact.Expansion StacklessExact.Fine.
Require Import StacklessExact.FineSums StacklessExact.FineProducts.
Require StacklessExact.Intervals.
Open Scope R_scope.

Local Instance prec_53 : Prec_gt_0 53 := eq_refl.
Notation u := (bpow radix2 (-53)).
Notation eta := (bpow radix2 (-1074)).

(** * The code *)

Definition EPSILON : R := bpow radix2 (-52).

Definition hull (x y : fine) : fine :=
  let apart := sub y (Fine (high x) (low x) 0) in
  let reach := R64 (R64 (R64 (Rabs (high apart) + Rabs (low apart)) + radius apart) * UP) in
  Fine (high x) (low x) (if Rlt_bool reach (radius x) then radius x else reach).

(** The divisor is not negative here. *)
Definition over_positive (x y : fine) : R * fine :=
  let least := fst (fst (bounds y)) in
  let quotient := R64 (high x / high y) in
  let left_ := sub x (mul (exact quotient) y) in
  let step := R64 (high left_ / high y) in
  let of_whole := R64 (R64 (radius y / high y) + EPSILON) in
  let r := R64 (R64 (R64 (R64 (radius left_ + Rabs (low left_)) + R64 (Rabs (high left_) * of_whole)) / least) + R64 (Rabs step * EPSILON)) in
  (least, new quotient step (R64 (r + UNDERFLOW))).
(** The least divisor, and the quotient, which there is if that is above 0, and nothing is infinite. *)
Definition over (x y : fine) : R * fine := if Rlt_bool (high y) 0 then over_positive (neg x) (neg y) else over_positive x y.

(** * The radius *)

Lemma EPSILON_is : EPSILON = 2 * u.
Proof. unfold EPSILON. change (-52)%Z with (1 + -53)%Z. rewrite bpow_plus. reflexivity. Qed.
Lemma UNDERFLOW_is : UNDERFLOW = 16384 * eta.
Proof. unfold UNDERFLOW. change (-1060)%Z with (14 + -1074)%Z. rewrite bpow_plus. reflexivity. Qed.
Lemma small x : 0 <= x -> 0 <= u * x <= / 1048576 * x.
Proof. intros H. pose proof Hu as U. split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]. Qed.
Lemma u_times a b : a <= b -> u * a <= u * b.
Proof. intros. pose proof Hu. apply Rmult_le_compat_l; lra. Qed.

(** What is over [least], and what is rounded of the step. *)
Lemma radius_of_quotient n least g m step : F n -> 0 <= n -> 0 < least -> 0 < g -> g * (1 - u) * least <= 1 -> 0 <= m -> m <= n + 8 * (u * n) ->
  g * m + u * Rabs step + 1000 * eta <= R64 (R64 (R64 (R64 (n / least) + R64 (Rabs step * EPSILON)) + UNDERFLOW) * UP).
Proof.
  intros Fn Pn Pl Pg G Pm M. pose proof Hu as U. pose proof eta_pos as Pe.
  assert (Pq : 0 <= n / least) by (apply Rmult_le_pos; [exact Pn|apply Rlt_le, Rinv_0_lt_compat, Pl]). pose proof (product_low _ Pq) as LQ. pose proof (R64_pos _ Pq) as PQ.
  assert (GM : (g * m) * (1 - u) <= n / least + 8 * (u * (n / least))).
  { apply Rmult_le_reg_r with least; [exact Pl|]. replace ((n / least + 8 * (u * (n / least))) * least) with (n + 8 * (u * n)) by (field; lra).
    apply Rle_trans with (2 := M). replace (g * m * (1 - u) * least) with (m * (g * (1 - u) * least)) by ring. rewrite <- (Rmult_1_r m) at 2. now apply Rmult_le_compat_l. }
  assert (Pgm : 0 <= g * m) by (apply Rmult_le_pos; lra). set (k := g * m) in *. set (q := n / least) in *. set (Q := R64 q) in *.
  assert (Ps : 0 <= Rabs step * EPSILON) by (apply Rmult_le_pos; [apply Rabs_pos|apply bpow_ge_0]). pose proof (product_low _ Ps) as LS. pose proof (R64_pos _ Ps) as PS.
  rewrite EPSILON_is in LS, PS. rewrite EPSILON_is. set (v := Rabs step) in *. set (S := R64 (v * (2 * u))) in *. assert (Pv : 0 <= v) by apply Rabs_pos.
  assert (P1 : 0 <= Q + S) by lra. pose proof (sum_low Q S (F_R64 _) (F_R64 _) P1) as L1. pose proof (R64_pos _ P1) as Q1. set (a := R64 (Q + S)) in *.
  assert (Fu : F UNDERFLOW) by (apply generic_format_bpow; unfold FLT_exp; lia). rewrite UNDERFLOW_is in *.
  assert (P2 : 0 <= a + 16384 * eta) by lra. pose proof (sum_low a _ (F_R64 _) Fu P2) as L2. pose proof (R64_pos _ P2) as Q2. set (b := R64 (a + 16384 * eta)) in *.
  assert (P3 : 0 <= b * UP) by (apply Rmult_le_pos; [exact Q2|rewrite UP_is; lra]). pose proof (product_low _ P3) as L3. apply Rle_trans with (2 := L3). rewrite UP_is.
  pose proof (small k Pgm) as [k0 k1]. pose proof (small _ k0) as [k2 k3]. pose proof (small q Pq) as [q0 q1]. pose proof (small _ q0) as [q2 q3].
  pose proof (small Q PQ) as [Q3 Q4]. pose proof (small _ Q3) as [Q5 Q6]. pose proof (small S PS) as [S1 S2]. pose proof (small _ S1) as [S3 S4].
  pose proof (small v Pv) as [v1 v2]. pose proof (small _ v1) as [v3 v4]. pose proof (small a Q1) as [a1 a2]. pose proof (small _ a1) as [a3 a4].
  pose proof (small b Q2) as [b1 b2]. pose proof (small _ b1) as [b3 b4]. pose proof (small _ (Rlt_le _ _ Pe)) as [e1 e2]. pose proof (small _ e1) as [e3 e4].
  assert (B : b + 30 * (u * b) - eta <= b * (1 + 32 * u) * (1 - u) - / 2 * eta) by lra. apply Rle_trans with (2 := B).
  assert (A : a + 16384 * eta - u * a - 16384 * (u * eta) <= b) by lra. pose proof (u_times _ _ A) as A'.
  assert (A2 : a + 28 * (u * a) + 16000 * eta <= b + 30 * (u * b)) by lra.
  assert (C : Q + S - u * Q - u * S <= a) by lra. pose proof (u_times _ _ C) as C'.
  assert (C2 : Q + 26 * (u * Q) + S + 26 * (u * S) <= a + 28 * (u * a)) by lra.
  assert (D : q - u * q - / 2 * eta <= Q) by lra. pose proof (u_times _ _ D) as D'. assert (D2 : q + 20 * (u * q) - eta <= Q + 26 * (u * Q)) by lra.
  assert (K : k - u * k <= q + 8 * (u * q)) by lra. pose proof (u_times _ _ K) as K'. assert (K2 : k <= q + 20 * (u * q)) by lra.
  lra.
Qed.

(** What is over the least divisor. *)
Section Top.
Variables lh ll lr w : R.
Hypothesis Fll : F ll.
Hypothesis Flr : F lr.
Hypothesis Pw : 0 <= w.
Let of_whole := R64 (R64 w + EPSILON).
Let n := R64 (R64 (lr + Rabs ll) + R64 (Rabs lh * of_whole)).

Lemma of_whole_pos : 0 <= of_whole.
Proof. apply R64_pos, Rplus_le_le_0_compat; [now apply R64_pos|apply bpow_ge_0]. Qed.
Lemma of_whole_enough : (w + u) - 2 * (u * (w + u)) <= of_whole.
Proof.
  pose proof Hu as U. pose proof eta_pos as Pe. pose proof (product_low w Pw) as L. pose proof (R64_pos w Pw) as P.
  assert (Fe : F EPSILON) by (apply generic_format_bpow; unfold FLT_exp; lia). assert (P1 : 0 <= R64 w + EPSILON) by (rewrite EPSILON_is; lra).
  pose proof (sum_low _ _ (F_R64 w) Fe P1) as L1. fold of_whole in L1. rewrite EPSILON_is in L1. set (W := R64 w) in *.
  assert (E : eta <= / 1048576 * u). { change (/ 1048576) with (bpow radix2 (-20)). rewrite <- bpow_plus. apply bpow_le. lia. }
  pose proof (small w Pw) as [w0 w1]. pose proof (small _ w0) as [w2 w3]. pose proof (small u ltac:(lra)) as [u1 u2]. 
  assert (L' : (w * (1 - u) - / 2 * eta) * (1 - u) <= W * (1 - u)) by (apply Rmult_le_compat_r; lra).
  pose proof (small _ (Rlt_le _ _ Pe)) as [e1 e2]. lra.
Qed.

(** The parts, of which rounding takes some; underflow takes a part of the last. *)
Lemma top_enough a b : 0 <= a -> 0 <= b -> a <= lr + Rabs ll -> a + b - 4 * (u * b) <= lr + Rabs ll + R64 (Rabs lh * of_whole) -> a + b <= n + 8 * (u * n).
Proof.
  intros Pa Pb A B. pose proof Hu as U. pose proof (Rabs_pos ll) as P. assert (P1 : 0 <= lr + Rabs ll) by lra.
  pose proof (sum_low _ _ Flr (F_abs _ Fll) P1) as L1. pose proof (R64_pos _ P1) as Q1.
  assert (P2 : 0 <= Rabs lh * of_whole) by (apply Rmult_le_pos; [apply Rabs_pos|apply of_whole_pos]). pose proof (R64_pos _ P2) as Q2.
  set (s := R64 (lr + Rabs ll)) in *. set (t := R64 (Rabs lh * of_whole)) in *. assert (P3 : 0 <= s + t) by lra.
  pose proof (sum_low s t (F_R64 _) (F_R64 _) P3) as L3. pose proof (R64_pos _ P3) as Q3. change (R64 (s + t)) with n in L3, Q3. set (x := lr + Rabs ll) in *.
  pose proof (small x P1) as [x0 x1]. pose proof (small _ x0) as [x2 x3]. pose proof (small t Q2) as [t0 t1]. pose proof (small _ t0) as [t2 t3].
  pose proof (small s Q1) as [s0 s1]. pose proof (small _ s0) as [s2 s3]. pose proof (small n Q3) as [n0 n1]. pose proof (small _ n0) as [n2 n3].
  assert (C : s + t - u * s - u * t <= n) by lra. pose proof (u_times _ _ C) as C'. assert (C2 : s + t + 6 * (u * s) + 6 * (u * t) <= n + 8 * (u * n)) by lra.
  assert (D : x - u * x <= s) by lra. pose proof (u_times _ _ D) as D'. assert (D2 : x + 9 / 2 * (u * x) <= s + 6 * (u * s)) by lra.
  pose proof (small b Pb) as [b0 b1]. pose proof (small _ b0) as [b2 b3]. pose proof (small a Pa) as [a0 a1]. pose proof (small _ a0) as [a2 a3].
  pose proof (u_times _ _ B) as B'. assert (H : a + b <= x + 9 / 2 * (u * x) + t + 9 / 2 * (u * t)) by lra. lra.
Qed.
End Top.

(** How far the quotient is off what is computed of it, by the parts of what is left. *)
Lemma quotient_off r t q lh ll m wh b e : 0 < t -> 0 < wh -> Rabs (r - q * t - lh - ll) <= m -> / t * Rabs (lh * ((wh - t) / wh)) <= / t * b + e ->
  Rabs (r / t - q - R64 (lh / wh)) <= / t * (m + Rabs ll + b) + u * Rabs (R64 (lh / wh)) + (eta + e).
Proof.
  intros Pt Pw L B. pose proof Hu as U. set (step := R64 (lh / wh)). assert (Pi : 0 < / t) by now apply Rinv_0_lt_compat.
  assert (S : Rabs (lh / wh - step) <= u * Rabs step + eta).
  { pose proof eta_pos. destruct (Rle_or_lt (bpow radix2 (-1022)) (Rabs (lh / wh))) as [G|G]; [pose proof (off_big _ G); unfold step; lra|].
    pose proof (off (lh / wh)) as O. fold step in O. assert (u * Rabs (lh / wh) <= / 2 * eta).
    { apply Rlt_le in G. apply u_times in G. rewrite <- bpow_plus in G. replace (/ 2 * eta) with (bpow radix2 (-53 + -1022)); [exact G|].
      change (-53 + -1022)%Z with (-1 + -1074)%Z. rewrite bpow_plus. reflexivity. }
    pose proof (Rabs_pos step). assert (0 <= u * Rabs step) by (apply Rmult_le_pos; lra). lra. }
  replace (r / t - q - step) with (/ t * (r - q * t - lh - ll) + (/ t * ll + (/ t * (lh * ((wh - t) / wh)) + (lh / wh - step)))) by (field; lra).
  eapply Rle_trans; [apply tri|]. eapply Rle_trans; [apply Rplus_le_compat_l, tri|]. eapply Rle_trans; [apply Rplus_le_compat_l, Rplus_le_compat_l, tri|].
  rewrite (Rabs_mult (/ t) (r - _ - _ - _)), (Rabs_mult (/ t) ll), (Rabs_mult (/ t) (lh * _)), (Rabs_pos_eq (/ t)) by lra.
  assert (X : / t * Rabs (r - q * t - lh - ll) <= / t * m) by (apply Rmult_le_compat_l; lra). lra.
Qed.
Lemma doubt_is t lh wh wl wr : 0 < wh -> Rabs wl <= u * wh -> Rabs (t - wh - wl) <= wr -> Rabs (lh * ((wh - t) / wh)) <= Rabs lh * (wr / wh + u).
Proof.
  intros Pw W T. rewrite Rabs_mult. apply Rmult_le_compat_l; [apply Rabs_pos|]. unfold Rdiv at 1. rewrite Rabs_mult, (Rabs_pos_eq (/ wh)) by (apply Rlt_le, Rinv_0_lt_compat, Pw).
  replace (wr / wh + u) with ((wr + u * wh) * / wh) by (field; lra). apply Rmult_le_compat_r; [apply Rlt_le, Rinv_0_lt_compat, Pw|].
  replace (wh - t) with (- (t - wh - wl) + - wl) by ring. eapply Rle_trans; [apply tri|]. rewrite !Rabs_Ropp. lra.
Qed.

(** * A quotient that underflows *)

Lemma half_ulp e x : (-1021 <= e)%Z -> Rabs x < bpow radix2 e -> Rabs (R64 x - x) <= bpow radix2 (e - 54).
Proof.
  intros E H. eapply Rle_trans; [apply error_le_half_ulp; typeclasses eauto|]. replace (e - 54)%Z with (-1 + (e - 53))%Z by ring. rewrite bpow_plus. change (bpow radix2 (-1)) with (/ 2).
  apply Rmult_le_compat_l; [lra|]. destruct (Req_dec x 0) as [->|N].
  - rewrite ulp_FLT_0 by reflexivity. apply bpow_le. lia.
  - rewrite ulp_neq_0 by exact N. apply bpow_le. unfold cexp, FLT_exp. apply mag_le_bpow in H; [|exact N]. lia.
Qed.

Section Tiny.
Variables p w : R.
Hypothesis Fp : F p.
Hypothesis Pp : 0 <= p.
Hypothesis Pw : 0 <= w.
Let of_whole := R64 (R64 w + EPSILON).
Let z := R64 (p * of_whole).

Lemma of_whole_tight : of_whole < 1 -> w + u <= of_whole.
Proof.
  intros H. pose proof Hu as U. assert (F1 : F 1) by (change 1 with (bpow radix2 0); apply generic_format_bpow; unfold FLT_exp; lia).
  assert (N1 : forall x, 1 <= x -> 1 <= R64 x) by (intros x X; apply round_ge_generic; [typeclasses eauto..|exact F1|exact X]).
  assert (Near : forall x, 0 <= x -> x < 1 -> x - / 2 * u <= R64 x).
  { intros x X Y. pose proof (half_ulp 0 x ltac:(lia)) as G. rewrite Rabs_pos_eq in G by exact X. specialize (G Y). apply Rabs_le_inv in G.
    replace (bpow radix2 (0 - 54)) with (/ 2 * u) in G; [lra|]. change (0 - 54)%Z with (-1 + -53)%Z. rewrite bpow_plus. reflexivity. }
  assert (E : of_whole = R64 (R64 w + 2 * u)) by (unfold of_whole; now rewrite EPSILON_is). rewrite E in H |- *. destruct (Rlt_or_le w 1) as [W|W].
  - pose proof (Near w Pw W) as A. pose proof (R64_pos w Pw) as B. destruct (Rlt_or_le (R64 w + 2 * u) 1) as [C|C].
    + pose proof (Near (R64 w + 2 * u) ltac:(lra) C) as D. lra.
    + apply N1 in C. lra.
  - apply N1 in W. assert (C : 1 <= R64 w + 2 * u) by lra. apply N1 in C. lra.
Qed.

(** What is lost of the product is made up for, or it is less than what there is to the whole of [p]. *)
Lemma lost : of_whole < 1 -> p * of_whole - 2 * (u * (p * of_whole)) <= z \/ (/ 2 * eta <= p * (1 - of_whole) /\ p * of_whole - u * (p * of_whole) - p * (1 - of_whole) <= z).
Proof.
  intros H. pose proof Hu as U. pose proof eta_pos as Pe. assert (Po : 0 <= of_whole) by (apply R64_pos, Rplus_le_le_0_compat; [now apply R64_pos|apply bpow_ge_0]).
  assert (Px : 0 <= p * of_whole) by now apply Rmult_le_pos. pose proof (product_low _ Px) as L. change (R64 (p * of_whole)) with z in L.
  destruct (Rle_or_lt (/ 2 * eta) (p * (1 - of_whole))) as [A|A]; [right; lra|left]. pose proof (small _ Px) as [x0 x1].
  destruct (Rle_or_lt (bpow radix2 (-1022)) (p * of_whole)) as [B|B].
  - assert (/ 2 * eta <= u * (p * of_whole)); [|lra]. apply u_times in B. rewrite <- bpow_plus in B. replace (/ 2 * eta) with (bpow radix2 (-53 + -1022)); [exact B|].
    change (-53 + -1022)%Z with (-1 + -1074)%Z. rewrite bpow_plus. reflexivity.
  - pose proof (half_ulp (-1021) (p * of_whole) ltac:(lia)) as G. rewrite Rabs_pos_eq in G by exact Px. change (R64 (p * of_whole)) with z in G.
    assert (Rabs (z - p * of_whole) <= / 2 * eta) as G'.
    { replace (/ 2 * eta) with (bpow radix2 (-1021 - 54)) by (change (-1021 - 54)%Z with (-1 + -1074)%Z; rewrite bpow_plus; reflexivity).
      apply G. eapply Rlt_le_trans; [exact B|apply bpow_le; lia]. }
    apply Rabs_le_inv in G'. assert (M : multiple (-1074) (z - p)) by (apply multiple_minus; [apply F_multiple, F_R64|now apply F_multiple]).
    assert (0 <= p * (1 - of_whole)) by (apply Rmult_le_pos; lra). assert (p <= z); [|lra]. apply Rnot_lt_le. intros C. destruct (multiple_big _ _ M) as [Z|Z]; [lra|]. rewrite Rabs_left in Z by lra. lra.
Qed.
End Tiny.

(** * What they stand for *)

(** The least divisor, as it is rounded. *)
Lemma least_is y t : stands y t -> 0 <= high y -> let least := fst (fst (bounds y)) in
  0 < least -> 0 < t /\ 0 < high y /\ high y - u * high y - radius y <= t /\ radius y <= high y + u * high y /\ / t * (1 - u) * least <= 1.
Proof.
  destruct y as [wh wl wr]. intros [(Fh & Fl & Fr & Pr & W) V] P. unfold bounds, holds in *. cbn [high low radius] in *.
  destruct (Intervals.plus_holds (wl, wl) (- wr, wr) wl (t - wh - wl)) as [[F1 _] [B1 _]]; [split; exact Fl|split; [now apply F_opp|exact Fr]|split; cbn; lra|apply Rabs_le_inv, V|].
  destruct (Intervals.plus_holds (wl, wl) (- wr, wr) wl (- wr)) as [_ [B2 _]]; [split; exact Fl|split; [now apply F_opp|exact Fr]|split; cbn; lra|split; cbn; lra|].
  rewrite two_sum_is by assumption. cbn [fst snd] in *. set (lo := fst (Intervals.plus _ _)) in *. cbv zeta. intros L. pose proof Hu as U.
  pose proof (sum_off wh lo Fh F1) as [_ S]. rewrite (Rabs_pos_eq (R64 _)) in S by lra. set (least := R64 (wh + lo)) in *. apply Rabs_le_inv in S, V, W.
  assert (PL : 0 < wh + lo). { apply Rnot_le_lt. intros N. apply R64_le in N. rewrite round_0 in N by typeclasses eauto. fold least in N. lra. }
  rewrite (Rabs_pos_eq wh) in W by exact P. assert (Ph : 0 < wh). { destruct (Rle_lt_or_eq_dec 0 wh P) as [|<-]; [assumption|lra]. }
  assert (Pt : 0 < t) by lra. repeat split; try lra.
  replace 1 with (/ t * t) at 2 by (field; lra). rewrite Rmult_assoc. apply Rmult_le_compat_l; [apply Rlt_le, Rinv_0_lt_compat, Pt|]. lra.
Qed.

(** What stands for some more than a number. *)
Lemma spare x r e : 0 <= e -> (forall d, Rabs d <= e -> stands x (r + d)) -> Rabs (r - high x - low x) <= radius x - e.
Proof.
  intros P H. unfold stands, holds in H. destruct (H e ltac:(rewrite Rabs_pos_eq; lra)) as [_ A]. destruct (H (- e) ltac:(rewrite Rabs_Ropp, Rabs_pos_eq; lra)) as [_ B].
  apply Rabs_le_inv in A, B. apply Rabs_le. lra.
Qed.

(** A quotient of 0: less of what is left than there is to the divisor. *)
Lemma sub_nothing x r : stands x r -> high (sub x (Fine 0 0 0)) = R64 (high x + low x).
Proof.
  destruct x as [h l d]. intros [(Fh & Fl & _) _]. unfold sub, neg, add. cbn [high low radius] in *. assert (F0 : F (- 0)) by apply F_opp, generic_format_0.
  rewrite !two_sum_is by (assumption || apply F_R64 || now apply rest_F). rewrite Ropp_0, !Rplus_0_r, !(R64_id h), !(R64_id l) by assumption.
  replace (h - h) with 0 by ring. replace (l - l) with 0 by ring. rewrite !Rplus_0_l, !(R64_id l) by assumption. replace (l - l) with 0 by ring. rewrite Req_bool_true by reflexivity. reflexivity.
Qed.
Lemma nothing a b : 0 < b -> R64 (a / b) = 0 -> Rabs a <= eta * b.
Proof.
  intros P Z. pose proof (off (a / b)) as O. rewrite Z, Rminus_0_r in O. pose proof Hu as U. pose proof (Rabs_pos (a / b)) as Q. pose proof (small _ Q) as [s0 s1].
  replace a with (a / b * b) by (field; lra). rewrite Rabs_mult, (Rabs_pos_eq b) by lra. apply Rmult_le_compat_r; lra.
Qed.

(** The doubt about the divisor, where all that is left is some 2^-1074 of it. *)
Lemma tiny_doubt p wh wl wr t : F p -> 0 <= p <= 2 * (eta * wh) -> 0 < wh -> 0 <= wr -> wr <= wh + u * wh -> 0 < t -> wh - u * wh - wr <= t -> Rabs wl <= u * wh -> Rabs (t - wh - wl) <= wr ->
  let z := R64 (p * R64 (R64 (wr / wh) + EPSILON)) in exists b, 0 <= b /\ b - 4 * (u * b) <= z /\ / t * Rabs (p * ((wh - t) / wh)) <= / t * b + 20 * eta.
Proof.
  intros Fp [Pp B] Ph Pr R Pt T W V. pose proof Hu as U. pose proof eta_pos as Pe. assert (Pi : 0 < / t) by now apply Rinv_0_lt_compat. set (w := wr / wh).
  assert (Pw : 0 <= w) by (apply Rmult_le_pos; [exact Pr|apply Rlt_le, Rinv_0_lt_compat, Ph]). set (c := R64 (R64 w + EPSILON)). cbv zeta. set (z := R64 (p * c)).
  assert (Pc : 0 <= c) by (apply R64_pos, Rplus_le_le_0_compat; [now apply R64_pos|apply bpow_ge_0]).
  assert (Pz : 0 <= z) by now apply R64_pos, Rmult_le_pos. pose proof (small z Pz) as [z0 z1]. pose proof (small _ z0) as [z2 z3].
  assert (D : Rabs (p * ((wh - t) / wh)) <= p * (w + u)). { pose proof (doubt_is t p wh wl wr Ph W V) as H. rewrite (Rabs_pos_eq p) in H by exact Pp. exact H. }
  destruct (Rlt_or_le c 1) as [C|C].
  - pose proof (of_whole_tight w Pw C) as Tight. fold c in Tight. assert (D2 : p * (w + u) <= p * c) by (apply Rmult_le_compat_l; assumption).
    assert (Px : 0 <= p * c) by now apply Rmult_le_pos. pose proof (small _ Px) as [x0 x1]. pose proof (small _ x0) as [x2 x3].
    pose proof (lost p w Fp Pp Pw C) as K. fold c z in K. destruct K as [L|[L1 L2]].
    + exists (p * c). split; [exact Px|split; [lra|]]. assert (/ t * Rabs (p * ((wh - t) / wh)) <= / t * (p * c)) by (apply Rmult_le_compat_l; lra). lra.
    + exists (z + 2 * (u * z)). split; [lra|split; [lra|]]. assert (Pd : 0 <= p * (1 - c)) by (apply Rmult_le_pos; lra). pose proof (small _ Pd) as [d0 d1]. pose proof (small _ d0) as [d2 d3].
      assert (M : p * c <= z + 2 * (u * z) + 2 * (p * (1 - c))). { pose proof (u_times _ _ L2). lra. }
      assert (N : / t * (p * (1 - c)) <= 2 * eta).
      { apply Rmult_le_reg_l with t; [exact Pt|]. replace (t * (/ t * (p * (1 - c)))) with (p * (1 - c)) by (field; lra).
        assert (K : wh * (1 - c) <= t). { apply Rle_trans with (wh * (1 - (w + u))); [apply Rmult_le_compat_l; lra|]. replace (wh * (1 - (w + u))) with (wh - u * wh - wr) by (unfold w; field; lra). exact T. }
        apply Rle_trans with (2 * (eta * wh) * (1 - c)); [apply Rmult_le_compat_r; lra|]. assert (eta * (wh * (1 - c)) <= eta * t) by (apply Rmult_le_compat_l; lra). lra. }
      assert (/ t * Rabs (p * ((wh - t) / wh)) <= / t * (z + 2 * (u * z) + 2 * (p * (1 - c)))) by (apply Rmult_le_compat_l; lra). lra.
  - exists (p + 2 * (u * p)). assert (G : p <= z). { apply round_ge_generic; [typeclasses eauto..|exact Fp|]. rewrite <- (Rmult_1_r p) at 1. now apply Rmult_le_compat_l. }
    pose proof (small p Pp) as [p0 p1]. pose proof (small _ p0) as [p2 p3]. split; [lra|split; [lra|]].
    assert (A : Rabs (p * ((wh - t) / wh)) <= p + 2 * (u * p)).
    { rewrite Rabs_mult, (Rabs_pos_eq p) by exact Pp. replace (p + 2 * (u * p)) with (p * (1 + 2 * u)) by ring. apply Rmult_le_compat_l; [exact Pp|].
      unfold Rdiv. rewrite Rabs_mult, (Rabs_pos_eq (/ wh)) by (apply Rlt_le, Rinv_0_lt_compat, Ph). apply Rmult_le_reg_r with wh; [exact Ph|]. rewrite Rmult_assoc, Rinv_l by lra.
      apply Rabs_le_inv in V, W. assert (0 <= u * wh) by (apply Rmult_le_pos; lra). split_Rabs; lra. }
    assert (/ t * Rabs (p * ((wh - t) / wh)) <= / t * (p + 2 * (u * p))) by (apply Rmult_le_compat_l; lra). lra.
Qed.

Lemma over_positive_stands x y r t : stands x r -> stands y t -> 0 <= high y -> 0 < fst (over_positive x y) -> t <> 0 /\ stands (snd (over_positive x y)) (r / t).
Proof.
  intros X Y P L. unfold over_positive in *. cbn [fst snd] in *. destruct (least_is y t Y P L) as (Pt & Ph & T & Rw & G). set (least := fst (fst (bounds y))) in *.
  set (q := R64 (high x / high y)). set (m := mul (exact q) y). set (l := sub x m). set (step := R64 (high l / high y)). set (c := R64 (R64 (radius y / high y) + EPSILON)).
  set (n := R64 (R64 (radius l + Rabs (low l)) + R64 (Rabs (high l) * c))).
  pose proof Hu as U. pose proof eta_pos as Pe. assert (Fq : F q) by apply F_R64. pose proof (exact_stands q Fq) as Q.
  assert (Mst : stands m (q * t)) by now apply mul_stands. assert (Lst : stands l (r - q * t)) by now apply sub_stands.
  pose proof Y as [(Yh & Yl & Yr & Yp & Yw) Yv]. unfold holds in Yv. rewrite (Rabs_pos_eq (high y)) in Yw by lra. pose proof Lst as [(Lh & Ll & Lr & Lp & Lw) Lv]. unfold holds in Lv.
  assert (Pw : 0 <= radius y / high y) by (apply Rmult_le_pos; [exact Yp|apply Rlt_le, Rinv_0_lt_compat, Ph]).
  assert (Pc : 0 <= c) by (apply R64_pos, Rplus_le_le_0_compat; [now apply R64_pos|apply bpow_ge_0]).
  assert (Px : 0 <= Rabs (high l) * c) by (apply Rmult_le_pos; [apply Rabs_pos|exact Pc]).
  assert (Pn : 0 <= n) by (apply R64_pos, Rplus_le_le_0_compat; apply R64_pos; [apply Rplus_le_le_0_compat; [exact Lp|apply Rabs_pos]|exact Px]).
  assert (Pi : 0 < / t) by now apply Rinv_0_lt_compat.
  (* It is enough to have the parts of what is left. *)
  assert (Enough : forall a b e, 0 <= a -> a <= radius l -> Rabs (r - q * t - high l - low l) <= a -> 0 <= b -> e <= 900 * eta ->
    a + Rabs (low l) + b - 4 * (u * b) <= radius l + Rabs (low l) + R64 (Rabs (high l) * c) -> / t * Rabs (high l * ((high y - t) / high y)) <= / t * b + e ->
    stands (new q step (R64 (R64 (R64 (n / least) + R64 (Rabs step * EPSILON)) + UNDERFLOW))) (r / t)).
  { intros a b e Pa A V Pb E H D. apply new_stands; [exact Fq|apply F_R64|apply F_R64|apply R64_pos, Rplus_le_le_0_compat; [|apply bpow_ge_0]|].
    - apply R64_pos, Rplus_le_le_0_compat; apply R64_pos; apply Rmult_le_pos; [exact Pn|apply Rlt_le, Rinv_0_lt_compat, L|apply Rabs_pos|apply bpow_ge_0].
    - pose proof (Rabs_pos (low l)) as Pl. pose proof (top_enough (high l) (low l) (radius l) (radius y / high y) Ll Lr Pw (a + Rabs (low l)) b ltac:(lra) Pb ltac:(lra) H) as N. fold c in N. fold n in N.
      pose proof (radius_of_quotient n least (/ t) (a + Rabs (low l) + b) step (F_R64 _) Pn L Pi G ltac:(lra) N) as R.
      apply Rle_trans with (2 := R). pose proof (quotient_off r t q (high l) (low l) a (high y) b e Pt Ph V D) as O. fold step in O. lra. }
  split; [lra|]. pose proof (R64_pos _ Px) as Pz.
  destruct (orb (is_zero (exact q)) (is_zero y)) eqn:Z; [|destruct (andb (are_doubles (exact q) y) (Rlt_bool EXACT (Rabs (R64 (high (exact q) * high y))))) eqn:D].
  - (* A quotient that underflows. *)
    assert (Zy : is_zero y = false) by (unfold is_zero; rewrite Req_bool_false by lra; reflexivity). rewrite Zy, Bool.orb_false_r in Z.
    assert (q = 0) as Q0 by (unfold is_zero in Z; apply andb_prop in Z as [Z _]; cbn [exact high] in Z; revert Z; now destruct (Req_bool_spec q 0)).
    assert (Em : m = Fine 0 0 0) by (unfold m, mul; now rewrite Z). assert (El : high l = R64 (high x + low x)) by (unfold l; rewrite Em; now apply (sub_nothing x r)).
    pose proof (nothing _ _ Ph Q0) as Nx. destruct X as [(Xh & Xl & _ & _ & Xw) _].
    assert (B : 0 <= Rabs (high l) <= 2 * (eta * high y)).
    { split; [apply Rabs_pos|]. pose proof (sum_off _ _ Xh Xl) as [S _]. rewrite <- El in S. pose proof (tri (high x) (low x)) as S2.
      pose proof (small _ (Rabs_pos (high x))) as [h0 h1]. pose proof (small _ h0) as [h2 h3]. pose proof (u_times _ _ S2) as S3. pose proof (u_times _ _ Xw) as S4.
      replace (high l) with (high x + low x + - (high x + low x - high l)) by ring. eapply Rle_trans; [apply tri|]. rewrite Rabs_Ropp. lra. }
    destruct (tiny_doubt (Rabs (high l)) (high y) (low y) (radius y) t (F_abs _ Lh) B Ph Yp Rw Pt T Yw Yv) as (b & B0 & B1 & B2). fold c in B1.
    apply (Enough (radius l) b (20 * eta)); try assumption; try lra. rewrite Rabs_mult in B2 |- *. rewrite Rabs_Rabsolu in B2. exact B2.
  - (* A double: there is no doubt about it. *)
    apply andb_prop in D as [D _]. unfold are_doubles, is_exact in D. apply andb_prop in D as [D Z4]. apply andb_prop in D as [D _]. apply andb_prop in D as [_ Z2].
    assert (t = high y) as Et. { revert Z2 Z4. destruct (Req_bool_spec (low y) 0) as [E1|], (Req_bool_spec (radius y) 0) as [E2|]; try discriminate. rewrite E1, E2 in Yv. apply Rabs_le_inv in Yv. lra. }
    apply (Enough (radius l) 0 0); try assumption; try lra. rewrite Et. replace (high l * _) with 0 by (field; lra). rewrite Rabs_R0. lra.
  - (* A product that was rounded has some to spare. *)
    assert (S : Rabs (r - q * t - high l - low l) <= radius l - 8000 * eta).
    { apply spare; [lra|]. intros d Hd. replace (r - q * t + d) with (r - (q * t + - d)) by ring. apply sub_stands; [exact X|]. apply mul_stands_spare; try assumption. now rewrite Rabs_Ropp. }
    pose proof (Rabs_pos (r - q * t - high l - low l)) as Pa. set (b := Rabs (high l) * (radius y / high y + u)).
    assert (Pb : 0 <= b) by (apply Rmult_le_pos; [apply Rabs_pos|lra]). pose proof (small b Pb) as [b0 b1]. pose proof (small _ b0) as [b2 b3].
    apply (Enough (radius l - 8000 * eta) b 0); try assumption; try lra.
    + pose proof (of_whole_enough (radius y / high y) Pw) as C. fold c in C. pose proof (product_low _ Px) as Z1.
      assert (C' : Rabs (high l) * ((radius y / high y + u) - 2 * (u * (radius y / high y + u))) <= Rabs (high l) * c) by (apply Rmult_le_compat_l; [apply Rabs_pos|exact C]).
      replace (Rabs (high l) * (_ - _)) with (b - 2 * (u * b)) in C' by (unfold b; ring). assert (C2 : (b - 2 * (u * b)) * (1 - u) <= Rabs (high l) * c * (1 - u)) by (apply Rmult_le_compat_r; lra). lra.
    + rewrite Rplus_0_r. apply Rmult_le_compat_l; [lra|]. now apply (doubt_is t (high l) (high y) (low y) (radius y)).
Qed.

(** Quotients stand for the quotients of all that the two stand for, and no divisor is 0. [NEAR-5] *)
Theorem over_stands x y r t : stands x r -> stands y t -> 0 < fst (over x y) -> t <> 0 /\ stands (snd (over x y)) (r / t).
Proof.
  intros X Y. unfold over. destruct (Rlt_bool_spec (high y) 0) as [N|P]; [|now apply over_positive_stands]. intros L.
  destruct (over_positive_stands (neg x) (neg y) (- r) (- t)) as [Z S]; [now apply neg_stands..|cbn; lra|exact L|]. split; [lra|].
  replace (r / t) with (- r / - t) by (field; lra). exact S.
Qed.

(** [hull]: these, those of the other, and all between. [NEAR-5] *)
Theorem hull_stands x y r t v : stands x r -> stands y t -> Rmin r t <= v <= Rmax r t -> stands (hull x y) v.
Proof.
  intros X Y V. assert (M : stands (Fine (high x) (low x) 0) (high x + low x)).
  { destruct X as [(A & B & _ & _ & W) _]. split; [repeat split; cbn [high low radius]; try assumption; [apply generic_format_0|lra]|]. unfold holds. cbn. replace (_ - _ - _) with 0 by ring. rewrite Rabs_R0. lra. }
  pose proof (sub_stands _ _ _ _ Y M) as [(Ah & Al & Ar & Ap & _) D]. unfold holds in D. destruct X as [(Xh & Xl & Xr & Xp & Xw) Xv]. unfold holds in Xv. unfold hull.
  set (apart := sub y _) in *. set (reach := R64 (_ * UP)).
  assert (S : Rabs (t - high x - low x) <= reach).
  { eapply Rle_trans; [|apply up_three; try apply F_abs; try assumption; apply Rabs_pos].
    replace (t - high x - low x) with (t - (high x + low x) - high apart - low apart + (high apart + low apart)) by ring. eapply Rle_trans; [apply tri|]. pose proof (tri (high apart) (low apart)). lra. }
  set (d := if Rlt_bool reach (radius x) then radius x else reach). assert (D1 : radius x <= d /\ reach <= d /\ F d).
  { unfold d. destruct (Rlt_bool_spec reach (radius x)); repeat split; try lra; try assumption. apply F_R64. }
  destruct D1 as (D1 & D2 & D3). split; [repeat split; cbn [high low radius]; try assumption; lra|]. unfold holds. cbn [high low radius].
  apply Rabs_le_inv in Xv, S. apply Rabs_le. revert V. unfold Rmin, Rmax. destruct (Rle_dec r t); lra.
Qed.
