//! Joint limits of rational functions in two variables: `as n, k -> inf`, `as n, k, n/k -> inf`, and
//! `as k -> inf uniformly in n`.
//!
//! With `n = k t` where the domain gives n >= k or the limit n/k -> inf, else with n itself in the
//! place of t, everything is rational in two large variables: k -> inf, and t either tends to
//! infinity as well ("both grow") or is only known to be at least 1.
//!
//! *Criterion.* A polynomial with a monomial `c k^a t^b` such that every other monomial `k^i t^j` has
//! `i <= a`, `j <= b` and tends to 0 beside it (`(i, j) != (a, b)` when both grow, `i < a` when t is at
//! least 1 only) is that monomial times 1 + o(1), uniformly. If others with `i <= a`, `j <= b` do not
//! tend to 0 beside it but have coefficients of its own sign, the polynomial still lies between two
//! positive multiples of it, which is all that is used. Let the denominators of D and the gauges
//! be of this kind. Dividing the numerator of D by the leading monomials leaves monomials
//! `k^i t^j`, and D is O of the gauge when all have `i <= 0` and `j <= 0`, since then each is bounded;
//! it is o of it when each tends to 0: `(i, j) != (0, 0)` when both grow, `i < 0` else.
//!
//! *Necessity.* If some monomial breaks the rule, there is a path `t = c k^p` on which its exponent
//! `i + p j` is positive (zero, for o); for generic p the largest exponent of all monomials belongs to
//! one of them, for generic c it does not cancel. So a failure is sought along such paths, and
//! each is verified by itself as a limit of one variable: no failure rests on this argument.

use super::along::unused;
use super::asymptotics::{Case, ExpansionVerdict, path_text};
use super::domain::{Facts, Sign};
use super::expansion::{Expander, Obligation, Value};
use super::failure::Failure;
use super::{Approach, Reason, sample};
use crate::algebra::{Monomial, Polynomial, RationalFunction, Symbol};
use crate::formula::{Budget, Formula, Name, Operator, Target, Tendency};
use std::cell::RefCell;
use std::collections::BTreeMap;

/// How the second large variable behaves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Growth {
    /// It tends to infinity.
    Both,
    /// It is at least 1.
    AtLeastOne,
}

/// A joint limit, or a limit that is uniform in a second name.
struct Limit {
    /// k: tends to infinity.
    base: Name,
    /// n.
    other: Name,
    /// n is written `k t`.
    quotient: bool,
    growth: Growth,
    /// n tends to infinity by itself.
    other_grows: bool,
    /// n/k tends to infinity.
    quotient_grows: bool,
}

/// Eventually all large variables exceed this, which is used to show signs.
pub(super) const LARGE: i64 = 64;

/// The statement's sides as rational functions.
struct Exact {
    difference: RationalFunction,
    gauges: Vec<RationalFunction>,
    obligations: Vec<Obligation>,
    logarithms: BTreeMap<Symbol, Polynomial>,
}

/// Judges `as n, k -> inf` or `as n, k, n/k -> inf`.
pub(super) fn judge_joint(case: &Case<'_>, limit: &[Tendency]) -> Result<ExpansionVerdict, Reason> {
    let (mut names, mut quotient) = (Vec::new(), None);
    for tendency in limit {
        match (&tendency.quantity, &tendency.target) {
            (Formula::Name(name), Target::Infinity) => names.push(name.clone()),
            (Formula::Binary(Operator::Divide, above, below), Target::Infinity) => {
                match (&**above, &**below) {
                    (Formula::Name(above), Formula::Name(below)) => {
                        quotient = Some((above.clone(), below.clone()));
                    }
                    _ => return unread(),
                }
            }
            _ => return unread(),
        }
    }
    let [first, second] = &names[..] else {
        return unread();
    };
    if first == second {
        return unread();
    }
    for (name, other) in [(first, second), (second, first)] {
        let others = std::slice::from_ref(other);
        if let Some(why) = case.vacuous(&Approach::Infinity(name.clone()), others)? {
            return Ok(ExpansionVerdict::Vacuous { why });
        }
    }
    let limit = joint_limit(case, first, second, quotient)?;
    judge(case, &limit)
}

