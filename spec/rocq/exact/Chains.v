(** The edges of faces as a chain, and [uneven] of src/trace/boundary.rs: CLOSED-1. *)
Require Import Reals ZArith Lia Lra List Bool Wf_nat.
From Flocq Require Import Core.
Require Import StacklessExact.Filter StacklessExact.Parity.
Import ListNotations.
Open Scope R_scope.

Definition zero : vec := Vec 0 0 0.
Definition scale (s : R) (v : vec) : vec := Vec (s * vx v) (s * vy v) (s * vz v).

Definition same (a b : vec) : bool := Req_bool (vx a) (vx b) && Req_bool (vy a) (vy b) && Req_bool (vz a) (vz b).

Lemma same_iff a b : same a b = true <-> a = b.
Proof.
  unfold same. rewrite !andb_true_iff. destruct a as [a1 a2 a3], b as [b1 b2 b3]. cbn. split.
  - intros ((X & Y) & Z). repeat match goal with H : Req_bool ?x ?y = true |- _ => destruct (Req_bool_spec x y); [subst; clear H|discriminate H] end. reflexivity.
  - intros E. injection E as -> -> ->. repeat split; now apply Req_bool_true.
Qed.

Lemma same_refl a : same a a = true.
Proof. now apply same_iff. Qed.

Lemma same_false a b : same a b = false <-> a <> b.
Proof. rewrite <- same_iff. destruct (same a b); split; congruence. Qed.

Lemma same_sym a b : same a b = same b a.
Proof. destruct (same b a) eqn:E; [apply same_iff in E; subst; apply same_refl|]. apply same_false in E. apply same_false. congruence. Qed.

(** * Lines *)

Definition parallel (a b : vec) : bool := same (cross3 a b) zero.

Ltac vectors := unfold parallel, cross3, dot3, less, more, scale, zero in *; cbn [vx vy vz fst snd] in *.

Lemma multiple a w : w <> zero -> parallel a w = true -> exists s, a = scale s w.
Proof.
  intros N P. apply same_iff in P. destruct a as [a1 a2 a3], w as [w1 w2 w3]. vectors. injection P as X Y Z.
  assert (Q : forall s t x y, x <> 0 -> y * x = s * t -> y = s / x * t) by (intros s t x y Nx E; apply Rmult_eq_reg_r with x; [rewrite E; field; exact Nx|exact Nx]).
  destruct (Req_dec w1 0) as [E1|N1]; [destruct (Req_dec w2 0) as [E2|N2]; [destruct (Req_dec w3 0) as [E3|N3]; [congruence|]|]|].
  - exists (a3 / w3). f_equal; apply Q; trivial; lra.
  - exists (a2 / w2). f_equal; apply Q; trivial; lra.
  - exists (a1 / w1). f_equal; apply Q; trivial; lra.
Qed.

Lemma parallel_scale s w : parallel (scale s w) w = true.
Proof. apply same_iff. vectors. f_equal; ring. Qed.

Lemma parallel_trans a w b : w <> zero -> parallel a w = true -> parallel b w = true -> parallel a b = true.
Proof.
  intros N A B. destruct (multiple _ _ N A) as (s & ->), (multiple _ _ N B) as (t & ->). apply same_iff. vectors. f_equal; ring.
Qed.

