//! What users do is part of the run: it stands in the table `commands`, and is repeated from there bit for bit.

mod external;
mod files;
mod obstacles;
mod repeated;
mod runs;
mod user;
