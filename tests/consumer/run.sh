#!/bin/sh
# Installs a build into a fresh prefix, moves that prefix, and builds tests/consumer against it, once through CMake's
# package and once through pkg-config: tests/consumer/run.sh BUILD_FOLDER
set -eu
source=$(cd "$(dirname "$0")/../.." && pwd)
build=$1
work=$build/consumer
rm -rf "$work"
mkdir -p "$work"

cmake --install "$build" --prefix "$work/first" >"$work/install.log"
mv "$work/first" "$work/prefix"  # an installation must not remember where it was put
prefix=$work/prefix
library=$prefix/$(cd "$prefix" && dirname "$(find . -name libcrosslight.so)")
scene=$source/scenes/feature/phong.gltf

check() {  # NAME PROGRAM
  output=$("$2" "$scene" "$work/$1.png" 2>"$work/$1.log") || {
    echo "$1: the consumer ended with $?"
    cat "$work/$1.log"
    exit 1
  }
  [ "$output" = "16x16 phong" ] || {
    echo "$1: the consumer said '$output', expected '16x16 phong'"
    exit 1
  }
}

cmake -S "$source/tests/consumer" -B "$work/cmake" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$prefix" \
  >"$work/configure.log"
cmake --build "$work/cmake" >"$work/build.log" || {
  cat "$work/build.log"
  exit 1
}
check cmake "$work/cmake/consumer"

PKG_CONFIG_PATH=$(dirname "$(find "$prefix" -name crosslight.pc)")
export PKG_CONFIG_PATH
# shellcheck disable=SC2046
c++ -std=c++20 -Wall -Wextra -Werror "$source/tests/consumer/main.cpp" -o "$work/consumer_pc" \
  $(pkg-config --cflags --libs crosslight) -Wl,-rpath,"$library"
check pkg-config "$work/consumer_pc"
cmp "$work/cmake.png" "$work/pkg-config.png"

# The installed program finds the installed library.
"$prefix/bin/crosslight" --version >"$work/version.txt"
grep -q "^crosslight $(pkg-config --modversion crosslight) " "$work/version.txt"

# Nothing but the project's own names is exported.
foreign=$(nm -D --defined-only "$library/libcrosslight.so" | awk '$2 != "A" {print $3}' |
  grep -v '^_Z\(N\|NK\|TIN\|TSN\|TVN\)10crosslight' || true)
[ -z "$foreign" ] || {
  echo "libcrosslight.so exports foreign names:"
  echo "$foreign" | head
  exit 1
}
echo "consumer: CMake package and pkg-config both work from $prefix"
