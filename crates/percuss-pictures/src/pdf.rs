//! A drawing as a PDF page of its size; letters are outlines, so that a reader needs no font.
//! Drawings here consist of paths in plain colours, with clips and opacities: other elements of SVG do not occur.

use std::collections::BTreeMap;

use pdf_writer::types::{LineCapStyle, LineJoinStyle};
use pdf_writer::{Content, Finish, Name, Pdf, Rect, Ref, TextStr};
use resvg::tiny_skia::{PathSegment, Point, Transform};
use resvg::usvg::{
    ClipPath, Color, FillRule, Group, LineCap, LineJoin, Node, Paint, PaintOrder, Path, Stroke,
    Tree,
};

use crate::error::Error;
use crate::mark::MARK;

const CATALOG: i32 = 1;
const PAGES: i32 = 2;
const PAGE: i32 = 3;
const CONTENT: i32 = 4;
const INFO: i32 = 5;
/// Number of the first graphics state; there is one for each opacity.
const STATES: i32 = 6;

/// The PDF file; a unit of the drawing has `points` PDF points.
pub(crate) fn write(tree: &Tree, points: f64) -> Result<Vec<u8>, Error> {
    let scale = points as f32;
    let [width, height] = [tree.size().width() * scale, tree.size().height() * scale];
    let mut page = Page { content: Content::new(), opacities: BTreeMap::new() };
    // The vertical axis of PDF points upwards.
    page.content.transform([scale, 0.0, 0.0, -scale, 0.0, height]);
    page.group(tree.root(), 1.0);
    let Page { content, opacities } = page;
    let mut pdf = Pdf::new();
    pdf.catalog(Ref::new(CATALOG)).pages(Ref::new(PAGES));
    pdf.pages(Ref::new(PAGES)).kids([Ref::new(PAGE)]).count(1);
    let mut leaf = pdf.page(Ref::new(PAGE));
    leaf.parent(Ref::new(PAGES)).media_box(Rect::new(0.0, 0.0, width, height));
    leaf.contents(Ref::new(CONTENT));
    let mut resources = leaf.resources();
    let mut states = resources.ext_g_states();
    for number in opacities.values() {
        states.pair(Name(state(*number).as_bytes()), Ref::new(STATES + number));
    }
    states.finish();
    resources.finish();
    leaf.finish();
    for (percent, number) in &opacities {
        let opacity = f32::from(*percent) / 1000.0;
        let mut state = pdf.ext_graphics(Ref::new(STATES + number));
        state.non_stroking_alpha(opacity).stroking_alpha(opacity);
    }
    let plain = content.finish();
    let packed = miniz_oxide::deflate::compress_to_vec_zlib(&plain, 9);
    pdf.stream(Ref::new(CONTENT), &packed).filter(pdf_writer::Filter::FlateDecode);
    pdf.document_info(Ref::new(INFO)).producer(TextStr(MARK));
    Ok(pdf.finish())
}

fn state(number: i32) -> String {
    format!("g{number}")
}

struct Page {
    content: Content,
    /// Number of the graphics state of each opacity \[1/1000\].
    opacities: BTreeMap<u16, i32>,
}

impl Page {
    fn group(&mut self, group: &Group, opacity: f32) {
        self.content.save_state();
        self.transform(group.transform());
        if let Some(clip) = group.clip_path() {
            self.clip(clip);
        }
        // Elements of a group do not overlap here, so that each of them can have the opacity of the group.
        let opacity = opacity * group.opacity().get();
        for node in group.children() {
            match node {
                Node::Group(group) => self.group(group, opacity),
                Node::Path(path) => self.path(path, opacity),
                Node::Text(text) => self.group(text.flattened(), opacity),
                Node::Image(_) => {}
            }
        }
        self.content.restore_state();
    }

    fn transform(&mut self, t: Transform) {
        if t != Transform::identity() {
            self.content.transform([t.sx, t.ky, t.kx, t.sy, t.tx, t.ty]);
        }
    }

    fn clip(&mut self, clip: &ClipPath) {
        if let Some(inner) = clip.clip_path() {
            self.clip(inner);
        }
        let at = clip.transform();
        for node in clip.root().children() {
            if let Node::Path(path) = node {
                self.outline(path, at.pre_concat(path.abs_transform()));
            }
        }
        self.content.clip_nonzero().end_path();
    }

    fn path(&mut self, path: &Path, opacity: f32) {
        if !path.is_visible() {
            return;
        }
        if path.paint_order() == PaintOrder::StrokeAndFill {
            self.stroke(path, opacity); // the outline of a text is below its fill
            self.fill(path, opacity);
        } else {
            self.fill(path, opacity);
            self.stroke(path, opacity);
        }
    }

    fn fill(&mut self, path: &Path, opacity: f32) {
        let Some((fill, [r, g, b])) = path.fill().and_then(|f| Some((f, colour(f.paint())?)))
        else {
            return;
        };
        self.opacity(opacity * fill.opacity().get());
        self.content.set_fill_rgb(r, g, b);
        self.outline(path, Transform::identity());
        match fill.rule() {
            FillRule::NonZero => self.content.fill_nonzero(),
            FillRule::EvenOdd => self.content.fill_even_odd(),
        };
    }

