(** The bounds of a triangle's distance of src/geom/nearest.rs (NEAR-1), as they are computed: in double precision with gradual underflow,
    and without a greatest exponent. Whatever the guess is, all of the triangle is at least as far away as the lower one. The upper one is in
    NearGuess.v. *)
Require Import Reals ZArith Lia Lra Psatz.
From Flocq Require Import Core Relative.
Require Import StacklessExact.Rounding StacklessExact.Filter StacklessExact.Range.
Require StacklessExact.Nearest.
Open Scope R_scope.

Local Instance prec_53 : Prec_gt_0 53 := eq_refl.
Notation fexp := (FLT_exp (-1074) 53).
Notation F := (generic_format radix2 fexp).

(** * In real numbers *)

Definition square (x : vec) : R := dot exactly x x.
Definition norm (x : vec) : R := sqrt (square x).

(** The point of a triangle with these weights of its second and third corner, which are [Nearest.inside]. *)
Definition point (a b c : vec) (v w : R) : vec := Nearest.at_ a (vsub exactly b a) (vsub exactly c a) v w.

Lemma square_pos x : 0 <= square x.
Proof. unfold square, dot, exactly. pose proof (Rle_0_sqr (vx x)). pose proof (Rle_0_sqr (vy x)). pose proof (Rle_0_sqr (vz x)). unfold Rsqr in *. lra. Qed.
Lemma norm_pos x : 0 <= norm x.
Proof. apply sqrt_pos. Qed.
Lemma norm_square x : norm x * norm x = square x.
Proof. apply sqrt_sqrt, square_pos. Qed.

Lemma root_le x y : 0 <= y -> x <= y * y -> sqrt x <= y.
Proof. intros Hy H. rewrite <- (sqrt_square y Hy). now apply sqrt_le_1_alt. Qed.
Lemma root_ge x y : 0 <= y -> y * y <= x -> y <= sqrt x.
Proof. intros Hy H. rewrite <- (sqrt_square y Hy) at 1. now apply sqrt_le_1_alt. Qed.

(** Cauchy and Schwarz. *)
Lemma dot_le a b : dot exactly a b <= norm a * norm b.
Proof.
  unfold norm. rewrite <- sqrt_mult by apply square_pos. apply Rle_trans with (Rabs (dot exactly a b)); [apply Rle_abs|].
  rewrite <- sqrt_Rsqr_abs. apply sqrt_le_1_alt. unfold Rsqr. apply Rminus_le.
  replace (dot exactly a b * dot exactly a b - square a * square b)
    with (- (Rsqr (vx a * vy b - vy a * vx b) + Rsqr (vy a * vz b - vz a * vy b) + Rsqr (vz a * vx b - vx a * vz b)))
    by (unfold Rsqr, square, dot, exactly; ring).
  pose proof (Rle_0_sqr (vx a * vy b - vy a * vx b)). pose proof (Rle_0_sqr (vy a * vz b - vz a * vy b)). pose proof (Rle_0_sqr (vz a * vx b - vx a * vz b)). lra.
Qed.

Lemma norm_add a b : norm b <= norm a + norm (vsub exactly b a).
Proof.
  pose proof (norm_pos a) as A. pose proof (norm_pos (vsub exactly b a)) as B. apply root_le; [lra|].
  pose proof (dot_le a (vsub exactly b a)) as D. pose proof (norm_square a) as EA. pose proof (norm_square (vsub exactly b a)) as EB.
  assert (E : square b = square a + 2 * dot exactly a (vsub exactly b a) + square (vsub exactly b a)) by (unfold square, dot, vsub, exactly; cbn [vx vy vz]; ring).
  rewrite E. lra.
Qed.

Lemma norm_bounded B x : bounded B x -> norm x <= 7 / 4 * B.
Proof.
  intros (X & Y & Z). pose proof (pos_b _ _ X) as P. apply root_le; [lra|]. unfold square, dot, exactly.
  assert (S : forall t, Rabs t <= B -> t * t <= B * B).
  { intros t H. rewrite <- (Rabs_pos_eq (t * t)) by apply Rle_0_sqr. rewrite Rabs_mult. apply Rmult_le_compat; auto using Rabs_pos. }
  pose proof (S _ X). pose proof (S _ Y). pose proof (S _ Z). assert (0 <= B * B) by apply Rle_0_sqr. lra.
