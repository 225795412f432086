(** [Frame::part] of src/geom/clip.rs (SPLIT-1) as it is computed, in double precision with gradual underflow and without a greatest
    exponent: the corners that six cuts leave, moved outwards by the margin, are around all of the triangle that is inside. *)
Require Import Reals ZArith List Lia Lra Psatz Bool.
From Flocq Require Import Core.
Require Import StacklessExact.Rounding StacklessExact.Filter StacklessExact.Range StacklessExact.NearDistance StacklessExact.NearGuess
  StacklessExact.PolygonOrder StacklessExact.Parts.
Import ListNotations.
Open Scope R_scope.

Local Instance prec_53 : Prec_gt_0 53 := eq_refl.

(** * The code *)

Inductive axis : Type := X | Y | Z.
Definition pick (a : axis) (x : vec) : R := match a with X => vx x | Y => vy x | Z => vz x end.

(** A corner as it is computed, with the point of the triangle that it stands for, which the code does not know. *)
Record corner : Type := Corner { at_ : place; found : vec }.

(** What a cut is by: an axis, on which lo is cut, as [sign] is -1, or hi; and the plane. *)
Record plane : Type := Plane { on : axis; is_lo : bool; place_on : R }.
Definition signed (p : plane) (x : R) : R := if is_lo p then - x else x.

(** MARGIN times a size. *)
Definition margin (size : R) : R := R64 (128 * u * size).
Definition bound (size : axis -> R) (p : plane) : R := R64 (signed p (place_on p) + margin (size (on p))).

Definition height (p : plane) (c : corner) : R := signed p (pick (on p) (found c)).
Definition stays (size : axis -> R) (p : plane) (c : corner) : bool := Rle_bool (height p c) (bound size p).
Definition share (size : axis -> R) (p : plane) (kept dropped : corner) : R :=
  R64 (R64 (bound size p - height p kept) / R64 (height p dropped - height p kept)).
Definition crossing (size : axis -> R) (p : plane) (kept dropped : corner) : corner :=
  let t := share size p kept dropped in
  Corner (Place (pv (at_ kept) + t * (pv (at_ dropped) - pv (at_ kept))) (pw (at_ kept) + t * (pw (at_ dropped) - pw (at_ kept))))
    (vadd (found kept) (scaled (vsub R64 (found dropped) (found kept)) t)).

Definition cut_by (size : axis -> R) (l : list corner) (p : plane) : list corner := cut corner (stays size p) (crossing size p) l.
(** One after the other. *)
Definition left (size : axis -> R) (a b c : vec) (planes : list plane) : list corner :=
  fold_left (cut_by size) planes [Corner (Place 0 0) a; Corner (Place 1 0) b; Corner (Place 0 1) c].

(** * One coordinate *)

Section Coordinate.
Variable size : R.
Hypothesis usual : size = 0 \/ bpow radix2 (-900) <= size.

Let positive : 0 <= size.
Proof. destruct usual as [-> |H]; [lra|]. pose proof (bpow_gt_0 radix2 (-900)). lra. Qed.

Lemma eta_less : 0 < size -> eta <= u * u * size.
Proof.
  intros P. destruct usual as [-> |H]; [lra|]. apply Rle_trans with (u * u * bpow radix2 (-900)); [rewrite <- !bpow_plus; apply eta_is; lia|].
  apply Rmult_le_compat_l; [apply Rmult_le_pos; apply bpow_ge_0|exact H].
Qed.

(** A corner is off by so much; e is at most 97u times the size. *)
Variable e : R.
Hypothesis small : 0 <= e <= 97 * u * size.
Definition off_by (x f : R) : Prop := Rabs x <= size * (1 + u) /\ Rabs (x - f) <= e /\ F f.

Lemma found_most x f : off_by x f -> Rabs f <= size * (1 + 98 * u).
Proof.
  intros (B & O & _). pose proof (from_off f x) as T. rewrite Rabs_minus_sym in T. lra.
Qed.

(** A new corner is off by 16u M more. *)
Lemma crossing_off x y k d t : off_by x k -> off_by y d -> 0 <= t <= 1 ->
  Rabs (x + t * (y - x) - R64 (k + R64 (R64 (d - k) * t))) <= e + 16 * u * size.
