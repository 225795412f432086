(** For data on a grid that is not too fine nothing underflows in double precision: every operation of Filter.v gives the same
    with gradual underflow (f64) as with relative errors only. So the theorems hold for f64. Single-precision data are on the grid
    of 2^-149, double-precision data of EXACT-7 on that of 2^-252. *)
Require Import Reals ZArith Lia Lra Psatz.
From Flocq Require Import Core.
Require Import StacklessExact.Rounding StacklessExact.Triple StacklessExact.Filter StacklessExact.Quotient.
Open Scope R_scope.

(** f64, without a greatest exponent. *)
Notation R64 := (round radix2 (FLT_exp (-1074) 53) ZnearestE).
Notation RX := (round radix2 (FLX_exp 53) ZnearestE).
Notation u := (Rounding.unit 53).

Local Instance prec_53 : Prec_gt_0 53 := eq_refl.

(** A multiple of 2^e from 2^-1022 on is rounded alike, and stays a multiple. *)
Lemma same e x : (-1022 <= e)%Z -> multiple e x -> R64 x = RX x /\ multiple e (RX x).
Proof. intros He H. split; [apply (same_if_multiple (-1074) 53 e); [assumption|lia]|now apply multiple_round]. Qed.

Definition vmultiple (e : Z) (v : vec) : Prop := multiple e (vx v) /\ multiple e (vy v) /\ multiple e (vz v).

Ltac grid := repeat first [ assumption | apply multiple_minus | apply multiple_plus | apply multiple_mult ].

Lemma vsub_same e a b : (-1022 <= e)%Z -> vmultiple e a -> vmultiple e b -> vsub R64 a b = vsub RX a b /\ vmultiple e (vsub RX a b).
Proof.
  intros He (A1 & A2 & A3) (B1 & B2 & B3). unfold vsub, vmultiple. cbn [vx vy vz].
  destruct (same e (vx a - vx b) He) as [E1 M1]; [grid|]. destruct (same e (vy a - vy b) He) as [E2 M2]; [grid|].
  destruct (same e (vz a - vz b) He) as [E3 M3]; [grid|]. rewrite E1, E2, E3. auto.
Qed.

Lemma two_same e a b c d : (-1022 <= e + e)%Z -> multiple e a -> multiple e b -> multiple e c -> multiple e d ->
  R64 (R64 (a * b) - R64 (c * d)) = RX (RX (a * b) - RX (c * d)) /\ multiple (e + e) (RX (RX (a * b) - RX (c * d))).
Proof.
  intros He A B C D. destruct (same (e + e) (a * b) He) as [E1 M1]; [grid|].
  destruct (same (e + e) (c * d) He) as [E2 M2]; [grid|]. rewrite E1, E2. apply same; [assumption|grid].
Qed.

Lemma cross_same e a b : (-1022 <= e + e)%Z -> vmultiple e a -> vmultiple e b ->
  cross R64 a b = cross RX a b /\ vmultiple (e + e) (cross RX a b).
Proof.
  intros He (A1 & A2 & A3) (B1 & B2 & B3). unfold cross, vmultiple. cbn [vx vy vz].
  destruct (two_same e (vy a) (vz b) (vy b) (vz a)) as [E1 M1]; auto.
  destruct (two_same e (vz a) (vx b) (vz b) (vx a)) as [E2 M2]; auto.
  destruct (two_same e (vx a) (vy b) (vx b) (vy a)) as [E3 M3]; auto.
  rewrite E1, E2, E3. auto.
Qed.

