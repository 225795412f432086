use glam::{DVec3, Vec3};

use super::*;
use crate::{Format, read_named, read_rows_from};

fn note<V: Position>(text: &str) -> Option<String> {
    read_named::<V>("a.obj".as_ref(), text.as_bytes()).unwrap().note("a.obj".as_ref())
}

#[test]
fn decimals_are_counted_and_measured_by_the_scene() {
    // A diagonal of 5, far from the origin.
    let text = "v 691607.1 0 0\nv 691610.1 4 0\nv 691607.25 0.1 -0.\nf 1 2 3\n";
    let single = "a.obj: 3 of 9 numbers were rounded to single precision, by at most 5.1e-3 of the scene's size";
    let double = "a.obj: 3 of 9 numbers were rounded to double precision, by at most 1.2e-11 of the scene's size";
    assert_eq!(note::<Vec3>(text).unwrap(), single);
    assert_eq!(note::<DVec3>(text).unwrap(), double);
    assert_eq!(note::<Vec3>(&text.replace(".1", ".25")), None);
    let near = "a.obj: 1 of 9 numbers was rounded to double precision, by at most 4.9e-18 of the scene's size";
    assert_eq!(note::<DVec3>("v 0 0 0\nv 1 0 0\nv 0 1 0.1\nf 1 2 3\n").unwrap(), near);
    // A scene of size 0.
    let point = "a.obj: 3 of 3 numbers were rounded to single precision, by at most 1.5e-9";
    assert_eq!(note::<Vec3>("v .1 .1 .1\nf 1 1 1\n").unwrap(), point);
}

#[test]
fn rays_are_measured_by_their_scene() {
    let rays = |text: &str| read_rows_from::<Ray<Vec3>>(text.as_bytes(), "rays.csv", Format::Csv).unwrap();
    let note = |text, size| rays(text).note("r.csv".as_ref(), size).unwrap();
    let at = |most| format!("r.csv: 1 of 8 numbers was rounded to single precision, by at most {most}");
    let share = |most: &str| at(format!("{most} of the scene's size"));
    assert_eq!(note("0.1,0,0,0,0,1,0,1\n", 1.0), share("1.5e-9"));
    assert_eq!(note("0.1,0,0,0,0,1,0,1\n", 1e-3), share("1.5e-6"));
    // Directions and intervals are counted separately.
    assert_eq!(note("0,0,0,0,0,0.1,0,1\n", 1e-3), share("1.5e-8"));
    assert_eq!(note("0,0,0,1e-38,0,1000,0,1\n", 1e-3), share("6.5e-49"));
    assert_eq!(note("0,0,0,0,0,1,0,1e30\n", 1.0), share("1.6e-8"));
    assert_eq!(note("0,0,0,0,0,1,1e-50,1\n", 1.0), share("1.0e0"));
    assert_eq!(rays("0.5,0,0,0,0,1,0,inf\n").note("r.csv".as_ref(), 1.0), None);
}

#[test]
fn sizes_are_in_range() {
    let mesh =
        |a: f64, b: f64| Mesh::new(vec![DVec3::splat(a), DVec3::splat(b), DVec3::ZERO], vec![[0, 1, 2]]).unwrap();
    assert!((size(&mesh(-1.0, 2.0)) - 27_f64.sqrt()).abs() < 1e-15);
    assert_eq!(size(&mesh(f64::MAX, -f64::MAX)), f64::MAX);
    assert_eq!(size(&mesh(0.0, 0.0)), 0.0);
    assert_eq!([3.14e-8, 1.0, 9.99, 5e-324].map(above), ["3.2e-8", "1.0e0", "1.0e1", "4.9e-324"]);
}

#[test]
fn every_text_counts_its_decimals() {
    let stl = "solid\nfacet normal 0 0 0.1\nouter loop\nvertex 0 0 0\nvertex 0.5 0 .1\nvertex 0 1e-1 0\nendloop\nendfacet\nendsolid\n";
    let header = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty double y\nproperty float z\nproperty float w\n\
                  element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    let ply = format!("{header}0 0 0 .1\n0.5 0 .1 .1\n0 1e-1 0 .1\n3 0 1 2\n");
    for (name, text) in [("a.stl", stl), ("a.ply", &ply), ("a.obj", "v 0 0 0\nv 0.5 0 .1\nv 0 1e-1 0\nf 1 2 3\n")] {
        let loaded = read_named::<DVec3>(name.as_ref(), text.as_bytes()).unwrap();
        assert_eq!(
            loaded.mesh.vertices(),
            [DVec3::ZERO, DVec3::new(0.5, 0.0, 0.1), DVec3::new(0.0, 0.1, 0.0)],
            "{name}"
        );
        let Rounding { numbers, rounded, moved, turned } = loaded.rounding;
        assert_eq!((numbers, rounded, turned), (9, 2, 0.0), "{name}");
        assert!((5e-18..1e-17).contains(&moved), "{name}: {moved:e}");
    }
    let csv = ("0,.5,0,0,0,0.1,1e-1,2\n", Format::Csv);
    let json = (r#"{"origin":[0,0.5,0],"direction":[0,0,0.1],"tmin":1e-1,"tmax":2}"#, Format::JsonLines);
    for (text, format) in [csv, json] {
        let Rounding { numbers, rounded, moved, turned } =
            read_rows_from::<Ray<DVec3>>(text.as_bytes(), "rays", format).unwrap().rounding;
        assert_eq!((numbers, rounded, moved), (8, 2, 0.0), "{format}");
        assert!((5e-17..2e-16).contains(&turned), "{format}: {turned:e}");
    }
    let json = r#"{"origin":[0,0,0],"direction":[0,0,1]}"#;
    let rounding = read_rows_from::<Ray<DVec3>>(json.as_bytes(), "rays", Format::JsonLines).unwrap().rounding;
    assert_eq!(rounding, Rounding { numbers: 6, ..Rounding::default() });
}
