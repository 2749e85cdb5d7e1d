#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Makes wheels for Windows and macOS from that for Linux; see the usage below.
set -euo pipefail

usage()
{
  cat << END
usage: $0 PLATFORM...
Makes a wheel for each platform in dist from that for Linux there, as root in the Debian 11 where
Utilities/wheel_in_root.sh made it. Compiles the library and oneTBB with PyPI's ziglang, and checks what each
system wants of a library. Tries the wheel for Windows under Wine, with the Python that PyPI's panda3d
brings. Platforms: win_amd64, macosx_11_0_arm64, macosx_10_15_x86_64.
END
}

cd "$(dirname "${BASH_SOURCE[0]}")/.."
source Utilities/steps.sh
expect_debian_11 "$@"
shopt -s extglob
root=$(dirname "$PWD")
export folder=$root/elsewhere onetbb=$root/oneTBB
source Utilities/zig.sh
linux_wheel=$(echo dist/*manylinux*_x86_64.whl)

fail()
{
  echo "$0: $*" >&2
  return 1
}

# zig's name of a platform.
target_of()
{
  case $1 in
    win_amd64) echo x86_64-windows-gnu ;;
    macosx_11_0_arm64) echo aarch64-macos.11.0 ;;
    macosx_10_15_x86_64) echo x86_64-macos.10.15 ;;
    *) fail "$1 is not a platform that is known here" ;;
  esac
}

prepare()
{
  export DEBIAN_FRONTEND=noninteractive PIP_DISABLE_PIP_VERSION_CHECK=1
  apt-get install --quiet=2 --yes --no-install-recommends llvm wine64 >> "$root/install.log"
  mkdir -p "$folder"
  prepare_zig "$root/debian-13/usr/include"
  find_sources
  if [[ ! -d $folder/googletest ]]; then
    (cd "$folder" && apt-get download --quiet=2 -o APT::Sandbox::User=root googletest/trixie)
    dpkg --extract "$(echo "$folder"/googletest_*.deb)" "$folder/extracted"
    mv "$folder/extracted/usr/src/googletest/googletest" "$folder"
  fi
  # The last ziglang that has the symbols of macOS 10.15 and 11.
  download_wheel "$folder/stubs" ziglang==0.9.1 'ziglang/lib/libc/darwin/*.tbd'
}

# download_wheel TARGET REQUIREMENT [PATTERN [OPTION...]]: extracts files of a wheel of the index.
download_wheel()
{
  if [[ ! -d $1 ]]; then
    "$folder/zig/bin/python" -m pip download --quiet --no-deps --dest "$1.wheel" "${@:4}" "$2"
    "$folder/zig/bin/python" - "$1.part" "$1.wheel" "${3-*}" << END
import fnmatch, glob, sys, zipfile
with zipfile.ZipFile(glob.glob(sys.argv[2] + "/*.whl")[0]) as archive:
    archive.extractall(sys.argv[1], fnmatch.filter(archive.namelist(), sys.argv[3]))
END
    mv "$1.part" "$1"
  fi
}

# Nothing may change a library after it is linked: it would lose the signature that macOS asks for.
build_library()
{
  local options sources=("${core_sources[@]}" "${library_sources[@]}" "$onetbb"/src/tbb/*.cpp
    Utilities/bundled_allocation.cxx)
  if [[ $1 == win_* ]]; then
    options=(-Wl,-Brepro -Wl,--out-implib,"$folder/$target/isopoint.lib") # the same bytes at any time
  else
    # zig compiles these files of its C++ library so that they export symbols or bind them weakly.
    sources+=("$libcxx"/src/{ios.instantiations,iostream,locale,new}.cpp)
    options=(-Wl,-x -Wl,-install_name,@rpath/libisopoint.dylib)
  fi
  compile_all "$target" "${sources[@]}"
  rm -rf "$folder/$1"
  mkdir -p "$folder/$1"
  link "$target" "$library" -shared -s "${options[@]}" -- "${sources[@]}"
}

# Those of what zig links, beside the library.
collect_licenses()
{
  local zig=${libcxx%/lib/libcxx}
  cat "$zig"/lib/{libcxx,libcxxabi,libunwind}/LICENSE.TXT > "$folder/$1/LICENSE.LLVM"
  cp "$zig/LICENSE" "$folder/$1/LICENSE.Zig"
  if [[ $1 == win_* ]]; then
    cp "$zig/lib/libc/mingw/COPYING" "$folder/$1/LICENSE.mingw-w64"
  fi
}

# Prints what a library needs of its system, and fails unless the system has it.
check_library()
{
  python3 Testing/Library/TestSymbols.py "$library" Library/isopoint.h
  if [[ $1 == win_* ]]; then
    check_dll
  else
    check_dylib "$1"
  fi
}

check_dll()
{
  local needed
  needed=$(llvm-objdump -p "$library" | grep 'DLL Name')
  echo "$needed"
  ! grep -viE ' (kernel32|api-ms-win-crt-[a-z]+-l1-1-0)\.dll$' <<< "$needed" ||
    fail "$library needs more than Windows 10"
}

check_dylib()
{
  local headers major minor architecture pattern stubs symbol
  IFS=_ read -r _ major minor architecture <<< "$1"
  headers=$(llvm-objdump --macho --private-headers "$library")
  grep -E -A6 'LC_(ID_DYLIB|LOAD_DYLIB|BUILD_VERSION|VERSION_MIN_MACOSX|CODE_SIGNATURE)' <<< "$headers"
  # A library with variables of threads is never unloaded, nor is oneTBB in it.
  for pattern in 'name @rpath/libisopoint\.dylib ' "(minos|version) $major\.$minor$" MH_HAS_TLV_DESCRIPTORS; do
    grep -qE "$pattern" <<< "$headers" || fail "$library lacks $pattern"
  done
  [[ $architecture != arm64 ]] || grep -q LC_CODE_SIGNATURE <<< "$headers" || fail "$library is not signed"
  [[ $(grep -A3 -E 'LC_(LOAD|REEXPORT|LOAD_WEAK)_DYLIB' <<< "$headers" | grep -c name) == 1 ]] ||
    fail "$library needs more than libSystem"
  # Types of exceptions, by names that no other library has, stay weak.
  ! llvm-objdump --macho --weak-bind "$library" | grep ' pointer ' | grep -vE ' __ZTIN(8isopoint|4CGAL)' ||
    fail "macOS may replace these symbols of $library"
  # Lists of the symbols that this version has on this processor.
  stubs=$(awk -v target="$architecture-macos" '
    /- targets:/ { listed = 0; names = 1 }
    names && index($0, target) { listed = 1 }
    /symbols:/ { names = 0 }
    listed' "$folder/stubs/ziglang/lib/libc/darwin/libSystem.$major.tbd")
  for symbol in $(llvm-nm --undefined-only "$library" | awk '{ print $NF }'); do
    grep -qE "[ ']${symbol//$/\\$}[ ',]" <<< "$stubs" || fail "macOS $major.$minor lacks $symbol"
  done
}

make_wheel()
{
  local wheel
  wheel=$(python3 Utilities/exchange_library.py "$linux_wheel" "$1" "$library" dist)
  (($(stat --format %s "$wheel") < 4000000)) || fail "$wheel has more than 4 MB"
  ls -l "$wheel"
}

# The Python for Windows that panda3d brings for the programs that it packs, with Debian's modules of the
# same version and the oldest NumPy.
get_windows_python()
{
  local options=(--platform win_amd64 --python-version 3.9 --only-binary=:all:)
  if [[ ! -d $folder/windows ]]; then
    download_wheel "$folder/panda3d" panda3d==1.10.15 'deploy_libs/*' "${options[@]}"
    mkdir -p "$folder/windows.part/DLLs"
    cp "$folder"/panda3d/deploy_libs/{*.pyd,libffi-7.dll} "$folder/windows.part/DLLs"
    cp "$folder"/panda3d/deploy_libs/{python39,VCRUNTIME140}.dll "$folder/windows.part"
    cp -r /usr/lib/python3.9 "$folder/windows.part/Lib"
    cat > "$folder/python.c" << END
#include <windows.h>
int wmain(int count, wchar_t** words)
{
  HMODULE python = LoadLibraryW(L"python39.dll");
  return ((int (*)(int, wchar_t**))GetProcAddress(python, "Py_Main"))(count, words);
}
END
    zig cc -target x86_64-windows-gnu -municode "$folder/python.c" -o "$folder/windows.part/python.exe"
    download_wheel "$folder/windows.part/Lib/site-packages" numpy==1.19.5 '*' "${options[@]}"
    mv "$folder/windows.part" "$folder/windows"
  fi
  windows "$folder/windows/python.exe" --version # Wine makes its folder
}

# windows COMMAND...: runs a program for Windows, which wants a standard input. Wine needs certain addresses,
# which Linux may otherwise give away.
windows()
{
  WINEPREFIX=$folder/wine WINEDEBUG=-all setarch --addr-no-randomize /usr/lib/wine/wine64 "$@" <<< '' 2>&1 | tr --delete '\r'
}

# Fails unless two files are the same.
compare()
{
  cmp "$1" "$2" || fail "Windows has other results than Linux"
  echo "the same $(wc -l < "$1") lines"
}

# The wheel in Python; it gives the results of that for Linux.
try_wheel()
{
  local packages=$folder/windows/Lib/site-packages test
  rm -rf "$packages"/scatteredisopoints*
  python3 -m zipfile -e dist/*win_amd64.whl "$packages"
  windows "$folder/windows/python.exe" Testing/Python/extractions.py > "$folder/found"
  compare "$root/extractions-x86_64" "$folder/found"
  for test in Package Probe Slice; do
    windows "$folder/windows/python.exe" "Testing/Python/Test$test.py"
  done
  windows "$folder/windows/python.exe" Testing/Python/TestProcesses.py 100
}

# Programs in C++; the core gives the results that it has by GCC.
try_programs()
{
  local target=x86_64-windows-gnu build=$root/build-x86_64 own=Testing/Cxx/PrintResults.cxx
  local tests=("$folder"/googletest/src/gtest{-all,_main}.cc Testing/Library/TestLibrary{,Calls,Places,Splats}.cxx)
  compile_all "$target" "$own" "${tests[@]}"
  link "$target" "$folder/win_amd64/TestLibrary.exe" "$folder/$target/isopoint.lib" -- "${tests[@]}"
  windows "$folder/win_amd64/TestLibrary.exe" --gtest_brief=1
  link "$target" "$folder/win_amd64/PrintResults.exe" -- "$own" "${core_sources[@]}" \
    "$onetbb"/src/tbb/*.cpp Utilities/bundled_allocation.cxx
  g++ -O3 -std=c++17 -ffp-contract=off -I. -isystem "$folder/headers" -isystem "$onetbb/include" \
    -DCGAL_DISABLE_GMP=1 -DCGAL_LINKED_WITH_TBB "$own" $(find "$build/Core" -name '*.o') \
    -L"$onetbb-x86_64/lib" -ltbb -ltbbmalloc -lpthread -ldl -o "$folder/PrintResults"
  "$folder/PrintResults" > "$folder/expected"
  windows "$folder/win_amd64/PrintResults.exe" > "$folder/found"
  compare "$folder/expected" "$folder/found"
}

make_for()
{
  local target library
  target=$(target_of "$1")
  library=$folder/$1/libisopoint.dylib
  if [[ $1 == win_* ]]; then
    library=$folder/$1/isopoint.dll
  fi
  build_library "$1"
  collect_licenses "$1"
  check_library "$1"
  make_wheel "$1"
}

step 'Getting compiler and libraries' prepare
for platform in "$@"; do
  step "Making the wheel for $platform" make_for "$platform"
  if [[ $platform == win_amd64 ]]; then
    step 'Getting a Python for Windows' get_windows_python
    step 'Trying the wheel on Windows' try_wheel
    step 'Trying programs on Windows' try_programs
  fi
done
