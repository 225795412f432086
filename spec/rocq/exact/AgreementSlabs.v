(** The slab tests: what Slabs.v and TwoSided.v are about is what Operations.v has, for both boxes of a pair. *)
Require Import Reals ZArith Lia Lra Bool List.
From Flocq Require Import Core BinarySingleNaN.
Require StacklessExact.Slabs StacklessExact.TwoSided.
Require Import StacklessExact.Arithmetic StacklessExact.Operations.
Open Scope R_scope.

Local Existing Instances Arithmetic.prec_24 Arithmetic.emax_128 Arithmetic.prec_53 Arithmetic.emax_1024.

(** * Constants *)

Lemma zero_32 : constant f32 0 0 = Slabs.zero 24 128.
Proof. reflexivity. Qed.
Lemma zero_64 : constant f64 0 0 = Slabs.zero 53 1024.
Proof. reflexivity. Qed.
Lemma one_32 : constant f32 1 0 = Slabs.one 24 128 prec_24 emax_128.
Proof. apply B2SF_inj. vm_compute. reflexivity. Qed.
Lemma one_64 : constant f64 1 0 = Slabs.one 53 1024 prec_53 emax_1024.
Proof. apply B2SF_inj. vm_compute. reflexivity. Qed.
Lemma down_agrees : Centred_DOWN f32 = TwoSided.down.
Proof. apply B2SF_inj. vm_compute. reflexivity. Qed.
Lemma up_agrees : Centred_UP f32 = TwoSided.up.
Proof. apply B2SF_inj. vm_compute. reflexivity. Qed.

(** * One axis *)

(** A turn of the loop, with any two reciprocals. *)
Definition turn (a : arithmetic) (ends : num a * num a) (axis : num a * num a * num a * num a * num a) : num a * num a :=
  let '(near, far) := ends in
  let '(o, lo, hi, i, j) := axis in
  let t1 := times a (minus a lo o) i in
  let t2 := times a (minus a hi o) j in
  let first := if less a t2 t1 then t2 else t1 in
  let last := if less a t2 t1 then t1 else t2 in
  (if less a near first then first else near, if less a last far then last else far).

Notation reciprocals_32 := (Slabs.reciprocals 24 128 prec_24 emax_128 2).
Notation reciprocals_64 := (Slabs.reciprocals 53 1024 prec_53 emax_1024 3).

Lemma turn_is_narrow ends o d lo hi :
  turn f32 ends (o, lo, hi, fst (reciprocals_32 d), snd (reciprocals_32 d)) = Slabs.narrow 24 128 prec_24 emax_128 2 ends (o, d, lo, hi).
Proof. destruct ends. reflexivity. Qed.

Lemma turn_is_narrow_64 ends o d lo hi :
  turn f64 ends (o, lo, hi, fst (reciprocals_64 d), snd (reciprocals_64 d)) = Slabs.narrow 53 1024 prec_53 emax_1024 3 ends (o, d, lo, hi).
Proof. destruct ends. reflexivity. Qed.

Lemma turn_is_narrow_by ends o d lo hi :
  turn f32 ends (o, lo, hi, TwoSided.inverse d, TwoSided.inverse d) = TwoSided.narrow_by ends (o, d, lo, hi).
Proof. destruct ends. reflexivity. Qed.

(** * Two boxes in four lanes *)

Section Lanes.
Variables ox oy oz ix iy iz jx jy jz tmin tmax : num f32.
(** Planes of two boxes. *)
Variables ax ay az bx by_ bz cx cy cz dx dy dz : num f32.

(** [near_and_far]: each box has its lanes, and each turn the operands of the model. [BOX-1] *)
Theorem lanes_agree :
  let '(near, _, near', _, _, far, _, far') := slabs_near_and_far f32 ax bx cx dx ay by_ cy dy az bz cz dz
    ox ox ox ox oy oy oy oy oz oz oz oz ix jx ix jx iy jy iy jy iz jz iz jz tmin tmax in
  (near, far) = fold_left (turn f32) ((ox, ax, bx, ix, jx) :: (oy, ay, by_, iy, jy) :: (oz, az, bz, iz, jz) :: nil) (tmin, tmax) /\
  (near', far') = fold_left (turn f32) ((ox, cx, dx, ix, jx) :: (oy, cy, dy, iy, jy) :: (oz, cz, dz, iz, jz) :: nil) (tmin, tmax).
