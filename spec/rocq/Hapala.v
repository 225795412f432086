(** Parents only, and an order that is asked again on the way up: Hapala et al. 2011. *)

Require Import Arith List PArith NArith Lia.
Require Import Tree Machine Bits Skip.
Import ListNotations.

Section Order.

(** The child of a node that comes first: the same whenever it is asked for. *)
Variable first : positive -> side.

(** The node, and the automaton's state: arrived from the parent, so this is the near child; else from the sibling or a
    child. *)
Record hapala_state := Hapala { h_node : positive; h_from_parent : bool }.

(** Up while this subtree is done and is not the near child's, then to the far child. From the root there is nowhere to
    go. *)
Fixpoint hapala_climb (fuel : nat) (s : hapala_state) : option hapala_state :=
  match fuel with
  | 0 => None
  | S fuel =>
      let '(Hapala k from_parent) := s in
      if from_parent then Some (Hapala (sibling k) false) else
      match k with
      | xH => None
      | _ =>
          let parent := Pos.div2 k in
          let from_parent :=
            match parent with
            | xH => from_parent
            | _ => let above := Pos.div2 parent in Pos.eqb (child (first above) above) parent
            end in
          hapala_climb fuel (Hapala parent from_parent)
      end
  end.

Definition hapala : cursor := {|
  state := hapala_state;
  start := Hapala xH false;
  key_of s := Some (h_node s);
  descend _ s := Hapala (child (first (h_node s)) (h_node s)) true;
  backtrack s := hapala_climb (S (depth (h_node s))) s |}.

(** Whether a node is the near child of its parent. *)
Definition near (k : positive) : bool :=
  match k with xH => false | _ => Pos.eqb (child (first (Pos.div2 k)) (Pos.div2 k)) k end.

Lemma near_child k : near (child (first k) k) = true.
Proof. unfold near. destruct (first k) eqn:E; cbn; rewrite E; apply Pos.eqb_refl. Qed.

Lemma near_sibling k : near k = true -> near (sibling k) = false.
Proof.
  destruct k; cbn; [| |discriminate]; destruct (first k); cbn; rewrite ?Pos.eqb_refl; intros H;
    try discriminate; reflexivity.
Qed.

(** The near children among a node and its ancestors are those whose siblings are postponed. *)
Lemma seconds_near k : k <> xH ->
  seconds first k = (if near k then [sibling k] else []) ++ seconds first (Pos.div2 k).
Proof. unfold near. destruct k as [k|k|]; [| |easy]; intros _; cbn; destruct (first k); cbn; now rewrite ?Pos.eqb_refl. Qed.

Lemma hapala_climbs fuel : forall k, depth k < fuel ->
  hapala_climb fuel (Hapala k (near k)) =
  match seconds first k with [] => None | q :: _ => Some (Hapala q (near q)) end.
Proof.
  induction fuel as [|fuel IH]; intros k Hk; [lia|]. destruct (Pos.eq_dec k xH) as [->|Hr]; [reflexivity|].
  rewrite (seconds_near k Hr). cbn [hapala_climb]. destruct (near k) eqn:Hn; [cbn; now rewrite near_sibling|].
  cbn [app]. rewrite <- IH by (destruct k; cbn in *; [lia|lia|easy]).
  destruct k as [k|k|]; [destruct k; reflexivity..|easy].
Qed.

Lemma hapala_refines T : refines hapala T (in_order first)
  (fun s k p => s = Hapala k (near k) /\ seconds first k = p).
Proof.
  split; cbn [hapala state start key_of descend backtrack h_node]; unfold in_order.
  - auto.
  - now intros s k p (-> & _).
  - discriminate.
  - intros s k p sd l r (-> & <-) _ [= ->]. cbn [h_node]. rewrite near_child, seconds_child. auto.
  - intros s k (-> & H). cbn [h_node]. now rewrite hapala_climbs, H by lia.
  - intros s k q p (-> & H). cbn [h_node]. rewrite hapala_climbs, H by lia. eauto using seconds_of_second.
Qed.

(** [HAPALA-1] Node and automaton, with parents and no trail, have the visits and the answer of the reference of any
    search that tests a node at its visit, also one whose tests change with time, if the order of children is fixed; and
    end. *)
Theorem hapala_reference T accept stop fuel : size T <= fuel ->
  run hapala T (by_node first accept) stop fuel (start hapala) [] = Some (reference (by_node first accept) stop T).
Proof. apply (refines_reference _ _ _ _ _ _ (hapala_refines T)), by_node_in_order. Qed.

End Order.
