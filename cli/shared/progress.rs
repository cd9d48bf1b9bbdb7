//! Progress on the terminal; silent when standard error is not one.

use indicatif::{ProgressBar, ProgressStyle};

/// A bar over `length` units of work, such as clocks or cases.
pub(crate) fn bar(length: u64, unit: &str) -> ProgressBar {
    let shape =
        format!("{{bar:40}} {{percent:>3}} %  {{human_pos}}/{{human_len}} {unit}  {{eta}} left");
    let style =
        ProgressStyle::with_template(&shape).unwrap_or_else(|_| ProgressStyle::default_bar());
    ProgressBar::new(length).with_style(style)
}
