#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Builds wheels of the Python package that run on many systems; see the usage below.
set -euo pipefail

platforms=(x86_64 aarch64 win_amd64 macosx_11_0_arm64 macosx_10_15_x86_64)

usage()
{
  cat << END
usage: $0 FOLDER [PLATFORM...]
Makes a bare root of Debian 11 below FOLDER with debootstrap, unless it is there, and in it builds a wheel
of what is committed for each platform, tries it as far as this machine can, and puts it into dist in place
of the wheels there. Those for Linux, x86_64 and aarch64, need glibc 2.28 or later. That for x86_64 is
always made: those for Windows and macOS are made from it. All need NumPy; all else is linked statically.
Needs root, debootstrap, git and 6 GiB. Half an hour on two cores.
Platforms, all by default: ${platforms[*]}
END
}

source "$(dirname "${BASH_SOURCE[0]}")/steps.sh"
handle_help "$@"
(($# > 0)) || fail_with_usage
need_root
folder=$(realpath "$1")
shift
(($# == 0)) || platforms=("$@")
linux=(x86_64)
others=()
for platform in "${platforms[@]}"; do
  case $platform in
    x86_64) ;;
    win_* | macosx_*) others+=("$platform") ;;
    *) linux+=("$platform") ;;
  esac
done
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source Utilities/roots.sh

root=$folder/bullseye-wheel
step "Making $root" make_root bullseye "$root"
# A proxy before PyPI may have its own certificate.
cp /etc/ssl/certs/ca-certificates.crt "$root/root/certificates"
rm -rf "$root/root/source"
git clone --quiet . "$root/root/source"
commands="cd /root/source && export PIP_CERT=/root/certificates && Utilities/wheel_in_root.sh ${linux[*]}"
if ((${#others[@]} > 0)); then
  commands+=" && Utilities/wheel_elsewhere.sh ${others[*]}"
fi
run_in_root "$root" "$commands"
mkdir -p dist
rm -f dist/*.whl
cp "$root"/root/source/dist/*.whl dist/
ls -l dist/*.whl
