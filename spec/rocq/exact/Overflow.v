(** [Determinants::of] and [Errors::new] of src/geom/kernel/exact/filter.rs on IEEE 754 doubles, as Flocq has them: for
    single-precision data no operation overflows, so every result is finite, and is the number that Range.v speaks of. *)
Require Import Reals ZArith Lia Lra Psatz.
From Flocq Require Import Core BinarySingleNaN.
Require Import StacklessExact.Rounding StacklessExact.Triple StacklessExact.Filter StacklessExact.Quotient StacklessExact.Range.
Open Scope R_scope.

Local Instance prec_53 : Prec_gt_0 53 := eq_refl.
Local Instance emax_1024 : Prec_lt_emax 53 1024 := eq_refl.
Local Instance prec_24 : Prec_gt_0 24 := eq_refl.

(** * The code *)

Notation float := (binary_float 53 1024).
Definition plus (x y : float) : float := Bplus mode_NE x y.
Definition minus (x y : float) : float := Bminus mode_NE x y.
Definition times (x y : float) : float := Bmult mode_NE x y.
Definition over (x y : float) : float := Bdiv mode_NE x y.

(** [DVec3], and its operators as glam has them. *)
Record fvec : Type := FVec { fx : float; fy : float; fz : float }.
Definition fsub (a b : fvec) : fvec := FVec (minus (fx a) (fx b)) (minus (fy a) (fy b)) (minus (fz a) (fz b)).
Definition fcross (a b : fvec) : fvec :=
  FVec (minus (times (fy a) (fz b)) (times (fy b) (fz a))) (minus (times (fz a) (fx b)) (times (fz b) (fx a)))
    (minus (times (fx a) (fy b)) (times (fx b) (fy a))).
Definition fdot (a b : fvec) : float := plus (plus (times (fx a) (fx b)) (times (fy a) (fy b))) (times (fz a) (fz b)).

(** [Determinants::of]. *)
Record code : Type := Code { f_det : float; f_u : float; f_v : float; f_w : float; f_t : float }.
Definition code_of (v0 v1 v2 o d : fvec) : code :=
  let e1 := fsub v1 v0 in
  let e2 := fsub v2 v0 in
  let s := fsub o v0 in
  let p := fcross d e2 in
  let q := fcross s e1 in
  let det := fdot e1 p in
  let u := fdot s p in
  let v := fdot d q in
  Code det u v (minus (minus det u) v) (fdot e2 q).

(** Constants: an integer times a power of two. *)
Definition constant (n e : Z) : float := binary_normalize 53 1024 _ _ mode_NE n e false.

(** [Errors::new]: SIGN, DETERMINANT and DISTANCE times UNIT, the last two times QUOTIENT_FACTOR. *)
Definition code_sign (d c e : float) : float := times (times (constant 78 (-53)) (times d e)) (plus c e).
Definition code_det (d e : float) : float := times (constant (31 * 5) (-55)) (times d (times e e)).
Definition code_t (c e : float) : float := times (constant (35 * 5) (-55)) (times c (times e e)).

(** * Operations that do not overflow *)

(** The float is finite, it is that number, and it is at most a power of two. *)
Definition fits (e : Z) (x : float) (r : R) : Prop := is_finite x = true /\ B2R x = r /\ Rabs r <= bpow radix2 e.

Lemma fits_more e e' x r : fits e x r -> (e <= e')%Z -> fits e' x r.
Proof. intros (F & V & B) H. repeat split; try assumption. eapply Rle_trans; [exact B|now apply bpow_le]. Qed.

Lemma format_64 e : (-1074 <= e)%Z -> generic_format radix2 (FLT_exp (-1074) 53) (bpow radix2 e).
Proof. intros. apply generic_format_bpow. unfold FLT_exp. lia. Qed.

Lemma R64_b e x : (-1074 <= e)%Z -> Rabs x <= bpow radix2 e -> Rabs (R64 x) <= bpow radix2 e.
Proof. intros He H. apply abs_round_le_generic; [typeclasses eauto|typeclasses eauto|now apply format_64|exact H]. Qed.

Lemma below_top e x : (-1074 <= e <= 1023)%Z -> Rabs x <= bpow radix2 e -> Rabs (R64 x) < bpow radix2 1024.
Proof. intros He H. apply Rle_lt_trans with (bpow radix2 e); [apply R64_b; [lia|exact H]|apply bpow_lt; lia]. Qed.

