//! Equals for equals, under integrals, sums and means too.

use super::super::{Fact, Rejected, is_any, reject, require};
use super::{Check, Checked, General, depends, fits};
use crate::formula::{
    Condition, Draw, Formula, Law, Name, Part, RangeKind, Ranged, free_names, substitute,
};

/// A binder on the way down, and whether premises for its range may be used under it.
struct Crossed {
    name: Name,
    range: Option<Range>,
}

/// The range of a bound variable.
#[derive(Clone)]
struct Range {
    from: Formula,
    to: Formula,
    /// A premise must hold at the ends too.
    closed: bool,
    integer: bool,
}

type Known = Result<bool, Rejected>;

impl<'a> Check<'a, '_> {
    pub(super) fn congruence(&self) -> Checked {
        let (a, b) = self.equation()?;
        let premises: Vec<General> = (0..self.premises.len())
            .map(|i| self.premise(i))
            .collect::<Result<_, _>>()?;
        for premise in &premises {
            let fits = premise.variables.len() < 2 && matches!(premise.fact, Fact::Same(..));
            require(fits, "a premise is an equation for one variable at most")?;
        }
        let walk = Walk {
            check: self,
            premises,
        };
        match walk.same(a, b, &mut Vec::new())? {
            true => Ok(()),
            false => reject("the sides differ in more than the premises"),
        }
    }
}

struct Walk<'c, 'a, 'p> {
    check: &'c Check<'a, 'p>,
    premises: Vec<General<'a>>,
}

