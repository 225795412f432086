//! `stackless trace`: hits in files are exact to the bit, and equal those of testing all triangles.

use std::fmt::Write as _;
use std::path::Path;

use glam::{DVec3, Vec3};
use stackless_bvh::generate::procedural;
use stackless_bvh::geom::{Mesh, Ray};
use stackless_bvh::internals::trace::Truth;
use stackless_bvh::trace::Hit;
use stackless_bvh::traverse::Method;
use stackless_bvh::wide;

use super::support::{Folder, data, stackless};

fn ray_file(rays: &[Ray]) -> String {
    let mut text = "ox,oy,oz,dx,dy,dz,tmin,tmax\n".to_owned();
    for ray in rays {
        // All digits, so that numbers are not rounded.
        for number in ray.origin().to_array().into_iter().chain(ray.direction().to_array()) {
            write!(text, "{number:.149},").unwrap();
        }
        writeln!(text, "{:.149},{:.149}", ray.tmin(), ray.tmax()).unwrap();
    }
    text
}

fn parse_hits(text: &str) -> Vec<Option<Hit>> {
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some("prim,t,u,v"));
    let parse = |line: &str| {
        let columns: Vec<_> = line.split(',').collect();
        let [prim, t, u, v] = columns[..] else { panic!("{line}") };
        if prim == "-1" {
            assert_eq!([t, u, v], [""; 3], "{line}");
            return None;
        }
        let [t, u, v] = [t, u, v].map(|number| number.parse().unwrap());
        Some(Hit { prim: prim.parse().unwrap(), t, u, v })
    };
    lines.map(parse).collect()
}

fn bits(hit: Hit) -> [u32; 4] {
    [hit.prim, hit.t.to_bits(), hit.u.to_bits(), hit.v.to_bits()]
}

/// The traversals of binary and of wide trees.
fn all_methods() -> impl Iterator<Item = &'static str> {
    Method::ALL.into_iter().map(Method::name).chain(wide::Method::ALL.into_iter().map(wide::Method::name))
}

/// Traces the rays by the command in single precision, with additional arguments.
pub(crate) fn trace(scene: &Path, rays: &[Ray], args: &str) -> Vec<Option<Hit>> {
    let folder = Folder::new();
    let (rays_file, out) = (folder.file("rays.csv", ray_file(rays)), folder.path("hits.csv"));
    stackless(&format!("trace --single {args} --rays"), &[&rays_file, Path::new("-o"), &out, scene]).passes();
    assert_eq!(folder.names(), ["hits.csv", "rays.csv"]);
    let hits = parse_hits(&std::fs::read_to_string(&out).unwrap());
    assert_eq!(hits.len(), rays.len());
    hits
}

fn assert_true(mesh: &Mesh, scene: &Path, rays: &[Ray], methods: impl IntoIterator<Item = &'static str>) {
    let truth = Truth::new(mesh);
    let closest_hits: Vec<_> = rays.iter().map(|ray| truth.closest(ray).map(|hit| hit.rounded())).collect();
    assert!(closest_hits.iter().any(Option::is_some) && closest_hits.iter().any(Option::is_none));
    for method in methods {
        let closest = trace(scene, rays, &format!("--method {method}"));
        for ((ray, expected), found) in rays.iter().zip(&closest_hits).zip(&closest) {
            assert_eq!(found.map(bits), expected.map(bits), "{method}: {ray:?}");
        }
        let any = trace(scene, rays, &format!("--query any --method {method}"));
        for ((ray, expected), found) in rays.iter().zip(&closest_hits).zip(&any) {
            assert_eq!(found.is_some(), expected.is_some(), "{method}: {ray:?}");
            // Not the closest hit, but a hit of the named triangle.
            if let Some(hit) = *found {
                let all = truth.all(ray);
                let own = all.iter().find(|own| own.prim == hit.prim).unwrap();
                assert_eq!(bits(hit), bits(own.rounded()), "{method}: {ray:?}");
            }
        }
    }
}

#[test]
fn what_a_mesh_file_has_beyond_its_format_is_said() {
    let folder = Folder::new();
    let (mesh, rays) = (folder.path("odd.obj"), folder.file("rays.csv", "0.25,0.25,-1,0,0,1,0,inf\r"));
    let args: [&Path; 4] = [&rays, Path::new("-o"), &folder.path("hits.csv"), &mesh];
    for (mark, first) in [("", "V 0 0 0"), ("\u{feff}", "# a mark, and no line feed")] {
        std::fs::write(&mesh, format!("{mark}v 0 0 0\r{first}\rv 1 0 0\rv 0 1 0\rf 1 2 3\r")).unwrap();
        let run = stackless("trace --rays", &args);
        assert_eq!(run.code, Some(0), "{run:?}");
        let said = run.stderr.contains("1 statement that OBJ does not have was skipped, the first in line 2: \"V\"");
        assert_eq!(said, mark.is_empty(), "{run:?}");
        let hits = std::fs::read_to_string(folder.path("hits.csv")).unwrap();
        assert_eq!(hits, "prim,t,u,v\n0,1.0,0.25,0.25\n", "{run:?}");
    }
}

