#!/usr/bin/env bash
# Builds libstackless, and checks it in C and C++: with gcc and clang, sanitizers and valgrind, and installed.
# UPDATE=1 first writes the generated file include/stackless.h.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

target=$(realpath -m "${CARGO_TARGET_DIR:-../../target}")
made=$target/capi
mkdir -p "$made"
warnings=(-Wall -Wextra -Werror -O1)

# Reports a difference from the generated file, or replaces the file.
compare() {
    if [[ -n ${UPDATE-} ]]; then
        cp "$1" "$2"
    elif ! diff "$1" "$2"; then
        echo "$2 differs from the generated file: UPDATE=1 crates/capi/test.sh" >&2
        return 1
    fi
}

# The folder into which build.rs writes the functions in single precision. cbindgen reads files only, and expands no macros.
single=$(cargo build --release --locked --package stackless-capi --message-format json \
    | sed -n 's/.*"build-script-executed".*stackless-capi.*"out_dir":"\([^"]*\)".*/\1/p')
if command -v cbindgen > /dev/null; then
    rm -rf "$made/src"
    cp -r src "$made"
    sed -i 's/^    include!.*single\.rs.*/    pub mod functions;/' "$made/src/lib.rs"
    mkdir "$made/src/single"
    cp "$single/single.rs" "$made/src/single/functions.rs"
    cbindgen --quiet --config cbindgen.toml --output "$made/stackless.h" "$made/src/lib.rs"
    compare "$made/stackless.h" include/stackless.h
else
    echo "no cbindgen: include/stackless.h is not compared with src" >&2
fi
# README.md and the built example must be equal.
compare <(sed -n '/^```c$/,/^```$/{//!p}' README.md) examples/minimal.c

./install.sh "$made/installed"
installed=$made/installed
export PKG_CONFIG_PATH=$installed/lib/pkgconfig LD_LIBRARY_PATH=$installed/lib
read -ra shared <<< "$(pkg-config --cflags --libs stackless)"
version=$(pkg-config --modversion stackless)
grep -q "PACKAGE_VERSION $version)" cmake/stackless-config-version.cmake
grep -q "\"${version%.*}\"" cmake/stackless-config-version.cmake
static=(-I "$installed/include" "$installed/lib/libstackless.a" -lpthread -ldl -lm)
sanitize=(-g -fsanitize=address,undefined -fno-sanitize-recover=all)
# The threads of the library end with the program, so their memory is not freed.
memcheck=(valgrind --quiet --error-exitcode=1 --leak-check=full)
memcheck+=(--show-leak-kinds=definite --errors-for-leak-kinds=definite)

for c in gcc clang; do
    for precision in -DDOUBLE -DSINGLE; do
        for test in answers hostile instances hostile_instances; do
            build=("$c" "${warnings[@]}" -std=c11 "$precision" "tests/$test.c")
            "${build[@]}" -o "$made/$test" "${shared[@]}" -lpthread -lm
            "${build[@]}" -o "$made/$test-asan" "${sanitize[@]}" "${static[@]}"
        done
        "$made/answers" "$made/scene"
        "$made/answers-asan" "$made/scene"
        "$made/hostile" "$made"
        "$made/hostile-asan" "$made"
        "${memcheck[@]}" "$made/hostile" "$made" no-roundings
        for test in instances hostile_instances; do
            "$made/$test"
            "$made/$test-asan"
        done
        "${memcheck[@]}" "$made/hostile_instances"
    done
    "$c" "${warnings[@]}" -std=c11 examples/minimal.c -o "$made/minimal" "${shared[@]}"
    "${memcheck[@]}" "$made/minimal"
done
for c in g++ clang++; do
    for test in wrapper soak; do
        build=("$c" "${warnings[@]}" -std=c++17 -pthread "tests/$test.cpp")
        "${build[@]}" -o "$made/$test" "${shared[@]}"
        "${build[@]}" -o "$made/$test-asan" "${sanitize[@]}" "${static[@]}"
    done
    "$made/wrapper" "$made/scene"
    "$made/wrapper-asan" "$made/scene"
    "${memcheck[@]}" "$made/wrapper" "$made/scene"
    # The long form of it: benches/records/2026-11-30-soak.md.
    "$made/soak" "$made" 3 > /dev/null
    "$made/soak-asan" "$made" 3 > /dev/null
    # Without Embree. The comparison with it: benches/records/2026-11-30-particles.md.
    "$c" "${warnings[@]}" -std=c++17 benches/particles.cpp -o "$made/particles" "${shared[@]}" -ldl
    env -u EMBREE_LIBRARY "$made/particles" 1000
done

# Arguments drawn from bytes.
for precision in -DDOUBLE -DSINGLE; do
    build=(clang++ "${warnings[@]}" -std=c++17 "${sanitize[@]}" -fsanitize=fuzzer "$precision" tests/fuzz.cpp)
    "${build[@]}" -o "$made/fuzz" "${static[@]}"
    (cd "$made" && ./fuzz -runs=2000 -max_len=512 -seed=1 2> fuzz.log) || { cat "$made/fuzz.log"; exit 1; }
done

# The conformance suite. In single precision all cases of the level `ray` must be sent.
conform() {
    python3 ../../spec/suite/conform.py --level ray --timeout 60 -- "$@" | tee "$made/conform.txt"
    if (($# == 1)) && ! grep -q ' 0 failed, 0 not asked' "$made/conform.txt"; then
        echo "$1: some cases of the level ray were not asked" >&2
        return 1
    fi
}
g++ "${warnings[@]}" -std=c++17 tests/conform.cpp -o "$made/conform" "${shared[@]}"
conform "$made/conform"
conform "$made/conform" double
clang++ "${warnings[@]}" -std=c++17 tests/conform.cpp -o "$made/conform-asan" "${sanitize[@]}" "${static[@]}"
conform "$made/conform-asan"

# Build as users do.
rm -rf "$made/examples"
cmake -S examples -B "$made/examples" -DCMAKE_PREFIX_PATH="$installed" > "$made/cmake.log"
cmake --build "$made/examples" >> "$made/cmake.log"
"$made/examples/minimal"
"$made/examples/minimal_cpp"
"$made/examples/tracker"
"$made/examples/paths"