Qed.

(** Seen along any q, no point of a triangle is nearer than its nearest corner. [NEAR-1] *)
Theorem plane_supports a b c q m v w : Nearest.inside v w ->
  m <= dot exactly q a -> m <= dot exactly q b -> m <= dot exactly q c -> m <= norm q * norm (point a b c v w).
Proof.
  intros (V & W & S) A B C. eapply Rle_trans; [|apply dot_le].
  replace (dot exactly q (point a b c v w)) with ((1 - v - w) * dot exactly q a + v * dot exactly q b + w * dot exactly q c)
    by (unfold point, Nearest.at_, dot, vsub, exactly; cbn [vx vy vz]; ring).
  assert ((1 - v - w) * m <= (1 - v - w) * dot exactly q a) by (apply Rmult_le_compat_l; lra).
  assert (v * m <= v * dot exactly q b) by (now apply Rmult_le_compat_l). assert (w * m <= w * dot exactly q c) by (now apply Rmult_le_compat_l). lra.
Qed.

(** * Roundings *)

(** Half of the least float: what underflow costs. *)
Notation eta := (bpow radix2 (-1075)).

Lemma eta_pos : 0 < eta.
Proof. apply bpow_gt_0. Qed.

Lemma u_is : u = / 9007199254740992.
Proof. reflexivity. Qed.

Lemma off x : Rabs (R64 x - x) <= u * Rabs x + eta.
Proof.
  destruct (error_N_FLT radix2 (-1074) 53 prec_53 (fun z => negb (Z.even z)) x) as (e & h & He & Hh & _ & E).
  rewrite E. replace (x * (1 + e) + h - x) with (e * x + h) by ring. apply add_b.
  - rewrite Rabs_mult. apply Rmult_le_compat_r; [apply Rabs_pos|]. rewrite <- unit_half. exact He.
  - eapply Rle_trans; [exact Hh|]. change (-1074)%Z with (1 + -1075)%Z. rewrite bpow_plus. change (bpow radix2 1) with 2. lra.
Qed.

Lemma sum_off a b : F a -> F b -> Rabs (R64 (a + b) - (a + b)) <= u * Rabs (a + b).
Proof.
  intros A B. destruct (difference (-1074) 53 a (- b) A (generic_format_opp _ _ _ B)) as (e & He & E).
  replace (a - - b) with (a + b) in E by ring. rewrite E. replace ((a + b) * (1 + e) - (a + b)) with (e * (a + b)) by ring.
  rewrite Rabs_mult. apply Rmult_le_compat_r; [apply Rabs_pos|]. eapply Rle_trans; [exact He|]. apply unit_ratio, bpow_gt_0.
Qed.

(** What a rounded sum is off by is a part of the rounded one, too. *)
Lemma sum_back a b : F a -> F b -> Rabs (R64 (a + b) - (a + b)) <= u * Rabs (R64 (a + b)).
Proof.
  intros A B. destruct (difference (-1074) 53 a (- b) A (generic_format_opp _ _ _ B)) as (e & He & E).
  replace (a - - b) with (a + b) in E by ring. rewrite E. replace ((a + b) * (1 + e) - (a + b)) with (e * (a + b)) by ring.
  rewrite !Rabs_mult, (Rmult_comm (Rabs (a + b))), <- Rmult_assoc. apply Rmult_le_compat_r; [apply Rabs_pos|].
  pose proof (unit_small 53 ltac:(lia)) as U. assert (H : u / (1 + u) = u * (1 - u / (1 + u))) by (field; lra).
  pose proof (unit_ratio u ltac:(lra)). apply Rle_trans with (1 := He). rewrite H. apply Rmult_le_compat_l; [lra|].
  apply Rabs_le_inv in He. rewrite (Rabs_pos_eq (1 + e)); lra.
Qed.

Lemma from_off x y : Rabs x <= Rabs (x - y) + Rabs y.
Proof. replace x with (x - y + y) at 1 by ring. apply Rabs_triang. Qed.

Lemma F_R64 x : F (R64 x).
Proof. apply generic_format_round; typeclasses eauto. Qed.

Definition sizes (a b : vec) : R := Rabs (vx a * vx b) + Rabs (vy a * vy b) + Rabs (vz a * vz b).

