(** Twice the digits: quotients, roots, and what is made of determinants. What FineQuotients.v, FineRoots.v and FineDeterminants.v are about is what
    Operations.v has, in rounded real numbers. Whatever number is taken for infinity there, all but it is the same. *)
Require Import Reals ZArith Lia Lra Bool List.
From Flocq Require Import Core.
Require Import StacklessExact.Rounding StacklessExact.Range StacklessExact.Arithmetic StacklessExact.Operations.
Require Import StacklessExact.Fine StacklessExact.FineQuotients StacklessExact.FineRoots StacklessExact.FineDeterminants StacklessExact.AgreementFine.
Require StacklessExact.Expansion StacklessExact.Intervals.
Open Scope R_scope.

Local Instance prec_53 : Prec_gt_0 53 := eq_refl.
Local Instance prec_24 : Prec_gt_0 24 := eq_refl.

Section Over.
(** What stands for infinity. *)
Variable top : R.
Definition topped : arithmetic := let a := moving in
  {| num := num a; Arithmetic.plus := Arithmetic.plus a; Arithmetic.minus := Arithmetic.minus a; times := times a; Arithmetic.over := Arithmetic.over a; Arithmetic.root := Arithmetic.root a;
     opposite := opposite a; absolute := absolute a; less := less a; at_most := at_most a; equal := equal a; is_finite := is_finite a;
     is_negative := is_negative a; constant := constant a; infinity := top; not_a_number := not_a_number a; shifted := shifted a; power := power a;
     cleared := cleared a; after := after a; before := before a |}.

Ltac same := cbv beta iota delta [Fine_sub Fine_neg Fine_add Fine_mul Fine_bounds Interval_add Fine_new sum_two_sum sum_two_product sum_split fine_UP
  topped stepping reals num Arithmetic.plus Arithmetic.minus times Arithmetic.over Arithmetic.root opposite absolute less at_most equal constant after before]; reflexivity.
Lemma new_is h l r : Fine_new topped h l r = parts (new h l r).
Proof. rewrite <- new_agrees. same. Qed.
Lemma add_of x y : Fine_add topped (high x) (low x) (radius x) (high y) (low y) (radius y) = parts (add x y).
Proof. rewrite <- add_agrees. same. Qed.
Lemma sub_of x y : Fine_sub topped (high x) (low x) (radius x) (high y) (low y) (radius y) = parts (sub x y).
Proof. rewrite <- sub_agrees. same. Qed.
Lemma mul_of x y : Fine_mul topped (high x) (low x) (radius x) (high y) (low y) (radius y) = parts (mul x y).
Proof. rewrite <- mul_agrees. same. Qed.
Lemma bounds_of x : Fine_bounds topped (high x) (low x) (radius x) = let '((a, b), (c, d)) := bounds x in (a, b, c, d).
Proof. rewrite <- bounds_agrees. same. Qed.
Lemma zero_of : constant topped 0 0 = 0.
Proof. exact zero_is. Qed.
Lemma power_of e : constant topped 1 e = bpow radix2 e.
Proof. exact (power_is e). Qed.

Lemma add_at a b c d e f : Fine_add topped a b c d e f = parts (add (Fine a b c) (Fine d e f)).
Proof. exact (add_of (Fine a b c) (Fine d e f)). Qed.
Lemma sub_at a b c d e f : Fine_sub topped a b c d e f = parts (sub (Fine a b c) (Fine d e f)).
Proof. exact (sub_of (Fine a b c) (Fine d e f)). Qed.
Lemma mul_at a b c d e f : Fine_mul topped a b c d e f = parts (mul (Fine a b c) (Fine d e f)).
Proof. exact (mul_of (Fine a b c) (Fine d e f)). Qed.

