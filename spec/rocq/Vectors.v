(** Cases with the visits and the states that the library saw. Written by tests/library/rocq_vectors.rs. *)

Require Import List PArith NArith.
Require Import Tree Cases.
Import ListNotations.
Open Scope N_scope.

Example case_0 : seen Leaf
  []
  None
  = expected false
  [(1%positive, 0, 1)].
Proof. evaluated. Qed.

Example left_0 : seen_left Leaf
  [] None
  = expected_left false [1%positive].
Proof. evaluated. Qed.

Example case_1 : seen (Node Leaf (Node Leaf (Node Leaf (Node (Node Leaf Leaf) Leaf))))
  [(1%positive, Both R); (3%positive, Both L); (7%positive, Both R); (15%positive, Both R); (30%positive, Both L)]
  None
  = expected false
  [(1%positive, 0, 1); (3%positive, 1, 2); (6%positive, 3, 4); (7%positive, 2, 5); (15%positive, 5, 10); (31%positive, 11, 20); (30%positive, 10, 21); (60%positive, 21, 42); (61%positive, 20, 43); (14%positive, 4, 11); (2%positive, 0, 3)].
Proof. evaluated. Qed.

Example left_1 : seen_left (Node Leaf (Node Leaf (Node Leaf (Node (Node Leaf Leaf) Leaf))))
  [1%positive; 3%positive; 7%positive; 15%positive; 30%positive] None
  = expected_left false [1%positive; 2%positive; 3%positive; 6%positive; 7%positive; 14%positive; 15%positive; 30%positive; 60%positive; 61%positive; 31%positive].
Proof. evaluated. Qed.

Example case_2 : seen (Node (Node Leaf (Node Leaf Leaf)) Leaf)
  [(1%positive, Neither)]
  None
  = expected false
  [(1%positive, 0, 1)].
Proof. evaluated. Qed.

Example left_2 : seen_left (Node (Node Leaf (Node Leaf Leaf)) Leaf)
  [1%positive] None
  = expected_left false [1%positive; 2%positive; 3%positive].
Proof. evaluated. Qed.

Example case_3 : seen (Node Leaf (Node Leaf Leaf))
  [(1%positive, Only R); (3%positive, Only R)]
  None
  = expected false
  [(1%positive, 0, 1); (3%positive, 0, 3); (7%positive, 0, 7)].
Proof. evaluated. Qed.

Example left_3 : seen_left (Node Leaf (Node Leaf Leaf))
  [1%positive; 3%positive] None
  = expected_left false [1%positive; 2%positive; 3%positive; 6%positive; 7%positive].
Proof. evaluated. Qed.

Example case_4 : seen (Node Leaf (Node Leaf (Node Leaf Leaf)))
  [(1%positive, Both L); (3%positive, Both R); (7%positive, Both L)]
  None
  = expected false
  [(1%positive, 0, 1); (2%positive, 1, 2); (3%positive, 0, 3); (7%positive, 1, 6); (14%positive, 3, 12); (15%positive, 2, 13); (6%positive, 0, 7)].
Proof. evaluated. Qed.

Example left_4 : seen_left (Node Leaf (Node Leaf (Node Leaf Leaf)))
  [1%positive; 3%positive; 7%positive] None
  = expected_left false [1%positive; 2%positive; 3%positive; 6%positive; 7%positive; 14%positive; 15%positive].
Proof. evaluated. Qed.

Example case_5 : seen (Node Leaf (Node Leaf (Node (Node Leaf (Node Leaf Leaf)) Leaf)))
  [(1%positive, Both L)]
  (Some 2%positive)
  = expected true
  [(1%positive, 0, 1); (2%positive, 1, 2)].
Proof. evaluated. Qed.

Example left_5 : seen_left (Node Leaf (Node Leaf (Node (Node Leaf (Node Leaf Leaf)) Leaf)))
  [1%positive] (Some 2%positive)
  = expected_left true [1%positive; 2%positive].
Proof. evaluated. Qed.

Example case_6 : seen (Node Leaf (Node Leaf (Node (Node (Node Leaf (Node Leaf (Node Leaf Leaf))) Leaf) Leaf)))
  [(1%positive, Both L); (3%positive, Both R); (7%positive, Both L); (14%positive, Both L); (28%positive, Both L); (57%positive, Neither)]
  None
  = expected false
  [(1%positive, 0, 1); (2%positive, 1, 2); (3%positive, 0, 3); (7%positive, 1, 6); (14%positive, 3, 12); (28%positive, 7, 24); (56%positive, 15, 48); (57%positive, 14, 49); (29%positive, 6, 25); (15%positive, 2, 13); (6%positive, 0, 7)].
Proof. evaluated. Qed.

Example left_6 : seen_left (Node Leaf (Node Leaf (Node (Node (Node Leaf (Node Leaf (Node Leaf Leaf))) Leaf) Leaf)))
  [1%positive; 3%positive; 7%positive; 14%positive; 28%positive; 57%positive] None
  = expected_left false [1%positive; 2%positive; 3%positive; 6%positive; 7%positive; 14%positive; 28%positive; 56%positive; 57%positive; 114%positive; 115%positive; 29%positive; 15%positive].
Proof. evaluated. Qed.

Example case_7 : seen (Node (Node Leaf Leaf) (Node Leaf Leaf))
  [(1%positive, Both L); (2%positive, Only L); (3%positive, Neither)]
  None
  = expected false
  [(1%positive, 0, 1); (2%positive, 1, 2); (4%positive, 2, 5); (3%positive, 0, 3)].
Proof. evaluated. Qed.

Example left_7 : seen_left (Node (Node Leaf Leaf) (Node Leaf Leaf))
  [1%positive; 2%positive] None
  = expected_left false [1%positive; 2%positive; 4%positive; 5%positive; 3%positive].
Proof. evaluated. Qed.

Example case_8 : seen (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf))
  [(1%positive, Only L); (2%positive, Only L); (4%positive, Both R)]
  None
  = expected false
  [(1%positive, 0, 1); (2%positive, 0, 3); (4%positive, 0, 7); (9%positive, 1, 14); (8%positive, 0, 15)].
Proof. evaluated. Qed.

Example left_8 : seen_left (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf))
  [1%positive; 2%positive; 4%positive] None
  = expected_left false [1%positive; 2%positive; 4%positive; 8%positive; 9%positive; 5%positive; 3%positive].
Proof. evaluated. Qed.

Example case_9 : seen (Node (Node Leaf Leaf) Leaf)
  [(1%positive, Only L); (2%positive, Only R)]
  None
  = expected false
  [(1%positive, 0, 1); (2%positive, 0, 3); (5%positive, 0, 7)].
Proof. evaluated. Qed.

Example left_9 : seen_left (Node (Node Leaf Leaf) Leaf)
  [1%positive; 2%positive] None
  = expected_left false [1%positive; 2%positive; 4%positive; 5%positive; 3%positive].
Proof. evaluated. Qed.

Example case_10 : seen (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf))
  [(1%positive, Both L); (2%positive, Both L); (4%positive, Both R); (3%positive, Both R)]
  None
  = expected false
  [(1%positive, 0, 1); (2%positive, 1, 2); (4%positive, 3, 4); (9%positive, 7, 8); (8%positive, 6, 9); (5%positive, 2, 5); (3%positive, 0, 3); (7%positive, 1, 6); (6%positive, 0, 7)].
Proof. evaluated. Qed.

Example left_10 : seen_left (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf))
  [1%positive; 2%positive; 4%positive; 3%positive] None
  = expected_left false [1%positive; 2%positive; 4%positive; 8%positive; 9%positive; 5%positive; 3%positive; 6%positive; 7%positive].
Proof. evaluated. Qed.

Example case_11 : seen (Node Leaf Leaf)
  [(1%positive, Neither)]
  None
  = expected false
  [(1%positive, 0, 1)].
Proof. evaluated. Qed.

Example left_11 : seen_left (Node Leaf Leaf)
  [1%positive] None
  = expected_left false [1%positive; 2%positive; 3%positive].
Proof. evaluated. Qed.

Example case_12 : seen (Node (Node Leaf Leaf) Leaf)
  [(1%positive, Only R)]
  None
  = expected false
  [(1%positive, 0, 1); (3%positive, 0, 3)].
Proof. evaluated. Qed.

Example left_12 : seen_left (Node (Node Leaf Leaf) Leaf)
  [1%positive] None
  = expected_left false [1%positive; 2%positive; 3%positive].
Proof. evaluated. Qed.

Example case_13 : seen (Node (Node Leaf Leaf) (Node Leaf Leaf))
  [(1%positive, Both L); (2%positive, Both R); (3%positive, Both R)]
  None
  = expected false
  [(1%positive, 0, 1); (2%positive, 1, 2); (5%positive, 3, 4); (4%positive, 2, 5); (3%positive, 0, 3); (7%positive, 1, 6); (6%positive, 0, 7)].
Proof. evaluated. Qed.

Example left_13 : seen_left (Node (Node Leaf Leaf) (Node Leaf Leaf))
  [1%positive; 2%positive; 3%positive] None
  = expected_left false [1%positive; 2%positive; 4%positive; 5%positive; 3%positive; 6%positive; 7%positive].
Proof. evaluated. Qed.

Example case_14 : seen (Node (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) Leaf))
  [(1%positive, Both R); (3%positive, Both L); (6%positive, Only R); (2%positive, Both R); (5%positive, Both R)]
  (Some 11%positive)
  = expected true
  [(1%positive, 0, 1); (3%positive, 1, 2); (6%positive, 3, 4); (13%positive, 6, 9); (7%positive, 2, 5); (2%positive, 0, 3); (5%positive, 1, 6); (11%positive, 3, 12)].
Proof. evaluated. Qed.

Example left_14 : seen_left (Node (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) Leaf))
  [1%positive; 2%positive; 4%positive] (Some 9%positive)
  = expected_left true [1%positive; 2%positive; 4%positive; 8%positive; 9%positive].
Proof. evaluated. Qed.

Example case_15 : seen (Node Leaf (Node Leaf (Node Leaf (Node (Node Leaf Leaf) Leaf))))
  [(1%positive, Both R); (3%positive, Both L)]
  (Some 6%positive)
  = expected true
  [(1%positive, 0, 1); (3%positive, 1, 2); (6%positive, 3, 4)].
Proof. evaluated. Qed.

Example left_15 : seen_left (Node Leaf (Node Leaf (Node Leaf (Node (Node Leaf Leaf) Leaf))))
  [1%positive; 3%positive] (Some 6%positive)
  = expected_left true [1%positive; 2%positive; 3%positive; 6%positive].
Proof. evaluated. Qed.

Example case_16 : seen Leaf
  []
  None
  = expected false
  [(1%positive, 0, 1)].
Proof. evaluated. Qed.

Example left_16 : seen_left Leaf
  [] None
  = expected_left false [1%positive].
Proof. evaluated. Qed.

Example case_17 : seen (Node Leaf (Node (Node Leaf Leaf) Leaf))
  [(1%positive, Neither)]
  None
  = expected false
  [(1%positive, 0, 1)].
Proof. evaluated. Qed.

Example left_17 : seen_left (Node Leaf (Node (Node Leaf Leaf) Leaf))
  [1%positive] None
  = expected_left false [1%positive; 2%positive; 3%positive].
Proof. evaluated. Qed.

Example case_18 : seen (Node (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) Leaf))
  [(1%positive, Both R); (3%positive, Both R); (6%positive, Neither); (2%positive, Both R); (5%positive, Only L); (4%positive, Neither)]
  None
  = expected false
  [(1%positive, 0, 1); (3%positive, 1, 2); (7%positive, 3, 4); (6%positive, 2, 5); (2%positive, 0, 3); (5%positive, 1, 6); (10%positive, 2, 13); (4%positive, 0, 7)].
