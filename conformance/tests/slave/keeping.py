"""An adapter of a servo with a control table, which is right or wrong in one way. What it holds at its end is in a file:

    PYTHONPATH=adapters/kit/python python3 keeping.py right table.json
"""

import json
import sys

from actucheck.adapter import device, serve
from slave import FIRMWARE, MODEL, Servo

#: Address: size, value, and the largest that may be written, or None. LED and gains are not as in the factory.
REGISTERS = {
    0: (2, MODEL, None),
    6: (1, FIRMWARE, None),
    7: (1, 1, 252),
    64: (1, 0, 1),
    65: (1, 1, 1),
    76: (2, 1234, 16383),
    78: (2, 4321, 16383),
}
ACCESS, LENGTH, RANGE = 7, 5, 4


class Keeping(Servo):
    """Answers Ping, Read and Write."""

    def __init__(self, fault):
        super().__init__(fault)
        self.held = {address: value for address, (_, value, _) in REGISTERS.items()}

    def answer(self, number, instruction, params):
        start = int.from_bytes(params[:2], "little")
        if (number, instruction) == (0xFE, 3):
            self.write(start, params[2:])
            return b""
        if number != self.number or instruction not in (2, 3) or len(params) < 2:
            return super().answer(number, instruction, params)
        if instruction == 2:
            size = int.from_bytes(params[2:], "little")
            return self.status(*self.read(start, size))
        return self.status(self.write(start, params[2:]))

    def read(self, start, size):
        table = {}
        for address, (length, _, _) in REGISTERS.items():
            data = self.held[address].to_bytes(length, "little")
            table.update(zip(range(address, address + length), data))
        places = range(start, start + size)
        if not places or any(place not in table for place in places):
            return (ACCESS,)
        return 0, bytes(table[place] for place in places)

    def write(self, start, data):
        places = range(start, start + len(data))
        covered = []
        for address, (length, _, largest) in REGISTERS.items():
            inside = [place for place in range(address, address + length) if place in places]
            if inside and largest is None:
                return ACCESS
            if inside and len(inside) < length:
                return LENGTH
            if inside:
                value = int.from_bytes(data[address - start : address - start + length], "little")
                covered.append((address, length, value, largest))
        if not covered or sum(length for _, length, _, _ in covered) != len(data):
            return LENGTH if not data else ACCESS
        if any(value > largest for _, _, value, largest in covered):
            return RANGE
        for address, length, value, _ in covered:
            if self.fault == "clamps":
                value = min(value, 16000)
            self.held[address] = value
            if self.fault == "raises-at-0" and value == 0:
                raise KeyError(address)
        return 0


if __name__ == "__main__":
    servo = Keeping(sys.argv[1])
    serve({"name": "servo", "version": "1"}, ["device"], "dynamixel2", device(servo.feed))
    with open(sys.argv[2], "w", encoding="utf-8") as file:
        json.dump(servo.held, file)
