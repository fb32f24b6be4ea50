//! The page of the scene format, as Markdown: `docs/scene-format.md`.

use lobe::params::{AnyKey, AnySection};
use lobe::scene_file::SECTIONS;

use super::table::sentence;

const BEFORE: &str = "\
# The scene format

<!-- Made by `cargo run --release -- help scene-format > docs/scene-format.md`: change the keys' declarations, or
src/bin/lobe/help/page.rs, and make it again. A test compares both. -->

A scene is a [TOML](https://toml.io) file of tables. All tables may be left out, and so may all keys but those that are
required. Keys that are not known are errors, and so are keys that mean nothing beside the others of their table.

```toml
[camera]
eye = [-3.0, 2.0, -3.0]
look_at = [0.0, 1.0, 0.0]

[integrator]
type = \"path\"

[material.clay]
type = \"matte\"
kd = [0.6, 0.3, 0.2]

[light.sky]
type = \"sky\"
radiance = [1.0, 1.0, 1.0]

[shape.floor]
type = \"rectangle\"
material = \"clay\"
corner = [-5.0, 0.0, -5.0]
edges = [[0.0, 0.0, 10.0], [10.0, 0.0, 0.0]]
```

- **Names.** `NAME` in `[material.NAME]` is yours. Materials name textures, shapes name materials. A key that takes a
  texture's name takes a constant in its place; the range is that of constants. Textures may only name textures above them.
- **Space** is left-handed, as in PBRT: with x to the right and y up, z points away from you. Worlds that were made in
  right-handed programs are seen unmirrored with `handedness = \"right\"` in `[camera]`. The outside of a surface is
  where the cross product of two edges points, from the first corner to the second and to the third. Coordinates go up
  to 1e12 scene units.
- **Transforms** of a shape: it is first scaled, then rotated, then translated, in whatever order the keys stand.
- **Units.** Lengths are in scene units, angles in degrees, colours are linear RGB (Rec. 709). Radiance is in
  W / (m² sr) if a scene unit is a metre. All numbers are finite.
- **Paths** are relative to the folder of the scene file; in an override, to the current directory.
- **Overrides**, `--set KEY=VALUE`, replace or add a value, in TOML: `--set camera.fov=40`,
  `--set 'shape.dragon.obj=\"mine.obj\"'`. Later ones win. They cannot add a texture, material, light or shape.
";

/// The whole page.
pub fn page() -> String {
    SECTIONS.iter().map(|section| self::section(*section)).fold(BEFORE.into(), |page, s| page + &s)
}

fn section(section: &dyn AnySection) -> String {
    let name = if section.is_named() { ".NAME" } else { "" };
    let mut text = format!("\n## `[{}{name}]`\n", section.key());
    let selector = section.selector();
    let kinds = section.kinds();
    let names: Vec<_> = kinds.iter().map(|kind| format!("`{:?}`", kind.name)).collect();
    let default = match section.default() {
        Some(default) => format!("`{default:?}` by default"),
        None => "required".into(),
    };
    text += &format!("\n`{selector}` is {}; {default}.\n", names.join(", "));
    if !section.common().is_empty() {
        text += &format!("\nWith any `{selector}`:\n\n");
        text += &table(section.common());
    }
    for kind in kinds {
        text += &format!("\n### `{selector} = {:?}`\n\n{}.\n", kind.name, kind.meaning);
        if !kind.keys.is_empty() {
            text += &format!("\n{}", table(kind.keys));
        }
    }
    text
}

fn table(keys: &[&dyn AnyKey]) -> String {
    let row = |key: &&dyn AnyKey| {
        let default = match key.default_text() {
            Some(default) if default == "none" => default,
            Some(default) => format!("`{default}`"),
            None => "required".into(),
        };
        let (name, meaning) = (key.name(), sentence(key.meaning()));
        format!("| `{name}` | {} | {default} | {meaning} |\n", key.expected())
    };
    let rows: String = keys.iter().map(row).collect();
    format!("| key | value | default | meaning |\n|---|---|---|---|\n{rows}")
}