Proof.
  intros K D T. pose proof (found_most _ _ K) as BK. pose proof (found_most _ _ D) as BD. destruct K as (_ & OK & FK), D as (_ & OD & FD).
  assert (Comb : Rabs ((1 - t) * (x - k) + t * (y - d)) <= e).
  { replace e with ((1 - t) * e + t * e) by ring. apply add_b; rewrite Rabs_mult, (Rabs_pos_eq _) by lra; apply Rmult_le_compat_l; lra. }
  destruct positive as [P|Zero].
  2:{ rewrite <- Zero in *. assert (e = 0) by lra. assert (K0 : k = 0) by (apply Rabs_eq_R0; pose proof (Rabs_pos k); lra).
      assert (D0 : d = 0) by (apply Rabs_eq_R0; pose proof (Rabs_pos d); lra). subst k d.
      rewrite Rminus_0_r, !(R64_F 0), Rmult_0_l, !(R64_F 0), Rplus_0_r, (R64_F 0) by apply F_0.
      replace (x + t * (y - x) - 0) with ((1 - t) * (x - 0) + t * (y - 0)) by ring. lra. }
  pose proof (eta_less P) as ES. pose proof (sum_off d (- k) FD (generic_format_opp _ _ _ FK)) as O1. fold (d - k) in O1.
  pose proof (sub_b _ _ _ _ BD BK) as DK. pose proof (from_off (R64 (d - k)) (d - k)) as G1. set (r := R64 (d - k)) in *.
  pose proof (off (r * t)) as O2. pose proof (from_off (R64 (r * t)) (r * t)) as G2.
  assert (RT : Rabs (r * t) <= Rabs r) by (rewrite Rabs_mult, (Rabs_pos_eq t) by lra; rewrite <- (Rmult_1_r (Rabs r)) at 2; apply Rmult_le_compat_l; [apply Rabs_pos|lra]).
  pose proof (sum_off k _ FK (F_R64 (r * t))) as O3. set (p := R64 (r * t)) in *. pose proof (Rabs_triang k p) as T3. set (s := R64 (k + p)) in *.
  assert (E1 : Rabs ((r - (d - k)) * t) <= Rabs (r - (d - k))).
  { rewrite Rabs_mult, (Rabs_pos_eq t) by lra. rewrite <- (Rmult_1_r (Rabs (r - (d - k)))) at 2. apply Rmult_le_compat_l; [apply Rabs_pos|lra]. }
  replace (x + t * (y - x) - s) with ((1 - t) * (x - k) + t * (y - d) - (r - (d - k)) * t - (p - r * t) - (s - (k + p))) by ring.
  eapply Rle_trans; [apply (sub_b _ _ _ _ (sub_b _ _ _ _ (sub_b _ _ _ _ Comb E1) O2) O3)|].
  clear - ES P BK BD DK O1 G1 O2 G2 RT O3 T3.
  set (x1 := Rabs (r - (d - k))) in *. set (x2 := Rabs (d - k)) in *. set (x3 := Rabs r) in *. set (x4 := Rabs (r * t)) in *. set (x5 := Rabs p) in *.
  set (x6 := Rabs (p - r * t)) in *. set (x7 := Rabs (k + p)) in *. set (x8 := Rabs k) in *. clearbody x1 x2 x3 x4 x5 x6 x7 x8. rewrite u_is in *. lra.
Qed.

Lemma margin_is : 0 < size -> 127 * u * size <= margin size <= 129 * u * size.
Proof.
  intros P. pose proof (off (128 * u * size)) as O. pose proof (eta_less P) as E. rewrite (Rabs_pos_eq (128 * u * size)) in O by (rewrite u_is; lra).
  apply Rabs_le_inv in O. unfold margin. set (r := R64 _) in *. clearbody r. rewrite u_is in *. lra.
Qed.

