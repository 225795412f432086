(** Signs of edge functions by twice the digits: [volume] of src/geom/kernel/exact/fine.rs. *)
Require Import Reals ZArith Lia Lra List.
From Flocq Require Import Core.
Require Import StacklessExact.Rounding StacklessExact.Range StacklessExact.Expansion StacklessExact.Fine StacklessExact.FineSums StacklessExact.FineProducts.
Open Scope R_scope.

Local Instance prec_53 : Prec_gt_0 53 := eq_refl.

(** * The code *)

(** A term, where a component of the direction is not 0. *)
Definition add_term (sum : fine) (d : R) (ai aj bi bj : fine) : fine :=
  if Req_bool d 0 then sum else add sum (mul (exact d) (sub (mul ai bj) (mul aj bi))).
Definition volume (dx dy dz : R) (a b : pairs) : option R :=
  let '(ax, ay, az) := a in
  let '(bx, by_, bz) := b in
  let '(ax, ay, az) := (of_two ax, of_two ay, of_two az) in
  let '(bx, by_, bz) := (of_two bx, of_two by_, of_two bz) in
  sign (add_term (add_term (add_term (exact 0) dx ay az by_ bz) dy az ax bz bx) dz ax ay bx by_).

(** [predicates::edge], as far as it goes: where it tells nothing, exact sums do. *)
Definition edge (dx dy dz ox oy oz fx fy fz tx ty tz : R) : option R :=
  volume dx dy dz (difference tx fx, difference ty fy, difference tz fz) (difference fx ox, difference fy oy, difference fz oz).

(** * It is right *)

Lemma term_stands sum d ai aj bi bj s ri rj ti tj : F d -> stands sum s -> stands ai ri -> stands aj rj -> stands bi ti -> stands bj tj ->
  stands (add_term sum d ai aj bi bj) (s + d * (ri * tj - rj * ti)).
Proof.
  intros D S A A' B B'. unfold add_term. destruct (Req_bool_spec d 0) as [->|_]; [now replace (s + 0 * _) with s by ring|].
  apply add_stands; [exact S|]. apply mul_stands; [now apply exact_stands|]. apply sub_stands; now apply mul_stands.
Qed.

Lemma difference_stands a b : F a -> F b -> stands (of_two (difference a b)) (a - b).
Proof. intros A B. apply of_two_stands; [exact A|now apply F_opp]. Qed.

(** What is told has the sign of d . ((p - q) x (r - o)): for all doubles, as far as nothing overflows. [EXACT-10] *)
Theorem volume_is_right dx dy dz px py pz qx qy qz rx ry rz ox oy oz s : Forall F (dx :: dy :: dz :: nil) -> Forall F (px :: py :: pz :: nil) ->
  Forall F (qx :: qy :: qz :: nil) -> Forall F (rx :: ry :: rz :: nil) -> Forall F (ox :: oy :: oz :: nil) ->
  volume dx dy dz (difference px qx, difference py qy, difference pz qz) (difference rx ox, difference ry oy, difference rz oz) = Some s ->
  let truth := dx * ((py - qy) * (rz - oz) - (pz - qz) * (ry - oy)) + dy * ((pz - qz) * (rx - ox) - (px - qx) * (rz - oz)) +
    dz * ((px - qx) * (ry - oy) - (py - qy) * (rx - ox)) in
  (0 < truth <-> 0 < s) /\ (truth < 0 <-> s < 0) /\ (truth = 0 <-> s = 0).
Proof.
  intros D P Q R O H truth. revert H. unfold volume. apply sign_is_right.
  assert (All : forall x y z, Forall F (x :: y :: z :: nil) -> F x /\ F y /\ F z).
  { intros x y z H. inversion_clear H as [|? ? X H']. inversion_clear H' as [|? ? Y H]. inversion_clear H. auto. }
  apply All in D, P, Q, R, O. destruct D as (D1 & D2 & D3), P as (P1 & P2 & P3), Q as (Q1 & Q2 & Q3), R as (R1 & R2 & R3), O as (O1 & O2 & O3).
  pose proof (difference_stands _ _ P1 Q1) as A1. pose proof (difference_stands _ _ P2 Q2) as A2. pose proof (difference_stands _ _ P3 Q3) as A3.
  pose proof (difference_stands _ _ R1 O1) as B1. pose proof (difference_stands _ _ R2 O2) as B2. pose proof (difference_stands _ _ R3 O3) as B3.
  pose proof (term_stands _ dx _ _ _ _ _ _ _ _ _ D1 (exact_stands 0 (generic_format_0 _ _)) A2 A3 B2 B3) as S1.
  pose proof (term_stands _ dy _ _ _ _ _ _ _ _ _ D2 S1 A3 A1 B3 B1) as S2. pose proof (term_stands _ dz _ _ _ _ _ _ _ _ _ D3 S2 A1 A2 B1 B2) as S3.
  unfold truth. rewrite Rplus_0_l in S3. exact S3.
Qed.

(** That of [edge] is the sign of d . ((to - o) x (from - o)), the edge function. [EXACT-2, EXACT-10] *)
Theorem edge_is_right dx dy dz ox oy oz fx fy fz tx ty tz s : Forall F (dx :: dy :: dz :: nil) -> Forall F (ox :: oy :: oz :: nil) ->
  Forall F (fx :: fy :: fz :: nil) -> Forall F (tx :: ty :: tz :: nil) -> edge dx dy dz ox oy oz fx fy fz tx ty tz = Some s ->
  let truth := dx * ((ty - oy) * (fz - oz) - (tz - oz) * (fy - oy)) + dy * ((tz - oz) * (fx - ox) - (tx - ox) * (fz - oz)) +
    dz * ((tx - ox) * (fy - oy) - (ty - oy) * (fx - ox)) in
  (0 < truth <-> 0 < s) /\ (truth < 0 <-> s < 0) /\ (truth = 0 <-> s = 0).
Proof.
  intros D O A B H truth. pose proof (volume_is_right dx dy dz tx ty tz fx fy fz fx fy fz ox oy oz s D B A A O H) as V. cbv zeta in V.
  match type of V with (0 < ?v <-> _) /\ _ => replace truth with v by (unfold truth; ring) end. exact V.
Qed.
