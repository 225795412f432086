(** A triangle as seen from a point, and the fan from a direction to its edges: WINDING-1. Points are relative to the one that sees. *)
Require Import Reals ZArith Lia Lra List Bool.
From Flocq Require Import Core.
Require Import StacklessExact.Filter StacklessExact.Parity StacklessExact.Chains.
Import ListNotations.
Open Scope R_scope.

Definition vol (u v w : vec) : R := dot3 u (cross3 v w).
Definition opposite (v : vec) : vec := scale (-1) v.

(** * Signs *)

Lemma sign_cases x : x < 0 /\ sign x = (-1)%Z \/ x = 0 /\ sign x = 0%Z \/ 0 < x /\ sign x = 1%Z.
Proof. unfold sign. cbn. destruct (Rlt_dec x 0); [now left|]. destruct (Rlt_dec 0 x); right; [now right|left; split; [lra|reflexivity]]. Qed.

Lemma sign_is x y : (0 < x <-> 0 < y) -> (x < 0 <-> y < 0) -> sign x = sign y.
Proof. intros P N. destruct (sign_cases x) as [(A & ->)|[(A & ->)|(A & ->)]], (sign_cases y) as [(B & ->)|[(B & ->)|(B & ->)]]; try reflexivity; exfalso; intuition lra. Qed.

Lemma sign_opp x : sign (- x) = (- sign x)%Z.
Proof. destruct (sign_cases x) as [(A & ->)|[(A & ->)|(A & ->)]], (sign_cases (- x)) as [(B & ->)|[(B & ->)|(B & ->)]]; try reflexivity; lra. Qed.

Lemma sign_mul x y : sign (x * y) = (sign x * sign y)%Z.
Proof.
  assert (P : forall x y, 0 < x -> 0 < y -> 0 < x * y) by (intros; now apply Rmult_lt_0_compat).
  destruct (sign_cases x) as [(A & ->)|[(A & ->)|(A & ->)]], (sign_cases y) as [(B & ->)|[(B & ->)|(B & ->)]], (sign_cases (x * y)) as [(C & ->)|[(C & ->)|(C & ->)]];
    try reflexivity; exfalso; try (subst; lra); try (subst; rewrite Rmult_0_l in C; lra); try (subst; rewrite Rmult_0_r in C; lra);
    try (pose proof (P x y); lra); try (pose proof (P (- x) y); lra); try (pose proof (P x (- y)); lra); try (pose proof (P (- x) (- y)); lra).
Qed.

Lemma sign_0 x : sign x = 0%Z <-> x = 0.
Proof. destruct (sign_cases x) as [(A & ->)|[(A & ->)|(A & ->)]]; split; intros; try discriminate; try reflexivity; try assumption; exfalso; lra. Qed.

Definition signs : list Z := [(-1)%Z; 0%Z; 1%Z].
Lemma sign_in x : In (sign x) signs.
Proof. destruct (sign_cases x) as [(_ & ->)|[(_ & ->)|(_ & ->)]]; cbn; auto. Qed.

(** What three numbers with these signs need to add up to 0. *)
Definition may_vanish (a b c : Z) : bool :=
  ((a =? 0) && (b =? 0) && (c =? 0) || ((a =? 1) || (b =? 1) || (c =? 1)) && ((a =? -1) || (b =? -1) || (c =? -1)))%Z.

Lemma vanishes x y z : x + y + z = 0 -> may_vanish (sign x) (sign y) (sign z) = true.
Proof.
  intros H. destruct (sign_cases x) as [(A & ->)|[(A & ->)|(A & ->)]], (sign_cases y) as [(B & ->)|[(B & ->)|(B & ->)]], (sign_cases z) as [(C & ->)|[(C & ->)|(C & ->)]];
    try reflexivity; exfalso; lra.
Qed.

(** * Cones *)

Definition agree (a b c d : Z) : Z := if ((a =? b) && (b =? c) && (c =? d))%Z then a else 0%Z.

(** How often the triangle (u, v, w) covers the direction x: 1 or -1 by its orientation if x is between u, v and w, and 0 if not. *)
Definition spans (u v w x : vec) : Z := agree (sign (vol u v w)) (sign (vol x v w)) (sign (vol x w u)) (sign (vol x u v)).

