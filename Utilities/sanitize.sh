#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# All C++ tests under the address, undefined-behaviour and thread sanitizers, and a minute of fuzzing
# each of the core and the filter where clang is installed. Half an hour on two cores.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

for preset in address thread; do
  Utilities/prepare.sh "$preset"
  ctest --preset "$preset" "$@"
done
if command -v clang++ > /dev/null; then
  Utilities/prepare.sh fuzz
  ctest --preset fuzz --tests-regex '^Fuzz\.' "$@"
else
  echo "clang++ is not installed: no fuzzing" >&2
fi
