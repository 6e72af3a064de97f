//! Decimal text of an interval: only digits that are proved.
//!
//! Rounding to a fixed number of decimal digits is a monotone map. So where both ends round to the
//! same text, the value inside does too: the digits printed are the value's, correctly rounded.

use super::Interval;
use rug::Float;
use rug::float::Round;

/// A number from here on (ten to this power) is printed with an exponent.
const PLAIN_EXPONENT: i64 = 21;

/// A number below ten to minus this is printed with an exponent.
const PLAIN_ZEROS: i64 = 6;

/// No number is printed with more digits.
const MAX_DIGITS: usize = 1 << 22;

/// Digits of an end in the text of an interval without a common digit.
const END_DIGITS: usize = 5;

/// 0.DIGITS * 10^exponent, with a sign.
#[derive(PartialEq)]
struct Decimal {
    negative: bool,
    digits: String,
    exponent: i64,
}

fn rounded(value: &Float, digits: usize, round: Round) -> Decimal {
    let (negative, digits, exponent) = value.to_sign_string_exp_round(10, Some(digits), round);
    Decimal {
        negative: negative && !value.is_zero(),
        digits,
        exponent: exponent.map_or(0, i64::from),
    }
}

impl Decimal {
    /// The usual notation where it is short, else with a power of ten.
    fn text(&self, strip_zeros: bool) -> String {
        let mut digits = self.digits.as_str();
        if strip_zeros {
            digits = digits.trim_end_matches('0');
        }
        if digits.is_empty() {
            return "0".to_owned();
        }
        let sign = if self.negative { "-" } else { "" };
        let count = digits.len() as i64;
        let point = self.exponent;
        if point > PLAIN_EXPONENT.max(if strip_zeros { 0 } else { count })
            || point < 1 - PLAIN_ZEROS
        {
            let (first, rest) = digits.split_at(1);
            let dot = if rest.is_empty() { "" } else { "." };
            return format!("{sign}{first}{dot}{rest}e{}", point - 1);
        }
        if point <= 0 {
            return format!(
                "{sign}0.{}{digits}",
                "0".repeat(point.unsigned_abs() as usize)
            );
        }
        if point >= count {
            return self.whole_number(sign, digits, strip_zeros);
        }
        let (whole, fraction) = digits.split_at(point as usize);
        format!("{sign}{whole}.{fraction}")
    }

    /// A number without a fraction; where zeros that are not proved would be needed to reach the
    /// point, with a power of ten.
    fn whole_number(&self, sign: &str, digits: &str, exact: bool) -> String {
        let missing = (self.exponent - digits.len() as i64).unsigned_abs() as usize;
        if exact || missing == 0 {
            return format!("{sign}{digits}{}", "0".repeat(missing));
        }
        let (first, rest) = digits.split_at(1);
        let dot = if rest.is_empty() { "" } else { "." };
        format!("{sign}{first}{dot}{rest}e{}", self.exponent - 1)
    }
}

impl Interval {
    /// The value in decimal, at most `digits` significant digits, each proved: the text is the
    /// value correctly rounded to as many digits as are printed. Trailing zeros of an exact value
    /// are left off. Where not one digit is sure: `[low, high]`, rounded outwards.
    pub fn to_decimal(&self, digits: usize) -> String {
        if self.low.is_zero() && self.high.is_zero() {
            return "0".to_owned();
        }
        if !self.is_bounded() || self.contains_zero() {
            return self.ends_text();
        }
        let mut count = digits.clamp(1, self.common_digits().min(MAX_DIGITS));
        loop {
            let low = rounded(&self.low, count, Round::Nearest);
            let high = rounded(&self.high, count, Round::Nearest);
            if low == high {
                let exact = self.is_point() && is_exact(&self.low, count);
                return low.text(exact);
            }
            if count == 1 {
                return self.ends_text();
            }
            count -= 1;
        }
    }

    /// About how many digits the ends have in common, never too few by more than rounding; for
    /// a point as many as anyone may want.
    fn common_digits(&self) -> usize {
        let width = self.width();
        let (Some(wide), Some(size)) = (width.get_exp(), self.low.get_exp()) else {
            return MAX_DIGITS;
        };
        let bits = i64::from(size) - i64::from(wide) + 4;
        (bits.max(0) as usize) * 302 / 1000 + 2
    }

    fn ends_text(&self) -> String {
        let end = |value: &Float, round: Round| {
            if value.is_infinite() {
                let sign = if value.is_sign_negative() { "-" } else { "" };
                return format!("{sign}inf");
            }
            if value.is_zero() {
                return "0".to_owned();
            }
            rounded(value, END_DIGITS, round).text(false)
        };
        format!(
            "[{}, {}]",
            end(&self.low, Round::Down),
            end(&self.high, Round::Up)
        )
    }
}

/// Whether `count` decimal digits are the whole number: rounding down and up agree.
fn is_exact(value: &Float, count: usize) -> bool {
    rounded(value, count, Round::Down) == rounded(value, count, Round::Up)
}
