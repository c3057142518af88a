//! Registers that stand for others: the byte Indirect Data 1 is the one at the address that Indirect
//! Address 1 holds, and so on.

use std::ops::Range;

use actucheck_codec::register::{Device, Row};

/// The pairs of a control table, in the order of the data's addresses.
#[derive(Debug)]
pub(super) struct Indirect(Vec<(usize, &'static Row)>);

impl Indirect {
    pub(super) fn of(table: &Device) -> Self {
        let pair = |data: &&'static Row| {
            let number = data.name.strip_prefix("Indirect Data ")?;
            let address = table.register_named(&format!("Indirect Address {number}"))?;
            Some((usize::from(data.address), address))
        };
        Self(table.registers.iter().filter_map(pair).collect())
    }

    /// The runs of addresses that `place` stands for, in its order; `value` tells what a register
    /// holds. Who names another byte of Indirect Data gets that byte, and not what it stands for.
    pub(super) fn runs(
        &self,
        place: Range<usize>,
        value: impl Fn(&Row) -> i64,
    ) -> Vec<Range<usize>> {
        let first = self.0.partition_point(|(data, _)| *data < place.start);
        let last = self.0.partition_point(|(data, _)| *data < place.end);
        let mut pairs = self.0.get(first..last).unwrap_or_default().iter().peekable();
        if pairs.peek().is_none() {
            return vec![place];
        }
        let mut runs: Vec<Range<usize>> = Vec::new();
        for at in place {
            let pair = pairs.next_if(|(data, _)| *data == at);
            let target = pair.and_then(|(_, row)| value(row).try_into().ok()).unwrap_or(at);
            match runs.last_mut() {
                Some(run) if run.end == target => run.end += 1,
                _ => runs.push(target..target + 1),
            }
        }
        runs
    }
}
