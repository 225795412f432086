(** Climbs instead of a table: by grand uncles (Binder & Keller 2016, Section 2.2.1), and by parents (Áfra &
    Szirmay-Kalos 2014). *)

Require Import List PArith NArith Lia Bool Arith.
Require Import Tree Machine Register HashedKeys Resume Disjoint DisjointHashed.
Import ListNotations.

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
  - intros [k t] [y t2 r] (Hn & Ht & Hr) H. cbn in *. subst.
    destruct (N.eqb_spec t 0) as [->|]; [reflexivity|discriminate].
  - intros [k t] [y t2 r] [k' t'] (Hn & Ht & Hr) H. cbn in *. subst.
    assert (Hz : t <> 0%N) by (intros ->; discriminate).
    eexists; split; [apply uncle_climb_next; auto|]. cbn.
    pose proof (backtrack_even k t k' t' H) as He. unfold trail_backtrack in H.
    rewrite (proj2 (N.eqb_neq t 0) Hz) in H. injection H as <- <-. auto.
Qed.

(** [UNCLE-2] Register, uncles and the climb by grand uncles, without key and table, do what the reference does, where
    all records reach two levels at least. *)
Theorem uncle_reference decide stop fuel : size T <= fuel ->
  run uncle T decide stop fuel (start uncle) [] = Some (reference decide stop T).
Proof.
  eapply refines_reference; [exact (simulates_refines _ _ _ _ _ _
    (trail_refines T) uncle_simulates)|apply any_decision].
Qed.

(** ** With a second trail *)

(** The same climb; the second trail is shifted with the first. *)
Fixpoint marked_climb (fuel : nat) (y : positive) (t : N) (r : option positive) (s : N) : option (uncle_state * N) :=
  match fuel with
  | 0 => None
  | S fuel =>
      if N.eqb t 0 then None else
      match fill T Ui Ul y t r with
      | Some x => Some (Uncle x (N.lxor (shr t (ctz t)) 1) None, shr s (ctz t))
      | None => marked_climb fuel (grand_uncle y) (N.div2 (N.div2 t)) None (shr s 2)
      end
  end.

Definition uncle_disjoint : pruner := {|
  pstate := uncle_state * N;
  pstart := (Uncle 1 0 None, 0%N);
  pkey x := Some (u_node (fst x));
  pdescend d m x := (uncle_descend d (fst x), match d with Neither => snd x | _ => push m (snd x) end);
  pprune x := let '(Uncle y t r, s) := x in (Uncle y (N.ldiff t s) (prune_register t s r), s);
  pback x := let '(Uncle y t r, s) := x in marked_climb (N.size_nat t) y t r s |}.

Lemma marked_climb_next fuel : forall y t r s, t <> 0%N -> N.size_nat t <= fuel -> holds y t r ->
  marked_climb fuel y t r s = Some (Uncle (next y t) (N.lxor (shr t (ctz t)) 1) None, shr s (ctz t)).
Proof.
  induction fuel as [|fuel IH]; intros y t r s Ht Hf Hh; [destruct t as [|[| |]]; simpl in Hf;
    [congruence|lia|lia|lia]|].
  pose proof (uncle_climb_next (S fuel) y t r Ht Hf Hh) as Hu. cbn [uncle_climb marked_climb] in *.
  rewrite (proj2 (N.eqb_neq t 0) Ht) in *.
  destruct (fill T Ui Ul y t r) as [x|] eqn:Hx; [congruence|].
  assert (Hc : 2 < ctz t).
  { pose proof (fill_none _ _ _ _ _ _ Hh Ht Hx). unfold reach in H. destruct (at_key T y) as [[|]|]; lia. }
  destruct t as [|[p|[p|[p|p|]|]|]]; cbn in Hc; try lia.
  cbn [N.div2 Pos.div2] in *. rewrite IH by (cbn in *; first [discriminate|reflexivity|lia]).
  rewrite uncle_climb_next in Hu by (cbn in *; first [discriminate|reflexivity|lia]).
  f_equal. f_equal; [congruence|]. cbn [ctz ctz_pos]. unfold shr. rewrite N.shiftr_shiftr. f_equal. lia.
Qed.

Definition uncle_marked_stack (x : uncle_state * N) (k : positive) (p : list (positive * bool)) : Prop :=
  u_node (fst x) = k /\ holds k (u_trail (fst x)) (u_register (fst x)) /\
  fits k (u_trail (fst x)) /\ marked_pending k (u_trail (fst x)) (snd x) = p.

Lemma uncle_disjoint_refines : prefines T uncle_disjoint uncle_marked_stack.
Proof.
  split; unfold uncle_marked_stack; cbn [uncle_disjoint pstate pstart pkey pdescend pprune pback].
  - repeat split.
  - intros x k p (<- & _). reflexivity.
  - intros [[y t r] s] k p sd m l rr (Hy & Hr & Hf & Hp) _. cbn [fst snd u_node u_trail u_register] in *. subst y p.
    cbn [uncle_descend u_node u_trail u_register]. split; [reflexivity|].
    split; [apply only_holds; destruct (keep k t); auto using fill_holds|].
    split; [now apply (fits_child sd k t false)|apply (marked_child sd k t s false m)].
  - intros [[y t r] s] k p sd m l rr (Hy & Hr & Hf & Hp) _. cbn [fst snd u_node u_trail u_register] in *. subst y p.
    cbn [uncle_descend u_node u_trail u_register]. split; [reflexivity|]. split; [apply both_holds|].
    split; [now apply (fits_child sd k t true)|apply (marked_child sd k t s true m)].
  - intros [[y t r] s] k p (Hy & Hr & Hf & Hp) _. cbn [fst snd u_node u_trail u_register] in *. subst y p.
    split; [reflexivity|]. split; [now apply prune_holds|]. split; [now apply fits_ldiff|apply mask_is_unmarked].
  - intros [[y t r] s] k (Hy & Hr & Hf & Hp). cbn [fst snd u_node u_trail u_register] in *. subst y.
    pose proof (marked_pops k t s Hf) as H. rewrite Hp in H. unfold trail_backtrack in H.
    destruct (N.eqb_spec t 0) as [->|]; [reflexivity|discriminate].
  - intros [[y t r] s] k q m p (Hy & Hr & Hf & Hp). cbn [fst snd u_node u_trail u_register] in *. subst y.
    pose proof (marked_pops k t s Hf) as H. rewrite Hp in H. destruct H as (t' & Hb & Hf' & Hp').
    assert (Hz : t <> 0%N) by (intros ->; discriminate).
    eexists; split; [apply marked_climb_next; auto|]. cbn [fst snd u_node u_trail u_register holds].
    pose proof (backtrack_even k t q t' Hb) as He. unfold trail_backtrack in Hb.
    rewrite (proj2 (N.eqb_neq t 0) Hz) in Hb. injection Hb as <- <-. auto.
Qed.

(** [UNCLE-2, DISJOINT-1, DISJOINT-2, DISJOINT-3] The same with a second trail and the reference that leaves nodes
    out. *)
Theorem uncle_disjoint_reference decide mark stop found fuel : size T <= fuel ->
  prun T decide mark stop found uncle_disjoint fuel (pstart uncle_disjoint) [] =
  Some (pruned_reference T decide mark stop found).
Proof. intros H. eapply prefines_reference; [apply uncle_disjoint_refines|exact H]. Qed.

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

Lemma afra_simulates T : simulates T trail_machine afra any_descent eq.
Proof.
  split; cbn; try (intros; subst; reflexivity).
  - intros [y t] b <-. cbn. destruct t; [reflexivity|discriminate].
  - intros [y t] b a' <- H. exists a'. split; [|reflexivity]. destruct t; [discriminate|].
    rewrite parent_climb_backtracks; [exact H|auto|discriminate].
Qed.

(** [AFRA-1] The climb by parents does what the reference does. *)
Theorem afra_reference T decide stop fuel : size T <= fuel ->
  run afra T decide stop fuel (start afra) [] = Some (reference decide stop T).
Proof.
  eapply refines_reference; [exact (simulates_refines _ _ _ _ _ _ (trail_refines T) (afra_simulates T))|apply any_decision].
Qed.

(** * Where the bound is needed *)

Module Short.

(** Node 2 is postponed; then 13 is, and the search turns back there. *)
Definition T2 := Node Leaf (Node (Node Leaf Leaf) Leaf).
Definition d2 := by_key (fun k => match k with 1 => Both R | 3 => Only L | 6 => Both L | _ => Neither end)%positive.
Definition visits2 Ul := run (uncle T2 2 Ul always) T2 d2 never (size T2) (Uncle 1 0 None) [].

(** [UNCLE-2] The bound of [uncle_reference] is needed: if the record of a leaf names the uncle only, the climb passes
    over a grand uncle that is postponed, and node 2 is lost. *)
Example climb_passes_over : visits2 2 = Some (false, [2; 13; 12; 6; 3; 1]%positive) /\
  visits2 1 = Some (false, [13; 12; 6; 3; 1]%positive).
Proof. split; reflexivity. Qed.

End Short.
