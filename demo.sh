#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# From scattered samples to a picture; see the usage below.
set -euo pipefail

usage()
{
  cat << END
usage: $0 [--triangles] [FILE ARRAY ISOVALUE]
Builds the plugin if necessary, computes the isopoints of a file's point or cell array with ParaView, and
writes isopoints.vtp and isosurface.png to the current folder. Where splats leave holes between the samples,
it draws triangles as well, and writes triangles.vtp and triangles.png. Without a file the samples are a
million random ones of the distance to a point; their true isosurface is a sphere, errors are printed,
and comparison.png is written as well.
  --triangles   computes the isosurface as triangles instead, and writes triangles.vtp and isosurface.png
END
}

source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$source_dir/Utilities/steps.sh"
handle_help "$@"
filter=points
if [[ ${1-} == --triangles ]]; then
  filter=triangles
  shift
fi
if (($# != 0 && $# != 3)) || [[ ${1-samples} == '' || ${1-} == -* ]]; then
  fail_with_usage
fi
"$source_dir/Utilities/prepare.sh" release
# In the environment, since pvbatch interprets arguments that begin with a minus itself.
export ISOPOINTS_FILTER=$filter ISOPOINTS_FILE=${1-} ISOPOINTS_ARRAY=${2-} ISOPOINTS_ISOVALUE=${3-}
step "Contouring and drawing" "$source_dir/Utilities/offscreen.sh" pvbatch \
  "$source_dir/Utilities/demo.py" "$source_dir/build/release/lib/ScatteredIsopoints/ScatteredIsopoints.so"
