(** Bits of key and trail, the loop that counting zeros replaces, J's counter, and the swap of levels.

    J is Barringer & Akenine-Moeller 2013. *)

Require Import Arith List PArith NArith Lia Bool.
Require Import Tree Machine.
Import ListNotations.

(** * Keys *)

Definition side_bit (sd : side) : N := match sd with L => 0%N | R => 1%N end.

(** [KEY-2] The key of a child, as a number. *)
Lemma child_number sd k : (2 * Npos k + side_bit sd)%N = Npos (child sd k).
Proof. destruct sd; reflexivity. Qed.

Lemma up_succ n : forall k, up (S n) k = Pos.div2 (up n k).
Proof. induction n as [|n IH]; intros k; [reflexivity|apply (IH (Pos.div2 k))]. Qed.

Lemma up_add n m k : up (n + m) k = up m (up n k).
Proof. revert k. induction n as [|n IH]; intros k; [reflexivity|apply IH]. Qed.

(** Each level up is one edge less, down to 0 at the root. *)
Lemma depth_up n : forall k, depth (up n k) = depth k - n.
Proof. induction n as [|n IH]; intros k; [simpl; lia|]. simpl. rewrite IH. destruct k; simpl; lia. Qed.

Lemma depth_root k : depth k = 0 -> k = xH.
Proof. destruct k; [discriminate..|reflexivity]. Qed.

Lemma up_root k : up (depth k) k = xH.
Proof. apply depth_root. rewrite depth_up. lia. Qed.

Lemma depth_sibling k : depth (sibling k) = depth k.
Proof. destruct k; reflexivity. Qed.

Lemma depth_child sd k : depth (child sd k) = S (depth k).
Proof. destruct sd; reflexivity. Qed.

Lemma sibling_child sd k : sibling (child sd k) = child (other sd) k.
Proof. destruct sd; reflexivity. Qed.

(** [KEY-5] A key of depth [d] is at least two to the power [d] and less than twice that. *)
Lemma key_range k : (2 ^ N.of_nat (depth k) <= Npos k < 2 ^ N.of_nat (S (depth k)))%N.
Proof.
  induction k as [k IH|k IH|]; [| |simpl; lia]; simpl depth; rewrite !Nat2N.inj_succ, !N.pow_succ_r' in *; lia.
Qed.

Lemma shr_0 x : shr x 0 = x.
Proof. apply N.shiftr_0_r. Qed.

(** [KEY-3, KEY-4] On numbers, the sibling of the ancestor [n] levels up is [(k >> n) ^ 1], below the root. *)
Lemma sibling_up_bits n : forall k, n < depth k -> Npos (sibling (up n k)) = N.lxor (shr (Npos k) n) 1.
Proof.
  induction n as [|n IH]; intros k Hn; [|rewrite shr_succ].
  - rewrite shr_0. destruct k; simpl in *; [| |lia]; reflexivity.
  - destruct k; simpl in *; [apply IH; lia|apply IH; lia|lia].
Qed.

(** * The bits of the trail *)

(** A trail fits the child if what it was fits the parent. *)
Lemma fits_child sd k t : fits k t -> fits (child sd k) (N.double t) /\ fits (child sd k) (N.succ_double t).
Proof. destruct sd, t; auto. Qed.

(** A trail that fits is less than two to the depth. *)
Lemma fits_range k : forall t, fits k t <-> (t < 2 ^ N.of_nat (depth k))%N.
Proof.
  induction k as [k IH|k IH|]; intros t; [| |simpl; lia].
  all: simpl fits; rewrite IH; simpl depth; rewrite Nat2N.inj_succ, N.pow_succ_r'.
  all: rewrite (N.div2_odd t) at 2; destruct (N.odd t); simpl N.b2n; lia.
Qed.

Lemma bit_div2 t i : N.testbit (N.div2 t) (N.of_nat i) = N.testbit t (N.of_nat (S i)).
Proof. rewrite N.div2_spec, N.shiftr_spec', Nat2N.inj_succ. f_equal. lia. Qed.

