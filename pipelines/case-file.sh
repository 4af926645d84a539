#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A case file as data: KEY = VALUE a line, # a comment. case-file.sh FILE KEY...
# Prints a word KEY=VALUE a line for make, blanks in VALUE as the byte 0x1f, or one word !MESSAGE (blanks likewise) when a key
# is none of KEY..., comes twice, or a value holds what make or a shell would read as code. Nothing of it is executed.
# Files named *.mk are makefiles of version 0.1: := and ?= are read as =, with a warning; anything else in them is refused.
set -euo pipefail
export LC_ALL=C
file=$1
shift
here=$(dirname "$0")
one_word() { tr ' \t\n' '\037\037\037'; }
refuse() { printf '!%s' "$1" | one_word; exit 0; }
[ -f "$file" ] && [ -r "$file" ] || refuse "case file $file: is not a file that can be read"
[ "$(head -c 65537 "$file" | wc -c)" -le 65536 ] || refuse "case file $file: is larger than 64 kB"
declare -A seen=()
number=0
old=
while IFS= read -r line || [ -n "$line" ]; do
  number=$((number + 1))
  at="case file $file, line $number"
  line=${line%$'\r'}
  [[ $line =~ ^[[:space:]]*(#.*)?$ ]] && continue
  [[ $line =~ ^[[:space:]]*([A-Za-z_]+)[[:space:]]*(:=|\?=|=)[[:space:]]*(.*)$ ]] ||
    refuse "$at: is not KEY = VALUE (a case file is data; nothing in it is executed)"
  key=${BASH_REMATCH[1]} how=${BASH_REMATCH[2]} value=${BASH_REMATCH[3]}
  value=${value%%[[:space:]]#*}
  value=${value%"${value##*[![:space:]]}"}
  [ "$how" = = ] || old=yes
  case " $* " in
    *" $key "*) ;;
    *) refuse "$at: $key is no setting of a case$("$here/suggest.sh" "$key" "$@")" ;;
  esac
  [ -z "${seen[$key]:-}" ] || refuse "$at: $key stands there twice"
  seen[$key]=yes
  [[ $value != *[\$\`\;\&\|\<\>\(\)\{\}\[\]\*\?\!\"\'\\^\#]* ]] ||
    refuse "$at: $key holds a character that make or a shell would read as code; give a name without it, or a link of such a name"
  [[ $value != *[[:cntrl:]]* ]] || refuse "$at: $key holds a control character"
  printf '%s=%s\n' "$key" "$(printf '%s' "$value" | one_word)"
done < "$file"
case "$file" in
  *.mk) [ -z "$old" ] || echo "warning: $file: := and ?= will not be read by the next version; write KEY = VALUE" >&2 ;;
  *) [ -z "$old" ] || refuse "case file $file: := and ?= are of makefiles; write KEY = VALUE" ;;
esac
