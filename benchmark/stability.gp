# Stability chart from a results.csv: gnuplot -e "csv='DIR/results.csv'; svg='DIR/stability.svg'" stability.gp
set terminal svg size 820,520 font 'sans,13' background 'white'
set output svg
set datafile separator ','
set xlabel 'damping ratio {/Symbol z}'
set ylabel 'largest stable step s = {/Symbol w}{/Symbol D}t'
set logscale y
set yrange [0.1:3e4]
set xrange [0:1.02]
set key at graph 0.98,0.80 right top
set title 'A contact that persists: largest stable step over the damping ratio'
rows(system) = "< awk -F, -v s='".system."' '$1 == \"stability\" && $2 ~ /^zeta=/ && $3 == s { sub(/zeta=/, \"\", $2); print $2 \",\" $5 }' ".csv
plot rows('closed_form_continuous') with lines lw 2 lc rgb '#4c72b0' title 's/4 < {/Symbol z} < 1/s (closed form)', \
     rows('continuous') with points pt 7 ps 0.7 lc rgb '#4c72b0' title 'continuous (the paper''s), measured', \
     rows('closed_form_discrete') with lines lw 2 lc rgb '#dd8452' title 's^2 + 4{/Symbol z}s < 4 (closed form)', \
     rows('discrete') with points pt 5 ps 0.7 lc rgb '#dd8452' title 'discrete, measured', \
     rows('implicit') with points pt 9 ps 0.9 lc rgb '#55a868' title 'implicit (ours), measured: 10^4 is the largest tried'
