//! Who may speak to the server: a page that it served itself, on this machine, with the token.

use axum::http::{HeaderMap, Method, header};

/// What a request must show.
#[derive(Clone, Debug)]
pub(crate) struct Guard {
    hosts: [String; 2],
    token: String,
}

impl Guard {
    pub(crate) fn new(port: u16, token: &str) -> Self {
        Self {
            hosts: [format!("127.0.0.1:{port}"), format!("localhost:{port}")],
            token: token.to_owned(),
        }
    }

    /// True for a request that names this server as its host, so that no other name that leads to
    /// the loopback address will do, and that comes from no other page.
    pub(crate) fn admits(&self, method: &Method, headers: &HeaderMap) -> bool {
        let text = |name| headers.get(name).map(|value| value.to_str().unwrap_or("?"));
        let host = text(header::HOST).is_some_and(|host| self.hosts.iter().any(|own| own == host));
        let origin = text(header::ORIGIN).is_none_or(|origin| self.is_own(origin));
        let fetched = text(header::HeaderName::from_static("sec-fetch-site"));
        let reads = matches!(*method, Method::GET | Method::HEAD);
        let same = match fetched {
            None | Some("same-origin") => true,
            // A link in a terminal or the address bar.
            Some("none") => reads,
            Some(_) => false,
        };
        host && origin && same
    }

    fn is_own(&self, origin: &str) -> bool {
        origin.strip_prefix("http://").is_some_and(|host| self.hosts.iter().any(|own| own == host))
    }

    /// What stands behind the token in a path; `None` for another token.
    ///
    /// All bytes are looked at, whatever the first difference.
    pub(crate) fn behind_token<'a>(&self, path: &'a str) -> Option<&'a str> {
        let (token, rest) = path.strip_prefix('/')?.split_once('/')?;
        let alike = token.len() == self.token.len();
        let pairs = token.bytes().zip(self.token.bytes());
        let different = pairs.fold(0, |sum, (one, other)| sum | (one ^ other));
        (alike && different == 0).then_some(rest)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn admitted(method: &Method, pairs: &[(&'static str, &'static str)]) -> bool {
        let mut headers = HeaderMap::new();
        for (name, value) in pairs {
            headers.insert(*name, value.parse().unwrap());
        }
        Guard::new(8080, "secret").admits(method, &headers)
    }

    #[test]
    fn only_the_own_host_is_served() {
        assert!(admitted(&Method::GET, &[("host", "127.0.0.1:8080")]));
        assert!(admitted(&Method::GET, &[("host", "localhost:8080")]));
        assert!(!admitted(&Method::GET, &[]));
        assert!(!admitted(&Method::GET, &[("host", "127.0.0.1:8081")]));
        assert!(!admitted(&Method::GET, &[("host", "rebound.example:8080")]));
    }

    #[test]
    fn a_page_of_another_origin_can_neither_read_nor_write() {
        let host = ("host", "127.0.0.1:8080");
        for method in [Method::GET, Method::POST] {
            assert!(admitted(&method, &[host, ("origin", "http://127.0.0.1:8080")]));
            assert!(!admitted(&method, &[host, ("origin", "http://127.0.0.1:8081")]));
            assert!(!admitted(&method, &[host, ("origin", "https://127.0.0.1:8080")]));
            assert!(!admitted(&method, &[host, ("origin", "null")]));
            assert!(!admitted(&method, &[host, ("sec-fetch-site", "cross-site")]));
            assert!(!admitted(&method, &[host, ("sec-fetch-site", "same-site")]));
        }
        assert!(admitted(&Method::GET, &[host, ("sec-fetch-site", "none")]));
        assert!(!admitted(&Method::POST, &[host, ("sec-fetch-site", "none")]));
    }

    #[test]
    fn the_token_stands_first_in_every_path() {
        let guard = Guard::new(8080, "secret");
        assert_eq!(guard.behind_token("/secret/"), Some(""));
        assert_eq!(guard.behind_token("/secret/api/state"), Some("api/state"));
        for path in ["/", "/secret", "/secre/", "/secrets/", "/Secret/x", "secret/x", "//x"] {
            assert_eq!(guard.behind_token(path), None, "{path}");
        }
    }
}
