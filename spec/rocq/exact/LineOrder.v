(** [order_of_lines] of src/geom/kernel/exact/predicates.rs, which sorts the edges at a vertex by their lines: CLOSED-1. *)
Require Import Reals ZArith Lia Lra Bool.
From Flocq Require Import Core.
Require Import StacklessExact.Filter StacklessExact.Parity StacklessExact.Chains.
Open Scope R_scope.

(** * The code, for vectors from the vertex *)

Definition moves (x : R) : bool := negb (Req_bool x 0).
Definition slope (ai aj bi bj : R) : comparison :=
  let turn := Rcompare (aj * bi) (bj * ai) in if eqb (Rlt_bool ai 0) (Rlt_bool bi 0) then turn else CompOpp turn.
Definition then_with (c d : comparison) : comparison := match c with Eq => d | _ => c end.
Definition compare_bool (a b : bool) : comparison := match a, b with true, false => Gt | false, true => Lt | _, _ => Eq end.
Definition order_of_lines (a b : vec) : comparison :=
  match moves (vx a), moves (vx b) with
  | true, true => then_with (slope (vx a) (vy a) (vx b) (vy b)) (slope (vx a) (vz a) (vx b) (vz b))
  | false, false => match moves (vy a), moves (vy b) with true, true => slope (vy a) (vz a) (vy b) (vz b) | a, b => compare_bool b a end
  | a, b => compare_bool b a
  end.

(** * Its meaning *)

(** The first axis along which a line goes, and how far it goes along the others meanwhile. *)
Definition place (a : vec) : Z * R * R := if moves (vx a) then (0%Z, vy a / vx a, vz a / vx a) else if moves (vy a) then (1%Z, vz a / vy a, 0) else (2%Z, 0, 0).
Definition compare_places (p q : Z * R * R) : comparison :=
  let '(i, x, y) := p in let '(j, x', y') := q in then_with (Z.compare i j) (then_with (Rcompare x x') (Rcompare y y')).

Lemma moves_is x : moves x = true <-> x <> 0.
Proof. unfold moves. destruct (Req_bool_spec x 0); split; intros; try discriminate; try reflexivity; try assumption; contradiction. Qed.

Lemma slope_is ai aj bi bj : ai <> 0 -> bi <> 0 -> slope ai aj bi bj = Rcompare (aj / ai) (bj / bi).
Proof.
  intros A B. unfold slope. assert (Q : forall x y z, z <> 0 -> x / z = y / z -> x = y) by (intros x y z Z E; apply Rmult_eq_reg_r with (/ z); [exact E|now apply Rinv_neq_0_compat]).
  assert (P : forall x, 0 < x -> 0 < / x) by apply Rinv_0_lt_compat.
  assert (L : forall p q, 0 < p -> 0 < q -> Rcompare (aj * q) (bj * p) = Rcompare (aj / p) (bj / q)).
  { intros p q Hp Hq. replace (aj * q) with (p * q * (aj / p)) by (field; lra). replace (bj * p) with (p * q * (bj / q)) by (field; lra).
    apply Rcompare_mult_l. now apply Rmult_lt_0_compat. }
  destruct (Rlt_bool_spec ai 0) as [Ha|Ha], (Rlt_bool_spec bi 0) as [Hb|Hb]; cbn [eqb].
  - replace (aj * bi) with (- (aj * - bi)) by ring. replace (bj * ai) with (- (bj * - ai)) by ring. rewrite Rcompare_opp. rewrite Rcompare_sym, (L (- ai) (- bi)) by lra. rewrite <- Rcompare_sym, <- Rcompare_opp.
    f_equal; field; lra.
  - replace (bj * ai) with (- (bj * - ai)) by ring. replace (aj * bi) with (- (- aj * bi)) by ring. rewrite Rcompare_opp. rewrite <- Rcompare_sym.
    replace (- aj * bi) with (- ai * bi * (aj / ai)) by (field; lra). replace (bj * - ai) with (- ai * bi * (bj / bi)) by (field; lra). apply Rcompare_mult_l. apply Rmult_lt_0_compat; lra.
  - replace (aj * bi) with (- (ai * - bi * (aj / ai))) by (field; lra). replace (bj * ai) with (- (ai * - bi * (bj / bi))) by (field; lra). rewrite Rcompare_opp, <- Rcompare_sym. apply Rcompare_mult_l. apply Rmult_lt_0_compat; lra.
  - apply L; lra.
Qed.

(** It compares the places of two lines, so it is a total order. [CLOSED-1](3) *)
Theorem order_compares_places a b : order_of_lines a b = compare_places (place a) (place b).
Proof.
  assert (S : forall x, Rcompare x x = Eq) by (intros; now apply Rcompare_Eq).
  unfold order_of_lines, place. destruct (moves (vx a)) eqn:A, (moves (vx b)) eqn:B; try reflexivity; cbn [compare_places Z.compare then_with].
  - apply moves_is in A, B. now rewrite !slope_is.
  - destruct (moves (vy b)); reflexivity.
  - destruct (moves (vy a)); reflexivity.
  - destruct (moves (vy a)) eqn:C, (moves (vy b)) eqn:D; cbn [compare_places compare_bool then_with]; rewrite ?S; try reflexivity.
    apply moves_is in C, D. rewrite slope_is by assumption. cbn. destruct (Rcompare _ _); reflexivity.
