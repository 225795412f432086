(** The restart trail with a short stack, Laine 2010, whatever nodes answer when they are asked again: trail, levels and
    short stack go together, and it ends. *)

Require Import Arith List PArith NArith Lia Bool.
Require Import Tree Machine Bits Implicit Words LaineMachine.
Import ListNotations.

(** * What the trail says by itself *)

Section Shape.

Variables W K : nat.
Notation place := (place W).

(** The bit of the level of a node. *)
Definition bit (trail : N) (k : positive) : bool := N.testbit trail (N.of_nat (place k)).

(** What waits: the sibling of each ancestor at whose level the bit is 0. *)
Fixpoint waiting (trail : N) (k : positive) : list positive :=
  match k with
  | xH => []
  | xO a | xI a => (if bit trail k then [] else [sibling k]) ++ waiting trail a
  end.

Lemma waiting_child trail sd a :
  waiting trail (child sd a) = (if bit trail (child sd a) then [] else [child (other sd) a]) ++ waiting trail a.
Proof. now destruct sd. Qed.

(** The same bits above a level. *)
Definition same_above (e : nat) (x y : N) : Prop := forall i, e <= i -> N.testbit x (N.of_nat i) = N.testbit y (N.of_nat i).

Lemma waiting_same x y k : depth k < W -> same_above (place k) x y -> waiting x k = waiting y k.
Proof.
  induction k as [k IH|k IH|]; intros Hd H; [| |reflexivity]; cbn [waiting]; cbn [depth] in Hd.
  all: assert (E : waiting x k = waiting y k) by
    (apply IH; [lia|intros i Hi; apply H; unfold LaineMachine.place in *; cbn [depth]; lia]); rewrite E.
  all: unfold bit; rewrite H by lia; reflexivity.
Qed.

(** ** Down *)

Lemma lor_same_above x e : same_above (S e) (N.lor x (pow e)) x.
Proof.
  intros i Hi. rewrite N.lor_spec. unfold pow. rewrite N.pow2_bits_false by lia. apply orb_false_r.
Qed.

Lemma lor_below_bit x e i : i < e -> N.testbit (N.lor x (pow e)) (N.of_nat i) = N.testbit x (N.of_nat i).
Proof. intros Hi. rewrite N.lor_spec. unfold pow. rewrite N.pow2_bits_false by lia. apply orb_false_r. Qed.

Lemma lor_bit x e : N.testbit (N.lor x (pow e)) (N.of_nat e) = true.
Proof. rewrite N.lor_spec. unfold pow. rewrite N.pow2_bits_true. apply orb_true_r. Qed.

Lemma lor_below x e w : e < w -> (x < pow w -> N.lor x (pow e) < pow w)%N.
Proof.
  intros He Hx. pose proof (pow_lt e w He). destruct (N.eq_dec x 0) as [->|H0]; [rewrite N.lor_0_l; assumption|].
  pose proof (pow_pos e). assert (N.lor x (pow e) <> 0%N) by (intros E; apply N.lor_eq_0_iff in E; lia).
  apply N.log2_lt_pow2; [lia|]. rewrite N.log2_lor. apply N.max_lub_lt; apply N.log2_lt_pow2; assumption || lia.
Qed.

Lemma lor_grows x y : (x <= N.lor x y)%N.
Proof.
  assert (E : N.land x (N.ldiff y x) = 0%N) by (rewrite N.land_comm; apply N.land_ldiff).
  assert (F : N.lor x y = (x + N.ldiff y x)%N); [|lia].
  rewrite (N.add_nocarry_lxor _ _ E), (N.lxor_lor _ _ E). apply N.bits_inj. intros i.
  rewrite !N.lor_spec, N.ldiff_spec. now destruct (N.testbit x i), (N.testbit y i).
Qed.

(** ** Up *)

(** The trail after a backtrack: the bits below the level are cleared, 1 is added there. *)
Definition next_trail (trail : N) (k : positive) : N := ((shr trail (place k) + 1) * pow (place k))%N.

Lemma shr_below x e : e <= W - 1 -> (x < pow (W - 1) -> shr x e < pow (W - 1 - e))%N.
Proof.
  intros He Hx. unfold shr. rewrite N.shiftr_div_pow2. apply N.div_lt_upper_bound; [apply N.pow_nonzero; discriminate|].
  fold (pow e). rewrite <- pow_add. now replace (e + (W - 1 - e)) with (W - 1) by lia.
