"""A host for tests: it reads and writes one device. Its first argument is what it does wrong, or `right`."""

import json
import os
import select
import socket
import sys
import time
import tty

WRONG = sys.argv[1]
LIMIT = 0.1
HEADER = b"\xff\xff\xfd\x00"


class Failed(Exception):
    def __init__(self, error_class):
        super().__init__(error_class)
        self.error_class = error_class


def crc(data):
    value = 0
    for byte in data:
        value ^= byte << 8
        for _ in range(8):
            value = (value << 1) ^ (0x8005 if value & 0x8000 else 0)
            value &= 0xFFFF
    return value.to_bytes(2, "little")


def packet(device, instruction, params):
    body = bytes([instruction]) + params
    if WRONG != "no-stuffing":
        body = body.replace(b"\xff\xff\xfd", b"\xff\xff\xfd\xfd")
    if len(body) + 2 > 0xFFFF:
        raise Failed("refused")
    packet = HEADER + bytes([device]) + (len(body) + 2).to_bytes(2, "little") + body
    return packet + crc(packet)


def answer(port, device):
    """The error byte and the parameters of the device's status packet."""
    received, end = b"", time.monotonic() + LIMIT
    corrupt = False
    while True:
        at = received.find(HEADER)
        packet = received[at:] if at >= 0 else b""
        whole = 7 + int.from_bytes(packet[5:7], "little") if len(packet) >= 7 else None
        if whole and whole > 1024:
            received = received[at + 1 :]
            continue
        if whole and len(packet) >= whole:
            packet = packet[:whole]
            right = packet[-2:] == crc(packet[:-2]) or WRONG == "no-crc"
            ours = packet[4] == device or WRONG == "any-device"
            if whole >= 11 and right and ours and packet[7] == 0x55:
                params = packet[9:-2].replace(b"\xff\xff\xfd\xfd", b"\xff\xff\xfd")
                return packet[8], params
            corrupt = True
            received = received[at + (whole if right and whole >= 11 else 1) :]
            continue
        left = end - time.monotonic()
        if left <= 0 and WRONG != "no-limit":
            raise Failed("corrupt" if corrupt or received else "timeout")
        if select.select([port], [], [], max(left, 0.01))[0]:
            received += os.read(port, 1024)


def drain(port):
    while select.select([port], [], [], 0)[0]:
        os.read(port, 1024)


def ask(port, device, instruction, params):
    if WRONG != "no-drain":
        drain(port)
    os.write(port, packet(device, instruction, params) * (6 if WRONG == "floods" else 1))
    if device == 254 and WRONG != "waits-for-all":
        return None
    error, data = answer(port, device)
    return {"id": device, "alert": bool(error & 128), "error": error & 127}, data


def call(port, call):
    device, name = call["device"], call["name"]
    if name == "read" and device != 254:
        params = b"".join(call[field].to_bytes(2, "little") for field in ("address", "length"))
        told, data = ask(port, device, 0x02, params)
        if not told["error"] and len(data) != call["length"]:
            raise Failed("corrupt")
        return [{**told, "data": data.hex()} if not told["error"] else told]
    if name == "write":
        params = call["address"].to_bytes(2, "little") + bytes.fromhex(call["data"])
        answered = ask(port, device, 0x03, params)
        return [answered[0]] if answered else []
    if name == "reboot":
        answered = ask(port, device, 0x08, b"")
        return [answered[0]] if answered else []
    return None


def open_port(name):
    if name.startswith("tcp://"):
        host, number = name.removeprefix("tcp://").split(":")
        return socket.create_connection((host, int(number))).detach()
    port = os.open(name, os.O_RDWR | os.O_NOCTTY)
    tty.setraw(port)
    return port


def main():
    port = None
    for line in sys.stdin:
        request = json.loads(line)
        op = request["op"]
        if op == "bye":
            return
        reply = {"skip": {"reason": f"no {op}"}}
        if op == "hello":
            implementation = {"name": WRONG, "version": "1", "language": "Python"}
            hello = {"protocol": 3, "implementation": implementation, "roles": ["host"]}
            ops = ["call"] if WRONG == "no-port" else ["open", "call", "close"]
            calls = {"calls": ["read", "write"]} if WRONG == "no-reboot" else {}
            reply = {"ok": {**hello, "wires": ["dynamixel2"], "ops": ops, **calls}}
        elif op in ("open", "close"):
            if port is not None:
                os.close(port)
            port = open_port(request["port"]) if op == "open" else None
            reply = {"ok": {}}
            if op == "open" and WRONG == "opens-nothing":
                reply = {"err": {"class": "port", "detail": "no such port"}}
        elif op == "call":
            try:
                devices = call(port, request["call"])
                reply = {"ok": {"devices": devices}} if devices is not None else reply
            except Failed as failed:
                reply = {"err": {"class": failed.error_class, "detail": ""}}
        print(json.dumps({"id": request["id"], **reply}), flush=True)


if __name__ == "__main__":
    main()