Proof. evaluated. Qed.

Example left_18 : seen_left (Node (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) Leaf))
  [1%positive; 2%positive; 4%positive; 5%positive; 3%positive; 6%positive] None
  = expected_left false [1%positive; 2%positive; 4%positive; 8%positive; 9%positive; 5%positive; 10%positive; 11%positive; 3%positive; 6%positive; 12%positive; 13%positive; 7%positive].
Proof. evaluated. Qed.

Example case_19 : seen (Node (Node Leaf Leaf) (Node Leaf Leaf))
  [(1%positive, Both R); (3%positive, Both L)]
  (Some 6%positive)
  = expected true
  [(1%positive, 0, 1); (3%positive, 1, 2); (6%positive, 3, 4)].
Proof. evaluated. Qed.

Example left_19 : seen_left (Node (Node Leaf Leaf) (Node Leaf Leaf))
  [1%positive; 2%positive] (Some 4%positive)
  = expected_left true [1%positive; 2%positive; 4%positive].
Proof. evaluated. Qed.

Example case_20 : seen (Node Leaf Leaf)
  [(1%positive, Neither)]
  None
  = expected false
  [(1%positive, 0, 1)].
Proof. evaluated. Qed.

Example left_20 : seen_left (Node Leaf Leaf)
  [1%positive] None
  = expected_left false [1%positive; 2%positive; 3%positive].
Proof. evaluated. Qed.

Example case_21 : seen (Node (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) Leaf))
  [(1%positive, Only L); (2%positive, Only L); (4%positive, Only R)]
  (Some 9%positive)
  = expected true
  [(1%positive, 0, 1); (2%positive, 0, 3); (4%positive, 0, 7); (9%positive, 0, 15)].
Proof. evaluated. Qed.

Example left_21 : seen_left (Node (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) Leaf))
  [1%positive; 2%positive; 4%positive] (Some 9%positive)
  = expected_left true [1%positive; 2%positive; 4%positive; 8%positive; 9%positive].
Proof. evaluated. Qed.

Example case_22 : seen (Node Leaf (Node (Node Leaf (Node Leaf Leaf)) Leaf))
  [(1%positive, Both L); (3%positive, Both R); (6%positive, Both L); (13%positive, Both R)]
  None
  = expected false
  [(1%positive, 0, 1); (2%positive, 1, 2); (3%positive, 0, 3); (7%positive, 1, 6); (6%positive, 0, 7); (12%positive, 1, 14); (13%positive, 0, 15); (27%positive, 1, 30); (26%positive, 0, 31)].
Proof. evaluated. Qed.

Example left_22 : seen_left (Node Leaf (Node (Node Leaf (Node Leaf Leaf)) Leaf))
  [1%positive; 3%positive; 6%positive; 13%positive] None
  = expected_left false [1%positive; 2%positive; 3%positive; 6%positive; 12%positive; 13%positive; 26%positive; 27%positive; 7%positive].
Proof. evaluated. Qed.

Example case_23 : seen Leaf
  []
  None
  = expected false
  [(1%positive, 0, 1)].
Proof. evaluated. Qed.

Example left_23 : seen_left Leaf
  [] None
  = expected_left false [1%positive].
Proof. evaluated. Qed.

Example case_24 : seen (Node (Node (Node Leaf Leaf) (Node Leaf (Node Leaf (Node (Node Leaf Leaf) Leaf)))) Leaf)
  [(1%positive, Both L); (2%positive, Both R); (5%positive, Both R); (11%positive, Both R); (23%positive, Only R)]
  (Some 22%positive)
  = expected true
  [(1%positive, 0, 1); (2%positive, 1, 2); (5%positive, 3, 4); (11%positive, 7, 8); (23%positive, 15, 16); (47%positive, 30, 33); (22%positive, 14, 17)].
Proof. evaluated. Qed.

Example left_24 : seen_left (Node (Node (Node Leaf Leaf) (Node Leaf (Node Leaf (Node (Node Leaf Leaf) Leaf)))) Leaf)
  [1%positive; 2%positive; 4%positive] (Some 8%positive)
  = expected_left true [1%positive; 2%positive; 4%positive; 8%positive].
Proof. evaluated. Qed.

Example case_25 : seen (Node Leaf (Node Leaf Leaf))
  [(1%positive, Both R); (3%positive, Both R)]
  (Some 7%positive)
  = expected true
  [(1%positive, 0, 1); (3%positive, 1, 2); (7%positive, 3, 4)].
Proof. evaluated. Qed.

Example left_25 : seen_left (Node Leaf (Node Leaf Leaf))
  [1%positive; 3%positive] (Some 6%positive)
  = expected_left true [1%positive; 2%positive; 3%positive; 6%positive].
Proof. evaluated. Qed.

Example case_26 : seen Leaf
  []
  None
  = expected false
  [(1%positive, 0, 1)].
Proof. evaluated. Qed.

Example left_26 : seen_left Leaf
  [] None
  = expected_left false [1%positive].
Proof. evaluated. Qed.

Example case_27 : seen (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node Leaf Leaf)) Leaf)) Leaf)) Leaf)
  [(1%positive, Both R); (2%positive, Both R); (5%positive, Only R)]
  None
  = expected false
  [(1%positive, 0, 1); (3%positive, 1, 2); (2%positive, 0, 3); (5%positive, 1, 6); (11%positive, 2, 13); (4%positive, 0, 7)].
Proof. evaluated. Qed.

Example left_27 : seen_left (Node (Node Leaf (Node (Node Leaf (Node (Node Leaf (Node Leaf Leaf)) Leaf)) Leaf)) Leaf)
  [1%positive; 2%positive; 5%positive] None
  = expected_left false [1%positive; 2%positive; 4%positive; 5%positive; 10%positive; 11%positive; 3%positive].
Proof. evaluated. Qed.

Example case_28 : seen (Node (Node Leaf (Node (Node (Node Leaf (Node Leaf Leaf)) Leaf) Leaf)) Leaf)
  [(1%positive, Both L); (2%positive, Both L); (5%positive, Both L); (10%positive, Both L); (20%positive, Both R); (41%positive, Both L)]
  None
  = expected false
  [(1%positive, 0, 1); (2%positive, 1, 2); (4%positive, 3, 4); (5%positive, 2, 5); (10%positive, 5, 10); (20%positive, 11, 20); (41%positive, 23, 40); (82%positive, 47, 80); (83%positive, 46, 81); (40%positive, 22, 41); (21%positive, 10, 21); (11%positive, 4, 11); (3%positive, 0, 3)].
Proof. evaluated. Qed.

Example left_28 : seen_left (Node (Node Leaf (Node (Node (Node Leaf (Node Leaf Leaf)) Leaf) Leaf)) Leaf)
  [1%positive; 2%positive; 5%positive; 10%positive; 20%positive; 41%positive] None
  = expected_left false [1%positive; 2%positive; 4%positive; 5%positive; 10%positive; 20%positive; 40%positive; 41%positive; 82%positive; 83%positive; 21%positive; 11%positive; 3%positive].
Proof. evaluated. Qed.

Example case_29 : seen Leaf
  []
  None
  = expected false
  [(1%positive, 0, 1)].
Proof. evaluated. Qed.

Example left_29 : seen_left Leaf
  [] None
  = expected_left false [1%positive].
Proof. evaluated. Qed.

Example case_30 : seen (Node Leaf Leaf)
  [(1%positive, Only R)]
  (Some 3%positive)
  = expected true
  [(1%positive, 0, 1); (3%positive, 0, 3)].
Proof. evaluated. Qed.

Example left_30 : seen_left (Node Leaf Leaf)
  [1%positive] (Some 3%positive)
  = expected_left true [1%positive; 2%positive; 3%positive].
Proof. evaluated. Qed.

Example case_31 : seen (Node (Node (Node Leaf (Node Leaf Leaf)) Leaf) Leaf)
  [(1%positive, Both L); (2%positive, Both R); (4%positive, Both L); (9%positive, Both R)]
  None
  = expected false
  [(1%positive, 0, 1); (2%positive, 1, 2); (5%positive, 3, 4); (4%positive, 2, 5); (8%positive, 5, 10); (9%positive, 4, 11); (19%positive, 9, 22); (18%positive, 8, 23); (3%positive, 0, 3)].
Proof. evaluated. Qed.

Example left_31 : seen_left (Node (Node (Node Leaf (Node Leaf Leaf)) Leaf) Leaf)
  [1%positive; 2%positive; 4%positive; 9%positive] None
  = expected_left false [1%positive; 2%positive; 4%positive; 8%positive; 9%positive; 18%positive; 19%positive; 5%positive; 3%positive].
Proof. evaluated. Qed.

Example case_32 : seen (Node (Node Leaf (Node Leaf Leaf)) (Node (Node (Node Leaf (Node Leaf Leaf)) Leaf) Leaf))
  [(1%positive, Both R); (3%positive, Both L); (6%positive, Both R); (12%positive, Both R); (25%positive, Only L)]
  (Some 50%positive)
  = expected true
  [(1%positive, 0, 1); (3%positive, 1, 2); (6%positive, 3, 4); (13%positive, 7, 8); (12%positive, 6, 9); (25%positive, 13, 18); (50%positive, 26, 37)].
Proof. evaluated. Qed.

Example left_32 : seen_left (Node (Node Leaf (Node Leaf Leaf)) (Node (Node (Node Leaf (Node Leaf Leaf)) Leaf) Leaf))
  [1%positive; 2%positive] (Some 4%positive)
  = expected_left true [1%positive; 2%positive; 4%positive].
Proof. evaluated. Qed.

Example case_33 : seen (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf))
  [(1%positive, Both L); (2%positive, Both L); (4%positive, Both L)]
  (Some 5%positive)
  = expected true
  [(1%positive, 0, 1); (2%positive, 1, 2); (4%positive, 3, 4); (8%positive, 7, 8); (9%positive, 6, 9); (5%positive, 2, 5)].
Proof. evaluated. Qed.

Example left_33 : seen_left (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf))
  [1%positive; 2%positive; 4%positive] (Some 5%positive)
  = expected_left true [1%positive; 2%positive; 4%positive; 8%positive; 9%positive; 5%positive].
Proof. evaluated. Qed.

Example case_34 : seen (Node (Node Leaf (Node Leaf Leaf)) Leaf)
  [(1%positive, Both L); (2%positive, Only R); (5%positive, Both R)]
  None
  = expected false
  [(1%positive, 0, 1); (2%positive, 1, 2); (5%positive, 2, 5); (11%positive, 5, 10); (10%positive, 4, 11); (3%positive, 0, 3)].
Proof. evaluated. Qed.

Example left_34 : seen_left (Node (Node Leaf (Node Leaf Leaf)) Leaf)
  [1%positive; 2%positive; 5%positive] None
  = expected_left false [1%positive; 2%positive; 4%positive; 5%positive; 10%positive; 11%positive; 3%positive].
Proof. evaluated. Qed.

Example case_35 : seen Leaf
  []
  None
  = expected false
  [(1%positive, 0, 1)].
Proof. evaluated. Qed.

Example left_35 : seen_left Leaf
  [] None
  = expected_left false [1%positive].
Proof. evaluated. Qed.

Example case_36 : seen (Node Leaf (Node (Node Leaf (Node Leaf Leaf)) (Node Leaf Leaf)))
  [(1%positive, Only R); (3%positive, Only R); (7%positive, Both L)]
  None
  = expected false
  [(1%positive, 0, 1); (3%positive, 0, 3); (7%positive, 0, 7); (14%positive, 1, 14); (15%positive, 0, 15)].
