//! `stackless curve`.

use crate::support::{Folder, read_json, stackless};

#[test]
fn time_against_proved_error() {
    let folder = Folder::new();
    let (json, svg) = (folder.path("rows.json"), folder.path("rows.svg"));
    let args = "curve --curves 64 --rounds 1 --tolerance 1e-2,1e-9,0 --methods stack,implicit-b1,left-first --degree 4";
    let run = stackless(&format!("{args} --plot {} --json", svg.display()), &[&json]).passes();
    assert!(run.last_line().starts_with("64 curves of degree 4"), "{}", run.stdout);
    let record = read_json(&json);
    assert_eq!(record["command"], "curve");
    let rows = record["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 9);
    for row in rows {
        let number = |name: &str| row[name].as_f64().unwrap();
        assert!(number("nanoseconds") > 0.0 && number("steps") >= 1.0, "{row}");
        assert_eq!(number("reached") + number("out_of_steps") + number("rounding"), 64.0, "{row}");
        if number("tolerance") >= 1e-9 {
            assert!(number("max_error") <= number("tolerance") && number("reached") == 64.0, "{row}");
        }
    }
    // The answers do not depend on what remembers the way.
    for pair in rows.chunks(3) {
        assert_eq!((&pair[0]["steps"], &pair[0]["max_error"]), (&pair[1]["steps"], &pair[1]["max_error"]));
    }
    assert!(rows[6]["max_error"].as_f64() < rows[3]["max_error"].as_f64());
    let svg = std::fs::read_to_string(svg).unwrap();
    assert!(svg.starts_with("<svg") && svg.ends_with("</svg>\n") && svg.contains("implicit-b1"));
}

#[test]
fn what_cannot_be_asked() {
    for (args, what) in [
        ("curve --degree 9", "9 is not in 1..=8"),
        ("curve --tolerance -1", "unexpected argument '-1'"),
        ("curve --tolerance=-1", "negative"),
        ("curve --tolerance wide", "not a number"),
        ("curve --families square", "possible values: random, on, "),
        ("curve --methods laine-2", "possible values: stack, left-first, "),
        ("curve --curves 0", "0 is not in 1..="),
    ] {
        let run = stackless(args, &[]);
        assert_eq!((run.code, run.stdout.as_str()), (Some(2), ""), "{args}");
        assert!(run.stderr.contains(what), "{args}: {}", run.stderr);
    }
}
