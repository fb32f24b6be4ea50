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
