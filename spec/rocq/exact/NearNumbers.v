(** [bounds] and [nearest] of src/geom/nearest.rs on IEEE 754 doubles: where the greatest component is at most 2^200 nothing overflows, so the
    bounds are finite, and are the numbers that NearGuess.v speaks of. *)
Require Import Reals ZArith Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN.
Require Import StacklessExact.Rounding StacklessExact.Filter StacklessExact.Range StacklessExact.NearDistance StacklessExact.NearGuess.
Require StacklessExact.Overflow.
Import Overflow.
Open Scope R_scope.

Local Instance prec_53 : Prec_gt_0 53 := eq_refl.
Local Instance emax_1024 : Prec_lt_emax 53 1024 := eq_refl.

(** * The code *)

Definition fadd (a b : fvec) : fvec := FVec (plus (fx a) (fx b)) (plus (fy a) (fy b)) (plus (fz a) (fz b)).
Definition fscaled (a : fvec) (t : float) : fvec := FVec (times (fx a) t) (times (fy a) t) (times (fz a) t).
Definition divided (x y : float) : float := Overflow.over x y.
Definition zero : float := constant 0 0.
Definition nan : fvec := FVec B754_nan B754_nan B754_nan.

Definition code_nearest (a b c : fvec) : fvec :=
  let ab := fsub b a in
  let ac := fsub c a in
  let d1 := Bopp (fdot ab a) in
  let d2 := Bopp (fdot ac a) in
  if Bleb d1 zero && Bleb d2 zero then a else
  let d3 := Bopp (fdot ab b) in
  let d4 := Bopp (fdot ac b) in
  if Bleb zero d3 && Bleb d4 d3 then b else
  let of_c := minus (times d1 d4) (times d3 d2) in
  if Bleb of_c zero && Bleb zero d1 && Bleb d3 zero then fadd a (fscaled ab (divided d1 (minus d1 d3))) else
  let d5 := Bopp (fdot ab c) in
  let d6 := Bopp (fdot ac c) in
  if Bleb zero d6 && Bleb d5 d6 then c else
  let of_b := minus (times d5 d2) (times d1 d6) in
  if Bleb of_b zero && Bleb zero d2 && Bleb d6 zero then fadd a (fscaled ac (divided d2 (minus d2 d6))) else
  let of_a := minus (times d3 d6) (times d5 d4) in
  if Bleb of_a zero && Bleb d3 d4 && Bleb d6 d5 then
    fadd b (fscaled (fsub c b) (divided (minus d4 d3) (plus (minus d4 d3) (minus d5 d6)))) else
  if negb (Bltb zero of_a && Bltb zero of_b && Bltb zero of_c) then nan else
  let all := plus (plus of_a of_b) of_c in
  fadd (fadd a (fscaled ab (divided of_b all))) (fscaled ac (divided of_c all)).

(** * Operations *)

Lemma zero_fits : fits 0 zero 0.
Proof. split; [reflexivity|split; [reflexivity|]]. rewrite Rabs_R0. apply bpow_ge_0. Qed.
Lemma opp_fits e x r : fits e x r -> fits e (Bopp x) (- r).
Proof. intros (H & <- & B). split; [now rewrite is_finite_Bopp|split; [apply B2R_Bopp|now rewrite Rabs_Ropp]]. Qed.
Lemma leb_fits e e' x y a b : fits e x a -> fits e' y b -> Bleb x y = Rle_bool a b.
Proof. intros (Fx & <- & _) (Fy & <- & _). now apply Bleb_correct. Qed.
Lemma ltb_fits e e' x y a b : fits e x a -> fits e' y b -> Bltb x y = Rlt_bool a b.
Proof. intros (Fx & <- & _) (Fy & <- & _). now apply Bltb_correct. Qed.
Lemma over_fits e ex ey x y a b : (-1074 <= e <= 1023)%Z -> b <> 0 -> Rabs (a / b) <= bpow radix2 e ->
  fits ex x a -> fits ey y b -> fits e (divided x y) (R64 (a / b)).
