//! Connections, with a limit on their number, and limits on the times to receive a request and to send its answer.

use std::sync::Arc;
use std::time::Duration;

use axum::Router;
use hyper::server::conn::http1;
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::service::TowerToHyperService;
use tokio::net::TcpListener;
use tokio::sync::Semaphore;
use tokio::task::spawn_local;
use tokio::time::sleep;
use tokio_io_timeout::TimeoutStream;

/// Longest time for each step of a connection: to receive a request's head, to receive its body, and to send
/// a part of the answer.
pub(super) const STEP_TIMEOUT: Duration = Duration::from_secs(5);

/// Largest number of connections at the same time. Additional connections wait until an open connection has
/// ended.
const MOST_CONNECTIONS: usize = 128;

/// Pause after a connection that could not be accepted, for example because too many files are open.
const PAUSE: Duration = Duration::from_millis(20);

/// Answers connections with `routes`, as tasks of the current `LocalSet`.
pub(super) async fn serve(listener: TcpListener, routes: Router) {
    let permits = Arc::new(Semaphore::new(MOST_CONNECTIONS));
    loop {
        let Ok(permit) = Arc::clone(&permits).acquire_owned().await else { return };
        let Ok((stream, _)) = listener.accept().await else {
            sleep(PAUSE).await;
            continue;
        };
        let service = TowerToHyperService::new(routes.clone());
        spawn_local(async move {
            let mut protocol = http1::Builder::new();
            protocol.timer(TokioTimer::new()).header_read_timeout(STEP_TIMEOUT);
            let mut stream = TimeoutStream::new(stream);
            stream.set_write_timeout(Some(STEP_TIMEOUT));
            // An error in a connection affects only its browser, which repeats the request.
            let _ = protocol.serve_connection(TokioIo::new(Box::pin(stream)), service).await;
            drop(permit);
        });
    }
}
