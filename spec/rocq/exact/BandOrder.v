(** One answer on a device with single precision (BAND-5): what [test_triangle] of gpu-check/wgsl/triangle_band.wgsl does with the ends that Band.v
    has. Triangles come in any order, and one may come more than once. *)
Require Import Reals Lra Bool List Arith.
From Flocq Require Import Core.
Import ListNotations.
Open Scope R_scope.

Section Order.
(** The ends of the distance of each triangle that the line certainly meets, and its rounded distance, which is between them. *)
Variables low high rounded : nat -> R.
Hypothesis between : forall i, low i <= rounded i <= high i.
(** The interval. *)
Variables tmin stop : R.

(** The best triangle with [best_low], and [best_t]. *)
Record state : Type := State { best : option (nat * R); best_t : R }.
Definition start : state := State None stop.

(** One triangle; [None] is doubt, which ends the search. *)
Definition step (i : nat) (x : state) : option state :=
  if Rlt_bool (high i) tmin || Rlt_bool (best_t x) (low i) then Some x else
  if negb (Rle_bool tmin (low i) && Rle_bool (high i) stop) then None else
  let found := Some (State (Some (i, low i)) (Rmin (high i) (best_t x))) in
  match best x with
  | None => found
  | Some (j, best_low) => if Rlt_bool (high i) best_low then found else if Nat.eqb j i then Some x else None
  end.
Fixpoint search (triangles : list nat) (x : state) : option state :=
  match triangles with
  | [] => Some x
  | i :: rest => match step i x with Some y => search rest y | None => None end
  end.

Definition within (i : nat) : Prop := tmin <= rounded i <= stop.

(** Of the triangles that have come: the best is one of them, and any other that is hit is farther. *)
Definition right (seen : list nat) (x : state) : Prop :=
  match best x with
  | None => best_t x = stop /\ forall i, In i seen -> ~ within i
  | Some (j, best_low) => In j seen /\ within j /\ best_low = low j /\ best_t x = high j /\ forall i, In i seen -> within i -> i = j \/ rounded j < rounded i
  end.

Lemma step_is_right seen i x y : right seen x -> step i x = Some y -> right (i :: seen) y.
Proof.
  destruct x as [[[j l]|] b]; unfold right, step, within; cbn [best best_t]; pose proof (between i) as Bi.
  - intros (Seen & In_j & -> & -> & All). pose proof (between j) as Bj.
    destruct (Rlt_bool_spec (high i) tmin) as [L|L]; [|destruct (Rlt_bool_spec (high j) (low i)) as [H|H]]; cbn [orb].
    + intros [= <-]. cbn [best best_t]. repeat split; try lra; [now right|]. intros k [<-|K] W; [lra|now apply All].
    + intros [= <-]. cbn [best best_t]. repeat split; try lra; [now right|]. intros k [<-|K] W; [right; lra|now apply All].
    + destruct (Rle_bool_spec tmin (low i)) as [A|A]; [|discriminate]. destruct (Rle_bool_spec (high i) stop) as [B|B]; [|discriminate]. cbn [andb negb].
      destruct (Rlt_bool_spec (high i) (low j)) as [N|N].
      * intros [= <-]. cbn [best best_t]. split; [now left|]. split; [lra|]. split; [reflexivity|]. split; [apply Rmin_left; lra|].
        intros k [<-|K] W; [now left|]. right. destruct (All k K W) as [->|F]; lra.
      * destruct (Nat.eqb_spec j i) as [<-|_]; [|discriminate]. intros [= <-]. cbn [best best_t]. repeat split; try lra; [now right|].
        intros k [<-|K] W; [now left|now apply All].
  - intros (-> & All). destruct (Rlt_bool_spec (high i) tmin) as [L|L]; [|destruct (Rlt_bool_spec stop (low i)) as [H|H]]; cbn [orb].
    + intros [= <-]. cbn [best best_t]. split; [reflexivity|]. intros k [<-|K]; [lra|now apply All].
    + intros [= <-]. cbn [best best_t]. split; [reflexivity|]. intros k [<-|K]; [lra|now apply All].
    + destruct (Rle_bool_spec tmin (low i)) as [A|A]; [|discriminate]. destruct (Rle_bool_spec (high i) stop) as [B|B]; [|discriminate]. cbn [andb negb].
      intros [= <-]. cbn [best best_t]. split; [now left|]. split; [lra|]. split; [reflexivity|]. split; [apply Rmin_left; lra|].
      intros k [<-|K] W; [now left|]. now destruct (All k K).
Qed.

(** A search that ends without doubt has the triangle that is hit first, in the interval, and none is equally far; or none is hit. [BAND-5] *)
Theorem one_answer triangles x : search triangles start = Some x ->
  match best x with
  | None => forall i, In i triangles -> ~ within i
  | Some (j, _) => In j triangles /\ within j /\ forall i, In i triangles -> within i -> i = j \/ rounded j < rounded i
  end.
Proof.
  assert (G : forall rest seen s, right seen s -> search rest s = Some x -> right (rev rest ++ seen) x).
  { induction rest as [|i rest IH]; intros seen s Rs; cbn [search]; [intros [= <-]; exact Rs|].
    destruct (step i s) as [y|] eqn:S; [|discriminate]. intros H. cbn [rev]. rewrite <- app_assoc. apply (IH (i :: seen) y); [|exact H].
    exact (step_is_right seen i s y Rs S). }
  intros H. specialize (G triangles [] start). rewrite app_nil_r in G. assert (R0 : right [] start) by (split; [reflexivity|intros i []]).
  specialize (G R0 H). unfold right in G. assert (M : forall i, In i triangles -> In i (rev triangles)) by (intros i; apply in_rev).
  destruct (best x) as [[j l]|].
  - destruct G as (In_j & W & _ & _ & All). split; [now apply in_rev|]. split; [exact W|]. intros i K. now apply All, M.
  - destruct G as (_ & All). intros i K. now apply All, M.
Qed.
End Order.
