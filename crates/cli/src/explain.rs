//! `stackless explain`: a traversal step by step, as a page for the browser.

use std::path::PathBuf;

use stackless_bvh::bvh::Builder;
use stackless_bvh::geom::Ray;
use stackless_bvh::traverse::Method;
use stackless_bvh::wide::Method as WideMethod;
use stackless_check::{Case, CaseOptions, Replay, WideCase};
use stackless_explain::{self as explain, USUAL, wide};
use stackless_suite::{Ask, Suite, Traversal, WideWalk};

use crate::build;
use crate::input::{self, Scene};
use crate::output::{say, write_file};
use crate::places::{self, Output};
use crate::{Outcome, camera};

/// Write a page that steps through traversals: the tree, the bits, the lookups, and the oracle's stack.
///
/// The page is one HTML file and needs no network. Without a case it shows the papers' example, backtracking from key
/// 22 with trail 1000 to key 3; for wide trees, an example with eight children. Arrow keys step, Home and End go to the
/// ends, digits choose the traversal, space plays, + and - zoom, 0 shows the whole tree. A clause's id opens the
/// clause. `FILE.html#method=hashed&step=6` is a link to a step.
#[derive(clap::Args)]
#[command(after_help = "Examples:\n  stackless explain -o example.html\n  \
    stackless explain examples/data/torus.ply --pixel 256,340 --method wide-record -o ray.html\n  \
    stackless explain --suite-case trace/script/three-neither -o - > case.html")]
pub(crate) struct Args {
    #[command(flatten)]
    shown: Shown,
    /// Write the page to this .html file; `-` is the standard output.
    #[arg(short, long, value_name = "FILE", value_parser = places::file_as("html"))]
    output: Output,
}

/// A case and its traversals.
#[derive(clap::Args)]
pub(crate) struct Shown {
    /// Mesh file (.ply, .obj, .stl, .gltf, .glb), or a generated scene: show the ray through a pixel. Needs --pixel.
    #[arg(group = "what", requires = "pixel")]
    scene: Option<PathBuf>,
    /// Pixel of the ray, counted from the upper left corner.
    #[arg(long, value_name = "X,Y", value_parser = pixel, requires = "scene")]
    pixel: Option<[u32; 2]>,
    #[command(flatten)]
    camera: camera::Options,
    /// Builder of the scene's hierarchy.
    #[arg(long, default_value_t, value_parser = build::builder())]
    build: Builder,
    /// Use wide trees instead of binary trees, with 2, 4 or 8 children per node. [default: 8 if --method is a wide
    /// traversal]
    #[arg(long, value_name = "CHILDREN", value_parser = clap::value_parser!(u32), conflicts_with_all = ["file", "suite_case"])]
    wide: Option<u32>,
    /// Show a case that `stackless check` printed.
    #[arg(long = "case", value_name = "FILE", group = "what")]
    file: Option<PathBuf>,
    /// Show a case of the conformance suite, of the level trace, with a binary or a wide tree.
    #[arg(long, value_name = "ID", group = "what")]
    suite_case: Option<String>,
    /// Show only these traversals, separated by commas, of binary or of wide trees (`stackless methods` lists them).
    /// The page opens with the first.
    #[arg(long, value_delimiter = ',', value_parser = input::traversal(), hide_possible_values = true)]
    method: Vec<Traversal>,
}

/// Parts of a case that `lab debug` prints.
#[derive(Clone, Copy, clap::ValueEnum)]
pub(crate) enum Part {
    /// The tree, one node a line.
    Tree,
    /// The traversals, one visit a line.
    Trace,
}

/// Options of `lab` only.
#[derive(Clone, Copy, Default, clap::Args)]
pub(crate) struct Extra {
    /// Show a random tree with a tape: a sequence of random decisions instead of a ray.
    #[arg(long, value_name = "SEED", group = "what")]
    tape: Option<u64>,
}

