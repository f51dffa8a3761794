//! The server: it gives the page and what it needs to those who may have it, on this machine only unless the user
//! wants it otherwise.

mod connection;
mod doorway;
mod guard;
mod hall;
mod places;

use std::io;
use std::net::SocketAddr;
use std::sync::atomic::AtomicU64;
use std::sync::{Arc, mpsc};
use std::thread::{self, JoinHandle};
use std::time::Duration;

use axum::extract::{Query, State, WebSocketUpgrade};
use axum::http::{StatusCode, header};
use axum::middleware;
use axum::response::{IntoResponse, Response};
use axum::routing::get;
use axum::{Extension, Router};
use hyper::server::conn::http1;
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::service::TowerToHyperService;
use serde::Deserialize;
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::watch;
use tokio::time::Instant;

use crate::PAGE;
use crate::asked::{Asked, LONGEST};
use crate::snapshot::Snapshot;
use crate::source::Source;
use crate::stage::{NO_PAGE, Request, Stage};

pub use doorway::Doorway;
pub use guard::{Address, Token};
use hall::{Hall, Visit};
use places::Places;

/// Requests that wait for the stage.
const REQUESTS: usize = 4096;
/// A client that needs longer for the head of a request is cut off.
const HEAD: Duration = Duration::from_secs(5);
/// A connection that is not one of a page after this time is ended, so that nobody holds it by reading nothing.
const VISIT: Duration = Duration::from_secs(60);

/// A server that runs.
pub struct Server {
    address: Address,
    token: Token,
    requests: mpsc::SyncSender<Request>,
    stage: Option<JoinHandle<()>>,
    sending: Option<JoinHandle<()>>,
    stop: watch::Sender<bool>,
}

/// What requests need.
struct Shared {
    address: Address,
    token: Token,
    scene: Vec<u8>,
    origin: [f64; 3],
    requests: mpsc::SyncSender<Request>,
    snapshots: watch::Receiver<Arc<Snapshot>>,
    next_page: AtomicU64,
    places: Arc<Places>,
}

impl Server {
    /// Serves `source` at `address`; port 0 is any free one. The name of the thread that sends ends with the port.
    ///
    /// # Errors
    /// If the address cannot be used.
    pub fn start(source: Box<dyn Source>, address: SocketAddr, token: Token) -> io::Result<Server> {
        let scene = source.scene();
        let (requests, receiver) = mpsc::sync_channel(REQUESTS);
        let (publisher, snapshots) = watch::channel(Arc::new(Snapshot::default()));
        let listener = std::net::TcpListener::bind(address)?;
        listener.set_nonblocking(true)?;
        let address = Address::of(listener.local_addr()?);
        let shared = Arc::new(Shared {
            address: address.clone(),
            token: token.clone(),
            scene: serde_json::to_vec(&scene)?,
            origin: scene.origin,
            requests: requests.clone(),
            snapshots,
            next_page: AtomicU64::new(1),
            places: Places::new(Instant::now()),
        });
        let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build()?;
        let (stop, stopped) = watch::channel(false);
        let stage = Stage::new(source, receiver, publisher);
        let stage = thread::Builder::new().name("stage".into()).spawn(move || stage.run())?;
        let sending =
            thread::Builder::new().name(format!("sending {}", address.port())).spawn(move || {
                runtime.block_on(async {
                    // A listener of the standard library that does not block is one of tokio's.
                    if let Ok(listener) = TcpListener::from_std(listener) {
                        accept(listener, &shared, stopped).await;
                    }
                });
                runtime.shutdown_timeout(Duration::from_millis(200));
            })?;
        Ok(Server { address, token, requests, stage: Some(stage), sending: Some(sending), stop })
    }

    /// The address of the page, with its token.
    pub fn url(&self) -> String {
        format!("http://{}/?token={}", self.address, self.token)
    }

    /// The address and the port.
    pub fn address(&self) -> &Address {
        &self.address
    }

