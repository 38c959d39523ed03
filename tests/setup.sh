#!/usr/bin/env bash
# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# What apps/demo.sh and tests/run.sh have in common: installs the Debian packages that are missing,
# configures and builds (Release, Ninja) in build/. Sourced, from the top of the tree.
set -euo pipefail

packages=(
  g++ cmake ninja-build pkg-config
  libvtk9-dev vtk9 python3-vtk9 python3-numpy python3-html5lib python3-meshio python3-scipy
  libcgal-dev libopenmesh-dev libopenblas-dev libeigen3-dev libxsimd-dev libcli11-dev
  libmumps-seq-dev libceres-dev libhidapi-dev nlohmann-json3-dev libudev-dev umockdev libumockdev-dev
  libgtest-dev libbenchmark-dev libx11-dev xvfb libgl1-mesa-dri
)

missing=()
for package in "${packages[@]}"; do
  dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing+=("$package")
done
if [ ${#missing[@]} -gt 0 ]; then
  echo "Installing ${missing[*]}"
  as_root=()
  [ "$(id -u)" -eq 0 ] || as_root=(sudo)
  "${as_root[@]}" apt-get update -qq
  DEBIAN_FRONTEND=noninteractive "${as_root[@]}" apt-get install -y -qq --no-install-recommends "${missing[@]}"
fi

[ -f build/build.ninja ] || cmake -S . -B build -G Ninja -DCMAKE_BUILD_TYPE=Release
cmake --build build
