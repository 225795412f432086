(** Which nodes are gone back to, and so which keys can be asked for: [WIDE-16]. *)

Require Import List NArith Arith Lia Bool Sorted.
Require Import Wide WideMachine WideLevels WideKeep WideMeaning WideBits.
Import ListNotations.
Open Scope N_scope.

Section Hash.

Variable B : N.

Definition is_inner (T : wide) (k : path) : Prop := exists child, at_path T k = Some (Inner child).

(** [WIDE-16] It has an inner child, and another child beside it. *)
Definition keyed (T : wide) (a : path) : Prop := exists s s', s <> s' /\ slots_below B (s :: a) /\ s' < A B /\
  is_inner T (s :: a) /\ at_path T (s' :: a) <> None.

(** The visit of [k] leads to none of its children. *)
Definition turns (T : wide) (S : search) (k : path) (h : history) : Prop :=
  match at_path T k with
  | Some WLeaf => stop S (k :: h) = false
  | Some (Inner _) => live B (edge S (k :: h)) (ask S k (k :: h)) = []
  | None => False
  end.

(** On the way back an ancestor is looked at if children are pending there and what is below gave nothing. *)
Inductive looks (ans : path -> list N) (e : N) : path -> list N -> path -> Prop :=
  | looks_here s a g ls : g <> 0 -> looks ans e (s :: a) (g :: ls) a
  | looks_above s a g ls b : take (trail_keeper B) (ans a) e g = None -> looks ans e a ls b -> looks ans e (s :: a) (g :: ls) b.

(** A search that goes back to [a], by a machine that asks again, always. From a leaf to its parent is not going back: its
    record is at hand. *)
Definition goes_back (T : wide) (S : search) (a : path) : Prop := exists k ls h,
  reached B (trail_machine B) T S (k, ls) h /\ turns T S k h /\ looks (now S (k :: h)) (edge S (k :: h)) k ls a /\
  (at_path T k = Some WLeaf -> forall s, k <> s :: a).

