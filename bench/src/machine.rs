//! The present speed of the machine: cores of a virtual machine are not always whole ones, and not always near each
//! other.

use std::hint::{black_box, spin_loop};
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::thread;
use std::time::Instant;

/// Time of a message from one core to the other and back [ns]. It is four times as long if the two share no cache,
/// and a quarter of it if they are halves of one core; a virtual machine may be moved at any time.
pub fn round_trip() -> f64 {
    const MESSAGES: u32 = 2_000;
    let (there, back) = (Message::default(), Message::default());
    thread::scope(|scope| {
        scope.spawn(|| {
            for number in 1..=MESSAGES {
                spin_until(|| there.0.load(Ordering::Acquire) == number);
                back.0.store(number, Ordering::Release);
            }
        });
        let send = |number| {
            there.0.store(number, Ordering::Release);
            spin_until(|| back.0.load(Ordering::Acquire) == number);
        };
        send(1);
        let start = Instant::now();
        (2..=MESSAGES).for_each(send);
        1e9 * start.elapsed().as_secs_f64() / f64::from(MESSAGES - 1)
    })
}

/// A message between cores, on a cache line of its own.
#[derive(Default)]
#[repr(align(128))]
struct Message(AtomicU32);

/// Repeats the question.
pub fn spin_until(is_so: impl Fn() -> bool) {
    while !is_so() {
        spin_loop();
    }
}

/// Does `work` while another thread calculates without touching memory: the difference is the cost of the machine,
/// not of the work.
pub fn beside_a_busy_core<T>(work: impl FnOnce() -> T) -> T {
    let is_over = AtomicBool::new(false);
    thread::scope(|scope| {
        scope.spawn(|| {
            let mut number = 1_u64;
            while !is_over.load(Ordering::Relaxed) {
                for _ in 0..1000 {
                    number = black_box(number).wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
                }
            }
        });
        let done = work();
        is_over.store(true, Ordering::Relaxed);
        done
    })
}
