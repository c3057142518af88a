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
