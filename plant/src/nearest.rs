//! What a misspelt name was meant to be.

/// The name nearest to what was written, if one is near: one slip in three letters.
#[must_use]
pub fn nearest<'a>(found: &str, names: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let plain = |text: &str| text.to_lowercase().replace(['-', ' '], "_");
    let found = plain(found);
    names
        .into_iter()
        .map(|name| (strsim::osa_distance(&found, &plain(name)), name))
        .filter(|(slips, name)| 3 * slips <= found.chars().count().max(name.chars().count()))
        .min_by_key(|(slips, _)| *slips)
        .map(|(_, name)| name)
}

/// `one of a, b, c`, the nearest to what was found named first.
#[must_use]
pub fn one_of(found: &str, names: &[&str]) -> String {
    let all = names.join(", ");
    match nearest(found, names.iter().copied()) {
        Some(near) if 1 < names.len() => format!("`{near}`, or another one of {all}"),
        _ => format!("one of {all}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_of_the_finger_are_understood() {
        let names = ["lead", "length", "expansion"];
        for (found, expected) in [
            ("leda", Some("lead")),
            ("lenght", Some("length")),
            ("Lead", Some("lead")),
            ("speed", None),
        ] {
            assert_eq!(nearest(found, names), expected, "{found}");
        }
        assert_eq!(nearest("screw_periodic", ["screw-periodic"]), Some("screw-periodic"));
    }
}