(** The margin is enough at the end. *)
Lemma end_is_enough f : F f -> Rabs f <= size * (1 + 98 * u) -> f + 97 * u * size <= R64 (f + margin size).
Proof.
  intros Ff B. destruct positive as [P|Zero].
  - pose proof (margin_is P) as M. pose proof (sum_off f (margin size) Ff (F_R64 _)) as O. pose proof (Rabs_triang f (margin size)) as T.
    rewrite (Rabs_pos_eq (margin size)) in T by (rewrite u_is in *; lra). apply Rabs_le_inv in O. set (r := R64 (f + _)) in *. set (m := margin size) in *.
    set (b := Rabs (f + m)) in *. set (c := Rabs f) in *. clearbody r m b c. rewrite u_is in *. lra.
  - rewrite <- Zero in *. assert (f = 0) as -> by (apply Rabs_eq_R0; pose proof (Rabs_pos f); lra).
    unfold margin. rewrite !Rmult_0_r, !(R64_F 0), Rplus_0_r, (R64_F 0) by apply F_0. lra.
Qed.
(** The plane, which is not beyond the triangle, and what it is moved to. *)
Variable at_plane : R.
Hypothesis float : F at_plane.
Hypothesis met : at_plane <= 2 * size.
Notation moved := (R64 (at_plane + margin size)).

Lemma moved_least : 0 < size -> - (2 * size) <= at_plane -> at_plane + 124 * u * size <= moved.
Proof.
  intros P L. pose proof (margin_is P) as M. pose proof (sum_off at_plane (margin size) float (F_R64 _)) as O.
  assert (B : Rabs (at_plane + margin size) <= 2 * size + 129 * u * size) by (apply Rabs_le; rewrite u_is in *; lra).
  apply Rabs_le_inv in O. set (r := moved) in *. set (m := margin size) in *. set (b := Rabs (at_plane + m)) in *. clearbody r m b. rewrite u_is in *. lra.
Qed.

Lemma far_plane : 0 < size -> at_plane < - (2 * size) -> moved <= - (3 / 2 * size).
Proof.
  intros P L. pose proof (margin_is P) as M. pose proof (sum_off at_plane (margin size) float (F_R64 _)) as O.
  rewrite (Rabs_left (at_plane + margin size)) in O by (rewrite u_is in *; lra).
  apply Rabs_le_inv in O. set (r := moved) in *. set (m := margin size) in *. clearbody r m. rewrite u_is in *. lra.
Qed.

Hypothesis smaller : e <= 81 * u * size.

(** What goes is beyond the plane. *)
Lemma dropped_is_beyond y d : off_by y d -> moved < d -> at_plane < y.
Proof.
  intros D H. pose proof (found_most _ _ D) as BD. destruct D as (BY & OD & FD). apply Rabs_le_inv in BY, OD, BD. destruct positive as [P|Zero].
  - destruct (Rlt_or_le at_plane (- (2 * size))) as [Far|Near]; [rewrite u_is in *; lra|].
    pose proof (moved_least P Near) as M. assert (0 < u * size) by (rewrite u_is; lra). lra.
  - rewrite <- Zero in *. unfold margin in H. rewrite Rmult_0_r, (R64_F 0), Rplus_0_r, (R64_F at_plane) in H by (exact F_0 || exact float). lra.
Qed.

Notation part k d := (R64 (R64 (moved - k) / R64 (d - k))).

Lemma difference_positive k d : F k -> F d -> k < d -> (d - k) * (1 - u) <= R64 (d - k) <= (d - k) * (1 + u).
Proof.
  intros FK FD H. pose proof (sum_off d (- k) FD (generic_format_opp _ _ _ FK)) as O. fold (d - k) in O. rewrite (Rabs_pos_eq (d - k)) in O by lra.
  apply Rabs_le_inv in O. lra.
Qed.

Lemma part_inside k d : F k -> F d -> k <= moved -> moved < d -> 0 <= part k d <= 1.
Proof.
  intros FK FD K D. pose proof (difference_positive k d FK FD ltac:(lra)) as P.
  assert (Pos : 0 < R64 (d - k)). { eapply Rlt_le_trans; [|apply P]. apply Rmult_lt_0_compat; [lra|]. rewrite u_is. lra. }
  apply quotient_inside; [|exact Pos]. split; [apply R64_pos; lra|apply R64_le; lra].
Qed.

