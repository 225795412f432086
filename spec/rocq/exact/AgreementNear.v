(** [bounds] and [nearest] of src/geom/nearest.rs, as they are in the source, are what NearDistance.v and NearGuess.v have, in rounded
    real numbers; so what the code computes holds the distance. *)
Require Import Reals ZArith Lia Lra Bool.
From Flocq Require Import Core.
Require Import StacklessExact.Rounding StacklessExact.Filter StacklessExact.Range StacklessExact.Arithmetic StacklessExact.Operations
  StacklessExact.NearDistance StacklessExact.NearGuess.
Open Scope R_scope.

Local Instance prec_53 : Prec_gt_0 53 := eq_refl.
Notation real := (reals R64).

Lemma zero_is : constant real 0 0 = 0.
Proof. cbn. ring. Qed.

(** The code decides for each component, and the guess once. *)
Lemma decide (test : bool) (found rest : option vec) (p : R * R * R) (a b c x y z : R) q :
  (found = Some q -> (a, b, c) = p) -> (rest = Some q -> (x, y, z) = p) ->
  (if test then found else rest) = Some q -> (if test then a else x, if test then b else y, if test then c else z) = p.
Proof. now destruct test. Qed.
Lemma found v q a b c : (a, b, c) = (vx v, vy v, vz v) -> Some v = Some q -> (a, b, c) = (vx q, vy q, vz q).
Proof. intros H E. now injection E as <-. Qed.

(** [nearest], where it finds a guess. [NEAR-1] *)
Theorem nearest_agrees a b c q : guess a b c = Some q ->
  nearest_nearest real (vx a) (vy a) (vz a) (vx b) (vy b) (vz b) (vx c) (vy c) (vz c) = (vx q, vy q, vz q).
Proof.
  unfold nearest_nearest, guess. rewrite zero_is.
  cbv [reals num plus minus times Arithmetic.over opposite less at_most not_a_number dot vsub vadd scaled vx vy vz].
  (* Terms stay small: what they are made of does not matter. *)
  repeat match goal with |- context [- ?r] => generalize (- r); intro end.
  repeat match goal with |- context [R64 (R64 (?r * ?s) - R64 (?t * ?w))] => generalize (R64 (R64 (r * s) - R64 (t * w))); intro end.
  do 6 (apply decide; [unfold on_edge, over; try (destruct Req_bool; [discriminate|]); now apply found|]).
  apply decide; [discriminate|]. now apply found.
Qed.

(** The greatest of two numbers as the code has it, and of the components of three corners. *)
Definition larger (x y : R) : R := if Rlt_bool y x then x else y.
Definition most (x : vec) : R := larger (larger (Rabs (vx x)) (Rabs (vy x))) (Rabs (vz x)).
Definition greatest (a b c : vec) : R := larger (larger (most a) (most b)) (most c).

Lemma larger_is x y : larger x y = Rmax x y.
Proof. unfold larger, Rmax. destruct (Rlt_bool_spec y x), (Rle_dec x y); lra. Qed.
Lemma smaller_is x y : (if Rlt_bool x y then x else y) = Rmin x y.
Proof. unfold Rmin. destruct (Rlt_bool_spec x y), (Rle_dec x y); lra. Qed.

Lemma most_bounds x M : most x <= M -> bounded M x.
Proof.
  unfold most. rewrite !larger_is. intros H. pose proof (Rmax_l (Rabs (vx x)) (Rabs (vy x))). pose proof (Rmax_r (Rabs (vx x)) (Rabs (vy x))).
  pose proof (Rmax_l (Rmax (Rabs (vx x)) (Rabs (vy x))) (Rabs (vz x))). pose proof (Rmax_r (Rmax (Rabs (vx x)) (Rabs (vy x))) (Rabs (vz x))).
  repeat split; lra.
Qed.
Lemma greatest_bounds a b c : bounded (greatest a b c) a /\ bounded (greatest a b c) b /\ bounded (greatest a b c) c.
Proof.
  unfold greatest. rewrite !larger_is. repeat split; apply most_bounds.
  all: pose proof (Rmax_l (most a) (most b)); pose proof (Rmax_r (most a) (most b)).
  all: pose proof (Rmax_l (Rmax (most a) (most b)) (most c)); pose proof (Rmax_r (Rmax (most a) (most b)) (most c)); lra.
Qed.

(** Constants. *)
Lemma F_float m e : (Z.abs m < 2 ^ 53)%Z -> (-1074 <= e)%Z -> F (IZR m * bpow radix2 e).
Proof. intros M E. apply generic_format_FLT. exists (Float radix2 m e); [reflexivity|exact M|exact E]. Qed.
Lemma unit_is : nearest_UNIT real = u.
Proof.
  cbn -[bpow]. change (bpow radix2 0) with 1. replace (1 * 1 / (9007199254740992 * 1)) with (1 * bpow radix2 (-53)) by (change (bpow radix2 (-53)) with (/ 9007199254740992); field).
  rewrite R64_F by (apply F_float; lia). ring.
