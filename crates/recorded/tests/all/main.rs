//! All integration tests of the crate, in one program: it is linked once, and its tests share the cores.

mod damaged_recordings;
mod drivers;
mod recorded_scenes;
mod replay;
