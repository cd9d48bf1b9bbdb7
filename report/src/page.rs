//! One self-contained HTML page: pictures first, then the numbers. It needs no network.

use std::fmt::Write;

use crate::markup::{escaped, translated};
use crate::table::Table;

/// A page; a browser shows it from a file, a printer prints it.
#[derive(Clone, Debug, PartialEq)]
pub struct Page {
    /// Title of the page.
    pub title: String,
    /// What the reader has to know first, in a sentence or two.
    pub summary: String,
    /// What follows, from top to bottom.
    pub parts: Vec<Part>,
}

/// A piece of a page.
#[derive(Clone, Debug, PartialEq)]
pub enum Part {
    /// A heading.
    Heading(String),
    /// A paragraph.
    Text(String),
    /// A few numbers set large, each with what it is: `("0.31 µm", "error after correction")`.
    Numbers(Vec<(String, String)>),
    /// SVG from a plot or a waveform, with what it shows.
    Picture {
        /// The SVG text, put in as it stands.
        svg: String,
        /// What to see in it.
        caption: String,
    },
    /// Names with what belongs to them, or with room to write it by hand: `("Date", "")`.
    Fields(Vec<(String, String)>),
    /// A table.
    Table(Table),
    /// Something the reader must not overlook.
    Note(String),
    /// Text with its line breaks, such as a file.
    Listing(String),
}

const STYLE: &str = include_str!("page.css");

impl Page {
    /// The page as HTML; the same page gives the same bytes.
    #[must_use]
    pub fn html(&self) -> String {
        self.tagged("en")
    }

    /// The page in another language: its tag, as in `zh`, and what each English text is there.
    ///
    /// Listings and what stands in fields are their writers' own, and stay.
    #[must_use]
    pub fn html_in(&self, language: &str, say: impl Fn(&str) -> String) -> String {
        let parts = self.parts.iter().map(|part| part.said(&say)).collect();
        let said = Self { title: say(&self.title), summary: say(&self.summary), parts };
        said.tagged(language)
    }

    fn tagged(&self, language: &str) -> String {
        let title = escaped(&self.title);
        let mut html = format!(
            "<!DOCTYPE html>\n<html lang=\"{language}\">\n<head>\n<meta charset=\"utf-8\">\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
             <title>{title}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n<main>\n\
             <h1>{title}</h1>\n"
        );
        if !self.summary.is_empty() {
            let _ = writeln!(html, "<p class=\"summary\">{}</p>", escaped(&self.summary));
        }
        for part in &self.parts {
            push_part(&mut html, part);
        }
        html.push_str("</main>\n</body>\n</html>\n");
        html
    }
}

impl Part {
    fn said(&self, say: &impl Fn(&str) -> String) -> Self {
        match self {
            Self::Heading(text) => Self::Heading(say(text)),
            Self::Text(text) => Self::Text(say(text)),
            Self::Numbers(numbers) => {
                let both = |(value, meaning): &(String, String)| (say(value), say(meaning));
                Self::Numbers(numbers.iter().map(both).collect())
            }
            Self::Picture { svg, caption } => {
                Self::Picture { svg: translated(svg, say), caption: say(caption) }
            }
            Self::Fields(fields) => {
                let name = |(name, value): &(String, String)| (say(name), value.clone());
                Self::Fields(fields.iter().map(name).collect())
            }
            Self::Table(table) => Self::Table(table.said(say)),
            Self::Note(text) => Self::Note(say(text)),
            Self::Listing(text) => Self::Listing(text.clone()),
        }
    }
}

fn push_part(html: &mut String, part: &Part) {
    // Writing to a string cannot fail.
    let _ = match part {
        Part::Heading(text) => writeln!(html, "<h2>{}</h2>", escaped(text)),
        Part::Text(text) => writeln!(html, "<p>{}</p>", escaped(text)),
        Part::Numbers(numbers) => return push_numbers(html, numbers),
        Part::Fields(fields) => return push_fields(html, fields),
        Part::Picture { svg, caption } => {
            let caption = escaped(caption);
            writeln!(html, "<figure>\n{svg}<figcaption>{caption}</figcaption>\n</figure>")
        }
        Part::Table(table) => writeln!(html, "<div class=\"table\">{}</div>", table.html()),
        Part::Note(text) => writeln!(html, "<p class=\"note\">{}</p>", escaped(text)),
        Part::Listing(text) => writeln!(html, "<pre>{}</pre>", escaped(text)),
    };
}

fn push_numbers(html: &mut String, numbers: &[(String, String)]) {
    html.push_str("<dl class=\"numbers\">\n");
    for (value, meaning) in numbers {
        let (value, meaning) = (escaped(value), escaped(meaning));
        let _ = writeln!(html, "<div><dd>{value}</dd><dt>{meaning}</dt></div>");
    }
    html.push_str("</dl>\n");
}

fn push_fields(html: &mut String, fields: &[(String, String)]) {
    html.push_str("<dl class=\"fields\">\n");
    for (name, value) in fields {
        let (name, value) = (escaped(name), escaped(value));
        let _ = writeln!(html, "<div><dt>{name}</dt><dd>{value}</dd></div>");
    }
    html.push_str("</dl>\n");
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_page_stands_alone_and_is_the_same_twice() {
        let page = Page {
            title: "Error & correction".into(),
            summary: "Within 1 µm".into(),
            parts: vec![
                Part::Numbers(vec![("0.31 µm".into(), "after".into())]),
                Part::Picture { svg: "<svg></svg>".into(), caption: "the error".into() },
                Part::Note("slew limit <reached>".into()),
                Part::Fields(vec![("Signature".into(), String::new())]),
            ],
        };
        let html = page.html();
        assert_eq!(html, page.html());
        assert!(html.contains("<title>Error &amp; correction</title>"));
        assert!(html.contains("<dd>0.31 µm</dd><dt>after</dt>"));
        assert!(html.contains("slew limit &lt;reached&gt;"));
        assert!(html.contains("<dt>Signature</dt><dd></dd>"));
        assert!(html.starts_with("<!DOCTYPE html>\n<html lang=\"en\">"));
        for outside in ["http:", "https:", "src=", "href=", "@import", "url("] {
            assert!(!html.contains(outside), "{outside}");
        }
    }

    #[test]
    fn another_language_says_all_texts_but_listings_and_what_stands_in_fields() {
        let mut table = Table::new(["a"]);
        table.row(["a", "1"]);
        let page = Page {
            title: "a".into(),
            summary: "a".into(),
            parts: vec![
                Part::Heading("a".into()),
                Part::Text("a".into()),
                Part::Numbers(vec![("a".into(), "a".into())]),
                Part::Picture { svg: "<svg><text>a</text></svg>".into(), caption: "a".into() },
                Part::Table(table),
                Part::Note("a".into()),
                Part::Fields(vec![("a".into(), "b".into())]),
                Part::Listing("b".into()),
            ],
        };
        let said = page.html_in("zh", |text| text.replace('a', "甲").replace('b', "乙"));
        let own = page.html().replace("lang=\"en\"", "lang=\"zh\"");
        assert_eq!(said, own.replace(">a<", ">甲<"));
        assert_eq!(said.matches('甲').count(), 13);
    }
}
