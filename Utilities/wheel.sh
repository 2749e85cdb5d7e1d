#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Builds wheels of the Python package that run on many systems; see the usage below.
set -euo pipefail

architectures=(x86_64 aarch64)

usage()
{
  cat << END
usage: $0 FOLDER [ARCHITECTURE...]
Makes a bare root of Debian 11 below FOLDER with debootstrap, unless it is there, and in it builds a wheel
of what is committed for each architecture, tries it, and copies it to dist. The wheels need glibc 2.28 or
later, and NumPy; all else is linked statically. Needs root, debootstrap, git and 3 GiB. Ten minutes on two
cores. Architectures, both by default: ${architectures[*]}
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
(($# == 0)) || architectures=("$@")
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source Utilities/roots.sh
source Utilities/steps.sh

root=$folder/bullseye-wheel
step "Making $root" make_root bullseye "$root"
# A proxy before PyPI may have its own certificate.
cp /etc/ssl/certs/ca-certificates.crt "$root/root/certificates"
rm -rf "$root/root/source"
git clone --quiet . "$root/root/source"
run_in_root "$root" "cd /root/source && PIP_CERT=/root/certificates Utilities/wheel_in_root.sh ${architectures[*]}"
mkdir -p dist
cp "$root"/root/source/dist/*.whl dist/
ls -l dist/*.whl
