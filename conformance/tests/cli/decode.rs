//! A packet is explained, or what is wrong with it.

use assert_cmd::Command;

use super::{WRITE, actucheck};

#[test]
fn a_write_is_explained_field_by_field() {
    insta::assert_snapshot!(actucheck(&["decode", "--device", "ja40", WRITE]).1, @r"
    instruction packet: Write to device 1
        0  ff ff fd 00  header
        4  01           ID           1
        5  09 00        length       9 bytes follow
        7  03           instruction  Write
        8  34 02        address      564 (Goal Position, JA40)
       10  d0 07 00 00  data         Goal Position = 2000 (2000 count)
       14  1e c9        CRC          0xC91E, right
    ");
}

#[test]
fn stuffing_bytes_are_marked() {
    let frame = "ffff fd00 01 0a00 03 3402 fffffdfdff 2351";
    insta::assert_snapshot!(actucheck(&["decode", "--device", "ja40", frame]).1, @r"
    instruction packet: Write to device 1
        0  ff ff fd 00       header
        4  01                ID           1
        5  0a 00             length       10 bytes follow
        7  03                instruction  Write
        8  34 02             address      564 (Goal Position, JA40)
       10  ff ff fd (fd) ff  data         Goal Position = -131073 (-131073 count)
       15  23 51             CRC          0x5123, right
    ");
}

#[test]
fn bits_and_names_are_explained_where_the_address_is_known() {
    // Drive Mode and Operating Mode, read in one go; the CRC by long division.
    let frame = "ff ff fd 00 01 06 00 55 00 05 11 A0 C5";
    let (status, stdout, stderr) =
        actucheck(&["decode", "--device", "ja40", "--address", "10", frame]);
    assert_eq!(status, 0, "{stderr}");
    insta::assert_snapshot!(stdout, @r"
    status packet of device 1: no error
        0  ff ff fd 00  header
        4  01           ID           1
        5  06 00        length       6 bytes follow
        7  55           instruction  Status
        8  00           error        no error
        9  05           data         Drive Mode = 5 (Reverse Mode: Reverse (positive is clockwise), Disable Profile: Profile enabled, Profile Configuration: Time-based profile)
       10  11           data         Operating Mode = 17 (Calibration Mode)
       11  a0 c5        CRC          0xC5A0, right
    ");
}

#[test]
fn an_innfos_frame_is_explained_if_it_is_told_which_way_it_goes() {
    let frame = "EE 06 0A 00 04 01 00 00 00 01 D8 ED";
    let (status, stdout, stderr) =
        actucheck(&["decode", "--wire", "innfos", "--direction", "request", frame]);
    assert_eq!(status, 0, "{stderr}");
    insta::assert_snapshot!(stdout, @r"
    request to 6: Write Position
        0  ee           header
        1  06           address  6
        2  0a           command  0x0A (Write Position)
        3  00 04        length   4 bytes of data
        5  01 00 00 00  data     1 R
        9  01 d8        CRC      of the data, right
       11  ed           end
    ");
    let alarms = "EE 06 FF 00 02 00 05 E1 83 ED";
    let (status, stdout, _) =
        actucheck(&["decode", "--wire", "innfos", "--direction", "reply", alarms]);
    assert_eq!(status, 1, "the CRC is wrong");
    insta::assert_snapshot!(stdout, @r"
    no valid packet, from byte 7 on: crc: bytes 7 and 8 are E1 83, C1 B3 is expected
        0  ee     header
        1  06     address  6
        2  ff     command  0xFF (Read Alarms)
        3  00 02  length   2 bytes of data
        5  00 05  data     Overvoltage, Locked rotor
        7  e1 83  CRC      C1 B3 is expected
        9  ed     end
           fits if byte 5 is 7F (1729 were tried, so 1 in 37 wrong packets fits by chance)
    ");
    let others = "EE 01 FF 00 02 08 00 06 70 ED";
    let (_, stdout, _) = actucheck(&["decode", "--wire", "innfos", "--kind", "reply", others]);
    assert!(stdout.contains("Equipment error"), "{stdout}");
    // Only a request to write a position has a position; a command without a name may go both ways.
    assert_eq!(
        actucheck(&["decode", frame]).1.lines().next(),
        Some("request to 6: Write Position")
    );
    let unknown = "EE 06 99 00 00 ED";
    let (status, _, stderr) = actucheck(&["decode", unknown]);
    assert_eq!(status, 2);
    assert!(stderr.contains("--direction request"), "{stderr}");
}

#[test]
fn a_packet_is_printed_as_the_adapter_protocol_has_it() {
    let (status, stdout, _) = actucheck(&["decode", "--json", WRITE]);
    assert_eq!(status, 0);
    assert_eq!(
        stdout,
        "{\"kind\":\"instruction\",\"id\":1,\"instruction\":3,\"params\":\"3402d0070000\"}\n"
    );
}

#[test]
fn bytes_come_from_standard_input_too() {
    let mut command = Command::cargo_bin("actucheck").unwrap();
    let output = command.args(["decode", "--json", "-"]).write_stdin(WRITE).output().unwrap();
    assert!(output.status.success());
}

#[test]
fn what_is_no_packet_is_told_with_reason_offset_and_expectation() {
    let damaged = WRITE.replace("1E C9", "1E C8");
    let (status, stdout, stderr) = actucheck(&["decode", &damaged]);
    assert_eq!((status, stderr.as_str()), (1, ""));
    insta::assert_snapshot!(stdout, @r"
    no valid packet, from byte 14 on: crc: bytes 14 and 15 are 1E C8, 1E C9 is expected
        0  ff ff fd 00  header
        4  01           ID           1
        5  09 00        length       9 bytes follow
        7  03           instruction  Write
        8  34 02        address      564 (if ja40 or ja-variant: Goal Position)
       10  d0 07 00 00  data         2000
       14  1e c8        CRC          1E C9 is expected
           fits if byte 15 is C9
    ");
    let (status, stdout, _) = actucheck(&["decode", "--json", &damaged]);
    let fits = r#""fits":[{"mistake":"one bit changed","conditions":["byte 15 is C9"]"#;
    assert!(status == 1 && stdout.contains(fits), "{stdout}");
    let (status, stdout, _) = actucheck(&["decode", "ff ff fd 00 01"]);
    assert_eq!(status, 1);
    insta::assert_snapshot!(stdout, @r"
    no valid packet, from byte 5 on: truncated: 5 bytes are there, 7 are needed
           fits if the rest of the packet follows
    ");
}

#[test]
fn a_packet_that_goes_the_other_way_is_refused() {
    assert_eq!(actucheck(&["decode", "--direction", "request", WRITE]).0, 0);
    // The option's old name.
    let (status, _, stderr) = actucheck(&["decode", "--kind", "reply", WRITE]);
    assert_eq!(status, 1);
    insta::assert_snapshot!(stderr, @"actucheck: no valid reply: the packet is a request");
}
