/work/main/proofs/operations/target/debug/deps/operations-41f43dc56ca993ef.d: src/main.rs src/calls.rs src/operators.rs src/print.rs src/reader.rs src/run.rs src/shapes.rs src/source.rs src/targets.rs src/value.rs src/glam.rs

/work/main/proofs/operations/target/debug/deps/operations-41f43dc56ca993ef: src/main.rs src/calls.rs src/operators.rs src/print.rs src/reader.rs src/run.rs src/shapes.rs src/source.rs src/targets.rs src/value.rs src/glam.rs

src/main.rs:
src/calls.rs:
src/operators.rs:
src/print.rs:
src/reader.rs:
src/run.rs:
src/shapes.rs:
src/source.rs:
src/targets.rs:
src/value.rs:
src/glam.rs:
