//! What is said to pages.

use std::sync::Arc;

use laneweave::Fault;
use serde::Serialize;

use crate::source::{Hands, Hello, Marks, Saved, TwinFacts};

/// A message to a page. One of its fields is set.
#[derive(Default, Serialize)]
pub(crate) struct Message<'a> {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) hello: Option<Hello>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) hands: Option<Hands>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) put: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) saved: Option<Saved>,
    /// Nothing in it: no twin is shown.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) twin: Option<Option<TwinFacts>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) found: Option<Found>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) marks: Option<&'a Marks>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) refused: Option<Refused>,
}

/// Where a vehicle is.
#[derive(Serialize)]
pub(crate) struct Found {
    pub(crate) id: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) x: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) y: Option<f64>,
}

/// What was not possible.
#[derive(Serialize)]
pub(crate) struct Refused {
    pub(crate) what: String,
    pub(crate) remedy: String,
}

impl Message<'_> {
    pub(crate) fn refused(fault: &Fault) -> Message<'static> {
        let Fault { place, what, remedy, .. } = fault;
        let refused = Refused { what: format!("{place}: {what}"), remedy: remedy.clone() };
        Message { refused: Some(refused), ..Message::default() }
    }

    pub(crate) fn text(&self) -> Arc<str> {
        serde_json::to_string(self).unwrap_or_default().into()
    }
}
