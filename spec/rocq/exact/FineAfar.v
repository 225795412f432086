(** Bounds of twice the digits for far points: src/geom/nearest/afar.rs, where the unit is 1 (distances from 2^-200 to 2^200). NEAR-8. *)
Require Import Reals ZArith Lia Lra.
From Flocq Require Import Core Mult_error.
Require Import StacklessExact.Rounding StacklessExact.Range StacklessExact.Expansion StacklessExact.Fine StacklessExact.FineSums StacklessExact.FineProducts.
Require Import StacklessExact.FineQuotients StacklessExact.FineRoots StacklessExact.FineDeterminants.
Require StacklessExact.Intervals.
Open Scope R_scope.

Local Instance prec_53 : Prec_gt_0 53 := eq_refl.
Local Notation eta := (bpow radix2 (-1074)).

(** * The code *)

(** [Fine::scaled], and [scaled] of afar.rs, where an exponent beyond 1000 is halved. *)
Definition times_two_to (x : fine) (e : Z) : fine :=
  Fine (R64 (high x * bpow radix2 e)) (R64 (low x * bpow radix2 e)) (R64 (R64 (R64 (radius x * bpow radix2 e) + UNDERFLOW) * UP)).
Definition scaled (x : fine) (e : Z) : fine :=
  if (e =? 0)%Z then x else if (Z.abs e <=? 1000)%Z then times_two_to x e else times_two_to (times_two_to x (Z.quot e 2)) (e - Z.quot e 2).

(** An axis: the coordinate of the point, the origin and the exponent of the frame, the two ends of the box in the frame, and whether doubles
    find the point before the box, or after it. *)
Record axis : Type := Axis { point : R; origin : R; exponent : Z; lo : R; hi : R; is_before : bool; is_after : bool }.
Definition step (square : fine) (a : axis) : fine :=
  let point := sub (exact (point a)) (exact (origin a)) in
  let inside x := scaled (exact x) (exponent a) in
  if is_before a then let way := sub (inside (lo a)) point in add square (mul way way)
  else if is_after a then let way := sub point (inside (hi a)) in add square (mul way way) else square.

(** The lower end of a root, if it is known. *)
Definition least_root (square : fine) : option (R * R) := if fst (root square) then Some (fst (bounds (snd (root square)))) else None.
Definition to_box (x y z : axis) : option (R * R) := least_root (step (step (step (exact 0) x) y) z).

(** The order of pairs. *)
Definition lesser (x y : R * R) : R * R := if Rlt_bool (fst x) (fst y) then x else if Rlt_bool (fst y) (fst x) then y else if Rlt_bool (snd x) (snd y) then x else y.
Definition to_triangle (corners : fines * fines * fines) (p q : fines) : option (R * R) :=
  let '(v0, v1, v2) := corners in
  let product v := fst (bounds (dot (minus v p) q)) in
  let a := product v0 in let b := product v1 in let c := product v2 in
  if andb (Rlt_bool 0 (fst a)) (andb (Rlt_bool 0 (fst b)) (Rlt_bool 0 (fst c))) then
    let size := root (dot q q) in
    if fst size then let quotient := over (of_two (lesser (lesser a b) c)) (snd size) in if Rlt_bool 0 (fst quotient) then Some (fst (bounds (snd quotient))) else None else None
  else None.

(** * Powers of two *)

