#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs what is missing, builds Elbowroom and opens the editor on the demo scene. With no display
# it corrects the demo clip into a file, a report and a filmstrip under out/ instead. With arguments:
# runs the program with them.
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
  -DELBOWROOM_BENCH=OFF -DELBOWROOM_TOGETHER=ON >"$build.configure.log" 2>&1 || {
  cat "$build.configure.log"
  exit 1
}
cmake --build "$build"

program="$build/app/elbowroom"
if [ $# -gt 0 ]; then
  exec "$program" "$@"
fi
if [ -n "${DISPLAY:-}${WAYLAND_DISPLAY:-}" ]; then
  say "3/3 Opening the editor on the demo scene"
  exec "$program"
fi
say "3/3 There is no display for the editor's window: correcting the demo clip into files instead"
assets="$build/assets"
out="$root/out"
mkdir -p "$out"
clip="Walk between posts"
scene=(--obstacles "$assets/posts.glb" --attach "$assets/$(sed -n 's/.*kAttachArgument = "\(.*\)".*/\1/p' "$root/assets/demo.h")")

# Says a command and runs it.
run() {
  say "elbowroom $*"
  "$program" "$@"
}
run check --character "$assets/mannequin.glb" --clip "$clip" "${scene[@]}" || [ $? -eq 4 ]
run correct --character "$assets/mannequin.glb" --clip "$clip" "${scene[@]}" \
  -o "$out/demo.glb" --report "$out/demo.json"
run render --character "$out/demo.glb" --clip "$clip" --compare "$clip (corrected)" "${scene[@]}" \
  --times 1.45,1.65,1.8,1.95,2.1,2.3 -o "$out/demo.png"
say "Done: $out/demo.glb (the corrected clip), demo.json (the report), demo.png (before and after)"
