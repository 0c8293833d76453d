"""A separate ROS master for a test, and the processes that use it."""
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
    """Makes this process and its children use a separate master, on a free port.

    The arguments are further environment variables. Returns the port, on which nothing listens yet.
    """
    with socket.socket() as free:
        free.bind(('', 0))
        port = free.getsockname()[1]
    os.environ.update(environment, ROS_MASTER_URI='http://127.0.0.1:%d' % port, ROS_IP='127.0.0.1')
    os.environ.pop('ROS_HOSTNAME', None)
    return port


def start_master(port, patience=PATIENCE):
    """Starts a master. Returns its process once it answers."""
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
    """Runs a master, and processes that use it and end with the tests."""

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
        # In its own process group, so that its children (the player of `rosbag play`) end with it.
        child = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
        cls.children.append(child)
        return child

    @classmethod
    def start_monitor(cls, name, urdf, parameters):
        """Starts a monitor with these parameters; `urdf` is the text. Returns its process."""
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
