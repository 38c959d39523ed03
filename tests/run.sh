#!/usr/bin/env bash
# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Installs what is missing, builds, and runs all tests. Arguments go to ctest, e.g. -LE slow.
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source tests/setup.sh
ctest --test-dir build --output-on-failure --parallel 2 "$@"
