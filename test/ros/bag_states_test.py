#!/usr/bin/env python3
"""Tests whether bag.launch starts a robot_state_publisher if the bag needs one."""
import math
import os
import runpy
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

import rosbag
import rospy
from geometry_msgs.msg import TransformStamped
from sensor_msgs.msg import JointState
from tf2_msgs.msg import TFMessage

PROGRAM = sys.argv.pop(1)
ELBOW = '''<robot name="r"><!-- two -- hyphens --><link name="base"/><link name="arm"/>
<joint name="elbow" type="continuous"><parent link="base"/><child link="arm"/></joint>%s</robot>'''
URDF = ELBOW % ''
WITH_TOOL = ELBOW % '''<joint name="flange" type="fixed"><parent link="arm"/><child link="tool"/>
<origin xyz="1 2 3" rpy="0.1 0.2 0.3"/></joint>'''


class BagStatesTest(unittest.TestCase):
    def says(self, messages, urdf=URDF):
        with tempfile.TemporaryDirectory() as directory:
            bag_path, urdf_path = os.path.join(directory, 'a.bag'), os.path.join(directory, 'a.urdf')
            with open(urdf_path, 'w') as file:
                file.write(urdf)
            with rosbag.Bag(bag_path, 'w') as bag:
                for topic, message in messages:
                    bag.write(topic, message, rospy.Time(1.0))
            return subprocess.run([sys.executable, PROGRAM, bag_path, urdf_path, '--dry-run'], check=True,
                                  stdout=subprocess.PIPE, universal_newlines=True).stdout

    def transform(self, child):
        return '/tf', TFMessage([TransformStamped(child_frame_id=child)])

    def test_joint_states_alone_need_one(self):
        others = ('/gripper/joint_states', JointState(name=['finger']))
        mine = ('/arm/joint_states', JointState(name=['elbow']))
        self.assertIn('follows /arm/joint_states', self.says([others, mine]))
        self.assertIn('follows /arm/joint_states', self.says([mine, self.transform('camera')]))

    def test_a_moving_base_does_not_move_the_arm(self):
        mine = ('/joint_states', JointState(name=['elbow']))
        self.assertIn('follows /joint_states', self.says([mine, self.transform('base')]))

    def test_transforms_need_none(self):
        mine = ('/joint_states', JointState(name=['elbow']))
        self.assertIn('needs no', self.says([mine, self.transform('/arm')]))

    def test_missing_fixed_links_are_published(self):
        static = '/tf_static', TFMessage([TransformStamped(child_frame_id='tool')])
        self.assertIn('lacks the fixed links tool', self.says([self.transform('arm')], WITH_TOOL))
        self.assertNotIn('fixed', self.says([self.transform('arm'), static], WITH_TOOL))
        self.assertNotIn('fixed', self.says([self.transform('tb1/arm')], WITH_TOOL), 'tf is about another robot')
        mine = ('/joint_states', JointState(name=['elbow']))
        self.assertNotIn('fixed', self.says([mine], WITH_TOOL), 'robot_state_publisher publishes them')

    def test_fixed_links_are_where_the_urdf_has_them(self):
        joint = ElementTree.fromstring(WITH_TOOL.replace('<!-- two -- hyphens -->', '')).findall('joint')[1]
        transform = runpy.run_path(PROGRAM)['fixed_transform'](joint)
        self.assertEqual((transform.header.frame_id, transform.child_frame_id), ('arm', 'tool'))
        p, q = transform.transform.translation, transform.transform.rotation
        self.assertEqual((p.x, p.y, p.z), (1, 2, 3))
        # The images of the axes x and z under Rz(0.3) Ry(0.2) Rx(0.1).
        c, s = math.cos, math.sin
        self.assertAlmostEqual(1 - 2 * (q.y**2 + q.z**2), c(0.3) * c(0.2))
        self.assertAlmostEqual(2 * (q.x * q.y + q.z * q.w), s(0.3) * c(0.2))
        self.assertAlmostEqual(2 * (q.x * q.z - q.y * q.w), -s(0.2))
        self.assertAlmostEqual(2 * (q.y * q.z - q.x * q.w), s(0.3) * s(0.2) * c(0.1) - c(0.3) * s(0.1))
        self.assertAlmostEqual(1 - 2 * (q.x**2 + q.y**2), c(0.2) * c(0.1))

    def test_nothing_to_follow(self):
        self.assertIn('needs no', self.says([('/joint_states', JointState(name=['finger']))]))


if __name__ == '__main__':
    unittest.main()
