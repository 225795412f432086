(** The identity of [Corrected::of], src/geom/kernel/exact/corrected.rs, in real numbers: what the residual of three numbers adds to them is the
    true distance and the true weights. *)
Require Import Reals ZArith Lra.
Require Import StacklessExact.Filter.
Open Scope R_scope.

(** The residual of any three numbers corrects them exactly. [EXACT-14](1, 2) *)
Theorem residual_corrects v0 v1 v2 o d t u v : let x := determinants_of exactly v0 v1 v2 o d in
  let e1 := vsub exactly v1 v0 in let e2 := vsub exactly v2 v0 in let s := vsub exactly o v0 in
  let r := Vec (vx s + t * vx d - u * vx e1 - v * vx e2) (vy s + t * vy d - u * vy e1 - v * vy e2) (vz s + t * vz d - u * vz e1 - v * vz e2) in
  let n := cross exactly e1 e2 in let p := cross exactly d e2 in let m := cross exactly e1 d in
  det x <> 0 ->
  top_t x / det x = t + dot exactly n r / det x /\ edge_u x / det x = u + dot exactly p r / det x /\
  edge_v x / det x = v + dot exactly m r / det x.
Proof.
  intros x e1 e2 s r n p m N.
  assert (T : dot exactly n r = top_t x - t * det x) by (unfold n, r, s, e1, e2, x, exactly; simpl; unfold dot, cross; simpl; ring).
  assert (U : dot exactly p r = edge_u x - u * det x) by (unfold p, r, s, e1, e2, x, exactly; simpl; unfold dot, cross; simpl; ring).
  assert (V : dot exactly m r = edge_v x - v * det x) by (unfold m, r, s, e1, e2, x, exactly; simpl; unfold dot, cross; simpl; ring).
  rewrite T, U, V. repeat split; field; exact N.
Qed.

(** Of the true numbers nothing is left. [EXACT-14](3) *)
Theorem nothing_is_left v0 v1 v2 o d : let x := determinants_of exactly v0 v1 v2 o d in
  let e1 := vsub exactly v1 v0 in let e2 := vsub exactly v2 v0 in let s := vsub exactly o v0 in
  let t := top_t x / det x in let u := edge_u x / det x in let v := edge_v x / det x in
  det x <> 0 ->
  vx s + t * vx d - u * vx e1 - v * vx e2 = 0 /\ vy s + t * vy d - u * vy e1 - v * vy e2 = 0 /\ vz s + t * vz d - u * vz e1 - v * vz e2 = 0.
Proof.
  intros x e1 e2 s t u v N. assert (K : forall l, l * det x = 0 -> l = 0) by (intros l H; now destruct (Rmult_integral _ _ H)).
  unfold t, u, v. repeat split; apply K; field_simplify; try exact N; unfold s, e1, e2, x, exactly; simpl; unfold dot, cross; simpl; ring.
Qed.
