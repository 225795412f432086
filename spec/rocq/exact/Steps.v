(** How many floats a reciprocal has to be moved, for BOX-4: one is too few, with a box of which the slab test is wrong; two leave a
    near distance that may be above the exact one; three do not. *)
Require Import Reals ZArith Lia Lra Psatz List.
From Flocq Require Import Core Relative BinarySingleNaN.
Require Import StacklessExact.Rounding StacklessExact.Planes.
Require StacklessExact.Slabs.
Open Scope R_scope.

(** * Two and three steps *)

Section Steps.
Variables emin prec : Z.
Context { prec_pos : Prec_gt_0 prec }.
Hypothesis prec_3 : (3 <= prec)%Z.

Notation fexp := (FLT_exp emin prec).
Notation F := (generic_format radix2 fexp).
Notation RN := (round radix2 fexp ZnearestE).
Notation pred := (Ulp.pred radix2 fexp).
Notation succ := (Ulp.succ radix2 fexp).
Notation ulp := (Ulp.ulp radix2 fexp).
Notation u := (unit prec).
Notation distance := (distance emin prec).

Lemma u_8 : 0 < u <= / 8.
Proof. split; [apply bpow_gt_0|]. change (/ 8) with (bpow radix2 (-3)). apply bpow_le. lia. Qed.

(** One step down, and how long it is at least. *)
Lemma step_down p : F p -> 0 < p -> 0 < pred p -> F (pred p) /\ pred p + ulp (pred p) = p /\ u * pred p < ulp (pred p).
Proof.
  intros Fp P0 P1. split; [apply generic_format_pred; [typeclasses eauto|exact Fp]|]. split.
  - apply pred_plus_ulp; [typeclasses eauto|exact P0|exact Fp].
  - pose proof (ulp_FLT_gt radix2 emin prec (pred p)) as G. rewrite Rabs_pos_eq in G by lra. lra.
Qed.

Lemma shorter p : 0 < pred p -> ulp (pred p) <= ulp p.
Proof. intros P. pose proof (pred_le_id radix2 fexp p). apply ulp_le_pos; try typeclasses eauto; lra. Qed.

(** The true reciprocal is above the middle of i and the float below it. *)
Lemma middle_below y i : RN y = i -> 0 < i -> pred i + ulp (pred i) = i -> (pred i + i) / 2 <= y.
Proof.
  intros Hi H0 E. assert (Fi : F i) by (rewrite <- Hi; apply generic_format_round; typeclasses eauto).
  destruct (Rle_or_lt ((pred i + i) / 2) y) as [|Hy]; [assumption|exfalso].
  assert (RN y <= pred i).
  { apply round_N_le_midp; [typeclasses eauto|apply generic_format_pred; [typeclasses eauto|exact Fi]|].
    rewrite succ_pred; [exact Hy|typeclasses eauto|exact Fi]. }
  assert (pred i < i) by (apply pred_lt_id; lra). lra.
Qed.

Lemma two_down_by y i : RN y = i -> 0 < i -> 0 < pred (pred i) -> pred (pred i) * (1 + 3 / 2 * u) <= y.
Proof.
  intros Hi H0 H2. assert (Fi : F i) by (rewrite <- Hi; apply generic_format_round; typeclasses eauto).
  pose proof (pred_le_id radix2 fexp (pred i)). destruct (step_down i Fi H0 ltac:(lra)) as (F1 & E1 & _).
  destruct (step_down (pred i) F1 ltac:(lra) H2) as (_ & E2 & G). pose proof (shorter (pred i) H2).
  pose proof (middle_below y i Hi H0 E1). lra.
Qed.

Lemma three_down_by y i : RN y = i -> 0 < i -> 0 < pred (pred (pred i)) -> pred (pred (pred i)) * (1 + 5 / 2 * u) <= y.
Proof.
  intros Hi H0 H3. assert (Fi : F i) by (rewrite <- Hi; apply generic_format_round; typeclasses eauto).
  pose proof (pred_le_id radix2 fexp (pred i)). pose proof (pred_le_id radix2 fexp (pred (pred i))).
  destruct (step_down i Fi H0 ltac:(lra)) as (F1 & E1 & _). destruct (step_down (pred i) F1 ltac:(lra) ltac:(lra)) as (F2 & E2 & _).
  destruct (step_down (pred (pred i)) F2 ltac:(lra) H3) as (_ & E3 & G). pose proof (shorter (pred i) ltac:(lra)).
  pose proof (shorter (pred (pred i)) H3). pose proof (middle_below y i Hi H0 E1). lra.
Qed.

