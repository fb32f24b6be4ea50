//! What is rendered and how it is seen: [`Scene`] and [`View`].
//!
//! Neither knows the other. A scene is built once, which takes the time of its tree, and can then be rendered in any
//! view with any settings.

mod builder;
mod model;
mod settings;
mod view;

pub use builder::{SceneBuilder, SceneError};
pub use model::Scene;
pub use settings::{Emission, FilmSettings};
pub use view::{View, ViewError};
