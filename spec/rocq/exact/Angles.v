(** The angles of src/geom/fan.rs (Van Oosterom & Strackee 1983): WINDING-1, up to whole turns. *)
Require Import Reals Lra.
Require Import StacklessExact.Filter StacklessExact.Parity StacklessExact.Chains StacklessExact.Fans.
Open Scope R_scope.

(** The cosine and the sine of half the solid angle of three vectors of length 1, times one positive number. *)
Definition bottom (u v w : vec) : R := 1 + dot3 u v + dot3 v w + dot3 w u.
Definition top (u v w : vec) : R := vol u v w.
Definition half_angle (u v w : vec) (t : R) : Prop := exists r, 0 < r /\ bottom u v w = r * cos t /\ top u v w = r * sin t.

Section Four.
Variables a b c f : vec.
Hypothesis La : dot3 a a = 1.
Hypothesis Lb : dot3 b b = 1.
Hypothesis Lc : dot3 c c = 1.
Hypothesis Lf : dot3 f f = 1.
Let k : R := 2 * (1 + dot3 f a) * (1 + dot3 f b) * (1 + dot3 f c).

Lemma real_part : bottom f a b * bottom f b c * bottom f c a - bottom f a b * (top f b c * top f c a) - bottom f b c * (top f a b * top f c a) -
  bottom f c a * (top f a b * top f b c) = k * bottom a b c.
Proof.
  set (p := dot3 a b). set (q := dot3 b c). set (r := dot3 c a). set (x := dot3 f a). set (y := dot3 f b). set (z := dot3 f c).
  assert (BC : top f b c * top f c a = 1 * (q * r - p * 1) - z * (y * r - z * p) + x * (y * 1 - z * q)).
  { transitivity (dot3 f f * (q * r - p * dot3 c c) - z * (y * r - z * p) + x * (y * dot3 c c - z * q)); [unfold top, p, q, r, x, y, z; volumes; ring|rewrite Lf, Lc; ring]. }
  assert (AC : top f a b * top f c a = 1 * (r * p - 1 * q) - z * (x * p - 1 * y) + x * (x * q - r * y)).
  { transitivity (dot3 f f * (r * p - dot3 a a * q) - z * (x * p - dot3 a a * y) + x * (x * q - r * y)); [unfold top, p, q, r, x, y, z; volumes; ring|rewrite Lf, La; ring]. }
  assert (AB : top f a b * top f b c = 1 * (p * q - r * 1) - y * (x * q - r * y) + z * (x * 1 - p * y)).
  { transitivity (dot3 f f * (p * q - r * dot3 b b) - y * (x * q - r * y) + z * (x * dot3 b b - p * y)); [unfold top, p, q, r, x, y, z; volumes; ring|rewrite Lf, Lb; ring]. }
  rewrite BC, AC, AB.
  (* Four vectors of three components have a Gram determinant of 0. *)
  assert (G : x * x * q * q - x * x + 2 * x * y * p - 2 * x * y * q * r - 2 * x * z * p * q + 2 * x * z * r + y * y * r * r - y * y - 2 * y * z * p * r + 2 * y * z * q + z * z * p * p - z * z - p * p + 2 * p * q * r - q * q - r * r + 1 = 0).
  { transitivity (x * x * q * q - x * x * (dot3 b b * dot3 c c) + 2 * x * y * p * dot3 c c - 2 * x * y * q * r - 2 * x * z * p * q + 2 * x * z * r * dot3 b b + y * y * r * r - y * y * (dot3 a a * dot3 c c) - 2 * y * z * p * r + 2 * y * z * q * dot3 a a +
      z * z * p * p - z * z * (dot3 a a * dot3 b b) - p * p * (dot3 c c * dot3 f f) + 2 * p * q * r * dot3 f f - q * q * (dot3 a a * dot3 f f) - r * r * (dot3 b b * dot3 f f) + dot3 a a * dot3 b b * dot3 c c * dot3 f f).
    - rewrite La, Lb, Lc, Lf. ring.
    - unfold p, q, r, x, y, z. volumes. ring. }
  unfold bottom, k. replace (dot3 b f) with y by (unfold y; vectors; ring). replace (dot3 c f) with z by (unfold z; vectors; ring). replace (dot3 a f) with x by (unfold x; vectors; ring). fold p q r x y z. clearbody p q r x y z. clear -G.
  match goal with |- ?l = ?m => enough (l - m = 0) by lra end. rewrite <- Ropp_0. rewrite <- G. ring.
Qed.

Lemma imaginary_part : top f a b * (bottom f b c * bottom f c a) + top f b c * (bottom f a b * bottom f c a) + top f c a * (bottom f a b * bottom f b c) -
  top f a b * top f b c * top f c a = k * top a b c.
