# SPDX-License-Identifier: GPL-3.0-or-later
# bash completion of breast. The words come from the program itself, which asks its tools for their options: they cannot go stale.
_breast() {
  local IFS=$'\n' word=${COMP_WORDS[COMP_CWORD]} words
  words=$("${COMP_WORDS[0]}" --completions "${COMP_WORDS[@]:1:COMP_CWORD}" 2> /dev/null) || return
  [ "$word" != = ] || word=
  COMPREPLY=($(compgen -W "$words" -- "$word"))
  [[ ${COMPREPLY[0]-} != *= ]] || compopt -o nospace
}
complete -o bashdefault -o default -F _breast breast
