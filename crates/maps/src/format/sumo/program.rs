//! Programs of lights as plain data: `tlLogic` of nets and of additional files.

use crate::xml::{ANY, Element, Visitor, XmlError, number, walk};

/// Programs in the order of their files. Of several of one junction the last one runs.
#[derive(Default)]
pub(super) struct Programs {
    pub(super) all: Vec<LightProgram>,
}

/// A program of lights.
pub(super) struct LightProgram {
    pub(super) id: String,
    /// When its first phase begins [s].
    pub(super) offset: f64,
    pub(super) phases: Vec<LightPhase>,
}

/// A phase of a program.
pub(super) struct LightPhase {
    /// [s].
    pub(super) duration: f64,
    /// What each light shows, a character each.
    pub(super) state: String,
}

impl Programs {
    /// The programs in an additional file.
    pub(super) fn of_additional(bytes: &[u8]) -> Result<Programs, XmlError> {
        let mut programs = Programs::default();
        walk(bytes, ANY, &mut programs)?;
        Ok(programs)
    }

    /// Begins a program.
    pub(super) fn add(&mut self, element: &Element) -> Result<(), XmlError> {
        let [id, offset] = element.values(["id", "offset"])?;
        let id = id.unwrap_or_default().into_owned();
        let offset = offset.map_or(0.0, |it| number(&it));
        self.all.push(LightProgram { id, offset, phases: Vec::new() });
        Ok(())
    }

    /// Adds a phase to the last program.
    pub(super) fn add_phase(&mut self, element: &Element) -> Result<(), XmlError> {
        let [duration, state] = element.values(["duration", "state"])?;
        if let Some(program) = self.all.last_mut() {
            let duration = duration.map_or(f64::NAN, |it| number(&it));
            program.phases.push(LightPhase { duration, state: state.unwrap_or_default().into_owned() });
        }
        Ok(())
    }
}

impl Visitor for Programs {
    fn open(&mut self, path: &str, element: &Element) -> Result<(), XmlError> {
        match path {
            "tlLogic" => self.add(element),
            "tlLogic/phase" => self.add_phase(element),
            _ => Ok(()),
        }
    }

    fn close(&mut self, _: &str, _: &str) {}
}
