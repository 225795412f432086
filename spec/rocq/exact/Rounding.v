(** Rounding to nearest, ties to even: what the proofs of this folder use of it. Two formats: with gradual underflow (FLT), as
    floats are, and without a least exponent (FLX), where every rounding is a relative error. *)
Require Import Reals ZArith Lia Lra Psatz.
From Flocq Require Import Core Relative Plus_error.
Open Scope R_scope.

(** * Magnitudes *)

Lemma mul_b x y X Y : Rabs x <= X -> Rabs y <= Y -> Rabs (x * y) <= X * Y.
Proof. intros. rewrite Rabs_mult. apply Rmult_le_compat; auto using Rabs_pos. Qed.
Lemma add_b x y X Y : Rabs x <= X -> Rabs y <= Y -> Rabs (x + y) <= X + Y.
Proof. intros. eapply Rle_trans; [apply Rabs_triang|lra]. Qed.
Lemma sub_b x y X Y : Rabs x <= X -> Rabs y <= Y -> Rabs (x - y) <= X + Y.
Proof. intros. unfold Rminus. apply add_b; [assumption|now rewrite Rabs_Ropp]. Qed.
Lemma far_b a b c x y : Rabs (a - b) <= x -> Rabs (b - c) <= y -> Rabs (a - c) <= x + y.
Proof. intros. replace (a - c) with ((a - b) + (b - c)) by ring. now apply add_b. Qed.
Lemma pos_b x X : Rabs x <= X -> 0 <= X.
Proof. intros. pose proof (Rabs_pos x). lra. Qed.

(** What a comparison says. *)
Lemma ltb_true x y : Rlt_bool x y = true -> x < y.
Proof. now destruct (Rlt_bool_spec x y). Qed.

(** * The unit *)

(** Half of the distance from 1 to the next float: 2^-24 for f32, 2^-53 for f64. *)
Notation unit prec := (bpow radix2 (- prec)).

Lemma unit_half prec : / 2 * bpow radix2 (- prec + 1) = unit prec.
Proof. rewrite bpow_plus. change (bpow radix2 1) with 2. field. Qed.

Lemma unit_small prec : (11 <= prec)%Z -> 0 < unit prec <= / 2048.
Proof. intros. split; [apply bpow_gt_0|]. change (/ 2048) with (bpow radix2 (-11)). apply bpow_le. lia. Qed.

Lemma unit_ratio u : 0 < u -> u / (1 + u) <= u.
Proof. intros. apply Rmult_le_reg_r with (1 + u); [lra|]. field_simplify; nra. Qed.

(** * Without a least exponent *)

Section Unbounded.
Variable prec : Z.
Context { prec_pos : Prec_gt_0 prec }.
Hypothesis prec_11 : (11 <= prec)%Z.
Notation RN := (round radix2 (FLX_exp prec) ZnearestE).
Notation u := (unit prec).

Lemma Hu : 0 < u <= / 2048.
Proof. apply unit_small, prec_11. Qed.

