(** The count of crossings does not depend on the ray: CLOSED-2 and WINDING-1, for [Solid] of src/trace/solid.rs. *)
Require Import Reals ZArith Lia Lra List Bool.
From Flocq Require Import Core.
Require Import StacklessExact.Filter StacklessExact.Parity StacklessExact.Chains StacklessExact.Fans StacklessExact.Inside.
Import ListNotations.
Open Scope R_scope.

(** * All triangles, from one point *)

(** An edge as seen from m, in the fan from -e, in the direction x. *)
Definition fan (m x e : vec) (g : edge) : Z := spans (opposite e) (less (fst g) m) (less (snd g) m) x.

(** The point is not on the surface, neither direction is on an edge as seen from it, and no vertex is in the plane of the directions. *)
Definition apart (v : vec) (t : triangle) : Prop := let '(a, b, c) := t in vol a b c <> 0 -> off_edges v a b c.
Definition general (m x e : vec) (l : list triangle) : Prop := (forall t, In t l -> ~ contains t m /\ apart x (at_ m t) /\ apart e (at_ m t)) /\
  (forall g, In g (edges l) -> vol e x (less (fst g) m) <> 0 /\ vol e x (less (snd g) m) <> 0).

Lemma less_less a b m : less (less b m) (less a m) = less b a.
Proof. vectors. f_equal; ring. Qed.

Lemma fan_is_difference m x e g w : w <> zero -> along w g = true -> vol e x (less (fst g) m) <> 0 -> vol e x (less (snd g) m) <> 0 ->
  (fan m x e g = up_to (opposite e) x w (less (snd g) m) - up_to (opposite e) x w (less (fst g) m))%Z.
Proof.
  intros W A P Q. assert (V : forall p, vol x (opposite e) p = vol e x p) by (intros; volumes; ring).
  apply fan_along; rewrite ?V; try assumption. now rewrite less_less.
Qed.

