# SPDX-License-Identifier: GPL-3.0-or-later
# Sourced: prints the steps of scripts.

# step TITLE COMMAND...: prints the title, runs the command, and prints its seconds.
step()
{
  local title=$1 start=$SECONDS
  shift
  echo "== $title"
  "$@"
  echo "== $title: $((SECONDS - start)) s"
}
