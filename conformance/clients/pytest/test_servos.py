"""A test of a program for servos, as its author would write it."""

from dynamixel_sdk import COMM_SUCCESS, PacketHandler, PortHandler, port_handler

# A busy machine may wake the bus late; in ms.
port_handler.LATENCY_TIMER = 500

TEMPERATURE_LIMIT = 31


def opened(path):
    port = PortHandler(path)
    assert port.openPort() and port.setBaudRate(2_000_000)
    return port


def test_a_limit_is_written(servos):
    port, packets = opened(servos), PacketHandler(2.0)
    assert packets.write1ByteTxRx(port, 2, TEMPERATURE_LIMIT, 70) == (COMM_SUCCESS, 0)
    for dxl_id, limit in ((1, 80), (2, 70)):
        assert packets.read1ByteTxRx(port, dxl_id, TEMPERATURE_LIMIT) == (limit, COMM_SUCCESS, 0)


def test_each_test_has_new_servos(servos):
    port, packets = opened(servos), PacketHandler(2.0)
    assert packets.read1ByteTxRx(port, 2, TEMPERATURE_LIMIT) == (80, COMM_SUCCESS, 0)
