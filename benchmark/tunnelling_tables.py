"""Table of the study `tunnelling`."""
from results import number

SYSTEMS = ['sdf_ccd', 'fcl', 'bullet_cast']


def passages(results):
    """Missed passages and time per cycle of each system."""
    rows = []
    for case in results.cases('tunnelling'):
        def get(system, metric):
            return number(results.get('tunnelling', case, system, metric))
        rows.append([case, get('sdf_ccd', 'passages'), *(get(system, 'missed') for system in SYSTEMS),
                     get('sdf_ccd', 'uncertain'), *(get(system, 'us_cycle') for system in SYSTEMS)])
    return ['case', 'passages', *('missed by ' + system for system in SYSTEMS), 'UNCERTAIN',
            *(system + ', us a cycle' for system in SYSTEMS)], rows


TABLES = {'tunnelling': passages}