impl Walk<'_, '_, '_> {
    /// Whether two formulas are alike but for exchanged sides of premises.
    fn same(&self, a: &Formula, b: &Formula, under: &mut Vec<Crossed>) -> Known {
        self.check.proof.spend(self.premises.len().max(1) as u64)?;
        if a == b
            || self
                .premises
                .iter()
                .any(|premise| joins(premise, a, b, under))
        {
            return Ok(true);
        }
        match (a, b) {
            (Formula::Negate(a), Formula::Negate(b))
            | (Formula::Factorial(a), Formula::Factorial(b)) => self.same(a, b, under),
            (Formula::Binary(o, a, c), Formula::Binary(p, b, d)) if o == p => {
                Ok(self.same(a, b, under)? && self.same(c, d, under)?)
            }
            (Formula::Call(f, p), Formula::Call(g, q)) if f == g => self.each(p, q, under),
            (Formula::Apply(f, p), Formula::Apply(g, q)) if f == g => self.each(p, q, under),
            (Formula::Indicator(c), Formula::Indicator(d)) => self.conditions(c, d, under),
            (Formula::Ranged(r), Formula::Ranged(s)) if r.kind == s.kind => {
                self.ranges(r, s, under)
            }
            (Formula::Mean(a, None), Formula::Mean(b, None))
            | (Formula::Variance(a, None), Formula::Variance(b, None)) => {
                Ok(self.drawn(a) == self.drawn(b) && self.same(a, b, under)?)
            }
            (Formula::Mean(a, Some(x)), Formula::Mean(b, Some(y)))
            | (Formula::Variance(a, Some(x)), Formula::Variance(b, Some(y))) => {
                // A law that is not given is that of the draw of this name.
                let known = x.name == y.name || !is_any(Part::Law(&x.law));
                Ok(known && self.laws(&x.law, &y.law, under)? && self.means(a, x, b, y, under)?)
            }
            _ => Ok(false),
        }
    }

    /// The draws that a mean of the formula is over.
    fn drawn(&self, e: &Formula) -> Vec<&Name> {
        let names = free_names(e);
        let draws = self.check.proof.proposition.draws.iter();
        let names = draws.map(|d| &d.name).filter(|name| names.contains(*name));
        names.collect()
    }

    fn each(&self, a: &[Formula], b: &[Formula], under: &mut Vec<Crossed>) -> Known {
        let mut alike = a.len() == b.len();
        for (a, b) in a.iter().zip(b) {
            alike = alike && self.same(a, b, under)?;
        }
        Ok(alike)
    }

    fn conditions(&self, a: &Condition, b: &Condition, under: &mut Vec<Crossed>) -> Known {
        if let (Condition::And(p), Condition::And(q)) = (a, b) {
            let mut alike = p.len() == q.len();
            for (a, b) in p.iter().zip(q) {
                alike = alike && self.conditions(a, b, under)?;
            }
            return Ok(alike);
        }
        let (Condition::Chain(a, links), Condition::Chain(b, others)) = (a, b) else {
            return Ok(a == b);
        };
        let mut alike = links.len() == others.len() && self.same(a, b, under)?;
        for ((relation, a), (other, b)) in links.iter().zip(others) {
            alike = alike && relation == other && self.same(a, b, under)?;
        }
        Ok(alike)
    }

    fn ranges(&self, r: &Ranged, s: &Ranged, under: &mut Vec<Crossed>) -> Known {
        if !self.same(&r.from, &s.from, under)? || !self.same(&r.to, &s.to, under)? {
            return Ok(false);
        }
        let range = self.range(r, under)?;
        self.bodies((&r.body, &r.name), (&s.body, &s.name), range, under)
    }

    /// The range of an integral or sum, where premises for it may be used. An integral runs from
    /// its lower end, and between equal ends there is nothing that an open range would cover. A sum
    /// over a reversed range has no value, whatever its body.
    fn range(&self, r: &Ranged, under: &[Crossed]) -> Result<Option<Range>, Rejected> {
        let hidden = under
            .iter()
            .any(|c| depends(&r.from, &c.name) || depends(&r.to, &c.name));
        let range = |closed, integer| Range {
            from: r.from.clone(),
            to: r.to.clone(),
            closed,
            integer,
        };
        let proof = self.check.proof;
        let width = super::super::known::above(&r.from, &r.to);
        Ok(match r.kind {
            _ if hidden => None,
            RangeKind::Sum => Some(range(true, true)),
            RangeKind::Integral if !proof.finite(&width)? => None,
            RangeKind::Integral if proof.positive(&width)? => Some(range(false, false)),
            RangeKind::Integral if proof.nonnegative(&width)? => Some(range(true, false)),
            _ => None,
        })
    }

    /// A mean is over the open support of its law; without a law it has no value.
    fn means(
        &self,
        a: &Formula,
        x: &Draw,
        b: &Formula,
        y: &Draw,
        under: &mut Vec<Crossed>,
    ) -> Known {
        let range = support(&x.law).map(|(from, to)| Range {
            from,
            to,
            closed: false,
            integer: false,
        });
        let hidden = |range: &Range| {
            under
                .iter()
                .any(|c| depends(&range.from, &c.name) || depends(&range.to, &c.name))
        };
        let range = range.filter(|range| !hidden(range));
        self.bodies((a, &x.name), (b, &y.name), range, under)
    }

    fn laws(&self, a: &Law, b: &Law, under: &mut Vec<Crossed>) -> Known {
        match (a, b) {
            (Law::Beta(a, b), Law::Beta(c, d)) | (Law::Uniform(a, b), Law::Uniform(c, d)) => {
                Ok(self.same(a, c, under)? && self.same(b, d, under)?)
            }
            (Law::Order(l, m, a), Law::Order(i, n, b)) => {
                Ok(self.same(l, i, under)? && self.same(m, n, under)? && self.laws(a, b, under)?)
            }
            _ => Ok(a == b),
        }
    }

    /// Two bodies under their binders. The bound variable takes the name of a premise's variable
    /// that runs through the same range.
    fn bodies(
        &self,
        (a, x): (&Formula, &Name),
        (b, y): (&Formula, &Name),
        range: Option<Range>,
        under: &mut Vec<Crossed>,
    ) -> Known {
        let fitting = range.as_ref().and_then(|range| {
            self.premises.iter().find(|premise| {
                premise.variables.len() == 1
                    && fits(
                        premise,
                        (&range.from, &range.to),
                        range.closed,
                        range.integer,
                    )
            })
        });
        let name = fitting.map_or(x, |premise| &premise.variables[0].name);
        let free = |body: &Formula, own: &Name| own == name || !depends(body, name);
        require(
            free(a, x) && free(b, y),
            "the bound variable's new name is in use",
        )?;
        let there = Formula::Name(name.clone());
        let a = substitute(a, &[(x.clone(), there.clone())])?;
        let b = substitute(b, &[(y.clone(), there)])?;
        under.push(Crossed {
            name: name.clone(),
            range,
        });
        let alike = self.same(&a, &b, under);
        under.pop();
        alike
    }
}

/// Whether the premise says that a and b are the same, under these binders.
fn joins(premise: &General, a: &Formula, b: &Formula, under: &[Crossed]) -> bool {
    let Fact::Same(left, right) = premise.fact else {
        return false;
    };
    if !((left == a && right == b) || (left == b && right == a)) {
        return false;
    }
    let names = premise.fact.names();
    let own = premise.variables.first().map(|variable| &variable.name);
    let hides = |crossed: &Crossed| names.contains(&crossed.name) && own != Some(&crossed.name);
    if under.iter().any(hides) {
        return false;
    }
    let Some(own) = own else {
        return premise.hypotheses.is_empty();
    };
    // Its own variable is bound by the innermost binder of that name.
    let binder = under.iter().rev().find(|crossed| crossed.name == *own);
    binder
        .and_then(|binder| binder.range.as_ref())
        .is_some_and(|range| {
            fits(
                premise,
                (&range.from, &range.to),
                range.closed,
                range.integer,
            )
        })
}

/// The ends of a law's support.
fn support(law: &Law) -> Option<(Formula, Formula)> {
    match law {
        Law::Beta(..) => Some((Formula::integer(0), Formula::integer(1))),
        Law::Uniform(from, to) | Law::Density { from, to, .. } => Some((from.clone(), to.clone())),
        Law::Order(_, _, of) => support(of),
        Law::Any => None,
    }
}
