"""The ops of a host: the SDK opens a port and makes calls, as its users do.

A call returns what the SDK's user gets: its values, its error byte, or its result code.
"""

import time

import serial
from dynamixel_sdk import (
    BROADCAST_ID,
    COMM_NOT_AVAILABLE,
    COMM_PORT_BUSY,
    COMM_RX_CORRUPT,
    COMM_RX_TIMEOUT,
    COMM_SUCCESS,
    COMM_TX_ERROR,
    COMM_TX_FAIL,
    GroupBulkRead,
    GroupBulkWrite,
    GroupSyncRead,
    GroupSyncWrite,
    PortHandler,
    port_handler,
)

from actucheck.adapter import Host, Rejected, Skipped, function_of, unhex
from calls import CLEAR_PARAMS
from common import SDK

# The SDK's result codes as classes of what went wrong in a call.
TROUBLE = {
    COMM_RX_CORRUPT: "corrupt",
    COMM_RX_TIMEOUT: "timeout",
    COMM_TX_ERROR: "refused",
    COMM_TX_FAIL: "port",
    COMM_NOT_AVAILABLE: "refused",
    COMM_PORT_BUSY: "internal",  # one call at a time
}

# The alert in the error byte that the SDK hands to its user.
ALERT = 0x80


def open_memory(memory, baud):
    return open_port("memory", baud, memory, memory)


def open_port(path, baud, pyserial=serial, clock=time):
    # From where the SDK has its port, and the time.
    port_handler.serial, port_handler.time = pyserial, clock
    port = PortHandler(path)
    try:
        opened = port.openPort() and port.setBaudRate(baud)
    except OSError as error:
        raise Rejected("port", str(error)) from None
    if not opened:
        raise Rejected("port", f"{path} at {baud} bit/s")
    return port


def make(port, call):
    return function_of(CALLS, call)(port, call)


def done(result):
    """The SDK's result code says whether a call went well."""
    if result != COMM_SUCCESS:
        detail = SDK.getTxRxResult(result) or f"unknown result {result}"
        raise Rejected(TROUBLE.get(result, "internal"), detail)


def told(call, result, error, **values):
    """What the user gets of one device: values, and the error byte beside them."""
    done(result)
    number = error & ~ALERT
    device = {"id": call["device"], "alert": bool(error & ALERT)}
    return [{**device, "error": number} if number else {**device, **values}]


def ping(port, call):
    if call["device"] == BROADCAST_ID:
        found, result = SDK.broadcastPing(port)
        done(result)
        return [
            {"id": i, "model_number": model_number, "firmware_version": version}
            for i, (model_number, version) in found.items()
        ]
    model_number, result, error = SDK.ping(port, call["device"])
    return told(call, result, error, model_number=model_number)


def read(port, call):
    data, result, error = SDK.readTxRx(port, call["device"], call["address"], call["length"])
    return told(call, result, error, data=bytes(data).hex())


def write(port, call):
    data = unhex(call["data"])
    result = SDK.writeTxRx(port, call["device"], call["address"], len(data), data)
    return told_if_answered(call, *result)


def reg_write(port, call):
    data = unhex(call["data"])
    result = SDK.regWriteTxRx(port, call["device"], call["address"], len(data), data)
    return told_if_answered(call, *result)


def told_if_answered(call, result, error):
    """The SDK waits for no answer of the broadcast ID."""
    devices = told(call, result, error)
    return [] if call["device"] == BROADCAST_ID else devices


def action(port, call):
    done(SDK.action(port, call["device"]))
    return []


def factory_reset(port, call):
    if call.get("option") is None:
        raise Skipped("factoryReset always sends an option")
    return told_if_answered(call, *SDK.factoryReset(port, call["device"], call["option"]))


def reboot(port, call):
    return told_if_answered(call, *SDK.reboot(port, call["device"]))


def clear(port, call):
    if call["params"] != CLEAR_PARAMS:
        raise Skipped(f"clearMultiTurn, the only Clear, always sends {CLEAR_PARAMS}")
    return told_if_answered(call, *SDK.clearMultiTurn(port, call["device"]))


def sync_read(port, call):
    return of_sync(port, call, GroupSyncRead.txRxPacket)


def fast_sync_read(port, call):
    return of_sync(port, call, GroupSyncRead.fastSyncRead)


def of_sync(port, call, method):
    address, length = call["address"], call["length"]
    group = GroupSyncRead(port, SDK, address, length)
    for device in call["ids"]:
        added(group.addParam(device), device)
    done(method(group))
    return [held(group, device, address, length) for device in call["ids"]]


def bulk_read(port, call):
    group = GroupBulkRead(port, SDK)
    for device in call["devices"]:
        added(group.addParam(device["id"], device["address"], device["length"]), device["id"])
    done(group.txRxPacket())
    devices = call["devices"]
    return [held(group, device["id"], device["address"], device["length"]) for device in devices]


def held(group, device, address, length):
    # Byte by byte, because getData reads the lengths 1, 2 and 4 only.
    data = bytes(group.getData(device, address + place, 1) for place in range(length))
    return {"id": device, "data": data.hex()}


def sync_write(port, call):
    group = GroupSyncWrite(port, SDK, call["address"], call["length"])
    for device in call["devices"]:
        added(group.addParam(device["id"], unhex(device["data"])), device["id"])
    done(group.txPacket())
    return []


def bulk_write(port, call):
    group = GroupBulkWrite(port, SDK)
    for device in call["devices"]:
        data = unhex(device["data"])
        added(group.addParam(device["id"], device["address"], len(data), data), device["id"])
    done(group.txPacket())
    return []


def added(accepted, device):
    if not accepted:
        raise Rejected("refused", f"addParam refused device {device}")


CALLS = {
    call.__name__: call
    for call in (
        ping, read, write, reg_write, action, factory_reset, reboot, clear,
        sync_read, fast_sync_read, sync_write, bulk_read, bulk_write,
    )
}  # fmt: skip

OPS = Host(open_port, PortHandler.closePort, make, open_memory).ops
