(** What is beyond is not missed: [WIDE-8]. *)

Require Import List NArith Lia Bool Sorted.
Require Import Wide.
Import ListNotations.
Open Scope N_scope.

(** A hit: its distance, and the item's number. The least distance is the closest, then the least number. *)
Definition hit := (N * N)%type.

Definition at_most (x y : hit) : Prop := fst x < fst y \/ (fst x = fst y /\ snd x <= snd y).

Definition at_most_b (x y : hit) : bool := (fst x <? fst y) || ((fst x =? fst y) && (snd x <=? snd y)).

Definition closer (a b : option hit) : option hit :=
  match a, b with
  | None, _ => b
  | _, None => a
  | Some x, Some y => if at_most_b x y then a else b
  end.

Lemma at_most_spec x y : at_most_b x y = true <-> at_most x y.
Proof.
  unfold at_most_b, at_most. rewrite orb_true_iff, andb_true_iff, N.ltb_lt, N.eqb_eq, N.leb_le. reflexivity.
Qed.

Lemma at_most_total x y : at_most_b x y = false -> at_most y x.
Proof.
  unfold at_most_b, at_most. rewrite orb_false_iff, andb_false_iff, N.ltb_ge, N.eqb_neq, N.leb_gt. lia.
Qed.

Lemma at_most_trans x y z : at_most x y -> at_most y z -> at_most x z.
Proof. unfold at_most. lia. Qed.

Section Closest.

Variable B : N.
Variable T : wide.
(** What the leaf of a path has to offer. *)
Variable offer : path -> option hit.

Definition found (k : path) : option hit := match at_path T k with Some WLeaf => offer k | _ => None end.

(** The closest of the leaves that have been visited. *)
Definition best (h : history) : option hit := fold_right (fun k b => closer b (found k)) None h.

(** The closest hit so far is not worse than [y]. *)
Definition covered (h : history) (y : hit) : Prop := exists x, best h = Some x /\ at_most x y.

(** Nothing at the node [k] or below is better than the best so far. *)
Definition nothing_better (h : history) (k : path) : Prop := forall b y, found (b ++ k) = Some y -> covered h y.

(** It does not stop, and what it does not want, or would skip, has nothing better. *)
Record careful (S : search) : Prop := Careful {
  c_stop h : stop S h = false;
  c_unwanted k h s : (forall r, In r (ask S k (k :: h)) -> slot B r <> s) -> nothing_better (k :: h) (s :: k);
  c_beyond k h h' r : In r (ask S k h') -> beyond B (edge S h) r = true -> nothing_better h (slot B r :: k) }.

Lemma covered_more k h y : covered h y -> covered (k :: h) y.
Proof.
  intros (x & Hb & Hx). unfold covered. simpl. rewrite Hb. destruct (found k) as [z|]; simpl; [|eauto].
  destruct (at_most_b x z) eqn:E; [eauto|]. exists z. split; [reflexivity|]. eapply at_most_trans; [|exact Hx].
  now apply at_most_total.
Qed.

Lemma covered_app g h y : covered h y -> covered (g ++ h) y.
Proof. induction g as [|k g IH]; [auto|]. intros H. apply covered_more. auto. Qed.

Lemma covered_here k h y : found k = Some y -> covered (k :: h) y.
Proof.
  intros Hk. unfold covered. simpl. rewrite Hk. destruct (best h) as [x|]; simpl.
  - destruct (at_most_b x y) eqn:E; [exists x; split; [reflexivity|now apply at_most_spec]|].
    exists y. split; [reflexivity|right; lia].
  - exists y. split; [reflexivity|right; lia].
Qed.

(** The best was found at a leaf. *)
Lemma best_found h x : best h = Some x -> exists k, found k = Some x.
Proof.
  revert x. induction h as [|k h IH]; intros x; simpl; [discriminate|]. unfold closer.
  destruct (best h) as [y|], (found k) as [z|] eqn:E; try discriminate.
  - destruct (at_most_b y z); intros [= <-]; [apply IH; reflexivity|eauto].
  - intros [= <-]. apply IH. reflexivity.
  - intros [= <-]. eauto.
Qed.

(** [b] is the closest hit of the tree, or there is none. *)
Definition is_closest (b : option hit) : Prop :=
  (forall x, b = Some x -> exists k, found k = Some x) /\
  (forall k y, found k = Some y -> exists x, b = Some x /\ at_most x y).

