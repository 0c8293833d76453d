#!/usr/bin/env python3
"""Reports of monitors besides contacts: meshes that cannot be checked, joint torques, proximity."""
import math
import os
import threading
import time
import unittest

import genpy.dynamic
import rospy
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import TransformStamped
from rosgraph_msgs.msg import Log
from sensor_msgs.msg import JointState
from tf2_msgs.msg import TFMessage

from monitor_case import CUBE, PERIOD, PLATE, RADIUS, MovingBalls, Recorder
from own_master import PATIENCE, MasterCase, sliders
from sdf_ccd.msg import MonitorState, Verdict

STIFFNESS = 1e6                   # [N/m^3]
ARM, DEPTH = 0.4, 0.003           # distance of the hand from the arm's joint, and its depth in a wall [m]
SEPARATOR = '=' * 80 + '\n'
ContactsState = genpy.dynamic.generate_dynamic('gazebo_msgs/ContactsState', SEPARATOR.join((
    'Header header\ngazebo_msgs/ContactState[] states\n',
    'MSG: std_msgs/Header\nuint32 seq\ntime stamp\nstring frame_id\n',
    'MSG: gazebo_msgs/ContactState\nstring info\nstring collision1_name\nstring collision2_name\n'
    'geometry_msgs/Wrench[] wrenches\ngeometry_msgs/Wrench total_wrench\n'
    'geometry_msgs/Vector3[] contact_positions\ngeometry_msgs/Vector3[] contact_normals\nfloat64[] depths\n',
    'MSG: geometry_msgs/Wrench\nVector3 force\nVector3 torque\n',
    'MSG: geometry_msgs/Vector3\nfloat64 x\nfloat64 y\nfloat64 z\n')))['gazebo_msgs/ContactsState']
WARNING, STOP, HYSTERESIS = 0.1, 0.02, 0.01  # [m]

# A hand that slides along an arm, which rotates about z.
ARM_URDF = """<robot name="arm"><link name="base"/><link name="arm"/>
  <joint name="turn" type="revolute"><parent link="base"/><child link="arm"/><axis xyz="0 0 1"/>
    <limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
  <link name="hand"><collision><geometry><sphere radius="0.02"/></geometry></collision></link>
  <joint name="reach" type="prismatic"><parent link="arm"/><child link="hand"/><axis xyz="1 0 0"/>
    <limit lower="0" upper="1" effort="1" velocity="1"/></joint></robot>"""


def mesh_robot(**files):
    """One link per file, each on a prismatic joint of the base."""
    links = ''.join(
        '<link name="%s"><collision><geometry><mesh filename="%s"/></geometry></collision></link>'
        '<joint name="to_%s" type="prismatic"><parent link="base"/><child link="%s"/><axis xyz="1 0 0"/>'
        '<limit lower="-1" upper="1" effort="1" velocity="1"/></joint>' % (link, file, link, link)
        for link, file in files.items())
    return '<robot name="meshes"><link name="base"/>%s</robot>' % links


