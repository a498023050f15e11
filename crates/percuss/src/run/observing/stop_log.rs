//! Contact intervals of stops, resolved to the steps.

use crate::summary::{Peak, SAME_SIZE, StopTouch};

/// Enters the mean force of a stop over a step of size `h` that ends at `time`.
pub fn take(touches: &mut Vec<StopTouch>, force: f64, h: f64, time: f64) {
    if let Some(touch) = touches.last_mut().filter(|touch| touch.end.is_none()) {
        if force > 0.0 {
            touch.impulse += force * h;
            // A structure at rest on it: what changes is round-off.
            let rests = touch.start == 0.0 && force <= touch.peak_force.value * (1.0 + SAME_SIZE);
            if force > touch.peak_force.value && !rests {
                touch.peak_force = Peak { value: force, time };
            }
        } else {
            touch.end = Some(time - h);
        }
    } else if force > 0.0 && touches.len() < StopTouch::KEPT {
        let peak_force = Peak { value: force, time };
        touches.push(StopTouch { start: time - h, end: None, impulse: force * h, peak_force });
    }
}
