"""Table of the study `scenes`."""
from results import number

METRICS = ('pairs', 'shell_points', 'megabytes_fields', 'megabytes', 's_to_verdict', 'run_time_us', 'processor_us_per_cycle')


def scenes(results):
    """What a running monitor costs by what its scene needs."""
    rows = []
    for case in results.cases('scenes'):
        rows.append([case, *(number(results.get('scenes', case, 'sdf_ccd', metric)) for metric in METRICS)])
    return ['scene / subscribers', 'pairs', 'points of shells', 'fields and shells, MB', 'process, MB', 'start to verdict, s',
            'check, us', 'processor a cycle, us'], rows


TABLES = {'scenes': scenes}
