"""Table of the study `robots`."""
from results import number


def robots(results):
    """What a bound costs."""
    rows = []
    for case in results.cases('robots'):
        def get(metric):
            return results.get('robots', case, 'sdf_ccd', metric)
        robot, error = case.split('/')
        wanted = number(1e-3 * float(error[:-2])) if error.endswith('um') else 'not set'
        rows.append([robot, wanted, number(get('bound')),
                     *('%s (%s)' % (number(get(m)), number(get('expected_' + m))) for m in ('memory', 'build')),
                     number(get('cycle')), *(number(get(v)) for v in ('uncertain', 'contact'))])
    return ['robot', 'max_error, mm', 'bound reached, mm', 'memory (expected), MB', 'start-up (expected), s',
            'cycle, ms', 'UNCERTAIN, % of pairs', 'CONTACT, %'], rows


TABLES = {'robots': robots}
