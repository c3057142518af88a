//! Runs `tshark` with the dissector, and reads what it shows.

use std::fs;
use std::io::{Write as _, stderr};
use std::process::Command;

use actucheck_spec::model::HexBytes;
use actucheck_spec::wire::Wire;

/// What `tshark` shows of a packet: fields in their order, with the text and the bytes of each.
#[derive(Clone, Debug)]
pub(crate) struct Shown {
    /// The number of the record.
    pub(crate) record: usize,
    /// Where it begins in the record.
    pub(crate) at: usize,
    fields: Vec<(String, String, String)>,
}

impl Shown {
    /// The texts of all fields with this name after the wire's.
    pub(crate) fn texts<'a>(&'a self, name: &'a str) -> impl Iterator<Item = &'a str> {
        self.fields.iter().filter(move |field| field.0 == name).map(|field| field.1.as_str())
    }

    /// The text of a field.
    pub(crate) fn text<'a>(&'a self, name: &'a str) -> Option<&'a str> {
        self.texts(name).next()
    }

    /// The number in a field.
    pub(crate) fn number(&self, name: &str) -> Option<u64> {
        let text = self.text(name)?;
        let hex = text.strip_prefix("0x").map(|digits| u64::from_str_radix(digits, 16));
        hex.unwrap_or_else(|| text.parse()).ok()
    }

    /// The byte in a field.
    pub(crate) fn byte(&self, name: &str) -> Option<u8> {
        self.number(name).and_then(|number| number.try_into().ok())
    }

    /// The bytes of all fields with this name.
    pub(crate) fn all_bytes(&self, name: &str) -> Vec<HexBytes> {
        let own = self.fields.iter().filter(|field| field.0 == name);
        own.map(|field| HexBytes::parse(&field.2).unwrap()).collect()
    }

    /// The bytes of a field; none if it is not there.
    pub(crate) fn bytes(&self, name: &str) -> HexBytes {
        self.all_bytes(name).into_iter().next().unwrap_or_else(|| Vec::new().into())
    }

    /// The names of all expert infos.
    pub(crate) fn experts(&self) -> impl Iterator<Item = &str> {
        self.names().filter_map(|name| name.strip_prefix("expert."))
    }

    /// The names of all fields.
    pub(crate) fn names(&self) -> impl Iterator<Item = &str> {
        self.fields.iter().map(|field| field.0.as_str())
    }
}

/// Whether there is `tshark`. If not, prints a note, which the test harness does not hide.
pub(crate) fn is_there() -> bool {
    let there = Command::new("tshark").arg("--version").output().is_ok();
    if !there {
        let note = || writeln!(stderr(), "skipped: there is no `tshark`");
        note().unwrap();
    }
    there
}

/// The packets of a wire that `tshark` shows of a capture.
pub(crate) fn show(script: &str, wire: Wire, capture: &[u8], options: &[&str]) -> Vec<Shown> {
    let folder = tempfile::tempdir().unwrap();
    let [lua, pcap] = ["actucheck.lua", "capture.pcap"].map(|name| folder.path().join(name));
    fs::write(&lua, script).unwrap();
    fs::write(&pcap, capture).unwrap();
    let output = Command::new("tshark")
        // A user's own settings and scripts must not matter.
        .env("WIRESHARK_CONFIG_DIR", folder.path())
        .arg("-X")
        .arg(format!("lua_script:{}", lua.display()))
        .arg("-r")
        .arg(&pcap)
        // Both passes: a request shows its replies in the second one only.
        .args(["-2", "-T", "pdml", "-J", wire.id()])
        .args(options)
        .output()
        .unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    // `tshark` goes on after one.
    let error = text.lines().find(|line| line.contains("Lua Error"));
    assert_eq!(error, None);
    read(wire, &text)
}

fn read(wire: Wire, text: &str) -> Vec<Shown> {
    let options = roxmltree::ParsingOptions { nodes_limit: u32::MAX, ..Default::default() };
    let document = roxmltree::Document::parse_with_options(text, options).unwrap();
    let records = document.descendants().filter(|node| node.has_tag_name("packet"));
    let prefix = format!("{}.", wire.id());
    let attribute =
        |node: roxmltree::Node<'_, '_>, name| node.attribute(name).unwrap_or_default().to_owned();
    let mut shown = Vec::new();
    for (record, node) in records.enumerate() {
        let own = |node: &roxmltree::Node<'_, '_>| {
            node.has_tag_name("proto") && node.attribute("name") == Some(wire.id())
        };
        for packet in node.children().filter(own) {
            let fields = packet.descendants().filter_map(|field| {
                let name = field.attribute("name")?.strip_prefix(&prefix)?.to_owned();
                Some((name, attribute(field, "show"), attribute(field, "value")))
            });
            let at = packet.attribute("pos").unwrap().parse().unwrap();
            shown.push(Shown { record, at, fields: fields.collect() });
        }
    }
    shown
}
