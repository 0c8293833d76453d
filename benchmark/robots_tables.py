"""Table of the study `robots`."""
from results import number


def robots(results):
    """Cost of an error bound."""
    rows = []
    for case in results.cases('robots'):
        def get(metric):
            return results.get('robots', case, 'sdf_ccd', metric)
        robot, error = case.split('/')
        if error.startswith('accuracy_'):
            continue
        wanted = number(1e-3 * float(error[:-2])) if error.endswith('um') else 'not set'
        rows.append([robot, wanted, number(get('bound')),
                     *(number(get(m)) for m in ('memory', 'build', 'cycle', 'uncertain', 'contact'))])
    return ['robot', 'max_error, mm', 'bound reached, mm', 'memory, MB', 'start-up, s', 'cycle, ms',
            'UNCERTAIN, % of pairs', 'CONTACT, %'], rows


def robots_accuracy(results):
    """Cost and errors of forces."""
    rows = []
    for case in results.cases('robots'):
        def get(metric):
            return number(results.get('robots', case, 'sdf_ccd', metric))
        robot, _, accuracy = case.partition('/accuracy_')
        if not accuracy:
            continue
        wanted = number(1e-3 * float(accuracy[:-2])) if accuracy.endswith('um') else 'by size'
        rows.append([robot, wanted, *map(get, ('force_error_median', 'force_error_p90', 'force_error_all', 'other_verdicts', 'memory',
                                               'build', 'cycle'))])
    return ['robot', 'contact/accuracy, mm', 'force error, median, %', '90 %', 'of all forces', 'other verdicts', 'memory, MB',
            'start-up, s', 'cycle, ms'], rows


TABLES = {'robots': robots, 'robots_accuracy': robots_accuracy}
