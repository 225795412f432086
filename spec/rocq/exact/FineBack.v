(** Twice the digits on IEEE 754 doubles, from the results to the operands: where a result is finite, nothing that it is made of has overflowed, whatever the
    operands. An infinity or a NaN would have got into it. *)
Require Import Reals ZArith Lia Lra Bool List.
From Flocq Require Import Core BinarySingleNaN.
Require Import StacklessExact.Rounding StacklessExact.Range StacklessExact.Overflow StacklessExact.Arithmetic StacklessExact.Operations.
Require Import StacklessExact.Fine StacklessExact.AgreementFine StacklessExact.FineNumbers.
Require StacklessExact.Expansion.
Open Scope R_scope.

Local Instance prec_53 : Prec_gt_0 53 := eq_refl.
Local Instance emax_1024 : Prec_lt_emax 53 1024 := eq_refl.
Notation finite := BinarySingleNaN.is_finite.
Notation float := (num f64).

(** * From the result to the operands *)

Lemma overflown (x : float) s : B2SF x = binary_overflow 53 1024 mode_NE s -> finite x = true -> False.
Proof. intros E H. rewrite <- is_finite_SF_B2SF, E in H. destruct s; discriminate. Qed.

Lemma plus_back (x y : float) : finite (Arithmetic.plus f64 x y) = true -> finite x = true /\ finite y = true /\ B2R (Arithmetic.plus f64 x y) = R64 (B2R x + B2R y).
Proof.
  intros H. assert (A : finite x = true /\ finite y = true) by (destruct x as [[]|[]| |[]], y as [[]|[]| |[]]; try discriminate H; auto). destruct A as [X Y]. repeat split; try assumption.
  pose proof (Bplus_correct 53 1024 _ _ mode_NE x y X Y) as C. destruct (Rlt_bool _ _); [exact (proj1 C)|]. exfalso. exact (overflown _ _ (proj1 C) H).
Qed.
Lemma minus_back (x y : float) : finite (Arithmetic.minus f64 x y) = true -> finite x = true /\ finite y = true /\ B2R (Arithmetic.minus f64 x y) = R64 (B2R x - B2R y).
Proof.
  intros H. assert (A : finite x = true /\ finite y = true) by (destruct x as [[]|[]| |[]], y as [[]|[]| |[]]; try discriminate H; auto). destruct A as [X Y]. repeat split; try assumption.
  pose proof (Bminus_correct 53 1024 _ _ mode_NE x y X Y) as C. destruct (Rlt_bool _ _); [exact (proj1 C)|]. exfalso. exact (overflown _ _ (proj1 C) H).
Qed.
Lemma times_back (x y : float) : finite (Arithmetic.times f64 x y) = true -> finite x = true /\ finite y = true /\ B2R (Arithmetic.times f64 x y) = R64 (B2R x * B2R y).
Proof.
  intros H. assert (A : finite x = true /\ finite y = true) by (destruct x as [[]|[]| |[]], y as [[]|[]| |[]]; try discriminate H; auto). destruct A as [X Y]. repeat split; try assumption.
  pose proof (Bmult_correct 53 1024 _ _ mode_NE x y) as C. destruct (Rlt_bool _ _); [exact (proj1 C)|]. exfalso. exact (overflown _ _ C H).
Qed.
(** The divisor is known to be a number, and not 0. *)
Lemma over_back (x y : float) : finite y = true -> B2R y <> 0 -> finite (Arithmetic.over f64 x y) = true -> finite x = true /\ B2R (Arithmetic.over f64 x y) = R64 (B2R x / B2R y).
Proof.
  intros Y N H. assert (X : finite x = true) by (destruct x as [[]|[]| |[]], y as [[]|[]| |[]]; try discriminate H; try discriminate Y; reflexivity). split; [exact X|].
  pose proof (Bdiv_correct 53 1024 _ _ mode_NE x y N) as C. destruct (Rlt_bool _ _); [exact (proj1 C)|]. exfalso. exact (overflown _ _ C H).
Qed.

