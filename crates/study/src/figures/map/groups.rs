//! Marks that would lie on each other become one of each kind, side by side.

use super::super::series::extent;
use super::{MarkAt, Marks};

/// Size of a mark that stands for one, and the smallest one on a map with many marks, as multiples of the usual size.
const ONE: f64 = 0.6;
const SMALLEST: f64 = 0.45;
/// Between two marks [px].
const BETWEEN: f64 = 0.5;
/// So often marks become smaller, so that the largest one stands for all that it should.
const ROUNDS: usize = 4;

/// Marks at one place: one of each kind.
pub(super) struct Group<'a> {
    /// Its middle [px].
    middle: (f64, f64),
    /// From left to right.
    members: Vec<Member<'a>>,
}

/// All marks of a kind in a group.
#[derive(Clone, Copy)]
pub(super) struct Member<'a> {
    /// The index of its kind.
    pub(super) kind: usize,
    /// The number of marks, and how many they stand for.
    pub(super) number: usize,
    pub(super) weight: f64,
    /// The first one of them.
    pub(super) first: &'a MarkAt,
    /// Its middle [px].
    pub(super) at: (f64, f64),
    /// Its size, as a multiple of the usual one.
    pub(super) size: f64,
    /// Its width and height [px].
    extent: f64,
}

/// The sizes of the marks of a kind.
#[derive(Clone, Copy)]
struct Scale {
    /// Of a mark that stands for one, unless it is too small.
    one: f64,
    /// Maximum.
    largest: f64,
    /// Width and height of a mark of the usual size [px].
    extent: f64,
}

/// The groups of all marks that `place` puts on the page [px]. No two marks of different places lie on each other.
pub(super) fn groups(marks: &[Marks], place: impl Fn([f64; 2]) -> Option<(f64, f64)>) -> Vec<Group<'_>> {
    let of_kind =
        |it: &Marks| Scale { one: ONE.min(it.largest), largest: it.largest, extent: extent(it.series) };
    let mut scales: Vec<Scale> = marks.iter().map(of_kind).collect();
    let mut groups = Vec::new();
    for _ in 0..ROUNDS {
        groups = grouped(marks, &scales, &place);
        let mut is_enough = true;
        for it in groups.iter().flat_map(Group::members) {
            let scale = &mut scales[it.kind];
            let fitting = scale.largest / it.weight.max(1.0).sqrt();
            is_enough &= fitting >= scale.one;
            scale.one = scale.one.min(fitting);
        }
        if is_enough {
            break;
        }
    }
    groups
}

/// The groups with marks of these sizes.
fn grouped<'a>(
    marks: &'a [Marks],
    scales: &[Scale],
    place: impl Fn([f64; 2]) -> Option<(f64, f64)>,
) -> Vec<Group<'a>> {
    let mut groups: Vec<Group> = Vec::new();
    for (kind, of_kind) in marks.iter().enumerate() {
        for (first, at) in of_kind.marks.iter().filter_map(|it| Some((it, place(it.at)?))) {
            let (weight, size, extent) = (first.weight, 0.0, 0.0);
            let member = Member { kind, number: 1, weight, first, at, size, extent };
            let mut group = Group { middle: at, members: vec![member] };
            group.spread(scales);
            while let Some(other) = groups.iter().position(|it| it.touches(&group)) {
                group = groups.swap_remove(other).with(group);
                group.spread(scales);
            }
            groups.push(group);
        }
    }
    groups
}

