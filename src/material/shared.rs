//! [`Shared`]: losses of facets, made once for all materials of one roughness.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError, Weak};

use crate::bxdf::Roughnesses;

/// What has been made and is still in use, by index of refraction and roughness. Exported models have hundreds of materials of few roughnesses.
pub struct Shared<T>(Mutex<BTreeMap<Key, Weak<T>>>);

/// Bits of an index of refraction and of a roughness; `None` of any roughness.
type Key = (u32, Option<[u32; 2]>);

impl<T> Shared<T> {
    pub const fn new() -> Self {
        Self(Mutex::new(BTreeMap::new()))
    }

    /// What a material uses that has this index and this roughness, or what `make` returns for a new one. Two threads may make the same.
    pub fn get(&self, eta: f32, roughnesses: Roughnesses, make: impl FnOnce() -> T) -> Arc<T> {
        let alpha = match roughnesses {
            Roughnesses::Constant(alpha) => Some(alpha.map(f32::to_bits)),
            Roughnesses::Any => None,
        };
        let key = (eta.to_bits(), alpha);
        let all = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(known) = all().get(&key).and_then(Weak::upgrade) {
            return known;
        }
        let made = Arc::new(make());
        let mut all = all();
        all.retain(|_, known| known.strong_count() > 0);
        all.insert(key, Arc::downgrade(&made));
        made
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of the same index and roughness there is one, as long as it is used; nothing is kept that is not.
    ///
    /// Caught: an index or a roughness that is not part of the key; what is no longer used kept.
    #[test]
    fn what_is_used_is_made_once() {
        let shared = Shared::new();
        let constant = |x, y| Roughnesses::Constant([x, y]);
        let keys =
            [(1.5, constant(0.1, 0.2)), (1.5, constant(0.2, 0.1)), (1.4, constant(0.1, 0.2))];
        let keys = keys.into_iter().chain([(1.5, Roughnesses::Any)]);
        let made: Vec<_> = keys
            .clone()
            .enumerate()
            .map(|(i, (eta, alpha))| shared.get(eta, alpha, || i))
            .collect();
        for (i, (eta, alpha)) in keys.enumerate() {
            let again = shared.get(eta, alpha, || 99);
            assert!(Arc::ptr_eq(&again, &made[i]) && *again == i, "{i}: {again}");
        }
        drop(made);
        assert_eq!(*shared.get(1.5, Roughnesses::Any, || 7), 7);
        assert_eq!(shared.0.lock().unwrap().len(), 1);
    }
}