Lemma rel_tight x : exists e, Rabs e <= u / (1 + u) /\ RN x = x * (1 + e).
Proof.
  destruct (relative_error_N_FLX'_ex radix2 prec prec_pos (fun z => negb (Z.even z)) x) as (e & He & E).
  exists e. split; [|exact E]. unfold u_ro in He. now rewrite unit_half in He.
Qed.

(** A rounded number is the number times 1 + e. [EXACT-4] *)
Theorem rel x : exists e, Rabs e <= u /\ RN x = x * (1 + e).
Proof. destruct (rel_tight x) as (e & He & E). exists e. split; [|exact E]. pose proof Hu. pose proof (unit_ratio u). lra. Qed.

(** And the other way round. *)
Lemma back x : exists e, Rabs e <= u /\ x = RN x * (1 + e).
Proof.
  pose proof Hu. destruct (rel_tight x) as (e & He & E). pose proof (unit_ratio u ltac:(lra)).
  assert (A : - (u / (1 + u)) <= e <= u / (1 + u)) by (split_Rabs; lra).
  assert (L : 0 < 1 + e) by lra.
  exists (- e / (1 + e)). split; [|rewrite E; field; lra].
  assert (B : - u * (1 + e) <= - e <= u * (1 + e)).
  { assert (u / (1 + u) * (1 + u) = u) by (field; lra). set (v := u / (1 + u)) in *. nra. }
  apply Rabs_le. split; apply Rmult_le_reg_r with (1 + e); try assumption; field_simplify; lra.
Qed.

Lemma below x : 0 <= x -> x * (1 - u) <= RN x.
Proof. intros Hx. destruct (rel x) as (e & He & ->). apply Rmult_le_compat_l; [assumption|]. apply Rabs_le_inv in He. lra. Qed.

Lemma RN_pos x : 0 <= x -> 0 <= RN x.
Proof. intros H. pose proof Hu. eapply Rle_trans; [|apply (below x H)]. apply Rmult_le_pos; lra. Qed.

Lemma RN_opp x : RN (- x) = - RN x.
Proof. apply round_NE_opp. Qed.
End Unbounded.

(** * With gradual underflow *)

Section Gradual.
Variables emin prec : Z.
Context { prec_pos : Prec_gt_0 prec }.
Notation fexp := (FLT_exp emin prec).
Notation F := (generic_format radix2 fexp).
Notation RN := (round radix2 fexp ZnearestE).
Notation RX := (round radix2 (FLX_exp prec) ZnearestE).
Notation u := (unit prec).

(** A difference of floats never suffers from underflow. [BOX-2] *)
Theorem difference b o : F b -> F o -> exists e, Rabs e <= u / (1 + u) /\ RN (b - o) = (b - o) * (1 + e).
Proof.
  intros Hb Ho.
  destruct (FLT_plus_error_N_ex radix2 emin prec (fun x => negb (Z.even x)) b (- o)) as (e & He & E);
    [exact Hb|apply generic_format_opp, Ho|].
  exists e. split; [|exact E]. unfold u_ro in He. now rewrite unit_half in He.
Qed.

(** A multiple of 2^e. *)
Definition multiple (e : Z) (x : R) : Prop := exists n : Z, x = IZR n * bpow radix2 e.

Lemma multiple_0 e : multiple e 0.
Proof. exists 0%Z. ring. Qed.

Lemma multiple_mult e e' x y : multiple e x -> multiple e' y -> multiple (e + e') (x * y).
Proof. intros (n & ->) (m & ->). exists (n * m)%Z. rewrite mult_IZR, bpow_plus. ring. Qed.

Lemma multiple_plus e x y : multiple e x -> multiple e y -> multiple e (x + y).
Proof. intros (n & ->) (m & ->). exists (n + m)%Z. rewrite plus_IZR. ring. Qed.

Lemma multiple_opp e x : multiple e x -> multiple e (- x).
Proof. intros (n & ->). exists (- n)%Z. rewrite opp_IZR. ring. Qed.

Lemma multiple_minus e x y : multiple e x -> multiple e y -> multiple e (x - y).
Proof. intros. apply multiple_plus; [assumption|now apply multiple_opp]. Qed.

(** A multiple is 0 or not small. *)
Lemma multiple_big e x : multiple e x -> x = 0 \/ bpow radix2 e <= Rabs x.
Proof.
  intros (n & ->). destruct (Z.eq_dec n 0) as [-> |Hn]; [left; ring|right].
  rewrite Rabs_mult, (Rabs_pos_eq (bpow radix2 e)) by apply bpow_ge_0. rewrite <- (Rmult_1_l (bpow radix2 e)) at 1.
  apply Rmult_le_compat_r; [apply bpow_ge_0|]. rewrite <- abs_IZR. apply IZR_le. lia.
Qed.

(** A rounded multiple is a multiple: either nothing is rounded, or only to a coarser grid. *)
Lemma multiple_round e x : multiple e x -> multiple e (RX x).
Proof.
  intros (n & E). destruct (Z_le_gt_dec e (cexp radix2 (FLX_exp prec) x)) as [H|H].
  - unfold round, F2R. simpl. set (m := ZnearestE _). set (c := cexp _ _ _) in *. exists (m * 2 ^ (c - e))%Z.
    rewrite mult_IZR, (IZR_Zpower radix2) by lia. rewrite Rmult_assoc, <- bpow_plus. do 2 f_equal. lia.
  - assert (G : generic_format radix2 (FLX_exp prec) x).
    { rewrite E. change (IZR n * bpow radix2 e) with (F2R (Float radix2 n e)). apply generic_format_F2R.
      intros _. change (F2R (Float radix2 n e)) with (IZR n * bpow radix2 e). rewrite <- E. lia. }
    rewrite round_generic; [now exists n|typeclasses eauto|exact G].
Qed.

(** Where nothing underflows the two formats agree. *)
Lemma same_if_big x : x = 0 \/ bpow radix2 (emin + prec - 1) <= Rabs x -> RN x = RX x.
Proof. intros [-> |H]; [now rewrite !round_0 by typeclasses eauto|now apply round_FLT_FLX]. Qed.

Lemma same_if_multiple e x : multiple e x -> (emin + prec - 1 <= e)%Z -> RN x = RX x.
Proof.
  intros H He. apply same_if_big. destruct (multiple_big _ _ H) as [|B]; [now left|right].
  eapply Rle_trans; [apply bpow_le, He|exact B].
Qed.
End Gradual.
