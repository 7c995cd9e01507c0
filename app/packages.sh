#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs the Debian packages that the project needs and that are not there yet. Sourced by
# app/run.sh and tests/run.sh; runs as root, or as a user with sudo.

packages_build=(
  g++ cmake ninja-build pkg-config
  libglm-dev nlohmann-json3-dev libcli11-dev libfmt-dev libstb-dev
  libtinygltf-dev libembree-dev libopenmesh-dev libhwy-dev
  libepoxy-dev libegl-dev libgl-dev libgl1-mesa-dri libegl1 libegl-mesa0
  libglfw3-dev libimgui-dev fonts-inter
)
packages_test=(
  libgtest-dev libbenchmark-dev
  libfcl-dev libccd-dev libeigen3-dev libompl-dev libcgal-dev
  nodejs npm xvfb xdotool imagemagick
)

say() { printf '\033[1m[elbowroom]\033[0m %s\n' "$*"; }

# install_packages NAME... : those of the list that are missing.
install_packages() {
  if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    say "This script installs Debian packages, and this system has no apt-get."
    say "Install what these Debian 12 packages hold by hand, then run it again: $*"
    return 1
  fi
  local missing=() name
  for name in "$@"; do
    # A node or npm that is there already, from wherever, will do.
    case $name in nodejs) command -v node >/dev/null && continue ;; npm) command -v npm >/dev/null && continue ;; esac
    [ "$(dpkg-query -W -f='${db:Status-Status}' "$name" 2>/dev/null)" = installed ] || missing+=("$name")
  done
  if [ ${#missing[@]} -eq 0 ]; then
    say "All packages are there."
    return 0
  fi
  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo >/dev/null; then
      say "These packages are missing, and installing them needs root: ${missing[*]}"
      say "Run this as root, or install sudo, or ask an administrator for:"
      say "    apt-get install ${missing[*]}"
      return 1
    fi
    as_root=(sudo)
  fi
  say "Installing ${#missing[@]} packages: ${missing[*]}"
  "${as_root[@]}" apt-get update -q || return 1
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -q --no-install-recommends "${missing[@]}" || {
    say "apt-get could not install them; its own message is above."
    return 1
  }
}
