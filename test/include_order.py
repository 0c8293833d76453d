#!/usr/bin/env python3
"""Each folder of src and include/sdf_ccd includes only those before it in README's table of folders.

usage: include_order.py SOURCE_DIRECTORY
"""
import os
import re
import sys

ROS = ['tf', 'messages', 'parameters', 'world', 'monitor', 'bag']  # the folders of src/ros
# The programs' main files and the reader's process are outside the order: nothing includes them.
ANYWHERE = {'reader'}


def ordered_folders(root):
    """The folders in their order."""
    with open(os.path.join(root, 'README.md'), encoding='utf-8') as readme:
        table = readme.read().split('## Source folders', 1)[1].split('Tests are in', 1)[0]
    return re.findall(r'^\| `(\w+)` \|', table, re.M)


def includes(root):
    """(file, its folder, the folder that it includes) of all quoted includes that name a folder."""
    for top in ('src', 'include/sdf_ccd'):
        for directory, _, files in os.walk(os.path.join(root, top)):
            path = os.path.relpath(directory, os.path.join(root, top)).split(os.sep)
            for name in files:
                if not name.endswith(('.h', '.cpp')):
                    continue
                file = os.path.join(directory, name)
                with open(file, encoding='utf-8') as source:
                    for included in re.findall(r'#include "(?:sdf_ccd/)?([\w/]+)/[\w.-]+\.h"', source.read()):
                        yield os.path.relpath(file, root), path, included.split('/')


def main():
    root = sys.argv[1]
    order = ordered_folders(root)
    if len(order) < 10:
        sys.exit('README.md has no table of folders')
    wrong = []
    count = 0
    for file, path, included in includes(root):
        if included[0] not in order or path[0] not in order or {path[0], included[0]} & ANYWHERE:
            continue
        count += 1
        if order.index(included[0]) > order.index(path[0]):
            wrong.append('%s includes %s' % (file, '/'.join(included)))
        elif path[0] == included[0] == 'ros' and ROS.index(included[1]) > ROS.index(path[1]):
            wrong.append('%s includes %s' % (file, '/'.join(included)))
    if count < 500:
        sys.exit('%d includes were found only' % count)
    if wrong:
        sys.exit('These look back:\n' + '\n'.join(wrong))
    print('%d includes look one way' % count)


if __name__ == '__main__':
    main()
