#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# From scattered samples to a picture: ./demo.sh [FILE ARRAY ISOVALUE]
# Without arguments it makes a million random samples of a sphere's distance field. Writes
# isopoints.vtp and isosurface.png to the current folder.
set -euo pipefail

if (($# != 0 && $# != 3)) || [[ ${1-samples} == '' || ${1-} == -* ]]; then
  echo "usage: $0 [FILE ARRAY ISOVALUE]" >&2
  exit 2
fi
source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
"$source_dir/Utilities/prepare.sh" release
# By the environment: pvbatch would take arguments that begin with a minus for its own.
export ISOPOINTS_FILE=${1-} ISOPOINTS_ARRAY=${2-} ISOPOINTS_ISOVALUE=${3-}
exec "$source_dir/Utilities/offscreen.sh" pvbatch "$source_dir/Utilities/demo.py" \
  "$source_dir/build/release/lib/ScatteredIsopoints/ScatteredIsopoints.so"
