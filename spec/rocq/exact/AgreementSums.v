(** The exact sums: what Expansion.v is about is what Operations.v has, with real numbers that are rounded to double precision. *)
Require Import Reals ZArith Lia Lra Bool List.
From Flocq Require Import Core.
Require Import StacklessExact.Rounding StacklessExact.Range StacklessExact.Arithmetic StacklessExact.Operations.
Require StacklessExact.Expansion StacklessExact.Signs.
Open Scope R_scope.

Notation rounded := (reals R64).

(** [two_sum]. [EXACT-8] *)
Theorem two_sum_agrees a b : sum_two_sum rounded a b = Expansion.two_sum a b.
Proof. reflexivity. Qed.

(** [split]. [EXACT-8] *)
Theorem split_agrees a : sum_split rounded a = Expansion.split a.
Proof.
  unfold sum_split, Expansion.split. cbn [reals constant times minus].
  replace (IZR 134217729 * bpow radix2 0) with 134217729 by (simpl; ring). reflexivity.
Qed.

(** [two_product]. [EXACT-8] *)
Theorem two_product_agrees a b : sum_two_product rounded a b = Expansion.two_product a b.
Proof. unfold sum_two_product. rewrite !split_agrees. reflexivity. Qed.

(** [minus]: the [difference] of each component. [EXACT-8] *)
Theorem minus_agrees ax ay az bx by_ bz :
  let '(x, x', y, y', z, z') := predicates_minus rounded ax ay az bx by_ bz in
  ((x, x'), (y, y'), (z, z')) = (Expansion.difference ax bx, Expansion.difference ay by_, Expansion.difference az bz).
Proof. reflexivity. Qed.

(** A comparison with 0, and the decision of Expansion.v. *)
Lemma is_zero (T : Type) (x : R) (yes no : T) : (if equal rounded x (constant rounded 0 0) then yes else no) = if Req_EM_T x 0 then yes else no.
Proof.
  cbn [reals equal constant]. replace (IZR 0 * bpow radix2 0) with 0 by ring.
  destruct (Req_bool_spec x 0), (Req_EM_T x 0); try reflexivity; contradiction.
Qed.

Lemma is_not_zero (T : Type) (x : R) (yes no : T) :
  (if negb (equal rounded x (constant rounded 0 0)) then yes else no) = if Req_EM_T x 0 then no else yes.
Proof. rewrite <- is_zero. now destruct (equal _ _ _). Qed.

(** [Sum::add_product], with [Sum::add] as Expansion.v has it. [EXACT-8] *)
Theorem add_product_agrees terms a a' b b' c :
  Sum_add_product rounded (list R) (fun terms x => Expansion.add x terms) terms a a' b b' c = Expansion.add_product (a, a') (b, b') c terms.
Proof.
  unfold Sum_add_product, Expansion.add_product, Expansion.add_two, Expansion.add_part. cbn [fold_left fst snd].
  rewrite !two_product_agrees.
  repeat (rewrite ?two_product_agrees; match goal with |- context [Expansion.two_product ?x ?y] => destruct (Expansion.two_product x y) end).
  cbv zeta. rewrite !is_not_zero, is_zero.
  repeat match goal with |- context [Req_EM_T ?x 0] => destruct (Req_EM_T x 0) end; reflexivity.
Qed.

(** [add_edge]. [EXACT-8] *)
Theorem add_edge_agrees dx dy dz ax ax' ay ay' az az' bx bx' by_ by' bz bz' terms :
  predicates_add_edge rounded (list R) (fun terms x => Expansion.add x terms) terms dx dy dz ax ax' ay ay' az az' bx bx' by_ by' bz bz' =
  Expansion.add_edge dx dy dz ((ax, ax'), (ay, ay'), (az, az')) ((bx, bx'), (by_, by'), (bz, bz')) terms.
Proof. unfold predicates_add_edge. cbv zeta. rewrite !add_product_agrees. reflexivity. Qed.

(** * Terms in an array *)

(** An array with a length stands for its first numbers. *)
Definition terms_of (sum : (nat -> R) * nat) : list R := map (fst sum) (seq 0 (snd sum)).

Lemma stored_before (array : nat -> R) (at_ from n : nat) x : (at_ < from)%nat -> map (store array at_ x) (seq from n) = map array (seq from n).
Proof. intros H. apply map_ext_in. intros i I. apply in_seq in I. unfold store. destruct (Nat.eqb_spec i at_); [lia|reflexivity]. Qed.
Lemma stored_last (array : nat -> R) n x : map (store array n x) (seq 0 (S n)) = map array (seq 0 n) ++ x :: nil.
Proof.
  rewrite seq_S, map_app. cbn [plus map]. f_equal; [|unfold store; cbn; now rewrite Nat.eqb_refl].
  apply map_ext_in. intros i I. apply in_seq in I. unfold store. destruct (Nat.eqb_spec i n); [lia|reflexivity].
Qed.

(** One turn: a term is read before its place may be written to, since no more are kept than were read. *)
Definition add_turn : (nat -> R) * R * nat -> nat -> (nat -> R) * R * nat := fun '(array, carry, kept) i =>
  let '(sum, rest) := sum_two_sum rounded carry (array i) in
  let test := negb (equal rounded rest (constant rounded 0 0)) in
  (if test then store array kept rest else array, sum, if test then S kept else kept).

Lemma add_turns n : forall from array carry kept, (kept <= from)%nat ->
  let '(array', carry', kept') := fold_left add_turn (seq from n) (array, carry, kept) in (kept' <= from + n)%nat /\
  map array (seq 0 kept) ++ Expansion.add carry (map array (seq from n)) = map array' (seq 0 kept') ++ Expansion.kept carry' nil.
Proof.
  induction n as [|n IH]; intros from array carry kept H; [split; [lia|reflexivity]|]. cbn [seq map fold_left Expansion.add].
  unfold add_turn at 2. rewrite two_sum_agrees. destruct (Expansion.two_sum carry (array from)) as [sum rest]. cbv zeta. rewrite !is_not_zero. unfold Expansion.kept at 1.
  destruct (Req_EM_T rest 0) as [Z|Z].
  - specialize (IH (S from) array sum kept ltac:(lia)). destruct (fold_left _ _ _) as [[array' carry'] kept']. split; [lia|apply IH].
  - specialize (IH (S from) (store array kept rest) sum (S kept) ltac:(lia)). destruct (fold_left _ _ _) as [[array' carry'] kept']. split; [lia|].
    destruct IH as [_ <-]. rewrite stored_last, <- app_assoc, stored_before by lia. reflexivity.
Qed.

(** [Sum::add], in place: for any number of terms; and there is at most one more. [EXACT-8] *)
Theorem add_agrees array len x : let '(array', len') := Sum_add rounded array len x in
  terms_of (array', len') = Expansion.add x (terms_of (array, len)) /\ (len' <= S len)%nat.
Proof.
  unfold Sum_add, turns. pose proof (add_turns len 0 array x 0 (le_n 0)) as H.
  match goal with |- context [fold_left ?f ?l ?s] => change (fold_left f l s) with (fold_left add_turn l s) end. cbn [num] in *.
  destruct (fold_left add_turn _ _) as [[array' carry] kept]. destruct H as [L E]. cbn [seq map app] in E. cbv zeta. rewrite !is_not_zero.
  unfold terms_of. cbn [fst snd]. rewrite E. unfold Expansion.kept.
  destruct (Req_EM_T carry 0); [rewrite app_nil_r; split; [reflexivity|lia]|]. rewrite stored_last. split; [reflexivity|lia].
Qed.

(** [Sum::value]. [EXACT-8] *)
Theorem value_agrees array len : Sum_value rounded array len = Signs.value (terms_of (array, len)).
Proof.
  unfold Sum_value, turns, Signs.value, terms_of. cbn [fst snd reals opposite constant Arithmetic.plus].
  replace (- (IZR 0 * bpow radix2 0)) with 0 by ring. generalize 0 (seq 0 len). intros sum list. revert sum.
  induction list as [|i list IH]; intros sum; [reflexivity|apply IH].
Qed.

(** What is made of sums is the same, whatever stands for them. *)
Section Standing.
Variables (S T : Type) (add_S : S -> R -> S) (add_T : T -> R -> T) (stands : S -> T -> Prop).
Hypothesis adds : forall s t x, stands s t -> stands (add_S s x) (add_T t x).

Lemma either (c : bool) s s' t t' : stands s t -> stands s' t' -> stands (if c then s else s') (if c then t else t').
Proof. now destruct c. Qed.

Lemma product_stands s t a a' b b' c : stands s t -> stands (Sum_add_product rounded S add_S s a a' b b' c) (Sum_add_product rounded T add_T t a a' b b' c).
Proof.
  intros H. unfold Sum_add_product.
  repeat match goal with |- context [sum_two_product rounded ?k ?l] => destruct (sum_two_product rounded k l) end.
  cbv zeta. destruct (equal rounded c _); [exact H|]. destruct (equal rounded a _), (equal rounded b _), (equal rounded a' _), (equal rounded b' _); cbn [negb];
    repeat apply adds; exact H.
Qed.
Lemma edge_stands s t dx dy dz ax ax' ay ay' az az' bx bx' by_ by' bz bz' : stands s t ->
  stands (predicates_add_edge rounded S add_S s dx dy dz ax ax' ay ay' az az' bx bx' by_ by' bz bz')
    (predicates_add_edge rounded T add_T t dx dy dz ax ax' ay ay' az az' bx bx' by_ by' bz bz').
Proof. intros H. unfold predicates_add_edge. cbv zeta. now repeat apply product_stands. Qed.
End Standing.

Definition code_add (sum : (nat -> R) * nat) (x : R) : (nat -> R) * nat := Sum_add rounded (fst sum) (snd sum) x.

(** The sign of an edge function as the code finds it, arrays and all: [add_edge] to a new sum, of the edge and of its end as seen from
    the origin, and its [value]. For all single-precision data, with g = -149, and for double-precision data of EXACT-7, with g = -252.
    [EXACT-2, EXACT-8] *)
Theorem code_edge_has_sign g array dx dy dz ax ay az bx by_ bz ox oy oz : (-323 <= g)%Z -> Forall (Expansion.good g) (dx :: dy :: dz :: nil) ->
  Forall (Expansion.good g) (ax :: ay :: az :: nil) -> Forall (Expansion.good g) (bx :: by_ :: bz :: nil) -> Forall (Expansion.good g) (ox :: oy :: oz :: nil) ->
  let '(px, px', py, py', pz, pz') := predicates_minus rounded ax ay az bx by_ bz in
  let '(qx, qx', qy, qy', qz, qz') := predicates_minus rounded bx by_ bz ox oy oz in
  let '(terms, len) := predicates_add_edge rounded _ code_add (array, 0%nat) dx dy dz px px' py py' pz pz' qx qx' qy qy' qz qz' in
  let found := Sum_value rounded terms len in
  let edge := dx * ((ay - oy) * (bz - oz) - (az - oz) * (by_ - oy)) + dy * ((az - oz) * (bx - ox) - (ax - ox) * (bz - oz)) +
    dz * ((ax - ox) * (by_ - oy) - (ay - oy) * (bx - ox)) in
  (0 < edge <-> 0 < found) /\ (edge < 0 <-> found < 0) /\ (edge = 0 <-> found = 0).
Proof.
  intros Hg D A B O. pose proof (minus_agrees ax ay az bx by_ bz) as MA. pose proof (minus_agrees bx by_ bz ox oy oz) as MB.
  destruct (predicates_minus rounded ax ay az bx by_ bz) as [[[[[px px'] py] py'] pz] pz'].
  destruct (predicates_minus rounded bx by_ bz ox oy oz) as [[[[[qx qx'] qy] qy'] qz] qz'].
  pose proof (edge_stands _ _ code_add (fun terms x => Expansion.add x terms) (fun s t => terms_of s = t)) as St.
  specialize (St ltac:(intros s t x <-; unfold code_add; pose proof (add_agrees (fst s) (snd s) x) as E; destruct (Sum_add _ _ _ _), s; apply E)).
  specialize (St (array, 0%nat) nil dx dy dz px px' py py' pz pz' qx qx' qy qy' qz qz' eq_refl). rewrite add_edge_agrees, MA, MB in St.
  destruct (predicates_add_edge _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _) as [terms len]. cbv zeta.
  rewrite (eq_trans (value_agrees terms len) (f_equal Signs.value St)).
  exact (Signs.edge_has_sign g dx dy dz ax ay az bx by_ bz ox oy oz Hg D A B O).
Qed.
