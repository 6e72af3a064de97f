//! Certified sweeps: against the exact methods photon by photon, against brute force, and from chunk to chunk.
#![cfg(feature = "engine")]

use claimcheck::model::Layout;
use claimcheck::probe::{Error, Journal, Probe, Question, Summary, Tally};
use claimcheck::special::shell::{Quantity, enclose_all};
use rug::Rational;

fn question(layout: &str, (first, last): (u64, u64), quantity: &str, claim: &str) -> Question {
    let text = |text: &str| (!text.is_empty()).then(|| text.to_owned());
    Question {
        layout: layout.to_owned(),
        first,
        last,
        quantity: text(quantity),
        claim: text(claim),
        ..Question::default()
    }
}

fn asked(question: Question) -> Summary {
    let probe = Probe::new(question).expect("a good question");
    let mut all = Summary::default();
    for chunk in 0..probe.chunks() {
        all.merge(&probe.ask(chunk).expect("within reach"));
    }
    all
}

/// What fails, of a claim.
fn failing(layout: &str, range: (u64, u64), claim: &str) -> Vec<u64> {
    let found = asked(question(layout, range, "", claim));
    let told = |link: &Tally| link.undecided.count + link.infinite.count == 0;
    assert!(found.links.iter().all(told), "{claim}");
    let mut all: Vec<u64> = found
        .links
        .iter()
        .flat_map(|l| l.violations.first.clone())
        .collect();
    all.sort_unstable();
    all.dedup();
    all
}

#[test]
fn the_conjecture_holds_from_4_on_and_not_before() {
    let claim = "1 + 1/k^2 < E_k < 1 + 1/k";
    for layout in ["triangular", "listing"] {
        assert_eq!(failing(layout, (4, 300_000), claim), [0; 0], "{layout}");
    }
    // E_3 = 3 - 3/2 ln 3 > 4/3.
    assert_eq!(failing("triangular", (2, 10), claim), [3]);
}

#[test]
fn extremes_are_those_of_brute_force() {
    for layout in [Layout::Triangular, Layout::Listing, Layout::One] {
        let name = match layout {
            Layout::Triangular => "triangular",
            Layout::Listing => "listing",
            _ => "one",
        };
        let found = asked(question(name, (10, 99), "k*Var_k", "")).decades()[&1].clone();
        let values = (10u64..100).map(|k| {
            let shell = layout.shell(&k.into()).expect("a photon");
            let [variance] = enclose_all([Quantity::Variance], &shell, 40).expect("finite");
            (k, variance.mul_integer(&k.into()).midpoint().to_f64())
        });
        let values: Vec<(u64, f64)> = values.collect();
        let least = values
            .iter()
            .min_by(|a, b| a.1.total_cmp(&b.1))
            .expect("some");
        let greatest = values
            .iter()
            .max_by(|a, b| a.1.total_cmp(&b.1))
            .expect("some");
        for (extreme, truth) in [(found.least, least), (found.greatest, greatest)] {
            let extreme = extreme.expect("found");
            assert_eq!(extreme.k, truth.0, "{name}");
            assert!(extreme.low <= truth.1 && truth.1 <= extreme.high);
            assert!(extreme.high - extreme.low < 1e-13 * truth.1.abs());
        }
    }
}

#[test]
fn a_planted_violation_is_found() {
    // Between E of two neighbours there is room for a bound that one k alone breaks.
    for k in [4_242u64, 123_456] {
        let shell = Layout::Triangular.shell(&k.into()).expect("a photon");
        let [excess] = enclose_all([Quantity::Excess], &shell, 40).expect("finite");
        let (low, _) = excess.ends_as_rationals().expect("bounded");
        // 1 + E_k - 1 - 10^-30 for this k, the upper bound of the conjecture for all others.
        let room = Rational::from(1) / k - low;
        let factor = Rational::from((1, 1_000_000_000));
        let (n, d) = (room.clone() + factor).into_numer_denom();
        let claim = format!("E_k < 1 + 1/k - {n}/{d}/(1 + 10^18*(k - {k})^2)");
        assert_eq!(failing("triangular", (4, 200_000), &claim), [k]);
    }
}

#[test]
fn close_calls_are_decided_with_more_digits() {
    // E_5 - 1 to 24 digits, as a bound from either side: doubles cannot tell.
    let shell = Layout::Triangular.shell(&5.into()).expect("a photon");
    let [excess] = enclose_all([Quantity::Excess], &shell, 60).expect("finite");
    let digits = excess.to_decimal(24);
    let found = |claim: &str| asked(question("triangular", (5, 5), "", claim));
    for claim in [
        format!("E_k - 1 < {digits}1"),
        format!("E_k - 1 > {digits}1"),
    ] {
        let summary = found(&claim);
        assert_eq!(summary.refined, 1);
        assert_eq!(summary.links[0].undecided.count, 0, "{claim}");
    }
    let both = ["<", ">"].map(|sign| {
        found(&format!("E_k - 1 {sign} {digits}1")).links[0]
            .violations
            .count
    });
    assert_eq!(both[0] + both[1], 1);
}

