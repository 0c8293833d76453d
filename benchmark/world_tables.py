"""Tables of the study `world`."""
from results import number


def changes(results):
    """Cost of changing the world of a monitor that runs at 1 kHz."""
    rows = []
    for case in results.cases('world'):
        def get(metric):
            return number(results.get('world', case, 'sdf_ccd', metric))
        if results.get('world', case, 'sdf_ccd', 'ms_to_adopted') is None:
            continue
        rows.append([case, *map(get, ('ms_to_adopted', 'ms_to_adopted_max', 'processor_ms', 'adopt_us', 'adopt_us_max',
                                     'first_cycle_us')),
                     ' / '.join(map(get, ('cycle_us_median_before', 'cycle_us_p99_before'))),
                     ' / '.join(map(get, ('cycle_us_median_while', 'cycle_us_p99_while')))])
    return ['case', 'to adopted, ms', 'largest', 'of processors, ms', 'taking over, us', 'largest', 'first cycle, us',
            'cycle before, us', 'while, us'], rows


def soak(results):
    """Random changes, every version compared with a new monitor."""
    metrics = ('versions', 'contacts', 'contacts_missed', 'verdicts_that_differ', 'rss_first_half', 'rss')
    values = [results.get('world', 'soak', 'sdf_ccd', metric) for metric in metrics]
    rows = [] if None in values else [[number(value) for value in values]]
    return ['versions', 'contacts', 'missed', 'verdicts that differ', 'memory in the first half, MB', 'in all, MB'], rows


TABLES = {'world_changes': changes, 'world_soak': soak}
