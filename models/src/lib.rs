//! Mechanisms declared with [`ukcore::multibody!`]: the two of Zhao, Zhen & Chen 2013 and a small one for each feature.
//!
//! Each module holds a declaration and what is known about its motion in closed form. All models are found by name in the
//! [registry](entries).

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod double_pendulum;
pub mod double_pendulum_angles;
pub mod double_scott_russell;
pub mod elliptic;
pub mod fish;
pub mod four_bars;
pub mod kapitza;
pub mod knife_edge;
pub mod massless_spring;
pub mod pendulum;
mod reference;
mod registry;
pub mod rigid_body;
pub mod rough_block;
pub mod slider_crank;
pub mod spring_pendulum;
pub mod uchain;

pub use double_pendulum::DoublePendulum;
pub use double_pendulum_angles::DoublePendulumAngles;
pub use double_scott_russell::DoubleScottRussell;
pub use fish::FishRobot;
pub use four_bars::FourBars;
pub use kapitza::KapitzaPendulum;
pub use knife_edge::KnifeEdge;
pub use massless_spring::MasslessSpring;
pub use pendulum::Pendulum;
pub use registry::{Visitor, entries, visit};
pub use rigid_body::RigidBody;
pub use rough_block::RoughBlock;
pub use slider_crank::SliderCrank;
pub use spring_pendulum::SpringPendulum;
pub use uchain::UChain;
pub use ukcore::model::{Entry, Model, Reference, StartOption, StartOptions, StartSpec};