(** [Fine::hull]. [NEAR-5] *)
Theorem hull_agrees x y : Fine_hull topped (high x) (low x) (radius x) (high y) (low y) (radius y) = parts (hull x y).
Proof.
  unfold Fine_hull, hull. rewrite zero_of. change (fine_UP topped) with (fine_UP rounded). rewrite up_is, sub_at, whole. reflexivity.
Qed.

(** [Fine::over], where it is known: then the least divisor is above 0. [NEAR-5] *)
Theorem over_agrees x y : let '(is_known, h, l, r) := Fine_over topped (high x) (low x) (radius x) (high y) (low y) (radius y) in
  (h, l, r) = parts (snd (over x y)) /\ (is_known = true -> 0 < fst (over x y)).
Proof.
  assert (One : forall a b, 
    let '(least, _, _, _) := Fine_bounds topped (high b) (low b) (radius b) in
    let quotient := Arithmetic.over topped (high a) (high b) in
    let '(m, m', m'') := Fine_mul topped quotient (constant topped 0 0) (constant topped 0 0) (high b) (low b) (radius b) in
    let '(left_high, left_low, left_radius) := Fine_sub topped (high a) (low a) (radius a) m m' m'' in
    let step := Arithmetic.over topped left_high (high b) in
    let of_whole := Arithmetic.plus topped (Arithmetic.over topped (radius b) (high b)) (constant topped 1 (-52)) in
    let r := Arithmetic.plus topped (Arithmetic.over topped (Arithmetic.plus topped (Arithmetic.plus topped left_radius (absolute topped left_low))
      (times topped (absolute topped left_high) of_whole)) least) (times topped (absolute topped step) (constant topped 1 (-52))) in
    let '(n, n', n'') := Fine_new topped quotient step (Arithmetic.plus topped r (constant topped 1 (-1060))) in
    least = fst (over_positive a b) /\ (n, n', n'') = parts (snd (over_positive a b))).
  { intros a b. unfold over_positive. rewrite bounds_of, zero_of, !power_of. destruct (bounds b) as [[least below] [most above]]. cbn [fst snd]. cbv zeta.
    change (Arithmetic.over topped (high a) (high b)) with (R64 (high a / high b)). set (q := R64 (high a / high b)). rewrite mul_at, whole. fold (exact q). unfold parts at 1.
    rewrite sub_at, !whole. unfold parts at 1. rewrite new_is. cbn [snd]. split; reflexivity. }
  unfold Fine_over, over. rewrite zero_of. change (less topped (high y) 0) with (Rlt_bool (high y) 0).
  destruct (Rlt_bool (high y) 0).
  - specialize (One (neg x) (neg y)). cbv zeta in *. unfold Fine_neg. cbn [neg high low radius] in One. change (opposite topped) with Ropp. cbv beta iota. rewrite zero_of in One.
    destruct (Fine_bounds topped (- high y) _ _) as [[[least ?] ?] ?]. destruct (Fine_mul topped _ _ _ _ _ _) as [[m m'] m'']. destruct (Fine_sub topped _ _ _ _ _ _) as [[l l'] l''].
    destruct (Fine_new topped _ _ _) as [[k k'] k'']. destruct One as [E N]. split; [exact N|]. intros K. apply andb_prop in K as [K _]. apply andb_prop in K as [K _].
    rewrite <- E. exact (ltb_true _ _ K).
  - specialize (One x y). cbv zeta in *. unfold Fine_neg. cbv beta iota. rewrite zero_of in One.
    destruct (Fine_bounds topped (high y) _ _) as [[[least ?] ?] ?]. destruct (Fine_mul topped _ _ _ _ _ _) as [[m m'] m'']. destruct (Fine_sub topped _ _ _ _ _ _) as [[l l'] l''].
    destruct (Fine_new topped _ _ _) as [[k k'] k'']. destruct One as [E N]. split; [exact N|]. intros K. apply andb_prop in K as [K _]. apply andb_prop in K as [K _].
    rewrite <- E. exact (ltb_true _ _ K).
Qed.

(** [Fine::root]. [NEAR-5] *)
Theorem root_agrees x : Fine_root topped (high x) (low x) (radius x) = let '(is_known, y) := root x in (is_known, high y, low y, radius y).
Proof.
  unfold Fine_root, root, root_radius, is_zero, is_exact. rewrite !zero_of, !power_of. cbv zeta. change (bpow radix2 1) with 2. change (bpow radix2 2) with 4. change (bpow radix2 3) with 8.
  change (Arithmetic.root topped (high x)) with (R64 (sqrt (high x))). set (r := R64 (sqrt (high x))). rewrite mul_at. fold (exact r). unfold parts at 1. rewrite sub_at, !whole. unfold parts at 1.
  rewrite new_is. unfold parts at 1. rewrite (andb_comm (Req_bool (high x) 0)). rewrite negb_involutive. cbn [fst snd].
  change (equal topped) with Req_bool. destruct (andb (Req_bool (radius x) 0) (Req_bool (high x) 0)); reflexivity.
Qed.

(** * Determinants *)

Definition numbers (v : fines) : R * R * R * R * R * R * R * R * R :=
  let '(x, y, z) := (fine_x v, fine_y v, fine_z v) in (high x, low x, radius x, high y, low y, radius y, high z, low z, radius z).
Lemma minus_at a b c d e f g h i a' b' c' d' e' f' g' h' i' :
  fine_minus topped a b c d e f g h i a' b' c' d' e' f' g' h' i' = numbers (minus (Fines (Fine a b c) (Fine d e f) (Fine g h i)) (Fines (Fine a' b' c') (Fine d' e' f') (Fine g' h' i'))).
Proof. unfold fine_minus. rewrite !sub_at. reflexivity. Qed.
Lemma cross_at a b c d e f g h i a' b' c' d' e' f' g' h' i' :
  fine_cross topped a b c d e f g h i a' b' c' d' e' f' g' h' i' = numbers (cross (Fines (Fine a b c) (Fine d e f) (Fine g h i)) (Fines (Fine a' b' c') (Fine d' e' f') (Fine g' h' i'))).
