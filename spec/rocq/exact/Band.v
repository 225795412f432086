(** The triangle test of a device with single precision: [test_triangle] of gpu-check/wgsl/triangle_band.wgsl, with gradual underflow and
    without a greatest exponent. A fused multiply-add rounds once or twice, and a quotient is any float within 2.5 ulp: BAND-1. Fewer roundings
    cost no more, so edge functions are off as in Lanes.v. *)
Require Import Reals ZArith Lia Lra Psatz Bool.
From Flocq Require Import Core.
Require Import StacklessExact.Rounding StacklessExact.Triple StacklessExact.Filter StacklessExact.Floor StacklessExact.Lanes.
Open Scope R_scope.

Local Instance prec_24 : Prec_gt_0 24 := eq_refl.

(** * The operations *)

(** [fma]. *)
Definition is_fused (a b c found : R) : Prop := found = R32 (a * b + c) \/ found = R32 (R32 (a * b) + c).
(** [/]. *)
Definition is_quotient (x y q : R) : Prop := F q /\ Rabs (q - x / y) <= 5 / 2 * ulp radix2 fexp (x / y).

(** [cross3] and [product3]. *)
Definition is_cross (a b found : vec) : Prop :=
  is_fused (vy a) (vz b) (- R32 (vz a * vy b)) (vx found) /\ is_fused (vz a) (vx b) (- R32 (vx a * vz b)) (vy found) /\
  is_fused (vx a) (vy b) (- R32 (vy a * vx b)) (vz found).
Definition is_product (a b : vec) (found : R) : Prop :=
  exists rest, is_fused (vy a) (vy b) (R32 (vz a * vz b)) rest /\ is_fused (vx a) (vx b) rest found.

(** det, U, V, W and T. *)
Definition is_code (v0 v1 v2 o d : vec) (found : determinants) : Prop :=
  let e1 := vsub R32 v1 v0 in let e2 := vsub R32 v2 v0 in let s := vsub R32 o v0 in
  exists p q, is_cross d e2 p /\ is_cross s e1 q /\
  is_product e1 p (det found) /\ is_product s p (edge_u found) /\ is_product d q (edge_v found) /\ is_product e2 q (top_t found) /\
  edge_w found = R32 (R32 (det found - edge_u found) - edge_v found).

(** [delta] is that of Lanes.v. [det_off] and [t_off]; the products of the constants and the unit are exact. *)
Notation det_times := 32.
Notation t_times := 36.
Definition det_off_of (D E : R) : R := R32 (R32 (R32 (det_times * u * D) * E) * E).
Definition t_off_of (C E : R) : R := R32 (R32 (R32 (t_times * u * C) * E) * E).

(** [t_low] and [t_high]. FLOOR is the least of Lanes.v. *)
Definition low_end (first : R) : R := R32 (R32 (first - R32 (16 * u * Rabs first)) - least).
Definition high_end (last : R) : R := R32 (R32 (last + R32 (16 * u * Rabs last)) + least).

(** [first] and [last], by [above], [below] and the bounds; and [t_least]. *)
Definition is_first (above below t_off det_off first : R) : Prop :=
  let low := R32 (above - t_off) in is_quotient low (if Rlt_bool low 0 then R32 (below - det_off) else R32 (below + det_off)) first.
Definition is_last (above below t_off det_off last : R) : Prop :=
  let high := R32 (above + t_off) in is_quotient high (if Rlt_bool high 0 then R32 (below + det_off) else R32 (below - det_off)) last.
Definition nearest (above t_off first : R) : R := if Rle_bool 0 (R32 (above - t_off)) && Rlt_bool (low_end first) 0 then 0 else low_end first.

(** * Determinants *)

(** A fused multiply-add is a product that is rounded, and a sum. *)
Lemma fused_32 a b c found : F c -> is_fused a b c found -> F found /\ exists m e n, Rabs m <= u /\ Rabs e <= u /\ Rabs n <= eta * (1 + u) /\
  found = (a * b * (1 + m) + c) * (1 + e) + n.
