//! The values of `--set`.

use super::output::Failure;
use crate::evaluate::{self, Context, Outcome};
use crate::formula::{Budget, Formula, Name, Point, free_names, parse_formula};
use crate::number::convert::from_rug;

/// All of `--set k=5,n=10^3`; no name twice.
pub(super) fn settings(sets: &[String], budget: &Budget) -> Result<Vec<(Name, Formula)>, Failure> {
    let parts = sets.iter().flat_map(|set| split_at_commas(set));
    let settings = parts
        .map(|set| setting(set, budget))
        .collect::<Result<Vec<_>, _>>()?;
    for (index, (name, _)) in settings.iter().enumerate() {
        if settings[..index].iter().any(|(other, _)| other == name) {
            return Err(Failure::input(&format!("`{name}` is set twice"), None));
        }
    }
    Ok(settings)
}

/// The parts between the commas that are in no bracket.
fn split_at_commas(text: &str) -> Vec<&str> {
    let (mut depth, mut start, mut parts) = (0, 0, Vec::new());
    for (at, c) in text.char_indices() {
        match c {
            '(' | '[' => depth += 1,
            ')' | ']' => depth -= 1,
            ',' if depth == 0 => {
                parts.push(&text[start..at]);
                start = at + 1;
            }
            _ => {}
        }
    }
    parts.push(&text[start..]);
    parts
}

/// `NAME=EXPR`; a rational value is worked out, any other stays a formula.
fn setting(text: &str, budget: &Budget) -> Result<(Name, Formula), Failure> {
    let Some((name, value)) = text.split_once('=') else {
        let hint = Some("write --set k=5,n=10^3");
        return Err(Failure::input(&format!("`{text}` sets no name"), hint));
    };
    let formula = parse_formula(value).map_err(|error| Failure::at("--set", value, &error))?;
    if let Some(free) = free_names(&formula).first() {
        let message = format!("the value of `{}` needs `{free}`", name.trim());
        return Err(Failure::input(&message, Some("values hold numbers only")));
    }
    let (point, draws) = (Point::default(), []);
    let context = Context {
        point: &point,
        draws: &draws,
        budget,
    };
    let exact = match evaluate::exact(&formula, &context) {
        Ok(Outcome::Value(exact)) => exact.as_rational(),
        _ => None,
    };
    let number = exact.map(|rational| Formula::Number(from_rug(&rational)));
    Ok((name.trim().into(), number.unwrap_or(formula)))
}

#[cfg(test)]
mod tests {
    use super::split_at_commas;

    #[test]
    fn commas_inside_brackets_do_not_part() {
        assert_eq!(split_at_commas("k=5,n=beta(2,3)"), ["k=5", "n=beta(2,3)"]);
        assert_eq!(split_at_commas(""), [""]);
        assert_eq!(split_at_commas("a=1)),b=(2"), ["a=1)),b=(2"]);
    }
}
