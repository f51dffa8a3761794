//! A run and its results in numbers.

mod about;
mod ending;
mod first_incident;
mod provenance;
mod queues;
mod short_trips;
mod summary;

pub use about::About;
pub use ending::Ending;
pub use first_incident::FirstIncident;
pub use provenance::{Provenance, command_line};
pub use queues::{HeldFor, Queue, Queues};
pub use short_trips::{ShortTrips, TripMeans};
pub use summary::{Inputs, LineServed, Summary};
