//! The thread that owns the traffic: it lets time go on, does what pages ask for, and publishes snapshots. It waits for
//! no page.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::time::{Duration, Instant};

use laneweave::Fault;
use tokio::sync::{mpsc, watch};

use crate::asked::Asked;
use crate::message::{Found, Message};
use crate::recent::Recent;
use crate::saves::Saves;
use crate::snapshot::{Colour, Snapshot};
use crate::source::{Source, Wants};

/// Time between two snapshots at least.
const PUBLISHES: Duration = Duration::from_millis(50);
/// Time for steps between two looks at what pages ask for, and for what they ask before time goes on.
const WORKS: Duration = Duration::from_millis(25);
/// If the simulation is behind by more than this, it does not try to catch up.
const LATE: Duration = Duration::from_millis(300);
/// Time between two messages about marks that are still being looked for.
const MARKS: Duration = Duration::from_secs(1);

/// The number of a page that is connected.
pub type PageId = u64;
/// The number of no page: the program itself.
pub const NO_PAGE: PageId = 0;

/// Something that reaches the stage.
#[derive(Debug)]
pub enum Request {
    /// A page comes. It is told things here.
    Comes(PageId, mpsc::Sender<Arc<str>>),
    /// It asks for something.
    Asks(PageId, Asked),
    /// A page is closed.
    Goes(PageId),
    /// Answers with the time [s] and the hash of all vehicles.
    State(std::sync::mpsc::Sender<(f64, u64)>),
    /// The program ends.
    End,
}

/// A page that is connected.
struct Page {
    says: mpsc::Sender<Arc<str>>,
    selected: Vec<i64>,
    wants_desire: bool,
    wants_lanes: bool,
}

/// How time goes on.
struct Pace {
    is_playing: bool,
    /// How many times as fast as reality; none: as fast as it goes.
    factor: Option<f64>,
    /// It was this time of the simulation [s] at that instant.
    from: (f64, Instant),
}

/// What the thread of the traffic works on.
pub struct Stage {
    source: Box<dyn Source>,
    requests: Receiver<Request>,
    snapshots: watch::Sender<Arc<Snapshot>>,
    pages: BTreeMap<PageId, Page>,
    pace: Pace,
    recent: Recent,
    /// Number of the last snapshot, and when it was published.
    published: (u32, Instant),
    /// Whether something has changed since.
    is_new: bool,
    /// When marks were last told, and up to which time they were known [s].
    marks_told: (Instant, f64),
    saves: Saves,
}

impl Stage {
    /// The stage for a source, which gets requests and publishes snapshots. Time stands until a page lets it go on.
    pub fn new(
        source: Box<dyn Source>,
        requests: Receiver<Request>,
        snapshots: watch::Sender<Arc<Snapshot>>,
    ) -> Stage {
        let now = Instant::now();
        Stage {
            source,
            requests,
            snapshots,
            pages: BTreeMap::new(),
            pace: Pace { is_playing: false, factor: Some(1.0), from: (0.0, now) },
            recent: Recent::default(),
            published: (0, now - PUBLISHES),
            is_new: true,
            marks_told: (now, -1.0),
            saves: Saves::default(),
        }
    }

    /// Runs until the program ends.
    pub fn run(mut self) {
        while self.take_all() {
            self.go_on();
            self.tell_hands();
            self.tell_marks();
            self.publish();
        }
    }

    /// Takes what waits, so that no queue grows however fast time goes. Returns whether the program goes on.
    fn take_all(&mut self) -> bool {
        let mut next = self.requests.recv_timeout(self.pause());
        let begin = Instant::now();
        loop {
            match next {
                Ok(Request::End) | Err(RecvTimeoutError::Disconnected) => return false,
                Ok(request) => self.take(request),
                Err(RecvTimeoutError::Timeout) => return true,
            }
            if begin.elapsed() >= WORKS {
                return true;
            }
            next = self.requests.recv_timeout(Duration::ZERO);
        }
    }

