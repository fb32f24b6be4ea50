//! The keywords of OBJ that are not read.

/// Whether lines with this first word are valid and ignored: those of the OBJ specification 3.0,
/// with its superseded ones, other than `v`, `vt`, `vn`, `f`, `usemtl` and `mtllib`. An empty word, of a blank line, is
/// ignored too.
pub(super) fn is_ignored(word: &[u8]) -> bool {
    matches!(
        word,
        // Blank lines, names, and what faces look like.
        b"" | b"o" | b"g" | b"s" | b"mg" | b"usemap" | b"maplib"
        // Points, lines, curves and surfaces.
        | b"p" | b"l" | b"vp" | b"cstype" | b"deg" | b"bmat" | b"step" | b"curv" | b"curv2" | b"surf"
        | b"parm" | b"trim" | b"hole" | b"scrv" | b"sp" | b"end" | b"con"
        // How to draw.
        | b"bevel" | b"c_interp" | b"d_interp" | b"lod" | b"shadow_obj" | b"trace_obj" | b"ctech"
        | b"stech"
        // Other files and commands, and superseded curves.
        | b"call" | b"csh" | b"bsp" | b"bzp" | b"cdc" | b"cdp" | b"res"
    )
}
