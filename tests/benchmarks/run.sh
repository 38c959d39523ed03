#!/usr/bin/env bash
# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Runs the benchmarks of a finished build (default: build/) and prints the tables of README. Takes a
# quarter of an hour; ratios are of medians within one run, of one thread's CPU time.
#   tests/benchmarks/run.sh [build directory]
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
build="${1:-$here/../../build}/benchmarks"
results="$build/results"
mkdir -p "$results"

# measure NAME PROGRAM REPETITIONS FILTER: repetitions of all cases in random order.
measure() {
  echo "  $1" >&2
  "$build/$2" --benchmark_filter="$4" --benchmark_repetitions="$3" --benchmark_min_time=0.05 \
    --benchmark_enable_random_interleaving=true --benchmark_format=json >"$results/$1.json" 2>/dev/null
}

measure assembly assembly_benchmark 5 '(assemble|assemblePlainly|integrate)/n:642'
measure assembly_large assembly_benchmark 3 'n:2562'
for set in baseline avx2 avx512; do
  PALPATE_SIMD=$set measure "assembly_$set" assembly_benchmark 5 'assemble/n:642'
done
measure solve solve_benchmark 3 'n:(642|1280)'
measure precompute precompute_benchmark 3 'n:642'
measure precompute_large precompute_benchmark 1 'precompute<double>/n:2562'
measure deformation deformation_benchmark 15 'n:(642|2562)'
measure contact contact_benchmark 15 'n:642'
measure haptics haptics_benchmark 5 '(tickOf.*/n:642|emptyTick)'
measure haptics_large haptics_benchmark 3 'tickOf.*/n:2562'
measure servo servo_benchmark 1 'devicesBesideFrames/tools:2'
measure james_pai james_pai_benchmark 5 '.*'
python3 "$here/report.py" "$results"
