//! `percuss plot`: figures of a finished run for print.

use crate::common;

use common::Sandbox;

fn sandbox() -> Sandbox {
    let sandbox = Sandbox::new();
    sandbox.percuss(&["run", "elastic.toml", "--out", "hit", "--no-report", "-q"]).ends_with(0);
    sandbox
}

/// The bytes of a big-endian number behind a mark.
fn number_behind(bytes: &[u8], mark: &[u8]) -> u32 {
    let at = bytes.windows(mark.len()).position(|w| w == mark).expect("the mark") + mark.len();
    u32::from_be_bytes(bytes[at..at + 4].try_into().unwrap())
}

#[test]
fn the_list_names_what_can_be_plotted() {
    let sandbox = sandbox();
    let listed = sandbox.percuss(&["plot", "hit", "--list"]);
    listed.ends_with(0);
    assert!(
        listed.stdout.lines().any(|line| line.starts_with("energy ") && line.ends_with(" Energy"))
    );
    let ids: Vec<&str> =
        listed.stdout.lines().filter_map(|line| line.split_whitespace().next()).collect();
    assert!(ids.contains(&"force") && ids.len() > 5, "{ids:?}");
    let before = sandbox.names();
    sandbox
        .percuss(&["plot", "hit", "--figure", "forse"])
        .ends_with(2)
        .tells("did you mean `force`?");
    assert_eq!(sandbox.names(), before);
    // Each of them can be had by its id.
    for id in ids {
        sandbox
            .percuss(&["plot", "hit", "--figure", id, "--format", "svg", "--out", "all"])
            .ends_with(0);
    }
    assert_eq!(common::names(&sandbox.path("all")).len(), listed.stdout.lines().count());
}

#[test]
fn figures_are_as_wide_on_paper_as_asked_for() {
    let sandbox = sandbox();
    let arguments =
        ["plot", "hit", "--figure", "force,energy", "--format", "svg,pdf,png", "--width"];
    for (width, millimetres) in [("85mm", 85.0), ("17.4 cm", 174.0)] {
        sandbox.percuss(&[&arguments[..], &[width, "--out", "figures"]].concat()).ends_with(0);
        let names =
            ["energy.pdf", "energy.png", "energy.svg", "force.pdf", "force.png", "force.svg"];
        assert_eq!(common::names(&sandbox.path("figures")), names);
        let read = |name: &str| std::fs::read(sandbox.path("figures").join(name)).unwrap();
        let near = |found: f64| {
            assert!((found - millimetres).abs() < 0.15, "{found} mm for {millimetres} mm");
        };
        for name in ["energy", "force"] {
            let svg = String::from_utf8(read(&format!("{name}.svg"))).unwrap();
            let wide = svg.split_once("<svg width=\"").unwrap().1.split_once("mm\"").unwrap().0;
            near(wide.parse().unwrap());
            assert!(!svg.contains("<text") && !svg.contains("font-family"), "letters are outlines");
            let pdf = read(&format!("{name}.pdf"));
            let text = String::from_utf8_lossy(&pdf);
            let size = text.split_once("/MediaBox [0 0 ").unwrap().1;
            let points: f64 = size.split_once(' ').unwrap().0.parse().unwrap();
            near(points / 72.0 * 25.4);
            assert!(!text.contains("/Font "), "letters are outlines");
            let png = read(&format!("{name}.png"));
            let (pixels, a_metre) = (number_behind(&png, b"IHDR"), number_behind(&png, b"pHYs"));
            near(f64::from(pixels) / f64::from(a_metre) * 1000.0);
        }
    }
    sandbox.percuss(&["plot", "hit", "--width", "85 kg"]).ends_with(2).tells("85mm");
    sandbox.percuss(&["plot", "hit", "--width", "85"]).ends_with(2).tells("85mm");
}

#[test]
fn nothing_is_written_where_files_of_others_are_in_the_way() {
    let sandbox = sandbox();
    std::fs::create_dir(sandbox.path("figures")).unwrap();
    sandbox.put("figures/force.pdf", "mine");
    let arguments =
        ["plot", "hit", "--figure", "energy,force", "--format", "pdf", "--out", "figures"];
    sandbox.percuss(&arguments).ends_with(2).tells("force.pdf");
    assert_eq!(common::names(&sandbox.path("figures")), ["force.pdf"]);
    assert_eq!(std::fs::read_to_string(sandbox.path("figures/force.pdf")).unwrap(), "mine");
    sandbox.percuss(&[&arguments[..], &["--force"]].concat()).ends_with(0);
    sandbox.percuss(&arguments).ends_with(0);
    assert_eq!(common::names(&sandbox.path("figures")), ["energy.pdf", "force.pdf"]);
    // The run itself is left as it is.
    assert!(!sandbox.path("hit/figures").exists());
}
