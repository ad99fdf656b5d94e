//! One worker: a lane ensemble that pulls points from the queue for the whole sweep.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};

use flap_core::num::InstructionSet;
use flap_core::simulate::{Jobs, Point, Row, Status};

use super::RunError;
use super::finished::Finished;
use super::queue::Queue;
use crate::plan::{Plan, Verdict};

/// Runs points until there are none left, and leaves the queue whatever happens.
pub(super) fn work(plan: &Plan, instructions: InstructionSet, queue: &Queue) {
    let mut source = Source { plan, queue, in_hand: 0, fault: None };
    let ended = catch_unwind(AssertUnwindSafe(|| plan.rows().run(instructions, plan.solver(), &mut source)));
    let outcome = match (ended, source.fault, source.in_hand) {
        (Err(panic), _, _) => Err(RunError::Panic(panic_message(&*panic))),
        (Ok(()), Some(fault), _) => Err(RunError::Model(fault)),
        (Ok(()), None, 0) => Ok(()),
        (Ok(()), None, _) if queue.is_cancelled() => Ok(()),
        (Ok(()), None, lost) => {
            Err(RunError::Model(format!("it returned without the rows of {lost} points")))
        }
    };
    queue.leave(outcome);
}

/// The model's view of the queue.
struct Source<'a> {
    plan: &'a Plan,
    queue: &'a Queue<'a>,
    /// Points taken whose rows have not been returned.
    in_hand: u64,
    /// What the model did wrong.
    fault: Option<String>,
}

impl Jobs for Source<'_> {
    fn next(&mut self, idle: bool) -> Option<Point> {
        if self.fault.is_some() {
            return None;
        }
        loop {
            // A worker with points in hand must never wait: others may be waiting for their rows.
            let position = self.queue.next(idle && self.in_hand == 0)?;
            let point = self.plan.selected_point(position);
            match self.plan.judge(&point.values) {
                Verdict::Runs => {
                    self.in_hand += 1;
                    // The model hands the index back and has no other use for it: rows are put in order by position.
                    return Some(Point { index: position, ..point });
                }
                Verdict::Excluded(unsatisfied) => self.queue.done(position, Finished::Excluded(unsatisfied)),
                Verdict::Invalid(invalid) => self.queue.done(position, Finished::Row(Row::invalid(invalid))),
            }
        }
    }

    fn done(&mut self, position: u64, mut row: Row) {
        let expected = if row.status == Status::Periodic { self.plan.rows().columns().len() } else { 0 };
        if row.measures.len() != expected {
            let found = row.measures.len();
            self.fault = Some(format!("it returned {found} measures, not {expected}, for point {position}"));
            return;
        }
        self.in_hand = self.in_hand.saturating_sub(1);
        if !self.plan.measures().is_empty() && position < self.plan.selected() {
            self.plan.add_own_measures(&self.plan.selected_point(position).values, &mut row.measures);
        }
        self.queue.done(position, Finished::Row(row));
    }

    fn interrupted(&self) -> bool {
        self.queue.is_cancelled()
    }
}

/// The text of a panic, which is a string in all but exotic cases.
fn panic_message(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().copied().or_else(|| panic.downcast_ref().map(String::as_str));
    text.unwrap_or("no message").to_owned()
}
