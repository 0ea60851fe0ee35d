//! Tests of motions: runs in closed form and against oracles, singular positions, switches, failures. One program, so that what they share
//! is linked once.

mod bearings;
mod branches;
mod cells;
mod crossings;
mod dips;
mod failures;
mod fallback;
mod far;
mod friction;
mod impacts;
mod integrals;
mod kinks;
mod light;
mod massless;
mod met;
mod misses;
mod orientations;
mod parting;
mod passing;
mod poles;
mod redundant;
mod redundant_loop;
mod rounded;
mod rows_in_time;
mod scales;
mod slots;
mod stability;
mod stiff;
mod switches;
mod tied;
mod tree;
mod turned;
mod two_loops;
mod vanishing;
mod wheels_across;
