"""Reads results.csv of the studies (study,case,system,metric,value,unit,runs), and formats its numbers."""
import csv


def number(value, unit=''):
    """Formats with three digits; a dash for None."""
    if value is None:
        return '-'
    text = '%.3g' % value
    if 'e' in text and 1e-2 <= abs(value) < 1e7:
        text = '%d' % round(value)
    return text + unit


class Results:
    """The values by study, case, system and metric; a later row replaces an earlier one."""

    def __init__(self, path):
        with open(path, newline='') as file:
            rows = list(csv.DictReader(file))
        self.values = {(r['study'], r['case'], r['system'], r['metric']): float(r['value']) for r in rows}
        self.units = {(r['study'], r['case'], r['system'], r['metric']): r['unit'] for r in rows}
        self.order = list(dict.fromkeys((r['study'], r['case'], r['system']) for r in rows))

    def get(self, study, case, system, metric):
        """The value, or None."""
        return self.values.get((study, case, system, metric))

    def unit(self, study, case, system, metric):
        return self.units.get((study, case, system, metric), '')

    def best(self, study, case, systems, metric):
        """The smallest value of several systems, or None."""
        values = [self.get(study, case, system, metric) for system in systems]
        return min((v for v in values if v is not None), default=None)

    def cases(self, study):
        return list(dict.fromkeys(case for s, case, _ in self.order if s == study))

    def systems(self, study, case=None):
        return list(dict.fromkeys(system for s, c, system in self.order if s == study and case in (None, c)))
