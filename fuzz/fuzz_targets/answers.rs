#![no_main]

libfuzzer_sys::fuzz_target!(init: stackless_fuzz::prepare(), |bytes: &[u8]| stackless_fuzz::run("answers", bytes));
