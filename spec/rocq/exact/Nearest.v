(** The nearest point of a triangle, in real numbers: the seven certificates of NEAR-3, by which src/geom/nearest/point.rs finds it. *)
Require Import Reals Lra Psatz.
Require Import StacklessExact.Filter.
Open Scope R_scope.

(** A point of the triangle is a + v b + w c, for the edges b and c from the corner a. *)
Definition inside (v w : R) : Prop := 0 <= v /\ 0 <= w /\ v + w <= 1.

Notation dot := (dot exactly).
Notation sub := (vsub exactly).
Definition at_ (a b c : vec) (v w : R) : vec := Vec (vx a + v * vx b + w * vx c) (vy a + v * vy b + w * vy c) (vz a + v * vz b + w * vz c).
Definition square (p x : vec) : R := dot (sub p x) (sub p x).

(** Beyond an edge, and before its first corner. *)
Lemma before_corner bb bc cc d1 d2 : 0 < bb * cc - bc * bc -> 0 < bb -> bb * d2 - bc * d1 < 0 -> d1 < 0 -> 0 < d2 ->
  cc * d1 - bc * d2 <= 0 /\ (cc < d2 -> d1 <= bc).
Proof.
  intros N Pb C D1 D2. assert (Q : 0 < bb * d2) by (now apply Rmult_lt_0_compat).
  assert (Bc : bc < 0). { apply Rnot_le_lt. intros H. assert (0 <= bc * - d1) by (apply Rmult_le_pos; lra). lra. }
  split.
  - apply Rmult_le_reg_l with bb; [exact Pb|]. assert (0 <= - bc * (bc * d1 - bb * d2)) by (apply Rmult_le_pos; lra).
    assert (0 <= (bb * cc - bc * bc) * - d1) by (apply Rmult_le_pos; lra). lra.
  - intros H. apply Rnot_lt_le. intros L. assert (bb * cc < bb * d2) by (now apply Rmult_lt_compat_l). assert (0 <= - bc * (d1 - bc)) by (apply Rmult_le_pos; lra). lra.
Qed.

(** Beyond an edge: one of the other six certificates. *)
Lemma beyond_edge bb bc cc d1 d2 : 0 < bb * cc - bc * bc -> 0 < bb -> bb * d2 - bc * d1 < 0 ->
  (d1 <= 0 /\ d2 <= 0) \/ (bb <= d1 /\ d2 - bc <= d1 - bb) \/ (0 <= d1 <= bb) \/ (cc * d1 - bc * d2 <= 0 /\ 0 <= d2 <= cc) \/
  (bb * cc - bc * bc - (cc * d1 - bc * d2) - (bb * d2 - bc * d1) <= 0 /\ d1 - bb <= d2 - bc /\ d2 - cc <= d1 - bc) \/ (cc <= d2 /\ d1 - bc <= d2 - cc).
Proof.
  intros N Pb C. destruct (Rlt_or_le d1 0) as [D|D]; [|destruct (Rlt_or_le bb d1) as [D'|D']; [|tauto]].
  - destruct (Rlt_or_le 0 d2) as [D2|D2]; [|left; lra]. destruct (before_corner bb bc cc d1 d2 N Pb C D D2) as [B L].
    destruct (Rlt_or_le cc d2) as [G|G]; [specialize (L G); right; right; right; right; right; lra|right; right; right; left; lra].
  - destruct (Rlt_or_le (d1 - bb) (d2 - bc)) as [D2|D2]; [|right; left; lra].
    (* The same from the other corner of the edge. *)
    assert (BL := before_corner bb (bb - bc) (bb - 2 * bc + cc) (bb - d1) (d2 - bc - (d1 - bb)) ltac:(lra) Pb ltac:(lra) ltac:(lra) ltac:(lra)). destruct BL as [B L].
    destruct (Rlt_or_le (bb - 2 * bc + cc) (d2 - bc - (d1 - bb))) as [G|G]; [specialize (L G); right; right; right; right; right; lra|].
    right; right; right; right; left. repeat split; lra.
Qed.

Section Nearest.
(** The products of the edges with each other, and with s = p - a. *)
Variables bb bc cc d1 d2 ss : R.
Hypothesis area : 0 < bb * cc - bc * bc.
Hypothesis positive : 0 < bb /\ 0 < cc.

