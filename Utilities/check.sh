#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# check.sh [format|lint|documents|spelling|fix]...: checks the format of C++ files (clang-format 14), the
# sources of Core, Filters, Library, Rendering and Plugin (clang-tidy 14, preset release), links,
# paths, commands and figures in the documents, and the spelling of all files (codespell). Default: all four.
# fix formats in place.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# The command of a tool's version 14; installs it if possible.
version_14()
{
  command -v "$1-14" > /dev/null || Utilities/prepare.sh check >&2 || true
  local command
  for command in "$1-14" "$1"; do
    if "$command" --version 2> /dev/null | grep -q 'version 14\.'; then
      echo "$command"
      return
    fi
  done
  echo "$0: $1 of version 14 is needed: other versions format and warn differently." >&2
  return 1
}

format()
{
  local tool
  tool=$(version_14 clang-format)
  # clang-format 14 indents extern "C" blocks.
  git ls-files -z --cached --others --exclude-standard '*.h' '*.cxx' ':!*/isopoint.h' | xargs -0 "$tool" "$@"
}

lint()
{
  local tool
  tool=$(version_14 clang-tidy)
  Utilities/prepare.sh release # generated headers
  grep -oP '"file": "\K[^"]+' build/release/compile_commands.json |
    grep -E "^$PWD/(build/release/Core|Core|Filters|Library|Plugin|Rendering)/" |
    xargs -d '\n' -n 1 -P "$(nproc)" "$tool" --quiet -p build/release 2>&1 |
    sed -E '/warnings? .*generated\.$/d'
}

(($# > 0)) || set -- format documents spelling lint
for check; do
  case $check in
    format) format --dry-run --Werror ;;
    fix) format -i ;;
    lint) lint ;;
    documents) Utilities/check-documents.py ;;
    spelling)
      command -v codespell > /dev/null || Utilities/prepare.sh check
      git ls-files -z | xargs -0 codespell
      ;;
    *)
      echo "usage: $0 [format|lint|documents|spelling|fix]..." >&2
      exit 2
      ;;
  esac
done
