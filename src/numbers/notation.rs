//! How is a formula written, as plain text that can be read again and as LaTeX?
//!
//! A formula is laid out once as a tree, and written in either notation.

/// A formula laid out for writing.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Shown {
    /// A name or a number that is not negative.
    Atom(String),
    /// Summands, each with whether it is subtracted.
    Sum(Vec<(bool, Shown)>),
    Product(Vec<Shown>),
    Quotient(Box<Shown>, Box<Shown>),
    Power(Box<Shown>, usize),
    Root(Box<Shown>),
}

impl Shown {
    /// The product; a factor alone, or 1, is no product.
    pub(crate) fn product(mut factors: Vec<Shown>) -> Shown {
        let Some(last) = factors.pop() else { return Shown::Atom("1".to_string()) };
        if factors.is_empty() {
            return last;
        }
        factors.push(last);
        Shown::Product(factors)
    }

    /// The sum, with a summand that is added first if there is one; a summand alone that is added is no sum.
    pub(crate) fn sum(mut terms: Vec<(bool, Shown)>) -> Shown {
        let added = terms.iter().position(|(subtracted, _)| !subtracted);
        if let Some(index) = added {
            terms[..=index].rotate_right(1);
        }
        match terms.pop() {
            None => Shown::Atom("0".to_string()),
            Some((false, only)) if terms.is_empty() => only,
            Some(last) => {
                terms.push(last);
                Shown::Sum(terms)
            }
        }
    }

    pub(crate) fn over(self, denominator: Option<Shown>) -> Shown {
        match denominator {
            None => self,
            Some(denominator) => Shown::Quotient(Box::new(self), Box::new(denominator)),
        }
    }

    pub(crate) fn power(self, exponent: usize) -> Shown {
        if exponent == 1 { self } else { Shown::Power(Box::new(self), exponent) }
    }

    pub(crate) fn signed(self, negative: bool) -> Shown {
        if negative { Shown::Sum(vec![(true, self)]) } else { self }
    }

    /// The formula with + - * / ^ ( ) and sqrt.
    pub(crate) fn text(&self) -> String {
        match self {
            Shown::Atom(name) => name.clone(),
            Shown::Sum(terms) => summed(terms, |term| term.text_in_product(true)),
            Shown::Product(factors) => factors.iter().map(|f| f.text_in_product(true)).collect::<Vec<_>>().join("*"),
            Shown::Quotient(above, below) => {
                format!("{}/{}", above.text_in_product(true), below.text_in_product(false))
            }
            Shown::Power(base, exponent) => format!("{}^{exponent}", base.text_in_product(false)),
            Shown::Root(radicand) => format!("sqrt({})", radicand.text()),
        }
    }

    fn text_in_product(&self, first: bool) -> String {
        match self {
            Shown::Sum(_) => format!("({})", self.text()),
            Shown::Product(_) | Shown::Quotient(..) if !first => format!("({})", self.text()),
            _ => self.text(),
        }
    }

    /// The formula in LaTeX's mathematical mode.
    pub(crate) fn latex(&self) -> String {
        match self {
            Shown::Atom(name) => name.clone(),
            Shown::Sum(terms) => summed(terms, Shown::latex_factor),
            Shown::Product(factors) => factors.iter().map(Shown::latex_factor).collect::<Vec<_>>().join(" "),
            Shown::Quotient(above, below) => format!("\\frac{{{}}}{{{}}}", above.latex(), below.latex()),
            Shown::Power(base, exponent) if *exponent < 10 => format!("{}^{exponent}", base.latex_base()),
            Shown::Power(base, exponent) => format!("{}^{{{exponent}}}", base.latex_base()),
            Shown::Root(radicand) => format!("\\sqrt{{{}}}", radicand.latex()),
        }
    }

    fn latex_factor(&self) -> String {
        if matches!(self, Shown::Sum(_)) { parenthesized(&self.latex()) } else { self.latex() }
    }

    fn latex_base(&self) -> String {
        let simple = |name: &str| name.chars().all(|c| c.is_alphanumeric() || "_{}".contains(c));
        match self {
            Shown::Atom(name) if simple(name) => name.clone(),
            _ => parenthesized(&self.latex()),
        }
    }
}

fn parenthesized(inner: &str) -> String {
    if inner.contains("\\frac") { format!("\\left({inner}\\right)") } else { format!("({inner})") }
}

fn summed(terms: &[(bool, Shown)], write: impl Fn(&Shown) -> String) -> String {
    let mut sum = String::new();
    for (index, (subtracted, term)) in terms.iter().enumerate() {
        sum.push_str(match (index, subtracted) {
            (0, false) => "",
            (0, true) => "-",
            (_, false) => " + ",
            (_, true) => " - ",
        });
        sum.push_str(&write(term));
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    fn atom(name: &str) -> Shown {
        Shown::Atom(name.to_string())
    }

    #[test]
    fn parentheses_stand_where_needed() {
        let sum = Shown::sum(vec![(true, atom("a")), (false, atom("b"))]);
        assert_eq!(sum.text(), "b - a");
        let product = Shown::product(vec![atom("2"), sum.clone()]);
        assert_eq!(atom("1").over(Some(product.clone())).text(), "1/(2*(b - a))");
        assert_eq!(product.clone().over(Some(atom("3"))).signed(true).text(), "-2*(b - a)/3");
        assert_eq!(sum.clone().over(Some(atom("3"))).latex(), "\\frac{b - a}{3}");
        assert_eq!(product.latex(), "2 (b - a)");
        assert_eq!(atom("3").over(Some(atom("8"))).power(2).text(), "(3/8)^2");
        assert_eq!(atom("\\cos x").power(12).latex(), "(\\cos x)^{12}");
        assert_eq!(Shown::sum(Vec::new()).text(), "0");
        assert_eq!(Shown::Root(Box::new(sum)).text(), "sqrt(b - a)");
    }
}
