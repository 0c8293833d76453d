#!/usr/bin/env python3
"""A recorded PR2 at full rate, with a stick on its tilting laser, in a map that changes while it moves.

The stick sweeps through a lump of the map, up and down; where it does is told by the angle of the laser that the bag
holds, and by axes that part two boxes.

usage: pr2_live_map_test.py DATA_DIRECTORY
"""
import bisect
import math
import os
import sys
import time
import unittest

import rosbag
import rospy
from geometry_msgs.msg import Point, Pose, Quaternion
from shape_msgs.msg import SolidPrimitive
from std_msgs.msg import Header

from monitor_case import Recorder, wait_for_service
from own_master import PATIENCE, MasterCase
from sdf_ccd.msg import ContactArray, MonitorState, SceneChange, Verdict
from sdf_ccd.srv import GetPlan, UpdateScene
from voxel_maps import SIZE, Octomap, message

DATA = os.path.abspath(sys.argv.pop())
BAG = DATA + '/bags/jsk_pr2eus/67b1b5a5_pr1012_sensors.bag'
URDF = DATA + '/robots/pr2_calibrated/pr1012_urdf_67b1b5a5.urdf'
SRDF = DATA + '/robots/pr2_description/srdf/robot.xml'
LASER = 'laser_tilt_mount_link'
STICK = (0.3, 0.8, 0.03)  # along the laser's x from and to, and how thick [m]
# From and to along x, y, z of base_footprint [m], and the laser's angle where the stick is in the middle of it [rad].
LUMPS = (((0.55, 0.65), (-0.1, 0.1), (1.10, 1.20), -0.04), ((0.45, 0.55), (-0.1, 0.1), (0.75, 0.85), 0.64))
WALL = ((2.0, 2.05), (-1.0, 1.0), (0.2, 1.8))
AWAY = 0.35            # angle of the laser from a lump when a map is sent: voxels in the stick are ignored [rad]
MAPS = 0.2             # between maps [s]
SWITCH = (6.3, 6.6)    # time in the bag, with the laser up: the second lump replaces the first [s]
SURE = 1e-3            # distances and overlaps below this are not judged [m]
STEP = 0.002           # between times that are judged [s]


def voxels(*box):
    ranges = [range(round(low / SIZE) + 32768, round(high / SIZE) + 32768) for low, high in box]
    return {(x, y, z): True for x in ranges[0] for y in ranges[1] for z in ranges[2]}


class Laser:
    """The angle of the laser about y over the bag's time, and its fixed axis in base_footprint."""

    def __init__(self):
        self.times, self.angles, self.axis, joints = [], [], [0.0, 0.0, 0.0], {}
        with rosbag.Bag(BAG) as bag:
            for _, transforms, _ in bag.read_messages(['/tf']):
                for sent in transforms.transforms:
                    joints[sent.child_frame_id.strip('/')] = sent
                    if sent.child_frame_id.strip('/') == LASER:
                        self.times.append(sent.header.stamp.to_sec())
                        self.angles.append(2.0 * math.atan2(sent.transform.rotation.y, sent.transform.rotation.w))
        frame = LASER
        while frame != 'base_footprint':
            shift = joints[frame].transform.translation
            self.axis = [a + b for a, b in zip(self.axis, (shift.x, shift.y, shift.z))]
            frame = joints[frame].header.frame_id.strip('/')

    def angle(self, when):
        """The angle at a time, linear between transforms."""
        k = min(max(bisect.bisect_right(self.times, when), 1), len(self.times) - 1)
        share = (when - self.times[k - 1]) / (self.times[k] - self.times[k - 1])
        return self.angles[k - 1] + share * (self.angles[k] - self.angles[k - 1])

    def apart(self, angle, lump):
        """Largest gap of stick and lump along any axis of either; negative: the smallest overlap [m].

        Both lie across the plane of x and z, in which the laser turns.
        """
        c, s = math.cos(angle), math.sin(angle)
        corners = [(self.axis[0] + x * c + z * s, self.axis[2] - x * s + z * c)
                   for x in STICK[:2] for z in (-STICK[2] / 2, STICK[2] / 2)]
        others = [(x, z) for x in lump[0] for z in lump[2]]
        gaps = []
        for axis in ((1.0, 0.0), (0.0, 1.0), (c, -s), (s, c)):
            mine, its = ([axis[0] * p[0] + axis[1] * p[1] for p in box] for box in (corners, others))
            gaps.append(max(min(its) - max(mine), min(mine) - max(its)))
        return max(gaps)


