(** The restart trail with a short stack, Laine 2010: the machine, its words and levels. *)

Require Import Arith List PArith NArith Lia Bool.
Require Import Tree Machine Bits Implicit Words Register.
Import ListNotations.

(** * The machine *)

Section Machine.

(** The bits of a word, and how many nodes the short stack has. *)
Variables W K : nat.

(** A word in which one bit is set. *)
Definition pow (e : nat) : N := (2 ^ N.of_nat e)%N.

(** Arithmetic that wraps. *)
Definition wrap (x : N) : N := (x mod pow W)%N.
Definition negate (x : N) : N := wrap (pow W - x).

Definition is_set (x bit : N) : bool := negb (N.eqb (N.land x bit) 0).

(** The level of the root. *)
Definition top : N := pow (W - 1).

(** [l_level] is the bit of the level at which the node was chosen, [l_pop] that at which the last backtrack changed
    sides, 0 before the first. *)
Record laine_state := Laine { l_node : positive; l_trail : N; l_level : N; l_pop : N; l_short : list positive }.

Definition laine_start : laine_state := Laine xH 0 top 0 [].

(** Level bits are single: the trailing zeros compare them. *)
Definition restarting (s : laine_state) : bool :=
  negb (N.eqb (l_pop s) 0) && (ctz (l_pop s) <? ctz (l_level s)).

(** To the first child, or to the second if the trail says that the first is done. [None]: the one that is wanted is
    done. *)
Definition laine_descend (d : descent) (s : laine_state) : option laine_state :=
  let '(Laine k trail level pop short) := s in
  let level := N.div2 level in
  match d with
  | Neither => None
  | Only sd => if N.eqb level pop then None else Some (Laine (child sd k) (N.lor trail level) level pop short)
  | Both sd =>
      if is_set trail level then Some (Laine (child (other sd) k) trail level pop short)
      else Some (Laine (child sd k) trail level pop (firstn K (child (other sd) k :: short)))
  end.

(** Clears the bits below the level, and adds 1 there. Then pops a node, or goes back to the root. *)
Definition laine_backtrack (s : laine_state) : option laine_state :=
  let '(Laine k trail level pop short) := s in
  let trail := wrap (N.land trail (negate level) + level) in
  let pop := N.land trail (negate trail) in
  if is_set trail top then None else
  match short with
  | q :: short => Some (Laine q trail pop pop short)
  | [] => Some (Laine xH trail top pop [])
  end.

Variable T : tree.
Variable decide : history -> descent.
(** What a node answers on the way down again. *)
Variable again : positive -> history -> descent.
Variable stop : history -> bool.
(** Whether visits on the way down again are part of the history. *)
Variable all : bool.

(** [LAINE-1] The loop, for a cursor that restarts: at most [fuel] visits, also those on the way down again. *)
Fixpoint laine_run (fuel : nat) (s : laine_state) (h : history) : option (bool * history) :=
  match fuel with
  | 0 => None
  | S fuel =>
      let k := l_node s in
      let back h := match laine_backtrack s with Some s => laine_run fuel s h | None => Some (false, h) end in
      let h := if restarting s && negb all then h else k :: h in
      match at_key T k with
      | None => None
      | Some Leaf => if stop h then Some (true, h) else back h
      | Some (Node _ _) =>
          match (if restarting s then again k h else decide h) with
          | Neither => back h
          | d => match laine_descend d s with Some s => laine_run fuel s h | None => back h end
          end
      end
  end.

End Machine.

(** * Words *)

Section Words.

Variable W : nat.

Lemma pow_succ e : pow (S e) = N.double (pow e).
Proof. rewrite N.double_spec. unfold pow. rewrite Nat2N.inj_succ. apply N.pow_succ_r'. Qed.

Lemma pow_double e : pow (S e) = (2 * pow e)%N.
Proof. unfold pow. rewrite Nat2N.inj_succ. apply N.pow_succ_r'. Qed.

Lemma pow_pos e : (0 < pow e)%N.
Proof. apply N.neq_0_lt_0, N.pow_nonzero. discriminate. Qed.

Lemma pow_lt a b : a < b -> (pow a < pow b)%N.
Proof. intros H. apply N.pow_lt_mono_r; lia. Qed.

