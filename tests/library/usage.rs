//! The programs of `examples/` run, and their assertions hold.

#[path = "../../examples/curve.rs"]
pub(crate) mod curve;
#[path = "../../crates/suite/examples/foreign_traversal.rs"]
mod foreign_traversal;
#[path = "../../examples/gpu_upload.rs"]
mod gpu_upload;
#[path = "../../examples/hidden_objects.rs"]
mod hidden_objects;
#[path = "../../examples/instances.rs"]
mod instances;
#[path = "../../examples/many_lights.rs"]
mod many_lights;
#[path = "../../examples/nearest_point.rs"]
mod nearest_point;
#[path = "../../examples/next_hits.rs"]
mod next_hits;
#[path = "../../examples/own_primitives.rs"]
mod own_primitives;
#[path = "../../examples/pausing.rs"]
mod pausing;

/// The result of a program.
type Outcome = Result<(), Box<dyn std::error::Error>>;

#[test]
fn the_examples_run() {
    let programs: [fn() -> Outcome; 10] = [
        curve::main,
        foreign_traversal::main,
        gpu_upload::main,
        hidden_objects::main,
        instances::main,
        many_lights::main,
        nearest_point::main,
        next_hits::main,
        own_primitives::main,
        pausing::main,
    ];
    for program in programs {
        program().unwrap();
    }
}
