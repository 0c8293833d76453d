"""Table of the study `meshes`."""

COUNTS = ['triangles', 'degenerate', 'duplicates', 'walls_dropped', 'walls_kept', 'components', 'turned_closed',
          'turned_open', 'negative', 'boundary_edges', 'non_manifold_edges']


def meshes(results):
    """What meshes as people draw them hold."""
    rows = []
    for case in results.cases('meshes'):
        def get(metric):
            return results.get('meshes', case, 'sdf_ccd', metric)
        seconds = get('build_seconds_1e-3')
        rows.append([case, *('%d' % get(metric) for metric in COUNTS), 'yes' if get('trusted') else 'no',
                     '%.2g' % get('orient_seconds'), '-' if seconds is None else '%.2g' % seconds])
    return ['mesh', *(name.replace('_', ' ') for name in COUNTS), 'sign trusted', 'turning, s', 'field to 1e-3, s'], rows


TABLES = {'meshes': meshes}