Proof. evaluated. Qed.

Example left_36 : seen_left (Node Leaf (Node (Node Leaf (Node Leaf Leaf)) (Node Leaf Leaf)))
  [1%positive; 3%positive; 7%positive] None
  = expected_left false [1%positive; 2%positive; 3%positive; 6%positive; 7%positive; 14%positive; 15%positive].
Proof. evaluated. Qed.

Example case_37 : seen (Node (Node Leaf Leaf) (Node Leaf Leaf))
  [(1%positive, Both L); (2%positive, Both L); (3%positive, Both R)]
  None
  = expected false
  [(1%positive, 0, 1); (2%positive, 1, 2); (4%positive, 3, 4); (5%positive, 2, 5); (3%positive, 0, 3); (7%positive, 1, 6); (6%positive, 0, 7)].
Proof. evaluated. Qed.

Example left_37 : seen_left (Node (Node Leaf Leaf) (Node Leaf Leaf))
  [1%positive; 2%positive; 3%positive] None
  = expected_left false [1%positive; 2%positive; 4%positive; 5%positive; 3%positive; 6%positive; 7%positive].
Proof. evaluated. Qed.

Example case_38 : seen (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf)))
  [(1%positive, Neither)]
  None
  = expected false
  [(1%positive, 0, 1)].
Proof. evaluated. Qed.

Example left_38 : seen_left (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf)))
  [1%positive] None
  = expected_left false [1%positive; 2%positive; 3%positive].
Proof. evaluated. Qed.

Example case_39 : seen (Node Leaf Leaf)
  [(1%positive, Only R)]
  None
  = expected false
  [(1%positive, 0, 1); (3%positive, 0, 3)].
Proof. evaluated. Qed.

Example left_39 : seen_left (Node Leaf Leaf)
  [1%positive] None
  = expected_left false [1%positive; 2%positive; 3%positive].
Proof. evaluated. Qed.

Example case_40 : seen Leaf
  []
  None
  = expected false
  [(1%positive, 0, 1)].
Proof. evaluated. Qed.

Example left_40 : seen_left Leaf
  [] None
  = expected_left false [1%positive].
Proof. evaluated. Qed.

Example case_41 : seen Leaf
  []
  None
  = expected false
  [(1%positive, 0, 1)].
Proof. evaluated. Qed.

Example left_41 : seen_left Leaf
  [] None
  = expected_left false [1%positive].
Proof. evaluated. Qed.

Example case_42 : seen (Node (Node Leaf Leaf) (Node Leaf Leaf))
  [(1%positive, Both R); (3%positive, Both L); (2%positive, Neither)]
  None
  = expected false
  [(1%positive, 0, 1); (3%positive, 1, 2); (6%positive, 3, 4); (7%positive, 2, 5); (2%positive, 0, 3)].
Proof. evaluated. Qed.

Example left_42 : seen_left (Node (Node Leaf Leaf) (Node Leaf Leaf))
  [1%positive; 2%positive; 3%positive] None
  = expected_left false [1%positive; 2%positive; 4%positive; 5%positive; 3%positive; 6%positive; 7%positive].
Proof. evaluated. Qed.

Example case_43 : seen (Node (Node Leaf Leaf) (Node Leaf Leaf))
  [(1%positive, Both R); (3%positive, Both L)]
  (Some 6%positive)
  = expected true
  [(1%positive, 0, 1); (3%positive, 1, 2); (6%positive, 3, 4)].
Proof. evaluated. Qed.

Example left_43 : seen_left (Node (Node Leaf Leaf) (Node Leaf Leaf))
  [1%positive; 2%positive] (Some 4%positive)
  = expected_left true [1%positive; 2%positive; 4%positive].
Proof. evaluated. Qed.

Example case_44 : seen (Node Leaf Leaf)
  [(1%positive, Both R)]
  None
  = expected false
  [(1%positive, 0, 1); (3%positive, 1, 2); (2%positive, 0, 3)].
Proof. evaluated. Qed.

Example left_44 : seen_left (Node Leaf Leaf)
  [1%positive] None
  = expected_left false [1%positive; 2%positive; 3%positive].
Proof. evaluated. Qed.

Example case_45 : seen (Node (Node Leaf Leaf) (Node Leaf Leaf))
  [(1%positive, Only L); (2%positive, Both R)]
  None
  = expected false
  [(1%positive, 0, 1); (2%positive, 0, 3); (5%positive, 1, 6); (4%positive, 0, 7)].
Proof. evaluated. Qed.

Example left_45 : seen_left (Node (Node Leaf Leaf) (Node Leaf Leaf))
  [1%positive; 2%positive] None
  = expected_left false [1%positive; 2%positive; 4%positive; 5%positive; 3%positive].
Proof. evaluated. Qed.

Example case_46 : seen (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf))
  [(1%positive, Both R); (3%positive, Both R); (2%positive, Both L); (4%positive, Both L)]
  (Some 8%positive)
  = expected true
  [(1%positive, 0, 1); (3%positive, 1, 2); (7%positive, 3, 4); (6%positive, 2, 5); (2%positive, 0, 3); (4%positive, 1, 6); (8%positive, 3, 12)].
Proof. evaluated. Qed.

Example left_46 : seen_left (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf))
  [1%positive; 2%positive; 4%positive] (Some 8%positive)
  = expected_left true [1%positive; 2%positive; 4%positive; 8%positive].
Proof. evaluated. Qed.

Example case_47 : seen (Node Leaf (Node (Node (Node (Node Leaf (Node Leaf Leaf)) Leaf) Leaf) Leaf))
  [(1%positive, Neither)]
  None
  = expected false
  [(1%positive, 0, 1)].
Proof. evaluated. Qed.

Example left_47 : seen_left (Node Leaf (Node (Node (Node (Node Leaf (Node Leaf Leaf)) Leaf) Leaf) Leaf))
  [1%positive] None
  = expected_left false [1%positive; 2%positive; 3%positive].
Proof. evaluated. Qed.

Example case_48 : seen (Node (Node Leaf Leaf) Leaf)
  [(1%positive, Only L); (2%positive, Only L)]
  None
  = expected false
  [(1%positive, 0, 1); (2%positive, 0, 3); (4%positive, 0, 7)].
Proof. evaluated. Qed.

Example left_48 : seen_left (Node (Node Leaf Leaf) Leaf)
  [1%positive; 2%positive] None
  = expected_left false [1%positive; 2%positive; 4%positive; 5%positive; 3%positive].
Proof. evaluated. Qed.

Example case_49 : seen (Node (Node Leaf Leaf) Leaf)
  [(1%positive, Both L); (2%positive, Both R)]
  None
  = expected false
  [(1%positive, 0, 1); (2%positive, 1, 2); (5%positive, 3, 4); (4%positive, 2, 5); (3%positive, 0, 3)].
Proof. evaluated. Qed.

Example left_49 : seen_left (Node (Node Leaf Leaf) Leaf)
  [1%positive; 2%positive] None
  = expected_left false [1%positive; 2%positive; 4%positive; 5%positive; 3%positive].
Proof. evaluated. Qed.

Example case_50 : seen (Node Leaf (Node Leaf Leaf))
  [(1%positive, Both R); (3%positive, Both R)]
  None
  = expected false
  [(1%positive, 0, 1); (3%positive, 1, 2); (7%positive, 3, 4); (6%positive, 2, 5); (2%positive, 0, 3)].
Proof. evaluated. Qed.

Example left_50 : seen_left (Node Leaf (Node Leaf Leaf))
  [1%positive; 3%positive] None
  = expected_left false [1%positive; 2%positive; 3%positive; 6%positive; 7%positive].
Proof. evaluated. Qed.

Example case_51 : seen (Node (Node Leaf (Node Leaf Leaf)) (Node Leaf (Node Leaf Leaf)))
  [(1%positive, Both L); (2%positive, Both R); (5%positive, Both R); (3%positive, Both L); (7%positive, Both L)]
  None
  = expected false
  [(1%positive, 0, 1); (2%positive, 1, 2); (5%positive, 3, 4); (11%positive, 7, 8); (10%positive, 6, 9); (4%positive, 2, 5); (3%positive, 0, 3); (6%positive, 1, 6); (7%positive, 0, 7); (14%positive, 1, 14); (15%positive, 0, 15)].
Proof. evaluated. Qed.

Example left_51 : seen_left (Node (Node Leaf (Node Leaf Leaf)) (Node Leaf (Node Leaf Leaf)))
  [1%positive; 2%positive; 5%positive; 3%positive; 7%positive] None
  = expected_left false [1%positive; 2%positive; 4%positive; 5%positive; 10%positive; 11%positive; 3%positive; 6%positive; 7%positive; 14%positive; 15%positive].
Proof. evaluated. Qed.

Example case_52 : seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf)))))
  [(1%positive, Both R); (3%positive, Both L); (7%positive, Only R); (15%positive, Both L); (31%positive, Both R)]
  None
  = expected false
  [(1%positive, 0, 1); (3%positive, 1, 2); (6%positive, 3, 4); (7%positive, 2, 5); (15%positive, 4, 11); (30%positive, 9, 22); (31%positive, 8, 23); (63%positive, 17, 46); (62%positive, 16, 47); (2%positive, 0, 3)].
Proof. evaluated. Qed.

Example left_52 : seen_left (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node Leaf Leaf)))))
  [1%positive; 3%positive; 7%positive; 15%positive; 31%positive] None
  = expected_left false [1%positive; 2%positive; 3%positive; 6%positive; 7%positive; 14%positive; 15%positive; 30%positive; 31%positive; 62%positive; 63%positive].
Proof. evaluated. Qed.

Example case_53 : seen (Node Leaf (Node Leaf (Node (Node Leaf (Node (Node (Node Leaf Leaf) Leaf) Leaf)) Leaf)))
  [(1%positive, Only L)]
  None
  = expected false
  [(1%positive, 0, 1); (2%positive, 0, 3)].
Proof. evaluated. Qed.

Example left_53 : seen_left (Node Leaf (Node Leaf (Node (Node Leaf (Node (Node (Node Leaf Leaf) Leaf) Leaf)) Leaf)))
  [1%positive] None
  = expected_left false [1%positive; 2%positive; 3%positive].
Proof. evaluated. Qed.

Example case_54 : seen (Node (Node (Node Leaf Leaf) Leaf) (Node (Node (Node Leaf Leaf) Leaf) Leaf))
  [(1%positive, Both L); (2%positive, Both R); (4%positive, Both R); (3%positive, Both L); (6%positive, Only L); (12%positive, Both R)]
  None
  = expected false
  [(1%positive, 0, 1); (2%positive, 1, 2); (5%positive, 3, 4); (4%positive, 2, 5); (9%positive, 5, 10); (8%positive, 4, 11); (3%positive, 0, 3); (6%positive, 1, 6); (12%positive, 2, 13); (25%positive, 5, 26); (24%positive, 4, 27); (7%positive, 0, 7)].
Proof. evaluated. Qed.

Example left_54 : seen_left (Node (Node (Node Leaf Leaf) Leaf) (Node (Node (Node Leaf Leaf) Leaf) Leaf))
  [1%positive; 2%positive; 4%positive; 3%positive; 6%positive; 12%positive] None
  = expected_left false [1%positive; 2%positive; 4%positive; 8%positive; 9%positive; 5%positive; 3%positive; 6%positive; 12%positive; 24%positive; 25%positive; 13%positive; 7%positive].
Proof. evaluated. Qed.

Example case_55 : seen (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf))
  [(1%positive, Both R); (3%positive, Both R)]
  (Some 6%positive)
  = expected true
  [(1%positive, 0, 1); (3%positive, 1, 2); (7%positive, 3, 4); (6%positive, 2, 5)].
