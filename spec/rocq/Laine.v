(** The restart trail with a short stack, Laine 2010: where a node that is asked again answers as before. *)

Require Import Arith List PArith NArith Lia Bool.
Require Import Tree Machine Bits Implicit Words Register LaineMachine.
Import ListNotations.

(** * Where decisions stay what they are *)

Section Unchanging.

Variables W K : nat.
Variable T : tree.
Hypothesis carries : height T < W.
Variable decide : history -> descent.
Variable again : positive -> history -> descent.
Variable stop : history -> bool.
Hypothesis unchanging : forall k h d, answer decide k h = Some d -> again k h = d.

Let lrun := laine_run W K T decide again stop false.
Notation place := (place W).

Lemma deep k u : at_key T k = Some u -> depth k < W.
Proof. intros H. pose proof (at_key_height T k u H). lia. Qed.

(** The trail of Laine is J's counter, aligned at the top. *)
Definition aligned (trail : N) (k : positive) (t : N) : Prop := shr trail (place k) = counter (depth k) t.

Lemma aligned_up trail sd k t : S (depth k) < W -> aligned trail (child sd k) t -> aligned trail k (N.div2 t).
Proof.
  unfold aligned. intros Hd H. rewrite (place_child W sd k Hd).
  replace (S (place (child sd k))) with (place (child sd k) + 1) by lia.
  unfold shr in *. rewrite Nat2N.inj_add, <- N.shiftr_shiftr, H, depth_child. change (N.of_nat 1) with 1%N.
  rewrite <- N.div2_spec. rewrite (N.div2_odd t) at 1. destruct (N.odd t); cbn [N.b2n].
  - rewrite <- N.succ_double_spec, counter_succ_double. apply div2_double.
  - rewrite N.add_0_r, <- N.double_spec, counter_double. apply div2_double.
Qed.

Lemma aligned_bit trail sd k t : aligned trail (child sd k) t -> is_set trail (pow (place (child sd k))) = negb (N.odd t).
Proof.
  unfold aligned. intros H. rewrite is_set_odd, H, depth_child, (N.div2_odd t) at 1. destruct (N.odd t); cbn [N.b2n negb].
  - rewrite <- N.succ_double_spec, counter_succ_double. apply odd_double.
  - rewrite N.add_0_r, <- N.double_spec, counter_double. apply odd_double.
Qed.

(** One visit on the way down again. *)
Lemma step_again trail e short sd k t h f l r : at_key T k = Some (Node l r) -> S (depth k) < W -> e <= place (child sd k) ->
  aligned trail (child sd k) t -> leads decide sd k (N.odd t) h ->
  (e = place (child sd k) -> answer decide k h <> Some (Only sd)) ->
  lrun (S f) (Laine k trail (pow (place k)) (pow e) short) h =
  lrun f (Laine (child sd k) trail (pow (place (child sd k))) (pow e)
    (if N.odd t then firstn K (child (other sd) k :: short) else short)) h.
Proof.
  intros Hk Hd He Ha (d & Hans & Hp) Hn. pose proof (place_child W sd k Hd) as Hpl. pose proof (aligned_bit _ _ _ _ Ha) as Hbit.
  unfold lrun at 1. cbn [laine_run l_node]. rewrite Hk, on_way_down by lia. cbn [negb andb].
  rewrite (unchanging _ _ _ Hans), Hpl. cbn [laine_descend]. rewrite half, Hbit.
  destruct (N.odd t); [subst d; reflexivity|]. destruct Hp as [-> | ->]; [|now destruct sd].
  destruct (N.eqb_spec (pow (place (child sd k))) (pow e)) as [E|_].
  - exfalso. apply (Hn); [|exact Hans]. apply (f_equal ctz) in E. rewrite !ctz_pow' in E. auto.
  - cbn [negb] in Hbit. rewrite lor_set; [reflexivity|]. now rewrite <- is_set_bit.
Qed.

(** From the root down along the trail, as far as to the node that is to be popped. *)
Lemma down_again trail e h k : forall t u, at_key T k = Some u -> e <= place k -> aligned trail k t -> way decide k t h ->
  (e = place k -> forall sd a, k = child sd a -> answer decide a h <> Some (Only sd)) ->
  exists short, prefix short (pending k t) /\ forall f,
    lrun (depth k + f) (Laine xH trail (top W) (pow e) []) h = lrun f (Laine k trail (pow (place k)) (pow e) short) h.
Proof.
  assert (Step : forall sd k, (forall t u, at_key T k = Some u -> e <= place k -> aligned trail k t -> way decide k t h ->
      (e = place k -> forall sd a, k = child sd a -> answer decide a h <> Some (Only sd)) ->
      exists short, prefix short (pending k t) /\ forall f,
        lrun (depth k + f) (Laine xH trail (top W) (pow e) []) h = lrun f (Laine k trail (pow (place k)) (pow e) short) h) ->
    forall t u, at_key T (child sd k) = Some u -> e <= place (child sd k) -> aligned trail (child sd k) t ->
    leads decide sd k (N.odd t) h -> way decide k (N.div2 t) h ->
    (e = place (child sd k) -> answer decide k h <> Some (Only sd)) ->
    exists short, prefix short ((if N.odd t then [child (other sd) k] else []) ++ pending k (N.div2 t)) /\ forall f,
      lrun (S (depth k) + f) (Laine xH trail (top W) (pow e) []) h =
      lrun f (Laine (child sd k) trail (pow (place (child sd k))) (pow e) short) h).
  { clear k. intros sd k IH t u Hu He Ha Hp Hw Hn. pose proof (deep _ _ Hu) as Hdeep. rewrite depth_child in Hdeep.
    pose proof (place_child W sd k Hdeep) as Hpl.
    assert (Hk : exists l r, at_key T k = Some (Node l r)).
    { destruct sd; cbn in Hu; destruct (at_key T k) as [[|l r]|]; try discriminate; eauto. }
    destruct Hk as (l & r & Hk).
    destruct (IH (N.div2 t) _ Hk) as (short & Hs & Hrun); [lia|eapply aligned_up; eassumption|exact Hw|lia|].
    exists (if N.odd t then firstn K (child (other sd) k :: short) else short). split.
    - destruct (N.odd t); [now apply prefix_push|exact Hs].
    - intros f. replace (S (depth k) + f) with (depth k + S f) by lia. rewrite Hrun. eapply step_again; eassumption. }
  induction k as [k IH|k IH|]; intros t u Hu He Ha Hw Hn.
  - destruct Hw. apply (Step R k IH t u); auto.
  - destruct Hw. apply (Step L k IH t u); auto.
  - exists []. split; [now exists []|]. intros f. unfold place, top. cbn [depth]. now rewrite Nat.sub_0_r.
Qed.

(** * The theorem *)

(** Before a visit that is not one on the way down again. *)
Definition stands (s : laine_state) (k : positive) (t : N) : Prop :=
  exists pop short, s = Laine k (counter (depth k) t * pow (place k)) (pow (place k)) pop short /\
    prefix short (pending k t) /\ (pop = 0%N \/ exists e, pop = pow e /\ place k <= e).

Lemma stands_visits s k t : stands s k t -> restarting s = false.
Proof.
  intros (pop & short & -> & _ & H). unfold restarting. cbn [l_pop l_level]. destruct H as [->|(e & -> & H)]; [reflexivity|].
  rewrite !ctz_pow'. destruct (Nat.ltb_spec e (place k)); [lia|apply andb_false_r].
Qed.

Lemma stands_descend s k t d : S (depth k) < W -> d <> Neither -> stands s k t ->
  exists s', laine_descend K d s = Some s' /\
    let '(k', t') := trail_descend d (k, t) in stands s' k' t'.
Proof.
  intros Hd H0 (pop & short & -> & Hs & H). unfold stands. destruct d as [|sd|sd]; [easy|..].
  all: pose proof (place_child W sd k Hd) as Hpl; cbn [laine_descend trail_descend]; rewrite Hpl, half.
  - destruct (N.eqb_spec (pow (place (child sd k))) pop) as [E|_].
    + exfalso. destruct H as [->|(e & -> & H)]; [pose proof (pow_pos (place (child sd k))); lia|].
      apply (f_equal ctz) in E. rewrite !ctz_pow' in E. lia.
    + eexists. split; [reflexivity|]. exists pop, short. rewrite lor_next, depth_child, counter_double. split; [reflexivity|].
      split; [destruct sd; cbn; rewrite (proj1 (div2_double t)); now destruct t|].
      destruct H as [|(e & -> & H)]; [auto|]. right. exists e. split; [reflexivity|lia].
  - rewrite is_set_odd. replace (shr (counter (depth k) t * pow (S (place (child sd k)))) (place (child sd k)))
      with (N.double (counter (depth k) t)).
    2: { rewrite pow_succ, <- (shr_times (N.double (counter (depth k) t)) (place (child sd k))). f_equal.
         rewrite !N.double_spec. lia. }
    rewrite (proj1 (odd_double _)).
    eexists. split; [reflexivity|]. exists pop, (firstn K (child (other sd) k :: short)).
    rewrite depth_child, counter_succ_double, pow_succ. split; [f_equal; rewrite !N.double_spec; lia|]. split.
    + replace (pending (child sd k) (N.succ_double t)) with (child (other sd) k :: pending k t); [now apply prefix_push|].
      destruct sd; cbn; rewrite (proj2 (div2_double t)); now destruct t.
    + destruct H as [|(e & -> & H)]; [auto|]. right. exists e. split; [reflexivity|lia].
Qed.

Lemma counter_below d t : (t < pow d)%N -> (counter d t < pow d)%N.
Proof.
  intros H. apply lxor_below; [exact H|]. rewrite N.ones_equiv. pose proof (pow_pos d). unfold pow in *. lia.
Qed.

Lemma stands_backtrack s k t u h : at_key T k = Some u -> fits k t -> way decide k t h -> stands s k t ->
  match trail_backtrack (k, t) with
  | None => laine_backtrack W s = None
  | Some (q, t') => exists s' n s2, laine_backtrack W s = Some s' /\ n < W /\ stands s2 q t' /\
      forall f, lrun (n + f) s' h = lrun f s2 h
  end.
Proof.
  intros Hu Hf Hw (pop & short & -> & Hs & _). pose proof (deep _ _ Hu) as Hd.
  assert (Ht : (t < pow (depth k))%N) by now apply fits_range.
  pose proof (counter_below _ _ Ht) as Hc. pose proof (pow_pos (place k)) as Hp.
  assert (HW : pow (W - 1) = (pow (depth k) * pow (place k))%N) by (rewrite <- pow_add; f_equal; unfold place; lia).
  assert (HW1 : (pow (W - 1) < pow W)%N) by (apply pow_lt; lia).
  cbn [laine_backtrack]. rewrite clear_below by (try (unfold place; lia); nia). rewrite shr_times.
  replace (counter (depth k) t * pow (place k) + pow (place k))%N with ((counter (depth k) t + 1) * pow (place k))%N by lia.
  rewrite !wrap_small by nia.
  destruct (trail_backtrack (k, t)) as [[q t']|] eqn:Hb.
  - destruct (carry_moves k t q t' Hf Hb) as (Hz & Hf' & _ & _ & Hsh & _). unfold level_index in *.
    destruct (way_back T decide k t q t' h u Hu Hf Hw Hb) as (Hw' & (u' & Hu') & (sd & a & Hq & Ha)).
    assert (Hn : ctz t < depth k) by (apply ctz_fits; [exact Hf|now intros ->]).
    assert (Hq1 : depth q = depth k - ctz t).
    { apply backtrack_some in Hb. destruct Hb as (_ & -> & _). now rewrite depth_sibling, depth_up. }
    set (c := counter (depth q) t') in *.
    assert (Hc1 : (counter (depth k) t + 1 = c * pow (ctz t))%N).
    { rewrite (shr_ctz (counter (depth k) t + 1)), Hsh, Hz by lia. reflexivity. }
    assert (Htrail : ((counter (depth k) t + 1) * pow (place k) = c * pow (place q))%N).
    { rewrite Hc1, <- N.mul_assoc, <- pow_add. do 2 f_equal. unfold place. lia. }
    rewrite !Htrail.
    assert (Hct : (c < pow (depth q))%N) by (apply counter_below, fits_range, Hf').
    assert (HWq : pow (W - 1) = (pow (depth q) * pow (place q))%N) by (rewrite <- pow_add; f_equal; unfold place; lia).
    pose proof (pow_pos (place q)) as Hpq.
    assert (Hal : aligned (c * pow (place q)) q t') by apply shr_times.
    assert (Hodd : N.odd c = true).
    { pose proof Hal as H. rewrite Hq in H. apply aligned_bit in H. rewrite <- Hq, is_set_odd, shr_times in H. rewrite H.
      now rewrite (backtrack_even _ _ _ _ Hb). }
    assert (Hc0 : c <> 0%N) by now intros E; rewrite E in Hodd.
    rewrite lowest_bit by nia. rewrite ctz_times by exact Hc0. rewrite (odd_ctz c Hodd). cbn [Nat.add].
    assert (Etop : is_set (c * pow (place q)) (top W) = false).
    { unfold top. rewrite is_set_bit. apply high_bit_clear. fold (pow (W - 1)). nia. }
    rewrite Etop.
    pose proof (trail_pops k t Hf) as Hpop. rewrite Hb in Hpop. destruct (pending k t) as [|q0 p]; [discriminate|].
    destruct Hpop as (t0 & [= <- <-] & _ & Hp').
    destruct short as [|q0 short].
    + destruct (down_again (c * pow (place q)) (place q) h q t' u' Hu' (le_n _) Hal Hw') as (short & Hs' & Hrun).
      { intros _ sd' a' Hq' H. assert (a' = a /\ sd' = sd) as [-> ->].
        { rewrite Hq in Hq'. destruct sd, sd'; cbn in Hq'; try discriminate; injection Hq' as ->; auto. }
        rewrite Ha in H. discriminate. }
      exists (Laine xH (c * pow (place q)) (top W) (pow (place q)) []), (depth q),
        (Laine q (c * pow (place q)) (pow (place q)) (pow (place q)) short).
      split; [reflexivity|]. split; [lia|]. split; [|exact Hrun].
      exists (pow (place q)), short. split; [reflexivity|]. split; [exact Hs'|]. right. now exists (place q).
    + destruct Hs as (rest & [= <- ->]).
      exists (Laine q (c * pow (place q)) (pow (place q)) (pow (place q)) short), 0,
        (Laine q (c * pow (place q)) (pow (place q)) (pow (place q)) short).
      split; [reflexivity|]. split; [lia|]. split; [|reflexivity].
      exists (pow (place q)), short. split; [reflexivity|]. split; [now exists rest|]. right. now exists (place q).
  - destruct (carry_ends k t Hb) as (Hz & _). apply backtrack_none in Hb. subst t.
    rewrite counter_overflow. fold (pow (depth k)). rewrite <- HW.
    assert (E : is_set (pow (W - 1)) (top W) = true) by (unfold top; rewrite is_set_bit; apply N.pow2_bits_true).
    now rewrite E.
Qed.

(** Whatever the machine of key and trail does from here, this one does in at most [W] times as many visits. *)
Lemma laine_follows fuel : forall s k t u h r, at_key T k = Some u -> fits k t -> way decide k t h -> stands s k t ->
  run trail_machine T decide stop fuel (k, t) h = Some r ->
  exists n, n <= fuel * W /\ forall f, lrun (n + f) s h = Some r.
Proof.
  induction fuel as [|fuel IH]; intros s k t u h r Hu Hf Hw Hs Hrun; [discriminate|].
  pose proof (deep _ _ Hu) as Hd.
  assert (Hkey : l_node s = k) by (destruct Hs as (pop & short & -> & _); reflexivity).
  assert (Back : forall r,
    match trail_backtrack (k, t) with
    | Some a => run trail_machine T decide stop fuel a (k :: h) | None => Some (false, k :: h) end = Some r ->
    exists n, n <= fuel * W + (W - 1) /\ forall f,
      match laine_backtrack W s with Some s => lrun (n + f) s (k :: h) | None => Some (false, k :: h) end = Some r).
  { intros r0 H. apply (way_seen decide k) in Hw; [|lia].
    pose proof (stands_backtrack s k t u (k :: h) Hu Hf Hw Hs) as Hb.
    destruct (trail_backtrack (k, t)) as [[q t']|] eqn:E.
    - destruct Hb as (s' & n & s2 & -> & Hn & Hs2 & Hto).
      destruct (way_back T decide k t q t' (k :: h) u Hu Hf Hw E) as (Hw' & (u' & Hu') & _).
      pose proof (trail_pops k t Hf) as Hp. rewrite E in Hp. destruct (pending k t) as [|q0 p]; [discriminate|].
      destruct Hp as (t0 & [= <- <-] & Hf' & _).
      destruct (IH s2 q t' u' (k :: h) r0 Hu' Hf' Hw' Hs2 H) as (m & Hm & Hr). exists (n + m). split; [lia|].
      intros f. rewrite <- Nat.add_assoc, Hto. apply Hr.
    - rewrite Hb. exists 0. split; [lia|]. intros f. exact H. }
  assert (One : forall f, lrun (S f) s h =
    match u with
    | Leaf => if stop (k :: h) then Some (true, k :: h) else
        match laine_backtrack W s with Some s => lrun f s (k :: h) | None => Some (false, k :: h) end
    | Node _ _ =>
        match decide (k :: h) with
        | Neither => match laine_backtrack W s with Some s => lrun f s (k :: h) | None => Some (false, k :: h) end
        | d => match laine_descend K d s with
               | Some s => lrun f s (k :: h)
               | None => match laine_backtrack W s with Some s => lrun f s (k :: h) | None => Some (false, k :: h) end
               end
        end
    end).
  { intros f. unfold lrun at 1. cbn [laine_run]. rewrite Hkey, Hu, (stands_visits s k t Hs). reflexivity. }
  cbn [run] in Hrun. unfold step in Hrun. cbn [trail_machine key_of fst] in Hrun. rewrite Hu in Hrun.
  destruct u as [|l r0].
  - destruct (stop (k :: h)) eqn:Hstop.
    + exists 1. split; [lia|]. intros f. cbn [Nat.add]. rewrite One. exact Hrun.
    + destruct (Back r) as (n & Hn & Hr).
      { unfold back in Hrun. cbn [trail_machine backtrack] in Hrun. destruct (trail_backtrack (k, t)); exact Hrun. }
      exists (S n). split; [lia|]. intros f. cbn [Nat.add]. rewrite One. apply Hr.
  - assert (Hdeep : S (depth k) < W).
    { pose proof (deep (child L k) _ (at_child T L k l r0 Hu)) as H. now rewrite depth_child in H. }
    destruct (decide (k :: h)) as [|sd|sd] eqn:Hdec.
    + destruct (Back r) as (n & Hn & Hr).
      { unfold back in Hrun. cbn [trail_machine backtrack] in Hrun. destruct (trail_backtrack (k, t)); exact Hrun. }
      exists (S n). split; [lia|]. intros f. cbn [Nat.add]. rewrite One. apply Hr.
    + destruct (stands_descend s k t (Only sd) Hdeep) as (s' & Hs' & Hst); [discriminate|exact Hs|].
      pose proof (way_child decide (Only sd) k t h ltac:(discriminate) Hdec Hw) as Hw'.
      destruct (IH s' (child sd k) (N.double t) _ (k :: h) r (at_child T sd k l r0 Hu)) as (n & Hn & Hr);
        [now apply fits_child|exact Hw'|exact Hst|exact Hrun|].
      exists (S n). split; [lia|]. intros f. cbn [Nat.add]. rewrite One, Hs'. apply Hr.
    + destruct (stands_descend s k t (Both sd) Hdeep) as (s' & Hs' & Hst); [discriminate|exact Hs|].
      pose proof (way_child decide (Both sd) k t h ltac:(discriminate) Hdec Hw) as Hw'.
      destruct (IH s' (child sd k) (N.succ_double t) _ (k :: h) r (at_child T sd k l r0 Hu)) as (n & Hn & Hr);
        [now apply fits_child|exact Hw'|exact Hst|exact Hrun|].
      exists (S n). split; [lia|]. intros f. cbn [Nat.add]. rewrite One, Hs'. apply Hr.
Qed.

(** [LAINE-1] In words of [W] bits, over trees of height [W - 1] at most, with a short stack of any length, the restart
    trail has the reference's visits and answer, for every search in which a node that is asked again answers what it
    answered at its visit. It ends; for each visit there are at most [W - 1] on the way down again. *)
Theorem laine_reference fuel : size T * W <= fuel ->
  laine_run W K T decide again stop false fuel (laine_start W) [] = Some (reference decide stop T).
Proof.
  intros Hfuel.
  destruct (laine_follows (size T) (laine_start W) xH 0 T [] (reference decide stop T) eq_refl eq_refl I) as (n & Hn & Hr).
  - exists 0%N, []. split; [unfold laine_start, place, top; cbn [depth]; now rewrite Nat.sub_0_r|].
    split; [now exists []|auto].
  - exact (trail_machine_reference T decide stop (size T) (le_n _)).
  - replace fuel with (n + (fuel - n)) by lia. apply Hr.
Qed.

End Unchanging.

(** What a node answered at its visit. *)
Definition remembered (decide : history -> descent) (k : positive) (h : history) : descent :=
  match answer decide k h with Some d => d | None => Neither end.

(** [LAINE-1] So for every tree and every search, also one whose decisions change from one node to the next, if answers
    are kept. *)
Corollary laine_remembered_reference W K T decide stop fuel : height T < W -> size T * W <= fuel ->
  laine_run W K T decide (remembered decide) stop false fuel (laine_start W) [] = Some (reference decide stop T).
Proof. intros HW. apply laine_reference; [exact HW|]. unfold remembered. now intros k h d ->. Qed.
