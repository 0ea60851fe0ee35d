//! All models.

use crate::{
    DoublePendulum, DoublePendulumAngles, DoubleScottRussell, Entry, FishRobot, FourBars,
    KapitzaPendulum, KnifeEdge, MasslessSpring, Model, Pendulum, RigidBody, RoughBlock,
    SliderCrank, SpringPendulum, UChain,
};

/// Something to do with each model that needs its type. (A [`Model`] has generic methods, so there is no `dyn Model`.)
pub trait Visitor {
    /// Does it with the model `M`.
    fn visit<M: Model>(&mut self);
}

macro_rules! registry {
    ($($model:ty),* $(,)?) => {
        /// All models, as tools handle them.
        #[must_use]
        pub fn entries() -> Vec<Entry> {
            vec![$(Entry::of::<$model>()),*]
        }

        /// Lets `visitor` visit all models.
        pub fn visit(visitor: &mut impl Visitor) {
            $(visitor.visit::<$model>();)*
        }
    };
}

/// Models that say nothing but their names beyond their declarations.
macro_rules! plain {
    ($($model:ty = $id:literal),* $(,)?) => {
        $(impl Model for $model {
            const ID: &'static str = $id;
        })*
    };
}

plain![
    KapitzaPendulum = "kapitza",
    SliderCrank = "slider-crank",
    DoubleScottRussell = "double-scott-russell",
    RigidBody = "rigid-body",
    FourBars = "four-bars",
];

registry![
    UChain,
    FishRobot,
    Pendulum,
    DoublePendulum,
    DoublePendulumAngles,
    KapitzaPendulum,
    SliderCrank,
    DoubleScottRussell,
    KnifeEdge,
    RoughBlock,
    MasslessSpring,
    SpringPendulum,
    RigidBody,
    FourBars,
];
