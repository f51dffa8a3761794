//! All integration tests of the crate, in one program: it is linked once, and its tests share the cores.

mod hands;
mod pictures;
mod replays;
mod rerun;
mod served;
mod stage;
mod twins;
