//! `stackless methods`: lists the traversals.

use stackless_bvh::traverse::Method;
use stackless_bvh::wide;

use crate::output::{say, table};

pub(crate) fn run() {
    let binary = Method::ALL.map(|method| [method.name(), "binary", method.help()]);
    let wide = wide::Method::ALL.map(|method| [method.name(), "wide", method.help()]);
    let rows = binary.into_iter().chain(wide).map(|row| row.map(str::to_owned).to_vec());
    say!("{}", table(&["method", "trees", "backtracking"], 3, rows.collect()));
}
