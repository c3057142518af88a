//! Whether an id that a run lacks is the id of another run's check, or of none.

use std::collections::BTreeMap;

use crate::suite::plan::Plan;
use crate::suite::select::Patterns;

/// Mark of an id that `actucheck fuzz` gave; its check is in a file.
const FOUND: &str = ".fuzz-";

/// The first of these ids and globs, each with the number of its row, that is no check's for any
/// options, and what to do about it.
pub(super) fn first_unknown(ids: &[(usize, &str)], widest: &Plan<'_>) -> Option<(usize, String)> {
    let missing = |ids: &[(usize, &str)], form: fn(&str) -> String| {
        let mut forms: BTreeMap<String, Vec<(usize, String)>> = BTreeMap::new();
        for (row, id) in ids {
            forms.entry(form(id)).or_default().push((*row, (*id).to_owned()));
        }
        // These were read as patterns before.
        let patterns = Patterns::new(forms.keys().map(String::as_str)).unwrap_or_default();
        let unmatched = widest.unmatched(&patterns);
        let all = forms.into_values().enumerate();
        all.filter(|(place, _)| unmatched.contains(place))
            .flat_map(|(_, own)| own)
            .collect::<Vec<_>>()
    };
    let asked: Vec<_> = ids.iter().copied().filter(|(_, id)| !id.contains(FOUND)).collect();
    let strange = missing(&asked, str::to_owned);
    let strange: Vec<_> = strange.iter().map(|(row, id)| (*row, id.as_str())).collect();
    let (row, id) = missing(&strange, any_number).into_iter().min()?;
    let nearest = widest.nearest(&id).map(|other| format!("; did you mean `{other}`?"));
    Some((row, format!("`{id}` is the id of no check{}", nearest.unwrap_or_default())))
}

/// A glob for the ids that differ in numbers only, as those of another seed do.
fn any_number(id: &str) -> String {
    let part = |part: &str| {
        let number = part.strip_prefix("seed-").unwrap_or(part);
        let is_number = !number.is_empty() && number.bytes().all(|byte| byte.is_ascii_digit());
        if is_number { part.replace(number, "*") } else { part.to_owned() }
    };
    let name = |name: &str| name.split('.').map(part).collect::<Vec<_>>().join(".");
    id.split('/').map(name).collect::<Vec<_>>().join("/")
}

#[cfg(test)]
mod tests {
    use super::any_number;

    #[test]
    fn seeds_and_numbers_may_be_others() {
        assert_eq!(any_number("d2.seed-7.12.status/decode"), "d2.seed-*.*.status/decode");
        assert_eq!(any_number("d2.ping/decode-1"), "d2.ping/decode-1");
    }
}
