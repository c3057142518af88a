"""Conformance adapter for innfos.py: one JSON request a line in, one JSON reply a line out."""

import json
import sys

import innfos


def packet_object(kind, packet):
    address, command, data = packet
    return {"kind": kind, "address": address, "command": command, "data": data.hex()}


def crc(request):
    return {"crc": innfos.crc(bytes.fromhex(request["bytes"]))}


def encode(request):
    packet = request["packet"]
    data = bytes.fromhex(packet["data"])
    frame = innfos.encode(packet["kind"], packet["address"], packet["command"], data)
    return {"bytes": frame.hex()}


def decode(request):
    kind = request["kind"]
    packet = innfos.decode(kind, bytes.fromhex(request["bytes"]))
    return {"packet": packet_object(kind, packet)}


def stream(request):
    kind = request["kind"]
    packets = []
    for chunk in request["chunks"]:
        packets += innfos.decode_all(kind, bytes.fromhex(chunk))
    return {"packets": [packet_object(kind, packet) for packet in packets]}


OPS = {"crc": crc, "encode": encode, "decode": decode, "stream": stream}

HELLO = {
    "protocol": 1,
    "implementation": {"name": "innfos-python", "version": "1", "language": "Python"},
    "wires": ["innfos"],
    "ops": list(OPS),
}


def answer(request):
    op = request["op"]
    if op == "hello":
        return {"ok": HELLO}
    if op not in OPS or request.get("wire") != "innfos":
        return {"skip": {"reason": f"no {op} for {request.get('wire')}"}}
    try:
        return {"ok": OPS[op](request)}
    except innfos.Rejected as rejected:
        return {"err": {"class": rejected.fault, "detail": str(rejected)}}
    except Exception as error:  # what the implementation lets through is a finding
        return {"err": {"class": "internal", "detail": repr(error)}}


for line in sys.stdin:
    request = json.loads(line)
    if request["op"] == "bye":
        break
    print(json.dumps({"id": request["id"], **answer(request)}), flush=True)
