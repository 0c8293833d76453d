"""Tables of the studies `stability` and `extreme`."""
from results import number

SCHEMES = ['continuous', 'discrete', 'implicit']
OUTCOMES = {0: 'stable', 1: 'stopped', 2: 'bad'}


def chart(results):
    """Largest stable step over the damping ratio, with the closed forms."""
    rows = []
    for case in results.cases('stability'):
        if not case.startswith('zeta='):
            continue
        def get(system):
            return results.get('stability', case, system, 's_max')
        row = [case.replace('zeta=', '')]
        for scheme in SCHEMES[:2]:
            exact = get('closed_form_' + scheme)
            row += ['%s (%s)' % (number(get(scheme)), number(exact)), '%.2g %%' % (100.0 * abs(get(scheme) / exact - 1.0))]
        rows.append(row + ['>= ' + number(get('implicit'))])
    return ['ζ', 'continuous (closed form)', 'off', 'discrete (closed form)', 'off', 'implicit'], rows


def rebounds(results):
    """Speed after an impact divided by speed before, without damping: mean, maximum."""
    rows = []
    for case in results.cases('stability'):
        if case.startswith('impact s='):
            rows.append([case.replace('impact s=', '')] + [
                ', '.join(number(results.get('stability', case, scheme, metric))
                          for metric in ('restitution', 'restitution_max')) for scheme in SCHEMES])
    return ['s', *SCHEMES], rows


def figure6(results):
    """The three statements of the paper's Figure 6."""
    rows = [['printed', '3', '2.75', '2.6']]
    for case in results.cases('stability'):
        if case.startswith('figure6_'):
            def get(system, metric):
                return number(results.get('stability', case, system, metric))
            rows.append([case.replace('figure6_', ''), get('continuous/discrete', 'step_ratio'),
                         get('discrete/continuous', 'depth_ratio'), get('continuous/discrete', 'step_ratio_matched')])
    return ['case', 'step, same stiffness', 'depth, discrete softened', 'step, no deeper'], rows if len(rows) > 1 else []


def extreme(results):
    """Outcomes of all cases."""
    rows = []
    for case in results.cases('extreme'):
        def get(scheme, metric):
            return results.get('extreme', case, scheme, metric)
        rows.append([case, OUTCOMES[get('implicit', 'expected')], OUTCOMES[get('implicit', 'outcome')],
                     number(get('implicit', 'energy_gain')), number(get('implicit', 'max_depth')),
                     *(OUTCOMES[get(scheme, 'outcome')] for scheme in SCHEMES[:2])])
    return ['case', 'expected', 'implicit', 'energy gain', 'deepest [m]', 'continuous', 'discrete'], rows


TABLES = {'stability_chart': chart, 'rebounds': rebounds, 'figure6': figure6, 'extreme': extreme}
