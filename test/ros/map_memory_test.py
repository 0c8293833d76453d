#!/usr/bin/env python3
"""A live map that the robot creeps into, and known objects in it: what was there before the robot stays an obstacle."""
import threading
import time
import unittest

import rospy
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from dynamic_reconfigure.client import Client
from geometry_msgs.msg import Point, Pose, Quaternion
from shape_msgs.msg import SolidPrimitive
from std_srvs.srv import Empty

from monitor_case import MovingBalls, Recorder, wait_for_service
from own_master import PATIENCE, MasterCase, sliders
from sdf_ccd.msg import ContactArray, MonitorState, SceneChange, Verdict
from sdf_ccd.srv import UpdateScene
from voxel_maps import Octomap, message, touches_map

PADDING = 0.03


def block(low, high, is_occupied=True):
    """Voxels from and to these indices along x, and around the x axis."""
    return {(32768 + x, 32768 + y, 32768 + z): is_occupied for x in range(low, high) for y in (-1, 0)
            for z in (-1, 0)}


WALL = block(6, 10)  # from 0.3 to 0.5 m


class MapMemoryTest(MasterCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        rospy.init_node('map_memory_test', disable_signals=True)
        cls.start_monitor('monitor', sliders(), {
            'shell': {'spacing': 0.002}, 'max_latency': 2.0, 'stop_distance': 0.005,
            'octomap': {'topic': '/map', 'padding': PADDING},
            'requests': {'allow': ['add', 'move', 'attach', 'rules', 'clear', 'reset', 'limits']}})
        cls.robot = MovingBalls(other=(0.0, -5.0))
        cls.maps = rospy.Publisher('/map', Octomap, queue_size=1)
        cls.contacts = Recorder('/monitor/contacts', ContactArray, PATIENCE)
        cls.states = Recorder('/monitor/state', MonitorState, PATIENCE)
        cls.update = wait_for_service('/monitor/update_scene', UpdateScene)
        cls.reset = wait_for_service('/monitor/reset', Empty)
        cls.voxels, cls.ends = {}, threading.Event()
        cls.sender = threading.Thread(target=cls.send, daemon=True)
        cls.sender.start()
        assert cls.contacts.find(lambda m: m.reason.startswith('no map') or m.unchecked, PATIENCE)

    @classmethod
    def tearDownClass(cls):
        cls.ends.set()
        cls.sender.join()
        super().tearDownClass()

    @classmethod
    def send(cls):
        while not cls.ends.wait(0.1):
            if cls.voxels:
                cls.maps.publish(message(cls.voxels))

    def setUp(self):
        """The map anew, with the ball beside it."""
        self.robot.ball = 0.0
        type(self).voxels = block(-4, 20, False)
        self.assertIsNotNone(self.contacts.find_new(lambda m: m.verdict == Verdict.CLEAR, 20.0))
        time.sleep(0.3)

    def show(self, voxels):
        type(self).voxels = {**block(-4, 20, False), **voxels}
        time.sleep(0.8)

    def creep(self, start, end, speed):
        begin = time.monotonic()
        while abs(self.robot.ball - end) > 1e-9:
            done = min(1.0, speed * (time.monotonic() - begin) / abs(end - start))
            self.robot.ball = start + (end - start) * done
            time.sleep(0.005)

    def test_whoever_creeps_into_the_map_touches_it(self):
        self.show(WALL)
        self.contacts.clear()
        self.states.clear()
        self.creep(0.2, 0.4, 0.1)  # 0.01 m from one map to the next, a third of the padding
        time.sleep(0.5)
        self.assertTrue([m for m in self.contacts.messages if touches_map(m)])
        last = self.contacts.find_new(lambda m: True)
        self.assertTrue(touches_map(last), 'it is still in the wall')
        state = self.states.find_new(lambda m: True)
        self.assertEqual(state.proximity, state.STOP)
        self.assertEqual(state.map_voxels_unproven, 0)
        # Unknown is not free.
        type(self).voxels = block(-4, 0, False)
        time.sleep(0.8)
        self.assertTrue(touches_map(self.contacts.find_new(lambda m: True)))
        self.show({})
        self.assertIsNotNone(self.contacts.find_new(lambda m: m.verdict == Verdict.CLEAR, 10.0))

    def test_what_becomes_occupied_beside_the_robot_is_its_picture(self):
        self.show(block(-1, 1))
        self.assertIsNotNone(self.contacts.find_new(lambda m: m.verdict == Verdict.CLEAR, 10.0))
        self.assertEqual(self.states.find_new(lambda m: True).map_voxels_unproven, 0)

    def test_what_the_first_map_shows_beside_the_robot_is_counted(self):
        diagnostics = Recorder('/diagnostics', DiagnosticArray, PATIENCE)
        self.show(WALL)
        type(self).voxels = {}
        self.robot.ball = 0.4
        time.sleep(0.5)
        self.reset()
        time.sleep(0.5)
        self.show(WALL)
        found = self.states.find_new(lambda m: m.map_voxels_unproven > 0, 10.0)
        self.assertIsNotNone(found)
        self.assertIn('obstacles may be among them', ' '.join(found.warnings))
        self.assertIsNotNone(diagnostics.find_new(
            lambda m: any(s.level == DiagnosticStatus.WARN and
                          any('obstacles may be among them' in v.value for v in s.values) for s in m.status), 10.0))
        self.robot.ball = 0.0
        self.assertIsNotNone(self.states.find_new(
            lambda m: m.map_voxels_unproven == 0 and 'obstacles may be' not in ' '.join(m.warnings), 10.0))
        self.robot.ball = 0.4
        self.assertIsNotNone(self.contacts.find_new(touches_map, 10.0))
        time.sleep(0.5)
        self.assertTrue(touches_map(self.contacts.find_new(lambda m: True)), 'now it is known to be an obstacle')
        diagnostics.close()

    def test_voxels_of_a_known_object_follow_its_rule(self):
        self.show(WALL)
        cup = SceneChange(operation=SceneChange.ADD, id='cup',
                          pose=Pose(position=Point(0.4, 0.0, 0.0), orientation=Quaternion(0, 0, 0, 1)),
                          primitives=[SolidPrimitive(type=SolidPrimitive.BOX, dimensions=(0.2, 0.1, 0.1))])
        allow = SceneChange(operation=SceneChange.ALLOW, body_a='ball', body_b='cup')
        self.assertTrue(self.update(changes=[cup, allow]).success)
        time.sleep(0.5)
        self.contacts.clear()
        self.creep(0.2, 0.4, 0.4)
        time.sleep(0.5)
        self.assertFalse([m.verdict for m in self.contacts.messages if m.verdict != Verdict.CLEAR])
        # Without the rule it is the cup that the ball touches.
        check = SceneChange(operation=SceneChange.CHECK, body_a='ball', body_b='cup')
        self.assertTrue(self.update(changes=[check]).success)
        found = self.contacts.find_new(lambda m: m.verdict == Verdict.CONTACT, 10.0)
        self.assertIsNotNone(found)
        self.assertFalse(touches_map(found))
        # Without the cup, the voxels are an obstacle in the same version.
        answer = self.update(changes=[SceneChange(operation=SceneChange.REMOVE, id='cup'),
                                      SceneChange(operation=SceneChange.FORGET_RULES)])
        self.assertTrue(answer.success)
        # The next version may follow before a cycle has used that one.
        first = self.contacts.find(lambda m: m.scene_version >= answer.scene_version and m.pairs)
        self.assertIsNotNone(first)
        self.assertTrue(touches_map(first))

    def test_distances_below_the_padding_are_warned_of(self):
        def warned(name):
            return self.states.find_new(lambda m: any(w.startswith(name) for w in m.warnings), 10.0)
        self.assertIsNotNone(warned('stop_distance (0.005 m) below octomap/padding (0.03 m)'))
        client = Client('/monitor', timeout=10.0)
        client.update_configuration({'stop_distance': 0.04, 'warning_distance': 0.05})
        self.assertIsNotNone(self.states.find_new(
            lambda m: not any('below octomap/padding' in w for w in m.warnings), 10.0))
        client.update_configuration({'warning_distance': 0.02, 'stop_distance': 0.0})
        self.assertIsNotNone(warned('warning_distance (0.02 m) below'))
        client.update_configuration({'stop_distance': 0.005, 'warning_distance': 0.0})


if __name__ == '__main__':
    unittest.main()
