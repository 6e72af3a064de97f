//! Trees as mathematics in LaTeX: what stands between the dollar signs. It needs amsmath only.

use crate::formula::{
    Condition, Draw, Duty, Formula, Function, Law, Name, Operator, RangeKind, Ranged, Regime,
    Relation, Statement, Target, Tendency,
};

/// How tightly a formula holds together; a fraction is an atom, but for powers.
mod level {
    pub const SUM: u8 = 1;
    /// Sums, integrals and limits: what follows them seems to belong to them.
    pub const LARGE: u8 = 2;
    pub const PRODUCT: u8 = 3;
    pub const UNARY: u8 = 4;
    pub const POWER: u8 = 5;
    pub const ATOM: u8 = 6;
}

/// A statement, its regime in words.
pub(super) fn statement(tree: &Statement) -> String {
    match tree {
        Statement::Chain {
            first,
            links,
            regime,
        } => chain(first, links) + &regime.as_ref().map(regime_words).unwrap_or_default(),
        Statement::All(items) => list(items, " \\quad\\text{and}\\quad ", statement),
        Statement::Definition {
            name,
            arguments,
            body,
            duties,
        } => {
            let arguments = match arguments.is_empty() {
                true => String::new(),
                false => format!("({})", list(arguments, ", ", |name| symbol(name))),
            };
            let duties = duties.iter().map(duty).collect::<String>();
            format!("{}{arguments} := {}{duties}", symbol(name), formula(body))
        }
        Statement::Conditional {
            id,
            condition: when,
        } => {
            format!("\\text{{{id} if }} {}", condition(when))
        }
        Statement::Words => "\\text{words}".to_owned(),
        Statement::Empty => "\\text{empty}".to_owned(),
    }
}

fn duty(duty: &Duty) -> String {
    let on = |word: &str, from: &Formula, to: &Formula| {
        format!(
            ",\\ \\text{{a {word} on }} [{}, {}]",
            formula(from),
            formula(to)
        )
    };
    match duty {
        Duty::Density(from, to) => on("density", from, to),
        Duty::Cumulative(from, to) => on("distribution function", from, to),
        Duty::Agrees(id) => format!(",\\ \\text{{as in {id}}}"),
    }
}

fn regime_words(regime: &Regime) -> String {
    let mut text = String::new();
    for (turn, limit) in regime.limits.iter().enumerate() {
        text += if turn == 0 {
            " \\quad\\text{as } "
        } else {
            " \\text{ then } "
        };
        text += &list(limit, ",\\ ", tendency);
    }
    if !regime.uniformly.is_empty() {
        text += " \\text{ uniformly in } ";
        text += &list(&regime.uniformly, ", ", |name| symbol(name));
    }
    if !regime.along.is_empty() {
        text += " \\text{ along } ";
        text += &list(&regime.along, ",\\ ", |(name, path)| {
            format!("{} = {}", symbol(name), formula(path))
        });
    }
    text
}

fn tendency(tendency: &Tendency) -> String {
    let target = match &tendency.target {
        Target::Infinity => "\\infty".to_owned(),
        Target::Point(at) => formula(at),
        Target::Above(at) => format!("{}^{{+}}", within(at, level::ATOM)),
        Target::Below(at) => format!("{}^{{-}}", within(at, level::ATOM)),
    };
    format!("{} \\to {target}", formula(&tendency.quantity))
}

fn chain(first: &Formula, links: &[(Relation, Formula)]) -> String {
    let mut text = formula(first);
    for (relation, right) in links {
        text += &format!(" {} {}", sign(*relation), formula(right));
    }
    text
}

fn sign(relation: Relation) -> &'static str {
    match relation {
        Relation::Equal => "=",
        Relation::NotEqual => "\\ne",
        Relation::Less => "<",
        Relation::LessEqual => "\\le",
        Relation::Greater => ">",
        Relation::GreaterEqual => "\\ge",
        Relation::Asymptotic => "\\sim",
        Relation::Approximate => "\\approx",
    }
}

