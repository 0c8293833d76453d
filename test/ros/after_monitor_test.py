#!/usr/bin/env python3
"""Tests which view after_monitor gives rviz, beside a running monitor."""
import importlib.machinery
import importlib.util
import os
import sys
import tempfile
import unittest

import rospy
import rostest


class AfterMonitorTest(unittest.TestCase):
    def test_view_follows_a_robot_that_moves_in_its_fixed_frame(self):
        script = os.path.join(os.path.dirname(os.path.realpath(__file__)), '..', '..', 'scripts', 'after_monitor')
        loader = importlib.machinery.SourceFileLoader('after_monitor', script)
        after_monitor = importlib.util.module_from_spec(importlib.util.spec_from_loader('after_monitor', loader))
        loader.exec_module(after_monitor)
        config = os.path.join(os.path.dirname(script), '..', 'config', 'monitor.rviz')
        urdf = rospy.get_param('/collision_monitor/robot_description')
        with tempfile.TemporaryDirectory() as folder:
            copy = os.path.join(folder, 'new', 'monitor.rviz')
            following = after_monitor.following
            self.assertEqual(following(config, 'base', urdf, '', copy), config)
            self.assertEqual(following(config, 'robot1/base', urdf, '/robot1', copy), config)
            for bad in (None, '', '<robot>', '<robot><joint/></robot>', '<robot><link/></robot>'):
                self.assertEqual(following(config, 'map', bad, '', copy), config)
            self.assertEqual(following(config, 'map', urdf, '', '/proc/none/monitor.rviz'), config)
            self.assertFalse(os.path.exists(copy))
            for prefix, frame in (('', '"base"'), ('robot1/', '"robot1/base"')):
                self.assertEqual(following(config, 'map', urdf + '<!-- two -- hyphens -->', prefix, copy), copy)
                with open(copy) as changed, open(config) as file:
                    self.assertEqual(changed.read(), file.read().replace('<Fixed Frame>', frame))
        self.assertEqual(after_monitor.description('collision_monitor'), urdf)
        rospy.set_param('/outer/robot_description', 'outer')
        rospy.set_param('/outer/inner/monitor/urdf_parameter', 'robot_description')
        self.assertEqual(after_monitor.description('/outer/inner/monitor'), 'outer')
        rospy.set_param('/outer/inner/monitor/urdf_parameter', 'nowhere_description')
        self.assertIsNone(after_monitor.description('/outer/inner/monitor'))


if __name__ == '__main__':
    rospy.init_node('after_monitor_test')
    rostest.rosrun('sdf_ccd', 'after_monitor_test', AfterMonitorTest, sys.argv)