    /// How long nothing has to be done, unless somebody asks for something.
    fn pause(&self) -> Duration {
        let Pace { is_playing, factor, from: (from_s, at) } = self.pace;
        match factor {
            _ if !is_playing || self.pages.is_empty() => PUBLISHES,
            None => Duration::ZERO,
            Some(factor) => {
                let next = self.source.time_s() + self.source.step_s() - from_s;
                let due = Duration::from_secs_f64((next / factor).max(0.0));
                due.saturating_sub(at.elapsed()).min(PUBLISHES)
            }
        }
    }

    fn take(&mut self, request: Request) {
        match request {
            Request::Comes(id, says) => self.welcome(id, says),
            Request::Goes(id) => {
                self.pages.remove(&id);
            }
            // Who has gone needs nothing any more.
            Request::Asks(id, _) if !self.is_there(id) => {}
            Request::Asks(id, asked) => {
                let done = self.serve(id, asked);
                if let Err(fault) = done {
                    self.tell(id, &Message::refused(&fault));
                }
            }
            // Who asked may have gone.
            Request::State(answer) => drop(answer.send((self.source.time_s(), self.source.state_hash()))),
            Request::End => {}
        }
    }

    /// Whether a page is still connected, as the program itself always is.
    fn is_there(&self, id: PageId) -> bool {
        id == NO_PAGE || self.pages.get(&id).is_some_and(|it| !it.says.is_closed())
    }

    fn welcome(&mut self, id: PageId, says: mpsc::Sender<Arc<str>>) {
        let page = Page { says, selected: Vec::new(), wants_desire: false, wants_lanes: false };
        self.pages.insert(id, page);
        self.tell(id, &Message { hello: Some(self.source.hello()), ..Message::default() });
        self.tell(id, &Message { hands: Some(self.source.hands()), ..Message::default() });
        self.tell(id, &Message { twin: Some(self.source.twin_facts()), ..Message::default() });
        self.marks_told.1 = -1.0;
        self.is_new = true;
    }

    fn serve(&mut self, id: PageId, asked: Asked) -> Result<(), Fault> {
        self.is_new = true;
        match asked {
            Asked::Play(factor) => {
                self.begin_again()?;
                self.pace.is_playing = true;
                self.pace.factor = factor;
                self.begin_anew();
            }
            Asked::Pause(_) => self.pace.is_playing = false,
            Asked::Step(steps) => {
                self.pace.is_playing = false;
                (0..steps).for_each(|_| self.step());
            }
            Asked::Seek(time_s) => {
                self.source.seek(time_s)?;
                self.recent.clear();
                self.begin_anew();
            }
            Asked::Find(vehicle) => self.find(id, vehicle),
            Asked::Hand(hand) => {
                let put = self.source.hand(&hand)?.map(|it| it.to_string());
                self.tell_hands();
                if put.is_some() {
                    self.tell(id, &Message { put, ..Message::default() });
                }
            }
            Asked::Undo(_) => {
                self.source.undo()?;
                self.tell_hands();
            }
            Asked::Twin(is_wanted) => {
                self.carry_out();
                self.source.twin(is_wanted)?;
                self.tell_all(&Message { twin: Some(self.source.twin_facts()), ..Message::default() });
            }
            Asked::Save(_) => {
                self.saves.count_one(Instant::now())?;
                self.carry_out();
                let saved = Some(self.source.save()?);
                self.tell(id, &Message { saved, ..Message::default() });
            }
            of_page => self.note(id, of_page),
        }
        Ok(())
    }

    /// Restarts a source that has ended, if it can go to any time.
    fn begin_again(&mut self) -> Result<(), Fault> {
        let hello = self.source.hello();
        if self.source.has_ended() && hello.can.seek {
            self.source.seek(hello.begin_s)?;
            self.recent.clear();
        }
        Ok(())
    }

    /// Simulates one step if commands wait for it, so that they take effect before saving.
    fn carry_out(&mut self) {
        if self.source.waits() {
            self.step();
        }
    }

    /// Notes what a page wants to see.
    fn note(&mut self, id: PageId, asked: Asked) {
        let Some(page) = self.pages.get_mut(&id) else { return };
        match asked {
            Asked::Select(ids) => page.selected = ids.iter().filter_map(|it| it.parse().ok()).collect(),
            Asked::Colour(colour) => page.wants_desire = colour == Colour::Desire,
            Asked::Lanes(wants) => page.wants_lanes = wants,
            // The connection itself does the rest.
            _ => {}
        }
    }