Proof.
  intros He N S (Fx & <- & _) (Fy & <- & _). unfold divided, Overflow.over.
  generalize (Bdiv_correct 53 1024 _ _ mode_NE x y N). change (round_mode mode_NE) with ZnearestE.
  change (SpecFloat.fexp 53 1024) with (FLT_exp (-1074) 53). rewrite Rlt_bool_true by (apply (below_top e); [lia|exact S]). rewrite Fx.
  intros (V & G & _). split; [exact G|split; [exact V|]]. apply R64_b; [lia|exact S].
Qed.
Lemma add_fits e a b a' b' : (-1074 <= e < 1023)%Z -> vfits e a a' -> vfits e b b' -> vfits (e + 1) (fadd a b) (vadd a' b').
Proof. intros He (A1 & A2 & A3) (B1 & B2 & B3). split; [|split]; apply plus_fits; assumption || lia. Qed.
Lemma scaled_fits e a a' t t' : (-1074 <= e <= 1023)%Z -> vfits e a a' -> fits 0 t t' -> vfits e (fscaled a t) (scaled a' t').
Proof.
  intros He (A1 & A2 & A3) T. rewrite <- (Z.add_0_r e). split; [|split]; apply times_fits; try assumption; lia.
Qed.
Lemma v_fits_more e e' a a' : vfits e a a' -> (e <= e')%Z -> vfits e' a a'.
Proof. intros (A1 & A2 & A3) H. split; [|split]; eapply fits_more; eassumption. Qed.

(** A weight on an edge. *)
Lemma weight_fits ex ey x y a b t : fits ex x a -> fits ey y (R64 b) -> F a -> 0 <= a <= b -> NearGuess.over a (R64 b) = Some t -> fits 0 (divided x y) t.
Proof.
  intros X Y Fa B. unfold NearGuess.over. destruct (Req_bool_spec (R64 b) 0) as [|N]; [discriminate|]. intros [= <-].
  pose proof (R64_le a b ltac:(lra)) as L. rewrite (R64_F a Fa) in L. apply (over_fits 0 ex ey); try assumption; [lia|].
  change (bpow radix2 0) with 1. rewrite Rabs_pos_eq by (apply Rle_mult_inv_pos; lra).
  apply Rmult_le_reg_r with (R64 b); [lra|]. replace (a / R64 b * R64 b) with a by (field; lra). lra.
