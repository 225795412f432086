//! Single and double precision of `stackless trace`, and the notes about rounded numbers.

use std::path::Path;

use super::support::{Folder, stackless};

/// Cells along an edge of a survey.
const CELLS: usize = 20;

/// Hundredths of a metre as a decimal.
fn metres(hundredths: usize) -> String {
    format!("{}.{:02}", hundredths / 100, hundredths % 100)
}

/// A survey: a grid of points 25 cm apart, in metres of a national grid, as OBJ. The cells have two faces each.
fn survey() -> String {
    let points = (0..=CELLS).flat_map(|row| (0..=CELLS).map(move |column| (row, column)));
    let vertex = |(row, column): (usize, usize)| {
        let [x, y] = [69_160_735 + 25 * column, 533_476_020 + 25 * row].map(metres);
        format!("v {x} {y} {}\n", metres(51_510 + (row * 3 + column * 2) % 7))
    };
    let cells = (0..CELLS).flat_map(|row| (0..CELLS).map(move |column| row * (CELLS + 1) + column + 1));
    let above = CELLS + 1;
    let faces = |a: usize| format!("f {a} {} {}\nf {a} {} {}\n", a + 1, a + above + 1, a + above + 1, a + above);
    points.map(vertex).chain(cells.map(faces)).collect()
}

/// From ten metres above the first face of each cell downwards.
fn rays() -> String {
    let cells = (0..CELLS).flat_map(|row| (0..CELLS).map(move |column| (row, column)));
    let ray = |(row, column)| {
        let [x, y] = [69_160_750 + 25 * column, 533_476_027 + 25 * row].map(metres);
        format!("{x},{y}5,525.10,0,0,-1\n")
    };
    cells.map(ray).collect()
}

/// Number of rays that hit the face below them.
fn right_faces(hits: &str) -> usize {
    let lines = hits.lines().filter(|line| line.starts_with(|c: char| c.is_ascii_digit())).enumerate();
    lines.filter(|(i, line)| line.starts_with(&format!("{},", 2 * i))).count()
}

#[test]
fn a_survey_is_traced_as_it_is() {
    let folder = Folder::new();
    let (mesh, rays) = (folder.file("survey.obj", survey()), folder.file("rays.csv", rays()));
    let trace = |options: &str| {
        let run = stackless(&format!("trace {options} -o - --rays"), &[&rays, &mesh]);
        assert_eq!(run.code, Some(0), "{run:?}");
        run
    };
    let double = trace("");
    assert_eq!(right_faces(&double.stdout), CELLS * CELLS, "{double:?}");
    assert!(double.stderr.contains("by wide-record, exact, in double precision\n"), "{double:?}");
    let single = trace("--single");
    assert_eq!(right_faces(&single.stdout), 0, "{single:?}");
    assert!(single.stderr.contains("by wide-record, exact, in single precision\n"), "{single:?}");
    // One line for each file has the number and the size of rounding errors. The diagonal is 7 m long.
    let (mesh, rays) = (mesh.display(), rays.display());
    for (run, precision, shares) in [(double, "double", ["6.6e-11"; 2]), (single, "single", ["2.9e-2", "3.2e-2"])] {
        let note = |file: &dyn std::fmt::Display, counts, share| {
            let most = format!("by at most {share} of the scene's size");
            format!("{file}: {counts} numbers were rounded to {precision} precision, {most}\n")
        };
        let (mesh, rays) = (note(&mesh, "1323 of 1323", shares[0]), note(&rays, "800 of 2400", shares[1]));
        assert!(run.stderr.contains(&mesh) && run.stderr.contains(&rays), "{mesh}{rays}{}", run.stderr);
    }
}

/// Without rounding there is no note.
#[test]
fn what_is_read_as_it_is_needs_no_note() {
    let folder = Folder::new();
    let mesh = folder.file("mesh.obj", "v 0 0 0.5\nv 16777216 0 -2.5e-1\nv 0 1e0 0\nf 1 2 3\n");
    let rays = folder.file("rays.csv", "0.125,.25,1,0,0,-1,0,inf\n");
    for precision in ["--single", ""] {
        let out = folder.path("hits.csv");
        stackless(&format!("trace {precision} -o"), &[&out, Path::new("--rays"), &rays, &mesh]).passes();
    }
    // A number that only double precision can represent.
    let mesh = folder.file("mesh.obj", "v 0 0 0\nv 16777217 0 0\nv 0 1 0\nf 1 2 3\n");
    let note = ": 1 of 9 numbers was rounded to single precision, by at most 6.0e-8 of the scene's size\n";
    for (precision, said) in [("--single", note), ("", "")] {
        let run = stackless(&format!("trace {precision} -o"), &[&folder.path("o"), Path::new("--rays"), &rays, &mesh]);
        assert_eq!(run.stderr.strip_prefix(mesh.to_str().unwrap()).unwrap_or(&run.stderr), said);
    }
}

#[test]
fn what_double_precision_does_not_have_is_refused_by_its_name() {
    let folder = Folder::new();
    let rays = folder.file("rays.csv", "0,0,5,0,0,-1\n");
    for (options, message) in [
        ("--accuracy fast", "--accuracy fast: double precision is always exact; add --single"),
        ("--accuracy precise --method hashed", "--accuracy precise: double precision is always exact; add --single"),
    ] {
        stackless(&format!("trace soup {options} -o - --rays"), &[&rays]).fails_naming(&[message]);
        let run = stackless(&format!("trace soup {options} --single -o - --rays"), &[&rays]);
        assert_eq!(run.code, Some(0), "{options}: {run:?}");
    }
}

/// All rounded numbers are counted, also if no triangle remains.
#[test]
fn triangles_without_area_are_counted() {
    let folder = Folder::new();
    let rays = folder.file("rays.csv", "0.25,0.25,5,0,0,-1\n");
    let trace = |mesh: &Path| {
        let out = folder.path("hits.csv");
        let run = stackless("trace -o", &[&out, Path::new("--rays"), &rays, mesh]).passes();
        assert!(std::fs::read_to_string(&out).unwrap().starts_with("prim,t,u,v\n"));
        run.last_line().to_owned()
    };
    for count in 1_u32..=2 {
        let mut bytes = vec![b' '; 80];
        bytes.extend(count.to_le_bytes());
        let corners = [0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0_f32].map(f32::to_le_bytes).concat();
        bytes.extend((0..count).flat_map(|_| [&corners[..], &[0, 0]].concat()));
        let said =
            ["flat: 1 of 1 triangle has no area: rays miss it", "flat: 2 of 2 triangles have no area: rays miss them"];
        assert_eq!(trace(&folder.file("flat.stl", bytes)), said[count as usize - 1]);
    }
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nf 1 2 3\nf 1 2 4\nf 1 1 3\n";
    assert_eq!(trace(&folder.file("mesh.obj", obj)), "mesh: 2 of 3 triangles have no area: rays miss them");
}
