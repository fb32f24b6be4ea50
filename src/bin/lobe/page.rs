//! What all HTML pages share: their beginning, their style, and pictures within them.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use lobe::glam::UVec2;
use lobe::image::{EncodeError, encode_png};
use lobe::metrics::chart::escape;

/// CSS rules of all pages.
const STYLE: &str = "\
:root{color-scheme:light dark}
body{font:15px/1.5 system-ui,-apple-system,'Segoe UI',Roboto,Helvetica,Arial,sans-serif;max-width:900px;margin:0 auto;padding:12px;color:#222;background:#fff}
h1{font-size:22px}h2{font-size:17px;margin-top:28px}
svg.lobe{display:block;max-width:720px;width:100%;margin:12px 0}
table{border-collapse:collapse;font-size:13px;display:block;overflow-x:auto}
td,th{padding:3px 9px;text-align:right;border-bottom:1px solid #ddd;white-space:nowrap}
td:first-child,th:first-child{text-align:left}
figure{margin:0}figcaption{font-size:12.5px;line-height:1.35;margin:3px 0 10px}
.grid{display:grid;grid-template-columns:repeat(auto-fill,minmax(260px,1fr));gap:12px}
.pair{display:grid;grid-template-columns:1fr 1fr;gap:3px}
img{width:100%;image-rendering:pixelated;display:block}
.ok{color:#007a55}.fault{color:#c22}
.whole{max-width:600px;image-rendering:auto}
@media(prefers-color-scheme:dark){body{color:#e6e6e6;background:#0d1117}.ok{color:#00c08b}.fault{color:#ff7b72}td,th{border-color:#30363d}}
";

/// A page up to its heading, which is its title.
pub fn begin(title: &str) -> String {
    let title = escape(title);
    format!(
        "<!doctype html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n\
         <title>{title}</title>\n<style>\n{STYLE}</style>\n<h1>{title}</h1>\n"
    )
}

/// A PNG file as a data URL.
pub fn data(size: UVec2, codes: &[u8]) -> Result<String, EncodeError> {
    Ok(format!("data:image/png;base64,{}", STANDARD.encode(encode_png(size, codes)?)))
}
