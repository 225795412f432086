#!/usr/bin/env bash
# Proves the SMT lemmas and refutes their controls. Installs Z3's library where it is missing (Debian: libz3-dev).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

if [[ ! -e /usr/include/z3.h ]]; then
    ../../.ci/apt libz3-dev
fi
# Without optimisation: the time is Z3's, and the compiler would take more than it saves.
cargo test --quiet --locked
cargo run --quiet --locked -- "$@"