Proof.
  set (p := dot3 a b). set (q := dot3 b c). set (r := dot3 c a). set (x := dot3 f a). set (y := dot3 f b). set (z := dot3 f c).
  assert (BC : top f b c * top f c a = 1 * (q * r - p * 1) - z * (y * r - z * p) + x * (y * 1 - z * q)).
  { transitivity (dot3 f f * (q * r - p * dot3 c c) - z * (y * r - z * p) + x * (y * dot3 c c - z * q)); [unfold top, p, q, r, x, y, z; volumes; ring|rewrite Lf, Lc; ring]. }
  rewrite Rmult_assoc, BC. set (A := top f a b). set (B := top f b c). set (C := top f c a). set (D := top a b c).
  assert (R0 : D - (B * x + C * y + A * z) = 0) by (rewrite <- (Rmult_1_r D), <- Lf; unfold A, B, C, D, top, x, y, z; volumes; ring).
  assert (R1 : D * x - (B + C * p + A * r) = 0) by (rewrite <- (Rmult_1_r B), <- La; unfold A, B, C, D, top, x, p, r; volumes; ring).
  assert (R2 : D * y - (B * p + C + A * q) = 0) by (rewrite <- (Rmult_1_r C), <- Lb; unfold A, B, C, D, top, y, p, q; volumes; ring).
  assert (R3 : D * z - (B * r + C * q + A) = 0) by (rewrite <- (Rmult_1_r A) at 1; rewrite <- Lc; unfold A, B, C, D, top, z, q, r; volumes; ring).
  unfold bottom, k. replace (dot3 b f) with y by (unfold y; vectors; ring). replace (dot3 c f) with z by (unfold z; vectors; ring). replace (dot3 a f) with x by (unfold x; vectors; ring). fold p q r x y z.
  clearbody p q r x y z A B C D. clear -R0 R1 R2 R3. match goal with |- ?l = ?m => enough (l - m = 0) by lra end.
  transitivity ((- x - y + z * p - z - 2) * (D - (B * x + C * y + A * z)) - (y + 1) * (z + 1) * (D * x - (B + C * p + A * r)) - (x + 1) * (z + 1) * (D * y - (B * p + C + A * q)) + (- x - y - p - 1) * (D * z - (B * r + C * q + A))); [ring|].
  rewrite R0, R1, R2, R3. ring.
Qed.

(** The angle of a triangle, and those of the fan from f to its edges, differ by whole turns: halves by multiples of 2 pi. [WINDING-1](2) *)
Theorem angles_add_up t t1 t2 t3 : half_angle a b c t -> half_angle f a b t1 -> half_angle f b c t2 -> half_angle f c a t3 ->
  0 < 1 + dot3 f a -> 0 < 1 + dot3 f b -> 0 < 1 + dot3 f c -> cos (t1 + t2 + t3 - t) = 1.
Proof.
  intros (r & P & X & Y) (r1 & P1 & X1 & Y1) (r2 & P2 & X2 & Y2) (r3 & P3 & X3 & Y3) Ka Kb Kc. pose proof real_part as Re. pose proof imaginary_part as Im.
  rewrite X, X1, X2, X3, Y1, Y2, Y3 in Re. rewrite Y, X1, X2, X3, Y1, Y2, Y3 in Im. assert (K : 0 < k) by (unfold k; repeat apply Rmult_lt_0_compat; lra).
  set (s := t1 + t2 + t3). assert (Cs : cos s = cos t1 * cos t2 * cos t3 - cos t1 * (sin t2 * sin t3) - cos t2 * (sin t1 * sin t3) - cos t3 * (sin t1 * sin t2)) by (unfold s; rewrite !cos_plus, sin_plus; ring).
  assert (Ss : sin s = sin t1 * (cos t2 * cos t3) + sin t2 * (cos t1 * cos t3) + sin t3 * (cos t1 * cos t2) - sin t1 * sin t2 * sin t3) by (unfold s; rewrite !sin_plus, cos_plus; ring).
  set (m := r1 * r2 * r3). assert (M : 0 < m) by (unfold m; repeat apply Rmult_lt_0_compat; assumption).
  assert (E1 : m * cos s = k * r * cos t) by (rewrite Cs; unfold m; rewrite (Rmult_assoc k), <- Re; ring). assert (E2 : m * sin s = k * r * sin t) by (rewrite Ss; unfold m; rewrite (Rmult_assoc k), <- Im; ring).
  pose proof (sin2_cos2 s) as Os. pose proof (sin2_cos2 t) as Ot. unfold Rsqr in Os, Ot. assert (N : 0 < k * r) by now apply Rmult_lt_0_compat. set (n := k * r) in *. clearbody m n.
  assert (Q : m * m = n * n).
  { transitivity (m * sin s * (m * sin s) + m * cos s * (m * cos s)); [transitivity (m * m * (sin s * sin s + cos s * cos s)); [rewrite Os|]; ring|]. rewrite E1, E2. transitivity (n * n * (sin t * sin t + cos t * cos t)); [|rewrite Ot]; ring. }
  assert (m = n) by (apply Rsqr_inj; [lra|lra|exact Q]). subst n. rewrite cos_minus. assert (cos s = cos t) by (apply Rmult_eq_reg_l with m; lra). assert (sin s = sin t) by (apply Rmult_eq_reg_l with m; lra).
  rewrite H, H0. lra.
Qed.

(** In the other direction an edge has the opposite angle. [WINDING-1] *)
Theorem angle_turns t : half_angle f a b t -> half_angle f b a (- t).
Proof.
  intros (r & P & X & Y). exists r. split; [exact P|]. rewrite cos_neg, sin_neg. split; [rewrite <- X; unfold bottom; vectors; ring|]. transitivity (- top f a b); [unfold top; volumes; ring|rewrite Y; ring].
Qed.
End Four.
