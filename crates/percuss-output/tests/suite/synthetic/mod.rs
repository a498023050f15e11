//! Histories with known formulas, in place of a solver.

#![allow(dead_code)] // each test uses its part

use std::f64::consts::PI;

use percuss::{
    AuditSummary, Channel, ContactInterval, ContactPlace, ContactRecord, ContactSummary,
    EffectiveMass, EnergySplit, EnergySummary, Envelope, Impact, MomentumSummary, Peak,
    PointSummary, ProjectileSummary, Range, Recorder, RecorderError, RunSummary,
    SectionForceSummary, SectionPeak, SectionRange, SupportSummary, Termination,
};
use percuss_advice::{Advice, Comparison, Topic, Verdict};

const MASS: f64 = 500.0;
const SPEED: f64 = 20.0;
const STANDOFF: f64 = 0.2;
const OMEGA: f64 = 40.0;

/// Channels as the core names them, with the given contact quantity.
pub fn channels(projectile: &str, contact: (&str, &'static str), point: &str) -> Vec<Channel> {
    let p = |what: &str| format!("projectile.{projectile}.{what}");
    let q = |what: &str| format!("point.{point}.{what}");
    let mut list: Vec<(String, &'static str)> = vec![
        ("time".into(), "s"),
        (p("position_1"), "m"),
        (p("position_2"), "m"),
        (p("velocity_1"), "m/s"),
        (p("velocity_2"), "m/s"),
        (format!("contact.{projectile}.gap"), "m"),
        (format!("contact.{projectile}.{}", contact.0), contact.1),
        (q("displacement_1"), "m"),
        (q("displacement_2"), "m"),
        (q("velocity_1"), "m/s"),
        (q("velocity_2"), "m/s"),
    ];
    for name in [
        "kinetic",
        "kinetic_beams",
        "kinetic_projectiles",
        "strain",
        "strain_axial",
        "strain_bending",
        "contact",
        "springs",
        "total",
        "work_loads",
        "work_supports",
        "loss_impacts",
        "loss_damping",
        "residual",
    ] {
        list.push((format!("energy.{name}"), "J"));
    }
    for name in ["linear_1", "linear_2", "residual_1", "residual_2"] {
        list.push((format!("momentum.{name}"), "kg*m/s"));
    }
    for name in ["angular", "residual_angular"] {
        list.push((format!("momentum.{name}"), "kg*m^2/s"));
    }
    list.push(("audit.curvature_drift".into(), "1/m"));
    list.push(("audit.membrane_drift".into(), "1"));
    list.push(("audit.angular_rate_drift".into(), "J"));
    list.push(("solver.newton_iterations".into(), "1"));
    list.push(("support.left.force_1".into(), "N"));
    list.push(("support.left.force_2".into(), "N"));
    list.push(("support.left.moment".into(), "N*m"));
    list.push((format!("section.{point}.axial"), "N"));
    list.push((format!("section.{point}.shear"), "N"));
    list.push((format!("section.{point}.moment"), "N*m"));
    list.into_iter()
        .map(|(name, unit)| Channel { description: format!("The {name}."), name, unit })
        .collect()
}

/// A half-sine contact: an elastic mass meets a point that gives way like a sine.
pub fn elastic(
    recorder: &mut dyn Recorder,
    name: &str,
    rows: usize,
    end: f64,
) -> Result<(), RecorderError> {
    recorder.begin(&channels(name, ("force", "N"), "girder.mid"))?;
    let touch = STANDOFF / SPEED;
    let half = PI / OMEGA;
    for r in 0..rows {
        let t = end * r as f64 / (rows - 1).max(1) as f64;
        let s = (t - touch).clamp(0.0, half) * OMEGA;
        let after = (t - touch - half).max(0.0);
        let closed = s > 0.0 && s < PI;
        let ringing = 0.3 * (2.0 * PI * 31.0 * after).sin() * 0.1;
        let way = SPEED * t.min(touch) + SPEED / OMEGA * s.sin() - 0.95 * SPEED * after;
        let velocity = if closed {
            SPEED * s.cos()
        } else if after > 0.0 {
            -0.95 * SPEED
        } else {
            SPEED
        };
        let u = 0.178 * s.sin() + ringing * 0.1;
        let v = if closed { 0.178 * OMEGA * s.cos() } else { 0.3 * (31.0 * after).cos() };
        let force = if closed { 3.4e5 * s.sin() } else { 0.0 };
        let kinetic = 0.5 * MASS * velocity * velocity;
        let strain = if closed { 6.0e4 * s.sin().powi(2) } else { 9.7e3 * f64::from(after > 0.0) };
        let contact = 1e5 - kinetic - strain;
        let wobble = 1e-7 * (t * 900.0).sin() * (t * 40.0);
        recorder.row(&[
            t,
            1.5,
            way - STANDOFF,
            0.0,
            velocity,
            STANDOFF + u - way,
            force,
            0.0,
            u,
            0.0,
            v,
            kinetic,
            0.0,
            kinetic,
            strain,
            0.02 * strain,
            0.98 * strain,
            contact,
            0.0,
            1e5 + wobble,
            0.0,
            0.0,
            0.0,
            300.0 * t,
            wobble,
            1e-14,
            MASS * velocity,
            0.0,
            wobble * 1e-3,
            1.5 * MASS * velocity,
            wobble * 2e-3,
            1e-9 * t,
            0.0,
            0.0,
            3.0,
            1e-14,
            -0.6 * force,
            0.1 * force,
            1e-9 * force,
            0.5 * force,
            -0.7 * force,
        ])?;
    }
    Ok(())
}

/// A rigid mass that bounces off a swinging point three times.
pub fn rigid(
    recorder: &mut dyn Recorder,
    name: &str,
    rows: usize,
    restitution: f64,
) -> Result<(), RecorderError> {
    recorder.begin(&channels(name, ("impulse", "N*s"), "girder.mid"))?;
    let end = 0.02;
    let (mass, gap0) = (100.0, 0.02);
    let impacts = [(0.0005, 3814.98), (0.00511715, 1366.99), (0.00565332, 1841.04)];
    let (mut velocity, mut position, mut t, mut next) = (-40.0, gap0, 0.0, 0);
    let mut energy = 0.5 * mass * velocity * velocity;
    let point = |t: f64| {
        let s = (t - 0.0005_f64).max(0.0);
        (-0.012 * (s * 900.0).sin() * (1.0 + 0.4 * (s * 3000.0).sin()), -10.8 * (s * 900.0).cos())
    };
    let mut rows_left = rows;
    let dt = end / rows as f64;
    let mut row = |t: f64, position: f64, velocity: f64, impulse: f64, energy: f64, after: bool| {
        let (u, v) = if t > 0.0005 || after { point(t) } else { (0.0, 0.0) };
        let kinetic = 0.5 * mass * velocity * velocity;
        let rest = energy - kinetic;
        let noise = 1e-8 * (t * 7e4).sin();
        recorder.row(&[
            t,
            1.5,
            position,
            0.0,
            velocity,
            position - u,
            impulse,
            0.0,
            u,
            0.0,
            v,
            kinetic + 0.4 * rest,
            0.4 * rest,
            kinetic,
            0.6 * rest,
            0.1 * rest,
            0.5 * rest,
            0.0,
            0.0,
            energy,
            0.0,
            0.0,
            80_000.0 - energy,
            0.0,
            noise,
            0.0,
            mass * velocity,
            0.0,
            0.0,
            1.5 * mass * velocity,
            0.0,
            0.0,
            0.0,
            0.0,
            4.0,
            0.0,
            -1e6 * u,
            2e5 * u,
            0.0,
            1e6 * u,
            1e6 * u,
        ])
    };
    row(0.0, position, velocity, 0.0, energy, false)?;
    while rows_left > 0 {
        rows_left -= 1;
        let step_end = t + dt;
        if next < impacts.len() && step_end >= impacts[next].0 {
            let (at, impulse) = impacts[next];
            position += velocity * (at - t);
            row(at, position, velocity, 0.0, energy, false)?;
            velocity += (1.0 + restitution) / 2.0 * impulse / mass;
            energy *= 1.0 - 0.1 * (1.0 - restitution * restitution);
            row(at + 1e-9, position, velocity, (1.0 + restitution) / 2.0 * impulse, energy, true)?;
            t = at;
            next += 1;
        }
        position += velocity * (step_end - t);
        t = step_end;
        row(t, position, velocity, 0.0, energy, false)?;
    }
    Ok(())
}

/// A summary with the given contact record.
pub fn summary(projectile: &str, record: ContactRecord) -> RunSummary {
    RunSummary {
        step_control: None,
        foundations: Vec::new(),
        termination: Termination::Completed,
        time: 0.15,
        steps: 1500,
        solver_steps: 1503,
        step_cuts: 0,
        accumulated_steps: 0,
        newton_iterations: 4511,
        factorizations: 4511,
        rows: 1501,
        energy: EnergySummary {
            initial: 1e5,
            final_: 1e5,
            work_loads: 0.0,
            work_supports: 0.0,
            loss_impacts: 0.0,
            loss_damping: 120.0,
            plastic: 0.0,
            hardening: 0.0,
            failure: 0.0,
            scale: 1e5,
            residual_max: 5.9e-12,
        },
        momentum: MomentumSummary {
            linear_scale: 1e4,
            linear_residual_max: 3e-13,
            angular_scale: 1.5e4,
            angular_residual_max: 4e-13,
        },
        audit: AuditSummary {
            curvature_drift_max: 0.0,
            membrane_drift_max: 0.0,
            angular_rate_drift_max: 0.0,
        },
        projectiles: vec![ProjectileSummary {
            name: projectile.to_owned(),
            direction: Some([0.0, 1.0]),
            strikes: Some("girder.mid".to_owned()),
            velocity_final: [0.0, -19.10077444],
            spin_final: 0.0,
            momentum_transferred: 19550.3,
            energy_given: 8790.1,
            energy_received_by_others: 8790.1,
        }],
        contacts: vec![ContactSummary {
            name: projectile.to_owned(),
            between: ["girder.mid".to_owned(), projectile.to_owned()],
            effective_mass: Some(EffectiveMass { on_mesh: 91.2, limit: 17.3 }),
            permanent_penetration: None,
            carried_crush: None,
            pressed_in: None,
            sliding: None,
            equivalent_force: None,
            no_equivalent_force: None,
            record,
        }],
        contact_residual_max: 2e-16,
        plastic: Vec::new(),
        yielding: Vec::new(),
        joints: Vec::new(),
        pulses: Vec::new(),
        multiple_impacts: percuss::MultipleImpactSummary::default(),
        points: vec![PointSummary {
            name: "girder.mid".to_owned(),
            displacement_max: [
                Peak { value: 0.0, time: 0.0 },
                Peak { value: 0.177864203, time: 0.0504933 },
            ],
            resolved: [true; 2],
            relative_to_base: false,
        }],
        supports: vec![support("left", -1.0), support("right", 1.0)],
        section_forces: vec![section_forces("girder", 1.0)],
    }
}

/// Reactions that pull and push.
pub fn support(name: &str, sign: f64) -> SupportSummary {
    let range = |min: f64, max: f64| Range {
        min: Peak { value: min, time: 0.031 },
        max: Peak { value: max, time: 0.052 },
    };
    SupportSummary {
        name: name.to_owned(),
        force: [range(-250.0, 1e3), range(-1.5e5, 8e4)],
        moment: range(-4e4 * sign.abs(), 9e4),
        impulse: [0.0, 12.5 * sign, 0.0],
        touches: None,
    }
}

/// Section forces of a beam of 3 m under a wandering load.
pub fn section_forces(name: &str, size: f64) -> SectionForceSummary {
    let range = |min: f64, max: f64| SectionRange {
        min: SectionPeak { value: min * size, s: 1.25, time: 0.06 },
        max: SectionPeak { value: max * size, s: 3.0, time: 0.05 },
    };
    let s: Vec<f64> = (0..30).flat_map(|k| [f64::from(k) * 0.1, f64::from(k + 1) * 0.1]).collect();
    let band = |low: f64, high: f64| -> [Vec<f64>; 2] {
        [low, high].map(|by| s.iter().map(|s| size * by * (PI * s / 3.0).sin()).collect())
    };
    let nothing = || [vec![f64::NAN; 60], vec![f64::NAN; 60]];
    SectionForceSummary {
        name: name.to_owned(),
        axial: range(-100.0, 1e4),
        shear: range(-2e5, 1.5e5),
        moment: range(-4e4, 9e4),
        strain: SectionRange::default(),
        stress: SectionRange::default(),
        shear_stress: SectionRange::default(),
        von_mises_inside: SectionPeak::default(),
        beyond: None,
        beyond_inside: None,
        excess: None,
        plateau: None,
        envelope: Envelope {
            axial: band(-100.0, 1e4),
            shear: band(-2e5, 1.5e5),
            moment: band(-4e4, 9e4),
            stress: nothing(),
            s,
        },
    }
}

/// Where the girder is struck.
pub fn place() -> ContactPlace {
    ContactPlace { s: 1.5, position: [1.5, 0.0] }
}

/// One contact, still closed at the end.
pub fn smooth() -> ContactRecord {
    let peak_force = Peak { value: 337_784.605, time: 0.0664362 };
    ContactRecord::Smooth {
        peak_force,
        intervals: vec![ContactInterval {
            start: 0.01,
            end: f64::NAN,
            impulse: 19_550.4,
            tangential_impulse: f64::NAN,
            peak_force,
            approach_velocity: 20.0,
            separation_velocity: f64::NAN,
            steps: 1400,
            steady: true,
            one_point: true,
            torn: false,
            place: place(),
            place_end: place(),
            energy: EnergySplit {
                given: [8000.0, -8800.0],
                lost: 50.0,
                failure: 0.0,
                stored: 750.0,
                scheme: 0.0,
            },
        }],
    }
}

/// So many equal impacts.
pub fn impacts(count: usize) -> ContactRecord {
    let impact = |k: usize| Impact {
        time: 0.0005 + 1e-5 * k as f64,
        impulse: 3814.98,
        tangential_impulse: 0.0,
        points: 1,
        approach_velocity: 40.0,
        separation_velocity: 40.0,
        place: place(),
        energy: EnergySplit { given: [79_000.0, -79_000.0], ..EnergySplit::default() },
        fallback_law: false,
    };
    ContactRecord::Nonsmooth {
        impacts: (0..count).map(impact).collect(),
        impact_count: count,
        fallback_count: 0,
        impulse_total: 3814.98 * count as f64,
        impulse_resting: 0.0,
        intervals: Vec::new(),
        penetration: Peak { value: 1e-12, time: 1e-3 },
    }
}

/// What the advisor might say.
pub fn advice(contact: &str) -> Vec<Advice> {
    let finding = |topic, value, reference, unit, verdict, text: &str| Advice {
        contact: contact.to_owned(),
        topic,
        value,
        reference,
        unit,
        verdict,
        text: text.to_owned(),
        reason: None,
    };
    vec![
        finding(Topic::FirstContact, 0.01, 0.15, "s", Verdict::Fine, "first contact at 10 ms"),
        finding(
            Topic::EffectiveMass,
            91.2,
            17.3,
            "kg",
            Verdict::Warning,
            "effective mass 91.2 kg on this mesh, tends to 17.3 kg with refinement: the impulse depends on the \
             mesh; use a compliant contact",
        ),
    ]
}

/// What hand formulas might say.
pub fn comparisons(contact: &str) -> Vec<Comparison> {
    let row = |quantity, unit, by_hand: f64, simulated: f64| Comparison {
        contact: contact.to_owned(),
        formula: "two-degree-of-freedom model",
        source: "Shivakumar, Elber and Illg 1985, with the span's reduced mass",
        quantity,
        unit,
        by_hand,
        simulated,
        difference_percent: 100.0 * (simulated - by_hand) / by_hand,
        bound: false,
        holds_if: "no damping (met); small slopes: up to 0.3 (not met)".to_owned(),
    };
    vec![
        row("largest contact force", "N", 256_570.0, 337_784.605),
        row("impulse of the first impact", "N s", 20_100.0, 19_550.4),
    ]
}
