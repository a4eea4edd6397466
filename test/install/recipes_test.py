#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The files for colcon, vcpkg, Conan and citations can be read, have the version of
CMakeLists.txt, and name every library that CMake looks for. Argument: source folder."""
import ast
import json
import pathlib
import re
import sys
import xml.etree.ElementTree

# What find_package() takes: its name in package.xml, in vcpkg.json and in conanfile.py. The
# recipes build the libraries only.
LIBRARIES = {
    'Eigen3': ('eigen', 'eigen3', 'eigen'),
    'PCL': ('libpcl-all-dev', 'pcl', 'pcl'),
    'hwy': ('libhwy-dev', 'highway', 'highway'),
    'TBB': ('tbb', 'tbb', 'onetbb'),
    'HDF5': ('libhdf5-dev', 'hdf5', 'hdf5'),
    'PNG': ('libpng-dev', 'libpng', 'libpng'),
    'yaml-cpp': ('yaml-cpp', 'yaml-cpp', 'yaml-cpp'),
    'Boost': ('libboost-dev', 'boost-geometry', 'boost'),
    'VTK': ('libvtk', None, None),
    'nlohmann_json': ('nlohmann-json-dev', None, None),
    'X11': ('libx11-dev', None, None),
    'GTest': ('gtest', None, None),
}


def found_by_cmake(root):
    names = set()
    for path in ['CMakeLists.txt', 'src/CMakeLists.txt', 'io/CMakeLists.txt',
                 'apps/CMakeLists.txt', 'apps/viewer/CMakeLists.txt',
                 'apps/evaluation/CMakeLists.txt', 'test/CMakeLists.txt']:
        names |= set(re.findall(r'find_package\((\S+)', (root / path).read_text()))
    return names


def conan_recipe(path):
    tree = ast.parse(path.read_text())
    version = next(node.value.value for node in ast.walk(tree)
                   if isinstance(node, ast.Assign) and node.targets[0].id == 'version')
    names = [node.args[0].value.split('/')[0] for node in ast.walk(tree)
             if isinstance(node, ast.Call) and getattr(node.func, 'attr', '') == 'requires']
    return version, names


def main():
    root = pathlib.Path(sys.argv[1])
    version = re.search(r'project\(pcl_mrf_planes VERSION (\S+)',
                        (root / 'CMakeLists.txt').read_text())[1]
    package = xml.etree.ElementTree.parse(root / 'package.xml').getroot()
    vcpkg = json.loads((root / 'packaging/vcpkg/vcpkg.json').read_text())
    conan_version, conan_names = conan_recipe(root / 'packaging/conan/conanfile.py')
    citation = re.search(r'^version: "?([^"\n]+)', (root / 'CITATION.cff').read_text(),
                         re.MULTILINE)[1]
    problems = [f'{name} has version {found}, CMakeLists.txt {version}'
                for name, found in [('package.xml', package.findtext('version')),
                                    ('vcpkg.json', vcpkg['version']),
                                    ('conanfile.py', conan_version),
                                    ('CITATION.cff', citation)] if found != version]
    names = [{element.text for element in package if element.tag.endswith('depend')},
             {one if isinstance(one, str) else one['name'] for one in vcpkg['dependencies']},
             set(conan_names)]
    for library in sorted(found_by_cmake(root)):
        if library == 'Threads':  # comes with the compiler
            continue
        if library not in LIBRARIES:
            problems.append(f'{library} is new: put it into packages, and into this test')
            continue
        for wanted, there, file in zip(LIBRARIES[library], names,
                                       ['package.xml', 'vcpkg.json', 'conanfile.py']):
            if wanted and wanted not in there:
                problems.append(f'{file} does not name {wanted}')
    if problems:
        sys.exit('\n'.join(problems))


if __name__ == '__main__':
    main()
