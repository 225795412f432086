//! `stackless render`: pictures are reproducible, and show the counts.

use std::path::Path;

use super::support::{Folder, Run, stackless};

/// Width, height and pixels of a PNG file, as RGB.
fn read(path: &Path) -> (u32, u32, Vec<[u8; 3]>) {
    let file = std::io::BufReader::new(std::fs::File::open(path).unwrap());
    let mut decoder = png::Decoder::new(file);
    decoder.set_transformations(png::Transformations::EXPAND);
    let mut reader = decoder.read_info().unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut bytes).unwrap();
    assert_eq!(info.color_type, png::ColorType::Rgb);
    (info.width, info.height, bytes.as_chunks::<3>().0.to_vec())
}

fn render(args: &str, folder: &Folder) -> (Run, (u32, u32, Vec<[u8; 3]>)) {
    let path = folder.path("out.png");
    let run = stackless(&format!("render {args} -o"), &[&path]).passes();
    (run, read(&path))
}

/// The numbers of "mean" lines, by panel.
fn means(run: &Run) -> Vec<f64> {
    let number = |line: &str| line.split(": ").nth(2).unwrap().split(' ').next().unwrap().parse().unwrap();
    run.stdout.lines().map(number).collect()
}

#[test]
fn the_same_options_give_the_same_picture() {
    let folder = Folder::new();
    for rays in ["primary", "normals", "ao --spp 3", "diffuse --spp 2", "ao --heatmap boxes --spp 2"] {
        let args = format!("soup --kind {rays} --size 31x17");
        let (_, once) = render(&args, &folder);
        let (_, again) = render(&args, &folder);
        assert_eq!(once, again, "{rays}");
        let distinct: std::collections::BTreeSet<_> = once.2.iter().collect();
        assert!(distinct.len() > 4, "{rays}: {} colours", distinct.len());
        if !rays.contains("heatmap") {
            assert_eq!((once.0, once.1), (31, 17));
        }
    }
}

/// A triangle that fills the right half of the image: normals and misses are known.
#[test]
fn colours_are_those_of_what_is_hit() {
    let folder = Folder::new();
    let half = folder.file("half.obj", "v 0 -9 0\nv 0 9 0\nv 99 0 0\nf 1 2 3\n");
    let path = folder.path("out.png");
    let view = "--view 0,0,5,0,0,0 --size 8 -o";
    for (rays, hit, missed) in [("normals", [128, 128, 255], [0; 3]), ("ao", [255; 3], [230; 3])] {
        let args = format!("render --kind {rays} --spp 1 {view}");
        stackless(&args, &[&path, &half]).passes();
        let (.., pixels) = read(&path);
        assert_eq!((pixels[3], pixels[4]), (missed, hit), "{rays}");
        assert_eq!((pixels[59], pixels[60]), (missed, hit), "{rays}");
    }
    // A face has a constant brightness: more if it faces up, to the lamp, and less if it faces down.
    let turned =
        ["v -99 -9 9\nv 99 -9 9\nv 0 99 -99", "v -99 -9 0\nv 99 -9 0\nv 0 99 0", "v -99 9 9\nv 99 9 9\nv 0 -99 -99"];
    let middles = turned.map(|corners| {
        let mesh = folder.file("turned.obj", format!("{corners}\nf 1 2 3\n"));
        stackless(&format!("render {view}"), &[&path, &mesh]).passes();
        let (.., pixels) = read(&path);
        assert_eq!(pixels[27], pixels[28]);
        pixels[28][0]
    });
    assert!(middles.is_sorted_by(|a, b| a > b) && middles[2] > 20, "{middles:?}");
}

#[test]
fn costs_are_as_the_papers_say() {
    let folder = Folder::new();
    let near = " --view 5,0.5,8,3.5,0.05,5.5";
    let methods = "afra,uncle,hashed";
    let (run, picture) = render(&format!("stadium --heatmap backtrack --method {methods} --size 40{near}"), &folder);
    let [parents, uncles, hashed] = means(&run)[..] else { panic!("{run:?}") };
    assert!(parents > uncles && uncles > hashed && hashed > 1.0, "{run:?}");
    // Three panels with the widths of their labels.
    assert!(picture.0 > 3 * 40 + 4 * 6, "{}", picture.0);

    let (postponed, _) = render(&format!("stadium --heatmap postponed --method hashed,stack --size 40{near}"), &folder);
    assert_eq!(means(&postponed), [hashed, hashed], "one step for each postponed node");
    let (run, _) =
        render(&format!("stadium --heatmap postponed --method hashed,hashed-disjoint --size 40{near}"), &folder);
    let [all, pruned] = means(&run)[..] else { panic!("{run:?}") };
    assert!(all == hashed && pruned < all, "{run:?}");
}

#[test]
fn heat_is_what_the_other_commands_count() {
    let folder = Folder::new();
    let every = "stack,sparse,afra,uncle,hashed,hash-only,implicit-b1,laine-4,skip,hapala,glassner";
    let run = |heat: &str, methods: &str| {
        means(&render(&format!("strands --heatmap {heat} --method {methods} --size 20"), &folder).0)
    };
    // Traversals that take equal children visit equal nodes; traversals with a fixed order visit more.
    let nodes = run("nodes", every);
    assert!(nodes[1..7].iter().all(|&mean| mean == nodes[0]) && nodes[8] > nodes[0], "{nodes:?}");
    assert_eq!(run("boxes", "stack,hashed")[0], run("boxes", "uncle")[0]);
    let hash = run("hash", "hashed,hash-only,afra");
    assert!(hash[0] > 0.0 && hash[0] < hash[1] && hash[2] == 0.0, "{hash:?}");
    assert_eq!(hash[1], run("postponed", "stack")[0]);
    assert!(run("fallback", "hashed")[0] <= run("triangles", "hashed")[0]);
    // Laine's short stack restarts at the root, and Hapala's traversal climbs.
    let steps = run("backtrack", "stack,laine-4,laine-0,hapala,skip");
    assert!(steps[0] < steps[1] && steps[1] < steps[2] && steps[4] < steps[3], "{steps:?}");
}

#[test]
fn bad_options_are_refused() {
    let folder = Folder::new();
    let out = folder.path("out.png");
    for (args, what) in [
        ("--size 0", "each from 1 to 8192"),
        ("--view 1,2,3", "6, 7, 9 or 10 numbers"),
        ("--spp 0", "1..=65536"),
        ("--heatmap nodes --method nobody", "invalid value 'nobody'"),
    ] {
        let run = stackless(&format!("render soup {args} -o"), &[&out]);
        assert!(run.code == Some(2) && run.stderr.contains(what), "{args}: {run:?}");
    }
    stackless("render no-such-scene.ply -o", &[&out]).fails_naming(&["no-such-scene.ply"]);
    let nowhere = folder.path("missing/out.png");
    stackless("render soup --size 2 -o", &[&nowhere]).fails_naming(&["missing", "cannot be written"]);
    assert!(folder.names().is_empty());
}