    fn find(&mut self, id: PageId, vehicle: String) {
        let at = vehicle.parse().ok().and_then(|it| self.source.find(it));
        let [x, y] = [0, 1].map(|axis| at.map(|it| it[axis]));
        self.tell(id, &Message { found: Some(Found { id: vehicle, x, y }), ..Message::default() });
    }

    /// Time goes on from now.
    fn begin_anew(&mut self) {
        self.pace.from = (self.source.time_s(), Instant::now());
    }

    /// Lets time go on as far as it should.
    fn go_on(&mut self) {
        if self.pages.is_empty() {
            // Time stands while nobody watches.
            return self.begin_anew();
        }
        if !self.pace.is_playing {
            return;
        }
        let Pace { factor, from: (from_s, at), .. } = self.pace;
        let (started, step) = (Instant::now(), self.source.step_s());
        let due = factor.map_or(f64::INFINITY, |it| from_s + at.elapsed().as_secs_f64() * it);
        while self.source.time_s() + step <= due && started.elapsed() < WORKS && !self.source.has_ended() {
            self.step();
        }
        if let Some(factor) = factor
            && due - self.source.time_s() > LATE.as_secs_f64() * factor + step
        {
            self.begin_anew();
        }
        if self.source.has_ended() {
            self.pace.is_playing = false;
            self.is_new = true;
        }
    }

    fn step(&mut self) {
        let mut marks = Vec::new();
        if let Err(fault) = self.source.step(&mut marks) {
            self.tell_all(&Message::refused(&fault));
        }
        self.recent.add(marks, self.source.time_s());
        self.is_new = true;
    }

    /// Tells what of that done by hand is new.
    fn tell_hands(&mut self) {
        let hands = self.source.news_of_hands();
        if hands.is_some() {
            self.tell_all(&Message { hands, ..Message::default() });
        }
    }

    /// Sends new marks of events to all pages.
    fn tell_marks(&mut self) {
        let Some(marks) = self.source.marks() else { return };
        let (told, until) = self.marks_told;
        if self.pages.is_empty() || (until >= 0.0 && told.elapsed() < MARKS) {
            return;
        }
        let marks = marks.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        if marks.until_s > until {
            self.marks_told = (Instant::now(), marks.until_s);
            let text = Message { marks: Some(&marks), ..Message::default() }.text();
            drop(marks);
            self.tell_text(&text);
        }
    }

    /// Publishes what can be seen, if it is new and somebody looks.
    fn publish(&mut self) {
        let (number, at) = self.published;
        if !self.is_new || at.elapsed() < PUBLISHES || self.pages.is_empty() {
            return;
        }
        let selected = self.pages.values().flat_map(|it| it.selected.iter().copied()).collect();
        let wants = Wants {
            desire: self.pages.values().any(|it| it.wants_desire),
            lanes: self.pages.values().any(|it| it.wants_lanes),
            selected,
        };
        let Pace { is_playing, factor, .. } = self.pace;
        let (number, recent) = (number.wrapping_add(1), self.recent.clone());
        let mut snapshot = Snapshot { number, recent, is_playing, factor, ..Snapshot::default() };
        self.source.see(&wants, &mut snapshot);
        self.published = (snapshot.number, Instant::now());
        self.is_new = false;
        self.snapshots.send_replace(Arc::new(snapshot));
    }

    fn tell(&mut self, id: PageId, message: &Message) {
        let text = message.text();
        if let Some(page) = self.pages.get(&id)
            && page.says.try_send(text).is_err()
        {
            // It does not listen: it is cut off, and may come again.
            self.pages.remove(&id);
        }
    }

    fn tell_all(&mut self, message: &Message) {
        self.tell_text(&message.text());
    }

    fn tell_text(&mut self, text: &Arc<str>) {
        self.pages.retain(|_, it| it.says.try_send(Arc::clone(text)).is_ok());
    }
}
