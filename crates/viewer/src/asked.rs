//! What a page asks for.

use serde::Deserialize;

use crate::snapshot::Colour;
use crate::source::Hand;

/// Longest message of a page [bytes].
pub const LONGEST: usize = 4096;
/// Times as fast as reality.
const FACTORS: [f64; 2] = [0.1, 1000.0];
/// Steps at once.
const STEPS: u32 = 100;
/// Vehicles that are selected at once.
const SELECTED: usize = 2;

/// The work of a message that asks for little, as a measure of others.
pub(crate) const LEAST_WORK: f64 = 1.0;

/// What a page asks for: a message with one key.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Asked {
    /// It has drawn the frame with this number, and can draw the next one.
    Ready(u32),
    /// It shows this part of the map [m].
    View([f64; 4]),
    /// Time goes on: how many times as fast as reality; none: as fast as it goes.
    Play(Option<f64>),
    /// Time stands.
    Pause(bool),
    /// So many steps, and then time stands.
    Step(u32),
    /// The traffic at a time [s].
    Seek(f64),
    /// These vehicles are explained.
    Select(Vec<String>),
    /// Where a vehicle is.
    Find(String),
    /// What colours show.
    Colour(Colour),
    /// Whether it wants to know what the lanes carry.
    Lanes(bool),
    /// Something done by hand.
    Hand(Hand),
    /// Whether the twin of the traffic is shown, too.
    Twin(bool),
    /// The last thing done by hand is taken back.
    Undo(bool),
    /// The scenario is saved with what was done by hand.
    Save(bool),
}

impl Asked {
    /// Reads a message.
    ///
    /// # Errors
    /// If it is none of the protocol, in words.
    pub fn read(text: &str) -> Result<Asked, String> {
        if text.len() > LONGEST {
            return Err(format!("a message has at most {LONGEST} bytes"));
        }
        let asked: Asked = serde_json::from_str(text).map_err(|error| error.to_string())?;
        asked.check().map(|()| asked)
    }

    /// How much work it makes, as a multiple of the least. Ours.
    pub(crate) fn work(&self) -> f64 {
        LEAST_WORK
            * match self {
                Asked::Step(steps) => 1.0 + f64::from(*steps) / 5.0,
                Asked::Hand(_) | Asked::Undo(_) => 2.0,
                Asked::Seek(_) => 10.0,
                // The simulation is copied or written whole.
                Asked::Twin(_) | Asked::Save(_) => 100.0,
                _ => 1.0,
            }
    }

    fn check(&self) -> Result<(), String> {
        let [least, most] = FACTORS;
        match self {
            Asked::Play(Some(factor)) if !(least..=most).contains(factor) => {
                Err(format!("a factor is {least} to {most}"))
            }
            Asked::Step(steps) if !(1..=STEPS).contains(steps) => Err(format!("steps are 1 to {STEPS}")),
            Asked::Seek(time) if !time.is_finite() => Err("a time is a finite number".to_owned()),
            Asked::View(view) if view.iter().any(|it| !it.is_finite()) => {
                Err("a view has finite numbers".to_owned())
            }
            Asked::Select(ids) if ids.len() > SELECTED => Err(format!("at most {SELECTED} are selected")),
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_are_read_as_the_reference_has_them() {
        let read = |text| Asked::read(text).expect("a message");
        assert_eq!(read(r#"{"ready":7}"#), Asked::Ready(7));
        assert_eq!(read(r#"{"play":null}"#), Asked::Play(None));
        assert_eq!(read(r#"{"play":2.5}"#), Asked::Play(Some(2.5)));
        assert_eq!(read(r#"{"colour":"since_change"}"#), Asked::Colour(Colour::SinceChange));
        let Asked::Hand(hand) = read(
            r#"{"hand":{"set_parameter":{"style":"a","parameter":"change.courtesy.weight","value":2}}}"#,
        ) else {
            panic!("no hand")
        };
        assert!(matches!(hand, Hand::SetParameter { value: 2.0, .. }));
        let light = read(r#"{"hand":{"set_light":{"light":"-12","shows":"red"}}}"#);
        assert!(matches!(light, Asked::Hand(Hand::SetLight { shows: Some(_), .. })));
    }

    #[test]
    fn what_is_out_of_range_is_refused_in_words() {
        for (text, part) in [
            (r#"{"play":0}"#, "0.1 to 1000"),
            (r#"{"step":101}"#, "1 to 100"),
            (r#"{"select":["1","2","3"]}"#, "at most 2"),
            (r#"{"fly":true}"#, "unknown variant"),
            (r#"{"hand":{"put":{"x":1,"y":2,"class":"car","z":3}}}"#, "unknown field"),
            ("[", "expected value"),
        ] {
            let said = Asked::read(text).expect_err(text);
            assert!(said.contains(part), "{text}: {said}");
        }
        assert!(Asked::read(&" ".repeat(LONGEST + 1)).is_err());
    }
}
