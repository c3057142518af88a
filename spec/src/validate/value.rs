//! Rule: initial values, ranges, named values and bits fit their register.

use crate::load::File;
use crate::model::{Bound, Device, Range, Register};
use crate::{Diagnostic, Spec};

pub(super) fn check(spec: &Spec) -> Vec<Diagnostic> {
    let mut defects = Vec::new();
    for file in &spec.devices {
        for (index, register) in file.content.registers.iter().enumerate() {
            let row = Row { file, register, node: format!("registers[{index}]") };
            row.initial(&mut defects);
            row.ranges(&mut defects);
            row.values(&mut defects);
            row.bits(&mut defects);
        }
    }
    defects
}

struct Row<'a> {
    file: &'a File<Device>,
    register: &'a Register,
    node: String,
}

impl Row<'_> {
    fn initial(&self, defects: &mut Vec<Diagnostic>) {
        let Some(initial) = self.register.initial else {
            return;
        };
        if let Some(message) = self.misfit("initial value", initial) {
            defects.push(self.at("initial", &message));
        } else if let Some(range) = &self.register.range
            && outside(range, initial)
        {
            let message = format!("initial value {initial} is outside the range");
            defects.push(self.at("initial", &message));
        }
    }

    /// The range, and those of other meanings.
    fn ranges(&self, defects: &mut Vec<Diagnostic>) {
        if let Some(range) = &self.register.range {
            self.range("range", range, defects);
        }
        for (index, meaning) in self.register.meanings.iter().enumerate() {
            let node = format!("meanings[{index}]");
            match &meaning.range {
                Some(range) => self.range(&format!("{node}.range"), range, defects),
                None if meaning.unit.is_none() => {
                    defects.push(self.at(&node, "a meaning has a `range`, a `unit` or both"));
                }
                None => {}
            }
        }
    }

    fn range(&self, node: &str, range: &Range, defects: &mut Vec<Diagnostic>) {
        let shape = matches!(
            (&range.min, &range.max, &range.one_of),
            (Some(_), Some(_), None) | (None, None, Some(_))
        );
        if !shape {
            defects.push(self.at(node, "a range has either `min` and `max` or `one_of`"));
        }
        if let (Some(Bound::Value(min)), Some(Bound::Value(max))) = (&range.min, &range.max)
            && min > max
        {
            defects.push(self.at(node, &format!("the range begins at {min} and ends at {max}")));
        }
        for (end, bound) in [("min", &range.min), ("max", &range.max)] {
            if let Some(Bound::Value(value)) = bound
                && let Some(message) = self.misfit("bound", *value)
            {
                defects.push(self.at(&format!("{node}.{end}"), &message));
            }
        }
        for value in range.one_of.iter().flatten() {
            let misfit = self.misfit("value", *value);
            defects.extend(misfit.map(|message| self.at(&format!("{node}.one_of"), &message)));
        }
    }

    fn values(&self, defects: &mut Vec<Diagnostic>) {
        for (index, row) in self.register.values.iter().enumerate() {
            let node = format!("values[{index}].value");
            defects.extend(self.misfit("value", row.value).map(|message| self.at(&node, &message)));
        }
    }

    fn bits(&self, defects: &mut Vec<Diagnostic>) {
        let mut taken = 0;
        let size = u32::from(self.register.kind.size()) * 8;
        for (index, field) in self.register.bits.iter().enumerate() {
            let node = format!("bits[{index}]");
            let mask = field.mask();
            if field.width == 0 || u32::from(field.lowest) + u32::from(field.width) > size {
                let message = format!("{} leaves the register's {size} bits", field.name);
                defects.push(self.at(&node, &message));
            } else if taken & mask != 0 {
                let message = format!("{} overlaps the bits of a field before it", field.name);
                defects.push(self.at(&node, &message));
            }
            taken |= mask;
            for (value, row) in field.values.iter().enumerate() {
                let fits =
                    u64::try_from(row.value).is_ok_and(|value| value <= mask >> field.lowest);
                if !fits {
                    let message =
                        format!("value {} needs more bits than {}", row.value, field.width);
                    defects.push(self.at(&format!("{node}.values[{value}].value"), &message));
                }
            }
        }
    }

    fn misfit(&self, what: &str, value: i64) -> Option<String> {
        let kind = self.register.kind;
        let (min, max) = kind.limits();
        (!kind.holds(value))
            .then(|| format!("{what} {value} does not fit {} bytes, {min} to {max}", kind.size()))
    }

    fn at(&self, node: &str, message: &str) -> Diagnostic {
        let message = format!("{}({}): {message}", self.register.name, self.register.address);
        self.file.diagnostic(&format!("{}.{node}", self.node), message)
    }
}

/// Whether the numbers of a range exclude a value. Bounds that are registers are ignored.
fn outside(range: &Range, value: i64) -> bool {
    let below = matches!(range.min, Some(Bound::Value(min)) if value < min);
    let above = matches!(range.max, Some(Bound::Value(max)) if value > max);
    let missing = range.one_of.as_ref().is_some_and(|values| !values.contains(&value));
    below || above || missing
}