(** A direction is not on an edge, by signs and by numbers: in its plane, but between its ends. *)
Definition off_edge (d y z w : Z) : bool := (negb ((y =? 0) && (d * z =? 1) && (d * w =? 1)))%Z.
Definition off_edges (v a b c : vec) : Prop := let d := vol a b c in
  (vol v b c = 0 -> ~ (0 < d * vol v c a /\ 0 < d * vol v a b)) /\ (vol v c a = 0 -> ~ (0 < d * vol v b c /\ 0 < d * vol v a b)) /\
  (vol v a b = 0 -> ~ (0 < d * vol v b c /\ 0 < d * vol v c a)).

Lemma off_edge_is d y z w : (y = 0 -> ~ (0 < d * z /\ 0 < d * w)) -> off_edge (sign d) (sign y) (sign z) (sign w) = true.
Proof.
  intros H. unfold off_edge. rewrite <- !sign_mul. destruct (sign_cases y) as [(A & ->)|[(A & ->)|(A & ->)]]; try reflexivity. specialize (H A).
  destruct (sign_cases (d * z)) as [(B & ->)|[(B & ->)|(B & ->)]], (sign_cases (d * w)) as [(C & ->)|[(C & ->)|(C & ->)]]; try reflexivity. exfalso. now apply H.
Qed.

(** All signs that the determinants of five vectors may have. *)
Definition key (d ea eb ec xa xb xc ha hb hc : Z) : bool := (implb
  (negb ((d =? 0) || (ha =? 0) || (hb =? 0) || (hc =? 0)) &&
    off_edge d xa xb xc && off_edge d xb xa xc && off_edge d xc xa xb && off_edge d ea eb ec && off_edge d eb ea ec && off_edge d ec ea eb &&
    may_vanish (ea * ha) (eb * hb) (ec * hc) && may_vanish (xa * ha) (xb * hb) (xc * hc) &&
    may_vanish (d * ha) (- (eb * xc)) (ec * xb) && may_vanish (d * hb) (- (ec * xa)) (ea * xc) && may_vanish (d * hc) (- (ea * xb)) (eb * xa))
  (agree d xa xb xc - agree d ea eb ec =? agree (- ec) xc (- hb) ha + agree (- ea) xa (- hc) hb + agree (- eb) xb (- ha) hc))%Z.

Definition all (f : Z -> bool) : bool := forallb f signs.
Lemma all_signs f : all f = true -> forall x, f (sign x) = true.
Proof. intros H x. exact (proj1 (forallb_forall f signs) H _ (sign_in x)). Qed.

Lemma key_holds : all (fun d => all (fun ea => all (fun eb => all (fun ec => all (fun xa => all (fun xb => all (fun xc => all (fun ha => all (fun hb => all (fun hc =>
  key d ea eb ec xa xb xc ha hb hc)))))))))) = true.
Proof. vm_compute. reflexivity. Qed.

Ltac volumes := unfold vol, opposite in *; vectors.

(** One triangle covers a direction x as often as e and the fan from -e to its three edges together. No vertex is in the plane of e and x, and
    neither is on an edge. [WINDING-1](2) *)
Theorem triangle_is_fan a b c e x : vol a b c <> 0 -> vol e x a <> 0 -> vol e x b <> 0 -> vol e x c <> 0 -> off_edges x a b c -> off_edges e a b c ->
  let fan u v := spans (opposite e) u v x in (spans a b c x - spans a b c e = fan a b + fan b c + fan c a)%Z.
