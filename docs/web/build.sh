#!/usr/bin/env bash
# Builds the page that traces in the browser: one file, which needs nothing else and no network. usage: build.sh [quick]
#
# `quick` is for tests: the page is the same, but larger and slower.
# The compiler is rustup's, if it has the target (`rustup target add wasm32-unknown-unknown`); else Debian's rustc-web, with
# which the standard library is built from Debian's sources (rust-web-src). 77 where there is neither.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
out=$(realpath -m "${CARGO_TARGET_DIR:-target}")/web
target=wasm32-unknown-unknown
arguments=(--locked --package stackless-web --example page --target "$target" --target-dir "$out/build" --profile web)

if [[ ${1-} == quick ]]; then
    export CARGO_PROFILE_WEB_OPT_LEVEL=1 CARGO_PROFILE_WEB_LTO=fat CARGO_PROFILE_WEB_CODEGEN_UNITS=1
fi

sysroot=$(rustc --print sysroot)
if [[ ! -d $sysroot/lib/rustlib/$target/lib ]]; then
    debian=/usr/bin/rustc
    if [[ ! -d /usr/lib/rustlib/src/rust/library ]] || ! dpkg -s rustc-web > /dev/null 2>&1; then
        .ci/apt rustc-web rust-web-src || { echo "no compiler for $target, and apt-get cannot install it" >&2; exit 77; }
    fi
    # Debian's has no linker for this target; rustup's compiler brings one along.
    linker=$(find "$sysroot/lib/rustlib" -name rust-lld -print -quit)
    # Its standard library comes as source, which only this variable allows to build. What is left out would show where a
    # panic came from.
    export RUSTC=$debian RUSTC_BOOTSTRAP=1 CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER=${linker:-wasm-ld}
    arguments+=(-Z build-std=std,panic_abort -Z build-std-features=)
    # Of the checks the page needs little; so they are compiled only as far as they are called.
    arguments+=(-Z profile-hint-mostly-unused --config profile.web.package.stackless-check.hint-mostly-unused=true)
fi
cargo build "${arguments[@]}"

# The line of the template that stands for the library.
base64 -w 0 "$out/build/$target/web/examples/page.wasm" > "$out/page.base64"
sed -e '/^{{wasm}}$/{r '"$out/page.base64"'
d}' docs/web/page.html > "$out/stackless.html"
rm "$out/page.base64"
ls -l "$out/stackless.html"
