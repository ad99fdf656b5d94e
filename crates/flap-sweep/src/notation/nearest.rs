//! The known name that a misspelt one is nearest to.

/// Longer names than this, in bytes, are no misspelt ones.
const LONGEST_NAME: usize = 200;

/// Shorter names than this, in bytes, stand at the beginning of too many others.
const SHORTEST_PART: usize = 4;

/// The one of `names` that `name` most likely stands for, if any is close: the first that begins with it, as `lift_mean_mn` for
/// `lift`, the first that contains it as a word, or the one that it is a misspelling of.
pub fn nearest<'n>(name: &str, names: impl IntoIterator<Item = &'n str>) -> Option<&'n str> {
    // The time of a comparison grows with the product of both lengths.
    if name.len() > LONGEST_NAME {
        return None;
    }
    let name = &*name.to_lowercase();
    let names = names.into_iter().filter(|candidate| candidate.len() <= LONGEST_NAME);
    let names: Vec<(String, &str)> = names.map(|candidate| (candidate.to_lowercase(), candidate)).collect();
    let is_word = |(candidate, _): &&(String, &str)| {
        let ends = |text: &str| !text.starts_with(char::is_alphanumeric);
        let begins = |text: &str| !text.ends_with(char::is_alphanumeric);
        let mut places = candidate.match_indices(name);
        places.any(|(at, part)| begins(&candidate[..at]) && ends(&candidate[at + part.len()..]))
    };
    if name.len() >= SHORTEST_PART {
        let begins = names.iter().find(|(candidate, _)| candidate.starts_with(name));
        if let Some((_, candidate)) = begins.or_else(|| names.iter().find(is_word)) {
            return Some(candidate);
        }
    }
    names
        .iter()
        .map(|(lower, candidate)| (strsim::jaro_winkler(name, lower), *candidate))
        .filter(|(likeness, _)| *likeness > 0.8)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, candidate)| candidate)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nearest_names() {
        let names = ["drive_voltage_pp", "drive_frequency", "wing_area"];
        assert_eq!(nearest("drive_voltage", names), Some("drive_voltage_pp"));
        assert_eq!(nearest("WING_AREA", names), Some("wing_area"));
        assert_eq!(nearest("temperature", names), None);
        assert_eq!(nearest(&"wing_area".repeat(30), names), None);
        let long = "wing_area".repeat(30);
        assert_eq!(nearest("wing_area", [&*long]), None);
    }

    #[test]
    fn parts_of_names_come_before_misspellings() {
        let names = ["point", "stroke_pp_deg", "lift_mean_mn", "lift_min_mn", "lift_max_mn", "mean_lift"];
        assert_eq!(nearest("lift", names), Some("lift_mean_mn"));
        assert_eq!(nearest("LIFT_MAX", names), Some("lift_max_mn"));
        assert_eq!(nearest("pp_deg", names), Some("stroke_pp_deg"));
        assert_eq!(nearest("lift", ["xxxxxliftxxxxx"]), None, "a part of a word is no word");
        assert_eq!(nearest("lift_mni_mn", names), Some("lift_min_mn"));
    }
}
