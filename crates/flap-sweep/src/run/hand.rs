//! A worker's side of the queue.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};

use super::error::RunError;
use super::queue::Queue;
use crate::notation::text::count;

/// A worker's hold on the queue: takes units out, hands their outcomes in, and counts those that are missing.
pub(crate) struct Hand<'a, T> {
    queue: &'a Queue<'a, T>,
    /// Number of units taken whose outcomes have not been handed in.
    missing: u64,
    /// A mistake of the model.
    fault: Option<String>,
}

impl<T> Hand<'_, T> {
    /// The position of the next unit to run, or `None` if there is none for now. With `idle` the worker runs nothing: the
    /// call may wait, and `None` ends the work.
    pub(crate) fn next(&mut self, idle: bool) -> Option<u64> {
        if self.fault.is_some() {
            return None;
        }
        // A worker with units in hand must never wait: others may be waiting for their rows.
        let position = self.queue.next(idle && self.missing == 0)?;
        self.missing += 1;
        Some(position)
    }

    /// Hands in the outcome of the unit at `position`.
    pub(crate) fn done(&mut self, position: u64, outcome: T) {
        self.missing = self.missing.saturating_sub(1);
        self.queue.done(position, outcome);
    }

    /// Ends the work because the model broke its contract: `fault` says in what way.
    pub(crate) fn fail(&mut self, fault: String) {
        self.fault = Some(fault);
    }

    /// True if units in hand are to be dropped without their rows.
    pub(crate) fn is_cancelled(&self) -> bool {
        self.queue.is_cancelled()
    }
}

/// Runs `units` as one worker, and leaves the queue whatever happens: a panic and units that are lost fail the run.
pub(super) fn work<T>(queue: &Queue<'_, T>, units: &(dyn Fn(&mut Hand<'_, T>) + Sync)) {
    let mut hand = Hand { queue, missing: 0, fault: None };
    let ended = catch_unwind(AssertUnwindSafe(|| units(&mut hand)));
    let outcome = match (ended, hand.fault, hand.missing) {
        (Err(panic), _, _) => Err(RunError::Panic(panic_message(&*panic))),
        (Ok(()), Some(fault), _) => Err(RunError::Model(fault)),
        (Ok(()), None, 0) => Ok(()),
        (Ok(()), None, _) if queue.is_cancelled() => Ok(()),
        (Ok(()), None, lost) => {
            Err(RunError::Model(format!("it returned without the rows of {}", count(lost, "point"))))
        }
    };
    queue.leave(outcome);
}

/// The text of a panic, which is a string in all but exotic cases.
fn panic_message(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().copied().or_else(|| panic.downcast_ref().map(String::as_str));
    text.unwrap_or("no message").to_owned()
}