#[test]
fn identities_of_numbers_alone_and_of_functions() {
    assert_eq!(failing("5,7,9", (1, 21), "Va + l == k"), [0; 0]);
    assert_eq!(
        failing("triangular", (4, 500), "sqrt(k^2) >= k - 1"),
        [0; 0]
    );
    assert_eq!(failing("triangular", (4, 50), "ln(E_k) < 1/k"), [0; 0]);
    assert_eq!(
        failing("triangular", (2, 50), "max(k, 10) > 10"),
        (2..=10).collect::<Vec<_>>()
    );
    // A side without a value is no side: l - 1 is 0 at the first photon of each shell.
    let found = asked(question("triangular", (2, 4), "", "(l - 1)/(l - 1) == 1"));
    assert_eq!(found.links[0].undecided.first, [2, 4]);
}

#[test]
fn what_may_have_no_value_holds_nowhere() {
    // Each has no value somewhere, and a careless enclosure of it would do.
    for claim in [
        "abs(ln(E_k - 2)) >= 0",
        "exp(ln(E_k - 2)) > 0",
        "min(ln(E_k - 2), 3) <= 3",
        "0*ln(E_k - 2) == 0",
        "ln(E_k - 2)/ln(E_k - 2) == 1",
        "0*(1/(k - 5)) == 0",
        "(1/(k - 5))^0 == 1",
        "(k - 5)^(-1)*0 == 0",
        "E_k + 1/(k - 5) - 1/(k - 5) > 1",
        "exp((k - 5)/(k - 5)) > 1",
        "2 - (k - 5)/(k - 5) == 1",
        "0*sqrt(4 - k) == 0",
    ] {
        let found = asked(question("triangular", (5, 5), "", claim));
        assert_eq!(found.links[0].undecided.count, 1, "{claim}");
    }
    // A root may be 0.
    assert_eq!(failing("triangular", (2, 50), "(l - 1)^(1/2) >= 0"), [0; 0]);
    // What is infinite counts for no side, whatever cancels.
    for (layout, claim, first) in [
        ("triangular", "E_k == E_k", 1),
        ("triangular", "E_k < E_k + 1", 1),
        ("triangular", "0*E_k == 0", 1),
        ("triangular", "E_k^0 == 1", 1),
        ("triangular", "5 != min(E_k, 3)", 1),
        ("triangular", "(min(E_k, 3) - 5)^(-1) > -1", 1),
        ("9", "Var_k - Var_k >= 0", 2),
    ] {
        let found = asked(question(layout, (first, first), "", claim));
        assert_eq!(found.links[0].infinite.count, 1, "{claim}");
    }
    let found = asked(question("triangular", (2, 4), "(l - 1)^2/(l - 1)", ""));
    assert_eq!(found.decades()[&0].untold, 2);
    for formula in ["pi", "pi*k", "ln(k)^0", "1/(k - k)", "k^k", "k^(1/3)"] {
        let refused = Probe::new(question("one", (1, 2), formula, ""));
        assert!(matches!(refused, Err(Error::NotAsked(_))), "{formula}");
    }
}

#[test]
fn photons_without_a_finite_value_are_told_apart() {
    let found = asked(question("triangular", (1, 3), "", "E_k < 2"));
    assert_eq!(
        (found.photons, &found.links[0].infinite.first[..]),
        (3, &[1][..])
    );
    assert!(!found.links[0].holds());
    // The variance of photon 2 of one ball is infinite, its mean is not.
    let found = asked(question("9", (1, 9), "Var_k", "E_k > 1"));
    assert_eq!(found.decades()[&0].untold, 2);
    assert_eq!(found.links[0].infinite.first, [1]);
}

#[test]
fn numbers_beyond_doubles_are_decided() {
    assert_eq!(failing("triangular", (740, 1000), "exp(-k) > 0"), [0; 0]);
    assert_eq!(failing("triangular", (4, 20), "1/k^400 > 0"), [0; 0]);
    let found = asked(question("triangular", (700, 720), "exp(k)", "exp(k) > 1"));
    assert_eq!(found.decades()[&2].untold, 11);
    assert!(found.links[0].holds());
}