(** A number. *)
Definition is (x : float) (a : R) : Prop := finite x = true /\ B2R x = a.
Lemma is_itself (x : float) : finite x = true -> is x (B2R x).
Proof. now split. Qed.
Lemma is_fits x a e : Rabs a <= bpow radix2 e -> is x a -> fits e x a.
Proof. intros B [X V]. now repeat split. Qed.
Lemma fits_is e x a : fits e x a -> is x a.
Proof. intros (X & V & _). now split. Qed.
Lemma is_F x a : is x a -> generic_format radix2 (FLT_exp (-1074) 53) a.
Proof. intros [_ <-]. exact (generic_format_B2R 53 1024 x). Qed.
Lemma is_top x a : is x a -> Rabs a <= bpow radix2 1024.
Proof. intros [_ <-]. apply Rlt_le. exact (abs_B2R_lt_emax 53 1024 x). Qed.

Lemma back_plus x y : finite (Arithmetic.plus f64 x y) = true -> exists a b, is x a /\ is y b /\ is (Arithmetic.plus f64 x y) (R64 (a + b)).
Proof. intros H. destruct (plus_back x y H) as (X & Y & V). exists (B2R x), (B2R y). now repeat split. Qed.

Lemma two_sum_back x y : finite (snd (sum_two_sum f64 x y)) = true -> exists a b, is x a /\ is y b /\
  is (fst (sum_two_sum f64 x y)) (fst (Expansion.two_sum a b)) /\ is (snd (sum_two_sum f64 x y)) (snd (Expansion.two_sum a b)).
Proof.
  intros H. unfold sum_two_sum in *. cbv zeta in *. cbn [fst snd] in *. destruct (plus_back _ _ H) as (P1 & P2 & P3). destruct (minus_back _ _ P1) as (X & Q2 & Q3).
  destruct (minus_back _ _ Q2) as (S & T & Q4). destruct (minus_back _ _ P2) as (Y & _ & Q5). destruct (minus_back _ _ T) as (_ & _ & Q6). destruct (plus_back _ _ S) as (_ & _ & Q7).
  exists (B2R x), (B2R y). unfold Expansion.two_sum. cbv zeta. cbn [fst snd]. split; [now split|]. split; [now split|]. split; (split; [assumption|]); [exact Q7|].
  rewrite P3, Q3, Q4, Q5, Q6, Q7. reflexivity.
Qed.
Lemma split_back x : finite (snd (sum_split f64 x)) = true -> exists a, is x a /\ is (fst (sum_split f64 x)) (fst (Expansion.split a)) /\ is (snd (sum_split f64 x)) (snd (Expansion.split a)).
Proof.
  intros H. unfold sum_split in *. cbv zeta in *. cbn [fst snd] in *. destruct (minus_back _ _ H) as (X & P2 & P3). destruct (minus_back _ _ P2) as (C & D & P4).
  destruct (minus_back _ _ D) as (_ & _ & P5). destruct (times_back _ _ C) as (_ & _ & P6).
  assert (K : B2R (Arithmetic.constant f64 134217729 0) = 134217729).
  { destruct (constant_fits 134217729 0 ltac:(reflexivity) ltac:(lia)) as [_ V]. etransitivity; [exact V|]. cbn. ring. }
  rewrite K in P6. exists (B2R x). unfold Expansion.split. cbv zeta. cbn [fst snd]. split; [now split|]. split; (split; [assumption|]); rewrite ?P3, ?P4, ?P5, ?P6; reflexivity.
Qed.
Lemma two_product_back x y : finite (snd (sum_two_product f64 x y)) = true -> exists a b, is x a /\ is y b /\
  is (fst (sum_two_product f64 x y)) (fst (Expansion.two_product a b)) /\ is (snd (sum_two_product f64 x y)) (snd (Expansion.two_product a b)).