fn unread<T>() -> Result<T, Reason> {
    Err(Reason::Unsupported("a joint limit of this kind".into()))
}

fn joint_limit(
    case: &Case<'_>,
    first: &Name,
    second: &Name,
    quotient: Option<(Name, Name)>,
) -> Result<Limit, Reason> {
    let names = [(first, second), (second, first)];
    if let Some((above, below)) = quotient {
        if !names.contains(&(&above, &below)) {
            return unread();
        }
        return Ok(Limit {
            base: below,
            other: above,
            quotient: true,
            growth: Growth::Both,
            other_grows: true,
            quotient_grows: true,
        });
    }
    for (other, base) in names {
        if exceeds(case, other, base)? {
            return Ok(Limit {
                base: base.clone(),
                other: other.clone(),
                quotient: true,
                growth: Growth::AtLeastOne,
                other_grows: true,
                quotient_grows: false,
            });
        }
    }
    Ok(Limit {
        base: second.clone(),
        other: first.clone(),
        quotient: false,
        growth: Growth::Both,
        other_grows: true,
        quotient_grows: false,
    })
}

fn exceeds(case: &Case<'_>, other: &Name, base: &Name) -> Result<bool, Reason> {
    let difference = Polynomial::symbol(other).sub(&Polynomial::symbol(base));
    case.facts
        .shows(Sign::NonNegative, &difference, case.budget)
}

/// Judges `as k -> inf uniformly in n`.
pub(super) fn judge_uniform(
    case: &Case<'_>,
    base: &Name,
    other: &Name,
) -> Result<ExpansionVerdict, Reason> {
    let quotient = exceeds(case, other, base)?;
    let above_one = Polynomial::symbol(other).sub(&Polynomial::one());
    if !quotient
        && !case
            .facts
            .shows(Sign::NonNegative, &above_one, case.budget)?
    {
        return unread();
    }
    let limit = Limit {
        base: base.clone(),
        other: other.clone(),
        quotient,
        growth: Growth::AtLeastOne,
        other_grows: false,
        quotient_grows: false,
    };
    judge(case, &limit)
}

fn judge(case: &Case<'_>, limit: &Limit) -> Result<ExpansionVerdict, Reason> {
    let exact = exact(case)?;
    let why = match limit.holds(case, &exact) {
        Ok(None) => {
            return Ok(ExpansionVerdict::Holds {
                further: None,
                remainder: case.claimed(),
            });
        }
        Ok(Some(why)) => Reason::Undecided(why),
        Err(Reason::Exhausted) => return Err(Reason::Exhausted),
        Err(reason) => reason,
    };
    for path in limit.paths(case) {
        match along(case, limit, &exact, &path) {
            Ok(Some(verdict)) => return Ok(verdict),
            Err(Reason::Exhausted) => return Err(Reason::Exhausted),
            // A denominator may vanish on this path; another may do.
            Ok(None) | Err(_) => {}
        }
    }
    Err(why)
}

fn exact(case: &Case<'_>) -> Result<Exact, Reason> {
    let expander = Expander::new(None, 0, &case.proposition.draws, case.budget);
    let rational = |formula: &Formula| match expander.closed(formula)? {
        Value::Exact(value) => Ok(value),
        _ => Err(Reason::Unsupported(
            "a joint limit of what is no rational function".into(),
        )),
    };
    let difference = rational(&case.comparison.difference)?;
    let gauges: Result<Vec<_>, _> = case.comparison.gauges.iter().map(rational).collect();
    Ok(Exact {
        difference,
        gauges: gauges?,
        obligations: expander.obligations(),
        logarithms: expander.logarithms(),
    })
}

/// Exponents of k and t.
type Pair = (i64, i64);

