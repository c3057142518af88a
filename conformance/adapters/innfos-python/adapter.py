"""Conformance adapter for innfos.py, commands.py and board.py."""

import commands
import innfos
from actucheck.adapter import Rejected, serve, unhex
from host import OPS as HOST


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
    kind = request["direction"]
    try:
        packet = innfos.decode(kind, unhex(request["bytes"]))
    except innfos.Rejected as rejected:
        raise Rejected(rejected.fault, str(rejected)) from None
    return {"packet": packet_object(kind, packet)}


def stream(request):
    kind = request["direction"]
    packets = []
    for chunk in request["chunks"]:
        packets += innfos.decode_all(kind, unhex(chunk))
    return {"packets": [packet_object(kind, packet) for packet in packets]}


def message(request):
    try:
        return _frame_of(request) if "message" in request else _message_of(request)
    except innfos.Rejected as rejected:
        raise Rejected(rejected.fault, str(rejected)) from None
    except commands.NoMeaning as reason:
        raise Rejected("parameter", str(reason)) from None


def _message_of(request):
    direction = request["direction"]
    address, command, data = innfos.decode(direction, unhex(request["bytes"]))
    value = commands.read(direction, command, data, request.get("actuator"))
    told = {"direction": direction, "address": address, "command": command}
    return {"message": told if value is None else {**told, "value": value}}


def _frame_of(request):
    told = request["message"]
    direction, command = told["direction"], told["command"]
    data = commands.build(direction, command, told.get("value"), request.get("actuator"))
    return {"bytes": innfos.encode(direction, told["address"], command, data).hex()}


if __name__ == "__main__":
    serve(
        {"name": "innfos-python", "version": "1"},
        ["host", "device"],
        "innfos",
        {op.__name__: op for op in (crc, encode, decode, stream, message)} | HOST,
    )
