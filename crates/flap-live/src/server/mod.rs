//! The HTTP server of the live page, for this machine only.

mod answers;
mod connections;
mod routes;
mod state;

use std::io;
use std::net::{Ipv4Addr, TcpListener};
use std::sync::Arc;
use std::thread::JoinHandle;
use std::time::Duration;

use flap_core::simulate::Simulator;
use flap_sweep::grid::diagnostic::Mistakes;
use flap_sweep::plan::Plan;
use flap_sweep::run::RunOptions;
use tokio::net::TcpListener as Listener;
use tokio::sync::oneshot::{self, Sender};
use tokio::task::LocalSet;

use crate::guard::Guard;
use crate::opened::{self, Opened};
use state::ServerState;

/// Number of threads that wait for requests or compute answers. Additional worker threads compute rows.
const MOST_BLOCKING: usize = 16;

/// Options of a server.
#[derive(Clone, Copy, Debug, Default)]
pub struct LiveOptions {
    /// Port of the server; 0 selects a free port.
    pub port: u16,
    /// Threads and SIMD instructions for the computation of rows.
    pub run: RunOptions,
}

/// The reason why a server does not start.
#[derive(Debug, thiserror::Error)]
pub enum StartError {
    /// The port cannot be opened.
    #[error("cannot listen on port {0} of 127.0.0.1: {1}")]
    Port(u16, #[source] io::Error),
    /// The operating system provides no threads or no random numbers.
    #[error("cannot start the server: {0}")]
    System(String),
    /// Without its sections about points, the opened file has mistakes.
    #[error("the design is not valid without its points")]
    Design(Mistakes),
    /// A formula uses a value of the device, but the designs of the page start from the preset.
    #[error("the live page has no values of the device, which a formula of the file uses as `device.NAME`")]
    DeviceValue,
}

/// A running server. The server stops when this value is dropped.
///
/// ```
/// use flap_live::{LiveOptions, Server};
/// use flap_sweep::grid;
///
/// let models = flap_core::simulate::all();
/// let plan = grid::parse("mine", "preset = \"ozaki2018-large\"", models).unwrap();
/// let server = Server::start(plan, models, &LiveOptions::default()).unwrap();
/// assert!(server.address().starts_with("http://127.0.0.1:"));
/// ```
#[derive(Debug)]
pub struct Server {
    address: String,
    stop: Option<Sender<()>>,
    thread: Option<JoinHandle<()>>,
    /// The process that started the server. If this process forks, the child process has a copy of this
    /// struct, but not the thread of the server.
    process: u32,
}

impl Server {
    /// Starts a server of the live page for the first design of `plan`. `models` contains the presets.
    ///
    /// # Errors
    /// [`StartError`] if the port is in use, or if the system provides no threads. The server also does not
    /// start if the formulas of the opened file use values of its device. Mistakes that the file has without
    /// its sections about points are also an error.
    pub fn start(
        plan: Plan,
        models: &[&'static dyn Simulator],
        options: &LiveOptions,
    ) -> Result<Server, StartError> {
        let port = options.port;
        if opened::uses_device(&plan) {
            return Err(StartError::DeviceValue);
        }
        let opened = Opened::new(plan, models).map_err(StartError::Design)?;
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, port));
        let listener = listener.map_err(|error| StartError::Port(port, error))?;
        let system = |error: &dyn ToString| StartError::System(error.to_string());
        let bound = listener.local_addr().map_err(|error| system(&error))?;
        listener.set_nonblocking(true).map_err(|error| system(&error))?;
        let guard = Guard::new(bound.port()).map_err(|error| system(&error))?;
        let address = guard.address();
        let run = RunOptions { grace: Duration::ZERO, ..options.run };
        let state = Arc::new(ServerState::new(opened, guard, run));
        let runtime = tokio::runtime::Builder::new_current_thread()
            .enable_all()
            .max_blocking_threads(MOST_BLOCKING)
            .build()
            .map_err(|error| system(&error))?;
        let (stop, stopped) = oneshot::channel();
        let serve = move || {
            runtime.block_on(async {
                // An open listener is always accepted here.
                let Ok(listener) = Listener::from_std(listener) else { return };
                let tasks = LocalSet::new();
                tasks.spawn_local(connections::serve(listener, routes::routes(state)));
                // `stop` sends the message; an error means that the server was dropped.
                let _ = tasks.run_until(stopped).await;
                // The drop of the tasks closes the connections and cancels their requests.
            });
            runtime.shutdown_timeout(Duration::from_secs(1));
        };
        let thread = std::thread::Builder::new().name("flap-live".to_owned()).spawn(serve);
        let thread = thread.map_err(|error| system(&error))?;
        Ok(Server { address, stop: Some(stop), thread: Some(thread), process: std::process::id() })
    }

    /// Returns the address of the page, with its token.
    pub fn address(&self) -> &str {
        &self.address
    }

    /// Stops the server, closes connections, and stops current computations.
    ///
    /// In a forked child of the process that started the server, a drop has no effect, and the server continues in the
    /// parent.
    pub fn stop(&mut self) {
        if self.process != std::process::id() {
            // In a child, waking or joining a thread of the parent would use the parent's event loop, or panic.
            std::mem::forget((self.stop.take(), self.thread.take()));
            return;
        }
        // The receiver exists as long as the thread runs.
        if let Some(stop) = self.stop.take() {
            let _ = stop.send(());
        }
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        self.stop();
    }
}
