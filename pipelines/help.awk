# SPDX-License-Identifier: GPL-3.0-or-later
# `make help`: what goals.tsv and settings.tsv say of themselves, with the plain defaults of the makefiles that are read between the two.
BEGIN { FS = "\t" }
function folded(name, text, most,    words, count, k, line, lines) {
  count = split(text, words, " ")
  for (k = 1; k <= count; k++) {
    if (line != "" && length(line " " words[k]) > most) {
      lines = lines sprintf("%-25s %s\n", name, line)
      line = name = ""
    }
    line = line (line == "" ? "" : " ") words[k]
  }
  return lines sprintf("%-25s %-" most "s", name, line)
}
/^#/ || FNR == 1 || $3 == "source" && installed || $2 ~ /source/ && installed || $NF == "-" { next }
FILENAME ~ /goals.tsv$/ && $1 != "goal" {
  targets[$2 ~ /source/] = targets[$2 ~ /source/] folded("  " $1, $4, 84) " " ($3 == "-" ? "" : $3) "\n"
}
FILENAME ~ /[.]mk$/ && /^[A-Z0-9_]+ [?]= [^\\]*$/ {
  split($0, said, " [?]= ([$][(]BIN[)]/)?")
  if (said[2] !~ /[$]/) plain[said[1]] = said[2]
}
FILENAME ~ /settings.tsv$/ && $1 != "setting" {
  usual = $7 == "-" ? plain[$1] : $7
  settings = settings folded("  " $1 "=" $6, $8 (usual == "" ? "" : " (default: " usual ")"), 104) "\n"
}
END {
  print installed ? "breast run SCAN [--side left|right] [--target TARGET] [SETTING=VALUE]...\n" \
    "breast demo [--target TARGET] [SETTING=VALUE]..." : "make -f Makefile.pipeline [TARGET] [SETTING=VALUE]..."
  print "\n" folded("targets", "", 84) " minutes on 2 cores\n" targets[0]
  if (targets[1] != "") print "targets that need the source tree\n" targets[1]
  print "settings\n" settings
  print folded("files of a case", "RUN/{labels,geometry,mesh,reference,supine,cc,mlo}.vtkhdf, {cc,mlo}.{vti,png}, curve.vtp, curve.tsv (of a " \
    "tumour), lookup.h5, page.html (but with PAPER=1), a .json report for each, figures/, contours.png (of the segmentation), summary.txt", 104)
  print "unknown settings, values and names with characters that a shell reads as code are refused before anything runs"
}