impl Limit {
    fn second(&self) -> Symbol {
        match self.quotient {
            true => "#t".into(),
            false => self.other.clone(),
        }
    }

    /// A polynomial in the two large variables: n is replaced where it is written `k t`.
    fn large(&self, value: &Polynomial, budget: &Budget) -> Result<Polynomial, Reason> {
        match self.quotient {
            false => Ok(value.clone()),
            true => {
                let pair = Polynomial::symbol(&self.base)
                    .mul(&Polynomial::symbol(&self.second()), budget)?;
                Ok(value.substitute(&self.other, &pair, budget)?)
            }
        }
    }

    /// The coefficients of the monomials in the two large variables.
    fn monomials(
        &self,
        value: &Polynomial,
        budget: &Budget,
    ) -> Result<BTreeMap<Pair, Polynomial>, Reason> {
        let mut parts: BTreeMap<Pair, Polynomial> = BTreeMap::new();
        for (monomial, coefficient) in self.large(value, budget)?.terms() {
            let (i, rest) = monomial.split(&self.base);
            let (j, rest): (u32, Monomial) = rest.split(&self.second());
            let part = parts.entry((i64::from(i), i64::from(j))).or_default();
            part.add_term(rest, coefficient.clone());
        }
        Ok(parts)
    }

    /// Whether `k^i t^j` tends to 0.
    fn vanishes(&self, (i, j): Pair) -> bool {
        match self.growth {
            Growth::Both => i <= 0 && j <= 0 && (i, j) != (0, 0),
            Growth::AtLeastOne => i < 0 && j <= 0,
        }
    }