class ReportsTest(MasterCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        rospy.init_node('reports_test', disable_signals=True)
        cls.diagnostics = Recorder('/diagnostics', DiagnosticArray, PATIENCE)
        files = {name: os.path.join(cls.folder.name, name + '.off') for name in ('whole', 'cut', 'open', 'lost')}
        contents = {'whole': CUBE, 'cut': CUBE[:len(CUBE) // 2], 'open': CUBE.replace('8 12 0', '8 10 0')}
        for name, content in contents.items():
            with open(files[name], 'w') as file:
                file.write(content)
        cls.start_monitor('bad', mesh_robot(**{name: 'file://' + file for name, file in files.items()}), {})
        cls.start_monitor('good', mesh_robot(whole='file://' + files['whole']),
                          {'world': [{'name': 'stone', 'type': 'sphere', 'radius': 0.1, 'xyz': [9, 0, 0]}]})
        # Walls that the hand touches with the arm along x, and rotated by 90 degrees.
        depth = RADIUS - DEPTH + 0.05
        walls = [{'name': 'beside', 'type': 'box', 'size': [0.2, 0.1, 0.2], 'xyz': [ARM, depth, 0.0]},
                 {'name': 'before', 'type': 'box', 'size': [0.2, 0.1, 0.2], 'xyz': [0.0, ARM + depth, 0.0]}]
        cls.start_monitor('arm', ARM_URDF, {'shell': {'spacing': 0.001}, 'contact': {'stiffness': STIFFNESS},
                                            'world': walls})
        plate = {'name': 'plate', 'type': 'box', 'size': [0.001, 2.0, 0.2], 'xyz': [0.5, 0.25, 0.0]}
        cls.start_monitor('near', sliders(), {
            'shell': {'spacing': 0.002}, 'world': [plate], 'warning_distance': WARNING, 'stop_distance': STOP,
            'hysteresis': HYSTERESIS})
        cls.balls = MovingBalls()
        cls.turn = 0.0
        cls.tf = rospy.Publisher('/tf', TFMessage, queue_size=100)
        threading.Thread(target=cls.send_arm, daemon=True).start()

    @classmethod
    def send_arm(cls):
        while not rospy.is_shutdown():
            sent = []
            for parent, child, x, turn in (('base', 'arm', 0.0, cls.turn), ('arm', 'hand', ARM, 0.0)):
                frame = TransformStamped(child_frame_id=child)
                frame.header.stamp, frame.header.frame_id = rospy.Time.now(), parent
                frame.transform.translation.x = x
                frame.transform.rotation.z, frame.transform.rotation.w = math.sin(turn / 2), math.cos(turn / 2)
                sent.append(frame)
            cls.tf.publish(TFMessage(sent))
            time.sleep(PERIOD)

    def status_of(self, monitor, task, test):
        """The task's status that passes the test."""
        def find(message):
            return next((s for s in message.status if monitor in s.name and s.name.endswith(task) and test(s)), None)
        message = self.diagnostics.find_new(lambda m: find(m) is not None)
        self.assertIsNotNone(message, (monitor, task))
        return find(message)

    def test_meshes_that_cannot_be_checked_are_in_the_diagnostics(self):
        status = self.status_of('bad', 'bodies', lambda s: s.level == DiagnosticStatus.ERROR)
        self.assertEqual(status.message, '2 bodies cannot be checked')
        not_checked = sorted(value.value for value in status.values if value.key == 'not checked')
        self.assertEqual([line.split(':')[0] for line in not_checked], ['cut', 'lost'])
        self.assertIn('cut.off', not_checked[0])
        self.assertIn('no such file', not_checked[1])
        warnings = [value.value for value in status.values if value.key == 'warning']
        self.assertTrue(any(line.startswith('open:') for line in warnings), warnings)
        self.assertFalse(any(line.startswith('whole:') for line in warnings), warnings)
        # The verdict says so too.
        state = Recorder('/bad/state', MonitorState, PATIENCE)
        self.assertIsNotNone(state.find(lambda m: m.verdict == Verdict.NOT_CHECKED))
        self.status_of('good', 'bodies', lambda s: s.level == DiagnosticStatus.OK and s.message == 'all bodies can be checked')

    def test_parameters_that_nothing_reads_are_named_once_with_what_to_do(self):
        log, state = Recorder('/rosout', Log, PATIENCE), Recorder('/old/state', MonitorState, PATIENCE)
        self.start_monitor('old', '', {'field': {'sample_bits': 16, 'cells': 20}, 'allow_http': True,
                                       'stop_distnce': 0.1})
        self.assertIsNotNone(state.find(lambda m: m.reason.startswith('waiting: parameter robot_description')))
        time.sleep(1.0)  # until its log is heard, too
        rospy.set_param('/old/robot_description', sliders())
        self.assertIsNotNone(state.find(lambda m: m.header.frame_id))
        log.find(lambda m: 'nothing reads' in m.msg)
        said = [m for m in log.messages if m.name == '/old' and 'nothing reads' in m.msg]
        self.assertEqual([(m.level, m.msg) for m in said], [(
            Log.WARN, 'Parameters that nothing reads: '
            '/old/allow_http, which is gone: nothing is read over the network: put meshes into files or packages; '
            '/old/field/sample_bits, which is gone: samples have 16 bits; '
            '/old/stop_distnce, did you mean stop_distance?')])

    def test_torques_are_those_that_walls_do(self):
        # Elastic foundation: a ball of radius R pressed d deep into a plane.
        force = math.pi * STIFFNESS * RADIUS * DEPTH ** 2
        torques = Recorder('/arm/joint_torques', JointState, PATIENCE)

        def says(turn, reach):
            def test(m):
                found = dict(zip(m.name, m.effort))
                return (sorted(found) == ['reach', 'turn'] and
                        abs(found['turn'] - turn) < 0.07 * force * ARM and abs(found['reach'] - reach) < 0.07 * force)
            return test
        for angle, turn, reach in ((0.0, -force * ARM, 0.0), (math.pi / 4, 0.0, 0.0), (math.pi / 2, 0.0, -force)):
            type(self).turn = angle
            time.sleep(0.5)
            self.assertIsNotNone(torques.find_new(says(turn, reach), 10.0), (angle, force, torques.messages[-1:]))

    def test_contacts_are_as_those_of_gazebo(self):
        self.assertEqual(ContactsState._md5sum, 'acbcb1601a8e525bf72509f18e6f668d')  # of gazebo_msgs 2.9
        force = math.pi * STIFFNESS * RADIUS * DEPTH ** 2
        states = Recorder('/arm/contact_states', ContactsState, PATIENCE)
        type(self).turn = 0.0

        def is_hand_in_wall(m):
            if len(m.states) != 1 or not m.states[0].depths:
                return False
            one = m.states[0]
            sizes = {len(values) for values in (one.wrenches, one.contact_positions, one.contact_normals, one.depths)}
            towards = one.contact_normals[0].y
            return (one.info.startswith('CONTACT') and 'hand' in (one.collision1_name, one.collision2_name) and
                    sizes == {1} and one.wrenches[0] == one.total_wrench and abs(one.depths[0] - DEPTH) < 3e-4 and
                    abs(abs(towards) - 1) < 1e-3 and abs(one.total_wrench.force.y - towards * force) < 0.07 * force and
                    towards == math.copysign(towards, -1 if one.collision1_name == 'hand' else 1) and
                    abs(one.contact_positions[0].x - ARM) < 5e-3)
        message = states.find_new(is_hand_in_wall, 10.0)
        self.assertIsNotNone(message, states.messages[-1:])
        self.assertEqual(message.header.frame_id, 'base')
        type(self).turn = math.pi / 4
        self.assertIsNotNone(states.find_new(lambda m: not m.states, 10.0), 'nothing touches there')

    def test_levels_of_nearness_are_left_behind_the_hysteresis(self):
        states = Recorder('/near/state', MonitorState, PATIENCE)
        self.assertIsNotNone(states.find(lambda m: m.proximity == MonitorState.FREE))
        free, warning, stop = MonitorState.FREE, MonitorState.WARNING, MonitorState.STOP
        for distance, level in ((0.2, free), (0.111, free), (0.102, free), (0.098, warning), (0.102, warning),
                                (0.108, warning), (0.112, free), (0.108, free), (0.018, stop), (0.022, stop),
                                (0.028, stop), (0.032, warning), (0.022, warning), (0.2, free)):
            self.balls.ball = PLATE - RADIUS - distance
            time.sleep(0.25)
            self.assertEqual(states.find_new(lambda m: True).proximity, level, distance)


if __name__ == '__main__':
    unittest.main()
