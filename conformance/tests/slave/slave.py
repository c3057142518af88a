"""An adapter of a small library with a class of a device, which is right or wrong in one way:

    PYTHONPATH=adapters/kit/python python3 slave.py right
"""

import sys

from actucheck.adapter import device, serve

HEADER = b"\xff\xff\xfd\x00"
MODEL, FIRMWARE = 0x7777, 3
LONGEST = 100
#: How long it waits for the rest of a packet, in milliseconds.
PATIENCE = 50


def crc(data):
    value = 0
    for byte in data:
        value ^= byte << 8
        for _ in range(8):
            value = (value << 1) ^ (0x18005 if value & 0x8000 else 0)
    return value.to_bytes(2, "little")


class Servo:
    """Answers Ping, and refuses every other instruction."""

    def __init__(self, fault, number=1):
        self.fault, self.number, self.waiting = fault, number, b""

    def feed(self, after_ms, data):
        if after_ms >= (1 if self.fault == "impatient" else PATIENCE):
            self.waiting = b""
        self.waiting += data
        answers = b""
        while packet := self.next():
            answers += self.answer(*packet)
        return answers

    def next(self):
        """The next whole packet that came; None if there is none yet."""
        while True:
            start = self.waiting.find(HEADER)
            self.waiting = self.waiting[start:] if start >= 0 else self.waiting[-3:]
            if start < 0 or len(self.waiting) < 7:
                return None
            length = int.from_bytes(self.waiting[5:7], "little")
            frame = self.waiting[: 7 + length]
            if 3 <= length <= LONGEST and len(frame) < 7 + length:
                return None
            is_right = length >= 3 and len(frame) == 7 + length and crc(frame[:-2]) == frame[-2:]
            if self.fault == "takes-damaged" and len(frame) == 7 + length >= 10:
                is_right = True
            if is_right:
                self.waiting = self.waiting[7 + length :]
                return frame[4], frame[7], frame[8:-2]
            self.waiting = self.waiting[4:]

    def answer(self, number, instruction, params):
        is_asked = number == self.number or self.fault == "hears-all"
        if not is_asked and (number != 0xFE or instruction != 1):
            return b""
        if instruction == 0x55:
            return b""
        if instruction == 1 and not params:
            return self.status(0, MODEL.to_bytes(2, "little") + bytes([FIRMWARE]))
        if self.fault == "raises":
            raise KeyError(instruction)
        if self.fault == "ends":
            sys.exit("out of order")
        if instruction == 1:
            return self.status(5)
        return self.status(5 if instruction == 2 else 2)

    def status(self, error, params=b""):
        body = bytes([0x55, error]) + params
        frame = HEADER + bytes([self.number]) + (len(body) + 2).to_bytes(2, "little") + body
        if self.fault == "big-endian-crc":
            return frame + crc(frame)[::-1]
        return frame + crc(frame)


if __name__ == "__main__":
    servo = Servo(sys.argv[1])
    ops = device(servo.feed)
    if sys.argv[1] == "none":
        ops = {"crc": lambda request: {"crc": 0}}
    serve({"name": "servo", "version": "1"}, ["device"], "dynamixel2", ops)
