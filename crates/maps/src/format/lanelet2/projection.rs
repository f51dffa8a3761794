//! Universal Transverse Mercator on the WGS84 ellipsoid.
//!
//! Krüger (1912), Konforme Abbildung des Erdellipsoids in der Ebene; the series to the sixth order in the
//! third flattening as in Karney (2011), Transverse Mercator with an accuracy of a few nanometers, J. Geodesy
//! 85, 475. Functions of `libm` give the same bits on every system.

use libm::{asinh, atan, atan2, atanh, cosh, fabs, sincos, sinh, sqrt, tan};

/// Equatorial radius [m].
const RADIUS: f64 = 6_378_137.0;
const FLATTENING: f64 = 1.0 / 298.257_223_563;
/// Third flattening.
const N: f64 = FLATTENING / (2.0 - FLATTENING);
/// Scale on the central meridian.
const SCALE: f64 = 0.9996;
/// Latitudes beyond are not covered by UTM [°].
const MAXIMUM_LATITUDE: f64 = 84.0;
/// Longitudes further than this from the central meridian are refused: the series is no longer exact there
/// [°].
const MAXIMUM_OFFSET: f64 = 30.0;

/// α_j: from the conformal sphere to the map.
const FORWARD: [f64; 6] = series([
    [1.0 / 2.0, -2.0 / 3.0, 5.0 / 16.0, 41.0 / 180.0, -127.0 / 288.0, 7891.0 / 37800.0],
    [0.0, 13.0 / 48.0, -3.0 / 5.0, 557.0 / 1440.0, 281.0 / 630.0, -1983433.0 / 1935360.0],
    [0.0, 0.0, 61.0 / 240.0, -103.0 / 140.0, 15061.0 / 26880.0, 167603.0 / 181440.0],
    [0.0, 0.0, 0.0, 49561.0 / 161280.0, -179.0 / 168.0, 6601661.0 / 7257600.0],
    [0.0, 0.0, 0.0, 0.0, 34729.0 / 80640.0, -3418889.0 / 1995840.0],
    [0.0, 0.0, 0.0, 0.0, 0.0, 212378941.0 / 319334400.0],
]);

/// β_j: from the map to the conformal sphere.
const INVERSE: [f64; 6] = series([
    [1.0 / 2.0, -2.0 / 3.0, 37.0 / 96.0, -1.0 / 360.0, -81.0 / 512.0, 96199.0 / 604800.0],
    [0.0, 1.0 / 48.0, 1.0 / 15.0, -437.0 / 1440.0, 46.0 / 105.0, -1118711.0 / 3870720.0],
    [0.0, 0.0, 17.0 / 480.0, -37.0 / 840.0, -209.0 / 4480.0, 5569.0 / 90720.0],
    [0.0, 0.0, 0.0, 4397.0 / 161280.0, -11.0 / 504.0, -830251.0 / 7257600.0],
    [0.0, 0.0, 0.0, 0.0, 4583.0 / 161280.0, -108847.0 / 3991680.0],
    [0.0, 0.0, 0.0, 0.0, 0.0, 20648693.0 / 638668800.0],
]);

/// The polynomials in `N` with these coefficients, from its first power on.
const fn series(coefficients: [[f64; 6]; 6]) -> [f64; 6] {
    let mut sums = [0.0; 6];
    let mut row = 0;
    while row < 6 {
        let mut power = 6;
        while power > 0 {
            power -= 1;
            sums[row] = (sums[row] + coefficients[row][power]) * N;
        }
        row += 1;
    }
    sums
}

/// Radius of the sphere whose meridians are as long as the ellipsoid's [m].
const RECTIFYING_RADIUS: f64 =
    RADIUS / (1.0 + N) * (1.0 + N * N / 4.0 + N * N * N * N / 64.0 + N * N * N * N * N * N / 256.0);

/// The map projection of one UTM zone, with positions relative to an origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Utm {
    /// Longitude of the zone's central meridian [°].
    meridian: f64,
    /// Position of the origin from the central meridian and the equator [m].
    origin: (f64, f64),
}

