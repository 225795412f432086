(* Cases of the suite about words. *)

open BinNums
open Yojson.Basic.Util

let answer input =
  let key () = Json.key "key" input and number name = Json.number name input in
  let depth () = Text.nat (to_int (Json.field "depth" input)) in
  let hex name n = [ (name, Json.hex_n n) ] in
  let levels n = [ ("levels", if n = N0 then `Null else `Int (Text.of_nat (Machine.ctz n))) ] in
  let fields =
    match Json.text "op" input with
    | "child" -> hex "key" (Npos (Tree.child (if Json.flag "right" input then R else L) (key ())))
    | "parent" -> hex "key" (match Sparse.parent (key ()) with None -> N0 | Some k -> Npos k)
    | "sibling" -> hex "key" (Npos (Machine.sibling (key ())))
    | "level-start" -> hex "key" (Implicit.level_start (key ()))
    | "depth" -> [ ("depth", `Int (Text.of_nat (Tree.depth (key ())))) ]
    | "descend" -> hex "trail" (Disjoint.push (Json.flag "both" input) (number "trail"))
    | "levels" -> levels (number "trail")
    | "backtrack" ->
        let trail = number "trail" in
        let k, t = Bits.leap (Npos (key ())) trail in
        levels trail @ hex "key" k @ hex "trail" t
    | "counter" -> hex "counter" (Bits.counter (depth ()) (number "trail"))
    (* The counter of a counter is the trail. *)
    | "counter-levels" -> levels (Bits.counter (depth ()) (number "counter"))
    | "swap" -> hex "index" (Bits.fcomp (number "index") (number "mask"))
    | op -> failwith op
  in
  `Assoc fields
