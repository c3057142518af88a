//! Measurements as tables in Markdown.

use std::fmt::Write as _;

use crate::contender::{OURS, PORTABLE, READ, is_peer};
use crate::goals::{
    AS_FAST_AS_READING, GROWTH, OF_READING, READ_ANSWERED, SYNC_READ_CARRIED, goal,
};
use crate::measured::Measured;

/// One case: the codec, the best peer, and the goal.
#[derive(Clone, Debug, PartialEq)]
pub struct Row<'a> {
    /// The codec's measurement.
    pub ours: &'a Measured,
    /// The codec's measurement without instructions that only some processors have, if they make a
    /// difference.
    pub portable: Option<&'a Measured>,
    /// The fastest peer's measurement, if there is a peer.
    pub peer: Option<&'a Measured>,
    /// The time of only reading the bytes, if it was measured.
    pub reading: Option<&'a Measured>,
    /// The goal: the factor by which the codec must be faster than the peer.
    pub goal: Option<f64>,
}

impl Row<'_> {
    /// The factor by which the codec is faster than the best peer.
    #[must_use]
    pub fn ratio(&self) -> Option<f64> {
        self.peer.map(|peer| peer.per_unit() / self.ours.per_unit())
    }

    /// The speed as a fraction of the speed of only reading the bytes.
    #[must_use]
    pub fn of_reading(&self) -> Option<f64> {
        self.reading.map(|reading| reading.per_unit() / self.ours.per_unit())
    }

    /// Whether the goal, if there is one, is reached, or there is no more to gain.
    #[must_use]
    pub fn met(&self) -> Option<bool> {
        let as_fast = self.of_reading().is_some_and(|part| part >= AS_FAST_AS_READING);
        self.goal.zip(self.ratio()).map(|(goal, ratio)| ratio >= goal || as_fast)
    }

    /// [`met`](Self::met) in a word or some.
    #[must_use]
    pub fn verdict(&self) -> String {
        let beaten = self.goal.zip(self.ratio()).is_some_and(|(goal, ratio)| ratio >= goal);
        match (self.met(), self.of_reading()) {
            (Some(true), Some(part)) if !beaten => format!("met, {part:.2} of reading"),
            (met, _) => met.map_or("", verdict).to_owned(),
        }
    }
}

const fn verdict(met: bool) -> &'static str {
    if met { "met" } else { "**missed**" }
}

/// One row per case of the codec, measured where it has registers of so many bits.
#[must_use]
pub fn rows<'a>(all: &'a [Measured], bits: u32) -> Vec<Row<'a>> {
    let ours = all.iter().filter(|measured| measured.who == OURS);
    let row = |ours: &'a Measured| {
        let ours_case = (&ours.group, &ours.case);
        let others = || all.iter().filter(move |other| (&other.group, &other.case) == ours_case);
        let peers = others().filter(|other| is_peer(&other.who));
        let peer = peers.min_by(|a, b| a.per_unit().total_cmp(&b.per_unit()));
        let portable = others().find(|other| other.who == PORTABLE);
        let reading = others().find(|other| other.who == READ);
        let goal = goal(&ours.group, &ours.case, bits);
        Row { ours, portable, peer, reading, goal }
    };
    ours.map(row).collect()
}

/// All tables, of a machine with registers of so many bits.
#[must_use]
pub fn markdown(all: &[Measured], bits: u32) -> String {
    let rows = rows(all, bits);
    let mut text = String::new();
    let mut groups: Vec<_> = rows.iter().map(|row| row.ours.group.as_str()).collect();
    groups.dedup();
    for group in groups {
        let rows: Vec<_> = rows.iter().filter(|row| row.ours.group == group).collect();
        // Writing to a string can't fail.
        let _ = write!(text, "\n### {group}\n\n{}", table(&rows));
    }
    text + &limits(all)
}

fn table(rows: &[&Row]) -> String {
    let mut text = if rows.iter().any(|row| row.peer.is_some()) {
        "| case | ours, ns | portable | best peer | its ns | ratio | ± | goal | |\n\
         |---|---:|---:|---|---:|---:|---:|---:|---|\n"
            .to_owned()
    } else {
        "| case | ours, ns | GB/s |\n|---|---:|---:|\n".to_owned()
    };
    for row in rows {
        let ours = row.ours;
        // The time of a message, or of a packet.
        let size = bytes(ours).unwrap_or(1.0);
        let time = |measured: &Measured| format!("{:.1}", measured.per_unit() * size);
        let _ = if let Some(peer) = row.peer {
            writeln!(
                text,
                "| {} | {} | {} | {}{} | {} | {:.2} | {:.0} % | {} | {} |",
                ours.case,
                time(ours),
                row.portable.map(time).unwrap_or_default(),
                peer.who,
                share(ours, peer),
                time(peer),
                row.ratio().unwrap_or(0.0),
                (ours.error + peer.error) * 100.0,
                row.goal.map(|goal| format!("{goal:.1}")).unwrap_or_default(),
                row.verdict(),
            )
        } else {
            let speed = bytes(ours).map(|_| format!("{:.2}", 1.0 / ours.per_unit()));
            writeln!(text, "| {} | {} | {} |", ours.case, time(ours), speed.unwrap_or_default())
        };
    }
    text
}

/// The size of a case that is measured in bytes.
fn bytes(measured: &Measured) -> Option<f64> {
    measured.case.parse().ok().filter(|_| !measured.group.contains("code"))
}

/// The fraction of the packets that a peer finds, if not all.
fn share(ours: &Measured, peer: &Measured) -> String {
    let share = peer.units / ours.units;
    if ours.group == "stream" && share < 1.0 {
        format!(", finds {:.1} %", share * 100.0)
    } else {
        String::new()
    }
}

/// The goals that have no peer.
fn limits(all: &[Measured]) -> String {
    let find = |group: &str, case: &str, who: &str| {
        let wanted = |measured: &&Measured| {
            (measured.group.as_str(), measured.case.as_str(), measured.who.as_str())
                == (group, case, who)
        };
        all.iter().find(wanted)
    };
    let mut text = "\n### Limits\n\n| what | is | goal | |\n|---|---:|---:|---|\n".to_owned();
    for group in ["umts", "modbus"] {
        if let Some((ours, read)) = find(group, "65536", OURS).zip(find(group, "65536", READ)) {
            let part = read.time / ours.time;
            let met = verdict(part >= OF_READING);
            let _ = writeln!(
                text,
                "| {group} at 64 KiB, of the speed of reading | {part:.2} | {OF_READING} | {met} |"
            );
        }
    }
    for (what, case, most) in [
        ("a Read answered in process, ns", "Read", READ_ANSWERED),
        ("a Sync Read of 253 devices, ns", "Sync Read of 253", SYNC_READ_CARRIED),
    ] {
        if let Some(ours) = find("bus", case, OURS) {
            let met = verdict(ours.time <= most);
            let _ = writeln!(text, "| {what} | {:.0} | at most {most:.0} | {met} |", ours.time);
        }
    }
    for trap in ["trap", "unstuffed trap"] {
        let (once, twice) = (format!("{trap}, 256 KiB"), format!("{trap}, 512 KiB"));
        if let Some((once, twice)) = find("stream", &once, OURS).zip(find("stream", &twice, OURS)) {
            let growth = twice.time / once.time;
            let met = verdict(growth <= GROWTH);
            let _ = writeln!(
                text,
                "| {trap}: time for twice the input | {growth:.2} | at most {GROWTH} | {met} |"
            );
        }
    }
    text
}
