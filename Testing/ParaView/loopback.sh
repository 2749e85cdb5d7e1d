#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs a command where there is no network but the loopback, so that the servers it starts are seen
# by nobody else: loopback.sh COMMAND... Exits with 77 where the system does not allow that.
set -euo pipefail

options=(--net)
if ((EUID != 0)); then
  options+=(--map-root-user)
fi
unshare "${options[@]}" true || exit 77
exec unshare "${options[@]}" python3 - "$@" << 'END'
import fcntl
import os
import socket
import struct
import sys

SIOCGIFFLAGS, SIOCSIFFLAGS, IFF_UP = 0x8913, 0x8914, 1
with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as control:
    request = fcntl.ioctl(control, SIOCGIFFLAGS, struct.pack("16sH14x", b"lo", 0))
    flags = struct.unpack("16sH14x", request)[1] | IFF_UP
    fcntl.ioctl(control, SIOCSIFFLAGS, struct.pack("16sH14x", b"lo", flags))
os.execvp(sys.argv[1], sys.argv[1:])
END
