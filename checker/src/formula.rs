//! What does a formula of a scheme file say, at one n or for all large ones?
//!
//! A polynomial in t = 1/n, c = cos(2 pi/n), z = cos(2 pi j/n), with powers up to 12. Nothing else is checkable.

use crate::polynomial::{C, Poly, T, Z};
use std::cell::Cell;
use toml::{Table, Value};

/// The valence that a formula is read for, or the first one of a tail of them.
#[derive(Clone, Copy)]
pub(crate) struct Count {
    pub(crate) n: i64,
    pub(crate) tail: bool,
}

impl Count {
    pub(crate) fn value(self) -> Poly {
        if self.tail { Poly::power_of(T, -1) } else { Poly::number(self.n) }
    }
}

impl std::fmt::Debug for Count {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        write!(f, "n {} {}", if self.tail { ">=" } else { "=" }, self.n)
    }
}

/// The names that formulas may use, the valence if n has a value, and how many more words may be read.
pub(crate) struct Reader<'a>(pub(crate) &'a Table, pub(crate) Option<Count>, pub(crate) Cell<usize>);

impl Reader<'_> {
    /// The value of a formula, told once or case by case.
    pub(crate) fn read(&self, value: &Value) -> Option<Poly> {
        match value {
            Value::String(text) => {
                let sign = |c: char| !c.is_ascii_alphanumeric() && c != '_';
                let spaced = |c: char| if sign(c) { vec![' ', c, ' '] } else { vec![c] };
                let apart: String = text.chars().flat_map(spaced).collect();
                let mut words = apart.split_whitespace().rev().collect();
                self.value(&mut words, 1).filter(|_| words.is_empty())
            }
            Value::Table(cases) => {
                let mut held = Vec::new();
                for (condition, value) in cases {
                    held.extend(self.holds(condition)?.then_some(value));
                }
                if let [own @ Value::String(_)] = held[..] { self.read(own) } else { None }
            }
            _ => None,
        }
    }

    /// Whether `n` compares so with a whole number, for all n of a tail alike.
    fn holds(&self, condition: &str) -> Option<bool> {
        let (words, count): (Vec<&str>, _) = (condition.split_whitespace().collect(), self.1?);
        let ["n", sign, number] = words[..] else { return None };
        let order = count.n.cmp(&number.parse().ok().filter(|own| !count.tail || *own < count.n)?);
        let held = [["<", "<=", "!="], ["==", "<=", ">="], [">", ">=", "!="]][(order as i8 + 1) as usize];
        ["<", "<=", "==", "!=", ">=", ">"].contains(&sign).then(|| held.contains(&sign))
    }

    /// A sum, or only what binds at least so tightly: 2 for products, 3 for powers. The last word is read first.
    fn value(&self, words: &mut Vec<&str>, least: usize) -> Option<Poly> {
        let mut own = self.operand(words)?;
        let binds =
            |sign: &&str| (least < 2 && "+-".contains(sign)) || (least < 3 && "*/".contains(sign)) || *sign == "^";
        while let Some(sign) = words.pop_if(|sign| binds(sign)) {
            own = match sign {
                "+" => &own + &self.value(words, 2)?,
                "-" => &own - &self.value(words, 2)?,
                "*" => &own * &self.value(words, 3)?,
                "/" => &own * &self.value(words, 3)?.inverse()?,
                _ => own.raised(words.pop()?.parse().ok().filter(|own| *own <= 12)?),
            };
            own = Some(own).filter(|own| own.is_small() && (sign, words.last()) != ("^", Some(&"^")))?;
        }
        Some(own)
    }

    fn operand(&self, words: &mut Vec<&str>) -> Option<Poly> {
        self.2.set(self.2.get().checked_sub(1)?);
        match words.pop()? {
            "-" => Some(self.value(words, 3)?.scaled(-1)),
            "(" => self.value(words, 1).filter(|_| words.pop() == Some(")")),
            "cos" => {
                let end = words.iter().rposition(|own| *own == ")")?;
                match words.split_off(end)[..] {
                    [")", "n", "/", "pi", "*", "2", "("] => self.1.map(|_| Poly::power_of(C, 1)),
                    [")", "n", "/", "j", "*", "pi", "*", "2", "("] => self.1.map(|_| Poly::power_of(Z, 1)),
                    _ => None,
                }
            }
            "n" => Some(self.1?.value()),
            "j" | "pi" => None,
            word => match word.parse::<u32>() {
                Ok(number) => Some(Poly::number(number)),
                Err(_) => self.read(self.0.get(word)?),
            },
        }
    }
}
