(** A ray that is known within bounds: [Errors::within] of src/geom/kernel/exact/filter.rs. What is found for the ray in the middle
    decides for every ray whose origin is off by at most [w], and whose direction by at most [v], in each component. Relative errors
    only, as in Filter.v and Quotient.v. *)
Require Import Reals ZArith Lia Lra Psatz.
From Flocq Require Import Core.
Require Import StacklessExact.Rounding StacklessExact.Triple StacklessExact.Filter StacklessExact.Quotient.
Open Scope R_scope.

(** * The bounds of the code *)

Section Operations.
Variable RN : R -> R.
Variable unit : R.

(** [Errors::within]: what origin and direction may be off by, and the greatest components of d, s, and e1 and e2. *)
Definition within_sign (w v d c e : R) : R :=
  RN (error_sign RN unit d c e + RN (RN (12 * e) * RN (RN (v * RN (c + e)) + RN (w * RN (d + v))))).
Definition within_det (v d e : R) : R := RN (error_det RN unit d e + RN (RN (6 * v) * RN (e * e))).
Definition within_t (w c e : R) : R := RN (error_t RN unit c e + RN (RN (6 * w) * RN (e * e))).
End Operations.

(** A vector is off by at most so much in each component. *)
Definition near (b : R) (x y : vec) : Prop := bounded b (vsub exactly x y).

Section Off.
Variable prec : Z.
Context { prec_pos : Prec_gt_0 prec }.
Hypothesis prec_11 : (11 <= prec)%Z.
Notation RN := (round radix2 (FLX_exp prec) ZnearestE).
Notation u := (Rounding.unit prec).

Let Hu : 0 < u <= / 2048 := Hu prec prec_11.
Notation below := (below prec prec_11).
Notation pos := (RN_pos prec prec_11).

Variables v0 v1 v2 o d o' d' : vec.
Notation e1 := (vsub RN v1 v0).
Notation e2 := (vsub RN v2 v0).
Notation s := (vsub RN o v0).
(** For the ray in the middle, as computed and exactly; and for the true ray. *)
Let found := determinants_of RN v0 v1 v2 o d.
Let middle := determinants_of exactly v0 v1 v2 o d.
Let truth := determinants_of exactly v0 v1 v2 o' d'.

Variables w v D C E : R.
Hypothesis Ho : near w o o'.
Hypothesis Hd : near v d d'.
Hypothesis HD : bounded D d.
Hypothesis HC : bounded C s.
Hypothesis HE : bounded E e1 /\ bounded E e2.

Let Pw : 0 <= w := pos_b _ _ (proj1 Ho).
Let Pv : 0 <= v := pos_b _ _ (proj1 Hd).
Let PD : 0 <= D := pos_b _ _ (proj1 HD).
Let PC : 0 <= C := pos_b _ _ (proj1 HC).
Let PE : 0 <= E := pos_b _ _ (proj1 (proj1 HE)).

(** * What the true determinants are off by *)

(** A rounded vector is not much less than the exact one. *)
Lemma exact_bound B a b : bounded B (vsub RN a b) -> bounded (B * (1 + u)) (vsub exactly a b).
Proof.
  intros (X & Y & Z). cbn [vsub vx vy vz] in *. unfold exactly. cbn [vsub vx vy vz].
  destruct (row_b u _ _ _ _ _ _ B (rounded prec prec_11 (vx a - vx b) (vy a - vy b) (vz a - vz b)) X Y Z) as (X' & Y' & Z').
  repeat split; assumption.
Qed.

Lemma true_direction : bounded (D + v) d'.
Proof.
  destruct HD as (X & Y & Z), Hd as (X' & Y' & Z'). unfold exactly in *. cbn [vsub vx vy vz] in *.
  split; [replace (vx d') with (vx d - (vx d - vx d')) by ring|split; [replace (vy d') with (vy d - (vy d - vy d')) by ring|
    replace (vz d') with (vz d - (vz d - vz d')) by ring]]; now apply sub_b.