pub(crate) fn run(args: &Args, Extra { tape }: Extra) -> Outcome {
    let Page { title, recorded } = page(&args.shown, tape)?;
    let page = recorded.map_err(|error| format!("{title}: {error}"))?;
    let html = page.to_html().map_err(|error| format!("{title}: {error}"))?;
    write_file(&args.output, |file| file.write_all(html.as_bytes()))?;
    say!("{}: {} nodes, {} bytes", args.output.display(), page.nodes(), html.len());
    Ok(true)
}

/// Prints a part of a case as text.
pub(crate) fn debug(part: Part, shown: &Shown, Extra { tape }: Extra) -> Outcome {
    let Page { title, recorded } = page(shown, tape)?;
    let page = recorded.map_err(|error| format!("{title}: {error}"))?;
    let text = match part {
        Part::Tree => page.tree(),
        Part::Trace => page.traversals(),
    };
    say!("{title}\n{}", text.trim_end());
    Ok(true)
}

type Error = Box<dyn std::error::Error>;

struct Page {
    title: String,
    recorded: Result<explain::Page, explain::ExplainError>,
}

fn page(shown: &Shown, tape: Option<u64>) -> Result<Page, Error> {
    let (binary, wide) = Traversal::of_each_kind(&shown.method);
    let ask = shown.suite_case.as_deref().map(suite_case).transpose()?;
    let is_wide = !wide.is_empty() || shown.wide.is_some() || matches!(ask, Some(Ask::TraceWide(_)));
    match (is_wide, ask) {
        (true, _) if !binary.is_empty() => Err("--method: traversals of binary trees do not run on wide trees".into()),
        (true, Some(Ask::TraceWide(walk))) => of_walk(shown, &walk, &wide),
        (true, Some(_)) => Err("--suite-case: its tree is binary, expected traversals of binary trees".into()),
        (true, None) => wide_page(shown, tape, &wide),
        (false, ask) => binary_page(shown, tape, ask, &binary),
    }
}

fn binary_page(shown: &Shown, tape: Option<u64>, ask: Option<Ask>, methods: &[Method]) -> Result<Page, Error> {
    let (title, case, named) = load(shown, tape, ask)?;
    let methods = match (methods, &named[..]) {
        ([], []) => &USUAL[..],
        ([], named) => named,
        (methods, _) => methods,
    };
    Ok(Page { recorded: explain::page(&title, &case, methods), title })
}

/// Loads the case with its title and the traversals that it names.
fn load(shown: &Shown, tape: Option<u64>, ask: Option<Ask>) -> Result<(String, Case, Vec<Method>), Error> {
    if let Some((scene, ray, title)) = pixel_ray(shown)? {
        return Ok((title, explain::of_ray(&build::binary(shown.build, &scene)?, &ray), Vec::new()));
    }
    if let Some(path) = &shown.file {
        let named = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
        let replay = Replay::load(path).map_err(|error| named(&error))?;
        let case = replay.case().map_err(|error| named(&error))?;
        let methods = if replay.methods.is_empty() { Vec::new() } else { replay.methods().map_err(|e| named(&e))? };
        let name = path.file_name().map_or_else(|| path.display().to_string(), |name| name.to_string_lossy().into());
        return Ok((format!("Case {name}"), case, methods));
    }
    if let Some(seed) = tape {
        return Ok((format!("Tape {seed}"), Case::random(seed, CaseOptions::default()), Vec::new()));
    }
    if let (Some(id), Some(ask)) = (&shown.suite_case, ask) {
        let case = match ask {
            Ask::Trace(walk) => walk.case().map_err(|error| error.to_string()),
            _ => Err("expected a case of the level trace".to_owned()),
        };
        let case = case.map_err(|error| format!("case '{id}': {error}"))?;
        return Ok((format!("Suite case {id}"), case, Vec::new()));
    }
    Ok(("The papers' example: from key 22 to key 3".to_owned(), explain::example(), Vec::new()))
}

