//! The world and its step.
//!
//! A step reads one snapshot: perceive → decide → drive. Then it advances the vehicles, resolves what concerns two
//! lanes, lets vehicles enter, and observes. The order of vehicles and the number of threads change nothing, bit for
//! bit.
//!
//! The code has wings. A wing imports only from the wings before it: `state` the data; `route` which lanes lead where;
//! `junction` reservations of conflict zones, and lights; `view` one instant as drivers see it; `demand` which vehicles
//! arrive; `record` what is recorded; `right_of_way` which vehicle may pass; `driver` what a driver does; `step` the
//! only part that changes a world; `ask` questions about a world.

mod ask;
mod demand;
mod driver;
mod junction;
mod record;
mod right_of_way;
mod route;
mod state;
mod step;
mod view;

pub use ask::account::{Account, Act, SideAccount, explain};
pub use ask::queues::{EntryQueue, Held, entry_queue_lengths, entry_queues};
pub use ask::standing::{JunctionHindrance, StandsFor, stands_for};
pub use ask::wait_cycle::wait_cycle;
pub use demand::arrivals::LineCount;
pub use demand::assignment::{Assignment, Change, Part, Thinning};
pub use demand::departure::Departure;
pub use demand::error::WorldError;
pub use demand::headways::{HeadwayError, Headways};
pub use demand::line::{Departures, Line, LineStop};
pub use demand::perimeter_control::PerimeterControl;
pub use demand::places::Places;
pub use demand::rate::Rate;
pub use demand::source::TAKES_LANE_WITHIN;
pub use demand::{Demand, Origin, Share, Trips};
pub use driver::gap::{Hindrance, Pairing};
pub use driver::intention::Intention;
pub use driver::perceive::{driver_of, perceive};
pub use junction::reservations::Reservations;
pub use junction::signals::Signals;
pub use laneweave_network::{Body, Class, Classes};
pub use record::counters::Counters;
pub use record::counts::Counts;
pub use record::events::{BrakingCause, DrivingEvent, DrivingEventKind, Event, LaneChange};
pub use record::incidents::{Incident, IncidentKind};
pub use record::lanelet_aggregates::LaneletAggregate;
pub use record::trip_log::TripRecord;
pub use right_of_way::approach::STOPS_AT_YELLOW;
pub use right_of_way::survey::{STANDS_BEFORE_A_LINE, STANDS_BEFORE_A_ZONE};
pub use route::disutility::Disutility;
pub use route::in_time::{LateTrip, LateTrips};
pub use route::navigate::Navigator;
pub use route::place::{CrossSection, InnerPlace, Place};
pub use route::waypoint::Waypoint;
pub use state::clock::Clock;
pub use state::command::{Command, Commanded, NewVehicle, Target};
pub use state::control::{Control, Lateral, Longitudinal};
pub use state::externals::{FIRST_INSERTED, FIRST_OBSTACLE};
pub use state::goal::{Destination, Goal};
pub use state::lane::{
    Counterpart, DriverState, Kinematics, Lane, LaneChangeKind, LaneChangeState, Phase, VehicleId,
};
pub use state::normal::quantile as normal_quantile;
pub use state::previous_lanes::PreviousLanes;
pub use state::random::{Purpose, Random};
pub use state::setup::{Placement, Setup};
pub use state::vehicle::{Fleet, desired_speed};
pub use step::checkpoint::CheckpointError;
pub use step::columns::{Columns, Rows};
pub use step::command_error::CommandError;
pub use step::recorded::{RecordedPose, RecordedVehicle};
pub use step::seal::{sealed, unsealed};
pub use step::template::Template;
pub use step::vehicle::Vehicle;
pub use step::world::World;
pub use view::pose::{between as pose_between, bumpers_in_lane};
pub use view::scene::{Found, Scene, Spot, Viewpoint};
pub use view::sight::LaneSight;
pub use view::snapshot::{Across, Seen, Snapshot};
