#!/usr/bin/env python3
"""Queries a running monitor about motions and points."""
import math
import sys

import rospy
import rostest
from geometry_msgs.msg import Point, Pose
from sensor_msgs.msg import JointState
from std_msgs.msg import Header

from monitor_case import PLATE, RADIUS, MonitorCase, trajectory, wait_for_service
from sdf_ccd.msg import LinkTrajectory, LinkTrajectoryPoint, RobotMotion, Verdict
from sdf_ccd.srv import QueryMotionRequest, QueryMotions, QueryMotionsRequest, QueryPoints


class QueriesTest(MonitorCase):
    @classmethod
    def setUpClass(cls):
        cls.query_points = wait_for_service('/collision_monitor/query_points', QueryPoints)
        super().setUpClass()

    def setUp(self):
        for _ in range(3):
            self.send(0.0)
        self.contacts.clear()

    def test_query_motion(self):
        self.send(0.0)
        answer = self.query_motion(trajectory('slide', [0.0, 0.3]))
        self.assertTrue(answer.success, answer.message)
        self.assertEqual(answer.verdict, Verdict.CLEAR)
        answer = self.query_motion(trajectory('slide', [0.0, 1.0, 0.0]))
        self.assertTrue(answer.success, answer.message)
        self.assertEqual(answer.verdict, Verdict.CONTACT)
        self.assertEqual(len(answer.pairs), 1)
        self.assertEqual(len(answer.pairs[0].intervals), 2)
        self.assertAlmostEqual(answer.pairs[0].first_contact.to_sec(), PLATE - RADIUS, delta=0.003)
        answer = self.query_motion(trajectory('glide', [0.0, 1.0]))
        self.assertFalse(answer.success)
        self.assertIn('glide', answer.message)
        self.assertEqual(answer.verdict, Verdict.NOT_CHECKED)

        links = LinkTrajectory(link_names=['ball'])
        for i, x in enumerate((0.0, 1.0)):
            pose = Pose()
            pose.position.x, pose.orientation.w = x, 1.0
            links.points.append(LinkTrajectoryPoint(time_from_start=rospy.Duration(float(i)), poses=[pose]))
        request = QueryMotionRequest(motion=RobotMotion(link_trajectory=links))
        answer = self.query_motion(request)
        self.assertTrue(answer.success, answer.message)
        self.assertEqual(answer.verdict, Verdict.CONTACT)
        links.points[1].poses[0].orientation.w = 0.0
        answer = self.query_motion(request)
        self.assertFalse(answer.success)
        self.assertIn('write orientation.w: 1', answer.message)

    def test_query_motion_starts_from_the_current_state(self):
        for _ in range(3):
            self.send(0.0, PLATE)  # the other ball is in the plate
        answer = self.query_motion(trajectory('slide', [0.0, 0.3]))
        self.assertTrue(answer.success, answer.message)
        self.assertEqual(answer.verdict, Verdict.CONTACT)
        self.assertEqual({answer.pairs[0].body_a, answer.pairs[0].body_b}, {'other', 'plate'})
        self.assertEqual(answer.assumed_joints.name, ['other_slide'])
        self.assertAlmostEqual(answer.assumed_joints.position[0], PLATE, delta=1e-9)
        self.assertIn('1 joint, other_slide', answer.message)
        request = trajectory('slide', [0.0, 0.3])
        request.motion.other_joints = JointState(name=['other_slide'], position=[0.0])
        answer = self.query_motion(request)
        self.assertEqual(answer.verdict, Verdict.CLEAR)
        self.assertEqual(answer.assumed_joints.name, [])
        request = trajectory('slide', [0.0, 2.5])
        answer = self.query_motion(request)
        self.assertFalse(answer.success)
        self.assertIn('joint slide: position 2.5 is beyond its limits [-2, 2]', answer.message)

    def test_a_joint_beyond_its_limits_is_checked(self):
        for end, verdict in ((2.9, Verdict.CLEAR), (2.95, Verdict.CONTACT)):
            request = trajectory('slide', [1.0, end])
            request.allow_beyond_limits = True
            answer = self.query_motion(request)
            self.assertTrue(answer.success, answer.message)
            self.assertEqual(answer.verdict, verdict)
        self.assertEqual({answer.pairs[0].body_a, answer.pairs[0].body_b}, {'ball', 'far'})

    def test_query_motion_on_splines_and_with_a_margin(self):
        for _ in range(3):
            self.send(0.3)
        request = trajectory('slide', [0.3, 0.3])
        for point, velocity in zip(request.motion.joint_trajectory.points, (1.0, -1.0)):
            point.velocities = [velocity]
        self.assertEqual(self.query_motion(request).verdict, Verdict.CLEAR)
        request.motion.interpolation = RobotMotion.SPLINES  # up to 0.55
        answer = self.query_motion(request)
        self.assertTrue(answer.success, answer.message)
        self.assertEqual(answer.verdict, Verdict.CONTACT)
        enter = 0.5 - math.sqrt(0.25 - (PLATE - RADIUS - 0.3))
        self.assertAlmostEqual(answer.pairs[0].first_contact.to_sec(), enter, delta=0.01)
        request = trajectory('slide', [0.0, 0.3])
        request.motion.other_joints = JointState(name=['other_slide'], position=[0.0])
        for margin, verdict in ((0.15, Verdict.CLEAR), (0.2, Verdict.UNCERTAIN)):
            request.margin = margin
            answer = self.query_motion(request)
            self.assertEqual(answer.verdict, verdict)
            self.assertLess(answer.error_bound.total, 0.01)
            self.assertEqual(answer.margin, margin)
            self.assertTrue(all(pair.error_bound.total < 0.01 for pair in answer.pairs))
        request.margin = -1.0
        self.assertFalse(self.query_motion(request).success)
        request.margin, request.motion.interpolation = 0.0, 7
        self.assertFalse(self.query_motion(request).success)

    def test_query_many_motions(self):
        query = wait_for_service('/collision_monitor/query_motions', QueryMotions)
        motions = [RobotMotion(joint_trajectory=trajectory('slide', positions).motion.joint_trajectory,
                               other_joints=JointState(name=['other_slide'], position=[0.0]))
                   for positions in [[0.0, 0.3], [0.0, 1.0]] * 20]
        request = QueryMotionsRequest(motions=motions)
        answer = query(request)
        self.assertTrue(answer.success, answer.message)
        self.assertEqual([motion.verdict for motion in answer.motions], [Verdict.CLEAR, Verdict.CONTACT] * 20)
        clear, touching = answer.motions[:2]
        self.assertEqual({touching.body_a, touching.body_b}, {'ball', 'plate'})
        self.assertEqual(clear.body_a, '')
        self.assertEqual(clear.time.to_sec(), -1.0)
        self.assertAlmostEqual(touching.time.to_sec(), PLATE - RADIUS, delta=0.05)
        self.assertFalse(any(motion.pairs for motion in answer.motions))
        request.list_pairs = True
        answer = query(request)
        self.assertEqual([len(motion.pairs) for motion in answer.motions], [0, 1] * 20)
        listed = answer.motions[1].pairs[0]
        self.assertEqual(listed.verdict, Verdict.CONTACT)
        self.assertEqual({listed.body_a, listed.body_b}, {'ball', 'plate'})
        self.assertAlmostEqual(listed.time.to_sec(), PLATE - RADIUS, delta=0.003)
        self.assertEqual(answer.motions[1].time, listed.time)
        request.list_pairs = False
        request.margin = 0.2
        answer = query(request)
        self.assertEqual(answer.motions[0].verdict, Verdict.UNCERTAIN)
        self.assertEqual(answer.margin, 0.2)
        self.assertLess(max(motion.error_bound for motion in answer.motions), 0.01)
        request.motions[3].joint_trajectory.points[1].positions = [5.0]
        answer = query(request)
        self.assertFalse(answer.success)
        self.assertIn('motion 3: joint slide: position 5 is beyond its limits', answer.message)

    def test_query_points(self):
        answer = self.query_points(header=Header(), points=[Point(0.45, 0.0, 0.0), Point(0.5, 0.25, 0.0)])
        self.assertTrue(answer.success, answer.message)
        outside, inside = answer.points
        self.assertEqual((outside.body, inside.body), ('plate', 'plate'))
        self.assertAlmostEqual(outside.distance, PLATE - 0.45, delta=1e-6)
        self.assertAlmostEqual(inside.distance, -0.0005, delta=1e-6)
        self.assertAlmostEqual(outside.gradient.x, -1.0, delta=1e-6)
        approximate = self.query_points(header=Header(), points=[Point(0.45, 0.0, 0.0)], approximate=True)
        self.assertTrue(approximate.success, approximate.message)
        self.assertAlmostEqual(approximate.points[0].distance, answer.points[0].distance,
                               delta=approximate.points[0].error + 1e-9)
        answer = self.query_points(header=Header(frame_id='nowhere'), points=[Point(0.45, 0.0, 0.0)])
        self.assertFalse(answer.success)
        self.assertIn('nowhere', answer.message)

    def test_queries_have_limits_that_they_say(self):
        answer = self.query_motion(trajectory('slide', [0.0, 0.1] * 1001))
        self.assertFalse(answer.success)
        self.assertEqual(answer.verdict, Verdict.NOT_CHECKED)
        self.assertIn('2002 waypoints: at most 2000 are allowed', answer.message)
        answer = self.query_motion(trajectory('slide', [0.0, 0.1] * 1000))
        self.assertTrue(answer.success, answer.message)
        self.assertEqual(answer.verdict, Verdict.CLEAR)
        answer = self.query_motion(trajectory('slide', [0.0, 1.0] * 50))
        self.assertEqual(answer.verdict, Verdict.CONTACT)
        self.assertEqual(len(answer.pairs[0].intervals), 99)
        answer = self.query_points(header=Header(), points=[Point(0.45, 0.0, 0.0)] * 20001)
        self.assertFalse(answer.success)
        self.assertIn('20001 points: at most 20000 are allowed', answer.message)
        answer = self.query_points(header=Header(), points=[Point(0.45, 0.0, 0.0), Point(1e300, 0.0, 0.0)])
        self.assertFalse(answer.success)
        self.assertEqual(answer.points, [])
        self.assertIn('point 1 is more than 1e+08 m', answer.message)


if __name__ == '__main__':
    rospy.init_node('queries_test')
    rostest.rosrun('sdf_ccd', 'queries_test', QueriesTest, sys.argv)
