//! Checks the token, host and origin of requests.

use std::fmt::Write as _;
use std::hint::black_box;

use axum::http::header::{HOST, ORIGIN};
use axum::http::{HeaderMap, Uri};

/// The name of the HTTP header in which the page sends the token.
const TOKEN_HEADER: &str = "x-flap-token";

/// The check of every request, which accepts only requests of the page itself.
///
/// The checks reject requests from web pages that are not the live page, and requests from other users of the
/// machine.
pub(crate) struct Guard {
    token: String,
    hosts: [String; 2],
}

/// The reason why a request is rejected.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum Rejection {
    /// The token is missing or wrong.
    WrongToken,
    /// The request was sent to a host name that the server does not have, or comes from another web page.
    ForeignOrigin,
}

impl Guard {
    /// Returns the guard of a server at this port, with a random token of 128 bits.
    ///
    /// # Errors
    /// An error if the operating system returns no random numbers.
    pub(crate) fn new(port: u16) -> Result<Guard, getrandom::Error> {
        let mut bytes = [0; 16];
        getrandom::fill(&mut bytes)?;
        let mut token = String::new();
        for byte in bytes {
            let _ = write!(token, "{byte:02x}");
        }
        Ok(Guard { token, hosts: [format!("127.0.0.1:{port}"), format!("localhost:{port}")] })
    }

    /// Returns the address of the page.
    pub(crate) fn address(&self) -> String {
        format!("http://{}/?token={}", self.hosts[0], self.token)
    }

    /// Checks host, origin and token. The token is in a header or, if `in_address` is true, in the query of the address.
    pub(crate) fn check(&self, uri: &Uri, headers: &HeaderMap, in_address: bool) -> Result<(), Rejection> {
        let is_own = |host: &[u8]| self.hosts.iter().any(|known| known.as_bytes() == host);
        let mut hosts = headers.get_all(HOST).iter();
        let has_own_host = hosts.next().is_some_and(|host| is_own(host.as_bytes())) && hosts.next().is_none();
        // An address in the first line of a request takes precedence over its host header.
        let has_own_address = uri.authority().is_none_or(|host| is_own(host.as_str().as_bytes()));
        let mut origins = headers.get_all(ORIGIN).iter();
        let has_own_origin =
            origins.all(|origin| origin.as_bytes().strip_prefix(b"http://").is_some_and(is_own));
        if !(has_own_host && has_own_address && has_own_origin) {
            return Err(Rejection::ForeignOrigin);
        }
        let given = if in_address {
            let query = uri.query().unwrap_or_default();
            query.split('&').find_map(|pair| pair.strip_prefix("token="))
        } else {
            headers.get(TOKEN_HEADER).and_then(|token| token.to_str().ok())
        };
        if given.is_some_and(|given| is_same(given, &self.token)) {
            Ok(())
        } else {
            Err(Rejection::WrongToken)
        }
    }
}

/// Compares secrets of equal length in a time that does not depend on the position of the first difference.
fn is_same(given: &str, secret: &str) -> bool {
    let differences = given.bytes().zip(secret.bytes()).fold(0, |found, (a, b)| black_box(found | (a ^ b)));
    given.len() == secret.len() && differences == 0
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

        assert_eq!(asks(&page, &[host], false), Err(Rejection::WrongToken), "the address is no header");
        assert_eq!(asks(&api, &[host, ("x-flap-token", &other.token)], false), Err(Rejection::WrongToken));
        assert_eq!(asks(&api, &[host], false), Err(Rejection::WrongToken));
        assert_eq!(asks(&page, &[], true), Err(Rejection::ForeignOrigin));
        let twice = [host, ("host", "evil.example:8000")];
        for hosts in [twice, [twice[1], twice[0]], [host, host]] {
            let mut all = HeaderMap::new();
            for (name, value) in hosts {
                all.append(name, value.parse().unwrap());
            }
            assert_eq!(guard.check(&page, &all, true), Err(Rejection::ForeignOrigin), "{hosts:?}");
        }
        let foreign: Uri = guard.address().replace("127.0.0.1", "evil.example").parse().unwrap();
        assert_eq!(
            asks(&foreign, &[host], true),
            Err(Rejection::ForeignOrigin),
            "the first line of the request"
        );
        let query = |token: &str| format!("http://127.0.0.1:8000/?token={token}").parse::<Uri>().unwrap();
        for wrong in [&token[..31], &format!("{token}0"), "", &format!("{}x", &token[..31])] {
            assert_eq!(asks(&query(wrong), &[host], true), Err(Rejection::WrongToken), "{wrong}");
        }
        for stranger in ["127.0.0.1:8001", "evil.example:8000", "127.0.0.1", "127.0.0.1:8000.evil.example"] {
            assert_eq!(asks(&page, &[("host", stranger)], true), Err(Rejection::ForeignOrigin), "{stranger}");
        }
        for origin in ["http://evil.example", "null", "https://127.0.0.1:8000", "http://127.0.0.1:8001"] {
            let pairs = [host, ("origin", origin), ("x-flap-token", token)];
            assert_eq!(asks(&api, &pairs, false), Err(Rejection::ForeignOrigin), "{origin}");
        }
    }
}
