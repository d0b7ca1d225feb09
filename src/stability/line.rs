//! Cases as lines of JSON.

use serde_json::{Value, json};

use super::{Case, Shape};

/// The shortest decimal that is the same in single precision.
fn number(value: f32) -> Value {
    // As a double, it would be written with all the digits that tell doubles apart.
    let text = format!("{value:e}");
    text.parse::<f64>().map_or(Value::Null, Value::from)
}

impl Case {
    /// The case as a line that `softbox eval` reads, unless the light is one that it refuses, such as a disk without an axis. Each
    /// number is the shortest decimal that is the same in single precision.
    pub fn line(&self) -> String {
        let v = |v: glam::Vec3| Value::from(v.to_array().map(number).to_vec());
        let all = |vertices: &[glam::Vec3]| -> Value { vertices.iter().map(|vertex| v(*vertex)).collect() };
        let light = match &self.shape {
            Shape::Quad { corners, two_sided } => {
                json!({"shape": "polygon", "points": all(corners), "two_sided": two_sided})
            }
            Shape::Polygon { vertices, two_sided } => {
                json!({"shape": "polygon", "points": all(vertices), "two_sided": two_sided})
            }
            Shape::Disk { center, half_x, half_y, two_sided } => json!({
                "shape": "disk", "center": v(*center), "half_x": v(*half_x), "half_y": v(*half_y), "two_sided": two_sided
            }),
            Shape::Sphere { center, radius } => {
                json!({"shape": "sphere", "center": v(*center), "radius": number(*radius)})
            }
            Shape::Tube { start, end, radius, caps } => {
                json!({"shape": "tube", "start": v(*start), "end": v(*end), "radius": number(*radius), "caps": caps})
            }
        };
        let surface = json!({
            "position": v(self.position), "normal": v(self.normal), "view": v(self.view), "roughness": number(self.roughness)
        });
        json!({"surface": surface, "light": light}).to_string()
    }
}

#[cfg(test)]
mod tests {
    use crate::scene::{Case as Read, Precision};
    use crate::stability::{Bound, cases};

    #[test]
    fn lines_read_back_to_the_same_bits() {
        let mut read = 0;
        // Those with a bound in numbers, which is what the page prints: lights without area are refused.
        let bounded = |case: &&super::Case| matches!(case.bound, Bound::Absolute(_) | Bound::Relative(_));
        for case in cases(1).iter().filter(bounded) {
            let line = case.line();
            let back =
                Read::parse(line.as_bytes(), Precision::Single, &mut |_| Err("no pictures".to_owned()));
            let back = back.unwrap_or_else(|error| panic!("{error}: {line}"));
            assert_eq!(back.position.as_vec3(), case.position, "{line}");
            assert_eq!(back.normal.as_vec3(), case.normal, "{line}");
            assert_eq!(back.view.as_vec3(), case.view, "{line}");
            assert_eq!(back.roughness as f32, case.roughness, "{line}");
            let same = |v: glam::DVec3| v.as_vec3().as_dvec3();
            let radius = |light: crate::light::Light| match light {
                crate::light::Light::Sphere { center, radius } => {
                    crate::light::Light::Sphere { center, radius: f64::from(radius as f32) }
                }
                crate::light::Light::Tube { start, end, radius, caps } => {
                    crate::light::Light::Tube { start, end, radius: f64::from(radius as f32), caps }
                }
                other => other,
            };
            assert_eq!(radius(back.light.moved(same, same)), case.shape.light(), "{line}");
            read += 1;
        }
        assert!(read > 2000, "{read}");
    }
}
