(** The filter of four triangles for a ray within bounds: [TriangleRay::enclosed] of src/geom/lanes/triangles.rs, one lane, in single precision
    with gradual underflow and without a greatest exponent. What is rejected for the ray in the middle is rejected for every ray whose
    origin is off by at most [w], and whose direction by at most [v], in each component. [LANES-5] *)
Require Import Reals ZArith Lia Lra Psatz.
From Flocq Require Import Core Relative Plus_error.
Require Import StacklessExact.Rounding StacklessExact.Triple StacklessExact.Filter StacklessExact.Floor StacklessExact.Off StacklessExact.Lanes.
Open Scope R_scope.

Local Instance prec_24' : Prec_gt_0 24 := eq_refl.

(** * The operations *)

(** [OFF_EDGE] and [OFF]; and [OFF_REACH], which is rounded. *)
Notation off := (9 / 2).
Definition off_reach : R := R32 (9 / (39 * u)).

(** The prepared bounds of [enclosed_with], and the two decisions of [survivors] by them. *)
Definition edge_within (v D : R) : R := R32 (R32 (39 * u * D) + R32 (off * v)).
Definition det_within (v D : R) : R := R32 (R32 (40 * u * D) + R32 (off * v)).
Definition t_within (w C : R) : R := R32 (R32 (44 * u * C) + R32 (off * w)).
Definition twice_within (w C : R) : R := R32 (R32 (2 * C) + R32 (off_reach * w)).
Definition delta_within (w v D C E : R) : R := R32 (R32 (edge_within v D * E) * R32 (twice_within w C + E)).
Definition is_missed_within (w v D C E : R) (x : determinants) : Prop :=
  let delta := delta_within w v D C E in
  Rmin (Rmin (edge_u x) (edge_v x)) (edge_w x) < - delta /\ delta < Rmax (Rmax (edge_u x) (edge_v x)) (edge_w x).
Definition is_beyond_within (neg : bool) (w v D C E best : R) (x : determinants) : Prop :=
  R32 (R32 (Rabs (det x) + R32 (det_within v D * R32 (E * E))) * best) < R32 (front neg (top_t x) - R32 (t_within w C * R32 (E * E))).

(** * Differences are the same with gradual underflow and without a least exponent *)

Lemma sub_same x y : F x -> F y -> R32 (x - y) = round radix2 (FLX_exp 24) ZnearestE (x - y).
Proof.
  intros Fx Fy. destruct (Rle_or_lt (bpow radix2 (-126)) (Rabs (x - y))) as [H|H].
  - now apply round_FLT_FLX.
  - assert (G : F (x - y)).
    { apply (FLT_format_plus_small radix2 (-149) 24); [exact Fx|now apply generic_format_opp|]. apply Rlt_le. eapply Rlt_trans; [exact H|]. apply bpow_lt. lia. }
    rewrite (round_generic _ _ _ _ G). symmetry. apply round_generic; [typeclasses eauto|]. exact (generic_format_FLX_FLT radix2 (-149) 24 _ G).
Qed.