Lemma three_up_by y i : RN y = i -> 0 < i -> (1 + u) * (1 + u) * y <= succ (succ (succ i)).
Proof.
  intros Hi H0. pose proof u_8 as Hu. assert (Fi : F i) by (rewrite <- Hi; apply generic_format_round; typeclasses eauto).
  assert (E1 : succ i = i + ulp i) by (apply succ_eq_pos; lra). assert (P : 0 <= ulp i) by apply ulp_ge_0.
  assert (E2 : succ (succ i) = succ i + ulp (succ i)) by (apply succ_eq_pos; lra).
  assert (P2 : ulp i <= ulp (succ i)) by (apply ulp_le_pos; try typeclasses eauto; lra).
  assert (E3 : succ (succ (succ i)) = succ (succ i) + ulp (succ (succ i))) by (apply succ_eq_pos; lra).
  assert (P3 : ulp (succ i) <= ulp (succ (succ i))) by (apply ulp_le_pos; try typeclasses eauto; lra).
  assert (G : u * i < ulp i). { pose proof (ulp_FLT_gt radix2 emin prec i) as G. rewrite Rabs_pos_eq in G by lra. lra. }
  assert (Y : y <= i + ulp i / 2).
  { destruct (Rle_or_lt y ((i + succ i) / 2)) as [|Hy]; [lra|exfalso].
    assert (succ i <= RN y).
    { apply round_N_ge_midp; [typeclasses eauto|apply generic_format_succ; [typeclasses eauto|exact Fi]|].
      rewrite pred_succ; [lra|typeclasses eauto|exact Fi]. }
    assert (i < succ i) by (apply succ_gt_id; lra). lra. }
  set (g := ulp i) in *. apply Rle_trans with (i + 3 * g); [|lra]. clearbody g.
  apply Rle_trans with ((1 + u) * (1 + u) * (i + g / 2)); [apply Rmult_le_compat_l; [nra|exact Y]|].
  assert (U1 : u * (u * i) <= / 8 * g) by (apply Rmult_le_compat; try lra; apply Rmult_le_pos; lra).
  assert (U2 : u * g <= / 8 * g) by (apply Rmult_le_compat_r; lra).
  assert (U3 : u * (u * g) <= / 8 * g) by (apply Rmult_le_compat; try lra; apply Rmult_le_pos; lra).
  replace ((1 + u) * (1 + u) * (i + g / 2)) with (i + g / 2 + 2 * (u * i) + u * g + u * (u * i) + u * (u * g) / 2) by field. lra.
Qed.

(** A product that does not underflow. *)
Definition normal (x : R) : Prop := x = 0 \/ bpow radix2 (emin + prec - 1) <= Rabs x.

