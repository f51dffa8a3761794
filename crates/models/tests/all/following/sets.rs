//! Published parameter sets of the models, with the desired speeds that they were published for.

use laneweave_models::Reading;
use laneweave_models::follow::{Acc, FollowingModel, Fvdm, Gfm, GfmForm, Idm, Ovm};

/// A published set of the Intelligent Driver Model.
pub(crate) struct Published {
    pub(crate) idm: Idm,
    /// v₀ [m/s].
    pub(crate) desired: f64,
}

impl Published {
    pub(crate) fn model(&self) -> FollowingModel {
        FollowingModel::Idm(self.idm)
    }

    /// The same drivers by the enhanced model.
    pub(crate) fn enhanced(&self) -> FollowingModel {
        let Idm { acceleration, deceleration, time_gap, jam_gap, exponent } = self.idm;
        let coolness = Acc::default().coolness;
        FollowingModel::Acc(Acc { acceleration, deceleration, time_gap, jam_gap, exponent, coolness })
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

/// Jiang, Wu, Zhu (2001).
pub(crate) fn literal_fvdm() -> FollowingModel {
    FollowingModel::Fvdm(Fvdm { reading: Reading::Literal, ..Fvdm::default() })
}

/// Helbing, Tilch (1998), of the Optimal Velocity Model.
pub(crate) fn literal_ovm() -> FollowingModel {
    FollowingModel::Ovm(Ovm { reading: Reading::Literal, ..Ovm::default() })
}

/// The Generalized Force Model as Jiang, Wu, Zhu (2001) have it.
pub(crate) fn literal_gfm() -> FollowingModel {
    FollowingModel::Gfm(Gfm { form: GfmForm::Jiang, reading: Reading::Literal, ..Gfm::default() })
}