impl Utm {
    /// The projection in the zone of the place at `latitude` and `longitude` [°], which becomes (0, 0).
    pub(super) fn around(latitude: f64, longitude: f64) -> Option<Utm> {
        if !(fabs(latitude) <= MAXIMUM_LATITUDE && fabs(longitude) <= 180.0) {
            return None;
        }
        let zone = zone(latitude, longitude);
        let utm = Utm { meridian: f64::from(6 * zone - 183), origin: (0.0, 0.0) };
        utm.forward(latitude, longitude).map(|origin| Utm { origin, ..utm })
    }

    /// East and north of the origin [m] of the place at `latitude` and `longitude` [°].
    pub(super) fn forward(&self, latitude: f64, longitude: f64) -> Option<(f64, f64)> {
        let offset = (longitude - self.meridian + 540.0).rem_euclid(360.0) - 180.0;
        if !(fabs(latitude) <= 90.0 && fabs(longitude) <= 360.0 && fabs(offset) <= MAXIMUM_OFFSET) {
            return None;
        }
        let lambda = offset.to_radians();
        let tau = conformal(tan(latitude.to_radians()));
        let (sine, cosine) = sincos(lambda);
        let xi = atan2(tau, cosine);
        let eta = asinh(sine / sqrt(tau * tau + cosine * cosine));
        let (xi, eta) = corrected(xi, eta, &FORWARD, 1.0);
        let (east, north) = (SCALE * RECTIFYING_RADIUS * eta, SCALE * RECTIFYING_RADIUS * xi);
        Some((east - self.origin.0, north - self.origin.1))
    }

    /// Latitude and longitude [°] of the point `x` east and `y` north of the origin [m].
    pub(super) fn inverse(&self, x: f64, y: f64) -> (f64, f64) {
        let xi = (y + self.origin.1) / (SCALE * RECTIFYING_RADIUS);
        let eta = (x + self.origin.0) / (SCALE * RECTIFYING_RADIUS);
        let (xi, eta) = corrected(xi, eta, &INVERSE, -1.0);
        let (sinh, (sine, cosine)) = (sinh(eta), sincos(xi));
        let tau = geodetic(sine / sqrt(sinh * sinh + cosine * cosine));
        (atan(tau).to_degrees(), atan2(sinh, cosine).to_degrees() + self.meridian)
    }
}

/// Easting and northing [m] of the place at `latitude` and `longitude` [°] in its UTM zone; `None` where there is none.
pub fn utm(latitude: f64, longitude: f64) -> Option<[f64; 2]> {
    /// The central meridian has this easting, so that none is negative [m].
    const FALSE_EASTING: f64 = 500_000.0;
    /// In the south the equator has this northing [m].
    const FALSE_NORTHING: f64 = 10_000_000.0;
    let (east, north) = Utm::around(latitude, longitude)?.origin;
    Some([east + FALSE_EASTING, if latitude < 0.0 { north + FALSE_NORTHING } else { north }])
}

/// The UTM zone of a place, with the exceptions of Norway and Svalbard.
fn zone(latitude: f64, longitude: f64) -> i32 {
    let regular = ((longitude + 180.0) / 6.0).floor() as i32 % 60 + 1;
    if (56.0..64.0).contains(&latitude) && (3.0..12.0).contains(&longitude) {
        return 32;
    }
    if (72.0..=84.0).contains(&latitude) && (0.0..42.0).contains(&longitude) {
        return 31 + 2 * ((longitude + 3.0) / 12.0).floor() as i32;
    }
    regular
}

/// Tangent of the conformal latitude from that of the geodetic latitude.
fn conformal(tau: f64) -> f64 {
    let eccentricity = sqrt(FLATTENING * (2.0 - FLATTENING));
    let secant = sqrt(1.0 + tau * tau);
    let sigma = sinh(eccentricity * atanh(eccentricity * tau / secant));
    tau * sqrt(1.0 + sigma * sigma) - sigma * secant
}

/// Tangent of the geodetic latitude from that of the conformal latitude, by Newton's method.
fn geodetic(conformal_tau: f64) -> f64 {
    const STEPS: usize = 5;
    let flat = (1.0 - FLATTENING) * (1.0 - FLATTENING);
    let mut tau = conformal_tau;
    for _ in 0..STEPS {
        let reached = conformal(tau);
        tau += (conformal_tau - reached) / sqrt(1.0 + reached * reached) * (1.0 + flat * tau * tau)
            / (flat * sqrt(1.0 + tau * tau));
    }
    tau
}

