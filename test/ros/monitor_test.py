#!/usr/bin/env python3
"""Drives the monitor through tf, like a robot, and tests its messages."""
import signal
import subprocess
import sys
import time

import rospy
import rostest
import dynamic_reconfigure.client
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import WrenchStamped
from std_msgs.msg import Float64
from std_srvs.srv import Empty
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import Marker, MarkerArray

from monitor_case import (PLATE, RADIUS, SAMPLE_PERIOD, MonitorCase, Recorder, ball_transforms, pair_of, trajectory,
                          transform, wait_for_service)
from sdf_ccd.msg import DistanceArray, MonitorState, Plan, Verdict
from sdf_ccd.srv import QueryMotion


class MonitorTest(MonitorCase):
    @classmethod
    def setUpClass(cls):
        cls.markers = Recorder('/collision_monitor/markers', MarkerArray)
        cls.states = Recorder('/collision_monitor/state', MonitorState)
        cls.wrenches = Recorder('/collision_monitor/wrenches/ball', WrenchStamped)
        cls.reset = wait_for_service('/collision_monitor/reset', Empty)
        super().setUpClass()

    def setUp(self):
        for _ in range(3):
            self.send(0.0)
        for recorder in (self.contacts, self.markers, self.states, self.wrenches):
            recorder.clear()

    def touching(self, message):
        pair = pair_of(message, 'ball', 'plate')
        return pair is not None and pair.intervals

    def test_contact_between_two_samples(self):
        self.send(0.4)
        before = self.stamp
        self.send(0.6)
        after = self.stamp
        self.send(0.6)
        message = self.contacts.find(self.touching)
        self.assertIsNotNone(message, 'no contact')
        self.assertEqual(message.header.frame_id, 'base')
        self.assertEqual(message.verdict, Verdict.CONTACT)
        pair = pair_of(message, 'ball', 'plate')
        self.assertEqual(pair.verdict, Verdict.CONTACT)
        self.assertFalse(pair.in_contact_at_samples)
        # The ball's front reaches one face of the plate; its back leaves the other.
        length = (after - before).to_sec()
        enter = (PLATE - RADIUS - 0.4) / 0.2 * length
        leave = (PLATE + 0.001 + RADIUS - 0.4) / 0.2 * length
        self.assertEqual(pair.first_contact, pair.intervals[0].start)
        self.assertAlmostEqual((pair.first_contact - before).to_sec(), enter, delta=0.02 * length)
        self.assertAlmostEqual((pair.intervals[-1].end - before).to_sec(), leave, delta=0.02 * length)
        self.assertGreater(pair.deepest.depth, 0.0004)  # half the plate with the ball's shell; the radius with the plate's
        self.assertLess(pair.deepest.depth, RADIUS + 1e-6)
        self.assertGreater(pair.error_bound.total, 0.0)
        self.assertGreater(len(pair.points), 0)
        a, b = pair.wrench_on_a.force, pair.wrench_on_b.force
        for axis in 'xyz':
            self.assertAlmostEqual(getattr(a, axis), -getattr(b, axis), delta=1e-6)
        self.assertIsNotNone(self.states.find(lambda m: m.verdict == Verdict.CONTACT))

    def test_every_cycle_has_a_message_and_presses_back(self):
        for _ in range(10):
            self.send(PLATE - RADIUS + 0.003)
        message = self.contacts.find(self.touching)
        self.assertTrue(pair_of(message, 'ball', 'plate').in_contact_at_samples)
        self.assertIsNotNone(self.wrenches.find(lambda m: m.wrench.force.x < -1e-3 and m.header.frame_id == 'ball'))
        for _ in range(30):
            self.send(0.0)
        messages = self.contacts.messages
        self.assertGreater(len(messages), 20)
        self.assertEqual(messages[-1].verdict, Verdict.CLEAR)
        # One contact, with one id from its begin to its end.
        told = [contact for m in messages for contact in m.contacts]
        self.assertEqual(len({contact.id for contact in told}), 1)
        self.assertEqual([contact.begins for contact in told], [True] + [False] * (len(told) - 1))
        self.assertEqual([contact.ends for contact in told], [False] * (len(told) - 1) + [True])
        self.assertFalse(told[-1].is_lost)
        self.assertEqual(told[-1].begin, told[0].begin)
        self.assertEqual(told[-1].verdict, Verdict.CONTACT)
        self.assertEqual(len(messages[-1].contacts), 0)
        # The values for plots.
        self.assertIsNotNone(self.states.find(lambda m: m.max_depth > 0.0 and m.max_force > 0.0 and m.contacts == 1))
        self.assertIsNotNone(self.states.find(lambda m: m.min_clearance > 0.0 and m.contacts == 0))
        for earlier, later in zip(messages, messages[1:]):
            self.assertEqual(earlier.header.stamp, later.cycle.start)
        # The markers of the contact are shown, and deleted when they are stale.
        self.assertIsNotNone(self.markers.find(lambda m: any(x.action == Marker.ADD for x in m.markers)))
        self.assertIsNotNone(self.markers.find(lambda m: any(x.action == Marker.DELETE for x in m.markers)))

    def test_distances_are_measured_for_who_asks(self):
        distances = Recorder('/collision_monitor/distances', DistanceArray)
        scales = Recorder('/collision_monitor/velocity_scale', Float64)
        self.wait_for(distances)
        self.send(0.28)
        self.send(0.3)
        near = distances.find(lambda m: m.distances and abs(m.distances[0].point_a.x - 0.32) < 1e-4)
        self.assertIsNotNone(near)
        self.assertEqual(near.range, 0.3)
        self.assertEqual(len(near.distances), 1)
        pair = near.distances[0]
        self.assertEqual({pair.body_a, pair.body_b}, {'ball', 'plate'})
        self.assertEqual(pair.stamp, near.header.stamp)
        self.assertAlmostEqual(pair.distance, PLATE - RADIUS - 0.3, delta=1e-4)
        self.assertLess(pair.error, 1e-4)
        self.assertAlmostEqual(pair.point_b.x, PLATE, delta=1e-4)
        self.assertAlmostEqual(pair.normal.x, 1.0, delta=1e-4)
        self.assertGreater(pair.closing_speed, 0.1)
        # Slowly towards the plate: warning, slowing down, stop.
        scales.clear()
        for x, proximity in ((0.3, MonitorState.FREE), (0.42, MonitorState.WARNING), (0.47, MonitorState.STOP)):
            self.states.clear()
            for _ in range(4):
                self.send(x)
            self.assertIsNotNone(self.states.find(lambda m: m.proximity == proximity), x)
        self.assertIsNotNone(scales.find(lambda m: m.data == 0.0))
        self.assertIsNotNone(scales.find(lambda m: 0.0 < m.data < 1.0))
        scales.clear()
        for _ in range(15):
            self.send(-1.5, -0.3)  # the other ball is far away, too
        self.assertIsNotNone(scales.find(lambda m: m.data == 1.0))
        # Far away nothing is listed.
        distances.clear()
        self.send(-1.5)
        self.assertIsNotNone(distances.find(lambda m: not m.distances))
        for recorder in (distances, scales):
            recorder.close()

    def test_parameters_change_while_it_runs(self):
        monitor = dynamic_reconfigure.client.Client('/collision_monitor', timeout=20.0)
        scale = dynamic_reconfigure.client.Client('/collision_monitor/velocity_scale', timeout=20.0)
        before, promised = dict(monitor.get_configuration()), dict(scale.get_configuration())
        self.assertEqual((before['warning_distance'], before['stop_distance'], before['max_points']), (0.1, 0.02, 20))
        self.assertEqual((promised['max_acceleration'], promised['max_age']), (0.2, 5.0))
        distances = Recorder('/collision_monitor/distances', DistanceArray)
        scales = Recorder('/collision_monitor/velocity_scale', Float64)
        self.wait_for(distances)
        try:
            # 0.18 m from the plate: first neither warned of nor slowed, then both.
            self.rest_at(0.3)
            self.assertIsNotNone(self.states.find(lambda m: m.proximity == MonitorState.FREE))
            self.assertIsNotNone(scales.find(lambda m: m.data > 0.2))
            set_now = monitor.update_configuration({'warning_distance': 0.19, 'report_distance': 0.25, 'max_points': 1})
            self.assertEqual((set_now['warning_distance'], set_now['stop_distance']), (0.19, 0.02))
            scale.update_configuration({'reaction_time': 2.0, 'max_speed': 5.0})
            self.states.clear()
            scales.clear()
            self.rest_at(0.3)
            self.assertIsNotNone(self.states.find(lambda m: m.proximity == MonitorState.WARNING))
            self.assertIsNotNone(scales.find(lambda m: m.data < 0.1))
            self.assertIsNotNone(distances.find(lambda m: m.range == 0.25))
            self.assertEqual(rospy.get_param('/collision_monitor/warning_distance'), 0.19)
            # Invalid values change nothing; values beyond the limits are clamped.
            for wrong in ({'stop_distance': 0.2}, {'hysteresis': float('nan'), 'stop_distance': 0.05}):
                self.assertEqual(monitor.update_configuration(wrong)['stop_distance'], 0.02)
            self.assertEqual(monitor.update_configuration({'hysteresis': -1.0})['hysteresis'], 0.0)
            self.contacts.clear()
            self.send(0.47)
            self.send(0.53)
            self.send(0.53)
            touching = self.contacts.find(self.touching)
            self.assertIsNotNone(touching)
            self.assertEqual(len(pair_of(touching, 'ball', 'plate').points), 1)
        finally:
            monitor.update_configuration({name: before[name] for name in before if name != 'groups'})
            scale.update_configuration({name: promised[name] for name in promised if name != 'groups'})
            for client in (monitor, scale, distances, scales):
                client.close()

    def rest_at(self, ball):
        for _ in range(6):
            self.send(ball)

    def wait_for(self, recorder):
        """Waits until the monitor has noticed the subscriber."""
        end = time.monotonic() + 10.0
        while not recorder.messages and time.monotonic() < end:
            self.send(0.0)

    def test_late_frame_delays_only_its_own_pairs(self):
        for ball in (0.4, 0.6, 0.6):
            self.send(ball, None)
        message = self.contacts.find(self.touching)
        self.assertIsNotNone(message, 'the ball waits for the other one')
        self.assertGreater(message.cycle.delayed, 0)
        self.assertEqual(message.cycle.not_checked, 0)
        self.assertLess(message.cycle.complete_until, message.header.stamp)
        self.contacts.clear()
        self.send(0.0, 0.6)
        message = self.contacts.find(lambda m: m.cycle.delayed == 0)
        self.assertIsNotNone(message)
        self.assertEqual(message.cycle.complete_until, message.header.stamp)

    def test_late_frame_costs_only_its_own_pairs(self):
        for _ in range(25):
            self.send(0.0, None)

        def late(message):
            return any(body.body == 'other' and 'late' in body.reason for body in message.unchecked)

        message = self.contacts.find(late)
        self.assertIsNotNone(message)
        self.assertEqual(message.verdict, Verdict.NOT_CHECKED)
        self.assertIsNone(pair_of(message, 'ball', 'plate'))
        self.assertIsNotNone(self.states.find(lambda m: any(body.body == 'other' for body in m.unchecked)))
        self.contacts.clear()
        for _ in range(10):
            self.send(0.0)
        self.assertIsNotNone(self.contacts.find(lambda m: m.verdict == Verdict.CLEAR))

    def test_time_that_jumps_back_starts_anew(self):
        self.send(0.6)
        self.send(0.4)
        self.assertIsNotNone(self.contacts.find(self.touching))
        self.contacts.clear()
        stamp = self.stamp - rospy.Duration(100.0)
        for i in range(30):
            self.tf.publish(ball_transforms(stamp + rospy.Duration(SAMPLE_PERIOD * i), 0.0, 0.0))
            rospy.sleep(SAMPLE_PERIOD)
        self.assertIsNotNone(self.markers.find(lambda m: any(x.action == Marker.DELETEALL for x in m.markers)))
        message = self.contacts.find(lambda m: m.header.stamp < self.stamp - rospy.Duration(50.0))
        self.assertIsNotNone(message)
        self.assertGreaterEqual(message.cycle.start, stamp)
        # Forward again: the gap is not checked, then cycles continue.
        self.contacts.clear()
        for _ in range(12):
            self.send(0.0)
        self.assertIsNotNone(self.contacts.find(lambda m: m.verdict == Verdict.NOT_CHECKED and m.unchecked))
        self.assertIsNotNone(self.contacts.find(lambda m: m.verdict == Verdict.CLEAR))

    def test_silence_is_not_checked(self):
        for _ in range(10):
            self.send(0.6)
        self.assertIsNotNone(self.markers.find(lambda m: any(x.action == Marker.ADD for x in m.markers), 5.0)
                             or self.contacts.find(lambda m: m.verdict == Verdict.CLEAR, 5.0))
        for recorder in (self.contacts, self.markers, self.states):
            recorder.clear()
        state = self.states.find(lambda m: m.reason == 'no new transforms')
        self.assertIsNotNone(state)
        self.assertEqual(state.verdict, Verdict.NOT_CHECKED)
        self.assertEqual(state.scene_version, 1)
        contacts = self.contacts.find(lambda m: m.reason == 'no new transforms')
        self.assertIsNotNone(contacts)
        self.assertEqual(contacts.verdict, Verdict.NOT_CHECKED)
        self.assertEqual(len(contacts.pairs), 0)
        self.assertEqual(contacts.cycle.start, contacts.header.stamp)
        self.assertIsNotNone(self.markers.find(lambda m: any(x.action == Marker.DELETEALL for x in m.markers)))
        diagnostics = Recorder('/diagnostics', DiagnosticArray)
        self.assertIsNotNone(diagnostics.find(lambda m: self.level_of(m, 'transforms') == DiagnosticStatus.ERROR))
        # A plan that starts from such old poses is answered, with a note.
        answer = self.query_motion(trajectory('slide', [0.0, 0.3]))
        self.assertTrue(answer.success, answer.message)
        self.assertRegex(answer.message, r'the newest transform of \w+ is [0-9.]+ s old')
        for _ in range(10):
            self.send(0.0)
        self.assertIsNotNone(self.contacts.find(lambda m: m.verdict == Verdict.CLEAR))

    @staticmethod
    def level_of(diagnostics, task):
        for status in diagnostics.status:
            if 'collision_monitor' in status.name and status.name.endswith(task):
                return status.level
        return None

    def test_late_transforms_contradict(self):
        for _ in range(5):
            self.send(0.0)
        last = self.stamp
        self.send(0.0)
        self.assertIsNotNone(self.contacts.find(lambda m: m.cycle.complete_until >= self.stamp))
        diagnostics = Recorder('/diagnostics', DiagnosticArray)
        middle = last + (self.stamp - last) * 0.5
        self.tf.publish(ball_transforms(middle, 0.6, None))  # it was behind the plate at that time
        self.send(0.0)
        message = self.contacts.find(lambda m: not m.cycle.contradicted_since.is_zero())
        self.assertIsNotNone(message)
        self.assertEqual(message.cycle.contradicted_since, last)
        self.assertEqual(list(message.cycle.late_frames), ['ball'])
        pair = pair_of(message, 'ball', 'plate')
        self.assertEqual(pair.verdict, Verdict.CONTACT)
        self.assertEqual(pair.checked_from, last)
        self.assertIsNotNone(self.states.find(lambda m: m.cycle.contradicted_since == last))
        for _ in range(60):
            self.send(0.0)
        self.assertIsNotNone(diagnostics.find(lambda m: self.level_of(m, 'transforms') == DiagnosticStatus.WARN))

    def test_rate_is_told_and_kept(self):
        diagnostics = Recorder('/diagnostics', DiagnosticArray)
        self.assertIsNotNone(diagnostics.find(lambda m: self.level_of(m, 'rate') == DiagnosticStatus.OK))
        diagnostics.close()

    def test_diagnostics_tell_numbers(self):
        diagnostics = Recorder('/diagnostics', DiagnosticArray)

        def numbers(message):
            return {value.key: value.value for status in message.status if 'bad' not in status.name
                    and 'late' not in status.name for value in status.values}
        wanted = {'rate [Hz]', 'latency [ms]', 'age [ms]', 'run time [ms]', 'error bound [mm]', 'pairs',
                  'cycles with postponed pairs', 'world version'}
        for _ in range(60):
            self.send(0.0)
        found = diagnostics.find(lambda m: wanted <= numbers(m).keys() and float(numbers(m)['age [ms]']) > 0.0)
        diagnostics.close()
        self.assertIsNotNone(found)
        self.assertGreaterEqual(float(numbers(found)['age [ms]']) + 0.1, float(numbers(found)['latency [ms]']))
        self.assertLess(float(numbers(found)['age [ms]']), 20e3)
        self.assertGreaterEqual(int(numbers(found)['world version']), 1)

    def test_old_stamp_of_one_frame_clears_nothing(self):
        for i in range(30):
            self.send(0.0)
            if i > 5:
                self.tf.publish(ball_transforms(self.stamp - rospy.Duration(1.5), None, 0.001 * i))
        self.assertFalse(any(x.action == Marker.DELETEALL for m in self.markers.messages for x in m.markers))
        self.assertIsNotNone(self.contacts.find(lambda m: 'other' in m.cycle.late_frames))
        self.assertIsNone(self.states.find(lambda m: 'jumped' in m.reason, 0.0))
        for _ in range(20):  # the late transforms end, and so does their cost
            self.send(0.0)
        self.contacts.clear()
        self.send(0.0)
        self.assertIsNotNone(self.contacts.find(lambda m: m.verdict == Verdict.CLEAR))

    def test_static_frame_that_had_no_room_is_heard_when_a_body_hangs_on_it(self):
        fixed = rospy.Publisher('/tf_static', TFMessage, queue_size=10, latch=True)
        fixed.publish(TFMessage([transform(rospy.Time(), 'foreign%d' % i, 0.0) for i in range(6000)] +
                                [transform(rospy.Time(), 'carrier', 0.25)]))
        rospy.sleep(1.0)

        def carried():
            self.send(None)
            x = PLATE - RADIUS + 0.003 - 0.25
            self.tf.publish(TFMessage([transform(self.stamp, 'ball', x, parent='carrier')]))
            return self.contacts.find(self.touching, 0.0)
        end = time.monotonic() + 20.0
        while carried() is None:
            self.assertLess(time.monotonic(), end, 'the ball on its carrier is not seen')
        fixed.unregister()

    def test_reset(self):
        for _ in range(5):
            self.send(PLATE)
        self.assertIsNotNone(self.contacts.find(lambda m: m.contacts))
        self.reset()
        self.send(0.0)
        ended = self.contacts.find(lambda m: m.reason == 'reset')
        self.assertIsNotNone(ended)
        self.assertEqual([contact.is_lost for contact in ended.contacts], [True])
        self.assertIsNotNone(self.markers.find(lambda m: any(x.action == Marker.DELETEALL for x in m.markers)))
        for _ in range(10):
            self.send(0.0)
        self.assertIsNotNone(self.contacts.find(lambda m: m.verdict == Verdict.CLEAR))

    def test_bad_parameter_is_named(self):
        state = Recorder('/bad_monitor/state', MonitorState).find(lambda m: 'max_latency' in m.reason)
        self.assertIsNotNone(state)
        self.assertEqual(state.verdict, Verdict.NOT_CHECKED)
        self.assertIn('-3.5', state.reason)
        answer = rospy.ServiceProxy('/bad_monitor/query_motion', QueryMotion)(trajectory('slide', [0.0, 1.0]))
        self.assertFalse(answer.success)
        self.assertIn('max_latency', answer.message)

    def test_robot_that_comes_late_is_waited_for(self):
        states = Recorder('/late_monitor/state', MonitorState)
        self.assertIsNotNone(states.find(lambda m: 'late_description is missing' in m.reason))
        self.assertEqual(rospy.get_param('/late_monitor/fixed_frame'), 'base')  # as inserted by after_monitor
        rospy.set_param('/late_description', rospy.get_param('/collision_monitor/robot_description'))
        self.assertIsNotNone(states.find(lambda m: m.header.frame_id == 'base'))

    def test_ends_at_once_however_seldom_it_cycles(self):
        states = Recorder('/slow_monitor/state', MonitorState)
        process = subprocess.Popen(['rosrun', 'sdf_ccd', 'collision_monitor', '__name:=slow_monitor', '_rate:=0.001',
                                    '_urdf_parameter:=/collision_monitor/robot_description'])
        try:
            self.assertIsNotNone(Recorder('/slow_monitor/plan', Plan).find(lambda m: True))
            time.sleep(0.5)  # the first cycle begins immediately
            process.send_signal(signal.SIGINT)
            self.assertEqual(process.wait(10.0), 0)
            self.assertIsNotNone(states.find(lambda m: m.reason == 'the monitor has ended'))
        finally:
            process.kill()


if __name__ == '__main__':
    rospy.init_node('monitor_test')
    rostest.rosrun('sdf_ccd', 'monitor_test', MonitorTest, sys.argv)
