(** Products of src/geom/fine.rs. *)
Require Import Reals ZArith Lia Lra Psatz.
From Flocq Require Import Core Pff2Flocq.
Require Import StacklessExact.Rounding StacklessExact.Range StacklessExact.Expansion StacklessExact.Fine.
Require Import StacklessExact.FineSums.
Open Scope R_scope.

Local Instance prec_53 : Prec_gt_0 53 := eq_refl.
Notation u := (bpow radix2 (-53)).
Notation eta := (bpow radix2 (-1074)).

Lemma two_product_fst a b : fst (two_product a b) = R64 (a * b).
Proof. unfold two_product. now destruct (split a), (split b). Qed.
Lemma two_product_snd_F a b : F (snd (two_product a b)).
Proof. unfold two_product. destruct (split a), (split b). apply F_R64. Qed.

Lemma off_b x X : Rabs x <= X -> Rabs (x - R64 x) <= u * X + / 2 * eta.
Proof. intros H. pose proof (off x). pose proof Hu as U. assert (u * Rabs x <= u * X) by (apply Rmult_le_compat_l; lra). lra. Qed.
Lemma R64_less x X : Rabs x <= X -> Rabs (R64 x) <= X + u * X + / 2 * eta.
Proof.
  intros H. pose proof (off_b x X H) as G. replace (R64 x) with (x + - (x - R64 x)) by ring. eapply Rle_trans; [apply tri|]. rewrite Rabs_Ropp. lra.
Qed.

(** Without underflow a rounding is a relative error of the rounded number. *)
Lemma off_big x : bpow radix2 (-1022) <= Rabs x -> Rabs (x - R64 x) <= u * Rabs (R64 x).
Proof.
  intros H. rewrite (same_if_big (-1074) 53 x) by (right; exact H). destruct (back 53 ltac:(lia) x) as (e & He & E).
  change (Rounding.unit 53) with u in He. rewrite E at 1. replace (_ - _) with (round radix2 (FLX_exp 53) ZnearestE x * e) by ring.
  rewrite Rabs_mult, Rmult_comm. apply Rmult_le_compat_r; [apply Rabs_pos|exact He].
Qed.

(** One rounding more. *)
Lemma lower i x c y z : 0 <= x -> 0 <= i -> 0 <= c -> x - i * (u * x) - c * eta <= y -> y * (1 - u) <= z -> x - (i + 1) * (u * x) - c * eta <= z.
Proof.
  intros X I C H G. pose proof Hu as U. pose proof eta_pos as E. apply Rle_trans with (y * (1 - u)); [|exact G].
  apply Rle_trans with ((x - i * (u * x) - c * eta) * (1 - u)); [|apply Rmult_le_compat_r; lra].
  assert (0 <= u * (i * (u * x) + c * eta)) by (apply Rmult_le_pos; [lra|apply Rplus_le_le_0_compat; repeat apply Rmult_le_pos; lra]). lra.
Qed.

Section Product.
Variables ah al bh bl : R.
Hypothesis Fah : F ah.
Hypothesis Fbh : F bh.
Hypothesis Ha : Rabs al <= u * Rabs ah.
Hypothesis Hb : Rabs bl <= u * Rabs bh.
Let p := ah * bh.
Let h := fst (two_product ah bh).
Let rest := snd (two_product ah bh).
Let c := R64 (R64 (ah * bl) + R64 (al * bh)).
Let l := R64 (rest + c).

