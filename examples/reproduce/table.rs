//! Claims as Markdown.

use crate::claim::{Claim, Verdict};

/// A paper, and the groups of its claims.
pub(crate) struct Paper {
    pub(crate) title: &'static str,
    /// What the reader must know of all that follows.
    pub(crate) preface: &'static str,
    pub(crate) groups: &'static [Group],
}

/// Claims that are computed together.
pub(crate) struct Group {
    pub(crate) title: &'static str,
    /// What the reader must know; may be empty.
    pub(crate) preface: &'static str,
    /// Whether it is quick to compute.
    pub(crate) quick: bool,
    pub(crate) claims: fn() -> Vec<Claim>,
}

/// A group as a section.
pub(crate) fn section(group: &Group, claims: &[Claim]) -> String {
    let mut text = format!("### {}\n\n", group.title);
    if !group.preface.is_empty() {
        text += &paragraph(group.preface);
    }
    text += "| where | what the paper says | published | computed | verdict |\n|---|---|---|---|---|\n";
    for claim in claims {
        let Claim { place, statement, published, computed, verdict } = claim;
        text += &format!("| {place} | {statement} | {published} | {computed} | {} |\n", words(*verdict));
    }
    text + "\n"
}

/// Text in lines of up to 120 characters.
pub(crate) fn paragraph(text: &str) -> String {
    let mut lines = vec![String::new()];
    for word in text.split(' ') {
        let line = lines.last_mut().expect("there is a line");
        if line.is_empty() {
            *line += word;
        } else if line.chars().count() + 1 + word.chars().count() <= 120 {
            *line += &format!(" {word}");
        } else {
            lines.push(word.to_owned());
        }
    }
    lines.join("\n") + "\n\n"
}

/// How many claims of each paper have which verdict.
pub(crate) fn summary<'a>(papers: impl Iterator<Item = (&'a Paper, Vec<Verdict>)>) -> String {
    let mut text = String::from(
        "| paper | claims | met | met within a share | not reproduced | cannot be checked |\n|---|---|---|---|---|---|\n",
    );
    for (paper, verdicts) in papers {
        let count = |is: fn(&Verdict) -> bool| verdicts.iter().filter(|verdict| is(verdict)).count();
        text += &format!(
            "| {} | {} | {} | {} | {} | {} |\n",
            paper.title,
            verdicts.len(),
            count(|verdict| matches!(verdict, Verdict::Met)),
            count(|verdict| matches!(verdict, Verdict::MetWithin(_))),
            count(|verdict| matches!(verdict, Verdict::NotReproduced)),
            count(|verdict| matches!(verdict, Verdict::CannotBeChecked(_))),
        );
    }
    text + "\n"
}

fn words(verdict: Verdict) -> String {
    match verdict {
        Verdict::Met => "met".to_owned(),
        Verdict::MetWithin(share) => format!("met within {:.0} %", (100.0 * share).ceil()),
        Verdict::NotReproduced => "**not reproduced**".to_owned(),
        Verdict::CannotBeChecked(why) => format!("cannot be checked: {why}"),
    }
}
