(** What a cut of a polygon keeps, in real numbers, whatever rounding makes of the points that it puts on edges: the proof of SPLIT-1,
    src/geom/clip.rs, without its numbers. *)
Require Import Reals List Lra Bool.
Require Import StacklessExact.PolygonOrder.
Import ListNotations.
Open Scope R_scope.

(** * A cut *)

(** An affine function of the plane: a coordinate, or how far beyond a plane a point is. *)
Record affine : Type := Affine { at_0 : R; by_v : R; by_w : R }.
Definition value (f : affine) (p : place) : R := at_0 f + by_v f * pv p + by_w f * pw p.

(** All that such functions say of the corners is so of the point: it is in the convex hull. *)
Definition holds (l : list place) (x : place) : Prop := forall f, (forall p, In p l -> value f p <= 0) -> value f x <= 0.

(** A corner n that stays and one q that goes, the points e and f on edges between them, in order: then where the way from n to q leaves, a function
    that is not positive at n, e and f is not positive either. *)
Lemma quadrilateral side f n e q g : 0 <= turn n e q -> 0 <= turn n q g -> 0 <= turn e q g -> 0 <= turn n e g ->
  value side n <= 0 -> 0 < value side q -> 0 <= value side e -> 0 <= value side g ->
  value f n <= 0 -> value f e <= 0 -> value f g <= 0 -> value f q * - value side n + value f n * value side q <= 0.
Proof.
  set (A := turn n e q). set (B := turn n q g). set (D := turn e q g). set (C := turn n e g). intros PA PB PD PC SN SQ SE SG FN FE FG.
  (* The diagonals meet. *)
  assert (Meet : forall h, B * value h e + A * value h g = D * value h n + C * value h q)
    by (intros h; unfold A, B, C, D, turn, value; ring).
  assert (Sum : A + B = C + D) by (unfold A, B, C, D, turn; ring).
  pose proof (Meet side) as MS. pose proof (Meet f) as MF.
  destruct (Rle_or_lt (value f q) 0) as [|FQ].
  { assert (0 <= - value f q * - value side n) by (apply Rmult_le_pos; lra). assert (0 <= - value f n * value side q) by (apply Rmult_le_pos; lra). lra. }
  assert (S1 : 0 <= B * value side e) by (apply Rmult_le_pos; lra). assert (S2 : 0 <= A * value side g) by (apply Rmult_le_pos; lra).
  assert (F1 : 0 <= B * - value f e) by (apply Rmult_le_pos; lra). assert (F2 : 0 <= A * - value f g) by (apply Rmult_le_pos; lra).
  destruct (Rlt_or_le 0 C) as [PosC|ZeroC].
  - apply Rmult_le_reg_l with C; [exact PosC|].
    assert (T1 : (C * value f q) * - value side n <= - (D * value f n) * - value side n) by (apply Rmult_le_compat_r; lra).
    assert (T2 : - value f n * (D * - value side n) <= - value f n * (C * value side q)) by (apply Rmult_le_compat_l; lra). lra.
  - assert (C0 : C = 0) by lra. rewrite C0 in *. destruct (Rlt_or_le 0 D) as [PosD|ZeroD].
    + assert (N0 : value side n = 0).
      { assert (0 <= D * - value side n) by (apply Rmult_le_pos; lra). assert (Z : D * value side n = 0) by lra. apply Rmult_integral in Z. lra. }
      rewrite N0. assert (0 <= - value f n * value side q) by (apply Rmult_le_pos; lra). lra.
    + (* All on a line. *)
      assert (A0 : A = 0) by lra.
      assert (Line : value f q * - value side n + value f n * value side q =
        (value f n - value f q) * value side n - value f n * (value side n - value side q)) by ring.
      assert (Turn : (value f e - value f n) * (value side q - value side n) - (value side e - value side n) * (value f q - value f n) =
        (by_v f * by_w side - by_w f * by_v side) * A) by (unfold A, turn, value; ring).
      rewrite A0, Rmult_0_r in Turn.
      assert (T1 : 0 <= (value side q - value side n) * - value f e) by (apply Rmult_le_pos; lra).
      assert (T2 : 0 <= value side e * (value f q - value f n)) by (apply Rmult_le_pos; lra). lra.
