"""Table of the study `anytime`."""
from results import number


def budgets(results):
    """Cycle times, error bounds and open verdicts per budget."""
    rows = []
    for case in results.cases('anytime'):
        def get(*metrics):
            return ' / '.join(number(results.get('anytime', case, 'sdf_ccd', metric)) for metric in metrics)
        rows.append([*case.rsplit('/', 1), get('us_median', 'us_p99', 'us_p999'), get('bound_median', 'bound_p99'),
                     get('open_share'), get('postponed'), get('longest_wait'), get('false_clear')])
    return ['case', 'budget, us', 'cycle, us', 'bound, mm', 'UNCERTAIN', 'postponed a cycle', 'longest wait, cycles',
            'false CLEAR'], rows


TABLES = {'anytime': budgets}
