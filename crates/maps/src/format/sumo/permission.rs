//! Who may use a lane: SUMO's vehicle classes as ours.

use laneweave_network::{Class, Classes};

/// The classes in a list of SUMO's, such as `bus taxi`. Those that have no counterpart here, such as `rail` and
/// `pedestrian`, are none.
fn listed(list: &str) -> Classes {
    list.split_whitespace().map(class).fold(Classes::NONE, Classes::and)
}

/// Where anybody may drive, emergency vehicles may.
fn with_emergency(classes: Classes) -> Classes {
    if classes.is_empty() { classes } else { classes.and(Classes::from_iter([Class::Emergency])) }
}

fn class(name: &str) -> Classes {
    let class = match name {
        "all" => return Classes::ALL,
        "passenger" => Class::Car,
        "truck" => Class::Truck,
        "bus" | "coach" => Class::Bus,
        "motorcycle" => Class::Motorcycle,
        "taxi" => Class::Taxi,
        "emergency" | "authority" => Class::Emergency,
        _ => return Classes::NONE,
    };
    Classes::from_iter([class])
}

/// The classes that `allow` and `disallow` of a lane let in. `allow` counts before `disallow`, and a lane with neither
/// is for everybody.
pub(super) fn classes(allow: Option<&str>, disallow: Option<&str>) -> Classes {
    match (allow.filter(|it| !it.trim().is_empty()), disallow) {
        (Some(allow), _) => with_emergency(listed(allow)),
        (None, Some(disallow)) => with_emergency(Classes::ALL.without(listed(disallow))),
        (None, None) => Classes::ALL,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lanes_are_for_whom_the_net_lets_in() {
        let names = |allow, disallow| classes(allow, disallow).names();
        assert_eq!(classes(None, None), Classes::ALL);
        assert_eq!(names(Some("bus taxi bicycle"), None), "bus, taxi, emergency");
        assert_eq!(names(None, Some("passenger truck pedestrian tram")), "bus, motorcycle, taxi, emergency");
        assert_eq!(names(Some("pedestrian"), None), "");
        assert_eq!(names(None, Some("all")), "");
        assert_eq!(classes(Some("all"), None), Classes::ALL);
    }
}
