#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs a command with its own virtual display: offscreen.sh COMMAND...
# ParaView connects several times. Without -noreset the server resets when its last client disconnects, and
# refuses connections meanwhile.
if (($# == 0)) || [[ $1 == --help ]]; then
  echo "usage: $0 COMMAND..."
  echo "Runs a command with a virtual display of its own."
  exit $(($# == 0 ? 2 : 0))
fi
exec xvfb-run --auto-servernum --server-args="-screen 0 1280x1024x24 -noreset" "$@"
