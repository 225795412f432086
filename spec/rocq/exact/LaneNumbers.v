(** The filter of four triangles on IEEE 754 numbers of single precision: for a usual ray nothing on the left side of its comparisons
    overflows, and what overflows on the right side rejects nothing. So LANES-3 and LANES-4 hold of the floats. *)
Require Import Reals ZArith Lia Lra Psatz Bool.
From Flocq Require Import Core BinarySingleNaN.
Require Import StacklessExact.Rounding StacklessExact.Triple StacklessExact.Filter StacklessExact.Floor StacklessExact.Lanes StacklessExact.Slabs.
Open Scope R_scope.

Local Instance prec_24 : Prec_gt_0 24 := eq_refl.
Notation float := (binary_float 24 128).
Notation plus := (@Bplus 24 128 eq_refl eq_refl mode_NE).
Notation minus := (@Bminus 24 128 eq_refl eq_refl mode_NE).
Notation times := (@Bmult 24 128 eq_refl eq_refl mode_NE).
Notation value := (Slabs.value 24 128).
Notation lesser := (Slabs.lesser 24 128).
Notation greater := (Slabs.greater 24 128).

(** * The code *)

Record fvec : Type := FVec { fx : float; fy : float; fz : float }.
Definition fsub (a b : fvec) : fvec := FVec (minus (fx a) (fx b)) (minus (fy a) (fy b)) (minus (fz a) (fz b)).
Definition fcross (a b : fvec) : fvec :=
  FVec (minus (times (fy a) (fz b)) (times (fz a) (fy b))) (minus (times (fz a) (fx b)) (times (fx a) (fz b)))
    (minus (times (fx a) (fy b)) (times (fy a) (fx b))).
Definition fdot (a b : fvec) : float := plus (plus (times (fx a) (fx b)) (times (fy a) (fy b))) (times (fz a) (fz b)).

(** [survivors]: det, U, V, W and T. *)
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

(** The bounds of the ray, [edge], [det], [t] and [twice_c], and that of the block. *)
Definition constant (n e : Z) : float := binary_normalize 24 128 eq_refl eq_refl mode_NE n e false.
Definition f_delta (D C E : float) : float := times (times (times (constant 39 (-24)) D) E) (plus (times (constant 2 0) C) E).
Definition f_missed (D C E : float) (x : code) : bool :=
  let delta := f_delta D C E in
  Bltb (lesser (lesser (f_u x) (f_v x)) (f_w x)) (Bopp delta) && Bltb delta (greater (greater (f_u x) (f_v x)) (f_w x)).
Definition f_beyond (D C E best : float) (x : code) : bool :=
  let square := times E E in
  let ahead := if Bsign (f_det x) then Bopp (f_t x) else f_t x in
  Bltb (times (plus (Babs (f_det x)) (times (times (constant 40 (-24)) D) square)) best) (minus ahead (times (times (constant 44 (-24)) C) square)).

(** * Operations that do not overflow *)

(** The float is finite, it is that number, and it is at most a power of two. *)
Definition fits (e : Z) (x : float) (r : R) : Prop := is_finite x = true /\ B2R x = r /\ Rabs r <= bpow radix2 e.

Lemma fits_more e e' x r : fits e x r -> (e <= e')%Z -> fits e' x r.
Proof. intros (F & V & B) H. repeat split; try assumption. eapply Rle_trans; [exact B|now apply bpow_le]. Qed.
Lemma R32_b e x : (-149 <= e)%Z -> Rabs x <= bpow radix2 e -> Rabs (R32 x) <= bpow radix2 e.
Proof. intros He H. apply abs_round_le_generic; [typeclasses eauto..| |exact H]. apply generic_format_bpow. unfold FLT_exp. lia. Qed.
Lemma below_top e x : (-149 <= e <= 127)%Z -> Rabs x <= bpow radix2 e -> Rabs (R32 x) < bpow radix2 128.
Proof. intros He H. apply Rle_lt_trans with (bpow radix2 e); [apply R32_b; [lia|exact H]|apply bpow_lt; lia]. Qed.
Lemma twice_pow e : bpow radix2 e + bpow radix2 e = bpow radix2 (e + 1).
Proof. rewrite bpow_plus. change (bpow radix2 1) with 2. ring. Qed.

