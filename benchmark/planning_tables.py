"""Table of the study `planning`."""


def edges(results):
    """Time per edge of each system, and the edges with contact that it misses."""
    rows = []
    for case in results.cases('planning'):
        for system in results.systems('planning', case):
            time = results.get('planning', case, system, 'us_edge')
            if time is None:
                continue
            misses = results.get('planning', case, system, 'misses')
            rows.append([case, system, '%.3g' % time, '-' if misses is None else '%d' % misses])
    return ['case', 'system', 'us an edge', 'missed'], rows


TABLES = {'planning_edges': edges}
