//! Class restrictions: lanes that a class of vehicles may not use, and lanes that it avoids, as too tight or too
//! narrow, where there is another route.

use laneweave_network::{Chain, ChainIndex, Classes, Network, Point, Polyline};

use crate::state::vehicle::Class;

/// Long vehicles avoid lanes whose centre line turns tighter than this [m]: the mean of the inner radius 5.3 m and the
/// outer radius 12.5 m of the turning circle that each vehicle in the European Union must manage (Directive 96/53/EC,
/// annex I, 1.5; from memory).
const TIGHTEST_TURN: f64 = 8.9;
/// The radius of a turn is measured over at least this length on either side [m], ours. So an inaccurate drawing is no
/// turn.
const ARM: f64 = 3.0;

/// The different restrictions of the classes. Classes with the same restriction share their routes.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ClassRestrictions {
    /// For each class its restriction.
    of_class: [u8; Class::ALL.len()],
    /// For each restriction the first class that has it.
    classes: Vec<Class>,
    /// The chains that long vehicles avoid; `None` if there are none.
    tight: Option<Vec<bool>>,
}

impl Default for ClassRestrictions {
    /// All classes drive where cars do.
    fn default() -> ClassRestrictions {
        ClassRestrictions { of_class: [0; Class::ALL.len()], classes: vec![Class::Car], tight: None }
    }
}

impl ClassRestrictions {
    /// The restrictions of the classes on `network`, where these classes `drive`. Others, which users may put there,
    /// have that of one that may use the same lanes.
    pub(crate) fn of(network: &Network, drive: Classes) -> ClassRestrictions {
        let mut sets: Vec<Classes> = network.chains.iter().map(|it| it.classes).collect();
        sets.sort_unstable();
        sets.dedup();
        let tight = drive.iter().any(Class::is_long).then(|| tight(network)).flatten();
        let may_use_the_same =
            |one: Class, other: Class| sets.iter().all(|set| set.has(one) == set.has(other));
        let (mut classes, mut of_class) = (vec![Class::Car], [0; Class::ALL.len()]);
        let all = Class::ALL.into_iter();
        let (driven, others): (Vec<Class>, Vec<Class>) = all.partition(|it| drive.has(*it));
        for class in driven.into_iter().chain(others) {
            let is_as_long = |it: &Class| tight.is_none() || it.is_long() == class.is_long();
            let alike = || classes.iter().enumerate().filter(|it| may_use_the_same(*it.1, class));
            let same = alike().find(|it| is_as_long(it.1));
            let same = same.or_else(|| alike().next().filter(|_| !drive.has(class)));
            let known = same.map_or(classes.len(), |it| it.0);
            if known == classes.len() {
                classes.push(class);
            }
            of_class[class as usize] = known as u8;
        }
        ClassRestrictions { of_class, classes, tight }
    }

    /// Number of different restrictions.
    pub(crate) fn count(&self) -> usize {
        self.classes.len()
    }

    /// The restriction of a class, from 0 on. That of cars is 0.
    pub(crate) fn of_class(&self, class: Class) -> usize {
        usize::from(self.of_class[class as usize])
    }

    /// A class with `restriction`.
    pub(crate) fn class(&self, restriction: usize) -> Class {
        self.classes[restriction]
    }

    /// Whether vehicles with `restriction` avoid `chain`.
    pub(crate) fn avoids(&self, restriction: usize, chain: ChainIndex) -> bool {
        self.class(restriction).is_long() && self.tight.as_ref().is_some_and(|it| it[chain.at()])
    }
}

/// The chains that long vehicles avoid; `None` if they drive where all others do.
fn tight(network: &Network) -> Option<Vec<bool>> {
    let is_tight = |it: &Chain| it.is_tight_for_long || tightest_turn(&way_over(network, it)) < TIGHTEST_TURN;
    let all: Vec<bool> = network.chains.iter().map(is_tight).collect();
    (all.contains(&true) || network.chains.iter().any(|it| it.open != Chain::WIDE)).then_some(all)
}

/// The centre line of a chain, prolonged by the only chain before it and the only one after it: a turn in a junction
/// may be shorter than the arms of its turn.
fn way_over(network: &Network, chain: &Chain) -> Polyline {
    let only = |chains: &[ChainIndex]| if let [only] = chains { Some(network.chain(*only)) } else { None };
    let before = only(&chain.previous).map(|it| it.centre.at(it.length - ARM));
    let next = only(&chain.following).map(|it| it.centre.at(ARM));
    let line = before.into_iter().chain(chain.centre.points().iter().copied()).chain(next);
    Polyline::new(line).unwrap_or_else(|| chain.centre.clone())
}

/// The least radius of a line [m]. Each circle goes through a point of the line and through the points one arm before
/// and behind it.
fn tightest_turn(line: &Polyline) -> f64 {
    let (mut station, mut tightest) = (0.0, f64::INFINITY);
    for points in line.points().windows(3) {
        let arms = [points[0].distance(&points[1]), points[1].distance(&points[2])];
        station += arms[0];
        let (before, behind) = (station - arms[0].max(ARM), station + arms[1].max(ARM));
        if before >= 0.0 && behind <= line.length() {
            tightest = tightest.min(radius(&line.at(before), &points[1], &line.at(behind)));
        }
    }
    tightest
}

/// Radius of the circle through three points [m].
fn radius(a: &Point, b: &Point, c: &Point) -> f64 {
    let double_area = ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)).abs();
    a.distance(b) * b.distance(c) * c.distance(a) / (2.0 * double_area)
}

