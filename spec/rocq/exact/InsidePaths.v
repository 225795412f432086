(** Where a point is: CLOSED-2, for [Solid::locate] of src/trace/solid.rs. *)
Require Import Reals ZArith Lia Lra List Bool.
From Flocq Require Import Core.
Require Import StacklessExact.Filter StacklessExact.Parity StacklessExact.Chains StacklessExact.Fans StacklessExact.Inside StacklessExact.InsideRays.
Import ListNotations.
Open Scope R_scope.

(** Whether a point is inside, from one ray: by parity, and by the nonzero rule. *)
Definition is_odd (o d : vec) (l : list triangle) : bool := Z.odd (count o d l).
Definition is_nonzero (o d : vec) (l : list triangle) : bool := negb (winding o d l =? 0)%Z.

Lemma sense_is_not_0 o d t : is_crossing o d t = true -> sense d t = 1%Z \/ sense d t = (-1)%Z.
Proof.
  destruct t as [[a b] c]. unfold is_crossing. cbv zeta. rewrite det_is. destruct (Req_bool_spec (- dot3 d (normal (a, b, c))) 0) as [|N]; [discriminate|]. intros _.
  unfold sense. destruct (sign_cases (dot3 d (normal (a, b, c)))) as [(_ & ->)|[(E & _)|(_ & ->)]]; auto. exfalso. lra.
Qed.

Lemma count_is_winding o d l : (2 | count o d l - winding o d l)%Z.
Proof.
  unfold count, winding, Z.sub. rewrite <- sum_opp, <- sum_plus. apply sum_divides. intros t _. unfold crossing. destruct (is_crossing o d t) eqn:C; [|now exists 0%Z].
  destruct (sense_is_not_0 _ _ _ C) as [-> | ->]; [now exists 0%Z|now exists 1%Z].
Qed.

