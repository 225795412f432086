(** What a balanced chain covers, and [Boundary::of] of src/trace/boundary.rs: CLOSED-1. *)
Require Import Reals ZArith Lia Lra List Bool.
From Flocq Require Import Core.
Require Import StacklessExact.Filter StacklessExact.Parity StacklessExact.Chains.
Import ListNotations.
Open Scope R_scope.

(** * Covering *)

Definition on_line (x w p : vec) : bool := parallel (less p x) w.
(** How far p is after x in the direction w. *)
Definition after (x w p : vec) : R := dot3 (less p x) w.

(** Whether an edge covers x on the line through x along w: 1 or -1 by its direction. *)
Definition covers (x w : vec) (e : edge) : Z :=
  if along w e && on_line x w (fst e) then Z.b2z (Rlt_bool (after x w (fst e)) 0 && Rlt_bool 0 (after x w (snd e))) - Z.b2z (Rlt_bool (after x w (snd e)) 0 && Rlt_bool 0 (after x w (fst e)))
  else 0%Z.

Definition no_end (x : vec) (l : list edge) : Prop := forall e, In e l -> fst e <> x /\ snd e <> x.
Definition before (x w p : vec) : Z := Z.b2z (on_line x w p && Rlt_bool (after x w p) 0).

Lemma length_pos w : w <> zero -> 0 < dot3 w w.
Proof.
  destruct w as [a b c]. intros N. vectors. pose proof (Rle_0_sqr a) as A. pose proof (Rle_0_sqr b) as B. pose proof (Rle_0_sqr c) as C. unfold Rsqr in *.
  destruct (Req_dec (a * a + b * b + c * c) 0) as [E|]; [exfalso|lra]. apply N. assert (Q : forall x, x * x = 0 -> x = 0) by (intros x H; destruct (Rmult_integral _ _ H); assumption).
  f_equal; apply Q; lra.
Qed.

Lemma on_line_along x w e : along w e = true -> on_line x w (snd e) = on_line x w (fst e).
Proof.
  intros A. destruct (on_line x w (fst e)) eqn:E; [|destruct (on_line x w (snd e)) eqn:F; [|reflexivity]; exfalso; assert (on_line x w (fst e) = true); [|congruence]].
  - apply same_iff in A, E. apply same_iff. unfold way in A. vectors. injection A as X Y Z. injection E as X' Y' Z'. f_equal; lra.
  - apply same_iff in A, F. apply same_iff. unfold way in A. vectors. injection A as X Y Z. injection F as X' Y' Z'. f_equal; lra.
Qed.

Lemma at_itself x w p : w <> zero -> on_line x w p = true -> after x w p = 0 -> p = x.
Proof.
  intros W L A. destruct (multiple _ _ W L) as (s & E). unfold after in A. rewrite E in A. replace (dot3 (scale s w) w) with (s * dot3 w w) in A by (vectors; ring).
  pose proof (length_pos w W). assert (s = 0) by (destruct (Rmult_integral _ _ A); lra). subst s. destruct p as [p1 p2 p3], x as [x1 x2 x3]. vectors. injection E as X Y Z. f_equal; lra.
Qed.

Lemma covers_is_before x w e : w <> zero -> fst e <> x -> snd e <> x -> covers x w e = (if along w e then before x w (fst e) - before x w (snd e) else 0)%Z.
Proof.
  intros W A B. unfold covers, before. destruct (along w e) eqn:E; [|reflexivity]. cbn [andb]. rewrite (on_line_along _ _ _ E). destruct (on_line x w (fst e)) eqn:L; [|reflexivity].
  assert (after x w (fst e) <> 0) by (intros Z; apply A; now apply at_itself with w). assert (after x w (snd e) <> 0) by (intros Z; apply B; apply at_itself with w; trivial; now rewrite on_line_along).
  repeat match goal with |- context [Rlt_bool ?a ?b] => destruct (Rlt_bool_spec a b) end; cbn; try reflexivity; exfalso; lra.
Qed.

