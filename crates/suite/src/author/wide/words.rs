//! The limits of an implementation's numbers, bit sets, stacks and keys.

use super::WIDTHS;
use super::trace::traced;
use super::trees::parsed;
use crate::ask::WideWalk;
use crate::author::Author;

/// Name, reason, end, whether it is an any-hit query, and the tree in the format of [`parsed`]. Begins are multiples of
/// 8, so they are valid distances for any number of slots.
type Row = (&'static str, &'static str, Option<u32>, bool, &'static str);

/// 2^24 + 7 and 2^24 + 8 are equal in single precision. From 2^31 on, a signed 32-bit number is negative.
const ROWS: [Row; 15] = [
    (
        "end-float",
        "The child begins at 2^24 + 8, the end is 2^24 + 7: beyond.",
        Some(16_777_223),
        false,
        "( 16777224 )",
    ),
    ("end-signed", "The child begins above 2^31, the end is below.", Some(2_147_483_647), false, "( 2147483656 )"),
    ("order-float", "Begins of 2^27 + 8 and 2^27: the second comes first.", None, false, "( 134217736 134217728 )"),
    ("order-signed", "A begin of 2^31 comes after one of 8.", None, false, "( 2147483648 8 )"),
    ("hit-float", "A hit at 2^24 + 1 is beyond an end of 2^24.", Some(16_777_216), false, "( 0!16777217 )"),
    ("hit-signed", "A hit above 2^31 is beyond an end below.", Some(2_147_483_647), false, "( 0!2147483649 )"),
    ("best-float", "A hit at 2^24 is better than one at 2^24 + 1.", None, false, "( 0!16777217 8!16777216 )"),
    ("best-signed", "A hit at 5 is better than one above 2^31.", None, false, "( 0!2147483653 0!5 )"),
    ("kept-float", KEPT, None, false, "( 0 ( 0!16777223 ) 16777224 )"),
    ("kept-signed", KEPT, None, false, "( 0 ( 0!2147483647 ) 2147483656 )"),
    ("end-0-beyond", "An end of 0 is an end: what begins later is beyond.", Some(0), false, "( 8 0 )"),
    ("end-0-hit", "An end of 0 is an end: a hit at 1 is none, a hit at 0 is one.", Some(0), false, "( 0!1 0!0 )"),
    ("hit-at-end", "A hit exactly at the initial end is one.", Some(5), false, "( 0!5 8 )"),
    ("hit-at-end-any", "A hit exactly at the initial end ends the search.", Some(5), true, "( 0!5 0 )"),
    ("hit-behind-end-any", "A hit just behind the initial end ends nothing.", Some(5), true, "( 0!6 0 )"),
];

const KEPT: &str = "The hit below is just before the begin of the child that is pending: beyond on the way back.";

/// Adds the cases of all rows, for each number of slots.
pub(super) fn words(author: &mut Author) {
    for slots in WIDTHS {
        let mut case = |name: &str, why: &str, end: Option<u32>, any: bool, text: &str| {
            let walk = WideWalk { end, any: any.then_some(true), ..parsed(slots, text) };
            traced(author, &format!("{name}-{slots}"), why, walk);
        };
        for (name, why, end, any, text) in ROWS {
            case(name, why, end, any, text);
        }
        for levels in [10, 18, 34, 66] {
            let why = "A hit so far below the root that its bit may be lost: the root's last child is beyond.";
            let text = format!("( 0 {} 80 )", spine(levels, 0, "( 0!40 )"));
            case(&format!("dirty-{levels}"), why, None, false, &text);
        }
        for levels in [2, 8, 16, 34] {
            let why = "A hit, back, and twice down again without one: the root's last child is beyond all the same.";
            let (hit, none) = (spine(levels, 0, "( 0!40 )"), spine(levels, 8, "( 8 )"));
            case(
                &format!("dirty-again-{levels}"),
                why,
                None,
                false,
                &format!("( 0 ( 0 {hit} 8 ( 8 {none} 8 {none} ) ) 80 )"),
            );
        }
        for level in [7, 15, 23, 29, 30, 31] {
            let why = "Only one level, near the end of a word of a bit a level, has a pending child.";
            let below = spine(31 - level, 0, "( 0 )");
            case(&format!("summary-{level}"), why, None, false, &spine(level, 0, &format!("( 0 {below} 8 )")));
        }
    }
    for levels in [7, 10, 12, 16, 20] {
        let why = "Seven children of each level are pending at the bottom: a stack of fixed size is full.";
        let text = format!("{}( 0 ){}", "( 0 ".repeat(levels), " 8 8 8 8 8 8 8 )".repeat(levels));
        traced(author, &format!("stack-{levels}"), why, parsed(8, &text));
    }
}

/// Formats a chain of `levels` only children, and the tree below it.
fn spine(levels: usize, begin: u32, below: &str) -> String {
    format!("{}{below}{}", format!("( {begin} ").repeat(levels), " )".repeat(levels))
}
