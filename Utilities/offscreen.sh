#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs a command with a display of its own: offscreen.sh COMMAND...
# ParaView opens and closes the display several times. Without -noreset the server starts afresh
# whenever nobody is connected, and refuses who comes just then.
exec xvfb-run --auto-servernum --server-args="-screen 0 1280x1024x24 -noreset" "$@"
