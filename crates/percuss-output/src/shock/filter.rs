//! The phaseless filter of channel frequency classes: SAE J211-1, appendix C; ISO 6487, annex A.

use std::f64::consts::{PI, SQRT_2};

use super::{ShockError, Signal};

/// Each pass has its corner at this multiple of the class, so that both together are 3 dB down at 5/3 of it.
const CORNER: f64 = 2.0775;
/// The filter has forgotten what it held after so many periods of the class: `exp(-2 pi 2.0775 / sqrt 2 * 4)` is below 1e-16.
const MEMORY: f64 = 4.0;
/// Samples a period of the cut-off that the filter asks for: the bilinear formula bends frequencies, at the cut-off by 3 %.
const SAMPLES: f64 = 10.0;

/// Channel frequency class.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cfc {
    /// CFC 60, cut-off at 100 Hz.
    Class60,
    /// CFC 180, cut-off at 300 Hz.
    Class180,
    /// CFC 600, cut-off at 1000 Hz.
    Class600,
    /// CFC 1000, cut-off at 1650 Hz.
    Class1000,
}

impl Cfc {
    /// The classes of the standard.
    pub const ALL: [Self; 4] = [Self::Class60, Self::Class180, Self::Class600, Self::Class1000];

    /// The class with this number, if the standard has it.
    pub fn of(number: u32) -> Option<Self> {
        Self::ALL.into_iter().find(|class| class.number() == number)
    }

    /// Its number.
    pub fn number(self) -> u32 {
        match self {
            Self::Class60 => 60,
            Self::Class180 => 180,
            Self::Class600 => 600,
            Self::Class1000 => 1000,
        }
    }

    /// The cut-off that the standards name \[Hz\]: the amplitude is 3 dB down there, of CFC 1000 at 1667 Hz.
    pub fn cut_off(self) -> f64 {
        match self {
            Self::Class1000 => 1650.0,
            other => f64::from(other.number()) / 0.6,
        }
    }

    /// Time after which the filter has forgotten a value, to round-off \[s\]: a change of the signal reaches that far to either side.
    pub fn memory(self) -> f64 {
        MEMORY / f64::from(self.number())
    }
}

/// The signal in a channel frequency class: a two-pole Butterworth filter, run forward and backward, so that phases stay.
/// Before its start and behind its end the signal is taken as constant.
///
/// # Errors
/// If it has fewer than ten samples a period of the class's cut-off.
pub fn filtered(signal: &Signal, class: Cfc) -> Result<Signal, ShockError> {
    let (rate, needed) = (1.0 / signal.step, SAMPLES * class.cut_off());
    // A sampling of exactly ten times the cut-off is enough, whatever its rounding.
    if rate < needed * (1.0 - 1e-9) {
        let what = format!("CFC {} (cut-off at {:.0} Hz)", class.number(), class.cut_off());
        return Err(ShockError::Coarse { what, needed, rate });
    }
    let number = f64::from(class.number());
    let pass = Pass::new(2.0 * PI * number * CORNER, signal.step);
    let room = (MEMORY / (number * signal.step)).ceil() as usize;
    let (first, last) = match signal.values[..] {
        [first, .., last] => (first, last),
        _ => return Ok(signal.clone()),
    };
    let mut padded = vec![first; room];
    padded.extend_from_slice(&signal.values);
    padded.resize(padded.len() + room, last);
    pass.run(&mut padded);
    padded.reverse();
    pass.run(&mut padded);
    padded.reverse();
    let values = padded[room..room + signal.values.len()].to_vec();
    Ok(Signal { values, ..signal.clone() })
}

/// Coefficients of one pass, by the bilinear formula.
struct Pass {
    a0: f64,
    b1: f64,
    b2: f64,
}

impl Pass {
    fn new(corner: f64, step: f64) -> Self {
        let w = (0.5 * corner * step).tan();
        let d = 1.0 + SQRT_2 * w + w * w;
        let (b1, b2) = (-2.0 * (w * w - 1.0) / d, (-1.0 + SQRT_2 * w - w * w) / d);
        Self { a0: w * w / d, b1, b2 }
    }

