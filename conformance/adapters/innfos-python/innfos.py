"""The INNFOS Ethernet protocol as its document describes it, and nothing but that.

Written for this suite from the document alone, so that the suite has an implementation beside its
own codec to judge. The CRC is the document's: its function returns the byte that is sent first as
the high one.
"""

HEADER, TAIL = 0xEE, 0xED
PREFIX = 5  # header, address, command, two bytes of length
# The document and the devices differ on whether the replies to these commands have a CRC.
OPEN_COMMANDS = (0x02, 0x44)


class Rejected(Exception):
    """Bytes that are no frame, with the error class of the adapter protocol."""

    def __init__(self, fault, detail):
        super().__init__(detail)
        self.fault = fault


def _table_entry(index):
    for _ in range(8):
        index = (index >> 1) ^ 0xA001 if index & 1 else index >> 1
    return index


_TABLE = [_table_entry(index) for index in range(256)]


def crc(data):
    """The two CRC bytes as one number; the first byte is the high one."""
    first, second = 0xFF, 0xFF
    for byte in data:
        entry = _TABLE[first ^ byte]
        first, second = second ^ (entry & 0xFF), entry >> 8
    return first << 8 | second


def _has_crc(kind, data):
    return len(data) > (0 if kind == "request" else 1)


def encode(kind, address, command, data):
    """The bytes of a frame."""
    frame = bytes([HEADER, address, command]) + len(data).to_bytes(2, "big") + data
    if _has_crc(kind, data):
        frame += crc(data).to_bytes(2, "big")
    return frame + bytes([TAIL])


def decode_first(kind, datagram):
    """The frame that a datagram begins with, as (address, command, data), and its size."""
    if datagram and datagram[0] != HEADER:
        raise Rejected("header", f"begins with {datagram[0]:02x}")
    if len(datagram) < PREFIX:
        raise Rejected("truncated", f"{len(datagram)} bytes")
    address, command = datagram[1], datagram[2]
    end = PREFIX + int.from_bytes(datagram[3:5], "big")
    data = datagram[PREFIX:end]
    if len(datagram) <= end:
        raise Rejected("truncated", f"{len(datagram)} bytes, more than {end} needed")

    may_lack_crc = kind == "reply" and len(data) == 1 and command in OPEN_COMMANDS
    if may_lack_crc and datagram[end:] == bytes([TAIL]):
        return (address, command, data), end + 1
    if may_lack_crc or _has_crc(kind, data):
        found = datagram[end : end + 2]
        end += 2
        if len(datagram) <= end:
            raise Rejected("truncated", f"{len(datagram)} bytes, more than {end} needed")
        if datagram[end] != TAIL:
            raise Rejected("tail", f"{datagram[end]:02x} at byte {end}")
        zeros = may_lack_crc and found == b"\0\0"
        if found != crc(data).to_bytes(2, "big") and not zeros:
            raise Rejected("crc", f"{found.hex()} for {data.hex()}")
    elif datagram[end] != TAIL:
        raise Rejected("tail", f"{datagram[end]:02x} at byte {end}")
    return (address, command, data), end + 1


def decode(kind, frame):
    """The frame, if the bytes are exactly one."""
    packet, size = decode_first(kind, frame)
    if size < len(frame):
        raise Rejected("trailing", f"{len(frame) - size} bytes follow the frame")
    return packet


def decode_all(kind, datagram):
    """The frames of a datagram, up to the first bytes that are none."""
    packets = []
    while datagram:
        try:
            packet, size = decode_first(kind, datagram)
        except Rejected:
            break
        packets.append(packet)
        datagram = datagram[size:]
    return packets
