//! Time and size of a history of many rows: `cargo run --release --example measure_history [rows]`.

use std::time::Instant;

use percuss::{Channel, Recorder, RecorderError};
use percuss_output::{HistoryFormat, HistoryWriter, read_history};

const COLUMNS: usize = 35;

fn main() -> Result<(), RecorderError> {
    let rows: usize = std::env::args().nth(1).map_or(Ok(1_000_000), |text| text.parse())?;
    let channels: Vec<Channel> = (0..COLUMNS)
        .map(|k| Channel { name: format!("c.{k}"), unit: "m", description: String::new() })
        .collect();
    let dir = std::env::temp_dir().join(format!("percuss-measure-{}", std::process::id()));
    std::fs::create_dir_all(&dir)?;
    for format in [HistoryFormat::Parquet, HistoryFormat::Csv] {
        let mut writer = HistoryWriter::new(&dir, format, "");
        let mut row = [0.0; COLUMNS];
        let mut inside = std::time::Duration::ZERO;
        writer.begin(&channels)?;
        for r in 0..rows {
            let t = r as f64 * 1e-5;
            let (sin, cos) = t.sin_cos();
            for (k, value) in row.iter_mut().enumerate() {
                *value = sin * (k as f64 + 0.3) + cos;
            }
            row[0] = t;
            if r % 64 == 0 {
                row[COLUMNS - 1] = -0.1;
            }
            let start = Instant::now();
            writer.row(&row)?;
            inside += start.elapsed();
        }
        let start = Instant::now();
        let file = writer.finish()?.ok_or("no rows")?;
        inside += start.elapsed();
        let size = std::fs::metadata(&file.path)?.len() as f64 / 1e6;
        let start = Instant::now();
        let back = read_history(&dir)?;
        println!(
            "{format:?}: {rows} rows x {COLUMNS}: {:.3} us a row (timer included), {size:.1} MB, \
             read back {} rows in {:.0} ms",
            inside.as_secs_f64() * 1e6 / rows as f64,
            back.rows(),
            start.elapsed().as_secs_f64() * 1e3,
        );
        std::fs::remove_file(&file.path)?;
    }
    std::fs::remove_dir_all(&dir)?;
    Ok(())
}
