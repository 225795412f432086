(** [Sum::value] of src/geom/kernel/exact/sum.rs: its sign is that of the exact sum. The terms are not adjacent (Shewchuk 1997, theorem 10),
    which ties to even give; that they do not overlap would not be enough. *)
Require Import Reals ZArith Lia Lra List.
From Flocq Require Import Core.
Require Import StacklessExact.Rounding StacklessExact.Range StacklessExact.Expansion.
Import ListNotations.
Open Scope R_scope.

Local Instance prec_53 : Prec_gt_0 53 := eq_refl.
Notation fexp := (FLT_exp (-1074) 53).
Notation F := (generic_format radix2 fexp).

(** There is a bit of 0 between the bits of b and those of a. *)
Definition apart (a b : R) : Prop := exists s, 2 * Rabs a < bpow radix2 s /\ multiple s b.

Lemma finer g s x : (g <= s)%Z -> multiple s x -> multiple g x.
Proof.
  intros H (n & ->). exists (n * 2 ^ (s - g))%Z. rewrite mult_IZR, (IZR_Zpower radix2) by lia. rewrite Rmult_assoc, <- bpow_plus. do 2 f_equal. lia.
Qed.

Lemma apart_less a a' b : Rabs a' <= Rabs a -> apart a b -> apart a' b.
Proof. intros H (s & L & Mb). exists s. split; [lra|exact Mb]. Qed.

