(** The order of two hits whose rounded distances are equal: EXACT-13. [Crossing] of src/geom/kernel/exact/order.rs finds equal distances without
    computing them, and compares others as quotients. *)
Require Import Reals ZArith NArith List Lia Lra Bool.
From Flocq Require Import Core.
Require Import StacklessExact.Filter StacklessExact.Expansion StacklessExact.Fine StacklessExact.FineSums StacklessExact.FineProducts StacklessExact.Answer.
Import ListNotations.
Open Scope R_scope.

(** * Equal distances *)

Section Ray.
Variables o d : vec.
Notation T v := (top_t (truth v o d)).
Notation D v := (det (truth v o d)).
Definition distance (v : triangle) : R := T v / D v.
Definition corners (v : triangle) : list vec := let '(a, b, c) := v in [a; b; c].

Ltac expand := cbn [truth determinants_of det top_t edge_u edge_v edge_w]; unfold exactly, vsub, dot, cross; cbn [vx vy vz].

(** Corners in another order change both determinants alike. *)
Definition alike (v v' : triangle) : Prop := exists s, (s = 1 \/ s = -1) /\ T v' = s * T v /\ D v' = s * D v.
Ltac alike := first [exists 1; split; [now left|]; split; expand; ring|exists (-1); split; [now right|]; split; expand; ring].

Lemma alike_distance v v' : alike v v' -> D v <> 0 -> distance v' = distance v.
Proof. intros (s & S & H & K) N. unfold distance. rewrite H, K. destruct S as [-> | ->]; field; lra. Qed.

(** Triangles of the same corners, in any order, have one distance. [EXACT-13] *)
Theorem same_corners v v' : incl (corners v) (corners v') -> D v <> 0 -> distance v' = distance v.
Proof.
  intros H N. apply alike_distance; [|exact N]. destruct v as [[a b] c], v' as [[x y] z]. cbn [corners] in H.
  assert (Ha : In a [x; y; z]) by (apply H; cbn; tauto). assert (Hb : In b [x; y; z]) by (apply H; cbn; tauto).
  assert (Hc : In c [x; y; z]) by (apply H; cbn; tauto). clear H.
  destruct Ha as [<-|[<-|[<-|[]]]], Hb as [<-|[<-|[<-|[]]]], Hc as [<-|[<-|[<-|[]]]]; first [exfalso; apply N; expand; ring|alike].
Qed.

(** The edge function of EXACT-2. *)
Definition edge (a b : vec) : R := dot exactly d (cross exactly (vsub exactly a o) (vsub exactly b o)).

(** [EXACT-2] *)
Theorem edges_are a b c : let x := truth (a, b, c) o d in edge_u x = - edge c a /\ edge_v x = - edge a b /\ edge_w x = - edge b c.
Proof. unfold edge. repeat split; expand; ring. Qed.

Lemma of_edge a b v : In a (corners v) -> In b (corners v) -> a <> b -> exists c, alike (a, b, c) v.
Proof.
  destruct v as [[x y] z]. intros Ha Hb N.
  destruct Ha as [<-|[<-|[<-|[]]]], Hb as [<-|[<-|[<-|[]]]]; try contradiction; [exists z|exists y|exists z|exists x|exists y|exists x]; alike.
Qed.

