"""A ROS master of a test's own, beside those of others."""
import os
import socket
import subprocess
import time

import rosgraph


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


def start_master(port, patience=60.0):
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
