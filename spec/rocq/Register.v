(** The register and the uncles: Algorithm 1 of Binder & Keller 2016, and the climb by grand uncles.

    A node is modelled by its key. The library works with addresses; an address and a key determine each other, and the
    only places where an address comes from are modelled as such: the children of a node, the rows of the records, and the
    lookup. So the state has a node and a key, and that they agree is a theorem, not an assumption. *)

Require Import List PArith NArith Lia Bool Arith.
Require Import Tree Machine.
Import ListNotations.

(** * Records *)

(** [UNCLE-1] What a record names: the siblings of the ancestors, from the parent's up. Where there is none it is the root,
    which is its own sibling here, and which is never postponed. *)
Definition row (reach : nat) (k : positive) : list positive := map (fun i => sibling (up i k)) (seq 1 reach).

(** The same from one level below. *)
Lemma row_parent reach k : row reach k = map (fun i => sibling (up i (Pos.div2 k))) (seq 0 reach).
Proof. unfold row. rewrite <- seq_shift, map_map. reflexivity. Qed.

(** [UNCLE-1] How the table is built, parents before children: a child's row is the parent's, moved up by one, behind the
    parent's sibling. *)
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

(** Whether the register is filled on a descent into a single child: as printed always, whenever a record is loaded. (On
    other descents it does not matter: the node that is postponed replaces what the register held.) *)
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
  intros H. destruct (reached_refines _ _ _ _ _ _ hashed_refines (any_decision decide) _ _ H) as (k & p & (a & Hs & Ha) & _).
  eauto.
Qed.

(** [REGISTER-1] Whenever the register is set, before a visit or after the record is loaded, it holds the node with the key
    (k >> n) ^ 1: the next one. Address and key agree at every step. *)
Theorem register_is_next s h : reached (C ideal) T decide stop s h ->
  node s = key s /\
  (forall x, register s = Some x -> trail s <> 0%N /\ x = sibling (up (ctz (trail s)) (key s))) /\
  (forall x, filled T Ui Ul s = Some x -> trail s <> 0%N /\ x = sibling (up (ctz (trail s)) (key s))).
Proof.
  intros H. destruct (reached_follows s h H) as ([k t] & Hn & Hk & Ht & Hr). cbn [fst snd] in *.
  rewrite Hn, Hk, Ht. split; [reflexivity|]. generalize (fill_holds T Ui Ul _ _ _ Hr). unfold filled. rewrite Hn, Ht.
  split; intros x Hx; [rewrite Hx in Hr; exact Hr|rewrite Hx in H0; exact H0].
Qed.

(** [REGISTER-1] A postponed sibling is always in the register. *)
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

(** [HASHED-1] Algorithm 1, over any table that is right on the keys that are asked, visits what the reference visits, and
    ends: for every tree, every search, every reach of the records, and however early the register is filled. *)
Theorem hashed_reference lookup fuel : (forall x, looked_up x -> lookup x = x) -> size T <= fuel ->
  run (C lookup) T decide stop fuel (start (C lookup)) [] = Some (reference decide stop T).
Proof.
  intros Hl Hf. etransitivity; [apply (run_lookup lookup Hl fuel (start (C ideal)) []); constructor|].
  exact (refines_reference _ _ _ _ _ _ hashed_refines (any_decision decide) fuel Hf).
Qed.

End Correct.

(** * When the register is filled *)

(** As printed: on every descent. *)
Definition always (k : positive) (t : N) : bool := true.

(** As here: on a descent into a single child only if none of the lowest [m] ancestors' siblings is postponed. What they
    are at the child, one level further away, its record names, if that reaches one further. *)
Definition leaving (m : nat) (k : positive) (t : N) : bool :=
  match lowest (row m k) (N.div2 t) with None => true | Some _ => false end.

Section Filling.

Variable T : tree.
Variables Ui Ul : nat.
Variable m : nat.
(** Whatever the child is, a leaf or not, its record reaches one level further. *)
Hypothesis in_reach : m <= Nat.min Ui Ul - 1.

Variable decide : history -> descent.
Variable stop : history -> bool.

Let A := hashed T Ui Ul always ideal.
Let B := hashed T Ui Ul (leaving m) ideal.

(** Here the register may still be empty where the present record names what the printed one holds. *)
Definition lags (a b : hashed_state) : Prop :=
  node b = node a /\ key b = key a /\ trail b = trail a /\
  (register b = register a \/
   register b = None /\ trail a <> 0%N /\ N.odd (trail a) = false /\ ctz (trail a) <= Nat.min Ui Ul /\
   register a = Some (next (node a) (trail a))).

Lemma lags_filled a b : lags a b -> filled T Ui Ul a = filled T Ui Ul b.
Proof.
  intros (Hn & _ & Ht & [Hr|(Hb & Hz & He & Hc & Ha)]); unfold filled; rewrite Hn, Ht; [now rewrite Hr|].
  rewrite Ha, Hb. unfold fill, named. rewrite row_lowest by assumption.
  replace (ctz (trail a) <=? reach T Ui Ul (node a)) with true; [reflexivity|].
  symmetry. apply Nat.leb_le. unfold reach. destruct (at_key T (node a)) as [[|]|]; lia.
Qed.

Lemma lags_only sd a b : holds (node a) (trail a) (register a) -> lags a b ->
  lags (hashed_descend T Ui Ul always (Only sd) a) (hashed_descend T Ui Ul (leaving m) (Only sd) b).
Proof.
  intros Hh Hl. pose proof (lags_filled a b Hl) as Hf. unfold filled in Hf.
  destruct a as [y k t ra], b as [y' k' t' rb], Hl as (Hn & Hk & Ht & Hr).
  cbn in Hn, Hk, Ht, Hr, Hf, Hh. subst y' k' t'. cbn. do 3 (split; [reflexivity|]). cbn [node trail register].
  unfold leaving. destruct rb as [x|].
  - left. destruct Hr as [<-|(Hb & _)]; [|discriminate]. cbn. now destruct (lowest (row m k) (N.div2 t)).
  - destruct (lowest (row m k) (N.div2 t)) as [x|] eqn:Hm; [right|left; congruence].
    assert (He : N.odd t = false) by (destruct Hr as [<-|Hr]; [exact Hh|apply Hr]).
    assert (Ht : t <> 0%N) by (intros ->; rewrite row_zero in Hm; discriminate).
    rewrite row_lowest in Hm by assumption. destruct (Nat.leb_spec (ctz t) m) as [Hc|]; [|discriminate].
    rewrite Hf. unfold fill, named. rewrite row_lowest by assumption.
    assert (He' : 1 <= ctz t) by (destruct t as [|[|p|]]; [congruence|discriminate|cbn; lia|discriminate]).
    replace (ctz t <=? reach T Ui Ul y) with true
      by (symmetry; apply Nat.leb_le; unfold reach; destruct (at_key T y) as [[|]|]; lia).
    rewrite next_only by assumption. destruct t as [|p]; [congruence|]. cbn in *. repeat split; try discriminate. lia.
Qed.

(** [REGISTER-1] Departure D-6: at every visit, and so whenever the search turns back, the register holds the same node as
    in the printed algorithm once the present record has been read. So there is no other visit and no other lookup. *)
Theorem filling_is_as_printed s h : reached A T decide stop s h -> exists s', reached B T decide stop s' h /\
  node s' = node s /\ key s' = key s /\ trail s' = trail s /\ filled T Ui Ul s' = filled T Ui Ul s.
Proof.
  intros H. enough (exists s', reached B T decide stop s' h /\ lags s s') as (s' & Hs' & Hl).
  { exists s'. split; [exact Hs'|]. pose proof (lags_filled s s' Hl). destruct Hl as (? & ? & ? & _). auto. }
  induction H as [|s h s1 h1 H (s' & Hs' & Hl) Hstep].
  - exists (start B). split; [constructor|]. repeat split. now left.
  - enough (exists s1', step B T decide stop s' h = Going s1' h1 /\ lags s1 s1') as (s1' & Hb & Hl1).
    { exists s1'. split; [eapply reached_step; eauto|exact Hl1]. }
    assert (Hback : forall h0, back A s h0 = Going s1 h1 -> exists s1', back B s' h0 = Going s1' h1 /\ lags s1 s1').
    { intros h0. unfold back. cbn [A B hashed backtrack]. unfold hashed_backtrack.
      rewrite (lags_filled s s' Hl). destruct Hl as (Hn & Hk & Ht & _). rewrite Hk, Ht.
      destruct (trail_backtrack (key s, trail s)) as [[k t]|]; [|discriminate]. intros [= <- <-].
      eexists; split; [reflexivity|]. repeat split. now left. }
    destruct (reached_follows T Ui Ul always decide stop s h H) as ([k0 t0] & Fn & _ & Ft & Hh).
    cbn [fst snd] in *. subst k0 t0.
    destruct Hl as (Hn & Hl). unfold step in *. cbn [A B hashed key_of backtrack descend] in *. rewrite Hn.
    destruct (at_key T (node s)) as [[|l r]|]; [| |discriminate].
    + destruct (stop (node s :: h)); [discriminate|]. apply Hback, Hstep.
    + destruct (decide (node s :: h)) as [|sd|sd].
      * apply Hback, Hstep.
      * injection Hstep as <- <-. eexists; split; [reflexivity|]. apply lags_only; [exact Hh|split; assumption].
      * injection Hstep as <- <-. eexists; split; [reflexivity|]. destruct s, s', Hl as (Hk & Ht & _).
        cbn in *. subst. repeat split. now left.
Qed.

End Filling.

(** * The climb by grand uncles *)

Section Uncle.

Variable T : tree.
Variables Ui Ul : nat.
Variable keep : positive -> N -> bool.
(** A climb over two levels passes over what no record has named. *)
Hypothesis reaches : 2 <= Ui /\ 2 <= Ul.

Record uncle_state := Uncle { u_node : positive; u_trail : N; u_register : option positive }.

Definition uncle_descend (d : descent) (s : uncle_state) : uncle_state :=
  let '(Uncle y t r) := s in
  match d with
  | Neither => s
  | Only sd => Uncle (child sd y) (N.double t) (if keep y t then fill T Ui Ul y t r else r)
  | Both sd => Uncle (child sd y) (N.succ_double t) (Some (child (other sd) y))
  end.

Definition grand_uncle (y : positive) : positive := nth 1 (row 2 y) xH.

(** Fills the register; if it stays empty, climbs over two levels, to the grand uncle. *)
Fixpoint uncle_climb (fuel : nat) (y : positive) (t : N) (r : option positive) : option uncle_state :=
  match fuel with
  | 0 => None
  | S fuel =>
      if N.eqb t 0 then None else
      match fill T Ui Ul y t r with
      | Some x => Some (Uncle x (N.lxor (shr t (ctz t)) 1) None)
      | None => uncle_climb fuel (grand_uncle y) (N.div2 (N.div2 t)) None
      end
  end.

Definition uncle : cursor := {|
  state := uncle_state;
  start := Uncle 1 0 None;
  key_of s := Some (u_node s);
  descend := uncle_descend;
  backtrack s := uncle_climb (N.size_nat (u_trail s)) (u_node s) (u_trail s) (u_register s) |}.

Lemma div2_sibling k : Pos.div2 (sibling k) = Pos.div2 k.
Proof. now destruct k. Qed.

Lemma uncle_climb_next fuel : forall y t r, t <> 0%N -> N.size_nat t <= fuel -> holds y t r ->
  uncle_climb fuel y t r = Some (Uncle (next y t) (N.lxor (shr t (ctz t)) 1) None).
Proof.
  induction fuel as [|fuel IH]; intros y t r Ht Hf Hh; [destruct t as [|[| |]]; simpl in Hf; [congruence|lia|lia|lia]|].
  cbn [uncle_climb]. rewrite (proj2 (N.eqb_neq t 0) Ht).
  destruct (fill T Ui Ul y t r) as [x|] eqn:Hx.
  - apply (fill_holds T Ui Ul) in Hh. rewrite Hx in Hh. destruct Hh as [_ ->]. reflexivity.
  - assert (Hc : 2 < ctz t).
    { pose proof (fill_none _ _ _ _ _ _ Hh Ht Hx). unfold reach in H. destruct (at_key T y) as [[|]|]; lia. }
    destruct t as [|[p|[p|[p|p|]|]|]]; cbn in Hc; try lia.
    cbn [N.div2 Pos.div2]. rewrite IH.
    + f_equal. f_equal; [|cbn [ctz ctz_pos]; now rewrite !shr_succ].
      unfold next, grand_uncle. cbn [ctz ctz_pos up row map seq nth]. now rewrite div2_sibling.
    + discriminate.
    + cbn in *. lia.
    + reflexivity.
Qed.

Definition uncle_follows (a : positive * N) (b : uncle_state) : Prop :=
  u_node b = fst a /\ u_trail b = snd a /\ holds (fst a) (snd a) (u_register b).

Lemma uncle_simulates : simulates T trail_machine uncle any_descent uncle_follows.
Proof.
  split; unfold uncle_follows.
  - repeat split.
  - intros a b (Hn & _). cbn. now rewrite Hn.
  - intros [k t] [y t2 r] d k1 l rr (Hn & Ht & Hr) _ _ Hd _. cbn in Hn, Ht, Hr. subst y t2.
    destruct d as [|sd|sd]; [congruence| |]; (do 2 (split; [reflexivity|])).
    + apply only_holds. cbn. destruct (keep k t); auto using fill_holds.
    + apply both_holds.
  - intros [k t] [y t2 r] (Hn & Ht & Hr) H. cbn in *. subst. destruct (N.eqb_spec t 0) as [->|]; [reflexivity|discriminate].
  - intros [k t] [y t2 r] [k' t'] (Hn & Ht & Hr) H. cbn in *. subst.
    assert (Hz : t <> 0%N) by (intros ->; discriminate).
    eexists; split; [apply uncle_climb_next; auto|]. cbn.
    pose proof (backtrack_even k t k' t' H) as He. unfold trail_backtrack in H.
    rewrite (proj2 (N.eqb_neq t 0) Hz) in H. injection H as <- <-. auto.
Qed.

(** [UNCLE-2] Register, uncles and the climb by grand uncles, without key and table, do what the reference does, where all
    records reach two levels at least. *)
Theorem uncle_reference decide stop fuel : size T <= fuel ->
  run uncle T decide stop fuel (start uncle) [] = Some (reference decide stop T).
Proof.
  eapply refines_reference; [exact (simulates_refines _ _ _ _ _ _ (trail_refines T) uncle_simulates)|apply any_decision].
Qed.

End Uncle.

(** * The climb by parents *)

(** While the sibling is not postponed, to the parent; then to the sibling. *)
Fixpoint parent_climb (fuel : nat) (y : positive) (t : N) : option (positive * N) :=
  match fuel with
  | 0 => None
  | S fuel => if N.odd t then Some (sibling y, N.lxor t 1) else parent_climb fuel (Pos.div2 y) (N.div2 t)
  end.

(** Áfra & Szirmay-Kalos 2014: node and trail, parent and sibling from the record. *)
Definition afra : cursor := {|
  state := positive * N;
  start := (xH, 0%N);
  key_of s := Some (fst s);
  descend := trail_descend;
  backtrack s := parent_climb (N.size_nat (snd s)) (fst s) (snd s) |}.

Lemma parent_climb_backtracks fuel : forall y t, N.size_nat t <= fuel -> t <> 0%N ->
  parent_climb fuel y t = trail_backtrack (y, t).
Proof.
  induction fuel as [|fuel IH]; intros y [|[p|p|]] Hf Ht; simpl in Hf; try congruence; try lia; try reflexivity.
  cbn [parent_climb N.odd N.div2 Pos.div2]. rewrite trail_backtrack_even. apply IH; [cbn; lia|discriminate].
Qed.

(** [AFRA-1] The climb by parents does what the reference does. *)
Theorem afra_reference T decide stop fuel : size T <= fuel ->
  run afra T decide stop fuel (start afra) [] = Some (reference decide stop T).
Proof.
  assert (S : simulates T trail_machine afra any_descent eq).
  { split; cbn; try (intros; subst; reflexivity).
    - intros [y t] b <-. cbn. destruct t; [reflexivity|discriminate].
    - intros [y t] b a' <- H. exists a'. split; [|reflexivity]. destruct t; [discriminate|].
      rewrite parent_climb_backtracks; [exact H|auto|discriminate]. }
  eapply refines_reference; [exact (simulates_refines _ _ _ _ _ _ (trail_refines T) S)|apply any_decision].
Qed.

(** * Where the conditions are needed *)

(** Decisions that depend on the node alone. *)
Definition by_key (f : positive -> descent) (h : history) : descent := match h with k :: _ => f k | [] => Neither end.
Definition never (h : history) : bool := false.

(** The lookups of a run, in order. *)
Fixpoint lookups T Ui Ul keep decide (fuel : nat) (s : hashed_state) (h : history) : list positive :=
  match fuel with
  | 0 => []
  | S fuel =>
      let turns := match at_key T (node s), decide (node s :: h) with Some (Node _ _), Neither | Some Leaf, _ => true
        | _, _ => false end in
      (match asks T Ui Ul s with Some x => if turns then [x] else [] | None => [] end) ++
      match step (hashed T Ui Ul keep ideal) T decide never s h with
      | Going s h => lookups T Ui Ul keep decide fuel s h
      | _ => []
      end
  end.

Module Examples.

(** Node 2 is postponed; at node 7, to which the search returns, the register is empty; 7 and 14 have single children. *)
Definition T1 := Node Leaf (Node Leaf (Node (Node (Node Leaf Leaf) Leaf) Leaf)).
Definition d1 := by_key (fun k => match k with 1 => Both R | 3 => Both L | 7 | 14 => Only L | _ => Neither end)%positive.
Definition lookups1 m := lookups T1 2 3 (leaving m) d1 (size T1) (Hashed 1 1 0 None) [].

(** [REGISTER-1] The bound of [filling_is_as_printed] is needed: where leaves name more than inner nodes do, and node 14
    leaves to its inner child what only a leaf would name, one lookup is made that the printed algorithm does not make. *)
Example leaving_too_late : lookups T1 2 3 always d1 (size T1) (Hashed 1 1 0 None) [] = [] /\
  lookups1 (Nat.min 2 3 - 1) = [] /\ lookups1 (Nat.min 2 (3 - 1)) = [2%positive].
Proof. repeat split. Qed.

(** Node 2 is postponed; then 13 is, and the search turns back there. *)
Definition T2 := Node Leaf (Node (Node Leaf Leaf) Leaf).
Definition d2 := by_key (fun k => match k with 1 => Both R | 3 => Only L | 6 => Both L | _ => Neither end)%positive.
Definition visits2 Ul := run (uncle T2 2 Ul always) T2 d2 never (size T2) (Uncle 1 0 None) [].

(** [UNCLE-2] The bound of [uncle_reference] is needed: if the record of a leaf names the uncle only, the climb passes over
    a grand uncle that is postponed, and node 2 is lost. *)
Example climb_passes_over : visits2 2 = Some (false, [2; 13; 12; 6; 3; 1]%positive) /\
  visits2 1 = Some (false, [13; 12; 6; 3; 1]%positive).
Proof. split; reflexivity. Qed.

End Examples.
