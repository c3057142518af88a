//! The libraries in the templates' comments: CRC-16/UMTS bit by bit, a Read of one register, and a device that
//! answers its Ping, also one that comes in parts, if there is no long pause in it.

pub(super) const PYTHON_LIBRARY: &str = r#"
import os
import select


class my_library:
    class Timeout(Exception):
        pass

    class open:
        def __init__(self, path, baud):
            self.file = os.open(path, os.O_RDWR | os.O_NOCTTY)

        def close(self):
            os.close(self.file)

        def read(self, device, address, length):
            os.write(self.file, bytes.fromhex("fffffd0001070002840004001d15"))
            answer = b""
            while len(answer) < 11 + length:
                if not select.select([self.file], [], [], 0.1)[0]:
                    raise my_library.Timeout("no answer")
                answer += os.read(self.file, 64)
            return answer[9:-2]

    class Servo:
        def __init__(self, number):
            assert number == 1
            self.begun = b""

        def hear(self, data, after_ms):
            self.begun = data if after_ms > 50 else self.begun + data
            if not self.begun.endswith(bytes.fromhex("fffffd0001030001194e")):
                return b""
            self.begun = b""
            return bytes.fromhex("fffffd000107005500060426655d")

    def crc(data):
        crc = 0
        for byte in data:
            crc ^= byte << 8
            for _ in range(8):
                crc = (crc << 1 ^ (0x8005 if crc & 0x8000 else 0)) & 0xFFFF
        return crc

"#;
pub(super) const C_LIBRARY: &str = "
static unsigned my_library_crc(const unsigned char *data, size_t count)
{
    unsigned crc = 0;
    size_t bit;
    for (bit = 0; bit < 8 * count; bit++) {
        if (bit % 8 == 0)
            crc ^= (unsigned)data[bit / 8] << 8;
        crc = (crc << 1 ^ (crc & 0x8000 ? 0x8005 : 0)) & 0xFFFF;
    }
    return crc;
}

";
pub(super) const C_HOST_LIBRARY: &str = r#"
static void (*my_send)(const unsigned char *, size_t);
static size_t (*my_receive)(unsigned char *, size_t, long);

static void my_library_open(void (*send)(const unsigned char *, size_t),
                            size_t (*receive)(unsigned char *, size_t, long))
{
    my_send = send;
    my_receive = receive;
}

static int my_library_read(long device, long address, long length, unsigned char *data)
{
    static const unsigned char REQUEST[] = "\xff\xff\xfd\x00\x01\x07\x00\x02\x84\x00\x04\x00\x1d\x15";
    unsigned char answer[300];
    size_t count = 0;
    (void)device;
    (void)address;
    my_send(REQUEST, sizeof REQUEST - 1);
    while (count < 11 + (size_t)length) {
        size_t more = my_receive(answer + count, sizeof answer - count, 20);
        if (more == 0)
            return 0;
        count += more;
    }
    memcpy(data, answer + 9, (size_t)length);
    return 1;
}

"#;

pub(super) const C_SERVO_LIBRARY: &str = r#"
static size_t my_servo_hear(const unsigned char *data, size_t count, long after_ms,
                            unsigned char *answer)
{
    static const unsigned char PING[] = "\xff\xff\xfd\x00\x01\x03\x00\x01\x19\x4e";
    static const unsigned char PONG[] = "\xff\xff\xfd\x00\x01\x07\x00\x55\x00\x06\x04\x26\x65\x5d";
    static size_t begun;
    size_t i;
    if (after_ms > 50)
        begun = 0;
    for (i = 0; i < count; i++)
        begun = data[i] == PING[begun] ? begun + 1 : data[i] == 0xff;
    if (begun < sizeof PING - 1)
        return 0;
    begun = 0;
    memcpy(answer, PONG, sizeof PONG - 1);
    return sizeof PONG - 1;
}

"#;

pub(super) const CPP_LIBRARY: &str = r#"
#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

namespace my_library {
struct Timeout : std::runtime_error {
    using std::runtime_error::runtime_error;
};

class Port {
public:
    Port(const std::string &path, long) : file(::open(path.c_str(), O_RDWR | O_NOCTTY)) {}
    ~Port() { ::close(file); }

    Bytes read(long, long, long length)
    {
        const Bytes request = {0xff, 0xff, 0xfd, 0, 1, 7, 0, 2, 0x84, 0, 4, 0, 0x1d, 0x15};
        if (::write(file, request.data(), request.size()) < 0)
            throw Timeout("not written");
        Bytes answer(11 + length);
        for (std::size_t count = 0; count < answer.size();) {
            pollfd ready = {file, POLLIN, 0};
            if (::poll(&ready, 1, 100) < 1)
                throw Timeout("no answer");
            count += ::read(file, answer.data() + count, answer.size() - count);
        }
        return Bytes(answer.begin() + 9, answer.end() - 2);
    }

private:
    int file;
};

class Servo {
public:
    explicit Servo(int) {}