Lemma twice e : bpow radix2 e + bpow radix2 e = bpow radix2 (e + 1).
Proof. rewrite bpow_plus. change (bpow radix2 1) with 2. ring. Qed.

Lemma minus_fits e x y a b : (-1074 <= e < 1023)%Z -> fits e x a -> fits e y b -> fits (e + 1) (minus x y) (R64 (a - b)).
Proof.
  intros He (Fx & <- & Bx) (Fy & <- & By). pose proof (sub_b _ _ _ _ Bx By) as S. rewrite twice in S.
  generalize (Bminus_correct 53 1024 _ _ mode_NE x y Fx Fy). rewrite Rlt_bool_true by (apply (below_top (e + 1)); [lia|exact S]).
  intros (V & F & _). split; [exact F|split; [exact V|]]. apply R64_b; [lia|exact S].
Qed.

Lemma plus_fits e x y a b : (-1074 <= e < 1023)%Z -> fits e x a -> fits e y b -> fits (e + 1) (plus x y) (R64 (a + b)).
Proof.
  intros He (Fx & <- & Bx) (Fy & <- & By). pose proof (add_b _ _ _ _ Bx By) as S. rewrite twice in S.
  generalize (Bplus_correct 53 1024 _ _ mode_NE x y Fx Fy). rewrite Rlt_bool_true by (apply (below_top (e + 1)); [lia|exact S]).
  intros (V & F & _). split; [exact F|split; [exact V|]]. apply R64_b; [lia|exact S].
Qed.

(** A product that is known to be at most 2^e. *)
Lemma times_fits_at e ex ey x y a b : (-1074 <= e <= 1023)%Z -> Rabs (a * b) <= bpow radix2 e ->
  fits ex x a -> fits ey y b -> fits e (times x y) (R64 (a * b)).
Proof.
  intros He S (Fx & <- & Bx) (Fy & <- & By).
  generalize (Bmult_correct 53 1024 _ _ mode_NE x y). rewrite Rlt_bool_true by (apply (below_top e); [lia|exact S]).
  rewrite Fx, Fy. intros (V & F & _). split; [exact F|split; [exact V|]]. apply R64_b; [lia|exact S].
Qed.

