(** One answer: whatever a search leaves out by the boxes, and in whatever order it comes to the rest, it ends with the least hit. *)
Require Import Reals ZArith NArith List Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN.
Require Import StacklessExact.Rounding StacklessExact.Triple StacklessExact.Filter StacklessExact.Slabs.
Import ListNotations.
Open Scope R_scope.

Notation float := (binary_float 24 128).
Notation value := (value 24 128).
Notation nearest := (nearest 24 128).
Notation within := (within 24 128).

(** * A hit is a point of the triangle *)

Definition along (o d : vec) (t : R) : vec := Vec (vx o + t * vx d) (vy o + t * vy d) (vz o + t * vz d).

Definition triangle : Type := vec * vec * vec.
Definition in_triangle (p : vec) (v : triangle) : Prop :=
  let '(v0, v1, v2) := v in exists a b c, 0 <= a /\ 0 <= b /\ 0 <= c /\ a + b + c = 1 /\
    vx p = a * vx v0 + b * vx v1 + c * vx v2 /\ vy p = a * vy v0 + b * vy v1 + c * vy v2 /\ vz p = a * vz v0 + b * vz v1 + c * vz v2.

Definition truth (v : triangle) (o d : vec) : determinants := let '(v0, v1, v2) := v in determinants_of exactly v0 v1 v2 o d.

(** The point of a hit is in the closed triangle: U/det, V/det and W/det are its weights. [EXACT-1, EXACT-2] *)
Theorem hit_is_in_triangle v o d : let x := truth v o d in
  meets x -> in_triangle (along o d (top_t x / det x)) v.
Proof.
  destruct v as [[v0 v1] v2]. intros x (Nz & U & V & W). exists (edge_w x / det x), (edge_u x / det x), (edge_v x / det x).
  repeat (split; [assumption|]). split.
  { replace (edge_w x) with (det x - edge_u x - edge_v x) by reflexivity. field. exact Nz. }
  assert (K : forall l r, l * det x = r * det x -> l = r) by (intros l r H; exact (Rmult_eq_reg_r _ _ _ H Nz)).
  split; [|split]; apply K; cbn [along vx vy vz]; field_simplify; try exact Nz;
    unfold x, truth, exactly; simpl; unfold dot, exactly; simpl; ring.
Qed.

(** A box, the lower and the upper plane of each axis. *)
Record box : Type := Box { lo_x : float; hi_x : float; lo_y : float; hi_y : float; lo_z : float; hi_z : float }.
Definition in_box (p : vec) (b : box) : Prop :=
  B2R (lo_x b) <= vx p <= B2R (hi_x b) /\ B2R (lo_y b) <= vy p <= B2R (hi_y b) /\ B2R (lo_z b) <= vz p <= B2R (hi_z b).

Lemma between a b c x y z lo hi : 0 <= a -> 0 <= b -> 0 <= c -> a + b + c = 1 -> lo <= x <= hi -> lo <= y <= hi -> lo <= z <= hi ->
  lo <= a * x + b * y + c * z <= hi.
Proof.
  intros A B C S X Y Z. assert (P : forall w v, 0 <= w -> lo <= v <= hi -> w * lo <= w * v <= w * hi).
  { intros w v W V. split; apply Rmult_le_compat_l; lra. }
  pose proof (P a x A X). pose proof (P b y B Y). pose proof (P c z C Z).
  assert (E : forall v, v = a * v + b * v + c * v) by (intros v; replace (a * v + b * v + c * v) with ((a + b + c) * v) by ring; rewrite S; ring).
  pose proof (E lo). pose proof (E hi). lra.
Qed.

(** A box that holds the corners holds the triangle. [DET-1] *)
Theorem box_holds_triangle p v0 v1 v2 b : in_box v0 b -> in_box v1 b -> in_box v2 b -> in_triangle p (v0, v1, v2) -> in_box p b.
Proof.
  intros (X0 & Y0 & Z0) (X1 & Y1 & Z1) (X2 & Y2 & Z2) (wa & wb & wc & A & B & C & S & X & Y & Z).
  unfold in_box. rewrite X, Y, Z. split; [|split]; apply between; assumption.
