#!/usr/bin/env bash
# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Installs what is missing, builds, and does Palpate's main job on the kidney of data/: precomputes it,
# presses it at a point, looks at its stiffness without and with pressure masks, and at what accuracy
# costs. Leaves models, fields, pages and pictures in demo/, and prints a table.
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source tests/setup.sh
mkdir -p demo

# step NAME ARGUMENTS...: runs a command of the program, keeps what it prints and how long it took.
declare -A output seconds
step() {
  local name=$1 start end
  shift
  start=$(date +%s.%N)
  output[$name]=$(build/bin/palpate "$@")
  end=$(date +%s.%N)
  seconds[$name]=$(awk "BEGIN { printf \"%.2f\", $end - $start }")
}
# value NAME LABEL: what a command printed beside a label.
value() { sed -n "s/^$2  *//p" <<< "${output[$1]}" | head -n 1; }
row() { printf '%-44s %s\n' "$1" "$2"; }

step refine refine data/kidney.vtp demo/surface.vtp --levels 2
step precompute precompute demo/surface.vtp demo/model.vtp
step press press demo/model.vtp demo/pressed.vtp --at 0 0 0.03 --displacement 0 0 -0.008 \
  --radius 0.015 --image demo/pressed.png --view 0.4 -0.9 0.5
step single stiffness demo/model.vtp demo/stiffness_single.vtp --image demo/stiffness_single.png
step masked stiffness demo/model.vtp demo/stiffness_masked.vtp --radius-edges 2 \
  --image demo/stiffness_masked.png
step report artifacts data/kidney.vtp --levels 2 3 --radius 0.016 --report demo/stiffness.html
step accuracy accuracy data/kidney.vtp --levels 1 2 3 --radius 0.016 --repeats 3 \
  --report demo/accuracy.html --image demo/accuracy.png

echo
row "vertices (free)" "$(value precompute vertices) ($(value precompute "Green's functions"))"
row "seconds: refine, with files" "${seconds[refine]}"
row "seconds: precompute, with files" "${seconds[precompute]}"
row "  of these: assemble, solve, check" "$(value precompute 'seconds to assemble'), $(value precompute 'seconds to solve'), $(value precompute 'seconds to check')"
row "seconds: press, with files and picture" "${seconds[press]}"
row "seconds: stiffness single, masked, likewise" "${seconds[single]}, ${seconds[masked]}"
row "reciprocity defect (discretisation)" "$(value precompute 'reciprocity defect')"
row "integration defect, solver residual" "$(value precompute 'integration defect'), $(value precompute 'solver residual')"
row "contact force under 8 mm, N" "$(value press 'contact force, N')"
row "seconds: stiffness of two meshes, with report" "${seconds[report]}"
row "seconds: accuracy of three levels, with report" "${seconds[accuracy]}"
row "variation of |K|, single vertices" "$(value single 'coefficient of variation')"
row "variation of |K|, masks of 2 edge lengths" "$(value masked 'coefficient of variation')"
echo
echo "In demo/: model.vtp, pressed.vtp, stiffness_single.vtp, stiffness_masked.vtp, stiffness.html,"
echo "accuracy.html, with their tables, and pictures:"
ls demo/*.png
