"""A ROS master of a test's own, beside those of others, and what runs with it."""
import os
import signal
import socket
import subprocess
import tempfile
import time
import unittest

import rosgraph
import rospy

PATIENCE = 60.0  # [s]
SLIDERS = os.path.dirname(os.path.realpath(__file__)) + '/sliders.urdf'


def use_own_master(**environment):
    """Has this process and those that it starts talk to a master of their own, on a port that is free.

    Further variables of the environment come as arguments. Returns the port; nothing listens there yet.
    """
    with socket.socket() as free:
        free.bind(('', 0))
        port = free.getsockname()[1]
    os.environ.update(environment, ROS_MASTER_URI='http://127.0.0.1:%d' % port, ROS_IP='127.0.0.1')
    os.environ.pop('ROS_HOSTNAME', None)
    return port


def start_master(port, patience=PATIENCE):
    """The process of a master that answers."""
    master = subprocess.Popen(['rosmaster', '--core', '-p', str(port)], stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL)
    end = time.monotonic() + patience
    while not rosgraph.is_master_online():
        if time.monotonic() > end or master.poll() is not None:
            master.kill()
            master.wait()
            raise RuntimeError('no master')
        time.sleep(0.1)
    return master


class MasterCase(unittest.TestCase):
    """Has a master, and processes that talk to it and end with the tests."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.children = []
        cls.port = use_own_master(ROS_HOME=cls.folder.name)
        cls.start_master()

    @classmethod
    def start_master(cls):
        cls.master = start_master(cls.port)

    @classmethod
    def start(cls, *command):
        # A group of its own: what it starts, as `rosbag play` its player, is to end with it.
        child = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
        cls.children.append(child)
        return child

    @classmethod
    def start_monitor(cls, name, urdf, parameters):
        """The process of a monitor with these parameters; `urdf` is the text."""
        rospy.set_param('/' + name, {'robot_description': urdf, 'robot_description_semantic': '', 'cache': False,
                                     **parameters})
        return cls.start('rosrun', 'sdf_ccd', 'collision_monitor', '__name:=' + name)

    @staticmethod
    def kill(child):
        if child.poll() is None:
            os.killpg(child.pid, signal.SIGKILL)
        child.wait()

    @classmethod
    def tearDownClass(cls):
        for child in reversed(cls.children):
            cls.kill(child)
        cls.master.kill()
        cls.master.wait()
        cls.folder.cleanup()


def sliders():
    """The text of sliders.urdf."""
    with open(SLIDERS) as file:
        return file.read()
