"""An adapter that skips everything. Fill in the ops that your library offers."""

import json
import sys


class Rejected(Exception):
    """Raise it where the library rejects its input, with one of the error classes."""

    def __init__(self, detail="", fault="unspecified"):
        super().__init__(detail)
        self.fault = fault


class Skipped(Exception):
    """Raise it where the library has nothing for the request, with the reason."""


# An op takes the request and returns the object that `ok` holds, for example:
#
#     def crc(request):
#         return {"crc": my_library.crc(bytes.fromhex(request["bytes"]))}
#
#     OPS = {"crc": crc}

# A library that opens a port and talks with devices has the ops `open`, `call` and `close`, and is
# checked by `actucheck host`, for example:
#
#     port = None
#
#     def close(request):
#         global port
#         if port is not None:
#             port.close()
#         port = None
#         return {}
#
#     def open_port(request):
#         global port
#         close(request)
#         port = my_library.open(request["port"], request["baud"])
#         return {}
#
#     def call(request):
#         call = request["call"]
#         if call["name"] != "read":
#             raise Skipped(f"no {call['name']}")
#         if port is None:
#             raise Rejected("no port is open", "port")
#         try:
#             data = port.read(call["device"], call["address"], call["length"])
#         except my_library.Timeout as error:
#             raise Rejected(str(error), "timeout")
#         return {"devices": [{"id": call["device"], "data": data.hex()}]}
#
#     OPS = {"open": open_port, "call": call, "close": close}

# A library with a class of a device, which takes bytes and answers them, has the op `device` and the role
# `device`, and is checked by `actucheck device --adapter`, for example:
#
#     servo = my_library.Servo(1)
#
#     def device(request):
#         answer = servo.hear(bytes.fromhex(request["bytes"]), request["after_ms"])
#         return {"bytes": answer.hex()}
#
#     OPS = {"device": device}
OPS = {}

HELLO = {
    "protocol": 4,
    "implementation": {"name": "my_library", "version": "0", "language": "Python"},
    # A host builds requests and reads replies, a device the reverse; name both if it does both.
    "roles": ["host"],
    "wires": ["dynamixel2"],
    "ops": list(OPS),
    # The longest packets that it builds and reads, in bytes: {"max_send": …, "max_receive": …}.
    "limits": {},
}


def role(request):
    """The role that does this; None if both do."""
    if request["op"] in ("open", "call", "close"):
        return "host"
    if request["op"] == "device":
        return "device"
    direction = request.get("message", request).get("direction")
    if request["op"] == "encode":
        is_request = request["packet"]["kind"] in ("instruction", "request")
        direction = "request" if is_request else "reply"
    if direction is None:
        return None
    builds = request["op"] == "encode" or "value" in request or "message" in request
    return "host" if builds == (direction == "request") else "device"


def answer(request):
    op = request["op"]
    if op == "hello":
        return {"ok": HELLO}
    if op not in OPS or request["wire"] not in HELLO["wires"]:
        return {"skip": {"reason": f"no {op}"}}
    try:
        if role(request) not in (None, *HELLO["roles"]):
            return {"skip": {"reason": "the other role does this"}}
        return {"ok": OPS[op](request)}
    except Skipped as skipped:
        return {"skip": {"reason": str(skipped)}}
    except Rejected as rejected:
        return {"err": {"class": rejected.fault, "detail": str(rejected)}}
    except Exception as error:  # any other error of the library is a finding
        return {"err": {"class": "internal", "detail": repr(error)}}


for line in sys.stdin:
    request = json.loads(line)
    if request["op"] == "bye":
        break
    print(json.dumps({"id": request["id"], **answer(request)}), flush=True)
