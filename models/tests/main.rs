//! All tests of the models, and of what must hold for every one of them, as one program.

mod allocation;
mod certificate;
mod closed_forms;
mod derivatives;
mod drawing;
mod elliptic;
mod ensemble;
mod every;
mod formulas;
mod invariants;
mod lanes;
mod light;
mod linearise;
mod paper_fish;
mod paper_uchain;
mod plan;
mod projection;
mod rattle;
mod references;
mod streaming;
mod tapes;
mod verify;
