//! The scene as JSON.

use percuss::scene::{
    BodyShape, DrawnStation, ObstacleOutline, OnBeam, Scene, SceneAnchor, SceneBeam, SceneBody,
    SceneFoundation, SceneLoad, SceneLoadKind, SceneObstacle, SceneSupport, SupportSymbol,
};
use serde_json::{Value, json};

/// The scene as `scene.json` has it: SI units, `null` where something is not known or never ends.
pub fn scene_value(scene: &Scene) -> Value {
    let mut value = json!({
        "beams": scene.beams.iter().map(beam_value).collect::<Vec<_>>(),
        "bodies": scene.bodies.iter().map(body_value).collect::<Vec<_>>(),
        "obstacles": scene.obstacles.iter().map(obstacle_value).collect::<Vec<_>>(),
        "supports": scene.supports.iter().map(support_value).collect::<Vec<_>>(),
        "joints": scene.joints.iter().map(|j| json!({ "name": j.name, "at": on(j.at), "turns": j.turns, "until": null }))
            .collect::<Vec<_>>(),
        "springs": scene.springs.iter().map(|s| json!({
            "name": s.name, "between": s.between.map(anchor), "springs": s.springs, "until": null,
        })).collect::<Vec<_>>(),
        "masses": scene.masses.iter().map(|m| json!({ "name": m.name, "at": on(m.at), "mass": m.mass }))
            .collect::<Vec<_>>(),
        "loads": scene.loads.iter().map(load_value).collect::<Vec<_>>(),
        "parted": [],
        "contacts": scene.contacts.iter().map(|c| json!({
            "name": c.name, "between": c.between, "rigid": c.rigid,
        })).collect::<Vec<_>>(),
    });
    if !scene.foundations.is_empty() {
        value["foundations"] = scene.foundations.iter().map(foundation_value).collect();
    }
    value
}

fn foundation_value(foundation: &SceneFoundation) -> Value {
    json!({
        "name": foundation.name,
        "beam": foundation.beam,
        "stretch": foundation.stretch,
        "direction": foundation.direction,
        "lifts": foundation.lifts,
    })
}

fn beam_value(beam: &SceneBeam) -> Value {
    let column =
        |f: &dyn Fn(&DrawnStation) -> f64| -> Vec<f64> { beam.stations.iter().map(f).collect() };
    let mut value = json!({
        "name": beam.name,
        "s": column(&|s| s.s),
        "x": column(&|s| s.position[0]),
        "y": column(&|s| s.position[1]),
        "tx": column(&|s| s.tangent[0]),
        "ty": column(&|s| s.tangent[1]),
        "half_depth": column(&|s| s.half_depth),
        "area": column(&|s| s.area),
        "inertia": column(&|s| s.inertia),
        "roundings": beam.roundings,
    });
    if beam.shear_flexible {
        value["shear_flexible"] = json!(true);
        value["bent"] = json!(beam.bent);
    }
    value
}

fn body_value(body: &SceneBody) -> Value {
    let shape = match body.shape {
        BodyShape::Disc { radius } => json!({ "kind": "disc", "radius": radius }),
        BodyShape::Guided { direction, elastic, strikes, standoff } => json!({
            "kind": "guided", "direction": direction, "elastic": elastic,
            "strikes": on(strikes), "standoff": standoff,
        }),
        BodyShape::Rear => json!({ "kind": "rear" }),
        BodyShape::Obstacle => json!({ "kind": "obstacle" }),
    };
    with(json!({ "name": body.name, "position": body.position }), shape)
}

fn obstacle_value(obstacle: &SceneObstacle) -> Value {
    let outline = match &obstacle.outline {
        ObstacleOutline::HalfPlane { point, normal } => {
            json!({ "kind": "half-plane", "point": point, "normal": normal })
        }
        ObstacleOutline::Disc { centre, radius } => {
            json!({ "kind": "disc", "centre": centre, "radius": radius })
        }
        ObstacleOutline::Walls { ends, thickness } => {
            json!({ "kind": "walls", "ends": ends, "thickness": thickness })
        }
    };
    with(json!({ "name": obstacle.name, "body": obstacle.body }), outline)
}

fn support_value(support: &SceneSupport) -> Value {
    let symbol = match support.symbol {
        SupportSymbol::Clamp => json!({ "kind": "clamp" }),
        SupportSymbol::Pin => json!({ "kind": "pin" }),
        SupportSymbol::Roller { direction } => {
            json!({ "kind": "roller", "direction": direction })
        }
        SupportSymbol::Guide => json!({ "kind": "guide" }),
        SupportSymbol::Elastic { direction } => {
            json!({ "kind": "elastic", "direction": direction })
        }
        SupportSymbol::Stop { direction, gap, two_sided } => json!({
            "kind": "stop", "direction": direction, "gap": gap, "two_sided": two_sided,
        }),
    };
    let until = support.until.is_finite().then_some(support.until);
    let plain = json!({
        "name": support.name, "at": on(support.at), "moves": support.moves, "until": until,
    });
    with(plain, symbol)
}

fn load_value(load: &SceneLoad) -> Value {
    let kind = match load.kind {
        SceneLoadKind::Gravity { acceleration } => {
            json!({ "kind": "gravity", "acceleration": acceleration })
        }
        SceneLoadKind::Base { acceleration } => {
            json!({ "kind": "base", "acceleration": acceleration })
        }
        SceneLoadKind::Point { at, force, moment } => {
            json!({ "kind": "point", "at": on(at), "force": force, "moment": moment })
        }
        SceneLoadKind::Strain { beam, stretch } => {
            json!({ "kind": "strain", "beam": beam, "stretch": stretch })
        }
        SceneLoadKind::Distributed { beam, stretch, force } => json!({
            "kind": "distributed", "beam": beam, "stretch": stretch, "force": force,
        }),
    };
    with(json!({ "name": load.name, "follower": load.follower }), kind)
}

fn on(place: OnBeam) -> Value {
    json!({ "beam": place.beam, "s": place.s })
}

fn anchor(anchor: SceneAnchor) -> Value {
    match anchor {
        SceneAnchor::Beam(place) => on(place),
        SceneAnchor::Body(body) => json!({ "body": body }),
        SceneAnchor::Ground(position) => json!({ "position": position }),
    }
}

/// One object of the entries of two.
fn with(mut value: Value, more: Value) -> Value {
    if let (Value::Object(entries), Value::Object(more)) = (&mut value, more) {
        entries.extend(more);
    }
    value
}