Proof.
  intros D Ha Hb Hc (Xa & Xb & Xc) (Ea & Eb & Ec) fan. unfold fan, spans. clear fan.
  replace (vol (opposite e) a b) with (- vol e a b) by (volumes; ring). replace (vol (opposite e) b c) with (- vol e b c) by (volumes; ring). replace (vol (opposite e) c a) with (- vol e c a) by (volumes; ring).
  assert (T : forall p, vol x p (opposite e) = - vol e x p /\ vol x (opposite e) p = vol e x p) by (intros; split; volumes; ring).
  rewrite (proj1 (T a)), (proj1 (T b)), (proj1 (T c)), (proj2 (T a)), (proj2 (T b)), (proj2 (T c)), !sign_opp. clear T.
  assert (R1 : vol e b c * vol e x a + vol e c a * vol e x b + vol e a b * vol e x c = 0) by (volumes; ring).
  assert (R2 : vol x b c * vol e x a + vol x c a * vol e x b + vol x a b * vol e x c = 0) by (volumes; ring).
  assert (R3 : vol a b c * vol e x a + - (vol e c a * vol x a b) + vol e a b * vol x c a = 0) by (volumes; ring).
  assert (R4 : vol a b c * vol e x b + - (vol e a b * vol x b c) + vol e b c * vol x a b = 0) by (volumes; ring).
  assert (R5 : vol a b c * vol e x c + - (vol e b c * vol x c a) + vol e c a * vol x b c = 0) by (volumes; ring).
  apply vanishes in R1, R2, R3, R4, R5. rewrite ?sign_opp, ?sign_mul in *.
  set (d := vol a b c) in *. set (ea := vol e b c) in *. set (eb := vol e c a) in *. set (ec := vol e a b) in *. set (xa := vol x b c) in *. set (xb := vol x c a) in *. set (xc := vol x a b) in *.
  set (ha := vol e x a) in *. set (hb := vol e x b) in *. set (hc := vol e x c) in *.
  assert (N : forall y, y <> 0 -> (sign y =? 0)%Z = false) by (intros y Y; apply Z.eqb_neq; now rewrite sign_0).
  apply off_edge_is in Xa, Xb, Xc, Ea, Eb, Ec.
  pose proof key_holds as K. apply all_signs with (x := d) in K. apply all_signs with (x := ea) in K. apply all_signs with (x := eb) in K. apply all_signs with (x := ec) in K.
  apply all_signs with (x := xa) in K. apply all_signs with (x := xb) in K. apply all_signs with (x := xc) in K. apply all_signs with (x := ha) in K. apply all_signs with (x := hb) in K. apply all_signs with (x := hc) in K.
  unfold key in K. rewrite !N, Xa, Xb, Xc, Ea, Eb, Ec, R1, R2, R3, R4, R5 in K by assumption. now apply Z.eqb_eq in K.
Qed.

(** * Lines *)

