//! Names as people write them: as a word, or nearly like a known one.

use std::collections::BTreeSet;

/// A name as a word: `Goal Position` is `goal-position`.
#[must_use]
pub fn as_word(name: &str) -> String {
    let mut word = String::with_capacity(name.len());
    for letter in name.chars() {
        if letter.is_alphanumeric() {
            word.extend(letter.to_lowercase());
        } else if !word.is_empty() && !word.ends_with('-') {
            word.push('-');
        }
    }
    let length = word.trim_end_matches('-').len();
    word.truncate(length);
    word
}

/// The known names that may be meant by one that is not known: a few that contain it, in whatever
/// case, or else the [`nearest`].
#[must_use]
pub fn similar(wanted: &str, known: impl IntoIterator<Item = String> + Clone) -> Vec<String> {
    const SHOWN: usize = 8;
    let wanted = wanted.to_lowercase();
    let has = |name: &String| name.to_lowercase().contains(&wanted);
    let longer: BTreeSet<_> = known.clone().into_iter().filter(has).take(SHOWN).collect();
    if longer.is_empty() {
        nearest(&wanted, known).into_iter().collect()
    } else {
        longer.into_iter().collect()
    }
}

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
        pairs.take_while(|(letter, other)| letter.eq_ignore_ascii_case(other)).count()
    };
    let first = same(&mut wanted.bytes().zip(other.bytes()));
    let last = same(&mut wanted.bytes().rev().zip(other.bytes().rev()));
    (first + last).min(wanted.len()).min(other.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_is_a_word() {
        assert_eq!(as_word("Feedforward 2nd Gain"), "feedforward-2nd-gain");
        assert_eq!(as_word(" 9,600 bps (EEPROM)"), "9-600-bps-eeprom");
        assert_eq!(as_word("-"), "");
    }

    #[test]
    fn names_that_contain_the_wanted_one_come_before_the_nearest() {
        let known = ["Goal Position", "Goal Current", "Present Position"].map(str::to_owned);
        assert_eq!(similar("goal", known.clone()), ["Goal Current", "Goal Position"]);
        assert_eq!(similar("Present Positron", known.clone()), ["Present Position"]);
        assert_eq!(similar("LED", known), [""; 0]);
    }

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
