(** [Determinants::over_determinant] of src/geom/kernel/exact/filter.rs on IEEE 754 doubles: for a certain hit of single-precision
    data every number on the way is 0 or between 2^-892 and 2^840, so nothing over- or underflows, and the ends are those of
    Quotient.v. Only the last sum and the last difference may be smaller, and then they are exact. *)
Require Import Reals ZArith Lia Lra Psatz.
From Flocq Require Import Core BinarySingleNaN Plus_error.
Require Import StacklessExact.Rounding StacklessExact.Triple StacklessExact.Filter StacklessExact.Quotient StacklessExact.Range
  StacklessExact.Overflow.
Open Scope R_scope.

Local Instance prec_53 : Prec_gt_0 53 := eq_refl.
Local Instance emax_1024 : Prec_lt_emax 53 1024 := eq_refl.

(** [Determinants::over_determinant]: recip divides 1; the last constant is QUOTIENT times UNIT. *)
Definition code_over (numerator error det error_of_det : float) : float * float :=
  let reciprocal := over (constant 1 0) det in
  let x := times numerator reciprocal in
  let e := plus (times (plus error (times (Babs x) error_of_det)) (Babs reciprocal)) (times (Babs x) (constant 4 (-53))) in
  (minus x e, plus x e).

(** * Ranges *)

(** 0, or neither too small nor too great. *)
Definition within (low high : Z) (x : R) : Prop := x = 0 \/ bpow radix2 low <= Rabs x <= bpow radix2 high.

(** The float is finite, and is that number. *)
Definition is_number (x : float) (r : R) : Prop := is_finite x = true /\ B2R x = r.

Lemma format_X e : generic_format radix2 (FLX_exp 53) (bpow radix2 e).
Proof. apply generic_format_bpow. unfold FLX_exp. lia. Qed.

Lemma within_RX low high x : within low high x -> within low high (RX x).
Proof.
  intros [-> |[L H]]; [left; apply round_0; typeclasses eauto|right].
  split; [apply abs_round_ge_generic|apply abs_round_le_generic]; try typeclasses eauto; auto using format_X.
Qed.

Lemma within_top low high x : (high <= 1023)%Z -> within low high x -> Rabs (RX x) < bpow radix2 1024.
Proof.
  intros Hh W. destruct (within_RX _ _ _ W) as [-> |[_ H]]; [rewrite Rabs_R0; apply bpow_gt_0|].
  eapply Rle_lt_trans; [exact H|apply bpow_lt; lia].
Qed.

Lemma within_same low high x : (-1022 <= low)%Z -> within low high x -> R64 x = RX x.
Proof.
  intros Hl [-> |[L _]]; [now rewrite !round_0 by typeclasses eauto|]. apply (same_if_big (-1074) 53). right.
  eapply Rle_trans; [apply bpow_le|exact L]. lia.
Qed.

Lemma within_most low high x : within low high x -> Rabs x <= bpow radix2 high.
Proof. intros [-> |[_ H]]; [rewrite Rabs_R0; apply bpow_ge_0|exact H]. Qed.

Lemma within_mult l h l' h' x y : within l h x -> within l' h' y -> within (l + l') (h + h') (x * y).
Proof.
  intros [-> |X] [-> |Y]; try (left; ring). right. rewrite Rabs_mult, !bpow_plus.
  split; apply Rmult_le_compat; try apply bpow_ge_0; try apply Rabs_pos; tauto.
Qed.

Lemma within_abs l h x : within l h x -> within l h (Rabs x).
Proof. intros [-> |X]; [left; apply Rabs_R0|right; now rewrite Rabs_Rabsolu]. Qed.

Lemma within_more l h l' h' x : within l h x -> (l' <= l)%Z -> (h <= h')%Z -> within l' h' x.
Proof.
  intros [-> |X] L H; [now left|right]. split; (eapply Rle_trans; [|apply X]) || (eapply Rle_trans; [apply X|]); now apply bpow_le.
Qed.

(** A sum of numbers that are not negative. *)
Lemma within_plus l h x y : 0 <= x -> 0 <= y -> within l h x -> within l h y -> within l (h + 1) (x + y).
Proof.
  intros Px Py X Y. pose proof (within_most _ _ _ X) as MX. pose proof (within_most _ _ _ Y) as MY. pose proof (add_b _ _ _ _ MX MY) as M.
  rewrite twice in M. destruct X as [-> |X].
  - destruct Y as [-> |Y]; [left; ring|right; split; [rewrite Rplus_0_l; apply Y|exact M]].
  - right. split; [|exact M]. rewrite Rabs_pos_eq by lra. rewrite Rabs_pos_eq in X by assumption. lra.