Definition line_key (s k k' ha hb h1 : Z) : bool :=
  let G h := if ((k =? k') && (k * h1 =? -1))%Z then (- k * Z.b2z (k * h =? 1))%Z else 0%Z in
  implb (negb ((ha =? 0) || (hb =? 0))%Z && may_vanish hb (- ha) (- (s * h1))) (agree (s * k) (s * k') (- hb) ha =? G hb - G ha)%Z.

Lemma line_key_holds : all (fun s => all (fun k => all (fun k' => all (fun ha => all (fun hb => all (fun h1 => line_key s k k' ha hb h1)))))) = true.
Proof. vm_compute. reflexivity. Qed.

(** What the fan adds up to from the begin of a line along w to a point of it. *)
Definition up_to (f x w p : vec) : Z :=
  let k := sign (vol f p w) in
  if ((k =? sign (vol x p w)) && (k * sign (vol x f w) =? -1))%Z then (- k * Z.b2z (k * sign (vol x f p) =? 1))%Z else 0%Z.

(** So an edge is in the fan what its pieces are together, wherever vertices divide it. [WINDING-1, CLOSED-2] *)
Theorem fan_along f x w a b : w <> zero -> parallel (less b a) w = true -> vol x f a <> 0 -> vol x f b <> 0 -> (spans f a b x = up_to f x w b - up_to f x w a)%Z.
Proof.
  intros W P A B. destruct (multiple _ _ W P) as (s & E). assert (Eb : b = more a (scale s w)).
  { destruct a as [a1 a2 a3], b as [b1 b2 b3], w as [w1 w2 w3]. vectors. injection E as X Y Z. f_equal; lra. }
  clear P E. unfold spans, up_to. subst b. set (b := more a (scale s w)) in *.
  replace (vol f a b) with (s * vol f a w) by (unfold b; volumes; ring). replace (vol x a b) with (s * vol x a w) by (unfold b; volumes; ring).
  replace (vol f b w) with (vol f a w) by (unfold b; volumes; ring). replace (vol x b w) with (vol x a w) by (unfold b; volumes; ring).
  replace (vol x b f) with (- vol x f b) by (volumes; ring). rewrite sign_opp, !sign_mul.
  assert (R : vol x f b + - vol x f a + - (s * vol x f w) = 0) by (unfold b; volumes; ring). apply vanishes in R. rewrite !sign_opp, sign_mul in R.
  pose proof line_key_holds as K. apply all_signs with (x := s) in K. apply all_signs with (x := vol f a w) in K. apply all_signs with (x := vol x a w) in K.
  apply all_signs with (x := vol x f a) in K. apply all_signs with (x := vol x f b) in K. apply all_signs with (x := vol x f w) in K. unfold line_key in K.
  assert (N : forall y, y <> 0 -> (sign y =? 0)%Z = false) by (intros y Y; apply Z.eqb_neq; now rewrite sign_0).
  rewrite !N, R in K by assumption. now apply Z.eqb_eq in K.
Qed.

(** * A triangle that is seen from its own plane *)

Definition plane_key (e x a b c ha hb hc : Z) : bool := (implb
  (((a =? 1) || (b =? 1) || (c =? 1)) && ((a =? -1) || (b =? -1) || (c =? -1)) && negb ((ha =? 0) || (hb =? 0) || (hc =? 0)) && may_vanish (a * ha) (b * hb) (c * hc))
  (agree (- (c * e)) (c * x) (- hb) ha + agree (- (a * e)) (a * x) (- hc) hb + agree (- (b * e)) (b * x) (- ha) hc =? 0))%Z.

Lemma plane_key_holds : all (fun e => all (fun x => all (fun a => all (fun b => all (fun c => all (fun ha => all (fun hb => all (fun hc => plane_key e x a b c ha hb hc)))))))) = true.
Proof. vm_compute. reflexivity. Qed.

Lemma in_plane a b n : n <> zero -> dot3 n a = 0 -> dot3 n b = 0 -> exists s, forall e, vol e a b = s * dot3 e n.
Proof.
  intros N A B. destruct (multiple (cross3 a b) n N) as (s & E).
  - apply same_iff. transitivity (less (scale (dot3 n a) b) (scale (dot3 n b) a)); [vectors; f_equal; ring|]. rewrite A, B. vectors. f_equal; ring.
  - exists s. intros e. unfold vol. rewrite E. vectors. ring.
Qed.

(** The three edges of such a triangle cancel in the fan, unless it is seen from a point of it. [WINDING-1](2) *)
Theorem plane_is_no_fan a b c e x : let n := cross3 (less b a) (less c a) in vol a b c = 0 -> n <> zero ->
  ~ (exists u v, 0 <= u /\ 0 <= v /\ 0 <= 1 - u - v /\ zero = more a (more (scale u (less b a)) (scale v (less c a)))) ->
  vol e x a <> 0 -> vol e x b <> 0 -> vol e x c <> 0 -> let fan u v := spans (opposite e) u v x in (fan a b + fan b c + fan c a = 0)%Z.
Proof.
  intros n D N Off Ha Hb Hc fan. unfold fan, spans. clear fan.
  assert (Na : dot3 n a = 0) by (rewrite <- D; unfold n; volumes; ring). assert (Nb : dot3 n b = 0) by (rewrite <- D; unfold n; volumes; ring). assert (Nc : dot3 n c = 0) by (rewrite <- D; unfold n; volumes; ring).
  destruct (in_plane a b n N Na Nb) as (s3 & S3), (in_plane b c n N Nb Nc) as (s1 & S1), (in_plane c a n N Nc Na) as (s2 & S2).
  assert (Pn : dot3 n n <> 0).
  { intros Z. apply N. clearbody n. destruct n as [n1 n2 n3]. vectors. pose proof (Rle_0_sqr n1) as Q1. pose proof (Rle_0_sqr n2) as Q2. pose proof (Rle_0_sqr n3) as Q3. unfold Rsqr in *.
    assert (Q : forall y, y * y = 0 -> y = 0) by (intros y Y; destruct (Rmult_integral _ _ Y); assumption). f_equal; apply Q; lra. }
  assert (One : s1 + s2 + s3 = 1).
  { apply Rmult_eq_reg_r with (dot3 n n); [|exact Pn]. rewrite Rmult_1_l, !Rmult_plus_distr_r, <- S1, <- S2, <- S3. unfold n. volumes. ring. }
  assert (Zero : forall e', s1 * dot3 e' a + s2 * dot3 e' b + s3 * dot3 e' c = 0).
  { intros e'. apply Rmult_eq_reg_r with (dot3 n n); [|exact Pn]. rewrite !Rmult_plus_distr_r, Rmult_0_l.
    replace (s1 * dot3 e' a * dot3 n n) with (s1 * dot3 n n * dot3 e' a) by ring. replace (s2 * dot3 e' b * dot3 n n) with (s2 * dot3 n n * dot3 e' b) by ring. replace (s3 * dot3 e' c * dot3 n n) with (s3 * dot3 n n * dot3 e' c) by ring.
    rewrite <- S1, <- S2, <- S3. transitivity (vol a b c * dot3 n e'); [unfold n; volumes; ring|rewrite D; ring]. }
  assert (R : s1 * vol e x a + s2 * vol e x b + s3 * vol e x c = 0).
  { assert (T : forall p, vol e x p = dot3 (cross3 e x) p) by (intros; volumes; ring). rewrite !T. apply Zero. }
  assert (Neg : s1 < 0 \/ s2 < 0 \/ s3 < 0).
  { destruct (Rlt_dec s1 0); [auto|]. destruct (Rlt_dec s2 0); [auto|]. destruct (Rlt_dec s3 0); [auto|]. exfalso. apply Off. exists s2, s3. repeat split; try lra.
    replace s1 with (1 - s2 - s3) in Zero by lra. pose proof (Zero (Vec 1 0 0)) as Z1. pose proof (Zero (Vec 0 1 0)) as Z2. pose proof (Zero (Vec 0 0 1)) as Z3. vectors. f_equal; lra. }
  assert (Pos : 0 < s1 \/ 0 < s2 \/ 0 < s3) by (destruct (Rlt_dec 0 s1); [auto|]; destruct (Rlt_dec 0 s2); [auto|]; right; right; lra).
  replace (vol (opposite e) a b) with (- (s3 * dot3 e n)) by (rewrite <- S3; volumes; ring). replace (vol (opposite e) b c) with (- (s1 * dot3 e n)) by (rewrite <- S1; volumes; ring). replace (vol (opposite e) c a) with (- (s2 * dot3 e n)) by (rewrite <- S2; volumes; ring).
  rewrite (S3 x), (S1 x), (S2 x). assert (T : forall p, vol x p (opposite e) = - vol e x p /\ vol x (opposite e) p = vol e x p) by (intros; split; volumes; ring).
  rewrite (proj1 (T a)), (proj1 (T b)), (proj1 (T c)), (proj2 (T a)), (proj2 (T b)), (proj2 (T c)), !sign_opp, !sign_mul. clear T S1 S2 S3. apply vanishes in R. rewrite !sign_mul in R.
  pose proof plane_key_holds as K. apply all_signs with (x := dot3 e n) in K. apply all_signs with (x := dot3 x n) in K. apply all_signs with (x := s1) in K. apply all_signs with (x := s2) in K. apply all_signs with (x := s3) in K.
  apply all_signs with (x := vol e x a) in K. apply all_signs with (x := vol e x b) in K. apply all_signs with (x := vol e x c) in K. unfold plane_key in K.
  assert (M : forall y, y <> 0 -> (sign y =? 0)%Z = false) by (intros y Y; apply Z.eqb_neq; now rewrite sign_0). rewrite !M, R in K by assumption.
  assert (Neg' : ((sign s1 =? -1) || (sign s2 =? -1) || (sign s3 =? -1))%Z = true).
  { destruct (sign_cases s1) as [(? & ->)|[(? & ->)|(? & ->)]], (sign_cases s2) as [(? & ->)|[(? & ->)|(? & ->)]], (sign_cases s3) as [(? & ->)|[(? & ->)|(? & ->)]]; try reflexivity; exfalso; lra. }
  assert (Pos' : ((sign s1 =? 1) || (sign s2 =? 1) || (sign s3 =? 1))%Z = true).
  { destruct (sign_cases s1) as [(? & ->)|[(? & ->)|(? & ->)]], (sign_cases s2) as [(? & ->)|[(? & ->)|(? & ->)]], (sign_cases s3) as [(? & ->)|[(? & ->)|(? & ->)]]; try reflexivity; exfalso; lra. }
  rewrite Neg', Pos' in K. now apply Z.eqb_eq in K.
Qed.
