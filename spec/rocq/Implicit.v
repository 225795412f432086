(** The traversals of implicit trees: Algorithms 1, 2 and 3 of J (Barringer & Akenine-Moeller 2013) as printed, and the
    combined index of its Section 2.2, on integers without bound.

    J numbers nodes from 0 in order of levels: the number of a node is its key minus 1. Each algorithm moves as the machine of
    key and trail does ([simulates]): its integers are functions of key and trail. *)

Require Import Arith List PArith NArith Lia Bool.
Require Import Tree Machine Bits.
Import ListNotations.

(** * Key and trail as J's integers *)

(** [KEY-6] The first key of the level. *)
Definition level_start (k : positive) : N := (2 ^ N.of_nat (depth k))%N.

(** The key without its leading one: the index within the level. *)
Fixpoint path (k : positive) : N :=
  match k with xH => 0%N | xO k => N.double (path k) | xI k => N.succ_double (path k) end.

(** [levelIndex] of a node that is reached with trail [t]. *)
Definition level_index (k : positive) (t : N) : N := counter (depth k) t.

Lemma key_is_sum k : (level_start k + path k)%N = Npos k.
Proof.
  unfold level_start. induction k as [k IH|k IH|]; [| |reflexivity].
  all: simpl depth; simpl path; rewrite Nat2N.inj_succ, N.pow_succ_r', ?N.succ_double_spec, ?N.double_spec; lia.
Qed.

Lemma path_range k : (path k < level_start k)%N.
Proof.
  pose proof (key_range k) as H. rewrite <- (key_is_sum k) in H. rewrite Nat2N.inj_succ, N.pow_succ_r' in H.
  unfold level_start in *. lia.
Qed.

(** Two to the power [d] has no bit in common with what is below it. *)
Lemma high_bit_clear d x : (x < 2 ^ d)%N -> N.testbit x d = false.
Proof.
  intros Hx. destruct (N.eq_dec x 0) as [->|H0]; [apply N.bits_0|].
  apply N.bits_above_log2, N.log2_lt_pow2; lia.
Qed.

Lemma high_bit_apart d x : (x < 2 ^ d -> N.land (2 ^ d) x = 0)%N.
Proof.
  intros Hx. apply N.bits_inj. intros i. rewrite N.land_spec, N.pow2_bits_eqb, N.bits_0.
  destruct (N.eqb_spec d i) as [<-|]; [apply high_bit_clear, Hx|reflexivity].
Qed.

(** So the sum is also the exclusive or, and the library's [levelStart | path]. *)
Lemma key_is_xor k : N.lxor (level_start k) (path k) = Npos k.
Proof. rewrite <- (key_is_sum k). symmetry. apply N.add_nocarry_lxor, high_bit_apart, path_range. Qed.

Lemma key_is_or k : N.lor (level_start k) (path k) = Npos k.
Proof.
  rewrite <- key_is_xor. apply N.bits_inj. intros i. rewrite N.lor_spec, N.lxor_spec.
  assert (H : N.testbit (N.land (level_start k) (path k)) i = false)
    by (unfold level_start; rewrite high_bit_apart by apply path_range; apply N.bits_0).
  rewrite N.land_spec in H. destruct (N.testbit (level_start k) i), (N.testbit (path k) i); simpl in *; congruence.
Qed.

Lemma path_child sd k : path (child sd k) = match sd with L => N.double (path k) | R => N.succ_double (path k) end.
Proof. destruct sd; reflexivity. Qed.

Lemma level_start_child sd k : level_start (child sd k) = N.double (level_start k).
Proof. unfold level_start. rewrite depth_child, Nat2N.inj_succ, N.pow_succ_r'. symmetry. apply N.double_spec. Qed.

(** * Moving up *)

Lemma shr_pow n : forall d, n <= d -> shr (2 ^ N.of_nat d) n = (2 ^ N.of_nat (d - n))%N.
Proof.
  induction n as [|n IH]; intros d Hn; [rewrite Nat.sub_0_r; apply shr_0|]. destruct d as [|d]; [lia|]. rewrite shr_succ.
  rewrite Nat2N.inj_succ, N.pow_succ_r', <- N.double_spec, (proj1 (div2_double _)). apply IH. lia.
Qed.

Lemma shr_lxor x y n : shr (N.lxor x y) n = N.lxor (shr x n) (shr y n).
Proof. apply N.shiftr_lxor. Qed.

Lemma shr_ones n : forall d, n <= d -> shr (N.ones (N.of_nat d)) n = N.ones (N.of_nat (d - n)).
Proof.
  induction n as [|n IH]; intros d Hn; [rewrite Nat.sub_0_r; apply shr_0|]. destruct d as [|d]; [lia|]. rewrite shr_succ.
  rewrite ones_succ, (proj2 (div2_double _)). apply IH. lia.
Qed.

Lemma shr_path n : forall k, n <= depth k -> shr (path k) n = path (up n k).
Proof.
  induction n as [|n IH]; intros k Hn; [apply shr_0|]. rewrite shr_succ.
  destruct k; simpl in *; [rewrite (proj2 (div2_double _))|rewrite (proj1 (div2_double _))|lia]; apply IH; lia.
Qed.

Lemma path_sibling k : 0 < depth k -> path (sibling k) = N.lxor (path k) 1.
Proof. destruct k; simpl; [| |lia]; intros _; destruct (path k); reflexivity. Qed.

Lemma ctz_double x : x <> 0%N -> ctz (N.double x) = S (ctz x).
Proof. destruct x; [contradiction|reflexivity]. Qed.

Lemma ctz_pow d : ctz (2 ^ N.of_nat d) = d.
Proof.
  induction d as [|d IH]; [reflexivity|]. rewrite Nat2N.inj_succ, N.pow_succ_r', <- N.double_spec, ctz_double, IH;
    [reflexivity|].
  apply N.pow_nonzero. lia.
Qed.

(** What the machine of key and trail does at a backtrack, in J's integers: all shift by the zeros of the incremented index. *)
Lemma carry_moves k t k' t' : fits k t -> trail_backtrack (k, t) = Some (k', t') ->
  let n := ctz (level_index k t + 1) in
  n = ctz t /\ fits k' t' /\
  (1 < level_start k')%N /\ shr (level_start k) n = level_start k' /\
  shr (level_index k t + 1) n = level_index k' t' /\ level_index k' t' = N.lxor (shr (level_index k t) n) 1 /\
  path k' = N.lxor (shr (path k) n) 1.
Proof.
  intros Hf Hb. destruct (backtrack_some _ _ _ _ Hb) as (H0 & Ek & Et).
  destruct (counter_carry (depth k) t H0) as (H1 & H2); [apply fits_range, Hf|].
  pose proof (ctz_fits k t Hf H0) as Hn. pose proof (trail_pops k t Hf) as Hp. rewrite Hb in Hp.
  destruct (pending k t) as [|q p]; [discriminate|]. destruct Hp as (t1 & [= <- <-] & Hf' & _).
  subst k' t'. unfold level_index, level_start. cbv zeta. rewrite H1.
  rewrite depth_sibling, depth_up, path_sibling, shr_path, shr_pow, H2 by (rewrite ?depth_up; lia).
  repeat split; try exact Hf'.
  - change 1%N with (2 ^ 0)%N. apply N.pow_lt_mono_r; lia.
  - unfold counter. rewrite shr_lxor, shr_ones by lia.
    rewrite !N.lxor_assoc. f_equal. apply N.lxor_comm.
  - unfold counter. rewrite shr_lxor, shr_ones by lia.
    rewrite !N.lxor_assoc. f_equal. apply N.lxor_comm.
Qed.

(** At the end the increment carries out of the level, and all shifts reach the root. *)
Lemma carry_ends k t : trail_backtrack (k, t) = None ->
  ctz (level_index k t + 1) = depth k /\ shr (level_start k) (depth k) = 1%N.
Proof.
  intros ->%backtrack_none. unfold level_index, level_start.
  rewrite counter_overflow, ctz_pow, shr_pow, Nat.sub_diag by lia. auto.
Qed.

(** * Algorithm 1 *)

Definition left_first_backtrack (s : N * N) : option (N * N) :=
  let '(start, index) := s in
  let index := (index + 1)%N in
  let up := ctz index in
  let start := shr start up in
  let index := shr index up in
  if (start <=? 1)%N then None else Some (start, index).

(** [levelStart] and [levelIndex]. *)
Definition left_first : cursor := {|
  state := N * N;
  start := (1, 0)%N;
  key_of '(start, index) := Some (N.succ_pos (start + index - 1));
  descend _ '(start, index) := (N.double start, N.double index);
  backtrack := left_first_backtrack |}.

(** The number of a node gives its key. *)
Lemma number_key k n : (n + 1)%N = Npos k -> N.succ_pos n = k.
Proof. intros H. rewrite N.add_1_r in H. rewrite <- N.succ_pos_spec in H. congruence. Qed.

Lemma left_first_simulates T : simulates T trail_machine left_first (fun _ d => d = Both L)
  (fun a b => fits (fst a) (snd a) /\ b = (level_start (fst a), path (fst a)) /\ path (fst a) = level_index (fst a) (snd a)).
Proof.
  split.
  - repeat split.
  - intros [k t] b (_ & -> & _). simpl. f_equal. apply number_key. rewrite <- (key_is_sum k).
    pose proof (path_range k). lia.
  - intros [k t] b d k0 l r (Hf & -> & Hi) _ _ _ ->. simpl in *. rewrite (proj2 (div2_double t)).
    rewrite (level_start_child L). unfold level_index in *. simpl depth. rewrite counter_succ_double, Hi. auto.
  - intros [k t] b (_ & -> & Hi) Hb. simpl in *. rewrite Hi. destruct (carry_ends k t Hb) as (H1 & H2).
    rewrite H1, H2. reflexivity.
  - intros [k t] b [k' t'] (Hf & -> & Hi) Hb. simpl in *.
    destruct (carry_moves k t k' t' Hf Hb) as (_ & Hf' & Hs & Hs' & Hc & Hx & Hp).
    rewrite Hi, Hs', Hc. destruct (N.leb_spec (level_start k') 1); [lia|].
    rewrite Hp, Hi, <- Hx. eexists. repeat split; auto.
Qed.

(** The reference of Algorithm 1: an inner node is tested at its visit, the left child comes first. *)
Fixpoint visit_left (accept stop : history -> bool) (t : tree) (k : positive) (h : history) : bool * history :=
  let h := k :: h in
  match t with
  | Leaf => (stop h, h)
  | Node l r =>
      if accept h then
        let '(stopped, h) := visit_left accept stop l (xO k) h in
        if stopped then (true, h) else visit_left accept stop r (xI k) h
      else (false, h)
  end.

(** The decisions of a test of nodes. *)
Definition node_test (accept : history -> bool) (h : history) : descent := if accept h then Both L else Neither.

(** It is the reference under these decisions. *)
Lemma visit_left_is_visit accept stop t : forall k h, visit_left accept stop t k h = visit (node_test accept) stop t k h.
Proof.
  induction t as [|l IHl r IHr]; intros k h; [reflexivity|]. simpl. unfold node_test at 1.
  destruct (accept (k :: h)); [|reflexivity]. simpl. rewrite IHl.
  destruct (visit (node_test accept) stop l k~0 (k :: h)) as [[|] h1]; [reflexivity|apply IHr].
Qed.

(** [LEFT-1] Algorithm 1 as printed does what a left-first search with tests of nodes does, and ends. *)
Theorem left_first_reference T accept stop fuel : size T <= fuel ->
  run left_first T (node_test accept) stop fuel (start left_first) [] = Some (visit_left accept stop T xH []).
Proof.
  rewrite visit_left_is_visit. apply (refines_reference _ _ _ _ _ _
    (simulates_refines _ _ _ _ _ _ (trail_refines T) (left_first_simulates T))).
  intros k h. unfold node_test. destruct (accept (k :: h)); auto.
Qed.

(** * Algorithm 2 *)

Definition bit (b : bool) : N := if b then 1%N else 0%N.

(** "Right child first": of the children that are wanted, the right one is the first (spec/DEPARTURES.md, D-10). *)
Definition right_first (d : descent) : bool := match d with Only R | Both R => true | _ => false end.

Definition rejected_one (d : descent) : bool := match d with Only _ => true | _ => false end.

Definition implicit_a_descend (d : descent) (s : N * N * N) : N * N * N :=
  let '(start, index, mask) := s in
  let start := N.double start in
  let index := N.double index in
  let mask := N.double mask in
  let mask := if right_first d then N.lor mask 1 else mask in
  if rejected_one d then (start, index + 1, N.lxor mask 1)%N else (start, index, mask).

Definition implicit_a_backtrack (s : N * N * N) : option (N * N * N) :=
  let '(start, index, mask) := s in
  let index := (index + 1)%N in
  let up := ctz index in
  let start := shr start up in
  let index := shr index up in
  let mask := shr mask up in
  if (start <=? 1)%N then None else Some (start, index, mask).

(** [levelStart], [levelIndex] and [swapMask]. *)
Definition implicit_a : cursor := {|
  state := N * N * N;
  start := (1, 0, 0)%N;
  key_of '(start, index, mask) := Some (N.succ_pos (start + index - 1 + mask - 2 * N.land index mask));
  descend := implicit_a_descend;
  backtrack := implicit_a_backtrack |}.

(** The mask that leads from the index to the path. *)
Definition swap_mask (k : positive) (t : N) : N := N.lxor (path k) (level_index k t).

Lemma swap_mask_leads k t : N.lxor (level_index k t) (swap_mask k t) = path k.
Proof. unfold swap_mask. rewrite N.lxor_comm, N.lxor_assoc, N.lxor_nilpotent. apply N.lxor_0_r. Qed.

(** Index, mask and path of a child, by what the descent says. *)
Lemma level_index_child d k t : d <> Neither ->
  exists k' t', trail_descend d (k, t) = (k', t') /\ (exists sd, k' = child sd k) /\ (fits k t -> fits k' t') /\
  level_start k' = N.double (level_start k) /\
  level_index k' t' = (N.double (level_index k t) + bit (rejected_one d))%N /\
  path k' = (N.double (path k) + bit (right_first d))%N.
Proof.
  intros Hd. destruct d as [|sd|sd]; [contradiction| |]; do 2 eexists; (split; [reflexivity|]).
  all: rewrite level_start_child, path_child; unfold level_index; rewrite depth_child;
    rewrite ?counter_double, ?counter_succ_double.
  all: (split; [exists sd; reflexivity|]); (split; [apply fits_child|]).
  all: rewrite ?N.succ_double_spec; destruct sd; simpl bit; rewrite ?N.succ_double_spec, ?N.double_spec; repeat split; lia.
Qed.

(** The printed update of the mask. *)
Lemma swap_mask_step d p c : (
  (let mask := N.double (N.lxor p c) in
   let mask := if right_first d then N.lor mask 1 else mask in
   if rejected_one d then N.lxor mask 1 else mask) =
  N.lxor (N.double p + bit (right_first d)) (N.double c + bit (rejected_one d)))%N.
Proof.
  assert (E : forall x b, (N.double x + bit b)%N = if b then N.succ_double x else N.double x).
  { intros x []; simpl bit; rewrite ?N.succ_double_spec, ?N.double_spec; lia. }
  rewrite !E. destruct d as [|[|]|[|]]; simpl; destruct p as [|p], c as [|c]; try reflexivity; simpl;
    destruct (Pos.lxor p c); reflexivity.
Qed.

Lemma implicit_a_simulates T : simulates T trail_machine implicit_a any_descent
  (fun a b => let '(k, t) := a in fits k t /\ b = (level_start k, level_index k t, swap_mask k t)).
Proof.
  split.
  - repeat split.
  - intros [k t] b (_ & ->). cbv [key_of implicit_a trail_machine fst]. f_equal. apply number_key. rewrite <- (key_is_sum k).
    pose proof (fcomp_is_xor (level_index k t) (swap_mask k t)) as H. rewrite swap_mask_leads in H. unfold fcomp in H.
    pose proof (add_carries (level_index k t) (swap_mask k t)). pose proof (path_range k). lia.
  - intros [k t] b d k0 l r (Hf & ->) _ _ Hd _.
    destruct (level_index_child d k t Hd) as (k' & t' & He & _ & Hf' & Hs & Hi & Hp).
    cbv [descend trail_machine]. rewrite He. split; [auto|]. unfold swap_mask in *.
    rewrite Hs, Hi, Hp, <- swap_mask_step. simpl.
    destruct (rejected_one d); simpl bit; rewrite ?N.add_0_r; reflexivity.
  - intros [k t] b (_ & ->) Hb. simpl in *. destruct (carry_ends k t Hb) as (H1 & H2).
    rewrite H1, H2. reflexivity.
  - intros [k t] b [k' t'] (Hf & ->) Hb. simpl in *.
    destruct (carry_moves k t k' t' Hf Hb) as (_ & Hf' & Hs & Hs' & Hc & Hx & Hp).
    rewrite Hs', Hc. destruct (N.leb_spec (level_start k') 1); [lia|].
    eexists. repeat split; [exact Hf'|]. f_equal. unfold swap_mask. rewrite shr_lxor, Hp, Hx.
    rewrite (N.lxor_comm (shr (level_index k t) _)), N.lxor_assoc, <- (N.lxor_assoc 1 1). reflexivity.
Qed.

(** [IMPLICIT-1] Algorithm 2 as printed, with its mask, has the visits and the answer of the reference, and ends. *)
Theorem implicit_a_reference T decide stop fuel : size T <= fuel ->
  run implicit_a T decide stop fuel (start implicit_a) [] = Some (reference decide stop T).
Proof.
  apply (refines_reference _ _ _ _ _ _ (simulates_refines _ _ _ _ _ _ (trail_refines T) (implicit_a_simulates T))).
  apply any_decision.
Qed.

(** * Algorithm 3 *)

Definition implicit_b_descend (d : descent) (s : N * N * N) : N * N * N :=
  let '(start, index, dynamic) := s in
  let start := N.double start in
  let index := N.double index in
  let dynamic := N.double dynamic in
  let dynamic := if right_first d then (dynamic + 1)%N else dynamic in
  if rejected_one d then (start, index + 1, dynamic)%N else (start, index, dynamic).

Definition implicit_b_backtrack (s : N * N * N) : option (N * N * N) :=
  let '(start, index, dynamic) := s in
  let index := (index + 1)%N in
  let up := ctz index in
  let start := shr start up in
  let index := shr index up in
  let dynamic := shr dynamic up in
  let dynamic := (dynamic + 1 - 2 * N.land dynamic 1)%N in
  if (start <=? 1)%N then None else Some (start, index, dynamic).

(** [levelStart], [levelIndex] and [levelIndexdynamic]. *)
Definition implicit_b : cursor := {|
  state := N * N * N;
  start := (1, 0, 0)%N;
  key_of '(start, index, dynamic) := Some (N.succ_pos (start + dynamic - 1));
  descend := implicit_b_descend;
  backtrack := implicit_b_backtrack |}.

Lemma implicit_b_simulates T : simulates T trail_machine implicit_b any_descent
  (fun a b => let '(k, t) := a in fits k t /\ b = (level_start k, level_index k t, path k)).
Proof.
  split.
  - repeat split.
  - intros [k t] b (_ & ->). simpl. f_equal. apply number_key. rewrite <- (key_is_sum k). pose proof (path_range k). lia.
  - intros [k t] b d k0 l r (Hf & ->) _ _ Hd _.
    destruct (level_index_child d k t Hd) as (k' & t' & He & _ & Hf' & Hs & Hi & Hp).
    cbv [descend trail_machine]. rewrite He. split; [auto|]. rewrite Hs, Hi, Hp. cbv [implicit_b implicit_b_descend].
    destruct (rejected_one d), (right_first d); simpl bit; rewrite ?N.add_0_r; reflexivity.
  - intros [k t] b (_ & ->) Hb. simpl in *. destruct (carry_ends k t Hb) as (H1 & H2).
    rewrite H1, H2. reflexivity.
  - intros [k t] b [k' t'] (Hf & ->) Hb. simpl in *.
    destruct (carry_moves k t k' t' Hf Hb) as (_ & Hf' & Hs & Hs' & Hc & Hx & Hp).
    rewrite Hs', Hc. destruct (N.leb_spec (level_start k') 1); [lia|].
    eexists. repeat split; [exact Hf'|]. f_equal. rewrite Hp. apply fcomp_is_xor.
Qed.

(** [IMPLICIT-2] Algorithm 3 as printed has the visits and the answer of the reference, and ends. *)
Theorem implicit_b_reference T decide stop fuel : size T <= fuel ->
  run implicit_b T decide stop fuel (start implicit_b) [] = Some (reference decide stop T).
Proof.
  apply (refines_reference _ _ _ _ _ _ (simulates_refines _ _ _ _ _ _ (trail_refines T) (implicit_b_simulates T))).
  apply any_decision.
Qed.
