(** When the register is filled: departure D-6 of spec/DEPARTURES.md makes no difference. *)

Require Import List PArith NArith Lia Bool Arith.
Require Import Tree Machine Register.
Import ListNotations.

(** The rule here, where the printed one is [always]: on a descent into a single child only if none of the siblings of
    the lowest [m] ancestors is postponed. For those can wait: the child's record names them too, if it reaches one
    further. *)
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

(** [REGISTER-1] Departure D-6: at every visit, and so whenever the search turns back, the register holds the same
    node as in the printed algorithm once the present record has been read. So there is no other visit and no other
    lookup. *)
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

(** * Where the bound is needed *)

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

Module Late.

(** Node 2 is postponed; at node 7, to which the search returns, the register is empty; 7 and 14 have single
    children. *)
Definition T1 := Node Leaf (Node Leaf (Node (Node (Node Leaf Leaf) Leaf) Leaf)).
Definition d1 := by_key (fun k => match k with 1 => Both R | 3 => Both L | 7 | 14 => Only L
  | _ => Neither end)%positive.
Definition lookups1 m := lookups T1 2 3 (leaving m) d1 (size T1) (Hashed 1 1 0 None) [].

(** [REGISTER-1] The bound of [filling_is_as_printed] is needed: where leaves name more than inner nodes do, and node
    14 leaves to its inner child what only a leaf would name, one lookup is made that the printed algorithm does not
    make. *)
Example leaving_too_late : lookups T1 2 3 always d1 (size T1) (Hashed 1 1 0 None) [] = [] /\
  lookups1 (Nat.min 2 3 - 1) = [] /\ lookups1 (Nat.min 2 (3 - 1)) = [2%positive].
Proof. repeat split. Qed.

End Late.
