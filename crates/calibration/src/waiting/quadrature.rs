//! Mean values over a normal distribution, by Gauss and Hermite's rule.

/// Number of nodes for the drivers' own intercepts.
const SPREAD_NODES: usize = 7;

/// Nodes z and weights of the standard normal distribution: exact for polynomials up to degree 13 (Abramowitz and
/// Stegun, 25.4.46 and table 25.10, z = √2 x).
pub(super) const NORMAL: [[f64; 2]; SPREAD_NODES] = [
    [-3.750_439_717_725_742, 0.000_548_268_855_972_218],
    [-2.366_759_410_734_541, 0.030_757_123_967_586_5],
    [-1.154_405_394_739_968, 0.240_123_178_605_012_7],
    [0.0, 0.457_142_857_142_857_1],
    [1.154_405_394_739_968, 0.240_123_178_605_012_7],
    [2.366_759_410_734_541, 0.030_757_123_967_586_5],
    [3.750_439_717_725_742, 0.000_548_268_855_972_218],
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_moments_are_those_of_the_normal_distribution() {
        let moment = |power: i32| NORMAL.iter().map(|[z, weight]| weight * z.powi(power)).sum::<f64>();
        for (power, expected) in
            [(0, 1.0), (1, 0.0), (2, 1.0), (4, 3.0), (6, 15.0), (8, 105.0), (12, 10395.0)]
        {
            let moment = moment(power);
            assert!((moment - expected).abs() < 1e-8 * (1.0 + expected), "{power}: {moment}");
        }
    }
}