Lemma pow_add a b : pow (a + b) = (pow a * pow b)%N.
Proof. unfold pow. now rewrite Nat2N.inj_add, N.pow_add_r. Qed.

Lemma wrap_small x : (x < pow W)%N -> wrap W x = x.
Proof. apply N.mod_small. Qed.

Lemma ctz_times e x : x <> 0%N -> ctz (x * pow e) = ctz x + e.
Proof.
  intros Hx. induction e as [|e IH]; [cbn; rewrite N.mul_1_r; lia|]. rewrite pow_succ, N.double_spec.
  replace (x * (2 * pow e))%N with (N.double (x * pow e)) by (rewrite N.double_spec; lia).
  rewrite ctz_double, IH; [lia|]. pose proof (pow_pos e). lia.
Qed.

Lemma is_set_bit x e : is_set x (pow e) = N.testbit x (N.of_nat e).
Proof.
  unfold is_set. destruct (N.testbit x (N.of_nat e)) eqn:E.
  - destruct (N.eqb_spec (N.land x (pow e)) 0) as [H|]; [|reflexivity].
    assert (B : N.testbit (N.land x (pow e)) (N.of_nat e) = false) by (rewrite H; apply N.bits_0).
    rewrite N.land_spec, E in B. unfold pow in B. rewrite N.pow2_bits_true in B. discriminate.
  - replace (N.land x (pow e)) with 0%N; [reflexivity|]. symmetry. apply N.bits_inj. intros i.
    rewrite N.land_spec, N.bits_0. unfold pow. rewrite N.pow2_bits_eqb.
    destruct (N.eqb_spec (N.of_nat e) i) as [<-|]; [now rewrite E|apply andb_false_r].
Qed.

Lemma is_set_odd x e : is_set x (pow e) = N.odd (shr x e).
Proof. rewrite is_set_bit. unfold shr. rewrite <- N.bit0_odd, N.shiftr_spec'. f_equal. Qed.

(** What is below the level is cleared. *)
Lemma clear_below x e : e < W -> (x < pow W)%N -> N.land x (negate W (pow e)) = (shr x e * pow e)%N.
Proof.
  intros He Hx. pose proof (pow_lt e W He) as Hl. pose proof (pow_pos e) as Hp.
  unfold negate, wrap. rewrite N.mod_small by lia. unfold shr, pow at 3. rewrite <- N.shiftl_mul_pow2.
  replace (pow W - pow e)%N with (N.shiftl (N.ones (N.of_nat (W - e))) (N.of_nat e)).
  - apply N.bits_inj. intros i. rewrite N.land_spec. destruct (N.lt_ge_cases i (N.of_nat e)).
    + rewrite !N.shiftl_spec_low by assumption. apply andb_false_r.
    + rewrite !N.shiftl_spec_high' by assumption. rewrite N.shiftr_spec'.
      replace (i - N.of_nat e + N.of_nat e)%N with i by lia.
      destruct (N.lt_ge_cases i (N.of_nat W)) as [Hi|Hi].
      * rewrite N.ones_spec_low by lia. apply andb_true_r.
      * replace (N.testbit x i) with false; [reflexivity|]. symmetry.
        destruct (N.eq_dec x 0) as [->|]; [apply N.bits_0|]. apply N.bits_above_log2.
        apply N.lt_le_trans with (N.of_nat W); [apply N.log2_lt_pow2; [lia|exact Hx]|exact Hi].
  - rewrite N.shiftl_mul_pow2, N.ones_equiv. fold (pow (W - e)) (pow e).
    replace (pow W) with (pow (W - e) * pow e)%N by (rewrite <- pow_add; f_equal; lia).
    pose proof (pow_pos (W - e)). nia.
Qed.

