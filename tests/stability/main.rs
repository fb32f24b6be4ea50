//! The measurements of the stability charts, with few trials: ours keeps its stored bounds, and in each chart there is a
//! parameter at which a common method fails and ours does not.

#[path = "../../src/bin/lobe/stability/mod.rs"]
mod stability;

mod ray_origins;

use stability::sweep::Sweep;

/// Every sweep, with a hundredth of the usual trials: the page has all it needs, ours keeps its bounds, and wins
/// somewhere. Seen to fail with usual methods in the place of ours.
#[test]
fn ours_keeps_its_bounds_and_wins_somewhere() {
    let mut begun = Vec::new();
    let sweeps = stability::all(0.01, &mut |name| begun.push(name.to_owned()));
    assert_eq!(begun, sweeps.iter().map(|sweep| sweep.name).collect::<Vec<_>>());
    for sweep in sweeps {
        let Sweep { name, title, ref about, parameter, log_parameter, measure, .. } = sweep;
        for text in [name, title, about, parameter, measure] {
            assert!(!text.is_empty() && !text.contains("  "), "{name}: {text}");
        }
        assert!(about.ends_with('.') && sweep.fails_from > 0.0, "{name}");
        let joined = |w: &[char]| w[0] == '.' && w[1].is_uppercase();
        let letters: Vec<char> = about.chars().collect();
        assert!(!letters.windows(2).any(joined), "{name}: {about}");
        let Sweep { ref parameters, ref methods, ref bounds, .. } = sweep;
        assert!((8..=30).contains(&parameters.len()) && parameters.is_sorted(), "{name}");
        assert!(!log_parameter || parameters[0] > 0.0, "{name}");
        assert_eq!(bounds.len(), parameters.len(), "{name}");
        assert!((2..=4).contains(&methods.len()), "{name}");
        assert_eq!(methods.iter().filter(|method| method.is_ours).count(), 1, "{name}");
        for method in methods {
            assert_eq!(method.values.len(), parameters.len(), "{name}: {}", method.name);
            assert!(!method.values.iter().any(|&value| value < 0.0), "{name}: {}", method.name);
            assert_eq!(method.name.ends_with("(ours)"), method.is_ours, "{name}: {}", method.name);
        }
        assert_eq!(sweep.broken(), [], "{name}");
        // The page says that no method fails on a lens cut by an edge.
        assert_eq!(sweep.won().is_empty(), name == "disks-edge", "{name}");
    }
}
