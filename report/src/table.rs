//! Rows and columns, as HTML.

use std::fmt::Write;

use crate::markup::escaped;

/// A table with a header; cells are text that is ready to be read.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Table {
    /// Names of the columns.
    pub header: Vec<String>,
    /// Rows of as many cells.
    pub rows: Vec<Vec<String>>,
}

impl Table {
    /// A table without rows yet.
    pub fn new<Name: Into<String>>(header: impl IntoIterator<Item = Name>) -> Self {
        Self { header: header.into_iter().map(Into::into).collect(), rows: Vec::new() }
    }

    /// Adds a row.
    pub fn row<Cell: Into<String>>(&mut self, cells: impl IntoIterator<Item = Cell>) -> &mut Self {
        self.rows.push(cells.into_iter().map(Into::into).collect());
        self
    }

    /// The table without the columns in which no row says anything.
    #[must_use]
    pub fn without_empty_columns(mut self) -> Self {
        let says = |column: usize| {
            self.rows.iter().any(|row| row.get(column).is_some_and(|cell| !cell.is_empty()))
        };
        let kept: Vec<bool> = (0..self.header.len()).map(says).collect();
        let keep = |cells: &mut Vec<String>| {
            let mut kept = kept.iter();
            cells.retain(|_| kept.next() == Some(&true));
        };
        keep(&mut self.header);
        self.rows.iter_mut().for_each(keep);
        self
    }

    /// The table with every cell said anew.
    pub(crate) fn said(&self, say: &impl Fn(&str) -> String) -> Self {
        let all = |cells: &Vec<String>| cells.iter().map(|cell| say(cell)).collect();
        Self { header: all(&self.header), rows: self.rows.iter().map(all).collect() }
    }

    /// The table as HTML; columns of numbers are set to the right.
    #[must_use]
    pub fn html(&self) -> String {
        let numeric: Vec<bool> =
            (0..self.header.len()).map(|column| self.is_numeric(column)).collect();
        let mut html = String::from("<table>\n<thead>");
        push_row(&mut html, &self.header, "th", &numeric);
        html.push_str("</thead>\n<tbody>\n");
        for row in &self.rows {
            push_row(&mut html, row, "td", &numeric);
        }
        html.push_str("</tbody>\n</table>\n");
        html
    }

    fn is_numeric(&self, column: usize) -> bool {
        let mut cells =
            self.rows.iter().filter_map(|row| row.get(column)).filter(|c| !c.is_empty());
        let number = |cell: &String| {
            cell.trim_start_matches(['+', '-', '\u{2212}', '±'])
                .starts_with(|first: char| first.is_ascii_digit())
        };
        cells.clone().next().is_some() && cells.all(number)
    }
}

fn push_row(html: &mut String, cells: &[String], tag: &str, numeric: &[bool]) {
    html.push_str("<tr>");
    for (index, cell) in cells.iter().enumerate() {
        let class = if numeric.get(index) == Some(&true) { " class=\"number\"" } else { "" };
        let _ = write!(html, "<{tag}{class}>{}</{tag}>", escaped(cell));
    }
    html.push_str("</tr>\n");
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_stand_to_the_right_and_markup_is_text() {
        let mut table = Table::new(["effect", "rms in µm"]);
        table.row(["a<b", "0.06"]).row(["abbe", "−1.2"]);
        let html = table.html();
        assert!(html.contains("<td>a&lt;b</td><td class=\"number\">0.06</td>"), "{html}");
        assert!(html.contains("<th class=\"number\">rms in µm</th>"), "{html}");
    }

    #[test]
    fn columns_that_say_nothing_are_left_out() {
        let mut table = Table::new(["a", "b", "c"]);
        table.row(["1", "", "x"]).row(["2", "", ""]);
        let table = table.without_empty_columns();
        assert_eq!(table.header, ["a", "c"]);
        assert_eq!(table.rows, [["1", "x"], ["2", ""]]);
    }
}