/// A square and a triangle: the second of three triangles belongs to the first face.
#[test]
fn faces_are_numbered_as_in_the_file() {
    let folder = Folder::new();
    let mesh = folder.file("mix.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\nf 1 2 3 4\nf 2 5 6\n");
    let rays = folder.file("rays.csv", "0.75,.5,5,0,0,-1\n0.25,.5,5,0,0,-1\n1.75,.5,5,0,0,-1\n9,9,9,0,0,1\n");
    let args: [&Path; 4] = [&rays, Path::new("-o"), &folder.path("hits.csv"), &mesh];
    for (command, expected) in
        [("trace --rays", ["0", "1", "2", "-1"]), ("trace --faces --rays", ["0", "0", "1", "-1"])]
    {
        stackless(command, &args).passes();
        let hits = std::fs::read_to_string(folder.path("hits.csv")).unwrap();
        let prims: Vec<_> = hits.lines().skip(1).map(|line| line.split(',').next().unwrap()).collect();
        assert_eq!(prims, expected, "{command}");
    }
}

#[cfg(unix)]
#[test]
fn any_name_that_the_system_has_is_an_output() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;
    let folder = Folder::new();
    let (mesh, rays) = (data("cube.ply"), folder.file("rays.csv", "0.5,0.5,-9,0,0,1\n"));
    for name in [[&[b'x'; 251][..], b".csv"].concat(), b"\xFF.csv".to_vec()] {
        let output = folder.path("").join(OsStr::from_bytes(&name));
        stackless("trace --rays", &[&rays, Path::new("-o"), &output, &mesh]).passes();
        assert!(std::fs::read_to_string(&output).unwrap().starts_with("prim,t,u,v\n"));
    }
}

#[test]
fn every_method_on_a_mesh_file() {
    for name in ["cube.ply", "cube.obj"] {
        let mesh = stackless_scene::load::<Vec3>(&data(name)).unwrap().mesh;
        assert_true(&mesh, &data(name), &procedural::rays(&mesh, 3, 500), all_methods());
    }
}

#[test]
fn every_method_on_a_made_scene() {
    let mesh = procedural::soup(1, 20_000);
    assert_true(&mesh, Path::new("soup"), &procedural::rays(&mesh, 4, 60), all_methods());
}

#[test]
fn every_made_scene() {
    for (name, mesh) in [("strands", procedural::strands(1, 2000)), ("stadium", procedural::stadium(1))] {
        let methods = ["hashed", "complete", "hapala", "wide-hashed"];
        assert_true(&mesh, Path::new(name), &procedural::rays(&mesh, 5, 40), methods);
    }
}

#[test]
fn the_default_is_the_fastest_traversal_that_is_as_exact_as_asked() {
    let folder = Folder::new();
    let (rays, out) = (folder.file("rays.csv", "0.5,0.5,-9,0,0,1,0,inf\n"), folder.path("hits.csv"));
    for (options, by) in [
        ("", "by wide-record, exact, in double precision"),
        ("--method wide-hashed", "by wide-hashed, exact, in double precision"),
        ("--method hashed", "by hashed, exact, in double precision"),
        ("--single", "by wide-record, exact, in single precision"),
        ("--single --accuracy fast", "by afra, fast, in single precision"),
        ("--single --accuracy exact --method hashed", "by hashed, exact, in single precision"),
        ("--single --method wide-stack --build best", "by wide-stack, exact, in single precision"),
    ] {
        let run = stackless(&format!("trace soup {options} --rays"), &[&rays, Path::new("-o"), &out]);
        assert!(run.code == Some(0) && run.stdout.contains(by), "{run:?}");
    }
    let run = stackless("trace soup --single --method wide-record --accuracy watertight -o - --rays", &[&rays]);
    run.fails_naming(&["--accuracy watertight", "wide-record is always exact"]);
}

/// A pentagon in the plane z = 0 and, behind it, a triangle in z = 1: three triangles, then the fourth.
const PENTAGON: [&str; 2] = [
    "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\nelement face 2\n\
     property list uchar int vertex_indices\nend_header\n\
     0 0 0\n4 0 0\n6 2 0\n3 4 0\n0 2 0\n0 0 1\n9 0 1\n0 9 1\n5 0 1 2 3 4\n3 5 6 7\n",
    "v 0 0 0\nv 4 0 0\nv 6 2 0\nv 3 4 0\nv 0 2 0\nv 0 0 1\nv 9 0 1\nv 0 9 1\nf 1 2 3 4 5\nf 6 7 8\n",
];

