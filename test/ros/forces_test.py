#!/usr/bin/env python3
"""A monitor gives verdicts before the fields and shells of meshes are built, and says of which contacts forces are not known."""
import math
import os
import time
import unittest

import rospy
from geometry_msgs.msg import WrenchStamped
from sensor_msgs.msg import JointState

from monitor_case import Recorder, MovingBalls, pair_of, touches, trajectory, wait_for_service
from own_master import PATIENCE, MasterCase
from sdf_ccd.msg import ContactArray, Plan, PlanPart, Verdict
from sdf_ccd.srv import QueryMotion

RADIUS, DEPTH, STIFFNESS = 0.1, 0.005, 1e6    # of the ball, of it in the plate [m]; [N/m^3]
FORCE = math.pi * STIFFNESS * RADIUS * DEPTH ** 2  # elastic foundation
AWAITED = 'no force: ball: its field and shell are being built'


def ball(rings, sides):
    """A sphere as the text of an OFF file."""
    points = [(0, 0, -RADIUS)] + [
        (RADIUS * math.sin(math.pi * i / rings) * math.cos(2 * math.pi * k / sides),
         RADIUS * math.sin(math.pi * i / rings) * math.sin(2 * math.pi * k / sides),
         -RADIUS * math.cos(math.pi * i / rings)) for i in range(1, rings) for k in range(sides)] + [(0, 0, RADIUS)]
    faces = []
    for k in range(sides):
        n = (k + 1) % sides
        faces += [(0, 1 + n, 1 + k), (len(points) - 1, len(points) - 1 - sides + k, len(points) - 1 - sides + n)]
        for i in range(rings - 2):
            a, b = 1 + i * sides, 1 + (i + 1) * sides
            faces += [(a + k, a + n, b + n), (a + k, b + n, b + k)]
    return 'OFF\n%d %d 0\n%s%s' % (len(points), len(faces), ''.join('%r %r %r\n' % p for p in points),
                                   ''.join('3 %d %d %d\n' % f for f in faces))