Qed.

(** The triangle itself: its corners are in order, and hold what is inside. *)
Definition whole : list place := [Place 0 0; Place 1 0; Place 0 1].
Definition inside (x : place) : Prop := 0 <= pv x /\ 0 <= pw x /\ pv x + pw x <= 1.

Lemma whole_in_order : in_order whole.
Proof.
  intros a b c H. unfold whole in H. inversion H as [|? ? ? S|? ? ? S]; subst.
  - exfalso. inversion S as [|? ? ? S1|? ? ? S1]; subst; inversion S1 as [|? ? ? S2|? ? ? S2]; subst; inversion S2.
  - inversion S as [|? ? ? S1|? ? ? S1]; subst; [inversion S1 as [|? ? ? S2|? ? ? S2]; subst; inversion S2|].
    inversion S1 as [|? ? ? S2|? ? ? S2]; subst; [inversion S2|]. unfold turn. cbn [pv pw]. lra.
Qed.

Lemma whole_holds x : inside x -> holds whole x.
Proof.
  intros (V & W & S) f H. pose proof (H (Place 0 0) ltac:(cbn; auto)) as A. pose proof (H (Place 1 0) ltac:(cbn; auto)) as B.
  pose proof (H (Place 0 1) ltac:(cbn; auto)) as C. unfold value in *. cbn [pv pw] in *.
  assert (0 <= - (at_0 f + by_v f * 0 + by_w f * 0) * (1 - pv x - pw x)) by (apply Rmult_le_pos; lra).
  assert (0 <= - (at_0 f + by_v f * 1 + by_w f * 0) * pv x) by (apply Rmult_le_pos; lra).
  assert (0 <= - (at_0 f + by_v f * 0 + by_w f * 1) * pw x) by (apply Rmult_le_pos; lra). lra.
Qed.

(** The greatest quotient. *)
Lemma greatest_slope side f : forall l, exists m, 0 <= m /\ (forall q, In q l -> 0 < value side q -> value f q <= m * value side q) /\
  (m = 0 \/ exists q, In q l /\ 0 < value side q /\ value f q = m * value side q).
Proof.
  induction l as [|p l (m & M & All & Some)]; [exists 0; repeat split; [lra|intros q []|now left]|].
  destruct (Rle_or_lt (value side p) 0) as [Out|In].
  { exists m. split; [exact M|split; [|destruct Some as [|(q & I & S)]; [now left|right; exists q; split; [now right|exact S]]]].
    intros q [-> |I] S; [lra|now apply All]. }
  destruct (Rle_or_lt (value f p) (m * value side p)) as [Less|More].
  { exists m. split; [exact M|split; [|destruct Some as [|(q & I & S)]; [now left|right; exists q; split; [now right|exact S]]]].
    intros q [<- |I] S; [exact Less|now apply All]. }
  assert (E : value f p = value f p / value side p * value side p) by (field; lra).
  assert (L : m <= value f p / value side p) by (apply Rmult_le_reg_r with (value side p); lra).
  exists (value f p / value side p). split; [lra|split].
  - intros q [<- |I] S; [lra|]. apply Rle_trans with (1 := All q I S). apply Rmult_le_compat_r; lra.
  - right. exists p. repeat split; [now left|exact In|exact E].
Qed.

(** The code, with what each corner is judged by. *)
Section Cut.
Variable corner : Type.
Variable place_of : corner -> place.
Variable stays : corner -> bool.
(** The new point between a corner that stays and one that goes. *)
Variable crossing : corner -> corner -> corner.

Definition new (last next : corner) : list corner :=
  if eqb (stays last) (stays next) then [] else [if stays last then crossing last next else crossing next last].
Fixpoint cut_from (last : corner) (l : list corner) : list corner :=
  match l with
  | [] => []
  | next :: rest => new last next ++ (if stays next then [next] else []) ++ cut_from next rest
  end.
