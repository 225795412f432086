//! `stackless report`: everything that can be measured of scenes, on one page.

mod page;
mod provenance;

use std::path::{Path, PathBuf};
use std::{fs, io};

use stackless_bvh::bvh::Bvh;
use stackless_bvh::traverse::Method;

use crate::build::{Build, BuildName};
use crate::camera::{self, Camera};
use crate::input::{self, Scene};
use crate::output::{Block, Table, grouped, say, table, write_file};
use crate::places::{self, Output};
use crate::render::{Drawn, Figure, Job};
use crate::stats::Stats;
use crate::{Outcome, accuracy, bench};
pub(crate) use page::Bar;
use page::{Piece, Section};

/// Measure scenes and write one page with all tables and pictures, and each table beside it as CSV.
///
/// The counterparts of Tables 1 and 2 and Figs. 1, 3, 7 and 8 of Binder & Keller 2016 and of Table 1 and Fig. 5 of
/// Barringer & Akenine-Möller 2013; run time against error; what each scene does not need. The page, index.html, needs
/// nothing else. The exit code is 1 if exact answers differ.
#[derive(clap::Args)]
#[command(after_help = "Examples:\n  stackless report examples/data/torus.ply examples/data/slivers.ply -o report\n  \
    stackless report strands --count 4096 --rounds 1 -o quick")]
pub(crate) struct Args {
    /// Mesh files (.ply, .obj, .stl, .gltf, .glb), or the made scenes `strands`, `stadium`, `soup`.
    #[arg(required = true)]
    scenes: Vec<PathBuf>,
    /// The folder, which is made where it is missing. What an earlier report has left there is replaced: tables that
    /// its page names, and this one does not, are removed.
    #[arg(short, long, value_name = "DIR", value_parser = places::folder)]
    output: Output,
    /// How the hierarchies are built; with `+N` behind a name, N rounds of reinsertion follow.
    #[arg(long, default_value_t, value_parser = BuildName)]
    build: Build,
    /// Rays of each kind.
    #[arg(long, default_value_t = 65_536, value_parser = clap::value_parser!(u32).range(1..=1 << 28))]
    count: u32,
    /// How often all rays are timed.
    #[arg(long, default_value_t = 5, value_parser = clap::value_parser!(u32).range(1..=1000))]
    rounds: u32,
    /// Width and height of each heat map.
    #[arg(long, default_value_t = 256, value_parser = clap::value_parser!(u32).range(1..=2048))]
    pixels: u32,
    #[command(flatten)]
    place: camera::Place,
    /// Seed of the rays.
    #[arg(long, default_value_t = 1)]
    seed: u64,
}

/// The traversals of both papers' tables.
const METHODS: [Method; 15] = [
    Method::Stack,
    Method::Sparse,
    Method::ImplicitA,
    Method::ImplicitB,
    Method::ImplicitB1,
    Method::Hapala,
    Method::Laine0,
    Method::Laine1,
    Method::Laine2,
    Method::Laine4,
    Method::Laine8,
    Method::Afra,
    Method::Uncle,
    Method::HashOnly,
    Method::Hashed,
];

pub(crate) fn run(args: &Args) -> Outcome {
    let scenes = input::scenes(&args.scenes)?;
    // A place that cannot be written to is known before hours of work.
    fs::create_dir_all(&*args.output).map_err(|error| format!("{}: {error}", args.output.display()))?;
    let measured: Result<Vec<_>, _> = scenes
        .iter()
        .map(|scene| Stats::of(scene, &args.place.of(scene), args.build, args.count as usize, args.seed))
        .collect();
    let (stats, hierarchies): (Vec<_>, Vec<_>) = measured?.into_iter().unzip();
    let (traversals, mut offences) = traversals(args, &scenes)?;
    let (errors, more) = errors(args, &scenes)?;
    offences.extend(more);
    let mut sections = vec![overview(&stats), traversals, errors];
    for ((scene, stats), bvh) in scenes.iter().zip(&stats).zip(&hierarchies) {
        sections.push(details(args, scene, stats, bvh)?);
    }
    if !offences.is_empty() {
        let pieces = offences.iter().cloned().map(Piece::line).collect();
        sections.insert(0, Section { scene: None, title: "Exact answers that differ".to_owned(), pieces });
    }
    let tables = page::tables(&sections);
    for (name, csv) in &tables {
        write_file(&args.output.join(name), |file| file.write_all(csv.as_bytes()))?;
    }
    let path = args.output.join("index.html");
    let removed = remove_old_tables(&path, &tables)?;
    let asked = format!(
        "{} rays of each kind, {} rounds, {} trees, seed {}",
        grouped(args.count.into()),
        args.rounds,
        args.build,
        args.seed
    );
    let about = [
        ("Command", provenance::command_line(std::env::args())),
        ("Version", provenance::version()),
        ("Machine", provenance::machine()),
        ("Date", provenance::date()),
        ("Measured with", asked),
        ("Tables", "as CSV beside this file".to_owned()),
    ];
    write_file(&path, |file| file.write_all(page::html(&about, &sections).as_bytes()))?;
    say!("{}: {} scenes; {} tables beside it", path.display(), scenes.len(), tables.len());
    if removed > 0 {
        say!("{removed} tables of an earlier report are removed");
    }
    for offence in &offences {
        say!("{offence}");
    }
    Ok(offences.is_empty())
}

