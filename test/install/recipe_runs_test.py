#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The Conan recipe and the vcpkg port go through their steps before stand-ins for Conan and
vcpkg, which Debian does not have: what they export can be configured, options and targets that
they name are there, and what they require is what they use. Arguments: cmake, source folder, a
folder to work in."""
import importlib.util
import json
import pathlib
import re
import shutil
import subprocess
import sys
import types

import jsonschema

# What a port's manifest may have: learn.microsoft.com/vcpkg/reference/vcpkg-json.
NAME = {'type': 'string', 'pattern': '^[a-z0-9]+(-[a-z0-9]+)*$'}
MANIFEST = {
    'type': 'object',
    'properties': {
        'name': NAME,
        'version': {'type': 'string', 'pattern': r'^\d+(\.\d+)*$'},
        'description': {'type': 'string'},
        'license': {'type': 'string'},
        'dependencies': {'type': 'array', 'uniqueItems': True, 'items': {'oneOf': [NAME, {
            'type': 'object',
            'properties': {'name': NAME, 'host': {'type': 'boolean'},
                           'default-features': {'type': 'boolean'},
                           'features': {'type': 'array', 'items': NAME}},
            'required': ['name'],
            'additionalProperties': False}]}},
    },
    'required': ['name', 'version', 'description', 'license', 'dependencies'],
    'additionalProperties': False,
}

# What the port calls of vcpkg's helpers; the paths and options are written down.
HELPERS = r'''
set(CURRENT_PACKAGES_DIR "${CMAKE_CURRENT_LIST_DIR}/packages")
function(vcpkg_cmake_configure)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "SOURCE_PATH" "OPTIONS")
  message("SOURCE_PATH ${arg_SOURCE_PATH}")
  foreach(option IN LISTS arg_OPTIONS)
    message("OPTION ${option}")
  endforeach()
endfunction()
function(vcpkg_cmake_install)
endfunction()
function(vcpkg_fixup_pkgconfig)
endfunction()
function(vcpkg_cmake_config_fixup)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "PACKAGE_NAME;CONFIG_PATH" "")
  message("CONFIG_PATH ${arg_CONFIG_PATH}")
endfunction()
function(vcpkg_install_copyright)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "" "FILE_LIST")
  message("LICENSE ${arg_FILE_LIST}")
endfunction()
'''


class Recorder:
    """Stands for Conan's generators and lists of properties: keeps what is set."""

    def __init__(self, *_):
        self.properties = []
        self.cache_variables = {}
        self.libs, self.requires = [], []

    def set_property(self, *words):
        self.properties.append(words)

    def generate(self):
        MADE.append(self)

    def configure(self):
        pass

    build = install = configure


class CppInfo(Recorder):
    def __init__(self):
        super().__init__()
        self.components = Components()


class Components(dict):
    def __missing__(self, name):
        self[name] = Recorder()
        return self[name]


class Options(types.SimpleNamespace):
    def rm_safe(self, name):
        self.__dict__.pop(name, None)


MADE = []


def conan_copy(_, pattern, source, target):
    """As conan.tools.files.copy, for a file or all that is below a folder (FOLDER/*)."""
    place = pathlib.Path(target) / pattern.removesuffix('/*')
    if pattern.endswith('/*'):
        shutil.copytree(pathlib.Path(source) / pattern[:-2], place, dirs_exist_ok=True)
    else:
        place.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(pathlib.Path(source) / pattern, place)


def stand_in_for_conan():
    class ConanFile:
        def requires(self, reference, **_):
            self.required.append(reference.split('/')[0])

    modules = {
        'conan': {'ConanFile': ConanFile},
        'conan.tools': {},
        'conan.tools.cmake': {'CMake': Recorder, 'CMakeDeps': Recorder,
                              'CMakeToolchain': Recorder, 'cmake_layout': lambda *_: None},
        'conan.tools.files': {'copy': conan_copy},
    }
    for name, content in modules.items():
        module = types.ModuleType(name)
        vars(module).update(content)
        sys.modules[name] = module


def run_conan(root, work):
    """Every step of the recipe, in Conan's order; the folder that it exports to."""
    stand_in_for_conan()
    file = root / 'packaging/conan/conanfile.py'
    spec = importlib.util.spec_from_file_location('conanfile', file)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    recipe = module.PclMrfPlanes()
    recipe.options = Options(**recipe.default_options)
    recipe.recipe_folder = str(file.parent)
    recipe.export_sources_folder = recipe.source_folder = str(work / 'exported')
    recipe.package_folder = str(work / 'package')
    recipe.required, recipe.cpp_info = [], CppInfo()
    for step in (recipe.export_sources, recipe.configure, recipe.requirements, recipe.layout,
                 recipe.generate, recipe.build, recipe.package, recipe.package_info):
        step()
    return recipe