Lemma parallel_sym a b : parallel a b = parallel b a.
Proof.
  destruct (parallel b a) eqn:E.
  - apply same_iff in E. apply same_iff. vectors. injection E as X Y Z. f_equal; lra.
  - destruct (parallel a b) eqn:F; [|reflexivity]. exfalso. assert (E' : parallel b a = true); [|congruence]. apply same_iff in F. apply same_iff. vectors. injection F as X Y Z. f_equal; lra.
Qed.

Lemma parallel_zero w : parallel zero w = true.
Proof. apply same_iff. vectors. f_equal; ring. Qed.

(** * Sums *)

Fixpoint sum {A : Type} (f : A -> Z) (l : list A) : Z := match l with [] => 0 | x :: l => f x + sum f l end%Z.

Lemma sum_ext {A} (f g : A -> Z) l : (forall x, In x l -> f x = g x) -> sum f l = sum g l.
Proof. induction l as [|x l IH]; intros H; [reflexivity|]. cbn. rewrite H, IH; auto; [|left; reflexivity]. intros y I. apply H. now right. Qed.

Lemma sum_divides {A} m (f : A -> Z) l : (forall x, In x l -> (m | f x)%Z) -> (m | sum f l)%Z.
Proof. induction l as [|x l IH]; intros H; [apply Z.divide_0_r|]. cbn. apply Z.divide_add_r; [apply H; now left|apply IH; intros; apply H; now right]. Qed.

Lemma sum_plus {A} (f g : A -> Z) l : sum (fun x => f x + g x)%Z l = (sum f l + sum g l)%Z.
Proof. induction l as [|x l IH]; [reflexivity|]. cbn. rewrite IH. ring. Qed.

Lemma sum_opp {A} (f : A -> Z) l : sum (fun x => - f x)%Z l = (- sum f l)%Z.
Proof. induction l as [|x l IH]; [reflexivity|]. cbn. rewrite IH. ring. Qed.

Lemma sum_filter {A} (p : A -> bool) (f : A -> Z) l : sum f (filter p l) = sum (fun x => if p x then f x else 0%Z) l.
Proof. induction l as [|x l IH]; [reflexivity|]. cbn. destruct (p x); cbn; rewrite IH; reflexivity. Qed.

Lemma sum_split {A} (p : A -> bool) (f : A -> Z) l : sum f l = (sum f (filter p l) + sum f (filter (fun x => negb (p x)) l))%Z.
Proof. rewrite !sum_filter, <- sum_plus. apply sum_ext. intros x _. destruct (p x); cbn; ring. Qed.

Lemma filter_shorter {A} (p : A -> bool) x l : p x = false -> (length (filter p (x :: l)) < length (x :: l))%nat.
Proof. intros H. cbn. rewrite H. apply Nat.lt_succ_r. induction l as [|y l IH]; [apply le_n|]. cbn. destruct (p y); cbn; lia. Qed.

Lemma divides_differ m a b : (m | a - b)%Z -> (m | a)%Z <-> (m | b)%Z.
Proof.
  intros D. split; intros H; [replace b with (a - (a - b))%Z by ring|replace a with (b + (a - b))%Z by ring]; [now apply Z.divide_sub_r|now apply Z.divide_add_r].
Qed.

(** * Chains *)

Definition edge : Type := vec * vec.
Definition way (e : edge) : vec := less (snd e) (fst e).
Definition along (w : vec) (e : edge) : bool := parallel (way e) w.

(** Of the edges on the line through p along w: those that begin at p less those that end there. *)
Definition begins (p w : vec) (e : edge) : Z := if along w e then Z.b2z (same (fst e) p) - Z.b2z (same (snd e) p) else 0%Z.
(** Those that have an end there. *)
Definition ends (p w : vec) (e : edge) : Z := if along w e then Z.b2z (same (fst e) p) + Z.b2z (same (snd e) p) else 0%Z.

(** At each point, on each line: m = 2 for parity, 0 for both directions. *)
Definition balanced (m : Z) (l : list edge) : Prop := forall p w, w <> zero -> (m | sum (begins p w) l)%Z.

(** For parity the directions do not matter: on each line an even number of edges end at each point. [CLOSED-1](4) *)
Theorem closed_ends l : balanced 2 l <-> forall p w, w <> zero -> Z.Even (sum (ends p w) l).
Proof.
  assert (E : forall p w, (2 | sum (begins p w) l)%Z <-> Z.Even (sum (ends p w) l)).
  { intros p w. transitivity (2 | sum (ends p w) l)%Z.
    - apply divides_differ. unfold Z.sub. rewrite <- sum_opp, <- sum_plus. apply sum_divides. intros e _. unfold begins, ends.
      destruct (along w e); [|now exists 0%Z]. exists (- Z.b2z (same (snd e) p))%Z. ring.
    - split; intros (k & K); exists k; rewrite K; ring. }
  unfold balanced. split; intros H p w N; apply E; auto.
Qed.

(** What the ends of edges weigh, times a function of the point: it vanishes if the weights vanish at each point. *)
Lemma weighted m (G : vec -> Z) l : (forall p, (m | sum (fun x => if same (fst x) p then snd x else 0) l)%Z) -> (m | sum (fun x => snd x * G (fst x)) l)%Z.
Proof.
  remember (length l) as n eqn:Hn. revert l Hn. induction n as [n IH] using lt_wf_ind. intros [|x l] -> H; [apply Z.divide_0_r|]. set (p := fst x).
  rewrite (sum_split (fun y => same (fst y) p)). apply Z.divide_add_r.
  - rewrite sum_filter. specialize (H p). set (l' := x :: l) in *. clearbody l'.
    replace (sum _ l') with (G p * sum (fun x => if same (fst x) p then snd x else 0%Z) l')%Z; [now apply Z.divide_mul_r|].
    clear H IH. induction l' as [|y l' IH']; [cbn; ring|]. cbn [sum]. rewrite Z.mul_add_distr_l, IH'. f_equal. destruct (same (fst y) p) eqn:E; [|ring].
    apply same_iff in E. rewrite E. ring.
  - eapply IH; [|reflexivity|].
    + apply filter_shorter. cbn. unfold p. now rewrite same_refl.
    + intros q. rewrite sum_filter. destruct (same q p) eqn:Q.
      * apply same_iff in Q. subst q. rewrite (sum_ext _ (fun _ => 0%Z)).
        { apply sum_divides. intros. apply Z.divide_0_r. }
        intros y _. destruct (same (fst y) p); reflexivity.
      * rewrite (sum_ext _ (fun x => if same (fst x) q then snd x else 0%Z)); [apply H|]. intros y _. destruct (same (fst y) p) eqn:Y; [|reflexivity].
        cbn. apply same_iff in Y. rewrite Y, same_sym, Q. reflexivity.
Qed.

Lemma sum_app {A} (f : A -> Z) l l' : sum f (l ++ l') = (sum f l + sum f l')%Z.
Proof. induction l as [|x l IH]; [reflexivity|]. cbn. rewrite IH. ring. Qed.

Lemma differences m (G : vec -> Z) w l : balanced m l -> w <> zero -> (m | sum (fun e => if along w e then G (snd e) - G (fst e) else 0) l)%Z.
Proof.
  intros B N. set (both := flat_map (fun e : edge => if along w e then [(fst e, (-1)%Z); (snd e, 1%Z)] else []) l).
  assert (S : forall f, sum f both = sum (fun e : edge => if along w e then f (fst e, (-1)%Z) + f (snd e, 1%Z) else 0)%Z l).
  { intros f. unfold both. clear B. induction l as [|e l IH]; [reflexivity|]. cbn [flat_map sum]. rewrite sum_app, IH. f_equal. destruct (along w e); cbn [sum]; ring. }
  pose proof (weighted m G both) as W. rewrite !S in W. rewrite (sum_ext _ (fun e : edge => if along w e then G (snd e) - G (fst e) else 0)%Z) in W.
  2: { intros e _. destruct (along w e); [cbn [fst snd]; ring|reflexivity]. }
  apply W. intros p. rewrite S. rewrite (sum_ext _ (fun e => - begins p w e)%Z); [rewrite sum_opp; apply Z.divide_opp_r; now apply B|].
  intros e _. unfold begins. destruct (along w e); [|reflexivity]. cbn. destruct (same (fst e) p), (same (snd e) p); reflexivity.
Qed.

Lemma flat e : way e = zero -> fst e = snd e.
Proof. destruct e as [[a1 a2 a3] [b1 b2 b3]]. unfold way. vectors. intros E. injection E as X Y Z. f_equal; lra. Qed.

Lemma flat_begins e p w : way e = zero -> begins p w e = 0%Z.
Proof. intros E. apply flat in E. unfold begins. rewrite E. destruct (along w e); [ring|reflexivity]. Qed.

(** A function of edges that on each line is a difference of its ends: over a balanced chain it adds up to 0 (or to an even number). *)
Theorem adds_up m (g : edge -> Z) (G : vec -> vec -> Z) l :
  (forall e w, In e l -> w <> zero -> along w e = true -> g e = G w (snd e) - G w (fst e))%Z -> balanced m l -> (m | sum g l)%Z.
Proof.
  remember (length l) as n eqn:Hn. revert l Hn. induction n as [n IH] using lt_wf_ind. intros [|e l] -> H B; [apply Z.divide_0_r|].
  destruct (same (way e) zero) eqn:E.
  - apply same_iff in E. cbn [sum]. apply Z.divide_add_r.
    + rewrite (H e (Vec 1 0 0)); [|now left|intros C; injection C; lra|unfold along; rewrite E; apply parallel_zero]. apply flat in E. rewrite E. exists 0%Z. ring.
    + eapply IH; [|reflexivity| |]; [cbn; lia|intros; apply H; auto; now right|]. intros p w N. specialize (B p w N). cbn [sum] in B. now rewrite flat_begins in B.
  - apply same_false in E. set (w := way e) in *. rewrite (sum_split (along w)). apply Z.divide_add_r.
    + rewrite sum_filter. rewrite (sum_ext _ (fun e => if along w e then G w (snd e) - G w (fst e) else 0)%Z); [now apply differences|].
      intros f I. destruct (along w f) eqn:A; [|reflexivity]. now apply H.
    + eapply IH; [|reflexivity| |].
      * apply filter_shorter. replace (along w e) with true; [reflexivity|]. symmetry. unfold along. fold w. apply same_iff. vectors. f_equal; ring.
      * intros f v I. apply filter_In in I. now apply H.
      * intros p v N. rewrite sum_filter. destruct (parallel w v) eqn:P.
        -- rewrite (sum_ext _ (fun _ => 0%Z)); [apply sum_divides; intros; apply Z.divide_0_r|]. intros f _. destruct (along w f) eqn:A; [reflexivity|]. cbn.
           unfold begins. destruct (along v f) eqn:A'; [|reflexivity]. unfold along in *. rewrite (parallel_trans _ v) in A; auto. discriminate.
        -- rewrite (sum_ext _ (begins p v)); [now apply B|]. intros f _. destruct (along w f) eqn:A; [|reflexivity]. cbn. unfold begins. destruct (along v f) eqn:A'; [|reflexivity].
           unfold along in *. destruct (same (way f) zero) eqn:Z.
           ++ apply same_iff, flat in Z. rewrite Z. ring.
           ++ apply same_false in Z. rewrite parallel_sym in A, A'. rewrite (parallel_trans _ (way f)) in P; auto. discriminate.
Qed.