/// Removes the tables that an earlier page names and this one does not, and counts them.
fn remove_old_tables(page: &Path, tables: &[(String, String)]) -> Result<usize, String> {
    let mut removed = 0;
    for name in page::tables_of(&fs::read_to_string(page).unwrap_or_default()) {
        if tables.iter().any(|(written, _)| *written == name) {
            continue;
        }
        let path = page.with_file_name(name);
        match fs::remove_file(&path) {
            Ok(()) => removed += 1,
            Err(error) if error.kind() == io::ErrorKind::NotFound => (),
            Err(error) => return Err(format!("{}: {error}", path.display())),
        }
    }
    Ok(removed)
}

/// Table 1.
fn overview(stats: &[Stats]) -> Section {
    let header = [
        "scene",
        "triangles",
        "nodes",
        "depth",
        "tree MB",
        "hash MB",
        "of tree",
        "tree ms",
        "hash ms",
        "hash ms, all threads",
    ];
    let rows = stats.iter().map(Stats::cells).collect();
    Section {
        scene: None,
        title: "Scenes, their trees and hash tables".to_owned(),
        pieces: vec![
            Piece::line(
                "Binder & Keller 2016, Table 1. The hash table holds the keys that no record names; it is built on one thread, and on all.",
            ),
            Piece::Table("scenes", table(&header, 1, rows)),
        ],
    }
}

/// Table 2 and the other paper's Table 1. And which exact answers differ.
fn traversals(args: &Args, scenes: &[Scene]) -> Result<(Section, Vec<String>), Box<dyn std::error::Error>> {
    let asked = bench::Args::of(&METHODS, args.build, args.place.clone(), args.count, args.rounds, args.seed);
    let bench::Found { rows, notes, offences } = bench::measure(&asked, scenes, |_| ())?;
    let mut pieces = vec![
        Piece::line(
            "Binder & Keller 2016, Table 2; Barringer & Akenine-Möller 2013, Table 1. One thread; ratios are of the time of stack to \
             that of the traversal, above 1 is faster; geometric means over the scenes. State is in bytes, for one ray.",
        ),
        Piece::Table("traversal-means", bench::means(&rows)),
        Piece::Table("traversals", bench::of_scene(&rows)),
    ];
    pieces.extend(notes.into_iter().map(Piece::line));
    Ok((Section { scene: None, title: "Traversals".to_owned(), pieces }, offences))
}

fn errors(args: &Args, scenes: &[Scene]) -> Result<(Section, Vec<String>), Box<dyn std::error::Error>> {
    let found =
        accuracy::measure(&accuracy::Args::of(args.place.clone(), args.count, args.rounds.min(3), args.seed), scenes)?;
    let mut pieces = vec![
        Piece::line("Every triangle test with every box test: the lines join those that nobody beats in both."),
        Piece::Svg(found.plot(), "Run time against the rate of errors".to_owned()),
    ];
    pieces.extend(named(found.blocks(), &["errors-ordinary", "errors-adversarial", "levels", "stages"]));
    let offences = found.offences().cloned().collect();
    Ok((Section { scene: None, title: "Run time against error".to_owned(), pieces }, offences))
}

/// One scene: where backtracking goes, what it costs, where the time goes, what is not needed.
fn details(args: &Args, scene: &Scene, stats: &Stats, bvh: &Bvh) -> Result<Section, Box<dyn std::error::Error>> {
    let title = format!("{}: where backtracking goes, where time goes, what is not needed", scene.name);
    let mut pieces = Vec::new();
    for (figure, about) in [
        (Figure::Schemes, "Backtracking along parents and siblings, along uncles, and by a hash (Fig. 1)"),
        (Figure::Pruning, "Postponed nodes that are visited, without and with the disjoint mask (Fig. 7)"),
        (Figure::Continuing, "Nodes that diffuse rays visit, from the root and from the node of the last hit (Fig. 8)"),
    ] {
        let job = Job::figure(figure, Camera::square(args.place.of(scene), args.pixels), args.seed);
        let Drawn { png, lines } = job.draw(scene, bvh)?;
        pieces.push(Piece::Png(png, about.to_owned()));
        pieces.extend(lines.into_iter().map(Piece::line));
    }
    pieces.push(Piece::Svg(stats.plot(), "How far backtracking goes (Fig. 3)".to_owned()));
    pieces.push(Piece::Bars(
        stats.parts(),
        "Where the time of a diffuse ray goes (Barringer & Akenine-Möller 2013, Fig. 5)".to_owned(),
    ));
    pieces.extend(named(stats.blocks(), &["tables", "time", "plan", "state", "wide", "tracers", "distances"]));
    Ok(Section { scene: Some(scene.name.clone()), title, pieces })
}

/// Lines and tables, the tables with their names in order.
fn named(blocks: Vec<Block>, names: &[&'static str]) -> Vec<Piece> {
    let mut names = names.iter();
    let piece = |block| match block {
        Block::Line(line) => Piece::Line(line),
        Block::Table(table) => Piece::Table(names.next().copied().unwrap_or("more"), table),
    };
    blocks.into_iter().map(piece).collect()
}