def check_components(recipe, libraries):
    components = recipe.cpp_info.components
    used = set()
    for name, component in components.items():
        for library in component.libs:
            assert library in libraries, f'{name}: there is no library {library}'
            target = ('cmake_target_name', f'pcl_mrf_planes::{library}')
            assert target in component.properties, f'{name} is not the target {target[1]}'
        for required in component.requires:
            package, _, part = required.partition('::')
            assert part or package in components, f'{name} requires {required}, which is nowhere'
            if part:
                used.add(package)
    assert used == set(recipe.required), \
        f'required {sorted(recipe.required)}, used by components {sorted(used)}'
    found = {library for component in components.values() for library in component.libs}
    assert found == libraries, f'libraries {sorted(libraries)}, in components {sorted(found)}'
    assert (pathlib.Path(recipe.package_folder) / 'licenses/LICENSE').exists(), 'no licence'


def run_vcpkg(cmake, root, work):
    helpers = work / 'helpers.cmake'
    helpers.write_text(HELPERS + f'include("{root}/packaging/vcpkg/portfile.cmake")\n')
    told = subprocess.run([cmake, '-P', helpers], check=True, stderr=subprocess.PIPE,
                          text=True).stderr
    lines = [line.split(' ', 1) for line in told.splitlines()]
    return {word: [rest for first, rest in lines if first == word] for word, _ in lines}


def boost_ports(root):
    """Ports of the Boost headers that the libraries include."""
    names = set()
    for folder in ('src', 'io', 'include'):
        for path in (root / folder).rglob('*.*'):
            names |= set(re.findall(r'#include <boost/(\w+)', path.read_text()))
    return {'boost-' + name.replace('_', '-') for name in names}


def check_vcpkg(root, port, options):
    assert pathlib.Path(port['SOURCE_PATH'][0]) == root, port
    assert pathlib.Path(port['LICENSE'][0]).exists(), port
    named = {re.fullmatch(r'-D(\w+)=\w+', option)[1] for option in port['OPTION']}
    assert named <= options, f'no options: {named - options}'
    manifest = json.loads((root / 'packaging/vcpkg/vcpkg.json').read_text())
    jsonschema.validate(manifest, MANIFEST)
    names = {one if isinstance(one, str) else one['name'] for one in manifest['dependencies']}
    lacking = boost_ports(root) - names
    assert not lacking, f'vcpkg.json does not name {lacking}'


def main():
    cmake, root, work = sys.argv[1], *(pathlib.Path(path).resolve() for path in sys.argv[2:])
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    lists = {path: (root / path).read_text()
             for path in ('CMakeLists.txt', 'src/CMakeLists.txt', 'io/CMakeLists.txt')}
    options = set(re.findall(r'^option\((\w+)', lists['CMakeLists.txt'], re.MULTILINE))
    libraries = {re.search(r'add_library\((\w+)', lists[path])[1]
                 for path in ('src/CMakeLists.txt', 'io/CMakeLists.txt')}

    recipe = run_conan(root, work)
    check_components(recipe, libraries)
    variables = {name: value for one in MADE for name, value in one.cache_variables.items()
                 if name.startswith('PCL_MRF_PLANES_')}
    assert set(variables) <= options, f'no options: {set(variables) - options}'

    port = run_vcpkg(cmake, root, work)
    check_vcpkg(root, port, options)

    headers = work / 'exported/include/pcl_mrf_planes'
    assert (headers / 'mrf_plane_segmentation.h').exists(), 'headers are not exported'
    # Debian's packages in the place of theirs; CMake asks for each source that is compiled.
    subprocess.run([cmake, '-S', work / 'exported', '-B', work / 'build',
                    '-DCMAKE_INSTALL_LIBDIR=lib',
                    *(f'-D{name}={value}' for name, value in variables.items())],
                   check=True, stdout=subprocess.DEVNULL)
    installed = (work / 'build/cmake_install.cmake').read_text()
    assert port['CONFIG_PATH'][0] in installed, f'nothing is installed to {port["CONFIG_PATH"]}'


if __name__ == '__main__':
    main()