Qed.

(** A sum of floats is the same with and without a least exponent: where it is small it is exact. *)
Lemma same_sum a b : generic_format radix2 (FLT_exp (-1074) 53) a -> generic_format radix2 (FLT_exp (-1074) 53) b ->
  R64 (a + b) = RX (a + b).
Proof.
  intros Fa Fb. destruct (Rle_or_lt (bpow radix2 (-1022)) (Rabs (a + b))) as [H|H].
  - apply (same_if_big (-1074) 53). now right.
  - assert (F : generic_format radix2 (FLT_exp (-1074) 53) (a + b)).
    { apply FLT_format_plus_small; [reflexivity|assumption|assumption|]. eapply Rlt_le, Rlt_le_trans; [exact H|apply bpow_le; lia]. }
    rewrite !round_generic; try typeclasses eauto; try assumption; [reflexivity|]. now apply generic_format_FLX_FLT with (-1074)%Z.
Qed.

Lemma times_is low high x y a b : (-1022 <= low)%Z -> (high <= 1023)%Z -> is_number x a -> is_number y b -> within low high (a * b) ->
  is_number (times x y) (RX (a * b)) /\ within low high (RX (a * b)).
Proof.
  intros L H (Fx & <-) (Fy & <-) W. split; [|now apply within_RX]. generalize (Bmult_correct 53 1024 _ _ mode_NE x y).
  change (round_mode mode_NE) with ZnearestE. change (SpecFloat.fexp 53 1024) with (FLT_exp (-1074) 53).
  rewrite (within_same _ _ _ L W). rewrite Rlt_bool_true by exact (within_top _ _ _ H W). rewrite Fx, Fy.
  intros (V & F & _). now split.
Qed.

Lemma over_is low high x y a b : (-1022 <= low)%Z -> (high <= 1023)%Z -> is_number x a -> is_number y b -> b <> 0 -> within low high (a / b) ->
  is_number (over x y) (RX (a / b)) /\ within low high (RX (a / b)).
Proof.
  intros L H (Fx & <-) (Fy & <-) N W. split; [|now apply within_RX]. generalize (Bdiv_correct 53 1024 _ _ mode_NE x y N).
  change (round_mode mode_NE) with ZnearestE. change (SpecFloat.fexp 53 1024) with (FLT_exp (-1074) 53).
  rewrite (within_same _ _ _ L W). rewrite Rlt_bool_true by exact (within_top _ _ _ H W). rewrite Fx.
  intros (V & F & _). now split.
Qed.

Lemma sum_top high a b : (high <= 1022)%Z -> Rabs a <= bpow radix2 high -> Rabs b <= bpow radix2 high ->
  Rabs (RX (a + b)) < bpow radix2 1024.
Proof.
  intros H A B. pose proof (add_b _ _ _ _ A B) as S. rewrite twice in S.
  apply Rle_lt_trans with (bpow radix2 (high + 1)); [|apply bpow_lt; lia].
  apply abs_round_le_generic; try typeclasses eauto; auto using format_X.
Qed.

Lemma plus_is high x y a b : (high <= 1022)%Z -> is_number x a -> is_number y b -> Rabs a <= bpow radix2 high -> Rabs b <= bpow radix2 high ->
  is_number (plus x y) (RX (a + b)).
Proof.
  intros H (Fx & <-) (Fy & <-) A B. generalize (Bplus_correct 53 1024 _ _ mode_NE x y Fx Fy).
  change (round_mode mode_NE) with ZnearestE. change (SpecFloat.fexp 53 1024) with (FLT_exp (-1074) 53).
  rewrite same_sum by apply generic_format_B2R. rewrite Rlt_bool_true by exact (sum_top _ _ _ H A B). intros (V & F & _). now split.
Qed.

Lemma minus_is high x y a b : (high <= 1022)%Z -> is_number x a -> is_number y b -> Rabs a <= bpow radix2 high -> Rabs b <= bpow radix2 high ->
  is_number (minus x y) (RX (a - b)).
Proof.
  intros H (Fx & <-) (Fy & <-) A B. generalize (Bminus_correct 53 1024 _ _ mode_NE x y Fx Fy).
  change (round_mode mode_NE) with ZnearestE. change (SpecFloat.fexp 53 1024) with (FLT_exp (-1074) 53).
  rewrite <- Rabs_Ropp in B. unfold Rminus.
  rewrite same_sum by (try apply generic_format_opp; apply generic_format_B2R).
  rewrite Rlt_bool_true by exact (sum_top _ _ _ H A B). intros (V & F & _). now split.
