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

// An op takes the request and returns the object that `ok` holds, or a promise of it, for example:
//
//     function crc(request) {
//         return { crc: myLibrary.crc(Buffer.from(request.bytes, "hex")) };
//     }
//
//     const OPS = { crc };
const OPS = {};

const HELLO = {
    protocol: 2,
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
