//! Compaction: pushing those of four lanes that a mask selects.

/// Pushes the values whose bits in the mask are set.
///
/// Branch-free unless all are set: each value is pushed, and removed again by `truncate` if its bit is clear.
/// Branches on the bits would be mispredicted.
#[inline(always)]
pub fn push_x4<T: Copy>(to: &mut Vec<T>, mask: u32, values: &[T; 4]) {
    if mask == 0b1111 {
        to.extend_from_slice(values);
        return;
    }
    for (i, &value) in values.iter().enumerate() {
        to.push(value);
        to.truncate(to.len() - (!mask >> i & 1) as usize);
    }
}
