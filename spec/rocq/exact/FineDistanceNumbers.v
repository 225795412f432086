(** Distances and weights of twice the digits on IEEE 754 doubles of at most 2^200. *)
Require Import Reals ZArith Lia Lra Bool List.
From Flocq Require Import Core BinarySingleNaN.
Require Import StacklessExact.Rounding StacklessExact.Range StacklessExact.Overflow StacklessExact.Arithmetic StacklessExact.Operations.
Require Import StacklessExact.Fine StacklessExact.FineDeterminants StacklessExact.AgreementFine StacklessExact.FineNumbers StacklessExact.FineBack StacklessExact.FineOverNumbers.
Open Scope R_scope.

(** Terms are compared by their operands first. *)
Strategy 1000 [fine_minus fine_cross fine_dot Fine_over Fine_bounds Fine_mul Fine_add Fine_sub Fine_new].

(** * Vectors *)

Definition floats : Type := float * float * float * float * float * float * float * float * float.
(** All parts of a tuple in one step: goals are large here, and each step costs. *)
Lemma by_parts (P : floats -> Prop) : (forall a b c d e f g h i, P (a, b, c, d, e, f, g, h, i)) -> forall p, P p.
Proof. intros H p. now destruct p as [[[[[[[[a b] c] d] e] f] g] h] i]. Qed.
Lemma by_all_parts (P : floats * float * float * float * float * float * float * float * float * float * float * float * float * float * float * float * float * float * float * float * float * float * float * float * float * float * float * float * float * float * float -> Prop) :
  (forall f1 f2 f3 f4 f5 f6 f7 f8 f9 s1 s2 s3 s4 s5 s6 s7 s8 s9 a1 a2 a3 a4 a5 a6 a7 a8 a9 b1 b2 b3 b4 b5 b6 b7 b8 b9 g1 g2 g3,
    P (f1, f2, f3, f4, f5, f6, f7, f8, f9, s1, s2, s3, s4, s5, s6, s7, s8, s9, a1, a2, a3, a4, a5, a6, a7, a8, a9, b1, b2, b3, b4, b5, b6, b7, b8, b9, g1, g2, g3)) -> forall p, P p.
Proof. intros H p. now destruct p as [[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[f1 f2] f3] f4] f5] f6] f7] f8] f9] s1] s2] s3] s4] s5] s6] s7] s8] s9] a1] a2] a3] a4] a5] a6] a7] a8] a9] b1] b2] b3] b4] b5] b6] b7] b8] b9] g1] g2] g3]. Qed.
(** The same for a vector that is computed. *)
Ltac parts f x := match goal with |- context [f f64 x ?b ?c ?d ?e ?g ?h ?i ?j ?k ?l ?m ?n ?o ?p ?q ?r ?s] =>
  generalize (f f64 x b c d e g h i j k l m n o p q r s); refine (by_parts _ _) end.
Definition fines_fit (e : Z) (p : floats) (v : fines) : Prop := let '(a, b, c, d, f, g, h, i, j) := p in
  fine_fits e (a, b, c) (fine_x v) /\ fine_fits e (d, f, g) (fine_y v) /\ fine_fits e (h, i, j) (fine_z v).
