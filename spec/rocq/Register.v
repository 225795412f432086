(** The register and the uncles: Algorithm 1 of Binder & Keller 2016.

    A node is modelled by its key. The library works with addresses; an address and a key determine each other, and
    the only places where an address comes from are modelled as such: the children of a node, the rows of the records,
    and the lookup. So the state has a node and a key, and that they agree is a theorem, not an assumption. *)

Require Import List PArith NArith Lia Bool Arith.
Require Import Tree Machine.
Import ListNotations.

(** * Records *)

(** [UNCLE-1] What a record names: the siblings of the ancestors, from the parent's up. Where there is none it is the
    root, which is its own sibling here, and which is never postponed. *)
Definition row (reach : nat) (k : positive) : list positive := map (fun i => sibling (up i k)) (seq 1 reach).

(** The same from one level below. *)
Lemma row_parent reach k : row reach k = map (fun i => sibling (up i (Pos.div2 k))) (seq 0 reach).
Proof. unfold row. rewrite <- seq_shift, map_map. reflexivity. Qed.

(** [UNCLE-1] How the table is built, parents before children: a child's row is the parent's, moved up by one, behind
    the parent's sibling. *)
Theorem row_child reach sd k : row (S reach) (child sd k) = sibling k :: row reach k.
Proof. rewrite row_parent. unfold row. destruct sd; reflexivity. Qed.

(** [UNCLE-2] Siblings have the same row: so a grand uncle stands in for the grandparent. *)
Theorem row_sibling reach k : row reach (sibling k) = row reach k.
Proof. rewrite !row_parent. destruct k; reflexivity. Qed.

(** The lowest postponed node of a row, whose first node has bit 0 here. *)
Fixpoint lowest (nodes : list positive) (t : N) : option positive :=
  match nodes with
  | [] => None
  | q :: nodes => if N.odd t then Some q else lowest nodes (N.div2 t)
  end.

(** The node that comes next: the one to which backtracking leads. *)
Definition next (k : positive) (t : N) : positive := sibling (up (ctz t) k).

Lemma lowest_spec reach : forall k t, t <> 0%N ->
  lowest (map (fun i => sibling (up i k)) (seq 0 reach)) t = if ctz t <? reach then Some (next k t) else None.
Proof.
  induction reach as [|reach IH]; intros k t Ht; [now destruct (ctz t)|].
  cbn [seq map lowest]. rewrite <- seq_shift, map_map.
  destruct t as [|[p|p|]]; [congruence| reflexivity | | reflexivity].
  apply (IH (Pos.div2 k) (Npos p)). discriminate.
Qed.

(** Where the sibling is not postponed, a record names the next node if that is within its reach, and no other. *)
Lemma row_lowest reach k t : t <> 0%N -> N.odd t = false ->
  lowest (row reach k) (N.div2 t) = if ctz t <=? reach then Some (next k t) else None.
Proof.
  intros Ht He. rewrite row_parent. destruct t as [|[p|p|]]; try discriminate; [congruence|].
  apply (lowest_spec reach (Pos.div2 k) (Npos p)). discriminate.
Qed.

Lemma row_zero reach k : lowest (row reach k) 0 = None.
Proof. unfold row. generalize (seq 1 reach). intros l. induction l; simpl; auto. Qed.

(** When the register is filled on a descent into a single child, by key and trail. As printed always, whenever a
    record is loaded. (On other descents it does not matter: the node that is postponed replaces what the register
    held.) *)
Definition always (k : positive) (t : N) : bool := true.

Section Traversals.

Variable T : tree.
(** How many ancestors' siblings the records of inner nodes and of leaves name. *)
Variables Ui Ul : nat.

Definition reach (k : positive) : nat := match at_key T k with Some Leaf => Ul | _ => Ui end.

(** What the record of a node says to an empty register. As printed: bit 0 is not looked at. *)
Definition named (k : positive) (t : N) : option positive := lowest (row (reach k) k) (N.div2 t).

Definition fill (k : positive) (t : N) (r : option positive) : option positive :=
  match r with None => named k t | _ => r end.

(** What is true of the register [r] at a node with key and trail: it holds nothing but the next node, and a postponed
    sibling is always in it. *)
Definition holds (k : positive) (t : N) (r : option positive) : Prop :=
  match r with Some x => t <> 0%N /\ x = next k t | None => N.odd t = false end.

Lemma fill_holds k t r : holds k t r -> holds k t (fill k t r).
Proof.
  destruct r as [x|]; [trivial|]. unfold fill, holds, named. intros He.
  destruct (N.eq_dec t 0) as [->|Ht]; [now rewrite row_zero|].
  rewrite row_lowest by assumption. destruct (ctz t <=? reach k); auto.
Qed.

(** Whenever the record leaves the register empty, the next node is out of its reach. *)
Lemma fill_none k t r : holds k t r -> t <> 0%N -> fill k t r = None -> reach k < ctz t.
Proof.
  destruct r as [x|]; [discriminate|]. unfold fill, holds, named. intros He Ht.
  rewrite row_lowest by assumption. destruct (Nat.leb_spec (ctz t) (reach k)); [discriminate|auto].
Qed.

(** A single child has the same next node. *)
Lemma next_only sd k t : t <> 0%N -> next (child sd k) (N.double t) = next k t.
Proof. destruct t; [congruence|]. destruct sd; reflexivity. Qed.

Lemma only_holds sd k t r : holds k t r -> holds (child sd k) (N.double t) r.
Proof.
  destruct r as [x|]; simpl.
  - intros [Ht ->]. split; [destruct t; [congruence|discriminate]|]. symmetry. now apply next_only.
  - intros _. now destruct t.
Qed.

Lemma both_holds sd k t : holds (child sd k) (N.succ_double t) (Some (child (other sd) k)).
Proof. destruct t, sd; split; try discriminate; reflexivity. Qed.

(** Backtracking clears bit 0. *)
Lemma backtrack_even k t k' t' : trail_backtrack (k, t) = Some (k', t') -> N.odd t' = false.
Proof.
  unfold trail_backtrack. destruct (N.eqb_spec t 0) as [->|Ht]; [discriminate|]. intros [= _ <-].
  destruct t as [|p]; [congruence|]. clear Ht.
  induction p as [p IH|p IH|]; [reflexivity| |reflexivity]. cbn [ctz ctz_pos]. rewrite shr_succ. exact IH.
Qed.

(** * Algorithm 1 *)

Record hashed_state := Hashed { node : positive; key : positive; trail : N; register : option positive }.

(** When the register is filled. *)
Variable keep : positive -> N -> bool.

(** The table. *)
Variable lookup : positive -> positive.

Definition hashed_descend (d : descent) (s : hashed_state) : hashed_state :=
  let '(Hashed y k t r) := s in
  match d with
  | Neither => s
  | Only sd => Hashed (child sd y) (child sd k) (N.double t) (if keep k t then fill y t r else r)
  | Both sd => Hashed (child sd y) (child sd k) (N.succ_double t) (Some (child (other sd) y))
  end.

(** The register after the visit, when the search turns back. *)
Definition filled (s : hashed_state) : option positive := fill (node s) (trail s) (register s).

Definition hashed_backtrack (s : hashed_state) : option hashed_state :=
  match trail_backtrack (key s, trail s) with
  | None => None
  | Some (k, t) => Some (Hashed (match filled s with Some x => x | None => lookup k end) k t None)
  end.

(** The key that is looked up, if one is, when the search turns back from this state. *)
Definition asks (s : hashed_state) : option positive :=
  match trail_backtrack (key s, trail s), filled s with Some (k, _), None => Some k | _, _ => None end.

Definition hashed : cursor := {|
  state := hashed_state;
  start := Hashed 1 1 0 None;
  key_of s := Some (node s);
  descend := hashed_descend;
  backtrack := hashed_backtrack |}.

End Traversals.

(** With a table that is right everywhere. *)
Definition ideal (k : positive) : positive := k.

(** Key and trail [a], and what the state [b] of Algorithm 1 is then. *)
Definition follows (a : positive * N) (b : hashed_state) : Prop :=
  node b = fst a /\ key b = fst a /\ trail b = snd a /\ holds (fst a) (snd a) (register b).

Section Correct.

Variable T : tree.
Variables Ui Ul : nat.
Variable keep : positive -> N -> bool.

Let C := hashed T Ui Ul keep.

Lemma hashed_simulates : simulates T trail_machine (C ideal) any_descent follows.
Proof.
  split; unfold follows; cbn [start trail_machine C hashed fst snd node key trail register].
  - repeat split.
  - intros a b (Hn & _). cbn. now rewrite Hn.
  - intros [k t] [y k2 t2 r] d k1 l rr (Hn & Hk & Ht & Hr) _ _ Hd _. cbn in *. subst.
    destruct d as [|sd|sd]; [congruence| |]; (do 3 (split; [reflexivity|])).
    + apply only_holds. cbn. destruct (keep k t); auto using fill_holds.
    + apply both_holds.
  - intros [k t] [y k2 t2 r] (Hn & Hk & Ht & Hr) H. cbn in *. subst. unfold hashed_backtrack. cbn in *. now rewrite H.
  - intros [k t] [y k2 t2 r] [k' t'] (Hn & Hk & Ht & Hr) H. cbn in *. subst.
    unfold hashed_backtrack. cbn [key trail]. unfold trail_backtrack. rewrite H.
    eexists; split; [reflexivity|]. cbn. repeat split; [|now apply (backtrack_even k t k')].
    unfold filled. cbn. apply (fill_holds T Ui Ul) in Hr. revert Hr.
    destruct (fill T Ui Ul k t r) as [x|]; [|reflexivity]. intros [_ ->].
    revert H. unfold next. destruct (t =? 0)%N; [discriminate|]. congruence.
Qed.

(** What the state of Algorithm 1 stands for. *)
Definition hashed_stack (s : hashed_state) (k : positive) (p : list positive) : Prop :=
  exists a, trail_stack a k p /\ follows a s.

Lemma hashed_refines : refines (C ideal) T any_descent hashed_stack.
Proof. exact (simulates_refines _ _ _ _ _ _ (trail_refines T) hashed_simulates). Qed.

Variable decide : history -> descent.
Variable stop : history -> bool.

(** The search goes back from the node that it has just visited, the head of the history. *)
Definition turns_back (h : history) : Prop :=
  match h with
  | [] => False
  | k :: _ => match at_key T k with Some Leaf => stop h = false | Some _ => decide h = Neither | None => False end
  end.

(** The keys that the search looks up. *)
Definition looked_up (x : positive) : Prop :=
  exists s h, reached (C ideal) T decide stop s h /\ turns_back (node s :: h) /\ asks T Ui Ul s = Some x.

Lemma reached_follows s h : reached (C ideal) T decide stop s h -> exists a, follows a s.
Proof.
  intros H. destruct (reached_refines _ _ _ _ _ _ hashed_refines (any_decision decide) _ _ H)
    as (k & p & (a & Hs & Ha) & _).
  eauto.
Qed.

(** [REGISTER-1](1) Whenever the register is set, before a visit or after the record is loaded, it holds the node with
    the key (k >> n) ^ 1: the next one. Address and key agree at every step. *)
Theorem register_is_next s h : reached (C ideal) T decide stop s h ->
  node s = key s /\
  (forall x, register s = Some x -> trail s <> 0%N /\ x = sibling (up (ctz (trail s)) (key s))) /\
  (forall x, filled T Ui Ul s = Some x -> trail s <> 0%N /\ x = sibling (up (ctz (trail s)) (key s))).
Proof.
  intros H. destruct (reached_follows s h H) as ([k t] & Hn & Hk & Ht & Hr). cbn [fst snd] in *.
  rewrite Hn, Hk, Ht. split; [reflexivity|]. generalize (fill_holds T Ui Ul _ _ _ Hr). unfold filled. rewrite Hn, Ht.
  split; intros x Hx; [rewrite Hx in Hr; exact Hr|rewrite Hx in H0; exact H0].
Qed.

(** [REGISTER-1](2) A postponed sibling is always in the register. *)
Theorem register_has_sibling s h : reached (C ideal) T decide stop s h -> N.odd (trail s) = true ->
  register s = Some (sibling (key s)).
Proof.
  intros H Ho. destruct (reached_follows s h H) as ([k t] & Hn & Hk & Ht & Hr). cbn [fst snd] in *. subst.
  rewrite Hk. destruct (register s) as [x|]; cbn in Hr; [|congruence]. destruct Hr as [_ ->].
  destruct (trail s) as [|[p|p|]]; try discriminate; reflexivity.
Qed.

(** The two machines have the same states; their types do not say so. *)
Definition same {lookup} (x : status (C lookup)) : status (C ideal) :=
  match x with Going s h => Going (s : state (C ideal)) h | Done b h => Done b h | Lost => Lost end.

(** A lookup that is right on the keys that are asked is as good as one that is right everywhere. *)
Lemma step_lookup lookup s h : (forall x, looked_up x -> lookup x = x) -> reached (C ideal) T decide stop s h ->
  same (step (C lookup) T decide stop s h) = step (C ideal) T decide stop s h.
Proof.
  intros Hl H.
  assert (B : turns_back (node s :: h) -> hashed_backtrack T Ui Ul lookup s = hashed_backtrack T Ui Ul ideal s).
  { intros Hb. unfold hashed_backtrack. destruct (trail_backtrack (key s, trail s)) as [[k t]|] eqn:Ht; [|reflexivity].
    destruct (filled T Ui Ul s) as [x|] eqn:Hf; [reflexivity|]. rewrite Hl; [reflexivity|].
    exists s, h. unfold asks. rewrite Ht, Hf. auto. }
  unfold turns_back in B. unfold step, back. cbn [C hashed key_of backtrack descend].
  destruct (at_key T (node s)) as [[|l r]|]; [| |reflexivity].
  - destruct (stop (node s :: h)); [reflexivity|]. rewrite B by reflexivity.
    now destruct (hashed_backtrack T Ui Ul ideal s).
  - destruct (decide (node s :: h)); try reflexivity. rewrite B by reflexivity.
    now destruct (hashed_backtrack T Ui Ul ideal s).
Qed.

Lemma run_lookup lookup : (forall x, looked_up x -> lookup x = x) -> forall fuel s h,
  reached (C ideal) T decide stop s h -> run (C lookup) T decide stop fuel s h = run (C ideal) T decide stop fuel s h.
Proof.
  intros Hl. induction fuel as [|fuel IH]; intros s h H; [reflexivity|].
  cbn [run]. rewrite <- (step_lookup lookup s h Hl H).
  destruct (step (C lookup) T decide stop s h) as [s' h'|b h'|] eqn:Hs; cbn [same]; [|reflexivity|reflexivity].
  apply IH. eapply reached_step; [exact H|]. rewrite <- (step_lookup lookup s h Hl H), Hs. reflexivity.
Qed.

(** [HASHED-1] Algorithm 1, over any table that is right on the keys that are asked, visits what the reference visits,
    and ends: for every tree, every search, every reach of the records, and however early the register is filled. *)
Theorem hashed_reference lookup fuel : (forall x, looked_up x -> lookup x = x) -> size T <= fuel ->
  run (C lookup) T decide stop fuel (start (C lookup)) [] = Some (reference decide stop T).
Proof.
  intros Hl Hf. etransitivity; [apply (run_lookup lookup Hl fuel (start (C ideal)) []); constructor|].
  exact (refines_reference _ _ _ _ _ _ hashed_refines (any_decision decide) fuel Hf).
Qed.

End Correct.

(** * For examples *)

(** Decisions that depend on the node alone. *)
Definition by_key (f : positive -> descent) (h : history) : descent := match h with k :: _ => f k | [] => Neither end.
Definition never (h : history) : bool := false.
