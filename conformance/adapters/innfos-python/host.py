"""The ops of a host: the board is opened, and called as its users do."""

from urllib.parse import urlsplit

import commands
from actucheck.adapter import Host, Rejected, Skipped, unhex
from board import QUERY, Board, NoAnswer, NotUnderstood


def open_port(port, baud):
    where = urlsplit(port)
    if where.scheme != "udp":
        raise Rejected("port", f"{port} is no address for datagrams")
    try:
        return Board(where.hostname, where.port)
    except OSError as error:
        raise Rejected("port", str(error)) from None


def make(board, call):
    if call["name"] != "request":
        raise Skipped(f"a host sends no {call['name']}")
    try:
        return told(board, call["device"], call["command"], unhex(call["data"]))
    except NoAnswer as error:
        raise Rejected("timeout", str(error)) from None
    except NotUnderstood as error:
        raise Rejected("corrupt", str(error)) from None
    except OSError as error:
        raise Rejected("port", str(error)) from None


def told(board, device, command, data):
    if command == QUERY:
        return [{"id": id, "mac": mac.hex()} for id, mac in board.query().items()]
    if command in commands.READS:
        return [{"id": device, "data": board.read(device, command).hex()}]
    if command not in commands.WRITES:
        raise Skipped(f"{command:#04x} is in no table")
    done = board.write(device, command, data)
    if done is False:
        raise Rejected("status", "the actuator says that it failed")
    return [{"id": device}] if done else []


OPS = Host(open_port, Board.close, make).ops
