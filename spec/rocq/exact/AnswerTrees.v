(** DET-1 for the boxes' test of the code, and for the references of the other library, which the traversals are proved to be. *)
Require Import Reals ZArith NArith List FinFun Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN.
Require Import StacklessExact.Filter StacklessExact.Slabs StacklessExact.Answer.
From Stackless Require Tree Wide.
Import ListNotations.
Open Scope R_scope.

(** * [Directed] *)

Section Directed.
(** The ray, in floats. *)
Variables ox oy oz dx dy dz : float.
Variables tmin tmax : float.
Definition origin : vec := Vec (B2R ox) (B2R oy) (B2R oz).
Definition direction : vec := Vec (B2R dx) (B2R dy) (B2R dz).

Definition axes (b : box) : list (axis 24 128) := [(ox, dx, lo_x b, hi_x b); (oy, dy, lo_y b, hi_y b); (oz, dz, lo_z b, hi_z b)].
Definition fits (b : box) : Prop := Forall (usual 24 128 eq_refl eq_refl) (axes b).

(** The box is hit, and not begun after the best distance so far. *)
Definition box_met (b : box) (best : float) : bool :=
  let '(near, far) := near_and_far 24 128 eq_refl eq_refl 2 (axes b) tmin tmax in Bleb near far && Bleb near best.

Lemma touched_box_is_met b best t : fits b -> in_box (along origin direction t) b -> within t tmin tmax -> is_nan best = false ->
  nearest t <= value best -> box_met b best = true.
Proof.
  intros U (X & Y & Z) W Nb Hb. inversion_clear U as [|? ? Ux U']. inversion_clear U' as [|? ? Uy U'']. inversion_clear U'' as [|? ? Uz _].
  pose proof (directed_touched_is_hit _ _ _ tmin tmax t Ux Uy Uz X Y Z W) as H. unfold box_met, axes. destruct (near_and_far _ _ _ _ _ _ _ _) as [near far].
  destruct H as [H1 H2]. rewrite H1. now apply H2.
Qed.

(** The slab test of the code, with two steps, for boxes and rays that it is asked for: any search that leaves out only what it tells to
    leave out has the first hit in the end. [DET-1, EXACT-13] *)
Theorem directed_answer mesh kernel compare root best : is_exact origin direction tmin tmax mesh kernel ->
  is_exact_order origin direction mesh kernel compare -> covers mesh fits root -> run tmax kernel compare box_met ([root], None) ([], best) ->
  is_least origin direction tmin tmax mesh kernel best.
Proof. intros K O C R. apply (one_answer origin direction tmin tmax mesh kernel K compare O box_met fits touched_box_is_met root best C R). Qed.
End Directed.

(** * The references *)

Section References.
Variables tmax : float.
Variable kernel : N -> option float.
Variable compare : N -> N -> comparison.
Variable met : box -> float -> bool.
Notation run := (run tmax kernel compare met).
Notation limit := (limit tmax).
Notation accept := (accept kernel compare).

Lemma run_trans s s' s'' : run s s' -> run s' s'' -> run s s''.
Proof. induction 1; [auto|]. intros. eapply goes; eauto. Qed.
Lemma run_one s s' : step tmax kernel compare met s s' -> run s s'.
Proof. intros. eapply goes; [eassumption|constructor]. Qed.

(** All triangles of a leaf. *)
Definition test_all (items : list N) (best : answer) : answer := fold_left (fun b i => accept i b) items best.

Lemma run_leaf b items : forall a c best, run (a ++ Leaf b items :: c, best) (a ++ c, test_all items best).
Proof.
  induction items as [|i items IH]; intros a c best; [apply run_one, leaves|].
  eapply goes; [apply (tests tmax kernel compare met a b [] i items c)|]. apply IH.
Qed.

(** ** Binary trees *)

Section Binary.
Variable boxes : positive -> box.
Variable items : positive -> list N.

Fixpoint tree_of (t : Tree.tree) (k : positive) : tree :=
  match t with Tree.Leaf => Leaf (boxes k) (items k) | Tree.Node l r => Inner (boxes k) [tree_of l (xO k); tree_of r (xI k)] end.

Variable T : Tree.tree.
Variable decide : Tree.history -> Tree.descent.
(** Whether the leaf that it has come to is tested. *)
Variable wants : Tree.history -> bool.

(** The best so far, by the visits. *)
Fixpoint best_of (h : Tree.history) : answer :=
  match h with
  | [] => None
  | k :: h' => match Tree.at_key T k with Some Tree.Leaf => if wants h then test_all (items k) (best_of h') else best_of h' | _ => best_of h' end
  end.

(** It leaves out a child, or what it has come to, only by the test of the box with the best so far. *)
Definition skips_by_boxes : Prop := forall k h t, Tree.at_key T k = Some t ->
  let skipped q := met (boxes q) (limit (best_of h)) = false in
  match t with
  | Tree.Leaf => wants (k :: h) = true \/ skipped k
  | Tree.Node _ _ => match decide (k :: h) with
    | Tree.Neither => skipped k \/ forall sd, skipped (Tree.child sd k)
    | Tree.Only sd => skipped (Tree.child (Tree.other sd) k)
    | Tree.Both _ => True end
  end.
Hypothesis by_boxes : skips_by_boxes.

Lemma box_of_tree t k : box_of (tree_of t k) = boxes k.
Proof. now destruct t. Qed.

Lemma at_child sd l r k : Tree.at_key T k = Some (Tree.Node l r) -> Tree.at_key T (Tree.child sd k) = Some (Tree.subtree sd l r).
Proof. intros H. destruct sd; cbn; now rewrite H. Qed.

Lemma visit_runs t : forall k h a rest, Tree.at_key T k = Some t ->
  let v := Tree.visit decide (fun _ => false) t k h in
  fst v = false /\ run (a ++ tree_of t k :: rest, best_of h) (a ++ rest, best_of (snd v)).
Proof.
  induction t as [|l IHl r IHr]; intros k h a rest Hk; pose proof (by_boxes k h _ Hk) as B; cbn zeta in B.
  - split; [reflexivity|]. cbn [Tree.visit snd best_of tree_of]. rewrite Hk. destruct (wants (k :: h)) eqn:Hw; [apply run_leaf|].
    destruct B as [B|B]; [discriminate|]. now apply run_one, skips.
  - set (c := fun sd => tree_of (Tree.subtree sd l r) (Tree.child sd k)).
    assert (IH : forall sd h a rest, let v := Tree.visit decide (fun _ => false) (Tree.subtree sd l r) (Tree.child sd k) h in
      fst v = false /\ run (a ++ c sd :: rest, best_of h) (a ++ rest, best_of (snd v))).
    { intros sd h' a' rest'. pose proof (at_child sd l r k Hk). destruct sd; [apply IHl|apply IHr]; assumption. }
    clear IHl IHr. assert (E : best_of (k :: h) = best_of h) by (cbn; now rewrite Hk).
    assert (Open : run (a ++ tree_of (Tree.Node l r) k :: rest, best_of h) (a ++ c Tree.L :: c Tree.R :: rest, best_of h)).
    { apply run_one, (opens tmax kernel compare met a (boxes k) [c Tree.L; c Tree.R] rest). }
    assert (Drop : forall sd a rest b, met (boxes (Tree.child sd k)) (limit b) = false -> run (a ++ c sd :: rest, b) (a ++ rest, b)).
    { intros sd a' rest' b M. apply run_one, skips. unfold c. now rewrite box_of_tree. }
    cbn [Tree.visit]. destruct (decide (k :: h)) as [|sd|sd].
    + cbn [fst snd]. rewrite E. split; [reflexivity|]. destruct B as [B|B]; [now apply run_one, skips|].
      eapply run_trans; [exact Open|]. eapply run_trans; [apply (Drop Tree.L), (B Tree.L)|apply (Drop Tree.R), (B Tree.R)].
    + destruct (IH sd (k :: h) a rest) as [Hf Hr]. rewrite E in Hr. split; [exact Hf|]. eapply run_trans; [exact Open|]. eapply run_trans; [|exact Hr].
      destruct sd; [|apply (Drop Tree.L), B]. rewrite <- !(app_assoc a [c Tree.L]) || idtac.
      replace (a ++ c Tree.L :: c Tree.R :: rest) with ((a ++ [c Tree.L]) ++ c Tree.R :: rest) by (rewrite <- app_assoc; reflexivity).
      replace (a ++ c Tree.L :: rest) with ((a ++ [c Tree.L]) ++ rest) by (rewrite <- app_assoc; reflexivity). apply (Drop Tree.R), B.
    + set (v1 := Tree.visit decide (fun _ => false) (Tree.subtree sd l r) (Tree.child sd k) (k :: h)).
      assert (R1 : fst v1 = false /\ run (a ++ c Tree.L :: c Tree.R :: rest, best_of h) (a ++ c (Tree.other sd) :: rest, best_of (snd v1))).
      { unfold v1. rewrite <- E. destruct sd; cbn [Tree.other]; [apply (IH Tree.L)|].
        replace (a ++ c Tree.L :: c Tree.R :: rest) with ((a ++ [c Tree.L]) ++ c Tree.R :: rest) by (rewrite <- app_assoc; reflexivity).
        replace (a ++ c Tree.L :: rest) with ((a ++ [c Tree.L]) ++ rest) by (rewrite <- app_assoc; reflexivity). apply (IH Tree.R). }
      fold v1. destruct v1 as [s1 h1]. cbn [fst snd] in R1. destruct R1 as [-> R1].
      destruct (IH (Tree.other sd) h1 a rest) as [Hf Hr]. split; [exact Hf|].
      eapply run_trans; [exact Open|]. eapply run_trans; [exact R1|exact Hr].
Qed.

(** The reference of the other library, which the traversals of binary trees are proved to be, is such a search. [DET-1] *)
Theorem binary_reference_runs : run ([tree_of T xH], None) ([], best_of (snd (Tree.reference decide (fun _ => false) T))).
Proof. apply (visit_runs T xH [] [] [] eq_refl). Qed.
End Binary.

(** ** Trees of 2, 4 or 8 children *)

Section Wide.
Variable B : N.
Variable boxes : Wide.path -> box.
Variable items : Wide.path -> list N.

Definition slots : list N := map N.of_nat (seq 0 (N.to_nat (2 ^ B))).
Fixpoint wide_of (t : Wide.wide) (k : Wide.path) : tree :=
  match t with
  | Wide.WLeaf => Leaf (boxes k) (items k)
  | Wide.Inner child => Inner (boxes k)
      (flat_map (fun s => match child s with Some t => [wide_of t (s :: k)] | None => [] end) slots)
  end.

Variable T : Wide.wide.
Variable S : Wide.search.

Fixpoint wide_best (h : Wide.history) : answer :=
  match h with
  | [] => None
  | k :: h => match Wide.at_path T k with Some Wide.WLeaf => test_all (items k) (wide_best h) | _ => wide_best h end
  end.

(** It never stops, and leaves out a child, at once or when it comes to it, only by the test of the box with the best so far. *)
Record wide_by_boxes : Prop := WideByBoxes {
  w_stop h : Wide.stop S h = false;
  w_unwanted k h s : Wide.at_path T (s :: k) <> None -> (forall r, In r (Wide.ask S k (k :: h)) -> Wide.slot B r <> s) -> met (boxes (s :: k)) (limit (wide_best (k :: h))) = false;
  w_beyond k h h' r : Wide.at_path T (Wide.slot B r :: k) <> None -> In r (Wide.ask S k h') ->
     Wide.beyond B (Wide.edge S h) r = true -> met (boxes (Wide.slot B r :: k)) (limit (wide_best h)) = false }.
Hypothesis by_boxes : wide_by_boxes.

Lemma box_of_wide t k : box_of (wide_of t k) = boxes k.
Proof. now destruct t. Qed.

Section Children.
Variable child : N -> option Wide.wide.
Variable k : Wide.path.
Definition some_of (L : list N) : list tree := flat_map (fun s => match child s with Some t => [wide_of t (s :: k)] | None => [] end) L.

Lemma some_app L L' : some_of (L ++ L') = some_of L ++ some_of L'.
Proof. apply flat_map_app. Qed.

