(** The half-open rule of src/geom/kernel/exact/parity.rs, in real numbers: PARITY-1. *)
Require Import Reals ZArith Lia Lra List.
From Flocq Require Import Core.
Require Import StacklessExact.Rounding StacklessExact.Triple StacklessExact.Filter.
Import ListNotations.
Open Scope R_scope.

(** The sign of the first number that is not 0. *)
Fixpoint first_sign (l : list R) : Z :=
  match l with [] => 0%Z | x :: l => if Rlt_dec x 0 then (-1)%Z else if Rlt_dec 0 x then 1%Z else first_sign l end.
Definition sign (x : R) : Z := first_sign [x].

(** c0 + c1 e + c2 e^2 + ... *)
Fixpoint poly (l : list R) (e : R) : R := match l with [] => 0 | c :: l => c + e * poly l e end.

Lemma poly_bound l : exists B, 0 <= B /\ forall e, 0 < e <= 1 -> Rabs (poly l e) <= B.
Proof.
  induction l as [|c l (B & P & H)]; [exists 0; split; [lra|]; intros; cbn; rewrite Rabs_R0; lra|]. exists (Rabs c + B).
  split; [pose proof (Rabs_pos c); lra|]. intros e He. cbn. apply add_b; [apply Rle_refl|]. rewrite <- (Rmult_1_l B). apply mul_b; [rewrite Rabs_pos_eq; lra|auto].
Qed.

