#!/usr/bin/env python3
"""monitor.launch sets and clears only parameters of the monitor, whatever earlier starts and others have left.

usage: launch_files_test.py SOURCE_DIRECTORY
"""
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

import rospy

from monitor_case import Recorder
from own_master import start_master, use_own_master
from sdf_ccd.msg import MonitorState

SOURCE = os.path.abspath(sys.argv.pop())
ARM = SOURCE + '/config/demo/arm.urdf'
PATIENCE = 60.0  # [s]


class LaunchFiles(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp()
        cls.master = start_master(use_own_master(ROS_HOME=cls.folder), PATIENCE)
        rospy.init_node('launch_files_test')
        cls.config = cls.folder + '/config.yaml'
        with open(cls.config, 'w') as config:
            config.write('field: {cells: 16}\nshell: {spacing: 0.02}\ncache: false\nurdf_file: ""\n')  # as in ours

    @classmethod
    def tearDownClass(cls):
        rospy.signal_shutdown('done')
        cls.master.terminate()
        cls.master.wait()
        shutil.rmtree(cls.folder, ignore_errors=True)

    def launch(self, *arguments, ns=None, cwd=None):
        """Starts a monitor. Returns the fixed frame of its first state about the robot, all parameters, and the log."""
        environment = dict(os.environ)
        if cwd:
            environment['PWD'] = cwd  # as a shell does
        if ns:
            environment['ROS_NAMESPACE'] = ns
        name = next((a[6:] for a in arguments if a.startswith('name:=')), 'collision_monitor')
        topic = '/'.join(['', *([ns] if ns else []), name, 'state'])
        states = Recorder(topic, MonitorState, PATIENCE)
        started = subprocess.Popen(['roslaunch', 'sdf_ccd', 'monitor.launch', 'config:=' + self.config, *arguments],
                                   env=environment, cwd=cwd, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        of_robot = states.find(lambda state: state.header.frame_id)
        parameters = rospy.get_param('/')
        states.close()
        started.terminate()
        log = started.communicate()[0]
        self.assertIsNotNone(of_robot, log)
        return of_robot.header.frame_id, parameters, log

    def test_a_description_is_the_monitors_alone(self):
        with open(ARM) as arm:
            other = arm.read().replace('"base"', '"other_base"')
        rospy.set_param('/robot_description', other)
        rospy.set_param('/robot_description_semantic', '<no SRDF at all')
        rospy.set_param('/collision_monitor/octomap/file', '/none.bt')
        frame, parameters, log = self.launch('urdf:=' + ARM)
        self.assertEqual(frame, 'base', log)
        self.assertEqual(rospy.get_param('/robot_description'), other)
        self.assertNotIn('octomap', parameters['collision_monitor'])
        self.assertNotIn('none.bt', log)
        self.assertNotIn('Unknown parameter', log)

    def test_meshes_may_be_beside_the_description(self):
        folder = self.folder + '/robot'  # not the working directory of nodes, ROS_HOME
        os.makedirs(folder)
        os.symlink(SOURCE + '/config/demo/meshes', folder + '/meshes')
        with open(ARM) as arm, open(folder + '/arm.urdf', 'w') as out:
            out.write(arm.read().replace('package://sdf_ccd/config/demo/', ''))
        frame, _, log = self.launch('urdf:=arm.urdf', cwd=folder)
        self.assertEqual(frame, 'base', log)
        self.assertIn(' closed)', log)  # a mesh, in the plan
        self.assertNotIn('failed', log)

    def test_without_one_it_takes_the_robots(self):
        with open(ARM) as arm:
            rospy.set_param('/robot_description', arm.read().replace('"base"', '"other_base"'))
        rospy.set_param('/robot_description_semantic', '<robot name="arm"/>')
        frame, _, log = self.launch()
        self.assertEqual(frame, 'other_base', log)

    def test_several_have_their_own_names(self):
        rospy.set_param('/robot_description', 'no robot')
        frame, parameters, log = self.launch('name:=watch', 'urdf:=' + ARM, 'nodelet:=true', ns='left')
        self.assertEqual(frame, 'base', log)
        self.assertIn('robot_description', parameters['left']['watch'])
        self.assertNotIn('robot_description', parameters['left'])

    def test_xacro_where_it_is_installed(self):
        folder = self.folder + '/bin'
        os.makedirs(folder, exist_ok=True)
        with open(folder + '/xacro', 'w') as xacro:  # Debian has none
            xacro.write('#!/bin/sh\nsed s/BASE/base/ "$1"\n')
        os.chmod(folder + '/xacro', 0o755)
        with open(ARM) as arm, open(self.folder + '/arm.urdf.xacro', 'w') as out:
            out.write(arm.read().replace('"base"', '"BASE"'))
        path, os.environ['PATH'] = os.environ['PATH'], folder + ':' + os.environ['PATH']
        try:
            frame, _, log = self.launch('urdf:=' + self.folder + '/arm.urdf.xacro')
        finally:
            os.environ['PATH'] = path
        self.assertEqual(frame, 'base', log)


if __name__ == '__main__':
    unittest.main()