Lemma vsub_same a b : vformat a -> vformat b -> vsub R32 a b = vsub (round radix2 (FLX_exp 24) ZnearestE) a b.
Proof. intros (X & Y & Z) (X' & Y' & Z'). unfold vsub. now rewrite !sub_same. Qed.

Section Within.
Variables v0 v1 v2 o d o' d' : vec.
Hypothesis F0 : vformat v0.
Hypothesis F1 : vformat v1.
Hypothesis F2 : vformat v2.
Hypothesis Fo : vformat o.
Notation e1 := (vsub R32 v1 v0).
Notation e2 := (vsub R32 v2 v0).
Notation s := (vsub R32 o v0).
Variable found : determinants.
Hypothesis Found : evaluated v0 v1 v2 o d found.
Let middle := determinants_of exactly v0 v1 v2 o d.
Let truth := determinants_of exactly v0 v1 v2 o' d'.

Variables w v D C E : R.
Hypothesis Ho : near w o o'.
Hypothesis Hd : near v d d'.
Hypothesis HD : bounded D d.
Hypothesis HC : bounded C s.
Hypothesis HE : bounded E e1 /\ bounded E e2.
Hypothesis v_small : v <= D.
Hypothesis D_range : bpow radix2 (-20) <= D <= bpow radix2 20.
Hypothesis C_least : least <= C.
Hypothesis C_F : F C.
Hypothesis E_least : least <= E.

Let Pw : 0 <= w := pos_b _ _ (proj1 Ho).
Let Pv : 0 <= v := pos_b _ _ (proj1 Hd).
Let Lp : 0 < least := bpow_gt_0 radix2 (-40).
Let PD : 0 < D := Rlt_le_trans _ _ _ (bpow_gt_0 radix2 (-20)) (proj1 D_range).
Let PC : 0 < C := Rlt_le_trans _ _ _ Lp C_least.
Let PE : 0 < E := Rlt_le_trans _ _ _ Lp E_least.
Let P_eta : 0 < eta := bpow_gt_0 radix2 (-150).

(** * What the true determinants are off by *)

Notation q := ((1 + u) * (1 + u)).
Let room := v * C + w * (D + v).

Lemma edges_move : let m := 4 * q * (v * E * E) + 8 * q * (E * room) in
  Rabs (edge_u middle - edge_u truth) <= m /\ Rabs (edge_v middle - edge_v truth) <= m /\ Rabs (edge_w middle - edge_w truth) <= m.
Proof.
  intros m. pose proof HC as HC'. pose proof HE as HE'. rewrite (vsub_same _ _ Fo F0) in HC'. rewrite (vsub_same _ _ F1 F0), (vsub_same _ _ F2 F0) in HE'.
  assert (0 <= v * E * E) by (repeat apply Rmult_le_pos; lra).
  assert (0 <= E * room) by (unfold room; apply Rmult_le_pos; [lra|]; assert (0 <= v * C) by (apply Rmult_le_pos; lra);
    assert (0 <= w * (D + v)) by (apply Rmult_le_pos; lra); lra).
  assert (0 <= q * (v * E * E)) by (apply Rmult_le_pos; lra). assert (0 <= q * (E * room)) by (apply Rmult_le_pos; lra).
  split; [|split].
  - eapply Rle_trans; [exact (u_moves 24 ltac:(lia) v0 v1 v2 o d o' d' w v D C E Ho Hd HD HC' HE')|]. unfold m, room in *. change (unit 24) with u. lra.
  - eapply Rle_trans; [exact (v_moves 24 ltac:(lia) v0 v1 v2 o d o' d' w v D C E Ho Hd HD HC' HE')|]. unfold m, room in *. change (unit 24) with u. lra.
  - exact (w_moves 24 ltac:(lia) v0 v1 v2 o d o' d' w v D C E Ho Hd HD HC' HE').
Qed.

(** * The bounds as evaluated *)

Let tiny : 1000000000000000000 * eta <= bpow radix2 (-90).
Proof. change (-90)%Z with (60 + -150)%Z. rewrite bpow_plus. change (bpow radix2 60) with 1152921504606846976. lra. Qed.

(** A normal number and one that may be as small as it likes, both rounded: the sum, rounded. *)
Lemma sum_low big x y : bpow radix2 (-64) <= big -> big * (1 - u) <= x -> 0 <= y -> forall z, z * (1 - 2 * u) - eta <= y -> 0 <= z ->
  (big + z) * (1 - 4 * u) <= R32 (x + y).
Proof.
  intros Hb Hx Hy z Hz Pz. assert (K : bpow radix2 (-90) <= u * big).
  { apply Rle_trans with (u * bpow radix2 (-64)); [change u with (bpow radix2 (-24)); rewrite <- bpow_plus; apply bpow_le; lia|].
    apply Rmult_le_compat_l; lra. }
  assert (Pb : 0 < big) by (pose proof (bpow_gt_0 radix2 (-64)); lra).
  assert (N : bpow radix2 (-126) <= x + y).
  { apply Rle_trans with (bpow radix2 (-90)); [now apply bpow_le|]. lra. }
  eapply Rle_trans; [|apply (low_normal _ N)].
  assert (Z : (big + z) * (1 - 3 * u) <= x + y) by lra.
  apply Rle_trans with ((big + z) * (1 - 3 * u) * (1 - u)); [|apply Rmult_le_compat_r; lra].
  assert (0 <= (big + z) * (u * u)) by (apply Rmult_le_pos; lra). lra.
Qed.

(** A constant, a unit and D: with the least D. *)
Lemma unit_low c : 1 <= c -> bpow radix2 (-64) <= c * u * D.
Proof.
  intros Hc. apply Rle_trans with (bpow radix2 (-24 + -20)); [now apply bpow_le|]. rewrite bpow_plus. change (bpow radix2 (-24)) with u.
  pose proof (bpow_ge_0 radix2 (-20)). destruct D_range. apply Rmult_le_compat; lra.
Qed.

(** A prepared bound. *)
Lemma bound_sum c X y : bpow radix2 (-64) <= c * u * X -> 0 <= y -> (c * u * X + off * y) * (1 - 4 * u) <= R32 (R32 (c * u * X) + R32 (off * y)).
Proof.
  intros HX Hy. apply sum_low; [exact HX| | |  |].
  - apply low_normal. eapply Rle_trans; [|exact HX]. now apply bpow_le.
  - apply nonneg. lra.
  - pose proof (low_32 (off * y) ltac:(lra)). lra.
  - lra.
Qed.

Lemma off_reach_low : 9 / (39 * u) * (1 - u) <= off_reach.
Proof. unfold off_reach. apply low_normal. apply Rle_trans with 1; [change 1 with (bpow radix2 0); now apply bpow_le|lra]. Qed.

Lemma twice_low : (2 * C + 9 / (39 * u) * w) * (1 - 4 * u) <= twice_within w C.
Proof.
  unfold twice_within. rewrite (twice C C_least C_F). pose proof off_reach_low as L.
  apply sum_low.
  - apply Rle_trans with least; [now apply bpow_le|lra].
  - lra.
  - apply nonneg. apply Rmult_le_pos; lra.
  - pose proof (low_32 (off_reach * w) ltac:(apply Rmult_le_pos; lra)) as P. assert (9 / (39 * u) * (1 - u) * w <= off_reach * w) by (now apply Rmult_le_compat_r).
    set (r := off_reach * w) in *. lra.
  - apply Rmult_le_pos; lra.
Qed.

Lemma delta_low : (39 * u * D + off * v) * E * (2 * C + 9 / (39 * u) * w + E) * (1 - 16 * u) - eta <= delta_within w v D C E.
Proof.
  pose proof (bound_sum 39 D v (unit_low 39 ltac:(lra)) Pv) as K1. fold (edge_within v D) in K1. pose proof twice_low as K2.
  set (a := 39 * u * D + off * v) in *. set (b := 2 * C + 9 / (39 * u) * w) in *.
  assert (Pa : bpow radix2 (-64) <= a) by (pose proof (unit_low 39 ltac:(lra)); unfold a; lra).
  assert (Pb : least <= b) by (assert (0 <= 9 / (39 * u) * w) by (apply Rmult_le_pos; lra); unfold b; lra).
  pose proof (bpow_gt_0 radix2 (-64)) as P64. set (k1 := edge_within v D) in *. set (k2 := twice_within w C) in *.
  assert (N1 : k1 * E * (1 - u) <= R32 (k1 * E)).
  { apply low_normal. apply Rle_trans with (bpow radix2 (-65 + -40)); [now apply bpow_le|]. rewrite bpow_plus.
    apply Rmult_le_compat; try apply bpow_ge_0; [|exact E_least]. change (-65)%Z with (-64 + -1)%Z. rewrite bpow_plus. change (bpow radix2 (-1)) with (/ 2). lra. }
  assert (N2 : (k2 + E) * (1 - u) <= R32 (k2 + E)).
  { apply low_normal. apply Rle_trans with least; [now apply bpow_le|]. lra. }
  set (n1 := R32 (k1 * E)) in *. set (n2 := R32 (k2 + E)) in *.
  assert (M1 : a * E * (1 - 5 * u) <= n1).
  { eapply Rle_trans; [|exact N1]. assert (a * (1 - 4 * u) * E <= k1 * E) by (apply Rmult_le_compat_r; lra).
    assert (0 <= a * E) by (apply Rmult_le_pos; lra). set (x := a * E) in *. set (k := k1 * E) in *.
    replace (a * (1 - 4 * u) * E) with (x * (1 - 4 * u)) in H by (unfold x; ring). lra. }
  assert (M2 : (b + E) * (1 - 5 * u) <= n2) by (eapply Rle_trans; [|exact N2]; lra).
  assert (Q1 : 0 <= a * E * (1 - 5 * u)) by (repeat apply Rmult_le_pos; lra). assert (Q2 : 0 <= (b + E) * (1 - 5 * u)) by (apply Rmult_le_pos; lra).
  assert (M : a * E * (1 - 5 * u) * ((b + E) * (1 - 5 * u)) <= n1 * n2) by (now apply Rmult_le_compat).
  unfold delta_within. fold k1 k2 n1 n2. pose proof (low_32 (n1 * n2) ltac:(apply Rmult_le_pos; lra)) as L.
  set (X := a * E * (b + E)). assert (PX : 0 <= X) by (unfold X; repeat apply Rmult_le_pos; lra).
  replace (a * E * (1 - 5 * u) * ((b + E) * (1 - 5 * u))) with (X * ((1 - 5 * u) * (1 - 5 * u))) in M by (unfold X; ring).
  set (n := n1 * n2) in *. replace (a * E * (b + E) * (1 - 16 * u)) with (X * (1 - 16 * u)) by (unfold X; ring). lra.
Qed.

(** An edge function of the true ray is off by at most delta. [LANES-5] *)
Theorem within_covers : 77 / 2 * u * (D * E * (2 * C + E)) + under D C E + (4 * q * (v * E * E) + 8 * q * (E * room)) <= delta_within w v D C E.
Proof.
  eapply Rle_trans; [|exact delta_low].
  pose proof (floor_covers v0 v1 v2 o D C E E HC HE (proj1 D_range) (sizes_are_floored D E D_range E_least)) as L.
  assert (A1 : 0 <= D * E * (2 * C + E)) by (repeat apply Rmult_le_pos; lra).
  assert (A2 : 0 <= v * E * E) by (repeat apply Rmult_le_pos; lra).
  assert (A3 : 0 <= E * v * C) by (repeat apply Rmult_le_pos; lra).
  assert (A4 : 0 <= E * w * D) by (repeat apply Rmult_le_pos; lra).
  assert (A5 : 0 <= E * w * v) by (repeat apply Rmult_le_pos; lra).
  replace ((39 * u * D + off * v) * E * (2 * C + 9 / (39 * u) * w + E)) with
    (39 * u * (D * E * (2 * C + E)) + 9 / 2 * (v * E * E) + 9 * (E * v * C) + 9 * (E * w * D) + 81 / (78 * u) * (E * w * v)) by field.
  replace (E * room) with (E * v * C + E * w * D + E * w * v) by (unfold room; ring).
  set (a1 := D * E * (2 * C + E)) in *. set (a2 := v * E * E) in *. set (a3 := E * v * C) in *. set (a4 := E * w * D) in *. set (a5 := E * w * v) in *.
  clearbody a1 a2 a3 a4 a5. lra.
Qed.

(** A triangle that the miss filter rejects is missed by the true ray. [LANES-5] *)
Theorem missed_within_is_right : is_missed_within w v D C E found -> ~ meets truth.
Proof.
  pose proof within_covers as B. destruct edges_move as (MU & MV & MW).
  destruct (errors v0 v1 v2 o d F0 F1 F2 Fo found Found D C E HD HC HE (proj1 D_range)) as (EU & EV & EW). fold middle in EU, EV, EW.
  pose proof (far_b _ _ _ _ _ EU MU) as U. pose proof (far_b _ _ _ _ _ EV MV) as V. pose proof (far_b _ _ _ _ _ EW MW) as W.
  intros [L H]. apply (opposite_is_missed found truth (delta_within w v D C E)); try reflexivity; [lra|lra|lra|now apply least_of_three|now apply greatest_of_three].
Qed.

(** * Beyond the best hit *)

Let S1 := D * (E * E).
Let S2 := v * (E * E).
Let y1 := C * (E * E).
Let y2 := w * (E * E).

Let PEE : 0 < E * E := Rmult_lt_0_compat _ _ PE PE.
Let PS1 : 0 < S1 := Rmult_lt_0_compat _ _ PD PEE.
Let PS2 : 0 <= S2 := Rmult_le_pos _ _ Pv (Rlt_le _ _ PEE).
Let Py1 : 0 < y1 := Rmult_lt_0_compat _ _ PC PEE.
Let Py2 : 0 <= y2 := Rmult_le_pos _ _ Pw (Rlt_le _ _ PEE).
Let S2_small : S2 <= S1 := Rmult_le_compat_r _ _ _ (Rlt_le _ _ PEE) v_small.

(** What det and T of the true ray are off by, and how great they are. *)
Lemma det_is_off' : Rabs (det found - det truth) <= 301 / 10 * (u * S1) + 401 / 100 * S2 /\ Rabs (det truth) <= 402 / 100 * (S1 + S2).
Proof.
  pose proof HE as HE'. rewrite (vsub_same _ _ F1 F0), (vsub_same _ _ F2 F0) in HE'.
  pose proof (det_moves 24 ltac:(lia) v0 v1 v2 o d o' d' v E Hd HE') as M. change (unit 24) with u in M. fold middle truth in M.
  pose proof (det_is_off v0 v1 v2 o d F0 F1 F2 Fo found Found D C E HD HC HE D_range C_least E_least) as A. fold middle S1 in A.
  pose proof (det_is_small v0 v1 v2 o d F0 F1 F2 D E HD HE D_range E_least) as B. fold middle S1 in B.
  replace (v * E * E) with S2 in M by (unfold S2; ring).
  split; [eapply Rle_trans; [exact (far_b _ _ _ _ _ A M)|]; lra|].
  replace (det truth) with (det middle - (det middle - det truth)) by ring. eapply Rle_trans; [exact (sub_b _ _ _ _ B M)|]. lra.
Qed.

Lemma t_is_off' : Rabs (top_t found - top_t truth) <= 342 / 10 * (u * y1) + 401 / 100 * y2 /\ Rabs (top_t truth) <= 402 / 100 * (y1 + y2).
Proof.
  pose proof HE as HE'. rewrite (vsub_same _ _ F1 F0), (vsub_same _ _ F2 F0) in HE'.
  pose proof (t_moves 24 ltac:(lia) v0 v1 v2 o d o' d' w E Ho HE') as M. change (unit 24) with u in M. fold middle truth in M.
  pose proof (t_is_off v0 v1 v2 o d F0 F1 F2 Fo found Found D C E HC HE D_range C_least E_least) as A. fold middle y1 in A.
  pose proof (t_is_small v0 v1 v2 o d F0 F1 F2 Fo C E HC HE C_least E_least) as B. fold middle y1 in B.
  replace (w * E * E) with y2 in M by (unfold y2; ring).
  split; [eapply Rle_trans; [exact (far_b _ _ _ _ _ A M)|]; lra|].
  replace (top_t truth) with (top_t middle - (top_t middle - top_t truth)) by ring. eapply Rle_trans; [exact (sub_b _ _ _ _ B M)|]. lra.
Qed.

(** A bound times the square of an edge, as evaluated. *)
Lemma square_low a b : bpow radix2 (-64) <= a -> a * (1 - 4 * u) <= b -> a * (E * E) * (1 - 8 * u) - eta <= R32 (b * R32 (E * E)).
Proof.
  intros Ha Hb. pose proof (bpow_gt_0 radix2 (-64)).
  assert (N : E * E * (1 - u) <= R32 (E * E)).
  { apply low_normal. eapply Rle_trans; [|exact (square_least E E_least)]. now apply bpow_le. }
  set (n := R32 (E * E)) in *. assert (Pn : 0 <= E * E * (1 - u)) by (apply Rmult_le_pos; lra).
  assert (Pa : 0 <= a * (1 - 4 * u)) by (apply Rmult_le_pos; lra).
  assert (M : a * (1 - 4 * u) * (E * E * (1 - u)) <= b * n) by (now apply Rmult_le_compat).
  pose proof (low_32 (b * n) ltac:(apply Rmult_le_pos; lra)) as L. set (X := a * (E * E)). assert (PX : 0 <= X) by (apply Rmult_le_pos; lra).
  replace (a * (1 - 4 * u) * (E * E * (1 - u))) with (X * ((1 - 4 * u) * (1 - u))) in M by (unfold X; ring). set (p := b * n) in *. lra.
Qed.

Lemma det_low : 40 * (1 - 8 * u) * (u * S1) + 9 / 2 * (1 - 8 * u) * S2 - eta <= R32 (det_within v D * R32 (E * E)).
Proof.
  pose proof (unit_low 40 ltac:(lra)) as T. pose proof (bound_sum 40 D v T Pv) as K. fold (det_within v D) in K.
  eapply Rle_trans; [|apply (square_low (40 * u * D + off * v)); [lra|exact K]]. right. unfold S1, S2. field.
Qed.

Lemma t_low : 44 * (1 - 8 * u) * (u * y1) + 9 / 2 * (1 - 8 * u) * y2 - eta <= R32 (t_within w C * R32 (E * E)).
Proof.
  assert (T : bpow radix2 (-64) <= 44 * u * C).
  { change (-64)%Z with (-24 + -40)%Z. rewrite bpow_plus. change (bpow radix2 (-24)) with u. fold least. apply Rmult_le_compat; lra. }
  pose proof (bound_sum 44 C w T Pw) as K. fold (t_within w C) in K.
  eapply Rle_trans; [|apply (square_low (44 * u * C + off * w)); [lra|exact K]]. right. unfold y1, y2. field.
Qed.

(** The comparison before its last roundings, which keep the order. *)
Lemma not_beyond_within neg best : sign_bit neg (det found) -> det truth <> 0 -> 0 <= top_t truth / det truth ->
  R32 (top_t truth / det truth) <= best ->
  front neg (top_t found) - R32 (t_within w C * R32 (E * E)) <= R32 (Rabs (det found) + R32 (det_within v D * R32 (E * E))) * best.
Proof.
  pose proof t_low as BT. pose proof det_low as BD. destruct (sizes D C E D_range C_least E_least) as (Z1 & Z2 & _ & _ & Z3). fold S1 y1 in Z1, Z2, Z3.
  destruct det_is_off' as [OD SD]. destruct t_is_off' as [OT ST].
  assert (Small : Rabs (det truth) * eta <= 9 * (eta * S1)).
  { replace (9 * (eta * S1)) with (9 * S1 * eta) by ring. apply Rmult_le_compat_r; lra. }
  assert (0 <= eta * S1) by (apply Rmult_le_pos; lra). set (g := 98 / 10 * (u * S1) + 48 / 100 * S2).
  assert (Ge : g * eta <= eta * S1) by (rewrite (Rmult_comm eta); apply Rmult_le_compat_r; unfold g; lra).
  apply bounds_decide with (dd := 301 / 10 * (u * S1) + 401 / 100 * S2) (dt := 342 / 10 * (u * y1) + 401 / 100 * y2) (g := g)
    (h := 97 / 10 * (u * y1) + 48 / 100 * y2); [exact OD|exact OT|unfold g; lra|lra|change (bpow radix2 24) with 16777216; unfold g; lra|unfold g; lra|lra].
Qed.

(** A triangle that the beyond filter rejects has no hit of the true ray at RN(t) <= best. [LANES-5] *)
Theorem beyond_within_is_right neg best : sign_bit neg (det found) -> is_beyond_within neg w v D C E best found ->
  ~ (det truth <> 0 /\ 0 <= top_t truth / det truth /\ R32 (top_t truth / det truth) <= best).
Proof.
  intros Sg B (Nz & Ht & Hb). pose proof (not_beyond_within neg best Sg Nz Ht Hb) as H. apply (Rlt_not_le _ _ B).
  apply round_le; [typeclasses eauto..|exact H].
Qed.
End Within.

(** As [enclosed] has it, for a usual ray in the middle: a lane that is not among the survivors has no hit of the true ray at
    RN(t) <= best. [LANES-5] *)
Theorem rejected_within_is_right v0 v1 v2 o d o' d' w v reach neg best : vformat v0 -> vformat v1 -> vformat v2 -> vformat o -> bounded reach v0 ->
  near w o o' -> near v d d' -> v <= greatest d -> bpow radix2 (-20) <= greatest d <= bpow radix2 20 ->
  let found := determinants_of R32 v0 v1 v2 o d in
  let truth := determinants_of exactly v0 v1 v2 o' d' in
  let C := way o reach in
  let E := longest v0 v1 v2 in
  sign_bit neg (det found) -> is_missed_within w v (greatest d) C E found \/ is_beyond_within neg w v (greatest d) C E best found ->
  ~ (meets truth /\ 0 <= top_t truth / det truth /\ R32 (top_t truth / det truth) <= best).
Proof.
  intros F0 F1 F2 Fo HR Ho Hd Hv HD found truth C E Sg Rj (M & Ht & Hb).
  destruct (longest_bounds v0 v1 v2) as (B1 & B2 & LE). fold E in B1, B2, LE.
  destruct (way_is_enough o v0 reach HR) as (BC & LC & FC). fold C in BC, LC, FC. pose proof (greatest_b d _ (Rle_refl _)) as BD.
  destruct Rj as [Rj|Rj].
  - revert M. eapply missed_within_is_right; eauto using evaluated_32.
  - eapply (beyond_within_is_right v0 v1 v2 o d o' d'); eauto using evaluated_32. split; [apply M|]. now split.
Qed.
