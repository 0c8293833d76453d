"""A world that changes under the monitor: an OctoMap that gains and loses a wall, or stays away, and clients that add
meshes and boxes without end.
"""
import os
import random
import sys
import threading
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), '../../scripts'))
from octomap_message import DEPTH, Octomap, binary_data, octomap, octree  # noqa: E402

TOPIC = 'soak_map'
MAX_AGE = 1.0                            # [s] of the parameter octomap/max_age
RESOLUTION, PERIOD = 0.05, 0.2           # [m, s] of the maps
HOLD, LONGEST = 0.7, 15.0                # [s] until a map changes once it is seen, and after which it is given up
PAUSE = 10                               # after so many changes maps stay away until the monitor says so


def voxels(low, high):
    """Keys of the voxels of a box [m]."""
    ranges = [range(round(a / RESOLUTION) + (1 << DEPTH - 1), round(b / RESOLUTION) + (1 << DEPTH - 1))
              for a, b in zip(low, high)]
    return [(x, y, z) for x in ranges[0] for y in ranges[1] for z in ranges[2]]


class ChangingMap:
    """Publishes maps in a frame, and measures how long the monitor takes to see that one has changed, and that none
    arrives any more."""

    def __init__(self, rospy, frame):
        from sdf_ccd.msg import MonitorState, Plan, Verdict
        from std_msgs.msg import Header
        far, wall = voxels((3, -1, 0), (3.05, 1, 1)), voxels((1.5, -1, 0), (1.55, 1, 1))
        self.data = {is_there: binary_data(octree({**dict.fromkeys(wall, is_there), **dict.fromkeys(far, True)}))
                     for is_there in (False, True)}
        self.changed, self.wall, self.sent = threading.Condition(), False, None
        self.tiles, self.unchecked = 0, False
        self.seen, self.missed, self.aged = [], 0, []
        publisher = rospy.Publisher(TOPIC, Octomap, queue_size=1)

        def publish():
            while True:
                if self.wall is not None:
                    header = Header(stamp=rospy.Time.now(), frame_id=frame)
                    publisher.publish(octomap(header, RESOLUTION, self.data[self.wall]))
                    self.sent = self.sent or time.monotonic()
                time.sleep(PERIOD)

        def read_plan(plan):
            with self.changed:
                self.tiles = sum(body.name.startswith('octomap') for body in plan.bodies)
                self.changed.notify_all()

        def read_state(state):
            with self.changed:
                self.unchecked = state.cycle.not_checked > 0 or state.verdict == Verdict.NOT_CHECKED
                self.changed.notify_all()

        rospy.Subscriber('collision_monitor/plan', Plan, read_plan, queue_size=100)
        rospy.Subscriber('collision_monitor/state', MonitorState, read_state, queue_size=100)
        for work in (publish, self.alternate):
            threading.Thread(target=work, daemon=True).start()

    def wait(self, condition):
        with self.changed:
            return self.changed.wait_for(condition, LONGEST)

    def alternate(self):
        self.wait(lambda: self.tiles > 0)
        time.sleep(2.0)  # further tiles of the first map
        without = self.tiles
        while True:
            self.sent, self.wall = None, not self.wall
            start = time.monotonic()
            seen = self.wait(lambda: (self.tiles > without) == self.wall)
            self.seen.append(time.monotonic() - (self.sent or start) if seen else LONGEST)
            self.missed += not seen
            time.sleep(HOLD)
            if len(self.seen) % PAUSE == 0:
                wall, self.wall, start = self.wall, None, time.monotonic()
                noticed = self.wait(lambda: self.unchecked)
                self.aged.append(time.monotonic() - start if noticed else LONGEST)
                self.wall = wall

    def report(self):
        """(text, whether all was seen in time)"""
        if not self.seen or not self.aged:
            return 'maps: too few to tell', False
        seen = sorted(self.seen)
        text = ('%d maps that changed seen after %.2f s in the median, %.2f s at most, %d not; maps that stayed away %d '
                'times, noticed after %.2f to %.2f s' %
                (len(seen), seen[len(seen) // 2], seen[-1], self.missed, len(self.aged), min(self.aged), max(self.aged)))
        return text, self.missed == 0 and max(self.aged) < 2 * MAX_AGE


def rough_plate(cells, seed):
    from geometry_msgs.msg import Point
    from shape_msgs.msg import Mesh, MeshTriangle
    rng, row = random.Random(seed), cells + 1
    corners = [cell // cells * row + cell % cells for cell in range(cells * cells)]
    return Mesh(vertices=[Point(i / cells, j / cells, 0.05 * rng.random()) for i in range(row) for j in range(row)],
                triangles=[MeshTriangle(t) for a in corners for t in ((a, a + 1, a + row + 1), (a, a + row + 1, a + row))])


def random_triangles(count, seed):
    from geometry_msgs.msg import Point
    from shape_msgs.msg import Mesh, MeshTriangle
    rng = random.Random(seed)
    return Mesh(vertices=[Point(*(rng.uniform(-0.5, 0.5) for _ in range(3))) for _ in range(3 * count)],
                triangles=[MeshTriangle((3 * i, 3 * i + 1, 3 * i + 2)) for i in range(count)])


class Editors:
    """Clients of update_scene: two that replace rough plates, two boxes, one a mesh that takes longer than is allowed."""

    def __init__(self, rospy, frame):
        from geometry_msgs.msg import Point, Pose, Quaternion
        from sdf_ccd.msg import SceneChange
        from sdf_ccd.srv import UpdateScene
        from shape_msgs.msg import SolidPrimitive
        from std_msgs.msg import Header
        self.end, self.lock, self.changes, self.refused = False, threading.Lock(), 0, 0
        slow = random_triangles(20000, 1)

        def shapes(kind, number):
            if kind == 'boxes':
                return {'primitives': [SolidPrimitive(type=SolidPrimitive.BOX, dimensions=(0.1, 0.1, 0.1))]}
            return {'meshes': [slow if kind == 'slow' else rough_plate(60, number)]}

        def edit(kind, client):
            service, number = rospy.ServiceProxy('collision_monitor/update_scene', UpdateScene), 0
            while not self.end:
                number += 1
                change = SceneChange(operation=SceneChange.ADD, id='%s_%d_%d' % (kind, client, number % 8),
                                     header=Header(frame_id=frame), **shapes(kind, 2 * number + client),
                                     pose=Pose(Point(10 + 2 * client, 5.0, number % 8), Quaternion(w=1)))
                try:
                    changed = service(changes=[change]).success
                except (rospy.ServiceException, OSError):
                    changed = False
                with self.lock:
                    self.changes += changed
                    self.refused += not changed
                if not changed:
                    time.sleep(0.5)

        for kind, client in (('plates', 0), ('plates', 1), ('boxes', 0), ('boxes', 1), ('slow', 2)):
            threading.Thread(target=edit, args=(kind, client), daemon=True).start()
