#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs all C++ tests under the sanitizers, and the fuzz targets; see the usage below.
set -euo pipefail

usage()
{
  cat << END
usage: $0 [PRESET...]
Builds presets and runs their tests:
  address  all C++ tests with the address and undefined-behavior sanitizers
  thread   all C++ tests with the thread sanitizer
  fuzz     the fuzz targets of the core and of the filter, one minute each
Without arguments all three, which takes over an hour on two cores.
END
}

cd "$(dirname "${BASH_SOURCE[0]}")/.."
source Utilities/steps.sh
handle_help "$@"

(($# > 0)) || set -- address thread fuzz
for preset; do
  targets=(tests)
  tests=()
  if [[ $preset == fuzz ]]; then
    targets=(FuzzCore FuzzFilter)
    tests=(--tests-regex '^Fuzz\.')
  fi
  Utilities/prepare.sh "$preset" "${targets[@]}"
  ctest --preset "$preset" --parallel "$(nproc)" "${tests[@]}"
done
