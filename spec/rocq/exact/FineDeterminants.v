(** Distances and weights by twice the digits: [FineDeterminants] of src/geom/kernel/exact/fine.rs. *)
Require Import Reals ZArith Lia Lra List.
From Flocq Require Import Core.
Require Import StacklessExact.Rounding StacklessExact.Range StacklessExact.Expansion StacklessExact.Fine StacklessExact.FineSums StacklessExact.FineProducts.
Require Import StacklessExact.FineQuotients.
Require StacklessExact.Intervals.
Open Scope R_scope.

Local Instance prec_53 : Prec_gt_0 53 := eq_refl.
Local Instance prec_24 : Prec_gt_0 24 := eq_refl.
(** Single precision. *)
Notation R24 := (round radix2 (FLT_exp (-149) 24) ZnearestE).

(** * The code *)

Record fines : Type := Fines { fine_x : fine; fine_y : fine; fine_z : fine }.

Definition minus (a b : fines) : fines := Fines (sub (fine_x a) (fine_x b)) (sub (fine_y a) (fine_y b)) (sub (fine_z a) (fine_z b)).
Definition dot (a b : fines) : fine := add (add (mul (fine_x a) (fine_x b)) (mul (fine_y a) (fine_y b))) (mul (fine_z a) (fine_z b)).
Definition cross (a b : fines) : fines :=
  Fines (sub (mul (fine_y a) (fine_z b)) (mul (fine_z a) (fine_y b))) (sub (mul (fine_z a) (fine_x b)) (mul (fine_x a) (fine_z b)))
    (sub (mul (fine_x a) (fine_y b)) (mul (fine_y a) (fine_x b))).

Record determinants : Type := Determinants { d_ : fines; s_ : fines; e1 : fines; e2 : fines; det : fine }.

(** [FineDeterminants::of]. *)
Definition of (v0 v1 v2 o d : fines) : determinants :=
  let a := minus v1 v0 in
  let b := minus v2 v0 in
  Determinants d (minus o v0) a b (dot a (cross d b)).

(** What the distance and the weights are over [det]. *)
Definition t_top (x : determinants) : fine := dot (e2 x) (cross (s_ x) (e1 x)).
Definition u_top (x : determinants) : fine := dot (s_ x) (cross (d_ x) (e2 x)).
Definition v_top (x : determinants) : fine := dot (d_ x) (cross (s_ x) (e1 x)).

(** [Real::between] of src/geom/vector.rs, for doubles and floats. *)
Definition between (ends : (R * R) * (R * R)) : option R :=
  let '((lo, _), (hi, _)) := ends in if Req_bool lo hi then Some lo else None.
Definition between_single (ends : (R * R) * (R * R)) : option R :=
  let '((lo, below), (hi, above)) := ends in
  let lo := R24 (if Rlt_bool below 0 then Intervals.pred lo else lo) in
  let hi := R24 (if Rlt_bool 0 above then Intervals.succ hi else hi) in
  if Req_bool lo hi then Some lo else None.

(** [FineDeterminants::nearest], of numbers that [over] knows. *)
Definition nearest (over_ : R * fine) (between : (R * R) * (R * R) -> option R) : option R := if Rlt_bool 0 (fst over_) then between (bounds (snd over_)) else None.

(** * What they stand for *)

Definition stand (v : fines) (x y z : R) : Prop := stands (fine_x v) x /\ stands (fine_y v) y /\ stands (fine_z v) z.

