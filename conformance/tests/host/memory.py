"""An adapter with a port in memory that makes up what came of a Read. Its argument is what is wrong with it."""

import json
import sys

WRONG = sys.argv[1]


def exchanged(frame):
    sent, ms = [{"at_ms": 0, "bytes": frame}], 1
    devices = {"devices": [{"id": 1, "data": "a6010283"}]}
    err = {"err": {"class": "timeout", "detail": ""}}
    return {
        "negative-ms": {"sent": sent, "ms": -1, **devices},
        "negative-at": {"sent": [{"at_ms": -1, "bytes": frame}], "ms": ms, **devices},
        "sent-after-the-end": {"sent": [{"at_ms": 2, "bytes": frame}], "ms": ms, **devices},
        "sent-backwards": {"sent": [{"at_ms": 1, "bytes": frame}, *sent], "ms": ms, **devices},
        "both": {"sent": sent, "ms": ms, **devices, **err},
        "neither": {"sent": sent, "ms": ms},
        "no-time": {"sent": sent, **devices},
        "no-list": {"sent": frame, "ms": ms, **devices},
        "capitals": {"sent": [{"at_ms": 0, "bytes": "FFFF"}], "ms": ms, **devices},
        "long-line": {"sent": [{"at_ms": 0, "bytes": frame * 2_000_000}], "ms": ms, **devices},
        "long-ok": {"sent": [{"at_ms": 0, "bytes": frame * 50_000}], "ms": ms, **devices},
        "floods": {"sent": [{"at_ms": 0, "bytes": frame}] * 10_000, "ms": ms, **devices},
        "an-hour": {"sent": sent, "ms": 3_600_000, **devices},
        "ages": {"sent": sent, "ms": 2**64 - 1, **devices},
        "exception": {"sent": sent, "ms": ms, "err": {"class": "internal", "detail": "IndexError"}},
    }.get(WRONG, {"sent": sent, "ms": ms, **devices})


is_open = False
for line in sys.stdin:
    request = json.loads(line)
    op, reply = request["op"], {"ok": {}}
    if op == "bye":
        break
    if op == "hello":
        implementation = {"name": WRONG, "version": "1", "language": "Python"}
        hello = {"protocol": 3, "implementation": implementation, "roles": ["host"]}
        ops = ["open", "exchange", "close"]
        reply = {"ok": {**hello, "wires": ["dynamixel2"], "ops": ops}}
    elif op == "exchange" and WRONG == "err-alone":
        reply = {"err": {"class": "timeout", "detail": ""}}
    elif op == "exchange" and request["call"]["name"] not in ("read", "ping") and WRONG != "takes-any-call":
        reply = {"skip": {"reason": "no such call"}}
    elif op == "exchange" and not is_open and WRONG != "always-open":
        reply = {"err": {"class": "port", "detail": "no port is open"}}
    elif op == "exchange":
        reply = {"ok": exchanged(request["frame"])}
    elif op == "close" and not is_open and WRONG == "closes-once":
        reply = {"err": {"class": "port", "detail": "no port is open"}}
    elif op in ("open", "close"):
        is_open = op == "open"
    else:
        reply = {"skip": {"reason": f"no {op}"}}
    print(json.dumps({"id": request["id"], **reply}), flush=True)
