//! Tokens, and the hosts and origins that may ask.

use std::fmt::Write as _;

use axum::http::header::{HOST, ORIGIN};
use axum::http::{HeaderMap, Uri};

/// The header that requests of the page have.
const TOKEN_HEADER: &str = "x-flap-token";

/// The check of every request: only the page itself may ask, so that no other page of the browser and no other user of the
/// machine reads or computes anything.
pub(crate) struct Guard {
    token: String,
    hosts: [String; 2],
}

/// The reason why a request is refused.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum Intruder {
    /// The token is missing or wrong.
    Token,
    /// The request was sent to another host name, or comes from another page.
    Stranger,
}

impl Guard {
    /// The guard of a server at this port, with a random token of 128 bits.
    ///
    /// # Errors
    /// If the operating system gives no random numbers.
    pub(crate) fn new(port: u16) -> Result<Guard, getrandom::Error> {
        let mut bytes = [0; 16];
        getrandom::fill(&mut bytes)?;
        let mut token = String::new();
        for byte in bytes {
            let _ = write!(token, "{byte:02x}");
        }
        Ok(Guard { token, hosts: [format!("127.0.0.1:{port}"), format!("localhost:{port}")] })
    }

    /// The address of the page.
    pub(crate) fn address(&self) -> String {
        format!("http://{}/?token={}", self.hosts[0], self.token)
    }

    /// Checks host, origin and token. The token is in a header, or in the query of the address where `in_address`.
    pub(crate) fn check(&self, uri: &Uri, headers: &HeaderMap, in_address: bool) -> Result<(), Intruder> {
        let host = headers.get(HOST).and_then(|host| host.to_str().ok());
        if !host.is_some_and(|host| self.hosts.iter().any(|known| known == host)) {
            return Err(Intruder::Stranger);
        }
        if let Some(origin) = headers.get(ORIGIN) {
            let origin = origin.to_str().ok().and_then(|origin| origin.strip_prefix("http://"));
            if !origin.is_some_and(|origin| self.hosts.iter().any(|known| known == origin)) {
                return Err(Intruder::Stranger);
            }
        }
        let given = if in_address {
            let query = uri.query().unwrap_or_default();
            query.split('&').find_map(|pair| pair.strip_prefix("token="))
        } else {
            headers.get(TOKEN_HEADER).and_then(|token| token.to_str().ok())
        };
        if given == Some(self.token.as_str()) { Ok(()) } else { Err(Intruder::Token) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn headers(pairs: &[(&'static str, &str)]) -> HeaderMap {
        pairs.iter().map(|(name, value)| (name.parse().unwrap(), value.parse().unwrap())).collect()
    }

    #[test]
    fn only_the_page_itself_may_ask() {
        let guard = Guard::new(8000).unwrap();
        let other = Guard::new(8000).unwrap();
        assert_ne!(guard.token, other.token);
        let page: Uri = guard.address().parse().unwrap();
        let api: Uri = "/api/family".parse().unwrap();
        let token = guard.token.as_str();
        let asks = |uri: &Uri, pairs: &[(&'static str, &str)], in_address| {
            guard.check(uri, &headers(pairs), in_address)
        };
        let (host, local) = (("host", "127.0.0.1:8000"), ("host", "localhost:8000"));
        assert_eq!(asks(&page, &[host], true), Ok(()));
        assert_eq!(asks(&api, &[host, ("x-flap-token", token)], false), Ok(()));
        let origin = ("origin", "http://localhost:8000");
        assert_eq!(asks(&api, &[local, origin, ("x-flap-token", token)], false), Ok(()));

        assert_eq!(asks(&page, &[host], false), Err(Intruder::Token), "the address is no header");
        assert_eq!(asks(&api, &[host, ("x-flap-token", &other.token)], false), Err(Intruder::Token));
        assert_eq!(asks(&api, &[host], false), Err(Intruder::Token));
        assert_eq!(asks(&page, &[], true), Err(Intruder::Stranger));
        for stranger in ["127.0.0.1:8001", "evil.example:8000", "127.0.0.1", "127.0.0.1:8000.evil.example"] {
            assert_eq!(asks(&page, &[("host", stranger)], true), Err(Intruder::Stranger), "{stranger}");
        }
        for origin in ["http://evil.example", "null", "https://127.0.0.1:8000", "http://127.0.0.1:8001"] {
            let pairs = [host, ("origin", origin), ("x-flap-token", token)];
            assert_eq!(asks(&api, &pairs, false), Err(Intruder::Stranger), "{origin}");
        }
    }
}