/// ξ ± Σ c_j sin 2jξ cosh 2jη and η ± Σ c_j cos 2jξ sinh 2jη: the real and the imaginary part of ζ ± Σ c_j sin 2jζ with
/// ζ = ξ + iη, summed by Clenshaw's recurrence b_j = c_j + 2 cos 2ζ b_{j+1} − b_{j+2}, sum = sin 2ζ b_1.
fn corrected(xi: f64, eta: f64, coefficients: &[f64; 6], sign: f64) -> (f64, f64) {
    let (sine, cosine) = sincos(2.0 * xi);
    let (cosh, sinh) = (cosh(2.0 * eta), sinh(2.0 * eta));
    let twice_cosine = (2.0 * cosine * cosh, -2.0 * sine * sinh);
    let (mut next, mut after) = ((0.0, 0.0), (0.0, 0.0));
    for coefficient in coefficients.iter().rev() {
        let product = times(twice_cosine, next);
        (next, after) = ((coefficient + product.0 - after.0, product.1 - after.1), next);
    }
    let sum = times((sine * cosh, cosine * sinh), next);
    (xi + sign * sum.0, eta + sign * sum.1)
}

/// The product of two complex numbers.
fn times(a: (f64, f64), b: (f64, f64)) -> (f64, f64) {
    (a.0 * b.0 - a.1 * b.1, a.0 * b.1 + a.1 * b.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Origin, place, and its position by the reference library's UTM projector [m].
    const PLACES: [[[f64; 2]; 3]; 7] = [
        [[49.0, 8.4], [49.00345654351, 8.42427590707], [1778.502345819783, 370.4953713566065]],
        [[0.0, 0.0], [-0.003191105913, 0.001528866455], [170.36000002000947, -353.1998999621719]],
        [[49.0, 8.4], [48.5, 11.9], [258102.70400306612, -51691.709960927255]],
        [[-33.9, 151.2], [-33.8, 151.3], [9063.903520412045, 11246.977672001347]],
        [[60.4, 5.3], [60.41, 5.35], [2813.9582140371785, 958.8830764163285]],
        [[78.2, 15.6], [78.21, 15.7], [2269.380958071153, 1141.295794248581]],
        [[40.7, -74.0], [40.75, -73.9], [8378.854499554727, 5651.335482919589]],
    ];

    #[test]
    fn places_lie_where_the_reference_library_puts_them() {
        for [origin, place, expected] in PLACES {
            let (x, y) = Utm::around(origin[0], origin[1]).unwrap().forward(place[0], place[1]).unwrap();
            let off = (x - expected[0]).abs().max((y - expected[1]).abs());
            // The reference rounds at a false northing of 10,000 km south of the equator.
            assert!(off < 2e-8, "{place:?} is {off} m off");
        }
    }

    #[test]
    fn the_inverse_leads_back() {
        for [origin, place, _] in PLACES {
            let utm = Utm::around(origin[0], origin[1]).unwrap();
            let (x, y) = utm.forward(place[0], place[1]).unwrap();
            let (latitude, longitude) = utm.inverse(x, y);
            assert!((latitude - place[0]).abs() < 1e-12 && (longitude - place[1]).abs() < 1e-12);
        }
    }

    #[test]
    fn the_antimeridian_is_no_edge() {
        let utm = Utm::around(-17.0, 179.99).unwrap();
        let (x, _) = utm.forward(-17.0, -179.99).unwrap();
        assert!((2100.0..2150.0).contains(&x), "{x}");
    }

    #[test]
    fn places_outside_the_zone_or_the_earth_are_refused() {
        assert!(
            utm(84.1, 0.0).is_none() && Utm::around(84.1, 0.0).is_none() && Utm::around(0.0, 180.1).is_none()
        );
        assert!(Utm::around(f64::NAN, 0.0).is_none());
        let utm = Utm::around(49.0, 8.4).unwrap();
        assert!(utm.forward(49.0, 40.0).is_none() && utm.forward(91.0, 8.0).is_none());
        assert!(utm.forward(49.0, f64::INFINITY).is_none());
    }
}
