//! Prints how close textured lights come to the integral of the model: mean |error| over mean value, in per cent, of
//! diffuse light, specular light and its Schlick part, for each picture, range of roughness and way to find the colour.
//!
//!     cargo run --release -p softbox --features bake --example textured_lights -- 300

use softbox::fit;
use softbox::report::{Colouring, Region, pictures, random_quads, texture_accuracy};
use softbox::table::Table;

fn main() {
    let count = std::env::args().nth(1).and_then(|count| count.parse().ok()).unwrap_or(100);
    let (table, pictures) = (Table::default(), pictures());
    for roughness in [(0.1, 0.2), (0.2, 0.3), (0.3, 0.5), (0.5, 0.7), (0.7, 1.0)] {
        let quads = random_quads(Region { roughness, cosine: (0.1, 1.0) }, count);
        let (rows, white) = texture_accuracy(&table, &fit::ggx, &Colouring::ALL, &pictures, &quads);
        let [specular, fresnel] = [white.specular, white.fresnel].map(|error| 100.0 * error);
        println!("roughness {roughness:?}, without a picture {specular:.2} and {fresnel:.2}");
        for (colouring, row) in Colouring::ALL.iter().zip(&rows) {
            print!("    {:8}", format!("{colouring:?}"));
            for ((name, _), error) in pictures.iter().zip(row) {
                let [diffuse, specular, fresnel] =
                    [error.diffuse, error.specular, error.fresnel].map(|error| 100.0 * error);
                print!(" | {name} {diffuse:5.2} {specular:5.2} {fresnel:5.2}");
            }
            println!();
        }
    }
}
