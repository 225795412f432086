(** Quotients of twice the digits on IEEE 754 doubles: where one is told, as one number, it is that of FineQuotients.v. *)
Require Import Reals ZArith Lia Lra Bool List.
From Flocq Require Import Core BinarySingleNaN.
Require Import StacklessExact.Rounding StacklessExact.Range StacklessExact.Overflow StacklessExact.Arithmetic StacklessExact.Operations.
Require Import StacklessExact.Fine StacklessExact.FineQuotients StacklessExact.FineDeterminants StacklessExact.AgreementFine StacklessExact.FineNumbers StacklessExact.FineBack.
Require StacklessExact.Expansion StacklessExact.FineProducts StacklessExact.Intervals.
Open Scope R_scope.

Local Instance prec_53 : Prec_gt_0 53 := eq_refl.
Local Instance emax_1024 : Prec_lt_emax 53 1024 := eq_refl.

(** * The quotient *)

Lemma at_most_of x y a b : is x a -> is y b -> Arithmetic.at_most f64 x y = Rle_bool a b.
Proof. intros [X <-] [Y <-]. exact (Bleb_correct 53 1024 x y X Y). Qed.
Lemma before_of e x a : (e <= 1023)%Z -> fits e x a -> is (Arithmetic.before f64 x) (Intervals.pred a).
Proof.
  intros E (X & <- & B). pose proof (Bpred_correct 53 1024 _ _ x X) as C. rewrite Rlt_bool_true in C; [exact (conj (proj1 (proj2 C)) (proj1 C))|].
  apply Rlt_le_trans with (Intervals.pred (- bpow radix2 1023)).
  - rewrite pred_opp. apply Ropp_lt_contravar. apply Rle_lt_trans with (bpow radix2 1023 + bpow radix2 971).
    + unfold succ. rewrite Rle_bool_true by apply bpow_ge_0. rewrite ulp_bpow. apply Rle_refl.
    + change (bpow radix2 1024) with (bpow radix2 (1 + 1023)). rewrite bpow_plus. change (bpow radix2 1) with 2. assert (bpow radix2 971 < bpow radix2 1023) by (apply bpow_lt; lia). lra.
  - apply pred_le; [typeclasses eauto|apply generic_format_opp, format_64; lia|exact (generic_format_B2R 53 1024 x)|].
    apply Rabs_le_inv in B. assert (bpow radix2 e <= bpow radix2 1023) by now apply bpow_le. lra.
Qed.
Lemma after_of e x a : (e <= 1023)%Z -> fits e x a -> is (Arithmetic.after f64 x) (Intervals.succ a).
Proof.
  intros E X. pose proof (before_of e _ _ E (opposite_is _ _ _ X)) as [F V]. destruct X as (X & <- & _). 
  assert (S : Arithmetic.after f64 x = Arithmetic.opposite f64 (Arithmetic.before f64 (Arithmetic.opposite f64 x))).
  { cbn. unfold Bpred. now rewrite !Bopp_involutive. }
  rewrite S. rewrite pred_opp in V. split; [change (finite (Bopp (Arithmetic.before f64 (Arithmetic.opposite f64 x))) = true); now rewrite is_finite_Bopp|].
  change (B2R (Bopp (Arithmetic.before f64 (Arithmetic.opposite f64 x))) = Intervals.succ (B2R x)). rewrite B2R_Bopp, V. ring.
Qed.

(** The ends of what is left out, where they are not too great. *)
Lemma around_of e l r x : (0 <= e < 1000)%Z -> fits e l (low x) -> fits e r (radius x) ->
  let '(a, b) := Interval_add f64 l l (Arithmetic.opposite f64 r) r in let around := Intervals.plus (low x, low x) (- radius x, radius x) in
  is a (fst around) /\ is b (snd around).
