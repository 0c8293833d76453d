#!/usr/bin/env python3
"""A monitor with publishers and subscribers that hang, die and come back, on the wall clock.

usage: publishers_test.py TRANSFORM_STORM
"""
import os
import signal
import subprocess
import sys
import time
import unittest

import rospy
from std_msgs.msg import Float64

from monitor_case import Recorder, box, pose, wait_for_service
from own_master import PATIENCE, MasterCase, sliders
from sdf_ccd.msg import ContactArray, MonitorState, SceneChange, Verdict
from sdf_ccd.srv import UpdateScene

TRANSFORM_STORM = sys.argv.pop()
RATE = 50.0    # of transforms, and of cycles [Hz]
SILENCE = 0.3  # max_latency [s]


class PublishersTest(MasterCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        rospy.init_node('publishers_test', disable_signals=True)
        cls.start_all()
        cls.contacts = Recorder('/collision_monitor/contacts', ContactArray, PATIENCE)
        cls.states = Recorder('/collision_monitor/state', MonitorState, PATIENCE)
        cls.scales = Recorder('/collision_monitor/velocity_scale', Float64, PATIENCE)
        cls.update = wait_for_service('/collision_monitor/update_scene', UpdateScene)

    @classmethod
    def start_all(cls):
        """Sets the parameters, which are lost when a master ends, and starts a monitor."""
        rospy.set_param('/robot_description', sliders())
        cls.monitor = cls.start_monitor('collision_monitor', sliders(), {
            'shell': {'spacing': 0.005}, 'max_latency': SILENCE, 'rate': RATE, 'velocity_scale': {'max_speed': 1.0},
            'world': [{'name': 'stone', 'type': 'sphere', 'radius': 0.1, 'xyz': [1.0, 0.0, 0.0]}]})

    def publish(self):
        """Starts a publisher of the robot's transforms: at rest, its balls at 0 and 0.5 m along y."""
        return self.start(TRANSFORM_STORM, '_kind:=robot', '_rate:=%g' % RATE)

    def signal(self, process, number):
        os.killpg(process.pid, number)

    def expect_clear(self):
        self.assertIsNotNone(self.contacts.find_new(lambda m: m.verdict == Verdict.CLEAR))
        self.assertIsNotNone(self.scales.find_new(lambda m: m.data > 0.0))

    def expect_silence(self):
        self.assertIsNotNone(self.states.find_new(lambda m: m.reason == 'no new transforms', 20 * SILENCE))
        self.assertEqual(self.states.messages[-1].verdict, Verdict.NOT_CHECKED)
        self.assertIsNotNone(self.scales.find_new(lambda m: m.data == 0.0))

    def test_a_publisher_that_hangs_dies_and_is_replaced(self):
        publisher = self.publish()
        self.expect_clear()
        answer = self.update(changes=[box('wall', pose())])
        self.assertTrue(answer.success, answer.message)
        self.assertIsNotNone(self.contacts.find_new(lambda m: any(not c.ends for c in m.contacts)))
        for end in (signal.SIGSTOP, signal.SIGKILL):
            self.contacts.clear()
            self.signal(publisher, end)
            self.expect_silence()
            if end == signal.SIGSTOP:
                self.signal(publisher, signal.SIGCONT)
            else:
                publisher = self.publish()
            # A contact that continues has the same id or a new one, and does not end twice.
            self.assertIsNotNone(self.contacts.find_new(lambda m: any(not c.ends for c in m.contacts)))
        self.update(changes=[SceneChange(operation=SceneChange.REMOVE, id='wall')])
        self.expect_clear()
        # Two publishers of the same transforms do no harm.
        second = self.publish()
        self.contacts.clear()
        time.sleep(1.0)
        self.kill(publisher)
        self.expect_clear()
        self.kill(second)
        self.expect_silence()

    def test_listeners_that_hang_delay_nobody(self):
        publisher = self.publish()
        self.expect_clear()
        listeners = [self.start('rostopic', 'echo', '/collision_monitor/' + topic)
                     for topic in ('contacts', 'state', 'markers')]
        time.sleep(2.0)
        for listener in listeners:
            self.signal(listener, signal.SIGSTOP)
        before = self.resident()
        self.contacts.clear()
        time.sleep(6.0)
        heard = self.contacts.messages
        self.assertGreater(len(heard), 0.6 * 6.0 * RATE)
        for earlier, later in zip(heard, heard[1:]):
            self.assertEqual(earlier.header.stamp, later.cycle.start)
        self.assertLess(self.resident() - before, 8 << 20)
        for listener in listeners:
            self.kill(listener)
        self.kill(publisher)
        self.expect_silence()  # otherwise the next one would seem to be received at once

    def test_newcomers_after_a_new_master_find_a_monitor_that_is_started_anew(self):
        publisher = self.publish()
        self.expect_clear()
        self.master.kill()
        self.master.wait()
        self.start_master()
        self.expect_clear()  # existing connections stay; roscpp does not register with the new master
        self.kill(self.monitor)
        self.kill(publisher)
        self.start_all()
        publisher = self.publish()
        for topic in ('contacts', 'velocity_scale'):
            heard = subprocess.run(['rostopic', 'echo', '-n', '1', '/collision_monitor/' + topic], timeout=PATIENCE,
                                   stdout=subprocess.PIPE, text=True).stdout
            self.assertTrue(heard, topic)
        # Subscribers of the old monitor have to register again, too.
        for recorder in (self.contacts, self.scales, self.states):
            recorder.close()
        type(self).contacts, type(self).scales, type(self).states = (
            Recorder('/collision_monitor/' + topic, kind, PATIENCE) for topic, kind in
            (('contacts', ContactArray), ('velocity_scale', Float64), ('state', MonitorState)))
        self.expect_clear()
        self.kill(publisher)

    def resident(self):
        """Memory of the monitor [bytes]; `rosrun` is replaced by it."""
        with open('/proc/%d/statm' % self.monitor.pid) as file:
            return int(file.read().split()[1]) * os.sysconf('SC_PAGE_SIZE')


if __name__ == '__main__':
    unittest.main()