Qed.

(** * Trees *)

(** Nodes have any number of children, leaves any number of triangles, and a triangle may be in several leaves. *)
Inductive tree : Type := Leaf (b : box) (items : list N) | Inner (b : box) (children : list tree).
Definition box_of (t : tree) : box := match t with Leaf b _ | Inner b _ => b end.

Section Trees.
(** What is supposed of boxes that are tested. *)
Variable fit : box -> Prop.

(** A point of a triangle, in a leaf that names the triangle, and in all boxes from there up. *)
Inductive holds (p : vec) (i : N) : tree -> Prop :=
  | holds_leaf b items : In i items -> in_box p b -> fit b -> holds p i (Leaf b items)
  | holds_inner b children t : In t children -> holds p i t -> in_box p b -> fit b -> holds p i (Inner b children).

(** It is enough that leaves hold it, and boxes the boxes below. *)
Inductive holds_below (p : vec) (i : N) : tree -> Prop :=
  | below_leaf b items : In i items -> in_box p b -> holds_below p i (Leaf b items)
  | below_inner b children t : In t children -> holds_below p i t -> holds_below p i (Inner b children).
Inductive nested_boxes : tree -> Prop :=
  | nested_leaf b items : fit b -> nested_boxes (Leaf b items)
  | nested_inner b children : fit b -> (forall t, In t children -> nested_boxes t /\ forall p, in_box p (box_of t) -> in_box p b) ->
      nested_boxes (Inner b children).

Lemma holds_in p i t : holds p i t -> in_box p (box_of t) /\ fit (box_of t).
Proof. now destruct 1. Qed.

(** Boxes that hold the boxes below hold what leaves hold. [DET-1] *)
Theorem nested_holds p i t : nested_boxes t -> holds_below p i t -> holds p i t.
Proof.
  intros Ne H. induction H as [b items Hi Hb|b children t Hin H IH]; inversion_clear Ne as [? ? Hf|? ? Hf K]; [now constructor|].
  destruct (K t Hin) as [N1 N2]. specialize (IH N1). apply holds_inner with t; [assumption..| |exact Hf]. now apply N2, (holds_in p i).
Qed.
End Trees.

(** * Searches *)

Section Search.
Variables o d : vec.
Variables tmin tmax : float.
(** The triangles, by their indices. *)
Variable mesh : N -> option triangle.

(** EXACT-1: what it is to hit a triangle at t. *)
Definition hits (i : N) (t : R) : Prop := exists v, mesh i = Some v /\ meets (truth v o d) /\
  t = top_t (truth v o d) / det (truth v o d) /\ within t tmin tmax.

(** What the exact test says of a triangle: RN(t), or that it is missed. *)
Variable kernel : N -> option float.
Definition is_exact : Prop := forall i, match kernel i with
  | Some f => exists t, hits i t /\ is_nan f = false /\ value f = nearest t
  | None => forall t, ~ hits i t end.
Hypothesis kernel_is_exact : is_exact.

(** What the test of a box says, up to a distance. *)
Variable met : box -> float -> bool.
(** BOX-2. *)
Variable fit : box -> Prop.
Hypothesis touched_is_met : forall b best t, fit b -> in_box (along o d t) b -> within t tmin tmax -> is_nan best = false ->
  nearest t <= value best -> met b best = true.

(** ** The best so far *)

Definition answer : Type := option (float * N).

Definition less (a b : float * N) : Prop := value (fst a) < value (fst b) \/ (value (fst a) = value (fst b) /\ (snd a < snd b)%N).
Definition is_less (a b : float * N) : bool :=
  Bltb (fst a) (fst b) || (Beqb (fst a) (fst b) && (snd a <? snd b)%N).

