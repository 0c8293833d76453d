"""The arm of config/demo/arm.urdf: its joints, and where they are when its hand points down."""
import math

JOINTS = ['yaw', 'shoulder', 'elbow', 'wrist', 'roll']
# [m]
SHOULDER_HEIGHT = 0.35
UPPER_ARM = 0.40
FOREARM = 0.35
HAND = 0.212  # wrist to the ball at the tip
TIP_RADIUS, FINGER = 0.008, 0.11


def joint_positions(tip):
    """The ball at the tip is at `tip`, the hand points down, the elbow up."""
    x, y, z = tip
    r, h = math.hypot(x, y), z + HAND - SHOULDER_HEIGHT
    d = math.hypot(r, h)
    lift = math.acos((UPPER_ARM ** 2 + d ** 2 - FOREARM ** 2) / (2.0 * UPPER_ARM * d))
    inner = math.acos((UPPER_ARM ** 2 + FOREARM ** 2 - d ** 2) / (2.0 * UPPER_ARM * FOREARM))
    shoulder = -(math.atan2(h, r) + lift)
    elbow = math.pi - inner
    return [math.atan2(y, x), shoulder, elbow, 0.5 * math.pi - shoulder - elbow, 0.0]


def tip_at(positions):
    """The inverse, of joint positions by name."""
    upper = positions['shoulder']
    fore = upper + positions['elbow']
    r = UPPER_ARM * math.cos(upper) + FOREARM * math.cos(fore)
    z = SHOULDER_HEIGHT - UPPER_ARM * math.sin(upper) - FOREARM * math.sin(fore) - HAND
    return r * math.cos(positions['yaw']), r * math.sin(positions['yaw']), z