Lemma minus_fits e x y a b : (-149 <= e < 127)%Z -> fits e x a -> fits e y b -> fits (e + 1) (minus x y) (R32 (a - b)).
Proof.
  intros He (Fx & <- & Bx) (Fy & <- & By). pose proof (sub_b _ _ _ _ Bx By) as S. rewrite twice_pow in S.
  generalize (Bminus_correct 24 128 eq_refl eq_refl mode_NE x y Fx Fy). rewrite Rlt_bool_true by (apply (below_top (e + 1)); [lia|exact S]).
  intros (V & F & _). split; [exact F|split; [exact V|]]. apply R32_b; [lia|exact S].
Qed.
Lemma plus_fits e x y a b : (-149 <= e < 127)%Z -> fits e x a -> fits e y b -> fits (e + 1) (plus x y) (R32 (a + b)).
Proof.
  intros He (Fx & <- & Bx) (Fy & <- & By). pose proof (add_b _ _ _ _ Bx By) as S. rewrite twice_pow in S.
  generalize (Bplus_correct 24 128 eq_refl eq_refl mode_NE x y Fx Fy). rewrite Rlt_bool_true by (apply (below_top (e + 1)); [lia|exact S]).
  intros (V & F & _). split; [exact F|split; [exact V|]]. apply R32_b; [lia|exact S].
