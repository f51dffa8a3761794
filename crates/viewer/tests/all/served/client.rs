//! What a page does, without a browser.

use std::io::{ErrorKind, Read, Write};
use std::net::{SocketAddr, TcpStream};
use std::time::{Duration, Instant};

use laneweave::scenario::Origin;
use laneweave_test_data::map;
use laneweave_viewer::{Live, Server, Source, Token};
use tungstenite::{Message, WebSocket, client};

/// Who waits longer waits in vain, however slow the machine is.
pub(crate) const PATIENCE: Duration = Duration::from_secs(600);

/// A simulation of a map.
pub(crate) fn live(name: &str) -> Live {
    let (scenario, origin) = Origin::open(&map(name)).expect("a map");
    Live::new(&scenario, &origin, std::env::temp_dir()).expect("a simulation")
}

/// A server of a simulation on this machine, with its token.
pub(crate) fn server(source: Live) -> (Server, String) {
    serving(Box::new(source))
}

/// The same for any source.
pub(crate) fn serving(source: Box<dyn Source>) -> (Server, String) {
    let token = Token::new();
    let text = token.to_string();
    let address = SocketAddr::from(([127, 0, 0, 1], 0));
    (Server::start(source, address, token).expect("a server"), text)
}

/// Sends bytes, and returns what comes back until the server closes the connection.
pub(crate) fn raw(server: &Server, bytes: &[u8]) -> String {
    let mut stream = TcpStream::connect(server.address().to_string()).expect("a connection");
    stream.set_read_timeout(Some(PATIENCE)).expect("a timeout");
    // The server may have closed it before it has all.
    let _ = stream.write_all(bytes);
    let mut answer = Vec::new();
    let mut part = [0; 4096];
    loop {
        match stream.read(&mut part) {
            Ok(0) => break,
            Ok(count) => answer.extend_from_slice(&part[..count]),
            Err(error) if error.kind() == ErrorKind::WouldBlock => panic!("the connection stays open"),
            Err(_) => break,
        }
    }
    String::from_utf8_lossy(&answer).into_owned()
}

/// A page that is connected.
pub(crate) struct Page {
    socket: WebSocket<TcpStream>,
}

impl Page {
    /// Connects to the server.
    pub(crate) fn of(server: &Server, token: &str) -> Page {
        Page::try_of(server, token).expect("a connection")
    }

    pub(crate) fn try_of(server: &Server, token: &str) -> Option<Page> {
        let stream = TcpStream::connect(server.address().to_string()).ok()?;
        stream.set_read_timeout(Some(PATIENCE)).ok()?;
        let (socket, _) = client(format!("ws://{}/live?token={token}", server.address()), stream).ok()?;
        Some(Page { socket })
    }

    /// Says something. Returns whether the connection is still there.
    pub(crate) fn say(&mut self, text: &str) -> bool {
        self.socket.send(Message::text(text)).is_ok()
    }

    /// The next message; none if the connection has ended.
    pub(crate) fn hear(&mut self) -> Option<Message> {
        match self.socket.read() {
            Ok(Message::Close(_)) | Err(_) => None,
            Ok(message) => Some(message),
        }
    }

    /// The next text that has this key.
    pub(crate) fn hear_of(&mut self, key: &str) -> String {
        self.hears(key).unwrap_or_else(|| panic!("nothing was said of {key}"))
    }

    /// The same; none if the connection ends before.
    pub(crate) fn hears(&mut self, key: &str) -> Option<String> {
        let begin = Instant::now();
        while begin.elapsed() < PATIENCE {
            match self.hear() {
                Some(Message::Text(text)) if text.starts_with(&format!("{{\"{key}\"")) => {
                    return Some(text.as_str().to_owned());
                }
                Some(_) => {}
                None => break,
            }
        }
        None
    }

    /// The next frame, for which it says that it is ready.
    pub(crate) fn frame(&mut self) -> Option<Vec<u8>> {
        self.say("{\"ready\":0}");
        loop {
            if let Message::Binary(bytes) = self.hear()? {
                return Some(bytes.to_vec());
            }
        }
    }

    /// The reason with which the server ends the connection.
    pub(crate) fn end(&mut self) -> Option<String> {
        loop {
            match self.socket.read() {
                Ok(Message::Close(frame)) => return frame.map(|it| it.reason.as_str().to_owned()),
                Ok(_) => {}
                Err(_) => return None,
            }
        }
    }
}
