//! Shear stiffness: moduli of materials, factors of sections.

use super::material::Material;
use super::profile::Profile;
use super::section::Section;

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

impl Section {
    /// Shear factor kappa of a section of this kind with the given profile \[-\]: as given, else by its shape after G. R. Cowper (1966), The shear
    /// coefficient in Timoshenko's beam theory, Journal of Applied Mechanics 33; NaN if its shape is not known.
    pub(crate) fn shear_factor_of(&self, profile: &Profile, poisson: f64) -> f64 {
        let nu = poisson;
        match (self.shear_factor, profile, &self.walls) {
            (Some(given), ..) => given,
            (None, Profile::Ring { outer, inner }, _) => {
                let m2 = (inner / outer).powi(2);
                let one = (1.0 + m2).powi(2);
                6.0 * (1.0 + nu) * one / ((7.0 + 6.0 * nu) * one + (20.0 + 12.0 * nu) * m2)
            }
            (None, Profile::Strips(strips), _) if strips.len() == 1 => {
                10.0 * (1.0 + nu) / (12.0 + 11.0 * nu)
            }
            (None, _, Some(walls)) if self.stations.is_empty() => walls.shear_factor(nu),
            _ => f64::NAN,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn factor(section: &Section, nu: f64) -> f64 {
        section.shear_factor_of(&section.profile, nu)
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
