//! Captures as `tshark` reads them: a header of 24 bytes, then records.

/// A link type that has no protocol of its own.
pub(crate) const USER0: u32 = 147;
/// Ethernet.
pub(crate) const ETHERNET: u32 = 1;

/// Milliseconds from one record to the next.
pub(crate) const STEP: u32 = 10;

/// A capture with these records, [`STEP`] apart.
pub(crate) fn capture(link_type: u32, records: &[Vec<u8>]) -> Vec<u8> {
    let mut file = Vec::new();
    for word in [0xA1B2_C3D4, 0x0004_0002, 0, 0, 0x0004_0000, link_type] {
        file.extend(u32::to_le_bytes(word));
    }
    for (number, record) in (0..).zip(records) {
        let size = u32::try_from(record.len()).unwrap();
        let milliseconds = number * STEP;
        for word in [milliseconds / 1000, milliseconds % 1000 * 1000, size, size] {
            file.extend(u32::to_le_bytes(word));
        }
        file.extend(record);
    }
    file
}

/// An end of a conversation: the last byte of its address, and its port.
#[derive(Clone, Copy)]
pub(crate) struct End(pub(crate) u8, pub(crate) u16);

/// A datagram in IPv4 and Ethernet.
pub(crate) fn udp(from: End, to: End, payload: &[u8]) -> Vec<u8> {
    let mut datagram = Vec::new();
    for word in [from.1, to.1, size(payload, 8), 0] {
        datagram.extend(word.to_be_bytes());
    }
    datagram.extend(payload);
    ethernet(17, from, to, &datagram)
}

/// A segment of TCP whose first byte is byte `at` of the stream.
pub(crate) fn tcp(from: End, to: End, at: u32, payload: &[u8]) -> Vec<u8> {
    let mut segment = Vec::new();
    segment.extend([from.1.to_be_bytes(), to.1.to_be_bytes()].concat());
    segment.extend([at.to_be_bytes(), 0_u32.to_be_bytes()].concat());
    // Five words of header, ACK, a window; no checksum, no urgent data.
    segment.extend([0x50, 0x10, 0xFF, 0xFF, 0, 0, 0, 0]);
    segment.extend(payload);
    ethernet(6, from, to, &segment)
}

fn ethernet(protocol: u8, from: End, to: End, content: &[u8]) -> Vec<u8> {
    let mut frame = vec![0x02; 12];
    frame.extend([0x08, 0x00, 0x45, 0x00]);
    frame.extend(size(content, 20).to_be_bytes());
    frame.extend([0, 0, 0, 0, 64, protocol, 0, 0]);
    frame.extend([192, 168, 1, from.0, 192, 168, 1, to.0]);
    frame.extend(content);
    frame
}

fn size(content: &[u8], header: usize) -> u16 {
    u16::try_from(content.len() + header).unwrap()
}
