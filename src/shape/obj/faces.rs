//! [`Faces`]: the parser of `f` lines, which yields triangles with validated indices.

use super::error::{ObjAttribute, ObjProblem, excerpt};
use super::lines::is_blank;
use super::report::SkippedLines;

/// Marks a corner without a texture coordinate or without a normal.
pub(super) const NONE: u32 = u32::MAX;

/// The triangles of all faces. Polygons are triangulated as fans around their first corner, as tobj
/// does.
///
/// Indices count from 0. They are known to be in range once [`Faces::finish`] has succeeded.
#[derive(Default)]
pub(super) struct Faces {
    /// Vertex indices of each triangle.
    pub vertices: Vec<[u32; 3]>,
    /// Texture coordinate indices of each triangle, or [`NONE`]. Empty until a corner has one.
    pub textures: Vec<[u32; 3]>,
    /// Normal indices of each triangle, or [`NONE`]. Empty until a corner has one.
    pub normals: Vec<[u32; 3]>,
    /// Faces with fewer than three corners.
    pub short: SkippedLines,
    /// Scratch: the corners of the current face, as vertex, texture coordinate and normal.
    corners: Vec<[u32; 3]>,
    /// References to elements after the face, to be checked at the end. Of each kind, only those
    /// that exceed all earlier ones.
    forward: Vec<ForwardReference>,
    /// The highest index among these, by kind.
    highest: [i64; 3],
}

/// A reference to an element that was not read yet.
struct ForwardReference {
    attribute: ObjAttribute,
    index: i64,
    line: u64,
}

impl Faces {
    /// Parses the face on `line`. `text` is what follows the `f`. `counts` are the numbers of
    /// vertices, texture coordinates and normals above it. A face with fewer than three corners is
    /// counted and skipped.
    pub fn add(&mut self, text: &[u8], line: u64, counts: [usize; 3]) -> Result<(), ObjProblem> {
        self.corners.clear();
        let mut at = 0;
        while let Some(start) = text[at..].iter().position(|&b| !is_blank(b)) {
            let (corner, length) = self.corner(&text[at + start..], line, counts)?;
            self.corners.push(corner);
            at += start + length;
        }
        if self.corners.len() < 3 {
            self.short.add(line);
            return Ok(());
        }

        for i in 1..self.corners.len() - 1 {
            let [a, b, c] = [self.corners[0], self.corners[i], self.corners[i + 1]];
            let triangle = self.vertices.len();
            self.vertices.push([a[0], b[0], c[0]]);
            push_named(&mut self.textures, triangle, [a[1], b[1], c[1]]);
            push_named(&mut self.normals, triangle, [a[2], b[2], c[2]]);
        }
        Ok(())
    }

    /// Validates forward references. `counts` are the totals of the file. An error comes with its
    /// line.
    pub fn finish(&mut self, counts: [usize; 3]) -> Result<(), (u64, ObjProblem)> {
        // OBJ allows forward references, and tobj accepts them.
        for &ForwardReference { attribute, index, line } in &self.forward {
            let count = counts[attribute as usize];
            if index > count as i64 {
                return Err((line, ObjProblem::BeyondEnd { attribute, index, count }));
            }
        }

        // Pads for the triangles after the last one with texture coordinates or normals.
        for named in [&mut self.textures, &mut self.normals] {
            if !named.is_empty() {
                named.resize(self.vertices.len(), [NONE; 3]);
            }
        }
        Ok(())
    }

    /// Parses one corner at the start of `text`. Returns it with its length in bytes.
    #[inline]
    fn corner(
        &mut self,
        text: &[u8],
        line: u64,
        counts: [usize; 3],
    ) -> Result<([u32; 3], usize), ObjProblem> {
        let mut corner = [NONE; 3];
        let mut at = 0;
        for attribute in ObjAttribute::ALL {
            let (index, length) = integer(&text[at..]);
            at += length;
            match index {
                Some(index) => {
                    corner[attribute as usize] = self.resolve(attribute, index, line, counts)?;
                }
                // An empty field means no index; only the vertex is mandatory.
                None if length == 0 && attribute != ObjAttribute::Vertex => {}
                None => return Err(bad_corner(text)),
            }
            match text.get(at) {
                Some(b'/') if attribute != ObjAttribute::Normal => at += 1,
                Some(&b) if !is_blank(b) => return Err(bad_corner(text)),
                _ => break,
            }
        }
        Ok((corner, at))
    }

    /// Converts an index of the file to one that counts from 0.
    #[inline]
    fn resolve(
        &mut self,
        attribute: ObjAttribute,
        index: i64,
        line: u64,
        counts: [usize; 3],
    ) -> Result<u32, ObjProblem> {
        let count = counts[attribute as usize];
        if index > 0 {
            if index > count as i64 && index > self.highest[attribute as usize] {
                self.highest[attribute as usize] = index;
                self.forward.push(ForwardReference { attribute, index, line });
            }
            // The cast may truncate, but then `finish` reports the index: no count is that high.
            Ok((index - 1) as u32)
        } else if index == 0 {
            Err(ObjProblem::IndexZero { attribute })
        } else if index + (count as i64) < 0 {
            Err(ObjProblem::BeforeStart { attribute, index, count })
        } else {
            Ok((index + count as i64) as u32)
        }
    }
}

/// Appends a triangle's indices, unless no triangle so far has any.
#[inline]
fn push_named(named: &mut Vec<[u32; 3]>, triangle: usize, corners: [u32; 3]) {
    if !named.is_empty() {
        named.push(corners);
    } else if corners != [NONE; 3] {
        named.resize(triangle, [NONE; 3]);
        named.push(corners);
    }
}

/// Parses an integer with an optional sign. Returns it with its length in bytes. `None` if there is
/// none, or if it has more than 18 digits, which no valid index has.
#[inline]
fn integer(text: &[u8]) -> (Option<i64>, usize) {
    let sign = usize::from(matches!(text.first(), Some(b'-' | b'+')));
    let mut value = 0i64;
    let mut at = sign;
    while let Some(digit @ b'0'..=b'9') = text.get(at) {
        if at - sign == 18 {
            return (None, at);
        }
        value = value * 10 + i64::from(digit - b'0');
        at += 1;
    }
    let value = if text.first() == Some(&b'-') { -value } else { value };
    ((at > sign).then_some(value), at)
}

#[cold]
fn bad_corner(text: &[u8]) -> ObjProblem {
    let end = text.iter().position(|&b| is_blank(b)).unwrap_or(text.len());
    match excerpt("f", &text[..end]) {
        Ok(text) => ObjProblem::BadCorner { text },
        Err(problem) => problem,
    }
}