#[test]
fn every_builder_gives_the_same_hits() {
    let scene = Path::new("stadium");
    let rays = procedural::rays(&procedural::stadium(1), 5, 400);
    let expected = trace(scene, &rays, "");
    assert!(expected.iter().any(Option::is_some) && expected.contains(&None));
    for build in ["standard", "best", "sbvh", "bounded", "median"] {
        for method in ["wide-record", "hashed"] {
            let found = trace(scene, &rays, &format!("--build {build} --method {method}"));
            assert_eq!(found, expected, "{build} {method}");
        }
    }
}

#[test]
fn polygons_fan_out_in_place() {
    let folder = Folder::new();
    let rays = "4,0.5,-2,0,0,1,0,inf\n3,3,-2,0,0,1,0,inf\n0.5,2,-2,0,0,1,0,inf\n1,6,-2,0,0,1,0,inf\n\
                # a comment, then a ray away from all\n4,0.5,-2,0,0,-1,0,inf\n4,0.5,-2,0,0,2,0,0.75\n";
    let rays = folder.file("rays.csv", rays);
    for (extension, text) in ["ply", "obj"].into_iter().zip(PENTAGON) {
        let mesh = folder.file(&format!("pentagon.{extension}"), text);
        let out = folder.path("hits.csv");
        for method in all_methods() {
            stackless(&format!("trace --single --method {method} --rays"), &[&rays, Path::new("-o"), &out, &mesh])
                .passes();
            let hits = parse_hits(&std::fs::read_to_string(&out).unwrap());
            let seen: Vec<_> = hits.iter().map(|hit| hit.map(|hit| (hit.prim, hit.t))).collect();
            let expected = [Some((0, 2.0)), Some((1, 2.0)), Some((2, 2.0)), Some((3, 3.0)), None, None];
            assert_eq!(seen, expected, "{method}");
        }
    }
}

/// Rays and hits are equal in each format; degenerate triangles are reported, and a single ray works.
#[test]
fn rays_and_hits_stand_in_every_format() {
    let folder = Folder::new();
    let mesh = folder.file("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 1 2\nf 1 2 3\n");
    let text = "0.25,0.25,-1,0,0,1\n5,5,-1,0,0,1\n";
    let lines = "{\"origin\":[0.25,0.25,-1],\"direction\":[0,0,1]}\n{\"origin\":[5,5,-1],\"direction\":[0,0,1]}\n";
    let header = "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 6), }\n";
    let numbers = text.split([',', '\n']).filter_map(|number| number.parse::<f64>().ok());
    let array: Vec<u8> = [b"\x93NUMPY\x01\x00", &(header.len() as u16).to_le_bytes()[..], header.as_bytes()]
        .concat()
        .into_iter()
        .chain(numbers.flat_map(f64::to_le_bytes))
        .collect();
    let csv = "prim,t,u,v\n1,1.0,0.25,0.25\n-1,,,\n";
    let hit_lines = "{\"prim\":1,\"t\":1.0,\"u\":0.25,\"v\":0.25}\n{\"prim\":-1,\"t\":null,\"u\":null,\"v\":null}\n";
    let files = [
        ("rays.csv", text.as_bytes()),
        ("rays.jsonl", lines.as_bytes()),
        ("rays.npy", &array),
        ("rays", text.as_bytes()),
    ];
    for (name, bytes) in files {
        let rays = folder.file(name, bytes);
        for (out, expected) in [("hits.csv", csv), ("hits.ndjson", hit_lines), ("hits", csv)] {
            let out = folder.path(out);
            let run = stackless("trace --rays", &[&rays, Path::new("-o"), &out, &mesh]).passes();
            assert_eq!(std::fs::read_to_string(&out).unwrap(), expected, "{name}");
            assert!(run.stdout.starts_with("mesh: 2 rays, 1 hit, by "), "{run:?}");
            assert!(run.stdout.contains("1 of 2 triangles has no area: rays miss it"), "{run:?}");
        }
        let out = folder.path("hits.npy");
        stackless("trace --method hashed --rays", &[&rays, Path::new("-o"), &out, &mesh]).passes();
        assert!(std::fs::read(&out).unwrap().starts_with(b"\x93NUMPY\x01\x00"));
    }
    let rays = folder.file("more", lines);
    let run = stackless("trace soup --format jsonl -o - --rays", &[&rays]);
    assert!(run.stdout.starts_with("{\"prim\":"), "{run:?}");
    for bad in ["hits.parquet", "hits.jpg"] {
        let bad = folder.path(bad);
        let run = stackless("trace soup --format csv --rays", &[&rays, Path::new("-o"), &bad]);
        run.fails_naming(&["extension", "expected csv, jsonl or npy"]);
    }
}

