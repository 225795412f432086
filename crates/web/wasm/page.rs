//! The functions that the page calls.
//!
//! Input and output use two buffers of this module: the page gets the address of a buffer and reads or writes there. A
//! call that can fail returns whether it succeeded; after a failure the output is the error, one line of text.

#![allow(unsafe_code, reason = "exporting a name counts as unsafe; no other code is unsafe")]

use std::cell::RefCell;

use serde_json::json;
use stackless_web::{Difference, Example, MOST_BYTES, Row, SIDE, Scene, SceneFault, Totals};

thread_local! {
    static PAGE: RefCell<Page> = RefCell::default();
}

#[derive(Default)]
struct Page {
    input: Vec<u8>,
    output: Vec<u8>,
    scene: Option<Scene>,
    totals: Totals,
}

/// Allocates the input buffer, and returns its address.
#[unsafe(no_mangle)]
pub extern "C" fn input(length: usize) -> *mut u8 {
    with(|page| {
        page.input = vec![0; length];
        page.input.as_mut_ptr()
    })
}

/// The address of the output of the last call.
#[unsafe(no_mangle)]
pub extern "C" fn output() -> *const u8 {
    with(|page| page.output.as_ptr())
}

/// The length of the output.
#[unsafe(no_mangle)]
pub extern "C" fn output_length() -> usize {
    with(|page| page.output.len())
}

/// The examples, and the limits, as JSON.
#[unsafe(no_mangle)]
pub extern "C" fn about() {
    let examples = Example::ALL.map(|example| json!({ "name": example.name, "about": example.about }));
    let about = json!({ "examples": examples, "side": SIDE, "most_bytes": MOST_BYTES });
    with(|page| page.output = about.to_string().into_bytes());
}

/// Opens the example with the name in the input.
#[unsafe(no_mangle)]
pub extern "C" fn open_example() -> bool {
    with(|page| {
        let name = String::from_utf8_lossy(&page.input).into_owned();
        page.open(Scene::example(&name))
    })
}

/// Opens a file. The first `name` bytes of the input are its name, the rest its content.
#[unsafe(no_mangle)]
pub extern "C" fn open_file(name_length: usize) -> bool {
    with(|page| {
        let input = std::mem::take(&mut page.input);
        let (name, bytes) = input.split_at_checked(name_length).unwrap_or((&input, &[]));
        page.open(Scene::read(&String::from_utf8_lossy(name), bytes))
    })
}

/// Traces rows from this row on. Returns the colours of each picture, then the differences.
#[unsafe(no_mangle)]
pub extern "C" fn rows(first: usize, count: usize) {
    with(|page| {
        let Page { scene: Some(scene), totals, output, .. } = page else { return };
        let mut all = Row::default();
        for row in (first..SIDE.min(first.saturating_add(count))).map(|y| scene.row(y, totals)) {
            all.exact.extend(row.exact);
            all.inexact.extend(row.inexact);
            all.differences.extend(row.differences);
        }
        *output = [all.exact, all.inexact, all.differences].concat();
    });
}

/// The counts so far, as JSON.
#[unsafe(no_mangle)]
pub extern "C" fn totals() {
    with(|page| page.output = json!(page.totals).to_string().into_bytes());
}

/// Both answers at a pixel, as JSON.
#[unsafe(no_mangle)]
pub extern "C" fn pixel(x: usize, y: usize) {
    with(|page| {
        let ray = page.scene.as_ref().and_then(|scene| Some((scene, scene.ray([x, y])?)));
        let hits = ray.map_or([None; 2], |(scene, ray)| scene.hits(&ray));
        let shown = |hit: stackless_bvh::trace::Hit| json!({ "triangle": hit.prim, "distance": hit.t });
        let answer = json!({ "hits": hits.map(|hit| hit.map(shown)), "difference": Difference::of(&hits) as u8 });
        page.output = answer.to_string().into_bytes();
    });
}

/// The page that explains a pixel.
#[unsafe(no_mangle)]
pub extern "C" fn explain(x: usize, y: usize) -> bool {
    with(|page| {
        let html = page.scene.as_ref().map(|scene| scene.explain([x, y]));
        page.answer(html.unwrap_or(Err(SceneFault::NoRay)).map(String::into_bytes))
    })
}

impl Page {
    fn open(&mut self, scene: Result<Scene, SceneFault>) -> bool {
        (self.input, self.totals, self.scene) = (Vec::new(), Totals::default(), None);
        let opened = scene.map(|scene| {
            let about =
                json!({ "name": scene.name(), "note": scene.note(), "triangles": scene.mesh().triangles().len() });
            self.scene = Some(scene);
            about.to_string().into_bytes()
        });
        self.answer(opened)
    }

    /// Sets the output to the answer or the error.
    fn answer(&mut self, answer: Result<Vec<u8>, SceneFault>) -> bool {
        let is_there = answer.is_ok();
        self.output = answer.unwrap_or_else(|fault| fault.to_string().into_bytes());
        is_there
    }
}

fn with<T>(what: impl FnOnce(&mut Page) -> T) -> T {
    PAGE.with_borrow_mut(what)
}
