//! `stackless contains` and `stackless nearest`: queries for the points of a file.

use std::error::Error;
use std::path::PathBuf;

use clap::builder::{PossibleValue, TypedValueParser};
use glam::{DVec3, Vec3};
use stackless_bvh::bvh::{Builder, WideBvh};
use stackless_bvh::geom::{Ball, Precision, Real as _, Triangle, Vector};
use stackless_bvh::internals::geom::Foot;
use stackless_bvh::internals::geom::truth::Place;
use stackless_bvh::trace::{Boundary, Location, MeshQueries as _, Near, Rule, Solid, Tracer};
use stackless_scene::{Cell, Column, Float, Format, Point, Position, write_table};

use crate::Outcome;
use crate::build;
use crate::input::{self, Scene};
use crate::output::{self, count, say, write_file};
use crate::places::{self, Output};
use crate::trace::in_chunks;

/// Classify points: inside, on or outside a closed mesh.
///
/// A point is a line of x,y,z. The answer is a line with its exact place: inside, surface or outside. JSON lines
/// (.jsonl) have `{"point":[0,0,0]}` and `{"place":"inside"}`. `NumPy` arrays (.npy) have rows of 3 floats, and records
/// of place.
#[derive(clap::Args)]
#[command(
    override_usage = "stackless contains [OPTIONS] --points <FILE>\n       --output <FILE> <SCENE>",
    after_help = "Examples:\n  stackless contains examples/data/torus.ply --points examples/data/points.csv -o places.csv\n  \
    echo 1,0,0 | stackless contains examples/data/torus.ply --points - -o -"
)]
pub(crate) struct Contains {
    #[command(flatten)]
    input: Input,
    /// Rule that decides whether a point is inside.
    #[arg(long, default_value = "parity", value_parser = rule())]
    rule: Rule,
}

/// Find the nearest point of a mesh and its distance.
///
/// A point is a line of x,y,z. The answer is a line of prim,distance,x,y,z,u,v,place. prim is the index of the triangle
/// in the file's order. distance is exact, then rounded once. x,y,z is the nearest point; u and v are the weights of
/// the triangle's second and third corner there. place is interior, edge or vertex of the triangle. Without a triangle
/// within --radius, prim is -1 and the other columns are empty. Files have the formats of `contains`.
#[derive(clap::Args)]
#[command(
    override_usage = "stackless nearest [OPTIONS] --points <FILE>\n       --output <FILE> <SCENE>",
    after_help = "Examples:\n  stackless nearest examples/data/torus.ply --points examples/data/points.csv -o nearest.csv\n  \
    echo 1,0,0 | stackless nearest examples/data/torus.ply --points - -o - --signed parity"
)]
pub(crate) struct Nearest {
    #[command(flatten)]
    input: Input,
    /// Give distances of inside points a minus sign; this rule defines the inside. [default: no signs]
    #[arg(long, value_parser = rule())]
    signed: Option<Rule>,
    /// Maximum distance, rounded like the points. [default: no limit]
    #[arg(long, value_name = "DISTANCE", allow_negative_numbers = true, value_parser = radius)]
    radius: Option<f64>,
    /// Write the index of the face in the file instead of the triangle's index: a polygon is several triangles.
    #[arg(long)]
    faces: bool,
}

/// The input files and the output of both commands.
#[derive(clap::Args)]
struct Input {
    /// Mesh file (.ply, .obj, .stl, .gltf, .glb), or a generated scene: `strands`, `stadium`, `soup`.
    scene: PathBuf,
    /// Read the points from this file (.csv, .jsonl, .npy): x,y,z each. `-` is the standard input.
    #[arg(long, value_name = "FILE")]
    points: PathBuf,
    /// Write the answers to this file (.csv, .jsonl, .npy). `-` is the standard output.
    #[arg(short, long, value_name = "FILE", value_parser = places::file())]
    output: Output,
    /// Format of files without such an extension.
    #[arg(long, default_value_t, value_parser = input::names(Format::ALL, Format::name))]
    format: Format,
    /// Builder of the hierarchy.
    #[arg(long, default_value_t, value_parser = build::builder())]
    build: Builder,
    /// Round mesh and points to single precision. A note reports the number and size of the rounding errors. [default:
    /// double precision]
    #[arg(long)]
    single: bool,
}

impl Contains {
    pub(crate) fn run(&self) -> Outcome {
        if self.input.single { self.answer::<Vec3>() } else { self.answer::<DVec3>() }
    }

    fn answer<V: Precision + Position>(&self) -> Outcome {
        let asked = self.input.read::<V>()?;
        let (tracer, boundary) = (Tracer::new(&asked.bvh), Boundary::of(&asked.scene.mesh));
        let solid = asked.solid(&tracer, &boundary, self.rule)?;
        let places =
            in_chunks(&asked.points, |points| points.iter().map(|&Point(point)| solid.locate(point)).collect());
        let places: Vec<_> = places.into_iter().collect::<Result<_, _>>()?;
        let word = |&place: &Location| match place {
            Location::Inside => "inside",
            Location::Surface => "surface",
            Location::Outside => "outside",
        };
        let rows = || places.iter().map(|place| [Cell::<V::Real>::Word(word(place))]);
        asked.write(&self.input.output, [Column::Word("place", "outside".len())], rows)?;
        let number = |place| places.iter().filter(|&&other| other == place).count();
        let [inside, surface] =
            [Location::Inside, Location::Surface].map(|place| output::grouped(number(place) as u64));
        asked.say(&format!("{inside} inside, {surface} on the surface, by {}", self.rule.name()));
        Ok(true)
    }
}

impl Nearest {
    pub(crate) fn run(&self) -> Outcome {
        if self.input.single { self.answer::<Vec3>() } else { self.answer::<DVec3>() }
    }

