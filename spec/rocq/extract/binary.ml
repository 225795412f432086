(* Cases of the suite about binary trees. All machines answer each of them, and must agree. *)

open Yojson.Basic.Util
open Search

exception Differ of string

let rec cells_at children cell i =
  let cells = cells_at children cell in
  let below = match children.(i) with None -> None | Some kids -> Some (cells (Stdlib.List.hd kids), cells (Stdlib.List.nth kids 1)) in
  { cell = cell i (below = None); below }

let nowhere = { leaf = false; miss = false; right_first = false; axis = 0; enter = 0; exit = never; hit = None; slot = 0 }

(* The field `cells`. *)
let scene input =
  let described = Array.of_list (to_list (Json.field "cells" input)) in
  let cell slot leaf =
    let json = described.(slot) in
    let distance name = match Json.field name json with `Null -> None | t -> Some (to_int t) in
    { leaf; slot; miss = Json.flag "miss" json; right_first = Json.flag "right_first" json;
      axis = Json.int_or 0 (Json.field "axis" json); enter = Option.value ~default:0 (distance "enter");
      exit = Option.value ~default:never (distance "exit"); hit = distance "hit" }
  in
  cells_at (Json.children input) cell 0

(* The field `script`: a scene whose nodes are found by their slots. *)
let scripted input =
  let script = Json.text "script" input in
  let cells = cells_at (Json.children input) (fun slot leaf -> { nowhere with slot; leaf }) 0 in
  let says h = script.[(find cells (Stdlib.List.hd h)).cell.slot] in
  let decide h : Tree.descent =
    match says h with 'l' -> Only L | 'r' -> Only R | 'L' -> Both L | 'R' -> Both R | _ -> Neither
  in
  let no _ = false and zero _ = BinNums.N0 in
  let stop h = says h = '!' in
  (cells, fun () -> { decide; stop; mark = no; found = no; begins = zero; ends = zero; best = ref None })

let rec depth (k : BinNums.positive) = match k with Coq_xH -> 0 | Coq_xO k | Coq_xI k -> 1 + depth k

(* The trace of some visits [TRACE-1], after the node [before], if there is one. *)
let events tree before visits =
  let event (before, events) (s : Extract.shown) =
    let k = s.s_node in
    let key = Text.hex k in
    let back =
      match before with
      | None -> []
      | Some (_, true) when k <> BinNums.Coq_xH && Sparse.parent k = Option.map fst before -> []
      | Some (b, _) -> [ Printf.sprintf "backtrack %s %d" key (depth b - depth k) ]
    in
    let inner = match Tree.at_key tree k with Some (Tree.Node _) -> true | _ -> false in
    (Some (k, inner), ((if inner then "enter " else "leaf ") ^ key) :: back @ events)
  in
  let _, events = Stdlib.List.fold_left event (before, []) visits in
  `List (Stdlib.List.rev_map (fun e -> `String e) ("end" :: events))

(* The answer of all machines, each from a search of its own. The results are those of the first. *)
let all search runs =
  let result (name, run) =
    let search = search () in
    match run search with None -> raise (Differ (name ^ " loses its way")) | Some (_, visits) -> (name, (visits, !(search.best)))
  in
  let results = Stdlib.List.map result runs in
  let seen (visits, best) = (Stdlib.List.map (fun (s : Extract.shown) -> s.s_node) visits, best) in
  let first, expected = Stdlib.List.hd results in
  Stdlib.List.iter (fun (name, r) -> if seen r <> seen expected then raise (Differ (name ^ " differs from " ^ first))) results;
  results

let machines tree =
  Extract.[ ("hash-only", hash_only); ("hashed", hashed tree); ("sparse", sparse); ("stack", stack); ("implicit-a", implicit_a);
            ("implicit-a1", implicit_a1); ("implicit-b", implicit_b); ("implicit-b1", implicit_b1); ("afra", afra);
            ("uncle", uncle tree) ]

let pruners tree =
  Extract.[ ("hash-only", hash_only_disjoint); ("hashed", hashed_disjoint tree); ("sparse", sparse_disjoint);
            ("afra", afra_disjoint); ("uncle", uncle_disjoint tree); ("stack", stack_disjoint) ]

let result tree ?(more = []) results =
  let optional show = function None -> `Null | Some x -> show x in
  let column name f = `List (Stdlib.List.map f (fst (Stdlib.List.assoc name results))) in
  `Assoc
    ([ ("events", events tree None (fst (snd (Stdlib.List.hd results))));
       ("trails", column "hash-only" (fun (s : Extract.shown) -> optional Json.hex_n s.s_trail));
       ("counters", column "sparse" (fun s -> optional Json.hex_n s.s_counter));
       ("registers", column "hashed" (fun s -> optional Json.hex s.s_register)) ]
    @ more)

let with_hit results = [ ("hit", Json.of_hit (snd (snd (Stdlib.List.hd results)))) ]

let trace profile input =
  match profile with
  | "script" | "complete" ->
      let cells, search = scripted input in
      let tree = tree_of cells in
      result tree (all search (Stdlib.List.map (fun (name, m) -> (name, Watch.run m tree)) (machines tree)))
  | "disjoint" ->
      let cells = scene input in
      let tree = tree_of cells in
      let runs = Stdlib.List.map (fun (name, m) -> (name, Watch.run_pruning m tree)) (pruners tree) in
      let results = all (fun () -> start cells ~any:false Children) (runs @ [ ("reference", Watch.pruned_reference tree) ]) in
      result tree results ~more:(with_hit results)
  | _ ->
      let order =
        match profile with
        | "node-left" -> Some (fun _ -> Tree.L)
        | "node-sign" -> Some (by_sign (to_int (Json.field "octant" input)))
        | _ -> None
      in
      let cells = scene input in
      let tree = tree_of cells in
      let runs = Stdlib.List.map (fun (name, m) -> (name, Watch.run m tree)) (machines tree) in
      let left = if profile = "node-left" then [ ("left-first", Watch.run Extract.left_first tree) ] else [] in
      let test = Option.fold ~none:Children ~some:(fun first -> Nodes first) order in
      let by_node first =
        let first k = first (find cells k).cell in
        [ ("skip", Watch.run (Extract.skips first) tree); ("hapala", Watch.run (Extract.hapala first) tree) ]
      in
      let left = left @ Option.fold ~none:[] ~some:by_node order in
      let results = all (fun () -> start cells ~any:(Json.flag "any" input) test) (runs @ left @ [ ("reference", Watch.reference tree) ]) in
      result tree results ~more:(with_hit results)

(* A state that is taken up: before the visit of its node, or on its way back from it. *)
let resume profile input =
  let k = Json.key "key" input in
  let back = profile <> "key-only" && Json.text "next" input = "backtrack" in
  let answer tree ?(hit = false) results =
    let before = if back then Some (k, false) else None in
    `Assoc (("events", events tree before (fst (snd (Stdlib.List.hd results)))) :: (if hit then with_hit results else []))
  in
  let next backtrack go state =
    if not back then go state else match backtrack state with None -> Some (false, []) | Some state -> go state
  in
  if profile = "disjoint" then
    let cells = scene input in
    let tree = tree_of cells in
    let run (m : Extract.viewed_pruner) search =
      next m.pruning.pback
        (fun state -> Watch.go_on_pruning m state [] (Tree.size tree) tree search)
        (m.pfrom k (Json.number "trail" input) (Json.number "marks" input))
    in
    let runs = Stdlib.List.map (fun (name, m) -> (name, run m)) (pruners tree) in
    answer tree ~hit:true (all (fun () -> start ?hit:(Json.hit input) cells ~any:false Children) runs)
  else
    let cells, search = scripted input in
    let tree = tree_of cells in
    let trail = if profile = "key-only" then Resume.all_ones k else Json.number "trail" input in
    let run (name, (m : Extract.viewed)) =
      Option.map
        (fun from ->
          ( name,
            fun search ->
              next m.machine.backtrack (fun state -> Watch.go_on m state [] (Tree.size tree) tree search) (from k trail) ))
        m.from
    in
    answer tree (all search (Stdlib.List.filter_map run (machines tree)))

(* [HASH-3] *)
let hashed_keys input =
  let cells = cells_at (Json.children input) (fun slot leaf -> { nowhere with slot; leaf }) 0 in
  let tree = tree_of cells in
  let ui, ul = match to_list (Json.field "reach" input) with [ ui; ul ] -> (to_int ui, to_int ul) | _ -> invalid_arg "reach" in
  let is_hashed = Extract.is_hashed tree (Text.nat ui) (Text.nat ul) in
  (* Level by level, so keys ascend. *)
  let rec levels = function
    | [] -> []
    | nodes ->
        let kids (k, node) = match node.below with None -> [] | Some (l, r) -> [ (BinNums.Coq_xO k, l); (BinNums.Coq_xI k, r) ] in
        nodes @ levels (Stdlib.List.concat_map kids nodes)
  in
  let keys = Stdlib.List.filter is_hashed (Stdlib.List.map fst (levels [ (BinNums.Coq_xH, cells) ])) in
  `Assoc [ ("keys", `List (Stdlib.List.map Json.hex keys)) ]
