//! Downloads of figures: the drawing, which a script of the page saves, and its data, which stand in the link.

use laneweave_study::escaped;

/// Saves the drawing of a figure, in colours for white paper. It holds neither "<" nor "&", so that the page is
/// well-formed XML, too.
pub(super) const SCRIPT: &str = include_str!("download.js");

/// The links of a figure.
pub(super) fn links(number: usize, title: &str, csv: &str) -> String {
    let name = file_name(number, title);
    let what = escaped(title).replace('"', "&quot;");
    format!(
        "<p class=\"downloads\"><button type=\"button\" hidden=\"hidden\" data-file=\"{name}.svg\" \
         aria-label=\"Download figure {number}, {what}, as SVG\">Figure (SVG)</button> \
         <a download=\"{name}.csv\" href=\"data:text/csv;charset=utf-8,{}\" aria-label=\"Download the data of figure \
         {number}, {what}, as CSV\">Data (CSV)</a></p>\n",
        percent_encoded(csv)
    )
}

/// A file's name for a figure, such as `figure_03_mean_speed`.
fn file_name(number: usize, title: &str) -> String {
    /// Longer titles are cut.
    const LONGEST: usize = 48;
    let words = title.split(|it: char| !it.is_ascii_alphanumeric()).filter(|it| !it.is_empty());
    let name: String = words.flat_map(|it| ["_", it]).collect();
    let mut name = format!("figure_{number:02}{}", name.to_ascii_lowercase());
    name.truncate(LONGEST);
    name
}

/// A text as a part of a URL.
fn percent_encoded(text: &str) -> String {
    const PLAIN: &[u8] = b"-_.~,:;/()*=+";
    let mut encoded = String::with_capacity(text.len() + text.len() / 8);
    for byte in text.bytes() {
        if byte.is_ascii_alphanumeric() || PLAIN.contains(&byte) {
            encoded.push(char::from(byte));
        } else {
            encoded += &format!("%{byte:02X}");
        }
    }
    encoded
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn data_stand_in_a_link_so_that_they_can_be_read_again() {
        let links = links(3, "Flow & \"density\"", "a [m/s²],b\n\"<1>\",2\n");
        let data = "href=\"data:text/csv;charset=utf-8,a%20%5Bm/s%C2%B2%5D,b%0A%22%3C1%3E%22,2%0A\"";
        assert!(links.contains(data), "{links}");
        assert!(links.contains("download=\"figure_03_flow_density.csv\""), "{links}");
        assert!(links.contains("data-file=\"figure_03_flow_density.svg\""), "{links}");
        assert!(links.contains("figure 3, Flow &amp; &quot;density&quot;, as SVG"), "{links}");
    }

    #[test]
    fn the_script_cannot_break_the_markup() {
        assert!(!SCRIPT.contains(['<', '&']));
    }
}
