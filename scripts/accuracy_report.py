#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Turns CSVs of measurements into the tables and plots of doc/accuracy.md.

  accuracy_report.py [--peers CSV] [--studies CSV] [--inference CSV] [--machine TEXT]

A CSV stands for one or more blocks of the page: what lies between "<!-- begin NAME -->" and
"<!-- end NAME -->" is written anew, its plots in doc/pictures. Blocks whose CSV is not given,
or does not have their lines, stay as they are. Needs python3-matplotlib.
"""
import argparse

import matplotlib.pyplot as plt
from matplotlib.ticker import LogLocator, NullFormatter

import accuracy_programs as programs
import accuracy_studies as studies
from accuracy_tables import (
    DOC, LINES, METHODS, SETS, colour_of, group, in_digits, is_ours, label_of, labelled,
    markdown_table, mean_of, mean_over_sets, milliseconds, ordered_sets, ratio_of,
    read_rows, replace_block, save_plot, short, write_whole)

PAGE = DOC / 'accuracy.md'

WHAT = {
    'visp_castle_simu': 'rendered model of a small castle, no noise',
    'evops_icl': 'rendered living room, labels by hand (EVOPS)',
    'icl_nuim': 'rendered rooms, no noise',
    'mosd': 'Kinect, objects on a table (OSD)',
    'synpeb': 'simulated rotating laser (SynPEB)',
    'synth_kinect': 'the rendered scenes through a model of a Kinect',
    'seven_scenes': 'Kinect, a kitchen at 0.5 to 4 m (7-Scenes)',
}

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
    """A mark for each setting, with its name beside it; a method's are joined by a line."""
    figure, axes = plt.subplots(figsize=(9, 4.2), layout='constrained')
    for method, of_method in group(rows, 'method').items():
        settings = group(of_method, 'setting')
        times = [milliseconds(frames) for frames in settings.values()]
        qualities = [mean_over_sets(frames, lambda f: mean_of(f, 'pq'))
                     for frames in settings.values()]
        axes.plot(times, qualities, '*-' if is_ours(method) else 'o-', linewidth=0.6,
                  markersize=14 if is_ours(method) else 7, color=colour_of(method),
                  label=METHODS.get(method, method))
        for setting, time, quality in zip(settings, times, qualities):
            axes.annotate(setting, (time, quality), xytext=(8, 4),
                          textcoords='offset points', fontsize=8, color=colour_of(method))
    axes.set_xscale('log')
    axes.margins(x=0.15)
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
    for (method, setting), frames in group(rows, 'method', 'setting').items():
        if setting == 'published':
            continue
        shares = [mean_over_sets(frames, lambda f, c=column: ratio_of(f, c))
                  for column in columns]
        axes.plot(tolerances, shares, LINES.get(setting, '-'), marker='.',
                  color=colour_of(method), label=label_of(method, setting))
    axes.set_ylim(0, 1)
    axes.set_xlabel('tolerance of Hoover et al.')
    axes.set_ylabel('share of true planes found, mean of the sets')
    axes.grid(True, alpha=0.25)
    axes.legend(bbox_to_anchor=(1.02, 1), loc='upper left', fontsize=8)
    return save_plot(figure, 'peers_tolerance.png')


def peers_block(rows, machine):
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


# --- block: result --------------------------------------------------------------------


def result_block(rows, _):
    rows = [row for row in rows if is_ours(row['method']) and row['setting'] == 'default']
    by_set = group(labelled(rows), 'set')
    columns = {'PQ': lambda f: short(mean_of(f, 'pq')),
               'ratio': lambda f: short(ratio_of(f)),
               'noise': lambda f: f'{mean_of(f, "noise"):.1f}',
               'recall': lambda f: short(mean_of(f, 'recall')),
               'clutter': lambda f: short(mean_of(f, 'clutter'))}
    lines = [[SETS.get(name, name), WHAT.get(name, ''), str(len(by_set[name]))] +
             [column(by_set[name]) for column in columns.values()]
             for name in ordered_sets(rows)]
    lines.append(['mean', '', ''] + [
        short(mean_over_sets(rows, lambda f: mean_of(f, 'pq'))),
        short(mean_over_sets(rows, ratio_of)),
        f'{mean_over_sets(rows, lambda f: mean_of(f, "noise")):.1f}',
        short(mean_over_sets(rows, lambda f: mean_of(f, 'recall'))),
        short(mean_over_sets(rows, lambda f: mean_of(f, 'clutter')))])
    return markdown_table(['set', 'what it is', 'frames'] + list(columns), lines)


# --- all blocks -----------------------------------------------------------------------

# Option -> mark of a block -> function of the CSV's rows and the machine's name. None: the
# CSV has no such rows.
BLOCKS = {
    'peers': {'result': result_block, 'peers': peers_block,
              'programs': programs.programs_block, 'clutter': programs.clutter_block},
    'studies': {'ablation': studies.ablation_block,
                'sensitivity': studies.sensitivity_block,
                'noise': studies.noise_block},
    'inference': {'inference': studies.inference_block},
}


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for option in BLOCKS:
        parser.add_argument(f'--{option}', metavar='CSV')
    parser.add_argument('--machine', default='', help='name of the processor')
    options = vars(parser.parse_args())
    (DOC / 'pictures').mkdir(exist_ok=True)
    page = PAGE.read_text()
    for option, blocks in BLOCKS.items():
        rows = read_rows(options[option]) if options[option] else []
        for name, block in blocks.items():
            text = block(rows, options['machine']) if rows else None
            if text:
                page = replace_block(page, name, text, PAGE)
    write_whole(PAGE, page)


if __name__ == '__main__':
    main()
