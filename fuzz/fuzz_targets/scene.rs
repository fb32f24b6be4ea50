//! Any text as a scene file: an error of one line that names the place, or a scene.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    if let Err(error) = lobe::scene_file::parse_scene("fuzz.toml".as_ref(), text, &[]) {
        let message = error.to_string();
        assert!(message.starts_with("fuzz.toml") && !message.contains('\n'), "{message}");
    }
});
