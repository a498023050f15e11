#![no_main]
libfuzzer_sys::fuzz_target!(|data: &[u8]| percuss_fuzz::fit(data));
