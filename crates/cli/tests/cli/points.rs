//! `stackless contains`, `stackless nearest`, and the queries of `stackless trace`, on a box with known answers.

use std::path::{Path, PathBuf};

use super::support::{Folder, Run, data, stackless};

/// A box from 0 to 4 of six squares, and a face without area.
const BOX: &str = "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nv 0 0 4\nv 4 0 4\nv 4 4 4\nv 0 4 4\n\
                   f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

fn run(command: &str, mesh: &str, input: &str) -> (Run, Folder, PathBuf) {
    let folder = Folder::new();
    let (mesh, input) = (folder.file("mesh.obj", mesh), folder.file("in.csv", input));
    let out = folder.path("out.csv");
    let file = if command.starts_with("trace") { "--rays" } else { "--points" };
    let run = stackless(command, &[&mesh, Path::new(file), &input, Path::new("-o"), &out]);
    (run, folder, out)
}

/// The output file of a command.
fn answers(command: &str, mesh: &str, input: &str) -> String {
    let (run, _folder, out) = run(command, mesh, input);
    assert_eq!(run.code, Some(0), "{run:?}");
    std::fs::read_to_string(out).unwrap()
}

/// The error of a command.
fn refusal(command: &str, mesh: &str, input: &str) -> String {
    let (run, folder, _) = run(command, mesh, input);
    assert_eq!((run.code, folder.names()), (Some(2), vec!["in.csv".into(), "mesh.obj".into()]), "{run:?}");
    run.stderr
}

#[test]
fn points_are_inside_outside_or_on_the_surface() {
    let points = "x,y,z\n1,2,3\n4,2,1\n0,0,0\n4.000000000000001,2,1\n3.9999999999999996,2,1\n9,9,9\n";
    let places = "place\ninside\nsurface\nsurface\noutside\ninside\noutside\n";
    for rule in ["parity", "nonzero", "winding"] {
        assert_eq!(answers(&format!("contains --rule {rule}"), BOX, points), places, "{rule}");
    }
    // Single precision cannot represent the two points next to the face.
    assert_eq!(
        answers("contains --single", BOX, points),
        "place\ninside\nsurface\nsurface\nsurface\nsurface\noutside\n"
    );
}

#[test]
fn rules_that_do_not_fit_say_which_one_does() {
    let (open, _) = BOX.rsplit_once("f 4").unwrap();
    for rule in ["parity", "nonzero"] {
        let said = refusal(&format!("contains --rule {rule}"), open, "1,2,3\n");
        assert!(said.contains("mesh: the mesh is open: 4 edges") && said.contains("rule `winding` fits"), "{said}");
        let said = refusal(&format!("nearest --signed {rule}"), open, "1,2,3\n");
        assert!(said.contains("rule `winding` fits"), "{said}");
    }
    assert_eq!(answers("contains --rule winding", open, "1,2,2\n"), "place\ninside\n");
    let turned = BOX.replace("f 5 6 7 8", "f 8 7 6 5");
    let said = refusal("contains --rule nonzero", &turned, "1,2,3\n");
    assert!(said.contains("not oriented") && said.contains("rule `parity` fits"), "{said}");
    assert_eq!(answers("contains", &turned, "1,2,3\n"), "place\ninside\n");
    // Every face twice: by parity all points are outside, which is printed.
    let (_, faces) = BOX.split_once("f 1").unwrap();
    let twice = format!("{BOX}f 1{faces}");
    let (run, _folder, out) = run("contains", &twice, "1,2,3\n");
    assert!(run.code == Some(0) && run.stderr.contains("12 faces repeated: by parity they cancel out"), "{run:?}");
    assert_eq!(std::fs::read_to_string(out).unwrap(), "place\noutside\n");
    assert_eq!(answers("contains --rule nonzero", &twice, "1,2,3\n"), "place\ninside\n");
}