    Bytes hear(const Bytes &bytes, long after_ms)
    {
        if (after_ms > 50)
            begun.clear();
        begun.insert(begun.end(), bytes.begin(), bytes.end());
        const Bytes ping = {0xff, 0xff, 0xfd, 0, 1, 3, 0, 1, 0x19, 0x4e};
        if (begun.size() < ping.size() || !std::equal(ping.begin(), ping.end(), begun.end() - 10))
            return {};
        begun.clear();
        return {0xff, 0xff, 0xfd, 0, 1, 7, 0, 0x55, 0, 6, 4, 0x26, 0x65, 0x5d};
    }

private:
    Bytes begun;
};

unsigned crc(const Bytes &bytes)
{
    unsigned crc = 0;
    for (const std::uint8_t byte : bytes) {
        crc ^= static_cast<unsigned>(byte) << 8;
        for (int bit = 0; bit < 8; bit++)
            crc = (crc << 1 ^ (crc & 0x8000 ? 0x8005 : 0)) & 0xFFFF;
    }
    return crc;
}
} // namespace my_library

"#;
pub(super) const RUST_LIBRARY: &str = r#"
mod my_library {
    use std::fs::{File, OpenOptions};
    use std::io::{Read, Result, Write};

    pub struct Port(File);

    pub fn open(path: &str, _baud: i64) -> Result<Port> {
        OpenOptions::new().read(true).write(true).open(path).map(Port)
    }

    impl Port {
        pub fn read(&mut self, _device: i64, _address: i64, length: i64) -> Result<Vec<u8>> {
            self.0.write_all(b"\xff\xff\xfd\x00\x01\x07\x00\x02\x84\x00\x04\x00\x1d\x15")?;
            let mut answer = vec![0; 11 + length as usize];
            self.0.read_exact(&mut answer)?;
            Ok(answer[9..answer.len() - 2].to_vec())
        }
    }

    pub struct Servo {
        begun: Vec<u8>,
    }

    impl Servo {
        pub fn new(_id: u8) -> Self {
            Self { begun: Vec::new() }
        }

        pub fn hear(&mut self, bytes: &[u8], after_ms: i64) -> Vec<u8> {
            if after_ms > 50 {
                self.begun.clear();
            }
            self.begun.extend(bytes);
            if !self.begun.ends_with(b"\xff\xff\xfd\x00\x01\x03\x00\x01\x19\x4e") {
                return Vec::new();
            }
            self.begun.clear();
            b"\xff\xff\xfd\x00\x01\x07\x00\x55\x00\x06\x04\x26\x65\x5d".to_vec()
        }
    }

    pub fn crc(bytes: &[u8]) -> u16 {
        bytes.iter().fold(0, |crc, byte| {
            (0..8).fold(crc ^ u16::from(*byte) << 8, |crc, _| {
                crc << 1 ^ if crc & 0x8000 == 0 { 0 } else { 0x8005 }
            })
        })
    }
}

"#;
pub(super) const JAVASCRIPT_LIBRARY: &str = r#"
const myLibrary = {
    Bus: class {
        constructor(port) {
            this.port = port;
        }

        read(device, address, length) {
            this.port.write(Buffer.from("fffffd0001070002840004001d15", "hex"));
            let answer = Buffer.alloc(0);
            while (answer.length < 11 + length) {
                const more = this.port.read(20);
                if (more.length === 0) {
                    return null;
                }
                answer = Buffer.concat([answer, more]);
            }
            return answer.subarray(9, -2);
        }
    },
    Servo: class {
        begun = Buffer.alloc(0);

        hear(bytes, afterMs) {
            this.begun = Buffer.concat([afterMs > 50 ? Buffer.alloc(0) : this.begun, bytes]);
            if (!this.begun.toString("hex").endsWith("fffffd0001030001194e")) {
                return Buffer.alloc(0);
            }
            this.begun = Buffer.alloc(0);
            return Buffer.from("fffffd000107005500060426655d", "hex");
        }
    },
    crc(bytes) {
        let crc = 0;
        for (const byte of bytes) {
            crc ^= byte << 8;
            for (let bit = 0; bit < 8; bit++) {
                crc = ((crc << 1) ^ (crc & 0x8000 ? 0x8005 : 0)) & 0xffff;
            }
        }
        return crc;
    },
};

"#;
