//! Types of vehicles of SUMO as drivers: their car-following model and speed factor; all else is that of a conservative
//! driver.

use laneweave_sim::{Class, Departure};
use toml::{Table, Value};

use super::elements::TypeElement;

/// Attributes of a type that are used, or only say how its vehicles look.
const KNOWN: [&str; 19] = [
    "id",
    "length",
    "vClass",
    "accel",
    "decel",
    "tau",
    "minGap",
    "speedFactor",
    "speedDev",
    "carFollowModel",
    "delta",
    "sigma",
    "probability",
    "color",
    "guiShape",
    "emissionClass",
    "imgFile",
    "personCapacity",
    "osgFile",
];
/// The class of a type that says none.
const USUAL_CLASS: &str = "passenger";

/// The class of ours as which vehicles of a class of SUMO drive; `None` for those that have no counterpart.
pub(super) fn class(name: &str) -> Option<Class> {
    Some(match name {
        "passenger" | "private" | "hov" | "evehicle" | "custom1" | "custom2" | "delivery" => Class::Car,
        "truck" | "trailer" => Class::Truck,
        "bus" | "coach" => Class::Bus,
        "motorcycle" | "moped" => Class::Motorcycle,
        "taxi" => Class::Taxi,
        "emergency" | "authority" | "army" | "vip" | "ignoring" => Class::Emergency,
        _ => return None,
    })
}

/// SUMO's numbers of a type that gives none: acceleration and deceleration [m/s²], and gap [m].
fn usual(class: Class) -> [f64; 3] {
    match class {
        Class::Truck => [1.3, 4.0, 2.5],
        Class::Bus => [1.2, 4.0, 2.5],
        Class::Motorcycle => [6.0, 10.0, 2.5],
        Class::Car | Class::Taxi | Class::Emergency => [2.6, 4.5, 2.5],
    }
}

impl TypeElement {
    /// One without attributes: SUMO's own type for vehicles that name none.
    pub(super) fn usual() -> TypeElement {
        TypeElement { file: 0, line: 0, attributes: std::collections::BTreeMap::new() }
    }

    fn text(&self, key: &str) -> Option<&str> {
        self.attributes.get(key).map(String::as_str)
    }

    fn number(&self, key: &str, usual: f64) -> f64 {
        self.text(key).map_or(usual, laneweave_maps::xml::number)
    }

    /// Its class of SUMO's.
    pub(super) fn class_name(&self) -> &str {
        self.text("vClass").unwrap_or(USUAL_CLASS)
    }

    /// Its class; `None` if it has no counterpart.
    pub(super) fn class(&self) -> Option<Class> {
        class(self.class_name())
    }

    /// Length of its vehicles [m], at most that of the longest ones that drive here; SUMO's, if it gives none.
    pub(super) fn length_m(&self) -> Option<f64> {
        let usual = match self.class_name() {
            "truck" => 7.1,
            "motorcycle" => 2.2,
            "moped" => 2.1,
            "delivery" | "emergency" => 6.5,
            "bus" | "coach" | "trailer" => *Departure::LENGTHS.end(),
            _ => 5.0,
        };
        let length = self.number("length", usual);
        length.is_finite().then(|| length.clamp(*Departure::LENGTHS.start(), *Departure::LENGTHS.end()))
    }

    /// Attributes that are not used, and what is meant by a model that has no counterpart.
    pub(super) fn unused(&self) -> Vec<String> {
        let unknown = self.attributes.keys().filter(|it| !KNOWN.contains(&it.as_str())).cloned();
        let model = self.text("carFollowModel").filter(|it| !matches!(*it, "Krauss" | "IDM" | "EIDM"));
        unknown.chain(model.map(|it| format!("carFollowModel={it}, which drives as Krauss"))).collect()
    }

    /// A style file for its drivers, with this name, made from the style file `base`.
    pub(super) fn style(&self, name: &str, base: &str) -> Option<String> {
        let mut style: Table = base.parse().ok()?;
        style.insert("name".into(), name.into());
        style.insert("description".into(), format!("Drivers of the SUMO type {name}").into());
        style.insert("follow".into(), Value::Table(self.following()));
        style.insert("speed_factor".into(), self.speed_factor());
        toml::to_string(&style).ok()
    }

    /// Its car-following model. Random dawdling has no counterpart: it accelerates as dawdling does in the mean.
    fn following(&self) -> Table {
        let [acceleration, deceleration, gap] = usual(self.class().unwrap_or(Class::Car));
        let is_idm = matches!(self.text("carFollowModel"), Some("IDM" | "EIDM"));
        let sigma = if is_idm { 0.0 } else { self.number("sigma", 0.5) };
        let acceleration = self.number("accel", acceleration) * (1.0 - 0.5 * sigma.clamp(0.0, 1.0));
        let mut table = Table::from_iter([
            ("model".to_owned(), Value::from(if is_idm { "idm" } else { "krauss" })),
            ("acceleration".into(), acceleration.into()),
            ("deceleration".into(), self.number("decel", deceleration).into()),
            ("time_gap".into(), self.number("tau", 1.0).into()),
            ("jam_gap".into(), self.number("minGap", gap).into()),
        ]);
        match is_idm {
            true => table.insert("exponent".into(), self.number("delta", 4.0).into()),
            false => table.insert("adaptation".into(), ADAPTATION.into()),
        };
        table
    }

