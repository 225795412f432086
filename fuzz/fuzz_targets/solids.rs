#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| stackless_fuzz::run("solids", bytes));
