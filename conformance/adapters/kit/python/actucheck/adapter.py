"""What the adapters in Python share: the loop over requests and the ways in which one can end.

An adapter hands `serve` what it says of its library and a function for each op, which takes the
request and returns the object that `ok` holds.
"""

import json
import sys

from actucheck.memory import Memory


class Rejected(Exception):
    """The library says no: one of the adapter protocol's error classes, and its own words.

    `unspecified` is the class where the library does not say why.
    """

    def __init__(self, error_class, detail=""):
        super().__init__(detail)
        self.error_class = error_class

    def told(self):
        return {"class": self.error_class, "detail": str(self)}


class Skipped(Exception):
    """The library has nothing for this."""


class BadRequest(Exception):
    """The request breaks the adapter protocol."""


class Fields(dict):
    """A JSON object that takes a missing field for a bad request, not for an error in the library."""

    def __missing__(self, name):
        raise BadRequest(f"no field {name!r}")


class Host:
    """The ops of a host with one port at a time.

    `open_port(path, baud)` returns a port, `close_port(port)` closes it, and `call(port, call)` makes a
    call through it and returns an object for each device. `open_memory(memory, baud)` returns a port that is
    a `Memory`, if the library can have one: then nothing is waited for.
    """

    def __init__(self, open_port, close_port, call, open_memory=None):
        self._open, self._close, self._call = open_port, close_port, call
        self._open_memory = open_memory
        self._port = self._memory = None
        self.ops = {"open": self.open, "call": self.call, "close": self.close}
        if open_memory:
            self.ops["exchange"] = self.exchange

    def open(self, request):
        self.close(request)
        path, baud = request["port"], request["baud"]
        if self._open_memory and path == "memory":
            memory = Memory()
            self._port, self._memory = self._open_memory(memory, baud), memory
        else:
            self._port = self._open(path, baud)
        return {}

    def close(self, request):
        port, self._port, self._memory = self._port, None, None
        if port is not None:
            self._close(port)
        return {}

    def call(self, request):
        if self._port is None:
            raise Rejected("port", "no port is open")
        return {"devices": self._call(self._port, request["call"])}

    def exchange(self, request):
        memory = self._memory
        if memory is None:
            raise Rejected("port", "no port in memory is open")
        frame, late = unhex(request["frame"]), unhex(request["late"])
        answers = [[(burst["after_ms"], unhex(burst["bytes"])) for burst in answer] for answer in request["answers"]]
        memory.begin(frame, answers, late, request["hurries"])
        try:
            result = {"devices": self._call(self._port, request["call"])}
        except Rejected as rejected:
            result = {"err": rejected.told()}
        finally:
            told = memory.end()
        return {**told, **result}


def device(hear):
    """The op of a device: `hear(after_ms, data)` takes bytes, so many milliseconds after the last ones,
    and returns the bytes that the device sends."""

    def answer(request):
        return {"bytes": hear(request["after_ms"], unhex(request["bytes"])).hex()}

    return {"device": answer}


def function_of(calls, call):
    """The function that makes a call, in a dict of them by name."""
    if call["name"] not in calls:
        raise Skipped(f"the library has no {call['name']}")
    return calls[call["name"]]


def unhex(text):
    try:
        return bytes.fromhex(text)
    except (TypeError, ValueError) as error:
        raise BadRequest(f"{text!r} is not hex: {error}") from None


# Who has these ops.
_ROLES = {**dict.fromkeys(("open", "call", "exchange", "close"), "host"), "device": "device"}


def _role(request):
    """The role that does this; None if both do."""
    direction = request.get("message", request).get("direction")
    if request["op"] == "encode":
        is_request = request["packet"]["kind"] in ("instruction", "request")
        direction = "request" if is_request else "reply"
    if direction is None:
        return None
    builds = request["op"] == "encode" or "value" in request or "message" in request
    return "host" if builds == (direction == "request") else "device"


def serve(implementation, roles, wire, ops, limits=None, calls=None):
    """Answers requests until `bye` or the end of standard input. `calls` are those of the op `call`."""
    hello = {
        "protocol": 4,
        "implementation": {"language": "Python", **implementation},
        "roles": roles,
        "wires": [wire],
        "ops": list(ops),
        "limits": limits or {},
    }
    if calls:
        hello["calls"] = list(calls)
    try:
        _loop(hello, wire, ops)
    except (BrokenPipeError, KeyboardInterrupt):
        sys.exit(1)


def _loop(hello, wire, ops):
    replies = sys.stdout
    sys.stdout = sys.stderr  # should the library print, it must not print into the protocol
    for line in sys.stdin.buffer:
        try:
            request = json.loads(line, object_hook=Fields)
        except (ValueError, RecursionError) as error:
            sys.exit(f"adapter: not a line of JSON: {error}")
        if not isinstance(request, dict) or type(request.get("id")) is not int:
            sys.exit("adapter: a request is an object with an integer id")
        if request.get("op") == "bye":
            break
        reply = {"id": request["id"], **_answer(request, hello, wire, ops)}
        print(json.dumps(reply), file=replies, flush=True)


def _answer(request, hello, wire, ops):
    try:
        op = request["op"]
        if op == "hello":
            return {"ok": hello}
        if op not in ops:
            return {"skip": {"reason": f"no op {op!r}"}}
        if request["wire"] != wire:
            return {"skip": {"reason": f"the library does not speak {request['wire']!r}"}}
        role = _ROLES[op] if op in _ROLES else _role(request)
        if role not in (None, *hello["roles"]):
            return {"skip": {"reason": f"only a {role} does this"}}
        return {"ok": ops[op](request)}
    except Skipped as skipped:
        return {"skip": {"reason": str(skipped)}}
    except Rejected as error:
        return {"err": error.told()}
    except BadRequest as error:
        return {"err": {"class": "parameter", "detail": f"bad request: {error}"}}
    except Exception as error:  # any other error of the library is a finding
        return {"err": {"class": "internal", "detail": f"{type(error).__name__}: {error}"}}
