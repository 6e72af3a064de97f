//! One relation at one point: exactly where both values are exact, else by enclosures.

use crate::evaluate::{self, Context, Failure, Outcome};
use crate::formula::{Budget, Formula, Relation};
use crate::number::{Exact, Interval};
use std::cmp::Ordering;

/// What a relation does at a point.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum AtPoint {
    /// It holds: exactly, or by enclosures that agree to so many digits (`==`) or lie apart (order).
    Holds { exact: bool },
    /// It fails as far as the evaluators can tell; both sides have a value, or just one has.
    Fails { both_valued: bool },
    /// Neither side has a value.
    SetAside,
    /// Nobody can tell, and why.
    Unknown(String),
    /// The values cost more steps or larger numbers than one point may take.
    TooCostly,
}

/// Steps that one point may take at first: some hundredths of a second, so that a handful of large
/// points cannot eat the budget of a claim.
pub const STEPS_A_POINT: u64 = 20_000;

/// The least working precision in bits, and the greatest as a multiple of what the digits ask for.
const FIRST_PRECISION: u32 = 64;
const MOST_PRECISION_FACTOR: u32 = 16;

/// Decides `left RELATION right` at the point of `context`, within `steps` for the exact values and as
/// many for enclosures, which must agree to `digits` digits.
pub fn relate(
    left: &Formula,
    relation: Relation,
    right: &Formula,
    context: &Context,
    digits: u32,
    steps: u64,
) -> AtPoint {
    let exact = allowance(context, steps, |context| {
        let sides = (
            evaluate::exact(left, context),
            evaluate::exact(right, context),
        );
        match sides {
            (Err(Failure::Exhausted), _) | (_, Err(Failure::Exhausted)) => AtPoint::TooCostly,
            (Ok(Outcome::Value(a)), Ok(Outcome::Value(b))) => match compare_exact(&a, &b) {
                Some(ordering) => settled(relation, ordering, true),
                None => AtPoint::Unknown("equal or not, the exact values do not tell".into()),
            },
            (Ok(a), Ok(b)) => relate_special(&a, relation, &b),
            (Err(failure), _) | (_, Err(failure)) => AtPoint::Unknown(failure.to_string()),
        }
    });
    if !matches!(exact, AtPoint::Unknown(_) | AtPoint::TooCostly) {
        return exact;
    }
    allowance(context, steps, |context| {
        relate_enclosed(left, relation, right, context, digits)
    })
}

/// Tries with the steps that a point may take, and charges what was spent.
fn allowance(context: &Context, steps: u64, attempt: impl Fn(&Context) -> AtPoint) -> AtPoint {
    let own = Budget::new(steps);
    let answer = attempt(&Context {
        budget: &own,
        ..*context
    });
    match context.budget.spend(own.spent()) {
        Ok(()) => answer,
        Err(_) => AtPoint::Unknown("the budget of steps is spent".into()),
    }
}

fn compare_exact(a: &Exact, b: &Exact) -> Option<Ordering> {
    a.sub(b).sign()
}

/// Both outcomes are known and at least one of them is no finite value.
fn relate_special<T>(a: &Outcome<T>, relation: Relation, b: &Outcome<T>) -> AtPoint {
    use Outcome::{MinusInfinity, PlusInfinity, Undefined, Value};
    let ordering = match (a, b) {
        (Undefined, Undefined) => return AtPoint::SetAside,
        (Undefined, _) | (_, Undefined) => return AtPoint::Fails { both_valued: false },
        (PlusInfinity, PlusInfinity) | (MinusInfinity, MinusInfinity) => Ordering::Equal,
        (PlusInfinity, _) | (_, MinusInfinity) => Ordering::Greater,
        (MinusInfinity, _) | (_, PlusInfinity) => Ordering::Less,
        (Value(_), Value(_)) => return AtPoint::Unknown("two finite values".into()),
    };
    settled(relation, ordering, true)
}

fn relate_enclosed(
    left: &Formula,
    relation: Relation,
    right: &Formula,
    context: &Context,
    digits: u32,
) -> AtPoint {
    // What `digits` digits take, with something to lose.
    let enough = digits.saturating_mul(4).max(FIRST_PRECISION);
    let most = enough.saturating_mul(MOST_PRECISION_FACTOR);
    let mut precision = FIRST_PRECISION;
    let mut reason = String::from("the enclosures overlap at every precision tried");
    while precision <= most {
        let sides = (
            evaluate::enclose(left, context, precision),
            evaluate::enclose(right, context, precision),
        );
        match sides {
            (Ok(Outcome::Value(a)), Ok(Outcome::Value(b))) => {
                if let Some(answer) = compare_enclosed(&a, relation, &b, digits) {
                    return answer;
                }
            }
            (Ok(a), Ok(b)) => return relate_special(&a, relation, &b),
            (Err(Failure::Exhausted | Failure::TooLarge(_)), _)
            | (_, Err(Failure::Exhausted | Failure::TooLarge(_))) => {
                return AtPoint::TooCostly;
            }
            (Err(Failure::Undecided(why)), _) | (_, Err(Failure::Undecided(why))) => reason = why,
            (Err(failure), _) | (_, Err(failure)) => return AtPoint::Unknown(failure.to_string()),
        }
        precision *= 2;
        // Fewer bits cannot make sides agree, and they did not tell them apart.
        if relation == Relation::Equal {
            precision = precision.max(enough);
        }
    }
    AtPoint::Unknown(reason)
}

/// `None`: more bits may decide.
fn compare_enclosed(
    a: &Interval,
    relation: Relation,
    b: &Interval,
    digits: u32,
) -> Option<AtPoint> {
    match a.sub(b).sign() {
        Some(ordering) if ordering != Ordering::Equal || (a.is_point() && b.is_point()) => {
            Some(settled(relation, ordering, false))
        }
        _ if relation == Relation::Equal && agree(a, b, digits) => {
            Some(AtPoint::Holds { exact: false })
        }
        _ => None,
    }
}

/// Two enclosures of what may be one number agree when both are narrower than asked and they overlap.
fn agree(a: &Interval, b: &Interval, digits: u32) -> bool {
    a.agrees_to(digits) && b.agrees_to(digits) && a.overlaps(b)
}

fn settled(relation: Relation, ordering: Ordering, exact: bool) -> AtPoint {
    let holds = match relation {
        Relation::Equal => ordering == Ordering::Equal,
        Relation::NotEqual => ordering != Ordering::Equal,
        Relation::Less => ordering == Ordering::Less,
        Relation::LessEqual => ordering != Ordering::Greater,
        Relation::Greater => ordering == Ordering::Greater,
        Relation::GreaterEqual => ordering != Ordering::Less,
        Relation::Asymptotic | Relation::Approximate => {
            return AtPoint::Unknown("an expansion says nothing at a single point".into());
        }
    };
    if holds {
        AtPoint::Holds { exact }
    } else {
        AtPoint::Fails { both_valued: true }
    }
}
