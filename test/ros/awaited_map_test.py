#!/usr/bin/env python3
"""A live map that has not come yet, or is no longer sent: the robot is not CLEAR of its unknown contents."""
import threading
import time
import unittest

import rospy
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus

from monitor_case import MovingBalls, Recorder, trajectory, wait_for_service
from own_master import PATIENCE, MasterCase, sliders
from sdf_ccd.msg import ContactArray, MonitorState, Plan, Verdict
from sdf_ccd.srv import QueryMotion
from voxel_maps import Octomap, message, touches_map, voxels_near

MAX_AGE = 2.0  # [s]
FREE = voxels_near(0.0, 0.0, 0.0, 0.15, is_occupied=False)


def reasons(m):
    return [body.reason for body in m.unchecked if body.body.startswith('octomap')]


class AwaitedMapTest(MasterCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        rospy.init_node('awaited_map_test', disable_signals=True)
        for name in ('waits', 'watches'):
            octomap = {'topic': '/map', 'padding': 0.02, 'max_age': MAX_AGE if name == 'watches' else 0.0}
            cls.start_monitor(name, sliders(), {'shell': {'spacing': 0.002}, 'max_latency': 2.0, 'octomap': octomap})
        cls.robot = MovingBalls(other=(0.0, -5.0))
        cls.maps = rospy.Publisher('/map', Octomap, queue_size=1)
        cls.contacts = {name: Recorder('/%s/contacts' % name, ContactArray, PATIENCE) for name in ('waits', 'watches')}
        cls.diagnostics = Recorder('/diagnostics', DiagnosticArray, PATIENCE)

    def bodies_are(self, level):
        return self.diagnostics.find_new(lambda m: any(
            'waits' in s.name and s.name.endswith('bodies') and s.level == level for s in m.status))

    def test_1_nothing_is_clear_before_the_first_map(self):
        states = Recorder('/waits/state', MonitorState, PATIENCE)
        plans = Recorder('/waits/plan', Plan, PATIENCE)
        for name, heard in self.contacts.items():
            first = heard.find(reasons)
            self.assertIsNotNone(first, name)
            self.assertEqual(reasons(first), ['no map has been received on /map yet'])
            self.assertEqual(first.verdict, Verdict.NOT_CHECKED)
            self.assertEqual(first.unchecked[0].pairs, 2)  # with both balls
        self.assertIsNotNone(states.find_new(
            lambda m: m.verdict == Verdict.NOT_CHECKED and 'octomap' in str(m.unchecked)))
        plan = plans.find(lambda m: any(body.failure for body in m.bodies))
        self.assertIsNotNone(plan)
        self.assertIn('no map has been received on /map yet', ' '.join(body.failure for body in plan.bodies))
        self.assertIsNotNone(self.bodies_are(DiagnosticStatus.ERROR))
        query = wait_for_service('/waits/query_motion', QueryMotion)
        answer = query(trajectory('slide', [0.0, 0.3]))
        self.assertTrue(answer.success, answer.message)
        self.assertEqual(answer.verdict, Verdict.NOT_CHECKED)
        for heard in self.contacts.values():
            self.assertFalse([m for m in heard.messages if m.verdict == Verdict.CLEAR])

    def test_2_a_map_that_holds_nothing_is_one(self):
        self.maps.publish(message(FREE))
        found = self.contacts['waits'].find_new(lambda m: m.verdict == Verdict.CLEAR, 10.0)
        self.assertIsNotNone(found)
        self.assertEqual(reasons(found), [])
        self.assertIsNotNone(self.bodies_are(DiagnosticStatus.OK))

    def test_3_a_map_that_nobody_sends_any_more_is_too_old(self):
        sent = {**FREE, **voxels_near(0.5, 0.0, 0.0, 0.05)}
        goes_on = threading.Event()

        def send():
            while not goes_on.is_set():
                self.maps.publish(message(sent))
                time.sleep(0.1 * MAX_AGE)
        heard = self.contacts['watches']
        for _ in range(2):  # repeating the same map counts, too
            goes_on.clear()
            sender = threading.Thread(target=send, daemon=True)
            self.robot.ball = 0.0
            sender.start()
            self.assertIsNotNone(heard.find_new(lambda m: m.verdict == Verdict.CLEAR, 10.0))
            heard.clear()
            time.sleep(1.5 * MAX_AGE)  # it does not age while it is sent
            self.assertFalse([m for m in heard.messages if reasons(m)])
            goes_on.set()
            sender.join()
            self.robot.ball = 0.5  # only now: voxels that the robot occupies at a map's stamp are ignored
            self.assertIsNotNone(heard.find_new(touches_map, 10.0))
            found = heard.find_new(lambda m: reasons(m) and m.verdict == Verdict.NOT_CHECKED, 10.0)
            self.assertIsNotNone(found)
            self.assertIn('is older than 2 s', reasons(found)[0])
        # The other monitor has no max_age, so its map does not age.
        self.assertEqual(reasons(self.contacts['waits'].find_new(lambda m: True)), [])

    def test_4_a_map_that_cannot_be_taken_lets_the_last_one_grow_old_all_the_same(self):
        heard = self.contacts['watches']
        self.robot.ball = 0.0
        self.maps.publish(message(FREE))
        self.assertIsNotNone(heard.find_new(lambda m: m.verdict == Verdict.CLEAR, 10.0))
        refused = message(FREE)
        refused.header.frame_id = 'ball'
        refused.resolution = 1e-4  # too small for the space near the robot
        self.maps.publish(refused)
        self.assertIsNotNone(heard.find_new(lambda m: 'is older than 2 s' in str(reasons(m)), 10.0))


if __name__ == '__main__':
    unittest.main()
