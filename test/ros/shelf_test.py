#!/usr/bin/env python3
"""The second demo, as run by scripts/demo --scene shelf: an arm carries a box past a live map, and stops in time."""
import subprocess
import sys
import unittest

import rostest


class ShelfTest(unittest.TestCase):
    def test_box_is_carried_and_nobody_touched(self):
        report = subprocess.run(['rosrun', 'sdf_ccd', 'shelf_report'], stdout=subprocess.PIPE, text=True)
        self.assertEqual(report.returncode, 0, report.stdout)


if __name__ == '__main__':
    rostest.rosrun('sdf_ccd', 'shelf', ShelfTest, sys.argv)
