(* Reads cases and what the Rust traversals saw of them (crates/check/examples/visits.rs), has the machines see the same cases,
   and compares visit by visit: node, key, trail, counter, second trail and register. *)

open Search

(* Numbers with a space between, from a place in a line. *)
let numbers line from =
  let at = ref from in
  fun () ->
    let value = ref 0 in
    while !at < String.length line && line.[!at] <> ' ' do
      value := (10 * !value) + Char.code line.[!at] - 48;
      incr at
    done;
    incr at;
    !value

(* "case ANY OCTANT" and for each node, parents before children, left before right, five numbers: flags, where it is entered,
   left and hit, the last two one greater and 0 for none, and its slot. *)
let rec cells next =
  let flags = next () in
  let enter = next () in
  let exit = next () in
  let hit = next () in
  let slot = next () in
  let leaf = flags land 1 = 1 in
  let cell =
    { leaf; miss = flags land 2 = 2; right_first = flags land 4 = 4; axis = flags lsr 3; enter;
      exit = (if exit = 0 then never else exit - 1);
      hit = (if hit = 0 then None else Some (hit - 1));
      slot }
  in
  if leaf then { cell; below = None }
  else
    let left = cells next in
    let right = cells next in
    { cell; below = Some (left, right) }

(* [plain] and [pruned]: what the machine of key and trail sees, and that with a second trail. *)
type case = {
  line : string; any : bool; octant : int; all : cells; tree : Tree.tree; height : int;
  plain : Extract.shown list Lazy.t; pruned : Extract.shown list Lazy.t }

let case_of line =
  let next = numbers line 5 in
  let any = next () = 1 in
  let octant = next () in
  let all = cells next in
  let tree = tree_of all in
  let visits run = snd (Option.get (run tree (start all ~any Children))) in
  { line; any; octant; all; tree; height = Text.of_nat (Tree.height tree);
    plain = lazy (visits (Watch.run Extract.hash_only)); pruned = lazy (visits (Watch.run_pruning Extract.hash_only_disjoint)) }

let add_visit buffer ((s : Extract.shown), passed) =
  let optional add x =
    Buffer.add_char buffer ':';
    Option.iter (add buffer) x
  in
  Buffer.add_char buffer ' ';
  Text.add_positive buffer s.s_node;
  optional Text.add_positive s.s_key;
  optional Text.add_n s.s_trail;
  optional Text.add_n s.s_counter;
  optional Text.add_n s.s_marks;
  optional Text.add_positive s.s_register;
  if passed then Buffer.add_char buffer '~'

(* What the machine of a traversal sees, as a line of the Rust program without the names. *)
let seen_passing ?hit case run test =
  let search = start ?hit case.all ~any:case.any test in
  let buffer = Buffer.create 256 in
  (match run case.tree search with
  | None -> Buffer.add_string buffer " lost"
  | Some (_, visits) -> Stdlib.List.iter (add_visit buffer) visits);
  (match !(search.best) with
  | None -> Buffer.add_string buffer " none"
  | Some (t, slot) -> Printf.bprintf buffer " hit %d %d" t slot);
  Buffer.contents buffer

let visited run tree search =
  Option.map (fun (stopped, visits) -> (stopped, Stdlib.List.map (fun s -> (s, false)) visits)) (run tree search)

let seen ?hit case run test = seen_passing ?hit case (visited run) test

(* From this height on the machine of words is asked, which is slower. Below it the theorem says that it is the other one. *)
let high = 24

let machine case name word =
  let plain viewed = Some (seen case (Watch.run viewed) Children) in
  let prunes viewed = Some (seen case (Watch.run_pruning viewed) Children) in
  let by_node viewed =
    let first = by_sign case.octant in
    Some (seen case (Watch.run (viewed (fun k -> first (find case.all k).cell))) (Nodes first))
  in
  let in_words w = if case.height >= high then plain (Extract.hash_only_in (Text.nat w)) else plain Extract.hash_only in
  match (name, word) with
  | "stack", _ -> plain Extract.stack
  | "hash-only", "u32" -> in_words 32
  | "hash-only", "u64" -> in_words 64
  | "hash-only", "u128" -> in_words 128
  | "hash-only", _ -> plain Extract.hash_only
  (* These differ in what the table is. *)
  | ("complete" | "glassner"), _ -> plain Extract.keyed
  | "implicit-a", _ -> plain Extract.implicit_a
  | "implicit-a1", _ -> plain Extract.implicit_a1
  | "implicit-b", _ -> plain Extract.implicit_b
  | "implicit-b1", _ -> plain Extract.implicit_b1
  | "sparse", _ -> plain Extract.sparse
  | "afra", _ -> plain Extract.afra
  | "uncle", _ -> plain (Extract.uncle case.tree)
  | "hashed", _ -> plain (Extract.hashed case.tree)
  | "left-first", _ -> Some (seen case (Watch.run Extract.left_first) left_first)
  | "sparse-disjoint", _ -> prunes Extract.sparse_disjoint
  | "afra-disjoint", _ -> prunes Extract.afra_disjoint
  | "uncle-disjoint", _ -> prunes (Extract.uncle_disjoint case.tree)
  | "hashed-disjoint", _ -> prunes (Extract.hashed_disjoint case.tree)
  | "stack-disjoint", _ -> prunes Extract.stack_disjoint
  | "stack-t0", _ -> Some (seen case Watch.stack_with_distances Children)
  | "skip", _ -> Some (seen case (Watch.run (Extract.skips (fun _ -> Tree.L))) left_first)
  | "skip-octant", _ -> by_node Extract.skips
  | "hapala", _ -> by_node Extract.hapala
  | _ when String.starts_with ~prefix:"laine-" name ->
      let number text from = int_of_string (String.sub text from (String.length text - from)) in
      Some (seen_passing case (Watch.laine (Text.nat (number word 1)) (Text.nat (number name 6))) Children)
  | _ -> None