(** The error of a product is at most 9 u² of it, but for underflow. [NEAR-5] *)
Theorem mul_off : Rabs ((ah + al) * (bh + bl) - h - l) <= 9 * (u * (u * Rabs p)) + 16 * eta.
Proof.
  pose proof Hu as U. pose proof eta_pos as Pe. set (P := Rabs p). assert (Pp : 0 <= P) by apply Rabs_pos.
  assert (Mul : forall a b, a <= b -> u * a <= u * b) by (intros; apply Rmult_le_compat_l; lra).
  assert (UP0 : 0 <= u * P) by (apply Rmult_le_pos; lra). assert (UP1 : u * P <= / 1048576 * P) by (apply Rmult_le_compat_r; lra).
  assert (UP2 : 0 <= u * (u * P)) by (apply Rmult_le_pos; lra). assert (UP3 : u * (u * P) <= / 1048576 * (u * P)) by (apply Rmult_le_compat_r; lra).
  assert (UP4 : u * (u * (u * P)) <= / 1048576 * (u * (u * P))) by (apply Rmult_le_compat_r; lra). assert (UP5 : 0 <= u * (u * (u * P))) by (apply Rmult_le_pos; lra).
  assert (UE : u * eta <= / 1048576 * eta) by (apply Rmult_le_compat_r; lra). assert (UE0 : 0 <= u * eta) by (apply Rmult_le_pos; lra).
  assert (D : Rabs (p - (h + rest)) <= 7 / 2 * eta) by (apply (two_product_is_near ah bh); assumption).
  assert (Eh : h = R64 p) by apply two_product_fst.
  pose proof (off p) as Op. fold P in Op. rewrite <- Eh in Op.
  assert (Rb : Rabs rest <= u * P + 4 * eta).
  { replace rest with ((p - h) + - (p - (h + rest))) by ring. eapply Rle_trans; [apply tri|]. rewrite Rabs_Ropp. lra. }
  assert (M1 : Rabs (ah * bl) <= u * P).
  { unfold P, p. rewrite !Rabs_mult. apply Rle_trans with (Rabs ah * (u * Rabs bh)); [apply Rmult_le_compat_l; [apply Rabs_pos|exact Hb]|lra]. }
  assert (M2 : Rabs (al * bh) <= u * P).
  { unfold P, p. rewrite !Rabs_mult. apply Rle_trans with (u * Rabs ah * Rabs bh); [apply Rmult_le_compat_r; [apply Rabs_pos|exact Ha]|lra]. }
  assert (M3 : Rabs (al * bl) <= u * (u * P)).
  { unfold P, p. rewrite !Rabs_mult. apply Rle_trans with (u * Rabs ah * (u * Rabs bh)); [apply Rmult_le_compat; auto using Rabs_pos|lra]. }
  pose proof (off_b _ _ M1) as O1. pose proof (off_b _ _ M2) as O2. pose proof (R64_less _ _ M1) as R1. pose proof (R64_less _ _ M2) as R2.
  set (c1 := R64 (ah * bl)) in *. set (c2 := R64 (al * bh)) in *.
  destruct (sum_off c1 c2 (F_R64 _) (F_R64 _)) as [O3 _]. fold c in O3. pose proof (tri c1 c2) as S3.
  assert (S3' : Rabs (c1 + c2) <= 2 * (u * P) + 2 * (u * (u * P)) + eta) by lra. pose proof (Mul _ _ S3') as S3u.
  assert (Cb : Rabs c <= 2 * (u * P) + 5 * (u * (u * P)) + 2 * eta).
  { replace c with (c1 + c2 + - (c1 + c2 - c)) by ring. eapply Rle_trans; [apply tri|]. rewrite Rabs_Ropp. lra. }
  destruct (sum_off rest c (two_product_snd_F _ _) (F_R64 _)) as [O4 _]. fold l in O4. pose proof (tri rest c) as S4.
  assert (S4' : Rabs (rest + c) <= 3 * (u * P) + 5 * (u * (u * P)) + 6 * eta) by lra. pose proof (Mul _ _ S4') as S4u.
  replace ((ah + al) * (bh + bl) - h - l) with ((p - (h + rest)) + ((ah * bl - c1) + ((al * bh - c2) + ((c1 + c2 - c) + ((rest + c - l) + al * bl))))) by (unfold p; ring).
  eapply Rle_trans; [apply tri|]. eapply Rle_trans; [apply Rplus_le_compat_l, tri|]. eapply Rle_trans; [apply Rplus_le_compat_l, Rplus_le_compat_l, tri|].
  eapply Rle_trans; [apply Rplus_le_compat_l, Rplus_le_compat_l, Rplus_le_compat_l, tri|].
  eapply Rle_trans; [apply Rplus_le_compat_l, Rplus_le_compat_l, Rplus_le_compat_l, Rplus_le_compat_l, tri|]. lra.
