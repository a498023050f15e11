//! Animated GIF: one palette for all frames, and only the changed part of every frame.

use std::collections::HashMap;
use std::io::Write;

use color_quant::NeuQuant;
use gif::{DisposalMethod, Encoder, Frame, Repeat};

use crate::error::Error;
use crate::mark::MARK;
use crate::pixels::Pixels;

/// Colours of the palette; one more index leaves a pixel unchanged.
const COLOURS: usize = 255;
/// Number of the most frequent colours that are not changed: the page, the beams, the lines.
const EXACT: usize = 96;
/// Limit of the count of a colour in the choice of the others, so that thin arrows keep their colours beside wide walls.
const WEIGHT: usize = 40;
/// Sampling of the choice of the others, from 1 (best) to 30.
const SAMPLING: i32 = 3;

/// Palette for all colours of a film.
pub(crate) struct Palette {
    /// Red, green and blue of each colour, shape (colours, 3) \[-\].
    colours: Vec<[u8; 3]>,
    /// Colours looked up before, with their numbers, shape (3) \[-\].
    known: HashMap<[u8; 3], u8>,
}

impl Palette {
    /// The palette of the given frames.
    pub fn of(frames: &[Pixels]) -> Self {
        let mut counts: HashMap<[u8; 3], usize> = HashMap::new();
        for row in frames.iter().flat_map(|f| f.rgb.as_chunks::<3>().0.chunk_by(|a, b| a == b)) {
            *counts.entry(row[0]).or_insert(0) += row.len();
        }
        let mut counts: Vec<([u8; 3], usize)> = counts.into_iter().collect();
        counts.sort_by(|a, b| b.1.cmp(&a.1).then(a.0.cmp(&b.0)));
        let mut colours: Vec<[u8; 3]> = counts.iter().take(COLOURS).map(|c| c.0).collect();
        if counts.len() > COLOURS {
            colours.truncate(EXACT);
            let repeated =
                |(c, n): &([u8; 3], usize)| std::iter::repeat_n(*c, 1 + (*n).min(WEIGHT));
            let rest = counts[EXACT..].iter().flat_map(repeated);
            let rgba: Vec<u8> = rest.flat_map(|[r, g, b]| [r, g, b, 255]).collect();
            let map = NeuQuant::new(SAMPLING, COLOURS - EXACT, &rgba).color_map_rgb();
            colours.extend_from_slice(map.as_chunks::<3>().0);
        }
        Self { colours, known: HashMap::new() }
    }

    /// Number of the colour nearest to one.
    fn index(&mut self, colour: [u8; 3]) -> u8 {
        let colours = &self.colours;
        *self.known.entry(colour).or_insert_with(|| {
            let distance = |other: &[u8; 3]| -> i32 {
                (0..3).map(|k| (i32::from(colour[k]) - i32::from(other[k])).pow(2)).sum()
            };
            let nearest = colours.iter().enumerate().min_by_key(|(_, other)| distance(other));
            nearest.map_or(0, |(k, _)| k as u8)
        })
    }
}

/// A film that is written frame by frame.
pub(crate) struct Gif<W: Write> {
    encoder: Encoder<W>,
    palette: Palette,
    /// Width and height, shape (2) \[pixels\].
    size: [u32; 2],
    /// Indices of the current frame, shape (pixels) \[index of a colour\].
    shown: Vec<u8>,
    /// The frame whose duration is not yet known, and its duration so far \[1/100 s\].
    waiting: Option<(Frame<'static>, u64)>,
    /// End of each frame in the file, shape (frames) \[bytes\].
    ends: Vec<u64>,
    count: usize,
}

impl<W: Write> Gif<W> {
    /// A film with the given number of frames, each of the given duration \[s\].
    pub fn new(
        to: W,
        size: [u32; 2],
        palette: Palette,
        (frames, delay): (usize, f64),
    ) -> Result<Self, Error> {
        let side = |n: u32| {
            u16::try_from(n).map_err(|_| {
                Error::beyond(format!("a GIF has at most 65535 pixels a side, not {n}"))
            })
        };
        let mut global: Vec<u8> = palette.colours.iter().flatten().copied().collect();
        global.resize(3 * (COLOURS + 1), 0);
        let mut encoder =
            Encoder::new(to, side(size[0])?, side(size[1])?, &global).map_err(Error::drawing)?;
        encoder.set_repeat(Repeat::Infinite).map_err(Error::drawing)?;
        encoder
            .write_raw_extension(gif::AnyExtension(0xfe), &[MARK.as_bytes()])
            .map_err(Error::drawing)?;
        // Delays are whole hundredths of a second; they are rounded from the start of the film, so that errors do not accumulate.
        let ends = (1..=frames).map(|k| (100.0 * delay * k as f64).round() as u64).collect();
        Ok(Self { encoder, palette, size, shown: Vec::new(), waiting: None, ends, count: 0 })
    }

    /// Appends a frame. A frame equal to the previous one only prolongs it.
    pub fn push(&mut self, pixels: &Pixels) -> Result<(), Error> {
        // Most pixels have the colour of the previous one: the page.
        let rows = pixels.rgb.as_chunks::<3>().0.chunk_by(|a, b| a == b);
        let palette = &mut self.palette;
        let indices: Vec<u8> =
            rows.flat_map(|row| std::iter::repeat_n(palette.index(row[0]), row.len())).collect();
        let lasts = self.ends[self.count] - self.count.checked_sub(1).map_or(0, |k| self.ends[k]);
        self.count += 1;
        let Some([left, top, width, height]) = self.change(&indices) else {
            if let Some((_, time)) = &mut self.waiting {
                *time += lasts;
            }
            return Ok(());
        };
        self.flush()?;
        let stride = self.size[0] as usize;
        let mut buffer = Vec::with_capacity(width * height);
        for row in top..top + height {
            for k in row * stride + left..row * stride + left + width {
                let same = self.shown.get(k) == Some(&indices[k]);
                buffer.push(if same { COLOURS as u8 } else { indices[k] });
            }
        }
        let frame = Frame {
            left: left as u16,
            top: top as u16,
            width: width as u16,
            height: height as u16,
            buffer: buffer.into(),
            transparent: Some(COLOURS as u8),
            dispose: DisposalMethod::Keep,
            ..Frame::default()
        };
        self.waiting = Some((frame, lasts));
        self.shown = indices;
        Ok(())
    }

    /// Completes the file.
    pub fn finish(mut self) -> Result<(), Error> {
        self.flush()?;
        self.encoder.into_inner().map(drop).map_err(Error::drawing)
    }

    fn flush(&mut self) -> Result<(), Error> {
        let Some((mut frame, lasts)) = self.waiting.take() else { return Ok(()) };
        frame.delay = u16::try_from(lasts).unwrap_or(u16::MAX);
        self.encoder.write_frame(&frame).map_err(Error::drawing)
    }

    /// Left, top, width and height of the part that differs from the current frame.
    fn change(&self, indices: &[u8]) -> Option<[usize; 4]> {
        let [width, height] = self.size.map(|n| n as usize);
        if self.shown.is_empty() {
            return Some([0, 0, width, height]);
        }
        let (mut low, mut high) = ([width, height], [0, 0]);
        for (k, _) in indices.iter().zip(&self.shown).enumerate().filter(|(_, (a, b))| a != b) {
            let at = [k % width, k / width];
            for i in 0..2 {
                low[i] = low[i].min(at[i]);
                high[i] = high[i].max(at[i] + 1);
            }
        }
        (high[0] > 0).then(|| [low[0], low[1], high[0] - low[0], high[1] - low[1]])
    }
}
