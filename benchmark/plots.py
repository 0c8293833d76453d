#!/usr/bin/env python3
"""Draws results.csv with gnuplot.

usage: plots.py RESULTS.csv DIRECTORY

Writes segment_cells.svg, segment_meshes.svg, shell.svg, scaling_points.svg, bound_uncertain.svg,
bound_uncertain_cells.svg, anytime.svg, anytime_bound.svg and stability.svg, each only if the results hold its data.
"""
import os
import re
import subprocess
import sys

from results import Results

HEAD = """set encoding utf8
set terminal svg size 760,460 font 'sans,13' background '#ffffff'
set output '%(file)s'
set title '%(title)s'
set xlabel '%(x)s'
set ylabel '%(y)s'
set logscale %(log)s
set grid
set key outside right
"""


def draw(file, title, axes, lines, log='xy'):
    """Draws a plot of lines {name: [(x, low, median, high), …]}, with the spread as bars. log: the logarithmic axes."""
    lines = {name: sorted(points) for name, points in lines.items() if points}
    if not lines:
        return
    script = HEAD % {'file': file.replace("'", "''"), 'title': title, 'x': axes[0], 'y': axes[1], 'log': log}
    for i, points in enumerate(lines.values()):
        script += '$d%d << EOD\n%s\nEOD\n' % (i, '\n'.join('%g %g %g %g' % (x, m, l, h) for x, l, m, h in points))
    script += 'plot ' + ', '.join("$d%d using 1:2:3:4 with yerrorlines linewidth 1.5 title '%s' noenhanced" % (i, name)
                                  for i, name in enumerate(lines)) + '\n'
    subprocess.run(['gnuplot'], input=script, text=True, check=True)
    print(file)


def point(results, key, metric, x):
    """A list of one point (x, low, median, high), with its spread if that was measured; empty without data."""
    low, median, high = (results.get(*key, metric + ending) for ending in ('_min', '', '_max'))
    return [] if median is None else [(x, median if low is None else low, median, median if high is None else high)]


def lines(results, study, pattern, metric):
    """For each system, a point per case that matches the pattern, whose group is x."""
    found = {}
    for case in results.cases(study):
        match = re.fullmatch(pattern, case)
        for system in results.systems(study, case) if match else []:
            found.setdefault(system, []).extend(point(results, (study, case, system), metric, float(match.group(1))))
    return found


def main():
    if len(sys.argv) != 3:
        sys.exit('usage: plots.py RESULTS.csv DIRECTORY')
    results, directory = Results(sys.argv[1]), sys.argv[2]

    def path(name):
        return os.path.join(directory, name)

    draw(path('segment_cells.svg'), 'Random segments through the bunny (A), first contact',
         ('cells along the longest side', 'ns per segment'),
         lines(results, 'segment', r'bunny3k/(\d+)/A/first', 'ns_per_segment'))
    triangles = {'bunny3k': 3674, 'bunny75k': 75408, 'dragon871k': 871414}
    meshes = {}
    for case in results.cases('segment'):
        match = re.fullmatch(r'(\w+)/1e-3/A/first', case)
        if match and match.group(1) in triangles:
            for system in results.systems('segment', case):
                meshes.setdefault(system, []).extend(
                    point(results, ('segment', case, system), 'ns_per_segment', triangles[match.group(1)]))
    draw(path('segment_meshes.svg'), 'Random segments (A), first contact, fields to 1e-3 of the side',
         ('triangles', 'ns per segment'), meshes)
    shells = {}
    for case in results.cases('shell'):
        shell, motion = case.split('/')
        points = results.get('shell', case, 'sdf_ccd', 'points')
        for system in results.systems('shell', case):
            if points and motion in ('random', 'small'):
                shells.setdefault('%s, %s' % (system, motion), []).extend(
                    point(results, ('shell', case, system), 'us_per_pair', points))
    draw(path('shell.svg'), 'Moving shells', ('points', 'us per pose pair'), shells)
    scaling = {}
    for motion in ('random', 'small'):
        for system, points in lines(results, 'scaling', r'\w+/points(\d+)/' + motion, 'us_per_pair').items():
            scaling['%s, %s' % (system, motion)] = points
    draw(path('scaling_points.svg'), 'Shells over their points', ('points', 'us per pose pair'), scaling)
    for name, metric, label in (('bound_uncertain.svg', 'error_bound', 'error bound of the verdict, box sides'),
                                ('bound_uncertain_cells.svg', 'cell', 'cells at the surface, box sides')):
        uncertain = {}
        for case in results.cases('bound'):
            if '/verdict/' in case:
                mesh, _, field = case.split('/')
                x, share = (results.get('bound', case, 'sdf_ccd', m) for m in (metric, 'uncertain_share'))
                kind = 'uniform cells' if field.isdigit() else 'max_error'
                uncertain.setdefault('%s, %s' % (mesh, kind), []).append((x, share, share, share))
        draw(path(name), 'Moving pairs that stay UNCERTAIN', (label, 'share of motions'), uncertain)
    for name, metric, least, label in (
            ('anytime.svg', 'open_share', 0.0, 'share of verdicts left UNCERTAIN'),
            ('anytime_bound.svg', 'bound_p99', 1e-4, 'error bound of 99 % of the cycles, mm (0.0001 or less)')):
        budgets = {}
        for case in results.cases('anytime'):
            robot, budget = case.rsplit('/', 1)
            value = results.get('anytime', case, 'sdf_ccd', metric)
            if value and budget != 'none':
                value = max(value, least)
                budgets.setdefault(robot, []).append((float(budget), value, value, value))
        draw(path(name), 'Cycles of the monitor with a budget, 1 kHz', ('budget of a cycle, us', label), budgets)
    names = {'closed_form_continuous': 's/4 < ζ < 1/s (closed form)', 'continuous': 'continuous (of the paper), measured',
             'closed_form_discrete': 's² + 4ζs < 4 (closed form)', 'discrete': 'discrete, measured',
             'implicit': 'implicit (ours), measured: 10⁴ is the largest tried'}
    found = lines(results, 'stability', r'zeta=([\d.]+)', 's_max')
    draw(path('stability.svg'), 'A contact that persists: largest stable step over the damping ratio',
         ('damping ratio ζ', 'largest stable step s = ωΔt'),
         {name: found.get(system, []) for system, name in names.items()}, log='y')


if __name__ == '__main__':
    main()
