//! The files of a fit: the fitted styles, the report and its figures.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use laneweave_results::folder::{FIT, FIT_REPORT};
use laneweave_results::output::{json, write_whole};
use laneweave_scenario::Fault;

use super::{FIGURES, FITTED, FitReport, MOST_CLASSES, figures, page};

impl FitReport {
    /// Writes all files of the fit to these `recordings` into the folder `out`, in place of those of an earlier fit,
    /// and returns the paths of the styles. The report tells the `command`.
    ///
    /// # Errors
    /// If a file cannot be written.
    pub fn write(&self, out: &Path, recordings: &[PathBuf], command: &str) -> Result<Vec<PathBuf>, Fault> {
        std::fs::create_dir_all(out).map_err(|error| Fault::refused(out, "created", &error))?;
        remove_earlier(out)?;
        let paths: Vec<PathBuf> = self.styles.iter().map(|it| style_path(out, &it.name)).collect();
        for (style, path) in self.styles.iter().zip(&paths) {
            write_whole(path, &style.text)?;
        }
        let names: Vec<String> = recordings.iter().map(|it| it.display().to_string()).collect();
        write_whole(&out.join(FIT_REPORT), &page(self, &names.join(", "), command).to_html())?;
        figures(self).iter().try_for_each(|(name, svg)| write_whole(&out.join(name), svg))?;
        write_whole(&out.join(FIT), &json(self)?)?;
        Ok(paths)
    }
}

fn style_path(out: &Path, name: &str) -> PathBuf {
    out.join(format!("{name}.toml"))
}

/// Removes what an earlier fit left: it may have had more classes.
fn remove_earlier(out: &Path) -> Result<(), Fault> {
    let numbered = (1..=MOST_CLASSES).map(|it| format!("{FITTED}-{it}"));
    let styles = numbered.chain([FITTED.to_owned()]).map(|it| style_path(out, &it));
    let others = [FIT, FIT_REPORT].into_iter().chain(FIGURES).map(|it| out.join(it));
    for path in styles.chain(others) {
        match std::fs::remove_file(&path) {
            Err(error) if error.kind() != ErrorKind::NotFound => {
                return Err(Fault::refused(&path, "removed", &error));
            }
            _ => {}
        }
    }
    Ok(())
}