    fn stroke(&mut self, path: &Path, opacity: f32) {
        let Some((stroke, rgb)) = path.stroke().and_then(|s| Some((s, colour(s.paint())?))) else {
            return;
        };
        self.opacity(opacity * stroke.opacity().get());
        self.pen(stroke, rgb);
        self.outline(path, Transform::identity());
        self.content.stroke();
    }

    fn pen(&mut self, stroke: &Stroke, [r, g, b]: [f32; 3]) {
        let cap = match stroke.linecap() {
            LineCap::Butt => LineCapStyle::ButtCap,
            LineCap::Round => LineCapStyle::RoundCap,
            LineCap::Square => LineCapStyle::ProjectingSquareCap,
        };
        let join = match stroke.linejoin() {
            LineJoin::Miter | LineJoin::MiterClip => LineJoinStyle::MiterJoin,
            LineJoin::Round => LineJoinStyle::RoundJoin,
            LineJoin::Bevel => LineJoinStyle::BevelJoin,
        };
        let dashes = stroke.dasharray().unwrap_or_default().iter().copied();
        self.content
            .set_stroke_rgb(r, g, b)
            .set_line_width(stroke.width().get())
            .set_line_cap(cap)
            .set_line_join(join)
            .set_miter_limit(stroke.miterlimit().get())
            .set_dash_pattern(dashes, stroke.dashoffset());
    }

    fn opacity(&mut self, opacity: f32) {
        let thousandths = (1000.0 * opacity).round().clamp(0.0, 1000.0) as u16;
        let next = self.opacities.len() as i32;
        let number = *self.opacities.entry(thousandths).or_insert(next);
        self.content.set_parameters(Name(state(number).as_bytes()));
    }

    fn outline(&mut self, path: &Path, transform: Transform) {
        let at = |mut p: Point| {
            transform.map_point(&mut p);
            p
        };
        let mut last = Point::zero();
        for segment in path.data().segments() {
            match segment {
                PathSegment::MoveTo(p) => {
                    last = at(p);
                    self.content.move_to(last.x, last.y);
                }
                PathSegment::LineTo(p) => {
                    last = at(p);
                    self.content.line_to(last.x, last.y);
                }
                PathSegment::QuadTo(p, q) => {
                    // PDF has only cubic curves.
                    let (p, q) = (at(p), at(q));
                    let part = |a: f32, b: f32| a + 2.0 / 3.0 * (b - a);
                    let (a, b) =
                        ([part(last.x, p.x), part(last.y, p.y)], [part(q.x, p.x), part(q.y, p.y)]);
                    self.content.cubic_to(a[0], a[1], b[0], b[1], q.x, q.y);
                    last = q;
                }
                PathSegment::CubicTo(p, q, r) => {
                    let (p, q, r) = (at(p), at(q), at(r));
                    self.content.cubic_to(p.x, p.y, q.x, q.y, r.x, r.y);
                    last = r;
                }
                PathSegment::Close => {
                    self.content.close_path();
                }
            }
        }
    }
}

fn colour(paint: &Paint) -> Option<[f32; 3]> {
    match paint {
        Paint::Color(Color { red, green, blue }) => {
            Some([red, green, blue].map(|c| f32::from(*c) / 255.0))
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Content stream of the page of a file.
    fn operations(svg: &str) -> (String, String) {
        let file = write(&crate::font::read(svg).unwrap(), 0.75).unwrap();
        let text = String::from_utf8_lossy(&file).into_owned();
        let begin = file.windows(7).position(|w| w == b"stream\n").unwrap() + 7;
        let plain = miniz_oxide::inflate::decompress_to_vec_zlib(&file[begin..]);
        let plain = plain.unwrap_or_else(|error| error.output);
        (text, String::from_utf8(plain).unwrap())
    }

    #[test]
    fn a_page_has_the_size_of_its_drawing_and_names_who_made_it() {
        let svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"96\" height=\"48\"><path d=\"M0 0L9 9\" stroke=\"#f00\"/></svg>";
        let (file, page) = operations(svg);
        assert!(file.contains("/MediaBox [0 0 72 36]"), "{file}");
        assert!(file.contains(MARK));
        assert!(page.contains("1 0 0 RG") && page.contains("9 9 l"), "{page}");
    }

    #[test]
    fn surroundings_of_a_text_lie_below_it() {
        let text = |order: &str| {
            format!(
                "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"96\" height=\"48\"><text x=\"5\" y=\"20\" fill=\"#000\" \
                 stroke=\"#fff\" stroke-width=\"3\"{order}>m</text></svg>"
            )
        };
        let drawn = |order: &str| {
            let (_, page) = operations(&text(order));
            let at = |operator: &str| page.lines().position(|l| l == operator).unwrap();
            at("f") < at("S")
        };
        assert!(drawn(""));
        assert!(!drawn(" paint-order=\"stroke\""));
    }

    #[test]
    fn opacities_and_clips_are_kept() {
        let svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"96\" height=\"48\"><clipPath id=\"c\"><rect width=\"10\" height=\"10\"/></clipPath>\
                   <g clip-path=\"url(#c)\" opacity=\"0.5\"><rect width=\"90\" height=\"40\" fill-opacity=\"0.5\"/></g></svg>";
        let (file, page) = operations(svg);
        assert!(file.contains("/ca 0.25"), "{file}");
        assert!(page.lines().any(|line| line == "W"), "{page}");
    }
}
