"""A port in memory, in the place of pyserial's `Serial` or its module, with a clock in that of the module `time`."""

# How long a read without a time-out takes on a line that is silent: longer than any call may.
_FOR_EVER = 3600.0
# How long it takes to ask for the time, or for the bytes that are there: then who polls comes to an end.
_LOOK = 10e-6
# The most bytes of a call that are told. A library may send without an end.
_TOLD = 64 * 1024


class Memory:
    """A serial port without a line. Its time is counted, not waited.

    A read that finds too few bytes lets the clock go on until the next are there, or until its time-out. The
    library's module may have the port as its `time` too, so that both go by one clock, and as its `serial`.
    """

    def __init__(self, received=b"", timeout=None):
        self.timeout = timeout
        self._now = 0.0
        self._coming = []  # bytes, and when they are there
        self._input = bytearray(received)
        self.begin(b"", [])

    # What libraries use of the module `serial`.

    EIGHTBITS, PARITY_NONE, STOPBITS_ONE = 8, "N", 1

    def Serial(self, port=None, baudrate=9600, bytesize=8, parity="N", stopbits=1, timeout=None, **_others):
        """Opens this port, whatever its name."""
        self.timeout = timeout
        return self

    # What they use of its `Serial`. A library may set other attributes, such as `baudrate`; they change nothing.

    is_open = True

    def read(self, size=1):
        self.sleep(_LOOK)
        end = self._now + (_FOR_EVER if self.timeout is None else self.timeout)
        while len(self._input) < size and self._now < end:
            self._wait_until(min([end, *(at for at, _ in self._coming)]))
        data = bytes(self._input[:size])
        del self._input[:size]
        return data

    def write(self, data):
        for byte in bytes(data)[: _TOLD - len(self._sent)]:
            self._sent.append(byte)
            if self._sent.endswith(self._frame) and self._answers:
                self._coming += [(self._now + ms / 1000, burst) for ms, burst in self._answers.pop(0)]
                self._coming.sort(key=lambda burst: burst[0])
        if not self._counts or self._counts[-1][1] < len(self._sent):
            self._counts.append((self._now, len(self._sent)))
        return len(data)

    @property
    def in_waiting(self):
        self.sleep(_LOOK)
        return len(self._input)

    def reset_input_buffer(self):
        self._wait_until(self._now)
        self._input.clear()

    def reset_output_buffer(self):
        pass

    def flush(self):
        pass

    def open(self):
        pass

    def close(self):
        pass

    # What the module `time` has.

    def time(self):
        self.sleep(_LOOK)
        return self._now

    monotonic = perf_counter = time

    def sleep(self, seconds):
        self._wait_until(self._now + seconds)

    # What an adapter asks.

    @property
    def sent(self):
        """What was sent since the call began."""
        return bytes(self._sent)

    @property
    def is_silent(self):
        """Whether nothing is there, nor on its way."""
        return not self._input and not self._coming

    def begin(self, frame, answers, late=b"", hurries=False):
        """A call begins. When the last bytes sent are `frame`, the first of `answers` begins: each of its
        (milliseconds, bytes) is there so many milliseconds later. The next time, the second begins."""
        self._frame, self._answers, self._late, self._hurries = frame, list(answers), late, hurries
        self._begun = self._now
        self._sent = bytearray()
        self._counts = []  # at which time it was how many bytes

    def end(self):
        """The call has ended: what was sent in it, and how long it took. The clock goes on until all that is
        on its way is there, unless the next call `hurries`; then what is `late` is there too."""
        sent, told = [], 0
        for at, count in self._counts:
            sent.append({"at_ms": self._ms(at), "bytes": self._sent[told:count].hex()})
            told = count
        ms = self._ms(self._now)
        if not self._hurries:
            self._wait_until(max([self._now, *(at for at, _ in self._coming)]))
        self._input += self._late
        self._late = b""
        return {"sent": sent, "ms": ms}

    def _wait_until(self, time):
        self._now = max(self._now, time)
        while self._coming and self._coming[0][0] <= self._now:
            self._input += self._coming.pop(0)[1]

    def _ms(self, at):
        return round((at - self._begun) * 1000)
