//! Requests from other programs, and broken requests: each request gets a suitable status, and the server keeps
//! running.

use std::io::{Read, Write};
use std::net::TcpStream;
use std::time::Duration;

use serde_json::{Value, json};

use super::server::Live;
use crate::support::Folder;

/// Random numbers that are the same in every run (SplitMix64).
struct Dice(u64);

impl Dice {
    fn roll(&mut self, sides: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        usize::try_from((mixed ^ (mixed >> 31)) % sides as u64).unwrap()
    }

    fn pick<'t>(&mut self, list: &[&'t str]) -> &'t str {
        list[self.roll(list.len())]
    }
}

/// A text in a file beside the grid, which no answer may contain.
const SECRET: &str = "kept to ourselves";

#[test]
fn a_thousand_broken_and_foreign_requests() {
    let folder = Folder::new();
    std::fs::write(folder.path("secret.toml"), SECRET).unwrap();
    let live = Live::start(&folder, &["ozaki2018-large"]);
    let mut dice = Dice(20);
    let mut statuses = std::collections::BTreeMap::new();
    for round in 0..1000 {
        let (bytes, allowed) = broken(&live, &mut dice, round);
        let answer = if allowed.is_empty() { live.cut_off(&bytes) } else { live.send(&bytes) };
        let Some(answer) = answer else {
            // What is no HTTP at all may be hung up on; what is cut off has nobody to answer.
            assert!(allowed.is_empty(), "request {round} got no answer: {}", String::from_utf8_lossy(&bytes));
            *statuses.entry(0).or_insert(0) += 1;
            continue;
        };
        let shown = String::from_utf8_lossy(&bytes[..bytes.len().min(300)]).into_owned();
        assert!(
            allowed.contains(&answer.status) || (allowed.is_empty() && answer.status >= 400),
            "request {round}: {} {}, not one of {allowed:?}: {shown}",
            answer.status,
            answer.body
        );
        assert!(!answer.body.contains(SECRET), "{shown}");
        *statuses.entry(answer.status).or_insert(0) += 1;
    }
    for status in [400, 401, 403, 404, 405, 413, 422] {
        assert!(statuses.contains_key(&status), "no request was answered {status}: {statuses:?}");
    }
    for kind in KINDS {
        let (status, answer) = live.ask(kind, &good(kind));
        assert_eq!(status, 200, "the server goes on: {kind} {answer}");
        let mut unknown = good(kind);
        unknown["desing"] = json!({});
        let (status, answer) = live.ask(kind, &unknown);
        assert_eq!(status, 400, "{kind} {answer}");
        assert!(
            answer["error"].as_str().unwrap().starts_with("unknown field `desing`, expected"),
            "{answer}"
        );
    }
    assert_eq!(folder.names(), ["secret.toml"], "nothing is written");
}

const KINDS: [&str; 5] = ["family", "point", "motion", "hysteresis", "save"];

/// A request of the given kind that the server answers.
fn good(kind: &str) -> Value {
    let mut request = json!({ "design": { "air_density": 1.1 } });
    let x = json!({ "name": "drive_frequency", "from": 100.0, "to": 110.0, "n": 2 });
    let keys = match kind {
        "family" => vec![("x", x), ("by", Value::Null)],
        "motion" => vec![("samples", json!(9))],
        "hysteresis" => vec![("x", x)],
        "save" => vec![("x", x), ("kind", json!("grid"))],
        _ => Vec::new(),
    };
    for (key, value) in keys {
        request[key] = value;
    }
    request
}

/// The bytes of a request, and the allowed statuses; no status if the server may close the connection.
fn broken(live: &Live, dice: &mut Dice, round: usize) -> (Vec<u8>, Vec<u16>) {
    let kind = dice.pick(&KINDS);
    let good = &good(kind).to_string();
    let whole = live.request(kind, good);
    let own = format!("127.0.0.1:{}", live.port);
    match round % 12 {
        0 => (whole.replace(&live.token, "").into_bytes(), vec![401]),
        1 => {
            let wrong = format!("{:032x}", dice.roll(usize::MAX));
            (whole.replace(&live.token, &wrong).into_bytes(), vec![401])
        }
        2 => {
            let host =
                dice.pick(&["evil.example", "127.0.0.1:1", "localhost", "169.254.0.1", "[::1]", "0.0.0.0"]);
            (whole.replacen(&own, host, 1).into_bytes(), vec![403])
        }
        3 => {
            let origin = dice.pick(&[
                "http://evil.example",
                "null",
                "https://127.0.0.1",
                "file://",
                "http://localhost:1",
            ]);
            let header = format!("Origin: {origin}\r\nConnection:");
            (whole.replacen("Connection:", &header, 1).into_bytes(), vec![403])
        }
        4 => {
            let size = 65_537 + dice.roll(200_000);
            (live.request(kind, &" ".repeat(size)).into_bytes(), vec![413])
        }
        // The body ends early, in JSON or in HTTP.
        5 => (live.request(kind, &good[..dice.roll(good.len() - 1)]).into_bytes(), vec![400]),
        6 => (whole.as_bytes()[..dice.roll(whole.len() - 1)].to_vec(), Vec::new()),
        7 => {
            let path = dice.pick(&[
                "/secret.toml",
                "/../secret.toml",
                "/api/..%2fsecret",
                "/%2e%2e/secret.toml",
                "/api/",
                "/x",
            ]);
            let to = format!("POST {path} HTTP");
            (whole.replacen(&format!("POST /api/{kind} HTTP"), &to, 1).into_bytes(), vec![404])
        }
        8 => {
            let method = dice.pick(&["GET", "PUT", "DELETE", "PATCH", "OPTIONS"]);
            (whole.replacen("POST", method, 1).into_bytes(), vec![405])
        }
        9 => {
            let value = dice.pick(&[
                "-1",
                "1e308",
                "-1e308",
                "\"\"",
                "\"1 V\"",
                "\"secret.toml\"",
                "\"1e999 kg/m^3\"",
                "\"nan\"",
            ]);
            let body = good.replacen("1.1", value, 1);
            // A density of 1e308 is allowed, and makes rows without motion; a motion is refused then.
            let fine = if value == "1e308" { vec![200, 422] } else { vec![422] };
            (live.request(kind, &body).into_bytes(), fine)
        }
        10 => {
            let body = dice.pick(&[
                "",
                "null",
                "[]",
                "7",
                "\"family\"",
                "{\"design\":1}",
                "{\"design\":{\"air_density\":[]}}",
                "\u{0}",
            ]);
            (live.request(kind, body).into_bytes(), vec![400])
        }
        _ => {
            let noise: Vec<u8> =
                (0..=dice.roll(400)).map(|_| u8::try_from(dice.roll(256)).unwrap()).collect();
            (noise, Vec::new())
        }
    }
}

