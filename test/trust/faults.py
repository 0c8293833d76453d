#!/usr/bin/env python3
"""Kills the tools and the monitor at random moments, fills their disk and damages their files.

usage: faults.py [--bin FOLDER] [--rounds N] [--seed N] [--only kill_build|kill_check_bag|kill_monitor|disk|bits]

After each fault the next run must succeed with the results of an undisturbed run, no temporary file and no process may
be left, and a damaged file must be refused or rebuilt. Otherwise it prints the findings and the exit code is 1. Needs
the package's devel space (build/devel/setup.bash sourced).
"""
import argparse
import csv
import filecmp
import os
import random
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time

from faults_inputs import write_inputs

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, ROOT + '/test/ros')
from own_master import start_master, use_own_master  # noqa: E402

TIME_LIMIT = 120.0  # of one run, on a loaded computer [s]


class Findings:
    def __init__(self):
        self.count, self.checks = 0, 0

    def require(self, holds, what):
        self.checks += 1
        if not holds:
            self.count += 1
            print('FINDING:', what, flush=True)


def files_below(folder):
    return sorted(os.path.relpath(os.path.join(path, name), folder)
                  for path, _, names in os.walk(folder) for name in names)


def without_locks(names):
    """Without the lock files of the cache, which stay: they are empty, and the kernel releases the locks."""
    return [name for name in names if not name.endswith('.lock')]


class Bench:
    """Inputs and commands, in a temporary folder."""

    def __init__(self, binaries, rng):
        self.binaries, self.rng, self.findings = binaries, rng, Findings()
        self.folder = tempfile.mkdtemp(prefix='sdf_ccd_faults.')
        self.inputs = write_inputs(self.folder)
        self.tool = os.path.join(binaries, 'sdf_ccd')

    def path(self, name):
        return os.path.join(self.folder, name)

    def fresh(self, name):
        shutil.rmtree(self.path(name), ignore_errors=True)
        os.makedirs(self.path(name))
        return self.path(name)

    def build_command(self, out):
        return [self.tool, 'build', '--mesh', self.inputs.mesh, '--out', out, '--resolution', '96']

    def check_command(self, out, cache):
        config = self.path('config.yaml')
        with open(config, 'w') as stream:
            stream.write('cache_directory: %s\nfield: {cells: 48}\nshell: {spacing: 0.01}\n' % cache)
        return [self.tool, 'check-bag', self.inputs.bag, '--urdf', self.inputs.urdf, '--config', config, '--out', out]

    def run(self, command, limit=None):
        """Runs a command, optionally with a limit on file sizes [bytes], as on a full disk.

        Returns exit code, stderr and duration [s]."""
        def prepare():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            if limit is not None:
                resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))
        start = time.monotonic()
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=TIME_LIMIT,
                              preexec_fn=prepare, check=False)
        return done.returncode, done.stderr.decode(errors='replace'), time.monotonic() - start

    def kill_after(self, command, delay):
        """Runs a command and kills it after a delay [s]. Returns whether it was still running."""
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            process.wait(delay)
            return False
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
            return True

    def require_no_reader(self):
        """Requires that the processes that read meshes end with the processes that wait for them."""
        end = time.monotonic() + 5.0
        while time.monotonic() < end:
            left = [pid for pid in os.listdir('/proc') if pid.isdigit() and self.is_reader(pid)]
            if not left:
                return
            time.sleep(0.05)
        self.findings.require(False, 'a reader has outlived its owner: ' + ' '.join(left))

    def is_reader(self, pid):
        try:
            exe = os.readlink('/proc/%s/exe' % pid)
            return os.path.realpath(exe).startswith(os.path.realpath(os.path.join(self.binaries, 'sdf_ccd_read')))
        except OSError:
            return False


def same_files(bench, folder, reference, names, what):
    for name in names:
        same = os.path.exists(os.path.join(folder, name)) and filecmp.cmp(
            os.path.join(folder, name), os.path.join(reference, name), shallow=False)
        bench.findings.require(same, '%s: %s is another than that of an undisturbed run' % (what, name))


def results(folder):
    """Results of check-bag, without run times."""
    with open(os.path.join(folder, 'contacts.csv')) as contacts, open(os.path.join(folder, 'cycles.csv')) as cycles:
        rows = [row for row in csv.DictReader(cycles)]
        for row in rows:
            del row['run_time']
        return contacts.read(), rows


