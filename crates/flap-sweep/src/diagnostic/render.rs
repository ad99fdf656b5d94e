//! Mistakes in grid files, shown with the lines they are in.

use annotate_snippets::{AnnotationKind, Element, Group, Level, Renderer, Snippet};

use super::Diagnostic;

/// The text of all `diagnostics`, with the lines of the grid file that they are about, and with colours if `styled`.
pub fn render(diagnostics: &[Diagnostic], styled: bool) -> String {
    let renderer = if styled { Renderer::styled() } else { Renderer::plain() };
    let text: String =
        diagnostics.iter().map(|diagnostic| renderer.render(&[group(diagnostic)]) + "\n\n").collect();
    let name = diagnostics.first().map_or("", |diagnostic| diagnostic.source.name.as_str());
    let mistakes = match diagnostics.len() {
        1 => "1 mistake".to_owned(),
        many => format!("{many} mistakes"),
    };
    text + name + ": " + &mistakes + ", nothing was run"
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
