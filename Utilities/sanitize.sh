#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# sanitize.sh [PRESET...]: all C++ tests under the address and undefined-behaviour sanitizers (preset
# address) and the thread sanitizer (thread), and a minute of fuzzing each of the core and the filter
# (fuzz). Without arguments all three: half an hour on two cores.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

(($# > 0)) || set -- address thread fuzz
for preset; do
  Utilities/prepare.sh "$preset"
  tests=()
  if [[ $preset == fuzz ]]; then
    tests=(--tests-regex '^Fuzz\.')
  fi
  ctest --preset "$preset" --parallel "$(nproc)" "${tests[@]}"
done
