# A Debian in a folder of its own, which is entered by chroot. Sourced behind lib.sh.
[ "$(id -u)" -eq 0 ] || die "$0 enters a folder as its root: only root can do that"
need debootstrap
# inside SYSTEM COMMAND...: as its root.
inside() { chroot "$1" env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin DEBIAN_FRONTEND=noninteractive "${@:2}"; }
# unpack SUITE SYSTEM: the smallest system of a release that apt works in, anew. Debian has no keys of Ubuntu's archive.
unpack() {
  local log=$2.log keys=() mirror=()
  case $1 in bionic | jammy) keys=(--no-check-gpg) mirror=(http://archive.ubuntu.com/ubuntu) ;; esac
  leave "$2"
  rm -rf --one-file-system "$2"
  mkdir -p "$2"
  debootstrap --variant=minbase "${keys[@]}" "$1" "$2" "${mirror[@]}" >"$log" 2>&1 || die "Could not unpack $1 (log: $log)"
  cp /etc/hosts /etc/resolv.conf "$2/etc/"
}
# copy_tree SYSTEM: the tree as it is here, as /rainref; what was built there is kept.
copy_tree() {
  mkdir -p "$1/rainref"
  find "$1/rainref" -mindepth 1 -maxdepth 1 ! -name build -exec rm -rf {} +
  git ls-files -z --cached --others --exclude-standard | tar -c --null --files-from=- | tar -x -C "$1/rainref"
}
# enter SYSTEM: what programs there find of the kernel, until leave or the end of the script.
entered=()
enter() {
  mountpoint -q "$1/proc" || mount -t proc proc "$1/proc"
  entered+=("$1")
}
leave() { if mountpoint -q "$1/proc"; then umount "$1/proc"; fi; }
trap 'for system in "${entered[@]}"; do leave "$system"; done' EXIT
