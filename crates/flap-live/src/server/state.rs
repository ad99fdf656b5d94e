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
use crate::latest::Latest;
use crate::opened::Opened;
use crate::page;
use crate::request::{Refused, RequestOrder};

/// Largest number of requests that are computed at the same time. Further requests wait, so that memory is bounded.
const MOST_AT_ONCE: usize = 4;

/// The state that all requests share.
pub(super) struct ServerState {
    pub(super) guard: Guard,
    opened: Opened,
    run: RunOptions,
    latest: Latest,
    pub(super) permits: Semaphore,
}

/// The kinds of requests.
#[derive(Clone, Copy)]
pub(super) enum Kind {
    Family,
    Point,
    Motion,
    Hysteresis,
    Save,
}

impl Kind {
    /// Returns the kind of request that has this name in addresses.
    pub(super) fn named(name: &str) -> Option<Kind> {
        let kinds = [Kind::Family, Kind::Point, Kind::Motion, Kind::Hysteresis, Kind::Save];
        kinds.into_iter().find(|kind| kind.name() == name)
    }

    fn name(self) -> &'static str {
        match self {
            Kind::Family => "family",
            Kind::Point => "point",
            Kind::Motion => "motion",
            Kind::Hysteresis => "hysteresis",
            Kind::Save => "save",
        }
    }
}

/// The flag of a request. The flag is set when the request is dropped, because nobody then waits for the answer.
pub(super) struct CancelOnDrop(Arc<AtomicBool>);

impl Drop for CancelOnDrop {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

impl CancelOnDrop {
    /// Returns the flag, for the thread that computes.
    pub(super) fn flag(&self) -> Arc<AtomicBool> {
        Arc::clone(&self.0)
    }
}

impl ServerState {
    pub(super) fn new(opened: Opened, guard: Guard, run: RunOptions) -> ServerState {
        ServerState { guard, opened, run, latest: Latest::default(), permits: Semaphore::new(MOST_AT_ONCE) }
    }

    /// Cancels all requests.
    pub(super) fn stop(&self) {
        self.latest.stop();
    }

    /// Returns the page.
    pub(super) fn page(&self) -> Result<String, Refused> {
        let data = serde_json::to_string(&Description::of(&self.opened));
        let data = data.map_err(|error| Refused::Fault(error.to_string()))?;
        Ok(page::live(&format!("{} · flap live", self.opened.plan().source().name), &data))
    }

    /// Starts a request, and cancels older requests of the same kind from the same page.
    pub(super) fn begin(&self, kind: Kind, body: &[u8]) -> Result<CancelOnDrop, Refused> {
        if let Kind::Save = kind {
            return Ok(CancelOnDrop(Arc::default()));
        }
        let RequestOrder { page, number } = read(body)?;
        self.latest.begin(&page, kind.name(), number).map(CancelOnDrop).ok_or(Refused::Superseded)
    }

    /// Returns the answer to a request, as JSON.
    pub(super) fn answer(&self, kind: Kind, body: &[u8], stop: &AtomicBool) -> Result<Vec<u8>, Refused> {
        let context = AnswerContext { opened: &self.opened, options: self.run, stop };
        match kind {
            Kind::Family => written(&answer::family(&context, &read(body)?)?),
            Kind::Point => written(&answer::point(&context, &read(body)?)?),
            Kind::Motion => written(&answer::motion(&context, &read(body)?)?),
            Kind::Hysteresis => written(&answer::hysteresis(&context, &read(body)?)?),
            Kind::Save => written(&answer::save(&context, &read(body)?)?),
        }
    }
}

fn read<T: DeserializeOwned>(body: &[u8]) -> Result<T, Refused> {
    serde_json::from_slice(body).map_err(|error| Refused::Malformed(error.to_string()))
}

fn written(answer: &impl Serialize) -> Result<Vec<u8>, Refused> {
    serde_json::to_vec(answer).map_err(|error| Refused::Fault(error.to_string()))
}
