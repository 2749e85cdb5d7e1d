#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Builds and tests the project in bare roots of several Debian releases; see the usage below.
set -euo pipefail

stacks=(bookworm-paraview bookworm-vtk bookworm-library trixie-paraview sid-paraview sid-vtk)

usage()
{
  cat << END
usage: $0 FOLDER [STACK...]
Makes a bare root for each stack below FOLDER with debootstrap, unless it is there, and in it
installs, builds and tests what is committed, compiler warnings being errors. Prints the versions and
CTest's summary of each. Needs root, debootstrap, git, and up to 7 GiB for each stack. Stacks, all by
default: ${stacks[*]}
END
}

source "$(dirname "${BASH_SOURCE[0]}")/steps.sh"
handle_help "$@"
(($# > 0)) || fail_with_usage
need_root
folder=$(realpath "$1")
shift
if (($# > 0)); then
  stacks=("$@")
fi
source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

source "$source_dir/Utilities/roots.sh"

test_stack()
{
  local stack=$1
  local root=$folder/$stack
  local preset=${stack##*-}
  if [[ $preset == paraview ]]; then
    preset=release
  fi
  make_root "${stack%-*}" "$root"
  rm -rf "$root/root/source"
  git clone --quiet "$source_dir" "$root/root/source"
  run_in_root "$root" "cd /root/source && CI=true Utilities/prepare.sh $preset all tests" >> "$root.log" 2>&1 || {
    echo "$stack: does not build; see $root.log"
    return
  }
  run_in_root "$root" "cd /root/source && ctest --preset $preset --parallel $(nproc)" > "$root.tests.log" 2>&1 || true
  local versions
  versions=$(run_in_root "$root" "cd /root/source && dpkg-query --show --showformat='\${Package} \${Version}, ' \
    libvtk9-dev paraview-dev libcgal-dev libeigen3-dev g++ cmake 2> /dev/null") || true
  echo "$stack: $(grep 'tests passed' "$root.tests.log" || tail -1 "$root.tests.log"); ${versions%, }"
}

mkdir -p "$folder"
for stack in "${stacks[@]}"; do
  test_stack "$stack"
done
