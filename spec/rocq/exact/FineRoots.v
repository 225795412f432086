(** Square roots of src/geom/fine.rs. *)
Require Import Reals ZArith Lia Lra Psatz.
From Flocq Require Import Core Mult_error Pff2Flocq.
Require Import StacklessExact.Rounding StacklessExact.Range StacklessExact.Expansion StacklessExact.Fine StacklessExact.FineSums StacklessExact.FineProducts.
Require Import StacklessExact.FineQuotients.
Open Scope R_scope.

Local Instance prec_53 : Prec_gt_0 53 := eq_refl.
Notation u := (bpow radix2 (-53)).
Notation eta := (bpow radix2 (-1074)).

(** * The code *)

Definition root_radius (r : R) (d : fine) (step : R) : R :=
  let spread := R64 (Rabs (low d) + radius d) in
  let part := R64 (R64 (Rabs (high d) + spread) / r) in
  R64 (R64 (R64 (R64 (spread / R64 (2 * r)) + R64 (R64 (part * part) / R64 (4 * r))) + R64 (Rabs step * EPSILON)) + UNDERFLOW).

(** Whether there is one, and the root. *)
Definition root (x : fine) : bool * fine :=
  let r := R64 (sqrt (high x)) in
  let d := sub x (mul (exact r) (exact r)) in
  let step := R64 (high d / R64 (2 * r)) in
  (orb (is_zero x) (andb (Rlt_bool (bpow radix2 (-800)) (high x)) (Rle_bool (radius x) (R64 (high x / 8)))),
    if is_zero x then Fine 0 0 0 else new r step (root_radius r d step)).

(** * The radius *)

