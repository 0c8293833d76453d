#!/usr/bin/env python3
"""A map that is sent once, and whose stamp is not, or not yet, within the robot's transforms."""
import time
import unittest

import rospy

from monitor_case import MovingBalls, Recorder
from own_master import PATIENCE, MasterCase, sliders
from sdf_ccd.msg import ContactArray, Verdict
from voxel_maps import Octomap, message, touches_map, voxels_near

KINDS = ('free', 'occupied_near')
FREE = voxels_near(0.0, 0.0, 0.0, 0.2, is_occupied=False)


class EarlyMapTest(MasterCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        rospy.init_node('early_map_test', disable_signals=True)
        cls.maps = rospy.Publisher('/octomap', Octomap, queue_size=1, latch=True)
        cls.maps.publish(message({**FREE, **voxels_near(0.0, 0.0, 0.0, 0.05)}))
        for kind in KINDS:
            cls.start_monitor(kind, sliders(), {
                'shell': {'spacing': 0.002}, 'max_latency': 0.5,
                'octomap': {'topic': '/octomap', 'padding': 0.02, 'unknown': kind, 'unknown_distance': 0.4}})
        cls.contacts = {kind: Recorder('/%s/contacts' % kind, ContactArray, PATIENCE) for kind in KINDS}

    def assert_clear(self, kind):
        self.assertIsNotNone(self.contacts[kind].find_new(lambda m: m.verdict == Verdict.CLEAR, 10.0))

    def assert_touches(self, kind):
        self.assertIsNotNone(self.contacts[kind].find_new(touches_map, 10.0))

    def test_1_a_map_older_than_the_transforms_keeps_what_is_where_the_robot_is_now(self):
        for heard in self.contacts.values():
            self.assertIsNotNone(heard.find(lambda m: m.scene_version > 1))  # with the map
        type(self).robot = MovingBalls(other=(0.0, -5.0))
        time.sleep(1.0)
        for kind in KINDS:
            self.assert_touches(kind)
        self.robot.ball = 0.12  # between the occupied and the unknown voxels
        time.sleep(0.3)
        for kind in KINDS:  # unknown voxels that the robot fills are ignored: those of the other ball
            self.assert_clear(kind)
        self.robot.ball = 0.3
        time.sleep(0.3)
        self.assert_touches('occupied_near')  # unknown, near the robot's pose when that became known
        self.assert_clear('free')

    def test_2_a_map_ahead_of_the_transforms_is_processed_again_when_they_come(self):
        self.robot.ball = 0.0
        time.sleep(0.3)
        sent = message({**FREE, **voxels_near(0.3, 0.0, 0.0, 0.2, is_occupied=False),
                        **voxels_near(0.0, 0.0, 0.0, 0.05), **voxels_near(0.3, 0.0, 0.0, 0.05)})
        sent.header.stamp += rospy.Duration(2.0)
        self.maps.publish(sent)
        time.sleep(0.7)
        for kind in KINDS:  # the robot is not known to be at 0 at the stamp
            self.assert_touches(kind)
        self.robot.ball = 0.3
        time.sleep(2.0)
        for kind in KINDS:
            self.assert_clear(kind)
        self.robot.ball = 0.0
        time.sleep(0.3)
        for kind in KINDS:
            self.assert_touches(kind)


if __name__ == '__main__':
    unittest.main()
