//! The state that all requests share, and the answer to each kind of request.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use flap_sweep::run::RunOptions;
use serde::Serialize;
use serde::de::DeserializeOwned;
use tokio::sync::Semaphore;

use crate::answer::{self, AnswerContext};
use crate::description::Description;
use crate::guard::Guard;
use crate::opened::Opened;
use crate::page;
use crate::request::Refused;

/// Largest number of requests that are computed at the same time. All further requests wait, so that the
/// server needs a limited amount of memory.
const MOST_AT_ONCE: usize = 4;

/// The state that all requests share.
pub(super) struct ServerState {
    pub(super) guard: Guard,
    opened: Opened,
    run: RunOptions,
    pub(super) permits: Semaphore,
}

/// Computes the answer to a request from the body of the request. The answer and the body are JSON.
pub(super) type Answer = fn(&AnswerContext<'_>, &[u8]) -> Result<Vec<u8>, Refused>;

/// Returns the function that answers a kind of request. `kind` is the name of this kind in the addresses of
/// requests.
pub(super) fn answer_of(kind: &str) -> Option<Answer> {
    let answer: Answer = match kind {
        "family" => |context, body| written(&answer::family(context, &read(body)?)?),
        "point" => |context, body| written(&answer::point(context, &read(body)?)?),
        "motion" => |context, body| written(&answer::motion(context, &read(body)?)?),
        "hysteresis" => |context, body| written(&answer::hysteresis(context, &read(body)?)?),
        "save" => |context, body| written(&answer::save(context, &read(body)?)?),
        _ => return None,
    };
    Some(answer)
}

/// A flag that stops the computation of an answer. The flag is set when its request is dropped, because
/// nobody then waits for the answer.
#[derive(Default)]
pub(super) struct CancelOnDrop(Arc<AtomicBool>);

impl Drop for CancelOnDrop {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

impl CancelOnDrop {
    /// Returns the flag for the thread that computes the answer.
    pub(super) fn flag(&self) -> Arc<AtomicBool> {
        Arc::clone(&self.0)
    }
}

impl ServerState {
    pub(super) fn new(opened: Opened, guard: Guard, run: RunOptions) -> ServerState {
        ServerState { guard, opened, run, permits: Semaphore::new(MOST_AT_ONCE) }
    }

    /// Returns the page.
    pub(super) fn page(&self) -> Result<String, Refused> {
        let data = serde_json::to_string(&Description::of(&self.opened));
        let data = data.map_err(|error| Refused::Fault(error.to_string()))?;
        Ok(page::live(&format!("{} · flap live", self.opened.plan().source().name), &data))
    }

    /// Returns the design and the options from which an answer is computed. The flag `stop` cancels the
    /// answer.
    pub(super) fn context<'a>(&'a self, stop: &'a AtomicBool) -> AnswerContext<'a> {
        AnswerContext { opened: &self.opened, options: self.run, stop }
    }
}

fn read<T: DeserializeOwned>(body: &[u8]) -> Result<T, Refused> {
    serde_json::from_slice(body).map_err(|error| Refused::Malformed(error.to_string()))
}

fn written(answer: &impl Serialize) -> Result<Vec<u8>, Refused> {
    serde_json::to_vec(answer).map_err(|error| Refused::Fault(error.to_string()))
}