@unittest.skipUnless(all(map(os.path.exists, (BAG, URDF, SRDF))), 'SKIPPED: no ' + BAG)
class Pr2LiveMapTest(MasterCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        packages = os.environ.get('ROS_PACKAGE_PATH', '')
        os.environ['ROS_PACKAGE_PATH'] = DATA + '/robots:' + packages
        rospy.set_param('/use_sim_time', True)
        rospy.init_node('pr2_live_map_test', disable_signals=True)
        with open(URDF) as urdf, open(SRDF) as srdf:
            cls.monitor = cls.start_monitor('collision_monitor', urdf.read(), {
                'robot_description_semantic': srdf.read(), 'trigger': 'tf', 'rate': 1000.0,
                'octomap': {'topic': '/octomap', 'padding': 0.03}})
        cls.laser = Laser()
        cls.begin = cls.laser.times[0]
        cls.maps = rospy.Publisher('/octomap', Octomap, queue_size=1)
        cls.contacts = Recorder('/collision_monitor/contacts', ContactArray, PATIENCE)
        cls.states = Recorder('/collision_monitor/state', MonitorState, PATIENCE)
        cls.get_plan = wait_for_service('/collision_monitor/get_plan', GetPlan)
        end = time.monotonic() + PATIENCE
        while not cls.get_plan().success:
            assert time.monotonic() < end, 'no plan'
            time.sleep(0.1)

    def attach_stick(self):
        """Attaches the stick to the laser; it may touch the robot, whose arms are in the way."""
        middle, length = sum(STICK[:2]) / 2, STICK[1] - STICK[0]
        stick = SceneChange(operation=SceneChange.ATTACH, id='stick', link_name=LASER, touch_links=['*'],
                            pose=Pose(position=Point(middle, 0.0, 0.0), orientation=Quaternion(0, 0, 0, 1)),
                            primitives=[SolidPrimitive(type=SolidPrimitive.BOX,
                                                       dimensions=(length, STICK[2], STICK[2]))])
        answer = wait_for_service('/collision_monitor/update_scene', UpdateScene)(changes=[stick])
        self.assertTrue(answer.success, answer.message)
        return answer.scene_version

    def send_map(self, lump, count):
        """Sends a map that differs from the last one by a row of the wall. Other rows and lumps are free space."""
        rows = [voxels((2.0, 2.05), (-1.0, 1.0), (low, low + SIZE)) for low in (1.8, 1.8 + SIZE, 1.8 + 2 * SIZE)]
        free = [voxels(*LUMPS[lump is LUMPS[0]][:3])] + rows
        sent = message({**{key: False for part in free for key in part}, **voxels(*WALL), **rows[count % 3],
                        **voxels(*lump[:3])})
        sent.header = Header(stamp=rospy.Time.now(), frame_id='base_footprint')
        self.maps.publish(sent)

    def send_first_map(self, attached):
        """Sends a map before the bag plays, so that all links are prepared for maps."""
        start = time.monotonic()
        while not self.maps.get_num_connections():
            time.sleep(0.01)
        self.send_map(LUMPS[0], 0)
        while self.get_plan().plan.scene_version == attached:
            self.assertLess(time.monotonic() - start, PATIENCE, 'the first map is not taken')
            time.sleep(0.02)
        return time.monotonic() - start

    def send_maps(self, player):
        """Sends maps while the bag plays. Returns the first version with the second lump."""
        sent, last, second, before_second = 0, -math.inf, None, None
        end = time.monotonic() + PATIENCE
        while player.poll() is None:
            self.assertLess(time.monotonic(), end, 'the bag does not play')
            time.sleep(0.005)
            now = rospy.Time.now().to_sec() - self.begin
            if SWITCH[0] - 0.6 < now < SWITCH[0]:
                continue  # the last map with the first lump is being processed
            lump = LUMPS[now >= SWITCH[0]]
            angle = self.laser.angle(self.begin + now)
            if second is None and now >= SWITCH[0]:
                self.assertLess(now, SWITCH[1], 'the switch comes too late')
                if before_second is None:
                    before_second = self.contacts.messages[-1].scene_version
                else:
                    second = next((m.scene_version for m in reversed(self.contacts.messages)
                                   if m.scene_version > before_second), None)
                    continue
            elif now < 0 or now - last < MAPS or abs(angle - lump[3]) < AWAY:
                continue
            sent, last = sent + 1, now
            self.send_map(lump, sent)
        return second, sent

    def test_every_cycle_tells_where_the_stick_is_in_the_map(self):
        attached = self.attach_stick()
        first = self.send_first_map(attached)
        player = self.start('rosbag', 'play', '--quiet', '--clock', '--hz=200', '--delay=2', '--wait-for-subscribers',
                            '--topics', '/tf', '/joint_states', '--bags', BAG)
        second, sent = self.send_maps(player)
        time.sleep(1.0)
        self.assertIsNone(self.monitor.poll(), 'it has ended')
        self.assertIsNotNone(second)
        cycles = [m for m in self.contacts.messages if m.cycle.checked + m.cycle.skipped + m.cycle.not_checked > 0]
        states = [s for s in self.states.messages if s.cycle.run_time > 0.0]
        # Cycles cover the bag without a gap, as often as transforms come.
        for earlier, later in zip(cycles, cycles[1:]):
            self.assertEqual(earlier.header.stamp, later.cycle.start)
        self.assertLess(cycles[0].cycle.start.to_sec() - self.begin, 0.5)
        self.assertGreater(cycles[-1].header.stamp.to_sec(), self.laser.times[-1] - 0.1)
        self.assertGreater(len(cycles), 10 * len(self.laser.times) // 4)
        # Maps were adopted in the meantime.
        self.assertGreater(cycles[-1].scene_version, attached + sent // 2)
        times = sorted(1e3 * s.cycle.run_time for s in states)
        print('first map after %.1f s; %d cycles in %.1f s, %d maps, %d versions; a cycle %.2f ms, p99 %.2f, '
              'most %.2f' % (first, len(cycles), (cycles[-1].header.stamp - cycles[0].cycle.start).to_sec(), sent,
            cycles[-1].scene_version - attached, times[len(times) // 2], times[int(0.99 * len(times))], times[-1]))
        self.judge(cycles, attached, second)

    def judge(self, cycles, attached, second):
        """Judges the results for stick and map, by the spans of pairs: late transforms delay some."""
        def begin_of(version):
            return next(m.header.stamp.to_sec() for m in cycles if m.scene_version >= version)
        first, switch, switched = begin_of(attached + 1), self.begin + SWITCH[0], begin_of(second)
        said = [(p.checked_from.to_sec(), p.checked_until.to_sec(), p) for m in cycles for p in m.pairs
                if 'stick' in (p.body_a, p.body_b) and any(b.startswith('octomap/') for b in (p.body_a, p.body_b))]
        # Every overlap is reported.
        overlapping = 0
        end = min(self.laser.times[-1], cycles[-1].cycle.complete_until.to_sec())
        for i in range(int((end - first) / STEP)):
            when = first + STEP * i
            if switch < when < switched or self.laser.apart(self.laser.angle(when), LUMPS[when >= switch]) > -SURE:
                continue
            overlapping += 1
            self.assertTrue(any(since <= when <= until for since, until, _ in said), when - self.begin)
        # Every reported contact is an overlap, at that location.
        caught = [0, 0]
        for since, until, pair in said:
            if pair.verdict != Verdict.CONTACT:
                self.assertEqual(pair.verdict, Verdict.UNCERTAIN, pair.reason)
                continue
            which = int((since + until) / 2 >= switch)
            steps = 1 + int((until - since) / STEP)
            apart = [self.laser.apart(self.laser.angle(since + (until - since) * i / steps), LUMPS[which])
                     for i in range(steps + 1)]
            self.assertLess(min(apart), SURE, since - self.begin)
            caught[which] += 1
            at = (pair.deepest.position.x, pair.deepest.position.y, pair.deepest.position.z)
            for value, (low, high) in zip(at, LUMPS[which]):
                self.assertTrue(low - SURE < value < high + SURE, (at, LUMPS[which]))
        print('overlaps for %.2f s; caught in %d and %d spans' % (STEP * overlapping, *caught))
        self.assertGreater(STEP * overlapping, 0.5)
        self.assertGreater(min(caught), 10)


if __name__ == '__main__':
    unittest.main()
