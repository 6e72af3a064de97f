//! A made-up run for the tests of all formats.

use crate::book::Fault;
use crate::corpus::{Run, Saved};
use crate::judge::{Answer, Extent, Kind, LinkReport, Report, Verdict, WitnessReport};

pub(in crate::report) fn run() -> Run {
    Run {
        reports: vec![missing_condition(), unexpected(), open(), noted()],
        seed: 1,
        digits: 50,
        saved: Saved::default(),
    }
}

fn answer(verdict: Verdict, written: &str) -> Answer {
    Answer {
        verdict,
        fault: None,
        written: written.into(),
        statement: written.into(),
        extent: None,
        reason: None,
        witness: None,
        links: Vec::new(),
        series: None,
        constants: None,
        proved_links: Vec::new(),
        facts: Vec::new(),
        certificate: None,
        evidence: None,
    }
}

fn report(id: &str, line: usize, printed: Answer) -> Report {
    Report {
        id: id.into(),
        file: "proofs/thesis/2.1-one-dimension.md".into(),
        line,
        kind: Kind::Identity,
        printed,
        mended: None,
        needs: None,
        needs_fault: None,
        sufficient: false,
        page: None,
        quote: None,
        slip: None,
        why: None,
        expected: "printed proved".into(),
        as_expected: true,
        steps: 1234,
        seconds: 0.01,
        contradiction: None,
    }
}

fn extent(points: usize, set_aside: usize) -> Option<Extent> {
    Some(Extent {
        points,
        set_aside,
        digits: 50,
    })
}

fn missing_condition() -> Report {
    let says = "var(Ihat) == I^2*k^2*(-k+n+1)/((k-2)*(k-1)^2*n)";
    let printed = Answer {
        fault: Some(Fault::Domain),
        statement: "for k, n: var(I*k/(n*r)) == I^2*k^2*(-k+n+1)/((k-2)*(k-1)^2*n)".into(),
        extent: extent(12, 0),
        witness: Some(WitnessReport {
            point: [("k", "2"), ("n", "2")]
                .map(|(n, v)| (n.into(), v.into()))
                .into(),
            values: [Some("+inf".into()), None],
            because: "undefined",
        }),
        links: vec![LinkReport {
            with: "2.13".into(),
            verdict: Verdict::Certified,
        }],
        ..answer(Verdict::Refuted, says)
    };
    Report {
        mended: Some(Answer {
            extent: extent(412, 3),
            ..answer(Verdict::Certified, says)
        }),
        needs: Some("k >= 3".into()),
        expected: "printed refuted domain, mended proved".into(),
        ..report("2.14", 12, printed)
    }
}

fn unexpected() -> Report {
    let says = "mean(Ihat) == I*k*ln(k/(k-1))";
    let printed = Answer {
        extent: extent(400, 0),
        ..answer(Verdict::Certified, says)
    };
    Report {
        needs: Some("k >= 3".into()),
        needs_fault: Some("stronger than necessary: the statement holds at k = 2".into()),
        expected: "printed refuted".into(),
        as_expected: false,
        ..report("2.62", 140, printed)
    }
}

fn open() -> Report {
    let printed = Answer {
        reason: Some("no method".into()),
        ..answer(
            Verdict::Undecided,
            "mean(Ihat) == I + I/(2*k) + O((1/k)^2) as k -> inf",
        )
    };
    Report {
        kind: Kind::Expansion,
        expected: "printed undecided".into(),
        ..report("2.48", 90, printed)
    }
}

fn noted() -> Report {
    Report {
        kind: Kind::Words,
        slip: Some("r is printed for x".into()),
        ..report(
            "text-2.1-of-a-very-long-name-indeed",
            8,
            answer(Verdict::Noted, "words"),
        )
    }
}
