//! A text that tells whether it is still what was written.
//!
//! Its seal is the BLAKE3 of all of it, hexadecimal, taken with zeros in the place of the seal.

/// Stands in a text until it is sealed.
pub const OPEN: &str = "0000000000000000000000000000000000000000000000000000000000000000";

/// The text with its seal in the place of [`OPEN`].
pub fn sealed(text: &str) -> String {
    text.replacen(OPEN, &checksum(text), 1)
}

/// Whether a text still has the seal that it was given.
pub fn is_whole(text: &str, seal: &str) -> bool {
    seal.len() == OPEN.len() && text.contains(seal) && checksum(&text.replacen(seal, OPEN, 1)) == seal
}

fn checksum(text: &str) -> String {
    blake3::hash(text.as_bytes()).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_bit_of_a_sealed_text_counts() {
        let text = format!("{{\"length\": \"115 nm\", \"seal\": \"{OPEN}\"}}");
        let sealed = sealed(&text);
        let at = text.find(OPEN).unwrap();
        let seal = |text: &str| text[at..at + OPEN.len()].to_owned();
        assert!(is_whole(&sealed, &seal(&sealed)));
        for byte in 0..sealed.len() {
            for bit in 0..7 {
                let mut bytes = sealed.clone().into_bytes();
                bytes[byte] ^= 1 << bit;
                let damaged = String::from_utf8(bytes).unwrap();
                assert!(!is_whole(&damaged, &seal(&damaged)), "byte {byte}, bit {bit}");
            }
        }
    }
}