/// A condition.
pub(super) fn condition(tree: &Condition) -> String {
    let part = |item: &Condition| match item {
        Condition::Chain(..) | Condition::Not(_) => condition(item),
        _ => format!("({})", condition(item)),
    };
    match tree {
        Condition::Chain(first, links) => chain(first, links),
        Condition::And(items) => list(items, " \\text{ and } ", part),
        Condition::Or(items) => list(items, " \\text{ or } ", part),
        Condition::Not(inner) => format!("\\text{{not }} {}", part(inner)),
    }
}

fn list<T>(items: &[T], separator: &str, show: impl Fn(&T) -> String) -> String {
    items.iter().map(show).collect::<Vec<_>>().join(separator)
}

fn bracketed(text: &str) -> String {
    delimited("(", text, ")")
}

/// Brackets, as high as what is in them where that is more than a line.
fn delimited(open: &str, text: &str, close: &str) -> String {
    let high = ["\\frac", "\\sum", "\\int", "\\binom", "\\left", "\\begin"];
    match high.iter().any(|part| text.contains(part)) {
        true => format!("\\left{open}{text}\\right{close}"),
        // TeX may break the line in these.
        false => format!("{open}{text}{close}"),
    }
}

fn level_of(tree: &Formula) -> u8 {
    match tree {
        Formula::Negate(_) => level::UNARY,
        Formula::Number(value) if *value < num_traits::Zero::zero() => level::UNARY,
        Formula::Binary(operator, ..) => match operator {
            Operator::Add | Operator::Subtract => level::SUM,
            Operator::Multiply => level::PRODUCT,
            Operator::Divide => level::ATOM,
            Operator::Power => level::POWER,
        },
        Formula::Ranged(_)
        | Formula::Antiderivative(..)
        | Formula::Derivative(..)
        | Formula::Limit(..) => level::LARGE,
        _ => level::ATOM,
    }
}

/// The formula, in brackets if it holds together less than `least`.
fn within(tree: &Formula, least: u8) -> String {
    let text = formula(tree);
    match level_of(tree) < least {
        true => bracketed(&text),
        false => text,
    }
}

fn formula(tree: &Formula) -> String {
    match tree {
        Formula::Number(_) => number(tree),
        Formula::Pi => "\\pi".to_owned(),
        Formula::Infinity => "\\infty".to_owned(),
        Formula::Name(name) => symbol(name),
        Formula::Apply(name, arguments) => {
            symbol(name) + &bracketed(&list(arguments, ", ", formula))
        }
        Formula::Negate(inner) => format!("-{}", within(inner, level::UNARY)),
        Formula::Binary(operator, left, right) => binary(*operator, left, right),
        Formula::Factorial(inner) => format!("{}!", base(inner)),
        Formula::Call(function, arguments) => call(*function, arguments),
        Formula::Ranged(ranged) => over_range(ranged),
        Formula::Antiderivative(body, name) => {
            format!("\\int {}\\,d{}", within(body, level::LARGE), symbol(name))
        }
        Formula::Derivative(body, name, order) => derivative(body, name, order),
        Formula::At(body, places) => {
            let places = list(places, ",\\ ", |(name, at)| {
                format!("{} = {}", symbol(name), formula(at))
            });
            format!("\\left.{}\\right|_{{{places}}}", formula(body))
        }
        Formula::Limit(body, places) => {
            let places = list(places, ",\\ ", |(name, at)| {
                format!("{} \\to {}", symbol(name), formula(at))
            });
            format!("\\lim_{{{places}}} {}", within(body, level::LARGE))
        }
        Formula::Indicator(inner) => format!("[{}]", condition(inner)),
        Formula::If(test, yes, no) => format!(
            "\\begin{{cases}}{} & \\text{{if }} {}\\\\ {} & \\text{{else}}\\end{{cases}}",
            formula(yes),
            condition(test),
            formula(no)
        ),
        Formula::Mean(body, draw) => moment("E", &formula(body), draw.as_deref()),
        Formula::Variance(body, draw) => moment("Var", &formula(body), draw.as_deref()),
        Formula::Probability(event, draw) => moment("P", &condition(event), draw.as_deref()),
        Formula::Density(quantity, at) => law_at("f", quantity, at),
        Formula::Cumulative(quantity, at) => law_at("F", quantity, at),
        Formula::BigO(inner) => format!("O{}", bracketed(&formula(inner))),
        Formula::LittleO(inner) => format!("o{}", bracketed(&formula(inner))),
        Formula::Truth(inner) => bracketed(&condition(inner)),
    }
}