Qed.
Lemma edge_fits a b a' b' e e' t t' q : vfits e a a' -> vfits e' b b' -> (e <= e')%Z -> (-1074 <= e' < 1023)%Z ->
  (forall s, t' = Some s -> fits 0 t s) -> on_edge a' b' t' = Some q -> vfits (e' + 1) (fadd a (fscaled b t)) q.
Proof.
  intros A B L H T. destruct t' as [s|]; [|discriminate]. intros [= <-]. apply add_fits; [lia|exact (v_fits_more _ _ _ _ A L)|].
  apply scaled_fits; [lia|exact B|now apply T].
Qed.

(** * The guess *)

(** A guess is finite, and the number that NearGuess.v speaks of. [NEAR-1] *)
Theorem code_nearest_fits a b c a' b' c' q : vfits 200 a a' -> vfits 200 b b' -> vfits 200 c c' -> guess a' b' c' = Some q ->
  vfits 203 (code_nearest a b c) q.
Proof.
  intros A B C. pose proof (sub_fits 200 _ _ _ _ ltac:(lia) B A) as AB. pose proof (sub_fits 200 _ _ _ _ ltac:(lia) C A) as AC.
  pose proof (sub_fits 200 _ _ _ _ ltac:(lia) C B) as BC. cbn [Z.add] in AB, AC, BC.
  assert (D : forall x y x' y', vfits 201 x x' -> vfits 200 y y' -> fits 403 (Bopp (fdot x y)) (- dot R64 x' y')).
  { intros x y x' y' X Y. apply opp_fits. exact (dot_fits 201 200 _ _ _ _ ltac:(lia) X Y). }
  pose proof (D _ _ _ _ AB A) as D1. pose proof (D _ _ _ _ AC A) as D2. pose proof (D _ _ _ _ AB B) as D3. pose proof (D _ _ _ _ AC B) as D4.
  pose proof (D _ _ _ _ AB C) as D5. pose proof (D _ _ _ _ AC C) as D6. clear D.
  pose proof (F_dot (vsub R64 b' a') a') as F1. pose proof (F_dot (vsub R64 c' a') a') as F2.
  unfold guess, code_nearest. set (ab := fsub b a) in *. set (ac := fsub c a) in *. set (bc := fsub c b) in *.
  set (ab' := vsub R64 b' a') in *. set (ac' := vsub R64 c' a') in *. set (bc' := vsub R64 c' b') in *.
  set (d1 := Bopp (fdot ab a)) in *. set (d2 := Bopp (fdot ac a)) in *. set (d3 := Bopp (fdot ab b)) in *. set (d4 := Bopp (fdot ac b)) in *.
  set (d5 := Bopp (fdot ab c)) in *. set (d6 := Bopp (fdot ac c)) in *.
  set (r1 := - dot R64 ab' a') in *. set (r2 := - dot R64 ac' a') in *. set (r3 := - dot R64 ab' b') in *. set (r4 := - dot R64 ac' b') in *.
  set (r5 := - dot R64 ab' c') in *. set (r6 := - dot R64 ac' c') in *. clearbody d1 d2 d3 d4 d5 d6 r1 r2 r3 r4 r5 r6 ab ac bc ab' ac' bc'. cbv zeta.
  pose proof zero_fits as Z0.
  assert (Of : forall w x y z w' x' y' z', fits 403 w w' -> fits 403 x x' -> fits 403 y y' -> fits 403 z z' ->
    fits 807 (minus (times w x) (times y z)) (R64 (R64 (w' * x') - R64 (y' * z')))).
  { intros. apply (minus_fits 806); [lia|apply (times_fits 403 403); assumption || lia|apply (times_fits 403 403); assumption || lia]. }
  pose proof (Of _ _ _ _ _ _ _ _ D1 D4 D3 D2) as OC. pose proof (Of _ _ _ _ _ _ _ _ D5 D2 D1 D6) as OB. pose proof (Of _ _ _ _ _ _ _ _ D3 D6 D5 D4) as OA.
  clear Of. pose proof (F_R64 (R64 (r1 * r4) - R64 (r3 * r2))) as FC. pose proof (F_R64 (R64 (r5 * r2) - R64 (r1 * r6))) as FB. pose proof (F_R64 (R64 (r3 * r6) - R64 (r5 * r4))) as FA.
  set (oc := minus (times d1 d4) (times d3 d2)) in *. set (ob := minus (times d5 d2) (times d1 d6)) in *. set (oa := minus (times d3 d6) (times d5 d4)) in *.
  set (sc := R64 (R64 (r1 * r4) - R64 (r3 * r2))) in *. set (sb := R64 (R64 (r5 * r2) - R64 (r1 * r6))) in *. set (sa := R64 (R64 (r3 * r6) - R64 (r5 * r4))) in *.
  clearbody oc ob oa sc sb sa.
  pose proof (minus_fits 403 _ _ _ _ ltac:(lia) D1 D3) as M13. pose proof (minus_fits 403 _ _ _ _ ltac:(lia) D2 D6) as M26.
  pose proof (minus_fits 403 _ _ _ _ ltac:(lia) D4 D3) as M43. pose proof (minus_fits 403 _ _ _ _ ltac:(lia) D5 D6) as M56.
  pose proof (plus_fits 404 _ _ _ _ ltac:(lia) M43 M56) as M. cbn [Z.add Z.succ] in *.
  rewrite (leb_fits _ _ _ _ _ _ D1 Z0), (leb_fits _ _ _ _ _ _ D2 Z0), (leb_fits _ _ _ _ _ _ Z0 D3), (leb_fits _ _ _ _ _ _ D4 D3),
    (leb_fits _ _ _ _ _ _ OC Z0), (leb_fits _ _ _ _ _ _ Z0 D1), (leb_fits _ _ _ _ _ _ D3 Z0), (leb_fits _ _ _ _ _ _ Z0 D6), (leb_fits _ _ _ _ _ _ D5 D6),
    (leb_fits _ _ _ _ _ _ OB Z0), (leb_fits _ _ _ _ _ _ Z0 D2), (leb_fits _ _ _ _ _ _ D6 Z0), (leb_fits _ _ _ _ _ _ OA Z0), (leb_fits _ _ _ _ _ _ D3 D4),
    (leb_fits _ _ _ _ _ _ D6 D5), (ltb_fits _ _ _ _ _ _ Z0 OA), (ltb_fits _ _ _ _ _ _ Z0 OB), (ltb_fits _ _ _ _ _ _ Z0 OC).
  destruct (Rle_bool r1 0 && Rle_bool r2 0); [intros [= <-]; apply (v_fits_more 200); [exact A|lia]|].
  destruct (Rle_bool 0 r3 && Rle_bool r4 r3); [intros [= <-]; apply (v_fits_more 200); [exact B|lia]|].
  destruct (Rle_bool sc 0 && Rle_bool 0 r1 && Rle_bool r3 0) eqn:Edge.
  { apply andb_prop in Edge as [Edge E3]. apply andb_prop in Edge as [_ E1]. apply le_of_bool in E1, E3. intros Q. apply (v_fits_more 202); [|lia].
    apply (edge_fits _ _ _ _ 200 201 _ _ _ A AB) with (4 := Q); [lia|lia|]. intros s. apply (weight_fits _ _ _ _ _ _ _ D1 M13 F1). lra. }
  destruct (Rle_bool 0 r6 && Rle_bool r5 r6); [intros [= <-]; apply (v_fits_more 200); [exact C|lia]|].
  clear Edge. destruct (Rle_bool sb 0 && Rle_bool 0 r2 && Rle_bool r6 0) eqn:Edge.
  { apply andb_prop in Edge as [Edge E3]. apply andb_prop in Edge as [_ E1]. apply le_of_bool in E1, E3. intros Q. apply (v_fits_more 202); [|lia].
    apply (edge_fits _ _ _ _ 200 201 _ _ _ A AC) with (4 := Q); [lia|lia|]. intros s. apply (weight_fits _ _ _ _ _ _ _ D2 M26 F2). lra. }
  clear Edge. destruct (Rle_bool sa 0 && Rle_bool r3 r4 && Rle_bool r6 r5) eqn:Edge.
  { apply andb_prop in Edge as [Edge E3]. apply andb_prop in Edge as [_ E1]. apply le_of_bool in E1, E3. intros Q. apply (v_fits_more 202); [|lia].
    apply (edge_fits _ _ _ _ 200 201 _ _ _ B BC) with (4 := Q); [lia|lia|]. intros s. apply (weight_fits _ _ _ _ _ _ _ M43 M (F_R64 _)).
    pose proof (R64_pos (r4 - r3) ltac:(lra)). pose proof (R64_pos (r5 - r6) ltac:(lra)). lra. }
  destruct (Rlt_bool_spec 0 sa) as [PA|]; [|discriminate]. destruct (Rlt_bool_spec 0 sb) as [PB|]; [|discriminate].
  destruct (Rlt_bool_spec 0 sc) as [PC|]; [|discriminate]. cbn [andb negb]. intros [= <-].
  pose proof (plus_fits 807 _ _ _ _ ltac:(lia) OA OB) as S1. pose proof (plus_fits 808 _ _ _ _ ltac:(lia) S1 (fits_more _ 808 _ _ OC ltac:(lia))) as S2.
  assert (L : forall x y, fits 807 x y -> F y -> 0 < y -> y <= R64 (sa + sb) + sc ->
    fits 0 (divided x (plus (plus oa ob) oc)) (R64 (y / R64 (R64 (sa + sb) + sc)))).
  { intros x y Y Fy Py Ly. pose proof (R64_le _ _ Ly) as G. rewrite (R64_F y Fy) in G. apply (over_fits 0 807 809); [lia|lra| |exact Y|exact S2].
    change (bpow radix2 0) with 1. rewrite Rabs_pos_eq by (apply Rle_mult_inv_pos; lra). apply Rmult_le_reg_r with (R64 (R64 (sa + sb) + sc)); [lra|].
    replace (y / R64 (R64 (sa + sb) + sc) * R64 (R64 (sa + sb) + sc)) with y by (field; lra). lra. }
  assert (PS : sb <= R64 (sa + sb)) by (rewrite <- (R64_F sb FB) at 1; apply R64_le; lra).
  apply (add_fits 202); [lia| |].
  - apply (add_fits 201); [lia|apply (v_fits_more 200); [exact A|lia]|]. apply scaled_fits; [lia|exact AB|]. apply (L ob sb OB FB PB). lra.
  - apply (v_fits_more 201); [|lia]. apply scaled_fits; [lia|exact AC|]. apply (L oc sc OC FC PC). lra.
Qed.

(** * The bounds *)

Definition flarger (x y : float) : float := if Bltb y x then x else y.
Definition fsmaller (x y : float) : float := if Bltb x y then x else y.
Lemma larger_fits e x y a b : fits e x a -> fits e y b -> fits e (flarger x y) (Rmax a b).
Proof.
  intros X Y. unfold flarger. rewrite (ltb_fits _ _ _ _ _ _ Y X). unfold Rmax. destruct (Rlt_bool_spec b a), (Rle_dec a b); try assumption; lra.
Qed.
Lemma smaller_fits e x y a b : fits e x a -> fits e y b -> fits e (fsmaller x y) (Rmin a b).
Proof.
  intros X Y. unfold fsmaller. rewrite (ltb_fits _ _ _ _ _ _ X Y). unfold Rmin. destruct (Rlt_bool_spec a b), (Rle_dec a b); try assumption; try lra.
  now replace a with b by lra.
Qed.

(** A root. *)
Lemma root_fits e x a : (-1074 <= e <= 511)%Z -> 0 <= a -> fits (e + e) x a -> fits e (Bsqrt mode_NE x) (R64 (sqrt a)).
Proof.
  intros He A (Fx & <- & B). destruct (Bsqrt_correct 53 1024 _ _ mode_NE x) as (V & G & _).
  change (round_mode mode_NE) with ZnearestE in V. change (SpecFloat.fexp 53 1024) with (FLT_exp (-1074) 53) in V.
  assert (S : sqrt (B2R x) <= bpow radix2 e).
  { apply root_le; [apply bpow_ge_0|]. rewrite <- bpow_plus. rewrite Rabs_pos_eq in B by exact A. exact B. }
  split; [|split; [exact V|]].
  - rewrite G. destruct x as [| | |s m x H]; try discriminate; try reflexivity. destruct s; [|reflexivity]. exfalso.
    assert (B2R (B754_finite true m x H) < 0) by (apply F2R_lt_0; reflexivity). lra.
  - apply R64_b; [lia|]. rewrite Rabs_pos_eq by apply sqrt_pos. exact S.
Qed.

Definition code_length (q : fvec) : float := Bsqrt mode_NE (fdot q q).
Definition code_margin (greatest : float) : float := times (constant 1 (-47)) greatest.
Definition code_near (q a b c : fvec) (greatest : float) : float :=
  let l := code_length q in
  let least := fsmaller (fsmaller (fdot q a) (fdot q b)) (fdot q c) in
  let near := flarger (minus (times (divided least l) (constant 1125899906842623 (-50))) (code_margin greatest)) zero in
  if Bltb (constant 1 (-300)) l then near else zero.
Definition code_far (q : fvec) (greatest : float) : float :=
  plus (times (code_length q) (constant 1125899906842625 (-50))) (code_margin greatest).

Lemma dot_pos x : 0 <= dot R64 x x.
Proof.
  unfold dot. repeat (apply R64_pos; try apply Rplus_le_le_0_compat); apply Rle_0_sqr.
Qed.

Lemma constant_fits m e k : (Z.abs m < 2 ^ 53)%Z -> (-1074 <= e)%Z -> (k <= 1023)%Z -> Rabs (IZR m * bpow radix2 e) <= bpow radix2 k ->
  fits k (constant m e) (IZR m * bpow radix2 e).
Proof.
  intros M E K B. generalize (binary_normalize_correct 53 1024 prec_53 emax_1024 mode_NE m e false). cbv zeta.
  change (round_mode mode_NE) with ZnearestE. change (SpecFloat.fexp 53 1024) with (FLT_exp (-1074) 53).
  match goal with |- context [Rabs ?r] => assert (R : r = IZR m * bpow radix2 e); [|rewrite R] end.
  { apply (R64_F (IZR m * bpow radix2 e)), generic_format_FLT. exists (Float radix2 m e); [reflexivity|exact M|exact E]. }
  rewrite Rlt_bool_true by (eapply Rle_lt_trans; [exact B|apply bpow_lt; lia]). intros (V & H & _). split; [exact H|split; [exact V|exact B]].
Qed.

Section Usual.
Variables a b c q : fvec.
Variables a' b' c' q' : vec.
Variables greatest : float.
Variable greatest' : R.
Hypothesis A : vfits 200 a a'.
Hypothesis B : vfits 200 b b'.
Hypothesis C : vfits 200 c c'.
Hypothesis Q : vfits 203 q q'.
Hypothesis G : fits 200 greatest greatest'.

Lemma length_fits : fits 204 (code_length q) (length q').
Proof. apply root_fits; [lia|apply dot_pos|]. exact (dot_fits 203 203 _ _ _ _ ltac:(lia) Q Q). Qed.
Lemma margin_fits : fits 153 (code_margin greatest) (margin greatest').
Proof.
  unfold margin. replace (64 * u) with (IZR 1 * bpow radix2 (-47)) by (change (bpow radix2 (-47)) with (/ 140737488355328); rewrite u_is; lra).
  apply (times_fits (-47) 200); [lia| |exact G]. apply constant_fits; [lia|lia|lia|]. rewrite Rmult_1_l, Rabs_pos_eq by apply bpow_ge_0. lra.
Qed.

(** So is the upper bound. [NEAR-1] *)
Theorem far_fits : fits 206 (code_far q greatest) (far q' greatest').
Proof.
  unfold far. replace (1 + 8 * u) with (IZR 1125899906842625 * bpow radix2 (-50)) by (change (bpow radix2 (-50)) with (/ 1125899906842624); rewrite u_is; lra).
  apply (plus_fits 205); [lia| |apply (fits_more _ _ _ _ margin_fits); lia]. apply (times_fits 204 1); [lia|exact length_fits|].
  apply constant_fits; [lia|lia|lia|]. change (bpow radix2 1) with 2. change (bpow radix2 (-50)) with (/ 1125899906842624). rewrite Rabs_pos_eq; lra.
Qed.

(** And the lower one. [NEAR-1] *)
Theorem near_fits : fits 710 (code_near q a b c greatest) (near q' a' b' c' greatest').
Proof.
  unfold near, code_near, short. assert (SF : fits (-300) (constant 1 (-300)) (bpow radix2 (-300))).
  { rewrite <- (Rmult_1_l (bpow radix2 (-300))) at 1. apply constant_fits; [lia|lia|lia|]. rewrite Rmult_1_l, Rabs_pos_eq by apply bpow_ge_0. lra. }
  pose proof length_fits as L. rewrite (ltb_fits _ _ _ _ _ _ SF L). pose proof zero_fits as Z0. apply (fits_more _ 710) in Z0; [|lia].
  destruct (Rlt_bool_spec (bpow radix2 (-300)) (length q')) as [Long|_]; [|exact Z0].
  apply larger_fits; [|exact Z0]. apply (minus_fits 709); [lia| |apply (fits_more _ _ _ _ margin_fits); lia].
  replace (1 - 8 * u) with (IZR 1125899906842623 * bpow radix2 (-50)) by (change (bpow radix2 (-50)) with (/ 1125899906842624); rewrite u_is; lra).
  pose proof (dot_fits 203 200 _ _ _ _ ltac:(lia) Q A) as DA. pose proof (dot_fits 203 200 _ _ _ _ ltac:(lia) Q B) as DB. pose proof (dot_fits 203 200 _ _ _ _ ltac:(lia) Q C) as DC.
  pose proof (smaller_fits _ _ _ _ _ (smaller_fits _ _ _ _ _ DA DB) DC) as M. fold (least q' a' b' c') in M. cbn [Z.add] in M.
  pose proof (bpow_gt_0 radix2 (-300)) as P. apply (times_fits 708 1); [lia| |].
  - apply (over_fits 708 405 204); [lia|lra| |exact M|exact L]. unfold Rdiv. rewrite Rabs_mult. apply Rle_trans with (bpow radix2 405 * bpow radix2 300).
    + apply Rmult_le_compat; try apply Rabs_pos; [apply M|]. rewrite Rabs_pos_eq by (left; apply Rinv_0_lt_compat; lra).
      change 300%Z with (- (-300))%Z. rewrite bpow_opp. apply Rinv_le; lra.
    + rewrite <- bpow_plus. apply bpow_le. lia.
  - apply constant_fits; [lia|lia|lia|]. change (bpow radix2 1) with 2. change (bpow radix2 (-50)) with (/ 1125899906842624). rewrite Rabs_pos_eq; lra.
Qed.
End Usual.