(** A hit is accepted iff (RN(t), id) is less than the best so far. *)
Definition accept (i : N) (best : answer) : answer :=
  match kernel i, best with
  | Some f, Some b => if is_less (f, i) b then Some (f, i) else best
  | Some f, None => Some (f, i)
  | None, _ => best
  end.

(** The distance up to which boxes are asked for. *)
Definition limit (best : answer) : float := match best with Some (f, _) => f | None => tmax end.

(** A search has nodes ahead of it, and a best so far. It takes any of these nodes, and leaves it out if the test says so, or goes to
    its children, or to one of its triangles. It need not test a triangle that would not be accepted. It may come to any node again. *)
Inductive step : list tree * answer -> list tree * answer -> Prop :=
  | skips a t c best : met (box_of t) (limit best) = false -> step (a ++ t :: c, best) (a ++ c, best)
  | opens a b children c best : step (a ++ Inner b children :: c, best) (a ++ children ++ c, best)
  | tests a b x i y c best : step (a ++ Leaf b (x ++ i :: y) :: c, best) (a ++ Leaf b (x ++ y) :: c, accept i best)
  | rejects a b x i y c best : accept i best = best -> step (a ++ Leaf b (x ++ i :: y) :: c, best) (a ++ Leaf b (x ++ y) :: c, best)
  | leaves a b c best : step (a ++ Leaf b [] :: c, best) (a ++ c, best)
  | returns a t c best : step (a ++ c, best) (a ++ t :: c, best).

Inductive run : list tree * answer -> list tree * answer -> Prop :=
  | stays s : run s s
  | goes s s' s'' : step s s' -> run s' s'' -> run s s''.

(** The least of all hits, or none where there is none. *)
Definition is_least (best : answer) : Prop :=
  match best with
  | Some (f, i) => kernel i = Some f /\ forall j g, kernel j = Some g -> (f, i) = (g, j) \/ less (f, i) (g, j)
  | None => forall j, kernel j = None
  end.

(** ** The order *)

Lemma kernel_is_number i f : kernel i = Some f -> is_nan f = false.
Proof. intros E. pose proof (kernel_is_exact i) as K. rewrite E in K. destruct K as (t & _ & N & _). exact N. Qed.

Lemma Beqb_value (a b : float) : is_nan a = false -> is_nan b = false -> (Beqb a b = true <-> value a = value b).
Proof.
  intros Na Nb. assert (T : Beqb a b = negb (Bltb a b) && negb (Bltb b a)).
  { change (Beqb a b) with (match Bcompare a b with Some Eq => true | _ => false end).
    change (Bltb a b) with (match Bcompare a b with Some Lt => true | _ => false end).
    change (Bltb b a) with (match Bcompare b a with Some Lt => true | _ => false end). rewrite (Bcompare_swap _ _ a b).
    destruct (Bcompare a b) as [[]|] eqn:E; try reflexivity. exfalso. destruct a as [|[]| |[]], b as [|[]| |[]]; discriminate. }
  rewrite T, !Bltb_value by assumption. destruct (Rlt_bool_spec (value a) (value b)), (Rlt_bool_spec (value b) (value a)); cbn; split; try discriminate; try lra; auto.
Qed.

Lemma is_less_spec a b : is_nan (fst a) = false -> is_nan (fst b) = false -> (is_less a b = true <-> less a b).
Proof.
  intros Na Nb. unfold is_less, less. rewrite orb_true_iff, andb_true_iff, N.ltb_lt, (Beqb_value _ _ Na Nb), Bltb_value by assumption.
  destruct (Rlt_bool_spec (value (fst a)) (value (fst b))); intuition (try discriminate; try lra).
Qed.

(** A hit that the search has, or may have: it is the answer of the exact test. *)
Definition sound (best : answer) : Prop := match best with Some (f, i) => kernel i = Some f | None => True end.

