//! Numbers and units that are written as elsewhere: `1,000`, `3,5`, `.5`, `8:30`, `2x`, `mm 3`.

use super::is_keyword;
use crate::kind::SyntaxKind::{
    Caret, Colon, Comma, Dot, Ident, LBracket, LParen, Minus, Number, RBracket, RParen, Unit,
};
use crate::parser::Parser;
use crate::units::{follows_operand, unit_length};
use base::Span;

/// `1,000,000`, `1 000 000`
pub(super) fn grouped_digits(p: &mut Parser<'_>) -> bool {
    let is_group =
        |p: &Parser<'_>, n| p.nth(n) == Number && p.word(n).len() == 3 && !p.begins_line(n);
    let step = match p.current() {
        Comma if p.is_adjacent(0) && p.is_adjacent(1) => 2,
        Number => 1,
        _ => return false,
    };
    let first = step - 1;
    if !is_first_group(p) || !is_group(p, first) || step == 2 && !is_group(p, first + 2) {
        return false;
    }
    let mut n = first;
    while is_group(p, n + step) && (step == 1 || p.nth(n + 1) == Comma) {
        n += step;
    }
    let at = p.pos();
    let written = p.text_between(at - 1, at + n);
    let number: String = written.chars().filter(|c| !matches!(c, ',' | ' ')).collect();
    let said = (
        "grouped-digits",
        format!("found `{written}`, wanted one number"),
        format!("the digits of a number stand together: write `{number}`"),
    );
    let span = p.span_at(at - 1).join(p.span_at(at + n));
    p.report_mistake((at - 1, at + n), said, Some((span, number)));
    true
}

/// `1.000.000`: points between thousands. Returns true where they were reported, at the second point.
pub(in crate::grammar) fn dotted_digits(p: &mut Parser<'_>) -> bool {
    let are_groups = |word: &str, first: usize| {
        let groups: Vec<&str> = word.split('.').collect();
        let is_of_digits = |group: &&str| group.bytes().all(|b| b.is_ascii_digit());
        groups.iter().all(is_of_digits)
            && groups[..first].iter().all(|group| (1..=3).contains(&group.len()))
            && groups[first..].iter().all(|group| group.len() == 3)
    };
    let is_one = p.at(Dot)
        && p.behind(1) == Number
        && p.nth(1) == Number
        && p.is_adjacent(0)
        && p.is_adjacent(1)
        && p.text_between(p.pos() - 1, p.pos() - 1).contains('.')
        && are_groups(p.text_between(p.pos() - 1, p.pos() - 1), 1)
        && are_groups(p.word(1), 0);
    if is_one {
        let at = p.pos();
        let written = p.text_between(at - 1, at + 1);
        let number = written.replace('.', "");
        let said = (
            "grouped-digits",
            format!("found `{written}`, wanted one number"),
            format!("the digits of a number stand together: write `{number}`"),
        );
        let span = p.span_at(at - 1).join(p.span_at(at + 1));
        p.report_mistake((at - 1, at + 1), said, Some((span, number)));
    }
    is_one
}

/// Returns true behind what groups of three digits follow: a number of at most three digits and nothing else.
fn is_first_group(p: &Parser<'_>) -> bool {
    let is_of_digits = |word: &str| word.len() <= 3 && word.chars().all(|c| c.is_ascii_digit());
    p.behind(1) == Number && is_of_digits(p.text_between(p.pos() - 1, p.pos() - 1))
}

/// `8:30`
pub(super) fn time_of_day(p: &mut Parser<'_>) -> bool {
    let is_one = p.at(Colon) && p.behind(1) == Number && p.nth(1) == Number && p.is_adjacent(1);
    if is_one {
        let at = p.pos();
        let (hours, minutes) = (p.text_between(at - 1, at - 1), p.word(1));
        let minutes = minutes.strip_prefix('0').unwrap_or(minutes);
        let said = (
            "expected-member",
            format!("found `{}`, wanted a number with its unit", p.text_between(at - 1, at + 1)),
            format!("a time is `{hours} h + {minutes} min`"),
        );
        p.report_mistake((at - 1, at + 1), said, None);
    }
    is_one
}

/// `3,5`
pub(super) fn decimal_comma(p: &mut Parser<'_>) -> bool {
    let is_one = p.at(Comma)
        && p.behind(1) == Number
        && p.nth(1) == Number
        && p.is_adjacent(0)
        && p.is_adjacent(1);
    if is_one {
        let at = p.pos();
        let (before, after) = (p.text_between(at - 1, at - 1), p.word(1));
        // `1.000,50`: the point stands between thousands
        let number = format!("{}.{after}", before.replace('.', ""));
        let is_either = is_first_group(p) && after.len() == 3 && !before.starts_with('0');
        let hint = match is_either {
            true => {
                format!("write `{number}` for a decimal comma, `{before}{after}` for thousands")
            }
            false => format!("write `{number}`"),
        };
        let said =
            ("decimal-comma", format!("found `{before},{after}`, wanted a decimal point"), hint);
        let span = p.span_at(at - 1).join(p.span_at(at + 1));
        let fix = (!is_either).then_some((span, number));
        p.report_mistake((at - 1, at + 1), said, fix);
    }
    is_one
}

