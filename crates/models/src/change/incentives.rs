//! The incentives, in one list. Whatever there is one of for each incentive follows from it.

/// Hands the list of incentives to the macro `$make`, before `$more`. A line is the key of an incentive in a style, and
/// its type. The order is that of the rows.
macro_rules! with_incentives {
    ($make:ident! { $($more:tt)* }) => {
        $make! {
            incentives {
                /// Speed incentive.
                speed Speed;
                /// Route incentive.
                route Route;
                /// Comfort incentive.
                comfort Comfort;
                /// Courtesy incentive.
                courtesy Courtesy;
                /// Urgency, ours.
                urgency Urgency;
                /// Keeping to the slow side, ours.
                keeping Keeping;
            }
            $($more)*
        }
    };
}
pub(crate) use with_incentives;

/// Makes [`IncentiveName`] and [`INCENTIVES`].
macro_rules! names {
    (incentives { $($(#[$about:meta])* $key:ident $incentive:ident;)+ }) => {
        /// Which incentive.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
        pub enum IncentiveName {
            $($(#[$about])* $incentive,)+
        }

        /// How many incentives there are.
        pub const INCENTIVES: usize = IncentiveName::ALL.len();

        impl IncentiveName {
            /// All of them, in the order of the rows.
            pub const ALL: [IncentiveName; [$(stringify!($key)),+].len()] = [$(IncentiveName::$incentive),+];

            /// Its name, which is its key in a style.
            pub const fn name(self) -> &'static str {
                match self {
                    $(IncentiveName::$incentive => stringify!($key),)+
                }
            }

            /// The names of its yield and of its weight in tables.
            pub const fn columns(self) -> [&'static str; 2] {
                match self {
                    $(IncentiveName::$incentive => {
                        [concat!(stringify!($key), "_yield"), concat!(stringify!($key), "_weight")]
                    })+
                }
            }
        }
    };
}

with_incentives! { names! {} }

impl IncentiveName {
    /// All but those in `left_out`, in the order of the rows.
    ///
    /// # Panics
    /// If `COUNT` of them are not what is left; in a constant the compiler says so.
    pub const fn all_but<const COUNT: usize>(left_out: &[IncentiveName]) -> [IncentiveName; COUNT] {
        let mut left = [IncentiveName::ALL[0]; COUNT];
        let (mut row, mut count) = (0, 0);
        while row < INCENTIVES {
            let (mut at, mut is_left) = (0, true);
            while at < left_out.len() {
                is_left &= left_out[at] as usize != row;
                at += 1;
            }
            if is_left {
                left[count] = IncentiveName::ALL[row];
                count += 1;
            }
            row += 1;
        }
        assert!(count == COUNT, "so many are not left");
        left
    }
}

/// What some incentives are `given`, in the order of the rows; all others have the default.
pub(super) fn in_rows<T: Copy + Default, const N: usize>(given: [(IncentiveName, T); N]) -> [T; INCENTIVES] {
    let mut rows = [T::default(); INCENTIVES];
    for (name, it) in given {
        rows[name as usize] = it;
    }
    rows
}
