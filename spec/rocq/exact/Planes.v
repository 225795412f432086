(** The distance to one plane of a box, in real numbers with gradual underflow and without a greatest exponent: BOX-2 before
    overflow. Slabs.v makes the slab test of it. *)
Require Import Reals ZArith Lia Lra Psatz.
From Flocq Require Import Core.
Require Import StacklessExact.Rounding.
Open Scope R_scope.

Section Planes.
Variables emin prec : Z.
Context { prec_pos : Prec_gt_0 prec }.
Hypothesis prec_2 : (2 <= prec)%Z.

Notation fexp := (FLT_exp emin prec).
Notation F := (generic_format radix2 fexp).
Notation RN := (round radix2 fexp ZnearestE).
Notation pred := (Ulp.pred radix2 fexp).
Notation succ := (Ulp.succ radix2 fexp).
Notation ulp := (Ulp.ulp radix2 fexp).
Notation u := (unit prec).

Lemma u_small : 0 < u <= / 4.
Proof. split; [apply bpow_gt_0|]. change (/ 4) with (bpow radix2 (-2)). apply bpow_le. lia. Qed.

(** A reciprocal that is rounded and moved two floats down is below (1 - u) times the true one, powers of two and subnormal
    numbers included: the true one is above the middle of i and its predecessor. [BOX-2] *)
Theorem two_down y i : RN y = i -> 0 < i -> 0 < pred (pred i) -> pred (pred i) <= (1 - u) * y.
Proof.
  intros Hi H0 Hp. pose proof u_small as Hu.
  assert (Fi : F i) by (rewrite <- Hi; apply generic_format_round; typeclasses eauto).
  assert (Fp : F (pred i)) by (apply generic_format_pred; [typeclasses eauto|exact Fi]).
  assert (Fpp : F (pred (pred i))) by (apply generic_format_pred; [typeclasses eauto|exact Fp]).
  assert (Hlt : pred (pred i) <= pred i) by apply pred_le_id.
  assert (E1 : pred i + ulp (pred i) = i) by (apply pred_plus_ulp; [typeclasses eauto|exact H0|exact Fi]).
  assert (E2 : pred (pred i) + ulp (pred (pred i)) = pred i) by (apply pred_plus_ulp; [typeclasses eauto|lra|exact Fp]).
  assert (M : ulp (pred (pred i)) <= ulp (pred i)) by (apply ulp_le_pos; [typeclasses eauto|typeclasses eauto|lra|lra]).
  assert (G : u * pred (pred i) < ulp (pred (pred i))).
  { pose proof (ulp_FLT_gt radix2 emin prec (pred (pred i))) as G. rewrite Rabs_pos_eq in G by lra. lra. }
  assert (Y : (pred i + i) / 2 <= y).
  { destruct (Rle_or_lt ((pred i + i) / 2) y) as [|Hy]; [assumption|exfalso].
    assert (RN y <= pred i).
    { apply round_N_le_midp; [typeclasses eauto|exact Fp|]. rewrite succ_pred; [exact Hy|typeclasses eauto|exact Fi]. }
    assert (pred i < i) by (apply pred_lt_id; lra). lra. }
  set (pp := pred (pred i)) in *. set (p := pred i) in *. nra.
Qed.

(** Two floats up: above (1 + u) times the true one. [BOX-2] *)
Theorem two_up y i : RN y = i -> 0 < i -> (1 + u) * y <= succ (succ i).
Proof.
  intros Hi H0. pose proof u_small as Hu.
  assert (Fi : F i) by (rewrite <- Hi; apply generic_format_round; typeclasses eauto).
  assert (Fs : F (succ i)) by (apply generic_format_succ; [typeclasses eauto|exact Fi]).
  assert (E1 : succ i = i + ulp i) by (apply succ_eq_pos; lra).
  assert (P : 0 <= ulp i) by apply ulp_ge_0.
  assert (E2 : succ (succ i) = succ i + ulp (succ i)) by (apply succ_eq_pos; lra).
  assert (M : ulp i <= ulp (succ i)) by (apply ulp_le_pos; [typeclasses eauto|typeclasses eauto|lra|lra]).
  assert (G : u * i < ulp i).
  { pose proof (ulp_FLT_gt radix2 emin prec i) as G. rewrite Rabs_pos_eq in G by lra. lra. }
  assert (Y : y <= (i + succ i) / 2).
  { destruct (Rle_or_lt y ((i + succ i) / 2)) as [|Hy]; [assumption|exfalso].
    assert (succ i <= RN y).
    { apply round_N_ge_midp; [typeclasses eauto|exact Fs|]. rewrite pred_succ; [lra|typeclasses eauto|exact Fi]. }
    assert (i < succ i) by (apply succ_gt_id; lra). lra. }
  nra.
Qed.

