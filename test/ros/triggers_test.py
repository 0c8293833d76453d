#!/usr/bin/env python3
"""Four monitors of one robot, with different triggers of cycles."""
import itertools
import threading
import time
import unittest

import rospy
from sensor_msgs.msg import JointState
from std_msgs.msg import Header
from tf2_msgs.msg import TFMessage

from monitor_case import Recorder, transform
from own_master import PATIENCE, MasterCase, sliders
from sdf_ccd.msg import ContactArray, Verdict

PERIOD, EVERY = 0.02, 3    # of the ball's transforms [s]; every third is followed by another frame and joint states
SECONDS = 3.0
TIMER = 5.0                # rate of the monitor with a timer; that of the others is higher than the rate of events [Hz]
# Checked against the ball, whether the pose of the other one is known or not.
STONE = {'name': 'stone', 'type': 'sphere', 'radius': 0.1, 'xyz': [1.0, 0.0, 0.0]}
PATIENT = 0.1              # without an event a cycle begins after this time [s]
TRIGGERS = {'timer': {'trigger': 'timer', 'rate': TIMER}, 'tf': {'trigger': 'tf', 'rate': 500.0},
            'joints': {'trigger': 'joint_states', 'rate': 500.0},
            'frames': {'trigger': 'frames', 'trigger_frames': ['ball', 'other'], 'rate': 500.0}}


class TriggersTest(MasterCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        rospy.init_node('triggers_test', disable_signals=True)
        for name, trigger in TRIGGERS.items():
            cls.start_monitor(name, sliders(), {'shell': {'spacing': 0.005}, 'world': [STONE], **trigger})
        cls.tf = rospy.Publisher('/tf', TFMessage, queue_size=1000)
        cls.joints = rospy.Publisher('/joint_states', JointState, queue_size=1000)
        cls.contacts = {name: Recorder('/%s/contacts' % name, ContactArray, PATIENCE) for name in TRIGGERS}
        cls.sends_joints, cls.is_over = True, False
        cls.sent = {'ball': [], 'other': [], 'joints': []}
        cls.sender = threading.Thread(target=cls.send)
        cls.sender.start()
        for name in TRIGGERS:
            assert cls.contacts[name].find(lambda m: m.verdict == Verdict.CLEAR), name

    @classmethod
    def tearDownClass(cls):
        cls.is_over = True
        cls.sender.join()
        super().tearDownClass()

    @classmethod
    def send(cls):
        begin = time.monotonic()
        for count in itertools.count():
            if cls.is_over:
                return
            stamp = rospy.Time.now()
            cls.tf.publish(TFMessage([transform(stamp, 'ball', 0.0)]))
            cls.sent['ball'].append(stamp)
            if count % EVERY == 0:
                if cls.sends_joints:
                    cls.joints.publish(JointState(header=Header(stamp=stamp), name=['slide'], position=[0.0]))
                    cls.sent['joints'].append(stamp)
                time.sleep(0.2 * PERIOD)  # the last frame of the group comes after the first
                cls.tf.publish(TFMessage([transform(stamp, 'other', 0.0, 0.5)]))
                cls.sent['other'].append(stamp)
            time.sleep(max(0.0, begin + PERIOD * (count + 1) - time.monotonic()))

    def listen(self):
        """The messages of each monitor during some time, and the stamps sent meanwhile."""
        before = {kind: len(stamps) for kind, stamps in self.sent.items()}
        for recorder in self.contacts.values():
            recorder.clear()
        time.sleep(SECONDS)
        said = {name: recorder.messages for name, recorder in self.contacts.items()}
        return said, {kind: stamps[before[kind]:] for kind, stamps in self.sent.items()}

    def test_cycles_begin_with_what_they_wait_for(self):
        said, told = self.listen()
        counts = {name: len(messages) for name, messages in said.items()}
        self.assertLessEqual(counts['timer'], TIMER * SECONDS + 2)
        self.assertGreaterEqual(counts['timer'], 0.6 * TIMER * SECONDS)
        # Any transform: one cycle per stamp, which is the end of the cycle.
        ends = {m.header.stamp for m in said['tf']}
        self.assertGreater(len(ends & set(told['ball'])), 0.8 * len(told['ball']))
        # Joint states: not the transforms between them.
        self.assertGreater(counts['joints'], 0.8 * len(told['joints']))
        self.assertLess(counts['joints'], 1.4 * len(told['joints']))
        # The last of a group: all poses are known, and no pair waits.
        self.assertGreater(counts['frames'], 0.8 * len(told['other']))
        self.assertLess(counts['frames'], 1.4 * len(told['other']))
        whole = [m for m in said['frames'] if m.cycle.complete_until == m.header.stamp and m.cycle.delayed == 0]
        self.assertGreater(len(whole), 0.8 * counts['frames'])
        self.assertLess(sum(m.cycle.delayed == 0 for m in said['tf']), 0.7 * counts['tf'])

    def test_without_news_they_begin_all_the_same(self):
        type(self).sends_joints = False
        time.sleep(2 * PATIENT)
        said, _ = self.listen()
        type(self).sends_joints = True
        self.assertLess(len(said['joints']), SECONDS / PATIENT + 2)
        self.assertGreater(len(said['joints']), 0.5 * SECONDS / PATIENT)
        for earlier, later in zip(said['joints'], said['joints'][1:]):
            self.assertEqual(earlier.header.stamp, later.cycle.start)  # no time is left out


if __name__ == '__main__':
    unittest.main()