(** What is not wanted goes. *)
Lemma run_unwanted (wanted : N -> bool) best c : (forall s, child s <> None -> wanted s = false -> met (boxes (s :: k)) (limit best) = false) ->
  forall L a,
  run (a ++ some_of L ++ c, best) (a ++ some_of (filter wanted L) ++ c, best).
Proof.
  intros H L. induction L as [|s L IH]; intros a; [constructor|]. cbn [filter]. unfold some_of at 1. cbn [flat_map]. fold (some_of L).
  destruct (wanted s) eqn:W.
  - unfold some_of at 2. cbn [flat_map]. fold (some_of (filter wanted L)). rewrite <- !app_assoc, !(app_assoc a). apply IH.
  - destruct (child s) as [t|] eqn:Hc; [|apply IH]. eapply run_trans; [|apply IH]. apply run_one. cbn [app].
    apply (skips tmax kernel compare met a (wide_of t (s :: k)) (some_of L ++ c)). rewrite box_of_wide. apply H; [congruence|exact W].
Qed.
End Children.

Definition visits_run (t : Wide.wide) : Prop := forall k h a rest, Wide.at_path T k = Some t ->
  let v := Wide.visit B S t k h in
  fst v = false /\ run (a ++ wide_of t k :: rest, wide_best h) (a ++ rest, wide_best (snd v)).