(** The lowest bit that is set. *)
Lemma lowest_bit x : (0 < x < pow W)%N -> N.land x (negate W x) = pow (ctz x).
Proof.
  intros Hx. unfold negate, wrap. rewrite N.mod_small by lia. revert Hx. generalize W.
  destruct x as [|p]; [lia|]. induction p as [p IH|p IH|]; intros w [_ Hx]; (destruct w as [|w]; [cbn in Hx; lia|]);
    rewrite pow_succ in *.
  - replace (N.double (pow w) - N.pos p~1)%N with (N.succ_double (N.pred (pow w) - Npos p))
      by (rewrite N.succ_double_spec, N.double_spec in *; lia).
    replace (N.pred (pow w)) with (N.ones (N.of_nat w)) by apply N.ones_equiv.
    assert (E : N.land (Npos p) (N.ones (N.of_nat w) - Npos p) = 0%N).
    { rewrite N.sub_nocarry_ldiff; [rewrite N.land_comm; apply N.land_ldiff|]. apply N.ldiff_ones_r_low.
      apply N.log2_lt_pow2; [lia|]. fold (pow w). rewrite N.double_spec in Hx. lia. }
    revert E. generalize (N.ones (N.of_nat w) - N.pos p)%N. intros [|m]; [reflexivity|]. cbn. now intros ->.
  - replace (N.double (pow w) - N.pos p~0)%N with (N.double (pow w - Npos p)) by (rewrite !N.double_spec in *; lia).
    change (ctz (N.pos p~0)) with (S (ctz (Npos p))). rewrite pow_succ, <- (IH w).
    + generalize (pow w - N.pos p)%N. now intros [|m].
    + rewrite N.double_spec in Hx. lia.
  - pose proof (pow_pos w) as Hw. rewrite <- (N.succ_pred (pow w)) by lia. generalize (N.pred (pow w)). intros m.
    assert (E : (N.double (N.succ m) - 1 = N.succ_double m)%N) by (rewrite N.succ_double_spec, N.double_spec; lia).
    rewrite E. now destruct m.
Qed.

Lemma lor_set x e : N.testbit x (N.of_nat e) = true -> N.lor x (pow e) = x.
Proof.
  intros E. apply N.bits_inj. intros i. rewrite N.lor_spec. unfold pow. rewrite N.pow2_bits_eqb.
  destruct (N.eqb_spec (N.of_nat e) i) as [<-|]; [now rewrite E|apply orb_false_r].
Qed.

Lemma lor_next c e : N.lor (c * pow (S e)) (pow e) = (N.succ_double c * pow e)%N.
Proof.
  replace (c * pow (S e))%N with (N.shiftl (N.double c) (N.of_nat e))
    by (rewrite N.shiftl_mul_pow2; fold (pow e); rewrite pow_succ, !N.double_spec; lia).
  replace (pow e) with (N.shiftl 1 (N.of_nat e)) at 1 by (rewrite N.shiftl_mul_pow2; fold (pow e); lia).
  rewrite <- N.shiftl_lor, N.shiftl_mul_pow2. fold (pow e). f_equal. now destruct c.
Qed.

Lemma shr_times c e : shr (c * pow e) e = c.
Proof. unfold shr, pow. rewrite N.shiftr_div_pow2, N.div_mul; [reflexivity|]. apply N.pow_nonzero. discriminate. Qed.

(** The trailing zeros of a number, shifted out. *)
Lemma shr_ctz x : x <> 0%N -> x = (shr x (ctz x) * pow (ctz x))%N.
Proof.
  destruct x as [|p]; [easy|intros _]. induction p as [p IH|p IH|]; [cbn [ctz ctz_pos]; rewrite shr_0; cbn; lia| |reflexivity].
  change (ctz (N.pos p~0)) with (S (ctz (Npos p))). rewrite shr_succ, pow_succ, N.double_spec. cbn [N.div2 Pos.div2].
  change (N.pos p~0) with (N.double (Npos p)). rewrite N.double_spec, IH at 1. lia.
Qed.

Lemma odd_ctz x : N.odd x = true -> ctz x = 0.
Proof. destruct x as [|[|p|]]; try reflexivity. discriminate. Qed.

Lemma odd_double x : N.odd (N.double x) = false /\ N.odd (N.succ_double x) = true.
Proof. now destruct x. Qed.

End Words.

(** * Levels and the short stack *)

Section Levels.

Variables W K : nat.

