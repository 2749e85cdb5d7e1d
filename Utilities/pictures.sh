#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Renders the pictures of the README and of docs/; see the usage below.
set -euo pipefail

usage()
{
  cat << END
usage: $0 [DATA]
Builds the plugin if necessary and makes the pictures of README.md and docs/ in place; look at each before
you commit it. Those of real data need the folder DATA, with the files that Testing/ParaView/TestRealFiles.py
lists; without it they stay as they are. The test Python.Wheel makes docs/surface.png, and says so if it
changes; it leaves those of docs/gallery and pyvista_cloud.png in its folder pyvista. docs/window.png is a
picture of the screen.
END
}

source "$(dirname "${BASH_SOURCE[0]}")/steps.sh"
handle_help "$@"
(($# <= 1)) || fail_with_usage
data=${1:+$(realpath "$1")}
cd "$(dirname "${BASH_SOURCE[0]}")/.."
Utilities/prepare.sh release

root=$PWD
build=$root/build/release
plugin=$build/lib/ScatteredIsopoints/ScatteredIsopoints.so
PYTHONPATH=$(echo "$build"/lib/python3*/*-packages)
export PYTHONPATH
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

# draw INTERPRETER SCRIPT...
draw()
{
  step "${2#"$root/"}" "$root/Utilities/offscreen.sh" "$@"
}

draw pvbatch "$root/Utilities/demo.py" "$plugin"
draw pvbatch "$root/Benchmark/troubleshooting_pictures.py" "$plugin" "$root/docs/choosing"
export PV_PLUGIN_PATH=${plugin%/*} # those above load the plugin themselves
for name in amr_levels csv_table droplets filters heat in_situ_simulation particle_slice sharp_solid time_series \
  vortices; do
  draw pvbatch "$root/Examples/$name.py"
done
draw /usr/bin/python3 "$root/Examples/sph_snapshot.py"
rm isosurface.png
mv comparison.png "$root/docs/"
mv ./*.png "$root/docs/examples/"
if [[ $data ]]; then
  unset PV_PLUGIN_PATH # these load the plugin themselves, or need none
  draw pvbatch "$root/Benchmark/triangle_pictures.py" "$plugin" "$data" "$root/docs/triangles.png"
fi
echo "made:"
git -C "$root" diff --name-only -- '*.png' | sed 's/^/  /'