Qed.

(** Two lines have one place iff they are one line. [CLOSED-1](3) *)
Theorem equal_is_parallel a b : a <> zero -> b <> zero -> order_of_lines a b = Eq <-> parallel a b = true.
Proof.
  intros Na Nb. rewrite order_compares_places. unfold parallel. rewrite same_iff. destruct a as [a1 a2 a3], b as [b1 b2 b3]. unfold place. vectors.
  assert (E : forall x y, Rcompare x y = Eq <-> x = y) by (intros x y; split; [intros H; destruct (Rcompare_spec x y); try discriminate; assumption|intros ->; now apply Rcompare_Eq]).
  assert (T : forall c d, then_with c d = Eq <-> c = Eq /\ d = Eq) by (intros c d; destruct c; cbn; split; intros; intuition congruence).
  assert (D : forall p q r s, q <> 0 -> s <> 0 -> p / q = r / s <-> p * s = r * q).
  { intros p q r s Q R. split; intros H; [apply Rmult_eq_reg_r with (/ q * / s); [|apply Rmult_integral_contrapositive_currified; now apply Rinv_neq_0_compat]; replace (p * s * (/ q * / s)) with (p / q) by (field; now split); rewrite H; field; now split|].
    apply Rmult_eq_reg_r with (q * s); [|now apply Rmult_integral_contrapositive_currified]. replace (p / q * (q * s)) with (p * s) by (field; exact Q). rewrite H. field. exact R. }
  assert (C : forall x1 x2 x3 y1 y2 y3 : R, Vec x1 x2 x3 = Vec y1 y2 y3 <-> x1 = y1 /\ x2 = y2 /\ x3 = y3) by (intros; split; [intros H; injection H; auto|intros (-> & -> & ->); reflexivity]).
  assert (Z : forall x y, x <> 0 -> y <> 0 -> x * y <> 0) by (intros; now apply Rmult_integral_contrapositive_currified).
  rewrite C. destruct (moves a1) eqn:A, (moves b1) eqn:B; cbn [compare_places]; rewrite ?T.
  - apply moves_is in A, B. rewrite !E, !D by assumption. split.
    + intros (_ & H & K). repeat split; try lra. apply Rmult_eq_reg_l with (a1 * b1); [|now apply Z]. rewrite Rmult_0_r.
      transitivity (a2 * b1 * (a1 * b3) - a3 * b1 * (a1 * b2)); [ring|]. rewrite H, K. ring.
    + intros (H & K & L). repeat split; lra.
  - split; [destruct (moves b2); discriminate|]. intros (_ & H & K). exfalso. apply moves_is in A. unfold moves in B. destruct (Req_bool_spec b1 0) as [-> |]; [|discriminate].
    apply Nb. assert (b2 = 0) by (apply Rmult_eq_reg_l with a1; [lra|exact A]). assert (b3 = 0) by (apply Rmult_eq_reg_l with a1; [lra|exact A]). subst. reflexivity.
  - split; [destruct (moves a2); discriminate|]. intros (_ & H & K). exfalso. apply moves_is in B. unfold moves in A. destruct (Req_bool_spec a1 0) as [-> |]; [|discriminate].
    apply Na. assert (a2 = 0) by (apply Rmult_eq_reg_r with b1; [lra|exact B]). assert (a3 = 0) by (apply Rmult_eq_reg_r with b1; [lra|exact B]). subst. reflexivity.
  - unfold moves in A, B. destruct (Req_bool_spec a1 0) as [-> |]; [|discriminate]. destruct (Req_bool_spec b1 0) as [-> |]; [|discriminate]. clear A B.
    destruct (moves a2) eqn:A, (moves b2) eqn:B; cbn [compare_places]; rewrite ?T.
    + apply moves_is in A, B. rewrite !E, !D by assumption. split; [intros (_ & H & _); repeat split; lra|intros (H & _ & _); repeat split; lra].
    + split; [intros (H & _); discriminate|]. intros (H & _). exfalso. apply moves_is in A. unfold moves in B. destruct (Req_bool_spec b2 0) as [-> |]; [|discriminate].
      apply Nb. assert (b3 = 0) by (apply Rmult_eq_reg_l with a2; [lra|exact A]). subst. reflexivity.
    + split; [intros (H & _); discriminate|]. intros (H & _). exfalso. apply moves_is in B. unfold moves in A. destruct (Req_bool_spec a2 0) as [-> |]; [|discriminate].
      apply Na. assert (a3 = 0) by (apply Rmult_eq_reg_r with b2; [lra|exact B]). subst. reflexivity.
    + unfold moves in A, B. destruct (Req_bool_spec a2 0) as [-> |]; [|discriminate]. destruct (Req_bool_spec b2 0) as [-> |]; [|discriminate].
      split; [intros _; repeat split; ring|]. intros _. repeat split; now apply E.
Qed.
