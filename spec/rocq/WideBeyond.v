(** What the set beside the bit of WIDE-18 must leave out: two machines that go wrong. *)

Require Import List NArith Lia Bool Sorted.
Require Import Wide WideMachine WideLevels WideKeep.
Import ListNotations.
Open Scope N_scope.

(** * What was beyond when the node was asked *)

(** Two leaves; the second begins beyond the end. The search wants both all the same. *)
Definition T := Inner (fun s => if s <? 2 then Some WLeaf else None).
Definition S := Search (fun _ _ => [0; 3]) (fun _ => false) (fun _ => 1).

(** [WIDE-18] with all that is wanted in the set. *)
Definition careless : keeper := {|
  level := N * bool;
  keep rs e := (slots_of 1 rs, false);
  worn := worn (word_keeper 1 (fun _ => false));
  take := take (word_keeper 1 (fun _ => false)) |}.

Lemma is_fair : fair 1 T S.
Proof.
  split; simpl; try reflexivity.
  - repeat constructor.
  - intros _ _. repeat constructor; intros H; repeat destruct H as [H|H]; discriminate || contradiction.
  - intros k _ r child Hk Hr. assert (E : Inner child = T).
    { revert child Hk. induction k as [|s k IH]; simpl; intros child Hk; [congruence|].
      destruct (at_path T k) as [[|c]|]; try discriminate. specialize (IH c eq_refl). injection IH as ->.
      destruct (s <? 2); discriminate. }
    injection E as ->. destruct Hr as [<-|[<-|[]]]; discriminate.
Qed.

(** [WIDE-18] The set must leave out what is beyond when the node is asked: else such a child, left alone, comes without a
    question, and the reference skips it. *)
Example careless_goes_beyond : fair 1 T S /\ reference 1 S T = (false, [[0]; []]) /\
  run 1 (level_machine 1 careless) T S 9 (start (level_machine 1 careless)) [] = Some (false, [[1]; [0]; []]).
Proof. split; [apply is_fair|split; reflexivity]. Qed.

(** * What was beyond when it was asked again *)

(** Three leaves; at the first the end becomes 4, and the third is beyond. *)
Definition T3 := Inner (fun s => if s <? 3 then Some WLeaf else None).
Definition S3 := Search (fun _ _ => [0; 5; 10]) (fun _ => false) (fun h => if Nat.ltb (length h) 2 then 8 else 4).

(** [WIDE-18] with a bit that is cleared when the node is asked again, and only the child that comes next taken out of the set. *)
Definition forgetful : keeper := {|
  level := N * bool;
  keep := keep (word_keeper 2 (fun _ => false));
  worn := worn (word_keeper 2 (fun _ => false));
  take ans e '(g, d) :=
    match take (word_keeper 2 (fun _ => false)) ans e (g, d) with
    | Some (s, _) => Some (s, (N.clearbit g s, false))
    | None => None
    end |}.

Lemma is_fair_3 : fair 2 T3 S3.
Proof.
  split; simpl; try reflexivity.
  - repeat constructor.
  - intros _ _. repeat constructor; intros H; repeat destruct H as [H|H]; discriminate || contradiction.
  - intros k _ r child Hk Hr. assert (E : Inner child = T3).
    { revert child Hk. induction k as [|s k IH]; simpl; intros child Hk; [congruence|].
      destruct (at_path T3 k) as [[|c]|]; try discriminate. specialize (IH c eq_refl). injection IH as ->.
      destruct (s <? 3); discriminate. }
    injection E as ->. destruct Hr as [<-|[<-|[<-|[]]]]; discriminate.
  - intros k h. destruct (PeanoNat.Nat.ltb_spec (Datatypes.S (length h)) 2), (PeanoNat.Nat.ltb_spec (length h) 2); lia.
Qed.

(** [WIDE-18] Nor may the bit be cleared when the node is asked again, if what is beyond by then stays in the set. *)
Example forgetful_goes_beyond : fair 2 T3 S3 /\ reference 2 S3 T3 = (false, [[1]; [0]; []]) /\
  run 2 (level_machine 2 forgetful) T3 S3 9 (start (level_machine 2 forgetful)) [] = Some (false, [[2]; [1]; [0]; []]).
Proof. split; [apply is_fair_3|split; reflexivity]. Qed.