Lemma accept_sound i best : sound best -> sound (accept i best).
Proof.
  unfold accept. destruct (kernel i) as [f|] eqn:E; [|auto]. destruct best as [b|]; [|intros _; exact E]. destruct (is_less (f, i) b); [intros _; exact E|auto].
Qed.

(** Nothing before it is left. *)
Definition reached (best : answer) (f : float) (i : N) : Prop :=
  exists b, best = Some b /\ (b = (f, i) \/ less b (f, i)).

Lemma less_or a b : is_less a b = false -> is_nan (fst a) = false -> is_nan (fst b) = false -> b = a \/ less b a \/ (value (fst a) = value (fst b) /\ snd a = snd b).
Proof.
  intros E Na Nb. assert (Nl : ~ less a b) by (rewrite <- is_less_spec by assumption; congruence). unfold less in *.
  destruct (Rtotal_order (value (fst a)) (value (fst b))) as [H|[H|H]]; [tauto| |tauto].
  destruct (N.lt_trichotomy (snd a) (snd b)) as [K|[K|K]]; [tauto|tauto|]. right. left. right. split; [lra|exact K].
Qed.

Lemma less_trans a b c : less a b -> less b c -> less a c.
Proof.
  unfold less. intros [A|[A A']] [B|[B B']]; [left; lra|left; lra|left; lra|]. right. split; [congruence|]. eapply N.lt_trans; eassumption.
Qed.

Lemma accept_reached j best f i : sound best -> reached best f i -> reached (accept j best) f i.
Proof.
  intros So (b & -> & H). unfold accept. destruct (kernel j) as [g|] eqn:E; [|exists b; auto].
  destruct (is_less (g, j) b) eqn:L; [|exists b; auto]. exists (g, j). split; [reflexivity|]. right. destruct b as [h k].
  assert (Lt : less (g, j) (h, k)) by (apply is_less_spec; [apply (kernel_is_number j g E)|apply (kernel_is_number k h So)|exact L]).
  destruct H as [[= -> ->]|H]; [exact Lt|]. now apply less_trans with (h, k).
Qed.

Lemma accept_reaches best f i : sound best -> kernel i = Some f -> reached (accept i best) f i.
Proof.
  intros So E. unfold accept. rewrite E. destruct best as [[g j]|]; [|exists (f, i); auto].
  destruct (is_less (f, i) (g, j)) eqn:L; [exists (f, i); auto|]. exists (g, j). split; [reflexivity|].
  destruct (less_or _ _ L (kernel_is_number i f E) (kernel_is_number j g So)) as [H|[H|[_ H]]]; [now left|now right|].
  cbn in H. subst j. cbn in So. rewrite E in So. injection So as ->. now left.
Qed.

(** ** Nothing is lost *)

(** A hit that is not reached is not beyond the best so far. *)
Lemma reached_or_near best f i : sound best -> kernel i = Some f ->
  reached best f i \/ match best with Some b => value f <= value (fst b) | None => True end.
Proof.
  intros So E. destruct best as [[g j]|]; [|now right]. destruct (is_less (f, i) (g, j)) eqn:L.
  - right. apply is_less_spec in L; [|apply (kernel_is_number i f E)|apply (kernel_is_number j g So)]. unfold less in L. cbn in *. lra.
  - left. exists (g, j). split; [reflexivity|].
    destruct (less_or _ _ L (kernel_is_number i f E) (kernel_is_number j g So)) as [K|[K|[_ K]]]; [now left|now right|].
    cbn in K. subst j. cbn in So. rewrite E in So. injection So as ->. now left.
Qed.

(** So no box around it is left out. *)
Lemma not_skipped t best f i p : sound best -> hits i p -> nearest p = value f -> in_box (along o d p) (box_of t) /\ fit (box_of t) ->
  match best with Some b => value f <= value (fst b) | None => True end -> met (box_of t) (limit best) = true.