def require_same_results(bench, folder, reference, what):
    try:
        same = results(folder) == results(reference)
    except OSError:
        same = False
    bench.findings.require(same, what + ': other results than those of an undisturbed run')


def kill_build(bench, rounds):
    reference = bench.fresh('build_reference')
    code, error, duration = bench.run(bench.build_command(reference))
    bench.findings.require(code == 0, 'build: ' + error)
    whole = files_below(reference)
    out, killed = bench.fresh('build'), 0
    for _ in range(rounds):
        killed += bench.kill_after(bench.build_command(out), bench.rng.uniform(0.0, 1.1 * duration))
        left = files_below(out)
        bench.findings.require(set(left) <= set(whole), 'build leaves %s' % sorted(set(left) - set(whole)))
        same_files(bench, out, reference, [name for name in left if name in whole], 'build')
        if bench.rng.random() < 0.5:
            bench.fresh('build')
    bench.require_no_reader()
    bench.findings.require(bench.run(bench.build_command(out))[0] == 0, 'build after kills fails')
    same_files(bench, out, reference, whole, 'build after kills')
    return '%d of %d killed' % (killed, rounds)


def check_bag_reference(bench):
    reference, cache = bench.fresh('check_reference'), bench.fresh('check_cache')
    code, error, duration = bench.run(bench.check_command(reference, cache))
    bench.findings.require(code == 0, 'check-bag: ' + error)
    return reference, cache, duration


def kill_check_bag(bench, rounds):
    reference, cache, duration = check_bag_reference(bench)
    whole, cached = files_below(reference), without_locks(files_below(cache))
    shutil.copytree(cache, bench.path('cache_reference'), dirs_exist_ok=True)
    out, killed = bench.fresh('check'), 0
    for _ in range(rounds):
        if bench.rng.random() < 0.5:
            bench.fresh('check_cache')
        killed += bench.kill_after(bench.check_command(out, cache), bench.rng.uniform(0.0, 1.1 * duration))
        left = set(files_below(out)) - set(whole)
        bench.findings.require(not left, 'check-bag leaves %s' % sorted(left))
        for name in without_locks(files_below(cache)):
            if name in cached:
                same_files(bench, cache, bench.path('cache_reference'), [name], 'cache')
    bench.require_no_reader()
    bench.findings.require(bench.run(bench.check_command(out, cache))[0] == 0, 'check-bag after kills fails')
    require_same_results(bench, out, reference, 'check-bag after kills')
    left = without_locks(files_below(cache))
    bench.findings.require(left == cached, 'the cache after kills holds %s, not %s' % (left, cached))
    return '%d of %d killed' % (killed, rounds)


def kill_monitor(bench, rounds):
    master = start_master(use_own_master(ROS_LOG_DIR=bench.fresh('log')))
    try:
        return kill_monitor_beside(bench, rounds)
    finally:
        master.terminate()
        master.wait()


def kill_monitor_beside(bench, rounds):
    import rospy
    from sdf_ccd.msg import Plan
    cache = bench.fresh('monitor_cache')
    with open(bench.inputs.urdf) as urdf:
        rospy.set_param('robot_description', urdf.read())
    for key, value in (('cache_directory', cache), ('field/cells', 48), ('shell/spacing', 0.01)):
        rospy.set_param('collision_monitor/' + key, value)
    rospy.init_node('faults', disable_signals=True)
    command = [os.path.join(bench.binaries, 'collision_monitor')]

    def time_until_ready():
        start = time.monotonic()
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            rospy.wait_for_message('collision_monitor/plan', Plan, TIME_LIMIT)
            return time.monotonic() - start
        except rospy.ROSException:
            return None
        finally:
            process.kill()
            process.wait()

    duration = time_until_ready()
    bench.findings.require(duration is not None, 'the monitor does not get ready')
    reference = bench.path('monitor_reference')
    shutil.copytree(cache, reference)
    cached, killed = without_locks(files_below(cache)), 0
    for _ in range(rounds):
        if bench.rng.random() < 0.5:
            bench.fresh('monitor_cache')
        killed += bench.kill_after(command, bench.rng.uniform(0.0, 1.2 * (duration or 1.0)))
        same_files(bench, cache, reference, [n for n in without_locks(files_below(cache)) if n in cached], 'cache')
    bench.require_no_reader()
    bench.findings.require(time_until_ready() is not None, 'the monitor after kills does not get ready')
    left = without_locks(files_below(cache))
    bench.findings.require(left == cached, 'the cache after kills of the monitor holds %s, not %s' % (left, cached))
    return '%d of %d killed' % (killed, rounds)


