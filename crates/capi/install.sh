#!/usr/bin/env bash
# Builds libstackless and installs it on Linux, with its headers and files for pkg-config and CMake: install.sh PREFIX
# For those who have cargo-c: cargo cinstall --release -p stackless-capi --prefix PREFIX
set -euo pipefail
if (($# != 1)); then
    echo "usage: $0 PREFIX" >&2
    exit 2
fi
mkdir -p "$1"
prefix=$(realpath "$1")
cd "$(dirname "${BASH_SOURCE[0]}")"

cargo build --release --locked --package stackless-capi
built=$(realpath "${CARGO_TARGET_DIR:-../../target}")/release
version=$(sed -n 's/^version = "\(.*\)"$/\1/p' ../../Cargo.toml | head -1)
# Versions before 1.0 may differ in every minor one.
shared=libstackless.so.${version%.*}

mkdir -p "$prefix"/{include,lib/pkgconfig,share/cmake/stackless}
install -m 644 include/stackless.h include/stackless.hpp "$prefix/include"
install -m 644 "$built/libstackless.a" "$prefix/lib"
install -m 755 "$built/libstackless.so" "$prefix/lib/$shared"
ln -sf "$shared" "$prefix/lib/libstackless.so"
install -m 644 cmake/* "$prefix/share/cmake/stackless"

cat > "$prefix/lib/pkgconfig/stackless.pc" << END
prefix=\${pcfiledir}/../..

Name: stackless
Description: Exact ray tracing on triangle meshes
Version: $version
Cflags: -I\${prefix}/include
Libs: -L\${prefix}/lib -lstackless
Libs.private: -lpthread -ldl -lm
END
