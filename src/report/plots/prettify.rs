//! How is a formula of a scheme file written in print?
//!
//! `(5/8 - (3/8 + cos(2*pi/n)/4)^2)/n` becomes (5/8 − (3/8 + cos(2π/n)/4)²)/n.

/// Names that are written as Greek letters.
const GREEK: [(&str, char); 24] = [
    ("alpha", 'α'),
    ("beta", 'β'),
    ("gamma", 'γ'),
    ("delta", 'δ'),
    ("epsilon", 'ε'),
    ("zeta", 'ζ'),
    ("eta", 'η'),
    ("theta", 'θ'),
    ("iota", 'ι'),
    ("kappa", 'κ'),
    ("lambda", 'λ'),
    ("mu", 'μ'),
    ("nu", 'ν'),
    ("xi", 'ξ'),
    ("omicron", 'ο'),
    ("pi", 'π'),
    ("rho", 'ρ'),
    ("sigma", 'σ'),
    ("tau", 'τ'),
    ("upsilon", 'υ'),
    ("phi", 'φ'),
    ("chi", 'χ'),
    ("psi", 'ψ'),
    ("omega", 'ω'),
];

const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
const LOWERED: [char; 10] = ['₀', '₁', '₂', '₃', '₄', '₅', '₆', '₇', '₈', '₉'];

/// A formula or a condition as print shows it.
pub(super) fn pretty(formula: &str) -> String {
    let tokens = tokens(formula);
    let mut text = String::new();
    let mut at = 0;
    while at < tokens.len() {
        let before = at.checked_sub(1).and_then(|before| tokens.get(before)).copied();
        let after = tokens.get(at + 1).copied();
        match (tokens[at], after) {
            ("^", Some(power)) if power.bytes().all(|byte| byte.is_ascii_digit()) => {
                text.extend(digits(power, &RAISED));
                at += 1;
            }
            (token, _) => text.push_str(&piece(token, before, after)),
        }
        at += 1;
    }
    text
}

fn piece(token: &str, before: Option<&str>, after: Option<&str>) -> String {
    let is_binary = before.is_some_and(|token| is_word(token) || token == ")");
    match token {
        "+" | "-" if is_binary => if token == "-" { " − " } else { " + " }.to_string(),
        "-" => "−".to_string(),
        "*" => product(before.unwrap_or(""), after.unwrap_or("")).to_string(),
        "," => ", ".to_string(),
        "==" => " = ".to_string(),
        "!=" => " ≠ ".to_string(),
        "<=" => " ≤ ".to_string(),
        ">=" => " ≥ ".to_string(),
        "<" | ">" | "and" | "or" => format!(" {token} "),
        "sqrt" => "√".to_string(),
        word => name(word),
    }
}

/// The sign of a product: none where the factors can't be misread.
fn product(before: &str, after: &str) -> &'static str {
    let starts_with_digit = after.starts_with(|letter: char| letter.is_ascii_digit() || letter == '.');
    if starts_with_digit || (is_word(before) && is_long(before)) {
        "·"
    } else if is_long(after) {
        " "
    } else {
        ""
    }
}

/// Whether a name is written in more than one letter: a function's, or one that isn't Greek.
fn is_long(word: &str) -> bool {
    word.starts_with(|letter: char| letter.is_ascii_alphabetic())
        && name(word).trim_end_matches(LOWERED).chars().nth(1).is_some()
}

fn is_word(token: &str) -> bool {
    token.starts_with(|letter: char| letter.is_ascii_alphanumeric() || letter == '.' || letter == '_')
}

/// A name with its Greek letter, and digits at its end lowered.
pub(super) fn name(word: &str) -> String {
    if !word.starts_with(|letter: char| letter.is_ascii_alphabetic()) {
        return word.to_string();
    }
    let stem = word.trim_end_matches(|letter: char| letter.is_ascii_digit());
    let (number, stem) = (&word[stem.len()..], stem.trim_end_matches('_'));
    let greek = GREEK.iter().find(|(name, _)| *name == stem);
    let mut text = greek.map_or(stem.to_string(), |(_, letter)| letter.to_string());
    text.extend(digits(number, &LOWERED));
    text
}

/// A number in lowered digits.
pub(super) fn lowered(number: usize) -> String {
    digits(&number.to_string(), &LOWERED).collect()
}

fn digits(number: &str, forms: &[char; 10]) -> impl Iterator<Item = char> {
    number.bytes().filter_map(|byte| forms.get(usize::from(byte.wrapping_sub(b'0'))).copied())
}

/// Words, numbers and signs.
fn tokens(text: &str) -> Vec<&str> {
    let mut tokens = Vec::new();
    let mut rest = text.trim_start();
    while let Some(first) = rest.chars().next() {
        let in_word = |letter: char| letter.is_ascii_alphanumeric() || letter == '_' || letter == '.';
        let length = if in_word(first) {
            rest.find(|letter| !in_word(letter)).unwrap_or(rest.len())
        } else {
            let pair = ["==", "!=", "<=", ">="].iter().any(|pair| rest.starts_with(pair));
            if pair { 2 } else { first.len_utf8() }
        };
        let (token, after) = rest.split_at(length);
        tokens.push(token);
        rest = after.trim_start();
    }
    tokens
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formulas_look_as_in_print() {
        for (formula, print) in [
            ("1 - n*beta", "1 − nβ"),
            ("(5/8 - (3/8 + cos(2*pi/n)/4)^2)/n", "(5/8 − (3/8 + cos(2π/n)/4)²)/n"),
            ("(3 + 2*cos(2*pi*j/n))/(4*n)", "(3 + 2 cos(2πj/n))/(4n)"),
            ("-1/16 - w", "−1/16 − w"),
            ("1/8 + 2*w", "1/8 + 2w"),
            ("1/n^2", "1/n²"),
            ("x^12", "x¹²"),
            ("2^(n-1)", "2^(n − 1)"),
            ("2^-1", "2^−1"),
            ("n*2", "n·2"),
            ("2*3.5", "2·3.5"),
            ("n*(n + 5)", "n(n + 5)"),
            ("(n+1)*(n-1)", "(n + 1)(n − 1)"),
            ("tension*n", "tension·n"),
            ("2*tension", "2 tension"),
            ("beta0*beta_1", "β₀β₁"),
            ("sqrt(c*(c+1))", "√(c(c + 1))"),
            ("max(1,-n)", "max(1, −n)"),
            ("4 <= n<=6 or n>=9 and n != 12", "4 ≤ n ≤ 6 or n ≥ 9 and n ≠ 12"),
            ("n == 3", "n = 3"),
        ] {
            assert_eq!(pretty(formula), print);
        }
        assert_eq!(lowered(10), "₁₀");
    }
}
