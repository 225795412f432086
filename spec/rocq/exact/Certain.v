(** What [Determinants::is_miss], [is_hit], [distance] and [weights] of src/geom/kernel/exact/filter.rs say of single-precision data
    is so: the code on IEEE 754 doubles, from [Determinants::of] to the ends of a quotient, against EXACT-1 in real numbers. *)
Require Import Reals ZArith Lia Lra Psatz Bool.
From Flocq Require Import Core BinarySingleNaN.
Require Import StacklessExact.Rounding StacklessExact.Triple StacklessExact.Filter StacklessExact.Quotient StacklessExact.Range
  StacklessExact.Overflow StacklessExact.Division.
Open Scope R_scope.

Local Instance prec_53 : Prec_gt_0 53 := eq_refl.

(** [Determinants::front]: the sign bits, one xor the other. *)
Definition code_front (c : code) (x : float) : float := if Bsign (f_det c) then Bopp x else x.

(** [Determinants::is_miss] and [is_hit]. *)
Definition code_is_miss (sign : float) (c : code) : bool :=
  negb (Bleb (Bopp sign) (code_front c (f_u c)) && Bleb (Bopp sign) (code_front c (f_v c)) && Bleb (Bopp sign) (code_front c (f_w c))).
Definition code_is_hit (sign : float) (c : code) : bool :=
  Bltb sign (code_front c (f_u c)) && Bltb sign (code_front c (f_v c)) && Bltb sign (code_front c (f_w c)).

(** [Determinants::distance] and [weights]. *)
Definition code_distance (error_t error_det : float) (c : code) : float * float := code_over (f_t c) error_t (f_det c) error_det.
Definition code_weight (sign error_det : float) (c : code) (edge : float) : float * float :=
  code_over edge (times sign (constant 5 (-2))) (f_det c) error_det.

(** All values of [Determinants::of] are multiples of 2^-447. *)
Lemma determinants_are_multiples v0 v1 v2 o d : single v0 -> single v1 -> single v2 -> single o -> single d ->
  let x := determinants_of RX v0 v1 v2 o d in
  multiple (-447) (det x) /\ multiple (-447) (edge_u x) /\ multiple (-447) (edge_v x) /\ multiple (-447) (top_t x).
Proof.
  intros H0 H1 H2 Ho Hd. unfold single in *.
  destruct (vsub_same (-149) v1 v0) as [_ M1]; auto; try lia. destruct (vsub_same (-149) v2 v0) as [_ M2]; auto; try lia.
  destruct (vsub_same (-149) o v0) as [_ M3]; auto; try lia.
  destruct (cross_same (-149) d (vsub RX v2 v0)) as [_ Mp]; auto; try lia.
  destruct (cross_same (-149) (vsub RX o v0) (vsub RX v1 v0)) as [_ Mq]; auto; try lia.
  cbn [determinants_of det edge_u edge_v top_t]. change (-447)%Z with (-149 + (-149 + -149))%Z.
  split; [|split; [|split]]; apply dot_same; assumption || lia.
Qed.

Lemma sign_bit_is (x : float) : sign_bit (Bsign x) (B2R x).
Proof.
  unfold sign_bit, Triple.sign_bit. destruct x as [[]|[]| |[] m e B]; simpl; try lra; [apply F2R_le_0|apply F2R_ge_0]; simpl; lia.
Qed.

(** What is decided, for data on a grid and where nothing overflows. *)
Section Decisions.
Variable g : Z.
Hypothesis Hg : (-322 <= g <= 0)%Z.
Variables v0 v1 v2 o d : fvec.
Hypothesis Z0 : vmultiple g (real v0).
Hypothesis Z1 : vmultiple g (real v1).
Hypothesis Z2 : vmultiple g (real v2).
Hypothesis Zo : vmultiple g (real o).
Hypothesis Zd : vmultiple g (real d).
Variables D C E : float.
Hypothesis GD : multiple g (B2R D).
Hypothesis GC : multiple g (B2R C).
Hypothesis GE : multiple g (B2R E).
Hypothesis HD : bounded (B2R D) (real d).
Hypothesis HC : bounded (B2R C) (vsub R64 (real o) (real v0)).
Hypothesis HE : bounded (B2R E) (vsub R64 (real v1) (real v0)) /\ bounded (B2R E) (vsub R64 (real v2) (real v0)).

