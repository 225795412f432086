(** Determinants from a near point of the line: [shortened] of src/geom/fine.rs, and [volume_from_near] and [weights] of
    src/geom/kernel/exact/fine.rs. *)
Require Import Reals ZArith Lra List.
From Flocq Require Import Core.
Require Import StacklessExact.Rounding StacklessExact.Range StacklessExact.Expansion StacklessExact.Fine StacklessExact.FineSums StacklessExact.FineProducts.
Require Import StacklessExact.FineSigns StacklessExact.FineDeterminants.
Require StacklessExact.Filter.
Open Scope R_scope.

Local Instance prec_53 : Prec_gt_0 53 := eq_refl.

(** * The code *)

Section Code.
(** A direction of doubles. *)
Variables dx dy dz : R.

(** The part of a vector along the direction, by its first digits: [dot] over [length_squared]. *)
Definition part (way : fines) : R :=
  R64 (R64 (R64 (R64 (high (fine_x way) * dx) + R64 (high (fine_y way) * dy)) + R64 (high (fine_z way) * dz)) /
    R64 (R64 (R64 (dx * dx) + R64 (dy * dy)) + R64 (dz * dz))).
Definition less (way : fines) (p : R) : fines :=
  Fines (sub (fine_x way) (mul (exact p) (exact dx))) (sub (fine_y way) (mul (exact p) (exact dy))) (sub (fine_z way) (mul (exact p) (exact dz))).
Definition step (found : fines * list R) : fines * list R := let p := part (fst found) in (less (fst found) p, snd found ++ p :: nil).
Definition shortened (way : fines) : fines * list R := step (step (step (way, nil))).

Definition of_pairs (a : pairs) : fines := let '(x, y, z) := a in Fines (of_two x) (of_two y) (of_two z).
Definition volume_from_near (a b : pairs) : option R :=
  sign (dot (Fines (exact dx) (exact dy) (exact dz)) (cross (of_pairs a) (fst (shortened (of_pairs b))))).
End Code.

(** * Any multiples of the direction *)

Section Near.
Variables dx dy dz : R.
Hypothesis D : Forall F (dx :: dy :: dz :: nil).

