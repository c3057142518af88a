"""An adapter that skips everything. Fill in the ops that your library offers."""

import json
import sys


class Rejected(Exception):
    """Raise it where the library rejects its input, with one of the error classes."""

    def __init__(self, fault, detail=""):
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
OPS = {}

HELLO = {
    "protocol": 1,
    "implementation": {"name": "my_library", "version": "0", "language": "Python"},
    "wires": ["dynamixel2"],
    "ops": list(OPS),
}


def answer(request):
    op = request["op"]
    if op == "hello":
        return {"ok": HELLO}
    if op not in OPS or request["wire"] not in HELLO["wires"]:
        return {"skip": {"reason": f"no {op}"}}
    try:
        return {"ok": OPS[op](request)}
    except Skipped as skipped:
        return {"skip": {"reason": str(skipped)}}
    except Rejected as rejected:
        return {"err": {"class": rejected.fault, "detail": str(rejected)}}
    except Exception as error:  # what the library lets through is a finding
        return {"err": {"class": "internal", "detail": repr(error)}}


for line in sys.stdin:
    request = json.loads(line)
    if request["op"] == "bye":
        break
    print(json.dumps({"id": request["id"], **answer(request)}), flush=True)
