#!/usr/bin/env bash
# Runs the harnesses by Kani: each claim must be proved, each cover reached, and each twin refuted at the claim that it
# breaks. Kani brings a compiler of its own, which must be as new as the one that Cargo.toml promises. `kani.sh
# --compiler` compares these and runs nothing.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

promised=$(sed -n 's/^rust-version = "\(.*\)"$/\1/p' Cargo.toml)
version=$(cargo kani --version | sed -n 's/.* \([0-9][0-9.]*\).*/\1/p')
compiler=${KANI_COMPILER:-${KANI_HOME:-$HOME/.kani}/kani-$version/toolchain/bin/rustc}
found=$("$compiler" --version | cut -d' ' -f2)
echo "Kani $version compiles with $found; Cargo.toml promises $promised"
if [[ $(printf '%s\n' "$promised" "${found%%-*}" | sort -V | head -1) != "$promised" ]]; then
    echo "the compiler of this Kani is older than what Cargo.toml promises" >&2
    exit 1
fi
[[ ${1:-} != --compiler ]] || exit 0

log=$(mktemp)
trap 'rm -f "$log"' EXIT
cargo kani -p proofs | tee "$log"
# A cover that is not satisfied does not make Kani fail; here it does. (Twins are refuted before some of theirs.) Nor
# does a twin that dies of another panic than its claim.
awk 'function judge() { if (harness ~ /_twin/ && !claimed) { print harness, "did not die of its claim"; missed = 1 } }
     /^Checking harness /  { judge(); harness = $3; claimed = 0 }
     /the claim of the harness/ { claimed = 1 }
     /cover properties satisfied/ && harness !~ /_twin/ && $2 != $4 { print harness, $0; missed = 1 }
     END { judge(); exit missed }' "$log"