(** A function of two vectors. *)
Definition at_two {T : Type} (f : float -> float -> float -> float -> float -> float -> float -> float -> float -> float -> float -> float -> float -> float -> float -> float -> float -> float -> T)
  (p q : floats) : T := let '(a, b, c, d, e, g, h, i, j) := p in let '(a', b', c', d', e', g', h', i', j') := q in f a b c d e g h i j a' b' c' d' e' g' h' i' j'.

Lemma minus_fits e p q v w : (0 <= e <= 900)%Z -> fines_fit e p v -> fines_fit e q w -> fines_fit (e + 21) (at_two (fine_minus f64) p q) (minus v w).
Proof.
  destruct p as [[[[[[[[a b] c] d] f] g] h] i] j], q as [[[[[[[[a' b'] c'] d'] f'] g'] h'] i'] j']. intros E (X & Y & Z) (X' & Y' & Z'). unfold at_two, fine_minus.
  pose proof (sub_fits e _ _ _ _ _ _ _ _ E X X') as A. pose proof (sub_fits e _ _ _ _ _ _ _ _ E Y Y') as B. pose proof (sub_fits e _ _ _ _ _ _ _ _ E Z Z') as C.
  destruct (Fine_sub f64 a b c a' b' c') as [[? ?] ?]. destruct (Fine_sub f64 d f g d' f' g') as [[? ?] ?]. destruct (Fine_sub f64 h i j h' i' j') as [[? ?] ?].
  exact (conj A (conj B C)).
Qed.

Lemma two_products_fit e e' a b c a' b' c' d f g d' f' g' x x' y y' : (0 <= e)%Z -> (0 <= e')%Z -> (e + e' <= 830)%Z ->
  fine_fits e (a, b, c) x -> fine_fits e' (a', b', c') x' -> fine_fits e (d, f, g) y -> fine_fits e' (d', f', g') y' ->
  let '(m, m', m'') := Fine_mul f64 a b c a' b' c' in let '(n, n', n'') := Fine_mul f64 d f g d' f' g' in
  fine_fits (e + e' + 91) (Fine_sub f64 m m' m'' n n' n'') (sub (mul x x') (mul y y')) /\ fine_fits (e + e' + 91) (Fine_add f64 m m' m'' n n' n'') (add (mul x x') (mul y y')).
Proof.
  intros E E' S X X' Y Y'. pose proof (mul_fits e e' _ _ _ _ _ _ _ _ E E' ltac:(lia) X X') as M. pose proof (mul_fits e e' _ _ _ _ _ _ _ _ E E' ltac:(lia) Y Y') as N.
  destruct (Fine_mul f64 a b c a' b' c') as [[m m'] m'']. destruct (Fine_mul f64 d f g d' f' g') as [[n n'] n'']. replace (e + e' + 91)%Z with (e + e' + 70 + 21)%Z by ring.
  split; [exact (sub_fits (e + e' + 70) _ _ _ _ _ _ _ _ ltac:(lia) M N)|exact (add_fits (e + e' + 70) _ _ _ _ _ _ _ _ ltac:(lia) M N)].
Qed.

Lemma cross_fits e e' p q v w : (0 <= e)%Z -> (0 <= e')%Z -> (e + e' <= 830)%Z -> fines_fit e p v -> fines_fit e' q w -> fines_fit (e + e' + 91) (at_two (fine_cross f64) p q) (cross v w).
Proof.
  destruct p as [[[[[[[[a b] c] d] f] g] h] i] j], q as [[[[[[[[a' b'] c'] d'] f'] g'] h'] i'] j']. intros E E' S (X & Y & Z) (X' & Y' & Z'). unfold at_two, fine_cross.
  pose proof (two_products_fit e e' _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ E E' S Y Z' Z Y') as A. pose proof (two_products_fit e e' _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ E E' S Z X' X Z') as B.
  pose proof (two_products_fit e e' _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ E E' S X Y' Y X') as C.
  destruct (Fine_mul f64 d f g h' i' j') as [[? ?] ?], (Fine_mul f64 h i j d' f' g') as [[? ?] ?]. destruct (Fine_mul f64 h i j a' b' c') as [[? ?] ?], (Fine_mul f64 a b c h' i' j') as [[? ?] ?].
  destruct (Fine_mul f64 a b c d' f' g') as [[? ?] ?], (Fine_mul f64 d f g a' b' c') as [[? ?] ?]. destruct A as [A _], B as [B _], C as [C _].
  destruct (Fine_sub f64 _ _ _ _ _ _) as [[? ?] ?]. destruct (Fine_sub f64 _ _ _ _ _ _) as [[? ?] ?]. destruct (Fine_sub f64 _ _ _ _ _ _) as [[? ?] ?]. exact (conj A (conj B C)).
Qed.

Lemma dot_fits e e' p q v w : (0 <= e)%Z -> (0 <= e')%Z -> (e + e' <= 800)%Z -> fines_fit e p v -> fines_fit e' q w -> fine_fits (e + e' + 112) (at_two (fine_dot f64) p q) (dot v w).
Proof.
  destruct p as [[[[[[[[a b] c] d] f] g] h] i] j], q as [[[[[[[[a' b'] c'] d'] f'] g'] h'] i'] j']. intros E E' S (X & Y & Z) (X' & Y' & Z'). unfold at_two, fine_dot.
  pose proof (two_products_fit e e' _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ E E' ltac:(lia) X X' Y Y') as A. pose proof (mul_fits e e' _ _ _ _ _ _ _ _ E E' ltac:(lia) Z Z') as M.
  destruct (Fine_mul f64 a b c a' b' c') as [[? ?] ?], (Fine_mul f64 d f g d' f' g') as [[? ?] ?]. destruct A as [_ A]. destruct (Fine_add f64 _ _ _ _ _ _) as [[? ?] ?].
  destruct (Fine_mul f64 h i j h' i' j') as [[? ?] ?]. pose proof (fine_more (e + e' + 70) (e + e' + 91) _ _ ltac:(lia) M) as M'.
  pose proof (add_fits (e + e' + 91) _ _ _ _ _ _ _ _ ltac:(lia) A M') as B. destruct (Fine_add f64 _ _ _ _ _ _) as [[? ?] ?]. replace (e + e' + 112)%Z with (e + e' + 91 + 21)%Z by ring. exact B.
Qed.

Lemma fines_more e e' p v : (e <= e')%Z -> fines_fit e p v -> fines_fit e' p v.
Proof. destruct p as [[[[[[[[a b] c] d] f] g] h] i] j]. intros E (X & Y & Z). split; [|split]; eapply fine_more; eassumption. Qed.

(** * The distance *)

(** Three doubles as numbers of twice the digits. *)
Definition exacts (x y z : float) : floats := let zero := Arithmetic.constant f64 0 0 in (x, zero, zero, y, zero, zero, z, zero, zero).
Lemma exacts_fit x y z a b c : fits 200 x a -> fits 200 y b -> fits 200 z c -> fines_fit 200 (exacts x y z) (Fines (exact a) (exact b) (exact c)).
Proof. intros X Y Z. split; [|split]; (split; [assumption|split; apply zero_fits]). Qed.

(** The numbers of a ray and of corners, none above 2^200. *)
Section Ray.
Variables p0 p1 p2 : floats.
Variables v0 v1 v2 : fines.
Variables ax ay az bx by_ bz cx cy cz : R.
Variables ox oy oz dx dy dz : float.
Hypothesis P0 : fines_fit 200 p0 v0.
Hypothesis P1 : fines_fit 200 p1 v1.
Hypothesis P2 : fines_fit 200 p2 v2.
Hypothesis V0 : stand v0 ax ay az.
Hypothesis V1 : stand v1 bx by_ bz.
Hypothesis V2 : stand v2 cx cy cz.
Hypothesis Us : Forall usual (ox :: oy :: oz :: dx :: dy :: dz :: nil).

Let x := of v0 v1 v2 (Fines (exact (B2R ox)) (exact (B2R oy)) (exact (B2R oz))) (Fines (exact (B2R dx)) (exact (B2R dy)) (exact (B2R dz))).
Let det := true_det ax ay az bx by_ bz cx cy cz (B2R dx) (B2R dy) (B2R dz).

Lemma all_usual : (usual ox /\ usual oy /\ usual oz) /\ usual dx /\ usual dy /\ usual dz.
Proof. repeat match goal with H : Forall _ (_ :: _) |- _ => inversion_clear H end. auto 8. Qed.

Lemma all_stand : stands (FineDeterminants.det x) det /\ stands (t_top x) (true_t ax ay az bx by_ bz cx cy cz (B2R ox) (B2R oy) (B2R oz)) /\
  stands (u_top x) (true_u ax ay az cx cy cz (B2R ox) (B2R oy) (B2R oz) (B2R dx) (B2R dy) (B2R dz)) /\
  stands (v_top x) (true_v ax ay az bx by_ bz (B2R ox) (B2R oy) (B2R oz) (B2R dx) (B2R dy) (B2R dz)).
Proof.
  assert (Fx : forall x : float, generic_format radix2 (FLT_exp (-1074) 53) (B2R x)) by (intros y; exact (generic_format_B2R 53 1024 y)).
  apply determinants_stand; try assumption; (split; [|split]; apply exact_stands, Fx).
Qed.

(** Nothing overflows in them. *)
Lemma all_fit : let '(x1, x2, x3, x4, x5, x6, x7, x8, x9) := p0 in let '(y1, y2, y3, y4, y5, y6, y7, y8, y9) := p1 in let '(z1, z2, z3, z4, z5, z6, z7, z8, z9) := p2 in
  let '(f1, f2, f3, f4, f5, f6, f7, f8, f9, s1, s2, s3, s4, s5, s6, s7, s8, s9, a1, a2, a3, a4, a5, a6, a7, a8, a9, b1, b2, b3, b4, b5, b6, b7, b8, b9, g1, g2, g3) :=
    FineDeterminants_of f64 x1 x2 x3 x4 x5 x6 x7 x8 x9 y1 y2 y3 y4 y5 y6 y7 y8 y9 z1 z2 z3 z4 z5 z6 z7 z8 z9 ox oy oz dx dy dz in
  fines_fit 200 (f1, f2, f3, f4, f5, f6, f7, f8, f9) (d_ x) /\ fines_fit 221 (s1, s2, s3, s4, s5, s6, s7, s8, s9) (s_ x) /\
  fines_fit 221 (a1, a2, a3, a4, a5, a6, a7, a8, a9) (e1 x) /\ fines_fit 221 (b1, b2, b3, b4, b5, b6, b7, b8, b9) (e2 x) /\ fine_fits 845 (g1, g2, g3) (FineDeterminants.det x).
Proof.
  destruct all_usual as (([O1 O1'] & [O2 O2'] & [O3 O3']) & [D1 D1'] & [D2 D2'] & [D3 D3']).
  assert (O : fines_fit 200 (exacts ox oy oz) (Fines (exact (B2R ox)) (exact (B2R oy)) (exact (B2R oz)))) by (apply exacts_fit; split; auto).
  assert (D : fines_fit 200 (exacts dx dy dz) (Fines (exact (B2R dx)) (exact (B2R dy)) (exact (B2R dz)))) by (apply exacts_fit; split; auto).
  pose proof (minus_fits 200 _ _ _ _ ltac:(lia) O P0) as S. pose proof (minus_fits 200 _ _ _ _ ltac:(lia) P1 P0) as A. pose proof (minus_fits 200 _ _ _ _ ltac:(lia) P2 P0) as B.
  pose proof (cross_fits 200 221 _ _ _ _ ltac:(lia) ltac:(lia) ltac:(lia) D B) as C. pose proof (dot_fits 221 512 _ _ _ _ ltac:(lia) ltac:(lia) ltac:(lia) A C) as G.
  revert D S A B C G. clear P0 P1 P2 O. pattern p0; apply by_parts; intros x1 x2 x3 x4 x5 x6 x7 x8 x9; pattern p1; apply by_parts; intros y1 y2 y3 y4 y5 y6 y7 y8 y9; pattern p2; apply by_parts; intros z1 z2 z3 z4 z5 z6 z7 z8 z9.
  unfold FineDeterminants_of, at_two, exacts.
  parts fine_minus ox; intros s1 s2 s3 s4 s5 s6 s7 s8 s9. parts fine_minus y1; intros a1 a2 a3 a4 a5 a6 a7 a8 a9. parts fine_minus z1; intros b1 b2 b3 b4 b5 b6 b7 b8 b9.
  parts fine_cross dx; intros c1 c2 c3 c4 c5 c6 c7 c8 c9. cbv beta iota. intros D S A B _ G. destruct (fine_dot f64 a1 _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _) as [[g1 g2] g3]. exact (conj D (conj S (conj A (conj B G)))).
Qed.

Lemma top_is e p y : fine_fits e p y -> fine_is p y.
Proof. destruct p as [[h l] r]. intros (A & B & C). split; [|split]; eapply fits_is; eassumption. Qed.

(** A distance that the code tells of a ray and of corners that are known within bounds is that of the plane, rounded, and the determinant is not 0.
    Nothing overflows but where nothing is told. [EXACT-3, EXACT-10] *)
Theorem distance_on_doubles_is_right tmin tmax t : let '(x1, x2, x3, x4, x5, x6, x7, x8, x9) := p0 in let '(y1, y2, y3, y4, y5, y6, y7, y8, y9) := p1 in let '(z1, z2, z3, z4, z5, z6, z7, z8, z9) := p2 in
  let '(_, _, _, _, _, _, _, _, _, s1, s2, s3, s4, s5, s6, s7, s8, s9, a1, a2, a3, a4, a5, a6, a7, a8, a9, b1, b2, b3, b4, b5, b6, b7, b8, b9, g1, g2, g3) :=
    FineDeterminants_of f64 x1 x2 x3 x4 x5 x6 x7 x8 x9 y1 y2 y3 y4 y5 y6 y7 y8 y9 z1 z2 z3 z4 z5 z6 z7 z8 z9 ox oy oz dx dy dz in
  FineDeterminants_distance_within f64 s1 s2 s3 s4 s5 s6 s7 s8 s9 a1 a2 a3 a4 a5 a6 a7 a8 a9 b1 b2 b3 b4 b5 b6 b7 b8 b9 g1 g2 g3 tmin tmax = Some t ->
  det <> 0 /\ B2R t = R64 (true_t ax ay az bx by_ bz cx cy cz (B2R ox) (B2R oy) (B2R oz) / det) /\ Arithmetic.less f64 tmin t = true /\ Arithmetic.less f64 t tmax = true.
Proof.
  destruct all_stand as (Tdet & Tt & _). generalize all_fit. clear P0 P1 P2. pattern p0; apply by_parts; intros x1 x2 x3 x4 x5 x6 x7 x8 x9; pattern p1; apply by_parts; intros y1 y2 y3 y4 y5 y6 y7 y8 y9; pattern p2; apply by_parts; intros z1 z2 z3 z4 z5 z6 z7 z8 z9.
  generalize (FineDeterminants_of f64 x1 x2 x3 x4 x5 x6 x7 x8 x9 y1 y2 y3 y4 y5 y6 y7 y8 y9 z1 z2 z3 z4 z5 z6 z7 z8 z9 ox oy oz dx dy dz). refine (by_all_parts _ _). intros f1 f2 f3 f4 f5 f6 f7 f8 f9 s1 s2 s3 s4 s5 s6 s7 s8 s9 a1 a2 a3 a4 a5 a6 a7 a8 a9 b1 b2 b3 b4 b5 b6 b7 b8 b9 g1 g2 g3 Fit.
  destruct Fit as (_ & S & A & B & G). unfold FineDeterminants_distance_within.
  pose proof (cross_fits 221 221 _ _ _ _ ltac:(lia) ltac:(lia) ltac:(lia) S A) as C. pose proof (dot_fits 221 533 _ _ _ _ ltac:(lia) ltac:(lia) ltac:(lia) B C) as T. unfold at_two in *. clear S A B C.
  destruct (fine_cross f64 s1 _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _) as [[[[[[[[c1 c2] c3] c4] c5] c6] c7] c8] c9].
  destruct (fine_dot f64 b1 _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _) as [[h1 h2] h3].
  pose proof (nearest_on_doubles h1 h2 h3 g1 g2 g3 _ _ _ _ (top_is _ _ _ T) (fine_more 845 900 _ _ ltac:(lia) G) Tt Tdet) as N.
  destruct (Fine_over f64 _ _ _ _ _ _) as [[[k n] n'] n'']. destruct (Fine_bounds f64 _ _ _) as [[[lo ?] hi] ?]. cbv zeta.
  destruct (andb (andb k _) _) eqn:Q; [|discriminate]. intros [= <-]. apply andb_prop in Q as [Q1 Q2]. apply andb_prop in Q2 as [Q2 Q3].
  (* An infinity is not between two ends. *)
  pose proof is_zero_constant as [Zf Zv]. set (zero := Arithmetic.constant f64 0 0) in *.
  assert (Fs : finite (Arithmetic.plus f64 lo zero) = true).
  { destruct (Arithmetic.plus f64 lo zero) as [[]|[]| |[]]; try reflexivity; exfalso; destruct tmin as [[]|[]| |[]], tmax as [[]|[]| |[]]; try discriminate Q2; discriminate Q3. }
  destruct (plus_back _ _ Fs) as (Fl & _ & Vs). destruct (N Q1 Fl) as [Z E]. split; [exact Z|]. split; [|split; assumption].
  rewrite Zv, Rplus_0_r, R64_id in Vs by exact (generic_format_B2R 53 1024 lo). etransitivity; [exact Vs|exact E].
Qed.

(** So are the weights, if they are numbers. [EXACT-10] *)
Theorem weights_on_doubles_are_right : let '(x1, x2, x3, x4, x5, x6, x7, x8, x9) := p0 in let '(y1, y2, y3, y4, y5, y6, y7, y8, y9) := p1 in let '(z1, z2, z3, z4, z5, z6, z7, z8, z9) := p2 in
  let '(f1, f2, f3, f4, f5, f6, f7, f8, f9, s1, s2, s3, s4, s5, s6, s7, s8, s9, a1, a2, a3, a4, a5, a6, a7, a8, a9, b1, b2, b3, b4, b5, b6, b7, b8, b9, g1, g2, g3) :=
    FineDeterminants_of f64 x1 x2 x3 x4 x5 x6 x7 x8 x9 y1 y2 y3 y4 y5 y6 y7 y8 y9 z1 z2 z3 z4 z5 z6 z7 z8 z9 ox oy oz dx dy dz in
  let '(are_known, u, v) := FineDeterminants_weights f64 f1 f2 f3 f4 f5 f6 f7 f8 f9 s1 s2 s3 s4 s5 s6 s7 s8 s9 a1 a2 a3 a4 a5 a6 a7 a8 a9 b1 b2 b3 b4 b5 b6 b7 b8 b9 g1 g2 g3 in
  are_known = true -> finite u = true -> finite v = true ->
  det <> 0 /\ B2R u = R64 (true_u ax ay az cx cy cz (B2R ox) (B2R oy) (B2R oz) (B2R dx) (B2R dy) (B2R dz) / det) /\
  B2R v = R64 (true_v ax ay az bx by_ bz (B2R ox) (B2R oy) (B2R oz) (B2R dx) (B2R dy) (B2R dz) / det).
Proof.
  destruct all_stand as (Tdet & _ & Tu & Tv). generalize all_fit. clear P0 P1 P2. pattern p0; apply by_parts; intros x1 x2 x3 x4 x5 x6 x7 x8 x9; pattern p1; apply by_parts; intros y1 y2 y3 y4 y5 y6 y7 y8 y9; pattern p2; apply by_parts; intros z1 z2 z3 z4 z5 z6 z7 z8 z9.
  generalize (FineDeterminants_of f64 x1 x2 x3 x4 x5 x6 x7 x8 x9 y1 y2 y3 y4 y5 y6 y7 y8 y9 z1 z2 z3 z4 z5 z6 z7 z8 z9 ox oy oz dx dy dz). refine (by_all_parts _ _). intros f1 f2 f3 f4 f5 f6 f7 f8 f9 s1 s2 s3 s4 s5 s6 s7 s8 s9 a1 a2 a3 a4 a5 a6 a7 a8 a9 b1 b2 b3 b4 b5 b6 b7 b8 b9 g1 g2 g3 Fit.
  destruct Fit as (D & S & A & B & G). unfold FineDeterminants_weights.
  pose proof (cross_fits 200 221 _ _ _ _ ltac:(lia) ltac:(lia) ltac:(lia) D B) as C. pose proof (dot_fits 221 512 _ _ _ _ ltac:(lia) ltac:(lia) ltac:(lia) S C) as T.
  pose proof (cross_fits 221 221 _ _ _ _ ltac:(lia) ltac:(lia) ltac:(lia) S A) as C'. pose proof (dot_fits 200 533 _ _ _ _ ltac:(lia) ltac:(lia) ltac:(lia) D C') as T'. unfold at_two in *. clear D S A B C C'.
  destruct (fine_cross f64 f1 _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _) as [[[[[[[[c1 c2] c3] c4] c5] c6] c7] c8] c9]. destruct (fine_cross f64 s1 _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _) as [[[[[[[[k1 k2] k3] k4] k5] k6] k7] k8] k9].
  destruct (fine_dot f64 s1 _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _) as [[h1 h2] h3]. destruct (fine_dot f64 f1 _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _) as [[i1 i2] i3].
  pose proof (nearest_on_doubles h1 h2 h3 g1 g2 g3 _ _ _ _ (top_is _ _ _ T) (fine_more 845 900 _ _ ltac:(lia) G) Tu Tdet) as N.
  pose proof (nearest_on_doubles i1 i2 i3 g1 g2 g3 _ _ _ _ (top_is _ _ _ T') (fine_more 845 900 _ _ ltac:(lia) G) Tv Tdet) as N'.
  destruct (Fine_over f64 h1 _ _ _ _ _) as [[[k n] n'] n'']. destruct (Fine_bounds f64 n _ _) as [[[lo ?] hi] ?].
  destruct (Fine_over f64 i1 _ _ _ _ _) as [[[k' m] m'] m'']. destruct (Fine_bounds f64 m _ _) as [[[lo' ?] hi'] ?]. cbv zeta.
  intros Q Fu Fv. apply andb_prop in Q as [Q Q']. pose proof is_zero_constant as [_ Zv].
  destruct (plus_back _ _ Fu) as (Fl & _ & Vu). destruct (plus_back _ _ Fv) as (Fl' & _ & Vv). destruct (N Q Fl) as [Z E]. destruct (N' Q' Fl') as [_ E'].
  rewrite Zv, Rplus_0_r, R64_id in Vu by exact (generic_format_B2R 53 1024 lo). rewrite Zv, Rplus_0_r, R64_id in Vv by exact (generic_format_B2R 53 1024 lo').
  split; [exact Z|]. split; [etransitivity; [exact Vu|exact E]|etransitivity; [exact Vv|exact E']].
Qed.
End Ray.
