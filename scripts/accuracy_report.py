#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Turns CSVs of measurements into the tables and plots of doc/accuracy.md.

  accuracy_report.py [--peers CSV] [--machine TEXT]

Each option that names a CSV stands for a block of the page: what lies between
"<!-- begin NAME -->" and "<!-- end NAME -->" is written anew, its plots in doc/pictures.
Blocks whose CSV is not given stay as they are. Needs python3-matplotlib.
"""
import argparse
import collections
import csv
import os
import pathlib
import re
import statistics

import matplotlib
matplotlib.use('Agg')
import matplotlib.pyplot as plt  # noqa: E402: the backend has to be chosen first
from matplotlib.ticker import LogLocator, NullFormatter  # noqa: E402

DOC = pathlib.Path(__file__).resolve().parent.parent / 'doc'
PAGE = DOC / 'accuracy.md'

# Order and names of the sets in tables; others follow by their own names.
SETS = {
    'visp_castle_simu': 'castle',
    'evops_icl': 'evops_icl',
    'icl_nuim': 'icl_nuim',
    'mosd': 'mosd',
    'synpeb': 'synpeb',
    'synth_kinect': 'synth_kinect',
    'seven_scenes': 'seven_scenes',
}
METHODS = {
    'mrf_planes': 'pcl::MRFPlaneSegmentation',
    'pcl_multi_plane': 'pcl::OrganizedMultiPlaneSegmentation',
    'pcl_ransac': 'pcl::SACSegmentation, plane by plane',
    'opencv_rgbd_plane': 'cv::rgbd::RgbdPlane',
    'cgal_efficient_ransac': 'CGAL Efficient RANSAC',
}
COLOURS = ['#d62728', '#1f77b4', '#2ca02c', '#9467bd', '#ff7f0e', '#8c564b', '#17becf']


class Row(dict):
    """A line of a CSV, numbers by name."""

    def number(self, name):
        return float(self[name])


def read_rows(path):
    with open(path, newline='') as file:
        return [Row(row) for row in csv.DictReader(file)]


def group(rows, *names):
    """Rows by the values of some columns, in the order in which these come."""
    groups = collections.defaultdict(list)
    for row in rows:
        key = tuple(row[name] for name in names)
        groups[key if len(names) > 1 else key[0]].append(row)
    return groups


def labelled(rows):
    return [row for row in rows if row['pq']]


def ordered_sets(rows):
    """Names of the sets with ground truth."""
    present = list(dict.fromkeys(row['set'] for row in labelled(rows)))
    return [name for name in SETS if name in present] + [
        name for name in present if name not in SETS]


def mean_of(rows, column):
    return statistics.mean(row.number(column) for row in rows)


def ratio_of(rows, column='correct'):
    """Share of the true planes of all frames that were found."""
    truth = sum(row.number('truth') for row in rows)
    return sum(row.number(column) for row in rows) / truth if truth else float('nan')


def mean_over_sets(rows, value):
    """Mean over the sets of a value of their rows: each set counts alike."""
    return statistics.mean(value(frames)
                           for frames in group(labelled(rows), 'set').values())


def milliseconds(rows):
    times = [row.number('milliseconds') for row in rows
             if (row['width'], row['height']) == ('640', '480')]
    return statistics.median(times) if times else float('nan')


def short(value):
    """.814 for 0.814."""
    return f'{value:.3f}'.lstrip('0')


def in_digits(value):
    return f'{value:.1f}' if value < 10 else f'{value:.0f}'


def markdown_table(header, rows):
    lines = [header, ['---'] * len(header)] + rows
    return '\n'.join('| ' + ' | '.join(line) + ' |' for line in lines)


def save_plot(figure, name):
    path = DOC / 'pictures' / name
    # Without the version of matplotlib, so that the same figures give the same file.
    figure.savefig(path, dpi=110, metadata={'Software': None})
    plt.close(figure)
    return path


def label_of(method, setting):
    return f'{METHODS.get(method, method)}, {setting}'


def is_ours(method):
    return method == 'mrf_planes'


# --- block: peers ---------------------------------------------------------------------


def peers_table(rows):
    sets = ordered_sets(rows)
    header = ['method', 'setting'] + [SETS.get(name, name) for name in sets] + [
        'mean PQ', 'mean ratio', 'noise', 'ms']
    lines = []
    for (method, setting), frames in group(rows, 'method', 'setting').items():
        by_set = group(labelled(frames), 'set')
        cells = [f'{short(mean_of(by_set[name], "pq"))} {short(ratio_of(by_set[name]))}'
                 for name in sets]
        lines.append([METHODS.get(method, method), setting] + cells + [
            short(mean_over_sets(frames, lambda f: mean_of(f, 'pq'))),
            short(mean_over_sets(frames, ratio_of)),
            f'{mean_over_sets(frames, lambda f: mean_of(f, "noise")):.1f}',
            in_digits(milliseconds(frames))])
    return markdown_table(header, lines)


def plot_quality_over_time(rows):
    figure, axes = plt.subplots(figsize=(9, 4.2), layout='constrained')
    colours = dict(zip(group(rows, 'method'), COLOURS))
    for (method, setting), frames in group(rows, 'method', 'setting').items():
        quality = mean_over_sets(frames, lambda f: mean_of(f, 'pq'))
        time = milliseconds(frames)
        filled = setting in ('tuned', 'default')
        axes.plot(time, quality, '*' if is_ours(method) else 'o',
                  markersize=14 if is_ours(method) else 8, color=colours[method],
                  markerfacecolor=colours[method] if filled else 'white',
                  label=label_of(method, setting))
    axes.set_xscale('log')
    axes.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    axes.xaxis.set_major_formatter('{x:g}')
    axes.xaxis.set_minor_formatter(NullFormatter())
    axes.set_ylim(0, 1)
    axes.set_xlabel('milliseconds at 640x480, one core, median')
    axes.set_ylabel('panoptic quality, mean of the sets')
    axes.grid(True, which='both', alpha=0.25)
    axes.legend(bbox_to_anchor=(1.02, 1), loc='upper left', fontsize=8)
    return save_plot(figure, 'peers_quality_time.png')


def plot_tolerance(rows):
    """Share of the planes found over the tolerance, for the better settings."""
    columns = [name for name in rows[0] if name.startswith('correct_')]
    tolerances = [float(name.split('_')[1]) for name in columns]
    figure, axes = plt.subplots(figsize=(9, 4.2), layout='constrained')
    colours = dict(zip(group(rows, 'method'), COLOURS))
    for (method, setting), frames in group(rows, 'method', 'setting').items():
        if setting == 'published':
            continue
        shares = [mean_over_sets(frames, lambda f, c=column: ratio_of(f, c))
                  for column in columns]
        axes.plot(tolerances, shares, '--' if setting == 'paper' else '-', marker='.',
                  color=colours[method], label=label_of(method, setting))
    axes.set_ylim(0, 1)
    axes.set_xlabel('tolerance of Hoover et al.')
    axes.set_ylabel('share of true planes found, mean of the sets')
    axes.grid(True, alpha=0.25)
    axes.legend(bbox_to_anchor=(1.02, 1), loc='upper left', fontsize=8)
    return save_plot(figure, 'peers_tolerance.png')


def peers_block(path, machine):
    rows = read_rows(path)
    any_method = next(iter(group(rows, 'method', 'setting').values()))
    timed = [row for row in any_method if (row['width'], row['height']) == ('640', '480')]
    plot_quality_over_time(rows)
    plot_tolerance(rows)
    where = f'One core of {machine}. ' if machine else ''
    return '\n'.join([
        f'{where}Each set: PQ, then ratio, over {len(labelled(any_method))} frames; "ms": '
        f'median of the {len(timed)} frames of 640x480, from organized points to labels, '
        'normals included.',
        '',
        peers_table(rows),
        '',
        '![Panoptic quality over time](pictures/peers_quality_time.png)',
        '![Share of planes found over the tolerance](pictures/peers_tolerance.png)',
    ])


# --- all blocks -----------------------------------------------------------------------

# Option and mark -> function of the CSV's path and the machine's name.
BLOCKS = {
    'peers': peers_block,
}


def replace_block(page, name, text):
    begin, end = f'<!-- begin {name} -->', f'<!-- end {name} -->'
    pattern = re.compile(re.escape(begin) + '.*?' + re.escape(end), re.DOTALL)
    if not pattern.search(page):
        raise SystemExit(f'{PAGE} has no block "{begin} ... {end}"')
    return pattern.sub(lambda _: f'{begin}\n{text}\n{end}', page)


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name in BLOCKS:
        parser.add_argument(f'--{name}', metavar='CSV')
    parser.add_argument('--machine', default='', help='name of the processor')
    options = vars(parser.parse_args())
    (DOC / 'pictures').mkdir(exist_ok=True)
    page = PAGE.read_text()
    for name, block in BLOCKS.items():
        if options[name]:
            page = replace_block(page, name, block(options[name], options['machine']))
    temporary = PAGE.with_suffix('.md.new')
    temporary.write_text(page)
    os.replace(temporary, PAGE)


if __name__ == '__main__':
    main()
