# SPDX-License-Identifier: BSD-3-Clause
"""What the reports share: rows of CSVs, means, tables, plots, blocks of pages."""
import collections
import csv
import os
import pathlib
import re
import statistics

import matplotlib
matplotlib.use('Agg')
import matplotlib.pyplot as plt  # noqa: E402: the backend has to be chosen first

DOC = pathlib.Path(__file__).resolve().parent.parent / 'doc'

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
    'peac': 'PEAC, from the paper',
    'cape': 'CAPE, from the paper',
}
COLOURS = ['#d62728', '#1f77b4', '#2ca02c', '#9467bd', '#ff7f0e', '#8c564b', '#17becf',
           '#e377c2', '#bcbd22', '#7f7f7f']
# Our profiles are of one colour.
LINES = {'fast': '-.', 'paper': ':'}


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
    """Mean over the rows that have the number."""
    numbers = [row.number(column) for row in rows if row[column]]
    return statistics.mean(numbers) if numbers else float('nan')


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


def replace_block(page, name, text, path):
    """The page with new text between the marks of a block; path is for the message."""
    begin, end = f'<!-- begin {name} -->', f'<!-- end {name} -->'
    pattern = re.compile(re.escape(begin) + '.*?' + re.escape(end), re.DOTALL)
    if not pattern.search(page):
        raise SystemExit(f'{path} has no block "{begin} ... {end}"')
    return pattern.sub(lambda _: f'{begin}\n{text}\n{end}', page)


def write_whole(path, text):
    """Whole or not at all."""
    temporary = path.with_suffix(path.suffix + '.new')
    temporary.write_text(text)
    os.replace(temporary, path)


def save_plot(figure, name, folder=DOC / 'pictures'):
    path = folder / name
    # Without the version of matplotlib, so that the same figures give the same file.
    figure.savefig(path, dpi=110, metadata={'Software': None})
    plt.close(figure)
    return path


def label_of(method, setting):
    return f'{METHODS.get(method, method)}, {setting}'


def is_ours(method):
    return method == 'mrf_planes'


def colour_of(method):
    """The same in every plot."""
    names = list(METHODS)
    return COLOURS[names.index(method) if method in names else len(names)]
