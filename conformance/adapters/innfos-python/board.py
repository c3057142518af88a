"""A host on the network: a control board, and the actuators behind it.

The address and the port are the user's. A call sends one datagram, and takes the frames that answer it.
"""

import socket
import time

import commands
import innfos

HANDSHAKE, QUERY = 0x44, commands.QUERY

# How long an answer may take, in seconds. A board takes half a second to find its actuators.
LIMIT, QUERY_LIMIT = 0.1, 0.7


class NoAnswer(Exception):
    """Nothing came in time."""


class NotUnderstood(Exception):
    """What came in time is no answer."""


class Board:
    """A board that was reached at an address."""

    def __init__(self, host, port):
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._socket.connect((host, port))

    def close(self):
        self._socket.close()

    def handshake(self):
        """Greets the board. Whether it is ready."""
        return self.read(0, HANDSHAKE) == b"\1"

    def query(self):
        """The MAC address of each actuator, by its ID."""
        self._send(0, QUERY, b"")
        answers = self._answers(QUERY_LIMIT, lambda address, command: command == QUERY)
        return {address: data for address, data in answers if address != 0}

    def read(self, address, command):
        """The data of the answer to a read."""
        self._send(address, command, b"")
        return self._answer(address, command)

    def write(self, address, command, data):
        """Whether the actuator has done it; None if this command is not answered."""
        self._send(address, command, data)
        if not commands.reply_sizes(command):
            return None
        flag = self._answer(address, command)[0]
        if flag not in (0, 1):
            raise NotUnderstood(f"the result {flag:#04x}")
        return flag == 1

    def _send(self, address, command, data):
        self._forget()
        self._socket.send(innfos.encode("request", address, command, data))

    def _forget(self):
        """What came before a request is no answer to it."""
        self._socket.setblocking(False)
        try:
            while True:
                self._socket.recv(65536)
        except (BlockingIOError, ConnectionRefusedError):
            pass

    def _answer(self, address, command):
        for _, data in self._answers(LIMIT, lambda *of: of == (address, command)):
            return data
        raise NoAnswer("nothing came")

    def _answers(self, limit, is_meant):
        """The address and the data of each answer, until the time is over."""
        end, other = time.monotonic() + limit, None
        found = False
        for datagram in self._datagrams(end):
            frames = innfos.decode_all("reply", datagram)
            for address, command, data in frames:
                if not is_meant(address, command):
                    other = f"a frame of {address} with the command {command:#04x}"
                elif len(data) not in commands.reply_sizes(command):
                    other = f"{len(data)} bytes of data"
                else:
                    found = True
                    yield address, data
            if not frames:
                other = f"no frame: {datagram.hex()}"
        if other and not found:
            raise NotUnderstood(other)

    def _datagrams(self, end):
        while (left := end - time.monotonic()) > 0:
            self._socket.settimeout(left)
            try:
                yield self._socket.recv(65536)
            except TimeoutError:
                return
