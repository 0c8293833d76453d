#!/usr/bin/env python3
"""Sends maps of voxels to a running monitor, as octomap_server does, from a bag too."""
import math
import os
import struct
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import genpy.dynamic
import rosbag
import rospy
import rostest
from geometry_msgs.msg import TransformStamped
from std_msgs.msg import Header
from tf2_msgs.msg import TFMessage

from sdf_ccd.msg import ContactArray
from sdf_ccd.srv import GetPlan

PERIOD, SIZE = 0.02, 0.05  # [s], of a voxel [m]
DEFINITION = """Header header
bool binary
string id
float64 resolution
int8[] data
================================================================================
MSG: std_msgs/Header
uint32 seq
time stamp
string frame_id
"""
Octomap = genpy.dynamic.generate_dynamic('octomap_msgs/Octomap', DEFINITION)['octomap_msgs/Octomap']


def grouped(voxels, level):
    children = [{} for _ in range(8)]
    half = 1 << (level - 1)
    for (x, y, z), occupied in voxels.items():
        i = (x >= half) + 2 * (y >= half) + 4 * (z >= half)
        children[i][(x % half, y % half, z % half)] = occupied
    return children


def binary(voxels, level=16):
    """As OcTree::writeBinaryData()."""
    children = grouped(voxels, level)
    bits, rest = 0, b''
    for i, child in enumerate(children):
        if child and level == 1:
            bits |= (2 if child[(0, 0, 0)] else 1) << 2 * i
        elif child:
            bits |= 3 << 2 * i
            rest += binary(child, level - 1)
    return struct.pack('<H', bits) + rest


def full(voxels, level=16):
    """As OcTree::writeData()."""
    if level == 0:
        return struct.pack('<fB', 0.85 if voxels[(0, 0, 0)] else -0.4, 0)
    children = grouped(voxels, level)
    mask = sum(1 << i for i, child in enumerate(children) if child)
    return struct.pack('<fB', 0.85, mask) + b''.join(full(child, level - 1) for child in children if child)


def voxels_near(x, y, z, radius):
    """Those whose centres are."""
    reach = int(radius / SIZE) + 1
    middle = [int(math.floor(c / SIZE)) for c in (x, y, z)]
    near = {}
    for dx in range(-reach, reach + 1):
        for dy in range(-reach, reach + 1):
            for dz in range(-reach, reach + 1):
                v = (middle[0] + dx, middle[1] + dy, middle[2] + dz)
                if math.dist([SIZE * (c + 0.5) for c in v], (x, y, z)) <= radius:
                    near[tuple(32768 + c for c in v)] = True
    return near


def message(voxels, is_binary=True, frame='base'):
    data = binary(voxels) if is_binary else full(voxels)
    return Octomap(header=Header(stamp=rospy.Time.now(), frame_id=frame), binary=is_binary, id='OcTree',
                   resolution=SIZE, data=list(struct.unpack('%db' % len(data), data)))


class MapTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.condition, cls.contacts = threading.Condition(), []
        cls.place = 0.0
        cls.tf = rospy.Publisher('/tf', TFMessage, queue_size=1000)
        cls.maps = rospy.Publisher('/octomap', Octomap, queue_size=1, latch=True)
        rospy.Subscriber('/collision_monitor/contacts', ContactArray, cls.keep, queue_size=1000)
        rospy.wait_for_service('/collision_monitor/get_plan', 60.0)
        cls.get_plan = rospy.ServiceProxy('/collision_monitor/get_plan', GetPlan)
        threading.Thread(target=cls.move, daemon=True).start()
        assert cls.find(lambda m: m.complete_until == m.header.stamp and m.reason == '' or m.pairs == [], 60.0)

    @classmethod
    def keep(cls, message):
        with cls.condition:
            cls.contacts.append(message)
            cls.condition.notify_all()

    @classmethod
    def move(cls):
        while not rospy.is_shutdown():
            transforms = TFMessage()
            for frame, x, y in (('ball', cls.place, 0.0), ('other', 0.0, 0.5)):
                transform = TransformStamped(header=Header(stamp=rospy.Time.now(), frame_id='base'),
                                             child_frame_id=frame)
                transform.transform.translation.x, transform.transform.translation.y = x, y
                transform.transform.rotation.w = 1.0
                transforms.transforms.append(transform)
            cls.tf.publish(transforms)
            time.sleep(PERIOD)

    @classmethod
    def find(cls, test, timeout=8.0):
        """The first message from now on that passes the test; None if none comes in time."""
        end = time.monotonic() + timeout
        with cls.condition:
            del cls.contacts[:]
            seen = 0
            while True:
                for said in cls.contacts[seen:]:
                    if test(said):
                        return said
                seen = len(cls.contacts)
                if not cls.condition.wait(max(0.0, end - time.monotonic())):
                    return None

    def version(self):
        return self.get_plan().plan.scene_version

    def send(self, sent):
        """Until the cycles have it."""
        before = self.version()
        self.maps.publish(sent)
        found = self.find(lambda m: m.scene_version > before)
        self.assertIsNotNone(found, 'the map is not taken')
        return found.scene_version

    def setUp(self):
        MapTest.place = 0.0
        time.sleep(0.3)

    def touches_map(self, m):
        return any(p.verdict == p.CONTACT and 'ball' in (p.body_a, p.body_b) and
                   any(b.startswith('octomap/') for b in (p.body_a, p.body_b)) for p in m.pairs)

    def test_a_map_is_checked_and_its_next_one_too(self):
        version = self.send(message(voxels_near(0.5, 0.0, 0.0, 0.1)))
        self.assertIsNotNone(self.find(lambda m: m.scene_version == version and m.verdict == m.CLEAR))
        MapTest.place = 0.5
        self.assertIsNotNone(self.find(self.touches_map))
        # It is gone from there, and elsewhere.
        version = self.send(message(voxels_near(0.0, -0.5, 0.0, 0.1)))
        self.assertIsNotNone(self.find(lambda m: m.scene_version == version and m.verdict == m.CLEAR))

    def test_what_the_robot_fills_does_not_count(self):
        MapTest.place = 0.9
        time.sleep(0.3)
        picture = voxels_near(0.0, 0.0, 0.0, 0.05)
        self.send(message(picture))  # nobody is there
        MapTest.place = 0.0
        self.assertIsNotNone(self.find(self.touches_map))
        time.sleep(0.3)
        version = self.send(message({**picture, **voxels_near(0.5, 0.0, 0.0, 0.05)}))
        self.assertIsNotNone(self.find(lambda m: m.scene_version == version and m.verdict == m.CLEAR))

    def test_the_full_format(self):
        self.send(message(voxels_near(0.3, 0.0, 0.0, 0.1), is_binary=False))
        MapTest.place = 0.3
        self.assertIsNotNone(self.find(self.touches_map))

    def test_a_map_from_a_bag(self):
        file = os.path.join(tempfile.mkdtemp(), 'map.bag')
        with rosbag.Bag(file, 'w') as bag:
            bag.write('/octomap', message(voxels_near(0.7, 0.0, 0.0, 0.1)))
        before = self.version()
        subprocess.check_call(['rosbag', 'play', '-q', '-d', '1', '--wait-for-subscribers', '--topics', '/octomap',
                               '--bags', file], stdout=subprocess.DEVNULL)
        self.assertIsNotNone(self.find(lambda m: m.scene_version > before))
        MapTest.place = 0.7
        self.assertIsNotNone(self.find(self.touches_map))

    def test_a_damaged_map_changes_nothing(self):
        self.send(message(voxels_near(0.5, 0.0, 0.0, 0.1)))
        before = self.version()
        for spoil in (lambda m: m.data.pop(), lambda m: m.data.extend([0] * 9),
                      lambda m: setattr(m, 'resolution', float('nan')), lambda m: setattr(m, 'id', 'Nonsense'),
                      lambda m: setattr(m, 'data', [-1] * 1000)):
            bad = message(voxels_near(0.2, 0.0, 0.0, 0.1))
            spoil(bad)
            self.maps.publish(bad)
            time.sleep(0.2)
        self.assertEqual(self.version(), before)
        MapTest.place = 0.5
        self.assertIsNotNone(self.find(self.touches_map))


if __name__ == '__main__':
    rospy.init_node('map_test')
    rostest.rosrun('sdf_ccd', 'map', MapTest, sys.argv)