(** The code's parts, of which underflow may take that of the square, if it is less than a part of the others. *)
Lemma parts_enough a b c x A B C S : 0 <= a -> 0 <= b -> 0 <= c -> F A -> F B -> F C -> 0 <= A -> 0 <= B -> 0 <= C ->
  a - 4 * (u * a) - 4 * eta <= A -> 2 * (u * c) - 2 * (u * (u * c)) - eta <= C -> (b <= B + 4 * eta \/ b <= / 2 * (u * (a + c)) + 4 * eta) -> x = a + b + u * c + 100 * eta ->
  S = R64 (R64 (R64 (A + B) + C) + UNDERFLOW) -> x <= R64 (S * UP).
Proof.
  intros Pa Pb Pc FA FB FC PA PB PC HA HC HB -> ->. pose proof Hu as U. pose proof eta_pos as Pe. assert (Fu : F UNDERFLOW) by (apply generic_format_bpow; unfold FLT_exp; lia). rewrite UNDERFLOW_is in *.
  assert (P1 : 0 <= A + B) by lra. pose proof (sum_low A B FA FB P1) as L1. pose proof (R64_pos _ P1) as Q1. set (s := R64 (A + B)) in *.
  assert (P2 : 0 <= s + C) by lra. pose proof (sum_low s C (F_R64 _) FC P2) as L2. pose proof (R64_pos _ P2) as Q2. set (t := R64 (s + C)) in *.
  assert (P3 : 0 <= t + 16384 * eta) by lra. pose proof (sum_low t _ (F_R64 _) Fu P3) as L3. pose proof (R64_pos _ P3) as Q3. set (v := R64 (t + 16384 * eta)) in *.
  assert (P4 : 0 <= v * UP) by (apply Rmult_le_pos; [exact Q3|rewrite UP_is; lra]). pose proof (product_low _ P4) as L4. apply Rle_trans with (2 := L4). rewrite UP_is.
  pose proof (small v Q3) as [v0 v1]. pose proof (small _ v0) as [v2 v3]. pose proof (small t Q2) as [t0 t1]. pose proof (small _ t0) as [t2 t3].
  pose proof (small s Q1) as [s0 s1]. pose proof (small _ s0) as [s2 s3]. pose proof (small A PA) as [A0 A1]. pose proof (small _ A0) as [A2 A3].
  pose proof (small B PB) as [B0 B1]. pose proof (small _ B0) as [B2 B3]. pose proof (small C PC) as [C0 C1]. pose proof (small _ C0) as [C2 C3].
  pose proof (small a Pa) as [a0 a1]. pose proof (small _ a0) as [a2 a3]. pose proof (small c Pc) as [c0 c1]. pose proof (small _ c0) as [c2 c3]. pose proof (small _ (Rlt_le _ _ Pe)) as [e0 e1]. pose proof (small _ e0) as [e2 e3].
  assert (X : v + 30 * (u * v) - eta <= v * (1 + 32 * u) * (1 - u) - / 2 * eta) by lra. apply Rle_trans with (2 := X).
  assert (V : t + 16384 * eta - u * t - 16384 * (u * eta) <= v) by lra. pose proof (u_times _ _ V) as V'. assert (V2 : t + 28 * (u * t) + 16000 * eta <= v + 30 * (u * v)) by lra.
  assert (T : s + C - u * s - u * C <= t) by lra. pose proof (u_times _ _ T) as T'. assert (T2 : s + 26 * (u * s) + C <= t + 28 * (u * t)) by lra.
  assert (W : A + B - u * A - u * B <= s) by lra. pose proof (u_times _ _ W) as W'. assert (W2 : A + 24 * (u * A) + B <= s + 26 * (u * s)) by lra.
  pose proof (u_times _ _ HA) as HA'. assert (A4 : a + 18 * (u * a) - 8 * eta <= A + 24 * (u * A)) by lra. destruct HB; lra.
Qed.

(** * What it stands for *)

Lemma F_times n x : (0 <= n)%Z -> F x -> F (x * bpow radix2 n).
Proof. intros N X. apply mult_bpow_pos_exact_FLT; assumption. Qed.

(** A root, by one that is near. *)
Lemma root_near v r : 0 < r -> 0 <= v -> 92 / 100 * r <= sqrt v -> Rabs (sqrt v - r - (v - r * r) / (2 * r)) <= (v - r * r) * (v - r * r) / (7 * (r * (r * r))).
Proof.
  intros P V S. set (s := sqrt v) in *. assert (E : v = s * s) by (unfold s; symmetry; now apply sqrt_sqrt). rewrite E. set (d := s * s - r * r).
  replace (s - r - d / (2 * r)) with (- (d * d / (2 * r * ((s + r) * (s + r))))) by (unfold d; field; split; lra). rewrite Rabs_Ropp.
  assert (Q : 0 <= d * d) by apply Rle_0_sqr. assert (B : 7 * (r * (r * r)) <= 2 * r * ((s + r) * (s + r))).
  { replace (7 * (r * (r * r))) with (2 * r * (35 / 10 * (r * r))) by field. apply Rmult_le_compat_l; [lra|]. apply Rle_trans with (192 / 100 * r * (192 / 100 * r)); [nra|]. apply Rmult_le_compat; lra. }
  assert (P3 : 0 < 7 * (r * (r * r))) by (repeat apply Rmult_lt_0_compat; lra).
  rewrite Rabs_pos_eq; [|apply Rmult_le_pos; [exact Q|apply Rlt_le, Rinv_0_lt_compat; lra]]. apply Rmult_le_compat_l; [exact Q|]. now apply Rinv_le.
Qed.

Lemma quotient_low a b : 0 <= a -> 0 < b -> a / b - u * (a / b) - / 2 * eta <= R64 (a / b).
Proof.
  intros A B. assert (P : 0 <= a / b) by (apply Rmult_le_pos; [exact A|apply Rlt_le, Rinv_0_lt_compat, B]). pose proof (product_low _ P). lra.
Qed.

(** Roots stand for the roots of all that the number stands for, and none is of a negative one. [NEAR-5] *)
Theorem root_stands x v : stands x v -> fst (root x) = true -> 0 <= v /\ stands (snd (root x)) (sqrt v).
Proof.
  intros X K. pose proof X as [(Xh & Xl & Xr & Xp & Xw) Xv]. unfold holds in Xv. unfold root in *. cbn [fst snd] in *. destruct (is_zero x) eqn:Z.
  { assert (v = 0) as -> by (destruct x; exact (zero_number _ _ _ _ Xw Xv Z)). rewrite sqrt_0. split; [lra|]. apply (exact_stands 0), generic_format_0. }
  cbn [orb] in K. apply andb_prop in K as [K1 K2]. apply ltb_true in K1. revert K2. destruct (Rle_bool_spec (radius x) (R64 (high x / 8))) as [K2|]; [intros _|discriminate].
  pose proof Hu as U. pose proof eta_pos as Pe. pose proof (bpow_gt_0 radix2 (-800)) as P800. set (h := high x) in *. assert (Ph : 0 < h) by lra.
  assert (Eh : eta <= / 1048576 * h). { apply Rle_trans with (/ 1048576 * bpow radix2 (-800)); [|lra]. change (/ 1048576) with (bpow radix2 (-20)). rewrite <- bpow_plus. apply bpow_le. lia. }
  rewrite (Rabs_pos_eq h) in Xw by lra. apply Rabs_le_inv in Xv as Xv'. apply Rabs_le_inv in Xw as Xw'. pose proof (small h ltac:(lra)) as [h0 h1]. pose proof (small _ h0) as [h2 h3].
  assert (Vl : 87 / 100 * h <= v). { pose proof (off (h / 8)) as O. rewrite (Rabs_pos_eq (h / 8)) in O by lra. apply Rabs_le_inv in O. lra. }
  split; [lra|]. set (r := R64 (sqrt h)) in *. set (m := mul (exact r) (exact r)). set (d := sub x m). set (step := R64 (high d / R64 (2 * r))).
  (* The root of the middle. *)
  assert (Sq : sqrt h * sqrt h = h) by (apply sqrt_sqrt; lra). assert (S400 : bpow radix2 (-400) < sqrt h).
  { apply Rsqr_incrst_0; [|apply bpow_ge_0|apply sqrt_pos]. unfold Rsqr. rewrite Sq, <- bpow_plus. exact K1. }
  pose proof (bpow_gt_0 radix2 (-400)) as P400. assert (R400 : bpow radix2 (-400) <= r) by (apply round_ge_generic; [typeclasses eauto..|apply generic_format_bpow; unfold FLT_exp; lia|lra]).
  assert (Pr : 0 < r) by lra. assert (Er : eta <= / 1048576 * r). { apply Rle_trans with (/ 1048576 * bpow radix2 (-400)); [|lra]. change (/ 1048576) with (bpow radix2 (-20)). rewrite <- bpow_plus. apply bpow_le. lia. }
  assert (Es : eta <= / 1048576 * sqrt h). { apply Rle_trans with (/ 1048576 * bpow radix2 (-400)); [|lra]. change (/ 1048576) with (bpow radix2 (-20)). rewrite <- bpow_plus. apply bpow_le. lia. }
  assert (Rs : 999 / 1000 * r <= sqrt h).
  { pose proof (off (sqrt h)) as O. fold r in O. rewrite (Rabs_pos_eq (sqrt h)) in O by apply sqrt_pos. apply Rabs_le_inv in O. pose proof (small (sqrt h) ltac:(lra)). lra. }
  assert (Sv : 92 / 100 * r <= sqrt v).
  { apply Rsqr_incr_0; [|lra|apply sqrt_pos]. unfold Rsqr. rewrite sqrt_sqrt by lra. apply Rle_trans with (2 := Vl). rewrite <- Sq.
    apply Rle_trans with (93 / 100 * sqrt h * (93 / 100 * sqrt h)); [apply Rmult_le_compat; lra|]. assert (0 <= sqrt h * sqrt h) by (apply Rmult_le_pos; lra). lra. }
  pose proof (root_near v r Pr ltac:(lra) Sv) as N. assert (Fr : F r) by apply F_R64.
  assert (Dst : stands d (v - r * r)) by (apply sub_stands; [exact X|]; apply mul_stands; now apply exact_stands). set (dd := v - r * r) in *.
  destruct Dst as [(Dh & Dl & Dr & Dp & _) Dv]. unfold holds in Dv.
  (* Twice and four times the root are doubles. *)
  assert (F2 : R64 (2 * r) = 2 * r). { apply R64_id. replace (2 * r) with (r * bpow radix2 1) by (change (bpow radix2 1) with 2; ring). apply F_times; [lia|exact Fr]. }
  assert (F4 : R64 (4 * r) = 4 * r). { apply R64_id. replace (4 * r) with (r * bpow radix2 2) by (change (bpow radix2 2) with 4; ring). apply F_times; [lia|exact Fr]. }
  assert (Est : step = R64 (high d / (2 * r))) by (unfold step; now rewrite F2). unfold root_radius. rewrite F2, F4. clearbody step. set (sp := Rabs (low d) + radius d). assert (Psp : 0 <= sp) by (pose proof (Rabs_pos (low d)); unfold sp; lra).
  pose proof (sum_low _ _ (F_abs _ Dl) Dr Psp) as L1. fold sp in L1. pose proof (R64_pos _ Psp) as Q1. set (spread := R64 sp) in *.
  assert (Pre : 0 <= Rabs (high d) + spread) by (pose proof (Rabs_pos (high d)); lra). pose proof (sum_low _ _ (F_abs _ Dh) (F_R64 sp) Pre) as L2. fold spread in L2. pose proof (R64_pos _ Pre) as Q2.
  set (reach := R64 (Rabs (high d) + spread)) in *. pose proof (quotient_low reach r Q2 Pr) as L3. set (part := R64 (reach / r)) in *.
  assert (Ppart : 0 <= part) by (apply R64_pos, Rmult_le_pos; [exact Q2|apply Rlt_le, Rinv_0_lt_compat, Pr]). assert (Pi : 0 < / r) by now apply Rinv_0_lt_compat.
  assert (Pk : 0 <= part * part) by now apply Rmult_le_pos. pose proof (product_low _ Pk) as L4. pose proof (R64_pos _ Pk) as Q4. set (square := R64 (part * part)) in *.
  pose proof (quotient_low spread (2 * r) Q1 ltac:(lra)) as L5. pose proof (quotient_low square (4 * r) Q4 ltac:(lra)) as L6.
  assert (PA : 0 <= R64 (spread / (2 * r))) by (apply R64_pos, Rmult_le_pos; [exact Q1|apply Rlt_le, Rinv_0_lt_compat; lra]).
  assert (PB : 0 <= R64 (square / (4 * r))) by (apply R64_pos, Rmult_le_pos; [exact Q4|apply Rlt_le, Rinv_0_lt_compat; lra]).
  assert (PC : 0 <= R64 (Rabs step * EPSILON)) by (apply R64_pos, Rmult_le_pos; [apply Rabs_pos|apply bpow_ge_0]).
  set (A := R64 (spread / (2 * r))) in *. set (B := R64 (square / (4 * r))) in *. set (C := R64 (Rabs step * EPSILON)) in *.
  (* The three terms of the error. *)
  set (a := sp / (2 * r)). set (b := dd * dd / (7 * (r * (r * r)))). set (c := Rabs step).
  assert (Pa : 0 <= a) by (apply Rmult_le_pos; [exact Psp|apply Rlt_le, Rinv_0_lt_compat; lra]). assert (P3 : 0 < r * (r * r)) by (apply Rmult_lt_0_compat; [exact Pr|apply Rmult_lt_0_compat; exact Pr]).
  assert (Pb : 0 <= b) by (apply Rmult_le_pos; [apply Rle_0_sqr|apply Rlt_le, Rinv_0_lt_compat; lra]). assert (Pc : 0 <= c) by apply Rabs_pos.
  assert (HA : a - 4 * (u * a) - 4 * eta <= A).
  { assert (G : a - u * a <= spread / (2 * r)). { replace (a - u * a) with (sp * (1 - u) * / (2 * r)) by (unfold a; field; lra). apply Rmult_le_compat_r; [apply Rlt_le, Rinv_0_lt_compat; lra|exact L1]. }
    assert (G' : (a - u * a) * (1 - u) <= spread / (2 * r) * (1 - u)) by (apply Rmult_le_compat_r; lra). pose proof (small a Pa) as [a0 a1]. pose proof (small _ a0) as [a2 a3]. lra. }
  assert (HC : 2 * (u * c) - 2 * (u * (u * c)) - eta <= C).
  { assert (P : 0 <= c * EPSILON) by (apply Rmult_le_pos; [exact Pc|apply bpow_ge_0]). pose proof (product_low _ P) as H. change (R64 (c * EPSILON)) with C in H. rewrite EPSILON_is in H. lra. }
  assert (Step : Rabs (high d / (2 * r) - step) <= u * c + eta).
  { destruct (Rle_or_lt (bpow radix2 (-1022)) (Rabs (high d / (2 * r)))) as [G|G]; [pose proof (off_big _ G) as G'; rewrite <- Est in G'; unfold c; lra|].
    pose proof (off (high d / (2 * r))) as O. rewrite <- Est in O. assert (u * Rabs (high d / (2 * r)) <= / 2 * eta).
    { apply Rlt_le in G. apply u_times in G. rewrite <- bpow_plus in G. replace (/ 2 * eta) with (bpow radix2 (-53 + -1022)); [exact G|].
      change (-53 + -1022)%Z with (-1 + -1074)%Z. rewrite bpow_plus. reflexivity. }
    assert (0 <= u * c) by (apply Rmult_le_pos; lra). lra. }
  assert (Whole : Rabs (sqrt v - r - step) <= a + b + u * c + 100 * eta).
  { replace (sqrt v - r - step) with ((sqrt v - r - dd / (2 * r)) + ((dd - high d - low d + low d) / (2 * r) + (high d / (2 * r) - step))) by (field; lra).
    eapply Rle_trans; [apply tri|]. eapply Rle_trans; [apply Rplus_le_compat_l, tri|]. fold b in N.
    assert (Rabs ((dd - high d - low d + low d) / (2 * r)) <= a).
    { unfold Rdiv. rewrite Rabs_mult, (Rabs_pos_eq (/ (2 * r))) by (apply Rlt_le, Rinv_0_lt_compat; lra). apply Rmult_le_compat_r; [apply Rlt_le, Rinv_0_lt_compat; lra|].
      eapply Rle_trans; [apply tri|]. unfold sp. lra. }
    lra. }
  assert (Dd : Rabs dd <= Rabs (high d) + sp).
  { replace dd with (high d + (dd - high d - low d + low d)) by ring. eapply Rle_trans; [apply tri|]. pose proof (tri (dd - high d - low d) (low d)). unfold sp. lra. }
  set (g := Rabs (high d) + sp) in *. assert (Pg : 0 <= g) by (pose proof (Rabs_pos (high d)); unfold g; lra).
  assert (Re : g - 4 * (u * g) <= reach).
  { assert (H : (Rabs (high d) + sp * (1 - u)) * (1 - u) <= (Rabs (high d) + spread) * (1 - u)) by (apply Rmult_le_compat_r; lra).
    pose proof (small g Pg) as [g0 g1]. pose proof (small _ g0) as [g2 g3]. pose proof (small sp Psp) as [s0 s1]. pose proof (small _ s0) as [s2 s3].
    pose proof (small _ (Rabs_pos (high d))) as [d0 d1]. unfold g in *. lra. }
  assert (Db : b <= (g / r) * (g / r) / (7 * r)).
  { replace ((g / r) * (g / r) / (7 * r)) with (g * g / (7 * (r * (r * r)))) by (field; lra). apply Rmult_le_compat_r; [apply Rlt_le, Rinv_0_lt_compat; lra|].
    rewrite <- (Rabs_pos_eq (dd * dd)) by apply Rle_0_sqr. rewrite Rabs_mult. apply Rmult_le_compat; auto using Rabs_pos. }
  assert (Pq : 0 <= g / r) by (apply Rmult_le_pos; lra). set (q := g / r) in *.
  assert (Qr : q - 4 * (u * q) <= reach / r). { replace (q - 4 * (u * q)) with ((g - 4 * (u * g)) * / r) by (unfold q; field; lra). apply Rmult_le_compat_r; lra. }
  pose proof (small q Pq) as [q0 q1]. pose proof (small _ q0) as [q2 q3].
  assert (Part : q - 6 * (u * q) - / 2 * eta <= part).
  { assert ((q - 4 * (u * q)) * (1 - u) <= reach / r * (1 - u)) by (apply Rmult_le_compat_r; lra). lra. }
  assert (HB : b <= B + 4 * eta \/ b <= / 2 * (u * (a + c)) + 4 * eta).
  { destruct (Rle_or_lt (bpow radix2 (-511)) part) as [G|G]; [left|right].
    - assert (E1 : eta <= / 1048576 * part). { apply Rle_trans with (/ 1048576 * bpow radix2 (-511)); [|lra]. change (/ 1048576) with (bpow radix2 (-20)). rewrite <- bpow_plus. apply bpow_le. lia. }
      assert (E2 : eta <= / 1024 * (part * part)).
      { apply Rle_trans with (/ 1024 * (bpow radix2 (-511) * bpow radix2 (-511))); [rewrite <- bpow_plus; change (/ 1024) with (bpow radix2 (-10)); rewrite <- bpow_plus; apply bpow_le; lia|].
        apply Rmult_le_compat_l; [lra|]. apply Rmult_le_compat; try apply bpow_ge_0; exact G. }
      assert (Q9 : 99 / 100 * q <= part) by lra. assert (S9 : 98 / 100 * (q * q) <= part * part).
      { pose proof (Rmult_le_pos _ _ Pq Pq) as Pqq. apply Rle_trans with (99 / 100 * q * (99 / 100 * q)); [lra|]. apply Rmult_le_compat; lra. }
      pose proof (small _ Pk) as [k0 k1]. assert (Sq9 : 9 / 10 * (q * q) <= square) by lra.
      assert (H : 9 / 10 * (q * q) / (4 * r) <= square / (4 * r)) by (apply Rmult_le_compat_r; [apply Rlt_le, Rinv_0_lt_compat; lra|exact Sq9]).
      replace (9 / 10 * (q * q) / (4 * r)) with (63 / 40 * (q * q / (7 * r))) in H by (field; lra). assert (P : 0 <= square / (4 * r)) by (apply Rmult_le_pos; [exact Q4|apply Rlt_le, Rinv_0_lt_compat; lra]).
      pose proof (small _ P) as [p0 p1]. lra.
    - assert (Qs : q <= bpow radix2 (-510)).
      { assert (E1 : eta <= / 1048576 * bpow radix2 (-511)) by (change (/ 1048576) with (bpow radix2 (-20)); rewrite <- bpow_plus; apply bpow_le; lia).
        change (-510)%Z with (1 + -511)%Z. rewrite bpow_plus. change (bpow radix2 1) with 2. lra. }
      (* The square is next to nothing beside what is rounded of the step. *)
      assert (Qu : q * / r <= u).
      { apply Rle_trans with (bpow radix2 (-510) * bpow radix2 400); [|rewrite <- bpow_plus; apply bpow_le; lia]. apply Rmult_le_compat; [exact Pq|lra|exact Qs|].
        change 400%Z with (- -400)%Z. rewrite bpow_opp. now apply Rinv_le. }
      assert (H : q * q / (7 * r) <= 2 / 7 * (u * (g / (2 * r)))).
      { replace (q * q / (7 * r)) with (2 / 7 * ((q * / r) * (g / (2 * r)))) by (unfold q; field; lra). apply Rmult_le_compat_l; [lra|]. apply Rmult_le_compat_r; [|exact Qu].
        apply Rmult_le_pos; [exact Pg|apply Rlt_le, Rinv_0_lt_compat; lra]. }
      assert (Gs : g / (2 * r) <= a + c + u * c + eta).
      { replace (g / (2 * r)) with (Rabs (high d) * / (2 * r) + a) by (unfold g, a; field; lra). rewrite <- (Rabs_pos_eq (/ (2 * r))) by (apply Rlt_le, Rinv_0_lt_compat; lra). rewrite <- Rabs_mult.
        change (high d * / (2 * r)) with (high d / (2 * r)). pose proof (tri (high d / (2 * r) - step) step) as T. replace (high d / (2 * r) - step + step) with (high d / (2 * r)) in T by ring. fold c in T. lra. }
      apply u_times in Gs. pose proof (small c Pc) as [c0 c1]. pose proof (small _ c0) as [c2 c3]. pose proof (small a Pa) as [a0 a1]. pose proof (small _ (Rlt_le _ _ Pe)) as [e0 e1]. lra. }
  apply new_stands; [exact Fr|rewrite Est; apply F_R64|apply F_R64|apply R64_pos, Rplus_le_le_0_compat; [|apply bpow_ge_0]|].
  - apply R64_pos, Rplus_le_le_0_compat; [apply R64_pos; lra|exact PC].
  - apply Rle_trans with (1 := Whole). apply (parts_enough a b c _ A B C _ Pa Pb Pc); try assumption; try apply F_R64; reflexivity.
Qed.
