#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# setup.sh WHAT: installs the Debian packages that are missing of those that pipelines/packages.txt marks with run or WHAT; where it
# may not install, says which to install and stops.
set -euo pipefail
export LC_ALL=C
list=$(dirname "$0")/packages.txt
what=$1
missing=()
while read -r package mark _; do
  [ "$mark" = run ] || [ "$mark" = "$what" ] || continue
  dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing+=("$package")
done < "$list"
if [ ${#missing[@]} -eq 0 ]; then
  echo "set-up: all packages for $what are installed" >&2
  exit 0
fi
# A fresh machine often installs something itself at first: its lock is waited for.
apt=(apt-get -o DPkg::Lock::Timeout=300)
install=("${apt[@]}" install -y --no-install-recommends "${missing[@]}")
if [ "$(id -u)" -eq 0 ]; then
  as_root=()
elif command -v sudo >/dev/null && sudo -n true 2>/dev/null; then
  as_root=(sudo -n)
else
  echo "set-up: these Debian packages are missing and this account may not install them. As root:" >&2
  echo "  ${apt[*]} update && ${install[*]}" >&2
  exit 1
fi
echo "set-up: installing ${missing[*]}" >&2
export DEBIAN_FRONTEND=noninteractive
"${as_root[@]}" "${apt[@]}" update -q >&2
"${as_root[@]}" "${install[@]}" >&2