Proof.
  intros Fc H. pose proof (bpow_gt_0 radix2 (-150)) as Pe. split; [destruct H as [-> | ->]; apply F_32|]. destruct H as [-> | ->].
  - destruct (product_32 (a * b + c)) as (e & n & He & Hn & ->). exists 0, e, n. rewrite Rabs_R0. repeat split; try lra; try assumption.
  - destruct (product_32 (a * b)) as (m & n & Hm & Hn & E1). destruct (plus_32 (R32 (a * b)) c (F_32 _) Fc) as (e & He & ->).
    exists m, e, (n * (1 + e)). rewrite E1. repeat (split; [assumption|]). split; [|ring].
    apply mul_b; [exact Hn|]. apply add_b; [rewrite Rabs_R1; lra|exact He].
Qed.

(** A component of a cross product. *)
Lemma component_is a b c d found : is_fused a b (- R32 (c * d)) found -> exists m n e p, Rabs m <= u /\ Rabs n <= u /\ Rabs e <= u /\
  Rabs p <= 2 * eta * (1 + u) /\ found = (a * b * (1 + m) - c * d * (1 + n)) * (1 + e) + p.
Proof.
  intros H. destruct (fused_32 _ _ _ _ (generic_format_opp _ _ _ (F_32 _)) H) as (_ & m & e & k & Hm & He & Hk & ->).
  destruct (product_32 (c * d)) as (n & q & Hn & Hq & ->). exists m, n, e, (k - q * (1 + e)). repeat (split; [assumption|]). split; [|ring].
  replace (2 * eta * (1 + u)) with (eta * (1 + u) + eta * (1 + u)) by ring. apply sub_b; [exact Hk|].
  apply mul_b; [exact Hq|]. apply add_b; [rewrite Rabs_R1; lra|exact He].
Qed.