(** The exponent of a node's level. *)
Definition place (k : positive) : nat := W - 1 - depth k.

Definition prefix (a b : list positive) : Prop := exists c, b = a ++ c.

Lemma prefix_push x a b : prefix a b -> prefix (firstn K (x :: a)) (x :: b).
Proof.
  intros (c & ->). exists (skipn K (x :: a) ++ c). rewrite app_assoc, firstn_skipn. reflexivity.
Qed.

Lemma place_child sd k : S (depth k) < W -> place k = S (place (child sd k)).
Proof. unfold place. rewrite depth_child. lia. Qed.

Lemma ctz_pow' e : ctz (pow e) = e.
Proof. apply ctz_pow. Qed.

Lemma half e : N.div2 (pow (S e)) = pow e.
Proof. rewrite pow_succ. apply div2_double. Qed.

Lemma pow_not_0 e : N.eqb (pow e) 0 = false.
Proof. apply N.eqb_neq. pose proof (pow_pos e). lia. Qed.

Lemma on_way_down k trail e short : e < place k -> restarting (Laine k trail (pow (place k)) (pow e) short) = true.
Proof. intros H. unfold restarting. cbn. rewrite pow_not_0, !ctz_pow'. cbn. apply Nat.ltb_lt, H. Qed.

End Levels.

(** * The way to the present node *)

Section Way.

Variable T : tree.
Variable decide : history -> descent.

(** What a node answered at its visit. *)
Fixpoint answer (a : positive) (h : history) : option descent :=
  match h with [] => None | k :: h' => if Pos.eqb k a then Some (decide h) else answer a h' end.

(** The node answered so that the way goes to this side, the other child being postponed or not. *)
Definition leads (sd : side) (a : positive) (postponed : bool) (h : history) : Prop :=
  exists d, answer a h = Some d /\ if postponed then d = Both sd else d = Only sd \/ d = Both (other sd).

Fixpoint way (k : positive) (t : N) (h : history) : Prop :=
  match k with
  | xH => True
  | xO a => leads L a (N.odd t) h /\ way a (N.div2 t) h
  | xI a => leads R a (N.odd t) h /\ way a (N.div2 t) h
  end.

Lemma way_seen x h k : forall t, depth k <= depth x -> way k t h -> way k t (x :: h).
Proof.
  assert (E : forall sd a b, depth a < depth x -> leads sd a b h -> leads sd a b (x :: h)).
  { intros sd a b Ha (d & H & Hd). exists d. split; [|exact Hd]. cbn [answer].
    destruct (Pos.eqb_spec x a) as [->|]; [lia|exact H]. }
  induction k as [k IH|k IH|]; intros t Hk; cbn in *; [| |auto]; intros [Hl Hw]; split; (apply E || apply IH); auto; lia.
Qed.

Lemma way_child d k t h : d <> Neither -> decide (k :: h) = d -> way k t h ->
  let '(k', t') := trail_descend d (k, t) in way k' t' (k :: h).
Proof.
  intros H0 Hd Hw. apply (way_seen k) in Hw; [|lia].
  assert (A : answer k (k :: h) = Some d) by (cbn [answer]; now rewrite Pos.eqb_refl, Hd).
  destruct d as [|[|]|[|]]; [easy|..]; cbn [trail_descend child way];
    rewrite ?(proj1 (div2_double t)), ?(proj2 (div2_double t)).
  all: split; [|exact Hw]; eexists; (split; [exact A|]); destruct t; cbn; auto.
Qed.

(** Where a backtrack leads, there is a node; its parent has postponed it. *)
Lemma way_back k : forall t q t' h u, at_key T k = Some u -> fits k t -> way k t h -> trail_backtrack (k, t) = Some (q, t') ->
  way q t' h /\ (exists u, at_key T q = Some u) /\ (exists sd a, q = child sd a /\ answer a h = Some (Both (other sd))).
Proof.
  induction k as [k IH|k IH|]; intros t q t' h u Hu Hf Hw Hb;
    [| |cbn in Hf; subst t; discriminate].
  all: cbn in Hu; destruct (at_key T k) as [[|l r]|] eqn:Hk; try discriminate.
  all: destruct Hw as [(d & Ha & Hd) Hw]; cbn in Hf.
  all: destruct t as [|[p|p|]]; cbn [N.odd N.div2 Pos.div2] in *; [discriminate| | |].
  all: try (rewrite trail_backtrack_even in Hb; exact (IH _ _ _ _ _ eq_refl Hf Hw Hb)).
  all: cbn in Hd; subst d; injection Hb as <- <-; cbn; rewrite Hk.
  all: split; [split; [eexists; split; [exact Ha|]; cbn; auto|exact Hw]|].
  all: split; [eauto|].
  all: first [now exists L, k|now exists R, k].
Qed.

End Way.
