# SPDX-License-Identifier: BSD-3-Clause
# Sourced: a Debian 12 with nothing but its base, to try things in and throw away.

# Makes the folder "$clean", a copy of the base folder $1, which debootstrap makes if it is
# not there. It goes when the script ends. Wants root and the Debian mirror.
make_clean_debian() {
  local base=$1 mirror
  command -v debootstrap >/dev/null || { echo "clean_debian: install debootstrap" >&2; return 1; }
  [ "$(id -u)" -eq 0 ] || { echo "clean_debian: run it as root, for chroot" >&2; return 1; }
  # The mirror is the one that apt takes Debian 12 from.
  mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' \
    'Origin: Debian' 'Codename: bookworm' 'Component: main' | sed -n 1p)
  [ -e "$base/etc/debian_version" ] ||
    debootstrap --variant=minbase bookworm "$base" ${mirror:+"$mirror"}
  clean=$(mktemp -d /tmp/clean-debian.XXXXXX)
  trap 'rm -rf --one-file-system "$clean"' EXIT
  cp -a "$base/." "$clean"
  cp /etc/resolv.conf "$clean/etc/"
  # It is thrown away: no file needs to be on the disk before the next.
  echo force-unsafe-io >"$clean/etc/dpkg/dpkg.cfg.d/unsafe-io"
  inside apt-get update -q >/dev/null
}

# Runs a command in there, with /proc, which Java's packages (of VTK's) want, and /dev; both
# are mounted for the command alone.
inside() {
  env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C DEBIAN_FRONTEND=noninteractive \
    unshare --mount sh -c 'mount -t proc proc "$1/proc" && mount --rbind /dev "$1/dev" &&
      exec chroot "$@"' sh "$clean" "$@"
}
