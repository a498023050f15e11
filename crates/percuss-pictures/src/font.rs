//! The font of all pictures: DejaVu Sans of the plotting crate, so that a picture is the same on every machine.

use std::sync::{Arc, LazyLock};

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use kuva::backend::svg::SvgBackend;
use kuva::render::render::Scene;
use resvg::usvg::fontdb::Database;
use resvg::usvg::{Options, Tree};

use crate::error::Error;

/// Start of an embedded font in a drawing.
const BEGIN: &str = "url('data:font/truetype;base64,";

static FONTS: LazyLock<Arc<Database>> = LazyLock::new(|| {
    let mut fonts = Database::new();
    // kuva's font is private, but kuva embeds it in a drawing on request: regular and bold come first.
    let drawing = SvgBackend::new().with_embedded_font(true).render_scene(&Scene::new(1.0, 1.0));
    let texts = drawing.split(BEGIN).skip(1).filter_map(|rest| rest.split_once('\''));
    for bytes in texts.take(2).filter_map(|(text, _)| STANDARD.decode(text).ok()) {
        fonts.load_font_data(bytes);
    }
    fonts.set_sans_serif_family("DejaVu Sans");
    Arc::new(fonts)
});

/// An SVG text, read with this font for every font family in it.
pub(crate) fn read(svg: &str) -> Result<Tree, Error> {
    let options = Options {
        font_family: "DejaVu Sans".to_owned(),
        fontdb: Arc::clone(&FONTS),
        ..Options::default()
    };
    Tree::from_str(svg, &options).map_err(Error::drawing)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_is_a_font_and_letters_have_outlines() {
        assert_eq!(FONTS.faces().count(), 2);
        let svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"90\" height=\"20\">\
                   <text x=\"1\" y=\"15\" font-size=\"12\" font-family=\"system-ui, sans-serif\">\u{d7} \u{3b1} m</text></svg>";
        let tree = read(svg).unwrap();
        let width = tree.root().bounding_box().width();
        assert!((20.0..60.0).contains(&width), "{width}");
    }
}
