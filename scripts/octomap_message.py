"""octomap_msgs/Octomap, and the trees that it holds, where octomap_msgs is not installed: with its definition, and so its
checksum.
"""
import struct

import genpy.dynamic

DEPTH = 16  # of a tree; a voxel's keys are 0 to 2^DEPTH - 1, and those of the origin's are the middle ones, 2^(DEPTH - 1)
Octomap = genpy.dynamic.generate_dynamic('octomap_msgs/Octomap', """Header header
bool binary
string id
float64 resolution
int8[] data
================================================================================
MSG: std_msgs/Header
uint32 seq
time stamp
string frame_id
""")['octomap_msgs/Octomap']


def octree(voxels):
    """Of {(x, y, z): is_occupied}, all else being unknown: {child: a tree like this or, of a voxel, is_occupied}."""
    # In a voxel's code every octal digit is its child at one level: the bits of z, y and x there.
    nodes = {sum(int(format(c, 'b'), 8) << axis for axis, c in enumerate(key)): occupied
             for key, occupied in voxels.items()}
    for _ in range(DEPTH):
        above = {}
        for code in sorted(nodes):
            above.setdefault(code >> 3, {})[code & 7] = nodes[code]
        nodes = above
    return nodes.get(0, {})


def binary_data(tree):
    """As OcTree::writeBinaryData()."""
    bits, below = 0, []
    for child, content in tree.items():
        if isinstance(content, dict):
            bits |= 0b11 << 2 * child
            below.append(binary_data(content))
        else:
            bits |= (0b10 if content else 0b01) << 2 * child
    return struct.pack('<H', bits) + b''.join(below)


def octomap(header, resolution, data, binary=True):
    return Octomap(header=header, binary=binary, id='OcTree', resolution=resolution,
                   data=list(struct.unpack('%db' % len(data), data)))
