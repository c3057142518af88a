"""The calls: one function each, named as in the adapter protocol. It returns what the library does.

The library takes data as numbers; these are made of the bytes, low byte first.
"""

from dxl2.v2 import BROADCAST_ID, BulkParams, SyncParams

from actucheck.adapter import Skipped, unhex

FACTORY_RESETS = {
    0xFF: "factory_reset",
    0x01: "factory_reset_except_id",
    0x02: "factory_reset_except_id_baudrate",
}
CLEARS = {"0144584c22": "clear_position", "024552434c": "clear_errors"}
BACKUPS = {"014354524c": "control_table_backup", "024354524c": "control_table_restore"}


def number(data):
    return int.from_bytes(data, "little")


def ping(bus, dxl_id, call):
    if dxl_id == BROADCAST_ID:
        return bus.broadcast_ping()
    return bus.ping(dxl_id)


def read(bus, dxl_id, call):
    return bus.read(dxl_id, call["address"], call["length"])


def write(bus, dxl_id, call):
    data = unhex(call["data"])
    return bus.write(dxl_id, call["address"], len(data), number(data))


def reg_write(bus, dxl_id, call):
    data = unhex(call["data"])
    return bus.reg_write(dxl_id, call["address"], len(data), number(data))


def action(bus, dxl_id, call):
    return bus.action(dxl_id)


def factory_reset(bus, dxl_id, call):
    return one_of(bus, FACTORY_RESETS, call.get("option"))(dxl_id)


def reboot(bus, dxl_id, call):
    return bus.reboot(dxl_id)


def clear(bus, dxl_id, call):
    return one_of(bus, CLEARS, call["params"])(dxl_id)


def control_table_backup(bus, dxl_id, call):
    return one_of(bus, BACKUPS, call["params"])(dxl_id)


def sync_read(bus, dxl_id, call):
    return bus.sync_read(sync_read_params(dxl_id, call))


def fast_sync_read(bus, dxl_id, call):
    return bus.fast_sync_read(sync_read_params(dxl_id, call))


def sync_read_params(dxl_id, call):
    broadcast_only(dxl_id)
    params = SyncParams(call["address"], call["length"])
    for device in call["ids"]:
        params.add_motor(device)
    return params


def sync_write(bus, dxl_id, call):
    broadcast_only(dxl_id)
    params = SyncParams(call["address"], call["length"])
    for device in call["devices"]:
        params.add_value(device["id"], number(unhex(device["data"])))
    return bus.sync_write(params)


def bulk_read(bus, dxl_id, call):
    broadcast_only(dxl_id)
    params = BulkParams()
    for device in call["devices"]:
        params.add_address(device["id"], device["address"], device["length"])
    return bus.bulk_read(params)


def bulk_write(bus, dxl_id, call):
    broadcast_only(dxl_id)
    params = BulkParams()
    for device in call["devices"]:
        data = unhex(device["data"])
        params.add_value(device["id"], device["address"], len(data), number(data))
    return bus.bulk_write(params)


def one_of(bus, methods, parameters):
    if parameters not in methods:
        raise Skipped("the library has no method with these parameters")
    return getattr(bus, methods[parameters])


def broadcast_only(dxl_id):
    if dxl_id != BROADCAST_ID:
        raise Skipped("the library sends it to the broadcast ID only")


CALLS = {
    call.__name__: call
    for call in (
        ping, read, write, reg_write, action, factory_reset, reboot, clear, control_table_backup,
        sync_read, fast_sync_read, sync_write, bulk_read, bulk_write,
    )
}  # fmt: skip
