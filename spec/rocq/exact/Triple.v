(** The determinants of EXACT-1 and what their roundings cost: EXACT-2, EXACT-4 and EXACT-6 for relative errors of at most u, in
    real numbers. Filter.v has the operations of the code. *)
Require Import Reals ZArith Lia Lra Psatz.
Require Import StacklessExact.Rounding.
Open Scope R_scope.

(** * Hadamard *)

Lemma cross_sum y1 y2 y3 z1 z2 z3 Y Z :
  Rabs y1 <= Y -> Rabs y2 <= Y -> Rabs y3 <= Y -> Rabs z1 <= Z -> Rabs z2 <= Z -> Rabs z3 <= Z ->
  Rabs (y2 * z3 - y3 * z2) + Rabs (y3 * z1 - y1 * z3) + Rabs (y1 * z2 - y2 * z1) <= 4 * (Y * Z).
Proof.
  intros H1 H2 H3 G1 G2 G3. pose proof (pos_b _ _ H1) as HY.
  assert (L : forall a p, Rabs a <= Y -> a * p <= Y * Rabs p).
  { intros a p Ha. eapply Rle_trans; [apply Rle_abs|]. rewrite Rabs_mult. apply Rmult_le_compat_r; [apply Rabs_pos|exact Ha]. }
  assert (K : forall s1 s2 s3, (s1 = 1 \/ s1 = -1) -> (s2 = 1 \/ s2 = -1) -> (s3 = 1 \/ s3 = -1) ->
    s1 * (y2 * z3 - y3 * z2) + s2 * (y3 * z1 - y1 * z3) + s3 * (y1 * z2 - y2 * z1) <= 4 * (Y * Z)).
  { intros s1 s2 s3 S1 S2 S3.
    pose proof (L y1 (s3 * z2 - s2 * z3) H1) as L1. pose proof (L y2 (s1 * z3 - s3 * z1) H2) as L2.
    pose proof (L y3 (s2 * z1 - s1 * z2) H3) as L3.
    assert (S : Rabs (s3 * z2 - s2 * z3) + Rabs (s1 * z3 - s3 * z1) + Rabs (s2 * z1 - s1 * z2) <= 4 * Z).
    { clear L1 L2 L3 L H1 H2 H3.
      assert (A : forall x, Rabs x <= Z -> - Z <= x <= Z) by (intros x Hx; split_Rabs; lra).
      apply A in G1. apply A in G2. apply A in G3.
      destruct S1 as [-> | ->], S2 as [-> | ->], S3 as [-> | ->]; split_Rabs; lra. }
    apply Rle_trans with (Y * (Rabs (s3 * z2 - s2 * z3) + Rabs (s1 * z3 - s3 * z1) + Rabs (s2 * z1 - s1 * z2))); [lra|].
    replace (4 * (Y * Z)) with (Y * (4 * Z)) by ring. apply Rmult_le_compat_l; assumption. }
  unfold Rabs. destruct (Rcase_abs (y2 * z3 - y3 * z2)), (Rcase_abs (y3 * z1 - y1 * z3)), (Rcase_abs (y1 * z2 - y2 * z1)).
  - pose proof (K (-1) (-1) (-1)). lra.
  - pose proof (K (-1) (-1) 1). lra.
  - pose proof (K (-1) 1 (-1)). lra.
  - pose proof (K (-1) 1 1). lra.
  - pose proof (K 1 (-1) (-1)). lra.
  - pose proof (K 1 (-1) 1). lra.
  - pose proof (K 1 1 (-1)). lra.
  - pose proof (K 1 1 1). lra.
Qed.

(** x . (y x z) *)
Definition det3 x1 x2 x3 y1 y2 y3 z1 z2 z3 : R :=
  x1 * (y2 * z3 - y3 * z2) + x2 * (y3 * z1 - y1 * z3) + x3 * (y1 * z2 - y2 * z1).