Proof.
  intros E L R. unfold Interval_add, Intervals.plus, Intervals.add_below, Intervals.add_above. cbn [fst snd]. pose proof (opposite_is _ _ _ R) as N.
  destruct (two_sum_fits e L N ltac:(lia)) as [A1 A2]. destruct (two_sum_fits e L R ltac:(lia)) as [B1 B2].
  destruct (sum_two_sum f64 l (Arithmetic.opposite f64 r)) as [a below], (sum_two_sum f64 l r) as [b above], (Expansion.two_sum (low x) (- radius x)) as [a' below'], (Expansion.two_sum (low x) (radius x)) as [b' above'].
  cbn [fst snd] in *. pose proof is_zero_constant as Z. rewrite (at_most_of _ _ _ _ Z (fits_is _ _ _ A2)), (at_most_of _ _ _ _ (fits_is _ _ _ B2) Z).
  split; [destruct (Rle_bool 0 below')|destruct (Rle_bool above' 0)]; try (eapply fits_is; eassumption); [eapply before_of|eapply after_of]; try eassumption; lia.
Qed.

(** [Fine::over]: if a quotient is known, and is finite, it is that of FineQuotients.v. *)
Lemma over_positive_back h l r h' l' r' x y : fine_is (h, l, r) x -> fine_fits 900 (h', l', r') y -> proper x -> proper y ->
  let '(least, _, _, _) := Fine_bounds f64 h' l' r' in
  let quotient := Arithmetic.over f64 h h' in
  let '(m, m', m'') := Fine_mul f64 quotient (Arithmetic.constant f64 0 0) (Arithmetic.constant f64 0 0) h' l' r' in
  let '(k, k', k'') := Fine_sub f64 h l r m m' m'' in
  let step := Arithmetic.over f64 k h' in
  let of_whole := Arithmetic.plus f64 (Arithmetic.over f64 r' h') (Arithmetic.constant f64 1 (-52)) in
  let d := Arithmetic.plus f64 (Arithmetic.over f64 (Arithmetic.plus f64 (Arithmetic.plus f64 k'' (Arithmetic.absolute f64 k'))
    (Arithmetic.times f64 (Arithmetic.absolute f64 k) of_whole)) least) (Arithmetic.times f64 (Arithmetic.absolute f64 step) (Arithmetic.constant f64 1 (-52))) in
  let n := Fine_new f64 quotient step (Arithmetic.plus f64 d (Arithmetic.constant f64 1 (-1060))) in
  0 <= high y -> Arithmetic.less f64 (Arithmetic.constant f64 0 0) least = true -> fine_finite n -> 0 < fst (over_positive x y) /\ fine_is n (snd (over_positive x y)).
Proof.
  intros X (H' & L' & R') Px Py. pose proof X as (H & L & R).
  assert (B : is (let '(least, _, _, _) := Fine_bounds f64 h' l' r' in least) (fst (fst (bounds y)))).
  { unfold Fine_bounds, bounds. pose proof (around_of 900 l' r' y ltac:(lia) L' R') as A. destruct (Interval_add f64 _ _ _ _) as [a b].
    destruct Py as (F1 & F2 & F3 & F4 & F5). destruct (Intervals.plus_holds (low y, low y) (- radius y, radius y) (low y) 0) as [[G1 G2] _]; [now split|split; [now apply F_opp|exact F3]|split; cbn; lra|split; cbn; lra|].
    destruct A as [A _]. destruct (Intervals.plus _ _) as [a' b'] eqn:Ei. cbn [fst snd] in *.
    assert (Fa : fits 950 a a').
    { apply is_fits; [|exact A]. assert (Ea : a' = Intervals.add_below (low y) (- radius y)) by (unfold Intervals.plus in Ei; now injection Ei as <- _). subst a'. unfold Intervals.add_below.
      destruct (two_sum_fits 900 L' (opposite_is _ _ _ R') ltac:(lia)) as [T1 T2]. destruct (Expansion.two_sum (low y) (- radius y)) as [s t]. cbn [fst snd] in *.
      destruct (Rle_bool 0 t); [destruct T1 as (_ & _ & T1); eapply Rle_trans; [exact T1|apply bpow_le; lia]|]. destruct T1 as (_ & T0 & T1). apply Rabs_le_inv in T1.
      assert (Fs : generic_format radix2 (FLT_exp (-1074) 53) s) by (rewrite <- T0; exact (generic_format_B2R 53 1024 _)).
      apply Rabs_le. split.
      - apply Rle_trans with (Intervals.pred (- bpow radix2 901)); [|apply pred_le; [typeclasses eauto|apply generic_format_opp, format_64; lia|exact Fs|exact (proj1 T1)]].
        rewrite pred_opp. apply Ropp_le_contravar. unfold succ. rewrite Rle_bool_true by apply bpow_ge_0. rewrite ulp_bpow. change (FLT_exp (-1074) 53 (901 + 1)) with 849%Z.
        apply Rle_trans with (bpow radix2 901 + bpow radix2 901); [apply Rplus_le_compat_l, bpow_le; lia|]. rewrite twice. apply bpow_le. lia.
      - eapply Rle_trans; [apply pred_le_id; typeclasses eauto|]. apply Rle_trans with (1 := proj2 T1). apply bpow_le. lia. }
    destruct (two_sum_fits 950 H' Fa ltac:(lia)) as [T _]. destruct (sum_two_sum f64 h' a) as [s t], (sum_two_sum f64 h' b) as [s' t']. cbn [fst] in *. exact (fits_is _ _ _ T). }
  destruct (Fine_bounds f64 h' l' r') as [[[least ?] ?] ?]. cbv zeta.
  destruct (Fine_mul f64 _ _ _ _ _ _) as [[m m'] m''] eqn:Em. destruct (Fine_sub f64 h l r m m' m'') as [[k k'] k''] eqn:Ek. intros Pos Le Fin.
  rewrite (less_of _ _ _ _ is_zero_constant B) in Le. apply ltb_true in Le. split; [exact Le|].
  assert (Hn : B2R h' <> 0). { destruct H' as (_ & -> & _). intros Z. destruct Py as (F1 & F2 & F3 & F4 & F5). rewrite Z, Rabs_R0, Rmult_0_r in F5.
    destruct (Intervals.plus_holds (low y, low y) (- radius y, radius y) (low y) (- radius y)) as [[G1 _] [G2 _]]; [now split|split; [now apply F_opp|exact F3]|split; cbn; lra|split; cbn; lra|].
    unfold bounds in Le. rewrite two_sum_is in Le by assumption. cbn [fst snd] in *. rewrite Z, Rplus_0_l, R64_id in Le by exact G1. apply Rabs_le_inv in F5. lra. }
  destruct H' as (Hf & Hv & _). destruct B as [Bf Bv].
  destruct (new_back _ _ _ Fin) as (q & s & c & Q & S & C & N). destruct Q as [Q1 Q2], S as [S1 S2], C as [C1 C2].
  destruct (over_back h h' Hf Hn Q1) as (_ & Q3). destruct (over_back k h' Hf Hn S1) as (K1 & S3). destruct (plus_back _ _ C1) as (D1 & _ & D2). destruct (plus_back _ _ D1) as (D3 & D4 & D5).
  assert (Ln : B2R least <> 0) by (rewrite Bv; lra). destruct (over_back _ least Bf Ln D3) as (D6 & D7). destruct (plus_back _ _ D6) as (D8 & D9 & D10). destruct (plus_back _ _ D8) as (K2 & K3 & D11).
  destruct (absolute_back _ K3) as (K4 & _). destruct (times_back _ _ D9) as (_ & W1 & D12). destruct (plus_back _ _ W1) as (W2 & _ & W3). destruct (over_back r' h' Hf Hn W2) as (_ & W4). destruct (times_back _ _ D4) as (_ & _ & D13).
  (* So what is left is a number, and the product that was taken. *)
  assert (Sub : fine_is (k, k', k'') (sub x (mul (exact q) y)) ).
  { assert (Fm : fine_finite (m, m', m'')).
    { assert (Fk : fine_finite (Fine_sub f64 h l r m m' m'')) by (rewrite Ek; now repeat split). unfold Fine_sub, Fine_neg, Fine_add in Fk.
      destruct (sum_two_sum f64 h (Arithmetic.opposite f64 m)) as [a rest] eqn:E1. destruct (sum_two_sum f64 l (Arithmetic.opposite f64 m')) as [b lst] eqn:E2.
      destruct (sum_two_sum f64 rest b) as [e lost] eqn:E3. destruct (sum_two_sum f64 a e) as [v w] eqn:E4. cbv zeta in Fk.
      match type of Fk with context [Fine_new f64 ?a1 ?b1 ?c1] => destruct (Fine_new f64 a1 b1 c1) as [[i i'] i''] eqn:En; pose proof (new_back a1 b1 c1) as Nb; rewrite En in Nb end.
      assert (G : finite w = true /\ finite (Arithmetic.plus f64 r m'') = true).
      { destruct (andb _ _) in Fk.
        - destruct Fk as (_ & G1 & G2). split; [exact G1|]. now destruct (times_back _ _ G2).
        - destruct (Nb Fk) as (_ & ? & ? & _ & [G1 _] & [G2 _] & _). destruct (plus_back _ _ G1) as (G3 & _). destruct (plus_back _ _ G2) as (G4 & _). now split. }
      destruct G as [G1 G2]. destruct (plus_back _ _ G2) as (_ & Mr & _). destruct (two_sum_back a e) as (? & ? & [Ga _] & [Ge _] & _); [rewrite E4; exact G1|].
      assert (Ea : a = Arithmetic.plus f64 h (Arithmetic.opposite f64 m)) by (unfold sum_two_sum in E1; now injection E1 as <- _).
      assert (Ee : e = Arithmetic.plus f64 rest b) by (unfold sum_two_sum in E3; now injection E3 as <- _).
      assert (Eb : b = Arithmetic.plus f64 l (Arithmetic.opposite f64 m')) by (unfold sum_two_sum in E2; now injection E2 as <- _).
      rewrite Ea in Ga. destruct (plus_back _ _ Ga) as (_ & Gm & _). rewrite Ee in Ge. destruct (plus_back _ _ Ge) as (_ & Gb & _). rewrite Eb in Gb. destruct (plus_back _ _ Gb) as (_ & Gm' & _).
      split; [now destruct m|]. split; [now destruct m'|exact Mr]. }
    assert (M : fine_is (m, m', m'') (mul (exact q) y)).
    { pose proof (mul_back q y (Arithmetic.over f64 h h') h' l' r') as MB. cbv zeta in MB. rewrite Em in MB. apply MB; [now split|split; [now split|split; eapply fits_is; eassumption]|exact Fm]. }
    rewrite <- Ek. apply sub_back; [exact X|exact M|exact Px| |rewrite Ek; now repeat split].
    assert (Fq : generic_format radix2 (FLT_exp (-1074) 53) q) by (rewrite <- Q2; exact (generic_format_B2R 53 1024 _)).
    destruct (FineProducts.mul_stands (exact q) y q (high y + low y)) as [Pm _]; [now apply exact_stands|split; [exact Py|]|exact Pm].
    unfold holds. replace (_ - _ - _) with 0 by ring. rewrite Rabs_R0. now destruct Py as (_ & _ & _ & ? & _). }
  destruct Sub as (V1 & V2 & V3). destruct V1 as [_ V1], V2 as [_ V2], V3 as [_ V3], H as [_ H], R' as (_ & R' & _).
  destruct (is_power (-52) ltac:(lia)) as [_ P1]. destruct (is_power (-1060) ltac:(lia)) as [_ P2].
  assert (Ab : forall z : float, B2R (Arithmetic.absolute f64 z) = Rabs (B2R z)) by (intros; apply B2R_Babs).
  assert (Eq : q = R64 (high x / high y)) by (rewrite <- Q2, Q3, H, Hv; reflexivity). unfold over_positive. cbn [snd]. rewrite <- Eq.
  assert (Es : s = R64 (high (sub x (mul (exact q) y)) / high y)) by (rewrite <- S2, S3, V1, Hv; reflexivity). rewrite <- Es.
  match goal with |- fine_is _ (new q s ?c') => replace c' with c; [exact N|] end.
  rewrite <- C2, D2, D5, D7, D10, D11, D12, D13, W3, W4, !Ab, S2, V1, V2, V3, Hv, R', Bv, P1, P2. reflexivity.
Qed.

Lemma over_is h l r h' l' r' x y : fine_is (h, l, r) x -> fine_fits 900 (h', l', r') y -> proper x -> proper y ->
  let '(k, n, n', n'') := Fine_over f64 h l r h' l' r' in k = true -> fine_finite (n, n', n'') -> 0 < fst (over x y) /\ fine_is (n, n', n'') (snd (over x y)).
Proof.
  intros X Y Px Py. pose proof Y as (H' & L' & R'). unfold Fine_over, over, Fine_neg. rewrite (less_of _ _ _ _ (fits_is _ _ _ H') is_zero_constant).
  destruct (Rlt_bool_spec (high y) 0) as [N|N].
  - assert (Q : forall z, proper z -> proper (neg z)) by (intros z (F1 & F2 & F3 & F4 & F5); repeat split; cbn [neg high low radius]; try assumption; try (now apply F_opp); now rewrite !Rabs_Ropp).
    pose proof (over_positive_back (Arithmetic.opposite f64 h) (Arithmetic.opposite f64 l) r (Arithmetic.opposite f64 h') (Arithmetic.opposite f64 l') r' (neg x) (neg y)) as B.
    destruct (Fine_bounds f64 _ _ _) as [[[least ?] ?] ?]. cbv zeta in *. destruct (Fine_mul f64 _ _ _ _ _ _) as [[m m'] m'']. destruct (Fine_sub f64 _ _ _ _ _ _) as [[k k'] k'']. destruct (Fine_new f64 _ _ _) as [[i i'] i''].
    intros K Fin. apply andb_prop in K as [K _]. apply andb_prop in K as [K _]. apply B; try assumption; try now apply Q.
    + destruct X as (X1 & X2 & X3). split; [now apply opposite_of|]. split; [now apply opposite_of|exact X3].
    + split; [now apply opposite_is|]. split; [now apply opposite_is|exact R'].
    + cbn. lra.
  - pose proof (over_positive_back h l r h' l' r' x y X Y Px Py) as B.
    destruct (Fine_bounds f64 _ _ _) as [[[least ?] ?] ?]. cbv zeta in *. destruct (Fine_mul f64 _ _ _ _ _ _) as [[m m'] m'']. destruct (Fine_sub f64 _ _ _ _ _ _) as [[k k'] k'']. destruct (Fine_new f64 _ _ _) as [[i i'] i''].
    intros K Fin. apply andb_prop in K as [K _]. apply andb_prop in K as [K _]. now apply B.
Qed.

(** * The two ends *)

(** Ends that are one number are not far apart. *)
Lemma near_ends (h a b : float) : finite h = true -> finite a = true -> finite b = true -> R64 (B2R h + B2R a) = R64 (B2R h + B2R b) -> Rabs (R64 (B2R h + B2R a)) < bpow radix2 1024 ->
  B2R b - B2R a < bpow radix2 972.
Proof.
  intros H A B E T. assert (Fx : forall x : float, generic_format radix2 (FLT_exp (-1074) 53) (B2R x)) by (intros x; exact (generic_format_B2R 53 1024 x)).
  destruct (sum_off (B2R h) (B2R a) (Fx h) (Fx a)) as [_ S1]. destruct (sum_off (B2R h) (B2R b) (Fx h) (Fx b)) as [_ S2]. rewrite <- E in S2.
  apply Rabs_le_inv in S1, S2. replace 972%Z with (1 + (-53 + 1024))%Z by reflexivity. rewrite !bpow_plus. change (bpow radix2 1) with 2.
  assert (bpow radix2 (-53) * Rabs (R64 (B2R h + B2R a)) < bpow radix2 (-53) * bpow radix2 1024) by (apply Rmult_lt_compat_l; [apply bpow_gt_0|exact T]). lra.
Qed.
Lemma greatest : bpow radix2 972 <= B2R (@Bmax_float 53 1024 _ _).
Proof.
  apply Rle_trans with (F2R (Float radix2 2 971)); [|].
  - unfold F2R. cbn [Fnum Fexp]. change 972%Z with (1 + 971)%Z. rewrite bpow_plus. apply Rle_refl.
  - cbn. apply F2R_le. lia.
Qed.

(** If they are numbers, and one, what they are made of is numbers. *)
Lemma ends_finite (h l r : float) : let '(lo, _, hi, _) := Fine_bounds f64 h l r in finite lo = true -> finite hi = true -> B2R lo = B2R hi ->
  finite h = true /\ finite l = true /\ finite r = true.
Proof.
  unfold Fine_bounds, Interval_add, sum_two_sum. cbv zeta. set (a := Arithmetic.plus f64 l (Arithmetic.opposite f64 r)). set (b := Arithmetic.plus f64 l r).
  match goal with |- context [if ?c then a else _] => set (ca := c) end. match goal with |- context [if ?c then b else _] => set (cb := c) end.
  set (al := if ca then a else _). set (ah := if cb then b else _). intros L H E. destruct (plus_back _ _ L) as (Fh & Fa & Va). destruct (plus_back _ _ H) as (_ & Fb & Vb). split; [exact Fh|].
  assert (R : forall z : float, finite (Arithmetic.opposite f64 z) = true -> finite z = true) by (intros z; now destruct z).
  destruct (finite a) eqn:A; [destruct (plus_back _ _ A) as (X & Y & _); auto|]. destruct (finite b) eqn:B; [destruct (plus_back _ _ B) as (X & Y & _); auto|]. exfalso.
  assert (Ea : al = @Bmax_float 53 1024 _ _).
  { unfold al in *. destruct ca; [rewrite A in Fa; discriminate|]. destruct a as [| [] | |]; try discriminate A; try discriminate Fa. reflexivity. }
  assert (Eb : ah = Bopp (@Bmax_float 53 1024 _ _)).
  { unfold ah in *. destruct cb; [rewrite B in Fb; discriminate|]. destruct b as [| [] | |]; try discriminate B; try discriminate Fb. reflexivity. }
  assert (T : Rabs (R64 (B2R h + B2R ah)) < bpow radix2 1024) by (rewrite <- Vb; exact (abs_B2R_lt_emax 53 1024 _)).
  pose proof (near_ends h ah al Fh Fb Fa ltac:(rewrite <- Va, <- Vb; now symmetry) T) as N. rewrite Ea, Eb, B2R_Bopp in N. pose proof greatest. pose proof (bpow_gt_0 radix2 972). lra.
Qed.

(** Then they are those of [bounds]. *)
Lemma ends_are (h l r : float) z : fine_is (h, l, r) z -> proper z -> let '(lo, _, hi, _) := Fine_bounds f64 h l r in finite lo = true -> finite hi = true -> B2R lo = B2R hi ->
  is lo (fst (fst (bounds z))) /\ is hi (fst (snd (bounds z))).
Proof.
  intros (H & L & R) (F1 & F2 & F3 & F4 & F5).
  assert (L1 : Rabs (low z) <= bpow radix2 971).
  { apply Rle_trans with (1 := F5). change 971%Z with (-53 + 1024)%Z. rewrite bpow_plus. apply Rmult_le_compat_l; [apply bpow_ge_0|exact (is_top _ _ H)]. }
  assert (Main : Rabs (radius z) <= bpow radix2 972 -> let '(lo, _, hi, _) := Fine_bounds f64 h l r in finite lo = true -> finite hi = true -> B2R lo = B2R hi ->
    is lo (fst (fst (bounds z))) /\ is hi (fst (snd (bounds z)))).
  { intros R1. assert (L2 : Rabs (low z) <= bpow radix2 972) by (eapply Rle_trans; [exact L1|apply bpow_le; lia]).
    pose proof (around_of 972 l r z ltac:(lia) (is_fits _ _ _ L2 L) (is_fits _ _ _ R1 R)) as A. unfold Fine_bounds, bounds.
    destruct (Interval_add f64 _ _ _ _) as [a b]. destruct A as [A B]. destruct (Intervals.plus _ _) as [a' b']. cbn [fst snd] in *.
    destruct (sum_two_sum f64 h a) as [s t] eqn:E1. destruct (sum_two_sum f64 h b) as [s' t'] eqn:E2. unfold sum_two_sum in E1, E2. injection E1 as <- _. injection E2 as <- _.
    intros P Q _. unfold Expansion.two_sum. cbn [fst]. split; now apply plus_of. }
  destruct (Rle_or_lt (Rabs (radius z)) (bpow radix2 972)) as [S|S]; [now apply Main|]. clear Main. rewrite Rabs_pos_eq in S by exact F4.
  unfold Fine_bounds, Interval_add, sum_two_sum. cbv zeta. set (a := Arithmetic.plus f64 l (Arithmetic.opposite f64 r)). set (b := Arithmetic.plus f64 l r).
  match goal with |- context [if ?c then a else _] => set (ca := c) end. match goal with |- context [if ?c then b else _] => set (cb := c) end.
  set (al := if ca then a else _). set (ah := if cb then b else _). intros P Q E. destruct (plus_back _ _ P) as (Fh & Fa & Va). destruct (plus_back _ _ Q) as (_ & Fb & Vb). exfalso.
  destruct L as [Lf Lv], R as [Rf Rv]. apply Rabs_le_inv in L1. assert (E972 : bpow radix2 972 = 2 * bpow radix2 971) by (replace 972%Z with (1 + 971)%Z by reflexivity; rewrite bpow_plus; reflexivity).
  assert (No : finite (Arithmetic.opposite f64 r) = true) by (now destruct r). assert (Ro : B2R (Arithmetic.opposite f64 r) = - radius z) by (rewrite <- Rv; apply B2R_Bopp).
  pose proof (bpow_gt_0 radix2 971) as P971. assert (F971 : generic_format radix2 (FLT_exp (-1074) 53) (bpow radix2 971)) by (apply format_64; lia).
  assert (A : finite a = true -> B2R a <= - bpow radix2 971).
  { intros A. destruct (plus_back _ _ A) as (_ & _ & V). fold a in V. rewrite V, Lv, Ro. rewrite <- (R64_id (- bpow radix2 971)) by now apply F_opp. apply R64_le. lra. }
  assert (B : finite b = true -> bpow radix2 971 <= B2R b).
  { intros B. destruct (plus_back _ _ B) as (_ & _ & V). fold b in V. rewrite V, Lv, Rv. rewrite <- (R64_id (bpow radix2 971)) by exact F971. apply R64_le. lra. }
  assert (Sign : forall x : float, finite x = true -> B2R x < 0 -> Bsign x = true) by (intros [[]|[]| |[] m e ?] X Y; try discriminate X; try reflexivity; cbn in Y; try lra; exfalso; apply (Rlt_not_le _ _ Y); now apply F2R_ge_0).
  assert (Sign' : forall x : float, finite x = true -> 0 < B2R x -> Bsign x = false) by (intros [[]|[]| |[] m e ?] X Y; try discriminate X; try reflexivity; cbn in Y; try lra; exfalso; apply (Rlt_not_le _ _ Y); now apply F2R_le_0).
  assert (A' : finite a = true).
  { destruct (finite a) eqn:A0; [reflexivity|]. exfalso. assert (Ea : a = B754_infinity false).
    { unfold al in Fa. destruct ca; [rewrite A0 in Fa; discriminate|]. destruct a as [| [] | |]; try discriminate A0; try discriminate Fa. reflexivity. }
    pose proof (Bplus_correct 53 1024 _ _ mode_NE l (Arithmetic.opposite f64 r) Lf No) as C. change (Bplus mode_NE l (Arithmetic.opposite f64 r)) with a in C. destruct (Rlt_bool _ _); [rewrite A0 in C; destruct C as (_ & C & _); discriminate C|].
    destruct C as [C1 C2]. rewrite Ea in C1. rewrite (Sign (Arithmetic.opposite f64 r) No ltac:(rewrite Ro; lra)) in C2. rewrite C2 in C1. discriminate C1. }
  assert (B' : finite b = true).
  { destruct (finite b) eqn:B0; [reflexivity|]. exfalso. assert (Eb : b = B754_infinity true).
    { unfold ah in Fb. destruct cb; [rewrite B0 in Fb; discriminate|]. destruct b as [| [] | |]; try discriminate B0; try discriminate Fb. reflexivity. }
    pose proof (Bplus_correct 53 1024 _ _ mode_NE l r Lf Rf) as C. change (Bplus mode_NE l r) with b in C. destruct (Rlt_bool _ _); [rewrite B0 in C; destruct C as (_ & C & _); discriminate C|].
    destruct C as [C1 C2]. rewrite Eb in C1. rewrite (Sign' r Rf ltac:(rewrite Rv; lra)) in C2. rewrite C2 in C1. discriminate C1. }
  assert (Al : B2R al <= B2R a).
  { unfold al in *. destruct ca; [apply Rle_refl|]. pose proof (Bpred_correct 53 1024 _ _ a A') as C. change (Arithmetic.before f64 a) with (Bpred a) in *. destruct (Rlt_bool _ _).
    - rewrite (proj1 C). apply pred_le_id.
    - exfalso. rewrite <- is_finite_SF_B2SF, C in Fa. discriminate Fa. }
  assert (Ah : B2R b <= B2R ah).
  { unfold ah in *. destruct cb; [apply Rle_refl|]. pose proof (Bsucc_correct 53 1024 _ _ b B') as C. change (Arithmetic.after f64 b) with (Bsucc b) in *. destruct (Rlt_bool _ _).
    - rewrite (proj1 C). apply succ_ge_id.
    - exfalso. rewrite <- is_finite_SF_B2SF, C in Fb. discriminate Fb. }
  assert (T : Rabs (R64 (B2R h + B2R al)) < bpow radix2 1024) by (rewrite <- Va; exact (abs_B2R_lt_emax 53 1024 _)).
  pose proof (near_ends h al ah Fh Fa Fb ltac:(rewrite <- Va, <- Vb; exact E) T) as N. specialize (A A'). specialize (B B'). lra.
Qed.

(** What [FineDeterminants::nearest] tells, if it is a number: the quotient, rounded, and the divisor is not 0. [EXACT-10] *)
Theorem nearest_on_doubles h l r h' l' r' x y a b : fine_is (h, l, r) x -> fine_fits 900 (h', l', r') y -> stands x a -> stands y b ->
  let '(k, n, n', n'') := Fine_over f64 h l r h' l' r' in let '(lo, _, hi, _) := Fine_bounds f64 n n' n'' in
  andb k (Arithmetic.equal f64 lo hi) = true -> finite lo = true -> b <> 0 /\ B2R lo = R64 (a / b).
Proof.
  intros X Y Sx Sy. pose proof (over_is h l r h' l' r' x y X Y (proj1 Sx) (proj1 Sy)) as O. destruct (Fine_over f64 _ _ _ _ _ _) as [[[k n] n'] n''].
  pose proof (ends_finite n n' n'') as Ef. pose proof (fun z I P => ends_are n n' n'' z I P) as Ea. destruct (Fine_bounds f64 n n' n'') as [[[lo ?] hi] ?].
  intros C L. apply andb_prop in C as [K E]. assert (Hf : finite hi = true) by (destruct lo as [[]|[]| |[]], hi as [[]|[]| |[]]; try discriminate L; try discriminate E; reflexivity).
  assert (V : B2R lo = B2R hi). { change (Beqb lo hi = true) in E. rewrite (Beqb_correct 53 1024 lo hi L Hf) in E. revert E. now destruct (Req_bool_spec (B2R lo) (B2R hi)). }
  destruct (O K (Ef L Hf V)) as [P I]. destruct (over_stands x y a b Sx Sy P) as [N S]. split; [exact N|]. destruct (Ea _ I (proj1 S) L Hf V) as [[_ A] [_ B]].
  assert (W : between (bounds (snd (over x y))) = Some (B2R lo)).
  { unfold between. destruct (bounds (snd (over x y))) as [[s t] [s' t']]. cbn [fst snd] in A, B. rewrite <- A, <- B. now rewrite Req_bool_true by exact V. }
  exact (between_is_right _ _ _ S W).
Qed.
