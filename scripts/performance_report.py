#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Turns CSVs of measurements into the tables and plots of doc/performance.md.

  performance_report.py FOLDER [--page FILE] [--readme FILE] [--pictures FOLDER]

FOLDER holds what scripts/benchmark left: machine.csv, rooms.csv, memory.csv, instructions.csv
and, for real clouds, stages.csv, labels.csv, threads.csv, threads_labels.csv and peers.csv. Each
stands for blocks of the page: what lies between "<!-- begin NAME -->" and "<!-- end NAME -->" is
written anew. Blocks whose CSV is missing stay as they are. Needs python3-matplotlib.
"""
import argparse
import csv
import pathlib

import performance_clouds as clouds
import performance_rooms as rooms
from accuracy_tables import (
    DOC, markdown_table, read_rows, replace_block, write_whole)
from performance_tables import Times


def machine_of(folder):
    """What the figures were measured with, by name."""
    with open(folder / 'machine.csv', newline='') as file:
        return dict(row for row in csv.reader(file) if len(row) == 2)


def machine_block(machine):
    return markdown_table(['', ''], [[name, value] for name, value in machine.items()])


def room_blocks(times, pictures):
    blocks = {'points': rooms.points_block(times, pictures),
              'threads': rooms.threads_block(times),
              'labels': rooms.labels_block(times, pictures),
              'floors': rooms.floors_block(times),
              'instructions': rooms.instructions_block(times)}
    return {name: text for name, text in blocks.items() if text}


def page_blocks(folder, pictures):
    """Text by the mark of the block, as far as there are CSVs."""
    blocks = {'machine': machine_block(machine_of(folder))}
    times = Times(folder / 'rooms.csv')
    memory = Times(folder / 'memory.csv')
    blocks.update(room_blocks(times, pictures))
    blocks['memory'] = rooms.memory_block(memory)
    blocks['goals'] = rooms.goals_block(times, memory)
    if (folder / 'instructions.csv').exists():
        blocks['counts'] = rooms.counts_block(read_rows(folder / 'instructions.csv'))
    if (folder / 'stages.csv').exists():
        stages = read_rows(folder / 'stages.csv')
        blocks['stages'] = clouds.stages_block(stages, pictures)
        blocks['cloud goals'] = clouds.goals_block(stages)
    if (folder / 'labels.csv').exists():
        blocks['cloud labels'] = clouds.labels_block(read_rows(folder / 'labels.csv'))
    threads = [row for name in ('threads.csv', 'threads_labels.csv')
               if (folder / name).exists() for row in read_rows(folder / name)]
    if threads:
        blocks['cloud threads'] = clouds.threads_block(threads)
    if (folder / 'peers.csv').exists():
        blocks['peers'] = clouds.peers_block(read_rows(folder / 'peers.csv'))
    return blocks


def readme_blocks(folder):
    if not (folder / 'peers.csv').exists():
        return {}
    return {'speed': clouds.readme_block(read_rows(folder / 'peers.csv'),
                                         machine_of(folder), DOC / 'accuracy.md')}


def fill(path, blocks):
    page = path.read_text()
    for name, text in blocks.items():
        page = replace_block(page, name, text, path)
    write_whole(path, page)


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('folder', type=pathlib.Path)
    parser.add_argument('--page', type=pathlib.Path, default=DOC / 'performance.md')
    parser.add_argument('--readme', type=pathlib.Path, default=DOC.parent / 'README.md')
    parser.add_argument('--pictures', type=pathlib.Path, default=DOC / 'pictures')
    options = parser.parse_args()
    options.pictures.mkdir(exist_ok=True)
    fill(options.page, page_blocks(options.folder, options.pictures))
    fill(options.readme, readme_blocks(options.folder))


if __name__ == '__main__':
    main()
