"""Table of the study `map`."""
from results import number


def cycles(results):
    """A robot's cycles in an OctoMap, beside FCL's discrete check."""
    rows = []
    for case in results.cases('map'):
        def get(metric, system='sdf_ccd'):
            return number(results.get('map', case, system, metric))

        def times(system):
            return ' / '.join(get(metric, system) for metric in ('us_median', 'us_p99'))
        rows.append([case, get('start_up'), get('memory'), get('bound'), get('uncertain_share'), get('contact_share'),
                     get('contact_share', 'fcl'), get('false_clear'), times('sdf_ccd'), times('sdf_ccd_wrench'),
                     times('fcl')])
    return ['case', 'start-up, s', 'map, MB', 'bound, mm', 'UNCERTAIN', 'CONTACT', 'FCL', 'false CLEAR', 'verdicts, us',
            'with wrenches, us', 'FCL, us'], rows


TABLES = {'map': cycles}
