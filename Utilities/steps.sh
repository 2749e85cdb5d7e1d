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

# handle_help ARGUMENT...: prints the script's usage() and exits if that is asked for.
handle_help()
{
  if [[ ${1-} == --help ]]; then
    usage
    exit
  fi
}

# Exits with the script's usage(), because its arguments are wrong.
fail_with_usage()
{
  usage >&2
  exit 2
}

need_root()
{
  if ((EUID != 0)); then
    echo "$0: run this as root" >&2
    exit 2
  fi
}

# expect_debian_11 ARGUMENT...: exits if help is asked for, without arguments, and unless this is root in Debian 11.
expect_debian_11()
{
  handle_help "$@"
  (($# > 0)) || fail_with_usage
  need_root
  [[ $(. /etc/os-release && echo "${VERSION_ID-}") == 11 ]] || fail_with_usage
}
