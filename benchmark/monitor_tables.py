"""Tables of the study `monitor`."""
from results import number

SYSTEMS = ['sdf_ccd', 'sdf_ccd_verdict', 'sdf_ccd_wrench', 'fcl', 'fcl_distance', 'bullet', 'bullet_cast']


def by_system(results, metrics):
    """Times of the systems that were run, in the cases for which ours has one."""
    def times(case, system):
        values = [results.get('monitor', case, system, metric) for metric in metrics]
        return '-' if None in values else ' / '.join(map(number, values))
    cases = [case for case in results.cases('monitor') if times(case, 'sdf_ccd') != '-']
    systems = [s for s in SYSTEMS if any(times(case, s) != '-' for case in cases)]
    return ['case', *(s + ', us' for s in systems)], [[case, *(times(case, s) for s in systems)] for case in cases]


def cycles(results):
    """Times of whole cycles."""
    return by_system(results, ['us_median', 'us_p99', 'us_p999'])


def cold(results):
    """Median times of whole cycles that begin with cold caches."""
    return by_system(results, ['us_cold_median'])


def verdicts(results):
    """Verdicts of our cycles, and the cost of preparing the scene."""
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


def transforms(results):
    """Time of a cycle from tf to the message, and the part of it outside the monitor."""
    rows = []
    for case in results.cases('monitor'):
        values = [results.get('monitor', case, 'sdf_ccd_tf', prefix + name)
                  for prefix in ('us_', 'beside_us_') for name in ('median', 'p99', 'p999')]
        if None in values:
            continue
        transforms = results.get('monitor', case, 'sdf_ccd_tf', 'transforms')
        rows.append([case, number(transforms), ' / '.join(map(number, values[:3])), ' / '.join(map(number, values[3:]))])
    return ['case', 'transforms a message', 'from tf to the message, us', 'beside the monitor, us'], rows


def depths(results):
    """Error bounds of depths, per contact and cycle."""
    rows = []
    for case in results.cases('monitor'):
        values = [results.get('monitor', case, 'sdf_ccd', 'depth_error_' + name) for name in ('median', 'p99')]
        measured = results.get('monitor', case, 'sdf_ccd', 'measured')
        if measured is not None:
            rows.append([case, ' / '.join(map(number, values)), number(100 * measured)])
    return ['case', 'error of the depth, mm', 'contacts measured on surfaces, %'], rows


TABLES = {'monitor_depths': depths, 'monitor_transforms': transforms, 'monitor_cycles': cycles, 'monitor_cold': cold,
          'monitor_verdicts': verdicts}
