"""Tables of the study `monitor`."""

SYSTEMS = ['sdf_ccd', 'sdf_ccd_wrench', 'fcl', 'fcl_distance', 'bullet_cast']


def number(value):
    return '-' if value is None else '%.3g' % value


def cycles(results):
    """Times of whole cycles."""
    rows = []
    for case in results.cases('monitor'):
        def times(system):
            values = [results.get('monitor', case, system, 'us_' + name) for name in ('median', 'p99', 'p999')]
            return '-' if None in values else ' / '.join(map(number, values))
        rows.append([case, *map(times, SYSTEMS)])
    return ['case', *(s + ', us' for s in SYSTEMS)], rows


def verdicts(results):
    """What our cycles say, and what they rest on."""
    rows = []
    for case in results.cases('monitor'):
        def get(metric):
            value = results.get('monitor', case, 'sdf_ccd', metric)
            built = results.get('monitor', case.replace('/50Hz', ''), 'sdf_ccd', metric)
            return number(built if value is None else value)
        rows.append([case, *map(get, ('pairs', 'tested', 'bound', 'uncertain_share', 'contact_share', 'false_clear',
                                      'start_up', 'memory'))])
    return ['case', 'pairs', 'tested a cycle', 'bound, mm', 'UNCERTAIN', 'CONTACT', 'false CLEAR', 'start-up, s',
            'memory, MB'], rows


TABLES = {'monitor_cycles': cycles, 'monitor_verdicts': verdicts}