    /// Filters in place; the values before the first one were equal to it.
    fn run(&self, values: &mut [f64]) {
        let first = values.first().copied().unwrap_or(0.0);
        let ([mut x1, mut x2], [mut y1, mut y2]) = ([first; 2], [first; 2]);
        for value in values {
            let x = *value;
            let y = self.a0 * (x + 2.0 * x1 + x2) + self.b1 * y1 + self.b2 * y2;
            (x2, x1, y2, y1) = (x1, x, y1, y);
            *value = y;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wave(frequency: f64, step: f64, length: f64) -> Signal {
        let n = (length / step) as usize;
        let values = (0..n).map(|k| (2.0 * PI * frequency * step * k as f64).sin()).collect();
        Signal { start: 0.0, step, values, resampled: false }
    }

    /// Amplitudes in phase and out of phase with the wave, over whole periods in the middle.
    fn response(class: Cfc, frequency: f64, step: f64) -> [f64; 2] {
        let periods = (1.0 / (frequency * step)).round() as usize;
        let signal = wave(frequency, step, 40.0 / frequency + 0.3);
        let out = filtered(&signal, class).unwrap();
        let from = out.values.len() / 2;
        let mut sums = [0.0; 2];
        for k in from..from + 4 * periods {
            let phase = 2.0 * PI * frequency * step * k as f64;
            sums[0] += out.values[k] * phase.sin();
            sums[1] += out.values[k] * phase.cos();
        }
        sums.map(|s| 2.0 * s / (4 * periods) as f64)
    }

    #[test]
    fn waves_keep_their_phase_and_lose_what_two_butterworth_passes_take() {
        let step = 1e-5;
        for class in Cfc::ALL {
            for frequency in [20.0, 100.0, 200.0, 500.0, 1000.0, 2000.0] {
                let [in_phase, out_of_phase] = response(class, frequency, step);
                // The bilinear transform maps frequencies by the tangent, exactly at the corner.
                let tangent = |f: f64| (PI * f * step).tan();
                let ratio = tangent(frequency) / tangent(CORNER * f64::from(class.number()));
                let exact = 1.0 / (1.0 + ratio.powi(4));
                // The rest is what the held ends have sent into the middle: nothing but round-off.
                assert!(
                    (in_phase - exact).abs() < 1e-9,
                    "{class:?} {frequency}: {in_phase} {exact}"
                );
                assert!(out_of_phase.abs() < 1e-9, "{class:?} {frequency}: {out_of_phase}");
            }
        }
    }

    #[test]
    fn classes_lie_in_the_corridor_of_sae_j211() {
        let decibels = |class: Cfc, frequency: f64| {
            let [amplitude, _] = response(class, frequency, 1e-5);
            20.0 * amplitude.log10()
        };
        // From 0.1 Hz to the class within +-0.5 dB (+0.5, -1 at the class itself); 3 dB down at the cut-off.
        assert!(decibels(Cfc::Class60, 20.0).abs() < 0.5);
        assert!((-1.0..0.5).contains(&decibels(Cfc::Class600, 500.0)));
        for (class, cut_off) in [(Cfc::Class60, 100.0), (Cfc::Class600, 1000.0)] {
            // 1.6667 is 2.0775 (sqrt 2 - 1)^(1/4) to 1e-4, and a decibel falls by a tenth within 0.7 %.
            assert!((decibels(class, cut_off) + 10.0 * 2f64.log10()).abs() < 0.01);
            // Beyond, 24 dB an octave.
            assert!(decibels(class, 5.0 * cut_off) < -40.0);
        }
        assert!((Cfc::Class180.cut_off() - 300.0).abs() < 1e-9);
    }

    #[test]
    fn constants_pass_unchanged_and_coarse_sampling_is_refused() {
        let constant = Signal { start: 0.0, step: 1e-4, values: vec![3.0; 50], resampled: false };
        let out = filtered(&constant, Cfc::Class60).unwrap();
        assert!(out.values.iter().all(|v| (v - 3.0).abs() < 1e-12));
        let refused = filtered(&constant, Cfc::Class1000).unwrap_err();
        assert!(refused.to_string().contains("needs 16500 samples per second"), "{refused}");
        assert!(filtered(&constant, Cfc::Class600).is_ok());
    }
}