    /// Its speed factor: a number, or normally distributed.
    fn speed_factor(&self) -> Value {
        let text = self.text("speedFactor").unwrap_or("");
        let inner = text.strip_prefix("normc(").or_else(|| text.strip_prefix("norm("));
        let numbers: Vec<f64> = match inner.and_then(|it| it.strip_suffix(')')) {
            Some(list) => list.split(',').map(laneweave_maps::xml::number).collect(),
            None => vec![
                self.number("speedFactor", 1.0),
                self.number("speedDev", if text.is_empty() { 0.1 } else { 0.0 }),
            ],
        };
        let [mean, deviation, low, high] = [(0, 1.0), (1, 0.0), (2, 0.2), (3, 2.0)]
            .map(|(at, usual)| numbers.get(at).copied().unwrap_or(usual));
        if deviation <= 0.0 {
            return mean.into();
        }
        let [low, high] = [low.max(SLOWEST), high.min(FASTEST)];
        Value::Table(Table::from_iter([
            ("distribution".to_owned(), Value::from("normal")),
            ("mean".into(), mean.into()),
            ("sd".into(), deviation.into()),
            ("min".into(), low.into()),
            ("max".into(), high.into()),
        ]))
    }
}

/// Time in which a driver adopts the safe speed [s]: the usual step of ours.
const ADAPTATION: f64 = 0.1;
/// Speed factors outside of these are not drawn; ours.
const SLOWEST: f64 = 0.5;
const FASTEST: f64 = 1.6;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::Source;
    use crate::style::{StyleTemplate, built_in};

    fn of(attributes: &[(&str, &str)]) -> TypeElement {
        let attributes = attributes.iter().map(|(key, value)| ((*key).to_owned(), (*value).to_owned()));
        TypeElement { file: 0, line: 1, attributes: attributes.collect() }
    }

    fn style(attributes: &[(&str, &str)]) -> Table {
        let base = built_in("conservative").expect("it is built in").text;
        let text = of(attributes).style("mine", base).expect("it can be written");
        let source = Source { path: "mine".into(), text: text.clone() };
        StyleTemplate::parse(&source).expect("it is a style");
        text.parse().expect("it is TOML")
    }

    #[test]
    fn drivers_of_a_type_follow_as_it_says() {
        let krauss = style(&[("accel", "3"), ("sigma", "0.5"), ("minGap", "1.5"), ("speedFactor", "1.2")]);
        let follow = &krauss["follow"];
        assert_eq!(follow["model"].as_str(), Some("krauss"));
        let number = |key: &str| follow[key].as_float();
        assert_eq!(
            ["acceleration", "deceleration", "time_gap", "jam_gap", "adaptation"].map(number),
            [Some(2.25), Some(4.5), Some(1.0), Some(1.5), Some(0.1)]
        );
        assert_eq!(krauss["speed_factor"].as_float(), Some(1.2));
        let idm =
            style(&[("carFollowModel", "IDM"), ("speedFactor", "normc(1.1,0.2,0.8,1.4)"), ("tau", "1.4")]);
        assert_eq!(
            (idm["follow"]["model"].as_str(), idm["follow"]["time_gap"].as_float()),
            (Some("idm"), Some(1.4))
        );
        let factor = &idm["speed_factor"];
        assert_eq!(
            ["mean", "sd", "min", "max"].map(|it| factor[it].as_float()),
            [1.1, 0.2, 0.8, 1.4].map(Some)
        );
        // Without a factor SUMO draws one.
        assert_eq!(style(&[])["speed_factor"]["sd"].as_float(), Some(0.1));
    }

    #[test]
    fn classes_have_a_counterpart_or_none() {
        let class = |name: &str| of(&[("vClass", name)]).class();
        assert_eq!(
            ["bus", "trailer", "ignoring"].map(class),
            [Class::Bus, Class::Truck, Class::Emergency].map(Some)
        );
        assert_eq!(["tram", "bicycle", "pedestrian"].map(class), [None; 3]);
        assert_eq!(of(&[]).class(), Some(Class::Car));
    }

    #[test]
    fn what_is_not_used_is_named() {
        let unused =
            of(&[("id", "x"), ("accel", "1"), ("lcStrategic", "2"), ("carFollowModel", "Wiedemann")])
                .unused();
        assert_eq!(unused, ["lcStrategic", "carFollowModel=Wiedemann, which drives as Krauss"]);
    }
}
