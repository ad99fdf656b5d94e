//! The known name that a misspelt one is nearest to.

/// Longer names than this, in bytes, are no misspelt ones.
const LONGEST_NAME: usize = 200;

/// The one of `names` that `name` is most likely a misspelling of, if any is close.
pub fn nearest<'n>(name: &str, names: impl IntoIterator<Item = &'n str>) -> Option<&'n str> {
    // The time of a comparison grows with the product of both lengths.
    if name.len() > LONGEST_NAME {
        return None;
    }
    names
        .into_iter()
        .map(|candidate| (strsim::jaro_winkler(&name.to_lowercase(), &candidate.to_lowercase()), candidate))
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
    }
}
