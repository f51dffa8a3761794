//! The speed at which a driver drives through a bend.
//!
//! Drivers accept a lateral acceleration that grows about with the square root of the curvature κ, up to the one that
//! they bear in tight bends, A (the form as in the speed profiles of IHSDM, from memory; the numbers are ours):
//!
//! a = A min(1, √(R₀ κ)),   v = √(a / κ)
//!
//! with R₀ = 200 m. So v² = A/κ in bends tighter than R₀, and v grows with κ^(−1/4) in gentler ones.

/// R₀: bends with a smaller radius are driven with the largest lateral acceleration [m].
const TIGHT: f64 = 200.0;
/// Share of a driver's lateral acceleration with a long vehicle (ours).
const LONG: f64 = 0.7;
/// Nobody drives slower than this because of a bend [m/s] (ours): the map is not drawn more exactly.
const SLOWEST: f64 = 2.0;

/// The square of the speed [m²/s²] in a bend with this `curvature` [1/m], of a driver who bears the lateral
/// acceleration `largest` [m/s²].
#[inline]
pub fn speed_squared(largest: f64, is_long: bool, curvature: f64) -> f64 {
    let largest = if is_long { LONG * largest } else { largest };
    let borne = largest * (TIGHT * curvature).sqrt().min(1.0);
    (borne / curvature).max(SLOWEST * SLOWEST)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lateral_acceleration_is_less_in_gentle_bends() {
        let in_bend = |radius: f64| speed_squared(2.5, false, 1.0 / radius) / radius;
        assert_eq!([10.0, 100.0, 200.0].map(in_bend), [2.5; 3]);
        assert!((in_bend(800.0) - 1.25).abs() < 1e-12);
        assert_eq!(speed_squared(2.5, true, 0.1), 17.5);
        assert_eq!(speed_squared(2.5, false, 10.0), 4.0);
    }
}
