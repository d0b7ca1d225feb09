//! Relations between values hold that need no oracle, on the twin and on the device.

use std::convert::Infallible;
use std::path::{Path, PathBuf};

use softbox::device::{Device, DeviceError};
use softbox::effects::Quality;
use softbox::stability::relations::{
    Finding, Kept, RELATIONS, Relation, Setting, Tally, examine, on_twin, pose, settings, shrunk,
};
use softbox::stability::{Case, batch, program};
use softbox::table::Table;

/// How many settings each relation is asked about.
const COUNT: usize = 6000;

/// Seeds beyond the first, for a longer run.
fn seeds() -> u64 {
    match std::env::var("SOFTBOX_RELATIONS_SEEDS") {
        Ok(text) => text
            .parse()
            .unwrap_or_else(|_| panic!("SOFTBOX_RELATIONS_SEEDS is {text}, and should be a number")),
        Err(_) => 1,
    }
}

fn twin(relations: &[Relation], settings: &[Setting], level: Quality) -> Vec<Tally> {
    examine(relations, settings, level, &on_twin(level)).unwrap_or_else(|error: Infallible| match error {})
}

/// What it is that offends, in as few digits as offend on the twin.
fn said(finding: &Finding, level: Quality) -> String {
    let relation = RELATIONS.iter().find(|relation| relation.name == finding.relation);
    let relation = *relation.unwrap_or_else(|| panic!("there is no relation {:?}", finding.relation));
    let offends = |setting: &Setting| {
        let tally = twin(&[relation], std::slice::from_ref(setting), level);
        tally.iter().any(|tally| tally.broken > 0)
    };
    let simplest = shrunk(&finding.setting, &offends);
    let cases = pose(&relation, &simplest).map(|posed| posed.cases).unwrap_or_default();
    let again = twin(&[relation], &[simplest], level);
    let exact: Vec<[f64; 3]> = cases
        .iter()
        .map(|case| case.twin::<f64>(&softbox::stability::table(level), softbox::stability::effects(level)))
        .collect();
    let cases: Vec<_> = cases.iter().map(|case| &case.shape).collect();
    format!(
        "{finding:?}\ncases {cases:?}\nsimplest on the twin: {:?}\nits cases in f64: {exact:?}",
        again[0].worst
    )
}

/// Prints the worst of each relation, panics with what offends.
fn check(what: &str, level: Quality, tallies: &[Tally]) {
    let mut offences = Vec::new();
    for tally in tallies {
        let worst = tally.worst.as_ref().unwrap_or_else(|| panic!("{what}: {} says nothing", tally.relation));
        println!(
            "{what}, {level}: {}: of {} the worst takes {:.2} of its tolerance",
            tally.relation, tally.count, worst.share
        );
        for finding in &tally.offenders {
            offences.push(format!("{}, {} times: {}", tally.relation, tally.broken, said(finding, level)));
        }
    }
    assert!(offences.is_empty(), "{what}, {level}: {} offend:\n{}", offences.len(), offences.join("\n"));
}

#[test]
fn the_twin_keeps_every_relation() {
    for seed in 0..seeds() {
        for level in Quality::ALL {
            let count = if level == Quality::Standard { COUNT } else { COUNT / 4 };
            check("twin", level, &twin(RELATIONS, &settings(seed, count), level));
        }
    }
}

/// All cases of all relations in one dispatch for each kind of lobes.
#[test]
fn the_device_keeps_every_relation() {
    let device = Device::open(wgpu::Backends::VULKAN).unwrap_or_else(|error| panic!("{error}"));
    for seed in 0..seeds() {
        for level in [Quality::Standard, Quality::Fast] {
            let program = program(level).unwrap_or_else(|error| panic!("{error}"));
            let values = |cases: &[Case], table: &Table| -> Result<_, DeviceError> {
                match cases {
                    [] => Ok(Vec::new()),
                    _ => device.evaluate(&program, table, &batch(cases)),
                }
            };
            let tallies = examine(RELATIONS, &settings(seed, 1500), level, &values);
            check("device", level, &tallies.unwrap_or_else(|error| panic!("{error}")));
        }
    }
}