(** Triangles with a common edge that the line meets have one distance. [EXACT-13] *)
Theorem same_edge a b v v' : a <> b -> In a (corners v) -> In b (corners v) -> In a (corners v') -> In b (corners v') -> edge a b = 0 ->
  D v <> 0 -> D v' <> 0 -> distance v = distance v'.
Proof.
  intros Ab A B A' B' E N N'. destruct (of_edge a b v A B Ab) as [c H], (of_edge a b v' A' B' Ab) as [c' H'].
  assert (Nc : forall w, alike w v -> D w <> 0) by (intros w (s & _ & _ & K) Z; apply N; rewrite K, Z; ring).
  assert (Nc' : forall w, alike w v' -> D w <> 0) by (intros w (s & _ & _ & K) Z; apply N'; rewrite K, Z; ring).
  rewrite (alike_distance _ _ H (Nc _ H)), (alike_distance _ _ H' (Nc' _ H')). specialize (Nc _ H). specialize (Nc' _ H').
  assert (K : T (a, b, c) * D (a, b, c') - T (a, b, c') * D (a, b, c) =
    edge a b * dot exactly (vsub exactly b a) (cross exactly (vsub exactly c' a) (vsub exactly c a))) by (unfold edge; expand; ring).
  rewrite E, Rmult_0_l in K. unfold distance. apply Rmult_eq_reg_r with (D (a, b, c) * D (a, b, c')); [|now apply Rmult_integral_contrapositive].
  field_simplify; [lra|exact Nc'|exact Nc].
Qed.

(** The line passes through a point: as it is seen from the origin, it is along the direction. *)
Definition is_through (p : vec) : Prop := cross exactly d (vsub exactly p o) = Vec 0 0 0.

Definition axes : list (vec -> R) := [vx; vy; vz].

Lemma by_axis (axis : vec -> R) x v : axis d <> 0 -> D v <> 0 -> T v * axis d = (x - axis o) * D v -> distance v = (x - axis o) / axis d.
Proof.
  intros N M H. unfold distance. apply Rmult_eq_reg_r with (D v * axis d); [|now apply Rmult_integral_contrapositive]. field_simplify; [lra|exact N|exact M].
Qed.

Lemma of_corner p v : In p (corners v) -> exists b c, alike (p, b, c) v.
Proof. destruct v as [[x y] z]. intros [<-|[<-|[<-|[]]]]; [exists y, z|exists x, z|exists x, y]; alike. Qed.

Lemma some_axis v : D v <> 0 -> exists axis, In axis axes /\ axis d <> 0.
Proof.
  intros N. destruct (Req_dec (vx d) 0) as [X|X]; [|exists vx; cbn; tauto]. destruct (Req_dec (vy d) 0) as [Y|Y]; [|exists vy; cbn; tauto].
  exists vz. split; [cbn; tauto|]. intros Z. apply N. destruct v as [[a b] c]. expand. rewrite X, Y, Z. ring.
Qed.

(** So have triangles with a common corner that the line passes through. [EXACT-13] *)
Theorem same_corner p v v' : In p (corners v) -> In p (corners v') -> is_through p -> D v <> 0 -> D v' <> 0 -> distance v = distance v'.
Proof.
  intros P P' Th N N'. destruct (some_axis v N) as (axis & A & M).
  assert (At : forall w, In p (corners w) -> D w <> 0 -> distance w = (axis p - axis o) / axis d); [|now rewrite (At v), (At v')].
  intros w Pw Nw. destruct (of_corner p w Pw) as (b & c & H).
  assert (Nb : D (p, b, c) <> 0) by (destruct H as (s & _ & _ & K); intros Z; apply Nw; rewrite K, Z; ring).
  rewrite (alike_distance _ _ H Nb). apply by_axis; [exact M|exact Nb|].
  assert (Q : exists unit, T (p, b, c) * axis d - (axis p - axis o) * D (p, b, c) =
    dot exactly (vsub exactly b p) (cross exactly (cross exactly (cross exactly d (vsub exactly p o)) unit) (vsub exactly c p))).
  { destruct A as [<-|[<-|[<-|[]]]]; [exists (Vec 1 0 0)|exists (Vec 0 1 0)|exists (Vec 0 0 1)]; expand; ring. }
  destruct Q as [unit Q]. rewrite Th in Q. apply Rminus_diag_uniq. rewrite Q. expand. ring.
Qed.

(** So have triangles in one plane across an axis. [EXACT-13] *)
Theorem same_plane (axis : vec -> R) x v v' : In axis axes -> (forall p, In p (corners v ++ corners v') -> axis p = x) -> D v <> 0 -> D v' <> 0 ->
  distance v = distance v'.
Proof.
  intros A H N N'.
  assert (At : forall w, (forall p, In p (corners w) -> axis p = x) -> D w <> 0 -> distance w = (x - axis o) / axis d).
  2:{ rewrite (At v), (At v'); try assumption; [reflexivity|..]; intros p Hp; apply H, in_or_app; tauto. }
  clear - A. intros [[a b] c] H N. pose proof (H a) as Ha. pose proof (H b) as Hb. pose proof (H c) as Hc. cbn [corners In] in Ha, Hb, Hc.
  specialize (Ha (or_introl eq_refl)). specialize (Hb (or_intror (or_introl eq_refl))). specialize (Hc (or_intror (or_intror (or_introl eq_refl)))). clear H.
  apply by_axis; [|exact N|]; [intros Z; apply N|]; destruct A as [<-|[<-|[<-|[]]]]; expand; rewrite ?Ha, ?Hb, ?Hc, ?Z; ring.
Qed.

(** [Crossing::is_met_with]. *)
Definition is_met_with (v v' : triangle) : Prop := incl (corners v) (corners v') \/
  (exists a b, a <> b /\ In a (corners v) /\ In b (corners v) /\ In a (corners v') /\ In b (corners v') /\ edge a b = 0) \/
  (exists p, In p (corners v) /\ In p (corners v') /\ is_through p) \/
  (exists axis x, In axis axes /\ forall p, In p (corners v ++ corners v') -> axis p = x).

Lemma met_at_once v v' : is_met_with v v' -> D v <> 0 -> D v' <> 0 -> distance v = distance v'.
Proof.
  intros [H|[(a & b & Ab & A & B & A' & B' & E)|[(p & P & P' & H)|(axis & x & A & H)]]] N N'.
  - symmetry. now apply same_corners.
  - now apply same_edge with a b.
  - now apply same_corner with p.
  - now apply same_plane with axis x.
Qed.
End Ray.

(** * Quotients *)

(** Products across compare two quotients, the other way round where one divisor is negative. *)
Definition turned (D D' : R) (c : comparison) : comparison := if xorb (Rlt_bool D 0) (Rlt_bool D' 0) then CompOpp c else c.

(** [EXACT-13] *)
Theorem crosswise T D T' D' : D <> 0 -> D' <> 0 -> Rcompare (T / D) (T' / D') = turned D D' (Rcompare (T * D') (T' * D)).
Proof.
  intros N N'. assert (P : forall d, d <> 0 -> 0 < d \/ 0 < - d) by (intros; lra).
  assert (Q : forall t d t' d', 0 < d -> 0 < d' -> Rcompare (t / d) (t' / d') = Rcompare (t * d') (t' * d)).
  { intros t e t' e' E E'. rewrite <- (Rcompare_mult_r (e * e') (t / e)) by now apply Rmult_lt_0_compat. f_equal; field; lra. }
  assert (Neg : forall t d, d <> 0 -> t / d = - t / - d) by (intros; field; lra). unfold turned. rewrite <- Rcompare_sym.
  destruct (P D N) as [H|H], (P D' N') as [H'|H'].
  - rewrite !Rlt_bool_false by lra. now apply Q.
  - rewrite Rlt_bool_false, Rlt_bool_true by lra. cbn [xorb]. rewrite (Neg T' D' N'), Q by assumption.
    rewrite <- (Rcompare_opp (T * D')). f_equal; ring.
  - rewrite Rlt_bool_true, Rlt_bool_false by lra. cbn [xorb]. rewrite (Neg T D N), Q by assumption.
    rewrite <- (Rcompare_opp (T * D')). f_equal; ring.
  - rewrite !Rlt_bool_true by lra. cbn [xorb]. rewrite (Neg T D N), (Neg T' D' N'), Q by assumption. f_equal; ring.
Qed.

(** As whole numbers, which exact sums are, of one unit. [EXACT-8, EXACT-13] *)
Theorem whole_numbers unit m n m' n' : 0 < unit -> n <> 0%Z -> n' <> 0%Z ->
  Rcompare (IZR m * unit / (IZR n * unit)) (IZR m' * unit / (IZR n' * unit)) = turned (IZR n) (IZR n') (m * n' ?= m' * n)%Z.
Proof.
  intros U N N'. apply not_0_IZR in N, N'. rewrite <- Rcompare_IZR, !mult_IZR, <- crosswise by assumption. f_equal; field; lra.
Qed.

(** * Twice the digits *)

(** [FineDeterminants::compare_quotient] of src/geom/kernel/exact/fine.rs. *)
Definition compare_quotient (t d t' d' : fine) : option comparison :=
  match sign (sub (mul t d') (mul t' d)), sign d, sign d' with
  | Some apart, Some s, Some s' => Some (if xorb (Rlt_bool s 0) (Rlt_bool s' 0) then Rcompare 0 apart else Rcompare apart 0)
  | _, _, _ => None
  end.

(** What twice the digits tell is how the quotients compare. [EXACT-13, NEAR-5] *)
Theorem compare_quotient_is_right t d t' d' T D T' D' c : stands t T -> stands d D -> stands t' T' -> stands d' D' -> D <> 0 -> D' <> 0 ->
  compare_quotient t d t' d' = Some c -> c = Rcompare (T / D) (T' / D').
Proof.
  intros St Sd St' Sd' N N'. unfold compare_quotient. destruct (sign (sub _ _)) as [a|] eqn:A; [|discriminate].
  destruct (sign d) as [s|] eqn:S; [|discriminate]. destruct (sign d') as [s'|] eqn:S'; [|discriminate]. intros [= <-].
  pose proof (sign_is_right _ _ _ (sub_stands _ _ _ _ (mul_stands _ _ _ _ St Sd') (mul_stands _ _ _ _ St' Sd)) A) as Ra.
  pose proof (sign_is_right _ _ _ Sd S) as (_ & Rs & _). pose proof (sign_is_right _ _ _ Sd' S') as (_ & Rs' & _).
  assert (E : forall x y, (x < 0 <-> y < 0) -> Rlt_bool y 0 = Rlt_bool x 0).
  { intros x y H. destruct (Rlt_bool_spec y 0), (Rlt_bool_spec x 0); try reflexivity; exfalso; intuition lra. }
  rewrite (crosswise T D T' D' N N'), (E _ _ Rs), (E _ _ Rs'). unfold turned. rewrite (Rcompare_sym 0 a).
  assert (C : Rcompare a 0 = Rcompare (T * D') (T' * D)).
  { destruct (Rcompare_spec a 0), (Rcompare_spec (T * D') (T' * D)); try reflexivity; exfalso; intuition lra. }
  now rewrite C.
Qed.

(** Where bounds are apart they tell it, too. [EXACT-13, NEAR-5] *)
Theorem bounds_tell x y a b : stands x a -> stands y b -> pair_sum (snd (bounds x)) < pair_sum (fst (bounds y)) -> a < b.
Proof. intros X Y. pose proof (bounds_hold x a X) as H. pose proof (bounds_hold y b Y) as K. destruct (bounds x), (bounds y). cbn [fst snd]. lra. Qed.

(** * Together *)

(** [Crossing::compare]: hits that meet at once, twice the digits where they tell, products across. That is a comparison as Answer.v
    supposes. [DET-1, EXACT-13] *)
Theorem steps_are_exact o d tmin tmax mesh kernel (is_equal : N -> N -> bool) (digits : N -> N -> option comparison) : is_exact o d tmin tmax mesh kernel ->
  (forall i j v v', mesh i = Some v -> mesh j = Some v' -> is_equal i j = true -> is_met_with o d v v') ->
  (forall i j v v' c, mesh i = Some v -> mesh j = Some v' -> digits i j = Some c -> exists t f t' f', compare_quotient t f t' f' = Some c /\
    stands t (top_t (truth v o d)) /\ stands f (det (truth v o d)) /\ stands t' (top_t (truth v' o d)) /\ stands f' (det (truth v' o d))) ->
  is_exact_order o d mesh kernel (fun i j => match mesh i, mesh j with
    | Some v, Some v' => let (x, y) := (truth v o d, truth v' o d) in
      if is_equal i j then Eq else match digits i j with Some c => c | None => turned (det x) (det y) (Rcompare (top_t x * det y) (top_t y * det x)) end
    | _, _ => Eq end).
Proof.
  intros K Same Digits i j f g Ef Eg _. pose proof (K i) as Ki. pose proof (K j) as Kj. rewrite Ef in Ki. rewrite Eg in Kj.
  destruct Ki as (t & (v & Ei & (Ni & _) & _) & _), Kj as (t' & (v' & Ej & (Nj & _) & _) & _). unfold exact_t. rewrite Ei, Ej.
  destruct (is_equal i j) eqn:S; [symmetry; apply Rcompare_Eq; exact (met_at_once o d v v' (Same _ _ _ _ Ei Ej S) Ni Nj)|].
  destruct (digits i j) as [c|] eqn:C; [|symmetry; now apply crosswise].
  destruct (Digits _ _ _ _ _ Ei Ej C) as (w & x & w' & x' & Q & Sw & Sx & Sw' & Sx'). exact (compare_quotient_is_right _ _ _ _ _ _ _ _ c Sw Sx Sw' Sx' Ni Nj Q).
Qed.
