(* A search over a small scene, one cell for each node: what the library's tapes and the suite's `cells` say. It decides by the
   best hit so far, so decisions change on the way. *)

open BinNums
open Tree

type cell = {
  leaf : bool;
  miss : bool;
  right_first : bool;
  axis : int;
  enter : int;
  exit : int;  (** [never] where it is not left *)
  hit : int option;
  slot : int;
}

type cells = { cell : cell; below : (cells * cells) option }

let never = 0xffff_ffff

let rec tree_of cells = match cells.below with None -> Leaf | Some (l, r) -> Node (tree_of l, tree_of r)

let rec find cells = function
  | Coq_xH -> cells
  | Coq_xO k -> fst (Option.get (find cells k).below)
  | Coq_xI k -> snd (Option.get (find cells k).below)

(* Where the children are tested: at their parent, or each at its own visit, which has an order. *)
type test = Children | Nodes of (cell -> side)

(* The functions of the history that the machines ask for. Each is asked with histories that grow, so that the best hit so far
   is kept instead of computed anew. [best] may hold a hit of before. *)
type search = {
  decide : history -> descent;
  stop : history -> bool;
  mark : history -> bool;
  found : history -> bool;
  begins : history -> BinNums.coq_N;
  ends : history -> BinNums.coq_N;
  best : (int * int) option ref;
}

let start ?hit cells ~any test =
  let best = ref hit in
  let here h = find cells (Stdlib.List.hd h) in
  let wanted c = (not c.miss) && match !best with None -> true | Some (t, _) -> c.enter <= t in
  let children node =
    let l, r = Option.get node.below in
    (l.cell, r.cell)
  in
  let right_comes_first node =
    let l, r = children node in
    r.enter < l.enter || (r.enter = l.enter && node.cell.right_first)
  in
  let decide h =
    let node = here h in
    match test with
    | Nodes first -> if wanted node.cell then Both (first node.cell) else Neither
    | Children -> (
        let l, r = children node in
        match (wanted l, wanted r) with
        | false, false -> Neither
        | true, false -> Only L
        | false, true -> Only R
        | true, true -> Both (if right_comes_first node then R else L))
  in
  (* Looking twice changes nothing. *)
  let look c =
    let counts = match test with Children -> not c.miss | Nodes _ -> wanted c in
    match c.hit with
    | Some t when counts && (match !best with None -> true | Some b -> (t, c.slot) < b) -> best := Some (t, c.slot)
    | _ -> ()
  in
  let is_here c = match !best with Some (_, slot) -> slot = c.slot | None -> false in
  let stop h =
    let c = (here h).cell in
    look c;
    any && is_here c
  in
  let found h =
    let c = (here h).cell in
    look c;
    is_here c && match !best with Some (t, _) -> t <= c.exit | None -> false
  in
  let mark h =
    let node = here h in
    let l, r = children node in
    match decide h with
    | Only L | Both L -> l.exit < r.enter
    | Only R | Both R -> r.exit < l.enter
    | Neither -> false
  in
  (* Where the second child begins, and where the search ends by now. *)
  let begins h =
    let l, r = children (here h) in
    Text.n_of_int (match decide h with Both R -> l.enter | _ -> r.enter)
  in
  let ends _ = Text.n_of_int (match !best with Some (t, _) -> t | None -> never) in
  { decide; stop; mark; found; begins; ends; best }

let left_first = Nodes (fun _ -> L)
let by_sign octant c = if (octant lsr c.axis) land 1 = 1 then R else L