(** There is only one. *)
Lemma closest_unique b b' : is_closest b -> is_closest b' -> b = b'.
Proof.
  intros [H1 H2] [H1' H2']. destruct b as [x|], b' as [x'|]; [| | |reflexivity].
  - destruct (H1 x eq_refl) as (k & Hk). destruct (H1' x' eq_refl) as (k' & Hk').
    destruct (H2 _ _ Hk') as (y & [= <-] & Hy). destruct (H2' _ _ Hk) as (y' & [= <-] & Hy').
    f_equal. destruct x, x'. unfold at_most in *. simpl in *. f_equal; lia.
  - destruct (H1 x eq_refl) as (k & Hk). destruct (H2' _ _ Hk) as (y & [=] & _).
  - destruct (H1' x' eq_refl) as (k & Hk). destruct (H2 _ _ Hk) as (y & [=] & _).
Qed.

Section Careful.

Variable S : search.
Hypothesis C : careful S.

(** After the visit of a subtree nothing below is better than the best. *)
Definition covers (t : wide) : Prop := forall k h, at_path T k = Some t ->
  fst (visit B S t k h) = false /\ (exists g, snd (visit B S t k h) = g ++ h) /\
  nothing_better (snd (visit B S t k h)) k.

Lemma each_covers child k h0 : at_path T k = Some (Inner child) -> (forall s t, child s = Some t -> covers t) ->
  forall rs h, (forall r, In r rs -> In r (ask S k h0)) ->
  let result := each (fun h r => beyond B (edge S h) r)
    (fun r h => match child (slot B r) with Some t => visit B S t (slot B r :: k) h | None => (false, h) end) rs h in
  fst result = false /\ (exists g, snd result = g ++ h) /\ forall r, In r rs -> nothing_better (snd result) (slot B r :: k).
Proof.
  intros Hk IH. induction rs as [|r rs IHr]; intros h Hin; cbn [each].
  { split; [reflexivity|]. split; [now exists []|]. intros r []. }
  assert (Hin' : forall x, In x rs -> In x (ask S k h0)) by (intros x Hx; apply Hin; now right).
  (* What is known of the first holds after the others. *)
  assert (Hmore : forall h1, (exists g, h1 = g ++ h) -> nothing_better h1 (slot B r :: k) ->
    let result := each (fun h r => beyond B (edge S h) r)
      (fun r h => match child (slot B r) with Some t => visit B S t (slot B r :: k) h | None => (false, h) end) rs h1 in
    fst result = false /\ (exists g, snd result = g ++ h) /\
    forall x, In x (r :: rs) -> nothing_better (snd result) (slot B x :: k)).
  { intros h1 (g & ->) Hr. destruct (IHr (g ++ h) Hin') as (E1 & (g' & E2) & E3). split; [exact E1|].
    split; [exists (g' ++ g); now rewrite E2, app_assoc|]. intros x [<-|Hx]; [|now apply E3].
    rewrite E2. intros b y Hy. apply covered_app. eapply Hr; eauto. }
  destruct (beyond B (edge S h) r) eqn:Hb.
  - apply Hmore; [now exists []|]. eapply c_beyond; eauto. apply Hin. now left.
  - destruct (child (slot B r)) as [t|] eqn:Ht.
    + assert (Hp : at_path T (slot B r :: k) = Some t) by (simpl; now rewrite Hk).
      destruct (IH _ _ Ht _ h Hp) as (E1 & E2 & E3). destruct (visit B S t (slot B r :: k) h) as [st h1]. simpl in *. subst st.
      now apply Hmore.
    + apply Hmore; [now exists []|]. intros b y Hy. exfalso.
      unfold found in Hy. rewrite none_below in Hy; [discriminate|]. simpl. now rewrite Hk.
Qed.

Lemma visit_covers t : covers t.
Proof.
  induction t as [|child IH] using wide_induction; intros k h Hk.
  - simpl. split; [apply c_stop; exact C|]. split; [now exists [k]|]. intros b y Hy.
    destruct b as [|s b _] using rev_ind; [now apply covered_here|]. rewrite <- app_assoc in Hy. simpl in Hy.
    unfold found in Hy. rewrite none_below_leaf in Hy by exact Hk. discriminate.
  - cbn [visit]. destruct (each_covers child k (k :: h) Hk IH (ask S k (k :: h)) (k :: h) (fun r H => H)) as (E1 & (g & E2) & E3).
    split; [exact E1|]. split; [exists (g ++ [k]); rewrite E2, <- app_assoc; reflexivity|]. intros b y Hy.
    destruct b as [|s b _] using rev_ind; [unfold found in Hy; simpl in Hy; now rewrite Hk in Hy|].
    rewrite <- app_assoc in Hy. simpl in Hy.
    destruct (in_dec N.eq_dec s (map (slot B) (ask S k (k :: h)))) as [Hs|Hs].
    + apply in_map_iff in Hs. destruct Hs as (r & <- & Hr). apply (E3 r Hr b y Hy).
    + rewrite E2. apply covered_app. apply (c_unwanted S C k h s) with (b := b); [|exact Hy].
      intros r Hr <-. apply Hs. now apply in_map.
Qed.

(** [WIDE-8] A careful search ends with the closest hit of the tree. *)
Theorem careful_finds_closest : is_closest (best (snd (reference B S T))).
Proof.
  destruct (visit_covers T [] [] eq_refl) as (_ & _ & H). unfold reference. split.
  - intros x. apply best_found.
  - intros k y Hy. apply (H k y). now rewrite app_nil_r.
Qed.

End Careful.

(** [WIDE-8] So any two end with the same hit: one that skips, and one that visits everything. *)
Theorem skipping_loses_nothing S S' : careful S -> careful S' ->
  best (snd (reference B S T)) = best (snd (reference B S' T)).
Proof. intros C C'. apply closest_unique; now apply careful_finds_closest. Qed.

(** [WIDE-3, WIDE-8] A search is careful if its end is the distance of the best hit, and if no child has a hit closer than its
    rank: the rank may be less than the distance at which the child begins, as it is when bits are cleared. *)
Theorem distances_are_careful S (top : N) :
  (forall h, stop S h = false) ->
  (forall k y, found k = Some y -> fst y <= top) ->
  (forall h, edge S h = match best h with Some x => fst x | None => top end) ->
  (forall k h r b y, In r (ask S k h) -> found (b ++ slot B r :: k) = Some y -> 2 ^ B * (r / 2 ^ B) <= fst y) ->
  (forall k h s, (forall r, In r (ask S k (k :: h)) -> slot B r <> s) -> nothing_better (k :: h) (s :: k)) ->
  careful S.
Proof.
  intros Hstop Htop Hedge Hrank Hun. split; [exact Hstop|exact Hun|]. intros k h h' r Hr Hb b y Hy.
  unfold beyond in Hb. apply N.ltb_lt in Hb. rewrite Hedge in Hb. pose proof (Hrank _ _ _ _ _ Hr Hy).
  unfold covered. destruct (best h) as [x|]; [exists x; split; [reflexivity|left; lia]|].
  pose proof (Htop _ _ Hy). lia.
Qed.

(** [WIDE-3] A search that wants all there is and has the greatest end is careful: it visits everything. *)
Theorem everything_is_careful S (top : N) :
  (forall h, stop S h = false) -> (forall h, edge S h = top) -> (forall k h r, In r (ask S k h) -> r <= top) ->
  (forall k h s, at_path T (s :: k) <> None -> In s (map (slot B) (ask S k (k :: h)))) -> careful S.
Proof.
  intros Hstop Hedge Hrank Hall. split; [exact Hstop| |].
  - intros k h s Hs b y Hy. exfalso. assert (Hn : at_path T (s :: k) = None).
    { destruct (at_path T (s :: k)) eqn:E; [|reflexivity]. exfalso. assert (X : at_path T (s :: k) <> None) by congruence.
      apply (Hall k h s) in X. apply in_map_iff in X. destruct X as (r & Hrs & Hr). now apply (Hs r). }
    unfold found in Hy. rewrite none_below in Hy by exact Hn. discriminate.
  - intros k h h' r Hr Hb. exfalso. unfold beyond in Hb. apply N.ltb_lt in Hb. rewrite Hedge in Hb.
    pose proof (Hrank _ _ _ Hr). pose proof (N.mul_div_le r (2 ^ B) (N.pow_nonzero 2 B ltac:(discriminate))). lia.
Qed.

End Closest.