Proof. unfold fine_cross. rewrite !mul_at. unfold parts. cbv beta iota. rewrite !sub_at, !whole. reflexivity. Qed.
Lemma dot_at a b c d e f g h i a' b' c' d' e' f' g' h' i' :
  fine_dot topped a b c d e f g h i a' b' c' d' e' f' g' h' i' = parts (dot (Fines (Fine a b c) (Fine d e f) (Fine g h i)) (Fines (Fine a' b' c') (Fine d' e' f') (Fine g' h' i'))).
Proof. unfold fine_dot. rewrite !mul_at. unfold parts at 1 2 3. cbv beta iota. rewrite add_at, !whole. unfold parts at 1. cbv beta iota. rewrite add_at, !whole. reflexivity. Qed.
Lemma all_of v : Fines (Fine (high (fine_x v)) (low (fine_x v)) (radius (fine_x v))) (Fine (high (fine_y v)) (low (fine_y v)) (radius (fine_y v)))
  (Fine (high (fine_z v)) (low (fine_z v)) (radius (fine_z v))) = v.
Proof. now destruct v as [[] [] []]. Qed.

(** [FineDeterminants::of]. [EXACT-10] *)
Theorem of_agrees v0 v1 v2 ox oy oz dx dy dz :
  let '(x0, y0, z0) := (fine_x v0, fine_y v0, fine_z v0) in let '(x1, y1, z1) := (fine_x v1, fine_y v1, fine_z v1) in let '(x2, y2, z2) := (fine_x v2, fine_y v2, fine_z v2) in
  FineDeterminants_of topped (high x0) (low x0) (radius x0) (high y0) (low y0) (radius y0) (high z0) (low z0) (radius z0)
    (high x1) (low x1) (radius x1) (high y1) (low y1) (radius y1) (high z1) (low z1) (radius z1)
    (high x2) (low x2) (radius x2) (high y2) (low y2) (radius y2) (high z2) (low z2) (radius z2) ox oy oz dx dy dz =
  let x := of v0 v1 v2 (Fines (exact ox) (exact oy) (exact oz)) (Fines (exact dx) (exact dy) (exact dz)) in
  let '(a1, a2, a3, a4, a5, a6, a7, a8, a9) := numbers (d_ x) in let '(b1, b2, b3, b4, b5, b6, b7, b8, b9) := numbers (s_ x) in
  let '(c1, c2, c3, c4, c5, c6, c7, c8, c9) := numbers (e1 x) in let '(f1, f2, f3, f4, f5, f6, f7, f8, f9) := numbers (e2 x) in
  let '(g1, g2, g3) := parts (det x) in
  (a1, a2, a3, a4, a5, a6, a7, a8, a9, b1, b2, b3, b4, b5, b6, b7, b8, b9, c1, c2, c3, c4, c5, c6, c7, c8, c9, f1, f2, f3, f4, f5, f6, f7, f8, f9, g1, g2, g3).
