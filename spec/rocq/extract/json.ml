(* What is needed of the suite's JSON. *)

open Yojson.Basic.Util

let field = member
let text name json = to_string (field name json)
let int_or default = function `Null -> default | json -> to_int json
let flag name json = match field name json with `Null -> false | json -> to_bool json
let key name json = Text.key_of_hex (text name json)
let number name json = Text.n_of_hex (text name json)

(* The children of each node, [None] for a leaf. *)
let children json =
  let node = function `Null -> None | json -> Some (Stdlib.List.map to_int (to_list json)) in
  Array.of_list (Stdlib.List.map node (to_list (field "children" json)))

(* The best hit, of before or of the end. *)
let hit json = match field "hit" json with `Null -> None | hit -> Some (to_int (field "t" hit), to_int (field "node" hit))

let of_hit = function
  | None -> `Null
  | Some (t, node) -> `Assoc [ ("t", `Int t); ("node", `Int node) ]

let hex_n n = `String (Text.hex_n n)
let hex k = `String (Text.hex k)
