(** The distances that [Slabs64] of src/geom/slabs/slabs64.rs reports, and the end of its lanes: doubles, without a least and a greatest
    exponent. *)
Require Import Reals ZArith Lia Lra Psatz.
From Flocq Require Import Core.
Require Import StacklessExact.Rounding StacklessExact.FramedSlabs.
Open Scope R_scope.

Local Instance prec_24 : Prec_gt_0 24 := eq_refl.
Local Instance prec_53 : Prec_gt_0 53 := eq_refl.
Notation F := (generic_format radix2 (FLT_exp (-149) 24)).
Notation R32 := (round radix2 (FLT_exp (-149) 24) ZnearestE).
Notation RX := (round radix2 (FLX_exp 53) ZnearestE).
Notation FX := (generic_format radix2 (FLX_exp 53)).

Lemma of_single x : F x -> FX x.
Proof.
  intros H. apply FLT_format_generic in H; [|typeclasses eauto]. destruct H as [[m e] -> Hm _]. apply generic_format_FLX.
  exists (Float radix2 m e); [reflexivity|]. simpl in *. lia.
Qed.

(** Few units of the least number of single precision. *)
Lemma few_units x m : x = IZR m * bpow radix2 (-149) -> (Z.abs m < 2 ^ 53)%Z -> RX x = x.
Proof.
  intros -> H. apply round_generic; [typeclasses eauto|]. apply generic_format_FLX. exists (Float radix2 m (-149)); [reflexivity|exact H].
Qed.

Lemma single_units x : F x -> exists m, x = IZR m * bpow radix2 (-149).
Proof.
  intros H. apply FLT_format_generic in H; [|typeclasses eauto]. destruct H as [[m e] -> _ He]. simpl in He.
  exists (m * 2 ^ (e + 149))%Z. unfold F2R. simpl Fnum. simpl Fexp.
  rewrite mult_IZR, (IZR_Zpower radix2) by lia. rewrite Rmult_assoc, <- bpow_plus. do 2 f_equal. lia.
Qed.

Lemma units_below x m e : (0 <= e)%Z -> x = IZR m * bpow radix2 (-149) -> Rabs x <= bpow radix2 (e + -149) -> (Z.abs m <= 2 ^ e)%Z.
Proof.
  intros He -> H. rewrite Rabs_mult, (Rabs_pos_eq (bpow radix2 (-149))), bpow_plus in H by apply bpow_ge_0.
  apply Rmult_le_reg_r in H; [|apply bpow_gt_0]. rewrite <- abs_IZR, <- (IZR_Zpower radix2) in H by exact He. now apply le_IZR in H.
Qed.

Lemma RX_mono x y : x <= y -> RX x <= RX y.
Proof. intros. now apply round_le; try typeclasses eauto. Qed.
Lemma RX_id x : FX x -> RX x = x.
Proof. intros. now apply round_generic; [typeclasses eauto|]. Qed.

(** Units of distance are powers of two. *)
Lemma RX_scale x k : RX (x * bpow radix2 k) = RX x * bpow radix2 k.
Proof.
  destruct (Req_dec x 0) as [-> |N]; [rewrite Rmult_0_l, !round_0 by typeclasses eauto; ring|].
  unfold round, scaled_mantissa, cexp, F2R. rewrite mag_mult_bpow by exact N. unfold FLX_exp. cbn [Fnum Fexp].
  replace (x * bpow radix2 k * bpow radix2 (- (mag radix2 x + k - 53))) with (x * bpow radix2 (- (mag radix2 x - 53))).
  - replace (mag radix2 x + k - 53)%Z with (mag radix2 x - 53 + k)%Z by lia. rewrite (bpow_plus _ _ k). ring.
  - rewrite Rmult_assoc, <- bpow_plus. do 2 f_equal. lia.
Qed.

