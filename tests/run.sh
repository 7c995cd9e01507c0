#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs what is missing, builds Elbowroom with its tests, and runs the `fast` tier.
# tests/run.sh long runs the long tier instead, tests/run.sh bench the benchmark of the planner.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
# shellcheck source=app/packages.sh
. "$root/app/packages.sh"
tier=${1:-fast}
case $tier in
  fast) target=all ;;
  long) target=elbowroom_long_tests ;;
  bench) target=elbowroom_benchmarks ;;
  *)
    echo "usage: tests/run.sh [fast|long|bench]" >&2
    exit 1
    ;;
esac

say "1/4 Packages"
install_packages "${packages_build[@]}" "${packages_test[@]}"

build="$root/build/tests"
mkdir -p "$build"

say "2/4 Khronos glTF validator (npm)"
validator="$build/validator"
if [ ! -d "$validator/node_modules/gltf-validator" ]; then
  mkdir -p "$validator"
  if ! npm install --prefix "$validator" --no-audit --no-fund --silent gltf-validator@2.0.0-dev.3.10; then
    say "npm could not install gltf-validator: the tests that need it will say that they skip."
  fi
fi
if [ -d "$validator/node_modules/gltf-validator" ]; then
  export ELBOWROOM_GLTF_VALIDATOR="$validator/node_modules"
fi

say "3/4 Building in $build (the first time takes some ten minutes)"
cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DELBOWROOM_TESTS=ON \
  -DELBOWROOM_TOGETHER=ON
cmake --build "$build" --target "$target"

if [ "$tier" = bench ]; then
  say "4/4 The planner beside OMPL and FCL"
  exec "$build/tests/elbowroom_bench"
fi
say "4/4 Tests, tier '$tier'"
exec ctest --test-dir "$build" -L "$tier" --output-on-failure --no-tests=error -j 2
