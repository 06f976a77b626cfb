//! Text as pages hold it.

use minijinja::{HtmlEscape, Value};

/// Text that stays within a cell of a Markdown table and is not taken for markup.
pub fn markdown_cell(text: &str) -> String {
    let mut safe = String::new();
    for sign in text.chars() {
        match sign {
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '&' => safe.push_str("&amp;"),
            '\n' | '\r' => safe.push(' '),
            '|' | '*' | '_' | '`' | '[' | ']' | '\\' | '#' => safe.extend(['\\', sign]),
            sign => safe.push(sign),
        }
    }
    safe
}

/// A name that a narrow column may break behind its dots, but for those of numbers.
pub fn breakable(name: &str) -> Value {
    let mut safe = String::new();
    let mut parts = name.split('.').peekable();
    while let Some(part) = parts.next() {
        safe.push_str(&HtmlEscape(part).to_string());
        match parts.peek() {
            Some(next) if next.starts_with(|letter: char| letter.is_ascii_digit()) => safe.push('.'),
            Some(_) => safe.push_str(".<wbr>"),
            None => {}
        }
    }
    Value::from_safe_string(safe)
}

/// Text as a block of code that nothing in it can end.
pub fn indented(text: &str) -> String {
    text.lines().map(|line| format!("    {line}\n")).collect()
}

/// Bytes as text for a data address. [RFC 4648]
pub fn base64(bytes: &[u8]) -> String {
    const SIGNS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for group in bytes.chunks(3) {
        let word = group.iter().fold(0, |word, &byte| word << 8 | u32::from(byte)) << (8 * (3 - group.len()));
        for place in 0..4 {
            let sign = SIGNS[(word >> (18 - 6 * place) & 63) as usize];
            text.push(if place <= group.len() { char::from(sign) } else { '=' });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_follows_the_test_vectors_of_the_standard() {
        let vectors = [
            ("", ""),
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foo", "Zm9v"),
            ("foobar", "Zm9vYmFy"),
        ];
        vectors
            .iter()
            .for_each(|(plain, coded)| assert_eq!(base64(plain.as_bytes()), *coded));
    }

    #[test]
    fn names_break_behind_dots_but_numbers_do_not() {
        assert_eq!(breakable("run.time-step").to_string(), "run.<wbr>time-step");
        assert_eq!(breakable("rate-9.81e7 <a>").to_string(), "rate-9.81e7 &lt;a&gt;");
    }

    #[test]
    fn markdown_cells_cannot_be_left() {
        assert_eq!(markdown_cell("a|b\n<i>"), "a\\|b &lt;i&gt;");
    }
}
