//! Tests of declarations, of their equations and of states: what holds at a moment. One program, so that what they share is linked once.

mod assembly;
mod bodies;
mod carried;
mod closing;
mod diagnosis;
mod directions;
mod equilibrium;
mod inverse;
mod joints;
mod kinematics;
mod language;
mod layers;
mod loads;
mod machines;
mod massless;
mod modes;
mod nearest;
mod parts;
mod reactions;
mod rest;
mod rough;
mod starts;
mod told;
mod units;
mod vectors;
