# SPDX-License-Identifier: BSD-3-Clause
"""Blocks of doc/accuracy.md about the methods that benchmark_peers has as our own
implementations of papers: how near they come to the published programs, and clutter."""
from accuracy_tables import (
    METHODS, SETS, group, is_ours, labelled, markdown_table, mean_of, ordered_sets,
    ratio_of, short)

# Panoptic quality, then ratio, of the authors' own programs (of Open3D for planar patches)
# on the frames of the sets, by our method and setting: measured once with score.py's
# measures, not by benchmark_peers.
PROGRAM_SETS = ['visp_castle_simu', 'evops_icl', 'icl_nuim', 'mosd', 'synpeb',
                'synth_kinect', 'seven_scenes']
PROGRAMS = {
    ('peac', 'published'): ([.317, .428, .756, .629, .238, .507, .627],
                            [.197, .118, .545, .484, .220, .292, .453]),
    ('peac', 'loose'): ([.602, .468, .876, .739, .484, .694, .689],
                        [.455, .118, .636, .629, .400, .510, .500]),
    ('cape', 'published'): ([.284, .322, .654, .519, .199, .442, .395],
                            [.152, .176, .364, .371, .200, .219, .233]),
    ('cape', 'fine'): ([.514, .692, .800, .802, .372, .482, .302],
                       [.379, .412, .636, .710, .300, .260, .174]),
    ('planar_patches', 'published'): ([.646, .529, .765, .795, .555, .454, .256],
                                      [.576, .235, .636, .677, .420, .281, .256]),
}


def program_quality(key, name):
    """Panoptic quality of the program on a set; None: it was not measured there."""
    if name not in PROGRAM_SETS:
        return None
    return PROGRAMS[key][0][PROGRAM_SETS.index(name)]


def by_key(rows):
    """(method, setting) -> set -> rows with ground truth."""
    return {key: group(labelled(frames), 'set')
            for key, frames in group(rows, 'method', 'setting').items()}


# --- block: programs ------------------------------------------------------------------


def programs_block(rows, _):
    """How far each of our implementations is from the program: PQ and ratio of both."""
    measured = {key: sets for key, sets in by_key(rows).items() if key in PROGRAMS}
    names = [name for name in ordered_sets(rows) if name in PROGRAM_SETS]
    if not measured or not names:
        return None
    lines = []
    for (method, setting), sets in measured.items():
        qualities, ratios = PROGRAMS[(method, setting)]
        places = [PROGRAM_SETS.index(name) for name in names]
        lines.append([METHODS.get(method, method), setting, 'the program'] +
                     [f'{short(qualities[k])} {short(ratios[k])}' for k in places])
        lines.append(['', '', 'ours'] + [
            f'{short(mean_of(sets[name], "pq"))} {short(ratio_of(sets[name]))}'
            for name in names])
    header = ['method', 'setting', ''] + [SETS.get(name, name) for name in names]
    return markdown_table(header, lines)


# --- block: clutter -------------------------------------------------------------------


def best_of(candidates, quality):
    """The key of the candidates with the highest quality; those without one are out."""
    known = [key for key in candidates if quality(key) is not None]
    return max(known, key=quality) if known else None


def cells_of(key, sets, name):
    """Name, PQ and clutter of a method and setting on a set."""
    if key is None:
        return ['', '', '']
    label = f'{METHODS.get(key[0], key[0])}, {key[1]}'
    if key not in sets or not sets[key].get(name):
        return [label, 'not here', 'not here']
    frames = sets[key][name]
    return [label, short(mean_of(frames, 'pq')), short(mean_of(frames, 'clutter'))]


def clutter_block(rows, _):
    """Clutter of the default profile beside that of the methods of the highest PQ."""
    sets = by_key(rows)
    own = ('mrf_planes', 'default')
    if own not in sets:
        return None
    lines = []
    for name in ordered_sets(rows):
        ours = sets[own][name]
        best_program = best_of(PROGRAMS, lambda key, n=name: program_quality(key, n))
        others = [key for key in sets if not is_ours(key[0]) and sets[key].get(name)]
        best_other = best_of(others, lambda key, n=name: mean_of(sets[key][n], 'pq'))
        lines.append([SETS.get(name, name), short(mean_of(ours, 'pq')),
                      short(mean_of(ours, 'clutter'))] +
                     cells_of(best_program, sets, name) + cells_of(best_other, sets, name))
    return markdown_table(
        ['set', 'PQ', 'clutter', 'best published program', 'PQ', 'clutter',
         'best of the table above', 'PQ', 'clutter'], lines)
