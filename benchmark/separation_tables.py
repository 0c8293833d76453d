"""Tables of the study `separation`."""
from results import number

SYSTEMS = ['separation', 'separation_again', 'fcl_collide', 'fcl_distance']
TRIANGLES = ['planes', 'closest', 'closest_one_by_one', 'fcl']


def surfaces(results):
    """Time per pair of surfaces."""
    rows = []
    for case in results.cases('separation'):
        if case == 'triangles':
            continue
        def get(metric, system='separation'):
            return number(results.get('separation', case, system, metric))
        rows.append([case, *(get('us_per_pair', system) for system in SYSTEMS), get('apart'), get('crossing'),
                     get('bound')])
    return ['case', *(s + ', us' for s in SYSTEMS), 'apart', 'crossing', 'bound / distance'], rows


def triangles(results):
    """Time per pair of triangles."""
    times = [results.get('separation', 'triangles', system, 'ns_per_pair') for system in TRIANGLES]
    return [s + ', ns' for s in TRIANGLES], [] if None in times else [list(map(number, times))]


TABLES = {'separation_surfaces': surfaces, 'separation_triangles': triangles}
