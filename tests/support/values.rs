//! Random closed formulas, written as text, of every kind that has a value: for the kernel and the
//! engine to value one against the other.

use crate::dice::Dice;

impl Dice {
    fn pick<'a>(&mut self, from: &[&'a str]) -> &'a str {
        from[self.roll(from.len() as u64) as usize]
    }

    /// A value for a parameter, small; often an integer.
    pub fn number(&mut self, integer: bool) -> String {
        let below = if integer || self.roll(2) == 0 {
            1
        } else {
            1 + self.roll(6)
        };
        let above = self.roll(14) as i64 - i64::from(self.roll(12) == 0) * 5;
        format!("{above}/{below}")
    }

    fn leaf(&mut self, names: &[&str]) -> String {
        match self.roll(10) {
            0..=3 if !names.is_empty() => self.pick(names).to_string(),
            0..=5 => self.roll(7).to_string(),
            6 => format!("(-{})", 1 + self.roll(4)),
            7 => format!("({}/{})", 1 + self.roll(9), 2 + self.roll(4)),
            8 => self.pick(&["pi", "sqrt(2)", "ln(3)", "1/2"]).to_string(),
            _ => self.pick(&["0", "1", "2", "inf"]).to_string(),
        }
    }

    /// A formula over names that stand for numbers; the draws are x ~ beta(l, m - l + 1) and
    /// y ~ uniform(a, b).
    pub fn formula(&mut self, depth: u32, names: &[&str]) -> String {
        if depth == 0 {
            return self.leaf(names);
        }
        let less = depth - 1;
        match self.roll(24) {
            0..=6 => self.operation(less, names),
            7..=9 => self.call(less, names),
            10 => self.special(less, names),
            11 => {
                let (kind, body) = (
                    self.pick(&["sum", "sup", "infimum"]),
                    self.inside(less, names, "j"),
                );
                let from = self.roll(4);
                format!("{kind}({body}, j = {from}..{})", from + self.roll(4))
            }
            12..=14 => {
                let body = self.rational(less + 1, names, "t");
                let (from, to) = (self.end(names), self.end(names));
                format!("int({body}, t = {from}..{to})")
            }
            15 => {
                let (body, place) = (self.inside(less, names, "s"), self.formula(less, names));
                format!("at({body}, s = {place})")
            }
            16 => {
                let (body, place) = (self.inside(less, names, "s"), self.end(names));
                let order = self.pick(&["", ", 2", ", 1", ", 0"]);
                format!("at(diff({body}, s{order}), s = {place})")
            }
            17 => {
                let (body, place) = (self.inside(less, names, "s"), self.leaf(names));
                format!("lim({body}, s -> {place})")
            }
            18 => {
                let (a, b) = (self.formula(less, names), self.formula(less, names));
                let condition = self.condition(less, names);
                format!("if({condition}, {a}, {b})")
            }
            19 => format!("[{}]", self.condition(less, names)),
            20 | 21 => self.random(less + 1, names),
            _ => self.own(less + 1, names),
        }
    }

    /// A formula in which one more name stands for a number.
    fn inside(&mut self, depth: u32, names: &[&str], name: &str) -> String {
        let mut more = names.to_vec();
        more.extend([name, name]);
        self.formula(depth, &more)
    }

    fn operation(&mut self, depth: u32, names: &[&str]) -> String {
        let (a, b) = (self.formula(depth, names), self.formula(depth, names));
        match self.roll(8) {
            0 | 1 => format!("({a} + {b})"),
            2 | 3 => format!("({a} - {b})"),
            4 | 5 => format!("({a})*({b})"),
            6 => format!("({a})/({b})"),
            _ => {
                let powers = ["0", "2", "3", "-1", "-2", "(1/2)", "(-1/2)", "(2/3)"];
                match self.roll(6) {
                    0 => format!("({a})^({b})"),
                    _ => format!("({a})^{}", self.pick(&powers)),
                }
            }
        }
    }

    fn call(&mut self, depth: u32, names: &[&str]) -> String {
        let a = self.formula(depth, names);
        let one = [
            "abs", "sqrt", "exp", "ln", "sin", "cos", "gamma", "lngamma", "floor",
        ];
        match self.roll(12) {
            0..=8 => format!("{}({a})", self.pick(&one)),
            9 => format!("({a})!"),
            _ => {
                let b = self.formula(depth, names);
                format!("{}({a}, {b})", self.pick(&["min", "max"]))
            }
        }
    }

    fn half(&mut self) -> String {
        let n = self.roll(15) as i64 - 5;
        match self.roll(3) {
            0 => format!("({n}/2)"),
            _ => format!("({n})"),
        }
    }

    fn special(&mut self, depth: u32, names: &[&str]) -> String {
        let (a, b, c) = (self.half(), self.half(), self.half());
        match self.roll(8) {
            0 => format!("beta({a}, {b})"),
            1 => format!("binomial({}, {b})", self.formula(depth, names)),
            2 => format!("pochhammer({}, {b})", self.formula(depth, names)),
            3 => format!("gamma({a})*lngamma({b})"),
            n => {
                let places = ["0", "1", "-1", "1/2", "-3", "2", "-1/7", "4/5", "-40"];
                let (name, z) = (
                    if n == 4 { "hyp2f1r" } else { "hyp2f1" },
                    self.pick(&places),
                );
                format!("{name}({a}, {b}; {c}; {z})")
            }
        }
    }

    fn end(&mut self, names: &[&str]) -> String {
        match self.roll(12) {
            0..=4 => self.roll(4).to_string(),
            5 => format!("-{}", 1 + self.roll(2)),
            6 => "1/2".to_string(),
            7 => self
                .pick(&["sqrt(2)", "1/sqrt(3)", "sqrt(k/n)", "ln(2)"])
                .to_string(),
            8 => self.pick(&["inf", "-inf"]).to_string(),
            _ => self.leaf(names),
        }
    }

    /// A rational function of a name, with comparisons of it here and there.
    fn rational(&mut self, depth: u32, names: &[&str], x: &str) -> String {
        if depth == 0 || self.roll(9) == 0 {
            let fixed = self.leaf(names);
            return match self.roll(5) {
                0 => fixed,
                1 => format!("({x} - {fixed})"),
                _ => x.to_string(),
            };
        }
        let a = self.rational(depth - 1, names, x);
        let b = self.rational(depth - 1, names, x);
        match self.roll(17) {
            0 | 1 => format!("({a} + {b})"),
            2 => format!("({a} - {b})"),
            3..=5 => format!("({a})*({b})"),
            6..=8 => format!("({a})/({b})"),
            9 | 10 => format!(
                "({a})^{}",
                self.pick(&["2", "3", "-1", "-2", "0", "k", "-l"])
            ),
            11 => format!("abs({a})"),
            12 => format!("{}({a}, {b})", self.pick(&["min", "max"])),
            13 => format!("({a})*[{} < {x} <= {b}]", self.end(names)),
            14 => format!("if({x} < {}, {a}, {b})", self.end(names)),
            15 => format!("sum(({a})^j, j = 0..{})", self.roll(3)),
            _ => format!(
                "{}({x}, {a})",
                self.pick(&["1*", "density", "cdf"]).replace("1*", "max")
            )
            .replace("density(t", "density(x")
            .replace("cdf(t", "cdf(x"),
        }
    }

    fn relation(&mut self) -> &'static str {
        self.pick(&["<", "<=", "==", "!=", ">", ">="])
    }

    fn condition(&mut self, depth: u32, names: &[&str]) -> String {
        let (a, b) = (self.formula(depth, names), self.formula(depth, names));
        let one = format!("{a} {} {b}", self.relation());
        match self.roll(8) {
            0 => format!("not ({one})"),
            1 => {
                let other = self.leaf(names);
                format!("({one} and {other} {} 2)", self.relation())
            }
            2 => {
                let other = self.leaf(names);
                format!("({one} or {other} {} 2)", self.relation())
            }
            _ => one,
        }
    }

    /// A mean, variance, probability, density or distribution function over the draws.
    fn random(&mut self, depth: u32, names: &[&str]) -> String {
        let x = self.pick(&["x", "x", "y"]);
        let body = self.rational(depth.min(2), names, x);
        match self.roll(8) {
            0 => format!("var({body})"),
            1 => format!("prob({body} {} {})", self.relation(), self.leaf(names)),
            2 => format!("density({x}, {})", self.end(names)),
            3 => format!("cdf({x}, {})", self.end(names)),
            4 => {
                let other = self.rational(1, names, "y");
                let sign = self.pick(&["*", "+", "-", "/"]);
                format!("mean(({body}){sign}({other}))")
            }
            _ => format!("mean({body})"),
        }
    }

    /// The same over a draw of its own, which may have the name of a parameter.
    fn own(&mut self, depth: u32, names: &[&str]) -> String {
        let z = self.pick(&["z", "z", "k"]);
        let body = self.rational(depth.min(2), names, z);
        let (l, m) = (self.roll(4), 1 + self.roll(3));
        let law = match self.roll(5) {
            0 => format!("beta({l}, {m})"),
            1 => format!("uniform({}, {})", self.end(names), self.end(names)),
            2 => format!("order({l}, {m}) of uniform(0, {m})"),
            3 => format!("order({l}, {m}) of density v -> 2*v on 0..1"),
            _ => format!("density v -> {m}*v^{} on 0..1", m - 1),
        };
        match self.roll(4) {
            0 => format!("var({body}, {z} ~ {law})"),
            1 => format!(
                "prob({body} {} {}, {z} ~ {law})",
                self.relation(),
                self.leaf(names)
            ),
            _ => format!("mean({body}, {z} ~ {law})"),
        }
    }
}