Proof.
  intros So (v & _ & _ & _ & W) Ef [Hb Hf] Nr. apply touched_is_met with p; [exact Hf|exact Hb|exact W| |]; destruct best as [[g j]|]; cbn [limit fst] in *.
  - apply (kernel_is_number j g So).
  - apply (within_ends 24 128 eq_refl p tmin tmax W).
  - now rewrite Ef.
  - apply (within_ends 24 128 eq_refl p tmin tmax W).
Qed.

Definition has (ahead : list tree) (p : vec) (i : N) : Prop := exists t, In t ahead /\ holds fit p i t.

Lemma has_middle a t c p i : has (a ++ t :: c) p i -> holds fit p i t \/ has (a ++ c) p i.
Proof.
  intros (x & Hx & H). apply in_app_or in Hx. destruct Hx as [Hx|[->|Hx]]; [right|left; exact H|right]; exists x; split; auto using in_or_app.
Qed.

Lemma has_more a b c p i : has (a ++ c) p i -> has (a ++ b ++ c) p i.
Proof. intros (x & Hx & H). exists x. split; [|exact H]. apply in_app_or in Hx. rewrite !in_app_iff. tauto. Qed.

Lemma leaf_less p i j x y b : holds fit p i (Leaf b (x ++ j :: y)) -> i = j \/ holds fit p i (Leaf b (x ++ y)).
Proof.
  inversion_clear 1 as [? ? Hi Hb Hf|]. apply in_app_or in Hi. destruct Hi as [Hi|[->|Hi]]; [right|now left|right]; constructor; auto using in_or_app.
Qed.