Qed.

Variables ar br : R.
Hypothesis Pa : 0 <= ar.
Hypothesis Pb : 0 <= br.

(** The radius that the code has, before it is made greater once more. *)
Let of_radii := R64 (R64 (R64 (Rabs ah * br) + R64 (Rabs bh * ar)) + R64 (ar * br)).
Let r := R64 (R64 (R64 (of_radii * UP) + R64 (Rabs h * ERROR)) + UNDERFLOW).

Lemma radius_enough : (Rabs ah + u * Rabs ah) * br + (Rabs bh + u * Rabs bh) * ar + ar * br + (9 * (u * (u * Rabs p)) + 8192 * eta) <= r.
Proof.
  pose proof Hu as U. pose proof eta_pos as Pe. set (P := Rabs p). assert (Pp : 0 <= P) by apply Rabs_pos.
  assert (Mul : forall a b, a <= b -> u * a <= u * b) by (intros; apply Rmult_le_compat_l; lra).
  assert (Small : forall x, 0 <= x -> 0 <= u * x <= / 1048576 * x) by (intros x Hx; split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  set (A := Rabs ah * br). set (B := Rabs bh * ar). set (C := ar * br).
  assert (PA : 0 <= A) by (apply Rmult_le_pos; [apply Rabs_pos|exact Pb]). assert (PB : 0 <= B) by (apply Rmult_le_pos; [apply Rabs_pos|exact Pa]).
  assert (PC : 0 <= C) by (apply Rmult_le_pos; assumption).
  pose proof (product_low A PA) as LA. pose proof (product_low B PB) as LB. pose proof (product_low C PC) as LC.
  pose proof (R64_pos A PA) as QA. pose proof (R64_pos B PB) as QB. pose proof (R64_pos C PC) as QC.
  unfold r, of_radii. fold A B C. set (a := R64 A) in *. set (b := R64 B) in *. set (k := R64 C) in *.
  assert (P1 : 0 <= a + b) by lra. pose proof (sum_low a b (F_R64 _) (F_R64 _) P1) as L1. pose proof (R64_pos _ P1) as Q1. set (s := R64 (a + b)) in *.
  assert (P2 : 0 <= s + k) by lra. pose proof (sum_low s k (F_R64 _) (F_R64 _) P2) as L2. pose proof (R64_pos _ P2) as Q2. set (w := R64 (s + k)) in *.
  set (T := A + B + C). assert (PT : 0 <= T) by (unfold T; lra).
  assert (Lw : T - 3 * (u * T) - 2 * eta <= w).
  { assert (PAB : 0 <= A + B) by lra. assert (Ls : (A + B) - (1 + 1) * (u * (A + B)) - 1 * eta <= s) by (apply (lower 1 (A + B) 1 (a + b)); lra).
    assert (0 <= u * C) by (apply Rmult_le_pos; lra). replace 3 with (2 + 1) by ring. apply (lower 2 T 2 (s + k)); unfold T in *; lra. }
  assert (PW : 0 <= w * UP) by (apply Rmult_le_pos; [exact Q2|rewrite UP_is; lra]). pose proof (product_low _ PW) as LW. pose proof (R64_pos _ PW) as QW.
  set (x := R64 (w * UP)) in *. rewrite UP_is in LW.
  assert (Lx : T + 20 * (u * T) - 6 * eta <= x).
  { destruct (Small T PT) as [T0 T1]. destruct (Small _ T0) as [T2 T3]. destruct (Small w Q2) as [W0 W1]. destruct (Small _ W0) as [W2 W3].
    assert (E : w + 30 * (u * w) - / 2 * eta <= x) by lra. pose proof (Mul _ _ Lw) as ML. destruct (Small _ (Rlt_le _ _ Pe)). lra. }
  assert (Eh : h = R64 p) by apply two_product_fst.
  assert (Hb' : P - u * P - / 2 * eta <= Rabs h).
  { pose proof (off p) as O. fold P in O. rewrite <- Eh in O. pose proof (tri (p - h) h) as G. replace (p - h + h) with p in G by ring. fold P in G. lra. }
  assert (Ee : ERROR = 16 * (u * u)) by (unfold ERROR; rewrite <- bpow_plus; change (-102)%Z with (4 + (-53 + -53))%Z; rewrite bpow_plus; reflexivity).
  assert (PQ : 0 <= Rabs h * ERROR) by (apply Rmult_le_pos; [apply Rabs_pos|unfold ERROR; apply bpow_ge_0]). pose proof (product_low _ PQ) as LQ. pose proof (R64_pos _ PQ) as QQ.
  set (q := R64 (Rabs h * ERROR)) in *. rewrite Ee in LQ.
  assert (Lq : 15 * (u * (u * P)) - eta <= q).
  { set (m := Rabs h) in *. assert (Pm : 0 <= m) by apply Rabs_pos. destruct (Small m Pm) as [m0 m1]. destruct (Small _ m0) as [m2 m3]. destruct (Small _ m2) as [m4 m5].
    replace (m * (16 * (u * u)) * (1 - u)) with (16 * (u * (u * m)) - 16 * (u * (u * (u * m)))) in LQ by ring.
    pose proof (Mul _ _ (Mul _ _ Hb')) as MM. destruct (Small P Pp) as [p0 p1]. destruct (Small _ p0) as [p2 p3]. destruct (Small _ p2) as [p4 p5].
    destruct (Small _ (Rlt_le _ _ Pe)) as [e0 e1]. destruct (Small _ e0). lra. }
  assert (P3 : 0 <= x + q) by lra. pose proof (sum_low x q (F_R64 _) (F_R64 _) P3) as L3. pose proof (R64_pos _ P3) as Q3. set (y := R64 (x + q)) in *.
  assert (Fu : F UNDERFLOW) by (apply generic_format_bpow; unfold FLT_exp; lia).
  assert (Ue : UNDERFLOW = 16384 * eta) by (unfold UNDERFLOW; change (-1060)%Z with (14 + -1074)%Z; rewrite bpow_plus; reflexivity).
  assert (P4 : 0 <= y + UNDERFLOW) by lra. pose proof (sum_low y UNDERFLOW (F_R64 _) Fu P4) as L4. eapply Rle_trans; [|exact L4]. rewrite Ue in *.
  destruct (Small _ (Rlt_le _ _ Pe)) as [e0 e1]. destruct (Small T PT) as [T0 T1]. destruct (Small _ T0) as [T2 T3]. destruct (Small P Pp) as [p0 p1]. destruct (Small _ p0) as [p2 p3]. destruct (Small _ p2) as [p4 p5].
  assert (Px : 0 <= x) by exact QW.
  assert (L5 : (x + q) * (1 - u) * (1 - u) <= y * (1 - u)) by (apply Rmult_le_compat_r; lra).
  assert (L6 : (T + 20 * (u * T) + 15 * (u * (u * P)) - 7 * eta) * ((1 - u) * (1 - u)) <= (x + q) * ((1 - u) * (1 - u))) by (apply Rmult_le_compat_r; [apply Rmult_le_pos|]; lra).
  destruct (Small _ T2) as [T4 T5]. destruct (Small _ p4) as [p6 p7]. destruct (Small _ e0) as [e2 e3].
  replace ((Rabs ah + u * Rabs ah) * br + (Rabs bh + u * Rabs bh) * ar) with (A + B + u * (A + B)) by (unfold A, B; ring).
  assert (u * (A + B) <= u * T) by (apply Mul; unfold T; lra). unfold T in *. lra.
Qed.
End Product.

(** A radius of 0. *)
Lemma one_number h v : Rabs (v - h - 0) <= 0 -> v = h.
Proof. intros H. apply Rabs_le_inv in H. lra. Qed.
Lemma zero_number h l d v : Rabs l <= u * Rabs h -> Rabs (v - h - l) <= d -> is_zero (Fine h l d) = true -> v = 0.
Proof.
  intros H V Z. unfold is_zero, is_exact in Z. cbn [high radius] in Z. apply andb_prop in Z as [Z1 Z2]. revert Z1 Z2.
  destruct (Req_bool_spec h 0) as [->|], (Req_bool_spec d 0) as [->|]; try discriminate. intros _ _. rewrite Rabs_R0 in H.
  apply one_number. replace l with 0 in V; [exact V|]. rewrite Rmult_0_r in H. apply Rabs_le_inv in H. lra.
Qed.

(** What is rounded stands for some more: for what underflows there is room many times over. *)
Lemma mul_stands_spare x y r t e : stands x r -> stands y t -> orb (is_zero x) (is_zero y) = false ->
  andb (are_doubles x y) (Rlt_bool EXACT (Rabs (R64 (high x * high y)))) = false -> Rabs e <= 8000 * eta -> stands (mul x y) (r * t + e).
Proof.
  destruct x as [ah al ar], y as [bh bl br]. intros [(Fah & Fal & Far & Pa & Ha) Va] [(Fbh & Fbl & Fbr & Pb & Hb) Vb] Z D Small. unfold holds in Va, Vb.
  unfold mul. cbn [high low radius] in *. rewrite Z. pose proof (mul_off ah al bh bl Fah Fbh Ha Hb) as H. pose proof (radius_enough ah bh ar br Pa Pb) as E.
  pose proof (two_product_fst ah bh) as Eh. rewrite <- Eh in D. destruct (two_product ah bh) as [h rest]. cbn [fst snd] in *. pose proof Hu as U. pose proof eta_pos as Pe. rewrite D.
  apply new_stands; [rewrite Eh; apply F_R64|apply F_R64|apply F_R64|apply R64_pos|].
  - apply Rplus_le_le_0_compat; [apply R64_pos, Rplus_le_le_0_compat; apply R64_pos; apply Rmult_le_pos|apply bpow_ge_0].
    + apply R64_pos, Rplus_le_le_0_compat; [apply R64_pos, Rplus_le_le_0_compat|]; apply R64_pos, Rmult_le_pos; auto using Rabs_pos.
    + rewrite UP_is. lra.
    + apply Rabs_pos.
    + apply bpow_ge_0.
  - eapply Rle_trans; [|apply up_grows; [apply F_R64|]].
    + eapply Rle_trans; [|exact E]. replace (r * t + e - h - _) with (((ah + al) * (t - bh - bl) + (bh + bl) * (r - ah - al) + (r - ah - al) * (t - bh - bl)) +
        (((ah + al) * (bh + bl) - h - R64 (rest + R64 (R64 (ah * bl) + R64 (al * bh)))) + e)) by ring.
      eapply Rle_trans; [apply tri|]. apply Rplus_le_compat; [|eapply Rle_trans; [apply tri|]; lra]. eapply Rle_trans; [apply tri|]. apply Rplus_le_compat; [|now apply mul_b].
      eapply Rle_trans; [apply tri|]. apply Rplus_le_compat; (apply mul_b; [eapply Rle_trans; [apply tri|]; lra|assumption]).
    + eapply Rle_trans; [|exact E]. assert (0 <= u * (u * Rabs (ah * bh))) by (repeat apply Rmult_le_pos; auto using Rabs_pos; lra).
      assert (forall a b, 0 <= a -> 0 <= b -> 0 <= (a + u * a) * b) as G by (intros; apply Rmult_le_pos; [assert (0 <= u * a) by (apply Rmult_le_pos; lra)|]; lra).
      pose proof (G (Rabs ah) br (Rabs_pos _) Pb). pose proof (G (Rabs bh) ar (Rabs_pos _) Pa). assert (0 <= ar * br) by now apply Rmult_le_pos. lra.
Qed.

(** Products stand for the products of all that the two stand for. [NEAR-5] *)
Theorem mul_stands x y r t : stands x r -> stands y t -> stands (mul x y) (r * t).
Proof.
  intros X Y. destruct (orb (is_zero x) (is_zero y)) eqn:Z; [|destruct (andb (are_doubles x y) (Rlt_bool EXACT (Rabs (R64 (high x * high y))))) eqn:D].
  3: { rewrite <- (Rplus_0_r (r * t)). apply mul_stands_spare; try assumption. rewrite Rabs_R0. pose proof eta_pos. lra. }
  all: destruct x as [ah al ar], y as [bh bl br]; destruct X as [(Fah & Fal & Far & Pa & Ha) Va], Y as [(Fbh & Fbl & Fbr & Pb & Hb) Vb]; unfold holds in Va, Vb;
    unfold mul; cbn [high low radius] in *; rewrite Z.
  { assert (r * t = 0) as -> by (apply Bool.orb_prop in Z as [Z|Z]; [rewrite (zero_number _ _ _ _ Ha Va Z)|rewrite (zero_number _ _ _ _ Hb Vb Z)]; ring).
    apply (exact_stands 0), generic_format_0. }
  pose proof (two_product_fst ah bh) as Eh. pose proof (two_product_snd_F ah bh) as Fr. pose proof (two_product_is_exact ah bh Fah Fbh) as X. unfold pair_sum in X.
  rewrite <- Eh in D. destruct (two_product ah bh) as [h rest]. cbn [fst snd] in *. pose proof Hu as U. rewrite D.
  apply andb_prop in D as [D Big]. apply ltb_true in Big. unfold are_doubles, is_exact in D. cbn [low radius] in D.
  apply andb_prop in D as [D Z4]. apply andb_prop in D as [D Z3]. apply andb_prop in D as [Z1 Z2].
  revert Z1 Z2 Z3 Z4. destruct (Req_bool_spec al 0) as [->|], (Req_bool_spec bl 0) as [->|], (Req_bool_spec ar 0) as [->|], (Req_bool_spec br 0) as [->|]; try discriminate. intros _ _ _ _.
  rewrite (one_number _ _ Va), (one_number _ _ Vb).
  assert (Large : bpow radix2 (-901) <= Rabs (ah * bh)).
  { apply Rnot_lt_le. intros L. apply (Rlt_not_le _ _ Big). rewrite Eh. unfold EXACT. apply abs_round_le_generic; [typeclasses eauto..|apply generic_format_bpow; unfold FLT_exp; lia|].
    eapply Rle_trans; [apply Rlt_le, L|apply bpow_le; lia]. }
  assert (S : h + rest = ah * bh) by (apply X; right; eapply Rle_trans; [apply bpow_le|exact Large]; lia).
  assert (B : Rabs (ah * bh - R64 (ah * bh)) <= u * Rabs (R64 (ah * bh))).
  { apply off_big. eapply Rle_trans; [apply bpow_le|exact Large]; lia. }
  split; [repeat split; cbn [high low radius]|].
  - rewrite Eh. apply F_R64.
  - exact Fr.
  - apply generic_format_0.
  - lra.
  - replace rest with (ah * bh - h) by lra. now rewrite Eh.
  - unfold holds. cbn [high low radius]. replace (ah * bh - h - rest) with 0 by lra. rewrite Rabs_R0. lra.
Qed.
