#!/usr/bin/env python3
"""Makes the tables of benchmark/README.md from results.csv, with the figures of Xu & Barbič 2014 for comparison.

usage: tables.py RESULTS.csv [--readme README.md]

Prints all tables; with --readme it replaces those between `<!-- table NAME -->` and `<!-- end -->` in that file. Tables
without results are left unchanged.
"""
import argparse
import re
import sys

import anytime_tables
import contact_tables
import dynamics_tables
import map_tables
import meshes_tables
import monitor_tables
import planning_tables
import precision_tables
import robots_tables
import scenes_tables
import separation_tables
import tunnelling_tables
import world_tables
from results import Results, number

SEGMENT_SYSTEMS = ['paper_uniform', 'paper_octree', 'sdf_ccd', 'sdf_ccd_batch', 'openvdb', 'embree', 'embree16',
                   'bullet', 'cgal']
OURS = ['sdf_ccd', 'sdf_ccd_batch']
EMBREE = ['embree', 'embree16']
# Xu & Barbič 2014. Table 1: seconds (8 threads) and MB of field and octree. Table 2: seconds for 10^6 segments, hence
# microseconds per segment. Tables 3 and 4: points, runs, seconds of all runs by linear traversal and by the tree.
PAPER_BUILD = {128: (1.9, 8.2, 34.2), 256: (6.8, 64.8, 273.6), 512: (45.6, 518.0, 2140.0), 1024: (347.0, 4100.0, 17100.0)}
PAPER_SEGMENT = {128: (12.7, 12.0), 256: (38.8, 13.1), 512: (97.2, 15.4), 1024: (274.3, 21.4)}
PAPER_RANDOM = {'shell800': (1000, 1.8, 0.7), 'shell2k': (1000, 3.4, 0.3), 'shell437k': (1000, 761.2, 9.9)}
PAPER_SIMULATION = {'bunny777': (2600, 8.0, 2.5), 'blob777': (2600, 8.0, 2.5), 'bowl2072': (2000, 20.3, 4.5),
                    'dragon437k': (1160, 671.6, 2.6)}
# Targets of the fields: speed-up over Embree for A first, A all, B1, and B2 from outside; MB.
TARGETS = {'bunny3k/1e-3': (2.5, 2.1, 3.3, 4.0, 2.0), 'bunny3k/1e-4': (1.7, 1.4, 2.9, 3.0, 8.0),
           'bunny75k/1e-3': (3.3, 2.8, 4.5, 6.0, 2.0), 'bunny75k/1e-4': (2.3, 1.9, 3.8, 4.0, 5.0),
           'dragon871k/1e-4': (4.0, 3.0, None, None, None)}


def ratio(slow, fast, target=None):
    if slow is None or fast is None:
        return '-'
    return number(slow / fast, '×') + (' (%s)' % number(target, '×') if target else '')


def table(header, rows):
    if not rows:
        return None
    lines = ['| ' + ' | '.join(header) + ' |', '|' + '---|' * len(header)]
    return '\n'.join(lines + ['| ' + ' | '.join(row) + ' |' for row in rows])


def fields(results, study, depth):
    """The `<mesh>/<field>` of all cases of at least this depth."""
    return list(dict.fromkeys('/'.join(case.split('/')[:2]) for case in results.cases(study)
                              if len(case.split('/')) >= depth))


def paper_segments(results):
    """Table 2: first contacts of A on the bunny."""
    systems = [s for s in SEGMENT_SYSTEMS if s in results.systems('segment')]
    rows = []
    for question in ('first', 'all'):
        for cells, (uniform, octree) in PAPER_SEGMENT.items():
            case = 'bunny3k/%d/A/%s' % (cells, question)
            values = [results.get('segment', case, s, 'ns_per_segment') for s in systems]
            if any(values):
                printed = (number(1e3 * uniform), number(1e3 * octree)) if question == 'first' else ('-', '-')
                rows.append([question, str(cells), *printed, *map(number, values)])
    return table(['A', 'cells', 'printed: uniform', 'printed: octree', *systems], rows)


def against_embree(results):
    """The faster of our single and batched queries against the faster Embree call on the same mesh."""
    columns = ('A/first', 'A/all', 'B1/first', 'B2_outside/first')
    rows = []
    for field in fields(results, 'segment', 4):
        targets = TARGETS.get(field, (None,) * 5)
        cells = []
        for column, target in zip(columns, targets):
            ours, theirs = (results.best('segment', '%s/%s' % (field, column), systems, 'ns_per_segment')
                            for systems in (OURS, EMBREE))
            cells.append('%s / %s: %s' % (number(ours), number(theirs), ratio(theirs, ours, target)))
        size = results.get('segment', field, 'sdf_ccd', 'bytes')
        memory = number(size / 1e6 if size else None) + (' (%s)' % number(targets[4]) if targets[4] else '')
        rows.append([field, *cells, memory])
    return table(['field', 'A first', 'A all', 'B1 first', 'B2 from outside', 'MB'], rows)


def segments(results):
    """Every row of the study."""
    systems = [s for s in SEGMENT_SYSTEMS if s in results.systems('segment')]
    rows = []
    for case in results.cases('segment'):
        if case.count('/') < 3:
            continue
        row = [case]
        for system in systems:
            median, low, high = (results.get('segment', case, system, 'ns_per_segment' + ending)
                                 for ending in ('', '_min', '_max'))
            row.append('-' if median is None else '%s (%s-%s)' % (number(median), number(low), number(high)))
        row.append(' '.join('%s %d' % (s, results.get('segment', case, s, 'crossings')) for s in systems
                            if results.get('segment', case, s, 'crossings') is not None))
        rows.append(row)
    return table(['case', *systems, 'crossings'], rows)


