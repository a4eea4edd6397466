#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Compiles the C++ blocks of doc/tutorial.md as one program, runs it on the room of the pictures,
and compares what each block prints with the text block behind it.

  tutorial_test.py [--update] SOURCE SCENE_APP WORK COMPILER [FLAG...]

--update writes what was printed into the page instead.
"""
import pathlib
import re
import subprocess
import sys

HEADERS = ['mrf_plane_segmentation', 'plane_uncertainty', 'region_parts', 'region_polygons',
           'plane_creases', 'plane_projection', 'label_confidence', 'grid_field',
           'belief_propagation', 'belief_gap', 'segmentation_stages']
STANDARD = ['algorithm', 'cmath', 'cstdint', 'iostream', 'vector']
ROOM = ['--width', '480', '--height', '360', '--seed', '0', '--noise', '1', '--format', 'binary']
MARK = 'end of a block'
# A block of code, and the block of text that may follow it.
BLOCK = re.compile(r'^```cpp\n(?P<code>.*?)^```\n(?:\n```text\n(?P<text>.*?)^```\n)?',
                   re.DOTALL | re.MULTILINE)


def program(blocks):
    lines = [f'#include <pcl_mrf_planes/{name}.h>' for name in HEADERS]
    lines += ['#include <pcl/io/pcd_io.h>'] + [f'#include <{name}>' for name in STANDARD]
    lines += ['int main(int, char** argv)', '{',
              'pcl::PointCloud<pcl::PointXYZ>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZ>);',
              'if (pcl::io::loadPCDFile(argv[1], *cloud) < 0) return 1;']
    for block in blocks:
        lines += [block['code'], f'std::cout << "{MARK}\\n";']
    return '\n'.join(lines + ['}', ''])


def printed_by(blocks, scene_app, work, compiler, flags):
    work.mkdir(parents=True, exist_ok=True)
    source, executable, room = work / 'tutorial.cpp', work / 'tutorial', work / 'room.pcd'
    source.write_text(program(blocks))
    libraries = [flag for flag in flags if re.match(r'-l|-L|-Wl|.*\.(so|a)(\.[0-9.]+)?$', flag)]
    others = [flag for flag in flags if flag not in libraries]
    subprocess.run([compiler, '-std=c++17', *others, source, '-o', executable, *libraries],
                   check=True)
    subprocess.run([scene_app, room, *ROOM], check=True)
    output = subprocess.run([executable, room], check=True, capture_output=True,
                            text=True).stdout
    return output.split(MARK + '\n')[:-1]


def updated(page, printed):
    """The page with what was printed in the blocks of text."""
    left = iter(printed)

    def replaced(match):
        text = next(left)
        code = f'```cpp\n{match["code"]}```\n'
        return code + (f'\n```text\n{text}```\n' if text else '')
    return BLOCK.sub(replaced, page)


def main():
    arguments = sys.argv[1:]
    update = '--update' in arguments
    if update:
        arguments.remove('--update')
    if len(arguments) < 4:
        sys.exit(__doc__)
    root, scene_app, work, compiler, *flags = arguments
    path = pathlib.Path(root) / 'doc' / 'tutorial.md'
    page = path.read_text()
    blocks = list(BLOCK.finditer(page))
    if len(blocks) < 8 or len(blocks) != page.count('```cpp'):
        sys.exit(f'doc/tutorial.md: only {len(blocks)} blocks of code were found')
    printed = printed_by(blocks, scene_app, pathlib.Path(work), compiler, flags)
    new_page = updated(page, printed)
    if update:
        path.write_text(new_page)
    elif new_page != page:
        for block, text in zip(blocks, printed):
            if text != (block['text'] or ''):
                print(f'{block["code"]}prints\n{text}not\n{block["text"]}')
        sys.exit('doc/tutorial.md: the code prints something else; '
                 'test/doc/tutorial_test.py --update puts it in')


if __name__ == '__main__':
    main()