Qed.

(** Hadamard, for vectors. *)
Definition det_of (a b c : vec) : R := det3 (vx a) (vy a) (vz a) (vx b) (vy b) (vz b) (vx c) (vy c) (vz c).
Lemma det_of_b a b c A B C' : bounded A a -> bounded B b -> bounded C' c -> Rabs (det_of a b c) <= 4 * (A * B * C').
Proof. intros (? & ? & ?) (? & ? & ?) (? & ? & ?). now apply det3_b. Qed.

Notation q := ((1 + u) * (1 + u)).
Notation sub := (vsub exactly).
Ltac determinants := unfold middle, truth, det_of, det3, exactly, vsub; simpl; unfold dot; simpl; ring.

Let B1 : bounded (E * (1 + u)) (sub v1 v0) := exact_bound E v1 v0 (proj1 HE).
Let B2 : bounded (E * (1 + u)) (sub v2 v0) := exact_bound E v2 v0 (proj2 HE).
Let Bs : bounded (C * (1 + u)) (sub o v0) := exact_bound C o v0 HC.

(** The determinant, for another direction. [INST-5] *)
Theorem det_moves : Rabs (det middle - det truth) <= 4 * q * (v * E * E).
Proof.
  replace (det middle - det truth) with (det_of (sub v1 v0) (sub d d') (sub v2 v0)) by determinants.
  eapply Rle_trans; [apply (det_of_b _ _ _ _ _ _ B1 Hd B2)|right; ring].
Qed.

(** The distance times the determinant, for another origin. [INST-5] *)
Theorem t_moves : Rabs (top_t middle - top_t truth) <= 4 * q * (w * E * E).
Proof.
  replace (top_t middle - top_t truth) with (det_of (sub v2 v0) (sub o o') (sub v1 v0)) by determinants.
  eapply Rle_trans; [apply (det_of_b _ _ _ _ _ _ B2 Ho B1)|right; ring].
Qed.

(** Of U and V, for both: first the direction, then the origin. *)
Let room := v * C + w * (D + v).
Let P_room : 0 <= room.
Proof. unfold room. assert (0 <= v * C) by (now apply Rmult_le_pos). assert (0 <= w * (D + v)) by (apply Rmult_le_pos; lra). lra. Qed.

Let two a b : Rabs a <= 4 * (C * (1 + u) * v * (E * (1 + u))) -> Rabs b <= 4 * (w * (D + v) * (E * (1 + u))) -> Rabs (a + b) <= 4 * q * (E * room).
Proof.
  intros A B. eapply Rle_trans; [apply add_b; eassumption|]. assert (0 <= w * (D + v) * (E * (1 + u))) by (repeat apply Rmult_le_pos; lra).
  assert (L : w * (D + v) * (E * (1 + u)) * 1 <= w * (D + v) * (E * (1 + u)) * (1 + u)) by (apply Rmult_le_compat_l; lra). unfold room. lra.
Qed.
(** U. [INST-5] *)
Theorem u_moves : Rabs (edge_u middle - edge_u truth) <= 4 * q * (E * room).
Proof.
  replace (edge_u middle - edge_u truth) with (det_of (sub o v0) (sub d d') (sub v2 v0) + det_of (sub o o') d' (sub v2 v0)) by determinants.
  apply two; [apply (det_of_b _ _ _ _ _ _ Bs Hd B2)|apply (det_of_b _ _ _ _ _ _ Ho true_direction B2)].
Qed.
(** V. [INST-5] *)
Theorem v_moves : Rabs (edge_v middle - edge_v truth) <= 4 * q * (E * room).
Proof.
  replace (edge_v middle - edge_v truth) with (det_of (sub o v0) (sub v1 v0) (sub d d') + det_of (sub o o') (sub v1 v0) d') by determinants.
  apply two; [eapply Rle_trans; [apply (det_of_b _ _ _ _ _ _ Bs B1 Hd)|right; ring]|
    eapply Rle_trans; [apply (det_of_b _ _ _ _ _ _ Ho B1 true_direction)|right; ring]].
Qed.

(** What det, U and V are off by adds up in W. [INST-5] *)
Theorem w_moves : Rabs (edge_w middle - edge_w truth) <= 4 * q * (v * E * E) + 8 * q * (E * room).
Proof.
  replace (edge_w middle - edge_w truth) with
    ((det middle - det truth) - (edge_u middle - edge_u truth) - (edge_v middle - edge_v truth)) by (unfold middle, truth, exactly; simpl; ring).
  eapply Rle_trans; [apply sub_b; [apply sub_b; [apply det_moves|apply u_moves]|apply v_moves]|right; ring].
Qed.

(** * The bounds as evaluated *)

Let q_small : 1 <= q <= 1 + 3 * / 2048.
Proof. assert (u * u <= u * / 2048) by (apply Rmult_le_compat_l; lra). assert (0 <= u * u) by (apply Rmult_le_pos; lra). split; lra. Qed.

(** A product of numbers that are not less than others, rounded: all but a part of theirs. *)
Lemma product_below x y a b p r : 0 <= a -> 0 <= b -> 0 <= p -> 0 <= r -> p * a <= x -> r * b <= y -> p * r * (1 - / 2048) * (a * b) <= RN (x * y).
Proof.
  intros Ha Hb Hp Hr X Y. assert (0 <= p * a) by (now apply Rmult_le_pos). assert (0 <= r * b) by (now apply Rmult_le_pos).
  assert (P : 0 <= x * y) by (apply Rmult_le_pos; lra). eapply Rle_trans; [|apply (below _ P)].
  assert (M : p * a * (r * b) <= x * y) by (now apply Rmult_le_compat).
  apply Rle_trans with (p * a * (r * b) * (1 - / 2048)); [right; ring|]. apply Rmult_le_compat; try lra. now apply Rmult_le_pos.
Qed.
Lemma sum_below x y a b p : 0 <= a -> 0 <= b -> 0 <= p -> p * a <= x -> p * b <= y -> p * (1 - / 2048) * (a + b) <= RN (x + y).
Proof.
  intros Ha Hb Hp X Y. assert (0 <= p * a) by (now apply Rmult_le_pos). assert (0 <= p * b) by (now apply Rmult_le_pos).
  eapply Rle_trans; [|apply below; lra]. apply Rle_trans with ((p * a + p * b) * (1 - / 2048)); [right; ring|]. apply Rmult_le_compat; lra.
Qed.

Notation z := (1 - / 2048).
Lemma room_from_below : (1 - 6 * / 2048) * (12 * (E * (room + v * E))) <=
  RN (RN (12 * E) * RN (RN (v * RN (C + E)) + RN (w * RN (D + v)))).
Proof.
  assert (S1 : 1 * z * (C + E) <= RN (C + E)) by (apply sum_below; lra).
  assert (S2 : 1 * z * (D + v) <= RN (D + v)) by (apply sum_below; lra).
  assert (T1 : 1 * (1 * z) * z * (v * (C + E)) <= RN (v * RN (C + E))) by (apply product_below; lra).
  assert (T2 : 1 * (1 * z) * z * (w * (D + v)) <= RN (w * RN (D + v))) by (apply product_below; lra).
  assert (N1 : 0 <= v * (C + E)) by (apply Rmult_le_pos; lra). assert (N2 : 0 <= w * (D + v)) by (apply Rmult_le_pos; lra).
  assert (S : 1 * (1 * z) * z * z * (v * (C + E) + w * (D + v)) <= RN (RN (v * RN (C + E)) + RN (w * RN (D + v)))) by (apply sum_below; lra).
  assert (T : 1 * 1 * z * (12 * E) <= RN (12 * E)) by (apply product_below; lra).
  assert (Q : 1 * 1 * z * (1 * (1 * z) * z * z) * z * (12 * E * (v * (C + E) + w * (D + v))) <=
    RN (RN (12 * E) * RN (RN (v * RN (C + E)) + RN (w * RN (D + v))))) by (apply product_below; lra).
  eapply Rle_trans; [|exact Q]. replace (12 * (E * (room + v * E))) with (12 * E * (v * (C + E) + w * (D + v))) by (unfold room; ring).
  apply Rmult_le_compat_r; [repeat apply Rmult_le_pos; lra|lra].
Qed.

Let sigma := within_sign RN u w v D C E.
Let first := error_sign RN u D C E.

(** What an edge function and det are off by: what is rounded, and what the ray is off by. *)
Let edge_room := 77 / 2 * u * (D * E * (2 * C + E)) + (4 * q * (v * E * E) + 8 * q * (E * room)).
Let det_room := k prec * (D * E * E) + 4 * q * (v * E * E).
Let DCE := D * C * E.
Let DEE := D * E * E.
Let P1 : 0 <= u * DCE. Proof. unfold DCE. repeat apply Rmult_le_pos; lra. Qed.
Let P2 : 0 <= u * DEE. Proof. unfold DEE. repeat apply Rmult_le_pos; lra. Qed.
Let P3 : 0 <= v * E * E. Proof. repeat apply Rmult_le_pos; lra. Qed.
Let P4 : 0 <= E * room. Proof. apply Rmult_le_pos; lra. Qed.

Lemma sigma_low : (1 - 6 * / 2048) * (78 * u * (DCE + DEE)) + (1 - 8 * / 2048) * (12 * (E * room + v * E * E)) <= sigma.
Proof.
  pose proof (sigma_from_below prec prec_11 v0 v1 v2 o d D C E HD HC HE) as A. fold first in A. pose proof room_from_below as B.
  replace (D * E * (C + E)) with (DCE + DEE) in A by (unfold DCE, DEE; ring).
  replace (E * (room + v * E)) with (E * room + v * E * E) in B by ring.
  set (x := RN (RN (12 * E) * _)) in B. unfold sigma, within_sign. fold first x.
  set (r := E * room) in *. set (m := v * E * E) in *.
  eapply Rle_trans; [|apply below; lra].
  assert (L : (first + x) * (1 - / 2048) <= (first + x) * (1 - u)) by (apply Rmult_le_compat_l; lra). lra.
Qed.
(** σ' covers both together. [INST-5] *)
Theorem within_is_enough : edge_room + det_room <= sigma.
Proof.
  pose proof sigma_low as S. pose proof (k_small prec prec_11) as K. pose proof q_small as Q. unfold edge_room, det_room. fold DEE.
  replace (D * E * (2 * C + E)) with (2 * DCE + DEE) by (unfold DCE, DEE; ring).
  assert (A : k prec * DEE <= (30 + 53 / 2048) * u * DEE) by (apply Rmult_le_compat_r; [unfold DEE; repeat apply Rmult_le_pos; lra|lra]).
  assert (B : q * (v * E * E) <= (1 + 3 * / 2048) * (v * E * E)) by (apply Rmult_le_compat_r; lra).
  assert (B' : q * (E * room) <= (1 + 3 * / 2048) * (E * room)) by (apply Rmult_le_compat_r; lra).
  set (r := E * room) in *. set (m := v * E * E) in *. lra.
Qed.

Lemma edges_far : Rabs (edge_u found - edge_u truth) <= edge_room /\ Rabs (edge_v found - edge_v truth) <= edge_room /\
  Rabs (edge_w found - edge_w truth) <= edge_room /\ Rabs (det found - det truth) <= det_room.
Proof.
  destruct (edges_off prec prec_11 v0 v1 v2 o d D C E HD HC HE) as [U V]. pose proof (w_off prec prec_11 v0 v1 v2 o d D C E HD HC HE) as W.
  pose proof (det_off prec prec_11 v0 v1 v2 o d D E HD HE) as T. fold found middle in U, V, W, T.
  pose proof q_small as Q. assert (0 <= q * (v * E * E)) by (apply Rmult_le_pos; lra). assert (0 <= q * (E * room)) by (apply Rmult_le_pos; lra).
  split; [|split; [|split]].
  - eapply Rle_trans; [exact (far_b _ _ _ _ _ U u_moves)|]. unfold edge_room. lra.
  - eapply Rle_trans; [exact (far_b _ _ _ _ _ V v_moves)|]. unfold edge_room. lra.
  - exact (far_b _ _ _ _ _ W w_moves).
  - exact (far_b _ _ _ _ _ T det_moves).
Qed.

(** [Determinants::is_miss] with these bounds is right about the true ray. [INST-5] *)
Theorem within_miss_is_right neg : sign_bit neg (det found) -> is_miss neg sigma found -> ~ meets truth.
Proof.
  pose proof within_is_enough as S. destruct edges_far as (U & V & W & T). intros N [F|[F|F]]; unfold front in F.
  - apply (miss_is_certain neg (det found) (edge_u found) (det truth) _ _ _ (edge_u truth) _ _ N T U); auto; lra.
  - apply (miss_is_certain neg (det found) (edge_v found) (det truth) _ _ _ (edge_v truth) _ _ N T V); auto; lra.
  - apply (miss_is_certain neg (det found) (edge_w found) (det truth) _ _ _ (edge_w truth) _ _ N T W); auto; lra.
Qed.

Let P_det : 0 <= det_room.
Proof.
  unfold det_room. pose proof (k_small prec prec_11). pose proof q_small. assert (0 <= q * (v * E * E)) by (apply Rmult_le_pos; lra).
  assert (0 <= k prec * (D * E * E)) by (apply Rmult_le_pos; [lra|repeat apply Rmult_le_pos; assumption]). lra.
Qed.

(** So is [is_hit]. [INST-5] *)
Theorem within_hit_is_right neg : is_hit neg sigma found -> meets truth.
Proof.
  pose proof within_is_enough as S. destruct edges_far as (U & V & W & _). pose proof P_det. intros (A & B & G). unfold front in *.
  apply (hit_is_certain neg (edge_u found) (edge_v found) (edge_w found) _ _ _ _ edge_room); auto; lra.
Qed.

(** * Distances and weights *)

Lemma within_det_is_enough : 5 / 4 * det_room <= within_det RN u v D E.
Proof.
  pose proof (k_small prec prec_11) as K. pose proof q_small as Q. pose proof (evaluated prec prec_11 v0 v1 v2 E HE (31 * u * (5 / 4)) D ltac:(lra) PD) as A.
  fold (error_det RN u D E) in A. replace (D * (E * E)) with DEE in A by (unfold DEE; ring).
  assert (T : 1 * 1 * z * (6 * v) <= RN (6 * v)) by (apply product_below; lra).
  assert (T2 : 1 * 1 * z * (E * E) <= RN (E * E)) by (apply product_below; lra).
  assert (EE : 0 <= E * E) by (now apply Rmult_le_pos).
  assert (B : 1 * 1 * z * (1 * 1 * z) * z * (6 * v * (E * E)) <= RN (RN (6 * v) * RN (E * E))) by (apply product_below; lra).
  replace (6 * v * (E * E)) with (6 * (v * E * E)) in B by ring. set (y := RN (RN (6 * v) * RN (E * E))) in *. set (x := error_det RN u D E) in *.
  unfold within_det, det_room. fold x y DEE.
  assert (G : k prec * DEE <= (30 + 53 / 2048) * u * DEE) by (apply Rmult_le_compat_r; [unfold DEE; repeat apply Rmult_le_pos; lra|lra]).
  assert (B' : q * (v * E * E) <= (1 + 3 * / 2048) * (v * E * E)) by (apply Rmult_le_compat_r; lra).
  set (m := v * E * E) in *. eapply Rle_trans; [|apply below; lra].
  assert (L : (x + y) * (1 - / 2048) <= (x + y) * (1 - u)) by (apply Rmult_le_compat_l; lra). lra.
Qed.

Let t_room := (34 * u + 62 * (u * u)) * (C * E * E) + 4 * q * (w * E * E).
Lemma within_t_is_enough : 5 / 4 * t_room <= within_t RN u w C E.
Proof.
  pose proof q_small as Q. pose proof (evaluated prec prec_11 v0 v1 v2 E HE (35 * u * (5 / 4)) C ltac:(lra) PC) as A.
  fold (error_t RN u C E) in A. replace (C * (E * E)) with (C * E * E) in A by ring.
  assert (T : 1 * 1 * z * (6 * w) <= RN (6 * w)) by (apply product_below; lra).
  assert (T2 : 1 * 1 * z * (E * E) <= RN (E * E)) by (apply product_below; lra).
  assert (EE : 0 <= E * E) by (now apply Rmult_le_pos).
  assert (B : 1 * 1 * z * (1 * 1 * z) * z * (6 * w * (E * E)) <= RN (RN (6 * w) * RN (E * E))) by (apply product_below; lra).
  replace (6 * w * (E * E)) with (6 * (w * E * E)) in B by ring. set (y := RN (RN (6 * w) * RN (E * E))) in *. set (x := error_t RN u C E) in *.
  unfold within_t, t_room. fold x y.
  assert (U2 : u * u <= u * / 2048) by (apply Rmult_le_compat_l; lra).
  assert (PCE : 0 <= C * E * E) by (repeat apply Rmult_le_pos; assumption).
  assert (G : (34 * u + 62 * (u * u)) * (C * E * E) <= (34 + 62 / 2048) * (u * (C * E * E))).
  { replace ((34 + 62 / 2048) * (u * (C * E * E))) with ((34 + 62 / 2048) * u * (C * E * E)) by ring. apply Rmult_le_compat_r; [assumption|lra]. }
  assert (Pm : 0 <= w * E * E) by (repeat apply Rmult_le_pos; assumption).
  assert (Pc : 0 <= u * (C * E * E)) by (apply Rmult_le_pos; lra).
  assert (B' : q * (w * E * E) <= (1 + 3 * / 2048) * (w * E * E)) by (apply Rmult_le_compat_r; lra).
  replace (35 * u * (5 / 4) * (C * E * E)) with (35 * (5 / 4) * (u * (C * E * E))) in A by ring.
  set (m := w * E * E) in *. set (c := u * (C * E * E)) in *. eapply Rle_trans; [|apply below; lra].
  assert (L : (x + y) * (1 - / 2048) <= (x + y) * (1 - u)) by (apply Rmult_le_compat_l; lra). lra.
Qed.

(** What EXACT-9 asks of the determinant, for a certain hit. *)
Lemma within_is_far_from_parallel neg : is_hit neg sigma found -> 15 / 2 * det_room <= Rabs (det found) /\ det found <> 0.
Proof.
  intros H. pose proof sigma_low as S. pose proof (k_small prec prec_11) as K. pose proof q_small as Q.
  assert (G : k prec * DEE <= (30 + 53 / 2048) * u * DEE) by (apply Rmult_le_compat_r; [unfold DEE; repeat apply Rmult_le_pos; lra|lra]).
  assert (B' : q * (v * E * E) <= (1 + 3 * / 2048) * (v * E * E)) by (apply Rmult_le_compat_r; lra).
  assert (Ps : 0 <= sigma) by (set (r := E * room) in *; set (m := v * E * E) in *; lra).
  pose proof (hit_determinant prec prec_11 neg sigma v0 v1 v2 o d Ps H) as L. fold found in L.
  assert (sigma * u <= sigma * / 2048) by (apply Rmult_le_compat_l; lra).
  split; [unfold det_room; fold DEE; set (r := E * room) in *; set (m := v * E * E) in *; lra|].
  (* Else all bounds are 0, and no three edge functions are above 0 that add up to it. *)
  destruct (within_hit_is_right neg H) as (N & _). intros Z. apply N. destruct edges_far as (_ & _ & _ & T). rewrite Z, Rabs_R0 in L.
  assert (det_room <= 0) by (unfold det_room; fold DEE; set (r := E * room) in *; set (m := v * E * E) in *; lra).
  rewrite Z, Rminus_0_l, Rabs_Ropp in T. destruct (Req_dec (det truth) 0) as [|Nz]; [assumption|]. pose proof (Rabs_pos_lt _ Nz). lra.
Qed.

(** [Determinants::distance] with these bounds encloses that of the true ray. [INST-5] *)
Theorem within_distance neg : is_hit neg sigma found ->
  let '(low, high) := over_determinant RN u (top_t found) (within_t RN u w C E) (det found) (within_det RN u v D E) in
  low <= top_t truth / det truth <= high.
Proof.
  intros H. destruct (within_is_far_from_parallel neg H) as [L N]. destruct edges_far as (_ & _ & _ & T).
  apply (enclosure prec prec_11) with (dT := t_room) (dd := det_room); auto using within_det_is_enough, within_t_is_enough.
  exact (far_b _ _ _ _ _ (t_off prec prec_11 v0 v1 v2 o d C E HC HE) t_moves).
Qed.

(** So does [weights]. [INST-5] *)
Theorem within_weights neg : is_hit neg sigma found ->
  (let '(low, high) := over_determinant RN u (edge_u found) (RN (sigma * (5 / 4))) (det found) (within_det RN u v D E) in
   low <= edge_u truth / det truth <= high) /\
  (let '(low, high) := over_determinant RN u (edge_v found) (RN (sigma * (5 / 4))) (det found) (within_det RN u v D E) in
   low <= edge_v truth / det truth <= high).
Proof.
  intros H. destruct (within_is_far_from_parallel neg H) as [L N]. destruct edges_far as (_ & _ & _ & T).
  pose proof sigma_low as S. pose proof (k_small prec prec_11) as K. pose proof q_small as Q.
  set (edge := k prec * (D * C * E) + 4 * q * (E * room)).
  assert (U : Rabs (edge_u found - edge_u truth) <= edge) by exact (far_b _ _ _ _ _ (u_off prec prec_11 v0 v1 v2 o d D C E HD HC HE) u_moves).
  assert (V : Rabs (edge_v found - edge_v truth) <= edge) by exact (far_b _ _ _ _ _ (v_off prec prec_11 v0 v1 v2 o d D C E HD HC HE) v_moves).
  assert (G : 5 / 4 * edge <= RN (sigma * (5 / 4))).
  { unfold edge. fold DCE. assert (G : k prec * DCE <= (30 + 53 / 2048) * u * DCE) by (apply Rmult_le_compat_r; [unfold DCE; repeat apply Rmult_le_pos; lra|lra]).
    assert (B' : q * (E * room) <= (1 + 3 * / 2048) * (E * room)) by (apply Rmult_le_compat_r; lra).
    set (r := E * room) in *. set (m := v * E * E) in *. assert (Ps : 0 <= sigma) by lra. eapply Rle_trans; [|apply below; lra].
    assert (sigma * u <= sigma * / 2048) by (apply Rmult_le_compat_l; lra). lra. }
  split; apply (enclosure prec prec_11) with (dT := edge) (dd := det_room); auto using within_det_is_enough.
Qed.
End Off.
