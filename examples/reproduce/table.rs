//! Claims as Markdown.

use crate::claim::{Claim, Verdict};

/// A paper, and the groups of claims about this paper.
pub(crate) struct Paper {
    pub(crate) title: &'static str,
    /// Introduction to the section of the paper, with one sentence per line.
    pub(crate) preface: &'static str,
    pub(crate) groups: &'static [Group],
}

/// A group of claims, which the page shows in one table.
pub(crate) struct Group {
    pub(crate) title: &'static str,
    /// Introduction to the table of a group, with one sentence per line, or an empty text.
    pub(crate) preface: &'static str,
    /// True if the group is quick to compute.
    pub(crate) quick: bool,
    pub(crate) claims: fn() -> Vec<Claim>,
}

/// Returns the text of the page's section for a group of claims.
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

/// Returns the text followed by an empty line. If the text is empty, returns an empty string.
pub(crate) fn paragraph(text: &str) -> String {
    if text.is_empty() { String::new() } else { format!("{text}\n\n") }
}

/// Returns a table with the number of claims for each paper and each verdict.
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
