# Sourced by tests/bare and tests/packages: a bare Debian 12 (debootstrap's minbase) in a folder of its own. Needs root; packages come from
# where this machine gets its own. The folder stays for a closer look.

# make_bare_root FOLDER: sets `root`.
make_bare_root() {
  local me
  me=tests/$(basename "$0")
  ((EUID == 0)) || { echo "$me: run as root" >&2; exit 2; }
  command -v debootstrap >/dev/null || { echo "$me: install debootstrap" >&2; exit 2; }
  [[ ! -e $1 ]] || { echo "$me: $1 exists; name a new folder" >&2; exit 2; }

  local mirror
  mirror=$(apt-get indextargets --format '$(SITE)' 'Created-By: Packages' | head -n 1)
  root=$(realpath -m "$1")
  debootstrap --variant=minbase bookworm "$root" "$mirror" >"$root.log" 2>&1 || { tail -n 20 "$root.log" >&2; exit 1; }
  cp -a /etc/apt/apt.conf.d/. "$root/etc/apt/apt.conf.d/"  # a proxy, if this machine has one
  cp /etc/resolv.conf "$root/etc/resolv.conf"
}

# inside COMMAND: runs it in that system, in a mount namespace, so that nothing stays mounted whatever happens.
inside() {
  unshare --mount --pid --fork --mount-proc="$root/proc" bash -c '
    set -e
    mount --rbind "$0" "$0"  # a root of its own: unshare in it wants to change how its mounts spread
    cd "$0"
    mount -t devtmpfs devtmpfs "$0/dev" 2>/dev/null || mount --rbind /dev "$0/dev"
    mkdir -p "$0/dev/pts" "$0/dev/shm"
    mount -t devpts -o newinstance,ptmxmode=0666 devpts "$0/dev/pts"
    mount -t tmpfs tmpfs "$0/dev/shm"
    exec env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 chroot "$0" bash -c "$1"
  ' "$root" "$1"
}