(** And what is new is not before it. *)
Lemma new_is_not_before x y k d : off_by x k -> off_by y d -> k <= moved -> moved < d -> at_plane <= x + part k d * (y - x).
Proof.
  intros OX OY K D. pose proof (found_most _ _ OX) as BK. pose proof (found_most _ _ OY) as BD. destruct OX as (_ & OK & FK), OY as (_ & OD & FD).
  pose proof (part_inside k d FK FD K D) as T. apply Rabs_le_inv in BK, BD, OK, OD. destruct positive as [P|Zero]; [|rewrite <- Zero in *; lra].
  destruct (Rlt_or_le at_plane (- (2 * size))) as [Far|Near]; [pose proof (far_plane P Far); rewrite u_is in *; lra|].
  pose proof (moved_least P Near) as M. pose proof (difference_positive k d FK FD ltac:(lra)) as DP. pose proof (eta_less P) as ES.
  assert (NP : (moved - k) * (1 - u) <= R64 (moved - k)).
  { destruct (Req_dec moved k) as [E|N]; [rewrite E, Rminus_diag_eq, (R64_F 0) by (reflexivity || apply F_0); lra|].
    apply (difference_positive k moved FK (F_R64 _)). lra. }
  set (top := R64 (moved - k)) in *. set (bottom := R64 (d - k)) in *. set (g := moved) in *. set (t := R64 (top / bottom)) in *.
  assert (W : 0 < d - k) by lra. assert (U0 : 0 < u < / 2048) by (rewrite u_is; lra).
  assert (Bot : 0 < bottom) by (eapply Rlt_le_trans; [|apply DP]; apply Rmult_lt_0_compat; lra).
  assert (G0 : 0 <= g - k) by lra. assert (Top : 0 <= top) by (apply R64_pos; lra).
  (* t (d - k) is hardly less than g - k. *)
  assert (Q : (g - k) * (1 - 2 * u) <= top / bottom * (d - k)).
  { apply Rmult_le_reg_r with (bottom); [exact Bot|]. replace (top / bottom * (d - k) * bottom) with (top * (d - k)) by (field; lra).
    apply Rle_trans with ((g - k) * (1 - 2 * u) * ((d - k) * (1 + u))).
    - apply Rmult_le_compat_l; [apply Rmult_le_pos; lra|apply DP].
    - apply Rle_trans with ((g - k) * (1 - u) * (d - k)); [|apply Rmult_le_compat_r; lra].
      assert (0 <= (g - k) * (d - k)) by (apply Rmult_le_pos; lra). clear - H. set (a := (g - k) * (d - k)) in *.
      replace ((g - k) * (1 - 2 * u) * ((d - k) * (1 + u))) with (a * ((1 - 2 * u) * (1 + u))) by (unfold a; ring).
      replace ((g - k) * (1 - u) * (d - k)) with (a * (1 - u)) by (unfold a; ring). apply Rmult_le_compat_l; [exact H|]. rewrite u_is. lra. }
  pose proof (off (top / bottom)) as OT. fold t in OT. assert (Q0 : 0 <= top / bottom) by (apply Rle_mult_inv_pos; lra).
  rewrite (Rabs_pos_eq _ Q0) in OT. apply Rabs_le_inv in OT. set (q := top / bottom) in *.
  assert (TD : (q * (1 - u) - eta) * (d - k) <= t * (d - k)) by (apply Rmult_le_compat_r; lra).
  assert (QD : (g - k) * (1 - 2 * u) * (1 - u) <= q * (d - k) * (1 - u)) by (apply Rmult_le_compat_r; lra).
  assert (EU : eta <= u * u) by (rewrite <- bpow_plus; apply eta_is; lia).
  assert (ED : eta * (d - k) <= u * u * (d - k)) by (apply Rmult_le_compat_r; lra).
  assert (C1 : t * (d - y) <= t * e) by (apply Rmult_le_compat_l; lra). assert (C2 : (1 - t) * (k - x) <= (1 - t) * e) by (apply Rmult_le_compat_l; lra).
  assert (Z : k + t * (d - k) - e <= x + t * (y - x)) by lra.
  assert (S : 0 < size) by exact P. set (td := t * (d - k)) in *. set (qd := q * (d - k)) in *. set (z := x + t * (y - x)) in *.
  replace ((q * (1 - u) - eta) * (d - k)) with (qd * (1 - u) - eta * (d - k)) in TD by (unfold qd; ring). set (ed := eta * (d - k)) in *.
  clear - M BK BD TD QD ED Z S smaller K D. clearbody td qd z ed g. rewrite u_is in *. lra.
Qed.

End Coordinate.

(** * All six cuts *)

