"""Table of the study `planning`."""


def edges(results):
    """Time per edge, edges with contact that are missed, those without that are reported, and what is left open."""
    rows = []
    for case in results.cases('planning'):
        for system in results.systems('planning', case):
            time = results.get('planning', case, system, 'us_edge')
            if time is None:
                continue
            counts = [results.get('planning', case, system, kind) for kind in ('misses', 'false_contacts', 'uncertain')]
            bound = results.get('planning', case, system, 'bound')
            rows.append([case, system, '%.3g' % time, *('-' if count is None else '%d' % count for count in counts),
                         '-' if bound is None else '%.3g' % bound])
    return ['case', 'system', 'us an edge', 'missed', 'false contact', 'UNCERTAIN', 'bound, mm'], rows


TABLES = {'planning_edges': edges}
