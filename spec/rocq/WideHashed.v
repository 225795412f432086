(** The machine of WIDE-17 keeps the same sets, so what it goes back to is in the set of WIDE-16: for WHASHED-1. *)

Require Import List NArith Arith Lia Bool Sorted.
Require Import Wide WideMachine WideLevels WideKeep WideMeaning WideBits WideHash.
Import ListNotations.
Open Scope N_scope.

Section Hashed.

Variable B : N.

Definition key_machine := level_machine B (key_keeper B).

(** The pending set of a level. *)
Definition pending_set (l : level (key_keeper B)) : N := fst (fst l).

(** The sets without the ranks. *)
Definition sets (s : path * list (level (key_keeper B))) : path * list N := (fst s, map pending_set (snd s)).

(** An ancestor is looked at if it is asked again, or if one of its children comes next; and if what is below gave nothing. *)
Inductive key_looks (ans : path -> list N) (e : N) : path -> list (level (key_keeper B)) -> path -> Prop :=
  | key_looks_here s a g r1 r2 ls : g <> 0 -> r1 = 0 \/ take (key_keeper B) (ans a) e (g, r1, r2) <> None ->
      key_looks ans e (s :: a) ((g, r1, r2) :: ls) a
  | key_looks_above s a l ls b : take (key_keeper B) (ans a) e l = None -> key_looks ans e a ls b ->
      key_looks ans e (s :: a) (l :: ls) b.

(** A search that goes back to [a], by this machine. *)
Definition key_goes_back (T : wide) (S : search) (a : path) : Prop := exists k ls h,
  reached B key_machine T S (k, ls) h /\ turns B T S k h /\ key_looks (now S (k :: h)) (edge S (k :: h)) k ls a /\
  (at_path T k = Some WLeaf -> forall s, k <> s :: a).

Section Same.

Variable T : wide.
Variable S : search.
Hypothesis F : fair B T S.

Let M := trail_machine B.

(** [WIDE-19] The child that comes next by its rank is the one that comes next by the set alone. *)
Lemma take_same a h g r1 r2 rs : key_holds B S a h (g, r1, r2) rs ->
  take (trail_keeper B) (ask S a h) (edge S h) g =
  option_map (fun x => (fst x, pending_set (snd x))) (take (key_keeper B) (ask S a h) (edge S h) (g, r1, r2)).
