(** [FilteredQuery] and [Filtered] of src/trace/filter.rs: ray queries over the accepted hits. A search that looks at the filter last finds the
    first accepted hit; a search for any hit ends with its first one. *)
Require Import Reals NArith List Bool Sorted.
From Flocq Require Import Core BinarySingleNaN.
Require Import StacklessExact.Filter StacklessExact.Slabs StacklessExact.Answer.
Import ListNotations.
Open Scope R_scope.

Section Filters.
Variables o d : vec.
Variables tmin tmax : float.
Variable mesh : N -> option triangle.
Variable kernel : N -> option float.
Variable compare : N -> N -> comparison.
Variable met : box -> float -> bool.
Variable fit : box -> Prop.
Hypothesis kernel_is_exact : is_exact o d tmin tmax mesh kernel.
Hypothesis compare_is_exact : is_exact_order o d mesh kernel compare.
Hypothesis touched_is_met : forall b best t, fit b -> in_box (along o d t) b -> within t tmin tmax -> is_nan best = false ->
  nearest t <= value best -> met b best = true.

(** A hit: its triangle, its distance and its weights. *)
Variable weights : Type.
Variable weights_of : N -> weights.
Definition hit : Type := N * float * weights.
(** [Filter]: by triangle, and by hit. *)
Variable accepts_triangle : N -> bool.
Variable accepts_hit : hit -> bool.

Definition wanted (i : N) : bool := accepts_triangle i && match kernel i with Some t => accepts_hit (i, t, weights_of i) | None => false end.
(** The accepted hits: those of a mesh that has only their triangles. *)
Definition accepted (i : N) : option triangle := if wanted i then mesh i else None.
Definition filtered (i : N) : option float := if wanted i then kernel i else None.

(** [FilteredQuery::meet] for one triangle: the filter of hits comes last, for hits that come before the best one. In a query for any hit
    nothing is tested after the first. *)
Definition meet (is_any : bool) (i : N) (best : answer) : answer :=
  if is_any && match best with Some _ => true | None => false end || negb (accepts_triangle i) then best else
  match kernel i with
  | None => best
  | Some t =>
    let is_first := match best with Some b => is_less compare (t, i) b | None => true end in
    if negb is_first then best else if accepts_hit (i, t, weights_of i) then Some (t, i) else best
  end.

(** What it does is to accept the hits of the filter alone. [FILTER-1](1) *)
Theorem meet_accepts i best : meet false i best = accept filtered compare i best.
Proof.
  unfold meet, accept, filtered, wanted. cbn [andb orb]. destruct (accepts_triangle i); cbn [negb andb]; [|reflexivity].
  destruct (kernel i) as [t|]; [|reflexivity]. destruct best as [b|]; cbn [negb].
  - destruct (accepts_hit _), (is_less compare (t, i) b); reflexivity.
  - now destruct (accepts_hit _).
Qed.

Notation run := (run tmax filtered compare met).

(** The closest hit: whatever a search leaves out by boxes, with the best accepted hit so far, it ends with the first accepted one.
    [FILTER-1](2) *)
Theorem closest_accepted root best : covers mesh fit root -> run ([root], None) ([], best) ->
  is_least o d tmin tmax accepted filtered best.
Proof. exact (wanted_answer o d tmin tmax mesh kernel compare met fit wanted root best kernel_is_exact compare_is_exact touched_is_met). Qed.

(** All hits: of those in order, the filter retains the accepted ones, in order. [FILTER-1](2) *)
Theorem all_accepted hits : StronglySorted (less o d mesh) hits ->
  let retained := List.filter (fun h => wanted (snd h)) hits in
  StronglySorted (less o d mesh) retained /\ forall h, In h retained <-> In h hits /\ wanted (snd h) = true.
Proof.
  intros S retained. split; [|intros h; apply filter_In]. unfold retained. induction S as [|h hits S IH A]; [constructor|].
  cbn [List.filter]. destruct (wanted (snd h)); [|exact IH]. constructor; [exact IH|]. rewrite Forall_forall in *. intros x Hx.
  apply A. now apply filter_In in Hx.
Qed.

(** A query for any hit stops at its first, and till then its limit is tmax. So it ends with an accepted hit, if there is one, and with
    none otherwise. [FILTER-1](3) *)
Theorem any_accepted root ahead best : covers mesh fit root -> run ([root], None) (ahead, best) -> ahead = [] \/ best <> None ->
  match best with
  | Some (f, i) => kernel i = Some f /\ wanted i = true /\ exists t, hits o d tmin tmax mesh i t /\ value f = nearest t
  | None => forall i t, wanted i = true -> ~ hits o d tmin tmax mesh i t
  end.
Proof.
  intros C R E. assert (So : sound filtered best) by exact (run_sound tmax filtered compare met _ _ R I).
  destruct best as [[f i]|].
  - cbn [sound] in So. unfold filtered in So. destruct (wanted i) eqn:W; [|discriminate]. split; [exact So|]. split; [reflexivity|].
    pose proof (kernel_is_exact i) as K. rewrite So in K. destruct K as (t & H & _ & V). now exists t.
  - destruct E as [->|E]; [|now contradict E]. pose proof (closest_accepted root None C R) as L. cbn in L.
    intros i t W (v & M & H). apply (L i t). exists v. split; [|exact H]. unfold accepted. now rewrite W.
Qed.

(** In such a query [meet] changes nothing after the first hit, and before it does the same. [FILTER-1](3) *)
Theorem any_stops i best : meet true i best = match best with Some _ => best | None => accept filtered compare i None end.
Proof.
  destruct best as [b|]; [reflexivity|]. rewrite <- meet_accepts. reflexivity.
Qed.
End Filters.
