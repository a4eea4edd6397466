#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes the pictures of doc/limits.md: scenes that the segmentation has trouble with.

  limit_scenes.py BUILD

BUILD is a build folder with the apps. What pcl_mrf_plane_scene does not make is traced here, ray
by ray, and handed over as a depth image or an organized PCD; pcl_mrf_plane_viewer takes the
pictures. Needs python3-numpy and python3-pil.
"""
import sys
import tempfile

import numpy
from PIL import Image

from viewer_pictures import Viewer, write_pcd

SEGMENTATION = 'apps/pcl_mrf_plane_segmentation'
WIDTH, HEIGHT = 320, 240
FOCAL = 525 * WIDTH / 640
CAMERA = f'{FOCAL},{FOCAL},{(WIDTH - 1) / 2},{(HEIGHT - 1) / 2},10000'


def camera_rays():
    """Directions with z = 1, x to the right, y down."""
    u, v = numpy.meshgrid(numpy.arange(WIDTH), numpy.arange(HEIGHT))
    return numpy.stack([(u - (WIDTH - 1) / 2) / FOCAL, (v - (HEIGHT - 1) / 2) / FOCAL,
                        numpy.ones(u.shape)], axis=-1)


# --- things to hit: each gives the way along every ray, infinite where it is missed ----------


def plane(rays, point, normal):
    with numpy.errstate(divide='ignore'):
        way = numpy.dot(point, normal) / (rays @ numpy.array(normal))
    return numpy.where(way > 0, way, numpy.inf)


def ellipsoid(rays, centre, axes):
    """The near side of an ellipsoid with half axes along x, y and z."""
    ray, offset = rays / axes, numpy.asarray(centre) / axes
    a, b, c = (ray * ray).sum(-1), ray @ offset, offset @ offset - 1
    root = b * b - a * c
    way = (b - numpy.sqrt(numpy.maximum(root, 0))) / a
    return numpy.where((root > 0) & (way > 0), way, numpy.inf)


def inside(rays, way, low, high):
    """The hits of way whose points lie in a box."""
    points = rays * numpy.where(numpy.isfinite(way), way, 0)[..., None]
    within = ((points >= low) & (points <= high)).all(-1)
    return numpy.where(within, way, numpy.inf)


def nearest(*ways):
    return numpy.minimum.reduce(ways)


def room(rays, distance):
    """A wall that faces the camera, and the floor 1.1 m below it."""
    return nearest(plane(rays, (0, 0, distance), (0, 0, -1)),
                   plane(rays, (0, 1.1, 0), (0, -1, 0)))


def kinect_noise(depth, factor=1.0, seed=1):
    """Depth with the random error of a Kinect v1: 1.4 mm at 1 m, growing with its square."""
    random = numpy.random.default_rng(seed)
    return depth + factor * 1.4e-3 * depth ** 2 * random.standard_normal(depth.shape)


# --- the scenes: depth along the camera's axis, metres, 0: nothing measured --------------


def person():
    """Somebody stands before a wall with the back to the camera."""
    rays = camera_rays()
    body = nearest(ellipsoid(rays, (0, -0.47, 1.9), (0.085, 0.12, 0.10)),
                   ellipsoid(rays, (0, -0.02, 1.9), (0.23, 0.36, 0.12)),
                   ellipsoid(rays, (-0.27, 0.0, 1.9), (0.06, 0.34, 0.07)),
                   ellipsoid(rays, (0.27, 0.0, 1.9), (0.06, 0.34, 0.07)),
                   ellipsoid(rays, (-0.1, 0.62, 1.9), (0.1, 0.48, 0.1)),
                   ellipsoid(rays, (0.1, 0.62, 1.9), (0.1, 0.48, 0.1)))
    return kinect_noise(nearest(body, room(rays, 3.2)))


def glass():
    """A wall with a window that sends nothing back, and a mirror that shows the room."""
    rays = camera_rays()
    wall = plane(rays, (0, 0, 2.5), (0, 0, -1))
    floor = plane(rays, (0, 1.1, 0), (0, -1, 0))
    window = numpy.isfinite(inside(rays, wall, (-1.1, -0.7, 2), (-0.2, 0.4, 3)))
    mirror = numpy.isfinite(inside(rays, wall, (0.2, -0.8, 2), (1.0, 0.6, 3)))
    mirrored = nearest(plane(rays, (0, 0, 4.5), (0, 0, -1)), floor,
                       plane(rays, (0.9, 0, 0), (-1, 0, 0)))
    depth = nearest(numpy.where(mirror, mirrored, wall), floor)
    return numpy.where(window, 0, kinect_noise(depth))


def relief():
    """Boards 3 cm thick on a wall that leads away, 1 to 6 m."""
    rays = camera_rays()
    normal = numpy.array([-0.8, 0, -0.6])
    along = numpy.array([0.6, 0, -0.8])
    wall = plane(rays, (0, 0, 2.4), normal)
    ways = [wall, plane(rays, (0, 1.1, 0), (0, -1, 0))]
    front = plane(rays, numpy.array([0, 0, 2.4]) + 0.03 * normal, normal)
    points = rays * numpy.where(numpy.isfinite(front), front, 0)[..., None]
    place = (points - (0, 0, 2.4)) @ along
    board = (numpy.mod(place, 0.7) < 0.4) & (abs(points[..., 1]) < 0.45)
    ways.append(numpy.where(board, front, numpy.inf))
    return kinect_noise(nearest(*ways))


def vault():
    """A round tower, and a long wall that bends gently."""
    rays = camera_rays()
    return kinect_noise(nearest(ellipsoid(rays, (-1.6, 0, 3.2), (1.2, 1e3, 1.2)),
                                ellipsoid(rays, (4.2, 0, 5.2), (5, 1e3, 3.2)),
                                room(rays, 4.5)))


def bars():
    """A fence of bars 2 cm wide before a wall."""
    rays = camera_rays()
    front = plane(rays, (0, 0, 1.8), (0, 0, -1))
    x, y = rays[..., 0] * 1.8, rays[..., 1] * 1.8
    wood = (numpy.mod(x, 0.09) < 0.02) & (y > -0.3)
    return kinect_noise(nearest(numpy.where(wood, front, numpy.inf), room(rays, 3.0)))


def lens():
    """A corridor through a lens that distorts, read as if it did not."""
    rays = camera_rays()
    r2 = (rays[..., :2] ** 2).sum(-1, keepdims=True)
    rays[..., :2] *= 1 + 0.15 * r2
    side = plane(rays, (1.2, 0, 0), (-1, 0, 0))
    return kinect_noise(nearest(side, plane(rays, (-1.1, 0, 0), (1, 0, 0)), room(rays, 2.6)), 0.5)


def far():
    """Cabinets 10, 20, 30 and 40 cm deep along a wall, 6 m away."""
    rays = camera_rays()
    ways = [room(rays, 6.0)]
    for k, deep in enumerate((0.1, 0.2, 0.3, 0.4)):
        front = plane(rays, (0, 0, 6.0 - deep), (0, 0, -1))
        x = -2.9 + 1.5 * k
        ways.append(inside(rays, front, (x, -0.6, 0), (x + 1.0, 1.1, 9)))
    return kinect_noise(nearest(*ways))


# --- a lidar that moves while it turns ---------------------------------------------------

BEAMS, COLUMNS, PERIOD = 64, 1024, 0.1


def lidar(speed, turning):
    """A scan of a street from a car, metres and radians a second; its points are put as if
    the car had stood still: no motion compensation."""
    azimuth = numpy.pi - 2 * numpy.pi * numpy.arange(COLUMNS) / COLUMNS
    time = PERIOD * numpy.arange(COLUMNS) / COLUMNS
    elevation = numpy.radians(numpy.linspace(15, -25, BEAMS))

    def rays_at(angle):
        angle, up = numpy.meshgrid(angle, elevation)
        return numpy.stack([numpy.cos(up) * numpy.cos(angle),
                            numpy.cos(up) * numpy.sin(angle), numpy.sin(up)], axis=-1)

    rays = rays_at(azimuth + turning * time)
    origin = numpy.stack(numpy.broadcast_arrays(speed * time, 0, 0), axis=-1)
    way = nearest(*(numpy.where(way > 0, way, numpy.inf) for way in (
        lidar_wall(rays, origin, point, normal) for point, normal in (
            ((0, 0, -1.8), (0, 0, 1)), ((14, 0, 0), (-1, 0, 0)), ((-12, 0, 0), (1, 0, 0)),
            ((0, 7, 0), (0, -1, 0)), ((0, -6, 0), (0, 1, 0))))))
    noise = numpy.random.default_rng(1).standard_normal(way.shape)
    return (rays_at(azimuth) * (way + 0.01 * noise)[..., None]).astype('f4')


def lidar_wall(rays, origin, point, normal):
    with numpy.errstate(divide='ignore'):
        return ((point - origin) @ numpy.array(normal)) / (rays @ numpy.array(normal))


# --- files -------------------------------------------------------------------------------


def write_depth(path, depth):
    values = numpy.round(depth * 1e4)
    Image.fromarray(numpy.where(values < 65535, values, 0).astype('u2')).save(path)


class Limits:
    """Makes scenes and has them looked at: planes, and beside them colour and depth."""

    def __init__(self, viewer):
        self.viewer = viewer

    def look(self, source, name, *options):
        self.viewer.look(source, f'limit_{name}', 'f i i i', '900x460', *options)

    def traced(self, scene):
        path = self.viewer.folder / f'{scene.__name__}.png'
        write_depth(path, scene())
        self.look(path, scene.__name__, '--camera', CAMERA)

    def merged_later(self, scene, name, tolerance):
        """The same with another --merge-tolerance, by way of a parameter file."""
        path = self.viewer.folder / f'{scene.__name__}.png'
        self.viewer.run(SEGMENTATION, path, 'out.pcd', '--camera', CAMERA, '--quiet',
                        '--merge-tolerance', tolerance, '--save-parameters', 'merge.txt')
        self.look(path, name, '--camera', CAMERA, '--parameters', 'merge.txt')

    def scanned(self, name, *motion):
        """A lidar's scan, from behind and above, in the labels of --wrap."""
        write_pcd(self.viewer.folder / 'lidar.pcd', lidar(*motion))
        self.viewer.run(SEGMENTATION, 'lidar.pcd', 'labelled.pcd', '--wrap', '--quiet')
        self.viewer.look('labelled.pcd', f'limit_{name}', 'f 8', '640x460')

    def made(self, name, *options, width=WIDTH, height=HEIGHT):
        self.viewer.scene('scene.pcd', width, height, *options)
        self.look('scene.pcd', name)


def main():
    if len(sys.argv) != 2:
        sys.exit('usage: limit_scenes.py BUILD')
    with tempfile.TemporaryDirectory() as folder:
        limits = Limits(Viewer(sys.argv[1], folder))
        for scene in (person, glass, vault, bars, lens, far, relief):
            limits.traced(scene)
        limits.merged_later(relief, 'relief_merged_later', 2)
        limits.made('round', '--scene', 'cylinder_room', '--noise', 3)
        limits.made('many_points', '--seed', 0)
        limits.made('few_points', '--seed', 0, width=WIDTH // 2, height=HEIGHT // 2)
        limits.scanned('lidar', 0, 0)
        limits.scanned('lidar_turning', 10, 1)


if __name__ == '__main__':
    main()
