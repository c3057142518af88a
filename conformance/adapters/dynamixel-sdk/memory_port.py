"""A serial port without a serial line: the SDK's PortHandler with its I/O and its clock replaced."""

from collections import deque

from dynamixel_sdk import PortHandler


class MemoryPort(PortHandler):
    """Keeps what the SDK writes and hands out `chunks` as what has been received.

    The base class opens nothing before openPort(), which is never called.
    """

    def __init__(self, chunks=()):
        super().__init__("memory")
        self.written = b""
        self._chunks = deque(chunk for chunk in chunks if chunk)

    def clearPort(self):
        self._chunks.clear()

    def getBytesAvailable(self):
        return len(self._chunks[0]) if self._chunks else 0

    def readPort(self, length):
        # As pyserial without a timeout: what has arrived, at most `length` bytes, never an error.
        # The next chunk arrives only when the one before it has been read. The SDK asks for a
        # negative number when a packet turns out shorter than its minimum: pyserial reads nothing.
        if length <= 0 or not self._chunks:
            return b""
        chunk = self._chunks.popleft()
        if len(chunk) > length:
            self._chunks.appendleft(chunk[length:])
        return chunk[:length]

    def writePort(self, packet):
        # pyserial turns the SDK's list into bytes too, and fails as this does on a number above 255.
        data = bytes(packet)
        self.written += data
        return len(data)

    def isPacketTimeout(self):
        # No time passes while bytes are left; after the last one the time limit is reached at once.
        return not self._chunks
