//! A study whose threshold and weights are corrected for errors of what was recorded.

use crate::desire_model::{DesireModel, assumptions};
use crate::extrapolation::Estimate;
use crate::observe::Observations;
use crate::study::{Asked, Study};
use crate::waiting::Layout;

impl Study {
    /// The intercept and the weights of the same model for other `observations` of the same drivers. Places and β are
    /// those of this study; drivers have no intercepts of their own, and errors are those by the squares of their
    /// scores.
    pub fn repeated(&self, observations: &Observations, asked: &Asked) -> Vec<Estimate> {
        let design = observations.design(&DesireModel::Mcdm { beta: self.beta.beta });
        let assumptions = assumptions(&design, &asked.prior.terms(), self.effect, &self.spread)
            .holding_untold(Layout::of(&design), &self.weights);
        let weights = vec![1.0; design.drivers.len()];
        let similar = Some(&self.fit).filter(|it| it.layout == Layout::of(&design));
        let fit = design.fit_roughly(&assumptions.without_spread(&design), &weights, similar);
        let of = |at: usize| Estimate { value: fit.estimates[at], standard_error: fit.standard_error(at) };
        [fit.layout.intercept()].into_iter().chain(fit.layout.slopes()).map(of).collect()
    }

    /// This study, moved as its intercept and weights move from `plain` to `corrected`, in the order of
    /// [`Study::repeated`]. Intervals and draws become wider as the standard errors do. Classes stay as they are, and
    /// so do weights that are held at the prior.
    pub fn corrected(mut self, plain: &[Estimate], corrected: &[Estimate]) -> Study {
        let layout = self.layout();
        let parameters = [layout.intercept()].into_iter().chain(layout.slopes());
        for (number, at) in parameters.enumerate() {
            let (plain, corrected) = (plain[number], corrected[number]);
            if number > 0 && !self.weights[number - 1].is_identified {
                continue;
            }
            let by = corrected.value - plain.value;
            let wider = corrected.standard_error / plain.standard_error;
            let before = self.fit.estimates[at];
            self.fit.estimates[at] += by;
            self.fit.covariance.scale_row_and_column(at, wider);
            self.draws.iter_mut().for_each(|it| it[at] = before + by + wider * (it[at] - before));
            match number {
                // θ is the negative intercept.
                0 => self.theta.move_by(-by, wider),
                _ => self.weights[number - 1].move_by(by, wider),
            }
        }
        self
    }
}
