#!/usr/bin/env python3
"""A map that is sent once, before the robot's poses are known."""
import time
import unittest

import rospy

from monitor_case import MovingBalls, Recorder
from own_master import PATIENCE, MasterCase, sliders
from sdf_ccd.msg import ContactArray
from voxel_maps import Octomap, message, touches_map, voxels_near

KINDS = ('free', 'occupied_near')


class EarlyMapTest(MasterCase):
    def test_is_taken_again_when_the_robots_transforms_come(self):
        rospy.init_node('early_map_test', disable_signals=True)
        maps = rospy.Publisher('/octomap', Octomap, queue_size=1, latch=True)
        maps.publish(message({**voxels_near(0.0, 0.0, 0.0, 0.2, is_occupied=False), **voxels_near(0.0, 0.0, 0.0, 0.05)}))
        for kind in KINDS:
            self.start_monitor(kind, sliders(), {
                'shell': {'spacing': 0.002}, 'max_latency': 2.0,
                'octomap': {'topic': '/octomap', 'padding': 0.02, 'unknown': kind, 'unknown_distance': 0.4}})
        contacts = {kind: Recorder('/%s/contacts' % kind, ContactArray, PATIENCE) for kind in KINDS}
        for heard in contacts.values():
            self.assertIsNotNone(heard.find(lambda m: m.scene_version > 1))  # with the map
        robot = MovingBalls(other=(0.0, -5.0))
        for heard in contacts.values():  # the robot's own voxels are ignored
            self.assertIsNotNone(heard.find_new(lambda m: m.verdict == m.CLEAR, 10.0))
        robot.ball = 0.3
        time.sleep(0.3)
        self.assertIsNotNone(contacts['occupied_near'].find_new(touches_map, 10.0))  # unknown, near its pose then
        self.assertIsNotNone(contacts['free'].find_new(lambda m: m.verdict == m.CLEAR, 10.0))


if __name__ == '__main__':
    unittest.main()
