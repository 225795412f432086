#!/usr/bin/env bash
# Runs the harnesses by `cargo kani` and judges its output: each claim must be proved, each cover reached, and each twin
# refuted at the claim that it breaks. Kani brings its own compiler, which must be as new as Cargo.toml promises.
#
#   kani.sh                    runs Kani
#   kani.sh --compiler         compares the compilers only
#   kani.sh --compile          compiles what Kani would compile, with the stand-in of cbmc/ in place of Kani's crate
#   kani.sh --judge LIST LOG   judges Kani's output; LIST is what the binary `list` prints
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

compare_compilers() {
    local promised version compiler found
    promised=$(sed -n 's/^rust-version = "\(.*\)"$/\1/p' Cargo.toml)
    version=$(cargo kani --version | sed -n 's/.* \([0-9][0-9.]*\).*/\1/p')
    compiler=${KANI_COMPILER:-${KANI_HOME:-$HOME/.kani}/kani-$version/toolchain/bin/rustc}
    found=$("$compiler" --version | cut -d' ' -f2)
    echo "Kani $version compiles with $found; Cargo.toml promises $promised"
    if [[ $(printf '%s\n' "$promised" "${found%%-*}" | sort -V | head -1) != "$promised" ]]; then
        echo "the compiler of this Kani is older than what Cargo.toml promises" >&2
        return 1
    fi
}

# The package is the one that Kani's flags in Cargo.toml choose, with its library and its binaries, as Kani takes both.
compile() {
    local target=${CARGO_TARGET_DIR:-$PWD/target}/kani manifest host
    manifest=$(sed -n '/^\[workspace.metadata.kani.flags\]$/,/^$/s/^manifest-path = "\(.*\)"$/\1/p' Cargo.toml)
    host=$(rustc -vV | sed -n 's/^host: //p')
    cargo build --quiet --locked --manifest-path proofs/cbmc/Cargo.toml --package kani --target-dir "$target"
    # With a target, flags do not reach build scripts, as under Kani.
    RUSTFLAGS="-D warnings -A missing_docs --cfg kani --extern kani=$target/debug/libkani.rlib -L dependency=$target/debug/deps" \
        cargo check --locked --manifest-path "$manifest" --lib --bins --target "$host" --target-dir "$target"
}

# An unsatisfied cover is no failure for Kani, nor is a twin that panics before its claim, nor a harness that is absent.
judge() {
    awk -F'\t' '
        FILENAME == ARGV[1] { wanted[++count] = $1; twin[count] = $2; next }
        /^Checking harness / { name = $0; gsub(/^Checking harness |\.\.\.$/, "", name); sub(/.*::/, "", name) }
        /^VERIFICATION:- SUCCESSFUL/ { is_verified[name] }
        /^Failed Checks: the claim of the harness$/ { is_refuted[name] }
        / cover properties satisfied/ { split($0, words, " "); if (words[2] == words[4]) is_covered[name] }
        function check(holds, name, fault) { if (!holds) { print name ": " fault; faults++ } }
        END {
            for (i = 1; i <= count; i++) {
                check(wanted[i] in is_verified, wanted[i], "not verified")
                check(wanted[i] in is_covered, wanted[i], "not all covers are satisfied")
                check(twin[i] in is_verified, twin[i], "not verified")
                check(twin[i] in is_refuted, twin[i], "its claim did not fail")
            }
            print count + 0 " harnesses and their twins, " faults + 0 " faults"
            exit faults > 0 || count == 0
        }' "$1" "$2"
}

run() {
    local work status=0
    compare_compilers
    work=$(mktemp -d)
    trap 'rm -rf "$work"' EXIT
    cargo run --quiet --package proofs --bin list > "$work/list.tsv"
    cargo kani | tee "$work/log" || status=$?
    judge "$work/list.tsv" "$work/log"
    return $status
}

case ${1:-} in
    '') cd "$root" && run ;;
    --compiler) cd "$root" && compare_compilers ;;
    --compile) cd "$root" && compile ;;
    --judge) judge "$2" "$3" ;;
    *) sed -n '2,/^set/s/^# \{0,1\}//p' "$0" >&2 && exit 2 ;;
esac
