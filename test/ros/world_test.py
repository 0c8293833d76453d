#!/usr/bin/env python3
"""Changes the scene of a running monitor, and tests its cycles and answers."""
import os
import sys
import tempfile
import threading
import time
import unittest

import rospy
import rostest
from geometry_msgs.msg import Point, Vector3
from shape_msgs.msg import Mesh, MeshTriangle, SolidPrimitive
from std_msgs.msg import Header

from monitor_case import CUBE, MovingBalls, Recorder, box, pose, touches, wait_for_service
from sdf_ccd.msg import ContactArray, LeftOutPair, MonitorState, Plan, SceneChange, Verdict
from sdf_ccd.srv import GetPlan, QueryPoints, UpdateScene


class WorldTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.robot = MovingBalls(belt=(0.3, 3.0))
        cls.contacts, cls.states, cls.plans = (
            Recorder('/collision_monitor/' + topic, kind, 5.0)
            for topic, kind in (('contacts', ContactArray), ('state', MonitorState), ('plan', Plan)))
        cls.update = wait_for_service('/collision_monitor/update_scene', UpdateScene)
        cls.points = wait_for_service('/collision_monitor/query_points', QueryPoints)
        cls.get_plan = wait_for_service('/collision_monitor/get_plan', GetPlan)
        assert cls.contacts.find_new(lambda m: m.verdict == Verdict.CLEAR, 60.0), 'no complete cycle'

    def change(self, *changes, **more):
        answer = self.update(changes=list(changes), **more)
        self.assertTrue(answer.success, answer.message)
        self.assertTrue(answer.adopted)
        return answer

    def setUp(self):
        self.robot.ball = 0.0
        self.change(SceneChange(operation=SceneChange.REMOVE, id='*'), SceneChange(operation=SceneChange.FORGET_RULES))

    def touching(self, a, b, version):
        return self.contacts.find_new(lambda m: m.scene_version == version and touches(m, a, b))

    def clear(self, version):
        return self.contacts.find_new(lambda m: m.scene_version == version and m.verdict == Verdict.CLEAR)

    def test_an_object_comes_moves_and_goes(self):
        before = self.change().scene_version
        answer = self.change(box('box', pose(0.0)))
        self.assertEqual(answer.scene_version, before + 1)
        self.assertEqual(answer.objects, ['box'])
        self.assertIsNotNone(self.touching('ball', 'box', answer.scene_version))
        moved = self.change(SceneChange(operation=SceneChange.MOVE, id='box', pose=pose(0.4)))
        self.assertIsNotNone(self.clear(moved.scene_version))
        self.assertEqual(moved.prepared, 0)
        gone = self.change(SceneChange(operation=SceneChange.REMOVE, id='box'))
        self.assertEqual(gone.objects, [])
        self.assertIsNotNone(self.states.find_new(lambda m: m.scene_version == gone.scene_version))

    def test_an_object_follows_its_frame(self):
        answer = self.change(box('box', pose(-0.3, -3.0), frame='belt'))
        self.assertIsNotNone(self.touching('ball', 'box', answer.scene_version))
        lost = self.change(box('box', pose(), frame='nowhere'))
        found = self.states.find_new(lambda m: m.scene_version == lost.scene_version and any(
            'nowhere' in body.reason for body in m.unchecked))
        self.assertIsNotNone(found)
        self.assertEqual(found.verdict, Verdict.NOT_CHECKED)

    def test_a_grasped_object_is_checked_against_the_world(self):
        self.change(box('part', pose(0.06, 0.0, 0.0)), box('shelf', pose(1.0, 0.0), (0.2, 1.0, 1.0)))
        grasped = self.change(SceneChange(operation=SceneChange.ATTACH, id='part', link_name='ball'))
        self.assertIsNotNone(self.clear(grasped.scene_version))  # ball and part touch, which is allowed
        self.robot.ball = 0.8
        self.assertIsNotNone(self.touching('part', 'shelf', grasped.scene_version))
        self.robot.ball = 0.3
        self.assertIsNotNone(self.clear(grasped.scene_version))
        time.sleep(0.3)
        put = self.change(SceneChange(operation=SceneChange.DETACH, id='part'))
        self.robot.ball = -0.5
        self.assertIsNotNone(self.clear(put.scene_version))
        answer = self.points(header=Header(), points=[Point(0.36, 0.0, 0.0)])
        self.assertEqual(answer.points[0].body, 'part')
        self.assertEqual(answer.scene_version, put.scene_version)
        self.assertLess(answer.points[0].distance, -0.04)

    def test_shapes_are_appended_to_an_object(self):
        far = self.change(box('box', pose(0.0, 3.0)))
        append = SceneChange(operation=SceneChange.APPEND, id='box', primitive_poses=[pose(0.0, -3.0)],
                             primitives=[SolidPrimitive(type=SolidPrimitive.BOX, dimensions=(0.1, 0.1, 0.1))])
        self.assertIsNotNone(self.clear(far.scene_version))
        both = self.change(append)
        self.assertEqual(both.objects, ['box'])
        self.assertIsNotNone(self.touching('ball', 'box', both.scene_version))

    def test_a_pose_means_one_thing(self):
        self.change(box('part', pose(0.06, 0.0, 0.0)))
        for change, why in ((SceneChange(operation=SceneChange.ADD, id='new', primitives=box('new', pose()).primitives),
                             'write orientation.w: 1'),
                            (SceneChange(operation=SceneChange.MOVE, id='part'), 'write orientation.w: 1'),
                            (SceneChange(operation=SceneChange.ATTACH, id='part', link_name='ball', pose=pose(0.1)),
                             'MOVE it first'),
                            (box('new', pose(), (0.1, 0.1)), '2 dimensions instead of 3')):
            answer = self.update(changes=[change])
            self.assertFalse(answer.success)
            self.assertIn(why, answer.message)
        self.change(SceneChange(operation=SceneChange.ATTACH, id='part', link_name='ball'))
        answer = self.update(changes=[SceneChange(operation=SceneChange.DETACH, id='part', pose=pose(0.1))])
        self.assertIn('MOVE it first', answer.message)
        self.change(SceneChange(operation=SceneChange.DETACH, id='part'))

    def test_pairs_are_allowed_and_checked_again(self):
        self.change(box('box', pose()))
        allowed = self.change(SceneChange(operation=SceneChange.ALLOW, body_a='b?x', body_b='*'))
        self.assertIsNotNone(self.clear(allowed.scene_version))
        plan = self.get_plan().plan
        self.assertEqual(plan.scene_version, allowed.scene_version)
        names = [body.name for body in plan.bodies]
        left_out = {(names[pair.body_a], names[pair.body_b]): pair for pair in plan.left_out}
        self.assertEqual(left_out[('ball', 'box')].reason, 'update_scene: b?x - *')
        self.assertEqual(left_out[('ball', 'box')].kind, LeftOutPair.REQUEST)
        self.assertIn({'ball', 'other'}, [{names[pair.body_a], names[pair.body_b]} for pair in plan.checked])
        self.assertIsNotNone(self.plans.find(lambda m: m.scene_version == allowed.scene_version))
        checked = self.change(SceneChange(operation=SceneChange.CHECK, body_a='box', body_b='ball'))
        self.assertIsNotNone(self.touching('ball', 'box', checked.scene_version))

    def test_all_changes_or_none(self):
        before = self.change(box('kept', pose(1.0)))
        bad = SceneChange(operation=SceneChange.ADD, id='bad', pose=pose(0.0), primitives=[
            SolidPrimitive(type=SolidPrimitive.BOX, dimensions=(0.1, float('nan'), 0.1))])
        answer = self.update(changes=[box('new', pose(1.0)), SceneChange(operation=SceneChange.REMOVE, id='kept'), bad])
        self.assertFalse(answer.success)
        self.assertEqual(answer.failed_change, 2)
        self.assertIn('primitives[0]', answer.message)
        self.assertEqual(answer.scene_version, before.scene_version)
        self.assertEqual(answer.objects, ['kept'])

    def test_what_cannot_be_made_is_named(self):
        point = Mesh(vertices=[Point(0, 0, 0)] * 3, triangles=[MeshTriangle(vertex_indices=(0, 1, 2))])
        bad = SceneChange(operation=SceneChange.ADD, id='bad', pose=pose(0.0), meshes=[point])
        answer = self.update(changes=[box('new', pose(1.0)), bad, box('newer', pose(1.0))])
        self.assertFalse(answer.success)
        self.assertEqual(answer.failed_change, 1, answer.message)
        self.assertIn('bad', answer.message)

    def test_a_mesh_in_the_request(self):
        corners = [(x, y, z) for x in (-.1, .1) for y in (-.1, .1) for z in (-.1, .1)]
        quads = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
        triangles = [MeshTriangle(t) for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]
        mesh = Mesh(vertices=[Point(*c) for c in corners], triangles=triangles)
        answer = self.change(SceneChange(operation=SceneChange.ADD, id='mesh', pose=pose(0.05), meshes=[mesh]))
        self.assertGreaterEqual(answer.prepared, 1)
        self.assertIsNotNone(self.touching('ball', 'mesh', answer.scene_version))
        again = self.change(SceneChange(operation=SceneChange.ADD, id='twin', pose=pose(3.0), meshes=[mesh]))
        self.assertEqual(again.prepared, 0)

    def test_meshes_from_files(self):
        folder = tempfile.mkdtemp(dir='/tmp')
        file = os.path.join(folder, 'cube.off')
        with open(file, 'w') as out:
            out.write(CUBE)
        # A cube of 1 m with the ball in its corner, and one in millimetres, first beside the ball, then around it.
        for uri in (file, 'file://' + file):
            answer = self.change(SceneChange(operation=SceneChange.ADD, id='cube', pose=pose(-0.01, -0.01, -0.01),
                                             mesh_resources=[uri]))
            self.assertIsNotNone(self.touching('ball', 'cube', answer.scene_version))
            small = self.change(SceneChange(operation=SceneChange.ADD, id='cube', pose=pose(0.05, 0.0, 0.0),
                                            mesh_resources=[uri], mesh_resource_scales=[Vector3(0.1, 0.1, 0.1)]))
            self.assertIsNotNone(self.clear(small.scene_version))
            self.robot.ball = 0.06
            self.assertIsNotNone(self.touching('ball', 'cube', small.scene_version))
            self.robot.ball = 0.0
            time.sleep(0.2)
        # The mesh was read when the object was added.
        os.remove(file)
        moved = self.change(SceneChange(operation=SceneChange.MOVE, id='cube', pose=pose(-0.05, -0.05, -0.05)))
        self.assertIsNotNone(self.touching('ball', 'cube', moved.scene_version))

    def test_hostile_files_change_nothing(self):
        folder = tempfile.mkdtemp(dir='/tmp')
        before = self.change(box('kept', pose(1.0))).scene_version
        for name, content in (('empty.off', ''), ('count.off', 'OFF\n99999999 99999999 0\n0 0 0\n'),
                              ('nan.off', CUBE.replace('1 1 1\n', 'nan inf 1e300\n')),
                              ('index.off', CUBE.replace('3 0 2 3', '3 0 2 9')), ('not.stl', 'x' * 100),
                              ('text.off', 'root:x:0:0')):
            with open(os.path.join(folder, name), 'w') as out:
                out.write(content)
        os.symlink('/etc/passwd', os.path.join(folder, 'link.off'))
        os.symlink('/dev/zero', os.path.join(folder, 'zero.off'))
        os.symlink('/etc', os.path.join(folder, 'etc'))
        os.mkfifo(os.path.join(folder, 'pipe.off'))
        below = ['empty.off', 'count.off', 'nan.off', 'index.off', 'not.stl', 'text.off', 'link.off', 'zero.off',
                 'etc/passwd', 'pipe.off', 'missing.off', '', '.', '../' * 9 + 'etc/passwd', 'a\nb.off', 'x' * 100000]
        uris = [folder + '/' + name for name in below] + [
            '', '/etc/passwd', 'file:///etc/passwd', 'file://' + folder + '/../../etc/passwd', 'FILE:///etc/passwd',
            'relative.off', 'package://sdf_ccd/../../../../../../../etc/passwd', 'package://nowhere/mesh.off',
            'package://sdf_ccd', 'package://', 'http://127.0.0.1:9/mesh.stl', 'https://127.0.0.1:9/mesh.stl',
            'ftp://127.0.0.1/mesh.stl', '://', '/proc/self/environ', '/proc/self/mem']
        for uri in uris:
            start = time.monotonic()
            answer = self.update(changes=[SceneChange(operation=SceneChange.ADD, id='bad', pose=pose(0.0),
                                                      mesh_resources=[uri])])
            self.assertFalse(answer.success, uri[:80])
            self.assertEqual(answer.failed_change, 0, uri[:80])
            self.assertEqual(answer.scene_version, before)
            self.assertEqual(answer.objects, ['kept'])
            self.assertTrue(answer.message and answer.message.isprintable() and len(answer.message) < 2000,
                            answer.message[:3000])
            self.assertNotIn('root:', answer.message)
            self.assertLess(time.monotonic() - start, 10.0, uri[:80])
        # Worlds, maps and files to write cannot be elsewhere, either.
        for change in (SceneChange(operation=SceneChange.LOAD, file=folder + '/link.off'),
                       SceneChange(operation=SceneChange.LOAD, file=folder + '/pipe.off'),
                       SceneChange(operation=SceneChange.ADD, id='bad', pose=pose(0.0),
                                   octomap_file=folder + '/zero.off')):
            self.assertFalse(self.update(changes=[change]).success)
        for file in (folder + '/etc/out.scene', '/etc/out.scene', folder + '/../../etc/out.scene'):
            self.assertFalse(self.update(save_file=file).success, file)
        elsewhere = os.path.join(tempfile.mkdtemp(dir='/var/tmp'), 'elsewhere')
        for name in ('out.scene', 'out.scene.part'):
            os.symlink(elsewhere, os.path.join(folder, name))
        self.update(save_file=folder + '/out.scene')
        self.assertFalse(os.path.exists(elsewhere) or os.path.exists('/etc/out.scene'))
        self.assertIsNotNone(self.clear(before))

    def test_a_scene_is_saved_and_loaded(self):
        folder = tempfile.mkdtemp(dir='/tmp')
        file = os.path.join(folder, 'w.scene')
        self.change(box('a', pose(0.0)), box('b', pose(0.5)), save_file=file)
        self.change(SceneChange(operation=SceneChange.REMOVE, id='*'))
        answer = self.change(SceneChange(operation=SceneChange.LOAD, file=file))
        self.assertEqual(answer.objects, ['a', 'b'])
        self.assertIsNotNone(self.touching('ball', 'a', answer.scene_version))
        refused = self.update(changes=[SceneChange(operation=SceneChange.LOAD, file='/etc/w.scene')])
        self.assertIn('resource_roots', refused.message)

    def test_no_contact_is_missed_while_the_scene_changes(self):
        answer = self.change(box('wall', pose(0.0)))
        stop = threading.Event()
        errors = []

        def churn():
            i = 0
            proxy = rospy.ServiceProxy('/collision_monitor/update_scene', UpdateScene)
            while not stop.is_set():
                i += 1
                said = proxy(changes=[box('o%d' % (i % 7), pose(3.0 + i % 5))])
                if not said.success or not said.adopted:
                    errors.append(said.message)
        thread = threading.Thread(target=churn)
        thread.start()
        time.sleep(1.0)
        self.contacts.clear()
        time.sleep(3.0)
        heard = self.contacts.messages
        stop.set()
        thread.join()
        self.assertEqual(errors, [])
        self.assertGreater(heard[-1].scene_version, answer.scene_version + 20)
        self.assertGreater(len(heard), 40)
        for message in heard:
            self.assertTrue(touches(message, 'ball', 'wall'), message)
        ends = [m.header.stamp for m in heard]
        for earlier, later in zip(heard, heard[1:]):
            self.assertEqual(earlier.header.stamp, later.cycle.start)  # no time is left out
        self.assertEqual(ends, sorted(ends))


if __name__ == '__main__':
    rospy.init_node('world_test')
    rostest.rosrun('sdf_ccd', 'world', WorldTest, sys.argv)
