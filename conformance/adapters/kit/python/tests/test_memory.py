import unittest

from actucheck.memory import Memory


class TestMemory(unittest.TestCase):
    def test_what_answers_is_there_at_its_time(self):
        memory = Memory(timeout=0.01)
        memory.begin(b"\1\2", [[(4, b"\x0a"), (30, b"\x0b")]], late=b"\xff")
        memory.write(b"\1")
        self.assertEqual((memory.read(), round(memory.time(), 3)), (b"", 0.01))
        memory.write(b"\2")
        self.assertEqual(memory.in_waiting, 0)
        self.assertEqual((memory.read(), round(memory.time(), 3)), (b"\x0a", 0.014))
        self.assertEqual((memory.read(5), round(memory.time(), 3)), (b"", 0.024))
        sent = [{"at_ms": 0, "bytes": "01"}, {"at_ms": 10, "bytes": "02"}]
        self.assertEqual(memory.end(), {"sent": sent, "ms": 24})
        # The rest of the answer came after the call, and then what is late.
        self.assertEqual((round(memory.time(), 3), memory.read(3)), (0.04, b"\x0b\xff"))

    def test_a_packet_has_an_answer_for_each_time_and_then_none(self):
        memory = Memory()
        memory.begin(b"\1", [[(0, b"\x0a")], [(9, b"\x0b")]], hurries=True)
        memory.write(b"\1\1\1")
        self.assertEqual(memory.read(), b"\x0a")
        memory.end()
        # The next call finds what was on its way.
        self.assertEqual((memory.in_waiting, memory.is_silent), (0, False))
        self.assertEqual(memory.read(), b"\x0b")
        self.assertEqual((memory.read(), round(memory.time())), (b"", 3600))
        self.assertTrue(memory.is_silent)

    def test_who_polls_comes_to_an_end(self):
        memory, polls = Memory(), 0
        memory.begin(b"\1", [[(20, b"\x0a")]])
        memory.write(b"\1")
        while not memory.in_waiting:
            polls += 1
        self.assertTrue(1000 < polls < 3000, polls)
        memory.reset_input_buffer()
        start = memory.monotonic()
        while memory.monotonic() < start + 0.02:
            memory.read(0)

    def test_a_read_waits_for_the_bytes_that_are_asked_for(self):
        memory = Memory(b"\7", timeout=1)
        memory.begin(b"\1", [[(5, b"\x08"), (6, b"\x09\x0a")]])
        memory.write(b"\1")
        self.assertEqual((memory.read(3), round(memory.time(), 3)), (b"\7\x08\x09", 0.006))
        self.assertEqual(memory.sent, b"\1")

    def test_no_more_than_64_kib_are_told(self):
        memory = Memory()
        memory.begin(b"\1", [])
        for _ in range(3):
            self.assertEqual(memory.write(bytes(40_000)), 40_000)
        self.assertEqual(len(memory.sent), 64 * 1024)


if __name__ == "__main__":
    unittest.main()