Proof. evaluated. Qed.

Example left_55 : seen_left (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf))
  [1%positive; 2%positive; 4%positive] (Some 9%positive)
  = expected_left true [1%positive; 2%positive; 4%positive; 8%positive; 9%positive].
Proof. evaluated. Qed.

Example case_56 : seen Leaf
  []
  None
  = expected false
  [(1%positive, 0, 1)].
Proof. evaluated. Qed.

Example left_56 : seen_left Leaf
  [] None
  = expected_left false [1%positive].
Proof. evaluated. Qed.

Example case_57 : seen (Node Leaf (Node Leaf (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf)))
  [(1%positive, Only R); (3%positive, Only R); (7%positive, Only R)]
  None
  = expected false
  [(1%positive, 0, 1); (3%positive, 0, 3); (7%positive, 0, 7); (15%positive, 0, 15)].
Proof. evaluated. Qed.

Example left_57 : seen_left (Node Leaf (Node Leaf (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf)))
  [1%positive; 3%positive; 7%positive] None
  = expected_left false [1%positive; 2%positive; 3%positive; 6%positive; 7%positive; 14%positive; 15%positive].
Proof. evaluated. Qed.

Example case_58 : seen (Node (Node Leaf Leaf) (Node Leaf Leaf))
  [(1%positive, Both L); (2%positive, Both R); (3%positive, Both R)]
  None
  = expected false
  [(1%positive, 0, 1); (2%positive, 1, 2); (5%positive, 3, 4); (4%positive, 2, 5); (3%positive, 0, 3); (7%positive, 1, 6); (6%positive, 0, 7)].
Proof. evaluated. Qed.

Example left_58 : seen_left (Node (Node Leaf Leaf) (Node Leaf Leaf))
  [1%positive; 2%positive; 3%positive] None
  = expected_left false [1%positive; 2%positive; 4%positive; 5%positive; 3%positive; 6%positive; 7%positive].
Proof. evaluated. Qed.

Example case_59 : seen (Node Leaf Leaf)
  [(1%positive, Only L)]
  None
  = expected false
  [(1%positive, 0, 1); (2%positive, 0, 3)].
Proof. evaluated. Qed.

Example left_59 : seen_left (Node Leaf Leaf)
  [1%positive] None
  = expected_left false [1%positive; 2%positive; 3%positive].
Proof. evaluated. Qed.

Example case_60 : seen (Node (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) Leaf))
  [(1%positive, Both L); (2%positive, Both R); (5%positive, Both R); (4%positive, Neither); (3%positive, Neither)]
  None
  = expected false
  [(1%positive, 0, 1); (2%positive, 1, 2); (5%positive, 3, 4); (11%positive, 7, 8); (10%positive, 6, 9); (4%positive, 2, 5); (3%positive, 0, 3)].
Proof. evaluated. Qed.

Example left_60 : seen_left (Node (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) Leaf))
  [1%positive; 2%positive; 4%positive; 8%positive; 5%positive] None
  = expected_left false [1%positive; 2%positive; 4%positive; 8%positive; 16%positive; 17%positive; 9%positive; 5%positive; 10%positive; 11%positive; 3%positive].
Proof. evaluated. Qed.

Example case_61 : seen (Node Leaf Leaf)
  [(1%positive, Both L)]
  None
  = expected false
  [(1%positive, 0, 1); (2%positive, 1, 2); (3%positive, 0, 3)].
Proof. evaluated. Qed.

Example left_61 : seen_left (Node Leaf Leaf)
  [1%positive] None
  = expected_left false [1%positive; 2%positive; 3%positive].
Proof. evaluated. Qed.

Example case_62 : seen (Node (Node Leaf Leaf) Leaf)
  [(1%positive, Only L); (2%positive, Neither)]
  None
  = expected false
  [(1%positive, 0, 1); (2%positive, 0, 3)].
Proof. evaluated. Qed.

Example left_62 : seen_left (Node (Node Leaf Leaf) Leaf)
  [1%positive; 2%positive] None
  = expected_left false [1%positive; 2%positive; 4%positive; 5%positive; 3%positive].
Proof. evaluated. Qed.

Example case_63 : seen Leaf
  []
  None
  = expected false
  [(1%positive, 0, 1)].
Proof. evaluated. Qed.

Example left_63 : seen_left Leaf
  [] None
  = expected_left false [1%positive].
Proof. evaluated. Qed.

Example case_64 : seen (Node (Node Leaf (Node (Node Leaf Leaf) Leaf)) Leaf)
  [(1%positive, Both L); (2%positive, Both L)]
  (Some 4%positive)
  = expected true
  [(1%positive, 0, 1); (2%positive, 1, 2); (4%positive, 3, 4)].
Proof. evaluated. Qed.

Example left_64 : seen_left (Node (Node Leaf (Node (Node Leaf Leaf) Leaf)) Leaf)
  [1%positive; 2%positive] (Some 4%positive)
  = expected_left true [1%positive; 2%positive; 4%positive].
Proof. evaluated. Qed.

Example case_65 : seen (Node Leaf (Node Leaf (Node Leaf Leaf)))
  [(1%positive, Neither)]
  None
  = expected false
  [(1%positive, 0, 1)].
Proof. evaluated. Qed.

Example left_65 : seen_left (Node Leaf (Node Leaf (Node Leaf Leaf)))
  [1%positive] None
  = expected_left false [1%positive; 2%positive; 3%positive].
Proof. evaluated. Qed.

Example case_66 : seen (Node Leaf (Node (Node Leaf (Node Leaf (Node Leaf Leaf))) Leaf))
  [(1%positive, Only R); (3%positive, Only R)]
  None
  = expected false
  [(1%positive, 0, 1); (3%positive, 0, 3); (7%positive, 0, 7)].
Proof. evaluated. Qed.

Example left_66 : seen_left (Node Leaf (Node (Node Leaf (Node Leaf (Node Leaf Leaf))) Leaf))
  [1%positive; 3%positive] None
  = expected_left false [1%positive; 2%positive; 3%positive; 6%positive; 7%positive].
Proof. evaluated. Qed.

Example case_67 : seen (Node Leaf (Node (Node (Node Leaf (Node (Node (Node Leaf Leaf) Leaf) Leaf)) Leaf) Leaf))
  [(1%positive, Both L); (3%positive, Both R); (6%positive, Both L); (12%positive, Both R); (25%positive, Both L); (50%positive, Both R); (100%positive, Both L)]
  None
  = expected false
  [(1%positive, 0, 1); (2%positive, 1, 2); (3%positive, 0, 3); (7%positive, 1, 6); (6%positive, 0, 7); (12%positive, 1, 14); (25%positive, 3, 28); (50%positive, 7, 56); (101%positive, 15, 112); (100%positive, 14, 113); (200%positive, 29, 226); (201%positive, 28, 227); (51%positive, 6, 57); (24%positive, 2, 29); (13%positive, 0, 15)].
Proof. evaluated. Qed.

Example left_67 : seen_left (Node Leaf (Node (Node (Node Leaf (Node (Node (Node Leaf Leaf) Leaf) Leaf)) Leaf) Leaf))
  [1%positive; 3%positive; 6%positive; 12%positive; 25%positive; 50%positive; 100%positive] None
  = expected_left false [1%positive; 2%positive; 3%positive; 6%positive; 12%positive; 24%positive; 25%positive; 50%positive; 100%positive; 200%positive; 201%positive; 101%positive; 51%positive; 13%positive; 7%positive].
Proof. evaluated. Qed.

Example case_68 : seen (Node (Node (Node Leaf (Node (Node Leaf (Node Leaf Leaf)) Leaf)) Leaf) Leaf)
  [(1%positive, Only R)]
  None
  = expected false
  [(1%positive, 0, 1); (3%positive, 0, 3)].
Proof. evaluated. Qed.

Example left_68 : seen_left (Node (Node (Node Leaf (Node (Node Leaf (Node Leaf Leaf)) Leaf)) Leaf) Leaf)
  [1%positive] None
  = expected_left false [1%positive; 2%positive; 3%positive].
Proof. evaluated. Qed.

Example case_69 : seen (Node (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) Leaf))
  [(1%positive, Both L); (2%positive, Both R); (5%positive, Both R); (4%positive, Both L); (8%positive, Both L); (3%positive, Neither)]
  None
  = expected false
  [(1%positive, 0, 1); (2%positive, 1, 2); (5%positive, 3, 4); (11%positive, 7, 8); (10%positive, 6, 9); (4%positive, 2, 5); (8%positive, 5, 10); (16%positive, 11, 20); (17%positive, 10, 21); (9%positive, 4, 11); (3%positive, 0, 3)].
Proof. evaluated. Qed.

Example left_69 : seen_left (Node (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) Leaf))
  [1%positive; 2%positive; 4%positive; 8%positive; 5%positive; 3%positive] None
  = expected_left false [1%positive; 2%positive; 4%positive; 8%positive; 16%positive; 17%positive; 9%positive; 5%positive; 10%positive; 11%positive; 3%positive; 6%positive; 7%positive].
Proof. evaluated. Qed.

Example case_70 : seen (Node (Node (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf)) Leaf) Leaf)
  [(1%positive, Only R)]
  (Some 3%positive)
  = expected true
  [(1%positive, 0, 1); (3%positive, 0, 3)].
Proof. evaluated. Qed.

Example left_70 : seen_left (Node (Node (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf)) Leaf) Leaf)
  [1%positive] (Some 3%positive)
  = expected_left true [1%positive; 2%positive; 3%positive].
Proof. evaluated. Qed.

Example case_71 : seen (Node Leaf Leaf)
  [(1%positive, Only R)]
  None
  = expected false
  [(1%positive, 0, 1); (3%positive, 0, 3)].
Proof. evaluated. Qed.

Example left_71 : seen_left (Node Leaf Leaf)
  [1%positive] None
  = expected_left false [1%positive; 2%positive; 3%positive].
Proof. evaluated. Qed.

Example case_72 : seen (Node Leaf (Node Leaf (Node (Node (Node Leaf Leaf) Leaf) Leaf)))
  [(1%positive, Only L)]
  None
  = expected false
  [(1%positive, 0, 1); (2%positive, 0, 3)].
Proof. evaluated. Qed.

Example left_72 : seen_left (Node Leaf (Node Leaf (Node (Node (Node Leaf Leaf) Leaf) Leaf)))
  [1%positive] None
  = expected_left false [1%positive; 2%positive; 3%positive].
Proof. evaluated. Qed.

Example case_73 : seen (Node Leaf (Node (Node Leaf Leaf) Leaf))
  [(1%positive, Both R); (3%positive, Both L); (6%positive, Both R)]
  None
  = expected false
  [(1%positive, 0, 1); (3%positive, 1, 2); (6%positive, 3, 4); (13%positive, 7, 8); (12%positive, 6, 9); (7%positive, 2, 5); (2%positive, 0, 3)].
Proof. evaluated. Qed.

Example left_73 : seen_left (Node Leaf (Node (Node Leaf Leaf) Leaf))
  [1%positive; 3%positive; 6%positive] None
  = expected_left false [1%positive; 2%positive; 3%positive; 6%positive; 12%positive; 13%positive; 7%positive].
Proof. evaluated. Qed.

Example case_74 : seen (Node Leaf (Node (Node (Node Leaf Leaf) Leaf) Leaf))
  [(1%positive, Neither)]
  None
  = expected false
  [(1%positive, 0, 1)].
Proof. evaluated. Qed.

Example left_74 : seen_left (Node Leaf (Node (Node (Node Leaf Leaf) Leaf) Leaf))
  [1%positive] None
  = expected_left false [1%positive; 2%positive; 3%positive].
