//! Where connections wait until they have shown the token. However many there are that have not, those that have are
//! served: they are counted apart.

use std::collections::VecDeque;
use std::future::Future;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError};

use tokio::sync::{OwnedSemaphorePermit, Semaphore};
use tokio::task::AbortHandle;

/// Connections that have not shown the token, at the same time. One more, and the oldest one is ended.
const STRANGERS: usize = 64;
/// Connections that have, and are not those of pages.
const GUESTS: usize = 64;

/// All connections.
pub(super) struct Hall {
    strangers: Mutex<VecDeque<(u64, AbortHandle)>>,
    guests: Arc<Semaphore>,
    next: AtomicU64,
}

/// One connection, for as long as it is served.
pub(super) struct Visit {
    number: u64,
    hall: Arc<Hall>,
    /// The room of one who has shown the token.
    room: OnceLock<OwnedSemaphorePermit>,
}

impl Hall {
    pub(super) fn new() -> Arc<Hall> {
        let guests = Arc::new(Semaphore::new(GUESTS));
        Arc::new(Hall { strangers: Mutex::default(), guests, next: AtomicU64::new(0) })
    }

    /// Serves a connection in a task of its own, on the runtime of this thread.
    pub(super) fn receive<F>(self: &Arc<Hall>, serve: impl FnOnce(Arc<Visit>) -> F)
    where
        F: Future<Output = ()> + Send + 'static,
    {
        let number = self.next.fetch_add(1, Ordering::Relaxed);
        let visit = Arc::new(Visit { number, hall: Arc::clone(self), room: OnceLock::new() });
        // It begins after this, on the same thread.
        let task = tokio::spawn(serve(visit)).abort_handle();
        let mut strangers = self.strangers();
        strangers.push_back((number, task));
        let oldest = if strangers.len() > STRANGERS { strangers.pop_front() } else { None };
        drop(strangers);
        oldest.into_iter().for_each(|(_, task)| task.abort());
    }

    fn strangers(&self) -> MutexGuard<'_, VecDeque<(u64, AbortHandle)>> {
        self.strangers.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Visit {
    /// Notes that the token was shown. Returns whether there is room.
    pub(super) fn shows_token(&self) -> bool {
        if self.room.get().is_none() {
            let Ok(room) = Arc::clone(&self.hall.guests).try_acquire_owned() else { return false };
            let _ = self.room.set(room);
            self.leave_strangers();
        }
        true
    }

    fn leave_strangers(&self) {
        self.hall.strangers().retain(|(number, _)| *number != self.number);
    }
}

impl Drop for Visit {
    fn drop(&mut self) {
        self.leave_strangers();
    }
}
