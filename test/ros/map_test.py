#!/usr/bin/env python3
"""Sends voxel maps to a running monitor, like octomap_server, also from a bag."""
import os
import subprocess
import sys
import tempfile
import time
import unittest

import rosbag
import rospy
import rostest

from monitor_case import MovingBalls, Recorder, box, pose, touches, wait_for_service
from sdf_ccd.msg import ContactArray, Plan, SceneChange, Verdict
from sdf_ccd.srv import GetPlan, UpdateScene
from voxel_maps import Octomap, message, touches_map, voxels_near


class MapTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.robot = MovingBalls()
        cls.maps = rospy.Publisher('/octomap', Octomap, queue_size=1, latch=True)
        cls.contacts = Recorder('/collision_monitor/contacts', ContactArray, 8.0)
        cls.get_plan = wait_for_service('/collision_monitor/get_plan', GetPlan)
        assert cls.contacts.find_new(
            lambda m: m.cycle.complete_until == m.header.stamp and m.reason == '' or m.pairs == [], 60.0)

    def version(self):
        return self.get_plan().plan.scene_version

    shown = set()  # voxels that were ever occupied

    def map_of(self, voxels):
        """A map of these voxels, in which all others that were shown before are free."""
        free = {voxel: False for voxel in self.shown}
        self.shown.update(voxels)
        return message({**free, **voxels})

    def send(self, sent):
        """Sends a map and waits until the cycles use it. Returns the scene version."""
        before = self.version()
        self.maps.publish(sent)
        found = self.contacts.find_new(lambda m: m.scene_version > before)
        self.assertIsNotNone(found, 'the map is not taken')
        return found.scene_version

    def setUp(self):
        self.robot.ball = 0.0
        time.sleep(0.3)

    def find_clear(self, version):
        return self.contacts.find_new(lambda m: m.scene_version == version and m.verdict == Verdict.CLEAR)

    def find_touching_map(self):
        return self.contacts.find_new(touches_map)

    def test_a_map_is_checked_and_its_next_one_too(self):
        version = self.send(self.map_of(voxels_near(0.5, 0.0, 0.0, 0.1)))
        self.assertIsNotNone(self.find_clear(version))
        self.robot.ball = 0.5
        self.assertIsNotNone(self.find_touching_map())
        # The map is replaced by one elsewhere.
        version = self.send(self.map_of(voxels_near(0.0, -0.5, 0.0, 0.1)))
        self.assertIsNotNone(self.find_clear(version))

    def test_what_the_robot_fills_does_not_count(self):
        self.robot.ball = 0.9
        time.sleep(0.3)
        picture = voxels_near(0.0, 0.0, 0.0, 0.05)
        self.send(self.map_of(picture))  # the ball is not there
        self.robot.ball = 0.0
        self.assertIsNotNone(self.find_touching_map())
        time.sleep(0.3)
        far = voxels_near(0.5, 0.0, 0.0, 0.05)
        self.send(self.map_of({**picture, **far}))
        self.assertIsNotNone(self.find_touching_map())  # it was there before the ball
        version = self.send(self.map_of(far))
        self.assertIsNotNone(self.find_clear(version))
        version = self.send(self.map_of({**picture, **voxels_near(0.6, 0.0, 0.0, 0.05)}))
        self.assertIsNotNone(self.find_clear(version))  # it has become occupied beside the ball

    def test_the_full_format(self):
        lump = voxels_near(0.3, 0.0, 0.0, 0.1)
        self.send(message({**{voxel: False for voxel in self.shown}, **lump}, is_binary=False))
        self.shown.update(lump)
        self.robot.ball = 0.3
        self.assertIsNotNone(self.find_touching_map())

    def test_the_plan_is_that_of_the_last_map(self):
        plans = Recorder('/collision_monitor/plan', Plan)
        for x in (0.3, 0.4, 0.5):
            version = self.send(self.map_of(voxels_near(x, 0.0, 0.0, 0.05)))
        self.assertIsNotNone(plans.find(lambda m: m.scene_version == version))
        plans.close()

    def test_what_slides_over_tiles_is_one_contact(self):
        wall = {(32768 + x, 32768 + y, 32768 + z): True for x in range(8, 30) for y in range(-2, 2)
                for z in range(-2, 2)}
        self.send(self.map_of(wall))
        self.robot.ball = 0.45
        self.assertIsNotNone(self.find_touching_map())
        self.contacts.clear()
        for x in range(45, 110, 5):  # a tile ends at 0.5
            self.robot.ball = 0.01 * x
            time.sleep(0.1)
        heard = self.contacts.messages
        tiles = {b for m in heard for p in m.pairs for b in (p.body_a, p.body_b) if b.startswith('octomap/')}
        self.assertEqual(tiles, {'octomap/-1_-1_-1', 'octomap/0_-1_-1'})
        contacts = [c for m in heard for c in m.contacts if 'ball' in (c.body_a, c.body_b)]
        self.assertEqual(len({c.id for c in contacts}), 1)
        self.assertEqual({c.body_a for c in contacts} | {c.body_b for c in contacts}, {'ball', 'octomap'})
        self.assertFalse(any(c.ends for c in contacts))
        self.robot.ball = 0.0
        self.assertIsNotNone(self.contacts.find_new(
            lambda m: any(c.id == contacts[0].id and c.ends for c in m.contacts)))

    def test_no_object_takes_a_tiles_name(self):
        update = wait_for_service('/collision_monitor/update_scene', UpdateScene)
        self.send(self.map_of(voxels_near(0.5, 0.0, 0.0, 0.05)))
        for name in ('octomap/0_-1_-1', 'octomap/1_0_0'):  # a present tile, and a possible one
            answer = update(changes=[box(name, pose(0.0, 3.0))])
            self.assertFalse(answer.success)
            self.assertIn('live map', answer.message)
        # An object may have the name of the map, and is not taken for it.
        self.assertTrue(update(changes=[box('octomap', pose(0.0, 0.03))]).success)
        self.assertIsNotNone(self.contacts.find_new(lambda m: touches(m, 'ball', 'octomap')))
        touching = self.contacts.messages[-1].contacts[0]
        self.assertTrue(update(changes=[SceneChange(operation=SceneChange.REMOVE, id='octomap')]).success)
        self.send(self.map_of(voxels_near(0.9, 0.0, 0.0, 0.05)))
        self.robot.ball = 0.9
        found = self.contacts.find_new(lambda m: touches_map(m) and m.contacts)
        self.assertIsNotNone(found)
        self.assertNotEqual(found.contacts[0].id, touching.id)

    def test_a_map_from_a_bag(self):
        file = os.path.join(tempfile.mkdtemp(), 'map.bag')
        with rosbag.Bag(file, 'w') as bag:
            bag.write('/octomap', self.map_of(voxels_near(0.7, 0.0, 0.0, 0.1)))
        before = self.version()
        subprocess.check_call(['rosbag', 'play', '-q', '-d', '1', '--wait-for-subscribers', '--topics', '/octomap',
                               '--bags', file], stdout=subprocess.DEVNULL)
        self.assertIsNotNone(self.contacts.find_new(lambda m: m.scene_version > before))
        self.robot.ball = 0.7
        self.assertIsNotNone(self.find_touching_map())

    def test_a_damaged_map_changes_nothing(self):
        self.send(self.map_of(voxels_near(0.5, 0.0, 0.0, 0.1)))
        before = self.version()
        for spoil in (lambda m: m.data.pop(), lambda m: m.data.extend([0] * 9),
                      lambda m: setattr(m, 'resolution', float('nan')), lambda m: setattr(m, 'id', 'Nonsense'),
                      lambda m: setattr(m, 'data', [-1] * 1000)):
            bad = message(voxels_near(0.2, 0.0, 0.0, 0.1))
            spoil(bad)
            self.maps.publish(bad)
            time.sleep(0.2)
        self.assertEqual(self.version(), before)
        self.robot.ball = 0.5
        self.assertIsNotNone(self.find_touching_map())


if __name__ == '__main__':
    rospy.init_node('map_test')
    rostest.rosrun('sdf_ccd', 'map', MapTest, sys.argv)