Proof. unfold slabs_near_and_far. cbv beta iota zeta delta [turn fold_left]. split; reflexivity. Qed.
End Lanes.

(** * [Directed] *)

(** The reciprocals for lo and for hi, of one component. *)
Lemma directed_reciprocals d :
  let inverse := over f32 (constant f32 1 0) (plus f32 d (constant f32 0 0)) in
  let far := if equal f32 (plus f32 d (constant f32 0 0)) (constant f32 0 0) then infinity f32 else shifted f32 2 inverse in
  let backward := less f32 (plus f32 d (constant f32 0 0)) (constant f32 0 0) in
  (if backward then far else shifted f32 (-2) inverse, if backward then shifted f32 (-2) inverse else far) = reciprocals_32 d.
Proof.
  cbv zeta. unfold Slabs.reciprocals, Slabs.reciprocal. rewrite one_32, zero_32.
  change (less f32 ?x ?y) with (Bltb x y). change (plus f32 d (Slabs.zero 24 128)) with (Bplus mode_NE d (Slabs.zero 24 128)).
  destruct (Bltb _ _); reflexivity.
Qed.

Section Directed.
Variables ox oy oz dx dy dz tmin tmax : num f32.
Variable reach : num f64.
Variables mx my mz mw away sx sy sz sw : num f32.
Variables ax ay az bx by_ bz cx cy cz ex ey ez : num f32.
Let new := Directed_new f32 f64 f64_of_f32 ox oy oz dx dy dz reach mx my mz mw away sx sy sz sw.

(** [Directed::new]: what it keeps, but for [is_wide]. [BOX-1, BOX-2] *)
Theorem directed_new_agrees : exists is_wide, new =
  (ox, ox, ox, ox, oy, oy, oy, oy, oz, oz, oz, oz,
   fst (reciprocals_32 dx), snd (reciprocals_32 dx), fst (reciprocals_32 dx), snd (reciprocals_32 dx),
   fst (reciprocals_32 dy), snd (reciprocals_32 dy), fst (reciprocals_32 dy), snd (reciprocals_32 dy),
   fst (reciprocals_32 dz), snd (reciprocals_32 dz), fst (reciprocals_32 dz), snd (reciprocals_32 dz), is_wide).
Proof.
  eexists. unfold new, Directed_new. cbv zeta. rewrite <- (directed_reciprocals dx), <- (directed_reciprocals dy), <- (directed_reciprocals dz).
  cbv zeta. cbn [fst snd]. reflexivity.
Qed.

(** [Directed::pair], where single precision will do: the near and far distances of both boxes, and whether they are hit.
    [BOX-1, BOX-2] *)