Let c := code_of v0 v1 v2 o d.
Let found := determinants_of R64 (real v0) (real v1) (real v2) (real o) (real d).
Let truth := determinants_of exactly (real v0) (real v1) (real v2) (real o) (real d).
Let sigma := error_sign R64 u (B2R D) (B2R C) (B2R E).
Let sign := code_sign D C E.

Variables edet eu ev ew et es : Z.
Hypothesis values : fits edet (f_det c) (det found) /\ fits eu (f_u c) (edge_u found) /\ fits ev (f_v c) (edge_v found) /\
  fits ew (f_w c) (edge_w found) /\ fits et (f_t c) (top_t found).
Hypothesis error : fits es sign sigma.

(** The sign bit of the determinant, and what [front] makes of a value. *)
Lemma sign_is : sign_bit (Bsign (f_det c)) (det found).
Proof.
  destruct values as ((_ & V & _) & _). rewrite <- V. apply sign_bit_is.
Qed.

Lemma front_is e x r : fits e x r -> is_finite (code_front c x) = true /\ B2R (code_front c x) = front (Bsign (f_det c)) r.
Proof.
  intros (F & V & _). unfold code_front, front, Triple.front.
  destruct (Bsign (f_det c)); [rewrite is_finite_Bopp, B2R_Bopp, V|rewrite V]; now split.
Qed.

Lemma at_least_code e x r : fits e x r -> Bleb (Bopp sign) (code_front c x) = Rle_bool (- sigma) (front (Bsign (f_det c)) r).
Proof.
  intros X. destruct (front_is _ _ _ X) as [F V]. destruct error as (Fs & Vs & _).
  rewrite Bleb_correct; [|rewrite is_finite_Bopp; exact Fs|exact F]. now rewrite B2R_Bopp, V, Vs.
Qed.

Lemma above_code e x r : fits e x r -> Bltb sign (code_front c x) = Rlt_bool sigma (front (Bsign (f_det c)) r).
Proof.
  intros X. destruct (front_is _ _ _ X) as [F V]. destruct error as (Fs & Vs & _).
  rewrite Bltb_correct; [|exact Fs|exact F]. now rewrite V, Vs.
Qed.

Lemma miss_where_it_fits : code_is_miss sign c = true -> ~ meets truth.
Proof.
  intros M. destruct values as (_ & Vu & Vv & Vw & _). unfold code_is_miss in M.
  rewrite (at_least_code _ _ _ Vu), (at_least_code _ _ _ Vv), (at_least_code _ _ _ Vw), negb_true_iff, !andb_false_iff in M.
  apply (miss_in_double g Hg (real v0) (real v1) (real v2) (real o) (real d) Z0 Z1 Z2 Zo Zd (B2R D) (B2R C) (B2R E)
    GD GC GE HD HC HE (Bsign (f_det c)) sign_is).
  assert (Less : forall x y, Rle_bool x y = false -> y < x) by (intros x y; destruct (Rle_bool_spec x y); [discriminate|auto]).
  unfold is_miss. destruct M as [[M|M]|M]; apply Less in M; auto.
Qed.

Lemma hit_in_reals : code_is_hit sign c = true -> is_hit (Bsign (f_det c)) sigma found.
Proof.
  intros M. destruct values as (_ & Vu & Vv & Vw & _). unfold code_is_hit in M.
  rewrite (above_code _ _ _ Vu), (above_code _ _ _ Vv), (above_code _ _ _ Vw), !andb_true_iff in M.
  destruct M as [[Mu Mv] Mw]. apply ltb_true in Mu, Mv, Mw. now split.
Qed.

Lemma hit_where_it_fits : code_is_hit sign c = true -> meets truth.
Proof.
  intros M. apply (hit_in_double g Hg (real v0) (real v1) (real v2) (real o) (real d) Z0 Z1 Z2 Zo Zd (B2R D) (B2R C) (B2R E)
    GD GC GE HD HC HE (Bsign (f_det c))). now apply hit_in_reals.
Qed.

End Decisions.

