#!/usr/bin/env python3
"""Tests whether bag.launch starts a robot_state_publisher if the bag needs one."""
import os
import subprocess
import sys
import tempfile
import unittest

import rosbag
import rospy
from geometry_msgs.msg import TransformStamped
from sensor_msgs.msg import JointState
from tf2_msgs.msg import TFMessage

PROGRAM = sys.argv.pop(1)
URDF = '''<robot name="r"><!-- two -- hyphens --><link name="base"/><link name="arm"/>
<joint name="elbow" type="continuous"><parent link="base"/><child link="arm"/></joint></robot>'''


class BagStatesTest(unittest.TestCase):
    def says(self, messages):
        with tempfile.TemporaryDirectory() as directory:
            bag_path, urdf_path = os.path.join(directory, 'a.bag'), os.path.join(directory, 'a.urdf')
            with open(urdf_path, 'w') as file:
                file.write(URDF)
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

    def test_nothing_to_follow(self):
        self.assertIn('needs no', self.says([('/joint_states', JointState(name=['finger']))]))


if __name__ == '__main__':
    unittest.main()
