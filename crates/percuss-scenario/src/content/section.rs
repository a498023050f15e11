//! Cross sections.

use percuss::RotaryInertia;

use crate::format::{Count, List, Maybe};
use crate::measure;
use crate::name::{MaterialName, NameOf, SectionName};
use crate::node::{Body, Reader};
use crate::profile::{ProfileName, SteelProfile};
use crate::quantity::Quantity;
use crate::words::Rotary;
use crate::write::Writer;

kinds! {
    /// Shape of a cross section.
    pub enum Shape by "shape" default "explicit" implied "profile" by "profile" {
        /// Area and second moment of area as given.
        Explicit = "explicit" {
            /// Area (m^2).
            area: f64 as Quantity<measure::Area>,
            /// Second moment of area (m^4).
            inertia: f64 as Quantity<measure::Inertia>,
            /// Depth between the extreme fibres (m); no fibre strains are reported if omitted.
            depth: Option<f64> as Maybe<Quantity<measure::Length>> = None,
        },
        /// A full rectangle.
        Rectangle = "rectangle" {
            /// Width, across the plane of bending (m).
            width: f64 as Quantity<measure::Length>,
            /// Depth, in the plane of bending (m).
            depth: f64 as Quantity<measure::Length>,
        },
        /// A full circle.
        Circle = "circle" {
            /// Diameter (m).
            diameter: f64 as Quantity<measure::Length>,
        },
        /// A circular tube.
        Tube = "tube" {
            /// Outer diameter (m).
            diameter: f64 as Quantity<measure::Length>,
            /// Thickness of the wall (m).
            thickness: f64 as Quantity<measure::Length>,
        },
        /// A doubly symmetric I without fillets, bent about its strong axis.
        I = "i" {
            /// Width of the flanges (m).
            width: f64 as Quantity<measure::Length>,
            /// Depth over both flanges (m).
            depth: f64 as Quantity<measure::Length>,
            /// Thickness of a flange (m).
            flange: f64 as Quantity<measure::Length>,
            /// Thickness of the web (m).
            web: f64 as Quantity<measure::Length>,
        },
        /// A rectangular box of uniform wall thickness.
        Box = "box" {
            /// Outer width, across the plane of bending (m).
            width: f64 as Quantity<measure::Length>,
            /// Outer depth, in the plane of bending (m).
            depth: f64 as Quantity<measure::Length>,
            /// Thickness of the wall (m).
            thickness: f64 as Quantity<measure::Length>,
        },
        /// A steel profile by its name, bent about the axis across its depth; `profile` alone implies this shape.
        Profile = "profile" {
            /// IPE, HEA, HEB (EN 10365), W (AISC): "IPE 200", "HEB 300", "W12x26". Hot finished hollow sections of any size in mm (EN 10210-2): "RHS
            /// 200x100x8" (depth, width, wall), "SHS 100x5", "CHS 168.3x5". A beam may also name a profile as its `section`.
            profile: SteelProfile as ProfileName,
        },
        /// Single fibres, of one material or of several; the centre line is their elastic centroid.
        Fibres = "fibres" {
            /// Heights of the fibres above the centre line (m).
            heights: Vec<f64> as List<Quantity<measure::Length>>,
            /// Areas of the fibres (m^2).
            areas: Vec<f64> as List<Quantity<measure::Area>>,
            /// Names of the materials of the fibres; that of the beam if omitted.
            materials: Option<Vec<String>> as Maybe<List<NameOf<MaterialName>>> = None,
            /// Depth for contact and drawing, centred on the centre line (m); twice the largest distance of a fibre if omitted.
            depth: Option<f64> as Maybe<Quantity<measure::Length>> = None,
        },
        /// Varies along the beam: area, second moment of area, depth, rotary inertia and shear stiffness linearly between stations. Keys below that are
        /// omitted here are those of the sections at the stations; of `fibres` their largest number.
        Tapered = "tapered" {
            /// Fractions of the beam's length, from 0 to 1.
            stations: Vec<f64> as List<Quantity<measure::Ratio>>,
            /// Names of the sections there, none of them tapered.
            sections: Vec<String> as List<NameOf<SectionName>>,
        },
    }
}

table! {
    /// Cross section of a beam.
    pub struct Section {
        /// true: density times second moment of area; false: none; or a value per length (kg m).
        rotary_inertia: RotaryInertia as Rotary = RotaryInertia::Density,
        /// Fibres through the depth where the material yields; an even number.
        fibres: usize as Count = percuss::Section::FIBRES,
        /// Shear factor of a shear-flexible beam, the part of the area that carries shear; that of its shape after Cowper if omitted.
        shear_factor: Option<f64> as Maybe<Quantity<measure::Ratio>> = None,
    }
    with {
        /// Its shape.
        shape: Shape
    }
}
