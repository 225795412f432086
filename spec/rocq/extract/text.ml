(* Rocq's numbers as text and back: hexadecimal, as the suite and the Rust program write them. *)

open BinNums

let rec nat n = if n = 0 then Datatypes.O else Datatypes.S (nat (n - 1))
let rec of_nat = function Datatypes.O -> 0 | Datatypes.S n -> 1 + of_nat n

(* Lowest bit first, as the constructors are. *)
let digit bits = Stdlib.List.fold_right (fun bit rest -> (2 * rest) + bit) bits 0

let add_positive buffer k =
  let rec go k =
    let bit = function Coq_xI k -> (1, Some k) | Coq_xO k -> (0, Some k) | Coq_xH -> (1, None) in
    let rec four n rest bits =
      match rest with
      | Some k when n < 4 -> let b, rest = bit k in four (n + 1) rest (b :: bits)
      | _ -> (digit (Stdlib.List.rev bits), rest)
    in
    let value, rest = four 0 (Some k) [] in
    Option.iter go rest;
    Buffer.add_char buffer "0123456789abcdef".[value]
  in
  go k

let add_n buffer = function N0 -> Buffer.add_char buffer '0' | Npos k -> add_positive buffer k

let text_of add x =
  let buffer = Buffer.create 16 in
  add buffer x;
  Buffer.contents buffer

let hex k = text_of add_positive k
let hex_n n = text_of add_n n

let double b = function
  | N0 -> if b then Npos Coq_xH else N0
  | Npos k -> Npos (if b then Coq_xI k else Coq_xO k)

let of_digits base digits =
  let bits d = Stdlib.List.init base (fun i -> (d lsr (base - 1 - i)) land 1 = 1) in
  Stdlib.List.fold_left (fun n d -> Stdlib.List.fold_left (fun n b -> double b n) n (bits d)) N0 digits

let n_of_hex text = of_digits 4 (Stdlib.List.map (fun c -> int_of_string (Printf.sprintf "0x%c" c)) (Stdlib.List.of_seq (String.to_seq text)))

let n_of_int i = n_of_hex (Printf.sprintf "%x" i)

let rec int_of_positive = function Coq_xH -> 1 | Coq_xO k -> 2 * int_of_positive k | Coq_xI k -> (2 * int_of_positive k) + 1
let int_of_n = function N0 -> 0 | Npos k -> int_of_positive k

(* No node has the key 0. *)
let key_of_hex text = match n_of_hex text with Npos k -> k | N0 -> invalid_arg "a key of 0"
