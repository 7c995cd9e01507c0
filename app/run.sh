#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs what is missing, builds Elbowroom, and opens it on the demo scene. Without a display it
# corrects the demo clip into a file and a filmstrip instead. Arguments go to the program.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
# shellcheck source=app/packages.sh
. "$root/app/packages.sh"

say "1/3 Packages"
install_packages "${packages_build[@]}"

build="$root/build/app"
say "2/3 Building in $build (the first time takes a few minutes)"
mkdir -p "$build"
cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DELBOWROOM_TESTS=OFF \
  -DELBOWROOM_BENCH=OFF >"$build.configure.log" 2>&1 || {
  cat "$build.configure.log"
  exit 1
}
cmake --build "$build"

program="$build/app/elbowroom"
if [ $# -gt 0 ]; then
  exec "$program" "$@"
fi
if [ -n "${DISPLAY:-}" ] || [ -n "${WAYLAND_DISPLAY:-}" ]; then
  say "3/3 Opening the demo scene"
  exec "$program"
fi
say "3/3 There is no display, so no window: correcting the demo clip into files instead"
out="$root/out"
mkdir -p "$out"
exec "$program" demo --out-dir "$out"
