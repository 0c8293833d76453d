"""A mesh, a robot of two links and a bag in which they pass each other, for faults.py."""
import collections
import math
import os

Inputs = collections.namedtuple('Inputs', 'mesh urdf bag')

URDF = """<robot name="rings">
  <link name="base"><collision><geometry><mesh filename="file://{mesh}"/></geometry></collision></link>
  <link name="ring"><collision><geometry><mesh filename="file://{mesh}" scale="0.8 0.8 1.1"/></geometry></collision></link>
  <link name="carriage"/>
  <joint name="lift" type="prismatic"><parent link="base"/><child link="carriage"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="1" velocity="9"/></joint>
  <joint name="slide" type="prismatic"><parent link="carriage"/><child link="ring"/><axis xyz="1 0 0"/>
    <limit lower="-1" upper="1" effort="1" velocity="9"/></joint>
</robot>
"""


def torus(major=0.2, minor=0.08, around=48, across=24):
    """A torus as a closed mesh in OFF format."""
    lines = ['OFF', '%d %d 0' % (around * across, 2 * around * across)]
    for i in range(around):
        for k in range(across):
            u, v = 2 * math.pi * i / around, 2 * math.pi * k / across
            r = major + minor * math.cos(v)
            lines.append('%.9g %.9g %.9g' % (r * math.cos(u), r * math.sin(u), minor * math.sin(v)))
    for i in range(around):
        for k in range(across):
            a, b = i * across + k, (i + 1) % around * across + k
            c, d = (i + 1) % around * across + (k + 1) % across, i * across + (k + 1) % across
            lines += ['3 %d %d %d' % (a, b, c), '3 %d %d %d' % (a, c, d)]
    return '\n'.join(lines) + '\n'


def write_bag(path, seconds=3.0, rate=30.0):
    import rosbag
    import rospy
    from geometry_msgs.msg import TransformStamped
    from tf2_msgs.msg import TFMessage
    with rosbag.Bag(path, 'w') as bag:
        for i in range(int(seconds * rate)):
            stamp = rospy.Time.from_sec(1000.0 + i / rate)
            message = TFMessage()
            for parent, child, x in (('base', 'carriage', 0.0), ('carriage', 'ring', 0.9 * math.cos(2.0 * i / rate))):
                moved = TransformStamped()
                moved.header.stamp, moved.header.frame_id, moved.child_frame_id = stamp, parent, child
                moved.transform.translation.x, moved.transform.rotation.w = x, 1.0
                message.transforms.append(moved)
            bag.write('/tf', message, stamp)


def write_inputs(folder):
    inputs = Inputs(*(os.path.join(folder, name) for name in ('torus.off', 'rings.urdf', 'rings.bag')))
    with open(inputs.mesh, 'w') as mesh:
        mesh.write(torus())
    with open(inputs.urdf, 'w') as urdf:
        urdf.write(URDF.format(mesh=inputs.mesh))
    write_bag(inputs.bag)
    return inputs
