//! One page that is connected: it is sent frames when it is ready for them, and what it asks for reaches the stage.

use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Duration;

use axum::extract::ws::{CloseFrame, Message, WebSocket, close_code};
use serde::Serialize;
use tokio::sync::mpsc;
use tokio::time::{Instant, timeout};

use super::Shared;
use super::places::Place;
use crate::asked::{Asked, LEAST_WORK};
use crate::frame::{Slots, View};
use crate::recent::Heard;
use crate::snapshot::{Colour, Snapshot};
use crate::stage::{PageId, Request};

/// Messages that wait for a page; one that leaves more waiting is cut off.
const WAITING: usize = 512;
/// A page that takes nothing for so long is cut off.
const PATIENCE: Duration = Duration::from_secs(20);

/// Serves a page until one of both ends it.
pub(super) async fn serve(mut socket: WebSocket, shared: &Arc<Shared>, place: Place) {
    let id: PageId = shared.next_page.fetch_add(1, Ordering::Relaxed);
    let (says, mut said) = mpsc::channel(WAITING);
    if !ask(shared, Request::Comes(id, says)) {
        return;
    }
    let mut snapshots = shared.snapshots.clone();
    let mut page = Page::at(place);
    loop {
        let can_draw = page.is_ready;
        let goes_on = tokio::select! {
            received = socket.recv() => match received {
                Some(Ok(message)) => {
                    let goes_on = page.take(message, id, shared, &mut socket).await;
                    if std::mem::take(&mut page.has_moved) {
                        // While time stands, it sees what is there.
                        snapshots.mark_changed();
                    }
                    goes_on
                }
                _ => false,
            },
            text = said.recv() => match text {
                Some(text) => send(&mut socket, Message::text(&*text)).await,
                None => false,
            },
            changed = snapshots.changed(), if can_draw => match changed {
                Ok(()) => {
                    let snapshot = Arc::clone(&snapshots.borrow_and_update());
                    page.show(&snapshot, shared.origin, &mut socket).await
                }
                Err(_) => false,
            },
        };
        if !goes_on {
            break;
        }
    }
    ask(shared, Request::Goes(id));
}

/// Passes something to the stage. If too much waits there, the page is cut off: nothing waits for it.
fn ask(shared: &Shared, request: Request) -> bool {
    shared.requests.try_send(request).is_ok()
}

/// Sends a message, unless the page takes nothing for too long.
async fn send(socket: &mut WebSocket, message: Message) -> bool {
    matches!(timeout(PATIENCE, socket.send(message)).await, Ok(Ok(())))
}

/// What is known of a page.
struct Page {
    slots: Slots,
    view: View,
    colour: Colour,
    wants_lanes: bool,
    selected: Vec<i64>,
    /// It can draw another frame.
    is_ready: bool,
    /// It shows another part of the map than the last frame has.
    has_moved: bool,
    /// What it was told last.
    lights: String,
    twin_lights: String,
    clock: Option<(Clock, Instant)>,
    /// The events that it knows, or has missed.
    events: Heard,
    lanes: Option<Arc<str>>,
    place: Place,
}

impl Page {
    fn at(place: Place) -> Page {
        Page {
            slots: Slots::default(),
            view: View::ALL,
            colour: Colour::Style,
            wants_lanes: false,
            selected: Vec::new(),
            is_ready: false,
            has_moved: false,
            lights: String::new(),
            twin_lights: String::new(),
            clock: None,
            events: Heard::default(),
            lanes: None,
            place,
        }
    }
}

/// The clock as a page is told.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
struct Clock {
    time_s: f64,
    is_playing: bool,
    factor: Option<f64>,
    vehicles: usize,
    waiting: usize,
}

