//! All tests of this crate as one program: what they share is compiled and linked once.

mod allocation;

mod assembly;
mod certificate;
mod closed_forms;
mod derivatives;
mod ensemble;
mod equilibrium;
mod failures;
mod fallback;
mod formulas;
mod invariants;
mod kinks;
mod lanes;
mod language;
mod layers;
mod linearise;
mod machines;
mod orientations;
mod paper_fish;
mod paper_uchain;
mod passing;
mod plan;
mod projection;
mod rattle;
mod redundant;
mod redundant_loop;
mod registry;
mod rows_in_time;
mod stability;
mod stiff;
mod streaming;
mod switches;
mod vanishing;
mod vectors;
