#!/usr/bin/env python3
"""Three monitors of one live map, each with a different treatment of unknown space."""
import time
import unittest

import rospy

from monitor_case import MovingBalls, Recorder
from own_master import PATIENCE, MasterCase, sliders
from sdf_ccd.msg import ContactArray, Verdict
from voxel_maps import Octomap, message, touches_map, voxels_near

NEAR = 0.3  # octomap/unknown_distance [m]
KINDS = ('free', 'occupied', 'occupied_near')


def known():
    """Free around 0 and 1.0 along x, where a ball of 0.02 m is 0.1 m from unknown space; a lump at 1.25.

    Tiles of 18 voxels begin at -0.4 m: those with known voxels reach from there to 1.4 m along x, and to 0.5 m
    along y and z.
    """
    return {**voxels_near(0.0, 0.0, 0.0, 0.15, is_occupied=False),
            **voxels_near(1.0, 0.0, 0.0, 0.15, is_occupied=False), **voxels_near(1.25, 0.0, 0.0, 0.05)}


class UnknownSpaceTest(MasterCase):
    lump = 0.0  # height of the last one [m]; what was occupied stays so

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        rospy.init_node('unknown_space_test', disable_signals=True)
        for kind in KINDS:
            cls.start_monitor(kind, sliders(), {
                'shell': {'spacing': 0.002}, 'max_latency': 2.0,
                'octomap': {'topic': '/octomap', 'padding': 0.02, 'unknown': kind, 'unknown_distance': NEAR}})
        cls.robot = MovingBalls(other=(0.0, -5.0))
        cls.maps = rospy.Publisher('/octomap', Octomap, queue_size=1, latch=True)
        cls.contacts = {kind: Recorder('/%s/contacts' % kind, ContactArray, PATIENCE) for kind in KINDS}
        for kind in KINDS:
            assert cls.contacts[kind].find(lambda m: m.unchecked and not m.reason.startswith('waiting')), kind

    def map_from(self, x):
        """Sends a new map while the ball is at x, and waits until it is used."""
        self.robot.ball = x
        time.sleep(0.3)
        last = {kind: self.contacts[kind].find_new(lambda m: True).scene_version for kind in KINDS}
        # It differs where the ball never goes, so that it is a new map for all monitors.
        type(self).lump += 0.1
        self.maps.publish(message({**known(), **voxels_near(0.9, 0.0, 0.1 + self.lump, 0.05)}))
        for kind in KINDS:
            self.assertIsNotNone(self.contacts[kind].find(lambda m: m.scene_version > last[kind]), kind)

    def verdicts_at(self, x):
        """The monitors that report that the ball at x touches the map; the others report CLEAR."""
        self.robot.ball = x
        time.sleep(0.3)
        there, touched = rospy.Time.now(), []
        for kind in KINDS:
            found = self.contacts[kind].find_new(
                lambda m: m.cycle.start > there and (touches_map(m) or m.verdict == Verdict.CLEAR))
            self.assertIsNotNone(found, (x, kind))
            if touches_map(found):
                touched.append(kind)
        return touched

    def test_what_is_not_known_is_what_the_parameter_says(self):
        self.map_from(0.0)
        for x, touched in ((0.0, []), (0.25, ['occupied', 'occupied_near']), (0.6, ['occupied']), (1.0, []),
                           (1.25, list(KINDS)), (-0.3, ['occupied', 'occupied_near']), (-0.8, []), (1.7, [])):
            self.assertEqual(self.verdicts_at(x), touched, x)

    def test_near_is_near_where_the_robot_was_at_the_maps_stamp(self):
        self.map_from(1.0)
        for x, touched in ((0.25, ['occupied']), (0.8, ['occupied', 'occupied_near']), (1.0, []), (0.0, [])):
            self.assertEqual(self.verdicts_at(x), touched, x)
        # At its present pose it does not touch its own voxels.
        self.map_from(0.6)
        self.assertEqual(self.verdicts_at(0.6), [])
        self.assertEqual(self.verdicts_at(0.75), ['occupied', 'occupied_near'])


if __name__ == '__main__':
    unittest.main()
