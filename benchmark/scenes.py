#!/usr/bin/env python3
"""What a scene costs that does not need everything: memory, start-up and processor time of a running monitor.

usage: scenes.py [--urdf FILE] [--seconds N] [--rate HZ] [--runs N] [--quick]

Prints rows of results.csv: study,case,system,metric,value,unit,runs. Cases are SCENE/SUBSCRIBERS. Scenes: `empty` (a robot
of one box, no world), `box` (that robot and one box), `arm` (the demo's arm, or that of --urdf), `arm_box` and `arm_map`
(the arm in an OctoMap of a room of 60,000 voxels). Subscribers: `none`, or `all` topics of the monitor. Processor time is
that of the whole process, with the reception of the transforms, by the number of cycles.
"""
import argparse
import os
import statistics
import subprocess
import sys
import tempfile
import time
import xml.etree.ElementTree as ElementTree

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path[:0] = [ROOT + '/test/ros', ROOT + '/scripts']
import rospy  # noqa: E402
from octomap_message import Octomap, binary_data, octomap, octree  # noqa: E402
from own_master import start_master, use_own_master  # noqa: E402
from sensor_msgs.msg import JointState  # noqa: E402
from std_msgs.msg import Header  # noqa: E402

from sdf_ccd.msg import MonitorState  # noqa: E402
from sdf_ccd.srv import GetPlan  # noqa: E402

ONE_LINK = """<robot name='one'><link name='base'/><link name='tool'><collision><geometry><box size='0.1 0.1 0.1'/></geometry>
</collision></link><joint name='turn' type='revolute'><parent link='base'/><child link='tool'/><axis xyz='0 0 1'/>
<limit lower='-1' upper='1' effort='1' velocity='1'/></joint></robot>"""
BOX = [{'name': 'box', 'type': 'box', 'size': [0.1, 0.1, 0.1], 'xyz': [2.0, 0.0, 0.5]}]
VOXEL, PATIENCE = 0.05, 60.0  # [m], [s]


def room():
    """The walls and the floor of a room around the robot, as the voxels of an OctoMap."""
    middle, reach, height = 32768, 70, 60
    voxels = {}
    for x in range(-reach, reach):
        for y in range(-reach, reach):
            is_wall = min(x, y) < 2 - reach or max(x, y) >= reach - 2
            for z in range(-3, height if is_wall else -2):
                voxels[(middle + x, middle + y, middle + z)] = True
    return voxels


def resident(pid):
    """[MB]"""
    with open('/proc/%d/statm' % pid) as statm:
        return int(statm.read().split()[1]) * os.sysconf('SC_PAGE_SIZE') / 1e6


