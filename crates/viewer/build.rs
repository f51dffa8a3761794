//! Puts the built page into the crate. The page is optional: without Node the crate builds, and says that it has none.

use std::path::Path;
use std::{env, fs, io};

/// The files of the page.
const FILES: [&str; 3] = ["index.html", "page.js", "page.css"];

fn main() -> io::Result<()> {
    let source = Path::new("web/dist");
    let target = env::var_os("OUT_DIR").ok_or_else(|| io::Error::other("OUT_DIR is not set"))?;
    // A folder that does not exist cannot be watched: the one around it is.
    for watched in ["build.rs", "web", "web/dist"] {
        if Path::new(watched).exists() {
            println!("cargo::rerun-if-changed={watched}");
        }
    }
    let is_built = FILES.iter().all(|it| source.join(it).is_file());
    for file in FILES {
        let content = if is_built { fs::read(source.join(file))? } else { Vec::new() };
        fs::write(Path::new(&target).join(file), content)?;
    }
    Ok(())
}
