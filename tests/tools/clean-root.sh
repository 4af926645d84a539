#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# clean-root.sh PACKAGE.deb [SETTING=value]...: the proof that the package is complete. Makes an empty Debian 12 (debootstrap), installs
# the package there with apt-get, and runs `breast demo` as an ordinary user from a folder with a blank in its name; then checks what
# a user sees. Needs root, debootstrap and network; takes about 2 GB below TMPDIR. BASE=FOLDER: such a root made before, which is
# copied instead of downloaded anew. KEEP=1 leaves the root in place. Settings are the demonstration's.
set -eu
package=$(realpath "$1")
shift
[ "$(id -u)" -eq 0 ] || { echo "clean-root.sh: needs root (debootstrap and chroot)" >&2; exit 2; }
command -v debootstrap > /dev/null || { echo "clean-root.sh: needs debootstrap: apt-get install debootstrap" >&2; exit 2; }
work=$(mktemp -d "${TMPDIR:-/tmp}/clean-root.XXXXXX")
root=$work/root
clean() {
  umount "$root/dev/null" "$root/dev/urandom" "$root/proc" 2> /dev/null || true
  [ -n "${KEEP:-}" ] || rm -rf --one-file-system "$work"
}
trap clean EXIT
trap 'exit 1' INT TERM
fail() { echo "FAILED: $*"; exit 1; }
seconds() { date +%s; }

start=$(seconds)
if [ -n "${BASE:-}" ]; then
  cp -a "$BASE" "$root"
else
  debootstrap --variant=minbase bookworm "$root" http://deb.debian.org/debian > "$work/debootstrap.log" 2>&1 ||
    { tail -n 20 "$work/debootstrap.log"; fail "debootstrap"; }
fi
[ ! -f /etc/resolv.conf ] || cp -L /etc/resolv.conf "$root/etc/resolv.conf"
mount -t proc proc "$root/proc"
# Devices of debootstrap may be out of reach (a file system mounted without them): those of this machine stand in.
for device in null urandom; do
  [ -e "$root/dev/$device" ] || touch "$root/dev/$device"
  mount --bind "/dev/$device" "$root/dev/$device"
done
echo "ok: an empty Debian 12, $(du -smx "$root" | cut -f1) MB, $(($(seconds) - start)) s"

start=$(seconds)
cp "$package" "$root/tmp/"
inside() { chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 DEBIAN_FRONTEND=noninteractive "$@"; }
inside apt-get update -q > "$work/apt.log" 2>&1 || { tail -n 20 "$work/apt.log"; fail "apt-get update"; }
inside sh -c 'cd /tmp && apt-get install -y --no-install-recommends ./'"$(basename "$package")" >> "$work/apt.log" 2>&1 ||
  { tail -n 20 "$work/apt.log"; fail "apt-get install"; }
echo "ok: apt-get install ./$(basename "$package"), $(inside dpkg-query -f '${Package}\n' -W | wc -l) packages, $(du -smx "$root" | cut -f1) MB, $(($(seconds) - start)) s"

# An ordinary user, in a folder whose name has a blank.
inside useradd -m -s /bin/sh user
folder="/home/user/my breasts"
user() { chroot --userspec=user:user "$root" env -i PATH=/usr/bin:/bin HOME=/home/user LANG=C.UTF-8 sh -c "cd '$folder' && $*"; }
inside install -d -o user -g user "$folder"
user 'breast --version && breast list' > "$work/list" || { cat "$work/list"; fail "breast list"; }
[ "$(wc -l < "$work/list")" -gt 20 ] || fail "breast list names the tools"
user 'breast help compress' | grep -q '^Usage: breast compress' || fail "breast help compress"
! user 'breast compres' 2> "$work/err" || fail "an unknown command is refused"
grep -q "did you mean 'compress'" "$work/err" && [ "$(wc -l < "$work/err")" -eq 1 ] || { cat "$work/err"; fail "in one line, with the nearest name"; }
echo "ok: breast --version, list, help; an unknown command"

start=$(seconds)
user "breast demo $*" > "$work/demo.out" 2> "$work/demo.err" || { tail -n 5 "$work/demo.out"; tail -n 20 "$work/demo.err"; fail "breast demo"; }
echo "ok: breast demo $*, as an ordinary user in '$folder', $(($(seconds) - start)) s"
run=$root$folder/$(sed -n 's/^Results: //p' "$work/demo.out")
grep -q 'Landmark displacements' "$work/demo.out" || { cat "$work/demo.out"; fail "the demonstration ends with its table"; }
for file in summary.txt figures/summary.png supine.vtkhdf cc.png mlo.png; do
  [ -s "$run/$file" ] || fail "the run has $file"
done
sed -n '/Landmark displacements/,/^$/p' "$work/demo.out"
du -sh "$run" | cut -f1 | sed 's/^/the run: /'

start=$(seconds)
user 'cp runs/phantom/*.nrrd "a scan (1).nrrd" && breast run "a scan (1).nrrd" --side left --dry-run' > "$work/plan" || { cat "$work/plan"; fail "a scan of a strange name"; }
grep -q 'libexec/breast/segment' "$work/plan" || fail "is planned with the installed tools"
! user 'breast run "a scan (1).nrrd" --side left --target check' 2> "$work/err" || fail "a target of the source tree is refused"
[ "$(wc -l < "$work/err")" -eq 1 ] || { cat "$work/err"; fail "in one line"; }
user 'breast demo '"$*"' --dry-run' | grep -q 'libexec' && fail "a second demonstration has nothing to do"
echo "ok: a scan of a strange name; what needs the source tree; a second run does nothing"
echo "the package installs and runs"
