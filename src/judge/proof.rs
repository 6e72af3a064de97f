//! Theorems: certificates that are kept are replayed, others searched for; and what a proof makes of
//! the findings at single points.

use super::Settings;
use super::finding::{Evidence, Finding, Proof};
use super::statement::{Trial, holds_at, is_open};
use super::verdict::Verdict;
use crate::formula::{Budget, Point, Proposition};
use crate::kernel::check_witness;
use crate::kernel::proof::{Certificate, Script, parse};
use crate::prover::identity;

/// So many points at which the statement holds are offered to the prover as examples.
const EXAMPLES: usize = 4;

/// Judges a proposition: refute, else prove, else certify. A kept certificate that is about this very
/// proposition, and still replays, is as good as one that is found.
pub fn decide(
    proposition: &Proposition,
    kept: &[Certificate],
    budget: &Budget,
    settings: &Settings,
) -> Finding {
    let theorem = || kept.iter().find_map(|kept| kept_proof(proposition, kept));
    if let Some(refuted) = kept
        .iter()
        .find_map(|kept| kept_refutation(proposition, kept))
    {
        return against(refuted, theorem());
    }
    let statement = proposition.pointwise();
    let mut trial = match Trial::new(proposition, &statement, budget, settings) {
        Ok(trial) => trial,
        Err(finding) => return *finding,
    };
    if trial.refuted() {
        return against(trial.whole(), theorem());
    }
    if !trial.may_be_proved() {
        return trial.whole();
    }
    let proof = theorem().filter(|proof| trial.leaves_expansions_only(proof.theorem.links()));
    let proof = proof.or_else(|| {
        search(
            proposition,
            &examples(proposition, &trial, budget, settings),
        )
    });
    match proof.or_else(theorem) {
        Some(proof) => {
            trial.prove(proof.theorem.links());
            let mut finding = trial.whole();
            if finding.verdict == Verdict::Proved && !proof.theorem.is_whole() {
                finding.verdict = Verdict::Certified;
            }
            finding.proof = Some(Box::new(proof));
            finding
        }
        None => trial.whole(),
    }
}

/// A refutation; what it refutes must not be proved.
fn against(mut refuted: Finding, proof: Option<Proof>) -> Finding {
    if let (Some(Evidence::Checked { witness, .. }), Some(proof)) = (&refuted.witness, proof) {
        refuted.contradiction = contradiction(proof.theorem.links(), witness.link, &witness.point);
    }
    refuted
}

/// What is to be said where a link is both proved and refuted.
fn contradiction(proved: &[usize], refuted: usize, at: &Point) -> Option<String> {
    let values = at.numbers.iter();
    let values: Vec<String> = values.map(|(name, v)| format!("{name} = {v}")).collect();
    proved.contains(&refuted).then(|| {
        format!(
            "the kernel replays a proof of link {}, and a witness that refutes it at {}",
            refuted + 1,
            values.join(", ")
        )
    })
}

fn kept_refutation(proposition: &Proposition, kept: &Certificate) -> Option<Finding> {
    let Certificate::Refutation {
        proposition: about,
        witness,
    } = kept
    else {
        return None;
    };
    let refutation = (about == proposition).then(|| check_witness(proposition, witness).ok())??;
    Some(Finding {
        witness: Some(Evidence::Checked {
            witness: witness.clone(),
            refutation: Box::new(refutation),
        }),
        ..Finding::plain(Verdict::Refuted)
    })
}

fn kept_proof(proposition: &Proposition, kept: &Certificate) -> Option<Proof> {
    match kept {
        Certificate::Theorem(script) => replayed(proposition, script.clone()),
        Certificate::Refutation { .. } => None,
    }
}

/// What the prover finds, as it is read back from its text: that is what will be replayed.
fn search(proposition: &Proposition, examples: &[Point]) -> Option<Proof> {
    let script = identity::prove(proposition, examples)?;
    match parse(&script.to_string()).ok()?.pop()? {
        Certificate::Theorem(script) => replayed(proposition, script),
        Certificate::Refutation { .. } => None,
    }
}

