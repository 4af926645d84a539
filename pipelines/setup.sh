#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs the Debian packages named in pipelines/packages.txt that are missing; where it may not
# install, says which to install and stops.
set -euo pipefail
export LC_ALL=C
list=$(dirname "$0")/packages.txt
missing=()
while read -r package _; do
  case "$package" in ''|'#'*) continue ;; esac
  dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing+=("$package")
done < "$list"
if [ ${#missing[@]} -eq 0 ]; then
  echo "set-up: all packages are installed" >&2
  exit 0
fi
install=(apt-get install -y --no-install-recommends "${missing[@]}")
if [ "$(id -u)" -eq 0 ]; then
  as_root=()
elif command -v sudo >/dev/null && sudo -n true 2>/dev/null; then
  as_root=(sudo -n)
else
  echo "set-up: these Debian packages are missing and this account may not install them. As root:" >&2
  echo "  apt-get update && ${install[*]}" >&2
  exit 1
fi
echo "set-up: installing ${missing[*]}" >&2
export DEBIAN_FRONTEND=noninteractive
"${as_root[@]}" apt-get update -q >&2
"${as_root[@]}" "${install[@]}" >&2