Proof.
  unfold FineDeterminants_of. rewrite zero_of, !minus_at, !all_of. fold (exact ox) (exact oy) (exact oz). unfold numbers at 1 2 3. cbv beta iota. rewrite cross_at, !all_of. fold (exact dx) (exact dy) (exact dz).
  unfold numbers at 1. cbv beta iota. rewrite dot_at, !all_of. cbv zeta. unfold of. cbn [d_ s_ e1 e2 det]. unfold numbers. cbn [fine_x fine_y fine_z exact high low radius]. reflexivity.
Qed.

(** [FineDeterminants::nearest], where it tells a double. *)
Lemma nearest_agrees x y : let '(is_known, h, l, r) := Fine_over topped (high x) (low x) (radius x) (high y) (low y) (radius y) in
  let '(lo, _, hi, _) := Fine_bounds topped h l r in
  andb is_known (equal topped lo hi) = true -> nearest (over x y) between = Some (Arithmetic.plus topped lo 0).
Proof.
  pose proof (over_agrees x y) as A. destruct (Fine_over topped _ _ _ _ _ _) as [[[k h] l] r]. destruct A as [E K]. set (q := over x y) in *. unfold parts in E. injection E as -> -> ->.
  rewrite bounds_of. unfold nearest. destruct (bounds (snd q)) as [[lo below] [hi above]] eqn:B. intros H. apply andb_prop in H as [H1 H2]. rewrite Rlt_bool_true by now apply K.
  unfold between. change (equal topped lo hi) with (Req_bool lo hi) in H2. rewrite H2. change (Some lo = Some (R64 (lo + 0))). rewrite Rplus_0_r, R64_id; [reflexivity|].
  unfold bounds in B. destruct q as [? [qh ql qr]]. cbn [snd high low radius] in B. injection B as B _ _ _. rewrite <- B. unfold Expansion.two_sum. apply Expansion.F_R64.
Qed.

(** [FineDeterminants::distance_within] for doubles. [EXACT-3, EXACT-10] *)
Theorem distance_agrees x tmin tmax t :
  let '(sx, sy, sz) := (fine_x (s_ x), fine_y (s_ x), fine_z (s_ x)) in let '(ax, ay, az) := (fine_x (e1 x), fine_y (e1 x), fine_z (e1 x)) in
  let '(bx, by_, bz) := (fine_x (e2 x), fine_y (e2 x), fine_z (e2 x)) in
  FineDeterminants_distance_within topped (high sx) (low sx) (radius sx) (high sy) (low sy) (radius sy) (high sz) (low sz) (radius sz)
    (high ax) (low ax) (radius ax) (high ay) (low ay) (radius ay) (high az) (low az) (radius az)
    (high bx) (low bx) (radius bx) (high by_) (low by_) (radius by_) (high bz) (low bz) (radius bz) (high (det x)) (low (det x)) (radius (det x)) tmin tmax = Some t ->
  nearest (over (t_top x) (det x)) between = Some t /\ tmin < t < tmax.
