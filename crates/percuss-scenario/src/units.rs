//! Quantities with units: `"8330 cm^4"`, `"7.5e5 N/m"`, `"36 km/h"`.
//!
//! Units combine by blanks, `*`, `.`, `·` and `/`, take exponents (`m^2`, `m²`, `m2`, `s^-1`, `m^1.5`), SI
//! prefixes and brackets. Powers of ten move into the exponent of the number before it is parsed, so
//! `"20 cm"` has the very bits of `0.2`.

mod dimension;
mod known;

use std::ops::Range;

pub use dimension::Dimension;
use known::{Unit, meant, symbol};

/// A value in SI units with its dimension.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quantity {
    /// Value in the coherent SI unit; finite.
    pub value: f64,
    /// Dimension.
    pub dimension: Dimension,
}

/// Why a text is not a quantity.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnitFault {
    /// The bytes of the text at fault.
    pub span: Range<usize>,
    /// What was found.
    pub found: String,
    /// What would be right.
    pub expected: String,
}

/// Reads a quantity.
///
/// # Errors
/// The first fault: no number, an unknown unit, an ambiguous quotient, a value beyond the range of numbers.
pub fn parse(text: &str) -> Result<Quantity, UnitFault> {
    let mut cursor = Cursor { text, at: 0 };
    cursor.blanks();
    let number = cursor.number()?;
    let unit = cursor.product(0)?;
    if cursor.at < text.len() {
        return Err(
            cursor.fault_here("no unit to its left", "an opening bracket for each closing one")
        );
    }
    let whole = 0..text.len();
    let exponent = number.exponent.saturating_add(i64::from(unit.power10));
    let scaled: f64 = format!("{}e{exponent}", number.mantissa).parse().unwrap_or(f64::NAN);
    let value = scaled * unit.numerator / unit.denominator;
    if !value.is_finite() {
        return Err(fault(
            whole,
            format!("`{text}`, beyond the range of numbers"),
            "a finite value",
        ));
    }
    if value == 0.0 && number.mantissa.contains(|c: char| ('1'..='9').contains(&c)) {
        return Err(fault(
            whole,
            format!("`{text}`, too small a number"),
            "zero, or 1e-300 and above",
        ));
    }
    Ok(Quantity { value, dimension: unit.dimension })
}

fn fault(span: Range<usize>, found: impl Into<String>, expected: impl Into<String>) -> UnitFault {
    UnitFault { span, found: found.into(), expected: expected.into() }
}

/// A decimal number before it is scaled by its unit.
struct Decimal {
    mantissa: String,
    exponent: i64,
}

/// Deepest nesting of brackets.
const DEPTH: usize = 8;
/// Largest exponent of a unit.
const EXPONENT: i32 = 12;

struct Cursor<'t> {
    text: &'t str,
    at: usize,
}

