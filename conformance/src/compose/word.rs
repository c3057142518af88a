use std::convert::Infallible;
use std::fmt;
use std::str::FromStr;

/// A word of a packet: `ID:NAME=VALUE`, where ID and value may be missing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Word {
    /// The device that it is for.
    pub id: Option<u8>,
    /// The name of a register or a field.
    pub name: String,
    /// Its value.
    pub value: Option<String>,
}

impl FromStr for Word {
    type Err = Infallible;

    fn from_str(text: &str) -> Result<Self, Infallible> {
        let (left, value) = match text.split_once('=') {
            Some((left, value)) => (left, Some(value.trim().to_owned())),
            None => (text, None),
        };
        let for_one =
            left.split_once(':').and_then(|(id, name)| Some((id.trim().parse().ok()?, name)));
        let (id, name) = for_one.map_or((None, left), |(id, name)| (Some(id), name));
        Ok(Self { id, name: name.trim().to_owned(), value })
    }
}

/// As it is written.
impl fmt::Display for Word {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(id) = self.id {
            write!(f, "{id}:")?;
        }
        f.write_str(&self.name)?;
        self.value.as_ref().map_or(Ok(()), |value| write!(f, "={value}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_word_has_a_device_a_name_and_a_value_or_less() {
        let word = |text: &str| text.parse::<Word>().unwrap();
        let full = word("7:goal-position = 45 deg");
        assert_eq!((full.id, full.name.as_str()), (Some(7), "goal-position"));
        assert_eq!(full.value.as_deref(), Some("45 deg"));
        assert_eq!(word("led"), Word { id: None, name: "led".to_owned(), value: None });
        assert_eq!(word("x:led").name, "x:led");
    }
}
