(** The filter of four triangles, one lane, from the floats of the code to what it says: LANES-3 and LANES-4 on IEEE numbers. *)
Require Import Reals ZArith Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN.
Require Import StacklessExact.Rounding StacklessExact.Triple StacklessExact.Filter StacklessExact.Floor StacklessExact.Lanes StacklessExact.Slabs.
Require Import StacklessExact.LaneNumbers.
Open Scope R_scope.

Local Instance prec_24 : Prec_gt_0 24 := eq_refl.

Lemma rounded_format (v : fvec) : vformat (real v).
Proof. split; [|split]; exact (B2R_format 24 128 _). Qed.

(** The filters as they are, on IEEE numbers, for a usual ray and any end that is not negative, infinity too: what they reject has no hit
    with RN(t) <= end. D, C' and E' are floats of the values that LANES-3 names. [LANES-3, LANES-4] *)
Theorem survivors_are_right v0 v1 v2 o d reach (D C E best : float) :
  vfits 40 v0 (real v0) -> vfits 40 v1 (real v1) -> vfits 40 v2 (real v2) -> vfits 40 o (real o) -> vfits 20 d (real d) ->
  bounded reach (real v0) -> reach <= bpow radix2 40 ->
  is_finite D = true -> B2R D = greatest (real d) -> bpow radix2 (-20) <= B2R D ->
  is_finite C = true -> B2R C = way (real o) reach -> is_finite E = true -> B2R E = longest (real v0) (real v1) (real v2) ->
  is_nan best = false -> 0 <= value best ->
  f_missed D C E (code_of v0 v1 v2 o d) = true \/ f_beyond D C E best (code_of v0 v1 v2 o d) = true ->
  let truth := determinants_of exactly (real v0) (real v1) (real v2) (real o) (real d) in
  ~ (meets truth /\ 0 <= top_t truth / det truth /\ Slabs.nearest 24 128 (top_t truth / det truth) <= value best).
