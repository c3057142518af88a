"""Conformance adapter for innfos.py."""

import innfos
from adapter_kit import Rejected, serve, unhex


def packet_object(kind, packet):
    address, command, data = packet
    return {"kind": kind, "address": address, "command": command, "data": data.hex()}


def crc(request):
    return {"crc": innfos.crc(unhex(request["bytes"]))}


def encode(request):
    packet = request["packet"]
    data = unhex(packet["data"])
    frame = innfos.encode(packet["kind"], packet["address"], packet["command"], data)
    return {"bytes": frame.hex()}


def decode(request):
    kind = request["kind"]
    try:
        packet = innfos.decode(kind, unhex(request["bytes"]))
    except innfos.Rejected as rejected:
        raise Rejected(rejected.fault, str(rejected)) from None
    return {"packet": packet_object(kind, packet)}


def stream(request):
    kind = request["kind"]
    packets = []
    for chunk in request["chunks"]:
        packets += innfos.decode_all(kind, unhex(chunk))
    return {"packets": [packet_object(kind, packet) for packet in packets]}


if __name__ == "__main__":
    serve(
        {"name": "innfos-python", "version": "1"},
        "innfos",
        {op.__name__: op for op in (crc, encode, decode, stream)},
    )