/// A number as its canonical text, a fraction as one.
fn number(tree: &Formula) -> String {
    let text = tree.to_string();
    match text.split_once('/') {
        Some((above, below)) => format!("\\frac{{{above}}}{{{below}}}"),
        None => text,
    }
}

fn binary(operator: Operator, left: &Formula, right: &Formula) -> String {
    match operator {
        Operator::Add => format!("{} + {}", formula(left), within(right, level::LARGE)),
        Operator::Subtract => format!("{} - {}", formula(left), within(right, level::LARGE)),
        Operator::Multiply => {
            let (left, right) = (within(left, level::PRODUCT), within(right, level::POWER));
            // A digit would seem to belong to the number before it.
            let sign = match right.starts_with(|c: char| c.is_ascii_digit()) {
                true => " \\cdot ",
                false => "\\,",
            };
            format!("{left}{sign}{right}")
        }
        Operator::Divide => format!("\\frac{{{}}}{{{}}}", formula(left), formula(right)),
        Operator::Power => format!("{}^{{{}}}", base(left), formula(right)),
    }
}

/// What a power or a factorial is taken of.
fn base(tree: &Formula) -> String {
    let text = formula(tree);
    let is_one = match tree {
        Formula::Binary(..) => false,
        // Not to be read as `ln(x^2)`, and no `x!!`.
        Formula::Call(..) | Formula::Factorial(_) | Formula::If(..) | Formula::At(..) => {
            return format!("\\left({text}\\right)");
        }
        Formula::Number(_) => !text.starts_with(['-', '\\']),
        _ => level_of(tree) == level::ATOM,
    };
    match is_one {
        true => text,
        false => bracketed(&text),
    }
}

fn call(function: Function, arguments: &[Formula]) -> String {
    let all = || bracketed(&list(arguments, ", ", formula));
    match (function, arguments) {
        (Function::Abs, [x]) => format!("\\left|{}\\right|", formula(x)),
        (Function::Sqrt, [x]) => format!("\\sqrt{{{}}}", formula(x)),
        (Function::Exp, [x]) => format!("e^{{{}}}", formula(x)),
        (Function::Floor, [x]) => format!("\\left\\lfloor {}\\right\\rfloor", formula(x)),
        (Function::Binomial, [n, k]) => format!("\\binom{{{}}}{{{}}}", formula(n), formula(k)),
        (Function::Pochhammer, [a, n]) => {
            format!("\\left({}\\right)_{{{}}}", formula(a), formula(n))
        }
        (Function::Hyp2F1, [a, b, c, z]) => hypergeometric("F", [a, b, c, z]),
        (Function::Hyp2F1Regularized, [a, b, c, z]) => hypergeometric("\\tilde{F}", [a, b, c, z]),
        (Function::Ln, _) => format!("\\ln{}", all()),
        (Function::Sin, _) => format!("\\sin{}", all()),
        (Function::Cos, _) => format!("\\cos{}", all()),
        (Function::Gamma, _) => format!("\\Gamma{}", all()),
        (Function::LnGamma, _) => format!("\\ln\\Gamma{}", all()),
        (Function::Beta, _) => format!("\\mathrm{{B}}{}", all()),
        (Function::Min, _) => format!("\\min{}", all()),
        (Function::Max, _) => format!("\\max{}", all()),
        // The parser sees to the number of arguments.
        _ => format!("\\mathrm{{{}}}{}", function.name(), all()),
    }
}

