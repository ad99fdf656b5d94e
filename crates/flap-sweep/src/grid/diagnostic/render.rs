//! Mistakes in grid files, shown with the lines they are in.

use annotate_snippets::{AnnotationKind, Element, Group, Level, Renderer, Snippet};

use super::mistake::Diagnostic;
use super::mistakes::Mistakes;

/// The text of the `mistakes` that are shown, with the lines of the grid file that they are about, and the number of the
/// others; with colours if `styled`.
pub fn render(mistakes: &Mistakes, styled: bool) -> String {
    let renderer = if styled { Renderer::styled() } else { Renderer::plain() };
    let text: String =
        mistakes.iter().map(|diagnostic| renderer.render(&[group(diagnostic)]) + "\n\n").collect();
    let name = mistakes.first().map_or("", |diagnostic| diagnostic.source.name.as_str());
    let more = if mistakes.more() > 0 { format!("and {} more\n\n", mistakes.more()) } else { String::new() };
    let count = match mistakes.count() {
        1 => "1 mistake".to_owned(),
        many => format!("{many} mistakes"),
    };
    format!("{text}{more}{name}: {count}, nothing was run")
}

fn group(diagnostic: &Diagnostic) -> Group<'_> {
    let label = Some(diagnostic.label.as_str()).filter(|label| !label.is_empty());
    let primary = AnnotationKind::Primary.span(diagnostic.span.clone()).label(label);
    let related = diagnostic
        .related
        .iter()
        .map(|related| AnnotationKind::Context.span(related.span.clone()).label(related.label.as_str()));
    let snippet = Snippet::source(diagnostic.source.text.as_str())
        .path(diagnostic.source.name.as_str())
        .annotation(primary)
        .annotations(related);
    let notes = diagnostic.notes.iter().map(|note| Element::from(Level::NOTE.message(note.as_str())));
    let help = diagnostic.help.iter().map(|help| Element::from(Level::HELP.message(help.as_str())));
    Level::ERROR.primary_title(diagnostic.message.as_str()).element(snippet).elements(notes.chain(help))
}
