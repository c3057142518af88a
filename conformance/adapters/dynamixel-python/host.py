"""The ops of a host: the library opens a port and makes calls, as its users do."""

from dxl2.v2 import BROADCAST_ID, HardwareError, MotorBus
from serial import SerialException

from adapter_kit import Rejected, Skipped
from calls import CALLS

_bus = None


def open_port(request):
    global _bus
    close_port(request)
    bus = MotorBus(request["port"], request["baud"])
    try:
        bus.connect()
    except SerialException as error:
        raise Rejected("port", str(error)) from None
    _bus = bus
    return {}


def close_port(request):
    global _bus
    bus, _bus = _bus, None
    if bus:
        bus.disconnect()
    return {}


def call(request):
    if _bus is None:
        raise Rejected("port", "no port is open")
    call = request["call"]
    method = CALLS.get(call["name"])
    if not method:
        raise Skipped(f"the library has no {call['name']}")
    try:
        response = method(_bus, call["device"], call)
    except HardwareError as error:  # the alert
        raise Rejected("status", str(error)) from None
    except AssertionError as error:  # how the library refuses a call
        raise Rejected("refused", str(error)) from None
    except SerialException as error:
        raise Rejected("port", str(error)) from None
    return {"devices": told(call, response)}


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


OPS = {"open": open_port, "call": call, "close": close_port}