Lemma times_fits e e' x y a b : (-1074 <= e + e' <= 1023)%Z -> fits e x a -> fits e' y b -> fits (e + e') (times x y) (R64 (a * b)).
Proof.
  intros He X Y. apply (times_fits_at (e + e') e e'); try assumption. rewrite bpow_plus.
  destruct X as (_ & _ & Bx), Y as (_ & _ & By). now apply mul_b.
Qed.

Definition vfits (e : Z) (v : fvec) (r : vec) : Prop := fits e (fx v) (vx r) /\ fits e (fy v) (vy r) /\ fits e (fz v) (vz r).

Lemma sub_fits e a b a' b' : (-1074 <= e < 1023)%Z -> vfits e a a' -> vfits e b b' -> vfits (e + 1) (fsub a b) (vsub R64 a' b').
Proof. intros He (A1 & A2 & A3) (B1 & B2 & B3). split; [|split]; apply minus_fits; assumption || lia. Qed.

Lemma cross_fits e e' a b a' b' : (-1074 <= e + e' < 1023)%Z -> vfits e a a' -> vfits e' b b' ->
  vfits (e + e' + 1) (fcross a b) (cross R64 a' b').
Proof.
  intros He (A1 & A2 & A3) (B1 & B2 & B3). unfold fcross, cross.
  split; [|split]; cbn [fx fy fz vx vy vz]; apply minus_fits; try lia;
    try (apply times_fits; assumption || lia); rewrite Z.add_comm; apply times_fits; assumption || lia.
Qed.

Lemma dot_fits e e' a b a' b' : (-1074 <= e + e' < 1022)%Z -> vfits e a a' -> vfits e' b b' ->
  fits (e + e' + 2) (fdot a b) (dot R64 a' b').
Proof.
  intros He (A1 & A2 & A3) (B1 & B2 & B3). unfold fdot, dot. replace (e + e' + 2)%Z with (e + e' + 1 + 1)%Z by lia.
  apply plus_fits; [lia| |].
  - apply plus_fits; [lia|apply times_fits; assumption || lia..].
  - apply fits_more with (e + e')%Z; [|lia]. apply times_fits; assumption || lia.
Qed.

(** [Determinants::of] for data of at most 2^t. *)
Lemma code_fits t v0 v1 v2 o d r0 r1 r2 ro rd : (0 <= t <= 300)%Z ->
  vfits t v0 r0 -> vfits t v1 r1 -> vfits t v2 r2 -> vfits t o ro -> vfits t d rd ->
  let c := code_of v0 v1 v2 o d in let x := determinants_of R64 r0 r1 r2 ro rd in
  fits (3 * t + 5) (f_det c) (det x) /\ fits (3 * t + 5) (f_u c) (edge_u x) /\ fits (3 * t + 5) (f_v c) (edge_v x) /\
  fits (3 * t + 7) (f_w c) (edge_w x) /\ fits (3 * t + 6) (f_t c) (top_t x).
Proof.
  intros Ht H0 H1 H2 Ho D c x. pose proof (sub_fits t _ _ _ _ ltac:(lia) H1 H0) as E1. pose proof (sub_fits t _ _ _ _ ltac:(lia) H2 H0) as E2.
  pose proof (sub_fits t _ _ _ _ ltac:(lia) Ho H0) as S.
  pose proof (cross_fits t (t + 1) _ _ _ _ ltac:(lia) D E2) as P. pose proof (cross_fits (t + 1) (t + 1) _ _ _ _ ltac:(lia) S E1) as Q.
  pose proof (fits_more _ (3 * t + 5) _ _ (dot_fits (t + 1) (t + (t + 1) + 1) _ _ _ _ ltac:(lia) E1 P) ltac:(lia)) as Fdet.
  pose proof (fits_more _ (3 * t + 5) _ _ (dot_fits (t + 1) (t + (t + 1) + 1) _ _ _ _ ltac:(lia) S P) ltac:(lia)) as Fu.
  pose proof (fits_more _ (3 * t + 5) _ _ (dot_fits t (t + 1 + (t + 1) + 1) _ _ _ _ ltac:(lia) D Q) ltac:(lia)) as Fv.
  pose proof (fits_more _ (3 * t + 6) _ _ (dot_fits (t + 1) (t + 1 + (t + 1) + 1) _ _ _ _ ltac:(lia) E2 Q) ltac:(lia)) as Ft.
  pose proof (minus_fits (3 * t + 5) _ _ _ _ ltac:(lia) Fdet Fu) as W1.
  pose proof (minus_fits (3 * t + 5 + 1) _ _ _ _ ltac:(lia) W1 (fits_more _ (3 * t + 5 + 1) _ _ Fv ltac:(lia))) as W2.
  split; [exact Fdet|split; [exact Fu|split; [exact Fv|split; [|exact Ft]]]]. apply fits_more with (1 := W2). lia.
Qed.

(** * Single-precision data *)

(** A float of single precision, widened. *)
Definition is_single (x : float) : Prop :=
  is_finite x = true /\ generic_format radix2 (FLT_exp (-149) 24) (B2R x) /\ Rabs (B2R x) < bpow radix2 128.
Definition v_single (v : fvec) : Prop := is_single (fx v) /\ is_single (fy v) /\ is_single (fz v).
Definition real (v : fvec) : vec := Vec (B2R (fx v)) (B2R (fy v)) (B2R (fz v)).

(** The greatest one, and the greatest difference. *)
Notation z := (1 - / 16777216).
Definition greatest : R := z * bpow radix2 128.
Definition widest : R := z * bpow radix2 129.

Lemma single_multiple x : is_single x -> multiple (-149) (B2R x).
Proof.
  intros (_ & G & _). apply FLT_format_generic in G; [|typeclasses eauto]. destruct G as [[m e] -> _ He]. simpl in He.
  exists (m * 2 ^ (e + 149))%Z. unfold F2R. simpl Fnum. simpl Fexp.
  rewrite mult_IZR, (IZR_Zpower radix2) by lia. rewrite Rmult_assoc, <- bpow_plus. do 2 f_equal. lia.
Qed.

Lemma single_most x : is_single x -> Rabs (B2R x) <= greatest.
Proof.
  intros (_ & G & B). apply generic_format_abs in G.
  apply (pred_ge_gt radix2 (FLT_exp (-149) 24)) in B; [|exact G|apply generic_format_bpow; unfold FLT_exp; lia].
  rewrite pred_bpow in B. change (FLT_exp (-149) 24 128) with (128 + -24)%Z in B. rewrite bpow_plus in B.
  change (bpow radix2 (-24)) with (/ 16777216) in B. unfold greatest. lra.
Qed.

Lemma single_fits x : is_single x -> fits 128 x (B2R x).
Proof. intros (F & _ & B). repeat split; [exact F|lra]. Qed.

Lemma v_fits v : v_single v -> vfits 128 v (real v).
Proof. intros (X & Y & Z). split; [|split]; now apply single_fits. Qed.

Lemma v_multiple v : v_single v -> single (real v).
Proof. intros (X & Y & Z). repeat split; now apply single_multiple. Qed.

Lemma v_most v : v_single v -> bounded greatest (real v).
Proof. intros (X & Y & Z). repeat split; now apply single_most. Qed.

Lemma difference_most a b : v_single a -> v_single b -> bounded widest (vsub R64 (real a) (real b)).
Proof.
  intros A B. pose proof (v_most a A) as (A1 & A2 & A3). pose proof (v_most b B) as (B1 & B2 & B3).
  assert (W : generic_format radix2 (FLT_exp (-1074) 53) widest).
  { replace widest with (F2R (Float radix2 16777215 105)).
    - apply generic_format_FLT. exists (Float radix2 16777215 105); simpl; [reflexivity|lia|lia].
    - unfold widest, F2R. simpl Fnum. simpl Fexp. replace 129%Z with (24 + 105)%Z by reflexivity. rewrite (bpow_plus _ 24).
      change (bpow radix2 24) with 16777216. field. }
  assert (D : greatest + greatest = widest).
  { unfold greatest, widest. change 129%Z with (128 + 1)%Z. rewrite <- twice. ring. }
  assert (S : forall x y, Rabs x <= greatest -> Rabs y <= greatest -> Rabs (R64 (x - y)) <= widest).
  { intros x y Hx Hy. apply abs_round_le_generic; [typeclasses eauto|typeclasses eauto|exact W|]. rewrite <- D. now apply sub_b. }
  repeat split; apply S; assumption.
Qed.

Section Single.
Variables v0 v1 v2 o d : fvec.
Hypothesis H0 : v_single v0.
Hypothesis H1 : v_single v1.
Hypothesis H2 : v_single v2.
Hypothesis Ho : v_single o.
Hypothesis Hd : v_single d.
Let found := determinants_of R64 (real v0) (real v1) (real v2) (real o) (real d).
Let result := code_of v0 v1 v2 o d.

(** What the roundings of a triple product add is less than what the sizes are below powers of two. *)
Lemma triple_most x y w X Y W e : bounded (z * bpow radix2 X) x -> bounded (z * bpow radix2 Y) y -> bounded (z * bpow radix2 W) w ->
  (X + Y + W + 2 <= e)%Z -> Rabs (dot RX x (cross RX y w)) <= bpow radix2 e.
Proof.
  intros Bx By Bw He. pose proof (triple_fl 53 ltac:(lia) x y w _ _ _ Bx By Bw) as T.
  pose proof Bx as (X1 & X2 & X3). pose proof By as (Y1 & Y2 & Y3). pose proof Bw as (W1 & W2 & W3).
  pose proof (det3_b _ _ _ _ _ _ _ _ _ _ _ _ X1 X2 X3 Y1 Y2 Y3 W1 W2 W3) as D.
  pose proof (add_b _ _ _ _ T D) as S. match type of S with Rabs ?a <= _ =>
    replace a with (dot RX x (cross RX y w)) in S by ring end.
  eapply Rle_trans; [exact S|]. eapply Rle_trans; [|apply bpow_le, He]. rewrite !bpow_plus.
  change (bpow radix2 2) with 4. set (b := bpow radix2 X * bpow radix2 Y * bpow radix2 W).
  assert (P : 0 <= b) by (unfold b; repeat apply Rmult_le_pos; apply bpow_ge_0).
  replace (z * bpow radix2 X * (z * bpow radix2 Y) * (z * bpow radix2 W)) with (z * z * z * b) by (unfold b; ring).
  assert (U : 0 < u <= / 1073741824).
  { split; [apply bpow_gt_0|]. change (/ 1073741824) with (bpow radix2 (-30)). apply bpow_le. lia. }
  assert (UU : u * u <= u * 1) by (apply Rmult_le_compat_l; lra).
  replace ((22 * u + 49 * (u * u)) * (z * z * z * b) + 4 * (z * z * z * b)) with
    ((22 * u + 49 * (u * u) + 4) * (z * z * z) * b) by ring.
  rewrite (Rmult_comm b). apply Rmult_le_compat_r; [exact P|]. lra.
Qed.

(** [Determinants::of] does not overflow: every result is finite and is what Range.v says. An infinity or a NaN on the way would be
    one at the end. det, U and V are at most 2^388, W and T at most 2^390. [EXACT-6] *)
Theorem determinants_do_not_overflow :
  fits 388 (f_det result) (det found) /\ fits 388 (f_u result) (edge_u found) /\ fits 388 (f_v result) (edge_v found) /\
  fits 390 (f_w result) (edge_w found) /\ fits 390 (f_t result) (top_t found).
Proof.
  destruct (code_fits 128 v0 v1 v2 o d _ _ _ _ _ ltac:(lia) (v_fits _ H0) (v_fits _ H1) (v_fits _ H2) (v_fits _ Ho) (v_fits _ Hd))
    as (Fdet & Fu & Fv & _ & Ft). fold result found in Fdet, Fu, Fv, Ft. simpl Z.add in Ft.
  assert (M : Rabs (det found) <= bpow radix2 388 /\ Rabs (edge_u found) <= bpow radix2 388 /\ Rabs (edge_v found) <= bpow radix2 388).
  { unfold found. rewrite (determinants_do_not_underflow (-149) ltac:(lia)) by now apply v_multiple.
    pose proof (difference_most _ _ H1 H0) as M1. pose proof (difference_most _ _ H2 H0) as M2.
    pose proof (difference_most _ _ Ho H0) as M3. pose proof (v_most _ Hd) as M4.
    destruct (vsub_same (-149) (real v1) (real v0)) as [X1 _]; try (apply v_multiple; assumption); try lia.
    destruct (vsub_same (-149) (real v2) (real v0)) as [X2 _]; try (apply v_multiple; assumption); try lia.
    destruct (vsub_same (-149) (real o) (real v0)) as [X3 _]; try (apply v_multiple; assumption); try lia.
    rewrite X1 in M1. rewrite X2 in M2. rewrite X3 in M3. unfold determinants_of. cbv zeta. cbn [det edge_u edge_v].
    split; [|split].
    - apply (triple_most _ _ _ 129 128 129); solve [assumption | lia].
    - apply (triple_most _ _ _ 129 128 129); solve [assumption | lia].
    - apply (triple_most _ _ _ 128 129 129); solve [assumption | lia]. }
  assert (Sharp : forall e e' x r, fits e x r -> Rabs r <= bpow radix2 e' -> fits e' x r) by (intros e e' x r (F & V & _); now repeat split).
  destruct M as (Md & Mu & Mv).
  apply (Sharp _ 388%Z) in Fdet; [|exact Md]. apply (Sharp _ 388%Z) in Fu; [|exact Mu]. apply (Sharp _ 388%Z) in Fv; [|exact Mv].
  pose proof (minus_fits 388 _ _ _ _ ltac:(lia) Fdet Fu) as W1. simpl Z.add in W1.
  pose proof (minus_fits 389 _ _ _ _ ltac:(lia) W1 (fits_more _ 389 _ _ Fv ltac:(lia))) as W2. simpl Z.add in W2.
  repeat split; solve [apply Fdet | apply Fu | apply Fv | apply W2 | apply Ft].
Qed.
End Single.

(** * Bounds of the errors *)

Lemma constant_fits n e : (Z.abs n < 2 ^ 53)%Z -> (-1074 <= e <= 900)%Z -> is_finite (constant n e) = true /\ B2R (constant n e) = IZR n * bpow radix2 e.
Proof.
  intros Hn He. unfold constant. generalize (binary_normalize_correct 53 1024 _ _ mode_NE n e false). cbv zeta.
  change (round_mode mode_NE) with ZnearestE. change (SpecFloat.fexp 53 1024) with (FLT_exp (-1074) 53).
  assert (G : generic_format radix2 (FLT_exp (-1074) 53) (F2R (Float radix2 n e))).
  { apply generic_format_FLT. exists (Float radix2 n e); simpl; [reflexivity|exact Hn|lia]. }
  rewrite round_generic by (exact G || typeclasses eauto). rewrite Rlt_bool_true.
  - intros (V & F & _). split; [exact F|exact V].
  - rewrite <- F2R_Zabs. unfold F2R. simpl Fnum. simpl Fexp. apply Rlt_le_trans with (bpow radix2 53 * bpow radix2 e).
    + apply Rmult_lt_compat_r; [apply bpow_gt_0|]. rewrite <- (IZR_Zpower radix2) by lia. apply IZR_lt, Hn.
    + rewrite <- bpow_plus. apply bpow_le. lia.
Qed.

Lemma sign_fits t D C E d c e : (0 <= t <= 300)%Z -> fits t D d -> fits (t + 2) C c -> fits (t + 1) E e ->
  fits (3 * t - 42) (code_sign D C E) (error_sign R64 u d c e).
Proof.
  intros Ht HD HC HE.
  assert (K : fits (-46) (constant 78 (-53)) (78 * u)).
  { destruct (constant_fits 78 (-53)) as [F V]; [reflexivity|lia|]. change (- (53))%Z with (-53)%Z. split; [exact F|split; [exact V|]].
    rewrite Rabs_pos_eq by (pose proof (bpow_gt_0 radix2 (-53)); lra). replace (-46)%Z with (7 + -53)%Z by reflexivity. rewrite bpow_plus.
    change (bpow radix2 7) with 128. pose proof (bpow_gt_0 radix2 (-53)). lra. }
  pose proof (times_fits t (t + 1) _ _ _ _ ltac:(lia) HD HE) as DE.
  pose proof (times_fits (-46) (t + (t + 1)) _ _ _ _ ltac:(lia) K DE) as KDE.
  pose proof (plus_fits (t + 2) _ _ _ _ ltac:(lia) HC (fits_more _ (t + 2) _ _ HE ltac:(lia))) as CE.
  apply fits_more with (-46 + (t + (t + 1)) + (t + 2 + 1))%Z; [|lia].
  exact (times_fits (-46 + (t + (t + 1))) (t + 2 + 1) _ _ _ _ ltac:(lia) KDE CE).
Qed.

(** For bounds of components of at most these sizes, which Scene.v has, no bound of the errors overflows. [EXACT-6] *)
Theorem errors_do_not_overflow D C E d c e : fits 128 D d -> fits 130 C c -> fits 129 E e ->
  fits 342 (code_sign D C E) (error_sign R64 u d c e) /\ fits 340 (code_det D E) (error_det R64 u d e) /\
  fits 342 (code_t C E) (error_t R64 u c e).
Proof.
  intros HD HC HE.
  assert (K' : forall n, (0 <= n <= 255)%Z -> fits (-47) (constant n (-55)) (IZR n * bpow radix2 (-55))).
  { intros n Hn. destruct (constant_fits n (-55)) as [F V]; [lia|lia|]. split; [exact F|split; [exact V|]].
    rewrite Rabs_pos_eq by (apply Rmult_le_pos; [apply IZR_le; lia|apply bpow_ge_0]). replace (-47)%Z with (8 + -55)%Z by reflexivity. rewrite bpow_plus.
    apply Rmult_le_compat_r; [apply bpow_ge_0|]. change (bpow radix2 8) with (IZR 256). apply IZR_le. lia. }
  assert (U4 : bpow radix2 (-55) = u * / 4) by (change (/ 4) with (bpow radix2 (-2)); rewrite <- bpow_plus; reflexivity).
  pose proof (times_fits 129 129 _ _ _ _ ltac:(lia) HE HE) as EE. simpl Z.add in EE.
  split; [|split].
  - exact (sign_fits 128 _ _ _ _ _ _ ltac:(lia) HD HC HE).
  - unfold code_det, error_det. pose proof (times_fits 128 258 _ _ _ _ ltac:(lia) HD EE) as DEE. simpl Z.add in DEE.
    apply fits_more with 339%Z; [|lia].
    replace (31 * u * (5 / 4)) with (IZR (31 * 5) * bpow radix2 (-55)) by (rewrite U4; simpl IZR; lra).
    exact (times_fits (-47) 386 _ _ _ _ ltac:(lia) (K' (31 * 5)%Z ltac:(lia)) DEE).
  - unfold code_t, error_t. pose proof (times_fits 130 258 _ _ _ _ ltac:(lia) HC EE) as CEE. simpl Z.add in CEE.
    apply fits_more with 341%Z; [|lia].
    replace (35 * u * (5 / 4)) with (IZR (35 * 5) * bpow radix2 (-55)) by (rewrite U4; simpl IZR; lra).
    exact (times_fits (-47) 388 _ _ _ _ ltac:(lia) (K' (35 * 5)%Z ltac:(lia)) CEE).
Qed.
