//! Who may have something: only pages of this server, and only those that know its token.

use std::fmt;
use std::hash::{BuildHasher, Hasher, RandomState};
use std::net::SocketAddr;
use std::sync::Arc;

use axum::extract::{Request, State};
use axum::http::{HeaderMap, HeaderValue, Method, StatusCode, header};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};

use super::Shared;

/// What a browser lets the page do: use its own parts and this server, and nothing else. The page itself allows only
/// one script, which it names by its hash. Only pages of this machine, such as notebooks, may show it in a frame.
const POLICY: &str = "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; connect-src 'self'; \
    img-src data: blob:; worker-src 'none'; base-uri 'none'; form-action 'none'; \
    frame-ancestors http://localhost:* http://127.0.0.1:*";

/// Where the server listens.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Address(SocketAddr);

impl Address {
    pub(super) fn of(address: SocketAddr) -> Address {
        Address(address)
    }

    /// The port.
    pub fn port(&self) -> u16 {
        self.0.port()
    }

    /// Whether a request that names this host means this server. Another name may be one that somebody else has made
    /// to lead here (DNS rebinding).
    fn is(&self, host: &str) -> bool {
        let named =
            |name: &str| host == format!("{name}:{}", self.port()) || (self.port() == 80 && host == name);
        let own = match self.0 {
            SocketAddr::V4(it) => it.ip().to_string(),
            SocketAddr::V6(it) => format!("[{}]", it.ip()),
        };
        // At any address of this machine the name is not known: then the token alone guards it.
        named(&own) || self.0.ip().is_unspecified() || (self.0.ip().is_loopback() && named("localhost"))
    }
}

impl fmt::Display for Address {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

/// A secret that the page knows from its address.
#[derive(Clone)]
pub struct Token(String);

impl Token {
    /// A token that nobody can guess.
    pub fn new() -> Token {
        // Keys of a hash map are random: the system gives them.
        let word = || RandomState::new().build_hasher().finish();
        Token(format!("{:016x}{:016x}", word(), word()))
    }

    /// Whether this is it. The time that this takes does not depend on where the two differ.
    pub(super) fn is(&self, other: &str) -> bool {
        let (own, other) = (self.0.as_bytes(), other.as_bytes());
        own.len() == other.len() && own.iter().zip(other).fold(0, |all, (a, b)| all | (a ^ b)) == 0
    }
}

impl Default for Token {
    fn default() -> Token {
        Token::new()
    }
}

impl fmt::Display for Token {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl fmt::Debug for Token {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Token")
    }
}

/// The answer to those who may not.
pub(super) fn refused() -> Response {
    (StatusCode::FORBIDDEN, "open the address that laneweave view has printed").into_response()
}

/// Lets only requests pass that a page of this server, or no page, has made.
pub(super) async fn check(State(shared): State<Arc<Shared>>, request: Request, next: Next) -> Response {
    let is_read = matches!(*request.method(), Method::GET | Method::HEAD);
    let may = is_read && is_own(&shared.address, request.headers());
    let mut response = if may { next.run(request).await } else { refused() };
    let headers = response.headers_mut();
    for (name, value) in [
        (header::CONTENT_SECURITY_POLICY, POLICY),
        (header::X_CONTENT_TYPE_OPTIONS, "nosniff"),
        (header::REFERRER_POLICY, "no-referrer"),
        (header::CACHE_CONTROL, "no-store"),
    ] {
        headers.insert(name, HeaderValue::from_static(value));
    }
    response
}

/// Whether the host that is named is this one, and the page that asks, if one does, comes from here.
fn is_own(address: &Address, headers: &HeaderMap) -> bool {
    let text = |name| headers.get(name).map(|it| it.to_str().unwrap_or_default());
    let Some(host) = text(header::HOST) else { return false };
    let is_own_origin =
        text(header::ORIGIN).is_none_or(|it| it.strip_prefix("http://").is_some_and(|it| it == host));
    address.is(host) && is_own_origin
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_pages_of_this_server_may_ask() {
        let address = Address::of(SocketAddr::from(([127, 0, 0, 1], 8080)));
        let may = |host: Option<&'static str>, origin: Option<&'static str>| {
            let mut headers = HeaderMap::new();
            host.map(|it| headers.insert(header::HOST, HeaderValue::from_static(it)));
            origin.map(|it| headers.insert(header::ORIGIN, HeaderValue::from_static(it)));
            is_own(&address, &headers)
        };
        assert!(may(Some("127.0.0.1:8080"), None));
        assert!(may(Some("localhost:8080"), Some("http://localhost:8080")));
        assert!(!may(None, None));
        assert!(!may(Some("127.0.0.1"), None));
        assert!(!may(Some("127.0.0.1:8081"), None));
        assert!(!may(Some("evil.example:8080"), None));
        assert!(!may(Some("127.0.0.1:8080"), Some("http://evil.example")));
        assert!(!may(Some("127.0.0.1:8080"), Some("http://localhost:8080")));
        assert!(!may(Some("127.0.0.1:8080"), Some("null")));
        assert!(!may(Some("127.0.0.1:8080"), Some("https://127.0.0.1:8080")));
    }

    #[test]
    fn tokens_are_long_and_never_the_same() {
        let (a, b) = (Token::new(), Token::new());
        assert!(a.to_string().len() == 32 && a.to_string() != b.to_string());
        assert!(a.is(&a.to_string()) && !a.is(&b.to_string()) && !a.is("") && !a.is(&a.to_string()[..31]));
    }
}
