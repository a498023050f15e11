//! Drawings for print: SVG as vectors and as pixels.

use resvg::usvg::WriteOptions;

use crate::apng;
use crate::error::Error;
use crate::font;
use crate::mark::marked;
use crate::pdf;
use crate::pixels::Pixels;
use crate::request::PrintFormat;

/// Millimetres per inch.
const INCH: f64 = 25.4;
/// SVG units per inch.
const UNITS: f64 = 96.0;

/// An SVG text with units of 1/96 inch as a file; pixels have `dots` per inch.
///
/// # Errors
/// If the text cannot be drawn.
pub fn picture(svg: &str, format: PrintFormat, dots: f64) -> Result<Vec<u8>, Error> {
    let tree = font::read(svg)?;
    let [width, height] = [tree.size().width(), tree.size().height()].map(f64::from);
    match format {
        PrintFormat::Svg => {
            let plain =
                tree.to_string(&WriteOptions { preserve_text: false, ..WriteOptions::default() });
            let millimetres = |units: f64| format!("{:.3}mm", units * INCH / UNITS);
            let [w, h] = [width, height].map(millimetres);
            let body = plain.split_once('>').map_or("", |(_, rest)| rest);
            Ok(marked(&format!(
                "<svg width=\"{w}\" height=\"{h}\" viewBox=\"0 0 {width} {height}\" \
                 xmlns=\"http://www.w3.org/2000/svg\">{body}"
            ))
            .into_bytes())
        }
        PrintFormat::Pdf => pdf::write(&tree, 72.0 / UNITS),
        PrintFormat::Png => {
            let size = [width, height].map(|n| (n * dots / UNITS).round().max(1.0) as u32);
            apng::png(&Pixels::of_tree(&tree, size)?, Some(dots * 1000.0 / INCH))
        }
    }
}