Definition length (v w : R) : R := v * v * bb + 2 * (v * w * bc) + w * w * cc.
Definition distance (v w : R) : R := ss - 2 * (v * d1 + w * d2) + length v w.

(** What is left of s across b and across c, and how far it points to the point itself. *)
Definition along_b (v w : R) : R := d1 - v * bb - w * bc.
Definition along_c (v w : R) : R := d2 - v * bc - w * cc.
Definition along (v w : R) : R := v * along_b v w + w * along_c v w.

Definition is_nearest (v w : R) : Prop := inside v w /\ forall v' w', inside v' w' -> distance v w <= distance v' w'.

Lemma length_positive v w : 0 <= length v w /\ (length v w <= 0 -> v = 0 /\ w = 0).
Proof.
  unfold length. assert (E : bb * (v * v * bb + 2 * (v * w * bc) + w * w * cc) = (v * bb + w * bc) * (v * bb + w * bc) + w * w * (bb * cc - bc * bc)) by ring.
  assert (S1 : 0 <= (v * bb + w * bc) * (v * bb + w * bc)) by apply Rle_0_sqr. assert (S2 : 0 <= w * w) by apply Rle_0_sqr.
  assert (S3 : 0 <= w * w * (bb * cc - bc * bc)) by (apply Rmult_le_pos; lra). destruct positive as [Pb _]. split.
  - apply Rmult_le_reg_l with bb; [exact Pb|]. lra.
  - intros H. assert (bb * (v * v * bb + 2 * (v * w * bc) + w * w * cc) <= bb * 0) by (apply Rmult_le_compat_l; lra).
    assert (W : w * w * (bb * cc - bc * bc) = 0) by lra. apply Rmult_integral in W as [W|W]; [|lra]. assert (w = 0) as -> by (apply Rsqr_0_uniq; exact W).
    split; [|reflexivity]. assert (V : (v * bb) * (v * bb) = 0) by (replace (v * bb) with (v * bb + 0 * bc) by ring; lra). apply Rsqr_0_uniq in V. apply Rmult_integral in V as [V|V]; [exact V|lra].
Qed.

Lemma distance_from v w v' w' : distance v' w' = distance v w - 2 * ((v' - v) * along_b v w + (w' - w) * along_c v w) + length (v' - v) (w' - w).
Proof. unfold distance, along_b, along_c, length. ring. Qed.

