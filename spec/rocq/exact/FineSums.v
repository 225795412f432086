(** Sums of src/geom/fine.rs, and what is told of a number: its sign, its bounds, its size. *)
Require Import Reals ZArith Lia Lra Psatz.
From Flocq Require Import Core Sterbenz.
Require Import StacklessExact.Rounding StacklessExact.Range StacklessExact.Expansion StacklessExact.Fine.
Require StacklessExact.Intervals.
Open Scope R_scope.

Local Instance prec_53 : Prec_gt_0 53 := eq_refl.
Notation u := (bpow radix2 (-53)).
Notation eta := (bpow radix2 (-1074)).

(** A sum of two doubles is one, or it is not small beside either. *)
Lemma no_loss x y : F x -> F y -> F (x + y) \/ (Rabs x <= 2 * Rabs (x + y) /\ Rabs y <= 2 * Rabs (x + y)).
Proof.
  assert (Half : forall a b, F a -> F b -> 0 <= a -> 0 <= b -> F (a - b) \/ (a <= 2 * Rabs (a - b) /\ b <= 2 * Rabs (a - b))).
  { intros a b A B Pa Pb. destruct (Rle_or_lt (b / 2) a) as [L|L]; [destruct (Rle_or_lt a (2 * b)) as [L'|L']|].
    - left. apply sterbenz; [typeclasses eauto..|assumption|assumption|lra].
    - right. split_Rabs; lra.
    - right. split_Rabs; lra. }
  intros X Y. destruct (Rle_or_lt 0 x) as [Px|Px], (Rle_or_lt 0 y) as [Py|Py].
  - right. split_Rabs; lra.
  - destruct (Half x (- y) X (F_opp _ Y)) as [H|H]; [lra..| |]; replace (x - - y) with (x + y) in H by ring; [now left|right]. split_Rabs; lra.
  - destruct (Half (- x) y (F_opp _ X) Y) as [H|H]; [lra..| |].
    + left. apply F_opp in H. now replace (- (- x - y)) with (x + y) in H by ring.
    + right. replace (- x - y) with (- (x + y)) in H by ring. rewrite Rabs_Ropp in H. split_Rabs; lra.
  - right. split_Rabs; lra.
Qed.

Lemma tri a b : Rabs (a + b) <= Rabs a + Rabs b.
Proof. apply Rabs_triang. Qed.

Section Sum.
Variables ah al bh bl : R.
Hypothesis Fah : F ah.
Hypothesis Fal : F al.
Hypothesis Fbh : F bh.
Hypothesis Fbl : F bl.
Hypothesis Ha : Rabs al <= u * Rabs ah.
Hypothesis Hb : Rabs bl <= u * Rabs bh.
Let s := R64 (ah + bh).
Let e := ah + bh - s.
Let t := R64 (al + bl).
Let f := al + bl - t.
Let c := R64 (e + t).
Let v := R64 (s + c).
Let w := s + c - v.
Let z := R64 (w + f).