(** Hadamard's bound for three rows. [EXACT-4] *)
Theorem det3_b x1 x2 x3 y1 y2 y3 z1 z2 z3 X Y Z :
  Rabs x1 <= X -> Rabs x2 <= X -> Rabs x3 <= X ->
  Rabs y1 <= Y -> Rabs y2 <= Y -> Rabs y3 <= Y -> Rabs z1 <= Z -> Rabs z2 <= Z -> Rabs z3 <= Z ->
  Rabs (det3 x1 x2 x3 y1 y2 y3 z1 z2 z3) <= 4 * (X * Y * Z).
Proof.
  intros A1 A2 A3 H1 H2 H3 G1 G2 G3. pose proof (cross_sum _ _ _ _ _ _ _ _ H1 H2 H3 G1 G2 G3) as S.
  pose proof (pos_b _ _ A1) as HX. unfold det3.
  apply Rle_trans with (X * Rabs (y2 * z3 - y3 * z2) + X * Rabs (y3 * z1 - y1 * z3) + X * Rabs (y1 * z2 - y2 * z1)).
  - repeat apply add_b; apply mul_b; auto; apply Rle_refl.
  - replace (4 * (X * Y * Z)) with (X * (4 * (Y * Z))) by ring. rewrite <- !Rmult_plus_distr_l.
    apply Rmult_le_compat_l; assumption.
Qed.

Section Errors.
Variable u : R.
Hypothesis Hu : 0 < u <= / 2048.

Lemma one_b e : Rabs e <= u -> Rabs (1 + e) <= 1 + u.
Proof. intros. apply add_b; [rewrite Rabs_pos_eq; lra|assumption]. Qed.

(** * Six products, three differences, three products, two sums *)

(** A triple product costs 22u + 49u² of the sizes. [EXACT-4] *)
Theorem triple x1 x2 x3 y1 y2 y3 z1 z2 z3 X Y Z m1 m2 m3 m4 m5 m6 c1 c2 c3 e1 e2 e3 s1 s2 :
  Rabs x1 <= X -> Rabs x2 <= X -> Rabs x3 <= X ->
  Rabs y1 <= Y -> Rabs y2 <= Y -> Rabs y3 <= Y -> Rabs z1 <= Z -> Rabs z2 <= Z -> Rabs z3 <= Z ->
  Rabs m1 <= u -> Rabs m2 <= u -> Rabs m3 <= u -> Rabs m4 <= u -> Rabs m5 <= u -> Rabs m6 <= u ->
  Rabs c1 <= u -> Rabs c2 <= u -> Rabs c3 <= u -> Rabs e1 <= u -> Rabs e2 <= u -> Rabs e3 <= u ->
  Rabs s1 <= u -> Rabs s2 <= u ->
  let p1 := (y2 * z3 * (1 + m1) - y3 * z2 * (1 + m2)) * (1 + c1) in
  let p2 := (y3 * z1 * (1 + m3) - y1 * z3 * (1 + m4)) * (1 + c2) in
  let p3 := (y1 * z2 * (1 + m5) - y2 * z1 * (1 + m6)) * (1 + c3) in
  Rabs (((x1 * p1 * (1 + e1) + x2 * p2 * (1 + e2)) * (1 + s1) + x3 * p3 * (1 + e3)) * (1 + s2) -
    det3 x1 x2 x3 y1 y2 y3 z1 z2 z3) <= (22 * u + 49 * (u * u)) * (X * Y * Z).
Proof.
  intros A1 A2 A3 H1 H2 H3 G1 G2 G3 M1 M2 M3 M4 M5 M6 C1 C2 C3 E1 E2 E3 S1 S2 p1 p2 p3.
  pose proof (cross_sum _ _ _ _ _ _ _ _ H1 H2 H3 G1 G2 G3) as CS.
  pose proof (pos_b _ _ A1) as HX. pose proof (pos_b _ _ H1) as HY. pose proof (pos_b _ _ G1) as HZ.
  set (N := Y * Z) in *. assert (HN : 0 <= N) by (apply Rmult_le_pos; assumption).
  set (P1 := y2 * z3 - y3 * z2) in *. set (P2 := y3 * z1 - y1 * z3) in *. set (P3 := y1 * z2 - y2 * z1) in *.
  assert (Rk : forall t t' m m' c P, P = t - t' -> Rabs t <= N -> Rabs t' <= N -> Rabs m <= u -> Rabs m' <= u -> Rabs c <= u ->
    Rabs ((t * (1 + m) - t' * (1 + m')) * (1 + c) - P) <= 2 * u * (1 + u) * N + u * Rabs P).
  { intros t t' m m' c P -> Ht Ht' Hm Hm' Hc.
    replace ((t * (1 + m) - t' * (1 + m')) * (1 + c) - (t - t')) with ((t * m - t' * m') * (1 + c) + (t - t') * c) by ring.
    apply Rle_trans with ((N * u + N * u) * (1 + u) + Rabs (t - t') * u); [|right; ring].
    apply add_b; apply mul_b; auto using one_b, Rle_refl. apply sub_b; apply mul_b; assumption. }
  assert (R1 : Rabs (p1 - P1) <= 2 * u * (1 + u) * N + u * Rabs P1) by (apply Rk; auto; apply mul_b; assumption).
  assert (R2 : Rabs (p2 - P2) <= 2 * u * (1 + u) * N + u * Rabs P2) by (apply Rk; auto; apply mul_b; assumption).
  assert (R3 : Rabs (p3 - P3) <= 2 * u * (1 + u) * N + u * Rabs P3) by (apply Rk; auto; apply mul_b; assumption).
  clearbody p1 p2 p3.
  assert (Qk : forall x p P e, Rabs x <= X -> Rabs (p - P) <= 2 * u * (1 + u) * N + u * Rabs P -> Rabs e <= u ->
    Rabs (x * p * (1 + e) - x * P) <= X * (2 * u * (1 + u) * (1 + u) * N + (2 * u + u * u) * Rabs P)).
  { intros x p P e Hx Hp He.
    replace (x * p * (1 + e) - x * P) with (x * ((p - P) * (1 + e) + P * e)) by ring.
    apply mul_b; [assumption|].
    apply Rle_trans with ((2 * u * (1 + u) * N + u * Rabs P) * (1 + u) + Rabs P * u); [|right; ring].
    apply add_b; apply mul_b; auto using one_b, Rle_refl. }
  assert (Q1 := Qk x1 p1 P1 e1 A1 R1 E1). assert (Q2 := Qk x2 p2 P2 e2 A2 R2 E2). assert (Q3 := Qk x3 p3 P3 e3 A3 R3 E3).
  clear Qk Rk R1 R2 R3.
  set (q1 := x1 * p1 * (1 + e1)) in *. set (q2 := x2 * p2 * (1 + e2)) in *. set (q3 := x3 * p3 * (1 + e3)) in *.
  clearbody q1 q2 q3.
  pose proof (Rabs_pos P1) as O1. pose proof (Rabs_pos P2) as O2. pose proof (Rabs_pos P3) as O3.
  set (J1 := Rabs P1) in *. set (J2 := Rabs P2) in *. set (J3 := Rabs P3) in *.
  (* What the three products are off by. *)
  set (B1 := X * (2 * u * (1 + u) * (1 + u) * N + (2 * u + u * u) * J1)) in *.
  set (B2 := X * (2 * u * (1 + u) * (1 + u) * N + (2 * u + u * u) * J2)) in *.
  set (B3 := X * (2 * u * (1 + u) * (1 + u) * N + (2 * u + u * u) * J3)) in *.
  set (V := X * N). assert (HV : 0 <= V) by (apply Rmult_le_pos; assumption).
  assert (UU : 0 < u * u) by (apply Rmult_lt_0_compat; lra). assert (HK : 0 <= 2 * u + u * u) by lra.
  assert (HB : B1 + B2 + B3 <= (14 * u + 16 * (u * u) + 6 * (u * u * u)) * V).
  { unfold B1, B2, B3, V.
    apply Rle_trans with (X * (6 * u * (1 + u) * (1 + u) * N + (2 * u + u * u) * (4 * N))); [|right; ring].
    rewrite <- !Rmult_plus_distr_l. apply Rmult_le_compat_l; [assumption|].
    assert ((2 * u + u * u) * (J1 + J2 + J3) <= (2 * u + u * u) * (4 * N)) by (apply Rmult_le_compat_l; assumption). lra. }
  assert (N1 : 0 <= B1) by (apply (pos_b _ _ Q1)). assert (N2 : 0 <= B2) by (apply (pos_b _ _ Q2)).
  assert (N3 : 0 <= B3) by (apply (pos_b _ _ Q3)).
  set (W := (14 * u + 16 * (u * u) + 6 * (u * u * u)) * V) in *.
  assert (XJ : X * J1 + X * J2 + X * J3 <= 4 * V).
  { rewrite <- !Rmult_plus_distr_l. unfold V. replace (4 * (X * N)) with (X * (4 * N)) by ring.
    apply Rmult_le_compat_l; assumption. }
  assert (XP : 0 <= X * J3) by (apply Rmult_le_pos; assumption).
  assert (F1 : Rabs (x1 * P1) <= X * J1) by (apply mul_b; [assumption|apply Rle_refl]).
  assert (F2 : Rabs (x2 * P2) <= X * J2) by (apply mul_b; [assumption|apply Rle_refl]).
  assert (F3 : Rabs (x3 * P3) <= X * J3) by (apply mul_b; [assumption|apply Rle_refl]).
  assert (T : Rabs (q1 + q2) <= 4 * V + W).
  { replace (q1 + q2) with ((q1 - x1 * P1) + (q2 - x2 * P2) + (x1 * P1 + x2 * P2)) by ring.
    pose proof (add_b _ _ _ _ (add_b _ _ _ _ Q1 Q2) (add_b _ _ _ _ F1 F2)). lra. }
  assert (S : Rabs (q1 + q2 + q3) <= 4 * V + W).
  { replace (q1 + q2 + q3) with ((q1 - x1 * P1) + (q2 - x2 * P2) + (q3 - x3 * P3) + (x1 * P1 + x2 * P2 + x3 * P3)) by ring.
    pose proof (add_b _ _ _ _ (add_b _ _ _ _ (add_b _ _ _ _ Q1 Q2) Q3) (add_b _ _ _ _ (add_b _ _ _ _ F1 F2) F3)). lra. }
  assert (D : Rabs (q1 + q2 + q3 - det3 x1 x2 x3 y1 y2 y3 z1 z2 z3) <= W).
  { unfold det3. fold P1 P2 P3.
    replace (q1 + q2 + q3 - (x1 * P1 + x2 * P2 + x3 * P3)) with
      ((q1 - x1 * P1) + (q2 - x2 * P2) + (q3 - x3 * P3)) by ring.
    pose proof (add_b _ _ _ _ (add_b _ _ _ _ Q1 Q2) Q3). lra. }
  replace (((q1 + q2) * (1 + s1) + q3) * (1 + s2) - det3 x1 x2 x3 y1 y2 y3 z1 z2 z3) with
    ((q1 + q2 + q3 - det3 x1 x2 x3 y1 y2 y3 z1 z2 z3) + (q1 + q2) * s1 * (1 + s2) + (q1 + q2 + q3) * s2) by ring.
  apply Rle_trans with (W + (4 * V + W) * u * (1 + u) + (4 * V + W) * u).
  - apply add_b; [apply add_b; [assumption|]|]; repeat apply mul_b; auto using one_b.
  - unfold W. replace (X * Y * Z) with V by (unfold V, N; ring).
    assert (U2 : u * u * u <= u * u * / 1024) by (apply Rmult_le_compat_l; lra).
    assert (U0 : 0 < u * u * u) by (apply Rmult_lt_0_compat; lra).
    assert (U3 : u * u * u * u <= u * u * u * 1) by (apply Rmult_le_compat_l; lra).
    assert (U4 : u * u * u * u * u <= u * u * u * u * 1) by (apply Rmult_le_compat_l; [apply Rlt_le, Rmult_lt_0_compat|]; lra).
    assert (P : (14 * u + 16 * (u * u) + 6 * (u * u * u)) + (4 + (14 * u + 16 * (u * u) + 6 * (u * u * u))) * u * (1 + u) +
      (4 + (14 * u + 16 * (u * u) + 6 * (u * u * u))) * u <= 22 * u + 49 * (u * u)) by lra.
    apply Rle_trans with (((14 * u + 16 * (u * u) + 6 * (u * u * u)) + (4 + (14 * u + 16 * (u * u) + 6 * (u * u * u))) * u * (1 + u) +
      (4 + (14 * u + 16 * (u * u) + 6 * (u * u * u))) * u) * V); [right; ring|]. apply Rmult_le_compat_r; assumption.
Qed.

(** * Rows that are rounded *)

(** Each true entry is the computed one times 1 + η. *)
Definition row x1 x2 x3 t1 t2 t3 : Prop := exists a b c, Rabs a <= u /\ Rabs b <= u /\ Rabs c <= u /\
  t1 = x1 * (1 + a) /\ t2 = x2 * (1 + b) /\ t3 = x3 * (1 + c).

(** x or y is exact, the other and z are rounded: 8u + 4u². *)
Lemma rows_xz x1 x2 x3 y1 y2 y3 z1 z2 z3 X Y Z t1 t2 t3 w1 w2 w3 :
  Rabs x1 <= X -> Rabs x2 <= X -> Rabs x3 <= X ->
  Rabs y1 <= Y -> Rabs y2 <= Y -> Rabs y3 <= Y -> Rabs z1 <= Z -> Rabs z2 <= Z -> Rabs z3 <= Z ->
  row x1 x2 x3 t1 t2 t3 -> row z1 z2 z3 w1 w2 w3 ->
  Rabs (det3 x1 x2 x3 y1 y2 y3 z1 z2 z3 - det3 t1 t2 t3 y1 y2 y3 w1 w2 w3) <= (8 * u + 4 * (u * u)) * (X * Y * Z).
Proof.
  intros A1 A2 A3 H1 H2 H3 G1 G2 G3 (a & b & c & Ha & Hb & Hc & -> & -> & ->) (a' & b' & c' & Ha' & Hb' & Hc' & -> & -> & ->).
  replace (det3 x1 x2 x3 y1 y2 y3 z1 z2 z3 -
      det3 (x1 * (1 + a)) (x2 * (1 + b)) (x3 * (1 + c)) y1 y2 y3 (z1 * (1 + a')) (z2 * (1 + b')) (z3 * (1 + c'))) with
    (- (det3 (x1 * a) (x2 * b) (x3 * c) y1 y2 y3 z1 z2 z3 + det3 x1 x2 x3 y1 y2 y3 (z1 * a') (z2 * b') (z3 * c') +
      det3 (x1 * a) (x2 * b) (x3 * c) y1 y2 y3 (z1 * a') (z2 * b') (z3 * c'))) by (unfold det3; ring).
  rewrite Rabs_Ropp.
  apply Rle_trans with (4 * (X * u * Y * Z) + 4 * (X * Y * (Z * u)) + 4 * (X * u * Y * (Z * u))); [|right; ring].
  repeat apply add_b; apply det3_b; auto using mul_b.
Qed.

Lemma det3_cycle x1 x2 x3 y1 y2 y3 z1 z2 z3 : det3 x1 x2 x3 y1 y2 y3 z1 z2 z3 = det3 y1 y2 y3 z1 z2 z3 x1 x2 x3.
Proof. unfold det3. ring. Qed.

Lemma rows_yz x1 x2 x3 y1 y2 y3 z1 z2 z3 X Y Z t1 t2 t3 w1 w2 w3 :
  Rabs x1 <= X -> Rabs x2 <= X -> Rabs x3 <= X ->
  Rabs y1 <= Y -> Rabs y2 <= Y -> Rabs y3 <= Y -> Rabs z1 <= Z -> Rabs z2 <= Z -> Rabs z3 <= Z ->
  row y1 y2 y3 t1 t2 t3 -> row z1 z2 z3 w1 w2 w3 ->
  Rabs (det3 x1 x2 x3 y1 y2 y3 z1 z2 z3 - det3 x1 x2 x3 t1 t2 t3 w1 w2 w3) <= (8 * u + 4 * (u * u)) * (X * Y * Z).
Proof.
  intros. rewrite (det3_cycle x1 x2 x3 y1), (det3_cycle x1 x2 x3 t1), (det3_cycle y1 y2 y3), (det3_cycle t1 t2 t3).
  rewrite (det3_cycle z1), (det3_cycle w1 w2 w3 x1).
  (* x . (y x z) = z . (x x y), and the sign of an exchange. *)
  rewrite <- (det3_cycle z1), <- (det3_cycle w1 w2 w3 x1).
  replace (X * Y * Z) with (Z * X * Y) by ring. apply rows_xz; assumption.
Qed.

(** All three rows are rounded: 12u + 13u². *)
Lemma rows_xyz x1 x2 x3 y1 y2 y3 z1 z2 z3 X Y Z t1 t2 t3 v1 v2 v3 w1 w2 w3 :
  Rabs x1 <= X -> Rabs x2 <= X -> Rabs x3 <= X ->
  Rabs y1 <= Y -> Rabs y2 <= Y -> Rabs y3 <= Y -> Rabs z1 <= Z -> Rabs z2 <= Z -> Rabs z3 <= Z ->
  row x1 x2 x3 t1 t2 t3 -> row y1 y2 y3 v1 v2 v3 -> row z1 z2 z3 w1 w2 w3 ->
  Rabs (det3 x1 x2 x3 y1 y2 y3 z1 z2 z3 - det3 t1 t2 t3 v1 v2 v3 w1 w2 w3) <= (12 * u + 13 * (u * u)) * (X * Y * Z).
Proof.
  intros A1 A2 A3 H1 H2 H3 G1 G2 G3 Rx (a & b & c & Ha & Hb & Hc & -> & -> & ->) Rz.
  pose proof (rows_xz _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ A1 A2 A3 H1 H2 H3 G1 G2 G3 Rx Rz) as K.
  assert (B : forall r1 r2 r3 s1 s2 s3 R, row r1 r2 r3 s1 s2 s3 -> Rabs r1 <= R -> Rabs r2 <= R -> Rabs r3 <= R ->
    Rabs s1 <= R * (1 + u) /\ Rabs s2 <= R * (1 + u) /\ Rabs s3 <= R * (1 + u)).
  { intros r1 r2 r3 s1 s2 s3 R (a' & b' & c' & ? & ? & ? & -> & -> & ->) ? ? ?. repeat split; apply mul_b; auto using one_b. }
  destruct (B _ _ _ _ _ _ X Rx A1 A2 A3) as (T1 & T2 & T3). destruct (B _ _ _ _ _ _ Z Rz G1 G2 G3) as (W1 & W2 & W3).
  pose proof (pos_b _ _ A1). pose proof (pos_b _ _ H1). pose proof (pos_b _ _ G1).
  set (P := X * Y * Z). assert (HP : 0 <= P) by (unfold P; repeat apply Rmult_le_pos; assumption).
  assert (L : Rabs (det3 t1 t2 t3 (y1 * a) (y2 * b) (y3 * c) w1 w2 w3) <= 4 * (X * (1 + u) * (Y * u) * (Z * (1 + u)))).
  { apply det3_b; auto using mul_b. }
  replace (4 * (X * (1 + u) * (Y * u) * (Z * (1 + u)))) with ((4 * u + 8 * (u * u) + 4 * (u * u * u)) * P) in L by (unfold P; ring).
  fold P in K. clearbody P.
  replace (det3 x1 x2 x3 y1 y2 y3 z1 z2 z3 - det3 t1 t2 t3 (y1 * (1 + a)) (y2 * (1 + b)) (y3 * (1 + c)) w1 w2 w3) with
    ((det3 x1 x2 x3 y1 y2 y3 z1 z2 z3 - det3 t1 t2 t3 y1 y2 y3 w1 w2 w3) - det3 t1 t2 t3 (y1 * a) (y2 * b) (y3 * c) w1 w2 w3)
    by (unfold det3; ring).
  eapply Rle_trans; [apply sub_b; [exact K|exact L]|]. rewrite <- Rmult_plus_distr_r. apply Rmult_le_compat_r; [exact HP|].
  assert (0 < u * u) by (apply Rmult_lt_0_compat; lra).
  assert (u * u * u <= u * u * / 2048) by (apply Rmult_le_compat_l; lra). lra.
Qed.

Lemma row_b x1 x2 x3 t1 t2 t3 X : row x1 x2 x3 t1 t2 t3 -> Rabs x1 <= X -> Rabs x2 <= X -> Rabs x3 <= X ->
  Rabs t1 <= X * (1 + u) /\ Rabs t2 <= X * (1 + u) /\ Rabs t3 <= X * (1 + u).
Proof. intros (a & b & c & Ha & Hb & Hc & -> & -> & ->) H1 H2 H3. repeat split; apply mul_b; auto using one_b. Qed.

(** * W *)
(** [EXACT-4] *)
Lemma third det U V det' U' V' w1 w2 D C E :
  0 <= D -> 0 <= C -> 0 <= E -> Rabs w1 <= u -> Rabs w2 <= u ->
  let k := 30 * u + 53 * (u * u) in
  Rabs (det - det') <= k * (D * E * E) -> Rabs (U - U') <= k * (D * C * E) -> Rabs (V - V') <= k * (D * C * E) ->
  Rabs (det' - U') <= 4 * ((1 + u) * (1 + u)) * (D * E * (C + E)) -> Rabs V' <= 4 * ((1 + u) * (1 + u)) * (D * C * E) ->
  Rabs (((det - U) * (1 + w1) - V) * (1 + w2) - (det' - U' - V')) <= (77 / 2) * u * (D * E * (2 * C + E)).
Proof.
  intros HD HC HE W1 W2 k Kd KU KV B1 B2.
  assert (Hk : 0 <= k <= 30 * u + 53 * u / 1024) by (unfold k; nra).
  set (DEE := D * E * E) in *. set (DCE := D * C * E) in *.
  assert (P1 : 0 <= DEE) by (unfold DEE; repeat apply Rmult_le_pos; assumption).
  assert (P2 : 0 <= DCE) by (unfold DCE; repeat apply Rmult_le_pos; assumption).
  replace (D * E * (C + E)) with (DCE + DEE) in B1 by (unfold DCE, DEE; ring).
  replace (D * E * (2 * C + E)) with (2 * DCE + DEE) by (unfold DCE, DEE; ring).
  clearbody DEE DCE. clear HD HC HE D C E.
  set (x := det - U). assert (Hx : Rabs (x - (det' - U')) <= k * (DCE + DEE)).
  { unfold x. replace (det - U - (det' - U')) with ((det - det') - (U - U')) by ring.
    eapply Rle_trans; [apply sub_b; eassumption|right; ring]. }
  clearbody x. clear Kd KU.
  assert (Bx : Rabs x <= (4 * ((1 + u) * (1 + u)) + k) * (DCE + DEE)).
  { replace x with ((x - (det' - U')) + (det' - U')) by ring. eapply Rle_trans; [apply add_b; eassumption|right; ring]. }
  assert (By : Rabs (x - V) <= (4 * ((1 + u) * (1 + u)) + k) * (2 * DCE + DEE)).
  { replace (x - V) with (x - ((V - V') + V')) by ring.
    eapply Rle_trans; [apply sub_b; [exact Bx|apply add_b; eassumption]|]. right. ring. }
  replace ((x * (1 + w1) - V) * (1 + w2) - (det' - U' - V')) with
    ((x - (det' - U')) - (V - V') + x * w1 * (1 + w2) + (x - V) * w2) by ring.
  eapply Rle_trans.
  { apply add_b; [apply add_b; [apply sub_b; eassumption|]|]; [repeat apply mul_b; eauto using one_b|apply mul_b; eassumption]. }
  set (f := 4 * ((1 + u) * (1 + u)) + k) in *.
  assert (Hf : 0 <= f <= 4 + 40 * u) by (unfold f; split; nra).
  assert (F1 : f * u * (1 + u) <= 4 * u + u / 8) by nra.
  assert (F2 : f * u <= 4 * u + u / 8) by nra.
  nra.
Qed.

(** * EXACT-6: what the first stage decides *)

Definition hit det U V W : Prop := det <> 0 /\ 0 <= U / det /\ 0 <= V / det /\ 0 <= W / det.

(** The sign bit of the computed determinant: either, where that is 0. *)
Definition sign_bit (neg : bool) det : Prop := if neg then det <= 0 else 0 <= det.
Definition front (neg : bool) x : R := if neg then - x else x.

(** In a hit all have the sign of the determinant, and none exceeds it. [EXACT-2] *)
Theorem hit_signs det U V W : hit det U V W -> W = det - U - V ->
  (0 < det /\ 0 <= U <= det /\ 0 <= V <= det /\ 0 <= W <= det) \/
  (det < 0 /\ det <= U <= 0 /\ det <= V <= 0 /\ det <= W <= 0).
Proof.
  intros (Hd & HU & HV & HW) E.
  set (a := U / det) in *. set (b := V / det) in *. set (c := W / det) in *.
  assert (GU : U = a * det) by (unfold a; field; assumption). assert (GV : V = b * det) by (unfold b; field; assumption).
  assert (GW : W = c * det) by (unfold c; field; assumption). clearbody a b c.
  assert (S : a + b + c = 1) by (apply Rmult_eq_reg_r with det; [lra|assumption]).
  clear E. rewrite GU, GV, GW.
  assert (P : forall x, 0 <= x <= 1 -> 0 < det -> 0 <= x * det <= det).
  { intros x [H0 H1] H. split; [apply Rmult_le_pos; lra|]. rewrite <- (Rmult_1_l det) at 2. apply Rmult_le_compat_r; lra. }
  assert (Q : forall x, 0 <= x <= 1 -> det < 0 -> det <= x * det <= 0).
  { intros x [H0 H1] H. pose proof (Rmult_le_pos x (- det) H0 ltac:(lra)).
    pose proof (Rmult_le_pos (1 - x) (- det) ltac:(lra) ltac:(lra)). lra. }
  destruct (Rtotal_order det 0) as [H|[H|H]]; [right|contradiction|left].
  - pose proof (Q a ltac:(lra) H). pose proof (Q b ltac:(lra) H). pose proof (Q c ltac:(lra) H). lra.
  - pose proof (P a ltac:(lra) H). pose proof (P b ltac:(lra) H). pose proof (P c ltac:(lra) H). lra.
Qed.

(** If a computed edge function has, as seen from the computed determinant, a negative value beyond the bounds of both, the
    triangle is missed. Whatever sign the computed determinant has, also if it is wrong or 0. [EXACT-6] *)
Theorem miss_is_certain neg det x det' U' V' W' x' bd be : sign_bit neg det ->
  Rabs (det - det') <= bd -> Rabs (x - x') <= be -> (x' = U' \/ x' = V' \/ x' = W') -> W' = det' - U' - V' ->
  front neg x < - (bd + be) -> ~ hit det' U' V' W'.
Proof.
  intros Hn Hd Hx Hw E Hf Hh.
  assert (Hr : 0 <= x' <= det' \/ det' <= x' <= 0).
  { destruct (hit_signs _ _ _ _ Hh E) as [S|S]; destruct Hw as [-> |[-> | ->]]; lra. }
  assert (A : forall y Y, Rabs y <= Y -> - Y <= y <= Y) by (intros; split_Rabs; lra).
  apply A in Hd. apply A in Hx. unfold front, sign_bit in *. destruct neg; lra.
Qed.

(** If all three are above the bounds, the line meets the triangle. [EXACT-6] *)
Theorem hit_is_certain neg U V W det' U' V' W' b :
  Rabs (U - U') <= b -> Rabs (V - V') <= b -> Rabs (W - W') <= b -> W' = det' - U' - V' ->
  b < front neg U -> b < front neg V -> b < front neg W -> hit det' U' V' W'.
Proof.
  intros HU HV HW E FU FV FW.
  assert (A : forall y Y, Rabs y <= Y -> - Y <= y <= Y) by (intros; split_Rabs; lra).
  apply A in HU. apply A in HV. apply A in HW. unfold front in *.
  assert (P : forall x y, 0 < y -> 0 < x -> 0 <= x / y) by (intros; apply Rlt_le, Rdiv_lt_0_compat; assumption).
  assert (Q : forall x y, y < 0 -> x < 0 -> 0 <= x / y).
  { intros. replace (x / y) with ((- x) / (- y)) by (field; lra). apply P; lra. }
  destruct neg.
  - assert (det' < 0) by lra. split; [lra|]. repeat split; apply Q; lra.
  - assert (0 < det') by lra. split; [lra|]. repeat split; apply P; lra.
Qed.

End Errors.
