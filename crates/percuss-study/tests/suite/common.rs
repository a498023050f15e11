//! A scenario that several tests vary.

/// A cantilever struck at its end by a mass behind a spring; a run takes some hundred steps.
pub const CANTILEVER: &str = r#"
[material.m]
preset = "steel"
[section.s]
shape = "rectangle"
width = "10 cm"
depth = "10 cm"
[beam.b]
points = [[0, 0], [1, 0]]
elements = 4
material = "m"
section = "s"
[support.left]
at = "b.start"
kind = "clamp"
[projectile.p]
kind = "elastic"
mass = 10
stiffness = 1e6
velocity = [0, 1]
strikes = "b.end"
[time]
end = 5e-3
step = 5e-5
"#;
