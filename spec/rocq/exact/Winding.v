(** The winding number of any mesh: WINDING-1, for src/trace/winding.rs. *)
Require Import Reals ZArith Lia Lra List Bool.
From Flocq Require Import Core.
Require Import StacklessExact.Filter StacklessExact.Parity StacklessExact.Chains StacklessExact.Closed StacklessExact.Fans StacklessExact.Inside StacklessExact.InsideRays.
Import ListNotations.
Open Scope R_scope.

Lemma agree_turns a b c d : agree (- a) (- b) (- d) (- c) = (- agree a b c d)%Z.
Proof.
  unfold agree. destruct (Z.eqb_spec a b), (Z.eqb_spec b c), (Z.eqb_spec c d), (Z.eqb_spec (- a) (- b)), (Z.eqb_spec (- b) (- d)), (Z.eqb_spec (- d) (- c)); cbn [andb]; try reflexivity; lia.
Qed.

(** In the other direction an edge counts with the other sign. [WINDING-1] *)
Theorem fan_turns m x e g : fan m x e (reversed g) = (- fan m x e g)%Z.
Proof.
  unfold fan, reversed, spans. cbn [fst snd]. set (a := less (fst g) m). set (b := less (snd g) m). set (f := opposite e).
  replace (vol f b a) with (- vol f a b) by (volumes; ring). replace (vol x b a) with (- vol x a b) by (volumes; ring).
  replace (vol x a f) with (- vol x f a) by (volumes; ring). replace (vol x f b) with (- vol x b f) by (volumes; ring). rewrite !sign_opp. apply agree_turns.
Qed.

Lemma agree_wrong d a b c : d <> 0%Z -> ~ (a = d /\ b = d /\ c = d) -> agree d a b c = 0%Z.
Proof. unfold agree. destruct (Z.eqb_spec d a), (Z.eqb_spec a b), (Z.eqb_spec b c); cbn; try reflexivity. intros _ H. exfalso. apply H. lia. Qed.

Definition no_corner (e : vec) (t : triangle) : Prop := let '(a, b, c) := t in cross3 e a <> zero /\ cross3 e b <> zero /\ cross3 e c <> zero.

