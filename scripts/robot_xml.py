"""A robot's URDF as the scripts read it."""
import re
import xml.etree.ElementTree as ElementTree


def robot_in(urdf):
    """The root element of a URDF's text."""
    # Comments that real URDFs have, with two hyphens inside, are no XML.
    return ElementTree.fromstring(re.sub('<!--.*?-->', '', urdf, flags=re.DOTALL).encode())


def child(joint):
    """The name of a joint's child link; None if it has none."""
    return joint.find('child').get('link') if joint.find('child') is not None else None


def root_link(urdf):
    """The link that is no joint's child; None if there is none."""
    robot = robot_in(urdf)
    children = {child(joint) for joint in robot.findall('joint')}
    return next((link.get('name') for link in robot.findall('link') if link.get('name') not in children), None)
