//! What drivers are predicted to do: changes second by second, and desires.

use super::likelihood::{Combination, Look, Memory};
use super::second::{Lanes, States};
use crate::measures::Prediction;

impl Look<'_> {
    /// For each second of the first phase the chance that a change begins in it, given all that was seen before, and
    /// whether one did. Drivers have no intercepts of their own here.
    pub(super) fn predict<const W: usize>(&self, memory: &mut Memory<W>) -> Vec<Prediction> {
        self.prepare(memory);
        let mut known: Lanes<W> = [0.0; W];
        known.iter_mut().zip(&self.driver.chances).for_each(|(it, chance)| *it = *chance);
        let mut predictions = Vec::new();
        let Some(spells) = self.driver.phases.first() else { return predictions };
        let combination = Combination::usual(spells);
        for spell in spells {
            let begin = self.begin(spell)[0];
            let mut now: States<W> = begin.map(|it| known.map(|known| it * known));
            let last = spell.seconds.len().saturating_sub(1);
            for (number, sides) in spell.seconds.iter().enumerate() {
                let second = self.second(memory, *sides, &combination);
                let before: f64 = now.iter().flatten().sum();
                let by_side = [0, 1].map(|side| second.changes(&now, side).iter().sum::<f64>());
                let came = spell.changed_to.filter(|_| number == last);
                let probability = ((by_side[0] + by_side[1]) / before).clamp(0.0, 1.0);
                predictions.push(Prediction { probability, came: came.is_some() });
                match came {
                    Some(side) => known = second.changes(&now, side),
                    None => {
                        now = second.after(&now);
                        known = std::array::from_fn(|lane| now[0][lane] + now[1][lane] + now[2][lane]);
                    }
                }
            }
            let sum = known.iter().sum::<f64>().max(f64::MIN_POSITIVE);
            known = known.map(|it| it / sum);
        }
        predictions
    }

    /// For each row of the driver the chance per second of a desire for its side, in the mean over the possible desired
    /// speeds. Drivers have no intercepts of their own here.
    pub(super) fn desires<const W: usize>(&self, memory: &mut Memory<W>) -> Vec<f64> {
        self.prepare(memory);
        let mut desires = vec![0.0; self.driver.rows.len()];
        let seconds = self.driver.phases.iter().flatten().flat_map(|it| &it.seconds);
        for sides in seconds {
            let combination = Combination::usual(&[]);
            let second = self.second(memory, *sides, &combination);
            for (side, row) in second.rows.iter().enumerate() {
                let Some(row) = row else { continue };
                let each = second.desire[side].iter().zip(&self.driver.chances);
                desires[*row] = each.map(|(desire, chance)| desire * chance).sum();
            }
        }
        desires
    }
}
