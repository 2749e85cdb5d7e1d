#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Compiles the core for other systems, and compares its results; see the usage below.
set -euo pipefail

targets=(x86_64-linux-gnu.2.17 aarch64-linux-gnu.2.17 x86_64-macos aarch64-macos x86_64-windows-gnu)

usage()
{
  cat << END
usage: $0 [TARGET...]
Compiles the core, and the library in Library if there is one, in build/elsewhere with PyPI's ziglang, a
clang that has the C and C++ libraries of other systems. Where this machine can run the program
PrintResults, its output is compared with that of the preset "release", by GCC. Prints a table, and fails
unless all objects compile, all links succeed and all results are the same. Needs the Debian packages of
that preset and, to run programs for ARM, qemu-user and libc6-arm64-cross. An hour on two cores.
Targets, all by default: ${targets[*]}
END
}

if [[ ${1-} == --help ]]; then
  usage
  exit
fi
(($# == 0)) || targets=("$@")
cd "$(dirname "${BASH_SOURCE[0]}")/.."
export folder=$PWD/build/elsewhere

# Only headers, because those of this system's C library do not fit other systems. CGAL includes the last
# one, which glibc has since 2.32, wherever it exists: this one is found before zig's.
prepare_headers()
{
  mkdir -p "$folder/headers" "$folder/shims/sys"
  ln -sfn /usr/include/{boost,CGAL} /usr/include/eigen3/Eigen "$folder/headers"
  echo 'static const char __libc_single_threaded = 0;' > "$folder/shims/sys/single_threaded.h"
}

prepare_sources()
{
  local layouts layout
  mkdir -p "$folder/sources"
  read -ra layouts < <(sed -nE 's/^foreach \(TSample IN ITEMS (.*)\)$/\1/p' Core/CMakeLists.txt)
  for layout in "${layouts[@]}"; do
    sed "s/@TSample@/$layout/" Core/ExtractFromCloud.cxx.in > "$folder/sources/ExtractFrom$layout.cxx"
  done
  mapfile -t sources < <(find "$folder/sources" Core -name '*.cxx')
  mapfile -t library_sources < <(find Library -name '*.cxx' 2> /dev/null)
}

zig()
{
  ZIG_GLOBAL_CACHE_DIR=$folder/cache ZIG_LOCAL_CACHE_DIR=$folder/cache "$folder/python/bin/python" -m ziglang "$@"
}

# compile TARGET SOURCE
compile()
{
  local object=$folder/$1/${2##*/}.o
  zig c++ -target "$1" -c -O2 -g0 -std=c++17 -fPIC \
    -ffp-contract=off -fno-math-errno -frounding-math \
    -DISOPOINT_BUILDS_LIBRARY \
    -DCGAL_DISABLE_GMP=1 -DCGAL_DISABLE_MPFR=1 -DCGAL_HEADER_ONLY=1 -DBOOST_NO_CXX98_FUNCTION_BASE \
    -I. -I"$folder/shims" -isystem "$folder/headers" "$2" -o "$object" > "$object.log" 2>&1 || echo "$1: $2 fails: $object.log" >&2
}
export -f zig compile

# outcome COMMAND...: runs a command and prints its outcome
outcome()
{
  if "$@" > "$folder/$target/link.log" 2>&1; then
    echo yes
  else
    echo NO
  fi
}

# Compares the output of a target's program with GCC's.
result()
{
  local run=()
  case $target in
    "$(uname -m)"-linux-*) ;;
    aarch64-linux-*) run=(qemu-aarch64 -L /usr/aarch64-linux-gnu) ;;
    *)
      echo 'not run'
      return
      ;;
  esac
  if ! "${run[@]}" "$folder/$target/PrintResults" > "$folder/$target/results"; then
    echo 'FAILS'
  elif cmp --silent "$folder/results" "$folder/$target/results"; then
    echo 'the same'
  else
    echo "$(diff "$folder/results" "$folder/$target/results" | grep -c '^>') LINES DIFFER"
  fi
}

# A row of the table.
row()
{
  local target=$1 core=() linked='none'
  rm -rf "${folder:?}/$target"
  mkdir -p "$folder/$target"
  printf '%s\n' "${sources[@]}" "${library_sources[@]}" Testing/Cxx/PrintResults.cxx | sed '/^$/d' |
    xargs -P "$(nproc)" -I SOURCE bash -c 'compile "$@"' _ "$target" SOURCE
  mapfile -t core < <(find "$folder/$target" -name '*.o' ! -name PrintResults.cxx.o)
  if ((${#library_sources[@]} > 0)); then
    linked=$(outcome zig c++ -target "$target" -shared "${core[@]}" -o "$folder/$target/library")
  fi
  printf '%-24s %3d of %-3d %-8s %-8s %s\n' "$target" $((${#core[@]} + 1)) \
    $((${#sources[@]} + ${#library_sources[@]} + 1)) "$linked" \
    "$(outcome zig c++ -target "$target" "$folder/$target"/*.o -o "$folder/$target/PrintResults")" "$(result)"
}

Utilities/prepare.sh release PrintResults
mkdir -p "$folder"
build/release/bin/PrintResults > "$folder/results"
python3 -m venv "$folder/python"
"$folder/python/bin/pip" install --quiet ziglang
prepare_headers
prepare_sources
printf '%-24s %-10s %-8s %-8s %s\n' target objects library program results > "$folder/table"
for target in "${targets[@]}"; do
  row "$target" >> "$folder/table"
done
cat "$folder/table"
! grep -qE 'NO|FAILS|DIFFER' "$folder/table"
