"""What the data of a frame means, by the tables of the INNFOS document (A.1, A.2, B, C and D).

A value is what the adapter protocol has for it: a number in the document's unit, a name, or flags.
Rows that the document gives no unit are taken for plain IQ24 numbers, and speeds for fractions of
the model's full scale.
"""

from __future__ import annotations

from dataclasses import dataclass


class NoMeaning(Exception):
    """A command, a size or a value that is in no table."""


FLAGS = ["no", "yes"]

MODES = [
    "Current",
    "Speed",
    "Position",
    "Teaching",
    "Playback",
    "Trapezoidal position",
    "Trapezoidal speed",
    "Homing",
]

ALARMS = [
    "Overvoltage",
    "Undervoltage",
    "Locked rotor",
    "Overheating",
    "Reading parameters",
    "Counting turns",
    "Inverter temperature sensor",
    "CAN communication",
    "Motor temperature sensor",
    "Step of more than 1 in position mode",
    "Driver protection",
]
OTHER_ALARM = "Equipment error"

# A model's full scales: current in A, motor speed in RPM.
MODELS = {
    "QDD Pro-8108-50": (33, 1500),
    "QDD-8108-6": (33, 1500),
    "DD-8108": (33, 1500),
    "QDD Pro-6010-50": (33, 4200),
    "QDD-6010-36": (33, 4200),
    "DD-6010": (33, 4200),
    "QDD Pro-3510-50": (16.5, 6000),
    "QDD-3510-6": (16.5, 6000),
    "QDD-3510-36": (16.5, 6000),
    "DD-3510": (16.5, 6000),
    "QDD-2305-6": (16.5, 6000),
    "QDD-2305-36": (16.5, 6000),
    "DD-2305": (16.5, 6000),
}


class Flag:
    """One byte with one of some names, the first of which has the number `start`."""

    size = 1

    def __init__(self, names, start):
        self.names, self.start = names, start

    def read(self, data, model):
        index = data[0] - self.start
        if not 0 <= index < len(self.names):
            raise NoMeaning(f"{data[0]:#04x} has no name")
        return {"name": self.names[index]}

    def build(self, value, model):
        if value.get("name") not in self.names:
            raise NoMeaning(f"{value} is no name of this command")
        return bytes([self.start + self.names.index(value["name"])])


class Alarms:
    """Two bytes in which each bit is an alarm."""

    size = 2

    def read(self, data, model):
        bits = int.from_bytes(data, "big")
        names = {name for bit, name in enumerate(ALARMS) if bits >> bit & 1}
        return {"flags": sorted(names | ({OTHER_ALARM} if bits >> len(ALARMS) else set()))}

    def build(self, value, model):
        if not set(value["flags"]) <= set(ALARMS):
            raise NoMeaning(f"{value} is not one combination of bits")
        bits = sum(1 << ALARMS.index(name) for name in value["flags"])
        return bits.to_bytes(self.size, "big")


@dataclass
class Scaled:
    """A signed number; the raw value `factor` means 1, or the full scale that this column of MODELS has."""

    size: int
    factor: float
    full_scale: int | None = None

    def _unit(self, model):
        if self.full_scale is None:
            return 1
        if model not in MODELS:
            raise NoMeaning(f"the full scale of {model} is not known")
        return MODELS[model][self.full_scale]

    def read(self, data, model):
        raw = int.from_bytes(data, "big", signed=True)
        return {"number": raw * self._unit(model) / self.factor}

    def build(self, value, model):
        raw = round(value["number"] / self._unit(model) * self.factor)
        try:
            return raw.to_bytes(self.size, "big", signed=True)
        except OverflowError:
            raise NoMeaning(f"{value} is out of range") from None


# The question for the actuators, and the sizes of their answers.
QUERY, MAC_SIZES = 0x02, (4, 6)

FLAG, MODE, ALARM_BITS = Flag(FLAGS, 0), Flag(MODES, 1), Alarms()
IQ8, IQ24 = Scaled(2, 2**8), Scaled(4, 2**24)
CURRENT, SPEED = Scaled(4, 2**24, 0), Scaled(4, 2**24, 1)
STALL_ENERGY = Scaled(4, 75.225)


def _table(*rows):
    return {command: kind for kind, commands in rows for command in commands}


# A.1: the value is in the reply.
READS = _table(
    (FLAG, [0x44, 0x00, 0xB0, 0x71, 0x75, 0x79, 0x2B]),
    (MODE, [0x55]),
    (IQ8, [0x73, 0x77, 0x7B, 0x5F, 0x60, 0x62, 0x64]),
    (ALARM_BITS, [0xFF]),
    (IQ24, [0x06, 0x15, 0x16, 0x17, 0x18, 0x19, 0x1A, 0x1C, 0x1D, 0x1E, 0x22, 0x23, 0x24]),
    (IQ24, [0x34, 0x35, 0x36, 0x37, 0x7D, 0x85, 0x86, 0x8A, 0x92, 0x93]),
    (CURRENT, [0x04]),
    (SPEED, [0x05, 0x38, 0x39]),
    (STALL_ENERGY, [0x7F]),
    # Its reply tells actuators apart and has no meaning beyond that.
    (None, [QUERY]),
)

# A.2: the value is in the request, and the reply is a flag.
WRITES = _table(
    (MODE, [0x07]),
    (FLAG, [0x70, 0x74, 0x78, 0x2A]),
    (IQ8, [0x72, 0x76, 0x7A, 0x61, 0x63]),
    (IQ24, [0x0A, 0x0E, 0x0F, 0x10, 0x11, 0x12, 0x13, 0x1F, 0x20, 0x21, 0x25, 0x26, 0x27]),
    (IQ24, [0x2E, 0x2F, 0x30, 0x31, 0x83, 0x84, 0x87, 0x89, 0x90, 0x91]),
    (CURRENT, [0x08]),
    (SPEED, [0x09, 0x32, 0x33]),
    (STALL_ENERGY, [0x7E]),
    (None, [0xFE, 0x88, 0x0D]),
)
UNANSWERED = (0x08, 0x09, 0x0A)


def reply_sizes(command):
    """How many bytes of data the answer to a command may have; none if it is not answered."""
    if command == QUERY:
        return MAC_SIZES
    if command in UNANSWERED:
        return ()
    return (READS.get(command, FLAG).size,)


def _format(kind, command):
    """The format of the data; None if there is none."""
    if command not in READS and command not in WRITES:
        raise NoMeaning(f"{command:#04x} is in no table")
    if kind == "request":
        return WRITES.get(command)
    if command in UNANSWERED or command == QUERY:
        raise NoMeaning(f"a reply to {command:#04x} has no value")
    return READS.get(command, FLAG)


def read(kind, command, data, model=None):
    """The value of a frame's data; None if it has none."""
    form = _format(kind, command)
    if len(data) != (form.size if form else 0):
        raise NoMeaning(f"{len(data)} bytes of data")
    return form.read(data, model) if form else None


def build(kind, command, value, model=None):
    """The data of a value."""
    form = _format(kind, command)
    if (form is None) != (value is None):
        raise NoMeaning(f"{command:#04x} with {value}")
    return form.build(value, model) if form else b""
