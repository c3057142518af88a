"""Conformance adapter for `dynamixel-python`, whose module is `dxl2`.

The library is used as published, through its public classes, over a port in memory. Every byte sent
and every packet reported is the library's work, its mistakes included; what it cannot do is skipped.
"""

from importlib.metadata import version

from dxl2.v2 import (
    BROADCAST_ID,
    InstructionPacket,
    HardwareError,
    Params,
    StatusPacket,
    add_stuffing,
    calc_crc_16,
)

from actucheck.adapter import Rejected, Skipped, serve, unhex
from actucheck.memory import Memory
from calls import CALLS, sync_read_params
from host import OPS as HOST, bus_over

# What stands before and after the parameters of a status packet.
BEFORE_PARAMS, CRC = [0] * 9, [0] * 2


def crc(request):
    return {"crc": calc_crc_16(list(unhex(request["bytes"])))}


def stuff(request):
    return {"bytes": add_stuffing(Params(list(unhex(request["bytes"])))).raw.hex()}


def unstuff(request):
    packet = StatusPacket([*BEFORE_PARAMS, *unhex(request["bytes"]), *CRC])
    packet.remove_stuffing()
    return {"bytes": packet.params.raw.hex()}


def encode(request):
    packet = request["packet"]
    call = packet["call"]
    memory = Memory()
    bus = bus_over(memory)
    if call["name"] in CALLS:
        CALLS[call["name"]](bus, packet["id"], call)
    else:
        # A general call, or Fast Sync Write, which has no method: the packet's class is public.
        params = Params(list(unhex(packet["params"])))
        bus.conn.write_packet(InstructionPacket(packet["id"], packet["instruction"], params))
    return {"bytes": memory.sent.hex()}


def decode(request):
    bus = bus_over(Memory(unhex(request["bytes"])))
    if "fast" in request:
        return {"packet": fast_status(bus, request["fast"])}
    return {"packet": status(bus.conn.read_packet())}


def status(packet):
    """What the methods of MotorBus do with each packet that has been read."""
    if packet is None:
        raise Rejected("truncated", "no packet")
    if not packet.valid:
        raise Rejected("unspecified", "not valid")
    packet.remove_stuffing()
    return {
        "kind": "status",
        "id": packet.packet_id,
        "error": packet.error,
        "params": packet.params.raw.hex(),
    }


def fast_status(bus, fast):
    ids, length = fast["ids"], fast["length"]
    if length == 0:
        raise Skipped("the library has no Fast Sync Write")
    call = {"address": 0, "length": length, "ids": ids}
    response = bus.fast_sync_read(sync_read_params(BROADCAST_ID, call))
    if response.timeout:
        raise Rejected("truncated", "no packet")
    if not response.valid:
        raise Rejected("unspecified", "not valid")
    if response.error:
        raise Skipped("an error number comes alone, without ID and data")
    # The library drops the devices' error numbers and IDs. Its caller has to assume that there was
    # no error, and that the devices answered in the order of the request.
    return {
        "kind": "fast_status",
        "blocks": [
            {"error": 0, "id": i, "data": value.to_bytes(length, "little").hex()}
            for i, value in zip(ids, response.data)
        ],
    }


def stream(request):
    memory = Memory(b"".join(unhex(chunk) for chunk in request["chunks"]))
    conn = bus_over(memory).conn
    packets = []
    while not memory.is_silent:
        try:
            packets.append(status(conn.read_packet()))
        except (Rejected, HardwareError):
            pass  # its caller reads on
    return {"packets": packets}


if __name__ == "__main__":
    serve(
        {
            "name": "dynamixel-python",
            "version": version("dynamixel-python"),
            "url": "https://github.com/seagullcjung/dynamixel-python",
        },
        ["host"],
        "dynamixel2",
        {op.__name__: op for op in (crc, stuff, unstuff, encode, decode, stream)} | HOST,
        calls=CALLS,
    )
