(** The machines as an OCaml program, and what it shows of their states.

    Numbers stay what they are in Rocq, chains of bits, and so do trees: no arithmetic of OCaml takes part. Only booleans,
    options, pairs and lists become OCaml's own ([ExtrOcamlBasic]). *)

Require Import ExtrOcamlBasic Extraction List PArith NArith.
Require Import Tree Machine Bits Implicit Skip Combined Sparse Words Register Filling Resume ByKey Disjoint DisjointHashed Climb.
Require Import Hapala LaineMachine PruningStack.
Require Wide WideMachine WideLevels WideKeep WideBits WideLeaves WideRestart.

(** What the library's [State] has too: as far as a machine has it. *)
Record shown := Shown {
  s_node : positive; s_key : option positive; s_trail : option N; s_counter : option N; s_marks : option N;
  s_register : option positive }.

Definition only_node (k : positive) := Shown k None None None None None.
Definition key_and_trail '((k, t) : positive * N) := Shown k (Some k) (Some t) None None None.

(** A machine, what it shows at the visit of a node, and its state at a node with a trail, where it can be taken up there. *)
Record viewed := Taken_up {
  machine : cursor; view : state machine -> positive -> shown; from : option (positive -> N -> state machine) }.
Definition Viewed machine view := Taken_up machine view None.

Definition counted (c : N) (k : positive) := Shown k (Some k) None (Some c) None None.
Definition stack := Viewed stack_machine (fun _ => only_node).
Definition hash_only := Taken_up trail_machine (fun s _ => key_and_trail s) (Some pair).
Definition hash_only_in W :=
  Viewed (word_machine W) (fun s k => Shown k (Some k) (Some (snd s)) None None None).
Definition left_first := Viewed left_first (fun '(start, index) => counted (start + index)).
Definition implicit_a := Viewed implicit_a (fun '(start, index, _) => counted (start + index)).
Definition implicit_b := Viewed implicit_b (fun '(start, index, _) => counted (start + index)).
Definition implicit_a1 := Viewed implicit_a1 (fun '(index, _) => counted index).
Definition implicit_b1 := Viewed implicit_b1 (fun _ k => Shown k (Some k) None None None None).
Definition skips first := Viewed (skip_machine first) (fun _ => only_node).
Definition hapala first := Viewed (hapala first) (fun _ => only_node).
(** With a table that is right everywhere. *)
Definition keyed := Viewed (by_key_machine ideal) (fun s k => Shown k (Some (fst (snd s))) (Some (snd (snd s))) None None None).

(** J's counter, with the start of the level: the trail's complement. *)
Definition counter_of (k : positive) (t : N) : N := (level_start k + counter (depth k) t)%N.
Definition sparse := Taken_up sparse (fun s k => Shown k None None (option_map snd s) None None)
  (Some (fun k t => Some (k, counter_of k t))).
Definition afra := Taken_up afra (fun s k => Shown k None (Some (snd s)) None None None) (Some pair).

(** Records name uncle and grand uncle. The register is filled as late as that allows, as in the library. *)
Definition late := leaving 1.
Definition uncle T := Taken_up (uncle T 2 2 late) (fun s k => Shown k None (Some (u_trail s)) None None (u_register s))
  (Some (fun k t => Uncle k t (located_register k t))).
Definition hashed T := Taken_up (hashed T 2 2 late ideal)
  (fun s k => Shown k (Some (key s)) (Some (trail s)) None None (register s)) (Some located).

(** The same for those that prune: with a second trail. *)
Record viewed_pruner := Viewed_pruner {
  pruning : pruner; pview : pstate pruning -> positive -> shown; pfrom : positive -> N -> N -> pstate pruning }.

Definition hash_only_disjoint := Viewed_pruner marked_machine
  (fun s k => Shown k (Some k) (Some (m_trail s)) None (Some (m_marks s)) None) Marked.
Definition afra_disjoint := Viewed_pruner marked_machine
  (fun s k => Shown k None (Some (m_trail s)) None (Some (m_marks s)) None) Marked.
(** That to count as done is to forget is [mask_of_counter]. *)
Definition sparse_disjoint := Viewed_pruner marked_machine
  (fun s k => Shown k None None (Some (counter_of k (m_trail s))) (Some (m_marks s)) None) Marked.
Definition uncle_disjoint T := Viewed_pruner (uncle_disjoint T 2 2 late)
  (fun s k => Shown k None (Some (u_trail (fst s))) None (Some (snd s)) (u_register (fst s)))
  (fun k t marks => (Uncle k t (located_register k t), marks)).
Definition hashed_disjoint T := Viewed_pruner (hashed_disjoint T 2 2 late ideal)
  (fun s k => Shown k (Some (key (fst s))) (Some (trail (fst s))) None (Some (snd s)) (register (fst s)))
  (fun k t marks => (located k t, marks)).

(** Taken up with the stack that key and trails stand for. *)
Definition stack_disjoint := Viewed_pruner marked_stack (fun _ => only_node) (fun k t marks => (k, marked_pending k t marks)).

(** [hashed_iff_high] *)
Definition is_hashed T Ui Ul (x : positive) : bool :=
  match x, at_key T (sibling x) with
  | xH, _ | _, None => false
  | _, Some t => Nat.leb (Nat.min (Ui + 2) (Ul + 1)) (height t)
  end.

Extraction Language OCaml.
Separate Extraction
  stack hash_only hash_only_in left_first implicit_a implicit_b implicit_a1 implicit_b1 sparse afra uncle hashed skips keyed
  hash_only_disjoint afra_disjoint sparse_disjoint uncle_disjoint hashed_disjoint is_hashed
  hapala stack_disjoint laine_run laine_start distance_run
  run reference prun pruned_reference at_key height size depth child sibling parent ctz push leap counter fcomp level_start all_ones
  Wide.reference WideMachine.run WideMachine.stack_machine WideLevels.level_machine
  WideKeep.trail_keeper WideKeep.word_keeper WideKeep.key_keeper
  WideBits.number_machine WideBits.key WideBits.path_of_key WideLeaves.leaves_first WideRestart.restart_machine.
