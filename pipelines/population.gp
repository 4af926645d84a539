# SPDX-License-Identifier: GPL-3.0-or-later
# How far tissue moves and how much nearer it comes to the ribs, by its depth, model and women: gnuplot -e "table='judging.tsv'; picture='...'" population.gp (model='...': what it is called). Rows are quantities.
if (!exists('model')) model = 'model, mean and SD over breasts'
set terminal pngcairo size 1000,460 font 'Sans,11'
set output picture
set datafile separator '\t'
set datafile columnheaders
set multiplot layout 1,2
set xrange [-0.5:2.5]
set xtics ('0-20' 0, '20-40' 1, 'above 40' 2)
set xlabel 'distance from the ribs in the scan (mm)'
set grid ytics
set bars 2
at(name, prefix) = name eq prefix.'_0_20_mm' ? 0 : name eq prefix.'_20_40_mm' ? 1 : name eq prefix.'_above_40_mm' ? 2 : NaN
set key top left
set ylabel 'moved from prone to supine (mm)'
set yrange [0:140]
set title 'Motion of tissue'
plot table using (at(strcol('quantity'),'moved')-0.08):'women_mean':'women_sd' with yerrorbars pt 5 lw 2 lc rgb '#888888' title 'women, mean and SD', \
  '' using (at(strcol('quantity'),'moved')+0.08):'mean':'sd' with yerrorbars pt 7 lw 2 lc rgb '#c0392b' title model
set ylabel 'change of the distance from the ribs (mm)'
set yrange [-55:5]
set key bottom left
set title 'Change of its distance from the ribs'
plot table using (at(strcol('quantity'),'change')-0.08):'women_mean':'women_sd' with yerrorbars pt 5 lw 2 lc rgb '#888888' notitle, \
  '' using (at(strcol('quantity'),'change')+0.08):'mean':'sd' with yerrorbars pt 7 lw 2 lc rgb '#c0392b' notitle
