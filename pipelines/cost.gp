# SPDX-License-Identifier: GPL-3.0-or-later
# Error against run time of the table of tabulate cost: gnuplot -e "table='...'; picture='...'" cost.gp
set terminal pngcairo size 900,640 font 'Sans,11'
set output picture
set datafile separator '\t'
set datafile columnheaders
set logscale xy
set xlabel 'CPU time of backward and forward (s)'
set ylabel 'error of tumour or nipple, supine (mm)'
set title 'Error against run time: distance to the finest solution'
set grid
set key outside right
kind(element, template, solver, e, t, s) = (strcol(element) eq e && strcol(template) eq t && (strcol(solver) eq 'direct') == s) ? 1 : NaN
plot table using (kind('element','template','solver','q1p0','dome',0)*column('cpu_s')):'supine_error_mm' with linespoints pt 7 title 'Q1/P0 dome', \
  '' using (kind('element','template','solver','q2p1','dome',0)*column('cpu_s')):'supine_error_mm' with linespoints pt 5 title 'Q2/P1 dome', \
  '' using (kind('element','template','solver','q1p0','cuboid',0)*column('cpu_s')):'supine_error_mm' with linespoints pt 9 title 'Q1/P0 cuboid', \
  '' using (kind('element','template','solver','q1p0','dome',1)*column('cpu_s')):'supine_error_mm' with linespoints pt 11 title 'Q1/P0 dome, direct solver'
