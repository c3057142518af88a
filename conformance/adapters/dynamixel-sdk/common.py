"""What adapter.py and calls.py share: the SDK and its result codes."""

from dynamixel_sdk import (
    COMM_NOT_AVAILABLE,
    COMM_PORT_BUSY,
    COMM_RX_CORRUPT,
    COMM_RX_TIMEOUT,
    COMM_TX_ERROR,
    COMM_TX_FAIL,
    PacketHandler,
)

from actucheck.adapter import Rejected

SDK = PacketHandler(2.0)

# The SDK's result codes as error classes. It has one code, RX_CORRUPT, for a wrong CRC, a packet cut
# short and bytes that are no packet at all. Its callers can't tell them apart, nor can this adapter.
ERROR_CLASSES = {
    COMM_RX_CORRUPT: "unspecified",
    COMM_RX_TIMEOUT: "truncated",  # not one byte received
    COMM_TX_ERROR: "oversize",
    COMM_TX_FAIL: "length",  # fewer or more bytes written than the length field says
    COMM_NOT_AVAILABLE: "parameter",  # read or ping above ID 253, a group without devices
    COMM_PORT_BUSY: "internal",  # cannot occur: each request has its own port
}


def rejected(result):
    """The SDK says no with a result code."""
    detail = SDK.getTxRxResult(result) or f"unknown result {result}"
    return Rejected(ERROR_CLASSES.get(result, "internal"), detail)