#[test]
fn bad_questions_are_told() {
    let refused = |layout, range, quantity, claim| {
        Probe::new(question(layout, range, quantity, claim)).expect_err("a bad question")
    };
    assert!(matches!(
        refused("spiral", (1, 2), "k", ""),
        Error::Layout(_)
    ));
    assert!(matches!(refused("3,0", (1, 2), "k", ""), Error::Layout(_)));
    assert!(matches!(
        refused("listing", (1, 2), "k", ""),
        Error::NoPhoton(1)
    ));
    assert!(matches!(
        refused("5,7", (6, 13), "k", ""),
        Error::NoPhoton(13)
    ));
    assert!(matches!(refused("one", (0, 2), "k", ""), Error::Range(..)));
    assert!(matches!(refused("one", (5, 2), "k", ""), Error::Range(..)));
    assert!(matches!(
        refused("one", (1, u64::MAX), "k", ""),
        Error::Range(..)
    ));
    assert!(matches!(
        refused("one", (1, 2), "k +", ""),
        Error::Syntax { .. }
    ));
    assert!(matches!(
        refused("one", (1, 2), "E_j", ""),
        Error::NotAsked(_)
    ));
    assert!(matches!(
        refused("one", (1, 2), "gamma(k)", ""),
        Error::NotAsked(_)
    ));
    assert!(matches!(
        refused("one", (1, 2), "", "E_k"),
        Error::Syntax { .. } | Error::NoChain
    ));
    assert!(matches!(
        refused("one", (1, 2), "", "E_k ~ 1 as k -> inf"),
        Error::NoChain
    ));
}

#[test]
fn journals_resume_and_shards_add_up() {
    let folder = tempfile();
    let path = |name: &str| folder.join(name);
    let range = (4, 3_000_000);
    let question = question("listing", range, "E_k - 1", "1 + 1/k^2 < E_k");
    let probe = Probe::new(question.clone()).expect("a good question");
    assert_eq!(probe.chunks(), 3);
    let ask = |journal: &mut Journal, chunk: u64| {
        let found = probe.ask(chunk).expect("within reach");
        journal.add(chunk, found).expect("written");
    };
    let mut whole = Journal::unwritten(&question);
    (0..3).for_each(|chunk| ask(&mut whole, chunk));

    // Killed in the middle of a line.
    let mut journal = Journal::open(&path("a"), &question).expect("new");
    ask(&mut journal, 2);
    drop(journal);
    let text = std::fs::read_to_string(path("a")).expect("there");
    let line = text.lines().last().expect("a chunk");
    std::fs::write(path("a"), format!("{text}{}", &line[..line.len() / 2])).expect("written");
    let mut journal = Journal::open(&path("a"), &question).expect("whole lines stay");
    assert_eq!(journal.done().collect::<Vec<_>>(), [2]);
    assert!(Journal::open(&path("a"), &question).is_err(), "two writers");
    ask(&mut journal, 1);
    ask(&mut journal, 0);
    assert_eq!(journal.summary(), whole.summary());
    assert_eq!(
        Journal::read(&path("a")).expect("there").summary(),
        whole.summary()
    );

    // Shards, joined in any order.
    let mut parts: Vec<Journal> = (0..3)
        .map(|chunk| {
            let mut part = Journal::open(&path(&format!("b{chunk}")), &question).expect("new");
            ask(&mut part, chunk);
            part
        })
        .collect();
    let mut all = parts.remove(1);
    for part in parts {
        all.join(part).expect("the same question");
    }
    assert_eq!(all.summary(), whole.summary());

    // A digit of a finding, or of the question, that has changed.
    let text = std::fs::read_to_string(path("b0")).expect("there");
    for (old, new) in [
        ("\"photons\":1", "\"photons\":2"),
        ("\"count\":0", "\"count\":1"),
        ("\"chunk\":0", "\"chunk\":1"),
        ("1/k^2 <", "1/k^3 <"),
    ] {
        assert!(text.contains(old), "{old}");
        std::fs::write(path("e"), text.replacen(old, new, 1)).expect("written");
        assert!(Journal::read(&path("e")).is_err(), "{old}");
    }
    assert!(Journal::open(&folder, &question).is_err(), "no file");

    // Nothing of anybody else's is overwritten.
    std::fs::write(path("c"), "dear diary").expect("written");
    assert!(Journal::open(&path("c"), &question).is_err());
    assert_eq!(
        std::fs::read_to_string(path("c")).expect("there"),
        "dear diary"
    );
    let other = Question {
        last: 99,
        ..question.clone()
    };
    assert!(Journal::open(&path("a"), &other).is_err());
    std::fs::write(path("d"), "").expect("written");
    assert!(Journal::open(&path("d"), &question).is_ok());
    std::fs::remove_dir_all(&folder).expect("ours");
}