fn wide_page(shown: &Shown, tape: Option<u64>, methods: &[WideMethod]) -> Result<Page, Error> {
    if shown.file.is_some() {
        return Err("--case: its tree is binary, expected traversals of binary trees".into());
    }
    let children = shown.wide.unwrap_or(8);
    if let (None, Some(seed)) = (&shown.scene, tape) {
        let title = format!("Tape {seed}, up to {children} children");
        return match children {
            2 => Ok(of_case(title, &wide::random::<2>(seed), methods)),
            4 => Ok(of_case(title, &wide::random::<4>(seed), methods)),
            8 => Ok(of_case(title, &wide::random::<8>(seed), methods)),
            _ => Err(format!("--wide {children}: expected 2, 4 or 8").into()),
        };
    }
    if children != 8 {
        return Err(
            format!("--wide {children}: scenes and the example have 8 children a node; tapes have 2, 4 or 8").into()
        );
    }
    if let Some((scene, ray, title)) = pixel_ray(shown)? {
        return Ok(of_case(title, &wide::of_ray(&build::wide(shown.build, &scene)?, &ray), methods));
    }
    Ok(of_case("Eight children: from key 1252 to key 10".to_owned(), &wide::example(), methods))
}

fn of_case<const A: usize>(title: String, case: &WideCase<A>, methods: &[WideMethod]) -> Page {
    let methods = if methods.is_empty() { &wide::USUAL } else { methods };
    let recorded = if case.is_sorted {
        wide::page(&title, &case.tree, &case.search::<true>(), methods)
    } else {
        wide::page(&title, &case.tree, &case.search::<false>(), methods)
    };
    Page { title, recorded }
}

fn of_walk(shown: &Shown, walk: &WideWalk, methods: &[WideMethod]) -> Result<Page, Error> {
    let id = shown.suite_case.as_deref().unwrap_or_default();
    let page = match walk.slots {
        2 => of_walk_of::<2>(id, walk, methods),
        4 => of_walk_of::<4>(id, walk, methods),
        _ => of_walk_of::<8>(id, walk, methods),
    };
    page.map_err(|error| format!("case '{id}': {error}").into())
}

fn of_walk_of<const A: usize>(id: &str, walk: &WideWalk, methods: &[WideMethod]) -> Result<Page, String> {
    let methods = if methods.is_empty() { &wide::USUAL } else { methods };
    let (title, tree) = (format!("Suite case {id}"), walk.tree::<A>().map_err(|error| error.to_string())?);
    let unfit = "its ranks do not fit its tree";
    let recorded = if walk.is_sorted() {
        wide::page(&title, &tree, &walk.search::<A, true>().ok_or(unfit)?, methods)
    } else {
        wide::page(&title, &tree, &walk.search::<A, false>().ok_or(unfit)?, methods)
    };
    Ok(Page { title, recorded })
}

/// The scene with its ray and a title, if a scene is given.
fn pixel_ray(shown: &Shown) -> Result<Option<(Scene, Ray, String)>, Error> {
    let (Some(path), Some([x, y])) = (&shown.scene, shown.pixel) else { return Ok(None) };
    let scene = Scene::load(path)?;
    let camera::Size { width, height } = shown.camera.size;
    if x >= width || y >= height {
        return Err(format!("pixel {x},{y} is outside the image of {width}x{height} pixels").into());
    }
    let pixel = y as usize * width as usize + x as usize;
    let ray = shown.camera.of(&scene).ray(pixel, [0.5; 2]).ok_or("the camera is too far away for a ray")?;
    let title = format!("{}, pixel {x},{y}", scene.name);
    Ok(Some((scene, ray, title)))
}

fn pixel(text: &str) -> Result<[u32; 2], String> {
    let number = |text: &str| text.trim().parse().ok();
    let both = text.split_once(',').and_then(|(x, y)| Some([number(x)?, number(y)?]));
    both.ok_or_else(|| "expected two numbers: X,Y".to_owned())
}

fn suite_case(id: &str) -> Result<Ask, String> {
    let suite = Suite::shipped().map_err(|error| error.to_string())?;
    let named = |error: &dyn std::fmt::Display| format!("case '{id}': {error}");
    let found = suite.cases().find(|(_, case)| case.id == id);
    let (_, case) = found.ok_or_else(|| named(&"not in the suite (`stackless suite show`)"))?;
    let ask = serde_json::Value::Object(case.input.clone());
    serde_json::from_value(ask).map_err(|error| named(&error))
}