Section Part.
(** The corners in the frame, exact and as they are computed. *)
Variables a b c a' b' c' : vec.
Variable size : axis -> R.
Hypothesis usual : forall k, size k = 0 \/ bpow radix2 (-900) <= size k.
Definition corner_is (x x' : vec) : Prop := forall k, Rabs (pick k x') <= size k /\ Rabs (pick k x - pick k x') <= u * size k /\ F (pick k x').
Hypothesis A : corner_is a a'.
Hypothesis B : corner_is b b'.
Hypothesis C : corner_is c c'.

Definition coordinate (k : axis) : affine := Affine (pick k a) (pick k b - pick k a) (pick k c - pick k a).
(** How far a point is beyond a plane. *)
Definition beyond (p : plane) (x : place) : R := signed p (value (coordinate (on p)) x) - signed p (place_on p).
(** The plane is a float, and some corner is beyond it: else there is no cut. *)
Definition cuts (p : plane) : Prop := F (place_on p) /\ signed p (place_on p) <= 2 * size (on p).

Definition near (n : nat) (x : corner) : Prop := inside (at_ x) /\
  forall k, off_by (size k) ((16 * INR n + 1) * u * size k) (value (coordinate k) (at_ x)) (pick k (found x)).

Lemma size_pos k : 0 <= size k.
Proof. destruct (A k) as (H & _). eapply Rle_trans; [apply Rabs_pos|exact H]. Qed.

Lemma signed_abs p x y : Rabs (signed p x - signed p y) = Rabs (x - y) /\ Rabs (signed p x) = Rabs x.
Proof.
  unfold signed. destruct (is_lo p); [|split; reflexivity]. split; [|apply Rabs_Ropp]. replace (- x - - y) with (- (x - y)) by ring. apply Rabs_Ropp.
Qed.
Lemma signed_F p x : F x -> F (signed p x).
Proof. intros H. unfold signed. destruct (is_lo p); [now apply generic_format_opp|exact H]. Qed.
Lemma signed_off p s e x f : off_by s e x f -> off_by s e (signed p x) (signed p f).
Proof. intros (H & O & G). destruct (signed_abs p x f) as [E1 E2]. split; [now rewrite E2|split; [now rewrite E1|now apply signed_F]]. Qed.

