//! Draws the CRC's throughput: both axes are logarithmic, with one line per contender.

use std::fmt::Write as _;

use crate::contender::{OURS, PORTABLE, is_peer};
use crate::measured::Measured;

const LEFT: f64 = 62.0;
const RIGHT: f64 = 610.0;
const TOP: f64 = 56.0;
const BOTTOM: f64 = 430.0;
const SIZES: (f64, f64) = (8.0, 1_048_576.0);
const SPEEDS: (f64, f64) = (0.2, 128.0);

/// Colours for light and dark backgrounds: strong ones for the codec, pale ones for the peers.
pub(crate) const STYLE: &str = "
  text { font: 13px system-ui, sans-serif; fill: #57606a }
  .title { font-size: 16px; font-weight: 600; fill: #1f2328 }
  .grid { stroke: #d0d7de; stroke-width: 1 }
  polyline { fill: none; stroke: #8c959f; stroke-width: 1.5; stroke-linejoin: round }
  .ours { stroke: #0969da; stroke-width: 3.5 }
  .portable { stroke: #0969da; stroke-width: 2.5; stroke-dasharray: 6 4 }
  text.ours, text.portable { fill: #0969da; stroke: none; font-weight: 600 }
  .join { stroke: #8c959f; stroke-width: 0.75; stroke-dasharray: 2 2; fill: none }
  @media (prefers-color-scheme: dark) {
    .back { fill: #0d1117 }
    text { fill: #9198a1 }
    .title { fill: #f0f6fc }
    .grid { stroke: #30363d }
    .ours, .portable { stroke: #58a6ff }
    text.ours, text.portable { fill: #58a6ff }
  }
";

/// The picture of the group `umts`.
#[must_use]
pub fn svg(all: &[Measured]) -> String {
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 800 490\" role=\"img\" \
         aria-label=\"CRC throughput over message size\">\n<style>{STYLE}</style>\n\
         <rect class=\"back\" width=\"800\" height=\"490\" fill=\"#ffffff\"/>\n\
         <text class=\"title\" x=\"{LEFT}\" y=\"24\">CRC-16/UMTS, gigabytes a second</text>\n"
    );
    grid(&mut svg);
    let mut lines = lines(all);
    // From the fastest down; labels that would touch are moved apart, upwards first.
    lines.sort_by(|a, b| a.end().total_cmp(&b.end()));
    let mut labels: Vec<f64> = lines.iter().map(Line::end).collect();
    spread(&mut labels);
    for (line, label) in lines.iter().zip(labels) {
        let points: Vec<_> = line.points.iter().map(|(x, y)| format!("{x:.1},{y:.1}")).collect();
        let class = match line.who {
            OURS => "ours",
            PORTABLE => "portable",
            _ => "peer",
        };
        // Writing to a string can't fail.
        let _ = writeln!(svg, "<polyline class=\"{class}\" points=\"{}\"/>", points.join(" "));
        let (end, edge) = (line.end(), RIGHT + 14.0);
        let _ = writeln!(svg, "<path class=\"join\" d=\"M{RIGHT},{end:.1} L{edge},{label:.1}\"/>");
        let (x, y) = (edge + 4.0, label + 4.0);
        let _ = writeln!(svg, "<text class=\"{class}\" x=\"{x}\" y=\"{y:.1}\">{}</text>", line.who);
    }
    svg + "</svg>\n"
}

fn grid(svg: &mut String) {
    for (size, label) in
        [(8.0, "8 B"), (64.0, "64 B"), (512.0, "512 B"), (4096.0, "4 KiB"), (32_768.0, "32 KiB")]
            .into_iter()
            .chain([(262_144.0, "256 KiB"), (SIZES.1, "1 MiB")])
    {
        let x = along(size, SIZES, LEFT, RIGHT);
        let y = BOTTOM + 20.0;
        let _ = writeln!(svg, "<path class=\"grid\" d=\"M{x:.1},{TOP} V{BOTTOM}\"/>");
        let _ = writeln!(svg, "<text x=\"{x:.1}\" y=\"{y}\" text-anchor=\"middle\">{label}</text>");
    }
    for speed in [0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0] {
        let y = along(speed, SPEEDS, BOTTOM, TOP);
        let (x, low) = (LEFT - 8.0, y + 4.0);
        let _ = writeln!(svg, "<path class=\"grid\" d=\"M{LEFT},{y:.1} H{RIGHT}\"/>");
        let _ = writeln!(svg, "<text x=\"{x}\" y=\"{low:.1}\" text-anchor=\"end\">{speed}</text>");
    }
    let (x, y) = (f64::midpoint(LEFT, RIGHT), BOTTOM + 44.0);
    let _ = writeln!(svg, "<text x=\"{x}\" y=\"{y}\" text-anchor=\"middle\">message size</text>");
}

struct Line<'a> {
    who: &'a str,
    points: Vec<(f64, f64)>,
}

impl Line<'_> {
    /// The height at which the line ends.
    fn end(&self) -> f64 {
        self.points.last().map_or(BOTTOM, |point| point.1)
    }
}

fn lines(all: &[Measured]) -> Vec<Line<'_>> {
    let mut lines: Vec<Line> = Vec::new();
    let drawn = |who: &str| is_peer(who) || [OURS, PORTABLE].contains(&who);
    for measured in all.iter().filter(|other| other.group == "umts" && drawn(&other.who)) {
        let Ok(size) = measured.case.parse() else { continue };
        let x = along(size, SIZES, LEFT, RIGHT);
        let y = along(1.0 / measured.per_unit(), SPEEDS, BOTTOM, TOP);
        match lines.iter_mut().find(|line| line.who == measured.who) {
            Some(line) => line.points.push((x, y)),
            None => lines.push(Line { who: &measured.who, points: vec![(x, y)] }),
        }
    }
    lines
}

/// The position of a value between `from` and `to`, by its place in its range.
pub(crate) fn along(value: f64, (least, most): (f64, f64), from: f64, to: f64) -> f64 {
    from + (to - from) * (value / least).ln() / (most / least).ln()
}

/// Moves heights, which are in order, apart, and keeps their middle.
fn spread(heights: &mut [f64]) {
    const GAP: f64 = 17.0;
    for _ in 0..200 {
        for at in 1..heights.len() {
            if let Some([above, below]) = heights.get_mut(at - 1..=at)
                && *below - *above < GAP
            {
                let apart = (GAP - (*below - *above)) / 2.0;
                *above -= apart;
                *below += apart;
            }
        }
    }
}
