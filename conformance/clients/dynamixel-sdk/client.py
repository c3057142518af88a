"""Moves virtual JA40s and an XM430 with ROBOTIS's own Python SDK, through its own PortHandler."""

import sys
import time

from dynamixel_sdk import (
    BROADCAST_ID,
    COMM_SUCCESS,
    DXL_HIBYTE,
    DXL_HIWORD,
    DXL_LOBYTE,
    DXL_LOWORD,
    GroupBulkRead,
    GroupSyncRead,
    GroupSyncWrite,
    PacketHandler,
    PortHandler,
)
from dynamixel_sdk import port_handler

# A busy machine may wake the bus late; in ms.
port_handler.LATENCY_TIMER = 500

# Registers of the JA40: document §2.2 and §2.3.
TORQUE_ENABLE = 512
HARDWARE_ERROR_STATUS = 518
PROFILE_TIME = 522
PROFILE_VELOCITY = 560
GOAL_POSITION = 564
PRESENT_POSITION = 580
TEMPERATURE_LIMIT = 31
MODEL_NUMBER = 0

ACCESS_ERROR = 7
DATA_LIMIT_ERROR = 6
INSTRUCTION_ERROR = 2


def four(value):
    low, high = DXL_LOWORD(value), DXL_HIWORD(value)
    return [DXL_LOBYTE(low), DXL_HIBYTE(low), DXL_LOBYTE(high), DXL_HIBYTE(high)]


def done(result):
    """What a call returned, if it went well: (values…, communication, error)."""
    *values, communication, error = result
    assert communication == COMM_SUCCESS, f"communication {communication}: {result}"
    assert error == 0, f"error {error}: {result}"
    return values[0] if values else None


def refused(result, expected):
    communication, error = result[-2:]
    assert communication == COMM_SUCCESS, result
    assert error == expected, f"error {error}, not {expected}"


def main():
    if len(sys.argv) < 2:
        return  # installed
    port = PortHandler(sys.argv[1])
    assert port.openPort() and port.setBaudRate(2_000_000)
    packets = PacketHandler(2.0)

    # Who is there.
    assert done(packets.ping(port, 1)) == 5210
    found, communication = packets.broadcastPing(port)
    assert communication == COMM_SUCCESS
    assert {dxl_id: model for dxl_id, (model, _) in found.items()} == {1: 5210, 2: 5210, 3: 1030}, found

    # One, two and four bytes.
    assert done(packets.read1ByteTxRx(port, 1, TEMPERATURE_LIMIT)) == 80
    assert done(packets.read2ByteTxRx(port, 1, PROFILE_TIME)) == 2000
    assert done(packets.read4ByteTxRx(port, 2, PRESENT_POSITION)) == 2000
    done(packets.write2ByteTxRx(port, 1, PROFILE_TIME, 0xFFFF))
    assert done(packets.read2ByteTxRx(port, 1, PROFILE_TIME)) == 0xFFFF
    refused(packets.write2ByteTxRx(port, 1, MODEL_NUMBER, 1), ACCESS_ERROR)

    # Torque on locks the EEPROM area; a goal is reached in the time that the profile takes.
    done(packets.write1ByteTxRx(port, 1, TORQUE_ENABLE, 1))
    refused(packets.write1ByteTxRx(port, 1, TEMPERATURE_LIMIT, 70), ACCESS_ERROR)
    refused(packets.write4ByteTxRx(port, 1, PROFILE_VELOCITY, 6001), DATA_LIMIT_ERROR)
    done(packets.write4ByteTxRx(port, 1, GOAL_POSITION, 1000))
    positions = []
    deadline = time.monotonic() + 5
    while not positions or positions[-1] != 1000:
        assert time.monotonic() < deadline, positions
        positions.append(done(packets.read4ByteTxRx(port, 1, PRESENT_POSITION)))
    assert positions == sorted(positions), positions
    assert len(set(positions)) > 2, "it jumped"

    # Several devices at once.
    done(packets.write1ByteTxRx(port, 2, TORQUE_ENABLE, 1))
    write = GroupSyncWrite(port, packets, GOAL_POSITION, 4)
    for dxl_id, goal in ((1, 3000), (2, 1500)):
        assert write.addParam(dxl_id, four(goal))
    assert write.txPacket() == COMM_SUCCESS
    for name in ("txRxPacket", "fastSyncRead"):
        read = GroupSyncRead(port, packets, GOAL_POSITION, 4)
        assert read.addParam(2) and read.addParam(1)
        communication = getattr(read, name)()
        assert communication == COMM_SUCCESS, f"{name}: {packets.getTxRxResult(communication)}"
        goals = [read.getData(dxl_id, GOAL_POSITION, 4) for dxl_id in (1, 2)]
        assert goals == [3000, 1500], f"{name}: {goals}"

    # Instructions that the XM430 has and the JA40 has not.
    position = 116
    done(packets.regWriteTxRx(port, 3, position, 4, four(2048)))
    assert done(packets.read4ByteTxRx(port, 3, position)) != 2048
    # To all devices, as the SDK does not read the answer to an Action: the next call takes it for its
    # own (protocol2_packet_handler.py, txRxPacket: "no need to wait"; port_handler.py, clearPort).
    assert packets.action(port, BROADCAST_ID) == COMM_SUCCESS
    assert done(packets.read4ByteTxRx(port, 3, position)) == 2048
    refused(packets.regWriteTxRx(port, 1, GOAL_POSITION, 4, four(0)), INSTRUCTION_ERROR)
    bulk = GroupBulkRead(port, packets)
    assert bulk.addParam(3, position, 4)
    assert bulk.txRxPacket() == COMM_SUCCESS
    assert bulk.getData(3, position, 4) == 2048

    # A restart: the RAM area is as at the beginning, the EEPROM area is kept.
    done(packets.write1ByteTxRx(port, 1, TORQUE_ENABLE, 0))
    done(packets.write1ByteTxRx(port, 1, TEMPERATURE_LIMIT, 70))
    done(packets.reboot(port, 1))
    assert done(packets.read2ByteTxRx(port, 1, PROFILE_TIME)) == 2000
    assert done(packets.read1ByteTxRx(port, 1, TEMPERATURE_LIMIT)) == 70
    # Option 0x02 keeps the ID and the baud rate.
    done(packets.factoryReset(port, 1, 0x02))
    assert done(packets.read1ByteTxRx(port, 1, TEMPERATURE_LIMIT)) == 80

    port.closePort()
    print("every call returned what the documents say")


main()
