//! [`Faces`]: the `f` lines, as triangles of checked indices.

use super::error::{ObjAttribute, ObjProblem, excerpt};
use super::lines::is_blank;

/// Stands for the texture coordinate or normal that a corner does not name.
pub(super) const NONE: u32 = u32::MAX;

/// The triangles of all faces: polygons are cut into fans around their first corner, as tobj does.
///
/// Every index counts from 0 and is in range once [`Faces::finish`] has been called.
#[derive(Default)]
pub(super) struct Faces {
    /// The vertices of each triangle.
    pub vertices: Vec<[u32; 3]>,
    /// Texture coordinates by corner, or [`NONE`]; empty as long as no corner names one.
    pub textures: Vec<[u32; 3]>,
    /// Normals by corner, or [`NONE`]; empty as long as no corner names one.
    pub normals: Vec<[u32; 3]>,
    /// The corners of the face at hand: vertex, texture coordinate, normal.
    corners: Vec<[u32; 3]>,
    /// The indices that were out of range at their own line, each the highest so far of its kind.
    ahead: Vec<Ahead>,
    highest: [i64; 3],
}

/// A reference to something that has not been read yet.
struct Ahead {
    attribute: ObjAttribute,
    index: i64,
    line: u64,
}

impl Faces {
    /// Takes the face on `line` in. `text` is what follows the `f`, and `counts` says how many
    /// vertices, texture coordinates and normals stand above it.
    pub fn add(&mut self, text: &[u8], line: u64, counts: [usize; 3]) -> Result<(), ObjProblem> {
        self.corners.clear();
        let mut at = 0;
        while let Some(start) = text[at..].iter().position(|&b| !is_blank(b)) {
            let (corner, length) = self.corner(&text[at + start..], line, counts)?;
            self.corners.push(corner);
            at += start + length;
        }
        if self.corners.len() < 3 {
            return Err(ObjProblem::FewCorners { found: self.corners.len() });
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

    /// Checks what could not be checked before all was read; `counts` is for the whole file. The
    /// problem comes with its line.
    pub fn finish(&mut self, counts: [usize; 3]) -> Result<(), (u64, ObjProblem)> {
        // OBJ lets faces refer to what comes later, and tobj accepts it.
        for &Ahead { attribute, index, line } in &self.ahead {
            let count = counts[attribute as usize];
            if index > count as i64 {
                return Err((line, ObjProblem::BeyondEnd { attribute, index, count }));
            }
        }

        // Triangles after the last one that names any.
        for named in [&mut self.textures, &mut self.normals] {
            if !named.is_empty() {
                named.resize(self.vertices.len(), [NONE; 3]);
            }
        }
        Ok(())
    }

    /// Reads one corner from the beginning of `text`. Returns it with its length in bytes.
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
                // What is empty is not named, but a vertex has to be.
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

    /// Turns an index of the file into one that counts from 0.
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
                self.ahead.push(Ahead { attribute, index, line });
            }
            // Where this cuts bits off, `finish` reports the index: no count is that high.
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

/// Pushes the corners of a triangle if it or one before it names anything.
#[inline]
fn push_named(named: &mut Vec<[u32; 3]>, triangle: usize, corners: [u32; 3]) {
    if !named.is_empty() {
        named.push(corners);
    } else if corners != [NONE; 3] {
        named.resize(triangle, [NONE; 3]);
        named.push(corners);
    }
}

/// Reads a whole number with an optional sign. Returns it with its length in bytes; `None` if there
/// is none, or if it has more than 18 digits, which no index needs.
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
