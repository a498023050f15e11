//! Pixels of a scene.
//!
//! The raster backend draws turned text with the edges of its letters filled in, so that it looks struck
//! twice. Here a label that reads upwards is drawn lying, turned pixel by pixel and put in its place.

use kuva::backend::raster::RasterBackend;
use kuva::render::render::{Primitive, Scene, TextAnchor};

use super::png_file;

/// The scene as PNG, `scale` pixels per unit of its size.
pub(super) fn png(mut scene: Scene, scale: f32) -> Result<Vec<u8>, String> {
    let labels = take_labels(&mut scene);
    let mut picture = Picture::of(&scene, scale)?;
    for label in &labels {
        let long = scene.height.max(scene.width);
        let (middle, baseline) = (long / 2.0, 1.5 * f64::from(label.size));
        let mut lying = Scene::new(long, 2.5 * f64::from(label.size));
        lying.text_color.clone_from(&scene.text_color);
        lying.font_family.clone_from(&scene.font_family);
        lying.add(Primitive::Text {
            x: middle,
            y: baseline,
            content: label.content.clone(),
            size: label.size,
            anchor: TextAnchor::Middle,
            rotate: None,
            bold: false,
            color: None,
        });
        let pixel = |length: f64| (length * f64::from(scale)).round() as i64;
        let lying = Picture::of(&lying, scale)?;
        let (from, to) = ((middle, baseline), (label.x, label.y));
        picture.lay_upright(&lying, (pixel(from.0), pixel(from.1)), (pixel(to.0), pixel(to.1)));
    }
    png_file::write(picture.width, picture.height, picture.pixels.as_flattened())
}

/// Text that reads upwards, centred.
struct Label {
    x: f64,
    y: f64,
    content: String,
    size: u32,
}

/// Takes the labels that read upwards out of the scene.
fn take_labels(scene: &mut Scene) -> Vec<Label> {
    let mut labels = Vec::new();
    let mut shifts = vec![(0.0, 0.0)];
    scene.elements.retain(|element| {
        let &(dx, dy) = shifts.last().unwrap_or(&(0.0, 0.0));
        match element {
            Primitive::GroupStart { transform, .. } => {
                let (x, y) = transform.as_deref().and_then(translation).unwrap_or((0.0, 0.0));
                shifts.push((dx + x, dy + y));
            }
            Primitive::GroupEnd => {
                shifts.pop();
            }
            Primitive::Text {
                x,
                y,
                content,
                size,
                anchor: TextAnchor::Middle,
                rotate: Some(angle),
                ..
            } if *angle == -90.0 => {
                let content = content.clone();
                labels.push(Label { x: x + dx, y: y + dy, content, size: *size });
                return false;
            }
            _ => {}
        }
        true
    });
    labels
}

/// `translate(3,4)` as (3, 4).
fn translation(transform: &str) -> Option<(f64, f64)> {
    let inside = transform.strip_prefix("translate(")?.strip_suffix(')')?;
    let (x, y) = inside.split_once(',')?;
    Some((x.trim().parse().ok()?, y.trim().parse().ok()?))
}

/// An opaque picture.
struct Picture {
    width: usize,
    height: usize,
    /// Red, green, blue; shape (height, width) \[-\].
    pixels: Vec<[u8; 3]>,
}

impl Picture {
    fn of(scene: &Scene, scale: f32) -> Result<Self, String> {
        let bytes = RasterBackend::new().with_scale(scale).render_scene(scene)?;
        let (width, height, data) =
            png_file::read(&bytes).ok_or("not the PNG that was expected")?;
        let pixels = data.chunks_exact(4).map(|p| [p[0], p[1], p[2]]).collect();
        Ok(Self { width, height, pixels })
    }

    /// Lays `lying` on this picture, turned by a quarter against the clock, its pixel `from` on `to`;
    /// the darker of both colours stays.
    fn lay_upright(&mut self, lying: &Self, from: (i64, i64), to: (i64, i64)) {
        for (k, colour) in lying.pixels.iter().enumerate() {
            let (i, j) = ((k % lying.width) as i64 - from.0, (k / lying.width) as i64 - from.1);
            let (Ok(x), Ok(y)) = (usize::try_from(to.0 + j), usize::try_from(to.1 - i)) else {
                continue;
            };
            if x < self.width && y < self.height {
                let under = &mut self.pixels[y * self.width + x];
                *under = std::array::from_fn(|c| under[c].min(colour[c]));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quarter_turn_against_the_clock_lets_text_read_upwards() {
        let white = [255; 3];
        let mut lying = Picture { width: 3, height: 1, pixels: vec![white; 3] };
        lying.pixels[2] = [0; 3]; // the end of the text
        let mut picture = Picture { width: 3, height: 3, pixels: vec![white; 9] };
        picture.lay_upright(&lying, (1, 0), (1, 1));
        let dark: Vec<usize> = (0..9).filter(|&k| picture.pixels[k] == [0; 3]).collect();
        assert_eq!(dark, [1], "in the middle of the first row");
    }

    #[test]
    fn groups_move_their_labels() {
        assert_eq!(translation("translate(3,4.5)"), Some((3.0, 4.5)));
        assert_eq!(translation("rotate(3)"), None);
    }
}