(** Numbers that are not 0 stay apart from 0. *)
Lemma gap l : exists d, 0 < d /\ forall x, In x l -> x <> 0 -> d < Rabs x.
Proof.
  induction l as [|x l (d & P & H)]; [exists 1; split; [lra|intros x []]|]. destruct (Req_dec x 0) as [-> |N].
  - exists d. split; [exact P|]. intros y [<-|I] Y; [contradiction|auto].
  - assert (0 < Rabs x) by now apply Rabs_pos_lt. exists (Rmin d (Rabs x / 2)). pose proof (Rmin_l d (Rabs x / 2)). pose proof (Rmin_r d (Rabs x / 2)). split; [apply Rmin_glb_lt; lra|].
    intros y [<-|I] Y; [lra|]. specialize (H y I Y). lra.
Qed.

(** On each line the edges cover every point that is no end an even number of times (k = 2), or equally often in both directions (k = 0), iff
    an even number of them end at each point, or equal numbers begin and end there. [CLOSED-1](1, 4) *)
Theorem balanced_iff_covered k l : balanced k l <-> forall x w, w <> zero -> no_end x l -> (k | sum (covers x w) l)%Z.
Proof.
  split.
  - intros B x w W N. rewrite (sum_ext _ (fun e => if along w e then - before x w (snd e) - - before x w (fst e) else 0)%Z).
    + now apply (differences k (fun p => - before x w p)%Z).
    + intros e I. destruct (N e I). rewrite covers_is_before by assumption. destruct (along w e); [ring|reflexivity].
  - intros H p w W. pose proof (length_pos w W) as L. destruct (gap (flat_map (fun e : edge => [after p w (fst e); after p w (snd e)]) l)) as (d & D & G).
    set (h := d / 2 / dot3 w w). assert (Hh : h * dot3 w w = d / 2) by (unfold h; field; lra).
    assert (Far : forall e, In e l -> (after p w (fst e) = 0 \/ d < Rabs (after p w (fst e))) /\ (after p w (snd e) = 0 \/ d < Rabs (after p w (snd e)))).
    { intros e I. split; (destruct (Req_dec (after p w (fst e)) 0), (Req_dec (after p w (snd e)) 0); auto; right; apply G; auto; apply in_flat_map; exists e; cbn; auto). }
    assert (Moves : forall s q, after (more p (scale s w)) w q = after p w q - s * dot3 w w) by (intros; unfold after; vectors; ring).
    assert (Lines : forall s q, on_line (more p (scale s w)) w q = on_line p w q).
    { intros s q. unfold on_line, parallel. f_equal. vectors. f_equal; ring. }
    assert (None : forall s, s = h \/ s = - h -> no_end (more p (scale s w)) l).
    { intros s Hs e I. destruct (Far e I) as (A & C). assert (K : forall q, after p w q = 0 \/ d < Rabs (after p w q) -> q <> more p (scale s w)).
      { intros q Q ->. replace (after p w (more p (scale s w))) with (s * dot3 w w) in Q by (unfold after; vectors; ring).
        destruct Hs as [-> | ->]; [|replace (- h * dot3 w w) with (- (h * dot3 w w)) in Q by ring; rewrite Rabs_Ropp in Q]; rewrite Hh in Q; rewrite Rabs_pos_eq in Q by lra; lra. }
      split; now apply K. }
    pose proof (H _ w W (None h (or_introl eq_refl))) as H1. pose proof (H _ w W (None (- h) (or_intror eq_refl))) as H2.
    replace (sum (begins p w) l) with (sum (covers (more p (scale h w)) w) l - sum (covers (more p (scale (- h) w)) w) l)%Z; [now apply Z.divide_sub_r|].
    unfold Z.sub at 1. rewrite <- sum_opp, <- sum_plus. apply sum_ext. intros e I. destruct (None h (or_introl eq_refl) e I) as (N1 & N2). destruct (None (- h) (or_intror eq_refl) e I) as (N3 & N4).
    rewrite !covers_is_before by assumption. unfold begins. destruct (along w e); [|reflexivity].
    assert (One : forall q, after p w q = 0 \/ d < Rabs (after p w q) -> (before (more p (scale h w)) w q - before (more p (scale (- h) w)) w q = Z.b2z (same q p))%Z).
    { intros q Q. unfold before. rewrite !Lines, !Moves. replace (- h * dot3 w w) with (- (d / 2)) by (rewrite <- Hh; ring). rewrite Hh. destruct (same q p) eqn:S.
      - apply same_iff in S. subst q. replace (after p w p) with 0 by (unfold after; vectors; ring). replace (on_line p w p) with true by (symmetry; apply same_iff; vectors; f_equal; ring).
        rewrite Rlt_bool_true, Rlt_bool_false by lra. reflexivity.
      - apply same_false in S. destruct (on_line p w q) eqn:O; [|reflexivity]. assert (after p w q <> 0) by (intros Z; apply S; now apply at_itself with w).
        destruct Q as [Q|Q]; [contradiction|]. unfold Rabs in Q. destruct (Rcase_abs (after p w q)); repeat match goal with |- context [Rlt_bool ?a ?b] => destruct (Rlt_bool_spec a b) end; cbn; try reflexivity; exfalso; lra. }
    destruct (Far e I) as (A & C). rewrite <- (One _ A), <- (One _ C). ring.
