//! [`Blocks`]: the blocks of pixels of one part of an OpenEXR file, at the largest resolution.
//!
//! Behind the headers stands a table for each part: 8 bytes for each of its blocks, the position in the file. A block has
//! its part (in files of several parts), its place, the number of its bytes, and these ("OpenEXR File Layout").

use ::exr::block::UncompressedBlock;
use ::exr::block::chunk::{
    Chunk, CompressedBlock, CompressedScanLineBlock, CompressedTileBlock, TileCoordinates,
};
use ::exr::meta::MetaData;
use ::exr::meta::header::Header;
use ::exr::prelude::{Compression, Vec2};

use super::memory::{Refusal, filled, reserve};

/// Where a block of pixels is, and its compressed bytes.
pub struct Block<'a> {
    /// Column and row of the block, counted in blocks.
    place: (usize, usize),
    data: &'a [u8],
}

/// The blocks of one part.
pub struct Blocks<'a> {
    /// The part.
    pub header: &'a Header,
    /// Number of blocks.
    pub count: usize,
    part: usize,
    /// Whether blocks tell their part.
    has_parts: bool,
    /// Columns of blocks.
    columns: usize,
    /// Columns and rows of pixels in a block, which the image's border may cut off.
    size: (usize, usize),
    file: &'a [u8],
    table: &'a [u8],
}

impl<'a> Blocks<'a> {
    /// Finds all blocks in a file whose headers have `behind` bytes. It is refused if any block is missing.
    pub fn find(
        meta: &'a MetaData,
        part: usize,
        file: &'a [u8],
        behind: usize,
    ) -> Result<Self, Refusal> {
        let header = &meta.headers[part];
        let Vec2(width, height) = header.max_block_pixel_size();
        let Vec2(columns, rows) = header.layer_size;
        let (columns, rows) = (columns.div_ceil(width), rows.div_ceil(height));
        // Sides are below 2³⁰ and blocks have at least one pixel. The largest resolution stands first in a table.
        let count = columns * rows;
        let missing =
            |found: usize| format!("it is incomplete: {found} of {count} blocks of pixels");
        let before: u128 =
            meta.headers[..part].iter().map(|header| header.chunk_count as u128).sum();
        let start = behind as u128 + 8 * before;
        let end = start + 8 * count as u128;
        if end > file.len() as u128 {
            return Err(missing(0).into());
        }
        let table = &file[start as usize..end as usize];
        let has_parts = meta.requirements.is_multilayer();
        let size = (width, height);
        let blocks = Self { header, count, part, has_parts, columns, size, file, table };

        let mut is_there = filled(count as u64, false)?;
        for index in 0..count {
            if let Some(block) = blocks.get(index)? {
                is_there[block.place.1 * columns + block.place.0] = true;
            }
        }
        let found = is_there.iter().filter(|&&is_there| is_there).count();
        if found < count { Err(missing(found).into()) } else { Ok(blocks) }
    }

