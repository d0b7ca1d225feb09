//! What reports read.

use softbox::report::costs::{Baseline, Measured};
use softbox::report::data::{CostRow, ErrorRow, Kind, MethodInfo, Origin, Part, Report};
use softbox::report::page;

/// The file of costs that must not grow: figures, which are the same when written and read again and are not beyond
/// themselves, or an error.
pub fn baseline(data: &[u8]) {
    let Ok(text) = core::str::from_utf8(data) else { return };
    match Baseline::read(text) {
        Ok(baseline) => {
            let figures = baseline.compiled.iter().flat_map(|compiled| &compiled.figures);
            for figure in baseline.executed.iter().chain(figures) {
                assert!(figure.value.is_finite() && figure.value >= 0.0, "{figure:?}");
            }
            let written = baseline.write().unwrap_or_else(|error| panic!("{error}"));
            let again = Baseline::read(&written).unwrap_or_else(|error| panic!("{error}: {written}"));
            assert_eq!(again, baseline, "{written}");
            let _ = baseline.check(&again, "update");
            let mut grown = again.clone();
            for figure in &mut grown.executed {
                figure.value = 2.0 * figure.value + 1.0;
            }
            assert!(
                grown.executed.is_empty() || baseline.check(&grown, "update").is_err(),
                "growth that is not told: {written}"
            );
            let _ = baseline.updated(again).write();
        }
        Err(error) => super::assert_sentence(&error),
    }
}

/// Times of another run: a page that shows them, or a sentence.
pub fn measured(data: &[u8]) {
    let Ok(text) = core::str::from_utf8(data) else { return };
    let measured = match Measured::read(text) {
        Ok(measured) => measured,
        Err(error) => return super::assert_sentence(&error),
    };
    let mut report = Report {
        origins: vec![Origin { command: measured.command, device: measured.device, ..Origin::default() }],
        ..Report::default()
    };
    for time in &measured.times {
        report.methods.push(MethodInfo {
            name: time.method.clone(),
            label: time.method.clone(),
            kind: Kind::Level,
            description: String::new(),
        });
        report.costs.push(CostRow {
            method: time.method.clone(),
            measure: "gpu time".to_owned(),
            stage: "compute".to_owned(),
            value: time.nanoseconds,
            unit: "ns".to_owned(),
            ratio: time.ratio,
            origin: 0,
        });
        for part in Part::ALL {
            report.errors.push(ErrorRow {
                method: time.method.clone(),
                part,
                stratum: "all".to_owned(),
                count: 1,
                mean: 0.1,
                percentile: 0.1,
                maximum: 0.1,
                bias: 0.0,
            });
        }
    }
    let files = page::files(&report, &[], &[]).unwrap_or_else(|error| panic!("{error}"));
    let page = files.iter().find(|(name, _)| name == "index.html").expect("a page");
    let page = core::str::from_utf8(&page.1).expect("text");
    // Figures that ran out of their numbers show as such.
    for word in ["\"NaN", "\"inf", "\"-inf", ",NaN", ",inf"] {
        assert!(!page.contains(word), "{word} is in the page of {text}");
    }
}