Lemma scaled_off x e : F x -> Rabs (x * bpow radix2 e - R64 (x * bpow radix2 e)) <= / 2 * eta.
Proof.
  intros H. pose proof (bpow_gt_0 radix2 (-1074)) as P. destruct (Rlt_or_le (Rabs (x * bpow radix2 e)) (bpow radix2 (-1021))) as [L|L].
  - rewrite Rabs_minus_sym. pose proof (half_ulp (-1021) _ ltac:(lia) L) as G. replace (/ 2 * eta) with (bpow radix2 (-1021 - 54)); [exact G|]. change (-1021 - 54)%Z with (-1 + -1074)%Z. rewrite bpow_plus. reflexivity.
  - replace (R64 (x * bpow radix2 e)) with (x * bpow radix2 e); [rewrite Rminus_diag_eq, Rabs_R0 by reflexivity; lra|]. symmetry. apply round_generic; [typeclasses eauto|].
    assert (N : x <> 0) by (intros ->; rewrite Rmult_0_l, Rabs_R0 in L; pose proof (bpow_gt_0 radix2 (-1021)); lra).
    apply generic_format_FLT_FLX; [apply Rle_trans with (bpow radix2 (-1021)); [apply bpow_le; lia|exact L]|]. apply mult_bpow_exact_FLX. now apply generic_format_FLX_FLT in H.
Qed.

Definition one (x : fine) (r : R) : Prop := stands x r /\ low x = 0.