Lemma each_runs child k h0 : Wide.at_path T k = Some (Wide.Inner child) -> (forall s t, child s = Some t -> visits_run t) ->
  forall rs h L a rest, (forall r, In r rs -> In r (Wide.ask S k h0)) -> NoDup L -> (forall s, In s L -> In s (map (Wide.slot B) rs)) ->
  let v := Wide.each (fun h r => Wide.beyond B (Wide.edge S h) r)
    (fun r h => match child (Wide.slot B r) with Some t => Wide.visit B S t (Wide.slot B r :: k) h | None => (false, h) end) rs h in
  fst v = false /\ run (a ++ some_of child k L ++ rest, wide_best h) (a ++ rest, wide_best (snd v)).
Proof.
  intros Hk IH. induction rs as [|r rs IHr]; intros h L a rest Hin Nd HL.
  { destruct L as [|s L]; [split; [reflexivity|constructor]|]. destruct (HL s (or_introl eq_refl)). }
  assert (Hin' : forall x, In x rs -> In x (Wide.ask S k h0)) by (intros; apply Hin; now right). cbn [Wide.each].
  set (s := Wide.slot B r) in *. set (others := fun x => negb (x =? s)%N).
  assert (Ho : NoDup (filter others L) /\ forall x, In x (filter others L) -> In x (map (Wide.slot B) rs)).
  { split; [now apply NoDup_filter|]. intros x Hx. apply filter_In in Hx. destruct Hx as [Hx Ne]. apply negb_true_iff, N.eqb_neq in Ne.
    destruct (HL x Hx) as [E|E]; [now contradict Ne|exact E]. }
  destruct (Wide.beyond B (Wide.edge S h) r) eqn:Be.
  - destruct (IHr h (filter others L) a rest Hin' (proj1 Ho) (proj2 Ho)) as [Hf Hr]. split; [exact Hf|]. eapply run_trans; [|exact Hr].
    apply run_unwanted. intros x Hc Hx. apply negb_false_iff, N.eqb_eq in Hx. subst x.
    apply (w_beyond by_boxes k h h0 r); [cbn; now rewrite Hk|apply Hin; now left|exact Be].
  - destruct (child s) as [t|] eqn:Hc.
    + assert (Hp : Wide.at_path T (s :: k) = Some t) by (cbn; now rewrite Hk).
      destruct (in_dec N.eq_dec s L) as [Hs|Hs].
      * apply in_split in Hs. destruct Hs as (L1 & L2 & ->). pose proof (NoDup_remove _ _ _ Nd) as [Nd' Ns].
        replace (a ++ some_of child k (L1 ++ s :: L2) ++ rest) with ((a ++ some_of child k L1) ++ wide_of t (s :: k) :: some_of child k L2 ++ rest).
        2:{ rewrite some_app. change (some_of child k (s :: L2)) with ((match child s with Some t => [wide_of t (s :: k)] | None => [] end) ++ some_of child k L2).
            rewrite Hc, <- !app_assoc. reflexivity. }
        destruct (IH s t Hc (s :: k) h (a ++ some_of child k L1) (some_of child k L2 ++ rest) Hp) as [Hf Hr].
        destruct (Wide.visit B S t (s :: k) h) as [st h1]. cbn [fst snd] in *. subst st.
        replace ((a ++ some_of child k L1) ++ some_of child k L2 ++ rest) with (a ++ some_of child k (L1 ++ L2) ++ rest) in Hr
          by (rewrite some_app, <- !app_assoc; reflexivity).
        destruct (IHr h1 (L1 ++ L2) a rest Hin' Nd') as [Hf' Hr'].
        { intros x Hx. destruct (HL x) as [E|E]; [|subst x; contradiction|exact E]. apply in_app_or in Hx. apply in_or_app. cbn. tauto. }
        split; [exact Hf'|]. eapply run_trans; [exact Hr|exact Hr'].
      * destruct (IH s t Hc (s :: k) h a (some_of child k L ++ rest) Hp) as [Hf Hr].
        destruct (Wide.visit B S t (s :: k) h) as [st h1]. cbn [fst snd] in *. subst st.
        destruct (IHr h1 L a rest Hin' Nd) as [Hf' Hr'].
        { intros x Hx. destruct (HL x Hx) as [E|E]; [subst x; contradiction|exact E]. }
        split; [exact Hf'|]. eapply run_trans; [|eapply run_trans; [exact Hr|exact Hr']]. apply run_one, returns.
    + destruct (IHr h (filter others L) a rest Hin' (proj1 Ho) (proj2 Ho)) as [Hf Hr]. split; [exact Hf|]. replace (some_of child k L) with (some_of child k (filter others L)); [exact Hr|].
      clear - Hc. induction L as [|x L IHL]; [reflexivity|]. cbn [filter]. unfold others at 1. destruct (N.eqb_spec x s) as [-> |Ne]; cbn [negb].
      * rewrite IHL. unfold some_of at 2. cbn [flat_map]. now rewrite Hc.
      * unfold some_of in *. cbn [flat_map]. now rewrite IHL.
Qed.

Lemma slots_once : NoDup slots.
Proof. apply Injective_map_NoDup; [intros x y; apply Nnat.Nat2N.inj|apply seq_NoDup]. Qed.

Lemma wide_visit_runs t : visits_run t.
Proof.
  induction t as [|child IH] using Wide.wide_induction; intros k h a rest Hk.
  - cbn [Wide.visit fst snd wide_best wide_of]. rewrite Hk. split; [apply w_stop, by_boxes|apply run_leaf].
  - assert (E : wide_best (k :: h) = wide_best h) by (cbn; now rewrite Hk). cbn [Wide.visit wide_of].
    set (wanted := fun s => existsb (N.eqb s) (map (Wide.slot B) (Wide.ask S k (k :: h)))).
    destruct (each_runs child k (k :: h) Hk IH (Wide.ask S k (k :: h)) (k :: h) (filter wanted slots) a rest (fun r H => H)) as [Hf Hr].
    + apply NoDup_filter, slots_once.
    + intros s Hs. apply filter_In in Hs. destruct Hs as [_ Hs]. apply existsb_exists in Hs. destruct Hs as (x & Hx & Es). apply N.eqb_eq in Es. now subst x.
    + split; [exact Hf|]. rewrite E in Hr. eapply run_trans; [apply run_one, opens|]. eapply run_trans; [|exact Hr].
      apply (run_unwanted child k wanted). intros s Hc Hs. rewrite <- E. apply (w_unwanted by_boxes); [cbn; now rewrite Hk|]. intros r Hr' Es.
      assert (W : wanted s = true); [|congruence]. apply existsb_exists. exists s. split; [|apply N.eqb_refl]. subst s. now apply in_map.
Qed.

(** So is the reference of wide trees. [DET-1] *)
Theorem wide_reference_runs : run ([wide_of T []], None) ([], wide_best (snd (Wide.reference B S T))).
Proof. apply (wide_visit_runs T [] [] [] [] eq_refl). Qed.
End Wide.
End References.

(** So their best, with boxes tested as the code does, is the first hit: for every tree, every order of children, and whatever they
    know. [DET-1] *)
Theorem binary_answer ox oy oz dx dy dz tmin tmax mesh kernel compare boxes items T decide wants :
  let met := box_met ox oy oz dx dy dz tmin tmax in
  is_exact (origin ox oy oz) (direction dx dy dz) tmin tmax mesh kernel -> is_exact_order (origin ox oy oz) (direction dx dy dz) mesh kernel compare ->
  covers mesh (fits ox oy oz dx dy dz) (tree_of boxes items T xH) -> skips_by_boxes tmax kernel compare met boxes items T decide wants ->
  is_least (origin ox oy oz) (direction dx dy dz) tmin tmax mesh kernel (best_of kernel compare items T wants (snd (Tree.reference decide (fun _ => false) T))).
Proof. intros met K O C By. eapply directed_answer; [exact K|exact O|exact C|]. now apply binary_reference_runs. Qed.

(** The same for trees of 2, 4 or 8 children. [DET-1] *)
Theorem wide_answer ox oy oz dx dy dz tmin tmax mesh kernel compare B boxes items T S :
  let met := box_met ox oy oz dx dy dz tmin tmax in
  is_exact (origin ox oy oz) (direction dx dy dz) tmin tmax mesh kernel -> is_exact_order (origin ox oy oz) (direction dx dy dz) mesh kernel compare ->
  covers mesh (fits ox oy oz dx dy dz) (wide_of B boxes items T []) -> wide_by_boxes tmax kernel compare met B boxes items T S ->
  is_least (origin ox oy oz) (direction dx dy dz) tmin tmax mesh kernel (wide_best kernel compare items T (snd (Wide.reference B S T))).
Proof. intros met K O C By. eapply directed_answer; [exact K|exact O|exact C|]. now apply wide_reference_runs. Qed.
