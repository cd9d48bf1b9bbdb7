//! The machines there are to begin with.

/// A machine file with data for it.
#[derive(Debug)]
pub(crate) struct Template {
    pub(crate) name: &'static str,
    /// Whose machine it is.
    pub(crate) about: &'static str,
    /// Sections that say what it has.
    pub(crate) has: &'static str,
    /// True when it has the correction device, so that `sim` runs.
    pub(crate) simulates: bool,
    pub(crate) machine: &'static str,
    pub(crate) data: &'static str,
}

macro_rules! template {
    ($name:literal, $about:literal, $has:literal, $simulates:literal) => {
        Template {
            name: $name,
            about: $about,
            has: $has,
            simulates: $simulates,
            machine: include_str!(concat!("../../templates/", $name, ".toml")),
            data: include_str!(concat!("../../templates/", $name, ".csv")),
        }
    };
}

pub(crate) const TEMPLATES: &[Template] = &[
    template!(
        "lead-screw-grinder",
        "a grinder with the correction device",
        "workpiece, screw, gears, grating, laser, dividers, drive",
        true
    ),
    template!("screw-axis", "an axis of a lathe or mill", "screw, gears", false),
    template!("laser-axis", "a linear axis measured by a laser", "screw, laser", false),
    template!("rotary-table", "a rotary table or worm wheel", "gears, grating", false),
    template!("telescope", "a telescope's worm drive", "gears", false),
    template!("robot-joint", "a joint with a strain wave gear", "gears, grating", false),
    template!("gear-tester", "two wheels on a single-flank tester", "gears with teeth", false),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_workbench_has_words_for_each() {
        for template in TEMPLATES {
            let key = format!("template.{}", template.name);
            let words = helixlock_workbench::words::all().find(|words| words.key == key);
            assert_eq!(words.map(|words| words.english), Some(template.about), "{key}");
        }
    }
}
