# What is left of the chain's errors when one stage is replaced by the truth: gnuplot -e "table='...'; picture='...'" budget.gp
set terminal pngcairo size 1000,560 font 'Sans,11'
set output picture
set datafile separator '\t'
set datafile columnheaders
set datafile missing '-'
set style data histogram
set style histogram clustered gap 1
set style fill solid 0.8 border -1
set boxwidth 0.9
set grid y
set yrange [0:*]
set ylabel 'mean error (mm)'
set xlabel 'stage replaced by the truth (chain: none)'
set title 'Error budget: what is left of the error when one stage is replaced by the truth'
set key top right
plot table using 'stress_free_mean_mm':xtic(1) title 'stress-free' lc rgb '#4c78a8', \
  '' using 'supine_mean_mm' title 'supine' lc rgb '#f58518', \
  '' using 'curve_mean_mm' title 'MLO curve' lc rgb '#54a24b'
