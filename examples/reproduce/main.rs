//! Computes the cases of the papers and prints `docs/evidence/reproduction.md`.
//!
//! `just reproduce` writes the page; with `--short` only what is quick to compute is printed.

mod arabagi;
mod claim;
mod impulse;
mod jafferis;
mod ozaki;
mod points;
mod table;
mod vehicles;

use std::io::{self, Write};

use claim::{Claim, Verdict};
use table::{Paper, paragraph, section, summary};

const PAPERS: [Paper; 4] = [jafferis::PAPER, ozaki::PAPER, arabagi::PAPER, vehicles::PAPER];

const HEAD: &str = "\
# Reproduction of the papers

<!-- keywords: reproduction, papers, validation -->

This page compares statements of the papers with numbers that flap computes from its [presets](../glossary.md#preset).
Use it to judge how far a preset represents the published robot.
`just reproduce` generates the page, so do not edit it by hand.

Each row is one statement.
If a paper leaves out a size that the statement depends on, there is one row for each size that was tried.
The solver uses [`rtol`](../glossary.md#rtol) = 1e-7.
Motions are [settled](../glossary.md#settled), except motions after an impulse.
Frequency responses have steps of 1 Hz or less.
In the column *published*, *drawn* means that the paper gives no number.

A rule computes each verdict from the two numbers:

| verdict | meaning |
|---|---|
| met | the computed number equals the published one to its rounding, or the statement holds |
| met within X % | the computed number differs by up to X %, and X is at most the limit below |
| not reproduced | the difference is larger than the limit, or the statement does not hold |
| cannot be checked | there is nothing to compare, for the reason in the row |

| published number | limit |
|---|---|
| a resonance, or computed by the paper from the same parameters | 3 % |
| called approximate by the paper | 10 % |
| measured | 20 % |
| any number of a robot whose wing and actuator are assumed | 25 % |

The limits were chosen after the results were known.
Judge by X and by the computed number rather than by the verdict.

Corrections to the printed equations and all assumptions are listed with the models: [direct drive](../models/direct-drive.md), [bimorph](../models/bimorph.md) and [four-bar](../models/four-bar.md).
[Resonance](../how-to/resonance.md) describes motions after an impulse, and [Experiments](../how-to/experiments.md) describes prescribed strokes.

";

fn main() -> io::Result<()> {
    let short = std::env::args().any(|argument| argument == "--short");
    io::stdout().lock().write_all(page(short).as_bytes())
}

/// The page; if `short`, without the counts and with quick groups only.
fn page(short: bool) -> String {
    let mut sections = Vec::new();
    let mut verdicts: Vec<(&Paper, Vec<Verdict>)> = Vec::new();
    for paper in &PAPERS {
        sections.push(format!("## {}\n\n{}", paper.title, paragraph(paper.preface)));
        let mut of_paper = Vec::new();
        for group in paper.groups.iter().filter(|group| group.quick || !short) {
            let claims: Vec<Claim> = (group.claims)();
            of_paper.extend(claims.iter().map(|claim| claim.verdict));
            sections.push(section(group, &claims));
        }
        verdicts.push((paper, of_paper));
    }
    let counts = if short { String::new() } else { summary(&verdicts) };
    format!("{HEAD}{counts}{}\n", sections.concat().trim_end())
}

#[cfg(test)]
mod tests {
    /// The committed page has every line of what is quick to compute.
    #[test]
    fn the_page_is_up_to_date() {
        let written = include_str!("../../docs/evidence/reproduction.md");
        for line in super::page(true).lines() {
            assert!(written.lines().any(|one| one == line), "`just reproduce` would change the line\n{line}");
        }
    }
}
