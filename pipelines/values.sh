# SPDX-License-Identifier: GPL-3.0-or-later
# Values out of what the programs write; the scripts beside this one source it.
export LC_ALL=C  # decimal points, whatever the user's language

# A top-level key (two spaces of indent) of a report: key FILE NAME. Nothing, and false, without the report.
key() { [ -s "$1" ] && sed -n "s/^  \"$2\": \"\{0,1\}\(.*[^\",]\)\"\{0,1\},\{0,1\}$/\1/p" "$1" | sed -n 1p; }

# The first number of that name in a report, at any depth: number FILE NAME. Nothing without the report.
number() { [ ! -s "$1" ] || sed -n "s/^ *\"$2\": \([-+0-9.e]*\),\{0,1\}$/\1/p" "$1" | sed -n 1p; }

# Why a solve ended without a result: its report's sentence, or its typed reason where it has none. why FILE
why() { local sentence; sentence=$(key "$1" explanation); if [ -n "$sentence" ]; then echo "$sentence"; else key "$1" reason; fi; }

# A number printed with so many digits, "-" where there is none: rounded DIGITS NUMBER
rounded() { [ -n "$2" ] && printf "%.$1f" "$2" || printf -- '-'; }

# A cell of a table (TSV): cell FILE ROW COLUMN, by the value of the first column and the column's name; the tumour's are also
# found where it is an artificial one.
cell() {
  awk -F'\t' -v row="$2" -v column="$3" '
    /^#/ { next }
    !header { header = 1; for (i = 1; i <= NF; i++) if ($i == column || $i == "artificial_" column) at = i; next }
    at && $1 == row && !found { print $at; found = 1 }' "$1"
}

# Where a mesh's tumour comes from, as hexmesh reports it, in a word: none, artificial or given. tumour_origin MESH_JSON
tumour_origin() {
  case "$(key "$1" tumour)" in '') echo none ;; artificial*) echo artificial ;; *) echo given ;; esac
}

# Largest distance (mm) of a landmark, nipple or tumour, between two shapes: apart PROBE FILE BASE
apart() {
  "$1" "$2" --base "$3" --quiet |
    awk -F'\t' '/^#/ { next } $1 == "file" { for (i = 1; i <= NF; i++) if ($i ~ /_relative_mm$/) at[i]; next }
      { for (i in at) if ($i > most) most = $i; printf "%.4f", most }'
}

# What two solves one after the other say of the second's shape: its stress-free shape has an error of its own, which
# it carries along. carried_estimate BACKWARD_JSON FORWARD_JSON, mm; nothing when either is not estimated.
carried_estimate() {
  awk -v a="$(number "$1" error_estimate_mm)" -v b="$(number "$2" error_estimate_mm)" \
    'BEGIN { if (a != "" && b != "") print a + b }'
}
