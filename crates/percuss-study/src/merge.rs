//! From shards to the table of the study.

use std::io::Write;

use percuss_codes::RequestCode;

use crate::column::Values;
use crate::error::Error;
use crate::parquet::Writer;
use crate::shard::Shard;
use crate::study::Study;

/// Rows of a row group.
const GROUP_ROWS: usize = 1 << 16;

/// Writes `results.parquet` from all shards in the order of their numbers; the same shards give the same bytes.
///
/// Memory does not grow with the number of runs: shards are taken one after the other.
///
/// # Errors
/// If a shard is missing or cannot be had, or the table cannot be written.
pub fn merge<W: Write + Send>(
    study: &Study,
    shards: impl IntoIterator<Item = Result<Shard, Error>>,
    out: W,
) -> Result<(), Error> {
    let fault = |e: parquet::errors::ParquetError| {
        Error::system(format!("the results cannot be written: {e}"))
    };
    let more = vec![("percuss.study", study.to_toml())];
    let mut writer = Writer::new(out, study, more).map_err(fault)?;
    let mut pending: Vec<Values> = study.layout().into_iter().map(|(_, values)| values).collect();
    let mut next = 0;
    for shard in shards {
        let shard = shard?;
        if shard.index != next {
            return Err(missing(next));
        }
        next += 1;
        pending.iter_mut().zip(shard.table.values).for_each(|(all, more)| all.append(more));
        if pending[0].len() >= GROUP_ROWS {
            writer.write(&pending).map_err(fault)?;
            pending = pending.iter().map(Values::like).collect();
        }
    }
    if next != study.shard_count() {
        return Err(missing(next));
    }
    if !pending[0].is_empty() {
        writer.write(&pending).map_err(fault)?;
    }
    writer.close().map_err(fault)
}

/// Runs that have not been done.
pub(crate) fn missing(shard: u64) -> Error {
    Error::unfit(RequestCode::MissingShard, format!("shard {shard} is missing"))
}