    /// The monomial that the polynomial is like, with its coefficient: beside it all others tend to
    /// 0, or are bounded and of the same sign.
    fn dominant(
        &self,
        facts: &Facts,
        value: &Polynomial,
        budget: &Budget,
    ) -> Result<Option<(Pair, Polynomial)>, Reason> {
        let parts = self.monomials(value, budget)?;
        'candidates: for ((a, b), head) in &parts {
            let mut beside = Vec::new();
            for ((i, j), part) in parts.iter().filter(|(pair, _)| **pair != (*a, *b)) {
                if i > a || j > b {
                    continue 'candidates;
                }
                if !self.vanishes((i - a, j - b)) {
                    beside.push(part);
                }
            }
            beside.push(head);
            if beside.len() == 1 || one_sign(facts, &beside, budget)? {
                return Ok(Some(((*a, *b), head.clone())));
            }
        }
        Ok(None)
    }

    /// Nothing when the criterion of the file's head is met; else what is not.
    fn holds(&self, case: &Case<'_>, exact: &Exact) -> Result<Option<String>, Reason> {
        let facts = self.facts(&case.facts);
        // A logarithm of n is no constant coefficient, which is what the criterion would take it for.
        let hidden = |obligation: &Obligation| {
            let symbols = obligation.polynomial.symbols();
            symbols
                .iter()
                .any(|symbol| exact.logarithms.contains_key(symbol))
        };
        if exact.obligations.iter().any(hidden) {
            return Ok(Some("logarithms in a joint limit".into()));
        }
        for obligation in &exact.obligations {
            if !self.shows(&facts, obligation.sign, &obligation.polynomial, case.budget)? {
                return Ok(Some(format!(
                    "not shown near the limit: {:?} of {}",
                    obligation.sign, obligation.polynomial
                )));
            }
        }
        let free = |value: &RationalFunction| {
            !value
                .symbols()
                .iter()
                .any(|symbol| exact.logarithms.contains_key(symbol))
        };
        if !free(&exact.difference) || !exact.gauges.iter().all(free) {
            return Ok(Some("logarithms in a joint limit".into()));
        }
        let mut gauges = Vec::new();
        for gauge in &exact.gauges {
            let Some(pair) = self.exponents(&facts, gauge, case.budget)? else {
                return Ok(Some("the gauge has no leading term".into()));
            };
            gauges.push(pair);
        }
        let Some(below) = self.denominator(&facts, &exact.difference, case.budget)? else {
            return Ok(Some(
                "the denominator of the difference has no leading term".into(),
            ));
        };
        let above = self.monomials(exact.difference.numerator(), case.budget)?;
        let fits = |pair: &Pair| {
            gauges.iter().any(|gauge| {
                let rest = (pair.0 - below.0 - gauge.0, pair.1 - below.1 - gauge.1);
                self.vanishes(rest) || (!case.comparison.little && rest.0 <= 0 && rest.1 <= 0)
            })
        };
        match above.keys().find(|pair| !fits(pair)) {
            None => Ok(None),
            Some(_) => Ok(Some("the difference is larger than claimed".into())),
        }
    }

    /// The domain near the limit.
    fn facts(&self, facts: &Facts) -> Facts {
        let mut facts = facts.clone();
        let large = |name: &Name| Polynomial::symbol(name).sub(&Polynomial::integer(LARGE));
        facts.assume_sign(large(&self.base), false);
        if self.other_grows {
            facts.assume_sign(large(&self.other), false);
        }
        if self.quotient_grows {
            let step = Polynomial::symbol(&self.base).scale(&rug::Rational::from(LARGE));
            facts.assume_sign(Polynomial::symbol(&self.other).sub(&step), false);
        }
        facts
    }

    fn shows(
        &self,
        facts: &Facts,
        sign: Sign,
        value: &Polynomial,
        budget: &Budget,
    ) -> Result<bool, Reason> {
        if facts.shows(sign, value, budget)? {
            return Ok(true);
        }
        let sign = if sign == Sign::NonNegative {
            Sign::Positive
        } else {
            sign
        };
        match self.dominant(facts, value, budget)? {
            Some((_, coefficient)) => facts.shows(sign, &coefficient, budget),
            None => Ok(false),
        }
    }

    /// The exponents of a denominator's leading monomial.
    fn denominator(
        &self,
        facts: &Facts,
        value: &RationalFunction,
        budget: &Budget,
    ) -> Result<Option<Pair>, Reason> {
        let mut total = (0, 0);
        for (atom, exponent) in value.denominator() {
            let Some((pair, coefficient)) = self.dominant(facts, atom, budget)? else {
                return Ok(None);
            };
            if !facts.shows(Sign::NonZero, &coefficient, budget)? {
                return Ok(None);
            }
            let exponent = i64::from(*exponent);
            total = (total.0 + pair.0 * exponent, total.1 + pair.1 * exponent);
        }
        Ok(Some(total))
    }

    fn exponents(
        &self,
        facts: &Facts,
        value: &RationalFunction,
        budget: &Budget,
    ) -> Result<Option<Pair>, Reason> {
        let Some((above, coefficient)) = self.dominant(facts, value.numerator(), budget)? else {
            return Ok(None);
        };
        let below = self.denominator(facts, value, budget)?;
        if !facts.shows(Sign::NonZero, &coefficient, budget)? {
            return Ok(None);
        }
        Ok(below.map(|below| (above.0 - below.0, above.1 - below.1)))
    }

    /// Paths on which a failure is sought.
    fn paths(&self, case: &Case<'_>) -> Vec<Path> {
        let k = Polynomial::symbol(&self.base);
        let power = |name: &Name, exponent| {
            let monomial = Monomial::power(name, exponent);
            Polynomial::term(monomial, rug::Rational::from(1))
        };
        let own = |n: Polynomial| Path {
            variable: self.base.clone(),
            values: vec![(self.other.clone(), n)],
        };
        let both = |n: u32, k: u32| {
            let variable = unused(case.proposition);
            let values = [(&self.base, k), (&self.other, n)];
            let values = values.map(|(name, e)| (name.clone(), power(&variable, e)));
            Path {
                variable,
                values: values.into(),
            }
        };
        let mut paths = Vec::new();
        if !self.quotient_grows {
            for factor in [1, 2, 3] {
                let straight = k.scale(&rug::Rational::from(factor));
                paths.push(own(straight));
            }
        }
        for exponent in [2, 3, 4, 6] {
            paths.push(own(power(&self.base, exponent)));
        }
        // n = k^(3/2) and n = k^(4/3).
        paths.extend([(3, 2), (4, 3)].map(|(n, k)| both(n, k)));
        if !self.quotient {
            paths.extend([2, 3, 4].map(|exponent| both(1, exponent)));
            if !self.other_grows {
                paths.push(Path {
                    variable: self.base.clone(),
                    values: Vec::new(),
                });
            }
        }
        paths
    }
}

