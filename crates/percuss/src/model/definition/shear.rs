//! Shear stiffness: moduli of materials, factors of sections; where the shear stress of a profile is largest.

use super::material::Material;
use super::profile::{Profile, Strip};
use super::section::UniformSection;

impl Material {
    /// Shear modulus \[Pa\], as given or of an isotropic material; `None` without Poisson's ratio.
    pub(crate) fn shear_stiffness(&self) -> Option<f64> {
        let isotropic = |poisson: f64| self.young / (2.0 * (1.0 + poisson));
        self.shear_modulus.or(self.poisson.map(isotropic))
    }

    /// Poisson's ratio for shear factors; zero of a material of which only a shear modulus is known that no isotropic one has, such as timber.
    pub(crate) fn poisson_in_shear(&self) -> f64 {
        let of_moduli = || self.shear_modulus.map(|shear| self.young / (2.0 * shear) - 1.0);
        let isotropic = |poisson: &f64| (-1.0..=0.5).contains(poisson);
        self.poisson.or_else(of_moduli).filter(isotropic).unwrap_or(0.0)
    }
}

impl UniformSection<'_> {
    /// Shear factor kappa \[-\]: as given, else by its shape after G. R. Cowper (1966), The shear
    /// coefficient in Timoshenko's beam theory, Journal of Applied Mechanics 33; NaN if its shape is not known.
    pub(crate) fn shear_factor(&self, poisson: f64) -> f64 {
        let nu = poisson;
        match (self.shear_factor, self.profile, self.walls) {
            (Some(given), ..) => given,
            (None, Profile::Ring { outer, inner }, _) => {
                let m2 = (inner / outer).powi(2);
                let one = (1.0 + m2).powi(2);
                6.0 * (1.0 + nu) * one / ((7.0 + 6.0 * nu) * one + (20.0 + 12.0 * nu) * m2)
            }
            (None, Profile::Strips(strips), _) if strips.len() == 1 => {
                10.0 * (1.0 + nu) / (12.0 + 11.0 * nu)
            }
            (None, _, Some(walls)) => walls.shear_factor(nu),
            _ => f64::NAN,
        }
    }
}

/// Width and first moment of a profile at a height, for its shear stress.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ShearWidth {
    /// Height above the centre line \[m\].
    pub height: f64,
    /// Width there \[m\].
    pub width: f64,
    /// First moment of the area beyond about the centre line, Q \[m^3\].
    pub moment_beyond: f64,
}

