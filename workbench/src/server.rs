//! HTTP on the loopback interface: pages from memory, everything else from a desk.

use std::collections::BTreeMap;
use std::net::{Ipv4Addr, TcpListener};
use std::sync::Arc;

use axum::Router;
use axum::body::{Body, to_bytes};
use axum::extract::{Request, State};
use axum::http::{HeaderValue, Method, StatusCode, header};
use axum::response::{IntoResponse, Response};
use percent_encoding::percent_decode_str;

use crate::guard::Guard;
use crate::pages::page;

/// Most bytes of a request: a file of measured data.
const MOST_BYTES: usize = 1 << 30;

/// A page may load what came from here and nothing else.
const POLICY: &str = "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; \
                      img-src 'self' data: blob:; connect-src 'self'; base-uri 'none'; \
                      form-action 'none'; frame-ancestors 'none'";

/// What a page asks for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Ask {
    /// True for what changes something.
    pub writes: bool,
    /// What is asked for: the path behind `api/`.
    pub what: String,
    /// Words behind the `?`.
    pub words: BTreeMap<String, String>,
    /// What was sent along.
    pub body: Vec<u8>,
}

/// What an answer is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// JSON.
    Json,
    /// A page to keep.
    Html,
    /// Plain text.
    Text,
    /// Numbers.
    Binary,
}

/// What a page is told.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Answer {
    /// HTTP's number for how it went.
    pub status: u16,
    /// What the bytes are.
    pub kind: Kind,
    /// The bytes.
    pub body: Vec<u8>,
}

/// Who answers; asked by several pages at once.
pub type Desk = Arc<dyn Fn(Ask) -> Answer + Send + Sync>;

/// Why the server does not run.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ServeError {
    /// The port cannot be had.
    #[error("port {port} of 127.0.0.1: {source}")]
    Port {
        /// The port that was asked for; 0 is any.
        port: u16,
        /// What the system said.
        source: std::io::Error,
    },
    /// Serving came to an end.
    #[error("the server stopped: {0}")]
    Stopped(#[from] std::io::Error),
}

struct Shared {
    guard: Guard,
    desk: Desk,
}

/// Serves until the process ends; `ready` is told the address of the page.
///
/// Every path begins with `token`. Only the loopback interface listens.
///
/// # Errors
///
/// [`ServeError`] when the port cannot be had, or when the system stops the server.
pub fn serve(
    port: u16,
    token: &str,
    desk: Desk,
    ready: impl FnOnce(&str),
) -> Result<(), ServeError> {
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, port))
        .map_err(|source| ServeError::Port { port, source })?;
    listener.set_nonblocking(true)?;
    let port = listener.local_addr()?.port();
    let shared = Arc::new(Shared { guard: Guard::new(port, token), desk });
    let runtime = tokio::runtime::Builder::new_current_thread().enable_io().build()?;
    runtime.block_on(async {
        let listener = tokio::net::TcpListener::from_std(listener)?;
        ready(&format!("http://127.0.0.1:{port}/{token}/"));
        axum::serve(listener, Router::new().fallback(respond).with_state(shared)).await
    })?;
    Ok(())
}

async fn respond(State(shared): State<Arc<Shared>>, request: Request) -> Response {
    let mut response = routed(&shared, request).await;
    let headers = response.headers_mut();
    let mut set = |name, value| headers.insert(name, HeaderValue::from_static(value));
    set(header::CONTENT_SECURITY_POLICY, POLICY);
    set(header::X_CONTENT_TYPE_OPTIONS, "nosniff");
    set(header::REFERRER_POLICY, "no-referrer");
    set(header::CACHE_CONTROL, "no-store");
    response
}

async fn routed(shared: &Arc<Shared>, request: Request) -> Response {
    if !shared.guard.admits(request.method(), request.headers()) {
        return StatusCode::FORBIDDEN.into_response();
    }
    let path = request.uri().path().to_owned();
    match shared.guard.behind_token(&path) {
        None => StatusCode::FORBIDDEN.into_response(),
        Some(rest) => match rest.strip_prefix("api/") {
            Some(what) => asked(shared, what.to_owned(), request).await,
            None => file(rest, request.method()),
        },
    }
}

fn file(name: &str, method: &Method) -> Response {
    match page(name) {
        Some(_) if *method != Method::GET => StatusCode::METHOD_NOT_ALLOWED.into_response(),
        Some(page) => ([(header::CONTENT_TYPE, page.kind)], page.text).into_response(),
        None => StatusCode::NOT_FOUND.into_response(),
    }
}

async fn asked(shared: &Arc<Shared>, what: String, request: Request) -> Response {
    let writes = match *request.method() {
        Method::GET => false,
        Method::POST => true,
        _ => return StatusCode::METHOD_NOT_ALLOWED.into_response(),
    };
    let words = words(request.uri().query().unwrap_or_default());
    let Ok(body) = to_bytes(request.into_body(), MOST_BYTES).await else {
        return StatusCode::PAYLOAD_TOO_LARGE.into_response();
    };
    let ask = Ask { writes, what, words, body: body.into() };
    let desk = Arc::clone(&shared.desk);
    // A desk may fit for seconds; other pages are answered meanwhile. One that panics has lost
    // nothing but this answer.
    let answer = tokio::task::spawn_blocking(move || desk(ask)).await;
    let Ok(Answer { status, kind, body }) = answer else {
        return StatusCode::INTERNAL_SERVER_ERROR.into_response();
    };
    let kind = match kind {
        Kind::Json => "application/json",
        Kind::Html => "text/html; charset=utf-8",
        Kind::Text => "text/plain; charset=utf-8",
        Kind::Binary => "application/octet-stream",
    };
    let status = StatusCode::from_u16(status).unwrap_or(StatusCode::INTERNAL_SERVER_ERROR);
    (status, [(header::CONTENT_TYPE, kind)], Body::from(body)).into_response()
}

/// `name=value` pairs, percent signs and pluses read.
fn words(query: &str) -> BTreeMap<String, String> {
    let pairs = query.split('&').filter_map(|pair| pair.split_once('='));
    pairs.map(|(name, value)| (plain(name), plain(value))).collect()
}

fn plain(text: &str) -> String {
    percent_decode_str(&text.replace('+', " ")).decode_utf8_lossy().into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_of_a_query_are_read_as_browsers_write_them() {
        let found = words("name=b%C3%A4nk+1.csv&x=&y=%2&bare");
        assert_eq!(found["name"], "bänk 1.csv");
        assert_eq!((found["x"].as_str(), found["y"].as_str(), found.len()), ("", "%2", 3));
    }
}