fn kept_path() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/worst.jsonl")
}

/// The settings in which each relation took most of its tolerance, over more seeds than other tests run, still hold.
/// `SOFTBOX_KEEP_WORST=1` looks for them anew and writes the file.
#[test]
fn the_worst_that_was_found_still_holds() {
    let path = kept_path();
    if std::env::var_os("SOFTBOX_KEEP_WORST").is_some() {
        let mut worst: Vec<Option<Finding>> = vec![None; RELATIONS.len()];
        for seed in 100..100 + 10 * seeds() {
            for (worst, tally) in
                worst.iter_mut().zip(twin(RELATIONS, &settings(seed, COUNT), Quality::Standard))
            {
                let share =
                    |finding: &Option<Finding>| finding.as_ref().map_or(-1.0, |finding| finding.share);
                if share(&tally.worst) > share(worst) {
                    *worst = tally.worst;
                }
            }
        }
        let line = |finding: Finding| serde_json::to_string(&Kept::of(&finding)).expect("a line") + "\n";
        let text: String = worst.into_iter().flatten().map(line).collect();
        std::fs::write(&path, text).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    }
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let mut names: Vec<String> = Vec::new();
    for line in text.lines() {
        let kept: Kept = serde_json::from_str(line).unwrap_or_else(|error| panic!("{line}: {error}"));
        let (relation, setting) = kept.restore().unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(Kept::of(&Finding { share: kept.share, ..found(relation, &setting) }), kept, "read back");
        for level in relation.levels {
            let tallies = twin(&[relation], std::slice::from_ref(&setting), *level);
            let broken: usize = tallies.iter().map(|tally| tally.broken).sum();
            assert_eq!(broken, 0, "{level}: {:?}", tallies[0].worst);
        }
        names.push(kept.relation);
    }
    let all: Vec<&str> = RELATIONS.iter().map(|relation| relation.name).collect();
    assert_eq!(names, all, "a line for each relation");
}

/// What becomes of a setting that a relation says something about.
fn found(relation: Relation, setting: &Setting) -> Finding {
    let tallies = twin(&[relation], std::slice::from_ref(setting), Quality::Standard);
    let worst = tallies.into_iter().find_map(|tally| tally.worst);
    worst.unwrap_or_else(|| panic!("{} says nothing of {setting:?}", relation.name))
}

/// How many settings break each relation when values are spoiled.
fn broken(spoil: &dyn Fn(&Case, [f32; 3]) -> [f32; 3]) -> Vec<&'static str> {
    let values = |cases: &[Case], table: &Table| -> Result<Vec<[f32; 3]>, Infallible> {
        let plain = on_twin(Quality::Standard)(cases, table)?;
        Ok(cases.iter().zip(plain).map(|(case, value)| spoil(case, value)).collect())
    };
    let tallies = examine(RELATIONS, &settings(7, 2000), Quality::Standard, &values);
    let tallies = tallies.unwrap_or_else(|error| match error {});
    tallies.iter().filter(|tally| tally.broken > 0).map(|tally| tally.relation).collect()
}

/// Values spoiled in ways that shaders are, and the relations that must condemn each.
#[test]
fn what_is_wrong_is_condemned() {
    assert_eq!(broken(&|_, value| value), [""; 0]);
    let condemned = |what: &str, found: &[&str], by: &[&str]| {
        println!("{what}: {found:?}");
        for name in by {
            assert!(found.contains(name), "{what} is not condemned by {name:?}, but by {found:?}");
        }
    };
    let last_bit = broken(&|case, [diffuse, specular, fresnel]| {
        let odd =
            case.position.length() + case.shape.vertices().iter().map(|v| v.length()).sum::<f32>() > 1.0;
        [f32::from_bits(diffuse.to_bits() ^ u32::from(odd && diffuse > 0.0)), specular, fresnel]
    });
    condemned("a threshold in units of the scene", &last_bit, &["scaled by a power of two"]);
    let brighter = broken(&|case, value| {
        value.map(|number| if case.shape.vertices().len() == 3 { number * 1.001 } else { number })
    });
    condemned("another sum for triangles", &brighter, &["parts at a diagonal", "parts at any chord"]);
    let both = broken(&|case, value| {
        let first = case.shape.vertices().first().copied().unwrap_or_default();
        value.map(|number| if first.x > 0.0 { number } else { 0.5 * number })
    });
    condemned("a first vertex that counts", &both, &["another first vertex", "everything turned"]);
    let dim = broken(&|_, [diffuse, specular, fresnel]| [0.999 * diffuse, specular, fresnel]);
    condemned("light that is lost", &dim, &["closed box", "identity lobe"]);
    let black =
        broken(&|case, value| if case.normal.x > 0.5 * case.normal.y { [f32::NAN; 3] } else { value });
    condemned("values that are no numbers", &black, &["one step", "both sides", "a part"]);
}

