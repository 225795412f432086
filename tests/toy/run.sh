#!/usr/bin/env bash
# Shows that a new traversal is one file and one row: adds a toy to a copy of the work tree, and runs the commands with it.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
toy=$PWD/tests/toy
# A separate folder, because other jobs build the command without the toy in the default folder at the same time.
export CARGO_TARGET_DIR=${CARGO_TARGET_DIR:-$PWD/target}/toy
# Most of the time is compile time.
export CARGO_PROFILE_DEV_OPT_LEVEL=0 CARGO_PROFILE_DEV_DEBUG=none

copy=$(mktemp -d)
trap 'rm -rf "$copy"' EXIT
git ls-files -z --cached --others --exclude-standard | while IFS= read -r -d '' file; do
    [[ -e $file ]] && printf '%s\0' "$file"
done | tar --create --null --files-from=- | tar --extract --directory="$copy"

cd "$copy"
cp "$toy/toy.rs" src/traverse/toy.rs
sed --in-place 's/^mod unsupported;$/mod toy;\n&/' src/traverse/mod.rs
# The row goes before the brace that ends the table, the last line of its file.
sed --in-place '$d' src/traverse/table.rs
{ cat "$toy/row.txt"; echo '}'; } >> src/traverse/table.rs

cargo build --package stackless-cli --features lab

# The expected text of the output, and the command.
sees() {
    local wanted=$1
    shift
    if ! "$CARGO_TARGET_DIR/debug/$1" "${@:2}" > "$copy/answer" 2>&1 || ! grep --quiet --extended-regexp "$wanted" "$copy/answer"; then
        echo "no \"$wanted\" in: $*" >&2
        cat "$copy/answer" >&2
        exit 1
    fi
}

sees 'toy +binary +Key and trail; every node is found' stackless methods
for word in u32 u64 u128 grow; do
    sees '^pass: .* 1 method, 0 disagreements' lab check --method toy --word "$word" --trees 300 --count 20
    sees "^ *toy .*$word" lab check -v --method toy --word "$word" --trees 300 --count 20
done
sees 'every node is found by walking down' stackless explain --method toy --output -
sees '^ *toy ' stackless bench strands --method toy --count 64 --rounds 1 --kinds any
echo "the toy is checked in all words, explained, measured and listed"