Qed.

(** * The code *)

(** [Share]: an edge, the number of faces that share it, and those in its direction less those in the other. *)
Record share : Type := Share { line : edge; faces : Z; net : Z }.
Definition reversed (e : edge) : edge := (snd e, fst e).
Definition same_edge (e f : edge) : bool := same (fst e) (fst f) && same (snd e) (snd f).

(** Faces with one edge, in either direction, are counted together. Edges without a length are none. *)
Fixpoint add (e : edge) (l : list share) : list share :=
  match l with
  | [] => [Share e 1 1]
  | s :: l => if same_edge e (line s) then Share (line s) (faces s + 1) (net s + 1) :: l
              else if same_edge e (reversed (line s)) then Share (line s) (faces s + 1) (net s - 1) :: l else s :: add e l
  end.
Definition shares (l : list edge) : list share := fold_right add [] (filter (fun e => negb (same (fst e) (snd e))) l).

(** [uneven]: the edges at one of whose ends the weights on their line do not add up. The weights are those at the first and at the second end. *)
Definition pull (weights : share -> Z * Z) (p w : vec) (s : share) : Z :=
  if along w (line s) then (if same (fst (line s)) p then fst (weights s) else 0%Z) + (if same (snd (line s)) p then snd (weights s) else 0%Z) else 0%Z.
Definition uneven (even : Z -> bool) (weights : share -> Z * Z) (l : list share) : list share :=
  filter (fun s => let at_end p := even (sum (pull weights p (way (line s))) l) in negb (at_end (fst (line s)) && at_end (snd (line s)))) l.

Definition open (l : list edge) : list share := uneven Z.even (fun _ => (1, 1)%Z) (filter (fun s => Z.odd (faces s)) (shares l)).
Definition one_sided (l : list edge) : list share := filter (fun s => negb (net s =? 0)%Z) (shares l).
Definition unpaired (l : list edge) : list share := uneven (fun n => (n =? 0)%Z) (fun s => (- net s, net s)%Z) (one_sided l).

Lemma same_edge_iff e f : same_edge e f = true <-> e = f.
Proof. unfold same_edge. rewrite andb_true_iff, !same_iff. destruct e, f. cbn. split; [intros (-> & ->)|intros E; injection E as -> ->]; auto. Qed.

(** Edges that are counted together contribute together. *)
Lemma sum_shares (g : edge -> Z) l : (forall e, g (reversed e) = - g e)%Z -> sum (fun s => net s * g (line s))%Z (shares l) = sum g l.
Proof.
  intros A. assert (S : forall e l, sum (fun s => net s * g (line s))%Z (add e l) = (g e + sum (fun s => net s * g (line s)) l)%Z).
  { intros e. induction l0 as [|s l0 IH]; [cbn [add sum line net]; ring|]. cbn [add]. destruct (same_edge e (line s)) eqn:E; [|destruct (same_edge e (reversed (line s))) eqn:F].
    - apply same_edge_iff in E. subst e. cbn [sum line net]. ring.
    - apply same_edge_iff in F. subst e. rewrite A. cbn [sum line net]. ring.
    - cbn [sum]. rewrite IH. ring. }
  unfold shares. induction l as [|e l IH]; [reflexivity|]. cbn [filter sum]. destruct (same (fst e) (snd e)) eqn:F; cbn [negb fold_right].
  - apply same_iff in F. specialize (A e). unfold reversed in A. destruct e as [a b]. cbn [fst snd] in *. subst b. rewrite IH. lia.
  - rewrite S, IH. ring.