Proof.
  cbv beta iota zeta. unfold FineDeterminants_distance_within. rewrite cross_at, !all_of. unfold numbers. cbv beta iota zeta. rewrite dot_at, !all_of. unfold parts. cbv beta iota.
  fold (t_top x). pose proof (nearest_agrees (t_top x) (det x)) as N. destruct (Fine_over topped _ _ _ _ _ _) as [[[k h] l] r]. destruct (Fine_bounds topped _ _ _) as [[[lo ?] hi] ?].
  rewrite zero_of. destruct (andb (andb k _) _) eqn:B; [|discriminate]. intros [= <-]. apply andb_prop in B as [B1 B2]. split; [now apply N|]. apply andb_prop in B2 as [B2 B3].
  split; [exact (ltb_true _ _ B2)|exact (ltb_true _ _ B3)].
Qed.

(** [FineDeterminants::weights] for doubles. [EXACT-10] *)
Theorem weights_agree x : let '(dx, dy, dz) := (fine_x (d_ x), fine_y (d_ x), fine_z (d_ x)) in
  let '(sx, sy, sz) := (fine_x (s_ x), fine_y (s_ x), fine_z (s_ x)) in let '(ax, ay, az) := (fine_x (e1 x), fine_y (e1 x), fine_z (e1 x)) in
  let '(bx, by_, bz) := (fine_x (e2 x), fine_y (e2 x), fine_z (e2 x)) in
  let '(are_known, u, v) := FineDeterminants_weights topped (high dx) (low dx) (radius dx) (high dy) (low dy) (radius dy) (high dz) (low dz) (radius dz)
    (high sx) (low sx) (radius sx) (high sy) (low sy) (radius sy) (high sz) (low sz) (radius sz)
    (high ax) (low ax) (radius ax) (high ay) (low ay) (radius ay) (high az) (low az) (radius az)
    (high bx) (low bx) (radius bx) (high by_) (low by_) (radius by_) (high bz) (low bz) (radius bz) (high (det x)) (low (det x)) (radius (det x)) in
  are_known = true -> nearest (over (u_top x) (det x)) between = Some u /\ nearest (over (v_top x) (det x)) between = Some v.
