//! The approach of the paper's figure: which lanes are symmetric, whether drivers in a wrong lane reach theirs, and who
//! leaves its route for a better one.

mod claims;
mod jam;
mod roads;