/// Next to three walls at 1e-4 of the box's size the outline of a wall crosses a lobe's horizon so close to the point that only the
/// direction of the crossing is known, next to the vertex from which all offsets count.
#[test]
fn polygons_in_a_corner_keep_their_light() {
    let low = [-5.1795578e-5, -5.4996e-5, -1.6495786e-5];
    let high = [0.2475555, 0.49481323, 0.17466287];
    let (mut sums, mut single) = ([0.0; 2], [0.0; 2]);
    for axis in 0..3 {
        for (at, order) in [(low[axis], [0, 1, 2, 3]), (high[axis], [3, 2, 1, 0])] {
            let corner = |[b, c]: [bool; 2]| {
                let mut v = [at; 3];
                let pick = |k: usize, high_side: bool| if high_side { high[k] } else { low[k] };
                (v[(axis + 1) % 3], v[(axis + 2) % 3]) = (pick((axis + 1) % 3, b), pick((axis + 2) % 3, c));
                glam::Vec3::from(v)
            };
            let face = [[false, false], [true, false], [true, true], [false, true]].map(corner);
            let face = order.map(|k: usize| face[k]);
            for (which, is_quad) in [true, false].into_iter().enumerate() {
                use softbox::stability::{Bound, Shape};
                let shape = match is_quad {
                    true => Shape::Quad { corners: face, two_sided: true },
                    false => Shape::Polygon { vertices: face.to_vec(), two_sided: true },
                };
                let case = Case {
                    family: "closed box",
                    position: glam::Vec3::ZERO,
                    normal: glam::Vec3::Z,
                    view: glam::Vec3::new(-2.0, 1.0, 1.0),
                    roughness: 0.5,
                    shape,
                    bound: Bound::Physical,
                    specular_bound: f64::INFINITY,
                    form_factor: None,
                };
                let level = Quality::Standard;
                let effects = softbox::stability::effects(level);
                let table = softbox::stability::table(level);
                sums[which] += case.twin::<f64>(&table, effects)[1];
                single[which] += case.twin::<f32>(&table, effects)[1];
            }
        }
    }
    assert!((sums[1] - sums[0]).abs() < 1e-12, "quads {}, polygons {}", sums[0], sums[1]);
    assert!(
        (single[1] - single[0]).abs() < 2e-6,
        "in single precision: quads {}, polygons {}",
        single[0],
        single[1]
    );
}

#[test]
fn offences_shrink() {
    let offends =
        |setting: &Setting| setting.case.shape.vertices().len() >= 3 && setting.case.position.z > 0.3;
    let found = settings(3, 3000).into_iter().find(|setting| {
        offends(setting) && matches!(setting.case.shape, softbox::stability::Shape::Polygon { .. })
    });
    let found = found.expect("a polygon");
    let simplest = shrunk(&found, &offends);
    assert!(offends(&simplest));
    assert_eq!(simplest.case.shape.vertices(), [glam::Vec3::ZERO; 3], "{simplest:?}");
    assert_eq!(simplest.case.position, glam::Vec3::new(0.0, 0.0, 1.0), "{simplest:?}");
    assert_eq!(simplest.case.view, simplest.case.normal);
}