/// A folder of this test's own.
fn tempfile() -> std::path::PathBuf {
    let folder = std::env::temp_dir().join(format!("claimcheck-probe-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("writable");
    folder
}

#[test]
fn a_sample_takes_both_ends_of_each_shell() {
    let whole = question("triangular", (5_000, 300_000), "E_k - 1", "E_k < 1 + 1/k");
    let sampled = Question {
        sample: Some(3),
        ..whole.clone()
    };
    let (all, some) = (asked(whole), asked(sampled));
    // Shells 100 to 774, of 24 photons each; the range cuts into the first and the last one.
    assert!(some.photons > 24 * 670 && some.photons <= 24 * 675);
    // The extremes of E_k lie at the ends of shells.
    assert_eq!(all.decades()[&5].least, some.decades()[&5].least);
    assert_eq!(all.decades()[&5].greatest, some.decades()[&5].greatest);
    // A shell of no more photons than the stretches hold is asked whole.
    let small = Question {
        sample: Some(2),
        ..question("9,16,5", (1, 30), "Var_k", "")
    };
    assert_eq!(asked(small).photons, 30);
}

#[test]
fn a_sample_does_not_depend_on_where_it_begins() {
    let asked_from = |first: u64| {
        let question = Question {
            sample: Some(4),
            shells: true,
            ..question("triangular", (first, 20_000), "E_k", "")
        };
        asked(question).shells
    };
    // Shell 150 is 11176..=11325; whatever comes before it does not matter.
    let (one, other) = (asked_from(9_000), asked_from(11_000));
    let later = |shells: &std::collections::BTreeMap<u64, _>| {
        shells
            .range(11_176..)
            .map(|(k, _)| *k)
            .collect::<Vec<u64>>()
    };
    assert_eq!(later(&one), later(&other));
    assert!(one.range(11_176..).eq(other.range(11_176..)));
    // A range that begins within a gap begins with the next stretch.
    assert_eq!(asked_from(11_190)[&11_176].photons, 24);
    assert_eq!(asked_from(11_316)[&11_176].photons, 8);
    assert_eq!(asked_from(11_320)[&11_176].photons, 6);
}

#[test]
fn shells_add_up_across_chunks_and_tell_their_extremes() {
    // The bound between two chunks, 2^20 photons on, lies within a shell.
    let question = Question {
        shells: true,
        ..question("triangular", (4, 1_100_000), "Var_k", "E_k < 1 + 1/k")
    };
    let found = asked(question);
    assert_eq!(found.shells.len(), 1483 - 3 + 1);
    assert_eq!(
        found
            .shells
            .values()
            .map(|shell| shell.photons)
            .sum::<u64>(),
        found.photons
    );
    let first = |m: u64| m * (m - 1) / 2 + 1;
    for m in [4, 100, 1448, 1449, 1450] {
        let shell = &found.shells[&first(m)];
        assert_eq!(shell.photons, m);
        let least = shell.least.expect("finite");
        assert!([first(m), first(m + 1) - 1].contains(&least.k), "{least:?}");
        assert!(least.low <= shell.greatest.expect("finite").high);
    }
}

#[test]
fn questions_about_too_many_shells_or_stretches_are_refused() {
    let whole = question("one", (1, 100), "E_k", "");
    let refused = |question: Question| Probe::new(question).err();
    let shells = |question: Question| Question {
        shells: true,
        ..question
    };
    assert!(matches!(
        refused(shells(whole.clone())),
        Some(Error::NoShells)
    ));
    let many = question("triangular", (1, 1_000_000_000_000_000), "E_k", "");
    assert!(matches!(refused(shells(many)), Some(Error::Shells(_))));
    for sample in [0, 1, 4097, u64::MAX] {
        let question = Question {
            sample: Some(sample),
            ..whole.clone()
        };
        assert!(matches!(refused(question), Some(Error::Sample(_))));
    }
    let one_each = Question {
        sample: Some(3),
        ..whole
    };
    assert!(matches!(refused(one_each), Some(Error::NoSample)));
}

#[test]
fn bins_are_tenths_of_a_decade() {
    use claimcheck::probe::bin;
    let mut k = 1;
    let mut starts = vec![];
    while k < 10_000 {
        let (first, next) = bin(k);
        assert_eq!(first, k);
        assert_eq!(bin(next - 1), (first, next));
        starts.push(first);
        k = next;
    }
    assert_eq!(starts.iter().filter(|&&start| start >= 1000).count(), 10);
    assert_eq!(starts.iter().filter(|&&start| start < 10).count(), 7);
    assert_eq!(bin(999_999_999_999_999).1, 1_000_000_000_000_000);
    bin(u64::MAX);
}
