#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes the pictures of doc/tutorial.md: generated scenes as pcl_mrf_plane_viewer shows them.

  tutorial_pictures.py BUILD

BUILD is a build folder with the apps and the examples. Needs python3-numpy and python3-pil.
"""
import sys
import tempfile

import numpy
from PIL import Image

from viewer_pictures import Viewer, read_pcd, write_pcd

WIDTH, HEIGHT = 480, 360
ONE = '760x520'
HALF = '640x480'


def room(viewer):
    """What follows from the planes of the room."""
    viewer.scene('room.pcd', WIDTH, HEIGHT, '--seed', 0, '--noise', 1)
    viewer.look('room.pcd', 'tutorial_uncertainty', 'f 7', '800x520')
    viewer.look('room.pcd', 'tutorial_polygons', 'f 3 x', HALF)
    viewer.look('room.pcd', 'tutorial_hulls', 'f 3 x x', HALF)
    viewer.look('room.pcd', 'tutorial_creases', 'f 3 g', ONE)
    viewer.look('room.pcd', 'tutorial_confidence', 'f 4 i', '860x370')
    # From above: the ceiling hidden, faced by the floor, and that hidden, too.
    above = 'f tab d tab tab y d'
    viewer.look('room.pcd', 'tutorial_measured', above, HALF)
    viewer.look('room.pcd', 'tutorial_projected', above + ' j', HALF)


def objects(viewer):
    """The things on a table, with either class for the planes."""
    viewer.scene('table.pcd', WIDTH, HEIGHT, '--scene', 'box_on_table', '--noise', 0.3)
    for method in ('pcl', 'mrf'):
        viewer.run('examples/objects_on_table', 'table.pcd', method, 'objects.pcd')
        viewer.look('objects.pcd', f'tutorial_objects_{method}', 'f 8', HALF)


def denoising(viewer):
    """Labels of which three in ten are chance, and what belief propagation makes of them."""
    viewer.scene('stairs.pcd', WIDTH, HEIGHT, '--scene', 'stairs', '--noise', 0, '--truth',
                 'truth.png')
    stairs = read_pcd(viewer.folder / 'stairs.pcd')
    points = numpy.stack([stairs[axis] for axis in 'xyz'], axis=-1)
    right = numpy.array(Image.open(viewer.folder / 'truth.png')).astype('u1')
    random = numpy.random.default_rng(1)
    noisy = numpy.where(random.random(right.shape) < 0.3,
                        random.choice(numpy.unique(right), right.shape), right)
    Image.fromarray(noisy).save(viewer.folder / 'noisy.png')
    viewer.run('examples/denoise_labels', 'noisy.png', 'clean.png', 0.6)
    for name in ('noisy', 'clean'):
        labels = numpy.array(Image.open(viewer.folder / f'{name}.png'))
        write_pcd(viewer.folder / 'labelled.pcd', points, labels)
        viewer.look('labelled.pcd', f'tutorial_{name}', 'f 8', HALF)


def main():
    if len(sys.argv) != 2:
        sys.exit('usage: tutorial_pictures.py BUILD')
    with tempfile.TemporaryDirectory() as folder:
        viewer = Viewer(sys.argv[1], folder)
        for make in (room, objects, denoising):
            make(viewer)


if __name__ == '__main__':
    main()
