//! Tables of a page.

use std::fmt::Write as _;

use laneweave_study::escaped;

/// The alignment of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Align {
    /// Words: on the left.
    Words,
    /// Numbers: on the right.
    Numbers,
}

/// A table with a head.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    caption: String,
    columns: Vec<(String, Align)>,
    rows: Vec<Vec<String>>,
}

impl Table {
    /// An empty table with its caption and its columns.
    pub fn new(caption: impl Into<String>, columns: &[(&str, Align)]) -> Table {
        let columns = columns.iter().map(|(name, align)| ((*name).into(), *align)).collect();
        Table { caption: caption.into(), columns, rows: Vec::new() }
    }

    /// Adds a row, a text for each column.
    pub fn row<T: Into<String>>(&mut self, cells: impl IntoIterator<Item = T>) {
        self.rows.push(cells.into_iter().map(Into::into).collect());
    }

    /// Whether there are no rows.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// The name of a column, as an attribute holds it.
    fn name(&self, column: usize) -> String {
        self.columns.get(column).map_or(String::new(), |(name, _)| escaped(name).replace('"', "&quot;"))
    }

    pub(super) fn write(&self, html: &mut String) {
        let class = |column: usize| match self.columns.get(column) {
            Some((_, Align::Numbers)) => " class=\"number\"",
            _ => "",
        };
        *html += "<div class=\"table\"><table>\n";
        if !self.caption.is_empty() {
            // Writing to a string never fails.
            let _ = writeln!(html, "<caption>{}</caption>", escaped(&self.caption));
        }
        *html += "<thead><tr>";
        for (column, (name, _)) in self.columns.iter().enumerate() {
            let _ = write!(html, "<th scope=\"col\"{}>{}</th>", class(column), escaped(name));
        }
        *html += "</tr></thead>\n<tbody>\n";
        for row in &self.rows {
            *html += "<tr>";
            for (column, cell) in row.iter().enumerate() {
                let (class, cell, name) = (class(column), escaped(cell), self.name(column));
                let (tag, scope) = if column == 0 { ("th", " scope=\"row\"") } else { ("td", "") };
                // On a narrow screen the cells stand one below the other, each with the name of its column.
                let _ = write!(html, "<{tag}{scope} data-name=\"{name}\"{class}>{cell}</{tag}>");
            }
            *html += "</tr>\n";
        }
        *html += "</tbody></table></div>\n";
    }
}