Section Certain.
Variables v0 v1 v2 o d : fvec.
Hypothesis H0 : v_single v0.
Hypothesis H1 : v_single v1.
Hypothesis H2 : v_single v2.
Hypothesis Ho : v_single o.
Hypothesis Hd : v_single d.

(** Bounds of the components, as [Errors::new] is given them: those of the scene, or of the triangle (Scene.v). *)
Variables D C E : float.
Definition is_bound (e : Z) (x : float) : Prop := fits e x (B2R x) /\ multiple (-149) (B2R x).
Hypothesis GD : is_bound 128 D.
Hypothesis GC : is_bound 130 C.
Hypothesis GE : is_bound 129 E.
Hypothesis HD : bounded (B2R D) (real d).
Hypothesis HC : bounded (B2R C) (vsub R64 (real o) (real v0)).
Hypothesis HE : bounded (B2R E) (vsub R64 (real v1) (real v0)) /\ bounded (B2R E) (vsub R64 (real v2) (real v0)).

Let c := code_of v0 v1 v2 o d.
Let found := determinants_of R64 (real v0) (real v1) (real v2) (real o) (real d).
Let truth := determinants_of exactly (real v0) (real v1) (real v2) (real o) (real d).
Let sigma := error_sign R64 u (B2R D) (B2R C) (B2R E).
Let sign := code_sign D C E.

Let values : fits 388 (f_det c) (det found) /\ fits 388 (f_u c) (edge_u found) /\ fits 388 (f_v c) (edge_v found) /\
  fits 390 (f_w c) (edge_w found) /\ fits 390 (f_t c) (top_t found) := determinants_do_not_overflow v0 v1 v2 o d H0 H1 H2 Ho Hd.
Let errors : fits 342 sign sigma /\ fits 340 (code_det D E) (error_det R64 u (B2R D) (B2R E)) /\
  fits 342 (code_t C E) (error_t R64 u (B2R C) (B2R E)) := errors_do_not_overflow D C E _ _ _ (proj1 GD) (proj1 GC) (proj1 GE).
Let Z0 := v_multiple _ H0.
Let Z1 := v_multiple _ H1.
Let Z2 := v_multiple _ H2.
Let Zo := v_multiple _ Ho.
Let Zd := v_multiple _ Hd.

(** A miss is one, whatever the sign bit of the determinant. [EXACT-6] *)
Theorem miss_of_code : code_is_miss sign c = true -> ~ meets truth.
Proof.
  apply (miss_where_it_fits (-149) ltac:(lia) v0 v1 v2 o d Z0 Z1 Z2 Zo Zd D C E (proj2 GD) (proj2 GC) (proj2 GE) HD HC HE 388 388 388 390 390 342).
  - exact values.
  - apply errors.
Qed.

(** A hit is one. [EXACT-6] *)
Theorem hit_of_code : code_is_hit sign c = true -> meets truth.
Proof.
  apply (hit_where_it_fits (-149) ltac:(lia) v0 v1 v2 o d Z0 Z1 Z2 Zo Zd D C E (proj2 GD) (proj2 GC) (proj2 GE) HD HC HE 388 388 388 390 390 342).
  - exact values.
  - apply errors.
Qed.

Lemma hit_of_reals : code_is_hit sign c = true -> is_hit (Bsign (f_det c)) sigma found.
Proof. apply (hit_in_reals (-149) ltac:(lia) v0 v1 v2 o d D C E HE 388 388 388 390 390 342 values). apply errors. Qed.

(** * The quotient of a hit *)

Let found_X := determinants_of RX (real v0) (real v1) (real v2) (real o) (real d).
Let same_found : found = found_X := determinants_do_not_underflow (-149) ltac:(lia) _ _ _ _ _ Z0 Z1 Z2 Zo Zd.
Let same_sigma : sigma = error_sign RX u (B2R D) (B2R C) (B2R E) := sigma_does_not_underflow (-149) ltac:(lia) _ _ _ (proj2 GD) (proj2 GC) (proj2 GE).

Let bounds_X : bounded (B2R C) (vsub RX (real o) (real v0)) /\ bounded (B2R E) (vsub RX (real v1) (real v0)) /\
  bounded (B2R E) (vsub RX (real v2) (real v0)).