Proof. evaluated. Qed.

Example case_75 : seen Leaf
  []
  None
  = expected false
  [(1%positive, 0, 1)].
Proof. evaluated. Qed.

Example left_75 : seen_left Leaf
  [] None
  = expected_left false [1%positive].
Proof. evaluated. Qed.

Example case_76 : seen Leaf
  []
  None
  = expected false
  [(1%positive, 0, 1)].
Proof. evaluated. Qed.

Example left_76 : seen_left Leaf
  [] None
  = expected_left false [1%positive].
Proof. evaluated. Qed.

Example case_77 : seen (Node Leaf (Node Leaf (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf) Leaf)))
  [(1%positive, Both R); (3%positive, Both R); (7%positive, Both L); (14%positive, Both R)]
  (Some 29%positive)
  = expected true
  [(1%positive, 0, 1); (3%positive, 1, 2); (7%positive, 3, 4); (14%positive, 7, 8); (29%positive, 15, 16)].
Proof. evaluated. Qed.

Example left_77 : seen_left (Node Leaf (Node Leaf (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf) Leaf)))
  [1%positive] (Some 2%positive)
  = expected_left true [1%positive; 2%positive].
Proof. evaluated. Qed.

Example case_78 : seen (Node (Node Leaf Leaf) (Node Leaf Leaf))
  [(1%positive, Both L); (2%positive, Only R); (3%positive, Only L)]
  (Some 6%positive)
  = expected true
  [(1%positive, 0, 1); (2%positive, 1, 2); (5%positive, 2, 5); (3%positive, 0, 3); (6%positive, 0, 7)].
Proof. evaluated. Qed.

Example left_78 : seen_left (Node (Node Leaf Leaf) (Node Leaf Leaf))
  [1%positive; 2%positive; 3%positive] (Some 6%positive)
  = expected_left true [1%positive; 2%positive; 4%positive; 5%positive; 3%positive; 6%positive].
Proof. evaluated. Qed.

Example case_79 : seen (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf))
  [(1%positive, Both L); (2%positive, Only L); (4%positive, Both L)]
  (Some 9%positive)
  = expected true
  [(1%positive, 0, 1); (2%positive, 1, 2); (4%positive, 2, 5); (8%positive, 5, 10); (9%positive, 4, 11)].
Proof. evaluated. Qed.

Example left_79 : seen_left (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf))
  [1%positive; 2%positive; 4%positive] (Some 9%positive)
  = expected_left true [1%positive; 2%positive; 4%positive; 8%positive; 9%positive].
Proof. evaluated. Qed.

Example case_80 : seen (Node Leaf Leaf)
  [(1%positive, Only R)]
  None
  = expected false
  [(1%positive, 0, 1); (3%positive, 0, 3)].
Proof. evaluated. Qed.

Example left_80 : seen_left (Node Leaf Leaf)
  [1%positive] None
  = expected_left false [1%positive; 2%positive; 3%positive].
Proof. evaluated. Qed.

Example case_81 : seen (Node Leaf Leaf)
  [(1%positive, Only L)]
  None
  = expected false
  [(1%positive, 0, 1); (2%positive, 0, 3)].
Proof. evaluated. Qed.

Example left_81 : seen_left (Node Leaf Leaf)
  [1%positive] None
  = expected_left false [1%positive; 2%positive; 3%positive].
Proof. evaluated. Qed.

Example case_82 : seen Leaf
  []
  None
  = expected false
  [(1%positive, 0, 1)].
Proof. evaluated. Qed.

Example left_82 : seen_left Leaf
  [] None
  = expected_left false [1%positive].
Proof. evaluated. Qed.

Example case_83 : seen (Node (Node (Node Leaf (Node (Node Leaf Leaf) Leaf)) (Node Leaf Leaf)) Leaf)
  [(1%positive, Neither)]
  None
  = expected false
  [(1%positive, 0, 1)].
Proof. evaluated. Qed.

Example left_83 : seen_left (Node (Node (Node Leaf (Node (Node Leaf Leaf) Leaf)) (Node Leaf Leaf)) Leaf)
  [1%positive] None
  = expected_left false [1%positive; 2%positive; 3%positive].
Proof. evaluated. Qed.

Example case_84 : seen (Node (Node Leaf Leaf) Leaf)
  [(1%positive, Only L); (2%positive, Only R)]
  None
  = expected false
  [(1%positive, 0, 1); (2%positive, 0, 3); (5%positive, 0, 7)].
Proof. evaluated. Qed.

Example left_84 : seen_left (Node (Node Leaf Leaf) Leaf)
  [1%positive; 2%positive] None
  = expected_left false [1%positive; 2%positive; 4%positive; 5%positive; 3%positive].
Proof. evaluated. Qed.

Example case_85 : seen (Node (Node Leaf Leaf) (Node Leaf Leaf))
  [(1%positive, Both L); (2%positive, Both R); (3%positive, Both R)]
  None
  = expected false
  [(1%positive, 0, 1); (2%positive, 1, 2); (5%positive, 3, 4); (4%positive, 2, 5); (3%positive, 0, 3); (7%positive, 1, 6); (6%positive, 0, 7)].
Proof. evaluated. Qed.

Example left_85 : seen_left (Node (Node Leaf Leaf) (Node Leaf Leaf))
  [1%positive; 2%positive; 3%positive] None
  = expected_left false [1%positive; 2%positive; 4%positive; 5%positive; 3%positive; 6%positive; 7%positive].
Proof. evaluated. Qed.

Example case_86 : seen (Node (Node (Node Leaf (Node (Node Leaf Leaf) (Node Leaf Leaf))) Leaf) (Node Leaf Leaf))
  [(1%positive, Only L); (2%positive, Only L); (4%positive, Both L); (9%positive, Both L); (18%positive, Both R)]
  (Some 36%positive)
  = expected true
  [(1%positive, 0, 1); (2%positive, 0, 3); (4%positive, 0, 7); (8%positive, 1, 14); (9%positive, 0, 15); (18%positive, 1, 30); (37%positive, 3, 60); (36%positive, 2, 61)].
Proof. evaluated. Qed.

Example left_86 : seen_left (Node (Node (Node Leaf (Node (Node Leaf Leaf) (Node Leaf Leaf))) Leaf) (Node Leaf Leaf))
  [1%positive; 2%positive; 4%positive; 9%positive; 18%positive] (Some 36%positive)
  = expected_left true [1%positive; 2%positive; 4%positive; 8%positive; 9%positive; 18%positive; 36%positive].
Proof. evaluated. Qed.

Example case_87 : seen (Node Leaf Leaf)
  [(1%positive, Both L)]
  (Some 2%positive)
  = expected true
  [(1%positive, 0, 1); (2%positive, 1, 2)].
Proof. evaluated. Qed.

Example left_87 : seen_left (Node Leaf Leaf)
  [1%positive] (Some 2%positive)
  = expected_left true [1%positive; 2%positive].
Proof. evaluated. Qed.

Example case_88 : seen (Node Leaf Leaf)
  [(1%positive, Only R)]
  None
  = expected false
  [(1%positive, 0, 1); (3%positive, 0, 3)].
Proof. evaluated. Qed.

Example left_88 : seen_left (Node Leaf Leaf)
  [1%positive] None
  = expected_left false [1%positive; 2%positive; 3%positive].
Proof. evaluated. Qed.

Example case_89 : seen (Node (Node (Node Leaf (Node Leaf Leaf)) (Node Leaf Leaf)) Leaf)
  [(1%positive, Only L); (2%positive, Both R); (5%positive, Only R); (4%positive, Both L); (9%positive, Both R)]
  None
  = expected false
  [(1%positive, 0, 1); (2%positive, 0, 3); (5%positive, 1, 6); (11%positive, 2, 13); (4%positive, 0, 7); (8%positive, 1, 14); (9%positive, 0, 15); (19%positive, 1, 30); (18%positive, 0, 31)].
Proof. evaluated. Qed.

Example left_89 : seen_left (Node (Node (Node Leaf (Node Leaf Leaf)) (Node Leaf Leaf)) Leaf)
  [1%positive; 2%positive; 4%positive; 9%positive; 5%positive] None
  = expected_left false [1%positive; 2%positive; 4%positive; 8%positive; 9%positive; 18%positive; 19%positive; 5%positive; 10%positive; 11%positive; 3%positive].
Proof. evaluated. Qed.

Example case_90 : seen (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf))
  [(1%positive, Both R); (3%positive, Only L); (2%positive, Only R)]
  None
  = expected false
  [(1%positive, 0, 1); (3%positive, 1, 2); (6%positive, 2, 5); (2%positive, 0, 3); (5%positive, 0, 7)].
Proof. evaluated. Qed.

Example left_90 : seen_left (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf))
  [1%positive; 2%positive; 3%positive] None
  = expected_left false [1%positive; 2%positive; 4%positive; 5%positive; 3%positive; 6%positive; 7%positive].
Proof. evaluated. Qed.

Example case_91 : seen (Node Leaf (Node Leaf (Node (Node (Node (Node Leaf (Node Leaf Leaf)) Leaf) Leaf) Leaf)))
  [(1%positive, Both R); (3%positive, Both R); (7%positive, Both R); (14%positive, Both L); (28%positive, Both R); (56%positive, Both R); (113%positive, Both R)]
  None
  = expected false
  [(1%positive, 0, 1); (3%positive, 1, 2); (7%positive, 3, 4); (15%positive, 7, 8); (14%positive, 6, 9); (28%positive, 13, 18); (57%positive, 27, 36); (56%positive, 26, 37); (113%positive, 53, 74); (227%positive, 107, 148); (226%positive, 106, 149); (112%positive, 52, 75); (29%positive, 12, 19); (6%positive, 2, 5); (2%positive, 0, 3)].
Proof. evaluated. Qed.

Example left_91 : seen_left (Node Leaf (Node Leaf (Node (Node (Node (Node Leaf (Node Leaf Leaf)) Leaf) Leaf) Leaf)))
  [1%positive; 3%positive; 7%positive; 14%positive; 28%positive; 56%positive; 113%positive] None
  = expected_left false [1%positive; 2%positive; 3%positive; 6%positive; 7%positive; 14%positive; 28%positive; 56%positive; 112%positive; 113%positive; 226%positive; 227%positive; 57%positive; 29%positive; 15%positive].
Proof. evaluated. Qed.

Example case_92 : seen (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf)))
  [(1%positive, Neither)]
  None
  = expected false
  [(1%positive, 0, 1)].
Proof. evaluated. Qed.

Example left_92 : seen_left (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf)))
  [1%positive] None
  = expected_left false [1%positive; 2%positive; 3%positive].
Proof. evaluated. Qed.

Example case_93 : seen (Node (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) Leaf))
  [(1%positive, Only L); (2%positive, Only L); (4%positive, Only R)]
  None
  = expected false
  [(1%positive, 0, 1); (2%positive, 0, 3); (4%positive, 0, 7); (9%positive, 0, 15)].
Proof. evaluated. Qed.

Example left_93 : seen_left (Node (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) Leaf))
  [1%positive; 2%positive; 4%positive] None
  = expected_left false [1%positive; 2%positive; 4%positive; 8%positive; 9%positive; 5%positive; 3%positive].
Proof. evaluated. Qed.

Example case_94 : seen (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node (Node Leaf Leaf) Leaf)))))
  [(1%positive, Both L); (3%positive, Both R); (7%positive, Both L); (15%positive, Both R); (31%positive, Both L); (62%positive, Both R)]
  (Some 125%positive)
  = expected true
  [(1%positive, 0, 1); (2%positive, 1, 2); (3%positive, 0, 3); (7%positive, 1, 6); (14%positive, 3, 12); (15%positive, 2, 13); (31%positive, 5, 26); (62%positive, 11, 52); (125%positive, 23, 104)].
