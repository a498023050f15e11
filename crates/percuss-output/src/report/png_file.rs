//! The little of PNG (ISO/IEC 15948) that the pictures need: eight bits a channel, not interlaced.

use miniz_oxide::{deflate, inflate};

const SIGNATURE: [u8; 8] = *b"\x89PNG\r\n\x1a\n";
/// Colour types.
const RGB: u8 = 2;
const RGBA: u8 = 6;

/// Width, height and RGBA bytes of a picture, or `None` if it is of another kind or damaged.
pub(super) fn read(file: &[u8]) -> Option<(usize, usize, Vec<u8>)> {
    let mut rest = file.strip_prefix(&SIGNATURE)?;
    let (mut size, mut packed) = (None, Vec::new());
    while let Some((length, after)) = rest.split_first_chunk::<4>() {
        let (name, after) = after.split_first_chunk::<4>()?;
        let length = usize::try_from(u32::from_be_bytes(*length)).ok()?;
        let content = after.get(..length)?;
        match name {
            b"IHDR" => {
                let number = |at: usize| -> Option<usize> {
                    let bytes = content.get(at..at + 4)?.try_into().ok()?;
                    usize::try_from(u32::from_be_bytes(bytes)).ok()
                };
                if content.get(8..)? != [8, RGBA, 0, 0, 0] {
                    return None;
                }
                size = Some((number(0)?, number(4)?));
            }
            b"IDAT" => packed.extend_from_slice(content),
            _ => {}
        }
        rest = after.get(length + 4..)?;
    }
    let (width, height) = size?;
    let lines = inflate::decompress_to_vec_zlib(&packed).ok()?;
    let pixels = unfilter(&lines, 4 * width, 4)?;
    (pixels.len() == 4 * width * height).then_some((width, height, pixels))
}

/// Undoes the filter of every line (section 9 of the standard).
fn unfilter(lines: &[u8], line_length: usize, pixel: usize) -> Option<Vec<u8>> {
    let mut out: Vec<u8> = Vec::with_capacity(lines.len());
    let mut above = vec![0; line_length];
    for line in lines.chunks_exact(line_length + 1) {
        let (filter, mut line) = (line[0], line[1..].to_vec());
        for i in 0..line.len() {
            let (left, corner) =
                if i < pixel { (0, 0) } else { (line[i - pixel], above[i - pixel]) };
            let guess = match filter {
                0 => 0,
                1 => left,
                2 => above[i],
                3 => left.midpoint(above[i]),
                4 => paeth(left, above[i], corner),
                _ => return None,
            };
            line[i] = line[i].wrapping_add(guess);
        }
        out.extend_from_slice(&line);
        above = line;
    }
    Some(out)
}

/// The neighbour closest to left + above - corner.
fn paeth(left: u8, above: u8, corner: u8) -> u8 {
    let guess = i16::from(left) + i16::from(above) - i16::from(corner);
    let distance = |value: u8| (guess - i16::from(value)).abs();
    if distance(left) <= distance(above) && distance(left) <= distance(corner) {
        left
    } else if distance(above) <= distance(corner) {
        above
    } else {
        corner
    }
}

/// A picture of RGB bytes.
pub(super) fn write(width: usize, height: usize, pixels: &[u8]) -> Vec<u8> {
    let mut header = Vec::new();
    for length in [width, height] {
        header.extend_from_slice(&u32::try_from(length).unwrap_or(u32::MAX).to_be_bytes());
    }
    header.extend_from_slice(&[8, RGB, 0, 0, 0]);
    let mut lines = Vec::with_capacity(pixels.len() + height);
    let mut above: &[u8] = &vec![0; 3 * width];
    for line in pixels.chunks_exact((3 * width).max(1)) {
        lines.push(2); // less what is above
        lines.extend(line.iter().zip(above).map(|(value, above)| value.wrapping_sub(*above)));
        above = line;
    }
    let mut file = SIGNATURE.to_vec();
    chunk(&mut file, b"IHDR", &header);
    chunk(&mut file, b"IDAT", &deflate::compress_to_vec_zlib(&lines, 7));
    chunk(&mut file, b"IEND", &[]);
    file
}

fn chunk(file: &mut Vec<u8>, name: &[u8; 4], content: &[u8]) {
    let length = u32::try_from(content.len()).unwrap_or(u32::MAX);
    file.extend_from_slice(&length.to_be_bytes());
    let start = file.len();
    file.extend_from_slice(name);
    file.extend_from_slice(content);
    let checksum = crc32(&file[start..]);
    file.extend_from_slice(&checksum.to_be_bytes());
}

/// The checksum of annex D, bit by bit.
fn crc32(bytes: &[u8]) -> u32 {
    let step = |crc: u32| if crc & 1 == 1 { 0xedb8_8320 ^ (crc >> 1) } else { crc >> 1 };
    let byte = |crc: u32, byte: &u8| (0..8).fold(crc ^ u32::from(*byte), |crc, _| step(crc));
    !bytes.iter().fold(u32::MAX, byte)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_checksum_is_the_known_one() {
        assert_eq!(crc32(b"123456789"), 0xcbf4_3926);
        assert_eq!(crc32(b"IEND"), 0xae42_6082);
    }

    #[test]
    fn every_filter_is_undone() {
        let pixels: Vec<u8> = (0..60_u32).map(|i| (i * i * 7 % 251) as u8).collect();
        let above = |i: usize| if i < 12 { 0 } else { pixels[i - 12] };
        let left = |i: usize| if i % 12 < 4 { 0 } else { pixels[i - 4] };
        let corner = |i: usize| if i < 12 || i % 12 < 4 { 0 } else { pixels[i - 16] };
        let mut lines = Vec::new();
        for line in 0..5_usize {
            lines.push(line as u8); // a filter each
            for i in 12 * line..12 * line + 12 {
                let guess = [
                    0,
                    left(i),
                    above(i),
                    left(i).midpoint(above(i)),
                    paeth(left(i), above(i), corner(i)),
                ];
                lines.push(pixels[i].wrapping_sub(guess[line]));
            }
        }
        assert_eq!(unfilter(&lines, 12, 4), Some(pixels));
    }

    #[test]
    fn a_picture_of_another_kind_is_refused() {
        assert!(read(&write(2, 1, &[1, 2, 3, 4, 5, 6])).is_none(), "no alpha");
        assert!(read(b"GIF89a").is_none());
    }
}
