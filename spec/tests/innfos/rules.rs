//! Each rule finds a broken copy of the files.

use actucheck_spec::Spec;
use actucheck_spec::load::{Source, embedded};

/// The message after `from` is replaced by `to` in one of the files.
fn broken(file: &str, from: &str, to: &str) -> String {
    let path = format!("spec/{file}");
    let sources: Vec<_> = embedded()
        .into_iter()
        .map(|source| {
            if source.path != path {
                return source;
            }
            assert!(source.text.contains(from), "{file} has no {from}");
            Source::new(file, &source.text.replacen(from, to, 1))
        })
        .collect();
    let defects = Spec::read(&sources).err().unwrap_or_default();
    let lines: Vec<_> = defects.iter().map(ToString::to_string).collect();
    lines.join("\n")
}

#[test]
fn a_defect_of_the_protocol_is_found() {
    let cases = [
        ("code: 0x55", "code: 0x71", "code 113 already belongs to row"),
        ("name: Last shutdown state", "name: Mode", "name Mode (read) already belongs to row"),
        ("code: 2, name: Speed", "code: 1, name: Speed", "code 1 already belongs to"),
        ("mask: 0x0002", "mask: 0x0001", "mask 1 already belongs to"),
        ("mask: 0x0002", "mask: 0x0003", "Undervoltage: 0x0003 is no single bit"),
        ("name: DD-2305", "name: DD-3510", "name DD-3510 already belongs to"),
        ("source: [innfos §Appendix B]", "source: []", "no citation"),
        ("[innfos §A.1.1]", "[innfoss §A.1.1]", "unknown document `innfoss`"),
        ("innfos.profile.scale", "innfos.profil", "unknown erratum `innfos.profil`"),
        ("optional: [0x02, 0x44]", "optional: [0x03, 0x44]", "there is no command 0x03"),
        ("check: 0x4B37", "check: 0x374B", "yield 0x4B37"),
        (
            "reply: [4], format: iq24",
            "reply: [2], format: iq24",
            "Current (0x04): [2] bytes, but the format has [4]",
        ),
        (
            "request: 2, reply: [1], format: iq8",
            "request: 4, reply: [1], format: iq8",
            "4 bytes, but the format has [2]",
        ),
        (
            "request: 1, reply: [1], format: mode",
            "request: 1, reply: [2], format: mode",
            "answered with a flag",
        ),
        ("request: 0, reply: [2]", "request: 1, reply: [2]", "a read has no data"),
        ("format: scaled, factor: 75.225", "format: scaled", "has a `factor`"),
        ("factor: 75.225", "factor: 0", "a factor is larger than 0"),
        (
            "format: iq8, unit: Hz",
            "format: iq8, unit: Hz, full_scale: current",
            "only an IQ24 value is relative",
        ),
        ("format: iq8, sizes: [2]", "format: iq8, sizes: [4]", "needs 2 bytes"),
        ("fraction_bits: 24", "fraction_bits: 23", "24 for iq24"),
        ("current: 33,", "current: 0,", "QDD Pro-8108-50: 0 is no full scale"),
        ("output_speed: 30}", "output_speed: -30}", "-30 is no full scale"),
        ("tail: 0xED", "tial: 0xED", "unknown field `tial`"),
    ];
    for (from, to, message) in cases {
        let found = broken("wires/innfos.yaml", from, to);
        assert!(found.contains(message), "{from} -> {to}: {found}");
        assert!(found.starts_with("spec/wires/innfos.yaml:"), "{found}");
    }
}

#[test]
fn a_defect_of_a_vector_is_found() {
    let cases = [
        ("position", "06 3F 42 ED", "06 3F 43 ED", "fields yield"),
        (
            "position",
            "printed: EE 06 07 00 01 06 3F 42 ED",
            "printed: EE 06 07 00 01 06 ED",
            "differ from byte 6",
        ),
        ("position", "EE 06 07 00 01 01 ED", "EE 06 07 00 01 01 7E 80 ED", "differ from byte 6"),
        ("handshake", "    result: acceptable\n", "", "can only be `acceptable`"),
        ("handshake", "01 00 00 ED", "01 00 01 ED", "fields yield"),
        ("query", "kind: request", "kind: status", "unknown field `address`"),
        (
            "query",
            "{kind: request, address: 0, command: 0x02, data: \"\"}",
            "{kind: status, id: 0, error: 2, params: \"\"}",
            "no packets of this kind",
        ),
        ("receive", "    kind: request\n", "", "needs its `kind`"),
        ("power", "wire: innfos", "wire: infos", "unknown wire `infos`"),
        (
            "power",
            "requirement: innfos.crc.request",
            "requirement: innfos.crc",
            "unknown requirement",
        ),
    ];
    for (file, from, to, message) in cases {
        let found = broken(&format!("vectors/innfos/{file}.yaml"), from, to);
        assert!(found.contains(message), "{file}: {from} -> {to}: {found}");
    }
    let found = broken(
        "vectors/dynamixel2/receive.yaml",
        "    fault: crc\n",
        "    fault: crc\n    kind: request\n",
    );
    assert!(found.contains("`kind` is for the invalid frames"), "{found}");
}
