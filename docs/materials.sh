#!/bin/sh
# Renders the object of assets/materials.toml in each material, or in those named, to docs/materials/NAME.png.
#
#   docs/materials.sh [NAME]...
#
# A line is a name and what `lobe render --set` gets, one word each: no blanks within a word.
materials='
matte        material.object.type="matte"
rough-matte  material.object={type="matte",roughness=1}
mirror       material.object.type="mirror"
glass        material.object={type="glass",eta="glass-bk7"}
rough-glass  material.object={type="glass",eta="glass-bk7",roughness=0.25}
thin-glass   material.object.type="thin-glass"
gold         material.object={type="metal",metal="gold"}
rough-copper material.object={type="metal",metal="copper",roughness=0.25}
brushed      material.object={type="metal",metal="aluminium",roughness=0.05,roughness_v=0.4}
plastic      material.object={type="plastic",kd=[0.1,0.25,0.6]}
rough-plastic material.object={type="plastic",kd=[0.1,0.25,0.6],roughness=0.3}
translucent  material.object={type="translucent",kd=[0.75,0.6,0.3],transmission=0.6}
retro        material.object={type="retro",roughness=0.2,weight=0.8}
mix          material.object={type="mix",first="leaf",second="lacquer"}
'

set -euf # f: brackets in the words are no patterns
cd "$(dirname "$0")/.."
mkdir -p docs/materials
wanted=" $* "
printf '%s' "$materials" | while read -r name sets; do
    case "$name,$wanted" in
        ,*) continue ;;
        *,"  " | *" $name "*) ;;
        *) continue ;;
    esac
    set --
    for word in $sets; do set -- "$@" --set "$word"; done
    echo "$name"
    cargo run --release --quiet -- render --quiet assets/materials.toml "$@" -o "docs/materials/$name.png" </dev/null
done