Lemma rounded_normal x : normal x -> exists e, Rabs e <= u / (1 + u) /\ RN x = x * (1 + e).
Proof.
  intros [-> |H].
  - exists 0. rewrite Rabs_R0, round_0 by typeclasses eauto. pose proof u_8. split; [|ring]. apply Rmult_le_pos; [lra|].
    apply Rlt_le, Rinv_0_lt_compat. lra.
  - destruct (relative_error_N_FLX'_ex radix2 prec prec_pos (fun z => negb (Z.even z)) x) as (e & He & E).
    exists e. split; [|rewrite (round_FLT_FLX radix2 emin) by exact H; exact E]. unfold u_ro in He. now rewrite unit_half in He.
Qed.

Lemma ratio_bounds : 0 < u / (1 + u) /\ (1 - u / (1 + u)) * (1 + u) = 1 /\ (1 + u / (1 + u)) * (1 + u) = 1 + 2 * u.
Proof. pose proof u_8. split; [apply Rdiv_lt_0_compat; lra|]. split; field; lra. Qed.

(** The near plane with a reciprocal that is k u below the true one. *)
Lemma near_by o d b t inv k m : F b -> F o -> 0 < d -> 0 <= t -> 0 <= inv -> inv * (1 + k * u) <= 1 / d -> 1 <= m -> 0 <= k ->
  (1 + 2 * u) * (1 + 2 * u) <= (1 + k * u) * m * ((1 + u) * (1 + u)) ->
  normal (RN (b - o) * inv) -> b <= o + t * d -> distance o b inv <= m * t.
Proof.
  intros Hb Ho Hd Ht0 Hi0 Hi Hm Hk K N Ht. pose proof u_8 as Hu. destruct ratio_bounds as (R0 & _ & R2). set (v := u / (1 + u)) in *.
  destruct (Rle_or_lt (b - o) 0) as [Hx|Hx].
  { apply Rle_trans with 0; [now apply behind|]. apply Rmult_le_pos; lra. }
  unfold distance. destruct (rounded_normal _ N) as (e2 & H2 & ->). destruct (difference emin prec b o Hb Ho) as (e1 & H1 & ->).
  fold v in H1, H2. apply Rabs_le_inv in H1. apply Rabs_le_inv in H2. set (x := b - o) in *. set (y := 1 / d) in *.
  assert (Htx : x * y <= t). { unfold y. apply Rmult_le_reg_r with d; [exact Hd|]. field_simplify; unfold x; lra. }
  assert (V : v <= / 8) by (pose proof (unit_ratio u ltac:(lra)); unfold v; lra).
  apply Rle_trans with (x * inv * ((1 + v) * (1 + v))).
  - replace (x * (1 + e1) * inv * (1 + e2)) with (x * inv * ((1 + e1) * (1 + e2))) by ring.
    apply Rmult_le_compat_l; [apply Rmult_le_pos; lra|]. apply Rmult_le_compat; lra.
  - assert (S : (1 + v) * (1 + v) <= (1 + k * u) * m).
    { apply Rmult_le_reg_r with ((1 + u) * (1 + u)); [nra|].
      replace ((1 + v) * (1 + v) * ((1 + u) * (1 + u))) with ((1 + v) * (1 + u) * ((1 + v) * (1 + u))) by ring. rewrite R2. exact K. }
    apply Rle_trans with (x * inv * ((1 + k * u) * m)).
    + apply Rmult_le_compat_l; [apply Rmult_le_pos; lra|exact S].
    + replace (x * inv * ((1 + k * u) * m)) with (m * (x * (inv * (1 + k * u)))) by ring. apply Rmult_le_compat_l; [lra|].
      eapply Rle_trans; [|exact Htx]. apply Rmult_le_compat_l; lra.
Qed.

(** With two steps a near distance is above the exact one by at most u/2 of it, where nothing underflows. [BOX-4] *)
Theorem two_steps_near o d b t i : F b -> F o -> 0 < d -> 0 <= t -> RN (1 / d) = i -> 0 < i -> 0 < pred (pred i) ->
  normal (RN (b - o) * pred (pred i)) -> b <= o + t * d -> distance o b (pred (pred i)) <= (1 + u / 2) * t.
Proof.
  intros Hb Ho Hd Ht Hi Pi P2 N T. pose proof u_8. apply near_by with d (3 / 2); try assumption; try lra.
  - now apply two_down_by.
  - nra.
Qed.

(** With three steps it is at most the exact one, and a far distance at least. [BOX-4] *)
Theorem three_steps_near o d b t i : F b -> F o -> 0 < d -> 0 <= t -> RN (1 / d) = i -> 0 < i -> 0 < pred (pred (pred i)) ->
  normal (RN (b - o) * pred (pred (pred i))) -> b <= o + t * d -> distance o b (pred (pred (pred i))) <= t.
Proof.
  intros Hb Ho Hd Ht Hi Pi P3 N T. pose proof u_8. rewrite <- (Rmult_1_l t). apply near_by with d (5 / 2); try assumption; try lra.
  - now apply three_down_by.
  - nra.
Qed.

(** [BOX-4] *)
Theorem three_steps_far o d b t i : F b -> F o -> 0 < d -> 0 <= t -> RN (1 / d) = i -> 0 < i ->
  normal (RN (b - o) * succ (succ (succ i))) -> o + t * d <= b -> t <= distance o b (succ (succ (succ i))).
Proof.
  intros Hb Ho Hd Ht0 Hi Pi N Ht. pose proof u_8 as Hu. destruct ratio_bounds as (R0 & R1 & _). set (v := u / (1 + u)) in *.
  pose proof (three_up_by _ _ Hi Pi) as S. set (inv := succ (succ (succ i))) in *. unfold distance.
  destruct (rounded_normal _ N) as (e2 & H2 & ->). destruct (difference emin prec b o Hb Ho) as (e1 & H1 & ->).
  fold v in H1, H2. apply Rabs_le_inv in H1. apply Rabs_le_inv in H2. assert (Hx : 0 <= b - o) by nra. set (x := b - o) in *. set (y := 1 / d) in *.
  assert (Htx : t <= x * y). { unfold y. apply Rmult_le_reg_r with d; [exact Hd|]. field_simplify; unfold x; lra. }
  assert (Py : 0 < y) by (unfold y; apply Rdiv_lt_0_compat; lra).
  assert (V : v <= / 8) by (pose proof (unit_ratio u ltac:(lra)); unfold v; lra).
  eapply Rle_trans; [exact Htx|]. replace (x * (1 + e1) * inv * (1 + e2)) with (x * (inv * ((1 + e1) * (1 + e2)))) by ring.
  apply Rmult_le_compat_l; [exact Hx|].
  apply Rle_trans with ((1 + u) * (1 + u) * y * ((1 - v) * (1 - v))).
  - right. transitivity ((1 - v) * (1 + u) * ((1 - v) * (1 + u)) * y); [rewrite R1; ring|ring].
  - apply Rmult_le_compat; try (apply Rmult_le_pos; nra); [exact S|apply Rmult_le_compat; lra].
Qed.
End Steps.

(** * One step *)

(** Single precision. *)
Notation float := (binary_float 24 128).
Definition number (s : bool) m e (H : SpecFloat.bounded 24 128 m e = true) : float := B754_finite s m e H.

(** The box of tests/library/bounds/slab.rs that the ray touches in one edge: between 1.99521927107 and 1.99521927115. *)
Definition axis_x : Slabs.axis 24 128 := (number true 8428564 (-23) eq_refl, number false 8411031 (-24) eq_refl,
  number true 9635438 (-31) eq_refl, number false 8388608 (-23) eq_refl).
Definition axis_y : Slabs.axis 24 128 := (number true 9230274 (-23) eq_refl, number false 9246524 (-24) eq_refl,
  number true 8388608 (-23) eq_refl, number true 11986047 (-34) eq_refl).
Definition axis_z : Slabs.axis 24 128 := (B754_zero false, B754_zero false, number true 8388608 (-23) eq_refl, number false 8388608 (-23) eq_refl).

Definition usual := Slabs.usual 24 128 eq_refl eq_refl.
Definition touches := Slabs.touches 24 128.
Definition minus := Slabs.minus 24 128 eq_refl eq_refl.
Definition times := Slabs.times 24 128 eq_refl eq_refl.
Definition hits steps axes : bool :=
  let '(near, far) := Slabs.near_and_far 24 128 eq_refl eq_refl steps axes (B754_zero false) (B754_infinity false) in Bleb near far.

(** Moved by one step, the test skips a box that is touched; by two, it does not. [BOX-4] *)
Theorem one_step_is_too_little : let box := axis_x :: axis_y :: axis_z :: nil in
  Forall usual box /\ (exists t, 0 <= t /\ Forall (touches t) box) /\ hits 1 box = false /\ hits 2 box = true.
Proof.
  intros box. split; [|split; [|split; vm_compute; reflexivity]].
  - assert (Small : forall s m e H, (Z.abs (Zpos m) < 2 ^ 24)%Z -> (e <= 0)%Z -> Rabs (B2R (number s m e H)) <= bpow radix2 (128 - 2)).
    { intros s m e H Hm He. unfold number, B2R. rewrite <- F2R_Zabs, abs_cond_Zopp. unfold F2R. simpl Fnum. simpl Fexp.
      apply Rle_trans with (bpow radix2 24 * bpow radix2 e); [|rewrite <- bpow_plus; apply bpow_le; lia].
      apply Rmult_le_compat_r; [apply bpow_ge_0|]. rewrite <- (IZR_Zpower radix2) by lia. apply IZR_le, Z.lt_le_incl, Hm. }
    assert (Zero : Rabs (B2R (B754_zero false : float)) <= bpow radix2 (128 - 2)) by (simpl; rewrite Rabs_R0; apply (bpow_ge_0 radix2 126)).
    repeat (apply Forall_cons || apply Forall_nil); unfold usual, Slabs.usual, axis_x, axis_y, axis_z;
      (split; [reflexivity|split; [(left; reflexivity) || (right; vm_compute; reflexivity)|]]);
      repeat (split; [split; [reflexivity|]|] || split); try reflexivity; first [exact Zero | apply Small; reflexivity || discriminate].
  - exists (199521927111 / 100000000000). split; [lra|].
    repeat (apply Forall_cons || apply Forall_nil); unfold touches, Slabs.touches, axis_x, axis_y, axis_z, number, B2R, F2R; simpl; lra.
Qed.

(** Moved by two, a near distance may be above the exact one. [BOX-4] *)
Theorem two_steps_may_be_above : exists o d b : float, is_finite o = true /\ is_finite d = true /\ is_finite b = true /\ 0 < B2R d /\
  (B2R b - B2R o) / B2R d < B2R (times (minus b o) (fst (Slabs.reciprocals 24 128 eq_refl eq_refl 2 d))).
Proof.
  exists (number true 8399928 (-23) eq_refl), (number false 8391132 (-23) eq_refl), (number false 9417103 (-23) eq_refl).
  repeat (split; [reflexivity|]). split; [unfold number, B2R, F2R; simpl; lra|].
  set (near := times _ _). rewrite <- (SF2R_B2SF 24 128 near). unfold near. match goal with |- _ < SF2R _ ?x =>
    let y := eval vm_compute in x in replace x with y by (vm_compute; reflexivity) end.
  unfold number, B2R, SF2R, F2R. simpl. lra.
Qed.