#[test]
fn the_nearest_point_has_a_face_a_distance_and_weights() {
    let points = "x,y,z\n1,2,-3\n7,8,4\n1,2,1\n0,0,0\n";
    let found = "prim,distance,x,y,z,u,v,place\n\
                 0,3.0,1.0,2.0,0.0,0.25,0.25,interior\n\
                 2,5.0,4.0,4.0,4.0,0.0,1.0,vertex\n";
    let lines = answers("nearest", BOX, points);
    assert_eq!(lines.lines().count(), 5);
    let distances = |lines: &str| -> Vec<String> {
        lines.lines().skip(1).map(|line| line.split(',').nth(1).unwrap().to_owned()).collect()
    };
    assert_eq!(distances(&lines), ["3.0", "5.0", "1.0", "0.0"], "{lines}");
    assert_eq!(distances(&answers("nearest --signed parity", BOX, points)), ["3.0", "5.0", "-1.0", "0.0"]);
    assert_eq!(distances(&answers("nearest --radius 3", BOX, points)), ["3.0", "", "1.0", "0.0"]);
    assert_eq!(distances(&answers("nearest --radius 2.5 --single", BOX, points)), ["", "", "1.0", "0.0"]);
    let first_two: String = lines.split_inclusive('\n').take(3).collect();
    assert_eq!(first_two, found);
    // The second of the two triangles of face 1 is triangle 3.
    assert_eq!(answers("nearest --faces", BOX, "7,8,4\n").lines().nth(1).unwrap().split(',').next(), Some("1"));
    let said = stackless("nearest soup --points - -o - --radius -1", &[]);
    assert!(said.code == Some(2) && said.stderr.contains("expected a number that is not negative"), "{said:?}");
}

/// Rays miss a triangle without area; the nearest point may be on one.
#[test]
fn triangles_without_area_are_near() {
    let mesh = format!("{BOX}v 9 0 0\nv 9 9 0\nv 9 4 0\nf 9 10 11\n");
    assert!(answers("nearest", &mesh, "9.5,1,0\n").contains("\n12,0.5,9.0,1.0,0.0,"));
    assert_eq!(answers("trace", &mesh, "9,1,5,0,0,-1\n"), "prim,t,u,v\n-1,,,\n");
}

#[test]
fn rays_have_all_their_hits_and_crossings() {
    // Through the middle, through an edge of two faces, through a corner, and away.
    let rays = "1,2,-1,0,0,1\n-1,0,1,1,0,0\n-1,-1,-1,1,1,1\n9,9,9,1,0,0\n";
    let all = answers("trace --query all", BOX, rays);
    assert!(all.starts_with("ray,prim,t,u,v\n0,0,1.0,0.25,0.25\n0,3,5.0,"), "{all}");
    let counts = |ray: &str| all.lines().filter(|line| line.starts_with(ray)).count();
    assert!(counts("0,") == 2 && counts("2,") > 2 && counts("3,") == 0, "{all}");
    let crossings = answers("trace --query crossings", BOX, rays);
    assert_eq!(crossings, "crossings\n2\n2\n2\n0\n");
    assert_eq!(answers("trace --query all --single --method hashed", BOX, rays), all);
    assert_eq!(answers("trace --query all --faces", BOX, "1,2,-1,0,0,1\n").lines().last().unwrap()[..4], *"0,1,");
    let said = refusal("trace --query crossings --method hashed", BOX, rays);
    assert!(said.contains("--query crossings: hashed does not count them"), "{said}");
}

#[test]
fn points_come_from_the_standard_input_and_from_arrays() {
    let torus = data("cube.ply");
    let run = stackless("contains --points missing.npy -o -", &[&torus]);
    run.fails_naming(&["missing.npy: cannot be read"]);
    let run = stackless("contains --points rays.txt -o -", &[&torus]);
    run.fails_naming(&["rays.txt: extension \"txt\", expected csv, jsonl or npy"]);
}