(** The three products of a triple product are added in another order than in Triple.v, which is the same with y and z exchanged. *)
Lemma triple_is x y z p found : is_cross y z p -> is_product x p found -> is_triple found x y z.
Proof.
  destruct x as [x1 x2 x3], y as [y1 y2 y3], z as [z1 z2 z3], p as [p1' p2' p3']. intros (C1 & C2 & C3) (rest & R & P). cbn [vx vy vz] in *.
  destruct (fused_32 _ _ _ _ (F_32 _) R) as (Fr & e2 & s1 & k2 & E2 & S1 & K2 & ->). destruct (fused_32 _ _ _ _ Fr P) as (Ff & e1 & s2 & k1 & E1 & S2 & K1 & ->).
  split; [exact Ff|]. clear Fr Ff R P. intros X Y Z (A1 & A2 & A3) (H1 & H2 & H3) (G1 & G2 & G3). cbn [vx vy vz] in *.
  destruct (component_is _ _ _ _ _ C1) as (m1 & m2 & c1 & n1 & M1 & M2 & D1 & N1 & ->).
  destruct (component_is _ _ _ _ _ C2) as (m3 & m4 & c2 & n2 & M3 & M4 & D2 & N2 & ->).
  destruct (component_is _ _ _ _ _ C3) as (m5 & m6 & c3 & n3 & M5 & M6 & D3 & N3 & ->). clear C1 C2 C3.
  set (p1 := (y2 * z3 * (1 + m1) - y3 * z2 * (1 + m2)) * (1 + c1)). set (p2 := (y3 * z1 * (1 + m3) - y1 * z3 * (1 + m4)) * (1 + c2)).
  set (p3 := (y1 * z2 * (1 + m5) - y2 * z1 * (1 + m6)) * (1 + c3)).
  destruct (product_32 (x3 * (p3 + n3))) as (e3 & k3 & E3 & K3 & ->).
  exists (((x3 * p3 * (1 + e3) + x2 * p2 * (1 + e2)) * (1 + s1) + x1 * p1 * (1 + e1)) * (1 + s2)),
    (((x3 * n3 * (1 + e3) + k3 + x2 * n2 * (1 + e2)) * (1 + s1) + k2 + x1 * n1 * (1 + e1)) * (1 + s2) + k1).
  split; [ring|]. split.
  - replace (det3 x1 x2 x3 y1 y2 y3 z1 z2 z3) with (det3 x3 x2 x1 z3 z2 z1 y3 y2 y1) by (unfold det3; ring). replace (X * Y * Z) with (X * Z * Y) by ring.
    unfold p1, p2, p3. rewrite (Rmult_comm y2 z3), (Rmult_comm y3 z2), (Rmult_comm y3 z1), (Rmult_comm y1 z3), (Rmult_comm y1 z2), (Rmult_comm y2 z1).
    apply (triple u ltac:(lra) x3 x2 x1 z3 z2 z1 y3 y2 y1 X Z Y m5 m6 m3 m4 m1 m2 c3 c2 c1 e3 e2 e1 s1 s2); assumption.
  - pose proof (pos_b _ _ A1) as PX. pose proof (bpow_gt_0 radix2 (-150)) as PE.
    assert (One : forall e, Rabs e <= u -> Rabs (1 + e) <= 1 + u) by (intros e He; apply add_b; [rewrite Rabs_R1; lra|exact He]).
    assert (T : forall w n e, Rabs w <= X -> Rabs n <= 2 * eta * (1 + u) -> Rabs e <= u -> Rabs (w * n * (1 + e)) <= X * (2 * eta * (1 + u)) * (1 + u)).
    { intros w n e Hw Hn He. apply mul_b; [now apply mul_b|now apply One]. }
    set (B := X * (2 * eta * (1 + u)) * (1 + u)) in *.
    assert (EB : B = 2 * ((1 + u) * (1 + u)) * (X * eta)) by (unfold B; ring).
    apply Rle_trans with ((((B + eta + B) * (1 + u) + eta * (1 + u)) + B) * (1 + u) + eta * (1 + u)).
    + apply add_b; [|exact K1]. apply mul_b; [|now apply One]. apply add_b; [|now apply T]. apply add_b; [|exact K2].
      apply mul_b; [|now apply One]. apply add_b; [|now apply T]. apply add_b; [now apply T|exact K3].
    + rewrite EB. replace ((6 * X + 3) * (tenth * eta)) with (606 / 100 * (X * eta) + 303 / 100 * eta) by field.
      assert (0 <= X * eta) by (apply Rmult_le_pos; lra). set (xe := X * eta) in *. clearbody xe. lra.
Qed.

(** So what the device computes is what Floor.v and Lanes.v are about. [BAND-2] *)
Theorem device_evaluates v0 v1 v2 o d found : is_code v0 v1 v2 o d found -> evaluated v0 v1 v2 o d found.
Proof.
  intros (p & q & P & Q & D & U & V & T & W). split; [exact (triple_is _ _ _ _ _ P D)|]. split; [exact (triple_is _ _ _ _ _ P U)|].
  split; [exact (triple_is _ _ _ _ _ Q V)|]. split; [exact (triple_is _ _ _ _ _ Q T)|exact W].
Qed.

(** * Edge functions, and the bounds of det and T *)

Section Bounds.
Variables v0 v1 v2 o d : vec.
Hypothesis F0 : vformat v0.
Hypothesis F1 : vformat v1.
Hypothesis F2 : vformat v2.
Hypothesis Fo : vformat o.
Variable found : determinants.
Hypothesis Code : is_code v0 v1 v2 o d found.
Let truth := determinants_of exactly v0 v1 v2 o d.

(** The sizes: [size], [reach] and [edge]. *)
Variables D C E : R.
Hypothesis HD : bounded D d.
Hypothesis HC : bounded C (vsub R32 o v0).
Hypothesis HE : bounded E (vsub R32 v1 v0) /\ bounded E (vsub R32 v2 v0).
Hypothesis D_range : bpow radix2 (-20) <= D <= bpow radix2 20.
Hypothesis C_least : least <= C.
Hypothesis E_least : least <= E.

(** One edge function below -delta and another above delta: the triangle is missed. [BAND-2] *)
Theorem certain_miss : F C -> is_missed D C E found -> ~ meets truth.
Proof. apply missed_is_right; auto using device_evaluates. Qed.

(** All above delta, or all below -delta: the line meets the triangle. [BAND-2] *)
Theorem certain_hit : F C -> let delta := delta_of D C E in
  delta < Rmin (Rmin (edge_u found) (edge_v found)) (edge_w found) \/ Rmax (Rmax (edge_u found) (edge_v found)) (edge_w found) < - delta -> meets truth.
Proof.
  intros FC delta H.
  destruct (floor_is_enough v0 v1 v2 o d F0 F1 F2 Fo found (device_evaluates _ _ _ _ _ _ Code) D C E E HD HC HE (proj1 D_range)
    (sizes_are_floored D E D_range E_least)) as (U & V & W).
  assert (Same : Floor.delta D C E = delta) by (unfold delta, delta_of; now rewrite (twice C C_least FC)).
  rewrite Same in U, V, W.
  apply (hit_is_certain (if Rlt_bool delta (edge_u found) then false else true) _ _ _ _ _ _ _ delta U V W); [reflexivity|..].
  all: assert (P : 0 <= delta) by (eapply Rle_trans; [apply Rabs_pos|exact U]).
  all: revert H; unfold Rmin, Rmax; repeat destruct (Rle_dec _ _); intros; destruct (Rlt_bool_spec delta (edge_u found)); unfold front, Triple.front; lra.
Qed.

(** The bounds as evaluated. That of T may underflow. *)
Lemma bound_low c X : 1 <= c <= 64 -> bpow radix2 (-40) <= X -> c * (1 - 4 * u) * (u * (X * (E * E))) - eta <= R32 (R32 (R32 (c * u * X) * E) * E).
Proof.
  intros Hc HX. pose proof (bpow_gt_0 radix2 (-40)) as P40. assert (PE : 0 < E) by (unfold least in E_least; lra).
  assert (L1 : c * u * X * (1 - u) <= R32 (c * u * X)).
  { apply low_normal. apply Rle_trans with (bpow radix2 (-24 + -40)); [now apply bpow_le|]. rewrite bpow_plus.
    change (bpow radix2 (-24)) with u. apply Rmult_le_compat; lra. }
  assert (L1' : bpow radix2 (-65) <= R32 (c * u * X)).
  { eapply Rle_trans; [|exact L1]. apply Rle_trans with (bpow radix2 (-1 + -24 + -40)); [now apply bpow_le|]. rewrite !bpow_plus.
    change (bpow radix2 (-1)) with (/ 2). change (bpow radix2 (-24)) with u.
    assert (1 * X <= c * X) by (apply Rmult_le_compat_r; lra). replace (c * u * X * (1 - u)) with ((1 - u) * u * (c * X)) by ring. lra. }
  set (r := R32 (c * u * X)) in *. pose proof (bpow_gt_0 radix2 (-65)) as P65.
  assert (L2 : r * E * (1 - u) <= R32 (r * E)).
  { apply low_normal. apply Rle_trans with (bpow radix2 (-65 + -40)); [now apply bpow_le|]. rewrite bpow_plus. apply Rmult_le_compat; try lra. exact E_least. }
  set (q := R32 (r * E)) in *. assert (Pq : 0 <= q) by (eapply Rle_trans; [|exact L2]; apply Rmult_le_pos; [apply Rmult_le_pos|]; lra).
  eapply Rle_trans; [|apply low_32, Rmult_le_pos; lra].
  assert (L3 : c * u * X * (1 - u) * E * (1 - u) * E <= q * E).
  { apply Rmult_le_compat_r; [lra|]. eapply Rle_trans; [|exact L2]. apply Rmult_le_compat_r; [lra|]. apply Rmult_le_compat_r; [lra|exact L1]. }
  set (Z := c * (X * (E * E))). assert (PZ : 0 <= Z) by (unfold Z; repeat apply Rmult_le_pos; lra).
  replace (c * u * X * (1 - u) * E * (1 - u) * E) with (u * (1 - u) * (1 - u) * Z) in L3 by (unfold Z; ring).
  replace (c * (1 - 4 * u) * (u * (X * (E * E)))) with (u * (1 - 4 * u) * Z) by (unfold Z; ring). set (p := q * E) in *. clearbody p Z.
  assert (u * (1 - u) * (1 - u) * Z * (1 - u) <= p * (1 - u)) by (apply Rmult_le_compat_r; lra). lra.
Qed.

(** They are at least what det and T are off by, underflow included. [BAND-3] *)
Theorem bounds_are_enough : Rabs (det found - det truth) <= det_off_of D E /\ Rabs (top_t found - top_t truth) <= t_off_of C E.
Proof.
  pose proof (device_evaluates _ _ _ _ _ _ Code) as Ev.
  pose proof (det_is_off v0 v1 v2 o d F0 F1 F2 Fo found Ev D C E HD HC HE D_range C_least E_least) as OD.
  pose proof (t_is_off v0 v1 v2 o d F0 F1 F2 Fo found Ev D C E HC HE D_range C_least E_least) as OT.
  destruct (sizes D C E D_range C_least E_least) as (Z1 & Z2 & _). fold truth in OD, OT. split.
  - eapply Rle_trans; [exact OD|]. eapply Rle_trans; [|apply bound_low; [lra|]].
    + set (S := u * (D * (E * E))) in *. clearbody S. pose proof (bpow_gt_0 radix2 (-150)). lra.
    + eapply Rle_trans; [|apply D_range]. now apply bpow_le.
  - eapply Rle_trans; [exact OT|]. eapply Rle_trans; [|apply bound_low; [lra|exact C_least]].
    set (y := u * (C * (E * E))) in *. clearbody y. pose proof (bpow_gt_0 radix2 (-150)). lra.
Qed.
End Bounds.

(** * What a quotient costs *)

Lemma least_is : least = 1298074214633706907132624082305024 * eta.
Proof. change 1298074214633706907132624082305024 with (bpow radix2 110). unfold least. rewrite <- bpow_plus. reflexivity. Qed.

Lemma sub_off a b : F a -> F b -> Rabs (R32 (a - b) - (a - b)) <= u * Rabs (a - b).
Proof.
  intros A B. destruct (less_32 a b A B) as (e & He & ->). replace ((a - b) * (1 + e) - (a - b)) with (e * (a - b)) by ring.
  rewrite Rabs_mult. apply Rmult_le_compat_r; [apply Rabs_pos|exact He].
Qed.

Lemma quotient_off x y q : is_quotient x y q -> Rabs (q - x / y) <= 5 * u * Rabs (x / y) + 5 * eta.
Proof.
  intros [_ Q]. eapply Rle_trans; [exact Q|]. pose proof (bpow_gt_0 radix2 (-150)) as Pe. pose proof (Rabs_pos (x / y)) as Px.
  destruct (Rlt_or_le (Rabs (x / y)) (bpow radix2 (-149 + 24))) as [L|L].
  - rewrite (ulp_FLT_small radix2 (-149) 24) by exact L. change (-149)%Z with (1 + -150)%Z. rewrite bpow_plus. change (bpow radix2 1) with 2. lra.
  - assert (U : ulp radix2 fexp (x / y) <= Rabs (x / y) * bpow radix2 (1 - 24)).
    { apply ulp_FLT_le. eapply Rle_trans; [|exact L]. now apply bpow_le. }
    change (1 - 24)%Z with (1 + -24)%Z in U. rewrite bpow_plus in U. change (bpow radix2 1) with 2 in U. change (bpow radix2 (-24)) with u in U. lra.
Qed.

(** Numerator and denominator are rounded, and then the quotient. *)
Lemma first_off A B num den first : 0 < B -> Rabs (num - A) <= u * Rabs A -> Rabs (den - B) <= u * B -> is_quotient num den first ->
  Rabs (first - A / B) <= 702 / 100 * u * Rabs (A / B) + 5 * eta.
Proof.
  intros PB HA HB Q. pose proof (quotient_off _ _ _ Q) as O. apply Rabs_le_inv in HB. assert (Pd : 0 < den) by lra.
  assert (R : Rabs (num / den - A / B) <= 201 / 100 * u * Rabs (A / B)).
  { replace (num / den - A / B) with ((num - A - A / B * (den - B)) * / den) by (field; lra).
    rewrite Rabs_mult, (Rabs_pos_eq (/ den)) by (apply Rlt_le, Rinv_0_lt_compat, Pd).
    apply Rmult_le_reg_r with den; [exact Pd|]. rewrite Rmult_assoc, Rinv_l, Rmult_1_r by lra.
    assert (EA : Rabs A = Rabs (A / B) * B).
    { rewrite <- (Rabs_pos_eq B) at 2 by lra. rewrite <- Rabs_mult. f_equal. field. lra. }
    assert (D : Rabs (den - B) <= u * B) by (apply Rabs_le; lra).
    eapply Rle_trans; [apply sub_b; [exact HA|apply mul_b; [apply Rle_refl|exact D]]|]. rewrite EA.
    pose proof (Rabs_pos (A / B)) as P. set (x := Rabs (A / B)) in *. replace (u * (x * B) + x * (u * B)) with (x * (2 * u * B)) by ring.
    replace (201 / 100 * u * x * den) with (x * (201 / 100 * u * den)) by ring. apply Rmult_le_compat_l; lra. }
  replace (first - A / B) with ((first - num / den) + (num / den - A / B)) by ring. eapply Rle_trans; [apply add_b; [exact O|exact R]|].
  pose proof (Rabs_triang_inv (num / den) (A / B)) as T. pose proof (Rabs_pos (A / B)) as P. lra.
Qed.

(** The margin is more than all of it. *)
Lemma end_is_below A B num den first t : 0 < B -> Rabs (num - A) <= u * Rabs A -> Rabs (den - B) <= u * B -> is_quotient num den first ->
  A / B <= t -> low_end first < t.
Proof.
  intros PB HA HB Q T. pose proof (first_off _ _ _ _ _ PB HA HB Q) as O. destruct Q as [Ff _]. apply Rlt_le_trans with (2 := T). clear T.
  pose proof least_is as Fl. pose proof (bpow_gt_0 radix2 (-150)) as Pe. set (x := A / B) in *. clearbody x. clear - O Ff Fl Pe.
  unfold low_end. destruct (product_32 (16 * u * Rabs first)) as (e & n & He & Hn & Em).
  set (m := R32 (16 * u * Rabs first)) in *. assert (Fm : F m) by apply F_32.
  pose proof (sub_off first m Ff Fm) as O1. set (s := R32 (first - m)) in *. pose proof (sub_off s least (F_32 _) least_F) as O2.
  pose proof (Rabs_pos first) as Pf. pose proof (Rabs_pos x) as Px. set (f := least) in *. clearbody f.
  apply Rabs_le_inv in He, Hn.
  assert (M : 15 * u * Rabs first - eta <= m <= 17 * u * Rabs first + eta).
  { rewrite Em. assert (- (u * Rabs first) <= Rabs first * e <= u * Rabs first).
    { split; [rewrite <- Ropp_mult_distr_l_reverse, (Rmult_comm (- u))|rewrite (Rmult_comm u)]; apply Rmult_le_compat_l; lra. }
    replace (16 * u * Rabs first * (1 + e) + n) with (16 * u * Rabs first + 16 * u * (Rabs first * e) + n) by ring. lra. }
  set (y := R32 (s - f)) in *. clearbody m s y. clear Em Fm He Hn.
  apply Rabs_le_inv in O, O1, O2. revert O O1 O2 M Pf Px. unfold Rabs. repeat destruct (Rcase_abs _); intros; lra.
Qed.

(** The other end is that of the mirror image. *)
Lemma high_is_low last : high_end last = - low_end (- last).
Proof.
  unfold high_end, low_end. rewrite Rabs_Ropp. set (m := R32 (16 * u * Rabs last)). replace (- last - m) with (- (last + m)) by ring.
  rewrite round_NE_opp. replace (- R32 (last + m) - least) with (- (R32 (last + m) + least)) by ring. rewrite round_NE_opp. ring.
Qed.

Lemma quotient_opp x y q : is_quotient x y q -> is_quotient (- x) y (- q).
Proof.
  intros [G Q]. split; [now apply generic_format_opp|]. replace (- x / y) with (- (x / y)) by (unfold Rdiv; ring). rewrite ulp_opp.
  replace (- q - - (x / y)) with (- (q - x / y)) by ring. now rewrite Rabs_Ropp.
Qed.

(** A sum of two floats has the sign of what is rounded. *)
Lemma sign_kept a b : F a -> F b -> (R32 (a - b) < 0 -> a - b < 0) /\ (0 <= R32 (a - b) -> 0 <= a - b).
Proof.
  intros A B. pose proof (sub_off a b A B) as O. split; intros H; apply Rnot_le_lt || apply Rnot_lt_le; intros K.
  - rewrite (Rabs_pos_eq (a - b)) in O by exact K. apply Rabs_le_inv in O. lra.
  - rewrite (Rabs_left (a - b)) in O by exact K. apply Rabs_le_inv in O. lra.
Qed.

(** Divided by the denominator on the safe side. *)
Lemma below_quotient A B a b : 0 < B -> 0 < b -> A <= a -> (A < 0 -> B <= b) -> (0 < A -> b <= B) -> A / B <= a / b.
Proof.
  intros PB Pb HA Neg Pos. apply Rmult_le_reg_r with (B * b); [now apply Rmult_lt_0_compat|].
  replace (A / B * (B * b)) with (A * b) by (field; lra). replace (a / b * (B * b)) with (a * B) by (field; lra).
  apply Rle_trans with (A * B); [|apply Rmult_le_compat_r; lra]. destruct (Rtotal_order A 0) as [N|[->|N]]; [specialize (Neg N)|lra|specialize (Pos N)]; nra.
Qed.

(** * A hit *)

Section Hit.
(** T and det, as computed and truly, with the sign of det taken into both; and the bounds of what they are off by (BAND-3). *)
Variables above below t_off det_off top bottom : R.
Hypothesis F_above : F above.
Hypothesis F_below : F below.
Hypothesis F_t_off : F t_off.
Hypothesis F_det_off : F det_off.
Hypothesis top_is : Rabs (above - top) <= t_off.
Hypothesis bottom_is : Rabs (below - bottom) <= det_off.
(** The code asks for twice as much. *)
Hypothesis certain : det_off < below.
Let t := top / bottom.

(** The code. *)
Let low := R32 (above - t_off).
Let high := R32 (above + t_off).
Let less := R32 (below - det_off).
Let more := R32 (below + det_off).
Variables first last : R.
Hypothesis first_is : is_first above below t_off det_off first.
Hypothesis last_is : is_last above below t_off det_off last.
Let t_least := nearest above t_off first.

Lemma det_off_pos : 0 <= det_off.
Proof. eapply Rle_trans; [apply Rabs_pos|exact bottom_is]. Qed.
Lemma bottom_pos : 0 < bottom.
Proof. pose proof det_off_pos. apply Rabs_le_inv in bottom_is. lra. Qed.
Lemma denominators : Rabs (less - (below - det_off)) <= u * (below - det_off) /\ Rabs (more - (below + det_off)) <= u * (below + det_off) /\
  0 < below - det_off <= bottom /\ bottom <= below + det_off.
Proof.
  pose proof det_off_pos. apply Rabs_le_inv in bottom_is as B. split; [|split; [|lra]].
  - rewrite <- (Rabs_pos_eq (below - det_off)) at 2 by lra. now apply sub_off.
  - rewrite <- (Rabs_pos_eq (below + det_off)) at 2 by lra. replace (below + det_off) with (below - - det_off) by ring. unfold more.
    replace (below + det_off) with (below - - det_off) by ring. apply sub_off; [assumption|now apply generic_format_opp].
Qed.

(** [t_low] is below the distance. [BAND-4] *)
Theorem low_end_is_below : low_end first < t.
Proof.
  destruct denominators as (L & M & (PL & LL) & LM). pose proof (sub_off _ _ F_above F_t_off) as O. fold low in O.
  destruct (sign_kept _ _ F_above F_t_off) as [Neg Pos].
  fold low in Neg, Pos. pose proof bottom_pos. pose proof first_is as Q. unfold is_first in Q. cbv zeta in Q. fold low less more in Q.
  apply Rabs_le_inv in top_is as HT. unfold t.
  destruct (Rlt_bool_spec low 0) as [S|S].
  - apply (end_is_below (above - t_off) (below - det_off) low less); try assumption. specialize (Neg S). apply below_quotient; intros; lra.
  - apply (end_is_below (above - t_off) (below + det_off) low more); try assumption; [lra|]. specialize (Pos S). apply below_quotient; intros; lra.
Qed.

Lemma mirror : R32 (- above - t_off) = - high.
Proof. replace (- above - t_off) with (- (above + t_off)) by ring. apply round_NE_opp. Qed.

(** [t_high] is above it. [BAND-4] *)
Theorem high_end_is_above : t < high_end last.
Proof.
  destruct denominators as (L & M & (PL & LL) & LM). pose proof bottom_pos as P.
  pose proof (quotient_opp _ _ _ last_is) as Q. fold high less more in Q. rewrite high_is_low.
  enough (low_end (- last) < - top / bottom) by (unfold t; unfold Rdiv in *; lra).
  pose proof (sub_off _ _ (generic_format_opp _ _ _ F_above) F_t_off) as O. destruct (sign_kept _ _ (generic_format_opp _ _ _ F_above) F_t_off) as [Neg Pos].
  rewrite mirror in *.
  apply Rabs_le_inv in top_is as HT. destruct (Rlt_bool_spec high 0) as [S|S].
  - apply (end_is_below (- above - t_off) (below + det_off) (- high) more); try assumption; [lra|].
    assert (0 <= - above - t_off) by (apply Pos; lra). apply below_quotient; intros; lra.
  - apply (end_is_below (- above - t_off) (below - det_off) (- high) less); try assumption.
    assert (~ 0 < - above - t_off) by (intros K; rewrite (Rabs_pos_eq _ (Rlt_le _ _ K)) in O; apply Rabs_le_inv in O; lra).
    apply below_quotient; intros; lra.
Qed.

(** [t_least] is not above it. [BAND-4] *)
Theorem nearest_is_not_above : t_least <= t.
Proof.
  pose proof low_end_is_below as L. unfold t_least, nearest. fold low. destruct (Rle_bool_spec 0 low) as [S|S]; [|cbn [andb]; lra].
  destruct (Rlt_bool_spec (low_end first) 0); cbn [andb]; [|lra]. apply (proj2 (sign_kept _ _ F_above F_t_off)) in S. apply Rabs_le_inv in top_is as HT.
  apply Rmult_le_pos; [lra|]. apply Rlt_le, Rinv_0_lt_compat, bottom_pos.
Qed.

(** The ends are floats, so the rounded distance is between them too. [BAND-4] *)
Theorem rounded_is_between : t_least <= R32 t <= high_end last.
Proof.
  pose proof high_end_is_above. pose proof nearest_is_not_above. assert (FL : F t_least).
  { unfold t_least, nearest. destruct (_ && _); [apply generic_format_0|apply F_32]. }
  split; [rewrite <- (round_generic radix2 fexp ZnearestE t_least FL)|rewrite <- (round_generic radix2 fexp ZnearestE (high_end last)) by apply F_32];
    apply round_le; (typeclasses eauto || lra).
Qed.
End Hit.

(** From the corners to the ends: the distance, where the determinant is certain, is between them, and so is it rounded. [BAND-4] *)
Theorem hit_is_between v0 v1 v2 o d found D C E first last : vformat v0 -> vformat v1 -> vformat v2 -> vformat o -> is_code v0 v1 v2 o d found ->
  bounded D d -> bounded C (vsub R32 o v0) -> bounded E (vsub R32 v1 v0) /\ bounded E (vsub R32 v2 v0) ->
  bpow radix2 (-20) <= D <= bpow radix2 20 -> least <= C -> least <= E ->
  let truth := determinants_of exactly v0 v1 v2 o d in
  let neg := Rlt_bool (det found) 0 in
  let above := front neg (top_t found) in
  let below := front neg (det found) in
  let t := top_t truth / det truth in
  det_off_of D E < below -> is_first above below (t_off_of C E) (det_off_of D E) first -> is_last above below (t_off_of C E) (det_off_of D E) last ->
  nearest above (t_off_of C E) first <= t < high_end last /\ nearest above (t_off_of C E) first <= R32 t <= high_end last.
Proof.
  intros F0 F1 F2 Fo Code HD HC HE D_range LC LE truth neg above below t Certain First Last.
  destruct (bounds_are_enough v0 v1 v2 o d F0 F1 F2 Fo found Code D C E HD HC HE D_range LC LE) as [OD OT].
  destruct (device_evaluates _ _ _ _ _ _ Code) as ((Fd & _) & _ & _ & (Ft & _) & _).
  assert (Front : forall x, F x -> F (front neg x)) by (intros x Fx; unfold front, Triple.front; destruct neg; [now apply generic_format_opp|exact Fx]).
  assert (Off : forall x y b, Rabs (x - y) <= b -> Rabs (front neg x - front neg y) <= b).
  { intros x y b H. unfold front, Triple.front. destruct neg; [|exact H]. replace (- x - - y) with (- (x - y)) by ring. now rewrite Rabs_Ropp. }
  apply Off in OD, OT. apply Front in Fd, Ft. fold truth above below in OD, OT, Fd, Ft.
  assert (T : t = front neg (top_t truth) / front neg (det truth)).
  { pose proof (bottom_pos below (det_off_of D E) _ OD Certain) as P. unfold t, front, Triple.front in *. destruct neg; [field; lra|reflexivity]. }
  pose proof (F_32 _ : F (t_off_of C E)) as FT. pose proof (F_32 _ : F (det_off_of D E)) as FD. rewrite T. split; [split|].
  - exact (nearest_is_not_above above below _ _ _ _ Ft Fd FT FD OT OD Certain first First).
  - exact (high_end_is_above above below _ _ _ _ Ft Fd FT FD OT OD Certain last Last).
  - exact (rounded_is_between above below _ _ _ _ Ft Fd FT FD OT OD Certain first last First Last).
Qed.
