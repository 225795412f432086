//! `stackless explain`: a traversal step by step, as a page for the browser.

use std::path::PathBuf;

use stackless_bvh::traverse::Method;
use stackless_check::{Case, CaseOptions, Replay};
use stackless_cli::explain::{self, USUAL};
use stackless_suite::{Ask, author};

use crate::build::Build;
use crate::input::{self, Scene};
use crate::output::{say, write_file};
use crate::places::{self, Output};
use crate::{Outcome, camera};

/// Write a page that steps through traversals: the tree, the bits, the lookups, and the oracle's stack beside them.
///
/// One HTML file that needs nothing else and no network. Without a case it shows the papers' example, backtracking from
/// key 22 with trail 1000 to key 3. Arrow keys step, Home and End go to the ends, digits choose the traversal, space
/// plays; `FILE.html#method=hashed&step=6` is a link to a step.
#[derive(clap::Args)]
#[command(after_help = "Examples:\n  stackless explain -o example.html\n  \
    stackless explain --tape 7 --methods hashed,sparse -o tape.html\n  \
    stackless explain --suite-case trace/script/three-neither -o - > case.html")]
pub(crate) struct Args {
    /// Mesh file (.ply, .obj), or a made scene: what the ray through a pixel does in it.
    #[arg(group = "what", requires = "pixel")]
    scene: Option<PathBuf>,
    /// The pixel, from the upper left.
    #[arg(long, value_name = "X,Y", value_parser = pixel, requires = "scene")]
    pixel: Option<[u32; 2]>,
    #[command(flatten)]
    camera: camera::Options,
    /// How the scene's hierarchy is built, as in `stackless trace`.
    #[arg(long, default_value_t)]
    build: Build,
    /// A case as `stackless check` prints it.
    #[arg(long = "case", value_name = "FILE", group = "what")]
    file: Option<PathBuf>,
    /// A random tree with a random search.
    #[arg(long, value_name = "SEED", group = "what")]
    tape: Option<u64>,
    /// A case of the conformance suite whose level is trace.
    #[arg(long, value_name = "ID", group = "what")]
    suite_case: Option<String>,
    /// Only these traversals, separated by commas; the page opens with the first.
    #[arg(long, value_delimiter = ',', value_parser = input::MethodName)]
    methods: Vec<Method>,
    /// The page; `-` is the standard output.
    #[arg(short, long, value_name = "FILE.html", value_parser = places::file)]
    output: Output,
}

pub(crate) fn run(args: &Args) -> Outcome {
    let (title, case, named) = load(args)?;
    let methods = match (&args.methods[..], &named[..]) {
        ([], []) => &USUAL[..],
        ([], named) => named,
        (methods, _) => methods,
    };
    let html = explain::page(&title, &case, methods).map_err(|error| format!("{title}: {error}"))?;
    write_file(&args.output, |file| file.write_all(html.as_bytes()))?;
    say!("{}: {} nodes, {} bytes", args.output.display(), case.size(), html.len());
    Ok(true)
}

/// The case with its title, and the traversals that it names.
fn load(args: &Args) -> Result<(String, Case, Vec<Method>), Box<dyn std::error::Error>> {
    if let (Some(path), Some([x, y])) = (&args.scene, args.pixel) {
        let scene = Scene::load(path)?;
        let camera::Size { width, height } = args.camera.size;
        if x >= width || y >= height {
            return Err(format!("pixel {x},{y} is outside of the image of {width}x{height} pixels").into());
        }
        let pixel = y as usize * width as usize + x as usize;
        let ray = args.camera.of(&scene).ray(pixel, [0.5; 2]).ok_or("the camera is too far away for a ray")?;
        let bvh = args.build.run(&scene)?;
        return Ok((format!("{}, pixel {x},{y}", scene.name), explain::of_ray(&bvh, &ray), Vec::new()));
    }
    if let Some(path) = &args.file {
        let named = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
        let replay = Replay::load(path).map_err(|error| named(&error))?;
        let case = replay.case().map_err(|error| named(&error))?;
        let methods = if replay.methods.is_empty() { Vec::new() } else { replay.methods().map_err(|e| named(&e))? };
        let name = path.file_name().map_or_else(|| path.display().to_string(), |name| name.to_string_lossy().into());
        return Ok((format!("Case {name}"), case, methods));
    }
    if let Some(seed) = args.tape {
        return Ok((format!("Tape {seed}"), Case::random(seed, CaseOptions::default()), Vec::new()));
    }
    if let Some(id) = &args.suite_case {
        let case = suite_case(id).map_err(|error| format!("case '{id}': {error}"))?;
        return Ok((format!("Suite case {id}"), case, Vec::new()));
    }
    Ok(("The papers' example: from key 22 to key 3".to_owned(), explain::example(), Vec::new()))
}

fn pixel(text: &str) -> Result<[u32; 2], String> {
    let number = |text: &str| text.trim().parse().ok();
    let both = text.split_once(',').and_then(|(x, y)| Some([number(x)?, number(y)?]));
    both.ok_or_else(|| "expected two numbers: X,Y".to_owned())
}

fn suite_case(id: &str) -> Result<Case, String> {
    let suite = author::suite();
    let (_, case) = suite.cases().find(|(_, case)| case.id == id).ok_or("not in the suite (`stackless suite show`)")?;
    let ask = serde_json::Value::Object(case.input.clone());
    match serde_json::from_value(ask).map_err(|error| error.to_string())? {
        Ask::Trace(walk) => walk.case().map_err(|error| error.to_string()),
        _ => Err("expected one whose level is trace".to_owned()),
    }
}
