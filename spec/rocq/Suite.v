(** Cases of the conformance suite with what it expects. Written by crates/suite/tests/rocq_suite.rs. *)

Require Import List PArith NArith.
Require Import Tree Cases.
Import ListNotations.
Open Scope N_scope.

(* trace/complete/left-0 *)
Example suite_0 : suite_seen Leaf
  []
  []
  = suite_expected false
  [(0x1%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/complete/left-1 *)
Example suite_1 : suite_seen (Node Leaf Leaf)
  [(0x1%positive, Both L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/complete/right-1 *)
Example suite_2 : suite_seen (Node Leaf Leaf)
  [(0x1%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/complete/left-2 *)
Example suite_3 : suite_seen (Node (Node Leaf Leaf) (Node Leaf Leaf))
  [(0x1%positive, Both L); (0x2%positive, Both L); (0x3%positive, Both L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x3); (0x5%positive, 0x2); (0x3%positive, 0x0); (0x6%positive, 0x1); (0x7%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/complete/right-2 *)
Example suite_4 : suite_seen (Node (Node Leaf Leaf) (Node Leaf Leaf))
  [(0x1%positive, Both R); (0x2%positive, Both R); (0x3%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x3); (0x6%positive, 0x2); (0x2%positive, 0x0); (0x5%positive, 0x1); (0x4%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/complete/turns-2 *)
Example suite_5 : suite_seen (Node (Node Leaf Leaf) (Node Leaf Leaf))
  [(0x1%positive, Both L); (0x2%positive, Both R); (0x3%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x3); (0x4%positive, 0x2); (0x3%positive, 0x0); (0x7%positive, 0x1); (0x6%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/complete/some-2 *)
Example suite_6 : suite_seen (Node (Node Leaf Leaf) (Node Leaf Leaf))
  [(0x1%positive, Both L); (0x2%positive, Only R); (0x3%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x2); (0x3%positive, 0x0); (0x7%positive, 0x1); (0x6%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/complete/left-3 *)
Example suite_7 : suite_seen (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf)))
  [(0x1%positive, Both L); (0x2%positive, Both L); (0x4%positive, Both L); (0x5%positive, Both L); (0x3%positive, Both L); (0x6%positive, Both L); (0x7%positive, Both L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x3); (0x8%positive, 0x7); (0x9%positive, 0x6); (0x5%positive, 0x2); (0xa%positive, 0x5); (0xb%positive, 0x4); (0x3%positive, 0x0); (0x6%positive, 0x1); (0xc%positive, 0x3); (0xd%positive, 0x2); (0x7%positive, 0x0); (0xe%positive, 0x1); (0xf%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/complete/right-3 *)
Example suite_8 : suite_seen (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf)))
  [(0x1%positive, Both R); (0x2%positive, Both R); (0x4%positive, Both R); (0x5%positive, Both R); (0x3%positive, Both R); (0x6%positive, Both R); (0x7%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x3); (0xf%positive, 0x7); (0xe%positive, 0x6); (0x6%positive, 0x2); (0xd%positive, 0x5); (0xc%positive, 0x4); (0x2%positive, 0x0); (0x5%positive, 0x1); (0xb%positive, 0x3); (0xa%positive, 0x2); (0x4%positive, 0x0); (0x9%positive, 0x1); (0x8%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/complete/turns-3 *)
Example suite_9 : suite_seen (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf)))
  [(0x1%positive, Both L); (0x2%positive, Both R); (0x4%positive, Both L); (0x5%positive, Both L); (0x3%positive, Both R); (0x6%positive, Both L); (0x7%positive, Both L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x3); (0xa%positive, 0x7); (0xb%positive, 0x6); (0x4%positive, 0x2); (0x8%positive, 0x5); (0x9%positive, 0x4); (0x3%positive, 0x0); (0x7%positive, 0x1); (0xe%positive, 0x3); (0xf%positive, 0x2); (0x6%positive, 0x0); (0xc%positive, 0x1); (0xd%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/complete/some-3 *)
Example suite_10 : suite_seen (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf)))
  [(0x1%positive, Both L); (0x2%positive, Only R); (0x4%positive, Only L); (0x5%positive, Both L); (0x3%positive, Both R); (0x6%positive, Both R); (0x7%positive, Both L)]
  [0xa%positive]
  = suite_expected true
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x2); (0xa%positive, 0x5)].
Proof. evaluated. Qed.

(* trace/complete/left-4 *)
Example suite_11 : suite_seen (Node (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf))) (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf))))
  [(0x1%positive, Both L); (0x2%positive, Both L); (0x4%positive, Both L); (0x8%positive, Both L); (0x9%positive, Both L); (0x5%positive, Both L); (0xa%positive, Both L); (0xb%positive, Both L); (0x3%positive, Both L); (0x6%positive, Both L); (0xc%positive, Both L); (0xd%positive, Both L); (0x7%positive, Both L); (0xe%positive, Both L); (0xf%positive, Both L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x3); (0x8%positive, 0x7); (0x10%positive, 0xf); (0x11%positive, 0xe); (0x9%positive, 0x6); (0x12%positive, 0xd); (0x13%positive, 0xc); (0x5%positive, 0x2); (0xa%positive, 0x5); (0x14%positive, 0xb); (0x15%positive, 0xa); (0xb%positive, 0x4); (0x16%positive, 0x9); (0x17%positive, 0x8); (0x3%positive, 0x0); (0x6%positive, 0x1); (0xc%positive, 0x3); (0x18%positive, 0x7); (0x19%positive, 0x6); (0xd%positive, 0x2); (0x1a%positive, 0x5); (0x1b%positive, 0x4); (0x7%positive, 0x0); (0xe%positive, 0x1); (0x1c%positive, 0x3); (0x1d%positive, 0x2); (0xf%positive, 0x0); (0x1e%positive, 0x1); (0x1f%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/complete/right-4 *)
Example suite_12 : suite_seen (Node (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf))) (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf))))
  [(0x1%positive, Both R); (0x2%positive, Both R); (0x4%positive, Both R); (0x8%positive, Both R); (0x9%positive, Both R); (0x5%positive, Both R); (0xa%positive, Both R); (0xb%positive, Both R); (0x3%positive, Both R); (0x6%positive, Both R); (0xc%positive, Both R); (0xd%positive, Both R); (0x7%positive, Both R); (0xe%positive, Both R); (0xf%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x3); (0xf%positive, 0x7); (0x1f%positive, 0xf); (0x1e%positive, 0xe); (0xe%positive, 0x6); (0x1d%positive, 0xd); (0x1c%positive, 0xc); (0x6%positive, 0x2); (0xd%positive, 0x5); (0x1b%positive, 0xb); (0x1a%positive, 0xa); (0xc%positive, 0x4); (0x19%positive, 0x9); (0x18%positive, 0x8); (0x2%positive, 0x0); (0x5%positive, 0x1); (0xb%positive, 0x3); (0x17%positive, 0x7); (0x16%positive, 0x6); (0xa%positive, 0x2); (0x15%positive, 0x5); (0x14%positive, 0x4); (0x4%positive, 0x0); (0x9%positive, 0x1); (0x13%positive, 0x3); (0x12%positive, 0x2); (0x8%positive, 0x0); (0x11%positive, 0x1); (0x10%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/complete/turns-4 *)
Example suite_13 : suite_seen (Node (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf))) (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf))))
  [(0x1%positive, Both L); (0x2%positive, Both R); (0x4%positive, Both L); (0x8%positive, Both R); (0x9%positive, Both R); (0x5%positive, Both L); (0xa%positive, Both R); (0xb%positive, Both R); (0x3%positive, Both R); (0x6%positive, Both L); (0xc%positive, Both R); (0xd%positive, Both R); (0x7%positive, Both L); (0xe%positive, Both R); (0xf%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x3); (0xa%positive, 0x7); (0x15%positive, 0xf); (0x14%positive, 0xe); (0xb%positive, 0x6); (0x17%positive, 0xd); (0x16%positive, 0xc); (0x4%positive, 0x2); (0x8%positive, 0x5); (0x11%positive, 0xb); (0x10%positive, 0xa); (0x9%positive, 0x4); (0x13%positive, 0x9); (0x12%positive, 0x8); (0x3%positive, 0x0); (0x7%positive, 0x1); (0xe%positive, 0x3); (0x1d%positive, 0x7); (0x1c%positive, 0x6); (0xf%positive, 0x2); (0x1f%positive, 0x5); (0x1e%positive, 0x4); (0x6%positive, 0x0); (0xc%positive, 0x1); (0x19%positive, 0x3); (0x18%positive, 0x2); (0xd%positive, 0x0); (0x1b%positive, 0x1); (0x1a%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/complete/some-4 *)
Example suite_14 : suite_seen (Node (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf))) (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf))))
  [(0x1%positive, Both L); (0x2%positive, Only R); (0x4%positive, Only L); (0x8%positive, Only R); (0x9%positive, Both R); (0x5%positive, Both L); (0xa%positive, Only L); (0xb%positive, Both L); (0x3%positive, Both R); (0x6%positive, Both R); (0xc%positive, Both R); (0xd%positive, Both L); (0x7%positive, Both L); (0xe%positive, Only R); (0xf%positive, Both R)]
  [0x1a%positive]
  = suite_expected true
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x2); (0xa%positive, 0x5); (0x14%positive, 0xa); (0xb%positive, 0x4); (0x16%positive, 0x9); (0x17%positive, 0x8); (0x3%positive, 0x0); (0x7%positive, 0x1); (0xe%positive, 0x3); (0x1d%positive, 0x6); (0xf%positive, 0x2); (0x1f%positive, 0x5); (0x1e%positive, 0x4); (0x6%positive, 0x0); (0xd%positive, 0x1); (0x1a%positive, 0x3)].
Proof. evaluated. Qed.

(* trace/complete/left-5 *)
Example suite_15 : suite_seen (Node (Node (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf))) (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf)))) (Node (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf))) (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf)))))
  [(0x1%positive, Both L); (0x2%positive, Both L); (0x4%positive, Both L); (0x8%positive, Both L); (0x10%positive, Both L); (0x11%positive, Both L); (0x9%positive, Both L); (0x12%positive, Both L); (0x13%positive, Both L); (0x5%positive, Both L); (0xa%positive, Both L); (0x14%positive, Both L); (0x15%positive, Both L); (0xb%positive, Both L); (0x16%positive, Both L); (0x17%positive, Both L); (0x3%positive, Both L); (0x6%positive, Both L); (0xc%positive, Both L); (0x18%positive, Both L); (0x19%positive, Both L); (0xd%positive, Both L); (0x1a%positive, Both L); (0x1b%positive, Both L); (0x7%positive, Both L); (0xe%positive, Both L); (0x1c%positive, Both L); (0x1d%positive, Both L); (0xf%positive, Both L); (0x1e%positive, Both L); (0x1f%positive, Both L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x3); (0x8%positive, 0x7); (0x10%positive, 0xf); (0x20%positive, 0x1f); (0x21%positive, 0x1e); (0x11%positive, 0xe); (0x22%positive, 0x1d); (0x23%positive, 0x1c); (0x9%positive, 0x6); (0x12%positive, 0xd); (0x24%positive, 0x1b); (0x25%positive, 0x1a); (0x13%positive, 0xc); (0x26%positive, 0x19); (0x27%positive, 0x18); (0x5%positive, 0x2); (0xa%positive, 0x5); (0x14%positive, 0xb); (0x28%positive, 0x17); (0x29%positive, 0x16); (0x15%positive, 0xa); (0x2a%positive, 0x15); (0x2b%positive, 0x14); (0xb%positive, 0x4); (0x16%positive, 0x9); (0x2c%positive, 0x13); (0x2d%positive, 0x12); (0x17%positive, 0x8); (0x2e%positive, 0x11); (0x2f%positive, 0x10); (0x3%positive, 0x0); (0x6%positive, 0x1); (0xc%positive, 0x3); (0x18%positive, 0x7); (0x30%positive, 0xf); (0x31%positive, 0xe); (0x19%positive, 0x6); (0x32%positive, 0xd); (0x33%positive, 0xc); (0xd%positive, 0x2); (0x1a%positive, 0x5); (0x34%positive, 0xb); (0x35%positive, 0xa); (0x1b%positive, 0x4); (0x36%positive, 0x9); (0x37%positive, 0x8); (0x7%positive, 0x0); (0xe%positive, 0x1); (0x1c%positive, 0x3); (0x38%positive, 0x7); (0x39%positive, 0x6); (0x1d%positive, 0x2); (0x3a%positive, 0x5); (0x3b%positive, 0x4); (0xf%positive, 0x0); (0x1e%positive, 0x1); (0x3c%positive, 0x3); (0x3d%positive, 0x2); (0x1f%positive, 0x0); (0x3e%positive, 0x1); (0x3f%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/complete/right-5 *)
Example suite_16 : suite_seen (Node (Node (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf))) (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf)))) (Node (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf))) (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf)))))
  [(0x1%positive, Both R); (0x2%positive, Both R); (0x4%positive, Both R); (0x8%positive, Both R); (0x10%positive, Both R); (0x11%positive, Both R); (0x9%positive, Both R); (0x12%positive, Both R); (0x13%positive, Both R); (0x5%positive, Both R); (0xa%positive, Both R); (0x14%positive, Both R); (0x15%positive, Both R); (0xb%positive, Both R); (0x16%positive, Both R); (0x17%positive, Both R); (0x3%positive, Both R); (0x6%positive, Both R); (0xc%positive, Both R); (0x18%positive, Both R); (0x19%positive, Both R); (0xd%positive, Both R); (0x1a%positive, Both R); (0x1b%positive, Both R); (0x7%positive, Both R); (0xe%positive, Both R); (0x1c%positive, Both R); (0x1d%positive, Both R); (0xf%positive, Both R); (0x1e%positive, Both R); (0x1f%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x3); (0xf%positive, 0x7); (0x1f%positive, 0xf); (0x3f%positive, 0x1f); (0x3e%positive, 0x1e); (0x1e%positive, 0xe); (0x3d%positive, 0x1d); (0x3c%positive, 0x1c); (0xe%positive, 0x6); (0x1d%positive, 0xd); (0x3b%positive, 0x1b); (0x3a%positive, 0x1a); (0x1c%positive, 0xc); (0x39%positive, 0x19); (0x38%positive, 0x18); (0x6%positive, 0x2); (0xd%positive, 0x5); (0x1b%positive, 0xb); (0x37%positive, 0x17); (0x36%positive, 0x16); (0x1a%positive, 0xa); (0x35%positive, 0x15); (0x34%positive, 0x14); (0xc%positive, 0x4); (0x19%positive, 0x9); (0x33%positive, 0x13); (0x32%positive, 0x12); (0x18%positive, 0x8); (0x31%positive, 0x11); (0x30%positive, 0x10); (0x2%positive, 0x0); (0x5%positive, 0x1); (0xb%positive, 0x3); (0x17%positive, 0x7); (0x2f%positive, 0xf); (0x2e%positive, 0xe); (0x16%positive, 0x6); (0x2d%positive, 0xd); (0x2c%positive, 0xc); (0xa%positive, 0x2); (0x15%positive, 0x5); (0x2b%positive, 0xb); (0x2a%positive, 0xa); (0x14%positive, 0x4); (0x29%positive, 0x9); (0x28%positive, 0x8); (0x4%positive, 0x0); (0x9%positive, 0x1); (0x13%positive, 0x3); (0x27%positive, 0x7); (0x26%positive, 0x6); (0x12%positive, 0x2); (0x25%positive, 0x5); (0x24%positive, 0x4); (0x8%positive, 0x0); (0x11%positive, 0x1); (0x23%positive, 0x3); (0x22%positive, 0x2); (0x10%positive, 0x0); (0x21%positive, 0x1); (0x20%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/complete/turns-5 *)
Example suite_17 : suite_seen (Node (Node (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf))) (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf)))) (Node (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf))) (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf)))))
  [(0x1%positive, Both L); (0x2%positive, Both R); (0x4%positive, Both L); (0x8%positive, Both R); (0x10%positive, Both L); (0x11%positive, Both L); (0x9%positive, Both R); (0x12%positive, Both L); (0x13%positive, Both L); (0x5%positive, Both L); (0xa%positive, Both R); (0x14%positive, Both L); (0x15%positive, Both L); (0xb%positive, Both R); (0x16%positive, Both L); (0x17%positive, Both L); (0x3%positive, Both R); (0x6%positive, Both L); (0xc%positive, Both R); (0x18%positive, Both L); (0x19%positive, Both L); (0xd%positive, Both R); (0x1a%positive, Both L); (0x1b%positive, Both L); (0x7%positive, Both L); (0xe%positive, Both R); (0x1c%positive, Both L); (0x1d%positive, Both L); (0xf%positive, Both R); (0x1e%positive, Both L); (0x1f%positive, Both L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x3); (0xa%positive, 0x7); (0x15%positive, 0xf); (0x2a%positive, 0x1f); (0x2b%positive, 0x1e); (0x14%positive, 0xe); (0x28%positive, 0x1d); (0x29%positive, 0x1c); (0xb%positive, 0x6); (0x17%positive, 0xd); (0x2e%positive, 0x1b); (0x2f%positive, 0x1a); (0x16%positive, 0xc); (0x2c%positive, 0x19); (0x2d%positive, 0x18); (0x4%positive, 0x2); (0x8%positive, 0x5); (0x11%positive, 0xb); (0x22%positive, 0x17); (0x23%positive, 0x16); (0x10%positive, 0xa); (0x20%positive, 0x15); (0x21%positive, 0x14); (0x9%positive, 0x4); (0x13%positive, 0x9); (0x26%positive, 0x13); (0x27%positive, 0x12); (0x12%positive, 0x8); (0x24%positive, 0x11); (0x25%positive, 0x10); (0x3%positive, 0x0); (0x7%positive, 0x1); (0xe%positive, 0x3); (0x1d%positive, 0x7); (0x3a%positive, 0xf); (0x3b%positive, 0xe); (0x1c%positive, 0x6); (0x38%positive, 0xd); (0x39%positive, 0xc); (0xf%positive, 0x2); (0x1f%positive, 0x5); (0x3e%positive, 0xb); (0x3f%positive, 0xa); (0x1e%positive, 0x4); (0x3c%positive, 0x9); (0x3d%positive, 0x8); (0x6%positive, 0x0); (0xc%positive, 0x1); (0x19%positive, 0x3); (0x32%positive, 0x7); (0x33%positive, 0x6); (0x18%positive, 0x2); (0x30%positive, 0x5); (0x31%positive, 0x4); (0xd%positive, 0x0); (0x1b%positive, 0x1); (0x36%positive, 0x3); (0x37%positive, 0x2); (0x1a%positive, 0x0); (0x34%positive, 0x1); (0x35%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/complete/some-5 *)
Example suite_18 : suite_seen (Node (Node (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf))) (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf)))) (Node (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf))) (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf)))))
  [(0x1%positive, Both L); (0x2%positive, Only R); (0x4%positive, Only L); (0x8%positive, Only R); (0x10%positive, Only L); (0x11%positive, Both L); (0x9%positive, Both R); (0x12%positive, Both R); (0x13%positive, Both L); (0x5%positive, Both L); (0xa%positive, Only L); (0x14%positive, Only R); (0x15%positive, Both R); (0xb%positive, Both L); (0x16%positive, Only L); (0x17%positive, Both L); (0x3%positive, Both R); (0x6%positive, Both R); (0xc%positive, Both R); (0x18%positive, Both R); (0x19%positive, Both L); (0xd%positive, Both L); (0x1a%positive, Only R); (0x1b%positive, Both R); (0x7%positive, Both L); (0xe%positive, Only R); (0x1c%positive, Only L); (0x1d%positive, Both L); (0xf%positive, Both R); (0x1e%positive, Both R); (0x1f%positive, Both L)]
  [0x2a%positive; 0x3a%positive]
  = suite_expected true
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x2); (0xa%positive, 0x5); (0x14%positive, 0xa); (0x29%positive, 0x14); (0xb%positive, 0x4); (0x16%positive, 0x9); (0x2c%positive, 0x12); (0x17%positive, 0x8); (0x2e%positive, 0x11); (0x2f%positive, 0x10); (0x3%positive, 0x0); (0x7%positive, 0x1); (0xe%positive, 0x3); (0x1d%positive, 0x6); (0x3a%positive, 0xd)].
Proof. evaluated. Qed.

(* trace/script/leaf *)
Example suite_19 : suite_seen Leaf
  []
  []
  = suite_expected false
  [(0x1%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/leaf-stop *)
Example suite_20 : suite_seen Leaf
  []
  [0x1%positive]
  = suite_expected true
  [(0x1%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/three-neither *)
Example suite_21 : suite_seen (Node Leaf Leaf)
  [(0x1%positive, Neither)]
  []
  = suite_expected false
  [(0x1%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/three-neither-stop *)
Example suite_22 : suite_seen (Node Leaf Leaf)
  [(0x1%positive, Neither)]
  [0x2%positive]
  = suite_expected false
  [(0x1%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/three-only-left *)
Example suite_23 : suite_seen (Node Leaf Leaf)
  [(0x1%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/three-only-left-stop *)
Example suite_24 : suite_seen (Node Leaf Leaf)
  [(0x1%positive, Only L)]
  [0x2%positive]
  = suite_expected true
  [(0x1%positive, 0x0); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/three-only-right *)
Example suite_25 : suite_seen (Node Leaf Leaf)
  [(0x1%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/three-only-right-stop *)
Example suite_26 : suite_seen (Node Leaf Leaf)
  [(0x1%positive, Only R)]
  [0x2%positive]
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/three-both-left-first *)
Example suite_27 : suite_seen (Node Leaf Leaf)
  [(0x1%positive, Both L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/three-both-left-first-stop *)
Example suite_28 : suite_seen (Node Leaf Leaf)
  [(0x1%positive, Both L)]
  [0x2%positive]
  = suite_expected true
  [(0x1%positive, 0x0); (0x2%positive, 0x1)].
Proof. evaluated. Qed.

(* trace/script/three-both-right-first *)
Example suite_29 : suite_seen (Node Leaf Leaf)
  [(0x1%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/three-both-right-first-stop *)
Example suite_30 : suite_seen (Node Leaf Leaf)
  [(0x1%positive, Both R)]
  [0x2%positive]
  = suite_expected true
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-1 *)
Example suite_31 : suite_seen (Node (Node Leaf Leaf) Leaf)
  [(0x1%positive, Both R); (0x2%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x2%positive, 0x0); (0x5%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-2 *)
Example suite_32 : suite_seen (Node (Node Leaf Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Both L)]
  [0x3%positive]
  = suite_expected true
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x3); (0x5%positive, 0x2); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-3 *)
Example suite_33 : suite_seen (Node Leaf (Node Leaf Leaf))
  [(0x1%positive, Both L); (0x3%positive, Neither)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-6 *)
Example suite_34 : suite_seen (Node Leaf (Node Leaf Leaf))
  [(0x1%positive, Both R); (0x3%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x3); (0x6%positive, 0x2); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-8 *)
Example suite_35 : suite_seen (Node (Node Leaf Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Both L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x3); (0x5%positive, 0x2); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-9 *)
Example suite_36 : suite_seen (Node (Node Leaf (Node Leaf Leaf)) Leaf)
  [(0x1%positive, Both R); (0x2%positive, Only R); (0x5%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x2%positive, 0x0); (0x5%positive, 0x0); (0xa%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-10 *)
Example suite_37 : suite_seen (Node (Node Leaf (Node Leaf Leaf)) Leaf)
  [(0x1%positive, Neither); (0x2%positive, Both L); (0x5%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-12 *)
Example suite_38 : suite_seen (Node Leaf (Node (Node (Node Leaf Leaf) Leaf) Leaf))
  [(0x1%positive, Both L); (0x3%positive, Only R); (0x6%positive, Both L); (0xc%positive, Both L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x3%positive, 0x0); (0x7%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-13 *)
Example suite_39 : suite_seen (Node (Node Leaf Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x2); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-15 *)
Example suite_40 : suite_seen (Node (Node Leaf (Node Leaf (Node Leaf Leaf))) Leaf)
  [(0x1%positive, Only R); (0x2%positive, Only R); (0x5%positive, Both L); (0xb%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-17 *)
Example suite_41 : suite_seen (Node Leaf (Node Leaf Leaf))
  [(0x1%positive, Both L); (0x3%positive, Both L)]
  [0x6%positive]
  = suite_expected true
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x3%positive, 0x0); (0x6%positive, 0x1)].
Proof. evaluated. Qed.

(* trace/script/random-18 *)
Example suite_42 : suite_seen (Node (Node Leaf (Node Leaf Leaf)) (Node Leaf Leaf))
  [(0x1%positive, Both L); (0x2%positive, Only R); (0x5%positive, Both L); (0x3%positive, Neither)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x2); (0xa%positive, 0x5); (0xb%positive, 0x4); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-21 *)
Example suite_43 : suite_seen (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf (Node Leaf Leaf)))
  [(0x1%positive, Only L); (0x2%positive, Both L); (0x4%positive, Only L); (0x3%positive, Both R); (0x7%positive, Both L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x0); (0x4%positive, 0x1); (0x8%positive, 0x2); (0x5%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-22 *)
Example suite_44 : suite_seen (Node (Node Leaf (Node Leaf (Node (Node Leaf Leaf) Leaf))) Leaf)
  [(0x1%positive, Neither); (0x2%positive, Both L); (0x5%positive, Only L); (0xb%positive, Both R); (0x16%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-23 *)
Example suite_45 : suite_seen (Node (Node Leaf Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Neither)]
  [0x5%positive]
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-24 *)
Example suite_46 : suite_seen (Node (Node Leaf (Node (Node Leaf Leaf) Leaf)) Leaf)
  [(0x1%positive, Both R); (0x2%positive, Neither); (0x5%positive, Neither); (0xa%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-26 *)
Example suite_47 : suite_seen (Node Leaf (Node (Node Leaf Leaf) Leaf))
  [(0x1%positive, Both L); (0x3%positive, Both R); (0x6%positive, Both L)]
  [0xc%positive]
  = suite_expected true
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x3%positive, 0x0); (0x7%positive, 0x1); (0x6%positive, 0x0); (0xc%positive, 0x1)].
Proof. evaluated. Qed.

(* trace/script/random-27 *)
Example suite_48 : suite_seen (Node Leaf (Node (Node Leaf (Node Leaf (Node Leaf Leaf))) Leaf))
  [(0x1%positive, Both R); (0x3%positive, Both L); (0x6%positive, Only L); (0xd%positive, Only R); (0x1b%positive, Both L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x6%positive, 0x3); (0xc%positive, 0x6); (0x7%positive, 0x2); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-28 *)
Example suite_49 : suite_seen (Node (Node Leaf (Node (Node Leaf (Node Leaf Leaf)) Leaf)) Leaf)
  [(0x1%positive, Neither); (0x2%positive, Only R); (0x5%positive, Both L); (0xa%positive, Both L); (0x15%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-29 *)
Example suite_50 : suite_seen (Node (Node Leaf (Node (Node Leaf Leaf) Leaf)) (Node Leaf Leaf))
  [(0x1%positive, Both R); (0x2%positive, Only R); (0x5%positive, Only R); (0xa%positive, Only L); (0x3%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x2); (0x2%positive, 0x0); (0x5%positive, 0x0); (0xb%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-30 *)
Example suite_51 : suite_seen (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf Leaf) Leaf)) Leaf)) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x5%positive, Both L); (0xa%positive, Both R); (0x15%positive, Only L); (0x2a%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-31 *)
Example suite_52 : suite_seen (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf))
  [(0x1%positive, Both R); (0x2%positive, Both R); (0x4%positive, Both L); (0x3%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x6%positive, 0x2); (0x2%positive, 0x0); (0x5%positive, 0x1); (0x4%positive, 0x0); (0x8%positive, 0x1); (0x9%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-32 *)
Example suite_53 : suite_seen (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf))
  [(0x1%positive, Both R); (0x2%positive, Only R); (0x4%positive, Neither); (0x3%positive, Both R)]
  [0x8%positive; 0x6%positive]
  = suite_expected true
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x3); (0x6%positive, 0x2)].
Proof. evaluated. Qed.

(* trace/script/random-34 *)
Example suite_54 : suite_seen (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node Leaf Leaf)) Leaf)) Leaf))
  [(0x1%positive, Both L); (0x3%positive, Both R); (0x6%positive, Neither); (0xd%positive, Both L); (0x1a%positive, Both R); (0x35%positive, Both L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x3%positive, 0x0); (0x7%positive, 0x1); (0x6%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-35 *)
Example suite_55 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node (Node Leaf Leaf) Leaf))))
  [(0x1%positive, Only R); (0x3%positive, Only L); (0x7%positive, Both R); (0xf%positive, Neither); (0x1e%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x0); (0x6%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-37 *)
Example suite_56 : suite_seen (Node (Node Leaf (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf)))
  [(0x1%positive, Only R); (0x2%positive, Both R); (0x5%positive, Neither); (0x3%positive, Neither); (0x6%positive, Both L); (0x7%positive, Both L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-39 *)
Example suite_57 : suite_seen (Node (Node (Node Leaf (Node (Node Leaf Leaf) Leaf)) (Node (Node Leaf Leaf) Leaf)) (Node Leaf Leaf))
  [(0x1%positive, Neither); (0x2%positive, Only R); (0x4%positive, Only L); (0x9%positive, Both L); (0x12%positive, Both R); (0x5%positive, Both R); (0xa%positive, Neither); (0x3%positive, Both L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-40 *)
Example suite_58 : suite_seen (Node Leaf (Node Leaf (Node (Node (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf)))) Leaf) Leaf)))
  [(0x1%positive, Neither); (0x3%positive, Both L); (0x7%positive, Only L); (0xe%positive, Only L); (0x1c%positive, Both L); (0x39%positive, Both R); (0x73%positive, Neither); (0xe7%positive, Both L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-41 *)
Example suite_59 : suite_seen (Node (Node Leaf (Node (Node Leaf Leaf) (Node Leaf Leaf))) Leaf)
  [(0x1%positive, Both R); (0x2%positive, Both R); (0x5%positive, Both R); (0xa%positive, Both L); (0xb%positive, Only R)]
  [0x14%positive]
  = suite_expected true
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x2%positive, 0x0); (0x5%positive, 0x1); (0xb%positive, 0x3); (0x17%positive, 0x6); (0xa%positive, 0x2); (0x14%positive, 0x5)].
Proof. evaluated. Qed.

(* trace/script/random-42 *)
Example suite_60 : suite_seen (Node Leaf (Node Leaf Leaf))
  [(0x1%positive, Both R); (0x3%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x2); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-43 *)
Example suite_61 : suite_seen (Node (Node Leaf (Node (Node (Node Leaf Leaf) Leaf) Leaf)) (Node Leaf Leaf))
  [(0x1%positive, Neither); (0x2%positive, Only L); (0x5%positive, Both L); (0xa%positive, Both L); (0x14%positive, Both L); (0x3%positive, Both L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-44 *)
Example suite_62 : suite_seen (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf))
  [(0x1%positive, Both L); (0x2%positive, Only R); (0x4%positive, Both R); (0x3%positive, Both L)]
  [0x7%positive]
  = suite_expected true
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x2); (0x3%positive, 0x0); (0x6%positive, 0x1); (0x7%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-45 *)
Example suite_63 : suite_seen (Node (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) Leaf))
  [(0x1%positive, Both R); (0x2%positive, Only R); (0x4%positive, Both L); (0x8%positive, Both L); (0x5%positive, Only R); (0x3%positive, Both L); (0x6%positive, Both L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x6%positive, 0x3); (0xc%positive, 0x7); (0xd%positive, 0x6); (0x7%positive, 0x2); (0x2%positive, 0x0); (0x5%positive, 0x0); (0xb%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-46 *)
Example suite_64 : suite_seen (Node (Node Leaf Leaf) Leaf)
  [(0x1%positive, Both R); (0x2%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x2%positive, 0x0); (0x5%positive, 0x1); (0x4%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-47 *)
Example suite_65 : suite_seen (Node (Node Leaf Leaf) (Node Leaf Leaf))
  [(0x1%positive, Both L); (0x2%positive, Both R); (0x3%positive, Both L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x3); (0x4%positive, 0x2); (0x3%positive, 0x0); (0x6%positive, 0x1); (0x7%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-48 *)
Example suite_66 : suite_seen (Node (Node Leaf (Node (Node (Node Leaf Leaf) (Node Leaf (Node Leaf Leaf))) Leaf)) Leaf)
  [(0x1%positive, Neither); (0x2%positive, Both R); (0x5%positive, Both R); (0xa%positive, Only L); (0x14%positive, Both R); (0x15%positive, Both R); (0x2b%positive, Both L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-49 *)
Example suite_67 : suite_seen (Node (Node Leaf Leaf) (Node (Node Leaf Leaf) Leaf))
  [(0x1%positive, Only L); (0x2%positive, Only L); (0x3%positive, Both L); (0x6%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x0); (0x4%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-50 *)
Example suite_68 : suite_seen (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node Leaf (Node Leaf Leaf)))
  [(0x1%positive, Neither); (0x2%positive, Both R); (0x4%positive, Neither); (0x5%positive, Both R); (0x3%positive, Both L); (0x7%positive, Both L)]
  [0xf%positive]
  = suite_expected false
  [(0x1%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-51 *)
Example suite_69 : suite_seen (Node (Node Leaf Leaf) (Node Leaf Leaf))
  [(0x1%positive, Only R); (0x2%positive, Only L); (0x3%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x0); (0x7%positive, 0x1); (0x6%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-54 *)
Example suite_70 : suite_seen (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf))
  [(0x1%positive, Neither); (0x2%positive, Both L); (0x4%positive, Only R); (0x3%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-56 *)
Example suite_71 : suite_seen (Node (Node Leaf (Node (Node (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf)))) Leaf) Leaf)) Leaf)
  [(0x1%positive, Both R); (0x2%positive, Neither); (0x5%positive, Both L); (0xa%positive, Both L); (0x14%positive, Both L); (0x29%positive, Both L); (0x53%positive, Both L); (0xa7%positive, Both R)]
  [0x14e%positive]
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-57 *)
Example suite_72 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf)))))
  [(0x1%positive, Both L); (0x3%positive, Both L); (0x7%positive, Both R); (0xf%positive, Only L); (0x1f%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x3%positive, 0x0); (0x6%positive, 0x1); (0x7%positive, 0x0); (0xf%positive, 0x1); (0x1e%positive, 0x2); (0xe%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-58 *)
Example suite_73 : suite_seen (Node (Node Leaf Leaf) (Node Leaf Leaf))
  [(0x1%positive, Both L); (0x2%positive, Both R); (0x3%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x3); (0x4%positive, 0x2); (0x3%positive, 0x0); (0x7%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-59 *)
Example suite_74 : suite_seen (Node (Node (Node (Node (Node Leaf (Node Leaf Leaf)) Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Both R); (0x2%positive, Both L); (0x4%positive, Only L); (0x8%positive, Only R); (0x10%positive, Both R); (0x21%positive, Both L)]
  [0x43%positive; 0x9%positive]
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x2%positive, 0x0); (0x4%positive, 0x1); (0x8%positive, 0x2); (0x11%positive, 0x4); (0x5%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-60 *)
Example suite_75 : suite_seen (Node Leaf (Node Leaf Leaf))
  [(0x1%positive, Only R); (0x3%positive, Neither)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-62 *)
Example suite_76 : suite_seen (Node (Node Leaf Leaf) (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node Leaf Leaf)) Leaf)) Leaf)) Leaf))
  [(0x1%positive, Neither); (0x2%positive, Neither); (0x3%positive, Only R); (0x6%positive, Only L); (0xd%positive, Both L); (0x1a%positive, Both L); (0x35%positive, Only R); (0x6a%positive, Both R); (0xd5%positive, Neither)]
  [0xd4%positive]
  = suite_expected false
  [(0x1%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-63 *)
Example suite_77 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf))))
  [(0x1%positive, Both L); (0x3%positive, Both L); (0x7%positive, Both L); (0xf%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x3%positive, 0x0); (0x6%positive, 0x1); (0x7%positive, 0x0); (0xe%positive, 0x1); (0xf%positive, 0x0); (0x1f%positive, 0x1); (0x1e%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-65 *)
Example suite_78 : suite_seen (Node (Node (Node (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf))))) Leaf) Leaf) Leaf)
  [(0x1%positive, Only L); (0x2%positive, Both R); (0x4%positive, Only R); (0x8%positive, Only R); (0x11%positive, Both R); (0x23%positive, Both R); (0x47%positive, Neither); (0x8f%positive, Neither)]
  [0x5%positive]
  = suite_expected true
  [(0x1%positive, 0x0); (0x2%positive, 0x0); (0x5%positive, 0x1)].
Proof. evaluated. Qed.

(* trace/script/random-66 *)
Example suite_79 : suite_seen (Node (Node (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node (Node Leaf Leaf) Leaf)))))) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Both R); (0x9%positive, Both L); (0x13%positive, Both L); (0x27%positive, Only R); (0x4f%positive, Both R); (0x9f%positive, Only L); (0x13e%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x9%positive, 0x5); (0x12%positive, 0xb); (0x13%positive, 0xa); (0x26%positive, 0x15); (0x27%positive, 0x14); (0x4f%positive, 0x28); (0x9f%positive, 0x51); (0x13e%positive, 0xa2); (0x27d%positive, 0x144); (0x9e%positive, 0x50); (0x8%positive, 0x4); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-67 *)
Example suite_80 : suite_seen (Node (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) Leaf))
  [(0x1%positive, Only R); (0x2%positive, Only R); (0x4%positive, Both L); (0x8%positive, Neither); (0x5%positive, Both L); (0x3%positive, Both R); (0x6%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x0); (0x7%positive, 0x1); (0x6%positive, 0x0); (0xd%positive, 0x1); (0xc%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-68 *)
Example suite_81 : suite_seen (Node (Node (Node Leaf Leaf) (Node (Node Leaf (Node (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf)))) Leaf)) Leaf)) (Node Leaf (Node Leaf Leaf)))
  [(0x1%positive, Both R); (0x2%positive, Both L); (0x4%positive, Only L); (0x5%positive, Only L); (0xa%positive, Neither); (0x15%positive, Both R); (0x2a%positive, Only L); (0x55%positive, Both L); (0xab%positive, Only R); (0x157%positive, Both L); (0x3%positive, Only R); (0x7%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x2); (0xe%positive, 0x4); (0x2%positive, 0x0); (0x4%positive, 0x1); (0x8%positive, 0x2); (0x5%positive, 0x0); (0xa%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-69 *)
Example suite_82 : suite_seen (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Only L); (0x2%positive, Both L); (0x4%positive, Only R); (0x8%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x0); (0x4%positive, 0x1); (0x9%positive, 0x2); (0x5%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-70 *)
Example suite_83 : suite_seen (Node (Node Leaf Leaf) (Node Leaf Leaf))
  [(0x1%positive, Neither); (0x2%positive, Only R); (0x3%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-71 *)
Example suite_84 : suite_seen (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node Leaf (Node Leaf Leaf)))
  [(0x1%positive, Only R); (0x2%positive, Only L); (0x4%positive, Both R); (0x5%positive, Both L); (0x3%positive, Both R); (0x7%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x0); (0x7%positive, 0x1); (0xf%positive, 0x3); (0xe%positive, 0x2); (0x6%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-72 *)
Example suite_85 : suite_seen (Node (Node Leaf (Node Leaf (Node (Node Leaf (Node (Node (Node Leaf (Node (Node (Node Leaf (Node Leaf Leaf)) Leaf) Leaf)) Leaf) Leaf)) Leaf))) Leaf)
  [(0x1%positive, Only L); (0x2%positive, Only L); (0x5%positive, Both R); (0xb%positive, Both L); (0x16%positive, Neither); (0x2d%positive, Only R); (0x5a%positive, Only R); (0xb4%positive, Only R); (0x169%positive, Only L); (0x2d2%positive, Only L); (0x5a4%positive, Both L); (0xb49%positive, Both L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x0); (0x4%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-73 *)
Example suite_86 : suite_seen (Node (Node (Node Leaf Leaf) (Node Leaf (Node (Node Leaf (Node Leaf Leaf)) Leaf))) (Node Leaf Leaf))
  [(0x1%positive, Both R); (0x2%positive, Both R); (0x4%positive, Both L); (0x5%positive, Both L); (0xb%positive, Neither); (0x16%positive, Both R); (0x2d%positive, Both R); (0x3%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x3); (0x6%positive, 0x2); (0x2%positive, 0x0); (0x5%positive, 0x1); (0xa%positive, 0x3); (0xb%positive, 0x2); (0x4%positive, 0x0); (0x8%positive, 0x1); (0x9%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-75 *)
Example suite_87 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf))))
  [(0x1%positive, Both R); (0x3%positive, Both L); (0x7%positive, Both R); (0xf%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x6%positive, 0x3); (0x7%positive, 0x2); (0xf%positive, 0x5); (0x1e%positive, 0xa); (0xe%positive, 0x4); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-76 *)
Example suite_88 : suite_seen (Node (Node (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) Leaf)) (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf)))
  [(0x1%positive, Only R); (0x2%positive, Both L); (0x4%positive, Neither); (0x8%positive, Only R); (0x10%positive, Both R); (0x9%positive, Both R); (0x5%positive, Both R); (0xa%positive, Both R); (0x3%positive, Both R); (0x6%positive, Both R); (0xc%positive, Both R); (0x7%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x0); (0x7%positive, 0x1); (0xf%positive, 0x3); (0xe%positive, 0x2); (0x6%positive, 0x0); (0xd%positive, 0x1); (0xc%positive, 0x0); (0x19%positive, 0x1); (0x18%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-77 *)
Example suite_89 : suite_seen (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf)))
  [(0x1%positive, Both R); (0x2%positive, Both R); (0x4%positive, Both L); (0x5%positive, Neither); (0x3%positive, Only R); (0x6%positive, Both R); (0x7%positive, Both L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x2); (0xe%positive, 0x5); (0xf%positive, 0x4); (0x2%positive, 0x0); (0x5%positive, 0x1); (0x4%positive, 0x0); (0x8%positive, 0x1); (0x9%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-78 *)
Example suite_90 : suite_seen (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf)))
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Neither); (0x5%positive, Neither); (0x3%positive, Both L); (0x6%positive, Both R); (0x7%positive, Neither)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x3%positive, 0x0); (0x6%positive, 0x1); (0xd%positive, 0x3); (0xc%positive, 0x2); (0x7%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-79 *)
Example suite_91 : suite_seen (Node Leaf (Node (Node (Node (Node Leaf (Node Leaf (Node (Node (Node Leaf (Node (Node Leaf (Node Leaf Leaf)) Leaf)) Leaf) Leaf))) Leaf) Leaf) Leaf))
  [(0x1%positive, Neither); (0x3%positive, Both L); (0x6%positive, Neither); (0xc%positive, Neither); (0x18%positive, Neither); (0x31%positive, Both R); (0x63%positive, Both L); (0xc6%positive, Only R); (0x18c%positive, Neither); (0x319%positive, Both L); (0x632%positive, Both L); (0xc65%positive, Both L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-80 *)
Example suite_92 : suite_seen (Node (Node Leaf Leaf) (Node (Node Leaf Leaf) (Node (Node (Node Leaf Leaf) (Node Leaf (Node Leaf (Node Leaf Leaf)))) (Node Leaf (Node (Node Leaf Leaf) Leaf)))))
  [(0x1%positive, Both L); (0x2%positive, Both L); (0x3%positive, Only L); (0x6%positive, Both L); (0x7%positive, Both L); (0xe%positive, Neither); (0x1c%positive, Only R); (0x1d%positive, Both R); (0x3b%positive, Only L); (0x77%positive, Both L); (0xf%positive, Both L); (0x1f%positive, Both R); (0x3e%positive, Both L)]
  [0x5%positive; 0xee%positive; 0x7d%positive]
  = suite_expected true
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x3); (0x5%positive, 0x2)].
Proof. evaluated. Qed.

(* trace/script/random-81 *)
Example suite_93 : suite_seen (Node (Node Leaf Leaf) Leaf)
  [(0x1%positive, Neither); (0x2%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-82 *)
Example suite_94 : suite_seen (Node (Node (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) Leaf) (Node (Node Leaf (Node Leaf Leaf)) (Node Leaf Leaf))) (Node Leaf (Node Leaf Leaf)))
  [(0x1%positive, Both R); (0x2%positive, Only R); (0x4%positive, Both R); (0x8%positive, Both R); (0x10%positive, Both R); (0x11%positive, Both L); (0x5%positive, Both L); (0xa%positive, Both L); (0x15%positive, Only R); (0xb%positive, Only L); (0x3%positive, Only R); (0x7%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x2); (0xf%positive, 0x5); (0xe%positive, 0x4); (0x2%positive, 0x0); (0x5%positive, 0x0); (0xa%positive, 0x1); (0x14%positive, 0x3); (0x15%positive, 0x2); (0x2b%positive, 0x4); (0xb%positive, 0x0); (0x16%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-83 *)
Example suite_95 : suite_seen (Node Leaf (Node (Node Leaf (Node Leaf Leaf)) (Node (Node Leaf (Node Leaf (Node Leaf Leaf))) (Node (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf))))) Leaf))))
  [(0x1%positive, Both L); (0x3%positive, Neither); (0x6%positive, Only L); (0xd%positive, Both L); (0x7%positive, Both L); (0xe%positive, Both L); (0x1d%positive, Both R); (0x3b%positive, Both L); (0xf%positive, Only R); (0x1e%positive, Neither); (0x3d%positive, Both L); (0x7b%positive, Only L); (0xf7%positive, Both R); (0x1ef%positive, Only L)]
  [0x1a%positive; 0x1c%positive; 0xf6%positive]
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-84 *)
Example suite_96 : suite_seen (Node (Node (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf (Node (Node Leaf Leaf) (Node (Node Leaf (Node Leaf Leaf)) Leaf)))) (Node Leaf Leaf)) (Node Leaf (Node Leaf (Node Leaf Leaf))))
  [(0x1%positive, Only R); (0x2%positive, Neither); (0x4%positive, Both R); (0x8%positive, Both R); (0x10%positive, Only R); (0x9%positive, Only L); (0x13%positive, Neither); (0x26%positive, Only R); (0x27%positive, Neither); (0x4e%positive, Only L); (0x9d%positive, Neither); (0x5%positive, Both R); (0x3%positive, Both R); (0x7%positive, Both L); (0xf%positive, Both L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x0); (0x7%positive, 0x1); (0xe%positive, 0x3); (0xf%positive, 0x2); (0x1e%positive, 0x5); (0x1f%positive, 0x4); (0x6%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-85 *)
Example suite_97 : suite_seen (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf)))
  [(0x1%positive, Only R); (0x2%positive, Only R); (0x4%positive, Only L); (0x5%positive, Neither); (0x3%positive, Both R); (0x6%positive, Only L); (0x7%positive, Neither)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x0); (0x7%positive, 0x1); (0x6%positive, 0x0); (0xc%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-86 *)
Example suite_98 : suite_seen (Node (Node (Node (Node Leaf (Node Leaf Leaf)) (Node (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf) Leaf) (Node Leaf Leaf))) Leaf) (Node Leaf (Node Leaf Leaf)))
  [(0x1%positive, Only L); (0x2%positive, Only R); (0x4%positive, Neither); (0x8%positive, Both R); (0x11%positive, Both L); (0x9%positive, Only R); (0x12%positive, Both R); (0x24%positive, Only L); (0x48%positive, Both L); (0x90%positive, Both L); (0x120%positive, Both L); (0x13%positive, Both R); (0x3%positive, Neither); (0x7%positive, Both L)]
  [0x121%positive; 0x6%positive]
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x0); (0x5%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-87 *)
Example suite_99 : suite_seen (Node (Node (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) Leaf)) (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf)))
  [(0x1%positive, Both R); (0x2%positive, Only R); (0x4%positive, Both R); (0x8%positive, Both L); (0x10%positive, Only L); (0x9%positive, Both L); (0x5%positive, Both L); (0xa%positive, Only L); (0x3%positive, Both R); (0x6%positive, Only R); (0xc%positive, Only R); (0x7%positive, Both L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x3); (0xe%positive, 0x7); (0xf%positive, 0x6); (0x6%positive, 0x2); (0xd%positive, 0x4); (0x2%positive, 0x0); (0x5%positive, 0x0); (0xa%positive, 0x1); (0x14%positive, 0x2); (0xb%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-88 *)
Example suite_100 : suite_seen (Node (Node (Node Leaf Leaf) Leaf) Leaf)
  [(0x1%positive, Neither); (0x2%positive, Only L); (0x4%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-89 *)
Example suite_101 : suite_seen (Node (Node (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node Leaf Leaf)) (Node (Node Leaf Leaf) Leaf)) (Node (Node (Node Leaf Leaf) Leaf) Leaf))
  [(0x1%positive, Only L); (0x2%positive, Both R); (0x4%positive, Both L); (0x8%positive, Both L); (0x10%positive, Both R); (0x11%positive, Only R); (0x9%positive, Both L); (0x5%positive, Only R); (0xa%positive, Both R); (0x3%positive, Neither); (0x6%positive, Both L); (0xc%positive, Only L)]
  [0x21%positive; 0xb%positive; 0x19%positive]
  = suite_expected true
  [(0x1%positive, 0x0); (0x2%positive, 0x0); (0x5%positive, 0x1); (0xb%positive, 0x2)].
Proof. evaluated. Qed.

(* trace/script/random-90 *)
Example suite_102 : suite_seen (Node (Node (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) Leaf)) (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf)))
  [(0x1%positive, Only L); (0x2%positive, Neither); (0x4%positive, Only R); (0x8%positive, Both R); (0x10%positive, Both R); (0x9%positive, Only R); (0x5%positive, Only L); (0xa%positive, Both L); (0x3%positive, Both L); (0x6%positive, Only L); (0xc%positive, Both L); (0x7%positive, Neither)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-91 *)
Example suite_103 : suite_seen (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf))
  [(0x1%positive, Neither); (0x2%positive, Both L); (0x4%positive, Only L); (0x3%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-92 *)
Example suite_104 : suite_seen (Node Leaf (Node (Node (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node (Node (Node Leaf (Node Leaf (Node (Node Leaf (Node Leaf (Node (Node Leaf Leaf) Leaf))) Leaf))) Leaf) Leaf))))) Leaf) Leaf))
  [(0x1%positive, Both R); (0x3%positive, Both L); (0x6%positive, Both L); (0xc%positive, Both R); (0x19%positive, Both R); (0x33%positive, Both L); (0x67%positive, Only R); (0xcf%positive, Both L); (0x19e%positive, Both L); (0x33c%positive, Both L); (0x679%positive, Both R); (0xcf3%positive, Both L); (0x19e6%positive, Both L); (0x33cd%positive, Both R); (0x679b%positive, Both R); (0xcf36%positive, Both R)]
  [0xcf2%positive; 0x679a%positive; 0xcf37%positive]
  = suite_expected true
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x6%positive, 0x3); (0xc%positive, 0x7); (0x19%positive, 0xf); (0x33%positive, 0x1f); (0x66%positive, 0x3f); (0x67%positive, 0x3e); (0xcf%positive, 0x7c); (0x19e%positive, 0xf9); (0x33c%positive, 0x1f3); (0x678%positive, 0x3e7); (0x679%positive, 0x3e6); (0xcf3%positive, 0x7cd); (0x19e6%positive, 0xf9b); (0x33cc%positive, 0x1f37); (0x33cd%positive, 0x1f36); (0x679b%positive, 0x3e6d); (0xcf37%positive, 0x7cdb)].
Proof. evaluated. Qed.

(* trace/script/random-93 *)
Example suite_105 : suite_seen (Node (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) Leaf))
  [(0x1%positive, Both R); (0x2%positive, Both R); (0x4%positive, Neither); (0x8%positive, Both L); (0x5%positive, Neither); (0x3%positive, Only R); (0x6%positive, Both L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x2); (0x2%positive, 0x0); (0x5%positive, 0x1); (0x4%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-94 *)
Example suite_106 : suite_seen (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf))
  [(0x1%positive, Neither); (0x2%positive, Neither); (0x4%positive, Both R); (0x3%positive, Both L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-95 *)
Example suite_107 : suite_seen (Node (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) Leaf))
  [(0x1%positive, Neither); (0x2%positive, Only L); (0x4%positive, Only R); (0x8%positive, Neither); (0x5%positive, Neither); (0x3%positive, Only L); (0x6%positive, Only L)]
  [0x7%positive]
  = suite_expected false
  [(0x1%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-96 *)
Example suite_108 : suite_seen (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf)))
  [(0x1%positive, Both L); (0x2%positive, Both L); (0x4%positive, Both L); (0x5%positive, Neither); (0x3%positive, Both R); (0x6%positive, Only R); (0x7%positive, Neither)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x3); (0x8%positive, 0x7); (0x9%positive, 0x6); (0x5%positive, 0x2); (0x3%positive, 0x0); (0x7%positive, 0x1); (0x6%positive, 0x0); (0xd%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-97 *)
Example suite_109 : suite_seen (Node (Node (Node (Node Leaf Leaf) (Node Leaf (Node (Node Leaf Leaf) (Node (Node Leaf (Node (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf)))) Leaf)) Leaf)))) Leaf) (Node Leaf Leaf))
  [(0x1%positive, Only L); (0x2%positive, Only R); (0x4%positive, Only L); (0x8%positive, Only L); (0x9%positive, Both L); (0x13%positive, Both L); (0x26%positive, Both L); (0x27%positive, Both L); (0x4e%positive, Only L); (0x9d%positive, Only R); (0x13a%positive, Only L); (0x275%positive, Only R); (0x4eb%positive, Both R); (0x9d7%positive, Both R); (0x3%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x0); (0x5%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-98 *)
Example suite_110 : suite_seen (Node (Node (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) Leaf)) (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf)))
  [(0x1%positive, Only R); (0x2%positive, Only R); (0x4%positive, Only L); (0x8%positive, Both L); (0x10%positive, Only R); (0x9%positive, Both R); (0x5%positive, Neither); (0xa%positive, Both L); (0x3%positive, Both R); (0x6%positive, Both L); (0xc%positive, Both L); (0x7%positive, Only L)]
  [0x20%positive; 0x12%positive]
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x0); (0x7%positive, 0x1); (0xe%positive, 0x2); (0x6%positive, 0x0); (0xc%positive, 0x1); (0x18%positive, 0x3); (0x19%positive, 0x2); (0xd%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-101 *)
Example suite_111 : suite_seen (Node Leaf Leaf)
  [(0x1%positive, Neither)]
  [0x2%positive; 0x3%positive]
  = suite_expected false
  [(0x1%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-102 *)
Example suite_112 : suite_seen (Node (Node (Node (Node (Node (Node Leaf (Node Leaf (Node Leaf Leaf))) Leaf) Leaf) Leaf) (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf))))) Leaf)
  [(0x1%positive, Neither); (0x2%positive, Both L); (0x4%positive, Only R); (0x8%positive, Both L); (0x10%positive, Both R); (0x20%positive, Both R); (0x41%positive, Both R); (0x83%positive, Both L); (0x5%positive, Both L); (0xb%positive, Only L); (0x17%positive, Neither); (0x2f%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-103 *)
Example suite_113 : suite_seen (Node Leaf (Node (Node Leaf (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf (Node (Node Leaf Leaf) (Node Leaf (Node Leaf Leaf)))))) (Node (Node Leaf Leaf) Leaf)))
  [(0x1%positive, Neither); (0x3%positive, Neither); (0x6%positive, Both R); (0xd%positive, Neither); (0x1a%positive, Both R); (0x34%positive, Neither); (0x1b%positive, Only L); (0x37%positive, Both L); (0x6e%positive, Only R); (0x6f%positive, Only R); (0xdf%positive, Neither); (0x7%positive, Both L); (0xe%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-104 *)
Example suite_114 : suite_seen (Node Leaf (Node Leaf Leaf))
  [(0x1%positive, Both R); (0x3%positive, Both R)]
  [0x7%positive]
  = suite_expected true
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x3)].
Proof. evaluated. Qed.

(* trace/script/random-105 *)
Example suite_115 : suite_seen (Node Leaf (Node Leaf (Node (Node Leaf (Node (Node Leaf Leaf) Leaf)) Leaf)))
  [(0x1%positive, Both L); (0x3%positive, Both R); (0x7%positive, Both R); (0xe%positive, Both R); (0x1d%positive, Both R); (0x3a%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x3%positive, 0x0); (0x7%positive, 0x1); (0xf%positive, 0x3); (0xe%positive, 0x2); (0x1d%positive, 0x5); (0x3b%positive, 0xb); (0x3a%positive, 0xa); (0x75%positive, 0x15); (0x74%positive, 0x14); (0x1c%positive, 0x4); (0x6%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-106 *)
Example suite_116 : suite_seen (Node (Node (Node (Node (Node Leaf (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) (Node Leaf (Node Leaf Leaf))) Leaf)) (Node (Node Leaf Leaf) Leaf)) Leaf) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Both L); (0x4%positive, Both L); (0x8%positive, Neither); (0x10%positive, Neither); (0x21%positive, Both L); (0x42%positive, Both L); (0x84%positive, Both R); (0x108%positive, Only R); (0x210%positive, Only R); (0x85%positive, Both L); (0x10b%positive, Only L); (0x11%positive, Both R); (0x22%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x3); (0x8%positive, 0x7); (0x9%positive, 0x6); (0x5%positive, 0x2); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-107 *)
Example suite_117 : suite_seen (Node Leaf (Node (Node (Node Leaf (Node Leaf (Node Leaf (Node (Node Leaf Leaf) Leaf)))) (Node Leaf Leaf)) Leaf))
  [(0x1%positive, Neither); (0x3%positive, Both R); (0x6%positive, Both R); (0xc%positive, Both L); (0x19%positive, Both L); (0x33%positive, Both R); (0x67%positive, Both L); (0xce%positive, Both R); (0xd%positive, Only R)]
  [0x18%positive; 0x7%positive]
  = suite_expected false
  [(0x1%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-108 *)
Example suite_118 : suite_seen (Node (Node Leaf (Node (Node Leaf Leaf) (Node (Node (Node Leaf Leaf) Leaf) (Node (Node (Node Leaf (Node (Node Leaf (Node Leaf (Node Leaf Leaf))) Leaf)) (Node Leaf Leaf)) (Node Leaf Leaf))))) Leaf)
  [(0x1%positive, Only L); (0x2%positive, Both R); (0x5%positive, Only L); (0xa%positive, Only L); (0xb%positive, Both L); (0x16%positive, Both L); (0x2c%positive, Both L); (0x17%positive, Neither); (0x2e%positive, Both L); (0x5c%positive, Both L); (0xb9%positive, Only L); (0x172%positive, Only L); (0x2e5%positive, Only L); (0x5cb%positive, Neither); (0x5d%positive, Only R); (0x2f%positive, Both L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x0); (0x5%positive, 0x1); (0xa%positive, 0x2); (0x14%positive, 0x4); (0x4%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-109 *)
Example suite_119 : suite_seen (Node (Node (Node Leaf Leaf) (Node (Node (Node (Node (Node (Node (Node Leaf (Node Leaf Leaf)) Leaf) Leaf) (Node Leaf (Node Leaf Leaf))) Leaf) Leaf) (Node (Node Leaf (Node Leaf Leaf)) Leaf))) (Node (Node Leaf Leaf) Leaf))
  [(0x1%positive, Neither); (0x2%positive, Both R); (0x4%positive, Both R); (0x5%positive, Both R); (0xa%positive, Both L); (0x14%positive, Only R); (0x28%positive, Only L); (0x50%positive, Both L); (0xa0%positive, Both R); (0x140%positive, Only L); (0x281%positive, Both R); (0x51%positive, Both R); (0xa3%positive, Both L); (0xb%positive, Only L); (0x16%positive, Both R); (0x2d%positive, Both R); (0x3%positive, Both R); (0x6%positive, Neither)]
  []
  = suite_expected false
  [(0x1%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-110 *)
Example suite_120 : suite_seen (Node Leaf (Node Leaf (Node Leaf Leaf)))
  [(0x1%positive, Only R); (0x3%positive, Only R); (0x7%positive, Both R)]
  [0xe%positive]
  = suite_expected true
  [(0x1%positive, 0x0); (0x3%positive, 0x0); (0x7%positive, 0x0); (0xf%positive, 0x1); (0xe%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-111 *)
Example suite_121 : suite_seen (Node (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) Leaf))
  [(0x1%positive, Both R); (0x2%positive, Only L); (0x4%positive, Both L); (0x8%positive, Both R); (0x5%positive, Neither); (0x3%positive, Only R); (0x6%positive, Both L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x2); (0x2%positive, 0x0); (0x4%positive, 0x0); (0x8%positive, 0x1); (0x11%positive, 0x3); (0x10%positive, 0x2); (0x9%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-112 *)
Example suite_122 : suite_seen (Node (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf))) (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf))))
  [(0x1%positive, Only L); (0x2%positive, Only L); (0x4%positive, Both L); (0x8%positive, Both R); (0x9%positive, Both L); (0x5%positive, Neither); (0xa%positive, Both R); (0xb%positive, Only R); (0x3%positive, Only L); (0x6%positive, Neither); (0xc%positive, Both R); (0xd%positive, Only L); (0x7%positive, Both R); (0xe%positive, Only R); (0xf%positive, Both L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x0); (0x4%positive, 0x0); (0x8%positive, 0x1); (0x11%positive, 0x3); (0x10%positive, 0x2); (0x9%positive, 0x0); (0x12%positive, 0x1); (0x13%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-113 *)
Example suite_123 : suite_seen (Node (Node Leaf (Node Leaf Leaf)) (Node (Node Leaf (Node Leaf (Node Leaf Leaf))) (Node (Node (Node Leaf Leaf) (Node (Node (Node Leaf (Node (Node Leaf Leaf) Leaf)) (Node Leaf (Node Leaf Leaf))) (Node Leaf Leaf))) Leaf)))
  [(0x1%positive, Both R); (0x2%positive, Both L); (0x5%positive, Only L); (0x3%positive, Both R); (0x6%positive, Neither); (0xd%positive, Both L); (0x1b%positive, Both L); (0x7%positive, Neither); (0xe%positive, Neither); (0x1c%positive, Only L); (0x1d%positive, Both L); (0x3a%positive, Both R); (0x74%positive, Both R); (0xe9%positive, Neither); (0x1d2%positive, Both R); (0x75%positive, Neither); (0xeb%positive, Both R); (0x3b%positive, Both R)]
  [0x38%positive; 0xf%positive]
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x3); (0x6%positive, 0x2); (0x2%positive, 0x0); (0x4%positive, 0x1); (0x5%positive, 0x0); (0xa%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-114 *)
Example suite_124 : suite_seen (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf)))
  [(0x1%positive, Both L); (0x2%positive, Only R); (0x4%positive, Both L); (0x5%positive, Both L); (0x3%positive, Both R); (0x6%positive, Only L); (0x7%positive, Both L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x2); (0xa%positive, 0x5); (0xb%positive, 0x4); (0x3%positive, 0x0); (0x7%positive, 0x1); (0xe%positive, 0x3); (0xf%positive, 0x2); (0x6%positive, 0x0); (0xc%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-115 *)
Example suite_125 : suite_seen (Node (Node (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf)))) Leaf) Leaf)
  [(0x1%positive, Both R); (0x2%positive, Both L); (0x4%positive, Both R); (0x9%positive, Both L); (0x13%positive, Only L); (0x27%positive, Neither)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x2%positive, 0x0); (0x4%positive, 0x1); (0x9%positive, 0x3); (0x12%positive, 0x7); (0x13%positive, 0x6); (0x26%positive, 0xc); (0x8%positive, 0x2); (0x5%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-116 *)
Example suite_126 : suite_seen (Node (Node (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) Leaf)) (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf)))
  [(0x1%positive, Both R); (0x2%positive, Both R); (0x4%positive, Both L); (0x8%positive, Both L); (0x10%positive, Both L); (0x9%positive, Both L); (0x5%positive, Only R); (0xa%positive, Both R); (0x3%positive, Both L); (0x6%positive, Both R); (0xc%positive, Only L); (0x7%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x6%positive, 0x3); (0xd%positive, 0x7); (0xc%positive, 0x6); (0x18%positive, 0xc); (0x7%positive, 0x2); (0xf%positive, 0x5); (0xe%positive, 0x4); (0x2%positive, 0x0); (0x5%positive, 0x1); (0xb%positive, 0x2); (0x4%positive, 0x0); (0x8%positive, 0x1); (0x10%positive, 0x3); (0x20%positive, 0x7); (0x21%positive, 0x6); (0x11%positive, 0x2); (0x9%positive, 0x0); (0x12%positive, 0x1); (0x13%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-117 *)
Example suite_127 : suite_seen (Node (Node (Node (Node (Node Leaf (Node (Node (Node Leaf (Node (Node Leaf Leaf) Leaf)) Leaf) Leaf)) Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Both R); (0x2%positive, Only L); (0x4%positive, Both L); (0x8%positive, Only R); (0x10%positive, Both L); (0x21%positive, Both L); (0x42%positive, Both R); (0x84%positive, Both L); (0x109%positive, Both L); (0x212%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x2%positive, 0x0); (0x4%positive, 0x0); (0x8%positive, 0x1); (0x11%positive, 0x2); (0x9%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-119 *)
Example suite_128 : suite_seen (Node Leaf (Node Leaf Leaf))
  [(0x1%positive, Both R); (0x3%positive, Both R)]
  [0x2%positive]
  = suite_expected true
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x3); (0x6%positive, 0x2); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-121 *)
Example suite_129 : suite_seen (Node Leaf (Node (Node (Node (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf (Node Leaf Leaf))) Leaf) Leaf) (Node (Node (Node (Node Leaf Leaf) Leaf) (Node (Node Leaf Leaf) Leaf)) Leaf)))
  [(0x1%positive, Only L); (0x3%positive, Only R); (0x6%positive, Neither); (0xc%positive, Neither); (0x18%positive, Neither); (0x30%positive, Only L); (0x60%positive, Both R); (0x31%positive, Only L); (0x63%positive, Both R); (0x7%positive, Both R); (0xe%positive, Both L); (0x1c%positive, Both L); (0x38%positive, Both L); (0x1d%positive, Both R); (0x3a%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-122 *)
Example suite_130 : suite_seen (Node (Node (Node (Node (Node Leaf (Node (Node Leaf Leaf) Leaf)) Leaf) Leaf) (Node Leaf (Node Leaf Leaf))) (Node Leaf Leaf))
  [(0x1%positive, Both R); (0x2%positive, Only L); (0x4%positive, Both L); (0x8%positive, Both L); (0x10%positive, Both L); (0x21%positive, Both R); (0x42%positive, Both R); (0x5%positive, Only R); (0xb%positive, Both R); (0x3%positive, Both R)]
  [0x11%positive]
  = suite_expected true
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x3); (0x6%positive, 0x2); (0x2%positive, 0x0); (0x4%positive, 0x0); (0x8%positive, 0x1); (0x10%positive, 0x3); (0x20%positive, 0x7); (0x21%positive, 0x6); (0x43%positive, 0xd); (0x42%positive, 0xc); (0x85%positive, 0x19); (0x84%positive, 0x18); (0x11%positive, 0x2)].
Proof. evaluated. Qed.

(* trace/script/random-123 *)
Example suite_131 : suite_seen (Node (Node (Node (Node (Node Leaf (Node Leaf Leaf)) Leaf) (Node (Node Leaf (Node (Node Leaf Leaf) Leaf)) (Node (Node Leaf Leaf) (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf (Node Leaf Leaf)))))) (Node Leaf (Node Leaf Leaf))) (Node Leaf (Node Leaf (Node Leaf Leaf))))
  [(0x1%positive, Only L); (0x2%positive, Only R); (0x4%positive, Neither); (0x8%positive, Both L); (0x10%positive, Only R); (0x21%positive, Both R); (0x9%positive, Only L); (0x12%positive, Both L); (0x25%positive, Only L); (0x4a%positive, Only L); (0x13%positive, Only L); (0x26%positive, Only R); (0x27%positive, Both R); (0x4e%positive, Both L); (0x9c%positive, Only R); (0x4f%positive, Both R); (0x9f%positive, Only L); (0x5%positive, Both R); (0xb%positive, Both R); (0x3%positive, Both L); (0x7%positive, Both R); (0xf%positive, Both L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x0); (0x5%positive, 0x0); (0xb%positive, 0x1); (0x17%positive, 0x3); (0x16%positive, 0x2); (0xa%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-124 *)
Example suite_132 : suite_seen (Node (Node (Node (Node Leaf (Node Leaf (Node Leaf Leaf))) (Node (Node Leaf (Node Leaf Leaf)) (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) (Node (Node (Node Leaf Leaf) Leaf) Leaf)) Leaf))) (Node Leaf Leaf)) (Node Leaf Leaf))
  [(0x1%positive, Only R); (0x2%positive, Both R); (0x4%positive, Both L); (0x8%positive, Only R); (0x11%positive, Both R); (0x23%positive, Both R); (0x9%positive, Both R); (0x12%positive, Both L); (0x25%positive, Both R); (0x13%positive, Both R); (0x26%positive, Both L); (0x4c%positive, Only R); (0x98%positive, Both L); (0x130%positive, Only L); (0x4d%positive, Only R); (0x9a%positive, Only R); (0x134%positive, Neither); (0x5%positive, Only R); (0x3%positive, Neither)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-125 *)
Example suite_133 : suite_seen (Node (Node Leaf Leaf) (Node (Node Leaf Leaf) (Node Leaf Leaf)))
  [(0x1%positive, Only R); (0x2%positive, Both R); (0x3%positive, Only L); (0x6%positive, Only R); (0x7%positive, Both L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x0); (0x6%positive, 0x0); (0xd%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-126 *)
Example suite_134 : suite_seen (Node Leaf (Node Leaf (Node (Node Leaf (Node Leaf (Node Leaf Leaf))) (Node (Node (Node Leaf (Node Leaf (Node Leaf Leaf))) Leaf) (Node (Node Leaf (Node Leaf Leaf)) Leaf)))))
  [(0x1%positive, Both R); (0x3%positive, Only R); (0x7%positive, Both L); (0xe%positive, Both R); (0x1d%positive, Both L); (0x3b%positive, Neither); (0xf%positive, Only R); (0x1e%positive, Both L); (0x3c%positive, Both R); (0x79%positive, Both R); (0xf3%positive, Both L); (0x1f%positive, Both R); (0x3e%positive, Both R); (0x7d%positive, Both L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x2); (0xe%positive, 0x5); (0x1d%positive, 0xb); (0x3a%positive, 0x17); (0x3b%positive, 0x16); (0x1c%positive, 0xa); (0xf%positive, 0x4); (0x1f%positive, 0x8); (0x3f%positive, 0x11); (0x3e%positive, 0x10); (0x7d%positive, 0x21); (0xfa%positive, 0x43); (0xfb%positive, 0x42); (0x7c%positive, 0x20); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-127 *)
Example suite_135 : suite_seen (Node (Node (Node Leaf Leaf) (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node (Node (Node Leaf (Node Leaf (Node Leaf Leaf))) Leaf) Leaf)))))) (Node Leaf Leaf))
  [(0x1%positive, Only R); (0x2%positive, Both R); (0x4%positive, Both L); (0x5%positive, Only R); (0xb%positive, Both R); (0x17%positive, Only L); (0x2f%positive, Neither); (0x5f%positive, Both L); (0xbe%positive, Both R); (0x17c%positive, Both R); (0x2f9%positive, Both L); (0x5f3%positive, Neither); (0x3%positive, Both L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x0); (0x6%positive, 0x1); (0x7%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-128 *)
Example suite_136 : suite_seen (Node (Node (Node (Node Leaf Leaf) (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf (Node Leaf (Node Leaf Leaf))))) (Node (Node Leaf (Node Leaf Leaf)) Leaf)) (Node Leaf (Node Leaf Leaf)))
  [(0x1%positive, Both L); (0x2%positive, Both L); (0x4%positive, Only L); (0x8%positive, Both L); (0x9%positive, Neither); (0x12%positive, Neither); (0x24%positive, Neither); (0x13%positive, Both R); (0x27%positive, Neither); (0x4f%positive, Both R); (0x5%positive, Only L); (0xa%positive, Only L); (0x15%positive, Both L); (0x3%positive, Both L); (0x7%positive, Both R)]
  [0x2a%positive; 0x6%positive]
  = suite_expected true
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x3); (0x8%positive, 0x6); (0x10%positive, 0xd); (0x11%positive, 0xc); (0x5%positive, 0x2); (0xa%positive, 0x4); (0x14%positive, 0x8); (0x3%positive, 0x0); (0x6%positive, 0x1)].
Proof. evaluated. Qed.

(* trace/script/random-129 *)
Example suite_137 : suite_seen (Node Leaf (Node Leaf (Node (Node (Node (Node (Node Leaf (Node (Node (Node Leaf (Node (Node Leaf (Node Leaf (Node (Node Leaf Leaf) Leaf))) Leaf)) Leaf) Leaf)) Leaf) Leaf) Leaf) Leaf)))
  [(0x1%positive, Only R); (0x3%positive, Both L); (0x7%positive, Both R); (0xe%positive, Both L); (0x1c%positive, Both R); (0x38%positive, Both R); (0x70%positive, Only L); (0xe1%positive, Only R); (0x1c2%positive, Both L); (0x384%positive, Only R); (0x709%positive, Both L); (0xe12%positive, Both L); (0x1c25%positive, Both L); (0x384b%positive, Both L); (0x7096%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x0); (0x6%positive, 0x1); (0x7%positive, 0x0); (0xf%positive, 0x1); (0xe%positive, 0x0); (0x1c%positive, 0x1); (0x39%positive, 0x3); (0x38%positive, 0x2); (0x71%positive, 0x5); (0x70%positive, 0x4); (0xe0%positive, 0x8); (0x1d%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-130 *)
Example suite_138 : suite_seen (Node (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf))) (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf))))
  [(0x1%positive, Both L); (0x2%positive, Neither); (0x4%positive, Only L); (0x8%positive, Only R); (0x9%positive, Both L); (0x5%positive, Both L); (0xa%positive, Both L); (0xb%positive, Only L); (0x3%positive, Both R); (0x6%positive, Both R); (0xc%positive, Both L); (0xd%positive, Both R); (0x7%positive, Neither); (0xe%positive, Only L); (0xf%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x3%positive, 0x0); (0x7%positive, 0x1); (0x6%positive, 0x0); (0xd%positive, 0x1); (0x1b%positive, 0x3); (0x1a%positive, 0x2); (0xc%positive, 0x0); (0x18%positive, 0x1); (0x19%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-131 *)
Example suite_139 : suite_seen (Node (Node Leaf (Node Leaf (Node (Node (Node (Node (Node (Node (Node (Node (Node Leaf (Node (Node (Node Leaf (Node Leaf (Node (Node Leaf (Node Leaf (Node (Node Leaf (Node Leaf Leaf)) Leaf))) Leaf))) Leaf) Leaf)) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf))) Leaf)
  [(0x1%positive, Both R); (0x2%positive, Both L); (0x5%positive, Both R); (0xb%positive, Only L); (0x16%positive, Only R); (0x2c%positive, Only R); (0x58%positive, Only L); (0xb0%positive, Both L); (0x160%positive, Both L); (0x2c0%positive, Both R); (0x580%positive, Only L); (0xb00%positive, Both L); (0x1601%positive, Only R); (0x2c02%positive, Only L); (0x5804%positive, Both R); (0xb009%positive, Both L); (0x16013%positive, Both R); (0x2c026%positive, Both L); (0x5804d%positive, Both L); (0xb009b%positive, Both L); (0x160136%positive, Both R); (0x2c026d%positive, Both L)]
  [0xa%positive; 0x160137%positive; 0x2c1%positive; 0x2d%positive]
  = suite_expected true
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x2%positive, 0x0); (0x4%positive, 0x1); (0x5%positive, 0x0); (0xb%positive, 0x1); (0x16%positive, 0x2); (0x2d%positive, 0x4)].
Proof. evaluated. Qed.

(* trace/script/random-132 *)
Example suite_140 : suite_seen (Node (Node (Node (Node Leaf (Node Leaf Leaf)) Leaf) (Node Leaf (Node (Node (Node (Node (Node (Node (Node Leaf (Node Leaf (Node (Node Leaf Leaf) Leaf))) (Node Leaf Leaf)) (Node Leaf Leaf)) (Node Leaf (Node Leaf Leaf))) (Node Leaf Leaf)) (Node (Node Leaf Leaf) Leaf)) Leaf))) Leaf)
  [(0x1%positive, Only L); (0x2%positive, Both L); (0x4%positive, Only L); (0x8%positive, Neither); (0x11%positive, Only R); (0x5%positive, Both R); (0xb%positive, Both L); (0x16%positive, Only R); (0x2c%positive, Both R); (0x58%positive, Neither); (0xb0%positive, Only R); (0x160%positive, Only L); (0x2c0%positive, Only L); (0x581%positive, Only L); (0xb03%positive, Only L); (0x1606%positive, Both R); (0x2c1%positive, Both L); (0x161%positive, Only L); (0xb1%positive, Only R); (0x163%positive, Both R); (0x59%positive, Neither); (0x2d%positive, Both L); (0x5a%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x0); (0x4%positive, 0x1); (0x8%positive, 0x2); (0x5%positive, 0x0); (0xb%positive, 0x1); (0x16%positive, 0x3); (0x2d%positive, 0x6); (0x5a%positive, 0xd); (0xb4%positive, 0x1a); (0x5b%positive, 0xc); (0x17%positive, 0x2); (0xa%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-133 *)
Example suite_141 : suite_seen (Node Leaf (Node (Node Leaf Leaf) Leaf))
  [(0x1%positive, Both R); (0x3%positive, Only L); (0x6%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x6%positive, 0x2); (0xd%positive, 0x5); (0xc%positive, 0x4); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-134 *)
Example suite_142 : suite_seen (Node (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) Leaf))
  [(0x1%positive, Both L); (0x2%positive, Both L); (0x4%positive, Neither); (0x8%positive, Both L); (0x5%positive, Neither); (0x3%positive, Only R); (0x6%positive, Only L)]
  [0x7%positive]
  = suite_expected true
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x3); (0x5%positive, 0x2); (0x3%positive, 0x0); (0x7%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-135 *)
Example suite_143 : suite_seen (Node (Node (Node Leaf (Node Leaf (Node Leaf (Node (Node (Node Leaf Leaf) Leaf) Leaf)))) Leaf) Leaf)
  [(0x1%positive, Both R); (0x2%positive, Both L); (0x4%positive, Both L); (0x9%positive, Both R); (0x13%positive, Only R); (0x27%positive, Both L); (0x4e%positive, Both R); (0x9c%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x2%positive, 0x0); (0x4%positive, 0x1); (0x8%positive, 0x3); (0x9%positive, 0x2); (0x13%positive, 0x5); (0x27%positive, 0xa); (0x4e%positive, 0x15); (0x9d%positive, 0x2b); (0x9c%positive, 0x2a); (0x139%positive, 0x54); (0x4f%positive, 0x14); (0x12%positive, 0x4); (0x5%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-136 *)
Example suite_144 : suite_seen (Node (Node (Node Leaf (Node Leaf (Node (Node Leaf Leaf) (Node (Node (Node (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node Leaf Leaf)) Leaf)) Leaf)) Leaf) (Node Leaf Leaf)) Leaf) Leaf)))) (Node Leaf Leaf)) Leaf)
  [(0x1%positive, Only L); (0x2%positive, Only R); (0x4%positive, Both L); (0x9%positive, Both L); (0x13%positive, Both R); (0x26%positive, Both R); (0x27%positive, Both R); (0x4e%positive, Only R); (0x9c%positive, Neither); (0x138%positive, Neither); (0x270%positive, Both R); (0x4e1%positive, Both R); (0x9c2%positive, Neither); (0x1385%positive, Neither); (0x270a%positive, Both L); (0x4e15%positive, Both L); (0x139%positive, Neither); (0x5%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x0); (0x5%positive, 0x0); (0xa%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-137 *)
Example suite_145 : suite_seen (Node (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf))) (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf))))
  [(0x1%positive, Both R); (0x2%positive, Both L); (0x4%positive, Both L); (0x8%positive, Both L); (0x9%positive, Neither); (0x5%positive, Both R); (0xa%positive, Neither); (0xb%positive, Both L); (0x3%positive, Only R); (0x6%positive, Both L); (0xc%positive, Both R); (0xd%positive, Both R); (0x7%positive, Both L); (0xe%positive, Both R); (0xf%positive, Neither)]
  [0x12%positive; 0x17%positive; 0x1d%positive]
  = suite_expected true
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x2); (0xe%positive, 0x5); (0x1d%positive, 0xb)].
Proof. evaluated. Qed.

(* trace/script/random-138 *)
Example suite_146 : suite_seen (Node (Node (Node Leaf (Node Leaf Leaf)) Leaf) (Node Leaf Leaf))
  [(0x1%positive, Both L); (0x2%positive, Both R); (0x4%positive, Neither); (0x9%positive, Only R); (0x3%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x3); (0x4%positive, 0x2); (0x3%positive, 0x0); (0x6%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-139 *)
Example suite_147 : suite_seen (Node (Node (Node Leaf Leaf) (Node Leaf (Node Leaf (Node (Node (Node Leaf (Node (Node (Node Leaf (Node (Node (Node Leaf (Node Leaf Leaf)) Leaf) Leaf)) Leaf) Leaf)) (Node Leaf Leaf)) (Node Leaf Leaf))))) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Both L); (0x4%positive, Both R); (0x5%positive, Both R); (0xb%positive, Both R); (0x17%positive, Both L); (0x2e%positive, Only R); (0x5c%positive, Only R); (0xb9%positive, Both L); (0x172%positive, Neither); (0x2e4%positive, Neither); (0x5c9%positive, Only L); (0xb92%positive, Both L); (0x1724%positive, Neither); (0x2e49%positive, Only L); (0x5d%positive, Only R); (0x2f%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x3); (0x9%positive, 0x7); (0x8%positive, 0x6); (0x5%positive, 0x2); (0xb%positive, 0x5); (0x17%positive, 0xb); (0x2e%positive, 0x17); (0x5d%positive, 0x2e); (0xbb%positive, 0x5c); (0x2f%positive, 0x16); (0x5f%positive, 0x2d); (0x5e%positive, 0x2c); (0x16%positive, 0xa); (0xa%positive, 0x4); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-140 *)
Example suite_148 : suite_seen (Node (Node (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) Leaf)) (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf)))
  [(0x1%positive, Both L); (0x2%positive, Neither); (0x4%positive, Both L); (0x8%positive, Both L); (0x10%positive, Neither); (0x9%positive, Both L); (0x5%positive, Both L); (0xa%positive, Neither); (0x3%positive, Both R); (0x6%positive, Neither); (0xc%positive, Only R); (0x7%positive, Both R)]
  [0x21%positive; 0x18%positive]
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x3%positive, 0x0); (0x7%positive, 0x1); (0xf%positive, 0x3); (0xe%positive, 0x2); (0x6%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-141 *)
Example suite_149 : suite_seen (Node (Node (Node Leaf (Node Leaf (Node Leaf Leaf))) (Node Leaf (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node Leaf Leaf)))) Leaf)
  [(0x1%positive, Only R); (0x2%positive, Both L); (0x4%positive, Only R); (0x9%positive, Both L); (0x13%positive, Only L); (0x5%positive, Both L); (0xb%positive, Only L); (0x16%positive, Only R); (0x2c%positive, Only L); (0x2d%positive, Only L); (0x17%positive, Neither)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-142 *)
Example suite_150 : suite_seen (Node (Node (Node Leaf Leaf) Leaf) (Node (Node Leaf (Node Leaf Leaf)) (Node Leaf (Node Leaf (Node Leaf Leaf)))))
  [(0x1%positive, Both L); (0x2%positive, Only R); (0x4%positive, Only L); (0x3%positive, Only R); (0x6%positive, Both R); (0xd%positive, Only L); (0x7%positive, Both L); (0xf%positive, Only L); (0x1f%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x2); (0x3%positive, 0x0); (0x7%positive, 0x0); (0xe%positive, 0x1); (0xf%positive, 0x0); (0x1e%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-143 *)
Example suite_151 : suite_seen (Node Leaf (Node (Node Leaf Leaf) (Node (Node Leaf (Node Leaf Leaf)) Leaf)))
  [(0x1%positive, Both R); (0x3%positive, Both L); (0x6%positive, Both L); (0x7%positive, Both L); (0xe%positive, Both R); (0x1d%positive, Both L)]
  [0xf%positive]
  = suite_expected true
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x6%positive, 0x3); (0xc%positive, 0x7); (0xd%positive, 0x6); (0x7%positive, 0x2); (0xe%positive, 0x5); (0x1d%positive, 0xb); (0x3a%positive, 0x17); (0x3b%positive, 0x16); (0x1c%positive, 0xa); (0xf%positive, 0x4)].
Proof. evaluated. Qed.

(* trace/script/random-144 *)
Example suite_152 : suite_seen (Node (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf))) (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf))))
  [(0x1%positive, Only L); (0x2%positive, Both R); (0x4%positive, Both L); (0x8%positive, Only R); (0x9%positive, Both L); (0x5%positive, Both L); (0xa%positive, Both R); (0xb%positive, Both L); (0x3%positive, Only L); (0x6%positive, Both R); (0xc%positive, Only L); (0xd%positive, Only L); (0x7%positive, Both R); (0xe%positive, Both L); (0xf%positive, Both L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x0); (0x5%positive, 0x1); (0xa%positive, 0x3); (0x15%positive, 0x7); (0x14%positive, 0x6); (0xb%positive, 0x2); (0x16%positive, 0x5); (0x17%positive, 0x4); (0x4%positive, 0x0); (0x8%positive, 0x1); (0x11%positive, 0x2); (0x9%positive, 0x0); (0x12%positive, 0x1); (0x13%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-145 *)
Example suite_153 : suite_seen (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf)))
  [(0x1%positive, Both R); (0x2%positive, Only L); (0x4%positive, Neither); (0x5%positive, Both R); (0x3%positive, Both R); (0x6%positive, Only L); (0x7%positive, Neither)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x3); (0x6%positive, 0x2); (0xc%positive, 0x4); (0x2%positive, 0x0); (0x4%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-146 *)
Example suite_154 : suite_seen (Node (Node (Node (Node (Node Leaf (Node Leaf (Node (Node Leaf (Node Leaf (Node Leaf (Node (Node Leaf (Node Leaf Leaf)) Leaf)))) Leaf))) Leaf) Leaf) (Node Leaf Leaf)) (Node Leaf Leaf))
  [(0x1%positive, Both R); (0x2%positive, Both L); (0x4%positive, Neither); (0x8%positive, Only L); (0x10%positive, Both R); (0x21%positive, Both R); (0x43%positive, Both L); (0x86%positive, Both L); (0x10d%positive, Only L); (0x21b%positive, Only R); (0x437%positive, Both L); (0x86e%positive, Both L); (0x10dd%positive, Both L); (0x5%positive, Both L); (0x3%positive, Both L)]
  [0x86f%positive; 0xb%positive; 0x6%positive]
  = suite_expected true
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x6%positive, 0x3)].
Proof. evaluated. Qed.

(* trace/script/random-147 *)
Example suite_155 : suite_seen (Node (Node Leaf Leaf) (Node (Node Leaf Leaf) (Node (Node (Node Leaf Leaf) (Node (Node (Node (Node Leaf Leaf) (Node (Node Leaf Leaf) (Node (Node Leaf Leaf) (Node (Node (Node (Node (Node Leaf (Node Leaf (Node Leaf Leaf))) Leaf) Leaf) Leaf) Leaf)))) Leaf) (Node Leaf Leaf))) (Node Leaf Leaf))))
  [(0x1%positive, Only R); (0x2%positive, Both R); (0x3%positive, Neither); (0x6%positive, Both R); (0x7%positive, Both L); (0xe%positive, Both L); (0x1c%positive, Both R); (0x1d%positive, Both R); (0x3a%positive, Both R); (0x74%positive, Both L); (0xe8%positive, Only L); (0xe9%positive, Both R); (0x1d2%positive, Both L); (0x1d3%positive, Only R); (0x3a6%positive, Both L); (0x3a7%positive, Both L); (0x74e%positive, Both L); (0xe9c%positive, Both L); (0x1d38%positive, Both R); (0x3a70%positive, Only L); (0x74e1%positive, Both L); (0xe9c3%positive, Both L); (0x3b%positive, Only L); (0xf%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-148 *)
Example suite_156 : suite_seen (Node (Node Leaf (Node (Node (Node Leaf (Node Leaf Leaf)) (Node (Node (Node (Node (Node Leaf Leaf) (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf))) Leaf) (Node (Node Leaf Leaf) (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf)))) (Node Leaf Leaf))) (Node Leaf Leaf))) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Both L); (0x5%positive, Only R); (0xa%positive, Neither); (0x14%positive, Both R); (0x29%positive, Both L); (0x15%positive, Neither); (0x2a%positive, Both L); (0x54%positive, Neither); (0xa8%positive, Both L); (0x150%positive, Both R); (0x151%positive, Both R); (0x2a2%positive, Both L); (0x544%positive, Only L); (0x2a3%positive, Neither); (0x55%positive, Both L); (0xaa%positive, Only L); (0xab%positive, Both R); (0x156%positive, Both R); (0x2ac%positive, Both R); (0x157%positive, Both L); (0x2b%positive, Neither); (0xb%positive, Neither)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x3); (0x5%positive, 0x2); (0xb%positive, 0x4); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-149 *)
Example suite_157 : suite_seen (Node (Node Leaf Leaf) (Node (Node (Node Leaf (Node (Node Leaf Leaf) (Node (Node Leaf Leaf) (Node (Node Leaf (Node (Node (Node (Node Leaf (Node (Node (Node Leaf Leaf) Leaf) Leaf)) Leaf) Leaf) Leaf)) (Node Leaf Leaf))))) Leaf) (Node Leaf Leaf)))
  [(0x1%positive, Both R); (0x2%positive, Both R); (0x3%positive, Both R); (0x6%positive, Only L); (0xc%positive, Both R); (0x19%positive, Both R); (0x32%positive, Neither); (0x33%positive, Both L); (0x66%positive, Both L); (0x67%positive, Both R); (0xce%positive, Both R); (0x19d%positive, Both L); (0x33a%positive, Both R); (0x674%positive, Both L); (0xce8%positive, Both L); (0x19d1%positive, Neither); (0x33a2%positive, Neither); (0x6744%positive, Neither); (0xcf%positive, Only L); (0x7%positive, Only L)]
  [0x4%positive; 0x64%positive; 0x65%positive; 0xce88%positive; 0x6745%positive]
  = suite_expected true
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x3); (0xe%positive, 0x6); (0x6%positive, 0x2); (0xc%positive, 0x4); (0x19%positive, 0x9); (0x33%positive, 0x13); (0x66%positive, 0x27); (0xcc%positive, 0x4f); (0xcd%positive, 0x4e); (0x67%positive, 0x26); (0xcf%positive, 0x4d); (0x19e%positive, 0x9a); (0xce%positive, 0x4c); (0x19d%positive, 0x99); (0x33a%positive, 0x133); (0x675%positive, 0x267); (0x674%positive, 0x266); (0xce8%positive, 0x4cd); (0x19d0%positive, 0x99b); (0x19d1%positive, 0x99a); (0xce9%positive, 0x4cc); (0x33b%positive, 0x132); (0x19c%positive, 0x98); (0x32%positive, 0x12); (0x18%positive, 0x8); (0x2%positive, 0x0); (0x5%positive, 0x1); (0x4%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-151 *)
Example suite_158 : suite_seen (Node (Node Leaf Leaf) (Node (Node (Node Leaf (Node Leaf Leaf)) Leaf) (Node (Node (Node (Node (Node (Node Leaf Leaf) (Node Leaf (Node (Node Leaf Leaf) (Node Leaf Leaf)))) Leaf) Leaf) (Node Leaf Leaf)) (Node Leaf Leaf))))
  [(0x1%positive, Both L); (0x2%positive, Both L); (0x3%positive, Only L); (0x6%positive, Only L); (0xc%positive, Neither); (0x19%positive, Only L); (0x7%positive, Neither); (0xe%positive, Neither); (0x1c%positive, Both L); (0x38%positive, Neither); (0x70%positive, Only R); (0xe0%positive, Both R); (0xe1%positive, Only L); (0x1c3%positive, Only R); (0x386%positive, Both L); (0x387%positive, Both L); (0x1d%positive, Neither); (0xf%positive, Both L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x3); (0x5%positive, 0x2); (0x3%positive, 0x0); (0x6%positive, 0x0); (0xc%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-152 *)
Example suite_159 : suite_seen (Node (Node (Node (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) Leaf)) (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf))) (Node (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) Leaf)))
  [(0x1%positive, Both R); (0x2%positive, Both R); (0x4%positive, Neither); (0x8%positive, Both L); (0x10%positive, Both L); (0x20%positive, Both L); (0x11%positive, Neither); (0x9%positive, Only R); (0x12%positive, Both L); (0x5%positive, Both R); (0xa%positive, Neither); (0x14%positive, Only R); (0xb%positive, Only L); (0x3%positive, Both L); (0x6%positive, Neither); (0xc%positive, Only L); (0x18%positive, Both R); (0xd%positive, Both L); (0x7%positive, Only R); (0xe%positive, Only L)]
  [0x41%positive; 0x15%positive; 0x16%positive; 0x31%positive; 0x1b%positive]
  = suite_expected true
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x6%positive, 0x3); (0x7%positive, 0x2); (0xf%positive, 0x4); (0x2%positive, 0x0); (0x5%positive, 0x1); (0xb%positive, 0x3); (0x16%positive, 0x6)].
Proof. evaluated. Qed.

(* trace/script/random-153 *)
Example suite_160 : suite_seen (Node (Node Leaf (Node (Node (Node Leaf (Node (Node Leaf Leaf) Leaf)) Leaf) Leaf)) Leaf)
  [(0x1%positive, Only R); (0x2%positive, Both L); (0x5%positive, Only L); (0xa%positive, Only R); (0x14%positive, Only R); (0x29%positive, Only L); (0x52%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-154 *)
Example suite_161 : suite_seen (Node (Node (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node (Node (Node Leaf (Node (Node (Node Leaf (Node (Node Leaf (Node (Node (Node Leaf (Node (Node Leaf Leaf) Leaf)) Leaf) Leaf)) Leaf)) Leaf) Leaf)) Leaf) Leaf)))))) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Both L); (0x9%positive, Both R); (0x13%positive, Neither); (0x27%positive, Only R); (0x4f%positive, Both R); (0x9f%positive, Only R); (0x13e%positive, Both R); (0x27c%positive, Both L); (0x4f9%positive, Both R); (0x9f2%positive, Neither); (0x13e4%positive, Both L); (0x27c9%positive, Both L); (0x4f92%positive, Both R); (0x9f25%positive, Both L); (0x13e4a%positive, Both L); (0x27c94%positive, Both R); (0x4f929%positive, Both L); (0x9f252%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x8%positive, 0x5); (0x9%positive, 0x4); (0x13%positive, 0x9); (0x12%positive, 0x8); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-155 *)
Example suite_162 : suite_seen (Node (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) Leaf))
  [(0x1%positive, Only L); (0x2%positive, Neither); (0x4%positive, Only R); (0x8%positive, Both L); (0x5%positive, Both L); (0x3%positive, Neither); (0x6%positive, Only R)]
  [0x7%positive]
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-156 *)
Example suite_163 : suite_seen (Node (Node Leaf (Node (Node (Node (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node (Node Leaf (Node (Node (Node Leaf (Node Leaf (Node Leaf Leaf))) Leaf) Leaf)) Leaf))))))) Leaf) Leaf) Leaf)) Leaf)
  [(0x1%positive, Both R); (0x2%positive, Both R); (0x5%positive, Both R); (0xa%positive, Both R); (0x14%positive, Only R); (0x28%positive, Only L); (0x51%positive, Neither); (0xa3%positive, Both L); (0x147%positive, Both L); (0x28f%positive, Only L); (0x51f%positive, Both L); (0xa3f%positive, Only L); (0x147e%positive, Neither); (0x28fd%positive, Both L); (0x51fa%positive, Neither); (0xa3f4%positive, Both L); (0x147e9%positive, Both L); (0x28fd3%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x2%positive, 0x0); (0x5%positive, 0x1); (0xb%positive, 0x3); (0xa%positive, 0x2); (0x15%positive, 0x5); (0x14%positive, 0x4); (0x29%positive, 0x8); (0x4%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-157 *)
Example suite_164 : suite_seen (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf)))
  [(0x1%positive, Both L); (0x2%positive, Only R); (0x4%positive, Both R); (0x5%positive, Both R); (0x3%positive, Both R); (0x6%positive, Both L); (0x7%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x2); (0xb%positive, 0x5); (0xa%positive, 0x4); (0x3%positive, 0x0); (0x7%positive, 0x1); (0xf%positive, 0x3); (0xe%positive, 0x2); (0x6%positive, 0x0); (0xc%positive, 0x1); (0xd%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-158 *)
Example suite_165 : suite_seen (Node Leaf (Node (Node (Node (Node (Node Leaf (Node (Node Leaf (Node Leaf (Node (Node Leaf (Node Leaf (Node Leaf (Node (Node Leaf Leaf) Leaf)))) Leaf))) Leaf)) (Node Leaf Leaf)) Leaf) (Node Leaf Leaf)) Leaf))
  [(0x1%positive, Only L); (0x3%positive, Neither); (0x6%positive, Both R); (0xc%positive, Only R); (0x18%positive, Only R); (0x30%positive, Both R); (0x61%positive, Both R); (0xc2%positive, Both L); (0x185%positive, Only L); (0x30b%positive, Both L); (0x616%positive, Both L); (0xc2d%positive, Only L); (0x185b%positive, Only L); (0x30b7%positive, Only R); (0x616e%positive, Only R); (0x31%positive, Both R); (0xd%positive, Only L)]
  [0x60%positive; 0x616f%positive; 0x1b%positive]
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-159 *)
Example suite_166 : suite_seen (Node (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf))) (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf))))
  [(0x1%positive, Neither); (0x2%positive, Both L); (0x4%positive, Only R); (0x8%positive, Only L); (0x9%positive, Only L); (0x5%positive, Neither); (0xa%positive, Both L); (0xb%positive, Only R); (0x3%positive, Both L); (0x6%positive, Both L); (0xc%positive, Only R); (0xd%positive, Only R); (0x7%positive, Only L); (0xe%positive, Neither); (0xf%positive, Both L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-160 *)
Example suite_167 : suite_seen (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node (Node (Node Leaf (Node Leaf (Node Leaf (Node (Node (Node (Node Leaf (Node Leaf Leaf)) Leaf) Leaf) Leaf)))) Leaf) Leaf) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)
  [(0x1%positive, Both R); (0x2%positive, Both L); (0x5%positive, Only L); (0xa%positive, Only L); (0x15%positive, Only L); (0x2a%positive, Neither); (0x55%positive, Only L); (0xaa%positive, Both R); (0x155%positive, Both R); (0x2aa%positive, Both R); (0x555%positive, Only R); (0xaaa%positive, Both R); (0x1554%positive, Neither); (0x2aa8%positive, Only R); (0x5551%positive, Both R); (0xaaa3%positive, Only R); (0x15547%positive, Both L); (0x2aa8e%positive, Both R); (0x5551c%positive, Neither); (0xaaa38%positive, Both R); (0x155471%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x2%positive, 0x0); (0x4%positive, 0x1); (0x5%positive, 0x0); (0xa%positive, 0x0); (0x14%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-162 *)
Example suite_168 : suite_seen (Node (Node (Node (Node (Node Leaf Leaf) Leaf) (Node (Node Leaf (Node Leaf Leaf)) (Node (Node Leaf Leaf) Leaf))) Leaf) Leaf)
  [(0x1%positive, Neither); (0x2%positive, Both L); (0x4%positive, Both L); (0x8%positive, Both R); (0x10%positive, Both L); (0x9%positive, Only R); (0x12%positive, Only L); (0x25%positive, Both R); (0x13%positive, Both R); (0x26%positive, Neither)]
  []
  = suite_expected false
  [(0x1%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-163 *)
Example suite_169 : suite_seen (Node (Node Leaf Leaf) (Node Leaf (Node (Node (Node Leaf Leaf) (Node (Node (Node Leaf Leaf) (Node (Node (Node (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf (Node Leaf Leaf)) Leaf)) (Node Leaf (Node Leaf (Node Leaf Leaf)))) (Node Leaf Leaf)) (Node Leaf Leaf))) Leaf)) (Node Leaf Leaf))))
  [(0x1%positive, Both L); (0x2%positive, Both L); (0x3%positive, Both R); (0x7%positive, Neither); (0xe%positive, Both L); (0x1c%positive, Both L); (0x1d%positive, Both L); (0x3a%positive, Both R); (0x74%positive, Both R); (0x75%positive, Only R); (0xea%positive, Only L); (0x1d4%positive, Neither); (0x3a8%positive, Both L); (0x750%positive, Only L); (0xea0%positive, Only R); (0xea1%positive, Only L); (0x751%positive, Both R); (0xea2%positive, Neither); (0x1d45%positive, Both R); (0x3a9%positive, Only R); (0x753%positive, Both L); (0xea7%positive, Both L); (0x1d5%positive, Both R); (0xeb%positive, Both R); (0xf%positive, Neither)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x3); (0x5%positive, 0x2); (0x3%positive, 0x0); (0x7%positive, 0x1); (0x6%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-164 *)
Example suite_170 : suite_seen (Node (Node (Node Leaf (Node Leaf Leaf)) (Node (Node (Node (Node Leaf Leaf) Leaf) (Node (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) Leaf))) (Node Leaf Leaf))) (Node (Node (Node Leaf Leaf) Leaf) Leaf))
  [(0x1%positive, Both R); (0x2%positive, Both R); (0x4%positive, Only L); (0x9%positive, Both L); (0x5%positive, Both R); (0xa%positive, Neither); (0x14%positive, Both L); (0x28%positive, Both L); (0x15%positive, Both L); (0x2a%positive, Neither); (0x54%positive, Both L); (0xa8%positive, Neither); (0x55%positive, Both L); (0x2b%positive, Both R); (0x56%positive, Both R); (0xb%positive, Both R); (0x3%positive, Neither); (0x6%positive, Neither); (0xc%positive, Neither)]
  [0x51%positive; 0x151%positive; 0xab%positive; 0xac%positive; 0x17%positive]
  = suite_expected true
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x2%positive, 0x0); (0x5%positive, 0x1); (0xb%positive, 0x3); (0x17%positive, 0x7)].
Proof. evaluated. Qed.

(* trace/script/random-165 *)
Example suite_171 : suite_seen (Node (Node (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) Leaf)) (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf)))
  [(0x1%positive, Neither); (0x2%positive, Both R); (0x4%positive, Both L); (0x8%positive, Only L); (0x10%positive, Only L); (0x9%positive, Both L); (0x5%positive, Both R); (0xa%positive, Both L); (0x3%positive, Only L); (0x6%positive, Neither); (0xc%positive, Neither); (0x7%positive, Both L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-166 *)
Example suite_172 : suite_seen (Node (Node (Node (Node Leaf Leaf) Leaf) (Node (Node (Node Leaf (Node (Node (Node Leaf Leaf) Leaf) (Node (Node Leaf Leaf) (Node (Node Leaf (Node (Node Leaf Leaf) Leaf)) (Node (Node Leaf Leaf) (Node (Node (Node (Node Leaf (Node Leaf Leaf)) Leaf) (Node Leaf Leaf)) Leaf)))))) Leaf) (Node Leaf Leaf))) (Node Leaf Leaf))
  [(0x1%positive, Both L); (0x2%positive, Neither); (0x4%positive, Both R); (0x8%positive, Only R); (0x5%positive, Only R); (0xa%positive, Both L); (0x14%positive, Neither); (0x29%positive, Both L); (0x52%positive, Neither); (0xa4%positive, Both L); (0x53%positive, Both R); (0xa6%positive, Both R); (0xa7%positive, Only L); (0x14e%positive, Both R); (0x29d%positive, Neither); (0x53a%positive, Only L); (0x14f%positive, Both R); (0x29e%positive, Both L); (0x29f%positive, Both L); (0x53e%positive, Both R); (0xa7c%positive, Both L); (0x14f8%positive, Both R); (0x29f1%positive, Both L); (0xa7d%positive, Both L); (0xb%positive, Only L); (0x3%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x3%positive, 0x0); (0x7%positive, 0x1); (0x6%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-167 *)
Example suite_173 : suite_seen (Node (Node (Node Leaf (Node Leaf Leaf)) (Node (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf Leaf) (Node (Node Leaf (Node Leaf Leaf)) (Node Leaf Leaf)))) (Node Leaf (Node (Node Leaf Leaf) Leaf)))) (Node Leaf (Node (Node Leaf Leaf) Leaf))) (Node Leaf Leaf))) (Node Leaf Leaf))
  [(0x1%positive, Neither); (0x2%positive, Both L); (0x4%positive, Neither); (0x9%positive, Only R); (0x5%positive, Both L); (0xa%positive, Both R); (0x14%positive, Neither); (0x29%positive, Both R); (0x52%positive, Only L); (0xa5%positive, Both L); (0x14a%positive, Only R); (0x14b%positive, Only R); (0x296%positive, Both R); (0x52d%positive, Both R); (0x297%positive, Only L); (0x53%positive, Both L); (0xa7%positive, Both R); (0x14e%positive, Only L); (0x15%positive, Both R); (0x2b%positive, Both L); (0x56%positive, Only L); (0xb%positive, Both R); (0x3%positive, Both L)]
  [0x52c%positive; 0x52e%positive; 0xa6%positive; 0x29d%positive; 0x57%positive; 0x6%positive]
  = suite_expected false
  [(0x1%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-168 *)
Example suite_174 : suite_seen (Node (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf))) (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf))))
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Both L); (0x8%positive, Neither); (0x9%positive, Only L); (0x5%positive, Both L); (0xa%positive, Only R); (0xb%positive, Only L); (0x3%positive, Both L); (0x6%positive, Only L); (0xc%positive, Both L); (0xd%positive, Both L); (0x7%positive, Both R); (0xe%positive, Only R); (0xf%positive, Both L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x8%positive, 0x5); (0x9%positive, 0x4); (0x12%positive, 0x8); (0x3%positive, 0x0); (0x6%positive, 0x1); (0xc%positive, 0x2); (0x18%positive, 0x5); (0x19%positive, 0x4); (0x7%positive, 0x0); (0xf%positive, 0x1); (0x1e%positive, 0x3); (0x1f%positive, 0x2); (0xe%positive, 0x0); (0x1d%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-169 *)
Example suite_175 : suite_seen (Node (Node (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) Leaf)) (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf)))
  [(0x1%positive, Both L); (0x2%positive, Both L); (0x4%positive, Only R); (0x8%positive, Both L); (0x10%positive, Only R); (0x9%positive, Both L); (0x5%positive, Both R); (0xa%positive, Both R); (0x3%positive, Only L); (0x6%positive, Only L); (0xc%positive, Neither); (0x7%positive, Both L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x3); (0x9%positive, 0x6); (0x12%positive, 0xd); (0x13%positive, 0xc); (0x5%positive, 0x2); (0xb%positive, 0x5); (0xa%positive, 0x4); (0x15%positive, 0x9); (0x14%positive, 0x8); (0x3%positive, 0x0); (0x6%positive, 0x0); (0xc%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-170 *)
Example suite_176 : suite_seen (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf (Node (Node (Node (Node Leaf Leaf) (Node (Node Leaf (Node (Node Leaf (Node (Node (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf)))) Leaf) Leaf)) Leaf)) Leaf)) Leaf) (Node Leaf Leaf))))
  [(0x1%positive, Both L); (0x2%positive, Both L); (0x4%positive, Both L); (0x3%positive, Both R); (0x7%positive, Only R); (0xe%positive, Both L); (0x1c%positive, Both L); (0x38%positive, Only L); (0x39%positive, Only R); (0x72%positive, Both L); (0xe5%positive, Neither); (0x1ca%positive, Only R); (0x395%positive, Both L); (0x72a%positive, Neither); (0xe54%positive, Only R); (0x1ca9%positive, Only R); (0x3953%positive, Both L); (0x72a7%positive, Both R); (0xf%positive, Both L)]
  [0x6%positive; 0x70%positive; 0x72a6%positive; 0x1cb%positive; 0x1e%positive]
  = suite_expected true
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x3); (0x8%positive, 0x7); (0x9%positive, 0x6); (0x5%positive, 0x2); (0x3%positive, 0x0); (0x7%positive, 0x1); (0xf%positive, 0x2); (0x1e%positive, 0x5)].
Proof. evaluated. Qed.

(* trace/script/random-171 *)
Example suite_177 : suite_seen (Node Leaf (Node (Node (Node Leaf Leaf) Leaf) (Node (Node Leaf (Node Leaf Leaf)) (Node (Node (Node Leaf Leaf) (Node Leaf (Node (Node (Node (Node (Node (Node Leaf (Node (Node Leaf Leaf) Leaf)) (Node Leaf Leaf)) (Node (Node Leaf Leaf) Leaf)) (Node Leaf Leaf)) Leaf) (Node Leaf (Node Leaf (Node Leaf Leaf)))))) (Node Leaf (Node Leaf Leaf))))))
  [(0x1%positive, Only R); (0x3%positive, Only L); (0x6%positive, Both L); (0xc%positive, Both L); (0x7%positive, Both R); (0xe%positive, Only R); (0x1d%positive, Both R); (0xf%positive, Both L); (0x1e%positive, Only R); (0x3c%positive, Both R); (0x3d%positive, Both R); (0x7b%positive, Only L); (0xf6%positive, Both L); (0x1ec%positive, Both L); (0x3d8%positive, Both L); (0x7b0%positive, Neither); (0xf60%positive, Only L); (0x1ec1%positive, Both L); (0x3d82%positive, Both L); (0xf61%positive, Both L); (0x7b1%positive, Both R); (0xf62%positive, Both L); (0x3d9%positive, Neither); (0xf7%positive, Both R); (0x1ef%positive, Only R); (0x3df%positive, Neither); (0x1f%positive, Only R); (0x3f%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x0); (0x6%positive, 0x0); (0xc%positive, 0x1); (0x18%positive, 0x3); (0x19%positive, 0x2); (0xd%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-172 *)
Example suite_178 : suite_seen (Node (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf))) (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf))))
  [(0x1%positive, Both R); (0x2%positive, Neither); (0x4%positive, Both R); (0x8%positive, Neither); (0x9%positive, Only R); (0x5%positive, Both R); (0xa%positive, Neither); (0xb%positive, Neither); (0x3%positive, Both R); (0x6%positive, Both L); (0xc%positive, Both L); (0xd%positive, Both L); (0x7%positive, Neither); (0xe%positive, Both R); (0xf%positive, Both L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x3); (0x6%positive, 0x2); (0xc%positive, 0x5); (0x18%positive, 0xb); (0x19%positive, 0xa); (0xd%positive, 0x4); (0x1a%positive, 0x9); (0x1b%positive, 0x8); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-173 *)
Example suite_179 : suite_seen (Node Leaf (Node (Node (Node Leaf Leaf) (Node (Node Leaf Leaf) (Node (Node Leaf Leaf) Leaf))) (Node (Node (Node Leaf (Node (Node Leaf Leaf) (Node (Node (Node (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf Leaf) Leaf)) Leaf)) Leaf) (Node Leaf Leaf)) Leaf) (Node Leaf (Node (Node Leaf Leaf) Leaf))))) Leaf) Leaf)))
  [(0x1%positive, Only L); (0x3%positive, Only R); (0x6%positive, Both L); (0xc%positive, Only R); (0xd%positive, Both R); (0x1a%positive, Neither); (0x1b%positive, Neither); (0x36%positive, Neither); (0x7%positive, Both R); (0xe%positive, Only L); (0x1c%positive, Both R); (0x39%positive, Only R); (0x72%positive, Only R); (0x73%positive, Both L); (0xe6%positive, Both R); (0x1cc%positive, Only R); (0x398%positive, Only R); (0x730%positive, Both R); (0xe61%positive, Neither); (0x1cc2%positive, Both L); (0x3985%positive, Only R); (0x730a%positive, Both L); (0x399%positive, Both R); (0xe7%positive, Neither); (0x1cf%positive, Both R); (0x39e%positive, Both L)]
  [0x34%positive; 0xe5%positive; 0xe615%positive; 0x39f%positive]
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-174 *)
Example suite_180 : suite_seen (Node (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf))) (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf))))
  [(0x1%positive, Both R); (0x2%positive, Only R); (0x4%positive, Only L); (0x8%positive, Neither); (0x9%positive, Only R); (0x5%positive, Only R); (0xa%positive, Both L); (0xb%positive, Neither); (0x3%positive, Both L); (0x6%positive, Both L); (0xc%positive, Only R); (0xd%positive, Both L); (0x7%positive, Both R); (0xe%positive, Both R); (0xf%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x6%positive, 0x3); (0xc%positive, 0x7); (0x19%positive, 0xe); (0xd%positive, 0x6); (0x1a%positive, 0xd); (0x1b%positive, 0xc); (0x7%positive, 0x2); (0xf%positive, 0x5); (0x1f%positive, 0xa); (0xe%positive, 0x4); (0x1d%positive, 0x9); (0x1c%positive, 0x8); (0x2%positive, 0x0); (0x5%positive, 0x0); (0xb%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-175 *)
Example suite_181 : suite_seen (Node (Node (Node (Node (Node (Node Leaf Leaf) (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) Leaf)) (Node Leaf (Node Leaf Leaf))) (Node (Node Leaf Leaf) Leaf)) (Node Leaf (Node (Node Leaf Leaf) Leaf))) (Node (Node Leaf Leaf) Leaf))
  [(0x1%positive, Only R); (0x2%positive, Both L); (0x4%positive, Both R); (0x8%positive, Neither); (0x10%positive, Both L); (0x20%positive, Both L); (0x21%positive, Both L); (0x42%positive, Neither); (0x84%positive, Both R); (0x85%positive, Both L); (0x11%positive, Neither); (0x23%positive, Both R); (0x9%positive, Both R); (0x12%positive, Both L); (0x5%positive, Both L); (0xb%positive, Only R); (0x16%positive, Both R); (0x3%positive, Both R); (0x6%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x0); (0x7%positive, 0x1); (0x6%positive, 0x0); (0xd%positive, 0x1); (0xc%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-176 *)
Example suite_182 : suite_seen (Node (Node Leaf Leaf) (Node Leaf Leaf))
  [(0x1%positive, Both R); (0x2%positive, Both R); (0x3%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x6%positive, 0x2); (0x2%positive, 0x0); (0x5%positive, 0x1); (0x4%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-177 *)
Example suite_183 : suite_seen (Node (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf))) (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf))))
  [(0x1%positive, Neither); (0x2%positive, Both R); (0x4%positive, Both L); (0x8%positive, Both R); (0x9%positive, Only L); (0x5%positive, Neither); (0xa%positive, Only R); (0xb%positive, Both L); (0x3%positive, Only R); (0x6%positive, Both R); (0xc%positive, Both R); (0xd%positive, Only R); (0x7%positive, Both R); (0xe%positive, Only R); (0xf%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-178 *)
Example suite_184 : suite_seen (Node Leaf (Node (Node Leaf (Node (Node (Node Leaf (Node (Node (Node (Node (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node Leaf (Node (Node Leaf (Node Leaf (Node (Node Leaf (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf)) Leaf))) Leaf))) Leaf)) Leaf)) Leaf) Leaf) Leaf) Leaf) Leaf)) Leaf) Leaf)) Leaf))
  [(0x1%positive, Both L); (0x3%positive, Both L); (0x6%positive, Both L); (0xd%positive, Both L); (0x1a%positive, Neither); (0x34%positive, Only L); (0x69%positive, Both L); (0xd2%positive, Both L); (0x1a4%positive, Only R); (0x348%positive, Only R); (0x690%positive, Only R); (0xd20%positive, Both R); (0x1a41%positive, Both R); (0x3482%positive, Both R); (0x6905%positive, Both R); (0xd20a%positive, Only R); (0x1a415%positive, Both L); (0x3482b%positive, Neither); (0x69056%positive, Both L); (0xd20ad%positive, Only R); (0x1a415b%positive, Only R); (0x3482b6%positive, Both L); (0x69056d%positive, Both L); (0xd20ada%positive, Both R); (0x1a415b4%positive, Both L); (0x3482b68%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x3%positive, 0x0); (0x6%positive, 0x1); (0xc%positive, 0x3); (0xd%positive, 0x2); (0x1a%positive, 0x5); (0x1b%positive, 0x4); (0x7%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/random-179 *)
Example suite_185 : suite_seen (Node (Node (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf (Node Leaf Leaf))) Leaf) (Node Leaf Leaf))
  [(0x1%positive, Both L); (0x2%positive, Neither); (0x4%positive, Both L); (0x8%positive, Both L); (0x10%positive, Both R); (0x9%positive, Both R); (0x13%positive, Both L); (0x3%positive, Both R)]
  [0x20%positive; 0x27%positive]
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x3%positive, 0x0); (0x7%positive, 0x1); (0x6%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-2-first *)
Example suite_186 : suite_seen (Node (Node Leaf Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-turns-2-all *)
Example suite_187 : suite_seen (Node (Node Leaf Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x3); (0x4%positive, 0x2); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-3-all *)
Example suite_188 : suite_seen (Node (Node (Node Leaf Leaf) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Both L); (0x4%positive, Both L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x3); (0x8%positive, 0x7); (0x9%positive, 0x6); (0x5%positive, 0x2); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-3-first *)
Example suite_189 : suite_seen (Node (Node (Node Leaf Leaf) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x8%positive, 0x4); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-3-two-1 *)
Example suite_190 : suite_seen (Node (Node (Node Leaf Leaf) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Both L); (0x4%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x3); (0x8%positive, 0x6); (0x5%positive, 0x2); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-right-3-all *)
Example suite_191 : suite_seen (Node Leaf (Node Leaf (Node Leaf Leaf)))
  [(0x1%positive, Both R); (0x3%positive, Both R); (0x7%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x3); (0xf%positive, 0x7); (0xe%positive, 0x6); (0x6%positive, 0x2); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-right-3-first *)
Example suite_192 : suite_seen (Node Leaf (Node Leaf (Node Leaf Leaf)))
  [(0x1%positive, Both R); (0x3%positive, Only R); (0x7%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x2); (0xf%positive, 0x4); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-right-3-two-1 *)
Example suite_193 : suite_seen (Node Leaf (Node Leaf (Node Leaf Leaf)))
  [(0x1%positive, Both R); (0x3%positive, Both R); (0x7%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x3); (0xf%positive, 0x6); (0x6%positive, 0x2); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-turns-3-all *)
Example suite_194 : suite_seen (Node (Node Leaf (Node Leaf Leaf)) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Both R); (0x5%positive, Both L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x3); (0xa%positive, 0x7); (0xb%positive, 0x6); (0x4%positive, 0x2); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-turns-3-first *)
Example suite_195 : suite_seen (Node (Node Leaf (Node Leaf Leaf)) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only R); (0x5%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x2); (0xa%positive, 0x4); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-turns-3-two-1 *)
Example suite_196 : suite_seen (Node (Node Leaf (Node Leaf Leaf)) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Both R); (0x5%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x3); (0xa%positive, 0x6); (0x4%positive, 0x2); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-4-all *)
Example suite_197 : suite_seen (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Both L); (0x4%positive, Both L); (0x8%positive, Both L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x3); (0x8%positive, 0x7); (0x10%positive, 0xf); (0x11%positive, 0xe); (0x9%positive, 0x6); (0x5%positive, 0x2); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-4-first *)
Example suite_198 : suite_seen (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Only L); (0x8%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x8%positive, 0x4); (0x10%positive, 0x8); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-4-two-1 *)
Example suite_199 : suite_seen (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Both L); (0x4%positive, Only L); (0x8%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x3); (0x8%positive, 0x6); (0x10%positive, 0xc); (0x5%positive, 0x2); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-4-two-2 *)
Example suite_200 : suite_seen (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Both L); (0x8%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x8%positive, 0x5); (0x10%positive, 0xa); (0x9%positive, 0x4); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-right-4-all *)
Example suite_201 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf))))
  [(0x1%positive, Both R); (0x3%positive, Both R); (0x7%positive, Both R); (0xf%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x3); (0xf%positive, 0x7); (0x1f%positive, 0xf); (0x1e%positive, 0xe); (0xe%positive, 0x6); (0x6%positive, 0x2); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-right-4-first *)
Example suite_202 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf))))
  [(0x1%positive, Both R); (0x3%positive, Only R); (0x7%positive, Only R); (0xf%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x2); (0xf%positive, 0x4); (0x1f%positive, 0x8); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-right-4-two-1 *)
Example suite_203 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf))))
  [(0x1%positive, Both R); (0x3%positive, Both R); (0x7%positive, Only R); (0xf%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x3); (0xf%positive, 0x6); (0x1f%positive, 0xc); (0x6%positive, 0x2); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-right-4-two-2 *)
Example suite_204 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf))))
  [(0x1%positive, Both R); (0x3%positive, Only R); (0x7%positive, Both R); (0xf%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x2); (0xf%positive, 0x5); (0x1f%positive, 0xa); (0xe%positive, 0x4); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-turns-4-all *)
Example suite_205 : suite_seen (Node (Node Leaf (Node (Node Leaf Leaf) Leaf)) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Both R); (0x5%positive, Both L); (0xa%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x3); (0xa%positive, 0x7); (0x15%positive, 0xf); (0x14%positive, 0xe); (0xb%positive, 0x6); (0x4%positive, 0x2); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-turns-4-first *)
Example suite_206 : suite_seen (Node (Node Leaf (Node (Node Leaf Leaf) Leaf)) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only R); (0x5%positive, Only L); (0xa%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x2); (0xa%positive, 0x4); (0x15%positive, 0x8); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-turns-4-two-1 *)
Example suite_207 : suite_seen (Node (Node Leaf (Node (Node Leaf Leaf) Leaf)) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Both R); (0x5%positive, Only L); (0xa%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x3); (0xa%positive, 0x6); (0x15%positive, 0xc); (0x4%positive, 0x2); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-turns-4-two-2 *)
Example suite_208 : suite_seen (Node (Node Leaf (Node (Node Leaf Leaf) Leaf)) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only R); (0x5%positive, Both L); (0xa%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x2); (0xa%positive, 0x5); (0x15%positive, 0xa); (0xb%positive, 0x4); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-5-all *)
Example suite_209 : suite_seen (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Both L); (0x4%positive, Both L); (0x8%positive, Both L); (0x10%positive, Both L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x3); (0x8%positive, 0x7); (0x10%positive, 0xf); (0x20%positive, 0x1f); (0x21%positive, 0x1e); (0x11%positive, 0xe); (0x9%positive, 0x6); (0x5%positive, 0x2); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-5-first *)
Example suite_210 : suite_seen (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Only L); (0x8%positive, Only L); (0x10%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x8%positive, 0x4); (0x10%positive, 0x8); (0x20%positive, 0x10); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-5-two-1 *)
Example suite_211 : suite_seen (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Both L); (0x4%positive, Only L); (0x8%positive, Only L); (0x10%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x3); (0x8%positive, 0x6); (0x10%positive, 0xc); (0x20%positive, 0x18); (0x5%positive, 0x2); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-5-two-2 *)
Example suite_212 : suite_seen (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Both L); (0x8%positive, Only L); (0x10%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x8%positive, 0x5); (0x10%positive, 0xa); (0x20%positive, 0x14); (0x9%positive, 0x4); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-5-two-3 *)
Example suite_213 : suite_seen (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Only L); (0x8%positive, Both L); (0x10%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x8%positive, 0x4); (0x10%positive, 0x9); (0x20%positive, 0x12); (0x11%positive, 0x8); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-right-5-all *)
Example suite_214 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf)))))
  [(0x1%positive, Both R); (0x3%positive, Both R); (0x7%positive, Both R); (0xf%positive, Both R); (0x1f%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x3); (0xf%positive, 0x7); (0x1f%positive, 0xf); (0x3f%positive, 0x1f); (0x3e%positive, 0x1e); (0x1e%positive, 0xe); (0xe%positive, 0x6); (0x6%positive, 0x2); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-right-5-first *)
Example suite_215 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf)))))
  [(0x1%positive, Both R); (0x3%positive, Only R); (0x7%positive, Only R); (0xf%positive, Only R); (0x1f%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x2); (0xf%positive, 0x4); (0x1f%positive, 0x8); (0x3f%positive, 0x10); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-right-5-two-1 *)
Example suite_216 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf)))))
  [(0x1%positive, Both R); (0x3%positive, Both R); (0x7%positive, Only R); (0xf%positive, Only R); (0x1f%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x3); (0xf%positive, 0x6); (0x1f%positive, 0xc); (0x3f%positive, 0x18); (0x6%positive, 0x2); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-right-5-two-2 *)
Example suite_217 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf)))))
  [(0x1%positive, Both R); (0x3%positive, Only R); (0x7%positive, Both R); (0xf%positive, Only R); (0x1f%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x2); (0xf%positive, 0x5); (0x1f%positive, 0xa); (0x3f%positive, 0x14); (0xe%positive, 0x4); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-right-5-two-3 *)
Example suite_218 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf)))))
  [(0x1%positive, Both R); (0x3%positive, Only R); (0x7%positive, Only R); (0xf%positive, Both R); (0x1f%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x2); (0xf%positive, 0x4); (0x1f%positive, 0x9); (0x3f%positive, 0x12); (0x1e%positive, 0x8); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-turns-5-all *)
Example suite_219 : suite_seen (Node (Node Leaf (Node (Node Leaf (Node Leaf Leaf)) Leaf)) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Both R); (0x5%positive, Both L); (0xa%positive, Both R); (0x15%positive, Both L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x3); (0xa%positive, 0x7); (0x15%positive, 0xf); (0x2a%positive, 0x1f); (0x2b%positive, 0x1e); (0x14%positive, 0xe); (0xb%positive, 0x6); (0x4%positive, 0x2); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-turns-5-first *)
Example suite_220 : suite_seen (Node (Node Leaf (Node (Node Leaf (Node Leaf Leaf)) Leaf)) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only R); (0x5%positive, Only L); (0xa%positive, Only R); (0x15%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x2); (0xa%positive, 0x4); (0x15%positive, 0x8); (0x2a%positive, 0x10); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-turns-5-two-1 *)
Example suite_221 : suite_seen (Node (Node Leaf (Node (Node Leaf (Node Leaf Leaf)) Leaf)) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Both R); (0x5%positive, Only L); (0xa%positive, Only R); (0x15%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x3); (0xa%positive, 0x6); (0x15%positive, 0xc); (0x2a%positive, 0x18); (0x4%positive, 0x2); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-turns-5-two-2 *)
Example suite_222 : suite_seen (Node (Node Leaf (Node (Node Leaf (Node Leaf Leaf)) Leaf)) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only R); (0x5%positive, Both L); (0xa%positive, Only R); (0x15%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x2); (0xa%positive, 0x5); (0x15%positive, 0xa); (0x2a%positive, 0x14); (0xb%positive, 0x4); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-turns-5-two-3 *)
Example suite_223 : suite_seen (Node (Node Leaf (Node (Node Leaf (Node Leaf Leaf)) Leaf)) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only R); (0x5%positive, Only L); (0xa%positive, Both R); (0x15%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x2); (0xa%positive, 0x4); (0x15%positive, 0x9); (0x2a%positive, 0x12); (0x14%positive, 0x8); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-8-all *)
Example suite_224 : suite_seen (Node (Node (Node (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Both L); (0x4%positive, Both L); (0x8%positive, Both L); (0x10%positive, Both L); (0x20%positive, Both L); (0x40%positive, Both L); (0x80%positive, Both L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x3); (0x8%positive, 0x7); (0x10%positive, 0xf); (0x20%positive, 0x1f); (0x40%positive, 0x3f); (0x80%positive, 0x7f); (0x100%positive, 0xff); (0x101%positive, 0xfe); (0x81%positive, 0x7e); (0x41%positive, 0x3e); (0x21%positive, 0x1e); (0x11%positive, 0xe); (0x9%positive, 0x6); (0x5%positive, 0x2); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-8-first *)
Example suite_225 : suite_seen (Node (Node (Node (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Only L); (0x8%positive, Only L); (0x10%positive, Only L); (0x20%positive, Only L); (0x40%positive, Only L); (0x80%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x8%positive, 0x4); (0x10%positive, 0x8); (0x20%positive, 0x10); (0x40%positive, 0x20); (0x80%positive, 0x40); (0x100%positive, 0x80); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-8-two-1 *)
Example suite_226 : suite_seen (Node (Node (Node (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Both L); (0x4%positive, Only L); (0x8%positive, Only L); (0x10%positive, Only L); (0x20%positive, Only L); (0x40%positive, Only L); (0x80%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x3); (0x8%positive, 0x6); (0x10%positive, 0xc); (0x20%positive, 0x18); (0x40%positive, 0x30); (0x80%positive, 0x60); (0x100%positive, 0xc0); (0x5%positive, 0x2); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-8-two-2 *)
Example suite_227 : suite_seen (Node (Node (Node (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Both L); (0x8%positive, Only L); (0x10%positive, Only L); (0x20%positive, Only L); (0x40%positive, Only L); (0x80%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x8%positive, 0x5); (0x10%positive, 0xa); (0x20%positive, 0x14); (0x40%positive, 0x28); (0x80%positive, 0x50); (0x100%positive, 0xa0); (0x9%positive, 0x4); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-8-two-3 *)
Example suite_228 : suite_seen (Node (Node (Node (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Only L); (0x8%positive, Both L); (0x10%positive, Only L); (0x20%positive, Only L); (0x40%positive, Only L); (0x80%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x8%positive, 0x4); (0x10%positive, 0x9); (0x20%positive, 0x12); (0x40%positive, 0x24); (0x80%positive, 0x48); (0x100%positive, 0x90); (0x11%positive, 0x8); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-8-two-4 *)
Example suite_229 : suite_seen (Node (Node (Node (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Only L); (0x8%positive, Only L); (0x10%positive, Both L); (0x20%positive, Only L); (0x40%positive, Only L); (0x80%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x8%positive, 0x4); (0x10%positive, 0x8); (0x20%positive, 0x11); (0x40%positive, 0x22); (0x80%positive, 0x44); (0x100%positive, 0x88); (0x21%positive, 0x10); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-right-8-all *)
Example suite_230 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf))))))))
  [(0x1%positive, Both R); (0x3%positive, Both R); (0x7%positive, Both R); (0xf%positive, Both R); (0x1f%positive, Both R); (0x3f%positive, Both R); (0x7f%positive, Both R); (0xff%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x3); (0xf%positive, 0x7); (0x1f%positive, 0xf); (0x3f%positive, 0x1f); (0x7f%positive, 0x3f); (0xff%positive, 0x7f); (0x1ff%positive, 0xff); (0x1fe%positive, 0xfe); (0xfe%positive, 0x7e); (0x7e%positive, 0x3e); (0x3e%positive, 0x1e); (0x1e%positive, 0xe); (0xe%positive, 0x6); (0x6%positive, 0x2); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-right-8-first *)
Example suite_231 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf))))))))
  [(0x1%positive, Both R); (0x3%positive, Only R); (0x7%positive, Only R); (0xf%positive, Only R); (0x1f%positive, Only R); (0x3f%positive, Only R); (0x7f%positive, Only R); (0xff%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x2); (0xf%positive, 0x4); (0x1f%positive, 0x8); (0x3f%positive, 0x10); (0x7f%positive, 0x20); (0xff%positive, 0x40); (0x1ff%positive, 0x80); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-right-8-two-1 *)
Example suite_232 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf))))))))
  [(0x1%positive, Both R); (0x3%positive, Both R); (0x7%positive, Only R); (0xf%positive, Only R); (0x1f%positive, Only R); (0x3f%positive, Only R); (0x7f%positive, Only R); (0xff%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x3); (0xf%positive, 0x6); (0x1f%positive, 0xc); (0x3f%positive, 0x18); (0x7f%positive, 0x30); (0xff%positive, 0x60); (0x1ff%positive, 0xc0); (0x6%positive, 0x2); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-right-8-two-2 *)
Example suite_233 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf))))))))
  [(0x1%positive, Both R); (0x3%positive, Only R); (0x7%positive, Both R); (0xf%positive, Only R); (0x1f%positive, Only R); (0x3f%positive, Only R); (0x7f%positive, Only R); (0xff%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x2); (0xf%positive, 0x5); (0x1f%positive, 0xa); (0x3f%positive, 0x14); (0x7f%positive, 0x28); (0xff%positive, 0x50); (0x1ff%positive, 0xa0); (0xe%positive, 0x4); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-right-8-two-3 *)
Example suite_234 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf))))))))
  [(0x1%positive, Both R); (0x3%positive, Only R); (0x7%positive, Only R); (0xf%positive, Both R); (0x1f%positive, Only R); (0x3f%positive, Only R); (0x7f%positive, Only R); (0xff%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x2); (0xf%positive, 0x4); (0x1f%positive, 0x9); (0x3f%positive, 0x12); (0x7f%positive, 0x24); (0xff%positive, 0x48); (0x1ff%positive, 0x90); (0x1e%positive, 0x8); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-right-8-two-4 *)
Example suite_235 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf))))))))
  [(0x1%positive, Both R); (0x3%positive, Only R); (0x7%positive, Only R); (0xf%positive, Only R); (0x1f%positive, Both R); (0x3f%positive, Only R); (0x7f%positive, Only R); (0xff%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x2); (0xf%positive, 0x4); (0x1f%positive, 0x8); (0x3f%positive, 0x11); (0x7f%positive, 0x22); (0xff%positive, 0x44); (0x1ff%positive, 0x88); (0x3e%positive, 0x10); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-turns-8-all *)
Example suite_236 : suite_seen (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf Leaf) Leaf)) Leaf)) Leaf)) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Both R); (0x5%positive, Both L); (0xa%positive, Both R); (0x15%positive, Both L); (0x2a%positive, Both R); (0x55%positive, Both L); (0xaa%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x3); (0xa%positive, 0x7); (0x15%positive, 0xf); (0x2a%positive, 0x1f); (0x55%positive, 0x3f); (0xaa%positive, 0x7f); (0x155%positive, 0xff); (0x154%positive, 0xfe); (0xab%positive, 0x7e); (0x54%positive, 0x3e); (0x2b%positive, 0x1e); (0x14%positive, 0xe); (0xb%positive, 0x6); (0x4%positive, 0x2); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-turns-8-first *)
Example suite_237 : suite_seen (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf Leaf) Leaf)) Leaf)) Leaf)) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only R); (0x5%positive, Only L); (0xa%positive, Only R); (0x15%positive, Only L); (0x2a%positive, Only R); (0x55%positive, Only L); (0xaa%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x2); (0xa%positive, 0x4); (0x15%positive, 0x8); (0x2a%positive, 0x10); (0x55%positive, 0x20); (0xaa%positive, 0x40); (0x155%positive, 0x80); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-turns-8-two-1 *)
Example suite_238 : suite_seen (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf Leaf) Leaf)) Leaf)) Leaf)) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Both R); (0x5%positive, Only L); (0xa%positive, Only R); (0x15%positive, Only L); (0x2a%positive, Only R); (0x55%positive, Only L); (0xaa%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x3); (0xa%positive, 0x6); (0x15%positive, 0xc); (0x2a%positive, 0x18); (0x55%positive, 0x30); (0xaa%positive, 0x60); (0x155%positive, 0xc0); (0x4%positive, 0x2); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-turns-8-two-2 *)
Example suite_239 : suite_seen (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf Leaf) Leaf)) Leaf)) Leaf)) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only R); (0x5%positive, Both L); (0xa%positive, Only R); (0x15%positive, Only L); (0x2a%positive, Only R); (0x55%positive, Only L); (0xaa%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x2); (0xa%positive, 0x5); (0x15%positive, 0xa); (0x2a%positive, 0x14); (0x55%positive, 0x28); (0xaa%positive, 0x50); (0x155%positive, 0xa0); (0xb%positive, 0x4); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-turns-8-two-3 *)
Example suite_240 : suite_seen (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf Leaf) Leaf)) Leaf)) Leaf)) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only R); (0x5%positive, Only L); (0xa%positive, Both R); (0x15%positive, Only L); (0x2a%positive, Only R); (0x55%positive, Only L); (0xaa%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x2); (0xa%positive, 0x4); (0x15%positive, 0x9); (0x2a%positive, 0x12); (0x55%positive, 0x24); (0xaa%positive, 0x48); (0x155%positive, 0x90); (0x14%positive, 0x8); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-turns-8-two-4 *)
Example suite_241 : suite_seen (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf Leaf) Leaf)) Leaf)) Leaf)) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only R); (0x5%positive, Only L); (0xa%positive, Only R); (0x15%positive, Both L); (0x2a%positive, Only R); (0x55%positive, Only L); (0xaa%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x2); (0xa%positive, 0x4); (0x15%positive, 0x8); (0x2a%positive, 0x11); (0x55%positive, 0x22); (0xaa%positive, 0x44); (0x155%positive, 0x88); (0x2b%positive, 0x10); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-16-all *)
Example suite_242 : suite_seen (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Both L); (0x4%positive, Both L); (0x8%positive, Both L); (0x10%positive, Both L); (0x20%positive, Both L); (0x40%positive, Both L); (0x80%positive, Both L); (0x100%positive, Both L); (0x200%positive, Both L); (0x400%positive, Both L); (0x800%positive, Both L); (0x1000%positive, Both L); (0x2000%positive, Both L); (0x4000%positive, Both L); (0x8000%positive, Both L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x3); (0x8%positive, 0x7); (0x10%positive, 0xf); (0x20%positive, 0x1f); (0x40%positive, 0x3f); (0x80%positive, 0x7f); (0x100%positive, 0xff); (0x200%positive, 0x1ff); (0x400%positive, 0x3ff); (0x800%positive, 0x7ff); (0x1000%positive, 0xfff); (0x2000%positive, 0x1fff); (0x4000%positive, 0x3fff); (0x8000%positive, 0x7fff); (0x10000%positive, 0xffff); (0x10001%positive, 0xfffe); (0x8001%positive, 0x7ffe); (0x4001%positive, 0x3ffe); (0x2001%positive, 0x1ffe); (0x1001%positive, 0xffe); (0x801%positive, 0x7fe); (0x401%positive, 0x3fe); (0x201%positive, 0x1fe); (0x101%positive, 0xfe); (0x81%positive, 0x7e); (0x41%positive, 0x3e); (0x21%positive, 0x1e); (0x11%positive, 0xe); (0x9%positive, 0x6); (0x5%positive, 0x2); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-16-first *)
Example suite_243 : suite_seen (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Only L); (0x8%positive, Only L); (0x10%positive, Only L); (0x20%positive, Only L); (0x40%positive, Only L); (0x80%positive, Only L); (0x100%positive, Only L); (0x200%positive, Only L); (0x400%positive, Only L); (0x800%positive, Only L); (0x1000%positive, Only L); (0x2000%positive, Only L); (0x4000%positive, Only L); (0x8000%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x8%positive, 0x4); (0x10%positive, 0x8); (0x20%positive, 0x10); (0x40%positive, 0x20); (0x80%positive, 0x40); (0x100%positive, 0x80); (0x200%positive, 0x100); (0x400%positive, 0x200); (0x800%positive, 0x400); (0x1000%positive, 0x800); (0x2000%positive, 0x1000); (0x4000%positive, 0x2000); (0x8000%positive, 0x4000); (0x10000%positive, 0x8000); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-16-two-1 *)
Example suite_244 : suite_seen (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Both L); (0x4%positive, Only L); (0x8%positive, Only L); (0x10%positive, Only L); (0x20%positive, Only L); (0x40%positive, Only L); (0x80%positive, Only L); (0x100%positive, Only L); (0x200%positive, Only L); (0x400%positive, Only L); (0x800%positive, Only L); (0x1000%positive, Only L); (0x2000%positive, Only L); (0x4000%positive, Only L); (0x8000%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x3); (0x8%positive, 0x6); (0x10%positive, 0xc); (0x20%positive, 0x18); (0x40%positive, 0x30); (0x80%positive, 0x60); (0x100%positive, 0xc0); (0x200%positive, 0x180); (0x400%positive, 0x300); (0x800%positive, 0x600); (0x1000%positive, 0xc00); (0x2000%positive, 0x1800); (0x4000%positive, 0x3000); (0x8000%positive, 0x6000); (0x10000%positive, 0xc000); (0x5%positive, 0x2); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-16-two-2 *)
Example suite_245 : suite_seen (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Both L); (0x8%positive, Only L); (0x10%positive, Only L); (0x20%positive, Only L); (0x40%positive, Only L); (0x80%positive, Only L); (0x100%positive, Only L); (0x200%positive, Only L); (0x400%positive, Only L); (0x800%positive, Only L); (0x1000%positive, Only L); (0x2000%positive, Only L); (0x4000%positive, Only L); (0x8000%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x8%positive, 0x5); (0x10%positive, 0xa); (0x20%positive, 0x14); (0x40%positive, 0x28); (0x80%positive, 0x50); (0x100%positive, 0xa0); (0x200%positive, 0x140); (0x400%positive, 0x280); (0x800%positive, 0x500); (0x1000%positive, 0xa00); (0x2000%positive, 0x1400); (0x4000%positive, 0x2800); (0x8000%positive, 0x5000); (0x10000%positive, 0xa000); (0x9%positive, 0x4); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-16-two-3 *)
Example suite_246 : suite_seen (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Only L); (0x8%positive, Both L); (0x10%positive, Only L); (0x20%positive, Only L); (0x40%positive, Only L); (0x80%positive, Only L); (0x100%positive, Only L); (0x200%positive, Only L); (0x400%positive, Only L); (0x800%positive, Only L); (0x1000%positive, Only L); (0x2000%positive, Only L); (0x4000%positive, Only L); (0x8000%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x8%positive, 0x4); (0x10%positive, 0x9); (0x20%positive, 0x12); (0x40%positive, 0x24); (0x80%positive, 0x48); (0x100%positive, 0x90); (0x200%positive, 0x120); (0x400%positive, 0x240); (0x800%positive, 0x480); (0x1000%positive, 0x900); (0x2000%positive, 0x1200); (0x4000%positive, 0x2400); (0x8000%positive, 0x4800); (0x10000%positive, 0x9000); (0x11%positive, 0x8); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-16-two-4 *)
Example suite_247 : suite_seen (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Only L); (0x8%positive, Only L); (0x10%positive, Both L); (0x20%positive, Only L); (0x40%positive, Only L); (0x80%positive, Only L); (0x100%positive, Only L); (0x200%positive, Only L); (0x400%positive, Only L); (0x800%positive, Only L); (0x1000%positive, Only L); (0x2000%positive, Only L); (0x4000%positive, Only L); (0x8000%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x8%positive, 0x4); (0x10%positive, 0x8); (0x20%positive, 0x11); (0x40%positive, 0x22); (0x80%positive, 0x44); (0x100%positive, 0x88); (0x200%positive, 0x110); (0x400%positive, 0x220); (0x800%positive, 0x440); (0x1000%positive, 0x880); (0x2000%positive, 0x1100); (0x4000%positive, 0x2200); (0x8000%positive, 0x4400); (0x10000%positive, 0x8800); (0x21%positive, 0x10); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-16-two-8 *)
Example suite_248 : suite_seen (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Only L); (0x8%positive, Only L); (0x10%positive, Only L); (0x20%positive, Only L); (0x40%positive, Only L); (0x80%positive, Only L); (0x100%positive, Both L); (0x200%positive, Only L); (0x400%positive, Only L); (0x800%positive, Only L); (0x1000%positive, Only L); (0x2000%positive, Only L); (0x4000%positive, Only L); (0x8000%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x8%positive, 0x4); (0x10%positive, 0x8); (0x20%positive, 0x10); (0x40%positive, 0x20); (0x80%positive, 0x40); (0x100%positive, 0x80); (0x200%positive, 0x101); (0x400%positive, 0x202); (0x800%positive, 0x404); (0x1000%positive, 0x808); (0x2000%positive, 0x1010); (0x4000%positive, 0x2020); (0x8000%positive, 0x4040); (0x10000%positive, 0x8080); (0x201%positive, 0x100); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-right-16-all *)
Example suite_249 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf))))))))))))))))
  [(0x1%positive, Both R); (0x3%positive, Both R); (0x7%positive, Both R); (0xf%positive, Both R); (0x1f%positive, Both R); (0x3f%positive, Both R); (0x7f%positive, Both R); (0xff%positive, Both R); (0x1ff%positive, Both R); (0x3ff%positive, Both R); (0x7ff%positive, Both R); (0xfff%positive, Both R); (0x1fff%positive, Both R); (0x3fff%positive, Both R); (0x7fff%positive, Both R); (0xffff%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x3); (0xf%positive, 0x7); (0x1f%positive, 0xf); (0x3f%positive, 0x1f); (0x7f%positive, 0x3f); (0xff%positive, 0x7f); (0x1ff%positive, 0xff); (0x3ff%positive, 0x1ff); (0x7ff%positive, 0x3ff); (0xfff%positive, 0x7ff); (0x1fff%positive, 0xfff); (0x3fff%positive, 0x1fff); (0x7fff%positive, 0x3fff); (0xffff%positive, 0x7fff); (0x1ffff%positive, 0xffff); (0x1fffe%positive, 0xfffe); (0xfffe%positive, 0x7ffe); (0x7ffe%positive, 0x3ffe); (0x3ffe%positive, 0x1ffe); (0x1ffe%positive, 0xffe); (0xffe%positive, 0x7fe); (0x7fe%positive, 0x3fe); (0x3fe%positive, 0x1fe); (0x1fe%positive, 0xfe); (0xfe%positive, 0x7e); (0x7e%positive, 0x3e); (0x3e%positive, 0x1e); (0x1e%positive, 0xe); (0xe%positive, 0x6); (0x6%positive, 0x2); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-right-16-first *)
Example suite_250 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf))))))))))))))))
  [(0x1%positive, Both R); (0x3%positive, Only R); (0x7%positive, Only R); (0xf%positive, Only R); (0x1f%positive, Only R); (0x3f%positive, Only R); (0x7f%positive, Only R); (0xff%positive, Only R); (0x1ff%positive, Only R); (0x3ff%positive, Only R); (0x7ff%positive, Only R); (0xfff%positive, Only R); (0x1fff%positive, Only R); (0x3fff%positive, Only R); (0x7fff%positive, Only R); (0xffff%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x2); (0xf%positive, 0x4); (0x1f%positive, 0x8); (0x3f%positive, 0x10); (0x7f%positive, 0x20); (0xff%positive, 0x40); (0x1ff%positive, 0x80); (0x3ff%positive, 0x100); (0x7ff%positive, 0x200); (0xfff%positive, 0x400); (0x1fff%positive, 0x800); (0x3fff%positive, 0x1000); (0x7fff%positive, 0x2000); (0xffff%positive, 0x4000); (0x1ffff%positive, 0x8000); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-right-16-two-1 *)
Example suite_251 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf))))))))))))))))
  [(0x1%positive, Both R); (0x3%positive, Both R); (0x7%positive, Only R); (0xf%positive, Only R); (0x1f%positive, Only R); (0x3f%positive, Only R); (0x7f%positive, Only R); (0xff%positive, Only R); (0x1ff%positive, Only R); (0x3ff%positive, Only R); (0x7ff%positive, Only R); (0xfff%positive, Only R); (0x1fff%positive, Only R); (0x3fff%positive, Only R); (0x7fff%positive, Only R); (0xffff%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x3); (0xf%positive, 0x6); (0x1f%positive, 0xc); (0x3f%positive, 0x18); (0x7f%positive, 0x30); (0xff%positive, 0x60); (0x1ff%positive, 0xc0); (0x3ff%positive, 0x180); (0x7ff%positive, 0x300); (0xfff%positive, 0x600); (0x1fff%positive, 0xc00); (0x3fff%positive, 0x1800); (0x7fff%positive, 0x3000); (0xffff%positive, 0x6000); (0x1ffff%positive, 0xc000); (0x6%positive, 0x2); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-right-16-two-2 *)
Example suite_252 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf))))))))))))))))
  [(0x1%positive, Both R); (0x3%positive, Only R); (0x7%positive, Both R); (0xf%positive, Only R); (0x1f%positive, Only R); (0x3f%positive, Only R); (0x7f%positive, Only R); (0xff%positive, Only R); (0x1ff%positive, Only R); (0x3ff%positive, Only R); (0x7ff%positive, Only R); (0xfff%positive, Only R); (0x1fff%positive, Only R); (0x3fff%positive, Only R); (0x7fff%positive, Only R); (0xffff%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x2); (0xf%positive, 0x5); (0x1f%positive, 0xa); (0x3f%positive, 0x14); (0x7f%positive, 0x28); (0xff%positive, 0x50); (0x1ff%positive, 0xa0); (0x3ff%positive, 0x140); (0x7ff%positive, 0x280); (0xfff%positive, 0x500); (0x1fff%positive, 0xa00); (0x3fff%positive, 0x1400); (0x7fff%positive, 0x2800); (0xffff%positive, 0x5000); (0x1ffff%positive, 0xa000); (0xe%positive, 0x4); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-right-16-two-3 *)
Example suite_253 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf))))))))))))))))
  [(0x1%positive, Both R); (0x3%positive, Only R); (0x7%positive, Only R); (0xf%positive, Both R); (0x1f%positive, Only R); (0x3f%positive, Only R); (0x7f%positive, Only R); (0xff%positive, Only R); (0x1ff%positive, Only R); (0x3ff%positive, Only R); (0x7ff%positive, Only R); (0xfff%positive, Only R); (0x1fff%positive, Only R); (0x3fff%positive, Only R); (0x7fff%positive, Only R); (0xffff%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x2); (0xf%positive, 0x4); (0x1f%positive, 0x9); (0x3f%positive, 0x12); (0x7f%positive, 0x24); (0xff%positive, 0x48); (0x1ff%positive, 0x90); (0x3ff%positive, 0x120); (0x7ff%positive, 0x240); (0xfff%positive, 0x480); (0x1fff%positive, 0x900); (0x3fff%positive, 0x1200); (0x7fff%positive, 0x2400); (0xffff%positive, 0x4800); (0x1ffff%positive, 0x9000); (0x1e%positive, 0x8); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-right-16-two-4 *)
Example suite_254 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf))))))))))))))))
  [(0x1%positive, Both R); (0x3%positive, Only R); (0x7%positive, Only R); (0xf%positive, Only R); (0x1f%positive, Both R); (0x3f%positive, Only R); (0x7f%positive, Only R); (0xff%positive, Only R); (0x1ff%positive, Only R); (0x3ff%positive, Only R); (0x7ff%positive, Only R); (0xfff%positive, Only R); (0x1fff%positive, Only R); (0x3fff%positive, Only R); (0x7fff%positive, Only R); (0xffff%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x2); (0xf%positive, 0x4); (0x1f%positive, 0x8); (0x3f%positive, 0x11); (0x7f%positive, 0x22); (0xff%positive, 0x44); (0x1ff%positive, 0x88); (0x3ff%positive, 0x110); (0x7ff%positive, 0x220); (0xfff%positive, 0x440); (0x1fff%positive, 0x880); (0x3fff%positive, 0x1100); (0x7fff%positive, 0x2200); (0xffff%positive, 0x4400); (0x1ffff%positive, 0x8800); (0x3e%positive, 0x10); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-right-16-two-8 *)
Example suite_255 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf))))))))))))))))
  [(0x1%positive, Both R); (0x3%positive, Only R); (0x7%positive, Only R); (0xf%positive, Only R); (0x1f%positive, Only R); (0x3f%positive, Only R); (0x7f%positive, Only R); (0xff%positive, Only R); (0x1ff%positive, Both R); (0x3ff%positive, Only R); (0x7ff%positive, Only R); (0xfff%positive, Only R); (0x1fff%positive, Only R); (0x3fff%positive, Only R); (0x7fff%positive, Only R); (0xffff%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x2); (0xf%positive, 0x4); (0x1f%positive, 0x8); (0x3f%positive, 0x10); (0x7f%positive, 0x20); (0xff%positive, 0x40); (0x1ff%positive, 0x80); (0x3ff%positive, 0x101); (0x7ff%positive, 0x202); (0xfff%positive, 0x404); (0x1fff%positive, 0x808); (0x3fff%positive, 0x1010); (0x7fff%positive, 0x2020); (0xffff%positive, 0x4040); (0x1ffff%positive, 0x8080); (0x3fe%positive, 0x100); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-turns-16-all *)
Example suite_256 : suite_seen (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf Leaf) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Both R); (0x5%positive, Both L); (0xa%positive, Both R); (0x15%positive, Both L); (0x2a%positive, Both R); (0x55%positive, Both L); (0xaa%positive, Both R); (0x155%positive, Both L); (0x2aa%positive, Both R); (0x555%positive, Both L); (0xaaa%positive, Both R); (0x1555%positive, Both L); (0x2aaa%positive, Both R); (0x5555%positive, Both L); (0xaaaa%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x3); (0xa%positive, 0x7); (0x15%positive, 0xf); (0x2a%positive, 0x1f); (0x55%positive, 0x3f); (0xaa%positive, 0x7f); (0x155%positive, 0xff); (0x2aa%positive, 0x1ff); (0x555%positive, 0x3ff); (0xaaa%positive, 0x7ff); (0x1555%positive, 0xfff); (0x2aaa%positive, 0x1fff); (0x5555%positive, 0x3fff); (0xaaaa%positive, 0x7fff); (0x15555%positive, 0xffff); (0x15554%positive, 0xfffe); (0xaaab%positive, 0x7ffe); (0x5554%positive, 0x3ffe); (0x2aab%positive, 0x1ffe); (0x1554%positive, 0xffe); (0xaab%positive, 0x7fe); (0x554%positive, 0x3fe); (0x2ab%positive, 0x1fe); (0x154%positive, 0xfe); (0xab%positive, 0x7e); (0x54%positive, 0x3e); (0x2b%positive, 0x1e); (0x14%positive, 0xe); (0xb%positive, 0x6); (0x4%positive, 0x2); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-turns-16-first *)
Example suite_257 : suite_seen (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf Leaf) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only R); (0x5%positive, Only L); (0xa%positive, Only R); (0x15%positive, Only L); (0x2a%positive, Only R); (0x55%positive, Only L); (0xaa%positive, Only R); (0x155%positive, Only L); (0x2aa%positive, Only R); (0x555%positive, Only L); (0xaaa%positive, Only R); (0x1555%positive, Only L); (0x2aaa%positive, Only R); (0x5555%positive, Only L); (0xaaaa%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x2); (0xa%positive, 0x4); (0x15%positive, 0x8); (0x2a%positive, 0x10); (0x55%positive, 0x20); (0xaa%positive, 0x40); (0x155%positive, 0x80); (0x2aa%positive, 0x100); (0x555%positive, 0x200); (0xaaa%positive, 0x400); (0x1555%positive, 0x800); (0x2aaa%positive, 0x1000); (0x5555%positive, 0x2000); (0xaaaa%positive, 0x4000); (0x15555%positive, 0x8000); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-turns-16-two-1 *)
Example suite_258 : suite_seen (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf Leaf) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Both R); (0x5%positive, Only L); (0xa%positive, Only R); (0x15%positive, Only L); (0x2a%positive, Only R); (0x55%positive, Only L); (0xaa%positive, Only R); (0x155%positive, Only L); (0x2aa%positive, Only R); (0x555%positive, Only L); (0xaaa%positive, Only R); (0x1555%positive, Only L); (0x2aaa%positive, Only R); (0x5555%positive, Only L); (0xaaaa%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x3); (0xa%positive, 0x6); (0x15%positive, 0xc); (0x2a%positive, 0x18); (0x55%positive, 0x30); (0xaa%positive, 0x60); (0x155%positive, 0xc0); (0x2aa%positive, 0x180); (0x555%positive, 0x300); (0xaaa%positive, 0x600); (0x1555%positive, 0xc00); (0x2aaa%positive, 0x1800); (0x5555%positive, 0x3000); (0xaaaa%positive, 0x6000); (0x15555%positive, 0xc000); (0x4%positive, 0x2); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-turns-16-two-2 *)
Example suite_259 : suite_seen (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf Leaf) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only R); (0x5%positive, Both L); (0xa%positive, Only R); (0x15%positive, Only L); (0x2a%positive, Only R); (0x55%positive, Only L); (0xaa%positive, Only R); (0x155%positive, Only L); (0x2aa%positive, Only R); (0x555%positive, Only L); (0xaaa%positive, Only R); (0x1555%positive, Only L); (0x2aaa%positive, Only R); (0x5555%positive, Only L); (0xaaaa%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x2); (0xa%positive, 0x5); (0x15%positive, 0xa); (0x2a%positive, 0x14); (0x55%positive, 0x28); (0xaa%positive, 0x50); (0x155%positive, 0xa0); (0x2aa%positive, 0x140); (0x555%positive, 0x280); (0xaaa%positive, 0x500); (0x1555%positive, 0xa00); (0x2aaa%positive, 0x1400); (0x5555%positive, 0x2800); (0xaaaa%positive, 0x5000); (0x15555%positive, 0xa000); (0xb%positive, 0x4); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-turns-16-two-3 *)
Example suite_260 : suite_seen (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf Leaf) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only R); (0x5%positive, Only L); (0xa%positive, Both R); (0x15%positive, Only L); (0x2a%positive, Only R); (0x55%positive, Only L); (0xaa%positive, Only R); (0x155%positive, Only L); (0x2aa%positive, Only R); (0x555%positive, Only L); (0xaaa%positive, Only R); (0x1555%positive, Only L); (0x2aaa%positive, Only R); (0x5555%positive, Only L); (0xaaaa%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x2); (0xa%positive, 0x4); (0x15%positive, 0x9); (0x2a%positive, 0x12); (0x55%positive, 0x24); (0xaa%positive, 0x48); (0x155%positive, 0x90); (0x2aa%positive, 0x120); (0x555%positive, 0x240); (0xaaa%positive, 0x480); (0x1555%positive, 0x900); (0x2aaa%positive, 0x1200); (0x5555%positive, 0x2400); (0xaaaa%positive, 0x4800); (0x15555%positive, 0x9000); (0x14%positive, 0x8); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-turns-16-two-4 *)
Example suite_261 : suite_seen (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf Leaf) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only R); (0x5%positive, Only L); (0xa%positive, Only R); (0x15%positive, Both L); (0x2a%positive, Only R); (0x55%positive, Only L); (0xaa%positive, Only R); (0x155%positive, Only L); (0x2aa%positive, Only R); (0x555%positive, Only L); (0xaaa%positive, Only R); (0x1555%positive, Only L); (0x2aaa%positive, Only R); (0x5555%positive, Only L); (0xaaaa%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x2); (0xa%positive, 0x4); (0x15%positive, 0x8); (0x2a%positive, 0x11); (0x55%positive, 0x22); (0xaa%positive, 0x44); (0x155%positive, 0x88); (0x2aa%positive, 0x110); (0x555%positive, 0x220); (0xaaa%positive, 0x440); (0x1555%positive, 0x880); (0x2aaa%positive, 0x1100); (0x5555%positive, 0x2200); (0xaaaa%positive, 0x4400); (0x15555%positive, 0x8800); (0x2b%positive, 0x10); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-turns-16-two-8 *)
Example suite_262 : suite_seen (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf Leaf) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only R); (0x5%positive, Only L); (0xa%positive, Only R); (0x15%positive, Only L); (0x2a%positive, Only R); (0x55%positive, Only L); (0xaa%positive, Only R); (0x155%positive, Both L); (0x2aa%positive, Only R); (0x555%positive, Only L); (0xaaa%positive, Only R); (0x1555%positive, Only L); (0x2aaa%positive, Only R); (0x5555%positive, Only L); (0xaaaa%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x2); (0xa%positive, 0x4); (0x15%positive, 0x8); (0x2a%positive, 0x10); (0x55%positive, 0x20); (0xaa%positive, 0x40); (0x155%positive, 0x80); (0x2aa%positive, 0x101); (0x555%positive, 0x202); (0xaaa%positive, 0x404); (0x1555%positive, 0x808); (0x2aaa%positive, 0x1010); (0x5555%positive, 0x2020); (0xaaaa%positive, 0x4040); (0x15555%positive, 0x8080); (0x2ab%positive, 0x100); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-30-all *)
Example suite_263 : suite_seen (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Both L); (0x4%positive, Both L); (0x8%positive, Both L); (0x10%positive, Both L); (0x20%positive, Both L); (0x40%positive, Both L); (0x80%positive, Both L); (0x100%positive, Both L); (0x200%positive, Both L); (0x400%positive, Both L); (0x800%positive, Both L); (0x1000%positive, Both L); (0x2000%positive, Both L); (0x4000%positive, Both L); (0x8000%positive, Both L); (0x10000%positive, Both L); (0x20000%positive, Both L); (0x40000%positive, Both L); (0x80000%positive, Both L); (0x100000%positive, Both L); (0x200000%positive, Both L); (0x400000%positive, Both L); (0x800000%positive, Both L); (0x1000000%positive, Both L); (0x2000000%positive, Both L); (0x4000000%positive, Both L); (0x8000000%positive, Both L); (0x10000000%positive, Both L); (0x20000000%positive, Both L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x3); (0x8%positive, 0x7); (0x10%positive, 0xf); (0x20%positive, 0x1f); (0x40%positive, 0x3f); (0x80%positive, 0x7f); (0x100%positive, 0xff); (0x200%positive, 0x1ff); (0x400%positive, 0x3ff); (0x800%positive, 0x7ff); (0x1000%positive, 0xfff); (0x2000%positive, 0x1fff); (0x4000%positive, 0x3fff); (0x8000%positive, 0x7fff); (0x10000%positive, 0xffff); (0x20000%positive, 0x1ffff); (0x40000%positive, 0x3ffff); (0x80000%positive, 0x7ffff); (0x100000%positive, 0xfffff); (0x200000%positive, 0x1fffff); (0x400000%positive, 0x3fffff); (0x800000%positive, 0x7fffff); (0x1000000%positive, 0xffffff); (0x2000000%positive, 0x1ffffff); (0x4000000%positive, 0x3ffffff); (0x8000000%positive, 0x7ffffff); (0x10000000%positive, 0xfffffff); (0x20000000%positive, 0x1fffffff); (0x40000000%positive, 0x3fffffff); (0x40000001%positive, 0x3ffffffe); (0x20000001%positive, 0x1ffffffe); (0x10000001%positive, 0xffffffe); (0x8000001%positive, 0x7fffffe); (0x4000001%positive, 0x3fffffe); (0x2000001%positive, 0x1fffffe); (0x1000001%positive, 0xfffffe); (0x800001%positive, 0x7ffffe); (0x400001%positive, 0x3ffffe); (0x200001%positive, 0x1ffffe); (0x100001%positive, 0xffffe); (0x80001%positive, 0x7fffe); (0x40001%positive, 0x3fffe); (0x20001%positive, 0x1fffe); (0x10001%positive, 0xfffe); (0x8001%positive, 0x7ffe); (0x4001%positive, 0x3ffe); (0x2001%positive, 0x1ffe); (0x1001%positive, 0xffe); (0x801%positive, 0x7fe); (0x401%positive, 0x3fe); (0x201%positive, 0x1fe); (0x101%positive, 0xfe); (0x81%positive, 0x7e); (0x41%positive, 0x3e); (0x21%positive, 0x1e); (0x11%positive, 0xe); (0x9%positive, 0x6); (0x5%positive, 0x2); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-30-first *)
Example suite_264 : suite_seen (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Only L); (0x8%positive, Only L); (0x10%positive, Only L); (0x20%positive, Only L); (0x40%positive, Only L); (0x80%positive, Only L); (0x100%positive, Only L); (0x200%positive, Only L); (0x400%positive, Only L); (0x800%positive, Only L); (0x1000%positive, Only L); (0x2000%positive, Only L); (0x4000%positive, Only L); (0x8000%positive, Only L); (0x10000%positive, Only L); (0x20000%positive, Only L); (0x40000%positive, Only L); (0x80000%positive, Only L); (0x100000%positive, Only L); (0x200000%positive, Only L); (0x400000%positive, Only L); (0x800000%positive, Only L); (0x1000000%positive, Only L); (0x2000000%positive, Only L); (0x4000000%positive, Only L); (0x8000000%positive, Only L); (0x10000000%positive, Only L); (0x20000000%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x8%positive, 0x4); (0x10%positive, 0x8); (0x20%positive, 0x10); (0x40%positive, 0x20); (0x80%positive, 0x40); (0x100%positive, 0x80); (0x200%positive, 0x100); (0x400%positive, 0x200); (0x800%positive, 0x400); (0x1000%positive, 0x800); (0x2000%positive, 0x1000); (0x4000%positive, 0x2000); (0x8000%positive, 0x4000); (0x10000%positive, 0x8000); (0x20000%positive, 0x10000); (0x40000%positive, 0x20000); (0x80000%positive, 0x40000); (0x100000%positive, 0x80000); (0x200000%positive, 0x100000); (0x400000%positive, 0x200000); (0x800000%positive, 0x400000); (0x1000000%positive, 0x800000); (0x2000000%positive, 0x1000000); (0x4000000%positive, 0x2000000); (0x8000000%positive, 0x4000000); (0x10000000%positive, 0x8000000); (0x20000000%positive, 0x10000000); (0x40000000%positive, 0x20000000); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-30-two-1 *)
Example suite_265 : suite_seen (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Both L); (0x4%positive, Only L); (0x8%positive, Only L); (0x10%positive, Only L); (0x20%positive, Only L); (0x40%positive, Only L); (0x80%positive, Only L); (0x100%positive, Only L); (0x200%positive, Only L); (0x400%positive, Only L); (0x800%positive, Only L); (0x1000%positive, Only L); (0x2000%positive, Only L); (0x4000%positive, Only L); (0x8000%positive, Only L); (0x10000%positive, Only L); (0x20000%positive, Only L); (0x40000%positive, Only L); (0x80000%positive, Only L); (0x100000%positive, Only L); (0x200000%positive, Only L); (0x400000%positive, Only L); (0x800000%positive, Only L); (0x1000000%positive, Only L); (0x2000000%positive, Only L); (0x4000000%positive, Only L); (0x8000000%positive, Only L); (0x10000000%positive, Only L); (0x20000000%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x3); (0x8%positive, 0x6); (0x10%positive, 0xc); (0x20%positive, 0x18); (0x40%positive, 0x30); (0x80%positive, 0x60); (0x100%positive, 0xc0); (0x200%positive, 0x180); (0x400%positive, 0x300); (0x800%positive, 0x600); (0x1000%positive, 0xc00); (0x2000%positive, 0x1800); (0x4000%positive, 0x3000); (0x8000%positive, 0x6000); (0x10000%positive, 0xc000); (0x20000%positive, 0x18000); (0x40000%positive, 0x30000); (0x80000%positive, 0x60000); (0x100000%positive, 0xc0000); (0x200000%positive, 0x180000); (0x400000%positive, 0x300000); (0x800000%positive, 0x600000); (0x1000000%positive, 0xc00000); (0x2000000%positive, 0x1800000); (0x4000000%positive, 0x3000000); (0x8000000%positive, 0x6000000); (0x10000000%positive, 0xc000000); (0x20000000%positive, 0x18000000); (0x40000000%positive, 0x30000000); (0x5%positive, 0x2); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-30-two-2 *)
Example suite_266 : suite_seen (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Both L); (0x8%positive, Only L); (0x10%positive, Only L); (0x20%positive, Only L); (0x40%positive, Only L); (0x80%positive, Only L); (0x100%positive, Only L); (0x200%positive, Only L); (0x400%positive, Only L); (0x800%positive, Only L); (0x1000%positive, Only L); (0x2000%positive, Only L); (0x4000%positive, Only L); (0x8000%positive, Only L); (0x10000%positive, Only L); (0x20000%positive, Only L); (0x40000%positive, Only L); (0x80000%positive, Only L); (0x100000%positive, Only L); (0x200000%positive, Only L); (0x400000%positive, Only L); (0x800000%positive, Only L); (0x1000000%positive, Only L); (0x2000000%positive, Only L); (0x4000000%positive, Only L); (0x8000000%positive, Only L); (0x10000000%positive, Only L); (0x20000000%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x8%positive, 0x5); (0x10%positive, 0xa); (0x20%positive, 0x14); (0x40%positive, 0x28); (0x80%positive, 0x50); (0x100%positive, 0xa0); (0x200%positive, 0x140); (0x400%positive, 0x280); (0x800%positive, 0x500); (0x1000%positive, 0xa00); (0x2000%positive, 0x1400); (0x4000%positive, 0x2800); (0x8000%positive, 0x5000); (0x10000%positive, 0xa000); (0x20000%positive, 0x14000); (0x40000%positive, 0x28000); (0x80000%positive, 0x50000); (0x100000%positive, 0xa0000); (0x200000%positive, 0x140000); (0x400000%positive, 0x280000); (0x800000%positive, 0x500000); (0x1000000%positive, 0xa00000); (0x2000000%positive, 0x1400000); (0x4000000%positive, 0x2800000); (0x8000000%positive, 0x5000000); (0x10000000%positive, 0xa000000); (0x20000000%positive, 0x14000000); (0x40000000%positive, 0x28000000); (0x9%positive, 0x4); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-30-two-3 *)
Example suite_267 : suite_seen (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Only L); (0x8%positive, Both L); (0x10%positive, Only L); (0x20%positive, Only L); (0x40%positive, Only L); (0x80%positive, Only L); (0x100%positive, Only L); (0x200%positive, Only L); (0x400%positive, Only L); (0x800%positive, Only L); (0x1000%positive, Only L); (0x2000%positive, Only L); (0x4000%positive, Only L); (0x8000%positive, Only L); (0x10000%positive, Only L); (0x20000%positive, Only L); (0x40000%positive, Only L); (0x80000%positive, Only L); (0x100000%positive, Only L); (0x200000%positive, Only L); (0x400000%positive, Only L); (0x800000%positive, Only L); (0x1000000%positive, Only L); (0x2000000%positive, Only L); (0x4000000%positive, Only L); (0x8000000%positive, Only L); (0x10000000%positive, Only L); (0x20000000%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x8%positive, 0x4); (0x10%positive, 0x9); (0x20%positive, 0x12); (0x40%positive, 0x24); (0x80%positive, 0x48); (0x100%positive, 0x90); (0x200%positive, 0x120); (0x400%positive, 0x240); (0x800%positive, 0x480); (0x1000%positive, 0x900); (0x2000%positive, 0x1200); (0x4000%positive, 0x2400); (0x8000%positive, 0x4800); (0x10000%positive, 0x9000); (0x20000%positive, 0x12000); (0x40000%positive, 0x24000); (0x80000%positive, 0x48000); (0x100000%positive, 0x90000); (0x200000%positive, 0x120000); (0x400000%positive, 0x240000); (0x800000%positive, 0x480000); (0x1000000%positive, 0x900000); (0x2000000%positive, 0x1200000); (0x4000000%positive, 0x2400000); (0x8000000%positive, 0x4800000); (0x10000000%positive, 0x9000000); (0x20000000%positive, 0x12000000); (0x40000000%positive, 0x24000000); (0x11%positive, 0x8); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-30-two-4 *)
Example suite_268 : suite_seen (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Only L); (0x8%positive, Only L); (0x10%positive, Both L); (0x20%positive, Only L); (0x40%positive, Only L); (0x80%positive, Only L); (0x100%positive, Only L); (0x200%positive, Only L); (0x400%positive, Only L); (0x800%positive, Only L); (0x1000%positive, Only L); (0x2000%positive, Only L); (0x4000%positive, Only L); (0x8000%positive, Only L); (0x10000%positive, Only L); (0x20000%positive, Only L); (0x40000%positive, Only L); (0x80000%positive, Only L); (0x100000%positive, Only L); (0x200000%positive, Only L); (0x400000%positive, Only L); (0x800000%positive, Only L); (0x1000000%positive, Only L); (0x2000000%positive, Only L); (0x4000000%positive, Only L); (0x8000000%positive, Only L); (0x10000000%positive, Only L); (0x20000000%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x8%positive, 0x4); (0x10%positive, 0x8); (0x20%positive, 0x11); (0x40%positive, 0x22); (0x80%positive, 0x44); (0x100%positive, 0x88); (0x200%positive, 0x110); (0x400%positive, 0x220); (0x800%positive, 0x440); (0x1000%positive, 0x880); (0x2000%positive, 0x1100); (0x4000%positive, 0x2200); (0x8000%positive, 0x4400); (0x10000%positive, 0x8800); (0x20000%positive, 0x11000); (0x40000%positive, 0x22000); (0x80000%positive, 0x44000); (0x100000%positive, 0x88000); (0x200000%positive, 0x110000); (0x400000%positive, 0x220000); (0x800000%positive, 0x440000); (0x1000000%positive, 0x880000); (0x2000000%positive, 0x1100000); (0x4000000%positive, 0x2200000); (0x8000000%positive, 0x4400000); (0x10000000%positive, 0x8800000); (0x20000000%positive, 0x11000000); (0x40000000%positive, 0x22000000); (0x21%positive, 0x10); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-30-two-15 *)
Example suite_269 : suite_seen (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Only L); (0x8%positive, Only L); (0x10%positive, Only L); (0x20%positive, Only L); (0x40%positive, Only L); (0x80%positive, Only L); (0x100%positive, Only L); (0x200%positive, Only L); (0x400%positive, Only L); (0x800%positive, Only L); (0x1000%positive, Only L); (0x2000%positive, Only L); (0x4000%positive, Only L); (0x8000%positive, Both L); (0x10000%positive, Only L); (0x20000%positive, Only L); (0x40000%positive, Only L); (0x80000%positive, Only L); (0x100000%positive, Only L); (0x200000%positive, Only L); (0x400000%positive, Only L); (0x800000%positive, Only L); (0x1000000%positive, Only L); (0x2000000%positive, Only L); (0x4000000%positive, Only L); (0x8000000%positive, Only L); (0x10000000%positive, Only L); (0x20000000%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x8%positive, 0x4); (0x10%positive, 0x8); (0x20%positive, 0x10); (0x40%positive, 0x20); (0x80%positive, 0x40); (0x100%positive, 0x80); (0x200%positive, 0x100); (0x400%positive, 0x200); (0x800%positive, 0x400); (0x1000%positive, 0x800); (0x2000%positive, 0x1000); (0x4000%positive, 0x2000); (0x8000%positive, 0x4000); (0x10000%positive, 0x8001); (0x20000%positive, 0x10002); (0x40000%positive, 0x20004); (0x80000%positive, 0x40008); (0x100000%positive, 0x80010); (0x200000%positive, 0x100020); (0x400000%positive, 0x200040); (0x800000%positive, 0x400080); (0x1000000%positive, 0x800100); (0x2000000%positive, 0x1000200); (0x4000000%positive, 0x2000400); (0x8000000%positive, 0x4000800); (0x10000000%positive, 0x8001000); (0x20000000%positive, 0x10002000); (0x40000000%positive, 0x20004000); (0x10001%positive, 0x8000); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-right-30-all *)
Example suite_270 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf))))))))))))))))))))))))))))))
  [(0x1%positive, Both R); (0x3%positive, Both R); (0x7%positive, Both R); (0xf%positive, Both R); (0x1f%positive, Both R); (0x3f%positive, Both R); (0x7f%positive, Both R); (0xff%positive, Both R); (0x1ff%positive, Both R); (0x3ff%positive, Both R); (0x7ff%positive, Both R); (0xfff%positive, Both R); (0x1fff%positive, Both R); (0x3fff%positive, Both R); (0x7fff%positive, Both R); (0xffff%positive, Both R); (0x1ffff%positive, Both R); (0x3ffff%positive, Both R); (0x7ffff%positive, Both R); (0xfffff%positive, Both R); (0x1fffff%positive, Both R); (0x3fffff%positive, Both R); (0x7fffff%positive, Both R); (0xffffff%positive, Both R); (0x1ffffff%positive, Both R); (0x3ffffff%positive, Both R); (0x7ffffff%positive, Both R); (0xfffffff%positive, Both R); (0x1fffffff%positive, Both R); (0x3fffffff%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x3); (0xf%positive, 0x7); (0x1f%positive, 0xf); (0x3f%positive, 0x1f); (0x7f%positive, 0x3f); (0xff%positive, 0x7f); (0x1ff%positive, 0xff); (0x3ff%positive, 0x1ff); (0x7ff%positive, 0x3ff); (0xfff%positive, 0x7ff); (0x1fff%positive, 0xfff); (0x3fff%positive, 0x1fff); (0x7fff%positive, 0x3fff); (0xffff%positive, 0x7fff); (0x1ffff%positive, 0xffff); (0x3ffff%positive, 0x1ffff); (0x7ffff%positive, 0x3ffff); (0xfffff%positive, 0x7ffff); (0x1fffff%positive, 0xfffff); (0x3fffff%positive, 0x1fffff); (0x7fffff%positive, 0x3fffff); (0xffffff%positive, 0x7fffff); (0x1ffffff%positive, 0xffffff); (0x3ffffff%positive, 0x1ffffff); (0x7ffffff%positive, 0x3ffffff); (0xfffffff%positive, 0x7ffffff); (0x1fffffff%positive, 0xfffffff); (0x3fffffff%positive, 0x1fffffff); (0x7fffffff%positive, 0x3fffffff); (0x7ffffffe%positive, 0x3ffffffe); (0x3ffffffe%positive, 0x1ffffffe); (0x1ffffffe%positive, 0xffffffe); (0xffffffe%positive, 0x7fffffe); (0x7fffffe%positive, 0x3fffffe); (0x3fffffe%positive, 0x1fffffe); (0x1fffffe%positive, 0xfffffe); (0xfffffe%positive, 0x7ffffe); (0x7ffffe%positive, 0x3ffffe); (0x3ffffe%positive, 0x1ffffe); (0x1ffffe%positive, 0xffffe); (0xffffe%positive, 0x7fffe); (0x7fffe%positive, 0x3fffe); (0x3fffe%positive, 0x1fffe); (0x1fffe%positive, 0xfffe); (0xfffe%positive, 0x7ffe); (0x7ffe%positive, 0x3ffe); (0x3ffe%positive, 0x1ffe); (0x1ffe%positive, 0xffe); (0xffe%positive, 0x7fe); (0x7fe%positive, 0x3fe); (0x3fe%positive, 0x1fe); (0x1fe%positive, 0xfe); (0xfe%positive, 0x7e); (0x7e%positive, 0x3e); (0x3e%positive, 0x1e); (0x1e%positive, 0xe); (0xe%positive, 0x6); (0x6%positive, 0x2); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-right-30-first *)
Example suite_271 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf))))))))))))))))))))))))))))))
  [(0x1%positive, Both R); (0x3%positive, Only R); (0x7%positive, Only R); (0xf%positive, Only R); (0x1f%positive, Only R); (0x3f%positive, Only R); (0x7f%positive, Only R); (0xff%positive, Only R); (0x1ff%positive, Only R); (0x3ff%positive, Only R); (0x7ff%positive, Only R); (0xfff%positive, Only R); (0x1fff%positive, Only R); (0x3fff%positive, Only R); (0x7fff%positive, Only R); (0xffff%positive, Only R); (0x1ffff%positive, Only R); (0x3ffff%positive, Only R); (0x7ffff%positive, Only R); (0xfffff%positive, Only R); (0x1fffff%positive, Only R); (0x3fffff%positive, Only R); (0x7fffff%positive, Only R); (0xffffff%positive, Only R); (0x1ffffff%positive, Only R); (0x3ffffff%positive, Only R); (0x7ffffff%positive, Only R); (0xfffffff%positive, Only R); (0x1fffffff%positive, Only R); (0x3fffffff%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x2); (0xf%positive, 0x4); (0x1f%positive, 0x8); (0x3f%positive, 0x10); (0x7f%positive, 0x20); (0xff%positive, 0x40); (0x1ff%positive, 0x80); (0x3ff%positive, 0x100); (0x7ff%positive, 0x200); (0xfff%positive, 0x400); (0x1fff%positive, 0x800); (0x3fff%positive, 0x1000); (0x7fff%positive, 0x2000); (0xffff%positive, 0x4000); (0x1ffff%positive, 0x8000); (0x3ffff%positive, 0x10000); (0x7ffff%positive, 0x20000); (0xfffff%positive, 0x40000); (0x1fffff%positive, 0x80000); (0x3fffff%positive, 0x100000); (0x7fffff%positive, 0x200000); (0xffffff%positive, 0x400000); (0x1ffffff%positive, 0x800000); (0x3ffffff%positive, 0x1000000); (0x7ffffff%positive, 0x2000000); (0xfffffff%positive, 0x4000000); (0x1fffffff%positive, 0x8000000); (0x3fffffff%positive, 0x10000000); (0x7fffffff%positive, 0x20000000); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-right-30-two-1 *)
Example suite_272 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf))))))))))))))))))))))))))))))
  [(0x1%positive, Both R); (0x3%positive, Both R); (0x7%positive, Only R); (0xf%positive, Only R); (0x1f%positive, Only R); (0x3f%positive, Only R); (0x7f%positive, Only R); (0xff%positive, Only R); (0x1ff%positive, Only R); (0x3ff%positive, Only R); (0x7ff%positive, Only R); (0xfff%positive, Only R); (0x1fff%positive, Only R); (0x3fff%positive, Only R); (0x7fff%positive, Only R); (0xffff%positive, Only R); (0x1ffff%positive, Only R); (0x3ffff%positive, Only R); (0x7ffff%positive, Only R); (0xfffff%positive, Only R); (0x1fffff%positive, Only R); (0x3fffff%positive, Only R); (0x7fffff%positive, Only R); (0xffffff%positive, Only R); (0x1ffffff%positive, Only R); (0x3ffffff%positive, Only R); (0x7ffffff%positive, Only R); (0xfffffff%positive, Only R); (0x1fffffff%positive, Only R); (0x3fffffff%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x3); (0xf%positive, 0x6); (0x1f%positive, 0xc); (0x3f%positive, 0x18); (0x7f%positive, 0x30); (0xff%positive, 0x60); (0x1ff%positive, 0xc0); (0x3ff%positive, 0x180); (0x7ff%positive, 0x300); (0xfff%positive, 0x600); (0x1fff%positive, 0xc00); (0x3fff%positive, 0x1800); (0x7fff%positive, 0x3000); (0xffff%positive, 0x6000); (0x1ffff%positive, 0xc000); (0x3ffff%positive, 0x18000); (0x7ffff%positive, 0x30000); (0xfffff%positive, 0x60000); (0x1fffff%positive, 0xc0000); (0x3fffff%positive, 0x180000); (0x7fffff%positive, 0x300000); (0xffffff%positive, 0x600000); (0x1ffffff%positive, 0xc00000); (0x3ffffff%positive, 0x1800000); (0x7ffffff%positive, 0x3000000); (0xfffffff%positive, 0x6000000); (0x1fffffff%positive, 0xc000000); (0x3fffffff%positive, 0x18000000); (0x7fffffff%positive, 0x30000000); (0x6%positive, 0x2); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-right-30-two-2 *)
Example suite_273 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf))))))))))))))))))))))))))))))
  [(0x1%positive, Both R); (0x3%positive, Only R); (0x7%positive, Both R); (0xf%positive, Only R); (0x1f%positive, Only R); (0x3f%positive, Only R); (0x7f%positive, Only R); (0xff%positive, Only R); (0x1ff%positive, Only R); (0x3ff%positive, Only R); (0x7ff%positive, Only R); (0xfff%positive, Only R); (0x1fff%positive, Only R); (0x3fff%positive, Only R); (0x7fff%positive, Only R); (0xffff%positive, Only R); (0x1ffff%positive, Only R); (0x3ffff%positive, Only R); (0x7ffff%positive, Only R); (0xfffff%positive, Only R); (0x1fffff%positive, Only R); (0x3fffff%positive, Only R); (0x7fffff%positive, Only R); (0xffffff%positive, Only R); (0x1ffffff%positive, Only R); (0x3ffffff%positive, Only R); (0x7ffffff%positive, Only R); (0xfffffff%positive, Only R); (0x1fffffff%positive, Only R); (0x3fffffff%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x2); (0xf%positive, 0x5); (0x1f%positive, 0xa); (0x3f%positive, 0x14); (0x7f%positive, 0x28); (0xff%positive, 0x50); (0x1ff%positive, 0xa0); (0x3ff%positive, 0x140); (0x7ff%positive, 0x280); (0xfff%positive, 0x500); (0x1fff%positive, 0xa00); (0x3fff%positive, 0x1400); (0x7fff%positive, 0x2800); (0xffff%positive, 0x5000); (0x1ffff%positive, 0xa000); (0x3ffff%positive, 0x14000); (0x7ffff%positive, 0x28000); (0xfffff%positive, 0x50000); (0x1fffff%positive, 0xa0000); (0x3fffff%positive, 0x140000); (0x7fffff%positive, 0x280000); (0xffffff%positive, 0x500000); (0x1ffffff%positive, 0xa00000); (0x3ffffff%positive, 0x1400000); (0x7ffffff%positive, 0x2800000); (0xfffffff%positive, 0x5000000); (0x1fffffff%positive, 0xa000000); (0x3fffffff%positive, 0x14000000); (0x7fffffff%positive, 0x28000000); (0xe%positive, 0x4); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-right-30-two-3 *)
Example suite_274 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf))))))))))))))))))))))))))))))
  [(0x1%positive, Both R); (0x3%positive, Only R); (0x7%positive, Only R); (0xf%positive, Both R); (0x1f%positive, Only R); (0x3f%positive, Only R); (0x7f%positive, Only R); (0xff%positive, Only R); (0x1ff%positive, Only R); (0x3ff%positive, Only R); (0x7ff%positive, Only R); (0xfff%positive, Only R); (0x1fff%positive, Only R); (0x3fff%positive, Only R); (0x7fff%positive, Only R); (0xffff%positive, Only R); (0x1ffff%positive, Only R); (0x3ffff%positive, Only R); (0x7ffff%positive, Only R); (0xfffff%positive, Only R); (0x1fffff%positive, Only R); (0x3fffff%positive, Only R); (0x7fffff%positive, Only R); (0xffffff%positive, Only R); (0x1ffffff%positive, Only R); (0x3ffffff%positive, Only R); (0x7ffffff%positive, Only R); (0xfffffff%positive, Only R); (0x1fffffff%positive, Only R); (0x3fffffff%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x2); (0xf%positive, 0x4); (0x1f%positive, 0x9); (0x3f%positive, 0x12); (0x7f%positive, 0x24); (0xff%positive, 0x48); (0x1ff%positive, 0x90); (0x3ff%positive, 0x120); (0x7ff%positive, 0x240); (0xfff%positive, 0x480); (0x1fff%positive, 0x900); (0x3fff%positive, 0x1200); (0x7fff%positive, 0x2400); (0xffff%positive, 0x4800); (0x1ffff%positive, 0x9000); (0x3ffff%positive, 0x12000); (0x7ffff%positive, 0x24000); (0xfffff%positive, 0x48000); (0x1fffff%positive, 0x90000); (0x3fffff%positive, 0x120000); (0x7fffff%positive, 0x240000); (0xffffff%positive, 0x480000); (0x1ffffff%positive, 0x900000); (0x3ffffff%positive, 0x1200000); (0x7ffffff%positive, 0x2400000); (0xfffffff%positive, 0x4800000); (0x1fffffff%positive, 0x9000000); (0x3fffffff%positive, 0x12000000); (0x7fffffff%positive, 0x24000000); (0x1e%positive, 0x8); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-right-30-two-4 *)
Example suite_275 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf))))))))))))))))))))))))))))))
  [(0x1%positive, Both R); (0x3%positive, Only R); (0x7%positive, Only R); (0xf%positive, Only R); (0x1f%positive, Both R); (0x3f%positive, Only R); (0x7f%positive, Only R); (0xff%positive, Only R); (0x1ff%positive, Only R); (0x3ff%positive, Only R); (0x7ff%positive, Only R); (0xfff%positive, Only R); (0x1fff%positive, Only R); (0x3fff%positive, Only R); (0x7fff%positive, Only R); (0xffff%positive, Only R); (0x1ffff%positive, Only R); (0x3ffff%positive, Only R); (0x7ffff%positive, Only R); (0xfffff%positive, Only R); (0x1fffff%positive, Only R); (0x3fffff%positive, Only R); (0x7fffff%positive, Only R); (0xffffff%positive, Only R); (0x1ffffff%positive, Only R); (0x3ffffff%positive, Only R); (0x7ffffff%positive, Only R); (0xfffffff%positive, Only R); (0x1fffffff%positive, Only R); (0x3fffffff%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x2); (0xf%positive, 0x4); (0x1f%positive, 0x8); (0x3f%positive, 0x11); (0x7f%positive, 0x22); (0xff%positive, 0x44); (0x1ff%positive, 0x88); (0x3ff%positive, 0x110); (0x7ff%positive, 0x220); (0xfff%positive, 0x440); (0x1fff%positive, 0x880); (0x3fff%positive, 0x1100); (0x7fff%positive, 0x2200); (0xffff%positive, 0x4400); (0x1ffff%positive, 0x8800); (0x3ffff%positive, 0x11000); (0x7ffff%positive, 0x22000); (0xfffff%positive, 0x44000); (0x1fffff%positive, 0x88000); (0x3fffff%positive, 0x110000); (0x7fffff%positive, 0x220000); (0xffffff%positive, 0x440000); (0x1ffffff%positive, 0x880000); (0x3ffffff%positive, 0x1100000); (0x7ffffff%positive, 0x2200000); (0xfffffff%positive, 0x4400000); (0x1fffffff%positive, 0x8800000); (0x3fffffff%positive, 0x11000000); (0x7fffffff%positive, 0x22000000); (0x3e%positive, 0x10); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-right-30-two-15 *)
Example suite_276 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf))))))))))))))))))))))))))))))
  [(0x1%positive, Both R); (0x3%positive, Only R); (0x7%positive, Only R); (0xf%positive, Only R); (0x1f%positive, Only R); (0x3f%positive, Only R); (0x7f%positive, Only R); (0xff%positive, Only R); (0x1ff%positive, Only R); (0x3ff%positive, Only R); (0x7ff%positive, Only R); (0xfff%positive, Only R); (0x1fff%positive, Only R); (0x3fff%positive, Only R); (0x7fff%positive, Only R); (0xffff%positive, Both R); (0x1ffff%positive, Only R); (0x3ffff%positive, Only R); (0x7ffff%positive, Only R); (0xfffff%positive, Only R); (0x1fffff%positive, Only R); (0x3fffff%positive, Only R); (0x7fffff%positive, Only R); (0xffffff%positive, Only R); (0x1ffffff%positive, Only R); (0x3ffffff%positive, Only R); (0x7ffffff%positive, Only R); (0xfffffff%positive, Only R); (0x1fffffff%positive, Only R); (0x3fffffff%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x2); (0xf%positive, 0x4); (0x1f%positive, 0x8); (0x3f%positive, 0x10); (0x7f%positive, 0x20); (0xff%positive, 0x40); (0x1ff%positive, 0x80); (0x3ff%positive, 0x100); (0x7ff%positive, 0x200); (0xfff%positive, 0x400); (0x1fff%positive, 0x800); (0x3fff%positive, 0x1000); (0x7fff%positive, 0x2000); (0xffff%positive, 0x4000); (0x1ffff%positive, 0x8001); (0x3ffff%positive, 0x10002); (0x7ffff%positive, 0x20004); (0xfffff%positive, 0x40008); (0x1fffff%positive, 0x80010); (0x3fffff%positive, 0x100020); (0x7fffff%positive, 0x200040); (0xffffff%positive, 0x400080); (0x1ffffff%positive, 0x800100); (0x3ffffff%positive, 0x1000200); (0x7ffffff%positive, 0x2000400); (0xfffffff%positive, 0x4000800); (0x1fffffff%positive, 0x8001000); (0x3fffffff%positive, 0x10002000); (0x7fffffff%positive, 0x20004000); (0x1fffe%positive, 0x8000); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-turns-30-all *)
Example suite_277 : suite_seen (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf Leaf) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Both R); (0x5%positive, Both L); (0xa%positive, Both R); (0x15%positive, Both L); (0x2a%positive, Both R); (0x55%positive, Both L); (0xaa%positive, Both R); (0x155%positive, Both L); (0x2aa%positive, Both R); (0x555%positive, Both L); (0xaaa%positive, Both R); (0x1555%positive, Both L); (0x2aaa%positive, Both R); (0x5555%positive, Both L); (0xaaaa%positive, Both R); (0x15555%positive, Both L); (0x2aaaa%positive, Both R); (0x55555%positive, Both L); (0xaaaaa%positive, Both R); (0x155555%positive, Both L); (0x2aaaaa%positive, Both R); (0x555555%positive, Both L); (0xaaaaaa%positive, Both R); (0x1555555%positive, Both L); (0x2aaaaaa%positive, Both R); (0x5555555%positive, Both L); (0xaaaaaaa%positive, Both R); (0x15555555%positive, Both L); (0x2aaaaaaa%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x3); (0xa%positive, 0x7); (0x15%positive, 0xf); (0x2a%positive, 0x1f); (0x55%positive, 0x3f); (0xaa%positive, 0x7f); (0x155%positive, 0xff); (0x2aa%positive, 0x1ff); (0x555%positive, 0x3ff); (0xaaa%positive, 0x7ff); (0x1555%positive, 0xfff); (0x2aaa%positive, 0x1fff); (0x5555%positive, 0x3fff); (0xaaaa%positive, 0x7fff); (0x15555%positive, 0xffff); (0x2aaaa%positive, 0x1ffff); (0x55555%positive, 0x3ffff); (0xaaaaa%positive, 0x7ffff); (0x155555%positive, 0xfffff); (0x2aaaaa%positive, 0x1fffff); (0x555555%positive, 0x3fffff); (0xaaaaaa%positive, 0x7fffff); (0x1555555%positive, 0xffffff); (0x2aaaaaa%positive, 0x1ffffff); (0x5555555%positive, 0x3ffffff); (0xaaaaaaa%positive, 0x7ffffff); (0x15555555%positive, 0xfffffff); (0x2aaaaaaa%positive, 0x1fffffff); (0x55555555%positive, 0x3fffffff); (0x55555554%positive, 0x3ffffffe); (0x2aaaaaab%positive, 0x1ffffffe); (0x15555554%positive, 0xffffffe); (0xaaaaaab%positive, 0x7fffffe); (0x5555554%positive, 0x3fffffe); (0x2aaaaab%positive, 0x1fffffe); (0x1555554%positive, 0xfffffe); (0xaaaaab%positive, 0x7ffffe); (0x555554%positive, 0x3ffffe); (0x2aaaab%positive, 0x1ffffe); (0x155554%positive, 0xffffe); (0xaaaab%positive, 0x7fffe); (0x55554%positive, 0x3fffe); (0x2aaab%positive, 0x1fffe); (0x15554%positive, 0xfffe); (0xaaab%positive, 0x7ffe); (0x5554%positive, 0x3ffe); (0x2aab%positive, 0x1ffe); (0x1554%positive, 0xffe); (0xaab%positive, 0x7fe); (0x554%positive, 0x3fe); (0x2ab%positive, 0x1fe); (0x154%positive, 0xfe); (0xab%positive, 0x7e); (0x54%positive, 0x3e); (0x2b%positive, 0x1e); (0x14%positive, 0xe); (0xb%positive, 0x6); (0x4%positive, 0x2); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-turns-30-first *)
Example suite_278 : suite_seen (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf Leaf) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only R); (0x5%positive, Only L); (0xa%positive, Only R); (0x15%positive, Only L); (0x2a%positive, Only R); (0x55%positive, Only L); (0xaa%positive, Only R); (0x155%positive, Only L); (0x2aa%positive, Only R); (0x555%positive, Only L); (0xaaa%positive, Only R); (0x1555%positive, Only L); (0x2aaa%positive, Only R); (0x5555%positive, Only L); (0xaaaa%positive, Only R); (0x15555%positive, Only L); (0x2aaaa%positive, Only R); (0x55555%positive, Only L); (0xaaaaa%positive, Only R); (0x155555%positive, Only L); (0x2aaaaa%positive, Only R); (0x555555%positive, Only L); (0xaaaaaa%positive, Only R); (0x1555555%positive, Only L); (0x2aaaaaa%positive, Only R); (0x5555555%positive, Only L); (0xaaaaaaa%positive, Only R); (0x15555555%positive, Only L); (0x2aaaaaaa%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x2); (0xa%positive, 0x4); (0x15%positive, 0x8); (0x2a%positive, 0x10); (0x55%positive, 0x20); (0xaa%positive, 0x40); (0x155%positive, 0x80); (0x2aa%positive, 0x100); (0x555%positive, 0x200); (0xaaa%positive, 0x400); (0x1555%positive, 0x800); (0x2aaa%positive, 0x1000); (0x5555%positive, 0x2000); (0xaaaa%positive, 0x4000); (0x15555%positive, 0x8000); (0x2aaaa%positive, 0x10000); (0x55555%positive, 0x20000); (0xaaaaa%positive, 0x40000); (0x155555%positive, 0x80000); (0x2aaaaa%positive, 0x100000); (0x555555%positive, 0x200000); (0xaaaaaa%positive, 0x400000); (0x1555555%positive, 0x800000); (0x2aaaaaa%positive, 0x1000000); (0x5555555%positive, 0x2000000); (0xaaaaaaa%positive, 0x4000000); (0x15555555%positive, 0x8000000); (0x2aaaaaaa%positive, 0x10000000); (0x55555555%positive, 0x20000000); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-turns-30-two-1 *)
Example suite_279 : suite_seen (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf Leaf) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Both R); (0x5%positive, Only L); (0xa%positive, Only R); (0x15%positive, Only L); (0x2a%positive, Only R); (0x55%positive, Only L); (0xaa%positive, Only R); (0x155%positive, Only L); (0x2aa%positive, Only R); (0x555%positive, Only L); (0xaaa%positive, Only R); (0x1555%positive, Only L); (0x2aaa%positive, Only R); (0x5555%positive, Only L); (0xaaaa%positive, Only R); (0x15555%positive, Only L); (0x2aaaa%positive, Only R); (0x55555%positive, Only L); (0xaaaaa%positive, Only R); (0x155555%positive, Only L); (0x2aaaaa%positive, Only R); (0x555555%positive, Only L); (0xaaaaaa%positive, Only R); (0x1555555%positive, Only L); (0x2aaaaaa%positive, Only R); (0x5555555%positive, Only L); (0xaaaaaaa%positive, Only R); (0x15555555%positive, Only L); (0x2aaaaaaa%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x3); (0xa%positive, 0x6); (0x15%positive, 0xc); (0x2a%positive, 0x18); (0x55%positive, 0x30); (0xaa%positive, 0x60); (0x155%positive, 0xc0); (0x2aa%positive, 0x180); (0x555%positive, 0x300); (0xaaa%positive, 0x600); (0x1555%positive, 0xc00); (0x2aaa%positive, 0x1800); (0x5555%positive, 0x3000); (0xaaaa%positive, 0x6000); (0x15555%positive, 0xc000); (0x2aaaa%positive, 0x18000); (0x55555%positive, 0x30000); (0xaaaaa%positive, 0x60000); (0x155555%positive, 0xc0000); (0x2aaaaa%positive, 0x180000); (0x555555%positive, 0x300000); (0xaaaaaa%positive, 0x600000); (0x1555555%positive, 0xc00000); (0x2aaaaaa%positive, 0x1800000); (0x5555555%positive, 0x3000000); (0xaaaaaaa%positive, 0x6000000); (0x15555555%positive, 0xc000000); (0x2aaaaaaa%positive, 0x18000000); (0x55555555%positive, 0x30000000); (0x4%positive, 0x2); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-turns-30-two-2 *)
Example suite_280 : suite_seen (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf Leaf) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only R); (0x5%positive, Both L); (0xa%positive, Only R); (0x15%positive, Only L); (0x2a%positive, Only R); (0x55%positive, Only L); (0xaa%positive, Only R); (0x155%positive, Only L); (0x2aa%positive, Only R); (0x555%positive, Only L); (0xaaa%positive, Only R); (0x1555%positive, Only L); (0x2aaa%positive, Only R); (0x5555%positive, Only L); (0xaaaa%positive, Only R); (0x15555%positive, Only L); (0x2aaaa%positive, Only R); (0x55555%positive, Only L); (0xaaaaa%positive, Only R); (0x155555%positive, Only L); (0x2aaaaa%positive, Only R); (0x555555%positive, Only L); (0xaaaaaa%positive, Only R); (0x1555555%positive, Only L); (0x2aaaaaa%positive, Only R); (0x5555555%positive, Only L); (0xaaaaaaa%positive, Only R); (0x15555555%positive, Only L); (0x2aaaaaaa%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x2); (0xa%positive, 0x5); (0x15%positive, 0xa); (0x2a%positive, 0x14); (0x55%positive, 0x28); (0xaa%positive, 0x50); (0x155%positive, 0xa0); (0x2aa%positive, 0x140); (0x555%positive, 0x280); (0xaaa%positive, 0x500); (0x1555%positive, 0xa00); (0x2aaa%positive, 0x1400); (0x5555%positive, 0x2800); (0xaaaa%positive, 0x5000); (0x15555%positive, 0xa000); (0x2aaaa%positive, 0x14000); (0x55555%positive, 0x28000); (0xaaaaa%positive, 0x50000); (0x155555%positive, 0xa0000); (0x2aaaaa%positive, 0x140000); (0x555555%positive, 0x280000); (0xaaaaaa%positive, 0x500000); (0x1555555%positive, 0xa00000); (0x2aaaaaa%positive, 0x1400000); (0x5555555%positive, 0x2800000); (0xaaaaaaa%positive, 0x5000000); (0x15555555%positive, 0xa000000); (0x2aaaaaaa%positive, 0x14000000); (0x55555555%positive, 0x28000000); (0xb%positive, 0x4); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-turns-30-two-3 *)
Example suite_281 : suite_seen (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf Leaf) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only R); (0x5%positive, Only L); (0xa%positive, Both R); (0x15%positive, Only L); (0x2a%positive, Only R); (0x55%positive, Only L); (0xaa%positive, Only R); (0x155%positive, Only L); (0x2aa%positive, Only R); (0x555%positive, Only L); (0xaaa%positive, Only R); (0x1555%positive, Only L); (0x2aaa%positive, Only R); (0x5555%positive, Only L); (0xaaaa%positive, Only R); (0x15555%positive, Only L); (0x2aaaa%positive, Only R); (0x55555%positive, Only L); (0xaaaaa%positive, Only R); (0x155555%positive, Only L); (0x2aaaaa%positive, Only R); (0x555555%positive, Only L); (0xaaaaaa%positive, Only R); (0x1555555%positive, Only L); (0x2aaaaaa%positive, Only R); (0x5555555%positive, Only L); (0xaaaaaaa%positive, Only R); (0x15555555%positive, Only L); (0x2aaaaaaa%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x2); (0xa%positive, 0x4); (0x15%positive, 0x9); (0x2a%positive, 0x12); (0x55%positive, 0x24); (0xaa%positive, 0x48); (0x155%positive, 0x90); (0x2aa%positive, 0x120); (0x555%positive, 0x240); (0xaaa%positive, 0x480); (0x1555%positive, 0x900); (0x2aaa%positive, 0x1200); (0x5555%positive, 0x2400); (0xaaaa%positive, 0x4800); (0x15555%positive, 0x9000); (0x2aaaa%positive, 0x12000); (0x55555%positive, 0x24000); (0xaaaaa%positive, 0x48000); (0x155555%positive, 0x90000); (0x2aaaaa%positive, 0x120000); (0x555555%positive, 0x240000); (0xaaaaaa%positive, 0x480000); (0x1555555%positive, 0x900000); (0x2aaaaaa%positive, 0x1200000); (0x5555555%positive, 0x2400000); (0xaaaaaaa%positive, 0x4800000); (0x15555555%positive, 0x9000000); (0x2aaaaaaa%positive, 0x12000000); (0x55555555%positive, 0x24000000); (0x14%positive, 0x8); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-turns-30-two-4 *)
Example suite_282 : suite_seen (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf Leaf) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only R); (0x5%positive, Only L); (0xa%positive, Only R); (0x15%positive, Both L); (0x2a%positive, Only R); (0x55%positive, Only L); (0xaa%positive, Only R); (0x155%positive, Only L); (0x2aa%positive, Only R); (0x555%positive, Only L); (0xaaa%positive, Only R); (0x1555%positive, Only L); (0x2aaa%positive, Only R); (0x5555%positive, Only L); (0xaaaa%positive, Only R); (0x15555%positive, Only L); (0x2aaaa%positive, Only R); (0x55555%positive, Only L); (0xaaaaa%positive, Only R); (0x155555%positive, Only L); (0x2aaaaa%positive, Only R); (0x555555%positive, Only L); (0xaaaaaa%positive, Only R); (0x1555555%positive, Only L); (0x2aaaaaa%positive, Only R); (0x5555555%positive, Only L); (0xaaaaaaa%positive, Only R); (0x15555555%positive, Only L); (0x2aaaaaaa%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x2); (0xa%positive, 0x4); (0x15%positive, 0x8); (0x2a%positive, 0x11); (0x55%positive, 0x22); (0xaa%positive, 0x44); (0x155%positive, 0x88); (0x2aa%positive, 0x110); (0x555%positive, 0x220); (0xaaa%positive, 0x440); (0x1555%positive, 0x880); (0x2aaa%positive, 0x1100); (0x5555%positive, 0x2200); (0xaaaa%positive, 0x4400); (0x15555%positive, 0x8800); (0x2aaaa%positive, 0x11000); (0x55555%positive, 0x22000); (0xaaaaa%positive, 0x44000); (0x155555%positive, 0x88000); (0x2aaaaa%positive, 0x110000); (0x555555%positive, 0x220000); (0xaaaaaa%positive, 0x440000); (0x1555555%positive, 0x880000); (0x2aaaaaa%positive, 0x1100000); (0x5555555%positive, 0x2200000); (0xaaaaaaa%positive, 0x4400000); (0x15555555%positive, 0x8800000); (0x2aaaaaaa%positive, 0x11000000); (0x55555555%positive, 0x22000000); (0x2b%positive, 0x10); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-turns-30-two-15 *)
Example suite_283 : suite_seen (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf Leaf) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only R); (0x5%positive, Only L); (0xa%positive, Only R); (0x15%positive, Only L); (0x2a%positive, Only R); (0x55%positive, Only L); (0xaa%positive, Only R); (0x155%positive, Only L); (0x2aa%positive, Only R); (0x555%positive, Only L); (0xaaa%positive, Only R); (0x1555%positive, Only L); (0x2aaa%positive, Only R); (0x5555%positive, Only L); (0xaaaa%positive, Both R); (0x15555%positive, Only L); (0x2aaaa%positive, Only R); (0x55555%positive, Only L); (0xaaaaa%positive, Only R); (0x155555%positive, Only L); (0x2aaaaa%positive, Only R); (0x555555%positive, Only L); (0xaaaaaa%positive, Only R); (0x1555555%positive, Only L); (0x2aaaaaa%positive, Only R); (0x5555555%positive, Only L); (0xaaaaaaa%positive, Only R); (0x15555555%positive, Only L); (0x2aaaaaaa%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x2); (0xa%positive, 0x4); (0x15%positive, 0x8); (0x2a%positive, 0x10); (0x55%positive, 0x20); (0xaa%positive, 0x40); (0x155%positive, 0x80); (0x2aa%positive, 0x100); (0x555%positive, 0x200); (0xaaa%positive, 0x400); (0x1555%positive, 0x800); (0x2aaa%positive, 0x1000); (0x5555%positive, 0x2000); (0xaaaa%positive, 0x4000); (0x15555%positive, 0x8001); (0x2aaaa%positive, 0x10002); (0x55555%positive, 0x20004); (0xaaaaa%positive, 0x40008); (0x155555%positive, 0x80010); (0x2aaaaa%positive, 0x100020); (0x555555%positive, 0x200040); (0xaaaaaa%positive, 0x400080); (0x1555555%positive, 0x800100); (0x2aaaaaa%positive, 0x1000200); (0x5555555%positive, 0x2000400); (0xaaaaaaa%positive, 0x4000800); (0x15555555%positive, 0x8001000); (0x2aaaaaaa%positive, 0x10002000); (0x55555555%positive, 0x20004000); (0x15554%positive, 0x8000); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-31-all *)
Example suite_284 : suite_seen (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Both L); (0x4%positive, Both L); (0x8%positive, Both L); (0x10%positive, Both L); (0x20%positive, Both L); (0x40%positive, Both L); (0x80%positive, Both L); (0x100%positive, Both L); (0x200%positive, Both L); (0x400%positive, Both L); (0x800%positive, Both L); (0x1000%positive, Both L); (0x2000%positive, Both L); (0x4000%positive, Both L); (0x8000%positive, Both L); (0x10000%positive, Both L); (0x20000%positive, Both L); (0x40000%positive, Both L); (0x80000%positive, Both L); (0x100000%positive, Both L); (0x200000%positive, Both L); (0x400000%positive, Both L); (0x800000%positive, Both L); (0x1000000%positive, Both L); (0x2000000%positive, Both L); (0x4000000%positive, Both L); (0x8000000%positive, Both L); (0x10000000%positive, Both L); (0x20000000%positive, Both L); (0x40000000%positive, Both L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x3); (0x8%positive, 0x7); (0x10%positive, 0xf); (0x20%positive, 0x1f); (0x40%positive, 0x3f); (0x80%positive, 0x7f); (0x100%positive, 0xff); (0x200%positive, 0x1ff); (0x400%positive, 0x3ff); (0x800%positive, 0x7ff); (0x1000%positive, 0xfff); (0x2000%positive, 0x1fff); (0x4000%positive, 0x3fff); (0x8000%positive, 0x7fff); (0x10000%positive, 0xffff); (0x20000%positive, 0x1ffff); (0x40000%positive, 0x3ffff); (0x80000%positive, 0x7ffff); (0x100000%positive, 0xfffff); (0x200000%positive, 0x1fffff); (0x400000%positive, 0x3fffff); (0x800000%positive, 0x7fffff); (0x1000000%positive, 0xffffff); (0x2000000%positive, 0x1ffffff); (0x4000000%positive, 0x3ffffff); (0x8000000%positive, 0x7ffffff); (0x10000000%positive, 0xfffffff); (0x20000000%positive, 0x1fffffff); (0x40000000%positive, 0x3fffffff); (0x80000000%positive, 0x7fffffff); (0x80000001%positive, 0x7ffffffe); (0x40000001%positive, 0x3ffffffe); (0x20000001%positive, 0x1ffffffe); (0x10000001%positive, 0xffffffe); (0x8000001%positive, 0x7fffffe); (0x4000001%positive, 0x3fffffe); (0x2000001%positive, 0x1fffffe); (0x1000001%positive, 0xfffffe); (0x800001%positive, 0x7ffffe); (0x400001%positive, 0x3ffffe); (0x200001%positive, 0x1ffffe); (0x100001%positive, 0xffffe); (0x80001%positive, 0x7fffe); (0x40001%positive, 0x3fffe); (0x20001%positive, 0x1fffe); (0x10001%positive, 0xfffe); (0x8001%positive, 0x7ffe); (0x4001%positive, 0x3ffe); (0x2001%positive, 0x1ffe); (0x1001%positive, 0xffe); (0x801%positive, 0x7fe); (0x401%positive, 0x3fe); (0x201%positive, 0x1fe); (0x101%positive, 0xfe); (0x81%positive, 0x7e); (0x41%positive, 0x3e); (0x21%positive, 0x1e); (0x11%positive, 0xe); (0x9%positive, 0x6); (0x5%positive, 0x2); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-31-first *)
Example suite_285 : suite_seen (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Only L); (0x8%positive, Only L); (0x10%positive, Only L); (0x20%positive, Only L); (0x40%positive, Only L); (0x80%positive, Only L); (0x100%positive, Only L); (0x200%positive, Only L); (0x400%positive, Only L); (0x800%positive, Only L); (0x1000%positive, Only L); (0x2000%positive, Only L); (0x4000%positive, Only L); (0x8000%positive, Only L); (0x10000%positive, Only L); (0x20000%positive, Only L); (0x40000%positive, Only L); (0x80000%positive, Only L); (0x100000%positive, Only L); (0x200000%positive, Only L); (0x400000%positive, Only L); (0x800000%positive, Only L); (0x1000000%positive, Only L); (0x2000000%positive, Only L); (0x4000000%positive, Only L); (0x8000000%positive, Only L); (0x10000000%positive, Only L); (0x20000000%positive, Only L); (0x40000000%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x8%positive, 0x4); (0x10%positive, 0x8); (0x20%positive, 0x10); (0x40%positive, 0x20); (0x80%positive, 0x40); (0x100%positive, 0x80); (0x200%positive, 0x100); (0x400%positive, 0x200); (0x800%positive, 0x400); (0x1000%positive, 0x800); (0x2000%positive, 0x1000); (0x4000%positive, 0x2000); (0x8000%positive, 0x4000); (0x10000%positive, 0x8000); (0x20000%positive, 0x10000); (0x40000%positive, 0x20000); (0x80000%positive, 0x40000); (0x100000%positive, 0x80000); (0x200000%positive, 0x100000); (0x400000%positive, 0x200000); (0x800000%positive, 0x400000); (0x1000000%positive, 0x800000); (0x2000000%positive, 0x1000000); (0x4000000%positive, 0x2000000); (0x8000000%positive, 0x4000000); (0x10000000%positive, 0x8000000); (0x20000000%positive, 0x10000000); (0x40000000%positive, 0x20000000); (0x80000000%positive, 0x40000000); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-31-two-1 *)
Example suite_286 : suite_seen (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Both L); (0x4%positive, Only L); (0x8%positive, Only L); (0x10%positive, Only L); (0x20%positive, Only L); (0x40%positive, Only L); (0x80%positive, Only L); (0x100%positive, Only L); (0x200%positive, Only L); (0x400%positive, Only L); (0x800%positive, Only L); (0x1000%positive, Only L); (0x2000%positive, Only L); (0x4000%positive, Only L); (0x8000%positive, Only L); (0x10000%positive, Only L); (0x20000%positive, Only L); (0x40000%positive, Only L); (0x80000%positive, Only L); (0x100000%positive, Only L); (0x200000%positive, Only L); (0x400000%positive, Only L); (0x800000%positive, Only L); (0x1000000%positive, Only L); (0x2000000%positive, Only L); (0x4000000%positive, Only L); (0x8000000%positive, Only L); (0x10000000%positive, Only L); (0x20000000%positive, Only L); (0x40000000%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x3); (0x8%positive, 0x6); (0x10%positive, 0xc); (0x20%positive, 0x18); (0x40%positive, 0x30); (0x80%positive, 0x60); (0x100%positive, 0xc0); (0x200%positive, 0x180); (0x400%positive, 0x300); (0x800%positive, 0x600); (0x1000%positive, 0xc00); (0x2000%positive, 0x1800); (0x4000%positive, 0x3000); (0x8000%positive, 0x6000); (0x10000%positive, 0xc000); (0x20000%positive, 0x18000); (0x40000%positive, 0x30000); (0x80000%positive, 0x60000); (0x100000%positive, 0xc0000); (0x200000%positive, 0x180000); (0x400000%positive, 0x300000); (0x800000%positive, 0x600000); (0x1000000%positive, 0xc00000); (0x2000000%positive, 0x1800000); (0x4000000%positive, 0x3000000); (0x8000000%positive, 0x6000000); (0x10000000%positive, 0xc000000); (0x20000000%positive, 0x18000000); (0x40000000%positive, 0x30000000); (0x80000000%positive, 0x60000000); (0x5%positive, 0x2); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-31-two-2 *)
Example suite_287 : suite_seen (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Both L); (0x8%positive, Only L); (0x10%positive, Only L); (0x20%positive, Only L); (0x40%positive, Only L); (0x80%positive, Only L); (0x100%positive, Only L); (0x200%positive, Only L); (0x400%positive, Only L); (0x800%positive, Only L); (0x1000%positive, Only L); (0x2000%positive, Only L); (0x4000%positive, Only L); (0x8000%positive, Only L); (0x10000%positive, Only L); (0x20000%positive, Only L); (0x40000%positive, Only L); (0x80000%positive, Only L); (0x100000%positive, Only L); (0x200000%positive, Only L); (0x400000%positive, Only L); (0x800000%positive, Only L); (0x1000000%positive, Only L); (0x2000000%positive, Only L); (0x4000000%positive, Only L); (0x8000000%positive, Only L); (0x10000000%positive, Only L); (0x20000000%positive, Only L); (0x40000000%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x8%positive, 0x5); (0x10%positive, 0xa); (0x20%positive, 0x14); (0x40%positive, 0x28); (0x80%positive, 0x50); (0x100%positive, 0xa0); (0x200%positive, 0x140); (0x400%positive, 0x280); (0x800%positive, 0x500); (0x1000%positive, 0xa00); (0x2000%positive, 0x1400); (0x4000%positive, 0x2800); (0x8000%positive, 0x5000); (0x10000%positive, 0xa000); (0x20000%positive, 0x14000); (0x40000%positive, 0x28000); (0x80000%positive, 0x50000); (0x100000%positive, 0xa0000); (0x200000%positive, 0x140000); (0x400000%positive, 0x280000); (0x800000%positive, 0x500000); (0x1000000%positive, 0xa00000); (0x2000000%positive, 0x1400000); (0x4000000%positive, 0x2800000); (0x8000000%positive, 0x5000000); (0x10000000%positive, 0xa000000); (0x20000000%positive, 0x14000000); (0x40000000%positive, 0x28000000); (0x80000000%positive, 0x50000000); (0x9%positive, 0x4); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-31-two-3 *)
Example suite_288 : suite_seen (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Only L); (0x8%positive, Both L); (0x10%positive, Only L); (0x20%positive, Only L); (0x40%positive, Only L); (0x80%positive, Only L); (0x100%positive, Only L); (0x200%positive, Only L); (0x400%positive, Only L); (0x800%positive, Only L); (0x1000%positive, Only L); (0x2000%positive, Only L); (0x4000%positive, Only L); (0x8000%positive, Only L); (0x10000%positive, Only L); (0x20000%positive, Only L); (0x40000%positive, Only L); (0x80000%positive, Only L); (0x100000%positive, Only L); (0x200000%positive, Only L); (0x400000%positive, Only L); (0x800000%positive, Only L); (0x1000000%positive, Only L); (0x2000000%positive, Only L); (0x4000000%positive, Only L); (0x8000000%positive, Only L); (0x10000000%positive, Only L); (0x20000000%positive, Only L); (0x40000000%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x8%positive, 0x4); (0x10%positive, 0x9); (0x20%positive, 0x12); (0x40%positive, 0x24); (0x80%positive, 0x48); (0x100%positive, 0x90); (0x200%positive, 0x120); (0x400%positive, 0x240); (0x800%positive, 0x480); (0x1000%positive, 0x900); (0x2000%positive, 0x1200); (0x4000%positive, 0x2400); (0x8000%positive, 0x4800); (0x10000%positive, 0x9000); (0x20000%positive, 0x12000); (0x40000%positive, 0x24000); (0x80000%positive, 0x48000); (0x100000%positive, 0x90000); (0x200000%positive, 0x120000); (0x400000%positive, 0x240000); (0x800000%positive, 0x480000); (0x1000000%positive, 0x900000); (0x2000000%positive, 0x1200000); (0x4000000%positive, 0x2400000); (0x8000000%positive, 0x4800000); (0x10000000%positive, 0x9000000); (0x20000000%positive, 0x12000000); (0x40000000%positive, 0x24000000); (0x80000000%positive, 0x48000000); (0x11%positive, 0x8); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-31-two-4 *)
Example suite_289 : suite_seen (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Only L); (0x8%positive, Only L); (0x10%positive, Both L); (0x20%positive, Only L); (0x40%positive, Only L); (0x80%positive, Only L); (0x100%positive, Only L); (0x200%positive, Only L); (0x400%positive, Only L); (0x800%positive, Only L); (0x1000%positive, Only L); (0x2000%positive, Only L); (0x4000%positive, Only L); (0x8000%positive, Only L); (0x10000%positive, Only L); (0x20000%positive, Only L); (0x40000%positive, Only L); (0x80000%positive, Only L); (0x100000%positive, Only L); (0x200000%positive, Only L); (0x400000%positive, Only L); (0x800000%positive, Only L); (0x1000000%positive, Only L); (0x2000000%positive, Only L); (0x4000000%positive, Only L); (0x8000000%positive, Only L); (0x10000000%positive, Only L); (0x20000000%positive, Only L); (0x40000000%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x8%positive, 0x4); (0x10%positive, 0x8); (0x20%positive, 0x11); (0x40%positive, 0x22); (0x80%positive, 0x44); (0x100%positive, 0x88); (0x200%positive, 0x110); (0x400%positive, 0x220); (0x800%positive, 0x440); (0x1000%positive, 0x880); (0x2000%positive, 0x1100); (0x4000%positive, 0x2200); (0x8000%positive, 0x4400); (0x10000%positive, 0x8800); (0x20000%positive, 0x11000); (0x40000%positive, 0x22000); (0x80000%positive, 0x44000); (0x100000%positive, 0x88000); (0x200000%positive, 0x110000); (0x400000%positive, 0x220000); (0x800000%positive, 0x440000); (0x1000000%positive, 0x880000); (0x2000000%positive, 0x1100000); (0x4000000%positive, 0x2200000); (0x8000000%positive, 0x4400000); (0x10000000%positive, 0x8800000); (0x20000000%positive, 0x11000000); (0x40000000%positive, 0x22000000); (0x80000000%positive, 0x44000000); (0x21%positive, 0x10); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-31-two-15 *)
Example suite_290 : suite_seen (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Only L); (0x8%positive, Only L); (0x10%positive, Only L); (0x20%positive, Only L); (0x40%positive, Only L); (0x80%positive, Only L); (0x100%positive, Only L); (0x200%positive, Only L); (0x400%positive, Only L); (0x800%positive, Only L); (0x1000%positive, Only L); (0x2000%positive, Only L); (0x4000%positive, Only L); (0x8000%positive, Both L); (0x10000%positive, Only L); (0x20000%positive, Only L); (0x40000%positive, Only L); (0x80000%positive, Only L); (0x100000%positive, Only L); (0x200000%positive, Only L); (0x400000%positive, Only L); (0x800000%positive, Only L); (0x1000000%positive, Only L); (0x2000000%positive, Only L); (0x4000000%positive, Only L); (0x8000000%positive, Only L); (0x10000000%positive, Only L); (0x20000000%positive, Only L); (0x40000000%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x8%positive, 0x4); (0x10%positive, 0x8); (0x20%positive, 0x10); (0x40%positive, 0x20); (0x80%positive, 0x40); (0x100%positive, 0x80); (0x200%positive, 0x100); (0x400%positive, 0x200); (0x800%positive, 0x400); (0x1000%positive, 0x800); (0x2000%positive, 0x1000); (0x4000%positive, 0x2000); (0x8000%positive, 0x4000); (0x10000%positive, 0x8001); (0x20000%positive, 0x10002); (0x40000%positive, 0x20004); (0x80000%positive, 0x40008); (0x100000%positive, 0x80010); (0x200000%positive, 0x100020); (0x400000%positive, 0x200040); (0x800000%positive, 0x400080); (0x1000000%positive, 0x800100); (0x2000000%positive, 0x1000200); (0x4000000%positive, 0x2000400); (0x8000000%positive, 0x4000800); (0x10000000%positive, 0x8001000); (0x20000000%positive, 0x10002000); (0x40000000%positive, 0x20004000); (0x80000000%positive, 0x40008000); (0x10001%positive, 0x8000); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-right-31-all *)
Example suite_291 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf)))))))))))))))))))))))))))))))
  [(0x1%positive, Both R); (0x3%positive, Both R); (0x7%positive, Both R); (0xf%positive, Both R); (0x1f%positive, Both R); (0x3f%positive, Both R); (0x7f%positive, Both R); (0xff%positive, Both R); (0x1ff%positive, Both R); (0x3ff%positive, Both R); (0x7ff%positive, Both R); (0xfff%positive, Both R); (0x1fff%positive, Both R); (0x3fff%positive, Both R); (0x7fff%positive, Both R); (0xffff%positive, Both R); (0x1ffff%positive, Both R); (0x3ffff%positive, Both R); (0x7ffff%positive, Both R); (0xfffff%positive, Both R); (0x1fffff%positive, Both R); (0x3fffff%positive, Both R); (0x7fffff%positive, Both R); (0xffffff%positive, Both R); (0x1ffffff%positive, Both R); (0x3ffffff%positive, Both R); (0x7ffffff%positive, Both R); (0xfffffff%positive, Both R); (0x1fffffff%positive, Both R); (0x3fffffff%positive, Both R); (0x7fffffff%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x3); (0xf%positive, 0x7); (0x1f%positive, 0xf); (0x3f%positive, 0x1f); (0x7f%positive, 0x3f); (0xff%positive, 0x7f); (0x1ff%positive, 0xff); (0x3ff%positive, 0x1ff); (0x7ff%positive, 0x3ff); (0xfff%positive, 0x7ff); (0x1fff%positive, 0xfff); (0x3fff%positive, 0x1fff); (0x7fff%positive, 0x3fff); (0xffff%positive, 0x7fff); (0x1ffff%positive, 0xffff); (0x3ffff%positive, 0x1ffff); (0x7ffff%positive, 0x3ffff); (0xfffff%positive, 0x7ffff); (0x1fffff%positive, 0xfffff); (0x3fffff%positive, 0x1fffff); (0x7fffff%positive, 0x3fffff); (0xffffff%positive, 0x7fffff); (0x1ffffff%positive, 0xffffff); (0x3ffffff%positive, 0x1ffffff); (0x7ffffff%positive, 0x3ffffff); (0xfffffff%positive, 0x7ffffff); (0x1fffffff%positive, 0xfffffff); (0x3fffffff%positive, 0x1fffffff); (0x7fffffff%positive, 0x3fffffff); (0xffffffff%positive, 0x7fffffff); (0xfffffffe%positive, 0x7ffffffe); (0x7ffffffe%positive, 0x3ffffffe); (0x3ffffffe%positive, 0x1ffffffe); (0x1ffffffe%positive, 0xffffffe); (0xffffffe%positive, 0x7fffffe); (0x7fffffe%positive, 0x3fffffe); (0x3fffffe%positive, 0x1fffffe); (0x1fffffe%positive, 0xfffffe); (0xfffffe%positive, 0x7ffffe); (0x7ffffe%positive, 0x3ffffe); (0x3ffffe%positive, 0x1ffffe); (0x1ffffe%positive, 0xffffe); (0xffffe%positive, 0x7fffe); (0x7fffe%positive, 0x3fffe); (0x3fffe%positive, 0x1fffe); (0x1fffe%positive, 0xfffe); (0xfffe%positive, 0x7ffe); (0x7ffe%positive, 0x3ffe); (0x3ffe%positive, 0x1ffe); (0x1ffe%positive, 0xffe); (0xffe%positive, 0x7fe); (0x7fe%positive, 0x3fe); (0x3fe%positive, 0x1fe); (0x1fe%positive, 0xfe); (0xfe%positive, 0x7e); (0x7e%positive, 0x3e); (0x3e%positive, 0x1e); (0x1e%positive, 0xe); (0xe%positive, 0x6); (0x6%positive, 0x2); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-right-31-first *)
Example suite_292 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf)))))))))))))))))))))))))))))))
  [(0x1%positive, Both R); (0x3%positive, Only R); (0x7%positive, Only R); (0xf%positive, Only R); (0x1f%positive, Only R); (0x3f%positive, Only R); (0x7f%positive, Only R); (0xff%positive, Only R); (0x1ff%positive, Only R); (0x3ff%positive, Only R); (0x7ff%positive, Only R); (0xfff%positive, Only R); (0x1fff%positive, Only R); (0x3fff%positive, Only R); (0x7fff%positive, Only R); (0xffff%positive, Only R); (0x1ffff%positive, Only R); (0x3ffff%positive, Only R); (0x7ffff%positive, Only R); (0xfffff%positive, Only R); (0x1fffff%positive, Only R); (0x3fffff%positive, Only R); (0x7fffff%positive, Only R); (0xffffff%positive, Only R); (0x1ffffff%positive, Only R); (0x3ffffff%positive, Only R); (0x7ffffff%positive, Only R); (0xfffffff%positive, Only R); (0x1fffffff%positive, Only R); (0x3fffffff%positive, Only R); (0x7fffffff%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x2); (0xf%positive, 0x4); (0x1f%positive, 0x8); (0x3f%positive, 0x10); (0x7f%positive, 0x20); (0xff%positive, 0x40); (0x1ff%positive, 0x80); (0x3ff%positive, 0x100); (0x7ff%positive, 0x200); (0xfff%positive, 0x400); (0x1fff%positive, 0x800); (0x3fff%positive, 0x1000); (0x7fff%positive, 0x2000); (0xffff%positive, 0x4000); (0x1ffff%positive, 0x8000); (0x3ffff%positive, 0x10000); (0x7ffff%positive, 0x20000); (0xfffff%positive, 0x40000); (0x1fffff%positive, 0x80000); (0x3fffff%positive, 0x100000); (0x7fffff%positive, 0x200000); (0xffffff%positive, 0x400000); (0x1ffffff%positive, 0x800000); (0x3ffffff%positive, 0x1000000); (0x7ffffff%positive, 0x2000000); (0xfffffff%positive, 0x4000000); (0x1fffffff%positive, 0x8000000); (0x3fffffff%positive, 0x10000000); (0x7fffffff%positive, 0x20000000); (0xffffffff%positive, 0x40000000); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-right-31-two-1 *)
Example suite_293 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf)))))))))))))))))))))))))))))))
  [(0x1%positive, Both R); (0x3%positive, Both R); (0x7%positive, Only R); (0xf%positive, Only R); (0x1f%positive, Only R); (0x3f%positive, Only R); (0x7f%positive, Only R); (0xff%positive, Only R); (0x1ff%positive, Only R); (0x3ff%positive, Only R); (0x7ff%positive, Only R); (0xfff%positive, Only R); (0x1fff%positive, Only R); (0x3fff%positive, Only R); (0x7fff%positive, Only R); (0xffff%positive, Only R); (0x1ffff%positive, Only R); (0x3ffff%positive, Only R); (0x7ffff%positive, Only R); (0xfffff%positive, Only R); (0x1fffff%positive, Only R); (0x3fffff%positive, Only R); (0x7fffff%positive, Only R); (0xffffff%positive, Only R); (0x1ffffff%positive, Only R); (0x3ffffff%positive, Only R); (0x7ffffff%positive, Only R); (0xfffffff%positive, Only R); (0x1fffffff%positive, Only R); (0x3fffffff%positive, Only R); (0x7fffffff%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x3); (0xf%positive, 0x6); (0x1f%positive, 0xc); (0x3f%positive, 0x18); (0x7f%positive, 0x30); (0xff%positive, 0x60); (0x1ff%positive, 0xc0); (0x3ff%positive, 0x180); (0x7ff%positive, 0x300); (0xfff%positive, 0x600); (0x1fff%positive, 0xc00); (0x3fff%positive, 0x1800); (0x7fff%positive, 0x3000); (0xffff%positive, 0x6000); (0x1ffff%positive, 0xc000); (0x3ffff%positive, 0x18000); (0x7ffff%positive, 0x30000); (0xfffff%positive, 0x60000); (0x1fffff%positive, 0xc0000); (0x3fffff%positive, 0x180000); (0x7fffff%positive, 0x300000); (0xffffff%positive, 0x600000); (0x1ffffff%positive, 0xc00000); (0x3ffffff%positive, 0x1800000); (0x7ffffff%positive, 0x3000000); (0xfffffff%positive, 0x6000000); (0x1fffffff%positive, 0xc000000); (0x3fffffff%positive, 0x18000000); (0x7fffffff%positive, 0x30000000); (0xffffffff%positive, 0x60000000); (0x6%positive, 0x2); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-right-31-two-2 *)
Example suite_294 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf)))))))))))))))))))))))))))))))
  [(0x1%positive, Both R); (0x3%positive, Only R); (0x7%positive, Both R); (0xf%positive, Only R); (0x1f%positive, Only R); (0x3f%positive, Only R); (0x7f%positive, Only R); (0xff%positive, Only R); (0x1ff%positive, Only R); (0x3ff%positive, Only R); (0x7ff%positive, Only R); (0xfff%positive, Only R); (0x1fff%positive, Only R); (0x3fff%positive, Only R); (0x7fff%positive, Only R); (0xffff%positive, Only R); (0x1ffff%positive, Only R); (0x3ffff%positive, Only R); (0x7ffff%positive, Only R); (0xfffff%positive, Only R); (0x1fffff%positive, Only R); (0x3fffff%positive, Only R); (0x7fffff%positive, Only R); (0xffffff%positive, Only R); (0x1ffffff%positive, Only R); (0x3ffffff%positive, Only R); (0x7ffffff%positive, Only R); (0xfffffff%positive, Only R); (0x1fffffff%positive, Only R); (0x3fffffff%positive, Only R); (0x7fffffff%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x2); (0xf%positive, 0x5); (0x1f%positive, 0xa); (0x3f%positive, 0x14); (0x7f%positive, 0x28); (0xff%positive, 0x50); (0x1ff%positive, 0xa0); (0x3ff%positive, 0x140); (0x7ff%positive, 0x280); (0xfff%positive, 0x500); (0x1fff%positive, 0xa00); (0x3fff%positive, 0x1400); (0x7fff%positive, 0x2800); (0xffff%positive, 0x5000); (0x1ffff%positive, 0xa000); (0x3ffff%positive, 0x14000); (0x7ffff%positive, 0x28000); (0xfffff%positive, 0x50000); (0x1fffff%positive, 0xa0000); (0x3fffff%positive, 0x140000); (0x7fffff%positive, 0x280000); (0xffffff%positive, 0x500000); (0x1ffffff%positive, 0xa00000); (0x3ffffff%positive, 0x1400000); (0x7ffffff%positive, 0x2800000); (0xfffffff%positive, 0x5000000); (0x1fffffff%positive, 0xa000000); (0x3fffffff%positive, 0x14000000); (0x7fffffff%positive, 0x28000000); (0xffffffff%positive, 0x50000000); (0xe%positive, 0x4); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-right-31-two-3 *)
Example suite_295 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf)))))))))))))))))))))))))))))))
  [(0x1%positive, Both R); (0x3%positive, Only R); (0x7%positive, Only R); (0xf%positive, Both R); (0x1f%positive, Only R); (0x3f%positive, Only R); (0x7f%positive, Only R); (0xff%positive, Only R); (0x1ff%positive, Only R); (0x3ff%positive, Only R); (0x7ff%positive, Only R); (0xfff%positive, Only R); (0x1fff%positive, Only R); (0x3fff%positive, Only R); (0x7fff%positive, Only R); (0xffff%positive, Only R); (0x1ffff%positive, Only R); (0x3ffff%positive, Only R); (0x7ffff%positive, Only R); (0xfffff%positive, Only R); (0x1fffff%positive, Only R); (0x3fffff%positive, Only R); (0x7fffff%positive, Only R); (0xffffff%positive, Only R); (0x1ffffff%positive, Only R); (0x3ffffff%positive, Only R); (0x7ffffff%positive, Only R); (0xfffffff%positive, Only R); (0x1fffffff%positive, Only R); (0x3fffffff%positive, Only R); (0x7fffffff%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x2); (0xf%positive, 0x4); (0x1f%positive, 0x9); (0x3f%positive, 0x12); (0x7f%positive, 0x24); (0xff%positive, 0x48); (0x1ff%positive, 0x90); (0x3ff%positive, 0x120); (0x7ff%positive, 0x240); (0xfff%positive, 0x480); (0x1fff%positive, 0x900); (0x3fff%positive, 0x1200); (0x7fff%positive, 0x2400); (0xffff%positive, 0x4800); (0x1ffff%positive, 0x9000); (0x3ffff%positive, 0x12000); (0x7ffff%positive, 0x24000); (0xfffff%positive, 0x48000); (0x1fffff%positive, 0x90000); (0x3fffff%positive, 0x120000); (0x7fffff%positive, 0x240000); (0xffffff%positive, 0x480000); (0x1ffffff%positive, 0x900000); (0x3ffffff%positive, 0x1200000); (0x7ffffff%positive, 0x2400000); (0xfffffff%positive, 0x4800000); (0x1fffffff%positive, 0x9000000); (0x3fffffff%positive, 0x12000000); (0x7fffffff%positive, 0x24000000); (0xffffffff%positive, 0x48000000); (0x1e%positive, 0x8); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-right-31-two-4 *)
Example suite_296 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf)))))))))))))))))))))))))))))))
  [(0x1%positive, Both R); (0x3%positive, Only R); (0x7%positive, Only R); (0xf%positive, Only R); (0x1f%positive, Both R); (0x3f%positive, Only R); (0x7f%positive, Only R); (0xff%positive, Only R); (0x1ff%positive, Only R); (0x3ff%positive, Only R); (0x7ff%positive, Only R); (0xfff%positive, Only R); (0x1fff%positive, Only R); (0x3fff%positive, Only R); (0x7fff%positive, Only R); (0xffff%positive, Only R); (0x1ffff%positive, Only R); (0x3ffff%positive, Only R); (0x7ffff%positive, Only R); (0xfffff%positive, Only R); (0x1fffff%positive, Only R); (0x3fffff%positive, Only R); (0x7fffff%positive, Only R); (0xffffff%positive, Only R); (0x1ffffff%positive, Only R); (0x3ffffff%positive, Only R); (0x7ffffff%positive, Only R); (0xfffffff%positive, Only R); (0x1fffffff%positive, Only R); (0x3fffffff%positive, Only R); (0x7fffffff%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x2); (0xf%positive, 0x4); (0x1f%positive, 0x8); (0x3f%positive, 0x11); (0x7f%positive, 0x22); (0xff%positive, 0x44); (0x1ff%positive, 0x88); (0x3ff%positive, 0x110); (0x7ff%positive, 0x220); (0xfff%positive, 0x440); (0x1fff%positive, 0x880); (0x3fff%positive, 0x1100); (0x7fff%positive, 0x2200); (0xffff%positive, 0x4400); (0x1ffff%positive, 0x8800); (0x3ffff%positive, 0x11000); (0x7ffff%positive, 0x22000); (0xfffff%positive, 0x44000); (0x1fffff%positive, 0x88000); (0x3fffff%positive, 0x110000); (0x7fffff%positive, 0x220000); (0xffffff%positive, 0x440000); (0x1ffffff%positive, 0x880000); (0x3ffffff%positive, 0x1100000); (0x7ffffff%positive, 0x2200000); (0xfffffff%positive, 0x4400000); (0x1fffffff%positive, 0x8800000); (0x3fffffff%positive, 0x11000000); (0x7fffffff%positive, 0x22000000); (0xffffffff%positive, 0x44000000); (0x3e%positive, 0x10); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-right-31-two-15 *)
Example suite_297 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf)))))))))))))))))))))))))))))))
  [(0x1%positive, Both R); (0x3%positive, Only R); (0x7%positive, Only R); (0xf%positive, Only R); (0x1f%positive, Only R); (0x3f%positive, Only R); (0x7f%positive, Only R); (0xff%positive, Only R); (0x1ff%positive, Only R); (0x3ff%positive, Only R); (0x7ff%positive, Only R); (0xfff%positive, Only R); (0x1fff%positive, Only R); (0x3fff%positive, Only R); (0x7fff%positive, Only R); (0xffff%positive, Both R); (0x1ffff%positive, Only R); (0x3ffff%positive, Only R); (0x7ffff%positive, Only R); (0xfffff%positive, Only R); (0x1fffff%positive, Only R); (0x3fffff%positive, Only R); (0x7fffff%positive, Only R); (0xffffff%positive, Only R); (0x1ffffff%positive, Only R); (0x3ffffff%positive, Only R); (0x7ffffff%positive, Only R); (0xfffffff%positive, Only R); (0x1fffffff%positive, Only R); (0x3fffffff%positive, Only R); (0x7fffffff%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x2); (0xf%positive, 0x4); (0x1f%positive, 0x8); (0x3f%positive, 0x10); (0x7f%positive, 0x20); (0xff%positive, 0x40); (0x1ff%positive, 0x80); (0x3ff%positive, 0x100); (0x7ff%positive, 0x200); (0xfff%positive, 0x400); (0x1fff%positive, 0x800); (0x3fff%positive, 0x1000); (0x7fff%positive, 0x2000); (0xffff%positive, 0x4000); (0x1ffff%positive, 0x8001); (0x3ffff%positive, 0x10002); (0x7ffff%positive, 0x20004); (0xfffff%positive, 0x40008); (0x1fffff%positive, 0x80010); (0x3fffff%positive, 0x100020); (0x7fffff%positive, 0x200040); (0xffffff%positive, 0x400080); (0x1ffffff%positive, 0x800100); (0x3ffffff%positive, 0x1000200); (0x7ffffff%positive, 0x2000400); (0xfffffff%positive, 0x4000800); (0x1fffffff%positive, 0x8001000); (0x3fffffff%positive, 0x10002000); (0x7fffffff%positive, 0x20004000); (0xffffffff%positive, 0x40008000); (0x1fffe%positive, 0x8000); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-turns-31-all *)
Example suite_298 : suite_seen (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node Leaf Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Both R); (0x5%positive, Both L); (0xa%positive, Both R); (0x15%positive, Both L); (0x2a%positive, Both R); (0x55%positive, Both L); (0xaa%positive, Both R); (0x155%positive, Both L); (0x2aa%positive, Both R); (0x555%positive, Both L); (0xaaa%positive, Both R); (0x1555%positive, Both L); (0x2aaa%positive, Both R); (0x5555%positive, Both L); (0xaaaa%positive, Both R); (0x15555%positive, Both L); (0x2aaaa%positive, Both R); (0x55555%positive, Both L); (0xaaaaa%positive, Both R); (0x155555%positive, Both L); (0x2aaaaa%positive, Both R); (0x555555%positive, Both L); (0xaaaaaa%positive, Both R); (0x1555555%positive, Both L); (0x2aaaaaa%positive, Both R); (0x5555555%positive, Both L); (0xaaaaaaa%positive, Both R); (0x15555555%positive, Both L); (0x2aaaaaaa%positive, Both R); (0x55555555%positive, Both L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x3); (0xa%positive, 0x7); (0x15%positive, 0xf); (0x2a%positive, 0x1f); (0x55%positive, 0x3f); (0xaa%positive, 0x7f); (0x155%positive, 0xff); (0x2aa%positive, 0x1ff); (0x555%positive, 0x3ff); (0xaaa%positive, 0x7ff); (0x1555%positive, 0xfff); (0x2aaa%positive, 0x1fff); (0x5555%positive, 0x3fff); (0xaaaa%positive, 0x7fff); (0x15555%positive, 0xffff); (0x2aaaa%positive, 0x1ffff); (0x55555%positive, 0x3ffff); (0xaaaaa%positive, 0x7ffff); (0x155555%positive, 0xfffff); (0x2aaaaa%positive, 0x1fffff); (0x555555%positive, 0x3fffff); (0xaaaaaa%positive, 0x7fffff); (0x1555555%positive, 0xffffff); (0x2aaaaaa%positive, 0x1ffffff); (0x5555555%positive, 0x3ffffff); (0xaaaaaaa%positive, 0x7ffffff); (0x15555555%positive, 0xfffffff); (0x2aaaaaaa%positive, 0x1fffffff); (0x55555555%positive, 0x3fffffff); (0xaaaaaaaa%positive, 0x7fffffff); (0xaaaaaaab%positive, 0x7ffffffe); (0x55555554%positive, 0x3ffffffe); (0x2aaaaaab%positive, 0x1ffffffe); (0x15555554%positive, 0xffffffe); (0xaaaaaab%positive, 0x7fffffe); (0x5555554%positive, 0x3fffffe); (0x2aaaaab%positive, 0x1fffffe); (0x1555554%positive, 0xfffffe); (0xaaaaab%positive, 0x7ffffe); (0x555554%positive, 0x3ffffe); (0x2aaaab%positive, 0x1ffffe); (0x155554%positive, 0xffffe); (0xaaaab%positive, 0x7fffe); (0x55554%positive, 0x3fffe); (0x2aaab%positive, 0x1fffe); (0x15554%positive, 0xfffe); (0xaaab%positive, 0x7ffe); (0x5554%positive, 0x3ffe); (0x2aab%positive, 0x1ffe); (0x1554%positive, 0xffe); (0xaab%positive, 0x7fe); (0x554%positive, 0x3fe); (0x2ab%positive, 0x1fe); (0x154%positive, 0xfe); (0xab%positive, 0x7e); (0x54%positive, 0x3e); (0x2b%positive, 0x1e); (0x14%positive, 0xe); (0xb%positive, 0x6); (0x4%positive, 0x2); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-turns-31-first *)
Example suite_299 : suite_seen (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node Leaf Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only R); (0x5%positive, Only L); (0xa%positive, Only R); (0x15%positive, Only L); (0x2a%positive, Only R); (0x55%positive, Only L); (0xaa%positive, Only R); (0x155%positive, Only L); (0x2aa%positive, Only R); (0x555%positive, Only L); (0xaaa%positive, Only R); (0x1555%positive, Only L); (0x2aaa%positive, Only R); (0x5555%positive, Only L); (0xaaaa%positive, Only R); (0x15555%positive, Only L); (0x2aaaa%positive, Only R); (0x55555%positive, Only L); (0xaaaaa%positive, Only R); (0x155555%positive, Only L); (0x2aaaaa%positive, Only R); (0x555555%positive, Only L); (0xaaaaaa%positive, Only R); (0x1555555%positive, Only L); (0x2aaaaaa%positive, Only R); (0x5555555%positive, Only L); (0xaaaaaaa%positive, Only R); (0x15555555%positive, Only L); (0x2aaaaaaa%positive, Only R); (0x55555555%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x2); (0xa%positive, 0x4); (0x15%positive, 0x8); (0x2a%positive, 0x10); (0x55%positive, 0x20); (0xaa%positive, 0x40); (0x155%positive, 0x80); (0x2aa%positive, 0x100); (0x555%positive, 0x200); (0xaaa%positive, 0x400); (0x1555%positive, 0x800); (0x2aaa%positive, 0x1000); (0x5555%positive, 0x2000); (0xaaaa%positive, 0x4000); (0x15555%positive, 0x8000); (0x2aaaa%positive, 0x10000); (0x55555%positive, 0x20000); (0xaaaaa%positive, 0x40000); (0x155555%positive, 0x80000); (0x2aaaaa%positive, 0x100000); (0x555555%positive, 0x200000); (0xaaaaaa%positive, 0x400000); (0x1555555%positive, 0x800000); (0x2aaaaaa%positive, 0x1000000); (0x5555555%positive, 0x2000000); (0xaaaaaaa%positive, 0x4000000); (0x15555555%positive, 0x8000000); (0x2aaaaaaa%positive, 0x10000000); (0x55555555%positive, 0x20000000); (0xaaaaaaaa%positive, 0x40000000); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-turns-31-two-1 *)
Example suite_300 : suite_seen (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node Leaf Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Both R); (0x5%positive, Only L); (0xa%positive, Only R); (0x15%positive, Only L); (0x2a%positive, Only R); (0x55%positive, Only L); (0xaa%positive, Only R); (0x155%positive, Only L); (0x2aa%positive, Only R); (0x555%positive, Only L); (0xaaa%positive, Only R); (0x1555%positive, Only L); (0x2aaa%positive, Only R); (0x5555%positive, Only L); (0xaaaa%positive, Only R); (0x15555%positive, Only L); (0x2aaaa%positive, Only R); (0x55555%positive, Only L); (0xaaaaa%positive, Only R); (0x155555%positive, Only L); (0x2aaaaa%positive, Only R); (0x555555%positive, Only L); (0xaaaaaa%positive, Only R); (0x1555555%positive, Only L); (0x2aaaaaa%positive, Only R); (0x5555555%positive, Only L); (0xaaaaaaa%positive, Only R); (0x15555555%positive, Only L); (0x2aaaaaaa%positive, Only R); (0x55555555%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x3); (0xa%positive, 0x6); (0x15%positive, 0xc); (0x2a%positive, 0x18); (0x55%positive, 0x30); (0xaa%positive, 0x60); (0x155%positive, 0xc0); (0x2aa%positive, 0x180); (0x555%positive, 0x300); (0xaaa%positive, 0x600); (0x1555%positive, 0xc00); (0x2aaa%positive, 0x1800); (0x5555%positive, 0x3000); (0xaaaa%positive, 0x6000); (0x15555%positive, 0xc000); (0x2aaaa%positive, 0x18000); (0x55555%positive, 0x30000); (0xaaaaa%positive, 0x60000); (0x155555%positive, 0xc0000); (0x2aaaaa%positive, 0x180000); (0x555555%positive, 0x300000); (0xaaaaaa%positive, 0x600000); (0x1555555%positive, 0xc00000); (0x2aaaaaa%positive, 0x1800000); (0x5555555%positive, 0x3000000); (0xaaaaaaa%positive, 0x6000000); (0x15555555%positive, 0xc000000); (0x2aaaaaaa%positive, 0x18000000); (0x55555555%positive, 0x30000000); (0xaaaaaaaa%positive, 0x60000000); (0x4%positive, 0x2); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-turns-31-two-2 *)
Example suite_301 : suite_seen (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node Leaf Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only R); (0x5%positive, Both L); (0xa%positive, Only R); (0x15%positive, Only L); (0x2a%positive, Only R); (0x55%positive, Only L); (0xaa%positive, Only R); (0x155%positive, Only L); (0x2aa%positive, Only R); (0x555%positive, Only L); (0xaaa%positive, Only R); (0x1555%positive, Only L); (0x2aaa%positive, Only R); (0x5555%positive, Only L); (0xaaaa%positive, Only R); (0x15555%positive, Only L); (0x2aaaa%positive, Only R); (0x55555%positive, Only L); (0xaaaaa%positive, Only R); (0x155555%positive, Only L); (0x2aaaaa%positive, Only R); (0x555555%positive, Only L); (0xaaaaaa%positive, Only R); (0x1555555%positive, Only L); (0x2aaaaaa%positive, Only R); (0x5555555%positive, Only L); (0xaaaaaaa%positive, Only R); (0x15555555%positive, Only L); (0x2aaaaaaa%positive, Only R); (0x55555555%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x2); (0xa%positive, 0x5); (0x15%positive, 0xa); (0x2a%positive, 0x14); (0x55%positive, 0x28); (0xaa%positive, 0x50); (0x155%positive, 0xa0); (0x2aa%positive, 0x140); (0x555%positive, 0x280); (0xaaa%positive, 0x500); (0x1555%positive, 0xa00); (0x2aaa%positive, 0x1400); (0x5555%positive, 0x2800); (0xaaaa%positive, 0x5000); (0x15555%positive, 0xa000); (0x2aaaa%positive, 0x14000); (0x55555%positive, 0x28000); (0xaaaaa%positive, 0x50000); (0x155555%positive, 0xa0000); (0x2aaaaa%positive, 0x140000); (0x555555%positive, 0x280000); (0xaaaaaa%positive, 0x500000); (0x1555555%positive, 0xa00000); (0x2aaaaaa%positive, 0x1400000); (0x5555555%positive, 0x2800000); (0xaaaaaaa%positive, 0x5000000); (0x15555555%positive, 0xa000000); (0x2aaaaaaa%positive, 0x14000000); (0x55555555%positive, 0x28000000); (0xaaaaaaaa%positive, 0x50000000); (0xb%positive, 0x4); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-turns-31-two-3 *)
Example suite_302 : suite_seen (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node Leaf Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only R); (0x5%positive, Only L); (0xa%positive, Both R); (0x15%positive, Only L); (0x2a%positive, Only R); (0x55%positive, Only L); (0xaa%positive, Only R); (0x155%positive, Only L); (0x2aa%positive, Only R); (0x555%positive, Only L); (0xaaa%positive, Only R); (0x1555%positive, Only L); (0x2aaa%positive, Only R); (0x5555%positive, Only L); (0xaaaa%positive, Only R); (0x15555%positive, Only L); (0x2aaaa%positive, Only R); (0x55555%positive, Only L); (0xaaaaa%positive, Only R); (0x155555%positive, Only L); (0x2aaaaa%positive, Only R); (0x555555%positive, Only L); (0xaaaaaa%positive, Only R); (0x1555555%positive, Only L); (0x2aaaaaa%positive, Only R); (0x5555555%positive, Only L); (0xaaaaaaa%positive, Only R); (0x15555555%positive, Only L); (0x2aaaaaaa%positive, Only R); (0x55555555%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x2); (0xa%positive, 0x4); (0x15%positive, 0x9); (0x2a%positive, 0x12); (0x55%positive, 0x24); (0xaa%positive, 0x48); (0x155%positive, 0x90); (0x2aa%positive, 0x120); (0x555%positive, 0x240); (0xaaa%positive, 0x480); (0x1555%positive, 0x900); (0x2aaa%positive, 0x1200); (0x5555%positive, 0x2400); (0xaaaa%positive, 0x4800); (0x15555%positive, 0x9000); (0x2aaaa%positive, 0x12000); (0x55555%positive, 0x24000); (0xaaaaa%positive, 0x48000); (0x155555%positive, 0x90000); (0x2aaaaa%positive, 0x120000); (0x555555%positive, 0x240000); (0xaaaaaa%positive, 0x480000); (0x1555555%positive, 0x900000); (0x2aaaaaa%positive, 0x1200000); (0x5555555%positive, 0x2400000); (0xaaaaaaa%positive, 0x4800000); (0x15555555%positive, 0x9000000); (0x2aaaaaaa%positive, 0x12000000); (0x55555555%positive, 0x24000000); (0xaaaaaaaa%positive, 0x48000000); (0x14%positive, 0x8); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-turns-31-two-4 *)
Example suite_303 : suite_seen (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node Leaf Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only R); (0x5%positive, Only L); (0xa%positive, Only R); (0x15%positive, Both L); (0x2a%positive, Only R); (0x55%positive, Only L); (0xaa%positive, Only R); (0x155%positive, Only L); (0x2aa%positive, Only R); (0x555%positive, Only L); (0xaaa%positive, Only R); (0x1555%positive, Only L); (0x2aaa%positive, Only R); (0x5555%positive, Only L); (0xaaaa%positive, Only R); (0x15555%positive, Only L); (0x2aaaa%positive, Only R); (0x55555%positive, Only L); (0xaaaaa%positive, Only R); (0x155555%positive, Only L); (0x2aaaaa%positive, Only R); (0x555555%positive, Only L); (0xaaaaaa%positive, Only R); (0x1555555%positive, Only L); (0x2aaaaaa%positive, Only R); (0x5555555%positive, Only L); (0xaaaaaaa%positive, Only R); (0x15555555%positive, Only L); (0x2aaaaaaa%positive, Only R); (0x55555555%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x2); (0xa%positive, 0x4); (0x15%positive, 0x8); (0x2a%positive, 0x11); (0x55%positive, 0x22); (0xaa%positive, 0x44); (0x155%positive, 0x88); (0x2aa%positive, 0x110); (0x555%positive, 0x220); (0xaaa%positive, 0x440); (0x1555%positive, 0x880); (0x2aaa%positive, 0x1100); (0x5555%positive, 0x2200); (0xaaaa%positive, 0x4400); (0x15555%positive, 0x8800); (0x2aaaa%positive, 0x11000); (0x55555%positive, 0x22000); (0xaaaaa%positive, 0x44000); (0x155555%positive, 0x88000); (0x2aaaaa%positive, 0x110000); (0x555555%positive, 0x220000); (0xaaaaaa%positive, 0x440000); (0x1555555%positive, 0x880000); (0x2aaaaaa%positive, 0x1100000); (0x5555555%positive, 0x2200000); (0xaaaaaaa%positive, 0x4400000); (0x15555555%positive, 0x8800000); (0x2aaaaaaa%positive, 0x11000000); (0x55555555%positive, 0x22000000); (0xaaaaaaaa%positive, 0x44000000); (0x2b%positive, 0x10); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-turns-31-two-15 *)
Example suite_304 : suite_seen (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node Leaf Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only R); (0x5%positive, Only L); (0xa%positive, Only R); (0x15%positive, Only L); (0x2a%positive, Only R); (0x55%positive, Only L); (0xaa%positive, Only R); (0x155%positive, Only L); (0x2aa%positive, Only R); (0x555%positive, Only L); (0xaaa%positive, Only R); (0x1555%positive, Only L); (0x2aaa%positive, Only R); (0x5555%positive, Only L); (0xaaaa%positive, Both R); (0x15555%positive, Only L); (0x2aaaa%positive, Only R); (0x55555%positive, Only L); (0xaaaaa%positive, Only R); (0x155555%positive, Only L); (0x2aaaaa%positive, Only R); (0x555555%positive, Only L); (0xaaaaaa%positive, Only R); (0x1555555%positive, Only L); (0x2aaaaaa%positive, Only R); (0x5555555%positive, Only L); (0xaaaaaaa%positive, Only R); (0x15555555%positive, Only L); (0x2aaaaaaa%positive, Only R); (0x55555555%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x2); (0xa%positive, 0x4); (0x15%positive, 0x8); (0x2a%positive, 0x10); (0x55%positive, 0x20); (0xaa%positive, 0x40); (0x155%positive, 0x80); (0x2aa%positive, 0x100); (0x555%positive, 0x200); (0xaaa%positive, 0x400); (0x1555%positive, 0x800); (0x2aaa%positive, 0x1000); (0x5555%positive, 0x2000); (0xaaaa%positive, 0x4000); (0x15555%positive, 0x8001); (0x2aaaa%positive, 0x10002); (0x55555%positive, 0x20004); (0xaaaaa%positive, 0x40008); (0x155555%positive, 0x80010); (0x2aaaaa%positive, 0x100020); (0x555555%positive, 0x200040); (0xaaaaaa%positive, 0x400080); (0x1555555%positive, 0x800100); (0x2aaaaaa%positive, 0x1000200); (0x5555555%positive, 0x2000400); (0xaaaaaaa%positive, 0x4000800); (0x15555555%positive, 0x8001000); (0x2aaaaaaa%positive, 0x10002000); (0x55555555%positive, 0x20004000); (0xaaaaaaaa%positive, 0x40008000); (0x15554%positive, 0x8000); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-32-all *)
Example suite_305 : suite_seen (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Both L); (0x4%positive, Both L); (0x8%positive, Both L); (0x10%positive, Both L); (0x20%positive, Both L); (0x40%positive, Both L); (0x80%positive, Both L); (0x100%positive, Both L); (0x200%positive, Both L); (0x400%positive, Both L); (0x800%positive, Both L); (0x1000%positive, Both L); (0x2000%positive, Both L); (0x4000%positive, Both L); (0x8000%positive, Both L); (0x10000%positive, Both L); (0x20000%positive, Both L); (0x40000%positive, Both L); (0x80000%positive, Both L); (0x100000%positive, Both L); (0x200000%positive, Both L); (0x400000%positive, Both L); (0x800000%positive, Both L); (0x1000000%positive, Both L); (0x2000000%positive, Both L); (0x4000000%positive, Both L); (0x8000000%positive, Both L); (0x10000000%positive, Both L); (0x20000000%positive, Both L); (0x40000000%positive, Both L); (0x80000000%positive, Both L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x3); (0x8%positive, 0x7); (0x10%positive, 0xf); (0x20%positive, 0x1f); (0x40%positive, 0x3f); (0x80%positive, 0x7f); (0x100%positive, 0xff); (0x200%positive, 0x1ff); (0x400%positive, 0x3ff); (0x800%positive, 0x7ff); (0x1000%positive, 0xfff); (0x2000%positive, 0x1fff); (0x4000%positive, 0x3fff); (0x8000%positive, 0x7fff); (0x10000%positive, 0xffff); (0x20000%positive, 0x1ffff); (0x40000%positive, 0x3ffff); (0x80000%positive, 0x7ffff); (0x100000%positive, 0xfffff); (0x200000%positive, 0x1fffff); (0x400000%positive, 0x3fffff); (0x800000%positive, 0x7fffff); (0x1000000%positive, 0xffffff); (0x2000000%positive, 0x1ffffff); (0x4000000%positive, 0x3ffffff); (0x8000000%positive, 0x7ffffff); (0x10000000%positive, 0xfffffff); (0x20000000%positive, 0x1fffffff); (0x40000000%positive, 0x3fffffff); (0x80000000%positive, 0x7fffffff); (0x100000000%positive, 0xffffffff); (0x100000001%positive, 0xfffffffe); (0x80000001%positive, 0x7ffffffe); (0x40000001%positive, 0x3ffffffe); (0x20000001%positive, 0x1ffffffe); (0x10000001%positive, 0xffffffe); (0x8000001%positive, 0x7fffffe); (0x4000001%positive, 0x3fffffe); (0x2000001%positive, 0x1fffffe); (0x1000001%positive, 0xfffffe); (0x800001%positive, 0x7ffffe); (0x400001%positive, 0x3ffffe); (0x200001%positive, 0x1ffffe); (0x100001%positive, 0xffffe); (0x80001%positive, 0x7fffe); (0x40001%positive, 0x3fffe); (0x20001%positive, 0x1fffe); (0x10001%positive, 0xfffe); (0x8001%positive, 0x7ffe); (0x4001%positive, 0x3ffe); (0x2001%positive, 0x1ffe); (0x1001%positive, 0xffe); (0x801%positive, 0x7fe); (0x401%positive, 0x3fe); (0x201%positive, 0x1fe); (0x101%positive, 0xfe); (0x81%positive, 0x7e); (0x41%positive, 0x3e); (0x21%positive, 0x1e); (0x11%positive, 0xe); (0x9%positive, 0x6); (0x5%positive, 0x2); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-32-first *)
Example suite_306 : suite_seen (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Only L); (0x8%positive, Only L); (0x10%positive, Only L); (0x20%positive, Only L); (0x40%positive, Only L); (0x80%positive, Only L); (0x100%positive, Only L); (0x200%positive, Only L); (0x400%positive, Only L); (0x800%positive, Only L); (0x1000%positive, Only L); (0x2000%positive, Only L); (0x4000%positive, Only L); (0x8000%positive, Only L); (0x10000%positive, Only L); (0x20000%positive, Only L); (0x40000%positive, Only L); (0x80000%positive, Only L); (0x100000%positive, Only L); (0x200000%positive, Only L); (0x400000%positive, Only L); (0x800000%positive, Only L); (0x1000000%positive, Only L); (0x2000000%positive, Only L); (0x4000000%positive, Only L); (0x8000000%positive, Only L); (0x10000000%positive, Only L); (0x20000000%positive, Only L); (0x40000000%positive, Only L); (0x80000000%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x8%positive, 0x4); (0x10%positive, 0x8); (0x20%positive, 0x10); (0x40%positive, 0x20); (0x80%positive, 0x40); (0x100%positive, 0x80); (0x200%positive, 0x100); (0x400%positive, 0x200); (0x800%positive, 0x400); (0x1000%positive, 0x800); (0x2000%positive, 0x1000); (0x4000%positive, 0x2000); (0x8000%positive, 0x4000); (0x10000%positive, 0x8000); (0x20000%positive, 0x10000); (0x40000%positive, 0x20000); (0x80000%positive, 0x40000); (0x100000%positive, 0x80000); (0x200000%positive, 0x100000); (0x400000%positive, 0x200000); (0x800000%positive, 0x400000); (0x1000000%positive, 0x800000); (0x2000000%positive, 0x1000000); (0x4000000%positive, 0x2000000); (0x8000000%positive, 0x4000000); (0x10000000%positive, 0x8000000); (0x20000000%positive, 0x10000000); (0x40000000%positive, 0x20000000); (0x80000000%positive, 0x40000000); (0x100000000%positive, 0x80000000); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-32-two-1 *)
Example suite_307 : suite_seen (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Both L); (0x4%positive, Only L); (0x8%positive, Only L); (0x10%positive, Only L); (0x20%positive, Only L); (0x40%positive, Only L); (0x80%positive, Only L); (0x100%positive, Only L); (0x200%positive, Only L); (0x400%positive, Only L); (0x800%positive, Only L); (0x1000%positive, Only L); (0x2000%positive, Only L); (0x4000%positive, Only L); (0x8000%positive, Only L); (0x10000%positive, Only L); (0x20000%positive, Only L); (0x40000%positive, Only L); (0x80000%positive, Only L); (0x100000%positive, Only L); (0x200000%positive, Only L); (0x400000%positive, Only L); (0x800000%positive, Only L); (0x1000000%positive, Only L); (0x2000000%positive, Only L); (0x4000000%positive, Only L); (0x8000000%positive, Only L); (0x10000000%positive, Only L); (0x20000000%positive, Only L); (0x40000000%positive, Only L); (0x80000000%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x3); (0x8%positive, 0x6); (0x10%positive, 0xc); (0x20%positive, 0x18); (0x40%positive, 0x30); (0x80%positive, 0x60); (0x100%positive, 0xc0); (0x200%positive, 0x180); (0x400%positive, 0x300); (0x800%positive, 0x600); (0x1000%positive, 0xc00); (0x2000%positive, 0x1800); (0x4000%positive, 0x3000); (0x8000%positive, 0x6000); (0x10000%positive, 0xc000); (0x20000%positive, 0x18000); (0x40000%positive, 0x30000); (0x80000%positive, 0x60000); (0x100000%positive, 0xc0000); (0x200000%positive, 0x180000); (0x400000%positive, 0x300000); (0x800000%positive, 0x600000); (0x1000000%positive, 0xc00000); (0x2000000%positive, 0x1800000); (0x4000000%positive, 0x3000000); (0x8000000%positive, 0x6000000); (0x10000000%positive, 0xc000000); (0x20000000%positive, 0x18000000); (0x40000000%positive, 0x30000000); (0x80000000%positive, 0x60000000); (0x100000000%positive, 0xc0000000); (0x5%positive, 0x2); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-32-two-2 *)
Example suite_308 : suite_seen (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Both L); (0x8%positive, Only L); (0x10%positive, Only L); (0x20%positive, Only L); (0x40%positive, Only L); (0x80%positive, Only L); (0x100%positive, Only L); (0x200%positive, Only L); (0x400%positive, Only L); (0x800%positive, Only L); (0x1000%positive, Only L); (0x2000%positive, Only L); (0x4000%positive, Only L); (0x8000%positive, Only L); (0x10000%positive, Only L); (0x20000%positive, Only L); (0x40000%positive, Only L); (0x80000%positive, Only L); (0x100000%positive, Only L); (0x200000%positive, Only L); (0x400000%positive, Only L); (0x800000%positive, Only L); (0x1000000%positive, Only L); (0x2000000%positive, Only L); (0x4000000%positive, Only L); (0x8000000%positive, Only L); (0x10000000%positive, Only L); (0x20000000%positive, Only L); (0x40000000%positive, Only L); (0x80000000%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x8%positive, 0x5); (0x10%positive, 0xa); (0x20%positive, 0x14); (0x40%positive, 0x28); (0x80%positive, 0x50); (0x100%positive, 0xa0); (0x200%positive, 0x140); (0x400%positive, 0x280); (0x800%positive, 0x500); (0x1000%positive, 0xa00); (0x2000%positive, 0x1400); (0x4000%positive, 0x2800); (0x8000%positive, 0x5000); (0x10000%positive, 0xa000); (0x20000%positive, 0x14000); (0x40000%positive, 0x28000); (0x80000%positive, 0x50000); (0x100000%positive, 0xa0000); (0x200000%positive, 0x140000); (0x400000%positive, 0x280000); (0x800000%positive, 0x500000); (0x1000000%positive, 0xa00000); (0x2000000%positive, 0x1400000); (0x4000000%positive, 0x2800000); (0x8000000%positive, 0x5000000); (0x10000000%positive, 0xa000000); (0x20000000%positive, 0x14000000); (0x40000000%positive, 0x28000000); (0x80000000%positive, 0x50000000); (0x100000000%positive, 0xa0000000); (0x9%positive, 0x4); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-32-two-3 *)
Example suite_309 : suite_seen (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Only L); (0x8%positive, Both L); (0x10%positive, Only L); (0x20%positive, Only L); (0x40%positive, Only L); (0x80%positive, Only L); (0x100%positive, Only L); (0x200%positive, Only L); (0x400%positive, Only L); (0x800%positive, Only L); (0x1000%positive, Only L); (0x2000%positive, Only L); (0x4000%positive, Only L); (0x8000%positive, Only L); (0x10000%positive, Only L); (0x20000%positive, Only L); (0x40000%positive, Only L); (0x80000%positive, Only L); (0x100000%positive, Only L); (0x200000%positive, Only L); (0x400000%positive, Only L); (0x800000%positive, Only L); (0x1000000%positive, Only L); (0x2000000%positive, Only L); (0x4000000%positive, Only L); (0x8000000%positive, Only L); (0x10000000%positive, Only L); (0x20000000%positive, Only L); (0x40000000%positive, Only L); (0x80000000%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x8%positive, 0x4); (0x10%positive, 0x9); (0x20%positive, 0x12); (0x40%positive, 0x24); (0x80%positive, 0x48); (0x100%positive, 0x90); (0x200%positive, 0x120); (0x400%positive, 0x240); (0x800%positive, 0x480); (0x1000%positive, 0x900); (0x2000%positive, 0x1200); (0x4000%positive, 0x2400); (0x8000%positive, 0x4800); (0x10000%positive, 0x9000); (0x20000%positive, 0x12000); (0x40000%positive, 0x24000); (0x80000%positive, 0x48000); (0x100000%positive, 0x90000); (0x200000%positive, 0x120000); (0x400000%positive, 0x240000); (0x800000%positive, 0x480000); (0x1000000%positive, 0x900000); (0x2000000%positive, 0x1200000); (0x4000000%positive, 0x2400000); (0x8000000%positive, 0x4800000); (0x10000000%positive, 0x9000000); (0x20000000%positive, 0x12000000); (0x40000000%positive, 0x24000000); (0x80000000%positive, 0x48000000); (0x100000000%positive, 0x90000000); (0x11%positive, 0x8); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-32-two-4 *)
Example suite_310 : suite_seen (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Only L); (0x8%positive, Only L); (0x10%positive, Both L); (0x20%positive, Only L); (0x40%positive, Only L); (0x80%positive, Only L); (0x100%positive, Only L); (0x200%positive, Only L); (0x400%positive, Only L); (0x800%positive, Only L); (0x1000%positive, Only L); (0x2000%positive, Only L); (0x4000%positive, Only L); (0x8000%positive, Only L); (0x10000%positive, Only L); (0x20000%positive, Only L); (0x40000%positive, Only L); (0x80000%positive, Only L); (0x100000%positive, Only L); (0x200000%positive, Only L); (0x400000%positive, Only L); (0x800000%positive, Only L); (0x1000000%positive, Only L); (0x2000000%positive, Only L); (0x4000000%positive, Only L); (0x8000000%positive, Only L); (0x10000000%positive, Only L); (0x20000000%positive, Only L); (0x40000000%positive, Only L); (0x80000000%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x8%positive, 0x4); (0x10%positive, 0x8); (0x20%positive, 0x11); (0x40%positive, 0x22); (0x80%positive, 0x44); (0x100%positive, 0x88); (0x200%positive, 0x110); (0x400%positive, 0x220); (0x800%positive, 0x440); (0x1000%positive, 0x880); (0x2000%positive, 0x1100); (0x4000%positive, 0x2200); (0x8000%positive, 0x4400); (0x10000%positive, 0x8800); (0x20000%positive, 0x11000); (0x40000%positive, 0x22000); (0x80000%positive, 0x44000); (0x100000%positive, 0x88000); (0x200000%positive, 0x110000); (0x400000%positive, 0x220000); (0x800000%positive, 0x440000); (0x1000000%positive, 0x880000); (0x2000000%positive, 0x1100000); (0x4000000%positive, 0x2200000); (0x8000000%positive, 0x4400000); (0x10000000%positive, 0x8800000); (0x20000000%positive, 0x11000000); (0x40000000%positive, 0x22000000); (0x80000000%positive, 0x44000000); (0x100000000%positive, 0x88000000); (0x21%positive, 0x10); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-32-two-16 *)
Example suite_311 : suite_seen (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Only L); (0x8%positive, Only L); (0x10%positive, Only L); (0x20%positive, Only L); (0x40%positive, Only L); (0x80%positive, Only L); (0x100%positive, Only L); (0x200%positive, Only L); (0x400%positive, Only L); (0x800%positive, Only L); (0x1000%positive, Only L); (0x2000%positive, Only L); (0x4000%positive, Only L); (0x8000%positive, Only L); (0x10000%positive, Both L); (0x20000%positive, Only L); (0x40000%positive, Only L); (0x80000%positive, Only L); (0x100000%positive, Only L); (0x200000%positive, Only L); (0x400000%positive, Only L); (0x800000%positive, Only L); (0x1000000%positive, Only L); (0x2000000%positive, Only L); (0x4000000%positive, Only L); (0x8000000%positive, Only L); (0x10000000%positive, Only L); (0x20000000%positive, Only L); (0x40000000%positive, Only L); (0x80000000%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x8%positive, 0x4); (0x10%positive, 0x8); (0x20%positive, 0x10); (0x40%positive, 0x20); (0x80%positive, 0x40); (0x100%positive, 0x80); (0x200%positive, 0x100); (0x400%positive, 0x200); (0x800%positive, 0x400); (0x1000%positive, 0x800); (0x2000%positive, 0x1000); (0x4000%positive, 0x2000); (0x8000%positive, 0x4000); (0x10000%positive, 0x8000); (0x20000%positive, 0x10001); (0x40000%positive, 0x20002); (0x80000%positive, 0x40004); (0x100000%positive, 0x80008); (0x200000%positive, 0x100010); (0x400000%positive, 0x200020); (0x800000%positive, 0x400040); (0x1000000%positive, 0x800080); (0x2000000%positive, 0x1000100); (0x4000000%positive, 0x2000200); (0x8000000%positive, 0x4000400); (0x10000000%positive, 0x8000800); (0x20000000%positive, 0x10001000); (0x40000000%positive, 0x20002000); (0x80000000%positive, 0x40004000); (0x100000000%positive, 0x80008000); (0x20001%positive, 0x10000); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-right-32-all *)
Example suite_312 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf))))))))))))))))))))))))))))))))
  [(0x1%positive, Both R); (0x3%positive, Both R); (0x7%positive, Both R); (0xf%positive, Both R); (0x1f%positive, Both R); (0x3f%positive, Both R); (0x7f%positive, Both R); (0xff%positive, Both R); (0x1ff%positive, Both R); (0x3ff%positive, Both R); (0x7ff%positive, Both R); (0xfff%positive, Both R); (0x1fff%positive, Both R); (0x3fff%positive, Both R); (0x7fff%positive, Both R); (0xffff%positive, Both R); (0x1ffff%positive, Both R); (0x3ffff%positive, Both R); (0x7ffff%positive, Both R); (0xfffff%positive, Both R); (0x1fffff%positive, Both R); (0x3fffff%positive, Both R); (0x7fffff%positive, Both R); (0xffffff%positive, Both R); (0x1ffffff%positive, Both R); (0x3ffffff%positive, Both R); (0x7ffffff%positive, Both R); (0xfffffff%positive, Both R); (0x1fffffff%positive, Both R); (0x3fffffff%positive, Both R); (0x7fffffff%positive, Both R); (0xffffffff%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x3); (0xf%positive, 0x7); (0x1f%positive, 0xf); (0x3f%positive, 0x1f); (0x7f%positive, 0x3f); (0xff%positive, 0x7f); (0x1ff%positive, 0xff); (0x3ff%positive, 0x1ff); (0x7ff%positive, 0x3ff); (0xfff%positive, 0x7ff); (0x1fff%positive, 0xfff); (0x3fff%positive, 0x1fff); (0x7fff%positive, 0x3fff); (0xffff%positive, 0x7fff); (0x1ffff%positive, 0xffff); (0x3ffff%positive, 0x1ffff); (0x7ffff%positive, 0x3ffff); (0xfffff%positive, 0x7ffff); (0x1fffff%positive, 0xfffff); (0x3fffff%positive, 0x1fffff); (0x7fffff%positive, 0x3fffff); (0xffffff%positive, 0x7fffff); (0x1ffffff%positive, 0xffffff); (0x3ffffff%positive, 0x1ffffff); (0x7ffffff%positive, 0x3ffffff); (0xfffffff%positive, 0x7ffffff); (0x1fffffff%positive, 0xfffffff); (0x3fffffff%positive, 0x1fffffff); (0x7fffffff%positive, 0x3fffffff); (0xffffffff%positive, 0x7fffffff); (0x1ffffffff%positive, 0xffffffff); (0x1fffffffe%positive, 0xfffffffe); (0xfffffffe%positive, 0x7ffffffe); (0x7ffffffe%positive, 0x3ffffffe); (0x3ffffffe%positive, 0x1ffffffe); (0x1ffffffe%positive, 0xffffffe); (0xffffffe%positive, 0x7fffffe); (0x7fffffe%positive, 0x3fffffe); (0x3fffffe%positive, 0x1fffffe); (0x1fffffe%positive, 0xfffffe); (0xfffffe%positive, 0x7ffffe); (0x7ffffe%positive, 0x3ffffe); (0x3ffffe%positive, 0x1ffffe); (0x1ffffe%positive, 0xffffe); (0xffffe%positive, 0x7fffe); (0x7fffe%positive, 0x3fffe); (0x3fffe%positive, 0x1fffe); (0x1fffe%positive, 0xfffe); (0xfffe%positive, 0x7ffe); (0x7ffe%positive, 0x3ffe); (0x3ffe%positive, 0x1ffe); (0x1ffe%positive, 0xffe); (0xffe%positive, 0x7fe); (0x7fe%positive, 0x3fe); (0x3fe%positive, 0x1fe); (0x1fe%positive, 0xfe); (0xfe%positive, 0x7e); (0x7e%positive, 0x3e); (0x3e%positive, 0x1e); (0x1e%positive, 0xe); (0xe%positive, 0x6); (0x6%positive, 0x2); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-right-32-first *)
Example suite_313 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf))))))))))))))))))))))))))))))))
  [(0x1%positive, Both R); (0x3%positive, Only R); (0x7%positive, Only R); (0xf%positive, Only R); (0x1f%positive, Only R); (0x3f%positive, Only R); (0x7f%positive, Only R); (0xff%positive, Only R); (0x1ff%positive, Only R); (0x3ff%positive, Only R); (0x7ff%positive, Only R); (0xfff%positive, Only R); (0x1fff%positive, Only R); (0x3fff%positive, Only R); (0x7fff%positive, Only R); (0xffff%positive, Only R); (0x1ffff%positive, Only R); (0x3ffff%positive, Only R); (0x7ffff%positive, Only R); (0xfffff%positive, Only R); (0x1fffff%positive, Only R); (0x3fffff%positive, Only R); (0x7fffff%positive, Only R); (0xffffff%positive, Only R); (0x1ffffff%positive, Only R); (0x3ffffff%positive, Only R); (0x7ffffff%positive, Only R); (0xfffffff%positive, Only R); (0x1fffffff%positive, Only R); (0x3fffffff%positive, Only R); (0x7fffffff%positive, Only R); (0xffffffff%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x2); (0xf%positive, 0x4); (0x1f%positive, 0x8); (0x3f%positive, 0x10); (0x7f%positive, 0x20); (0xff%positive, 0x40); (0x1ff%positive, 0x80); (0x3ff%positive, 0x100); (0x7ff%positive, 0x200); (0xfff%positive, 0x400); (0x1fff%positive, 0x800); (0x3fff%positive, 0x1000); (0x7fff%positive, 0x2000); (0xffff%positive, 0x4000); (0x1ffff%positive, 0x8000); (0x3ffff%positive, 0x10000); (0x7ffff%positive, 0x20000); (0xfffff%positive, 0x40000); (0x1fffff%positive, 0x80000); (0x3fffff%positive, 0x100000); (0x7fffff%positive, 0x200000); (0xffffff%positive, 0x400000); (0x1ffffff%positive, 0x800000); (0x3ffffff%positive, 0x1000000); (0x7ffffff%positive, 0x2000000); (0xfffffff%positive, 0x4000000); (0x1fffffff%positive, 0x8000000); (0x3fffffff%positive, 0x10000000); (0x7fffffff%positive, 0x20000000); (0xffffffff%positive, 0x40000000); (0x1ffffffff%positive, 0x80000000); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-right-32-two-1 *)
Example suite_314 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf))))))))))))))))))))))))))))))))
  [(0x1%positive, Both R); (0x3%positive, Both R); (0x7%positive, Only R); (0xf%positive, Only R); (0x1f%positive, Only R); (0x3f%positive, Only R); (0x7f%positive, Only R); (0xff%positive, Only R); (0x1ff%positive, Only R); (0x3ff%positive, Only R); (0x7ff%positive, Only R); (0xfff%positive, Only R); (0x1fff%positive, Only R); (0x3fff%positive, Only R); (0x7fff%positive, Only R); (0xffff%positive, Only R); (0x1ffff%positive, Only R); (0x3ffff%positive, Only R); (0x7ffff%positive, Only R); (0xfffff%positive, Only R); (0x1fffff%positive, Only R); (0x3fffff%positive, Only R); (0x7fffff%positive, Only R); (0xffffff%positive, Only R); (0x1ffffff%positive, Only R); (0x3ffffff%positive, Only R); (0x7ffffff%positive, Only R); (0xfffffff%positive, Only R); (0x1fffffff%positive, Only R); (0x3fffffff%positive, Only R); (0x7fffffff%positive, Only R); (0xffffffff%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x3); (0xf%positive, 0x6); (0x1f%positive, 0xc); (0x3f%positive, 0x18); (0x7f%positive, 0x30); (0xff%positive, 0x60); (0x1ff%positive, 0xc0); (0x3ff%positive, 0x180); (0x7ff%positive, 0x300); (0xfff%positive, 0x600); (0x1fff%positive, 0xc00); (0x3fff%positive, 0x1800); (0x7fff%positive, 0x3000); (0xffff%positive, 0x6000); (0x1ffff%positive, 0xc000); (0x3ffff%positive, 0x18000); (0x7ffff%positive, 0x30000); (0xfffff%positive, 0x60000); (0x1fffff%positive, 0xc0000); (0x3fffff%positive, 0x180000); (0x7fffff%positive, 0x300000); (0xffffff%positive, 0x600000); (0x1ffffff%positive, 0xc00000); (0x3ffffff%positive, 0x1800000); (0x7ffffff%positive, 0x3000000); (0xfffffff%positive, 0x6000000); (0x1fffffff%positive, 0xc000000); (0x3fffffff%positive, 0x18000000); (0x7fffffff%positive, 0x30000000); (0xffffffff%positive, 0x60000000); (0x1ffffffff%positive, 0xc0000000); (0x6%positive, 0x2); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-right-32-two-2 *)
Example suite_315 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf))))))))))))))))))))))))))))))))
  [(0x1%positive, Both R); (0x3%positive, Only R); (0x7%positive, Both R); (0xf%positive, Only R); (0x1f%positive, Only R); (0x3f%positive, Only R); (0x7f%positive, Only R); (0xff%positive, Only R); (0x1ff%positive, Only R); (0x3ff%positive, Only R); (0x7ff%positive, Only R); (0xfff%positive, Only R); (0x1fff%positive, Only R); (0x3fff%positive, Only R); (0x7fff%positive, Only R); (0xffff%positive, Only R); (0x1ffff%positive, Only R); (0x3ffff%positive, Only R); (0x7ffff%positive, Only R); (0xfffff%positive, Only R); (0x1fffff%positive, Only R); (0x3fffff%positive, Only R); (0x7fffff%positive, Only R); (0xffffff%positive, Only R); (0x1ffffff%positive, Only R); (0x3ffffff%positive, Only R); (0x7ffffff%positive, Only R); (0xfffffff%positive, Only R); (0x1fffffff%positive, Only R); (0x3fffffff%positive, Only R); (0x7fffffff%positive, Only R); (0xffffffff%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x2); (0xf%positive, 0x5); (0x1f%positive, 0xa); (0x3f%positive, 0x14); (0x7f%positive, 0x28); (0xff%positive, 0x50); (0x1ff%positive, 0xa0); (0x3ff%positive, 0x140); (0x7ff%positive, 0x280); (0xfff%positive, 0x500); (0x1fff%positive, 0xa00); (0x3fff%positive, 0x1400); (0x7fff%positive, 0x2800); (0xffff%positive, 0x5000); (0x1ffff%positive, 0xa000); (0x3ffff%positive, 0x14000); (0x7ffff%positive, 0x28000); (0xfffff%positive, 0x50000); (0x1fffff%positive, 0xa0000); (0x3fffff%positive, 0x140000); (0x7fffff%positive, 0x280000); (0xffffff%positive, 0x500000); (0x1ffffff%positive, 0xa00000); (0x3ffffff%positive, 0x1400000); (0x7ffffff%positive, 0x2800000); (0xfffffff%positive, 0x5000000); (0x1fffffff%positive, 0xa000000); (0x3fffffff%positive, 0x14000000); (0x7fffffff%positive, 0x28000000); (0xffffffff%positive, 0x50000000); (0x1ffffffff%positive, 0xa0000000); (0xe%positive, 0x4); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-right-32-two-3 *)
Example suite_316 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf))))))))))))))))))))))))))))))))
  [(0x1%positive, Both R); (0x3%positive, Only R); (0x7%positive, Only R); (0xf%positive, Both R); (0x1f%positive, Only R); (0x3f%positive, Only R); (0x7f%positive, Only R); (0xff%positive, Only R); (0x1ff%positive, Only R); (0x3ff%positive, Only R); (0x7ff%positive, Only R); (0xfff%positive, Only R); (0x1fff%positive, Only R); (0x3fff%positive, Only R); (0x7fff%positive, Only R); (0xffff%positive, Only R); (0x1ffff%positive, Only R); (0x3ffff%positive, Only R); (0x7ffff%positive, Only R); (0xfffff%positive, Only R); (0x1fffff%positive, Only R); (0x3fffff%positive, Only R); (0x7fffff%positive, Only R); (0xffffff%positive, Only R); (0x1ffffff%positive, Only R); (0x3ffffff%positive, Only R); (0x7ffffff%positive, Only R); (0xfffffff%positive, Only R); (0x1fffffff%positive, Only R); (0x3fffffff%positive, Only R); (0x7fffffff%positive, Only R); (0xffffffff%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x2); (0xf%positive, 0x4); (0x1f%positive, 0x9); (0x3f%positive, 0x12); (0x7f%positive, 0x24); (0xff%positive, 0x48); (0x1ff%positive, 0x90); (0x3ff%positive, 0x120); (0x7ff%positive, 0x240); (0xfff%positive, 0x480); (0x1fff%positive, 0x900); (0x3fff%positive, 0x1200); (0x7fff%positive, 0x2400); (0xffff%positive, 0x4800); (0x1ffff%positive, 0x9000); (0x3ffff%positive, 0x12000); (0x7ffff%positive, 0x24000); (0xfffff%positive, 0x48000); (0x1fffff%positive, 0x90000); (0x3fffff%positive, 0x120000); (0x7fffff%positive, 0x240000); (0xffffff%positive, 0x480000); (0x1ffffff%positive, 0x900000); (0x3ffffff%positive, 0x1200000); (0x7ffffff%positive, 0x2400000); (0xfffffff%positive, 0x4800000); (0x1fffffff%positive, 0x9000000); (0x3fffffff%positive, 0x12000000); (0x7fffffff%positive, 0x24000000); (0xffffffff%positive, 0x48000000); (0x1ffffffff%positive, 0x90000000); (0x1e%positive, 0x8); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-right-32-two-4 *)
Example suite_317 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf))))))))))))))))))))))))))))))))
  [(0x1%positive, Both R); (0x3%positive, Only R); (0x7%positive, Only R); (0xf%positive, Only R); (0x1f%positive, Both R); (0x3f%positive, Only R); (0x7f%positive, Only R); (0xff%positive, Only R); (0x1ff%positive, Only R); (0x3ff%positive, Only R); (0x7ff%positive, Only R); (0xfff%positive, Only R); (0x1fff%positive, Only R); (0x3fff%positive, Only R); (0x7fff%positive, Only R); (0xffff%positive, Only R); (0x1ffff%positive, Only R); (0x3ffff%positive, Only R); (0x7ffff%positive, Only R); (0xfffff%positive, Only R); (0x1fffff%positive, Only R); (0x3fffff%positive, Only R); (0x7fffff%positive, Only R); (0xffffff%positive, Only R); (0x1ffffff%positive, Only R); (0x3ffffff%positive, Only R); (0x7ffffff%positive, Only R); (0xfffffff%positive, Only R); (0x1fffffff%positive, Only R); (0x3fffffff%positive, Only R); (0x7fffffff%positive, Only R); (0xffffffff%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x2); (0xf%positive, 0x4); (0x1f%positive, 0x8); (0x3f%positive, 0x11); (0x7f%positive, 0x22); (0xff%positive, 0x44); (0x1ff%positive, 0x88); (0x3ff%positive, 0x110); (0x7ff%positive, 0x220); (0xfff%positive, 0x440); (0x1fff%positive, 0x880); (0x3fff%positive, 0x1100); (0x7fff%positive, 0x2200); (0xffff%positive, 0x4400); (0x1ffff%positive, 0x8800); (0x3ffff%positive, 0x11000); (0x7ffff%positive, 0x22000); (0xfffff%positive, 0x44000); (0x1fffff%positive, 0x88000); (0x3fffff%positive, 0x110000); (0x7fffff%positive, 0x220000); (0xffffff%positive, 0x440000); (0x1ffffff%positive, 0x880000); (0x3ffffff%positive, 0x1100000); (0x7ffffff%positive, 0x2200000); (0xfffffff%positive, 0x4400000); (0x1fffffff%positive, 0x8800000); (0x3fffffff%positive, 0x11000000); (0x7fffffff%positive, 0x22000000); (0xffffffff%positive, 0x44000000); (0x1ffffffff%positive, 0x88000000); (0x3e%positive, 0x10); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-right-32-two-16 *)
Example suite_318 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf))))))))))))))))))))))))))))))))
  [(0x1%positive, Both R); (0x3%positive, Only R); (0x7%positive, Only R); (0xf%positive, Only R); (0x1f%positive, Only R); (0x3f%positive, Only R); (0x7f%positive, Only R); (0xff%positive, Only R); (0x1ff%positive, Only R); (0x3ff%positive, Only R); (0x7ff%positive, Only R); (0xfff%positive, Only R); (0x1fff%positive, Only R); (0x3fff%positive, Only R); (0x7fff%positive, Only R); (0xffff%positive, Only R); (0x1ffff%positive, Both R); (0x3ffff%positive, Only R); (0x7ffff%positive, Only R); (0xfffff%positive, Only R); (0x1fffff%positive, Only R); (0x3fffff%positive, Only R); (0x7fffff%positive, Only R); (0xffffff%positive, Only R); (0x1ffffff%positive, Only R); (0x3ffffff%positive, Only R); (0x7ffffff%positive, Only R); (0xfffffff%positive, Only R); (0x1fffffff%positive, Only R); (0x3fffffff%positive, Only R); (0x7fffffff%positive, Only R); (0xffffffff%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x2); (0xf%positive, 0x4); (0x1f%positive, 0x8); (0x3f%positive, 0x10); (0x7f%positive, 0x20); (0xff%positive, 0x40); (0x1ff%positive, 0x80); (0x3ff%positive, 0x100); (0x7ff%positive, 0x200); (0xfff%positive, 0x400); (0x1fff%positive, 0x800); (0x3fff%positive, 0x1000); (0x7fff%positive, 0x2000); (0xffff%positive, 0x4000); (0x1ffff%positive, 0x8000); (0x3ffff%positive, 0x10001); (0x7ffff%positive, 0x20002); (0xfffff%positive, 0x40004); (0x1fffff%positive, 0x80008); (0x3fffff%positive, 0x100010); (0x7fffff%positive, 0x200020); (0xffffff%positive, 0x400040); (0x1ffffff%positive, 0x800080); (0x3ffffff%positive, 0x1000100); (0x7ffffff%positive, 0x2000200); (0xfffffff%positive, 0x4000400); (0x1fffffff%positive, 0x8000800); (0x3fffffff%positive, 0x10001000); (0x7fffffff%positive, 0x20002000); (0xffffffff%positive, 0x40004000); (0x1ffffffff%positive, 0x80008000); (0x3fffe%positive, 0x10000); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-turns-32-all *)
Example suite_319 : suite_seen (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf Leaf) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Both R); (0x5%positive, Both L); (0xa%positive, Both R); (0x15%positive, Both L); (0x2a%positive, Both R); (0x55%positive, Both L); (0xaa%positive, Both R); (0x155%positive, Both L); (0x2aa%positive, Both R); (0x555%positive, Both L); (0xaaa%positive, Both R); (0x1555%positive, Both L); (0x2aaa%positive, Both R); (0x5555%positive, Both L); (0xaaaa%positive, Both R); (0x15555%positive, Both L); (0x2aaaa%positive, Both R); (0x55555%positive, Both L); (0xaaaaa%positive, Both R); (0x155555%positive, Both L); (0x2aaaaa%positive, Both R); (0x555555%positive, Both L); (0xaaaaaa%positive, Both R); (0x1555555%positive, Both L); (0x2aaaaaa%positive, Both R); (0x5555555%positive, Both L); (0xaaaaaaa%positive, Both R); (0x15555555%positive, Both L); (0x2aaaaaaa%positive, Both R); (0x55555555%positive, Both L); (0xaaaaaaaa%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x3); (0xa%positive, 0x7); (0x15%positive, 0xf); (0x2a%positive, 0x1f); (0x55%positive, 0x3f); (0xaa%positive, 0x7f); (0x155%positive, 0xff); (0x2aa%positive, 0x1ff); (0x555%positive, 0x3ff); (0xaaa%positive, 0x7ff); (0x1555%positive, 0xfff); (0x2aaa%positive, 0x1fff); (0x5555%positive, 0x3fff); (0xaaaa%positive, 0x7fff); (0x15555%positive, 0xffff); (0x2aaaa%positive, 0x1ffff); (0x55555%positive, 0x3ffff); (0xaaaaa%positive, 0x7ffff); (0x155555%positive, 0xfffff); (0x2aaaaa%positive, 0x1fffff); (0x555555%positive, 0x3fffff); (0xaaaaaa%positive, 0x7fffff); (0x1555555%positive, 0xffffff); (0x2aaaaaa%positive, 0x1ffffff); (0x5555555%positive, 0x3ffffff); (0xaaaaaaa%positive, 0x7ffffff); (0x15555555%positive, 0xfffffff); (0x2aaaaaaa%positive, 0x1fffffff); (0x55555555%positive, 0x3fffffff); (0xaaaaaaaa%positive, 0x7fffffff); (0x155555555%positive, 0xffffffff); (0x155555554%positive, 0xfffffffe); (0xaaaaaaab%positive, 0x7ffffffe); (0x55555554%positive, 0x3ffffffe); (0x2aaaaaab%positive, 0x1ffffffe); (0x15555554%positive, 0xffffffe); (0xaaaaaab%positive, 0x7fffffe); (0x5555554%positive, 0x3fffffe); (0x2aaaaab%positive, 0x1fffffe); (0x1555554%positive, 0xfffffe); (0xaaaaab%positive, 0x7ffffe); (0x555554%positive, 0x3ffffe); (0x2aaaab%positive, 0x1ffffe); (0x155554%positive, 0xffffe); (0xaaaab%positive, 0x7fffe); (0x55554%positive, 0x3fffe); (0x2aaab%positive, 0x1fffe); (0x15554%positive, 0xfffe); (0xaaab%positive, 0x7ffe); (0x5554%positive, 0x3ffe); (0x2aab%positive, 0x1ffe); (0x1554%positive, 0xffe); (0xaab%positive, 0x7fe); (0x554%positive, 0x3fe); (0x2ab%positive, 0x1fe); (0x154%positive, 0xfe); (0xab%positive, 0x7e); (0x54%positive, 0x3e); (0x2b%positive, 0x1e); (0x14%positive, 0xe); (0xb%positive, 0x6); (0x4%positive, 0x2); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-turns-32-first *)
Example suite_320 : suite_seen (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf Leaf) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only R); (0x5%positive, Only L); (0xa%positive, Only R); (0x15%positive, Only L); (0x2a%positive, Only R); (0x55%positive, Only L); (0xaa%positive, Only R); (0x155%positive, Only L); (0x2aa%positive, Only R); (0x555%positive, Only L); (0xaaa%positive, Only R); (0x1555%positive, Only L); (0x2aaa%positive, Only R); (0x5555%positive, Only L); (0xaaaa%positive, Only R); (0x15555%positive, Only L); (0x2aaaa%positive, Only R); (0x55555%positive, Only L); (0xaaaaa%positive, Only R); (0x155555%positive, Only L); (0x2aaaaa%positive, Only R); (0x555555%positive, Only L); (0xaaaaaa%positive, Only R); (0x1555555%positive, Only L); (0x2aaaaaa%positive, Only R); (0x5555555%positive, Only L); (0xaaaaaaa%positive, Only R); (0x15555555%positive, Only L); (0x2aaaaaaa%positive, Only R); (0x55555555%positive, Only L); (0xaaaaaaaa%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x2); (0xa%positive, 0x4); (0x15%positive, 0x8); (0x2a%positive, 0x10); (0x55%positive, 0x20); (0xaa%positive, 0x40); (0x155%positive, 0x80); (0x2aa%positive, 0x100); (0x555%positive, 0x200); (0xaaa%positive, 0x400); (0x1555%positive, 0x800); (0x2aaa%positive, 0x1000); (0x5555%positive, 0x2000); (0xaaaa%positive, 0x4000); (0x15555%positive, 0x8000); (0x2aaaa%positive, 0x10000); (0x55555%positive, 0x20000); (0xaaaaa%positive, 0x40000); (0x155555%positive, 0x80000); (0x2aaaaa%positive, 0x100000); (0x555555%positive, 0x200000); (0xaaaaaa%positive, 0x400000); (0x1555555%positive, 0x800000); (0x2aaaaaa%positive, 0x1000000); (0x5555555%positive, 0x2000000); (0xaaaaaaa%positive, 0x4000000); (0x15555555%positive, 0x8000000); (0x2aaaaaaa%positive, 0x10000000); (0x55555555%positive, 0x20000000); (0xaaaaaaaa%positive, 0x40000000); (0x155555555%positive, 0x80000000); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-turns-32-two-1 *)
Example suite_321 : suite_seen (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf Leaf) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Both R); (0x5%positive, Only L); (0xa%positive, Only R); (0x15%positive, Only L); (0x2a%positive, Only R); (0x55%positive, Only L); (0xaa%positive, Only R); (0x155%positive, Only L); (0x2aa%positive, Only R); (0x555%positive, Only L); (0xaaa%positive, Only R); (0x1555%positive, Only L); (0x2aaa%positive, Only R); (0x5555%positive, Only L); (0xaaaa%positive, Only R); (0x15555%positive, Only L); (0x2aaaa%positive, Only R); (0x55555%positive, Only L); (0xaaaaa%positive, Only R); (0x155555%positive, Only L); (0x2aaaaa%positive, Only R); (0x555555%positive, Only L); (0xaaaaaa%positive, Only R); (0x1555555%positive, Only L); (0x2aaaaaa%positive, Only R); (0x5555555%positive, Only L); (0xaaaaaaa%positive, Only R); (0x15555555%positive, Only L); (0x2aaaaaaa%positive, Only R); (0x55555555%positive, Only L); (0xaaaaaaaa%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x3); (0xa%positive, 0x6); (0x15%positive, 0xc); (0x2a%positive, 0x18); (0x55%positive, 0x30); (0xaa%positive, 0x60); (0x155%positive, 0xc0); (0x2aa%positive, 0x180); (0x555%positive, 0x300); (0xaaa%positive, 0x600); (0x1555%positive, 0xc00); (0x2aaa%positive, 0x1800); (0x5555%positive, 0x3000); (0xaaaa%positive, 0x6000); (0x15555%positive, 0xc000); (0x2aaaa%positive, 0x18000); (0x55555%positive, 0x30000); (0xaaaaa%positive, 0x60000); (0x155555%positive, 0xc0000); (0x2aaaaa%positive, 0x180000); (0x555555%positive, 0x300000); (0xaaaaaa%positive, 0x600000); (0x1555555%positive, 0xc00000); (0x2aaaaaa%positive, 0x1800000); (0x5555555%positive, 0x3000000); (0xaaaaaaa%positive, 0x6000000); (0x15555555%positive, 0xc000000); (0x2aaaaaaa%positive, 0x18000000); (0x55555555%positive, 0x30000000); (0xaaaaaaaa%positive, 0x60000000); (0x155555555%positive, 0xc0000000); (0x4%positive, 0x2); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-turns-32-two-2 *)
Example suite_322 : suite_seen (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf Leaf) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only R); (0x5%positive, Both L); (0xa%positive, Only R); (0x15%positive, Only L); (0x2a%positive, Only R); (0x55%positive, Only L); (0xaa%positive, Only R); (0x155%positive, Only L); (0x2aa%positive, Only R); (0x555%positive, Only L); (0xaaa%positive, Only R); (0x1555%positive, Only L); (0x2aaa%positive, Only R); (0x5555%positive, Only L); (0xaaaa%positive, Only R); (0x15555%positive, Only L); (0x2aaaa%positive, Only R); (0x55555%positive, Only L); (0xaaaaa%positive, Only R); (0x155555%positive, Only L); (0x2aaaaa%positive, Only R); (0x555555%positive, Only L); (0xaaaaaa%positive, Only R); (0x1555555%positive, Only L); (0x2aaaaaa%positive, Only R); (0x5555555%positive, Only L); (0xaaaaaaa%positive, Only R); (0x15555555%positive, Only L); (0x2aaaaaaa%positive, Only R); (0x55555555%positive, Only L); (0xaaaaaaaa%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x2); (0xa%positive, 0x5); (0x15%positive, 0xa); (0x2a%positive, 0x14); (0x55%positive, 0x28); (0xaa%positive, 0x50); (0x155%positive, 0xa0); (0x2aa%positive, 0x140); (0x555%positive, 0x280); (0xaaa%positive, 0x500); (0x1555%positive, 0xa00); (0x2aaa%positive, 0x1400); (0x5555%positive, 0x2800); (0xaaaa%positive, 0x5000); (0x15555%positive, 0xa000); (0x2aaaa%positive, 0x14000); (0x55555%positive, 0x28000); (0xaaaaa%positive, 0x50000); (0x155555%positive, 0xa0000); (0x2aaaaa%positive, 0x140000); (0x555555%positive, 0x280000); (0xaaaaaa%positive, 0x500000); (0x1555555%positive, 0xa00000); (0x2aaaaaa%positive, 0x1400000); (0x5555555%positive, 0x2800000); (0xaaaaaaa%positive, 0x5000000); (0x15555555%positive, 0xa000000); (0x2aaaaaaa%positive, 0x14000000); (0x55555555%positive, 0x28000000); (0xaaaaaaaa%positive, 0x50000000); (0x155555555%positive, 0xa0000000); (0xb%positive, 0x4); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-turns-32-two-3 *)
Example suite_323 : suite_seen (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf Leaf) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only R); (0x5%positive, Only L); (0xa%positive, Both R); (0x15%positive, Only L); (0x2a%positive, Only R); (0x55%positive, Only L); (0xaa%positive, Only R); (0x155%positive, Only L); (0x2aa%positive, Only R); (0x555%positive, Only L); (0xaaa%positive, Only R); (0x1555%positive, Only L); (0x2aaa%positive, Only R); (0x5555%positive, Only L); (0xaaaa%positive, Only R); (0x15555%positive, Only L); (0x2aaaa%positive, Only R); (0x55555%positive, Only L); (0xaaaaa%positive, Only R); (0x155555%positive, Only L); (0x2aaaaa%positive, Only R); (0x555555%positive, Only L); (0xaaaaaa%positive, Only R); (0x1555555%positive, Only L); (0x2aaaaaa%positive, Only R); (0x5555555%positive, Only L); (0xaaaaaaa%positive, Only R); (0x15555555%positive, Only L); (0x2aaaaaaa%positive, Only R); (0x55555555%positive, Only L); (0xaaaaaaaa%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x2); (0xa%positive, 0x4); (0x15%positive, 0x9); (0x2a%positive, 0x12); (0x55%positive, 0x24); (0xaa%positive, 0x48); (0x155%positive, 0x90); (0x2aa%positive, 0x120); (0x555%positive, 0x240); (0xaaa%positive, 0x480); (0x1555%positive, 0x900); (0x2aaa%positive, 0x1200); (0x5555%positive, 0x2400); (0xaaaa%positive, 0x4800); (0x15555%positive, 0x9000); (0x2aaaa%positive, 0x12000); (0x55555%positive, 0x24000); (0xaaaaa%positive, 0x48000); (0x155555%positive, 0x90000); (0x2aaaaa%positive, 0x120000); (0x555555%positive, 0x240000); (0xaaaaaa%positive, 0x480000); (0x1555555%positive, 0x900000); (0x2aaaaaa%positive, 0x1200000); (0x5555555%positive, 0x2400000); (0xaaaaaaa%positive, 0x4800000); (0x15555555%positive, 0x9000000); (0x2aaaaaaa%positive, 0x12000000); (0x55555555%positive, 0x24000000); (0xaaaaaaaa%positive, 0x48000000); (0x155555555%positive, 0x90000000); (0x14%positive, 0x8); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-turns-32-two-4 *)
Example suite_324 : suite_seen (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf Leaf) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only R); (0x5%positive, Only L); (0xa%positive, Only R); (0x15%positive, Both L); (0x2a%positive, Only R); (0x55%positive, Only L); (0xaa%positive, Only R); (0x155%positive, Only L); (0x2aa%positive, Only R); (0x555%positive, Only L); (0xaaa%positive, Only R); (0x1555%positive, Only L); (0x2aaa%positive, Only R); (0x5555%positive, Only L); (0xaaaa%positive, Only R); (0x15555%positive, Only L); (0x2aaaa%positive, Only R); (0x55555%positive, Only L); (0xaaaaa%positive, Only R); (0x155555%positive, Only L); (0x2aaaaa%positive, Only R); (0x555555%positive, Only L); (0xaaaaaa%positive, Only R); (0x1555555%positive, Only L); (0x2aaaaaa%positive, Only R); (0x5555555%positive, Only L); (0xaaaaaaa%positive, Only R); (0x15555555%positive, Only L); (0x2aaaaaaa%positive, Only R); (0x55555555%positive, Only L); (0xaaaaaaaa%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x2); (0xa%positive, 0x4); (0x15%positive, 0x8); (0x2a%positive, 0x11); (0x55%positive, 0x22); (0xaa%positive, 0x44); (0x155%positive, 0x88); (0x2aa%positive, 0x110); (0x555%positive, 0x220); (0xaaa%positive, 0x440); (0x1555%positive, 0x880); (0x2aaa%positive, 0x1100); (0x5555%positive, 0x2200); (0xaaaa%positive, 0x4400); (0x15555%positive, 0x8800); (0x2aaaa%positive, 0x11000); (0x55555%positive, 0x22000); (0xaaaaa%positive, 0x44000); (0x155555%positive, 0x88000); (0x2aaaaa%positive, 0x110000); (0x555555%positive, 0x220000); (0xaaaaaa%positive, 0x440000); (0x1555555%positive, 0x880000); (0x2aaaaaa%positive, 0x1100000); (0x5555555%positive, 0x2200000); (0xaaaaaaa%positive, 0x4400000); (0x15555555%positive, 0x8800000); (0x2aaaaaaa%positive, 0x11000000); (0x55555555%positive, 0x22000000); (0xaaaaaaaa%positive, 0x44000000); (0x155555555%positive, 0x88000000); (0x2b%positive, 0x10); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-turns-32-two-16 *)
Example suite_325 : suite_seen (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf Leaf) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only R); (0x5%positive, Only L); (0xa%positive, Only R); (0x15%positive, Only L); (0x2a%positive, Only R); (0x55%positive, Only L); (0xaa%positive, Only R); (0x155%positive, Only L); (0x2aa%positive, Only R); (0x555%positive, Only L); (0xaaa%positive, Only R); (0x1555%positive, Only L); (0x2aaa%positive, Only R); (0x5555%positive, Only L); (0xaaaa%positive, Only R); (0x15555%positive, Both L); (0x2aaaa%positive, Only R); (0x55555%positive, Only L); (0xaaaaa%positive, Only R); (0x155555%positive, Only L); (0x2aaaaa%positive, Only R); (0x555555%positive, Only L); (0xaaaaaa%positive, Only R); (0x1555555%positive, Only L); (0x2aaaaaa%positive, Only R); (0x5555555%positive, Only L); (0xaaaaaaa%positive, Only R); (0x15555555%positive, Only L); (0x2aaaaaaa%positive, Only R); (0x55555555%positive, Only L); (0xaaaaaaaa%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x2); (0xa%positive, 0x4); (0x15%positive, 0x8); (0x2a%positive, 0x10); (0x55%positive, 0x20); (0xaa%positive, 0x40); (0x155%positive, 0x80); (0x2aa%positive, 0x100); (0x555%positive, 0x200); (0xaaa%positive, 0x400); (0x1555%positive, 0x800); (0x2aaa%positive, 0x1000); (0x5555%positive, 0x2000); (0xaaaa%positive, 0x4000); (0x15555%positive, 0x8000); (0x2aaaa%positive, 0x10001); (0x55555%positive, 0x20002); (0xaaaaa%positive, 0x40004); (0x155555%positive, 0x80008); (0x2aaaaa%positive, 0x100010); (0x555555%positive, 0x200020); (0xaaaaaa%positive, 0x400040); (0x1555555%positive, 0x800080); (0x2aaaaaa%positive, 0x1000100); (0x5555555%positive, 0x2000200); (0xaaaaaaa%positive, 0x4000400); (0x15555555%positive, 0x8000800); (0x2aaaaaaa%positive, 0x10001000); (0x55555555%positive, 0x20002000); (0xaaaaaaaa%positive, 0x40004000); (0x155555555%positive, 0x80008000); (0x2aaab%positive, 0x10000); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-33-all *)
Example suite_326 : suite_seen (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Both L); (0x4%positive, Both L); (0x8%positive, Both L); (0x10%positive, Both L); (0x20%positive, Both L); (0x40%positive, Both L); (0x80%positive, Both L); (0x100%positive, Both L); (0x200%positive, Both L); (0x400%positive, Both L); (0x800%positive, Both L); (0x1000%positive, Both L); (0x2000%positive, Both L); (0x4000%positive, Both L); (0x8000%positive, Both L); (0x10000%positive, Both L); (0x20000%positive, Both L); (0x40000%positive, Both L); (0x80000%positive, Both L); (0x100000%positive, Both L); (0x200000%positive, Both L); (0x400000%positive, Both L); (0x800000%positive, Both L); (0x1000000%positive, Both L); (0x2000000%positive, Both L); (0x4000000%positive, Both L); (0x8000000%positive, Both L); (0x10000000%positive, Both L); (0x20000000%positive, Both L); (0x40000000%positive, Both L); (0x80000000%positive, Both L); (0x100000000%positive, Both L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x3); (0x8%positive, 0x7); (0x10%positive, 0xf); (0x20%positive, 0x1f); (0x40%positive, 0x3f); (0x80%positive, 0x7f); (0x100%positive, 0xff); (0x200%positive, 0x1ff); (0x400%positive, 0x3ff); (0x800%positive, 0x7ff); (0x1000%positive, 0xfff); (0x2000%positive, 0x1fff); (0x4000%positive, 0x3fff); (0x8000%positive, 0x7fff); (0x10000%positive, 0xffff); (0x20000%positive, 0x1ffff); (0x40000%positive, 0x3ffff); (0x80000%positive, 0x7ffff); (0x100000%positive, 0xfffff); (0x200000%positive, 0x1fffff); (0x400000%positive, 0x3fffff); (0x800000%positive, 0x7fffff); (0x1000000%positive, 0xffffff); (0x2000000%positive, 0x1ffffff); (0x4000000%positive, 0x3ffffff); (0x8000000%positive, 0x7ffffff); (0x10000000%positive, 0xfffffff); (0x20000000%positive, 0x1fffffff); (0x40000000%positive, 0x3fffffff); (0x80000000%positive, 0x7fffffff); (0x100000000%positive, 0xffffffff); (0x200000000%positive, 0x1ffffffff); (0x200000001%positive, 0x1fffffffe); (0x100000001%positive, 0xfffffffe); (0x80000001%positive, 0x7ffffffe); (0x40000001%positive, 0x3ffffffe); (0x20000001%positive, 0x1ffffffe); (0x10000001%positive, 0xffffffe); (0x8000001%positive, 0x7fffffe); (0x4000001%positive, 0x3fffffe); (0x2000001%positive, 0x1fffffe); (0x1000001%positive, 0xfffffe); (0x800001%positive, 0x7ffffe); (0x400001%positive, 0x3ffffe); (0x200001%positive, 0x1ffffe); (0x100001%positive, 0xffffe); (0x80001%positive, 0x7fffe); (0x40001%positive, 0x3fffe); (0x20001%positive, 0x1fffe); (0x10001%positive, 0xfffe); (0x8001%positive, 0x7ffe); (0x4001%positive, 0x3ffe); (0x2001%positive, 0x1ffe); (0x1001%positive, 0xffe); (0x801%positive, 0x7fe); (0x401%positive, 0x3fe); (0x201%positive, 0x1fe); (0x101%positive, 0xfe); (0x81%positive, 0x7e); (0x41%positive, 0x3e); (0x21%positive, 0x1e); (0x11%positive, 0xe); (0x9%positive, 0x6); (0x5%positive, 0x2); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-33-first *)
Example suite_327 : suite_seen (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Only L); (0x8%positive, Only L); (0x10%positive, Only L); (0x20%positive, Only L); (0x40%positive, Only L); (0x80%positive, Only L); (0x100%positive, Only L); (0x200%positive, Only L); (0x400%positive, Only L); (0x800%positive, Only L); (0x1000%positive, Only L); (0x2000%positive, Only L); (0x4000%positive, Only L); (0x8000%positive, Only L); (0x10000%positive, Only L); (0x20000%positive, Only L); (0x40000%positive, Only L); (0x80000%positive, Only L); (0x100000%positive, Only L); (0x200000%positive, Only L); (0x400000%positive, Only L); (0x800000%positive, Only L); (0x1000000%positive, Only L); (0x2000000%positive, Only L); (0x4000000%positive, Only L); (0x8000000%positive, Only L); (0x10000000%positive, Only L); (0x20000000%positive, Only L); (0x40000000%positive, Only L); (0x80000000%positive, Only L); (0x100000000%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x8%positive, 0x4); (0x10%positive, 0x8); (0x20%positive, 0x10); (0x40%positive, 0x20); (0x80%positive, 0x40); (0x100%positive, 0x80); (0x200%positive, 0x100); (0x400%positive, 0x200); (0x800%positive, 0x400); (0x1000%positive, 0x800); (0x2000%positive, 0x1000); (0x4000%positive, 0x2000); (0x8000%positive, 0x4000); (0x10000%positive, 0x8000); (0x20000%positive, 0x10000); (0x40000%positive, 0x20000); (0x80000%positive, 0x40000); (0x100000%positive, 0x80000); (0x200000%positive, 0x100000); (0x400000%positive, 0x200000); (0x800000%positive, 0x400000); (0x1000000%positive, 0x800000); (0x2000000%positive, 0x1000000); (0x4000000%positive, 0x2000000); (0x8000000%positive, 0x4000000); (0x10000000%positive, 0x8000000); (0x20000000%positive, 0x10000000); (0x40000000%positive, 0x20000000); (0x80000000%positive, 0x40000000); (0x100000000%positive, 0x80000000); (0x200000000%positive, 0x100000000); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-33-two-1 *)
Example suite_328 : suite_seen (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Both L); (0x4%positive, Only L); (0x8%positive, Only L); (0x10%positive, Only L); (0x20%positive, Only L); (0x40%positive, Only L); (0x80%positive, Only L); (0x100%positive, Only L); (0x200%positive, Only L); (0x400%positive, Only L); (0x800%positive, Only L); (0x1000%positive, Only L); (0x2000%positive, Only L); (0x4000%positive, Only L); (0x8000%positive, Only L); (0x10000%positive, Only L); (0x20000%positive, Only L); (0x40000%positive, Only L); (0x80000%positive, Only L); (0x100000%positive, Only L); (0x200000%positive, Only L); (0x400000%positive, Only L); (0x800000%positive, Only L); (0x1000000%positive, Only L); (0x2000000%positive, Only L); (0x4000000%positive, Only L); (0x8000000%positive, Only L); (0x10000000%positive, Only L); (0x20000000%positive, Only L); (0x40000000%positive, Only L); (0x80000000%positive, Only L); (0x100000000%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x3); (0x8%positive, 0x6); (0x10%positive, 0xc); (0x20%positive, 0x18); (0x40%positive, 0x30); (0x80%positive, 0x60); (0x100%positive, 0xc0); (0x200%positive, 0x180); (0x400%positive, 0x300); (0x800%positive, 0x600); (0x1000%positive, 0xc00); (0x2000%positive, 0x1800); (0x4000%positive, 0x3000); (0x8000%positive, 0x6000); (0x10000%positive, 0xc000); (0x20000%positive, 0x18000); (0x40000%positive, 0x30000); (0x80000%positive, 0x60000); (0x100000%positive, 0xc0000); (0x200000%positive, 0x180000); (0x400000%positive, 0x300000); (0x800000%positive, 0x600000); (0x1000000%positive, 0xc00000); (0x2000000%positive, 0x1800000); (0x4000000%positive, 0x3000000); (0x8000000%positive, 0x6000000); (0x10000000%positive, 0xc000000); (0x20000000%positive, 0x18000000); (0x40000000%positive, 0x30000000); (0x80000000%positive, 0x60000000); (0x100000000%positive, 0xc0000000); (0x200000000%positive, 0x180000000); (0x5%positive, 0x2); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-33-two-2 *)
Example suite_329 : suite_seen (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Both L); (0x8%positive, Only L); (0x10%positive, Only L); (0x20%positive, Only L); (0x40%positive, Only L); (0x80%positive, Only L); (0x100%positive, Only L); (0x200%positive, Only L); (0x400%positive, Only L); (0x800%positive, Only L); (0x1000%positive, Only L); (0x2000%positive, Only L); (0x4000%positive, Only L); (0x8000%positive, Only L); (0x10000%positive, Only L); (0x20000%positive, Only L); (0x40000%positive, Only L); (0x80000%positive, Only L); (0x100000%positive, Only L); (0x200000%positive, Only L); (0x400000%positive, Only L); (0x800000%positive, Only L); (0x1000000%positive, Only L); (0x2000000%positive, Only L); (0x4000000%positive, Only L); (0x8000000%positive, Only L); (0x10000000%positive, Only L); (0x20000000%positive, Only L); (0x40000000%positive, Only L); (0x80000000%positive, Only L); (0x100000000%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x8%positive, 0x5); (0x10%positive, 0xa); (0x20%positive, 0x14); (0x40%positive, 0x28); (0x80%positive, 0x50); (0x100%positive, 0xa0); (0x200%positive, 0x140); (0x400%positive, 0x280); (0x800%positive, 0x500); (0x1000%positive, 0xa00); (0x2000%positive, 0x1400); (0x4000%positive, 0x2800); (0x8000%positive, 0x5000); (0x10000%positive, 0xa000); (0x20000%positive, 0x14000); (0x40000%positive, 0x28000); (0x80000%positive, 0x50000); (0x100000%positive, 0xa0000); (0x200000%positive, 0x140000); (0x400000%positive, 0x280000); (0x800000%positive, 0x500000); (0x1000000%positive, 0xa00000); (0x2000000%positive, 0x1400000); (0x4000000%positive, 0x2800000); (0x8000000%positive, 0x5000000); (0x10000000%positive, 0xa000000); (0x20000000%positive, 0x14000000); (0x40000000%positive, 0x28000000); (0x80000000%positive, 0x50000000); (0x100000000%positive, 0xa0000000); (0x200000000%positive, 0x140000000); (0x9%positive, 0x4); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-33-two-3 *)
Example suite_330 : suite_seen (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Only L); (0x8%positive, Both L); (0x10%positive, Only L); (0x20%positive, Only L); (0x40%positive, Only L); (0x80%positive, Only L); (0x100%positive, Only L); (0x200%positive, Only L); (0x400%positive, Only L); (0x800%positive, Only L); (0x1000%positive, Only L); (0x2000%positive, Only L); (0x4000%positive, Only L); (0x8000%positive, Only L); (0x10000%positive, Only L); (0x20000%positive, Only L); (0x40000%positive, Only L); (0x80000%positive, Only L); (0x100000%positive, Only L); (0x200000%positive, Only L); (0x400000%positive, Only L); (0x800000%positive, Only L); (0x1000000%positive, Only L); (0x2000000%positive, Only L); (0x4000000%positive, Only L); (0x8000000%positive, Only L); (0x10000000%positive, Only L); (0x20000000%positive, Only L); (0x40000000%positive, Only L); (0x80000000%positive, Only L); (0x100000000%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x8%positive, 0x4); (0x10%positive, 0x9); (0x20%positive, 0x12); (0x40%positive, 0x24); (0x80%positive, 0x48); (0x100%positive, 0x90); (0x200%positive, 0x120); (0x400%positive, 0x240); (0x800%positive, 0x480); (0x1000%positive, 0x900); (0x2000%positive, 0x1200); (0x4000%positive, 0x2400); (0x8000%positive, 0x4800); (0x10000%positive, 0x9000); (0x20000%positive, 0x12000); (0x40000%positive, 0x24000); (0x80000%positive, 0x48000); (0x100000%positive, 0x90000); (0x200000%positive, 0x120000); (0x400000%positive, 0x240000); (0x800000%positive, 0x480000); (0x1000000%positive, 0x900000); (0x2000000%positive, 0x1200000); (0x4000000%positive, 0x2400000); (0x8000000%positive, 0x4800000); (0x10000000%positive, 0x9000000); (0x20000000%positive, 0x12000000); (0x40000000%positive, 0x24000000); (0x80000000%positive, 0x48000000); (0x100000000%positive, 0x90000000); (0x200000000%positive, 0x120000000); (0x11%positive, 0x8); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-33-two-4 *)
Example suite_331 : suite_seen (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Only L); (0x8%positive, Only L); (0x10%positive, Both L); (0x20%positive, Only L); (0x40%positive, Only L); (0x80%positive, Only L); (0x100%positive, Only L); (0x200%positive, Only L); (0x400%positive, Only L); (0x800%positive, Only L); (0x1000%positive, Only L); (0x2000%positive, Only L); (0x4000%positive, Only L); (0x8000%positive, Only L); (0x10000%positive, Only L); (0x20000%positive, Only L); (0x40000%positive, Only L); (0x80000%positive, Only L); (0x100000%positive, Only L); (0x200000%positive, Only L); (0x400000%positive, Only L); (0x800000%positive, Only L); (0x1000000%positive, Only L); (0x2000000%positive, Only L); (0x4000000%positive, Only L); (0x8000000%positive, Only L); (0x10000000%positive, Only L); (0x20000000%positive, Only L); (0x40000000%positive, Only L); (0x80000000%positive, Only L); (0x100000000%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x8%positive, 0x4); (0x10%positive, 0x8); (0x20%positive, 0x11); (0x40%positive, 0x22); (0x80%positive, 0x44); (0x100%positive, 0x88); (0x200%positive, 0x110); (0x400%positive, 0x220); (0x800%positive, 0x440); (0x1000%positive, 0x880); (0x2000%positive, 0x1100); (0x4000%positive, 0x2200); (0x8000%positive, 0x4400); (0x10000%positive, 0x8800); (0x20000%positive, 0x11000); (0x40000%positive, 0x22000); (0x80000%positive, 0x44000); (0x100000%positive, 0x88000); (0x200000%positive, 0x110000); (0x400000%positive, 0x220000); (0x800000%positive, 0x440000); (0x1000000%positive, 0x880000); (0x2000000%positive, 0x1100000); (0x4000000%positive, 0x2200000); (0x8000000%positive, 0x4400000); (0x10000000%positive, 0x8800000); (0x20000000%positive, 0x11000000); (0x40000000%positive, 0x22000000); (0x80000000%positive, 0x44000000); (0x100000000%positive, 0x88000000); (0x200000000%positive, 0x110000000); (0x21%positive, 0x10); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-33-two-16 *)
Example suite_332 : suite_seen (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Only L); (0x8%positive, Only L); (0x10%positive, Only L); (0x20%positive, Only L); (0x40%positive, Only L); (0x80%positive, Only L); (0x100%positive, Only L); (0x200%positive, Only L); (0x400%positive, Only L); (0x800%positive, Only L); (0x1000%positive, Only L); (0x2000%positive, Only L); (0x4000%positive, Only L); (0x8000%positive, Only L); (0x10000%positive, Both L); (0x20000%positive, Only L); (0x40000%positive, Only L); (0x80000%positive, Only L); (0x100000%positive, Only L); (0x200000%positive, Only L); (0x400000%positive, Only L); (0x800000%positive, Only L); (0x1000000%positive, Only L); (0x2000000%positive, Only L); (0x4000000%positive, Only L); (0x8000000%positive, Only L); (0x10000000%positive, Only L); (0x20000000%positive, Only L); (0x40000000%positive, Only L); (0x80000000%positive, Only L); (0x100000000%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x8%positive, 0x4); (0x10%positive, 0x8); (0x20%positive, 0x10); (0x40%positive, 0x20); (0x80%positive, 0x40); (0x100%positive, 0x80); (0x200%positive, 0x100); (0x400%positive, 0x200); (0x800%positive, 0x400); (0x1000%positive, 0x800); (0x2000%positive, 0x1000); (0x4000%positive, 0x2000); (0x8000%positive, 0x4000); (0x10000%positive, 0x8000); (0x20000%positive, 0x10001); (0x40000%positive, 0x20002); (0x80000%positive, 0x40004); (0x100000%positive, 0x80008); (0x200000%positive, 0x100010); (0x400000%positive, 0x200020); (0x800000%positive, 0x400040); (0x1000000%positive, 0x800080); (0x2000000%positive, 0x1000100); (0x4000000%positive, 0x2000200); (0x8000000%positive, 0x4000400); (0x10000000%positive, 0x8000800); (0x20000000%positive, 0x10001000); (0x40000000%positive, 0x20002000); (0x80000000%positive, 0x40004000); (0x100000000%positive, 0x80008000); (0x200000000%positive, 0x100010000); (0x20001%positive, 0x10000); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-right-33-all *)
Example suite_333 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf)))))))))))))))))))))))))))))))))
  [(0x1%positive, Both R); (0x3%positive, Both R); (0x7%positive, Both R); (0xf%positive, Both R); (0x1f%positive, Both R); (0x3f%positive, Both R); (0x7f%positive, Both R); (0xff%positive, Both R); (0x1ff%positive, Both R); (0x3ff%positive, Both R); (0x7ff%positive, Both R); (0xfff%positive, Both R); (0x1fff%positive, Both R); (0x3fff%positive, Both R); (0x7fff%positive, Both R); (0xffff%positive, Both R); (0x1ffff%positive, Both R); (0x3ffff%positive, Both R); (0x7ffff%positive, Both R); (0xfffff%positive, Both R); (0x1fffff%positive, Both R); (0x3fffff%positive, Both R); (0x7fffff%positive, Both R); (0xffffff%positive, Both R); (0x1ffffff%positive, Both R); (0x3ffffff%positive, Both R); (0x7ffffff%positive, Both R); (0xfffffff%positive, Both R); (0x1fffffff%positive, Both R); (0x3fffffff%positive, Both R); (0x7fffffff%positive, Both R); (0xffffffff%positive, Both R); (0x1ffffffff%positive, Both R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x3); (0xf%positive, 0x7); (0x1f%positive, 0xf); (0x3f%positive, 0x1f); (0x7f%positive, 0x3f); (0xff%positive, 0x7f); (0x1ff%positive, 0xff); (0x3ff%positive, 0x1ff); (0x7ff%positive, 0x3ff); (0xfff%positive, 0x7ff); (0x1fff%positive, 0xfff); (0x3fff%positive, 0x1fff); (0x7fff%positive, 0x3fff); (0xffff%positive, 0x7fff); (0x1ffff%positive, 0xffff); (0x3ffff%positive, 0x1ffff); (0x7ffff%positive, 0x3ffff); (0xfffff%positive, 0x7ffff); (0x1fffff%positive, 0xfffff); (0x3fffff%positive, 0x1fffff); (0x7fffff%positive, 0x3fffff); (0xffffff%positive, 0x7fffff); (0x1ffffff%positive, 0xffffff); (0x3ffffff%positive, 0x1ffffff); (0x7ffffff%positive, 0x3ffffff); (0xfffffff%positive, 0x7ffffff); (0x1fffffff%positive, 0xfffffff); (0x3fffffff%positive, 0x1fffffff); (0x7fffffff%positive, 0x3fffffff); (0xffffffff%positive, 0x7fffffff); (0x1ffffffff%positive, 0xffffffff); (0x3ffffffff%positive, 0x1ffffffff); (0x3fffffffe%positive, 0x1fffffffe); (0x1fffffffe%positive, 0xfffffffe); (0xfffffffe%positive, 0x7ffffffe); (0x7ffffffe%positive, 0x3ffffffe); (0x3ffffffe%positive, 0x1ffffffe); (0x1ffffffe%positive, 0xffffffe); (0xffffffe%positive, 0x7fffffe); (0x7fffffe%positive, 0x3fffffe); (0x3fffffe%positive, 0x1fffffe); (0x1fffffe%positive, 0xfffffe); (0xfffffe%positive, 0x7ffffe); (0x7ffffe%positive, 0x3ffffe); (0x3ffffe%positive, 0x1ffffe); (0x1ffffe%positive, 0xffffe); (0xffffe%positive, 0x7fffe); (0x7fffe%positive, 0x3fffe); (0x3fffe%positive, 0x1fffe); (0x1fffe%positive, 0xfffe); (0xfffe%positive, 0x7ffe); (0x7ffe%positive, 0x3ffe); (0x3ffe%positive, 0x1ffe); (0x1ffe%positive, 0xffe); (0xffe%positive, 0x7fe); (0x7fe%positive, 0x3fe); (0x3fe%positive, 0x1fe); (0x1fe%positive, 0xfe); (0xfe%positive, 0x7e); (0x7e%positive, 0x3e); (0x3e%positive, 0x1e); (0x1e%positive, 0xe); (0xe%positive, 0x6); (0x6%positive, 0x2); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-right-33-first *)
Example suite_334 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf)))))))))))))))))))))))))))))))))
  [(0x1%positive, Both R); (0x3%positive, Only R); (0x7%positive, Only R); (0xf%positive, Only R); (0x1f%positive, Only R); (0x3f%positive, Only R); (0x7f%positive, Only R); (0xff%positive, Only R); (0x1ff%positive, Only R); (0x3ff%positive, Only R); (0x7ff%positive, Only R); (0xfff%positive, Only R); (0x1fff%positive, Only R); (0x3fff%positive, Only R); (0x7fff%positive, Only R); (0xffff%positive, Only R); (0x1ffff%positive, Only R); (0x3ffff%positive, Only R); (0x7ffff%positive, Only R); (0xfffff%positive, Only R); (0x1fffff%positive, Only R); (0x3fffff%positive, Only R); (0x7fffff%positive, Only R); (0xffffff%positive, Only R); (0x1ffffff%positive, Only R); (0x3ffffff%positive, Only R); (0x7ffffff%positive, Only R); (0xfffffff%positive, Only R); (0x1fffffff%positive, Only R); (0x3fffffff%positive, Only R); (0x7fffffff%positive, Only R); (0xffffffff%positive, Only R); (0x1ffffffff%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x2); (0xf%positive, 0x4); (0x1f%positive, 0x8); (0x3f%positive, 0x10); (0x7f%positive, 0x20); (0xff%positive, 0x40); (0x1ff%positive, 0x80); (0x3ff%positive, 0x100); (0x7ff%positive, 0x200); (0xfff%positive, 0x400); (0x1fff%positive, 0x800); (0x3fff%positive, 0x1000); (0x7fff%positive, 0x2000); (0xffff%positive, 0x4000); (0x1ffff%positive, 0x8000); (0x3ffff%positive, 0x10000); (0x7ffff%positive, 0x20000); (0xfffff%positive, 0x40000); (0x1fffff%positive, 0x80000); (0x3fffff%positive, 0x100000); (0x7fffff%positive, 0x200000); (0xffffff%positive, 0x400000); (0x1ffffff%positive, 0x800000); (0x3ffffff%positive, 0x1000000); (0x7ffffff%positive, 0x2000000); (0xfffffff%positive, 0x4000000); (0x1fffffff%positive, 0x8000000); (0x3fffffff%positive, 0x10000000); (0x7fffffff%positive, 0x20000000); (0xffffffff%positive, 0x40000000); (0x1ffffffff%positive, 0x80000000); (0x3ffffffff%positive, 0x100000000); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-right-33-two-1 *)
Example suite_335 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf)))))))))))))))))))))))))))))))))
  [(0x1%positive, Both R); (0x3%positive, Both R); (0x7%positive, Only R); (0xf%positive, Only R); (0x1f%positive, Only R); (0x3f%positive, Only R); (0x7f%positive, Only R); (0xff%positive, Only R); (0x1ff%positive, Only R); (0x3ff%positive, Only R); (0x7ff%positive, Only R); (0xfff%positive, Only R); (0x1fff%positive, Only R); (0x3fff%positive, Only R); (0x7fff%positive, Only R); (0xffff%positive, Only R); (0x1ffff%positive, Only R); (0x3ffff%positive, Only R); (0x7ffff%positive, Only R); (0xfffff%positive, Only R); (0x1fffff%positive, Only R); (0x3fffff%positive, Only R); (0x7fffff%positive, Only R); (0xffffff%positive, Only R); (0x1ffffff%positive, Only R); (0x3ffffff%positive, Only R); (0x7ffffff%positive, Only R); (0xfffffff%positive, Only R); (0x1fffffff%positive, Only R); (0x3fffffff%positive, Only R); (0x7fffffff%positive, Only R); (0xffffffff%positive, Only R); (0x1ffffffff%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x3); (0xf%positive, 0x6); (0x1f%positive, 0xc); (0x3f%positive, 0x18); (0x7f%positive, 0x30); (0xff%positive, 0x60); (0x1ff%positive, 0xc0); (0x3ff%positive, 0x180); (0x7ff%positive, 0x300); (0xfff%positive, 0x600); (0x1fff%positive, 0xc00); (0x3fff%positive, 0x1800); (0x7fff%positive, 0x3000); (0xffff%positive, 0x6000); (0x1ffff%positive, 0xc000); (0x3ffff%positive, 0x18000); (0x7ffff%positive, 0x30000); (0xfffff%positive, 0x60000); (0x1fffff%positive, 0xc0000); (0x3fffff%positive, 0x180000); (0x7fffff%positive, 0x300000); (0xffffff%positive, 0x600000); (0x1ffffff%positive, 0xc00000); (0x3ffffff%positive, 0x1800000); (0x7ffffff%positive, 0x3000000); (0xfffffff%positive, 0x6000000); (0x1fffffff%positive, 0xc000000); (0x3fffffff%positive, 0x18000000); (0x7fffffff%positive, 0x30000000); (0xffffffff%positive, 0x60000000); (0x1ffffffff%positive, 0xc0000000); (0x3ffffffff%positive, 0x180000000); (0x6%positive, 0x2); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-right-33-two-2 *)
Example suite_336 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf)))))))))))))))))))))))))))))))))
  [(0x1%positive, Both R); (0x3%positive, Only R); (0x7%positive, Both R); (0xf%positive, Only R); (0x1f%positive, Only R); (0x3f%positive, Only R); (0x7f%positive, Only R); (0xff%positive, Only R); (0x1ff%positive, Only R); (0x3ff%positive, Only R); (0x7ff%positive, Only R); (0xfff%positive, Only R); (0x1fff%positive, Only R); (0x3fff%positive, Only R); (0x7fff%positive, Only R); (0xffff%positive, Only R); (0x1ffff%positive, Only R); (0x3ffff%positive, Only R); (0x7ffff%positive, Only R); (0xfffff%positive, Only R); (0x1fffff%positive, Only R); (0x3fffff%positive, Only R); (0x7fffff%positive, Only R); (0xffffff%positive, Only R); (0x1ffffff%positive, Only R); (0x3ffffff%positive, Only R); (0x7ffffff%positive, Only R); (0xfffffff%positive, Only R); (0x1fffffff%positive, Only R); (0x3fffffff%positive, Only R); (0x7fffffff%positive, Only R); (0xffffffff%positive, Only R); (0x1ffffffff%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x2); (0xf%positive, 0x5); (0x1f%positive, 0xa); (0x3f%positive, 0x14); (0x7f%positive, 0x28); (0xff%positive, 0x50); (0x1ff%positive, 0xa0); (0x3ff%positive, 0x140); (0x7ff%positive, 0x280); (0xfff%positive, 0x500); (0x1fff%positive, 0xa00); (0x3fff%positive, 0x1400); (0x7fff%positive, 0x2800); (0xffff%positive, 0x5000); (0x1ffff%positive, 0xa000); (0x3ffff%positive, 0x14000); (0x7ffff%positive, 0x28000); (0xfffff%positive, 0x50000); (0x1fffff%positive, 0xa0000); (0x3fffff%positive, 0x140000); (0x7fffff%positive, 0x280000); (0xffffff%positive, 0x500000); (0x1ffffff%positive, 0xa00000); (0x3ffffff%positive, 0x1400000); (0x7ffffff%positive, 0x2800000); (0xfffffff%positive, 0x5000000); (0x1fffffff%positive, 0xa000000); (0x3fffffff%positive, 0x14000000); (0x7fffffff%positive, 0x28000000); (0xffffffff%positive, 0x50000000); (0x1ffffffff%positive, 0xa0000000); (0x3ffffffff%positive, 0x140000000); (0xe%positive, 0x4); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-right-33-two-3 *)
Example suite_337 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf)))))))))))))))))))))))))))))))))
  [(0x1%positive, Both R); (0x3%positive, Only R); (0x7%positive, Only R); (0xf%positive, Both R); (0x1f%positive, Only R); (0x3f%positive, Only R); (0x7f%positive, Only R); (0xff%positive, Only R); (0x1ff%positive, Only R); (0x3ff%positive, Only R); (0x7ff%positive, Only R); (0xfff%positive, Only R); (0x1fff%positive, Only R); (0x3fff%positive, Only R); (0x7fff%positive, Only R); (0xffff%positive, Only R); (0x1ffff%positive, Only R); (0x3ffff%positive, Only R); (0x7ffff%positive, Only R); (0xfffff%positive, Only R); (0x1fffff%positive, Only R); (0x3fffff%positive, Only R); (0x7fffff%positive, Only R); (0xffffff%positive, Only R); (0x1ffffff%positive, Only R); (0x3ffffff%positive, Only R); (0x7ffffff%positive, Only R); (0xfffffff%positive, Only R); (0x1fffffff%positive, Only R); (0x3fffffff%positive, Only R); (0x7fffffff%positive, Only R); (0xffffffff%positive, Only R); (0x1ffffffff%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x2); (0xf%positive, 0x4); (0x1f%positive, 0x9); (0x3f%positive, 0x12); (0x7f%positive, 0x24); (0xff%positive, 0x48); (0x1ff%positive, 0x90); (0x3ff%positive, 0x120); (0x7ff%positive, 0x240); (0xfff%positive, 0x480); (0x1fff%positive, 0x900); (0x3fff%positive, 0x1200); (0x7fff%positive, 0x2400); (0xffff%positive, 0x4800); (0x1ffff%positive, 0x9000); (0x3ffff%positive, 0x12000); (0x7ffff%positive, 0x24000); (0xfffff%positive, 0x48000); (0x1fffff%positive, 0x90000); (0x3fffff%positive, 0x120000); (0x7fffff%positive, 0x240000); (0xffffff%positive, 0x480000); (0x1ffffff%positive, 0x900000); (0x3ffffff%positive, 0x1200000); (0x7ffffff%positive, 0x2400000); (0xfffffff%positive, 0x4800000); (0x1fffffff%positive, 0x9000000); (0x3fffffff%positive, 0x12000000); (0x7fffffff%positive, 0x24000000); (0xffffffff%positive, 0x48000000); (0x1ffffffff%positive, 0x90000000); (0x3ffffffff%positive, 0x120000000); (0x1e%positive, 0x8); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-right-33-two-4 *)
Example suite_338 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf)))))))))))))))))))))))))))))))))
  [(0x1%positive, Both R); (0x3%positive, Only R); (0x7%positive, Only R); (0xf%positive, Only R); (0x1f%positive, Both R); (0x3f%positive, Only R); (0x7f%positive, Only R); (0xff%positive, Only R); (0x1ff%positive, Only R); (0x3ff%positive, Only R); (0x7ff%positive, Only R); (0xfff%positive, Only R); (0x1fff%positive, Only R); (0x3fff%positive, Only R); (0x7fff%positive, Only R); (0xffff%positive, Only R); (0x1ffff%positive, Only R); (0x3ffff%positive, Only R); (0x7ffff%positive, Only R); (0xfffff%positive, Only R); (0x1fffff%positive, Only R); (0x3fffff%positive, Only R); (0x7fffff%positive, Only R); (0xffffff%positive, Only R); (0x1ffffff%positive, Only R); (0x3ffffff%positive, Only R); (0x7ffffff%positive, Only R); (0xfffffff%positive, Only R); (0x1fffffff%positive, Only R); (0x3fffffff%positive, Only R); (0x7fffffff%positive, Only R); (0xffffffff%positive, Only R); (0x1ffffffff%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x2); (0xf%positive, 0x4); (0x1f%positive, 0x8); (0x3f%positive, 0x11); (0x7f%positive, 0x22); (0xff%positive, 0x44); (0x1ff%positive, 0x88); (0x3ff%positive, 0x110); (0x7ff%positive, 0x220); (0xfff%positive, 0x440); (0x1fff%positive, 0x880); (0x3fff%positive, 0x1100); (0x7fff%positive, 0x2200); (0xffff%positive, 0x4400); (0x1ffff%positive, 0x8800); (0x3ffff%positive, 0x11000); (0x7ffff%positive, 0x22000); (0xfffff%positive, 0x44000); (0x1fffff%positive, 0x88000); (0x3fffff%positive, 0x110000); (0x7fffff%positive, 0x220000); (0xffffff%positive, 0x440000); (0x1ffffff%positive, 0x880000); (0x3ffffff%positive, 0x1100000); (0x7ffffff%positive, 0x2200000); (0xfffffff%positive, 0x4400000); (0x1fffffff%positive, 0x8800000); (0x3fffffff%positive, 0x11000000); (0x7fffffff%positive, 0x22000000); (0xffffffff%positive, 0x44000000); (0x1ffffffff%positive, 0x88000000); (0x3ffffffff%positive, 0x110000000); (0x3e%positive, 0x10); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-right-33-two-16 *)
Example suite_339 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf)))))))))))))))))))))))))))))))))
  [(0x1%positive, Both R); (0x3%positive, Only R); (0x7%positive, Only R); (0xf%positive, Only R); (0x1f%positive, Only R); (0x3f%positive, Only R); (0x7f%positive, Only R); (0xff%positive, Only R); (0x1ff%positive, Only R); (0x3ff%positive, Only R); (0x7ff%positive, Only R); (0xfff%positive, Only R); (0x1fff%positive, Only R); (0x3fff%positive, Only R); (0x7fff%positive, Only R); (0xffff%positive, Only R); (0x1ffff%positive, Both R); (0x3ffff%positive, Only R); (0x7ffff%positive, Only R); (0xfffff%positive, Only R); (0x1fffff%positive, Only R); (0x3fffff%positive, Only R); (0x7fffff%positive, Only R); (0xffffff%positive, Only R); (0x1ffffff%positive, Only R); (0x3ffffff%positive, Only R); (0x7ffffff%positive, Only R); (0xfffffff%positive, Only R); (0x1fffffff%positive, Only R); (0x3fffffff%positive, Only R); (0x7fffffff%positive, Only R); (0xffffffff%positive, Only R); (0x1ffffffff%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x2); (0xf%positive, 0x4); (0x1f%positive, 0x8); (0x3f%positive, 0x10); (0x7f%positive, 0x20); (0xff%positive, 0x40); (0x1ff%positive, 0x80); (0x3ff%positive, 0x100); (0x7ff%positive, 0x200); (0xfff%positive, 0x400); (0x1fff%positive, 0x800); (0x3fff%positive, 0x1000); (0x7fff%positive, 0x2000); (0xffff%positive, 0x4000); (0x1ffff%positive, 0x8000); (0x3ffff%positive, 0x10001); (0x7ffff%positive, 0x20002); (0xfffff%positive, 0x40004); (0x1fffff%positive, 0x80008); (0x3fffff%positive, 0x100010); (0x7fffff%positive, 0x200020); (0xffffff%positive, 0x400040); (0x1ffffff%positive, 0x800080); (0x3ffffff%positive, 0x1000100); (0x7ffffff%positive, 0x2000200); (0xfffffff%positive, 0x4000400); (0x1fffffff%positive, 0x8000800); (0x3fffffff%positive, 0x10001000); (0x7fffffff%positive, 0x20002000); (0xffffffff%positive, 0x40004000); (0x1ffffffff%positive, 0x80008000); (0x3ffffffff%positive, 0x100010000); (0x3fffe%positive, 0x10000); (0x2%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-turns-33-all *)
Example suite_340 : suite_seen (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node Leaf Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Both R); (0x5%positive, Both L); (0xa%positive, Both R); (0x15%positive, Both L); (0x2a%positive, Both R); (0x55%positive, Both L); (0xaa%positive, Both R); (0x155%positive, Both L); (0x2aa%positive, Both R); (0x555%positive, Both L); (0xaaa%positive, Both R); (0x1555%positive, Both L); (0x2aaa%positive, Both R); (0x5555%positive, Both L); (0xaaaa%positive, Both R); (0x15555%positive, Both L); (0x2aaaa%positive, Both R); (0x55555%positive, Both L); (0xaaaaa%positive, Both R); (0x155555%positive, Both L); (0x2aaaaa%positive, Both R); (0x555555%positive, Both L); (0xaaaaaa%positive, Both R); (0x1555555%positive, Both L); (0x2aaaaaa%positive, Both R); (0x5555555%positive, Both L); (0xaaaaaaa%positive, Both R); (0x15555555%positive, Both L); (0x2aaaaaaa%positive, Both R); (0x55555555%positive, Both L); (0xaaaaaaaa%positive, Both R); (0x155555555%positive, Both L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x3); (0xa%positive, 0x7); (0x15%positive, 0xf); (0x2a%positive, 0x1f); (0x55%positive, 0x3f); (0xaa%positive, 0x7f); (0x155%positive, 0xff); (0x2aa%positive, 0x1ff); (0x555%positive, 0x3ff); (0xaaa%positive, 0x7ff); (0x1555%positive, 0xfff); (0x2aaa%positive, 0x1fff); (0x5555%positive, 0x3fff); (0xaaaa%positive, 0x7fff); (0x15555%positive, 0xffff); (0x2aaaa%positive, 0x1ffff); (0x55555%positive, 0x3ffff); (0xaaaaa%positive, 0x7ffff); (0x155555%positive, 0xfffff); (0x2aaaaa%positive, 0x1fffff); (0x555555%positive, 0x3fffff); (0xaaaaaa%positive, 0x7fffff); (0x1555555%positive, 0xffffff); (0x2aaaaaa%positive, 0x1ffffff); (0x5555555%positive, 0x3ffffff); (0xaaaaaaa%positive, 0x7ffffff); (0x15555555%positive, 0xfffffff); (0x2aaaaaaa%positive, 0x1fffffff); (0x55555555%positive, 0x3fffffff); (0xaaaaaaaa%positive, 0x7fffffff); (0x155555555%positive, 0xffffffff); (0x2aaaaaaaa%positive, 0x1ffffffff); (0x2aaaaaaab%positive, 0x1fffffffe); (0x155555554%positive, 0xfffffffe); (0xaaaaaaab%positive, 0x7ffffffe); (0x55555554%positive, 0x3ffffffe); (0x2aaaaaab%positive, 0x1ffffffe); (0x15555554%positive, 0xffffffe); (0xaaaaaab%positive, 0x7fffffe); (0x5555554%positive, 0x3fffffe); (0x2aaaaab%positive, 0x1fffffe); (0x1555554%positive, 0xfffffe); (0xaaaaab%positive, 0x7ffffe); (0x555554%positive, 0x3ffffe); (0x2aaaab%positive, 0x1ffffe); (0x155554%positive, 0xffffe); (0xaaaab%positive, 0x7fffe); (0x55554%positive, 0x3fffe); (0x2aaab%positive, 0x1fffe); (0x15554%positive, 0xfffe); (0xaaab%positive, 0x7ffe); (0x5554%positive, 0x3ffe); (0x2aab%positive, 0x1ffe); (0x1554%positive, 0xffe); (0xaab%positive, 0x7fe); (0x554%positive, 0x3fe); (0x2ab%positive, 0x1fe); (0x154%positive, 0xfe); (0xab%positive, 0x7e); (0x54%positive, 0x3e); (0x2b%positive, 0x1e); (0x14%positive, 0xe); (0xb%positive, 0x6); (0x4%positive, 0x2); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-turns-33-first *)
Example suite_341 : suite_seen (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node Leaf Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only R); (0x5%positive, Only L); (0xa%positive, Only R); (0x15%positive, Only L); (0x2a%positive, Only R); (0x55%positive, Only L); (0xaa%positive, Only R); (0x155%positive, Only L); (0x2aa%positive, Only R); (0x555%positive, Only L); (0xaaa%positive, Only R); (0x1555%positive, Only L); (0x2aaa%positive, Only R); (0x5555%positive, Only L); (0xaaaa%positive, Only R); (0x15555%positive, Only L); (0x2aaaa%positive, Only R); (0x55555%positive, Only L); (0xaaaaa%positive, Only R); (0x155555%positive, Only L); (0x2aaaaa%positive, Only R); (0x555555%positive, Only L); (0xaaaaaa%positive, Only R); (0x1555555%positive, Only L); (0x2aaaaaa%positive, Only R); (0x5555555%positive, Only L); (0xaaaaaaa%positive, Only R); (0x15555555%positive, Only L); (0x2aaaaaaa%positive, Only R); (0x55555555%positive, Only L); (0xaaaaaaaa%positive, Only R); (0x155555555%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x2); (0xa%positive, 0x4); (0x15%positive, 0x8); (0x2a%positive, 0x10); (0x55%positive, 0x20); (0xaa%positive, 0x40); (0x155%positive, 0x80); (0x2aa%positive, 0x100); (0x555%positive, 0x200); (0xaaa%positive, 0x400); (0x1555%positive, 0x800); (0x2aaa%positive, 0x1000); (0x5555%positive, 0x2000); (0xaaaa%positive, 0x4000); (0x15555%positive, 0x8000); (0x2aaaa%positive, 0x10000); (0x55555%positive, 0x20000); (0xaaaaa%positive, 0x40000); (0x155555%positive, 0x80000); (0x2aaaaa%positive, 0x100000); (0x555555%positive, 0x200000); (0xaaaaaa%positive, 0x400000); (0x1555555%positive, 0x800000); (0x2aaaaaa%positive, 0x1000000); (0x5555555%positive, 0x2000000); (0xaaaaaaa%positive, 0x4000000); (0x15555555%positive, 0x8000000); (0x2aaaaaaa%positive, 0x10000000); (0x55555555%positive, 0x20000000); (0xaaaaaaaa%positive, 0x40000000); (0x155555555%positive, 0x80000000); (0x2aaaaaaaa%positive, 0x100000000); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-turns-33-two-1 *)
Example suite_342 : suite_seen (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node Leaf Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Both R); (0x5%positive, Only L); (0xa%positive, Only R); (0x15%positive, Only L); (0x2a%positive, Only R); (0x55%positive, Only L); (0xaa%positive, Only R); (0x155%positive, Only L); (0x2aa%positive, Only R); (0x555%positive, Only L); (0xaaa%positive, Only R); (0x1555%positive, Only L); (0x2aaa%positive, Only R); (0x5555%positive, Only L); (0xaaaa%positive, Only R); (0x15555%positive, Only L); (0x2aaaa%positive, Only R); (0x55555%positive, Only L); (0xaaaaa%positive, Only R); (0x155555%positive, Only L); (0x2aaaaa%positive, Only R); (0x555555%positive, Only L); (0xaaaaaa%positive, Only R); (0x1555555%positive, Only L); (0x2aaaaaa%positive, Only R); (0x5555555%positive, Only L); (0xaaaaaaa%positive, Only R); (0x15555555%positive, Only L); (0x2aaaaaaa%positive, Only R); (0x55555555%positive, Only L); (0xaaaaaaaa%positive, Only R); (0x155555555%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x3); (0xa%positive, 0x6); (0x15%positive, 0xc); (0x2a%positive, 0x18); (0x55%positive, 0x30); (0xaa%positive, 0x60); (0x155%positive, 0xc0); (0x2aa%positive, 0x180); (0x555%positive, 0x300); (0xaaa%positive, 0x600); (0x1555%positive, 0xc00); (0x2aaa%positive, 0x1800); (0x5555%positive, 0x3000); (0xaaaa%positive, 0x6000); (0x15555%positive, 0xc000); (0x2aaaa%positive, 0x18000); (0x55555%positive, 0x30000); (0xaaaaa%positive, 0x60000); (0x155555%positive, 0xc0000); (0x2aaaaa%positive, 0x180000); (0x555555%positive, 0x300000); (0xaaaaaa%positive, 0x600000); (0x1555555%positive, 0xc00000); (0x2aaaaaa%positive, 0x1800000); (0x5555555%positive, 0x3000000); (0xaaaaaaa%positive, 0x6000000); (0x15555555%positive, 0xc000000); (0x2aaaaaaa%positive, 0x18000000); (0x55555555%positive, 0x30000000); (0xaaaaaaaa%positive, 0x60000000); (0x155555555%positive, 0xc0000000); (0x2aaaaaaaa%positive, 0x180000000); (0x4%positive, 0x2); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-turns-33-two-2 *)
Example suite_343 : suite_seen (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node Leaf Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only R); (0x5%positive, Both L); (0xa%positive, Only R); (0x15%positive, Only L); (0x2a%positive, Only R); (0x55%positive, Only L); (0xaa%positive, Only R); (0x155%positive, Only L); (0x2aa%positive, Only R); (0x555%positive, Only L); (0xaaa%positive, Only R); (0x1555%positive, Only L); (0x2aaa%positive, Only R); (0x5555%positive, Only L); (0xaaaa%positive, Only R); (0x15555%positive, Only L); (0x2aaaa%positive, Only R); (0x55555%positive, Only L); (0xaaaaa%positive, Only R); (0x155555%positive, Only L); (0x2aaaaa%positive, Only R); (0x555555%positive, Only L); (0xaaaaaa%positive, Only R); (0x1555555%positive, Only L); (0x2aaaaaa%positive, Only R); (0x5555555%positive, Only L); (0xaaaaaaa%positive, Only R); (0x15555555%positive, Only L); (0x2aaaaaaa%positive, Only R); (0x55555555%positive, Only L); (0xaaaaaaaa%positive, Only R); (0x155555555%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x2); (0xa%positive, 0x5); (0x15%positive, 0xa); (0x2a%positive, 0x14); (0x55%positive, 0x28); (0xaa%positive, 0x50); (0x155%positive, 0xa0); (0x2aa%positive, 0x140); (0x555%positive, 0x280); (0xaaa%positive, 0x500); (0x1555%positive, 0xa00); (0x2aaa%positive, 0x1400); (0x5555%positive, 0x2800); (0xaaaa%positive, 0x5000); (0x15555%positive, 0xa000); (0x2aaaa%positive, 0x14000); (0x55555%positive, 0x28000); (0xaaaaa%positive, 0x50000); (0x155555%positive, 0xa0000); (0x2aaaaa%positive, 0x140000); (0x555555%positive, 0x280000); (0xaaaaaa%positive, 0x500000); (0x1555555%positive, 0xa00000); (0x2aaaaaa%positive, 0x1400000); (0x5555555%positive, 0x2800000); (0xaaaaaaa%positive, 0x5000000); (0x15555555%positive, 0xa000000); (0x2aaaaaaa%positive, 0x14000000); (0x55555555%positive, 0x28000000); (0xaaaaaaaa%positive, 0x50000000); (0x155555555%positive, 0xa0000000); (0x2aaaaaaaa%positive, 0x140000000); (0xb%positive, 0x4); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-turns-33-two-3 *)
Example suite_344 : suite_seen (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node Leaf Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only R); (0x5%positive, Only L); (0xa%positive, Both R); (0x15%positive, Only L); (0x2a%positive, Only R); (0x55%positive, Only L); (0xaa%positive, Only R); (0x155%positive, Only L); (0x2aa%positive, Only R); (0x555%positive, Only L); (0xaaa%positive, Only R); (0x1555%positive, Only L); (0x2aaa%positive, Only R); (0x5555%positive, Only L); (0xaaaa%positive, Only R); (0x15555%positive, Only L); (0x2aaaa%positive, Only R); (0x55555%positive, Only L); (0xaaaaa%positive, Only R); (0x155555%positive, Only L); (0x2aaaaa%positive, Only R); (0x555555%positive, Only L); (0xaaaaaa%positive, Only R); (0x1555555%positive, Only L); (0x2aaaaaa%positive, Only R); (0x5555555%positive, Only L); (0xaaaaaaa%positive, Only R); (0x15555555%positive, Only L); (0x2aaaaaaa%positive, Only R); (0x55555555%positive, Only L); (0xaaaaaaaa%positive, Only R); (0x155555555%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x2); (0xa%positive, 0x4); (0x15%positive, 0x9); (0x2a%positive, 0x12); (0x55%positive, 0x24); (0xaa%positive, 0x48); (0x155%positive, 0x90); (0x2aa%positive, 0x120); (0x555%positive, 0x240); (0xaaa%positive, 0x480); (0x1555%positive, 0x900); (0x2aaa%positive, 0x1200); (0x5555%positive, 0x2400); (0xaaaa%positive, 0x4800); (0x15555%positive, 0x9000); (0x2aaaa%positive, 0x12000); (0x55555%positive, 0x24000); (0xaaaaa%positive, 0x48000); (0x155555%positive, 0x90000); (0x2aaaaa%positive, 0x120000); (0x555555%positive, 0x240000); (0xaaaaaa%positive, 0x480000); (0x1555555%positive, 0x900000); (0x2aaaaaa%positive, 0x1200000); (0x5555555%positive, 0x2400000); (0xaaaaaaa%positive, 0x4800000); (0x15555555%positive, 0x9000000); (0x2aaaaaaa%positive, 0x12000000); (0x55555555%positive, 0x24000000); (0xaaaaaaaa%positive, 0x48000000); (0x155555555%positive, 0x90000000); (0x2aaaaaaaa%positive, 0x120000000); (0x14%positive, 0x8); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-turns-33-two-4 *)
Example suite_345 : suite_seen (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node Leaf Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only R); (0x5%positive, Only L); (0xa%positive, Only R); (0x15%positive, Both L); (0x2a%positive, Only R); (0x55%positive, Only L); (0xaa%positive, Only R); (0x155%positive, Only L); (0x2aa%positive, Only R); (0x555%positive, Only L); (0xaaa%positive, Only R); (0x1555%positive, Only L); (0x2aaa%positive, Only R); (0x5555%positive, Only L); (0xaaaa%positive, Only R); (0x15555%positive, Only L); (0x2aaaa%positive, Only R); (0x55555%positive, Only L); (0xaaaaa%positive, Only R); (0x155555%positive, Only L); (0x2aaaaa%positive, Only R); (0x555555%positive, Only L); (0xaaaaaa%positive, Only R); (0x1555555%positive, Only L); (0x2aaaaaa%positive, Only R); (0x5555555%positive, Only L); (0xaaaaaaa%positive, Only R); (0x15555555%positive, Only L); (0x2aaaaaaa%positive, Only R); (0x55555555%positive, Only L); (0xaaaaaaaa%positive, Only R); (0x155555555%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x2); (0xa%positive, 0x4); (0x15%positive, 0x8); (0x2a%positive, 0x11); (0x55%positive, 0x22); (0xaa%positive, 0x44); (0x155%positive, 0x88); (0x2aa%positive, 0x110); (0x555%positive, 0x220); (0xaaa%positive, 0x440); (0x1555%positive, 0x880); (0x2aaa%positive, 0x1100); (0x5555%positive, 0x2200); (0xaaaa%positive, 0x4400); (0x15555%positive, 0x8800); (0x2aaaa%positive, 0x11000); (0x55555%positive, 0x22000); (0xaaaaa%positive, 0x44000); (0x155555%positive, 0x88000); (0x2aaaaa%positive, 0x110000); (0x555555%positive, 0x220000); (0xaaaaaa%positive, 0x440000); (0x1555555%positive, 0x880000); (0x2aaaaaa%positive, 0x1100000); (0x5555555%positive, 0x2200000); (0xaaaaaaa%positive, 0x4400000); (0x15555555%positive, 0x8800000); (0x2aaaaaaa%positive, 0x11000000); (0x55555555%positive, 0x22000000); (0xaaaaaaaa%positive, 0x44000000); (0x155555555%positive, 0x88000000); (0x2aaaaaaaa%positive, 0x110000000); (0x2b%positive, 0x10); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-turns-33-two-16 *)
Example suite_346 : suite_seen (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node Leaf Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Only R); (0x5%positive, Only L); (0xa%positive, Only R); (0x15%positive, Only L); (0x2a%positive, Only R); (0x55%positive, Only L); (0xaa%positive, Only R); (0x155%positive, Only L); (0x2aa%positive, Only R); (0x555%positive, Only L); (0xaaa%positive, Only R); (0x1555%positive, Only L); (0x2aaa%positive, Only R); (0x5555%positive, Only L); (0xaaaa%positive, Only R); (0x15555%positive, Both L); (0x2aaaa%positive, Only R); (0x55555%positive, Only L); (0xaaaaa%positive, Only R); (0x155555%positive, Only L); (0x2aaaaa%positive, Only R); (0x555555%positive, Only L); (0xaaaaaa%positive, Only R); (0x1555555%positive, Only L); (0x2aaaaaa%positive, Only R); (0x5555555%positive, Only L); (0xaaaaaaa%positive, Only R); (0x15555555%positive, Only L); (0x2aaaaaaa%positive, Only R); (0x55555555%positive, Only L); (0xaaaaaaaa%positive, Only R); (0x155555555%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x5%positive, 0x2); (0xa%positive, 0x4); (0x15%positive, 0x8); (0x2a%positive, 0x10); (0x55%positive, 0x20); (0xaa%positive, 0x40); (0x155%positive, 0x80); (0x2aa%positive, 0x100); (0x555%positive, 0x200); (0xaaa%positive, 0x400); (0x1555%positive, 0x800); (0x2aaa%positive, 0x1000); (0x5555%positive, 0x2000); (0xaaaa%positive, 0x4000); (0x15555%positive, 0x8000); (0x2aaaa%positive, 0x10001); (0x55555%positive, 0x20002); (0xaaaaa%positive, 0x40004); (0x155555%positive, 0x80008); (0x2aaaaa%positive, 0x100010); (0x555555%positive, 0x200020); (0xaaaaaa%positive, 0x400040); (0x1555555%positive, 0x800080); (0x2aaaaaa%positive, 0x1000100); (0x5555555%positive, 0x2000200); (0xaaaaaaa%positive, 0x4000400); (0x15555555%positive, 0x8000800); (0x2aaaaaaa%positive, 0x10001000); (0x55555555%positive, 0x20002000); (0xaaaaaaaa%positive, 0x40004000); (0x155555555%positive, 0x80008000); (0x2aaaaaaaa%positive, 0x100010000); (0x2aaab%positive, 0x10000); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-8-only *)
Example suite_347 : suite_seen (Node (Node (Node (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Only L); (0x2%positive, Only L); (0x4%positive, Only L); (0x8%positive, Only L); (0x10%positive, Only L); (0x20%positive, Only L); (0x40%positive, Only L); (0x80%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x0); (0x4%positive, 0x0); (0x8%positive, 0x0); (0x10%positive, 0x0); (0x20%positive, 0x0); (0x40%positive, 0x0); (0x80%positive, 0x0); (0x100%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-8-stop *)
Example suite_348 : suite_seen (Node (Node (Node (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Both L); (0x4%positive, Both L); (0x8%positive, Both L); (0x10%positive, Both L); (0x20%positive, Both L); (0x40%positive, Both L); (0x80%positive, Both L)]
  [0x100%positive]
  = suite_expected true
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x3); (0x8%positive, 0x7); (0x10%positive, 0xf); (0x20%positive, 0x1f); (0x40%positive, 0x3f); (0x80%positive, 0x7f); (0x100%positive, 0xff)].
Proof. evaluated. Qed.

(* trace/script/chain-right-8-only *)
Example suite_349 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf))))))))
  [(0x1%positive, Only R); (0x3%positive, Only R); (0x7%positive, Only R); (0xf%positive, Only R); (0x1f%positive, Only R); (0x3f%positive, Only R); (0x7f%positive, Only R); (0xff%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x0); (0x7%positive, 0x0); (0xf%positive, 0x0); (0x1f%positive, 0x0); (0x3f%positive, 0x0); (0x7f%positive, 0x0); (0xff%positive, 0x0); (0x1ff%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-right-8-stop *)
Example suite_350 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf))))))))
  [(0x1%positive, Both R); (0x3%positive, Both R); (0x7%positive, Both R); (0xf%positive, Both R); (0x1f%positive, Both R); (0x3f%positive, Both R); (0x7f%positive, Both R); (0xff%positive, Both R)]
  [0x1ff%positive]
  = suite_expected true
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x3); (0xf%positive, 0x7); (0x1f%positive, 0xf); (0x3f%positive, 0x1f); (0x7f%positive, 0x3f); (0xff%positive, 0x7f); (0x1ff%positive, 0xff)].
Proof. evaluated. Qed.

(* trace/script/chain-left-31-only *)
Example suite_351 : suite_seen (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Only L); (0x2%positive, Only L); (0x4%positive, Only L); (0x8%positive, Only L); (0x10%positive, Only L); (0x20%positive, Only L); (0x40%positive, Only L); (0x80%positive, Only L); (0x100%positive, Only L); (0x200%positive, Only L); (0x400%positive, Only L); (0x800%positive, Only L); (0x1000%positive, Only L); (0x2000%positive, Only L); (0x4000%positive, Only L); (0x8000%positive, Only L); (0x10000%positive, Only L); (0x20000%positive, Only L); (0x40000%positive, Only L); (0x80000%positive, Only L); (0x100000%positive, Only L); (0x200000%positive, Only L); (0x400000%positive, Only L); (0x800000%positive, Only L); (0x1000000%positive, Only L); (0x2000000%positive, Only L); (0x4000000%positive, Only L); (0x8000000%positive, Only L); (0x10000000%positive, Only L); (0x20000000%positive, Only L); (0x40000000%positive, Only L)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x0); (0x4%positive, 0x0); (0x8%positive, 0x0); (0x10%positive, 0x0); (0x20%positive, 0x0); (0x40%positive, 0x0); (0x80%positive, 0x0); (0x100%positive, 0x0); (0x200%positive, 0x0); (0x400%positive, 0x0); (0x800%positive, 0x0); (0x1000%positive, 0x0); (0x2000%positive, 0x0); (0x4000%positive, 0x0); (0x8000%positive, 0x0); (0x10000%positive, 0x0); (0x20000%positive, 0x0); (0x40000%positive, 0x0); (0x80000%positive, 0x0); (0x100000%positive, 0x0); (0x200000%positive, 0x0); (0x400000%positive, 0x0); (0x800000%positive, 0x0); (0x1000000%positive, 0x0); (0x2000000%positive, 0x0); (0x4000000%positive, 0x0); (0x8000000%positive, 0x0); (0x10000000%positive, 0x0); (0x20000000%positive, 0x0); (0x40000000%positive, 0x0); (0x80000000%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-left-31-stop *)
Example suite_352 : suite_seen (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf) Leaf)
  [(0x1%positive, Both L); (0x2%positive, Both L); (0x4%positive, Both L); (0x8%positive, Both L); (0x10%positive, Both L); (0x20%positive, Both L); (0x40%positive, Both L); (0x80%positive, Both L); (0x100%positive, Both L); (0x200%positive, Both L); (0x400%positive, Both L); (0x800%positive, Both L); (0x1000%positive, Both L); (0x2000%positive, Both L); (0x4000%positive, Both L); (0x8000%positive, Both L); (0x10000%positive, Both L); (0x20000%positive, Both L); (0x40000%positive, Both L); (0x80000%positive, Both L); (0x100000%positive, Both L); (0x200000%positive, Both L); (0x400000%positive, Both L); (0x800000%positive, Both L); (0x1000000%positive, Both L); (0x2000000%positive, Both L); (0x4000000%positive, Both L); (0x8000000%positive, Both L); (0x10000000%positive, Both L); (0x20000000%positive, Both L); (0x40000000%positive, Both L)]
  [0x80000000%positive]
  = suite_expected true
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x3); (0x8%positive, 0x7); (0x10%positive, 0xf); (0x20%positive, 0x1f); (0x40%positive, 0x3f); (0x80%positive, 0x7f); (0x100%positive, 0xff); (0x200%positive, 0x1ff); (0x400%positive, 0x3ff); (0x800%positive, 0x7ff); (0x1000%positive, 0xfff); (0x2000%positive, 0x1fff); (0x4000%positive, 0x3fff); (0x8000%positive, 0x7fff); (0x10000%positive, 0xffff); (0x20000%positive, 0x1ffff); (0x40000%positive, 0x3ffff); (0x80000%positive, 0x7ffff); (0x100000%positive, 0xfffff); (0x200000%positive, 0x1fffff); (0x400000%positive, 0x3fffff); (0x800000%positive, 0x7fffff); (0x1000000%positive, 0xffffff); (0x2000000%positive, 0x1ffffff); (0x4000000%positive, 0x3ffffff); (0x8000000%positive, 0x7ffffff); (0x10000000%positive, 0xfffffff); (0x20000000%positive, 0x1fffffff); (0x40000000%positive, 0x3fffffff); (0x80000000%positive, 0x7fffffff)].
Proof. evaluated. Qed.

(* trace/script/chain-right-31-only *)
Example suite_353 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf)))))))))))))))))))))))))))))))
  [(0x1%positive, Only R); (0x3%positive, Only R); (0x7%positive, Only R); (0xf%positive, Only R); (0x1f%positive, Only R); (0x3f%positive, Only R); (0x7f%positive, Only R); (0xff%positive, Only R); (0x1ff%positive, Only R); (0x3ff%positive, Only R); (0x7ff%positive, Only R); (0xfff%positive, Only R); (0x1fff%positive, Only R); (0x3fff%positive, Only R); (0x7fff%positive, Only R); (0xffff%positive, Only R); (0x1ffff%positive, Only R); (0x3ffff%positive, Only R); (0x7ffff%positive, Only R); (0xfffff%positive, Only R); (0x1fffff%positive, Only R); (0x3fffff%positive, Only R); (0x7fffff%positive, Only R); (0xffffff%positive, Only R); (0x1ffffff%positive, Only R); (0x3ffffff%positive, Only R); (0x7ffffff%positive, Only R); (0xfffffff%positive, Only R); (0x1fffffff%positive, Only R); (0x3fffffff%positive, Only R); (0x7fffffff%positive, Only R)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x3%positive, 0x0); (0x7%positive, 0x0); (0xf%positive, 0x0); (0x1f%positive, 0x0); (0x3f%positive, 0x0); (0x7f%positive, 0x0); (0xff%positive, 0x0); (0x1ff%positive, 0x0); (0x3ff%positive, 0x0); (0x7ff%positive, 0x0); (0xfff%positive, 0x0); (0x1fff%positive, 0x0); (0x3fff%positive, 0x0); (0x7fff%positive, 0x0); (0xffff%positive, 0x0); (0x1ffff%positive, 0x0); (0x3ffff%positive, 0x0); (0x7ffff%positive, 0x0); (0xfffff%positive, 0x0); (0x1fffff%positive, 0x0); (0x3fffff%positive, 0x0); (0x7fffff%positive, 0x0); (0xffffff%positive, 0x0); (0x1ffffff%positive, 0x0); (0x3ffffff%positive, 0x0); (0x7ffffff%positive, 0x0); (0xfffffff%positive, 0x0); (0x1fffffff%positive, 0x0); (0x3fffffff%positive, 0x0); (0x7fffffff%positive, 0x0); (0xffffffff%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/chain-right-31-stop *)
Example suite_354 : suite_seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf)))))))))))))))))))))))))))))))
  [(0x1%positive, Both R); (0x3%positive, Both R); (0x7%positive, Both R); (0xf%positive, Both R); (0x1f%positive, Both R); (0x3f%positive, Both R); (0x7f%positive, Both R); (0xff%positive, Both R); (0x1ff%positive, Both R); (0x3ff%positive, Both R); (0x7ff%positive, Both R); (0xfff%positive, Both R); (0x1fff%positive, Both R); (0x3fff%positive, Both R); (0x7fff%positive, Both R); (0xffff%positive, Both R); (0x1ffff%positive, Both R); (0x3ffff%positive, Both R); (0x7ffff%positive, Both R); (0xfffff%positive, Both R); (0x1fffff%positive, Both R); (0x3fffff%positive, Both R); (0x7fffff%positive, Both R); (0xffffff%positive, Both R); (0x1ffffff%positive, Both R); (0x3ffffff%positive, Both R); (0x7ffffff%positive, Both R); (0xfffffff%positive, Both R); (0x1fffffff%positive, Both R); (0x3fffffff%positive, Both R); (0x7fffffff%positive, Both R)]
  [0xffffffff%positive]
  = suite_expected true
  [(0x1%positive, 0x0); (0x3%positive, 0x1); (0x7%positive, 0x3); (0xf%positive, 0x7); (0x1f%positive, 0xf); (0x3f%positive, 0x1f); (0x7f%positive, 0x3f); (0xff%positive, 0x7f); (0x1ff%positive, 0xff); (0x3ff%positive, 0x1ff); (0x7ff%positive, 0x3ff); (0xfff%positive, 0x7ff); (0x1fff%positive, 0xfff); (0x3fff%positive, 0x1fff); (0x7fff%positive, 0x3fff); (0xffff%positive, 0x7fff); (0x1ffff%positive, 0xffff); (0x3ffff%positive, 0x1ffff); (0x7ffff%positive, 0x3ffff); (0xfffff%positive, 0x7ffff); (0x1fffff%positive, 0xfffff); (0x3fffff%positive, 0x1fffff); (0x7fffff%positive, 0x3fffff); (0xffffff%positive, 0x7fffff); (0x1ffffff%positive, 0xffffff); (0x3ffffff%positive, 0x1ffffff); (0x7ffffff%positive, 0x3ffffff); (0xfffffff%positive, 0x7ffffff); (0x1fffffff%positive, 0xfffffff); (0x3fffffff%positive, 0x1fffffff); (0x7fffffff%positive, 0x3fffffff); (0xffffffff%positive, 0x7fffffff)].
Proof. evaluated. Qed.

(* trace/script/after-far-0-0-1 *)
Example suite_355 : suite_seen (Node (Node Leaf (Node Leaf Leaf)) (Node Leaf Leaf))
  [(0x1%positive, Both L); (0x2%positive, Both L); (0x5%positive, Only L); (0x3%positive, Neither)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x3); (0x5%positive, 0x2); (0xa%positive, 0x4); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/after-far-0-0-2 *)
Example suite_356 : suite_seen (Node (Node Leaf (Node (Node Leaf Leaf) Leaf)) (Node Leaf Leaf))
  [(0x1%positive, Both L); (0x2%positive, Both L); (0x5%positive, Only L); (0xa%positive, Only L); (0x3%positive, Neither)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x3); (0x5%positive, 0x2); (0xa%positive, 0x4); (0x14%positive, 0x8); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/after-far-0-0-3 *)
Example suite_357 : suite_seen (Node (Node Leaf (Node (Node (Node Leaf Leaf) Leaf) Leaf)) (Node Leaf Leaf))
  [(0x1%positive, Both L); (0x2%positive, Both L); (0x5%positive, Only L); (0xa%positive, Only L); (0x14%positive, Only L); (0x3%positive, Neither)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x3); (0x5%positive, 0x2); (0xa%positive, 0x4); (0x14%positive, 0x8); (0x28%positive, 0x10); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/after-far-0-3-1 *)
Example suite_358 : suite_seen (Node (Node (Node Leaf (Node Leaf (Node Leaf Leaf))) (Node Leaf Leaf)) (Node Leaf Leaf))
  [(0x1%positive, Both L); (0x2%positive, Both L); (0x4%positive, Only R); (0x9%positive, Only R); (0x13%positive, Only R); (0x5%positive, Only L); (0x3%positive, Neither)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x3); (0x9%positive, 0x6); (0x13%positive, 0xc); (0x27%positive, 0x18); (0x5%positive, 0x2); (0xa%positive, 0x4); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/after-far-0-3-2 *)
Example suite_359 : suite_seen (Node (Node (Node Leaf (Node Leaf (Node Leaf Leaf))) (Node (Node Leaf Leaf) Leaf)) (Node Leaf Leaf))
  [(0x1%positive, Both L); (0x2%positive, Both L); (0x4%positive, Only R); (0x9%positive, Only R); (0x13%positive, Only R); (0x5%positive, Only L); (0xa%positive, Only L); (0x3%positive, Neither)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x3); (0x9%positive, 0x6); (0x13%positive, 0xc); (0x27%positive, 0x18); (0x5%positive, 0x2); (0xa%positive, 0x4); (0x14%positive, 0x8); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/after-far-0-3-3 *)
Example suite_360 : suite_seen (Node (Node (Node Leaf (Node Leaf (Node Leaf Leaf))) (Node (Node (Node Leaf Leaf) Leaf) Leaf)) (Node Leaf Leaf))
  [(0x1%positive, Both L); (0x2%positive, Both L); (0x4%positive, Only R); (0x9%positive, Only R); (0x13%positive, Only R); (0x5%positive, Only L); (0xa%positive, Only L); (0x14%positive, Only L); (0x3%positive, Neither)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x3); (0x9%positive, 0x6); (0x13%positive, 0xc); (0x27%positive, 0x18); (0x5%positive, 0x2); (0xa%positive, 0x4); (0x14%positive, 0x8); (0x28%positive, 0x10); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/after-far-1-0-1 *)
Example suite_361 : suite_seen (Node (Node (Node Leaf (Node Leaf Leaf)) Leaf) (Node Leaf Leaf))
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Both L); (0x9%positive, Only L); (0x3%positive, Neither)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x8%positive, 0x5); (0x9%positive, 0x4); (0x12%positive, 0x8); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/after-far-1-0-2 *)
Example suite_362 : suite_seen (Node (Node (Node Leaf (Node (Node Leaf Leaf) Leaf)) Leaf) (Node Leaf Leaf))
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Both L); (0x9%positive, Only L); (0x12%positive, Only L); (0x3%positive, Neither)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x8%positive, 0x5); (0x9%positive, 0x4); (0x12%positive, 0x8); (0x24%positive, 0x10); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/after-far-1-0-3 *)
Example suite_363 : suite_seen (Node (Node (Node Leaf (Node (Node (Node Leaf Leaf) Leaf) Leaf)) Leaf) (Node Leaf Leaf))
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Both L); (0x9%positive, Only L); (0x12%positive, Only L); (0x24%positive, Only L); (0x3%positive, Neither)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x8%positive, 0x5); (0x9%positive, 0x4); (0x12%positive, 0x8); (0x24%positive, 0x10); (0x48%positive, 0x20); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/after-far-1-3-1 *)
Example suite_364 : suite_seen (Node (Node (Node (Node Leaf (Node Leaf (Node Leaf Leaf))) (Node Leaf Leaf)) Leaf) (Node Leaf Leaf))
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Both L); (0x8%positive, Only R); (0x11%positive, Only R); (0x23%positive, Only R); (0x9%positive, Only L); (0x3%positive, Neither)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x8%positive, 0x5); (0x11%positive, 0xa); (0x23%positive, 0x14); (0x47%positive, 0x28); (0x9%positive, 0x4); (0x12%positive, 0x8); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/after-far-1-3-2 *)
Example suite_365 : suite_seen (Node (Node (Node (Node Leaf (Node Leaf (Node Leaf Leaf))) (Node (Node Leaf Leaf) Leaf)) Leaf) (Node Leaf Leaf))
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Both L); (0x8%positive, Only R); (0x11%positive, Only R); (0x23%positive, Only R); (0x9%positive, Only L); (0x12%positive, Only L); (0x3%positive, Neither)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x8%positive, 0x5); (0x11%positive, 0xa); (0x23%positive, 0x14); (0x47%positive, 0x28); (0x9%positive, 0x4); (0x12%positive, 0x8); (0x24%positive, 0x10); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/after-far-1-3-3 *)
Example suite_366 : suite_seen (Node (Node (Node (Node Leaf (Node Leaf (Node Leaf Leaf))) (Node (Node (Node Leaf Leaf) Leaf) Leaf)) Leaf) (Node Leaf Leaf))
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Both L); (0x8%positive, Only R); (0x11%positive, Only R); (0x23%positive, Only R); (0x9%positive, Only L); (0x12%positive, Only L); (0x24%positive, Only L); (0x3%positive, Neither)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x8%positive, 0x5); (0x11%positive, 0xa); (0x23%positive, 0x14); (0x47%positive, 0x28); (0x9%positive, 0x4); (0x12%positive, 0x8); (0x24%positive, 0x10); (0x48%positive, 0x20); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/after-far-2-0-1 *)
Example suite_367 : suite_seen (Node (Node (Node (Node Leaf (Node Leaf Leaf)) Leaf) Leaf) (Node Leaf Leaf))
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Only L); (0x8%positive, Both L); (0x11%positive, Only L); (0x3%positive, Neither)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x8%positive, 0x4); (0x10%positive, 0x9); (0x11%positive, 0x8); (0x22%positive, 0x10); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/after-far-2-0-2 *)
Example suite_368 : suite_seen (Node (Node (Node (Node Leaf (Node (Node Leaf Leaf) Leaf)) Leaf) Leaf) (Node Leaf Leaf))
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Only L); (0x8%positive, Both L); (0x11%positive, Only L); (0x22%positive, Only L); (0x3%positive, Neither)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x8%positive, 0x4); (0x10%positive, 0x9); (0x11%positive, 0x8); (0x22%positive, 0x10); (0x44%positive, 0x20); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/after-far-2-0-3 *)
Example suite_369 : suite_seen (Node (Node (Node (Node Leaf (Node (Node (Node Leaf Leaf) Leaf) Leaf)) Leaf) Leaf) (Node Leaf Leaf))
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Only L); (0x8%positive, Both L); (0x11%positive, Only L); (0x22%positive, Only L); (0x44%positive, Only L); (0x3%positive, Neither)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x8%positive, 0x4); (0x10%positive, 0x9); (0x11%positive, 0x8); (0x22%positive, 0x10); (0x44%positive, 0x20); (0x88%positive, 0x40); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/after-far-2-3-1 *)
Example suite_370 : suite_seen (Node (Node (Node (Node (Node Leaf (Node Leaf (Node Leaf Leaf))) (Node Leaf Leaf)) Leaf) Leaf) (Node Leaf Leaf))
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Only L); (0x8%positive, Both L); (0x10%positive, Only R); (0x21%positive, Only R); (0x43%positive, Only R); (0x11%positive, Only L); (0x3%positive, Neither)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x8%positive, 0x4); (0x10%positive, 0x9); (0x21%positive, 0x12); (0x43%positive, 0x24); (0x87%positive, 0x48); (0x11%positive, 0x8); (0x22%positive, 0x10); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/after-far-2-3-2 *)
Example suite_371 : suite_seen (Node (Node (Node (Node (Node Leaf (Node Leaf (Node Leaf Leaf))) (Node (Node Leaf Leaf) Leaf)) Leaf) Leaf) (Node Leaf Leaf))
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Only L); (0x8%positive, Both L); (0x10%positive, Only R); (0x21%positive, Only R); (0x43%positive, Only R); (0x11%positive, Only L); (0x22%positive, Only L); (0x3%positive, Neither)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x8%positive, 0x4); (0x10%positive, 0x9); (0x21%positive, 0x12); (0x43%positive, 0x24); (0x87%positive, 0x48); (0x11%positive, 0x8); (0x22%positive, 0x10); (0x44%positive, 0x20); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/after-far-2-3-3 *)
Example suite_372 : suite_seen (Node (Node (Node (Node (Node Leaf (Node Leaf (Node Leaf Leaf))) (Node (Node (Node Leaf Leaf) Leaf) Leaf)) Leaf) Leaf) (Node Leaf Leaf))
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Only L); (0x8%positive, Both L); (0x10%positive, Only R); (0x21%positive, Only R); (0x43%positive, Only R); (0x11%positive, Only L); (0x22%positive, Only L); (0x44%positive, Only L); (0x3%positive, Neither)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x8%positive, 0x4); (0x10%positive, 0x9); (0x21%positive, 0x12); (0x43%positive, 0x24); (0x87%positive, 0x48); (0x11%positive, 0x8); (0x22%positive, 0x10); (0x44%positive, 0x20); (0x88%positive, 0x40); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/after-far-3-0-1 *)
Example suite_373 : suite_seen (Node (Node (Node (Node (Node Leaf (Node Leaf Leaf)) Leaf) Leaf) Leaf) (Node Leaf Leaf))
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Only L); (0x8%positive, Only L); (0x10%positive, Both L); (0x21%positive, Only L); (0x3%positive, Neither)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x8%positive, 0x4); (0x10%positive, 0x8); (0x20%positive, 0x11); (0x21%positive, 0x10); (0x42%positive, 0x20); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/after-far-3-0-2 *)
Example suite_374 : suite_seen (Node (Node (Node (Node (Node Leaf (Node (Node Leaf Leaf) Leaf)) Leaf) Leaf) Leaf) (Node Leaf Leaf))
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Only L); (0x8%positive, Only L); (0x10%positive, Both L); (0x21%positive, Only L); (0x42%positive, Only L); (0x3%positive, Neither)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x8%positive, 0x4); (0x10%positive, 0x8); (0x20%positive, 0x11); (0x21%positive, 0x10); (0x42%positive, 0x20); (0x84%positive, 0x40); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/after-far-3-0-3 *)
Example suite_375 : suite_seen (Node (Node (Node (Node (Node Leaf (Node (Node (Node Leaf Leaf) Leaf) Leaf)) Leaf) Leaf) Leaf) (Node Leaf Leaf))
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Only L); (0x8%positive, Only L); (0x10%positive, Both L); (0x21%positive, Only L); (0x42%positive, Only L); (0x84%positive, Only L); (0x3%positive, Neither)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x8%positive, 0x4); (0x10%positive, 0x8); (0x20%positive, 0x11); (0x21%positive, 0x10); (0x42%positive, 0x20); (0x84%positive, 0x40); (0x108%positive, 0x80); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/after-far-3-3-1 *)
Example suite_376 : suite_seen (Node (Node (Node (Node (Node (Node Leaf (Node Leaf (Node Leaf Leaf))) (Node Leaf Leaf)) Leaf) Leaf) Leaf) (Node Leaf Leaf))
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Only L); (0x8%positive, Only L); (0x10%positive, Both L); (0x20%positive, Only R); (0x41%positive, Only R); (0x83%positive, Only R); (0x21%positive, Only L); (0x3%positive, Neither)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x8%positive, 0x4); (0x10%positive, 0x8); (0x20%positive, 0x11); (0x41%positive, 0x22); (0x83%positive, 0x44); (0x107%positive, 0x88); (0x21%positive, 0x10); (0x42%positive, 0x20); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/after-far-3-3-2 *)
Example suite_377 : suite_seen (Node (Node (Node (Node (Node (Node Leaf (Node Leaf (Node Leaf Leaf))) (Node (Node Leaf Leaf) Leaf)) Leaf) Leaf) Leaf) (Node Leaf Leaf))
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Only L); (0x8%positive, Only L); (0x10%positive, Both L); (0x20%positive, Only R); (0x41%positive, Only R); (0x83%positive, Only R); (0x21%positive, Only L); (0x42%positive, Only L); (0x3%positive, Neither)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x8%positive, 0x4); (0x10%positive, 0x8); (0x20%positive, 0x11); (0x41%positive, 0x22); (0x83%positive, 0x44); (0x107%positive, 0x88); (0x21%positive, 0x10); (0x42%positive, 0x20); (0x84%positive, 0x40); (0x3%positive, 0x0)].
Proof. evaluated. Qed.

(* trace/script/after-far-3-3-3 *)
Example suite_378 : suite_seen (Node (Node (Node (Node (Node (Node Leaf (Node Leaf (Node Leaf Leaf))) (Node (Node (Node Leaf Leaf) Leaf) Leaf)) Leaf) Leaf) Leaf) (Node Leaf Leaf))
  [(0x1%positive, Both L); (0x2%positive, Only L); (0x4%positive, Only L); (0x8%positive, Only L); (0x10%positive, Both L); (0x20%positive, Only R); (0x41%positive, Only R); (0x83%positive, Only R); (0x21%positive, Only L); (0x42%positive, Only L); (0x84%positive, Only L); (0x3%positive, Neither)]
  []
  = suite_expected false
  [(0x1%positive, 0x0); (0x2%positive, 0x1); (0x4%positive, 0x2); (0x8%positive, 0x4); (0x10%positive, 0x8); (0x20%positive, 0x11); (0x41%positive, 0x22); (0x83%positive, 0x44); (0x107%positive, 0x88); (0x21%positive, 0x10); (0x42%positive, 0x20); (0x84%positive, 0x40); (0x108%positive, 0x80); (0x3%positive, 0x0)].
Proof. evaluated. Qed.
