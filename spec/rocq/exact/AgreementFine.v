(** Twice the digits: what Fine.v and FineSigns.v are about is what Operations.v has, in rounded real numbers. *)
Require Import Reals ZArith Lia Lra Bool List.
From Flocq Require Import Core.
Require Import StacklessExact.Rounding StacklessExact.Range StacklessExact.Arithmetic StacklessExact.Operations.
Require Import StacklessExact.Fine StacklessExact.FineSigns.
Require StacklessExact.Expansion StacklessExact.AgreementSums StacklessExact.Intervals.
Open Scope R_scope.

Notation rounded := (reals R64).
Notation moving := (stepping rounded (Ulp.pred radix2 (FLT_exp (-1074) 53)) (Ulp.succ radix2 (FLT_exp (-1074) 53))).

(** The numbers of one, as they are printed. *)
Definition parts (x : fine) : R * R * R := (high x, low x, radius x).
Lemma whole x : Fine (high x) (low x) (radius x) = x.
Proof. now destruct x. Qed.

Lemma zero_is : constant rounded 0 0 = 0.
Proof. apply Rmult_0_l. Qed.
Lemma power_is e : constant rounded 1 e = bpow radix2 e.
Proof. apply Rmult_1_l. Qed.
Lemma up_is : fine_UP rounded = UP.
Proof.
  unfold fine_UP. rewrite !power_is. cbn [reals plus]. unfold UP. change (bpow radix2 0) with 1. apply round_generic; [typeclasses eauto|].
  replace (1 + bpow radix2 (-48)) with (F2R (Float radix2 (2 ^ 48 + 1) (-48))).
  - apply generic_format_FLT. exists (Float radix2 (2 ^ 48 + 1) (-48)); [reflexivity|simpl; lia|simpl; lia].
  - unfold F2R. cbn [Fnum Fexp]. rewrite plus_IZR, (IZR_Zpower radix2) by lia. rewrite Rmult_plus_distr_r, <- bpow_plus. simpl (48 + -48)%Z. change (bpow radix2 0) with 1. ring.
Qed.

(** [Fine::new]. [NEAR-5] *)
Theorem new_agrees h l r : Fine_new rounded h l r = parts (new h l r).
Proof. unfold Fine_new, new. rewrite up_is. change (sum_two_sum rounded h l) with (Expansion.two_sum h l). now destruct (Expansion.two_sum h l). Qed.

(** [Fine::is_within]. [NEAR-5] *)
Theorem is_within_agrees x most : Fine_is_within rounded (high x) (radius x) most = is_within x most.
Proof. reflexivity. Qed.

(** [Fine::sign]. [NEAR-5] *)
Theorem sign_agrees x : Fine_sign rounded (high x) (low x) (radius x) = sign x.
Proof.
  unfold Fine_sign, sign, is_zero, is_exact. rewrite zero_is, up_is. rewrite (andb_comm (Req_bool (high x) 0)). reflexivity.
Qed.

(** [Fine::bounds]. [NEAR-5] *)
Theorem bounds_agrees x : Fine_bounds moving (high x) (low x) (radius x) = let '((a, b), (c, d)) := bounds x in (a, b, c, d).
Proof.
  unfold Fine_bounds, bounds. assert (E : Interval_add moving (low x) (low x) (opposite moving (radius x)) (radius x) = Intervals.plus (low x, low x) (- radius x, radius x)).
  { unfold Interval_add, Intervals.plus, Intervals.add_below, Intervals.add_above. replace (constant moving 0 0) with 0 by (symmetry; apply Rmult_0_l). reflexivity. }
  rewrite E. destruct (Intervals.plus _ _) as [lo hi]. reflexivity.
Qed.

(** [Fine::add]. [NEAR-5] *)
Theorem add_agrees x y : Fine_add rounded (high x) (low x) (radius x) (high y) (low y) (radius y) = parts (add x y).
Proof.
  unfold Fine_add, add. change (sum_two_sum rounded) with Expansion.two_sum.
  destruct (Expansion.two_sum (high x) (high y)) as [h rest], (Expansion.two_sum (low x) (low y)) as [l least].
  destruct (Expansion.two_sum rest l) as [middle lost]. destruct (Expansion.two_sum h middle) as [h' middle'].
  rewrite new_agrees, zero_is, power_is, up_is. cbv zeta. cbn [reals equal]. unfold parts at 1. cbn [reals plus times absolute]. fold ERROR.
  destruct (andb _ _); reflexivity.
Qed.

(** [Fine::neg]. [NEAR-5] *)
Theorem neg_agrees x : Fine_neg rounded (high x) (low x) (radius x) = parts (neg x).
Proof. reflexivity. Qed.

