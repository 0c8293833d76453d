#!/usr/bin/env python3
"""Runs bag.launch to the end of its bag, twice: with fields that have to be built, and with cached fields.

usage: bag_launch_test.py SOURCE_DIRECTORY
"""
import os
import subprocess
import sys
import tempfile
import unittest

import rosbag
import rospy
from sensor_msgs.msg import JointState

from own_master import use_own_master
from sdf_ccd.msg import Verdict

SOURCE = os.path.abspath(sys.argv.pop())
RATE, SECONDS = 50.0, 4.0  # of the bag
PATIENCE = 120.0           # [s]


def write_bag(path):
    """The arm turns its hand, which points down, through the plate and back."""
    with rosbag.Bag(path, 'w') as bag:
        for i in range(int(RATE * SECONDS)):
            stamp = rospy.Time(1000) + rospy.Duration(i / RATE)
            yaw = 0.2 + 0.4 * min(i, RATE * SECONDS - i) / (0.5 * RATE * SECONDS)
            message = JointState(name=['yaw', 'shoulder', 'elbow', 'wrist', 'roll'],
                                 position=[yaw, -1.05466, 1.58121, 1.04425, 0.0])
            message.header.stamp = stamp
            bag.write('joint_states', message, stamp)


class BagLaunch(unittest.TestCase):
    def test_ends_with_its_bag_whether_the_fields_are_cached_or_not(self):
        with tempfile.TemporaryDirectory() as folder:
            bag, config, record = (os.path.join(folder, name) for name in ('arm.bag', 'arm.yaml', 'contacts.bag'))
            write_bag(bag)
            with open(SOURCE + '/config/demo/world.yaml') as world, open(config, 'w', encoding='utf-8') as out:
                out.write(world.read() + 'field: {cell_size: 0.006}\nshell: {spacing: 0.003}\n'
                          'cache_directory: %s/cache\nallowed_pairs: [[hand, Tür]]\n' % folder)
            use_own_master(ROS_HOME=folder, LC_ALL='C', PYTHONUTF8='1')
            for start in ('first', 'second'):
                ended = subprocess.run(
                    ['roslaunch', 'sdf_ccd', 'bag.launch', 'bag:=' + bag, 'urdf:=' + SOURCE + '/config/demo/arm.urdf',
                     'config:=' + config, 'rviz:=false', 'player_required:=true', 'record:=' + record],
                    timeout=PATIENCE, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, encoding='utf-8')
                log = ended.stdout
                with rosbag.Bag(record) as contacts:
                    verdicts = [message.verdict for _, message, _ in
                                contacts.read_messages('/collision_monitor/contacts')]
                self.assertIn('no body is named Tür', log)
                self.assertIn(Verdict.CONTACT, verdicts, start + '\n' + log)
                self.assertIn(Verdict.CLEAR, verdicts, start + '\n' + log)
                os.remove(record)


if __name__ == '__main__':
    unittest.main()
