//! Kinds of costs: what they are called, and which of many are worth a chart.

use crate::report::data::Report;

/// A kind of cost: what was measured, and in which stage of a pipeline.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Measure<'a> {
    pub measure: &'a str,
    pub stage: &'a str,
}

/// What counts operations executed begins with.
const EXECUTED: &str = "executed ";
/// A stage that means none in particular.
const ANY: &str = "any";

impl<'a> Measure<'a> {
    /// Its key with the stage, where that means something.
    pub fn name(&self) -> String {
        if self.stage.is_empty() || self.stage == ANY {
            self.measure.to_owned()
        } else {
            format!("{}, {}", self.measure, self.stage)
        }
    }

    /// What readers are told that it is.
    pub fn said(&self) -> String {
        let Some(executed) = self.measure.strip_prefix(EXECUTED) else {
            return match self.measure {
                "callgrind instructions" => "instructions on a CPU (callgrind)".to_owned(),
                "lavapipe time" => "time on a CPU (lavapipe)".to_owned(),
                "gpu time" => "time on a graphics processor".to_owned(),
                _ => self.name(),
            };
        };
        match executed {
            "mean" => "slots executed, mean of random quads".to_owned(),
            "wave" => "slots executed, waves of pixels".to_owned(),
            "worst" => "slots executed, worst of random quads".to_owned(),
            "operations" | "branches" => format!("{executed} executed"),
            "special" => "special operations executed".to_owned(),
            "samples" => "texture samples taken".to_owned(),
            input => format!("slots executed, {input}"),
        }
    }

    /// Whether it stands for time. Registers, waves and the length of code do not, and single inputs stand for no scene.
    fn is_time(&self) -> bool {
        matches!(self.measure, "executed mean" | "executed wave" | "executed worst")
            || ["inverse throughput", " time", "callgrind instructions"]
                .iter()
                .any(|end| self.measure.ends_with(end))
    }

    /// What its figures share with others: a processor, a way of counting.
    pub fn group(&self) -> &'a str {
        self.measure.split(' ').next().unwrap_or(self.measure)
    }
}

/// Kinds of costs in the order of the report.
pub(super) fn measures(report: &Report) -> Vec<Measure<'_>> {
    let mut measures = Vec::new();
    for row in &report.costs {
        let measure = Measure { measure: &row.measure, stage: &row.stage };
        if !measures.contains(&measure) {
            measures.push(measure);
        }
    }
    measures
}

/// Those that stand for time, in one stage each; all where none does.
pub(super) fn charted(report: &Report) -> Vec<Measure<'_>> {
    let all = measures(report);
    let mut charted: Vec<Measure> = Vec::new();
    for measure in all.iter().filter(|measure| measure.is_time()) {
        if charted.iter().all(|known| known.measure != measure.measure) {
            charted.push(*measure);
        }
    }
    if charted.is_empty() { all } else { charted }
}

/// Few of those, for a table at the beginning: of counts the mean, of compilers' estimates those for the last processor,
/// which is the newest.
pub(super) fn headlines(report: &Report) -> Vec<Measure<'_>> {
    let charted = charted(report);
    let compiled = |measure: &&Measure| measure.measure.ends_with("inverse throughput");
    let last = charted.iter().rfind(compiled).copied();
    charted
        .iter()
        .filter(|measure| match measure {
            measure if compiled(measure) => Some(**measure) == last,
            measure => !matches!(measure.measure, "executed wave" | "executed worst"),
        })
        .take(6)
        .copied()
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::data::CostRow;

    #[test]
    fn charts_are_of_time_and_few() {
        let row = |(measure, stage): (&str, &str)| CostRow {
            method: "published".to_owned(),
            measure: measure.to_owned(),
            stage: stage.to_owned(),
            value: 1.0,
            unit: String::new(),
            ratio: 1.0,
            origin: 0,
        };
        let costs = [
            ("executed mean", "any"),
            ("executed worst", "any"),
            ("executed behind", "any"),
            ("navi10 inverse throughput", "compute"),
            ("navi10 waves", "compute"),
            ("navi10 inverse throughput", "fragment"),
            ("gfx1100 inverse throughput", "compute"),
            ("lavapipe time", "compute"),
        ];
        let report = Report { costs: costs.map(row).to_vec(), ..Report::default() };
        let names = |measures: Vec<Measure>| measures.iter().map(Measure::name).collect::<Vec<_>>();
        let expected = ["executed mean", "gfx1100 inverse throughput, compute", "lavapipe time, compute"];
        assert_eq!(names(headlines(&report)), expected);
        assert_eq!(charted(&report).len(), 5, "{:?}", names(charted(&report)));
        let only = Report { costs: vec![row(("navi10 waves", "compute"))], ..Report::default() };
        assert_eq!(names(charted(&only)), ["navi10 waves, compute"], "what there is, is shown");
    }
}
