"""The ops of a host: the library opens a port and makes calls, as its users do."""

import time

from dxl2 import v2
from dxl2.v2 import BROADCAST_ID, HardwareError, MotorBus
from serial import SerialException

from actucheck.adapter import Host, Rejected, function_of
from calls import CALLS


def bus_over(memory, baud=1_000_000):
    """A bus over a port in memory. The library goes by the clock of that port."""
    bus = MotorBus("memory", baud)  # opens nothing before connect(), which is never called
    memory.timeout = bus.conn.serial.timeout
    bus.conn.serial = v2.time = memory
    return bus


def open_port(path, baud):
    v2.time = time
    bus = MotorBus(path, baud)
    try:
        bus.connect()
    except SerialException as error:
        raise Rejected("port", str(error)) from None
    return bus


def make(bus, call):
    try:
        response = function_of(CALLS, call)(bus, call["device"], call)
    except HardwareError as error:  # the alert
        raise Rejected("status", str(error)) from None
    except AssertionError as error:  # how the library refuses a call
        raise Rejected("refused", str(error)) from None
    except SerialException as error:
        raise Rejected("port", str(error)) from None
    return told(call, response)


def told(call, response):
    """What the user gets. Of several devices it is a list of numbers, in the order of the request."""
    if response is None:  # sync_write and bulk_write say nothing
        return []
    if response.timeout:
        raise Rejected("timeout", "timeout")
    if not response.valid:
        raise Rejected("corrupt", "not valid")
    device = call["device"]
    if response.error:
        if device == BROADCAST_ID:
            raise Rejected("status", f"error {response.error} of a device that is not named")
        return [{"id": device, "error": response.error}]
    name, data = call["name"], response.data
    if name == "ping":
        found = data if device == BROADCAST_ID else {device: data}
        return [{"id": dxl_id, **facts} for dxl_id, facts in found.items()]
    if name == "read":
        return [with_data(device, data, call["length"])]
    if name in ("sync_read", "fast_sync_read"):
        return [with_data(i, number, call["length"]) for i, number in zip(call["ids"], data)]
    if name == "bulk_read":
        asked = call["devices"]
        return [with_data(i["id"], number, i["length"]) for i, number in zip(asked, data)]
    return [{"id": device}]


def with_data(device, number, length):
    # More bytes than were asked for make a greater number.
    length = max(length, (number.bit_length() + 7) // 8)
    return {"id": device, "data": number.to_bytes(length, "little").hex()}


OPS = Host(open_port, MotorBus.disconnect, make, bus_over).ops
