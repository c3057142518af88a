"""Conformance adapter for `dynamixel-api`, which reads and writes registers by their names.

The library is used as published, on a port that it opens by itself, of the system or in memory. What it
puts on the line and what it returns is its work, its mistakes included; it has no other calls than Read and
Write.
"""

import termios
import time
from importlib.metadata import version

import serial
from dynamixel_api import (
    DynamixelCommunicationError,
    DynamixelConnectionError,
    DynamixelConnector,
    DynamixelError,
    DynamixelPacketError,
    Field,
    dynamixel_connector,
)
from dynamixel_sdk import (
    COMM_NOT_AVAILABLE,
    COMM_RX_CORRUPT,
    COMM_RX_TIMEOUT,
    COMM_TX_ERROR,
    COMM_TX_FAIL,
    port_handler,
)
from serial import SerialException

from actucheck.adapter import Host, Rejected, Skipped, serve, unhex

CALLS = ("read", "write")

# The library's data types, by the number of bytes.
TYPES = {1: "B", 2: "H", 4: "I", 8: "Q"}


def register(address, length):
    return f"{length} bytes at {address}"


# A control table as its users write one for a motor of their own: here all registers that there may be
# in 1024 bytes. To disconnect, the library needs `torque_enable`.
FIELDS = [
    Field(address, data_type, register(address, length), "", True, None)
    for address in range(1024)
    for length, data_type in TYPES.items()
] + [Field(64, "B", "torque_enable", "", True, 0)]
NAMES = {field.name for field in FIELDS}

# The result codes as classes of what went wrong in a call.
TROUBLE = {
    COMM_RX_CORRUPT: "corrupt",
    COMM_RX_TIMEOUT: "timeout",
    COMM_TX_ERROR: "refused",
    COMM_TX_FAIL: "port",
    COMM_NOT_AVAILABLE: "refused",
}


class Port:
    """The library has a connector for each device, which opens the port."""

    def __init__(self, path, baud):
        self.path, self.baud, self.connectors = path, baud, {}
        self.connector(1)

    def connector(self, device):
        if device not in self.connectors:
            new = DynamixelConnector(
                FIELDS, dynamixel_id=device, device=self.path, baud_rate=self.baud
            )
            try:
                new.connect()
            except (DynamixelConnectionError, SerialException) as error:
                raise Rejected("port", str(error)) from None
            self.connectors[device] = new
        return self.connectors[device]

    def close(self):
        for connector in self.connectors.values():
            try:
                connector.disconnect()
            except (DynamixelError, termios.error, OSError):
                pass  # it writes `torque_enable` first, which nothing answers, or to a line that is gone


def use(pyserial, clock):
    """From where the SDK has its port, and both packages the time."""
    port_handler.serial = pyserial
    port_handler.time = dynamixel_connector.time = clock


def open_port(path, baud):
    use(serial, time)
    return Port(path, baud)


def open_memory(memory, baud):
    use(memory, memory)
    return Port("memory", baud)


def make(port, call):
    if call["name"] not in CALLS:
        raise Skipped("the library reads and writes registers, and nothing else")
    data = unhex(call["data"]) if call["name"] == "write" else None
    length = call["length"] if data is None else len(data)
    name, device = register(call["address"], length), call["device"]
    if name not in NAMES:
        raise Skipped("a register has 1, 2, 4 or 8 bytes, and this one's control table 1024")
    try:
        if data is None:
            number = port.connector(device).read_field(name)
            return [{"id": device, "data": number.to_bytes(length, "little").hex()}]
        port.connector(device).write_field(name, int.from_bytes(data, "little"))
        return [{"id": device}]
    except DynamixelCommunicationError as error:
        raise Rejected(TROUBLE.get(error.communication_result, "internal"), str(error)) from None
    except DynamixelPacketError as error:
        raise Rejected("status", str(error)) from None
    except SerialException as error:
        raise Rejected("port", str(error)) from None


if __name__ == "__main__":
    serve(
        {
            "name": "dynamixel-api",
            "version": version("dynamixel-api"),
            "url": "https://github.com/TimSchneider42/dynamixel-api",
        },
        ["host"],
        "dynamixel2",
        Host(open_port, Port.close, make, open_memory).ops,
        calls=CALLS,
    )
