(** The combined index of J, Section 2.2, in one integer without bound: [index = levelStart + levelIndex] in Algorithm 2, and
    [index = levelStart + levelIndexdynamic], which is the key, in Algorithm 3. *)

Require Import Arith List PArith NArith Lia Bool.
Require Import Tree Machine Bits Implicit.
Import ListNotations.

Definition combined_index (k : positive) (t : N) : N := (level_start k + level_index k t)%N.

Lemma level_index_range k t : fits k t -> (level_index k t < level_start k)%N.
Proof.
  intros Hf%fits_range. apply lxor_below; [exact Hf|]. rewrite N.ones_equiv.
  assert (2 ^ N.of_nat (depth k) <> 0)%N by (apply N.pow_nonzero; lia). lia.
Qed.

Lemma high_sum k x : (x < level_start k -> level_start k + x = N.lxor (level_start k) x)%N.
Proof. intros Hx. apply N.add_nocarry_lxor, high_bit_apart, Hx. Qed.

Lemma level_start_ones k : N.lxor (level_start k) (N.ones (N.of_nat (depth k))) = N.ones (N.of_nat (S (depth k))).
Proof.
  rewrite <- high_sum; unfold level_start; rewrite !N.ones_equiv, ?Nat2N.inj_succ, ?N.pow_succ_r';
    assert (2 ^ N.of_nat (depth k) <> 0)%N by (apply N.pow_nonzero; lia); lia.
Qed.

(** The combined index is the complement of the trail one level further up than the key is deep. *)
Lemma combined_is_counter k t : fits k t -> combined_index k t = counter (S (depth k)) t.
Proof.
  intros Hf. unfold combined_index. rewrite high_sum by apply level_index_range, Hf.
  unfold level_index, counter. rewrite <- level_start_ones, <- !N.lxor_assoc. f_equal. apply N.lxor_comm.
Qed.

(** As long as something is left, all that is done to the index is unaffected by its high bit. *)
Lemma combined_moves k t k' t' : fits k t -> trail_backtrack (k, t) = Some (k', t') ->
  let n := ctz (combined_index k t + 1) in
  n = ctz (level_index k t + 1) /\ shr (combined_index k t + 1) n = combined_index k' t'.
