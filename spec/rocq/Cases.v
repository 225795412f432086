(** What the models see of a case that the library has written down (`Vectors.v`, by tests/library/rocq_vectors.rs): the visits and the
    answer of the reference, key and trail at each visit, J's counter at each visit, and what all machines answer. *)

Require Import List PArith NArith.
Require Import Tree Machine Bits Implicit Combined Sparse Words.
Import ListNotations.

(** Decisions by key. Each node is visited once at most, so this is any search. *)
Fixpoint decision (ds : list (positive * descent)) (k : positive) : descent :=
  match ds with
  | [] => Neither
  | (q, d) :: ds => if Pos.eqb q k then d else decision ds k
  end.

Definition decide_by (ds : list (positive * descent)) (h : history) : descent :=
  match h with k :: _ => decision ds k | [] => Neither end.

(** The leaf that ends the search, if one does. *)
Definition stop_at (leaf : option positive) (h : history) : bool :=
  match h, leaf with k :: _, Some q => Pos.eqb k q | _, _ => false end.

(** The states at the visits, in order. *)
Fixpoint states (C : cursor) T decide stop (fuel : nat) (s : state C) (h : history) : list (state C) :=
  match fuel with
  | 0 => []
  | S fuel => s :: match step C T decide stop s h with Going s h => states C T decide stop fuel s h | _ => [] end
  end.

Definition all_states (C : cursor) T decide stop : list (state C) := states C T decide stop (size T) (start C) [].

Definition answer T decide stop (C : cursor) : option (bool * history) := run C T decide stop (size T) (start C) [].

(** All machines for any search. Words of 8 bits are enough for 8 leaves. *)
Definition machines : list cursor :=
  [stack_machine; trail_machine; implicit_a; implicit_b; implicit_a1; implicit_b1; sparse; sparse_printed sibling;
   word_machine 8].

Definition seen T ds leaf :=
  let (decide, stop) := (decide_by ds, stop_at leaf) in
  (reference decide stop T, all_states trail_machine T decide stop, all_states sparse T decide stop,
   map (answer T decide stop) machines).

(** The same from the library's record: key, trail and [levelStart + levelIndex] of each visit. *)
Definition expected (stopped : bool) (visits : list (positive * N * N)) :=
  let answer := (stopped, rev (map (fun v => fst (fst v)) visits)) in
  (answer, map fst visits, map (fun '(k, _, c) => Some (k, c)) visits, repeat (Some answer) (length machines)).

(** Algorithm 1: the keys of the inner nodes that are accepted. *)
Definition accept_by (keys : list positive) (h : history) : bool :=
  match h with k :: _ => existsb (Pos.eqb k) keys | [] => false end.

Definition seen_left T keys leaf :=
  let (accept, stop) := (accept_by keys, stop_at leaf) in
  (visit_left accept stop T xH [], answer T (node_test accept) stop left_first,
   all_states left_first T (node_test accept) stop).

Definition expected_left (stopped : bool) (visits : list positive) :=
  let answer := (stopped, rev visits) in (answer, Some answer, map (fun k => (level_start k, path k)) visits).

(** A case of the conformance suite (`Suite.v`, by crates/suite/tests/rocq_suite.rs): what the reference answers, key and trail at each visit,
    and what machines answer whose words have no width. *)
Definition unbounded : list cursor := [stack_machine; trail_machine; implicit_a; implicit_b; sparse].

Definition stop_in (leaves : list positive) (h : history) : bool :=
  match h with k :: _ => existsb (Pos.eqb k) leaves | [] => false end.

Definition suite_seen T ds leaves :=
  let (decide, stop) := (decide_by ds, stop_in leaves) in
  (reference decide stop T, all_states trail_machine T decide stop, map (answer T decide stop) unbounded).

(** The same from the suite's file: whether a hit ends the search, and the keys and trails that are expected. *)
Definition suite_expected (stopped : bool) (visits : list (positive * N)) :=
  let answer := (stopped, rev (map fst visits)) in (answer, visits, repeat (Some answer) (length unbounded)).

(** Both sides are evaluated once, by the kernel. *)
Ltac evaluated := lazymatch goal with |- _ = ?expected => vm_cast_no_check (eq_refl expected) end.