class ForcesTest(MasterCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        rospy.init_node('forces_test', disable_signals=True)
        file = os.path.join(cls.folder.name, 'ball.off')
        with open(file, 'w') as out:
            out.write(ball(100, 200))
        cls.urdf = (
            '<robot name="mesh"><link name="base"/><link name="ball"><collision><geometry>'
            '<mesh filename="file://%s"/></geometry></collision></link><joint name="slide" type="prismatic">'
            '<parent link="base"/><child link="ball"/><axis xyz="1 0 0"/>'
            '<limit lower="-1" upper="1" effort="1" velocity="1"/></joint></robot>' % file)
        cls.balls = MovingBalls()

    def begin(self, name, wrenches):
        """Starts a monitor whose ball touches a plate. Takes a second to build fields, so that they are awaited first."""
        plate = {'name': 'plate', 'type': 'box', 'size': [0.1, 1.0, 1.0], 'xyz': [RADIUS - DEPTH + 0.05, 0.0, 0.0]}
        self.start_monitor(name, self.urdf, {
            'world': [plate], 'wrenches': wrenches, 'contact': {'stiffness': STIFFNESS},
            'field': {'cell_size': 0.002}, 'shell': {'spacing': 0.001}, 'fixed_frame': 'base', 'max_cycle_time': 0, 'request_time': 60.0})
        return Recorder('/%s/plan' % name, Plan, PATIENCE)

    def contact(self, contacts, known):
        found = contacts.find(lambda m: touches(m, 'ball', 'plate') and
                              math.isnan(pair_of(m, 'ball', 'plate').wrench_on_a.force.x) != known)
        self.assertIsNotNone(found, contacts.messages[-1:])
        return pair_of(found, 'ball', 'plate')

    def assert_force(self, pair):
        self.assertEqual((pair.reason, pair.incomplete), ('', False))
        self.assertLess(abs(abs(pair.wrench_on_a.force.x) - FORCE), 0.1 * FORCE)

    def test_forces_follow_verdicts(self):
        contacts = Recorder('/always/contacts', ContactArray, PATIENCE)
        wrenches = Recorder('/always/wrenches/ball', WrenchStamped, PATIENCE)
        torques = Recorder('/always/joint_torques', JointState, PATIENCE)
        plans = self.begin('always', 'always')
        pair = self.contact(contacts, known=False)
        self.assertEqual((pair.reason, pair.incomplete), (AWAITED, False))
        self.assertGreaterEqual(pair.deepest.depth + pair.deepest.depth_error, DEPTH - 1e-4)
        self.assertEqual(len(pair.intervals), 1)
        self.assert_force(self.contact(contacts, known=True))
        for recorder, value in ((wrenches, lambda m: m.wrench.force.x), (torques, lambda m: m.effort[0])):
            self.assertIsNotNone(recorder.find(lambda m: True))
            self.assertFalse([m for m in recorder.messages if math.isnan(value(m))], 'nothing is published before')
        # Each cycle was checked, also those during which they were built and adopted.
        checked = [m for m in contacts.messages if m.pairs or m.reason == '']
        self.assertTrue(checked)
        self.assertFalse([m.reason for m in checked[1:] if m.verdict != Verdict.CONTACT][:3])
        first = plans.messages[0]
        self.assertIn((PlanPart.AWAITED, 'its field and shell are being built'),
                      [(body.field.state, body.field.text) for body in first.bodies])
        built = plans.find(lambda m: all(body.field.state != PlanPart.AWAITED for body in m.bodies))
        ball, = [body for body in built.bodies if body.name == 'ball']
        self.assertEqual(ball.shell.state, PlanPart.READY)
        self.assertGreater(ball.shell_points, 1000)

    def test_forces_on_demand(self):
        plans = self.begin('demand', 'on_demand')
        self.assertIsNotNone(plans.find(lambda m: True))
        time.sleep(3.0)
        self.assertEqual(len(plans.messages), 1, 'nobody has asked for forces')
        contacts = Recorder('/demand/contacts', ContactArray, PATIENCE)
        self.assertEqual(self.contact(contacts, known=False).reason, AWAITED)
        self.assert_force(self.contact(contacts, known=True))

    def test_no_forces(self):
        contacts = Recorder('/none/contacts', ContactArray, PATIENCE)
        wrenches = Recorder('/none/wrenches/ball', WrenchStamped, PATIENCE)
        plans = self.begin('none', 'never')
        reason = 'its field and shell are not wanted (parameter wrenches)'
        self.assertEqual(self.contact(contacts, known=False).reason, 'no force: ball: ' + reason)
        plan = plans.find(lambda m: True)
        self.assertIn((PlanPart.NOT_WANTED, reason), [(body.shell.state, body.shell.text) for body in plan.bodies])
        self.assertIn(PlanPart.READY, [body.surface.state for body in plan.bodies])
        query = wait_for_service('/none/query_motion', QueryMotion)
        answer = query(trajectory('slide', [-0.5, 0.0]))
        self.assertTrue(answer.success and answer.verdict == Verdict.CONTACT, answer)
        self.assertEqual(answer.pairs[0].reason, 'no force: ball: ' + reason)
        self.assertGreater(answer.pairs[0].first_contact.to_sec(), 0.5)
        time.sleep(2.0)
        self.assertFalse(wrenches.messages)

    def test_queries_wait_for_forces(self):
        self.begin('query', 'always')
        query = wait_for_service('/query/query_motion', QueryMotion)
        while True:
            answer = query(trajectory('slide', [-0.5, 0.0]))
            if answer.verdict != Verdict.NOT_CHECKED:
                break
            time.sleep(0.01)
        self.assertEqual(answer.verdict, Verdict.CONTACT)
        self.assertFalse(math.isnan(answer.pairs[0].wrench_on_a.force.x), answer)
        self.assertEqual(answer.pairs[0].reason, '')


if __name__ == '__main__':
    unittest.main()