/// Whether all are shown to be positive, or all negative.
fn one_sign(facts: &Facts, parts: &[&Polynomial], budget: &Budget) -> Result<bool, Reason> {
    let mut signs = (true, true);
    for part in parts {
        signs.0 = signs.0 && facts.shows(Sign::Positive, part, budget)?;
        signs.1 = signs.1 && facts.shows(Sign::Positive, &part.neg(), budget)?;
    }
    Ok(signs.0 || signs.1)
}

/// Values of k and n as polynomials in one variable that tends to infinity: k itself, or a name of
/// the path's own.
struct Path {
    variable: Name,
    values: Vec<(Name, Polynomial)>,
}

/// Judges the statement along one path, as a limit of one variable; nothing where it does not fail.
fn along(
    case: &Case<'_>,
    limit: &Limit,
    exact: &Exact,
    path: &Path,
) -> Result<Option<ExpansionVerdict>, Reason> {
    let approach = Approach::Infinity(path.variable.clone());
    // The leading coefficients of denominators, which must not vanish at the point either.
    let heads = RefCell::new(Vec::new());
    let leading = |value: &RationalFunction| -> Result<Option<(i64, RationalFunction)>, Reason> {
        let mut value = value.clone();
        for (name, image) in &path.values {
            value = value.substitute(name, &image.clone().into(), case.budget)?;
        }
        let above = approach.polynomial(value.numerator(), case.budget)?;
        let Some((mut exponent, head)) = above.leading() else {
            return Ok(None);
        };
        let mut head = head.clone();
        for (atom, count) in value.denominator() {
            let series = approach.polynomial(atom, case.budget)?;
            if let Some((shift, factor)) = series.leading() {
                heads.borrow_mut().push(factor.clone());
                exponent -= shift * i64::from(*count);
                head = head.mul(&factor.powi(-i64::from(*count), case.budget)?, case.budget)?;
            }
        }
        Ok(Some((exponent, head)))
    };
    let symbols = exact.difference.symbols();
    if symbols
        .iter()
        .any(|symbol| exact.logarithms.contains_key(symbol))
    {
        return Ok(None);
    }
    let Some((exponent, coefficient)) = leading(&exact.difference)? else {
        return Ok(None);
    };
    let (mut nonzero, mut weakest) = (vec![coefficient.clone()], i64::MAX);
    for gauge in &exact.gauges {
        if let Some((exponent, head)) = leading(gauge)? {
            weakest = weakest.min(exponent);
            nonzero.push(head);
        }
    }
    if exponent > weakest || (exponent == weakest && !case.comparison.little) {
        return Ok(None);
    }
    nonzero.extend(heads.take());
    let failure = Failure {
        approach: &approach,
        nonzero,
        signs: case.signs(&exact.obligations, &path.values)?,
        logarithms: &exact.logarithms,
        budget: case.budget,
    };
    // n is held fixed where the path does not move it.
    let mut without = vec![limit.base.clone()];
    without.extend(path.values.iter().map(|(name, _)| name.clone()));
    let point = failure.find(case.proposition, &case.facts, &without)?;
    Ok(point.map(|point| ExpansionVerdict::Fails {
        term: approach.term_text(&coefficient, exponent),
        order: approach.power_text(exponent),
        claimed: case.claimed(),
        numbers: sample::numbers(case, &approach, &point, &path.values),
        point,
        path: path_text(&path.values),
    }))
}
