//! Draws growth: time and memory over the work, each run a point; all axes are logarithmic.

use std::fmt::Write as _;

use crate::chart::{STYLE, along};
use crate::growth::{Command, Growth, Run, float};

const TOP: f64 = 56.0;
const BOTTOM: f64 = 330.0;
const WIDTH: f64 = 270.0;
/// Units of work, from left to right.
const WORK: (f64, f64) = (100.0, 1e8);

/// One of the two drawings.
struct Panel {
    title: &'static str,
    left: f64,
    range: (f64, f64),
    lines: &'static [f64],
    value: fn(&Run) -> f64,
}

const PANELS: [Panel; 2] = [
    Panel {
        title: "processor time, s",
        left: 52.0,
        range: (0.01, 1000.0),
        lines: &[0.01, 0.1, 1.0, 10.0, 100.0, 1000.0],
        value: |run| run.seconds,
    },
    Panel {
        title: "peak memory, MiB",
        left: 400.0,
        range: (1.0, 1000.0),
        lines: &[1.0, 10.0, 100.0, 1000.0],
        value: Run::mebibytes,
    },
];

/// Both panels, each command a line.
#[must_use]
pub fn svg(growth: &Growth) -> String {
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 800 390\" role=\"img\" \
         aria-label=\"Time and memory over the work\">\n<style>{STYLE}</style>\n\
         <rect class=\"back\" width=\"800\" height=\"390\" fill=\"#ffffff\"/>\n"
    );
    for panel in &PANELS {
        grid(&mut svg, panel);
        for command in &growth.commands {
            line(&mut svg, panel, command);
        }
    }
    svg + "</svg>\n"
}

fn grid(svg: &mut String, panel: &Panel) {
    let (left, right) = (panel.left, panel.left + WIDTH);
    // Writing to a string can't fail.
    let _ = writeln!(svg, "<text class=\"title\" x=\"{left}\" y=\"28\">{}</text>", panel.title);
    for (work, label) in [
        (100.0, "100"),
        (1e3, "1,000"),
        (1e4, "10⁴"),
        (1e5, "10⁵"),
        (1e6, "10⁶"),
        (1e7, "10⁷"),
        (1e8, "10⁸"),
    ] {
        let x = along(work, WORK, left, right);
        let _ = writeln!(svg, "<path class=\"grid\" d=\"M{x:.1},{TOP} V{BOTTOM}\"/>");
        let y = BOTTOM + 20.0;
        let _ = writeln!(svg, "<text x=\"{x:.1}\" y=\"{y}\" text-anchor=\"middle\">{label}</text>");
    }
    for value in panel.lines {
        let y = along(*value, panel.range, BOTTOM, TOP);
        let (x, low) = (left - 8.0, y + 4.0);
        let _ = writeln!(svg, "<path class=\"grid\" d=\"M{left},{y:.1} H{right}\"/>");
        let _ = writeln!(svg, "<text x=\"{x}\" y=\"{low:.1}\" text-anchor=\"end\">{value}</text>");
    }
    let (x, y) = (f64::midpoint(left, right), BOTTOM + 44.0);
    let _ = writeln!(
        svg,
        "<text x=\"{x}\" y=\"{y}\" text-anchor=\"middle\">checks, packets, requests, conversations</text>"
    );
}

fn line(svg: &mut String, panel: &Panel, Command { name, runs, .. }: &Command) {
    let place = |run: &Run| {
        let x = along(float(run.work), WORK, panel.left, panel.left + WIDTH);
        (x, along((panel.value)(run), panel.range, BOTTOM, TOP))
    };
    let places: Vec<_> = runs.iter().map(place).collect();
    let points: Vec<_> = places.iter().map(|(x, y)| format!("{x:.1},{y:.1}")).collect();
    let _ = writeln!(svg, "<polyline class=\"ours\" points=\"{}\"/>", points.join(" "));
    if let Some((x, y)) = places.last() {
        let (x, y) = (x - 4.0, y - 8.0);
        let _ = writeln!(
            svg,
            "<text class=\"ours\" x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"end\">{name}</text>"
        );
    }
}
