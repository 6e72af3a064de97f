//! Where numbers lie along an axis, and which are written there.

use super::Scale;

/// An axis with its range, from 0 to 1.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Ruler {
    scale: Scale,
    from: f64,
    to: f64,
}

/// A line across the panel, and what is written there.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Tick {
    pub(super) value: f64,
    pub(super) label: Label,
}

#[derive(Clone, Debug, PartialEq)]
pub(super) enum Label {
    Plain(String),
    /// 10 to this power.
    Power(i32),
    /// A minor tick.
    None,
}

/// A tick so little beyond an end lies on it.
const SLACK: f64 = 1e-9;

impl Ruler {
    /// Holds all the values that the scale can show, and at either end such a share of their range as room.
    pub(super) fn new(scale: Scale, values: impl Iterator<Item = f64>, share: f64) -> Ruler {
        let shown = |x: &f64| x.is_finite() && (scale == Scale::Linear || *x > 0.0);
        let ends = values.filter(shown).fold(None, |ends, x| match ends {
            None => Some((x, x)),
            Some((low, high)) => Some((x.min(low), x.max(high))),
        });
        let (low, high) = ends.unwrap_or((1.0, 10.0));
        let (from, to) = match scale {
            Scale::Linear => (low, high),
            Scale::Log => (low.log10(), high.log10()),
        };
        let room = match to - from {
            0.0 => from.abs().max(1.0) * 0.05,
            width => width * share,
        };
        Ruler {
            scale,
            from: from - room,
            to: to + room,
        }
    }

    /// The place of a number, where 0 is the one end and 1 the other; `None` where it has none.
    pub(super) fn place(&self, value: f64) -> Option<f64> {
        let value = match self.scale {
            Scale::Linear => value,
            Scale::Log if value > 0.0 => value.log10(),
            Scale::Log => return None,
        };
        let place = (value - self.from) / (self.to - self.from);
        place.is_finite().then_some(place)
    }

    /// Those with a label are about so many.
    pub(super) fn ticks(&self, count: f64) -> Vec<Tick> {
        let mut ticks = match self.scale {
            Scale::Linear => even(self.from, self.to, count),
            Scale::Log if self.to - self.from < 1.5 => {
                // Round numbers, where powers of ten are too few.
                even(10f64.powf(self.from), 10f64.powf(self.to), count)
            }
            Scale::Log => powers(self.from, self.to, count),
        };
        ticks.retain(|tick| {
            self.place(tick.value)
                .is_some_and(|place| (-SLACK..=1.0 + SLACK).contains(&place))
        });
        ticks
    }
}

/// Multiples of 1, 2 or 5 times a power of ten.
fn even(from: f64, to: f64, count: f64) -> Vec<Tick> {
    let rough = (to - from) / count;
    let power = rough.log10().floor();
    let unit = 10f64.powf(power);
    let factor = [1.0, 2.0, 5.0, 10.0]
        .into_iter()
        .find(|factor| factor * unit >= rough)
        .unwrap_or(10.0);
    let step = factor * unit;
    if !(step.is_finite() && step > 0.0) {
        return vec![];
    }
    // So many digits after the point tell neighbours apart.
    let places = (-(step.log10() + 1e-9).floor()).max(0.0) as usize;
    let largest = from.abs().max(to.abs());
    let digits = ((largest / step).log10().floor().max(0.0) as usize + 1).min(17);
    let first = (from / step - SLACK).ceil();
    let steps = ((to / step + SLACK).floor() - first).clamp(0.0, 100.0) as u32;
    (0..=steps)
        .map(|index| {
            let value = (first + f64::from(index)) * step;
            Tick {
                value,
                label: Label::Plain(plain(value, places, digits)),
            }
        })
        .collect()
}

/// With so many digits after the point, or as so many digits and a power of ten where that is shorter.
fn plain(value: f64, places: usize, digits: usize) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let whole = format!("{value:.places$}");
    let power = format!("{value:.*e}", digits - 1);
    match whole.len() <= 9 || whole.len() <= power.len() {
        true => whole,
        false => power,
    }
}

/// Powers of ten, not too many of them, with minor ticks between neighbours where there is room.
fn powers(from: f64, to: f64, count: f64) -> Vec<Tick> {
    let (first, last) = ((from - SLACK).ceil() as i32, (to + SLACK).floor() as i32);
    let step = (f64::from(last - first) / count).ceil().max(1.0) as i32;
    let mut ticks: Vec<Tick> = (first..=last)
        .filter(|power| power.rem_euclid(step) == 0)
        .map(|power| Tick {
            value: 10f64.powi(power),
            label: Label::Power(power),
        })
        .collect();
    if step == 1 && last - first <= 4 {
        let minor = (first - 1..=last).flat_map(|power| {
            (2..10).map(move |digit| Tick {
                value: f64::from(digit) * 10f64.powi(power),
                label: Label::None,
            })
        });
        ticks.extend(minor);
    }
    ticks
}