/// `.5`
pub(in crate::grammar) fn leading_dot(p: &mut Parser<'_>) -> bool {
    let is_one = p.at(Dot) && p.nth(1) == Number && p.is_adjacent(1);
    if is_one {
        let at = p.pos();
        let number = format!("0.{}", p.word(1));
        let said = (
            "leading-dot",
            format!("found `.{}`, wanted a digit before the point", p.word(1)),
            format!("write `{number}`"),
        );
        let span = p.span_at(at).join(p.span_at(at + 1));
        p.report_mistake((at, at + 1), said, Some((span, number)));
    }
    is_one
}

/// `x mm`
pub(in crate::grammar) fn unit_after_name(p: &mut Parser<'_>) -> bool {
    // `A[0].x = 2` after a bracket is the next member
    let is_list = p.nth(1) == LBracket && p.is_adjacent(1);
    let is_one = p.at(Ident)
        && !p.line_ended(0)
        && !p.begins_line(0)
        && !p.names_itself(1)
        && !is_list
        && !matches!(p.word(0), "in" | "as")
        && matches!(p.behind(1), Ident | RParen | RBracket)
        && unit_length(p.word(0)) == p.word(0).len();
    if is_one {
        let (at, unit) = (p.pos(), p.word(0));
        let said = (
            "unit-after-name",
            format!("found the unit `{unit}` after a name, wanted it after a number"),
            format!("write `* 1 {unit}`"),
        );
        p.report_mistake((at, at), said, Some((p.span_at(at), format!("* 1 {unit}"))));
    }
    is_one
}

/// `2x`, `2 (x + 1)`: a product without its operator. Returns true where one was reported.
pub(in crate::grammar) fn implied_product(p: &mut Parser<'_>) -> bool {
    let is_word = is_keyword(p.word(0)) || follows_operand(p.word(0));
    let is_name = p.at(Ident)
        && p.is_adjacent(0)
        && !is_word
        && p.nth(1) != Colon
        && expr::units::meant(p.word(0)).is_empty();
    let is_bracket = p.at(LParen) && !p.line_ended(0);
    let is_one = p.behind(1) == Number && (is_name || is_bracket);
    if is_one {
        let at = p.pos();
        let number = p.text_between(at - 1, at - 1);
        let factor = if is_name { p.word(0) } else { "(…)" };
        let fix = p.span_at(at).start;
        let fix = Some((Span::new(fix, fix), " * ".into()));
        let said = (
            "implied-product",
            format!("found a number before `{}`, wanted an operator between them", p.word(0)),
            match factor {
                // prefixes of SI that stand alone in many a list of parts
                "n" | "p" | "u" | "µ" | "M" | "G" => format!(
                    "write `{number} * {factor}`; a prefix stands before its unit: `{number} {factor}F`"
                ),
                _ => format!("write `{number} * {factor}`"),
            },
        );
        p.report_mistake((at - 1, at), said, fix);
    }
    is_one
}

/// `mm 3`: a unit before its number. Returns true where one was reported.
pub(in crate::grammar) fn unit_before_number(p: &mut Parser<'_>) -> bool {
    let is_one = p.nth(1) == Number
        && !p.begins_line(1)
        && p.nth(2) != Unit
        && unit_length(p.word(0)) == p.word(0).len();
    if is_one {
        let at = p.pos();
        let right = format!("{} {}", p.word(1), p.word(0));
        let said = (
            "unit-before-number",
            format!("found the unit `{}` before its number", p.word(0)),
            format!("write `{right}`"),
        );
        p.report_mistake((at, at + 1), said, Some((p.span_at(at).join(p.span_at(at + 1)), right)));
    }
    is_one
}

/// `3x10^8`, `4k7`, `4k7 ohm` behind the number that it begins with. Returns how many tokens belong to it, where it was
/// reported.
pub(in crate::grammar) fn strange_number(p: &mut Parser<'_>) -> Option<usize> {
    if !p.at(Ident) || !p.is_adjacent(0) {
        return None;
    }
    let found = underscored(p).or_else(|| power_of_ten(p)).or_else(|| resistance(p));
    let found = found.or_else(|| thousands(p)).or_else(|| spelled(p));
    let ((length, number), at) = (found?, p.pos());
    let (digits, last) = (p.text_between(at - 1, at - 1), at + length - 1);
    // `2k` is perhaps twice a part that is called so
    let may_be_product = p.word(0) == "k" && !number.ends_with("ohm");
    let said = (
        "implied-product",
        format!("found `{}` right after `{digits}`, wanted one number", p.word(0)),
        match length {
            1 if p.word(0).starts_with('_') => {
                format!("the digits of a number stand together: write `{number}`")
            }
            1 | 2 if number.ends_with("ohm") => {
                format!("a number has its point and its unit: `{number}`")
            }
            _ if may_be_product => {
                format!("so many thousands are `{number}`; a product has its sign, `{digits} * k`")
            }
            _ => format!("write `{number}`"),
        },
    );
    let span = p.span_at(at - 1).join(p.span_at(last));
    p.report_mistake((at - 1, last), said, (!may_be_product).then_some((span, number)));
    Some(length)
}