Let Dx : F dx. Proof. now inversion_clear D. Qed.
Let Dy : F dy. Proof. inversion_clear D as [|? ? _ H]. now inversion_clear H. Qed.
Let Dz : F dz. Proof. inversion_clear D as [|? ? _ H]. inversion_clear H as [|? ? _ H']. now inversion_clear H'. Qed.

(** Whatever double is taken: what remains is the vector less exactly that multiple. [EXACT-12] *)
Theorem less_stands way x y z p : F p -> stand way x y z -> stand (less dx dy dz way p) (x - p * dx) (y - p * dy) (z - p * dz).
Proof.
  intros P (X & Y & Z). split; [|split]; apply sub_stands; try assumption; apply mul_stands; now apply exact_stands.
Qed.

Lemma part_F way : F (part dx dy dz way).
Proof. apply generic_format_round; typeclasses eauto. Qed.

(** [shortened] represents the vector less exactly the sum of the three multiples. [EXACT-12](2) *)
Theorem shortened_stands way x y z : stand way x y z -> let found := shortened dx dy dz way in
  let m := fold_right Rplus 0 (snd found) in stand (fst found) (x - m * dx) (y - m * dy) (z - m * dz).
Proof.
  intros W. unfold shortened. set (s1 := step dx dy dz (way, nil)). set (s2 := step dx dy dz s1).
  pose proof (less_stands way x y z _ (part_F way) W) as W1. pose proof (less_stands _ _ _ _ _ (part_F (fst s1)) W1) as W2.
  pose proof (less_stands _ _ _ _ _ (part_F (fst s2)) W2) as W3. cbv zeta. cbn [step fst snd app fold_right s1 s2].
  set (p := part dx dy dz way) in *. change (less dx dy dz way p) with (fst s1). set (q := part dx dy dz (fst s1)) in *.
  change (less dx dy dz (fst s1) q) with (fst s2). set (r := part dx dy dz (fst s2)) in *.
  replace (x - (p + (q + (r + 0))) * dx) with (x - p * dx - q * dx - r * dx) by ring.
  replace (y - (p + (q + (r + 0))) * dy) with (y - p * dy - q * dy - r * dy) by ring.
  replace (z - (p + (q + (r + 0))) * dz) with (z - p * dz - q * dz - r * dz) by ring. exact W3.
Qed.

(** A sign that is decided from a near point is that of the edge function. [EXACT-12](2) *)
Theorem near_volume_is_right px py pz qx qy qz rx ry rz ox oy oz s : Forall F (px :: py :: pz :: nil) ->
  Forall F (qx :: qy :: qz :: nil) -> Forall F (rx :: ry :: rz :: nil) -> Forall F (ox :: oy :: oz :: nil) ->
  volume_from_near dx dy dz (difference px qx, difference py qy, difference pz qz) (difference rx ox, difference ry oy, difference rz oz) = Some s ->
  let truth := dx * ((py - qy) * (rz - oz) - (pz - qz) * (ry - oy)) + dy * ((pz - qz) * (rx - ox) - (px - qx) * (rz - oz)) +
    dz * ((px - qx) * (ry - oy) - (py - qy) * (rx - ox)) in
  (0 < truth <-> 0 < s) /\ (truth < 0 <-> s < 0) /\ (truth = 0 <-> s = 0).
Proof.
  intros P Q R O H truth. revert H. unfold volume_from_near. apply sign_is_right.
  assert (All : forall x y z, Forall F (x :: y :: z :: nil) -> F x /\ F y /\ F z).
  { intros x y z H. inversion_clear H as [|? ? X H']. inversion_clear H' as [|? ? Y H]. inversion_clear H. auto. }
  apply All in P, Q, R, O. destruct P as (P1 & P2 & P3), Q as (Q1 & Q2 & Q3), R as (R1 & R2 & R3), O as (O1 & O2 & O3).
  assert (A : stand (of_pairs (difference px qx, difference py qy, difference pz qz)) (px - qx) (py - qy) (pz - qz))
    by (split; [|split]; now apply difference_stands).
  assert (B : stand (of_pairs (difference rx ox, difference ry oy, difference rz oz)) (rx - ox) (ry - oy) (rz - oz))
    by (split; [|split]; now apply difference_stands).
  pose proof (shortened_stands _ _ _ _ B) as N. cbv zeta in N. set (m := fold_right Rplus 0 _) in N.
  assert (E : stand (Fines (exact dx) (exact dy) (exact dz)) dx dy dz) by (split; [|split]; now apply exact_stands).
  pose proof (dot_stands _ _ _ _ _ _ _ _ E (cross_stands _ _ _ _ _ _ _ _ A N)) as T.
  match type of T with stands _ ?t => replace truth with t by (unfold truth; ring) end. exact T.
Qed.

End Near.

(** * Any point of the line *)

Import Filter.

(** U, V, W and det are the same from every point of the line, and the distance from there is less by its own distance. [EXACT-12](1) *)
Theorem any_point_serves v0 v1 v2 o d x : let moved := Vec (vx o + x * vx d) (vy o + x * vy d) (vz o + x * vz d) in
  let a := determinants_of exactly v0 v1 v2 o d in let b := determinants_of exactly v0 v1 v2 moved d in
  Filter.det b = Filter.det a /\ edge_u b = edge_u a /\ edge_v b = edge_v a /\ edge_w b = edge_w a /\
  (Filter.det a <> 0 -> top_t b / Filter.det b = top_t a / Filter.det a - x).
Proof.
  intros moved a b. assert (U : edge_u b = edge_u a) by (unfold a, b, exactly; simpl; unfold Filter.dot; simpl; ring).
  assert (V : edge_v b = edge_v a) by (unfold a, b, exactly; simpl; unfold Filter.dot; simpl; ring).
  split; [reflexivity|]. split; [exact U|]. split; [exact V|]. split.
  - change (edge_w b) with (Filter.det b - edge_u b - edge_v b). rewrite U, V. reflexivity.
  - intros N. change (Filter.det b) with (Filter.det a). assert (T : top_t b = top_t a - x * Filter.det a) by (unfold a, b, exactly; simpl; unfold Filter.dot; simpl; ring).
    rewrite T. field. exact N.
Qed.
