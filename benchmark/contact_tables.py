"""Tables of the study `contact`."""
from results import number

SYSTEMS = ['verdict', 'contacts', 'wrenches', 'fcl']


def contact(results):
    """Time per cycle of a pair, by what is asked."""
    rows = []
    for case in results.cases('contact'):
        times = [number(results.get('contact', case, system, 'us_per_cycle')) for system in SYSTEMS]
        shares = [number(results.get('contact', case, 'verdict', metric)) for metric in ('contact', 'uncertain')]
        rows.append([case, *times, *shares])
    return ['case', *(s + ', us' for s in SYSTEMS), 'CONTACT', 'UNCERTAIN'], rows


TABLES = {'contact': contact}