Lemma inner_above T k : forall b, at_path T (b ++ k) <> None -> b <> [] -> is_inner T k.
Proof.
  induction b as [|s b IH]; [congruence|]. intros H _. simpl in H. destruct b as [|s' b].
  - simpl in H. destruct (at_path T k) as [[|c]|] eqn:E; try congruence. now exists c.
  - apply IH; [|discriminate]. destruct (at_path T ((s' :: b) ++ k)) as [[|c]|]; congruence.
Qed.

Section Fair.

Variable T : wide.
Variable S : search.
Hypothesis F : fair B T S.

Lemma means_slots h : forall k ls, means B T S h k ls -> slots_below B k.
Proof.
  induction k as [|s a IH]; intros [|g ls]; simpl; try contradiction; [constructor|].
  intros [(child & h' & h0 & r & _ & _ & _ & <- & _) Hm]. constructor; [apply slot_below|eapply IH; eauto].
Qed.

Lemma looks_level h ans e : forall k ls a, looks ans e k ls a -> means B T S h k ls ->
  exists b s g, k = b ++ s :: a /\ g <> 0 /\ level_means B T S h a s g /\ slots_below B (s :: a).
Proof.
  induction 1 as [s a g ls Hg|s a g ls c _ _ IH]; intros Hm.
  - exists [], s, g. split; [reflexivity|]. split; [exact Hg|]. split; [apply Hm|exact (means_slots _ _ _ Hm)].
  - destruct Hm as [_ Hm]. destruct (IH Hm) as (b & s' & g' & -> & H). exists (s :: b), s', g'. split; [reflexivity|exact H].
Qed.

(** [WIDE-16](1) A node that is gone back to has an inner child and another child beside it. *)
Theorem gone_back_only a : goes_back T S a -> keyed T a.
Proof.
  intros (k & ls & h & Hr & Ht & Hl & Hleaf). pose proof (pending_meaning B T S F _ _ _ Hr) as Hm.
  destruct (looks_level h _ _ _ _ _ Hl Hm) as (b & s & g & -> & Hg & Hmean & Hb).
  destruct Hmean as (child & h' & h0 & r & Ha & _ & Hin & Hs & _ & _ & H3 & _ & H5).
  assert (Hi : exists i, N.testbit g i = true).
  { exists (N.log2 g). now apply N.bit_log2. }
  destruct Hi as (i & Hi). destruct (H5 i Hi) as (x & Hx & <-). exists s, (slot B x).
  split; [intros E; rewrite <- E, <- Hs in Hi; rewrite H3 in Hi; [discriminate|exact Hin|lia]|].
  split; [exact Hb|]. split; [apply slot_below|]. split.
  - destruct b as [|y b].
    + cbn [app] in *. unfold turns in Ht. destruct (at_path T (s :: a)) as [[|c]|] eqn:E.
      * destruct (Hleaf eq_refl s eq_refl).
      * now exists c.
      * destruct Ht.
    + apply (inner_above T (s :: a) (y :: b)); [|discriminate]. unfold turns in Ht.
      destruct (at_path T ((y :: b) ++ s :: a)); [discriminate|destruct Ht].
  - destruct (at_slot B S T a (a :: h0) x child F Ha Hx) as (t & _ & E). congruence.
Qed.

End Fair.

(** ** A search that goes back *)

Lemma path_eq (p q : path) : {p = q} + {p <> q}.
Proof. exact (list_eq_dec N.eq_dec p q). Qed.

(** The slot to take at [p] on the way to [a]. *)
Fixpoint way (a p : path) : option N :=
  match a with
  | [] => None
  | x :: a => if path_eq a p then Some x else way a p
  end.

(** It goes to [a], where it wants the child in slot [s] first, and then the one in slot [s']. *)
Definition visitor (a : path) (s s' : N) : search := {|
  ask p h := if path_eq p a then [s; A B + s'] else match way a p with Some x => [x] | None => [] end;
  stop h := false;
  edge h := A B |}.

Lemma way_suffix a p x : way a p = Some x -> exists b, a = b ++ x :: p.
Proof.
  induction a as [|y a IH]; simpl; [discriminate|]. destruct (path_eq a p) as [->|_]; [intros [= ->]; now exists []|].
  intros H. destruct (IH H) as (b & ->). now exists (y :: b).
Qed.

Lemma way_is b x p : way (b ++ x :: p) p = Some x.
Proof.
  induction b as [|y b IH]; simpl.
  - destruct (path_eq p p); congruence.
  - destruct (path_eq (b ++ x :: p) p) as [E|_]; [|exact IH]. apply (f_equal (@length N)) in E.
    rewrite app_length in E. simpl in E. lia.
Qed.

Lemma slot_small s : s < A B -> slot B s = s.
Proof. apply N.mod_small. Qed.

Lemma slot_above s : s < A B -> slot B (A B + s) = s.
Proof. intros H. unfold slot. fold (A B). pose proof (A_positive B). rewrite <- (N.mul_1_l (A B)) at 1.
  rewrite N.add_comm, N.mod_add by lia. now apply N.mod_small. Qed.

Lemma not_beyond_small s : s < A B -> beyond B (A B) s = false.
Proof. intros H. unfold beyond. fold (A B). rewrite N.div_small by exact H. apply N.ltb_ge. lia. Qed.

Lemma not_beyond_above s : s < A B -> beyond B (A B) (A B + s) = false.
Proof.
  intros H. unfold beyond. fold (A B). pose proof (A_positive B). rewrite <- (N.mul_1_l (A B)) at 3.
  rewrite N.div_add_l, N.div_small by lia. apply N.ltb_ge. lia.
Qed.

Section Visitor.

Variable T : wide.
Variable a : path.
Variables s s' : N.
Hypothesis different : s <> s'.
Hypothesis below : slots_below B (s :: a).
Hypothesis below' : s' < A B.
Hypothesis inner : is_inner T (s :: a).
Hypothesis beside : at_path T (s' :: a) <> None.

Let S := visitor a s s'.
Let M := trail_machine B.

Lemma suffix_below b x p : a = b ++ x :: p -> x < A B.
Proof.
  intros E. inversion_clear below as [|? ? _ H]. rewrite E in H. apply Forall_app in H. destruct H as [_ H].
  now inversion_clear H.
Qed.

Lemma there : at_path T a <> None.
Proof. destruct inner as (c & H). simpl in H. destruct (at_path T a); congruence. Qed.

Lemma visitor_fair : fair B T S.
Proof.
  assert (Hs : s < A B) by now inversion_clear below.
  split.
  - intros k h. simpl. destruct (path_eq k a); [|destruct (way a k); repeat constructor].
    repeat constructor. lia.
  - intros k h. simpl. destruct (path_eq k a); [|destruct (way a k); repeat constructor; intros []].
    simpl. rewrite slot_small, slot_above by assumption. repeat constructor; [|intros []]. intros [E|[]]. congruence.
  - intros k h r child Hk. simpl. destruct (path_eq k a) as [->|_].
    + intros [<-|[<-|[]]]; rewrite ?slot_small, ?slot_above by assumption.
      * destruct inner as (c & H). simpl in H. rewrite Hk in H. congruence.
      * simpl in beside. now rewrite Hk in beside.
    + destruct (way a k) as [x|] eqn:E; [|intros []]. intros [<-|[]]. destruct (way_suffix _ _ _ E) as (b & Eb).
      rewrite slot_small by (eapply suffix_below; eauto). intros En. apply there. rewrite Eb.
      assert (Hx : at_path T (x :: k) = None) by (simpl; now rewrite Hk). clear - Hx.
      induction b as [|y b IH]; [exact Hx|]. simpl. now rewrite IH.
  - intros k h. simpl. lia.
  - intros g k h. reflexivity.
Qed.

Lemma visitor_seen k h x : seen M S k h x = x.
Proof. unfold seen. simpl. now rewrite N.eqb_refl. Qed.

(** It goes down to [a], and nothing is pending. *)
Lemma visitor_down p : forall b, a = b ++ p -> exists h, reached B M T S (p, map (fun _ => 0) p) h.
Proof.
  induction p as [|x p IH]; intros b Eb; [exists []; constructor|].
  destruct (IH (b ++ [x])) as (h & Hr); [now rewrite <- app_assoc|]. exists (p :: h).
  apply (reached_step _ _ _ _ _ _ _ _ Hr). unfold step. cbv zeta. rewrite visitor_seen.
  change (path_of M (p, map (fun _ => 0) p)) with p.
  assert (Hp : is_inner T p).
  { apply (inner_above T p (b ++ [x])); [|destruct b; discriminate]. rewrite <- app_assoc. simpl. rewrite <- Eb. apply there. }
  destruct Hp as (child & ->). simpl. destruct (path_eq p a) as [E|_].
  { exfalso. rewrite E in Eb. apply (f_equal (@length N)) in Eb. rewrite app_length in Eb. simpl in Eb. lia. }
  rewrite Eb at 1. rewrite way_is. pose proof (suffix_below _ _ _ Eb) as Hx. rewrite not_beyond_small, slot_small by exact Hx.
  reflexivity.
Qed.

(** It comes to the child in slot [s], which wants nothing, and the other one is pending. *)
Lemma visitor_comes : exists h,
  reached B M T S (s :: a, slots_of B [A B + s'] :: map (fun _ => 0) a) (a :: h) /\ turns T S (s :: a) (a :: h).
Proof.
  assert (Hs : s < A B) by now inversion_clear below.
  destruct (visitor_down a [] eq_refl) as (h & Hr). exists h.
  assert (Ha : is_inner T a).
  { apply (inner_above T a [s]); [|discriminate]. destruct inner as (c & H). simpl in *. congruence. }
  destruct Ha as (child & Ha). split.
  - apply (reached_step _ _ _ _ _ _ _ _ Hr). unfold step. cbv zeta. rewrite visitor_seen.
    change (path_of M (a, map (fun _ => 0) a)) with a. rewrite Ha. simpl. destruct (path_eq a a) as [_|]; [|congruence].
    rewrite not_beyond_small, slot_small by exact Hs. reflexivity.
  - destruct inner as (c & Hc). unfold turns. rewrite Hc. simpl. destruct (path_eq (s :: a) a) as [E|_].
    { apply (f_equal (@length N)) in E. simpl in E. lia. }
    destruct (way a (s :: a)) as [x|] eqn:E; [|reflexivity]. destruct (way_suffix _ _ _ E) as (b & Eb).
    apply (f_equal (@length N)) in Eb. rewrite app_length in Eb. simpl in Eb. lia.
Qed.

(** From there it goes to that one. *)
Lemma visitor_takes h : exists g,
  take (trail_keeper B) (now S h a) (edge S h) (slots_of B [A B + s']) = Some (s', g).
Proof.
  assert (Hs : s < A B) by now inversion_clear below.
  unfold now. simpl ask. destruct (path_eq a a) as [_|]; [|congruence]. cbn [take trail_keeper].
  assert (E : filter (pend B (slots_of B [A B + s'])) [s; A B + s'] = [A B + s']).
  { apply filter_rest. simpl. rewrite slot_small, slot_above by assumption. repeat constructor; [|intros []].
    intros [E|[]]. congruence. }
  rewrite E. simpl edge. rewrite not_beyond_above, slot_above by exact below'. eauto.
Qed.

(** [WIDE-16] It goes back to [a]. *)
Theorem visitor_goes_back : goes_back T S a.
Proof.
  destruct visitor_comes as (h & Hr & Ht). exists (s :: a). eexists. exists (a :: h). split; [exact Hr|]. split; [exact Ht|].
  split.
  - constructor. intros E. destruct (visitor_takes (a :: h)) as (g & Hg). rewrite E, take_nothing in Hg. discriminate.
  - destruct inner as (c & ->). discriminate.
Qed.

End Visitor.

(** [WIDE-16](1, 2) A node is gone back to by some search if and only if it has an inner child and another child beside it. *)
Theorem gone_back_iff T a : (exists S, fair B T S /\ goes_back T S a) <-> keyed T a.
Proof.
  split.
  - intros (S & F & H). exact (gone_back_only T S F a H).
  - intros (s & s' & Hne & Hb & Hb' & Hi & Ho). exists (visitor a s s'). split.
    + now apply visitor_fair.
    + now apply visitor_goes_back.
Qed.

End Hash.
