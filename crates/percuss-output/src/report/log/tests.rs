//! The impact log of summaries.

use super::*;

fn run() -> Value {
    let impact = |k: i32| {
        json!({ "time": 0.1 + 1e-4 * f64::from(k), "impulse": 0.5, "approach_velocity": 1.0 / f64::from(1 + k),
            "separation_velocity": 0.1, "restitution": 0.1, "place": {}, "energy": { "lost": 0.25 } })
    };
    let impacts: Vec<Value> = (0..10).chain([5000]).map(impact).collect();
    json!({
        "time": 1.0,
        "contact": { "tap": { "between": ["strip", "floor"], "impacts": impacts, "impact_count": 11, "intervals": [] } },
        "support": { "bracket": { "intervals": [
            { "start": 0.3, "end": 0.31, "impulse": 7.0, "peak_force": { "value": 900.0, "time": 0.305 } }] } },
    })
}

#[test]
fn chatter_is_one_row_with_its_touches_folded_below() {
    let page = render(&run());
    assert!(
        page.contains("10\u{a0}contacts in 0.9\u{a0}ms")
            || page.contains("10\u{a0}contacts in 900\u{a0}\u{b5}s"),
        "{page}"
    );
    assert_eq!(page.matches("data-time").count(), 3, "{page}");
    assert_eq!(page.matches("class=\"touch\" hidden").count(), 10);
    let row = page.split("<tr ").find(|row| row.contains("10\u{a0}contacts")).unwrap();
    assert!(row.contains("data-impulse=\"5e0\""), "{row}");
    assert!(row.contains("2.5\u{a0}J\u{a0}dissipated"), "{row}");
}

#[test]
fn numbers_have_five_digits_and_round_off_is_nothing() {
    let impact = |time: f64, impulse: f64| json!({ "time": time, "impulse": impulse, "place": {}, "energy": { "lost": impulse } });
    let of = |impacts: [Value; 2]| {
        render(&json!({ "time": 100.0, "contact": { "tap": {
            "between": ["a", "b"], "impacts": impacts, "impact_count": 2, "intervals": [] } } }))
    };
    let page = of([impact(1.2345678, 0.5), impact(9.8765432, 1e-14)]);
    assert!(page.contains("<td>1.2346</td>") && page.contains("<td>9.8765</td>"), "{page}");
    assert!(page.contains("<td>0</td>") && page.contains("<td>0\u{a0}J</td>"), "{page}");
    // Instants that are equal in five digits have more.
    let page = of([impact(1.2345678, 0.5), impact(1.2345687, 0.5)]);
    assert!(page.contains("<td>1.234568</td>") && page.contains("<td>1.234569</td>"), "{page}");
}

#[test]
fn stops_are_in_the_log() {
    let page = render(&run());
    let row = page.split("<tr ").find(|row| row.contains("bracket")).unwrap();
    assert!(
        row.contains("900") && row.contains("<td>7</td>") && row.contains("10\u{a0}ms"),
        "{row}"
    );
}