/// `3x10^8`: how many tokens it has behind its number, and how it is written.
fn power_of_ten(p: &Parser<'_>) -> Option<(usize, String)> {
    if p.word(0) != "x10" || p.nth(1) != Caret {
        return None;
    }
    let sign = usize::from(p.nth(2) == Minus);
    let power = Some(p.word(2 + sign)).filter(|power| is_whole(power))?;
    let digits = p.text_between(p.pos() - 1, p.pos() - 1);
    let is_plain = digits.chars().all(|c| c.is_ascii_digit() || c == '.');
    let (length, minus) = (3 + sign, if sign == 1 { "-" } else { "" });
    is_plain.then(|| (length, format!("{digits}e{minus}{power}")))
}

/// `1_000_000`: how many tokens it has behind its number, and how it is written.
fn underscored(p: &Parser<'_>) -> Option<(usize, String)> {
    let (digits, rest) = (p.text_between(p.pos() - 1, p.pos() - 1), p.word(0));
    let is_one = rest.starts_with('_') && rest.chars().all(|c| c.is_ascii_digit() || c == '_');
    is_one.then(|| (1, format!("{digits}{}", rest.replace('_', ""))))
}

/// `4k7`, `4k7 ohm`: how many tokens it has behind its number, and how it is written.
fn resistance(p: &Parser<'_>) -> Option<(usize, String)> {
    let (digits, (prefix, rest)) =
        (p.text_between(p.pos() - 1, p.pos() - 1), p.word(0).split_at_checked(1)?);
    let unit = match prefix {
        "k" => "kohm",
        "M" => "Mohm",
        "R" => "ohm",
        _ => return None,
    };
    let has_unit = p.nth(1) == Ident && p.word(1) == "ohm" && !p.begins_line(1);
    let is_one = is_whole(digits) && is_whole(rest) && (has_unit || p.is_of("Resistance"));
    is_one.then(|| (1 + usize::from(has_unit), format!("{digits}.{rest} {unit}")))
}

/// `2h30m`, `2h30`, `45º`, `0x1F`: how many tokens it has behind its number, and how it is written. `2h1` is two heights.
fn spelled(p: &Parser<'_>) -> Option<(usize, String)> {
    let (digits, rest) = (p.text_between(p.pos() - 1, p.pos() - 1), p.word(0));
    let minutes = rest.strip_suffix("min").or_else(|| rest.strip_suffix('m'));
    // `3h30`, where a time is wanted
    let minutes = minutes.or_else(|| Some(rest).filter(|w| w.len() == 3 && p.is_of("Time")));
    let minutes = minutes.and_then(|rest| rest.strip_prefix('h')).filter(|rest| is_whole(rest));
    let number = match rest.split_at_checked(1) {
        _ if let Some(minutes) = minutes => format!("{digits} h + {minutes} min"),
        Some(("x", hexadecimal)) if digits == "0" => {
            i64::from_str_radix(hexadecimal, 16).ok()?.to_string()
        }
        _ if rest == "º" => format!("{digits} deg"),
        // `1.5d3`, as Fortran writes what has twice the digits
        Some(("d" | "D", power)) if is_whole(power) => format!("{digits}e{power}"),
        _ => return None,
    };
    Some((1, number))
}

/// `4.7k`: how many tokens it has behind its number, and how it is written.
fn thousands(p: &Parser<'_>) -> Option<(usize, String)> {
    let digits = p.text_between(p.pos() - 1, p.pos() - 1);
    let is_plain = digits.chars().all(|c| c.is_ascii_digit() || c == '.');
    let number = match (p.word(0), p.is_of("Resistance")) {
        ("k", true) => format!("{digits} kohm"),
        ("M", true) => format!("{digits} Mohm"),
        ("k", false) => format!("{digits}e3"),
        _ => return None,
    };
    is_plain.then_some((1, number))
}

fn is_whole(number: &str) -> bool {
    !number.is_empty() && number.chars().all(|c| c.is_ascii_digit())
}

/// `within 0.1 of 10`
pub(in crate::grammar) fn compared_after_tolerance(p: &mut Parser<'_>) {
    if !p.at_word(0, "of") || p.begins_line(0) {
        return;
    }
    let word = |n: usize| p.text_between(p.pos() - n, p.pos() - n);
    let within = (1..=p.pos()).find(|&n| word(n) == "within").unwrap_or(1);
    let by = p.text_between(p.pos() - within + 1, p.pos() - 1);
    let (at, to) = (p.pos(), p.quoted_line(p.pos() + 1));
    let said = (
        "expected-member",
        "found `of` after a tolerance, wanted the end of the rule".to_string(),
        format!("what is compared stands before it: `x = {to} within {by}`"),
    );
    p.report_mistake((at, at), said, None);
    p.skip_line();
}
