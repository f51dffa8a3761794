//! How much is tested.

/// How much is tested.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Size {
    /// As much as every run of the tests can afford.
    Usual,
    /// All of it: `LANEWEAVE_TESTS=full`.
    Full,
}

impl Size {
    /// The first value in usual tests, the other one in full tests.
    pub fn pick<T>(self, usual: T, full: T) -> T {
        match self {
            Size::Usual => usual,
            Size::Full => full,
        }
    }
}

/// How much is tested, as the environment says.
///
/// # Panics
///
/// If `LANEWEAVE_TESTS` is something else than `full`.
#[track_caller]
pub fn size() -> Size {
    let asked = std::env::var_os("LANEWEAVE_TESTS").filter(|it| !it.is_empty());
    match asked.as_deref().map(|it| it.to_str()) {
        None => Size::Usual,
        Some(Some("full")) => Size::Full,
        Some(_) => panic!("LANEWEAVE_TESTS is {asked:?}; set it to full, or not at all"),
    }
}
