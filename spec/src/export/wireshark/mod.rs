//! Exports a dissector for Wireshark: one Lua script for all wires. The code is written by hand, in
//! `common.lua` and in `wireshark.lua` of each wire's folder; the tables before it come from the spec.

mod table;

use crate::Spec;
use crate::wire::Wire;

pub use table::Script;
pub(crate) use table::{Lua, crc, fields, list, text};

const HEAD: &str = "\
-- A dissector for Wireshark and tshark, written by `actucheck spec export wireshark` of version
-- {version}, so do not edit it. Licensed under MIT or Apache-2.0, at your choice.
--
-- Wires: {wires}.
--
-- To install it, put this file into the folder that Wireshark shows at Help, About Wireshark,
-- Folders, Personal Lua Plugins, then press Ctrl+Shift+L. To try it:
--   tshark -X lua_script:actucheck.lua -r capture.pcapng -V
";

/// The whole script.
#[must_use]
pub fn export(spec: &Spec) -> String {
    let wires = Wire::ALL.map(|wire| format!("{}, filter `{}`", wire.title(), wire.id()));
    let head = HEAD
        .replace("{version}", env!("CARGO_PKG_VERSION"))
        .replace("{wires}", &wires.join(";\n--   "));
    let mut script = Script::new(&head);
    script.code(include_str!("common.lua"));
    for wire in Wire::ALL {
        script.begin(wire.title());
        wire.exports().wireshark(spec, &mut script);
        script.end();
    }
    script.finish()
}
