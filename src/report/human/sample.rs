//! A made-up run for the tests of all formats.

use crate::book::Fault;
use crate::corpus::{FromCache, Run, Saved};
use crate::judge::{Answer, Cause, Extent, Kind, LinkReport, Report, Verdict, WitnessReport};

pub(in crate::report) fn run() -> Run {
    Run {
        reports: vec![missing_condition(), unexpected(), open(), noted()],
        seed: 1,
        digits: 50,
        saved: Saved::default(),
        cached: FromCache::default(),
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
        simulation: None,
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
        scan: None,
        like: None,
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
            difference: None,
            because: Cause::Undefined,
            relation: None,
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

/// One erratum of each kind, the least misleading first.
pub(in crate::report) fn errata() -> Vec<Report> {
    let witness = |values: [Option<&str>; 2], difference, because| {
        Some(WitnessReport {
            point: [("k".into(), "2".into())].into(),
            values: values.map(|value| value.map(str::to_owned)),
            difference,
            because,
            relation: None,
        })
    };
    let wrong = |id: &str, says: &str, witness| {
        let printed = Answer {
            fault: Some(Fault::Statement),
            witness,
            ..answer(Verdict::Refuted, says)
        };
        report(id, 1, printed)
    };
    let mended = |written: &str, file: &str| {
        Some(Answer {
            certificate: Some(file.into()),
            ..answer(Verdict::Proved, written)
        })
    };
    let finite = [Some("1.3862943611198906"), Some("0.81093021621632876")];
    let ill = Answer {
        reason: Some("`q` is free".into()),
        ..answer(Verdict::IllTyped, "k == q")
    };
    vec![
        Report {
            kind: Kind::Words,
            page: Some("iv".into()),
            quote: Some("the error is 5% at most".into()),
            slip: Some("Figure 2_1 is meant".into()),
            ..report("text", 1, answer(Verdict::Noted, "words"))
        },
        Report {
            slip: Some("dx is printed for dr".into()),
            ..report(
                "slip",
                1,
                answer(Verdict::Proved, "int(2*r, r = 0..1) == 1"),
            )
        },
        Report {
            scan: Some("it reads l for 1".into()),
            ..report("open", 1, answer(Verdict::Proved, "k/k == 1"))
        },
        missing_condition(),
        Report {
            id: "2.15".into(),
            ..missing_condition()
        },
        report("no-sense", 1, ill),
        Report {
            like: Some("near".into()),
            mended: mended("ln(2) == ln(4)/2", "certificates/near-again.proof"),
            ..wrong(
                "near-again",
                "ln(2) == ln(4)",
                witness(finite, Some(0.5), Cause::Disjoint),
            )
        },
        wrong(
            "duty",
            "f(r) is 3*r density on 0..1",
            witness([Some("3/2"), Some("1")], Some(0.3), Cause::Duty),
        ),
        wrong(
            "order",
            "1/(k - 1) == 1/k + O((1/k)^3) as k -> inf",
            witness([Some("1/k^2"), Some("O(1/k^3)")], None, Cause::Remainder),
        ),
        wrong(
            "one-sided",
            "k/(k - 2) == k",
            witness([None, Some("2")], None, Cause::Undefined),
        ),
        Report {
            page: Some("22-23".into()),
            why: Some("the argument must be negative: ln(1-z) at z = -V/Va".into()),
            mended: mended(
                "hyp2f1r(1, 1; 2; -V/Va) == Va*ln(Vb/Va)/V",
                "certificates/near.proof",
            ),
            ..wrong(
                "near",
                "hyp2f1r(1, 1; 2; V/Va) == Va*ln(Vb/Va)/V",
                witness(finite, Some(0.415), Cause::Disjoint),
            )
        },
        wrong(
            "far",
            "k^2 == 1/k",
            witness([Some("4"), Some("1/2")], Some(0.875), Cause::Disjoint),
        ),
        wrong(
            "infinite",
            "mean(1/r) == 2",
            witness([Some("+inf"), Some("2")], None, Cause::Disjoint),
        ),
    ]
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