Qed.

Lemma next_trail_range x k : depth k < W -> (x < pow (W - 1) -> x < next_trail x k <= pow (W - 1))%N.
Proof.
  intros Hd Hx. unfold next_trail. assert (He : place k <= W - 1) by (unfold LaineMachine.place; lia).
  pose proof (shr_below x (place k) He Hx) as H.
  assert (E : pow (W - 1) = (pow (W - 1 - place k) * pow (place k))%N) by (rewrite <- pow_add; f_equal; lia).
  split; [|rewrite E; pose proof (pow_pos (place k)); nia].
  unfold shr. rewrite N.shiftr_div_pow2. fold (pow (place k)). pose proof (pow_pos (place k)).
  pose proof (N.div_mod x (pow (place k))). pose proof (N.mod_lt x (pow (place k))). nia.
Qed.

Lemma next_trail_positive x k : (0 < next_trail x k)%N.
Proof. unfold next_trail. pose proof (pow_pos (place k)). nia. Qed.

Lemma is_top x : (x <= pow (W - 1))%N -> is_set x (top W) = N.eqb x (pow (W - 1)).
Proof.
  intros H. unfold top. rewrite is_set_bit. destruct (N.eqb_spec x (pow (W - 1))) as [->|Hx].
  - apply N.pow2_bits_true.
  - apply high_bit_clear. fold (pow (W - 1)). lia.
Qed.

(** The carry runs up through the bits that are set. *)
Inductive rises (trail : N) : positive -> positive -> Prop :=
  | rises_here k : rises trail k k
  | rises_up sd a c : bit trail (child sd a) = true -> rises trail a c -> rises trail (child sd a) c.

Lemma rises_end trail k : rises trail k xH \/
  exists sd a, rises trail k (child sd a) /\ bit trail (child sd a) = false.