(** The distance of a plane at b for the reciprocal inv: a difference, a product. *)
Definition distance (o b inv : R) : R := RN (RN (b - o) * inv).

(** What holds for d > 0 holds mirrored for d < 0. *)
Lemma mirrored o b inv : distance o b (- inv) = distance (- o) (- b) inv.
Proof.
  unfold distance. replace (- b - - o) with (- (b - o)) by ring. rewrite round_NE_opp. f_equal. ring.
Qed.

(** A plane at or behind the origin is not before it. *)
Lemma behind o b inv : b - o <= 0 -> 0 <= inv -> distance o b inv <= 0.
Proof.
  intros Hx Hi. unfold distance. rewrite <- (round_0 radix2 fexp ZnearestE). apply round_le; [typeclasses eauto|typeclasses eauto|].
  assert (RN (b - o) <= 0) by (rewrite <- (round_0 radix2 fexp ZnearestE); apply round_le; [typeclasses eauto..|exact Hx]).
  nra.
Qed.

(** [BOX-2], near plane: any reciprocal that is at most (1 - u) / d. The last rounding costs nothing, as it keeps the order. *)
Theorem near_is_not_after o d b t inv : F b -> F o -> 0 < d -> 0 <= t ->
  0 <= inv <= (1 - u) * (1 / d) -> b <= o + t * d -> distance o b inv <= RN t.
Proof.
  intros Hb Ho Hd Ht0 [Hi0 Hi] Ht. pose proof u_small as Hu.
  destruct (Rle_or_lt (b - o) 0) as [Hx|Hx'].
  { apply Rle_trans with 0; [now apply behind|]. rewrite <- (round_0 radix2 fexp ZnearestE). now apply round_le; try typeclasses eauto. }
  assert (Hx : 0 <= b - o) by lra. unfold distance.
  destruct (difference emin prec b o Hb Ho) as (e & He & ->).
  apply round_le; [typeclasses eauto|typeclasses eauto|].
  set (x := b - o) in *. set (y := 1 / d) in *.
  assert (Hy : 0 < y) by (unfold y; apply Rdiv_lt_0_compat; lra).
  assert (Htx : x * y <= t). { unfold y. apply Rmult_le_reg_r with d; [exact Hd|]. field_simplify; unfold x; lra. }
  apply Rabs_le_inv in He. pose proof (unit_ratio u ltac:(lra)) as R1.
  apply Rle_trans with (x * ((1 + u) * ((1 - u) * y))).
  - rewrite Rmult_assoc. apply Rmult_le_compat_l; [exact Hx|]. apply Rmult_le_compat; lra.
  - apply Rle_trans with (x * y); [|exact Htx]. apply Rmult_le_compat_l; [exact Hx|]. nra.
Qed.

(** [BOX-2], far plane: any reciprocal that is at least (1 + u) / d. *)
Theorem far_is_not_before o d b t inv : F b -> F o -> 0 < d -> 0 <= t ->
  (1 + u) * (1 / d) <= inv -> o + t * d <= b -> RN t <= distance o b inv.
Proof.
  intros Hb Ho Hd Ht0 Hi Ht. pose proof u_small as Hu. assert (Hx : 0 <= b - o) by nra. unfold distance.
  destruct (difference emin prec b o Hb Ho) as (e & He & ->).
  apply round_le; [typeclasses eauto|typeclasses eauto|].
  set (x := b - o) in *. set (y := 1 / d) in *.
  assert (Hy : 0 < y) by (unfold y; apply Rdiv_lt_0_compat; lra).
  assert (Htx : t <= x * y). { unfold y. apply Rmult_le_reg_r with d; [exact Hd|]. field_simplify; unfold x; lra. }
  apply Rle_trans with (1 := Htx). rewrite Rmult_assoc. apply Rmult_le_compat_l; [exact Hx|].
  apply Rabs_le_inv in He. destruct He as [He _].
  assert (H1 : / (1 + u) <= 1 + e).
  { replace (/ (1 + u)) with (1 - u / (1 + u)) by (field; lra). lra. }
  assert (H2 : 0 < / (1 + u)) by (apply Rinv_0_lt_compat; lra).
  apply Rle_trans with (/ (1 + u) * ((1 + u) * y)).
  - right. field. lra.
  - apply Rmult_le_compat; try lra. nra.
Qed.

(** Monotone in the plane, for a reciprocal that is not negative: what nesting rests on. [BOX-3] *)
Theorem nested o b b' inv : 0 <= inv -> b <= b' -> distance o b inv <= distance o b' inv.
Proof.
  intros Hi Hb. unfold distance. apply round_le; [typeclasses eauto|typeclasses eauto|]. apply Rmult_le_compat_r; [exact Hi|].
  apply round_le; [typeclasses eauto|typeclasses eauto|lra].
Qed.
End Planes.