Lemma flat_triangle a b c : normal (a, b, c) = zero -> exists w, w <> zero /\ along w (a, b) = true /\ along w (b, c) = true /\ along w (c, a) = true.
Proof.
  intros N. assert (P : parallel (less b a) (less c a) = true) by (apply same_iff; exact N). unfold along, way. cbn [fst snd].
  assert (S : forall p w, parallel (less p a) w = true -> parallel (less a p) w = true).
  { intros p w H. apply same_iff in H. apply same_iff. vectors. injection H as X Y Z. f_equal; lra. }
  assert (T : forall w, parallel (less b a) w = true -> parallel (less c a) w = true -> parallel (less c b) w = true).
  { intros w H K. apply same_iff in H, K. apply same_iff. vectors. injection H as X Y Z. injection K as X' Y' Z'. f_equal; lra. }
  assert (I : forall v, parallel v v = true) by (intros; apply same_iff; vectors; f_equal; ring).
  destruct (same (less b a) zero) eqn:B; [destruct (same (less c a) zero) eqn:C|].
  - apply same_iff in B, C. exists (Vec 1 0 0). split; [intros E; injection E; lra|]. assert (L : forall v, v = zero -> parallel v (Vec 1 0 0) = true) by (intros v ->; apply parallel_zero). auto.
  - apply same_false in C. exists (less c a). auto 6.
  - apply same_false in B. rewrite parallel_sym in P. exists (less b a). auto 6.
Qed.

(** All triangles cover a direction x as often as e and the fan from -e to all their edges together. [WINDING-1](2) *)
Theorem covers_are_fan m x e l : general m x e l ->
  (sum (fun t => covers_of x (at_ m t)) l - sum (fun t => covers_of e (at_ m t)) l = sum (fan m x e) (edges l))%Z.
Proof.
  induction l as [|t l IH]; intros (A & V); [reflexivity|]. unfold edges in *. cbn [sum flat_map] in *. rewrite sum_app, <- IH.
  2: { split; [intros s I; apply A; now right|intros g I; apply V; apply in_or_app; now right]. }
  enough (E : (covers_of x (at_ m t) - covers_of e (at_ m t) = sum (fan m x e) (edges_of t))%Z) by (rewrite <- E; ring).
  destruct t as [[a b] c]. assert (Va := V (a, b)). assert (Vb := V (b, c)). cbn in Va, Vb. destruct Va as (Ha & Hb); [now left|]. destruct Vb as (_ & Hc); [right; now left|].
  cbn [covers_of at_ edges_of sum]. destruct (same (normal (a, b, c)) zero) eqn:N.
  - apply same_iff in N. unfold spans. rewrite (no_area _ _ _ m N), (proj2 (sign_0 0) eq_refl), !agree_0.
    destruct (flat_triangle _ _ _ N) as (w & W & P1 & P2 & P3). rewrite !(fan_is_difference m x e _ w) by assumption. cbn [fst snd]. ring.
  - apply same_false in N. destruct (A (a, b, c) (or_introl eq_refl)) as (Off & Ax & Ae). cbn [apart at_] in Ax, Ae.
    destruct (Req_dec (vol (less a m) (less b m) (less c m)) 0) as [D|D].
    + unfold spans. rewrite D, (proj2 (sign_0 0) eq_refl), !agree_0.
      pose proof (plane_is_no_fan (less a m) (less b m) (less c m) e x) as T. cbv zeta in T. rewrite !less_less in T. specialize (T D N). unfold fan. cbn [fst snd].
      rewrite Z.add_0_r, Z.add_assoc. rewrite T; [reflexivity| |assumption..]. intros (u & v & U & V' & W & E). apply Off. split; [exact N|]. exists u, v. repeat split; try assumption.
      clear -E. destruct a as [a1 a2 a3], b as [b1 b2 b3], c as [c1 c2 c3], m as [m1 m2 m3]. vectors. injection E as X Y Z. f_equal; lra.
    + pose proof (triangle_is_fan (less a m) (less b m) (less c m) e x D Ha Hb Hc (Ax D) (Ae D)) as T. cbv zeta in T. rewrite T. unfold fan. cbn [fst snd]. ring.
Qed.

(** If edges balance on each line, wherever vertices divide them, the fan adds up to 0, or for parity to an even number. [WINDING-1, CLOSED-2] *)
Theorem fan_vanishes k m x e l : balanced k (edges l) -> general m x e l -> (k | sum (fan m x e) (edges l))%Z.
Proof.
  intros B (_ & V). apply (adds_up k _ (fun w p => up_to (opposite e) x w (less p m))); [|exact B].
  intros g w I W A. destruct (V g I). now apply fan_is_difference.
Qed.

(** * A point and directions in general position *)

Lemma some_is_not_0 d n : n <> zero -> ~ Forall (fun x => x = 0) [d; - vx n; - vy n; - vz n].
Proof.
  destruct n as [n1 n2 n3]. cbn. intros N F. apply N. inversion_clear F as [|? ? _ F1]. inversion_clear F1 as [|? ? F2 F3].
  inversion_clear F3 as [|? ? F4 F5]. inversion_clear F5 as [|? ? F6 _]. unfold zero. f_equal; lra.
Qed.

Lemma has_volume o a b c : normal (a, b, c) <> zero -> small (fun e => vol (less a (moved o e)) (less b (moved o e)) (less c (moved o e)) <> 0).
Proof. intros N. eapply small_imp; [intros e E; rewrite volume_moves; exact E|]. now apply small_poly, some_is_not_0. Qed.

Lemma beyond_edge o x a b c : x <> zero -> normal (a, b, c) <> zero -> small (fun e => let m := moved o e in
  vol x (less a m) (less b m) = 0 -> vol x (less b m) (less c m) * vol x (less c m) (less a m) < 0).
Proof.
  intros X N. pose proof (has_volume o a b c N) as S.
  eapply small_imp; [|exact (small_and _ _ S (rule_is_move o x a b))]. cbv beta. intros e (D & E) m Z. fold m in D.
  change (sign (vol x (less a m) (less b m)) = edge_sign o x a b) in E. rewrite Z, (proj2 (sign_0 0) eq_refl) in E.
  symmetry in E. unfold edge_sign in E. apply first_sign_0 in E. inversion_clear E as [|? ? _ E1]. inversion_clear E1 as [|? ? E2 E3]. inversion_clear E3 as [|? ? E4 E5]. inversion_clear E5 as [|? ? E6 _].
  assert (P : parallel (less a b) x = true).
  { apply same_iff. vectors. f_equal; assumption. }
  destruct (multiple _ _ X P) as (s & Q). assert (Ea : less a m = more (less b m) (scale s x)).
  { replace (less a m) with (more (less b m) (less a b)) by (vectors; f_equal; ring). now rewrite Q. }
  rewrite Ea in *. set (v := vol x (less b m) (less c m)) in *. replace (vol x (less c m) (more (less b m) (scale s x))) with (- v) by (unfold v; volumes; ring).
  replace (vol (more (less b m) (scale s x)) (less b m) (less c m)) with (s * v) in D by (unfold v; volumes; ring).
  assert (v <> 0) by (intros V; apply D; rewrite V; ring). replace (v * - v) with (- (v * v)) by ring. assert (0 < v * v) by (destruct (Rdichotomy v 0); try assumption; [replace (v * v) with (- v * - v) by ring|]; apply Rmult_lt_0_compat; lra). lra.
Qed.

Lemma off_lines o x p : x <> zero -> small (fun e => cross3 x (less p (moved o e)) <> zero).
Proof.
  intros X. set (c := cross3 x (less p o)). assert (Q : ~ (vx x = 0 /\ vy x = 0) \/ vz x <> 0).
  { destruct (Req_dec (vz x) 0) as [Z|Z]; [left|now right]. intros (A & B). apply X. destruct x as [x1 x2 x3]. cbn in *. subst. reflexivity. }
  destruct Q as [Q|Q].
  - eapply small_imp; [|apply (small_poly [vz c; vy x; - vx x])].
    + intros e E Z. apply E. transitivity (vz (cross3 x (less p (moved o e)))); [unfold c, moved; vectors; cbn [poly]; ring|now rewrite Z].
    + intros F. inversion_clear F as [|? ? _ F1]. inversion_clear F1 as [|? ? F2 F3]. inversion_clear F3 as [|? ? F4 _]. apply Q. split; lra.
  - eapply small_imp; [|apply (small_poly [vy c; - vz x; 0; vx x])].
    + intros e E Z. apply E. transitivity (vy (cross3 x (less p (moved o e)))); [unfold c, moved; vectors; cbn [poly]; ring|now rewrite Z].
    + intros F. inversion_clear F as [|? ? _ F1]. inversion_clear F1 as [|? ? F2 _]. apply Q. lra.
Qed.

Lemma off_plane a b c m : vol (less a m) (less b m) (less c m) <> 0 -> ~ contains (a, b, c) m.
Proof. intros D (_ & u & v & _ & _ & _ & E). apply D. subst m. exact_values. ring. Qed.

Lemma rotated a b c : normal (b, c, a) = normal (a, b, c) /\ normal (c, a, b) = normal (a, b, c).
Proof. exact_values. split; f_equal; ring. Qed.

(** What a direction needs of the point, and has from a moved one. *)
Definition clear (m x : vec) (l : list triangle) : Prop := (forall t, In t l -> normal t <> zero -> let '(a, b, c) := at_ m t in vol a b c <> 0 /\ off_edges x a b c) /\
  (forall g, In g (edges l) -> cross3 x (less (fst g) m) <> zero /\ cross3 x (less (snd g) m) <> zero).

Lemma moved_is_clear o x l : x <> zero -> small (fun e => clear (moved o e) x l).
Proof.
  intros X. apply small_and.
  - apply (small_all (fun t e => normal t <> zero -> let '(a, b, c) := at_ (moved o e) t in vol a b c <> 0 /\ off_edges x a b c)).
    intros [[a b] c] _. destruct (same (normal (a, b, c)) zero) eqn:N; [apply same_iff in N; apply small_true; intros; contradiction|]. apply same_false in N.
    pose proof (has_volume o a b c N) as S.
    destruct (rotated a b c) as (R1 & R2). pose proof (beyond_edge o x a b c X N) as K1. rewrite <- R1 in N. pose proof (beyond_edge o x b c a X N) as K2.
    rewrite R1, <- R2 in N. pose proof (beyond_edge o x c a b X N) as K3. cbv zeta in K1, K2, K3.
    eapply small_imp; [|exact (small_and _ _ S (small_and _ _ K1 (small_and _ _ K2 K3)))]. cbv beta. intros e (D & H1 & H2 & H3) _. cbn [at_].
    assert (K : forall d p q, p * q < 0 -> ~ (0 < d * p /\ 0 < d * q)).
    { intros d p q S' (P & Q). pose proof (Rmult_lt_0_compat _ _ P Q) as R. replace (d * p * (d * q)) with (d * d * (p * q)) in R by ring. pose proof (Rle_0_sqr d) as L. unfold Rsqr in L.
      assert (0 <= d * d * - (p * q)) by (apply Rmult_le_pos; lra). lra. }
    split; [exact D|]. split; [|split]; intros Z; apply K; [exact (H2 Z)|specialize (H3 Z); lra|exact (H1 Z)].
  - apply (small_all (fun (g : edge) e => cross3 x (less (fst g) (moved o e)) <> zero /\ cross3 x (less (snd g) (moved o e)) <> zero)).
    intros g _. apply small_and; now apply off_lines.
Qed.

Lemma some_general m xs l : (forall x, In x xs -> clear m x l) -> xs <> [] -> exists e, forall x, In x xs -> general m x e l.
Proof.
  intros H Some. set (real := filter (fun t => negb (same (normal t) zero)) l).
  set (sides := flat_map (fun t => let '(a, b, c) := at_ m t in [cross3 a b; cross3 b c; cross3 c a]) real).
  set (rest := flat_map (fun x => flat_map (fun g : edge => [cross3 x (less (fst g) m); cross3 x (less (snd g) m)]) (edges l)) xs).
  assert (In_real : forall t, In t real <-> In t l /\ normal t <> zero).
  { intros t. unfold real. rewrite filter_In, negb_true_iff, same_false. reflexivity. }
  destruct (some_direction (sides ++ rest)) as (e & E).
  - intros v I. apply in_app_or in I. destruct I as [I|I].
    + destruct xs as [|x xs]; [contradiction|]. destruct (H x (or_introl eq_refl)) as (A & _). unfold sides in I. apply in_flat_map in I. destruct I as (t & I & J). apply In_real in I. destruct I as (I & N).
      specialize (A t I N). destruct t as [[a b] c]. cbn [at_] in *. destruct A as (D & _). intros Z. apply D.
      assert (L : forall u, dot3 u zero = 0) by (intros; vectors; ring).
      destruct J as [J|[J|[J|[]]]]; subst v;
        [replace (vol (less a m) (less b m) (less c m)) with (dot3 (less c m) (cross3 (less a m) (less b m))) by (volumes; ring)
        |replace (vol (less a m) (less b m) (less c m)) with (dot3 (less a m) (cross3 (less b m) (less c m))) by (volumes; ring)
        |replace (vol (less a m) (less b m) (less c m)) with (dot3 (less b m) (cross3 (less c m) (less a m))) by (volumes; ring)]; rewrite Z; apply L.
    + unfold rest in I. apply in_flat_map in I. destruct I as (x & I & J). apply in_flat_map in J. destruct J as (g & J & K). destruct (H x I) as (_ & B). specialize (B g J).
      destruct K as [<-|[<-|[]]]; apply B.
  - exists e. intros x I. destruct (H x I) as (A & B). split.
    + intros t J. destruct (same (normal t) zero) eqn:N.
      { apply same_iff in N. destruct t as [[a b] c]. split; [intros (C & _); contradiction|]. split; intros D; exfalso; apply D; now apply no_area. }
      apply same_false in N. specialize (A t J N). split; [destruct t as [[a b] c]; exact (off_plane _ _ _ _ (proj1 A))|]. pose proof (proj2 (In_real t) (conj J N)) as R. unfold apart.
      assert (S : forall v, In v (let '(a, b, c) := at_ m t in [cross3 a b; cross3 b c; cross3 c a]) -> dot3 e v <> 0).
      { intros v K. apply E. apply in_or_app. left. apply in_flat_map. exists t. now split. }
      destruct (at_ m t) as [[a b] c]. destruct A as (D & A). split; [intros _; exact A|]. intros _.
      assert (S1 : vol e a b <> 0) by (apply S; now left). assert (S2 : vol e b c <> 0) by (apply S; right; now left). assert (S3 : vol e c a <> 0) by (apply S; right; right; now left).
      split; [|split]; intros Z; contradiction.
    + intros g J. assert (S : forall v, In v [cross3 x (less (fst g) m); cross3 x (less (snd g) m)] -> dot3 e v <> 0).
      { intros v K. apply E. apply in_or_app. right. apply in_flat_map. exists x. split; [exact I|]. apply in_flat_map. exists g. now split. }
      split; apply S; [now left|right; now left].
Qed.

(** * Any ray *)

(** In a closed mesh parity does not depend on the ray, and in an oriented mesh the sum of the senses does not: k = 2, and k = 0. [CLOSED-2](3) *)
Theorem rays_agree k l o d d' : balanced k (edges l) -> (forall t, In t l -> ~ contains t o) -> d <> zero -> d' <> zero -> (k | winding o d l - winding o d' l)%Z.
Proof.
  intros B Off X X'. assert (C : forall x, small (fun e => winding o x l = sum (fun t => covers_of x (at_ (moved o e) t)) l)).
  { intros x. eapply small_imp; [|exact (small_all (fun t e => crossing o x t = covers_of x (at_ (moved o e) t)) l (fun t I => crossing_is_cover o x t (Off t I)))].
    intros e H. now apply sum_ext. }
  destruct (small_and _ _ (small_and _ _ (C d) (C d')) (small_and _ _ (moved_is_clear o d l X) (moved_is_clear o d' l X'))) as (e0 & P & H).
  destruct (H (e0 / 2)) as ((-> & ->) & K & K'); [lra|]. set (m := moved o (e0 / 2)) in *.
  destruct (some_general m [d; d'] l) as (e & E); [intros x [<-|[<-|[]]]; assumption|discriminate|].
  pose proof (E d (or_introl eq_refl)) as G. pose proof (E d' (or_intror (or_introl eq_refl))) as G'.
  pose proof (covers_are_fan m d e l G) as S. pose proof (covers_are_fan m d' e l G') as S'.
  replace (_ - _)%Z with (sum (fan m d e) (edges l) - sum (fan m d' e) (edges l))%Z by (rewrite <- S, <- S'; ring).
  apply Z.divide_sub_r; now apply fan_vanishes.
Qed.
