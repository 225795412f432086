(** [Determinants::over_determinant] of src/geom/kernel/exact/filter.rs: the true quotient lies between the ends, for determinants of
    either sign; and for what [is_hit] lets pass, the determinant is as great as that takes. Relative errors only, as in
    Filter.v. *)
Require Import Reals ZArith Lia Lra Psatz.
From Flocq Require Import Core.
Require Import StacklessExact.Rounding StacklessExact.Triple StacklessExact.Filter.
Open Scope R_scope.

(** A quotient of numbers that are off, before any rounding. [EXACT-9] *)
Lemma true_quotient det det' T T' dT dd : 0 < det -> 0 <= dd -> 15 / 2 * dd <= det ->
  Rabs (T - T') <= dT -> Rabs (det - det') <= dd ->
  Rabs (T' / det' - T / det) <= 15 / 13 * ((dT + Rabs (T / det) * dd) * / det).
Proof.
  intros Hd Hdd Hq HT HD. assert (Ip : 0 < / det) by (apply Rinv_0_lt_compat, Hd).
  pose proof (pos_b _ _ HT) as PT.
  assert (L : 13 / 15 * det <= det') by (apply Rabs_le_inv in HD; lra).
  assert (P : 0 < det') by lra.
  replace (T' / det' - T / det) with (((T' - T) + T / det * (det - det')) * / det') by (field; lra).
  assert (N : Rabs ((T' - T) + T / det * (det - det')) <= dT + Rabs (T / det) * dd).
  { apply add_b; [now rewrite Rabs_minus_sym|apply mul_b; [apply Rle_refl|assumption]]. }
  rewrite Rabs_mult, (Rabs_pos_eq (/ det')) by (apply Rlt_le, Rinv_0_lt_compat, P).
  assert (I : / det' <= 15 / 13 * / det).
  { replace (15 / 13 * / det) with (/ (13 / 15 * det)) by (field; lra). apply Rinv_le; lra. }
  set (n := dT + Rabs (T / det) * dd) in *. assert (0 <= n) by (pose proof (Rabs_pos ((T' - T) + T / det * (det - det'))); lra).
  apply Rle_trans with (n * (15 / 13 * / det)); [|right; ring].
  apply Rmult_le_compat; try assumption; [apply Rabs_pos|]. apply Rlt_le, Rinv_0_lt_compat, P.
Qed.

Section Quotient.
Variable prec : Z.
Context { prec_pos : Prec_gt_0 prec }.
Hypothesis prec_11 : (11 <= prec)%Z.
Notation RN := (round radix2 (FLX_exp prec) ZnearestE).
Notation u := (Rounding.unit prec).

Let Hu : 0 < u <= / 2048 := Hu prec prec_11.
Let rel := rel prec prec_11.
Notation below := (below prec prec_11).
Notation pos := (RN_pos prec prec_11).

Lemma enclosure_positive det det' T T' dT dd et ed : 0 < det -> 0 <= dd -> 15 / 2 * dd <= det ->
  Rabs (T - T') <= dT -> Rabs (det - det') <= dd -> 5 / 4 * dT <= et -> 5 / 4 * dd <= ed ->
  let r := RN (1 / det) in let q := RN (T * r) in
  let e := RN (RN (RN (et + RN (Rabs q * ed)) * Rabs r) + RN (Rabs q * (4 * u))) in
  RN (q - e) <= T' / det' <= RN (q + e).
Proof.
  intros Hd Hdd H75 HT HD Het Hed r q. pose proof Hu as U.
  pose proof (true_quotient det det' T T' dT dd Hd Hdd H75 HT HD) as TQ.
  pose proof (pos_b _ _ HT) as PT.
  set (x := T / det) in *. set (i := / det) in *. assert (Ip : 0 < i) by (apply Rinv_0_lt_compat, Hd).
  destruct (rel (1 / det)) as (a & Ha & Er). fold r in Er. destruct (rel (T * r)) as (b & Hb & Eq). fold q in Eq.
  apply Rabs_le_inv in Ha. apply Rabs_le_inv in Hb.
  assert (Er' : r = i * (1 + a)) by (rewrite Er; unfold i, Rdiv; ring).
  assert (Rp : 0 < r) by (rewrite Er'; apply Rmult_lt_0_compat; lra).
  assert (Ei : i * (1 - u) <= r) by (rewrite Er'; apply Rmult_le_compat_l; lra).
  assert (Eq' : q = x * ((1 + a) * (1 + b))) by (rewrite Eq, Er'; unfold x, i, Rdiv; ring).
  set (m := (1 + a) * (1 + b)) in *.
  assert (Hm : (1 - u) * (1 - u) <= m <= (1 + u) * (1 + u)) by (unfold m; split; apply Rmult_le_compat; lra).
  clearbody m. set (Q := Rabs q). set (X := Rabs x).
  assert (EQ : Q = X * m) by (unfold Q; rewrite Eq', Rabs_mult, (Rabs_pos_eq m); [reflexivity|nra]).
  assert (PX : 0 <= X) by apply Rabs_pos. assert (PQ : 0 <= Q) by apply Rabs_pos.
  assert (HX : X * (1 - 2 * u) <= Q) by (rewrite EQ; apply Rmult_le_compat_l; [assumption|nra]).
  assert (HXQ : Rabs (q - x) <= X * (2 * u + u * u)).
  { rewrite Eq'. replace (x * m - x) with (x * (m - 1)) by ring. rewrite Rabs_mult.
    apply Rmult_le_compat_l; [assumption|]. apply Rabs_le. nra. }
  (* The error term from below. *)
  set (A := dT * i) in *. set (B := dd * i) in *.
  assert (PA : 0 <= A) by (apply Rmult_le_pos; lra). assert (PB : 0 <= B) by (apply Rmult_le_pos; lra).
  assert (Ped : 0 <= ed) by lra. assert (Pet : 0 <= et) by lra.
  assert (G1 := below (Q * ed) (Rmult_le_pos _ _ PQ Ped)). set (g1 := RN (Q * ed)) in *.
  assert (P1 : 0 <= g1) by (apply pos, Rmult_le_pos; assumption).
  assert (G2 := below (et + g1) ltac:(lra)). set (g2 := RN (et + g1)) in *.
  assert (P2 : 0 <= g2) by (apply pos; lra).
  assert (Ra : Rabs r = r) by (apply Rabs_pos_eq; lra).
  assert (G3 := below (g2 * r) (Rmult_le_pos _ _ P2 (Rlt_le _ _ Rp))). set (g3 := RN (g2 * r)) in *.
  assert (P3 : 0 <= g3) by (apply pos, Rmult_le_pos; lra).
  assert (G4 := below (Q * (4 * u)) ltac:(apply Rmult_le_pos; lra)). set (g4 := RN (Q * (4 * u))) in *.
  assert (P4 : 0 <= g4) by (apply pos, Rmult_le_pos; lra).
  assert (G5 := below (g3 + g4) ltac:(lra)).
  rewrite Ra. fold Q g1 g2 g3 g4. set (e := RN (g3 + g4)) in *. cbv zeta. clearbody e g1 g2 g3 g4.
  assert (PBQ : 0 <= B * Q) by (apply Rmult_le_pos; assumption).
  assert (Z : 0 <= 1 - u) by lra. assert (ui : i * (1 - u) * (1 - u) <= r * (1 - u)) by (apply Rmult_le_compat_r; assumption).
  assert (K1 : 5 / 4 * (1 - 2 * u) * (dT + dd * Q) <= g2).
  { eapply Rle_trans; [|exact G2]. apply Rle_trans with ((5 / 4 * dT + 5 / 4 * dd * Q * (1 - u)) * (1 - u)).
    - assert (0 <= dd * Q) by (apply Rmult_le_pos; assumption). assert (0 <= dT * u) by (apply Rmult_le_pos; lra).
      assert (0 <= dd * Q * (u * u)) by (apply Rmult_le_pos; [assumption|apply Rmult_le_pos; lra]). lra.
    - apply Rmult_le_compat_r; [assumption|]. apply Rplus_le_compat; [assumption|]. eapply Rle_trans; [|exact G1].
      apply Rmult_le_compat_r; [assumption|]. replace (5 / 4 * dd * Q) with (Q * (5 / 4 * dd)) by ring.
      apply Rmult_le_compat_l; assumption. }
  assert (PdQ : 0 <= dT + dd * Q) by (apply Rplus_le_le_0_compat; [assumption|apply Rmult_le_pos; assumption]).
  assert (K2 : 5 / 4 * (1 - 4 * u) * (A + B * Q) <= g3).
  { eapply Rle_trans; [|exact G3].
    apply Rle_trans with (5 / 4 * (1 - 2 * u) * (dT + dd * Q) * (i * (1 - u)) * (1 - u)).
    - replace (5 / 4 * (1 - 2 * u) * (dT + dd * Q) * (i * (1 - u)) * (1 - u)) with
        (5 / 4 * ((1 - 2 * u) * ((1 - u) * (1 - u))) * (A + B * Q)) by (unfold A, B; ring).
      apply Rmult_le_compat_r; [lra|]. apply Rmult_le_compat_l; [lra|]. clear - U. nra.
    - apply Rmult_le_compat_r; [assumption|]. apply Rmult_le_compat; try assumption.
      + apply Rmult_le_pos; [|assumption]. lra.
      + apply Rmult_le_pos; lra. }
  assert (K3 : (5 / 4 * (1 - 4 * u) * (A + B * Q) + Q * (4 * u) * (1 - u)) * (1 - u) <= e).
  { eapply Rle_trans; [|exact G5]. apply Rmult_le_compat_r; [assumption|]. lra. }
  (* What it has to cover. *)
  assert (TQ' : Rabs (T' / det' - x) <= 15 / 13 * (A + B * X)).
  { eapply Rle_trans; [exact TQ|]. right. unfold A, B, X. ring. }
  assert (HBX : B * X <= B * Q * (1 + 3 * u)).
  { rewrite Rmult_assoc. apply Rmult_le_compat_l; [assumption|]. apply Rmult_le_reg_r with (1 - 2 * u); [lra|].
    eapply Rle_trans; [exact HX|]. rewrite Rmult_assoc. rewrite <- (Rmult_1_r Q) at 1. apply Rmult_le_compat_l; [assumption|]. clear - U. nra. }
  assert (HX2 : X * (2 * u + u * u) <= Q * (2 * u + 10 * u * u)).
  { apply Rmult_le_reg_r with (1 - 2 * u); [lra|].
    apply Rle_trans with (Q * (2 * u + u * u)).
    - replace (X * (2 * u + u * u) * (1 - 2 * u)) with (X * (1 - 2 * u) * (2 * u + u * u)) by ring.
      apply Rmult_le_compat_r; [clear - U; nra|exact HX].
    - replace (Q * (2 * u + 10 * u * u) * (1 - 2 * u)) with (Q * ((2 * u + 10 * u * u) * (1 - 2 * u))) by ring.
      apply Rmult_le_compat_l; [assumption|]. clear - U. nra. }
  assert (Pe : 0 <= e).
  { eapply Rle_trans; [|exact G5]. apply Rmult_le_pos; lra. }
  assert (Main : 15 / 13 * (A + B * X) + X * (2 * u + u * u) + u * (Q + e) <= e).
  { set (bq := B * Q) in *. clearbody A bq Q.
    apply Rle_trans with (15 / 13 * (A + bq * (1 + 3 * u)) + Q * (2 * u + 10 * u * u) + u * Q + u * e); [lra|].
    assert (M1 : 15 / 13 * (A + bq * (1 + 3 * u)) <= 15 / 13 * (1 + 3 / 2048) * (A + bq)).
    { assert (bq * u <= bq * / 2048) by (apply Rmult_le_compat_l; lra). lra. }
    assert (M2 : 5 / 4 * (1 - 6 / 2048) * (A + bq) + Q * (4 * u) * (1 - 3 / 2048) <= (1 - u) * e).
    { apply Rle_trans with ((1 - u) * ((5 / 4 * (1 - 4 * u) * (A + bq) + Q * (4 * u) * (1 - u)) * (1 - u)));
        [|apply Rmult_le_compat_l; assumption].
      assert (Q * u * (1 - 3 / 2048) <= Q * u * ((1 - u) * (1 - u) * (1 - u))).
      { apply Rmult_le_compat_l; [apply Rmult_le_pos; lra|]. clear - U. nra. }
      assert ((A + bq) * (1 - 6 / 2048) <= (A + bq) * ((1 - 4 * u) * (1 - u) * (1 - u))).
      { apply Rmult_le_compat_l; [lra|]. clear - U. nra. }
      lra. }
    assert (M3 : Q * (2 * u + 10 * u * u) <= Q * u * (2 + 10 / 2048)).
    { replace (Q * (2 * u + 10 * u * u)) with (Q * u * (2 + 10 * u)) by ring. apply Rmult_le_compat_l; [apply Rmult_le_pos; lra|lra]. }
    assert (0 <= Q * u) by (apply Rmult_le_pos; lra). lra. }
  assert (D : Rabs (T' / det' - q) <= e - u * (Q + e)).
  { replace (T' / det' - q) with ((T' / det' - x) - (q - x)) by ring.
    eapply Rle_trans; [apply sub_b; eassumption|]. lra. }
  apply Rabs_le_inv in D.
  assert (S : forall s, Rabs s <= Q + e -> s - u * (Q + e) <= RN s <= s + u * (Q + e)).
  { intros s Hs. destruct (rel s) as (c & Hc & ->).
    assert (Rabs (s * c) <= u * (Q + e)) by (rewrite Rmult_comm; apply mul_b; assumption).
    apply Rabs_le_inv in H. lra. }
  assert (S1 := S (q - e) ltac:(apply sub_b; [apply Rle_refl|rewrite Rabs_pos_eq; lra])).
  assert (S2 := S (q + e) ltac:(apply add_b; [apply Rle_refl|rewrite Rabs_pos_eq; lra])). lra.
Qed.

(** The same for a determinant of either sign: with all signs changed, every step gives the same or the opposite. [EXACT-9] *)
Theorem enclosure det det' T T' dT dd et ed : det <> 0 -> 0 <= dd -> 15 / 2 * dd <= Rabs det ->
  Rabs (T - T') <= dT -> Rabs (det - det') <= dd -> 5 / 4 * dT <= et -> 5 / 4 * dd <= ed ->
  let '(low, high) := over_determinant RN u T et det ed in low <= T' / det' <= high.
Proof.
  intros Hd Hdd H75 HT HD Het Hed. unfold over_determinant. destruct (Rtotal_order det 0) as [N|[N|P]]; [|contradiction|].
  - assert (Hd' : det' < 0) by (rewrite Rabs_left in H75 by assumption; apply Rabs_le_inv in HD; lra).
    assert (E : - T' / - det' = T' / det') by (field; lra). rewrite <- E.
    assert (R : RN (1 / det) = - RN (1 / - det)) by (rewrite <- RN_opp; f_equal; field; lra).
    assert (Q : RN (T * RN (1 / det)) = RN (- T * RN (1 / - det))) by (rewrite R; f_equal; ring).
    rewrite Q, R, Rabs_Ropp. apply enclosure_positive with (dT := dT) (dd := dd); auto; try lra.
    + rewrite Rabs_left in H75; lra.
    + replace (- T - - T') with (- (T - T')) by ring. now rewrite Rabs_Ropp.
    + replace (- det - - det') with (- (det - det')) by ring. now rewrite Rabs_Ropp.
  - rewrite Rabs_pos_eq in H75 by lra. apply enclosure_positive with (dT := dT) (dd := dd); auto.
Qed.

(** * What a certain hit says of its determinant *)

Lemma above_rounded x s : 0 <= s -> s < RN x -> s * (1 - u) <= x.
Proof.
  intros Hs H. destruct (rel x) as (e & He & E). rewrite E in H. apply Rabs_le_inv in He.
  assert (P : 0 < x).
  { apply Rnot_le_lt. intros N. assert (x * (1 + e) <= 0) by (apply Rmult_le_neg_pos || (clear - N He Hu; nra)). lra. }
  assert (x * (1 + e) <= x * (1 + u)) by (apply Rmult_le_compat_l; lra).
  apply Rmult_le_reg_r with (1 + u); [lra|]. assert (0 <= s * (u * u)) by (apply Rmult_le_pos; [assumption|apply Rmult_le_pos; lra]). lra.
Qed.

Lemma three_edges det U V s : 0 <= s -> s < U -> s < V -> s < RN (RN (det - U) - V) -> 3 * s * (1 - 2 * u) <= det.
Proof.
  intros Hs HU HV HW. pose proof (above_rounded _ _ Hs HW) as A.
  assert (L : s + s * (1 - u) < RN (det - U)) by lra.
  assert (0 <= s * (1 - u)) by (apply Rmult_le_pos; lra).
  assert (B : (s + s * (1 - u)) * (1 - u) <= det - U) by (apply above_rounded; lra).
  assert (0 <= s * (u * u)) by (apply Rmult_le_pos; [assumption|apply Rmult_le_pos; lra]).
  assert (0 <= s * u) by (apply Rmult_le_pos; lra). lra.
Qed.

(** A certain hit has a determinant of about 3 σ at least. [EXACT-9] *)
Lemma hit_determinant neg s v0 v1 v2 o d : let found := determinants_of RN v0 v1 v2 o d in
  0 <= s -> is_hit neg s found -> 3 * s * (1 - 2 * u) <= Rabs (det found).
Proof.
  intros found Hs (U & V & W). unfold front, Triple.front in *. destruct neg.
  - eapply Rle_trans; [|rewrite <- Rabs_Ropp; apply Rle_abs].
    apply (three_edges (- det found) (- edge_u found) (- edge_v found)); auto.
    replace (edge_w found) with (RN (RN (det found - edge_u found) - edge_v found)) in W by reflexivity.
    rewrite <- RN_opp in W.
    replace (RN (- det found - - edge_u found)) with (- RN (det found - edge_u found)); [|rewrite <- RN_opp; f_equal; ring].
    match goal with |- _ < RN ?a => match type of W with _ < RN ?b => replace a with b by ring end end. exact W.
  - eapply Rle_trans; [|apply Rle_abs]. apply (three_edges (det found) (edge_u found) (edge_v found)); auto.
Qed.

(** * Distances and weights *)

Section Hit.
Variables v0 v1 v2 o d : vec.
Variables D C E : R.
Hypothesis HD : bounded D d.
Hypothesis HC : bounded C (vsub RN o v0).
Hypothesis HE : bounded E (vsub RN v1 v0) /\ bounded E (vsub RN v2 v0).
Let found := determinants_of RN v0 v1 v2 o d.
Let truth := determinants_of exactly v0 v1 v2 o d.
Let sigma := error_sign RN u D C E.

Let PD : 0 <= D := pos_b _ _ (proj1 HD).
Let PC : 0 <= C := pos_b _ _ (proj1 HC).
Let PE : 0 <= E := pos_b _ _ (proj1 (proj1 HE)).

(** A constant times a product of three as evaluated: three roundings. *)
Lemma evaluated c a : 0 <= c -> 0 <= a -> (1 - 3 * / 2048) * (c * (a * (E * E))) <= RN (c * RN (a * RN (E * E))).
Proof.
  intros Hc Ha. assert (P1 : 0 <= E * E) by (apply Rmult_le_pos; assumption).
  assert (L1 := below (E * E) P1). assert (Q1 := pos (E * E) P1). set (r1 := RN (E * E)) in *.
  assert (P2 : 0 <= a * r1) by (apply Rmult_le_pos; assumption).
  assert (L2 := below (a * r1) P2). assert (Q2 := pos (a * r1) P2). set (r2 := RN (a * r1)) in *.
  assert (P3 : 0 <= c * r2) by (apply Rmult_le_pos; assumption). eapply Rle_trans; [|apply (below (c * r2) P3)].
  apply Rle_trans with (c * (a * (E * E * (1 - u)) * (1 - u)) * (1 - u)).
  - replace (c * (a * (E * E * (1 - u)) * (1 - u)) * (1 - u)) with ((1 - u) * (1 - u) * (1 - u) * (c * (a * (E * E)))) by ring.
    apply Rmult_le_compat_r; [repeat apply Rmult_le_pos; assumption|].
    set (z := 1 - u). assert (Hz : 1 - / 2048 <= z <= 1) by (unfold z; lra). clear - Hz. assert (1 - 2 * / 2048 <= z * z) by nra.
    assert (z * z <= 1) by nra. nra.
  - apply Rmult_le_compat_r; [lra|]. apply Rmult_le_compat_l; [assumption|]. eapply Rle_trans; [|exact L2].
    apply Rmult_le_compat_r; [lra|]. apply Rmult_le_compat_l; assumption.
Qed.

Lemma error_det_is_enough : 5 / 4 * (k prec * (D * E * E)) <= error_det RN u D E.
Proof.
  pose proof (k_small prec prec_11) as K. assert (P : 0 <= D * (E * E)) by (repeat apply Rmult_le_pos; assumption).
  eapply Rle_trans; [|apply evaluated; [lra|assumption]].
  replace (D * E * E) with (D * (E * E)) by ring. set (x := D * (E * E)) in *. clearbody x.
  assert (k prec * x <= (30 + 53 / 2048) * u * x) by (apply Rmult_le_compat_r; lra).
  assert (0 <= u * x) by (apply Rmult_le_pos; lra). lra.
Qed.

Lemma error_t_is_enough : 5 / 4 * ((34 * u + 62 * (u * u)) * (C * E * E)) <= error_t RN u C E.
Proof.
  assert (P : 0 <= C * (E * E)) by (repeat apply Rmult_le_pos; assumption).
  eapply Rle_trans; [|apply evaluated; [lra|assumption]].
  replace (C * E * E) with (C * (E * E)) by ring. set (x := C * (E * E)) in *. clearbody x.
  assert (u * u <= u * / 2048) by (apply Rmult_le_compat_l; lra).
  assert ((34 * u + 62 * (u * u)) * x <= (34 + 62 / 2048) * u * x) by (apply Rmult_le_compat_r; lra).
  assert (0 <= u * x) by (apply Rmult_le_pos; lra). lra.
Qed.

(** Its condition holds for certain hits: 7.5 bounds of the determinant. [EXACT-9] *)
Lemma hit_is_far_from_parallel neg : is_hit neg sigma found -> 15 / 2 * (k prec * (D * E * E)) <= Rabs (det found) /\ 0 < Rabs (det found).
Proof.
  intros H. pose proof (sigma_from_below prec prec_11 v0 v1 v2 o d D C E HD HC HE) as S. fold sigma in S.
  pose proof (k_small prec prec_11) as K.
  assert (P1 : 0 <= D * E * E) by (repeat apply Rmult_le_pos; assumption).
  assert (P2 : 0 <= D * E * C) by (repeat apply Rmult_le_pos; assumption).
  replace (D * E * (C + E)) with (D * E * C + D * E * E) in S by ring.
  set (x := D * E * E) in *. set (y := D * E * C) in *. clearbody x y.
  assert (0 <= u * x) by (apply Rmult_le_pos; lra). assert (0 <= u * y) by (apply Rmult_le_pos; lra).
  assert (Ps : 0 <= sigma) by (clearbody sigma; lra).
  pose proof (hit_determinant neg sigma v0 v1 v2 o d Ps H) as L. fold found in L.
  assert (k prec * x <= (30 + 53 / 2048) * u * x) by (apply Rmult_le_compat_r; lra).
  assert (sigma * u <= sigma * / 2048) by (apply Rmult_le_compat_l; lra). split; [lra|].
  destruct (Rle_lt_or_eq_dec _ _ (Rabs_pos (det found))) as [|Z]; [assumption|exfalso].
  assert (sigma = 0) as Zs by lra. assert (D0 : det found = 0).
  { destruct (Req_dec (det found) 0) as [|N]; [assumption|]. pose proof (Rabs_pos_lt _ N). lra. }
  destruct H as (U & V & W). rewrite Zs in *.
  replace (edge_w found) with (RN (RN (det found - edge_u found) - edge_v found)) in W by reflexivity. rewrite D0 in W.
  unfold front, Triple.front in *.
  assert (G : forall x, RN x <= 0 <-> x <= 0).
  { intros z. destruct (rel z) as (e & He & ->). apply Rabs_le_inv in He. split; intros; clear - He Hu H; nra. }
  destruct neg.
  - rewrite <- RN_opp in W. assert (RN (- (RN (0 - edge_u found) - edge_v found)) <= 0); [|lra]. apply G.
    assert (0 <= RN (0 - edge_u found)) by (apply pos; lra). lra.
  - assert (RN (RN (0 - edge_u found) - edge_v found) <= 0); [|lra]. apply G.
    assert (RN (0 - edge_u found) <= 0) by (apply G; lra). lra.
Qed.

(** [Determinants::distance]: the true distance of a certain hit lies between the ends. [EXACT-9] *)
Theorem distance_is_enclosed neg : is_hit neg sigma found ->
  let '(low, high) := over_determinant RN u (top_t found) (error_t RN u C E) (det found) (error_det RN u D E) in
  low <= top_t truth / det truth <= high.
Proof.
  intros H. destruct (hit_is_far_from_parallel neg H) as [L P].
  apply enclosure with (dT := (34 * u + 62 * (u * u)) * (C * E * E)) (dd := k prec * (D * E * E)).
  - intros Z. rewrite Z, Rabs_R0 in P. lra.
  - pose proof (k_small prec prec_11). apply Rmult_le_pos; [lra|repeat apply Rmult_le_pos; assumption].
  - exact L.
  - apply t_off; assumption.
  - apply det_off; assumption.
  - apply error_t_is_enough.
  - apply error_det_is_enough.
Qed.

(** [Determinants::weights]: so do the true weights of the second and of the third corner. [EXACT-9] *)
Theorem weights_are_enclosed neg : is_hit neg sigma found ->
  (let '(low, high) := over_determinant RN u (edge_u found) (RN (sigma * (5 / 4))) (det found) (error_det RN u D E) in
   low <= edge_u truth / det truth <= high) /\
  (let '(low, high) := over_determinant RN u (edge_v found) (RN (sigma * (5 / 4))) (det found) (error_det RN u D E) in
   low <= edge_v truth / det truth <= high).
Proof.
  intros H. destruct (hit_is_far_from_parallel neg H) as [L P].
  assert (N : det found <> 0) by (intros Z; rewrite Z, Rabs_R0 in P; lra).
  pose proof (k_small prec prec_11) as K.
  assert (Pd : 0 <= k prec * (D * E * E)) by (apply Rmult_le_pos; [lra|repeat apply Rmult_le_pos; assumption]).
  assert (S : 5 / 4 * (k prec * (D * C * E)) <= RN (sigma * (5 / 4))).
  { pose proof (sigma_from_below prec prec_11 v0 v1 v2 o d D C E HD HC HE) as S. fold sigma in S.
    assert (P1 : 0 <= D * E * E) by (repeat apply Rmult_le_pos; assumption).
    assert (P2 : 0 <= D * C * E) by (repeat apply Rmult_le_pos; assumption).
    replace (D * E * (C + E)) with (D * C * E + D * E * E) in S by ring.
    set (x := D * E * E) in *. set (y := D * C * E) in *. clearbody x y.
    assert (0 <= u * x) by (apply Rmult_le_pos; lra). assert (0 <= u * y) by (apply Rmult_le_pos; lra).
    clearbody sigma. assert (Ps : 0 <= sigma) by lra.
    eapply Rle_trans; [|apply below; lra].
    assert (k prec * y <= (30 + 53 / 2048) * u * y) by (apply Rmult_le_compat_r; lra).
    assert (sigma * u <= sigma * / 2048) by (apply Rmult_le_compat_l; lra). lra. }
  split; apply enclosure with (dT := k prec * (D * C * E)) (dd := k prec * (D * E * E)); auto using error_det_is_enough.
  - apply u_off; assumption.
  - apply det_off; assumption.
  - apply v_off; assumption.
  - apply det_off; assumption.
Qed.
End Hit.
End Quotient.
