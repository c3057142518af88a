"""What adapter.py and calls.py share: the SDK, the ways a request can end, reading its fields."""

from dynamixel_sdk import (
    COMM_NOT_AVAILABLE,
    COMM_PORT_BUSY,
    COMM_RX_CORRUPT,
    COMM_RX_TIMEOUT,
    COMM_TX_ERROR,
    COMM_TX_FAIL,
    PacketHandler,
)

SDK = PacketHandler(2.0)

# The SDK's result codes as error classes. It has one code, RX_CORRUPT, for a wrong CRC, a packet cut
# short and bytes that are no packet at all; its callers cannot tell these apart, so neither do we.
ERROR_CLASSES = {
    COMM_RX_CORRUPT: "crc",
    COMM_RX_TIMEOUT: "truncated",  # not one byte received
    COMM_TX_ERROR: "oversize",
    COMM_TX_FAIL: "length",  # fewer or more bytes written than the length field says
    COMM_NOT_AVAILABLE: "parameter",  # read or ping above ID 253, a group without devices
    COMM_PORT_BUSY: "internal",  # each request has a port of its own: cannot be
}


class Rejected(Exception):
    """The SDK says no."""

    def __init__(self, error_class, detail):
        super().__init__(detail)
        self.error_class = error_class

    @classmethod
    def by(cls, result):
        detail = SDK.getTxRxResult(result) or f"unknown result {result}"
        return cls(ERROR_CLASSES.get(result, "internal"), detail)


class Skipped(Exception):
    """The SDK has nothing for this."""


class BadRequest(Exception):
    """The request breaks the adapter protocol."""


class Fields(dict):
    """A JSON object that takes a missing field for a bad request, not for an error in the SDK."""

    def __missing__(self, name):
        raise BadRequest(f"no field {name!r}")


def unhex(text):
    try:
        return bytes.fromhex(text)
    except (TypeError, ValueError) as error:
        raise BadRequest(f"{text!r} is not hex: {error}") from None
