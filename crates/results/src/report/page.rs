//! A page: a title, and sections with their contents, as one HTML file that is also well-formed XML.

use std::fmt::Write as _;

use laneweave_study::{Drawn, escaped};

use super::download::{SCRIPT, links};
use super::table::Table;

const STYLE_SHEET: &str = include_str!("style.css");

/// A report as one HTML file.
#[derive(Clone, Debug, PartialEq)]
pub struct Page {
    title: String,
    lead: String,
    sections: Vec<Section>,
}

/// A section of a page.
#[derive(Clone, Debug, PartialEq)]
pub struct Section {
    id: String,
    title: String,
    parts: Vec<Part>,
}

/// A part of a section.
#[derive(Clone, Debug, PartialEq)]
enum Part {
    Text(String),
    Note(String),
    Facts(Vec<(String, String)>),
    Tiles(Vec<Tile>),
    Table(Table),
    Figures(Vec<Figure>),
    Listing(String),
}

/// A key number.
#[derive(Clone, Debug, PartialEq)]
pub struct Tile {
    /// The number with its unit.
    pub value: String,
    /// Its meaning.
    pub name: String,
    /// More about it, such as its interval; may be empty.
    pub more: String,
}

/// A figure with its caption; the page numbers it.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// The drawing for a column, and its data.
    pub drawn: Drawn,
    /// Its contents in a few words.
    pub title: String,
    /// What is counted and how, and the number of values.
    pub caption: String,
}

impl Page {
    /// A page with a title, and a line below it.
    pub fn new(title: impl Into<String>, lead: impl Into<String>) -> Page {
        Page { title: title.into(), lead: lead.into(), sections: Vec::new() }
    }

    /// The same page with one more section.
    #[must_use]
    pub fn section(mut self, section: Section) -> Page {
        self.sections.push(section);
        self
    }

    /// The page as the text of an HTML file.
    pub fn to_html(&self) -> String {
        let (title, lead) = (escaped(&self.title), escaped(&self.lead));
        let mut html = format!(
            "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n\
             <meta name=\"color-scheme\" content=\"light dark\"/>\n\
             <title>{title}</title>\n<style>\n{STYLE_SHEET}</style>\n</head>\n<body>\n\
             <header><h1>{title}</h1>\n<p>{lead}</p></header>\n"
        );
        html += "<nav><ul>";
        for Section { id, title, .. } in &self.sections {
            // Writing to a string never fails.
            let _ = write!(html, "<li><a href=\"#{id}\">{}</a></li>", escaped(title));
        }
        html += "</ul></nav>\n<main>\n";
        let mut figures = 0;
        for section in &self.sections {
            section.write(&mut html, &mut figures);
        }
        html += "</main>\n";
        if figures > 0 {
            let _ = write!(html, "<script>\n{SCRIPT}</script>\n");
        }
        html + "</body>\n</html>\n"
    }
}

impl Section {
    /// An empty section; its id is unique on the page.
    pub fn new(id: impl Into<String>, title: impl Into<String>) -> Section {
        Section { id: id.into(), title: title.into(), parts: Vec::new() }
    }

    /// A paragraph.
    #[must_use]
    pub fn text(self, text: impl Into<String>) -> Section {
        self.with(Part::Text(text.into()))
    }

    /// A paragraph in small print: how something was measured, or why it is missing.
    #[must_use]
    pub fn note(self, text: impl Into<String>) -> Section {
        self.with(Part::Note(text.into()))
    }

    /// Names and their values.
    #[must_use]
    pub fn facts(self, facts: Vec<(String, String)>) -> Section {
        self.with(Part::Facts(facts))
    }

    /// Key numbers.
    #[must_use]
    pub fn tiles(self, tiles: Vec<Tile>) -> Section {
        self.with(Part::Tiles(tiles))
    }

    /// A table.
    #[must_use]
    pub fn table(self, table: Table) -> Section {
        self.with(Part::Table(table))
    }

    /// A table; or, if it has no rows, the given paragraph, if it is not empty.
    #[must_use]
    pub fn table_unless_empty(self, table: Table, otherwise: &str) -> Section {
        match (table.is_empty(), otherwise) {
            (false, _) => self.table(table),
            (true, "") => self,
            (true, otherwise) => self.text(otherwise),
        }
    }

    /// A text of a file, with its lines unchanged.
    #[must_use]
    pub fn listing(self, text: impl Into<String>) -> Section {
        self.with(Part::Listing(text.into()))
    }

    /// Figures side by side, as far as there is space.
    #[must_use]
    pub fn figures(self, figures: Vec<Figure>) -> Section {
        if figures.is_empty() { self } else { self.with(Part::Figures(figures)) }
    }

