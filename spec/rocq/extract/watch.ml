(* Runs the extracted machines, and sees the state at each visit. *)

open Extract

(* Each visit asks for the key of its node, once: so what is asked for it is what is visited. *)
let watched key view seen s =
  let key = key s in
  Option.iter (fun k -> seen := view s k :: !seen) key;
  key

(* From a state, after a history: whether the search was stopped, and what was seen. [None] if the machine lost its way. *)
let go_on { machine; view } state history fuel tree (search : Search.search) =
  let seen = ref [] in
  let machine = { machine with Machine.key_of = watched machine.key_of view seen } in
  Option.map (fun (stopped, _) -> (stopped, Stdlib.List.rev !seen))
    (Machine.run machine tree search.decide search.stop fuel state history)

let run viewed tree search = go_on viewed viewed.machine.start [] (Tree.size tree) tree search

let go_on_pruning { pruning; pview } state history fuel tree (search : Search.search) =
  let seen = ref [] in
  let pruning = { pruning with Disjoint.pkey = watched pruning.pkey pview seen } in
  Option.map (fun (stopped, _) -> (stopped, Stdlib.List.rev !seen))
    (Disjoint.prun tree search.decide search.mark search.stop search.found pruning fuel state history)

let run_pruning viewed tree search = go_on_pruning viewed viewed.pruning.pstart [] (Tree.size tree) tree search

(* Without a bound: the theorems say that they end. *)
let rec endless = Datatypes.S endless

(* The restart trail in words, with a short stack: also what it passes again, which is true of an inner node that is asked
   again. Who is asked knows what is visited. *)
let laine word length tree (search : Search.search) =
  let seen = ref [] in
  let see passed h = seen := (only_node (Stdlib.List.hd h), passed) :: !seen in
  let decide h = see false h; search.decide h in
  let again _ h = see true h; search.decide h in
  let stop h = see false h; search.stop h in
  Option.map (fun (stopped, _) -> (stopped, Stdlib.List.rev !seen))
    (LaineMachine.laine_run word length tree decide again stop true endless (LaineMachine.laine_start word) [])

let stack_with_distances tree (search : Search.search) =
  Option.map (fun (stopped, history) -> (stopped, Stdlib.List.rev_map only_node history))
    (PruningStack.distance_run tree search.decide search.stop search.begins search.ends (Tree.size tree) (BinNums.Coq_xH, []) [])

(* The recursive reference, for what has no machine of its own. *)
let reference tree (search : Search.search) =
  let stopped, history = Tree.reference search.decide search.stop tree in
  Some (stopped, Stdlib.List.rev_map only_node history)

let pruned_reference tree (search : Search.search) =
  let stopped, history = Disjoint.pruned_reference tree search.decide search.mark search.stop search.found in
  Some (stopped, Stdlib.List.rev_map only_node history)