    /// The block at a position of the table. `None` if the file ends before it does, or it was never written.
    pub fn get(&self, index: usize) -> Result<Option<Block<'a>>, String> {
        let Some(position) = self.table[8 * index..].first_chunk() else { return Ok(None) };
        let position = u64::from_le_bytes(*position);
        let in_table = position < 8;
        let rest = usize::try_from(position).ok().and_then(|position| self.file.get(position..));
        let Some(mut rest) = rest.filter(|_| !in_table) else { return Ok(None) };
        let mut number = || {
            let (bytes, behind) = rest.split_first_chunk()?;
            rest = behind;
            Some(i32::from_le_bytes(*bytes))
        };
        let mut read = || {
            let part = if self.has_parts { number()? } else { 0 };
            let (x, y, level) = if self.header.blocks.has_tiles() {
                (number()?, number()?, (number()?, number()?))
            } else {
                // The first row, which begins at the data window's.
                let row =
                    i64::from(number()?) - i64::from(self.header.own_attributes.layer_position.1);
                let row = row.div_euclid(self.size.1 as i64);
                (0, i32::try_from(row).unwrap_or(-1), (0, 0))
            };
            Some((part, x, y, level, number()?))
        };
        let Some((part, x, y, level, bytes)) = read() else { return Ok(None) };
        let rows = self.count / self.columns;
        let inside = |at: i32, count: usize| usize::try_from(at).ok().filter(|&at| at < count);
        let place = inside(x, self.columns).zip(inside(y, rows));
        let is_here = usize::try_from(part) == Ok(self.part) && level == (0, 0);
        let bytes = usize::try_from(bytes).ok();
        let (Some(place), Some(bytes), true) = (place, bytes, is_here) else {
            return Err("it is not a readable EXR file: a block of pixels is out of place".into());
        };
        Ok(rest.get(..bytes).map(|data| Block { place, data }))
    }

    /// Columns and rows of pixels.
    fn extent(&self, block: &Block) -> (usize, usize) {
        let Vec2(width, height) = self.header.layer_size;
        let (x, y) = (block.place.0 * self.size.0, block.place.1 * self.size.1);
        (self.size.0.min(width - x), self.size.1.min(height - y))
    }

    /// Most bytes of memory that decompressing a block takes.
    ///
    /// The decompressors look at the size of their output now and then only. A byte of a run-length code gives up to 64,
    /// a byte of a Huffman code up to 8, and a vector that grows takes twice what is in it.
    pub fn memory(&self, block: &Block) -> Result<u128, String> {
        let (width, height) = self.extent(block);
        let channels = &self.header.channels;
        let pixels = (width * height) as u128;
        let output = pixels * channels.bytes_per_pixel as u128;
        let input = block.data.len() as u128;
        let largest = self.size.0 as u128 * self.size.1 as u128 * channels.bytes_per_pixel as u128;
        if input > largest {
            return Err("it is not a readable EXR file: a block of pixels is too large".into());
        }
        let plain = input + 6 * output;
        // A block that would not shrink is not compressed.
        if input == output {
            return Ok(plain);
        }
        Ok(match self.header.compression {
            Compression::Uncompressed => plain,
            Compression::RLE => plain + 2 * 64 * input,
            Compression::ZIP1 | Compression::ZIP16 | Compression::PXR24 => plain + 3 * 8 * input,
            Compression::DWAA(_) | Compression::DWAB(_) => {
                let samples = (width.next_multiple_of(8) * height.next_multiple_of(8)) as u128
                    * channels.list.len() as u128;
                plain + 3 * 8 * input + dwa_memory(block.data, samples)?
            }
            _ => plain,
        })
    }

    /// Decompresses a block.
    pub fn decompress(&self, block: Block, meta: &MetaData) -> Result<UncompressedBlock, Refusal> {
        let mut data = reserve(block.data.len() as u64)?;
        data.extend_from_slice(block.data);
        let (x, y) = block.place;
        let compressed_block = if self.header.blocks.has_tiles() {
            let coordinates = TileCoordinates { tile_index: Vec2(x, y), level_index: Vec2(0, 0) };
            CompressedBlock::Tile(CompressedTileBlock { coordinates, compressed_pixels_le: data })
        } else {
            let top = self.header.own_attributes.layer_position.1;
            CompressedBlock::ScanLine(CompressedScanLineBlock {
                y_coordinate: top + (y * self.size.1) as i32,
                compressed_pixels_le: data,
            })
        };
        let chunk = Chunk { layer_index: self.part, compressed_block };
        UncompressedBlock::decompress_chunk(chunk, meta, false)
            .map_err(|error| format!("it is not a readable EXR file: {error}").into())
    }
}

/// Most bytes that DWA takes in addition, by the sizes that stand before its data, for this many samples in whole squares of
/// eight by eight.
fn dwa_memory(data: &[u8], samples: u128) -> Result<u128, String> {
    // Eleven numbers; data without them is refused by the decompressor.
    let Some(numbers) = data.first_chunk::<88>() else { return Ok(0) };
    let number = |index: usize| u128::from(u64::from_le_bytes(numbers.as_chunks::<8>().0[index]));
    let [other, runs, raw, ac, dc] = [1, 6, 7, 8, 9].map(number);
    // A sample has at most 4 bytes. Codes of runs take half as much again where there are none.
    if other.max(raw) > 4 * samples || runs > 6 * samples + 8 || ac.max(dc) > samples {
        return Err("it is not a readable EXR file: a block of pixels is too large".into());
    }
    Ok(2 * other + 2 * 64 * runs + 3 * raw + 8 * ac + 10 * dc + 20 * samples)
}