Proof.
  destruct (vsub_same (-149) (real v1) (real v0)) as [<- _]; auto; try lia. destruct (vsub_same (-149) (real v2) (real v0)) as [<- _]; auto; try lia.
  destruct (vsub_same (-149) (real o) (real v0)) as [<- _]; auto; try lia.
Qed.

(** A constant times a product of three as evaluated: no underflow, a multiple, and how great at most. *)
Lemma evaluated_64 n a e : multiple (-149) a -> multiple (-149) e ->
  R64 (IZR n * / 4 * u * R64 (a * R64 (e * e))) = RX (IZR n * / 4 * u * RX (a * RX (e * e))) /\
  multiple (-504) (RX (IZR n * / 4 * u * RX (a * RX (e * e)))).
Proof.
  intros A E'. destruct (same (-149 + -149) (e * e) ltac:(lia)) as [-> M1]; [grid|].
  destruct (same (-149 + (-149 + -149)) (a * RX (e * e)) ltac:(lia)) as [-> M2]; [grid|].
  destruct (same (-55 + (-149 + (-149 + -149))) (IZR n * / 4 * u * RX (a * RX (e * e))) ltac:(lia)) as [-> M3]; [grid; apply Range.constant|].
  split; [reflexivity|]. destruct M3 as (m & ->). exists (m * 4)%Z. rewrite mult_IZR, Rmult_assoc. f_equal.
  change 4 with (bpow radix2 2). now rewrite <- bpow_plus.
Qed.

Lemma evaluated_most k a e : 0 <= k -> 0 <= a -> RX (k * RX (a * RX (e * e))) <= (1 + 4 * / 2048) * (k * (a * (e * e))).
Proof.
  intros Hk Ha. pose proof (Rounding.Hu 53 ltac:(lia)) as Hu.
  assert (Up : forall x, 0 <= x -> RX x <= x * (1 + u)).
  { intros x Hx. destruct (Rounding.rel 53 ltac:(lia) x) as (b & Hb & ->). apply Rmult_le_compat_l; [exact Hx|]. apply Rabs_le_inv in Hb. lra. }
  assert (P1 : 0 <= e * e) by apply Rle_0_sqr. pose proof (Up _ P1) as U1. pose proof (RN_pos 53 ltac:(lia) _ P1) as Q1.
  assert (P2 : 0 <= a * RX (e * e)) by (now apply Rmult_le_pos). pose proof (Up _ P2) as U2. pose proof (RN_pos 53 ltac:(lia) _ P2) as Q2.
  assert (P3 : 0 <= k * RX (a * RX (e * e))) by (now apply Rmult_le_pos). pose proof (Up _ P3) as U3.
  eapply Rle_trans; [exact U3|]. apply Rle_trans with (k * (a * (e * e * (1 + u)) * (1 + u)) * (1 + u)).
  - apply Rmult_le_compat_r; [lra|]. apply Rmult_le_compat_l; [exact Hk|]. eapply Rle_trans; [exact U2|].
    apply Rmult_le_compat_r; [lra|]. now apply Rmult_le_compat_l.
  - replace (k * (a * (e * e * (1 + u)) * (1 + u)) * (1 + u)) with ((1 + u) * (1 + u) * (1 + u) * (k * (a * (e * e)))) by ring.
    apply Rmult_le_compat_r; [apply Rmult_le_pos; [exact Hk|now apply Rmult_le_pos]|]. clear - Hu. generalize dependent u. intros x Hx. nra.
Qed.

(** The bound of the determinant beside the determinant of a certain hit. *)
Lemma hit_ratio : is_hit (Bsign (f_det c)) sigma found ->
  let ed := error_det R64 u (B2R D) (B2R E) in
  ed = error_det RX u (B2R D) (B2R E) /\ 8 * u * Rabs (det found) <= ed <= Rabs (det found) /\
  bpow radix2 (-447) <= Rabs (det found) <= bpow radix2 388.