/// Triangles of a tenth of a metre, as far from the origin as the earth's surface from its centre. Single precision has
/// steps of half a metre there.
#[test]
fn doubles_are_traced_as_they_are() {
    let folder = Folder::new();
    let mut header = "ply\nformat ascii 1.0\nelement vertex 300\n".to_owned();
    for axis in ["x", "y", "z"] {
        writeln!(header, "property double {axis}").unwrap();
    }
    header += "element face 100\nproperty list uchar int vertex_indices\nend_header\n";
    let corners = |i: usize| {
        let [a, b] = [6_378_137.0 + 0.1 * i as f64, 0.03 * (i % 7) as f64];
        [[a, b, b], [a + 0.1, b, -b], [a, b + 0.1, 1.0 / 3.0]].map(DVec3::from)
    };
    let vertices: Vec<DVec3> = (0..100).flat_map(corners).collect();
    let triangles: Vec<[u32; 3]> = (0..100).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    let lines = vertices.iter().map(|v| format!("{:?} {:?} {:?}\n", v.x, v.y, v.z));
    let faces = triangles.iter().map(|[a, b, c]| format!("3 {a} {b} {c}\n"));
    let scene = folder.file("far.ply", lines.chain(faces).fold(header, |text, line| text + &line));
    // Through corners and inner points, from the side.
    let rays: Vec<_> = (0..300)
        .map(|i| {
            let [a, b, c] = corners(i / 3);
            let at = [a, (a + b) * 0.5, (a + b + c) / 3.0][i % 3];
            Ray::new(at + DVec3::new(0.3, 0.1, -5.0), DVec3::new(-0.3, -0.1, 5.0)).unwrap()
        })
        .collect();
    let text = rays.iter().fold(String::new(), |text, ray| {
        let (o, d) = (ray.origin(), ray.direction());
        text + &format!("{:?},{:?},{:?},{:?},{:?},{:?}\n", o.x, o.y, o.z, d.x, d.y, d.z)
    });
    let rays_file = folder.file("rays.csv", text);
    let truth = Truth::new(&Mesh::new(vertices, triangles).unwrap());
    let expected = rays.iter().map(|ray| match truth.closest(ray).map(|hit| hit.rounded()) {
        Some(Hit { prim, t, u, v }) => format!("{prim},{t:?},{u:?},{v:?}\n"),
        None => "-1,,,\n".to_owned(),
    });
    let expected: String = std::iter::once("prim,t,u,v\n".to_owned()).chain(expected).collect();
    assert!(expected.lines().filter(|line| !line.starts_with("-1")).count() > 99, "{expected}");
    for method in Method::ALL {
        let run = stackless(&format!("trace --method {method} -o - --rays"), &[&rays_file, &scene]);
        assert_eq!((run.code, run.stdout), (Some(0), expected.clone()), "{method}: {}", run.stderr);
    }
    let single = stackless("trace --single -o - --rays", &[&rays_file, &scene]);
    assert!(single.stdout != expected && single.stderr.contains("rounded to single precision"), "{single:?}");
}

/// Two equal triangles as files of all kinds: STL shares its vertices, and a glTF node moves its mesh.
#[test]
fn scenes_are_read_from_stl_and_gltf() {
    let folder = Folder::new();
    let rays = folder.file("rays.csv", "10.25,0.25,-1,0,0,1\n11.75,0.75,-1,0,0,1\n0,0,-1,0,0,1\n");
    let facet = |corners: &str| {
        let vertices = corners.replace(", ", "\nvertex ");
        format!("facet normal 0 0 1\nouter loop\nvertex {vertices}\nendloop\nendfacet\n")
    };
    let facets = [facet("10 0 0, 12 0 0, 10 1 0"), facet("12 0 0, 12 1 0, 10 1 0")].concat();
    let stl = folder.file("mesh.stl", format!("solid\n{facets}endsolid\n"));
    let numbers = [0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0].map(|number| (number as f32).to_le_bytes());
    folder.file("mesh.bin", numbers.concat());
    let document = r#"{"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],
        "nodes":[{"mesh":0,"translation":[10,0,0],"scale":[2,1,1]}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":6,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
        "bufferViews":[{"buffer":0,"byteLength":72}],"buffers":[{"uri":"mesh.bin","byteLength":72}]}"#;
    let gltf = folder.file("mesh.gltf", document);
    for mesh in [stl, gltf] {
        let run = stackless("trace -o - --rays", &[&rays, &mesh]);
        let hits = parse_hits(&run.stdout);
        let seen: Vec<_> = hits.iter().map(|hit| hit.map(|hit| (hit.prim, hit.t))).collect();
        assert_eq!(seen, [Some((0, 1.0)), Some((1, 1.0)), None], "{run:?}");
    }
}
