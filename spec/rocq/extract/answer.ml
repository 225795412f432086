(* The suite's protocol (spec/suite/INTERPRETING.md): the extracted machines as an implementation. *)

open Yojson.Basic.Util

let profiles =
  [ "key/u32"; "key/u64"; "key/u128"; "key/wide"; "hash/keys"; "trace/script"; "trace/complete"; "trace/tape"; "trace/node-left";
    "trace/node-sign"; "trace/disjoint"; "trace/wide"; "resume/state"; "resume/disjoint"; "resume/key-only"; "resume/wide" ]

let features = [ "trails"; "counters"; "registers"; "changing" ]
let strings list = `List (Stdlib.List.map (fun s -> `String s) list)

let hello =
  `Assoc
    [ ("protocol", `Int 1); ("name", `String "rocq"); ("version", `String "0.1.0"); ("profiles", strings profiles);
      ("features", strings features); ("limits", `Assoc []) ]

let answer level profile input =
  match (level, profile) with
  | "key", _ -> Keys.answer input
  | "hash", _ -> Binary.hashed_keys input
  | _, "wide" -> Slots.answer input
  | "trace", _ -> Binary.trace profile input
  | _ -> Binary.resume profile input

let reply json =
  match Json.text "cmd" json with
  | "hello" -> Some hello
  | "case" ->
      let result =
        match answer (Json.text "level" json) (Json.text "profile" json) (Json.field "input" json) with
        | result -> ("result", result)
        | exception Binary.Differ what -> ("unsupported", `String what)
      in
      Some (`Assoc [ ("seq", Json.field "seq" json); result ])
  | _ -> None

let () =
  let rec turn () =
    match reply (Yojson.Basic.from_string (input_line stdin)) with
    | Some json ->
        print_endline (Yojson.Basic.to_string json);
        turn ()
    | None -> ()
  in
  try turn () with End_of_file -> ()