(** [Polygon::cut]. *)
Definition cut (l : list corner) : list corner := match l with [] => [] | first :: _ => cut_from (List.last l first) l end.

(** The same, but nothing goes. *)
Fixpoint full_from (last : corner) (l : list corner) : list corner :=
  match l with [] => [] | next :: rest => new last next ++ next :: full_from next rest end.

Lemma cut_sub last l : sub (cut_from last l) (full_from last l).
Proof.
  revert last. induction l as [|next l IH]; intros last; cbn; [apply sub_nil|]. apply sub_app; [apply sub_refl|].
  destruct (stays next); cbn; [apply sub_take|apply sub_skip]; apply IH.
Qed.

Lemma stays_in_cut x l : stays x = true -> forall last, In x l -> In x (cut_from last l).
Proof.
  intros S. induction l as [|next l IH]; intros last []; cbn; apply in_or_app; right.
  - subst. rewrite S. now left.
  - apply in_or_app. right. now apply IH.
Qed.

(** A new point: where it comes from, and that the cut has it. *)
Definition is_new (l : list corner) (e : corner) : Prop := exists a b, In a l /\ In b l /\ stays a = true /\ stays b = false /\ e = crossing a b.

Lemma new_between last x l2 : forall l1, stays last <> stays x ->
  exists m1 e m2, full_from last (l1 ++ x :: l2) = m1 ++ e :: m2 ++ x :: full_from x l2 /\ is_new (last :: l1 ++ x :: l2) e /\ In e (cut_from last (l1 ++ x :: l2)).
Proof.
  intros l1. revert last. induction l1 as [|y l1 IH]; intros last N; cbn.
  - unfold new. destruct (eqb (stays last) (stays x)) eqn:E; [apply eqb_prop in E; contradiction|].
    exists [], (if stays last then crossing last x else crossing x last), []. split; [reflexivity|split; [|now left]].
    destruct (stays last) eqn:SL, (stays x) eqn:SX; try contradiction; [exists last, x|exists x, last]; cbn; auto 6.
  - destruct (eqb (stays last) (stays y)) eqn:E.
    + apply eqb_prop in E. rewrite E in N. destruct (IH y N) as (m1 & e & m2 & F & (a & b & IA & IB & S) & I).
      exists (new last y ++ y :: m1), e, m2. rewrite F. split; [now rewrite <- app_assoc|split].
      * exists a, b. split; [now right|split; [now right|exact S]].
      * apply in_or_app. right. apply in_or_app. now right.
    + assert (M : exists m2, full_from y (l1 ++ x :: l2) = m2 ++ x :: full_from x l2).
      { clear. revert y. induction l1 as [|z l1 IH]; intros y; cbn; [now exists (new y x)|]. destruct (IH z) as (m & ->). exists (new y z ++ z :: m). now rewrite <- app_assoc. }
      destruct M as (m2 & ->). unfold new. rewrite E. exists [], (if stays last then crossing last y else crossing y last), (y :: m2).
      split; [reflexivity|split; [|now left]].
      destruct (stays last) eqn:SL, (stays y) eqn:SY; try discriminate; [exists last, y|exists y, last]; cbn; auto 6.
Qed.

Lemma full_reaches last x l2 : forall l1, exists m, full_from last (l1 ++ x :: l2) = m ++ x :: full_from x l2.
Proof.
  intros l1. revert last. induction l1 as [|y l1 IH]; intros last; cbn; [now exists (new last x)|].
  destruct (IH y) as (m & ->). exists (new last y ++ y :: m). now rewrite <- app_assoc.
Qed.

Definition on_edges (l : list corner) : Prop := forall a b, In a l -> In b l -> stays a = true -> stays b = false ->
  between (place_of a) (place_of b) (place_of (crossing a b)).

Lemma full_in_order : forall l pre last, on_edges (last :: l) ->
  in_order (map place_of (pre ++ last :: l)) -> in_order (map place_of (pre ++ last :: full_from last l)).