Qed.
Lemma times_fits e e' x y a b : (-149 <= e + e' <= 127)%Z -> fits e x a -> fits e' y b -> fits (e + e') (times x y) (R32 (a * b)).
Proof.
  intros He (Fx & <- & Bx) (Fy & <- & By). pose proof (mul_b _ _ _ _ Bx By) as S. rewrite <- bpow_plus in S.
  generalize (Bmult_correct 24 128 eq_refl eq_refl mode_NE x y). rewrite Rlt_bool_true by (apply (below_top (e + e')); [lia|exact S]).
  rewrite Fx, Fy. intros (V & F & _). split; [exact F|split; [exact V|]]. apply R32_b; [lia|exact S].
Qed.

Definition vfits (e : Z) (v : fvec) (r : vec) : Prop := fits e (fx v) (vx r) /\ fits e (fy v) (vy r) /\ fits e (fz v) (vz r).

Lemma sub_fits e a b a' b' : (-149 <= e < 127)%Z -> vfits e a a' -> vfits e b b' -> vfits (e + 1) (fsub a b) (vsub R32 a' b').
Proof. intros He (A1 & A2 & A3) (B1 & B2 & B3). split; [|split]; apply minus_fits; assumption || lia. Qed.
Lemma cross_fits e e' a b a' b' : (-149 <= e + e' < 127)%Z -> vfits e a a' -> vfits e' b b' -> vfits (e + e' + 1) (fcross a b) (cross R32 a' b').
Proof.
  intros He (A1 & A2 & A3) (B1 & B2 & B3). unfold fcross, cross. rewrite (Rmult_comm (vy b') (vz a')), (Rmult_comm (vz b') (vx a')), (Rmult_comm (vx b') (vy a')).
  split; [|split]; cbn [fx fy fz vx vy vz]; apply minus_fits; try lia; apply times_fits; assumption || lia.
Qed.
Lemma dot_fits e e' a b a' b' : (-149 <= e + e' < 126)%Z -> vfits e a a' -> vfits e' b b' -> fits (e + e' + 2) (fdot a b) (dot R32 a' b').
Proof.
  intros He (A1 & A2 & A3) (B1 & B2 & B3). unfold fdot, dot. replace (e + e' + 2)%Z with (e + e' + 1 + 1)%Z by lia.
  apply plus_fits; [lia| |].
  - apply plus_fits; [lia|apply times_fits; assumption || lia..].
  - apply fits_more with (e + e')%Z; [|lia]. apply times_fits; assumption || lia.
Qed.

(** * A usual ray *)

Section Usual.
Variables v0 v1 v2 o d : fvec.
Definition real (v : fvec) : vec := Vec (B2R (fx v)) (B2R (fy v)) (B2R (fz v)).
(** Coordinates of at most 2^40, a direction of at most 2^20. *)
Hypothesis H0 : vfits 40 v0 (real v0).
Hypothesis H1 : vfits 40 v1 (real v1).
Hypothesis H2 : vfits 40 v2 (real v2).
Hypothesis Ho : vfits 40 o (real o).
Hypothesis Hd : vfits 20 d (real d).
Let found := determinants_of R32 (real v0) (real v1) (real v2) (real o) (real d).
Let c := code_of v0 v1 v2 o d.

(** No operation overflows: what is found is what Lanes.v has. [LANES-3, LANES-4] *)
Theorem lanes_do_not_overflow : fits 105 (f_det c) (det found) /\ fits 105 (f_u c) (edge_u found) /\ fits 105 (f_v c) (edge_v found) /\
  fits 107 (f_w c) (edge_w found) /\ fits 126 (f_t c) (top_t found).
Proof.
  pose proof (sub_fits 40 _ _ _ _ ltac:(lia) H1 H0) as E1. pose proof (sub_fits 40 _ _ _ _ ltac:(lia) H2 H0) as E2.
  pose proof (sub_fits 40 _ _ _ _ ltac:(lia) Ho H0) as S.
  pose proof (cross_fits 20 41 _ _ _ _ ltac:(lia) Hd E2) as P. pose proof (cross_fits 41 41 _ _ _ _ ltac:(lia) S E1) as Q.
  pose proof (dot_fits 41 62 _ _ _ _ ltac:(lia) E1 P) as Fdet. pose proof (dot_fits 41 62 _ _ _ _ ltac:(lia) S P) as Fu.
  pose proof (dot_fits 20 83 _ _ _ _ ltac:(lia) Hd Q) as Fv. pose proof (dot_fits 41 83 _ _ _ _ ltac:(lia) E2 Q) as Ft.
  pose proof (minus_fits 105 _ _ _ _ ltac:(lia) Fdet Fu) as W1.
  pose proof (minus_fits 106 _ _ _ _ ltac:(lia) W1 (fits_more _ 106 _ _ Fv ltac:(lia))) as W2.
  split; [exact Fdet|split; [exact Fu|split; [exact Fv|split; [exact W2|exact Ft]]]].
Qed.

Lemma constant_fits n e k : (Z.abs n < 2 ^ 24)%Z -> (-149 <= e)%Z -> Rabs (IZR n * bpow radix2 e) <= bpow radix2 k -> (k <= 127)%Z ->
  fits k (constant n e) (IZR n * bpow radix2 e).
Proof.
  intros Hn He Hk Hk'. pose proof (binary_normalize_correct 24 128 eq_refl eq_refl mode_NE n e false) as K. cbv zeta in K.
  change (F2R (Float radix2 n e)) with (IZR n * bpow radix2 e) in K. rewrite (round_generic radix2 _ _ (IZR n * bpow radix2 e)) in K.
  - rewrite Rlt_bool_true in K by (eapply Rle_lt_trans; [exact Hk|apply bpow_lt; lia]). destruct K as (K1 & K2 & _). repeat split; assumption.
  - change (IZR n * bpow radix2 e) with (F2R (Float radix2 n e)). apply generic_format_FLT. exists (Float radix2 n e); [reflexivity|exact Hn|exact He].
Qed.

(** The sizes, which are at most 2^41 and 2^20. *)
Variables D C E : float.
Hypothesis FD : fits 20 D (B2R D).
Hypothesis FC : fits 41 C (B2R C).
Hypothesis FE : fits 41 E (B2R E).

Lemma constants : fits (-18) (constant 39 (-24)) (39 * u) /\ fits (-18) (constant 40 (-24)) (40 * u) /\ fits (-18) (constant 44 (-24)) (44 * u) /\
  fits 1 (constant 2 0) 2.
Proof.
  assert (K : forall n, (0 <= n <= 64)%Z -> fits (-18) (constant n (-24)) (IZR n * u)).
  { intros n Hn. apply (constant_fits n (-24) (-18)); [change (2 ^ 24)%Z with 16777216%Z; lia|lia| |lia]. change (bpow radix2 (-24)) with u.
    replace (bpow radix2 (-18)) with (64 * u) by (simpl; lra). assert (0 <= IZR n <= 64) by (split; apply IZR_le; lia). rewrite Rabs_pos_eq; lra. }
  split; [apply (K 39%Z); lia|]. split; [apply (K 40%Z); lia|]. split; [apply (K 44%Z); lia|].
  replace 2 with (IZR 2 * bpow radix2 0) by (simpl; ring). apply constant_fits; [reflexivity|lia| |lia]. simpl. rewrite Rabs_pos_eq; lra.
Qed.

Lemma delta_fits : fits 86 (f_delta D C E) (delta_of (B2R D) (B2R C) (B2R E)).
Proof.
  destruct constants as (K & _ & _ & K2). pose proof (times_fits (-18) 20 _ _ _ _ ltac:(lia) K FD) as A. pose proof (times_fits 2 41 _ _ _ _ ltac:(lia) A FE) as A2.
  pose proof (times_fits 1 41 _ _ _ _ ltac:(lia) K2 FC) as B. pose proof (plus_fits 42 _ _ _ _ ltac:(lia) B (fits_more _ 42 _ _ FE ltac:(lia))) as B2.
  exact (times_fits 43 43 _ _ _ _ ltac:(lia) A2 B2).
Qed.
Lemma det_off_fits : fits 84 (times (times (constant 40 (-24)) D) (times E E)) (det_off_of (B2R D) (B2R E)).
Proof.
  destruct constants as (_ & K & _ & _). pose proof (times_fits (-18) 20 _ _ _ _ ltac:(lia) K FD) as A. pose proof (times_fits 41 41 _ _ _ _ ltac:(lia) FE FE) as B.
  exact (times_fits 2 82 _ _ _ _ ltac:(lia) A B).
Qed.
Lemma t_off_fits : fits 105 (times (times (constant 44 (-24)) C) (times E E)) (t_off_of (B2R C) (B2R E)).
Proof.
  destruct constants as (_ & _ & K & _). pose proof (times_fits (-18) 41 _ _ _ _ ltac:(lia) K FC) as A. pose proof (times_fits 41 41 _ _ _ _ ltac:(lia) FE FE) as B.
  exact (times_fits 23 82 _ _ _ _ ltac:(lia) A B).
Qed.

Lemma lesser_fits e x y a b : fits e x a -> fits e y b -> fits e (lesser x y) (Rmin a b).
Proof.
  intros (Fx & <- & Bx) (Fy & <- & By). unfold Slabs.lesser. rewrite Bltb_correct by assumption.
  destruct (Rlt_bool_spec (B2R x) (B2R y)); [rewrite Rmin_left by lra|rewrite Rmin_right by lra]; repeat split; assumption.
Qed.
Lemma greater_fits e x y a b : fits e x a -> fits e y b -> fits e (greater x y) (Rmax a b).
Proof.
  intros (Fx & <- & Bx) (Fy & <- & By). unfold Slabs.greater. rewrite Bltb_correct by assumption.
  destruct (Rlt_bool_spec (B2R y) (B2R x)); [rewrite Rmax_left by lra|rewrite Rmax_right by lra]; repeat split; assumption.
Qed.
Lemma opp_fits e x a : fits e x a -> fits e (Bopp x) (- a).
Proof. intros (Fx & <- & Bx). split; [now rewrite is_finite_Bopp|]. split; [apply B2R_Bopp|now rewrite Rabs_Ropp]. Qed.

(** The comparisons of floats are those of the numbers of Lanes.v. Where the product with the end overflows, nothing is rejected. *)
Lemma missed_agrees : f_missed D C E c = true -> is_missed (B2R D) (B2R C) (B2R E) found.
Proof.
  destruct lanes_do_not_overflow as (_ & Fu & Fv & Fw & _). pose proof (fits_more _ 107 _ _ Fu ltac:(lia)) as Fu'. pose proof (fits_more _ 107 _ _ Fv ltac:(lia)) as Fv'.
  destruct delta_fits as (A & Ea & _). destruct (opp_fits _ _ _ delta_fits) as (A' & Ea' & _).
  destruct (lesser_fits _ _ _ _ _ (lesser_fits _ _ _ _ _ Fu' Fv') Fw) as (L & El & _).
  destruct (greater_fits _ _ _ _ _ (greater_fits _ _ _ _ _ Fu' Fv') Fw) as (G & Eg & _).
  unfold f_missed, is_missed. rewrite !Bltb_correct by assumption. rewrite El, Eg, Ea, Ea'. intros H. apply andb_prop in H. destruct H as [X Y].
  split; now apply ltb_true.
Qed.

Lemma beyond_agrees best : is_nan best = false -> 0 <= value best -> 0 < R32 (Rabs (det found) + det_off_of (B2R D) (B2R E)) ->
  f_beyond D C E best c = true -> is_finite best = true /\ is_beyond (Bsign (f_det c)) (B2R D) (B2R C) (B2R E) (B2R best) found.
Proof.
  intros Nb Pb Pos. destruct lanes_do_not_overflow as (Fd & _ & _ & _ & Ft). destruct Fd as (Dd & Ed & Bd).
  assert (Fa : fits 105 (Babs (f_det c)) (Rabs (det found))) by (split; [now rewrite is_finite_Babs|split; [now rewrite B2R_Babs, Ed|now rewrite Rabs_Rabsolu]]).
  pose proof (plus_fits 105 _ _ _ _ ltac:(lia) Fa (fits_more _ 105 _ _ det_off_fits ltac:(lia))) as Fs.
  assert (Ff : fits 126 (if Bsign (f_det c) then Bopp (f_t c) else f_t c) (front (Bsign (f_det c)) (top_t found))).
  { unfold front, Triple.front. destruct (Bsign (f_det c)); [now apply opp_fits|exact Ft]. }
  pose proof (minus_fits 126 _ _ _ _ ltac:(lia) Ff (fits_more _ 126 _ _ t_off_fits ltac:(lia))) as (Lf & Lv & _).
  destruct Fs as (Sf & Sv & _). unfold f_beyond, is_beyond. set (left := minus _ _) in *. set (sum := plus _ _) in *. intros H.
  assert (Fb : is_finite best = true).
  { destruct best as [s|s| |s m e Hm]; try discriminate; try reflexivity. exfalso. unfold Slabs.value in Pb. destruct s; [pose proof (bpow_gt_0 radix2 128); lra|].
    destruct sum as [x|x| |x m e Hm]; try discriminate. destruct x; [|clearbody left; clear - H; now destruct left as [|[]| |[]]].
    assert (B2R (B754_finite true m e Hm : float) < 0) by (apply (F2R_lt_0 radix2 (Float radix2 (Z.neg m) e)); reflexivity). lra. }
  split; [exact Fb|]. rewrite (finite_value 24 128 best Fb) in Pb. generalize (Bmult_correct 24 128 eq_refl eq_refl mode_NE sum best).
  change (round_mode mode_NE) with ZnearestE. change (SpecFloat.fexp 24 128) with (FLT_exp (-149) 24). rewrite Sv.
  destruct (Rlt_bool_spec (Rabs (R32 (R32 (Rabs (det found) + det_off_of (B2R D) (B2R E)) * B2R best))) (bpow radix2 128)) as [K|K].
  - rewrite Sf, Fb. intros (V & Fin & _). rewrite Bltb_correct in H by assumption. rewrite V, Lv in H. now apply ltb_true.
  - intros E'. exfalso. assert (Nz : B2R best <> 0).
    { intros Z. rewrite Z, Rmult_0_r, round_0, Rabs_R0 in K by typeclasses eauto. pose proof (bpow_gt_0 radix2 128). lra. }
    pose proof (sign_of_R 24 128 2 (or_introl eq_refl) sum) as S1. pose proof (sign_of_R 24 128 2 (or_introl eq_refl) best) as S2.
    assert (Q : times sum best = B754_infinity false).
    { apply B2SF_inj. rewrite E'. destruct (Bsign sum), (Bsign best); try lra. reflexivity. }
    rewrite Q in H. clearbody left. clear - H. now destruct left as [|[]| |[]].
Qed.
End Usual.