Qed.

Lemma shares_are l s : In s (shares l) -> (2 | faces s - net s)%Z /\ way (line s) <> zero.
Proof.
  unfold shares. revert s. induction l as [|e l IH]; [intros s []|]. cbn [filter]. destruct (same (fst e) (snd e)) eqn:F; [exact IH|]. cbn [negb fold_right]. apply same_false in F.
  assert (W : way e <> zero) by (intros Z; apply F; now apply flat). set (t := fold_right add [] _) in *. clearbody t. revert IH. induction t as [|s' t IHt]; intros IH s.
  - intros [<-|[]]. cbn. split; [now exists 0%Z|exact W].
  - destruct (IH s' (or_introl eq_refl)) as ((k & K) & N). assert (IH' : forall s, In s t -> (2 | faces s - net s)%Z /\ way (line s) <> zero) by (intros; apply IH; now right).
    cbn [add]. destruct (same_edge e (line s')); [|destruct (same_edge e (reversed (line s')))]; intros [<-|I]; cbn [faces net line]; auto; (split; [|exact N]); [exists k; lia|exists (k + 1)%Z; lia|exists k; lia].
Qed.

Lemma along_same w v e : w <> zero -> v <> zero -> parallel v w = true -> along w e = along v e.
Proof.
  intros W V P. unfold along. destruct (parallel (way e) v) eqn:A.
  - rewrite (parallel_sym v w) in P. now apply parallel_trans with v.
  - destruct (parallel (way e) w) eqn:B; [|reflexivity]. rewrite <- A. symmetry. now apply parallel_trans with w.
Qed.

Lemma filter_none {A} (p : A -> bool) l : filter p l = [] <-> forall x, In x l -> p x = false.
Proof.
  induction l as [|x l IH]; [split; [intros _ y []|reflexivity]|]. cbn. destruct (p x) eqn:E.
  - split; [discriminate|intros H; rewrite H in E; [discriminate|now left]].
  - rewrite IH. split; [intros H y [<-|I]; auto|intros H y I; auto].
Qed.

Lemma none_uneven even weights l : even 0%Z = true -> (forall s, In s l -> way (line s) <> zero) ->
  uneven even weights l = [] <-> forall p w, w <> zero -> even (sum (pull weights p w) l) = true.
Proof.
  intros E0 W. unfold uneven. rewrite filter_none. split.
  - intros H p w N. destruct (existsb (fun s => along w (line s) && (same (fst (line s)) p || same (snd (line s)) p)) l) eqn:E.
    + apply existsb_exists in E. destruct E as (s & I & E). apply andb_true_iff in E. destruct E as (A & E). specialize (H s I). cbv zeta in H. rewrite negb_false_iff, andb_true_iff in H.
      rewrite (sum_ext _ (pull weights p (way (line s)))).
      2: { intros t _. unfold pull. rewrite (along_same w (way (line s))); [reflexivity|exact N|now apply W|exact A]. }
      apply orb_true_iff in E. destruct E as [E|E]; apply same_iff in E; rewrite <- E; apply H.
    + rewrite (sum_ext _ (fun _ => 0%Z)); [clear -E0; induction l as [|s l IH]; assumption|]. intros s I. unfold pull. destruct (along w (line s)) eqn:A; [|reflexivity].
      destruct (same (fst (line s)) p) eqn:F, (same (snd (line s)) p) eqn:S; try reflexivity; exfalso; apply not_true_iff_false in E; apply E; apply existsb_exists; exists s; rewrite A, F, S; auto.
  - intros H s I. cbv zeta. rewrite !H by now apply W. reflexivity.
