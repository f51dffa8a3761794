//! Time on a section of road, from its load.
//!
//! T_l = T_0 (1 + k_1 (q/q_max)^k_2), the function of the Bureau of Public Roads (1964, from memory). The paper prints
//! it with a misplaced brace and without numbers: k_1 = 0.15 and k_2 = 4 are ours, and the usual ones.
//!
//! * literal: T_l of the observed flow. In a jam flow falls, and the section looks free.
//! * repaired: max(T_l, L/v̄), v̄ the mean speed that is observed.

use super::route::travel_time;

/// k_1: share of the free time that is added where flow is at capacity.
const ADDED_AT_CAPACITY: f64 = 0.15;
/// k_2: how late the time grows as the flow approaches capacity.
const EXPONENT: f64 = 4.0;

/// T_l [s]: time on a section that takes `free_time` [s] when empty, at `load` q/q_max.
pub fn bpr(free_time: f64, load: f64) -> f64 {
    free_time * (1.0 + ADDED_AT_CAPACITY * libm::pow(load, EXPONENT))
}

/// The repaired time [s] on a section of `length` [m] on which the mean speed is `speed` [m/s], taken as at least 1
/// m/s.
pub fn link_time(free_time: f64, load: f64, length: f64, speed: f64) -> f64 {
    bpr(free_time, load).max(travel_time(length, speed))
}