(** A dot product. *)
Lemma dot_off a b : Rabs (dot R64 a b - dot exactly a b) <= (3 * u + 4 * (u * u)) * sizes a b + 4 * eta.
Proof.
  unfold dot, exactly, sizes. pose proof eta_pos.
  set (x := vx a * vx b). set (y := vy a * vy b). set (z := vz a * vz b).
  pose proof (off x) as X. pose proof (off y) as Y. pose proof (off z) as Z.
  pose proof (sum_off _ _ (F_R64 x) (F_R64 y)) as S. pose proof (sum_off _ _ (F_R64 (R64 x + R64 y)) (F_R64 z)) as T.
  set (x' := R64 x) in *. set (y' := R64 y) in *. set (z' := R64 z) in *. set (s := R64 (x' + y')) in *. set (t := R64 (s + z')) in *.
  clearbody x y z x' y' z' s t. rewrite u_is in *.
  pose proof (from_off x' x). pose proof (from_off y' y). pose proof (from_off z' z). pose proof (Rabs_triang x' y').
  pose proof (from_off s (x' + y')). pose proof (Rabs_triang s z').
  replace (t - (x + y + z)) with ((t - (s + z')) + (s - (x' + y')) + (x' - x) + (y' - y) + (z' - z)) by ring.
  pose proof (Rabs_triang (t - (s + z') + (s - (x' + y')) + (x' - x) + (y' - y)) (z' - z)).
  pose proof (Rabs_triang (t - (s + z') + (s - (x' + y')) + (x' - x)) (y' - y)).
  pose proof (Rabs_triang (t - (s + z') + (s - (x' + y'))) (x' - x)). pose proof (Rabs_triang (t - (s + z')) (s - (x' + y'))).
  pose proof (Rabs_pos x). pose proof (Rabs_pos y). pose proof (Rabs_pos z).
  lra.
Qed.

Lemma sizes_le B a b : bounded B b -> sizes a b <= norm a * (7 / 4 * B).
Proof.
  intros H. set (abs := fun x : vec => Vec (Rabs (vx x)) (Rabs (vy x)) (Rabs (vz x))).
  assert (S : forall x, square (abs x) = square x).
  { intros x. unfold square, dot, exactly, abs. cbn [vx vy vz]. rewrite <- !Rabs_mult, !Rabs_pos_eq by apply Rle_0_sqr. reflexivity. }
  replace (sizes a b) with (dot exactly (abs a) (abs b)) by (unfold sizes, dot, exactly, abs; cbn [vx vy vz]; now rewrite !Rabs_mult).
  eapply Rle_trans; [apply dot_le|]. unfold norm. rewrite !S. apply Rmult_le_compat_l; [apply norm_pos|now apply norm_bounded].
Qed.

Lemma sizes_square a : sizes a a = square a.
Proof. unfold sizes, square, dot, exactly. now rewrite !Rabs_pos_eq by apply Rle_0_sqr. Qed.

(** * The code *)

(** [DVec3::length], SHORT and MARGIN. *)
Definition length (q : vec) : R := R64 (sqrt (dot R64 q q)).
Definition short : R := bpow radix2 (-300).
Definition margin (greatest : R) : R := R64 (64 * u * greatest).

(** [bounds], from a guess and the corners relative to the point. *)
Definition least (q a b c : vec) : R := Rmin (Rmin (dot R64 q a) (dot R64 q b)) (dot R64 q c).
Definition near (q a b c : vec) (greatest : R) : R :=
  if Rlt_bool short (length q) then Rmax (R64 (R64 (R64 (least q a b c / length q) * (1 - 8 * u)) - margin greatest)) 0 else 0.
Definition far (q : vec) (greatest : R) : R := R64 (R64 (length q * (1 + 8 * u)) + margin greatest).

(** * The length *)

Lemma square_off q : Rabs (dot R64 q q - square q) <= (3 * u + 4 * (u * u)) * square q + 4 * eta.
Proof. rewrite <- sizes_square at 2. apply dot_off. Qed.

Lemma length_pos q : 0 <= length q.
Proof. unfold length. rewrite <- (round_0 radix2 fexp ZnearestE). apply round_le; try typeclasses eauto. apply sqrt_pos. Qed.

Lemma eta_is e : (-1075 <= e)%Z -> eta <= bpow radix2 e.
Proof. intros. now apply bpow_le. Qed.

(** What is so short has no direction. *)
Lemma length_of_short q : norm q <= bpow radix2 (-500) -> length q <= short.
Proof.
  intros H. unfold length, short. apply round_le_generic; try typeclasses eauto; [apply generic_format_bpow; unfold FLT_exp; lia|].
  apply root_le; [apply bpow_ge_0|]. pose proof (square_off q) as O. apply Rabs_le_inv in O.
  assert (S : square q <= bpow radix2 (-1000)).
  { rewrite <- norm_square. change (-1000)%Z with (-500 + -500)%Z. rewrite bpow_plus. pose proof (norm_pos q). now apply Rmult_le_compat. }
  assert (E : eta <= bpow radix2 (-1000)) by (apply eta_is; lia).
  assert (T : bpow radix2 (-300) * bpow radix2 (-300) = bpow radix2 400 * bpow radix2 (-1000)) by (rewrite <- !bpow_plus; reflexivity).
  assert (B : 16 <= bpow radix2 400) by (change 16 with (bpow radix2 4); apply bpow_le; lia).
  pose proof (bpow_gt_0 radix2 (-1000)) as P. assert (16 * bpow radix2 (-1000) <= bpow radix2 400 * bpow radix2 (-1000)) by (apply Rmult_le_compat_r; lra).
  rewrite u_is in O. pose proof (square_pos q). lra.
Qed.

(** All else is hardly longer than it is computed. *)
Lemma length_least q : bpow radix2 (-500) < norm q -> norm q * (1 - 4 * u) <= length q.
Proof.
  intros H. set (n := norm q) in *. pose proof (square_off q) as O. rewrite <- norm_square in O. fold n in O. apply Rabs_le_inv in O.
  pose proof (bpow_gt_0 radix2 (-500)) as P.
  assert (N : bpow radix2 (-1000) <= n * n).
  { change (-1000)%Z with (-500 + -500)%Z. rewrite bpow_plus. apply Rmult_le_compat; lra. }
  assert (E : eta <= u * u * bpow radix2 (-500)).
  { rewrite <- !bpow_plus. apply eta_is. lia. }
  assert (E2 : eta <= / 16 * u * bpow radix2 (-1000)).
  { change (/ 16) with (bpow radix2 (-4)). rewrite <- !bpow_plus. apply eta_is. lia. }
  assert (Q : n * (1 - 2 * u) <= sqrt (dot R64 q q)).
  { apply root_ge; [apply Rmult_le_pos; rewrite ?u_is; lra|].
    replace (n * (1 - 2 * u) * (n * (1 - 2 * u))) with ((1 - 2 * u) * (1 - 2 * u) * (n * n)) by ring. rewrite u_is in *. lra. }
  unfold length. pose proof (off (sqrt (dot R64 q q))) as L. rewrite (Rabs_pos_eq (sqrt _)) in L by apply sqrt_pos.
  apply Rabs_le_inv in L. set (s := sqrt (dot R64 q q)) in *. set (l := R64 s) in *. clearbody n s l. rewrite u_is in *. lra.
Qed.

(** * The bounds *)

(** A corner relative to the point, exact and rounded. *)
Definition close (greatest : R) (exact rounded : vec) : Prop :=
  bounded greatest rounded /\ bounded (u * greatest) (vsub exactly exact rounded).

(** Corners and point are floats: then no component is off by more. *)
Definition floats (x : vec) : Prop := F (vx x) /\ F (vy x) /\ F (vz x).
Lemma relative_is_close greatest x p : floats x -> floats p -> bounded greatest (vsub R64 x p) ->
  close greatest (vsub exactly x p) (vsub R64 x p).
Proof.
  intros (X & Y & Z) (PX & PY & PZ) B. split; [exact B|]. destruct B as (B1 & B2 & B3). unfold vsub, exactly in *. cbn [vx vy vz] in *.
  assert (S : forall s t, F s -> F t -> Rabs (R64 (s - t)) <= greatest -> Rabs (s - t - R64 (s - t)) <= u * greatest).
  { intros s t Fs Ft H. rewrite Rabs_minus_sym. eapply Rle_trans; [exact (sum_back s (- t) Fs (generic_format_opp _ _ _ Ft))|].
    apply Rmult_le_compat_l; [apply bpow_ge_0|exact H]. }
  repeat split; cbn [vx vy vz]; now apply S.
Qed.

(** What underflows is far less than what rounding costs. *)
Lemma eta_small greatest : bpow radix2 (-200) <= greatest -> eta <= u * u * greatest.
Proof.
  intros H. apply Rle_trans with (u * u * bpow radix2 (-200)); [rewrite <- !bpow_plus; apply eta_is; lia|].
  apply Rmult_le_compat_l; [apply Rmult_le_pos; apply bpow_ge_0|exact H].
Qed.
Lemma usual_pos greatest : bpow radix2 (-200) <= greatest -> 0 < greatest.
Proof. intros H. eapply Rlt_le_trans; [apply bpow_gt_0|exact H]. Qed.

(** Rounding of what is not above a bound, or not below one. *)
Lemma rounded_most x X : 0 <= X -> x <= X -> R64 x <= X * (1 + u) + eta.
Proof.
  intros P H. apply Rle_trans with (R64 X); [apply round_le; typeclasses eauto || exact H|].
  pose proof (off X) as O. rewrite (Rabs_pos_eq X) in O by exact P. apply Rabs_le_inv in O. lra.
Qed.
Lemma rounded_least x X : 0 <= X -> X <= x -> X * (1 - u) - eta <= R64 x.
Proof.
  intros P H. apply Rle_trans with (R64 X); [|apply round_le; typeclasses eauto || exact H].
  pose proof (off X) as O. rewrite (Rabs_pos_eq X) in O by exact P. apply Rabs_le_inv in O. lra.
Qed.

Section Bounds.
Variable greatest : R.
Hypothesis usual : bpow radix2 (-200) <= greatest.

Let eta_small := eta_small _ usual.
Let positive := usual_pos _ usual.

Lemma margin_least : 63 * u * greatest <= margin greatest.
Proof.
  unfold margin. pose proof (off (64 * u * greatest)) as O. rewrite (Rabs_pos_eq (64 * u * greatest)) in O by (rewrite u_is; lra).
  apply Rabs_le_inv in O. pose proof eta_small as E. pose proof positive. set (r := R64 _) in *. clearbody r. rewrite u_is in *. lra.
Qed.

(** A corner along the guess: 3u |q| (7/4) M for the dot product, and u |q| (7/4) M for the corner. *)
Lemma along_off q x x' : close greatest x x' -> Rabs (dot R64 q x' - dot exactly q x) <= (7 * u + 8 * (u * u)) * (norm q * greatest) + 4 * eta.
Proof.
  intros (B & C). pose proof (dot_off q x') as D. pose proof (sizes_le _ q x' B) as S.
  assert (A : Rabs (dot exactly q (vsub exactly x x')) <= norm q * (7 / 4 * (u * greatest))).
  { eapply Rle_trans; [|exact (sizes_le _ q _ C)]. unfold dot, exactly, sizes. eapply Rle_trans; [apply Rabs_triang|]. apply Rplus_le_compat_r, Rabs_triang. }
  replace (dot R64 q x' - dot exactly q x) with (dot R64 q x' - dot exactly q x' - dot exactly q (vsub exactly x x'))
    by (unfold dot, vsub, exactly; cbn [vx vy vz]; ring).
  eapply Rle_trans; [apply (sub_b _ _ _ _ D A)|].
  assert ((3 * u + 4 * (u * u)) * sizes q x' <= (3 * u + 4 * (u * u)) * (norm q * (7 / 4 * greatest))) by (apply Rmult_le_compat_l; [rewrite u_is; lra|exact S]).
  assert (0 <= norm q * greatest) by (apply Rmult_le_pos; [apply norm_pos|apply Rlt_le, positive]). rewrite u_is in *. lra.
Qed.

(** Whatever the guess is, no point of the triangle is nearer than the lower bound. [NEAR-1] *)
Theorem near_is_below q a b c a' b' c' v w : close greatest a a' -> close greatest b b' -> close greatest c c' -> Nearest.inside v w ->
  near q a' b' c' greatest <= norm (point a b c v w).
Proof.
  intros A B C I. unfold near. destruct (Rlt_bool_spec short (length q)) as [Long|_]; [|apply norm_pos].
  set (x := norm (point a b c v w)). assert (X : 0 <= x) by apply norm_pos. apply Rmax_lub; [|exact X].
  set (n := norm q). assert (N : bpow radix2 (-500) < n).
  { apply Rnot_le_lt. intros H. apply length_of_short in H. lra. }
  pose proof (length_least q N) as L. fold n in L. set (l := length q) in *. pose proof (bpow_gt_0 radix2 (-500)) as P5. pose proof (bpow_gt_0 radix2 (-300)) as P3.
  assert (Lpos : 0 < l) by (unfold short in Long; lra). pose proof positive as PM.
  assert (E : 4 * eta <= u * u * (n * greatest)).
  { apply Rle_trans with (u * u * (bpow radix2 (-500) * bpow radix2 (-200))).
    - change 4 with (bpow radix2 2). rewrite <- !bpow_plus. apply bpow_le. lia.
    - apply Rmult_le_compat_l; [apply Rmult_le_pos; apply bpow_ge_0|]. apply Rmult_le_compat; try apply bpow_ge_0; [lra|exact usual]. }
  pose proof (along_off q a a' A) as OA. pose proof (along_off q b b' B) as OB. pose proof (along_off q c c' C) as OC.
  fold n in OA, OB, OC. apply Rabs_le_inv in OA, OB, OC. set (m := least q a' b' c').
  assert (MA : m <= dot R64 q a') by (unfold m, least; eapply Rle_trans; [apply Rmin_l|apply Rmin_l]).
  assert (MB : m <= dot R64 q b') by (unfold m, least; eapply Rle_trans; [apply Rmin_l|apply Rmin_r]).
  assert (MC : m <= dot R64 q c') by apply Rmin_r.
  set (err := (7 * u + 8 * (u * u)) * (n * greatest) + 4 * eta) in *.
  pose proof (plane_supports a b c q (m - err) v w I ltac:(lra) ltac:(lra) ltac:(lra)) as H. fold x n in H.
  (* m / l is hardly above |x| + 7uM. *)
  set (y := (x + 71 / 10 * u * greatest) * (1 + 41 / 10 * u)).
  assert (Y0 : 0 <= y) by (unfold y; apply Rmult_le_pos; rewrite u_is; lra).
  assert (Q : m / l <= y).
  { apply Rmult_le_reg_r with l; [exact Lpos|]. replace (m / l * l) with m by (field; lra).
    apply Rle_trans with (y * (n * (1 - 4 * u))); [|now apply Rmult_le_compat_l]. unfold y, err in *.
    assert (0 <= n * x) by (apply Rmult_le_pos; lra). assert (0 <= n * greatest) by (apply Rmult_le_pos; lra).
    clear - H E H0 H1. rewrite u_is in *. lra. }
  pose proof margin_least as MM. pose proof eta_small as ES.
  pose proof (rounded_most _ _ Y0 Q) as R1. set (y1 := R64 (m / l)) in *.
  assert (Y1 : 0 <= (y * (1 + u) + eta) * (1 - 8 * u)) by (apply Rmult_le_pos; pose proof eta_pos; [assert (0 <= y * (1 + u)) by (apply Rmult_le_pos; rewrite ?u_is; lra); lra|rewrite u_is; lra]).
  assert (Q1 : y1 * (1 - 8 * u) <= (y * (1 + u) + eta) * (1 - 8 * u)) by (apply Rmult_le_compat_r; [rewrite u_is; lra|exact R1]).
  pose proof (rounded_most _ _ Y1 Q1) as R2. set (y2 := R64 (y1 * (1 - 8 * u))) in *. set (g := margin greatest) in *.
  set (z := x * (1 - u)). assert (Z0 : 0 <= z) by (unfold z; apply Rmult_le_pos; rewrite ?u_is; lra).
  assert (Q2 : y2 - g <= z - 50 * u * greatest).
  { unfold y, z in *. clear - R2 MM ES X PM. clearbody y2 g. rewrite u_is in *. lra. }
  destruct (Rle_or_lt (y2 - g) 0) as [Neg|Pos].
  - apply Rle_trans with 0; [|exact X]. rewrite <- (round_0 radix2 fexp ZnearestE). apply round_le; typeclasses eauto || exact Neg.
  - pose proof (rounded_most (y2 - g) (z - 50 * u * greatest) ltac:(lra) Q2) as R3. unfold z in *. clear - R3 ES X PM.
    set (r := R64 (y2 - g)) in *. clearbody r. rewrite u_is in *. lra.
Qed.
End Bounds.
