#![no_main]
// The reader catches panics of the decoder it calls and tells of damage: libFuzzer's hook, which ends the process with any panic,
// would not let it. Panics that nobody catches are faults as before.
libfuzzer_sys::fuzz_target!(
    init: {
        let _ = std::panic::take_hook();
    },
    |data: &[u8]| {
        percuss_fuzz::fields(data);
    }
);
