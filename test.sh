#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Builds the project, warnings being errors, and runs all its tests; arguments go to ctest.
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")"
Utilities/prepare.sh ci
exec ctest --preset ci "$@"