Lemma times_two_to_stands x r e : one x r -> one (times_two_to x e) (r * bpow radix2 e).
Proof.
  intros (((Fh & Fl & Fd & P & _) & V) & L). unfold holds in V. rewrite L in V. pose proof (bpow_gt_0 radix2 e) as B. pose proof (bpow_gt_0 radix2 (-1074)) as B'.
  assert (Fm : forall y, F (R64 y)) by (intros; apply generic_format_round; typeclasses eauto). assert (FU : F UNDERFLOW) by (apply generic_format_bpow; unfold FLT_exp; lia).
  pose proof (scaled_off _ e Fh) as H1. pose proof (scaled_off _ e Fd) as H2. assert (Z : R64 (low x * bpow radix2 e) = 0) by (rewrite L, Rmult_0_l; apply round_0; typeclasses eauto).
  assert (P1 : 0 <= radius x * bpow radix2 e) by (apply Rmult_le_pos; lra). assert (P2 : 0 <= R64 (radius x * bpow radix2 e)) by now apply R64_pos.
  pose proof (bpow_gt_0 radix2 (-1060)) as PU. change (bpow radix2 (-1060)) with UNDERFLOW in PU. pose proof (up_two _ _ (Fm (radius x * bpow radix2 e)) FU P2 (Rlt_le _ _ PU)) as G. pose proof UNDERFLOW_is as UI.
  split; [|exact Z]. unfold times_two_to. split.
  - repeat split; cbn [high low radius]; try apply Fm; [lra|]. rewrite Z, Rabs_R0. apply Rmult_le_pos; [apply bpow_ge_0|apply Rabs_pos].
  - unfold holds. cbn [high low radius]. rewrite Z. apply Rabs_le_inv in H1, H2, V. assert (V' : Rabs (r * bpow radix2 e - high x * bpow radix2 e) <= radius x * bpow radix2 e).
    { rewrite <- Rmult_minus_distr_r, Rabs_mult, (Rabs_pos_eq (bpow radix2 e)) by lra. apply Rmult_le_compat_r; [lra|]. apply Rabs_le. lra. }
    apply Rabs_le_inv in V'. apply Rabs_le. lra.
Qed.

(** A double times a power of two: no bit is lost that the radius does not cover. [NEAR-8] *)
Theorem scaled_stands x e : F x -> stands (scaled (exact x) e) (x * bpow radix2 e).
Proof.
  intros H. assert (O : one (exact x) x) by (split; [now apply exact_stands|reflexivity]). unfold scaled. destruct (Z.eqb_spec e 0) as [-> |].
  - rewrite Rmult_1_r. apply O.
  - destruct (Z.abs e <=? 1000)%Z; [apply (times_two_to_stands _ _ e O)|]. pose proof (times_two_to_stands _ _ (e - Z.quot e 2) (times_two_to_stands _ _ (Z.quot e 2) O)) as T.
    rewrite Rmult_assoc, <- bpow_plus in T. replace (Z.quot e 2 + (e - Z.quot e 2))%Z with e in T by ring. apply T.
Qed.

(** * Boxes *)

Definition floats (a : axis) : Prop := F (point a) /\ F (origin a) /\ F (lo a) /\ F (hi a).
Definition low_end (a : axis) : R := origin a + bpow radix2 (exponent a) * lo a.
Definition high_end (a : axis) : R := origin a + bpow radix2 (exponent a) * hi a.
(** Doubles are right where they find the point outside of the box. *)
Definition decided (a : axis) : Prop := (is_before a = true -> point a <= low_end a) /\ (is_after a = true -> high_end a <= point a).

Definition way (a : axis) : R := if is_before a then low_end a - point a else if is_after a then point a - high_end a else 0.

Lemma step_stands square s a : floats a -> stands square s -> stands (step square a) (s + way a * way a).
Proof.
  intros (P & O & L & H) S. assert (D : stands (sub (exact (point a)) (exact (origin a))) (point a - origin a)) by (apply sub_stands; now apply exact_stands).
  unfold step, way, low_end, high_end. destruct (is_before a); [|destruct (is_after a)].
  - apply add_stands; [exact S|]. replace (origin a + bpow radix2 (exponent a) * lo a - point a) with (lo a * bpow radix2 (exponent a) - (point a - origin a)) by ring.
    apply mul_stands; (apply sub_stands; [now apply scaled_stands|exact D]).
  - apply add_stands; [exact S|]. replace (point a - (origin a + bpow radix2 (exponent a) * hi a)) with (point a - origin a - hi a * bpow radix2 (exponent a)) by ring.
    apply mul_stands; (apply sub_stands; [exact D|now apply scaled_stands]).
  - now rewrite Rmult_0_l, Rplus_0_r.
Qed.

Lemma way_is_least a x : decided a -> low_end a <= x <= high_end a -> way a * way a <= (x - point a) * (x - point a).
Proof.
  intros (B & A) X. unfold way. destruct (is_before a); [|destruct (is_after a)].
  - specialize (B eq_refl). apply Rmult_le_compat; lra.
  - specialize (A eq_refl). replace ((x - point a) * (x - point a)) with ((point a - x) * (point a - x)) by ring. apply Rmult_le_compat; lra.
  - rewrite Rmult_0_l. apply Rle_0_sqr.
Qed.

(** The bound is not above the distance of any point of the box. [NEAR-8] *)
Theorem to_box_is_below x y z d px py pz : floats x -> floats y -> floats z -> decided x -> decided y -> decided z -> to_box x y z = Some d ->
  low_end x <= px <= high_end x -> low_end y <= py <= high_end y -> low_end z <= pz <= high_end z ->
  pair_sum d <= sqrt ((px - point x) * (px - point x) + (py - point y) * (py - point y) + (pz - point z) * (pz - point z)).
Proof.
  intros Fx Fy Fz Dx Dy Dz E X Y Z. unfold to_box, least_root in E.
  assert (F0 : F 0) by apply generic_format_0. pose proof (step_stands _ _ z Fz (step_stands _ _ y Fy (step_stands _ _ x Fx (exact_stands 0 F0)))) as S.
  set (square := step (step (step (exact 0) x) y) z) in *. clearbody square. destruct (fst (root square)) eqn:K; [|discriminate].
  assert (E' : fst (bounds (snd (root square))) = d) by congruence. rewrite <- E'. clear E E'.
  destruct (root_stands _ _ S K) as (_ & R). pose proof (bounds_hold _ _ R) as B. destruct (bounds (snd (root square))) as [below above]. cbn [fst]. eapply Rle_trans; [apply B|]. apply sqrt_le_1_alt.
  pose proof (way_is_least x px Dx X). pose proof (way_is_least y py Dy Y). pose proof (way_is_least z pz Dz Z). lra.
Qed.

(** * Triangles *)

Lemma end_stands x r : stands x r -> let below := fst (bounds x) in stands (of_two below) (pair_sum below) /\ pair_sum below <= r /\ fst below = R64 (pair_sum below).
Proof.
  intros S. pose proof (bounds_hold x r S) as B. destruct S as ((Fh & Fl & Fr & P & _) & _). destruct x as [h l d]. unfold bounds in *. cbn [high low radius fst] in *. cbv zeta.
  destruct (Intervals.plus_holds (l, l) (- d, d) l 0) as [[F1 F2] _]; [split; exact Fl|split; [now apply F_opp|exact Fr]|split; cbn; lra|split; cbn; lra|].
  set (b := fst (Intervals.plus (l, l) (- d, d))) in *. split; [|split; [apply B|]]; rewrite two_sum_is_exact by assumption; [now apply of_two_stands|now rewrite two_sum_is by assumption].
Qed.

Lemma lesser_is x y : fst x = R64 (pair_sum x) -> fst y = R64 (pair_sum y) -> pair_sum (lesser x y) <= pair_sum x /\ pair_sum (lesser x y) <= pair_sum y /\ (lesser x y = x \/ lesser x y = y).
Proof.
  intros X Y. assert (M : fst x < fst y -> pair_sum x <= pair_sum y).
  { intros H. destruct (Rlt_or_le (pair_sum y) (pair_sum x)) as [L|L]; [exfalso|exact L]. apply Rlt_le, R64_le in L. lra. }
  assert (M' : fst y < fst x -> pair_sum y <= pair_sum x).
  { intros H. destruct (Rlt_or_le (pair_sum x) (pair_sum y)) as [L|L]; [exfalso|exact L]. apply Rlt_le, R64_le in L. lra. }
  unfold lesser. destruct (Rlt_bool_spec (fst x) (fst y)) as [A|A]; [specialize (M A); repeat split; auto; lra|].
  destruct (Rlt_bool_spec (fst y) (fst x)) as [B|B]; [specialize (M' B); repeat split; auto; lra|]. assert (E : fst x = fst y) by lra.
  destruct (Rlt_bool_spec (snd x) (snd y)) as [C|C]; unfold pair_sum; rewrite E; repeat split; auto; lra.
Qed.

(** Nor is it above the distance of any point of the triangle, whatever direction q is taken. [NEAR-8] *)
Theorem to_triangle_is_below v0 v1 v2 p q d ax ay az bx by_ bz cx cy cz px py pz qx qy qz u v : stand v0 ax ay az -> stand v1 bx by_ bz -> stand v2 cx cy cz -> stand p px py pz -> stand q qx qy qz ->
  to_triangle (v0, v1, v2) p q = Some d -> 0 <= u -> 0 <= v -> 0 <= 1 - u - v ->
  let x := (1 - u - v) * ax + u * bx + v * cx - px in let y := (1 - u - v) * ay + u * by_ + v * cy - py in let z := (1 - u - v) * az + u * bz + v * cz - pz in
  pair_sum d <= sqrt (x * x + y * y + z * z).
Proof.
  intros A B C P Q E U V W x y z. unfold to_triangle in E.
  pose proof (end_stands _ _ (dot_stands _ _ _ _ _ _ _ _ (minus_stands _ _ _ _ _ _ _ _ A P) Q)) as (_ & A2 & A3).
  pose proof (end_stands _ _ (dot_stands _ _ _ _ _ _ _ _ (minus_stands _ _ _ _ _ _ _ _ B P) Q)) as (_ & B2 & B3).
  pose proof (end_stands _ _ (dot_stands _ _ _ _ _ _ _ _ (minus_stands _ _ _ _ _ _ _ _ C P) Q)) as (_ & C2 & C3).
  pose proof (end_stands _ _ (dot_stands _ _ _ _ _ _ _ _ (minus_stands _ _ _ _ _ _ _ _ A P) Q)) as (A1 & _ & _).
  pose proof (end_stands _ _ (dot_stands _ _ _ _ _ _ _ _ (minus_stands _ _ _ _ _ _ _ _ B P) Q)) as (B1 & _ & _).
  pose proof (end_stands _ _ (dot_stands _ _ _ _ _ _ _ _ (minus_stands _ _ _ _ _ _ _ _ C P) Q)) as (C1 & _ & _).
  set (a := fst (bounds (dot (minus v0 p) q))) in *. set (b := fst (bounds (dot (minus v1 p) q))) in *. set (c := fst (bounds (dot (minus v2 p) q))) in *. cbv zeta in *.
  destruct (Rlt_bool_spec 0 (fst a)) as [Ha|], (Rlt_bool_spec 0 (fst b)) as [Hb|], (Rlt_bool_spec 0 (fst c)) as [Hc|]; cbn [andb] in E; try discriminate.
  destruct (fst (root (dot q q))) eqn:K; [|discriminate]. destruct (Rlt_bool_spec 0 (fst (over (of_two (lesser (lesser a b) c)) (snd (root (dot q q)))))) as [K'|]; [|discriminate].
  destruct (root_stands _ _ (dot_stands _ _ _ _ _ _ _ _ Q Q) K) as (Qp & R). set (size := qx * qx + qy * qy + qz * qz) in *.
  destruct (lesser_is a b A3 B3) as (L1 & L2 & L3). set (ab := lesser a b) in *. assert (AB : fst ab = R64 (pair_sum ab) /\ stands (of_two ab) (pair_sum ab)) by (destruct L3 as [-> | ->]; now split).
  destruct AB as (AB3 & AB1). destruct (lesser_is ab c AB3 C3) as (M1 & M2 & M3). set (m := lesser ab c) in *. assert (S : stands (of_two m) (pair_sum m)) by (destruct M3 as [-> | ->]; assumption).
  destruct (over_stands _ _ _ _ S R K') as (N & O). pose proof (bounds_hold _ _ O) as H. 
  set (found := snd (over (of_two m) (snd (root (dot q q))))) in *. assert (E' : fst (bounds found) = d) by congruence. rewrite <- E'. clear E E' K'. clearbody found. destruct (bounds found) as [below above]. cbn [fst]. eapply Rle_trans; [apply H|].
  pose proof (sqrt_pos size) as SP. assert (SP' : 0 < sqrt size) by lra. apply Rmult_le_reg_r with (sqrt size); [exact SP'|]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l, Rmult_1_r by exact N.
  rewrite <- sqrt_mult_alt by (pose proof (Rle_0_sqr x) as Q1; pose proof (Rle_0_sqr y) as Q2; pose proof (Rle_0_sqr z) as Q3; unfold Rsqr in *; lra).
  set (t := qx * x + qy * y + qz * z). apply Rle_trans with t.
  - assert (T : t = (1 - u - v) * ((ax - px) * qx + (ay - py) * qy + (az - pz) * qz) + u * ((bx - px) * qx + (by_ - py) * qy + (bz - pz) * qz) + v * ((cx - px) * qx + (cy - py) * qy + (cz - pz) * qz))
      by (unfold t, x, y, z; ring). rewrite T.
    apply Rle_trans with ((1 - u - v) * pair_sum m + u * pair_sum m + v * pair_sum m); [right; ring|]. repeat apply Rplus_le_compat; apply Rmult_le_compat_l; lra.
  - apply Rle_trans with (Rabs t); [apply Rle_abs|]. rewrite <- sqrt_Rsqr_abs. apply sqrt_le_1_alt. unfold Rsqr, t, size.
    pose proof (Rle_0_sqr (qx * y - qy * x)) as Q1. pose proof (Rle_0_sqr (qy * z - qz * y)) as Q2. pose proof (Rle_0_sqr (qz * x - qx * z)) as Q3. unfold Rsqr in *. lra.
Qed.
