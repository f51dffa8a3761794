//! Straight roads for tests, drawn without a map.

use laneweave_network::{DrivingSide, Lanelet, LaneletIndex, Network, Point, Polyline};

/// Lanelets of `lanes` parallel lanes (lane 0 is the rightmost), in rows of 500 m at most.
pub fn straight(lanes: usize, length: f64, limit: f64) -> Network {
    Network::new(lanelets(lanes, length, limit, 1.0), DrivingSide::Right).unwrap()
}

/// The mirror image, on which traffic drives on the left.
#[allow(dead_code, reason = "not every test file mirrors")]
pub fn mirrored(lanes: usize, length: f64, limit: f64) -> Network {
    Network::new(lanelets(lanes, length, limit, -1.0), DrivingSide::Left).unwrap()
}

/// One lane that leads back to its start.
#[allow(dead_code, reason = "not every test file has a ring")]
pub fn ring(length: f64, limit: f64) -> Network {
    let mut all = lanelets(1, length, limit, 1.0);
    let last = all.len() - 1;
    all[last].following = vec![LaneletIndex(0)];
    Network::new(all, DrivingSide::Right).unwrap()
}

fn lanelets(lanes: usize, length: f64, limit: f64, sign: f64) -> Vec<Lanelet> {
    const WIDTH: f64 = 3.5;
    let rows = (length / 500.0).ceil() as usize;
    let row_length = length / rows as f64;
    let mut all = Vec::new();
    for row in 0..rows {
        for lane in 0..lanes {
            let (from, to) = (row as f64 * row_length, (row + 1) as f64 * row_length);
            let border = |offset: f64| {
                let y = sign * WIDTH * offset;
                Polyline::new([Point::new(from, y, 0.0), Point::new(to, y, 0.0)]).unwrap()
            };
            let index = |row: usize, lane: usize| LaneletIndex((row * lanes + lane) as u32);
            let (inner, outer) = (border(lane as f64 + 1.0), border(lane as f64));
            let towards_fast = (lane + 1 < lanes).then(|| index(row, lane + 1));
            let towards_slow = (lane > 0).then(|| index(row, lane - 1));
            let is_mirrored = sign < 0.0;
            let (left_border, right_border) = if is_mirrored { (outer, inner) } else { (inner, outer) };
            let (left, right) =
                if is_mirrored { (towards_slow, towards_fast) } else { (towards_fast, towards_slow) };
            all.push(Lanelet {
                id: index(row, lane).0 as i64 + 1,
                centre: Polyline::between(&left_border, &right_border).unwrap(),
                left_border,
                right_border,
                speed_limit: limit,
                following: if row + 1 < rows { vec![index(row + 1, lane)] } else { vec![] },
                left,
                right,
                adjacent_left: None,
                adjacent_right: None,
            });
        }
    }
    all
}