impl Page {
    /// Takes a message of the page. Returns whether it stays connected.
    async fn take(&mut self, message: Message, id: PageId, shared: &Shared, socket: &mut WebSocket) -> bool {
        let text = match message {
            Message::Text(text) => text,
            Message::Ping(_) | Message::Pong(_) if self.place.allows(LEAST_WORK, Instant::now()) => {
                return true;
            }
            Message::Close(_) => return false,
            _ => return close(socket, close_code::UNSUPPORTED, "messages are texts").await,
        };
        let asked = Asked::read(&text);
        let work = asked.as_ref().map_or(LEAST_WORK, Asked::work);
        if !self.place.allows(work, Instant::now()) {
            return close(socket, close_code::POLICY, "too much work at once").await;
        }
        let asked = match asked {
            Ok(asked) => asked,
            Err(what) => return close(socket, close_code::POLICY, &what).await,
        };
        self.note(&asked);
        match asked {
            Asked::Ready(_) | Asked::View(_) => true,
            asked => ask(shared, Request::Asks(id, asked)),
        }
    }

    fn note(&mut self, asked: &Asked) {
        match asked {
            Asked::Ready(_) => self.is_ready = true,
            Asked::View(view) => {
                // While time goes on, the next frame comes soon.
                let stands = self.clock.is_some_and(|(it, _)| !it.is_playing);
                self.has_moved = stands && self.view != View(*view);
                self.view = View(*view);
            }
            Asked::Colour(colour) => self.colour = *colour,
            Asked::Lanes(wants) => self.wants_lanes = *wants,
            Asked::Select(ids) => self.selected = ids.iter().filter_map(|it| it.parse().ok()).collect(),
            _ => {}
        }
    }

    /// Sends what can be seen. The page is then no longer ready, until it says so.
    async fn show(&mut self, snapshot: &Snapshot, origin: [f64; 3], socket: &mut WebSocket) -> bool {
        self.is_ready = false;
        for text in self.news(snapshot) {
            if !send(socket, Message::text(text)).await {
                return false;
            }
        }
        let frame = self.slots.frame(snapshot, origin, self.view, self.colour);
        send(socket, Message::binary(frame)).await
    }

    /// What the page is told beside the frame.
    fn news(&mut self, snapshot: &Snapshot) -> Vec<String> {
        /// Time between two messages about a clock that goes on.
        const CLOCK: Duration = Duration::from_millis(500);
        let mut news = Vec::new();
        let clock = Clock {
            time_s: snapshot.time_s,
            is_playing: snapshot.is_playing,
            factor: snapshot.factor,
            vehicles: snapshot.vehicles.iter().filter(|it| !it.is_ghost() && !it.is_obstacle()).count(),
            waiting: snapshot.waiting,
        };
        let is_old = self.clock.is_none_or(|(told, at)| {
            let same = Clock { time_s: told.time_s, vehicles: told.vehicles, waiting: told.waiting, ..clock };
            same != told || (clock != told && (at.elapsed() > CLOCK || !clock.is_playing))
        });
        if is_old {
            self.clock = Some((clock, Instant::now()));
            news.extend(serde_json::to_string(&clock).ok().map(|it| format!("{{\"clock\":{it}}}")));
        }
        for (name, lights, told) in [
            ("lights", snapshot.lights_in_letters(), &mut self.lights),
            ("twin_lights", snapshot.twin_lights_in_letters(), &mut self.twin_lights),
        ] {
            if lights != *told {
                news.push(format!("{{\"{name}\":\"{lights}\"}}"));
                *told = lights;
            }
        }
        if !self.selected.is_empty() {
            let drivers: Vec<&str> =
                self.selected.iter().filter_map(|it| snapshot.drivers.get(it)).map(|it| &**it).collect();
            news.push(format!("{{\"drivers\":[{}]}}", drivers.join(",")));
        }
        let events = snapshot.recent.since(&mut self.events);
        if !events.is_empty() {
            news.extend(serde_json::to_string(&events).ok().map(|it| format!("{{\"events\":{it}}}")));
        }
        if let Some(lanes) = snapshot.lanes.as_ref().filter(|_| self.wants_lanes)
            && self.lanes.as_ref() != Some(lanes)
        {
            news.push(format!("{{\"lanes\":{lanes}}}"));
            self.lanes = Some(Arc::clone(lanes));
        }
        news
    }
}

/// Closes the connection, and says why.
async fn close(socket: &mut WebSocket, code: u16, why: &str) -> bool {
    /// A reason has at most 123 bytes.
    const REASON: usize = 100;
    let reason: String = why.chars().filter(char::is_ascii).take(REASON).collect();
    send(socket, Message::Close(Some(CloseFrame { code, reason: reason.into() }))).await;
    false
}
