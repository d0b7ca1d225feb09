//! Figures as text.

/// Three digits and the share in percent: `2.08 %`; below 0.001 % with a power of ten.
pub(super) fn percent(share: f64) -> String {
    let value = 100.0 * share;
    if value != 0.0 && value.abs() < 1e-3 {
        format!("{}\u{202f}%", scientific(value))
    } else {
        format!("{}\u{202f}%", digits(value, 3))
    }
}

/// [`percent`] with its sign in front.
pub(super) fn signed_percent(share: f64) -> String {
    if share > 0.0 { format!("+{}", percent(share)) } else { percent(share) }
}

/// A whole number in full.
pub(super) fn count(value: u64) -> String {
    grouped(&value.to_string())
}

/// Digits in groups of three, from five on.
fn grouped(digits: &str) -> String {
    let mut grouped = String::new();
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) && digits.len() > 4 {
            grouped.push('\u{202f}');
        }
        grouped.push(digit);
    }
    grouped
}

/// A figure with three digits at least, whole numbers in full, in groups of three.
pub(super) fn figure(value: f64) -> String {
    let size = value.abs();
    if size != 0.0 && !(1e-3..1e9).contains(&size) { scientific(value) } else { digits(value, 3) }
}

/// One digit of each power of ten down to the `count`-th, at least to the units.
fn digits(value: f64, count: i32) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let leading = value.abs().log10().floor() as i32;
    let decimals = (count - 1 - leading).max(0) as usize;
    let text = format!("{:.*}", decimals, value.abs());
    let (whole, rest) = text.split_at(text.find('.').unwrap_or(text.len()));
    let grouped = grouped(whole);
    format!("{}{grouped}{rest}", if value < 0.0 { "−" } else { "" })
}

/// Two digits and a power of ten: `3.0·10⁻⁸`.
fn scientific(value: f64) -> String {
    let text = format!("{:.1e}", value.abs());
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let raised: String = exponent
        .chars()
        .map(|sign| match sign {
            '-' => '⁻',
            '1' => '¹',
            '2' => '²',
            '3' => '³',
            '0' | '4'..='9' => char::from_u32(0x2070 + sign as u32 - '0' as u32).unwrap_or(sign),
            other => other,
        })
        .collect();
    format!("{}{mantissa}·10{raised}", if value < 0.0 { "−" } else { "" })
}

/// The shortest text of a number on an axis.
pub(super) fn tick(value: f64) -> String {
    let size = value.abs();
    if size != 0.0 && !(1e-3..1e6).contains(&size) {
        return scientific(value).replace("1.0·10", "10").replace(".0·", "·");
    }
    // Ten digits drop what adding steps has left over.
    let text = format!("{:.10}", size);
    let text = text.trim_end_matches('0').trim_end_matches('.');
    let text = if text.is_empty() { "0" } else { text };
    let text = if text.contains('.') { text.to_owned() } else { grouped(text) };
    format!("{}{text}", if value < 0.0 { "−" } else { "" })
}

/// A text as the name of a file or an anchor: lower case letters, digits and hyphens.
pub(super) fn slug(text: &str) -> String {
    let mut slug = String::new();
    for letter in text.chars() {
        if letter.is_ascii_alphanumeric() {
            slug.push(letter.to_ascii_lowercase());
        } else if !slug.ends_with('-') && !slug.is_empty() {
            slug.push('-');
        }
    }
    slug.trim_end_matches('-').to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_have_three_digits() {
        let expected = [
            (percent(0.0208), "2.08\u{202f}%"),
            (percent(0.122), "12.2\u{202f}%"),
            (percent(0.0), "0\u{202f}%"),
            (percent(3e-10), "3.0·10⁻⁸\u{202f}%"),
            (signed_percent(-0.01), "−1.00\u{202f}%"),
            (signed_percent(0.01), "+1.00\u{202f}%"),
            (figure(853.0), "853"),
            (figure(12345.0), "12\u{202f}345"),
            (figure(0.8234), "0.823"),
            (tick(0.1 + 0.2), "0.3"),
            (tick(1e-7), "10⁻⁷"),
            (tick(20000.0), "20\u{202f}000"),
            (tick(-0.5), "−0.5"),
            (tick(2e-4), "2·10⁻⁴"),
            (count(1_065_353_217), "1\u{202f}065\u{202f}353\u{202f}217"),
            (slug("navi21 inverse throughput, fragment"), "navi21-inverse-throughput-fragment"),
        ];
        for (found, expected) in expected {
            assert_eq!(found, expected);
        }
    }
}
