#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Builds and tests the project in bare roots of several Debian releases; see the usage below.
set -euo pipefail

stacks=(bookworm-paraview bookworm-vtk trixie-paraview sid-vtk)

usage()
{
  cat << END
usage: $0 FOLDER [STACK...]
Makes a bare root for each stack below FOLDER with debootstrap, unless it is there, and in it
installs, builds and tests what is committed, compiler warnings being errors. Prints the versions and
CTest's summary of each. Needs root, debootstrap, git, and 5 GiB for each stack. Stacks, all by
default: ${stacks[*]}
END
}

if [[ ${1-} == --help ]]; then
  usage
  exit
fi
if (($# == 0)) || ((EUID != 0)); then
  usage >&2
  exit 2
fi
folder=$(realpath "$1")
shift
if (($# > 0)); then
  stacks=("$@")
fi
source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

# Runs a command in a root, whose mounts end with it.
run_in()
{
  unshare --mount bash -c '
    mount -t proc proc "$0/proc" && mount --rbind /dev "$0/dev" &&
      exec chroot "$0" env -i HOME=/root LANG=C.UTF-8 PATH=/usr/sbin:/usr/bin:/sbin:/bin \
        bash -c "cd /root/source && $1"' "$1" "$2"
}

test_stack()
{
  local stack=$1
  local root=$folder/$stack
  local preset=ci
  if [[ $stack == *-vtk ]]; then
    preset=vtk-ci
  fi
  if [[ ! -d $root ]]; then
    debootstrap --variant=minbase "${stack%-*}" "$root.part" > "$root.log" 2>&1
    mv "$root.part" "$root"
  fi
  cp /etc/resolv.conf "$root/etc/"
  rm -rf "$root/root/source"
  git clone --quiet "$source_dir" "$root/root/source"
  run_in "$root" "Utilities/prepare.sh $preset" >> "$root.log" 2>&1 || {
    echo "$stack: does not build; see $root.log"
    return
  }
  run_in "$root" "ctest --preset $preset" > "$root.tests.log" 2>&1 || true
  local versions
  versions=$(run_in "$root" "dpkg-query --show --showformat='\${Package} \${Version}, ' \
    libvtk9-dev paraview-dev libcgal-dev libeigen3-dev g++ cmake 2> /dev/null") || true
  echo "$stack: $(grep 'tests passed' "$root.tests.log" || tail -1 "$root.tests.log"); ${versions%, }"
}

mkdir -p "$folder"
for stack in "${stacks[@]}"; do
  test_stack "$stack"
done
