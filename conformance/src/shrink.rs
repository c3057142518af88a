//! Makes what brings a failure about smaller, step by step, while the failure stays.

/// Into how many pieces bytes are cut at most, so that long ones do not take forever.
const PIECES: usize = 64;

/// What can be shrunk.
pub(crate) trait Shrink: Sized {
    /// The same, smaller or plainer in one way each, the largest changes first.
    fn smaller(&self) -> Box<dyn Iterator<Item = Self> + '_>;
}

/// Shrinks something by one change after the other, until none of them leaves the failure as it
/// is, after so many `steps`, or when it no longer `goes_on`. `fails` asks for something smaller;
/// it returns `None` if there is nothing to ask.
pub(crate) fn shrink<T: Shrink>(
    whole: T,
    mut steps: usize,
    goes_on: &dyn Fn() -> bool,
    mut fails: impl FnMut(&T) -> Option<bool>,
) -> T {
    let mut smallest = whole;
    // The place in the list of changes, and whether one succeeded since the list began.
    let (mut place, mut succeeded) = (0, false);
    loop {
        let mut found = None;
        for candidate in smallest.smaller().skip(place) {
            if steps == 0 || !goes_on() {
                break;
            }
            let failed = fails(&candidate);
            steps -= usize::from(failed.is_some());
            if failed == Some(true) {
                found = Some(candidate);
                break;
            }
            place += 1;
        }
        match found {
            // The next change is at the same place in the new list.
            Some(candidate) => (smallest, succeeded) = (candidate, true),
            None if succeeded && steps > 0 && goes_on() => (place, succeeded) = (0, false),
            None => return smallest,
        }
    }
}

/// The same row with one of its items smaller.
pub(crate) fn one_smaller<T: Shrink + Clone>(row: &[T]) -> impl Iterator<Item = Vec<T>> {
    row.iter().enumerate().flat_map(move |(place, item)| {
        item.smaller().map(move |smaller| {
            let mut row = row.to_vec();
            row.iter_mut().skip(place).take(1).for_each(|slot| *slot = smaller.clone());
            row
        })
    })
}

/// Fewer in a row.
impl<T: Clone> Shrink for Vec<T> {
    fn smaller(&self) -> Box<dyn Iterator<Item = Self> + '_> {
        Box::new(without(self))
    }
}

/// The fewest of the items `before` a failure that bring it about, in their order; `None` if even
/// all of them do not. The last ones are tried first: `likely` many, then one, then twice as many each
/// time. Then parts are taken out in so many `steps`.
pub(crate) fn fewest<T: Clone>(
    before: &[T],
    likely: Option<usize>,
    steps: usize,
    goes_on: &dyn Fn() -> bool,
    mut fails_after: impl FnMut(&[T]) -> bool,
) -> Option<Vec<T>> {
    let sizes = std::iter::successors(Some(1), |size| Some(size * 2));
    let likely = likely.filter(|size| *size <= before.len());
    let last = likely
        .into_iter()
        .chain(sizes)
        .take_while(|size| *size < 2 * before.len() && goes_on())
        .map(|size| before.get(before.len().saturating_sub(size)..).unwrap_or_default())
        .find(|last| fails_after(last))?;
    Some(shrink(last.to_vec(), steps, goes_on, |fewer| Some(fails_after(fewer))))
}

/// The places of pieces: the whole, its halves, and so on.
pub(crate) fn pieces(size: usize) -> impl Iterator<Item = (usize, usize)> {
    let least = size.div_ceil(PIECES).max(1);
    let sizes = std::iter::successors(Some(size), |piece| Some(piece / 2));
    let whole = sizes.take_while(move |piece| *piece >= least).flat_map(move |piece| {
        (0..size).step_by(piece).map(move |from| (from, (from + piece).min(size)))
    });
    let end = (least > 1).then(|| (size - 1, size));
    whole.chain(end)
}

/// The items without some in a row.
pub(crate) fn without<T: Clone>(items: &[T]) -> impl Iterator<Item = Vec<T>> + use<'_, T> {
    pieces(items.len()).map(move |(from, to)| {
        let (before, behind) = (items.get(..from), items.get(to..));
        [before.unwrap_or_default(), behind.unwrap_or_default()].concat()
    })
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    /// Shrinks numbers, while those that are needed are among them. Returns what is left, and how
    /// often it was asked.
    fn shrunk(size: usize, needed: &[usize], steps: usize) -> (Vec<usize>, usize) {
        let mut asked = 0;
        let left = shrink((0..size).collect(), steps, &|| true, |numbers: &Vec<usize>| {
            asked += 1;
            Some(needed.iter().all(|number| numbers.contains(number)))
        });
        (left, asked)
    }

    #[test]
    fn what_is_left_is_what_is_needed() {
        for size in [1, 2, 3, 63, 64, 65, 127, 129, 300, 1024, 5000] {
            for needed in [&[][..], &[0], &[size - 1], &[size / 3], &[size / 3, size / 2]] {
                let (left, asked) = shrunk(size, needed, 500);
                let needed: BTreeSet<_> = needed.iter().copied().collect();
                assert_eq!(left, Vec::from_iter(needed), "of {size}");
                assert!(asked <= 500, "{asked} for {size}");
            }
        }
    }

    #[test]
    fn what_is_left_has_the_fewest() {
        for size in [1, 7, 64, 65, 100, 240, 1000, 5000] {
            for least in [0, 1, size / 7, size / 2, size - 1, size] {
                let fails = |numbers: &Vec<usize>| Some(numbers.len() >= least);
                let left = shrink((0..size).collect(), 500, &|| true, fails);
                assert_eq!(left.len(), least, "of {size}");
            }
        }
    }

    /// Whatever fails, at most so many are asked, and what is left failed or is the whole.
    #[test]
    fn it_ends_and_what_is_left_fails() {
        for steps in [0, 1, 2, 10, 100] {
            for seed in 0..50_usize {
                let whole: Vec<_> = (0..200).collect();
                let mut failed = vec![whole.clone()];
                let mut asked = 0;
                let left = shrink(whole, steps, &|| true, |numbers: &Vec<usize>| {
                    asked += 1;
                    let sum: usize = numbers.iter().map(|number| number * (seed + 7)).sum();
                    let fails = sum % 3 != seed % 3;
                    failed.extend(fails.then(|| numbers.clone()));
                    Some(fails)
                });
                assert!(asked <= steps && Some(&left) == failed.last(), "{asked} of {steps}");
            }
        }
        // What there is nothing to ask of, and what comes when there is no more time, is not asked.
        assert_eq!(shrink(vec![1; 9], 100, &|| true, |_| None).len(), 9);
        assert_eq!(shrink(vec![1; 9], 100, &|| false, |_| Some(true)).len(), 9);
    }

    #[test]
    fn the_fewest_earlier_ones_are_the_last_that_are_needed() {
        let before: Vec<_> = (0..1000).collect();
        for needed in [&[999][..], &[998], &[500], &[0], &[3, 700]] {
            let fails = |row: &[usize]| needed.iter().all(|number| row.contains(number));
            let row = fewest(&before, None, 200, &|| true, fails);
            assert_eq!(row.as_deref(), Some(needed));
        }
        assert_eq!(fewest(&before, None, 200, &|| true, |_| false), None);
        // One that counts needs as many as it counts.
        let row = fewest(&before, Some(36), 200, &|| true, |row| row.len() % 37 == 36);
        assert_eq!(row.map(|row| row.len()), Some(36));
    }
}
