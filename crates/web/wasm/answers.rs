//! What the page should show of each example, by the native library: a line with its name and its totals as JSON.

use stackless_web::{Example, SIDE, Scene, Totals};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    for example in Example::ALL {
        let (scene, mut totals) = (Scene::example(example.name)?, Totals::default());
        for y in 0..SIDE {
            scene.row(y, &mut totals);
        }
        println!("{} {}", example.name, serde_json::to_string(&totals)?);
    }
    Ok(())
}
