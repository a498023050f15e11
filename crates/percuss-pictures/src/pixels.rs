//! Pixels of a drawing.

use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::Tree;

use crate::error::Error;
use crate::font;

/// An opaque picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Pixels {
    /// Width and height, shape (2) \[pixels\].
    pub size: [u32; 2],
    /// Red, green, blue; row by row, shape (height, width, 3) \[-\].
    pub rgb: Vec<u8>,
}

impl Pixels {
    /// An SVG text drawn at the largest scale that fits into `size`, on a white page.
    pub fn of_svg(svg: &str, size: [u32; 2]) -> Result<Self, Error> {
        Self::of_tree(&font::read(svg)?, size)
    }

    pub fn of_tree(tree: &Tree, size: [u32; 2]) -> Result<Self, Error> {
        let [width, height] = size;
        let mut map = Pixmap::new(width, height)
            .ok_or_else(|| Error::beyond(format!("{width} x {height} pixels cannot be drawn")))?;
        map.fill(resvg::tiny_skia::Color::WHITE);
        let scale = [width as f32 / tree.size().width(), height as f32 / tree.size().height()];
        resvg::render(tree, Transform::from_scale(scale[0], scale[1]), &mut map.as_mut());
        let rgb = map.pixels().iter().flat_map(|p| [p.red(), p.green(), p.blue()]).collect();
        Ok(Self { size, rgb })
    }

    /// The smallest rectangle in which `other` differs, as left, top, width, height; `None` if the pictures are equal.
    pub fn change(&self, other: &Self) -> Option<[u32; 4]> {
        let width = self.size[0] as usize;
        let stride = 3 * width;
        let rows = || self.rgb.chunks_exact(stride).zip(other.rgb.chunks_exact(stride));
        let top = rows().position(|(a, b)| a != b)?;
        let bottom = self.size[1] as usize - rows().rev().position(|(a, b)| a != b)?;
        let (mut left, mut right) = (width, 0);
        for (a, b) in rows().skip(top).take(bottom - top) {
            let mut columns = a.chunks_exact(3).zip(b.chunks_exact(3));
            if let Some(first) = columns.position(|(a, b)| a != b) {
                left = left.min(first);
                let last = columns.rposition(|(a, b)| a != b).map_or(first, |k| first + 1 + k);
                right = right.max(last + 1);
            }
        }
        Some([left, top, right - left, bottom - top].map(|n| n as u32))
    }

    /// The bytes within a rectangle.
    pub fn part(&self, [left, top, width, height]: [u32; 4]) -> Vec<u8> {
        let [left, top, width, height] = [left, top, width, height].map(|n| n as usize);
        let stride = 3 * self.size[0] as usize;
        let rows = self.rgb.chunks_exact(stride).skip(top).take(height);
        rows.flat_map(|row| &row[3 * left..3 * (left + width)]).copied().collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn changed_pixels_are_enclosed() {
        let blank = Pixels { size: [7, 5], rgb: vec![255; 105] };
        let mut other = blank.clone();
        assert_eq!(blank.change(&other), None);
        for (x, y) in [(2, 1), (5, 3)] {
            other.rgb[3 * (7 * y + x)] = 0;
        }
        assert_eq!(blank.change(&other), Some([2, 1, 4, 3]));
        let part = other.part([2, 1, 4, 3]);
        assert_eq!((part.len(), part[0], part[35 - 2]), (36, 0, 0));
    }

    #[test]
    fn a_drawing_fills_the_picture() {
        let svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"10\" height=\"10\"><rect x=\"5\" width=\"5\" height=\"10\" fill=\"#f00\"/></svg>";
        let pixels = Pixels::of_svg(svg, [20, 20]).unwrap();
        assert_eq!(&pixels.rgb[..3], &[255, 255, 255]);
        assert_eq!(&pixels.rgb[3 * 399..], &[255, 0, 0]);
    }
}
