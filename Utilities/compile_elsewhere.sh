#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Compiles the core for old and other systems, and compares its results; see the usage below.
set -euo pipefail

targets=(x86_64-linux-gnu.2.17 aarch64-linux-gnu.2.17)

usage()
{
  cat << END
usage: $0 [TARGET...]
Compiles core and library without oneTBB in build/elsewhere with PyPI's ziglang, a clang that has the C and
C++ libraries of other systems. Where this machine can run the program PrintResults, its output is compared
with that of the preset "release", by GCC. Prints a table, and fails unless all objects compile, all links
succeed and all results are the same. Needs the Debian packages of that preset and, to run programs for ARM,
qemu-user and libc6-arm64-cross. Half an hour on two cores. Utilities/wheel.sh compiles for Windows and macOS.
Targets, all by default: ${targets[*]}
END
}

cd "$(dirname "${BASH_SOURCE[0]}")/.."
source Utilities/steps.sh
handle_help "$@"
(($# == 0)) || targets=("$@")
if [[ " ${targets[*]}" == *' aarch64-linux-'* ]] && ! command -v qemu-aarch64 > /dev/null; then
  echo "$0: install qemu-user and libc6-arm64-cross" >&2
  exit 1
fi
source Utilities/zig.sh
export folder=$PWD/build/elsewhere onetbb=

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
  local target=$1 program=Testing/Cxx/PrintResults.cxx library=("${core_sources[@]}" "${library_sources[@]}")
  rm -rf "${folder:?}/$target"
  compile_all "$target" "${library[@]}" "$program"
  printf '%-24s %3d of %-3d %-8s %-8s %s\n' "$target" \
    "$(find "$folder/$target" -name '*.o' | wc -l)" $((${#library[@]} + 1)) \
    "$(outcome link "$target" "$folder/$target/library" -shared -- "${library[@]}")" \
    "$(outcome link "$target" "$folder/$target/PrintResults" -- "${core_sources[@]}" "$program")" "$(result)"
}

Utilities/prepare.sh release PrintResults
mkdir -p "$folder"
build/release/bin/PrintResults > "$folder/results"
prepare_zig /usr/include
find_sources
printf '%-24s %-10s %-8s %-8s %s\n' target objects library program results > "$folder/table"
for target in "${targets[@]}"; do
  row "$target" >> "$folder/table"
done
cat "$folder/table"
! grep -qE 'NO|FAILS|DIFFER' "$folder/table"