(** [TRAIL-2] The child's trail is shifted with the key, and its bit 0 says whether the sibling is postponed. *)
Theorem descend_bits d k t : d <> Neither ->
  N.testbit (snd (trail_descend d (k, t))) 0 = match d with Both _ => true | _ => false end /\
  forall i, N.testbit (snd (trail_descend d (k, t))) (N.of_nat (S i)) = N.testbit t (N.of_nat i).
Proof.
  intros Hd. destruct d; [contradiction|..]; split; try (destruct t; reflexivity); intros i; rewrite <- bit_div2; simpl;
    [rewrite (proj1 (div2_double t))|rewrite (proj2 (div2_double t))]; reflexivity.
Qed.

(** [TRAIL-3] The number of trailing zeros is the place of the lowest bit that is set. *)
Theorem ctz_lowest t : t <> 0%N ->
  N.testbit t (N.of_nat (ctz t)) = true /\ forall i, i < ctz t -> N.testbit t (N.of_nat i) = false.
Proof.
  destruct t as [|p]; [contradiction|intros _]. induction p as [p _|p IH|]; simpl ctz in *;
    [split; [reflexivity|lia]| |split; [reflexivity|lia]].
  rewrite <- bit_div2. split; [apply IH|]. intros [|i] Hi; [reflexivity|]. rewrite <- bit_div2. apply IH. lia.
Qed.

(** Which keys key and trail stand for: where bit [i] is set, the sibling of the ancestor [i] levels up. *)
Lemma pending_bits k : forall t x, In x (pending k t) <->
  exists i, i < depth k /\ N.testbit t (N.of_nat i) = true /\ x = sibling (up i k).
Proof.
  assert (H : forall k', (forall t x, In x (pending k' t) <->
      exists i, i < depth k' /\ N.testbit t (N.of_nat i) = true /\ x = sibling (up i k')) ->
    forall k0, Pos.div2 k0 = k' -> forall t x, In x ((if N.odd t then [sibling k0] else []) ++ pending k' (N.div2 t)) <->
      exists i, i < S (depth k') /\ N.testbit t (N.of_nat i) = true /\ x = sibling (up i k0)).
  { intros k' IH k0 Hk t x. rewrite in_app_iff, IH. split.
    - intros [H|(i & Hi & Hb & Hx)].
      + exists 0. simpl. rewrite N.bit0_odd. destruct (N.odd t); [|destruct H]. destruct H as [<-|[]]. repeat split; lia.
      + exists (S i). simpl up. rewrite Hk, <- bit_div2. repeat split; auto; lia.
    - intros ([|i] & Hi & Hb & Hx).
      + left. simpl in Hb. rewrite N.bit0_odd in Hb. rewrite Hb. left. auto.
      + right. exists i. rewrite <- bit_div2 in Hb. simpl up in Hx. rewrite Hk in Hx.
        repeat split; auto; lia. }
  induction k as [k IH|k IH|]; intros t x; [exact (H k IH k~1 eq_refl t x)%positive|exact (H k IH k~0 eq_refl t x)%positive|].
  simpl. split; [intros []|intros (i & Hi & _); lia].
Qed.

(** * The loop that counting zeros replaces *)

(** One level up while bit 0 is clear, then to the sibling: on numbers, with at most [fuel] looks at bit 0. *)
Fixpoint climb (fuel : nat) (k t : N) : option (N * N) :=
  match fuel with
  | 0 => None
  | S fuel => if N.odd t then Some (N.lxor k 1, N.lxor t 1) else climb fuel (N.div2 k) (N.div2 t)
  end.

(** [TRAIL-4] The same at once. *)
Definition leap (k t : N) : N * N := (N.lxor (shr k (ctz t)) 1, N.lxor (shr t (ctz t)) 1).

(** [TRAIL-5] For every key and every trail but 0, the loop gives what the leap gives, after [ctz] levels. *)
Theorem climb_is_leap t : t <> 0%N -> forall k fuel, climb fuel k t = if ctz t <? fuel then Some (leap k t) else None.
Proof.
  destruct t as [|p]; [congruence|intros _]. unfold leap.
  induction p as [p _|p IH|]; intros k [|fuel]; try reflexivity.
  change (climb (S fuel) k (N.pos p~0)) with (climb fuel (N.div2 k) (N.pos p)). rewrite IH.
  change (ctz (N.pos p~0)) with (S (ctz (N.pos p))). rewrite !shr_succ. reflexivity.
Qed.

(** [TRAIL-5] A trail of 0 has nothing to climb to. *)
Theorem climb_of_nothing fuel : forall k, climb fuel k 0 = None.
Proof. induction fuel as [|fuel IH]; intros k; [reflexivity|apply IH]. Qed.

(** The two cases of the machine's backtrack. *)
Lemma backtrack_none k t : trail_backtrack (k, t) = None -> t = 0%N.
Proof. unfold trail_backtrack. destruct (N.eqb_spec t 0); [auto|discriminate]. Qed.

Lemma backtrack_some k t k' t' : trail_backtrack (k, t) = Some (k', t') ->
  t <> 0%N /\ k' = sibling (up (ctz t) k) /\ t' = N.lxor (shr t (ctz t)) 1.
Proof. unfold trail_backtrack. destruct (N.eqb_spec t 0); [discriminate|]. intros [= <- <-]. auto. Qed.

(** The first set bit of a trail that fits is below the root. *)
Lemma ctz_fits k : forall t, fits k t -> t <> 0%N -> ctz t < depth k.
Proof.
  induction k as [k IH|k IH|]; intros t Hf H0; [| |contradiction].
  all: destruct t as [|[p|p|]]; simpl in *; try lia; apply -> Nat.succ_lt_mono; apply (IH (Npos p) Hf); discriminate.
Qed.

(** [TRAIL-4] The step of the machine is the leap of the numbers. *)
Theorem backtrack_is_leap k t : fits k t -> t <> 0%N ->
  exists k' t', trail_backtrack (k, t) = Some (k', t') /\ leap (Npos k) t = (Npos k', t').
Proof.
  intros Hf H0. unfold trail_backtrack. destruct (N.eqb_spec t 0); [contradiction|].
  do 2 eexists. split; [reflexivity|]. unfold leap. f_equal. symmetry. apply sibling_up_bits, ctz_fits; assumption.
Qed.

(** * J's counter *)

(** The complement below the depth; in J, [levelIndex]. *)
Definition counter (d : nat) (t : N) : N := N.lxor t (N.ones (N.of_nat d)).

Lemma ones_succ d : N.ones (N.of_nat (S d)) = N.succ_double (N.ones (N.of_nat d)).
Proof.
  rewrite Nat2N.inj_succ, !N.ones_equiv, N.pow_succ_r', N.succ_double_spec.
  assert (2 ^ N.of_nat d <> 0)%N by (apply N.pow_nonzero; lia). lia.
Qed.

(** Going down: the counter's new bit is the complement of the trail's. *)
Lemma counter_double d t : counter (S d) (N.double t) = N.succ_double (counter d t).
Proof. unfold counter. rewrite ones_succ. destruct t as [|p], (N.ones (N.of_nat d)) as [|q]; reflexivity. Qed.

Lemma counter_succ_double d t : counter (S d) (N.succ_double t) = N.double (counter d t).
Proof. unfold counter. rewrite ones_succ. destruct t as [|p], (N.ones (N.of_nat d)) as [|q]; reflexivity. Qed.

(** [TRAIL-6](1) The counter is the trail's complement, bit by bit, below the depth. *)
Theorem counter_bits d t i : (N.of_nat i < N.of_nat d)%N ->
  N.testbit (counter d t) (N.of_nat i) = negb (N.testbit t (N.of_nat i)).
Proof. intros Hi. unfold counter. rewrite N.lxor_spec, N.ones_spec_low by exact Hi. apply xorb_true_r. Qed.

(** [TRAIL-6](1) The complement of the counter is the trail. *)
Theorem counter_involutive d t : counter d (counter d t) = t.
Proof. unfold counter. rewrite N.lxor_assoc, N.lxor_nilpotent. apply N.lxor_0_r. Qed.

(** [TRAIL-6](2) Nothing is left if and only if the counter is all ones. *)
Theorem counter_end d t : t = 0%N <-> counter d t = N.ones (N.of_nat d).
Proof.
  split; [intros ->; reflexivity|]. intros He. rewrite <- (counter_involutive d t), He. unfold counter. apply N.lxor_nilpotent.
Qed.

(** Half of a trail below two to the depth. *)
Lemma below_double d t : (N.double t < 2 ^ N.of_nat (S d) -> t < 2 ^ N.of_nat d)%N.
Proof. rewrite Nat2N.inj_succ, N.pow_succ_r', N.double_spec. lia. Qed.

(** [TRAIL-6](2) As long as something is left, the carry of the increment runs as far as the trail has trailing zeros, and what
    the counter is then differs in the lowest bit only. *)
Theorem counter_carry d : forall t, t <> 0%N -> (t < 2 ^ N.of_nat d)%N ->
  ctz (counter d t + 1) = ctz t /\
  shr (counter d t + 1) (ctz t) = N.lxor (shr (counter d t) (ctz t)) 1.
Proof.
  assert (Z : forall d t, ctz (counter (S d) (N.succ_double t) + 1) = 0 /\
    shr (counter (S d) (N.succ_double t) + 1) 0 = N.lxor (shr (counter (S d) (N.succ_double t)) 0) 1).
  { intros e t. rewrite counter_succ_double, !shr_0. destruct (counter e t); split; reflexivity. }
  induction d as [|d IH]; intros [|[p|p|]] H0 Hd; try congruence; try (simpl in Hd; lia).
  - apply (Z d (Npos p)).
  - destruct (IH (Npos p)) as (IH1 & IH2); [discriminate|apply below_double, Hd|].
    change (N.pos p~0) with (N.double (Npos p)). rewrite counter_double.
    replace (N.succ_double (counter d (Npos p)) + 1)%N with (N.double (counter d (Npos p) + 1))
      by (rewrite N.double_spec, N.succ_double_spec; lia).
    change (ctz (N.double (N.pos p))) with (S (ctz (N.pos p))). split.
    + rewrite <- IH1. destruct (counter d (N.pos p)) as [|q]; [reflexivity|]. simpl. destruct q; reflexivity.
    + rewrite !shr_succ, (proj1 (div2_double _)), (proj2 (div2_double _)). exact IH2.
  - apply (Z d 0%N).
Qed.

(** [TRAIL-6] At the end the carry runs out of the level. *)
Theorem counter_overflow d : (counter d 0 + 1 = 2 ^ N.of_nat d)%N.
Proof. unfold counter. rewrite N.lxor_0_l, N.ones_equiv. assert (2 ^ N.of_nat d <> 0)%N by (apply N.pow_nonzero; lia). lia. Qed.

(** * The swap mask *)

(** [SWAP-2] Equation 1 of J as printed. *)
Definition fcomp (x m : N) : N := (x + m - 2 * N.land x m)%N.

(** [SWAP-1] The swap of the children at one level, as printed. *)
Definition swap_level (n x : N) : N := (x + 2 ^ n - 2 * N.land x (2 ^ n))%N.

(** A sum is the sum without carries, and the carries. *)
Lemma add_carries x m : (x + m = N.lxor x m + 2 * N.land x m)%N.
Proof.
  destruct x as [|x]; [simpl; lia|]. destruct m as [|m]; [simpl; lia|]. simpl N.lxor. simpl N.land.
  revert m. induction x as [x IH|x IH|]; intros [m|m|]; simpl; try lia;
    try (specialize (IH m); destruct (Pos.lxor x m), (Pos.land x m); simpl in *; lia).
Qed.

(** [SWAP-3] The printed composition is one exclusive or. *)
Theorem fcomp_is_xor x m : fcomp x m = N.lxor x m.
Proof. unfold fcomp. rewrite add_carries. lia. Qed.

Lemma lxor_below w x m : (x < 2 ^ w -> m < 2 ^ w -> N.lxor x m < 2 ^ w)%N.
Proof.
  intros Hx Hm. destruct (N.eq_dec (N.lxor x m) 0) as [->|Hn]; [lia|].
  destruct (N.eq_dec x 0) as [->|]; [rewrite N.lxor_0_l; exact Hm|].
  destruct (N.eq_dec m 0) as [->|]; [rewrite N.lxor_0_r; exact Hx|].
  apply N.log2_lt_pow2; [lia|]. eapply N.le_lt_trans; [apply N.log2_lxor|].
  apply N.max_lub_lt; apply N.log2_lt_pow2; lia.
Qed.

(** [SWAP-2, SWAP-3] In arithmetic that wraps at any number of bits too. *)
Theorem fcomp_wrapping w x m : (x < 2 ^ w -> m < 2 ^ w ->
  ((x + m) mod 2 ^ w + 2 ^ w - (2 * N.land x m) mod 2 ^ w) mod 2 ^ w = N.lxor x m)%N.
Proof.
  intros Hx Hm. assert (H0 : (2 ^ w <> 0)%N) by (apply N.pow_nonzero; lia).
  pose proof (lxor_below w x m Hx Hm) as Hl.
  pose proof (add_carries x m) as Hs. set (a := N.lxor x m) in *. set (c := (2 * N.land x m)%N) in *.
  set (M := (2 ^ w)%N) in *. set (s := (x + m)%N) in *.
  pose proof (N.mod_upper_bound c M H0). pose proof (N.div_mod c M H0). pose proof (N.div_mod s M H0).
  rewrite <- (N.mod_add _ (s / M) M H0).
  replace (s mod M + M - c mod M + s / M * M)%N with (a + (c / M + 1) * M)%N
    by (clearbody a c s M; revert H H1 H2 Hs; generalize (s / M)%N (s mod M)%N (c / M)%N (c mod M)%N; intros; nia).
  rewrite N.mod_add by exact H0. apply N.mod_small, Hl.
Qed.

(** [SWAP-1] The swap of one level toggles its bit. *)
Theorem swap_level_is_xor n x : swap_level n x = N.lxor x (2 ^ n).
Proof. apply fcomp_is_xor. Qed.

(** [SWAP-4] The levels of the mask, swapped one after the other in any order, each once, are the printed composition. *)
Theorem swaps_in_any_order m levels : NoDup levels -> (forall n, In n levels <-> N.testbit m n = true) ->
  forall x, fold_left (fun x n => swap_level n x) levels x = fcomp x m.
Proof.
  intros Hnd Hm x. rewrite fcomp_is_xor. revert m Hm x.
  induction Hnd as [|n levels Hn _ IH]; intros m Hm x; simpl.
  - replace m with 0%N; [now rewrite N.lxor_0_r|]. apply N.bits_inj. intros n. rewrite N.bits_0.
    destruct (N.testbit m n) eqn:E; [|reflexivity]. apply Hm in E. destruct E.
  - rewrite (IH (N.lxor m (2 ^ n))%N), swap_level_is_xor.
    + rewrite N.lxor_assoc. f_equal. rewrite N.lxor_comm, N.lxor_assoc, N.lxor_nilpotent. apply N.lxor_0_r.
    + intros i. rewrite N.lxor_spec, N.pow2_bits_eqb. specialize (Hm i). simpl in Hm.
      destruct (N.eqb_spec n i) as [->|Hne].
      * rewrite xorb_true_r. destruct (N.testbit m i); simpl; [split; [tauto|discriminate]|].
        destruct Hm as (Hm & _). specialize (Hm (or_introl eq_refl)). discriminate.
      * rewrite xorb_false_r. intuition congruence.
Qed.
