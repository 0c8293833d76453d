"""Shared by the tests of a running monitor: the robot's poses, the monitor's messages, and requests."""
import threading
import time
import unittest

import rospy
from geometry_msgs.msg import Point, Pose, Quaternion, TransformStamped
from shape_msgs.msg import SolidPrimitive
from std_msgs.msg import Header
from tf2_msgs.msg import TFMessage
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

from sdf_ccd.msg import ContactArray, Plan, RobotMotion, SceneChange, Verdict
from sdf_ccd.srv import QueryMotion, QueryMotionRequest

RADIUS, PLATE = 0.02, 0.4995         # of the balls of sliders.urdf, and x of the plate's face [m]
PERIOD, SAMPLE_PERIOD = 0.02, 0.033  # of MovingBalls and of MonitorCase [s]

# A cube of 1 m from the origin, as the text of a file.
CUBE = """OFF
8 12 0
0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 0 1\n1 0 1\n0 1 1\n1 1 1
3 0 2 3\n3 0 3 1\n3 4 5 7\n3 4 7 6\n3 0 1 5\n3 0 5 4\n3 2 6 7\n3 2 7 3\n3 0 4 6\n3 0 6 2\n3 1 3 7\n3 1 7 5
"""


def wait_for_service(name, kind, patience=60.0):
    """The proxy of a service, once the service is available."""
    rospy.wait_for_service(name, patience)
    return rospy.ServiceProxy(name, kind)


class Recorder:
    """Keeps all messages of a topic. Searches wait up to `patience` [s] of wall time."""

    def __init__(self, topic, kind, patience=20.0):
        self.condition, self.kept, self.patience = threading.Condition(), [], patience
        self.subscriber = rospy.Subscriber(topic, kind, self.keep, queue_size=1000)

    def keep(self, message):
        with self.condition:
            self.kept.append(message)
            self.condition.notify_all()

    @property
    def messages(self):
        """All messages so far."""
        with self.condition:
            return list(self.kept)

    def clear(self):
        with self.condition:
            self.kept.clear()

    def find(self, test, patience=None):
        """The first message that passes the test, among those present or arriving in time; else None."""
        end = time.monotonic() + (self.patience if patience is None else patience)
        with self.condition:
            seen = 0
            while True:
                for message in self.kept[seen:]:
                    if test(message):
                        return message
                seen = len(self.kept)
                if not self.condition.wait(max(0.0, end - time.monotonic())):
                    return None

    def find_new(self, test, patience=None):
        """The first message from now on that passes the test; None if none comes in time."""
        self.clear()
        return self.find(test, patience)

    def wait(self, test):
        """Whether the list of all messages passes the test, now or in time."""
        with self.condition:
            return self.condition.wait_for(lambda: test(self.kept), self.patience)

    def close(self):
        self.subscriber.unregister()


def pair_of(message, a, b):
    """The pair of these two bodies in the message; None if it is not listed."""
    return next((pair for pair in message.pairs if {pair.body_a, pair.body_b} == {a, b}), None)


def touches(message, a, b):
    pair = pair_of(message, a, b)
    return pair is not None and pair.verdict == Verdict.CONTACT


def transform(stamp, frame, x, y=0.0, parent='base'):
    """Transform of a frame without rotation relative to its parent."""
    sent = TransformStamped(header=Header(stamp=stamp, frame_id=parent), child_frame_id=frame)
    sent.transform.translation.x, sent.transform.translation.y, sent.transform.rotation.w = x, y, 1.0
    return sent


def ball_transforms(stamp, ball, other=0.0):
    """Transforms of the two balls of sliders.urdf at these x [m]; None leaves one out."""
    return TFMessage([transform(stamp, frame, x, y) for frame, x, y in (('ball', ball, 0.0), ('other', other, 0.5))
                      if x is not None])


def pose(x=0.0, y=0.0, z=0.0):
    return Pose(position=Point(x, y, z), orientation=Quaternion(0, 0, 0, 1))


def box(name, where, size=(0.1, 0.1, 0.1), frame=''):
    """A change that adds a box."""
    return SceneChange(operation=SceneChange.ADD, id=name, pose=where, header=Header(frame_id=frame),
                       primitives=[SolidPrimitive(type=SolidPrimitive.BOX, dimensions=size)])


class MovingBalls:
    """Sends transforms of the balls of sliders.urdf from now on; set `ball`. Other frames rest at (x, y) [m]."""

    def __init__(self, **frames):
        self.ball, self.frames = 0.0, frames
        self.tf = rospy.Publisher('/tf', TFMessage, queue_size=1000)
        threading.Thread(target=self.send, daemon=True).start()

    def send(self):
        while not rospy.is_shutdown():
            frames = {'ball': (self.ball, 0.0), 'other': (0.0, 0.5), **self.frames}
            # Each transform has its own stamp, as if from several nodes.
            self.tf.publish(TFMessage([transform(rospy.Time.now(), frame, x, y) for frame, (x, y) in frames.items()]))
            time.sleep(PERIOD)


def trajectory(joint, positions):
    """A request to query_motion, with one second between positions."""
    points = [JointTrajectoryPoint(positions=[p], time_from_start=rospy.Duration(float(i)))
              for i, p in enumerate(positions)]
    motion = RobotMotion(joint_trajectory=JointTrajectory(joint_names=[joint], points=points))
    return QueryMotionRequest(motion=motion)


class MonitorCase(unittest.TestCase):
    """A ready monitor of sliders.urdf that receives the poses of the balls sample by sample."""

    @classmethod
    def setUpClass(cls):
        cls.tf = rospy.Publisher('/tf', TFMessage, queue_size=1000)
        cls.contacts = Recorder('/collision_monitor/contacts', ContactArray)
        cls.query_motion = wait_for_service('/collision_monitor/query_motion', QueryMotion)
        cls.stamp = rospy.Time.now()
        assert Recorder('/collision_monitor/plan', Plan).find(
            lambda m: any(body.name == 'plate' for body in m.bodies), 60.0), 'no plan'
        end = time.monotonic() + 30.0
        while cls.contacts.find(lambda m: m.verdict == Verdict.CLEAR, 0.0) is None:
            assert time.monotonic() < end, 'no complete cycle'
            cls.send(0.0)

    @classmethod
    def send(cls, ball, other=0.0):
        """Sends one sample, see ball_transforms()."""
        cls.stamp = max(cls.stamp + rospy.Duration(SAMPLE_PERIOD), rospy.Time.now() - rospy.Duration(0.1))
        cls.tf.publish(ball_transforms(cls.stamp, ball, other))
        rospy.sleep(SAMPLE_PERIOD)
