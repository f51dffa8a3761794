//! The page: built once from `web/`, and embedded.

/// The built page.
#[derive(Clone, Copy, Debug)]
pub struct Page {
    /// `index.html`.
    pub html: &'static str,
    /// `page.js`.
    pub script: &'static str,
    /// `page.css`.
    pub style: &'static str,
}

impl Page {
    /// The command that builds it, from the root of the repository. After it the program has to be built again.
    pub const COMMAND: &'static str = "npm run page --prefix crates/viewer/web";

    /// The page, if it was there when this program was built.
    pub fn embedded() -> Option<Page> {
        let page = Page {
            html: include_str!(concat!(env!("OUT_DIR"), "/index.html")),
            script: include_str!(concat!(env!("OUT_DIR"), "/page.js")),
            style: include_str!(concat!(env!("OUT_DIR"), "/page.css")),
        };
        (!page.html.is_empty()).then_some(page)
    }
}
