//! All models, by name.

use crate::{
    DoublePendulum, DoublePendulumAngles, DoubleScottRussell, Entry, FishRobot, FourBars,
    KapitzaPendulum, KnifeEdge, MasslessSpring, Model, Pendulum, RigidBody, RoughBlock,
    SliderCrank, SpringPendulum, UChain,
};
use ukcore::Error;

/// Something to do with a model whose type is known only by name. (A [`Model`] has generic methods, so there is no `dyn Model`.)
pub trait Visitor {
    /// What comes out.
    type Output;
    /// Does it with the model `M`.
    fn visit<M: Model>(self) -> Self::Output;
}

macro_rules! registry {
    ($($model:ty),* $(,)?) => {
        /// All models, as tools handle them.
        #[must_use]
        pub fn entries() -> Vec<Entry> {
            vec![$(Entry::of::<$model>()),*]
        }

        /// Names of all models.
        #[must_use]
        pub fn ids() -> Vec<&'static str> {
            vec![$(<$model as Model>::ID),*]
        }

        /// Lets `visitor` visit the model called `id`.
        ///
        /// # Errors
        /// [`Error::UnknownName`] with the nearest name.
        pub fn visit<V: Visitor>(id: &str, visitor: V) -> Result<V::Output, Error> {
            $(
                if id == <$model as Model>::ID {
                    return Ok(visitor.visit::<$model>());
                }
            )*
            Err(Error::unknown_name("model", id, &mut ids().into_iter()))
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
    SliderCrank = "slider_crank",
    DoubleScottRussell = "double_scott_russell",
    RigidBody = "rigid_body",
    FourBars = "four_bars",
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
