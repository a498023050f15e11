//! Codes of faults: each can be provoked, and stands behind the message.

use percuss::Fault;
use percuss_scenario::{Diagnostics, FaultCode, StudyFile, apply_overrides, read};

const ELASTIC: &str = include_str!("../files/elastic.toml");

/// A fault of each kind: what is replaced in the elastic example, and by what.
fn provoked(code: FaultCode) -> Diagnostics {
    let (from, to) = match code {
        FaultCode::File => (ELASTIC, " "),
        FaultCode::Syntax => ("[time]", "[time"),
        FaultCode::UnknownKey => ("[time]", "[time]\nstride = 1"),
        FaultCode::MissingKey => ("mass = \"500 kg\"", ""),
        FaultCode::ValueType => ("mass = \"500 kg\"", "mass = true"),
        FaultCode::Unit => ("500 kg", "500 s"),
        FaultCode::UnknownName => ("kind = \"elastic\"", "kind = \"elastik\""),
        FaultCode::Conflict => {
            ("standoff =", "contact = \"surface\"\nposition = [0, 1]\nstandoff =")
        }
        FaultCode::InvalidName => ("[time]", "[obstacle.\"a.b\"]\nkind = \"disc\"\n[time]"),
        FaultCode::Table => {
            let load = "[load.blow]\nkind = \"point\"\nat = \"girder@0.5\"\nforce = [0, 1]\n\
                        function = { kind = \"table\", file = \"none.csv\" }\n[time]";
            ("[time]", load)
        }
        FaultCode::Change => {
            let change = ["projectile.nobody.mass=1".to_string()];
            return apply_overrides(ELASTIC, "f.toml", &change).expect_err("no such projectile");
        }
        FaultCode::Setting => ("[time]", "[record]\nshapes = -1\n[time]"),
        FaultCode::Section => ("area = \"1e3 cm^2\"", "area = \"-1 m^2\""),
        FaultCode::Beam => ("elements = 6", "elements = 0"),
        FaultCode::Connection => ("[time]", "[mass.bob]\nat = \"girder.start\"\nmass = -1\n[time]"),
        FaultCode::Body => ("500 kg", "-500 kg"),
        FaultCode::Contact => {
            let disc = "[obstacle.post]\nkind = \"disc\"\ncentre = [9, 9]\nradius = 1\n[time]";
            ("[time]", disc)
        }
        FaultCode::Load => {
            ("[time]", "[load.blow]\nkind = \"point\"\nat = \"girder@7\"\nforce = [0, 1]\n[time]")
        }
        FaultCode::Initial => (
            "[time]",
            "[mass.girder]\nat = \"girder.mid\"\nmass = 1\n[initial.girder]\nvelocity = [1, 0]\n[time]",
        ),
        FaultCode::Damping => ("[time]", "[damping]\nmodal = 7\nmodes = 1\n[time]"),
        // What a study names in its base scenario is looked up by whoever runs it.
        FaultCode::Study => {
            let study = StudyFile::read("base = \"f.toml\"\n[design]\nkind = \"grid\"", "s.toml")
                .expect("a study");
            let fault = Fault::new("base", "no such file", "a scenario");
            return study.settle(vec![fault]).expect_err("no base");
        }
        FaultCode::Checksum => {
            let load = "[load.blow]\nkind = \"point\"\nat = \"girder@0.5\"\nforce = [0, 1]\n\
                        function = { kind = \"table\", file = \"tests/files/pulse.csv\", sha256 = \
                        \"0000000000000000000000000000000000000000000000000000000000000000\" }\n[time]";
            ("[time]", load)
        }
        FaultCode::Analysis => ("[time]", "[path]\npoints = 0\n[time]"),
    };
    assert!(ELASTIC.contains(from), "{from}");
    let text = ELASTIC.replacen(from, to, 1);
    let faults = read(&text, "f.toml").and_then(|s| s.compile().map(|_| ()));
    faults.err().unwrap_or_else(|| panic!("no fault for {code:?}"))
}

#[test]
fn every_code_can_be_provoked_and_stands_behind_its_message() {
    let mut missed = Vec::new();
    for code in FaultCode::ALL {
        let faults = provoked(code);
        if !faults.all().iter().any(|fault| fault.code == code) {
            missed.push(format!("{code:?}: {}", faults.coded()));
        }
        let lines = faults.all().iter().map(|fault| format!("{fault} [{}]", fault.code.code()));
        assert!(
            lines.zip(faults.coded().lines()).all(|(one, reported)| reported.ends_with(&one)),
            "{faults}"
        );
    }
    assert!(missed.is_empty(), "{}", missed.join("\n"));
}

#[test]
fn codes_are_unique_and_in_order() {
    let codes: Vec<&str> = FaultCode::ALL.iter().map(|one| one.code()).collect();
    let counted: Vec<String> = (1..=codes.len()).map(|k| format!("E{k:03}")).collect();
    assert_eq!(codes, counted);
    assert!(FaultCode::ALL.iter().all(|&one| FaultCode::of_code(one.code()) == Some(one)));
}
