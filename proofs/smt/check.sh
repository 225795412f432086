#!/usr/bin/env bash
# Proves the SMT lemmas and refutes their controls. Installs Z3's library where it is missing (Debian: libz3-dev).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

if [[ ! -e /usr/include/z3.h ]]; then
    ../../.ci/apt libz3-dev
fi
cargo test --quiet --release --locked
cargo run --quiet --release --locked -- "$@"