impl Cursor<'_> {
    fn peek(&self) -> Option<char> {
        self.text[self.at..].chars().next()
    }

    fn eat(&mut self, accept: impl Fn(char) -> bool) -> Option<char> {
        let c = self.peek().filter(|&c| accept(c))?;
        self.at += c.len_utf8();
        Some(c)
    }

    fn blanks(&mut self) -> bool {
        let from = self.at;
        while self.eat(char::is_whitespace).is_some() {}
        self.at > from
    }

    fn digits(&mut self) -> String {
        let mut out = String::new();
        while let Some(c) = self.eat(|c| c.is_ascii_digit()) {
            out.push(c);
            let rest = self.text[self.at..].strip_prefix('_');
            if rest.is_some_and(|r| r.starts_with(|c: char| c.is_ascii_digit())) {
                self.at += 1; // 1_000
            }
        }
        out
    }

    fn sign(&mut self) -> &'static str {
        match self.eat(|c| matches!(c, '+' | '-' | '−')) {
            Some('+') | None => "",
            Some(_) => "-",
        }
    }

    fn fault_here(&self, found: &str, expected: &str) -> UnitFault {
        let end = self.at + self.peek().map_or(0, char::len_utf8);
        let found = match self.peek() {
            Some(c) => format!("`{c}` with {found}"),
            None => found.to_string(),
        };
        fault(self.at..end, found, expected)
    }

    fn number(&mut self) -> Result<Decimal, UnitFault> {
        let from = self.at;
        let mut mantissa = self.sign().to_string();
        let whole = self.digits();
        let dot = self.eat(|c| c == '.').is_some();
        let fraction = if dot { self.digits() } else { String::new() };
        if whole.is_empty() && fraction.is_empty() {
            let found = format!("`{}`, which does not begin with a number", self.text);
            return Err(fault(from..self.text.len(), found, "a number, then its unit"));
        }
        if self.peek() == Some(',') {
            return Err(fault(self.at..self.at + 1, "a comma in a number", "a decimal point"));
        }
        mantissa.push_str(if whole.is_empty() { "0" } else { &whole });
        mantissa.push('.');
        mantissa.push_str(if fraction.is_empty() { "0" } else { &fraction });
        Ok(Decimal { mantissa, exponent: self.decimal_exponent() })
    }

    /// `e-4`; leaves an `e` without digits for the unit.
    fn decimal_exponent(&mut self) -> i64 {
        let from = self.at;
        if self.eat(|c| c == 'e' || c == 'E').is_none() {
            return 0;
        }
        let sign = self.sign();
        let digits = self.digits();
        if digits.is_empty() {
            self.at = from;
            return 0;
        }
        let size = digits.parse::<i64>().unwrap_or(i64::MAX).min(1_000_000);
        if sign == "-" { -size } else { size }
    }

    fn product(&mut self, depth: usize) -> Result<Unit, UnitFault> {
        let mut out = Unit::ONE;
        let (mut first, mut divided) = (true, false);
        loop {
            self.blanks();
            let Some(next) = self.peek() else { return Ok(out) };
            if next == ')' {
                return Ok(out);
            }
            let divides = next == '/';
            let from = self.at;
            if divides || matches!(next, '*' | '.' | '·' | '⋅' | '×') {
                self.at += next.len_utf8();
                self.blanks();
            }
            if divided && !divides {
                let found = format!("`{}`, which has a factor after a quotient", self.text.trim());
                let expected =
                    "brackets round the divisor, `N/(m s)`, or its factors first, `N s/m`";
                return Err(fault(from..self.text.len(), found, expected));
            }
            if first && from < self.at && !divides {
                return Err(fault(from..self.at, format!("`{next}` before the unit"), "a unit"));
            }
            let unit = self.factor(depth, first)?;
            out = out.times(if divides { unit.power(-1) } else { unit });
            divided |= divides;
            first = false;
        }
    }

    /// A unit with its exponent, or brackets; the first of a product may be the 1 of `1/s`.
    fn factor(&mut self, depth: usize, first: bool) -> Result<Unit, UnitFault> {
        let from = self.at;
        let unit = if self.eat(|c| c == '(').is_some() {
            if depth >= DEPTH {
                return Err(fault(from..self.at, "too many brackets", "a simpler unit"));
            }
            let inner = self.product(depth + 1)?;
            if self.eat(|c| c == ')').is_none() {
                return Err(fault(from..self.text.len(), "an open bracket", "a closing bracket"));
            }
            inner
        } else if self.eat(|c| c == '1').is_some() {
            let divided = self.text[self.at..].trim_start().starts_with('/');
            if !first || !divided {
                return Err(fault(from..self.text.len(), "a second number", "one number"));
            }
            return Ok(Unit::ONE);
        } else {
            while self.eat(|c| c.is_alphabetic() || matches!(c, '°' | '%')).is_some() {}
            let name = &self.text[from..self.at];
            if name.is_empty() {
                return Err(self.fault_here("no unit before it", "a unit, such as m, kg, s, N, Pa"));
            }
            symbol(name).ok_or_else(|| unknown(name, from..self.at))?
        };
        let from = self.at;
        let doubled = self.exponent()?;
        let root = if doubled % 2 == 0 { None } else { Some(unit.root()) };
        match root {
            None => Ok(unit.power(doubled / 2)),
            Some(Some(root)) => Ok(root.power(doubled)),
            Some(None) => {
                let found = format!("`{}` of a square root", &self.text[from..self.at]);
                Err(fault(from..self.at, found, "whole exponents and halves"))
            }
        }
    }

    /// Twice the exponent.
    fn exponent(&mut self) -> Result<i32, UnitFault> {
        let from = self.at;
        let written = self.eat(|c| c == '^').is_some();
        let bracket = written && self.eat(|c| c == '(').is_some();
        let mut text = if written { self.sign().to_string() } else { String::new() };
        text.push_str(&self.digits());
        if !written && text.is_empty() {
            while let Some(c) = self.eat(|c| superscript(c).is_some()) {
                text.extend(superscript(c));
            }
        }
        if text.is_empty() && !written {
            return Ok(2);
        }
        let half = i32::from(written && self.half());
        let closed = !bracket || self.eat(|c| c == ')').is_some();
        let sign = if text.starts_with('-') { -1 } else { 1 };
        match text.parse::<i32>() {
            Ok(n) if n.abs() <= EXPONENT && closed => Ok(2 * n + sign * half),
            _ => {
                let found = format!("the exponent `{}`", &self.text[from..self.at]);
                Err(fault(from..self.at, found, format!("a whole number up to {EXPONENT}")))
            }
        }
    }

    /// `.5` at the end of a number.
    fn half(&mut self) -> bool {
        let rest = self.text[self.at..].strip_prefix(".5");
        let ends = rest.is_some_and(|r| !r.starts_with(|c: char| c.is_ascii_digit()));
        self.at += if ends { 2 } else { 0 };
        ends
    }
}

fn superscript(c: char) -> Option<char> {
    const PLAIN: &[u8] = b"0123456789-";
    "⁰¹²³⁴⁵⁶⁷⁸⁹⁻".chars().position(|s| s == c).map(|i| char::from(PLAIN[i]))
}

fn unknown(name: &str, span: Range<usize>) -> UnitFault {
    let expected = match meant(name) {
        Some(known) => format!("a known unit (did you mean {known}?)"),
        None => "a known unit, such as m, kg, s, N, Pa, J, W, Hz, deg, in, lbf".into(),
    };
    fault(span, format!("the unknown unit `{name}`"), expected)
}
