//! Classes of the simulator for road users of recordings.

use laneweave_recordings::RoadUser;
use laneweave_sim::Class;

/// The class of vehicles whose drivers drive like this road user. Those that are no vehicles count as cars.
pub fn class_of(road_user: RoadUser) -> Class {
    match road_user {
        RoadUser::Truck => Class::Truck,
        RoadUser::Bus => Class::Bus,
        RoadUser::Motorcycle => Class::Motorcycle,
        RoadUser::Car | RoadUser::Bicycle | RoadUser::Pedestrian | RoadUser::Other => Class::Car,
    }
}
