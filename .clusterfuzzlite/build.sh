#!/bin/bash -eu
# Builds all targets with the sanitizer of the environment, and lays seeds and dictionaries beside them. For ClusterFuzzLite and
# OSS-Fuzz. Not run yet.
cd "$SRC/stackless-bvh"
cargo fuzz build -O --debug-assertions
for target in $(ls fuzz/seeds); do
    cp "fuzz/target/x86_64-unknown-linux-gnu/release/$target" "$OUT/"
    # Inputs that were found count as seeds.
    folders=()
    for folder in fuzz/seeds fuzz/regressions; do
        [[ ! -d $folder/$target ]] || folders+=("$folder/$target")
    done
    zip -q -r "$OUT/${target}_seed_corpus.zip" "${folders[@]}"
    [[ ! -e fuzz/dictionaries/$target ]] || cp "fuzz/dictionaries/$target" "$OUT/$target.dict"
    printf '[libfuzzer]\nmax_len = 4096\n' > "$OUT/$target.options"
done
