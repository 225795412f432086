(** Register and table under pruning: Algorithm 1 with a second trail. [DISJOINT-3] of spec/state.md. *)

Require Import List PArith NArith Lia Bool Arith.
Require Import Tree Machine Register HashedKeys Resume Disjoint.
Import ListNotations.


(** [DISJOINT-3] The register is unset if nothing is left or the next node is another one. *)
Definition prune_register (t marks : N) (r : option positive) : option positive :=
  let t' := N.ldiff t marks in if (t' =? 0)%N || negb (ctz t =? ctz t') then None else r.

Lemma marked_pending_siblings k : forall t s q m, In (q, m) (marked_pending k t s) -> In q (siblings k).
Proof.
  induction k as [k IH|k IH|]; intros t s q m; cbn [marked_pending siblings]; [| |tauto]; intros H;
    apply in_app_or in H; (destruct H as [H|H]; [left|right; eapply IH, H]);
    destruct (N.odd t); [|destruct H| |destruct H]; destruct H as [[= <- _]|[]]; reflexivity.
Qed.

Lemma odd_ctz t : N.odd t = true -> ctz t = 0.
Proof. destruct t as [|[|p|]]; [discriminate|reflexivity|discriminate|reflexivity]. Qed.

(** Then it still holds nothing but the next node. *)
Lemma prune_holds k t s r : holds k t r -> holds k (N.ldiff t s) (prune_register t s r).
Proof.
  unfold prune_register.
  intros Hr. destruct (N.eqb_spec (N.ldiff t s) 0) as [->|Hz]; [reflexivity|]. cbn [orb].
  assert (Hodd : N.odd (N.ldiff t s) = true -> ctz t = 0 /\ ctz (N.ldiff t s) = 0 /\ N.odd t = true).
  { intros H. pose proof (odd_ldiff t s) as E. rewrite H in E. symmetry in E. apply andb_prop in E. destruct E as [E _].
    auto using odd_ctz. }
  destruct (Nat.eqb_spec (ctz t) (ctz (N.ldiff t s))) as [E|E]; cbn [negb].
  - destruct r as [x|]; cbn in *; [|destruct (N.odd (N.ldiff t s)); [destruct Hodd as (_ & _ & ?);
      congruence|reflexivity]].
    split; [exact Hz|]. destruct Hr as [_ ->]. unfold next. now rewrite E.
  - cbn. destruct (N.odd (N.ldiff t s)); [|reflexivity]. destruct Hodd as (? & ? & _); [reflexivity|congruence].
Qed.

Section Hashed.

Variable T : tree.
Variables Ui Ul : nat.
Variable keep : positive -> N -> bool.
Variable lookup : positive -> positive.
Hypothesis table : forall x, hashed_key T Ui Ul x -> lookup x = x.

(** [DISJOINT-3] After a hit: the trail loses its bits. The leaf's record may fill the register later, on
    backtracking. *)
Definition hashed_prune (s : hashed_state) (marks : N) : hashed_state :=
  let '(Hashed y k t r) := s in Hashed y k (N.ldiff t marks) (prune_register t marks r).

(** Algorithm 1 with a second trail. *)
Definition hashed_disjoint : pruner := {|
  pstate := hashed_state * N;
  pstart := (Hashed 1 1 0 None, 0%N);
  pkey x := Some (node (fst x));
  pdescend d m x := (hashed_descend T Ui Ul keep d (fst x), match d with Neither => snd x | _ => push m (snd x) end);
  pprune x := (hashed_prune (fst x) (snd x), snd x);
  pback x := match hashed_backtrack T Ui Ul lookup (fst x) with
    | Some s => Some (s, shr (snd x) (ctz (trail (fst x)))) | None => None end |}.

Definition hashed_marked_stack (x : hashed_state * N) (k : positive) (p : list (positive * bool)) : Prop :=
  node (fst x) = k /\ key (fst x) = k /\ holds k (trail (fst x)) (register (fst x)) /\
    (exists u, at_key T k = Some u) /\
  fits k (trail (fst x)) /\ marked_pending k (trail (fst x)) (snd x) = p.

Lemma hashed_disjoint_refines : prefines T hashed_disjoint hashed_marked_stack.
Proof.
  split; unfold hashed_marked_stack; cbn [hashed_disjoint pstate pstart pkey pdescend pprune pback].
  - repeat split. now exists T.
  - intros x k p (<- & _). reflexivity.
  - intros [[y k' t r] s] k p sd m l rr (Hy & Hk & Hr & _ & Hf & Hp) Ha. cbn [fst snd node key trail register] in *.
    subst y k' p. cbn [hashed_descend node key trail register]. do 2 (split; [reflexivity|]).
    split; [apply only_holds; destruct (keep k t); auto using fill_holds|].
    split; [eauto using at_child|]. split; [now apply (fits_child sd k t false)|apply (marked_child sd k t s false m)].
  - intros [[y k' t r] s] k p sd m l rr (Hy & Hk & Hr & _ & Hf & Hp) Ha. cbn [fst snd node key trail register] in *.
    subst y k' p. cbn [hashed_descend node key trail register]. do 2 (split; [reflexivity|]).
    split; [apply both_holds|].
    split; [eauto using at_child|]. split; [now apply (fits_child sd k t true)|apply (marked_child sd k t s true m)].
  - intros [[y k' t r] s] k p (Hy & Hk & Hr & Hu & Hf & Hp) _. cbn [fst snd node key trail register] in *. subst y k' p.
    cbn [hashed_prune node key trail register]. do 2 (split; [reflexivity|]).
    split; [now apply prune_holds|]. split; [exact Hu|]. split; [now apply fits_ldiff|apply mask_is_unmarked].
  - intros [[y k' t r] s] k (Hy & Hk & _ & _ & Hf & Hp). cbn [fst snd node key trail register] in *. subst y k'.
    pose proof (marked_pops k t s Hf) as H. rewrite Hp in H. unfold hashed_backtrack. cbn [key trail]. now rewrite H.
  - intros [[y k' t r] s] k q m p (Hy & Hk & Hr & (u & Hu) & Hf & Hp). cbn [fst snd node key trail register] in *.
    subst y k'.
    pose proof (marked_pops k t s Hf) as H. rewrite Hp in H. destruct H as (t' & Hb & Hf' & Hp').
    unfold hashed_backtrack. cbn [key trail]. rewrite Hb. eexists; split; [reflexivity|].
    cbn [fst snd node key trail register].
    assert (Hz : t <> 0%N) by (intros ->; discriminate).
    assert (Eq : q = next k t) by (unfold trail_backtrack in Hb; rewrite (proj2 (N.eqb_neq t 0) Hz) in Hb;
      unfold next; congruence).
    split; [|split; [reflexivity|split; [exact (backtrack_even k t q t' Hb)|split; [|split; assumption]]]].
    + unfold filled. cbn [node trail register]. pose proof (fill_holds T Ui Ul k t r Hr) as Hx.
      destruct (fill T Ui Ul k t r) as [x|] eqn:E; [destruct Hx as [_ ->]; congruence|].
      rewrite Eq. apply table, (out_of_reach_is_hashed T Ui Ul k t u Hf Hz (fill_none T Ui Ul k t r Hr Hz E) Hu).
    + apply (siblings_in_tree T k u Hu). right. apply (marked_pending_siblings k t s q m). rewrite Hp. now left.
Qed.

(** [DISJOINT-3, HASH-3] Algorithm 1 with a second trail visits what the reference visits that leaves nodes out, and the
    keys of [HASH-3] are still enough for it. *)
Theorem hashed_disjoint_reference decide mark stop found fuel : size T <= fuel ->
  prun T decide mark stop found hashed_disjoint fuel (pstart hashed_disjoint) [] =
  Some (pruned_reference T decide mark stop found).
Proof. intros H. eapply prefines_reference; [apply hashed_disjoint_refines|exact H]. Qed.

End Hashed.

(** [DISJOINT-3] Departure D-20: at node 15, with uncle and grand uncle postponed and the uncle pruned, the search
    goes to the grand uncle. If the record fills the register before the bits are gone, it goes to the uncle with the
    other's key. *)
Example filled_too_soon : let T := Node Leaf (Node Leaf (Node Leaf Leaf)) in
  hashed_backtrack T 2 2 ideal (hashed_prune (Hashed 15 15 6 None) 2) = Some (Hashed 2 2 0 None) /\
  hashed_backtrack T 2 2 ideal (Hashed 15 15 (N.ldiff 6 2) (fill T 2 2 15 6 None)) = Some (Hashed 6 2 0 None).
Proof. split; reflexivity. Qed.