fn hypergeometric(letter: &str, arguments: [&Formula; 4]) -> String {
    let [a, b, c, z] = arguments.map(formula);
    format!("{{}}_{{2}}{letter}_{{1}}\\left({a}, {b}; {c}; {z}\\right)")
}

fn over_range(ranged: &Ranged) -> String {
    let [from, to] = [&ranged.from, &ranged.to].map(formula);
    let (name, body) = (symbol(&ranged.name), within(&ranged.body, level::LARGE));
    match ranged.kind {
        RangeKind::Sum => format!("\\sum_{{{name} = {from}}}^{{{to}}} {body}"),
        RangeKind::Integral => format!("\\int_{{{from}}}^{{{to}}} {body}\\,d{name}"),
        RangeKind::Supremum => format!("\\sup_{{{from} \\le {name} \\le {to}}} {body}"),
        RangeKind::Infimum => format!("\\inf_{{{from} \\le {name} \\le {to}}} {body}"),
    }
}

fn derivative(body: &Formula, name: &Name, order: &Formula) -> String {
    let power = match order {
        Formula::Number(n) if num_traits::One::is_one(n) => String::new(),
        _ => format!("^{{{}}}", formula(order)),
    };
    let name = symbol(name);
    // In braces: the name may have a prime.
    format!(
        "\\frac{{d{power}}}{{d{{{name}}}{power}}} {}",
        within(body, level::LARGE)
    )
}

fn moment(word: &str, body: &str, draw: Option<&Draw>) -> String {
    let over = match draw {
        Some(draw) => format!("_{{{} \\sim {}}}", symbol(&draw.name), law(&draw.law)),
        None => String::new(),
    };
    format!(
        "\\operatorname{{{word}}}{over}{}",
        delimited("[", body, "]")
    )
}

fn law_at(letter: &str, quantity: &Formula, at: &Formula) -> String {
    format!(
        "{letter}_{{{}}}{}",
        formula(quantity),
        bracketed(&formula(at))
    )
}

fn law(law_of: &Law) -> String {
    match law_of {
        Law::Beta(a, b) => format!("\\mathrm{{Beta}}({}, {})", formula(a), formula(b)),
        Law::Uniform(a, b) => format!("\\mathrm{{U}}({}, {})", formula(a), formula(b)),
        Law::Order(l, m, inner) => format!(
            "\\text{{order statistic }} {} \\text{{ of }} {} \\text{{ from }} {}",
            formula(l),
            formula(m),
            law(inner)
        ),
        Law::Density {
            argument,
            body,
            from,
            to,
        } => format!(
            "\\text{{density }} {} \\text{{ of }} {} \\in [{}, {}]",
            formula(body),
            symbol(argument),
            formula(from),
            formula(to)
        ),
        Law::Any => "\\text{any law}".to_owned(),
    }
}

/// Names of Greek letters, as the claim language spells them.
const GREEK: [&str; 33] = [
    "alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta", "iota", "kappa",
    "lambda", "mu", "nu", "xi", "rho", "sigma", "tau", "upsilon", "phi", "chi", "psi", "omega",
    "Gamma", "Delta", "Theta", "Lambda", "Xi", "Sigma", "Upsilon", "Phi", "Psi", "Omega", "pi",
];

/// A name as a mathematician writes it: `Va` is V with the index a, `Ihat` is I with a hat, `E_k`
/// and `m1` have indices, `mu` is Greek.
fn symbol(name: &str) -> String {
    let stem = name.trim_end_matches('\'');
    let primes = &name[stem.len()..];
    let (head, index) = match stem.split_once('_') {
        Some((head, index)) if !head.is_empty() => {
            (head, index.trim_matches('_').replace('_', ","))
        }
        _ => short_index(stem),
    };
    let index = match (index.as_str(), letters(&index)) {
        ("", _) => String::new(),
        (_, index) => format!("_{{{index}}}"),
    };
    format!("{}{index}{primes}", letters(head))
}

