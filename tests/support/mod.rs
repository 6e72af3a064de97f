//! Generators of exactly those trees that the parser can produce, for `proptest`.

use claimcheck::formula::{
    Condition, Draw, Duty, Formula, Function, FunctionKind, Law, Name, Operator, Parameter,
    ParameterKind, Proposition, RangeKind, Ranged, Rational, Regime, Relation, Statement, Target,
    Tendency,
};
use proptest::collection::{btree_map, btree_set, vec};
use proptest::option;
use proptest::prelude::*;
use proptest::sample::select;

/// Names that are no words of the language.
pub fn name() -> impl Strategy<Value = Name> {
    let names = [
        "a", "k", "n", "x", "y", "x'", "V_a", "Ihat", "_1", "on", "of",
    ];
    select(names.to_vec()).prop_map(Name::from)
}

/// Numbers that a text can denote: decimals that are not negative.
pub fn number() -> impl Strategy<Value = Rational> {
    (0i64..100_000, 0u32..6)
        .prop_map(|(digits, places)| Rational::new(digits.into(), 10i64.pow(places).into()))
}

fn leaf() -> impl Strategy<Value = Formula> {
    prop_oneof![
        4 => name().prop_map(Formula::Name),
        4 => number().prop_map(Formula::Number),
        1 => Just(Formula::Pi),
        1 => Just(Formula::Infinity),
    ]
}

/// Formulas as texts can denote them.
pub fn formula() -> BoxedStrategy<Formula> {
    leaf()
        .prop_recursive(5, 40, 4, |inner| {
            let inner = inner.boxed();
            prop_oneof![
                6 => operation(inner.clone()),
                2 => call(inner.clone()),
                2 => form(inner.clone()),
                1 => random(inner),
            ]
        })
        .boxed()
}

fn operation(inner: BoxedStrategy<Formula>) -> impl Strategy<Value = Formula> {
    let operators = [
        Operator::Add,
        Operator::Subtract,
        Operator::Multiply,
        Operator::Divide,
        Operator::Power,
    ];
    prop_oneof![
        6 => (select(operators.to_vec()), inner.clone(), inner.clone())
            .prop_map(|(operator, a, b)| Formula::binary(operator, a, b)),
        1 => inner.clone().prop_map(|e| Formula::Negate(Box::new(e))),
        1 => inner.prop_map(|e| Formula::Factorial(Box::new(e))),
    ]
}

fn call(inner: BoxedStrategy<Formula>) -> impl Strategy<Value = Formula> {
    let known =
        (select(Function::ALL.to_vec()), vec(inner.clone(), 5)).prop_map(|(function, list)| {
            let more = usize::from(matches!(function, Function::Min | Function::Max));
            let list = list.into_iter().take(function.arity() + more).collect();
            Formula::Call(function, list)
        });
    prop_oneof![
        known,
        (name(), vec(inner.clone(), 1..4)).prop_map(|(name, list)| Formula::Apply(name, list)),
        inner.clone().prop_map(|e| Formula::BigO(Box::new(e))),
        inner.prop_map(|e| Formula::LittleO(Box::new(e))),
    ]
}

