"""Tables of the study `meshes`."""

COUNTS = ['triangles', 'degenerate', 'duplicates', 'walls_dropped', 'walls_kept', 'components', 'turned_closed',
          'turned_open', 'negative', 'buried', 'clipped', 'doubtful', 'boundary_edges', 'non_manifold_edges']
COSTS = [('turning, CPU s', 'orient_seconds', '%.2g', 1), ('solid, CPU s', 'solid_seconds', '%.2g', 1),
         ('closing, CPU s', 'closing_seconds', '%.2g', 1),
         ('field to 1e-3, CPU s', 'build_seconds_1e-3', '%.2g', 1), ('expected', 'expected_cpu_s_1e-3', '%.2g', 1),
         ('MB', 'megabytes_1e-3', '%.2g', 1), ('expected MB', 'expected_mb_1e-3', '%.2g', 1),
         ('untrue crossings, %', 'untrue_share_1e-3', '%.2g', 100)]


def meshes(results):
    """Defects of meshes found in practice, and the cost of their fields."""
    rows = []
    for case in results.cases('meshes'):
        def get(metric):
            return results.get('meshes', case, 'sdf_ccd', metric)

        def cost(metric, form, factor):
            value = get(metric)
            return '-' if value is None else form % (factor * value)
        rows.append([case, *('%d' % get(metric) for metric in COUNTS), 'yes' if get('trusted') else 'no',
                     *(cost(metric, form, factor) for _, metric, form, factor in COSTS)])
    return ['mesh', *(name.replace('_', ' ') for name in COUNTS), 'sign trusted', *(name for name, *_ in COSTS)], rows


QUANTITIES = [('MB', 'expected_mb_', 'megabytes_'), ('CPU s', 'expected_cpu_s_', 'build_seconds_')]


def expected(results):
    """Expected and measured cost of fields over all meshes, and the time that the estimate took."""
    cases = results.cases('meshes')
    metrics = dict.fromkeys(metric for study, _, _, metric in results.values if study == 'meshes')
    rows = []
    for error in (metric[len('expected_mb_'):] for metric in metrics if metric.startswith('expected_mb_')):
        def values(prefix):
            return [results.get('meshes', case, 'sdf_ccd', prefix + error) for case in cases]
        shares = sorted(sample / taken for sample, taken in zip(values('sample_seconds_'), values('build_seconds_'))
                        if sample and taken)
        for name, before, after in QUANTITIES:
            factors = sorted(max(e / t, t / e) for e, t in zip(values(before), values(after)) if e and t)
            if not factors:
                continue
            within = sum(factor <= 2.0 for factor in factors) / len(factors)
            rows.append([error, name, '%d' % len(factors), '%.2f' % factors[len(factors) // 2],
                         '%.2f' % factors[int(0.95 * len(factors))], '%.2f' % factors[-1], '%.3g' % (100 * within),
                         '%.2g' % (100 * shares[len(shares) // 2]) if shares else '-'])
    return ['error', 'quantity', 'builds', 'median factor', '95 % below', 'worst', 'within a factor of 2, %',
            'sample, median % of the build'], rows


TABLES = {'meshes': meshes, 'meshes-expected': expected}
