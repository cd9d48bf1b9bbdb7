//! What the browser is given: one page, its style, its scripts, its words.

/// A file of the pages.
pub(crate) struct Page {
    pub(crate) kind: &'static str,
    pub(crate) text: &'static str,
}

const HTML: &str = "text/html; charset=utf-8";
const STYLE: &str = "text/css; charset=utf-8";
const SCRIPT: &str = "text/javascript; charset=utf-8";
const TABLE: &str = "text/tab-separated-values; charset=utf-8";

macro_rules! files {
    ($($kind:ident $name:literal)+) => {
        /// Every file, with what it is.
        pub(crate) const FILES: &[(&str, Page)] =
            &[$(($name, Page { kind: $kind, text: include_str!(concat!("../pages/", $name)) }),)+];
    };
}

files! {
    HTML "index.html"
    STYLE "style.css"
    TABLE "words.tsv"
    SCRIPT "api.js"
    SCRIPT "device.js"
    SCRIPT "doubts.js"
    SCRIPT "effects.js"
    SCRIPT "fall.js"
    SCRIPT "fails.js"
    SCRIPT "form.js"
    SCRIPT "jobs.js"
    SCRIPT "machine.js"
    SCRIPT "main.js"
    SCRIPT "make.js"
    SCRIPT "measurement.js"
    SCRIPT "plot.js"
    SCRIPT "runs.js"
    SCRIPT "said.js"
    SCRIPT "sketch.js"
    SCRIPT "thin.js"
    SCRIPT "train.js"
    SCRIPT "waves.js"
    SCRIPT "words.js"
    SCRIPT "uplot/uPlot.iife.min.js"
    STYLE "uplot/uPlot.min.css"
}

/// The file of this name; none stands for the page itself.
pub(crate) fn page(name: &str) -> Option<&'static Page> {
    let name = if name.is_empty() { "index.html" } else { name };
    FILES.iter().find(|(known, _)| *known == name).map(|(_, page)| page)
}