Proof.
  induction l as [|next l IH]; intros pre last E O; cbn [full_from]; [exact O|].
  assert (E' : on_edges (next :: l)) by (intros a b A B; apply E; now right).
  unfold new. destruct (eqb (stays last) (stays next)) eqn:Q; cbn [app].
  - replace (pre ++ last :: next :: full_from next l) with ((pre ++ [last]) ++ next :: full_from next l) by now rewrite <- app_assoc.
    apply (IH (pre ++ [last]) next E'). now rewrite <- app_assoc.
  - set (e := if stays last then _ else _). replace (pre ++ last :: e :: next :: full_from next l) with ((pre ++ [last; e]) ++ next :: full_from next l) by now rewrite <- app_assoc.
    apply (IH (pre ++ [last; e]) next E'). rewrite <- app_assoc. cbn [app]. rewrite map_app in *. cbn [map] in *.
    apply insert_in_order; [|exact O]. unfold e. destruct (stays last) eqn:SL, (stays next) eqn:SN; try discriminate.
    + apply E; cbn; auto.
    + apply between_swap. apply E; cbn; auto.
Qed.

Lemma sub_map s l : sub s l -> sub (map place_of s) (map place_of l).
Proof. intros H. induction H; cbn; [apply sub_nil|now apply sub_skip|now apply sub_take]. Qed.

(** What is left was there, or is new. *)
Lemma cut_members e l : In e (cut l) -> In e l \/ is_new l e.
Proof.
  assert (H : forall l last, In e (cut_from last l) -> In e l \/ is_new (last :: l) e).
  { clear. induction l as [|next l IH]; intros last I; [destruct I|]. cbn in I. apply in_app_or in I as [I|I].
    - unfold new in I. destruct (stays last) eqn:SL, (stays next) eqn:SN; cbn in I; try contradiction; destruct I as [<- |[]]; right; [exists last, next|exists next, last]; cbn; auto 6.
    - apply in_app_or in I as [I|I].
      + destruct (stays next); [destruct I as [-> |[]]; left; now left|destruct I].
      + destruct (IH next I) as [L|(a & b & A & B & S)]; [left; now right|right]. exists a, b. split; [now right|split; [now right|exact S]]. }
  destruct l as [|first r]; [intros []|]. unfold cut. intros I. destruct (H _ _ I) as [L|(a & b & A & B & S)]; [now left|right].
  assert (Has : forall x, In x (List.last (first :: r) first :: first :: r) -> In x (first :: r)).
  { intros x [<- |X]; [|exact X]. rewrite (app_removelast_last (l := first :: r) first) at 2 by discriminate. apply in_or_app. right. now left. }
  exists a, b. split; [now apply Has|split; [now apply Has|exact S]].
Qed.

Section Closed.
Variables (l0 : list corner) (a : corner).
Notation l := (l0 ++ [a]).
Hypothesis order : in_order (map place_of l).
Hypothesis edges : on_edges l.
Notation walk := (full_from a l).

Lemma cut_is : cut l = cut_from a l.
Proof. clear order edges. unfold cut. destruct l as [|first r] eqn:E; [now destruct l0|]. rewrite <- E. f_equal. now rewrite last_last. Qed.

Lemma walk_in_order : in_order (map place_of walk).
Proof.
  apply sub_in_order with (map place_of (a :: walk)); [apply sub_map, sub_skip, sub_refl|]. apply (full_in_order l [] a).
  - assert (Has : forall x, In x (a :: l) -> In x l) by (intros x [<- |H]; [apply in_or_app; right; now left|exact H]).
    intros x y X Y. apply edges; now apply Has.
  - cbn [app map]. rewrite map_app in *. cbn [map] in *. now apply close_in_order.
Qed.

Lemma cut_in_order : in_order (map place_of (cut l)).
Proof. rewrite cut_is. apply sub_in_order with (2 := walk_in_order). apply sub_map, cut_sub. Qed.

(** What is new has its corners in the list. *)
Lemma new_corners m e : is_new m e -> (forall x, In x m -> In x l) -> is_new l e.
Proof. intros (x & y & X & Y & S) H. exists x, y. split; [now apply H|split; [now apply H|exact S]]. Qed.

Definition around (n q : corner) : Prop := exists e g, In e (cut l) /\ In g (cut l) /\ is_new l e /\ is_new l g /\
  0 <= turn (place_of n) (place_of e) (place_of q) /\ 0 <= turn (place_of n) (place_of q) (place_of g) /\
  0 <= turn (place_of e) (place_of q) (place_of g) /\ 0 <= turn (place_of n) (place_of e) (place_of g).

Lemma turns x y z : sub [x; y; z] walk -> 0 <= turn (place_of x) (place_of y) (place_of z).
Proof. intros H. apply walk_in_order. exact (sub_map _ _ H). Qed.

(** Four in order, wherever the list begins. *)
Lemma around_is n q e g : In e (cut l) -> In g (cut l) -> is_new l e -> is_new l g ->
  sub [n; e; q; g] walk \/ sub [e; q; g; n] walk \/ sub [q; g; n; e] walk \/ sub [g; n; e; q] walk -> around n q.
Proof.
  intros E G NE NG H. exists e, g. do 4 (split; [assumption|]).
  assert (T : forall x y z w, sub [x; y; z; w] walk -> 0 <= turn (place_of x) (place_of y) (place_of z) /\ 0 <= turn (place_of x) (place_of y) (place_of w) /\
    0 <= turn (place_of x) (place_of z) (place_of w) /\ 0 <= turn (place_of y) (place_of z) (place_of w)).
  { intros x y z w S. repeat split; apply turns; apply sub_trans with (2 := S); repeat first [apply sub_nil | apply sub_take | apply sub_skip]. }
  assert (C : forall x y z, 0 <= turn x y z -> 0 <= turn y z x /\ 0 <= turn z x y) by (intros x y z P; split; [now rewrite <- turn_cycle|now rewrite turn_cycle]).
  destruct H as [H|[H|[H|H]]]; apply T in H; destruct H as (H1 & H2 & H3 & H4);
    apply C in H1 as H1', H2 as H2', H3 as H3', H4 as H4'; destruct H1', H2', H3', H4'; repeat split; assumption.
Qed.

(** On both sides of a run of corners that go there is a new point. *)
Lemma around_all n q : In n l -> In q l -> stays n = true -> stays q = false -> around n q.
Proof.
  intros N Q SN SQ. assert (NQ : stays n <> stays q) by congruence. assert (QN : stays q <> stays n) by congruence.
  assert (Has : forall x, In x (a :: l) -> In x l) by (intros x [<- |H]; [apply in_or_app; right; now left|exact H]).
  (* What new_between gives, within the closed list. *)
  assert (Fill : forall last x l1 l2, stays last <> stays x -> (forall y, In y (last :: l1 ++ x :: l2) -> In y l) ->
    (forall e, In e (cut_from last (l1 ++ x :: l2)) -> In e (cut l)) ->
    exists m1 e m2, full_from last (l1 ++ x :: l2) = m1 ++ e :: m2 ++ x :: full_from x l2 /\ is_new l e /\ In e (cut l)).
  { intros last x l1 l2 D H C. destruct (new_between last x l2 l1 D) as (m1 & e & m2 & F & NE & I). exists m1, e, m2.
    split; [exact F|split; [exact (new_corners _ _ NE H)|now apply C]]. }
  assert (Tail : forall l1 x l2, l = l1 ++ x :: l2 -> forall e, In e (cut_from x l2) -> In e (cut l)).
  { intros l1 x l2 E e I. rewrite cut_is, E. clear - I. generalize a as b. revert I. induction l1 as [|y l1 IH]; intros I b; cbn; apply in_or_app; right; apply in_or_app; right; auto. }
  destruct (stays a) eqn:SA.
  - (* The list ends with a corner that stays. *)
    apply in_split in Q as (l1 & l2 & E). assert (L2 : exists l3, l2 = l3 ++ [a]).
    { destruct l2 as [|b l2] using rev_ind; [|exists l2; replace (l1 ++ q :: l2 ++ [b]) with ((l1 ++ q :: l2) ++ [b]) in E by (now rewrite <- app_assoc); now apply app_inj_tail in E as [_ ->]].
      apply app_inj_tail in E as [_ E]. congruence. }
    destruct L2 as (l3 & ->). assert (N2 := N). rewrite E in N2. apply in_app_or in N2 as [N2|[N2|N2]]; [|congruence|].
    + apply in_split in N2 as (l11 & l12 & ->). rewrite <- app_assoc in E. cbn [app] in E.
      destruct (full_reaches a n (l12 ++ q :: l3 ++ [a]) l11) as (m & F1).
      destruct (Fill n q l12 (l3 ++ [a]) NQ) as (m1 & e & m2 & F2 & NE & CE).
      { intros y Y. rewrite E. apply in_or_app. now right. }
      { exact (Tail _ _ _ E). }
      destruct (Fill q a l3 []) as (m3 & g & m4 & F3 & NG & CG); [congruence| | |].
      { intros y Y. rewrite E. apply in_or_app. right. right. apply in_or_app. now right. }
      { replace (l11 ++ n :: l12 ++ q :: l3 ++ [a]) with ((l11 ++ n :: l12) ++ q :: l3 ++ [a]) in E by (now rewrite <- app_assoc). exact (Tail _ _ _ E). }
      apply (around_is n q e g CE CG NE NG). left. rewrite E, F1, F2, F3.
      apply sub_right, sub_take, sub_right, sub_take, sub_right, sub_take, sub_right, sub_take, sub_nil.
    + destruct (Fill a q l1 (l3 ++ [a])) as (m1 & e & m2 & F1 & NE & CE); [congruence| | |].
      { intros y Y. apply Has. now rewrite E. }
      { intros y Y. now rewrite cut_is, E. }
      apply in_split in N2 as (l21 & l22 & E2). destruct (Fill q n l21 l22 QN) as (m3 & g & m4 & F2 & NG & CG).
      { intros y Y. rewrite E, E2. apply in_or_app. now right. }
      { rewrite E2 in E. exact (Tail _ _ _ E). }
      apply (around_is n q e g CE CG NE NG). right. left. rewrite E, F1, E2, F2.
      apply sub_right, sub_take, sub_right, sub_take, sub_right, sub_take, sub_right, sub_take, sub_nil.
  - (* It ends with one that goes. *)
    apply in_split in N as (l1 & l2 & E). assert (L2 : exists l3, l2 = l3 ++ [a]).
    { destruct l2 as [|b l2] using rev_ind; [|exists l2; replace (l1 ++ n :: l2 ++ [b]) with ((l1 ++ n :: l2) ++ [b]) in E by (now rewrite <- app_assoc); now apply app_inj_tail in E as [_ ->]].
      apply app_inj_tail in E as [_ E]. congruence. }
    destruct L2 as (l3 & ->). assert (Q2 := Q). rewrite E in Q2. apply in_app_or in Q2 as [Q2|[Q2|Q2]]; [|congruence|].
    + apply in_split in Q2 as (l11 & l12 & ->). rewrite <- app_assoc in E. cbn [app] in E.
      destruct (full_reaches a q (l12 ++ n :: l3 ++ [a]) l11) as (m & F1).
      destruct (Fill q n l12 (l3 ++ [a]) QN) as (m1 & g & m2 & F2 & NG & CG).
      { intros y Y. rewrite E. apply in_or_app. now right. }
      { exact (Tail _ _ _ E). }
      destruct (Fill n a l3 []) as (m3 & e & m4 & F3 & NE & CE); [congruence| | |].
      { intros y Y. rewrite E. apply in_or_app. right. right. apply in_or_app. now right. }
      { replace (l11 ++ q :: l12 ++ n :: l3 ++ [a]) with ((l11 ++ q :: l12) ++ n :: l3 ++ [a]) in E by (now rewrite <- app_assoc). exact (Tail _ _ _ E). }
      apply (around_is n q e g CE CG NE NG). right. right. left. rewrite E, F1, F2, F3.
      apply sub_right, sub_take, sub_right, sub_take, sub_right, sub_take, sub_right, sub_take, sub_nil.
    + destruct (Fill a n l1 (l3 ++ [a])) as (m1 & g & m2 & F1 & NG & CG); [congruence| | |].
      { intros y Y. apply Has. now rewrite E. }
      { intros y Y. now rewrite cut_is, E. }
      apply in_split in Q2 as (l21 & l22 & E2). destruct (Fill n q l21 l22 NQ) as (m3 & e & m4 & F2 & NE & CE).
      { intros y Y. rewrite E, E2. apply in_or_app. now right. }
      { rewrite E2 in E. exact (Tail _ _ _ E). }
      apply (around_is n q e g CE CG NE NG). right. right. right. rewrite E, F1, E2, F2.
      apply sub_right, sub_take, sub_right, sub_take, sub_right, sub_take, sub_right, sub_take, sub_nil.
Qed.
End Closed.

(** What goes is beyond the plane, and what is new is not before it: then nothing is lost that is not beyond. [SPLIT-1] *)
Theorem cut_keeps l side x : in_order (map place_of l) -> on_edges l ->
  (forall q, In q l -> stays q = false -> 0 < value side (place_of q)) ->
  (forall e, is_new l e -> 0 <= value side (place_of e)) ->
  holds (map place_of l) x -> value side x <= 0 -> holds (map place_of (cut l)) x.
Proof.
  intros O E Goes New H X. destruct l as [|p0 lr] using rev_ind; [exact H|]. clear IHlr. rename lr into l0. rename p0 into a.
  intros f F. assert (Kept : forall n, In n (l0 ++ [a]) -> stays n = true -> value f (place_of n) <= 0).
  { intros n N S. apply F. apply in_map. rewrite cut_is. now apply stays_in_cut. }
  destruct (greatest_slope side f (map place_of (l0 ++ [a]))) as (m & M & All & Some).
  (* f - m side is not positive at any corner. *)
  assert (Shift : forall p, value (Affine (at_0 f - m * at_0 side) (by_v f - m * by_v side) (by_w f - m * by_w side)) p = value f p - m * value side p)
    by (intros p; unfold value; cbn [at_0 by_v by_w]; ring).
  assert (L : value f x - m * value side x <= 0); [|assert (0 <= m * - value side x) by (apply Rmult_le_pos; lra); lra].
  rewrite <- Shift. apply H. intros p P. rewrite Shift. destruct (Rlt_or_le 0 (value side p)) as [Pos|Neg]; [pose proof (All p P Pos); lra|].
  apply in_map_iff in P as (n & <- & N). destruct (stays n) eqn:SN; [|specialize (Goes n N SN); lra].
  pose proof (Kept n N SN) as FN. destruct Some as [-> |(q' & I & S & V)]; [lra|]. apply in_map_iff in I as (q & <- & Q).
  assert (Cross : value f (place_of q) * - value side (place_of n) + value f (place_of n) * value side (place_of q) <= 0).
  { destruct (stays q) eqn:SQ.
    - pose proof (Kept q Q SQ) as FQ. assert (0 <= - value f (place_of q) * - value side (place_of n)) by (apply Rmult_le_pos; lra).
      assert (0 <= - value f (place_of n) * value side (place_of q)) by (apply Rmult_le_pos; lra). lra.
    - destruct (around_all l0 a O E n q N Q SN SQ) as (e & g & CE & CG & NE & NG & T1 & T2 & T3 & T4).
      apply (quadrilateral side f _ _ _ _ T1 T2 T3 T4); auto; apply F, in_map; assumption. }
  rewrite V in Cross. apply Rmult_le_reg_r with (value side (place_of q)); [exact S|]. lra.
Qed.
End Cut.
