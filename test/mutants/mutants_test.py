#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Every line of test/mutants/mutants.txt still stands once in its source, so that scripts/mutants,
which runs seldom, has all of them to break. Argument: source folder."""
import pathlib
import sys


def main():
    root = pathlib.Path(sys.argv[1])
    lines = [line for line in (root / 'test/mutants/mutants.txt').read_text().splitlines()
             if not line.startswith('#')]
    problems = ['a mutant is three lines'] if len(lines) % 3 else []
    for number, (file, old, new) in enumerate(zip(*[iter(lines)] * 3), 1):
        path = root / file
        times = path.read_text().count(old) if path.exists() else 0
        if times != 1 or old == new:
            problems.append(f'{number}: {file} has {times} times: {old}')
    if problems:
        sys.exit('\n'.join(problems))


if __name__ == '__main__':
    main()
