# Stability chart from a results.csv: csv=DIR/results.csv svg=DIR/stability.svg gnuplot stability.gp
# (in the environment, so that any path will do)
set encoding utf8
set terminal svg size 820,520 font 'sans,13' background 'white'
set output system('printf %s "$svg"')
set datafile separator ','
set xlabel 'damping ratio ζ'
set ylabel 'largest stable step s = ωΔt'
set logscale y
set yrange [0.1:3e4]
set xrange [0:1.02]
set key at graph 0.98,0.80 right top
set title 'A contact that persists: largest stable step over the damping ratio'
rows(scheme) = "< awk -F, -v s='".scheme."' '$1 == \"stability\" && $2 ~ /^zeta=/ && $3 == s { sub(/zeta=/, \"\", $2); print $2 \",\" $5 }' < \"$csv\""
plot rows('closed_form_continuous') with lines lw 2 lc rgb '#4c72b0' title 's/4 < ζ < 1/s (closed form)', \
     rows('continuous') with points pt 7 ps 0.7 lc rgb '#4c72b0' title 'continuous (the paper''s), measured', \
     rows('closed_form_discrete') with lines lw 2 lc rgb '#dd8452' title 's^2 + 4ζs < 4 (closed form)', \
     rows('discrete') with points pt 5 ps 0.7 lc rgb '#dd8452' title 'discrete, measured', \
     rows('implicit') with points pt 9 ps 0.9 lc rgb '#55a868' title 'implicit (ours), measured: 10^4 is the largest tried'