def processor_time(pid):
    """[s]"""
    with open('/proc/%d/stat' % pid) as stat:
        fields = stat.read().rsplit(')', 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf('SC_CLK_TCK')


class Joints:
    """Sends the joints' states, each swinging by a tenth of its range about the middle."""

    def __init__(self, urdf, rate):
        self.middles = {}
        for joint in ElementTree.fromstring(urdf).iter('joint'):
            limit = joint.find('limit')
            if joint.get('type') in ('revolute', 'prismatic') and joint.find('mimic') is None and limit is not None:
                low, high = float(limit.get('lower', 0)), float(limit.get('upper', 0))
                self.middles[joint.get('name')] = (0.5 * (low + high), 0.1 * (high - low))
        self.publisher = rospy.Publisher('/joint_states', JointState, queue_size=1)
        self.phase, self.step = 0, 1.0 / rate
        self.timer = rospy.Timer(rospy.Duration(self.step), self.send)

    def send(self, _event):
        self.phase += 1
        share = abs(self.phase * self.step % 2.0 - 1.0) - 0.5
        state = JointState(header=Header(stamp=rospy.Time.now()), name=list(self.middles),
                           position=[middle + share * range_ for middle, range_ in self.middles.values()])
        self.publisher.publish(state)

    def stop(self):
        self.timer.shutdown()
        self.timer.join()
        self.publisher.unregister()


class Run:
    """One monitor with a robot and a world of its own, from its start to its end."""

    def __init__(self, urdf, parameters, voxels, rate):
        rospy.set_param('/robot_description', urdf)
        rospy.set_param('/monitor', {'robot_description_semantic': '', 'cache': False, 'rate': rate, **parameters})
        self.map = rospy.Publisher('/map', Octomap, queue_size=1, latch=True) if voxels else None
        if voxels:
            self.map.publish(octomap(Header(stamp=rospy.Time.now(), frame_id='base'), VOXEL, voxels, True))
        self.joints = Joints(urdf, rate)
        self.tf = subprocess.Popen(['rosrun', 'robot_state_publisher', 'robot_state_publisher',
                                    '_publish_frequency:=%d' % rate], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.states, self.started = [], None
        self.subscriber = rospy.Subscriber('/monitor/state', MonitorState, self.keep)
        time.sleep(1.0)  # tf is there
        self.start = time.monotonic()
        self.monitor = subprocess.Popen([ROOT + '/build/devel/lib/sdf_ccd/collision_monitor', '__name:=monitor'],
                                        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def keep(self, state):
        if not state.cycle.start.is_zero() and self.started is None:
            self.started = time.monotonic()
        self.states.append(state)

    def wait_for_verdict(self):
        end = time.monotonic() + PATIENCE
        while self.started is None and time.monotonic() < end:
            if self.monitor.poll() is not None:
                raise RuntimeError('the monitor has ended')
            time.sleep(0.005)
        if self.started is None:
            raise RuntimeError('no cycle; ' + (self.states[-1].reason if self.states else 'no state'))
        return self.started - self.start

    def subscribe_to_all(self):
        own = {name for name, _ in rospy.get_published_topics('/monitor')} - {'/monitor/state'}
        return [rospy.Subscriber(topic, rospy.AnyMsg, lambda _message: None) for topic in own]

    def end(self):
        self.joints.stop()
        self.subscriber.unregister()
        if self.map:
            self.map.unregister()
        for process in (self.monitor, self.tf):
            process.terminate()
            try:
                process.wait(15.0)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()


def measure(urdf, parameters, voxels, subscribers, arguments):
    """One run: metric -> (value, unit)."""
    run = Run(urdf, parameters, voxels, arguments.rate)
    try:
        values = {'s_to_verdict': (run.wait_for_verdict(), 's')}
        others = run.subscribe_to_all() if subscribers == 'all' else []
        time.sleep(arguments.settle)  # fields, if any are wanted
        plan = rospy.ServiceProxy('/monitor/get_plan', GetPlan)().plan
        run.states.clear()
        time.sleep(1.0)
        values['run_time_us'] = (1e6 * statistics.median(state.cycle.run_time for state in run.states), 'us')
        cycles = (len(run.states) - 1) / (run.states[-1].header.stamp - run.states[0].header.stamp).to_sec()
        if subscribers == 'none':
            run.subscriber.unregister()
            time.sleep(0.5)
        before, begun = processor_time(run.monitor.pid), time.monotonic()
        time.sleep(arguments.seconds)
        used, passed = processor_time(run.monitor.pid) - before, time.monotonic() - begun
        values['processor_us_per_cycle'] = (1e6 * used / (passed * cycles), 'us')
        values['megabytes'] = (resident(run.monitor.pid), 'MB')
        values['pairs'] = (len(plan.checked), '')
        values['shell_points'] = (sum(body.shell_points for body in plan.bodies), '')
        values['megabytes_fields'] = (1e-6 * sum(body.bytes for body in plan.bodies), 'MB')
        for other in others:
            other.unregister()
        return values
    finally:
        run.end()


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument('--urdf', default=ROOT + '/config/demo/arm.urdf')
    parser.add_argument('--seconds', type=float, default=8.0)
    parser.add_argument('--settle', type=float, default=4.0)
    parser.add_argument('--rate', type=float, default=250.0)
    parser.add_argument('--runs', type=int, default=5)
    parser.add_argument('--quick', action='store_true')
    arguments, _others = parser.parse_known_args()
    if arguments.quick:
        arguments.seconds, arguments.settle, arguments.runs = 2.0, 1.0, 1
    with open(arguments.urdf) as urdf:
        arm = urdf.read()
    voxels = binary_data(octree(room()))
    live = {'octomap': {'topic': '/map', 'max_age': 0}}
    scenes = {'empty': (ONE_LINK, {}, None), 'box': (ONE_LINK, {'world': BOX}, None), 'arm': (arm, {}, None),
              'arm_box': (arm, {'world': BOX}, None), 'arm_map': (arm, live, voxels),
              'arm_box_never': (arm, {'world': BOX, 'wrenches': 'never'}, None)}
    with tempfile.TemporaryDirectory() as folder:
        master = start_master(use_own_master(ROS_HOME=folder, ROS_LOG_DIR=folder))
        try:
            rospy.init_node('scenes', disable_signals=True)
            for scene, (urdf, parameters, map_data) in scenes.items():
                for subscribers in ('none', 'all'):
                    runs = [measure(urdf, parameters, map_data, subscribers, arguments) for _ in range(arguments.runs)]
                    for metric, (_value, unit) in runs[0].items():
                        value = statistics.median(run[metric][0] for run in runs)
                        print('scenes,%s/%s,sdf_ccd,%s,%.6g,%s,%d' % (scene, subscribers, metric, value, unit, len(runs)),
                              flush=True)
        finally:
            master.terminate()
            master.wait()


if __name__ == '__main__':
    main()