Proof.
  intros H. unfold sum_two_product in *. destruct (sum_split f64 x) as [x1 x0] eqn:Ex, (sum_split f64 y) as [y1 y0] eqn:Ey. cbv zeta in *. cbn [fst snd] in *.
  destruct (minus_back _ _ H) as (P1 & P2 & P3). destruct (times_back _ _ P1) as (X0 & Y0 & P4). destruct (minus_back _ _ P2) as (Q1 & Q2 & P5). destruct (times_back _ _ Q2) as (_ & _ & P6).
  destruct (minus_back _ _ Q1) as (R1 & R2 & P7). destruct (times_back _ _ R2) as (_ & _ & P8). destruct (minus_back _ _ R1) as (S1 & S2 & P9). destruct (times_back _ _ S2) as (_ & _ & P10).
  destruct (times_back _ _ S1) as (X & Y & P11).
  assert (Hx : finite (snd (sum_split f64 x)) = true) by (rewrite Ex; exact X0). assert (Hy : finite (snd (sum_split f64 y)) = true) by (rewrite Ey; exact Y0).
  destruct (split_back x Hx) as (a & A & A1 & A2). destruct (split_back y Hy) as (b & B & B1 & B2). rewrite Ex in A1, A2. rewrite Ey in B1, B2. cbn [fst snd] in *.
  exists a, b. split; [exact A|]. split; [exact B|]. unfold Expansion.two_product. destruct (Expansion.split a) as [a1 a0], (Expansion.split b) as [b1 b0]. cbv zeta. cbn [fst snd] in *.
  destruct A as [_ A], B as [_ B], A1 as [_ A1], A2 as [_ A2], B1 as [_ B1], B2 as [_ B2].
  split; (split; [assumption|]); rewrite ?P3, ?P4, ?P5, ?P6, ?P7, ?P8, ?P9, ?P10, ?P11, ?A, ?B, ?A1, ?A2, ?B1, ?B2; reflexivity.
Qed.

(** * Numbers of twice the digits *)

Definition fine_is (p : float * float * float) (x : fine) : Prop := let '(h, l, r) := p in is h (high x) /\ is l (low x) /\ is r (radius x).
Definition fine_finite (p : float * float * float) : Prop := let '(h, l, r) := p in finite h = true /\ finite l = true /\ finite r = true.

Lemma is_zero_constant : is (Arithmetic.constant f64 0 0) 0.
Proof. exact (fits_is 0 _ _ (zero_fits 0)). Qed.
Lemma is_power e : (-1074 <= e <= 900)%Z -> is (Arithmetic.constant f64 1 e) (bpow radix2 e).
Proof.
  intros H. destruct (constant_fits 1 e ltac:(reflexivity) H) as [X V]. split; [exact X|]. etransitivity; [exact V|]. exact (power_is e).
Qed.
Lemma is_UP : is (fine_UP f64) UP.
Proof. exact (fits_is 1 _ _ up_fits). Qed.
Lemma equal_of x y a b : is x a -> is y b -> Arithmetic.equal f64 x y = Req_bool a b.
Proof. intros [X <-] [Y <-]. exact (Beqb_correct 53 1024 x y X Y). Qed.
Lemma less_of x y a b : is x a -> is y b -> Arithmetic.less f64 x y = Rlt_bool a b.
Proof. intros [X <-] [Y <-]. exact (Bltb_correct 53 1024 x y X Y). Qed.
Lemma absolute_back x : finite (Arithmetic.absolute f64 x) = true -> finite x = true /\ B2R (Arithmetic.absolute f64 x) = Rabs (B2R x).
Proof. intros H. split; [now destruct x|apply B2R_Babs]. Qed.
Lemma absolute_of x a : is x a -> is (Arithmetic.absolute f64 x) (Rabs a).
Proof. intros [X <-]. split; [now destruct x|apply B2R_Babs]. Qed.
Lemma opposite_of x a : is x a -> is (Arithmetic.opposite f64 x) (- a).
Proof. intros [X <-]. split; [now destruct x|apply B2R_Bopp]. Qed.
Lemma is_same x a b : is x a -> is x b -> a = b.
Proof. intros [_ <-] [_ <-]. reflexivity. Qed.

Lemma times_of x y a b : finite (Arithmetic.times f64 x y) = true -> is x a -> is y b -> is (Arithmetic.times f64 x y) (R64 (a * b)).
Proof. intros H [_ <-] [_ <-]. now destruct (times_back _ _ H) as (_ & _ & V). Qed.
Lemma plus_of x y a b : finite (Arithmetic.plus f64 x y) = true -> is x a -> is y b -> is (Arithmetic.plus f64 x y) (R64 (a + b)).
Proof. intros H [_ <-] [_ <-]. now destruct (plus_back _ _ H) as (_ & _ & V). Qed.

