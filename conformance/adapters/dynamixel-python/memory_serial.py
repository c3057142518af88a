"""A serial port without a serial line: what the library uses of pyserial's `Serial`."""


class MemorySerial:
    """Keeps what the library writes and hands out what has been received."""

    def __init__(self, received=b""):
        self.written = b""
        self._received = received

    @property
    def exhausted(self):
        return not self._received

    @property
    def timeout(self):
        # No time passes while bytes are left; after the last one the time limit is reached at once.
        return 0 if self.exhausted else None

    def read(self, size):
        # Like pyserial: waits for as many bytes as are asked for, so only the last read has fewer.
        data, self._received = self._received[:size], self._received[size:]
        return data

    def write(self, data):
        self.written += data
        return len(data)
