(** DET-1 for the tracer of wide trees: boxes and triangles tested by lanes. *)
Require Import Reals ZArith NArith List Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN.
Require Import StacklessExact.Triple StacklessExact.Filter StacklessExact.Floor StacklessExact.Lanes StacklessExact.Slabs.
Require Import StacklessExact.LaneBoxes StacklessExact.LaneRanks StacklessExact.Answer StacklessExact.AnswerTrees.
From Stackless Require Wide.
Import ListNotations.
Open Scope R_scope.

Section Lanes.
Variables ox oy oz dx dy dz : float.
Variables tmin tmax : float.
Notation o := (origin ox oy oz).
Notation d := (direction dx dy dz).
(** The bits of a lane's number. *)
Variable B : N.
Hypothesis B_range : (B <= 3)%N.
Variable mesh : N -> option triangle.
Variable kernel : N -> option float.
Hypothesis kernel_is_exact : is_exact o d tmin tmax mesh kernel.
Variable compare : N -> N -> comparison.
Hypothesis compare_is_exact : is_exact_order o d mesh kernel compare.

Definition axis_x (b : box) : axis := (ox, dx, lo_x b, hi_x b).
Definition axis_y (b : box) : axis := (oy, dy, lo_y b, hi_y b).
Definition axis_z (b : box) : axis := (oz, dz, lo_z b, hi_z b).
Definition lanes_fit (b : box) : Prop := proper (axis_x b) /\ proper (axis_y b) /\ proper (axis_z b).
Definition lanes_met (b : box) (best : float) : bool := lane_met (rank_of (Z.of_N B)) (axis_x b) (axis_y b) (axis_z b) tmin best.

Lemma touched_lane_is_met b best t : lanes_fit b -> in_box (along o d t) b -> within t tmin tmax -> is_nan best = false ->
  nearest t <= value best -> lanes_met b best = true.
Proof.
  intros (Px & Py & Pz) (X & Y & Z) (Fm & Hm & _) Nb Hb. apply touched_is_entered with t; try assumption. lia.
Qed.

(** Any search of a wide tree that leaves out only what the lanes do not meet ends with the first hit. [DET-1, LANES-1] *)
Theorem lanes_answer boxes items T S : covers mesh lanes_fit (wide_of B boxes items T []) ->
  wide_by_boxes tmax kernel compare lanes_met B boxes items T S ->
  is_least o d tmin tmax mesh kernel (wide_best kernel compare items T (snd (Wide.reference B S T))).
Proof.
  intros C By. apply (one_answer o d tmin tmax mesh kernel kernel_is_exact compare compare_is_exact lanes_met lanes_fit touched_lane_is_met _ _ C).
  now apply wide_reference_runs.
Qed.

(** A triangle that a filter rejects would not be accepted: so a search that does not test it is one of DET-1. An infinite end rejects
    nothing by its distance. [DET-1, LANES-3, LANES-4] *)
Theorem rejected_is_not_accepted i v0 v1 v2 reach neg (best : answer) : mesh i = Some (v0, v1, v2) ->
  vformat v0 -> vformat v1 -> vformat v2 -> vformat o -> bounded reach v0 -> bpow radix2 (-20) <= greatest d <= bpow radix2 20 ->
  let found := determinants_of (round radix2 (FLT_exp (-149) 24) ZnearestE) v0 v1 v2 o d in
  let C := way o reach in
  let E := longest v0 v1 v2 in
  sign_bit neg (det found) ->
  is_missed (greatest d) C E found \/ (is_finite (limit tmax best) = true /\ is_beyond neg (greatest d) C E (B2R (limit tmax best)) found) ->
  is_nan (limit tmax best) = false -> accept kernel compare i best = best.
Proof.
  intros Em F0 F1 F2 Fo HR HD found C E Sg Rj Nl. unfold accept. pose proof (kernel_is_exact i) as K. destruct (kernel i) as [f|]; [|reflexivity].
  destruct K as (t & (v & Ev & M & Et & W) & Nf & Ef). rewrite Em in Ev. injection Ev as <-. cbn [truth] in M, Et.
  assert (Ht : 0 <= t) by (destruct W as (_ & W & _); lra).
  assert (Right : forall b, is_missed (greatest d) C E found \/ is_beyond neg (greatest d) C E b found -> ~ round radix2 (FLT_exp (-149) 24) ZnearestE t <= b).
  { intros b Rb H. apply (rejected_is_right v0 v1 v2 o d reach neg b F0 F1 F2 Fo HR HD Sg Rb). rewrite <- Et. auto. }
  destruct Rj as [Rj|[Fl Rj]]; [exfalso; exact (Right _ (or_introl Rj) (Rle_refl (round radix2 (FLT_exp (-149) 24) ZnearestE t)))|].
  assert (Beyond : value (limit tmax best) < value f).
  { rewrite Ef. rewrite (finite_value 24 128 _ Fl). apply Rnot_le_lt. intros H. apply (Right _ (or_intror Rj)). revert H. unfold Slabs.nearest, Rmin.
    pose proof (finite_inside 24 128 (limit tmax best)). destruct (Rle_dec _ _) as [L|L]; intros H'; [exact H'|lra]. }
  destruct best as [b|].
  - destruct (is_less compare (f, i) b) eqn:L; [|reflexivity]. exfalso.
    assert (Bl : Bltb f (fst b) = false /\ Beqb f (fst b) = false).
    { destruct b as [g j]. cbn [fst limit] in *. pose proof (Bltb_value 24 128 f g Nf Nl) as E1. pose proof (Beqb_value f g Nf Nl) as E2.
      split; [rewrite E1; apply Rlt_bool_false; lra|]. destruct (Beqb f g); [|reflexivity]. destruct E2 as [E2 _]. specialize (E2 eq_refl). lra. }
    unfold is_less in L. cbn [fst] in L. destruct Bl as [B1 B2]. rewrite B1, B2 in L. discriminate.
  - exfalso. cbn [limit] in *. pose proof (within_ends 24 128 eq_refl t tmin tmax W) as (_ & _ & (_ & Hm)). rewrite Ef in Beyond. lra.
Qed.
End Lanes.