#[test]
fn a_request_that_stops_halfway_is_given_up() {
    let folder = Folder::new();
    let live = Live::start(&folder, &["ozaki2018-large"]);
    let whole = live.request("family", "{\"x\":\"name\",");
    let waits = whole.replace("Content-Length: 12", "Content-Length: 100");
    assert_ne!(whole, waits);
    assert_eq!(live.send(waits.as_bytes()).unwrap().status, 408);
}

#[test]
fn connections_that_send_half_a_head_do_not_block_others() {
    let folder = Folder::new();
    let live = Live::start(&folder, &["ozaki2018-large"]);
    let idle: Vec<TcpStream> = (0..300)
        .map(|_| {
            let mut stream = TcpStream::connect(("127.0.0.1", live.port)).unwrap();
            stream.write_all(b"GET / HTTP/1.1\r\nHost: a").unwrap();
            stream
        })
        .collect();
    // More than the server takes at a time: the answer comes when the first have been given up.
    live.answer("save", &json!({ "kind": "grid" }));
    for mut stream in idle {
        stream.set_read_timeout(Some(Duration::from_secs(60))).unwrap();
        let mut rest = Vec::new();
        let _ = stream.read_to_end(&mut rest);
        assert!(!rest.starts_with(b"HTTP/1.1 200"));
    }
}

/// If nobody reads the answers, the buffers of the connection become full, and the server closes the connection.
#[test]
fn connections_that_read_no_answers_do_not_block_others() {
    let folder = Folder::new();
    let live = Live::start(&folder, &["ozaki2018-large"]);
    let page = format!("GET /?token={} HTTP/1.1\r\nHost: 127.0.0.1:{}\r\n\r\n", live.token, live.port);
    // Large answers, and many small ones for somebody without a token.
    for many in [page.repeat(40), page.replace(&live.token, "none").repeat(20_000)] {
        let unread: Vec<TcpStream> = (0..160)
            .map(|_| {
                let mut stream = TcpStream::connect(("127.0.0.1", live.port)).unwrap();
                stream.set_write_timeout(Some(Duration::from_millis(20))).unwrap();
                let _ = stream.write_all(many.as_bytes());
                stream
            })
            .collect();
        let begun = std::time::Instant::now();
        live.answer("save", &json!({ "kind": "grid" }));
        assert!(begun.elapsed() < Duration::from_secs(30), "{:?}", begun.elapsed());
        drop(unread);
    }
}

#[test]
fn a_second_host_is_refused() {
    let folder = Folder::new();
    let live = Live::start(&folder, &["ozaki2018-large"]);
    let own = format!("Host: 127.0.0.1:{}\r\n", live.port);
    let get = |hosts: &str| {
        let request = format!("GET /?token={} HTTP/1.1\r\n{hosts}Connection: close\r\n\r\n", live.token);
        live.send(request.as_bytes()).unwrap().status
    };
    assert_eq!(get(&own), 200);
    assert_eq!(get(&format!("{own}Host: evil.example\r\n")), 403);
    assert_eq!(get(&format!("Host: evil.example\r\n{own}")), 403);
}

#[test]
fn the_page_comes_with_its_token_alone() {
    let folder = Folder::new();
    let live = Live::start(&folder, &["ozaki2018-large"]);
    let get = |path: &str, more: &str| {
        let request = format!(
            "GET {path} HTTP/1.1\r\nHost: localhost:{}\r\n{more}Connection: close\r\n\r\n",
            live.port
        );
        live.send(request.as_bytes()).unwrap()
    };
    let page = get(&format!("/?token={}", live.token), "");
    assert_eq!(page.status, 200);
    for header in [
        "content-security-policy: default-src 'none'",
        "cache-control: no-store",
        "referrer-policy: no-referrer",
    ] {
        assert!(page.headers.to_lowercase().contains(header), "{}", page.headers);
    }
    assert_eq!(get("/", "").status, 401);
    assert_eq!(get("/?token=", "").status, 401);
    assert_eq!(get(&format!("/?token={}", live.token), "Origin: http://evil.example\r\n").status, 403);
    let large = format!("X-Large: {}\r\n", "a".repeat(1 << 20));
    assert!(get("/", &large).status >= 400);
}