Proof.
  intros H0 H1 H2 Ho Hd HR R40 FD ED D20 FC EC FE EE Nb Pb Rj truth (M & Ht & Hb). set (found := determinants_of R32 (real v0) (real v1) (real v2) (real o) (real d)).
  assert (Most : forall e v, vfits e v (real v) -> greatest (real v) <= bpow radix2 e).
  { intros e v ((_ & _ & X) & (_ & _ & Y) & (_ & _ & Z)). unfold greatest. repeat apply Rmax_lub; assumption. }
  assert (Most' : forall e v r, vfits e v r -> greatest r <= bpow radix2 e).
  { intros e v r ((_ & _ & X) & (_ & _ & Y) & (_ & _ & Z)). unfold greatest. repeat apply Rmax_lub; assumption. }
  assert (P : forall v, 0 <= greatest v) by (intros v; unfold greatest; eapply Rle_trans; [apply (Rabs_pos (vz v))|apply Rmax_r]).
  assert (Ll : 0 < least <= bpow radix2 41) by (split; [apply bpow_gt_0|now apply bpow_le]).
  assert (HD : fits 20 D (B2R D)) by (split; [exact FD|split; [reflexivity|]]; rewrite ED, Rabs_pos_eq by apply P; now apply Most).
  assert (HC : fits 41 C (B2R C)).
  { split; [exact FC|split; [reflexivity|]]. rewrite EC. unfold way. rewrite Rabs_pos_eq by (eapply Rle_trans; [|apply Rmax_r]; lra).
    apply Rmax_lub; [|lra]. assert (0 <= reach) by (destruct HR as (B & _); pose proof (Rabs_pos (vx (real v0))); lra). pose proof (P (real o)). pose proof (Most 40%Z o Ho).
    eapply Rle_trans; [apply Rle_abs|]. apply R32_b; [lia|]. change 41%Z with (40 + 1)%Z. rewrite <- twice_pow, Rabs_pos_eq; lra. }
  assert (HE : fits 41 E (B2R E)).
  { split; [exact FE|split; [reflexivity|]]. rewrite EE. unfold longest. rewrite Rabs_pos_eq by (eapply Rle_trans; [|apply Rmax_r]; lra).
    apply Rmax_lub; [|lra]. apply Rmax_lub; [exact (Most' 41%Z _ _ (sub_fits 40 _ _ _ _ ltac:(lia) H1 H0))|exact (Most' 41%Z _ _ (sub_fits 40 _ _ _ _ ltac:(lia) H2 H0))]. }
  destruct (lanes_do_not_overflow v0 v1 v2 o d H0 H1 H2 Ho Hd) as ((_ & Ed & _) & _).
  assert (Sg : sign_bit (Bsign (f_det (code_of v0 v1 v2 o d))) (det found)).
  { pose proof (sign_of_R 24 128 2 (or_introl eq_refl) (f_det (code_of v0 v1 v2 o d))) as S. rewrite Ed in S. exact S. }
  assert (Dr : bpow radix2 (-20) <= greatest (real d) <= bpow radix2 20) by (rewrite <- ED; split; [exact D20|]; apply Rle_trans with (2 := proj2 (proj2 HD)), Rle_abs).
  pose proof (rejected_is_right (real v0) (real v1) (real v2) (real o) (real d) reach (Bsign (f_det (code_of v0 v1 v2 o d)))) as Right. cbv zeta in Right.
  assert (Cases : is_missed (B2R D) (B2R C) (B2R E) found \/
    (is_finite best = true /\ is_beyond (Bsign (f_det (code_of v0 v1 v2 o d))) (B2R D) (B2R C) (B2R E) (B2R best) found)).
  { destruct Rj as [Rj|Rj]; [left; exact (missed_agrees v0 v1 v2 o d H0 H1 H2 Ho Hd D C E HD HC HE Rj)|right].
    refine (beyond_agrees v0 v1 v2 o d H0 H1 H2 Ho Hd D C E HD HC HE best Nb Pb _ Rj).
    destruct (longest_bounds (real v0) (real v1) (real v2)) as (B1 & B2 & LE). rewrite EE.
    pose proof (bound_low (real v0) (real v1) (real v2) _ (conj B1 B2) LE 40 (B2R D) ltac:(lra)) as L. fold (det_off_of (B2R D) (longest (real v0) (real v1) (real v2))) in L.
    assert (D40 : bpow radix2 (-40) <= B2R D) by (eapply Rle_trans; [|exact D20]; now apply bpow_le). specialize (L D40).
    destruct (sizes (B2R D) least (longest (real v0) (real v1) (real v2))) as (Z1 & _); [rewrite ED; exact Dr|apply Rle_refl|exact LE|].
    pose proof (bpow_gt_0 radix2 (-150)) as Pe. pose proof (Rabs_pos (det found)).
    apply Rlt_le_trans with (R32 (bpow radix2 (-149))); [rewrite round_generic; [apply bpow_gt_0|typeclasses eauto|apply generic_format_bpow; unfold FLT_exp; lia]|].
    apply round_le; [typeclasses eauto..|]. change (bpow radix2 (-149)) with (bpow radix2 (1 + -150)). rewrite bpow_plus. change (bpow radix2 1) with 2. fold found. lra. }
  rewrite ED, EC, EE in Cases.
  destruct Cases as [Cm|[Fb Cb]].
  - exact (Right _ (rounded_format v0) (rounded_format v1) (rounded_format v2) (rounded_format o) HR Dr Sg (or_introl Cm) (conj M (conj Ht (Rle_refl _)))).
  - refine (Right (B2R best) (rounded_format v0) (rounded_format v1) (rounded_format v2) (rounded_format o) HR Dr Sg (or_intror Cb) (conj M (conj Ht _))).
    rewrite (finite_value 24 128 best Fb) in Hb. pose proof (finite_inside 24 128 best) as In. apply Rnot_lt_le. intros L. apply (Rle_not_lt _ _ Hb).
    unfold Slabs.nearest. apply Rmin_glb_lt; [exact L|apply In].
Qed.