(** A triangle is convex: a point of it is nearest if and only if s does not point from it to a corner. [NEAR-3] *)
Theorem nearest_iff v w : inside v w -> (is_nearest v w <-> 0 <= along v w /\ along_b v w <= along v w /\ along_c v w <= along v w).
Proof.
  intros I. pose proof I as (Hv & Hw & Hs). split.
  - intros [_ N].
    (* Toward a corner, a little way. *)
    assert (Toward : forall i j, inside i j -> (i - v) * along_b v w + (j - w) * along_c v w <= 0).
    { intros i j (Hi & Hj & Hij). set (g := (i - v) * along_b v w + (j - w) * along_c v w). apply Rnot_lt_le. intros G.
      destruct (length_positive (i - v) (j - w)) as [L _]. set (q := length (i - v) (j - w)) in *. set (e := g / (g + q)).
      assert (P : 0 < g + q) by lra. assert (E : e * (g + q) = g) by (unfold e; field; lra).
      assert (E0 : 0 < e) by (unfold e; apply Rdiv_lt_0_compat; lra).
      assert (E1 : e <= 1) by (apply Rmult_le_reg_r with (g + q); lra).
      assert (In : inside (v + e * (i - v)) (w + e * (j - w))).
      { assert (0 <= e * i) by (apply Rmult_le_pos; lra). assert (0 <= e * j) by (apply Rmult_le_pos; lra). assert (0 <= (1 - e) * v) by (apply Rmult_le_pos; lra).
        assert (0 <= (1 - e) * w) by (apply Rmult_le_pos; lra). assert (e * (i + j) <= e * 1) by (apply Rmult_le_compat_l; lra).
        assert ((1 - e) * (v + w) <= (1 - e) * 1) by (apply Rmult_le_compat_l; lra). unfold inside. lra. }
      pose proof (N _ _ In) as M. rewrite (distance_from v w (v + e * (i - v)) (w + e * (j - w))) in M.
      replace (v + e * (i - v) - v) with (e * (i - v)) in M by ring. replace (w + e * (j - w) - w) with (e * (j - w)) in M by ring.
      replace (e * (i - v) * along_b v w + e * (j - w) * along_c v w) with (e * g) in M by (unfold g; ring).
      replace (length (e * (i - v)) (e * (j - w))) with (e * (e * q)) in M by (unfold q, length; ring).
      assert (e * q <= g) by (assert (0 <= e * g) by (apply Rmult_le_pos; lra); lra).
      assert (e * (e * q) <= e * g) by (apply Rmult_le_compat_l; lra). assert (0 < e * g) by (now apply Rmult_lt_0_compat). lra. }
    assert (Ins : inside 0 0 /\ inside 1 0 /\ inside 0 1) by (unfold inside; repeat split; lra). destruct Ins as (I0 & I1 & I2).
    apply Toward in I0, I1, I2. unfold along. repeat split; lra.
  - intros (H0 & H1 & H2). split; [exact I|]. intros v' w' (Hv' & Hw' & Hs'). rewrite (distance_from v w v' w'). destruct (length_positive (v' - v) (w' - w)) as [L _].
    assert (A : v' * along_b v w <= v' * along v w) by (now apply Rmult_le_compat_l). assert (B : w' * along_c v w <= w' * along v w) by (now apply Rmult_le_compat_l).
    assert (C : (v' + w') * along v w <= 1 * along v w) by (now apply Rmult_le_compat_r). assert (E : v * along_b v w + w * along_c v w = along v w) by reflexivity. lra.
Qed.

(** There is one nearest point at most. [NEAR-3] *)
Theorem nearest_is_one v w v' w' : is_nearest v w -> is_nearest v' w' -> v = v' /\ w = w'.
Proof.
  intros N [I' N']. pose proof (proj1 (nearest_iff v w (proj1 N)) N) as (H0 & H1 & H2). pose proof (N' v w (proj1 N)) as M. rewrite (distance_from v w v' w') in M.
  destruct I' as (Hv' & Hw' & Hs').
  assert (A : v' * along_b v w <= v' * along v w) by (now apply Rmult_le_compat_l). assert (B : w' * along_c v w <= w' * along v w) by (now apply Rmult_le_compat_l).
  assert (C : (v' + w') * along v w <= 1 * along v w) by (now apply Rmult_le_compat_r). assert (E : v * along_b v w + w * along_c v w = along v w) by reflexivity.
  destruct (length_positive (v' - v) (w' - w)) as [_ Z]. destruct Z; lra.
Qed.

(** * The certificates *)

(** The names of the code. *)
Let d3 := d1 - bb.
Let d4 := d2 - bc.
Let d5 := d1 - bc.
Let d6 := d2 - cc.
Let of_b := cc * d1 - bc * d2.
Let of_c := bb * d2 - bc * d1.
Let n := bb * cc - bc * bc.
Let of_a := n - of_b - of_c.
Let from_b := d4 - d3.
Let from_c := d5 - d6.

(** The certificate of a point: numbers that are not negative, and where it is. *)
Inductive certified : R -> R -> Prop :=
  | corner_a : 0 <= - d1 -> 0 <= - d2 -> certified 0 0
  | corner_b : 0 <= d3 -> 0 <= - from_b -> certified 1 0
  | corner_c : 0 <= d6 -> 0 <= - from_c -> certified 0 1
  | edge_b : 0 <= - of_c -> 0 <= d1 -> 0 <= - d3 -> certified (d1 / bb) 0
  | edge_c : 0 <= - of_b -> 0 <= d2 -> 0 <= - d6 -> certified 0 (d2 / cc)
  | edge_a : 0 <= - of_a -> 0 <= from_b -> 0 <= from_c -> certified (1 - from_b / (from_b + from_c)) (from_b / (from_b + from_c))
  | plane : 0 <= of_a -> 0 <= of_b -> 0 <= of_c -> certified (of_b / n) (of_c / n).

Let third : from_b + from_c = length (-1) 1.
Proof. unfold from_b, from_c, d3, d4, d5, d6, length. ring. Qed.
Let third_positive : 0 < from_b + from_c.
Proof.
  rewrite third. destruct (length_positive (-1) 1) as [L Z]. destruct (Rle_lt_or_eq_dec _ _ L) as [|E]; [assumption|]. destruct Z; lra.
Qed.

Let share x y : 0 <= x -> 0 < y -> 0 <= x / y.
Proof. intros. apply Rmult_le_pos; [assumption|]. now apply Rlt_le, Rinv_0_lt_compat. Qed.
Let at_most_1 x y : x <= y -> 0 < y -> x / y <= 1.
Proof. intros. apply Rmult_le_reg_r with y; [assumption|]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra. lra. Qed.

(** The point of a certificate is the nearest. [NEAR-3] *)
Theorem certified_is_nearest v w : certified v w -> is_nearest v w.
Proof.
  destruct positive as [Pb Pc]. assert (Done : inside v w -> 0 <= along v w /\ along_b v w <= along v w /\ along_c v w <= along v w -> is_nearest v w) by (intros I H; now apply nearest_iff).
  intros [H1 H2|H1 H2|H1 H2|H1 H2 H3|H1 H2 H3|H1 H2 H3|H1 H2 H3]; (match goal with |- is_nearest ?x ?y => assert (D : inside x y -> 0 <= along x y /\ along_b x y <= along x y /\ along_c x y <= along x y -> is_nearest x y) by (intros I H; now apply nearest_iff) end); apply D; clear D Done.
  - unfold inside. lra.
  - unfold along, along_b, along_c. lra.
  - unfold inside. lra.
  - unfold along, along_b, along_c, from_b, d3, d4 in *. lra.
  - unfold inside. lra.
  - unfold along, along_b, along_c, from_c, d5, d6 in *. lra.
  - unfold inside, d3 in *. pose proof (share d1 bb H2 Pb). pose proof (at_most_1 d1 bb ltac:(lra) Pb). lra.
  - assert (E : d1 / bb * bb = d1) by (field; lra). unfold of_c in H1. assert (R : d2 - d1 / bb * bc <= 0).
    { apply Rmult_le_reg_r with bb; [assumption|]. replace ((d2 - d1 / bb * bc) * bb) with (bb * d2 - bc * (d1 / bb * bb)) by ring. rewrite E. lra. }
    assert (Z : along_b (d1 / bb) 0 = 0) by (unfold along_b; lra). unfold along. rewrite Z. unfold along_c. lra.
  - unfold inside, d6 in *. pose proof (share d2 cc H2 Pc). pose proof (at_most_1 d2 cc ltac:(lra) Pc). lra.
  - assert (E : d2 / cc * cc = d2) by (field; lra). unfold of_b in H1. assert (R : d1 - d2 / cc * bc <= 0).
    { apply Rmult_le_reg_r with cc; [assumption|]. replace ((d1 - d2 / cc * bc) * cc) with (cc * d1 - bc * (d2 / cc * cc)) by ring. rewrite E. lra. }
    assert (Z : along_c 0 (d2 / cc) = 0) by (unfold along_c; lra). unfold along. rewrite Z. unfold along_b. lra.
  - unfold inside. pose proof (share from_b _ H2 third_positive). pose proof (at_most_1 from_b (from_b + from_c) ltac:(lra) third_positive). lra.
  - pose proof third_positive as T. set (k := from_b / (from_b + from_c)). assert (E : k * (from_b + from_c) = from_b) by (unfold k; field; lra).
    assert (Eq : along_b (1 - k) k = along_c (1 - k) k) by (unfold along_b, along_c; unfold from_b, from_c, d3, d4, d5, d6 in E; lra).
    assert (M : along_b (1 - k) k * (from_b + from_c) = - of_a).
    { replace (along_b (1 - k) k * (from_b + from_c)) with (d3 * (from_b + from_c) + (bb - bc) * (k * (from_b + from_c))) by (unfold along_b, d3; ring).
      rewrite E. unfold of_a, n, of_b, of_c, from_b, from_c, d3, d4, d5, d6. ring. }
    assert (P : 0 <= along_b (1 - k) k) by (apply Rmult_le_reg_r with (from_b + from_c); lra). unfold along. rewrite <- Eq. lra.
  - unfold inside. pose proof (share of_b n H2 area). pose proof (share of_c n H3 area).
    assert (of_b / n + of_c / n <= 1); [|lra]. unfold Rdiv. rewrite <- Rmult_plus_distr_r. apply at_most_1; [unfold of_a in H1; lra|exact area].
  - assert (N : n <> 0) by (unfold n; lra). assert (Zb : along_b (of_b / n) (of_c / n) = 0) by (unfold along_b, of_b, of_c, n in *; field; exact N).
    assert (Zc : along_c (of_b / n) (of_c / n) = 0) by (unfold along_c, of_b, of_c, n in *; field; exact N). unfold along. rewrite Zb, Zc. lra.
Qed.

(** And the nearest point has one of the certificates: so a box of the points of all certificates that may hold has it. [NEAR-3] *)
Theorem nearest_is_certified v w : is_nearest v w -> certified v w.
Proof.
  intros Nr. destruct positive as [Pb Pc]. pose proof (proj1 Nr) as (Hv & Hw & Hs). destruct (proj1 (nearest_iff v w (proj1 Nr)) Nr) as (M0 & Mb & Mc).
  set (m := along v w) in *. assert (E : v * along_b v w + w * along_c v w = m) by reflexivity.
  (* Weights times what is left add up to 0, so each is 0. *)
  assert (U1 : 0 <= (1 - v - w) * m) by (apply Rmult_le_pos; lra). assert (U2 : 0 <= v * (m - along_b v w)) by (apply Rmult_le_pos; lra).
  assert (U3 : 0 <= w * (m - along_c v w)) by (apply Rmult_le_pos; lra).
  assert (Z : (1 - v - w) * m = 0 /\ v * (m - along_b v w) = 0 /\ w * (m - along_c v w) = 0) by lra. clear U1 U2 U3. destruct Z as (Z1 & Z2 & Z3).
  apply Rmult_integral in Z1, Z2, Z3. unfold along_b, along_c in *.
  destruct (Rle_lt_or_eq_dec _ _ Hv) as [V|V]; destruct (Rle_lt_or_eq_dec _ _ Hw) as [W|W].
  - destruct Z2 as [|Z2]; [lra|]. destruct Z3 as [|Z3]; [lra|]. destruct (Req_dec m 0) as [M|M].
    + assert (R1 : d1 = v * bb + w * bc) by lra. assert (R2 : d2 = v * bc + w * cc) by lra.
      assert (Eb : of_b = v * n) by (unfold of_b, n; rewrite R1, R2; ring). assert (Ec : of_c = w * n) by (unfold of_c, n; rewrite R1, R2; ring).
      assert (N : 0 < n) by exact area. replace v with (of_b / n) by (rewrite Eb; field; lra). replace w with (of_c / n) by (rewrite Ec; field; lra).
      apply plane; [unfold of_a; rewrite Eb, Ec; assert (0 <= (1 - v - w) * n) by (apply Rmult_le_pos; lra); lra|rewrite Eb; apply Rmult_le_pos; lra|rewrite Ec; apply Rmult_le_pos; lra].
    + destruct Z1 as [Z1|]; [|contradiction]. pose proof third_positive as T. assert (Vw : v = 1 - w) by lra.
      assert (F : from_b = w * (from_b + from_c)) by (unfold from_b, from_c, d3, d4, d5, d6; rewrite Vw in *; lra).
      assert (K : w = from_b / (from_b + from_c)) by (rewrite F at 1; field; lra).
      assert (A : m * (from_b + from_c) = - of_a).
      { replace m with (d3 + w * (bb - bc)) by (unfold d3; rewrite Vw in *; lra).
        replace ((d3 + w * (bb - bc)) * (from_b + from_c)) with (d3 * (from_b + from_c) + (bb - bc) * (w * (from_b + from_c))) by ring.
        rewrite <- F. unfold of_a, n, of_b, of_c, from_b, from_c, d3, d4, d5, d6. ring. }
      rewrite Vw, K. apply edge_a; [rewrite <- A; apply Rmult_le_pos; lra|rewrite F; apply Rmult_le_pos; lra|].
      assert (0 <= v * (from_b + from_c)) by (apply Rmult_le_pos; lra). rewrite Vw in *. lra.
  - destruct Z2 as [|Z2]; [lra|]. rewrite <- W in *. destruct (Req_dec (1 - v) 0) as [One|One].
    + replace v with 1 in * by lra. apply corner_b; unfold from_b, d3, d4; lra.
    + destruct Z1 as [Z1|Z1]; [lra|]. assert (R1 : d1 = v * bb) by lra. replace v with (d1 / bb) by (rewrite R1; field; lra).
      apply edge_b; [|rewrite R1; apply Rmult_le_pos; lra|unfold d3; rewrite R1; assert (0 <= (1 - v) * bb) by (apply Rmult_le_pos; lra); lra].
      unfold of_c. rewrite R1. assert (0 <= bb * (v * bc - d2)) by (apply Rmult_le_pos; lra). lra.
  - destruct Z3 as [|Z3]; [lra|]. rewrite <- V in *. destruct (Req_dec (1 - w) 0) as [One|One].
    + replace w with 1 in * by lra. apply corner_c; unfold from_c, d5, d6; lra.
    + destruct Z1 as [Z1|Z1]; [lra|]. assert (R2 : d2 = w * cc) by lra. replace w with (d2 / cc) by (rewrite R2; field; lra).
      apply edge_c; [|rewrite R2; apply Rmult_le_pos; lra|unfold d6; rewrite R2; assert (0 <= (1 - w) * cc) by (apply Rmult_le_pos; lra); lra].
      unfold of_b. rewrite R2. assert (0 <= cc * (w * bc - d1)) by (apply Rmult_le_pos; lra). lra.
  - rewrite <- V, <- W in *. destruct Z1 as [|Z1]; [lra|]. apply corner_a; lra.
Qed.
(** There is a point with a certificate, so there is a nearest one. [NEAR-3] *)
Theorem one_is_certified : exists v w, certified v w.
Proof.
  destruct positive as [Pb Pc]. pose proof third_positive as T. assert (L : from_b + from_c = bb - 2 * bc + cc) by (rewrite third; unfold length; ring).
  assert (Cases : (0 <= of_a /\ 0 <= of_b /\ 0 <= of_c) \/ of_c < 0 \/ of_b < 0 \/ of_a < 0) by lra.
  assert (All : (d1 <= 0 /\ d2 <= 0) \/ (0 <= d3 /\ from_b <= 0) \/ (of_c <= 0 /\ 0 <= d1 /\ d3 <= 0) \/ (of_b <= 0 /\ 0 <= d2 /\ d6 <= 0) \/
    (of_a <= 0 /\ 0 <= from_b /\ 0 <= from_c) \/ (0 <= d6 /\ from_c <= 0) \/ (0 <= of_a /\ 0 <= of_b /\ 0 <= of_c)).
  { unfold of_a, of_b, of_c, n, from_b, from_c, d3, d4, d5, d6 in *. destruct Cases as [H|[H|[H|H]]]; [tauto|..].
    - destruct (beyond_edge bb bc cc d1 d2 area Pb H) as [K|[K|[K|[K|[K|K]]]]]; lra.
    - destruct (beyond_edge cc bc bb d2 d1) as [K|[K|[K|[K|[K|K]]]]]; lra.
    - destruct (beyond_edge (bb - 2 * bc + cc) (bb - bc) bb (d2 - bc - (d1 - bb)) (bb - d1)) as [K|[K|[K|[K|[K|K]]]]]; lra. }
  destruct All as [K|[K|[K|[K|[K|[K|K]]]]]].
  - exists 0, 0. apply corner_a; lra.
  - exists 1, 0. apply corner_b; lra.
  - exists (d1 / bb), 0. apply edge_b; lra.
  - exists 0, (d2 / cc). apply edge_c; lra.
  - eexists _, _. apply edge_a; lra.
  - exists 0, 1. apply corner_c; lra.
  - eexists _, _. apply plane; lra.
Qed.
End Nearest.

(** The distance of a point of the triangle is that. [NEAR-3] *)
Theorem distance_is_square a b c p v w : let s := sub p a in
  square p (at_ a b c v w) = distance (dot b b) (dot b c) (dot c c) (dot b s) (dot c s) (dot s s) v w.
Proof. unfold square, distance, length, at_, Filter.dot, vsub, exactly. cbn [vx vy vz]. ring. Qed.
(** N is the square of b x c. [NEAR-3] *)
Theorem area_is_square b c : dot b b * dot c c - dot b c * dot b c = dot (cross exactly b c) (cross exactly b c).
Proof. unfold Filter.dot, cross, exactly. cbn [vx vy vz]. ring. Qed.
