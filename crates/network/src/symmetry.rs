//! Whether a lane leads everywhere that the lane beside it leads.
//!
//! The paper's text calls lanes symmetric that have the same next section. The caption of its figure, the only
//! definition, calls the change from i to j symmetric if succ(i) ⊆ succ(j), succ the next sections of a lane.

/// What a change between two lanes means for a driver whose route is not known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Symmetry {
    /// The other lane leads everywhere that the own one leads.
    Symmetric,
    /// The change loses a continuation of the own lane.
    Asymmetric,
    /// One of them ends at the edge of the map: it is not known where it leads.
    Unknown,
}

/// The symmetry of a change from a lane that leads to the sections `here` to one that leads to `there`.
pub fn symmetry<Section: PartialEq>(here: &[Section], there: &[Section]) -> Symmetry {
    if here.is_empty() || there.is_empty() {
        Symmetry::Unknown
    } else if here.iter().all(|it| there.contains(it)) {
        Symmetry::Symmetric
    } else {
        Symmetry::Asymmetric
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LEFT: char = '←';
    const STRAIGHT: char = '↑';

    #[test]
    fn v40_lanes_are_symmetric_where_no_way_is_lost() {
        let (a, b, c) = (&[LEFT][..], &[LEFT, STRAIGHT][..], &[STRAIGHT][..]);
        let statements = [
            (a, b, Symmetry::Symmetric),
            (c, b, Symmetry::Symmetric),
            (a, c, Symmetry::Asymmetric),
            (c, a, Symmetry::Asymmetric),
            (b, a, Symmetry::Asymmetric),
            (b, c, Symmetry::Asymmetric),
        ];
        for (here, there, expected) in statements {
            assert_eq!(symmetry(here, there), expected, "{here:?} to {there:?}");
        }
    }

    #[test]
    fn v40_a_lane_is_symmetric_to_itself_in_whatever_order_its_ways_are_named() {
        assert_eq!(symmetry(&[LEFT, STRAIGHT], &[STRAIGHT, LEFT]), Symmetry::Symmetric);
    }

    #[test]
    fn v40_nothing_is_known_of_a_lane_that_ends_at_the_edge_of_the_map() {
        assert_eq!(symmetry(&[], &[LEFT]), Symmetry::Unknown);
        assert_eq!(symmetry(&[LEFT], &[]), Symmetry::Unknown);
        assert_eq!(symmetry::<char>(&[], &[]), Symmetry::Unknown);
    }
}
