//! Rows that other processes compute. Together, the rows have the bytes of a run in one process.

use flap_core::num::Backend;
use flap_sweep::files::csv_sink::CsvSink;
use flap_sweep::plan::Plan;
use flap_sweep::run::{Chunk, RowWriter, RunError, Summary, chunk};
use flap_sweep::table::layout::Layout;

use crate::fake::{Fake, Fault};
use crate::formulas::FORMULAS;
use crate::support::{csv, options, plan, plan_with};

/// The chunk that a worker computes for these points.
fn bytes(plan: &Plan, from: u64, to: u64) -> Vec<u8> {
    chunk(plan, &options(2, 10), from..to, |_| false).unwrap().to_bytes().unwrap()
}

/// The text that is assembled from chunks, with the summary.
fn put_together(plan: &Plan, chunks: Vec<Vec<u8>>) -> (String, Result<Summary, RunError>) {
    let mut sink = CsvSink::new(Layout::of(plan).names(), Vec::new());
    let mut output = RowWriter::begin(plan, Summary::default(), &mut sink).unwrap();
    let mut take = |bytes: Vec<u8>| {
        for row in &Chunk::from_bytes(&bytes)?.outcomes(plan, &options(1, 1), output.done())? {
            output.write(row)?;
        }
        output.flush()
    };
    let ended = chunks.into_iter().try_for_each(&mut take);
    let summary = output.finish(ended);
    (String::from_utf8(sink.target().clone()).unwrap(), summary)
}

#[test]
fn chunks_put_together_are_the_rows_of_one_run() {
    let grids: [&dyn Fn() -> Plan; 2] =
        [&|| plan(Fake::leak(Fault::None, 4), 100), &|| plan_with(Fake::leak(Fault::None, 4), 12, FORMULAS)];
    for grid in grids {
        let plan = grid();
        let (alone, summary) = csv(&plan, &options(2, 10));
        for size in [1, 5, 1000] {
            let starts = (0..plan.len()).step_by(size);
            let chunks = starts.map(|from| bytes(&plan, from, plan.len().min(from + size as u64)));
            let (together, of_chunks) = put_together(&plan, chunks.collect());
            assert_eq!(together, alone);
            assert_eq!(of_chunks.unwrap(), *summary.as_ref().unwrap());
        }
    }
}

#[test]
fn chunks_that_end_early_are_an_interrupted_run() {
    let plan = plan(Fake::leak(Fault::None, 4), 100);
    let (text, summary) = put_together(&plan, vec![bytes(&plan, 0, 30), bytes(&plan, 30, 50)]);
    let summary = summary.unwrap();
    assert!(summary.is_interrupted());
    assert_eq!(summary.done(), 50);
    assert_eq!(text.lines().count(), 51);
}

/// A chunk from a worker with another build of the same version.
fn of_another_build(mut bytes: Vec<u8>) -> Vec<u8> {
    bytes[0] ^= 1;
    bytes
}

#[test]
fn chunks_that_do_not_fit_are_refused() {
    let whole = plan(Fake::leak(Fault::None, 4), 100);
    let other = plan(Fake::leak(Fault::None, 4), 101);
    for (chunks, complaint) in [
        (vec![bytes(&whole, 10, 20)], "points 10 to 20 arrived, but point 0 was expected next"),
        (
            vec![bytes(&whole, 0, 10), bytes(&whole, 0, 10)],
            "points 0 to 10 arrived, but point 10 was expected next",
        ),
        (vec![bytes(&other, 0, 10)], "the grid file differs"),
        (vec![vec![7, 7, 7]], ""),
        (vec![of_another_build(bytes(&whole, 0, 10))], "another build of flap than this one"),
        (vec![bytes(&whole, 0, 10)[..40].to_vec()], ""),
    ] {
        let (text, summary) = put_together(&whole, chunks);
        let error = summary.expect_err(complaint).to_string();
        assert!(
            error.starts_with("rows of a worker do not belong to this run: ") && error.contains(complaint),
            "{error}"
        );
        // What came before is kept.
        assert!(text.lines().count() == 1 || text.lines().count() == 11, "{text}");
    }
}

#[test]
fn chunks_of_other_arithmetic_are_refused() {
    let plan = plan(Fake::leak(Fault::None, 4), 10);
    let mut others = options(1, 10);
    let classes: Vec<Backend> = Backend::available();
    let own = others.instructions.arithmetic();
    let Some(&other) = classes.iter().find(|set| set.arithmetic() != own) else { return };
    others.instructions = other;
    let chunk = chunk(&plan, &others, 0..10, |_| false).unwrap();
    let (_, summary) = put_together(&plan, vec![chunk.to_bytes().unwrap()]);
    let error = summary.expect_err("other rounding").to_string();
    assert!(error.contains("the arithmetic is"), "{error}");
}