Proof.
  intros H ed. pose proof (Rounding.Hu 53 ltac:(lia)) as Hu. destruct bounds_X as (BC & B1 & B2).
  assert (PD : 0 <= B2R D) by exact (pos_b _ _ (proj1 HD)). assert (PE : 0 <= B2R E) by exact (pos_b _ _ (proj1 B1)).
  assert (K31 : 31 * u * (5 / 4) = IZR (31 * 5) * / 4 * u) by (simpl IZR; lra).
  assert (Same : ed = error_det RX u (B2R D) (B2R E)).
  { unfold ed, error_det. rewrite K31. apply evaluated_64; [apply GD|apply GE]. }
  split; [exact Same|]. set (y := B2R D * B2R E * B2R E).
  assert (Py : 0 <= y) by (unfold y; repeat apply Rmult_le_pos; assumption). assert (0 <= u * y) by (apply Rmult_le_pos; lra).
  assert (Low : (1 - 3 * / 2048) * (31 * u * (5 / 4) * y) <= ed).
  { rewrite Same. unfold y. rewrite Rmult_assoc with (r2 := B2R E).
    apply (evaluated 53 ltac:(lia) (real v0) (real v1) (real v2) (B2R E)); try lra. now split. }
  assert (High : ed <= (1 + 4 * / 2048) * (31 * u * (5 / 4) * y)).
  { rewrite Same. unfold y. rewrite Rmult_assoc with (r2 := B2R E). apply evaluated_most; lra. }
  assert (Det : Rabs (det found) <= (4 + (22 * u + 49 * (u * u))) * y).
  { rewrite same_found. pose proof (triple_fl 53 ltac:(lia) _ _ _ _ _ _ B1 HD B2) as T.
    pose proof B1 as (X1 & X2 & X3). pose proof HD as (Y1 & Y2 & Y3). pose proof B2 as (W1 & W2 & W3).
    pose proof (det3_b _ _ _ _ _ _ _ _ _ _ _ _ X1 X2 X3 Y1 Y2 Y3 W1 W2 W3) as D3. pose proof (add_b _ _ _ _ T D3) as S.
    match type of S with Rabs ?a <= ?b => replace a with (det found_X) in S by (unfold found_X; simpl; ring);
      replace b with ((4 + (22 * u + 49 * (u * u))) * y) in S by (unfold y; ring) end. exact S. }
  rewrite same_found, same_sigma in H. destruct (hit_is_far_from_parallel 53 ltac:(lia) _ _ _ _ _ _ _ _ HD BC (conj B1 B2) _ H) as [L P].
  fold found_X in L, P. rewrite <- same_found in L, P. fold y in L.
  assert (K30 : 30 * u * y <= k 53 * y).
  { apply Rmult_le_compat_r; [exact Py|]. unfold k. assert (0 <= u * u) by (apply Rmult_le_pos; lra). lra. }
  assert (UU : u * u * y <= / 2048 * (u * y)).
  { rewrite <- Rmult_assoc. apply Rmult_le_compat_r; [exact Py|]. apply Rmult_le_compat_r; lra. }
  split; [split|split].
  - apply Rle_trans with (8 * u * ((4 + (22 * u + 49 * (u * u))) * y)); [apply Rmult_le_compat_l; lra|].
    eapply Rle_trans; [|exact Low]. assert (u * (u * u * y) <= / 2048 * (u * y)); [|nra].
    apply Rle_trans with (1 * (u * u * y)); [|lra]. apply Rmult_le_compat_r; [|lra]. repeat apply Rmult_le_pos; lra.
  - lra.
  - rewrite same_found in *. destruct (determinants_are_multiples _ _ _ _ _ Z0 Z1 Z2 Zo Zd) as (M & _). fold found_X in M.
    destruct (multiple_big _ _ M) as [Z|B]; [rewrite Z, Rabs_R0 in P; lra|exact B].
  - destruct values as ((_ & _ & B) & _). exact B.
Qed.

Lemma multiple_within e low high x : (low <= e)%Z -> multiple e x -> Rabs x <= bpow radix2 high -> within low high x.
Proof.
  intros L M B. destruct (multiple_big _ _ M) as [Z|G]; [now left|right]. split; [|exact B].
  eapply Rle_trans; [apply bpow_le, L|exact G].
Qed.

(** The ends of a quotient of a hit are finite, and the true quotient is between them if that of Quotient.v is. *)
Lemma ends e N n et ET : is_hit (Bsign (f_det c)) sigma found -> fits e N n -> (e <= 390)%Z -> multiple (-447) n ->
  fits 345 ET et -> multiple (-504) et -> 0 <= et ->
  let '(low, high) := code_over N ET (f_det c) (code_det D E) in
  let '(low', high') := over_determinant RX u n et (det found_X) (error_det RX u (B2R D) (B2R E)) in
  is_finite low = true /\ is_finite high = true /\ B2R low = low' /\ B2R high = high'.
