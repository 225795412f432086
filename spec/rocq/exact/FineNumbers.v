(** Twice the digits on IEEE 754 doubles: nothing overflows, so the numbers are those that Fine.v speaks of. Bounds are generous. *)
Require Import Reals ZArith Lia Lra Bool List.
From Flocq Require Import Core BinarySingleNaN.
Require Import StacklessExact.Rounding StacklessExact.Range StacklessExact.Overflow StacklessExact.Arithmetic StacklessExact.Operations.
Require Import StacklessExact.Fine StacklessExact.FineSigns StacklessExact.AgreementFine.
Require StacklessExact.Expansion.
Open Scope R_scope.

(** * Operations *)

Lemma plus_is e {e' e'' x y a b} : fits e' x a -> fits e'' y b -> (0 <= e < 1023 /\ e' <= e /\ e'' <= e)%Z -> fits (e + 1) (Arithmetic.plus f64 x y) (R64 (a + b)).
Proof. intros X Y (H & L & L'). apply (plus_fits e x y a b); [lia|exact (fits_more _ _ _ _ X L)|exact (fits_more _ _ _ _ Y L')]. Qed.
Lemma minus_is e {e' e'' x y a b} : fits e' x a -> fits e'' y b -> (0 <= e < 1023 /\ e' <= e /\ e'' <= e)%Z -> fits (e + 1) (Arithmetic.minus f64 x y) (R64 (a - b)).
Proof. intros X Y (H & L & L'). apply (minus_fits e x y a b); [lia|exact (fits_more _ _ _ _ X L)|exact (fits_more _ _ _ _ Y L')]. Qed.
Lemma times_is {e e' x y a b} : fits e x a -> fits e' y b -> (-1074 <= e + e' <= 1023)%Z -> fits (e + e') (Arithmetic.times f64 x y) (R64 (a * b)).
Proof. intros X Y H. now apply times_fits. Qed.
Lemma opposite_is e x a : fits e x a -> fits e (Arithmetic.opposite f64 x) (- a).
Proof. intros (X & <- & B). cbn. repeat split; [now rewrite is_finite_Bopp|apply B2R_Bopp|now rewrite Rabs_Ropp]. Qed.
Lemma absolute_is e x a : fits e x a -> fits e (Arithmetic.absolute f64 x) (Rabs a).
Proof. intros (X & <- & B). cbn. repeat split; [now rewrite is_finite_Babs|apply B2R_Babs|now rewrite Rabs_Rabsolu]. Qed.
Lemma constant_is n e m : (Z.abs n < 2 ^ 53)%Z -> (-1074 <= e <= 900)%Z -> Rabs (IZR n * bpow radix2 e) <= bpow radix2 m ->
  fits m (Arithmetic.constant f64 n e) (Arithmetic.constant rounded n e).
Proof. intros N E B. destruct (constant_fits n e N E) as [X V]. repeat split; assumption. Qed.
Lemma power_fits e : (-1074 <= e <= 900)%Z -> fits e (Arithmetic.constant f64 1 e) (bpow radix2 e).
Proof. intros E. rewrite <- power_is. apply constant_is; [reflexivity|exact E|]. rewrite Rmult_1_l, Rabs_pos_eq by apply bpow_ge_0. apply Rle_refl. Qed.
Lemma zero_fits e : fits e (Arithmetic.constant f64 0 0) 0.
Proof. rewrite <- zero_is. apply constant_is; [reflexivity|lia|]. rewrite Rmult_0_l, Rabs_R0. apply bpow_ge_0. Qed.
Lemma equal_is e e' x y a b : fits e x a -> fits e' y b -> Arithmetic.equal f64 x y = Req_bool a b.
Proof. intros (X & <- & _) (Y & <- & _). exact (Beqb_correct 53 1024 x y X Y). Qed.
Lemma less_is e e' x y a b : fits e x a -> fits e' y b -> Arithmetic.less f64 x y = Rlt_bool a b.
Proof. intros (X & <- & _) (Y & <- & _). exact (Bltb_correct 53 1024 x y X Y). Qed.

Lemma two_sum_fits e {e' e'' x y a b} : fits e' x a -> fits e'' y b -> (0 <= e < 1018 /\ e' <= e /\ e'' <= e)%Z ->
  fits (e + 1) (fst (sum_two_sum f64 x y)) (fst (Expansion.two_sum a b)) /\ fits (e + 5) (snd (sum_two_sum f64 x y)) (snd (Expansion.two_sum a b)).
Proof.
  intros X Y (H & L & L'). apply fits_more with (e' := e) in X, Y; try lia. unfold sum_two_sum, Expansion.two_sum. cbv zeta. cbn [fst snd].
  pose proof (plus_is e X Y ltac:(lia)) as S.
  pose proof (minus_is (e + 1) S X ltac:(lia)) as B.
  pose proof (minus_is (e + 2) S B ltac:(lia)) as A.
  pose proof (minus_is (e + 3) X A ltac:(lia)) as C.
  pose proof (minus_is (e + 2) Y B ltac:(lia)) as D.
  split; [exact S|]. exact (fits_more _ (e + 5) _ _ (plus_is (e + 4) C D ltac:(lia)) ltac:(lia)).
Qed.

Lemma split_fits e x a : (0 <= e <= 900)%Z -> fits e x a ->
  fits (e + 30) (fst (sum_split f64 x)) (fst (Expansion.split a)) /\ fits (e + 31) (snd (sum_split f64 x)) (snd (Expansion.split a)).
Proof.
  intros H X. unfold sum_split, Expansion.split. cbv zeta. cbn [fst snd].
  assert (K : fits 28 (Arithmetic.constant f64 134217729 0) 134217729).
  { replace 134217729 with (Arithmetic.constant rounded 134217729 0) by (cbn; ring). apply constant_is; [reflexivity|lia|]. simpl bpow. rewrite Rmult_1_r, Rabs_pos_eq by lra. lra. }
  pose proof (times_is K X ltac:(lia)) as S. pose proof (minus_is (28 + e) S X ltac:(lia)) as D.
  pose proof (minus_is (28 + e + 1) S D ltac:(lia)) as T.
  pose proof (minus_is (28 + e + 1 + 1) X T ltac:(lia)) as U.
  split; [exact (fits_more _ (e + 30) _ _ T ltac:(lia))|exact (fits_more _ (e + 31) _ _ U ltac:(lia))].
Qed.

Lemma two_product_fits e e' x y a b : (0 <= e)%Z -> (0 <= e')%Z -> (e + e' <= 900)%Z -> fits e x a -> fits e' y b ->
  fits (e + e') (fst (sum_two_product f64 x y)) (fst (Expansion.two_product a b)) /\
  fits (e + e' + 64) (snd (sum_two_product f64 x y)) (snd (Expansion.two_product a b)).
Proof.
  intros H H' L X Y. unfold sum_two_product, Expansion.two_product. destruct (split_fits e x a ltac:(lia) X) as [X1 X0]. destruct (split_fits e' y b ltac:(lia) Y) as [Y1 Y0].
  destruct (sum_split f64 x) as [x1 x0], (Expansion.split a) as [a1 a0], (sum_split f64 y) as [y1 y0], (Expansion.split b) as [b1 b0]. cbn [fst snd] in *. cbv zeta. cbn [fst snd].
  set (p := (e + e')%Z) in *. assert (Hp : (p = e + e')%Z) by reflexivity.
  pose proof (times_is X Y ltac:(lia)) as P. fold p in P.
  pose proof (times_is X1 Y1 ltac:(lia)) as P11. pose proof (times_is X0 Y1 ltac:(lia)) as P01.
  pose proof (times_is X1 Y0 ltac:(lia)) as P10. pose proof (times_is X0 Y0 ltac:(lia)) as P00.
  pose proof (minus_is (p + 60) P P11 ltac:(lia)) as Q1.
  pose proof (minus_is (p + 61) Q1 P01 ltac:(lia)) as Q2.
  pose proof (minus_is (p + 62) Q2 P10 ltac:(lia)) as Q3.
  pose proof (minus_is (p + 63) P00 Q3 ltac:(lia)) as Q4.
  split; [exact P|]. exact (fits_more _ (p + 64) _ _ Q4 ltac:(lia)).
Qed.

(** * Numbers of twice the digits *)

(** The three doubles are finite, are those of [x], and at most 2^e. *)
Definition fine_fits (e : Z) (p : num f64 * num f64 * num f64) (x : fine) : Prop :=
  let '(h, l, r) := p in fits e h (high x) /\ fits e l (low x) /\ fits e r (radius x).

Lemma fine_more e e' p x : (e <= e')%Z -> fine_fits e p x -> fine_fits e' p x.
Proof. destruct p as [[h l] r]. intros L (H & H' & H''). repeat split; try (eapply fits_more; [eassumption|exact L]). Qed.

Lemma up_fits : fits 1 (fine_UP f64) UP.
Proof. rewrite <- up_is. unfold fine_UP. rewrite !power_is. exact (plus_is 0 (power_fits 0 ltac:(lia)) (power_fits (-48) ltac:(lia)) ltac:(lia)). Qed.

Lemma new_fits e e' h l r h' l' r' : (0 <= e < 1018)%Z -> fits e h h' -> fits e l l' -> (0 <= e' <= 1000)%Z -> fits e' r r' -> (e' + 1 <= e + 5)%Z ->
  fine_fits (e + 5) (Fine_new f64 h l r) (new h' l' r').
Proof.
  intros E H L E' R K. unfold Fine_new, new. destruct (two_sum_fits e H L ltac:(lia)) as [S T].
  destruct (sum_two_sum f64 h l) as [s t], (Expansion.two_sum h' l') as [s' t']. cbn [fst snd] in *. unfold fine_fits. cbn [high low radius].
  split; [exact (fits_more _ (e + 5) _ _ S ltac:(lia))|]. split; [exact T|].
  exact (fits_more _ (e + 5) _ _ (times_is R up_fits ltac:(lia)) K).
Qed.

Lemma add_fits e h l r h' l' r' x y : (0 <= e <= 900)%Z -> fine_fits e (h, l, r) x -> fine_fits e (h', l', r') y -> fine_fits (e + 21) (Fine_add f64 h l r h' l' r') (add x y).
Proof.
  intros E (H & L & R) (H' & L' & R'). unfold Fine_add, add.
  destruct (two_sum_fits e H H' ltac:(lia)) as [A1 A2]. destruct (two_sum_fits e L L' ltac:(lia)) as [B1 B2].
  destruct (sum_two_sum f64 h h') as [a rest], (Expansion.two_sum (high x) (high y)) as [a' rest'], (sum_two_sum f64 l l') as [b least], (Expansion.two_sum (low x) (low y)) as [b' least'].
  cbn [fst snd] in *. destruct (two_sum_fits (e + 5) A2 B1 ltac:(lia)) as [C1 C2].
  destruct (sum_two_sum f64 rest b) as [c lost], (Expansion.two_sum rest' b') as [c' lost']. cbn [fst snd] in *.
  destruct (two_sum_fits (e + 6) A1 C1 ltac:(lia)) as [D1 D2].
  destruct (sum_two_sum f64 a c) as [v w], (Expansion.two_sum a' c') as [v' w']. cbn [fst snd] in *.
  pose proof (plus_is e R R' ltac:(lia)) as Q.
  pose proof (times_is (absolute_is _ _ _ D1) (power_fits (-102) ltac:(lia)) ltac:(lia)) as M. fold ERROR in M.
  pose proof (plus_is (e + 7) Q M ltac:(lia)) as Q'.
  pose proof (plus_is (e + 11) D2 B2 ltac:(lia)) as W.
  pose proof (new_fits (e + 12) (e + 8) _ _ _ _ _ _ ltac:(lia) (fits_more _ (e + 12) _ _ D1 ltac:(lia)) (fits_more _ (e + 12) _ _ W ltac:(lia)) ltac:(lia)
    (fits_more _ (e + 8) _ _ Q' ltac:(lia)) ltac:(lia)) as N.
  cbv zeta. rewrite (equal_is _ 0 _ _ _ _ C2 (zero_fits 0)), (equal_is _ 0 _ _ _ _ B2 (zero_fits 0)).
  destruct (Fine_new f64 _ _ _) as [[n n'] n'']. destruct (andb _ _); [|apply (fine_more (e + 12 + 5)); [lia|exact N]].
  split; [|split]; cbn [high low radius]; [exact (fits_more _ (e + 21) _ _ D1 ltac:(lia))|exact (fits_more _ (e + 21) _ _ D2 ltac:(lia))|].
  exact (fits_more _ (e + 21) _ _ (times_is Q up_fits ltac:(lia)) ltac:(lia)).
Qed.

Lemma neg_fits e h l r x : fine_fits e (h, l, r) x -> fine_fits e (Fine_neg f64 h l r) (neg x).
Proof. intros (H & L & R). split; [|split]; [now apply opposite_is..|exact R]. Qed.

Lemma sub_fits e h l r h' l' r' x y : (0 <= e <= 900)%Z -> fine_fits e (h, l, r) x -> fine_fits e (h', l', r') y -> fine_fits (e + 21) (Fine_sub f64 h l r h' l' r') (sub x y).
Proof.
  intros E X Y. unfold Fine_sub, sub. apply neg_fits in Y. destruct (Fine_neg f64 h' l' r') as [[n n'] n'']. pose proof (add_fits _ _ _ _ _ _ _ _ _ E X Y) as A.
  destruct (Fine_add f64 _ _ _ _ _ _) as [[a a'] a'']. exact A.
Qed.

Lemma mul_fits e e' h l r h' l' r' x y : (0 <= e)%Z -> (0 <= e')%Z -> (e + e' <= 900)%Z -> fine_fits e (h, l, r) x -> fine_fits e' (h', l', r') y ->
  fine_fits (e + e' + 70) (Fine_mul f64 h l r h' l' r') (mul x y).
Proof.
  intros E E' T (H & L & R) (H' & L' & R'). unfold Fine_mul, mul, is_zero, are_doubles, is_exact.
  destruct (two_product_fits e e' _ _ _ _ E E' T H H') as [P Q]. destruct (sum_two_product f64 h h') as [p rest], (Expansion.two_product (high x) (high y)) as [p' rest']. cbn [fst snd] in *.
  set (k := (e + e')%Z) in *. assert (Hk : (k = e + e')%Z) by reflexivity.
  pose proof (times_is H L' ltac:(lia)) as HL. pose proof (times_is L H' ltac:(lia)) as LH.
  pose proof (plus_is k HL LH ltac:(lia)) as C. pose proof (plus_is (k + 64) Q C ltac:(lia)) as W.
  pose proof (times_is (absolute_is _ _ _ H) R' ltac:(lia)) as R1.
  pose proof (times_is (absolute_is _ _ _ H') R ltac:(lia)) as R2. pose proof (times_is R R' ltac:(lia)) as R3.
  pose proof (plus_is k R1 R2 ltac:(lia)) as S1. pose proof (plus_is (k + 1) S1 R3 ltac:(lia)) as S2.
  pose proof (times_is S2 up_fits ltac:(lia)) as S3.
  pose proof (times_is (absolute_is _ _ _ P) (power_fits (-102) ltac:(lia)) ltac:(lia)) as M. fold ERROR in M.
  pose proof (plus_is (k + 3) S3 M ltac:(lia)) as S4.
  pose proof (plus_is (k + 4) S4 (power_fits (-1060) ltac:(lia)) ltac:(lia)) as S5. fold UNDERFLOW in S5.
  pose proof (new_fits (k + 65) (k + 5) _ _ _ _ _ _ ltac:(lia) (fits_more _ (k + 65) _ _ P ltac:(lia)) (fits_more _ (k + 65) _ _ W ltac:(lia)) ltac:(lia) (fits_more _ (k + 5) _ _ S5 ltac:(lia)) ltac:(lia)) as N.
  cbv zeta. rewrite (equal_is _ 0 _ _ _ _ H (zero_fits 0)), (equal_is _ 0 _ _ _ _ R (zero_fits 0)), (equal_is _ 0 _ _ _ _ H' (zero_fits 0)), (equal_is _ 0 _ _ _ _ R' (zero_fits 0)),
    (equal_is _ 0 _ _ _ _ L (zero_fits 0)), (equal_is _ 0 _ _ _ _ L' (zero_fits 0)), (less_is _ _ _ _ _ _ (power_fits (-900) ltac:(lia)) (absolute_is _ _ _ P)). fold EXACT.
  destruct (Fine_new f64 _ _ _) as [[n n'] n'']. destruct (orb _ _); [split; [|split]; apply zero_fits|].
  destruct (andb _ _); [|apply (fine_more (k + 65 + 5)); [lia|exact N]].
  split; [|split]; cbn [high low radius]; [exact (fits_more _ (k + 70) _ _ P ltac:(lia))|exact (fits_more _ (k + 70) _ _ Q ltac:(lia))|apply zero_fits].
Qed.

(** The sign that is told is the same. *)
Lemma sign_fits e h l r x : (0 <= e <= 1000)%Z -> fine_fits e (h, l, r) x -> option_map B2R (Fine_sign f64 h l r) = sign x.
Proof.
  intros E (H & L & R). unfold Fine_sign, sign, is_zero, is_exact.
  pose proof (plus_is e (absolute_is _ _ _ L) R ltac:(lia)) as S. pose proof (times_is S up_fits ltac:(lia)) as T.
  cbv zeta. rewrite (equal_is _ 0 _ _ _ _ H (zero_fits 0)), (equal_is _ 0 _ _ _ _ R (zero_fits 0)), (less_is _ _ _ _ _ _ T (absolute_is _ _ _ H)).
  rewrite (andb_comm (Req_bool (high x) 0)). destruct (orb _ _); [|reflexivity]. cbn [option_map]. f_equal. apply H.
Qed.

(** * The sign of an edge function *)

Lemma two_fits e a a' x : fits e a (fst x) -> fits e a' (snd x) -> fine_fits e (a, a', Arithmetic.constant f64 0 0) (of_two x).
Proof. intros A A'. split; [exact A|split; [exact A'|apply zero_fits]]. Qed.

(** A term is there if the component is not 0. *)
Lemma term_fits e d d' s s' s'' a a' a'' x y : fits 200 d d' -> fine_fits e (s, s', s'') x -> fine_fits e (a, a', a'') y ->
  let is := negb (Arithmetic.equal f64 d (Arithmetic.constant f64 0 0)) in
  fine_fits e (if is then a else s, if is then a' else s', if is then a'' else s'') (if Req_bool d' 0 then x else y).
Proof. intros D S A. cbv zeta. rewrite (equal_is _ 0 _ _ _ _ D (zero_fits 0)). now destruct (Req_bool d' 0). Qed.

Lemma product_fits a a' b b' c c' f f' x y z w : fine_fits 205 (a, a', Arithmetic.constant f64 0 0) x -> fine_fits 205 (b, b', Arithmetic.constant f64 0 0) y ->
  fine_fits 205 (c, c', Arithmetic.constant f64 0 0) z -> fine_fits 205 (f, f', Arithmetic.constant f64 0 0) w ->
  let zero := Arithmetic.constant f64 0 0 in
  let '(m, m', m'') := Fine_mul f64 a a' zero b b' zero in
  let '(n, n', n'') := Fine_mul f64 c c' zero f f' zero in
  fine_fits 501 (Fine_sub f64 m m' m'' n n' n'') (sub (mul x y) (mul z w)).
Proof.
  intros X Y Z W. cbv zeta. pose proof (mul_fits 205 205 _ _ _ _ _ _ _ _ ltac:(lia) ltac:(lia) ltac:(lia) X Y) as M.
  pose proof (mul_fits 205 205 _ _ _ _ _ _ _ _ ltac:(lia) ltac:(lia) ltac:(lia) Z W) as N.
  destruct (Fine_mul f64 a a' _ b b' _) as [[m m'] m'']. destruct (Fine_mul f64 c c' _ f f' _) as [[n n'] n''].
  exact (sub_fits 480 _ _ _ _ _ _ _ _ ltac:(lia) M N).
Qed.

(** [volume], for components of at most 2^200 and numbers of at most 2^205. [EXACT-10] *)
Theorem volume_fits dx dy dz ax ax' ay ay' az az' bx bx' by_ by' bz bz' x y z a b c k l m :
  fits 200 dx x -> fits 200 dy y -> fits 200 dz z ->
  fits 205 ax (fst a) -> fits 205 ax' (snd a) -> fits 205 ay (fst b) -> fits 205 ay' (snd b) -> fits 205 az (fst c) -> fits 205 az' (snd c) ->
  fits 205 bx (fst k) -> fits 205 bx' (snd k) -> fits 205 by_ (fst l) -> fits 205 by' (snd l) -> fits 205 bz (fst m) -> fits 205 bz' (snd m) ->
  option_map B2R (fine_volume f64 dx dy dz ax ax' ay ay' az az' bx bx' by_ by' bz bz') = volume x y z (a, b, c) (k, l, m).
Proof.
  intros X Y Z A A' B B' C C' K K' L L' M M'. pose proof (two_fits _ _ _ _ A A') as Fa. pose proof (two_fits _ _ _ _ B B') as Fb. pose proof (two_fits _ _ _ _ C C') as Fc.
  pose proof (two_fits _ _ _ _ K K') as Fk. pose proof (two_fits _ _ _ _ L L') as Fl. pose proof (two_fits _ _ _ _ M M') as Fm.
  pose proof (product_fits _ _ _ _ _ _ _ _ _ _ _ _ Fb Fm Fc Fl) as P1. pose proof (product_fits _ _ _ _ _ _ _ _ _ _ _ _ Fc Fk Fa Fm) as P2.
  pose proof (product_fits _ _ _ _ _ _ _ _ _ _ _ _ Fa Fl Fb Fk) as P3. cbv zeta in P1, P2, P3.
  assert (One : forall d v p p' p'' q, fits 200 d v -> fine_fits 501 (p, p', p'') q ->
    fine_fits 771 (Fine_mul f64 d (Arithmetic.constant f64 0 0) (Arithmetic.constant f64 0 0) p p' p'') (mul (exact v) q)).
  { intros d v p p' p'' q D Q. apply (mul_fits 200 501); try lia; [|exact Q]. split; [exact D|split; apply zero_fits]. }
  unfold fine_volume, volume, add_term.
  destruct (Fine_mul f64 ay ay' _ bz bz' _) as [[m1 m1'] m1'']. destruct (Fine_mul f64 az az' _ by_ by' _) as [[n1 n1'] n1''].
  destruct (Fine_sub f64 m1 m1' m1'' n1 n1' n1'') as [[s1 s1'] s1'']. apply (One _ _ _ _ _ _ X) in P1. destruct (Fine_mul f64 dx _ _ s1 s1' s1'') as [[t1 t1'] t1''].
  destruct (Fine_mul f64 az az' _ bx bx' _) as [[m2 m2'] m2'']. destruct (Fine_mul f64 ax ax' _ bz bz' _) as [[n2 n2'] n2''].
  destruct (Fine_sub f64 m2 m2' m2'' n2 n2' n2'') as [[s2 s2'] s2'']. apply (One _ _ _ _ _ _ Y) in P2. destruct (Fine_mul f64 dy _ _ s2 s2' s2'') as [[t2 t2'] t2''].
  destruct (Fine_mul f64 ax ax' _ by_ by' _) as [[m3 m3'] m3'']. destruct (Fine_mul f64 ay ay' _ bx bx' _) as [[n3 n3'] n3''].
  destruct (Fine_sub f64 m3 m3' m3'' n3 n3' n3'') as [[s3 s3'] s3'']. apply (One _ _ _ _ _ _ Z) in P3. destruct (Fine_mul f64 dz _ _ s3 s3' s3'') as [[t3 t3'] t3''].
  set (q1 := mul (exact x) _) in *. set (q2 := mul (exact y) _) in *. set (q3 := mul (exact z) _) in *.
  assert (S0 : forall e, fine_fits e (Arithmetic.constant f64 0 0, Arithmetic.constant f64 0 0, Arithmetic.constant f64 0 0) (exact 0)) by (intros e; split; [|split]; apply zero_fits).
  pose proof (add_fits 771 _ _ _ _ _ _ _ _ ltac:(lia) (S0 771%Z) P1) as A1. destruct (Fine_add f64 _ _ _ t1 t1' t1'') as [[a1 a1'] a1''].
  pose proof (term_fits _ _ _ _ _ _ _ _ _ _ _ X (S0 _) A1) as T1. cbv zeta in T1. cbv zeta.
  set (c1 := negb (Arithmetic.equal f64 dx _)) in *. set (f1 := if c1 then a1 else _) in *. set (f1' := if c1 then a1' else _) in *. set (f1'' := if c1 then a1'' else _) in *.
  pose proof (add_fits 792 _ _ _ _ _ _ _ _ ltac:(lia) T1 (fine_more 771 792 _ _ ltac:(lia) P2)) as A2. destruct (Fine_add f64 f1 f1' f1'' t2 t2' t2'') as [[a2 a2'] a2''].
  pose proof (term_fits _ _ _ _ _ _ _ _ _ _ _ Y (fine_more 792 813 _ _ ltac:(lia) T1) A2) as T2. cbv zeta in T2.
  set (c2 := negb (Arithmetic.equal f64 dy _)) in *. set (f2 := if c2 then a2 else _) in *. set (f2' := if c2 then a2' else _) in *. set (f2'' := if c2 then a2'' else _) in *.
  pose proof (add_fits 813 _ _ _ _ _ _ _ _ ltac:(lia) T2 (fine_more 771 813 _ _ ltac:(lia) P3)) as A3. destruct (Fine_add f64 f2 f2' f2'' t3 t3' t3'') as [[a3 a3'] a3''].
  pose proof (term_fits _ _ _ _ _ _ _ _ _ _ _ Z (fine_more 813 834 _ _ ltac:(lia) T2) A3) as T3. cbv zeta in T3.
  exact (sign_fits 834 _ _ _ _ ltac:(lia) T3).
Qed.

(** A finite double of at most 2^200. *)
Definition usual (x : num f64) : Prop := BinarySingleNaN.is_finite x = true /\ Rabs (B2R x) <= bpow radix2 200.

(** The sign of an edge function as the code finds it on IEEE doubles, if it tells one. Nothing overflows. [EXACT-2, EXACT-10] *)
Theorem edge_on_doubles_is_right dx dy dz ox oy oz fx fy fz tx ty tz s : Forall usual (dx :: dy :: dz :: nil) -> Forall usual (ox :: oy :: oz :: nil) ->
  Forall usual (fx :: fy :: fz :: nil) -> Forall usual (tx :: ty :: tz :: nil) ->
  let '(px, px', py, py', pz, pz') := predicates_minus f64 tx ty tz fx fy fz in
  let '(qx, qx', qy, qy', qz, qz') := predicates_minus f64 fx fy fz ox oy oz in
  let v (x : num f64) := B2R x in
  let truth := v dx * ((v ty - v oy) * (v fz - v oz) - (v tz - v oz) * (v fy - v oy)) + v dy * ((v tz - v oz) * (v fx - v ox) - (v tx - v ox) * (v fz - v oz)) +
    v dz * ((v tx - v ox) * (v fy - v oy) - (v ty - v oy) * (v fx - v ox)) in
  fine_volume f64 dx dy dz px px' py py' pz pz' qx qx' qy qy' qz qz' = Some s -> (0 < truth <-> 0 < v s) /\ (truth < 0 <-> v s < 0) /\ (truth = 0 <-> v s = 0).
Proof.
  assert (All : forall x y z, Forall usual (x :: y :: z :: nil) -> fits 200 x (B2R x) /\ fits 200 y (B2R y) /\ fits 200 z (B2R z)).
  { intros x y z H. inversion_clear H as [|? ? [X X'] H']. inversion_clear H' as [|? ? [Y Y'] H]. inversion_clear H as [|? ? [Z Z'] _]. repeat split; assumption. }
  assert (Fv : forall x : num f64, generic_format radix2 (FLT_exp (-1074) 53) (B2R x)) by (intros x; exact (generic_format_B2R 53 1024 x)).
  intros D O A B. apply All in D as (D1 & D2 & D3), O as (O1 & O2 & O3), A as (A1 & A2 & A3), B as (B1 & B2 & B3).
  pose proof (edge_is_right (B2R dx) (B2R dy) (B2R dz) (B2R ox) (B2R oy) (B2R oz) (B2R fx) (B2R fy) (B2R fz) (B2R tx) (B2R ty) (B2R tz) (B2R s)
    ltac:(repeat constructor; apply Fv) ltac:(repeat constructor; apply Fv) ltac:(repeat constructor; apply Fv) ltac:(repeat constructor; apply Fv)) as H.
  unfold predicates_minus. unfold edge, Expansion.difference in H.
  assert (Two : forall x y a b, fits 200 x a -> fits 200 y b -> fits 205 (fst (sum_two_sum f64 x (Arithmetic.opposite f64 y))) (fst (Expansion.two_sum a (- b))) /\
    fits 205 (snd (sum_two_sum f64 x (Arithmetic.opposite f64 y))) (snd (Expansion.two_sum a (- b)))).
  { intros x y a b X Y. destruct (two_sum_fits 200 X (opposite_is _ _ _ Y) ltac:(lia)) as [S T]. split; [exact (fits_more _ 205 _ _ S ltac:(lia))|exact T]. }
  destruct (Two _ _ _ _ B1 A1) as [P1 P1']. destruct (Two _ _ _ _ B2 A2) as [P2 P2']. destruct (Two _ _ _ _ B3 A3) as [P3 P3'].
  destruct (Two _ _ _ _ A1 O1) as [Q1 Q1']. destruct (Two _ _ _ _ A2 O2) as [Q2 Q2']. destruct (Two _ _ _ _ A3 O3) as [Q3 Q3'].
  pose proof (volume_fits _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ D1 D2 D3 P1 P1' P2 P2' P3 P3' Q1 Q1' Q2 Q2' Q3 Q3') as V. rewrite <- V in H.
  destruct (sum_two_sum f64 tx _), (sum_two_sum f64 ty _), (sum_two_sum f64 tz _), (sum_two_sum f64 fx _), (sum_two_sum f64 fy _), (sum_two_sum f64 fz _).
  cbn [fst snd] in H. cbv zeta. intros E. rewrite E in H. now apply H.
Qed.
