//! The use of a figure, and the sizes of its parts.

/// The use of a figure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sheet {
    /// A file of its own: with a title, its legend beside the plot.
    Page,
    /// A column of an HTML document: narrow, without a title, its legend above the plot; a caption describes it.
    Column,
}

/// Sizes on a sheet [px].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Layout {
    /// Space to the left of the plot, for the texts of its axis.
    pub(super) left: f64,
    /// Space above the plot.
    pub(super) top: f64,
    /// Size of the plot; a column as a whole is as wide as the plot and the space to its left.
    pub(super) plot: [f64; 2],
    /// Space below the plot.
    pub(super) foot: f64,
    /// Base line of the upright label of the vertical axis.
    pub(super) upright: f64,
    /// From the plot to the middle lines of the texts below it: ticks, label.
    pub(super) below: [f64; 2],
    /// Size of texts.
    pub(super) text: f64,
    /// Maximum of steps between ticks, horizontally and vertically.
    pub(super) steps: [f64; 2],
}

impl Sheet {
    pub(super) const fn layout(self) -> Layout {
        match self {
            Sheet::Page => Layout {
                left: 84.0,
                top: 56.0,
                plot: [720.0, 440.0],
                foot: 64.0,
                upright: 24.0,
                below: [18.0, 44.0],
                text: 14.0,
                steps: [10.0, 10.0],
            },
            Sheet::Column => Layout {
                left: 62.0,
                top: 14.0,
                plot: [404.0, 230.0],
                foot: 46.0,
                upright: 14.0,
                below: [14.0, 35.0],
                text: 13.0,
                steps: [7.0, 6.0],
            },
        }
    }
}
