"""encode's calls: one function each, named as in the adapter protocol.

A function makes the SDK send and returns the SDK's result code; the bytes are left in the port.
"""

from dynamixel_sdk import BROADCAST_ID, GroupBulkRead, GroupBulkWrite, GroupSyncRead, GroupSyncWrite

from actucheck.adapter import Rejected, Skipped, unhex
from common import SDK

# The parameters that clearMultiTurn always sends.
CLEAR_PARAMS = "0144584c22"


def ping(port, dxl_id, call):
    if dxl_id == BROADCAST_ID:
        return SDK.broadcastPing(port)[1]
    return SDK.ping(port, dxl_id)[1]


def read(port, dxl_id, call):
    return SDK.readTx(port, dxl_id, call["address"], call["length"])


def write(port, dxl_id, call):
    data = unhex(call["data"])
    return SDK.writeTxOnly(port, dxl_id, call["address"], len(data), data)


def reg_write(port, dxl_id, call):
    data = unhex(call["data"])
    return SDK.regWriteTxOnly(port, dxl_id, call["address"], len(data), data)


def action(port, dxl_id, call):
    return SDK.action(port, dxl_id)


def factory_reset(port, dxl_id, call):
    if call.get("option") is None:
        raise Skipped("factoryReset always sends an option")
    return SDK.factoryReset(port, dxl_id, call["option"])[0]


def reboot(port, dxl_id, call):
    return SDK.reboot(port, dxl_id)[0]


def clear(port, dxl_id, call):
    if call["params"] != CLEAR_PARAMS:
        raise Skipped(f"clearMultiTurn, the only Clear, always sends {CLEAR_PARAMS}")
    return SDK.clearMultiTurn(port, dxl_id)[0]


def sync_read(port, dxl_id, call):
    return sync_read_group(port, dxl_id, call).txPacket()


def fast_sync_read(port, dxl_id, call):
    return sync_read_group(port, dxl_id, call).fastSyncReadTxPacket()


def sync_read_group(port, dxl_id, call):
    broadcast_only(dxl_id)
    group = GroupSyncRead(port, SDK, call["address"], call["length"])
    for device in call["ids"]:
        added(group.addParam(device), device)
    return group


def sync_write(port, dxl_id, call):
    broadcast_only(dxl_id)
    group = GroupSyncWrite(port, SDK, call["address"], call["length"])
    for device in call["devices"]:
        added(group.addParam(device["id"], unhex(device["data"])), device["id"])
    return group.txPacket()


def bulk_read(port, dxl_id, call):
    broadcast_only(dxl_id)
    group = GroupBulkRead(port, SDK)
    for device in call["devices"]:
        added(group.addParam(device["id"], device["address"], device["length"]), device["id"])
    return group.txPacket()


def bulk_write(port, dxl_id, call):
    broadcast_only(dxl_id)
    group = GroupBulkWrite(port, SDK)
    for device in call["devices"]:
        data = unhex(device["data"])
        added(group.addParam(device["id"], device["address"], len(data), data), device["id"])
    return group.txPacket()


def broadcast_only(dxl_id):
    if dxl_id != BROADCAST_ID:
        raise Skipped("the SDK's groups always send to the broadcast ID")


def added(accepted, device):
    if not accepted:
        raise Rejected("parameter", f"addParam refused device {device}")


CALLS = {
    call.__name__: call
    for call in (
        ping, read, write, reg_write, action, factory_reset, reboot, clear,
        sync_read, fast_sync_read, sync_write, bulk_read, bulk_write,
    )
}  # fmt: skip