(** [Fine::sub]. [NEAR-5] *)
Theorem sub_agrees x y : Fine_sub rounded (high x) (low x) (radius x) (high y) (low y) (radius y) = parts (sub x y).
Proof. unfold Fine_sub. rewrite neg_agrees. unfold parts at 1. rewrite add_agrees. reflexivity. Qed.

(** [Fine::mul]. [NEAR-5] *)
Theorem mul_agrees x y : Fine_mul rounded (high x) (low x) (radius x) (high y) (low y) (radius y) = parts (mul x y).
Proof.
  unfold Fine_mul, mul, is_zero, are_doubles, is_exact. rewrite AgreementSums.two_product_agrees, zero_is, !power_is, up_is.
  destruct (Expansion.two_product (high x) (high y)) as [h rest]. cbv zeta. rewrite new_agrees. unfold parts at 1. cbn [reals equal less plus times absolute].
  fold ERROR UNDERFLOW EXACT. destruct (orb _ _); [reflexivity|]. destruct (andb _ _); reflexivity.
Qed.

Lemma add_is a b c d e f : Fine_add rounded a b c d e f = parts (add (Fine a b c) (Fine d e f)).
Proof. exact (add_agrees (Fine a b c) (Fine d e f)). Qed.
Lemma sub_is a b c d e f : Fine_sub rounded a b c d e f = parts (sub (Fine a b c) (Fine d e f)).
Proof. exact (sub_agrees (Fine a b c) (Fine d e f)). Qed.
Lemma mul_is a b c d e f : Fine_mul rounded a b c d e f = parts (mul (Fine a b c) (Fine d e f)).
Proof. exact (mul_agrees (Fine a b c) (Fine d e f)). Qed.
Lemma sign_is a b c : Fine_sign rounded a b c = sign (Fine a b c).
Proof. exact (sign_agrees (Fine a b c)). Qed.

(** [volume]. [EXACT-10] *)
Theorem volume_agrees dx dy dz ax ax' ay ay' az az' bx bx' by_ by' bz bz' :
  fine_volume rounded dx dy dz ax ax' ay ay' az az' bx bx' by_ by' bz bz' =
  volume dx dy dz ((ax, ax'), (ay, ay'), (az, az')) ((bx, bx'), (by_, by'), (bz, bz')).
Proof.
  unfold fine_volume, volume, add_term, of_two, exact. cbn [fst snd]. rewrite zero_is.
  repeat (rewrite ?mul_is, ?sub_is; cbv beta iota zeta delta [parts]; rewrite ?whole). change (equal rounded) with Req_bool.
  destruct (Req_bool dx 0), (Req_bool dy 0), (Req_bool dz 0); cbn [negb];
    repeat (rewrite ?add_is; cbv beta iota zeta delta [parts]; rewrite ?whole); rewrite sign_is, ?whole; reflexivity.
Qed.

(** The sign of an edge function as the code finds it, if it tells one: for all doubles, as far as nothing overflows. [EXACT-2, EXACT-10] *)
Theorem code_edge_is_right dx dy dz ox oy oz fx fy fz tx ty tz s : let F := generic_format radix2 (FLT_exp (-1074) 53) in
  Forall F (dx :: dy :: dz :: nil) -> Forall F (ox :: oy :: oz :: nil) -> Forall F (fx :: fy :: fz :: nil) -> Forall F (tx :: ty :: tz :: nil) ->
  let '(px, px', py, py', pz, pz') := predicates_minus rounded tx ty tz fx fy fz in
  let '(qx, qx', qy, qy', qz, qz') := predicates_minus rounded fx fy fz ox oy oz in
  let truth := dx * ((ty - oy) * (fz - oz) - (tz - oz) * (fy - oy)) + dy * ((tz - oz) * (fx - ox) - (tx - ox) * (fz - oz)) +
    dz * ((tx - ox) * (fy - oy) - (ty - oy) * (fx - ox)) in
  fine_volume rounded dx dy dz px px' py py' pz pz' qx qx' qy qy' qz qz' = Some s -> (0 < truth <-> 0 < s) /\ (truth < 0 <-> s < 0) /\ (truth = 0 <-> s = 0).
Proof.
  intros F D O A B. pose proof (edge_is_right dx dy dz ox oy oz fx fy fz tx ty tz s D O A B) as H. unfold edge in H.
  unfold predicates_minus. change (sum_two_sum rounded) with Expansion.two_sum. cbn [reals opposite]. unfold Expansion.difference in H.
  destruct (Expansion.two_sum tx (- fx)), (Expansion.two_sum ty (- fy)), (Expansion.two_sum tz (- fz)), (Expansion.two_sum fx (- ox)), (Expansion.two_sum fy (- oy)), (Expansion.two_sum fz (- oz)).
  rewrite volume_agrees. exact H.
Qed.