fn form(inner: BoxedStrategy<Formula>) -> impl Strategy<Value = Formula> {
    let kinds = [
        RangeKind::Sum,
        RangeKind::Integral,
        RangeKind::Supremum,
        RangeKind::Infimum,
    ];
    let e = inner.clone();
    let ranged = (
        select(kinds.to_vec()),
        e.clone(),
        name(),
        e.clone(),
        e.clone(),
    )
        .prop_map(|(kind, body, name, from, to)| {
            Formula::Ranged(Box::new(Ranged {
                kind,
                body,
                name,
                from,
                to,
            }))
        });
    let list = btree_map(name(), e.clone(), 1..3).prop_map(|map| map.into_iter().collect());
    let list = list.boxed();
    prop_oneof![
        ranged,
        (e.clone(), name()).prop_map(|(e, x)| Formula::Antiderivative(Box::new(e), x)),
        (e.clone(), name(), e.clone()).prop_map(|(e, x, n)| Formula::Derivative(
            Box::new(e),
            x,
            Box::new(n)
        )),
        (e.clone(), list.clone()).prop_map(|(e, list)| Formula::At(Box::new(e), list)),
        (e.clone(), list).prop_map(|(e, list)| Formula::Limit(Box::new(e), list)),
        condition_of(e.clone()).prop_map(|c| Formula::Indicator(Box::new(c))),
        condition_of(e.clone()).prop_map(|c| Formula::Truth(Box::new(c))),
        (condition_of(e.clone()), e.clone(), e).prop_map(|(c, a, b)| Formula::If(
            Box::new(c),
            Box::new(a),
            Box::new(b)
        )),
    ]
}

fn random(inner: BoxedStrategy<Formula>) -> impl Strategy<Value = Formula> {
    let e = inner.clone();
    let draw = option::of(
        (name(), law_of(e.clone())).prop_map(|(name, law)| Box::new(Draw { name, law })),
    )
    .boxed();
    prop_oneof![
        (e.clone(), draw.clone()).prop_map(|(e, draw)| Formula::Mean(Box::new(e), draw)),
        (e.clone(), draw.clone()).prop_map(|(e, draw)| Formula::Variance(Box::new(e), draw)),
        (condition_of(e.clone()), draw)
            .prop_map(|(c, draw)| Formula::Probability(Box::new(c), draw)),
        (e.clone(), e.clone()).prop_map(|(a, b)| Formula::Density(Box::new(a), Box::new(b))),
        (e.clone(), e).prop_map(|(a, b)| Formula::Cumulative(Box::new(a), Box::new(b))),
    ]
}

fn relation() -> impl Strategy<Value = Relation> {
    select(
        &[
            Relation::Equal,
            Relation::NotEqual,
            Relation::Less,
            Relation::LessEqual,
            Relation::Greater,
            Relation::GreaterEqual,
        ][..],
    )
}

/// Conditions as texts can denote them.
pub fn condition() -> BoxedStrategy<Condition> {
    condition_of(formula())
}

fn condition_of(inner: BoxedStrategy<Formula>) -> BoxedStrategy<Condition> {
    let chain = (inner.clone(), vec((relation(), inner), 1..3))
        .prop_map(|(first, links)| Condition::Chain(first, links));
    chain
        .prop_recursive(2, 6, 3, |inner| {
            prop_oneof![
                vec(inner.clone(), 2..4).prop_map(Condition::And),
                vec(inner.clone(), 2..4).prop_map(Condition::Or),
                inner.prop_map(|c| Condition::Not(Box::new(c))),
            ]
        })
        .boxed()
}

/// Laws as texts can denote them.
pub fn law() -> BoxedStrategy<Law> {
    law_of(formula())
}

fn law_of(inner: BoxedStrategy<Formula>) -> BoxedStrategy<Law> {
    let e = inner.clone();
    let density =
        (name(), e.clone(), e.clone(), e.clone()).prop_map(|(argument, body, from, to)| {
            Law::Density {
                argument,
                body,
                from,
                to,
            }
        });
    let simple = prop_oneof![
        (e.clone(), e.clone()).prop_map(|(a, b)| Law::Beta(a, b)),
        (e.clone(), e.clone()).prop_map(|(a, b)| Law::Uniform(a, b)),
        density,
        Just(Law::Any),
    ];
    simple
        .prop_recursive(2, 3, 1, move |law| {
            (inner.clone(), inner.clone(), law)
                .prop_map(|(l, m, law)| Law::Order(l, m, Box::new(law)))
        })
        .boxed()
}

