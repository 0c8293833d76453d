#!/bin/sh
# Runs the study `bound` on generated shapes and fails if an error bound is violated.
# usage: check_bound.sh BOUND_BENCHMARK
rows=$("$1" --quick) || exit 1
echo "$rows" | awk -F, '$4 == "violations" { n += $5; cases++ } $4 == "violations" && $5 > 0 { print }
  END { printf "%d violations in %d cases\n", n, cases; exit !(cases > 0 && n == 0) }'