Lemma coordinate_most k x : inside x -> Rabs (value (coordinate k) x) <= size k * (1 + u).
Proof.
  intros (V & W & S). replace (value (coordinate k) x) with ((1 - pv x - pw x) * pick k a + pv x * pick k b + pw x * pick k c)
    by (unfold value, coordinate; cbn [at_0 by_v by_w]; ring).
  assert (Most : forall y y', corner_is y y' -> Rabs (pick k y) <= size k * (1 + u)).
  { intros y y' H. destruct (H k) as (H1 & H2 & _). pose proof (from_off (pick k y) (pick k y')). lra. }
  assert (Part : forall t y y', 0 <= t -> corner_is y y' -> Rabs (t * pick k y) <= t * (size k * (1 + u))).
  { intros t y y' T H. rewrite Rabs_mult, (Rabs_pos_eq t T). apply Rmult_le_compat_l; [exact T|exact (Most y y' H)]. }
  eapply Rle_trans; [exact (add_b _ _ _ _ (add_b _ _ _ _ (Part (1 - pv x - pw x) a a' ltac:(lra) A) (Part (pv x) b b' V B)) (Part (pw x) c c' W C))|]. lra.
Qed.

Lemma mix_inside p q t : inside p -> inside q -> 0 <= t <= 1 -> inside (Place (pv p + t * (pv q - pv p)) (pw p + t * (pw q - pw p))).
Proof.
  intros (V & W & S) (V' & W' & S') T. unfold inside. cbn [pv pw].
  assert (0 <= (1 - t) * pv p) by (apply Rmult_le_pos; lra). assert (0 <= t * pv q) by (apply Rmult_le_pos; lra).
  assert (0 <= (1 - t) * pw p) by (apply Rmult_le_pos; lra). assert (0 <= t * pw q) by (apply Rmult_le_pos; lra).
  assert (0 <= (1 - t) * (1 - pv p - pw p)) by (apply Rmult_le_pos; lra). assert (0 <= t * (1 - pv q - pw q)) by (apply Rmult_le_pos; lra). lra.
Qed.

Lemma value_mix f p q t : value f (Place (pv p + t * (pv q - pv p)) (pw p + t * (pw q - pw p))) = value f p + t * (value f q - value f p).
Proof. unfold value. cbn [pv pw]. ring. Qed.

Lemma start_near x : In x [Corner (Place 0 0) a'; Corner (Place 1 0) b'; Corner (Place 0 1) c'] -> near 0 x.
Proof.
  assert (Start : forall y y' p, corner_is y y' -> inside p -> (forall k, value (coordinate k) p = pick k y) -> near 0 (Corner p y')).
  { intros y y' p H I E. split; [exact I|]. intros k. cbn [at_ found]. pose proof (coordinate_most k p I) as M. rewrite E in *.
    destruct (H k) as (H1 & H2 & H3). split; [exact M|split; [|exact H3]]. cbn [INR]. lra. }
  intros [<- |[<- |[<- |[]]]]; [apply (Start a)|apply (Start b)|apply (Start c)]; try assumption; try (unfold inside; cbn [pv pw]; lra);
    intros k; unfold value, coordinate; cbn [at_0 by_v by_w pv pw]; ring.
Qed.

Section Step.
Variable n : nat.
Hypothesis early : (n <= 5)%nat.
Variable p : plane.
Hypothesis usable : cuts p.

Let count : 0 <= INR n <= 5.
Proof. split; [apply pos_INR|]. replace 5 with (INR 5) by (cbn; ring). now apply le_INR. Qed.
Notation e k := ((16 * INR n + 1) * u * size k).
Lemma e_small k : 0 <= e k <= 97 * u * size k /\ e k <= 81 * u * size k.
Proof.
  pose proof (size_pos k) as P. assert (U0 : 0 <= u * size k) by (apply Rmult_le_pos; [apply bpow_ge_0|exact P]).
  assert (H : 0 <= (16 * INR n + 1) * (u * size k) <= 81 * (u * size k)) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]). lra.
Qed.

Lemma stays_is x : (stays size p x = true <-> height p x <= bound size p) /\ (stays size p x = false <-> bound size p < height p x).
Proof. unfold stays. destruct (Rle_bool_spec (height p x) (bound size p)); split; split; intros; try discriminate; try lra; auto. Qed.

Lemma height_off x : near n x -> off_by (size (on p)) (e (on p)) (signed p (value (coordinate (on p)) (at_ x))) (height p x).
Proof. intros (_ & H). apply signed_off, H. Qed.

Lemma goes_beyond x : near n x -> stays size p x = false -> 0 < beyond p (at_ x).
Proof.
  intros N S. apply stays_is in S. unfold beyond. apply Rlt_Rminus. destruct usable as [U M]. destruct (e_small (on p)) as [S1 S2].
  exact (dropped_is_beyond _ (usual _) _ S1 _ (signed_F p _ U) M S2 _ _ (height_off x N) S).
Qed.

Lemma share_inside x y : near n x -> near n y -> stays size p x = true -> stays size p y = false -> 0 <= share size p x y <= 1.
Proof.
  intros NX NY SX SY. apply stays_is in SX, SY. apply (height_off x) in NX as (_ & _ & FX). apply (height_off y) in NY as (_ & _ & FY).
  exact (part_inside _ _ _ _ FX FY SX SY).
Qed.

Lemma new_near x y : near n x -> near n y -> stays size p x = true -> stays size p y = false -> near (S n) (crossing size p x y).
Proof.
  intros NX NY SX SY. pose proof (share_inside x y NX NY SX SY) as T. destruct NX as [IX NX], NY as [IY NY].
  assert (I : inside (at_ (crossing size p x y))) by (apply mix_inside; assumption). split; [exact I|]. intros k.
  split; [now apply coordinate_most|]. cbn [crossing at_ found]. rewrite value_mix. pose proof (e_small k) as [E _].
  rewrite S_INR. replace ((16 * (INR n + 1) + 1) * u * size k) with (e k + 16 * u * size k) by ring.
  split; [|unfold vadd; destruct k; apply F_R64].
  replace (pick k (vadd (found x) (scaled (vsub R64 (found y) (found x)) (share size p x y))))
    with (R64 (pick k (found x) + R64 (R64 (pick k (found y) - pick k (found x)) * share size p x y))) by (destruct k; reflexivity).
  exact (crossing_off _ (usual k) _ E _ _ _ _ _ (NX k) (NY k) T).
Qed.

Lemma new_not_before x y : near n x -> near n y -> stays size p x = true -> stays size p y = false -> 0 <= beyond p (at_ (crossing size p x y)).
Proof.
  intros NX NY SX SY. unfold beyond. cbn [crossing at_]. rewrite value_mix. destruct usable as [U M]. destruct (e_small (on p)) as [S1 S2].
  apply stays_is in SX, SY. pose proof (new_is_not_before _ (usual _) _ S1 _ (signed_F p _ U) M S2 _ _ _ _ (height_off x NX) (height_off y NY) SX SY) as H.
  fold (bound size p) (share size p x y) in H. revert H. generalize (share size p x y) as t. intros t H. unfold signed in *. destruct (is_lo p); lra.
Qed.

(** A cut: what is true of the corners stays so. *)
Lemma step l x : (forall y, In y l -> near n y) -> in_order (map at_ l) -> holds (map at_ l) x -> beyond p x <= 0 ->
  (forall y, In y (cut_by size l p) -> near (S n) y) /\ in_order (map at_ (cut_by size l p)) /\ holds (map at_ (cut_by size l p)) x.
Proof.
  intros N O H X.
  assert (Edges : on_edges corner at_ (stays size p) (crossing size p) l).
  { intros y z Y Z SY SZ. exists (share size p y z). split; [apply share_inside; auto|reflexivity]. }
  split; [|split].
  - intros y Y. destruct (cut_members _ _ _ _ _ Y) as [L|(v & w & V & W & SV & SW & ->)].
    + destruct (N y L) as [I K]. split; [exact I|]. intros k. destruct (K k) as (K1 & K2 & K3). split; [exact K1|split; [|exact K3]].
      eapply Rle_trans; [exact K2|]. rewrite S_INR. assert (0 <= u * size k) by (apply Rmult_le_pos; [apply bpow_ge_0|apply size_pos]). lra.
    + apply new_near; auto.
  - destruct l as [|y0 lr] using rev_ind; [exact O|]. now apply cut_in_order.
  - set (side := if is_lo p then Affine (place_on p - pick (on p) a) (pick (on p) a - pick (on p) b) (pick (on p) a - pick (on p) c)
      else Affine (pick (on p) a - place_on p) (pick (on p) b - pick (on p) a) (pick (on p) c - pick (on p) a)).
    assert (Side : forall y, value side y = beyond p y).
    { intros y. unfold side, beyond, signed, value, coordinate. destruct (is_lo p); cbn [at_0 by_v by_w]; ring. }
    apply (cut_keeps corner at_ (stays size p) (crossing size p) l side x O Edges); [| |exact H|now rewrite Side].
    + intros q Q SQ. rewrite Side. apply goes_beyond; auto.
    + intros y (v & w & V & W & SV & SW & ->). rewrite Side. apply new_not_before; auto.
Qed.
End Step.

Lemma all_steps x : forall planes n l, (n + List.length planes <= 6)%nat -> (forall p, In p planes -> cuts p /\ beyond p x <= 0) ->
  (forall y, In y l -> near n y) -> in_order (map at_ l) -> holds (map at_ l) x ->
  (forall y, In y (fold_left (cut_by size) planes l) -> near (n + List.length planes) y) /\ holds (map at_ (fold_left (cut_by size) planes l)) x.
Proof.
  induction planes as [|p planes IH]; intros n l L P N O H; cbn [fold_left List.length] in *.
  - rewrite Nat.add_0_r. now split.
  - destruct (P p ltac:(now left)) as [U X]. destruct (step n ltac:(lia) p U l x N O H X) as (N' & O' & H').
    rewrite <- Nat.add_succ_comm in *. apply IH; auto. intros q Q. apply P. now right.
Qed.

(** All of the triangle on the inner sides of at most six planes is in the box of the corners that are left, grown by the margin, on each
    axis. [SPLIT-1] *)
Theorem part_holds planes x k : (List.length planes <= 6)%nat -> (forall p, In p planes -> cuts p /\ beyond p x <= 0) -> inside x ->
  (exists y, In y (left size a' b' c' planes) /\ R64 (pick k (found y) - margin (size k)) <= value (coordinate k) x) /\
  (exists y, In y (left size a' b' c' planes) /\ value (coordinate k) x <= R64 (pick k (found y) + margin (size k))).
Proof.
  intros L P I. destruct (all_steps x planes 0 _ L P start_near whole_in_order (whole_holds x I)) as [N H]. fold (left size a' b' c' planes) in *.
  set (l := left size a' b' c' planes) in *. cbn [Nat.add] in N.
  assert (Count : INR (List.length planes) <= 6) by (replace 6 with (INR 6) by (cbn; ring); now apply le_INR).
  pose proof (pos_INR (List.length planes)) as CP. pose proof (size_pos k) as SP. assert (US : 0 <= u * size k) by (apply Rmult_le_pos; [apply bpow_ge_0|exact SP]).
  assert (E : 0 <= (16 * INR (List.length planes) + 1) * u * size k <= 97 * u * size k).
  { rewrite Rmult_assoc. split; [apply Rmult_le_pos; lra|]. rewrite Rmult_assoc. apply Rmult_le_compat_r; lra. }
  (* For any coordinate with a sign, some corner is as far. *)
  assert (Far : forall p, on p = k -> exists y, In y l /\ signed p (value (coordinate k) x) <= R64 (signed p (pick k (found y)) + margin (size k))).
  { intros p <-. set (g := if is_lo p then -1 else 1). assert (G : forall z, g * z = signed p z) by (intros z; unfold g, signed; destruct (is_lo p); ring).
    assert (Most : l = [] \/ exists y, In y l /\ forall z, In z l -> signed p (pick (on p) (found z)) <= signed p (pick (on p) (found y))).
    { clear - l. induction l as [|z m IH]; [now left|right]. destruct IH as [-> |(y & Y & M)].
      - exists z. split; [now left|]. intros w [<- |[]]. lra.
      - destruct (Rle_or_lt (signed p (pick (on p) (found z))) (signed p (pick (on p) (found y)))) as [Q|Q].
        + exists y. split; [now right|]. intros w [<- |W]; [exact Q|now apply M].
        + exists z. split; [now left|]. intros w [<- |W]; [lra|]. specialize (M w W). lra. }
    destruct Most as [Empty|(y & Y & M)].
    - exfalso. rewrite Empty in H. pose proof (H (Affine 1 0 0) ltac:(intros ? [])) as Bad. unfold value in Bad. cbn [at_0 by_v by_w] in Bad. lra.
    - exists y. split; [exact Y|]. destruct (N y Y) as [_ K]. specialize (K (on p)). apply (signed_off p) in K.
      pose proof (found_most _ _ E _ _ K) as FM. destruct K as (_ & _ & FY).
      eapply Rle_trans; [|exact (end_is_enough _ (usual _) _ E _ FY FM)].
      set (top := signed p (pick (on p) (found y)) + 97 * u * size (on p)).
      pose proof (H (Affine (g * pick (on p) a - top) (g * (pick (on p) b - pick (on p) a)) (g * (pick (on p) c - pick (on p) a)))) as V.
      assert (Value : forall z, value (Affine (g * pick (on p) a - top) (g * (pick (on p) b - pick (on p) a)) (g * (pick (on p) c - pick (on p) a))) z =
        signed p (value (coordinate (on p)) z) - top) by (intros z; rewrite <- G; unfold value, coordinate; cbn [at_0 by_v by_w]; ring).
      rewrite Value in V. apply Rminus_le. apply V. intros q Q. apply in_map_iff in Q as (z & <- & Z). rewrite Value.
      destruct (N z Z) as [_ K]. specialize (K (on p)). apply (signed_off p) in K as (_ & O & _). apply Rabs_le_inv in O. specialize (M z Z). unfold top. lra. }
  split.
  - destruct (Far (Plane k true 0) eq_refl) as (y & Y & V). exists y. split; [exact Y|]. unfold signed in V. cbn [is_lo] in V.
    replace (- pick k (found y) + margin (size k)) with (- (pick k (found y) - margin (size k))) in V by ring. rewrite round_NE_opp in V. lra.
  - exact (Far (Plane k false 0) eq_refl).
Qed.
End Part.