Lemma minus_stands a b x y z x' y' z' : stand a x y z -> stand b x' y' z' -> stand (minus a b) (x - x') (y - y') (z - z').
Proof. intros (A & B & C) (A' & B' & C'). split; [|split]; now apply sub_stands. Qed.
Lemma dot_stands a b x y z x' y' z' : stand a x y z -> stand b x' y' z' -> stands (dot a b) (x * x' + y * y' + z * z').
Proof. intros (A & B & C) (A' & B' & C'). apply add_stands; [apply add_stands|]; now apply mul_stands. Qed.
Lemma cross_stands a b x y z x' y' z' : stand a x y z -> stand b x' y' z' -> stand (cross a b) (y * z' - z * y') (z * x' - x * z') (x * y' - y * x').
Proof. intros (A & B & C) (A' & B' & C'). split; [|split]; apply sub_stands; now apply mul_stands. Qed.

(** d . (e2 x e1), and the three that are over it. *)
Section Determinants.
Variables v0 v1 v2 o d : fines.
Variables ax ay az bx by_ bz cx cy cz ox oy oz dx dy dz : R.
Hypothesis V0 : stand v0 ax ay az.
Hypothesis V1 : stand v1 bx by_ bz.
Hypothesis V2 : stand v2 cx cy cz.
Hypothesis O : stand o ox oy oz.
Hypothesis D : stand d dx dy dz.

(** By the rule of Cramer, for a + u (b - a) + v (c - a) = o + t d. *)
Definition true_det : R :=
  (bx - ax) * (dy * (cz - az) - dz * (cy - ay)) + (by_ - ay) * (dz * (cx - ax) - dx * (cz - az)) + (bz - az) * (dx * (cy - ay) - dy * (cx - ax)).
Definition true_t : R :=
  (cx - ax) * ((oy - ay) * (bz - az) - (oz - az) * (by_ - ay)) + (cy - ay) * ((oz - az) * (bx - ax) - (ox - ax) * (bz - az)) +
  (cz - az) * ((ox - ax) * (by_ - ay) - (oy - ay) * (bx - ax)).
Definition true_u : R :=
  (ox - ax) * (dy * (cz - az) - dz * (cy - ay)) + (oy - ay) * (dz * (cx - ax) - dx * (cz - az)) + (oz - az) * (dx * (cy - ay) - dy * (cx - ax)).
Definition true_v : R :=
  dx * ((oy - ay) * (bz - az) - (oz - az) * (by_ - ay)) + dy * ((oz - az) * (bx - ax) - (ox - ax) * (bz - az)) +
  dz * ((ox - ax) * (by_ - ay) - (oy - ay) * (bx - ax)).

Theorem determinants_stand : let x := of v0 v1 v2 o d in
  stands (det x) true_det /\ stands (t_top x) true_t /\ stands (u_top x) true_u /\ stands (v_top x) true_v.
Proof.
  pose proof (minus_stands _ _ _ _ _ _ _ _ V1 V0) as A. pose proof (minus_stands _ _ _ _ _ _ _ _ V2 V0) as B. pose proof (minus_stands _ _ _ _ _ _ _ _ O V0) as S.
  pose proof (cross_stands _ _ _ _ _ _ _ _ D B) as P. pose proof (cross_stands _ _ _ _ _ _ _ _ S A) as Q.
  cbv zeta. unfold of, t_top, u_top, v_top. cbn [d_ s_ e1 e2 det].
  split; [exact (dot_stands _ _ _ _ _ _ _ _ A P)|split; [exact (dot_stands _ _ _ _ _ _ _ _ B Q)|split; [exact (dot_stands _ _ _ _ _ _ _ _ S P)|exact (dot_stands _ _ _ _ _ _ _ _ D Q)]]].
Qed.

(** They are those of EXACT-1: what is found is where the line meets the plane. *)
Theorem cramer u v t : ax + u * (bx - ax) + v * (cx - ax) = ox + t * dx -> ay + u * (by_ - ay) + v * (cy - ay) = oy + t * dy ->
  az + u * (bz - az) + v * (cz - az) = oz + t * dz -> t * true_det = true_t /\ u * true_det = true_u /\ v * true_det = true_v.
Proof.
  intros X Y Z. assert (Ex : ox - ax = u * (bx - ax) + v * (cx - ax) - t * dx) by lra. assert (Ey : oy - ay = u * (by_ - ay) + v * (cy - ay) - t * dy) by lra.
  assert (Ez : oz - az = u * (bz - az) + v * (cz - az) - t * dz) by lra. unfold true_det, true_t, true_u, true_v. rewrite Ex, Ey, Ez. repeat split; ring.
Qed.
End Determinants.

(** * One float *)

Lemma ends_are x : proper x -> let '((lo, below), (hi, above)) := bounds x in
  lo = R64 (lo + below) /\ hi = R64 (hi + above).
Proof.
  destruct x as [h l r]. intros (Fh & Fl & Fr & P & H). unfold bounds. cbn [high low radius] in *.
  destruct (Intervals.plus_holds (l, l) (- r, r) l 0) as [[F1 F2] _]; [split; exact Fl|split; [now apply F_opp|exact Fr]|split; cbn; lra|split; cbn; lra|].
  rewrite !two_sum_is by assumption. split; f_equal; ring.
Qed.

(** If both ends round to one double, that is the true one, rounded. [EXACT-10] *)
Theorem between_is_right x r t : stands x r -> between (bounds x) = Some t -> t = R64 r.
Proof.
  intros X B. pose proof (bounds_hold x r X) as H. pose proof (ends_are x (proj1 X)) as E. unfold between, pair_sum in *. destruct (bounds x) as [[lo below] [hi above]]. cbn [fst snd] in *.
  revert B. destruct (Req_bool_spec lo hi) as [<-|]; [intros [= <-]|discriminate]. destruct E as [E1 E2]. apply Rle_antisym.
  - rewrite E1. now apply R64_le.
  - rewrite E2. now apply R64_le.
Qed.

(** The same of floats: an end is moved first, so as not to be rounded twice. [EXACT-10] *)
Theorem between_single_is_right x r t : stands x r -> between_single (bounds x) = Some t -> t = R24 r.
Proof.
  intros X B. pose proof (bounds_hold x r X) as H. pose proof (ends_are x (proj1 X)) as E. unfold between_single, pair_sum in *. destruct (bounds x) as [[lo below] [hi above]]. cbn [fst snd] in *.
  destruct E as [E1 E2]. assert (L : (if Rlt_bool below 0 then Intervals.pred lo else lo) <= r).
  { destruct (Rlt_bool_spec below 0); [|lra]. apply Rle_trans with (lo + below); [|lra]. rewrite E1 at 1. apply Intervals.moved_below. }
  assert (G : r <= (if Rlt_bool 0 above then Intervals.succ hi else hi)).
  { destruct (Rlt_bool_spec 0 above); [|lra]. apply Rle_trans with (hi + above); [lra|]. rewrite E2 at 2. apply Intervals.moved_above. }
  assert (Mono : forall a b, a <= b -> R24 a <= R24 b) by (intros; apply round_le; [typeclasses eauto..|assumption]).
  apply Mono in L, G. revert B. set (a := R24 (if Rlt_bool below 0 then _ else _)) in *. set (b := R24 (if Rlt_bool 0 above then _ else _)) in *.
  destruct (Req_bool_spec a b) as [E|]; [intros [= <-]|discriminate]. lra.
Qed.

(** Then the divisor is not 0. [EXACT-10] *)
Theorem nearest_is_right top divisor r d t : stands top r -> stands divisor d -> nearest (over top divisor) between = Some t -> d <> 0 /\ t = R64 (r / d).
Proof.
  intros T D. unfold nearest. destruct (Rlt_bool_spec 0 (fst (over top divisor))) as [P|]; [|discriminate]. destruct (over_stands _ _ _ _ T D P) as [N S].
  intros B. split; [exact N|]. now apply (between_is_right _ _ _ S).
Qed.
Theorem nearest_single_is_right top divisor r d t : stands top r -> stands divisor d -> nearest (over top divisor) between_single = Some t -> d <> 0 /\ t = R24 (r / d).
Proof.
  intros T D. unfold nearest. destruct (Rlt_bool_spec 0 (fst (over top divisor))) as [P|]; [|discriminate]. destruct (over_stands _ _ _ _ T D P) as [N S].
  intros B. split; [exact N|]. now apply (between_single_is_right _ _ _ S).
Qed.