(** For small e the first coefficient decides. [PARITY-1] *)
Theorem small_decides l : exists e0, 0 < e0 /\ forall e, 0 < e < e0 -> sign (poly l e) = first_sign l.
Proof.
  induction l as [|c l (e1 & P1 & H1)].
  { exists 1. split; [lra|]. intros. unfold sign. cbn. destruct (Rlt_dec 0 0); [lra|reflexivity]. }
  destruct (poly_bound l) as (B & PB & HB). destruct (Req_dec c 0) as [-> |Nc].
  - exists e1. split; [exact P1|]. intros e He. specialize (H1 e He). cbn [poly]. rewrite Rplus_0_l. unfold sign in *. cbn [first_sign] in *.
    destruct (Rlt_dec 0 0) as [L|_]; [lra|]. rewrite <- H1. assert (Q : forall x, x < 0 -> e * x < 0) by (intros; rewrite <- (Rmult_0_r e); apply Rmult_lt_compat_l; lra).
    assert (Q' : forall x, 0 < x -> 0 < e * x) by (intros; apply Rmult_lt_0_compat; lra). set (x := poly l e) in *.
    destruct (Rtotal_order x 0) as [L|[E|L]]; [pose proof (Q x L)|rewrite E, Rmult_0_r|pose proof (Q' x L)]; repeat (destruct Rlt_dec; try lra; try reflexivity).
  - exists (Rmin 1 (Rabs c / (B + 1))). assert (Pc : 0 < Rabs c) by now apply Rabs_pos_lt.
    split; [apply Rmin_glb_lt; [lra|apply Rdiv_lt_0_compat; lra]|]. intros e [He0 He]. pose proof (Rmin_l 1 (Rabs c / (B + 1))). pose proof (Rmin_r 1 (Rabs c / (B + 1))).
    assert (S : Rabs (e * poly l e) < Rabs c).
    { apply Rle_lt_trans with (e * B); [apply mul_b; [rewrite Rabs_pos_eq; lra|apply HB; lra]|].
      apply Rle_lt_trans with (e * (B + 1)); [apply Rmult_le_compat_l; lra|]. apply Rlt_le_trans with (Rabs c / (B + 1) * (B + 1)); [apply Rmult_lt_compat_r; lra|].
      right. field. lra. }
    cbn [poly]. unfold sign. cbn [first_sign]. apply Rabs_def2 in S. unfold Rabs in S. destruct (Rcase_abs c); repeat (destruct Rlt_dec; try lra; try reflexivity).
Qed.

(** * Edges *)

Definition cross3 (a b : vec) : vec := Vec (vy a * vz b - vz a * vy b) (vz a * vx b - vx a * vz b) (vx a * vy b - vy a * vx b).
Definition dot3 (a b : vec) : R := vx a * vx b + vy a * vy b + vz a * vz b.
Definition less (a b : vec) : vec := Vec (vx a - vx b) (vy a - vy b) (vz a - vz b).
Definition more (a b : vec) : vec := Vec (vx a + vx b) (vy a + vy b) (vz a + vz b).

Section Ray.
Variables o d : vec.

(** The edge function F of EXACT-2, for an origin, and what it changes by where the origin moves. *)
Definition F (o a b : vec) : R := dot3 d (cross3 (less a o) (less b o)).
Definition change (a b : vec) : vec := cross3 (less a b) d.

(** The rule. *)
Definition edge_sign (a b : vec) : Z := first_sign [F o a b; vx (change a b); vy (change a b); vz (change a b)].

Definition crossed (v0 v1 v2 : vec) : Prop := det (determinants_of exactly v0 v1 v2 o d) <> 0 /\
  edge_sign v0 v1 = edge_sign v1 v2 /\ edge_sign v1 v2 = edge_sign v2 v0.

(** U, V and W are edge functions, and add up to det. [EXACT-2, PARITY-1] *)
Theorem edges_are v0 v1 v2 : let x := determinants_of exactly v0 v1 v2 o d in
  edge_u x = - F o v2 v0 /\ edge_v x = - F o v0 v1 /\ edge_w x = - F o v1 v2 /\ edge_u x + edge_v x + edge_w x = det x.
Proof. cbv zeta. unfold F, exactly, dot3, cross3, less. simpl. unfold dot, exactly. simpl. repeat split; ring. Qed.

(** The origin moved by (e, e^2, e^3). *)
Definition moved (e : R) : vec := more o (Vec e (e * e) (e * e * e)).

(** For small e > 0 the sign of F from there is that of the rule. [PARITY-1] *)
Theorem rule_is_move a b : exists e0, 0 < e0 /\ forall e, 0 < e < e0 -> sign (F (moved e) a b) = edge_sign a b.
Proof.
  destruct (small_decides [F o a b; vx (change a b); vy (change a b); vz (change a b)]) as (e0 & P & H). exists e0. split; [exact P|].
  intros e He. unfold edge_sign. rewrite <- (H e He). f_equal. unfold F, moved, change, dot3, cross3, less, more. simpl. ring.
Qed.

Lemma first_sign_opp l : first_sign (map Ropp l) = (- first_sign l)%Z.
Proof. induction l as [|x l IH]; [reflexivity|]. cbn. repeat (destruct Rlt_dec; try lra; try reflexivity). exact IH. Qed.

(** Two triangles see an edge that they share with opposite signs if they run through it in opposite directions. [PARITY-1] *)
Theorem shared_edge a b : edge_sign b a = (- edge_sign a b)%Z.
Proof.
  unfold edge_sign. rewrite <- first_sign_opp. cbn [map]. f_equal. unfold F, change, dot3, cross3, less. simpl. repeat (f_equal; try ring).
Qed.

Lemma first_sign_0 l : first_sign l = 0%Z -> Forall (fun x => x = 0) l.
Proof. induction l as [|x l IH]; [constructor|]. cbn. destruct (Rlt_dec x 0); [discriminate|]. destruct (Rlt_dec 0 x); [discriminate|]. constructor; [lra|auto]. Qed.

(** No sign is 0 unless det is. [PARITY-1] *)
Theorem no_sign_is_0 v0 v1 v2 : det (determinants_of exactly v0 v1 v2 o d) <> 0 ->
  edge_sign v0 v1 <> 0%Z /\ edge_sign v1 v2 <> 0%Z /\ edge_sign v2 v0 <> 0%Z.
Proof.
  intros N. assert (K : forall a b c, det (determinants_of exactly v0 v1 v2 o d) = dot3 (change a b) c -> edge_sign a b <> 0%Z).
  { intros a b c D E. apply N. rewrite D. apply first_sign_0 in E. inversion_clear E as [|? ? _ E1]. inversion_clear E1 as [|? ? Ex E2].
    inversion_clear E2 as [|? ? Ey E3]. inversion_clear E3 as [|? ? Ez _]. change (vx (change a b) = 0) in Ex. change (vy (change a b) = 0) in Ey. change (vz (change a b) = 0) in Ez.
    unfold dot3. rewrite Ex, Ey, Ez. ring. }
  assert (D : det (determinants_of exactly v0 v1 v2 o d) = dot3 (change v0 v1) (less v0 v2) /\
    det (determinants_of exactly v0 v1 v2 o d) = dot3 (change v1 v2) (less v1 v0) /\ det (determinants_of exactly v0 v1 v2 o d) = dot3 (change v2 v0) (less v2 v1)).
  { unfold exactly, change, dot3, cross3, less. simpl. unfold dot, exactly. simpl. repeat split; ring. }
  destruct D as (D0 & D1 & D2). split; [|split]; eapply K; eassumption.
Qed.

(** A crossing is a hit of the line, edges and corners included. [PARITY-1] *)
Theorem crossed_is_met v0 v1 v2 : crossed v0 v1 v2 -> meets (determinants_of exactly v0 v1 v2 o d).
Proof.
  intros (N & E1 & E2). destruct (edges_are v0 v1 v2) as (U & V & W & S). cbv zeta in *. set (x := determinants_of exactly v0 v1 v2 o d) in *.
  assert (P : forall a b, (edge_sign a b = 1%Z -> 0 <= F o a b) /\ (edge_sign a b = (-1)%Z -> F o a b <= 0) /\ (edge_sign a b = 0%Z \/ edge_sign a b = 1%Z \/ edge_sign a b = (-1)%Z)).
  { intros a b. unfold edge_sign. cbn [first_sign]. repeat (destruct Rlt_dec); repeat split; intros; try discriminate; try lra; auto. }
  destruct (no_sign_is_0 v0 v1 v2 N) as (N0 & _). destruct (P v0 v1) as (A1 & A2 & A). destruct (P v1 v2) as (B1 & B2 & _). destruct (P v2 v0) as (C1 & C2 & _).
  assert (Q : forall y z, 0 < y -> 0 <= z -> 0 <= z / y) by (intros y z Y Z; apply Rmult_le_pos; [exact Z|now apply Rlt_le, Rinv_0_lt_compat]).
  assert (Q' : forall y z, y < 0 -> z <= 0 -> 0 <= z / y).
  { intros y z Y Z. replace (z / y) with (- z / - y) by (field; lra). apply Q; lra. }
  destruct A as [A|[A|A]]; [contradiction| |]; rewrite A in *.
  - specialize (A1 eq_refl). specialize (B1 (eq_sym E1)). assert (0 <= F o v2 v0) by (apply C1; congruence). assert (det x < 0) by lra.
    repeat split; [exact N|apply Q'; lra..].
  - specialize (A2 eq_refl). specialize (B2 (eq_sym E1)). assert (F o v2 v0 <= 0) by (apply C2; congruence). assert (0 < det x) by lra.
    repeat split; [exact N|apply Q; lra..].
Qed.

(** A hit in the interior is a crossing. [PARITY-1] *)
Theorem interior_is_crossed v0 v1 v2 : let x := determinants_of exactly v0 v1 v2 o d in
  meets x -> edge_u x <> 0 -> edge_v x <> 0 -> edge_w x <> 0 -> crossed v0 v1 v2.
Proof.
  intros x M U0 V0 W0. destruct (edges_are v0 v1 v2) as (U & V & W & _). cbv zeta in *. fold x in U, V, W. split; [apply M|].
  destruct (hit_signs _ _ _ _ M eq_refl) as [(S & (S1 & _) & (S2 & _) & (S3 & _))|(S & (_ & S1) & (_ & S2) & (_ & S3))];
    change (det x - edge_u x - edge_v x) with (edge_w x) in S3; unfold edge_sign; cbn [first_sign]; repeat (destruct Rlt_dec; try lra; auto).
Qed.

(** The rule says that the moved line meets the interior of the triangle, for every move that is small enough. [PARITY-1] *)
Theorem crossed_is_moved v0 v1 v2 : exists e0, 0 < e0 /\ forall e, 0 < e < e0 ->
  (crossed v0 v1 v2 <-> det (determinants_of exactly v0 v1 v2 (moved e) d) <> 0 /\
    sign (F (moved e) v0 v1) = sign (F (moved e) v1 v2) /\ sign (F (moved e) v1 v2) = sign (F (moved e) v2 v0)).
Proof.
  destruct (rule_is_move v0 v1) as (e1 & P1 & H1). destruct (rule_is_move v1 v2) as (e2 & P2 & H2). destruct (rule_is_move v2 v0) as (e3 & P3 & H3).
  exists (Rmin e1 (Rmin e2 e3)). split; [repeat apply Rmin_glb_lt; assumption|]. intros e [He0 He].
  pose proof (Rmin_l e1 (Rmin e2 e3)). pose proof (Rmin_r e1 (Rmin e2 e3)). pose proof (Rmin_l e2 e3). pose proof (Rmin_r e2 e3).
  rewrite (H1 e), (H2 e), (H3 e) by lra. unfold crossed. reflexivity.
Qed.
End Ray.
