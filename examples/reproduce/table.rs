//! Claims as Markdown.

use crate::claim::{Claim, Verdict};

/// A paper, and the groups of its claims.
pub(crate) struct Paper {
    pub(crate) title: &'static str,
    /// Introduction to all groups: one sentence per line.
    pub(crate) preface: &'static str,
    pub(crate) groups: &'static [Group],
}

/// Claims that are computed together.
pub(crate) struct Group {
    pub(crate) title: &'static str,
    /// Introduction to the table: one sentence per line, or empty.
    pub(crate) preface: &'static str,
    /// True if the group is quick to compute.
    pub(crate) quick: bool,
    pub(crate) claims: fn() -> Vec<Claim>,
}

/// Returns a group as a section of the page.
pub(crate) fn section(group: &Group, claims: &[Claim]) -> String {
    let mut lines = vec![
        "| place | statement of the paper | published | computed | verdict |".to_owned(),
        "|---|---|---|---|---|".to_owned(),
    ];
    for Claim { place, statement, published, computed, verdict } in claims {
        lines.push(format!("| {place} | {statement} | {published} | {computed} | {} |", words(*verdict)));
    }
    format!("### {}\n\n{}{}\n\n", group.title, paragraph(group.preface), lines.join("\n"))
}

/// Returns a text and an empty line; an empty string if the text is empty.
pub(crate) fn paragraph(text: &str) -> String {
    if text.is_empty() { String::new() } else { format!("{text}\n\n") }
}

/// The number of claims of each paper by verdict.
pub(crate) fn summary(papers: &[(&Paper, Vec<Verdict>)]) -> String {
    let mut lines = vec![
        "| paper | rows | met | met within X % | not reproduced | cannot be checked |".to_owned(),
        "|---|---|---|---|---|---|".to_owned(),
    ];
    for (paper, verdicts) in papers {
        let count = |is: fn(&Verdict) -> bool| verdicts.iter().filter(|verdict| is(verdict)).count();
        lines.push(format!(
            "| {} | {} | {} | {} | {} | {} |",
            paper.title,
            verdicts.len(),
            count(|verdict| matches!(verdict, Verdict::Met)),
            count(|verdict| matches!(verdict, Verdict::MetWithin(_))),
            count(|verdict| matches!(verdict, Verdict::NotReproduced)),
            count(|verdict| matches!(verdict, Verdict::CannotBeChecked(_))),
        ));
    }
    lines.join("\n") + "\n\n"
}

fn words(verdict: Verdict) -> String {
    match verdict {
        Verdict::Met => "met".to_owned(),
        Verdict::MetWithin(share) => format!("met within {:.0} %", (100.0 * share).ceil()),
        Verdict::NotReproduced => "**not reproduced**".to_owned(),
        Verdict::CannotBeChecked(why) => format!("cannot be checked: {why}"),
    }
}
