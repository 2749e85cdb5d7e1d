#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs, uses and removes a .deb in a bare root; see the usage below.
set -euo pipefail

usage()
{
  cat << END
usage: $0 FOLDER RELEASE PACKAGE
Makes a bare root of the Debian RELEASE below FOLDER with debootstrap, unless it is there, and in it
installs PACKAGE, a .deb, as a user would. ParaView must list its plugin and load it automatically, all that
it adds to the window must work, and nothing may be left of it when it is removed. Needs root,
debootstrap and 3 GiB.
END
}

source "$(dirname "${BASH_SOURCE[0]}")/steps.sh"
handle_help "$@"
(($# == 3)) || fail_with_usage
need_root
folder=$(realpath "$1")
root=$folder/$2-package
package=$3
source "$(dirname "${BASH_SOURCE[0]}")/roots.sh"

in_root()
{
  run_in_root "$root" "export DEBIAN_FRONTEND=noninteractive; $1" >> "$root.log" 2>&1 || {
    echo "$package: failed in $root: $1; see $root.log" >&2
    exit 1
  }
}

# Files of packages and users, without programs' own data and apt's records.
files_of()
{
  find "$root" -xdev \( -path "$root/var" -o -path "$root/tmp" -o -path "$root/root" \
    -o -path "$root/etc/ld.so.cache" -o -name __pycache__ \) -prune \
    -o -type f -exec md5sum {} + -o -printf '%y %p %l\n' | sort
}

use_package()
{
  in_root "cd /root && python3 module.py && ./offscreen.sh pvbatch script.py"
  in_root "cd /root && ./offscreen.sh paraview --script=window.py && test -s listed"
  in_root "rm /root/listed"
  in_root "cd /root && ./offscreen.sh python3 Testing/ParaView/TestWindowStarts.py paraview"
}

make_root "$2" "$root"
cp "$package" "$root/root/package.deb"
source_dir=$(dirname "${BASH_SOURCE[0]}")/..
cp "$source_dir/Utilities/offscreen.sh" "$root/root/"
(cd "$source_dir" && cp --parents Testing/ParaView/{TestWindowStarts,playing}.py Testing/Python/checking.py "$root/root/")
cat > "$root/root/script.py" << END
from paraview.simple import *
SaveData("isopoints.vtp", ScatteredIsopoints(Input=Wavelet(), Isosurfaces=[157.0]))
END
cat > "$root/root/window.py" << END
import os
from paraview.servermanager import vtkPVPluginTracker
tracker = vtkPVPluginTracker.GetInstance()
names = [tracker.GetPluginName(i) for i in range(tracker.GetNumberOfPlugins())]
loaded = [name for i, name in enumerate(names) if tracker.GetPluginLoaded(i)]
if names.count("ScatteredIsopoints") == loaded.count("ScatteredIsopoints") == 1:
    open("listed", "w").write(" ".join(names))
os._exit(0)
END
cat > "$root/root/module.py" << END
import numpy, scatteredisopoints
positions = numpy.random.default_rng(1).random((5000, 3))
isosurface = scatteredisopoints.contour(positions, numpy.linalg.norm(positions, axis=1), 0.5)
assert len(isosurface.points) > 100
END
install="apt-get install --yes --no-install-recommends"
in_root "apt-get update && $install /root/package.deb xvfb xauth libgl1-mesa-dri"
in_root "apt-get remove --yes scattered-isopoints"
files_of > "$root.before"
in_root "$install /root/package.deb"
use_package
in_root "$install --reinstall /root/package.deb"
use_package
in_root "apt-get remove --yes scattered-isopoints"
files_of > "$root.after"
diff "$root.before" "$root.after" || {
  echo "$package: the files above are left in $root" >&2
  exit 1
}
echo "$2: $(basename "$package") was installed, used and removed"
