#!/usr/bin/env python3
"""A monitor whose cycles take longer than max_latency."""
import math
import threading
import time
import unittest

import rospy
from std_msgs.msg import Float64

from monitor_case import MovingBalls, Recorder
from own_master import PATIENCE, MasterCase, sliders
from sdf_ccd.msg import ContactArray, MonitorState, Verdict

LIMIT = 0.01  # max_latency [s]


def swing(balls):
    while not rospy.is_shutdown():
        balls.ball = 0.05 * math.sin(time.monotonic())
        time.sleep(0.01)


class LongCycleTest(MasterCase):
    def test_is_not_checked_and_stops_the_robot_while_it_lasts(self):
        rospy.init_node('long_cycle_test', disable_signals=True)
        # The forces of some hundred thousand points take longer than the limit.
        self.start_monitor('collision_monitor', sliders().replace('radius="0.02"', 'radius="0.5"'), {
            'shell': {'spacing': 0.003}, 'max_latency': LIMIT, 'rate': 5.0, 'max_cycle_time': 0.0,
            'overlapping_pairs': 'check', 'velocity_scale': {'max_speed': 1.0}})
        contacts = Recorder('/collision_monitor/contacts', ContactArray, PATIENCE)
        states = Recorder('/collision_monitor/state', MonitorState, PATIENCE)
        scales = Recorder('/collision_monitor/velocity_scale', Float64, PATIENCE)
        balls = MovingBalls()
        threading.Thread(target=swing, args=(balls,), daemon=True).start()  # of balls at rest the forces are known
        self.assertIsNotNone(contacts.find(lambda m: m.verdict == Verdict.CONTACT))
        state = states.find_new(lambda m: m.reason.startswith('a cycle has been running for'))
        self.assertIsNotNone(state)
        self.assertEqual(state.verdict, Verdict.NOT_CHECKED)
        self.assertIsNotNone(states.find_new(lambda m: m.verdict == Verdict.CONTACT and m.cycle.run_time > LIMIT))
        self.assertIsNotNone(scales.find_new(lambda m: m.data == 0.0))


if __name__ == '__main__':
    unittest.main()