Lemma dot_same e e' a b : (-1022 <= e + e')%Z -> vmultiple e a -> vmultiple e' b ->
  dot R64 a b = dot RX a b /\ multiple (e + e') (dot RX a b).
Proof.
  intros He (A1 & A2 & A3) (B1 & B2 & B3). unfold dot.
  destruct (same (e + e') (vx a * vx b) He) as [E1 M1]; [grid|]. destruct (same (e + e') (vy a * vy b) He) as [E2 M2]; [grid|].
  destruct (same (e + e') (vz a * vz b) He) as [E3 M3]; [grid|]. rewrite E1, E2, E3.
  destruct (same (e + e') (RX (vx a * vx b) + RX (vy a * vy b)) He) as [E4 M4]; [grid|]. rewrite E4.
  apply same; [assumption|grid].
Qed.

(** Single-precision numbers are multiples of 2^-149. *)
Definition single (v : vec) : Prop := vmultiple (-149) v.

Section Grid.
Variable g : Z.
Hypothesis Hg : (-322 <= g <= 0)%Z.
Variables v0 v1 v2 o d : vec.
Hypothesis H0 : vmultiple g v0.
Hypothesis H1 : vmultiple g v1.
Hypothesis H2 : vmultiple g v2.
Hypothesis Ho : vmultiple g o.
Hypothesis Hd : vmultiple g d.

(** [Determinants::of] does not underflow: all values are multiples of 2^3g, so of 2^-447 for single-precision data.
    [EXACT-6, EXACT-7] *)
Theorem determinants_do_not_underflow : determinants_of R64 v0 v1 v2 o d = determinants_of RX v0 v1 v2 o d.
Proof.
  unfold determinants_of.
  destruct (vsub_same g v1 v0) as [-> M1]; auto; try lia. destruct (vsub_same g v2 v0) as [-> M2]; auto; try lia.
  destruct (vsub_same g o v0) as [-> M3]; auto; try lia.
  set (e1 := vsub RX v1 v0) in *. set (e2 := vsub RX v2 v0) in *. set (s := vsub RX o v0) in *. clearbody e1 e2 s.
  destruct (cross_same g d e2) as [-> Mp]; auto; try lia. destruct (cross_same g s e1) as [-> Mq]; auto; try lia.
  set (p := cross RX d e2) in *. set (q := cross RX s e1) in *. clearbody p q. cbv zeta.
  destruct (dot_same g (g + g) e1 p ltac:(lia) M1 Mp) as [-> Md]. destruct (dot_same g (g + g) s p ltac:(lia) M3 Mp) as [-> Mu].
  destruct (dot_same g (g + g) d q ltac:(lia) Hd Mq) as [-> Mv]. destruct (dot_same g (g + g) e2 q ltac:(lia) M2 Mq) as [-> _].
  destruct (same (g + (g + g)) (dot RX e1 p - dot RX s p) ltac:(lia)) as [-> M5]; [grid|].
  destruct (same (g + (g + g)) (RX (dot RX e1 p - dot RX s p) - dot RX d q) ltac:(lia)) as [-> M6]; [grid|]. reflexivity.
Qed.

Variables D C E : R.
Hypothesis GD : multiple g D.
Hypothesis GC : multiple g C.
Hypothesis GE : multiple g E.

Lemma constant n : multiple (-55) (IZR n * / 4 * u).
Proof.
  exists n. rewrite Rmult_assoc. f_equal. change (/ 4) with (bpow radix2 (-2)). rewrite <- bpow_plus. reflexivity.
Qed.

(** Nor does σ. [EXACT-6, EXACT-7] *)
Theorem sigma_does_not_underflow : error_sign R64 u D C E = error_sign RX u D C E.
Proof.
  unfold error_sign. destruct (same (g + g) (D * E) ltac:(lia)) as [-> M1]; [grid|].
  assert (K : multiple (-55) (78 * u)) by (replace (78 * u) with (312 * / 4 * u) by lra; apply constant).
  destruct (same (-55 + (g + g)) (78 * u * RX (D * E)) ltac:(lia)) as [-> M2]; [grid|].
  destruct (same g (C + E) ltac:(lia)) as [-> M3]; [grid|].
  apply (same (-55 + (g + g) + g)); [lia|grid].
Qed.

Hypothesis HD : bounded D d.
Hypothesis HC : bounded C (vsub R64 o v0).
Hypothesis HE : bounded E (vsub R64 v1 v0) /\ bounded E (vsub R64 v2 v0).
Let found := determinants_of R64 v0 v1 v2 o d.
Let truth := determinants_of exactly v0 v1 v2 o d.
Let sigma := error_sign R64 u D C E.

Let bounds : bounded C (vsub RX o v0) /\ bounded E (vsub RX v1 v0) /\ bounded E (vsub RX v2 v0).
Proof.
  destruct (vsub_same g v1 v0) as [<- _]; auto; try lia. destruct (vsub_same g v2 v0) as [<- _]; auto; try lia.
  destruct (vsub_same g o v0) as [<- _]; auto; try lia.
Qed.

(** In double precision, with gradual underflow: a certain miss is one. [EXACT-6, EXACT-7] *)
Theorem miss_in_double neg : sign_bit neg (det found) -> is_miss neg sigma found -> ~ meets truth.
Proof.
  unfold found, sigma. rewrite determinants_do_not_underflow, sigma_does_not_underflow. destruct bounds as [BC BE].
  exact (is_miss_is_right 53 ltac:(lia) v0 v1 v2 o d D C E HD BC BE neg).
Qed.

(** And a certain hit. [EXACT-6, EXACT-7] *)
Theorem hit_in_double neg : is_hit neg sigma found -> meets truth.
Proof.
  unfold found, sigma. rewrite determinants_do_not_underflow, sigma_does_not_underflow. destruct bounds as [BC BE].
  exact (is_hit_is_right 53 ltac:(lia) v0 v1 v2 o d D C E HD BC BE neg).
Qed.
End Grid.