Proof.
  intros Hf Hb. destruct (carry_moves k t k' t' Hf Hb) as (Hn & Hf' & _ & Hs & _ & Hx & _). cbv zeta.
  destruct (backtrack_some _ _ _ _ Hb) as (H0 & _). pose proof (ctz_fits k t Hf H0) as Hd.
  destruct (counter_carry (S (depth k)) t H0) as (H1 & H2).
  { apply fits_range in Hf. rewrite Nat2N.inj_succ, N.pow_succ_r'. lia. }
  rewrite combined_is_counter, H1, H2, Hn by exact Hf. split; [reflexivity|]. rewrite Hn in Hs, Hx.
  unfold combined_index. rewrite high_sum by apply level_index_range, Hf'.
  rewrite <- combined_is_counter by exact Hf. unfold combined_index. rewrite high_sum by apply level_index_range, Hf.
  rewrite shr_lxor, Hs, N.lxor_assoc, <- Hx. reflexivity.
Qed.

(** [IMPLICIT-3] At the end the carry takes the high bit with it: one trailing zero more than without it (spec/DEPARTURES.md,
    D-11), and the shift comes to 1 as it does without it. *)
Lemma combined_ends k t : fits k t -> trail_backtrack (k, t) = None ->
  ctz (combined_index k t + 1) = S (ctz (level_index k t + 1)) /\
  shr (combined_index k t + 1) (ctz (combined_index k t + 1)) = 1%N.
Proof.
  intros Hf Hb. destruct (carry_ends k t Hb) as (H1 & _). rewrite combined_is_counter, H1 by exact Hf.
  apply backtrack_none in Hb as ->.
  rewrite counter_overflow, ctz_pow, shr_pow, Nat.sub_diag by lia. auto.
Qed.

(** * Algorithm 2 with the combined index *)

Definition implicit_a1_descend (d : descent) (s : N * N) : N * N :=
  let '(index, mask) := s in
  let index := N.double index in
  let mask := N.double mask in
  let mask := if right_first d then N.lor mask 1 else mask in
  if rejected_one d then (index + 1, N.lxor mask 1)%N else (index, mask).

Definition implicit_a1_backtrack (s : N * N) : option (N * N) :=
  let '(index, mask) := s in
  let index := (index + 1)%N in
  let up := ctz index in
  let index := shr index up in
  let mask := shr mask up in
  if (index <=? 1)%N then None else Some (index, mask).

Definition implicit_a1 : cursor := {|
  state := N * N;
  start := (1, 0)%N;
  key_of '(index, mask) := Some (N.succ_pos (index - 1 + mask - 2 * N.land index mask));
  descend := implicit_a1_descend;
  backtrack := implicit_a1_backtrack |}.

Lemma swap_mask_range k t : fits k t -> (swap_mask k t < level_start k)%N.
Proof. intros Hf. apply lxor_below; [apply path_range|apply level_index_range, Hf]. Qed.

Lemma implicit_a1_simulates T : simulates T trail_machine implicit_a1 any_descent
  (fun a b => let '(k, t) := a in fits k t /\ b = (combined_index k t, swap_mask k t)).
Proof.
  split.
  - repeat split.
  - intros [k t] b (Hf & ->). cbv [key_of implicit_a1 trail_machine fst]. f_equal. apply number_key.
    pose proof (fcomp_is_xor (combined_index k t) (swap_mask k t)) as H. unfold fcomp in H.
    assert (E : N.lxor (combined_index k t) (swap_mask k t) = Npos k).
    { unfold combined_index. rewrite high_sum by apply level_index_range, Hf.
      rewrite N.lxor_assoc, swap_mask_leads. apply key_is_xor. }
    rewrite E in H. pose proof (add_carries (combined_index k t) (swap_mask k t)) as H1. rewrite E in H1.
    assert (1 <= combined_index k t)%N.
    { unfold combined_index. pose proof (path_range k). lia. }
    lia.
  - intros [k t] b d k0 l r (Hf & ->) _ _ Hd _.
    destruct (level_index_child d k t Hd) as (k' & t' & He & _ & Hf' & Hs & Hi & Hp).
    cbv [descend trail_machine]. rewrite He. split; [auto|].
    unfold swap_mask, combined_index in *. rewrite Hs, Hi, Hp, <- swap_mask_step. cbv [implicit_a1 implicit_a1_descend].
    rewrite !N.double_spec. destruct (rejected_one d); simpl bit; f_equal; lia.
  - intros [k t] b (Hf & ->) Hb. cbv [backtrack implicit_a1 implicit_a1_backtrack].
    destruct (combined_ends k t Hf Hb) as (_ & H). rewrite H. reflexivity.
  - intros [k t] b [k' t'] (Hf & ->) Hb. cbv [backtrack implicit_a1 implicit_a1_backtrack].
    destruct (combined_moves k t k' t' Hf Hb) as (H1 & H2). rewrite H2.
    destruct (carry_moves k t k' t' Hf Hb) as (_ & Hf' & Hs & _ & _ & Hx & Hp).
    destruct (N.leb_spec (combined_index k' t') 1) as [Hle|_]; [unfold combined_index in Hle; lia|].
    eexists. repeat split; [exact Hf'|]. f_equal. rewrite H1. unfold swap_mask. rewrite shr_lxor, Hp, Hx.
    rewrite (N.lxor_comm (shr (level_index k t) _)), N.lxor_assoc, <- (N.lxor_assoc 1 1). reflexivity.
Qed.

(** [IMPLICIT-3] Algorithm 2 with the combined index has the visits and the answer of the reference, and ends. *)
Theorem implicit_a1_reference T decide stop fuel : size T <= fuel ->
  run implicit_a1 T decide stop fuel (start implicit_a1) [] = Some (reference decide stop T).
Proof.
  apply (refines_reference _ _ _ _ _ _ (simulates_refines _ _ _ _ _ _ (trail_refines T) (implicit_a1_simulates T))).
  apply any_decision.
Qed.

(** * Algorithm 3 with the combined index *)

Definition implicit_b1_descend (d : descent) (s : N * N) : N * N :=
  let '(counter, index) := s in
  let counter := N.double counter in
  let index := N.double index in
  let index := if right_first d then (index + 1)%N else index in
  if rejected_one d then (counter + 1, index)%N else (counter, index).

Definition implicit_b1_backtrack (s : N * N) : option (N * N) :=
  let '(counter, index) := s in
  let counter := (counter + 1)%N in
  let up := ctz counter in
  let counter := shr counter up in
  let index := shr index up in
  let index := (index + 1 - 2 * N.land index 1)%N in
  if (index <=? 1)%N then None else Some (counter, index).

(** [levelIndex], and the combined index, which is the key. *)
Definition implicit_b1 : cursor := {|
  state := N * N;
  start := (0, 1)%N;
  key_of '(_, index) := match index with N0 => None | Npos k => Some k end;
  descend := implicit_b1_descend;
  backtrack := implicit_b1_backtrack |}.

Lemma double_key k : N.double (Npos k) = Npos (xO k).
Proof. reflexivity. Qed.

Lemma implicit_b1_simulates T : simulates T trail_machine implicit_b1 any_descent
  (fun a b => let '(k, t) := a in fits k t /\ b = (level_index k t, Npos k)).
Proof.
  split.
  - repeat split.
  - intros [k t] b (_ & ->). reflexivity.
  - intros [k t] b d k0 l r (Hf & ->) _ _ Hd _.
    destruct (level_index_child d k t Hd) as (k' & t' & He & _ & Hf' & Hs & Hi & Hp).
    cbv [descend trail_machine]. rewrite He. split; [auto|].
    rewrite <- (key_is_sum k'), <- (key_is_sum k), Hs, Hi, Hp. cbv [implicit_b1 implicit_b1_descend].
    rewrite !N.double_spec. destruct (rejected_one d), (right_first d); simpl bit; f_equal; lia.
  - intros [k t] b (_ & ->) Hb. cbv [backtrack implicit_b1 implicit_b1_backtrack].
    destruct (carry_ends k t Hb) as (H1 & H2). rewrite H1.
    assert (E : shr (Npos k) (depth k) = 1%N)
      by (rewrite <- key_is_xor, shr_lxor, H2, shr_path, up_root by lia; reflexivity).
    rewrite E. reflexivity.
  - intros [k t] b [k' t'] (Hf & ->) Hb. cbv [backtrack implicit_b1 implicit_b1_backtrack].
    destruct (carry_moves k t k' t' Hf Hb) as (_ & Hf' & Hs & Hs' & Hc & Hx & Hp).
    set (n := ctz (level_index k t + 1)) in *.
    assert (E : (shr (Npos k) n + 1 - 2 * N.land (shr (Npos k) n) 1)%N = Npos k').
    { rewrite <- (key_is_xor k'), Hp, <- Hs', <- (key_is_xor k), shr_lxor, <- N.lxor_assoc. apply fcomp_is_xor. }
    rewrite Hc, E. destruct (N.leb_spec (Npos k') 1) as [Hle|_]; [rewrite <- (key_is_sum k') in Hle; lia|].
    eexists. repeat split. exact Hf'.
Qed.

(** [IMPLICIT-3] Algorithm 3 with the combined index has the visits and the answer of the reference, and ends. *)
Theorem implicit_b1_reference T decide stop fuel : size T <= fuel ->
  run implicit_b1 T decide stop fuel (start implicit_b1) [] = Some (reference decide stop T).
Proof.
  apply (refines_reference _ _ _ _ _ _ (simulates_refines _ _ _ _ _ _ (trail_refines T) (implicit_b1_simulates T))).
  apply any_decision.
Qed.
