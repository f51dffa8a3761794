//! Configurations of SUMO (`.sumocfg`): which files make a simulation, and its times.

use std::path::{Path, PathBuf};

use laneweave_maps::xml::{ANY, Element, Visitor, XmlError, walk};

/// What a configuration says.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Configuration {
    /// The road network.
    pub(crate) net: Option<PathBuf>,
    /// Files with vehicles, in order.
    pub(crate) routes: Vec<PathBuf>,
    /// Further files, in order.
    pub(crate) additional: Vec<PathBuf>,
    /// When it begins [s].
    pub(crate) begin_s: Option<f64>,
    /// When it ends [s]; without it, it lasts until the last vehicle has arrived.
    pub(crate) end_s: Option<f64>,
    /// Length of a step [s].
    pub(crate) step_s: Option<f64>,
    /// Seed of its random numbers.
    pub(crate) seed: Option<u64>,
    /// Options without a counterpart, with their lines.
    pub(crate) unused: Vec<(String, usize)>,
}

/// Reads a configuration. Its relative paths start in `folder`.
pub(crate) fn read(bytes: &[u8], folder: &Path) -> Result<Configuration, XmlError> {
    let mut reader = Reader { folder, read: Configuration::default() };
    walk(bytes, ANY, &mut reader)?;
    Ok(reader.read)
}

struct Reader<'a> {
    folder: &'a Path,
    read: Configuration,
}

impl Visitor for Reader<'_> {
    fn open(&mut self, path: &str, element: &Element) -> Result<(), XmlError> {
        let [value] = element.values(["value"])?;
        let Some(value) = value else { return Ok(()) };
        let files = || value.split(',').map(|it| self.folder.join(it.trim())).collect::<Vec<_>>();
        let time = || seconds(&value);
        match element.name {
            "net-file" | "net" | "n" => self.read.net = files().pop(),
            "route-files" | "routes" | "r" => self.read.routes = files(),
            "additional-files" | "additional" | "a" => self.read.additional = files(),
            "begin" | "b" => self.read.begin_s = time(),
            "end" | "e" => self.read.end_s = time().filter(|it| *it >= 0.0),
            "step-length" => self.read.step_s = time(),
            "seed" => self.read.seed = value.trim().parse().ok(),
            // What it writes, prints and shows.
            _ if ["output/", "report/", "gui_only/"].iter().any(|it| path.starts_with(it)) => {}
            other => self.read.unused.push((other.to_owned(), element.line)),
        }
        Ok(())
    }

    fn close(&mut self, _: &str, _: &str) {}
}

/// A time as SUMO writes it [s]: seconds, or `[days:]hours:minutes:seconds`.
pub(super) fn seconds(text: &str) -> Option<f64> {
    let text = text.trim();
    let (sign, parts) = text.strip_prefix('-').map_or((1.0, text), |it| (-1.0, it));
    const UNITS: [f64; 4] = [86_400.0, 3600.0, 60.0, 1.0];
    let parts: Vec<f64> = parts.split(':').map(|it| it.parse().ok()).collect::<Option<_>>()?;
    let units = match parts.len() {
        1 => &UNITS[3..],
        3 => &UNITS[1..],
        4 => &UNITS[..],
        _ => return None,
    };
    let time: f64 = parts.iter().zip(units).map(|(part, unit)| part * unit).sum();
    time.is_finite().then_some(sign * time)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_configuration_names_files_and_times() {
        let text = r#"<configuration>
            <input><net-file value="a.net.xml"/><route-files value="b.rou.xml, c.rou.xml"/></input>
            <time><begin value="1:00:00"/><end value="7200"/><step-length value="0.1"/></time>
            <processing><time-to-teleport value="-1"/></processing>
            <output><tripinfo-output value="t.xml"/></output>
        </configuration>"#;
        let read = read(text.as_bytes(), Path::new("x")).expect("it is sound");
        assert_eq!(read.net, Some("x/a.net.xml".into()));
        assert_eq!(read.routes, [PathBuf::from("x/b.rou.xml"), "x/c.rou.xml".into()]);
        assert_eq!((read.begin_s, read.end_s, read.step_s), (Some(3600.0), Some(7200.0), Some(0.1)));
        assert_eq!(read.unused, [("time-to-teleport".to_owned(), 4)]);
    }

    #[test]
    fn times_are_seconds_or_clock_times() {
        let found = ["12.5", "-1", "0:01:30", "1:00:00:00", "1:2", "x", "inf"].map(seconds);
        let expected = [Some(12.5), Some(-1.0), Some(90.0), Some(86_400.0), None, None, None];
        assert_eq!(found, expected);
    }
}