impl<'a> Group<'a> {
    /// Its marks.
    pub(super) fn members(&self) -> impl Iterator<Item = &Member<'a>> {
        self.members.iter()
    }

    fn weight(&self) -> f64 {
        self.members().map(|it| it.weight).sum()
    }

    /// Both as one, in their common middle.
    fn with(mut self, other: Group<'a>) -> Group<'a> {
        let share = other.weight() / (self.weight() + other.weight()).max(f64::MIN_POSITIVE);
        let between = |a: f64, b: f64| a + share * (b - a);
        self.middle = (between(self.middle.0, other.middle.0), between(self.middle.1, other.middle.1));
        for it in other.members {
            match self.members.iter_mut().find(|own| own.kind == it.kind) {
                Some(own) => {
                    own.number += it.number;
                    own.weight += it.weight;
                }
                None => self.members.push(it),
            }
        }
        self.members.sort_by_key(|it| it.kind);
        self
    }

    /// Gives each mark its size and its place.
    fn spread(&mut self, scales: &[Scale]) {
        for it in &mut self.members {
            let Scale { one, largest, extent } = scales[it.kind];
            it.size = (one * it.weight.max(0.0).sqrt()).max(SMALLEST).min(largest);
            it.extent = it.size * extent + BETWEEN;
        }
        let mut x = self.middle.0 - 0.5 * self.size().0;
        for it in &mut self.members {
            it.at = (x + 0.5 * it.extent, self.middle.1);
            x += it.extent;
        }
    }

    /// Width and height [px].
    fn size(&self) -> (f64, f64) {
        (self.members().map(|it| it.extent).sum(), self.members().map(|it| it.extent).fold(0.0, f64::max))
    }

    /// Whether one would lie on the other.
    fn touches(&self, other: &Group) -> bool {
        let (own, others) = (self.size(), other.size());
        2.0 * (self.middle.0 - other.middle.0).abs() < own.0 + others.0
            && 2.0 * (self.middle.1 - other.middle.1).abs() < own.1 + others.1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn kind(series: usize, places: impl IntoIterator<Item = f64>) -> Marks {
        let mark = |x: f64| MarkAt { area: "1".into(), at: [x, 0.0], value: x, weight: 1.0 };
        Marks {
            kind: format!("kind {series}"),
            key: String::new(),
            quantity: "time [s]".into(),
            series,
            largest: 1.0,
            marks: places.into_iter().map(mark).collect(),
        }
    }

    fn all(marks: &[Marks]) -> Vec<Group<'_>> {
        groups(marks, |[x, y]| Some((x, y)))
    }

    #[test]
    fn marks_apart_stay_where_they_are() {
        let marks = [kind(0, [0.0, 10.0]), kind(1, [20.0])];
        let mut places: Vec<_> = all(&marks).iter().flat_map(Group::members).map(|it| it.at).collect();
        places.sort_by(|a, b| a.0.total_cmp(&b.0));
        assert_eq!(places, [(0.0, 0.0), (10.0, 0.0), (20.0, 0.0)]);
    }

    #[test]
    fn marks_on_each_other_become_one_of_each_kind_whose_area_is_their_number() {
        let marks = [kind(0, [0.0, 1.0]), kind(1, [2.0])];
        let groups = all(&marks);
        let [group] = &groups[..] else { panic!("{} groups", groups.len()) };
        let [two, one] = &group.members[..] else { panic!("{} marks", group.members.len()) };
        assert_eq!((two.number, one.number, group.middle), (2, 1, (1.0, 0.0)));
        assert!((two.size - ONE * 2.0_f64.sqrt()).abs() < 1e-9 && one.size == ONE);
        assert!(one.at.0 - two.at.0 >= 0.5 * (9.0 * two.size + 8.0 * one.size));
    }

    #[test]
    fn however_many_there_are_none_lies_on_another_and_none_is_lost() {
        let along = |step: f64| (0..800).map(move |it| (f64::from(it) * step) % 450.0);
        let marks = [kind(0, along(7.3)), kind(1, along(1.9)), kind(2, along(0.5))];
        let groups = all(&marks);
        let mut members: Vec<Member> = groups.iter().flat_map(Group::members).copied().collect();
        assert_eq!(members.iter().map(|it| it.number).sum::<usize>(), 2400);
        members.sort_by(|a, b| a.at.0.total_cmp(&b.at.0));
        for pair in members.windows(2) {
            assert!(pair[1].at.0 - pair[0].at.0 > 0.5 * (pair[0].extent + pair[1].extent) - 1e-9);
        }
        assert!(members.len() > 40 && members.iter().all(|it| (SMALLEST..=1.0).contains(&it.size)));
    }

    #[test]
    fn a_mark_that_the_page_does_not_have_is_left_out() {
        assert!(groups(&[kind(0, [0.0])], |_| None).is_empty());
    }
}
