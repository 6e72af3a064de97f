//! One JSON object for a run: seed, digits, every claim in book order, counts.

use super::tally;
use crate::corpus::Run;
use crate::judge::Report;
use serde::Serialize;
use std::collections::BTreeMap;

#[derive(Serialize)]
struct Document<'a> {
    seed: u64,
    digits: u32,
    claims: &'a [Report],
    summary: BTreeMap<&'static str, usize>,
}

/// The whole run. In `summary` the claims are counted by the verdict on the print;
/// `condition_missing` is not part of `refuted`, and `not_as_expected` cuts across all of them.
///
/// # Errors
/// Those of serde_json; a run has none.
pub fn render(run: &Run) -> Result<String, serde_json::Error> {
    let counts = tally::outcomes().map(|o| (o.key(), tally::count(&run.reports, o)));
    let unexpected = ("not_as_expected", tally::unexpected(&run.reports));
    let document = Document {
        seed: run.seed,
        digits: run.digits,
        claims: &run.reports,
        summary: counts.chain([unexpected]).collect(),
    };
    serde_json::to_string_pretty(&document).map(|text| text + "\n")
}

#[cfg(test)]
mod tests {
    use super::super::human::sample::run;
    use super::*;

    #[test]
    fn has_the_shape_that_programs_read() {
        let text = render(&run()).expect("serialises");
        let value: serde_json::Value = serde_json::from_str(&text).expect("is JSON");
        assert_eq!(value["seed"], 1);
        assert_eq!(value["digits"], 50);
        assert_eq!(value["claims"][0]["id"], "2.14");
        assert_eq!(value["claims"][0]["printed"]["fault"], "domain");
        assert_eq!(
            value["claims"][0]["printed"]["witness"]["values"][1],
            serde_json::Value::Null
        );
        assert_eq!(value["summary"]["condition_missing"], 1);
        assert_eq!(value["summary"]["refuted"], 0);
        assert_eq!(value["summary"]["not_as_expected"], 1);
    }
}
