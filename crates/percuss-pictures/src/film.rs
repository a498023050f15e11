//! The scene of a run as SVG at any time, drawn by the scripts of the page.

use percuss_output::fields::{Fields, StoredFrame};
use percuss_output::report::{scene_colours, scene_scripts};
use rquickjs::{CatchResultExt, CaughtError, Context, Ctx, Function, Object, Runtime, TypedArray};
use serde_json::{Map, Value, json};

use crate::apng;
use crate::error::Error;
use crate::pixels::Pixels;
use crate::request::Look;

/// Script that draws without a page.
const FILM: &str = include_str!("../web/film.js");
/// Stack size of the scripts \[bytes\].
const STACK: usize = 1 << 19;

/// A scene that can be drawn at any time.
pub struct Film {
    context: Context,
    /// Width and height, even numbers, shape (2) \[pixels\].
    pub size: [u32; 2],
    /// First and last time, shape (2) \[s\].
    pub whole: [f64; 2],
    /// Interval of time with a closed contact, with a margin; `None` without contact or with permanent contact, shape (2) \[s\].
    pub impact: Option<[f64; 2]>,
    /// Duration of the animation on the page \[s\].
    pub seconds: f64,
}

/// Reason why displacements may not be drawn with this scale, and the largest valid scale.
fn hindrance(found: &Value, factor: f64) -> Option<String> {
    let word = |value: &Value| value.as_str().unwrap_or_default().to_owned();
    if let Some(most) = found["most"].as_f64() {
        let most = (100.0 * most).floor() / 100.0;
        return Some(format!(
            "deformation scale {factor} would show overlapping bodies; the largest is --exaggeration {most}"
        ));
    }
    let contact = found["contact"].as_str()?;
    let [one, other] = [0, 1].map(|k| word(&found["between"][k]));
    Some(format!(
        "`{one}` and `{other}` touch in this run (contact `{contact}`), and a deformation scale would show them overlapping or \
         apart; omit --exaggeration, and show what the beam does by --diagram moment or --colour moment"
    ))
}

impl Film {
    /// Reads the scene and its motion.
    ///
    /// # Errors
    /// If frames do not match the scene, or displacements may not be drawn with a larger scale.
    pub fn open(fields: &Fields, look: &Look) -> Result<Self, Error> {
        percuss_output::paraview::check(fields).map_err(|e| Error::content(e.to_string()))?;
        let runtime = Runtime::new().map_err(Error::drawing)?;
        runtime.set_max_stack_size(STACK);
        let context = Context::full(&runtime).map_err(Error::drawing)?;
        let about = context.with(|ctx| {
            for script in scene_scripts().chain([FILM]) {
                ctx.eval::<(), _>(script).catch(&ctx).map_err(fault)?;
            }
            open(&ctx, fields, look).catch(&ctx).map_err(fault)
        })?;
        let about: Value = serde_json::from_str(&about).map_err(Error::drawing)?;
        if let Some(why) = hindrance(&about["hindrance"], look.exaggeration) {
            return Err(Error::beyond(why));
        }
        let pair = |value: &Value| Some([value[0].as_f64()?, value[1].as_f64()?]);
        let read = || {
            let pixels = |k: usize| u32::try_from(about["size"][k].as_u64()?).ok();
            Some((pair(&about["whole"])?, [pixels(0)?, pixels(1)?], about["seconds"].as_f64()?))
        };
        let (whole, size, seconds) = read().ok_or_else(|| Error::drawing("its size is unknown"))?;
        Ok(Self { context, size, whole, impact: pair(&about["impact"]), seconds })
    }

    /// The scene at a time as SVG; impulses of the preceding time `flash` are shown \[s\].
    ///
    /// # Errors
    /// If the scripts cannot draw it.
    pub fn svg(&self, time: f64, flash: f64) -> Result<String, Error> {
        self.context.with(|ctx| {
            let draw = || ctx.globals().get::<_, Function>("drawFilm")?.call((time, flash));
            draw().catch(&ctx).map_err(fault)
        })
    }
}

impl Film {
    /// A drawing of this film as PNG.
    ///
    /// # Errors
    /// If it cannot be drawn.
    pub fn png(&self, svg: &str) -> Result<Vec<u8>, Error> {
        apng::png(&Pixels::of_svg(svg, self.size)?, None)
    }
}

/// Passes the run to the scripts, which describe it in JSON.
fn open(ctx: &Ctx<'_>, fields: &Fields, look: &Look) -> rquickjs::Result<String> {
    let all = |list: fn(&StoredFrame) -> &Vec<f32>| {
        let values: Vec<f32> = fields.frames.iter().flat_map(list).copied().collect();
        TypedArray::new(ctx.clone(), values)
    };
    let counts: Vec<f32> =
        fields.frames.iter().map(|f| (f.contact_forces.len() / 6) as f32).collect();
    let points: Vec<f32> =
        fields.frames.iter().map(|f| (f.section_points.len() / 5) as f32).collect();
    let time: Vec<f64> = fields.frames.iter().map(|f| f.time).collect();
    let frames = Object::new(ctx.clone())?;
    frames.set("time", TypedArray::new(ctx.clone(), time)?)?;
    frames.set("displacement", all(|f| &f.displacement)?)?;
    frames.set("velocity", all(|f| &f.velocity)?)?;
    frames.set("sections", all(|f| &f.section_forces)?)?;
    frames.set("points", all(|f| &f.section_points)?)?;
    frames.set("point_count", TypedArray::new(ctx.clone(), points)?)?;
    frames.set("contacts", all(|f| &f.contact_forces)?)?;
    frames.set("loads", all(|f| &f.load_factors)?)?;
    frames.set("contact_count", TypedArray::new(ctx.clone(), counts)?)?;
    let colours: Map<String, Value> = scene_colours(look.dark)
        .into_iter()
        .map(|(name, value)| (name.to_owned(), Value::from(value)))
        .collect();
    let look = json!({
        "width": look.width, "title": look.title, "colour": look.colour, "diagram": look.diagram, "exaggeration": look.exaggeration,
    });
    let open: Function = ctx.globals().get("openFilm")?;
    open.call((
        fields.scene.to_string(),
        frames,
        Value::Object(colours).to_string(),
        look.to_string(),
    ))
}

/// Scripts fail only for invalid input: a scene that this program did not write.
fn fault(error: CaughtError<'_>) -> Error {
    let reason = match &error {
        CaughtError::Exception(exception) => exception.message().unwrap_or_default(),
        other => other.to_string(),
    };
    Error::content(format!("fields/scene.json is damaged and cannot be drawn ({reason})"))
}
