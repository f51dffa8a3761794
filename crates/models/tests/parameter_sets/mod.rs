//! Parameter sets of the Intelligent Driver Model, with the desired speeds that they were published for.

use laneweave_models::follow::{FollowingModel, Idm};

/// A published set.
pub(crate) struct Published {
    pub(crate) idm: Idm,
    /// v₀ [m/s].
    pub(crate) desired: f64,
}

impl Published {
    pub(crate) fn model(&self) -> FollowingModel {
        FollowingModel::Idm(self.idm)
    }
}

/// Treiber, Hennecke, Helbing (2000), Table I.
pub(crate) fn t2000() -> Published {
    Published { idm: Idm::default(), desired: 120.0 / 3.6 }
}

/// Kesting, Treiber, Helbing (2010).
pub(crate) fn k2010() -> Published {
    let idm = Idm { acceleration: 1.4, deceleration: 2.0, time_gap: 1.5, jam_gap: 2.0, exponent: 4.0 };
    Published { idm, desired: 120.0 / 3.6 }
}

/// A town street.
pub(crate) fn urban() -> Published {
    let idm = Idm { acceleration: 1.0, deceleration: 1.5, time_gap: 1.0, jam_gap: 2.0, exponent: 4.0 };
    Published { idm, desired: 50.0 / 3.6 }
}