    fn with(mut self, part: Part) -> Section {
        self.parts.push(part);
        self
    }

    fn write(&self, html: &mut String, figures: &mut usize) {
        let _ = writeln!(html, "<section id=\"{}\">\n<h2>{}</h2>", self.id, escaped(&self.title));
        for part in &self.parts {
            let _ = match part {
                Part::Text(text) => writeln!(html, "<p>{}</p>", escaped(text)),
                Part::Note(text) => writeln!(html, "<p class=\"note\">{}</p>", escaped(text)),
                Part::Facts(facts) => write_facts(html, facts),
                Part::Tiles(tiles) => write_tiles(html, tiles),
                Part::Table(table) => {
                    table.write(html);
                    Ok(())
                }
                Part::Listing(text) => writeln!(html, "<pre>{}</pre>", lines(text)),
                Part::Figures(all) => write_figures(html, all, figures),
            };
        }
        *html += "</section>\n";
    }
}

/// A text with its line breaks.
fn lines(text: &str) -> String {
    text.lines().map(escaped).collect::<Vec<String>>().join("\n")
}

fn write_facts(html: &mut String, facts: &[(String, String)]) -> std::fmt::Result {
    *html += "<dl>\n";
    for (name, value) in facts {
        writeln!(html, "<dt>{}</dt><dd>{}</dd>", escaped(name), escaped(value))?;
    }
    *html += "</dl>\n";
    Ok(())
}

fn write_tiles(html: &mut String, tiles: &[Tile]) -> std::fmt::Result {
    *html += "<div class=\"tiles\">\n";
    for Tile { value, name, more } in tiles {
        let [value, name, more] = [value, name, more].map(|it| escaped(it));
        writeln!(html, "<div><b>{value}</b><span>{name}</span><small>{more}</small></div>")?;
    }
    *html += "</div>\n";
    Ok(())
}

fn write_figures(html: &mut String, figures: &[Figure], number: &mut usize) -> std::fmt::Result {
    *html += "<div class=\"figures\">\n";
    for Figure { drawn, title, caption } in figures {
        *number += 1;
        let (svg, links) = (&drawn.svg, links(*number, title, &drawn.csv));
        let [title, caption] = [title, caption].map(|it| escaped(it));
        write!(
            html,
            "<figure>\n{svg}<figcaption><b>Figure {number}. {title}.</b> {caption}</figcaption>\n{links}</figure>\n"
        )?;
    }
    *html += "</div>\n";
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::table::Align;
    use super::*;

    #[test]
    fn whatever_is_said_cannot_break_the_markup() {
        let mut table = Table::new("a < b", &[("<name>", Align::Words), ("n & m", Align::Numbers)]);
        table.row(["</td>", "1"]);
        let section = Section::new("one", "<h2>")
            .text("x & y")
            .note("<!--")
            .listing("[a]\n  b = \"<\"")
            .facts(vec![("<dt>".into(), "&amp;".into())])
            .tiles(vec![Tile { value: "<1>".into(), name: "&".into(), more: String::new() }])
            .table(table);
        let html = Page::new("<title>", "\u{0}").section(section).to_html();
        for text in [
            "&lt;title&gt;",
            "&lt;h2&gt;",
            "x &amp; y",
            "&lt;!--",
            "&amp;amp;",
            "&lt;/td&gt;",
            "n &amp; m",
            "<pre>[a]\n  b = \"&lt;\"</pre>",
        ] {
            assert!(html.contains(text), "{text}: {html}");
        }
        assert!(!html.contains('\u{0}'));
    }

    #[test]
    fn figures_are_numbered_through_the_page() {
        let drawn = Drawn { svg: "<svg/>".into(), csv: "a\n1\n".into() };
        let figure =
            |title: &str| Figure { drawn: drawn.clone(), title: title.into(), caption: "n = 3".into() };
        let one = Section::new("one", "One").figures(vec![figure("a"), figure("b")]);
        let two = Section::new("two", "Two").figures(vec![]).figures(vec![figure("c")]);
        let html = Page::new("t", "l").section(one).section(two).to_html();
        for text in ["<b>Figure 1. a.</b> n = 3", "<b>Figure 2. b.</b>", "<b>Figure 3. c.</b>"] {
            assert!(html.contains(text), "{text}");
        }
        assert_eq!(html.matches("<div class=\"figures\">").count(), 2);
        assert_eq!(html.matches("charset=utf-8,a%0A1%0A\"").count(), 3);
        assert_eq!(html.matches("<script>").count(), 1);
    }
}
