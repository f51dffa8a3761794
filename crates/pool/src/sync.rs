//! What threads share, of the standard library. The model of the hand-over has the same names of its own.

pub(crate) use std::sync::Mutex;
pub(crate) use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
pub(crate) use std::thread::park;

/// Number of times an idle worker looks for work before it parks.
pub(crate) const SPINS: u32 = 20_000;

/// A place that is written by one thread while no other reads it.
pub(crate) struct UnsafeCell<T>(std::cell::UnsafeCell<T>);

impl<T> UnsafeCell<T> {
    pub(crate) fn new(value: T) -> UnsafeCell<T> {
        UnsafeCell(std::cell::UnsafeCell::new(value))
    }

    pub(crate) fn with<R>(&self, read: impl FnOnce(*const T) -> R) -> R {
        read(self.0.get())
    }

    pub(crate) fn with_mut<R>(&self, write: impl FnOnce(*mut T) -> R) -> R {
        write(self.0.get())
    }
}

/// A thread that has looked in vain so many times looks again.
pub(crate) fn pause(spins: u32) {
    // A thread that has lost its core needs it again.
    if spins > SPINS { std::thread::yield_now() } else { std::hint::spin_loop() }
}