Theorem directed_pair_agrees :
  let i d := fst (reciprocals_32 d) in let j d := snd (reciprocals_32 d) in
  let '(hit, hit', near, near', far, far') := Directed_pair f32
    ox ox ox ox oy oy oy oy oz oz oz oz (i dx) (j dx) (i dx) (j dx) (i dy) (j dy) (i dy) (j dy) (i dz) (j dz) (i dz) (j dz)
    tmin ax bx cx ex ay by_ cy ey az bz cz ez tmax in
  ((near, far) = Slabs.near_and_far 24 128 prec_24 emax_128 2 ((ox, dx, ax, bx) :: (oy, dy, ay, by_) :: (oz, dz, az, bz) :: nil) tmin tmax /\
    hit = Bleb near far) /\
  ((near', far') = Slabs.near_and_far 24 128 prec_24 emax_128 2 ((ox, dx, cx, ex) :: (oy, dy, cy, ey) :: (oz, dz, cz, ez) :: nil) tmin tmax /\
    hit' = Bleb near' far').
Proof.
  cbv zeta. unfold Directed_pair. cbv zeta.
  generalize (lanes_agree ox oy oz (fst (reciprocals_32 dx)) (fst (reciprocals_32 dy)) (fst (reciprocals_32 dz))
    (snd (reciprocals_32 dx)) (snd (reciprocals_32 dy)) (snd (reciprocals_32 dz)) tmin tmax ax ay az bx by_ bz cx cy cz ex ey ez).
  destruct (slabs_near_and_far _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _)
    as [[[[[[[near ?] near'] ?] ?] far] ?] far'].
  unfold Slabs.near_and_far. cbn [fold_left]. rewrite !turn_is_narrow. intros [E E'].
  cbv iota. split; split; [exact E|reflexivity|exact E'|reflexivity].
Qed.
End Directed.

(** * [TwoSided] *)

Lemma centred_reciprocal d : let i := over f32 (constant f32 1 0) d in (if is_finite f32 i then i else infinity f32) = TwoSided.inverse d.
Proof. cbv zeta. unfold TwoSided.inverse. rewrite one_32. reflexivity. Qed.

(** [Centred::new]. [BOX-5] *)
Theorem centred_new_agrees ox oy oz dx dy dz tmin : Centred_new f32 ox oy oz dx dy dz tmin =
  let i := TwoSided.inverse in
  (ox, ox, ox, ox, oy, oy, oy, oy, oz, oz, oz, oz, i dx, i dx, i dx, i dx, i dy, i dy, i dy, i dy, i dz, i dz, i dz, i dz, tmin).
Proof.
  unfold Centred_new. cbv zeta. rewrite <- (centred_reciprocal dx), <- (centred_reciprocal dy), <- (centred_reciprocal dz). reflexivity.
Qed.

(** [Centred::pair] of [TwoSided]. [BOX-5] *)
Theorem centred_pair_agrees ox oy oz dx dy dz tmin tmax ax ay az bx by_ bz cx cy cz ex ey ez :
  let i := TwoSided.inverse in
  let '(hit, hit', near, near', far, far') := Centred_pair f32 ox ox ox ox oy oy oy oy oz oz oz oz
    (i dx) (i dx) (i dx) (i dx) (i dy) (i dy) (i dy) (i dy) (i dz) (i dz) (i dz) (i dz)
    tmin ax bx cx ex ay by_ cy ey az bz cz ez tmax in
  ((near, far) = TwoSided.two_sided ((ox, dx, ax, bx) :: (oy, dy, ay, by_) :: (oz, dz, az, bz) :: nil) tmin tmax /\ hit = Bleb near far) /\
  ((near', far') = TwoSided.two_sided ((ox, dx, cx, ex) :: (oy, dy, cy, ey) :: (oz, dz, cz, ez) :: nil) tmin tmax /\
    hit' = Bleb near' far').
Proof.
  cbv zeta. unfold Centred_pair. cbv zeta.
  generalize (lanes_agree ox oy oz (TwoSided.inverse dx) (TwoSided.inverse dy) (TwoSided.inverse dz)
    (TwoSided.inverse dx) (TwoSided.inverse dy) (TwoSided.inverse dz) tmin tmax ax ay az bx by_ bz cx cy cz ex ey ez).
  destruct (slabs_near_and_far _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _)
    as [[[[[[[near ?] near'] ?] ?] far] ?] far'].
  unfold TwoSided.two_sided. cbn [fold_left]. rewrite !turn_is_narrow_by. intros [E E'].
  destruct (TwoSided.narrow_by _ (oz, dz, az, bz)), (TwoSided.narrow_by _ (oz, dz, cz, ez)).
  injection E as -> ->. injection E' as -> ->. rewrite down_agrees, up_agrees. repeat split; reflexivity.
Qed.

(** * [Doubled] *)

Section Doubled.
Variables ox oy oz tmax : num f64.
Notation tmin := (constant f64 0 0).
Variables ix iy iz jx jy jz : num f64.
Variables ax ay az bx by_ bz cx cy cz ex ey ez : num f32.
Notation wide := f64_of_f32.

(** [Doubled::pair], for a ray whose origin is known. [BOX-6] *)
Theorem doubled_pair_agrees :
  let '(hit, hit', near, near', far, far') := Doubled_pair f32 f64 f64_of_f32 ox oy oz ox oy oz ix iy iz jx jy jz
    ax bx cx ex ay by_ cy ey az bz cz ez tmax in
  ((near, far) = fold_left (turn f64) ((ox, wide ax, wide bx, ix, jx) :: (oy, wide ay, wide by_, iy, jy) ::
      (oz, wide az, wide bz, iz, jz) :: nil) (tmin, tmax) /\ hit = Bleb near far) /\
  ((near', far') = fold_left (turn f64) ((ox, wide cx, wide ex, ix, jx) :: (oy, wide cy, wide ey, iy, jy) ::
      (oz, wide cz, wide ez, iz, jz) :: nil) (tmin, tmax) /\ hit' = Bleb near' far').
Proof. unfold Doubled_pair. cbv beta iota zeta delta [turn fold_left]. repeat split; reflexivity. Qed.
End Doubled.

(** [Doubled::new] makes the reciprocals of Slabs.v, where none but that of 0 overflows. [BOX-2, BOX-6] *)
Theorem doubled_reciprocals d : BinarySingleNaN.is_finite d = true ->
  B2R d = 0 \/ BinarySingleNaN.is_finite (Slabs.reciprocal 53 1024 prec_53 emax_1024 d) = true ->
  let inverse := over f64 (constant f64 1 0) (plus f64 d (constant f64 0 0)) in
  let far := if is_finite f64 inverse then shifted f64 3 inverse else inverse in
  let backward := less f64 d (constant f64 0 0) in
  (if backward then far else shifted f64 (-3) inverse, if backward then shifted f64 (-3) inverse else far) = reciprocals_64 d.
Proof.
  intros F U. cbv zeta. unfold Slabs.reciprocals. change (over f64 (constant f64 1 0) (plus f64 d (constant f64 0 0)))
    with (Bdiv mode_NE (constant f64 1 0) (Bplus mode_NE d (Slabs.zero 53 1024))).
  rewrite one_64. fold (Slabs.reciprocal 53 1024 prec_53 emax_1024 d).
  destruct d as [s| | |s m e H]; try discriminate F.
  - assert (E : Slabs.reciprocal 53 1024 prec_53 emax_1024 (B754_zero s) = B754_infinity false).
    { apply B2SF_inj. now destruct s; vm_compute. }
    rewrite E. destruct s; reflexivity.
  - assert (Finite : BinarySingleNaN.is_finite (Slabs.reciprocal 53 1024 prec_53 emax_1024 (B754_finite s m e H)) = true).
    { destruct U as [Z|U]; [|exact U]. exfalso. revert Z. apply F2R_neq_0. now destruct s. }
    set (i := Slabs.reciprocal _ _ _ _ _) in *. change (is_finite f64 i) with (BinarySingleNaN.is_finite i). rewrite Finite.
    repeat match goal with |- context [@Bplus ?p ?q ?a ?b mode_NE ?x ?z] => change (@Bplus p q a b mode_NE x z) with x end.
    assert (N : Beqb (B754_finite s m e H : num f64) (Slabs.zero 53 1024) = false) by now destruct s. unfold num, f64, ieee in N. rewrite N.
    rewrite zero_64. change (less f64 ?x ?y) with (Bltb x y). destruct (Bltb _ _); reflexivity.
Qed.

(** [Doubled::new]. [BOX-6] *)
Theorem doubled_new_agrees ox oy oz px py pz dx dy dz : let ok d := BinarySingleNaN.is_finite d = true /\
    (B2R d = 0 \/ BinarySingleNaN.is_finite (Slabs.reciprocal 53 1024 prec_53 emax_1024 d) = true) in
  ok dx -> ok dy -> ok dz ->
  Doubled_new f64 ox oy oz px py pz dx dy dz = let i d := fst (reciprocals_64 d) in let j d := snd (reciprocals_64 d) in
    (ox, oy, oz, px, py, pz, i dx, i dy, i dz, j dx, j dy, j dz).
Proof.
  intros ok [F1 U1] [F2 U2] [F3 U3]. unfold Doubled_new. cbv zeta.
  rewrite <- (doubled_reciprocals dx F1 U1), <- (doubled_reciprocals dy F2 U2), <- (doubled_reciprocals dz F3 U3). cbv zeta. reflexivity.
Qed.

(** * Usual rays *)

Notation float := (binary_float 24 128).
Notation finite := BinarySingleNaN.is_finite.

Lemma not_above (x : float) : finite x = true -> at_most f32 (absolute f32 x) (Arithmetic.constant f32 1 126) = true -> Rabs (B2R x) <= bpow radix2 126.
Proof.
  intros F H. change (Bleb (Babs x) (Arithmetic.constant f32 1 126) = true) in H.
  assert (V : B2R (Arithmetic.constant f32 1 126 : float) = bpow radix2 126).
  { rewrite <- SF2R_B2SF. replace (B2SF _) with (SpecFloat.S754_finite false 8388608 103) by (vm_compute; reflexivity).
    unfold SF2R. change 8388608%positive with (2 ^ 23)%positive. unfold F2R. simpl cond_Zopp. simpl Fnum. simpl Fexp. change 126%Z with (23 + 103)%Z. now rewrite bpow_plus. }
  rewrite Bleb_correct in H by (rewrite ?is_finite_Babs; assumption || reflexivity). rewrite V, B2R_Babs in H.
  revert H. case Rle_bool_spec; intros; assumption || discriminate.
Qed.

Lemma usual_axis o d lo hi : finite o = true -> finite d = true -> finite lo = true -> finite hi = true ->
  Rabs (B2R lo) <= bpow radix2 126 -> Rabs (B2R hi) <= bpow radix2 126 ->
  let direction := plus f32 d (Arithmetic.constant f32 0 0) in
  orb (less f32 (absolute f32 (over f32 (Arithmetic.constant f32 1 0) direction)) (Arithmetic.constant f32 16777215 104))
    (equal f32 direction (Arithmetic.constant f32 0 0)) = true -> at_most f32 (absolute f32 o) (Arithmetic.constant f32 1 126) = true ->
  Slabs.usual 24 128 prec_24 emax_128 (o, d, lo, hi).
Proof.
  intros Fo Fd Fl Fh L H. cbv zeta. intros U O. rewrite one_32 in U.
  split; [exact Fd|split; [|split; [split; [exact Fo|now apply not_above]|split; now split]]].
  apply orb_prop in U as [U|U].
  - right. unfold Slabs.reciprocal. change (over f32 ?x ?y) with (Bdiv mode_NE x y) in U. rewrite zero_32 in U.
    set (i := Bdiv mode_NE _ _) in *. change (finite i = true).
    destruct i as [s|s| |s m e B]; try reflexivity; vm_compute in U; discriminate U.
  - left. destruct d as [s| | |s m e B]; try discriminate Fd; [reflexivity|]. destruct s; discriminate U.
Qed.

(** [is_wide] of [Directed::new]: where it is not set, the ray and all planes within the region are what Slabs.v supposes. [BOX-2] *)
Theorem is_wide_agrees ox oy oz dx dy dz reach mx my mz mw away sx sy sz sw : let reaches (x : float) := finite x = true /\ Rabs (B2R x) <= B2R (reach : binary_float 53 1024) in
  finite ox = true -> finite oy = true -> finite oz = true -> finite dx = true -> finite dy = true -> finite dz = true ->
  finite (reach : binary_float 53 1024) = true -> snd (Directed_new f32 f64 f64_of_f32 ox oy oz dx dy dz reach mx my mz mw away sx sy sz sw) = false ->
  forall lx hx ly hy lz hz, reaches lx -> reaches hx -> reaches ly -> reaches hy -> reaches lz -> reaches hz ->
  let usual := Slabs.usual 24 128 prec_24 emax_128 in usual (ox, dx, lx, hx) /\ usual (oy, dy, ly, hy) /\ usual (oz, dz, lz, hz).
Proof.
  cbv zeta. intros Ox Oy Oz Dx Dy Dz R. unfold Directed_new. cbv zeta. cbn [snd]. intros W. apply orb_false_elim in W as [W Reach].
  apply orb_false_elim in W as [W _]. apply negb_false_iff in W. apply andb_prop in W as [W _].
  apply andb_prop in W as [W Z]. apply andb_prop in W as [X Y]. apply andb_prop in X as [OX X], Y as [OY Y], Z as [OZ Z].
  apply andb_prop in OX as [OX _], OY as [OY _], OZ as [OZ _].
  change (Bltb (f64_of_f32 (Arithmetic.constant f32 1 126)) reach = false) in Reach.
  assert (V : B2R (f64_of_f32 (Arithmetic.constant f32 1 126) : binary_float 53 1024) = bpow radix2 126).
  { rewrite <- SF2R_B2SF. replace (B2SF _) with (SpecFloat.S754_finite false 4503599627370496 74) by (vm_compute; reflexivity).
    unfold SF2R. change 4503599627370496%positive with (2 ^ 52)%positive. unfold F2R. simpl cond_Zopp. simpl Fnum. simpl Fexp.
    change 126%Z with (52 + 74)%Z. now rewrite bpow_plus. }
  rewrite Bltb_correct in Reach by (assumption || (vm_compute; reflexivity)). rewrite V in Reach.
  assert (M : B2R (reach : binary_float 53 1024) <= bpow radix2 126) by (revert Reach; case Rlt_bool_spec; intros; assumption || discriminate).
  intros lx hx ly hy lz hz [F1 B1] [F2 B2] [F3 B3] [F4 B4] [F5 B5] [F6 B6].
  split; [|split]; apply usual_axis; assumption || (eapply Rle_trans; [eassumption|exact M]).
Qed.