    /// Does what a page could ask for, such as to let time go on.
    pub fn ask(&self, asked: Asked) {
        // A stage that has ended takes no request.
        let _ = self.requests.send(Request::Asks(NO_PAGE, asked));
    }

    /// The time [s] and the hash of all vehicles; none if the stage has ended.
    pub fn state(&self) -> Option<(f64, u64)> {
        let (answer, answered) = mpsc::channel();
        self.requests.send(Request::State(answer)).ok()?;
        answered.recv().ok()
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        self.stop.send_replace(true);
        // A stage that has ended takes no request.
        let _ = self.requests.send(Request::End);
        for thread in [self.sending.take(), self.stage.take()].into_iter().flatten() {
            let _ = thread.join();
        }
    }
}

/// Accepts connections, each with its own task, until the server stops.
async fn accept(listener: TcpListener, shared: &Arc<Shared>, mut stopped: watch::Receiver<bool>) {
    let app = router(shared);
    let hall = Hall::new();
    loop {
        let accepted = tokio::select! {
            accepted = listener.accept() => accepted,
            _ = stopped.changed() => return,
        };
        // A client that has gone already, or no more files for this process.
        let Ok((stream, _)) = accepted else {
            tokio::time::sleep(Duration::from_millis(20)).await;
            continue;
        };
        hall.receive(|visit| serve(stream, app.clone().layer(Extension(visit))));
    }
}

/// Serves one connection. What goes wrong there ends it, and nothing else.
async fn serve(stream: TcpStream, app: Router) {
    // Frames go out at once.
    let _ = stream.set_nodelay(true);
    let service = TowerToHyperService::new(app);
    let connection = http1::Builder::new()
        .timer(TokioTimer::new())
        .header_read_timeout(HEAD)
        .max_buf_size(16 * 1024)
        .serve_connection(TokioIo::new(stream), service)
        .with_upgrades();
    let _ = tokio::time::timeout(VISIT, connection).await;
}

fn router(shared: &Arc<Shared>) -> Router {
    Router::new()
        .route("/", get(page))
        .route("/scene.json", get(scene))
        .route("/live", get(live))
        .layer(middleware::from_fn_with_state(Arc::clone(shared), guard::check))
        .with_state(Arc::clone(shared))
}

/// The part of an address after the question mark.
#[derive(Deserialize)]
struct Asks {
    #[serde(default)]
    token: String,
}

async fn page() -> Response {
    ([(header::CONTENT_TYPE, "text/html; charset=utf-8")], PAGE).into_response()
}

/// The answer to a visit that may have nothing, or for which there is no room; none if it may.
fn turned_away(shared: &Shared, asks: &Asks, visit: &Visit) -> Option<Response> {
    if !shared.token.is(&asks.token) {
        return Some(guard::refused());
    }
    (!visit.shows_token()).then(|| too_many("connections"))
}

fn too_many(what: &str) -> Response {
    (StatusCode::SERVICE_UNAVAILABLE, format!("too many {what}: close one of them")).into_response()
}

async fn scene(
    State(shared): State<Arc<Shared>>,
    Extension(visit): Extension<Arc<Visit>>,
    Query(asks): Query<Asks>,
) -> Response {
    turned_away(&shared, &asks, &visit).unwrap_or_else(|| {
        ([(header::CONTENT_TYPE, "application/json")], shared.scene.clone()).into_response()
    })
}

async fn live(
    State(shared): State<Arc<Shared>>,
    Extension(visit): Extension<Arc<Visit>>,
    Query(asks): Query<Asks>,
    upgrade: WebSocketUpgrade,
) -> Response {
    if let Some(answer) = turned_away(&shared, &asks, &visit) {
        return answer;
    }
    let Some(place) = shared.places.take(Instant::now()) else { return too_many("pages") };
    upgrade
        .max_message_size(LONGEST)
        .max_frame_size(LONGEST)
        .on_upgrade(move |socket| async move { connection::serve(socket, &shared, place).await })
}
