//! Drawn pictures, and their contents.

use super::count;
use crate::support::Folder;

/// A picture, and the messages about it.
pub(super) struct Drawn {
    pub(super) svg: String,
    pub(super) said: String,
}

/// Draws an SVG picture.
pub(super) fn drawn(folder: &Folder, arguments: &str) -> Drawn {
    let ended = folder.flap(&format!("plot {arguments} --force --out out.svg"));
    assert_eq!((ended.code, ended.stdout.as_str()), (0, ""), "{arguments}\n{}", ended.stderr);
    Drawn { svg: folder.read("out.svg"), said: ended.stderr }
}

impl Drawn {
    /// Texts of the SVG.
    pub(super) fn texts(&self) -> Vec<String> {
        let parts = self.svg.split("<text").skip(1);
        parts.map(|part| part.split_once('>').unwrap().1.split_once('<').unwrap().0.to_owned()).collect()
    }

    /// Fails the test unless these are among the texts.
    #[track_caller]
    pub(super) fn has(&self, wanted: &[&str]) -> &Drawn {
        let texts = self.texts();
        for text in wanted {
            assert!(texts.iter().any(|found| found == text), "{text} is not among {texts:?}");
        }
        self
    }

    /// Fails the test unless the messages contain `text`.
    #[track_caller]
    pub(super) fn says(&self, text: &str) -> &Drawn {
        assert!(self.said.contains(text), "{text} is not in {}", self.said);
        self
    }

    /// Fails the test unless the SVG contains `part` exactly `times` times.
    #[track_caller]
    pub(super) fn counts(&self, part: &str, times: usize) -> &Drawn {
        assert_eq!(count(&self.svg, part), times, "{part} in {}", self.svg);
        self
    }
}
