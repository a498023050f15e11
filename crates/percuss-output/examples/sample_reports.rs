//! Reports of made-up runs, to look at: `cargo run --release --example sample_reports DIR`.

#[path = "../tests/suite/synthetic/mod.rs"]
mod synthetic;

use std::path::{Path, PathBuf};
use std::time::Instant;

use percuss::*;
use percuss_advice::{advise, compare};
use percuss_output::{
    ComparisonSeries, History, HistoryFormat, HistoryWriter, RunDirectory, RunInfo, report,
    summary_value, write_comparison, write_impacts, write_summary,
};

const SCENARIO: &str =
    "title = \"made up\" # </script> & <b>\n[projectile.hammer]\nkind = \"rigid\"\n";

fn main() -> Result<(), RecorderError> {
    let out = PathBuf::from(std::env::args().nth(1).ok_or("give a directory")?);
    sample(&out.join("elastic"), |w| synthetic::elastic(w, "mass", 1501, 0.15), elastic_summary())?;
    sample(&out.join("rigid"), |w| synthetic::rigid(w, "hammer", 2000, 1.0), rigid_summary())?;
    table_tennis(&out.join("discs"))?;
    let rows = 1_000_001;
    sample(&out.join("million"), |w| synthetic::elastic(w, "mass", rows, 0.3), elastic_summary())?;
    Ok(())
}

/// Two discs, one thrown obliquely on a beam with friction, one dropped on a Hertz contact, over a floor: a run of the core.
fn table_tennis(out: &Path) -> Result<(), RecorderError> {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("steel", 2e11, 7850.0));
    let section = b.section(Section::rectangle("bar", 0.05, 0.02));
    let girder = b.beam(Beam::new("girder", &[[0.0, 0.0], [2.0, 0.0]], 20, material, section));
    let at = |name: &str, along| PointRef {
        label: name.to_owned(),
        beam: girder,
        along: Along::Fraction(along),
    };
    b.support(Support::new("left", at("girder.start", 0.0), SupportKind::Pin));
    b.support(Support::new("right", at("girder.end", 1.0), SupportKind::Pin));
    b.record_point(at("girder.mid", 0.5));
    b.load(Load::new("gravity", LoadKind::Gravity { acceleration: [0.0, -9.81] }));
    let disc = |name: &str, position, velocity| Disc {
        name: name.to_owned(),
        mass: 0.5,
        inertia: None,
        radius: 0.03,
        position,
        velocity,
        spin: 0.0,
    };
    let ball = b.disc(disc("ball", [0.4, 0.2], [1.5, -3.0]));
    let drop = b.disc(disc("drop", [1.4, 0.3], [0.0, 0.0]));
    let shape = ObstacleShape::HalfPlane { point: [0.0, -0.05], normal: [0.0, 1.0] };
    let floor = b.obstacle(Obstacle { name: "floor".to_owned(), shape, motion: None });
    let rigid = TouchLaw::Rigid(RigidLaw { friction: 0.3, ..RigidLaw::frictionless(0.6) });
    let hertz = TouchLaw::Smooth(SmoothLaw::elastic(Potential::Hertz { stiffness: 1e8 }));
    let beam = ContactPartner::Beam(girder);
    b.contact(Contact::new("bounce", [beam, ContactPartner::Disc(ball)], rigid.clone()));
    b.contact(Contact::new("indentation", [beam, ContactPartner::Disc(drop)], hertz));
    b.contact(Contact::new(
        "floor",
        [ContactPartner::Disc(ball), ContactPartner::Obstacle(floor)],
        rigid,
    ));
    let model = b.build().map_err(|faults| format!("{faults:?}"))?;
    let settings = Settings::new(0.8, 5e-5);
    let dir = RunDirectory::create(out)?;
    let mut writer = HistoryWriter::new(dir.path(), HistoryFormat::Parquet, SCENARIO);
    let run = simulate(&model, &settings, &mut writer).map_err(|faults| format!("{faults:?}"))?;
    writer.finish()?;
    let (advice, comparisons) = (advise(&model, &settings), compare(&model, &settings, &run));
    let info = RunInfo {
        title: "Two discs on a bar",
        settings: &settings,
        wall_seconds: 0.1,
        advice: &advice,
        warnings: &[],
        comparisons: &comparisons,
    };
    write_summary(dir.path(), &summary_value(&run, info))?;
    write_impacts(dir.path(), &run.contacts, &run.supports)?;
    report::write_with_figures(dir.path(), &report::ReportData::read(dir.path())?)?;
    dir.commit()?;
    Ok(())
}

fn elastic_summary() -> RunSummary {
    synthetic::summary("mass", synthetic::smooth())
}

fn rigid_summary() -> RunSummary {
    synthetic::summary("hammer", synthetic::impacts(250))
}

fn sample(
    out: &Path,
    record: impl Fn(&mut HistoryWriter) -> Result<(), RecorderError>,
    run: RunSummary,
) -> Result<(), RecorderError> {
    let dir = RunDirectory::create(out)?;
    std::fs::write(dir.path().join("scenario.toml"), SCENARIO)?;
    let mut writer = HistoryWriter::new(dir.path(), HistoryFormat::Parquet, SCENARIO);
    record(&mut writer)?;
    writer.finish()?;
    let title = format!("Made-up run \"{}\" <with markup> & accents", run.contacts[0].name);
    let settings = Settings::new(0.15, 1e-4);
    let name = &run.contacts[0].name;
    let (advice, comparisons) = (synthetic::advice(name), synthetic::comparisons(name));
    let info = RunInfo {
        title: &title,
        settings: &settings,
        wall_seconds: 0.0421,
        advice: &advice,
        warnings: &[],
        comparisons: &comparisons,
    };
    write_summary(dir.path(), &summary_value(&run, info))?;
    if run.contacts[0].name == "hammer" {
        write_comparison(dir.path(), &comparison()?)?;
    }

    let start = Instant::now();
    let data = report::ReportData::read(dir.path())?;
    let read = start.elapsed();
    report::write_with_figures(dir.path(), &data)?;
    let page = std::fs::metadata(dir.path().join("report.html"))?.len() as f64 / 1e6;
    println!(
        "{}: {} rows, read {:.0} ms, report {:.0} ms, page {page:.2} MB",
        out.display(),
        data.history.rows(),
        read.as_secs_f64() * 1e3,
        (start.elapsed() - read).as_secs_f64() * 1e3,
    );
    dir.commit()?;
    Ok(())
}

fn comparison() -> Result<Vec<ComparisonSeries>, RecorderError> {
    let mut all = Vec::new();
    for restitution in [1.0, 0.5, 0.0] {
        let mut recorder = percuss::MemoryRecorder::default();
        synthetic::rigid(&mut recorder, "hammer", 1000, restitution)?;
        let label = format!("restitution {restitution}");
        all.extend(ComparisonSeries::from_history(label, &History::from(&recorder)));
    }
    Ok(all)
}
