//! Draws the picture that the textured light of `scenes/lights.toml` shows:
//! `cargo run -p softbox --features scene --example sunset -- scenes/sunset.png`.

use softbox::scene::{Panel, write_png};

const WIDTH: u32 = 256;
const HEIGHT: u32 = 144;

/// Points of a pixel along each axis that are averaged.
const PARTS: u32 = 8;

/// Height of the horizon above the picture's lower edge, and height and radius of the sun, in heights of the picture.
const HORIZON: f64 = 0.3;
const SUN: [f64; 2] = [0.5, 0.33];

fn between(from: [f64; 3], to: [f64; 3], share: f64) -> [f64; 3] {
    let share = share.clamp(0.0, 1.0);
    std::array::from_fn(|k| from[k] + (to[k] - from[k]) * share)
}

fn sky(height: f64) -> [f64; 3] {
    let [violet, pink, orange] = [[0.10, 0.05, 0.36], [0.78, 0.15, 0.47], [1.0, 0.56, 0.20]];
    if height > 0.55 {
        between(pink, violet, (height - 0.55) / 0.45)
    } else {
        between(orange, pink, (height - HORIZON) / (0.55 - HORIZON))
    }
}

/// The colour in sRGB at a place in heights of the picture, from the middle of its lower edge.
fn colour(across: f64, height: f64) -> [f64; 3] {
    let is_sun = |height: f64| across.hypot(height - SUN[0]) < SUN[1];
    if height < HORIZON {
        // The sun glitters on the water, on ever longer waves.
        let depth = HORIZON - height;
        let wave = (60.0 * (depth + 0.02).sqrt()).sin() > 0.0;
        let shown = across.abs() < 0.26 - 0.5 * depth && wave;
        return if shown {
            [1.0, 0.62, 0.28]
        } else {
            between([0.42, 0.12, 0.45], [0.05, 0.04, 0.22], depth / HORIZON)
        };
    }
    // Stripes of sky lie before the sun, wider towards the horizon.
    let above = height - HORIZON;
    let stripe = [(0.03, 0.020), (0.10, 0.016), (0.17, 0.012), (0.235, 0.008)]
        .iter()
        .any(|(at, half)| (above - at).abs() < *half);
    if is_sun(height) && !stripe {
        between([1.0, 0.35, 0.42], [1.0, 0.93, 0.45], above / (SUN[0] + SUN[1] - HORIZON))
    } else {
        sky(height)
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args().nth(1).ok_or("name the PNG file to write")?;
    let pixel = |column: u32, row: u32| {
        let mut sum = [0.0; 3];
        for part in 0..PARTS * PARTS {
            let x = f64::from(column) + (f64::from(part % PARTS) + 0.5) / f64::from(PARTS);
            let y = f64::from(row) + (f64::from(part / PARTS) + 0.5) / f64::from(PARTS);
            let value = colour((x - 0.5 * f64::from(WIDTH)) / f64::from(HEIGHT), 1.0 - y / f64::from(HEIGHT));
            for k in 0..3 {
                sum[k] += value[k];
            }
        }
        sum.map(|value| (255.0 * value / f64::from(PARTS * PARTS)).round() as u8)
    };
    let pixels = (0..HEIGHT).flat_map(|row| (0..WIDTH).map(move |column| pixel(column, row))).collect();
    write_png(path.as_ref(), &Panel { width: WIDTH, height: HEIGHT, pixels })?;
    Ok(())
}