    fn answer<V: Precision + Position>(&self) -> Outcome {
        let asked = self.input.read::<V>()?;
        let tracer = Tracer::new(&asked.bvh);
        let signed = self.signed.map(|rule| (rule, Boundary::of(&asked.scene.mesh)));
        let solid = signed.as_ref().map(|(rule, boundary)| asked.solid(&tracer, boundary, *rule)).transpose()?;
        let radius = self.radius.map_or(V::Real::INFINITY, V::Real::rounded);
        let nearest = |&Point(point): &Point<V>| -> Result<Option<Found<V>>, String> {
            let ball = Ball::new(point, radius).map_err(|error| error.to_string())?;
            let Some(mut near) = tracer.nearest(&ball) else { return Ok(None) };
            let triangle = Triangle(asked.scene.mesh.triangle(near.prim as usize));
            let Some(foot) = Foot::of(&triangle, point) else { return Ok(None) };
            if let Some(solid) = &solid {
                near.distance = solid.signed(point, near.distance).map_err(|error| error.to_string())?;
            }
            Ok(Some((near, foot)))
        };
        let found = in_chunks(&asked.points, |points| points.iter().map(nearest).collect());
        let found: Vec<_> = found.into_iter().collect::<Result<_, _>>()?;
        let row = |found: &Option<Found<V>>| {
            let Some((near, foot)) = found else {
                let mut miss = [Cell::Missing; 8];
                miss[0] = Cell::Integer(-1);
                return miss;
            };
            let prim = asked.scene.number(near.prim, self.faces);
            let ([x, y, z], [u, v]) = (near.point.components(), foot.weights);
            let [distance, x, y, z, u, v] = [near.distance, x, y, z, u, v].map(Cell::Number);
            [Cell::Integer(prim.into()), distance, x, y, z, u, v, Cell::Word(word(foot.place))]
        };
        let number = |name| Column::Number(name, f64::NAN);
        let [x, y, z, u, v] = ["x", "y", "z", "u", "v"].map(number);
        let distance = Column::Number("distance", f64::INFINITY);
        let columns = [Column::Integer("prim"), distance, x, y, z, u, v, Column::Word("place", "interior".len())];
        asked.write(&self.input.output, columns, || found.iter().map(row))?;
        asked.say(&format!("{} found", output::grouped(found.iter().flatten().count() as u64)));
        Ok(true)
    }
}

/// The nearest point and its place on the triangle.
type Found<V> = (Near<V>, Foot<<V as Vector>::Real>);

const fn word(place: Place) -> &'static str {
    match place {
        Place::Interior => "interior",
        Place::Edge => "edge",
        Place::Vertex => "vertex",
    }
}

/// The scene, its hierarchy, and the points.
struct Asked<V: Precision + Position> {
    scene: Scene<V>,
    bvh: WideBvh<8, V>,
    points: Vec<Point<V>>,
    written_as: Format,
}

impl Input {
    fn read<V: Precision + Position>(&self) -> Result<Asked<V>, Box<dyn Error>> {
        let written_as = input::format_to_write(&self.output, self.format)?;
        let (name, points) = input::rows::<Point<V>>(&self.points, input::format(&self.points, self.format)?)?;
        let scene = Scene::load(&self.scene)?;
        if let Some(note) = points.note(name, stackless_scene::size(&scene.mesh)) {
            output::warn(&note);
        }
        let bvh = build::wide_for_points(self.build, &scene)?;
        Ok(Asked { scene, bvh, points: points.rows, written_as })
    }
}

impl<V: Precision + Position> Asked<V> {
    fn write<const N: usize, I: ExactSizeIterator<Item = [Cell<V::Real>; N]>>(
        &self,
        output: &Output,
        columns: [Column; N],
        rows: impl Fn() -> I,
    ) -> Result<(), Box<dyn Error>> {
        Ok(write_file(output, |file| write_table(file, columns, rows(), self.written_as))?)
    }

    /// Returns the solid by a rule. Warns of repeated faces, which cancel out by parity.
    fn solid<'s>(
        &'s self,
        tracer: &'s Tracer<&'s WideBvh<8, V>, V>,
        boundary: &'s Boundary,
        rule: Rule,
    ) -> Result<Solid<'s, Tracer<&'s WideBvh<8, V>, V>, V>, String> {
        if rule == Rule::Parity && boundary.repeated > 0 {
            let repeated = count(boundary.repeated as u64, "face");
            output::warn(&format!(
                "{}: {repeated} repeated: by parity they cancel out; with rule `nonzero` they do not",
                self.scene.name
            ));
        }
        Solid::new(tracer, &self.scene.mesh, boundary, rule).map_err(|error| format!("{}: {error}", self.scene.name))
    }

    fn say(&self, answers: &str) {
        let precision = <V::Real as Float>::PRECISION;
        say!("{}: {}, {answers}, in {precision} precision", self.scene.name, count(self.points.len() as u64, "point"));
    }
}

fn rule() -> impl TypedValueParser<Value = Rule> {
    let help = |rule| match rule {
        Rule::Parity => "odd numbers of crossings are inside: overlapping parts cancel out",
        Rule::Nonzero => "winding numbers other than 0 are inside: overlapping parts unite",
        Rule::Winding => "winding numbers above 1/2 are inside: a good guess for open meshes",
    };
    input::listed(Rule::ALL.map(|rule| (PossibleValue::new(rule.name()).help(help(rule)), rule)).into())
}

fn radius(word: &str) -> Result<f64, String> {
    let radius = word.parse().map_err(|_| "expected a number")?;
    if radius >= 0.0 { Ok(radius) } else { Err("expected a number that is not negative".to_owned()) }
}
