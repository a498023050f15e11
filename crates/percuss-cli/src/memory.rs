//! Whether a model fits into the memory that is there.

use percuss::ModelExtent;
use percuss_codes::FileCode;

use crate::number::number;
use crate::outcome::Failure;

const GIGABYTE: f64 = 1e9;

/// Refuses a model that needs more memory than there is, before anything is allocated for it.
///
/// # Errors
/// If it does not fit, with what it needs and what there is.
pub fn refuse(name: &str, extent: &ModelExtent) -> Result<(), Failure> {
    let Some(there) = available().filter(|there| extent.memory > *there) else { return Ok(()) };
    let (mut what, mut cure) = (format!("{} elements", number(extent.elements.round())), "");
    if extent.pairs > 0.0 {
        what += &format!(" and {} contact pairs", number(extent.pairs.round()));
        cure = ", or fewer points_per_element of contacts";
    }
    let text = format!(
        "{name}: {what} need about {} of memory ({} available); use fewer elements{cure}",
        size(extent.memory),
        size(there)
    );
    Err(Failure::System(FileCode::System.into(), text))
}

fn size(bytes: f64) -> String {
    match bytes >= GIGABYTE {
        true => format!("{:.1} GB", bytes / GIGABYTE),
        false => format!("{:.0} MB", bytes / 1e6),
    }
}

/// Memory that may be allocated, where the system says: what is free, and what limits of the process and of its group leave \[bytes\].
#[cfg(target_os = "linux")]
fn available() -> Option<f64> {
    let all = [free(), address_space(), group()];
    all.into_iter().flatten().reduce(f64::min)
}

#[cfg(not(target_os = "linux"))]
fn available() -> Option<f64> {
    None
}

#[cfg(target_os = "linux")]
fn free() -> Option<f64> {
    in_kilobytes("/proc/meminfo", "MemAvailable:")
}

/// What `ulimit -v` leaves.
#[cfg(target_os = "linux")]
fn address_space() -> Option<f64> {
    let limit = rustix::process::getrlimit(rustix::process::Resource::As).current?;
    let used = in_kilobytes("/proc/self/status", "VmSize:").unwrap_or(0.0);
    Some((limit as f64 - used).max(0.0))
}

/// What the control group leaves, as of a container or a batch job.
#[cfg(target_os = "linux")]
fn group() -> Option<f64> {
    let group = std::fs::read_to_string("/proc/self/cgroup").ok()?;
    let path = group.lines().find_map(|line| line.strip_prefix("0::"))?;
    let value = |file: &str| -> Option<f64> {
        let file = format!("/sys/fs/cgroup{path}/{file}");
        std::fs::read_to_string(file).ok()?.trim().parse().ok()
    };
    Some((value("memory.max")? - value("memory.current").unwrap_or(0.0)).max(0.0))
}

/// A value of a table such as `MemAvailable:  8123456 kB` \[bytes\].
#[cfg(target_os = "linux")]
fn in_kilobytes(file: &str, key: &str) -> Option<f64> {
    let text = std::fs::read_to_string(file).ok()?;
    let value = text.lines().find_map(|line| line.strip_prefix(key))?;
    let kilobytes: f64 = value.trim().trim_end_matches(" kB").trim().parse().ok()?;
    Some(1024.0 * kilobytes)
}
