"""Tables of the studies `bound`, `truth` and `work-precision`."""
from results import number


def bound(results):
    """Violations and tightness, per mesh and query, over all fields."""
    rows = []
    for case in results.cases('bound'):
        if case.count('/') != 1 or case.endswith('/reference'):
            continue
        def get(metric):
            return results.get('bound', case, 'sdf_ccd', metric)
        rows.append([case, '%d' % get('queries'), '%d' % get('violations'), number(get('median_ratio')),
                     number(get('largest_share')), *(number(get('error_' + q)) for q in ('median', 'p99', 'max'))])
    return ['mesh/query', 'queries', 'violations', 'bound / error, median', 'error / bound, largest',
            'error, median', 'p99', 'maximum'], rows


def verdicts(results):
    """Verdicts of the monitor for moving pairs, over its error bound."""
    rows = []
    for case in results.cases('bound'):
        if '/verdict/' not in case:
            continue
        mesh, _, field = case.split('/')
        def get(metric):
            return results.get('bound', case, 'sdf_ccd', metric)
        rows.append([mesh, field, number(get('cell')), number(get('error_bound')),
                     *('%d' % get(v) for v in ('clear', 'contact', 'uncertain')),
                     '%.0f %%' % (100.0 * get('uncertain_share')), '%d' % get('violations')])
    return ['mesh', 'field', 'cells, box sides', 'bound, box sides', 'CLEAR', 'CONTACT', 'UNCERTAIN', 'share',
            'contradicted'], rows


def reference(results):
    """The reference compared with CGAL."""
    rows = []
    for case in results.cases('bound'):
        if case.endswith('/reference'):
            rows.append([case.split('/')[0], *(number(results.get('bound', case, 'cgal', metric)) for metric in
                                               ('distance_difference', 'hit_difference', 'hits_of_one_only'))])
    return ['mesh', 'largest difference of distances', 'of first hits', 'segments that one of both takes for a miss'], rows


def truth(results):
    """Wrong verdicts and other counts, per family of adversarial motions."""
    rows = []
    for case in results.cases('truth'):
        if case == 'oracle':
            continue

        def get(metric):
            return results.get('truth', case, 'sdf_ccd', metric)
        rows.append([case, *('%d' % get(m) for m in ('cases', 'false_clear', 'false_contact', 'false_bound', 'opposite',
                                                     'clear', 'contact')),
                     *('%.0f %%' % (100.0 * get(m)) for m in ('uncertain_share', 'near_share')),
                     number(get('bound_over_error') or None)])
    return ['family', 'cases', 'false CLEAR', 'false CONTACT', 'false bound', 'opposite', 'CLEAR', 'CONTACT',
            'UNCERTAIN', 'nearer than 3 bounds', 'reported / true error, median'], rows


def work_precision(results):
    """Error over run time: a block of rows per mesh and study."""
    rows = []
    last = None
    for case in results.cases('work-precision'):
        mesh, study, quantity, setting = case.split('/')
        for system in results.systems('work-precision', case):
            def get(metric):
                return results.get('work-precision', case, system, metric)
            unit = results.unit('work-precision', case, system, 'error_median')
            block = (mesh, study, '%s [%s]' % (quantity, unit))
            rows.append([*(block if block != last else ('', '', '')), system, setting, number(get('us_per_query')),
                         *(number(get(metric)) for metric in ('error_median', 'error_p99', 'error_max', 'bound')),
                         '%d' % get('missed')])
            last = block
    return ['mesh', 'study', 'error of', 'system', 'setting', 'us per query', 'median', 'p99', 'maximum', 'bound',
            'missed'], rows


TABLES = {'bound': bound, 'verdicts': verdicts, 'reference': reference, 'truth': truth, 'work_precision': work_precision}
