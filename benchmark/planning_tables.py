"""Table of the study `planning`."""


def edges(results):
    """Time per edge of each system, the edges with contact that it misses, and those without that it reports."""
    rows = []
    for case in results.cases('planning'):
        for system in results.systems('planning', case):
            time = results.get('planning', case, system, 'us_edge')
            if time is None:
                continue
            counts = [results.get('planning', case, system, kind) for kind in ('misses', 'false_contacts')]
            rows.append([case, system, '%.3g' % time, *('-' if count is None else '%d' % count for count in counts)])
    return ['case', 'system', 'us an edge', 'missed', 'false contact'], rows


TABLES = {'planning_edges': edges}
