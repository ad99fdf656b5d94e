//! A running `flap live`, and requests to it as bytes.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::{Shutdown, TcpStream};
use std::process::Child;
use std::time::Duration;

use serde_json::Value;

use crate::support::{Folder, start};

/// A running server, which ends with the test.
pub(super) struct Live {
    pub(super) child: Child,
    pub(super) port: u16,
    pub(super) token: String,
}

/// An answer: its status, its headers as text, and its body.
#[derive(Debug)]
pub(super) struct Answer {
    pub(super) status: u16,
    pub(super) headers: String,
    pub(super) body: String,
}

impl Live {
    /// Starts `flap live` with these arguments in a folder.
    pub(super) fn start(folder: &Folder, arguments: &[&str]) -> Live {
        let mut child = start(folder, &[&["live", "--no-open"], arguments].concat());
        let mut line = String::new();
        BufReader::new(child.stdout.take().unwrap()).read_line(&mut line).unwrap();
        let address = line.trim().strip_prefix("http://127.0.0.1:").expect("an address on the first line");
        let (port, token) = address.split_once("/?token=").expect("an address with a token");
        let (port, token) = (port.parse().unwrap(), token.to_owned());
        Live { child, port, token }
    }

    /// The answer to a request.
    pub(super) fn send(&self, bytes: &[u8]) -> Option<Answer> {
        self.exchange(bytes, false)
    }

    /// The answer to a request whose connection is closed after `bytes`.
    pub(super) fn cut_off(&self, bytes: &[u8]) -> Option<Answer> {
        self.exchange(bytes, true)
    }

    fn exchange(&self, bytes: &[u8], cut: bool) -> Option<Answer> {
        let mut stream = TcpStream::connect(("127.0.0.1", self.port)).unwrap();
        stream.set_read_timeout(Some(Duration::from_secs(60))).unwrap();
        // The server may answer and close before it has read everything.
        let _ = stream.write_all(bytes);
        if cut {
            let _ = stream.shutdown(Shutdown::Write);
        }
        let mut text = Vec::new();
        let _ = stream.read_to_end(&mut text);
        let text = String::from_utf8_lossy(&text).into_owned();
        let (headers, body) = text.split_once("\r\n\r\n")?;
        let status = headers.split(' ').nth(1)?.parse().ok()?;
        Some(Answer { status, headers: headers.to_owned(), body: body.to_owned() })
    }

    /// The bytes of a request of the page.
    pub(super) fn request(&self, kind: &str, body: &str) -> String {
        let Live { port, token, .. } = self;
        format!(
            "POST /api/{kind} HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nX-Flap-Token: {token}\r\nConnection: close\r\n\
             Content-Type: application/json\r\nContent-Length: {}\r\n\r\n{body}",
            body.len()
        )
    }

    /// The answer to a request of the page.
    pub(super) fn ask(&self, kind: &str, body: &Value) -> (u16, Value) {
        let answer = self.send(self.request(kind, &body.to_string()).as_bytes()).expect("an answer");
        (answer.status, serde_json::from_str(&answer.body).expect("JSON"))
    }

    /// The data of the page.
    pub(super) fn data(&self) -> Value {
        let Live { port, token, .. } = self;
        let get =
            format!("GET /?token={token} HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nConnection: close\r\n\r\n");
        let page = self.send(get.as_bytes()).expect("the page").body;
        let (_, data) = page.split_once("id=\"data\">").expect("the data");
        let (data, _) = data.split_once("</script>").expect("an end of the data");
        serde_json::from_str(data).expect("JSON")
    }

    /// The answer to a request that must have an answer.
    #[track_caller]
    pub(super) fn answer(&self, kind: &str, body: &Value) -> Value {
        let (status, answer) = self.ask(kind, body);
        assert_eq!(status, 200, "{answer}");
        answer
    }
}

impl Drop for Live {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
