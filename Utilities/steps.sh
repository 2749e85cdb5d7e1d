# SPDX-License-Identifier: GPL-3.0-or-later
# Sourced: what scripts have in common.

# step TITLE COMMAND...: prints the title, runs the command, and prints its seconds.
step()
{
  local title=$1 start=$SECONDS
  shift
  echo "== $title"
  "$@"
  echo "== $title: $((SECONDS - start)) s"
}

# expect_debian_11 ARGUMENT...: exits with the script's usage() if that is asked for, without arguments, and
# unless this is root in Debian 11.
expect_debian_11()
{
  if [[ ${1-} == --help ]]; then
    usage
    exit
  fi
  if (($# == 0)) || ((EUID != 0)) || [[ $(. /etc/os-release && echo "${VERSION_ID-}") != 11 ]]; then
    usage >&2
    exit 2
  fi
}