fn target() -> impl Strategy<Value = Target> {
    let finite = || {
        formula().prop_filter("a limit at infinity has no side", |e| {
            *e != Formula::Infinity
        })
    };
    prop_oneof![
        Just(Target::Infinity),
        finite().prop_map(Target::Point),
        finite().prop_map(Target::Above),
        finite().prop_map(Target::Below),
    ]
}

/// Regimes as texts can denote them.
pub fn regime() -> impl Strategy<Value = Regime> {
    let tendency =
        (formula(), target()).prop_map(|(quantity, target)| Tendency { quantity, target });
    let limits = vec(vec(tendency, 1..3), 0..3);
    let uniformly = btree_set(name(), 0..3);
    let along = btree_map(name(), formula(), 0..3);
    (limits, uniformly, along)
        .prop_map(|(limits, uniformly, along)| Regime {
            limits,
            uniformly: uniformly.into_iter().collect(),
            along: along.into_iter().collect(),
        })
        .prop_filter("a regime says something", |regime| {
            *regime != Regime::default()
        })
}

fn chain() -> impl Strategy<Value = Statement> {
    let asymptotic = select(&[Relation::Asymptotic, Relation::Approximate][..]);
    let relation = prop_oneof![4 => relation(), 1 => asymptotic];
    (
        formula(),
        vec((relation, formula()), 1..4),
        option::of(regime()),
    )
        .prop_map(|(first, links, regime)| Statement::Chain {
            first,
            links,
            regime,
        })
}

fn id() -> impl Strategy<Value = Name> {
    let ids = ["2.14", "2.103-strategy-2", "tab-2.2-phi-2D", "A.1"];
    select(ids.to_vec()).prop_map(Name::from)
}

fn definition() -> impl Strategy<Value = Statement> {
    let duty = prop_oneof![
        (formula(), formula()).prop_map(|(a, b)| Duty::Density(a, b)),
        (formula(), formula()).prop_map(|(a, b)| Duty::Cumulative(a, b)),
        id().prop_map(Duty::Agrees),
    ];
    (name(), btree_set(name(), 0..3), formula(), vec(duty, 0..3)).prop_map(
        |(name, arguments, body, duties)| Statement::Definition {
            name,
            arguments: arguments.into_iter().collect(),
            body,
            duties,
        },
    )
}

/// Statements as texts can denote them.
pub fn statement() -> impl Strategy<Value = Statement> {
    let single = || prop_oneof![3 => chain(), 1 => definition()];
    let conditional =
        || (id(), condition()).prop_map(|(id, condition)| Statement::Conditional { id, condition });
    prop_oneof![
        6 => single(),
        2 => vec(single(), 2..4).prop_map(Statement::All),
        1 => conditional(),
        1 => Just(Statement::Words),
        1 => Just(Statement::Empty),
    ]
}

fn parameter() -> impl Strategy<Value = Parameter> {
    let kinds = [
        FunctionKind::Continuous,
        FunctionKind::Integrable,
        FunctionKind::Smooth(2),
        FunctionKind::Polynomial,
        FunctionKind::Density,
    ];
    let function = (name(), select(kinds.to_vec()), formula(), formula()).prop_map(
        |(argument, kind, from, to)| ParameterKind::Function {
            argument,
            kind,
            from,
            to,
        },
    );
    let kind = prop_oneof![
        2 => Just(ParameterKind::Integer),
        2 => Just(ParameterKind::Real),
        1 => function,
    ];
    (name(), kind).prop_map(|(name, kind)| Parameter { name, kind })
}

/// Propositions as canonical texts can denote them; their names need not make sense.
pub fn proposition() -> impl Strategy<Value = Proposition> {
    let draw = (name(), law()).prop_map(|(name, law)| Draw { name, law });
    (
        vec(parameter(), 0..4),
        vec(condition(), 0..3),
        vec(draw, 0..3),
        statement(),
    )
        .prop_map(|(parameters, domain, draws, statement)| Proposition {
            parameters,
            domain,
            draws,
            statement,
        })
}
