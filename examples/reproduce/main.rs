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
# Statements of the papers, and results of flap

Written by `just reproduce`; not to be edited. Every row is a statement of a paper, computed anew with flap's presets;
where the paper does not give a size, a statement has a row for each size that was tried. `rtol` is 1e-7. Motions are
driven until they settle, except those after an impulse. Responses to frequency have steps of 1 Hz unless a row is
finer. A verdict is a rule applied to the computed number:

- *met*: the published number to its rounding, or the statement holds;
- *met within X %*: off by up to X %, and by no more than 3 % of a resonance or of a number that the paper computed from
  the same parameters, 10 % of a number that it calls approximate, 20 % of a measured one, 25 % where wing and actuator
  are assumed;
- *not reproduced*: further off, or the statement does not hold;
- *cannot be checked*: there is nothing to compare, for the reason given.

The four limits are a choice that was made after the results were known: they decide where *met within X %* ends, so read X and the
computed number rather than the word.

Corrections to print and what is assumed: [model.md](../models/direct-drive.md), [model-bimorph.md](../models/bimorph.md),
[model-four-bar.md](../models/four-bar.md). Free motions and their frequencies:
[resonance.md](../how-to/resonance.md); prescribed strokes: [experiments.md](../how-to/experiments.md).

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