(* A state that was put aside before a visit: the number of visits, key, trail, second trail, and the best hit. It has to be that
   of the machine of key and trail, and what comes after it that of the machine that goes on. *)
let resumed case name state =
  let tree = case.tree in
  let states = if String.ends_with ~suffix:"-disjoint" name then case.pruned else case.plain in
  let is_state n key trail marks =
    match Stdlib.List.nth_opt (Lazy.force states) (int_of_string n) with
    | None -> false
    | Some s -> s.s_key = Some key && s.s_trail = Some trail && Option.value ~default:BinNums.N0 s.s_marks = marks
  in
  match String.split_on_char ' ' state with
  | [ n; key; trail; marks; t; slot ] -> (
      let k = Text.key_of_hex key and trail = Text.n_of_hex trail and marks = Text.n_of_hex marks in
      let hit = if t = "-" then None else Some (int_of_string t, int_of_string slot) in
      let fuel = Tree.size tree in
      let plain (m : Extract.viewed) =
        seen ?hit case (Watch.go_on m ((Option.get m.from) k trail) [] fuel) Children
      in
      let prunes (m : Extract.viewed_pruner) = seen ?hit case (Watch.go_on_pruning m (m.pfrom k trail marks) [] fuel) Children in
      match name with
      | _ when not (is_state n k trail marks) -> " no state of the machine"
      | "hash-only" -> plain Extract.hash_only
      | "hashed" -> plain (Extract.hashed tree)
      | "uncle" -> plain (Extract.uncle tree)
      | "afra" -> plain Extract.afra
      | "sparse" -> plain Extract.sparse
      | "hashed-disjoint" -> prunes (Extract.hashed_disjoint tree)
      | "uncle-disjoint" -> prunes (Extract.uncle_disjoint tree)
      | "afra-disjoint" -> prunes Extract.afra_disjoint
      | "sparse-disjoint" -> prunes Extract.sparse_disjoint
      | _ -> failwith ("no machine goes on for " ^ name))
  | _ -> failwith ("no state: " ^ state)

type counts = { mutable cases : int; mutable searches : int; mutable visits : int; mutable height : int }

let () =
  let counts = { cases = 0; searches = 0; visits = 0; height = 0 } in
  let by_name = Hashtbl.create 64 in
  let differ = ref [] and run = ref None and ended = ref None in
  let case : case option ref = ref None and last = ref ("", "") in
  (* Words that are wide enough make no difference to what is expected. *)
  let expected name word =
    let key = if name = "hash-only" && (Option.get !case).height >= high then name ^ word else name in
    if fst !last <> key then
      last := (key, match machine (Option.get !case) name word with Some text -> text | None -> failwith ("no machine for " ^ name));
    snd !last
  in
  let compare line name word at =
    let case_now = Option.get !case in
    let text, at =
      match String.index_from_opt line at ';' with
      | Some semicolon ->
          let state = String.sub line (at + 1) (semicolon - at - 2) in
          (resumed case_now (String.sub name 7 (String.length name - 7)) state, semicolon + 1)
      | None -> (expected name word, at)
    in
    let found = String.sub line at (String.length line - at) in
    counts.searches <- counts.searches + 1;
    String.iter (fun c -> if c = ' ' then counts.visits <- counts.visits + 1) found;
    Hashtbl.replace by_name name (1 + Option.value ~default:0 (Hashtbl.find_opt by_name name));
    if text <> found then begin
      if Stdlib.List.length !differ < 20 then
        Printf.printf "DIFFERS: %s %s\n  %s\n  Rust:   %s\n  machine:%s\n%!" name word (Option.get !case).line found text;
      differ := name :: !differ
    end
  in
  (try
     while true do
       let line = input_line stdin in
       match String.index line ' ' with
       | 4 when String.sub line 0 5 = "case " ->
           let read = case_of line in
           case := Some read;
           last := ("", "");
           counts.cases <- counts.cases + 1;
           counts.height <- max counts.height read.height
       | 3 when String.sub line 0 4 = "run " -> run := Some (String.sub line 4 (String.length line - 4))
       | 3 when String.sub line 0 4 = "end " -> ended := Some (int_of_string (String.sub line 4 (String.length line - 4)))
       | name_end ->
           let word_end = try String.index_from line (name_end + 1) ' ' with Not_found -> String.length line in
           compare line (String.sub line 0 name_end) (String.sub line (name_end + 1) (word_end - name_end - 1)) word_end
     done
   with End_of_file -> ());
  (* A program that died on its way has compared less than it was to. *)
  if !ended <> Some counts.cases || counts.cases = 0 then failwith "the cases end before they should";
  let errors = Stdlib.List.length !differ in
  let rows = Stdlib.List.sort Stdlib.compare (Stdlib.List.of_seq (Hashtbl.to_seq by_name)) in
  (match (Sys.argv, !run) with
  | [| _; path |], Some run ->
      let file = open_out path in
      let row (name, n) = Printf.sprintf "%S:%d" name n in
      Printf.fprintf file {|{"run":%s,"cases":%d,"visits":%d,"height":%d,"errors":%d,"searches":{%s}}|} run counts.cases counts.visits
        counts.height errors (String.concat "," (Stdlib.List.map row rows));
      output_char file '\n';
      close_out file
  | _ -> ());
  Stdlib.List.iter (fun (name, n) -> Printf.printf "%-16s %10d\n" name n) rows;
  Printf.printf "differ: %d cases to height %d, %d searches, %d visits, %d differ\n" counts.cases counts.height counts.searches
    counts.visits errors;
  if errors > 0 then exit 1
