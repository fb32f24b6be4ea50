//! [`Scene`], what is rendered, and [`View`], from where.
//!
//! They are independent of each other. A scene builds its acceleration structure once, and can then be rendered in
//! any view with any settings.

mod builder;
mod error;
mod holes;
mod instances;
mod model;
mod new_shape;
mod settings;
mod view;

pub use builder::SceneBuilder;
pub use error::SceneError;
pub use model::{Scene, ShapeOf};
pub use settings::{Emission, FilmSettings};
pub use view::{View, ViewError};