Qed.

Lemma abs_is x a : is_number x a -> is_number (Babs x) (Rabs a).
Proof. intros (F & <-). split; [now rewrite is_finite_Babs|apply B2R_Babs]. Qed.

(** * The quotient *)

(** The errors are relative to the determinant neither too small nor too great, which is so for a certain hit: then the ends are
    finite and those of Quotient.v. [EXACT-9] *)
Theorem quotient_in_range N ET DET ED n et dt ed : is_number N n -> is_number ET et -> is_number DET dt -> is_number ED ed ->
  within (-447) 390 n -> 0 <= et -> within (-504) 345 et -> bpow radix2 (-447) <= Rabs dt <= bpow radix2 388 ->
  8 * u * Rabs dt <= ed <= Rabs dt ->
  is_number (fst (code_over N ET DET ED)) (fst (over_determinant RX u n et dt ed)) /\
  is_number (snd (code_over N ET DET ED)) (snd (over_determinant RX u n et dt ed)).
Proof.
  intros In Iet Idt Ied Wn Pet Wet Wdt Hed. unfold code_over, over_determinant. cbv zeta. cbn [fst snd].
  assert (Hu : 0 < u <= / 2048) by (apply Rounding.Hu; lia).
  pose proof (RN_pos 53 ltac:(lia)) as pos.
  assert (Pd : 0 < Rabs dt) by (eapply Rlt_le_trans; [apply bpow_gt_0|apply Wdt]).
  assert (Nd : dt <> 0) by (intros Z; rewrite Z, Rabs_R0 in Pd; lra).
  assert (I1 : is_number (constant 1 0) 1).
  { destruct (constant_fits 1 0) as [F V]; [reflexivity|lia|]. split; [exact F|]. rewrite V. simpl. ring. }
  assert (I4 : is_number (constant 4 (-53)) (4 * u)).
  { destruct (constant_fits 4 (-53)) as [F V]; [reflexivity|lia|]. now split. }
  assert (Ai : Rabs (1 / dt) = / Rabs dt) by (unfold Rdiv; rewrite Rmult_1_l; apply Rabs_inv).
  assert (W1 : within (-388) 447 (1 / dt)).
  { right. rewrite Ai. change (-388)%Z with (- (388))%Z. change 447%Z with (- (-447))%Z. rewrite !(bpow_opp _ _).
    split; apply Rinv_le; try apply Wdt; [exact Pd|apply bpow_gt_0]. }
  destruct (over_is (-388) 447 _ _ _ _ ltac:(lia) ltac:(lia) I1 Idt Nd W1) as [Ir Wr].
  destruct (Rounding.rel 53 ltac:(lia) (1 / dt)) as (a & Ha & Er). set (r := RX (1 / dt)) in *.
  pose proof (within_mult _ _ _ _ _ _ Wn Wr) as W2. simpl Z.add in W2.
  destruct (times_is (-835) 837 _ _ _ _ ltac:(lia) ltac:(lia) In Ir W2) as [Ix Wx].
  destruct (Rounding.rel 53 ltac:(lia) (n * r)) as (b & Hb & Ex). set (x := RX (n * r)) in *.
  apply Rabs_le_inv in Ha. apply Rabs_le_inv in Hb.
  (* |x| times |det| is about |n|. *)
  assert (Xd : Rabs x * Rabs dt = Rabs n * ((1 + a) * (1 + b))).
  { rewrite Ex, Er. rewrite !Rabs_mult, Ai. rewrite (Rabs_pos_eq (1 + a)), (Rabs_pos_eq (1 + b)) by lra. field. lra. }
  assert (M : / 2 <= (1 + a) * (1 + b) <= 2) by nra.
  assert (W3 : within (-498) 391 (Rabs x * ed)).
  { destruct Wn as [Zn|Wn].
    - left. assert (x = 0) as ->; [|rewrite Rabs_R0; ring]. unfold x. rewrite Zn, Rmult_0_l. apply round_0. typeclasses eauto.
    - right. assert (Px : 0 <= Rabs x) by apply Rabs_pos. assert (Pn : 0 <= Rabs n) by apply Rabs_pos.
      assert (Ped : 0 <= ed) by (assert (0 <= 8 * u * Rabs dt) by (apply Rmult_le_pos; lra); lra).
      rewrite Rabs_mult, Rabs_Rabsolu, (Rabs_pos_eq ed) by exact Ped. split.
      + apply Rle_trans with (Rabs x * (8 * u * Rabs dt)); [|apply Rmult_le_compat_l; [exact Px|apply Hed]].
        replace (Rabs x * (8 * u * Rabs dt)) with (8 * u * (Rabs x * Rabs dt)) by ring. rewrite Xd.
        apply Rle_trans with (8 * u * (Rabs n * / 2)).
        * replace (bpow radix2 (-498)) with (4 * u * bpow radix2 (-447)).
          -- assert (4 * u * bpow radix2 (-447) <= 4 * u * Rabs n) by (apply Rmult_le_compat_l; [lra|apply Wn]). lra.
          -- change 4 with (bpow radix2 2). rewrite <- !bpow_plus. reflexivity.
        * apply Rmult_le_compat_l; [lra|]. apply Rmult_le_compat_l; [exact Pn|lra].
      + apply Rle_trans with (Rabs x * Rabs dt); [apply Rmult_le_compat_l; [exact Px|apply Hed]|]. rewrite Xd.
        change 391%Z with (390 + 1)%Z. rewrite bpow_plus. change (bpow radix2 1) with 2. apply Rmult_le_compat; try lra; apply Wn. }
  destruct (times_is (-498) 391 _ _ _ _ ltac:(lia) ltac:(lia) (abs_is _ _ Ix) Ied W3) as [I5 W5].
  assert (P5 : 0 <= RX (Rabs x * ed)).
  { apply pos, Rmult_le_pos; [apply Rabs_pos|]. assert (0 <= 8 * u * Rabs dt) by (apply Rmult_le_pos; lra). lra. }
  set (g1 := RX (Rabs x * ed)) in *.
  pose proof (within_plus (-504) 391 et g1 Pet P5 (within_more (-504) 345 (-504) 391 _ Wet ltac:(lia) ltac:(lia)) (within_more (-498) 391 (-504) 391 _ W5 ltac:(lia) ltac:(lia))) as W6.
  simpl Z.add in W6. apply within_RX in W6.
  pose proof (plus_is 391 _ _ _ _ ltac:(lia) Iet I5 (within_most _ _ _ (within_more (-504) 345 (-504) 391 _ Wet ltac:(lia) ltac:(lia))) (within_most _ _ _ W5)) as I6.
  assert (P6 : 0 <= RX (et + g1)) by (apply pos; lra). set (g2 := RX (et + g1)) in *.
  pose proof (within_mult _ _ _ _ _ _ W6 (within_abs _ _ _ Wr)) as W7. simpl Z.add in W7.
  destruct (times_is (-892) 839 _ _ _ _ ltac:(lia) ltac:(lia) I6 (abs_is _ _ Ir) W7) as [I7 W7'].
  assert (P7 : 0 <= RX (g2 * Rabs r)) by (apply pos, Rmult_le_pos; [exact P6|apply Rabs_pos]). set (g3 := RX (g2 * Rabs r)) in *.
  assert (W4 : within (-51) (-51) (4 * u)).
  { right. rewrite Rabs_pos_eq by lra. replace (4 * u) with (bpow radix2 (-51)); [lra|].
    change 4 with (bpow radix2 2). rewrite <- bpow_plus. reflexivity. }
  pose proof (within_mult _ _ _ _ _ _ (within_abs _ _ _ Wx) W4) as W8. simpl Z.add in W8.
  destruct (times_is (-886) 786 _ _ _ _ ltac:(lia) ltac:(lia) (abs_is _ _ Ix) I4 W8) as [I8 W8'].
  assert (P8 : 0 <= RX (Rabs x * (4 * u))) by (apply pos, Rmult_le_pos; [apply Rabs_pos|lra]). set (g4 := RX (Rabs x * (4 * u))) in *.
  pose proof (within_plus (-892) 839 g3 g4 P7 P8 (within_more (-892) 839 (-892) 839 _ W7' ltac:(lia) ltac:(lia)) (within_more (-886) 786 (-892) 839 _ W8' ltac:(lia) ltac:(lia))) as W9.
  simpl Z.add in W9. apply within_RX in W9.
  pose proof (plus_is 839 _ _ _ _ ltac:(lia) I7 I8 (within_most _ _ _ (within_more (-892) 839 (-892) 839 _ W7' ltac:(lia) ltac:(lia)))
    (within_most _ _ _ (within_more (-886) 786 (-892) 839 _ W8' ltac:(lia) ltac:(lia)))) as I9.
  set (e := RX (g3 + g4)) in *.
  pose proof (within_most _ _ _ (within_more (-835) 837 (-1000) 840 _ Wx ltac:(lia) ltac:(lia))) as Mx. pose proof (within_most _ _ _ W9) as Me.
  split; [apply (minus_is 840)|apply (plus_is 840)]; assumption || lia.
Qed.
