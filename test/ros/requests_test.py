#!/usr/bin/env python3
"""What requests may change, and what says that they have."""
import time
import unittest

import dynamic_reconfigure.client
import rospy
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from std_srvs.srv import Empty

from monitor_case import MovingBalls, Recorder, box, pose, wait_for_service
from own_master import PATIENCE, MasterCase, sliders
from sdf_ccd.msg import MonitorState, SceneChange, Verdict
from sdf_ccd.srv import UpdateScene

WALL = [{'name': 'wall', 'type': 'box', 'size': [0.1, 1.0, 1.0], 'xyz': [2.0, 0.0, 0.0]}]
PARAMETERS = {'world': WALL, 'stop_distance': 0.02, 'warning_distance': 0.1, 'rate': 40.0,
              'velocity_scale': {'max_speed': 1.0, 'max_age': 5.0}}


def rule(kind, a, b):
    return SceneChange(operation=kind, body_a=a, body_b=b)


class RequestsTest(MasterCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        rospy.init_node('requests_test', disable_signals=True)
        cls.start_monitor('stock', sliders(), PARAMETERS)
        cls.start_monitor('strict', sliders(), {**PARAMETERS, 'requests': {
            'allow': ['add', 'rules', 'clear', 'attach'], 'protected': ['wall', 'other']}})
        cls.robot = MovingBalls(other=(0.0, -5.0))
        cls.states = {name: Recorder('/%s/state' % name, MonitorState, PATIENCE) for name in ('stock', 'strict')}
        cls.update = {name: wait_for_service('/%s/update_scene' % name, UpdateScene) for name in ('stock', 'strict')}
        for states in cls.states.values():
            assert states.find(lambda m: m.verdict == Verdict.CLEAR)

    def state(self, name, version, test):
        return self.states[name].find_new(lambda m: m.scene_version >= version and test(m), 10.0)

    def assert_refused(self, change, *texts):
        answer = self.update['strict'](changes=[box('thing', pose(3.0)), change])
        self.assertFalse(answer.success)
        self.assertEqual(answer.failed_change, 1)
        self.assertEqual(answer.objects, ['wall'])
        for text in texts:
            self.assertIn(text, answer.message)

    def test_1_what_requests_allow_is_counted_and_warned_of(self):
        diagnostics = Recorder('/diagnostics', DiagnosticArray, 10.0)
        answer = self.update['stock'](changes=[rule(SceneChange.ALLOW, 'wall', '*')])
        self.assertTrue(answer.success, answer.message)
        found = self.state('stock', answer.scene_version, lambda m: m.pairs_allowed_by_requests > 0)
        self.assertIsNotNone(found)
        self.assertEqual(found.pairs_allowed_by_requests, 2)  # with both balls
        self.assertIn('requests allow 2 pairs to touch', ' '.join(found.warnings))
        self.assertIsNotNone(diagnostics.find(lambda m: any(
            'stock' in s.name and s.level == DiagnosticStatus.WARN and 'requests allow' in str(s.values)
            for s in m.status)))
        answer = self.update['stock'](changes=[SceneChange(operation=SceneChange.FORGET_RULES)])
        found = self.state('stock', answer.scene_version, lambda m: True)
        self.assertEqual((found.pairs_allowed_by_requests, found.warnings), (0, []))
        diagnostics.close()

    def test_2_objects_of_the_parameters_that_go_are_named(self):
        answer = self.update['stock'](changes=[SceneChange(operation=SceneChange.REMOVE, id='wall')])
        self.assertTrue(answer.success, answer.message)
        found = self.state('stock', answer.scene_version, lambda m: m.warnings)
        self.assertIsNotNone(found)
        self.assertIn('wall', found.warnings[0])

    def test_3_what_is_not_allowed_is_refused(self):
        self.assert_refused(SceneChange(operation=SceneChange.MOVE, id='thing', pose=pose(4.0)), 'requests/allow',
                            'move')
        self.assert_refused(box('thing', pose(4.0)), 'requests/allow', 'move')
        for pattern in ('*', 'w*'):
            self.assert_refused(SceneChange(operation=SceneChange.REMOVE, id=pattern), 'requests/protected', 'wall')
        self.assert_refused(rule(SceneChange.ALLOW, '*', '*'), 'requests/protected')
        self.assert_refused(rule(SceneChange.ALLOW, 'thing', 'oth*'), 'requests/protected', 'other')
        self.assert_refused(SceneChange(operation=SceneChange.ATTACH, id='wall', link_name='ball'),
                            'requests/protected', 'wall')
        self.assert_refused(SceneChange(operation=SceneChange.ATTACH, id='thing', link_name='ball', touch_links=['*']),
                            'requests/protected', 'other')
        answer = self.update['strict'](changes=[box('thing', pose(3.0)), rule(SceneChange.ALLOW, 'thing', 'ball'),
                                                SceneChange(operation=SceneChange.REMOVE, id='thing')])
        self.assertTrue(answer.success, answer.message)

    def test_4_a_reset_can_be_refused_and_comes_once_a_second_at_most(self):
        with self.assertRaises(rospy.ServiceException):
            wait_for_service('/strict/reset', Empty)()
        reset = wait_for_service('/stock/reset', Empty)
        heard = self.states['stock']
        heard.clear()
        done, end = 0, time.monotonic() + 3.0
        while time.monotonic() < end:
            try:
                reset()
                done += 1
            except rospy.ServiceException:
                pass
        self.assertLessEqual(done, 4)
        self.assertGreaterEqual(done, 2)
        self.assertGreater(len([m for m in heard.messages if m.verdict == Verdict.CLEAR]), 10)

    def test_5_limits_change_to_the_safe_side_only(self):
        monitor = dynamic_reconfigure.client.Client('/stock', timeout=20.0)
        scale = dynamic_reconfigure.client.Client('/stock/velocity_scale', timeout=20.0)
        for client, wrong in ((monitor, {'rate': 1.0}), (monitor, {'stop_distance': 0.01}),
                              (monitor, {'warning_distance': 0.05}), (monitor, {'hysteresis': 0.0}),
                              (monitor, {'max_cycle_time': 1e-9}),
                              (scale, {'reaction_time': 0.0}), (scale, {'deceleration': 1e6}),
                              (scale, {'max_age': 9.0}), (scale, {'max_speed': 0.1}),
                              (scale, {'max_acceleration': 0.0}), (scale, {'period': 1e-3})):
            before = dict(client.get_configuration())
            name, = wrong
            self.assertEqual(client.update_configuration(wrong)[name], before[name])
        self.assertEqual(monitor.update_configuration({'stop_distance': 0.05, 'rate': 50.0})['stop_distance'], 0.05)
        self.assertEqual(monitor.update_configuration({'stop_distance': 0.02})['stop_distance'], 0.02)  # back again
        for client in (monitor, scale):
            client.close()


if __name__ == '__main__':
    unittest.main()