Proof.
  intros H (Fn & Vn & Bn) He Mn (Ft & Vt & Bt) Mt Pt. destruct (hit_ratio H) as (Same & R & W). rewrite Same in R.
  destruct values as ((Fd & Vd & _) & _). destruct errors as (_ & (Fe & Ve & _) & _). 
  rewrite same_found in R, W, Vd. rewrite Same in Ve.
  assert (Wn : within (-447) 390 n).
  { apply (multiple_within (-447)); [lia|exact Mn|]. eapply Rle_trans; [exact Bn|now apply bpow_le]. }
  assert (Wt : within (-504) 345 et) by (apply (multiple_within (-504)); [lia|exact Mt|exact Bt]).
  destruct (quotient_in_range N ET (f_det c) (code_det D E) n et (det found_X) (error_det RX u (B2R D) (B2R E))
    (conj Fn Vn) (conj Ft Vt) (conj Fd Vd) (conj Fe Ve) Wn Pt Wt W R) as [[F1 V1] [F2 V2]].
  destruct (code_over _ _ _ _) as [low high], (over_determinant _ _ _ _ _ _) as [low' high'].
  split; [exact F1|split; [exact F2|split; [exact V1|exact V2]]].
Qed.

(** [Determinants::distance]: its ends are finite, and the true distance is between them. [EXACT-9] *)
Theorem distance_of_code : code_is_hit sign c = true ->
  let '(low, high) := code_distance (code_t C E) (code_det D E) c in
  is_finite low = true /\ is_finite high = true /\ B2R low <= top_t truth / det truth <= B2R high.
Proof.
  intros H. apply hit_of_reals in H. destruct bounds_X as (BC & B1 & B2).
  assert (PC : 0 <= B2R C) by exact (pos_b _ _ (proj1 BC)). pose proof (Rounding.Hu 53 ltac:(lia)) as Hu.
  assert (K35 : 35 * u * (5 / 4) = IZR (35 * 5) * / 4 * u) by (simpl IZR; lra).
  destruct values as (_ & _ & _ & _ & Vt). rewrite same_found in Vt.
  destruct errors as (_ & _ & Ve). unfold error_t in Ve. rewrite K35 in Ve.
  destruct (evaluated_64 (35 * 5) (B2R C) (B2R E) (proj2 GC) (proj2 GE)) as [S M]. rewrite S in Ve. rewrite <- K35 in Ve, M.
  fold (error_t RX u (B2R C) (B2R E)) in Ve, M. destruct (determinants_are_multiples _ _ _ _ _ Z0 Z1 Z2 Zo Zd) as (_ & _ & _ & Mt).
  fold found_X in Mt.
  assert (P : 0 <= error_t RX u (B2R C) (B2R E)).
  { unfold error_t. apply (RN_pos 53); [lia|]. apply Rmult_le_pos; [lra|]. apply (RN_pos 53); [lia|]. apply Rmult_le_pos; [exact PC|].
    apply (RN_pos 53); [lia|]. apply Rle_0_sqr. }
  pose proof (ends 390 _ _ _ _ H Vt ltac:(lia) Mt (fits_more 342 345 _ _ Ve ltac:(lia)) M P) as Ends.
  rewrite same_found, same_sigma in H.
  pose proof (distance_is_enclosed 53 ltac:(lia) _ _ _ _ _ _ _ _ HD BC (conj B1 B2) _ H) as Q. fold found_X truth in Q.
  unfold code_distance. destruct (code_over _ _ _ _) as [low high], (over_determinant _ _ _ _ _ _) as [low' high'].
  destruct Ends as (F1 & F2 & -> & ->). exact (conj F1 (conj F2 Q)).
Qed.

(** [Determinants::weights], likewise. [EXACT-9] *)
Theorem weights_of_code : code_is_hit sign c = true ->
  (let '(low, high) := code_weight sign (code_det D E) c (f_u c) in
   is_finite low = true /\ is_finite high = true /\ B2R low <= edge_u truth / det truth <= B2R high) /\
  (let '(low, high) := code_weight sign (code_det D E) c (f_v c) in
   is_finite low = true /\ is_finite high = true /\ B2R low <= edge_v truth / det truth <= B2R high).
