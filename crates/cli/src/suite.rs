//! `stackless suite`: lists, exports and answers the conformance suite.

#[cfg(feature = "peers")]
mod peer;

use std::io::{self, BufReader, stdin};
use std::path::{Path, PathBuf};

use clap::Subcommand;
use stackless_bvh::internals::trace::Accuracy;
use stackless_bvh::traverse::WordName;
use stackless_suite::{Feature, Implementation, Level, Library, Suite, Traversal, VERSION, serve};

use crate::conform::{load, select};
use crate::output::{grouped, say, stdout, table, write_file};
use crate::places::{self, Output};
use crate::{Outcome, input};

/// List, print or export the conformance suite, or answer it with this library.
#[derive(clap::Args)]
#[command(after_help = "Examples:\n  \
    stackless suite list\n  \
    stackless suite show --filter 'trace/script/three-*'\n  \
    stackless suite export --level key -o suite\n  \
    stackless suite serve --method afra --word u64\n  \
    stackless suite serve --method wide-record")]
pub(crate) struct Args {
    #[command(subcommand)]
    what: What,
}

#[derive(Subcommand)]
enum What {
    /// List the profiles and their numbers of cases.
    List(Chosen),
    /// Write the cases as files, for use without a runner.
    Export {
        #[command(flatten)]
        chosen: Chosen,
        /// Output folder, for `vectors/LEVEL/PROFILE.json`, `index.json` and `VERSION`.
        #[arg(short, long, value_name = "DIR", value_parser = places::folder())]
        output: Output,
    },
    /// Print cases, one JSON object per line.
    Show(Chosen),
    /// Answer the cases with this library: an implementation for `stackless conform`.
    Serve {
        /// Traversal, of binary or of wide trees. [default: a suitable one for each profile]
        #[arg(long, value_parser = input::traversal())]
        method: Option<Traversal>,
        /// Word of keys and trails.
        #[arg(long, value_parser = input::names(WordName::ALL, WordName::name))]
        word: Option<WordName>,
        /// Accuracy of triangle and box tests. Only exact tests conform.
        #[arg(long, default_value_t = Accuracy::Exact, value_parser = input::accuracy())]
        accuracy: Accuracy,
        /// Answer rays with another ray tracer.
        #[cfg(feature = "peers")]
        #[arg(long, conflicts_with_all = ["method", "word", "accuracy"], value_parser = peer::named)]
        peer: Option<stackless_peers::Peer>,
    },
}

/// The selection of cases.
#[derive(clap::Args)]
struct Chosen {
    /// Read the suite from a folder like spec/suite. [default: the built-in suite]
    #[arg(long)]
    suite: Option<PathBuf>,
    /// Select only cases of this level.
    #[arg(long, value_parser = input::names(Level::ALL, Level::name))]
    level: Option<Level>,
    /// Select only cases whose id matches; `*` is any text, `?` any character. Repeat the option for several patterns.
    #[arg(long)]
    filter: Vec<String>,
    /// Select only cases that need no other features. [default: all cases]
    #[arg(long, value_delimiter = ',', value_parser = input::names(Feature::ALL, Feature::name))]
    features: Option<Vec<Feature>>,
}

pub(crate) fn run(args: &Args) -> Outcome {
    match &args.what {
        What::List(chosen) => list(&chosen.load()?),
        What::Export { chosen, output } => export(&chosen.load()?, output)?,
        What::Show(chosen) => {
            for (_, case) in chosen.load()?.cases() {
                say!("{}", serde_json::to_string(case)?);
            }
        }
        #[cfg(feature = "peers")]
        What::Serve { peer: Some(peer), .. } => {
            answer(&mut peer::Foreign(*peer))?;
        }
        What::Serve { method: Some(Traversal::Wide(method)), word: Some(_), .. } => {
            return Err(format!("--word: {method} has a fixed word").into());
        }
        What::Serve { method, word, accuracy, .. } => {
            answer(&mut Library::new(*method, *word).with_accuracy(*accuracy))?;
        }
    }
    Ok(true)
}

/// Answers until the input ends or the output is closed.
fn answer(implementation: &mut impl Implementation) -> io::Result<()> {
    match serve(implementation, BufReader::new(stdin()), stdout()?) {
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        served => served,
    }
}

impl Chosen {
    fn load(&self) -> Result<Suite, Box<dyn std::error::Error>> {
        let mut suite = load(self.suite.as_deref())?;
        if let Some(features) = &self.features {
            for profile in &mut suite.profiles {
                profile.cases.retain(|case| case.features.iter().all(|feature| features.contains(feature)));
            }
        }
        Ok(select(suite, self.level, &self.filter)?)
    }
}

fn list(suite: &Suite) {
    let row = |profile: &stackless_suite::Profile| {
        vec![profile.name(), grouped(profile.cases.len() as u64), grouped(profile.to_text().len() as u64)]
    };
    say!("version {VERSION}, {} cases", grouped(suite.cases().count() as u64));
    say!("{}", table(&["profile", "cases", "bytes"], 1, suite.profiles.iter().map(row).collect()));
}

fn export(suite: &Suite, folder: &Path) -> Result<(), String> {
    let files = suite.files();
    for (path, text) in &files {
        let path = folder.join(path);
        if let Some(parent) = path.parent() {
            std::fs::create_dir_all(parent).map_err(|error| format!("{}: {error}", parent.display()))?;
        }
        write_file(&path, |file| file.write_all(text.as_bytes()))?;
    }
    say!("{} cases in {} files", grouped(suite.cases().count() as u64), files.len());
    Ok(())
}
