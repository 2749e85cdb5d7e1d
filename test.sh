#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Builds the project and runs its tests; see the usage below.
set -euo pipefail

usage()
{
  cat << END
usage: $0 [--quick] [OPTION...]
Builds the project in build/release, where demo.sh builds it too, and runs all its tests. With CI=true in
the environment a build folder that is made anew stops at warnings of the compiler.
  --quick   builds and runs only the quick tests, without a display, that end within seconds
Other options are those of ctest, for example --tests-regex '^TestSplats' or --label-regex rendering;
ctest --help lists them.
END
}

cd "$(dirname "${BASH_SOURCE[0]}")"
source Utilities/steps.sh
handle_help "$@"
targets=(all tests)
options=()
if [[ ${1-} == --quick ]]; then
  shift
  targets=(quick_tests)
  options=(--label-regex '^quick$')
fi
Utilities/prepare.sh release "${targets[@]}"
exec ctest --preset release --parallel "$(nproc)" "${options[@]}" "$@"
