"""Voxel maps for tests, and tests of messages about them."""
import math
import os
import struct
import sys

import rospy
from std_msgs.msg import Header

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)) + '/../../scripts')
from octomap_message import Octomap, binary_data, octomap, octree  # noqa: E402, F401

from sdf_ccd.msg import Verdict  # noqa: E402

SIZE = 0.05  # of a voxel [m]


def full_data(tree):
    """The bytes that OcTree::writeData() writes."""
    if not isinstance(tree, dict):
        return struct.pack('<fB', 0.85 if tree else -0.4, 0)
    return struct.pack('<fB', 0.85, sum(1 << child for child in tree)) + b''.join(map(full_data, tree.values()))


def voxels_near(x, y, z, radius, is_occupied=True):
    """Voxels whose centres are within the radius."""
    reach = int(radius / SIZE) + 1
    middle = [int(math.floor(c / SIZE)) for c in (x, y, z)]
    near = {}
    for dx in range(-reach, reach + 1):
        for dy in range(-reach, reach + 1):
            for dz in range(-reach, reach + 1):
                v = (middle[0] + dx, middle[1] + dy, middle[2] + dz)
                if math.dist([SIZE * (c + 0.5) for c in v], (x, y, z)) <= radius:
                    near[tuple(32768 + c for c in v)] = is_occupied
    return near


def message(voxels, is_binary=True):
    data = (binary_data if is_binary else full_data)(octree(voxels))
    return octomap(Header(stamp=rospy.Time.now(), frame_id='base'), SIZE, data, is_binary)


def touches_map(m):
    """Whether the ball touches the map in a message."""
    return any(p.verdict == Verdict.CONTACT and 'ball' in (p.body_a, p.body_b) and
               any(b.startswith('octomap/') for b in (p.body_a, p.body_b)) for p in m.pairs)