Qed.

Lemma begins_reversed p w e : begins p w (reversed e) = (- begins p w e)%Z.
Proof.
  unfold begins, along. replace (parallel (way (reversed e)) w) with (parallel (way e) w); [destruct (parallel (way e) w); cbn; ring|].
  assert (R : forall v, parallel v w = true -> parallel (scale (-1) v) w = true) by (intros v P; apply same_iff in P; apply same_iff; vectors; injection P as X Y Z; f_equal; lra).
  assert (E : way (reversed e) = scale (-1) (way e) /\ way e = scale (-1) (way (reversed e))) by (unfold way, reversed; vectors; split; f_equal; ring). destruct E as (E & E').
  destruct (parallel (way e) w) eqn:P; [rewrite E; symmetry; now apply R|]. destruct (parallel (way (reversed e)) w) eqn:Q; [|reflexivity]. rewrite <- P, E'. now apply R.
Qed.

(** [is_closed]: no edge is open iff the chain balances for parity. Edges that an even number of faces share need not be looked at. [CLOSED-1](4) *)
Theorem is_closed_is_right l : open l = [] <-> balanced 2 l.
Proof.
  unfold open, balanced. rewrite none_uneven; [|reflexivity|intros s I; apply filter_In in I; apply (shares_are l s), I].
  assert (E : forall p w, Z.even (sum (pull (fun _ => (1, 1)%Z) p w) (filter (fun s => Z.odd (faces s)) (shares l))) = true <-> (2 | sum (begins p w) l)%Z).
  { intros p w. rewrite Z.even_spec. transitivity (2 | sum (pull (fun _ => (1, 1)%Z) p w) (filter (fun s => Z.odd (faces s)) (shares l)))%Z; [split; intros (k & K); exists k; rewrite K; ring|].
    rewrite <- (sum_shares (begins p w)) by apply begins_reversed. rewrite sum_filter. apply divides_differ. unfold Z.sub. rewrite <- sum_opp, <- sum_plus. apply sum_divides. intros s I.
    destruct (shares_are l s I) as ((k & K) & _). unfold pull, begins. destruct (along w (line s)); [|exists 0%Z; destruct (Z.odd (faces s)); ring]. cbn [fst snd].
    destruct (Z.odd (faces s)) eqn:O.
    - apply Z.odd_spec in O. destruct O as (j & O). destruct (same (fst (line s)) p), (same (snd (line s)) p); cbn [Z.b2z]; [exists 1%Z|exists (k - j)%Z|exists (1 + j - k)%Z|exists 0%Z]; nia.
    - rewrite <- Z.negb_even, negb_false_iff, Z.even_spec in O. destruct O as (j & O). exists (- (j - k) * (Z.b2z (same (fst (line s)) p) - Z.b2z (same (snd (line s)) p)))%Z. nia. }
  split; intros H p w W; apply E; auto.
Qed.

(** [is_oriented]: the same with directions. [CLOSED-1](4) *)
Theorem is_oriented_is_right l : unpaired l = [] <-> balanced 0 l.
Proof.
  unfold unpaired, balanced. rewrite none_uneven; [|reflexivity|intros s I; apply filter_In in I; apply (shares_are l s), I].
  assert (E : forall p w, sum (pull (fun s => (- net s, net s)%Z) p w) (one_sided l) = (- sum (begins p w) l)%Z).
  { intros p w. rewrite <- (sum_shares (begins p w)) by apply begins_reversed. unfold one_sided. rewrite sum_filter, <- sum_opp. apply sum_ext. intros s _. unfold pull, begins. cbn [fst snd].
    destruct (Z.eqb_spec (net s) 0) as [-> |]; [reflexivity|]. destruct (along w (line s)); cbn [negb]; [|ring]. destruct (same (fst (line s)) p), (same (snd (line s)) p); cbn [Z.b2z]; ring. }
  split; intros H p w W; specialize (H p w W).
  - rewrite E, Z.eqb_eq in H. exists 0%Z. lia.
  - rewrite E, Z.eqb_eq. apply Z.divide_0_l in H. lia.
Qed.
