//! Figures as SVG text: the same data give the same text, on every system.

mod axes;
mod bars;
mod colours;
mod distribution;
mod drawing;
mod drawn;
mod estimates;
mod lines;
mod map;
mod over_time;
mod plan;
mod rate_density;
mod scatter;
mod series;
mod sheet;
mod time_space;

pub use bars::{BarRow, bars};
pub use distribution::{Distributed, Upwards, distribution};
pub use drawing::{escaped, text_width};
pub use drawn::Drawn;
pub use estimates::estimates;
pub use map::{Area, MarkAt, Marks, OnTop, Shading, map};
pub use over_time::{TimeLine, over_time};
pub use plan::{Bounds, Panel, Space, panels};
pub use rate_density::rate_density;
pub use scatter::{Scattered, scatter};
pub use series::Estimated;
pub use sheet::Sheet;
pub use time_space::{LaneInTime, time_space};