Proof.
  assert (E : forall sd k, (rises trail k xH \/ exists sd a, rises trail k (child sd a) /\ bit trail (child sd a) = false) ->
    rises trail (child sd k) xH \/
    exists sd' a, rises trail (child sd k) (child sd' a) /\ bit trail (child sd' a) = false).
  { clear k. intros sd k H. destruct (bit trail (child sd k)) eqn:Hb.
    - destruct H as [H|(sd' & a & H & Ha)]; [left; now constructor|]. right. exists sd', a. split; [now constructor|exact Ha].
    - right. exists sd, k. split; [constructor|exact Hb]. }
  induction k as [k IH|k IH|]; [exact (E R k IH)|exact (E L k IH)|left; constructor].
Qed.

Lemma shr_bit x e : (shr x e = 2 * shr x (S e) + N.b2n (N.testbit x (N.of_nat e)))%N.
Proof.
  replace (shr x (S e)) with (N.div2 (shr x e)).
  - rewrite (N.div2_odd (shr x e)) at 1. rewrite <- N.bit0_odd. unfold shr at 2. now rewrite N.shiftr_spec'.
  - unfold shr. rewrite N.div2_spec, N.shiftr_shiftr. f_equal. lia.
Qed.

Lemma shr_odd x e : N.testbit x (N.of_nat e) = true -> (shr x e + 1 = 2 * (shr x (S e) + 1))%N.
Proof. intros H. rewrite (shr_bit x e), H. cbn [N.b2n]. lia. Qed.

Lemma shr_even x e : N.testbit x (N.of_nat e) = false -> (shr x e + 1 = 2 * shr x (S e) + 1)%N.
Proof. intros H. rewrite (shr_bit x e), H. cbn [N.b2n]. lia. Qed.

(** Where it runs up to the root, it is over. *)
Lemma next_trail_root trail : (trail < pow (W - 1))%N -> next_trail trail xH = pow (W - 1).
Proof.
  intros Ht. unfold next_trail. replace (place xH) with (W - 1) by (unfold LaineMachine.place; cbn; lia).
  pose proof (shr_below trail (W - 1) (le_n _) Ht) as H. rewrite Nat.sub_diag in H. change (pow 0) with 1%N in H.
  replace (shr trail (W - 1)) with 0%N by lia. lia.
Qed.

(** Where the carry ends, the other child comes next. *)
Lemma carry_ends_at trail sd a : (trail < pow (W - 1))%N -> S (depth a) < W -> bit trail (child sd a) = false ->
  let q := child (other sd) a in let n := next_trail trail (child sd a) in
  ctz n = place q /\ bit n q = true /\ same_above (S (place q)) n trail /\ (n < pow (W - 1))%N /\
  waiting n q = waiting trail a.
Proof.
  intros Ht Hd Hb q n. assert (Hq : place q = place (child sd a)) by (unfold LaineMachine.place, q; now rewrite !depth_child).
  set (e := place q) in *. set (x := shr trail (S e)).
  assert (Hn : n = (N.succ_double x * pow e)%N).
  { unfold n, next_trail. rewrite <- Hq. unfold bit in Hb. rewrite <- Hq in Hb. rewrite (shr_even trail e Hb).
    now rewrite N.succ_double_spec. }
  assert (Hc : ctz n = e) by (rewrite Hn, ctz_times; [now destruct x|now destruct x]).
  assert (Hbit : forall i, e <= i -> N.testbit n (N.of_nat i) = N.testbit (N.succ_double x) (N.of_nat (i - e))).
  { intros i Hi. rewrite Hn. unfold pow. rewrite <- N.shiftl_mul_pow2, N.shiftl_spec_high' by lia. f_equal. lia. }
  assert (Hs : same_above (S e) n trail).
  { intros i Hi. rewrite Hbit by lia. replace (i - e) with (S (i - S e)) by lia. rewrite <- bit_div2.
    rewrite (proj2 (div2_double x)). unfold x, shr. rewrite N.shiftr_spec'. f_equal. lia. }
  assert (Hbq : bit n q = true).
  { unfold bit. fold e. rewrite Hbit, Nat.sub_diag by lia. now destruct x. }
  pose proof (place_child W (other sd) a Hd) as Hpl. fold q in Hpl. fold e in Hpl.
  assert (Hlt : (n < pow (W - 1))%N).
  { assert (He : S e <= W - 1) by (rewrite <- Hpl; unfold LaineMachine.place; lia).
    pose proof (shr_below trail (S e) He Ht) as Hx. fold x in Hx.
    replace (pow (W - 1)) with (pow (W - 1 - S e) * (2 * pow e))%N.
    - rewrite Hn, N.succ_double_spec. pose proof (pow_pos e). nia.
    - rewrite <- pow_double, <- pow_add. f_equal. lia. }
  repeat (split; [assumption|]). unfold q. rewrite waiting_child. fold q. rewrite Hbq. cbn [app].
  apply waiting_same; [lia|]. rewrite Hpl. exact Hs.
Qed.

(** * The moves *)

Variable T : tree.
Hypothesis carries : height T < W.

Lemma deep k u : at_key T k = Some u -> depth k < W.
Proof. intros H. pose proof (at_key_height T k u H). lia. Qed.

Lemma at_parent sd a u : at_key T (child sd a) = Some u -> exists l r, at_key T a = Some (Node l r) /\ u = subtree sd l r.
Proof. destruct sd; cbn; destruct (at_key T a) as [[|l r]|]; try discriminate; intros [= <-]; eauto. Qed.

(** Node and level belong to each other, and the short stack holds what has been postponed last. *)
Definition shape (s : laine_state) : Prop :=
  (exists u, at_key T (l_node s) = Some u) /\ l_level s = pow (place (l_node s)) /\ (l_trail s < pow (W - 1))%N /\
  prefix (l_short s) (waiting (l_trail s) (l_node s)).

Lemma backtrack_is s : shape s ->
  let n := next_trail (l_trail s) (l_node s) in
  laine_backtrack W s =
  if N.eqb n (pow (W - 1)) then None else
  match l_short s with
  | q :: short => Some (Laine q n (pow (ctz n)) (pow (ctz n)) short)
  | [] => Some (Laine xH n (top W) (pow (ctz n)) [])
  end.
Proof.
  destruct s as [k trail level pop short]. cbn [l_node l_trail l_short]. intros ((u & Hu) & Hl & Ht & _).
  cbn [l_node l_trail l_short l_level] in *. subst level. pose proof (deep k u Hu) as Hd.
  assert (HW1 : (pow (W - 1) < pow W)%N) by (apply pow_lt; lia).
  pose proof (next_trail_range trail k Hd Ht) as Hn. pose proof (next_trail_positive trail k) as H0.
  cbn [laine_backtrack]. rewrite clear_below by (try (unfold LaineMachine.place; lia); lia).
  replace (shr trail (place k) * pow (place k) + pow (place k))%N with (next_trail trail k) by (unfold next_trail; lia).
  rewrite !wrap_small by lia. rewrite lowest_bit by lia. rewrite is_top by lia. reflexivity.
Qed.

Lemma rises_next trail k c : rises trail k c -> forall u, at_key T k = Some u ->
  next_trail trail k = next_trail trail c /\ waiting trail k = waiting trail c /\ exists u, at_key T c = Some u.
Proof.
  induction 1 as [k|sd a c Hb H IH]; intros u Hu; [eauto|].
  pose proof (deep _ _ Hu) as Hd. rewrite depth_child in Hd. destruct (at_parent sd a u Hu) as (l & r & Ha & _).
  destruct (IH _ Ha) as (E & F & G). split; [|split; [|exact G]].
  - rewrite <- E. unfold next_trail. rewrite (shr_odd trail _ Hb), (place_child W sd a Hd), pow_double. lia.
  - now rewrite waiting_child, Hb.
Qed.

Lemma shape_start : shape (laine_start W).
Proof.
  unfold shape, laine_start. cbn. split; [eauto|]. unfold top, LaineMachine.place. cbn. rewrite Nat.sub_0_r.
  split; [reflexivity|]. split; [apply pow_pos|]. now exists [].
Qed.

(** What is left to do, at most. *)
Definition measure (s : laine_state) : nat := N.to_nat (pow (W - 1) - l_trail s) * W + place (l_node s).

Lemma shape_descend s d l r s' : shape s -> at_key T (l_node s) = Some (Node l r) -> laine_descend K d s = Some s' ->
  shape s' /\ measure s' < measure s.
Proof.
  destruct s as [k trail level pop short]. cbn [l_node]. intros (_ & Hl & Ht & Hs) Hk. cbn [l_node l_trail l_short l_level] in *.
  subst level. assert (Hd : S (depth k) < W).
  { pose proof (deep (child L k) _ (at_child T L k l r Hk)) as H. now rewrite depth_child in H. }
  assert (Hpl : forall sd, place k = S (place (child sd k))) by (intros sd; now apply place_child).
  assert (Go : forall sd trail' short', (trail <= trail' < pow (W - 1))%N -> prefix short' (waiting trail' (child sd k)) ->
    let s' := Laine (child sd k) trail' (pow (place (child sd k))) pop short' in
    shape s' /\ measure s' < measure (Laine k trail (pow (place k)) pop short)).
  { intros sd trail' short' Ht' Hs'. split.
    - split; [exists (subtree sd l r); now apply at_child|]. cbn. repeat split; [lia|exact Hs'].
    - unfold measure. cbn [l_trail l_node]. rewrite (Hpl sd). nia. }
  assert (Hw : forall sd x, same_above (S (place (child sd k))) x trail -> waiting x k = waiting trail k).
  { intros sd x H. apply waiting_same; [lia|]. now rewrite (Hpl sd). }
  assert (Hh : forall sd, N.div2 (pow (place k)) = pow (place (child sd k))) by (intros sd; rewrite (Hpl sd); apply half).
  assert (Hother : forall sd, place (child (other sd) k) = place (child sd k)) by now intros [|].
  cbn [laine_descend]. destruct d as [|sd|sd]; [discriminate|..]; rewrite (Hh sd).
  - destruct (N.eqb _ pop); [discriminate|]. intros [= <-]. apply Go.
    + split; [apply lor_grows|]. apply lor_below; [unfold LaineMachine.place; rewrite depth_child; lia|exact Ht].
    + rewrite waiting_child. unfold bit. rewrite lor_bit, (Hw sd) by apply lor_same_above. exact Hs.
  - rewrite is_set_bit. fold (bit trail (child sd k)). destruct (bit trail (child sd k)) eqn:Hb; intros [= <-].
    + rewrite <- (Hother sd). apply Go; [lia|]. rewrite waiting_child. unfold bit in *. now rewrite (Hother sd), Hb.
    + apply Go; [lia|]. rewrite waiting_child, Hb. cbn [app]. now apply (prefix_push K).
Qed.

(** A backtrack ends it, or leads to the node that waited last, or back to the root on the way there. *)
Lemma shape_backtrack s s' : shape s -> laine_backtrack W s = Some s' -> shape s' /\ measure s' < measure s.
Proof.
  intros Hshape. rewrite (backtrack_is s Hshape). destruct s as [k trail level pop short].
  destruct Hshape as ((u & Hu) & Hl & Ht & Hs). cbn [l_node l_trail l_short l_level] in *. pose proof (deep k u Hu) as Hd.
  pose proof (next_trail_range trail k Hd Ht) as Hn.
  destruct (N.eqb_spec (next_trail trail k) (pow (W - 1))) as [|Hend]; [discriminate|].
  assert (Less : forall q level' pop' short', depth q < W ->
    measure (Laine q (next_trail trail k) level' pop' short') < measure (Laine k trail level pop short)).
  { intros q level' pop' short' Hq. unfold measure. cbn [l_trail l_node]. unfold LaineMachine.place at 1.
    assert (N.to_nat (pow (W - 1) - next_trail trail k) < N.to_nat (pow (W - 1) - trail)) by lia. nia. }
  destruct (rises_end trail k) as [Hr|(sd & a & Hr & Hb)].
  - exfalso. apply Hend. destruct (rises_next _ _ _ Hr u Hu) as (-> & _). now apply next_trail_root.
  - destruct (rises_next _ _ _ Hr u Hu) as (En & Ew & (u' & Hc)).
    pose proof (deep _ _ Hc) as Hdc. rewrite depth_child in Hdc. destruct (at_parent _ _ _ Hc) as (l & r & Ha & _).
    destruct (carry_ends_at trail sd a Ht Hdc Hb) as (Hz & _ & _ & Hlt & Hw). rewrite <- En in *.
    rewrite Ew, waiting_child, Hb in Hs. destruct short as [|q short]; intros [= <-].
    + split; [|apply Less; cbn; lia]. split; [exists T; reflexivity|]. cbn. unfold top, LaineMachine.place. cbn.
      rewrite Nat.sub_0_r. repeat split; [exact Hlt|now exists []].
    + destruct Hs as (rest & Hs). injection Hs as <- Hs. split; [|apply Less; rewrite depth_child; lia].
      split; [exists (subtree (other sd) l r); now apply at_child|]. cbn [l_node l_level l_trail l_short]. rewrite Hz.
      repeat split; [exact Hlt|]. rewrite Hw. now exists rest.
Qed.

(** * It ends *)

Variable decide : history -> descent.
Variable again : positive -> history -> descent.
Variable stop : history -> bool.
Variable all : bool.

Lemma ends m : forall s h, shape s -> measure s < m ->
  exists r, forall f, laine_run W K T decide again stop all (m + f) s h = Some r.
Proof.
  induction m as [|m IH]; intros s h Hs Hm; [lia|].
  assert (Back : forall h, exists r, forall f,
    match laine_backtrack W s with Some s => laine_run W K T decide again stop all (m + f) s h | None => Some (false, h) end
    = Some r).
  { intros h0. destruct (laine_backtrack W s) as [s'|] eqn:E; [|eauto].
    destruct (shape_backtrack s s' Hs E) as (Hs' & Hlt). apply IH; [exact Hs'|lia]. }
  pose proof Hs as ((u & Hu) & _). cbn [Nat.add laine_run]. rewrite Hu. destruct u as [|l r].
  - destruct (stop _); [eauto|apply Back].
  - destruct (if restarting s then again (l_node s) _ else decide _) as [|sd|sd]; [apply Back|..].
    all: destruct (laine_descend K _ s) as [s'|] eqn:E; [|apply Back].
    all: destruct (shape_descend s _ l r s' Hs Hu E) as (Hs' & Hlt); apply IH; [exact Hs'|lia].
Qed.

(** [LAINE-1] It ends whatever it is answered, also by nodes that are asked again and want more than before, and never
    asks for a node that is not there. *)
Theorem laine_ends : exists n r, forall fuel, n <= fuel ->
  laine_run W K T decide again stop all fuel (laine_start W) [] = Some r.
Proof.
  destruct (ends (S (measure (laine_start W))) (laine_start W) [] shape_start (le_n _)) as (r & H).
  exists (S (measure (laine_start W))), r. intros fuel Hf.
  replace fuel with (S (measure (laine_start W)) + (fuel - S (measure (laine_start W)))) by lia. apply H.
Qed.

End Shape.
