(* Cases of the suite about wide trees. All machines answer each of them, and must agree. *)

open Yojson.Basic.Util

type node = { number : int; leaf : bool; kids : int list; ranks : int option list; hit : int option }

let nodes input =
  let listed name = match Json.field name input with `Null -> [||] | json -> Array.of_list (to_list json) in
  let ranks = listed "ranks" and hits = listed "hits" in
  let of_option = function `Null -> None | json -> Some (to_int json) in
  let node number kids =
    let at a = if number < Array.length a then a.(number) else `Null in
    { number; leaf = kids = None; kids = Option.value ~default:[] kids; hit = of_option (at hits);
      ranks = (match at ranks with `Null -> [] | json -> Stdlib.List.map of_option (to_list json)) }
  in
  Array.mapi node (Json.children input)

let rec tree nodes i =
  let { leaf; kids; _ } = nodes.(i) in
  if leaf then Wide.WLeaf
  else Wide.Inner (fun s -> Option.map (tree nodes) (Stdlib.List.nth_opt kids (Text.int_of_n s)))

let rec find nodes path =
  match path with [] -> nodes.(0) | s :: path -> nodes.(Stdlib.List.nth (find nodes path).kids (Text.int_of_n s))

(* The end and the best hit after some visits, from those at the beginning. *)
let rec after nodes start = function
  | [] -> start
  | k :: h -> (
      let ((e, best) as before) = after nodes start h in
      let node = find nodes k in
      match node.hit with
      | Some t when node.leaf && t <= e ->
          let better = match best with None -> true | Some b -> (t, node.number) < b in
          (t, if better then Some (t, node.number) else best)
      | _ -> before)

let search nodes b input =
  let start = (Json.int_or Search.never (Json.field "end" input), Json.hit input) in
  let sorted = Json.field "sorted" input <> `Bool false in
  let ask path h =
    let node = find nodes path in
    (* No wanted child is beyond (WIDE-2). *)
    let slots = 1 lsl Text.int_of_n b in
    let is_wanted r = (not sorted) || r - (r mod slots) <= fst (after nodes start h) in
    let of_slot s = function Some r when is_wanted r -> [ (s, r) ] | _ -> [] in
    let wanted = Stdlib.List.concat (Stdlib.List.mapi of_slot node.ranks) in
    if sorted then Stdlib.List.map Text.n_of_int (Stdlib.List.sort compare (Stdlib.List.map snd wanted))
    else
      let leaves, inner = Stdlib.List.partition (fun (s, _) -> nodes.(Stdlib.List.nth node.kids s).leaf) wanted in
      let slots = Stdlib.List.map (fun (s, _) -> Text.n_of_int s) in
      WideLeaves.leaves_first b (slots leaves) (slots inner)
  in
  let edge h = if sorted then Text.n_of_int (fst (after nodes start h)) else Text.n_of_int Search.never in
  let stop h = Json.flag "any" input && snd (after nodes start h) <> snd (after nodes start (Stdlib.List.tl h)) in
  ({ Wide.ask; stop; edge }, fun h -> snd (after nodes start h))

let events nodes b before visits =
  let key k = Text.hex_n (WideBits.key b k) in
  let event (before, events) k =
    let back =
      match before with
      | None -> []
      | Some (parent, true) when k <> [] && Stdlib.List.tl k = parent -> []
      | Some (from, _) ->
          (* Levels up to the node whose sibling comes next. *)
          [ Printf.sprintf "backtrack %s %d" (key k) (Stdlib.List.length from - Stdlib.List.length k) ]
    in
    let inner = not (find nodes k).leaf in
    (Some (k, inner), ((if inner then "enter " else "leaf ") ^ key k) :: back @ events)
  in
  let _, events = Stdlib.List.fold_left event (before, []) visits in
  `List (Stdlib.List.rev_map (fun e -> `String e) ("end" :: events))

let answer input =
  let b = Text.n_of_int (match to_int (Json.field "slots" input) with 2 -> 1 | 4 -> 2 | _ -> 3) in
  let nodes = nodes input in
  let tree = tree nodes 0 in
  let search, best = search nodes b input in
  let fuel = Text.nat (Array.length nodes + 1) in
  let numbers = WideBits.number_machine b (WideBits.path_of_key b) in
  let trails = ref [] in
  let shown = { numbers with path_of = (fun s -> trails := Json.hex_n (snd (Obj.magic s : BinNums.coq_N * BinNums.coq_N)) :: !trails; numbers.path_of s) } in
  let run machine state = WideMachine.run b machine tree search fuel state [] in
  let result before history =
    let events = ("events", events nodes b before (Stdlib.List.rev history)) in
    events :: (if Json.field "hits" input = `Null then [] else [ ("hit", Json.of_hit (best history)) ])
  in
  match Json.text "op" input with
  | "trace-wide" ->
      let levels keeper = WideLevels.level_machine b keeper in
      let machines =
        [ ("stack", WideMachine.stack_machine b); ("sets", levels (WideKeep.trail_keeper b));
          ("sets and bits", levels (WideKeep.word_keeper b (fun bit -> bit)));
          ("sets and cleared bits", levels (WideKeep.word_keeper b (fun _ -> false)));
          ("sets and ranks", levels (WideKeep.key_keeper b));
          ("restart-0", WideRestart.restart_machine b (Text.nat 0)); ("restart-2", WideRestart.restart_machine b (Text.nat 2)) ]
      in
      let expected = Some (Wide.reference b search tree) in
      Stdlib.List.iter
        (fun (name, (m : WideMachine.machine)) -> if run m m.start <> expected then raise (Binary.Differ (name ^ " differs from the reference")))
        machines;
      if run shown shown.start <> expected then raise (Binary.Differ "the machine of numbers differs from the reference");
      let trails = if Json.field "hits" input = `Null then [ ("trails", `List (Stdlib.List.rev !trails)) ] else [] in
      `Assoc (result None (snd (Option.get expected)) @ trails)
  | _ ->
      let key = Json.number "key" input in
      let at = WideBits.path_of_key b key in
      let state = (Obj.magic (key, Json.number "trail" input) : WideMachine.state) in
      let back = Json.text "next" input = "backtrack" in
      let state = if back then numbers.back (fun path -> search.ask path []) (search.edge []) state else Some state in
      let history = match state with None -> [] | Some state -> snd (Option.get (run numbers state)) in
      `Assoc (result (if back then Some (at, false) else None) history)