(** What a step keeps: the hit is reached, or it is ahead. *)
Lemma step_keeps f i p s s' : kernel i = Some f -> hits i p -> nearest p = value f -> step s s' ->
  sound (snd s) -> reached (snd s) f i \/ has (fst s) (along o d p) i ->
  sound (snd s') /\ (reached (snd s') f i \/ has (fst s') (along o d p) i).
Proof.
  intros E Hp Ef St. destruct St as [a t c best Sk|a b children c best|a b x j y c best|a b x j y c best Rj|a b c best|a t c best];
    cbn [fst snd]; intros So H; (split; [auto using accept_sound|]).
  - destruct H as [H|H]; [now left|]. destruct (has_middle _ _ _ _ _ H) as [Ht|Ht]; [|now right].
    destruct (reached_or_near best f i So E) as [Hr|Hr]; [now left|]. exfalso.
    rewrite (not_skipped t best f i p So Hp Ef (holds_in fit _ _ _ Ht) Hr) in Sk. discriminate.
  - destruct H as [H|H]; [now left|right]. destruct (has_middle _ _ _ _ _ H) as [Ht|Ht]; [|now apply has_more].
    inversion_clear Ht as [|? ? t Hin Hh Hb Hf]. exists t. split; [|exact Hh]. rewrite !in_app_iff. tauto.
  - destruct H as [H|H]; [left; now apply accept_reached|]. destruct (has_middle _ _ _ _ _ H) as [Ht|Ht].
    + destruct (leaf_less _ _ _ _ _ _ Ht) as [<-|Ht']; [left; now apply accept_reaches|]. right. exists (Leaf b (x ++ y)). split; [|exact Ht'].
      apply in_or_app. right. now left.
    + right. destruct Ht as (t & Hin & Ht). exists t. split; [|exact Ht]. apply in_app_or in Hin. rewrite in_app_iff. cbn. tauto.
  - destruct H as [H|H]; [now left|]. destruct (has_middle _ _ _ _ _ H) as [Ht|Ht].
    + destruct (leaf_less _ _ _ _ _ _ Ht) as [<-|Ht']; [left; rewrite <- Rj; now apply accept_reaches|]. right. exists (Leaf b (x ++ y)).
      split; [|exact Ht']. apply in_or_app. right. now left.
    + right. destruct Ht as (t & Hin & Ht). exists t. split; [|exact Ht]. apply in_app_or in Hin. rewrite in_app_iff. cbn. tauto.
  - destruct H as [H|H]; [now left|right]. destruct (has_middle _ _ _ _ _ H) as [Ht|Ht]; [|exact Ht]. inversion_clear Ht as [? ? Hi Hb Hf|]. destruct Hi.
  - destruct H as [H|(x & Hx & H)]; [now left|right]. exists x. split; [|exact H]. apply in_app_or in Hx. rewrite in_app_iff. cbn. tauto.
Qed.

Lemma run_keeps f i p s s' : kernel i = Some f -> hits i p -> nearest p = value f -> run s s' ->
  sound (snd s) -> reached (snd s) f i \/ has (fst s) (along o d p) i ->
  sound (snd s') /\ (reached (snd s') f i \/ has (fst s') (along o d p) i).
Proof.
  intros E Hp Ef R. induction R as [s|s s1 s2 St R IH]; [auto|]. intros So H.
  destruct (step_keeps f i p s s1 E Hp Ef St So H) as [So1 H1]. now apply IH.
Qed.

Lemma run_sound s s' : run s s' -> sound (snd s) -> sound (snd s').
Proof.
  induction 1 as [s|s s1 s2 St R IH]; [auto|]. intros So. apply IH. destruct St; cbn [snd] in *; auto using accept_sound.
Qed.

(** Each point of each triangle is in a leaf that names it. *)
Definition covers (root : tree) : Prop := forall i v p, mesh i = Some v -> in_triangle p v -> holds fit p i root.

(** Every search that has come to its end, over any tree that holds the triangles, has the least hit, or none where there is none.
    [DET-1] *)
Theorem one_answer root best : covers root -> run ([root], None) ([], best) -> is_least best.
Proof.
  intros Cv R. pose proof (run_sound _ _ R I) as So. cbn [snd] in So.
  assert (All : forall j g, kernel j = Some g -> reached best g j).
  { intros j g E. pose proof (kernel_is_exact j) as K. rewrite E in K. destruct K as (t & Ht & _ & Eg).
    destruct (run_keeps g j t _ _ E Ht (eq_sym Eg) R I) as [_ [H|(x & [] & _)]]; [|exact H]. cbn [fst]. right. exists root. split; [now left|].
    destruct Ht as (v & Ev & M & -> & W). apply Cv with v; [exact Ev|]. now apply hit_is_in_triangle. }
  destruct best as [[f i]|]; cbn.
  - split; [exact So|]. intros j g E. destruct (All j g E) as (b & [= <-] & H). exact H.
  - intros j. destruct (kernel j) as [g|] eqn:E; [|reflexivity]. destruct (All j g E) as (b & [=] & _).
Qed.

(** There is one such answer, to the bit. *)
Lemma least_unique a b : is_least a -> is_least b -> a = b.
Proof.
  destruct a as [[f i]|], b as [[g j]|]; cbn; [|intros [E _] H; rewrite H in E; discriminate|intros H [E _]; rewrite H in E; discriminate|reflexivity].
  intros [Ef Lf] [Eg Lg]. destruct (Lf j g Eg) as [[= -> ->]|H1]; [reflexivity|]. destruct (Lg i f Ef) as [[= -> ->]|H2]; [reflexivity|]. exfalso.
  unfold less in *; cbn in *. destruct H1 as [H1|[H1 H1']], H2 as [H2|[H2 H2']]; try lra. eapply N.lt_irrefl, N.lt_trans; eassumption.
Qed.

(** So any two searches, over any two trees, end with the same: the same distance to the bit, the same triangle. [DET-1] *)
Theorem same_answer root root' a b : covers root -> covers root' -> run ([root], None) ([], a) -> run ([root'], None) ([], b) -> a = b.
Proof. intros. apply least_unique; [apply one_answer with root|apply one_answer with root']; assumption. Qed.
End Search.
