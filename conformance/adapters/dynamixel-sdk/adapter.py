"""Conformance adapter for ROBOTIS's own Python SDK, `dynamixel-sdk`.

Reads one JSON request a line on standard input, answers with one JSON line on standard output.
The SDK is used as published, through its public classes, over a port in memory. Every byte sent and
every packet reported is the SDK's work, its mistakes included; what it cannot do is skipped.
"""

from importlib.metadata import version

from dynamixel_sdk import (
    BROADCAST_ID,
    COMM_RX_TIMEOUT,
    COMM_SUCCESS,
    DXL_HIBYTE,
    DXL_LOBYTE,
    DXL_MAKEWORD,
)

# By its module: the package exports these names for Protocol 1.0 as well.
from dynamixel_sdk.protocol2_packet_handler import (
    PKT_ERROR,
    PKT_ID,
    PKT_INSTRUCTION,
    PKT_LENGTH_H,
    PKT_LENGTH_L,
    PKT_PARAMETER0,
    RXPACKET_MAX_LEN,
    TXPACKET_MAX_LEN,
)

from actucheck.adapter import Skipped, serve, unhex
from calls import CALLS, sync_read_group
from common import SDK, rejected
from host import OPS as HOST
from memory_port import MemoryPort

# The list that the SDK's methods pass around: seven bytes of header with the length field, the body,
# two bytes for the CRC. txPacket fills in header and CRC.


def packet_list(dxl_id, body):
    packet = [0] * PKT_INSTRUCTION + list(body) + [0, 0]
    packet[PKT_ID] = dxl_id
    packet[PKT_LENGTH_L] = DXL_LOBYTE(len(body) + 2)
    packet[PKT_LENGTH_H] = DXL_HIBYTE(len(body) + 2)
    return packet


def body_end(packet):
    # The length field decides, not the list's length: removeStuffing does not shorten the list.
    return PKT_INSTRUCTION + DXL_MAKEWORD(packet[PKT_LENGTH_L], packet[PKT_LENGTH_H]) - 2


def body_of(packet):
    return bytes(packet[PKT_INSTRUCTION : body_end(packet)])


def crc(request):
    data = unhex(request["bytes"])
    return {"crc": SDK.updateCRC(0, data, len(data))}


def stuff(request):
    return {"bytes": body_of(SDK.addStuffing(packet_list(0, unhex(request["bytes"])))).hex()}


def unstuff(request):
    return {"bytes": body_of(SDK.removeStuffing(packet_list(0, unhex(request["bytes"])))).hex()}


def encode(request):
    packet = request["packet"]
    call = packet["call"]
    method = CALLS.get(call["name"])
    port = MemoryPort()
    if method:
        result = method(port, packet["id"], call)
    else:
        # A general call, or one that the SDK has no method for (Control Table Backup, Fast Sync
        # Write): txPacket is public and frames any instruction.
        body = bytes([packet["instruction"]]) + unhex(packet["params"])
        result = SDK.txPacket(port, packet_list(packet["id"], body))
    # Some methods also wait for the answer, which never comes.
    if result not in (COMM_SUCCESS, COMM_RX_TIMEOUT):
        raise rejected(result)
    return {"bytes": port.written.hex()}


def decode(request):
    port = MemoryPort([unhex(request["bytes"])])
    if "fast" in request:
        return {"packet": fast_status(port, request["fast"])}
    # rxPacket takes one packet and leaves what follows to the next call: it never sees trailing bytes.
    received, result = SDK.rxPacket(port, False)
    if result != COMM_SUCCESS:
        raise rejected(result)
    return {"packet": status(received)}


def status(received):
    return {
        "kind": "status",
        "id": received[PKT_ID],
        "error": received[PKT_ERROR],
        "params": bytes(received[PKT_PARAMETER0 + 1 : body_end(received)]).hex(),
    }


def fast_status(port, fast):
    ids, length = fast["ids"], fast["length"]
    if length == 0:
        raise Skipped("the SDK has no Fast Sync Write")
    group = sync_read_group(port, BROADCAST_ID, {"address": 0, "length": length, "ids": ids})
    result = group.fastSyncReadRxPacket()
    if result != COMM_SUCCESS:
        raise rejected(result)
    # Byte by byte, because getData reads the lengths 1, 2 and 4 only. The group drops the devices'
    # error bytes and reports success: to its caller that is "no error".
    return {
        "kind": "fast_status",
        "blocks": [
            {"error": 0, "id": i, "data": bytes(group.getData(i, k, 1) for k in range(length)).hex()}
            for i in ids
        ],
    }


def stream(request):
    port = MemoryPort([unhex(chunk) for chunk in request["chunks"]])
    packets = []
    # The loop ends: each rxPacket reads some bytes, or reports that none are left.
    while not port.isPacketTimeout():
        received, result = SDK.rxPacket(port, False)
        if result == COMM_SUCCESS:
            packets.append(status(received))
    return {"packets": packets}


if __name__ == "__main__":
    serve(
        {
            "name": "dynamixel-sdk",
            "version": version("dynamixel-sdk"),
            "url": "https://github.com/ROBOTIS-GIT/DynamixelSDK",
        },
        ["host"],
        "dynamixel2",
        {op.__name__: op for op in (crc, stuff, unstuff, encode, decode, stream)} | HOST,
        # It compares a received packet's length field, which counts from the instruction on.
        {"max_send": TXPACKET_MAX_LEN, "max_receive": RXPACKET_MAX_LEN + PKT_INSTRUCTION},
    )