impl Profile {
    /// At the neutral axis, and at the outer end of the web; of a section without a web the former twice. `None` if widths are not known.
    ///
    /// The shear stress is `V Q/(I b)` (D. I. Zhuravskii; S. Timoshenko, Strength of Materials I, 1930): at the axis `3V/(2A)` of a rectangle, `4V/(3A)`
    /// of a circle, `2V/A` of a thin tube.
    pub(crate) fn shear_widths(&self) -> Option<[ShearWidth; 2]> {
        match self {
            Self::Unknown | Self::Fibres(_) => None,
            Self::Ring { outer, inner } => {
                let moment_beyond = 2.0 / 3.0 * (outer.powi(3) - inner.powi(3));
                let width = 2.0 * (outer - inner);
                Some([ShearWidth { height: 0.0, width, moment_beyond }; 2])
            }
            Self::Strips(strips) => {
                let (web, flange) = strips.split_first()?;
                let moment =
                    |one: &Strip| 0.5 * one.width * (one.to * one.to - one.from * one.from);
                let outside: f64 = flange.iter().map(moment).sum();
                let (width, whole) = (web.width, outside + moment(web));
                let axis = ShearWidth { height: 0.0, width, moment_beyond: whole };
                let end = ShearWidth { height: web.to, width, moment_beyond: outside };
                Some([axis, if flange.is_empty() { axis } else { end }])
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::section::Section;
    use super::*;

    /// Shear stresses by a shear force of one, at the neutral axis and at the end of the web.
    fn stresses(section: &Section) -> [f64; 2] {
        let places = section.profile.shear_widths().unwrap();
        places.map(|one| one.moment_beyond / (section.inertia * one.width))
    }

    #[test]
    fn shear_stresses_are_those_of_the_shapes() {
        let close =
            |found: f64, known: f64| assert!((found / known - 1.0).abs() < 1e-12, "{found}");
        let plate = Section::rectangle("r", 0.1, 0.3);
        close(stresses(&plate)[0], 1.5 / plate.area);
        let rod = Section::circle("c", 0.1);
        close(stresses(&rod)[0], 4.0 / 3.0 / rod.area);
        // A tube from full to thin: (4/3) (R^2 + R r + r^2)/(R^2 + r^2).
        let tube = Section::tube("t", 0.1, 0.01);
        close(stresses(&tube)[0], 4.0 / 3.0 * (25.0 + 20.0 + 16.0) / (25.0 + 16.0) / tube.area);
        let thin = Section::tube("t", 0.1, 1e-9);
        assert!((stresses(&thin)[0] * thin.area - 2.0).abs() < 1e-6);
        // An I: b (h^2 - c^2)/8 of the flanges and t c^2/8 of the web, over I t.
        let (b, h, f, t) = (0.1_f64, 0.2_f64, 0.0085, 0.0056);
        let c = h - 2.0 * f;
        let i = Section::i_shape("i", b, h, f, t);
        let flange = b * (h * h - c * c) / 8.0;
        close(stresses(&i)[0], (flange + t * c * c / 8.0) / (i.inertia * t));
        close(stresses(&i)[1], flange / (i.inertia * t));
        // Fillets carry little; most is the mean over the web.
        let rolled = stresses(&Section::rolled_i("ri", b, h, f, t, 0.012));
        assert!(rolled[0] < stresses(&i)[0] * 1.01 && rolled[0] > 1.0 / (h * t), "{rolled:?}");
        let tight = Section::hollow_box("b", 0.1, 0.2, 0.005);
        let (w, d) = (0.09, 0.19_f64);
        let moment = (0.1 * 0.2_f64.powi(2) - w * d * d) / 8.0;
        close(stresses(&tight)[0], moment / (tight.inertia * 0.01));
        assert!(Section::new("plain", 1e-3, 1e-7).profile.shear_widths().is_none());
    }

    fn factor(section: &Section, nu: f64) -> f64 {
        section.uniform().shear_factor(nu)
    }

    #[test]
    fn shear_factors_are_those_of_cowper() {
        let close = |found: f64, known: f64| assert!((found - known).abs() < 1e-12, "{found}");
        close(factor(&Section::rectangle("r", 0.1, 0.2), 0.0), 5.0 / 6.0);
        close(factor(&Section::rectangle("r", 0.1, 0.2), 0.3), 13.0 / 15.3);
        close(factor(&Section::circle("c", 0.1), 0.0), 6.0 / 7.0);
        close(factor(&Section::circle("c", 0.1), 0.3), 7.8 / 8.8);
        // A thin tube: 2 (1 + nu) / (4 + 3 nu).
        let thin = factor(&Section::tube("t", 0.1, 1e-9), 0.3);
        assert!((thin - 2.6 / 4.9).abs() < 1e-9, "{thin}");
        // Without flanges an I is its web.
        let web = factor(&Section::i_shape("i", 1e-9, 0.2, 1e-9, 0.01), 0.3);
        assert!((web - 13.0 / 15.3).abs() < 1e-6, "{web}");
        // Cowper 1966, table 1: a thin-walled square box has 20 (1 + nu) / (48 + 39 nu).
        let square = factor(&Section::hollow_box("b", 1.0, 1.0, 1e-9), 0.3);
        assert!((square - 26.0 / 59.7).abs() < 1e-6, "{square}");
        // Most of the shear of an I is in its web.
        let section = Section::i_shape("i", 0.1, 0.2, 0.0085, 0.0056);
        let share = factor(&section, 0.3) * section.area / (0.2 * 0.0056);
        assert!((0.85..1.0).contains(&share), "{share}");
        assert!(factor(&Section::new("plain", 1e-3, 1e-7), 0.3).is_nan());
        let given = Section { shear_factor: Some(0.7), ..Section::new("plain", 1e-3, 1e-7) };
        close(factor(&given, 0.3), 0.7);
    }

    #[test]
    fn moduli_of_shear_are_those_of_isotropic_materials_unless_given() {
        let steel = Material { poisson: Some(0.25), ..Material::new("steel", 2e11, 7800.0) };
        assert_eq!((steel.shear_stiffness(), steel.poisson_in_shear()), (Some(8e10), 0.25));
        let timber =
            Material { shear_modulus: Some(7e8), ..Material::new("timber", 1.1e10, 450.0) };
        assert_eq!((timber.shear_stiffness(), timber.poisson_in_shear()), (Some(7e8), 0.0));
        assert_eq!(Material::new("unknown", 1.0, 1.0).shear_stiffness(), None);
    }
}
