//! The known name that somebody means who gives one that is not known.

/// The first name that is most like `wanted`: it contains it, or begins and ends like it for more
/// than half of its length. `None` if there is no such name.
#[must_use]
pub fn nearest(wanted: &str, known: impl IntoIterator<Item = String>) -> Option<String> {
    let mut nearest = (wanted.len() / 2, None);
    for other in known {
        let alike = alike(wanted, &other);
        if alike > nearest.0 {
            nearest = (alike, Some(other));
        }
    }
    nearest.1
}

/// How many bytes two names have in common at both ends.
fn alike(wanted: &str, other: &str) -> usize {
    if other.contains(wanted) {
        return wanted.len();
    }
    let same = |pairs: &mut dyn Iterator<Item = (u8, u8)>| {
        pairs.take_while(|(letter, other)| letter == other).count()
    };
    let first = same(&mut wanted.bytes().zip(other.bytes()));
    let last = same(&mut wanted.bytes().rev().zip(other.bytes().rev()));
    (first + last).min(wanted.len()).min(other.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_wrong_letter_and_a_part_are_understood() {
        let known = ["innfos.crc.value", "ja40.ping/encode", "ja40.ping/decode"];
        let known = || known.map(str::to_owned);
        assert_eq!(nearest("infos.crc.value", known()).as_deref(), Some("innfos.crc.value"));
        assert_eq!(nearest("ja40.pong/decode", known()).as_deref(), Some("ja40.ping/decode"));
        assert_eq!(nearest("ping", known()).as_deref(), Some("ja40.ping/encode"));
        assert_eq!(nearest("no.such.id", known()), None);
    }
}
