//! Sets of effects on the command line.

use std::process::{Command, Output};

fn softbox(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_softbox")).args(arguments).output().expect("the program starts")
}

#[test]
fn a_scene_without_area_lights_costs_what_it_cost_before() {
    let output =
        softbox(&["cost", "--json", "--effects", "none", "--effects", "quad", "--effects", "quad+ggx"]);
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}");
    let reports: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let reports = reports.as_array().expect("a list");
    assert_eq!(reports.len(), 3);
    for report in reports {
        let [before, none, quad, ggx] = report["sets"].as_array().expect("rows").as_slice() else {
            panic!("four rows: {report}")
        };
        for what in [
            "vector_registers",
            "scalar_registers",
            "instructions",
            "inverse_throughput",
            "code_bytes",
            "spirv_bytes",
        ] {
            let value = |row: &serde_json::Value| row[what].as_u64().expect("a number");
            assert!(value(before) > 0, "{report}");
            assert_eq!(value(before), value(none), "{}: {what}", report["device"]);
            if what != "scalar_registers" {
                assert!(
                    value(none) < value(quad) && value(quad) < value(ggx),
                    "{}: {what}",
                    report["device"]
                );
            }
        }
        assert_eq!(none["table_bytes"], 0);
        assert_eq!(ggx["table_bytes"], 2 * 64 * 64 * 8);
    }
}

#[test]
fn what_makes_no_sense_is_refused_in_one_sentence() {
    for (arguments, word) in [
        (["cost", "--family", "voodoo"], "voodoo"),
        (["cost", "--effects=quad+ggx,quda", "--json"], "the nearest is \"quad\""),
        (["cost", "--effects=quad+ggx,caps", "--json"], "means nothing without tube"),
        (["select", "ggx+two-sided", "--target=msl"], "means nothing without quad"),
    ] {
        let output = softbox(&arguments);
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert_eq!(said.lines().count(), 1, "{said}");
        assert!(said.contains(word), "{said}");
    }
}

#[test]
fn a_part_of_the_include_is_written_in_any_language() {
    let text = |target: &str| {
        let output = softbox(&["select", "ggx+quad", "--target", target]);
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8(output.stdout).expect("UTF-8")
    };
    for (target, declaration) in [
        ("wgsl", "fn ltc_quad("),
        ("glsl-450", "vec3 ltc_quad("),
        ("glsl-es300", "vec3 ltc_quad("),
        ("hlsl", "float3 ltc_quad("),
        ("unreal", "float3 ltc_quad("),
        ("msl", "float3 ltc_quad("),
    ] {
        let text = text(target);
        assert!(text.contains(declaration), "{target}: {text}");
        assert!(!text.contains("ltc_polygon_add("), "{target} has polygons: {text}");
    }
    let output = softbox(&["select", "--list"]);
    assert!(String::from_utf8_lossy(&output.stdout).contains("quad  "));
}