def disk(bench, rounds):
    """Limits the size of files to a random value."""
    reference, cache, _ = check_bag_reference(bench)
    built = bench.fresh('build_reference')
    bench.run(bench.build_command(built))
    largest = max(os.path.getsize(os.path.join(folder, name)) for folder in (reference, cache, built)
                  for name in files_below(folder))
    refused = 0
    for i in range(rounds):
        limit = int(largest * bench.rng.random() ** 3)
        out = bench.fresh('full')
        if i % 2:
            command, folder = bench.build_command(out), built
        else:
            command, folder = bench.check_command(out, bench.fresh('full_cache')), reference
        code, error, _ = bench.run(command, limit)
        refused += code != 0
        said = 'a disk with room for %d bytes a file: exit code %d, "%s"' % (limit, code, error.strip()[-200:])
        bench.findings.require(0 <= code <= 2 and 'terminate' not in error, said)
        bench.findings.require(code == 0 or 'write' in error or 'too large' in error, said)
        left = set(files_below(out)) - set(files_below(folder))
        bench.findings.require(not left, '%s; leaves %s' % (said, sorted(left)))
        left = set(without_locks(files_below(bench.path('full_cache')))) - set(files_below(cache)) if i % 2 == 0 else ()
        bench.findings.require(not left, '%s; leaves %s in the cache' % (said, sorted(left)))
    return '%d of %d refused' % (refused, rounds)


def damage(path, rng):
    """Flips one bit of a file, or truncates it."""
    with open(path, 'rb') as stream:
        data = bytearray(stream.read())
    if rng.random() < 0.2 or not data:
        data = data[:rng.randrange(len(data))] if data else data
    else:
        data[rng.randrange(len(data)) if rng.random() < 0.7 else rng.randrange(min(256, len(data)))] ^= 1 << rng.randrange(8)
    with open(path, 'wb') as stream:
        stream.write(data)


def bits(bench, rounds):
    reference, cache, _ = check_bag_reference(bench)
    cached = bench.path('bits_reference')
    shutil.copytree(cache, cached, dirs_exist_ok=True)
    names = without_locks(files_below(cache))
    built = bench.fresh('bits_build')
    bench.run(bench.build_command(built))
    outputs, refused = files_below(built), 0
    for i in range(rounds):
        name = names[i % len(names)]
        damage(os.path.join(cache, name), bench.rng)
        out = bench.fresh('bits')
        code, error, _ = bench.run(bench.check_command(out, cache))
        bench.findings.require(code == 0, 'check-bag with a damaged %s: exit code %d, %s' % (name, code, error))
        require_same_results(bench, out, reference, 'check-bag with a damaged ' + name)
        same_files(bench, cache, cached, [name], 'the cache after damage')
        for file in outputs:
            path = bench.path('damaged_' + file)
            shutil.copy(os.path.join(built, file), path)
            damage(path, bench.rng)
            code, error, _ = bench.run([bench.tool, 'info', path])
            refused += code == 2
            bench.findings.require(code == 2, 'info takes a damaged %s: exit code %d %s' % (file, code, error))
    return '%d damaged files of the cache made again, %d of build refused' % (rounds, refused)


PARTS = {'kill_build': kill_build, 'kill_check_bag': kill_check_bag, 'kill_monitor': kill_monitor, 'disk': disk,
         'bits': bits}


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument('--bin', default=os.path.join(ROOT, 'build/devel/lib/sdf_ccd'))
    parser.add_argument('--rounds', type=int, default=100)
    parser.add_argument('--seed', type=int, default=1)
    parser.add_argument('--only', action='append', choices=PARTS)
    arguments = parser.parse_args()
    bench = Bench(os.path.abspath(arguments.bin), random.Random(arguments.seed))
    for name in arguments.only or PARTS:
        start, before = time.monotonic(), bench.findings.count
        print('%-15s' % name, end=' ', flush=True)
        result = PARTS[name](bench, arguments.rounds)
        print('%s; %d findings (%.0f s)' % (result, bench.findings.count - before, time.monotonic() - start), flush=True)
    if bench.findings.count == 0:
        shutil.rmtree(bench.folder)
    else:
        print('files:', bench.folder)
    return 1 if bench.findings.count else 0


if __name__ == '__main__':
    sys.exit(main())
