//! One operation of the codec, chosen by a feature, in a program without a system beneath it.
//!
//! It is done once for each argument and once more, so that two runs tell its instructions. The code with
//! which the program ends is the deepest stack of all, in units of 8 bytes.
#![no_std]
#![no_main]

mod operation;

use core::arch::global_asm;
use core::ptr;

// A program begins with the number of its words, its own name among them, on top of the stack.
global_asm!(
    ".globl _start",
    ".thumb_func",
    "_start:",
    "mov r4, sp",
    "mov r0, r4",
    "bl paint",
    "ldr r0, [r4]",
    "bl work",
    "mov r0, r4",
    "bl deepest",
    "movs r7, #1", // exit
    "svc #0",
);

/// Bytes of the stack that are looked at: more than this is told as this.
const LOOKED_AT: usize = 255 * 8;
/// Bytes at the top of it that `paint` needs itself.
const OWN: usize = 32;
const UNUSED: u8 = 0xA5;

/// Fills the stack, where nothing is yet.
#[unsafe(no_mangle)]
extern "C" fn paint(stack: *mut u8) {
    for below in OWN + 1..=LOOKED_AT {
        // SAFETY: the stack of a program has megabytes, and these bytes are below all that is in use.
        unsafe { ptr::write_volatile(stack.wrapping_sub(below), UNUSED) };
    }
}

#[unsafe(no_mangle)]
extern "C" fn work(times: u32) {
    operation::run(times);
}

/// How much of the stack was used, in units of 8 bytes.
#[unsafe(no_mangle)]
extern "C" fn deepest(stack: *const u8) -> usize {
    let mut used = LOOKED_AT;
    // SAFETY: as above.
    while used > OWN && unsafe { ptr::read_volatile(stack.wrapping_sub(used)) } == UNUSED {
        used -= 1;
    }
    used.div_ceil(8)
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    // An instruction that is none ends the program with a signal.
    // SAFETY: nothing follows it.
    unsafe { core::arch::asm!("udf #0", options(noreturn)) }
}