(** The error of a sum is at most 8 u² of it, whatever cancels. [NEAR-5] *)
Theorem add_off : Rabs (ah + al + (bh + bl) - v - z) <= 8 * (u * (u * Rabs v)).
Proof.
  pose proof Hu as U. assert (Fs : F s) by apply F_R64. assert (Ft : F t) by apply F_R64. assert (Fe : F e) by now apply rest_F. assert (Ff : F f) by now apply rest_F.
  assert (Fc : F c) by apply F_R64. assert (Fv : F v) by apply F_R64. assert (Fw : F w) by now apply rest_F.
  destruct (sum_off s c Fs Fc) as [_ W]. fold v w in W. destruct (sum_off al bl Fal Fbl) as [T0 T]. fold t f in T0, T. destruct (sum_off w f Fw Ff) as [Z _]. fold z in Z.
  destruct (sum_off e t Fe Ft) as [C C']. fold c in C, C'. destruct (sum_off ah bh Fah Fbh) as [_ E]. fold s e in E.
  pose proof (tri w f) as WF. pose proof (Rabs_pos v) as Pv. set (V := Rabs v) in *.
  assert (UV : 0 <= u * V) by (apply Rmult_le_pos; lra). assert (UV' : u * V <= / 1048576 * V) by (apply Rmult_le_compat_r; lra). assert (UUV : u * (u * V) <= / 1048576 * (u * V)) by (apply Rmult_le_compat_r; lra).
  assert (UUUV : u * (u * (u * V)) <= / 1048576 * (u * (u * V))) by (apply Rmult_le_compat_r; [apply Rmult_le_pos|]; lra).
  assert (Pu : 0 <= u * (u * V)) by (apply Rmult_le_pos; lra).
  assert (Mul : forall a b, a <= b -> u * a <= u * b) by (intros; apply Rmult_le_compat_l; lra).
  destruct (no_loss ah bh Fah Fbh) as [G|[G1 G2]].
  - assert (e = 0) as E0 by (unfold e, s; rewrite R64_id by exact G; ring). assert (Ct : c = t) by (unfold c; rewrite E0, Rplus_0_l; now apply R64_id).
    replace (ah + al + (bh + bl) - v - z) with (w + f - z) by (unfold w, f; rewrite Ct; unfold e in E0; lra).
    destruct (no_loss s t Fs Ft) as [G'|[_ G2]].
    + assert (w = 0) as W0 by (unfold w, v; rewrite Ct, (R64_id (s + t)) by exact G'; ring). unfold z. rewrite W0, Rplus_0_l, (R64_id f) by exact Ff.
      replace (f - f) with 0 by ring. rewrite Rabs_R0. lra.
    + rewrite <- Ct in G2. assert (G3 : Rabs (s + c) <= V + u * V) by (replace (s + c) with (v + w) by (unfold w; ring); eapply Rle_trans; [apply tri|fold V; lra]).
      rewrite Ct in G2 at 1. apply Rle_trans with (1 := Z). apply Rle_trans with (u * (u * V + u * (2 * (V + u * V)))); [apply Mul|lra].
      apply Rle_trans with (1 := WF). apply Rplus_le_compat; [exact W|]. apply Rle_trans with (1 := T). apply Mul. lra.
  - set (S := Rabs s) in *. assert (Ps : 0 <= S) by apply Rabs_pos. assert (US : 0 <= u * S) by (apply Rmult_le_pos; lra).
    assert (UUS : u * (u * S) <= / 1048576 * (u * S)) by (apply Rmult_le_compat_r; lra). assert (USS : u * S <= / 1048576 * S) by (apply Rmult_le_compat_r; lra).
    assert (G3 : Rabs (ah + bh) <= S + u * S) by (replace (ah + bh) with (s + e) by (unfold e; ring); eapply Rle_trans; [apply tri|fold S; lra]).
    assert (AB : Rabs (al + bl) <= u * (2 * (S + u * S)) + u * (2 * (S + u * S))).
    { eapply Rle_trans; [apply tri|]. apply Rplus_le_compat; [eapply Rle_trans; [exact Ha|]|eapply Rle_trans; [exact Hb|]]; apply Mul; lra. }
    assert (AB' : Rabs (al + bl) <= 5 * (u * S)) by lra.
    assert (Tb : Rabs t <= Rabs (al + bl) + u * Rabs (al + bl)) by (replace t with (al + bl + - f) at 1 by (unfold f; ring); eapply Rle_trans; [apply tri|rewrite Rabs_Ropp; lra]).
    pose proof (Mul _ _ AB') as AB2. assert (Tb' : Rabs t <= 5 * (u * S) + 5 * (u * (u * S))) by lra.
    pose proof (tri e t) as ET. assert (ET' : Rabs (e + t) <= 6 * (u * S) + 5 * (u * (u * S))) by lra. assert (ET2 : Rabs (e + t) <= 61 / 10 * (u * S)) by lra.
    assert (Cb : Rabs c <= 7 * (u * S)).
    { replace c with (e + t + - (e + t - c)) by ring. eapply Rle_trans; [apply tri|]. rewrite Rabs_Ropp. pose proof (Mul _ _ ET2). lra. }
    assert (SV : S <= V + u * V + 7 * (u * S)).
    { apply Rle_trans with (Rabs (v + w + - c)); [apply Req_le; unfold S; f_equal; unfold w; ring|]. eapply Rle_trans; [apply tri|]. rewrite Rabs_Ropp.
      pose proof (tri v w) as VW. fold V in VW. lra. }
    assert (SV' : S <= 1001 / 1000 * V) by lra. pose proof (Mul _ _ SV') as USV. pose proof (Mul _ _ USV) as UUSV.
    replace (ah + al + (bh + bl) - v - z) with ((e + t - c) + (w + f - z)) by (unfold w, f, e; ring). eapply Rle_trans; [apply tri|].
    pose proof (Mul _ _ ET2) as ET3. pose proof (Mul _ _ Tb') as Tb2. pose proof (Mul _ _ WF) as WF2. pose proof (Mul _ _ W) as W2.
    assert (T2 : Rabs f <= u * (6 * (u * S))) by (eapply Rle_trans; [exact T|apply Mul; lra]). pose proof (Mul _ _ T2) as T3.
    assert (T4 : u * (u * (6 * (u * S))) <= u * (u * (/ 1000 * V))) by (apply Mul, Mul; lra).
    lra.
Qed.

(** What underflows of the radius, an error that is a double does not reach. *)
Lemma add_off_rounded : Rabs (ah + al + (bh + bl) - v - z) <= R64 (Rabs v * ERROR).
Proof.
  pose proof add_off as H. pose proof Hu as U. pose proof eta_pos as Pe.
  assert (Ee : ERROR = 16 * (u * u)) by (unfold ERROR; rewrite <- bpow_plus; change (-102)%Z with (4 + (-53 + -53))%Z; rewrite bpow_plus; reflexivity).
  assert (M : multiple (-1074) (ah + al + (bh + bl) - v - z)).
  { repeat first [apply multiple_minus | apply multiple_plus]; apply F_multiple; assumption || apply F_R64. }
  pose proof (Rabs_pos v) as Pv. assert (P : 0 <= Rabs v * ERROR) by (apply Rmult_le_pos; [exact Pv|unfold ERROR; apply bpow_ge_0]).
  destruct (multiple_big _ _ M) as [Z|B]; [rewrite Z, Rabs_R0; now apply R64_pos|].
  pose proof (product_low _ P) as L. rewrite Ee in L |- *. set (d := Rabs (_ - _)) in *. set (V := Rabs v) in *.
  assert (UUV : 0 <= u * (u * V)) by (repeat apply Rmult_le_pos; lra). assert (u * (u * (u * V)) <= / 1048576 * (u * (u * V))) by (apply Rmult_le_compat_r; lra).
  replace (V * (16 * (u * u)) * (1 - u)) with (16 * (u * (u * V)) - 16 * (u * (u * (u * V)))) in L by ring. lra.
Qed.
End Sum.

(** Sums stand for the sums of all that the two stand for. [NEAR-5] *)
Theorem add_stands x y r t : stands x r -> stands y t -> stands (add x y) (r + t).
Proof.
  destruct x as [ah al ar], y as [bh bl br]. intros [(Fah & Fal & Far & Pa & Ha) Va] [(Fbh & Fbl & Fbr & Pb & Hb) Vb]. unfold holds in Va, Vb.
  unfold add. cbn [high low radius] in *. rewrite (two_sum_is ah bh), (two_sum_is al bl) by assumption.
  rewrite (two_sum_is (ah + bh - R64 (ah + bh))) by (now apply rest_F || apply F_R64). rewrite two_sum_is by apply F_R64.
  pose proof (add_off_rounded ah al bh bl Fah Fal Fbh Fbl Ha Hb) as H.
  set (s := R64 (ah + bh)) in *. set (k := R64 (al + bl)) in *. set (c := R64 (ah + bh - s + k)) in *. set (v := R64 (s + c)) in *.
  set (w := s + c - v) in *. set (f := al + bl - k) in *.
  assert (Pq : 0 <= R64 (Rabs v * ERROR)) by (apply R64_pos, Rmult_le_pos; [apply Rabs_pos|apply bpow_ge_0]). assert (P : 0 <= ar + br) by lra. pose proof (R64_pos _ P) as P'.
  assert (V : Rabs ((r - ah - al) + (t - bh - bl)) <= ar + br) by (eapply Rle_trans; [apply tri|now apply Rplus_le_compat]). cbv zeta.
  destruct (andb _ _) eqn:D.
  - apply andb_prop in D as [D1 D2]. revert D1 D2. destruct (Req_bool_spec (ah + bh - s + k - c) 0) as [Zc|], (Req_bool_spec f 0) as [Zf|]; try discriminate. intros _ _.
    split; [repeat split; cbn [high low radius]|].
    + apply F_R64.
    + apply rest_F; apply F_R64.
    + apply F_R64.
    + apply R64_pos, Rmult_le_pos; [exact P'|]. rewrite UP_is. pose proof Hu. lra.
    + apply sum_off; apply F_R64.
    + unfold holds. cbn [high low radius]. replace (r + t - v - w) with ((r - ah - al) + (t - bh - bl)) by (unfold w; unfold f in Zf; lra).
      eapply Rle_trans; [exact V|]. now apply up_two.
  - apply new_stands; [apply F_R64|apply F_R64|apply F_R64|apply R64_pos; lra|].
    eapply Rle_trans; [|apply up_three; [exact Far|exact Fbr|apply F_R64|exact Pa|exact Pb|exact Pq]].
    replace (r + t - v - R64 (w + f)) with ((r - ah - al) + (t - bh - bl) + (ah + al + (bh + bl) - v - R64 (w + f))) by ring.
    eapply Rle_trans; [apply tri|]. now apply Rplus_le_compat.
Qed.

(** [NEAR-5] *)
Theorem neg_stands x r : stands x r -> stands (neg x) (- r).
Proof.
  destruct x as [h l d]. intros [(Fh & Fl & Fd & P & H) V]. unfold holds in V. cbn [high low radius] in *. split; [repeat split; cbn [neg high low radius]; try assumption; try now apply F_opp|].
  - now rewrite !Rabs_Ropp.
  - unfold holds. cbn [neg high low radius]. replace (- r - - h - - l) with (- (r - h - l)) by ring. now rewrite Rabs_Ropp.
Qed.
(** [NEAR-5] *)
Theorem sub_stands x y r t : stands x r -> stands y t -> stands (sub x y) (r - t).
Proof. intros X Y. apply add_stands; [exact X|now apply neg_stands]. Qed.

(** A sign that is told is that of all. [EXACT-10] *)
Theorem sign_is_right x r s : stands x r -> sign x = Some s -> (0 < r <-> 0 < s) /\ (r < 0 <-> s < 0) /\ (r = 0 <-> s = 0).
Proof.
  destruct x as [h l d]. intros [(Fh & Fl & Fd & P & H) V] S. unfold holds in V. unfold sign, is_zero, is_exact in S. cbn [high low radius] in *.
  destruct (orb _ _) eqn:C; [|discriminate]. injection S as <-. apply Bool.orb_prop in C as [C|C].
  - apply andb_prop in C as [C1 C2]. revert C1 C2. destruct (Req_bool_spec h 0) as [->|], (Req_bool_spec d 0) as [->|]; try discriminate. intros _ _.
    rewrite Rabs_R0 in H. split_Rabs; lra.
  - apply ltb_true in C. pose proof (up_two (Rabs l) d (F_abs _ Fl) Fd (Rabs_pos l) P). split_Rabs; lra.
Qed.

(** Bounds are on both sides of all. [NEAR-5] *)
Theorem bounds_hold x r : stands x r -> let '(below, above) := bounds x in pair_sum below <= r <= pair_sum above.
Proof.
  destruct x as [h l d]. intros [(Fh & Fl & Fd & P & H) V]. unfold holds in V. unfold bounds. cbn [high low radius] in *.
  destruct (Intervals.plus_holds (l, l) (- d, d) l (r - h - l)) as [[F1 F2] [B1 B2]]; [split; exact Fl|split; [now apply F_opp|exact Fd]|split; cbn; lra|apply Rabs_le_inv, V|].
  rewrite !two_sum_is_exact by assumption. lra.
Qed.

(** [is_within]: all are at most some more than twice as great. [EXACT-10] *)
Theorem is_within_is_right x r most : stands x r -> is_within x most = true -> Rabs r <= (2 + u) * most.
Proof.
  destruct x as [h l d]. intros [(Fh & Fl & Fd & P & H) V] W. unfold holds in V. unfold is_within in W. cbn [high low radius] in *. apply andb_prop in W as [W1 W2].
  revert W1 W2. destruct (Rle_bool_spec (Rabs h) most) as [W1|], (Rle_bool_spec d most) as [W2|]; try discriminate. intros _ _.
  pose proof Hu as U. assert (u * Rabs h <= u * most) by (apply Rmult_le_compat_l; lra).
  replace r with ((r - h - l) + (h + l)) by ring. eapply Rle_trans; [apply tri|]. pose proof (tri h l). lra.
Qed.