Proof.
  intros H. apply hit_of_reals in H. destruct bounds_X as (BC & B1 & B2).
  destruct values as (_ & Vu & Vv & _ & _).  rewrite same_found in Vu, Vv.
  destruct errors as (Vs & _ & _).
  assert (Msigma : multiple (-502) sigma).
  { rewrite same_sigma. unfold error_sign. replace (78 * u) with (312 * / 4 * u) by lra.
    destruct (same (-149 + -149) (B2R D * B2R E) ltac:(lia)) as [_ M1]; [grid; apply GD || apply GE|].
    destruct (same (-55 + (-149 + -149)) (312 * / 4 * u * RX (B2R D * B2R E)) ltac:(lia)) as [_ M2]; [grid; apply Range.constant|].
    destruct (same (-149) (B2R C + B2R E) ltac:(lia)) as [_ M3]; [grid; apply GC || apply GE|].
    apply (same (-55 + (-149 + -149) + -149)); [lia|grid]. }
  assert (Psigma : 0 <= sigma).
  { rewrite same_sigma. assert (PD : 0 <= B2R D) by exact (pos_b _ _ (proj1 HD)). assert (PE : 0 <= B2R E) by exact (pos_b _ _ (proj1 B1)).
    assert (PC : 0 <= B2R C) by exact (pos_b _ _ (proj1 BC)). pose proof (Rounding.Hu 53 ltac:(lia)) as Hu.
    unfold error_sign. repeat first [apply (RN_pos 53); [lia|] | apply Rmult_le_pos]; lra. }
  assert (I5 : is_number (constant 5 (-2)) (5 / 4)).
  { destruct (constant_fits 5 (-2)) as [F V]; [reflexivity|lia|]. split; [exact F|]. rewrite V. change (bpow radix2 (-2)) with (/ 4). lra. }
  assert (M5 : multiple (-2) (5 / 4)) by (exists 5%Z; change (bpow radix2 (-2)) with (/ 4); lra).
  assert (F5 : fits 1 (constant 5 (-2)) (5 / 4)).
  { split; [apply I5|split; [apply I5|]]. rewrite Rabs_pos_eq by lra. change (bpow radix2 1) with 2. lra. }
  pose proof (times_fits 342 1 _ _ _ _ ltac:(lia) Vs F5) as Vw. simpl Z.add in Vw.
  destruct (same (-502 + -2) (sigma * (5 / 4)) ltac:(lia)) as [S5 M]; [grid|]. rewrite S5 in Vw.
  assert (P : 0 <= RX (sigma * (5 / 4))) by (apply (RN_pos 53); [lia|apply Rmult_le_pos; lra]).
  destruct (determinants_are_multiples _ _ _ _ _ Z0 Z1 Z2 Zo Zd) as (_ & Mu & Mv & _). fold found_X in Mu, Mv.
  pose proof (ends 388 _ _ _ _ H Vu ltac:(lia) Mu (fits_more 343 345 _ _ Vw ltac:(lia)) M P) as EndsU.
  pose proof (ends 388 _ _ _ _ H Vv ltac:(lia) Mv (fits_more 343 345 _ _ Vw ltac:(lia)) M P) as EndsV.
  rewrite same_found, same_sigma in H.
  pose proof (weights_are_enclosed 53 ltac:(lia) _ _ _ _ _ _ _ _ HD BC (conj B1 B2) _ H) as [QU QV]. fold found_X truth in QU, QV.
  rewrite <- same_sigma in QU, QV. unfold code_weight. split.
  - destruct (code_over (f_u c) _ _ _) as [low high], (over_determinant _ _ (edge_u found_X) _ _ _) as [low' high'].
    destruct EndsU as (F1 & F2 & -> & ->). exact (conj F1 (conj F2 QU)).
  - destruct (code_over (f_v c) _ _ _) as [low high], (over_determinant _ _ (edge_v found_X) _ _ _) as [low' high'].
    destruct EndsV as (F1 & F2 & -> & ->). exact (conj F1 (conj F2 QV)).
Qed.
End Certain.
