//! Computes the claims of the papers and prints the page `docs/evidence/reproduction.md`.
//!
//! The command `just reproduce` writes the page. With the option `--short`, the program prints only the parts
//! of the page that are quick to compute.

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

<!-- keywords: reproduction, papers, validation, accuracy, accuracy experiments, measurements -->

<!-- The command `just reproduce` writes this page. Change the texts in examples/reproduce. -->

This page compares statements of papers on flapping-wing robots with numbers that flap computes from its [presets](../glossary.md#preset).
Use the comparison to judge how well a preset represents the published robot.

In the sections on the papers, each row of a table is about one statement.
If a statement depends on a number that the paper leaves out, the table has one row for each number that was tried.
All computations use the tolerance [`rtol`](../glossary.md#rtol) = 1e-7.
All motions are [settled](../glossary.md#settled), except motions after an impulse and motions during a frequency sweep.
Computed frequency responses have steps of 1 Hz or less.
In the column *published*, the word *drawn* means that the paper gives no number, for example only a curve in a figure.

A fixed rule computes each verdict from the published number and the computed number:

| verdict | meaning |
|---|---|
| met | the computed number equals the rounded published number, or the computed motions fulfil the statement |
| met within X % | the computed number differs from the published number by up to X %, and X is at most the limit in the next table |
| not reproduced | the two numbers differ by more than the limit, or the computed motions do not fulfil the statement |
| cannot be checked | the paper lacks the numbers for a comparison, and the row gives the reason |

| published number | limit of the difference |
|---|---|
| a resonance frequency, or a number that the paper computes from the same parameters | 3 % |
| a number that the paper calls approximate | 10 % |
| a number that the paper measured | 20 % |
| any other number of a robot whose wing and actuator are assumed | 25 % |

The limits of the differences were chosen after the computed numbers were known.
Judge the agreement by the difference in per cent and by the computed number rather than by the verdict.

The pages on the models list all assumptions and all corrections to the equations of the papers: [direct drive](../models/direct-drive.md), [bimorph](../models/bimorph.md) and [four-bar](../models/four-bar.md).
[Resonance](../how-to/resonance.md) describes how to compute motions after an impulse, and [Experiments](../how-to/experiments.md) describes how to prescribe strokes.

";

fn main() -> io::Result<()> {
    let short = std::env::args().any(|argument| argument == "--short");
    io::stdout().lock().write_all(page(short).as_bytes())
}

/// Returns the text of the page. If `short` is true, the page contains only the groups of claims that are
/// quick to compute, and no counts of verdicts.
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
    /// The page in the repository must contain every line of the short page.
    #[test]
    fn the_page_is_up_to_date() {
        let written = include_str!("../../docs/evidence/reproduction.md");
        for line in super::page(true).lines() {
            assert!(written.lines().any(|one| one == line), "`just reproduce` would change the line\n{line}");
        }
    }
}
