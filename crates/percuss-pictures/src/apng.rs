//! Pictures as PNG, still or animated.

use std::io::Write;

use png::{BitDepth, BlendOp, ColorType, DisposeOp, Encoder, PixelDimensions, Unit, Writer};

use crate::error::Error;
use crate::mark::MARK;
use crate::pixels::Pixels;

/// A film that is written frame by frame; only the changed rectangle of each frame is stored.
pub(crate) struct Apng<W: Write> {
    writer: Writer<W>,
    shown: Option<Pixels>,
}

impl<W: Write> Apng<W> {
    /// A film with the given number of frames and frames per second.
    pub fn new(to: W, size: [u32; 2], frames: usize, fps: f64) -> Result<Self, Error> {
        let mut encoder = encoder(to, size)?;
        encoder.set_animated(frames as u32, 0).map_err(Error::drawing)?;
        let (numerator, denominator) = fraction(fps);
        encoder.set_frame_delay(numerator, denominator).map_err(Error::drawing)?;
        Ok(Self { writer: encoder.write_header().map_err(Error::drawing)?, shown: None })
    }

    /// Appends a frame.
    pub fn push(&mut self, pixels: Pixels) -> Result<(), Error> {
        let [width, height] = pixels.size;
        // A frame has at least one pixel, even without changes.
        let part = match &self.shown {
            Some(shown) => shown.change(&pixels).unwrap_or([0, 0, 1, 1]),
            None => [0, 0, width, height],
        };
        let [left, top, width, height] = part;
        if self.shown.is_some() {
            // This order keeps the rectangle within the picture at any time.
            self.writer.reset_frame_position().map_err(Error::drawing)?;
            self.writer.set_frame_dimension(width, height).map_err(Error::drawing)?;
            self.writer.set_frame_position(left, top).map_err(Error::drawing)?;
            self.writer.set_blend_op(BlendOp::Source).map_err(Error::drawing)?;
            self.writer.set_dispose_op(DisposeOp::None).map_err(Error::drawing)?;
        }
        self.writer.write_image_data(&pixels.part(part)).map_err(Error::drawing)?;
        self.shown = Some(pixels);
        Ok(())
    }

    /// Completes the file.
    pub fn finish(self) -> Result<(), Error> {
        self.writer.finish().map_err(Error::drawing)
    }
}

/// A still picture; `per_metre` pixels per metre on paper.
pub(crate) fn png(pixels: &Pixels, per_metre: Option<f64>) -> Result<Vec<u8>, Error> {
    let mut file = Vec::new();
    let mut encoder = encoder(&mut file, pixels.size)?;
    if let Some(per_metre) = per_metre {
        let density = per_metre.round() as u32;
        encoder.set_pixel_dims(Some(PixelDimensions {
            xppu: density,
            yppu: density,
            unit: Unit::Meter,
        }));
    }
    let mut writer = encoder.write_header().map_err(Error::drawing)?;
    writer.write_image_data(&pixels.rgb).map_err(Error::drawing)?;
    writer.finish().map_err(Error::drawing)?;
    Ok(file)
}

fn encoder<W: Write>(to: W, [width, height]: [u32; 2]) -> Result<Encoder<'static, W>, Error> {
    let mut encoder = Encoder::new(to, width, height);
    encoder.set_color(ColorType::Rgb);
    encoder.set_depth(BitDepth::Eight);
    encoder.add_text_chunk("Comment".to_owned(), MARK.to_owned()).map_err(Error::drawing)?;
    Ok(encoder)
}

/// Duration of a frame as a fraction \[s\].
fn fraction(fps: f64) -> (u16, u16) {
    match fps {
        fps if fps.fract() == 0.0 && fps <= f64::from(u16::MAX) => (1, fps as u16),
        fps => ((1000.0 / fps).round().clamp(1.0, f64::from(u16::MAX)) as u16, 1000),
    }
}