#[cfg(test)]
mod tests {
    use core::f64::consts::FRAC_PI_2;

    use laneweave_network::{DrivingSide, Lanelet, LaneletIndex};

    use super::*;
    use crate::route::navigate::Navigator;
    use crate::route::place::Place;

    /// A quarter of a circle between two straight pieces of 20 m. Its points are about `spacing` [m] apart.
    fn turn(radius: f64, spacing: f64) -> Polyline {
        let pieces = (radius * FRAC_PI_2 / spacing).ceil() as usize;
        let arc = (0..=pieces).map(|it| {
            let (sin, cos) = (it as f64 / pieces as f64 * FRAC_PI_2).sin_cos();
            Point::new(radius * sin, radius * (1.0 - cos), 0.0)
        });
        let (before, behind) = (Point::new(-20.0, 0.0, 0.0), Point::new(radius, radius + 20.0, 0.0));
        Polyline::new(std::iter::once(before).chain(arc).chain([behind])).unwrap()
    }

    #[test]
    fn a_turn_has_its_radius_however_finely_it_is_drawn() {
        for drawn in [6.0, 9.0, 15.0, 40.0] {
            for spacing in [0.3, 1.0, 2.0, 3.0] {
                let found = tightest_turn(&turn(drawn, spacing));
                assert!((0.85 * drawn..1.2 * drawn).contains(&found), "{found}, not {drawn}, at {spacing} m");
            }
        }
    }

    #[test]
    fn a_straight_line_turns_nowhere() {
        let line = Polyline::new((0..9).map(|it| Point::new(2.0 * f64::from(it), 0.0, 0.0))).unwrap();
        assert_eq!(tightest_turn(&line), f64::INFINITY);
    }

    /// A lanelet along `line`, followed by `following`.
    fn lanelet(id: i64, line: Polyline, following: &[u32]) -> Lanelet {
        let mut lanelet = Lanelet::alone(id, [line.clone(), line.clone(), line], 10.0);
        lanelet.following = following.iter().map(|it| LaneletIndex(*it)).collect();
        lanelet
    }

    /// The chain that vehicles of `class` take from a road that leads into `turns`. Each turn has a radius [m], and all
    /// lead to the same road.
    fn chosen(class: Class, turns: &[f64]) -> Option<ChainIndex> {
        let straight = |y| Polyline::new([Point::new(0.0, y, 0.0), Point::new(200.0, y, 0.0)]).unwrap();
        let last = turns.len() as u32 + 1;
        let numbers: Vec<u32> = (1..last).collect();
        let mut all = vec![lanelet(1, straight(0.0), &numbers)];
        all.extend(turns.iter().zip(2..).map(|(it, id)| lanelet(id, turn(*it, 1.0), &[last])));
        all.push(lanelet(99, straight(100.0), &[]));
        let network = Network::new(all, DrivingSide::Right).unwrap();
        let restrictions = ClassRestrictions::of(&network, Classes::ALL);
        let navigator =
            Navigator::with_restrictions(&network, &[Place::Gate(network.exits[0].clone())], restrictions, 0);
        let goal = navigator.seen_by(class, Some(0));
        assert_eq!((navigator.number(goal), navigator.seen_by(class, goal)), (Some(0), goal));
        navigator.waypoint(goal, ChainIndex(0)).next
    }

    #[test]
    fn long_vehicles_go_round_a_tight_turn_and_short_ones_take_it() {
        for (class, expected) in [(Class::Car, 1), (Class::Motorcycle, 1), (Class::Truck, 2), (Class::Bus, 2)]
        {
            assert_eq!(chosen(class, &[5.0, 50.0]), Some(ChainIndex(expected)), "{class:?}");
        }
    }

    #[test]
    fn a_turn_back_that_is_shorter_than_its_arms_is_tight() {
        let line = |points: &[(f64, f64)]| {
            Polyline::new(points.iter().map(|(x, y)| Point::new(*x, *y, 0.0))).expect("a line")
        };
        let back = line(&[(50.0, 0.0), (51.4, 0.9), (51.4, 2.3), (50.0, 3.2)]);
        let all = vec![
            lanelet(1, line(&[(0.0, 0.0), (50.0, 0.0)]), &[1, 2]),
            lanelet(2, back, &[3]),
            lanelet(3, line(&[(50.0, 0.0), (99.0, 0.0)]), &[]),
            lanelet(4, line(&[(50.0, 3.2), (0.0, 3.2)]), &[]),
            lanelet(5, line(&[(99.0, 3.2), (50.0, 3.2)]), &[3]),
        ];
        let network = Network::new(all, DrivingSide::Right).expect("the lanelets fit");
        let tight = tight(&network).expect("it turns");
        let of = |id: i64| tight[network.start_of(network.lanelet_with(id).expect("it is there")).chain.at()];
        assert_eq!([1, 2, 3, 4, 5].map(of), [false, true, false, false, false]);
    }

    #[test]
    fn long_vehicles_take_a_tight_turn_where_there_is_no_wider_one() {
        assert_eq!(chosen(Class::Bus, &[5.0, 7.0]), Some(ChainIndex(1)));
    }

    #[test]
    fn who_avoids_nothing_sees_the_roads_as_all_do() {
        let network = Network::new(vec![lanelet(1, turn(5.0, 1.0), &[])], DrivingSide::Right).unwrap();
        let cars = Classes::from_iter([Class::Car]);
        assert_eq!(ClassRestrictions::of(&network, cars).count(), 1);
        assert_eq!(ClassRestrictions::of(&network, Classes::ALL).count(), 2);
    }
}
