//! OpenEXR files byte by byte, so that tests can have them say what no program would write ("OpenEXR File Layout").
#![allow(dead_code, reason = "each test binary uses a part of it")]

/// Attributes of a file of scan lines with float channels of these names, in order of the alphabet.
pub struct ExrFile<'a> {
    pub channels: &'a [&'a str],
    pub size: [i32; 2],
    /// 0 for none (one line in a block), 1 for RLE (one), 3 for ZIP (16).
    pub compression: u8,
}

impl ExrFile<'_> {
    /// Magic number, version, and the header.
    pub fn header(&self) -> Vec<u8> {
        let mut bytes = b"\x76\x2f\x31\x01\x02\0\0\0".to_vec();
        let mut push = |name: &str, kind: &str, value: &[u8]| {
            bytes.extend(format!("{name}\0{kind}\0").bytes());
            bytes.extend((value.len() as u32).to_le_bytes());
            bytes.extend(value);
        };
        let float = 2;
        let channel = |name: &&str| [name.as_bytes(), &[0], &integers([float, 0, 1, 1])].concat();
        let channels = self.channels.iter().flat_map(channel).chain([0]).collect::<Vec<u8>>();
        let window = integers([0, 0, self.size[0] - 1, self.size[1] - 1]);
        push("channels", "chlist", &channels);
        push("compression", "compression", &[self.compression]);
        push("dataWindow", "box2i", &window);
        push("displayWindow", "box2i", &window);
        push("lineOrder", "lineOrder", &[0]);
        push("pixelAspectRatio", "float", &1_f32.to_le_bytes());
        push("screenWindowCenter", "v2f", &[0; 8]);
        push("screenWindowWidth", "float", &1_f32.to_le_bytes());
        bytes.push(0);
        bytes
    }

    /// The file with these blocks, each with the row that it begins at.
    pub fn with_blocks<'b>(&self, blocks: impl Iterator<Item = (i32, &'b [u8])>) -> Vec<u8> {
        let header = self.header();
        let blocks: Vec<_> = blocks.collect();
        let (mut table, mut body) = (Vec::new(), Vec::new());
        for (row, data) in &blocks {
            let position = header.len() + 8 * blocks.len() + body.len();
            table.extend((position as u64).to_le_bytes());
            body.extend(integers([*row, data.len() as i32]));
            body.extend_from_slice(data);
        }
        [header, table, body].concat()
    }

    /// The file without compression, all of whose pixels have the value 1 in all channels.
    pub fn of_ones(&self) -> Vec<u8> {
        let row = 1_f32.to_le_bytes().repeat(self.channels.len() * self.size[0] as usize);
        self.with_blocks((0..self.size[1]).map(|y| (y, &row[..])))
    }
}

fn integers<const N: usize>(numbers: [i32; N]) -> Vec<u8> {
    numbers.into_iter().flat_map(i32::to_le_bytes).collect()
}
