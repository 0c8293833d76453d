#!/usr/bin/env python3
"""A monitor under disturbances: a clock that does not run, bags that loop, a master that dies.

usage: lifecycle_test.py SOURCE_DIRECTORY
"""
import os
import signal
import subprocess
import sys
import time
import unittest

import rosbag
import rospy
import rosservice
from rosgraph_msgs.msg import Clock, Log
from tf2_msgs.msg import TFMessage

from monitor_case import Recorder, ball_transforms
from own_master import PATIENCE, MasterCase, sliders
from sdf_ccd.msg import ContactArray, MonitorState, Verdict

SOURCE = os.path.abspath(sys.argv.pop())
RATE, SECONDS = 50.0, 3.0  # of the bag


def write_bag(path):
    """The ball goes through the plate once, between two transforms."""
    with rosbag.Bag(path, 'w') as bag:
        for i in range(int(RATE * SECONDS)):
            stamp = rospy.Time(1000) + rospy.Duration(i / RATE)
            bag.write('/tf', ball_transforms(stamp, 0.3 if i < RATE * SECONDS / 2 else 0.7), stamp)


class Lifecycle(MasterCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.bag = os.path.join(cls.folder.name, 'ball.bag')
        write_bag(cls.bag)
        rospy.set_param('/robot_description', sliders())
        subprocess.check_call(['rosparam', 'load', SOURCE + '/test/ros/monitor.yaml', '/collision_monitor'])
        rospy.set_param('/use_sim_time', True)
        rospy.init_node('lifecycle_test', disable_signals=True)
        cls.states = Recorder('/collision_monitor/state', MonitorState, PATIENCE)
        cls.contacts = Recorder('/collision_monitor/contacts', ContactArray, PATIENCE)
        cls.monitor = cls.start('rosrun', 'sdf_ccd', 'collision_monitor', '__name:=collision_monitor')

    def play(self, *options):
        self.start_player('--wait-for-subscribers', *options).wait(PATIENCE)

    @classmethod
    def start_player(cls, *options):
        return cls.start('rosbag', 'play', '--quiet', '--clock', '--hz=100', '--delay=1', *options, cls.bag)

    @staticmethod
    def ended(messages):
        return [contact for message in messages for contact in message.contacts if contact.ends]

    def test_1_a_clock_that_does_not_run_is_said(self):
        log = Recorder('/rosout', Log, PATIENCE)
        reason = 'use_sim_time is true, but no message arrives on /clock'
        for recorder in (self.states, self.contacts):
            self.assertIsNotNone(recorder.find(lambda m: m.reason == reason))
        self.assertIsNotNone(log.find(lambda m: m.msg.startswith('Not checked: ' + reason)))
        self.assertTrue(all(m.verdict == Verdict.NOT_CHECKED for m in self.states.messages))
        self.assertIsNone(self.monitor.poll())

    def test_2_a_bag_at_its_own_speed_and_ten_times_as_fast(self):
        for options in ((), ('-r', '10')):
            self.contacts.clear()
            self.play(*options)
            self.assertTrue(self.contacts.wait(lambda all: len(self.ended(all)) == 1), options)
            contact, = self.ended(self.contacts.messages)
            self.assertEqual({contact.body_a, contact.body_b}, {'ball', 'plate'})
            self.assertEqual(contact.verdict, Verdict.CONTACT)
            self.assertFalse(contact.seen_at_samples)
            self.assertFalse(contact.is_lost)
            self.assertAlmostEqual(contact.begin.to_sec(), 1000 + SECONDS / 2 - 0.5 / RATE, delta=0.5 / RATE)

    def test_3_a_bag_that_loops(self):
        self.contacts.clear()
        self.states.clear()
        player = self.start_player('--loop', '-r', '3')
        self.assertTrue(self.contacts.wait(lambda all: len(self.ended(all)) >= 4))
        player.send_signal(signal.SIGINT)
        player.wait(PATIENCE)
        contacts = self.ended(self.contacts.messages)
        self.assertEqual(len({contact.id for contact in contacts}), len(contacts))  # each has its own
        begins = [contact.begin.to_sec() for contact in contacts]
        self.assertLess(max(begins) - min(begins), 1e-5)  # all the same
        self.assertTrue(any(m.reason == 'time has jumped' for m in self.states.messages))

    def test_4_a_publisher_that_dies_and_one_that_takes_its_place(self):
        self.contacts.clear()
        for _ in range(2):
            player = self.start_player('--wait-for-subscribers')
            self.assertIsNotNone(self.contacts.find(lambda m: m.verdict == Verdict.CLEAR))
            self.kill(player)
            self.contacts.clear()
        self.play()
        self.assertTrue(self.contacts.wait(lambda all: len(self.ended(all)) >= 1))

    def test_5_a_master_that_dies_and_comes_back(self):
        clock = rospy.Publisher('/clock', Clock, queue_size=10)
        tf = rospy.Publisher('/tf', TFMessage, queue_size=10)
        end = time.monotonic() + PATIENCE
        while (not clock.get_num_connections() or not tf.get_num_connections()) and time.monotonic() < end:
            time.sleep(0.1)
        self.master.kill()
        self.master.wait()
        for _ in range(2):
            self.contacts.clear()
            begin = 2000.0
            for i in range(100):
                stamp = rospy.Time(begin + 0.02 * i)
                clock.publish(Clock(clock=stamp))
                tf.publish(ball_transforms(stamp, 0.3 if i < 50 else 0.7))
                time.sleep(0.02)
            # Existing connections need no master.
            self.assertIsNotNone(self.contacts.find(lambda m: m.verdict == Verdict.CONTACT))
            self.assertIsNone(self.monitor.poll())
            if self.master.poll() is not None:
                self.start_master()

    def test_6_a_clock_that_is_set_far_ahead_and_back(self):
        # By more than a ros::Duration holds, 2^31 s.
        clock = rospy.Publisher('/clock', Clock, queue_size=10)
        tf = rospy.Publisher('/tf', TFMessage, queue_size=10)
        for begin, verdict in ((3000.0, Verdict.CLEAR), (4294967200.0, Verdict.NOT_CHECKED),
                               (4000.0, Verdict.CLEAR)):
            self.contacts.clear()
            for i in range(150):
                stamp = rospy.Time.from_sec(begin + 0.02 * i)
                clock.publish(Clock(clock=stamp))
                tf.publish(ball_transforms(stamp, 0.3))
                time.sleep(0.02)
            self.assertIsNotNone(self.contacts.find(lambda m: m.verdict == verdict), begin)
            self.assertIsNone(self.monitor.poll(), begin)

    def test_7_a_node_loads_and_unloads_nothing(self):
        # Loading nodelets is the task of managers.
        services = rosservice.get_service_list(namespace='/collision_monitor')
        self.assertFalse([name for name in services if name.endswith('load_nodelet') or name.endswith('/list')])

    def test_8_it_ends_as_it_should(self):
        self.monitor.send_signal(signal.SIGINT)
        self.assertEqual(self.monitor.wait(PATIENCE), 0)
        self.assertIsNotNone(self.states.find(lambda m: m.reason == 'the monitor has ended'))


if __name__ == '__main__':
    unittest.main()
