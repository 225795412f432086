(** A machine that keeps something of each ancestor, whatever it is, has the reference's visits if what it keeps is right. *)

Require Import List NArith Lia Bool Sorted.
Require Import Wide WideMachine.
Import ListNotations.
Open Scope N_scope.

Section Machine.

Variable B : N.

(** What is kept of an ancestor, instead of the ranks that are pending there. *)
Record keeper := Keeper {
  level : Type;
  (** From the ranks that are pending after the first child, and the end. *)
  keep : list N -> N -> level;
  (** The end has changed. *)
  worn : level -> level;
  (** The slot of the child that comes next, and what is kept then; [None] if none is left that is not beyond. From what the
      node would be answered now, and the end. *)
  take : list N -> N -> level -> option (N * level) }.

Variable K : keeper.

(** To the deepest ancestor that has a child left. *)
Fixpoint back_levels (ans : path -> list N) (e : N) (k : path) (ls : list (level K)) : option (path * list (level K)) :=
  match k, ls with
  | _ :: a, l :: ls =>
      match take K (ans a) e l with
      | Some (s, l) => Some (s :: a, l :: ls)
      | None => back_levels ans e a ls
      end
  | _, _ => None
  end.

(** The present node, and what is kept of each of its ancestors, from its parent up. *)
Definition level_machine : machine := {|
  state := path * list (level K);
  start := ([], []);
  path_of := fst;
  age '(k, ls) := (k, map (worn K) ls);
  descend r rs e '(k, ls) := (slot B r :: k, keep K rs e :: ls);
  back ans e '(k, ls) := back_levels ans e k ls |}.

(** [holds a h l rs]: after the visits [h], [l] is right for the node [a] where the ranks [rs] are pending. Those that are beyond
    do not matter. *)
Record keeps (T : wide) (S : search) (holds : path -> history -> level K -> list N -> Prop) : Prop := Keeps {
  k_keep a h r rs child : at_path T a = Some (Inner child) -> ask S a (a :: h) = r :: rs ->
    beyond B (edge S (a :: h)) r = false -> holds a (a :: h) (keep K rs (edge S (a :: h))) rs;
  k_seen a h l rs k : holds a h l rs -> holds a (k :: h) (if edge S (k :: h) =? edge S h then l else worn K l) rs;
  k_take a h l rs : holds a h l rs ->
    match live B (edge S h) rs with
    | [] => take K (ask S a h) (edge S h) l = None
    | r :: rs' => exists l' rs'', take K (ask S a h) (edge S h) l = Some (slot B r, l') /\
        holds a h l' rs'' /\ live B (edge S h) rs'' = rs'
    end }.

Section Levels.

Variable T : wide.
Variable S : search.
Variable holds : path -> history -> level K -> list N -> Prop.

(** The levels stand for a stack, up to what is beyond. *)
Fixpoint stands (h : history) (k : path) (ls : list (level K)) (p : list (path * N)) : Prop :=
  match k, ls with
  | [], [] => live_stack B (edge S h) p = []
  | _ :: a, l :: ls => exists rs q, holds a h l rs /\ stands h a ls q /\
      live_stack B (edge S h) p = live_stack B (edge S h) (map (pair a) rs ++ q)
  | _, _ => False
  end.

Lemma stands_live h k ls p q : live_stack B (edge S h) p = live_stack B (edge S h) q -> stands h k ls p -> stands h k ls q.
Proof.
  intros E. destruct k as [|s a], ls as [|l ls]; simpl; try congruence. intros (rs & q' & H1 & H2 & H3).
  exists rs, q'. repeat split; try assumption. congruence.
Qed.

Hypothesis F : fair B T S.
Hypothesis Hold : keeps T S holds.

Lemma stands_seen k h : forall a ls p, stands h a ls p ->
  stands (k :: h) a (if edge S (k :: h) =? edge S h then ls else map (worn K) ls) p.
Proof.
  pose proof (f_edge _ _ _ F k h) as He. intros a. induction a as [|s a IH]; intros [|l ls] p; simpl; try contradiction.
  - intros H. assert (G : live_stack B (edge S (k :: h)) p = []).
    { change [] with (live_stack B (edge S (k :: h)) []). eapply live_stack_mono; eauto. }
    destruct (edge S (k :: h) =? edge S h); exact G.
  - intros (rs & q & H1 & H2 & H3). apply IH in H2. apply (k_seen _ _ _ Hold _ _ _ _ k) in H1.
    destruct (edge S (k :: h) =? edge S h); exists rs, q; (repeat split; [assumption..|]); eapply live_stack_mono; eauto.
Qed.

Lemma stands_back h : forall k ls p, stands h k ls p -> match live_stack B (edge S h) p with
  | [] => back_levels (now S h) (edge S h) k ls = None
  | (a, r) :: q => exists ls', back_levels (now S h) (edge S h) k ls = Some (slot B r :: a, ls') /\
      stands h (slot B r :: a) ls' q end.
Proof.
  intros k. induction k as [|s a IH]; intros [|l ls] p; simpl; try contradiction.
  - intros ->. reflexivity.
  - intros (rs & q & H1 & H2 & H3). rewrite H3, live_stack_app, live_stack_level. unfold now.
    pose proof (k_take _ _ _ Hold _ _ _ _ H1) as Ht. destruct (live B (edge S h) rs) as [|r rs'] eqn:Hl.
    + rewrite Ht. simpl. apply IH, H2.
    + destruct Ht as (l' & rs'' & -> & Hh & Hl2). simpl. exists (l' :: ls). split; [reflexivity|]. exists rs'', q.
      split; [exact Hh|]. split; [exact H2|]. rewrite !live_stack_app, !live_stack_level, Hl2. f_equal.
      * f_equal. rewrite <- Hl2. apply filter_filter. auto.
      * apply filter_filter. auto.
Qed.

Lemma levels_refine : refines B level_machine T S (fun s k p h => fst s = k /\ stands h k (snd s) p).
Proof.
  split; simpl.
  - auto.
  - intros s k p h [H _]. exact H.
  - intros [k' ls] k p h [Hk H]. simpl in *. subst k'. unfold seen. simpl. apply (stands_seen k) in H.
    destruct (edge S (k :: h) =? edge S h); auto.
  - intros [k' ls] k p h r rs child [Hk H] Ht Ha Hb. simpl in *. subst k'. split; [reflexivity|].
    exists rs, p. split; [eapply (k_keep _ _ _ Hold); eauto|]. auto.
  - intros s k a r p h [Hk H] Hb. split; [exact Hk|]. apply (stands_live h k (snd s) ((a, r) :: p)); [|exact H].
    simpl. now rewrite Hb.
  - intros [k' ls] k a r p h [Hk H] Hb. simpl in *. subst k'. pose proof (stands_back _ _ _ _ H) as P.
    simpl in P. rewrite Hb in P. simpl in P. destruct P as (ls' & Hs & Hst). exists (slot B r :: a, ls').
    split; [exact Hs|]. split; [reflexivity|].
    eapply (stands_live h (slot B r :: a)); [|exact Hst]. apply filter_filter. auto.
  - intros [k' ls] k h [Hk H]. simpl in *. subst k'. exact (stands_back _ _ _ _ H).
Qed.

(** [WIDE-7] A machine of levels has the reference's visits and answer, if what it keeps is right at each level. *)
Theorem levels_reference fuel : (length (snd (reference B S T)) <= fuel)%nat ->
  run B level_machine T S fuel (start level_machine) [] = Some (reference B S T).
Proof. exact (refines_reference _ _ _ _ _ F levels_refine fuel). Qed.

End Levels.

End Machine.
