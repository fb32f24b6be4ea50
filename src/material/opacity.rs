//! What surfaces that are put together let pass.

use crate::interaction::SurfaceInteraction;
use crate::texture::{MixTexture, ProductTexture, Texture, TextureHandle};

/// That of a surface with holes in which others are cut.
pub fn product(a: &TextureHandle<f32>, b: &TextureHandle<f32>) -> TextureHandle<f32> {
    ProductTexture::new(clamped(a), clamped(b)).into_handle()
}

/// That of a surface of which `amount` is the second. `None` if neither lets rays pass.
pub fn mixed(
    opacities: [Option<&TextureHandle<f32>>; 2],
    amount: &TextureHandle<f32>,
) -> Option<TextureHandle<f32>> {
    if let [None, None] = opacities {
        return None;
    }
    let of = |opacity: Option<_>| opacity.map_or(TextureHandle::Constant(1.0), clamped);
    let [first, second] = opacities.map(of);
    let opacity = MixTexture::new(first, second, clamped(amount)).into_handle();
    Some(opacity).filter(|opacity| opacity.constant() != Some(1.0))
}

/// With values in `[0, 1]`.
fn clamped(texture: &TextureHandle<f32>) -> TextureHandle<f32> {
    match texture.constant() {
        Some(value) => TextureHandle::Constant(value.clamp(0.0, 1.0)),
        None => {
            let texture = texture.clone();
            (move |si: &SurfaceInteraction| texture.evaluate(si).clamp(0.0, 1.0)).into_handle()
        }
    }
}