(** What is apart from two numbers is apart from all that is made of them. *)
Lemma apart_both a b c : apart a b -> apart a c -> exists s, 2 * Rabs a < bpow radix2 s /\ multiple s b /\ multiple s c.
Proof.
  intros (s & L & Mb) (s' & L' & Mc). exists (Z.min s s').
  split; [destruct (Z.min_spec s s') as [[_ ->]|[_ ->]]; assumption|]. split; eapply finer; eauto; lia.
Qed.

Lemma F_multiple x : F x -> multiple (-1074) x.
Proof.
  intros H. apply FLT_format_generic in H; [|typeclasses eauto]. destruct H as [[m e] -> _ He]. cbn in He. apply finer with e; [exact He|]. now exists m.
Qed.

Lemma multiple_R64 s x : multiple s x -> multiple s (R64 x).
Proof.
  intros Mx. destruct (Z_le_gt_dec s (cexp radix2 fexp x)) as [H|H].
  - unfold round, F2R. cbn [Fnum Fexp]. apply finer with (cexp radix2 fexp x); [exact H|]. now eexists.
  - rewrite round_generic; [exact Mx|typeclasses eauto|]. destruct Mx as (n & E). rewrite E. change (IZR n * bpow radix2 s) with (F2R (Float radix2 n s)).
    apply generic_format_F2R. intros _. change (F2R (Float radix2 n s)) with (IZR n * bpow radix2 s). rewrite <- E. lia.
Qed.

(** What rounding leaves out is apart from the rounded number: at most half a unit, and if it is half a unit the number is even. *)
Lemma rest_apart x : apart (x - R64 x) (R64 x).
Proof.
  set (c := cexp radix2 fexp x). set (m := scaled_mantissa radix2 fexp x). set (U := bpow radix2 c).
  assert (Up : 0 < U) by apply bpow_gt_0.
  assert (Ex : x = m * U) by (unfold m, U, c; now rewrite scaled_mantissa_mult_bpow).
  assert (Er : R64 x = IZR (ZnearestE m) * U) by reflexivity.
  rewrite Er. assert (Ed : Rabs (x - IZR (ZnearestE m) * U) = Rabs (m - IZR (ZnearestE m)) * U).
  { rewrite Ex at 1. rewrite <- Rmult_minus_distr_r, Rabs_mult, (Rabs_pos_eq U) by lra. reflexivity. }
  pose proof (Znearest_half (fun z => negb (Z.even z)) m) as Half.
  destruct (Req_dec (Rabs (m - IZR (ZnearestE m))) (/ 2)) as [E|E].
  - exists (c + 1)%Z. rewrite Ed, E. split; [rewrite bpow_plus; fold U; change (bpow radix2 1) with 2; lra|].
    assert (Even : Z.even (ZnearestE m) = true).
    { revert E. unfold Znearest. destruct (Rcompare_spec (m - IZR (Zfloor m)) (/ 2)) as [H|H|H].
      - intros E. rewrite Rabs_pos_eq in E by (pose proof (Zfloor_lb m); lra). lra.
      - intros _. destruct (Z.even (Zfloor m)) eqn:P; cbn [negb]; [exact P|].
        rewrite Zceil_floor_neq by (intros Q; rewrite <- Q in H at 1; lra). now rewrite Z.even_add, P.
      - intros E. rewrite Rabs_left1 in E by (pose proof (Zceil_ub m); lra).
        assert (IZR (Zceil m) = IZR (Zfloor m) + 1) by (rewrite Zceil_floor_neq by (intros Q; rewrite <- Q in H at 1; lra); now rewrite plus_IZR). lra. }
    apply Z.even_spec in Even. destruct Even as (n & En). exists n. rewrite En, mult_IZR, bpow_plus. fold U. change (bpow radix2 1) with 2. ring.
  - exists c. rewrite Ed. split; [|now exists (ZnearestE m)]. fold U.
    assert (L : 2 * Rabs (m - IZR (ZnearestE m)) < 1) by lra. apply (Rmult_lt_compat_r U) in L; lra.
Qed.

(** It is not greater than either number. *)
Lemma rest_small a b : F a -> Rabs (a + b - R64 (a + b)) <= Rabs b.
Proof.
  intros Fa. pose proof (round_N_pt radix2 fexp (fun z => negb (Z.even z)) (a + b)) as [_ H]. specialize (H a Fa).
  rewrite Rabs_minus_sym. eapply Rle_trans; [exact H|]. replace (a - (a + b)) with (- b) by ring. rewrite Rabs_Ropp. apply Rle_refl.
Qed.

(** * The terms *)

(** From the least on, each apart from all after it; none is 0. *)
Fixpoint spread (terms : list R) : Prop :=
  match terms with [] => True | t :: others => t <> 0 /\ F t /\ Forall (apart t) others /\ spread others end.

Lemma spread_F terms : spread terms -> Forall F terms.
Proof. induction terms as [|t terms IH]; [constructor|]. intros (_ & H & _ & S). constructor; auto. Qed.

Lemma kept_forall (P : R -> Prop) x rest : P x -> Forall P rest -> Forall P (kept x rest).
Proof. intros X H. unfold kept. destruct (Req_EM_T x 0); [exact H|now constructor]. Qed.

(** [two_sum]: what a number is apart from. *)
Lemma two_sum_rest a b : F a -> F b -> snd (two_sum a b) = a + b - R64 (a + b).
Proof. intros A B. pose proof (two_sum_is_exact a b A B) as E. unfold pair_sum in E. change (fst (two_sum a b)) with (R64 (a + b)) in E. lra. Qed.

Lemma apart_terms p terms : forall carry, F carry -> Forall F terms -> apart p carry -> Forall (apart p) terms -> Forall (apart p) (add carry terms).
Proof.
  induction terms as [|t terms IH]; intros carry Fc Ft Hc Ht; [now apply kept_forall|]. inversion_clear Ft as [|? ? F1 F2]. inversion_clear Ht as [|? ? H1 H2].
  cbn [add]. pose proof (two_sum_rest carry t Fc F1) as Er. assert (Es : fst (two_sum carry t) = R64 (carry + t)) by reflexivity.
  destruct (two_sum carry t) as [sum rest]. cbn [fst snd] in *. subst sum rest.
  destruct (apart_both p carry t Hc H1) as (s & L & Mc & Mt). pose proof (multiple_plus _ _ _ Mc Mt) as Ms. pose proof (multiple_R64 _ _ Ms) as Mr.
  apply kept_forall; [exists s; split; [exact L|now apply multiple_minus]|]. apply IH; [apply F_R64|exact F2| |exact H2]. exists s. auto.
Qed.

(** [Sum::add] keeps the terms apart. [EXACT-8] *)
Theorem add_keeps_apart terms : forall x, F x -> spread terms -> spread (add x terms).
Proof.
  induction terms as [|t terms IH]; intros x Fx S.
  - cbn. unfold kept. destruct (Req_EM_T x 0); [exact I|]. repeat split; [assumption..|constructor].
  - destruct S as (Nt & Ft & At & S). cbn [add]. pose proof (two_sum_rest x t Fx Ft) as Er. assert (Fr : F (snd (two_sum x t))) by apply F_R64.
    assert (Es : fst (two_sum x t) = R64 (x + t)) by reflexivity. destruct (two_sum x t) as [sum rest]. cbn [fst snd] in *. subst sum rest.
    assert (S' : spread (add (R64 (x + t)) terms)) by (apply IH; [apply F_R64|exact S]). unfold kept. destruct (Req_EM_T _ 0) as [Z|Z]; [exact S'|].
    split; [exact Z|]. split; [exact Fr|]. split; [|exact S']. apply apart_terms; [apply F_R64|now apply spread_F| |].
    + apply rest_apart.
    + eapply Forall_impl; [|exact At]. intros a. apply apart_less, rest_small, Fx.
Qed.

(** * The rounded sum *)

(** [Sum::value]. *)
Definition value (terms : list R) : R := fold_left (fun sum t => R64 (sum + t)) terms 0.

Lemma spread_last terms t : spread (terms ++ [t]) -> spread terms /\ t <> 0 /\ F t /\ Forall (fun p => apart p t) terms.
Proof.
  induction terms as [|p terms IH]; [intros (N & H & _); cbn; auto|]. intros (N & H & A & S). destruct (IH S) as (S' & N' & F' & A').
  apply Forall_app in A. destruct A as [A1 A2]. inversion_clear A2. split; [|split; [exact N'|split; [exact F'|constructor; assumption]]]. repeat split; assumption.
Qed.

(** One bit that separates all terms but the last from the last. *)
Lemma one_bit terms t : F t -> Forall (fun p => apart p t) terms -> exists s, (-1074 <= s)%Z /\ multiple s t /\ Forall (fun p => 2 * Rabs p < bpow radix2 s) terms.
Proof.
  intros Ft. induction 1 as [|p terms (s & L & Mt) _ (s' & Hs & Mt' & Hf)]; [exists (-1074)%Z; split; [lia|]; split; [now apply F_multiple|constructor]|].
  destruct (Z_le_gt_dec s s') as [H|H].
  - exists s'. split; [exact Hs|]. split; [exact Mt'|]. constructor; [|exact Hf]. eapply Rlt_le_trans; [exact L|now apply bpow_le].
  - exists s. split; [lia|]. split; [exact Mt|]. constructor; [exact L|]. eapply Forall_impl; [|exact Hf]. cbn. intros a Ha. eapply Rlt_trans; [exact Ha|]. apply bpow_lt. lia.
Qed.

Lemma total_app a b : total (a ++ b) = total a + total b.
Proof. unfold total. induction a as [|x a IH]; simpl; [lra|rewrite IH; lra]. Qed.

Lemma value_F terms : F (value terms).
Proof. unfold value. destruct terms as [|t terms] using rev_ind; [apply generic_format_0|]. rewrite fold_left_app. apply F_R64. Qed.

(** All terms below half of 2^s: the rounded sum is at most half of it, the exact one below. *)
Lemma sums_small terms : spread terms -> forall s, (-1073 <= s)%Z -> Forall (fun p => 2 * Rabs p < bpow radix2 s) terms ->
  Rabs (value terms) <= bpow radix2 (s - 1) /\ Rabs (total terms) < bpow radix2 (s - 1).
Proof.
  induction terms as [|t terms IH] using rev_ind; intros Sp s Hs H.
  { unfold value. cbn. rewrite Rabs_R0. split; [apply bpow_ge_0|apply bpow_gt_0]. }
  destruct (spread_last _ _ Sp) as (Sp' & Nt & Ft & At). apply Forall_app in H. destruct H as [_ H]. inversion_clear H as [|? ? Ht _].
  destruct (one_bit terms t Ft At) as (s' & Hs' & (n & En) & Hf).
  assert (P2 : bpow radix2 s = 2 * bpow radix2 (s - 1)) by (replace s with (1 + (s - 1))%Z at 1 by ring; rewrite bpow_plus; reflexivity).
  assert (Nz : n <> 0%Z) by (intros Z; apply Nt; rewrite En, Z; apply Rmult_0_l). assert (Pp : 0 < bpow radix2 s') by apply bpow_gt_0.
  assert (One : bpow radix2 s' <= Rabs t).
  { rewrite En, Rabs_mult, (Rabs_pos_eq (bpow _ _)) by lra. rewrite <- (Rmult_1_l (bpow radix2 s')) at 1. apply Rmult_le_compat_r; [lra|].
    rewrite <- abs_IZR. apply IZR_le. lia. }
  assert (Lt : (s' <= s - 2)%Z \/ (s' = s - 1)%Z \/ (s - 1 < s')%Z) by lia.
  assert (Lt' : (s' < s - 1)%Z) by (apply (lt_bpow radix2); lra).
  assert (Gap : Rabs t + bpow radix2 s' <= bpow radix2 (s - 1)).
  { assert (E : bpow radix2 (s - 1) = IZR (2 ^ (s - 1 - s')) * bpow radix2 s') by (rewrite (IZR_Zpower radix2) by lia; rewrite <- bpow_plus; f_equal; lia).
    assert (Ea : Rabs t = IZR (Z.abs n) * bpow radix2 s') by (rewrite En, Rabs_mult, (Rabs_pos_eq (bpow _ _)) by lra; now rewrite abs_IZR).
    assert (IZR (Z.abs n) < IZR (2 ^ (s - 1 - s'))) by (apply (Rmult_lt_reg_r (bpow radix2 s')); lra).
    apply lt_IZR in H. rewrite Ea, E. assert (IZR (Z.abs n) + 1 <= IZR (2 ^ (s - 1 - s'))) by (rewrite <- plus_IZR; apply IZR_le; lia).
    apply (Rmult_le_compat_r (bpow radix2 s')) in H0; lra. }
  destruct (Z_le_gt_dec (-1073) s') as [Hb|Hb].
  - destruct (IH Sp' s' Hb Hf) as [Hv Htot]. assert (Hh : bpow radix2 (s' - 1) < bpow radix2 s') by (apply bpow_lt; lia).
    unfold value in *. rewrite fold_left_app, total_app. change (total [t]) with (t + 0). cbn [fold_left]. split.
    + apply abs_round_le_generic; [typeclasses eauto..|apply generic_format_bpow; unfold FLT_exp; lia|]. eapply Rle_trans; [apply Rabs_triang|]. lra.
    + rewrite Rplus_0_r. eapply Rle_lt_trans; [apply Rabs_triang|]. lra.
  - (* No float but 0 is below half of the least one. *)
    assert (terms = []) as ->.
    { destruct terms as [|p others]; [reflexivity|]. exfalso. inversion_clear Hf as [|? ? L _]. destruct Sp' as (Np & Fp & _).
      destruct (multiple_big _ _ (F_multiple p Fp)) as [Z|G]; [contradiction|]. assert (s' = -1074)%Z by lia. subst s'. lra. }
    unfold value. cbn. rewrite Rplus_0_l, Rplus_0_r, round_generic by (typeclasses eauto || exact Ft). split; lra.
Qed.

(** The sign of the rounded sum is that of the exact one, and it is 0 only if that is. [EXACT-8] *)
Theorem value_has_sign terms : spread terms ->
  (0 < total terms <-> 0 < value terms) /\ (total terms < 0 <-> value terms < 0) /\ (total terms = 0 <-> value terms = 0).
Proof.
  intros Sp. assert (D : (0 < total terms /\ 0 < value terms) \/ (total terms < 0 /\ value terms < 0) \/ (total terms = 0 /\ value terms = 0)); [|lra].
  destruct terms as [|t terms _] using rev_ind; [right; right; split; reflexivity|].
  destruct (spread_last _ _ Sp) as (Sp' & Nt & Ft & At). destruct (one_bit terms t Ft At) as (s & Hs & Mt & Hf).
  assert (Small : Rabs (value terms) < bpow radix2 s /\ Rabs (total terms) < bpow radix2 s).
  { destruct (Z_le_gt_dec (-1073) s) as [Hb|Hb].
    - destruct (sums_small terms Sp' s Hb Hf) as [A B]. assert (bpow radix2 (s - 1) < bpow radix2 s) by (apply bpow_lt; lia). split; lra.
    - assert (terms = []) as ->.
      { destruct terms as [|p others]; [reflexivity|]. exfalso. inversion_clear Hf as [|? ? L _]. destruct Sp' as (Np & Fp & _).
        destruct (multiple_big _ _ (F_multiple p Fp)) as [Z|G]; [contradiction|]. assert (s = -1074)%Z by lia. subst s. pose proof (bpow_gt_0 radix2 (-1074)). lra. }
      unfold value. cbn. rewrite Rabs_R0. split; apply bpow_gt_0. }
  destruct Small as [Hv Ht]. apply Rabs_def2 in Hv, Ht. destruct (multiple_big _ _ Mt) as [Z|Big]; [contradiction|].
  assert (E : value (terms ++ [t]) = R64 (value terms + t)) by (unfold value; now rewrite fold_left_app).
  assert (M1 : multiple (-1074) (value terms + t)) by (apply multiple_plus; apply F_multiple; [apply value_F|exact Ft]).
  assert (Fb : F (bpow radix2 (-1074))) by (apply generic_format_bpow; unfold FLT_exp; lia). pose proof (bpow_gt_0 radix2 (-1074)) as Pb.
  rewrite E, total_app. change (total [t]) with (t + 0). rewrite Rplus_0_r. destruct (Rle_or_lt 0 t) as [St|St].
  - rewrite Rabs_pos_eq in Big by exact St. left. split; [lra|]. destruct (multiple_big _ _ M1) as [Z|G]; [lra|]. rewrite Rabs_pos_eq in G by lra.
    eapply Rlt_le_trans; [exact Pb|]. now apply round_ge_generic; try typeclasses eauto.
  - rewrite Rabs_left in Big by exact St. right. left. split; [lra|]. destruct (multiple_big _ _ M1) as [Z|G]; [lra|]. rewrite Rabs_left in G by lra.
    apply Rle_lt_trans with (- bpow radix2 (-1074)); [|lra]. apply round_le_generic; [typeclasses eauto..|now apply generic_format_opp|lra].
Qed.

(** * Sums of numbers, and edge functions *)

(** Any numbers, added one after another. [EXACT-8] *)
Theorem sum_has_sign xs : Forall F xs -> let terms := fold_left (fun terms x => add x terms) xs [] in
  spread terms /\ total terms = total xs.
Proof.
  intros H terms. assert (G : forall ys start, Forall F ys -> spread start -> spread (fold_left (fun ts x => add x ts) ys start) /\
    total (fold_left (fun ts x => add x ts) ys start) = total start + total ys).
  { induction ys as [|y ys IH]; intros start Hy Sp; [split; [exact Sp|simpl; lra]|]. inversion_clear Hy as [|? ? Fy Fys]. cbn [fold_left].
    destruct (IH (add y start) Fys (add_keeps_apart start y Fy Sp)) as [S' E]. split; [exact S'|]. rewrite E.
    destruct (add_is_exact start y Fy (spread_F _ Sp)) as [-> _]. unfold total. simpl. lra. }
  destruct (G xs [] H I) as [S' E]. split; [exact S'|]. unfold terms. rewrite E. unfold total. simpl. lra.
Qed.

Lemma two_product_F a b : F (fst (two_product a b)) /\ F (snd (two_product a b)).
Proof. unfold two_product. destruct (split a), (split b). split; apply F_R64. Qed.

Lemma add_part_spread c terms part : spread terms -> spread (add_part c terms part).
Proof.
  intros S. unfold add_part. pose proof (two_product_F part c) as [F1 F2]. destruct (two_product part c) as [high low].
  apply add_keeps_apart; [exact F1|]. now apply add_keeps_apart.
Qed.
Lemma add_product_spread a b c terms : spread terms -> spread (add_product a b c terms).
Proof.
  intros S. unfold add_product. destruct (Req_EM_T c 0); [exact S|].
  assert (T : forall ab ts, spread ts -> spread (add_two c ts ab)).
  { intros ab ts H. unfold add_two. destruct (Req_EM_T (fst ab) 0), (Req_EM_T (snd ab) 0); try exact H.
    destruct (two_product _ _) as [high low]. now apply add_part_spread, add_part_spread. }
  cbn [fold_left]. auto.
Qed.
Lemma add_edge_spread dx dy dz a b terms : spread terms -> spread (add_edge dx dy dz a b terms).
Proof. destruct a as [[ax ay] az], b as [[bx by_] bz]. intros S. unfold add_edge, add_axis. now repeat apply add_product_spread. Qed.

(** So the sign of an edge function is that of [Sum::value]: for all single-precision data, with g = -149, and for double-precision data of
    EXACT-7, with g = -252. [EXACT-2, EXACT-8] *)
Theorem edge_has_sign g dx dy dz ax ay az bx by_ bz ox oy oz : (-323 <= g)%Z -> Forall (good g) [dx; dy; dz] ->
  Forall (good g) [ax; ay; az] -> Forall (good g) [bx; by_; bz] -> Forall (good g) [ox; oy; oz] ->
  let minus x y z x' y' z' := (difference x x', difference y y', difference z z') in
  let found := value (add_edge dx dy dz (minus ax ay az bx by_ bz) (minus bx by_ bz ox oy oz) []) in
  let edge := dx * ((ay - oy) * (bz - oz) - (az - oz) * (by_ - oy)) + dy * ((az - oz) * (bx - ox) - (ax - ox) * (bz - oz)) +
    dz * ((ax - ox) * (by_ - oy) - (ay - oy) * (bx - ox)) in
  (0 < edge <-> 0 < found) /\ (edge < 0 <-> found < 0) /\ (edge = 0 <-> found = 0).
Proof.
  intros Hg D A B O minus found edge. pose proof (edge_is_exact g Hg dx dy dz ax ay az bx by_ bz ox oy oz D A B O) as E. cbv zeta in E.
  fold minus in E. unfold edge. rewrite <- E. apply value_has_sign. now apply add_edge_spread.
Qed.

(** * Not to overlap is not enough *)

Definition do_not_overlap (a b : R) : Prop := exists s, Rabs a < bpow radix2 s /\ multiple s b.

(** 3/4, 2^53 - 1 and -2^53 do not overlap, and add up to -1/4; the rounded sum is 0. Such terms do not come of [Sum::add], as the second
    and the third are adjacent. [EXACT-8] *)
Example adjacent_terms : let a := 3 / 4 in let b := 9007199254740991 in let c := - 9007199254740992 in
  do_not_overlap a b /\ do_not_overlap a c /\ do_not_overlap b c /\ total [a; b; c] < 0 /\ value [a; b; c] = 0.
Proof.
  intros a b c. assert (P53 : bpow radix2 53 = 9007199254740992) by (simpl; lra).
  assert (Fa : F a).
  { unfold a. replace (3 / 4) with (F2R (Float radix2 3 (-2))) by (unfold F2R; simpl; lra). apply generic_format_FLT.
    exists (Float radix2 3 (-2)); simpl; [reflexivity|lia|lia]. }
  assert (Up : R64 (a + b) = 9007199254740992).
  { assert (Mg : mag radix2 (a + b) = 53%Z :> Z).
    { apply mag_unique. rewrite Rabs_pos_eq by (unfold a, b; lra). rewrite P53. change (53 - 1)%Z with 52%Z.
      replace (bpow radix2 52) with 4503599627370496 by (simpl; lra). unfold a, b. lra. }
    unfold round, scaled_mantissa, cexp. rewrite Mg. change (fexp 53) with 0%Z. change (bpow radix2 (- 0)) with 1. rewrite Rmult_1_r.
    rewrite (Znearest_imp _ (a + b) 9007199254740992) by (apply Rabs_lt; unfold a, b; lra). unfold F2R. simpl. ring. }
  split; [exists 0%Z; split; [unfold a; rewrite Rabs_pos_eq; simpl; lra|exists 9007199254740991%Z; unfold b; simpl; ring]|].
  split; [exists 0%Z; split; [unfold a; rewrite Rabs_pos_eq; simpl; lra|exists (-9007199254740992)%Z; unfold c; simpl; ring]|].
  split; [exists 53%Z; split; [rewrite P53; unfold b; rewrite Rabs_pos_eq; lra|exists (-1)%Z; rewrite P53; unfold c; ring]|].
  split; [unfold total, a, b, c; simpl; lra|].
  unfold value. cbn [fold_left]. rewrite Rplus_0_l, (round_generic radix2 fexp ZnearestE a) by (typeclasses eauto || exact Fa). rewrite Up.
  unfold c. rewrite Rplus_opp_r. apply round_0. typeclasses eauto.
Qed.