Qed.
Lemma margin_is_64 : nearest_MARGIN real = 64 * u.
Proof.
  unfold nearest_MARGIN. rewrite unit_is. change (R64 (1 * bpow radix2 6 * u) = 64 * u). change (bpow radix2 6) with 64. replace (1 * 64 * u) with (64 * u) by ring.
  apply R64_F, (F_float 64 (-53)); lia.
Qed.
Lemma eight_is : R64 (1 * bpow radix2 3 * u) = 8 * u.
Proof. change (bpow radix2 3) with 8. replace (1 * 8 * u) with (8 * u) by ring. apply R64_F, (F_float 8 (-53)); lia. Qed.
Lemma less_is : R64 (1 * bpow radix2 0 - 8 * u) = 1 - 8 * u.
Proof.
  change (bpow radix2 0) with 1. replace (1 * 1 - 8 * u) with (1 - 8 * u) by ring. apply R64_F.
  replace (1 - 8 * u) with (1125899906842623 * bpow radix2 (-50)); [apply F_float; lia|].
  change (bpow radix2 (-50)) with (/ 1125899906842624). rewrite u_is. lra.
Qed.
Lemma more_is : R64 (1 * bpow radix2 0 + 8 * u) = 1 + 8 * u.
Proof.
  change (bpow radix2 0) with 1. replace (1 * 1 + 8 * u) with (1 + 8 * u) by ring. apply R64_F.
  replace (1 + 8 * u) with (1125899906842625 * bpow radix2 (-50)); [apply F_float; lia|].
  change (bpow radix2 (-50)) with (/ 1125899906842624). rewrite u_is. lra.
Qed.

(** [bounds], where there is a guess and the greatest component is usual. [NEAR-1] *)
Theorem bounds_agree a b c q : guess a b c = Some q -> bpow radix2 (-200) <= greatest a b c <= bpow radix2 200 ->
  nearest_bounds real (vx a) (vy a) (vz a) (vx b) (vy b) (vz b) (vx c) (vy c) (vz c) = (near q a b c (greatest a b c), far q (greatest a b c)).
Proof.
  intros G [L H]. unfold nearest_bounds. rewrite (nearest_agrees a b c q G). rewrite margin_is_64, unit_is, zero_is.
  unfold near, far, least, length, margin, short. rewrite <- !smaller_is.
  cbv [reals num plus minus times Arithmetic.over root absolute less at_most not_a_number constant]. cbv zeta.
  fold (larger (Rabs (vx a)) (Rabs (vy a))) (larger (Rabs (vx b)) (Rabs (vy b))) (larger (Rabs (vx c)) (Rabs (vy c))).
  fold (larger (larger (Rabs (vx a)) (Rabs (vy a))) (Rabs (vz a))) (larger (larger (Rabs (vx b)) (Rabs (vy b))) (Rabs (vz b)))
    (larger (larger (Rabs (vx c)) (Rabs (vy c))) (Rabs (vz c))).
  fold (most a) (most b) (most c). fold (larger (most a) (most b)). fold (larger (larger (most a) (most b)) (most c)). fold (greatest a b c).
  rewrite eight_is, less_is, more_is, !Rmult_1_l, (Rle_bool_true _ _ L), (Rle_bool_true _ _ H). cbn [andb negb].
  fold (dot R64 q q) (dot R64 q a) (dot R64 q b) (dot R64 q c).
  match goal with |- context [Rmax ?x 0] => rewrite <- (larger_is x 0); unfold larger at 1 end. reflexivity.
Qed.

(** So what the code computes holds the distance, for corners and a point that are doubles. [NEAR-1] *)
Theorem code_bounds_hold a b c p q d : floats a -> floats b -> floats c -> floats p ->
  let a' := vsub R64 a p in let b' := vsub R64 b p in let c' := vsub R64 c p in
  guess a' b' c' = Some q -> bpow radix2 (-200) <= greatest a' b' c' <= bpow radix2 200 -> is_distance a b c p d ->
  let '(low, high) := nearest_bounds real (vx a') (vy a') (vz a') (vx b') (vy b') (vz b') (vx c') (vy c') (vz c') in low <= d <= high.
Proof.
  intros FA FB FC FP a' b' c' G M D. rewrite (bounds_agree a' b' c' q G M). destruct (greatest_bounds a' b' c') as (BA & BB & BC).
  destruct (bounds_hold a b c p _ d FA FB FC FP BA BB BC (proj1 M) D) as [Low High]. split; [apply Low|exact (High q G)].
Qed.
