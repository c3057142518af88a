//! Values of options.

use std::time::Duration;

use actucheck::adapter::Wire;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};

/// Takes one of several values by its name. Help and completions list the names, each with its
/// meaning.
pub(crate) fn one_of<T>(
    values: impl IntoIterator<Item = (T, &'static str, &'static str)>,
) -> impl TypedValueParser<Value = T>
where
    T: Clone + Send + Sync + 'static,
{
    let (values, names): (Vec<_>, Vec<_>) = values
        .into_iter()
        .map(|(value, name, meaning)| ((name, value), PossibleValue::new(name).help(meaning)))
        .unzip();
    PossibleValuesParser::new(names).try_map(move |given| {
        let value = values.iter().find(|(name, _)| *name == given);
        value.map(|(_, value)| value.clone()).ok_or("no such value")
    })
}

/// Takes a wire by its id.
pub(crate) fn wire() -> impl TypedValueParser<Value = Wire> {
    one_of(Wire::ALL.map(|wire| (wire, wire.id(), wire.title())))
}

/// Takes a number of seconds.
pub(crate) fn seconds(text: &str) -> Result<Duration, String> {
    positive(text, 1.0)
        .ok_or_else(|| "a time is a number of seconds above 0, such as 0.5".to_owned())
}

/// Takes a number of milliseconds.
pub(crate) fn milliseconds(text: &str) -> Result<Duration, String> {
    positive(text, 1e-3).ok_or_else(|| "a time is a number of ms above 0, such as 100".to_owned())
}

/// Takes a number of seconds, minutes or hours.
pub(crate) fn duration(text: &str) -> Result<Duration, String> {
    let units = [('s', 1.0), ('m', 60.0), ('h', 3600.0)];
    let unit = units.into_iter().find_map(|(unit, size)| Some((text.strip_suffix(unit)?, size)));
    let (number, size) = unit.unwrap_or((text, 1.0));
    positive(number, size)
        .ok_or_else(|| "a time is a number above 0 with s, m or h, such as 90s".to_owned())
}

fn positive(number: &str, seconds: f64) -> Option<Duration> {
    let number: f64 = number.parse().ok().filter(|number| *number > 0.0)?;
    Duration::try_from_secs_f64(number * seconds).ok()
}