Proof. evaluated. Qed.

Example left_94 : seen_left (Node Leaf (Node Leaf (Node Leaf (Node Leaf (Node (Node Leaf Leaf) Leaf)))))
  [1%positive; 3%positive; 7%positive; 15%positive; 31%positive; 62%positive] (Some 125%positive)
  = expected_left true [1%positive; 2%positive; 3%positive; 6%positive; 7%positive; 14%positive; 15%positive; 30%positive; 31%positive; 62%positive; 124%positive; 125%positive].
Proof. evaluated. Qed.

Example case_95 : seen (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf) Leaf)
  [(1%positive, Both R); (2%positive, Both R); (4%positive, Both R); (8%positive, Both R); (16%positive, Neither)]
  None
  = expected false
  [(1%positive, 0, 1); (3%positive, 1, 2); (2%positive, 0, 3); (5%positive, 1, 6); (4%positive, 0, 7); (9%positive, 1, 14); (8%positive, 0, 15); (17%positive, 1, 30); (16%positive, 0, 31)].
Proof. evaluated. Qed.

Example left_95 : seen_left (Node (Node (Node (Node (Node Leaf Leaf) Leaf) Leaf) Leaf) Leaf)
  [1%positive; 2%positive; 4%positive; 8%positive; 16%positive] None
  = expected_left false [1%positive; 2%positive; 4%positive; 8%positive; 16%positive; 32%positive; 33%positive; 17%positive; 9%positive; 5%positive; 3%positive].
Proof. evaluated. Qed.

Example case_96 : seen (Node Leaf Leaf)
  [(1%positive, Both R)]
  (Some 3%positive)
  = expected true
  [(1%positive, 0, 1); (3%positive, 1, 2)].
Proof. evaluated. Qed.

Example left_96 : seen_left (Node Leaf Leaf)
  [1%positive] (Some 3%positive)
  = expected_left true [1%positive; 2%positive; 3%positive].
Proof. evaluated. Qed.

Example case_97 : seen (Node (Node Leaf Leaf) (Node Leaf Leaf))
  [(1%positive, Only R); (3%positive, Only R)]
  (Some 7%positive)
  = expected true
  [(1%positive, 0, 1); (3%positive, 0, 3); (7%positive, 0, 7)].
Proof. evaluated. Qed.

Example left_97 : seen_left (Node (Node Leaf Leaf) (Node Leaf Leaf))
  [1%positive; 3%positive] (Some 7%positive)
  = expected_left true [1%positive; 2%positive; 3%positive; 6%positive; 7%positive].
Proof. evaluated. Qed.

Example case_98 : seen (Node (Node Leaf Leaf) (Node Leaf Leaf))
  [(1%positive, Neither)]
  None
  = expected false
  [(1%positive, 0, 1)].
Proof. evaluated. Qed.

Example left_98 : seen_left (Node (Node Leaf Leaf) (Node Leaf Leaf))
  [1%positive] None
  = expected_left false [1%positive; 2%positive; 3%positive].
Proof. evaluated. Qed.

Example case_99 : seen (Node (Node Leaf (Node Leaf Leaf)) (Node Leaf (Node Leaf Leaf)))
  [(1%positive, Only L); (2%positive, Only L)]
  None
  = expected false
  [(1%positive, 0, 1); (2%positive, 0, 3); (4%positive, 0, 7)].
Proof. evaluated. Qed.

Example left_99 : seen_left (Node (Node Leaf (Node Leaf Leaf)) (Node Leaf (Node Leaf Leaf)))
  [1%positive; 2%positive] None
  = expected_left false [1%positive; 2%positive; 4%positive; 5%positive; 3%positive].
Proof. evaluated. Qed.

Example case_100 : seen (Node (Node Leaf (Node Leaf (Node (Node Leaf Leaf) Leaf))) Leaf)
  [(1%positive, Both L); (2%positive, Both R); (5%positive, Both R); (11%positive, Both R); (22%positive, Both R)]
  (Some 4%positive)
  = expected true
  [(1%positive, 0, 1); (2%positive, 1, 2); (5%positive, 3, 4); (11%positive, 7, 8); (23%positive, 15, 16); (22%positive, 14, 17); (45%positive, 29, 34); (44%positive, 28, 35); (10%positive, 6, 9); (4%positive, 2, 5)].
Proof. evaluated. Qed.

Example left_100 : seen_left (Node (Node Leaf (Node Leaf (Node (Node Leaf Leaf) Leaf))) Leaf)
  [1%positive; 2%positive] (Some 4%positive)
  = expected_left true [1%positive; 2%positive; 4%positive].
Proof. evaluated. Qed.

Example case_101 : seen (Node (Node Leaf (Node Leaf (Node Leaf (Node (Node Leaf Leaf) Leaf)))) Leaf)
  [(1%positive, Neither)]
  None
  = expected false
  [(1%positive, 0, 1)].
Proof. evaluated. Qed.

Example left_101 : seen_left (Node (Node Leaf (Node Leaf (Node Leaf (Node (Node Leaf Leaf) Leaf)))) Leaf)
  [1%positive] None
  = expected_left false [1%positive; 2%positive; 3%positive].
Proof. evaluated. Qed.

Example case_102 : seen (Node Leaf (Node (Node (Node (Node Leaf (Node Leaf (Node Leaf Leaf))) Leaf) Leaf) Leaf))
  [(1%positive, Only L)]
  None
  = expected false
  [(1%positive, 0, 1); (2%positive, 0, 3)].
Proof. evaluated. Qed.

Example left_102 : seen_left (Node Leaf (Node (Node (Node (Node Leaf (Node Leaf (Node Leaf Leaf))) Leaf) Leaf) Leaf))
  [1%positive] None
  = expected_left false [1%positive; 2%positive; 3%positive].
Proof. evaluated. Qed.

Example case_103 : seen (Node Leaf (Node (Node Leaf Leaf) (Node Leaf Leaf)))
  [(1%positive, Both L); (3%positive, Both R); (7%positive, Both L)]
  (Some 15%positive)
  = expected true
  [(1%positive, 0, 1); (2%positive, 1, 2); (3%positive, 0, 3); (7%positive, 1, 6); (14%positive, 3, 12); (15%positive, 2, 13)].
Proof. evaluated. Qed.

Example left_103 : seen_left (Node Leaf (Node (Node Leaf Leaf) (Node Leaf Leaf)))
  [1%positive; 3%positive; 6%positive; 7%positive] (Some 15%positive)
  = expected_left true [1%positive; 2%positive; 3%positive; 6%positive; 12%positive; 13%positive; 7%positive; 14%positive; 15%positive].
Proof. evaluated. Qed.

Example case_104 : seen (Node (Node (Node Leaf Leaf) Leaf) (Node (Node Leaf Leaf) Leaf))
  [(1%positive, Both R); (3%positive, Both R)]
  (Some 7%positive)
  = expected true
  [(1%positive, 0, 1); (3%positive, 1, 2); (7%positive, 3, 4)].
Proof. evaluated. Qed.

Example left_104 : seen_left (Node (Node (Node Leaf Leaf) Leaf) (Node (Node Leaf Leaf) Leaf))
  [1%positive; 2%positive; 4%positive] (Some 5%positive)
  = expected_left true [1%positive; 2%positive; 4%positive; 8%positive; 9%positive; 5%positive].
Proof. evaluated. Qed.

Example case_105 : seen (Node Leaf (Node (Node Leaf (Node Leaf (Node Leaf Leaf))) Leaf))
  [(1%positive, Both R); (3%positive, Only L); (6%positive, Both L)]
  (Some 12%positive)
  = expected true
  [(1%positive, 0, 1); (3%positive, 1, 2); (6%positive, 2, 5); (12%positive, 5, 10)].
Proof. evaluated. Qed.

Example left_105 : seen_left (Node Leaf (Node (Node Leaf (Node Leaf (Node Leaf Leaf))) Leaf))
  [1%positive; 3%positive; 6%positive] (Some 12%positive)
  = expected_left true [1%positive; 2%positive; 3%positive; 6%positive; 12%positive].
Proof. evaluated. Qed.

Example case_106 : seen (Node Leaf (Node Leaf (Node (Node Leaf Leaf) (Node Leaf (Node (Node Leaf Leaf) Leaf)))))
  [(1%positive, Both R); (3%positive, Both R); (7%positive, Both L); (14%positive, Both R); (15%positive, Both R); (31%positive, Both R)]
  (Some 63%positive)
  = expected true
  [(1%positive, 0, 1); (3%positive, 1, 2); (7%positive, 3, 4); (14%positive, 7, 8); (29%positive, 15, 16); (28%positive, 14, 17); (15%positive, 6, 9); (31%positive, 13, 18); (63%positive, 27, 36)].
Proof. evaluated. Qed.

Example left_106 : seen_left (Node Leaf (Node Leaf (Node (Node Leaf Leaf) (Node Leaf (Node (Node Leaf Leaf) Leaf)))))
  [1%positive; 3%positive; 7%positive; 14%positive; 15%positive; 31%positive; 62%positive] (Some 124%positive)
  = expected_left true [1%positive; 2%positive; 3%positive; 6%positive; 7%positive; 14%positive; 28%positive; 29%positive; 15%positive; 30%positive; 31%positive; 62%positive; 124%positive].
Proof. evaluated. Qed.

Example case_107 : seen (Node (Node Leaf Leaf) Leaf)
  [(1%positive, Both L); (2%positive, Only L)]
  None
  = expected false
  [(1%positive, 0, 1); (2%positive, 1, 2); (4%positive, 2, 5); (3%positive, 0, 3)].
Proof. evaluated. Qed.

Example left_107 : seen_left (Node (Node Leaf Leaf) Leaf)
  [1%positive; 2%positive] None
  = expected_left false [1%positive; 2%positive; 4%positive; 5%positive; 3%positive].
Proof. evaluated. Qed.

Example case_108 : seen (Node Leaf Leaf)
  [(1%positive, Only R)]
  None
  = expected false
  [(1%positive, 0, 1); (3%positive, 0, 3)].
Proof. evaluated. Qed.

Example left_108 : seen_left (Node Leaf Leaf)
  [1%positive] None
  = expected_left false [1%positive; 2%positive; 3%positive].
Proof. evaluated. Qed.

Example case_109 : seen (Node (Node Leaf Leaf) (Node Leaf Leaf))
  [(1%positive, Both L); (2%positive, Both L); (3%positive, Both R)]
  None
  = expected false
  [(1%positive, 0, 1); (2%positive, 1, 2); (4%positive, 3, 4); (5%positive, 2, 5); (3%positive, 0, 3); (7%positive, 1, 6); (6%positive, 0, 7)].
Proof. evaluated. Qed.

Example left_109 : seen_left (Node (Node Leaf Leaf) (Node Leaf Leaf))
  [1%positive; 2%positive; 3%positive] None
  = expected_left false [1%positive; 2%positive; 4%positive; 5%positive; 3%positive; 6%positive; 7%positive].
Proof. evaluated. Qed.

Example case_110 : seen (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf))
  [(1%positive, Neither)]
  None
  = expected false
  [(1%positive, 0, 1)].
Proof. evaluated. Qed.

Example left_110 : seen_left (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf))
  [1%positive] None
  = expected_left false [1%positive; 2%positive; 3%positive].
Proof. evaluated. Qed.

Example case_111 : seen (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf)))
  [(1%positive, Only R); (3%positive, Only R); (7%positive, Only R)]
  None
  = expected false
  [(1%positive, 0, 1); (3%positive, 0, 3); (7%positive, 0, 7); (15%positive, 0, 15)].