(** A ray that passes no edge crosses the triangles that cover its direction, with their senses. [WINDING-1](2) *)
Theorem crossing_covers o e t : ~ contains t o -> apart e (at_ o t) -> no_corner e (at_ o t) -> crossing o e t = covers_of e (at_ o t).
Proof.
  intros Off A No. destruct t as [[a b] c]. pose proof (crossing_is_cover o e _ Off) as C. destruct (same (normal (a, b, c)) zero) eqn:N.
  { apply same_iff in N. destruct C as (x & P & H). rewrite (H (x / 2)) by lra. cbn [covers_of at_]. unfold spans. now rewrite !(no_area _ _ _ _ N), (proj2 (sign_0 0) eq_refl), !agree_0. }
  apply same_false in N. destruct (Req_dec (vol (less a o) (less b o) (less c o)) 0) as [D|D].
  { cbn [covers_of at_]. unfold spans. rewrite D, (proj2 (sign_0 0) eq_refl), agree_0. unfold crossing. destruct (is_crossing o e (a, b, c)) eqn:X; [exfalso|reflexivity].
    apply Off. apply (touching_is_inside o e (a, b, c)). unfold is_crossing in X. cbv zeta in X. rewrite !andb_true_iff, negb_true_iff, !Z.eqb_eq in X. destruct X as (((X1 & X2) & X3) & _).
    destruct (Req_bool_spec (det (determinants_of exactly a b c o e)) 0) as [|X4]; [discriminate|]. cbn [touches]. split; [apply crossed_is_met; now split|].
    rewrite top_is, D, Ropp_0. unfold Rdiv. apply Rmult_0_l. }
  assert (V : small (fun h => sign (vol (less a (moved o h)) (less b (moved o h)) (less c (moved o h))) = sign (vol (less a o) (less b o) (less c o)))).
  { destruct (small_decides [vol (less a o) (less b o) (less c o); - vx (normal (a, b, c)); - vy (normal (a, b, c)); - vz (normal (a, b, c))]) as (h & P & H). exists h. split; [exact P|].
    intros y Y. rewrite volume_moves, (H y Y). unfold sign. cbn [first_sign]. destruct (Rlt_dec (vol (less a o) (less b o) (less c o)) 0), (Rlt_dec 0 (vol (less a o) (less b o) (less c o))); try reflexivity; exfalso; lra. }
  assert (S : forall p q, small (fun h => vol e (less p o) (less q o) <> 0 -> sign (vol e (less p (moved o h)) (less q (moved o h))) = sign (vol e (less p o) (less q o)))).
  { intros p q. eapply small_imp; [|exact (rule_is_move o e p q)]. cbv beta. intros h H Q. rewrite <- !F_is. rewrite H. unfold edge_sign, sign. cbn [first_sign]. rewrite F_is.
    destruct (Rlt_dec (vol e (less p o) (less q o)) 0), (Rlt_dec 0 (vol e (less p o) (less q o))); try reflexivity; exfalso; lra. }
  destruct (small_and _ _ (small_and _ _ C V) (small_and _ _ (S a b) (small_and _ _ (S b c) (S c a)))) as (h & P & H).
  destruct (H (h / 2)) as ((-> & E0) & E1 & E2 & E3); [lra|]. clear H S V C Off N. destruct (A D) as (Ea & Eb & Ec). destruct No as (Na & Nb & Nc). cbv zeta in *. cbn [covers_of at_]. unfold spans. rewrite E0.
  set (a' := less a o) in *. set (b' := less b o) in *. set (c' := less c o) in *.
  assert (L : forall p q r, vol p q r <> 0 -> vol e q r = 0 -> vol e r p = 0 -> cross3 e r = zero).
  { intros p q r V Z1 Z2. assert (Q : scale (vol p q r) e = scale (vol e p q) r).
    { transitivity (more (scale (vol e q r) p) (more (scale (vol e r p) q) (scale (vol e p q) r))); [volumes; f_equal; ring|]. rewrite Z1, Z2. vectors. f_equal; ring. }
    apply same_iff. change (parallel e r = true). replace e with (scale (vol e p q / vol p q r) r); [apply parallel_scale|].
    set (y := vol p q r) in *. set (z := vol e p q) in *. clearbody y z. clear -Q V. destruct e as [e1 e2 e3], r as [r1 r2 r3]. vectors. injection Q as X Y Z.
    f_equal; (apply Rmult_eq_reg_l with y; [|exact V]); field_simplify_eq; try exact V; lra. }
  assert (D1 : vol b' c' a' <> 0) by (intros Z; apply D; rewrite <- Z; volumes; ring). assert (D2 : vol c' a' b' <> 0) by (intros Z; apply D; rewrite <- Z; volumes; ring).
  pose proof (L a' b' c' D) as L1. pose proof (L b' c' a' D1) as L2. pose proof (L c' a' b' D2) as L3. clear L.
  set (d := vol a' b' c') in *. set (ya := vol e b' c') in *. set (yb := vol e c' a') in *. set (yc := vol e a' b') in *. fold ya yb yc in E1, E2, E3.
  set (za := vol e (less b (moved o (h / 2))) (less c (moved o (h / 2)))) in *. set (zb := vol e (less c (moved o (h / 2))) (less a (moved o (h / 2)))) in *. set (zc := vol e (less a (moved o (h / 2))) (less b (moved o (h / 2)))) in *.
  assert (Nd : sign d <> 0%Z) by (rewrite sign_0; exact D).
  assert (W : forall y z, sign y = sign d -> sign z = sign d -> 0 < d * y /\ 0 < d * z).
  { assert (W1 : forall y, sign y = sign d -> 0 < d * y); [|auto]. intros y Y. pose proof (sign_mul d y) as Q. rewrite Y in Q.
    destruct (sign_cases (d * y)) as [(_ & E)|[(_ & E)|(P' & _)]]; [nia|nia|exact P']. }
  destruct (Req_dec ya 0) as [Za|Za]; [|destruct (Req_dec yb 0) as [Zb|Zb]; [|destruct (Req_dec yc 0) as [Zc|Zc]]].
  - specialize (Ea Za). assert (yb <> 0) by (intros Z; apply Nc; auto). assert (yc <> 0) by (intros Z; apply Nb; auto). rewrite E1, E3 by assumption. rewrite !agree_wrong; trivial; [intros (Q & _)|intros (_ & Q1 & Q2); now apply Ea, W].
    rewrite Za, (proj2 (sign_0 0) eq_refl) in Q. congruence.
  - specialize (Eb Zb). assert (yc <> 0) by (intros Z; apply Na; auto). rewrite E1, E2 by assumption. rewrite !agree_wrong; trivial; [intros (_ & Q & _)|intros (Q1 & _ & Q2); now apply Eb, W].
    rewrite Zb, (proj2 (sign_0 0) eq_refl) in Q. congruence.
  - specialize (Ec Zc). rewrite E2, E3 by assumption. rewrite !agree_wrong; trivial; [intros (_ & _ & Q)|intros (Q1 & Q2 & _); now apply Ec, W].
    rewrite Zc, (proj2 (sign_0 0) eq_refl) in Q. congruence.
  - now rewrite E1, E2, E3.
Qed.

(** WINDING-1 for one direction x: the faces cover it as often as the ray along e crosses them, and the fan from -e to the border covers it. The
    border has each edge as often as faces run through it in one direction more than in the other. [WINDING-1](2, 3) *)
Theorem covers_are_crossings_and_border o x e l : general o x e l ->
  sum (fun t => covers_of x (at_ o t)) l = (winding o e l + sum (fun s => net s * fan o x e (line s)) (one_sided (edges l)))%Z.
Proof.
  intros G. pose proof (covers_are_fan o x e l G) as F. rewrite <- (sum_shares (fan o x e)) in F by apply fan_turns. destruct G as (A & V).
  assert (No : forall p, vol e x p <> 0 -> cross3 e p <> zero) by (intros p Q Z; apply Q; transitivity (- dot3 x (cross3 e p)); [volumes; ring|rewrite Z; vectors; ring]).
  replace (winding o e l) with (sum (fun t => covers_of e (at_ o t)) l).
  - unfold one_sided. rewrite sum_filter. rewrite (sum_ext _ (fun s => net s * fan o x e (line s))%Z); [lia|]. intros s _. destruct (Z.eqb_spec (net s) 0) as [-> |]; reflexivity.
  - unfold winding. apply sum_ext. intros t I. symmetry. destruct (A t I) as (Off & _ & Ae). apply crossing_covers; [exact Off|exact Ae|].
    assert (K : forall g, In g (edges_of t) -> In g (edges l)) by (intros g J; apply in_flat_map; now exists t). destruct t as [[a b] c]. cbn [at_ no_corner edges_of] in *.
    pose proof (V (a, b) (K _ (or_introl eq_refl))) as (H1 & H2). pose proof (V (b, c) (K _ (or_intror (or_introl eq_refl)))) as (_ & H3). auto.
Qed.

(** Of an oriented mesh the border adds up to 0, wherever vertices divide its edges: so it is omitted. [WINDING-1, CLOSED-1] *)
Theorem oriented_has_no_border o x e l : general o x e l -> unpaired (edges l) = [] -> sum (fun s => net s * fan o x e (line s))%Z (one_sided (edges l)) = 0%Z.
Proof.
  intros G U. apply is_oriented_is_right in U. pose proof (fan_vanishes 0 o x e l U G) as V. apply Z.divide_0_l in V. rewrite <- (sum_shares (fan o x e)) in V by apply fan_turns.
  rewrite <- V. unfold one_sided. rewrite sum_filter. apply sum_ext. intros s _. destruct (Z.eqb_spec (net s) 0) as [-> |]; reflexivity.
Qed.
