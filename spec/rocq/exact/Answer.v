(** One answer: whatever a search leaves out by the boxes, and in whatever order it comes to the rest, it ends with the first hit: the
    least (t, id), where t is exact, and RN(t) is what it reports. *)
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

(** The t of a triangle that is hit. *)
Definition exact_t (i : N) : R := match mesh i with Some v => top_t (truth v o d) / det (truth v o d) | None => 0 end.

(** What exact arithmetic says of two triangles whose rounded distances are equal: how their t compare. Order.v is about it. *)
Variable compare : N -> N -> comparison.
Definition is_exact_order : Prop := forall i j f g, kernel i = Some f -> kernel j = Some g -> value f = value g ->
  compare i j = Rcompare (exact_t i) (exact_t j).
Hypothesis compare_is_exact : is_exact_order.

(** What the test of a box says, up to a distance. *)
Variable met : box -> float -> bool.
(** BOX-2. *)
Variable fit : box -> Prop.
Hypothesis touched_is_met : forall b best t, fit b -> in_box (along o d t) b -> within t tmin tmax -> is_nan best = false ->
  nearest t <= value best -> met b best = true.

(** ** The best so far *)

Definition answer : Type := option (float * N).

(** The order of hits: by t, and of equal t by the index. *)
Definition before (t : R) (i : N) (t' : R) (j : N) : Prop := t < t' \/ (t = t' /\ (i < j)%N).
Definition less (a b : float * N) : Prop := before (exact_t (snd a)) (snd a) (exact_t (snd b)) (snd b).
(** How a search decides it: by the rounded distances, and where these are equal by arithmetic. *)
Definition is_less (a b : float * N) : bool :=
  Bltb (fst a) (fst b) || (Beqb (fst a) (fst b) &&
    match compare (snd a) (snd b) with Lt => true | Eq => (snd a <? snd b)%N | Gt => false end).

(** A hit is accepted iff (t, id) is less than the best so far. *)
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

(** The first of all hits with its distance RN(t), or none where there is none. *)
Definition is_least (best : answer) : Prop :=
  match best with
  | Some (f, i) => kernel i = Some f /\ exists t, hits i t /\ value f = nearest t /\ forall j t', hits j t' -> j = i \/ before t i t' j
  | None => forall j t, ~ hits j t
  end.

(** ** The order *)

Lemma hits_once i t : hits i t -> t = exact_t i.
Proof. intros (v & E & _ & T & _). unfold exact_t. now rewrite E. Qed.

Lemma kernel_hits i f : kernel i = Some f -> hits i (exact_t i) /\ is_nan f = false /\ value f = nearest (exact_t i).
Proof.
  intros E. pose proof (kernel_is_exact i) as K. rewrite E in K. destruct K as (t & H & N & V). pose proof (hits_once i t H) as T. now subst t.
Qed.

(** Rounding keeps the order, so where rounded distances differ they tell it. [EXACT-13] *)
Theorem rounded_tells s t : nearest s < nearest t -> s < t.
Proof.
  intros H. apply Rnot_le_lt. intros L. apply (Rlt_not_le _ _ H). unfold Slabs.nearest. apply Rle_min_compat_r.
  apply round_le; [now apply FLT_exp_valid|apply valid_rnd_N|exact L].
Qed.

Lemma Beqb_value (a b : float) : is_nan a = false -> is_nan b = false -> (Beqb a b = true <-> value a = value b).
Proof.
  intros Na Nb. assert (T : Beqb a b = negb (Bltb a b) && negb (Bltb b a)).
  { change (Beqb a b) with (match Bcompare a b with Some Eq => true | _ => false end).
    change (Bltb a b) with (match Bcompare a b with Some Lt => true | _ => false end).
    change (Bltb b a) with (match Bcompare b a with Some Lt => true | _ => false end). rewrite (Bcompare_swap _ _ a b).
    destruct (Bcompare a b) as [[]|] eqn:E; try reflexivity. exfalso. destruct a as [|[]| |[]], b as [|[]| |[]]; discriminate. }
  rewrite T, !Bltb_value by assumption. destruct (Rlt_bool_spec (value a) (value b)), (Rlt_bool_spec (value b) (value a)); cbn; split; try discriminate; try lra; auto.
Qed.

(** What a search decides is the order of the exact distances. [EXACT-13] *)
Theorem is_less_is_exact i f j g : kernel i = Some f -> kernel j = Some g -> (is_less (f, i) (g, j) = true <-> less (f, i) (g, j)).
Proof.
  intros Ef Eg. destruct (kernel_hits i f Ef) as (_ & Nf & Vf), (kernel_hits j g Eg) as (_ & Ng & Vg). unfold is_less, less, before. cbn [fst snd].
  rewrite orb_true_iff, andb_true_iff, (Beqb_value f g Nf Ng), (Bltb_value 24 128 f g Nf Ng), Vf, Vg.
  destruct (Rlt_bool_spec (nearest (exact_t i)) (nearest (exact_t j))) as [L|L]; [apply rounded_tells in L; intuition|].
  assert (Ge : exact_t i < exact_t j -> nearest (exact_t i) = nearest (exact_t j)).
  { intros H. apply Rle_antisym; [|exact L]. apply Rnot_lt_le. intros C. apply rounded_tells in C. lra. }
  assert (Ty : nearest (exact_t i) = nearest (exact_t j) -> compare i j = Rcompare (exact_t i) (exact_t j)).
  { intros H. apply (compare_is_exact i j f g); [assumption..|]. now rewrite Vf, Vg. }
  split.
  - intros [[=]|[H C]]. rewrite (Ty H) in C. destruct (Rcompare_spec (exact_t i) (exact_t j)) as [K|K|K]; [now left| |discriminate].
    right. split; [exact K|now apply N.ltb_lt].
  - intros [H|[H K]]; right.
    + pose proof (Ge H) as V. split; [exact V|]. now rewrite (Ty V), Rcompare_Lt.
    + split; [now rewrite H|]. rewrite Ty by now rewrite H. rewrite Rcompare_Eq by exact H. now apply N.ltb_lt.
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

Lemma less_or i f j g : kernel i = Some f -> kernel j = Some g -> is_less (f, i) (g, j) = false -> (g, j) = (f, i) \/ less (g, j) (f, i).
Proof.
  intros Ef Eg E. assert (Nl : ~ less (f, i) (g, j)) by (rewrite <- is_less_is_exact by assumption; congruence). unfold less, before in *. cbn [snd] in *.
  destruct (Rtotal_order (exact_t i) (exact_t j)) as [H|[H|H]]; [tauto| |tauto].
  destruct (N.lt_trichotomy i j) as [K|[->|K]]; [tauto|left; congruence|]. right. right. split; [now symmetry|exact K].
Qed.

Lemma less_trans a b c : less a b -> less b c -> less a c.
Proof.
  unfold less, before. intros [A|[A A']] [B|[B B']]; [left; lra|left; lra|left; lra|]. right. split; [congruence|]. eapply N.lt_trans; eassumption.
Qed.

Lemma accept_reached j best f i : sound best -> reached best f i -> reached (accept j best) f i.
Proof.
  intros So (b & -> & H). unfold accept. destruct (kernel j) as [g|] eqn:E; [|exists b; auto].
  destruct (is_less (g, j) b) eqn:L; [|exists b; auto]. exists (g, j). split; [reflexivity|]. right. destruct b as [h k].
  assert (Lt : less (g, j) (h, k)) by now apply is_less_is_exact.
  destruct H as [[= -> ->]|H]; [exact Lt|]. now apply less_trans with (h, k).
Qed.

Lemma accept_reaches best f i : sound best -> kernel i = Some f -> reached (accept i best) f i.
Proof.
  intros So E. unfold accept. rewrite E. destruct best as [[g j]|]; [|exists (f, i); auto].
  destruct (is_less (f, i) (g, j)) eqn:L; [exists (f, i); auto|]. exists (g, j). split; [reflexivity|].
  now apply less_or.
Qed.

(** ** Nothing is lost *)

(** A hit that is not reached is not beyond the best so far. *)
Lemma reached_or_near best f i : sound best -> kernel i = Some f ->
  reached best f i \/ match best with Some b => value f <= value (fst b) | None => True end.
Proof.
  intros So E. destruct best as [[g j]|]; [|now right]. destruct (is_less (f, i) (g, j)) eqn:L.
  - right. apply is_less_is_exact in L; [|exact E|exact So]. destruct (kernel_hits i f E) as (_ & _ & V), (kernel_hits j g So) as (_ & _ & W).
    cbn [fst]. rewrite V, W. apply Rnot_lt_le. intros C. apply rounded_tells in C. unfold less, before in L. cbn [snd] in L. lra.
  - left. exists (g, j). split; [reflexivity|]. now apply less_or.
Qed.

(** So no box around it is left out. *)
Lemma not_skipped t best f i p : sound best -> hits i p -> nearest p = value f -> in_box (along o d p) (box_of t) /\ fit (box_of t) ->
  match best with Some b => value f <= value (fst b) | None => True end -> met (box_of t) (limit best) = true.
Proof.
  intros So (v & _ & _ & _ & W) Ef [Hb Hf] Nr. apply touched_is_met with p; [exact Hf|exact Hb|exact W| |]; destruct best as [[g j]|]; cbn [limit fst] in *.
  - apply (kernel_hits j g So).
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

(** Every search that has come to its end, over any tree that holds the triangles, has the first hit, or none where there is none.
    [DET-1, EXACT-13] *)
Theorem one_answer root best : covers root -> run ([root], None) ([], best) -> is_least best.
Proof.
  intros Cv R. pose proof (run_sound _ _ R I) as So. cbn [snd] in So.
  assert (All : forall j t, hits j t -> exists g, kernel j = Some g /\ reached best g j).
  { intros j t Ht. pose proof (kernel_is_exact j) as K. destruct (kernel j) as [g|] eqn:E; [|now contradict Ht]. exists g. split; [reflexivity|].
    destruct K as (t' & Ht' & _ & Eg). destruct (run_keeps g j t' _ _ E Ht' (eq_sym Eg) R I) as [_ [H|(x & [] & _)]]; [|exact H]. cbn [fst]. right.
    exists root. split; [now left|]. destruct Ht' as (v & Ev & M & -> & W). apply Cv with v; [exact Ev|]. now apply hit_is_in_triangle. }
  destruct best as [[f i]|]; cbn.
  - split; [exact So|]. destruct (kernel_hits i f So) as (H & _ & V). exists (exact_t i). split; [exact H|]. split; [exact V|].
    intros j t Ht. destruct (All j t Ht) as (g & E & b & [= <-] & [[= _ ->]|L]); [now left|right]. now rewrite (hits_once j t Ht).
  - intros j t Ht. now destruct (All j t Ht) as (g & _ & b & [=] & _).
Qed.

(** There is one such answer, to the bit. *)
Lemma least_unique a b : is_least a -> is_least b -> a = b.
Proof.
  destruct a as [[f i]|], b as [[g j]|]; cbn; [|intros (_ & t & H & _) K; now apply K in H|intros K (_ & t & H & _); now apply K in H|reflexivity].
  intros (Ef & t & Ht & _ & Lt) (Eg & t' & Ht' & _ & Lt'). destruct (Lt j t' Ht') as [->|H1]; [congruence|]. destruct (Lt' i t Ht) as [->|H2]; [congruence|].
  exfalso. unfold before in *. destruct H1 as [H1|[H1 H1']], H2 as [H2|[H2 H2']]; try lra. eapply N.lt_irrefl, N.lt_trans; eassumption.
Qed.

(** So any two searches, over any two trees, end with the same: the same distance to the bit, the same triangle. [DET-1] *)
Theorem same_answer root root' a b : covers root -> covers root' -> run ([root], None) ([], a) -> run ([root'], None) ([], b) -> a = b.
Proof. intros. apply least_unique; [apply one_answer with root|apply one_answer with root']; assumption. Qed.
End Search.

(** Of some hits, such as those after a given one, the first: triangles that are not wanted are as good as missed. [DET-1] *)
Theorem wanted_answer o d tmin tmax mesh kernel compare met (fit : box -> Prop) (wanted : N -> bool) root best :
  is_exact o d tmin tmax mesh kernel -> is_exact_order o d mesh kernel compare ->
  (forall b best t, fit b -> in_box (along o d t) b -> within t tmin tmax -> is_nan best = false -> nearest t <= value best -> met b best = true) ->
  covers mesh fit root ->
  let mesh' i := if wanted i then mesh i else None in
  let kernel' i := if wanted i then kernel i else None in
  run tmax kernel' compare met ([root], None) ([], best) -> is_least o d tmin tmax mesh' kernel' best.
Proof.
  intros K O M C mesh' kernel' R. apply (one_answer o d tmin tmax mesh' kernel') with (compare := compare) (met := met) (fit := fit) (root := root);
    [| |exact M| |exact R].
  - intros i. pose proof (K i) as Ki. unfold kernel', hits, mesh' in *. destruct (wanted i); [exact Ki|]. now intros t (v & [=] & _).
  - intros i j f g. pose proof (O i j f g) as Oi. unfold kernel', exact_t, mesh' in *. now destruct (wanted i), (wanted j).
  - intros i v p. unfold mesh'. destruct (wanted i); [apply C|discriminate].
Qed.
