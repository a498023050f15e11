//! PNG files in memory.

use png::{BitDepth, ColorType, Compression, Decoder, Encoder};

/// Width, height and RGBA bytes of a picture, or `None` if it is of another kind or damaged.
pub(super) fn read(file: &[u8]) -> Option<(usize, usize, Vec<u8>)> {
    let mut reader = Decoder::new(std::io::Cursor::new(file)).read_info().ok()?;
    let mut pixels = vec![0; reader.output_buffer_size()?];
    let info = reader.next_frame(&mut pixels).ok()?;
    let expected = info.color_type == ColorType::Rgba && info.bit_depth == BitDepth::Eight;
    pixels.truncate(info.buffer_size());
    expected.then_some((info.width as usize, info.height as usize, pixels))
}

/// A picture of RGB bytes.
///
/// # Errors
/// If the size does not fit the bytes.
pub(super) fn write(width: usize, height: usize, pixels: &[u8]) -> Result<Vec<u8>, String> {
    let side = |n: usize| u32::try_from(n).map_err(|e| e.to_string());
    let mut file = Vec::new();
    let mut encoder = Encoder::new(&mut file, side(width)?, side(height)?);
    encoder.set_color(ColorType::Rgb);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_compression(Compression::Fast);
    let mut writer = encoder.write_header().map_err(|e| e.to_string())?;
    writer.write_image_data(pixels).map_err(|e| e.to_string())?;
    writer.finish().map_err(|e| e.to_string())?;
    Ok(file)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_rgba_is_read_and_rgb_is_written() {
        let rgb: Vec<u8> = (0..36).collect();
        let file = write(4, 3, &rgb).unwrap();
        assert_eq!(read(&file), None);
        assert_eq!(read(&file[..20]), None);
        assert!(write(5, 3, &rgb).is_err());
    }
}
