#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Plot and table of doc/parameters.md from the sensitivity study of benchmark_studies.

  parameter_report.py STUDIES.csv [STUDIES.csv...]

Made by benchmark_studies --data FOLDER --studies sensitivity --threads 1; of several runs the least
time of each frame counts. Needs python3-matplotlib.
"""
import statistics
import sys

import matplotlib.pyplot as plt
from matplotlib.ticker import NullFormatter, NullLocator

from accuracy_studies import of_study, pq_of
from accuracy_tables import (
    COLOURS, DOC, group, markdown_table, mean_of, mean_over_sets, read_rows, replace_block,
    save_plot, short, write_whole)

PAGE = DOC / 'parameters.md'
# Those that doc/parameters.md has advice on, in its order.
IMPORTANT = ['sampling', 'passes', 'rounds', 'support-reach', 'merge-tolerance', 'min-evidence',
             'max-flatness', 'none-cost', 'label-change', 'fan-share', 'bend-angle', 'join-gap']
COLUMNS = 3


def with_least_times(runs):
    """The rows of the first run with the least time of each over the runs."""
    rows = of_study(runs[0], 'sensitivity')
    for others in runs[1:]:
        times = {(row['variant'], row['set'], row['frame']): row['milliseconds']
                 for row in of_study(others, 'sensitivity')}
        for row in rows:
            other = times[row['variant'], row['set'], row['frame']]
            row['milliseconds'] = min(row['milliseconds'], other, key=float)
    return rows


def cost_of(rows, usual):
    """Time over that of the defaults: the median of the frames' own ratios."""
    times = {(row['set'], row['frame']): row.number('milliseconds') for row in usual}
    return statistics.median(row.number('milliseconds') / times[row['set'], row['frame']]
                             for row in rows)


class Effect:
    """What the values of a parameter do."""

    def __init__(self, name, rows):
        variants = group(rows, 'variant')
        usual = variants['default']
        self.name = name
        self.frames = {}
        for variant, frames in variants.items():
            words = variant.split()
            if words[0] == name:
                self.frames[float(words[1])] = frames
                self.default = float(words[-1])
        if not self.frames:
            sys.exit(f'parameter_report.py: the study has no parameter {name}')
        self.frames = dict(sorted((self.frames | {self.default: usual}).items()))
        self.quality = {value: pq_of(frames) for value, frames in self.frames.items()}
        self.cost = {value: cost_of(frames, usual) for value, frames in self.frames.items()}
        self.noise = {value: mean_over_sets(frames, lambda f: mean_of(f, 'noise'))
                      for value, frames in self.frames.items()}


def plot_effect(axes, effect):
    values = list(effect.quality)
    axes.plot(values, list(effect.quality.values()), '.-', color=COLOURS[0])
    axes.axvline(effect.default, color='gray', linewidth=0.8, linestyle=':')
    axes.set_ylim(0.7, 0.88)
    axes.set_title(effect.name, fontsize=9, loc='left')
    if min(values) > 0:
        axes.set_xscale('log')
    axes.set_xticks(values, [f'{value:g}' for value in values], fontsize=7)
    axes.xaxis.set_minor_locator(NullLocator())
    axes.xaxis.set_minor_formatter(NullFormatter())
    axes.tick_params(axis='y', labelcolor=COLOURS[0], labelsize=7)
    for label in axes.get_xticklabels():
        label.set_rotation(45)
    cost = axes.twinx()
    cost.plot(values, list(effect.cost.values()), '.--', color=COLOURS[1])
    cost.set_ylim(0.3, 1.8)
    cost.tick_params(axis='y', labelcolor=COLOURS[1], labelsize=7)
    return cost


def plot(effects):
    rows = -(-len(effects) // COLUMNS)
    figure, panels = plt.subplots(rows, COLUMNS, figsize=(9, 2.1 * rows),
                                  layout='constrained')
    for k, (axes, effect) in enumerate(zip(panels.flat, effects)):
        cost = plot_effect(axes, effect)
        if k % COLUMNS == 0:
            axes.set_ylabel('mean PQ', color=COLOURS[0], fontsize=8)
        if k % COLUMNS == COLUMNS - 1:
            cost.set_ylabel('time', color=COLOURS[1], fontsize=8)
    return save_plot(figure, 'parameters.png')


def table(effects):
    lines = []
    for effect in effects:
        for value in effect.frames:
            name = f'`{effect.name}`' if value == min(effect.frames) else ''
            shown = f'**{value:g}**' if value == effect.default else f'{value:g}'
            lines.append([name, shown, short(effect.quality[value]),
                          f'{effect.noise[value]:.1f}', f'{effect.cost[value]:.2f}'])
    return markdown_table(['parameter', 'value', 'mean PQ', 'noise', 'time'], lines)


def main():
    if len(sys.argv) < 2:
        sys.exit('usage: parameter_report.py STUDIES.csv [STUDIES.csv...]')
    rows = with_least_times([read_rows(path) for path in sys.argv[1:]])
    effects = [Effect(name, rows) for name in IMPORTANT]
    plot(effects)
    page = replace_block(PAGE.read_text(), 'effects', table(effects), PAGE)
    write_whole(PAGE, page)


if __name__ == '__main__':
    main()