Proof.
  cbv beta iota zeta. unfold FineDeterminants_weights. rewrite !cross_at, !all_of. unfold numbers. cbv beta iota zeta. rewrite !dot_at, !all_of. unfold parts. cbv beta iota zeta.
  fold (u_top x) (v_top x). pose proof (nearest_agrees (u_top x) (det x)) as N. pose proof (nearest_agrees (v_top x) (det x)) as N'.
  destruct (Fine_over topped (high (u_top x)) _ _ _ _ _) as [[[k h] l] r]. destruct (Fine_bounds topped h _ _) as [[[lo ?] hi] ?].
  destruct (Fine_over topped (high (v_top x)) _ _ _ _ _) as [[[k' h'] l'] r']. destruct (Fine_bounds topped h' _ _) as [[[lo' ?] hi'] ?].
  rewrite zero_of. intros B. apply andb_prop in B as [B1 B2]. split; [now apply N|now apply N'].
Qed.

(** The distance that the code tells of a ray and a triangle of doubles, or of corners that are known within bounds: that of the plane, rounded, and the
    determinant is not 0. As far as nothing overflows. [EXACT-3, EXACT-10] *)
Theorem code_distance_is_right v0 v1 v2 ax ay az bx by_ bz cx cy cz ox oy oz dx dy dz tmin tmax t :
  let F := generic_format radix2 (FLT_exp (-1074) 53) in
  Forall F (ox :: oy :: oz :: dx :: dy :: dz :: nil) -> stand v0 ax ay az -> stand v1 bx by_ bz -> stand v2 cx cy cz ->
  let '(x0, y0, z0) := (fine_x v0, fine_y v0, fine_z v0) in let '(x1, y1, z1) := (fine_x v1, fine_y v1, fine_z v1) in let '(x2, y2, z2) := (fine_x v2, fine_y v2, fine_z v2) in
  let '(_, _, _, _, _, _, _, _, _, S1, S2, S3, S4, S5, S6, S7, S8, S9, A1, A2, A3, A4, A5, A6, A7, A8, A9, B1, B2, B3, B4, B5, B6, B7, B8, B9, G1, G2, G3) :=
    FineDeterminants_of topped (high x0) (low x0) (radius x0) (high y0) (low y0) (radius y0) (high z0) (low z0) (radius z0)
      (high x1) (low x1) (radius x1) (high y1) (low y1) (radius y1) (high z1) (low z1) (radius z1)
      (high x2) (low x2) (radius x2) (high y2) (low y2) (radius y2) (high z2) (low z2) (radius z2) ox oy oz dx dy dz in
  FineDeterminants_distance_within topped S1 S2 S3 S4 S5 S6 S7 S8 S9 A1 A2 A3 A4 A5 A6 A7 A8 A9 B1 B2 B3 B4 B5 B6 B7 B8 B9 G1 G2 G3 tmin tmax = Some t ->
  let det := true_det ax ay az bx by_ bz cx cy cz dx dy dz in
  det <> 0 /\ t = R64 (true_t ax ay az bx by_ bz cx cy cz ox oy oz / det) /\ tmin < t < tmax.
Proof.
  intros F Fs V0 V1 V2. assert (All : F ox /\ F oy /\ F oz /\ F dx /\ F dy /\ F dz) by (repeat match goal with H : Forall _ (_ :: _) |- _ => inversion_clear H end; auto 7).
  destruct All as (F1 & F2 & F3 & F4 & F5 & F6). set (o := Fines (exact ox) (exact oy) (exact oz)). set (d := Fines (exact dx) (exact dy) (exact dz)).
  assert (O : stand o ox oy oz) by (split; [|split]; now apply exact_stands). assert (D : stand d dx dy dz) by (split; [|split]; now apply exact_stands).
  pose proof (determinants_stand v0 v1 v2 o d _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ V0 V1 V2 O D) as (Sd & St & _ & _). pose proof (of_agrees v0 v1 v2 ox oy oz dx dy dz) as A. fold o d in A. set (x := of v0 v1 v2 o d) in *.
  cbv beta iota zeta in A |- *. rewrite A. unfold numbers, parts. cbv beta iota zeta. intros H. pose proof (distance_agrees x tmin tmax t H) as [N I].
  destruct (nearest_is_right _ _ _ _ _ St Sd N) as [Z E]. auto.
Qed.
End Over.

(** [f32::between], with any rounding to floats. [EXACT-10] *)
Theorem between_single_agrees x t : let r24 := reals R24 in
  let '((lo, below), (hi, above)) := bounds x in
  f32_between r24 moving R24 lo below hi above = Some t -> between_single (bounds x) = Some t.
Proof.
  cbv zeta. destruct (bounds x) as [[lo below] [hi above]]. unfold f32_between, between_single. rewrite !(zero_is : constant moving 0 0 = 0).
  change (less moving) with Rlt_bool. change (before moving) with Intervals.pred. change (after moving) with Intervals.succ. change (equal (reals R24)) with Req_bool.
  assert (Z : forall a, Arithmetic.plus (reals R24) (R24 a) (constant (reals R24) 0 0) = R24 a).
  { intros a. cbn [reals Arithmetic.plus constant]. rewrite Rmult_0_l, Rplus_0_r. apply round_generic; [typeclasses eauto|apply generic_format_round; typeclasses eauto]. }
  rewrite !Z. exact (fun H => H).
Qed.
