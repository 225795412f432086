(** Skip pointers: in the order left before right, Smits 1998; in any order that is fixed, as one set of them is for
    each octant of directions, Boulos & Haines 2006. *)

Require Import List PArith NArith.
Require Import Tree Machine Implicit.
Import ListNotations.

(** * Any order that is fixed *)

Section Order.

(** The child of a node that comes first: known before the search, the same at every visit. *)
Variable first : positive -> side.

(** A search that tests a node at its visit: it wants both children in that order, or none. Whether it wants them may
    change with time. *)
Definition by_node (accept : history -> bool) (h : history) : descent :=
  if accept h then Both (first (hd xH h)) else Neither.

(** [SKIP-1] How the pointers are made, parents before children: that of the first child is the second, that of the
    second is the parent's. The root, which nobody follows, means none. *)
Fixpoint skip (k : positive) : positive :=
  match k with
  | xH => xH
  | xO k => match first k with L => xI k | R => skip k end
  | xI k => match first k with L => skip k | R => xO k end
  end.

(** A node is all the state. *)
Definition skip_machine : cursor := {|
  state := positive;
  start := xH;
  key_of := Some;
  descend _ k := child (first k) k;
  backtrack k := match skip k with xH => None | q => Some q end |}.

(** What is postponed: the sibling of each ancestor that is a first child. *)
Fixpoint seconds (k : positive) : list positive :=
  match k with
  | xH => []
  | xO k => match first k with L => [xI k] | R => [] end ++ seconds k
  | xI k => match first k with L => [] | R => [xO k] end ++ seconds k
  end.

Lemma seconds_child k : seconds (child (first k) k) = child (other (first k)) k :: seconds k.
Proof. destruct (first k) eqn:E; cbn; now rewrite E. Qed.

Lemma seconds_of_second k q p : seconds k = q :: p -> seconds q = p.
Proof.
  induction k as [k IH|k IH|]; cbn; [| |discriminate].
  all: destruct (first k) eqn:E; cbn; try exact IH; intros [= <- <-]; cbn; now rewrite E.
Qed.

Lemma skip_is_second k : match seconds k with [] => skip k = xH | q :: _ => skip k = q /\ q <> xH end.
Proof.
  induction k as [k IH|k IH|]; cbn; [| |reflexivity].
  all: destruct (first k); cbn; try exact IH; split; congruence.
Qed.

(** What the search may decide at a node. *)
Definition in_order (k : positive) (d : descent) : Prop := d = Both (first k).

Lemma by_node_in_order accept k h : by_node accept (k :: h) = Neither \/ in_order k (by_node accept (k :: h)).
Proof. unfold by_node, in_order. destruct (accept (k :: h)); auto. Qed.

Lemma skip_refines T : refines skip_machine T in_order (fun (s k : positive) p => s = k /\ seconds k = p).
Proof.
  split; cbn; unfold in_order.
  - auto.
  - now intros s k p (-> & _).
  - discriminate.
  - intros s k p sd l r (-> & <-) _ [= ->]. split; [reflexivity|apply seconds_child].
  - intros s k (-> & H). pose proof (skip_is_second k) as E. rewrite H in E. now rewrite E.
  - intros s k q p (-> & H). exists q. pose proof (skip_is_second k) as E. rewrite H in E. destruct E as [-> Hq].
    split; [now destruct q|]. eauto using seconds_of_second.
Qed.

(** [SKIP-1] Skip pointers made for an order have the visits and the answer of the reference of any search that tests a
    node at its visit, if it takes the children in that order; and end. *)
Theorem skip_order_reference T accept stop fuel : size T <= fuel ->
  run skip_machine T (by_node accept) stop fuel (start skip_machine) [] = Some (reference (by_node accept) stop T).
Proof. apply (refines_reference _ _ _ _ _ _ (skip_refines T)), by_node_in_order. Qed.

End Order.

(** * The two orders of the library *)

(** [SKIP-1] In the order left before right the visits and the answer are those of a left-first search with tests of
    nodes. *)
Theorem skip_machine_reference T accept stop fuel : size T <= fuel ->
  let machine := skip_machine (fun _ => L) in
  run machine T (node_test accept) stop fuel (start machine) [] = Some (visit_left accept stop T xH []).
Proof. rewrite visit_left_is_visit. apply (skip_order_reference (fun _ => L)). Qed.

(** The near child: that with the smaller coordinates along the node's axis, unless the ray runs towards them. Where the
    left child holds the greater ones, the axis is marked as reversed. *)
Definition sign_order (axis : positive -> nat) (reversed : positive -> bool) (octant : nat -> bool) (k : positive) : side :=
  if xorb (octant (axis k)) (reversed k) then R else L.

(** [SKIP-1] With a set of pointers for each octant, each search goes by the set of its own. *)
Theorem skip_octant_reference axis reversed octant T accept stop fuel : size T <= fuel ->
  let near := sign_order axis reversed octant in
  run (skip_machine near) T (by_node near accept) stop fuel (start (skip_machine near)) [] =
  Some (reference (by_node near accept) stop T).
Proof. apply skip_order_reference. Qed.
