//! JPEG files byte by byte, so that tests know what their pixels are (ITU-T T.81): of each component one value everywhere.
#![allow(dead_code, reason = "each test binary uses a part of it")]

/// What the file says.
#[derive(Clone)]
pub struct JpegFile<'a> {
    pub size: [u16; 2],
    /// Value of each component, from 0 to 255, and how many of its samples a unit has in each direction.
    pub components: &'a [(u8, u8)],
    pub is_progressive: bool,
    /// Units between two restart markers; 0 for none.
    pub restart: u16,
    /// The transform of an Adobe segment, without which three components are luma and chroma.
    pub adobe: Option<u8>,
}

impl JpegFile<'_> {
    pub fn bytes(&self) -> Vec<u8> {
        let mut bytes = self.head();
        bytes.extend(self.scan());
        bytes.extend([0xFF, 0xD9]);
        bytes
    }

    /// All that stands before the pixels.
    pub fn head(&self) -> Vec<u8> {
        let mut bytes = vec![0xFF, 0xD8];
        let mut segment = |marker: u8, contents: &[u8]| {
            bytes.extend([0xFF, marker]);
            bytes.extend((contents.len() as u16 + 2).to_be_bytes());
            bytes.extend(contents);
        };
        if let Some(transform) = self.adobe {
            segment(0xEE, &[b"Adobe\0\x64\0\0\0\0", &[transform][..]].concat());
        }
        // A factor of 8 for the first coefficient, which is 8 times the mean of a block.
        segment(0xDB, &[&[0][..], &[8; 64]].concat());
        let count = self.components.len() as u8;
        let [width, height] = self.size.map(u16::to_be_bytes);
        let mut frame = [&[8][..], &height, &width, &[count]].concat();
        let mut scan = vec![count];
        for (index, (_, samples)) in self.components.iter().enumerate() {
            frame.extend([index as u8 + 1, samples << 4 | samples, 0]);
            scan.extend([index as u8 + 1, 0]);
        }
        segment(if self.is_progressive { 0xC2 } else { 0xC0 }, &frame);
        // Sizes from 0 to 8 have the codes 0000 to 1000; the end of a block has the code 0.
        segment(0xC4, &[&[0, 0, 0, 0, 9][..], &[0; 12], &[0, 1, 2, 3, 4, 5, 6, 7, 8]].concat());
        segment(0xC4, &[&[0x10, 1][..], &[0; 15], &[0]].concat());
        if self.restart > 0 {
            segment(0xDD, &self.restart.to_be_bytes());
        }
        scan.extend(if self.is_progressive { [0, 0, 0] } else { [0, 63, 0] });
        segment(0xDA, &scan);
        bytes
    }

    fn scan(&self) -> Vec<u8> {
        let most = self.components.iter().map(|(_, samples)| *samples).max().unwrap_or(1);
        // A scan of one component has a unit for each block.
        let is_alone = self.components.len() == 1;
        let side = if is_alone { 8 } else { 8 * u32::from(most) };
        let [columns, rows] = self.size.map(|size| u32::from(size).div_ceil(side));
        let (mut bytes, mut bits) = (Vec::new(), Bits::default());
        for unit in 0..columns * rows {
            let restart = u32::from(self.restart);
            let begins = unit == 0 || restart > 0 && unit % restart == 0;
            if begins && unit > 0 {
                bytes.extend(std::mem::take(&mut bits).finish());
                bytes.extend([0xFF, 0xD0 | ((unit / restart - 1) % 8) as u8]);
            }
            for &(value, samples) in self.components {
                let blocks = if is_alone { 1 } else { samples * samples };
                for block in 0..blocks {
                    // Differences to the block before.
                    let is_first = begins && block == 0;
                    bits.first(if is_first { i32::from(value) - 128 } else { 0 });
                    if !self.is_progressive {
                        bits.push(0, 1);
                    }
                }
            }
        }
        bytes.extend(bits.finish());
        bytes
    }
}

#[derive(Default)]
struct Bits {
    bits: Vec<bool>,
}

impl Bits {
    fn push(&mut self, value: u32, count: u32) {
        self.bits.extend((0..count).rev().map(|bit| value >> bit & 1 == 1));
    }

    fn first(&mut self, value: i32) {
        let size = i32::BITS - value.abs().leading_zeros();
        self.push(size, 4);
        let code = if value < 0 { value + (1 << size) - 1 } else { value };
        self.push(code as u32, size);
    }

    fn finish(mut self) -> Vec<u8> {
        self.bits.resize(self.bits.len().next_multiple_of(8), true);
        let byte = |bits: &[bool]| bits.iter().fold(0, |byte, &bit| byte << 1 | u8::from(bit));
        let stuffed = |byte: u8| if byte == 0xFF { vec![byte, 0] } else { vec![byte] };
        self.bits.chunks(8).map(byte).flat_map(stuffed).collect()
    }
}