(** In a closed mesh the count is odd for all rays from a point off the surface, or for none. [CLOSED-2](3) *)
Theorem parity_agrees l o d d' : balanced 2 (edges l) -> (forall t, In t l -> ~ contains t o) -> d <> zero -> d' <> zero -> is_odd o d l = is_odd o d' l.
Proof.
  intros B Off X X'. pose proof (rays_agree 2 l o d d' B Off X X') as R. unfold is_odd.
  assert (D : (2 | count o d l - count o d' l)%Z).
  { replace (_ - _)%Z with (count o d l - winding o d l - (count o d' l - winding o d' l) + (winding o d l - winding o d' l))%Z by ring.
    apply Z.divide_add_r; [apply Z.divide_sub_r; apply count_is_winding|exact R]. }
  destruct D as (k & D). replace (count o d l) with (count o d' l + 2 * k)%Z by lia. now rewrite Z.odd_add_mul_2.
Qed.

(** In an oriented mesh the sum is the same number. [CLOSED-2](3) *)
Theorem nonzero_agrees l o d d' : balanced 0 (edges l) -> (forall t, In t l -> ~ contains t o) -> d <> zero -> d' <> zero -> winding o d l = winding o d' l.
Proof. intros B Off X X'. pose proof (rays_agree 0 l o d d' B Off X X') as R. apply Z.divide_0_l in R. lia. Qed.

(** * Outside *)

Definition corners (t : triangle) : list vec := let '(a, b, c) := t in [a; b; c].

(** All corners are on one side of a plane through the point: as where the point is outside of the bounds. *)
Definition beyond (o w : vec) (l : list triangle) : Prop := forall t, In t l -> forall p, In p (corners t) -> dot3 w (less p o) < 0.

Lemma mean_is_below u v x y z : 0 <= u -> 0 <= v -> 0 <= 1 - u - v -> x < 0 -> y < 0 -> z < 0 -> (1 - u - v) * x + u * y + v * z < 0.
Proof.
  intros U V W X Y Z. set (m := Rmax x (Rmax y z)). assert (M : m < 0) by (unfold m; repeat apply Rmax_lub_lt; assumption).
  assert (x <= m) by apply Rmax_l. assert (y <= m) by (apply Rle_trans with (Rmax y z); [apply Rmax_l|apply Rmax_r]).
  assert (z <= m) by (apply Rle_trans with (Rmax y z); [apply Rmax_r|apply Rmax_r]).
  apply Rle_lt_trans with ((1 - u - v) * m + u * m + v * m); [repeat apply Rplus_le_compat; apply Rmult_le_compat_l; assumption|]. replace (_ + _) with m by ring. exact M.
Qed.

Lemma beyond_is_off o w l : beyond o w l -> forall t, In t l -> ~ contains t o.
Proof.
  intros H [[a b] c] I (_ & u & v & U & V & W & E). assert (K : forall p, In p [a; b; c] -> dot3 w (less p o) < 0) by (apply (H _ I)).
  pose proof (mean_is_below u v _ _ _ U V W (K a (or_introl eq_refl)) (K b (or_intror (or_introl eq_refl))) (K c (or_intror (or_intror (or_introl eq_refl))))) as M.
  replace (_ + _) with (dot3 w (less (more a (more (scale u (less b a)) (scale v (less c a)))) o)) in M by (vectors; ring). rewrite <- E in M.
  replace (dot3 w (less o o)) with 0 in M by (vectors; ring). lra.
Qed.

Lemma beyond_is_missed o w t l : beyond o w l -> In t l -> is_crossing o w t = false.
Proof.
  intros H I. destruct (is_crossing o w t) eqn:C; [exfalso|reflexivity]. destruct t as [[a b] c]. unfold is_crossing in C. cbv zeta in C. rewrite !andb_true_iff, negb_true_iff, !Z.eqb_eq in C.
  destruct C as (((N & E1) & E2) & T). destruct (Req_bool_spec (det (determinants_of exactly a b c o w)) 0) as [|D]; [discriminate|].
  destruct (crossed_is_met o w a b c) as (_ & U & V & W); [now split|]. set (x := determinants_of exactly a b c o w) in *.
  destruct (Rle_bool_spec 0 (top_t x / det x)) as [T'|]; [|discriminate].
  assert (K : forall p, In p [a; b; c] -> dot3 w (less p o) < 0) by (apply (H _ I)).
  assert (W' : 0 <= 1 - edge_u x / det x - edge_v x / det x).
  { replace (1 - edge_u x / det x - edge_v x / det x) with (edge_w x / det x); [exact W|]. change (edge_w x) with (det x - edge_u x - edge_v x). field. exact D. }
  pose proof (mean_is_below _ _ _ _ _ U V W' (K a (or_introl eq_refl)) (K b (or_intror (or_introl eq_refl))) (K c (or_intror (or_intror (or_introl eq_refl))))) as M.
  assert (Q : det x * dot3 w (less a o) + edge_u x * dot3 w (less b a) + edge_v x * dot3 w (less c a) = top_t x * dot3 w w) by (unfold x; exact_values; ring).
  replace (_ + _) with ((det x * dot3 w (less a o) + edge_u x * dot3 w (less b a) + edge_v x * dot3 w (less c a)) / det x) in M.
  2: { replace (dot3 w (less b a)) with (dot3 w (less b o) - dot3 w (less a o)) by (vectors; ring). replace (dot3 w (less c a)) with (dot3 w (less c o) - dot3 w (less a o)) by (vectors; ring). field. exact D. }
  rewrite Q in M. assert (0 <= top_t x / det x * dot3 w w).
  { apply Rmult_le_pos; [exact T'|]. unfold dot3. pose proof (Rle_0_sqr (vx w)). pose proof (Rle_0_sqr (vy w)). pose proof (Rle_0_sqr (vz w)). unfold Rsqr in *. lra. }
  replace (top_t x * dot3 w w / det x) with (top_t x / det x * dot3 w w) in M by (field; exact D). lra.
Qed.

(** Outside of the bounds no ray needs to be traced: every ray has an even count, and in an oriented mesh the sum 0. [CLOSED-2](5) *)
Theorem outside_is_outside k l o d w : balanced k (edges l) -> beyond o w l -> w <> zero -> d <> zero -> (k | winding o d l)%Z.
Proof.
  intros B H W X. pose proof (rays_agree k l o d w B (beyond_is_off o w l H) X W) as R. replace (winding o w l) with 0%Z in R; [now rewrite Z.sub_0_r in R|].
  unfold winding. symmetry. clear R B. assert (S : forall t, In t l -> crossing o w t = 0%Z) by (intros t I; unfold crossing; now rewrite (beyond_is_missed o w t l H I)).
  induction l as [|t l IH]; [reflexivity|]. cbn. rewrite S, IH by (now left || (intros s I; (apply H || apply S); now right)). reflexivity.
Qed.

(** * Paths *)

(** The crossings of the ray before its end at o + d. *)
Definition is_before (o d : vec) (t : triangle) : bool := let '(a, b, c) := t in let x := determinants_of exactly a b c o d in is_crossing o d t && negb (Rle_bool 1 (top_t x / det x)).

Lemma next_crossing o d t : crossing o d t = (crossing (more o d) d t + if is_before o d t then sense d t else 0)%Z.
Proof.
  destruct t as [[a b] c]. unfold crossing, is_before, is_crossing. cbv zeta. set (x := determinants_of exactly a b c o d). set (y := determinants_of exactly a b c (more o d) d).
  assert (D : det y = det x /\ top_t y = top_t x - det x) by (unfold x, y; exact_values; split; ring). destruct D as (-> & ->).
  assert (E : forall p q, edge_sign (more o d) d p q = edge_sign o d p q) by (intros; unfold edge_sign; f_equal; f_equal; unfold F; vectors; ring). rewrite !E.
  destruct (Req_bool_spec (det x) 0) as [|N]; [reflexivity|]. destruct (_ =? _)%Z; [|reflexivity]. destruct (_ =? _)%Z; [|reflexivity]. cbn [negb andb].
  replace ((top_t x - det x) / det x) with (top_t x / det x - 1) by (field; exact N).
  destruct (Rle_bool_spec 0 (top_t x / det x)), (Rle_bool_spec 0 (top_t x / det x - 1)), (Rle_bool_spec 1 (top_t x / det x)); try (exfalso; lra); cbn; ring.
Qed.

(** Along a path the number changes by the crossings of the path, each with its sense. [CLOSED-2](4) *)
Theorem path_counts o d l : winding o d l = (winding (more o d) d l + sum (fun t => if is_before o d t then sense d t else 0) l)%Z.
Proof. unfold winding. rewrite <- sum_plus. apply sum_ext. intros t _. apply next_crossing. Qed.

(** So in a closed mesh, by any rays from two points off the surface: their numbers differ by the crossings of the path between them. [CLOSED-2](4) *)
Theorem path_differs k l o d d1 d2 : balanced k (edges l) -> d <> zero -> d1 <> zero -> d2 <> zero ->
  (forall t, In t l -> ~ contains t o) -> (forall t, In t l -> ~ contains t (more o d)) ->
  (k | winding o d1 l - winding (more o d) d2 l - sum (fun t => if is_before o d t then sense d t else 0) l)%Z.
Proof.
  intros B X X1 X2 O0 O1. pose proof (path_counts o d l) as P. pose proof (rays_agree k l o d1 d B O0 X1 X) as R. pose proof (rays_agree k l (more o d) d d2 B O1 X X2) as R'.
  replace (_ - _)%Z with (winding o d1 l - winding o d l + (winding (more o d) d l - winding (more o d) d2 l))%Z by lia. now apply Z.divide_add_r.
Qed.

(** If the path does not meet the surface, none. [CLOSED-2](4) *)
Theorem path_keeps k l o d d1 d2 : balanced k (edges l) -> d <> zero -> d1 <> zero -> d2 <> zero ->
  (forall t, In t l -> forall s, 0 <= s <= 1 -> ~ contains t (more o (scale s d))) -> (k | winding o d1 l - winding (more o d) d2 l)%Z.
Proof.
  intros B X X1 X2 Off. assert (E0 : more o (scale 0 d) = o) by (destruct o; vectors; f_equal; ring). assert (E1 : more o (scale 1 d) = more o d) by (vectors; f_equal; ring).
  assert (O0 : forall t, In t l -> ~ contains t o) by (intros t I; rewrite <- E0; apply Off; [exact I|lra]).
  assert (O1 : forall t, In t l -> ~ contains t (more o d)) by (intros t I; rewrite <- E1; apply Off; [exact I|lra]).
  refine (proj1 (divides_differ k _ _ _) (path_differs k l o d d1 d2 B X X1 X2 O0 O1)).
  replace (_ - _)%Z with (- sum (fun t => if is_before o d t then sense d t else 0) l)%Z by ring. apply Z.divide_opp_r, sum_divides. intros t I.
  destruct (is_before o d t) eqn:C; [exfalso|apply Z.divide_0_r]. destruct t as [[a b] c]. unfold is_before, is_crossing in C. cbv zeta in C. rewrite !andb_true_iff, !negb_true_iff, !Z.eqb_eq in C.
  destruct C as ((((N & A1) & A2) & T0) & T1). set (x := determinants_of exactly a b c o d) in *. destruct (Req_bool_spec (det x) 0) as [|D]; [discriminate|].
  destruct (Rle_bool_spec 0 (top_t x / det x)) as [L|]; [|discriminate]. destruct (Rle_bool_spec 1 (top_t x / det x)) as [|L1]; [discriminate|].
  pose proof (crossed_is_met o d a b c) as M. fold x in M. assert (M' : meets x) by (apply M; split; [exact D|now split]). clear M.
  apply (Off (a, b, c) I (top_t x / det x)); [lra|]. apply (touching_is_inside _ d). cbn [touches]. set (s := top_t x / det x) in *.
  assert (P : det (determinants_of exactly a b c (more o (scale s d)) d) = det x /\ edge_u (determinants_of exactly a b c (more o (scale s d)) d) = edge_u x /\
    edge_v (determinants_of exactly a b c (more o (scale s d)) d) = edge_v x /\ top_t (determinants_of exactly a b c (more o (scale s d)) d) = top_t x - s * det x).
  { unfold x. clearbody s. exact_values. repeat split; ring. }
  destruct P as (Pd & Pu & Pv & Pt). set (y := determinants_of exactly a b c (more o (scale s d)) d) in *. assert (Pw : edge_w y = edge_w x) by (change (det y - edge_u y - edge_v y = det x - edge_u x - edge_v x); now rewrite Pd, Pu, Pv).
  split; [unfold meets in *; now rewrite Pd, Pu, Pv, Pw|]. rewrite Pt, Pd. unfold s. field. exact D.
Qed.
