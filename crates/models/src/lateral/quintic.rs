//! The lateral path of a lane change: a quintic that starts and ends without lateral speed or acceleration.
//!
//! y(t) = w (10 τ³ − 15 τ⁴ + 6 τ⁵), τ = t/T

/// Lateral progress after the share `progress` of the time, both 0…1.
#[inline]
pub fn moved_share(progress: f64) -> f64 {
    let p = progress.clamp(0.0, 1.0);
    p * p * p * (10.0 + p * (6.0 * p - 15.0))
}

/// Largest lateral speed [m/s] of a change over `width` [m] in `duration` [s], halfway.
pub fn peak_lateral_speed(width: f64, duration: f64) -> f64 {
    15.0 / 8.0 * width / duration
}

/// Largest lateral acceleration [m/s²] of a change over `width` [m] in `duration` [s].
pub fn peak_lateral_acceleration(width: f64, duration: f64) -> f64 {
    10.0 / 3.0_f64.sqrt() * width / (duration * duration)
}
