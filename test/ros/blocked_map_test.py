#!/usr/bin/env python3
"""Requests that take long, or that never end to come: the live map and its age do not wait for them."""
import random
import threading
import time
import unittest

import rospy
from geometry_msgs.msg import Point
from shape_msgs.msg import Mesh, MeshTriangle

from monitor_case import MovingBalls, Recorder, box, pose, trajectory, wait_for_service
from own_master import PATIENCE, MasterCase, sliders
from sdf_ccd.msg import ContactArray, SceneChange, Verdict
from sdf_ccd.srv import QueryMotion, UpdateScene
from voxel_maps import Octomap, message, touches_map, voxels_near

MAX_AGE, REQUEST_TIME = 6.0, 4.0  # [s]
FREE = voxels_near(0.0, 0.0, 0.0, 0.15, is_occupied=False)


def tangle(triangles, seed):
    """A mesh of random triangles, which takes minutes to prepare."""
    draw = random.Random(seed)
    corners = [Point(*(draw.uniform(-0.5, 0.5) for _ in range(3))) for _ in range(3 * triangles)]
    return Mesh(vertices=corners, triangles=[MeshTriangle((3 * i, 3 * i + 1, 3 * i + 2)) for i in range(triangles)])


def is_outdated(m):
    return m.verdict == Verdict.NOT_CHECKED and any('older than' in body.reason for body in m.unchecked)


class BlockedMapTest(MasterCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        rospy.init_node('blocked_map_test', disable_signals=True)
        cls.start_monitor('monitor', sliders(), {
            'shell': {'spacing': 0.002}, 'max_latency': 2.0, 'request_time': REQUEST_TIME,
            'octomap': {'topic': '/map', 'padding': 0.02, 'max_age': MAX_AGE}})
        cls.robot = MovingBalls(other=(0.0, -5.0))
        cls.maps = rospy.Publisher('/map', Octomap, queue_size=1)
        cls.contacts = Recorder('/monitor/contacts', ContactArray, PATIENCE)
        wait_for_service('/monitor/update_scene', UpdateScene)
        cls.sent = FREE
        threading.Thread(target=cls.send_maps, daemon=True).start()

    @classmethod
    def send_maps(cls):
        while not rospy.is_shutdown():
            if cls.sent:
                cls.maps.publish(message(cls.sent))
            time.sleep(0.2)

    def setUp(self):
        self.robot.ball = 0.0
        type(self).sent = FREE
        self.assertIsNotNone(self.contacts.find_new(lambda m: m.verdict == Verdict.CLEAR))

    def assert_map_is_seen(self, answers):
        """A wall that comes is touched, and a map that does not come any more is not used."""
        type(self).sent = {**FREE, **voxels_near(0.5, 0.0, 0.0, 0.1)}
        time.sleep(3.0)
        type(self).sent = None
        self.robot.ball = 0.5
        self.assertIsNotNone(self.contacts.find_new(touches_map, MAX_AGE - 1.0), answers)
        self.assertIsNotNone(self.contacts.find(is_outdated, MAX_AGE + 1.0), answers)
        type(self).sent = FREE
        self.robot.ball = 0.0
        self.assertIsNotNone(self.contacts.find_new(lambda m: m.verdict == Verdict.CLEAR, 5.0), answers)

    def storm(self, *clients):
        """Each client sends its changes, one after the other, until the map has been tested. Returns the answers."""
        answers, ends = [], threading.Event()

        def send(changes):
            update, count = rospy.ServiceProxy('/monitor/update_scene', UpdateScene), 0
            while not ends.is_set():
                count += 1
                start = time.monotonic()
                answer = update(changes=changes(count))
                answers.append((answer.success, time.monotonic() - start, answer.message))
        senders = [threading.Thread(target=send, args=(changes,), daemon=True) for changes in clients]
        for sender in senders:
            sender.start()
        time.sleep(1.0)
        try:
            self.assert_map_is_seen(answers)
        finally:
            ends.set()
            for sender in senders:
                sender.join(PATIENCE)
        return answers

    def test_1_a_request_that_takes_long(self):
        meshes = [tangle(5000, seed) for seed in range(20)]
        answers = self.storm(lambda i: [SceneChange(operation=SceneChange.ADD, id='part', pose=pose(50.0),
                                                    meshes=[meshes[i % len(meshes)]])])
        for success, seconds, text in answers:
            self.assertLess(seconds, REQUEST_TIME + 5.0, text)  # sending and receiving count, too
            if not success and seconds > REQUEST_TIME:
                self.assertIn('request_time', text)

    def test_2_requests_in_quick_succession(self):
        answers = self.storm(*[lambda i, k=k: [box('o%d_%d' % (k, i % 5), pose(20.0 + i % 7))] for k in range(4)])
        self.assertTrue(any(success for success, _, _ in answers), answers[:5])

    def test_3_no_query_uses_an_outdated_map(self):
        query = wait_for_service('/monitor/query_motion', QueryMotion)
        self.assertEqual(query(trajectory('slide', [0.0, 0.3])).verdict, Verdict.CLEAR)
        type(self).sent = None
        end = time.monotonic() + MAX_AGE + 5.0
        clear_until = 0.0
        while time.monotonic() < end:
            answer = query(trajectory('slide', [0.0, 0.3]))
            if answer.verdict == Verdict.CLEAR:
                clear_until = time.monotonic()
            time.sleep(0.05)
        self.assertLess(clear_until, end - 4.0)


if __name__ == '__main__':
    unittest.main()