(** [Fine::new]: whatever it gives is finite only if its operands are. *)
Lemma new_back h l r : fine_finite (Fine_new f64 h l r) -> exists a b c, is h a /\ is l b /\ is r c /\ fine_is (Fine_new f64 h l r) (new a b c).
Proof.
  unfold Fine_new, new. destruct (sum_two_sum f64 h l) as [s t] eqn:E. intros (S & T & P).
  destruct (two_sum_back h l) as (a & b & A & B & V & W); [rewrite E; exact T|]. rewrite E in V, W. cbn [fst snd] in *.
  destruct (times_back _ _ P) as (R & _ & _). exists a, b, (B2R r). split; [exact A|]. split; [exact B|]. split; [now split|].
  destruct (Expansion.two_sum a b) as [u v]. cbn [fst snd] in *. split; [exact V|]. split; [exact W|]. cbn [radius]. apply times_of; [exact P|now split|exact is_UP].
Qed.

(** [Fine::mul] by one double. [NEAR-5] *)
Lemma mul_back q y (p : float) (h l r : float) : is p q -> fine_is (h, l, r) y -> let zero := Arithmetic.constant f64 0 0 in
  fine_finite (Fine_mul f64 p zero zero h l r) -> fine_is (Fine_mul f64 p zero zero h l r) (mul (exact q) y).