/// `Va` and `m12` split into letter and index; other names are left whole.
fn short_index(stem: &str) -> (&str, String) {
    let mut rest = stem.chars();
    let first = rest.next().unwrap_or_default();
    let tail = rest.as_str();
    let is_digits = tail.chars().all(|c| c.is_ascii_digit());
    let is_letter = first.is_ascii_uppercase() && tail.len() == 1;
    match !tail.is_empty() && first.is_ascii_alphabetic() && (is_digits || is_letter) {
        true => (&stem[..1], tail.to_owned()),
        false => (stem, String::new()),
    }
}

/// One letter, a Greek one, one with a hat, or a word.
fn letters(text: &str) -> String {
    let hatted = text.strip_suffix("hat").filter(|stem| !stem.is_empty());
    match hatted {
        Some(stem) => format!("\\hat{{{}}}", letters(stem)),
        None if GREEK.contains(&text) => format!("\\{text} "),
        None if text.chars().count() <= 1 || text.chars().all(|c| c.is_ascii_digit()) => {
            text.to_owned()
        }
        None => format!("\\mathit{{{}}}", text.replace('_', "\\_")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formula::{parse_condition, parse_statement};

    fn math(text: &str) -> String {
        statement(&parse_statement(text).expect(text))
    }

    #[test]
    fn formulas_are_typeset() {
        let cases = [
            ("a == b/c", r"a = \frac{b}{c}"),
            ("2*(a + b)*3 == -x^2", r"2\,(a + b) \cdot 3 = -x^{2}"),
            (
                "(a/b)^2 == a - (b - c)",
                r"\left(\frac{a}{b}\right)^{2} = a - (b - c)",
            ),
            (
                "hyp2f1(1, l; m+1; -V/Va) == gamma(k)",
                r"{}_{2}F_{1}\left(1, l; m + 1; \frac{-V}{V_{a}}\right) = \Gamma(k)",
            ),
            ("mean(Ihat) == 0.05", r"\operatorname{E}[\hat{I}] = 0.05"),
            ("sum(j^2, j = 1..n) == 1", r"\sum_{j = 1}^{n} j^{2} = 1"),
            (
                "int(f(r) + 1, r = 0..inf) == 1",
                r"\int_{0}^{\infty} (f(r) + 1)\,dr = 1",
            ),
            ("diff(x^2, x) == 2*x", r"\frac{d}{d{x}} x^{2} = 2\,x"),
            ("ln(x)^2 == m1'", r"\left(\ln(x)\right)^{2} = m_{1}'"),
            (
                "E_k == I + O(1/k) as k -> inf",
                r"E_{k} = I + O\left(\frac{1}{k}\right) \quad\text{as } k \to \infty",
            ),
        ];
        for (text, expected) in cases {
            assert_eq!(math(text), expected, "{text}");
        }
        let needs = parse_condition("k >= 3 and not (k == 4 or k == 5)").expect("a condition");
        let expected = r"k \ge 3 \text{ and } \text{not } (k = 4 \text{ or } k = 5)";
        assert_eq!(condition(&needs), expected);
    }

    /// Every statement of the book has as many closing as opening braces and brackets, and none in
    /// between is closed before it is opened.
    #[test]
    fn the_whole_book_is_balanced() {
        let book = crate::book::read(&["proofs".into()]).expect("the book");
        assert!(!book.claims.is_empty());
        for claim in &book.claims {
            let text = math(&claim.says_text);
            let mut depth = 0i32;
            for c in text.replace("\\{", "").replace("\\}", "").chars() {
                depth += i32::from(c == '{') - i32::from(c == '}');
                assert!(depth >= 0, "{}: {text}", claim.id);
            }
            assert_eq!(depth, 0, "{}: {text}", claim.id);
            let count = |part: &str| text.matches(part).count();
            // `\lefteqn` and the like are not used, but `\lfloor` follows a `\left`.
            assert_eq!(count("\\left"), count("\\right"), "{}: {text}", claim.id);
        }
    }
}
