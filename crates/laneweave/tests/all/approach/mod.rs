//! The approach of the paper's figure: which lanes are symmetric, whether drivers in a wrong lane reach a right one,
//! and which drivers leave their route for a better one.

mod claims;
mod jam;
mod roads;