/// The theorem that the kernel makes of a script, if it is about the proposition.
fn replayed(proposition: &Proposition, script: Script) -> Option<Proof> {
    if script.proposition != *proposition {
        return None;
    }
    let theorem = script.check().ok()?;
    (theorem.proposition() == proposition).then_some(Proof { script, theorem })
}

/// Points that show that the statement is not true for want of values.
fn examples(
    proposition: &Proposition,
    trial: &Trial,
    budget: &Budget,
    settings: &Settings,
) -> Vec<Point> {
    let holds = |point: &&Point| holds_at(proposition, point, budget, settings) == Some(true);
    let points = || trial.points.iter();
    let held: Vec<Point> = points().filter(holds).take(EXAMPLES).cloned().collect();
    match held.is_empty() {
        true => points().take(EXAMPLES).cloned().collect(),
        false => held,
    }
}

impl Trial<'_> {
    fn refuted(&self) -> bool {
        let mut findings = self.findings.iter();
        findings.any(|finding| finding.verdict == Verdict::Refuted)
    }

    /// Whether there is something to prove and nothing that makes it worthless.
    fn may_be_proved(&self) -> bool {
        let mut findings = self.findings.iter();
        findings.all(|finding| is_open(finding.verdict))
    }

    /// Whether all links but the expansions are among these.
    fn leaves_expansions_only(&self, proved: &[usize]) -> bool {
        let mut parts = self.parts.iter().enumerate();
        parts.all(|(link, part)| part.is_expansion() || proved.contains(&link))
    }

    /// These links are proved.
    fn prove(&mut self, links: &[usize]) {
        for link in links {
            if let Some(finding) = self.findings.get_mut(*link) {
                *finding = Finding::plain(Verdict::Proved);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formula::parse_proposition;

    const SQUARE: &str = "given int k\nsays (k + 1)^2 == k^2 + 2*k + 1";

    fn theorem(proposition: &str) -> String {
        let says = proposition
            .split("says ")
            .last()
            .expect("it says something");
        format!("theorem\n{proposition}\nexample k = 1\nproof\n1: {says} | ring\nqed 1\n")
    }

    fn judged(proposition: &str, kept: &str) -> Finding {
        let proposition = parse_proposition(proposition).expect(proposition);
        let kept = match kept {
            "" => Vec::new(),
            kept => parse(kept).expect("certificates"),
        };
        let settings = Settings::default();
        decide(
            &proposition,
            &kept,
            &Budget::new(settings.budget),
            &settings,
        )
    }

    #[test]
    fn a_statement_is_proved_by_search_or_by_a_kept_certificate() {
        for kept in [String::new(), theorem(SQUARE)] {
            let finding = judged(SQUARE, &kept);
            assert_eq!(finding.verdict, Verdict::Proved, "{kept}");
            assert!(finding.proof.is_some_and(|proof| proof.theorem.is_whole()));
        }
    }

    #[test]
    fn a_stale_or_wrong_certificate_is_not_listened_to() {
        let wrong = "given int k\nsays k^2 == 2*k";
        for kept in [theorem(SQUARE), theorem(wrong)] {
            let finding = judged(wrong, &kept);
            assert_eq!(finding.verdict, Verdict::Refuted);
            assert_eq!(finding.contradiction, None);
        }
    }

    #[test]
    fn a_kept_witness_refutes_while_it_holds() {
        let wrong = "given int k\nsays k^2 == 2*k";
        let witness = |k: i32| format!("refutation\n{wrong}\nat k = {k}\nlink 1\n");
        for (k, kept) in [(7, true), (2, false)] {
            match judged(wrong, &witness(k)).witness {
                Some(Evidence::Checked { witness, .. }) => {
                    let at = witness.point.numbers["k"].to_string();
                    assert_eq!(at == k.to_string(), kept, "{at}");
                }
                other => panic!("{other:?}"),
            }
        }
    }

    #[test]
    fn a_link_that_is_proved_and_refuted_is_told() {
        let mut point = Point::default();
        point
            .numbers
            .insert("k".into(), crate::formula::Rational::from_integer(3.into()));
        let told = contradiction(&[0, 2], 2, &point).expect("link 3 is both");
        assert!(told.contains("link 3") && told.contains("k = 3"), "{told}");
        assert_eq!(contradiction(&[0, 2], 1, &point), None);
    }
}
