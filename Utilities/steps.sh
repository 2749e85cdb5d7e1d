# SPDX-License-Identifier: GPL-3.0-or-later
# Sourced: what scripts say of their steps.

# step TITLE COMMAND...: runs a command between its title and the seconds that it took.
step()
{
  local title=$1 start=$SECONDS
  shift
  echo "== $title"
  "$@"
  echo "== $title: $((SECONDS - start)) s"
}
