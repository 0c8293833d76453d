"""Tables of the study `meshes`."""

COUNTS = ['triangles', 'degenerate', 'duplicates', 'walls_dropped', 'walls_kept', 'components', 'turned_closed',
          'turned_open', 'negative', 'buried', 'clipped', 'doubtful', 'boundary_edges', 'non_manifold_edges']
COSTS = [('turning, CPU s', 'orient_seconds', '%.2g', 1), ('solid, CPU s', 'solid_seconds', '%.2g', 1),
         ('closing, CPU s', 'closing_seconds', '%.2g', 1),
         ('field to 1e-3, CPU s', 'build_seconds_1e-3', '%.2g', 1),
         ('MB', 'megabytes_1e-3', '%.2g', 1),
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


TABLES = {'meshes': meshes}
