#!/usr/bin/env python3
"""Each folder of src includes only those before it in README's table of folders; so do the public headers, and the tests
of each folder. Other folders of test (oracle, adversarial, ...) serve several and are not checked.

usage: include_order.py SOURCE_DIRECTORY
"""
import os
import re
import sys

# The folder from which on each public header may be included.
HEADERS = {'types': 'common', 'cancel': 'common', 'mesh': 'mesh', 'primitive': 'mesh', 'field': 'field',
           'trajectory': 'motion', 'segments': 'query', 'result': 'query', 'body': 'scene', 'robot': 'robot',
           'scene': 'scene', 'monitor': 'monitor', 'distances': 'monitor', 'robot_scene': 'robot_monitor',
           'simulation': 'dynamics'}
ROS = ['tf', 'messages', 'parameters', 'world', 'monitor', 'bag']  # the folders of src/ros


def ordered_folders(root):
    """The folders in their order."""
    with open(os.path.join(root, 'README.md'), encoding='utf-8') as readme:
        table = readme.read().split('## Source folders', 1)[1].split('Tests are in', 1)[0]
    return re.findall(r'^\| `(\w+)` \|', table, re.M)


def includes(root):
    """(file, its folder, the folder that it includes) of all quoted includes that name a folder or a public header."""
    for top in ('src', 'include/sdf_ccd', 'test'):
        for directory, _, files in os.walk(os.path.join(root, top)):
            path = os.path.relpath(directory, os.path.join(root, top)).split(os.sep)
            for name in files:
                if not name.endswith(('.h', '.cpp')):
                    continue
                file = os.path.join(directory, name)
                with open(file, encoding='utf-8') as source:
                    own = [HEADERS.get(name[:-2], '')] if top.startswith('include') else path
                    for included, header in re.findall(r'#include "([\w/]+)/([\w-]+)\.h"', source.read()):
                        folder = [HEADERS.get(header, '')] if included == 'sdf_ccd' else included.split('/')
                        yield os.path.relpath(file, root), own, folder


def looks_back(order, file, path, included):
    """Whether the included folder comes after the file's own."""
    if file.startswith('test') and path[0] == 'ros':  # all tests that need ROS, the tool's among them
        return False
    if path[0] == included[0] == 'ros':
        return ROS.index(included[1]) > ROS.index(path[1])
    return order.index(included[0]) > order.index(path[0])


def main():
    root = sys.argv[1]
    order = ordered_folders(root)
    if len(order) < 10:
        sys.exit('README.md has no table of folders')
    checked = [each for each in includes(root) if each[1][0] in order and each[2][0] in order]
    if len(checked) < 1000:
        sys.exit('%d includes were found only' % len(checked))
    wrong = ['%s includes %s' % (file, '/'.join(included)) for file, path, included in checked
             if looks_back(order, file, path, included)]
    if wrong:
        sys.exit('These look back:\n' + '\n'.join(wrong))
    print('%d includes look one way' % len(checked))


if __name__ == '__main__':
    main()
