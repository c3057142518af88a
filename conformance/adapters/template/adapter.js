// An adapter that skips everything. Fill in the ops that your library offers.
"use strict";

const readline = require("node:readline");

/** Throw it where the library rejects its input, with one of the error classes. */
class Rejected extends Error {
    constructor(detail = "", fault = "unspecified") {
        super(detail);
        this.fault = fault;
    }
}

/** Throw it where the library has nothing for the request, with the reason. */
class Skipped extends Error {}

/** A port in memory, for a library that takes one. It counts the time, and waits for nothing. */
class Memory {
    #now = 0; // in milliseconds
    #coming = []; // what is on its way: when it is there, and the bytes
    #input = []; // the bytes that are there
    #call = null; // what the line does in this call, and what was sent in it

    /** Sends bytes. */
    write(bytes) {
        const { begun, sent, pieces, frame, answers } = this.#call;
        pieces.push({ at_ms: this.#now - begun, bytes: Buffer.from(bytes).toString("hex") });
        for (const byte of bytes) {
            sent.push(byte);
            if (frame.equals(Buffer.from(sent.slice(-frame.length)))) {
                for (const { after_ms, bytes } of answers.shift() ?? []) {
                    const at = this.#now + after_ms;
                    this.#coming.push({ at, bytes: Buffer.from(bytes, "hex") });
                }
            }
        }
    }

    /** Reads what is there; nothing, if nothing is there in so many milliseconds. */
    read(timeout = 3_600_000) {
        this.sleep(0);
        if (this.#input.length === 0) {
            const times = this.#coming.map(({ at }) => at);
            this.sleep(Math.min(...times, this.#now + timeout) - this.#now);
        }
        return Buffer.from(this.#input.splice(0));
    }

    sleep(milliseconds) {
        this.#now += milliseconds;
        this.#coming.sort((one, other) => one.at - other.at);
        while (this.#coming.length > 0 && this.#coming[0].at <= this.#now) {
            this.#input.push(...this.#coming.shift().bytes);
        }
    }

    /** Answers a request for `exchange` with a call of the library, which returns the devices. */
    async exchange({ frame, answers, late, hurries }, call) {
        const [begun, sent, pieces] = [this.#now, [], []];
        frame = Buffer.from(frame, "hex");
        this.#call = { begun, sent, pieces, frame, answers: [...answers] };
        let returned;
        try {
            returned = { devices: await call() };
        } catch (error) {
            if (!(error instanceof Rejected)) {
                throw error;
            }
            returned = { err: { class: error.fault, detail: error.message } };
        }
        const ok = { sent: pieces, ms: this.#now - begun, ...returned };
        if (!hurries) {
            this.sleep(Math.max(0, ...this.#coming.map(({ at }) => at - this.#now)));
        }
        this.#input.push(...Buffer.from(late, "hex"));
        return ok;
    }
}

// An op takes the request and returns the object that `ok` holds, or a promise of it, for example:
//
//     function crc(request) {
//         return { crc: myLibrary.crc(Buffer.from(request.bytes, "hex")) };
//     }
//
//     const OPS = { crc };

// A library that takes a port has the ops `open`, `exchange` and `close`, and is checked by
// `actucheck host`, for example:
//
//     let [memory, bus] = [null, null];
//
//     function open() {
//         memory = new Memory();
//         bus = new myLibrary.Bus(memory);
//         return {};
//     }
//
//     function close() {
//         [memory, bus] = [null, null];
//         return {};
//     }
//
//     function exchange(request) {
//         const { name, device, address, length } = request.call;
//         if (name !== "read") {
//             throw new Skipped(`no ${name}`);
//         }
//         if (bus === null) {
//             throw new Rejected("no port is open", "port");
//         }
//         return memory.exchange(request, () => {
//             const data = bus.read(device, address, length);
//             if (data === null) {
//                 throw new Rejected("no answer", "timeout");
//             }
//             return [{ id: device, data: data.toString("hex") }];
//         });
//     }
//
//     const OPS = { open, exchange, close };

// A library with a class of a device, which takes bytes and answers them, has the op `device` and the
// role `device`, and is checked by `actucheck device --adapter`, for example:
//
//     const servo = new myLibrary.Servo(1);
//
//     function device(request) {
//         const answer = servo.hear(Buffer.from(request.bytes, "hex"), request.after_ms);
//         return { bytes: answer.toString("hex") };
//     }
//
//     const OPS = { device };
const OPS = {};

const HELLO = {
    protocol: 4,
    implementation: { name: "my_library", version: "0", language: "JavaScript" },
    // A host builds requests and reads replies, a device the reverse; name both if it does both.
    roles: ["host"],
    wires: ["dynamixel2"],
    ops: Object.keys(OPS),
    // The longest packets that it builds and reads, in bytes: { max_send: …, max_receive: … }.
    limits: {},
};

/** The role that does this; null if both do. */
function role(request) {
    if (request.op === "device") {
        return "device";
    }
    let direction = (request.message ?? request).direction;
    if (request.op === "encode") {
        const isRequest = ["instruction", "request"].includes(request.packet.kind);
        direction = isRequest ? "request" : "reply";
    }
    if (direction === undefined) {
        return null;
    }
    const builds = request.op === "encode" || "value" in request || "message" in request;
    return builds === (direction === "request") ? "host" : "device";
}

async function answer(request) {
    const op = request.op;
    if (op === "hello") {
        return { ok: HELLO };
    }
    if (!Object.hasOwn(OPS, op) || !HELLO.wires.includes(request.wire)) {
        return { skip: { reason: `no ${op}` } };
    }
    try {
        if (![null, ...HELLO.roles].includes(role(request))) {
            return { skip: { reason: "the other role does this" } };
        }
        return { ok: await OPS[op](request) };
    } catch (error) {
        if (error instanceof Skipped) {
            return { skip: { reason: error.message } };
        }
        if (error instanceof Rejected) {
            return { err: { class: error.fault, detail: error.message } };
        }
        // Any other error of the library is a finding.
        return { err: { class: "internal", detail: String(error) } };
    }
}

async function main() {
    for await (const line of readline.createInterface({ input: process.stdin })) {
        const request = JSON.parse(line);
        if (request.op === "bye") {
            break;
        }
        const reply = { id: request.id, ...(await answer(request)) };
        process.stdout.write(`${JSON.stringify(reply)}\n`);
    }
    process.stdin.destroy(); // it would keep the program running
}

main();