Proof.
  intros P (H & L & R). cbv zeta. unfold Fine_mul, mul, is_zero, are_doubles, is_exact. cbn [exact high low radius].
  pose proof is_zero_constant as Z. set (zero := Arithmetic.constant f64 0 0) in *.
  rewrite (equal_of _ _ _ _ P Z), (equal_of _ _ _ _ Z Z), (equal_of _ _ _ _ H Z), (equal_of _ _ _ _ R Z), (equal_of _ _ _ _ L Z).
  destruct (orb _ _); [intros _; destruct (sum_two_product f64 p h); destruct (Fine_new f64 _ _ _) as [[? ?] ?]; now repeat split|].
  destruct (sum_two_product f64 p h) as [s t] eqn:E.
  assert (Parts : finite t = true -> is s (fst (Expansion.two_product q (high y))) /\ is t (snd (Expansion.two_product q (high y)))).
  { intros T. destruct (two_product_back p h) as (a & b & A & B & V & W); [rewrite E; exact T|]. rewrite E in V, W. cbn [fst snd] in V, W.
    rewrite (is_same _ _ _ P A), (is_same _ _ _ H B). now split. }
  set (low' := Arithmetic.plus f64 t _). set (rad := Arithmetic.plus f64 (Arithmetic.plus f64 _ _) (Arithmetic.constant f64 1 (-1060))).
  destruct (Fine_new f64 s low' rad) as [[n n'] n''] eqn:N.
  destruct (andb (andb (andb (andb (Req_bool 0 0) (Req_bool (low y) 0)) (Req_bool 0 0)) (Req_bool (radius y) 0)) (Arithmetic.less f64 (Arithmetic.constant f64 1 (-900)) (Arithmetic.absolute f64 s))) eqn:D.
  - intros (_ & T & _). destruct (Parts T) as [S1 T1]. rewrite (less_of _ _ _ _ (is_power (-900) ltac:(lia)) (absolute_of _ _ S1)) in D. fold EXACT in D.
    destruct (Expansion.two_product q (high y)) as [s' t']. cbn [fst snd] in *. rewrite D. split; [exact S1|split; [exact T1|exact Z]].
  - intros Fin. destruct (new_back s low' rad) as (a & b & c & A & B & C & V); [rewrite N; exact Fin|]. rewrite N in V. clear N.
    destruct B as [B B']. destruct (plus_back _ _ B) as (T & Q1 & V1). destruct (plus_back _ _ Q1) as (Q2 & Q3 & V2). destruct (times_back _ _ Q2) as (_ & _ & V3). destruct (times_back _ _ Q3) as (_ & _ & V4).
    destruct C as [C C']. destruct (plus_back _ _ C) as (R1 & _ & W1). destruct (plus_back _ _ R1) as (R2 & R3 & W2). destruct (times_back _ _ R2) as (R4 & _ & W3). destruct (times_back _ _ R3) as (_ & _ & W4).
    destruct (plus_back _ _ R4) as (R5 & R6 & W5). destruct (plus_back _ _ R5) as (R7 & R8 & W6). destruct (times_back _ _ R6) as (_ & _ & W7). destruct (times_back _ _ R7) as (_ & _ & W8). destruct (times_back _ _ R8) as (_ & _ & W9).
    destruct (Parts T) as [S1 T1]. rewrite (less_of _ _ _ _ (is_power (-900) ltac:(lia)) (absolute_of _ _ S1)) in D. fold EXACT in D.
    destruct (Expansion.two_product q (high y)) as [s' t']. cbn [fst snd] in *. rewrite D.
    destruct P as [_ P], H as [_ H], L as [_ L], R as [_ R], Z as [_ Z], S1 as [S1f S1], T1 as [_ T1]. destruct (is_power (-102) ltac:(lia)) as [_ K1]. destruct (is_power (-1060) ltac:(lia)) as [_ K2]. destruct is_UP as [_ K3].
    assert (Ab : forall x : float, B2R (Arithmetic.absolute f64 x) = Rabs (B2R x)) by (intros; apply B2R_Babs).
    match goal with |- fine_is _ (new ?a' ?b' ?c') => replace c' with c; [replace b' with b; [replace a' with a; [exact V|]|]|] end.
    + destruct A as [_ A]. rewrite <- A. exact S1.
    + rewrite <- B'. unfold low'. rewrite V1, V2, V3, V4, P, H, L, Z, T1. reflexivity.
    + rewrite <- C'. unfold rad. rewrite W1, W2, W3, W4, W5, W6, W7, W8, W9, !Ab, P, H, R, Z, S1, K1, K2, K3. reflexivity.
Qed.

(** [Fine::add], where the second numbers are what rounding left out of the first. [NEAR-5] *)
Lemma add_back h l r h' l' r' x y : fine_is (h, l, r) x -> fine_is (h', l', r') y -> proper x -> proper y ->
  fine_finite (Fine_add f64 h l r h' l' r') -> fine_is (Fine_add f64 h l r h' l' r') (add x y).
Proof.
  intros (H & L & R) (H' & L' & R') (_ & _ & _ & _ & P) (_ & _ & _ & _ & P').
  assert (Low : forall z a b, is z a -> Rabs b <= bpow radix2 (-53) * Rabs a -> Rabs b <= bpow radix2 971).
  { intros z a b A B. apply Rle_trans with (1 := B). change 971%Z with (-53 + 1024)%Z. rewrite bpow_plus. apply Rmult_le_compat_l; [apply bpow_ge_0|exact (is_top _ _ A)]. }
  pose proof (is_fits _ _ 971 (Low _ _ _ H P) L) as FL. pose proof (is_fits _ _ 971 (Low _ _ _ H' P') L') as FL'.
  destruct (two_sum_fits 971 FL FL' ltac:(lia)) as [B1 B2]. pose proof is_zero_constant as Z.
  unfold Fine_add, add. destruct (sum_two_sum f64 h h') as [a rest] eqn:E1. destruct (sum_two_sum f64 l l') as [b least] eqn:E2. destruct (Expansion.two_sum (low x) (low y)) as [b0 least0]. cbn [fst snd] in *.
  destruct (sum_two_sum f64 rest b) as [c lost] eqn:E3. destruct (sum_two_sum f64 a c) as [v w] eqn:E4. cbv zeta. destruct (Fine_new f64 v _ _) as [[n n'] n''] eqn:N. intros Fin.
  (* What is left out of the last sum is a number in either case, so all before it are. *)
  assert (W : finite w = true).
  { destruct (andb _ _) in Fin; [exact (proj1 (proj2 Fin))|]. match type of N with Fine_new f64 ?a1 ?b1 ?c1 = _ => destruct (new_back a1 b1 c1) as (_ & ? & _ & _ & [K _] & _) end; [rewrite N; exact Fin|].
    now destruct (plus_back _ _ K). }
  destruct (two_sum_back a c) as (a0 & c0 & A & C & V & W'); [rewrite E4; exact W|]. rewrite E4 in V, W'. cbn [fst snd] in V, W'.
  assert (Rest : finite rest = true). { destruct C as [C _]. assert (Ec : c = Arithmetic.plus f64 rest b) by (unfold sum_two_sum in E3; now injection E3 as <- _). rewrite Ec in C. now destruct (plus_back _ _ C). }
  destruct (two_sum_back h h') as (p & p' & Hp & Hp' & A' & Rest'); [rewrite E1; exact Rest|]. rewrite E1 in A', Rest'. cbn [fst snd] in A', Rest'.
  rewrite <- (is_same _ _ _ H Hp), <- (is_same _ _ _ H' Hp') in A', Rest'.
  assert (Fr : fits 971 rest (snd (Expansion.two_sum (high x) (high y)))).
  { apply is_fits; [|exact Rest']. apply (Low _ _ _ A'). rewrite two_sum_is by (eapply is_F; eassumption). cbn [fst snd]. apply sum_off; eapply is_F; eassumption. }
  destruct (Expansion.two_sum (high x) (high y)) as [ax rx]. cbn [fst snd] in *.
  destruct (two_sum_fits 972 Fr B1 ltac:(lia)) as [C1 C2]. rewrite E3 in C1, C2. destruct (Expansion.two_sum rx b0) as [cx lx]. cbn [fst snd] in *.
  rewrite (is_same _ _ _ A A'), (is_same _ _ _ C (fits_is _ _ _ C1)) in V, W'. destruct (Expansion.two_sum ax cx) as [vx wx]. cbn [fst snd] in *.
  rewrite (equal_of _ _ _ _ (fits_is _ _ _ C2) Z), (equal_of _ _ _ _ (fits_is _ _ _ B2) Z) in Fin |- *.
  destruct (andb (Req_bool lx 0) (Req_bool least0 0)).
  - destruct Fin as (_ & _ & T). split; [exact V|]. split; [exact W'|]. cbn [radius]. destruct (times_back _ _ T) as (T1 & _ & _). apply times_of; [exact T| |exact is_UP]. now apply plus_of.
  - match type of N with Fine_new f64 ?a1 ?b1 ?c1 = _ => destruct (new_back a1 b1 c1) as (a2 & b2 & c2 & A2 & B3 & C3 & G) end; [rewrite N; exact Fin|]. rewrite N in G.
    rewrite (is_same _ _ _ A2 V) in G. destruct B3 as [B3 B4], C3 as [C3 C4]. destruct (plus_back _ _ C3) as (C5 & C6 & _).
    pose proof (plus_of _ _ _ _ B3 W' (fits_is _ _ _ B2)) as [_ Eb]. rewrite B4 in Eb.
    pose proof (plus_of _ _ _ _ C5 R R') as Er. pose proof (times_of _ _ _ _ C6 (absolute_of _ _ V) (is_power (-102) ltac:(lia))) as Et. pose proof (plus_of _ _ _ _ C3 Er Et) as [_ Ec]. rewrite C4 in Ec.
    rewrite Eb, Ec in G. exact G.
Qed.

Lemma sub_back h l r h' l' r' x y : fine_is (h, l, r) x -> fine_is (h', l', r') y -> proper x -> proper y ->
  fine_finite (Fine_sub f64 h l r h' l' r') -> fine_is (Fine_sub f64 h l r h' l' r') (sub x y).
Proof.
  intros X (H & L & R) P (F1 & F2 & F3 & F4 & F5). unfold Fine_sub, Fine_neg, sub.
  pose proof (add_back h l r (Arithmetic.opposite f64 h') (Arithmetic.opposite f64 l') r' x (neg y) X) as A. destruct (Fine_add f64 _ _ _ _ _ _) as [[a a'] a'']. apply A.
  - split; [now apply opposite_of|]. split; [now apply opposite_of|exact R].
  - exact P.
  - repeat split; cbn [neg high low radius]; try assumption; try (now apply F_opp). now rewrite !Rabs_Ropp.
Qed.
