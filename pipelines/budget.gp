# SPDX-License-Identifier: GPL-3.0-or-later
# What is left of the chain's errors when one stage is replaced by the truth: gnuplot -e "table='...'; picture='...'" budget.gp
# Dashed: the chain as it is; –: the table's column `missing` says why.
set terminal pngcairo size 1200,600 font 'Sans,11'
set output picture
set datafile separator '\t'
set datafile columnheaders
set style data histogram
set style histogram clustered gap 1
set style fill solid 0.8 border -1
set boxwidth 0.9
set grid y
set yrange [0:*]
set offsets 0, 0, 0.1, 0
set ylabel 'mean error at the true places (mm)'
set title 'Error budget: what is left when one stage is replaced by the truth'
set key outside top center horizontal
set xlabel 'replaced by the truth' offset 0,-1.2
set bmargin 5.5
set style textbox opaque noborder margins 0.2,0.1  # values stand clear of the dashed lines
stage(row) = row eq 'chain' ? "nothing\n(the chain)" : row eq 'segmentation' ? "labels\n" : \
  row eq 'body' ? "labels, surfaces\nand mesh" : row eq 'tissue' ? "tissue\non the mesh" : row eq 'cut' ? "support of\nthe cut" : \
  row eq 'discretisation' ? "(finer mesh,\nnot truth)" : row eq 'backward' ? "stress-free\nshape" : \
  row eq 'compression' ? "compressed\nshapes" : row
array name[3] = ['stress_free_mean_mm', 'supine_mean_mm', 'curve_mean_mm']
array title_of[3] = ['stress-free', 'supine', 'MLO place to curve']
array colour[3] = [0x4c78a8, 0xf58518, 0x54a24b]
missing(k) = strcol(name[k]) eq ''
height(k) = missing(k) ? 0 : real(strcol(name[k]))
array chain[3]
do for [k=1:3] {
  stats table using (height(k)) every ::0::0 nooutput
  chain[k] = STATS_max
}
plot for [k=1:3] table using (height(k)):xtic(stage(strcol('replaced'))) title title_of[k] lc rgb colour[k], \
  for [k=1:3] chain[k] with lines dashtype 2 lw 1.5 lc rgb colour[k] notitle, \
  for [k=1:3] table using ($0 + 0.25 * (k - 2)):(height(k)):(missing(k) ? '–' : sprintf('%.2f', height(k))) \
    with labels boxed offset 0,0.6 font ',9' notitle
