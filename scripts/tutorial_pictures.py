#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes the pictures of doc/tutorial.md from generated scenes.

  tutorial_pictures.py BUILD

BUILD is a build folder with the apps and the examples. Needs python3-matplotlib, python3-numpy
and python3-pil.
"""
import json
import pathlib
import subprocess
import sys
import tempfile

import matplotlib.pyplot as plt
import numpy
from matplotlib.colors import BoundaryNorm
from PIL import Image

from accuracy_tables import DOC

WIDTH, HEIGHT = 480, 360
FOCAL = 525 * WIDTH / 640


def save(figure, name):
    path = DOC / 'pictures' / f'tutorial_{name}.png'
    figure.savefig(path, dpi=80)
    plt.close(figure)
    Image.open(path).convert('RGB').quantize(255).save(path, optimize=True)


def picture_axes(columns=1):
    figure, axes = plt.subplots(1, columns, figsize=(6.2 * columns, 4.65),
                                layout='constrained', squeeze=False)
    for one in axes[0]:
        one.set_axis_off()
        one.set_xlim(-0.5, WIDTH - 0.5)
        one.set_ylim(HEIGHT - 0.5, -0.5)
    return figure, axes[0]


def project(points):
    """Pixels of points in the frame of the camera."""
    points = numpy.asarray(points)
    return (points[:, :2] / points[:, 2:] * FOCAL +
            [(WIDTH - 1) / 2, (HEIGHT - 1) / 2])


def rays():
    u, v = numpy.meshgrid(numpy.arange(WIDTH), numpy.arange(HEIGHT))
    return numpy.stack([(u - (WIDTH - 1) / 2) / FOCAL, (v - (HEIGHT - 1) / 2) / FOCAL,
                        numpy.ones_like(u)], axis=-1)


def read_pcd(path):
    """Fields of an ASCII or binary PCD of 4-byte numbers."""
    content = path.read_bytes()
    start = content.index(b'DATA')
    header = dict(line.split(' ', 1) for line in content[:start].decode().splitlines()
                  if ' ' in line)
    names = header['FIELDS'].split()
    kinds = [{'F': 'f4', 'U': 'u4', 'I': 'i4'}[kind] for kind in header['TYPE'].split()]
    body = content[content.index(b'\n', start) + 1:]
    data = numpy.frombuffer(body, list(zip(names, kinds)), int(header['POINTS']))
    return data.reshape(int(header['HEIGHT']), int(header['WIDTH']))


def read_ply(path):
    """Vertices of a binary PLY."""
    content = path.read_bytes()
    start = content.index(b'end_header')
    header = [line.split() for line in content[:start].decode().splitlines()]
    kinds = {'float': 'f4', 'uchar': 'u1', 'uint': 'u4'}
    fields = [(line[2], kinds[line[1]]) for line in header if line[0] == 'property']
    count = next(int(line[2]) for line in header if line[:2] == ['element', 'vertex'])
    return numpy.frombuffer(content[content.index(b'\n', start) + 1:], fields, count)


def gray_of(cloud):
    rgb = cloud['rgb'].view('u4')
    return ((rgb >> 16 & 255) + (rgb >> 8 & 255) + (rgb & 255)) / 765 * 0.6 + 0.4


class Tutorial:
    def __init__(self, build, folder):
        self.build = build
        self.folder = folder

    def run(self, program, *arguments):
        subprocess.run([self.build / program, *arguments], check=True, cwd=self.folder,
                       stdout=subprocess.DEVNULL)

    def scene(self, *arguments):
        self.run('apps/pcl_mrf_plane_scene', 'in.pcd', '--width', str(WIDTH), '--height',
                 str(HEIGHT), '--format', 'binary', '--truth', 'truth.png', *arguments)

    def segment(self, *arguments):
        self.run('apps/pcl_mrf_plane_segmentation', 'in.pcd', 'out.pcd', '--quiet',
                 '--models', 'report.json', '--label-image', 'labels.png', *arguments)
        return json.loads((self.folder / 'report.json').read_text())

    def learn_colours(self):
        """Those that the apps give to labels: of all the small planes of a scene."""
        self.segment('--ply', 'coloured.ply', '--min-evidence', '0', '--min-points', '8',
                     '--fan-parts', '0', '--bend-angle', '720')
        points = read_ply(self.folder / 'coloured.ply')
        labels, first = numpy.unique(points['label'], return_index=True)
        self.colours = numpy.full((labels.max() + 1, 3), 128 / 255)
        for name, channel in (('red', 0), ('green', 1), ('blue', 2)):
            self.colours[labels, channel] = points[name][first] / 255

    def colour_of(self, labels):
        """Those of one label or an image of labels: 0 is gray; they start anew after the last."""
        numbers = numpy.asarray(labels).astype(int)
        count = len(self.colours) - 1
        return self.colours[numpy.where(numbers > 0, (numbers - 1) % count + 1, 0)]

    def image(self, name):
        return numpy.array(Image.open(self.folder / name))

    def cloud(self, name='out.pcd'):
        return read_pcd(self.folder / name)


def uncertainty(tutorial):
    """Standard deviation of each plane at each of its points, along its normal."""
    report = tutorial.segment()
    labels = tutorial.image('labels.png')
    sigma = numpy.full(labels.shape, numpy.nan)
    for plane in report['planes']:
        if plane['uncertainty'] is None:
            continue
        inside = labels == plane['label']
        abcd = numpy.array(plane['uncertainty']['coefficients'])
        ray = rays()[inside]
        points = -abcd[3] / (ray @ abcd[:3])[:, None] * ray
        ones = numpy.column_stack([points, numpy.ones(len(points))])
        covariance = numpy.array(plane['uncertainty']['covariance'])
        variance = numpy.einsum('ni,ij,nj->n', ones, covariance, ones)
        sigma[inside] = 1e3 * numpy.sqrt(numpy.maximum(variance, 1e-12))
    figure, (axes,) = picture_axes()
    shown = axes.imshow(sigma, cmap='viridis', norm='log', interpolation='nearest')
    figure.colorbar(shown, ax=axes, shrink=0.8, format='{x:g}',
                    label='standard deviation, mm')
    axes.set_title('how well the place of each plane is known, along its normal')
    save(figure, 'uncertainty')


def close(ring):
    return project(ring + ring[:1])


def outlines(tutorial):
    report = tutorial.segment('--outlines', '--outline-tolerance', '0.02',
                              '--min-hole-area', '0.002')
    figure, axes = picture_axes(2)
    for one in axes:
        one.imshow(gray_of(tutorial.cloud()), cmap='gray', vmin=0, vmax=1)
    for plane in report['planes']:
        colour = tutorial.colour_of(plane['label'])
        axes[1].plot(*close(plane['hull']).T, '-', color=colour, linewidth=1.5)
        for patch in plane['patches']:
            outer = close(patch['outer'])
            axes[0].fill(*outer.T, color=colour, alpha=0.45)
            axes[0].plot(*outer.T, '.-', color=colour, linewidth=1.5, markersize=4)
            for hole in patch['holes']:
                axes[0].plot(*close(hole).T, '.-', color='black', linewidth=1,
                             markersize=3)
    axes[0].set_title('patches, holes in black')
    axes[1].set_title('convex hulls')
    save(figure, 'outlines')


def creases(tutorial):
    report = tutorial.segment('--creases')
    figure, (axes,) = picture_axes()
    axes.imshow(gray_of(tutorial.cloud()), cmap='gray', vmin=0, vmax=1)
    for crease in report['creases']:
        ends = project([crease['start'], crease['end']])
        axes.plot(*ends.T, 'o-', linewidth=2.5, markersize=4,
                  color='#d62728' if crease['convex'] else '#1f77b4')
    axes.set_title('where planes meet: convex red, concave blue')
    save(figure, 'creases')


def confidence(tutorial):
    tutorial.segment('--confidence-image', 'confidence.png')
    figure, axes = picture_axes(2)
    axes[0].imshow(tutorial.colour_of(tutorial.image('labels.png')),
                   interpolation='nearest')
    limits = [0, 0.3, 0.5, 0.7, 0.8, 0.9, 0.95, 0.97, 1]
    shown = axes[1].imshow(tutorial.image('confidence.png') / 65535, cmap='magma',
                           norm=BoundaryNorm(limits, 256), interpolation='nearest')
    figure.colorbar(shown, ax=axes[1], shrink=0.8, format='{x:g}')
    axes[0].set_title('labels')
    axes[1].set_title('confidence')
    save(figure, 'confidence')


def projection(tutorial):
    """A row of the image from above, before and after."""
    tutorial.segment('--project', 'ray')
    before = tutorial.cloud('in.pcd')[HEIGHT // 2 + 40]
    after = tutorial.cloud()[HEIGHT // 2 + 40]
    figure, axes = plt.subplots(figsize=(9, 4), layout='constrained')
    axes.plot(before['x'], before['z'], '.', color='#bbbbbb', markersize=3,
              label='as measured')
    on_plane = after['label'] > 0
    axes.plot(after['x'][on_plane], after['z'][on_plane], '.', color='#d62728',
              markersize=2, label='on their planes')
    axes.set_aspect('equal')
    axes.set_xlabel('x, metres')
    axes.set_ylabel('z, metres')
    axes.grid(True, alpha=0.25)
    axes.legend(markerscale=4)
    save(figure, 'projection')


def objects(tutorial):
    tutorial.scene('--scene', 'box_on_table', '--noise', '0.3')
    tutorial.segment()
    figure, axes = picture_axes(2)
    for one, method, title in ((axes[0], 'pcl', 'OrganizedMultiPlaneSegmentation'),
                               (axes[1], 'mrf', 'MRFPlaneSegmentation')):
        tutorial.run('examples/objects_on_table', 'in.pcd', method, 'objects.pcd')
        found = tutorial.cloud('objects.pcd')['label'].astype(int)
        one.imshow(gray_of(tutorial.cloud()), cmap='gray', vmin=0, vmax=1)
        one.imshow(numpy.dstack([tutorial.colour_of(found), 0.75 * (found > 0)]),
                   interpolation='nearest')
        one.set_title(f'objects with the planes of {title}')
    save(figure, 'objects')


def denoising(tutorial):
    tutorial.scene('--scene', 'stairs', '--noise', '0')
    clean = (tutorial.image('truth.png') * 20).astype(numpy.uint8)
    random = numpy.random.default_rng(1)
    noisy = numpy.where(random.random(clean.shape) < 0.3,
                        random.choice(numpy.unique(clean), clean.shape), clean)
    Image.fromarray(noisy).save(tutorial.folder / 'noisy.png')
    tutorial.run('examples/denoise_labels', 'noisy.png', 'clean.png', '0.6')
    figure, axes = picture_axes(2)
    for one, name, title in ((axes[0], 'noisy.png', 'three in ten pixels are chance'),
                             (axes[1], 'clean.png', 'after belief propagation')):
        one.imshow(tutorial.colour_of(tutorial.image(name) // 20), interpolation='nearest')
        one.set_title(title)
    save(figure, 'denoising')


def main():
    if len(sys.argv) != 2:
        sys.exit('usage: tutorial_pictures.py BUILD')
    with tempfile.TemporaryDirectory() as folder:
        tutorial = Tutorial(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(folder))
        tutorial.scene('--seed', '0', '--noise', '1')
        tutorial.learn_colours()
        for make in (uncertainty, outlines, creases, confidence, projection, objects,
                     denoising):
            make(tutorial)


if __name__ == '__main__':
    main()
