//! One second of a driver, for all of its possible desired speeds at once: how the chances of its states change, and
//! the derivatives of that.
//!
//! A free driver begins to want a side with p = ε + (1 − 2ε) h. Who wants a side changes within the second with a, also
//! in the second in which the desire came; else it gives up with g.

/// One number for each possible desired speed.
pub(super) type Lanes<const W: usize> = [f64; W];

/// The chances of a driver's states: free, wants the first side, wants the second side.
pub(super) type States<const W: usize> = [Lanes<W>; 3];

/// One second.
pub(super) struct Second<const W: usize> {
    /// For each side its row, relative to the first of the driver.
    pub(super) rows: [Option<usize>; 2],
    /// h and p of both sides.
    pub(super) logit: [Lanes<W>; 2],
    pub(super) desire: [Lanes<W>; 2],
    /// a of both sides.
    pub(super) accepted: [f64; 2],
    /// g for each side: 1 where the driver can no longer change to it.
    pub(super) gives_up: [f64; 2],
}

/// Derivatives of the likelihood in one second, with everything before and after it.
pub(super) struct Slopes<const W: usize> {
    pub(super) likelihood: Lanes<W>,
    pub(super) by_desire: [Lanes<W>; 2],
    pub(super) by_accepted: [Lanes<W>; 2],
    pub(super) by_giving_up: Lanes<W>,
    /// By the states before.
    pub(super) before: States<W>,
}

impl<const W: usize> Slopes<W> {
    fn none() -> Slopes<W> {
        Slopes {
            likelihood: [0.0; W],
            by_desire: [[0.0; W]; 2],
            by_accepted: [[0.0; W]; 2],
            by_giving_up: [0.0; W],
            before: [[0.0; W]; 3],
        }
    }
}

impl<const W: usize> Second<W> {
    /// A second with these odds of both sides, compared with staying, and the background rate ε.
    #[inline(always)]
    pub(super) fn new(
        rows: [Option<usize>; 2],
        odds: [Lanes<W>; 2],
        accepted: [f64; 2],
        (background, giving_up): (f64, f64),
    ) -> Second<W> {
        let (mut logit, mut desire) = ([[0.0; W]; 2], [[0.0; W]; 2]);
        let least = [0, 1].map(|side: usize| if rows[side].is_some() { background } else { 0.0 });
        for lane in 0..W {
            let share = 1.0 / (1.0 + odds[0][lane] + odds[1][lane]);
            for side in 0..2 {
                logit[side][lane] = odds[side][lane] * share;
                desire[side][lane] = least[side] + (1.0 - 2.0 * background) * logit[side][lane];
            }
        }
        let gives_up = rows.map(|it| if it.is_some() { giving_up } else { 1.0 });
        Second { rows, logit, desire, accepted, gives_up }
    }

    /// The states after a second without a change.
    #[inline(always)]
    pub(super) fn after(&self, now: &States<W>) -> States<W> {
        let Second { desire, accepted, gives_up, .. } = self;
        let mut after = [[0.0; W]; 3];
        for lane in 0..W {
            let mut free = now[0][lane] * (1.0 - desire[0][lane] - desire[1][lane]);
            for side in 0..2 {
                let (wants, refused) = (now[1 + side][lane], 1.0 - accepted[side]);
                free += wants * refused * gives_up[side];
                after[1 + side][lane] =
                    (now[0][lane] * desire[side][lane] + wants * (1.0 - gives_up[side])) * refused;
            }
            after[0][lane] = free;
        }
        after
    }

    /// The chances that a change to `side` begins in this second.
    #[inline(always)]
    pub(super) fn changes(&self, now: &States<W>, side: usize) -> Lanes<W> {
        std::array::from_fn(|lane| {
            let wants = now[0][lane] * self.desire[side][lane] + now[1 + side][lane];
            (self.accepted[side] * wants).max(f64::MIN_POSITIVE)
        })
    }

    /// Derivatives in a second without a change; `later` are those of all that follows by the states after it.
    #[inline(always)]
    pub(super) fn slopes(&self, now: &States<W>, later: &States<W>) -> Slopes<W> {
        let Second { desire, accepted, gives_up, rows, .. } = self;
        let mut slopes = Slopes::none();
        for lane in 0..W {
            let free = later[0][lane];
            let mut before = (1.0 - desire[0][lane] - desire[1][lane]) * free;
            let mut likelihood = 0.0;
            for side in 0..2 {
                let (wants, wanted) = (later[1 + side][lane], now[1 + side][lane]);
                let refused = 1.0 - accepted[side];
                let goes_on = (1.0 - gives_up[side]) * wants + gives_up[side] * free;
                before += desire[side][lane] * refused * wants;
                slopes.before[1 + side][lane] = refused * goes_on;
                likelihood += wanted * refused * goes_on;
                if rows[side].is_some() {
                    slopes.by_desire[side][lane] = now[0][lane] * (refused * wants - free);
                    slopes.by_accepted[side][lane] =
                        -now[0][lane] * desire[side][lane] * wants - wanted * goes_on;
                    slopes.by_giving_up[lane] += wanted * refused * (free - wants);
                }
            }
            slopes.before[0][lane] = before;
            slopes.likelihood[lane] = (likelihood + now[0][lane] * before).max(f64::MIN_POSITIVE);
        }
        slopes
    }

    /// Derivatives in a second in which a change to `side` begins.
    pub(super) fn slopes_of_change(&self, now: &States<W>, side: usize) -> Slopes<W> {
        let accepted = self.accepted[side];
        let mut slopes = Slopes::none();
        slopes.likelihood = self.changes(now, side);
        slopes.by_desire[side] = now[0].map(|free| free * accepted);
        slopes.by_accepted[side] =
            std::array::from_fn(|lane| now[0][lane] * self.desire[side][lane] + now[1 + side][lane]);
        slopes.before[0] = self.desire[side].map(|it| accepted * it);
        slopes.before[1 + side] = [accepted; W];
        slopes
    }
}
