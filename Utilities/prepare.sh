#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs missing Debian packages and builds the project; see the usage below.
set -euo pipefail

usage()
{
  cat << END
usage: $0 PRESET [TARGET...]
Installs the Debian packages that are missing, for which it needs root, and builds targets of a preset of
CMakePresets.json: by default all but the tests, whose target is "tests". Instead of a preset, "check"
installs what Utilities/check.sh needs, and "wheel" what "pip install ." needs; both build nothing. A
folder that is configured with CI=true in the environment stops at the first warning of the compiler.
END
}

source "$(dirname "${BASH_SOURCE[0]}")/steps.sh"
handle_help "$@"
(($# > 0)) || fail_with_usage
preset=$1
shift
cd "$(dirname "${BASH_SOURCE[0]}")/.."

if ! command -v dpkg-query > /dev/null; then
  echo "$0: this is not a Debian system. Install the equivalents of the packages that" >&2
  echo "Utilities/debian-packages*.txt list, then use cmake as the README says." >&2
  exit 1
fi
package_lists=(Utilities/debian-packages.txt)
if [[ $preset == vtk* ]]; then
  package_lists+=(Utilities/debian-packages-vtk.txt)
elif [[ $preset != library && $preset != wheel ]]; then
  release=$(. /etc/os-release && echo "${VERSION_ID-sid}")
  package_lists+=(Utilities/debian-packages-paraview{,"-$release"}.txt)
fi
if [[ -f Utilities/debian-packages-$preset.txt && $preset != vtk ]]; then
  package_lists+=("Utilities/debian-packages-$preset.txt")
fi
for list in "${package_lists[@]}"; do
  if [[ ! -f $list ]]; then
    echo "$0: there is no $list: with ParaView Debian 12, 13 and sid are known." >&2
    echo "Build with VTK alone (the preset vtk), or install what the other lists name." >&2
    exit 1
  fi
done

missing_packages()
{
  local package
  while read -r package; do
    case $package in '' | '#'*) continue ;; esac
    dpkg-query --show --showformat='${db:Status-Status}\n' "$package" 2>/dev/null |
      grep -qx installed || echo "$package"
  done < <(cat "${package_lists[@]}")
}

# Filters the output of apt-get: counts and sizes, whose wording depends on the version, and the progress
# every five seconds.
shorten_apt_output()
{
  awk '
    /newly installed|Need to get|disk space|Installing: |Download size|Space needed/ { print "  " $0; fflush() }
    /^Get:/ { downloaded++ }
    /^Unpacking / { unpacked++ }
    /^Setting up / { ready++ }
    downloaded && systime() >= next_time {
      printf "  packages: %d downloaded, %d unpacked, %d ready\n", downloaded, unpacked, ready
      fflush()
      next_time = systime() + 5
    }'
}

install_packages()
{
  export DEBIAN_FRONTEND=noninteractive
  apt-get update --quiet=2
  apt-get install --quiet --yes --no-install-recommends "$@" | shorten_apt_output
}

mapfile -t missing < <(missing_packages)
if ((${#missing[@]} > 0)); then
  if ((EUID != 0)); then
    echo "$0: ${#missing[@]} packages are missing. Run this once as root, or install them with" >&2
    echo "  apt-get install --no-install-recommends ${missing[*]}" >&2
    exit 1
  fi
  step "Installing ${#missing[@]} packages and what they depend on" install_packages "${missing[@]}"
fi

# Since Debian 13 paraview-dev expects other names of Python modules than Debian's packages have.
if [[ ${release-12} != 12 ]] && ((EUID == 0)); then
  for module in /usr/lib/python3/dist-packages/{vtkmodules,paraview/modules,paraview/incubator}/*.cpython-*.so; do
    link=${module%%.cpython-*}.so
    [[ -e $link ]] || ln --symbolic "${module##*/}" "$link"
  done
fi

if [[ $preset == check || $preset == wheel ]]; then
  exit 0
fi
configure()
{
  local log
  log=$(mktemp)
  local options=()
  [[ ${CI-} != true ]] || options=(-D SCATTEREDISOPOINTS_WARNINGS_AS_ERRORS=ON)
  cmake --preset "$preset" "${options[@]}" > "$log" 2>&1 || {
    cat "$log" >&2
    rm -f "$log"
    exit 1
  }
  rm -f "$log"
}

if [[ ! -f build/$preset/build.ninja ]]; then
  step "Configuring build/$preset" configure
fi
(($# > 0)) || set -- all
step "Building build/$preset: $*" cmake --build --preset "$preset" --parallel "$(nproc)" --target "$@"