def build(results):
    """Table 1, and errors."""
    rows = []
    threads = next((m for (s, _, _, m) in results.values if s == 'build' and re.fullmatch(r'seconds_\d+_threads', m)), '')
    for case in results.cases('build'):
        for system in results.systems('build', case):
            def get(metric, scale=1.0):
                value = results.get('build', case, system, metric)
                return None if value is None else scale * value
            cells = case.split('/')[1]
            printed = PAPER_BUILD.get(int(cells)) if cells.isdigit() and case.startswith('bunny3k') else None
            rows.append([case, system, number(get('seconds')), number(get(threads)), number(get('bytes', 1e-6)),
                         number(get('peak_bytes', 1e-6)), number(get('load_seconds', 1e3)),
                         *(' / '.join(number(get('error_%s_%s' % (place, q))) for q in ('median', 'p99', 'max'))
                           for place in ('near', 'away')),
                         '%s s, %s + %s MB' % tuple(map(number, printed)) if printed and system == 'sdf_ccd' else ''])
    return table(['field', 'system', 's, 1 thread', threads.replace('seconds', 's').replace('_', ' '), 'MB', 'peak MB',
                  'load ms', 'error near: median / p99 / max', 'away', 'printed: 8 threads, field + octree'], rows)


def shells(results):
    """Table 3."""
    rows = []
    for case in results.cases('shell'):
        shell, motion = case.split('/')
        def get(system, metric='us_per_pair'):
            return results.get('shell', case, system, metric)
        runs, linear, tree = (PAPER_RANDOM if motion == 'random' else {}).get(shell, (0, 0, 0))
        contacts = ', '.join('%s %d' % (s, get(s, 'pairs_in_contact')) for s in ('tree', 'fcl')
                             if get(s, 'pairs_in_contact') is not None)
        rows.append([case, number(get('sdf_ccd', 'points')), number(get('linear')), number(get('tree')),
                     ratio(get('linear'), get('tree')), number(get('fcl')),
                     number(get('tree', 'us_per_pair_all')),
                     contacts + ' ' + results.unit('shell', case, 'tree', 'pairs_in_contact'),
                     '%s / %s: %s' % (number(1e6 * linear / runs), number(1e6 * tree / runs), ratio(linear, tree))
                     if runs else ''])
    return table(['case', 'points', 'linear', 'tree', 'linear / tree', 'fcl', 'tree, all pairs', 'pairs in contact',
                  'printed: linear / tree'], rows)


def drops(results):
    """Table 4."""
    rows = []
    for case in results.cases('drop'):
        def get(system, metric='us_per_step'):
            return results.get('drop', case, system, metric)
        steps, linear, tree = PAPER_SIMULATION[case]
        rows.append([case, number(get('sdf_ccd', 'points')), number(get('linear')), number(get('tree')),
                     ratio(get('linear'), get('tree')), number(get('linear', 'us_per_step_max')),
                     number(get('tree', 'us_per_step_max')), number(get('sdf_ccd', 'contacts')),
                     '%s / %s: %s' % (number(1e6 * linear / steps), number(1e6 * tree / steps), ratio(linear, tree))])
    return table(['case', 'points', 'linear, mean', 'tree, mean', 'linear / tree', 'linear, longest', 'tree, longest',
                  'contact points, all steps', 'printed: linear / tree'], rows)


def scaling(results):
    rows = []
    for case in results.cases('scaling'):
        for system in results.systems('scaling', case):
            for metric, unit in (('ns_per_segment', ' ns'), ('us_per_pair', ' us')):
                value = results.get('scaling', case, system, metric)
                if value is None:
                    continue
                one = results.get('scaling', re.sub(r'threads\d+$', 'threads1', case), system, metric)
                rows.append([case, system, number(value, unit), ratio(one, value) if 'threads' in case else ''])
    return table(['case', 'system', 'median', 'against one thread'], rows)


TABLES = {'paper_segments': paper_segments, 'against_embree': against_embree,
          'segments': segments, 'build': build, 'shells': shells, 'drops': drops, 'scaling': scaling,
          **{name: lambda results, make=make: table(*make(results)) for name, make in
             {**dynamics_tables.TABLES, **precision_tables.TABLES, **robots_tables.TABLES,
              **map_tables.TABLES, **meshes_tables.TABLES, **monitor_tables.TABLES,
              **planning_tables.TABLES, **anytime_tables.TABLES, **separation_tables.TABLES, **contact_tables.TABLES,
              **scenes_tables.TABLES, **tunnelling_tables.TABLES, **world_tables.TABLES}.items()}}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split('\n')[0])
    parser.add_argument('results', help='results.csv')
    parser.add_argument('--readme', help='file whose tables are replaced')
    arguments = parser.parse_args()
    made = {name: make(Results(arguments.results)) for name, make in TABLES.items()}
    made = {name: text for name, text in made.items() if text}
    if not arguments.readme:
        for name, text in made.items():
            print('<!-- table %s -->\n%s\n<!-- end -->\n' % (name, text))
        return
    with open(arguments.readme) as file:
        readme = file.read()
    for name, text in made.items():
        mark = '<!-- table %s -->\n' % name
        if mark not in readme:
            sys.exit('%s: there is no line %s' % (arguments.readme, mark.strip()))
        readme = re.sub(re.escape(mark) + r'.*?<!-- end -->', lambda _: mark + text + '\n<!-- end -->', readme,
                        count=1, flags=re.S)
    with open(arguments.readme, 'w') as file:
        file.write(readme)


if __name__ == '__main__':
    main()
