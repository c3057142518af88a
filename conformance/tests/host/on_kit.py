"""The host of host.py on the port in memory of the kit for Python. Its argument is what it does wrong."""

import host
from actucheck.adapter import Host, Rejected, Skipped, serve
from actucheck.memory import Memory


class System:
    """What the host uses of the modules `os` and `select`."""

    @staticmethod
    def read(port, size):
        return port.read(min(size, port.in_waiting))

    @staticmethod
    def write(port, data):
        return port.write(data)

    @staticmethod
    def select(ports, _writable, _broken, timeout):
        (port,) = ports
        end = port.time() + timeout
        while not port.in_waiting and port.time() < end:
            port.sleep(0.0005)
        return ports if port.in_waiting else [], [], []


def open_port(path, baud):
    raise Rejected("port", "here it takes a port in memory only")


def open_memory(memory, baud):
    host.time = memory
    return memory


def call(port, call):
    try:
        devices = host.call(port, call)
    except host.Failed as failed:
        raise Rejected(failed.error_class) from None
    if devices is None:
        raise Skipped("it has no such call")
    return devices


host.os = host.select = System
serve(
    {"name": host.WRONG, "version": "1"},
    ["host"],
    "dynamixel2",
    Host(open_port, Memory.close, call, open_memory).ops,
)
