//! The table of a finished study, read without its shards.

use percuss_study::{Study, Values, merge, read_table};

use crate::common::CANTILEVER;

fn study(results: &str) -> Study {
    let base = CANTILEVER.replace("end = 5e-3", "end = 1e-3");
    let text = format!(
        "scenario = '''{base}'''
        [parameter.speed]
        path = \"projectile.p.velocity[1]\"
        values = [1, 2, 3]
        [design]
        kind = \"grid\"
        [results]
        {results}"
    );
    Study::from_toml(&text, "study.toml").unwrap_or_else(|faults| panic!("{faults}"))
}

fn table(study: &Study) -> Vec<u8> {
    let mut bytes = Vec::new();
    let shards = (0..study.shard_count()).map(|index| Ok(study.run_shard(index)));
    merge(study, shards, &mut bytes).expect("merged");
    bytes
}

#[test]
fn a_table_is_read_by_its_study_and_by_no_other() {
    let forces = study("force = \"contact.p.peak_force.value\"");
    let bytes = table(&forces);
    let read = read_table(&bytes, &forces).expect("a table");
    let at = read.columns.iter().position(|column| column.name == "force").expect("a column");
    let Values::Number(values) = &read.values[at] else { panic!("no numbers") };
    assert!(values.len() == 3 && values.windows(2).all(|pair| pair[0] < pair[1]), "{values:?}");

    // As many columns of the same kinds, under other names.
    let ends = study("velocity = \"projectile.p.velocity_final[1]\"");
    let refused = read_table(&bytes, &ends).expect_err("another study");
    assert!(refused.is_unfit() && refused.to_string().contains("other columns"), "{refused}");
    let cut = read_table(&bytes[..bytes.len() - 9], &forces).expect_err("cut short");
    assert!(cut.is_unfit() && cut.to_string().contains("damaged"), "{cut}");
}