Proof. evaluated. Qed.

Example left_111 : seen_left (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf)))
  [1%positive; 3%positive; 7%positive] None
  = expected_left false [1%positive; 2%positive; 3%positive; 6%positive; 7%positive; 14%positive; 15%positive].
Proof. evaluated. Qed.

Example case_112 : seen (Node Leaf Leaf)
  [(1%positive, Both L)]
  (Some 3%positive)
  = expected true
  [(1%positive, 0, 1); (2%positive, 1, 2); (3%positive, 0, 3)].
Proof. evaluated. Qed.

Example left_112 : seen_left (Node Leaf Leaf)
  [1%positive] (Some 3%positive)
  = expected_left true [1%positive; 2%positive; 3%positive].
Proof. evaluated. Qed.

Example case_113 : seen (Node Leaf Leaf)
  [(1%positive, Only R)]
  None
  = expected false
  [(1%positive, 0, 1); (3%positive, 0, 3)].
Proof. evaluated. Qed.

Example left_113 : seen_left (Node Leaf Leaf)
  [1%positive] None
  = expected_left false [1%positive; 2%positive; 3%positive].
Proof. evaluated. Qed.

Example case_114 : seen (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf)))
  [(1%positive, Both L); (2%positive, Both R); (5%positive, Both R); (4%positive, Only L); (3%positive, Both L); (6%positive, Both R); (7%positive, Both R)]
  None
  = expected false
  [(1%positive, 0, 1); (2%positive, 1, 2); (5%positive, 3, 4); (11%positive, 7, 8); (10%positive, 6, 9); (4%positive, 2, 5); (8%positive, 4, 11); (3%positive, 0, 3); (6%positive, 1, 6); (13%positive, 3, 12); (12%positive, 2, 13); (7%positive, 0, 7); (15%positive, 1, 14); (14%positive, 0, 15)].
Proof. evaluated. Qed.

Example left_114 : seen_left (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf)))
  [1%positive; 2%positive; 4%positive; 5%positive; 3%positive; 6%positive; 7%positive] None
  = expected_left false [1%positive; 2%positive; 4%positive; 8%positive; 9%positive; 5%positive; 10%positive; 11%positive; 3%positive; 6%positive; 12%positive; 13%positive; 7%positive; 14%positive; 15%positive].
Proof. evaluated. Qed.

Example case_115 : seen (Node Leaf Leaf)
  [(1%positive, Both L)]
  (Some 2%positive)
  = expected true
  [(1%positive, 0, 1); (2%positive, 1, 2)].
Proof. evaluated. Qed.

Example left_115 : seen_left (Node Leaf Leaf)
  [1%positive] (Some 2%positive)
  = expected_left true [1%positive; 2%positive].
Proof. evaluated. Qed.

Example case_116 : seen (Node (Node (Node Leaf (Node Leaf Leaf)) (Node Leaf Leaf)) (Node (Node Leaf Leaf) Leaf))
  [(1%positive, Only L); (2%positive, Only R); (5%positive, Neither)]
  None
  = expected false
  [(1%positive, 0, 1); (2%positive, 0, 3); (5%positive, 0, 7)].
Proof. evaluated. Qed.

Example left_116 : seen_left (Node (Node (Node Leaf (Node Leaf Leaf)) (Node Leaf Leaf)) (Node (Node Leaf Leaf) Leaf))
  [1%positive; 2%positive; 5%positive] None
  = expected_left false [1%positive; 2%positive; 4%positive; 5%positive; 10%positive; 11%positive; 3%positive].
Proof. evaluated. Qed.

Example case_117 : seen (Node Leaf Leaf)
  [(1%positive, Only L)]
  None
  = expected false
  [(1%positive, 0, 1); (2%positive, 0, 3)].
Proof. evaluated. Qed.

Example left_117 : seen_left (Node Leaf Leaf)
  [1%positive] None
  = expected_left false [1%positive; 2%positive; 3%positive].
Proof. evaluated. Qed.

Example case_118 : seen (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf))
  [(1%positive, Both L); (2%positive, Both R); (4%positive, Both L); (3%positive, Both L)]
  None
  = expected false
  [(1%positive, 0, 1); (2%positive, 1, 2); (5%positive, 3, 4); (4%positive, 2, 5); (8%positive, 5, 10); (9%positive, 4, 11); (3%positive, 0, 3); (6%positive, 1, 6); (7%positive, 0, 7)].
Proof. evaluated. Qed.

Example left_118 : seen_left (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf))
  [1%positive; 2%positive; 4%positive; 3%positive] None
  = expected_left false [1%positive; 2%positive; 4%positive; 8%positive; 9%positive; 5%positive; 3%positive; 6%positive; 7%positive].
Proof. evaluated. Qed.

Example case_119 : seen (Node Leaf (Node (Node Leaf (Node (Node Leaf Leaf) (Node (Node Leaf Leaf) Leaf))) Leaf))
  [(1%positive, Neither)]
  None
  = expected false
  [(1%positive, 0, 1)].
Proof. evaluated. Qed.

Example left_119 : seen_left (Node Leaf (Node (Node Leaf (Node (Node Leaf Leaf) (Node (Node Leaf Leaf) Leaf))) Leaf))
  [1%positive] None
  = expected_left false [1%positive; 2%positive; 3%positive].
Proof. evaluated. Qed.

Example case_120 : seen (Node Leaf Leaf)
  [(1%positive, Only L)]
  None
  = expected false
  [(1%positive, 0, 1); (2%positive, 0, 3)].
Proof. evaluated. Qed.

Example left_120 : seen_left (Node Leaf Leaf)
  [1%positive] None
  = expected_left false [1%positive; 2%positive; 3%positive].
Proof. evaluated. Qed.

Example case_121 : seen (Node Leaf (Node Leaf (Node Leaf Leaf)))
  [(1%positive, Both L); (3%positive, Both R); (7%positive, Both L)]
  None
  = expected false
  [(1%positive, 0, 1); (2%positive, 1, 2); (3%positive, 0, 3); (7%positive, 1, 6); (14%positive, 3, 12); (15%positive, 2, 13); (6%positive, 0, 7)].
Proof. evaluated. Qed.

Example left_121 : seen_left (Node Leaf (Node Leaf (Node Leaf Leaf)))
  [1%positive; 3%positive; 7%positive] None
  = expected_left false [1%positive; 2%positive; 3%positive; 6%positive; 7%positive; 14%positive; 15%positive].
Proof. evaluated. Qed.

Example case_122 : seen (Node Leaf Leaf)
  [(1%positive, Only R)]
  (Some 3%positive)
  = expected true
  [(1%positive, 0, 1); (3%positive, 0, 3)].
Proof. evaluated. Qed.

Example left_122 : seen_left (Node Leaf Leaf)
  [1%positive] (Some 3%positive)
  = expected_left true [1%positive; 2%positive; 3%positive].
Proof. evaluated. Qed.

Example case_123 : seen (Node (Node Leaf Leaf) Leaf)
  [(1%positive, Both L); (2%positive, Only R)]
  None
  = expected false
  [(1%positive, 0, 1); (2%positive, 1, 2); (5%positive, 2, 5); (3%positive, 0, 3)].
Proof. evaluated. Qed.

Example left_123 : seen_left (Node (Node Leaf Leaf) Leaf)
  [1%positive; 2%positive] None
  = expected_left false [1%positive; 2%positive; 4%positive; 5%positive; 3%positive].
Proof. evaluated. Qed.

Example case_124 : seen (Node (Node Leaf Leaf) (Node (Node Leaf (Node (Node Leaf Leaf) Leaf)) Leaf))
  [(1%positive, Both R); (3%positive, Both L); (6%positive, Both R); (13%positive, Neither)]
  (Some 12%positive)
  = expected true
  [(1%positive, 0, 1); (3%positive, 1, 2); (6%positive, 3, 4); (13%positive, 7, 8); (12%positive, 6, 9)].
Proof. evaluated. Qed.

Example left_124 : seen_left (Node (Node Leaf Leaf) (Node (Node Leaf (Node (Node Leaf Leaf) Leaf)) Leaf))
  [1%positive; 2%positive] (Some 4%positive)
  = expected_left true [1%positive; 2%positive; 4%positive].
Proof. evaluated. Qed.

Example case_125 : seen (Node (Node Leaf Leaf) (Node Leaf Leaf))
  [(1%positive, Neither)]
  None
  = expected false
  [(1%positive, 0, 1)].
Proof. evaluated. Qed.

Example left_125 : seen_left (Node (Node Leaf Leaf) (Node Leaf Leaf))
  [1%positive] None
  = expected_left false [1%positive; 2%positive; 3%positive].
Proof. evaluated. Qed.

Example case_126 : seen (Node Leaf (Node (Node Leaf Leaf) Leaf))
  [(1%positive, Only L)]
  None
  = expected false
  [(1%positive, 0, 1); (2%positive, 0, 3)].
Proof. evaluated. Qed.

Example left_126 : seen_left (Node Leaf (Node (Node Leaf Leaf) Leaf))
  [1%positive] None
  = expected_left false [1%positive; 2%positive; 3%positive].
Proof. evaluated. Qed.

Example case_127 : seen Leaf
  []
  None
  = expected false
  [(1%positive, 0, 1)].
Proof. evaluated. Qed.

Example left_127 : seen_left Leaf
  [] None
  = expected_left false [1%positive].
Proof. evaluated. Qed.

Example case_128 : seen (Node Leaf (Node Leaf (Node (Node Leaf Leaf) (Node (Node Leaf Leaf) Leaf))))
  [(1%positive, Neither)]
  None
  = expected false
  [(1%positive, 0, 1)].
Proof. evaluated. Qed.

Example left_128 : seen_left (Node Leaf (Node Leaf (Node (Node Leaf Leaf) (Node (Node Leaf Leaf) Leaf))))
  [1%positive] None
  = expected_left false [1%positive; 2%positive; 3%positive].
Proof. evaluated. Qed.

Example case_129 : seen (Node (Node Leaf Leaf) Leaf)
  [(1%positive, Only L); (2%positive, Only R)]
  None
  = expected false
  [(1%positive, 0, 1); (2%positive, 0, 3); (5%positive, 0, 7)].
Proof. evaluated. Qed.

Example left_129 : seen_left (Node (Node Leaf Leaf) Leaf)
  [1%positive; 2%positive] None
  = expected_left false [1%positive; 2%positive; 4%positive; 5%positive; 3%positive].
Proof. evaluated. Qed.

Example case_130 : seen (Node Leaf Leaf)
  [(1%positive, Both L)]
  (Some 2%positive)
  = expected true
  [(1%positive, 0, 1); (2%positive, 1, 2)].
Proof. evaluated. Qed.

Example left_130 : seen_left (Node Leaf Leaf)
  [1%positive] (Some 2%positive)
  = expected_left true [1%positive; 2%positive].
Proof. evaluated. Qed.

Example case_131 : seen (Node (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) Leaf))
  [(1%positive, Both L); (2%positive, Both L); (4%positive, Both R); (8%positive, Both R); (5%positive, Both R); (3%positive, Both L); (6%positive, Both R)]
  None
  = expected false
  [(1%positive, 0, 1); (2%positive, 1, 2); (4%positive, 3, 4); (9%positive, 7, 8); (8%positive, 6, 9); (17%positive, 13, 18); (16%positive, 12, 19); (5%positive, 2, 5); (11%positive, 5, 10); (10%positive, 4, 11); (3%positive, 0, 3); (6%positive, 1, 6); (13%positive, 3, 12); (12%positive, 2, 13); (7%positive, 0, 7)].