Proof.
  intros H. pose proof (k_take _ _ _ _ _ (key_keeps B T S F) a h (g, r1, r2) rs H) as Hk.
  assert (Ht : trail_holds B S a h g rs) by (destruct H as (l & rs' & Hl & Hr & _); now exists l).
  pose proof (k_take _ _ _ _ _ (trail_keeps B T S F) a h g rs Ht) as Ht'.
  destruct (live B (edge S h) rs) as [|r rs']; [now rewrite Hk, Ht'|].
  destruct Hk as ([[g1 q1] q2] & _ & Hk & _). destruct Ht' as (g2 & _ & Ht' & _). rewrite Hk, Ht'. cbn [option_map fst snd].
  unfold pending_set. cbn [fst]. f_equal. f_equal.
  assert (E1 : g2 = N.clearbit g (slot B r)).
  { cbn [take trail_keeper] in Ht'. destruct (filter _ _) as [|x xs]; [discriminate|].
    destruct (beyond B (edge S h) x); [discriminate|]. injection Ht' as E <-. now rewrite E. }
  assert (E2 : g1 = N.clearbit g (slot B r)).
  { cbn [take key_keeper] in Hk. destruct (g =? 0); [discriminate|]. destruct (r1 =? 0).
    - destruct (filter _ _) as [|x xs]; [discriminate|]. destruct (beyond B (edge S h) x); [discriminate|].
      injection Hk as E <- _ _. now rewrite E.
    - destruct (beyond B (edge S h) r1); [discriminate|]. injection Hk as E <- _ _. now rewrite E. }
  congruence.
Qed.

Let right := stands B (key_keeper B) S (key_holds B S).

Lemma back_same h : forall k ls p, right h k ls p ->
  back_levels (trail_keeper B) (now S h) (edge S h) k (map pending_set ls) =
  option_map sets (back_levels (key_keeper B) (now S h) (edge S h) k ls).
Proof.
  induction k as [|s a IH]; intros [|[[g r1] r2] ls] p; cbn [right stands]; try contradiction; [reflexivity|].
  intros (rs & q & Hh & Hst & _). cbn [map back_levels]. unfold now at 1 3. unfold pending_set at 1. cbn [fst].
  rewrite (take_same _ _ _ _ _ _ Hh).
  destruct (take (key_keeper B) (ask S a h) (edge S h) (g, r1, r2)) as [[s' l']|]; [reflexivity|].
  cbn [option_map]. eapply IH; eauto.
Qed.

Lemma seen_same k h (s : path * list (level (key_keeper B))) : seen key_machine S k h s = s.
Proof.
  unfold seen. destruct s as [k' ls]. simpl. destruct (edge S (k :: h) =? edge S h); [reflexivity|]. f_equal. apply map_id.
Qed.

Lemma seen_trail k h (s : path * list N) : seen M S k h s = s.
Proof.
  unfold seen. destruct s as [k' ls]. simpl. destruct (edge S (k :: h) =? edge S h); [reflexivity|]. f_equal. apply map_id.
Qed.

(** One step of the one is one step of the other. *)
Lemma step_same k ls p h : right (k :: h) k ls p ->
  step B M T S (sets (k, ls)) h = match step B key_machine T S (k, ls) h with
    | Going _ s h => Going M (sets s) h
    | Done _ b h => Done M b h
    | Lost _ => Lost M
    end.
Proof.
  intros H. unfold step. cbv zeta. rewrite seen_same, seen_trail.
  change (path_of M (sets (k, ls))) with k. change (path_of key_machine (k, ls)) with k.
  assert (Hb : go_back M S (sets (k, ls)) (k :: h) = match go_back key_machine S (k, ls) (k :: h) with
    | Going _ s h => Going M (sets s) h | Done _ b h => Done M b h | Lost _ => Lost M end).
  { unfold go_back. cbn [back M trail_machine key_machine level_machine sets fst snd]. rewrite (back_same _ _ _ _ H).
    now destruct (back_levels (key_keeper B) (now S (k :: h)) (edge S (k :: h)) k ls). }
  destruct (at_path T k) as [[|child]|]; [|destruct (ask S k (k :: h)) as [|r rs]|reflexivity].
  - destruct (stop S (k :: h)); [reflexivity|exact Hb].
  - exact Hb.
  - destruct (beyond B (edge S (k :: h)) r); [exact Hb|reflexivity].
Qed.

Lemma reached_right k ls h : reached B key_machine T S (k, ls) h -> exists p, right (k :: h) k ls p.
Proof.
  intros H. pose proof (levels_refine B (key_keeper B) T S (key_holds B S) F (key_keeps B T S F)) as L.
  destruct (reached_refines _ _ _ _ _ L _ _ H) as (k' & p & HR). pose proof (r_seen _ _ _ _ _ L _ _ _ _ HR) as HR'.
  destruct HR as [E _]. simpl in E. subst k'. rewrite seen_same in HR'. exists p. apply HR'.
Qed.

(** [WIDE-17] The pending sets are those of the trail. *)
Theorem reached_sets s h : reached B key_machine T S s h -> reached B M T S (sets s) h.
Proof.
  induction 1 as [|[k ls] h s' h' Hr IH Hs]; [apply reached_start|]. destruct (reached_right _ _ _ Hr) as (p & Hp).
  apply (reached_step _ _ _ _ _ _ _ _ IH). rewrite (step_same _ _ _ _ Hp). now rewrite Hs.
Qed.

(** And all that the trail comes to. *)
Lemma sets_reached s h : reached B M T S s h -> exists ls, reached B key_machine T S (fst s, ls) h /\ s = sets (fst s, ls).
Proof.
  induction 1 as [|s h s' h' Hr (ls & Hk & E) Hs]; [exists []; split; [apply reached_start|reflexivity]|].
  destruct (reached_right _ _ _ Hk) as (p & Hp). pose proof (step_same _ _ _ _ Hp) as Hst. rewrite <- E, Hs in Hst.
  destruct (step B key_machine T S (fst s, ls) h) as [[k1 ls1] h1| |] eqn:Hk1; try discriminate.
  injection Hst as -> ->. exists ls1. split; [|reflexivity]. exact (reached_step _ _ _ _ _ _ _ _ Hk Hk1).
Qed.

(** [WIDE-17, WIDE-10] So at each visit they hold the wanted children that are not visited yet, all but some that are beyond. *)
Theorem key_pending_meaning k ls h : reached B key_machine T S (k, ls) h -> means B T S h k (map pending_set ls).
Proof. intros H. exact (pending_meaning B T S F _ _ _ (reached_sets _ _ H)). Qed.

Lemma looks_same h : forall k ls p a, right h k ls p -> key_looks (now S h) (edge S h) k ls a ->
  looks B (now S h) (edge S h) k (map pending_set ls) a.
Proof.
  intros k ls p a Hr Hl. revert p Hr. induction Hl as [s a g r1 r2 ls Hg _|s a [[g r1] r2] ls b Ht _ IH]; intros p Hr.
  - now apply looks_here.
  - destruct Hr as (rs & q & Hh & Hst & _). cbn [map]. apply looks_above; [|eapply IH; exact Hst].
    unfold now in *. unfold pending_set. cbn [fst]. now rewrite (take_same _ _ _ _ _ _ Hh), Ht.
Qed.

(** [WHASHED-1] [WIDE-16](3) Whatever the machine asks the table for is in the set. *)
Theorem hashed_keys_suffice a : key_goes_back T S a -> keyed B T a.
Proof.
  intros (k & ls & h & Hr & Ht & Hl & Hleaf). destruct (reached_right _ _ _ Hr) as (p & Hp).
  apply (gone_back_only B T S F). exists k, (map pending_set ls), h. split; [exact (reached_sets _ _ Hr)|].
  split; [exact Ht|]. split; [eapply looks_same; eauto|exact Hleaf].
Qed.

End Same.

(** [WHASHED-1] [WIDE-16](3) A node is gone back to by this machine, in some search, if and only if its key is in the set. *)
Theorem hashed_keys_exact T a : (exists S, fair B T S /\ key_goes_back T S a) <-> keyed B T a.
Proof.
  split; [intros (S & F & H); exact (hashed_keys_suffice T S F a H)|].
  intros (s & s' & Hne & Hb & Hb' & Hi & Ho). exists (visitor B a s s').
  pose proof (visitor_fair B T a s s' Hne Hb Hb' Hi Ho) as F. split; [exact F|].
  destruct (visitor_comes B T a s s' Hne Hb Hb' Hi) as (h & Hr & Ht).
  destruct (sets_reached T _ F _ _ Hr) as (ls & Hk & E). cbn [fst] in Hk, E.
  destruct (reached_right T _ F _ _ _ Hk) as (p & Hp).
  destruct ls as [|[[g r1] r2] ls]; [discriminate|]. injection E as Eg _. cbn [fst] in Eg.
  exists (s :: a), ((g, r1, r2) :: ls), (a :: h). split; [exact Hk|]. split; [exact Ht|]. split.
  - destruct Hp as (rs & q & Hh & _). pose proof (take_same T _ F _ _ _ _ _ _ Hh) as Hsame.
    destruct (visitor_takes B a s s' Hne Hb Hb' ((s :: a) :: a :: h)) as (g' & Hg').
    assert (Eg' : g = slots_of B [A B + s']) by (symmetry; exact Eg).
    rewrite <- Eg' in Hg'. pose proof (eq_trans (eq_sym Hg') Hsame) as Hboth. apply key_looks_here.
    + intros ->. rewrite take_nothing in Hg'. discriminate.
    + right. intros En. unfold now in En. destruct (take (key_keeper B) _ _ (g, r1, r2)); discriminate.
  - destruct Hi as (c & ->). discriminate.
Qed.

End Hashed.
