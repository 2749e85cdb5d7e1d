# SPDX-License-Identifier: GPL-3.0-or-later
# Sourced: bare roots of Debian releases, made by debootstrap.

# make_root RELEASE ROOT: makes a root unless it exists; logs to ROOT.log.
make_root()
{
  if [[ ! -d $2 ]]; then
    mkdir -p "$(dirname "$2")"
    debootstrap --variant=minbase "$1" "$2.part" > "$2.log" 2>&1
    mv "$2.part" "$2"
  fi
  cp /etc/resolv.conf "$2/etc/"
  # sid's release files expire within a week, and mirrors may lag behind.
  echo 'Acquire::Check-Valid-Until "false";' > "$2/etc/apt/apt.conf.d/check-valid-until"
}

# run_in_root ROOT COMMAND: runs it with /proc, /sys and /dev, which are unmounted at the end.
run_in_root()
{
  unshare --mount bash -c '
    mount -t proc proc "$0/proc" && mount --rbind /sys "$0/sys" && mount --rbind /dev "$0/dev" &&
      exec chroot "$0" env -i HOME=/root LANG=C.UTF-8 PATH=/usr/sbin:/usr/bin:/sbin:/bin \
        bash -c "$1"' "$1" "$2"
}
