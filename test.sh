#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Builds the project, warnings being errors, and runs its tests.
set -euo pipefail

if [[ ${1-} == --help ]]; then
  cat << END
usage: $0 [OPTION...]
Builds the project, warnings being errors, and runs all its tests. Options are those of ctest, for
example --tests-regex '^TestSplats'; ctest --help lists them.
END
  exit
fi

cd "$(dirname "${BASH_SOURCE[0]}")"
Utilities/prepare.sh ci
exec ctest --preset ci "$@"
