//! SARIF 2.1.0, for editors and code review: each claim that is not plainly fine, at its line.

use super::human::detail;
use super::tally::Outcome;
use crate::corpus::Run;
use crate::judge::{Report, Verdict};
use serde::Serialize;

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Log<'a> {
    #[serde(rename = "$schema")]
    schema: &'static str,
    version: &'static str,
    runs: [SarifRun<'a>; 1],
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct SarifRun<'a> {
    tool: Tool,
    results: Vec<SarifResult<'a>>,
}

#[derive(Serialize)]
struct Tool {
    driver: Driver,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Driver {
    name: &'static str,
    semantic_version: &'static str,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct SarifResult<'a> {
    rule_id: &'static str,
    kind: &'static str,
    level: &'static str,
    message: Message,
    locations: [Location; 1],
    partial_fingerprints: Fingerprints<'a>,
}

#[derive(Serialize)]
struct Message {
    text: String,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Location {
    physical_location: PhysicalLocation,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct PhysicalLocation {
    artifact_location: ArtifactLocation,
    region: Region,
}

#[derive(Serialize)]
struct ArtifactLocation {
    uri: String,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Region {
    start_line: usize,
}

#[derive(Serialize)]
struct Fingerprints<'a> {
    claim: &'a str,
}

/// The run as SARIF. Rules are the outcomes (`refuted`, `condition_missing`, `undecided`, ...);
/// what is not as expected is an error, an erratum that the book expects is a note.
///
/// # Errors
/// Those of serde_json; a run has none.
pub fn render(run: &Run) -> Result<String, serde_json::Error> {
    let shown = run.reports.iter().filter(|report| worth_showing(report));
    let log = Log {
        schema: "https://json.schemastore.org/sarif-2.1.0.json",
        version: "2.1.0",
        runs: [SarifRun {
            tool: Tool {
                driver: Driver {
                    name: "claimcheck",
                    semantic_version: env!("CARGO_PKG_VERSION"),
                },
            },
            results: shown.map(result).collect(),
        }],
    };
    serde_json::to_string_pretty(&log).map(|text| text + "\n")
}

fn worth_showing(report: &Report) -> bool {
    let fine = [
        Verdict::Proved,
        Verdict::Certified,
        Verdict::Defined,
        Verdict::Noted,
    ];
    !report.as_expected || !fine.contains(&report.printed.verdict)
}

fn result(report: &Report) -> SarifResult<'_> {
    let outcome = Outcome::of(&report.printed);
    // SARIF 3.27.10: a level other than "none" goes with the kind "fail" only.
    let (kind, level) = match (report.as_expected, report.printed.verdict) {
        (false, _) => ("fail", "error"),
        (true, Verdict::Refuted | Verdict::IllTyped) => ("fail", "note"),
        (true, _) => ("open", "none"),
    };
    let text = anstream::adapter::strip_str(&detail::render(report)).to_string();
    SarifResult {
        rule_id: outcome.key(),
        kind,
        level,
        message: Message { text },
        locations: [Location {
            physical_location: PhysicalLocation {
                artifact_location: ArtifactLocation {
                    uri: uri(&report.file),
                },
                region: Region {
                    start_line: report.line.max(1),
                },
            },
        }],
        partial_fingerprints: Fingerprints { claim: &report.id },
    }
}

/// A path as a relative or file URI: what RFC 3986 does not call unreserved is percent-encoded.
fn uri(path: &str) -> String {
    let mut uri = String::from(if path.starts_with('/') { "file://" } else { "" });
    for byte in path.bytes() {
        if byte.is_ascii_alphanumeric() || b"/-._~".contains(&byte) {
            uri.push(char::from(byte));
        } else {
            uri.push_str(&format!("%{byte:02X}"));
        }
    }
    uri
}

#[cfg(test)]
mod tests {
    use super::super::human::sample::run;
    use super::*;

    #[test]
    fn shows_errors_notes_and_open_claims() {
        let text = render(&run()).expect("serialises");
        let value: serde_json::Value = serde_json::from_str(&text).expect("is JSON");
        let results = value["runs"][0]["results"].as_array().expect("an array");
        let row = |i: usize| {
            let r: &serde_json::Value = &results[i];
            [&r["ruleId"], &r["kind"], &r["level"]].map(|v| v.as_str().expect("text").to_owned())
        };
        assert_eq!(results.len(), 3);
        assert_eq!(row(0), ["condition_missing", "fail", "note"]);
        assert_eq!(row(1), ["certified", "fail", "error"]);
        assert_eq!(row(2), ["undecided", "open", "none"]);
    }

    #[test]
    fn paths_become_uris() {
        assert_eq!(uri("proofs/2.1 1d.md"), "proofs/2.1%201d.md");
        assert_eq!(uri("/a/é"), "file:///a/%C3%A9");
    }
}
