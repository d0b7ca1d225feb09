//! How close textured lights come to the integral of the model, for each picture and roughness.

use softbox::fit;
use softbox::report::{Colouring, Region, pictures, random_quads, texture_accuracy};
use softbox::table::Table;

/// Errors in per cent, of diffuse and specular light with one sample and with a pair, in each picture.
type Figures = [[[f64; 2]; 2]; 3];

#[test]
fn every_picture_keeps_its_figures() {
    let pictures = pictures();
    let table = Table::default();
    let mut failures = Vec::new();
    for (roughness, figures) in FIGURES {
        let quads = random_quads(Region { roughness, cosine: (0.1, 1.0) }, 60);
        let (rows, white) = texture_accuracy(&table, &fit::ggx, &Colouring::ALL, &pictures, &quads);
        println!(
            "roughness {roughness:?}: a white light is off by {:.2} % (diffuse), {:.2} % (specular)",
            100.0 * white.diffuse,
            100.0 * white.specular
        );
        let total = |row: usize| rows[row].iter().map(|error| error.specular).sum::<f64>();
        assert!(total(2) < 0.6 * total(0), "one sample {}, the mean colour {}", total(2), total(0));
        assert!(white.diffuse < 2e-4, "texels add up to another form factor: {white:?}");
        for (column, (name, _)) in pictures.iter().enumerate() {
            let percent =
                rows.iter().map(|row| [row[column].diffuse, row[column].specular].map(|error| 100.0 * error));
            let [mean, nearest, single, pair]: [[f64; 2]; 4] =
                percent.collect::<Vec<_>>().try_into().unwrap();
            println!("  {name}: mean {mean:.1?} nearest {nearest:.1?} single {single:.1?} pair {pair:.1?}");
            for (found, bound) in [single, pair].into_iter().zip(figures[column]) {
                if (0..2).any(|k| found[k] > bound[k]) {
                    failures.push(format!("{name}: {found:.2?} beyond {bound:?}, roughness {roughness:?}"));
                }
            }
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

const FIGURES: [((f64, f64), Figures); 4] = [
    ((0.1, 0.2), [[[3.9, 1.1], [3.9, 1.1]], [[2.9, 12.6], [2.8, 9.8]], [[2.3, 15.8], [2.1, 7.3]]]),
    ((0.2, 0.4), [[[4.6, 2.3], [4.5, 2.2]], [[3.5, 5.8], [3.4, 5.8]], [[4.4, 7.1], [3.2, 8.0]]]),
    ((0.4, 0.7), [[[5.3, 7.1], [5.2, 6.9]], [[2.3, 5.0], [1.8, 6.8]], [[6.2, 4.9], [4.5, 5.8]]]),
    ((0.7, 1.0), [[[4.7, 5.6], [4.6, 5.5]], [[10.8, 11.0], [10.7, 12.0]], [[6.6, 7.6], [4.4, 7.0]]]),
];
