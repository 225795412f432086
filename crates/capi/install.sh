#!/usr/bin/env bash
# Builds libstackless and installs it on Linux, with its headers and files for pkg-config and CMake: install.sh PREFIX
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

mkdir -p "$prefix"/{include,lib/pkgconfig,lib/cmake/stackless}
install -m 644 include/stackless.h include/stackless.hpp "$prefix/include"
install -m 644 "$built/libstackless.a" "$prefix/lib"
install -m 755 "$built/libstackless.so" "$prefix/lib/$shared"
ln -sf "$shared" "$prefix/lib/libstackless.so"

cat > "$prefix/lib/pkgconfig/stackless.pc" << END
prefix=\${pcfiledir}/../..

Name: stackless
Description: Exact ray tracing on triangle meshes
Version: $version
Cflags: -I\${prefix}/include
Libs: -L\${prefix}/lib -lstackless
Libs.private: -lpthread -ldl -lm
END

cat > "$prefix/lib/cmake/stackless/stackless-config.cmake" << END
# Targets: stackless::stackless, the shared library, and stackless::static.
get_filename_component(_stackless "\${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)
if(NOT TARGET stackless::stackless)
  add_library(stackless::stackless SHARED IMPORTED)
  set_target_properties(stackless::stackless PROPERTIES
    IMPORTED_LOCATION "\${_stackless}/lib/$shared"
    IMPORTED_SONAME $shared
    INTERFACE_INCLUDE_DIRECTORIES "\${_stackless}/include")
  add_library(stackless::static STATIC IMPORTED)
  set_target_properties(stackless::static PROPERTIES
    IMPORTED_LOCATION "\${_stackless}/lib/libstackless.a"
    INTERFACE_LINK_LIBRARIES "pthread;dl;m"
    INTERFACE_INCLUDE_DIRECTORIES "\${_stackless}/include")
endif()
END

cat > "$prefix/lib/cmake/stackless/stackless-config-version.cmake" << END
set(PACKAGE_VERSION $version)
if("\${PACKAGE_FIND_VERSION_MAJOR}.\${PACKAGE_FIND_VERSION_MINOR}" STREQUAL "${version%.*}")
  set(PACKAGE_VERSION_COMPATIBLE TRUE)
  if(PACKAGE_FIND_VERSION STREQUAL PACKAGE_VERSION)
    set(PACKAGE_VERSION_EXACT TRUE)
  endif()
endif()
END