Section Ends.
(** The exponent of the frame's units in a distance of 1, the entry in them, and a hit at t. *)
Variable n : Z.
Variables start t : R.
Hypothesis Ft : FX start.
Hypothesis Pt : 0 <= t.
Let tau := t * bpow radix2 n - start.
Hypothesis Ptau : 0 <= tau.

Lemma distance_is x : RX (RX (RX x + start) * bpow radix2 (- n)) = RX (RX x + start) * bpow radix2 (- n).
Proof. rewrite RX_scale. f_equal. apply RX_id, generic_format_round; typeclasses eauto. Qed.

Lemma unscaled : RX (t * bpow radix2 n) * bpow radix2 (- n) = RX t.
Proof. rewrite RX_scale, Rmult_assoc, <- bpow_plus, Z.add_opp_diag_r. simpl. ring. Qed.

(** The reported near bound of a box is at most the rounded distance of a hit in it. [BOX-8] *)
Theorem reported_near near : F near -> near <= near_top tau -> RX (RX (RX (near - bpow radix2 (-149)) + start) * bpow radix2 (- n)) <= RX t.
Proof.
  intros Fn H. rewrite distance_is, <- unscaled. apply Rmult_le_compat_r; [apply bpow_ge_0|].
  replace (t * bpow radix2 n) with (tau + start) by (unfold tau; ring). apply RX_mono, Rplus_le_compat_r.
  assert (P : 0 < bpow radix2 (-149)) by apply bpow_gt_0.
  assert (M : near <= Rmax tau (Rmin (tau + eta) (bpow radix2 (-126)))) by (eapply Rle_trans; [exact H|apply Rmin_r]).
  destruct (Rle_or_lt near tau) as [L|L].
  - apply Rle_trans with (RX near); [apply RX_mono; lra|]. now rewrite (RX_id near) by now apply of_single.
  - assert (K : near <= Rmin (tau + eta) (bpow radix2 (-126))) by (unfold Rmax in M; destruct (Rle_dec _ _); lra).
    pose proof (Rle_trans _ _ _ K (Rmin_l _ _)) as K1. pose proof (Rle_trans _ _ _ K (Rmin_r _ _)) as K2.
    destruct (single_units near Fn) as (m & E). assert (B : (Z.abs m <= 2 ^ 23)%Z) by (apply (units_below near); [lia|exact E|rewrite Rabs_pos_eq by lra; exact K2]).
    rewrite (few_units _ (m - 1)) by (rewrite ?minus_IZR, ?E; ring || lia).
    assert (eta < bpow radix2 (-149)) by (apply bpow_lt; lia). lra.
Qed.

(** And the reported far bound is at least that. [BOX-8] *)
Theorem reported_far far : F far -> far_low tau <= far -> RX t <= RX (RX (RX (far + bpow radix2 (-149)) + start) * bpow radix2 (- n)).
Proof.
  intros Fr H. rewrite distance_is, <- unscaled. apply Rmult_le_compat_r; [apply bpow_ge_0|].
  replace (t * bpow radix2 n) with (tau + start) by (unfold tau; ring). apply RX_mono, Rplus_le_compat_r.
  assert (P : 0 < bpow radix2 (-149)) by apply bpow_gt_0. pose proof (Rle_trans _ _ _ (Rmax_r _ _) H) as M.
  destruct (Rle_or_lt tau far) as [L|L].
  - apply Rle_trans with (RX far); [|apply RX_mono; lra]. now rewrite (RX_id far) by now apply of_single.
  - destruct (Rlt_bool_spec tau (bpow radix2 (-126))) as [S|S]; [|lra].
    destruct (single_units far Fr) as (m & E). assert (eta < bpow radix2 (-149)) by (apply bpow_lt; lia).
    assert (bpow radix2 (-149) < bpow radix2 (-126)) by (apply bpow_lt; lia).
    assert (B : (Z.abs m <= 2 ^ 23)%Z) by (apply (units_below far); [lia|exact E|apply Rabs_le; simpl Z.add; lra]).
    rewrite (few_units _ (m + 1)) by (rewrite ?plus_IZR, ?E; ring || lia). lra.
Qed.

Lemma singles_above r : F r -> RX tau <= r -> R32 tau <= r.
Proof.
  intros Fr H. destruct (back 53 ltac:(lia) tau) as (e & He & E). apply Rabs_le_inv in He.
  assert (U : 0 < unit 53 < bpow radix2 (-25)) by (split; [apply bpow_gt_0|apply bpow_lt; lia]).
  assert (U1 : bpow radix2 (-25) < 1) by (apply (bpow_lt radix2 (-25) 0); lia).
  assert (Pr : 0 <= r). { eapply Rle_trans; [|exact H]. apply (RN_pos 53); [lia|exact Ptau]. }
  assert (T : tau <= r * (1 + unit 53)). { rewrite E. apply Rmult_le_compat; try lra. apply (RN_pos 53); [lia|exact Ptau]. }
  destruct (Req_dec r 0) as [Zr|N].
  - rewrite Zr, Rmult_0_l in T. replace tau with 0 by lra. rewrite round_0 by typeclasses eauto. lra.
  - apply round_N_le_midp; [typeclasses eauto|exact Fr|]. rewrite succ_eq_pos by exact Pr.
    pose proof (ulp_FLT_gt radix2 (-149) 24 r) as G. rewrite (Rabs_pos_eq r) in G by exact Pr.
    replace (bpow radix2 (- (24))) with (2 * bpow radix2 (-25)) in G by (change (-(24))%Z with (1 + -25)%Z; rewrite bpow_plus; reflexivity).
    assert (r * unit 53 < r * bpow radix2 (-25)) by (apply Rmult_lt_compat_l; lra). lra.
Qed.

(** [Slabs64::end], rounded up to a float: it is at least RN(tau) of a hit whose rounded distance is at most the end in doubles. [BOX-8] *)
Theorem end_is_not_before b r : FX b -> RX t <= b -> F r ->
  RX (RX (RX (b * (bpow radix2 n * (1 + bpow radix2 (-52)))) - start) + bpow radix2 (-149)) <= r -> R32 tau <= r.
Proof.
  intros Fb B Fr H. apply singles_above; [exact Fr|]. eapply Rle_trans; [|exact H].
  pose proof (bpow_gt_0 radix2 (-149)) as P. assert (Pb : 0 <= b). { eapply Rle_trans; [|exact B]. now apply (RN_pos 53); [lia|]. }
  assert (T : t <= RX (b * (1 + bpow radix2 (-52)))).
  { destruct (Req_dec b 0) as [Zb|N].
    - rewrite Zb in B |- *. rewrite Rmult_0_l, round_0 by typeclasses eauto. destruct (back 53 ltac:(lia) t) as (e & He & ->).
      assert (0 <= RX t) by (now apply (RN_pos 53); [lia|]). replace (RX t) with 0 by lra. lra.
    - assert (S : Ulp.succ radix2 (FLX_exp 53) b <= b * (1 + bpow radix2 (-52))).
      { rewrite succ_eq_pos by exact Pb. pose proof (ulp_FLX_le radix2 53 b) as U. rewrite (Rabs_pos_eq b) in U by exact Pb. simpl Z.sub in U. lra. }
      apply Rle_trans with (Ulp.succ radix2 (FLX_exp 53) b).
      + apply Rnot_lt_le. intros L. apply Rlt_le in L. apply RX_mono in L. rewrite RX_id in L by (apply generic_format_succ; [typeclasses eauto|exact Fb]).
        pose proof (succ_gt_id radix2 (FLX_exp 53) b N). lra.
      + apply round_ge_generic; try typeclasses eauto; [apply generic_format_succ; [typeclasses eauto|exact Fb]|exact S]. }
  replace (b * (bpow radix2 n * (1 + bpow radix2 (-52)))) with (b * (1 + bpow radix2 (-52)) * bpow radix2 n) by ring. rewrite RX_scale.
  set (x := RX (b * (1 + bpow radix2 (-52))) * bpow radix2 n) in *.
  assert (X : tau <= x - start) by (unfold tau, x; apply Rplus_le_compat_r, Rmult_le_compat_r; [apply bpow_ge_0|exact T]).
  apply RX_mono in X. eapply Rle_trans; [exact X|]. rewrite <- (RX_id (RX (x - start))) at 1 by (apply generic_format_round; typeclasses eauto).
  apply RX_mono. lra.
Qed.
End Ends.

(** * From an entrance, in single precision *)

Notation pred := (Ulp.pred radix2 (FLT_exp (-149) 24)).
Notation succ := (Ulp.succ radix2 (FLT_exp (-149) 24)).

(** [FromEntrance::pair] of src/geom/slabs/entrance.rs: distances from the entrance are rounded, so the floats next to them are on either
    side, and so are the reported bounds, from an entrance that is known within bounds. [BOX-9] *)
Theorem entrance_near start t0 tau near : F near -> 0 <= tau -> near <= R32 tau -> start <= t0 -> R32 (start + pred near) <= R32 (t0 + tau).
Proof.
  intros Fn Pt H S. apply round_le; try typeclasses eauto. apply Rplus_le_compat; [exact S|]. apply Rnot_lt_le. intros L.
  assert (Fp : F (pred near)) by (apply generic_format_pred; [typeclasses eauto|exact Fn]).
  assert (B : R32 tau <= pred near) by (apply round_le_generic; try typeclasses eauto; [exact Fp|lra]).
  destruct (Req_dec near 0) as [Z|N]; [|pose proof (pred_lt_id radix2 (FLT_exp (-149) 24) near N); lra].
  pose proof (pred_le_id radix2 (FLT_exp (-149) 24) near). lra.
Qed.

(** [BOX-9] *)
Theorem entrance_far latest t0 tau far : F far -> R32 tau <= far -> t0 <= latest -> R32 (t0 + tau) <= R32 (latest + succ far).
Proof.
  intros Fr H S. apply round_le; try typeclasses eauto. apply Rplus_le_compat; [exact S|]. apply Rnot_lt_le. intros L.
  assert (Fp : F (succ far)) by (apply generic_format_succ; [typeclasses eauto|exact Fr]).
  assert (B : succ far <= R32 tau) by (apply round_ge_generic; try typeclasses eauto; [exact Fp|lra]).
  destruct (Req_dec far 0) as [Z|N]; [|pose proof (succ_gt_id radix2 (FLT_exp (-149) 24) far N); lra].
  rewrite Z, succ_0, (ulp_FLT_small radix2 (-149) 24) in B by (rewrite Rabs_R0; apply bpow_gt_0).
  pose proof (bpow_gt_0 radix2 (-149)). lra.
Qed.
