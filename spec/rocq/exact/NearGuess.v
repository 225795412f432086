(** The guess of src/geom/nearest.rs (NEAR-1), which is near a point of the triangle; so both bounds hold the triangle's distance. In double
    precision with gradual underflow, and without a greatest exponent. *)
Require Import Reals ZArith Lia Lra Psatz Bool.
From Flocq Require Import Core.
Require Import StacklessExact.Rounding StacklessExact.Filter StacklessExact.Range StacklessExact.NearDistance.
Require StacklessExact.Nearest.
Open Scope R_scope.

Local Instance prec_53 : Prec_gt_0 53 := eq_refl.

(** * Points near a triangle *)

Section Places.
Variable greatest : R.
Hypothesis usual : bpow radix2 (-200) <= greatest.

Let eta_small := eta_small _ usual.
Let positive := usual_pos _ usual.

(** One component of a guess: 13u M, and what the weights exceed 1 by moves it. *)
Lemma component_off a b c a' b' c' v w : F a' -> F b' -> F c' -> Rabs a' <= greatest -> Rabs b' <= greatest -> Rabs c' <= greatest ->
  Rabs (a - a') <= u * greatest -> Rabs (b - b') <= u * greatest -> Rabs (c - c') <= u * greatest ->
  0 <= v -> 0 <= w -> v + w <= 1 + 3 * u ->
  Rabs (a + v * (b - a) + w * (c - a) - R64 (R64 (a' + R64 (R64 (b' - a') * v)) + R64 (R64 (c' - a') * w))) <= 13 * u * greatest.
Proof.
  intros FA FB FC A B C OA OB OC V W S. pose proof eta_small as ES. pose proof positive as PM. pose proof eta_pos as PE.
  assert (MV : 0 <= greatest * v) by (apply Rmult_le_pos; lra). assert (MW : 0 <= greatest * w) by (apply Rmult_le_pos; lra).
  assert (MS : greatest * v + greatest * w <= greatest * (1 + 3 * u)) by (rewrite <- Rmult_plus_distr_l; apply Rmult_le_compat_l; lra).
  assert (U0 : 0 < u) by apply bpow_gt_0.
  (* An edge, and its product with a weight. *)
  assert (Edge : forall x t, F x -> Rabs x <= greatest -> 0 <= t ->
    Rabs ((R64 (x - a') - (x - a')) * t) <= 2 * u * (greatest * t) /\ Rabs (R64 (x - a') * t) <= 2 * (1 + u) * (greatest * t)).
  { intros x t Fx X T. pose proof (sum_off x (- a') Fx (generic_format_opp _ _ _ FA)) as O. fold (x - a') in O.
    pose proof (sub_b _ _ _ _ X A) as D. pose proof (from_off (R64 (x - a')) (x - a')) as G.
    assert (O' : Rabs (R64 (x - a') - (x - a')) <= u * (greatest + greatest)).
    { eapply Rle_trans; [exact O|]. apply Rmult_le_compat_l; lra. }
    rewrite !Rabs_mult, (Rabs_pos_eq t T). split.
    - replace (2 * u * (greatest * t)) with (u * (greatest + greatest) * t) by ring. now apply Rmult_le_compat_r.
    - replace (2 * (1 + u) * (greatest * t)) with ((u * (greatest + greatest) + (greatest + greatest)) * t) by ring. apply Rmult_le_compat_r; lra. }
  destruct (Edge b' v FB B V) as [EB MB]. destruct (Edge c' w FC C W) as [EC MC]. clear Edge.
  set (d := R64 (b' - a')) in *. set (e := R64 (c' - a')) in *.
  pose proof (off (d * v)) as OP. pose proof (off (e * w)) as OR. pose proof (from_off (R64 (d * v)) (d * v)) as GP. pose proof (from_off (R64 (e * w)) (e * w)) as GR.
  pose proof (sum_off a' _ FA (F_R64 (d * v))) as O1. pose proof (sum_off _ _ (F_R64 (a' + R64 (d * v))) (F_R64 (e * w))) as O2.
  set (p := R64 (d * v)) in *. set (r := R64 (e * w)) in *. set (s := R64 (a' + p)) in *. set (q := R64 (s + r)) in *.
  pose proof (from_off s (a' + p)) as GS. pose proof (Rabs_triang a' p) as T1. pose proof (Rabs_triang s r) as T2.
  assert (WA : Rabs ((a - a') * (1 - v - w)) <= u * greatest).
  { rewrite Rabs_mult. rewrite <- (Rmult_1_r (u * greatest)). apply Rmult_le_compat; try apply Rabs_pos; [exact OA|]. apply Rabs_le. rewrite u_is in S. lra. }
  assert (WB : Rabs ((b - b') * v) <= u * (greatest * v)) by (rewrite Rabs_mult, (Rabs_pos_eq v V), <- Rmult_assoc; now apply Rmult_le_compat_r).
  assert (WC : Rabs ((c - c') * w) <= u * (greatest * w)) by (rewrite Rabs_mult, (Rabs_pos_eq w W), <- Rmult_assoc; now apply Rmult_le_compat_r).
  set (wa := (a - a') * (1 - v - w)) in *. set (wb := (b - b') * v) in *. set (wc := (c - c') * w) in *.
  set (eb := (d - (b' - a')) * v) in *. set (ec := (e - (c' - a')) * w) in *.
  replace (a + v * (b - a) + w * (c - a) - q) with (wa + wb + wc - eb - ec - (p - d * v) - (r - e * w) - (s - (a' + p)) - (q - (s + r)))
    by (unfold wa, wb, wc, eb, ec; ring).
  set (f := p - d * v) in *. set (g := r - e * w) in *. set (h := s - (a' + p)) in *. set (k := q - (s + r)) in *.
  pose proof (sub_b _ _ _ _ (sub_b _ _ _ _ (sub_b _ _ _ _ (sub_b _ _ _ _ (sub_b _ _ _ _ (sub_b _ _ _ _ (add_b _ _ _ _ (add_b _ _ _ _ WA WB) WC) EB) EC) OP) OR) O1) O2) as Sum.
  eapply Rle_trans; [exact Sum|]. clear - ES PM PE MV MW MS MB MC OP OR GP GR O1 O2 GS T1 T2 A.
  set (mv := greatest * v) in *. set (mw := greatest * w) in *. set (dv := Rabs (d * v)) in *. set (ew := Rabs (e * w)) in *.
  set (ap := Rabs (a' + p)) in *. set (sr := Rabs (s + r)) in *. set (rp := Rabs p) in *. set (rr := Rabs r) in *. set (rs := Rabs s) in *.
  set (rf := Rabs f) in *. set (rg := Rabs g) in *. set (rh := Rabs h) in *. set (rk := Rabs k) in *. set (ra := Rabs a') in *.
  clearbody mv mw dv ew ap sr rp rr rs rf rg rh rk ra. rewrite u_is in *. lra.
Qed.

(** Where the weights exceed 1, they are made less. *)
Lemma component_moves a b c v w : Rabs a <= greatest * (1 + u) -> Rabs b <= greatest * (1 + u) -> Rabs c <= greatest * (1 + u) ->
  0 <= v -> 0 <= w -> 1 < v + w <= 1 + 3 * u ->
  Rabs (a + v / (v + w) * (b - a) + w / (v + w) * (c - a) - (a + v * (b - a) + w * (c - a))) <= 7 * u * greatest.
Proof.
  intros A B C V W S. pose proof positive as PM.
  replace (a + v / (v + w) * (b - a) + w / (v + w) * (c - a) - (a + v * (b - a) + w * (c - a)))
    with (- ((v + w - 1) * (v / (v + w) * (b - a) + w / (v + w) * (c - a)))) by (field; lra).
  rewrite Rabs_Ropp, Rabs_mult, (Rabs_pos_eq (v + w - 1)) by lra.
  set (i := v / (v + w)). set (j := w / (v + w)). assert (I : 0 <= i) by (apply Rle_mult_inv_pos; lra). assert (J : 0 <= j) by (apply Rle_mult_inv_pos; lra).
  assert (IJ : i + j = 1) by (unfold i, j; field; lra).
  assert (D : Rabs (i * (b - a) + j * (c - a)) <= 2 * (greatest * (1 + u))).
  { replace (2 * (greatest * (1 + u))) with (i * (2 * (greatest * (1 + u))) + j * (2 * (greatest * (1 + u)))) by (rewrite <- Rmult_plus_distr_r, IJ; ring).
    apply add_b; rewrite Rabs_mult, ?(Rabs_pos_eq i I), ?(Rabs_pos_eq j J); (apply Rmult_le_compat_l; [assumption|]).
    - pose proof (sub_b _ _ _ _ B A). lra.
    - pose proof (sub_b _ _ _ _ C A). lra. }
  apply Rle_trans with (3 * u * (2 * (greatest * (1 + u)))).
  - apply Rmult_le_compat; try apply Rabs_pos; lra.
  - rewrite u_is. lra.
Qed.

(** A vector that is near a point of the triangle. *)
Definition placed (a b c q : vec) : Prop := exists v w, Nearest.inside v w /\ bounded (20 * u * greatest) (vsub exactly (point a b c v w) q).

Lemma placed_next a b c q : placed b c a q -> placed a b c q.
Proof.
  intros (v & w & (V & W & S) & B). exists (1 - v - w), v. split; [split; [|split]; lra|].
  replace (point a b c (1 - v - w) v) with (point b c a v w); [exact B|]. unfold point, Nearest.at_, vsub, exactly. cbn [vx vy vz]. f_equal; ring.
Qed.
Lemma placed_swap a b c q : placed a c b q -> placed a b c q.
Proof.
  intros (v & w & (V & W & S) & B). exists w, v. split; [split; [|split]; lra|].
  replace (point a b c w v) with (point a c b v w); [exact B|]. unfold point, Nearest.at_, vsub, exactly. cbn [vx vy vz]. f_equal; ring.
Qed.
End Places.

(** * The guess *)

Definition vadd (a b : vec) : vec := Vec (R64 (vx a + vx b)) (R64 (vy a + vy b)) (R64 (vz a + vz b)).
Definition scaled (a : vec) (t : R) : vec := Vec (R64 (vx a * t)) (R64 (vy a * t)) (R64 (vz a * t)).

Section Guess.
Variable greatest : R.
Hypothesis usual : bpow radix2 (-200) <= greatest.
Variables a b c a' b' c' : vec.
Hypothesis FA : floats a'.
Hypothesis FB : floats b'.
Hypothesis FC : floats c'.
Hypothesis A : close greatest a a'.
Hypothesis B : close greatest b b'.
Hypothesis C : close greatest c c'.

Lemma exact_bounded x x' : close greatest x x' -> bounded (greatest * (1 + u)) x.
Proof.
  intros ((X1 & X2 & X3) & (D1 & D2 & D3)). unfold vsub, exactly in *. cbn [vx vy vz] in *.
  repeat split; (eapply Rle_trans; [eapply from_off|]; eapply Rle_trans; [apply Rplus_le_compat; eassumption|lra]).
Qed.

(** a + v b + w c with rounded edges. *)
Lemma inner_placed v w : 0 <= v -> 0 <= w -> v + w <= 1 + 3 * u ->
  placed greatest a b c (vadd (vadd a' (scaled (vsub R64 b' a') v)) (scaled (vsub R64 c' a') w)).
Proof.
  intros V W S. set (q := vadd _ _). assert (PU : 0 < u * greatest) by (apply Rmult_lt_0_compat; [apply bpow_gt_0|exact (usual_pos _ usual)]).
  assert (Off : bounded (13 * u * greatest) (vsub exactly (point a b c v w) q)).
  { destruct A as ((A1 & A2 & A3) & (A4 & A5 & A6)), B as ((B1 & B2 & B3) & (B4 & B5 & B6)), C as ((C1 & C2 & C3) & (C4 & C5 & C6)).
    destruct FA as (FA1 & FA2 & FA3), FB as (FB1 & FB2 & FB3), FC as (FC1 & FC2 & FC3).
    unfold q, vadd, scaled, point, Nearest.at_, vsub, exactly in *. cbn [vx vy vz] in *.
    repeat split; cbn [vx vy vz]; apply component_off; assumption. }
  destruct (Rle_or_lt (v + w) 1) as [In|Out].
  - exists v, w. split; [repeat split; assumption|]. destruct Off as (O1 & O2 & O3). repeat split; lra.
  - exists (v / (v + w)), (w / (v + w)). split.
    { split; [apply Rle_mult_inv_pos; lra|split; [apply Rle_mult_inv_pos; lra|]]. right. field. lra. }
    destruct (exact_bounded _ _ A) as (A1 & A2 & A3), (exact_bounded _ _ B) as (B1 & B2 & B3), (exact_bounded _ _ C) as (C1 & C2 & C3).
    destruct Off as (O1 & O2 & O3).
    assert (Step : forall x y z, Rabs (x - y) <= 7 * u * greatest -> Rabs (y - z) <= 13 * u * greatest -> Rabs (x - z) <= 20 * u * greatest).
    { intros x y z X Y. replace (x - z) with (x - y + (y - z)) by ring. eapply Rle_trans; [exact (add_b _ _ _ _ X Y)|lra]. }
    clearbody q. unfold point, Nearest.at_, vsub, exactly in *. cbn [vx vy vz] in *.
    repeat split; cbn [vx vy vz]; [apply (Step _ _ _) with (2 := O1)|apply (Step _ _ _) with (2 := O2)|apply (Step _ _ _) with (2 := O3)]; now apply component_moves.
Qed.

(** An edge is that without the third corner. *)
Lemma edge_placed v : 0 <= v <= 1 -> placed greatest a b c (vadd a' (scaled (vsub R64 b' a') v)).
Proof.
  intros V. assert (U0 : 0 < u) by apply bpow_gt_0. pose proof (inner_placed v 0 ltac:(lra) ltac:(lra) ltac:(lra)) as P.
  replace (vadd a' (scaled (vsub R64 b' a') v)) with (vadd (vadd a' (scaled (vsub R64 b' a') v)) (scaled (vsub R64 c' a') 0)); [exact P|].
  unfold vadd, scaled, vsub. cbn [vx vy vz]. rewrite !Rmult_0_r, round_0 by typeclasses eauto. rewrite !Rplus_0_r.
  rewrite !(round_generic radix2 fexp ZnearestE (R64 _)) by (apply F_R64); reflexivity.
Qed.

Lemma corner_placed : placed greatest a b c a'.
Proof.
  exists 0, 0. split; [repeat split; lra|]. destruct A as (_ & (A1 & A2 & A3)). unfold point, Nearest.at_, vsub, exactly in *. cbn [vx vy vz] in *.
  assert (PU : 0 < u * greatest) by (apply Rmult_lt_0_compat; [apply bpow_gt_0|exact (usual_pos _ usual)]).
  repeat split; cbn [vx vy vz]; rewrite !Rmult_0_l, !Rplus_0_r; lra.
Qed.
End Guess.

(** A quotient; none is a NaN. *)
Definition over (x y : R) : option R := if Req_bool y 0 then None else Some (R64 (x / y)).
Definition on_edge (a edge : vec) (t : option R) : option vec := option_map (fun t => vadd a (scaled edge t)) t.

(** [nearest]. *)
Definition guess (a b c : vec) : option vec :=
  let ab := vsub R64 b a in
  let ac := vsub R64 c a in
  let d1 := - dot R64 ab a in
  let d2 := - dot R64 ac a in
  if Rle_bool d1 0 && Rle_bool d2 0 then Some a else
  let d3 := - dot R64 ab b in
  let d4 := - dot R64 ac b in
  if Rle_bool 0 d3 && Rle_bool d4 d3 then Some b else
  let of_c := R64 (R64 (d1 * d4) - R64 (d3 * d2)) in
  if Rle_bool of_c 0 && Rle_bool 0 d1 && Rle_bool d3 0 then on_edge a ab (over d1 (R64 (d1 - d3))) else
  let d5 := - dot R64 ab c in
  let d6 := - dot R64 ac c in
  if Rle_bool 0 d6 && Rle_bool d5 d6 then Some c else
  let of_b := R64 (R64 (d5 * d2) - R64 (d1 * d6)) in
  if Rle_bool of_b 0 && Rle_bool 0 d2 && Rle_bool d6 0 then on_edge a ac (over d2 (R64 (d2 - d6))) else
  let of_a := R64 (R64 (d3 * d6) - R64 (d5 * d4)) in
  if Rle_bool of_a 0 && Rle_bool d3 d4 && Rle_bool d6 d5 then
    on_edge b (vsub R64 c b) (over (R64 (d4 - d3)) (R64 (R64 (d4 - d3) + R64 (d5 - d6)))) else
  if negb (Rlt_bool 0 of_a && Rlt_bool 0 of_b && Rlt_bool 0 of_c) then None else
  let all := R64 (R64 (of_a + of_b) + of_c) in
  Some (vadd (vadd a (scaled ab (R64 (of_b / all)))) (scaled ac (R64 (of_c / all)))).

Lemma R64_le x y : x <= y -> R64 x <= R64 y.
Proof. intros. apply round_le; typeclasses eauto || assumption. Qed.
Lemma R64_F x : F x -> R64 x = x.
Proof. intros. apply round_generic; typeclasses eauto || assumption. Qed.
Lemma F_0 : F 0.
Proof. apply generic_format_0. Qed.
Lemma R64_pos x : 0 <= x -> 0 <= R64 x.
Proof. intros H. rewrite <- (R64_F 0 F_0). now apply R64_le. Qed.

(** The weight on an edge. *)
Lemma quotient_inside x y : 0 <= x <= y -> 0 < y -> 0 <= R64 (x / y) <= 1.
Proof.
  intros X Y. assert (Q : 0 <= x / y <= 1).
  { split; [apply Rle_mult_inv_pos; lra|]. apply Rmult_le_reg_r with y; [exact Y|]. replace (x / y * y) with x by (field; lra). lra. }
  split; [apply R64_pos; lra|]. rewrite <- (R64_F 1); [apply R64_le; lra|]. change 1 with (bpow radix2 0). apply generic_format_bpow. unfold FLT_exp. lia.
Qed.
Lemma weight_inside x y t : F x -> 0 <= x -> x <= y -> over x (R64 y) = Some t -> 0 <= t <= 1.
Proof.
  intros Fx X Y. unfold over. destruct (Req_bool_spec (R64 y) 0) as [|N]; [discriminate|]. intros [= <-].
  pose proof (R64_le _ _ Y) as H. rewrite (R64_F x Fx) in H. apply quotient_inside; lra.
Qed.

(** The weights above the triangle: each positive, and not much more than 1 together. [NEAR-1] *)
Theorem weights_inside x y z : F x -> F y -> F z -> 0 < x -> 0 < y -> 0 < z -> let all := R64 (R64 (x + y) + z) in
  0 <= R64 (y / all) /\ 0 <= R64 (z / all) /\ R64 (y / all) + R64 (z / all) <= 1 + 3 * u.
Proof.
  intros Fx Fy Fz X Y Z all. pose proof (R64_le y (x + y) ltac:(lra)) as H. rewrite (R64_F y Fy) in H.
  pose proof (R64_le (y + z) (R64 (x + y) + z) ltac:(lra)) as L. fold all in L. pose proof (sum_off y z Fy Fz) as O.
  rewrite (Rabs_pos_eq (y + z)) in O by lra. apply Rabs_le_inv in O. assert (P : (y + z) * (1 - u) <= all) by lra.
  assert (A : 0 < all). { eapply Rlt_le_trans; [|exact P]. apply Rmult_lt_0_compat; [lra|]. rewrite u_is. lra. }
  assert (V : 0 <= y / all) by (apply Rle_mult_inv_pos; lra). assert (W : 0 <= z / all) by (apply Rle_mult_inv_pos; lra).
  split; [now apply R64_pos|split; [now apply R64_pos|]]. pose proof (off (y / all)) as OV. pose proof (off (z / all)) as OW.
  rewrite (Rabs_pos_eq (y / all) V) in OV. rewrite (Rabs_pos_eq (z / all) W) in OW. apply Rabs_le_inv in OV, OW.
  assert (S : (y / all + z / all) * (1 - u) <= 1).
  { apply Rmult_le_reg_r with all; [exact A|]. replace ((y / all + z / all) * (1 - u) * all) with ((y + z) * (1 - u)) by (field; lra). lra. }
  assert (E : eta <= u * u) by (rewrite <- bpow_plus; apply eta_is; lia). set (v := y / all) in *. set (w := z / all) in *.
  set (v' := R64 v) in *. set (w' := R64 w) in *. clear - S E OV OW. clearbody v w v' w'. rewrite u_is in *. lra.
Qed.

Lemma F_dot a b : F (- dot R64 a b).
Proof. apply generic_format_opp, F_R64. Qed.

Lemma le_of_bool x y : Rle_bool x y = true -> x <= y.
Proof. destruct (Rle_bool_spec x y); [auto|discriminate]. Qed.

Section Bounded.
Variable greatest : R.
Hypothesis usual : bpow radix2 (-200) <= greatest.
Variables a b c a' b' c' q : vec.
Hypothesis FA : floats a'.
Hypothesis FB : floats b'.
Hypothesis FC : floats c'.
Hypothesis A : close greatest a a'.
Hypothesis B : close greatest b b'.
Hypothesis C : close greatest c c'.

(** A guess is near a point of the triangle: 20u M in each component. [NEAR-1] *)
Theorem guess_is_placed : guess a' b' c' = Some q -> placed greatest a b c q.
Proof.
  unfold guess. pose proof (F_dot (vsub R64 b' a') a') as F1. pose proof (F_dot (vsub R64 c' a') a') as F2.
  set (d1 := - dot R64 (vsub R64 b' a') a') in *. set (d2 := - dot R64 (vsub R64 c' a') a') in *.
  set (d3 := - dot R64 (vsub R64 b' a') b'). set (d4 := - dot R64 (vsub R64 c' a') b').
  set (d5 := - dot R64 (vsub R64 b' a') c'). set (d6 := - dot R64 (vsub R64 c' a') c'). clearbody d1 d2 d3 d4 d5 d6. cbv zeta.
  destruct (Rle_bool d1 0 && Rle_bool d2 0).
  { intros [= <-]. now apply (corner_placed greatest usual a b c a'). }
  destruct (Rle_bool 0 d3 && Rle_bool d4 d3).
  { intros [= <-]. apply placed_next. now apply (corner_placed greatest usual b c a b'). }
  assert (FMC := F_R64 (R64 (d1 * d4) - R64 (d3 * d2))). set (of_c := R64 (R64 (d1 * d4) - R64 (d3 * d2))) in *. clearbody of_c.
  destruct (Rle_bool of_c 0 && Rle_bool 0 d1 && Rle_bool d3 0) eqn:Edge.
  { apply andb_prop in Edge as [Edge D3]. apply andb_prop in Edge as [_ D1]. apply le_of_bool in D1, D3. unfold on_edge.
    destruct (over d1 (R64 (d1 - d3))) as [t|] eqn:T; [|discriminate]. intros [= <-].
    apply (edge_placed greatest usual a b c a' b' c'); try assumption. exact (weight_inside d1 (d1 - d3) t F1 D1 ltac:(lra) T). }
  destruct (Rle_bool 0 d6 && Rle_bool d5 d6).
  { intros [= <-]. apply placed_next, placed_next. now apply (corner_placed greatest usual c a b c'). }
  assert (FMB := F_R64 (R64 (d5 * d2) - R64 (d1 * d6))). set (of_b := R64 (R64 (d5 * d2) - R64 (d1 * d6))) in *. clearbody of_b.
  clear Edge. destruct (Rle_bool of_b 0 && Rle_bool 0 d2 && Rle_bool d6 0) eqn:Edge.
  { apply andb_prop in Edge as [Edge D6]. apply andb_prop in Edge as [_ D2]. apply le_of_bool in D2, D6. unfold on_edge.
    destruct (over d2 (R64 (d2 - d6))) as [t|] eqn:T; [|discriminate]. intros [= <-]. apply placed_swap.
    apply (edge_placed greatest usual a c b a' c' b'); try assumption. exact (weight_inside d2 (d2 - d6) t F2 D2 ltac:(lra) T). }
  assert (FMA := F_R64 (R64 (d3 * d6) - R64 (d5 * d4))). set (of_a := R64 (R64 (d3 * d6) - R64 (d5 * d4))) in *. clearbody of_a.
  clear Edge. destruct (Rle_bool of_a 0 && Rle_bool d3 d4 && Rle_bool d6 d5) eqn:Edge.
  { apply andb_prop in Edge as [Edge D5]. apply andb_prop in Edge as [_ D4]. apply le_of_bool in D4, D5. unfold on_edge.
    destruct (over _ _) as [t|] eqn:T; [|discriminate]. intros [= <-]. apply placed_next.
    apply (edge_placed greatest usual b c a b' c' a'); try assumption. apply (weight_inside _ _ t (F_R64 (d4 - d3))) in T; [exact T|apply R64_pos; lra|].
    pose proof (R64_pos (d5 - d6) ltac:(lra)). lra. }
  destruct (Rlt_bool_spec 0 of_a) as [PA|]; [|discriminate]. destruct (Rlt_bool_spec 0 of_b) as [PB|]; [|discriminate].
  destruct (Rlt_bool_spec 0 of_c) as [PC|]; [|discriminate]. cbn [andb negb]. intros [= <-].
  destruct (weights_inside of_a of_b of_c FMA FMB FMC PA PB PC) as (V & W & S). now apply inner_placed.
Qed.

(** A point of the triangle is no farther than the upper bound, if the guess is near one. *)
Lemma placed_is_below_far : placed greatest a b c q -> exists v w, Nearest.inside v w /\ norm (point a b c v w) <= far q greatest.
Proof.
  intros (v & w & I & O). exists v, w. split; [exact I|]. eapply Rle_trans; [apply (norm_add q)|]. apply norm_bounded in O.
  pose proof (margin_least greatest usual) as M. pose proof (norm_pos q) as N.
  pose proof (usual_pos _ usual) as PM. pose proof (eta_small _ usual) as E.
  unfold far. set (n := norm q) in *. set (o := norm (vsub _ _ _)) in *. set (g := margin greatest) in *. set (l := length q). assert (L0 : 0 <= l) by apply length_pos.
  clearbody g o.
  assert (Up : n + 36 * u * greatest <= R64 (R64 (l * (1 + 8 * u)) + g)); [|rewrite u_is in *; lra].
  destruct (Rle_or_lt n (bpow radix2 (-500))) as [Small|Large].
  - assert (n <= u * greatest).
    { apply Rle_trans with (1 := Small). apply Rle_trans with (u * bpow radix2 (-200)); [rewrite <- bpow_plus; apply bpow_le; lia|].
      apply Rmult_le_compat_l; [apply bpow_ge_0|exact usual]. }
    pose proof (R64_pos (l * (1 + 8 * u)) ltac:(apply Rmult_le_pos; [exact L0|rewrite u_is; lra])) as P. set (y := R64 (l * (1 + 8 * u))) in *.
    pose proof (rounded_least (y + g) (63 * u * greatest) ltac:(rewrite u_is; lra) ltac:(lra)) as R.
    set (r := R64 (y + g)) in *. clear - R E PM H. clearbody r n. rewrite u_is in *. lra.
  - apply length_least in Large. fold n l in Large.
    pose proof (rounded_least (l * (1 + 8 * u)) (n * (1 + 3 * u)) ltac:(apply Rmult_le_pos; [exact N|rewrite u_is; lra])) as R1.
    assert (H : n * (1 + 3 * u) <= l * (1 + 8 * u)) by (clear - Large N L0; clearbody n l; rewrite u_is in *; lra). specialize (R1 H).
    set (y := R64 (l * (1 + 8 * u))) in *.
    pose proof (rounded_least (y + g) (n * (1 + 3 / 2 * u) + 62 * u * greatest)) as R2.
    assert (H0 : 0 <= n * (1 + 3 / 2 * u) + 62 * u * greatest) by (assert (0 <= n * (1 + 3 / 2 * u)) by (apply Rmult_le_pos; [exact N|rewrite u_is; lra]); rewrite u_is in *; lra).
    assert (H1 : n * (1 + 3 / 2 * u) + 62 * u * greatest <= y + g) by (clear - R1 M E N PM; clearbody n y; rewrite u_is in *; lra).
    specialize (R2 H0 H1). set (r := R64 (y + g)) in *. clear - R2 E N PM. clearbody n r. rewrite u_is in *. lra.
Qed.
End Bounded.

(** * The distance *)

(** d is the distance of the triangle from the point. *)
Definition is_distance (a b c p : vec) (d : R) : Prop :=
  (forall v w, Nearest.inside v w -> d <= norm (vsub exactly (point a b c v w) p)) /\
  (exists v w, Nearest.inside v w /\ norm (vsub exactly (point a b c v w) p) = d).

Lemma point_moved a b c p v w : vsub exactly (point a b c v w) p = point (vsub exactly a p) (vsub exactly b p) (vsub exactly c p) v w.
Proof. unfold point, Nearest.at_, vsub, exactly. cbn [vx vy vz]. f_equal; ring. Qed.

Lemma floats_sub a b : floats (vsub R64 a b).
Proof. repeat split; apply F_R64. Qed.

(** [bounds]: for corners and a point that are floats, and a greatest component of 2^-200 at least, the distance is at least the lower bound,
    from any vector; and at most the upper one, from the guess. [NEAR-1] *)
Theorem bounds_hold a b c p greatest d : floats a -> floats b -> floats c -> floats p ->
  let a' := vsub R64 a p in let b' := vsub R64 b p in let c' := vsub R64 c p in
  bounded greatest a' -> bounded greatest b' -> bounded greatest c' -> bpow radix2 (-200) <= greatest -> is_distance a b c p d ->
  (forall q, near q a' b' c' greatest <= d) /\ (forall q, guess a' b' c' = Some q -> d <= far q greatest).
Proof.
  intros FA FB FC FP a' b' c' BA BB BC M (Least & v & w & I & Here).
  pose proof (relative_is_close _ _ _ FA FP BA) as A. pose proof (relative_is_close _ _ _ FB FP BB) as B. pose proof (relative_is_close _ _ _ FC FP BC) as C.
  split; intros q.
  - rewrite <- Here, point_moved. exact (near_is_below _ M _ _ _ _ _ _ _ _ _ A B C I).
  - intros G. apply (guess_is_placed greatest M _ _ _ _ _ _ _ (floats_sub a p) (floats_sub b p) (floats_sub c p) A B C) in G.
    apply (placed_is_below_far greatest M) in G as (i & j & J & H). rewrite <- point_moved in H. specialize (Least i j J). lra.
Qed.

(** So if both bounds round to one number, in any format, the distance rounds to it. [NEAR-1] *)
Theorem agreed_bounds_are_answer emin prec (_ : Prec_gt_0 prec) low high d : low <= d <= high ->
  let RN := round radix2 (FLT_exp emin prec) ZnearestE in RN low = RN high -> RN d = RN low.
Proof.
  intros [Low High] RN E. pose proof (round_le radix2 (FLT_exp emin prec) ZnearestE _ _ Low). pose proof (round_le radix2 (FLT_exp emin prec) ZnearestE _ _ High).
  unfold RN in *. lra.
Qed.