Proof. evaluated. Qed.

Example left_131 : seen_left (Node (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) Leaf))
  [1%positive; 2%positive; 4%positive; 8%positive; 5%positive; 3%positive; 6%positive] None
  = expected_left false [1%positive; 2%positive; 4%positive; 8%positive; 16%positive; 17%positive; 9%positive; 5%positive; 10%positive; 11%positive; 3%positive; 6%positive; 12%positive; 13%positive; 7%positive].
Proof. evaluated. Qed.

Example case_132 : seen Leaf
  []
  None
  = expected false
  [(1%positive, 0, 1)].
Proof. evaluated. Qed.

Example left_132 : seen_left Leaf
  [] None
  = expected_left false [1%positive].
Proof. evaluated. Qed.

Example case_133 : seen (Node (Node (Node (Node Leaf (Node Leaf Leaf)) Leaf) Leaf) (Node Leaf Leaf))
  [(1%positive, Both R); (3%positive, Both R); (2%positive, Neither)]
  None
  = expected false
  [(1%positive, 0, 1); (3%positive, 1, 2); (7%positive, 3, 4); (6%positive, 2, 5); (2%positive, 0, 3)].
Proof. evaluated. Qed.

Example left_133 : seen_left (Node (Node (Node (Node Leaf (Node Leaf Leaf)) Leaf) Leaf) (Node Leaf Leaf))
  [1%positive; 2%positive; 4%positive; 8%positive; 17%positive; 3%positive] None
  = expected_left false [1%positive; 2%positive; 4%positive; 8%positive; 16%positive; 17%positive; 34%positive; 35%positive; 9%positive; 5%positive; 3%positive; 6%positive; 7%positive].
Proof. evaluated. Qed.

Example case_134 : seen (Node (Node Leaf (Node Leaf (Node Leaf Leaf))) (Node Leaf (Node Leaf Leaf)))
  [(1%positive, Only R); (3%positive, Only L)]
  None
  = expected false
  [(1%positive, 0, 1); (3%positive, 0, 3); (6%positive, 0, 7)].
Proof. evaluated. Qed.

Example left_134 : seen_left (Node (Node Leaf (Node Leaf (Node Leaf Leaf))) (Node Leaf (Node Leaf Leaf)))
  [1%positive; 3%positive] None
  = expected_left false [1%positive; 2%positive; 3%positive; 6%positive; 7%positive].
Proof. evaluated. Qed.

Example case_135 : seen (Node (Node Leaf (Node Leaf (Node Leaf Leaf))) Leaf)
  [(1%positive, Both L); (2%positive, Only R); (5%positive, Only R); (11%positive, Both R)]
  None
  = expected false
  [(1%positive, 0, 1); (2%positive, 1, 2); (5%positive, 2, 5); (11%positive, 4, 11); (23%positive, 9, 22); (22%positive, 8, 23); (3%positive, 0, 3)].
Proof. evaluated. Qed.

Example left_135 : seen_left (Node (Node Leaf (Node Leaf (Node Leaf Leaf))) Leaf)
  [1%positive; 2%positive; 5%positive; 11%positive] None
  = expected_left false [1%positive; 2%positive; 4%positive; 5%positive; 10%positive; 11%positive; 22%positive; 23%positive; 3%positive].
Proof. evaluated. Qed.

Example case_136 : seen (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf)))
  [(1%positive, Both L); (2%positive, Both R); (5%positive, Both L); (4%positive, Both R); (3%positive, Both L); (6%positive, Both R); (7%positive, Both L)]
  None
  = expected false
  [(1%positive, 0, 1); (2%positive, 1, 2); (5%positive, 3, 4); (10%positive, 7, 8); (11%positive, 6, 9); (4%positive, 2, 5); (9%positive, 5, 10); (8%positive, 4, 11); (3%positive, 0, 3); (6%positive, 1, 6); (13%positive, 3, 12); (12%positive, 2, 13); (7%positive, 0, 7); (14%positive, 1, 14); (15%positive, 0, 15)].
Proof. evaluated. Qed.

Example left_136 : seen_left (Node (Node (Node Leaf Leaf) (Node Leaf Leaf)) (Node (Node Leaf Leaf) (Node Leaf Leaf)))
  [1%positive; 2%positive; 4%positive; 5%positive; 3%positive; 6%positive; 7%positive] None
  = expected_left false [1%positive; 2%positive; 4%positive; 8%positive; 9%positive; 5%positive; 10%positive; 11%positive; 3%positive; 6%positive; 12%positive; 13%positive; 7%positive; 14%positive; 15%positive].
Proof. evaluated. Qed.

Example case_137 : seen (Node Leaf (Node Leaf Leaf))
  [(1%positive, Neither)]
  None
  = expected false
  [(1%positive, 0, 1)].
Proof. evaluated. Qed.

Example left_137 : seen_left (Node Leaf (Node Leaf Leaf))
  [1%positive] None
  = expected_left false [1%positive; 2%positive; 3%positive].
Proof. evaluated. Qed.

Example case_138 : seen (Node Leaf (Node Leaf Leaf))
  [(1%positive, Only L)]
  None
  = expected false
  [(1%positive, 0, 1); (2%positive, 0, 3)].
Proof. evaluated. Qed.

Example left_138 : seen_left (Node Leaf (Node Leaf Leaf))
  [1%positive] None
  = expected_left false [1%positive; 2%positive; 3%positive].
Proof. evaluated. Qed.

Example case_139 : seen (Node (Node Leaf (Node Leaf Leaf)) (Node Leaf Leaf))
  [(1%positive, Both L); (2%positive, Both R); (5%positive, Both L); (3%positive, Both R)]
  None
  = expected false
  [(1%positive, 0, 1); (2%positive, 1, 2); (5%positive, 3, 4); (10%positive, 7, 8); (11%positive, 6, 9); (4%positive, 2, 5); (3%positive, 0, 3); (7%positive, 1, 6); (6%positive, 0, 7)].
Proof. evaluated. Qed.

Example left_139 : seen_left (Node (Node Leaf (Node Leaf Leaf)) (Node Leaf Leaf))
  [1%positive; 2%positive; 5%positive; 3%positive] None
  = expected_left false [1%positive; 2%positive; 4%positive; 5%positive; 10%positive; 11%positive; 3%positive; 6%positive; 7%positive].
Proof. evaluated. Qed.

Example case_140 : seen (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf))
  [(1%positive, Both L); (2%positive, Only L); (4%positive, Both R); (3%positive, Only R)]
  None
  = expected false
  [(1%positive, 0, 1); (2%positive, 1, 2); (4%positive, 2, 5); (9%positive, 5, 10); (8%positive, 4, 11); (3%positive, 0, 3); (7%positive, 0, 7)].
Proof. evaluated. Qed.

Example left_140 : seen_left (Node (Node (Node Leaf Leaf) Leaf) (Node Leaf Leaf))
  [1%positive; 2%positive; 4%positive; 3%positive] None
  = expected_left false [1%positive; 2%positive; 4%positive; 8%positive; 9%positive; 5%positive; 3%positive; 6%positive; 7%positive].
Proof. evaluated. Qed.

Example case_141 : seen (Node Leaf (Node Leaf Leaf))
  [(1%positive, Only L)]
  None
  = expected false
  [(1%positive, 0, 1); (2%positive, 0, 3)].
Proof. evaluated. Qed.

Example left_141 : seen_left (Node Leaf (Node Leaf Leaf))
  [1%positive] None
  = expected_left false [1%positive; 2%positive; 3%positive].
Proof. evaluated. Qed.

Example case_142 : seen (Node (Node Leaf Leaf) Leaf)
  [(1%positive, Both R); (2%positive, Both R)]
  (Some 4%positive)
  = expected true
  [(1%positive, 0, 1); (3%positive, 1, 2); (2%positive, 0, 3); (5%positive, 1, 6); (4%positive, 0, 7)].
Proof. evaluated. Qed.

Example left_142 : seen_left (Node (Node Leaf Leaf) Leaf)
  [1%positive; 2%positive] (Some 4%positive)
  = expected_left true [1%positive; 2%positive; 4%positive].
Proof. evaluated. Qed.

Example case_143 : seen (Node (Node (Node (Node Leaf (Node Leaf Leaf)) Leaf) Leaf) Leaf)
  [(1%positive, Both L); (2%positive, Both R); (4%positive, Only R)]
  None
  = expected false
  [(1%positive, 0, 1); (2%positive, 1, 2); (5%positive, 3, 4); (4%positive, 2, 5); (9%positive, 4, 11); (3%positive, 0, 3)].
Proof. evaluated. Qed.

Example left_143 : seen_left (Node (Node (Node (Node Leaf (Node Leaf Leaf)) Leaf) Leaf) Leaf)
  [1%positive; 2%positive; 4%positive] None
  = expected_left false [1%positive; 2%positive; 4%positive; 8%positive; 9%positive; 5%positive; 3%positive].
Proof. evaluated. Qed.

Example case_144 : seen Leaf
  []
  None
  = expected false
  [(1%positive, 0, 1)].
Proof. evaluated. Qed.

Example left_144 : seen_left Leaf
  [] None
  = expected_left false [1%positive].
Proof. evaluated. Qed.

Example case_145 : seen (Node Leaf Leaf)
  [(1%positive, Both L)]
  None
  = expected false
  [(1%positive, 0, 1); (2%positive, 1, 2); (3%positive, 0, 3)].
Proof. evaluated. Qed.

Example left_145 : seen_left (Node Leaf Leaf)
  [1%positive] None
  = expected_left false [1%positive; 2%positive; 3%positive].
Proof. evaluated. Qed.

Example case_146 : seen (Node Leaf (Node (Node (Node Leaf Leaf) Leaf) (Node (Node Leaf Leaf) (Node Leaf Leaf))))
  [(1%positive, Neither)]
  None
  = expected false
  [(1%positive, 0, 1)].
Proof. evaluated. Qed.

Example left_146 : seen_left (Node Leaf (Node (Node (Node Leaf Leaf) Leaf) (Node (Node Leaf Leaf) (Node Leaf Leaf))))
  [1%positive] None
  = expected_left false [1%positive; 2%positive; 3%positive].
Proof. evaluated. Qed.

Example case_147 : seen Leaf
  []
  None
  = expected false
  [(1%positive, 0, 1)].
Proof. evaluated. Qed.

Example left_147 : seen_left Leaf
  [] None
  = expected_left false [1%positive].
Proof. evaluated. Qed.

Example case_148 : seen (Node (Node Leaf (Node Leaf Leaf)) Leaf)
  [(1%positive, Both L); (2%positive, Both R); (5%positive, Both L)]
  None
  = expected false
  [(1%positive, 0, 1); (2%positive, 1, 2); (5%positive, 3, 4); (10%positive, 7, 8); (11%positive, 6, 9); (4%positive, 2, 5); (3%positive, 0, 3)].
Proof. evaluated. Qed.

Example left_148 : seen_left (Node (Node Leaf (Node Leaf Leaf)) Leaf)
  [1%positive; 2%positive; 5%positive] None
  = expected_left false [1%positive; 2%positive; 4%positive; 5%positive; 10%positive; 11%positive; 3%positive].
Proof. evaluated. Qed.

Example case_149 : seen (Node Leaf Leaf)
  [(1%positive, Both L)]
  None
  = expected false
  [(1%positive, 0, 1); (2%positive, 1, 2); (3%positive, 0, 3)].
Proof. evaluated. Qed.

Example left_149 : seen_left (Node Leaf Leaf)
  [1%positive] None
  = expected_left false [1%positive; 2%positive; 3%positive].
Proof. evaluated. Qed.
